# `cpack` in a build folder makes avoidbench_VERSION_ARCH.deb: the program, its planners and data, and the SDK, under /usr. Its
# libraries are those of the Debian release that it was built on: a package for each.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "avoidbench contributors")
set(CPACK_PACKAGE_CONTACT "avoidbench contributors <noreply@example.invalid>")
set(CPACK_PACKAGE_DESCRIPTION "It generates maps of graded difficulty, flies a simulated multirotor with depth cameras,
stereo cameras or lidars through them, and computes the metrics of AvoidBench (arXiv 2301.07430). Headless; the same bits
on every run.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL programs planners sdk)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_NAME avoidbench)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy")  # planners in Python
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, g++, cmake")  # films, planners in C++
install(FILES LICENSE DESTINATION share/doc/avoidbench RENAME copyright COMPONENT programs)
include(CPack)
