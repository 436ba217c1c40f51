# scarp_batch(TARGET SIZE): with CMAKE_UNITY_BUILD, compiles the target's sources in batches of at most SIZE, each from
# one folder, so that headers are parsed once a batch. Private names must be unique in a folder.
# SKIP_UNITY_BUILD_INCLUSION marks sources that cannot share a translation unit. SCARP_BATCH overrides SIZE: one-time
# builds without optimization compile a folder at once.
function(scarp_batch target size)
  if(SCARP_BATCH)
    set(size ${SCARP_BATCH})
  endif()
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    if(source MATCHES "[$]<")  # objects of another target
      continue()
    endif()
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${folder} OUTPUT_VARIABLE name)
    cmake_path(GET name PARENT_PATH room)
    list(APPEND rooms room_${room})
    list(APPEND sources_of_room_${room} ${name})
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  foreach(room IN LISTS rooms)
    # The required number of batches of similar size.
    list(LENGTH sources_of_${room} count)
    math(EXPR batches "(${count} + ${size} - 1) / ${size}")
    set(index 0)
    string(MAKE_C_IDENTIFIER "${room}" prefix)
    foreach(name IN LISTS sources_of_${room})
      math(EXPR batch "${index} * ${batches} / ${count}")
      set_source_files_properties(${name} PROPERTIES UNITY_GROUP ${prefix}_${batch})
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# Parts without loops over samples, triangles or vertices: optimizing them is a third of their compilation time, and no
# gain.
set(scarp_light_options $<$<CONFIG:Release>:-O1>$<$<CONFIG:Debug>:-O0>)
