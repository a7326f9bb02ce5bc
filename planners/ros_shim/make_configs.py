#!/usr/bin/env python3
"""Writes C++ headers of dynamic_reconfigure from .cfg files, as ROS names them: PACKAGE/cfg/Fly.cfg that ends with
generate(PACKAGE, node, "Fly") becomes PACKAGE/FlyConfig.h with PACKAGE::FlyConfig.

    make_configs.py --out FOLDER PACKAGE…    PACKAGE: a folder with cfg/*.cfg, or one such file

A .cfg file is a program in Python, which is run here as it is, with a stand-in for dynamic_reconfigure's generator.
Needs Python 3 alone. Written in C++14."""

import argparse
import contextlib
import io
import math
import pathlib
import re
import sys
import traceback
import types

from make_messages import KEYWORDS, NAME, Problem, package_files, quoted, write

# dynamic_reconfigure's name -> (C++ type, its kind in Python, value where none is given)
TYPES = {
    "int": ("int", int, 0),
    "double": ("double", float, 0.0),
    "str": ("std::string", str, ""),
    "bool": ("bool", bool, False),
}
ENDS = {"int": (-(2**31), 2**31 - 1), "double": (-math.inf, math.inf), "bool": (False, True), "str": ("", "")}
NO_TEXT = re.compile("[\0\ud800-\udfff]")  # ends a text in C++, or is none in UTF-8
STAND_INS = ("parameter_generator_catkin", "parameter_generator")


class Parameter:
    def __init__(self, name, kind, level, default, low, high):
        self.name, self.kind, self.level = name, kind, level
        self.default, self.low, self.high = default, low, high


class Config:
    """What a .cfg file has said so far."""

    def __init__(self, package, file):
        self.package, self.file = package, file
        self.space = self.name = None
        self.parameters, self.constants = [], {}

    def problem(self, text):
        """With the line of the .cfg file that runs now."""
        frame = sys._getframe(1)
        while frame is not None and frame.f_code.co_filename != str(self.file):
            frame = frame.f_back
        return Problem(f"{self.file}:{frame.f_lineno if frame else 1}: {text}")

    def named(self, name, what):
        if not isinstance(name, str) or not NAME.fullmatch(name):
            raise self.problem(f'"{name}" is no name of a {what}: letters, digits and _, a letter first')
        if name in KEYWORDS:
            raise self.problem(f'"{name}" is a word of C++')
        return name

    def value(self, kind, value, what):
        """The value as this kind; as in ROS whole numbers serve as numbers, 0 and 1 as bools."""
        if kind not in TYPES:
            raise self.problem(f'"{kind}" is no type: {", ".join(f"{one}_t" for one in TYPES)}')
        wanted = TYPES[kind][1]
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        good = (
            isinstance(value, wanted) and (kind == "bool" or not isinstance(value, bool))
            or kind == "double" and is_number
            or kind == "int" and is_number and value == math.floor(value)
            or kind == "bool" and is_number and value in (0, 1)
        )  # fmt: skip
        if not good or value != value:
            raise self.problem(f"{what} is {value!r}, which is no {kind}")
        if kind == "str" and NO_TEXT.search(value):
            raise self.problem(f"{what} has a character that can't stand in a text")
        if kind in ("int", "double") and not ENDS[kind][0] <= value <= ENDS[kind][1]:
            raise self.problem(f"{what} is {value!r}, which is beyond 32 bits")
        return wanted(value)


class Group:
    """A group of parameters, and all of them: FlyConfig has those of all groups side by side."""

    def __init__(self, config):
        self._config = config

    def add(self, name, paramtype, level, description, default=None, min=None, max=None, edit_method=""):
        config = self._config
        config.named(name, "parameter")
        if any(name == other.name for other in config.parameters):
            raise config.problem(f'"{name}" is there already')
        if paramtype == "str" and (min is not None or max is not None):
            raise config.problem(f'"{name}" is a text: it has no min and no max')
        level = config.value("int", level, f"the level of {name}")
        values = [
            config.value(paramtype, preset if value is None else value, f"{what} of {name}")
            for what, value, preset in (
                ("default", default, TYPES[paramtype][2] if paramtype in TYPES else None),
                ("min", min, ENDS[paramtype][0] if paramtype in TYPES else None),
                ("max", max, ENDS[paramtype][1] if paramtype in TYPES else None),
            )
        ]
        if values[1] > values[2]:
            raise config.problem(f"min of {name} is above its max")
        config.parameters.append(Parameter(name, paramtype, level, *values))

    def add_group(self, name, type="", state=True):
        self._config.named(name.replace(" ", "_") if isinstance(name, str) else name, "group")
        return Group(self._config)


class ParameterGenerator(Group):
    """The stand-in for dynamic_reconfigure's."""

    config = None  # that of the .cfg file that runs

    def __init__(self):
        super().__init__(ParameterGenerator.config)

    def const(self, name, type, value, descr):
        config = self._config
        config.named(name, "constant")
        config.value(type, value, name)
        if name in config.constants:
            raise config.problem(f'"{name}" is there already')
        config.constants[name] = (type, value)
        return {"name": name, "type": type, "value": value, "description": descr}

    def enum(self, constants, description):
        return repr({"enum": constants, "enum_description": description})

    def generate(self, pkgname, nodename, name):
        config = self._config
        if config.name is not None:
            raise config.problem("a second generate(): a .cfg file makes one configuration")
        config.space, config.name = config.named(pkgname, "package"), config.named(name, "configuration")
        return 0


