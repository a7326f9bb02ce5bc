#!/usr/bin/env python3
"""Mutates the sources of rooms, one small change at a time, and runs each room's tests. Tests that miss the change
would miss a wrong result, too.

    scripts/mutate.py [ROOM…] [--count N] [--seed S] [--jobs N] [--again] [--list]

ROOM: a room of lib/, or a planner such as planners/ego; by default all that have tests in C++. The seed determines the
mutants, first a kind and then a place: `--count 20` begins with those of `--count 10`. Each is built in a copy of the
checkout (build/mutants/job0), so the checkout never changes, even if the run is killed. A mutant is killed when a test
fails or takes ten times as long as usual. Mutants that do not compile are not counted. Tests of suites named …Slow are
left out. Results are appended to build/mutants/results.jsonl as they come. An interrupted run resumes where it stopped,
without mutants already tried on the same file. --again retries survivors, after you have added tests."""

import argparse
import concurrent.futures
import contextlib
import fcntl
import hashlib
import itertools
import json
import os
import pathlib
import queue
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from dataclasses import asdict, dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
TRIED_MOST = 3  # times the requested number are tried at most, since many may not compile
MEMORY_BYTES = 16 << 30  # for a test that allocates without end


@dataclass(frozen=True)
class Mutant:
    file: str  # from the checkout's top
    line: int  # from 1
    column: int  # from 0
    kind: str
    old: str  # the whole line
    new: str
    digest: str  # of the file

    def key(self):
        return f"{self.file}:{self.line}:{self.column}:{self.kind}:{self.new}:{self.digest}"


UNREAD = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'""",
    re.S,
)
# Lines without behaviour that a test could see: checks for our own mistakes, declarations, reserved memory.
SKIPPED = re.compile(
    r"\s*(#|using |namespace |template|enum |friend |extern |alignas\()|.*\b(reserve\(|operator|constexpr bool is_|= default|= delete)"
)
CHECKED = re.compile(r"\s*(static_assert|AB_CHECK)\b")
NUMBER = re.compile(r"(?<![\w.'])(\d[\d']*(?:\.\d*)?(?:e[-+]?\d+)?)([uUlLfF]*)(?![\w.'>])")
PAIRS = {
    "arithmetic": [(" + ", " - "), (" * ", " / "), (" += ", " -= "), (" *= ", " /= ")],
    "comparison": [(" < ", " <= "), (" > ", " >= "), (" == ", " != ")],
    "logic": [(" && ", " || ")],
    "truth": [("true", "false")],
    "swap": [
        ("std::min(", "std::max("),
        ("min_element(", "max_element("),
        ("minCoeff(", "maxCoeff("),
        ("math::sin(", "math::cos("),
        ("std::floor(", "std::ceil("),
        ("lower_bound(", "upper_bound("),
        ("any_of(", "all_of("),
    ],
}
SWAPS = {kind: dict(pairs) | {b: a for a, b in pairs} for kind, pairs in PAIRS.items()}
SIGN = re.compile(r"(?:(?<=[(,=?:] )|(?<=[(\[{])|(?<=return ))-(?=[\w(])")
NOT = re.compile(r"(?<![\w!])!(?=[\w(])")
CONDITION = re.compile(r"\s*(?:\} else )?if \((?P<inner>[^;=]*(?:[=!<>]=[^;=]*)*)\)(?: \{| [^;]*;)?$")
STATEMENT = re.compile(
    r"\s*(?:if \(.*\) (?:[^;{]*);|(?!return|break|continue|throw|goto|case|default|delete)"
    r"(?:\+\+|--)?[a-z_][\w.:\[\]>-]*(?: (?:[-+*/|&]?=) .*|\(.*\));)$"
)


def without_words(text):
    """The text with comments blanked and literals as underscores; every character keeps its place."""

    def blank(found):
        fill = " " if found[0].startswith("/") else "_"
        return "".join(c if c == "\n" else fill for c in found[0])

    return UNREAD.sub(blank, text)


