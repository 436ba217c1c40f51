"""Scarp for Python, as it was installed. Parts that need a package that is not there are skipped.

SCARP_PROGRAM: the program, whose bytes are compared; SCARP_DEM: a raster. SCARP_SHARE=N: leaks are looked for with an
Nth of the calls.
"""
import array
import ctypes
import gc
import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest
import warnings
import weakref

import scarp
from scarp import _abi, _inputs

try:
    import numpy as np
except ImportError:
    np = None

PROGRAM = os.environ.get("SCARP_PROGRAM")
DEM = os.environ.get("SCARP_DEM")
SHARE = int(os.environ.get("SCARP_SHARE", "1"))  # of what is done many times, one in so many


def need(*modules):
    """Skips the test, aloud, where one of the modules is missing."""
    def can_import(name):
        try:
            __import__(name)
            return True
        except ImportError:
            return False
    missing = [name for name in modules if not can_import(name)]
    return unittest.skipIf(missing, "needs " + " and ".join(missing))


def hills(rows=120, cols=160, dtype="float32"):
    y, x = np.mgrid[0:rows, 0:cols]
    return (40 * np.sin(x / 15) * np.cos(y / 11) + (x * y) % 7).astype(dtype)


def plain_hills(rows, cols):
    """The same kind of thing without numpy: a memoryview of float32."""
    values = array.array("f", [float((3 * row * row + col * col) % 41) for row in range(rows) for col in range(cols)])
    return memoryview(values).cast("B").cast("f", (rows, cols))


def is_same(a, b):
    """Value by value: 0 and -0 are one."""
    if np is None:
        return a.offsets.tolist() == b.offsets.tolist() and bytes(a.triangles) == bytes(b.triangles)
    return np.array_equal(a.offsets, b.offsets) and np.array_equal(a.triangles, b.triangles)


