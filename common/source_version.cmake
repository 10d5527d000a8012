# cmake -D VERSION=0.1.0 -D ROOT=... -D OUTPUT=version.cpp -P source_version.cmake
# Writes version(): the number and a hash of the sources of library and stages, so that what an earlier build has left
# counts as made by another version. The same sources give the same hash on every machine.
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/common/varimap/*.cpp ${ROOT}/common/varimap/*.h
  ${ROOT}/stages/*.cpp ${ROOT}/stages/*.h)
list(SORT sources COMPARE STRING)
foreach(source ${sources})
  file(SHA256 ${ROOT}/${source} hash)
  string(APPEND hashes "${source} ${hash}\n")
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING ${hash} 0 8 hash)
file(WRITE ${OUTPUT} "#include \"varimap/artifact/artifact.h\"

std::string varimap::version() {
    return \"${VERSION}+${hash}\";
}
")
