#!/usr/bin/env python3
"""auditwheel, except that it assumes only the C and C++ libraries on the target system: a small system lacks X11 and
zlib, which OpenCV's core is linked to in Debian. The wheel also gets the licence texts of everything it contains, as
in Debian's packages.

usage: same as auditwheel"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from auditwheel import main, policy, repair

EXPECTED = {"libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1", "libgcc_s.so.1", "libstdc++.so.6"}
HEADERS = ("libeigen3-dev", "nlohmann-json3-dev", "libcli11-dev")  # in the program, without a library
DOCS, COMMON = pathlib.Path("/usr/share/doc"), pathlib.Path("/usr/share/common-licenses")


def package_of(library):
    """The package that a file belongs to. Packages name files below /lib or /usr/lib, which are one folder."""
    real = library.resolve()
    for name in (real, library, pathlib.Path("/") / real.relative_to("/usr") if real.is_relative_to("/usr") else real):
        found = subprocess.run(["dpkg", "-S", name], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.partition(":")[0]
    raise SystemExit(f"repair_wheel.py: no package contains {library}, so its licence is unknown: install the package")


def take_licence(package, folder):
    """The package's copyright file, and the system's common licences that it names."""
    copyright_file = DOCS / package / "copyright"
    if not copyright_file.is_file():
        raise SystemExit(f"repair_wheel.py: {copyright_file} is missing, and the wheel needs its licence text")
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(copyright_file, folder / f"{package}.txt")
    text = copyright_file.read_text(encoding="utf-8", errors="replace")
    for name in set(re.findall(rf"{COMMON}/([\w.+-]*\w)", text)):
        if (COMMON / name).is_file():
            shutil.copyfile(COMMON / name, folder / f"{name}.txt")


def take_nanobind_licence(folder):
    from importlib.metadata import files

    for file in files("nanobind") or []:
        if file.parent.name == "licenses":
            shutil.copyfile(file.locate(), folder / "nanobind.txt")
            return
    raise SystemExit("repair_wheel.py: nanobind's licence is missing")


def with_licences(copy_library):
    """auditwheel's copylib, in the unpacked wheel's folder, which contains `dest_dir`."""

    def copy(src_path, dest_dir, patcher):
        folder = next(dest_dir.absolute().parent.glob("*.dist-info")) / "licenses" / "of-others"
        if not folder.exists():
            for package in HEADERS:
                take_licence(package, folder)
            take_nanobind_licence(folder)
        take_licence(package_of(src_path), folder)
        return copy_library(src_path, dest_dir, patcher)

    return copy


if __name__ == "__main__":
    repair.copylib = with_licences(repair.copylib)
    with tempfile.TemporaryDirectory() as folder:
        for libc, file in policy._POLICY_JSON_MAP.items():
            policies = json.loads(file.read_text())
            for one in policies:
                one["lib_whitelist"] = [library for library in one["lib_whitelist"] if library in EXPECTED]
            changed = pathlib.Path(folder) / file.name
            changed.write_text(json.dumps(policies))
            policy._POLICY_JSON_MAP[libc] = changed
        sys.exit(main.main())
