# SPDX-License-Identifier: LGPL-2.1-or-later
# Optional helpers that shorten the build: a compiler cache, a fast linker.
find_program(SLIPSTEP_CCACHE ccache)
if(SLIPSTEP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${SLIPSTEP_CCACHE}")
endif()

find_program(SLIPSTEP_LLD ld.lld)
if(SLIPSTEP_LLD)
  add_link_options(-fuse-ld=lld)
endif()

# deal.II names several hundred libraries; record only those really called.
add_link_options(-Wl,--as-needed)
