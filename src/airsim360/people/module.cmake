# librecast-dev brings neither a CMake nor a pkg-config file.
find_path(RECAST_INCLUDE_DIR recastnavigation/Recast.h REQUIRED)
find_library(RECAST_LIBRARY Recast REQUIRED)
find_library(DETOUR_LIBRARY Detour REQUIRED)
find_package(EXPAT REQUIRED)
target_link_libraries(airsim360_people PRIVATE ${RECAST_LIBRARY} ${DETOUR_LIBRARY} EXPAT::EXPAT)
