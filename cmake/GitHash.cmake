# SPDX-License-Identifier: LGPL-2.1-or-later
# The git hash, looked up at every build and seen by one source file only, so
# that a new commit recompiles nothing else. Run as a script (cmake -P) this
# file writes the header; included, it offers slipstep_provide_git_hash().
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude "*"
                  WORKING_DIRECTORY "${SOURCE_DIR}"
                  OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE
                  ERROR_QUIET RESULT_VARIABLE failed)
  if(failed)
    set(hash "unknown")
  endif()
  set(text "#define SLIPSTEP_GIT_HASH \"${hash}\"\n")
  if(EXISTS "${HEADER}")
    file(READ "${HEADER}" old_text)
  endif()
  if(NOT text STREQUAL "${old_text}")
    file(WRITE "${HEADER}" "${text}")
  endif()
  return()
endif()

function(slipstep_provide_git_hash target source)
  set(header "${PROJECT_BINARY_DIR}/generated/slipstep_git_hash.h")
  add_custom_target(slipstep_git_hash
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR}
            -DHEADER=${header} -P "${PROJECT_SOURCE_DIR}/cmake/GitHash.cmake"
    BYPRODUCTS "${header}"
    COMMENT "")
  add_dependencies(${target} slipstep_git_hash)
  set_source_files_properties("${source}" PROPERTIES
    INCLUDE_DIRECTORIES "${PROJECT_BINARY_DIR}/generated"
    COMPILE_DEFINITIONS "SLIPSTEP_VERSION=\"${PROJECT_VERSION}\"")
endfunction()
