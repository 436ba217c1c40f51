# Common parts of the program's tests. Source it first; the test then runs in an empty scratch folder.
#
#   $scarp   the program          $dem    the bundled raster (403 x 344, int16, 236 .. 1076 m, EPSG:4326)
#   $data    the project's data   $logs   stdout and stderr of the last `try`, outside the scratch folder
#   $scratch the scratch folder
set -euo pipefail
scarp=$SCARP_BUILD/bin/scarp

# The script starts again as the command of servers, which have the program loaded, and gdal_translate where the script
# needs it (../start_once/). Without the server, or with SCARP_STARTED=no, each run loads its program.
server=$SCARP_BUILD/tests/libscarp_start_once.so
if [ "${SCARP_STARTED-}" != "$scarp" ] && [ "${SCARP_STARTED-}" != no ] && [ -e "$server" ]; then
  export SCARP_STARTED=$scarp SCARP_START_ONCE=$(mktemp -u) SCARP_CLIENT=$SCARP_BUILD/tests/scarp_start_once_client
  if grep -q gdal_translate "$0" && SCARP_GDAL_TRANSLATE=$(command -v gdal_translate); then
    export SCARP_GDAL_TRANSLATE
    LD_BIND_NOW=1 LD_PRELOAD=$server exec "$scarp" env LD_PRELOAD="$server" "$SCARP_GDAL_TRANSLATE" bash "$0" "$@"
  fi
  LD_BIND_NOW=1 LD_PRELOAD=$server exec "$scarp" bash "$0" "$@"
fi
if [ -n "${SCARP_GDAL_TRANSLATE-}" ]; then gdal_translate() { "$SCARP_CLIENT" "$SCARP_GDAL_TRANSLATE" "$@"; }; fi

# once PROGRAM ARGUMENT...: runs it without loading it, if it is the server's.
once() {
  if [ "$1" = "${SCARP_STARTED-}" ]; then set -- "$SCARP_CLIENT" "$@"; fi
  "$@"
}

data=$SCARP_SOURCE/data
dem=$data/jacksboro_fault.tif
root=$(mktemp -d)
logs=$root/logs
scratch=$root/run
mkdir "$root/run" "$logs"
trap 'rm -rf "$root"' EXIT
cd "$root/run"

# The system's interpreter without other packages: version managers' wrappers and a machine's site-packages need longer
# to start than most programs here to run. With packages: $python_program.
python_program=$(command -pv python3 || command -v python3 || true)
if [ -n "$python_program" ]; then python3() { "$python_program" -S "$@"; }; fi

# The headless one uses less CPU time than a whole browser.
browser=$(command -v chromium-headless-shell || command -v chromium || echo chromium-headless-shell)

fail() {
  echo "FAILED: $*" >&2
  if [ -s "$logs/err" ]; then
    sed 's/^/  stderr: /' "$logs/err" >&2
  elif [ -s "$logs/out" ]; then  # messages of node's tests
    { grep -EA 12 '^(not ok|✖)' "$logs/out" || tail -n 20 "$logs/out"; } | tail -n 20 | sed 's/^/  stdout: /' >&2
  fi
  exit 1
}

skip() {
  echo "skipped: $*"
  exit 77
}

need() {
  local tool
  for tool in "$@"; do
    command -v "$tool" > /dev/null || skip "needs $tool"
  done
}

