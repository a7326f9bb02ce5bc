#!/usr/bin/env python3
"""Writes the C++ source that joins ROS 1 nodes with avoidbench, from a topics file (docs/ros.md).

    make_planner.py --name NAME --topics FILE [--params FILE] --out FOLDER SOURCE…

It writes FOLDER/NAME_planner.cpp; a header main_STEM.h for each source with a node's main(), which is to be included
before it (-include); and mains.cmake, which lists those sources. Needs PyYAML (python3-yaml)."""

import argparse
import math
import pathlib
import re
import sys

import topics_file
import topics_spec
from make_messages import quoted, write
from topics_file import Problem

FUNCTIONS = {
    "min": "std::min",
    "max": "std::max",
    "abs": "std::abs",
    "floor": "std::floor",
    "ceil": "std::ceil",
    "round": "std::round",
}
# The last part of a message's type -> the function that reads it
READERS = {
    "PositionCommand": "points_of_position_command",
    "Twist": "points_of_twist",
    "TwistStamped": "points_of_twist_stamped",
    "PoseStamped": "points_of_pose_stamped",
    "PositionTarget": "points_of_position_target",
    "AttitudeTarget": "points_of_attitude_target",
    "MultiDOFJointTrajectory": "points_of_trajectory",
}
POSE_TYPES = {
    "geometry_msgs/PoseStamped": "PoseType::pose_stamped",
    "nav_msgs/Odometry": "PoseType::odometry",
    "geometry_msgs/TransformStamped": "PoseType::transform_stamped",
}
GOAL_TYPES = {
    "geometry_msgs/PoseStamped": "GoalType::pose_stamped",
    "geometry_msgs/PointStamped": "GoalType::point_stamped",
    "nav_msgs/Path": "GoalType::path",
    "geometry_msgs/Pose": "GoalType::pose",
}
MAIN = re.compile(r"\bint\s+main\s*\(([^)]*)\)")


def real(value):
    value = float(value)
    if math.isinf(value):
        return "std::numeric_limits<double>::infinity()"
    return "std::numeric_limits<double>::quiet_NaN()" if math.isnan(value) else repr(value)


def parameter_cpp(one):
    kind = {"number": "AB_NUMBER", "integer": "AB_INTEGER", "choice": "AB_CHOICE", "text": "AB_TEXT"}[one.kind]

    def text(value):
        return "nullptr" if value is None else quoted(value)

    choices = None if one.choices is None else "|".join(one.choices)
    return (
        f"{{sizeof(ab_parameter), {kind}, {quoted(one.name)}, {quoted(one.unit)}, {quoted(one.doc)}, {real(one.lowest)}, "
        f"{real(one.highest)}, {real(one.preset)}, {text(choices)}, {text(one.preset_text)}}}"
    )


def number_cpp(tree):
    """The arithmetic of topics_spec.Expressions."""
    what, *rest = tree
    if what == "number":
        return real(rest[0])
    if what == "given":
        return f"given.{rest[0]}"
    if what in ("own", "own integer"):
        return f"given.numbers[{rest[0]}]"
    parts = [number_cpp(one) for one in rest]
    if what == "negative":
        return f"(-{parts[0]})"
    if what in FUNCTIONS:
        return f"{FUNCTIONS[what]}({', '.join(parts)})"
    return f"({parts[0]} {what} {parts[1]})"


def value_cpp(value):
    """The C++ of a ros_shim::Value."""
    if isinstance(value, list):
        return "Value::list_of({" + ", ".join(value_cpp(one) for one in value) + "})"
    if isinstance(value, dict):
        inner = ", ".join(f"{{{quoted(key)}, {value_cpp(one)}}}" for key, one in value.items())
        return f"Value::map_of({{{inner}}})"
    if isinstance(value, tuple):
        if value[0] == "own text":
            return f"Value(given.texts[{value[1]}])"
        if value[0] == "own integer":
            return f"Value(static_cast<int>(given.numbers[{value[1]}]))"
        return f"Value({number_cpp(value)})"
    if isinstance(value, bool):
        return f"Value({'true' if value else 'false'})"
    if isinstance(value, int):
        return f"Value({value})" if -(2**31) < value < 2**31 else f"Value({real(value)})"
    if isinstance(value, float):
        return f"Value({real(value)})"
    return f"Value(std::string({quoted(value)}))"


