"""Reads a topics file (docs/ros.md) for real nodes: what planners/ros_shim reads of it, and `live`."""

import math
import os
import pathlib
import re
import shlex
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "ros_shim"))
import topics_file  # noqa: E402
import topics_spec  # noqa: E402
from topics_file import Problem  # noqa: E402, F401

LIVE_KEYS = [
    "name",
    "launch",
    "files",
    "master",
    "restart",
    "clock_step_s",
    "clock_rate",
    "answer_wait_s",
    "start_wait_s",
    "wait_for",
]


def words_of(tree):
    """A command: a list of words, or one text that is cut as a shell cuts it."""
    try:
        words = [str(one.scalar()) for one in tree.list()] if tree.is_list() else shlex.split(tree.text())
    except ValueError as error:
        raise tree.problem(f"this is no command: {error}") from None
    if not words:
        raise tree.problem("a command stands here, as [./node, _rate:=10]")
    return words


class Live:
    """`live`: how real nodes are run."""

    def __init__(self, tree, file):
        values = tree.map(LIVE_KEYS) if tree is not None else {}

        def number(key, preset, low, high):
            return float(values[key].number(low, high)) if key in values else preset

        name_place = values.get("name")
        self.name = name_place.text() if name_place else re.sub(r"[^a-z0-9_]", "_", file.stem.lower())
        if not re.fullmatch(r"[a-z0-9_]+", self.name):
            raise name_place.problem(f'"{self.name}" is no name of a planner: small letters, digits and _')
        self.launch = words_of(values["launch"]) if "launch" in values else []
        self.launch_place = values.get("launch")
        self.files = [one.text() for one in values["files"].list()] if "files" in values else []
        self.has_own_master = "master" not in values or values["master"].word(["own", "running"]) == "own"
        # Nodes of somebody else are not started at all.
        self.each_trial = self.has_own_master and (
            "restart" not in values or values["restart"].word(["trial", "never"]) == "trial"
        )
        self.clock_step_s = number("clock_step_s", 0.01, 1e-3, 1.0)
        self.clock_rate = number("clock_rate", 1.0, 0.0, 1000.0)
        self.answer_wait_s = number("answer_wait_s", 0.1, 0.0, 60.0)
        self.start_wait_s = number("start_wait_s", 8.0, 0.1, 600.0)
        self.wait_for = [one.text() for one in values["wait_for"].list()] if "wait_for" in values else None
        if not self.has_own_master and self.launch:
            raise values["launch"].problem(
                "with master: running somebody else starts the nodes: launch is for an own one"
            )


class Node(topics_spec.NodeSpec):
    """One of `nodes`; `words` start it, where it has a `run`."""

    def __init__(self, tree, expressions):
        super().__init__(tree, expressions)
        self.words = []
        if "run" in self.values:
            remaps = [f"{a}:={b}" for a, b in self.remappings]
            space = [] if self.space == "/" else [f"__ns:={self.space}"]
            self.words = [*words_of(self.values["run"]), *self.arguments, *remaps, f"__name:={self.name}", *space]


class LiveFile:
    """All of a topics file. Raises Problem with file, line and column."""

    def __init__(self, path):
        self.path = pathlib.Path(path).absolute()
        self.folder = self.path.parent
        tree = topics_file.read(pathlib.Path(path))
        values = tree.map(topics_spec.KEYS)
        for key in ("publish", "command"):
            if key not in values:
                raise tree.problem(f"a topics file has {key}")
        self.live = Live(values.get("live"), self.path)
        self.version = values["version"].text() if "version" in values else "1.0"
        self.summary = values["summary"].text() if "summary" in values else "ROS 1 nodes as they are."
        self.lead_s = float(values["lead_s"].number(0, 600)) if "lead_s" in values else 2.0
        self.parameters = (
            [topics_spec.Parameter(one) for one in values["parameters"].list()] if "parameters" in values else []
        )
        expressions = topics_spec.Expressions(self.parameters)
        self.nodes = [Node(one, expressions) for one in values["nodes"].list()] if "nodes" in values else []
        self.leaves = topics_spec.leaves(values["params"], "/", expressions) if "params" in values else []
        for node in self.nodes:
            self.leaves += node.parameters
        self.published = topics_spec.all_published(values["publish"], expressions)
        for one in self.published:
            if one["kind"] in ("tf", "message"):
                raise one["place"].problem(f"{one['kind']} is for ros_shim alone: start a node that publishes it")
        if "world" in values:
            raise values["world"].problem("world is for ros_shim alone: here nodes live in avoidbench's world")
        self.command = topics_spec.CommandSpec(values["command"])
        self.notes = []
        self._check_nodes(tree)
        self._note(values)

    def _check_nodes(self, tree):
        running = [node for node in self.nodes if node.words]
        if running and not self.live.has_own_master:
            raise (
                running[0]
                .values["run"]
                .problem("with master: running somebody else starts the nodes: run is for an own one")
            )
        if self.live.has_own_master and not running and not self.live.launch:
            raise tree.problem(
                "nothing starts a node here: a node's run, live: {launch: …}, or live: {master: running}"
            )
        for node in running:
            if "/" in node.words[0] and not os.access(self.folder / node.words[0], os.X_OK):
                raise node.values["run"].problem(
                    f"there is no program {self.folder / node.words[0]} that may be executed"
                )
            if "/" not in node.words[0] and shutil.which(node.words[0]) is None:
                raise node.values["run"].problem(f"there is no program {node.words[0]} on the PATH")

    def _note(self, values):
        """What is for the shim alone, or can't be had with real nodes: passed over, and told."""
        places = [(node.values["main"], "main") for node in self.nodes if "main" in node.values]
        places += [(values[key], key) for key in ("packages", "compute_clock_us") if key in values]
        self.notes += [str(place.problem(f"{what} is for ros_shim alone")) for place, what in places]

    @property
    def inputs(self):
        return topics_spec.seen_of(self.published)

    def decisive_files(self):
        """What decides how the nodes fly, beside the topics file: files that commands name, and `files`, relative to
        its folder."""
        found = list(self.live.files)
        words = [word for node in self.nodes for word in node.words] + self.live.launch[:1]
        found += [word for word in words if "/" in word or "." in word]
        return list(
            dict.fromkeys(
                os.path.normpath(one) for one in found if one in self.live.files or (self.folder / one).is_file()
            )
        )

    def topics_to_wait_for(self):
        """(topics that somebody must hear, topics that somebody must say)."""
        said = [self.command.topic]
        if self.live.wait_for is None:
            return [one["topic"] for one in self.published], said
        return [topic for topic in self.live.wait_for if topic not in said], [
            topic for topic in said if topic in self.live.wait_for
        ]


