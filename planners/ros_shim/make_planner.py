#!/usr/bin/env python3
"""Writes the C++ source that joins ROS 1 nodes with avoidbench, from a topics file (docs/ros.md).

    make_planner.py --name NAME --topics FILE [--params FILE] --out FOLDER SOURCE…

It writes FOLDER/NAME_planner.cpp; a header main_STEM.h for each source with a node's main(), which is to be included before it
(-include); and mains.cmake, which lists those sources. Needs PyYAML (python3-yaml)."""
import argparse
import ast
import json
import pathlib
import re
import sys

import topics_file
from topics_file import Problem

# What ${…} may name beside the planner's own parameters: the members of ros_shim::Given.
GIVEN = """vehicle_max_speed_mps vehicle_max_acceleration_mps2 vehicle_max_yaw_rate_radps gravity_mps2 plan_period_s body_length_m
body_width_m body_height_m body_radius_m width_px height_px fx_px fy_px cx_px cy_px camera_rate_hz min_range_m max_range_m baseline_m
camera_x_m camera_y_m camera_z_m start_x_m start_y_m start_z_m start_yaw_rad goal_x_m goal_y_m goal_z_m goal_radius_m
lowest_x_m lowest_y_m lowest_z_m highest_x_m highest_y_m highest_z_m command_latency_s time_limit_s seed""".split()
ALIASES = {"max_speed_mps": "vehicle_max_speed_mps", "max_acceleration_mps2": "vehicle_max_acceleration_mps2",
           "max_yaw_rate_radps": "vehicle_max_yaw_rate_radps"}
FUNCTIONS = {"min": "std::min", "max": "std::max", "abs": "std::abs", "floor": "std::floor", "ceil": "std::ceil", "round": "std::round"}
OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
# The last part of a message's type -> (the function that reads it, the commands it may become)
COMMANDS = {
    "PositionCommand": ("points_of_position_command", "AB_COMMAND_TRAJECTORY"),
    "Twist": ("points_of_twist", "AB_COMMAND_VELOCITY"),
    "TwistStamped": ("points_of_twist_stamped", "AB_COMMAND_VELOCITY"),
    "PoseStamped": ("points_of_pose_stamped", "AB_COMMAND_POSITION"),
    "PositionTarget": ("points_of_position_target",
                       "AB_COMMAND_POSITION | AB_COMMAND_VELOCITY | AB_COMMAND_ACCELERATION | AB_COMMAND_TRAJECTORY"),
    "AttitudeTarget": ("points_of_attitude_target", "AB_COMMAND_RATES"),
    "MultiDOFJointTrajectory": ("points_of_trajectory", "AB_COMMAND_TRAJECTORY | AB_COMMAND_POSITION"),
}
TYPE = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*")
MAIN = re.compile(r"\bint\s+main\s*\(([^)]*)\)")


def quoted(text):
    return json.dumps(text)


def real(value):
    return repr(float(value))


class Parameter:
    """One that the planner declares to avoidbench."""

    def __init__(self, tree):
        known = ["name", "unit", "kind", "default", "lowest", "highest", "choices", "doc"]
        values = tree.map(known)
        for key in ("name", "default", "doc"):
            if key not in values:
                raise tree.problem(f"a parameter has a {key}")
        self.name, self.doc = values["name"].text(), values["doc"].text()
        if not re.fullmatch(r"[a-z][a-z0-9_]*", self.name):
            raise values["name"].problem(f'"{self.name}" is no name of a parameter: small letters, digits and _')
        self.unit = values["unit"].text() if "unit" in values else ""
        self.kind = values["kind"].word(["number", "integer", "choice", "text"]) if "kind" in values else "number"
        self.lowest = self.highest = self.preset = 0.0
        self.choices = self.preset_text = None
        preset = values["default"]
        if self.kind in ("number", "integer"):
            for key in ("lowest", "highest"):
                if key not in values:
                    raise tree.problem(f"a {self.kind} has a {key}")
            self.lowest, self.highest = values["lowest"].number(), values["highest"].number()
            self.preset = (preset.integer if self.kind == "integer" else preset.number)(self.lowest, self.highest)
        elif self.kind == "choice":
            if "choices" not in values:
                raise tree.problem("a choice has choices: [one, another]")
            words = [one.text() for one in values["choices"].list()]
            self.choices, self.preset_text = "|".join(words), preset.word(words)
        else:
            self.preset_text = preset.text()

    def cpp(self):
        kind = {"number": "AB_NUMBER", "integer": "AB_INTEGER", "choice": "AB_CHOICE", "text": "AB_TEXT"}[self.kind]
        def text(value):
            return "nullptr" if value is None else quoted(value)
        return (f"{{sizeof(ab_parameter), {kind}, {quoted(self.name)}, {quoted(self.unit)}, {quoted(self.doc)}, {real(self.lowest)}, "
                f"{real(self.highest)}, {real(self.preset)}, {text(self.choices)}, {text(self.preset_text)}}}")


