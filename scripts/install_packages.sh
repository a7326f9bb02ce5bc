#!/usr/bin/env bash
# install_packages.sh LIST: installs the Debian/Ubuntu packages of a list and prints their names. If all are installed,
# it does nothing and needs no root. Lists:
#   build      the program
#   python     the Python package
#   ros        planners written for ROS 1 (docs/ros.md)
#   ros_live   real ROS 1 nodes
#   test       all tests except slow ones
#   slow       all tests
#   deb        the Debian package (make_deb.sh)
#   plot       pictures of `report --plots`
set -euo pipefail

# make: CMake's default without ninja, used for planners outside the repository.
build_packages=(
  g++ cmake ninja-build make ccache pkg-config git ca-certificates
  libeigen3-dev libembree-dev libopencv-core-dev libopencv-imgproc-dev libopencv-calib3d-dev libyaml-cpp-dev libcli11-dev
  nlohmann-json3-dev libsqlite3-dev libpng-dev zlib1g-dev liblz4-dev libzstd-dev libbz2-dev nettle-dev libbenchmark-dev sqlite3
)
plot_packages=(python3 python3-matplotlib python3-numpy python3-pandas)  # scripts/plot, scripts/custom_metrics.py
python_packages=(python3-venv python3-dev)
ros_packages=(g++ cmake make python3 python3-yaml libeigen3-dev libopencv-core-dev libopencv-imgproc-dev libboost-dev)
# The parts of ROS 1 itself that planners/ros_bridge needs.
ros_live_packages=(
  python3 python3-numpy python3-yaml python3-rospy python3-rosmaster python3-roslaunch python3-rosparam python3-std-msgs
  python3-geometry-msgs python3-nav-msgs python3-sensor-msgs python3-trajectory-msgs python3-rosgraph-msgs
)
# llvm: its symbolizer. Without it the sanitizers can't name functions, so tests/support/leaks.supp matches nothing.
test_packages=(
  "${plot_packages[@]}" "${python_packages[@]}" "${ros_packages[@]}" clang clang-format clang-tidy libclang-rt-14-dev llvm
  libgtest-dev libgmock-dev python3-jsonschema valgrind locales npm chromium ffmpeg shellcheck
)
# A one-node Slurm for the test of scripts/slurm (independent of the system's services), debootstrap for
# scripts/fresh_system.sh, and an emulator of other processors. ROS 1 if the system still packages it; otherwise its test is
# skipped with a message.
deb_packages=(dpkg-dev file)  # what CPack finds shared libraries and their packages with
slow_packages=("${deb_packages[@]}" munge slurmctld slurmd slurm-client debootstrap qemu-user)
if apt-cache show python3-rospy >/dev/null 2>&1; then slow_packages+=("${ros_live_packages[@]}"); fi

case "${1:-build}" in
  build) packages=("${build_packages[@]}") ;;
  python) packages=("${build_packages[@]}" "${python_packages[@]}") ;;
  test) packages=("${build_packages[@]}" "${test_packages[@]}") ;;
  slow) packages=("${build_packages[@]}" "${test_packages[@]}" "${slow_packages[@]}") ;;
  deb) packages=("${build_packages[@]}" "${deb_packages[@]}") ;;
  ros) packages=("${ros_packages[@]}") ;;
  ros_live) packages=("${ros_live_packages[@]}") ;;
  plot) packages=("${plot_packages[@]}") ;;
  *) echo "usage: $0 build|python|ros|ros_live|test|slow|deb|plot" >&2; exit 2 ;;
esac

is_installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q '^install ok installed'; }

find_missing() {
  missing=()
  for package in "${packages[@]}"; do
    if [ "$package" = libclang-rt-14-dev ] && ! apt-cache show "$package" >/dev/null 2>&1; then
      package=libclang-rt-dev  # newer systems name it without the version
    fi
    # npm may come with a Node.js from elsewhere. Without a browser package, the browser's test is skipped.
    if [ "$package" = npm ] && command -v npm >/dev/null; then continue; fi
    if [ "$package" = chromium ] && ! apt-cache show "$package" >/dev/null 2>&1; then continue; fi
    is_installed "$package" || missing+=("$package")
  done
}
find_missing
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "missing packages, and no sudo to install them: ${missing[*]}" >&2; exit 2; }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
find_missing  # again, now that apt has current package lists
echo "installing packages: ${missing[*]}" >&2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
