#!/usr/bin/env python3
"""Checks that each CSV file is of the dialect that docs/exports.md names: RFC 4180, quotes only where they are needed.

usage: check_csv.py FILE…

Lines before the header that begin with # are comments, which tables of trials for `avoidbench compare` have; they end
as rows do."""

import csv
import io
import pathlib
import sys


def check(file):
    """What is wrong with the file, or nothing."""
    text = pathlib.Path(file).read_bytes().decode()
    if text.startswith("\ufeff"):
        return "begins with a byte order mark"
    while text.startswith("#"):
        comment, _, text = text.partition("\n")
        if not comment.endswith("\r"):
            return "a comment does not end with CR LF"
    rows = list(csv.reader(io.StringIO(text, newline=""), strict=True))
    if len(rows) < 2:
        return "has no rows"
    sizes = sorted({len(row) for row in rows})
    if len(sizes) > 1:
        return f"rows of {', '.join(map(str, sizes))} fields"
    if text.replace("\r\n", "").count("\n") > sum(
        field.replace("\r\n", "").count("\n") for row in rows for field in row
    ):
        return "a line does not end with CR LF"
    again = io.StringIO(newline="")
    csv.writer(again).writerows(rows)  # its dialect by default: CR LF, as few quotes as can be
    if again.getvalue() != text:
        return "written otherwise than by Python's csv module"
    return None


problems = [f"{file}: {problem}" for file in sys.argv[1:] if (problem := check(file))]
if problems:
    sys.exit("\n".join(problems))
print(f"{len(sys.argv) - 1} files of one dialect")