def other_number(digits):
    plain = digits.replace("'", "")
    if plain.isdigit():
        return {"0": "1", "1": "0"}.get(plain, str(int(plain) + 1))
    value = float(plain)
    return "1.0" if value == 0.0 else repr(value * 1.25)


def is_whole(condition):
    depths = list(itertools.accumulate({"(": 1, ")": -1}.get(character, 0) for character in condition))
    return min(depths) >= 0 and depths[-1] == 0


def changes(read, raw):
    """(kind, column, new line) of every change of a line; `read` is the line from without_words()."""

    def put(start, end, text):
        return raw[:start] + text + raw[end:]

    for kind, swaps in SWAPS.items():
        for old, new in swaps.items():
            for found in re.finditer(
                (r"\b" if old[0].isalpha() else "") + re.escape(old) + (r"\b" if old[-1].isalpha() else ""), read
            ):
                yield kind, found.start(), put(found.start(), found.end(), new)
    for found in NUMBER.finditer(read):
        yield "constant", found.start(), put(found.start(1), found.end(1), other_number(found[1]))
    for found in SIGN.finditer(read):
        yield "sign", found.start(), put(found.start(), found.end(), "")
    for found in NOT.finditer(read):
        yield "condition", found.start(), put(found.start(), found.end(), "")
    found = CONDITION.match(read)
    if found and is_whole(found["inner"]):
        start, end = found.span("inner")
        yield "condition", start, put(start, end, "!(" + raw[start:end] + ")")


def mutants_of(file, text):
    """Every mutant of a source file, by line."""
    digest = hashlib.sha256(text.encode()).hexdigest()[:16]
    raws, reads = text.split("\n"), without_words(text).split("\n")
    found, in_check, ended = [], False, True
    for number, (read, raw) in enumerate(zip(reads, raws), 1):
        code = read.rstrip()
        in_check = in_check or CHECKED.match(read) is not None
        if not code or in_check or SKIPPED.match(read):
            in_check = in_check and not code.endswith(";")
            ended = ended if not code else code.endswith((";", "{", "}"))
            continue
        lines = list(changes(read, raw))
        # A complete statement on one line: it begins after another's end.
        if ended and STATEMENT.match(code):
            lines.append(("statement", 0, raw[: len(raw) - len(raw.lstrip())] + ";"))
        found += [Mutant(file, number, column, kind, raw, new, digest) for kind, column, new in lines]
        ended = code.endswith((";", "{", "}", ":"))
    return found


def order_drawn(mutants, seed):
    """All of them in random order: each time a kind, then one of that kind, so that the many constants do not crowd out
    the rest."""
    generator = random.Random(seed)
    mutants = generator.sample(mutants, len(mutants))
    kinds = {
        kind: [mutant for mutant in mutants if mutant.kind == kind]
        for kind in sorted({mutant.kind for mutant in mutants})
    }
    drawn = []
    while left := [members for members in kinds.values() if members]:
        drawn.append(generator.choice(left).pop())
    return drawn


def folder_of(root, room):
    return root / room if room.startswith("planners/") else next((root / "lib").glob(f"*/{room}"), root / "lib" / room)


def drawn_in(root, room, seed):
    files = sorted(file for file in folder_of(root, room).rglob("*") if file.suffix in (".cpp", ".hpp", ".h"))
    mutants = [mutant for file in files for mutant in mutants_of(str(file.relative_to(root)), file.read_text())]
    return order_drawn(mutants, f"{seed}/{room}")


running = set()  # process groups


def finished_in(command, folder, seconds, environment=None):
    """(exit code, output) of a command and everything it started; code None: timeout."""

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))

    process = subprocess.Popen(
        command,
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
        preexec_fn=limit,
    )
    running.add(process.pid)
    try:
        said = process.communicate(timeout=seconds)[0]
        return process.returncode, said
    except subprocess.TimeoutExpired:
        return None, ""
    finally:
        end(process.pid)
        process.wait()
        running.discard(process.pid)