def parameter_lines(leaves):
    """set_parameter() for each leaf of a map."""
    return [f"  set_parameter({quoted(name)}, {value_cpp(value)});" for name, value in leaves]


class Node(topics_spec.NodeSpec):
    def __init__(self, tree, sources, expressions):
        super().__init__(tree, expressions)
        values = self.values
        self.main = values["main"].text() if "main" in values else self.name
        place = values.get("main", self.place)
        stem = pathlib.PurePath(self.main).stem if self.main.endswith((".cpp", ".cc", ".cxx")) else self.main
        found = [source for source in sources if source.stem == stem]
        if not found:
            raise place.problem(f"no source {stem}.cpp among SOURCES: main says whose main() the node runs")
        self.source, self.symbol = found[0], f"ros_shim_main_{re.sub(r'[^A-Za-z0-9_]', '_', stem)}"
        text = self.source.read_text(encoding="utf-8", errors="replace")
        text = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.DOTALL)
        match = MAIN.search(text)
        if not match:
            raise place.problem(f"{self.source.name} has no int main(int argc, char** argv)")
        self.signature = "int, char**" if match[1].strip() not in ("", "void") else ""

    def cpp(self):
        remappings = ", ".join(f"{{{quoted(a)}, {quoted(b)}}}" for a, b in self.remappings)
        arguments = ", ".join(quoted(one) for one in self.arguments)
        return (
            f"  spec.nodes.push_back({{{quoted(self.name)}, {quoted(self.space)}, &main_of_{self.name}, "
            f"{{{remappings}}}, {{{arguments}}}}});"
        )


def publish_line(one):
    kind, topic, frame, camera = one["kind"], quoted(one["topic"]), quoted(one["frame"]), one["camera"]
    all_states = str(one["all_states"]).lower()
    if kind == "odometry":
        return (
            f"  "
            f"spec.odometry.push_back({{{topic}, {frame}, {quoted(one['child_frame'])}, {str(one['in_body']).lower()}, "
            f"{all_states}}});"
        )
    if kind == "tf":
        frames = f"{frame}, {quoted(one['child_frame'])}, {quoted(one['camera_frame'])}"
        return f"  spec.transforms.push_back({{{topic}, {frames}, {camera}}});"
    if kind in ("pose", "twist", "imu"):
        member = {"pose": "poses", "twist": "twists", "imu": "imu"}[kind]
        return f"  spec.{member}.push_back({{{topic}, {frame}, {all_states}}});"
    if kind == "camera_pose":
        return f"  spec.camera_poses.push_back({{{topic}, {frame}, {POSE_TYPES[one['type']]}, {camera}}});"
    info = quoted(one["info"])
    if kind == "depth":
        pixel = "PixelFormat::unsigned_mm" if one["in_mm"] else "PixelFormat::float_m"
        return (
            f"  "
            f"spec.depth.push_back({{{topic}, {frame}, {info}, {pixel}, {real(one['no_return_m'])}, {real(one['invalid_m'])}, "
            f"{camera}}});"
        )
    if kind == "cloud" and one["lidar"] is not None:
        return f"  spec.sweeps.push_back({{{topic}, {frame}, PointsIn::{one['points_in']}, {one['lidar']}}});"
    if kind == "cloud":
        return f"  spec.clouds.push_back({{{topic}, {frame}, {one['stride_px']}, {camera}}});"
    if kind == "goal":
        return f"  spec.goals.push_back({{{topic}, {frame}, {GOAL_TYPES[one['type']]}, {real(one['repeat_s'])}}});"
    eye = {"left": 0, "right": 1, "color": 2}[kind]
    return f"  spec.pictures.push_back({{{topic}, {frame}, {info}, {eye}, {camera}}});"


def message_lines(index, one, topics):
    """The function that advertises a message of any type and gives what publishes it. What is wrong with a field the
    compiler says with its line in the topics file."""
    kind = one["type"].replace("/", "::")
    lines = [
        "",
        f"std::function<void()> advertise_{index}(ros::NodeHandle& host, const Given& given) {{",
        f"  const ros::Publisher publisher = host.advertise<{kind}>({quoted(one['topic'])}, 1, true);",
        "  return [publisher, &given] {",
        "    static_cast<void>(given);",
        f"    {kind} message;",
        f"    stamp(message, {quoted(one['frame'])});",
    ]
    for path, value, line in one["fields"]:
        lines += [f"#line {line} {quoted(str(topics))}", f"    assign(message.{path}, {value_cpp(value)});"]
    return [*lines, "    publisher.publish(message);", "  };", "}"]


