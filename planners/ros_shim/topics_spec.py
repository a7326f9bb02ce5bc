"""What a topics file says (docs/ros.md), checked and with every preset filled in: for make_planner.py, which writes C++
of it, and for planners/ros_bridge, which flies by it."""

import ast
import re
import sys

from topics_file import shown

# What ${…} may name beside the planner's own parameters: the members of ros_shim::Given.
GIVEN = """vehicle_max_speed_mps vehicle_max_acceleration_mps2 vehicle_max_yaw_rate_radps gravity_mps2 plan_period_s
body_length_m body_width_m body_height_m body_radius_m width_px height_px fx_px fy_px cx_px cy_px
camera_rate_hz min_range_m max_range_m baseline_m camera_x_m camera_y_m camera_z_m lidar_rate_hz lidar_min_range_m
lidar_max_range_m lidar_x_m lidar_y_m lidar_z_m start_x_m start_y_m
start_z_m start_yaw_rad goal_x_m goal_y_m goal_z_m goal_radius_m lowest_x_m lowest_y_m lowest_z_m
highest_x_m highest_y_m highest_z_m command_latency_s time_limit_s seed""".split()
ALIASES = {
    "max_speed_mps": "vehicle_max_speed_mps",
    "max_acceleration_mps2": "vehicle_max_acceleration_mps2",
    "max_yaw_rate_radps": "vehicle_max_yaw_rate_radps",
}
MOST_CHARACTERS, MOST_DEPTH = 1000, 100  # of an expression: what reads it calls itself for each level
FUNCTIONS = ("min", "max", "abs", "floor", "ceil", "round")
OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
# The last part of a message's type -> the commands it may become, as avoidbench.Planner names them
COMMANDS = {
    "PositionCommand": ("trajectory",),
    "Twist": ("velocity",),
    "TwistStamped": ("velocity",),
    "PoseStamped": ("position",),
    "PositionTarget": ("position", "velocity", "acceleration", "trajectory"),
    "AttitudeTarget": ("rates",),
    "MultiDOFJointTrajectory": ("trajectory", "position"),
}
# What is published -> (keys beside `topic` and `frame`, what the planner sees for it)
PUBLISH = {
    "odometry": (["child_frame", "velocity", "all_states"], "state"),
    "pose": (["all_states"], "state"),
    "twist": (["all_states"], "state"),
    "tf": (["child_frame", "camera_frame", "camera"], "state"),
    "imu": ([], "imu"),
    "camera_pose": (["type", "camera"], "depth"),
    "depth": (["encoding", "info", "no_return_m", "invalid_m", "camera"], "depth"),
    "cloud": (["stride_px", "camera", "lidar", "points_in"], "depth"),  # with `lidar` it sees points
    "left": (["info", "camera"], "stereo"),
    "right": (["info", "camera"], "stereo"),
    "color": (["info", "camera"], "color"),
    "goal": (["type", "repeat_s"], "goals"),
    "message": (["type", "fields", "when", "every_s"], "state"),  # with `when: goal` it sees goals
}
FRAMES = {"imu": "body", "twist": "world", "depth": "camera", "left": "camera", "right": "camera", "color": "camera"}
POSE_TYPES = ("geometry_msgs/PoseStamped", "nav_msgs/Odometry", "geometry_msgs/TransformStamped")
POINTS_IN = ("world", "body", "lidar")  # whose coordinates a lidar's points have
# Of a cloud: keys of a depth image's and of a lidar's -> what they are for
CLOUD_KEYS = {"stride_px": "camera", "camera": "camera", "points_in": "lidar"}
GOAL_TYPES = ("geometry_msgs/PoseStamped", "geometry_msgs/PointStamped", "nav_msgs/Path", "geometry_msgs/Pose")
# Keys of a topics file; each says which of the two takes it, where it is one of them alone.
KEYS = ["version", "summary", "lead_s", "compute_clock_us", "nodes", "params", "packages", "parameters", "publish"]
KEYS += ["command", "live", "world"]
PARAMETER_KEYS = ["name", "unit", "kind", "default", "lowest", "highest", "choices", "doc"]
NODE_KEYS = ["name", "main", "run", "namespace", "remap", "params", "args"]
TYPE = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*")


