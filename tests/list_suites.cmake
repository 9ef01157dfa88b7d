# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes a file for ctest with one test per test suite of a GoogleTest program:
#   cmake -DPROGRAM=friction_test -DLABEL=friction -DOUTPUT=... -P list_suites.cmake
# Loading the libraries of deal.II takes a third of a second, more than most
# tests of the lower rooms, so that one process runs a whole suite there.
set(ENV{ASAN_OPTIONS} detect_leaks=0) # MPI is not free of them
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests
                OUTPUT_VARIABLE list RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}")
endif()

string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${list}")
set(script "")
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(APPEND script
    "add_test([[${suite}*]] [[${PROGRAM}]] [[--gtest_filter=${suite}*]])\n"
    "set_tests_properties([[${suite}*]] PROPERTIES LABELS [[${LABEL}]] "
    "TIMEOUT 7200 WORKING_DIRECTORY [[${DIRECTORY}]])\n")
endforeach()
file(WRITE "${OUTPUT}" "${script}")
