#!/usr/bin/env bash
# Every command of the README, the cookbook and the guides runs unchanged in the folder of examples and does what its
# text promises.
source "$(dirname "$0")/lib.sh"
need python3 gdaldem gdalwarp
readme=$SCARP_SOURCE/README.md
[ "$(wc -l < "$readme")" -le 90 ] || fail "the README has more than 90 lines: $(wc -l < "$readme")"
PATH=$(dirname "$scarp"):$PATH
if [ -n "${SCARP_CLIENT-}" ]; then
  scarp() { "$SCARP_CLIENT" "$SCARP_STARTED" "$@"; }
  export -f scarp
fi

# commands FILE: the commands of cookbook rows, indented code (with those that make its input), and sessions
# (```console, after a $), without comments. A line that ends in \ continues.
commands() {
  python3 - "$1" <<'PYTHON'
import re, sys
text = open(sys.argv[1], encoding="utf-8").read()
text = re.sub(r"^```console\n(.*?)^```$", lambda session: re.sub(r"^\$ ", "    ", re.sub(r"^(?!\$ ).*\n", "", session[1], flags=re.M), flags=re.M),
              text, flags=re.M | re.S)
text = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S).replace("\\\n", " ")
for line in text.split("\n"):
    for command in re.findall(r"^\|.*\| `(scarp [^`]*)`", line) or re.findall(r"^    ([a-z]+ .*)", re.sub("^    hint .*", "", line)):
        print(re.sub(r"\s+", " ", re.sub(r" +#.*", "", command)))
PYTHON
}

# serves COMMAND: a server prints its address and, when stopped, ends without a message.
serves() {
  local server code=0
  bash -c "exec $1 --port 0" > "$logs/out" 2> "$logs/err" &
  server=$!
  await $server grep -q '^  at  *http://.*/$' "$logs/out"
  kill $server 2> /dev/null || true
  wait $server || code=$?
  [ $code = 0 ] || fail "it does not serve: $1"
}

# printed_as_quoted FILE OUTPUT: the commands print what the guide quotes: each line of a `text` block, of a session
# without its commands, and after a paragraph, <!-- printed: REGEX -->, whose numbers also occur in the paragraph.
printed_as_quoted() {
  python3 - "$1" "$2" <<'PYTHON' || fail "$(basename "$1") quotes what its commands do not print"
import re, sys
text, output = (open(name, encoding="utf-8").read() for name in sys.argv[1:])
plain = lambda words: re.sub(r"\s+", " ", words).strip()
lines = [plain(line) for line in output.split("\n")]
faults = []
for block in re.findall(r"^```(?:text|console)\n(.*?)^```$", text, re.M | re.S):
    faults += [line for line in map(plain, block.split("\n")) if line not in lines and not line.startswith("$ ")]
for paragraph, pattern in re.findall(r"((?:[^\n]+\n)+?)<!-- printed: (.*?) -->", text):
    if not any(re.search(pattern, line) for line in lines):
        faults.append(pattern)
    faults += [f"{number} of {pattern}" for number in re.findall(r"\d[\d,.]*\d|\d", pattern.replace("\\", "")) if number not in paragraph]
print(*faults, sep="\n", file=sys.stderr)
sys.exit(len(faults) > 0)
PYTHON
}

# run_all FILE: runs in a separate folder with the examples.
run_all() {
  local folder line
  folder=$(mktemp -d "$scratch/XXXXXX")
  cp -L "$SCARP_SOURCE"/data/examples/* "$folder"
  cd "$folder"
  commands "$1" > "$root/commands"
  : > "$root/printed"
  while read -r line; do
    if [[ $line == "scarp serve "* ]]; then
      serves "$line"
      continue
    fi
    [ "$line" != "cd data/examples" ] || continue  # a copy of it is where this runs
    if [[ $line == make\ * ]]; then line="make -n -C '$SCARP_SOURCE' ${line#make }"; fi
    try bash -c "$line"
    cat "$logs/out" "$logs/err" >> "$root/printed"
    [ "$code" = 0 ] || fail "exit code $code: $(basename "$1"): $line"
    if grep -Eq 'warning: .* no [a-z ]+ (was|were) found' "$logs/err"; then fail "it finds nothing: $(basename "$1"): $line"; fi
  done < "$root/commands"
  printed_as_quoted "$1" "$root/printed"
  cd "$scratch"
}

run_all "$readme"
[ "$(wc -l < "$root/commands")" -ge 5 ] || fail "the README has only $(wc -l < "$root/commands") commands"
cookbook=$SCARP_SOURCE/docs/cookbook.md
run_all "$cookbook"
[ "$(wc -l < "$root/commands")" -ge 34 ] || fail "the cookbook has only $(wc -l < "$root/commands") commands"
for row in Basics GIS 'Web and games' Simulation Printing 'The 1995 paper'; do
  grep -qF "| **$row** | |" "$cookbook" || fail "the cookbook has no group $row"
done
python3 "$SCARP_SOURCE/tools/guide_blocks.py" --check "$SCARP_SOURCE" || fail "a block of a guide has no test"
python3 - "$SCARP_SOURCE/docs/guide" <<'PYTHON' || fail "library.md does not show library.cpp"
import pathlib, sys
folder = pathlib.Path(sys.argv[1])
code = (folder / "library.cpp").read_text()
assert "```cpp\n" + code[code.index("#include"):] + "```\n" in (folder / "library.md").read_text()
PYTHON
for guide in "$SCARP_SOURCE"/docs/guide/*.md; do
  if [[ $guide == */viewer.md ]] && ! "$SCARP_SOURCE/tools/build_viewer.sh" "$SCARP_BUILD" > /dev/null 2>&1; then
    echo "left out: viewer.md (its page needs node and npm)"
    continue
  fi
  run_all "$guide"
  while read -r picture; do
    [ -s "$SCARP_SOURCE/docs/guide/$picture" ] || fail "$guide shows $picture, which is not there"
  done < <(grep -oE '\]\([^)]*\.png\)' "$guide" | sed 's/^](//; s/)$//')
done
