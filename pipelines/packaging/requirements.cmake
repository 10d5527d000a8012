# The packages that varimap's libraries are linked with: found here for the build, and by varimapConfig.cmake for those
# who link an installed varimap. What is missing is collected in VARIMAP_MISSING, a line each.

# varimap_requires(PACKAGE DEBIAN_PACKAGE [VERSION]): find_package, with one clear line where that fails.
macro(varimap_requires package debian)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    string(STRIP "${package} ${ARGN}" varimap_wanted)
    list(APPEND VARIMAP_MISSING "varimap needs ${varimap_wanted} (Debian package ${debian})")
  endif()
endmacro()

set(VARIMAP_MISSING)
varimap_requires(Eigen3 libeigen3-dev 3.4)
varimap_requires(TBB libtbb-dev)
varimap_requires(fmt libfmt-dev)
varimap_requires(spdlog libspdlog-dev)
varimap_requires(cereal libcereal-dev)
varimap_requires(OpenMesh libopenmesh-dev)
varimap_requires(embree libembree-dev 3)
varimap_requires(ZLIB zlib1g-dev)
varimap_requires(PNG libpng-dev)
varimap_requires(PkgConfig pkg-config)
if(PkgConfig_FOUND)
  pkg_check_modules(XXHASH QUIET IMPORTED_TARGET libxxhash)
  if(NOT XXHASH_FOUND)
    list(APPEND VARIMAP_MISSING "varimap needs xxHash (Debian package libxxhash-dev)")
  endif()
endif()
