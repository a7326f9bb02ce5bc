#!/usr/bin/env python3
"""Colours of planners are the same in pages and figures, and colour-blind people tell them apart.

usage: check_colors.py FOLDER_OF_THE_PROJECT
"""

import itertools
import pathlib
import re
import sys

# Machado, Oliveira and Fernandes (2009), severity 1: what protanopes, deuteranopes and tritanopes see, in linear RGB.
SEEN = {
    "everybody": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "protanopes": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
    "deuteranopes": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
    "tritanopes": ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900)),
}
XYZ = ((0.4124564, 0.3575761, 0.1804375), (0.2126729, 0.7151522, 0.0721750), (0.0193339, 0.1191920, 0.9503041))
WHITE = (0.95047, 1.0, 1.08883)
LEAST = 12.0  # CIE 1976 colour difference; 2.3 is just noticeable side by side


def times(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def lab(colour, seen):
    encoded = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in encoded]
    xyz = times(XYZ, [min(1.0, max(0.0, c)) for c in times(SEEN[seen], linear)])
    x, y, z = (
        v ** (1 / 3) if v > 216 / 24389 else (24389 / 27 * v + 16) / 116 for v in (a / b for a, b in zip(xyz, WHITE))
    )
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def colours(file, name):
    found = re.search(name + r" = \[([^\]]*)\]", file.read_text())
    return re.findall(r"#[0-9a-f]{6}", found.group(1))


def main():
    folder = pathlib.Path(sys.argv[1])
    page = folder / "apps/page/src/data.ts"
    lists = {name: colours(page, name) for name in ("kPlannerColors", "kBrightColors", "kOutcomeColors")}
    problems = []
    if lists["kPlannerColors"] != colours(folder / "scripts/plot/style.py", "_COLOURS"):
        problems.append("pages and figures have other colours for the same planners")
    if len(lists["kPlannerColors"]) != len(lists["kBrightColors"]):
        problems.append("a dark page has another number of colours")
    outcomes = lists["kOutcomeColors"]
    pairs = {name: list(itertools.combinations(found, 2)) for name, found in lists.items()}
    for name in ("kPlannerColors", "kBrightColors"):
        pairs[f"{name} and kOutcomeColors"] = list(itertools.product(lists[name], outcomes))
    for name, both in pairs.items():
        for seen in SEEN:
            for a, b in both:
                difference = sum((x - y) ** 2 for x, y in zip(lab(a, seen), lab(b, seen))) ** 0.5
                if difference < LEAST:
                    problems.append(f"{name}: {a} and {b} are alike to {seen} ({difference:.1f})")
    print("\n".join(problems) or f"{sum(map(len, lists.values()))} colours are told apart")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
