# cmake --install. The program and the planners install themselves; here come what belongs to them (configurations,
# maps, docs, scripts, the template of a planner; laid out as in the sources, so that what names each other finds it)
# and the SDK (component sdk): headers and a CMake package `avoidbench` with avoidbench::planner_api,
# avoidbench_planner() and avoidbench_ros_planner().
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/avoidbench)

set(data_folder ${CMAKE_INSTALL_DATADIR}/avoidbench)
install(DIRECTORY configs maps docs DESTINATION ${data_folder} COMPONENT programs)
install(FILES scripts/custom_metrics.py DESTINATION ${data_folder}/scripts COMPONENT programs)
install(DIRECTORY scripts/plot scripts/slurm DESTINATION ${data_folder}/scripts COMPONENT programs USE_SOURCE_PERMISSIONS
        PATTERN __pycache__ EXCLUDE)
# What planners in Python need, for the Python that the program starts.
install(DIRECTORY python/avoidbench DESTINATION ${data_folder}/python COMPONENT programs FILES_MATCHING PATTERN "*.py"
        PATTERN __pycache__ EXCLUDE)
install(DIRECTORY planners/template DESTINATION ${data_folder}/planners COMPONENT programs)
# Real ROS 1 nodes; it reads the topics files of the stand-ins for ROS by their reader, which lies beside it.
install(DIRECTORY planners/ros_bridge DESTINATION ${data_folder}/planners COMPONENT programs USE_SOURCE_PERMISSIONS
        PATTERN __pycache__ EXCLUDE)
# The stand-ins for ROS 1 are sources: avoidbench_ros_planner() builds them with the planner.
foreach(component programs sdk)  # `planners wrap` and ros_bridge read them, too
  install(DIRECTORY planners/ros_shim DESTINATION ${data_folder}/planners COMPONENT ${component}
          PATTERN CMakeLists.txt EXCLUDE PATTERN example EXCLUDE PATTERN __pycache__ EXCLUDE)
endforeach()
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${data_folder} COMPONENT programs)
# The build tree has the same by links, and is a package to find, too.
foreach(folder configs maps docs scripts planners/template planners/ros_shim python/avoidbench)
  get_filename_component(parent ${PROJECT_BINARY_DIR}/${data_folder}/${folder} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PROJECT_BINARY_DIR}/${data_folder}/${folder} SYMBOLIC)
endforeach()

install(DIRECTORY ${PROJECT_SOURCE_DIR}/lib/sdk/planner_api/avoidbench DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT sdk)
install(TARGETS avoidbench_planner_api avoidbench_repeatable EXPORT avoidbench_targets COMPONENT sdk)
install(EXPORT avoidbench_targets FILE avoidbench-targets.cmake NAMESPACE avoidbench:: DESTINATION ${package_folder}
        COMPONENT sdk)
export(EXPORT avoidbench_targets NAMESPACE avoidbench:: FILE ${PROJECT_BINARY_DIR}/avoidbench-targets.cmake)
file(COPY cmake/AvoidbenchPlanner.cmake cmake/AvoidbenchRosPlanner.cmake DESTINATION ${PROJECT_BINARY_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/avoidbench-config.cmake.in
                              ${PROJECT_BINARY_DIR}/avoidbench-config.cmake INSTALL_DESTINATION ${package_folder}
                              PATH_VARS data_folder)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/avoidbench-config-version.cmake
                                 COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/avoidbench-config.cmake ${PROJECT_BINARY_DIR}/avoidbench-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/AvoidbenchPlanner.cmake ${PROJECT_SOURCE_DIR}/cmake/AvoidbenchRosPlanner.cmake
        DESTINATION ${package_folder} COMPONENT sdk)
install(DIRECTORY planners/ros_shim/example/ DESTINATION ${data_folder}/planners/ros_example COMPONENT programs)
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")
set(destination \"\${CMAKE_INSTALL_PREFIX}/${data_folder}\")" COMPONENT programs)
install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/InstallLinkedFiles.cmake COMPONENT programs)
