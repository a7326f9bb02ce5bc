#!/usr/bin/env python3
"""Writes the two files that the ROS shim needs (docs/ros.md) for a launch file of a catkin package: CMakeLists.txt and
topics.yaml, in a folder of the user's. Sources are read, not changed; nothing is built or started. Guesses are marked,
and what can't be told is asked for in one line each."""

import argparse
import pathlib
import re
import sys

import launch_file
import yaml
from guesses import Input, Parameters, input_of
from node_topics import command_of, inputs_of, planning_nodes, topics_of
from workspace import find_packages, has_main, includes_of, needed_packages, program_of, text_of
from write_files import cmake_text, needs_of, topics_text

SHIM = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(1, str(SHIM))
from topics_file import Problem as TopicsProblem  # noqa: E402
from topics_file import Tree  # noqa: E402
from topics_spec import all_published  # noqa: E402


class Found:
    """What is written: of CMakeLists.txt and topics.yaml the contents, and the questions."""

    def __init__(self, name, workspace, launch):
        self.name, self.workspace, self.launch_name = name, workspace, launch.name
        self.summary = f"The nodes of {launch.name}, compiled unchanged."
        self.parameters = Parameters()
        self.mains = {}  # node -> the source that has its main()
        self.left = []  # names of nodes that are not taken, with the reason
        self.params, self.inputs, self.command = {}, [], None
        self.sources, self.messages, self.includes, self.needs, self.definitions = [], [], [], [], []
        self.copies = []  # sources whose text is that of another one, and stands once
        self.standard = 0
        self.questions = []  # of what stands in no line of the topics file


def workspace_of(launch):
    """The folder of a workspace: the `src` that the launch file lies below, or what is above its package."""
    package = next((one for one in launch.parents if (one / "package.xml").exists()), None)
    if package is None:
        raise launch_file.Problem(f"{launch}: no package.xml above it: --workspace FOLDER")
    return next((one for one in package.parents if one.name == "src" or (one / ".git").exists()), package.parent)


def fields_of_type(packages):
    """A function: a message's type -> (type, name) of its fields, of the workspace's messages and the shim's."""
    own = SHIM / "messages"

    def fields(kind):
        package, _, name = kind.partition("/")
        folders = [packages[package].folder] if package in packages else []
        for file in [one / "msg" / f"{name}.msg" for one in [*folders, own / package]]:
            if file.is_file():
                found = re.findall(
                    r"^\s*([\w/]+(?:\[\d*\])?)\s+(\w+)\s*(?:#.*)?$", file.read_text(errors="replace"), re.M
                )
                return [(f"geometry_msgs/{one}" if one == "Point" else one, each) for one, each in found]
        return []

    return fields


def take_nodes(found, launch, packages):
    """Chooses the nodes and what they hear. Throws where no node says a command."""
    topics = {}
    for node in launch.nodes:
        said = topics_of(packages, node)
        if said is None:
            found.left.append(f"{node.name} ({node.package}/{node.program}: no C++ sources here)")
        else:
            topics[node] = said
    found.command = command_of(topics)
    if found.command is None:
        names = ", ".join(one.name for one in topics) or "none"
        raise launch_file.Problem(
            f"no node of {found.launch_name} publishes a command that avoidbench takes (docs/ros.md); "
            f"nodes with sources here: {names}. Is it another launch file, or another --workspace?"
        )
    kept = planning_nodes(topics, found.command)
    found.left += [node.name for node in topics if node not in kept]
    heard = inputs_of(topics, kept)
    for node in kept:
        program = program_of(packages, node)
        main = next((one for one in program.own if has_main(one)), None)
        if main is None:
            raise launch_file.Problem(f"{node.place}: no main() in the sources of {node.package}/{node.program}")
        found.mains[node] = main.stem
        found.questions += [f"{place}: {what}: which topic is it?" for what, place in topics[node].unknown]
    for topic in heard:
        text = "\n".join(text_of(one) for one in program_of(packages, topic.node).files)
        found.inputs.append(input_of(topic, heard, text, fields_of_type(packages)))
    depth = next((one for one in found.inputs if one.kind == "depth"), None)
    for one in [each for each in found.inputs if each.kind == "info"]:
        found.inputs.remove(one)
        if depth:
            depth.keys["info"] = one.topic.name
    if any(topics[node].uses_tf for node in kept):
        odometry = next((one for one in found.inputs if one.kind == "odometry"), found.inputs[0])
        topic = type(odometry.topic)(odometry.topic.node, "/tf", "tf2_msgs/TFMessage", odometry.topic.place)
        found.inputs.append(Input("tf", topic, {}, "which frames does it look up? (frame, child_frame, camera_frame)"))
    others = {f"/{one.name}/" for one in launch.nodes if one not in kept}
    found.params = {
        name: value for name, value in launch.params.items() if not any(name.startswith(one) for one in others)
    }
    if not any(one.kind in ("goal", "message") and not one.is_left for one in found.inputs):
        found.questions.append("topics.yaml: which topic is the goal?")


