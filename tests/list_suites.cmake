# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes a file for ctest with one test per test suite of a GoogleTest program:
#   cmake -DPROGRAM=friction_test -DLABEL=friction -DOUTPUT=... -P list_suites.cmake
# Loading the libraries of deal.II takes half a second, more than most tests, so
# that one process runs a whole suite, and all suites of a room whose tests are
# short; but the campaigns of HiddenCampaign, each of which takes longer, run side
# by side. Long ones begin first, so that none is left alone at the end.
cmake_minimum_required(VERSION 3.21)
set(SHORT utilities friction measured_data experiment report law_library)
set(LONG restart verification fuzz diagnosis)
set(ENV{ASAN_OPTIONS} detect_leaks=0) # MPI is not free of them
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests
                OUTPUT_VARIABLE list RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}")
endif()

string(REGEX REPLACE " +#[^\n]*" "" list "${list}") # values of parameters
set(names "")
string(REGEX MATCHALL "[^\n]+" lines "${list}")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+\\.)")
    set(suite "${CMAKE_MATCH_1}")
    if(NOT suite STREQUAL "HiddenCampaign.")
      list(APPEND names "${suite}*")
    endif()
  elseif(suite STREQUAL "HiddenCampaign." AND line MATCHES "^  ([^ ]+)")
    list(APPEND names "${suite}${CMAKE_MATCH_1}")
  endif()
endforeach()

set(cost 1)
if(LABEL IN_LIST SHORT)
  set(names "${LABEL}")
elseif(LABEL IN_LIST LONG)
  set(cost 10)
endif()

set(script "")
foreach(name IN LISTS names)
  set(filter "${name}")
  if(LABEL IN_LIST SHORT)
    set(filter "*")
  endif()
  string(APPEND script
    "add_test([[${name}]] [[${PROGRAM}]] [[--gtest_filter=${filter}]])\n"
    "set_tests_properties([[${name}]] PROPERTIES LABELS [[${LABEL}]] "
    "COST ${cost} TIMEOUT 7200 WORKING_DIRECTORY [[${DIRECTORY}]])\n")
endforeach()
file(WRITE "${OUTPUT}" "${script}")
