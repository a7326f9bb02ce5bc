"""What a trial gives in the place of a launch file's numbers, and which topic is which: guesses by the usual names and
types, each of which is marked as one in the topics file."""

import re

MARGIN_M = 2  # around the map's box

# (last part of a parameter's name, what stands for it); the numbers of the launch file are for another camera or map.
CAMERA = [
    (r"(cam(era)?_)?(fx|fy|cx|cy)", lambda name: f"${{{name[-2:]}_px}}"),
    (r"(cam(era)?|im(a)?ge?|depth)_?(width|cols?)|cols|resolution_x", lambda _: "${width_px}"),
    (r"(cam(era)?|im(a)?ge?|depth)_?(height|rows?)|rows|resolution_y", lambda _: "${height_px}"),
]
LIMITS = [
    (
        r"(max_?vel(ocity)?|vel(ocity)?_?(limit|max)|limit_?vel|max_?speed|v_?max|max_v)",
        "max_speed_mps",
        "m/s",
        0.1,
        20,
        "Speed limit.",
    ),
    (
        r"(max_?acc(eleration)?|acc(eleration)?_?(limit|max)|limit_?acc|a_?max|max_a)",
        "max_acceleration_mps2",
        "m/s^2",
        0.1,
        50,
        "Greatest acceleration.",
    ),
    (
        r"((obstacles?_)?inflation(_radius|_size)?|inflate_radius)",
        "inflation_m",
        "m",
        0,
        2,
        "How far obstacles are grown.",
    ),
]
START = re.compile(r"(start|init(ial)?)_(x|y|z|yaw)")
TRIGGER = re.compile(r"trigger|start|arm|enable|takeoff|take_off")
GOAL = re.compile(r"goal|target|waypoint|way_point|destination")
LIDAR = re.compile(r"lidar|livox|velodyne|ouster|scan|laser")
WHOLE_MAP = re.compile(r"global|all_map|map_?cloud|pcd")
CAMERA_NAME = re.compile(r"cam|sensor|depth|pose|render")
GOAL_TYPES = {"geometry_msgs/PoseStamped", "geometry_msgs/PointStamped", "nav_msgs/Path", "geometry_msgs/Pose"}
XYZ = ["${goal_x_m}", "${goal_y_m}", "${goal_z_m}"]


class Parameters:
    """Those that the planner declares to avoidbench, with the launch file's numbers as defaults."""

    def __init__(self):
        self.declared = {}  # name -> (unit, default, lowest, highest, doc)

    def guess(self, name, value, beside):
        """What stands for the launch file's value, or None where it stays. `beside`: all parameters of the node."""
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return None
        last = name.rpartition("/")[2].lower().strip("_")
        space = name.rpartition("/")[0]
        spaced = {one.rpartition("/")[2].lower().strip("_") for one in beside if one.rpartition("/")[0] == space}
        for pattern, own, unit, lowest, highest, doc in LIMITS:
            if re.fullmatch(pattern, last):
                return self._declared(own, unit, value, lowest, highest, doc)
        if {"fx", "fy"} <= {one[-2:] for one in spaced}:
            for pattern, given in CAMERA:
                if re.fullmatch(pattern, last):
                    return given(last)
        start = START.fullmatch(last)
        if start:
            return "${start_yaw_rad}" if start[3] == "yaw" else f"${{start_{start[3]}_m}}"
        return _box(last, value, spaced)

    def _declared(self, own, unit, value, lowest, highest, doc):
        first = self.declared.setdefault(own, (unit, value, min(lowest, value), max(highest, value), doc))
        return f"${{{own}}}" if first[1] == value else f"${{{_number(value / first[1])} * {own}}}" if first[1] else None


def _number(value):
    return f"{value:.6g}"


def _box(last, value, spaced):
    """The map's box, of which the launch file's is of another map; heights stay."""
    axis = re.fullmatch(r"(map_?)?size_?([xy])|([xy])_?size|map_([xy])(_size)?", last)
    if axis and value > 0:
        name = next(one for one in axis.groups() if one in ("x", "y"))
        if any(one.startswith("origin") for one in spaced):
            return f"${{highest_{name}_m - lowest_{name}_m + {2 * MARGIN_M}}}"
        # Without an origin it is the middle of the box.
        return f"${{2 * max(abs(lowest_{name}_m), abs(highest_{name}_m)) + {2 * MARGIN_M}}}"
    origin = re.fullmatch(r"(map_?)?origin_?([xy])", last)
    return f"${{lowest_{origin[2]}_m - {MARGIN_M}}}" if origin else None


class Input:
    """One entry of `publish`. `question`: what the user must say; one that `is_left` stands there as a comment."""

    def __init__(self, kind, topic, keys=None, question="", is_left=False):
        self.kind, self.topic, self.keys = kind, topic, keys or {}
        self.question, self.is_left = question, is_left


