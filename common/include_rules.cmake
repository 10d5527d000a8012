# What the sources of each folder may include follows from what their target links. It is written to include_rules.txt
# in the build folder, which tests/include_rules/include_rules_test.sh reads: two lines for a folder, of its headers and of its other
# sources, with what a permitted include may begin with.

# What includes of each package begin with.
set(includes_of_Eigen3::Eigen Eigen/ unsupported/Eigen/)
set(includes_of_TBB::tbb tbb/ oneapi/tbb/)
set(includes_of_fmt::fmt fmt/)
set(includes_of_spdlog::spdlog spdlog/)
set(includes_of_cereal::cereal cereal/)
set(includes_of_PkgConfig::XXHASH xxhash.h)
set(includes_of_CLI11::CLI11 CLI/)
set(includes_of_nlohmann_json::nlohmann_json nlohmann/)
set(includes_of_OpenMeshCore OpenMesh/)
set(includes_of_embree embree3/)
set(includes_of_Spectra::Spectra Spectra/)
set(includes_of_PNG::PNG png.h)
set(includes_of_stb stb/)
set(includes_of_ZLIB::ZLIB zlib.h)
set(includes_of_assimp::assimp assimp/)

# Sets `out` to what includes of the targets, and of all that their users may include, begin with.
function(varimap_includes_of out)
  set(result)
  foreach(target ${ARGN})
    string(REGEX REPLACE "^\\$<BUILD_INTERFACE:(.*)>$" "\\1" target ${target})
    get_property(of_library GLOBAL PROPERTY VARIMAP_INCLUDES_OF_${target})
    if(NOT of_library AND NOT DEFINED includes_of_${target})
      message(FATAL_ERROR "common/include_rules.cmake: what do includes of ${target} begin with?")
    endif()
    list(APPEND result ${of_library} ${includes_of_${target}})
  endforeach()
  list(REMOVE_DUPLICATES result)
  set(${out} ${result} PARENT_SCOPE)
endfunction()

# varimap_include_rule(FOLDER OWN PREFIX [TARGET NAME] LINKS TARGETS... PRIVATE TARGETS...): sources of the folder may
# include what begins with PREFIX and what they link; headers nothing that is PRIVATE. So may those who link NAME.
function(varimap_include_rule folder)
  cmake_parse_arguments(ARG "" "OWN;TARGET" "LINKS;PRIVATE" ${ARGN})
  varimap_includes_of(public ${ARG_LINKS})
  varimap_includes_of(private ${ARG_PRIVATE})
  list(PREPEND public ${ARG_OWN})
  if(ARG_TARGET)
    set_property(GLOBAL PROPERTY VARIMAP_INCLUDES_OF_${ARG_TARGET} ${public})
  endif()
  list(JOIN public " " public)
  list(JOIN private " " private)
  file(APPEND ${PROJECT_BINARY_DIR}/include_rules.txt "${folder} h ${public}\n${folder} cpp ${public} ${private}\n")
endfunction()
file(WRITE ${PROJECT_BINARY_DIR}/include_rules.txt "")