def take_sources(found, packages):
    """What is compiled, with what."""
    names, files = [], []
    for node in found.mains:
        program = program_of(packages, node)
        found.sources += [one for one in program.sources if one not in found.sources]
        files += [one for one in program.files if one not in files]
        names += [one for one in needed_packages(packages, node.package) if one not in names]
    found.sources, found.copies = without_copies(found.sources)
    for name in names:
        package = packages[name]
        found.includes += [one for one in package.includes if one not in found.includes]
        found.definitions += [one for one in package.definitions if one not in found.definitions]
        if package.has_messages:
            found.messages.append(package.folder)
        found.standard = max(found.standard, package.standard)
    found.standard = (
        max(found.standard, 14) if 0 < found.standard < 17 else found.standard if found.standard > 17 else 0
    )
    included = {one for file in files for one in includes_of(file)}
    found.needs, notes = needs_of(included)
    found.questions += [f"CMakeLists.txt: {one}" for one in notes]
    found.questions += missing_headers(included, files, found, packages)


def without_copies(sources):
    """The sources without those that are another's copy, and these. Packages that hold the same file each have it in a
    library of their own; in one library it can stand once."""

    def text_alone(source):
        return re.sub(r"(?m)^[ \t]*#[ \t]*include.*$|\s", "", text_of(source))

    firsts, copies = {}, []
    for source in sources:
        first = firsts.setdefault((source.name, text_alone(source)), source)
        if first != source:
            copies.append(source)
    return list(firsts.values()), copies


def missing_headers(included, files, found, packages):
    """A question for each included file that neither the workspace nor the shim nor the system has."""
    folders = [*found.includes, *{one.parent for one in files}, SHIM / "include", SHIM / "include_pcl"]
    folders += map(pathlib.Path, ["/usr/include", "/usr/include/eigen3", "/usr/include/opencv4", "/usr/local/include"])
    missing = {}
    for one in sorted(included):
        package, _, rest = one.partition("/")
        is_message = bool(rest) and any((folder / package).is_dir() for folder in (SHIM / "messages",))
        is_message = is_message or (bool(rest) and package in packages and packages[package].has_messages)
        if not rest or is_message or package in ("pcl", "opencv2", "boost", "Eigen", "bits", "sys"):
            continue
        if not any((folder / one).exists() for folder in folders):
            missing.setdefault(package, one)
    return [
        f"CMakeLists.txt: no {one}: its package into MESSAGES, or its folder into INCLUDE?" for one in missing.values()
    ]


def check_topics(text, file):
    """Reads what was written as the shim would: a mistake here is ours."""
    tree = Tree(file, yaml.compose(text))
    for key, _, value in tree.items():
        if key == "publish":
            all_published(value, _AnyExpression())


class _AnyExpression:
    def read(self, text, _tree):
        return text


