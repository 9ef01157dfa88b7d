# SPDX-License-Identifier: LGPL-2.1-or-later
# The libraries of the program, gathered in the target slipstep_dependencies.
# Their headers are system headers: warnings in them are not ours.
string(CONCAT slipstep_deal_II_remedy
    "On Debian 12: apt-get install libdeal.ii-dev. A deal.II of your own needs "
    "-DDEAL_II_WITH_MPI=ON -DDEAL_II_WITH_P4EST=ON -DDEAL_II_WITH_TRILINOS=ON "
    "-DDEAL_II_WITH_MUPARSER=ON; "
    "name its folder with -Ddeal.II_DIR=<folder>.")

find_package(deal.II 9.4.1 QUIET HINTS "$ENV{DEAL_II_DIR}")
if(NOT deal.II_FOUND)
  if(deal.II_CONSIDERED_VERSIONS)
    set(slipstep_found " (found only ${deal.II_CONSIDERED_VERSIONS})")
  endif()
  message(FATAL_ERROR "slipstep needs deal.II 9.4.1 or newer${slipstep_found}. "
                      "${slipstep_deal_II_remedy}")
endif()
foreach(feature IN ITEMS MPI P4EST TRILINOS MUPARSER)
  if(NOT DEAL_II_WITH_${feature})
    message(FATAL_ERROR "The deal.II in ${DEAL_II_PATH} was built without "
                        "${feature}, which slipstep needs. "
                        "${slipstep_deal_II_remedy}")
  endif()
endforeach()

find_package(Boost 1.74 QUIET COMPONENTS program_options)
if(NOT Boost_FOUND)
  message(FATAL_ERROR "slipstep needs Boost.Program_options. "
                      "On Debian 12: apt-get install libboost-program-options-dev")
endif()

find_package(nlohmann_json 3 QUIET)
if(NOT nlohmann_json_FOUND)
  message(FATAL_ERROR "slipstep needs nlohmann-json 3. "
                      "On Debian 12: apt-get install nlohmann-json3-dev")
endif()

find_package(Ceres 2.1 QUIET)
if(NOT Ceres_FOUND)
  message(FATAL_ERROR "slipstep needs Ceres Solver 2.1. On Debian 12: "
                      "apt-get install libceres-dev libopenblas0-serial")
endif()

# deal.II's own DEAL_II_SETUP_TARGET would mix its headers with ours, and add
# flags and a linker that this project chooses itself.
include("${DEAL_II_TARGET_CONFIG}")
set(deal_II_includes ${DEAL_II_INCLUDE_DIRS})
list(REMOVE_ITEM deal_II_includes "/usr/include")

if(CMAKE_BUILD_TYPE STREQUAL "Release" OR NOT TARGET "${DEAL_II_TARGET_DEBUG}")
  set(deal_II_flavour RELEASE)
else()
  set(deal_II_flavour DEBUG)
endif()

add_library(slipstep_dependencies INTERFACE)
target_include_directories(slipstep_dependencies SYSTEM
                           INTERFACE ${deal_II_includes})
target_compile_definitions(slipstep_dependencies INTERFACE
                           ${DEAL_II_USER_DEFINITIONS}
                           ${DEAL_II_USER_DEFINITIONS_${deal_II_flavour}})
target_link_libraries(slipstep_dependencies INTERFACE
                      ${DEAL_II_TARGET_${deal_II_flavour}}
                      Boost::program_options nlohmann_json::nlohmann_json)