class Parameter:
    """One that the planner declares to avoidbench."""

    def __init__(self, tree):
        values = tree.map(PARAMETER_KEYS)
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
            self.choices = [one.text() for one in values["choices"].list()]
            self.preset_text = preset.word(self.choices)
        else:
            self.preset_text = preset.text()

    def is_text(self):
        return self.kind in ("choice", "text")


class Expressions:
    """${…}: arithmetic over what a trial gives, as a tree of tuples: ("number", 2.0), ("given", name), ("own", index),
    ("negative", a), ("+", a, b), ("min", a, b) and so on."""

    def __init__(self, parameters):
        self.parameters = parameters

    def names(self):
        return sorted([parameter.name for parameter in self.parameters] + GIVEN + list(ALIASES))

    def _value_of(self, name, tree):
        for index, parameter in enumerate(self.parameters):
            if parameter.name == name:
                if parameter.is_text():
                    raise tree.problem(f"{name} is a text: it stands alone, ${{{name}}}")
                return "own", index
        name = ALIASES.get(name, name)
        if name in GIVEN:
            return "given", name
        raise tree.problem(f'"{shown(name)}" is nothing that a trial gives: {", ".join(self.names())}')

    def _arithmetic(self, node, tree, depth=1):
        if depth > MOST_DEPTH:
            raise tree.problem(f"this expression nests more than {MOST_DEPTH} deep")

        def read(inner):
            return self._arithmetic(inner, tree, depth + 1)

        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            return OPERATORS[type(node.op)], read(node.left), read(node.right)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return "negative", read(node.operand)
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            # As a whole number it may be beyond what a float holds, as a float it is inf then.
            if node.value > sys.float_info.max:
                raise tree.problem("a number in this expression is beyond the greatest number, 1.8e308")
            return "number", float(node.value)
        if isinstance(node, ast.Name):
            return self._value_of(node.id, tree)
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in FUNCTIONS
            and not node.keywords
        ):
            arguments = [read(one) for one in node.args]
            if len(arguments) != (2 if node.func.id in ("min", "max") else 1):
                raise tree.problem(
                    f"{node.func.id} takes {'two values' if node.func.id in ('min', 'max') else 'one value'}"
                )
            return node.func.id, *arguments
        raise tree.problem("${…} knows numbers, names, + - * /, brackets and " + ", ".join(FUNCTIONS))

    def read(self, text, tree):
        """The tree of `${…}`; of a parameter alone that is a text or whole ("own text" or "own integer", its index)."""
        if not re.fullmatch(r"\$\{[^{}]*\}", text.strip()):
            raise tree.problem("${…} is a whole value, not a part of one")
        inner = text.strip()[2:-1].strip()
        if len(inner) > MOST_CHARACTERS:
            raise tree.problem(f"an expression has {MOST_CHARACTERS} characters at most")
        for index, parameter in enumerate(self.parameters):
            if parameter.name == inner and parameter.is_text():
                return "own text", index
            if parameter.name == inner and parameter.kind == "integer":
                return "own integer", index
        try:
            node = ast.parse(inner, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):  # the last two: nested deeper than Python reads
            raise tree.problem(f'"{shown(inner)}" is no expression') from None
        return self._arithmetic(node, tree)


def value_of(tree, expressions):
    """A value for the parameter server: numbers, texts, lists, maps, and tuples for ${…}."""
    if tree.is_list():
        return [value_of(one, expressions) for one in tree.list()]
    if tree.is_map():
        return {key: value_of(value, expressions) for key, _, value in tree.items()}
    value = tree.scalar()
    if value is None:
        raise tree.problem("a value stands here")
    return expressions.read(value, tree) if isinstance(value, str) and "${" in value else value


def leaves(tree, prefix, expressions):
    """(name, value) of each leaf of a map, as rosparam loads it."""
    found = []
    for key, _, value in tree.items():
        name = prefix + key.strip("/")
        found += leaves(value, name + "/", expressions) if value.is_map() else [(name, value_of(value, expressions))]
    return found