def end(group):
    with contextlib.suppress(ProcessLookupError):
        os.killpg(group, signal.SIGKILL)


class Copy:
    """A copy of the checkout with its own build."""

    def __init__(self, root, folder):
        self.source, self.build = folder / "source", folder / "build"
        # Only what differs is written, so little is rebuilt. This also restores changes of an interrupted run.
        listed = subprocess.run(
            ["git", "ls-files", "-coz", "--exclude-standard"], cwd=root, check=True, capture_output=True, text=True
        ).stdout
        names = {name for name in listed.split("\0") if name and (root / name).is_file()}
        for file in [file for file in self.source.rglob("*") if not file.is_dir()]:
            if str(file.relative_to(self.source)) not in names:
                file.unlink()
        for name in sorted(names):
            to = self.source / name
            if not to.is_file() or to.read_bytes() != (root / name).read_bytes():
                to.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(root / name, to)

    def make(self, target, is_mutant=False):
        environment = {**os.environ, "CCACHE_NOHASHDIR": "1", "CCACHE_BASEDIR": str(self.source.parent)}
        if is_mutant:
            environment["CCACHE_READONLY"] = "1"  # a mutant's objects are useless later; others come from the cache
        if not (self.build / "build.ninja").is_file():
            # Without unity, a mutant is one object to compile.
            options = [f"-DAVOIDBENCH_{name}=OFF" for name in ("BENCH", "PAGE", "UNITY", "WERROR")]
            code, said = finished_in(
                ["cmake", "--preset", "release", "-B", self.build, *options], self.source, 600, environment
            )
            if code != 0:
                return code, said
        return finished_in(
            ["cmake", "--build", self.build, "--parallel", "1" if is_mutant else "2", "--target", target],
            self.source,
            7200,
            environment,
        )

    @contextlib.contextmanager
    def mutated(self, mutant):
        file = self.source / mutant.file
        text = file.read_text()
        lines = text.split("\n")
        assert lines[mutant.line - 1] == mutant.old, mutant
        lines[mutant.line - 1] = mutant.new
        file.write_text("\n".join(lines))
        try:
            yield
        finally:
            file.write_text(text)


def target_of(room):
    return {"planners/common": "planner_common"}.get(room, re.sub("planners/(.*)", r"\1_planner", room)) + "_tests"


def tested(copy, room, seconds):
    slow = "-*Slow.*" + (":*.Clears*:*.GetsOutOfADeadEnd" if room.startswith("planners/") else "")
    folder = copy.build / "tests" / room
    return finished_in(
        [folder / target_of(room), "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={slow}"], folder, seconds
    )


def tried(copy, room, mutant, seconds):
    """The record of one mutant."""
    began = time.monotonic()
    with copy.mutated(mutant):
        outcome, by = "not viable", ""
        if copy.make(target_of(room), is_mutant=True)[0] == 0:
            code, said = tested(copy, room, seconds)
            failed = re.search(r"\[  FAILED  \] ([\w./]+)", said)
            outcome = "living" if code == 0 else "killed"
            by = "" if code == 0 else "time" if code is None else failed[1] if failed else f"exit code {code}"
    return {
        "key": mutant.key(),
        "room": room,
        "outcome": outcome,
        "by": by,
        "seconds": round(time.monotonic() - began, 1),
        **asdict(mutant),
    }


def rooms_with_tests(root):
    lines = (root / "lib/ORDER").read_text().splitlines()
    rooms = [line.partition(":")[0].partition("/")[2] for line in lines if line and not line.startswith("#")]
    rooms += sorted(f"planners/{folder.name}" for folder in (root / "planners").iterdir() if folder.is_dir())
    return [
        room for room in rooms if any((root / "tests" / room).glob("*_test.cpp")) and folder_of(root, room).is_dir()
    ]


def known_results(file):
    known = {}
    for line in file.read_text().splitlines():
        with contextlib.suppress(ValueError):  # half a line of an interrupted run
            record = json.loads(line)
            known[record["key"]] = record
    return known


