# SPDX-License-Identifier: LGPL-2.1-or-later
# slipstep_embed_text(<target> <file> <name>)
# Makes the text of a file a constant of C++, <name> in slipstep_<name>.h, for
# the sources of a target. Its first line is left out if it is a licence in a
# comment of JavaScript or CSS: that is in the page which it becomes part of.
function(slipstep_embed_text target file name)
  file(READ "${PROJECT_SOURCE_DIR}/${file}" text)
  string(REGEX REPLACE "^/[*/] SPDX-[^\n]*\n" "" text "${text}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/embedded_text.h.in"
                 "${PROJECT_BINARY_DIR}/generated/slipstep_${name}.h" @ONLY)
  target_include_directories(${target} PRIVATE
                             "${PROJECT_BINARY_DIR}/generated")
endfunction()
