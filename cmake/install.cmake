# Destinations of `cmake --install`: program, library, headers, CMake package, pkg-config file, man page, completions.
include(CMakePackageConfigHelpers)

install(TARGETS scarp EXPORT scarpTargets)
if(NOT SCARP_WITH_TILES)  # scarp.h must not include headers that are not installed
  set(scarp_not_installed REGEX "/(tile(_job|_set)?|scarp)[.]h$" EXCLUDE)
  file(READ ${PROJECT_SOURCE_DIR}/include/scarp/scarp.h text)
  string(REGEX REPLACE "#include \"scarp/tile[^\n]*\n" "" text "${text}")
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/scarp.h CONTENT "${text}" @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/scarp.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scarp)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/scarp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h"
        ${scarp_not_installed})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(SCARP_BUILD_C)
  install(TARGETS scarp_c EXPORT scarpTargets)
  if(NOT BUILD_SHARED_LIBS)
    install(TARGETS scarp_c_static)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/bindings/c/scarp_c.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()

# find_package(scarp): the consumer also searches for the library's dependencies.
set(scarp_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/scarp)
get_target_property(scarp_type scarp TYPE)
if(scarp_type STREQUAL "STATIC_LIBRARY")
  set(SCARP_IS_STATIC ON)
else()
  set(SCARP_IS_STATIC OFF)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/scarpConfig.cmake.in ${PROJECT_BINARY_DIR}/scarpConfig.cmake
                              INSTALL_DESTINATION ${scarp_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/scarpConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT scarpTargets NAMESPACE scarp:: DESTINATION ${scarp_package_dir})
install(FILES ${PROJECT_BINARY_DIR}/scarpConfig.cmake ${PROJECT_BINARY_DIR}/scarpConfigVersion.cmake
        DESTINATION ${scarp_package_dir})

# pkg-config: paths are relative to the file, so `--prefix` at install time works. A static library passes on its own
# libraries.
set(scarp_requires fmt)
if(SCARP_WITH_GDAL)
  string(APPEND scarp_requires ", gdal")
endif()
set(scarp_libs "-lhwy -lz -pthread")
if(SCARP_WITH_TILES)
  string(PREPEND scarp_libs "-lsqlite3 ")
endif()
if(SCARP_WITH_MESHOPTIMIZER)
  string(PREPEND scarp_libs "-lmeshoptimizer ")
endif()
if(SCARP_IS_STATIC)
  set(scarp_requires_fields "Requires: ${scarp_requires}\nLibs: -L\${libdir} -lscarp ${scarp_libs}")
else()
  set(scarp_requires_fields "Requires.private: ${scarp_requires}\nLibs: -L\${libdir} -lscarp\nLibs.private: ${scarp_libs}")
endif()
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(SCARP_PC_PREFIX ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH scarp_pc_up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  string(REGEX REPLACE "/$" "" scarp_pc_up "${scarp_pc_up}")
  set(SCARP_PC_PREFIX "\${pcfiledir}/${scarp_pc_up}")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/scarp.pc.in ${PROJECT_BINARY_DIR}/scarp.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/scarp.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(SCARP_BUILD_C)
  set(scarp_c_requires_fields
      "Requires.private: ${scarp_requires}\nLibs: -L\${libdir} -lscarp_c\nLibs.private: ${scarp_libs} -lstdc++ -lm")
  configure_file(${CMAKE_CURRENT_LIST_DIR}/scarp_c.pc.in ${PROJECT_BINARY_DIR}/scarp_c.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/scarp_c.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()

if(SCARP_BUILD_APPS)
  # The program finds a shared library next to it, wherever the prefix is moved.
  file(RELATIVE_PATH scarp_bin_to_lib "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(scarp_program PROPERTIES INSTALL_RPATH "$ORIGIN/${scarp_bin_to_lib}")
  install(TARGETS scarp_program)
  # The viewer's page, if `make viewer` has built it.
  install(FILES ${PROJECT_BINARY_DIR}/share/scarp/viewer.html DESTINATION ${CMAKE_INSTALL_DATADIR}/scarp OPTIONAL)
  # Files that apps/scarp makes from the table of options; none without Python.
  install(FILES ${PROJECT_BINARY_DIR}/share/man/man1/scarp.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
  foreach(completions bash-completion/completions/scarp zsh/site-functions/_scarp fish/vendor_completions.d/scarp.fish)
    get_filename_component(folder ${completions} DIRECTORY)
    install(FILES ${PROJECT_BINARY_DIR}/share/${completions} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder} OPTIONAL)
  endforeach()
endif()