class NodeSpec:
    """One of `nodes`, as far as both take it the same way."""

    def __init__(self, tree, expressions):
        values = tree.map(NODE_KEYS)
        if "name" not in values:
            raise tree.problem("a node has a name")
        self.values, self.place = values, values["name"]
        self.name = values["name"].text()
        if not re.fullmatch(r"[A-Za-z]\w*", self.name):
            raise values["name"].problem(f'"{self.name}" is no name of a node')
        self.space = "/" + values["namespace"].text().strip("/") if "namespace" in values else "/"
        self.remappings = []
        for key, key_place, value in values["remap"].items() if "remap" in values else []:
            self.remappings.append((key, value.text()))
            for one in (key, value.text()):
                if not re.fullmatch(r"[~/A-Za-z][\w/]*", one):
                    raise key_place.problem(f'"{one}" is no name in ROS')
        self.arguments = [one.text() for one in values["args"].list()] if "args" in values else []
        self.full_name = f"{self.space if self.space != '/' else ''}/{self.name}"
        self.parameters = leaves(values["params"], self.full_name + "/", expressions) if "params" in values else []


def _length(values, key, preset):
    """Metres, where inf and nan are words too."""
    if key not in values:
        return preset
    value = values[key].scalar()
    if isinstance(value, str) and value in ("inf", "nan"):
        value = float(value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise values[key].problem("a number of metres, inf or nan stands here")
    return float(value)


def _cloud(values, found):
    """The keys of a cloud alone; `lidar` is None where it is made of a depth image."""
    found["lidar"] = values["lidar"].integer(0, 2**31 - 1) if "lidar" in values else None
    of = "camera" if found["lidar"] is None else "lidar"
    for key, wanted in CLOUD_KEYS.items():
        if key in values and wanted != of:
            raise values[key].problem(
                f"{key} is of a lidar's cloud: lidar: N says of which one"
                if wanted == "lidar"
                else f"{key} is of a depth image's cloud, and this one is a lidar's"
            )
    found["stride_px"] = values["stride_px"].integer(1, 1000) if "stride_px" in values else 1
    found["points_in"] = values["points_in"].word(POINTS_IN) if "points_in" in values else POINTS_IN[0]
    if of == "lidar":
        found["sees"] = "points"
        if "frame" not in values:
            found["frame"] = found["points_in"]


def _fields(tree, prefix, expressions):
    """(path of a message's field, value, line of the file) of each leaf."""
    found = []
    for key, place, value in tree.items():
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", key):
            raise place.problem(f'"{shown(key)}" is no name of a field')
        if value.is_map():
            found += _fields(value, f"{prefix}{key}.", expressions)
        else:
            found.append((prefix + key, value_of(value, expressions), place.node.start_mark.line + 1))
    return found


def _message(values, found, expressions):
    """The keys of a message of any type."""
    if "type" not in values:
        raise found["place"].problem("a message has a type")
    found["type"] = values["type"].text()
    if not TYPE.fullmatch(found["type"]):
        raise values["type"].problem(f'"{found["type"]}" is no type of a message, as geometry_msgs/Twist')
    found["fields"] = _fields(values["fields"], "", expressions) if "fields" in values else []
    found["when"] = values["when"].word(["goal", "start"]) if "when" in values else "goal"
    found["every_s"] = float(values["every_s"].number(1e-3, 1e6)) if "every_s" in values else 0.0
    if found["when"] == "goal":
        found["sees"] = "goals"


def published(kind, tree, expressions):
    """One topic of `publish`: its keys by name, presets for those that are not there; `place` is the topic's."""
    values = tree.map(["topic", "frame", *PUBLISH[kind][0]])
    if "topic" not in values:
        raise tree.problem(f"{kind} has a topic")
    found = {
        "kind": kind,
        "sees": PUBLISH[kind][1],
        "topic": values["topic"].text(),
        "place": values["topic"],
        "frame": values["frame"].text() if "frame" in values else FRAMES.get(kind, "world"),
        "camera": values["camera"].integer(0) if "camera" in values else 0,
        "info": values["info"].text() if "info" in values else "",
        "all_states": "all_states" in values and values["all_states"].truth(),
    }
    if kind == "tf":
        found["child_frame"] = values["child_frame"].text() if "child_frame" in values else "base_link"
        found["camera_frame"] = values["camera_frame"].text() if "camera_frame" in values else ""
    if kind == "odometry":
        found["child_frame"] = values["child_frame"].text() if "child_frame" in values else "body"
        found["in_body"] = "velocity" in values and values["velocity"].word(["world", "body"]) == "body"
    elif kind == "camera_pose":
        found["type"] = values["type"].word(POSE_TYPES) if "type" in values else POSE_TYPES[0]
    elif kind == "depth":
        found["in_mm"] = "encoding" in values and values["encoding"].word(["32FC1", "16UC1"]) == "16UC1"
        found["no_return_m"] = _length(values, "no_return_m", 0.0 if found["in_mm"] else float("inf"))
        found["invalid_m"] = _length(values, "invalid_m", 0.0 if found["in_mm"] else float("nan"))
    elif kind == "cloud":
        _cloud(values, found)
    elif kind == "goal":
        found["type"] = values["type"].word(GOAL_TYPES) if "type" in values else GOAL_TYPES[0]
        found["repeat_s"] = float(values["repeat_s"].number(0)) if "repeat_s" in values else 0.0
    elif kind == "message":
        _message(values, found, expressions)
    return found


def all_published(tree, expressions):
    """All topics of `publish`, in the file's order."""
    found = []
    for kind, place, value in tree.items():
        if kind not in PUBLISH:
            raise place.problem(f'"{kind}" is none of {", ".join(PUBLISH)}')
        found += [published(kind, one, expressions) for one in value.list()]
    return found


def seen_of(topics):
    """What a planner sees of which these topics are published, as avoidbench.Planner names it."""
    states = ["states"] if any(one["all_states"] for one in topics) else []
    return tuple(dict.fromkeys(["state", *(one["sees"] for one in topics), *states]))


def world_of(tree, expressions):
    """`world`: numbers of where the nodes' own world lies in avoidbench's: x_m, y_m, z_m, yaw_rad; 0 where left out."""
    keys = ["x_m", "y_m", "z_m", "yaw_rad"]
    values = tree.map(keys)
    found = []
    for key in keys:
        value = value_of(values[key], expressions) if key in values else 0.0
        is_text = isinstance(value, tuple) and value[0] == "own text"
        if isinstance(value, bool) or not isinstance(value, (int, float, tuple)) or is_text:
            raise values[key].problem(f"{key} is a number, or ${{…}} of numbers")
        found.append(value)
    return found


class CommandSpec:
    """`command`: where it comes out and what it becomes."""

    def __init__(self, tree):
        values = tree.map(["topic", "type", "form", "frame", "hover_thrust", "stale_s"])
        for key in ("topic", "type"):
            if key not in values:
                raise tree.problem(f"command has a {key}")
        self.values = values
        self.topic, self.type = values["topic"].text(), values["type"].text()
        if not TYPE.fullmatch(self.type):
            raise values["type"].problem(f'"{self.type}" is no type of a message, as geometry_msgs/Twist')
        self.form = values["form"].word(list(COMMANDS)) if "form" in values else self.type.split("/")[1]
        if self.form not in COMMANDS:
            raise values["type"].problem(
                f"{self.form} is none of {', '.join(COMMANDS)}; form: says whose members it has"
            )
        self.kinds = COMMANDS[self.form]
        self.in_body = "frame" in values and values["frame"].word(["world", "body"]) == "body"
        self.hover_thrust = float(values["hover_thrust"].number(1e-6, 1e6)) if "hover_thrust" in values else 0.0
        if self.form == "AttitudeTarget" and not self.hover_thrust:
            raise tree.problem("an AttitudeTarget needs hover_thrust: the thrust at which the vehicle hovers")
        self.stale_s = float(values["stale_s"].number(1e-3, 1e6)) if "stale_s" in values else 0.5