def whole(function):
    """The same of inf and NaN, as in C++."""
    return lambda a: function(a) if math.isfinite(a) else a


FUNCTIONS = {
    "min": min,
    "max": max,
    "abs": abs,
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b if b else math.copysign(math.inf, a) if a else math.nan,
    "negative": lambda a: -a,
    "floor": whole(math.floor),
    "ceil": whole(math.ceil),
    "round": whole(lambda a: math.copysign(math.floor(abs(a) + 0.5), a)),
}


def evaluated(value, given, own):
    """A value of topics_spec.value_of() with what a trial gives."""
    if isinstance(value, list):
        return [evaluated(one, given, own) for one in value]
    if isinstance(value, dict):
        return {key: evaluated(one, given, own) for key, one in value.items()}
    if not isinstance(value, tuple):
        return value
    what, *rest = value
    if what == "number":
        return rest[0]
    if what == "given":
        return float(given[rest[0]])
    if what.startswith("own"):
        return own[rest[0]] if what != "own" else float(own[rest[0]])
    return float(FUNCTIONS[what](*(evaluated(one, given, own) for one in rest)))


def given_by(setup, mission):
    """What ${…} may name, by name: numbers of the planner's setup and of its mission."""
    given = {name: 0.0 for name in topics_spec.GIVEN}
    given.update(
        vehicle_max_speed_mps=setup.max_speed_mps,
        vehicle_max_acceleration_mps2=setup.max_acceleration_mps2,
        vehicle_max_yaw_rate_radps=setup.max_yaw_rate_radps,
        gravity_mps2=setup.gravity_mps2,
        plan_period_s=setup.plan_period_s,
        body_radius_m=setup.body_radius_m,
        start_yaw_rad=mission.start_yaw_rad,
        goal_radius_m=mission.goal_radius_m,
        time_limit_s=mission.time_limit_s,
        command_latency_s=mission.command_latency_s,
        seed=mission.seed % 2**31,
    )  # as a ROS integer
    given.update(zip(("body_length_m", "body_width_m", "body_height_m"), setup.body_size_m))
    for name, vector in (
        ("start", mission.start_world_m),
        ("goal", mission.goal_world_m),
        ("lowest", mission.lowest_world_m),
        ("highest", mission.highest_world_m),
    ):
        given.update({f"{name}_{axis}_m": number for axis, number in zip("xyz", vector)})
    if setup.cameras:
        camera = setup.cameras[0]
        for name in (
            "width_px",
            "height_px",
            "fx_px",
            "fy_px",
            "cx_px",
            "cy_px",
            "min_range_m",
            "max_range_m",
            "baseline_m",
        ):
            given[name] = getattr(camera, name)
        given["camera_rate_hz"] = camera.rate_hz
        given.update({f"camera_{axis}_m": number for axis, number in zip("xyz", camera.position_body_m)})
    if setup.lidars:
        lidar = setup.lidars[0]
        given.update(
            lidar_rate_hz=lidar.rate_hz, lidar_min_range_m=lidar.min_range_m, lidar_max_range_m=lidar.max_range_m
        )
        given.update({f"lidar_{axis}_m": number for axis, number in zip("xyz", lidar.position_body_m)})
    return given
