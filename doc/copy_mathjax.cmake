# SPDX-License-Identifier: LGPL-2.1-or-later
# Copies the part of MathJax that draws TeX formulas as SVG, so that the pages
# work without network and from a file:// address.
foreach(part IN ITEMS
        MathJax.js extensions/tex2jax.js
        extensions/MathMenu.js extensions/MathZoom.js extensions/MathEvents.js
        extensions/TeX jax/input/TeX jax/element jax/output/SVG/jax.js
        jax/output/SVG/config.js jax/output/SVG/autoload
        jax/output/SVG/fonts/TeX)
  if(EXISTS "${FROM}/${part}")
    get_filename_component(folder "${TO}/${part}" DIRECTORY)
    file(COPY "${FROM}/${part}" DESTINATION "${folder}" FOLLOW_SYMLINK_CHAIN)
  endif()
endforeach()
