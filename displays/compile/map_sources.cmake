# Writes a header with a digest of all sources that compiled maps depend on, so that no map of another version is read.
# cmake -DHEADER=... -P map_sources.cmake, in the repository's root
file(GLOB_RECURSE sources displays/*.cpp displays/*.h config/model/*.cpp config/model/*.h)
list(SORT sources)
foreach(source ${sources})
  file(SHA256 ${source} one)
  string(APPEND all ${one})
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING ${digest} 0 16 digest)
file(WRITE ${HEADER} "#define MAP_SOURCES \"${digest}\"\n")