class Expressions:
    """${…}: arithmetic over what a trial gives."""

    def __init__(self, parameters):
        self.parameters = parameters

    def names(self):
        return sorted([parameter.name for parameter in self.parameters] + GIVEN + list(ALIASES))

    def value_of(self, name, tree):
        for index, parameter in enumerate(self.parameters):
            if parameter.name == name:
                if parameter.kind in ("choice", "text"):
                    raise tree.problem(f"{name} is a text: it stands alone, ${{{name}}}")
                return f"given.numbers[{index}]"
        name = ALIASES.get(name, name)
        if name in GIVEN:
            return f"given.{name}"
        raise tree.problem(f'"{name}" is nothing that a trial gives: {", ".join(self.names())}')

    def arithmetic(self, node, tree):
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            return f"({self.arithmetic(node.left, tree)} {OPERATORS[type(node.op)]} {self.arithmetic(node.right, tree)})"
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return f"(-{self.arithmetic(node.operand, tree)})"
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return real(node.value)
        if isinstance(node, ast.Name):
            return self.value_of(node.id, tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS and not node.keywords:
            arguments = [self.arithmetic(one, tree) for one in node.args]
            if len(arguments) != (2 if node.func.id in ("min", "max") else 1):
                raise tree.problem(f"{node.func.id} takes {'two values' if node.func.id in ('min', 'max') else 'one value'}")
            return f"{FUNCTIONS[node.func.id]}({', '.join(arguments)})"
        raise tree.problem("${…} knows numbers, names, + - * /, brackets and " + ", ".join(FUNCTIONS))

    def cpp(self, text, tree):
        """The C++ of a ros_shim::Value for `${…}`."""
        if not re.fullmatch(r"\$\{[^{}]*\}", text.strip()):
            raise tree.problem("${…} is a whole value, not a part of one")
        inner = text.strip()[2:-1].strip()
        for index, parameter in enumerate(self.parameters):
            if parameter.name == inner and parameter.kind in ("choice", "text"):
                return f"Value(given.texts[{index}])"
            if parameter.name == inner and parameter.kind == "integer":
                return f"Value(static_cast<int>(given.numbers[{index}]))"
        try:
            node = ast.parse(inner, mode="eval").body
        except SyntaxError:
            raise tree.problem(f'"{inner}" is no expression') from None
        return f"Value({self.arithmetic(node, tree)})"


def value_cpp(tree, expressions):
    if tree.is_list():
        return "Value::list_of({" + ", ".join(value_cpp(one, expressions) for one in tree.list()) + "})"
    if tree.is_map():
        inner = ", ".join(f"{{{quoted(key)}, {value_cpp(value, expressions)}}}" for key, _, value in tree.items())
        return f"Value::map_of({{{inner}}})"
    value = tree.scalar()
    if value is None:
        raise tree.problem("a value stands here")
    if isinstance(value, bool):
        return f"Value({'true' if value else 'false'})"
    if isinstance(value, int):
        return f"Value({value})" if -2 ** 31 < value < 2 ** 31 else f"Value({real(value)})"
    if isinstance(value, float):
        return f"Value({real(value)})"
    if "${" in value:
        return expressions.cpp(value, tree)
    return f"Value(std::string({quoted(value)}))"


def parameter_lines(tree, prefix, expressions):
    """set_parameter() for each leaf of a map, as rosparam loads it."""
    lines = []
    for key, _, value in tree.items():
        name = prefix + key.strip("/")
        if value.is_map():
            lines += parameter_lines(value, name + "/", expressions)
        else:
            lines.append(f"  set_parameter({quoted(name)}, {value_cpp(value, expressions)});")
    return lines


class Node:
    def __init__(self, tree, sources, expressions):
        values = tree.map(["name", "main", "namespace", "remap", "params", "args"])
        if "name" not in values:
            raise tree.problem("a node has a name")
        self.name = values["name"].text()
        if not re.fullmatch(r"[A-Za-z]\w*", self.name):
            raise values["name"].problem(f'"{self.name}" is no name of a node')
        self.space = "/" + values["namespace"].text().strip("/") if "namespace" in values else "/"
        self.main = values["main"].text() if "main" in values else self.name
        place = values.get("main", values["name"])
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
        self.remappings = []
        for key, key_place, value in values["remap"].items() if "remap" in values else []:
            self.remappings.append((key, value.text()))
            for one in (key, value.text()):
                if not re.fullmatch(r"[~/A-Za-z][\w/]*", one):
                    raise key_place.problem(f'"{one}" is no name in ROS')
        self.arguments = [one.text() for one in values["args"].list()] if "args" in values else []
        full = f"{self.space if self.space != '/' else ''}/{self.name}/"
        self.parameters = parameter_lines(values["params"], full, expressions) if "params" in values else []

    def cpp(self):
        remappings = ", ".join(f"{{{quoted(a)}, {quoted(b)}}}" for a, b in self.remappings)
        arguments = ", ".join(quoted(one) for one in self.arguments)
        return (f"  spec.nodes.push_back({{{quoted(self.name)}, {quoted(self.space)}, &main_of_{self.name}, "
                f"{{{remappings}}}, {{{arguments}}}}});")


# publish: name -> (keys, needs); `topic` and `frame` are in all of them
PUBLISH = {
    "odometry": (["child_frame", "velocity", "all_states"], "AB_SEES_STATE"), "pose": (["all_states"], "AB_SEES_STATE"),
    "twist": (["all_states"], "AB_SEES_STATE"),
    "imu": ([], "AB_SEES_IMU"), "camera_pose": (["type", "camera"], "AB_SEES_DEPTH"),
    "depth": (["encoding", "info", "no_return_m", "invalid_m", "camera"], "AB_SEES_DEPTH"),
    "cloud": (["stride_px", "camera"], "AB_SEES_DEPTH"), "left": (["info", "camera"], "AB_SEES_STEREO"),
    "right": (["info", "camera"], "AB_SEES_STEREO"), "color": (["info", "camera"], "AB_SEES_COLOR"),
    "goal": (["type", "repeat_s"], "AB_SEES_STATE"),
}
POSE_TYPES = {"geometry_msgs/PoseStamped": "PoseType::pose_stamped", "nav_msgs/Odometry": "PoseType::odometry",
              "geometry_msgs/TransformStamped": "PoseType::transform_stamped"}
GOAL_TYPES = {"geometry_msgs/PoseStamped": "GoalType::pose_stamped", "geometry_msgs/PointStamped": "GoalType::point_stamped",
              "nav_msgs/Path": "GoalType::path", "geometry_msgs/Pose": "GoalType::pose"}


def length(values, key, preset):
    """Metres, where inf and nan are words too."""
    if key not in values:
        return preset
    value = values[key].scalar()
    if isinstance(value, str) and value in ("inf", "nan"):
        value = float(value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise values[key].problem("a number of metres, inf or nan stands here")
    if value == float("inf"):
        return "std::numeric_limits<double>::infinity()"
    return "std::numeric_limits<double>::quiet_NaN()" if value != value else real(value)


def publish_line(kind, tree):
    values = tree.map(["topic", "frame", *PUBLISH[kind][0]])
    if "topic" not in values:
        raise tree.problem(f"{kind} has a topic")
    topic = quoted(values["topic"].text())
    body = {"imu": "body", "twist": "world", "depth": "camera", "left": "camera", "right": "camera", "color": "camera"}
    frame = quoted(values["frame"].text() if "frame" in values else body.get(kind, "world"))
    camera = values["camera"].integer(0) if "camera" in values else 0
    info = quoted(values["info"].text()) if "info" in values else '""'
    all_states = str("all_states" in values and values["all_states"].truth()).lower()
    if kind == "odometry":
        child = quoted(values["child_frame"].text() if "child_frame" in values else "body")
        in_body = "velocity" in values and values["velocity"].word(["world", "body"]) == "body"
        return f"  spec.odometry.push_back({{{topic}, {frame}, {child}, {str(in_body).lower()}, {all_states}}});"
    if kind in ("pose", "twist", "imu"):
        member = {"pose": "poses", "twist": "twists", "imu": "imu"}[kind]
        return f"  spec.{member}.push_back({{{topic}, {frame}, {all_states}}});"
    if kind == "camera_pose":
        kind_of = values["type"].word(list(POSE_TYPES)) if "type" in values else "geometry_msgs/PoseStamped"
        return f"  spec.camera_poses.push_back({{{topic}, {frame}, {POSE_TYPES[kind_of]}, {camera}}});"
    if kind == "depth":
        encoding = values["encoding"].word(["32FC1", "16UC1"]) if "encoding" in values else "32FC1"
        in_mm = encoding == "16UC1"
        no_return = length(values, "no_return_m", "0.0" if in_mm else "std::numeric_limits<double>::infinity()")
        invalid = length(values, "invalid_m", "0.0" if in_mm else "std::numeric_limits<double>::quiet_NaN()")
        pixel = "PixelFormat::unsigned_mm" if in_mm else "PixelFormat::float_m"
        return f"  spec.depth.push_back({{{topic}, {frame}, {info}, {pixel}, {no_return}, {invalid}, {camera}}});"
    if kind == "cloud":
        stride = values["stride_px"].integer(1, 1000) if "stride_px" in values else 1
        return f"  spec.clouds.push_back({{{topic}, {frame}, {stride}, {camera}}});"
    if kind == "goal":
        kind_of = values["type"].word(list(GOAL_TYPES)) if "type" in values else "geometry_msgs/PoseStamped"
        repeat = real(values["repeat_s"].number(0)) if "repeat_s" in values else "0.0"
        return f"  spec.goals.push_back({{{topic}, {frame}, {GOAL_TYPES[kind_of]}, {repeat}}});"
    eye = {"left": 0, "right": 1, "color": 2}[kind]
    return f"  spec.pictures.push_back({{{topic}, {frame}, {info}, {eye}, {camera}}});"


class Command:
    def __init__(self, tree, nodes):
        values = tree.map(["topic", "type", "form", "frame", "hover_thrust", "stale_s", "ahead"])
        for key in ("topic", "type"):
            if key not in values:
                raise tree.problem(f"command has a {key}")
        self.topic, self.type = values["topic"].text(), values["type"].text()
        if not TYPE.fullmatch(self.type):
            raise values["type"].problem(f'"{self.type}" is no type of a message, as geometry_msgs/Twist')
        form = values["form"].word(list(COMMANDS)) if "form" in values else self.type.split("/")[1]
        if form not in COMMANDS:
            raise values["type"].problem(f"{form} is none of {', '.join(COMMANDS)}; form: says whose members it has")
        self.function, self.kinds = COMMANDS[form]
        in_body = "frame" in values and values["frame"].word(["world", "body"]) == "body"
        thrust = values["hover_thrust"].number(1e-6, 1e6) if "hover_thrust" in values else 0.0
        if form == "AttitudeTarget" and not thrust:
            raise tree.problem("an AttitudeTarget needs hover_thrust: the thrust at which the vehicle hovers")
        stale = values["stale_s"].number(1e-3, 1e6) if "stale_s" in values else 0.5
        node, horizon, step = "", 0.0, 0.05
        if "ahead" in values:
            ahead = values["ahead"].map(["node", "horizon_s", "step_s"])
            if "node" not in ahead or "horizon_s" not in ahead:
                raise values["ahead"].problem("ahead has the node that serves set points, and horizon_s")
            node = ahead["node"].word([one.name for one in nodes])
            horizon = ahead["horizon_s"].number(1e-3, 60)
            step = ahead["step_s"].number(1e-3, 60) if "step_s" in ahead else step
            if form != "PositionCommand":
                raise values["ahead"].problem("only PositionCommand is run ahead: it has position, velocity and acceleration")
            self.kinds = "AB_COMMAND_TRAJECTORY"
        self.cpp = (f"  spec.command = {{{quoted(self.topic)}, {str(in_body).lower()}, {real(thrust)}, {real(stale)}, {quoted(node)}, "
                    f"{real(horizon)}, {real(step)}}};")


class Planner:
    def __init__(self, name, topics, params, sources):
        tree = topics_file.read(topics)
        values = tree.map(["version", "summary", "lead_s", "nodes", "params", "packages", "parameters", "publish", "command"])
        for key in ("nodes", "publish", "command"):
            if key not in values:
                raise tree.problem(f"a topics file has {key}")
        self.name = name
        self.version = values["version"].text() if "version" in values else "1.0"
        self.summary = values["summary"].text() if "summary" in values else "ROS 1 nodes, compiled unchanged."
        self.lead_s = values["lead_s"].number(0, 600) if "lead_s" in values else 2.0
        self.parameters = [Parameter(one) for one in values["parameters"].list()] if "parameters" in values else []
        expressions = Expressions(self.parameters)
        self.nodes = [Node(one, sources, expressions) for one in values["nodes"].list()]
        for later, node in enumerate(self.nodes):
            for other in self.nodes[:later]:
                if node.name == other.name or node.source == other.source:
                    raise values["nodes"].list()[later].problem("two nodes have one name or one main(): each needs its own")
        self.lines = []
        if params is not None:
            self.lines += parameter_lines(topics_file.read(params), "/", expressions)
        if "params" in values:
            self.lines += parameter_lines(values["params"], "/", expressions)
        for node in self.nodes:
            self.lines += node.parameters
        self.packages = [(key, value.text()) for key, _, value in values["packages"].items()] if "packages" in values else []
        self.needs, self.published = {"AB_SEES_STATE"}, []
        for kind, place, value in values["publish"].items():
            if kind not in PUBLISH:
                raise place.problem(f'"{kind}" is none of {", ".join(PUBLISH)}')
            self.needs.add(PUBLISH[kind][1])
            lines = [publish_line(kind, one) for one in value.list()]
            if kind in ("odometry", "pose", "twist") and any(line.endswith(", true});") for line in lines):
                self.needs.add("AB_SEES_STATES")
            self.published += lines
        self.command = Command(values["command"], self.nodes)

    def cpp(self):
        count = len(self.parameters)
        lines = ["// By make_planner.py.", "#include <algorithm>", "#include <cmath>", "#include <limits>", "",
                 f'#include "{self.command.type}.h"', '#include "planner_spec.hpp"', '#include "ros_shim/callback.h"', ""]
        for node in self.nodes:
            lines.append(f'extern "C" int {node.symbol}({node.signature});')
        lines += ["", "namespace ros_shim {", "namespace {", ""]
        for node in self.nodes:
            arguments = ("int count, char** words", "count, words") if node.signature else ("int, char**", "")
            lines.append(f"int main_of_{node.name}({arguments[0]}) {{ return {node.symbol}({arguments[1]}); }}")
        if count:
            lines += ["", f"const ab_parameter parameters[{count}] = {{"]
            lines += [f"    {parameter.cpp()}," for parameter in self.parameters]
            pointers = ", ".join(f"&parameters[{index}]" for index in range(count))
            lines += ["};", f"const ab_parameter* const parameter_pointers[{count}] = {{{pointers}}};"]
        lines += ["", "void set_parameters(const Given& given) {", "  static_cast<void>(given);", *self.lines, "}", "",
                  "ros::Subscriber subscribe(ros::NodeHandle& host, const CommandForm& form,",
                  "                          std::function<void(SetPoints)> take) {",
                  f"  using Message = {self.command.type.replace('/', '::')};",
                  "  return host.subscribe<Message>(form.topic, 0, [take](const Message::ConstPtr& message) {",
                  f"    take({self.command.function}(*message, now_ns()));", "  });", "}", "", "}  // namespace", "",
                  "PlannerSpec planner_spec() {", "  PlannerSpec spec;", f"  spec.lead_s = {real(self.lead_s)};",
                  *[node.cpp() for node in self.nodes],
                  *[f"  spec.packages.push_back({{{quoted(a)}, {quoted(b)}}});" for a, b in self.packages],
                  *self.published, self.command.cpp, "  spec.set_parameters = &set_parameters;",
                  "  spec.subscribe = &subscribe;", "  return spec;", "}", "",
                  f"const ab_planner planner_table = {{sizeof(ab_planner), AVOIDBENCH_ABI_VERSION, {quoted(self.name)},",
                  f"    {quoted(self.version)}, {quoted(self.summary)},", f"    {' | '.join(sorted(self.needs))}, {self.command.kinds},",
                  f"    {count}, 0, {'parameter_pointers' if count else 'nullptr'}, &create, &destroy, &reset, &plan, nullptr, 0, 0, "
                  "nullptr};", "", "}  // namespace ros_shim", ""]
        return "\n".join(lines)


def write(file, text):
    if not file.exists() or file.read_text() != text:  # compile again only where something changed
        file.write_text(text)


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
    asked.out.mkdir(parents=True, exist_ok=True)
    write(asked.out / f"{asked.name}_planner.cpp", planner.cpp())
    listing = []
    for node in planner.nodes:
        header = asked.out / f"main_{node.source.stem}.h"
        write(header, f"// By make_planner.py: the node's main() under a name of its own.\nint main({node.signature}) "
                      f'__asm__("{node.symbol}");\n')
        listing.append(f'set_property(SOURCE "{node.source}" APPEND PROPERTY COMPILE_OPTIONS -include "{header}")')
    write(asked.out / "mains.cmake", "\n".join(listing) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
