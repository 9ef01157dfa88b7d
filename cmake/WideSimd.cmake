# SPDX-License-Identifier: LGPL-2.1-or-later
# Debian builds deal.II for any amd64 processor, with SIMD types of one number.
# The matrix-free units of this program want types as wide as the processor: they
# see a copy of deal.II's base/config.h with the width changed, before the
# installed one, and instantiate what they need of the library themselves.
#   -DSLIPSTEP_SIMD=auto   as wide as this machine (default)
#   -DSLIPSTEP_SIMD=128 | 256 | 512   bits; any processor, AVX2, AVX-512
#   -DSLIPSTEP_SIMD=library   what deal.II was built with
# A deal.II that was built with wide types is left as it is.
set(SLIPSTEP_SIMD "auto" CACHE STRING
    "Width of SIMD types in the matrix-free units: auto, library, 128, 256, 512")
set_property(CACHE SLIPSTEP_SIMD PROPERTY STRINGS auto library 128 256 512)

set(slipstep_config_h "deal.II/base/config.h")
find_path(SLIPSTEP_CONFIG_FOLDER "${slipstep_config_h}"
          HINTS ${DEAL_II_INCLUDE_DIRS} NO_CACHE)
file(READ "${SLIPSTEP_CONFIG_FOLDER}/${slipstep_config_h}" slipstep_config)
string(REGEX MATCH "define DEAL_II_VECTORIZATION_WIDTH_IN_BITS ([0-9]+)"
       slipstep_match "${slipstep_config}")
set(slipstep_library_width "${CMAKE_MATCH_1}")

# The widest that the processor of this machine runs.
function(slipstep_detect_simd_width result)
  file(WRITE "${PROJECT_BINARY_DIR}/simd_width.cc" "
int main()
{
  return __builtin_cpu_supports(\"avx512f\") &&
             __builtin_cpu_supports(\"avx512dq\") &&
             __builtin_cpu_supports(\"avx512bw\") &&
             __builtin_cpu_supports(\"avx512vl\") ? 3 :
         __builtin_cpu_supports(\"avx2\") &&
             __builtin_cpu_supports(\"fma\") ? 2 : 1;
}")
  try_run(exit_code compiles "${PROJECT_BINARY_DIR}/simd_width"
          "${PROJECT_BINARY_DIR}/simd_width.cc")
  if(compiles AND exit_code EQUAL 3)
    set(${result} 512 PARENT_SCOPE)
  elseif(compiles AND exit_code EQUAL 2)
    set(${result} 256 PARENT_SCOPE)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64")
    set(${result} 128 PARENT_SCOPE)
  else()
    set(${result} library PARENT_SCOPE)
  endif()
endfunction()

set(slipstep_simd_width "${SLIPSTEP_SIMD}")
if(NOT slipstep_library_width STREQUAL "0")
  set(slipstep_simd_width library)
elseif(SLIPSTEP_SIMD STREQUAL "auto")
  slipstep_detect_simd_width(slipstep_simd_width)
elseif(NOT SLIPSTEP_SIMD MATCHES "^(library|128|256|512)$")
  message(FATAL_ERROR "SLIPSTEP_SIMD is '${SLIPSTEP_SIMD}'; it can be auto, "
                      "library, 128, 256 or 512")
endif()

set(SLIPSTEP_SIMD_OPTIONS "")
if(slipstep_simd_width STREQUAL "library")
  message(STATUS "Matrix-free units: SIMD as deal.II has it")
else()
  set(folder "${PROJECT_BINARY_DIR}/simd_${slipstep_simd_width}")
  string(REPLACE "define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 0"
                 "define DEAL_II_VECTORIZATION_WIDTH_IN_BITS ${slipstep_simd_width}"
                 slipstep_config "${slipstep_config}")
  file(WRITE "${folder}/config.h" "${slipstep_config}")
  configure_file("${folder}/config.h" "${folder}/${slipstep_config_h}" COPYONLY)
  # The compiler warns about its own headers of intrinsics.
  list(APPEND SLIPSTEP_SIMD_OPTIONS "-I${folder}" -Wno-maybe-uninitialized
       -Wno-uninitialized)
  if(slipstep_simd_width EQUAL 512)
    set(SLIPSTEP_PROCESSOR "avx512f")
    list(APPEND SLIPSTEP_SIMD_OPTIONS -march=x86-64-v4 -mprefer-vector-width=512)
  elseif(slipstep_simd_width EQUAL 256)
    set(SLIPSTEP_PROCESSOR "avx2")
    list(APPEND SLIPSTEP_SIMD_OPTIONS -march=x86-64-v3)
  endif()
  message(STATUS "Matrix-free units: SIMD of ${slipstep_simd_width} bits")
endif()
