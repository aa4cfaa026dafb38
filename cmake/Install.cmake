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
# Manual pages and completion, from the description of the command line that the program holds.
set(shell_files ${CMAKE_BINARY_DIR}/shell)
file(MAKE_DIRECTORY ${shell_files})
add_custom_command(TARGET airsim360 POST_BUILD
                   COMMAND $<TARGET_FILE:airsim360> man ${shell_files}/man1 > ${shell_files}/pages
                   COMMAND $<TARGET_FILE:airsim360> completion bash > ${shell_files}/airsim360
                   COMMAND $<TARGET_FILE:airsim360> completion zsh > ${shell_files}/_airsim360
                   COMMAND $<TARGET_FILE:airsim360> completion fish > ${shell_files}/airsim360.fish VERBATIM)
install(DIRECTORY ${shell_files}/man1 DESTINATION share/man)
install(FILES ${shell_files}/airsim360 DESTINATION share/bash-completion/completions)
install(FILES ${shell_files}/_airsim360 DESTINATION share/zsh/vendor-completions)
install(FILES ${shell_files}/airsim360.fish DESTINATION share/fish/vendor_completions.d)
install(DIRECTORY src/airsim360 DESTINATION include FILES_MATCHING PATTERN "*.h" PATTERN "test_*.h" EXCLUDE PATTERN "app" EXCLUDE)
install(EXPORT airsim360Targets NAMESPACE airsim360:: DESTINATION lib/cmake/airsim360)
configure_package_config_file(cmake/airsim360Config.cmake.in ${CMAKE_BINARY_DIR}/airsim360Config.cmake
                              INSTALL_DESTINATION lib/cmake/airsim360)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/airsim360ConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/airsim360Config.cmake ${CMAKE_BINARY_DIR}/airsim360ConfigVersion.cmake
        DESTINATION lib/cmake/airsim360)
