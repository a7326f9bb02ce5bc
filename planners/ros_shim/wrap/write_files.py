"""The two files that avoidbench_ros_planner() needs, as text: CMakeLists.txt and topics.yaml."""

import json
import re

# Included file -> (word of NEEDS, what to know of it).
LIBRARIES = [
    (r"opencv2/|cv_bridge/", "opencv", ""),
    (
        r"nlopt\.hpp",
        "nlopt_cxx",
        "a time limit of NLopt repeats only where it is linked statically: NEEDS /path/libnlopt.a",
    ),
    (r"armadillo", "armadillo", ""),
    (r"ompl/", "ompl", "OMPL seeds and stops by clocks of its own unless it is linked statically"),
    (r"yaml-cpp/", "yaml-cpp", ""),
    (r"fmt/", "fmt", ""),
    (r"glog/", "glog", ""),
    (r"ceres/", "ceres", ""),
    (r"osqp", "osqp", ""),
    (r"octomap/", "octomap", ""),
    (r"casadi/", "casadi", ""),
    (r"boost/filesystem", "boost_filesystem", ""),
    (r"boost/thread", "boost_thread", "threads do not repeat"),
    (r"gurobi_c", "gurobi_c++", "Gurobi is not free software: is it installed?"),
    (r"cuda_runtime", "cudart", "sources in CUDA are not compiled: give what nvcc makes of them"),
    (r"omp\.h", "gomp", "OpenMP's loops have an order of their own: `planners check` tells whether flights repeat"),
]
STAND_INS = re.compile(r"pcl/(point_types|point_cloud|common/projection_matrix)\.h")
PLAIN = re.compile(r"[A-Za-z_/~.][\w/~. -]*")


