# SPDX-License-Identifier: LGPL-2.1-or-later
# Optional helpers that shorten the build: a compiler cache, a fast linker.
find_program(SLIPSTEP_CCACHE ccache)
if(SLIPSTEP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${SLIPSTEP_CCACHE}")
endif()

# The ordinary linker takes a minute for the libraries of deal.II, these a few
# seconds; gold comes with it.
find_program(SLIPSTEP_LLD ld.lld)
find_program(SLIPSTEP_GOLD ld.gold)
if(SLIPSTEP_LLD)
  add_link_options(-fuse-ld=lld)
elseif(SLIPSTEP_GOLD)
  add_link_options(-fuse-ld=gold)
endif()

# deal.II names several hundred libraries; record only those really called.
add_link_options(-Wl,--as-needed)