class Command(topics_spec.CommandSpec):
    def __init__(self, tree):
        super().__init__(tree)
        self.function = READERS[self.form]
        self.bits = " | ".join(f"AB_COMMAND_{kind.upper()}" for kind in self.kinds)
        self.cpp = (
            f"  spec.command = {{{quoted(self.topic)}, {str(self.in_body).lower()}, {real(self.hover_thrust)}, "
            f"{real(self.stale_s)}}};"
        )


class Planner:
    def __init__(self, name, topics, params, sources):
        tree = topics_file.read(topics)
        values = tree.map(topics_spec.KEYS)
        for key in ("nodes", "publish", "command"):
            if key not in values:
                raise tree.problem(f"a topics file has {key}")
        self.name = name
        self.version = values["version"].text() if "version" in values else "1.0"
        self.summary = values["summary"].text() if "summary" in values else "ROS 1 nodes, compiled unchanged."
        self.lead_s = values["lead_s"].number(0, 600) if "lead_s" in values else 2.0
        self.parameters = (
            [topics_spec.Parameter(one) for one in values["parameters"].list()] if "parameters" in values else []
        )
        expressions = topics_spec.Expressions(self.parameters)
        self.compute_clock_us = values["compute_clock_us"].number(1e-3, 1e6) if "compute_clock_us" in values else 1.0
        for one in values["parameters"].list() if "parameters" in values else []:
            name = one.map(topics_spec.PARAMETER_KEYS)["name"]
            if name.text() == "compute_clock_us":
                raise name.problem("each ROS planner has compute_clock_us: compute_clock_us: N sets its default")
        self.nodes = [Node(one, sources, expressions) for one in values["nodes"].list()]
        for later, node in enumerate(self.nodes):
            for other in self.nodes[:later]:
                if node.name == other.name or node.source == other.source:
                    raise (
                        values["nodes"]
                        .list()[later]
                        .problem("two nodes have one name or one main(): each needs its own")
                    )
        self.lines = []
        if params is not None:
            self.lines += parameter_lines(topics_spec.leaves(topics_file.read(params), "/", expressions))
        if "params" in values:
            self.lines += parameter_lines(topics_spec.leaves(values["params"], "/", expressions))
        for node in self.nodes:
            self.lines += parameter_lines(node.parameters)
        # What is for real nodes alone (planners/ros_bridge) is passed over, and told.
        self.notes = [f"{values['live'].problem('live is for ros_bridge alone')}"] if "live" in values else []
        self.notes += [
            f"{node.values['run'].problem('run is for ros_bridge alone')}"
            for node in self.nodes
            if "run" in node.values
        ]
        self.packages = (
            [(key, value.text()) for key, _, value in values["packages"].items()] if "packages" in values else []
        )
        published = topics_spec.all_published(values["publish"], expressions)
        self.needs = {f"AB_INPUT_{what.upper()}" for what in topics_spec.seen_of(published)}
        self.messages = [one for one in published if one["kind"] == "message"]
        self.published = [publish_line(one) for one in published if one["kind"] != "message"]
        self.published += [
            f"  spec.messages.push_back({{{quoted(one['topic'])}, {str(one['when'] == 'start').lower()}, "
            f"{real(one['every_s'])}, &advertise_{index}}});"
            for index, one in enumerate(self.messages)
        ]
        self.topics = topics
        self.world = topics_spec.world_of(values["world"], expressions) if "world" in values else None
        self.command = Command(values["command"])

    def world_lines(self):
        """The function that says where the nodes' own world lies."""
        if self.world is None:
            return []
        numbers = ", ".join(number_cpp(one) if isinstance(one, tuple) else real(one) for one in self.world)
        head = "std::array<double, 4> world(const Given& given) {"
        return [head, "  static_cast<void>(given);", f"  return {{{{{numbers}}}}};", "}", ""]

    def cpp(self):
        count = len(self.parameters) + 1
        lines = [
            "// By make_planner.py.",
            "#include <algorithm>",
            "#include <array>",
            "#include <cmath>",
            "#include <limits>",
            "",
            *[
                f'#include "{type_}.h"'
                for type_ in sorted({self.command.type, *(one["type"] for one in self.messages)})
            ],
            '#include "avoidbench/repeatable.hpp"',
            '#include "planner_spec.hpp"',
            '#include "ros_shim/assign.h"',
            '#include "ros_shim/callback.h"',
            "",
        ]
        for node in self.nodes:
            lines.append(f'extern "C" int {node.symbol}({node.signature});')
        lines += ["", "namespace ros_shim {", "namespace {", ""]
        for node in self.nodes:
            arguments = ("int count, char** words", "count, words") if node.signature else ("int, char**", "")
            lines.append(f"int main_of_{node.name}({arguments[0]}) {{ return {node.symbol}({arguments[1]}); }}")
        lines += ["", f"const ab_parameter parameters[{count}] = {{"]
        lines += [f"    {parameter_cpp(parameter)}," for parameter in self.parameters]
        lines += [f"    avoidbench::compute_clock_parameter({real(self.compute_clock_us)}),", "};"]
        pointers = ", ".join(f"&parameters[{index}]" for index in range(count))
        lines += [f"const ab_parameter* const parameter_pointers[{count}] = {{{pointers}}};"]
        for index, one in enumerate(self.messages):
            lines += message_lines(index, one, self.topics)
        lines += [
            "",
            "void set_parameters(const Given& given) {",
            "  static_cast<void>(given);",
            *self.lines,
            "}",
            "",
            *self.world_lines(),
            "ros::Subscriber subscribe(ros::NodeHandle& host, const CommandForm& form,",
            "                          std::function<void(SetPoints)> take) {",
            f"  using Message = {self.command.type.replace('/', '::')};",
            "  return host.subscribe<Message>(form.topic, 0, [take](const Message::ConstPtr& message) {",
            f"    take({self.command.function}(*message, now_ns()));",
            "  });",
            "}",
            "",
            "}  // namespace",
            "",
            "PlannerSpec planner_spec() {",
            "  PlannerSpec spec;",
            f"  spec.compute_clock = {len(self.parameters)};",
            f"  spec.lead_s = {real(self.lead_s)};",
            *[node.cpp() for node in self.nodes],
            *[f"  spec.packages.push_back({{{quoted(a)}, {quoted(b)}}});" for a, b in self.packages],
            *self.published,
            self.command.cpp,
            *(["  spec.world = &world;"] if self.world else []),
            "  spec.set_parameters = &set_parameters;",
            "  spec.subscribe = &subscribe;",
            "  return spec;",
            "}",
            "",
            f"const ab_planner planner_table = {{sizeof(ab_planner), AVOIDBENCH_ABI_VERSION, {quoted(self.name)},",
            f"    {quoted(self.version)}, {quoted(self.summary)},",
            f"    {' | '.join(sorted(self.needs))}, {self.command.bits},",
            f"    {count}, 0, parameter_pointers, &create, &destroy, &reset, &plan, "
            f"nullptr, 0, 0, "
            "nullptr, 0.0, 0.0};",
            "",
            "}  // namespace ros_shim",
            "",
        ]
        return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--name", required=True)
    parser.add_argument("--topics", required=True, type=pathlib.Path)
    parser.add_argument("--params", type=pathlib.Path)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("sources", nargs="+", type=pathlib.Path)
    asked = parser.parse_args()
    if not re.fullmatch(r"[a-z0-9_]+", asked.name):
        print(f'"{asked.name}" is no name of a planner: small letters, digits and _', file=sys.stderr)
        return 1
    try:
        planner = Planner(asked.name, asked.topics, asked.params, asked.sources)
    except Problem as problem:
        print(problem, file=sys.stderr)
        return 1
    for note in planner.notes:
        print(note, file=sys.stderr)
    write(asked.out / f"{asked.name}_planner.cpp", planner.cpp())
    listing = []
    for node in planner.nodes:
        header = asked.out / f"main_{node.source.stem}.h"
        write(
            header,
            f"// By make_planner.py: the node's main() under a name of its own.\nint main({node.signature}) "
            f'__asm__("{node.symbol}");\n',
        )
        listing.append(f'set_property(SOURCE "{node.source}" APPEND PROPERTY COMPILE_OPTIONS -include "{header}")')
    write(asked.out / "mains.cmake", "\n".join(listing) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
