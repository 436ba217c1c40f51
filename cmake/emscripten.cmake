# scarp_core under Emscripten: its libraries are headers, taken from the machine's own packages through a folder of links,
# so that nothing else of /usr/include is seen.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(library fmt tl hwy)
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
target_link_libraries(fmt::fmt INTERFACE scarp_headers)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=',')

target_compile_options(scarp_flags INTERFACE -fwasm-exceptions -msimd128)
target_link_options(scarp_flags INTERFACE -fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=1048576)
