"""Fields that change: the mesh follows, keeps its bound, and equals that of a new field."""
import random
import threading
import unittest

import scarp
from fixtures import hills, is_same, need, np

if np is not None:
    VOID = np.float32(np.nan)


def apply(cells, changes):
    """Updates the cells that a renderer keeps, by slot."""
    for cell in changes.cells:
        cells.pop(cell.slot, None)
        if len(cell.triangles):
            cells[cell.slot] = cell
    return changes.version


@need("numpy")
class Live(unittest.TestCase):
    def test_follows_random_changes(self):
        chance = random.Random(5)
        z = hills(90, 110)
        live, cells, version = scarp.Live(z, 2, cell=16), {}, 0
        for turn in range(60):
            rows = slice(first := chance.randrange(89), first + chance.randrange(1, 30))
            cols = slice(first := chance.randrange(109), first + chance.randrange(1, 30))
            part = np.random.default_rng(turn).uniform(-40, 40, z[rows, cols].shape).astype(np.float32)
            if turn % 3 == 0:
                part[part > 20] = VOID
            live.update(rows, cols, part)
            z[rows, cols] = part
            if turn % 10 == 9:
                live.scroll(3, -5)
                moved = np.full_like(z, VOID)
                moved[:-3, 5:] = z[3:, :-5]
                z = moved
            version = apply(cells, live.changes(version))
            report = scarp.measure(z, live.mesh(), transform=live.transform)
            self.assertEqual((report.max_error <= 2, report.uncovered), (True, 0))
        np.testing.assert_array_equal(live.heights, z)
        anew = scarp.Live(z, 2, cell=16, place=live.place)
        self.assertTrue(is_same(live.mesh(), anew.mesh()))
        whole = {}
        apply(whole, anew.changes())
        self.assertEqual(cells.keys(), whole.keys())
        for slot, cell in cells.items():
            np.testing.assert_array_equal(cell.positions, whole[slot].positions)
            np.testing.assert_array_equal(cell.triangles, whole[slot].triangles)
        self.assertEqual(sum(len(cell.triangles) for cell in cells.values()), live.triangle_count)

    def test_keeps_a_budget(self):
        z = hills(200, 240)
        live, counts = scarp.Live(z, max_triangles=1500), []
        for turn in range(10):
            rows, cols = slice(15 * turn, 15 * turn + 30), slice(20 * turn, 20 * turn + 40)
            live.update(rows, cols, 3 * z[rows, cols])
            counts.append(live.triangle_count)
        self.assertLessEqual(max(counts), 1500)
        self.assertGreater(min(counts), 1400)
        self.assertGreater(sum(count >= 1470 for count in counts), 5, counts)
        report = scarp.measure(live.heights, live.mesh(), transform=live.transform)
        self.assertEqual((report.max_error, report.uncovered), (live.max_error, 0))
        anew = scarp.Live(live.heights, max_triangles=1500, level=live.level)
        self.assertEqual(anew.level, live.level)
        np.testing.assert_array_equal(*(np.concatenate([cell.positions for cell in one.changes().cells]) for one in (live, anew)))
        with self.assertRaisesRegex(scarp.UsageError, "has no level"):
            scarp.Live(z, max_triangles=1500, level=2**40)
        self.assertLess(scarp.Live(np.zeros((99, 99)), max_triangles=5000).triangle_count, 100)
        with self.assertRaisesRegex(scarp.UsageError, "needs max_error or max_triangles"):
            scarp.Live(z)
        with self.assertRaisesRegex(scarp.UsageError, "a budget or tolerances"):
            scarp.Live(z, max_triangles=1500, tolerance=1)
        with self.assertRaisesRegex(scarp.UsageError, r"needs \d+ triangles with any bound, more than its budget of 7"):
            scarp.Live(z, max_triangles=7)

    def test_keeps_bounds_of_samples(self):
        z = hills(50, 60)
        bounds = np.full(z.shape, np.inf, np.float32)
        bounds[10:20, 10:20] = 0.25
        live = scarp.Live(z, 5, tolerance=bounds, effort="normal")
        live.update(slice(30, 40), slice(30, 40), 7, tolerance=0)
        z[30:40, 30:40], bounds[30:40, 30:40] = 7, 0
        report = scarp.measure(z, live.mesh(), tolerance=bounds)
        self.assertEqual((report.over, report.max_error <= 5), (0, True))

    def test_begins_without_a_height(self):
        live = scarp.Live(np.full((50, 60), VOID), 0.5, nodata=-9999)
        self.assertEqual((live.triangle_count, live.changes().cells), (0, []))
        z = hills(20, 30)
        z[3, 4] = -9999
        live.update(slice(10, 30), slice(20, 50), z)
        self.assertTrue(np.isnan(live.heights[13, 24]))
        self.assertGreater(live.triangle_count, 100)
        live.scroll(0, 60)
        emptied = live.changes(2).cells
        self.assertTrue(emptied and all(len(cell.triangles) == 0 for cell in emptied))
        self.assertEqual(live.triangle_count, 0)

    def test_reproduces_ramps_exactly(self):
        row, col = np.mgrid[0:80, 0:90]
        live, chance = scarp.Live(3.0 * col, 0, cell=16), random.Random(3)
        for turn in range(40):
            first, across = chance.randrange(60), chance.randrange(70)
            live.update(slice(first, first + 20), slice(across, across + 20), 0.25 * row[:20, :20] - 3 * col[:20, :20])
        self.assertEqual(scarp.measure(live.heights, live.mesh()).max_error, 0)

    def test_heights_are_read_beside_a_writer(self):
        live, is_done = scarp.Live(hills(100, 100), 1), threading.Event()

        def read():
            while not is_done.is_set():
                self.assertEqual(live.heights.shape, (100, 100))

        reader = threading.Thread(target=read)
        reader.start()
        for turn in range(100):
            live.set(turn, turn, 5)
        is_done.set()
        reader.join()

    def test_arrays_outlive_the_field(self):
        live = scarp.Live(hills(40, 40), 1)
        cell = live.changes().cells[0]
        before = cell.positions.copy()
        self.assertFalse(cell.positions.flags.writeable)
        self.assertEqual((cell.positions.dtype, cell.triangles.dtype), (np.float32, np.uint16))
        live.close()
        np.testing.assert_array_equal(cell.positions, before)
        with self.assertRaisesRegex(scarp.UsageError, "the live field is closed"):
            live.update(0, 0, 1)

    def test_one_row_one_sample_one_number(self):
        live, z = scarp.Live(hills(40, 40), 0), hills(40, 40)
        live.update(5, slice(3, 9), np.arange(6))
        live.update(slice(None), -1, 4.5)
        live.set(7, 8, float("nan"))
        z[5, 3:9], z[:, -1], z[7, 8] = np.arange(6), 4.5, VOID
        np.testing.assert_array_equal(live.heights, z)
        with self.assertRaisesRegex(scarp.UsageError, r"heights have the shape \(7,\), and the window has \(1, 6\)"):
            live.update(5, slice(3, 9), np.arange(7))

    def test_names_what_is_wrong_and_stays(self):
        z = hills(40, 50)
        live = scarp.Live(z, 1)
        before = live.mesh()
        for error, words, call in (
                (scarp.UsageError, "slice with step 1", lambda: live.update(slice(0, 9, 2), 0, 1)),
                (scarp.UsageError, "at least one of 40", lambda: live.update(slice(60, 70), 0, 1)),
                (scarp.UsageError, "beyond what a float32 holds", lambda: live.set(0, 0, 1e39)),
                (scarp.UsageError, "place is .row, column.", lambda: scarp.Live(z, 1, place=5)),
                (scarp.UsageError, "fast, normal or high", lambda: scarp.Live(z, 1, effort=["fast"])),
                (scarp.UsageError, "samples lie apart", lambda: scarp.Live(z, 1, transform=(1e15, 0.01, 0, 0, 0, 0.01))),
                (scarp.UsageError, "not within the live field", lambda: live.update(40, 0, 1)),
                (scarp.UsageError, "rows is -41", lambda: live.update(-41, 0, 1)),
                (scarp.UsageError, "heights are an array of numbers", lambda: live.update(0, 0, "high")),
                (scarp.UsageError, "made without tolerances", lambda: live.update(0, 0, 1, tolerance=1)),
                (scarp.UsageError, "lie beyond 2", lambda: live.scroll(2**31 - 1, 0)),
                (scarp.UsageError, "max error of at least 0", lambda: scarp.Live(z, -1)),
                (scarp.UsageError, "max_error is NaN", lambda: scarp.Live(z, float("nan"))),
                (scarp.UsageError, "fast, normal or high", lambda: scarp.Live(z, 1, effort="max")),
                (scarp.UsageError, "8 to 254 samples, not 7", lambda: scarp.Live(z, 1, cell=7)),
                (scarp.UsageError, "tolerances have the shape", lambda: scarp.Live(z, 1, tolerance=z[1:])),
                (TypeError, "neither pickled nor copied", lambda: __import__("pickle").dumps(live))):
            with self.subTest(words), self.assertRaisesRegex(error, words):
                call()
        self.assertTrue(is_same(live.mesh(), before))

    def test_readers_beside_a_writer(self):
        z = hills(100, 100)
        live, faults, is_done = scarp.Live(z, 1), [], threading.Event()
        states = [live.mesh()]
        live.update(slice(None), slice(None), -z)
        states.append(live.mesh())

        def read():
            version = 0
            while not is_done.is_set():
                mesh, changes = live.mesh(), live.changes(version)
                if not any(is_same(mesh, state) for state in states) or changes.version < version:
                    faults.append(changes.version)
                version = changes.version

        readers = [threading.Thread(target=read) for _ in range(3)]
        for reader in readers:
            reader.start()
        for turn in range(20):
            live.update(slice(None), slice(None), z if turn % 2 == 0 else -z)
        is_done.set()
        for reader in readers:
            reader.join()
        self.assertEqual(faults, [])


if __name__ == "__main__":
    unittest.main()
