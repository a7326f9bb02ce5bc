#!/usr/bin/env python3
"""Names the shared libraries that a planner's library needs and that ask for clocks or chance of their own, which the
runtime does not replace. It never fails a build.

    warn_of_clocks.py --nm NM --readelf READELF LIBRARY.so"""

import argparse
import pathlib
import re
import subprocess
import sys

# The name of an undefined symbol, for libraries of C++ its beginning -> what people call it
ASKED = {
    "clock_gettime": "clock_gettime",
    "gettimeofday": "gettimeofday",
    "time": "time",
    "clock": "clock",
    "timespec_get": "timespec_get",
    "nanosleep": "nanosleep",
    "clock_nanosleep": "clock_nanosleep",
    "usleep": "usleep",
    "rand": "rand",
    "random": "random",
    "_ZNSt6chrono3_V212steady_clock3nowEv": "steady_clock::now",
    "_ZNSt6chrono3_V212system_clock3nowEv": "system_clock::now",
    "_ZNSt13random_device9_M_getval": "std::random_device",
}
# They ask for logs, locks and files of their own.
HARMLESS = re.compile(
    r"(lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|c\+\+|opencv_\w+|pcl_\w+|boost_(?!chrono)\w+|[atlu]san|clang_rt\S*)|ld-\S+)\.so\b.*"
)


def output_of(*words):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=60)
    return done.stdout if done.returncode == 0 else ""


def is_of(symbol, asked):
    return symbol.startswith(asked) if asked.startswith("_Z") else symbol == asked


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nm", required=True)
    parser.add_argument("--readelf", required=True)
    parser.add_argument("library", type=pathlib.Path)
    asked = parser.parse_args()
    needed = re.findall(r"\(NEEDED\).*\[(.+)\]", output_of(asked.readelf, "-d", asked.library))
    places = dict(re.findall(r"(\S+) => (/\S+)", output_of("ldd", asked.library)))
    for name in needed:
        if HARMLESS.fullmatch(name) or name not in places:
            continue
        symbols = [line.split()[-1].split("@")[0] for line in output_of(asked.nm, "-Du", places[name]).splitlines()]
        found = [word for symbol, word in ASKED.items() if any(is_of(one, symbol) for one in symbols)]
        if found:
            print(
                f"warning: {name}, which {asked.library.name} needs, asks for {', '.join(found)}: where that decides "
                "an answer, flights don't repeat. Link it statically (docs/ros.md, Solvers with time limits)."
            )
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, subprocess.SubprocessError) as error:
        print(f"note: the libraries that it needs were not looked at: {error}")
