# cmake --install BUILD --prefix P: the program, every module as a static library with its headers, and the CMake
# package `airsim360` with targets airsim360::base … airsim360::tasks.
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY AIRSIM360_MODULES)
target_compile_features(airsim360_base INTERFACE cxx_std_20)
foreach(module ${modules})
  set_target_properties(airsim360_${module} PROPERTIES EXPORT_NAME ${module})
  install(TARGETS airsim360_${module} EXPORT airsim360Targets ARCHIVE DESTINATION lib)
endforeach()
install(TARGETS airsim360 RUNTIME DESTINATION bin)
install(DIRECTORY src/airsim360 DESTINATION include FILES_MATCHING PATTERN "*.h" PATTERN "test_*.h" EXCLUDE PATTERN "app" EXCLUDE)
install(EXPORT airsim360Targets NAMESPACE airsim360:: DESTINATION lib/cmake/airsim360)
configure_package_config_file(cmake/airsim360Config.cmake.in ${CMAKE_BINARY_DIR}/airsim360Config.cmake
                              INSTALL_DESTINATION lib/cmake/airsim360)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/airsim360ConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/airsim360Config.cmake ${CMAKE_BINARY_DIR}/airsim360ConfigVersion.cmake
        DESTINATION lib/cmake/airsim360)
