"""Arrays of numpy as input and output, and arrays of other packages."""
import gc
import os
import subprocess
import sys
import tempfile
import unittest
import warnings

import scarp
from scarp import _abi, _inputs
from fixtures import hills, is_same, need, np


@unittest.skipIf(np is None, "needs numpy")
class Arrays(unittest.TestCase):
    def test_float32_is_not_copied_either_way(self):
        z = hills()
        self.assertEqual(_inputs.read(z).field.samples, z.ctypes.data)
        mesh = scarp.simplify(z, 2)
        self.assertEqual(mesh.offsets.ctypes.data, _abi.lib.scarp_mesh_positions(mesh._handle))
        self.assertEqual(mesh.triangles.ctypes.data, _abi.lib.scarp_mesh_triangles(mesh._handle))
        for view, dtype in ((mesh.offsets, np.float64), (mesh.triangles, np.uint32)):
            self.assertFalse(view.flags.owndata)
            self.assertEqual(view.dtype, dtype)
            with self.assertRaises(ValueError):
                view[0, 0] = 1
        view, expected = mesh.offsets, mesh.offsets.copy()
        del mesh
        gc.collect()
        self.assertTrue(np.array_equal(view, expected))

    def test_python_takes_next_to_nothing_of_its_own(self):
        import tracemalloc
        z = hills(1024, 1024)
        tracemalloc.start()
        scarp.simplify(z, 30, effort="fast")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        self.assertLess(peak, 0.05 * z.nbytes)

    def test_layouts_and_types_make_the_same_mesh(self):
        z = np.round(hills())
        expected = scarp.simplify(z, 2)
        wide = np.zeros((z.shape[0], 2 * z.shape[1]), np.float32)
        wide[:, ::2] = z
        for other in (wide[:, ::2], np.asfortranarray(z), z.astype(">f4"), z.astype("f8"), z.astype("i2"),
                      z.astype("i8"), z.astype("f2"), z[::-1][::-1], z.tolist(), memoryview(z)):
            self.assertTrue(is_same(scarp.simplify(other, 2), expected))
        locked = z.copy()
        locked.flags.writeable = False
        self.assertTrue(is_same(scarp.simplify(locked, 2), expected))

    def test_rounding_of_doubles_is_kept_in_reserve(self):
        z = hills(dtype="float64") / 3 + 1e5
        read = _inputs.read(z)
        self.assertEqual(read.field.sample_rounding, np.abs(z - z.astype("f4")).max())
        self.assertEqual(_inputs.read(z[:, ::2]).field.sample_rounding, np.abs(z - z.astype("f4"))[:, ::2].max())
        with_infinity = z.copy()
        with_infinity[5, 5:8] = np.inf, np.nan, -1e300
        self.assertEqual(_inputs.read(with_infinity[:, ::-1]).field.sample_rounding,
                         _inputs.read(with_infinity).field.sample_rounding)
        mesh = scarp.simplify(z, 0.5)
        at = mesh.report.max_error_at
        self.assertIsNotNone(at)
        self.assertLessEqual(mesh.max_error + read.field.sample_rounding, 0.5 + 1e-9)

    def test_voids_are_voids_however_they_are_told(self):
        z = hills()
        void = np.zeros(z.shape, bool)
        void[30:50, 40:90] = True
        with_nan = np.where(void, np.float32(np.nan), z)
        expected = scarp.simplify(with_nan, 2)
        self.assertLess(expected.report.samples, z.size)
        with self.assertWarns(scarp.ScarpWarning):
            infinite = scarp.simplify(np.where(void, np.inf, z), 2)
        others = [scarp.simplify(np.ma.MaskedArray(z, void), 2), infinite,
                  scarp.simplify(np.where(void, np.float32(-9999), z), 2, nodata=-9999)]
        self.assertEqual([is_same(other, expected) for other in others], [True] * 3)
        self.assertFalse(np.isnan(z).any())

    def test_arrays_of_the_wrong_kind_are_refused(self):
        z = hills()
        cases = [(scarp.UsageError, z.astype(object)), (scarp.UsageError, z.astype("c8")),
                 (scarp.UsageError, z.astype(str)), (scarp.UsageError, z > 0), (scarp.UsageError, z[None]),
                 (scarp.UsageError, z[0]), (scarp.UsageError, np.float32(3)), (scarp.UsageError, [[1, 2], [3]]),
                 (scarp.UsageError, [["a", "b"]]), (scarp.InputError, z[:0]), (scarp.InputError, z[:, :1]),
                 (scarp.InputError, np.full((9, 9), np.nan)), (scarp.InputError, np.ma.masked_all((9, 9), "f4")),
                 (scarp.InputError, np.broadcast_to(np.float32(0), (2, 2**31)))]
        for kind, source in cases:
            with self.assertRaises(kind):
                scarp.simplify(source, 1)
        for kind, mask in ((scarp.UsageError, z[1:]), (scarp.InputError, -np.ones(z.shape))):
            with self.assertRaises(kind):
                scarp.simplify(z, 1, mask=mask)

    def test_every_function_refuses_them(self):
        z = hills(20, 30)
        mesh = scarp.simplify(z, 2)
        bad = [(scarp.UsageError, z.astype(object)), (scarp.UsageError, z[None]), (scarp.UsageError, z > 0),
               (scarp.InputError, z[:0]), (scarp.InputError, np.full((9, 9), np.nan))]
        for call in (lambda source: scarp.simplify(source, 1), scarp.Refiner, lambda source: scarp.measure(source, mesh)):
            for kind, source in bad:
                with self.assertRaises(kind) as caught:
                    call(source)
                self.assertTrue(str(caught.exception))

    def test_what_a_progress_function_raises_comes_out_of_every_function(self):
        class Own(Exception):
            pass

        def bad(_):
            raise Own

        z = hills(300, 300)
        mesh = scarp.simplify(z, 5)
        rng = np.random.RandomState(1)
        points = rng.rand(20000, 3) * (1000, 1000, 20)
        for no in (False, np.bool_(False)):
            with self.assertRaises(scarp.Cancelled):
                scarp.simplify(z, 0.5, effort="high", progress=lambda _, no=no: no)
        for call in (lambda: scarp.simplify(z, 0.5, effort="high", progress=bad), lambda: scarp.measure(z, mesh, progress=bad),
                     lambda: scarp.simplify_points(points, 0.5, progress=bad)):
            with self.assertRaises(Own):
                call()

    def test_masks_and_tolerances_are_arrays(self):
        z = hills()
        plain = scarp.simplify(z, 2)
        mask = np.ones(z.shape)
        mask[:, 80:] = 0.1
        self.assertLess(scarp.simplify(z, 2, mask=mask).triangle_count, plain.triangle_count)
        bounds = np.full(z.shape, 2.0)
        bounds[:40] = 0.5
        fine = scarp.simplify(z, tolerance=bounds)
        self.assertGreater(fine.triangle_count, plain.triangle_count)
        self.assertEqual(scarp.measure(z, fine, tolerance=bounds).over, 0)
        with self.assertRaises(scarp.PromiseError):
            scarp.measure(z, plain, tolerance=bounds)

    def test_measure_agrees_with_the_proof_and_with_plain_arrays(self):
        z = hills()
        mesh = scarp.simplify(z, 2)
        proof, again = mesh.report, scarp.measure(z, mesh.vertices, mesh.triangles)
        self.assertEqual((proof.max_error, proof.samples, proof.max_error_at),
                         (again.max_error, again.samples, again.max_error_at))
        self.assertIsNone(again.effort)
        self.assertEqual(proof.effort, "normal")
        for bad in (lambda: scarp.Mesh.from_arrays(mesh.vertices, mesh.triangles + np.uint32(mesh.vertex_count)),
                    lambda: scarp.Mesh.from_arrays(mesh.vertices[:, :2], mesh.triangles),
                    lambda: scarp.Mesh.from_arrays(mesh.vertices, mesh.triangles.astype("f4")),
                    lambda: scarp.measure(z, "mesh.glb"), lambda: scarp.Mesh.from_arrays(mesh.vertices, -1 - mesh.triangles.astype("i8"))):
            with self.assertRaises((scarp.UsageError, scarp.InputError)):
                bad()

    def test_transforms_speak_of_pixel_corners(self):
        z = hills()
        mesh = scarp.simplify(z, 2, transform=(500000, 30, 0, 4000000, 0, -30), crs="EPSG:32611")
        low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
        self.assertEqual((low[0], high[1]), (500015, 4000000 - 15))
        self.assertEqual((high[0], low[1]), (500015 + 30 * 159, 4000000 - 15 - 30 * 119))
        self.assertEqual(mesh.crs, "EPSG:32611")
        local = scarp.simplify(z, 2, transform=(500000, 30, 0, 4000000, 0, -30), crs=32611, frame="local")
        self.assertLess(abs(local.vertices[:, 0]).max(), 30 * 161)
        grid = scarp.simplify(z, 2, transform=(500000, 30, 0, 4000000, 0, -30), frame="grid")
        self.assertEqual(grid.vertices[:, 1].max(), 119)
        degrees = scarp.simplify(z, 2, transform=(8, 1 / 3600, 0, 46, 0, -1 / 3600), crs="EPSG:4326")
        width = np.ptp(degrees.vertices[:, 0])
        self.assertTrue(3300 < width < 3500, width)  # 159 seconds of arc at 46 degrees north, in metres
        self.assertEqual(scarp.measure(z, mesh, transform=(500000, 30, 0, 4000000, 0, -30), crs="EPSG:32611").max_error,
                         mesh.max_error)
        with self.assertRaises(scarp.UsageError):
            scarp.simplify(z, 2, transform=(1, 2, 3))
        with self.assertRaises(scarp.InputError):
            scarp.simplify(z, 2, transform=(0, 0, 0, 0, 0, 0))

    def test_what_lies_below_a_mask_does_not_count(self):
        z = hills(dtype="float64")
        void = np.zeros(z.shape, bool)
        void[30:50, 40:90] = True
        z[void] = 1e20  # its rounding to float32 is a trillion
        mesh = scarp.simplify(np.ma.MaskedArray(z, void), 2)
        self.assertLessEqual(mesh.max_error, 2)
        self.assertEqual(mesh.report.samples, z.size - void.sum())

    def test_options_of_earlier_calls_do_not_stay(self):
        z = hills(60, 80)
        asked = [{"max_error": error, **more} for error in (2, 3.5, "2%")
                 for more in ({}, {"effort": "high"}, {"normals": True}, {"max_triangles": 200}, {"threads": 1})]
        first = [scarp.simplify(z, **options) for options in asked]
        again = [scarp.simplify(z, **options) for options in reversed(asked)]
        self.assertTrue(all(is_same(a, b) for a, b in zip(first, reversed(again))))
        self.assertGreater(len({mesh.triangle_count for mesh in first}), 5)
        for options in ({"fill_distance": 3}, {"effort": "hgih"}, {"of": "dem"}):
            for _ in range(2):
                with self.assertRaises(scarp.UsageError):
                    scarp.simplify(z, 2, **options)
        with self.assertRaises(scarp.UsageError):
            scarp.simplify(z)

    def test_options_by_name(self):
        z = hills()
        plain = scarp.simplify(z, 2)
        shaped = scarp.simplify(z, 2, min_angle=20, normals=True, uvs=True)
        self.assertGreater(shaped.triangle_count, plain.triangle_count)
        self.assertEqual((shaped.normals.shape, shaped.uvs.shape),
                         ((shaped.vertex_count, 3), (shaped.vertex_count, 2)))
        self.assertIsNone(plain.normals)
        relief = float(z.max() - z.min())
        self.assertTrue(is_same(scarp.simplify(z, "2%"), scarp.simplify(z, 0.02 * relief)))
        few = scarp.simplify(z, max_triangles=500)
        self.assertTrue(few.triangle_count <= 500 and few.report.stop == "max_triangles")
        self.assertLess(scarp.simplify(z, 2, effort="high").triangle_count, plain.triangle_count)
        solid = scarp.simplify(z, 2, base=-200)
        self.assertEqual(solid.vertices[:, 2].min(), -200)
        self.assertGreater(plain.add_base(-200).triangle_count, plain.triangle_count)

    def test_warnings_are_warnings(self):
        z = hills()
        z[0, 0] = np.inf
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            scarp.simplify(z, 2)
        self.assertEqual([w.category for w in caught], [scarp.ScarpWarning])
        self.assertIn("infinite", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)
        with self.assertWarnsRegex(scarp.ScarpWarning, r"\(cell_size\).*\(z_scale\)"):
            scarp.simplify(hills() * 100, 200)

    def test_points(self):
        rng = np.random.RandomState(1)
        points = np.round(rng.rand(2000, 3) * (1000, 800, 0), 1)
        points[:, 2] = np.round(20 * np.sin(points[:, 0] / 90) + points[:, 1] / 50, 2)
        mesh = scarp.simplify_points(points, 1.5)
        self.assertLessEqual(mesh.max_error, 1.5)
        self.assertLess(mesh.vertex_count, 500)
        self.assertTrue({tuple(v) for v in np.round(mesh.vertices, 2)} <= {tuple(p) for p in np.round(points, 2)})
        # By its help: rows of three are points, unless something identifies a raster.
        proof = mesh.report
        for given in (points, points.tolist(), np.asfortranarray(points)):
            report = scarp.measure(given, mesh)
            self.assertEqual((report.samples, report.max_error, report.uncovered), (2000, proof.max_error, 0))
        self.assertEqual(mesh.measure(points, points=True)._replace(seconds=0), report._replace(seconds=0))
        narrow = hills(40, 3)
        with self.assertWarnsRegex(scarp.ScarpWarning, "raster of 3 columns"):
            raster = scarp.simplify(narrow, 2)
        place = (-0.5, 1, 0, 39.5, 0, -1)
        for more in ({"points": False}, {"transform": place}, {"nodata": -9999}, {"mask": np.ones((40, 3))}):
            self.assertEqual(scarp.measure(narrow, raster, **more).samples, 120)
        for more in ({"points": True, "nodata": 0}, {"points": True, "transform": place}):
            with self.assertRaisesRegex(scarp.UsageError, "is for rasters"):
                scarp.measure(points, mesh, **more)
        with self.assertRaisesRegex(scarp.UsageError, "a file holds"):
            scarp.measure("survey.csv", mesh, points=True)
        masked = np.ma.MaskedArray(points)
        masked[::2, 2] = np.ma.masked
        masked.data[::2, 2] = 1e6
        self.assertTrue(is_same(scarp.simplify_points(masked, 1.5), scarp.simplify_points(points[1::2], 1.5)))
        for kind, bad in ((scarp.InputError, points[:2]), (scarp.UsageError, points[:, :2]),
                          (scarp.UsageError, points.astype(object)), (scarp.InputError, points * np.nan), (scarp.InputError, points[:0]),
                          (scarp.UsageError, None), (scarp.UsageError, [[1, 2, 3], [4]])):
            with self.assertRaises(kind):
                scarp.simplify_points(bad, 1)

    def test_refiner_goes_on(self):
        z = hills()
        refiner = scarp.Refiner(z)
        errors = []
        for error in refiner:
            errors.append(error)
            if error < 20:
                break
        self.assertEqual(errors[-1], refiner.max_error)
        count = refiner.vertex_count
        self.assertEqual(refiner.run(max_vertices=count + 7), 7)
        refiner.run(max_error=2)
        mesh = refiner.mesh()
        self.assertAlmostEqual(scarp.measure(z, mesh).max_error, refiner.max_error, places=9)
        with self.assertRaises(scarp.UsageError):
            mesh.max_error
        with self.assertRaises(scarp.UsageError):
            scarp.Refiner(z[0])

    def test_an_option_may_be_an_array(self):
        points = np.random.default_rng(1).random((50, 3))
        for words, call in (("mask is for rasters", lambda: scarp.simplify_points(points, 1, mask=np.ones(50))),
                            ("min_angle takes a number", lambda: scarp.simplify(hills(), 1, min_angle=np.ones((2, 2))))):
            with self.assertRaisesRegex(scarp.UsageError, words):
                call()

    def test_files_of_a_mesh(self):
        mesh = scarp.simplify(hills(), 2)
        with tempfile.TemporaryDirectory() as folder:
            for ending in ("glb", "obj", "ply", "stl", "2dm", "vtu"):
                path = os.path.join(folder, "mesh." + ending)
                mesh.write(path)
                self.assertEqual(scarp.read_mesh(path).triangle_count, mesh.triangle_count)
                with open(path, "rb") as file:
                    self.assertEqual(file.read(), mesh.encode(ending))
            with self.assertRaises(scarp.OutputError):
                mesh.write(path, overwrite=False)
            mesh.write(path, overwrite=np.bool_(True))

    def test_a_mesh_is_copied_and_sent_whole(self):
        import copy
        import pickle
        z = hills()
        for options in ({}, {"normals": True, "uvs": True, "of": "obj"}, {"base": -100}, {"of": "glb", "compress": True}):
            mesh = scarp.simplify(z, 2, transform=(500000, 30, 0, 4000000, 0, -30), crs="EPSG:32611", **options)
            copies = [copy.copy(mesh), copy.deepcopy(mesh), *(pickle.loads(pickle.dumps(mesh, k)) for k in range(2, 6))]
            for other in copies:
                self.assertTrue(is_same(other, mesh) and other.origin == mesh.origin)
                self.assertEqual((other.report, other.encode(), other.crs), (mesh.report, mesh.encode(), mesh.crs))
                self.assertEqual(other.normals is None, mesh.normals is None)
        bare = scarp.Mesh.from_arrays(mesh.vertices, mesh.triangles)
        self.assertTrue(is_same(pickle.loads(pickle.dumps(bare)), bare))
        with self.assertRaises(scarp.UsageError):
            pickle.loads(pickle.dumps(bare)).report
        unpack, (packed, *place) = mesh.__reduce__()
        for damaged in (b"", b"scarp", packed[:-1], packed + b"1", packed[:200]):
            with self.assertRaises(scarp.InputError):
                unpack(damaged, *place)
        for other in (scarp.Refiner(z), pickle):
            with self.assertRaises(TypeError):
                pickle.dumps(other)

    def test_other_processes_send_meshes(self):
        from concurrent.futures import ProcessPoolExecutor
        import multiprocessing
        bounds = [2, 3, 5]
        with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
            meshes = list(pool.map(scarp.simplify, [hills()] * 3, bounds))
        self.assertTrue(all(is_same(mesh, scarp.simplify(hills(), bound)) for mesh, bound in zip(meshes, bounds)))
        self.assertEqual([mesh.max_error <= bound for mesh, bound in zip(meshes, bounds)], [True] * 3)

    def test_delatin(self):
        from scarp.compat.pydelatin import Delatin
        z = hills()
        tin = Delatin(z, max_error=2, z_scale=2)
        self.assertLessEqual(tin.error, 2)
        self.assertEqual((tin.vertices.dtype, tin.triangles.dtype), (np.float32, np.uint32))
        x, y = tin.vertices[:, 0].astype(int), tin.vertices[:, 1].astype(int)
        self.assertTrue(np.array_equal(tin.vertices[:, 2], 2 * z[119 - y, x]))
        flat = Delatin(z.ravel(), height=120, width=160, max_error=2)
        self.assertEqual(len(flat.triangles), len(tin.triangles))
        self.assertGreater(len(Delatin(z, max_error=2, base_height=100).triangles), len(tin.triangles))
        self.assertLessEqual(len(Delatin(z, max_triangles=300).triangles), 300)
        self.assertLessEqual(Delatin(z, level=True, invert=True, max_error=0.05).vertices[:, 2].max(), 1)
        with self.assertRaises(NotImplementedError):
            Delatin(z, blur=2)
        with self.assertRaisesRegex(ValueError, "give height and width"):
            Delatin(z.ravel())
        # Used as in scripts: no warning, and arrays that belong to the caller.
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            steep = Delatin(100 * z, max_error=200)
        steep.vertices[:, 2] += 1
        steep.triangles[:] = steep.triangles[:, ::-1]

    def test_delatin_s_helpers(self):
        from scarp.compat.pydelatin import Delatin
        from scarp.compat.pydelatin.util import decode_ele, latitude_adjustment, rescale_positions
        z = np.round(hills(), 1).astype("f8")
        for encoding, steps in (("mapbox", np.round((z + 10000) * 10)), ("terrarium", np.round((z + 32768) * 256))):
            number = steps.astype("u4")
            png = np.stack([number >> 16, number >> 8 & 255, number & 255, 0 * number + 255], axis=-1).astype("u1")
            for given in (png, png[..., :3], np.moveaxis(png, -1, 0)):
                self.assertLess(abs(decode_ele(given, encoding) - z).max(), 0.002)
        with self.assertRaisesRegex(ValueError, "mapbox, terrarium"):
            decode_ele(png, "geotiff")
        tin = Delatin(z, max_error=2)
        placed = rescale_positions(tin.vertices, (10, 20, 30, 50))
        self.assertEqual((placed.min(axis=0)[:2].tolist(), placed.max(axis=0)[:2].tolist()), ([10, 20], [30, 50]))
        self.assertTrue(np.array_equal(placed[:, 2], tin.vertices[:, 2]))
        turned = rescale_positions(tin.vertices, (10, 20, 30, 50), flip_y=True)
        self.assertTrue(np.allclose(turned[:, 1], 70 - placed[:, 1], atol=1e-4))
        self.assertAlmostEqual(latitude_adjustment(60), 0.5)

    @need("PIL")
    def test_a_script_for_pydelatin_needs_its_import_changed_only(self):
        from PIL import Image
        script = """
from sys import argv
import numpy as np
from PIL import Image
from pydelatin import Delatin
from pydelatin.util import decode_ele
terrain = decode_ele(np.asarray(Image.open(argv[1])), 'mapbox')
for error in (30, 10, 5):
    tin = Delatin(terrain, max_error=error)
    assert tin.error <= error
    print(error, tin.vertices.shape[0], tin.triangles.shape[0])
"""
        number = np.round((hills() * 10 + 10000) * 10).astype("u4")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "tile.png")
            Image.fromarray(np.stack([number >> 16, number >> 8 & 255, number & 255], axis=-1).astype("u1")).save(path)
            done = subprocess.run([sys.executable, "-W", "error", "-c", script.replace("from pydelatin", "from scarp.compat.pydelatin"), path],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.stderr, b"")
        self.assertEqual(len(done.stdout.splitlines()), 3)

    @need("meshio")
    def test_to_meshio(self):
        mesh = scarp.simplify(hills(), 2)
        other = mesh.to_meshio()
        self.assertTrue(np.array_equal(other.points, mesh.vertices))
        self.assertTrue(np.array_equal(other.cells_dict["triangle"], mesh.triangles))

    @need("trimesh")
    def test_to_trimesh(self):
        mesh = scarp.simplify(hills(), 2)
        other = mesh.to_trimesh()
        self.assertTrue(np.array_equal(other.faces, mesh.triangles) and np.array_equal(other.vertices, mesh.vertices))

    @need("pyvista")
    def test_to_pyvista(self):
        mesh = scarp.simplify(hills(), 2)
        other = mesh.to_pyvista()
        self.assertEqual((other.n_points, other.n_cells), (mesh.vertex_count, mesh.triangle_count))

    @need("geopandas", "shapely")
    def test_to_geopandas(self):
        mesh = scarp.simplify(hills(), 2, transform=(500000, 30, 0, 4000000, 0, -30), crs="EPSG:32611")
        frame = mesh.to_geopandas()
        self.assertEqual(len(frame), mesh.triangle_count)
        self.assertAlmostEqual(frame.area.sum(), 159 * 119 * 900.0, places=3)
        self.assertEqual(frame.crs.to_epsg(), 32611)

    @need("matplotlib")
    def test_plot(self):
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        mesh = scarp.simplify(hills(), 8)
        axes = mesh.plot(plt.figure().gca())
        self.assertEqual(len(axes.collections), 1)
        self.assertEqual(len(axes.collections[0].get_array()), mesh.triangle_count)
        plt.close("all")

    @need("xarray")
    def test_xarray_has_coordinates(self):
        import xarray
        z = hills()
        x, y = 500015.0 + 30 * np.arange(160), 4000000.0 - 15 - 30 * np.arange(120)
        grid = xarray.DataArray(z, dims=("y", "x"), coords={"y": y, "x": x}, name="dem")
        mesh = scarp.simplify(grid, 2)
        expected = scarp.simplify(z, 2, transform=(500000, 30, 0, 4000000, 0, -30))
        self.assertTrue(is_same(mesh, expected) and mesh.origin == expected.origin)
        south_up = scarp.simplify(grid[::-1], 2)
        self.assertTrue(is_same(south_up, expected) and south_up.origin == expected.origin)
        with self.assertRaises(scarp.InputError):
            scarp.simplify(grid.assign_coords(x=x**2), 2)
        with self.assertRaises(scarp.UsageError):
            scarp.simplify(grid.expand_dims(time=3), 2)

    @need("tqdm")
    def test_progress_is_a_bar_of_tqdm(self):
        script = "import scarp, fixtures; scarp.simplify(fixtures.hills(300, 300), 0.5, effort='high', progress=True)"
        done = subprocess.run([sys.executable, "-c", script], stderr=subprocess.PIPE, check=True,
                              cwd=os.path.dirname(os.path.abspath(__file__)))
        self.assertRegex(done.stderr, rb"refine: +\d+%\|")
