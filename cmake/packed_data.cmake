# scarp_packed_data(TARGET ROOM HEADER NAME FILE): compiles the file into the target as NAME, an array of big-endian
# 64-bit words, and NAMEWords, its length. The room's header declares both. The file's length must be a multiple of 8
# bytes.
function(scarp_packed_data target room header name file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} digits HEX)
  string(REGEX REPLACE "(................)" "0x\\1,\n" words "${digits}")
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  set(text "#include \"${room}/${header}\"\n\nnamespace scarp::${room} {\n\nconst std::uint64_t ${name}[] = {\n${words}};\n")
  string(APPEND text "const std::size_t ${name}Words = sizeof ${name} / sizeof *${name};\n\n}  // namespace scarp::${room}\n")
  file(CONFIGURE OUTPUT ${source} CONTENT "${text}" @ONLY)
  target_sources(${target} PRIVATE ${source})
endfunction()
