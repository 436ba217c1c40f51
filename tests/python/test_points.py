"""Points in memory, and impossible requests for arrays. With and without GDAL."""
import os
import pickle
import struct
import tempfile
import unittest
import warnings

import scarp
from fixtures import hills, need, np

DEGREES = "x and y are degrees"


def survey(count=300, west=8.0, south=46.0, width=0.1):
    random = np.random.default_rng(3)
    return np.c_[west + random.random(count) * width, south + random.random(count) * width, 500 + random.random(count) * 50]


def write_las(path, rows):
    """LAS 1.2, points of format 0: rows of x, y, z in centimetres, and the class."""
    head = bytearray(227)
    struct.pack_into("<4s", head, 0, b"LASF")
    struct.pack_into("<BB", head, 24, 1, 2)
    struct.pack_into("<HIIBHI", head, 94, 227, 227, 0, 0, 20, len(rows))
    struct.pack_into("<6d", head, 131, 0.01, 0.01, 0.01, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(bytes(head) + b"".join(struct.pack("<3iHBBbBH", *row[:3], 0, 9, row[3], 0, 0, 0) for row in rows))


class Files(unittest.TestCase):
    def test_classes_of_a_las_file(self):
        rows = [(col * 100, row * 100, (row * col) % 7, 2) for row in range(9) for col in range(9)] + [(450, 450, 9000, 5)]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "survey.las")
            write_las(path, rows)
            mesh = scarp.simplify_points(path, 0.05, class_="ground", returns="last")
            self.assertEqual(mesh.report.samples, 81)
            self.assertEqual(scarp.measure(path, mesh).samples, 81)
            with self.assertRaisesRegex(scarp.InputError, "of other classes"):
                scarp.simplify_points(path, 0.05, class_="water")


