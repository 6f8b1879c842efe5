# What is installed where, and the packages made of it: palpa (programs, documentation), libpalpa-dev (libraries for
# other programs) and python3-palpa.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME palpa)

# Programs. Only the others start palpa-read-cad.
install(TARGETS palpa palpa-cli RUNTIME)
install(TARGETS palpa-read-cad RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/palpa)

# In none of the packages, because it needs PETSc.
if(TARGET palpa-mpi)
  install(TARGETS palpa-mpi RUNTIME COMPONENT mpi)
endif()

# palpa-cli writes its manual page and its completion itself.
set(palpa_manual ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${palpa_manual})
add_custom_command(OUTPUT ${palpa_manual}/palpa-cli.1 ${palpa_manual}/palpa-cli
  COMMAND palpa-cli --manual > ${palpa_manual}/palpa-cli.1
  COMMAND palpa-cli --bash-completion > ${palpa_manual}/palpa-cli
  DEPENDS palpa-cli VERBATIM)
add_custom_target(manual ALL DEPENDS ${palpa_manual}/palpa-cli.1 ${palpa_manual}/palpa-cli)
install(FILES ${palpa_manual}/palpa-cli.1 resources/desktop/palpa.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${palpa_manual}/palpa-cli DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

install(FILES resources/desktop/palpa.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES resources/desktop/palpa.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
set(palpa_icons ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable)
install(FILES resources/icons/palpa.svg DESTINATION ${palpa_icons}/apps)
install(FILES resources/icons/palpa.svg DESTINATION ${palpa_icons}/mimetypes RENAME application-x-palpa-project+json.svg)

install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN tools EXCLUDE)
install(DIRECTORY projects DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN *.json)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The Python package, where the interpreter looks for it below /usr and /usr/local. Its palpa-read-cad lies beside the
# module, so that it needs neither the programs nor their libraries.
if(TARGET palpa_python)
  set(palpa_python_site lib/python${palpa_python_version}/dist-packages/palpa)
  install(DIRECTORY app/python/palpa/ DESTINATION ${palpa_python_site} COMPONENT python
    FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  install(TARGETS palpa_python LIBRARY DESTINATION ${palpa_python_site} COMPONENT python)
  install(TARGETS palpa-read-cad RUNTIME DESTINATION ${palpa_python_site} COMPONENT python)
endif()

# Libraries, for find_package(palpa), and their public headers.
include(cmake/public_headers.cmake)
set(palpa_cmake ${CMAKE_INSTALL_LIBDIR}/cmake/palpa)
install(TARGETS palpa_options palpa_base palpa_bem palpa_modeling EXPORT palpa-targets ARCHIVE COMPONENT dev)
foreach(header ${palpa_public_headers})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/palpa/${folder} COMPONENT dev)
endforeach()
install(EXPORT palpa-targets NAMESPACE palpa:: DESTINATION ${palpa_cmake} COMPONENT dev)
configure_package_config_file(cmake/palpa-config.cmake.in ${PROJECT_BINARY_DIR}/palpa-config.cmake
  INSTALL_DESTINATION ${palpa_cmake})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/palpa-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/palpa-config.cmake ${PROJECT_BINARY_DIR}/palpa-config-version.cmake
  DESTINATION ${palpa_cmake} COMPONENT dev)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME palpa)
set(CPACK_PACKAGE_VENDOR "The Palpa developers")
set(CPACK_PACKAGE_CONTACT "The Palpa developers <maintainers@palpa.invalid>")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL palpa dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_PALPA_PACKAGE_NAME palpa)
set(CPACK_DEBIAN_PALPA_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PALPA_PACKAGE_SHLIBDEPS ON)
# Qt loads its platform and picture plugins at run time, so dpkg-shlibdeps does not find them.
set(CPACK_DEBIAN_PALPA_PACKAGE_DEPENDS "libqt6svg6, qt6-qpa-plugins")
set(CPACK_DEBIAN_PALPA_PACKAGE_SUGGESTS "ffmpeg")
set(CPACK_COMPONENT_PALPA_DESCRIPTION "model elastic solids with spline patches and touch them
 Solids are modelled by moving control points of non-uniform B-spline patches, and answer touches as elastic bodies
 while they are modelled: boundary elements give displacements, tractions and the exact reaction force.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libpalpa-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libeigen3-dev, libexpat1-dev, nlohmann-json3-dev, liblapacke-dev, libopenblas-pthread-dev, libgmp-dev, libmpfr-dev, libocct-data-exchange-dev, libocct-modeling-algorithms-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "boundary elements and NUBS solids of Palpa
 Static libraries, headers and a CMake package for programs that use the boundary element core or the modeller of Palpa.")
if(TARGET palpa_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  # The module fits one version of the interpreter.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-palpa)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${palpa_python_version}), python3 (<< ${palpa_python_next_version}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-h5py, python3-matplotlib")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "touch elastic solids from Python
 Solids of spline patches, their boundary element models, forces and fields of touches as numpy arrays: the package palpa.")
endif()
include(CPack)
