#!/usr/bin/env python3
"""check_words.py: finds awkward wording in the pages, the program's messages and the public headers. CONTRIBUTING.md
has the list; each pattern below has a replacement."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
HABITS = {
    r"\banew\b": "again",
    r"\bbut for\b": "except",
    r"\btold\b(?! apart)": "reported, said",
    r"\b(?:is|are|was|were) wanted\b|\bif wanted\b": "expected, needed, requested",
    r"\b(?:that|which) (?:is|are) none\b": "invalid, no …",
    r"\b(?:an?|some) \w+ of (?:yours|ours|theirs|one's own|your own)\b": "your …, a custom …",
    r"\b(?:has|have|had) (?:no )?room\b": "fits, within the limit",
    r"\bsurely so\b": "significantly",
    r"\bin vain\b": "without success",
    r"\bin their turn\b": "in turn",
    r"\b(?:numbers|data|results) (?:can|can't|cannot) carry\b": "support",
    r"\bso many\b(?! )": "that number of",
}
# String literals of C++ and Python.
CPP_STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"')


def tracked(*patterns: str) -> list[str]:
    listed = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True)
    return listed.stdout.splitlines()


def read_texts(path: str) -> list[tuple[int, str]]:
    """The lines of a file that users read, with line numbers."""
    lines = (ROOT / path).read_text().splitlines()
    numbered = list(enumerate(lines, 1))
    if path.endswith(".md") or path.startswith("lib/sdk/"):
        return numbered
    return [(number, " ".join(CPP_STRING.findall(line))) for number, line in numbered]


def main() -> int:
    paths = tracked("*.md", "apps/*.cpp", "lib/*.cpp", "lib/*.hpp", "lib/sdk/planner_api/*", "python/avoidbench/*.py")
    found = 0
    for path in paths:
        # CONTRIBUTING.md has the list; results and the page's bundle are as a program wrote them.
        if path == "CONTRIBUTING.md" or path.startswith(("results/suites/", "results/published/", "apps/page/page_")):
            continue
        for number, text in read_texts(path):
            for habit, better in HABITS.items():
                for match in re.finditer(habit, text):
                    print(f'{path}:{number}: "{match.group(0)}": write {better}')
                    found += 1
    print(f"{len(paths)} files, {found} habits of wording")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
