# bash completion for scarp. Written by tools/generate_docs.py from `scarp help --json`, not by hand.

_scarp() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command='' options='' word
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case $word in simplify | measure | view | tile | tile-plan | tile-run | tile-finish | tile-check | serve | info | generate | paper | help | version) command=$word && break ;; esac
  done
  if [[ -z $command ]]; then
    COMPREPLY=($(compgen -W 'simplify measure view tile tile-plan tile-run tile-finish tile-check serve info generate paper help version --help --version' -- "$current"))
    return
  fi

  case "$command $previous" in
    "simplify -e" | "simplify --max-error" | "simplify -t" | "simplify --max-triangles" | "simplify -p" | \
      "simplify --max-points" | "simplify --band" | "simplify --te" | "simplify --resolution" | \
      "simplify --z-scale" | "simplify --z-offset" | "simplify --z-unit" | "simplify --cell-size" | \
      "simplify --drape-size" | "simplify --normal-map" | "simplify --min-shape" | "simplify --time-limit" | \
      "simplify --lods" | "simplify --nodata" | "simplify --fill-distance" | "simplify --background" | \
      "simplify --outline-tolerance" | "simplify --falloff" | "simplify --breakline-z" | "simplify --inset" | \
      "simplify --cliff" | "simplify --ridges" | "simplify --material-field" | "simplify --water-percentile" | \
      "simplify --detect-flats" | "simplify --min-angle" | "simplify --max-edge" | "simplify --min-edge" | \
      "simplify --grade" | "simplify --base" | "simplify --split" | "simplify --memory" | "simplify -j" | \
      "simplify --num-threads" | "simplify --texture-weight" | "simplify --channel-weights" | "simplify --layer" | \
      "simplify --z-field" | "simplify --columns" | "simplify --boundary" | "simplify --shape-threshold" | \
      "simplify --supersample" | "measure --fail-above" | "measure --band" | "measure --te" | \
      "measure --resolution" | "measure --z-scale" | "measure --z-offset" | "measure --z-unit" | \
      "measure --cell-size" | "measure --nodata" | "measure --falloff" | "measure --inset" | "measure --memory" | \
      "measure -j" | "measure --num-threads" | "measure --texture-weight" | "measure --channel-weights" | \
      "measure --layer" | "measure --z-field" | "measure --columns" | "measure --boundary" | "view --band" | \
      "view --te" | "view --resolution" | "view --z-scale" | "view --z-offset" | "view --z-unit" | \
      "view --cell-size" | "view --nodata" | "tile --band" | "tile --te" | "tile --resolution" | "tile --z-scale" | \
      "tile --z-offset" | "tile --z-unit" | "tile --cell-size" | "tile --ellipsoid" | "tile --only" | "tile -e" | \
      "tile --max-error" | "tile --quality" | "tile --zoom" | "tile --max-tile-bytes" | "tile --nodata" | \
      "tile --fill-distance" | "tile --background" | "tile --water-percentile" | "tile -j" | "tile --num-threads" | \
      "tile-plan --band" | "tile-plan --te" | "tile-plan --resolution" | "tile-plan --z-scale" | \
      "tile-plan --z-offset" | "tile-plan --z-unit" | "tile-plan --cell-size" | "tile-plan --ellipsoid" | \
      "tile-plan --only" | "tile-plan --shards" | "tile-plan -e" | "tile-plan --max-error" | "tile-plan --quality" | \
      "tile-plan --zoom" | "tile-plan --max-tile-bytes" | "tile-plan --nodata" | "tile-plan --fill-distance" | \
      "tile-plan --background" | "tile-plan --water-percentile" | "tile-run --shard" | "tile-run --only" | \
      "tile-run --memory" | "tile-run -j" | "tile-run --num-threads" | "tile-finish -j" | \
      "tile-finish --num-threads" | "tile-check --band" | "tile-check --te" | "tile-check --resolution" | \
      "tile-check --z-scale" | "tile-check --z-offset" | "tile-check --z-unit" | "tile-check --cell-size" | \
      "tile-check --ellipsoid" | "tile-check --nodata" | "tile-check --fill-distance" | "tile-check --background" | \
      "tile-check -j" | "tile-check --num-threads" | "serve --band" | "serve --te" | "serve --resolution" | \
      "serve --z-scale" | "serve --z-offset" | "serve --z-unit" | "serve --ellipsoid" | "serve -e" | \
      "serve --max-error" | "serve --quality" | "serve --zoom" | "serve --max-tile-bytes" | "serve --nodata" | \
      "serve --fill-distance" | "serve --background" | "serve --water-percentile" | "serve --memory" | \
      "serve --port" | "serve -j" | "serve --num-threads" | "info --band" | "info --te" | "info --resolution" | \
      "info --z-scale" | "info --z-offset" | "info --z-unit" | "info --cell-size" | "info --nodata" | \
      "info --layer" | "info --z-field" | "info --columns" | "generate --seed" | "generate --range" | \
      "generate --size")
      return
      ;;
    "simplify --objective")
      COMPREPLY=($(compgen -W 'max rms' -- "$current"))
      return
      ;;
    "simplify --decode" | "measure --decode" | "view --decode" | "tile --decode" | "tile-plan --decode" | \
      "tile-check --decode" | "serve --decode" | "info --decode")
      COMPREPLY=($(compgen -W 'terrarium mapbox' -- "$current"))
      return
      ;;
    "simplify --crs" | "measure --crs" | "view --crs" | "info --crs")
      COMPREPLY=($(compgen -W 'source local enu grid EPSG:' -- "$current"))
      return
      ;;
    "simplify --up" | "measure --up" | "view --up")
      COMPREPLY=($(compgen -W 'y z' -- "$current"))
      return
      ;;
    "simplify --of")
      COMPREPLY=($(compgen -W 'glb obj ply stl tin 2dm vtu vtp landxml dxf gpkg 3mf svg eps dem' -- "$current"))
      return
      ;;
    "simplify --drape" | "simplify --preview" | "simplify --render" | "simplify --error-raster" | "simplify --html" | \
      "simplify --report" | "simplify --mask" | "simplify --tolerance" | "simplify --roi" | "simplify --script" | \
      "simplify --breaklines" | "simplify --cutline" | "simplify --materials" | "simplify --node-strings" | \
      "simplify --water" | "simplify --rivers" | "simplify --texture" | "measure --map" | "measure --error-raster" | \
      "measure --mask" | "measure --tolerance" | "measure --roi" | "measure --script" | "measure --cutline" | \
      "measure --texture" | "view -o" | "view --output" | "tile --breaklines" | "tile --geoid" | "tile --report" | \
      "tile --drape" | "tile --water" | "tile --rivers" | "tile-plan --breaklines" | "tile-plan --geoid" | \
      "tile-plan --changed-since" | "tile-plan --drape" | "tile-plan --slurm" | "tile-plan --water" | \
      "tile-plan --rivers" | "tile-finish --report" | "tile-check --source" | "tile-check --geoid" | \
      "serve --breaklines" | "serve --geoid" | "serve --water" | "serve --rivers")
      COMPREPLY=($(compgen -f -- "$current"))
      return
      ;;
    "simplify --drape-format" | "tile --drape-format" | "tile-plan --drape-format")
      COMPREPLY=($(compgen -W 'jpeg png webp' -- "$current"))
      return
      ;;
    "simplify --effort")
      COMPREPLY=($(compgen -W 'fast normal high max' -- "$current"))
      return
      ;;
    "simplify --vertices")
      COMPREPLY=($(compgen -W 'free samples' -- "$current"))
      return
      ;;
    "simplify --nodata-policy")
      COMPREPLY=($(compgen -W 'hole fill background' -- "$current"))
      return
      ;;
    "simplify --line-conflict")
      COMPREPLY=($(compgen -W 'error first mean highest' -- "$current"))
      return
      ;;
    "simplify --solid")
      COMPREPLY=($(compgen -W 'size= base= thickness= exaggerate=' -- "$current"))
      return
      ;;
    "simplify --norm" | "measure --norm")
      COMPREPLY=($(compgen -W 'l1 l2 linf' -- "$current"))
      return
      ;;
    "simplify --duplicates" | "measure --duplicates")
      COMPREPLY=($(compgen -W 'first last highest lowest mean' -- "$current"))
      return
      ;;
    "simplify --order")
      COMPREPLY=($(compgen -W 'dominant greedy' -- "$current"))
      return
      ;;
    "simplify --importance")
      COMPREPLY=($(compgen -W 'global local local8 curvature distance global*local global*local8 global*curvature global*distance' -- "$current"))
      return
      ;;
    "simplify --algorithm")
      COMPREPLY=($(compgen -W 'brute local heap' -- "$current"))
      return
      ;;
    "simplify --batch")
      COMPREPLY=($(compgen -W 'const frac: independent' -- "$current"))
      return
      ;;
    "simplify --edges")
      COMPREPLY=($(compgen -W 'delaunay data' -- "$current"))
      return
      ;;
    "simplify --edge-score")
      COMPREPLY=($(compgen -W 'sum max sqerr abn tight' -- "$current"))
      return
      ;;
    "tile --vertical" | "tile-plan --vertical" | "tile-check --vertical" | "serve --vertical")
      COMPREPLY=($(compgen -W 'auto egm96 egm2008 ellipsoid none' -- "$current"))
      return
      ;;
    "tile --of" | "tile-plan --of")
      COMPREPLY=($(compgen -W 'qm 3dtiles' -- "$current"))
      return
      ;;
    "tile --effort" | "tile-plan --effort" | "serve --effort")
      COMPREPLY=($(compgen -W 'fast normal high' -- "$current"))
      return
      ;;
    "tile --grid" | "tile-plan --grid")
      COMPREPLY=($(compgen -W 'geographic mercator local' -- "$current"))
      return
      ;;
    "tile --bound" | "tile-plan --bound")
      COMPREPLY=($(compgen -W 'nodes samples' -- "$current"))
      return
      ;;
    "tile --cells" | "tile-plan --cells" | "tile-check --cells" | "serve --cells")
      COMPREPLY=($(compgen -W '16 32 64 128 256' -- "$current"))
      return
      ;;
    "tile --nodata-policy" | "tile-plan --nodata-policy" | "tile-check --nodata-policy" | "serve --nodata-policy")
      COMPREPLY=($(compgen -W 'voids fill background' -- "$current"))
      return
      ;;
    "tile-plan --hash")
      COMPREPLY=($(compgen -W 'stamp content' -- "$current"))
      return
      ;;
    "tile-run --parts" | "tile-finish --parts" | "paper --data" | "paper --out")
      COMPREPLY=($(compgen -d -- "$current"))
      return
      ;;
    "tile-check --grid" | "serve --grid")
      COMPREPLY=($(compgen -W 'geographic mercator' -- "$current"))
      return
      ;;
    "serve --host")
      COMPREPLY=($(compgen -W '127.0.0.1 0.0.0.0 ::1 ::' -- "$current"))
      return
      ;;
    "generate --of")
      COMPREPLY=($(compgen -W 'tif pgm' -- "$current"))
      return
      ;;
  esac

  if [[ $current == -* ]]; then
    case $command in
      simplify)
        options+=' --max-error --max-triangles --max-points --objective --band --te --resolution --decode'
        options+=' --z-scale --z-offset --z-unit --cell-size --crs --up --double --of'
        options+=' --normals --uvs --compress --drape --drape-size --drape-format --normal-map --preview'
        options+=' --render --error-raster --html --report --overwrite --effort --vertices --min-shape'
        options+=' --time-limit --lods --lods-in-one --lock-border --nodata --nodata-policy --fill-distance --background'
        options+=' --outline-tolerance --mask --tolerance --roi --falloff --script --breaklines --breakline-z'
        options+=' --soft-breaklines --line-conflict --cutline --inset --mask-outside --cliff --ridges --keep-ridges'
        options+=' --materials --material-field --node-strings --water --water-percentile --detect-flats --rivers --min-angle'
        options+=' --max-edge --min-edge --grade --base --solid --split --memory --num-threads'
        options+=' --quiet --timing --json-progress --help --help-all --version --texture --texture-weight'
        options+=' --image --norm --channel-weights --points --duplicates --layer --z-field --columns'
        options+=' --boundary --order --importance --one-pass --algorithm --batch --edges --edge-score'
        options+=' --shape-threshold --supersample'
        ;;
      measure)
        options+=' --fail-above --band --te --resolution --decode --z-scale --z-offset --z-unit'
        options+=' --cell-size --crs --up --json --map --error-raster --overwrite --nodata'
        options+=' --mask --tolerance --roi --falloff --script --cutline --inset --mask-outside'
        options+=' --memory --num-threads --quiet --json-progress --help --help-all --version --texture'
        options+=' --texture-weight --image --norm --channel-weights --points --duplicates --layer --z-field'
        options+=' --columns --boundary'
        ;;
      view)
        options+=' --band --te --resolution --decode --z-scale --z-offset --z-unit --cell-size'
        options+=' --crs --up --output --open --overwrite --nodata --quiet --help'
        options+=' --help-all --version'
        ;;
      tile)
        options+=' --band --te --resolution --decode --z-scale --z-offset --z-unit --cell-size'
        options+=' --breaklines --vertical --geoid --ellipsoid --only --report --overwrite --of'
        options+=' --drape --drape-format --effort --max-error --quality --zoom --grid --bound'
        options+=' --max-tile-bytes --cells --nodata --nodata-policy --fill-distance --background --water --watermask'
        options+=' --water-percentile --rivers --num-threads --quiet --json-progress --help --help-all --version'
        ;;
      tile-plan)
        options+=' --band --te --resolution --decode --z-scale --z-offset --z-unit --cell-size'
        options+=' --breaklines --vertical --geoid --ellipsoid --only --changed-since --hash --overwrite'
        options+=' --of --drape --drape-format --shards --slurm --effort --max-error --quality'
        options+=' --zoom --grid --bound --max-tile-bytes --cells --nodata --nodata-policy --fill-distance'
        options+=' --background --water --watermask --water-percentile --rivers --survey --quiet --json-progress'
        options+=' --help --help-all --version'
        ;;
      tile-run)
        options+=' --shard --only --parts --memory --num-threads --quiet --json-progress --help'
        options+=' --help-all --version'
        ;;
      tile-finish)
        options+=' --report --overwrite --parts --num-threads --quiet --json-progress --help --help-all'
        options+=' --version'
        ;;
      tile-check)
        options+=' --source --band --te --resolution --decode --z-scale --z-offset --z-unit'
        options+=' --cell-size --grid --vertical --geoid --ellipsoid --json --cells --nodata'
        options+=' --nodata-policy --fill-distance --background --num-threads --quiet --json-progress --help --help-all'
        options+=' --version'
        ;;
      serve)
        options+=' --band --te --resolution --decode --z-scale --z-offset --z-unit --breaklines'
        options+=' --vertical --geoid --ellipsoid --effort --max-error --quality --zoom --grid'
        options+=' --max-tile-bytes --cells --nodata --nodata-policy --fill-distance --background --water --watermask'
        options+=' --water-percentile --rivers --memory --port --host --num-threads --quiet --json-progress'
        options+=' --help --help-all --version'
        ;;
      info)
        options+=' --band --te --resolution --decode --z-scale --z-offset --z-unit --cell-size'
        options+=' --crs --no-suggest --json --nodata --quiet --json-progress --help --help-all'
        options+=' --version --points --layer --z-field --columns'
        ;;
      generate)
        options+=' --seed --range --size --of --overwrite --quiet --help --help-all'
        options+=' --version'
        ;;
      paper)
        options+=' --data --out --no-timing --overwrite --quiet --help --help-all --version'
        ;;
      help)
        options+=' --all --json --help --help-all --version'
        ;;
      version)
        options+=' --help --help-all --version'
        ;;
    esac
    COMPREPLY=($(compgen -W "$options" -- "$current"))
    return
  fi
  if [[ $command == generate && $COMP_CWORD -eq 2 ]]; then
    COMPREPLY=($(compgen -W 'cliff step sharp-step diagonal-step sharp-diagonal-step parabola paraboloid scaled-paraboloid pyramid diagonal-pyramid fractal smooth' -- "$current"))
    return
  fi
  if [[ $command == help && $COMP_CWORD -eq 2 ]]; then
    COMPREPLY=($(compgen -W 'simplify measure view tile tile-plan tile-run tile-finish tile-check serve info generate paper help version' -- "$current"))
    return
  fi
  COMPREPLY=($(compgen -f -- "$current"))
}

complete -o filenames -o bashdefault -F _scarp scarp
