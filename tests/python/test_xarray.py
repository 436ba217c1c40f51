"""DataArrays and Datasets: place, CRS, voids and packing are read the same, whatever else is imported."""
import os
import subprocess
import sys
import unittest
import warnings

import scarp
from scarp import _inputs
from fixtures import hills, is_same, need, np

ROWS, COLS = 120, 160


def grid(dims=("y", "x"), y=None, x=None, **more):
    import xarray
    x = 500015.0 + 30 * np.arange(COLS) if x is None else x
    y = 4000000.0 - 15 - 30 * np.arange(ROWS) if y is None else y
    return xarray.DataArray(hills(), dims=dims, coords={dims[0]: y, dims[1]: x}, name="dem", **more)


def degrees(dims=("lat", "lon"), **more):
    return grid(dims, 46 - (np.arange(ROWS) + 0.5) / 1200, 8 + (np.arange(COLS) + 0.5) / 1200, **more)


def place_of(source, **more):
    """The transform and the CRS given to the library."""
    field = _inputs.read(source, **more).field
    return list(field.geotransform), (field.crs or b"").decode()


@need("numpy", "xarray")
class DataArrays(unittest.TestCase):
    def expect(self, source, place, told, **more):
        found, crs = place_of(source, **more)
        self.assertTrue(np.allclose(found, place, rtol=0, atol=1e-9), found)
        self.assertEqual(crs, told)

    def test_the_order_of_coordinates_changes_nothing(self):
        heights = grid()
        expected = scarp.simplify(hills(), 2, transform=(500000, 30, 0, 4000000, 0, -30))
        mask = np.ones((ROWS, COLS), "f4")
        mask[:40, 100:] = 0.01
        masked = scarp.simplify(heights, 2, mask=mask)
        for other in (heights, heights[::-1], heights[:, ::-1], heights[::-1, ::-1], heights.transpose(),
                      heights.transpose()[::-1, ::-1], heights.expand_dims("band"), heights.expand_dims(time=1, axis=2),
                      heights.to_dataset(), heights.astype("f8"), heights.chunk() if has_dask() else heights):
            mesh = scarp.simplify(other, 2)
            self.assertTrue(is_same(mesh, expected) and mesh.origin == expected.origin, other.dims)
        # Masks have the layout of their array; samples are named in it.
        beside, of = heights.copy(data=mask), expected.report.max_error_at
        for other in (heights[::-1], heights[:, ::-1], heights.transpose(), heights.transpose()[::-1, ::-1]):
            like = beside.transpose(*other.dims).sel({dim: other.coords[dim] for dim in other.dims})
            self.assertTrue(is_same(scarp.simplify(other, 2, mask=like.values), masked), other.dims)
            self.assertTrue(is_same(scarp.simplify(other, 2, mask=like), masked), other.dims)
            mesh = scarp.simplify(other, 2)
            at = mesh.report.max_error_at
            self.assertEqual({dim: other.coords[dim].values[at[axis]] for axis, dim in enumerate(other.dims)},
                             {dim: heights.coords[dim].values[of[axis]] for axis, dim in enumerate(heights.dims)})
            self.assertEqual(scarp.measure(other, mesh).max_error_at, at)
        with self.assertRaisesRegex(scarp.UsageError, "the coordinate y of mask is not that of the heights"):
            scarp.simplify(heights, 2, mask=heights.copy(data=mask)[::-1])

    def test_degrees_are_told_by_names_or_units(self):
        place = (8, 1 / 1200, 0, 46, 0, -1 / 1200)
        named = degrees()
        by_units = degrees(("j", "i"))
        by_units.j.attrs["units"], by_units.i.attrs["units"] = "degrees_north", "degrees_east"
        by_standard = degrees(("a", "b"))
        by_standard.a.attrs["standard_name"], by_standard.b.attrs["standard_name"] = "latitude", "longitude"
        for one in (named, named[::-1], by_units, by_units.transpose(), by_standard):
            self.expect(one, place, "EPSG:4326")
            mesh = scarp.simplify(one, 2)
            self.assertTrue(10000 < np.ptp(mesh.vertices[:, 0]) < 11000)  # metres
            self.assertLess(abs(np.ptp(mesh.vertices[:, 1]) - 119 / 1200 * 111150), 30)
        # Without a CRS they are treated as in the program, with a warning.
        with self.assertWarnsRegex(scarp.ScarpWarning, "look like degrees.*EPSG:4326"):
            scarp.simplify(degrees(("y", "x")), 2)
        with self.assertWarnsRegex(scarp.ScarpWarning, "look like degrees"):
            scarp.simplify(hills(), 2, transform=place)

    def test_longitudes_may_cross_the_meridian_where_they_begin_anew(self):
        x = 359.95 + (np.arange(COLS) + 0.5) / 1200
        plain = degrees().assign_coords(lon=x)
        for longitudes in (x % 360, np.where(x > 180, x - 360, x), x):
            self.expect(plain.assign_coords(lon=longitudes), (longitudes[0] - 0.5 / 1200, 1 / 1200, 0, 46, 0, -1 / 1200), "EPSG:4326")

    def test_every_step_is_looked_at(self):
        bent = -80 * np.sin(np.linspace(-np.pi / 2, np.pi / 2, ROWS))
        late = 46 - np.arange(ROWS) / 1200
        late[-2] += 0.2 / 1200
        torn = np.r_[np.arange(COLS // 2), np.arange(COLS // 2) + COLS].astype(float)
        for one, words in ((degrees().assign_coords(lat=bent), "lat of dem has uneven steps"),
                           (degrees().assign_coords(lat=late), "lat of dem has uneven steps"),
                           (grid().assign_coords(x=torn), "x of dem has uneven steps"),
                           (grid().assign_coords(x=np.zeros(COLS)), "x of dem is 0 everywhere"),
                           (grid().assign_coords(x=np.r_[np.nan, np.arange(COLS - 1)]), "not finite")):
            with self.assertRaisesRegex(scarp.InputError, words):
                scarp.simplify(one, 2)
        # Numbers stored in float32 are as evenly spaced as they can be.
        self.assertEqual(place_of(degrees().assign_coords(lat=(46 - np.arange(ROWS) / 1200).astype("f4")))[1], "EPSG:4326")

    @need("scipy")
    def test_the_way_out_of_uneven_steps(self):
        bent = degrees().assign_coords(lat=-80 * np.sin(np.linspace(-np.pi / 2, np.pi / 2, ROWS)))
        with self.assertRaises(scarp.InputError) as caught:
            scarp.simplify(bent, 2)
        way = str(caught.exception).split("as in ")[1]
        even = eval(way, {"array": bent, "numpy": np})
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # degrees over so many latitudes distort shapes
            self.assertLessEqual(scarp.simplify(even, 2).max_error, 2)

    def test_a_crs_is_found_where_files_and_tools_have_it(self):
        import xarray
        utm = "EPSG:32611"
        coordinate = grid().assign_coords(spatial_ref=((), 0, {"spatial_ref": utm}))
        mapped = grid(attrs={"grid_mapping": "mapping"}).assign_coords(mapping=((), 0, {"crs_wkt": utm}))
        encoded = grid().assign_coords(mapping=((), 0, {"crs_wkt": utm}))
        encoded.encoding["grid_mapping"] = "mapping"
        beside = xarray.Dataset({"dem": grid(attrs={"grid_mapping": "mapping"}), "mapping": ((), 0, {"crs_wkt": utm})})
        for one in (coordinate, mapped, encoded, beside, grid().assign_coords(crs=((), 0, {"epsg_code": utm})),
                    grid(attrs={"crs": "+init=epsg:32611"}), coordinate[::-1, ::-1]):
            self.expect(one, (500000, 30, 0, 4000000, 0, -30), utm)
        self.expect(coordinate, (500000, 30, 0, 4000000, 0, -30), "EPSG:32612", crs="EPSG:32612")
        self.expect(grid(), (500000, 30, 0, 4000000, 0, -30), "")
        geographic = degrees().assign_coords(crs=((), 0, {"grid_mapping_name": "latitude_longitude"}))
        self.expect(geographic, (8, 1 / 1200, 0, 46, 0, -1 / 1200), "EPSG:4326")
        kilometres = grid(y=4000 - 0.03 * (np.arange(ROWS) + 0.5), x=500 + 0.03 * (np.arange(COLS) + 0.5))
        for axis in (kilometres.x, kilometres.y):
            axis.attrs["units"] = "km"
        self.expect(kilometres, (500000, 30, 0, 4000000, 0, -30), "")

    def test_without_coordinates_a_geotransform_counts(self):
        import xarray
        told = {"GeoTransform": "500000 30 5 4000000 5 -30", "crs_wkt": "EPSG:32611"}
        turned = xarray.DataArray(hills(), dims=("y", "x"), coords={"spatial_ref": ((), 0, told)})
        self.expect(turned, (500000, 30, 5, 4000000, 5, -30), "EPSG:32611")
        self.expect(turned.drop_vars("spatial_ref"), (0, 1, 0, 0, 0, -1), "")
        # The coordinates of a part apply, whatever the geotransform of the whole.
        part = grid().assign_coords(spatial_ref=((), 0, {**told, "GeoTransform": "500000 30 0 4000000 0 -30"}))[20:, 10:]
        self.expect(part, (500300, 30, 0, 3999400, 0, -30), "EPSG:32611")

    def test_what_has_no_place_on_a_grid_is_refused(self):
        import xarray
        curved = xarray.DataArray(hills(), dims=("j", "i"), coords={
            "lat": (("j", "i"), np.ones((ROWS, COLS))), "lon": (("j", "i"), np.ones((ROWS, COLS)))})
        several = xarray.Dataset({"a": grid(), "b": grid()})
        day = np.datetime64("2020-01-01") + np.arange(COLS)
        cases = [(scarp.InputError, "bent grid", curved), (scarp.UsageError, "a, b: pick one, as in dataset.'a'.", several),
                 (scarp.UsageError, "no variable", xarray.Dataset()),
                 (scarp.UsageError, r"array.isel\(time=0\)", grid().expand_dims(time=3)),
                 (scarp.InputError, "none along its other", grid().drop_vars("x")),
                 (scarp.InputError, "in degrees and the other", degrees(("lat", "x"))),
                 (scarp.InputError, "no latitude", grid(("lat", "lon"))),
                 (scarp.InputError, "is projected", degrees().assign_coords(crs=((), 0, {"crs_wkt": 'PROJCS["a"]'}))),
                 (scarp.InputError, "is no number", grid().assign_coords(x=day))]
        for kind, words, source in cases:
            with self.assertRaisesRegex(kind, words):
                scarp.simplify(source, 2)
        # With a transform, coordinates are not needed.
        self.assertEqual(place_of(curved, transform=(0, 1, 0, 0, 0, -1))[0], [0, 1, 0, 0, 0, -1])
        self.assertLessEqual(scarp.simplify(several["a"], 2).max_error, 2)

    def test_voids_and_packed_heights_are_unpacked(self):
        z = np.round(hills())
        void = np.zeros(z.shape, bool)
        void[30:50, 40:90] = True
        expected = scarp.simplify(np.where(void, np.nan, z), 2, transform=(500000, 30, 0, 4000000, 0, -30))
        packed = grid().copy(data=np.where(void, -32768, z * 2 - 200).astype("i2"))
        told = {"_FillValue": np.int16(-32768), "scale_factor": 0.5, "add_offset": 100.0}
        missing = grid().copy(data=np.where(void, np.float32(-9999), z))
        both = grid().copy(data=np.where(void, np.where(np.arange(COLS) % 2, -9999, -8888), z))
        for one in (packed.assign_attrs(told), missing.assign_attrs(missing_value=-9999.0),
                    missing.assign_attrs(nodatavals=(-9999.0,)), both.assign_attrs(_FillValue=-9999.0, missing_value=-8888.0),
                    grid().copy(data=z).where(~void)):
            self.assertTrue(is_same(scarp.simplify(one, 2), expected))
        self.assertTrue(is_same(scarp.simplify(missing, 2, nodata=-9999), expected))

    def test_a_unit_counts(self):
        for unit, error in (("ft", "3ft"), ("m", "3m"), ("metre", "3m")):
            self.assertTrue(is_same(scarp.simplify(grid(attrs={"units": unit}), error), scarp.simplify(grid(), 3)))

    @need("rioxarray")
    def test_rioxarray_changes_nothing(self):
        script = ("import sys, numpy as np, scarp, test_xarray as t\n"
                  "if sys.argv[1] == 'with': import rioxarray\n"
                  "for one in (t.grid(), t.degrees(), t.degrees(('y', 'x')), t.degrees().transpose()):\n"
                  "    print(t.place_of(one))\n")
        answers = [subprocess.run([sys.executable, "-c", script, how], stdout=subprocess.PIPE, check=True,
                                  cwd=os.path.dirname(os.path.abspath(__file__))).stdout for how in ("with", "without")]
        self.assertEqual(answers[0], answers[1])
        import rioxarray  # noqa: F401
        self.expect(grid().rio.write_crs(32611), (500000, 30, 0, 4000000, 0, -30), "EPSG:32611")


def has_dask():
    try:
        import dask.array  # noqa: F401
    except ImportError:
        return False
    return True
