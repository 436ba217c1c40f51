# fish completion for scarp: verbs, options, and what an option takes.

complete -c scarp -n __fish_use_subcommand -f -a simplify -d 'Turn a raster into a small mesh with a proven error bound'
complete -c scarp -n __fish_use_subcommand -f -a measure -d 'Judge a mesh file against its raster'
complete -c scarp -n __fish_use_subcommand -f -a info -d 'Describe a raster and suggest errors for it'
complete -c scarp -n __fish_use_subcommand -f -a generate -d 'Make a synthetic raster of heights'
complete -c scarp -n __fish_use_subcommand -f -a paper -d 'Repeat the experiments of the report'

complete -c scarp -s h -l help -d 'Print help'
complete -c scarp -l version -d 'Print the version'

set -l verbs simplify measure info
complete -c scarp -n "__fish_seen_subcommand_from $verbs" -l band -x -d 'Band to read, counted from 1'
complete -c scarp -n "__fish_seen_subcommand_from $verbs" -l nodata -x -d 'Value that marks missing samples'
complete -c scarp -n "__fish_seen_subcommand_from $verbs" -l decode -x -a 'terrarium mapbox' -d 'Heights packed into RGB'
complete -c scarp -n "__fish_seen_subcommand_from $verbs" -l crs -x -a 'source local grid EPSG:' -d 'Coordinates of the mesh'
complete -c scarp -n "__fish_seen_subcommand_from $verbs" -s q -l quiet -d 'No progress, no warnings'
complete -c scarp -n "__fish_seen_subcommand_from $verbs" -l json-progress -d 'Progress as JSON lines on stderr'

complete -c scarp -n '__fish_seen_subcommand_from simplify measure' -s j -l num-threads -x -d 'Threads, 0 = all cores'
complete -c scarp -n '__fish_seen_subcommand_from simplify measure' -l overwrite -d 'Replace files that exist'
complete -c scarp -n '__fish_seen_subcommand_from measure info' -l json -d 'The report as JSON on stdout'

complete -c scarp -n '__fish_seen_subcommand_from simplify' -s e -l max-error -x -d 'Error bound, in z units or 0.5%'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -s t -l max-triangles -x -d 'At most this many triangles'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -s p -l max-points -x -d 'At most this many vertices'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l nodata-policy -x -a 'hole fill background' -d 'What missing samples become'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l fill-distance -x -d 'Farthest valid sample to interpolate from'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l background -x -d 'Height of missing samples'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l outline-tolerance -x -d 'How far the outline may move outwards'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l of -x -a 'glb obj ply stl' -d 'Mesh format'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l normals -d 'Vertex normals from the full-resolution raster'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l base -x -d 'Close into a solid with a base at this height'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l preview -r -d 'Hillshade with the mesh over it (PNG)'
complete -c scarp -n '__fish_seen_subcommand_from simplify' -l report -r -d 'Numbers of this run (JSON)'

complete -c scarp -n '__fish_seen_subcommand_from measure' -l fail-above -x -d 'Exit code 3 if any error is above this'
complete -c scarp -n '__fish_seen_subcommand_from measure' -l map -r -d 'Signed errors in colours (PNG)'

complete -c scarp -n '__fish_seen_subcommand_from generate' -f -a 'cliff step sharp-step diagonal-step sharp-diagonal-step parabola paraboloid scaled-paraboloid pyramid diagonal-pyramid fractal'
complete -c scarp -n '__fish_seen_subcommand_from generate' -l seed -x -d 'Which fractal'
complete -c scarp -n '__fish_seen_subcommand_from generate' -l range -x -d 'Stretch the heights to 0 ... R'
complete -c scarp -n '__fish_seen_subcommand_from generate' -l size -x -d 'Side of a cell'
complete -c scarp -n '__fish_seen_subcommand_from generate' -l of -x -a 'tif pgm' -d 'Raster format'
complete -c scarp -n '__fish_seen_subcommand_from paper' -l data -r -d 'Folder with the rasters'
complete -c scarp -n '__fish_seen_subcommand_from paper' -l out -r -d 'Folder for paper.md and its pictures'
complete -c scarp -n '__fish_seen_subcommand_from paper' -l no-timing -d 'Leave out times and memory'
complete -c scarp -n '__fish_seen_subcommand_from generate paper' -l overwrite -d 'Replace files that exist'
complete -c scarp -n '__fish_seen_subcommand_from generate paper' -s q -l quiet -d 'No summary'
