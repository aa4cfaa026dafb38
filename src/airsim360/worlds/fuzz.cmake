# libosmium relies on wrapping integers and empty copies from null (location.hpp, pbf_input_format.hpp): the one file
# that includes it is fuzzed under AddressSanitizer alone.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/airsim360/worlds/osm/osm_file.cc PROPERTIES COMPILE_OPTIONS -fno-sanitize=undefined)
