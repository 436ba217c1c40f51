# Sourced by scripts of the npm package, after lib.sh: packs it and installs it into the scratch folder, an empty project.
need em++ node npm python3 gdal_translate
[ "$(node -p 'parseInt(process.versions.node) >= 18')" = true ] || skip "needs Node 18"

package=$("$SCARP_SOURCE/tools/build_npm.sh" "$SCARP_BUILD-wasm" "$PWD/dist" 2> "$logs/err") || fail "the package cannot be built"
cp "$SCARP_SOURCE"/tests/js/npm/* .
echo '{ "type": "module", "private": true }' > package.json
succeeds npm install --offline --no-audit --no-fund --ignore-scripts "$package"

# add NAME WIDTH HEIGHT ERROR: the program's meshes of NAME.tif for same.mjs, in `cases`.
add() {
  local effort
  succeeds gdal_translate -q -of ENVI -ot Float32 "$1.tif" "$1.f32"
  for effort in fast normal high; do
    succeeds "$scarp" simplify "$1.tif" "$1_$effort.glb" -e "$4" --effort "$effort" --crs grid -q
    echo "$1 $2 $3 $4 $effort" >> cases
  done
}
