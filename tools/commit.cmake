# SPDX-License-Identifier: GPL-3.0-or-later
# Writes HEADER with the commit of SOURCE, "-modified" behind it if files differ from it; touches
# nothing where it says so already. Run at every build, for a commit changes no file that is built.
cmake_minimum_required(VERSION 3.18)
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} describe --always --exclude=* --abbrev=12 --dirty=-modified
                  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE
                  ERROR_QUIET)
endif()
if("${COMMIT}" STREQUAL "")
  set(COMMIT unknown)
endif()
file(WRITE ${HEADER}.new "#define PERRIN_COMMIT \"${COMMIT}\"\n")
execute_process(COMMAND ${CMAKE_COMMAND} -E copy_if_different ${HEADER}.new ${HEADER})
file(REMOVE ${HEADER}.new)