# npm_judges PACKAGE...: the foreign readers of tests/js, which npm installs into $js once for all tests. If
# unavailable: false, and a message.
js=$SCARP_BUILD/js
npm_judges() {
  local package
  mkdir -p "$js"
  (
    flock 9
    for file in "$SCARP_SOURCE"/tests/js/*.*; do cmp -s "$file" "$js/$(basename "$file")" || cp "$file" "$js/"; done
    if ! cmp -s "$js/package-lock.json" "$js/node_modules/installed" && command -v npm > /dev/null; then
      cd "$js" && npm ci --ignore-scripts --no-audit --no-fund > npm.log 2>&1 && cp package-lock.json node_modules/installed
    fi
  ) 9> "$js.lock" || true
  for package in "$@"; do
    if [ ! -d "$js/node_modules/$package" ] || ! command -v node > /dev/null; then
      echo "left out: $package (needs node and npm)"
      return 1
    fi
  done
}

# Runs a command as `once` does; its exit code goes to $code, its output to $logs.
try() {
  code=0
  once "$@" > "$logs/out" 2> "$logs/err" || code=$?
}

# succeeds COMMAND...
succeeds() {
  try "$@"
  [ "$code" = 0 ] || fail "exit code $code instead of 0: $*"
}

# await PROCESS COMMAND...: waits until the command succeeds, on machines of any speed; fails if the process ends first.
await() {
  local process=$1
  shift
  until "$@"; do
    kill -0 "$process" 2> /dev/null || fail "the process ended before this was true: $*"
    sleep 0.02
  done
}

# names_port FILE: true once a server has printed its address there; sets $port.
names_port() {
  port=$(sed -n 's#^  at  *http://127\.0\.0\.1:\([0-9]*\)/$#\1#p' "$1")
  [ -n "$port" ]
}

# run_within MEGABYTES COMMAND...: the command's exit code; fails if it ever uses more memory. Not checked with
# sanitizers, which need more.
run_within() {
  local most=$1
  shift
  if [ -z "${is_limited-}" ]; then
    is_limited=$(bash -c 'ulimit -v 1000000; exec "$1" --version' - "$scarp" > /dev/null 2>&1 && echo yes || echo no)
  fi
  [ $is_limited = yes ] || most=1000000
  python3 -c '
import resource, subprocess, sys
code = subprocess.call(sys.argv[2:])
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
sys.exit(code or (peak > 1e6 * int(sys.argv[1]) and f"{peak / 1e6:.1f} MB were taken"))' "$most" "$@"
}
within() { succeeds run_within "$@"; }

# files_here: every file with its size, times and number, and every folder.
files_here() { find . -type d -printf '%p\n' -o -printf '%p %s %T@ %C@ %i\n'; }

# refuses CODE WORDS COMMAND...: the exit code, exactly one line on stderr that begins with "scarp: " and contains
# WORDS, nothing on stdout, and no file added, removed or changed.
refuses() {
  local want=$1 words=$2 before after lines
  shift 2
  before=$(files_here)
  try "$@"
  after=$(files_here)
  [ "$code" = "$want" ] || fail "exit code $code instead of $want: $*"
  mapfile lines < "$logs/err"
  [[ ${#lines[@]} = 1 && $lines == *$'\n' ]] || fail "not exactly one line on stderr: $*"
  [[ $lines == 'scarp: '[^\ ]* ]] || fail "the line does not begin with 'scarp: ': $*"
  [[ $lines == *"$words"* ]] || fail "the line does not hold '$words': $*"
  [ ! -s "$logs/out" ] || fail "something on stdout: $*"
  [ "$before" = "$after" ] || fail "files have changed: $*"
}

# json FILE KEY...: the value in a JSON file ("5.0", "\"x\"", "null"); fails if a key is missing.
json() { "$SCARP_BUILD/tests/scarp_json_value" "$@"; }

# agree A B KEY...: two JSON files have the same values; words of a key name nested ones ("cutline samples_outside").
agree() {
  python3 -I -S - "$@" <<'PYTHON' || fail "$1 and $2 differ"
import json, sys
a, b = (json.load(open(path)) for path in sys.argv[1:3])
for key in sys.argv[3:]:
    x, y = a, b
    for word in key.split(): x, y = x[word], y[word]
    assert x == y, (key, x, y)
PYTHON
}

# by_threads RASTER MESH OPTION...: simplify makes the same bytes on one thread and on three, in $within megabytes if
# set, and the mesh is sound; its report is r.json.
by_threads() {
  local raster=$1 mesh=$2 threads
  shift 2
  for threads in 1 3; do
    succeeds ${within:+run_within "$within"} "$scarp" simplify "$raster" "$threads.$mesh" "$@" -j "$threads" --report r.json --overwrite
  done
  cmp "1.$mesh" "3.$mesh" || fail "-j 3 makes another mesh with $*"
  [ "$(json r.json topology sound)" = true ] || fail "an unsound mesh with $*"
  mv "1.$mesh" "$mesh"
}

# holds EXPRESSION: a comparison of numbers in awk.
holds() {
  awk "BEGIN { exit !($1) }" || fail "does not hold: $1"
}

# Makes a raster that occupies the engine for some seconds: the bundled one, enlarged 10 x 10.
make_big_raster() {
  need gdal_translate
  gdal_translate -q -r cubic -ot Float32 -outsize 1000% 1000% "$dem" "$1"
}

# make_raster NAME EXPRESSION [TYPE]: a raster on the grid of $dem (at its place), whose value at (col, row) is the
# Python expression; nan is nodata.
make_raster() {
  need gdal_translate python3
  python3 - "$1" "$2" <<'PYTHON'
import array, math, sys
cols, rows = 403, 344
nan = math.nan
values = array.array("f", eval(f"[({sys.argv[2]}) for row in range(rows) for col in range(cols)]"))
header = f"NROWS {rows}\nNCOLS {cols}\nNBITS 32\nPIXELTYPE FLOAT\nBYTEORDER {'IM'[sys.byteorder == 'big']}\n"
if any(value != value for value in values):
    header += "NODATA -9999\n"
    values = array.array("f", [-9999 if value != value else value for value in values])
open(sys.argv[1] + ".hdr", "w").write(header)
values.tofile(open(sys.argv[1] + ".bil", "wb"))
PYTHON
  dem_corners=${dem_corners:-$(corners_of "$dem")}
  gdal_translate -q -ot "${3:-Float32}" $dem_corners "$1.bil" "$1"
  rm "$1.bil" "$1.hdr"
}

# make_image NAME EXPRESSION...: an image of bytes on the same grid, with a band for each expression; three are red,
# green, blue.
make_image() {
  local name=$1 bands=() options=() expression
  shift
  need gdalbuildvrt
  for expression in "$@"; do
    make_raster "band${#bands[@]}.tif" "$expression" Byte
    bands+=("band${#bands[@]}.tif")
  done
  if [ $# = 3 ]; then options=(-co PHOTOMETRIC=RGB -colorinterp red,green,blue); fi
  gdalbuildvrt -q -separate bands.vrt "${bands[@]}"
  gdal_translate -q "${options[@]}" bands.vrt "$name"
  rm bands.vrt "${bands[@]}"
}

# The options of gdal_translate that place a raster where another one lies.
corners_of() {
  gdalinfo -json "$1" | python3 -c '
import json, sys
i = json.load(sys.stdin)
(x, dx, _, y, _, dy), (cols, rows) = i["geoTransform"], i["size"]
print("-a_srs EPSG:4326 -a_ullr", repr(x), repr(y), repr(x + dx * cols), repr(y + dy * rows))'
}
