"""Simulated flights that stand for real ones: flown, exported as paths, written as logs."""

import json
import subprocess
import tempfile
from contextlib import contextmanager
from pathlib import Path

import logs

SMALLER_GOAL = ["mission.goal_radius_m=0.5"]  # the log goes on after the goal of 0.8 m, as a real one


class Bench:
    """The program in a folder of its own."""

    def __init__(self, program, source, folder):
        self.program, self.folder = Path(program).resolve(), Path(folder)
        self.place = {
            "generator": "point_cloud",
            "file": str(Path(source).resolve() / "maps/thicket.pcd"),
            "bounds": {"lowest_m": [0, 0, 0], "highest_m": [24, 30, 6]},
            "flight_height_m": 2.2,
        }

    def run(self, *words):
        words = [str(word) for word in words]
        done = subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
        return done.stdout

    def write(self, name, content):
        (self.folder / name).write_text(json.dumps(content))
        return name

    def fly(self, file, name, changes=()):
        """Flies the sweep under this name into NAME.db."""
        words = [word for change in changes for word in ("--set", change)]
        self.run("run", file, "--quiet", "--db", f"{name}.db", "--set", f"sweep={name}", *words)

    def rows(self, name):
        """Trials of NAME.db by mission."""
        lines = self.run("export", "trials", f"{name}.db", "--format", "jsonl").splitlines()
        return {row["mission_index"]: row for row in sorted(map(json.loads, lines), key=lambda r: r["mission_index"])}

    def paths(self, name):
        """The flown paths of NAME.db by mission: rows as logs.read_tum() has them."""
        rows = self.rows(name)
        trials = [row["trial_id"] for row in rows.values()]
        self.run("export", "trajectory", f"{name}.db", *trials, "--format", "tum", "--output", f"{name}_paths/")
        folder = self.folder / f"{name}_paths"
        return {mission: logs.read_tum(folder / f"{row['trial_key'][:12]}.tum") for mission, row in rows.items()}

    def flights(self, name, recordings, position_noise_m, **smoothing):
        """A file of flights at the place."""
        sweep = {"seed": 24, "maps": self.place, "mission": {"free_radius_m": 0.8}, "planners": ["reactive"]}
        smoothing = {"position_noise_m": position_noise_m, **smoothing}
        content = {"flights": name, "sweep": sweep, "smoothing": smoothing, "recordings": recordings}
        return self.write(f"{name}.yaml", content)


def goal_of(row):
    return [row[f"goal_{axis}_m"] for axis in "xyz"]


@contextmanager
def bench(program, source):
    with tempfile.TemporaryDirectory() as folder:
        yield Bench(program, source, folder)