def stand_ins():
    """Modules that .cfg files import, by name."""
    modules = {"dynamic_reconfigure": types.ModuleType("dynamic_reconfigure"), "roslib": types.ModuleType("roslib")}
    modules["roslib"].load_manifest = lambda package: None
    for name in STAND_INS:
        module = types.ModuleType(f"dynamic_reconfigure.{name}")
        module.ParameterGenerator, module.sys = ParameterGenerator, sys
        for kind in TYPES:
            setattr(module, f"{kind}_t", kind)
        setattr(modules["dynamic_reconfigure"], name, module)
        modules[module.__name__] = module
    return modules


def line_of(error, file):
    """The line of the file that was run when this came."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(file)]
    return lines[-1] if lines else 1


def read_config(package, file):
    """What the .cfg file says; None where it is of something else."""
    text = file.read_bytes()
    if b"dynamic_reconfigure" not in text:
        return None
    config = ParameterGenerator.config = Config(package, file)
    sys.modules.update(stand_ins())
    sys.path.insert(0, str(file.parent))
    try:
        code = compile(text, str(file), "exec")
        with contextlib.redirect_stdout(io.StringIO()):
            exec(code, {"__name__": "__main__", "__file__": str(file)})
    except SystemExit:  # as they end: exit(gen.generate(…))
        pass
    except SyntaxError as error:
        if error.filename != str(file):
            raise Problem(f"{file}:{line_of(error, file)}: {error}") from None
        raise Problem(f"{file}:{error.lineno or 1}: {error.msg}; .cfg files are run by Python 3") from None
    except Problem:
        raise
    except Exception as error:
        raise Problem(f"{file}:{line_of(error, file)}: {type(error).__name__}: {error}") from None
    finally:
        sys.path.remove(str(file.parent))
    if config.name is None:
        last = len(text.splitlines())
        raise Problem(f"{file}:{last}: it ends without generate(PACKAGE, node, name)")
    return config


def cpp_value(kind, value):
    if kind == "str":
        return quoted(value)
    if kind == "bool":
        return "true" if value else "false"
    if kind == "int":
        return "-2147483647 - 1" if value == -(2**31) else str(value)
    if math.isinf(value):
        return f"{'-' if value < 0 else ''}std::numeric_limits<double>::infinity()"
    return repr(float(value))


def static_lines(config, what, member):
    """A function that gives a configuration of all defaults, or of all ends."""
    return [
        f"  static const {config.name}Config& {what}() {{",
        f"    static const {config.name}Config values = [] {{",
        f"      {config.name}Config made;",
        *[f"      made.{one.name} = {cpp_value(one.kind, getattr(one, member))};" for one in config.parameters],
        "      return made;",
        "    }();",
        "    return values;",
        "  }",
    ]


def header_text(config):
    name, all_of = f"{config.name}Config", config.parameters
    guard = f"{config.package}_{name}_H".upper()
    ranged = [one for one in all_of if one.kind in ("int", "double")]
    unused = "" if all_of else "/*node*/"
    lines = [
        f"// {config.package}/{config.file.name}, by make_configs.py.",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        "#include <cstdint>",
        "#include <limits>",
        "#include <string>",
        "",
        '#include "ros/node_handle.h"',
        "",
        f"namespace {config.space} {{",
        "",
    ]
    for constant, (kind, value) in config.constants.items():
        type_ = "const char* const" if kind == "str" else f"const {TYPES[kind][0]}"
        lines.append(f"{type_} {config.name}_{constant} = {cpp_value(kind, value)};")
    lines += [
        "",
        f"class {name} {{",
        " public:",
        *[f"  {TYPES[one.kind][0]} {one.name}{'' if one.kind == 'str' else '{}'};" for one in all_of],
        "",
        *static_lines(config, "__getDefault__", "default"),
        *static_lines(config, "__getMin__", "low"),
        *static_lines(config, "__getMax__", "high"),
        f"  void __fromServer__(const ros::NodeHandle& {unused or 'node'}) {{",
        *[f"    node.getParam({quoted(one.name)}, {one.name});" for one in all_of],
        "  }",
        f"  void __toServer__(const ros::NodeHandle& {unused or 'node'}) const {{",
        *[f"    node.setParam({quoted(one.name)}, {one.name});" for one in all_of],
        "  }",
        "  void __clamp__() {",
        *[
            f"    if ({one.name} {sign} {bound}().{one.name}) {one.name} = {bound}().{one.name};"
            for one in ranged
            for sign, bound in (("<", "__getMin__"), (">", "__getMax__"))
        ],
        "  }",
        "  /// The levels of what differs.",
        f"  std::uint32_t __level__(const {name}& {'other' if all_of else '/*other*/'}) const {{",
        "    std::uint32_t level = 0;",
        *[f"    if ({one.name} != other.{one.name}) level |= {one.level & 0xFFFFFFFF}U;" for one in all_of],
        "    return level;",
        "  }",
        "};",
        "",
        f"}}  // namespace {config.space}",
        "",
        "#endif",
        "",
    ]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    asked = parser.parse_args()
    try:
        files = [one for package in asked.packages for one in package_files(package) if one[1].suffix == ".cfg"]
        configs = [config for package, file in files if (config := read_config(package, file))]
        headers = {}
        for config in configs:
            header = asked.out / config.package / f"{config.name}Config.h"
            if header in headers:
                raise Problem(f"{config.file}:1: another .cfg file of the package makes {config.name}Config")
            headers[header] = header_text(config)
    except Problem as problem:
        print(problem, file=sys.stderr)
        return 1
    for file, text in headers.items():
        write(file, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
