#!/usr/bin/env python3
"""Flies real ROS 1 nodes, as processes beside a real master: docs/ros.md, "Live: real nodes".

    ros_bridge.py TOPICS.yaml      by hand: checks the file and says what it would do

In a sweep: {plugin: process, parameters: {command: [path/to/ros_bridge.py, topics.yaml]}}"""

import importlib.util
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
NEEDED = {
    "rospy": "python3-rospy",
    "rosmaster": "python3-rosmaster",
    "yaml": "python3-yaml",
    "numpy": "python3-numpy",
    "nav_msgs": "python3-nav-msgs",
    "sensor_msgs": "python3-sensor-msgs",
    "trajectory_msgs": "python3-trajectory-msgs",
}
SYSTEM_PYTHON = "/usr/bin/python3"
NODE_ENDED = 70
MARK = "AVOIDBENCH_ROS_PYTHON_TRIED"


def missing_modules():
    return [package for name, package in NEEDED.items() if importlib.util.find_spec(name) is None]


def take_python_of_ros():
    """ROS's packages belong to one Python, which need not be the first one on the PATH: that of the system is asked,
    too."""
    missing = missing_modules() + (["Python 3.10"] if sys.version_info < (3, 10) else [])
    if not missing:
        return
    if MARK not in os.environ and os.access(SYSTEM_PYTHON, os.X_OK) and not sys.executable.startswith(SYSTEM_PYTHON):
        os.environ[MARK] = "1"
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
    sys.exit(
        f"ros_bridge.py: {sys.executable} lacks {', '.join(missing)}: scripts/install_packages.sh ros_live installs "
        f"all that it needs"
    )


def end_with(text):
    """The program's end is the trial's: planner_crashed, with the last lines."""
    print(text, file=sys.stderr, flush=True)
    os._exit(NODE_ENDED)


def planner_class(file):
    """A subclass of avoidbench.Planner for a LiveFile. ROS itself is imported with the first trial: to describe a
    planner needs none."""
    from avoidbench.planner import Parameter, Planner

    def declared(one):
        if one.is_text():
            return Parameter(one.name, one.preset_text, one.doc, one.unit, choices=tuple(one.choices or ()))
        preset = int(one.preset) if one.kind == "integer" else float(one.preset)
        return Parameter(one.name, preset, one.doc, one.unit, lowest=float(one.lowest), highest=float(one.highest))

    class Bridge(Planner):
        name = file.live.name
        version = file.version
        summary = f"{file.summary} [live ROS nodes: flights are measured and do not repeat]"
        inputs = file.inputs
        commands = file.command.kinds
        parameters = tuple(declared(one) for one in file.parameters)
        files = (
            *sorted(
                str(one)
                for folder in (HERE, HERE.parent / "ros_shim")
                for one in folder.glob("*.py")
                if not one.name.startswith("make_")
            ),
            str(HERE / "console.conf"),
            *file.decisive_files(),
        )
        uses = ("processes", "network", "globals") if file.live.each_trial else ("processes", "network")

        def reset(self, mission):
            from ros_flight import RosFlight
            from ros_processes import NodeEnded

            for note in file.notes:
                print(note, flush=True)
            try:
                if Bridge.flight is None:
                    Bridge.flight = RosFlight(file, self.setup)
                Bridge.flight.begin(mission)
            except NodeEnded as problem:
                end_with(problem)
            except Exception as problem:
                if file.live.each_trial:
                    raise
                end_with(problem)  # half a start is no place for the next trial

        def plan(self, observation):
            from ros_processes import NodeEnded

            try:
                return Bridge.flight.plan(observation)
            except NodeEnded as problem:
                end_with(problem)

    Bridge.flight = None
    return Bridge


def tell(file):
    """What a run by hand says."""
    live = file.live
    print(
        f"{file.path.name}: planner {live.name}, inputs {', '.join(file.inputs)}, "
        f"commands {', '.join(file.command.kinds)}"
    )
    for node in file.nodes:
        print(
            f"  starts {' '.join(node.words)}"
            if node.words
            else f"  {node.full_name}: parameters alone; run: says how to start it"
        )
    if live.launch:
        print(f"  starts the nodes of {' '.join(live.launch)}")
    if not live.has_own_master:
        print(f"  takes the nodes of the master at {os.environ.get('ROS_MASTER_URI', 'http://localhost:11311')}")
    for one in file.published:
        print(f"  publishes {one['kind']} on {one['topic']}")
    print(f"  takes {file.command.type} from {file.command.topic}")
    for name in file.decisive_files():
        print(f"  depends on {name}")
    for note in file.notes:
        print(note, file=sys.stderr)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    take_python_of_ros()
    sys.path.insert(0, str(HERE))
    from live_file import LiveFile, Problem

    try:
        file = LiveFile(sys.argv[1])
    except Problem as problem:
        sys.exit(str(problem))
    if "AVOIDBENCH_PLANNER_FDS" not in os.environ:
        tell(file)
        return
    import avoidbench

    planner = planner_class(file)
    avoidbench.serve(planner, is_script_file=False)  # but the topics file
    if planner.flight is not None:
        planner.flight.end()
    os._exit(0)  # with the threads of rospy


if __name__ == "__main__":
    main()
