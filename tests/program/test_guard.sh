#!/bin/bash
# tools/guard.py fails exactly the commits that are slower or larger by more than a ratio and an amount.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
python=$(command -pv python3 || command -v python3) || { echo "skipped: python3 is missing"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cat >"$scratch/test_verdict.py" <<'PYTHON'
import io
import sys
import unittest
from contextlib import redirect_stdout

sys.path.insert(0, sys.argv.pop(1))
import guard

LIMITS = guard.limits_of(guard.parse(["BASE"]))


def run(seconds, megabytes=10.0, instructions=None):
    return {"seconds": seconds, "megabytes": megabytes, "instructions": instructions}


def failing(base, head):
    return {row[0] for row in guard.judge(base, head, LIMITS) if row[3]}


class Verdict(unittest.TestCase):
    def test_a_slower_and_longer_run_fails(self):
        self.assertEqual(failing([run(1.0)], [run(1.2)]), {"seconds"})

    def test_a_large_ratio_of_little_time_is_noise(self):
        self.assertEqual(failing([run(0.002)], [run(0.006)]), set())

    def test_much_time_at_a_small_ratio_is_noise(self):
        self.assertEqual(failing([run(10.0)], [run(10.4)]), set())

    def test_the_least_of_the_rounds_counts(self):
        self.assertEqual(failing([run(1.0), run(3.0)], [run(5.0), run(1.01)]), set())

    def test_more_memory_fails_beyond_both_thresholds_only(self):
        self.assertEqual(failing([run(1, 100)], [run(1, 110)]), {"megabytes"})
        self.assertEqual(failing([run(1, 10)], [run(1, 11.5)]), set())
        self.assertEqual(failing([run(1, 1000)], [run(1, 1020)]), set())

    def test_faster_and_smaller_is_well(self):
        self.assertEqual(failing([run(1.0, 100)], [run(0.2, 20)]), set())

    def test_counted_instructions_decide_instead_of_time(self):
        self.assertEqual(failing([run(1, 10, 10**10)], [run(2, 10, 10**10)]), set())
        self.assertEqual(failing([run(1, 10, 10**10)], [run(1, 10, 12 * 10**9)]), {"instructions"})
        self.assertEqual(failing([run(1, 10, 10**10)], [run(2)]), {"seconds"})

    def test_what_fails_is_measured_again(self):
        times = {"base": iter([1.0] * 9), "head": iter([2.0, 2.0, 2.0] + [1.0] * 6)}
        sides = [guard.Side(name, ".", None) for name in ("base", "head")]
        with redirect_stdout(io.StringIO()) as table:
            failed = guard.compare(sides, [("case", lambda side: run(next(times[side.name])))], 3, LIMITS)
        self.assertFalse(failed)
        self.assertIn("| case | seconds | 1 | 1 | 1.000 | ok |", table.getvalue())


unittest.main()
PYTHON
PYTHONDONTWRITEBYTECODE=1 "$python" "$scratch/test_verdict.py" "$source_tree/tools"

# Whole runs on fake programs: `fake FOLDER SECONDS` accepts no options but the error.
command -v gdal_translate >/dev/null || { echo "skipped: needs gdal_translate"; exit 77; }
fake() {
  mkdir "$scratch/$1"
  cat >"$scratch/$1/speed_scarp" <<SCRIPT
#!/bin/sh
[ \$# -eq 4 ] || exit 2
echo '{"cpu_seconds": $2}'
SCRIPT
  chmod +x "$scratch/$1/speed_scarp"
}
fake base 1.0
fake slow 1.5
compare() {
  code=0
  PYTHONDONTWRITEBYTECODE=1 "$python" "$source_tree/tools/guard.py" --bins "$scratch/$1" "$scratch/$2" \
    --rasters jacksboro --rounds 1 --order greedy >"$scratch/out" 2>"$scratch/err" || code=$?
}
compare base slow
[ $code -eq 1 ] || { echo "a slower program passed with $code:"; cat "$scratch/out" "$scratch/err"; exit 1; }
grep -q '| seconds | 1 | 1.5 | 1.500 | FAILS |' "$scratch/out"
grep -q 'does not know --order greedy: run without' "$scratch/out"
compare slow base
[ $code -eq 0 ] || { echo "a faster program failed with $code:"; cat "$scratch/out" "$scratch/err"; exit 1; }
mkdir "$scratch/empty"
compare empty base
[ $code -eq 2 ] || { echo "a folder without programs gave $code"; exit 1; }
grep -q '^guard: a side has neither' "$scratch/err"
printf '#!/bin/sh\nexit 3\n' >"$scratch/empty/speed_scarp"
chmod +x "$scratch/empty/speed_scarp"
compare empty base
[ $code -eq 2 ] || { echo "a program that always fails gave $code"; exit 1; }
grep -q '^guard: base: .* failed' "$scratch/err"
code=0
PYTHONDONTWRITEBYTECODE=1 "$python" "$source_tree/tools/guard.py" no-such-commit 2>"$scratch/err" || code=$?
[ $code -eq 2 ] || { echo "a commit that is not there gave $code"; exit 1; }
