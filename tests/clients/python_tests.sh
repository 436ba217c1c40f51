# Source it after lib.sh.

# passes_in PYTHON FOLDER WHEEL SHARE: tests/python pass in that Python with the wheel, in an environment made in
# FOLDER; tests with many cases run one in SHARE. Without numpy, tests that need it are skipped. False if no environment
# can be made.
passes_in() {
  local python=$1 folder=$2 wheel=$3 share=$4 version begin
  version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
  if ! "$python" -m venv --system-site-packages "$folder" > "$logs/out" 2>&1; then
    echo "Python $version: skipped, it makes no environment"
    return 1
  fi
  succeeds "$folder/bin/python" -m pip install --quiet --no-index --no-deps "$wheel"
  begin=$(date +%s%N)
  succeeds "$folder/bin/python" -c 'import scarp'
  echo "Python $version: started and imported scarp in $((($(date +%s%N) - begin) / 1000000)) ms"
  (cd "$SCARP_SOURCE/tests/python" && SCARP_SHARE=$share SCARP_PROGRAM=$scarp SCARP_DEM=$dem \
    try "$scratch/$folder/bin/python" -m unittest discover -v
    [ "$code" = 0 ] || fail "Python $version: the tests fail"
    tail -n 1 "$logs/err" | sed "s/^/Python $version: /"
    grep -oE "skipped '.*'" "$logs/err" | sort | uniq -c || true)
}
