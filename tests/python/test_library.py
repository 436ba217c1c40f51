"""Scarp for Python without numpy: the library, its errors, progress, signals, threads and memory."""
import copy
import gc
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
import unittest
import weakref

import scarp
from scarp import _abi
from fixtures import SHARE, is_same, plain_hills


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

    def test_volumes_are_those_of_two_meshes_or_of_a_level(self):
        z = plain_hills(50, 70)
        coarse, fine = scarp.simplify(z, 5), scarp.simplify(z, 0.5)
        forth, back = scarp.volume(coarse, fine, threads=1), scarp.volume(fine, coarse)
        self.assertEqual((forth.cut, forth.fill, forth.net), (back.fill, back.cut, -back.net))
        self.assertAlmostEqual(forth.common_area, 49 * 69, places=9)
        self.assertAlmostEqual(forth.uncertainty, (coarse.max_error + fine.max_error) * forth.common_area)
        self.assertEqual(scarp.volume(fine, fine)[:3], (0, 0, 0))
        above, below = scarp.volume(fine, -2000), scarp.volume(-2000, fine)
        self.assertEqual((above.cut, above.fill, above.before_outside), (below.fill, 0, 0))
        self.assertGreater(above.cut, 0)
        self.assertLess(above.uncertainty, 0.5 * 49 * 69 + 1e-9)
        for kind, words, before, after in ((scarp.InputError, "the second mesh is a closed solid", fine, fine.add_base(-3000)),
                                           (scarp.UsageError, "both surfaces are levels", 1, 2),
                                           (scarp.UsageError, "a Mesh, the path of one, or a level", fine, [1]),
                                           (scarp.UsageError, "level", fine, float("inf")),
                                           (scarp.InputError, "no such file", "missing.glb", 3)):
            with self.assertRaises(kind) as caught:
                scarp.volume(before, after)
            self.assertIn(words, str(caught.exception))

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
            (scarp.UsageError, "program's alone", lambda: scarp.simplify(z, 1, help=True)),
            (scarp.UsageError, "max_error is NaN", lambda: scarp.simplify(z, float("nan"), max_triangles=50)),
            (scarp.InputError, "-e.pgm: no such file", lambda: scarp.simplify("-e.pgm", 1)),
            (scarp.UsageError, "max_error is NaN", lambda: scarp.Refiner(z).run(float("nan"))),
            (scarp.UsageError, "max_error -1 is negative", lambda: scarp.Refiner(z).run(-1)),
            (scarp.UsageError, "threads 5000 is above 1024", lambda: scarp.simplify(z, 1, threads=5000)),
            (scarp.UsageError, "fail_above", lambda: scarp.measure(z, mesh, fail_above=float("nan"))),
            (scarp.UsageError, "base", lambda: mesh.add_base(float("nan"))),
            (scarp.UsageError, "scarp.measure() does", lambda: scarp.Refiner(z).mesh().report),
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
        scarp.simplify(plain_hills(150, 150), 0.5, effort="high", progress=told.append)
        self.assertTrue(told)
        self.assertTrue(all(0 <= step.fraction <= 1 and step.name for step in told))
        self.assertTrue(all(step.seconds_left is None or step.seconds_left >= 0 for step in told))
        self.assertEqual({step.tiles for step in told}, {0})

        # A progress function may itself simplify.
        inner = []
        z = plain_hills(150, 150)
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
                scarp.simplify(plain_hills(150, 150), 0.5, effort="high", progress=bad)

        # The exception is in no reference cycle.
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
        z = plain_hills(65, 65)

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
            from fixtures import plain_hills
            signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell in the background ignores it
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
        done = subprocess.run([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
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

    def test_a_daemon_s_call_ends_with_the_process(self):
        script = textwrap.dedent("""
            import sys, threading
            sys.path.insert(0, %r)
            import scarp
            from fixtures import plain_hills
            z, begun = plain_hills(600, 600), threading.Event()
            threading.Thread(daemon=True, target=lambda: scarp.simplify(
                z, 0.25, effort="max", time_limit=60, progress=lambda _: begun.set())).start()
            begun.wait()
        """ % os.path.dirname(os.path.abspath(__file__)))
        done = subprocess.run([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))

    def test_other_threads_run_meanwhile(self):
        z = plain_hills(150, 150)
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

    def test_threads_may_share_a_refiner(self):
        refiner = scarp.Refiner(plain_hills(200, 200))
        inserted = []
        threads = [threading.Thread(target=lambda: inserted.append(refiner.run(max_vertices=20000))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual((sum(inserted), refiner.vertex_count), (19996, 20000))

    def test_what_was_not_made_or_cannot_be_copied_does_not_crash(self):
        for kind, use in ((scarp.Refiner, lambda one: one.insert_worst()), (scarp.Refiner, lambda one: one.max_error),
                          (scarp.Tiles, lambda one: one.max_level), (scarp.Mesh, lambda one: one.vertex_count)):
            with self.assertRaises(AttributeError):
                use(kind.__new__(kind))
        for copier in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaises(TypeError):
                copier(scarp.Tiles.__new__(scarp.Tiles))

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