@need("numpy")
class Points(unittest.TestCase):
    def refuses(self, kind, words, call):
        with self.assertRaisesRegex(kind, words):
            call()

    def test_every_point_keeps_a_bound_of_its_own(self):
        random = np.random.default_rng(5)
        points = np.floor(random.random((600, 3)) * [6400, 5120, 1920]) / 64  # exact as float32
        bounds = random.random(600) * 6
        bounds[::7], bounds[1::7], bounds[2::50] = np.inf, 9, 0
        for given, tolerance in ((points, bounds), (points.tolist(), list(bounds)), (points, bounds.astype(np.float32)),
                                 (np.ma.masked_array(points, np.repeat(np.arange(600) == 3, 3).reshape(-1, 3)), bounds)):
            mesh = scarp.simplify_points(given, 5, tolerance=tolerance, effort="high")
            vertices, triangles = mesh.vertices, mesh.triangles
            a, b, c = np.moveaxis(vertices[triangles], 1, 0)
            kept = np.arange(600) != 3 if isinstance(given, np.ma.MaskedArray) else np.full(600, True)
            for (x, y, z), bound in zip(points[kept], np.minimum(bounds, 5)[kept]):
                side = lambda p, q: (q[:, 0] - p[:, 0]) * (y - p[:, 1]) - (q[:, 1] - p[:, 1]) * (x - p[:, 0])
                u, v, w = side(b, c), side(c, a), side(a, b)
                area = u + v + w
                inside = (u >= -1e-9) & (v >= -1e-9) & (w >= -1e-9) & (area > 0)
                self.assertTrue(inside.any())
                heights = ((u * a[:, 2] + v * b[:, 2] + w * c[:, 2]) / np.where(area > 0, area, 1))[inside]
                self.assertLessEqual(np.abs(heights - z).min(), bound * (1 + 1e-6) + 1e-5)
            self.assertEqual(scarp.measure(given, mesh, tolerance=tolerance, points=True).over, 0)
        plain = scarp.simplify_points(points, 5, effort="high")
        self.assertLess(plain.triangle_count, mesh.triangle_count)
        with self.assertRaises(scarp.PromiseError):
            scarp.measure(points, plain, tolerance=bounds)
        # Omitted points do not shift the bounds of the others.
        some = points.copy()
        some[4:300:3, 2] = -99
        bounds[4:300:3] = 0
        mesh = scarp.simplify_points(some, 5, tolerance=bounds, nodata=-99)
        self.assertEqual(scarp.measure(np.delete(some, np.s_[4:300:3], 0), mesh, tolerance=np.delete(bounds, np.s_[4:300:3])).over, 0)
        bounds[9] = -0.5
        self.refuses(scarp.UsageError, r"tolerance\[9\] is -0.5", lambda: scarp.simplify_points(points, 5, tolerance=bounds))
        bounds[9] = np.nan
        self.refuses(scarp.UsageError, r"tolerance\[9\] is nan", lambda: scarp.simplify_points(points, 5, tolerance=bounds))
        self.refuses(scarp.UsageError, r"tolerance has the shape \(599,\), and there are 600 points",
                     lambda: scarp.simplify_points(points, 5, tolerance=bounds[1:]))
        self.refuses(scarp.UsageError, "tolerance is an array of numbers", lambda: scarp.simplify_points(points, 5, tolerance=["a"] * 600))
        self.refuses(scarp.UsageError, "tolerance of points needs max_error",
                     lambda: scarp.simplify_points(points, max_triangles=50, tolerance=np.ones(600)))
        self.refuses(scarp.UsageError, "the points are a file", lambda: scarp.simplify_points("a.csv", 1, tolerance=np.ones(6)))

    def test_shapes_outliers_and_rectangles(self):
        random = np.random.default_rng(1)
        points = np.c_[random.random(2000) * 1000, random.random(2000) * 800, np.zeros(2000)]
        points[:, 2] = 300 + 40 * np.sin(points[:, 0] / 90) * np.cos(points[:, 1] / 70)
        points[5, 2] = 900
        mesh = scarp.simplify_points(points, 1, max_edge=60, despike=60)
        self.assertEqual(mesh.report.samples, 1999)
        corners = mesh.vertices[mesh.triangles][:, :, :2]
        self.assertLessEqual(np.hypot(*np.moveaxis(corners - np.roll(corners, 1, axis=1), 2, 0)).max(), 60)
        self.assertLess(scarp.measure(points, mesh).max_error, 1)
        with self.assertWarnsRegex(scarp.ScarpWarning, "min_angle 33: smaller angles are left"):
            scarp.simplify_points(points, 1, min_angle=33)

    def test_a_solid_and_the_objective_rms(self):
        points = survey()
        solid = scarp.simplify_points(points, 2, solid="size=100mm,thickness=2mm", of="stl")
        self.assertAlmostEqual(np.ptp(solid.vertices[:, :2], axis=0).max(), 100, places=2)
        self.assertLessEqual(scarp.measure(points, solid).max_error, 2)
        rmse = [scarp.measure(points, scarp.simplify_points(points, max_triangles=100, objective=of)).rmse for of in ("max", "rms")]
        self.assertLess(rmse[1], rmse[0])

    def test_degrees_become_metres_as_in_the_program(self):
        points = survey()
        mesh = scarp.simplify_points(points, 5, crs=4326)
        self.assertRegex(mesh.frame, "^local metres east and north of 8.0")
        wide, high = np.ptp(mesh.vertices[:, :2], axis=0)
        self.assertTrue(7000 < wide < 8000 and 10500 < high < 11500, (wide, high))
        self.assertLessEqual(scarp.measure(points, mesh, crs=4326).max_error, 5)
        with self.assertWarnsRegex(scarp.ScarpWarning, DEGREES):
            self.assertAlmostEqual(scarp.simplify_points(points, 5, crs=4326, frame="source").origin[0], 8.05, places=1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mesh = scarp.simplify_points(points, 5, frame="source")
            self.assertIn("no CRS", mesh.frame)
            mesh = scarp.simplify_points(survey(width=3000.0), 5, crs="EPSG:32632")
        self.assertEqual(mesh.crs, "EPSG:32632")
        local = scarp.simplify_points(survey(width=3000.0), 5, crs="EPSG:32632", frame="local")
        self.assertIn("local metres", local.frame)
        self.assertLess(abs(local.vertices[:, :2]).max(), 1501)
        self.assertEqual(scarp.measure(survey(width=3000.0), local, crs="EPSG:32632").uncovered, 0)

    def test_frames_that_points_cannot_have(self):
        points = survey()
        self.refuses(scarp.UsageError, "no CRS.*'local'.*give crs", lambda: scarp.simplify_points(points, 5, frame="local"))
        self.refuses(scarp.UsageError, "no grid", lambda: scarp.simplify_points(points, 5, crs=4326, frame="grid"))
        pole = points + [0, 89.95 - 46.05, 0]
        self.refuses(scarp.UsageError, "pole", lambda: scarp.simplify_points(pole + [0, 0.04, 0], 5, crs=4326))

    @unittest.skipUnless(scarp.has_gdal, "needs GDAL")
    def test_the_crs_is_one(self):
        points = survey()
        for crs in ("EPSG:99999", "garbage"):
            self.refuses(scarp.UsageError, "the CRS of points, '%s', is none that GDAL knows" % crs,
                         lambda: scarp.simplify_points(points, 5, crs=crs))
        mesh = scarp.simplify_points(points, 5, crs="EPSG:4326", frame="EPSG:32632")
        self.assertEqual(mesh.crs, "EPSG:32632")
        self.assertGreater(mesh.origin[1], 5e6)

    def test_options_of_files_are_refused_and_nodata_counts(self):
        points = survey()
        self.refuses(scarp.UsageError, "points are in memory", lambda: scarp.simplify_points(points, 5, class_="ground"))
        for option, value in (("columns", "pnezd"), ("z_field", "z"), ("layer", "a")):
            self.refuses(scarp.UsageError, "^%s is about files, and points are in memory" % option,
                         lambda: scarp.simplify_points(points, 5, **{option: value}))
        points[7, 2] = -9999
        with self.assertWarnsRegex(scarp.ScarpWarning, "exactly the height -9999.*nodata -9999 leaves it out"):
            scarp.simplify_points(points, 5)
        points[8, 2] = np.nan
        mesh = scarp.simplify_points(points, 5, nodata=-9999)
        self.assertEqual(mesh.report.samples, 298)
        self.assertEqual(scarp.measure(points, mesh).samples, 298)
        self.refuses(scarp.InputError, "2\\^53", lambda: scarp.simplify_points(points[:5].astype("i8") + 2**60, 5))

    def test_points_on_a_slanted_line_are_on_a_line(self):
        a = np.random.default_rng(1).random(50) * 100
        z = np.random.default_rng(2).random(50)
        noise = np.random.default_rng(4).random(50) * 1e-7
        for x, y in ((a, a), (a, 3 * a + 0.1), (a, -a / 7 + 1e-3), (5e5 + a, 5e6 + 0.3 * a), (5e5 + a, 5e6 + 0.3 * a + noise)):
            for more in ({}, {"of": "obj"}, {"max_triangles": 9}):
                self.refuses(scarp.InputError, "all points lie on one line",
                             lambda: scarp.simplify_points(np.c_[x, y, z], 0.1, **more))
        for width in (1e-6, 1e-5, 1e-4):
            try:
                scarp.simplify_points(np.c_[5e5 + a, 5e6 + 0.3 * a + noise * 1e7 * width, z], 0.1)
            except scarp.ScarpError as error:
                self.assertIn("all points lie on one line", str(error))
        for width in (1e-2, 1.0):  # a road is not one
            mesh = scarp.simplify_points(np.c_[5e5 + a, 5e6 + 0.3 * a + noise * 1e7 * width, z], 0.1)
            self.assertEqual(mesh.report.uncovered, 0)

    def test_meshes_are_judged_by_what_they_were_made_of(self):
        points = survey(2000, 0.0, 0.0, 100.0)
        mesh = scarp.simplify_points(points, 2)
        for one in (mesh, pickle.loads(pickle.dumps(mesh))):
            self.assertEqual(scarp.measure(points, one).samples, 2000)
            self.refuses(scarp.UsageError, r"not of \(2000, 4\): take three columns, as in points\[:, :3\]",
                         lambda: scarp.measure(np.c_[points, points[:, 0]], one))
        narrow = hills(40, 3)
        with self.assertWarnsRegex(scarp.ScarpWarning, r"\(40, 3\) is taken for a raster of 3 columns.*scarp.simplify_points"):
            raster = scarp.simplify(narrow, 0.5)
        for one in (raster, pickle.loads(pickle.dumps(raster)), raster.add_base(-100)):
            self.assertEqual(scarp.measure(narrow, one).samples, 120)
        self.assertEqual(scarp.measure(points[:41] / 50, raster, frame="source").samples, 41)
        refiner = scarp.Refiner(narrow)
        refiner.run(1)
        self.assertLessEqual(scarp.measure(narrow, refiner.mesh()).max_error, 1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            scarp.simplify(narrow[:5], 0.5)
            scarp.simplify(narrow, 0.5, transform=(0, 1, 0, 0, 0, -1))


@need("numpy")
class Arrays(unittest.TestCase):
    def refuses(self, kind, words, call):
        with self.assertRaisesRegex(kind, words) as caught:
            call()
        self.assertNotRegex(str(caught.exception), "gdal_|ogr2ogr|scarp simplify|--")

    def test_ways_out_are_those_of_python(self):
        z = hills()
        mesh = scarp.simplify(z, 1)
        self.refuses(scarp.UsageError, "heights has no georeference.*'EPSG:32611'.*give transform and crs",
                     lambda: scarp.simplify(z, 1, frame="EPSG:32611"))
        self.refuses(scarp.UsageError, "CRS such as 'EPSG:32611'" if not scarp.has_gdal else "give crs with",
                     lambda: scarp.simplify(z, 1, transform=(5, 1, 0, 5, 0, -1), frame="EPSG:32611"))
        for name in ("output", "out", "o"):
            self.refuses(scarp.UsageError, r"option %s is unknown.*mesh.write\(\)" % name,
                         lambda: scarp.simplify(z, 1, **{name: "x"}))
        self.refuses(scarp.UsageError, r"cannot tell the format from x.foo.*mesh.encode\(\)", lambda: mesh.write("x.foo"))
        self.refuses(scarp.UsageError, "path is empty", lambda: scarp.read_mesh(""))
        self.refuses(scarp.UsageError, "2147483648", lambda: scarp.simplify(z, 1, threads=2**31))
        self.refuses(scarp.UsageError, "is unknown$", lambda: scarp.simplify(z, 1, **{"x" * 100000: 1}))
        self.refuses(scarp.InputError, "larger unit first$", lambda: scarp.simplify(np.full((5, 5), 1e60), 1))

    def test_units_are_lengths(self):
        z = hills()
        for unit in ("garbage", "K", "parsec"):
            self.refuses(scarp.UsageError, "z_unit '%s' is no unit of length" % unit,
                         lambda: scarp.simplify(z, 1, z_unit=unit))
        self.assertLessEqual(scarp.simplify(z, 1, z_unit="ft").max_error, 1)

    def test_integers_that_float64_rounds_count_as_rounded(self):
        z = np.round(50 * np.sin(np.mgrid[0:60, 0:80][1] / 9)).astype("i8")
        self.refuses(scarp.PromiseError, "do not fit float32 and are rounded by up to 128;",
                     lambda: scarp.simplify(z + 2**60, 0.5))
        self.refuses(scarp.PromiseError, "rounded by up to", lambda: scarp.simplify((z + 2**60).astype("u8"), 0.5))
        self.refuses(scarp.PromiseError, "rounded by up to", lambda: scarp.simplify(-(z + 2**60), 0.5))
        self.assertLessEqual(scarp.simplify(z, 0.5).max_error, 0.5)
        self.assertLessEqual(scarp.simplify(z + 2**22, 0.5).max_error, 0.5)

    def test_pydelatin_names_the_base_as_it_was_given(self):
        from scarp.compat.pydelatin import Delatin
        self.refuses(ValueError, "base_height is -90, which puts the base at 90, and the lowest vertex is at",
                     lambda: Delatin(hills(), max_error=1, base_height=-90))
        self.assertEqual(Delatin(hills(), max_error=1, base_height=90).vertices[:, 2].min(), -90)


@need("numpy", "xarray")
class Coordinates(unittest.TestCase):
    def test_equal_coordinates_are_no_uneven_ones(self):
        import xarray
        z = xarray.DataArray(hills(5, 6), dims=("lat", "lon"), coords={"lat": [46.0] * 5, "lon": np.arange(6.0)})
        with self.assertRaisesRegex(scarp.InputError, r"lat .* is 46 everywhere.*drop_vars\(\['lat', 'lon'\]\)"):
            scarp.simplify(z, 1)
        self.assertLessEqual(scarp.simplify(z.drop_vars(["lat", "lon"]), 1).max_error, 1)


if __name__ == "__main__":
    unittest.main()
