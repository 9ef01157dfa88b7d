# SPDX-License-Identifier: LGPL-2.1-or-later
# A package for Debian that runs on any amd64 processor:
#   cmake --preset package && cmake --build --preset package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME slipstep)
set(CPACK_PACKAGE_CONTACT "The authors of slipstep <slipstep@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
    "rate-dependent friction of a sliding elastic block")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "paraview, python3-numpy, python3-matplotlib, bash-completion")
include(CPack)