def write(found, folder):
    cmake, topics = folder / "CMakeLists.txt", folder / "topics.yaml"
    for file in (cmake, topics):
        if file.exists():
            raise launch_file.Problem(f"{file} is there already: --folder FOLDER, or remove it")
    text = topics_text(found)
    check_topics(text, str(topics))
    folder.mkdir(parents=True, exist_ok=True)
    cmake.write_text(cmake_text(found))
    topics.write_text(text)
    return text


def report(found, folder, text, prefix):
    lines = text.splitlines()
    print(f"wrote {folder}/CMakeLists.txt and {folder}/topics.yaml")
    guesses = sum("# guess:" in one for one in lines)
    print(f"  planner   {found.name}: {len(found.sources)} sources, {guesses} guesses marked")
    print(f"  nodes     {', '.join(node.name for node in found.mains)}")
    if found.left:
        print(f"  left out  {', '.join(found.left)}")
    for one in found.copies:
        print(f"  copy      {one.relative_to(found.workspace)}: the same as another source, compiled once")
    print(f"  command   {found.command.name} ({found.command.kind})")
    asked = [f"topics.yaml:{at}: {line.partition('# ? ')[2]}" for at, line in enumerate(lines, 1) if "# ? " in line]
    questions = asked + found.questions
    print("To answer:" if questions else "No questions.")
    for one in questions:
        print(f"  {one}")
    print(f"""Next:
  cmake -S {folder} -B {folder}/build -DCMAKE_PREFIX_PATH={prefix}
  cmake --build {folder}/build
  avoidbench planners check {folder}/build/planners/{found.name}.so
  avoidbench suite run avoidbench-1/depth --split dev --planner {folder}/build/planners/{found.name}.so""")


def main():
    parser = argparse.ArgumentParser(prog="avoidbench planners wrap", description=__doc__.partition(". ")[0] + ".")
    parser.add_argument("launch", metavar="LAUNCH_FILE", type=pathlib.Path)
    parser.add_argument("arguments", nargs="*", metavar="NAME:=VALUE", help="arguments of the launch file")
    parser.add_argument("--workspace", type=pathlib.Path, metavar="FOLDER", help="where its packages lie")
    parser.add_argument(
        "--folder", type=pathlib.Path, metavar="FOLDER", help="where the two files go [the planner's name]"
    )
    parser.add_argument("--name", help="the planner's name [the launch file's package]")
    parser.add_argument("--prefix", default="PREFIX", help=argparse.SUPPRESS)
    words = parser.parse_args()
    given = {}
    for one in words.arguments:
        name, colon, value = one.partition(":=")
        if not colon:
            parser.error(f'"{one}" is no NAME:=VALUE')
        given[name] = value
    if words.name and not re.fullmatch(r"[a-z][a-z0-9_]*", words.name):
        parser.error(f'--name "{words.name}": small letters, digits and _')
    launch = words.launch.absolute()
    if not launch.is_file():
        raise launch_file.Problem(f"{words.launch}: no such file")
    workspace = (words.workspace or workspace_of(launch)).resolve()
    packages = find_packages(workspace)
    if not packages:
        raise launch_file.Problem(f"{workspace}: no package.xml below it")
    read = launch_file.read_launch(launch, {name: one.folder for name, one in packages.items()}, given)
    own = next(
        (name for name, one in packages.items() if launch.resolve().is_relative_to(one.folder.resolve())), launch.stem
    )
    name = words.name or re.sub(r"\W", "_", own.lower())
    found = Found(name, workspace, launch)
    found.questions += read.notes
    take_nodes(found, read, packages)
    take_sources(found, packages)
    folder = words.folder or pathlib.Path(name)
    report(found, folder, write(found, folder), words.prefix)


if __name__ == "__main__":
    try:
        main()
    except (launch_file.Problem, TopicsProblem) as problem:
        print(problem, file=sys.stderr)
        sys.exit(2)
