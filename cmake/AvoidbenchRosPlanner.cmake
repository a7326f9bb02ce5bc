# avoidbench_ros_planner(name SOURCES a.cpp … TOPICS topics.yaml [PARAMS params.yaml] [MESSAGES package folder …]
# [INCLUDE folder …]
#                        [NEEDS opencv pcl target …] [EIGEN folder] [DEFINITIONS A=1 …] [STANDARD 14|17|20] [FOLDER folder])
# ROS 1 sources, unchanged, as the planner <name>.so: docs/ros.md. MESSAGES: packages with .msg, .srv and .cfg files of
# your own. NEEDS: opencv (cv_bridge), pcl (the real one; stand-ins of its points and clouds are there without), or
# targets and libraries to link. EIGEN: the folder with Eigen/Core of another Eigen than the one that is installed.
# FOLDER: where <name>.so goes instead of planners/ of the build tree; it is not installed then.
include(GNUInstallDirs)
if(NOT AVOIDBENCH_ROS_SHIM)  # in the sources; avoidbench-config.cmake knows where it is installed
  get_filename_component(AVOIDBENCH_ROS_SHIM ${CMAKE_CURRENT_LIST_DIR}/../planners/ros_shim ABSOLUTE)
endif()
set(AVOIDBENCH_ROS_SHIM ${AVOIDBENCH_ROS_SHIM} CACHE INTERNAL "Folder of the stand-ins for ROS 1")

# Runs a script of the shim now; what it reads starts CMake again when it changes.
function(avoidbench_ros_script what)
  execute_process(COMMAND ${Python3_EXECUTABLE} ${ARGN} RESULT_VARIABLE result ERROR_VARIABLE problem OUTPUT_QUIET)
  if(NOT result EQUAL 0)
    string(STRIP "${problem}" problem)
    message(FATAL_ERROR "${what}:\n${problem}")
  endif()
endfunction()