def _image(topic, text):
    if re.search("left|right", topic.name):
        return Input("left" if "left" in topic.name else "right", topic)
    if re.search("rgb|colou?r", topic.name) and "depth" not in topic.name:
        return Input("color", topic)
    question = "" if "depth" in topic.name else f"is {topic.name} the depth image?"
    return Input("depth", topic, {"encoding": "16UC1"} if "16UC1" in text else {}, question)


def _cloud(topic, has_depth):
    if WHOLE_MAP.search(topic.name):
        return Input("cloud", topic, {}, f"{topic.name} looks like the whole map, which a planner must not know", True)
    if LIDAR.search(topic.name):
        return Input("cloud", topic, {"lidar": 0}, f"are the points of {topic.name} in the world? (points_in)")
    if has_depth:
        return Input("cloud", topic, {}, "", True)  # the same again
    return Input("cloud", topic, {}, f"is {topic.name} of a depth camera? Of a lidar: lidar: 0")


def _fields_of(message):
    """Values of a message's fields that look like a goal's, or None: `message` is (type, name) of each field."""
    by_name = {name.lower(): (kind, name) for kind, name in message}
    for low, (kind, name) in by_name.items():
        if not (GOAL.search(low) or low in ("position", "point", "pose")):
            continue
        if re.fullmatch(r"float(32|64)\[3?\]", kind):
            return {name: XYZ}
        if kind in ("geometry_msgs/Point", "geometry_msgs/Vector3"):
            return {name: dict(zip("xyz", XYZ, strict=True))}
        if kind == "geometry_msgs/Pose":
            return {name: {"position": dict(zip("xyz", XYZ, strict=True))}}
        if kind == "geometry_msgs/PoseStamped":
            return {name: {"pose": {"position": dict(zip("xyz", XYZ, strict=True))}}}
    if {"x", "y", "z"} <= set(by_name):
        return {by_name[one][1]: value for one, value in zip("xyz", XYZ, strict=True)}
    return None


def _message(topic, fields_of_type):
    low = topic.name.lower()
    if topic.kind in ("std_msgs/Empty", "std_msgs/Bool") and TRIGGER.search(low):
        return Input(
            "message", topic, {"type": topic.kind, **({"fields": {"data": True}} if topic.last() == "Bool" else {})}
        )
    if GOAL.search(low) or GOAL.search(topic.last().lower()):
        fields = _fields_of(fields_of_type(topic.kind))
        question = "" if fields else f"which fields of {topic.kind} on {topic.name} are the goal?"
        return Input("message", topic, {"type": topic.kind, "fields": fields or {}}, question)
    return Input("message", topic, {"type": topic.kind}, f"does it need {topic.name} ({topic.kind})?", True)


def input_of(topic, all_topics, text, fields_of_type):
    """What avoidbench publishes for a topic that a node hears. `text`: the node's sources; `fields_of_type`: a
    message's fields as (type, name)."""
    low, kind = topic.name.lower(), topic.kind
    has_depth = any(one.kind == "sensor_msgs/Image" and "depth" in one.name for one in all_topics)
    if kind is None:
        return Input("message", topic, {}, f"what is {topic.name}? Its type is not seen in {topic.place}", True)
    if kind == "nav_msgs/Odometry":
        if "extrinsic" in low:
            return Input("camera_pose", topic, {"type": kind}, f"{topic.name}: the camera's pose on the vehicle?", True)
        is_camera = re.search("cam|sensor", low) is not None
        return (
            Input("camera_pose", topic, {"type": kind})
            if is_camera
            else Input("odometry", topic, {"velocity": "world"})
        )
    if kind == "sensor_msgs/Image":
        return _image(topic, text)
    if kind == "sensor_msgs/PointCloud2":
        return _cloud(topic, has_depth)
    if kind == "sensor_msgs/Imu":
        return Input("imu", topic)
    if kind in GOAL_TYPES and TRIGGER.search(low):
        return Input("message", topic, {"type": kind})
    if kind in GOAL_TYPES and (kind == "nav_msgs/Path" or GOAL.search(low)):
        question = "" if GOAL.search(low) else f"is {topic.name} ({kind}) the goal?"
        return Input("goal", topic, {"type": kind}, question)
    if kind in ("geometry_msgs/PoseStamped", "geometry_msgs/TransformStamped"):
        if kind.endswith("TransformStamped") or (has_depth and CAMERA_NAME.search(low)):
            return Input("camera_pose", topic, {"type": kind})
        return Input("pose", topic, {}, f"is {topic.name} the vehicle's pose?")
    if kind == "geometry_msgs/TwistStamped":
        return Input("twist", topic)
    if kind == "sensor_msgs/CameraInfo":
        return Input("info", topic)
    return _message(topic, fields_of_type)
