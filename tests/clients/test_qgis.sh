#!/usr/bin/env bash
# The plugin for QGIS: packed, loaded by QGIS without a screen, and by qgis_process.
source "$(dirname "$0")/../program/lib.sh"
need unzip qgis_process
for with_qgis in "$python_program" "$(type -P python3)"; do
  "$with_qgis" -c 'import qgis.core, processing' 2> /dev/null && break
  PYTHONPATH=/usr/share/qgis/python/plugins "$with_qgis" -c 'import qgis.core, processing' 2> /dev/null && break
  with_qgis=
done
[ -n "$with_qgis" ] || skip "no python here has PyQGIS"
export QT_QPA_PLATFORM=offscreen HOME=$PWD/home XDG_RUNTIME_DIR=$PWD/runtime
mkdir -m 700 home runtime

pack="$SCARP_SOURCE/bindings/qgis/make_plugin.py"
succeeds "$with_qgis" "$pack" "$scarp" dist/scarp_processing.zip
succeeds "$with_qgis" "$pack" "$scarp" again.zip
cmp dist/scarp_processing.zip again.zip || fail "two packings differ"
mkdir plugins && (cd plugins && unzip -q ../dist/scarp_processing.zip)
grep -q '^version=[0-9]' plugins/scarp_processing/metadata.txt || fail "metadata.txt tells no version"
for key in name description version qgisMinimumVersion author email about tracker repository homepage icon; do
  grep -qE "^$key=.+" plugins/scarp_processing/metadata.txt || fail "metadata.txt has no $key, which the plugin site wants"
done
[ "$(head -c 8 plugins/scarp_processing/icon.png | od -An -c | tr -d ' ')" = '211PNG\r\n032\n' ] || fail "the icon is no PNG"
wants() {  # no plugin is packed without its publisher
  local words=$1
  shift
  try "$with_qgis" "$pack" "$scarp" x.zip "$@"
  [ "$code" = 1 ] && grep -qF "$words" "$logs/err" && [ ! -e x.zip ] || fail "no sentence about $words"
}
wants 'set SCARP_PLUGIN_EMAIL' --publish
SCARP_PLUGIN_EMAIL=nobody wants "SCARP_PLUGIN_EMAIL is 'nobody'"
SCARP_PLUGIN_EMAIL=me@home.net wants 'set SCARP_PLUGIN_URL' --publish
SCARP_PLUGIN_EMAIL=me@home.net SCARP_PLUGIN_URL=https://home.net/scarp succeeds "$with_qgis" "$pack" "$scarp" x.zip --publish
unzip -p x.zip scarp_processing/metadata.txt > published.txt
grep -qx 'tracker=https://home.net/scarp/issues' published.txt && grep -qx 'email=me@home.net' published.txt && rm x.zip ||
  fail "the publisher's addresses are not in metadata.txt"
succeeds "$with_qgis" "$SCARP_SOURCE/tests/program/qgis_algorithms.py" plugins "$data" "$scarp"
grep -q "do what they say" "$logs/out" || fail "the algorithms did not run to their end: $(tail -n 3 "$logs/out")"

# Calls the program itself, since Debian's wrapper passes a switch unknown to it.
qgis_process=$(command -v qgis_process.bin || command -v qgis_process)
export QGIS_PLUGINPATH=$PWD/plugins SCARP=$scarp
succeeds "$qgis_process" plugins enable scarp_processing
succeeds "$qgis_process" run scarp:rastertomesh -- INPUT="$dem" MAX_ERROR=20 EFFORT=fast OUTPUT=by_process.2dm
succeeds "$scarp" simplify "$dem" by_program.2dm -e 20 --effort fast
cmp by_process.2dm by_program.2dm || fail "qgis_process and the program make different files"
# The lines of docs/guide/qgis.md.
mkdir by_guide
cp -L "$data"/examples/* by_guide/
(cd by_guide && qgis_process() { "$qgis_process_program" "$@"; } && qgis_process_program=$qgis_process &&
  eval "$(python3 "$SCARP_SOURCE/tools/guide_blocks.py" "$SCARP_SOURCE/docs/guide/qgis.md" sh)") > "$logs/out" 2> "$logs/err" || fail "the guide's lines"
succeeds "$scarp" info by_guide/tin.2dm
echo "QGIS makes the program's meshes"
