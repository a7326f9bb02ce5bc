#!/usr/bin/env python3
"""Validates files with the JSON Schemas of `avoidbench config schema`, and compares with the program's own verdict.

usage: check_schemas.py --program build/avoidbench --configs configs [--page docs/sweep_files.md]

- Each schema is one of draft 2020-12.
- Every file in configs/ and all that `config defaults` prints is valid.
- Every example of the page is good for both.
- Small files, good and wrong, are accepted or refused alike by the schema and by `config check`.
- Every number that has a range is refused outside of it, and every word that is none of a choice, by both, field by
field.

Needs jsonschema 4 (Debian: python3-jsonschema) and PyYAML (python3-yaml).
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import jsonschema
    import yaml

    validator_class = jsonschema.Draft202012Validator
except (ImportError, AttributeError) as error:
    if os.path.realpath(sys.executable) != os.path.realpath("/usr/bin/python3") and os.path.exists("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    sys.exit(f"{error}: install the packages python3-jsonschema (4.0 or newer) and python3-yaml")


class CoreLoader(yaml.SafeLoader):
    """YAML 1.2's core schema, as editors and the program read it: PyYAML's own takes 1e3 for text and `no` for
    false."""


CoreLoader.yaml_implicit_resolvers = {}
CoreLoader.add_implicit_resolver("tag:yaml.org,2002:null", re.compile(r"^(?:~|null|)$"), ["~", "n", ""])
CoreLoader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(?:true|false)$"), list("tf"))
CoreLoader.add_implicit_resolver("tag:yaml.org,2002:int", re.compile(r"^[-+]?[0-9]+$"), list("-+0123456789"))
CoreLoader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"^[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?$"),
    list("-+.0123456789"),
)
CoreLoader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value))
CoreLoader.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(node.value))


def load(text):
    return yaml.load(text, CoreLoader)


# Sweep files that both take.
GOOD = """
sensor: {more_cameras: [d435_like, {preset: oak_d_like, yaw_deg: 90}, {width_px: 64}]}
sensor: {preset: stereo_sgm, more_cameras: [{kind: stereo_sgm, disparities: 64}]}
maps: {generator: hall, cylinder_height_m: [2, 4]}
maps: {poisson_radius_m: [3, 4.5]}
maps: {poisson_radius_m: {from: 2.3, to: 5.8, count: 10}}
maps: {poisson_radius_m: {from: 4, to: 2, step: -0.5}}
maps: {poisson_radius_m: {from: 18, to: 21, step: 2}}
maps: {poisson_radius_m: [5e0, 1.0e1]}
maps: {area_m: [[40, 40], [60, 60]]}
maps: {seeds: 3}
maps: {seeds: [7, 9]}
maps: {seeds: {from: 1, to: 9, step: 2}}
maps: {generator: gap_walls}
seed: [1, 2]
seed: 18446744073709551615
trials: 12.0
max_speed_mps: [2, 4]
planners: straight_line
planners: {plugin: reactive, label: 3}
planners: [{plugin: reactive, parameters: {max_speed_mps: {from: 1, to: 2, count: 3}}}]
planners: [{plugin: reactive, parameters: ~}]
planners: [{plugin: reactive, max_speed_mps: 1.5}]
vehicle: firefly
vehicle: {preset: firefly, mass_kg: [1.5, 1.6]}
vehicle: {position_controller: {drag_compensation: [true, false]}}
vehicle: {rotors: [{position_body_m: [0.2, 0, 0], spin: -1}, {position_body_m: [0, 0.2, 0]}, {position_body_m: [-0.2, 0, 0], spin: -1}, {position_body_m: [0, -0.2, 0]}]}
sensor: stereo_sgm
sensor: {preset: stereo_sgm, disparities: 80}
sensor: {kind: stereo_sgm, subpixel: true}
sensor: {more_mountings: [{yaw_deg: 90}, {}]}
sensor: {name: 7}
latency: {mode: zero}
latency: {mode: [zero, fixed]}
wind: {mean_world_mps: [[0, 0, 0], [4, 0, 0]]}
axes: ~
axes: {}
axes: {wind.mean_world_mps: [[0, 0, 0], [4, 0, 0]], latency.ms: {from: 0, to: 100, count: 3}, vehicle.mass_kg: 0.8}
axes: {maps.seeds: [1, 2], latency.mode: [zero, fixed], seed: [3, 4]}
axes: {map.bush_ratio: [0.1, 0.2]}
sweep: 2026
"""

# Files of real flights, after what they all have; what is wrong in the second ones is no missing file.
FLIGHTS_HEAD = {
    "flights": "flights: a",
    "sweep": "sweep: {maps: {generator: forest}}",
    "recordings": "recordings: [{log: x.tum, planner: ego, goal: [1, 2, 3]}]",
}
GOOD_FLIGHTS = """
flights: 2026
sweep: {vehicle: firefly, mission: {goal_radius_m: 2}, planners: [ego]}
smoothing: {position_noise_m: 0.02, jerk_mps3: 40}
alignment: {translation_m: [1, 2, 3], yaw_deg: 90}
alignment: {points: [{log: [0, 0, 0], map: [1, 1, 1]}, {log: [0, 1, 0], map: [1, 2, 1]}, {log: [3, 0, 0], map: [4, 1, 1]}]}
recordings: [{log: x.tum, planner: ego, goal: [1, 2, 3], start: [], outcome: collided, begin_s: 2, end_s: 9}]
"""
WRONG_FLIGHTS = """
flights: a/b
flight: a
sweep: 3
sweep: {mapps: {}}
sweep: {maps: {generator: forrest}}
smoothing: {position_noise_m: 0}
smoothing: {noise: 1}
alignment: {yaw: 3}
alignment: {points: [{log: [0, 0], map: [1, 1, 1]}]}
recordings: []
recordings: [{planner: ego, goal: [1, 2, 3]}]
recordings: [{log: x.tum, planner: ego, goal: [1, 2, 3], outcome: crashed}]
recordings: [{log: x.tum, planner: ego, goal: [1, 2, 3], topik: a}]
recordings: [{log: x.tum, planner: ego, goal: [1, 2, 3], begin_s: -1}]
"""

# Sweep files that both refuse.
WRONG = """
sensor: {more_cameras: [{widht_px: 64}]}
sensor: {more_cameras: [{width_px: 4}]}
sensor: {more_cameras: [{more_cameras: []}]}
mission: {list: []}
mission: {list: [{start: [1, 2, 3]}]}
mission: {list: [{start: [1, 2], goal: [1, 2, 3]}]}
mission: {list: [{start: [1, 2, 3], goal: [1, 2, 3], yaw: 3}]}
sweeps: a
sweep: a/b
sweep: ""
sweep: [a]
trials: 0
trials: 2.5
trials: many
trials: [1, 2]
trials: "3"
seed: -1
seed: ~
max_speed_mps: fast
maps: forest
maps:
maps: {generator: forrest}
maps: {generator: [forest, hall]}
maps: {generator: hall, bush_ratio: 1}
maps: {cylinder_height_m: [2, 4]}
maps: {poisson_radius_m: 0.5}
maps: {poisson_radius_m: "3"}
maps: {poisson_radius_m: true}
maps: {poisson_radius_m: []}
maps: {poisson_radius_m: [3, 90]}
maps: {poisson_radius_m: [3, 3]}
maps: {poisson_radius_m: [3, far]}
maps: {poisson_radius_m: {from: 3, to: 4}}
maps: {poisson_radius_m: {from: 3, count: 4}}
maps: {poisson_radius_m: {from: 3, to: 4, count: 2, step: 1}}
maps: {poisson_radius_m: {from: 3, till: 4, count: 2}}
maps: {poisson_radius_m: {from: 3, to: 25, count: 5}}
maps: {poisson_radius_m: {from: 0, to: 5, step: 1}}
maps: {poisson_radius_m: {from: 3, to: 4, step: 0}}
maps: {poisson_radius: 3}
maps: {area_m: 40}
maps: {area_m: [40]}
maps: {area_m: [40, 5]}
maps: {area_m: [[40, 40], [40, 40]]}
maps: {area_m: {from: 20, to: 40, count: 3}}
maps: {seeds: 0}
maps: {seeds: [1, 1]}
maps: {seeds: [-1]}
maps: {generator: mesh, bounds: {lowest: [0, 0, 0]}}
planners: []
planners: ~
planners: [{label: x}]
planners: [{plugin: reactive, labell: x}]
planners: [{plugin: reactive, label: ""}]
planners: [{plugin: reactive, parameters: {max_sped_mps: 3}}]
planners: [{plugin: reactive, parameters: {max_speed_mps: -3}}]
planners: [{plugin: reactive, parameters: {max_speed_mps: fast}}]
planners: [{plugin: reactive, parameters: [1]}]
planners: [[reactive]]
vehicle: ~
vehicle: {preset: [firefly]}
vehicle: {mass: 1}
vehicle: {mass_kg: 0}
vehicle: {mass_kg: [1.5, 2000]}
vehicle: {position_controller: {drag_compensation: 1}}
vehicle: {position_controller: 3}
vehicle: {rotors: [{spin: 2}]}
vehicle: {rotors: {spin: 1}}
sensor: {kind: stereo}
sensor: {kind: depth_ideal, disparities: 64}
sensor: {disparities: 64}
sensor: {width_px: 320.5}
sensor: {more_mountings: [{yaw: 90}]}
sensor: {more_mountings: [{yaw_deg: [0, 90]}]}
latency: {mode: fixd}
latency: {mode: []}
latency: {mode: [zero, zero]}
latency: fixed
wind: {mean_world_mps: [0, 0]}
wind: {mean_world_mps: [[0, 0, 0], 4]}
wind: {mean_world_mps: [0, 0, "0"]}
odometry: {drift: 1}
mission: {time_limit_s: 0}
rates: {plan_hz: 0}
axes: [1]
axes: {wind.mean_mps: [1]}
axes: {wind.mean_world_mps: [0, 4]}
axes: {maps.poisson_radius_m: [3, 0]}
axes: {maps.poisson_radius_m: []}
axes: {maps.generator: [forest]}
axes: {sensor.kind: [depth_ideal, depth_noisy]}
axes: {vehicle: [firefly]}
axes: {mission_index: [1, 2]}
axes: {trials: [1, 2]}
axes: {planner.label: [a]}
include: []
include: {a: b}
"""


class Checker:
    def __init__(self, program, folder):
        self.program, self.folder, self.failures, self.count = program, pathlib.Path(folder), [], 0
        self.validators = {}
        for kind in ("sweep", "part", "flights", "vehicle", "sensor"):
            schema = json.loads(self.run("config", "schema", kind))
            validator_class.check_schema(schema)
            self.validators[kind] = validator_class(schema)

    def run(self, *arguments):
        return subprocess.run([self.program, *arguments], check=True, capture_output=True, text=True).stdout

    def fail(self, message):
        self.failures.append(message)

    def errors(self, kind, document):
        return sorted(self.validators[kind].iter_errors(document), key=lambda e: list(map(str, e.absolute_path)))

    def valid(self, kind, text, name):
        self.count += 1
        for error in self.errors(kind, load(text))[:3]:
            self.fail(f"{name}: {'.'.join(map(str, error.absolute_path))}: {error.message[:200]}")

    def check(self, text):
        """What `config check` says of a sweep file: its problems, none where it is good."""
        (self.folder / "s.yaml").write_text(text)
        done = subprocess.run(
            [self.program, "config", "check", "s.yaml"], cwd=self.folder, capture_output=True, text=True
        )
        if done.returncode not in (0, 2):
            self.fail(f"exit code {done.returncode} for\n{text}\n{done.stderr}")
        return done.stderr.splitlines() if done.returncode == 2 else []

    def compare(self, text, is_good, kind="sweep", sweep=None):
        """The schema and the program on one file; `sweep` is the sweep to check for another kind of file."""
        self.count += 1
        problems = self.check(text if sweep is None else sweep)
        errors = self.errors(kind, load(text))
        if bool(problems) == is_good:
            self.fail(f"config check is wrong about: {text.strip()}\n  {problems}")
        if bool(errors) == is_good:
            self.fail(f"the schema is wrong about: {text.strip()}\n  {[e.message[:200] for e in errors][:3]}")


def check_flights(checker, file):
    """Files of real flights, by the schema and by `import`, which finds no log in either case."""
    checker.valid("flights", file.read_text(), file.name)
    for is_good, text in ((True, GOOD_FLIGHTS), (False, WRONG_FLIGHTS)):
        for line in text.strip().splitlines():
            checker.count += 1
            content = "\n".join({**FLIGHTS_HEAD, line.split(":")[0]: line}.values()) + "\n"
            (checker.folder / "f.yaml").write_text(content)
            command = [checker.program, "import", "f.yaml"]
            done = subprocess.run(command, cwd=checker.folder, capture_output=True, text=True, check=False)
            problems = [problem for problem in done.stderr.splitlines() if "no such file" not in problem]
            if done.returncode != 2 or bool(problems) == is_good:
                checker.fail(f"import is wrong about: {line}\n  {problems}")
            errors = checker.errors("flights", load(content))
            if bool(errors) == is_good:
                checker.fail(f"the schema is wrong about: {line}\n  {[e.message[:200] for e in errors][:3]}")


def check_page(checker, page):
    """The YAML examples of a page in order; the first line of one may name its file."""
    examples = re.findall(r"^```yaml\n(.*?)^```", page.read_text(), re.M | re.S)
    if not examples:
        checker.fail(f"no examples in {page}")
    for text in examples:
        named = re.match(r"# (\w+\.yaml)\n", text)
        if named:
            (checker.folder / named[1]).write_text(text)
        checker.compare(text, True)


def with_head(line):
    lines = {"sweep": "sweep: a", "planners": "planners: [straight_line]"}
    key = line.split(":")[0]
    lines[key] = line
    return "\n".join(lines.values()) + "\n"


def leaves(value, path=()):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, (*path, key))
    else:
        yield path, value


def changed(document, change):
    """The document with every leaf replaced by change(leaf) where that is not None, and the paths of those."""
    paths = []

    def of(value, path):
        if isinstance(value, dict):
            return {key: of(inner, (*path, key)) for key, inner in value.items()}
        other = change(path, value)
        if other is None:
            return value
        paths.append(".".join(path))
        return other

    return of(document, ()), paths


def check_fields(checker, document):
    """All fields of a sweep made wrong at once, in several ways: both tell of each field."""
    kept = ("sweep", "planners", "trials", "axes")

    def too_small(path, value):
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        return -1e300 if is_number and path[0] not in kept else None

    def wrong_type(path, value):
        if path[0] in kept or path[-1] in ("name", "file", "file_digest", "database", "generator", "kind"):
            return None
        return {"no": "such thing"}

    def wrong_word(path, value):
        if path[0] in kept or path[-1] in ("name", "file", "file_digest", "database", "generator", "kind"):
            return None
        return "no_such_word"

    def too_large_list(path, value):
        return [1e300] * 9 if isinstance(value, list) and path[0] not in kept else None

    for change in (too_small, wrong_type, wrong_word, too_large_list):
        wrong, paths = changed(document, change)
        if not paths:
            continue
        checker.count += len(paths)
        problems = checker.check(json.dumps(wrong))
        told = {re.sub(r"^s\.yaml:\d+:\d+: ([\w.]+).*", r"\1", line) for line in problems}
        errors = {".".join(str(step) for step in error.absolute_path) for error in checker.errors("sweep", wrong)}
        for path in paths:
            for who, places in (("config check", told), ("the schema", errors)):
                if not any(place == path or place.startswith(path + ".") for place in places):
                    checker.fail(f"{who} lets {change.__name__} through at {path}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--configs", required=True, type=pathlib.Path)
    parser.add_argument("--page", type=pathlib.Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="avoidbench_schemas_") as folder:
        checker = Checker(os.path.abspath(arguments.program), folder)
        for kind in ("sweep", "vehicle", "sensor"):
            files = sorted((arguments.configs / (kind + "s")).glob("*.yaml"))
            if not files:
                checker.fail(f"no files in {kind}s")
            for file in files:
                checker.valid(kind, file.read_text(), file.name)
        defaults = checker.run("config", "defaults")
        checker.valid("sweep", defaults, "config defaults")
        checker.valid("part", "maps: {cylinder_height_m: [2, 4]}", "a part")
        for name in ("hummingbird", "hummingbird_rotors", "firefly", "racing_5in", "agile_quad", "x500", "crazyflie"):
            checker.valid("vehicle", checker.run("config", "defaults", name), name)
        for line in checker.run("sensors", "list", "--format", "csv").splitlines()[1:]:
            name = line.split(",")[0]
            checker.valid("sensor", checker.run("config", "defaults", name), name)

        check_flights(checker, arguments.configs / "flights/thicket.yaml")
        if arguments.page:
            check_page(checker, arguments.page)
        for is_good, lines in ((True, GOOD), (False, WRONG)):
            for line in lines.strip().splitlines():
                checker.compare(with_head(line), is_good)
        checker.compare("planners: [straight_line]\n", False)
        checker.compare("sweep: a\n", False)
        checker.compare("- 1\n", False)
        head = "sweep: a\nplanners: [straight_line]\n"
        (checker.folder / "base.yaml").write_text(head + "maps: {generator: hall}\nsensor: stereo_sgm\n")
        checker.compare("include: base.yaml\nmaps: {cylinder_height_m: [2, 4]}\nsensor: {disparities: 80}\n", True)
        checker.compare('include: base.yaml\nmaps: {height_m: "4"}\n', False)
        checker.compare("include: [base.yaml]\nmaps: {cylinder_heigth_m: [2, 4]}\n", False)
        shelves = {
            "vehicle": [
                ("preset: firefly\nmass_kg: 1.6\n", True),
                ("mass_kg: [1, 2]\n", False),
                ("mas_kg: 1\n", False),
                ("mass_kg: -1\n", False),
                ("- 1\n", False),
            ],
            "sensor": [
                ("kind: stereo_sgbm\ndisparities: 80\n", True),
                ("preset: stereo_sgm\ndisparities: 80\n", True),
                ("disparities: 80\n", False),
                ("kind: depth_ideal\ndisparities: 80\n", False),
                ("fov_x_deg: [60, 90]\n", False),
                ("kind: stereo\n", False),
            ],
        }
        for kind, files in shelves.items():
            for text, is_good in files:
                (checker.folder / "v.yaml").write_text(text)
                checker.compare(text, is_good, kind, head + f"{kind}: ./v.yaml\n")

        whole = load(defaults)
        whole["planners"] = ["straight_line"]
        check_fields(checker, whole)
        schema = checker.validators["sweep"].schema
        for generator in schema["$defs"]["maps"]["properties"]["generator"]["enum"]:
            fields = schema["$defs"]["maps." + generator]["properties"]
            maps = {name: field.get("default", "x") for name, field in fields.items()}
            check_fields(
                checker, {"sweep": "a", "planners": ["straight_line"], "maps": {**maps, "generator": generator}}
            )
        for sensor in schema["$defs"]["sensor"]["then"]["properties"]["kind"]["enum"]:
            fields = schema["$defs"]["sensor." + sensor]["properties"]
            values = {name: field.get("default", {}) for name, field in fields.items() if name != "preset"}
            check_fields(checker, {"sweep": "a", "planners": ["straight_line"], "sensor": {**values, "kind": sensor}})
        for failure in checker.failures:
            print(failure)
        print(f"{checker.count} files and fields, {len(checker.failures)} failures")
        return 1 if checker.failures else 0


if __name__ == "__main__":
    sys.exit(main())
