#!/usr/bin/env python3
"""Checks the order of the rooms and some rules of the code:

- a room of lib/ includes only itself, rooms before it in lib/ORDER and the third parties named there
- a wing includes no later wing, and planner and sim do not include each other
- planners include only the SDK (except the code that trains them)
- no message of lib/ names a command-line option
- no code uses anything that would make results differ between machines
- no two rooms define a type of the same name (the linker would silently take either's functions for both)
- the drawing in lib/README.md matches the includes

    check_layers.py [FOLDER] [--draw]    --draw: rewrites the drawing"""

import pathlib
import re
import sys

arguments = [word for word in sys.argv[1:] if word != "--draw"]
root = pathlib.Path(arguments[0] if arguments else ".").resolve()
BESIDE = {("planner", "sim")}  # independent wings
order, wings, allowed, includes = [], {}, {}, {}
for line in (root / "lib/ORDER").read_text().splitlines():
    if line and not line.startswith("#"):
        place, _, third_parties = line.partition(":")
        wing, _, room = place.partition("/")
        order.append(room)
        wings[room] = wing
        allowed[room] = set(third_parties.split())

# The first part of an angle-bracket include -> its third party. Others belong to the language or the system.
THIRD_PARTIES = {
    "Eigen": "Eigen",
    "embree3": "embree3",
    "embree4": "embree4",
    "opencv2": "opencv2",
    "png.h": "png",
    "zlib.h": "zlib",
    "zstd.h": "zstd",
    "sqlite3.h": "sqlite3",
    "lz4frame.h": "lz4",
    "bzlib.h": "bzlib",
    "yaml-cpp": "yaml-cpp",
    "nlohmann": "nlohmann",
    "nettle": "nettle",
    "dlfcn.h": "dlfcn",
    "CLI": "CLI",
    "gtest": "gtest",
    "benchmark": "benchmark",
}
UNREPEATABLE = [
    (
        r"std::(uniform_\w+|normal|bernoulli|poisson|exponential)_distribution|std::shuffle|random_device|\b(s?rand)\(",
        "draw from base/random.hpp",
    ),
    (
        r"std::(sin|cos|tan|asin|acos|atan2?|exp2?|log(2|10|1p)?|pow|cbrt|hypot|sinh|cosh|tanh)\(",
        "use base/math.hpp: the C library's last bit depends on the processor",
    ),
    (r"std::unordered_(map|set)", "its order differs between libraries"),
]
# A planner's folder with the program that makes its training data: it knows the map and is not part of the planner.
TEACHER = "expert"
# The files that replace these functions of the C library by repeatable ones, or search planners for them.
REPEATABLE = {
    "lib/sdk/planner_api/avoidbench/repeatable.hpp",
    "lib/sdk/planner_api/avoidbench/repeatable/chance.cpp",
    "lib/planner/conformance/import_notes.cpp",
}
# Messages of lib/ name no command-line options: an OptionError has the option's name, and the program writes it.
# Allowed are single words, which are arguments of a process, and the place name of key overrides.
OPTION = re.compile(r"(?<![\w-])--[a-z]")
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
ALLOWED_LITERALS = {("lib/base/yaml/overrides.cpp", "--set ")}
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
problems = []


def problem(file, number, text):
    problems.append(f"{file.relative_to(root)}:{number}: {text}")


def check_include(file, number, kind, path, room):
    first = path.split("/")[0]
    if first == "avoidbench":
        first = "planner_api"
    elif kind == "<":
        party = THIRD_PARTIES.get(first)
        if party and party not in allowed[room]:
            problem(file, number, f"room {room} may not include {path}: lib/ORDER does not name {party}")
        return
    if first not in order:
        problem(file, number, f'"{path}" is not a room of lib/ORDER')
    elif first != room and (wings[room], wings[first]) in BESIDE:
        problem(file, number, f"wing {wings[room]} includes {path}, which must stay independent of it")
    elif first != room and order.index(first) < order.index(room):
        includes.setdefault(room, set()).add(first)
    elif first != room:
        problem(file, number, f"room {room} includes {path}, but {first} comes after it in lib/ORDER")


