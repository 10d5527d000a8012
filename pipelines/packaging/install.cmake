# cmake --install: PREFIX/bin/varimap (the front end) and the stages beside it, PREFIX/share/varimap (what the front end
# reads), and for those who link: PREFIX/include/varimap, the static libraries and PREFIX/lib/cmake/varimap.
# cpack -G DEB makes a Debian package of the same.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY VARIMAP_LIBRARIES)
get_property(stages GLOBAL PROPERTY VARIMAP_STAGES)
install(TARGETS ${stages})
install(TARGETS ${libraries} EXPORT varimapTargets)
install(DIRECTORY common/varimap pipelines/in_memory/varimap TYPE INCLUDE FILES_MATCHING PATTERN "*.h" PATTERN private EXCLUDE)
install(PROGRAMS pipelines/varimap TYPE BIN)
set(share ${CMAKE_INSTALL_DATADIR}/varimap)
install(FILES pipelines/Makefile pipelines/quality.jq pipelines/quality_words.jq pipelines/report.jq pipelines/summary.jq pipelines/script.sh
  pipelines/plain_text.awk pipelines/progress.sh DESTINATION ${share})
install(PROGRAMS pipelines/bench pipelines/bench-list pipelines/debian-meshes pipelines/gallery pipelines/plot pipelines/register pipelines/scaling
  pipelines/selftest pipelines/survey pipelines/torus DESTINATION ${share})
install(DIRECTORY pipelines/experiments DESTINATION ${share} USE_SOURCE_PERMISSIONS)
install(DIRECTORY pipelines/front_end pipelines/help DESTINATION ${share})
foreach(stage IN LISTS stages)
  string(REPLACE "varimap-" "" name ${stage})
  install(FILES stages/${name}/README.md DESTINATION ${share}/stages RENAME ${name}.md)
endforeach()
install(DIRECTORY pipelines/batch DESTINATION ${share} USE_SOURCE_PERMISSIONS)
# The viewer's page, where it has been built: pipelines/view/build build/view/frame.html
install(FILES ${PROJECT_BINARY_DIR}/view/frame.html DESTINATION ${share}/view OPTIONAL)
install(FILES LICENSE README.md CHANGELOG.md TYPE DOC)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/varimap)
install(EXPORT varimapTargets NAMESPACE varimap:: DESTINATION ${package_folder})
configure_package_config_file(pipelines/packaging/varimapConfig.cmake.in varimapConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(varimapConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/varimapConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/varimapConfigVersion.cmake
  pipelines/packaging/requirements.cmake DESTINATION ${package_folder})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "varimap developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Maps one surface onto another with low distortion")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # needs dpkg-shlibdeps of dpkg-dev
set(CPACK_DEBIAN_PACKAGE_DEPENDS "bash, make, jq, util-linux")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, libtbb-dev, libfmt-dev, libspdlog-dev, libcereal-dev, \
libopenmesh-dev, libembree-dev, libxxhash-dev, libpng-dev, zlib1g-dev, pkg-config")
set(CPACK_STRIP_FILES ON)
include(CPack)
