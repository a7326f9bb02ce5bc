# cmake --install. The program and the plugins install themselves; here come the configurations and the SDK (component
# sdk): headers and a CMake package `avoidbench` with avoidbench::planner_api and avoidbench_planner().
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/avoidbench)

if(EXISTS ${PROJECT_SOURCE_DIR}/configs)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/avoidbench/configs
          COMPONENT programs)
endif()

install(DIRECTORY ${PROJECT_SOURCE_DIR}/lib/planner_api/avoidbench DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT sdk FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(TARGETS avoidbench_planner_api EXPORT avoidbench_targets COMPONENT sdk)
install(EXPORT avoidbench_targets FILE avoidbench-targets.cmake NAMESPACE avoidbench:: DESTINATION ${package_folder}
        COMPONENT sdk)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/avoidbench-config.cmake.in
                              ${PROJECT_BINARY_DIR}/avoidbench-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/avoidbench-config-version.cmake
                                 COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/avoidbench-config.cmake ${PROJECT_BINARY_DIR}/avoidbench-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/AvoidbenchPlanner.cmake
        DESTINATION ${package_folder} COMPONENT sdk)