def check_planner_include(file, number, kind, path):
    if path.split("/")[0] in order and not path.startswith("planner_api"):
        problem(file, number, f"planners include only avoidbench/… and their own files, not {path}")


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".cpp", ".hpp", ".h", ".c"})


for folder in [root / "lib", root / "planners"]:
    for file in sources(folder):
        in_lib = folder.name == "lib"
        room = file.relative_to(folder).parts[1 if in_lib else 0]
        if in_lib and (room not in allowed or file.relative_to(folder).parts[0] != wings[room]):
            problem(file, 1, f"folder {file.parent.relative_to(folder)} is not in lib/ORDER")
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if match := INCLUDE.match(line):
                if in_lib:
                    check_include(file, number, *match.groups(), room)
                elif file.relative_to(folder).parts[1] != TEACHER:
                    check_planner_include(file, number, *match.groups())
            code = line.split("//")[0]
            for literal in LITERAL.findall(code) if in_lib else []:
                is_allowed = " " not in literal or (str(file.relative_to(root)), literal) in ALLOWED_LITERALS
                if OPTION.search(literal) and not is_allowed:
                    problem(file, number, f'a message names an option: "{literal}"')
            for pattern, advice in UNREPEATABLE:
                if re.search(pattern, code) and str(file.relative_to(root)) not in REPEATABLE:
                    problem(file, number, f"not repeatable: {advice}")

NAMESPACE = re.compile(r"namespace ?([\w:]*)(?: [A-Z_]+)? ?\{")
TYPE = re.compile(r"(?:struct|class|enum class) (\w+)(?: final)?(?: :[^:].*)?(?: \{.*| :.*)$")


def types_of(file):
    """The types that a file defines outside other types and unnamed namespaces, as (line, name with its namespace)."""
    spaces = []
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if match := NAMESPACE.match(line):
            spaces.append(match[1])
        elif line.startswith("}  // namespace"):
            spaces.pop()
        elif (match := TYPE.match(line)) and "" not in spaces:
            yield number, "::".join([*spaces, match[1]])


first_place = {}
for file in sources(root / "lib"):
    for number, name in types_of(file):
        if first_place.setdefault(name, file.relative_to(root)) != file.relative_to(root):
            problem(file, number, f"{name} is defined in {first_place[name]} too")


def below(wing, uses):
    """All wings that a wing includes, directly or through others."""
    return {other for direct in uses[wing] for other in {direct} | below(direct, uses)}


def drawing():
    """The wings, their rooms and their includes as Mermaid, without arrows that follow from others."""
    in_order = list(dict.fromkeys(wings.values()))
    uses = {wing: set() for wing in in_order}
    for room, others in includes.items():
        uses[wings[room]] |= {wings[other] for other in others} - {wings[room]}
    lines = ["```mermaid", "graph BT"]
    for wing in in_order:
        lines.append(f'  {wing}["<b>{wing}</b><br/>{" ".join(room for room in order if wings[room] == wing)}"]')
    for wing in in_order:
        lines += [
            f"  {wing} --> {other}"
            for other in in_order
            if other in uses[wing] and not any(other in below(third, uses) for third in uses[wing])
        ]
    return "\n".join(lines + ["```"])


readme = root / "lib/README.md"
if readme.exists():
    text = readme.read_text()
    drawn = re.sub(r"```mermaid\n.*?```", lambda _: drawing(), text, flags=re.DOTALL)
    if "--draw" in sys.argv:
        readme.write_text(drawn)
    elif drawn != text:
        problem(
            readme,
            text[: text.find("```mermaid")].count("\n") + 1,
            "the drawing does not match the includes: scripts/check_layers.py --draw",
        )

print("\n".join(problems) if problems else f"{len(order)} rooms in order")
sys.exit(1 if problems else 0)
