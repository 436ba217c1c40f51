"""Files and datasets: meshes and tiles equal the program's."""
import os
import subprocess
import tempfile
import unittest

import scarp
from fixtures import DEM, PROGRAM, is_same, need, np


@unittest.skipIf(np is None or not DEM, "needs numpy, and a raster in SCARP_DEM")
class Files(unittest.TestCase):
    def by_program(self, *arguments):
        subprocess.run([PROGRAM, "simplify", *arguments, "-q", "--overwrite"], check=True)

    @need("rasterio")
    def test_datasets(self):
        import rasterio
        with rasterio.open(DEM) as dataset:
            mesh = scarp.simplify(dataset, 5)
            self.assertTrue(is_same(mesh, scarp.simplify(dataset.read(1), 5, transform=dataset.transform,
                                                         crs=dataset.crs, nodata=dataset.nodata)))
            for kind, band in ((scarp.InputError, 2), (scarp.UsageError, "1"), (scarp.UsageError, 1.5)):
                with self.assertRaises(kind):
                    scarp.simplify(dataset, 5, band=band)
            with tempfile.TemporaryDirectory() as folder:
                with rasterio.open(os.path.join(folder, "new.tif"), "w", **dataset.profile) as other:
                    with self.assertRaises(scarp.InputError):
                        scarp.simplify(other, 5)
                # A raster with a name that is usual for points.
                points = os.path.join(folder, "dem.txt")
                with rasterio.open(points, "w", **{**dataset.profile, "driver": "GTiff"}) as other:
                    other.write(dataset.read())
                with rasterio.open(points) as other:
                    again = scarp.simplify(other, 5)
                    self.assertTrue(is_same(again, mesh))
                    self.assertEqual(scarp.measure(other, again).max_error, mesh.max_error)
        with self.assertRaises(scarp.InputError):
            scarp.simplify(dataset, 5)
        self.assertTrue(is_same(mesh, scarp.simplify(DEM, 5)))

    @need("rasterio")
    def test_scale_offset_unit_and_mask_of_a_dataset_count(self):
        import rasterio
        with rasterio.open(DEM) as dataset:
            z, profile = dataset.read(1), dataset.profile
        void = z > 1000
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "packed.tif")
            with rasterio.Env(GDAL_TIFF_INTERNAL_MASK=True), rasterio.open(path, "w", **{**profile, "nodata": None}) as other:
                other.write(z, 1)
                other.write_mask(~void)
                other.scales, other.offsets, other.units = (0.25,), (100.0,), ("m",)
            expected = scarp.simplify(np.where(void, np.nan, z * 0.25 + 100), 5, transform=profile["transform"], crs=profile["crs"])
            with rasterio.open(path) as other:
                mesh = scarp.simplify(other, 5)
                self.assertTrue(is_same(scarp.simplify(other, "5m"), mesh))
            self.assertTrue(is_same(mesh, expected))
            self.assertEqual(mesh.report.samples, int((~void).sum()))
            self.assertTrue(is_same(scarp.simplify(path, 5), mesh))

    @need("rioxarray", "rasterio")
    def test_rioxarray_tells_the_place_the_crs_and_the_voids(self):
        import rasterio
        import rioxarray
        with rasterio.open(DEM) as dataset, rioxarray.open_rasterio(DEM) as grid:
            expected = scarp.simplify(dataset, 5)
            mesh = scarp.simplify(grid, 5)
            self.assertTrue(is_same(mesh, expected) and mesh.origin == expected.origin and mesh.crs == expected.crs)
            void = int(grid.values.max())
            self.assertEqual(scarp.simplify(grid.rio.write_nodata(void), 5).report.samples,
                             int((grid.values != void).sum()))

    def test_a_path_is_read_by_something(self):
        def can_read():
            if scarp.has_gdal:
                return True
            for name in ("rasterio", "osgeo.gdal"):
                try:
                    __import__(name)
                    return True
                except ImportError:
                    pass
            return False
        if not can_read():
            with self.assertRaises(scarp.InputError) as caught:
                scarp.simplify(DEM, 5)
            self.assertIn("pip install rasterio", str(caught.exception))
            return
        mesh = scarp.simplify(DEM, 5)
        self.assertLessEqual(mesh.max_error, 5)
        self.assertLess(abs(mesh.vertices[:, :2]).max(), 20000)  # metres around the centre
        for missing in ("missing.tif", os.curdir):
            with self.assertRaises(scarp.InputError):
                scarp.simplify(missing, 5)
        if PROGRAM:
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "mesh.ply")
                self.by_program(DEM, path, "-e", "5")
                self.assertTrue(is_same(scarp.read_mesh(path), scarp.Mesh.from_arrays(mesh.vertices, mesh.triangles)))

    @unittest.skipUnless(PROGRAM and scarp.has_gdal, "needs SCARP_PROGRAM and a library with GDAL")
    def test_files_are_the_program_s_to_the_byte(self):
        with tempfile.TemporaryDirectory() as folder:
            for ending, arguments, options in (
                    ("glb", ["-e", "20"], {"max_error": 20}),
                    ("obj", ["-e", "3%", "--effort", "high"], {"max_error": "3%", "effort": "high"}),
                    ("ply", ["-t", "500", "--normals"], {"max_triangles": 500, "normals": True}),
                    ("glb", ["-e", "20", "--compress"], {"max_error": 20, "compress": True}),
                    ("vtu", ["-e", "20", "--min-angle", "20"], {"max_error": 20, "min_angle": 20})):
                path = os.path.join(folder, "mesh." + ending)
                self.by_program(DEM, path, *arguments)
                with open(path, "rb") as file:
                    self.assertEqual(scarp.simplify(DEM, of=ending, **options).encode(), file.read())

    @unittest.skipUnless(scarp.has_gdal, "needs a library with GDAL")
    @need("rasterio")
    def test_files_beside_an_array_are_read_as_beside_a_file(self):
        import rasterio
        examples = os.path.join(os.path.dirname(DEM), "examples")
        with rasterio.open(DEM) as dataset:
            z, transform, crs = dataset.read(1), dataset.transform, dataset.crs
        for options in ({"breaklines": "dikes.geojson"}, {"cutline": "parcel.geojson"}, {"water": "lakes.geojson"},
                        {"nodata_policy": "fill"}, {"solid": "size=120mm", "of": "stl"}):
            named = {name: os.path.join(examples, value) if value.endswith("json") else value
                     for name, value in options.items()}
            expected = scarp.simplify(DEM, 30, **named)
            mesh = scarp.simplify(z, 30, transform=transform, crs=crs, **named)
            self.assertTrue(is_same(mesh, expected) and mesh.origin == expected.origin, options)
        with self.assertRaises(scarp.UsageError):
            scarp.simplify(z, 30, transform=transform, crs="EPSG:99999")
        with self.assertRaises(scarp.UsageError) as caught:
            scarp.simplify(DEM, 30, te=[1, 2, 3])
        self.assertIn("XMIN", str(caught.exception))

    @unittest.skipUnless(scarp.has_gdal, "needs a library with GDAL")
    def test_tiles(self):
        tiles = scarp.Tiles(DEM, vertical="ellipsoid", zoom=11)
        self.assertEqual(tiles.max_level, 11)
        x, y = tiles.list(11)[0]
        data, bound = tiles.read_with_bound(11, x, y)
        self.assertEqual(data[:2], b"\x1f\x8b")
        self.assertGreater(bound, 0)
        self.assertIn(b"quantized-mesh", tiles.layer_json())
        with self.assertRaises(scarp.InputError):
            tiles.read(11, 0, 0)

    @unittest.skipUnless(PROGRAM and scarp.has_gdal, "needs SCARP_PROGRAM and a library with GDAL")
    @need("rasterio")
    def test_whole_sets_of_tiles_are_the_program_s_to_the_byte(self):
        import rasterio

        def files_of(folder):
            found = {}
            for place, _, names in os.walk(folder):
                for name in names:
                    with open(os.path.join(place, name), "rb") as file:
                        found[os.path.relpath(os.path.join(place, name), folder)] = file.read()
            return found

        with rasterio.open(DEM) as dataset:
            z, transform, crs = dataset.read(1), dataset.transform, dataset.crs
        with tempfile.TemporaryDirectory() as folder:
            expected, made, packed = (os.path.join(folder, name) for name in ("program", "made", "one.pmtiles"))
            subprocess.run([PROGRAM, "tile", DEM, expected, "--vertical", "egm96", "--zoom", "9", "-q"], check=True)
            told = []
            report = scarp.tile(DEM, made, vertical="egm96", zoom=9, progress=told.append)
            self.assertEqual(files_of(made), files_of(expected))
            self.assertEqual((report["max_zoom"], len(report["levels"])), (9, 10))
            self.assertEqual(sum(level["tiles"] for level in report["levels"]),
                             sum(name.endswith(".terrain") for name in files_of(made)))
            self.assertIn("tiles", {step.name for step in told})
            counts = [(step.tiles, step.bytes) for step in told if step.name == "tiles"]
            self.assertEqual(counts, sorted(counts))
            self.assertTrue(0 < counts[-1][0] <= sum(level["tiles"] for level in report["levels"]))
            self.assertGreater(counts[-1][1], 0)
            scarp.tile([DEM, DEM], packed, vertical="egm96", zoom=9, threads=1)
            with self.assertRaises(scarp.OutputError):
                scarp.tile(DEM, packed, vertical="egm96", zoom=9)
            scarp.tile(DEM, packed, vertical="egm96", zoom=8, of="3dtiles", overwrite=True)
            tiles = {name: data for name, data in files_of(made).items() if name.endswith(".terrain")}
            scarp.tile(z, made, transform=transform, crs=crs, vertical="egm96", zoom=9, overwrite=True)
            self.assertEqual({name: files_of(made)[name] for name in tiles}, tiles)

            class Own(Exception):
                pass

            def bad(_):
                raise Own
            never = os.path.join(folder, "never")
            for kind, options in ((scarp.Cancelled, {"progress": lambda _: False}), (Own, {"progress": bad}),
                                  (scarp.UsageError, {"vertical": "egm97"}), (scarp.UsageError, {"cutline": "a"}),
                                  (scarp.InputError, {"breaklines": "a"}), (scarp.UsageError, {"report": "r.json"}),
                                  (scarp.UsageError, {"transform": transform})):
                with self.assertRaises(kind):
                    scarp.tile([DEM], never, **{"vertical": "egm96", "zoom": 9, **options})
            with self.assertRaises(scarp.InputError):
                scarp.tile(["missing.tif"], never, vertical="egm96")
            with self.assertRaises(scarp.InputError):
                scarp.tile(np.full((9, 9), np.nan), never, transform=transform, crs=crs, vertical="egm96")
            self.assertEqual(sorted(os.listdir(folder)), ["made", "one.pmtiles", "program"])
