# avoidbench_room(name SOURCES a.cpp … USES room … PRIVATE third-party target …)
# One static library a room, lib/WING/ROOM: `avoidbench::<name>`; without SOURCES a header-only room. Rooms include each
# other as room/file.hpp, whatever their wings.
function(avoidbench_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  list(TRANSFORM ROOM_USES PREPEND avoidbench::)
  set(target avoidbench_${name})
  get_filename_component(wing ${CMAKE_CURRENT_SOURCE_DIR} DIRECTORY)
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    target_include_directories(${target} PUBLIC ${wing})
    target_link_libraries(${target} PUBLIC ${ROOM_USES} ${ROOM_PUBLIC} PRIVATE avoidbench_flags ${ROOM_PRIVATE})
    avoidbench_precompiled(${target} room)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${wing})
    target_link_libraries(${target} INTERFACE ${ROOM_USES} ${ROOM_PUBLIC})
  endif()
  add_library(avoidbench::${name} ALIAS ${target})
endfunction()

# avoidbench_test(room [USES room …] [PRIVATE target …] [LABEL label] [TIMEOUT seconds]): every *_test.cpp beside the
# caller as one test binary. In ctest each test is labelled with the room, or LABEL; those of suites whose names end in
# Slow are `slow` too and have half an hour. The others have TIMEOUT, by default five minutes: for machines with other
# work to do, and so that a hang ends.
function(avoidbench_test name)
  cmake_parse_arguments(TEST "" "LABEL;TIMEOUT" "USES;PRIVATE" ${ARGN})
  if(NOT TEST_LABEL)
    set(TEST_LABEL ${name})
  endif()
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 300)
  endif()
  list(TRANSFORM TEST_USES PREPEND avoidbench::)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  add_executable(${name}_tests ${sources})
  target_include_directories(${name}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${name}_tests PRIVATE avoidbench_flags ${TEST_USES} ${TEST_PRIVATE} GTest::gtest_main)
  target_compile_definitions(${name}_tests PRIVATE AVOIDBENCH_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                             AVOIDBENCH_BINARY_DIR="${PROJECT_BINARY_DIR}")
  avoidbench_precompiled(${name}_tests test)
  gtest_discover_tests(${name}_tests TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES)
  # ctest reads this after the tests were found. gtest_discover_tests' own PROPERTIES keep only the first of several
  # labels.
  set(properties ${CMAKE_CURRENT_BINARY_DIR}/${name}_test_properties.cmake)
  file(CONFIGURE OUTPUT ${properties} @ONLY CONTENT [[
foreach(test IN LISTS @name@_tests_TESTS)
  if(test MATCHES "Slow\\.")
    set_tests_properties("${test}" PROPERTIES TIMEOUT 1800 LABELS "@TEST_LABEL@;slow")
  else()
    set_tests_properties("${test}" PROPERTIES TIMEOUT @TEST_TIMEOUT@ LABELS @TEST_LABEL@)
  endif()
endforeach()
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${properties})
endfunction()

# avoidbench_script_test(label name [SLOW] [SERIAL] [CAN_SKIP] [PROCESSORS n] TIMEOUT seconds COMMAND word …): the test
# label.name. SLOW: run by scripts/test.sh --all only. SERIAL: nothing else runs beside it, since it measures times.
# PROCESSORS: how many it uses, by default one. CAN_SKIP: exit code 77 says that it can't run here. Scripts take seconds
# to minutes and so begin before the thousand short tests of C++, which then fill what is free.
function(avoidbench_script_test label name)
  cmake_parse_arguments(TEST "SLOW;SERIAL;CAN_SKIP" "TIMEOUT;PROCESSORS" "COMMAND" ${ARGN})
  if(NOT TEST_TIMEOUT)
    message(FATAL_ERROR "the test ${label}.${name} has no TIMEOUT")
  endif()
  add_test(NAME ${label}.${name} COMMAND ${TEST_COMMAND})
  set(labels ${label})
  if(TEST_SLOW)
    list(APPEND labels slow)
  endif()
  set_tests_properties(${label}.${name} PROPERTIES TIMEOUT ${TEST_TIMEOUT} RUN_SERIAL ${TEST_SERIAL} LABELS "${labels}" COST ${TEST_TIMEOUT})
  if(TEST_PROCESSORS)
    set_tests_properties(${label}.${name} PROPERTIES PROCESSORS ${TEST_PROCESSORS})
  endif()
  if(TEST_CAN_SKIP)
    set_tests_properties(${label}.${name} PROPERTIES SKIP_RETURN_CODE 77)
  endif()
endfunction()
