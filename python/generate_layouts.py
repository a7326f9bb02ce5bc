#!/usr/bin/env python3
"""Writes python/avoidbench/_layouts.py: the structs and constants of planner.h and process_protocol.h, which are strict
C99 of one style.

    generate_layouts.py                     writes it
    generate_layouts.py --check COMPILER    fails where it is not up to date, or this C compiler lays structs out
                                            otherwise"""

import re
import subprocess
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADERS = ROOT / "lib/sdk/planner_api/avoidbench"
MODULE = ROOT / "python/avoidbench/_layouts.py"
# NumPy's names: a letter and the bytes, little-endian. Pointers are offsets in the segment.
TYPES = {
    "char": "S1",
    "int32_t": "i4",
    "ab_status": "i4",
    "uint32_t": "u4",
    "uint64_t": "u8",
    "double": "f8",
    "float": "f4",
    "pointer": "u8",
}
HEAD = '''\
"""Structs and constants of planner.h and process_protocol.h, written from them by python/generate_layouts.py. Fields as
name:type, with NumPy's names of types; a pointer is an offset in the segment (u8)."""

import numpy as np


def _struct(fields: str) -> np.dtype[np.void]:
    """Laid out as a C compiler does."""
    return np.dtype([(name, form) for name, form in (field.split(":") for field in fields.split())], align=True)


'''


def parsed(text: str) -> tuple[dict[str, str], dict[str, list[tuple[str, str, int]]]]:
    """Constants as Python writes them, and structs: a list of names, types and counts (0: no array)."""
    constants = {}
    for name, number, words in re.findall(r"^#define (A\w+) (?:\(?(-?\d+)u?\)?|(\".*\"))", text, re.MULTILINE):
        constants[name] = number or words
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    structs = {}
    for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", text, re.DOTALL):
        fields = structs[name] = []
        for line in filter(None, (" ".join(part.split()) for part in body.split(";"))):
            if function := re.search(r"\(\*(\w+)\)", line):
                fields.append((function[1], "pointer", 0))
                continue
            kind, names = re.fullmatch(r"((?:const )?\w+[ *]*(?:const ?\*)? ?)(\w.*)", line).groups()
            for declared in names.split(", "):
                field, count = re.fullmatch(r"(\w+)(?:\[(\d+)\])?", declared).groups()
                fields.append((field, "pointer" if "*" in kind else kind.strip(), int(count or 0)))
    return constants, structs


def module(constants: dict[str, str], structs: dict[str, list[tuple[str, str, int]]]) -> str:
    text = HEAD + "".join(f"{name} = {value}\n" for name, value in constants.items()) + "\n"
    for name, fields in structs.items():
        words = []
        for field, kind, count in fields:
            form = f"S{count}" if kind == "char" else f"{count or ''}{TYPES[kind]}"
            words.append(f"{field}:{form}")
        lines = textwrap.wrap(" ".join(words), 112)
        if len(name) + len(lines[0]) + 14 <= 120 and len(lines) == 1:
            text += f'{name} = _struct("{lines[0]}")\n'
        else:
            quoted = [f'    "{line} "\n' for line in lines[:-1]] + [f'    "{lines[-1]}"\n']
            text += f"{name} = _struct(\n{''.join(quoted)})\n"
    return text


def expectations(structs: dict[str, list[tuple[str, str, int]]]) -> str:
    """C that compiles where the compiler lays the structs out as NumPy does: each field at a multiple of its size."""
    lines = ["#include <stddef.h>", "#include <avoidbench/planner.h>", "#include <avoidbench/process_protocol.h>"]
    for name, fields in structs.items():
        end, widest = 0, 1
        for field, kind, count in fields:
            size = int(TYPES[kind][1:])
            at = -(-end // size) * size
            end, widest = at + size * (count or 1), max(widest, size)
            lines.append(f'_Static_assert(offsetof({name}, {field}) == {at}, "");')
        lines.append(f'_Static_assert(sizeof({name}) == {-(-end // widest) * widest}, "");')
    return "\n".join(lines)


def main() -> None:
    constants, structs = parsed("".join((HEADERS / name).read_text() for name in ("planner.h", "process_protocol.h")))
    text = module(constants, structs)
    if sys.argv[1:2] != ["--check"]:
        MODULE.write_text(text)
        return
    compiled = subprocess.run(
        [sys.argv[2], "-std=c11", f"-I{HEADERS.parent}", "-fsyntax-only", "-xc", "-"],
        input=expectations(structs),
        text=True,
    )
    is_old = MODULE.read_text() != text
    if is_old:
        print(f"{MODULE} is not up to date: run {Path(__file__).name}", file=sys.stderr)
    sys.exit(is_old or compiled.returncode != 0)


if __name__ == "__main__":
    main()
