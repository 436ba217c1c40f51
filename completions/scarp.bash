# bash completion for scarp: verbs, options, and what an option takes.

_scarp() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb='' word
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case $word in simplify | measure | info | generate | paper) verb=$word && break ;; esac
  done

  if [[ -z $verb ]]; then
    COMPREPLY=($(compgen -W 'simplify measure info generate paper --help --version' -- "$current"))
    return
  fi

  case $previous in
    --of)
      local formats='glb obj ply stl tin 2dm vtu vtp landxml dxf gpkg svg eps dem'
      [[ $verb == generate ]] && formats='tif pgm'
      COMPREPLY=($(compgen -W "$formats" -- "$current")) && return
      ;;
    --data | --out) COMPREPLY=($(compgen -d -- "$current")) && return ;;
    --decode) COMPREPLY=($(compgen -W 'terrarium mapbox' -- "$current")) && return ;;
    --nodata-policy) COMPREPLY=($(compgen -W 'hole fill background' -- "$current")) && return ;;
    --crs) COMPREPLY=($(compgen -W 'source local grid EPSG:' -- "$current")) && return ;;
    --importance)
      COMPREPLY=($(compgen -W 'global local local8 curvature global*local global*local8 global*curvature' -- "$current"))
      return
      ;;
    --effort) COMPREPLY=($(compgen -W 'fast normal high max' -- "$current")) && return ;;
    --vertices) COMPREPLY=($(compgen -W 'free samples' -- "$current")) && return ;;
    --objective) COMPREPLY=($(compgen -W 'max rms' -- "$current")) && return ;;
    --order) COMPREPLY=($(compgen -W 'dominant greedy' -- "$current")) && return ;;
    --algorithm) COMPREPLY=($(compgen -W 'brute local heap' -- "$current")) && return ;;
    --batch) COMPREPLY=($(compgen -W 'const frac: independent' -- "$current")) && return ;;
    --edges) COMPREPLY=($(compgen -W 'delaunay data' -- "$current")) && return ;;
    --edge-score) COMPREPLY=($(compgen -W 'sum max sqerr abn tight' -- "$current")) && return ;;
    --duplicates) COMPREPLY=($(compgen -W 'first last highest lowest mean' -- "$current")) && return ;;
    --line-conflict) COMPREPLY=($(compgen -W 'error first mean highest' -- "$current")) && return ;;
    --norm) COMPREPLY=($(compgen -W 'l1 l2 linf' -- "$current")) && return ;;
    --preview | --render | --error-raster | --report | --map | --mask | --tolerance | --script | --texture | --breaklines | --water | --rivers | --cutline | --roi)
      COMPREPLY=($(compgen -f -- "$current"))
      return
      ;;
    -e | --max-error | -t | --max-triangles | -p | --max-points | --band | --nodata | --fill-distance | --background | \
      --outline-tolerance | --base | --solid | --split | --shape-threshold | --supersample | --texture-weight | --channel-weights | -j | \
      --num-threads | --memory | --fail-above | --layer | --z-field | --breakline-z | --water-percentile | --detect-flats | --inset | --min-angle | --max-edge | --grade | --cliff | --ridges | --falloff | --seed | --range | --size)
      return
      ;;
  esac

  if [[ $current == -* ]]; then
    local options='--help --version --band --nodata --decode --crs --quiet --json-progress'
    case $verb in
      generate) options='--help --version --seed --range --size --of --overwrite --quiet' ;;
      paper) options='--help --version --data --out --no-timing --overwrite --quiet' ;;
      simplify)
        options+=' --max-error --max-triangles --max-points --nodata-policy --fill-distance --background'
        options+=' --outline-tolerance --of --normals --base --solid --split --preview --report --overwrite --num-threads --memory'
        options+=' --mask --tolerance --roi --falloff --script --image --texture --texture-weight --norm --channel-weights'
        options+=' --timing --effort --vertices --min-shape --time-limit --objective --importance --one-pass --order --algorithm --batch --edges --edge-score --shape-threshold --supersample'
        options+=' --breaklines --breakline-z --soft-breaklines --line-conflict --water --water-percentile --detect-flats --rivers --cliff --ridges --keep-ridges'
        options+=' --min-angle --max-edge --grade'
        options+=' --cutline --inset --mask-outside'
        options+=' --uvs --render --error-raster'
        options+=' --points --duplicates --layer --z-field'
        ;;
      measure)
        options+=' --points --duplicates --layer --z-field'
        options+=' --fail-above --json --map --error-raster --overwrite --num-threads --memory'
        options+=' --cutline --inset --mask-outside'
        options+=' --mask --tolerance --roi --falloff --script --image --texture --texture-weight --norm --channel-weights'
        ;;
      info) options+=' --json' ;;
    esac
    COMPREPLY=($(compgen -W "$options" -- "$current"))
    return
  fi
  if [[ $verb == generate && $COMP_CWORD -eq 2 ]]; then
    COMPREPLY=($(compgen -W 'cliff step sharp-step diagonal-step sharp-diagonal-step parabola paraboloid
      scaled-paraboloid pyramid diagonal-pyramid fractal smooth' -- "$current"))
    return
  fi
  COMPREPLY=($(compgen -f -- "$current"))
}

complete -o filenames -o bashdefault -F _scarp scarp
