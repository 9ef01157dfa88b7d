# SPDX-License-Identifier: LGPL-2.1-or-later
# The program, its man page, the cases and the papers that belong to them; the law
# for other programs.
include(GNUInstallDirs)

set(man_page "${PROJECT_BINARY_DIR}/slipstep.1")
add_custom_command(OUTPUT "${man_page}"
  COMMAND "${PROJECT_SOURCE_DIR}/doc/man_page.sh" $<TARGET_FILE:slipstep>
          > "${man_page}"
  DEPENDS slipstep "${PROJECT_SOURCE_DIR}/doc/man_page.sh"
  COMMENT "Writing the man page")
set(completions "${PROJECT_BINARY_DIR}/generated/completions/slipstep")
add_custom_command(OUTPUT "${completions}"
  COMMAND ${CMAKE_COMMAND} -E make_directory
          "${PROJECT_BINARY_DIR}/generated/completions"
  COMMAND "${PROJECT_SOURCE_DIR}/doc/bash_completion.sh"
          $<TARGET_FILE:slipstep> > "${completions}"
  DEPENDS slipstep "${PROJECT_SOURCE_DIR}/doc/bash_completion.sh"
  COMMENT "Writing the completions of bash")
add_custom_target(man_page ALL DEPENDS "${man_page}" "${completions}")

install(TARGETS slipstep RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(FILES "${man_page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${completions}"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
install(DIRECTORY doc/editor DESTINATION "${CMAKE_INSTALL_DATADIR}/slipstep")
install(FILES README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md LICENSE
        DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY doc/guide DESTINATION "${CMAKE_INSTALL_DOCDIR}/doc")
install(DIRECTORY prm DESTINATION "${CMAKE_INSTALL_DATADIR}/slipstep"
        PATTERN output EXCLUDE)

# find_package(slipstep_friction) gives slipstep::friction.
install(TARGETS slipstep_law_library EXPORT slipstep_friction
        LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT slipstep_friction NAMESPACE slipstep::
        FILE slipstep_friction-config.cmake
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/slipstep_friction")
install(FILES include/slipstep/law_library/slipstep_friction.h
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(FILES source/law_library/slipstep.py
        DESTINATION "${CMAKE_INSTALL_DATADIR}/slipstep/python")
install(FILES source/law_library/fric.f
        DESTINATION "${CMAKE_INSTALL_DATADIR}/slipstep/abaqus")
