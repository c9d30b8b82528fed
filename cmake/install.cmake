# SPDX-License-Identifier: GPL-3.0-or-later
# What `make install` puts under a prefix: the program, the C library with its header, and what
# pkg-config and CMake need to find it there. Nothing in these files names the prefix, so the tree
# may be moved.

# The library that others link is one object whose only external names are perrin_*, so that
# nothing inside it meets a name of theirs.
set(PERRIN_PUBLIC_LIBRARY ${CMAKE_BINARY_DIR}/public/libperrin.a)
add_custom_command(
  OUTPUT ${PERRIN_PUBLIC_LIBRARY}
  COMMAND ${CMAKE_COMMAND} -E make_directory public
  COMMAND ${CMAKE_COMMAND} -E rm -f ${PERRIN_PUBLIC_LIBRARY}
  COMMAND ${CMAKE_LINKER} -r --whole-archive $<TARGET_FILE:libperrin> -o public/perrin.o
  COMMAND ${CMAKE_OBJCOPY} --wildcard "--keep-global-symbol=perrin_*" public/perrin.o
  COMMAND ${CMAKE_AR} qcsD ${PERRIN_PUBLIC_LIBRARY} public/perrin.o
  WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
  DEPENDS libperrin
  COMMENT "Library with public names only"
  VERBATIM)
add_custom_target(perrin-public ALL DEPENDS ${PERRIN_PUBLIC_LIBRARY})

set(PERRIN_REQUIRES "yaml-0.1 hdf5-serial gsl fftw3")
configure_file(cmake/perrin.pc.in public/perrin.pc @ONLY)
# By these names find_package finds it as Perrin and as perrin.
configure_file(cmake/PerrinConfig.cmake.in public/perrin-config.cmake @ONLY)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/public/perrin-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)

install(TARGETS perrin RUNTIME DESTINATION bin)
install(FILES ${PERRIN_PUBLIC_LIBRARY} DESTINATION lib)
install(DIRECTORY include/perrin DESTINATION include)
install(FILES ${CMAKE_BINARY_DIR}/public/perrin.pc DESTINATION lib/pkgconfig)
install(FILES ${CMAKE_BINARY_DIR}/public/perrin-config.cmake
              ${CMAKE_BINARY_DIR}/public/perrin-config-version.cmake
        DESTINATION lib/cmake/Perrin)
install(DIRECTORY examples gallery DESTINATION share/perrin)
install(FILES docs/perrin.1 DESTINATION share/man/man1)
install(DIRECTORY docs/ DESTINATION share/doc/perrin FILES_MATCHING PATTERN "*.md")
install(FILES LICENSE CITATION.cff CHANGELOG.md DESTINATION share/doc/perrin)