def scalar(value):
    """A value of YAML in one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        text = repr(value)
        return text if re.search(r"[.n]", text) else text.replace("e", ".0e")
    if isinstance(value, int):
        return str(value)
    if isinstance(value, list):
        return "[" + ", ".join(map(scalar, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {scalar(one)}" for key, one in value.items()) + "}"
    words = ("true", "false", "yes", "no", "on", "off", "null", "y", "n", "~")
    return (
        value if PLAIN.fullmatch(value) and value.lower() not in words and value == value.strip() else json.dumps(value)
    )


def _param_lines(params, indent, guess):
    """Parameters by the parts of their names; what is guessed says what the launch file has."""
    tree = {}
    for name, value in params.items():
        at = tree
        *spaces, last = [one for one in name.split("/") if one]
        for one in spaces:
            at = at.setdefault(one, {}) if isinstance(at.get(one, {}), dict) else at
        at[last] = (name, value)
    lines = []

    def write(branch, depth):
        for key, one in branch.items():
            if isinstance(one, dict):
                lines.append(f"{' ' * depth}{key}:")
                write(one, depth + 2)
                continue
            name, value = one
            guessed = guess(name, value)
            if guessed:
                lines.append(f'{" " * depth}{key}: "{guessed}"  # guess: {scalar(value)} in the launch file')
            else:
                lines.append(f"{' ' * depth}{key}: {scalar(value)}")

    write(tree, indent)
    return lines


def _node_lines(node, main, guess):
    lines = [f"  - name: {node.name}"]
    if main != node.name:
        lines.append(f"    main: {main}")
    if node.namespace != "/":
        lines.append(f"    namespace: {node.namespace}")
    if node.arguments:
        lines.append(f"    args: {scalar(node.arguments)}")
    if node.remappings:
        lines.append("    remap:")
        lines += [f"      {name}: {to}" for name, to in node.remappings.items()]
    if node.params:
        lines += ["    params:", *_param_lines(node.params, 6, lambda name, value: guess(name, value, node.params))]
    return lines


def _publish_lines(inputs):
    kinds = {}
    for one in inputs:
        kinds.setdefault(one.kind, []).append(one)
    lines = []
    for kind, each in kinds.items():
        live = [one for one in each if not one.is_left]
        if len(live) > 1:
            lines.append(f"  {kind}:")
        for one in live:
            text = scalar({"topic": one.topic.name, **one.keys})
            mark = f"  # ? {one.question}" if one.question else ""
            lines.append(f"    - {text}{mark}" if len(live) > 1 else f"  {kind}: {text}{mark}")
        for one in each:
            if one.is_left:
                mark = f" ? {one.question}" if one.question else " heard, too, and left out"
                lines.append(f"  # {kind}: {scalar({'topic': one.topic.name, **one.keys})}  #{mark}")
    return lines


def topics_text(found):
    """topics.yaml of what wrap.py found."""
    parameters = found.parameters
    nodes = []
    for node, main in found.mains.items():
        nodes += _node_lines(node, main, parameters.guess)
    lines = [
        f"# From {found.launch_name}. `guess:` marks what avoidbench guessed, `?` what you have to say.",
        "# What each key means: docs/ros.md, `The topics file`.",
        'version: "1.0"',
        f"summary: {scalar(found.summary)}",
    ]
    if parameters.declared:
        lines += ["", "parameters:"]
        for name, (unit, default, lowest, highest, doc) in parameters.declared.items():
            keys = {"name": name, "unit": unit, "default": default, "lowest": lowest, "highest": highest, "doc": doc}
            lines.append(f"  - {scalar(keys)}")
    lines += [
        "",
        "# Does it take for granted that goals are at 1 m and flights start along +x? see docs/ros.md.",
        '# world: {z_m: "${goal_z_m - 1}", yaw_rad: "${start_yaw_rad}"}',
    ]
    lines += ["nodes:", *nodes]
    if found.params:
        lines += ["", "params:"]
        lines += [f"  {name}: {scalar(value)}" for name, value in found.params.items()]
    lines += ["", "publish:", *_publish_lines(found.inputs), "", "command:"]
    if found.command is None:
        lines += ["  topic: /position_cmd  # ? at which topic do commands come out, and of which type?"]
        lines += ["  type: quadrotor_msgs/PositionCommand"]
    else:
        lines += [f"  topic: {found.command.name}", f"  type: {found.command.kind}"]
        if found.command.last() == "PositionCommand" and not found.command.kind.startswith("quadrotor_msgs/"):
            lines.append("  form: PositionCommand")
    return "\n".join(lines) + "\n"


def needs_of(includes):
    """(words of NEEDS, what to know of them) for these included files."""
    words, notes = [], []
    for pattern, word, note in LIBRARIES:
        if any(re.match(pattern, one) for one in includes):
            words.append(word)
            if note:
                notes.append(f"NEEDS {word}: {note}")
    if any(one.startswith("pcl/") and not STAND_INS.match(one) for one in includes):
        words.append("pcl")
    return words, notes


def cmake_text(found):
    """CMakeLists.txt of what wrap.py found; files of the workspace by their place below it."""

    def path(file):
        inside = file.relative_to(found.workspace) if file.is_relative_to(found.workspace) else file
        return f"${{workspace}}/{inside}" if inside is not file and str(inside) != "." else str(file)

    def block(word, values):
        if not values:
            return []
        one = f"  {word} {' '.join(values)}"
        return [one] if len(one) <= 100 else [f"  {word}", *(f"    {value}" for value in values)]

    lines = [
        "cmake_minimum_required(VERSION 3.22)",
        f"project({found.name} LANGUAGES C CXX)",
        "if(NOT CMAKE_BUILD_TYPE)",
        "  set(CMAKE_BUILD_TYPE Release)",
        "endif()",
        f"set(workspace {found.workspace})",
        "",
        "find_package(avoidbench REQUIRED)",
        f"avoidbench_ros_planner({found.name}",
        *block("SOURCES", [path(one) for one in found.sources]),
        "  TOPICS topics.yaml",
        *block("MESSAGES", [path(one) for one in found.messages]),
        *block("INCLUDE", [path(one) for one in found.includes]),
        *block("NEEDS", found.needs),
        *block("DEFINITIONS", found.definitions),
    ]
    if found.standard:
        lines.append(f"  STANDARD {found.standard}")
    lines[-1] += ")"
    return "\n".join(lines) + "\n"
