#!/usr/bin/env bash
# wrap.sh PROGRAM EXAMPLE PREFIX: `planners wrap` on a catkin workspace with the example's sources: the two files that it
# writes build without an edit and fly, the same with one and two workers; bad launch files give a message with a place.
# shellcheck disable=SC2016  # ${…} of topics files and CMake
set -euo pipefail
program=$1 example=$2 prefix=$3
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source-path=SCRIPTDIR source=../support/same_rows.sh
source "$here/../support/same_rows.sh"

src=$PWD/catkin_ws/src
mkdir catkin_ws
cp -r "$here/workspace/src" catkin_ws/
mkdir -p "$src"/flyer/src "$src"/primitives/{src,include} "$src"/messages/ros_example/msg
cp "$example"/src/{planner_node,traj_server}.cpp "$src/flyer/src/"
cp "$example/src/primitive_planner.cpp" "$src/primitives/src/"
cp "$example/src/primitive_planner.h" "$src/primitives/include/"
cp "$example"/msg/*.msg "$src/messages/ros_example/msg/"
# A second package with a copy of a source, but for what it includes, as workspaces have them.
cp -r "$src/primitives" "$src/primitives_of_another"
sed -i 's/primitives/primitives_of_another/g' "$src"/primitives_of_another/{CMakeLists.txt,package.xml}
sed -i '1i #include <vector>' "$src/primitives_of_another/src/primitive_planner.cpp"
sed -i 's/roscpp primitives/& primitives_of_another/' "$src/flyer/CMakeLists.txt"
sed -i 's|<depend>primitives</depend>|&<depend>primitives_of_another</depend>|' "$src/flyer/package.xml"
launch=$src/flyer/launch/fly.launch

fail() {
  echo "$1" >&2
  exit 1
}
has() { # FILE TEXT
  grep -qF -- "$2" "$1" || { cat "$1" >&2; fail "$1 lacks: $2"; }
}

"$program" planners wrap "$launch" max_speed:=1.25 > said.txt
for text in "nodes     planner, traj_server" "rviz (rviz/rviz: no C++ sources here)" \
  "copy      primitives_of_another/src/primitive_planner.cpp: the same as another source, compiled once" \
  "command   /drone/position_cmd (quadrotor_msgs/PositionCommand)" "No questions."; do
  has said.txt "$text"
done
for text in "{name: max_speed_mps, unit: m/s, default: 1.25," "main: planner_node" "~odom: /vio/odometry" \
  'fx: "${fx_px}"  # guess: 387.2 in the launch file' "margin: 0.55" 'start_yaw: "${start_yaw_rad}"  # guess: 0.5' \
  "max_yaw_rate: 1.5" "odometry: {topic: /vio/odometry, velocity: world}" \
  "goal: {topic: /move_base_simple/goal, type: geometry_msgs/PoseStamped}"; do
  has flyer/topics.yaml "$text"
done
for text in '${workspace}/primitives/src/primitive_planner.cpp' 'MESSAGES ${workspace}/messages/ros_example' \
  "NEEDS opencv" "STANDARD 14)"; do
  has flyer/CMakeLists.txt "$text"
done
! grep -q hall_simulator flyer/CMakeLists.txt flyer/topics.yaml || fail "the simulator is compiled"

# It writes over nothing, and says where a launch file is wrong.
refused() { # TEXT WORD…: planners wrap with these words fails and says the text
  local text=$1 status=0
  shift
  "$program" planners wrap "$@" > /dev/null 2> problem.txt || status=$?
  [ "$status" -eq 2 ] || fail "exit code $status of: planners wrap $*"
  has problem.txt "$text"
}
refused "flyer/CMakeLists.txt is there already: --folder FOLDER, or remove it" "$launch"
refused "no such file" nowhere.launch
bad=$src/flyer/launch/bad.launch
refused_launch() { # TEXT LAUNCH: a launch file of this text
  echo "$2" > "$bad"
  refused "bad.launch:$1" "$bad" --folder other
}
refused_launch "1: mismatched tag" "<launch></lunch>"
refused_launch "2: <nodes> is no tag of a launch file" $'<launch>\n<nodes/></launch>'
refused_launch "1: <node> has no type" '<launch><node pkg="flyer" name="a"/></launch>'
refused_launch "2: no value for the argument speed: give speed:=VALUE" $'<launch><arg name="speed"/>\n<param name="a" value="$(arg speed)"/></launch>'
refused_launch "1: no package nothing in the workspace" '<launch><include file="$(find nothing)/a.xml"/></launch>'
refused_launch "1: a: could not convert string to float" '<launch><param name="a" value="b" type="double"/></launch>'
refused_launch "1: \$(eval …) with __" '<launch><arg name="a" value="$(eval __import__(1))"/></launch>'
refused_launch "1: more than 50 files" '<launch><include file="$(dirname)/bad.launch"/></launch>'
echo '<launch><node pkg="hall_simulator" type="hall_simulator" name="a"/></launch>' > "$bad"
refused "no node of bad.launch publishes a command that avoidbench takes" "$bad" --folder other
[ ! -e other ] || fail "something was written all the same"

cmake -S flyer -B flyer/build -DCMAKE_PREFIX_PATH="$prefix" > cmake.txt || { cat cmake.txt >&2; fail "cmake"; }
cmake --build flyer/build > build.txt || { cat build.txt >&2; fail "build"; }
cat > hall.yaml <<YAML
sweep: wrapped
seed: 1
maps: {generator: hall, area_m: [12, 18], poisson_radius_m: [4, 5], seeds: [1]}
trials: 2
planners:
  - $PWD/flyer/build/planners/flyer.so
vehicle: hummingbird
sensor: {preset: depth_ideal, width_px: 160, height_px: 120}
latency: {mode: fixed, ms: 33}
mission: {time_limit_s: 60}
YAML
same_rows "$program" hall.yaml
reached=$(sqlite3 one.db "SELECT count(*) FROM trials WHERE finished = 1")
[ "$reached" -eq 4 ] || fail "$reached of 4 flights reached the goal"
