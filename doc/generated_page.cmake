# SPDX-License-Identifier: LGPL-2.1-or-later
# Runs "PROGRAM COMMAND [ARGUMENT] --format md" and makes its output the Doxygen
# page with the id ID (or COMMAND): own title, and formulas in Doxygen's notation.
if(NOT ID)
  set(ID "${COMMAND}")
endif()
execute_process(COMMAND "${PROGRAM}" "${COMMAND}" ${ARGUMENT} --format md
                OUTPUT_VARIABLE text RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${PROGRAM} ${COMMAND} --format md failed")
endif()
string(REGEX REPLACE "^# [^\n]*\n" "" text "${text}")
string(REGEX REPLACE "\\$([^$\n]+)\\$" "@f$\\1@f$" text "${text}")
# Placeholders such as <speed> are no HTML.
string(REGEX REPLACE "<([a-z][a-z ]*)>" "&lt;\\1&gt;" text "${text}")
file(WRITE "${PAGE}" "# ${TITLE} {#${ID}}\n\n[TOC]\n\n${text}")
