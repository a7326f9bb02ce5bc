#!/usr/bin/env python3
"""scripts/mutate.py draws the same mutants twice, only where code is, and changes nothing but its copy: on a small
sample, without a build.

usage: mutate.py SOURCE_FOLDER
"""

import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile

SAMPLE = """#include "a < b.hpp"
// x = y + 1; stays
/* so does
   if (x < y) z = 1; */
static_assert(sizeof(int) + 1 < 8);
double tangled(double x, bool is_so) {
  AB_CHECK(x > 0.0 && is_so,
           x + 1.0);
  const char* words = "1 + 2 < 3";
  double sum_m = 0.5;
  sum_m += std::max(x, -1.5 * x);
  if (is_so && x < 2.0) sum_m = 0.0;
  if (!is_so) {
    note(sum_m);
  }
  return sum_m;
}
"""
EXPECTED = {  # line, what is there afterwards
    (10, "  double sum_m = 0.625;"),
    (11, "  sum_m -= std::max(x, -1.5 * x);"),
    (11, "  sum_m += std::min(x, -1.5 * x);"),
    (11, "  sum_m += std::max(x, 1.5 * x);"),
    (11, "  sum_m += std::max(x, -1.5 / x);"),
    (11, "  sum_m += std::max(x, -1.875 * x);"),
    (11, "  ;"),
    (12, "  if (is_so || x < 2.0) sum_m = 0.0;"),
    (12, "  if (is_so && x <= 2.0) sum_m = 0.0;"),
    (12, "  if (is_so && x < 2.5) sum_m = 0.0;"),
    (12, "  if (is_so && x < 2.0) sum_m = 1.0;"),
    (12, "  if (!(is_so && x < 2.0)) sum_m = 0.0;"),
    (12, "  ;"),
    (13, "  if (is_so) {"),
    (13, "  if (!(!is_so)) {"),
    (14, "    ;"),
}


def expect(is_so, what):
    if not is_so:
        sys.exit(f"mutate.py: {what}")


def check_drawing(mutate):
    drawn = mutate.mutants_of("lib/little/a.cpp", SAMPLE)
    found = {(mutant.line, mutant.new) for mutant in drawn}
    expect(found == EXPECTED, f"too many {sorted(found - EXPECTED)}, missing {sorted(EXPECTED - found)}")
    order = mutate.order_drawn(drawn, "1/little")
    expect(sorted(order, key=lambda m: m.key()) == sorted(drawn, key=lambda m: m.key()), "each mutant is drawn once")
    expect(order == mutate.order_drawn(drawn, "1/little"), "a seed draws the same twice")
    expect(order != mutate.order_drawn(drawn, "2/little"), "another seed draws others")


def check_copy(mutate, root, folder):
    sources = {file: file.read_bytes() for file in root.rglob("*.cpp")}
    file = "lib/little/a.cpp"
    copy = mutate.Copy(root, folder)
    text = (copy.source / file).read_text()
    mutant = mutate.drawn_in(root, "little", 1)[0]
    with copy.mutated(mutant):
        there = (copy.source / file).read_text()
        changed = [(a, b) for a, b in zip(text.split("\n"), there.split("\n")) if a != b]
        expect(changed == [(mutant.old, mutant.new)], f"one line is another: {changed}")
    # A run that was killed leaves its mutant and whatever else in the copy: the next one begins with the checkout's
    # files.
    (copy.source / file).write_text(there)
    (copy.source / "lib/little/b.cpp").write_text("int b;\n")
    copy = mutate.Copy(root, folder)
    expect(
        (copy.source / file).read_text() == text and not (copy.source / "lib/little/b.cpp").exists(),
        "a new copy is the checkout again",
    )

    expect(mutate.finished_in(["sh", "-c", "echo so; exit 3"], folder, 60) == (3, "so\n"), "a command's code and words")
    expect(mutate.finished_in(["sleep", "60"], folder, 0.1)[0] is None, "a command that takes too long is ended")
    for built, tests, outcome in ((1, 0, "not viable"), (0, 0, "living"), (0, 1, "killed"), (0, None, "killed")):
        seen = []
        copy.make = lambda target, is_mutant, built=built: (built, seen.append((copy.source / file).read_text()))
        mutate.tested = lambda *_, tests=tests: (tests, "[  FAILED  ] Little.Sum\n" if tests else "")
        record = mutate.tried(copy, "little", mutant, 1.0)
        expect(record["outcome"] == outcome and seen[0] != text, f"{record} instead of {outcome}")
        expect(json.loads(json.dumps(record))["key"] == mutant.key(), "a record is JSON")
        expect((copy.source / file).read_text() == text, "the mutant is gone afterwards")
    expect({file: file.read_bytes() for file in root.rglob("*.cpp")} == sources, "the checkout never changes")


def main():
    script = pathlib.Path(sys.argv[1], "scripts/mutate.py")
    sys.dont_write_bytecode = True
    spec = importlib.util.spec_from_file_location("mutate", script)
    mutate = importlib.util.module_from_spec(spec)
    sys.modules["mutate"] = mutate
    spec.loader.exec_module(mutate)
    check_drawing(mutate)
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name, "checkout")
        (root / "lib/little").mkdir(parents=True)
        (root / "lib/little/a.cpp").write_text(SAMPLE)
        subprocess.run(["git", "init", "--quiet", root], check=True)
        check_copy(mutate, root, pathlib.Path(name, "job0"))
        results = pathlib.Path(name, "results.jsonl")
        results.write_text('{"key": "a", "outcome": "living"}\n{"key": "a", "outcome": "killed"}\n{"key": "b", "out')
        expect(
            mutate.known_results(results) == {"a": {"key": "a", "outcome": "killed"}},
            "the last whole record of each counts",
        )
    listed = subprocess.run(
        [script, "table", "--list", "--count", "5"], check=True, capture_output=True, text=True
    ).stdout
    expect(
        listed.count("\n-") == 5 and listed.startswith("lib/base/table/"), f"--list shows five of room table: {listed}"
    )


if __name__ == "__main__":
    main()
