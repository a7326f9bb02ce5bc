#!/usr/bin/env python3
"""No command writes over a database, whatever it is called: each option that names a file to write is tried on one.

check_outputs.py --program PROGRAM
"""

import argparse
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SWEEP = """sweep: small
planners: [straight_line]
trials: 2
maps: {generator: hall, poisson_radius_m: 5, area_m: [12, 15]}
mission: {time_limit_s: 1}
sensor: {width_px: 80, height_px: 60}
"""

# Of each command that writes files: its words, and by option the file that is a database already. @ is the option with
# it; "" is a file without an option, and what is written beside another file is not named.
COMMANDS = {
    "compare": [
        ("compare db.db db.db @", {"--output": "v.sqlite", "--page": "v.html"}),
        ("compare db.db @", {"--bless": "v.csv"}),
    ],
    "config defaults": [("config defaults @", {"--output": "v.yaml"})],
    "config schema": [("config schema @", {"--output": "v.json"})],
    "config sweeps": [("config sweeps @", {"--output": "v.sqlite"})],
    "explain": [("explain db.db @", {"--output": "v.sqlite"}), ("explain db.db 1 @", {"--png": "v.png"})],
    "export legs": [("export legs db.db 1 @", {"--output": "v.csv"})],
    "export calls": [("export calls db.db 1 @", {"--output": "v.csv"})],
    "export mcap": [("export mcap db.db 1 @", {"--output": "v.mcap"})],
    "export trajectory": [("export trajectory db.db 1 @", {"--output": "v.csv"})],
    "export trials": [("export trials db.db @", {"--output": "v.csv"})],
    "import": [("import nothing.yaml @", {"--output": "v.sqlite", "--twin": "v.yaml"})],
    "grade": [("grade nothing @", {"--output": "v.sqlite"})],
    "limit": [
        (
            "limit sweep.yaml --db other.db --over latency.ms=0..400 --quiet @",
            {"--output": "v.sqlite", "--heartbeat": "v.json"},
        )
    ],
    "maps export": [
        ("maps export hall @", {"": "v.obj"}),
        ("maps export hall other.obj", {"beside": "other.mtl"}),
        ("maps export hall --as cloud @", {"": "v.ply"}),
        ("maps export hall --as occupancy @", {"": "v.npy"}),
        ("maps export hall --as occupancy other.npy", {"beside": "other.npy.json"}),
    ],
    "maps info": [("maps info hall @", {"--output": "v.sqlite"})],
    "maps list": [("maps list @", {"--output": "v.sqlite"})],
    "maps show": [("maps show hall @", {"--png": "v.png"}), ("maps show hall @", {"--page": "v.html"})],
    "metrics": [("metrics @", {"--output": "v.sqlite"})],
    "planners check": [("planners check straight_line @", {"--output": "v.sqlite"})],
    "planners describe": [("planners describe straight_line @", {"--output": "v.sqlite"})],
    "planners list": [("planners list @", {"--output": "v.sqlite"})],
    "power": [("power --trials 10 @", {"--output": "v.sqlite"})],
    "predict": [("predict db.db --traversability 0.6 --distance 20 @", {"--output": "v.sqlite"})],
    "replay": [
        (
            "replay db.db 1 @",
            {"--png": "v.png", "--video": "v.mp4", "--page": "v.html", "--csv": "v.csv", "--commands": "v.csv"},
        ),
        ("replay db.db --list @", {"--output": "v.sqlite"}),
    ],
    "report": [("report db.db @", {"--output": "v.sqlite", "--page": "v.html"})],
    "run": [
        ("run sweep.yaml --db other.db --quiet @", {"--heartbeat": "v.json", "--page": "v.html"}),
        ("run sweep.yaml --db other.db --quiet --page h.html", {"beside": "h.html.part"}),
        ("run sweep.yaml --db other.db --quiet --heartbeat h", {"beside": "h.new"}),
    ],
    "sensors list": [("sensors list @", {"--output": "v.sqlite"})],
    "sensors measure": [("sensors measure depth_ideal @", {"--output": "v.sqlite"})],
    "sensors show": [("sensors show depth_ideal @", {"--png": "v.png"})],
    "suite board": [("suite board nothing @", {"--output": "v.sqlite", "--page": "v.html"})],
    "suite list": [("suite list @", {"--output": "v.sqlite"})],
}
WRITING = {"--output", "--twin", "--png", "--page", "--video", "--csv", "--commands", "--bless", "--heartbeat"}


def help_of(program, words):
    return subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout


def commands_of(program, words=()):
    """Every command that has no further ones, with the options of its help that name a file to write."""
    text = help_of(program, words)
    below = re.findall(r"^  ([a-z_]+) ", text.partition("Subcommands:")[2].split("\n\n")[0], re.M)
    if not below:
        yield " ".join(words), WRITING & set(re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", text, re.M))
    for name in below:
        yield from commands_of(program, (*words, name))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    program = str(pathlib.Path(parser.parse_args().program).resolve())
    failures = []
    for command, options in commands_of(program):
        tried = {option for _, files in COMMANDS.get(command, []) for option in files}
        if options - tried:
            failures.append(f"{command}: {', '.join(sorted(options - tried))} is not tried here")
    with tempfile.TemporaryDirectory(prefix="avoidbench_outputs_") as folder:
        here = pathlib.Path(folder)
        (here / "sweep.yaml").write_text(SWEEP)
        subprocess.run(
            [program, "run", "sweep.yaml", "--db", "db.db", "--quiet"], cwd=here, check=True, capture_output=True
        )
        digest = hashlib.sha256((here / "db.db").read_bytes()).hexdigest()
        for words, option, name in [
            (words, option, name)
            for entries in COMMANDS.values()
            for words, files in entries
            for option, name in files.items()
        ]:
            victim = here / name
            shutil.copy(here / "db.db", victim)
            given = words.replace("@", f"{option} {name}").split()
            before = {file.name for file in here.iterdir()}
            done = subprocess.run([program, *given], cwd=here, capture_output=True, text=True, timeout=300)
            expected = f"{name}: can't be written: it is a database"
            if done.returncode != 2 or expected not in done.stderr:
                failures.append(f"{' '.join(given)}: exit {done.returncode}, {done.stderr.strip()[-300:]}")
            if hashlib.sha256(victim.read_bytes()).hexdigest() != digest:
                failures.append(f"{' '.join(given)}: the database was written over")
            made = {file.name for file in here.iterdir()} - before - {"other.db", "other.planners"}
            if made:
                failures.append(f"{' '.join(given)}: made {', '.join(sorted(made))}")
            victim.unlink()
    print(
        "\n".join(failures)
        or f"{sum(len(files) for entries in COMMANDS.values() for _, files in entries)} outputs tried"
    )
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