class Library(unittest.TestCase):
    def test_structs_lie_as_in_the_library(self):
        self.assertTrue(_abi.is_layout_equal())
        self.assertRegex(scarp.__version__, r"^\d+\.\d+\.\d+$")

    def test_plain_buffers_do_without_numpy(self):
        mesh = scarp.simplify(plain_hills(50, 70), 2)
        self.assertLessEqual(mesh.max_error, 2)
        self.assertEqual((mesh.offsets.shape, mesh.triangles.shape), ((mesh.vertex_count, 3), (mesh.triangle_count, 3)))
        self.assertEqual(mesh.encode("glb")[:4], b"glTF")
        refiner = scarp.Refiner(plain_hills(50, 70))
        self.assertGreater(refiner.run(max_error=5), 0)
        self.assertLessEqual(refiner.max_error, 5)

    def test_a_view_keeps_the_mesh_alive(self):
        views = []
        for _ in range(50):
            views.append(scarp.simplify(plain_hills(40, 40), 4).triangles)
        gc.collect()
        self.assertEqual(len({bytes(view) for view in views}), 1)

    def test_errors_have_their_class_and_a_sentence(self):
        z = plain_hills(20, 20)
        mesh = scarp.simplify(z, 1)
        cases = [
            (scarp.UsageError, "no goal is given", lambda: scarp.simplify(z)),
            (scarp.UsageError, "did you mean effort", lambda: scarp.simplify(z, 1, efort="high")),
            (scarp.UsageError, "choose", lambda: scarp.simplify(z, 1, effort="hgih")),
            (scarp.UsageError, "is negative", lambda: scarp.simplify(z, -1)),
            (scarp.UsageError, "max_error", lambda: scarp.simplify(z, [1])),
            (scarp.UsageError, "at least 1", lambda: scarp.simplify(z, max_triangles=0)),
            (scarp.UsageError, "the program's alone", lambda: scarp.simplify(z, 1, report="r.json")),
            (scarp.UsageError, "fill_distance needs nodata_policy fill", lambda: scarp.simplify(z, 1, fill_distance=3)),
            (scarp.UsageError, "progress", lambda: scarp.simplify(z, 1, progress=3)),
            (scarp.UsageError, "array", lambda: scarp.simplify(None, 1)),
            (scarp.UsageError, "array", lambda: scarp.simplify(object(), 1)),
            (scarp.InputError, "2 x 2", lambda: scarp.simplify(plain_hills(1, 5), 1)),
            (scarp.InputError, "missing", lambda: scarp.simplify("missing.pgm", 1)),
            (scarp.PromiseError, "", lambda: scarp.measure(z, mesh, fail_above=1e-9)),
            (scarp.OutputError, "no/such", lambda: mesh.write("no/such/folder.glb")),
            (scarp.UsageError, "glb", lambda: mesh.encode("jpeg")),
            (scarp.Cancelled, "", lambda: scarp.simplify(plain_hills(600, 600), 0.5, effort="high",
                                                         progress=lambda progress: False)),
        ]
        for kind, words, call in cases:
            with self.assertRaises(kind) as caught:
                call()
            self.assertIn(words, str(caught.exception))
            self.assertTrue(str(caught.exception))
            self.assertTrue(issubclass(kind, scarp.ScarpError))
        self.assertTrue(issubclass(scarp.UsageError, ValueError) and issubclass(scarp.OutputError, OSError))

    def test_what_is_no_number_no_text_and_no_path_is_told_by_name(self):
        z = plain_hills(20, 20)
        mesh, refiner = scarp.simplify(z, 1), scarp.Refiner(z)
        cases = [("max_error", lambda: scarp.simplify(z, 10**400)), ("max_error", lambda: scarp.simplify(z, 1j)),
                 ("max_triangles", lambda: scarp.simplify(z, max_triangles="5")),
                 ("max_triangles", lambda: scarp.simplify(z, max_triangles=1.5)),
                 ("max_points", lambda: scarp.simplify(z, max_points=float("nan"))),
                 ("threads", lambda: scarp.simplify(z, 1, threads=None)), ("threads", lambda: scarp.simplify(z, 1, threads=-1)),
                 ("nodata", lambda: scarp.simplify(z, 1, nodata="none")),
                 ("transform", lambda: scarp.simplify(z, 1, transform=5)),
                 ("transform", lambda: scarp.simplify(z, 1, transform=(1, 2, 3, 4, 5, "six"))),
                 ("crs", lambda: scarp.simplify(z, 1, crs=4326)),
                 ("crs", lambda: scarp.simplify(z, 1, crs="a\0b", transform=(0, 1, 0, 0, 0, -1))),
                 ("null character", lambda: scarp.simplify("a\0b.pgm", 1)),
                 ("null character", lambda: scarp.simplify(z, 1, cutline="a\0b")),
                 ("null character", lambda: mesh.write("a\0b.glb")), ("null character", lambda: scarp.read_mesh("a\0b")),
                 ("null character", lambda: scarp.tile(z, "a\0b")), ("Unicode", lambda: scarp.read_mesh("\ud800.glb")),
                 ("path", lambda: mesh.write(3)), ("format", lambda: mesh.encode(3)), ("key", lambda: mesh.metadata(None)),
                 ("base", lambda: mesh.add_base("low")), ("breaklines", lambda: scarp.simplify(z, 1, breaklines={"a": 1})),
                 ("max_error", lambda: refiner.run(None)), ("max_vertices", lambda: refiner.run(max_vertices=-1))]
        for words, call in cases:
            with self.assertRaises(scarp.UsageError) as caught:
                call()
            self.assertIn(words, str(caught.exception))
        for path in (b"missing.pgm", "missing\udcff.pgm", "h\u00f6he.pgm"):
            with self.assertRaises(scarp.InputError):
                scarp.simplify(path, 1)
            with self.assertRaises(scarp.InputError):
                scarp.read_mesh(path)
        self.assertEqual(scarp.simplify(z, max_triangles=10**30).max_error, 0)
        self.assertLessEqual(scarp.simplify(z, max_points=40.0).vertex_count, 40)
        for make in (scarp.Mesh, scarp.Refiner, lambda: scarp.Mesh(None)):
            with self.assertRaises(TypeError):
                make()

    def test_progress_is_told_and_what_it_raises_comes_out(self):
        told = []
        scarp.simplify(plain_hills(300, 300), 0.5, effort="high", progress=told.append)
        self.assertTrue(told)
        self.assertTrue(all(0 <= step.fraction <= 1 and step.name for step in told))
        self.assertTrue(all(step.seconds_left is None or step.seconds_left >= 0 for step in told))
        self.assertEqual({step.tiles for step in told}, {0})

        # A progress function may simplify, too.
        inner = []
        z = plain_hills(300, 300)
        outer = scarp.simplify(z, 0.5, effort="high", of="obj",
                               progress=lambda _: inner.append(scarp.simplify(plain_hills(30, 30), 5)))
        self.assertTrue(inner)
        self.assertEqual(outer.encode(), scarp.simplify(z, 0.5, effort="high", of="obj").encode())

        class Own(BaseException):
            pass

        def bad(_):
            raise Own("of the callback")

        for _ in range(3):
            with self.assertRaises(Own):
                scarp.simplify(plain_hills(300, 300), 0.5, effort="high", progress=bad)

        # What it raised holds nothing in a circle.
        gc.collect()
        gc.disable()
        try:
            try:
                scarp.simplify(plain_hills(300, 300), 0.5, effort="high", progress=bad)
            except Own as error:
                alive = weakref.ref(error)
            self.assertIsNone(alive())
        finally:
            gc.enable()

    def test_a_refiner_is_watched_and_keeps_what_it_has(self):
        refiner = scarp.Refiner(plain_hills(300, 300))
        told = []
        self.assertGreater(refiner.run(max_error=8, progress=told.append), 0)
        self.assertEqual(told[0].name, "refine")
        count = refiner.vertex_count

        class Own(Exception):
            pass

        def bad(_):
            raise Own

        for kind, progress in ((scarp.Cancelled, lambda _: False), (Own, bad)):
            with self.assertRaises(kind):
                refiner.run(progress=progress)
        self.assertEqual(refiner.vertex_count, count)
        self.assertEqual(refiner.run(max_vertices=count + 5, progress=None), 5)
        with self.assertRaises(scarp.UsageError):
            refiner.run(progress=3)

    def test_nothing_leaks(self):
        z = plain_hills(33, 33)

        def resident():
            with open("/proc/self/statm") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")

        if not os.path.exists("/proc/self/statm"):
            self.skipTest("needs /proc")
        if "asan" in os.environ.get("LD_PRELOAD", ""):
            self.skipTest("needs memory that no sanitizer keeps")
        for _ in range(300):
            scarp.simplify(z, 8, effort="fast").triangles
        gc.collect()
        before = resident()
        for _ in range(10000 // SHARE):
            scarp.simplify(z, 8, effort="fast").triangles
        for _ in range(1000 // SHARE):
            scarp.Refiner(z).insert_worst()
        for _ in range(300):
            with self.assertRaises(scarp.UsageError):
                scarp.simplify(z, 1, fill_distance=3)
        gc.collect()
        self.assertLess(resident() - before, 2e6)

    def test_ctrl_c_ends_the_call_and_nothing_is_lost(self):
        script = textwrap.dedent("""
            import os, signal, sys, threading, time
            sys.path.insert(0, %r)
            import scarp
            from test_scarp import plain_hills
            z = plain_hills(1025, 1025)
            refiner = scarp.Refiner(z)
            threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            for call in (lambda: scarp.simplify(z, 0.25, effort="max", time_limit=60), refiner.run):
                try:
                    call()
                    print("finished")
                except KeyboardInterrupt:
                    print("interrupted", signal.getsignal(signal.SIGINT) is signal.default_int_handler)
                threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            try:
                time.sleep(30)
            except KeyboardInterrupt:
                print(refiner.vertex_count > 4)
        """ % os.path.dirname(os.path.abspath(__file__)))
        # pyproj, which the tests import by rioxarray, warns of its data in a virtual environment.
        done = subprocess.run([sys.executable, "-W", "ignore::UserWarning", "-c", script], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE)
        self.assertEqual(done.stdout.splitlines(), [b"interrupted True"] * 2 + [b"True"])
        self.assertEqual(done.stderr, b"")

    @unittest.skipUnless(hasattr(signal, "setitimer"), "needs setitimer")
    def test_what_a_handler_of_signals_raises_comes_out(self):
        class Alarm(BaseException):
            pass

        def ring(*_):
            raise Alarm

        z = plain_hills(1025, 1025)
        old = signal.signal(signal.SIGALRM, ring)
        try:
            for progress in (None, lambda step: None):
                signal.setitimer(signal.ITIMER_REAL, 0.3)
                with self.assertRaises(Alarm):
                    scarp.simplify(z, 0.25, effort="max", time_limit=60, progress=progress)
        finally:
            signal.signal(signal.SIGALRM, old)

    def test_other_threads_run_meanwhile(self):
        z = plain_hills(300, 300)
        count, stop = [0], threading.Event()

        def work():
            while not stop.is_set():
                count[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=work)
        thread.start()
        before = count[0]
        scarp.simplify(z, 0.5, effort="high")
        after = count[0]
        stop.set()
        thread.join()
        self.assertGreater(after, before + 3)

    def test_several_threads_make_the_same_mesh(self):
        z = plain_hills(200, 200)
        expected = scarp.simplify(z, 3)
        found = []
        threads = [threading.Thread(target=lambda: found.append(scarp.simplify(z, 3, threads=1))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([is_same(mesh, expected) for mesh in found], [True] * 4)

    @unittest.skipUnless(hasattr(os, "fork"), "needs fork")
    def test_a_fork_after_use_works(self):
        z = plain_hills(60, 60)
        expected = scarp.simplify(z, 3).triangle_count
        child = os.fork()
        if child == 0:
            os._exit(0 if scarp.simplify(z, 3).triangle_count == expected else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


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
        z[void] = 1e20  # whose rounding to float32 is a trillion
        mesh = scarp.simplify(np.ma.MaskedArray(z, void), 2)
        self.assertLessEqual(mesh.max_error, 2)
        self.assertEqual(mesh.report.samples, z.size - void.sum())

    def test_options_of_earlier_calls_do_not_stay(self):
        z = hills()
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

    def test_points(self):
        rng = np.random.RandomState(1)
        points = np.round(rng.rand(2000, 3) * (1000, 800, 0), 1)
        points[:, 2] = np.round(20 * np.sin(points[:, 0] / 90) + points[:, 1] / 50, 2)
        mesh = scarp.simplify_points(points, 1.5)
        self.assertLessEqual(mesh.max_error, 1.5)
        self.assertLess(mesh.vertex_count, 500)
        self.assertTrue({tuple(v) for v in np.round(mesh.vertices, 2)} <= {tuple(p) for p in np.round(points, 2)})
        self.assertEqual(scarp.measure(points, mesh, points=True).samples, 2000)
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
            with self.assertRaises(TypeError):
                import pickle
                pickle.dumps(mesh)

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
        script = "import scarp, test_scarp; scarp.simplify(test_scarp.hills(500, 500), 0.5, effort='high', progress=True)"
        done = subprocess.run([sys.executable, "-c", script], stderr=subprocess.PIPE, check=True,
                              cwd=os.path.dirname(os.path.abspath(__file__)))
        self.assertRegex(done.stderr, rb"refine: +\d+%\|")


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
            with self.assertRaises(scarp.InputError):
                scarp.simplify(dataset, 5, band=2)
            with tempfile.TemporaryDirectory() as folder:
                # A raster whose name is usual for points.
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
                    ("glb", ["-e", "5"], {"max_error": 5}),
                    ("obj", ["-e", "1%", "--effort", "high"], {"max_error": "1%", "effort": "high"}),
                    ("ply", ["-t", "2000", "--normals"], {"max_triangles": 2000, "normals": True}),
                    ("glb", ["-e", "5", "--compress"], {"max_error": 5, "compress": True}),
                    ("vtu", ["-e", "5", "--min-angle", "20"], {"max_error": 5, "min_angle": 20})):
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
