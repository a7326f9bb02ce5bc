#!/usr/bin/env python3
"""instruction_counts.py PROGRAM MADE_BY [--bless]: do the hot loops take as many instructions as they did?

Seconds on a shared machine say little about a few percent; instructions are the same on a busy one. Each work of
counted_work.cpp runs under callgrind, which counts what happens within its function counted_work(), and is compared
with counts.json: more than TOLERANCE above is a failure, as much below asks to bless, so that the gain is kept.

Counts hold for MADE_BY: a compiler and the versions of libraries. Where there are none of these, nothing is compared
(exit code 77). `--bless` writes them. On an x86-64 processor without AVX2 other code runs: 77, too.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

COUNTS = pathlib.Path(__file__).with_name("counts.json")
# Other allocations, other strings: below half a percent. A lost inlining is far above.
TOLERANCE = 0.03


def count(program, work):
    """Instructions a unit of this work."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        run = subprocess.run(
            [
                "valgrind",
                "--tool=callgrind",
                "--toggle-collect=counted_work",
                f"--callgrind-out-file={out}",
                program,
                work,
            ],
            capture_output=True,
            text=True,
        )
        if run.returncode != 0:
            sys.exit(f"{work}: exit code {run.returncode}\n{run.stderr[-2000:]}")
        total = int(re.search(r"^(?:totals|summary): (\d+)", out.read_text(), re.MULTILINE).group(1))
        return total / float(re.search(r"^units (\S+)$", run.stdout, re.MULTILINE).group(1))


def compare(counted, blessed):
    """Lines of a table, and what is wrong: a list of sentences."""
    lines, wrong = [], []
    for work in sorted(counted | blessed):
        if work not in blessed:
            wrong.append(f"{work}: no count is blessed for it")
        elif work not in counted:
            wrong.append(f"{work}: a count is blessed, but there is no such work")
        else:
            change = counted[work] / blessed[work] - 1
            lines.append(f"{work:20} {counted[work]:14.1f} {blessed[work]:14.1f} {change:+8.2%}")
            if change > TOLERANCE:
                wrong.append(f"{work}: {change:+.1%} instructions, more than {TOLERANCE:.0%}")
            elif change < -TOLERANCE:
                wrong.append(f"{work}: {change:+.1%} instructions: a gain. Bless it, so that it is not lost again")
    return lines, wrong


def main(arguments):
    bless = "--bless" in arguments
    program, made_by = [argument for argument in arguments if argument != "--bless"]
    if " avx2 " not in pathlib.Path("/proc/cpuinfo").read_text():
        print("no AVX2 here: other code runs than was counted")
        return 77
    all_counts = json.loads(COUNTS.read_text()) if COUNTS.exists() else {}
    if made_by not in all_counts and not bless:
        print(f"no counts for {made_by}; to write them: {sys.argv[0]} {program} '{made_by}' --bless")
        return 77
    works = subprocess.run([program], capture_output=True, text=True, check=True).stdout.split()
    counted = {work: round(count(program, work), 1) for work in works}
    if bless:
        all_counts[made_by] = counted
        COUNTS.write_text(json.dumps(all_counts, indent=2, sort_keys=True) + "\n")
        print(f"written: {COUNTS}")
        return 0
    lines, wrong = compare(counted, all_counts[made_by])
    print(f"{'instructions a unit':20} {'now':>14} {'blessed':>14} {'change':>8}")
    print("\n".join(lines + wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
