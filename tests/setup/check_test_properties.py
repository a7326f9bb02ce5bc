#!/usr/bin/env python3
"""Every test that ctest knows has a time limit, the label of its room, and a name in the one style.

usage: check_test_properties.py CTEST BUILD_FOLDER

Names: folder.a_script for scripts; room_or_planner.Suite.TestInCamelCase for C++, where generated parts may stand
before the suite and behind the test: room.Each/Suite.Test/what. A test is `slow` if its suite's name ends in Slow;
scripts say so themselves."""

import json
import re
import subprocess
import sys

SCRIPT = re.compile(r"[a-z_]+\.[a-z0-9_]+")
CASE = re.compile(
    r"[a-z_]+\.([A-Za-z0-9]+/)?(?P<suite>[A-Z][A-Za-z0-9]*)(/[A-Za-z0-9_]+)?\.[A-Z][A-Za-z0-9]*(/[A-Za-z0-9_]+)?"
)


def problems_of(test):
    values = {one["name"]: one["value"] for one in test.get("properties", [])}
    labels = [label for label in values.get("LABELS", []) if label != "slow"]
    is_slow = "slow" in values.get("LABELS", [])
    if not values.get("TIMEOUT"):
        yield "no TIMEOUT"
    if len(labels) != 1:
        yield f"one label is wanted besides slow, not {labels}"
    case = CASE.fullmatch(test["name"])
    if not case and not SCRIPT.fullmatch(test["name"]):
        yield "a name in another style"
    if case and is_slow != case["suite"].endswith("Slow"):
        yield f"slow is {is_slow}"


def main():
    ctest, build = sys.argv[1:]
    shown = subprocess.run(
        [ctest, "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=True
    )
    # What is not built yet stands there as one test without properties, and fails by itself.
    tests = [test for test in json.loads(shown.stdout)["tests"] if not test["name"].endswith("_NOT_BUILT")]
    if not any(CASE.fullmatch(test["name"]) for test in tests):
        sys.exit("no C++ test is built")
    found = [f"{test['name']}: {problem}" for test in tests for problem in problems_of(test)]
    print("\n".join(found))
    print(f"{len(tests)} tests, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