# The packages that come with the shim as headers, and its runtime as objects; once a build tree.
function(avoidbench_ros_runtime)
  if(TARGET avoidbench_ros_runtime)
    return()
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import yaml" RESULT_VARIABLE result ERROR_QUIET)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "avoidbench_ros_planner needs PyYAML for ${Python3_EXECUTABLE}: the package python3-yaml")
  endif()
  file(GLOB packages CONFIGURE_DEPENDS ${AVOIDBENCH_ROS_SHIM}/messages/*)
  file(GLOB files CONFIGURE_DEPENDS ${AVOIDBENCH_ROS_SHIM}/messages/*/msg/*.msg
       ${AVOIDBENCH_ROS_SHIM}/messages/*/srv/*.srv)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files} ${AVOIDBENCH_ROS_SHIM}/make_messages.py)
  set(messages ${CMAKE_BINARY_DIR}/ros_shim_messages)
  avoidbench_ros_script("messages of the ROS shim" ${AVOIDBENCH_ROS_SHIM}/make_messages.py --out ${messages} ${packages})

  add_library(avoidbench_ros_headers INTERFACE)
  target_include_directories(avoidbench_ros_headers INTERFACE ${AVOIDBENCH_ROS_SHIM}/include ${messages})
  target_compile_definitions(avoidbench_ros_headers INTERFACE BOOST_BIND_GLOBAL_PLACEHOLDERS)
  # The same bits on every machine, and no symbol that keeps a library from being unloaded.
  target_compile_options(avoidbench_ros_headers INTERFACE -ffp-contract=off -fno-math-errno -fvisibility=hidden
                         $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-gnu-unique>)

  # By their names: an older installation may have left others there.
  set(sources commands core fibre flight frames graph loader memory names nodes_world observations services synchronize tf time)
  list(TRANSFORM sources REPLACE "(.+)" "${AVOIDBENCH_ROS_SHIM}/src/\\1.cpp")
  add_library(avoidbench_ros_runtime OBJECT ${sources})
  target_link_libraries(avoidbench_ros_runtime PUBLIC avoidbench::planner_api avoidbench_ros_headers
                        PRIVATE avoidbench::repeatable)
  target_include_directories(avoidbench_ros_runtime PUBLIC ${AVOIDBENCH_ROS_SHIM}/src)
  target_compile_features(avoidbench_ros_runtime PUBLIC cxx_std_17)
  if(TARGET avoidbench_flags)
    target_link_libraries(avoidbench_ros_runtime PRIVATE avoidbench_flags)
  endif()
  set_target_properties(avoidbench_ros_runtime PROPERTIES POSITION_INDEPENDENT_CODE ON
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# Headers of the planner's own messages, services and configurations, into the folder messages of `generated`.
function(avoidbench_ros_messages name generated)
  set(known "")
  file(GLOB packages ${AVOIDBENCH_ROS_SHIM}/messages/*)
  foreach(package IN LISTS packages)
    list(APPEND known --known ${package})
  endforeach()
  foreach(package IN LISTS ARGN)
    file(GLOB files CONFIGURE_DEPENDS ${package}/*.msg ${package}/msg/*.msg ${package}/*.srv
         ${package}/srv/*.srv ${package}/cfg/*.cfg ${package}/package.xml)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${AVOIDBENCH_ROS_SHIM}/make_configs.py)
  avoidbench_ros_script("messages of ${name}" ${AVOIDBENCH_ROS_SHIM}/make_messages.py --out ${generated}/messages ${known} ${ARGN})
  avoidbench_ros_script("configurations of ${name}" -B ${AVOIDBENCH_ROS_SHIM}/make_configs.py --out ${generated}/messages ${ARGN})
endfunction()

# The targets to link for words of NEEDS, into the variable `out`; `pcl_out`: whether PCL is the real one.
function(avoidbench_ros_needs out pcl_out)
  set(targets "")
  set(is_pcl OFF)
  foreach(need IN LISTS ARGN)
    if(need STREQUAL "opencv")
      if(NOT TARGET avoidbench_ros_opencv)
        add_library(avoidbench_ros_opencv INTERFACE)
        find_path(AVOIDBENCH_ROS_OPENCV_INCLUDE opencv2/imgproc.hpp PATH_SUFFIXES opencv4 REQUIRED)
        target_include_directories(avoidbench_ros_opencv SYSTEM INTERFACE ${AVOIDBENCH_ROS_OPENCV_INCLUDE})
        foreach(module imgproc core)
          find_library(AVOIDBENCH_ROS_OPENCV_${module} opencv_${module} REQUIRED)
          target_link_libraries(avoidbench_ros_opencv INTERFACE ${AVOIDBENCH_ROS_OPENCV_${module}})
        endforeach()
      endif()
      list(APPEND targets avoidbench_ros_opencv)
    elseif(need STREQUAL "pcl")
      find_package(PCL REQUIRED)
      list(APPEND targets ${PCL_LIBRARIES})
      set(is_pcl ON)
    else()
      list(APPEND targets ${need})
    endif()
  endforeach()
  set(${out} ${targets} PARENT_SCOPE)
  set(${pcl_out} ${is_pcl} PARENT_SCOPE)
endfunction()

# Shared libraries have clocks and chance that the runtime does not replace: the build says which ones ask for them.
function(avoidbench_ros_warn_of_clocks name)
  if(CMAKE_NM AND CMAKE_READELF)
    add_custom_command(TARGET ${name} POST_BUILD VERBATIM
      COMMAND ${Python3_EXECUTABLE} -B ${AVOIDBENCH_ROS_SHIM}/warn_of_clocks.py --nm ${CMAKE_NM} --readelf ${CMAKE_READELF}
              $<TARGET_FILE:${name}>)
  endif()
endfunction()

function(avoidbench_ros_planner name)
  cmake_parse_arguments(ROS "" "TOPICS;PARAMS;STANDARD;FOLDER;EIGEN" "SOURCES;MESSAGES;INCLUDE;NEEDS;DEFINITIONS" ${ARGN})
  if(ROS_UNPARSED_ARGUMENTS OR NOT ROS_SOURCES OR NOT ROS_TOPICS)
    message(FATAL_ERROR "avoidbench_ros_planner(${name} SOURCES a.cpp … TOPICS topics.yaml …): ${ROS_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT ROS_STANDARD)
    set(ROS_STANDARD 17)
  endif()
  avoidbench_ros_runtime()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  foreach(list SOURCES MESSAGES INCLUDE TOPICS PARAMS EIGEN)
    set(absolute "")
    foreach(path IN LISTS ROS_${list})
      get_filename_component(path "${path}" ABSOLUTE)
      list(APPEND absolute "${path}")
    endforeach()
    set(ROS_${list} ${absolute})
  endforeach()

  set(generated ${CMAKE_CURRENT_BINARY_DIR}/${name}_ros)
  if(ROS_MESSAGES)
    avoidbench_ros_messages(${name} ${generated} ${ROS_MESSAGES})
  endif()
  set(params "")
  if(ROS_PARAMS)
    set(params --params ${ROS_PARAMS})
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ROS_TOPICS} ${ROS_PARAMS} ${AVOIDBENCH_ROS_SHIM}/make_planner.py
               ${AVOIDBENCH_ROS_SHIM}/make_messages.py ${AVOIDBENCH_ROS_SHIM}/topics_file.py ${AVOIDBENCH_ROS_SHIM}/topics_spec.py)
  avoidbench_ros_script("topics of ${name}" ${AVOIDBENCH_ROS_SHIM}/make_planner.py --name ${name} --topics ${ROS_TOPICS} ${params}
                        --out ${generated} ${ROS_SOURCES})
  include(${generated}/mains.cmake)

  avoidbench_ros_needs(libraries has_pcl ${ROS_NEEDS})
  if(ROS_EIGEN AND NOT EXISTS ${ROS_EIGEN}/Eigen/Core)
    message(FATAL_ERROR "avoidbench_ros_planner(${name} EIGEN): there is no ${ROS_EIGEN}/Eigen/Core")
  endif()
  find_package(Eigen3 QUIET NO_MODULE)
  if(TARGET Eigen3::Eigen AND NOT ROS_EIGEN)
    list(APPEND libraries Eigen3::Eigen)
  endif()

  # The planner's own sources: none of our warnings, and as ROS compiles them.
  add_library(${name}_nodes OBJECT ${ROS_SOURCES})
  # Another Eigen is the planner's alone: nothing between its sources and the runtime has a type of Eigen's.
  target_include_directories(${name}_nodes PRIVATE ${ROS_EIGEN} ${ROS_INCLUDE} ${generated}/messages)
  if(NOT has_pcl)
    target_include_directories(${name}_nodes PRIVATE ${AVOIDBENCH_ROS_SHIM}/include_pcl)
  endif()
  target_compile_definitions(${name}_nodes PRIVATE ${ROS_DEFINITIONS})
  # Compilers of ROS's days let numbers be narrowed in braces.
  target_compile_options(${name}_nodes PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-narrowing>
                         $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-c++11-narrowing>)
  target_link_libraries(${name}_nodes PRIVATE avoidbench_ros_headers ${libraries})
  set_target_properties(${name}_nodes PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF CXX_STANDARD ${ROS_STANDARD}
                        CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS ON CXX_VISIBILITY_PRESET hidden)

  add_library(${name} MODULE ${generated}/${name}_planner.cpp $<TARGET_OBJECTS:${name}_nodes> $<TARGET_OBJECTS:avoidbench_ros_runtime>)
  target_include_directories(${name} PRIVATE ${generated}/messages ${AVOIDBENCH_ROS_SHIM}/src)
  target_compile_features(${name} PRIVATE cxx_std_17)
  target_link_libraries(${name} PRIVATE avoidbench::planner_api avoidbench_ros_headers ${libraries} ${CMAKE_DL_LIBS})
  if(TARGET avoidbench_flags)
    target_link_libraries(${name} PRIVATE avoidbench_flags)
  endif()
  # Nothing but the two entries is seen from outside, and nothing outside takes the place of what is inside: the library
  # is loaded once more for every trial.
  set(script ${AVOIDBENCH_ROS_SHIM}/exports.map)
  target_link_options(${name} PRIVATE -Wl,--version-script=${script} -Wl,-Bsymbolic -Wl,-z,now)
  if(NOT AVOIDBENCH_SANITIZE)  # whose runtime is the program's
    target_link_options(${name} PRIVATE -Wl,-z,defs)  # all that is missing is told at once, and not at the first trial
  endif()
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX ".so" UNITY_BUILD OFF LINK_DEPENDS ${script}
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  avoidbench_ros_warn_of_clocks(${name})
  if(ROS_FOLDER)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${ROS_FOLDER})
  else()
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/planners)
    set_property(GLOBAL APPEND PROPERTY AVOIDBENCH_PLANNERS ${name})
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/avoidbench/planners COMPONENT planners)
  endif()
endfunction()
