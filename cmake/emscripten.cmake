# scarp_core under Emscripten: its libraries are headers from the machine's packages, in a folder of links that hides
# the rest of /usr/include.
set(headers ${PROJECT_BINARY_DIR}/libraries)
file(MAKE_DIRECTORY ${headers})
foreach(library tl hwy)
  if(NOT EXISTS /usr/include/${library})
    message(FATAL_ERROR "/usr/include/${library} is missing: tools/install_packages.sh build")
  endif()
  file(CREATE_LINK /usr/include/${library} ${headers}/${library} SYMBOLIC)
endforeach()

add_library(scarp_headers INTERFACE)
target_include_directories(scarp_headers SYSTEM INTERFACE ${headers})
foreach(name tl::expected hwy::hwy Threads::Threads)
  add_library(${name} INTERFACE IMPORTED)
  target_link_libraries(${name} INTERFACE scarp_headers)
endforeach()
add_library(fmt::fmt INTERFACE IMPORTED)
target_include_directories(fmt::fmt INTERFACE ${PROJECT_SOURCE_DIR}/bindings/wasm/headers)

# -fno-rtti: type names are 20 kB, and nothing uses them.
target_compile_options(scarp_flags INTERFACE -fwasm-exceptions -msimd128 -mbulk-memory -mnontrapping-fptoint -msign-ext -fno-rtti)
target_compile_definitions(scarp_flags INTERFACE SCARP_WITHOUT_THREADS)
target_link_options(scarp_flags INTERFACE -fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=1048576)

# Hot sources of meshes, their proof, a Refiner and a Tiler (node --cpu-prof of a module linked with --profiling-funcs).
string(JOIN "|" SCARP_HOT_SOURCES
  "/fit/(cut|flips|height_step|norm|patch|relocation|removal|repair|ring|sample|schedule|triangle|vertex)"
  /geom/scan_kernels "/grid/(height_range|samples|window)" "/mesh/(half_edges|order|thin_triangles)" /metric/[a-z]*_metric
  "/measure/(band|edges|error_summary|facet_error|facet_task|frame_scanner|grid_places|grid_scanner|judge_kernels|point_judge|shape)"
  "/pieces/(freeze|tile_worker)" "/refine/(coarse|data|dominant|lazy|refinement|scattered|settle|tile(_order|_scanner)?[.])"
  /simplify/simplify_points /tiles/mesh/node_scan /tiles/nodes/raster_nodes "/tin/(assembly|tile_mesh|triangulation)")
