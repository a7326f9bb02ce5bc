# avoidbench_planner(name SOURCES a.cpp …  [PRIVATE target …] [FILES weights.bin …])
# One planner plugin: planners/<name>.so under the build tree, and beside it the files that it depends on. The same
# function is installed for planners that live in a repository of their own; there set AVOIDBENCH_PLANNER_PATH to <build
# folder>/planners to use them by name.
include(GNUInstallDirs)
function(avoidbench_planner name)
  cmake_parse_arguments(PLANNER "" "" "SOURCES;PRIVATE;FILES" ${ARGN})
  add_library(${name} MODULE ${PLANNER_SOURCES})
  if(TARGET avoidbench_flags)
    target_link_libraries(${name} PRIVATE avoidbench_flags)
  else()
    # A planner's arithmetic must not depend on the processor either. -g1: a crash report names lines, relative to the
    # planner's folder, so that the library's digest does not depend on where it was built.
    target_compile_options(${name} PRIVATE -ffp-contract=off $<$<NOT:$<CONFIG:Debug,RelWithDebInfo>>:-g1>
      "-ffile-prefix-map=${CMAKE_CURRENT_SOURCE_DIR}/=" "-ffile-prefix-map=${CMAKE_CURRENT_BINARY_DIR}=.")
  endif()
  target_link_libraries(${name} PRIVATE avoidbench::planner_api ${PLANNER_PRIVATE})
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX ".so"
                        CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/planners)
  set_property(GLOBAL APPEND PROPERTY AVOIDBENCH_PLANNERS ${name})
  foreach(file IN LISTS PLANNER_FILES)
    get_filename_component(file_name ${file} NAME)
    configure_file(${file} ${CMAKE_BINARY_DIR}/planners/${file_name} COPYONLY)
    install(FILES ${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/avoidbench/planners COMPONENT planners)
  endforeach()
  install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/avoidbench/planners COMPONENT planners)
endfunction()
