#!/usr/bin/env python3
"""Checks that each room of lib/ includes only itself, rooms before it in lib/ORDER and the third parties named there,
that no wing includes one that comes after it or stands beside it, that planners include only the SDK (but not what
trains them), that no message of lib/ names an option of the command line, that no code uses what would make results
differ between machines, that no two rooms define a type of one name (the linker would take either's functions for both,
without a word), and that the drawing in lib/README.md shows the includes as they are.

    check_layers.py [FOLDER] [--draw]    --draw: writes the drawing again"""

import pathlib
import re
import sys

arguments = [word for word in sys.argv[1:] if word != "--draw"]
root = pathlib.Path(arguments[0] if arguments else ".").resolve()
BESIDE = {("planner", "sim")}  # wings that stand side by side
order, wings, allowed, includes = [], {}, {}, {}
for line in (root / "lib/ORDER").read_text().splitlines():
    if line and not line.startswith("#"):
        place, _, third_parties = line.partition(":")
        wing, _, room = place.partition("/")
        order.append(room)
        wings[room] = wing
        allowed[room] = set(third_parties.split())

# The first part of an angle-bracket include -> the third party it belongs to. Others are the language's or the
# system's.
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
# The folder of a planner's own that makes what it is trained with: a program that knows the map, and no part of the
# planner.
TEACHER = "expert"
# Where the C library's functions of that name are replaced by repeatable ones, and where they are looked for in
# planners.
REPEATABLE = {
    "lib/sdk/planner_api/avoidbench/repeatable.hpp",
    "lib/sdk/planner_api/avoidbench/repeatable/chance.cpp",
    "lib/planner/conformance/import_notes.cpp",
}
# Messages of lib/ name no options of the command line: an OptionError has the option's name, and the program writes it
# out. Allowed are whole words, which are arguments of a process, and the name of the place where overrides of keys
# stand.
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
        problem(file, number, f'"{path}" is no room of lib/ORDER')
    elif first != room and (wings[room], wings[first]) in BESIDE:
        problem(file, number, f"wing {wings[room]} includes {path}, but {wings[first]} stands beside it")
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
    """The types that a file defines outside of other types and of unnamed namespaces, as (line, name with its
    namespace)."""
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
    """All wings that a wing includes, itself or through others."""
    return {other for direct in uses[wing] for other in {direct} | below(direct, uses)}


def drawing():
    """The wings, their rooms and who includes whom as Mermaid, without what follows from other arrows."""
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
            "the drawing is not of these includes: scripts/check_layers.py --draw",
        )

print("\n".join(problems) if problems else f"{len(order)} rooms in order")
sys.exit(1 if problems else 0)