def show(room, records, shows_living=True):
    viable = [record for record in records if record["outcome"] != "not viable"]
    living = [record for record in viable if record["outcome"] == "living"]
    for record in living if shows_living else []:
        print(f"\nliving {record['file']}:{record['line']} ({record['kind']})\n-{record['old']}\n+{record['new']}")
    killed = len(viable) - len(living)
    share = f"{100 * killed / len(viable):.0f} %" if viable else "none"
    return f"{room:24} {killed:4} killed {len(living):4} living {len(records) - len(viable):4} not viable {share:>6}"


def run_room(copy, room, arguments, known, out, lock):
    """The room's records, with the requested number of viable ones."""
    code, said = copy.make(target_of(room))
    began = time.monotonic()
    if code == 0:
        code, said = tested(copy, room, 3600)
    if code != 0:
        raise SystemExit(f"{room}: tests fail without a mutant:\n{said[-4000:]}")
    seconds = 30 + 10 * (time.monotonic() - began)
    records = []
    for mutant in drawn_in(copy.source, room, arguments.seed)[: TRIED_MOST * arguments.count]:
        if sum(record["outcome"] != "not viable" for record in records) == arguments.count:
            break
        record = known.get(mutant.key())
        if record is None or (arguments.again and record["outcome"] == "living"):
            record = tried(copy, room, mutant, seconds)
            with lock:
                out.write(json.dumps(record) + "\n")
                out.flush()
                print(
                    f"{record['outcome']:10} {mutant.file}:{mutant.line} {mutant.kind} {record['seconds']} s "
                    f"{record['by']}",
                    flush=True,
                )
        records.append(record)
    return records


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rooms", nargs="*", metavar="ROOM")
    parser.add_argument("--count", type=int, default=10, help="mutants per room that compile (10)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, help="rooms in parallel, each in its own copy")
    parser.add_argument("--again", action="store_true", help="retry survivors")
    parser.add_argument("--list", action="store_true", help="list the mutants, build nothing")
    parser.add_argument(
        "--folder", type=pathlib.Path, default=ROOT / "build/mutants", help="copies and results (build/mutants)"
    )
    arguments = parser.parse_args()
    rooms = arguments.rooms or rooms_with_tests(ROOT)
    unknown = sorted(set(rooms) - set(rooms_with_tests(ROOT)))
    if unknown:
        parser.error(f"no room with tests in C++: {', '.join(unknown)}; there are {', '.join(rooms_with_tests(ROOT))}")
    if arguments.list:
        for mutant in (mutant for room in rooms for mutant in drawn_in(ROOT, room, arguments.seed)[: arguments.count]):
            print(f"{mutant.file}:{mutant.line} ({mutant.kind})\n-{mutant.old}\n+{mutant.new}")
        return
    arguments.folder.mkdir(parents=True, exist_ok=True)
    results = arguments.folder / "results.jsonl"
    out = results.open("a")
    try:
        fcntl.flock(out, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        parser.error(f"another run is writing {results}: give --folder")
    known, lock, copies, by_room = known_results(results), threading.Lock(), queue.SimpleQueue(), {}
    for job in range(min(arguments.jobs, len(rooms))):
        copies.put(Copy(ROOT, arguments.folder / f"job{job}"))

    def run(room):
        copy = copies.get()
        try:
            by_room[room] = run_room(copy, room, arguments, known, out, lock)
        except SystemExit as error:
            print(error, file=sys.stderr)
        finally:
            copies.put(copy)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        try:
            list(pool.map(run, rooms))
        except KeyboardInterrupt:
            for group in list(running):
                end(group)
            os._exit(130)  # the threads would continue with the next mutant
    lines = [show(room, by_room[room]) for room in rooms if room in by_room]
    lines.append(show("all", [record for room in by_room for record in by_room[room]], shows_living=False))
    print("\n" + "\n".join(lines) + f"\nall results: {results}")


if __name__ == "__main__":
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)  # also in the background, where shells have SIGINT ignored
    main()
