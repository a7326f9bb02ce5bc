#!/usr/bin/env python3
"""Writes C++ headers of ROS 1 messages and services from .msg and .srv files, as ROS names them:
geometry_msgs/Point.msg becomes geometry_msgs/Point.h with geometry_msgs::Point, PointPtr, PointConstPtr and the
template Point_<Allocator>; std_srvs/Trigger.srv becomes TriggerRequest.h, TriggerResponse.h and Trigger.h.

    make_messages.py --out FOLDER PACKAGE…    PACKAGE: a folder with package.xml and msg/*.msg or srv/*.srv, or with
                                              such files, or one of them
    make_messages.py --list PACKAGE…          the headers it would write, one a line

A package's name is the <name> of its package.xml, else its folder's. Needs Python 3 alone. Written in C++14."""

import argparse
import pathlib
import re
import sys

# ROS's name -> (C++ type, kind of its constants)
BUILT_IN = {
    "bool": ("std::uint8_t", "integer"),
    "char": ("std::uint8_t", "integer"),
    "byte": ("std::int8_t", "integer"),
    "int8": ("std::int8_t", "integer"),
    "uint8": ("std::uint8_t", "integer"),
    "int16": ("std::int16_t", "integer"),
    "uint16": ("std::uint16_t", "integer"),
    "int32": ("std::int32_t", "integer"),
    "uint32": ("std::uint32_t", "integer"),
    "int64": ("std::int64_t", "integer"),
    "uint64": ("std::uint64_t", "integer"),
    "float32": ("float", "real"),
    "float64": ("double", "real"),
    "string": ("std::string", "text"),
    "time": ("ros::Time", None),
    "duration": ("ros::Duration", None),
}
RANGES = {"bool": (0, 1), "char": (0, 255), "byte": (-128, 127)}
for bits in (8, 16, 32, 64):
    RANGES[f"int{bits}"] = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    RANGES[f"uint{bits}"] = (0, 2**bits - 1)
# Of a field's name C++ could not make anything.
KEYWORDS = set(
    """alignas alignof and asm auto bool break case catch char class const constexpr continue decltype default delete do
double else enum explicit export extern false float for friend goto if inline int long mutable namespace new
noexcept not nullptr operator or private protected public register return short signed sizeof static struct switch
template this throw true try typedef typeid typename union unsigned using virtual void volatile while xor""".split()
)
PARTS = ("Request", "Response")  # of a service
TYPE = re.compile(r"([A-Za-z][A-Za-z0-9_]*(?:/[A-Za-z][A-Za-z0-9_]*)?)(\[(\d*)\])?")
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


class Problem(Exception):
    """What is wrong, and where: file:line:column: text."""


class Place:
    def __init__(self, file, line, column):
        self.file, self.line, self.column = file, line, column

    def problem(self, text):
        return Problem(f"{self.file}:{self.line}:{self.column}: {text}")


class Field:
    def __init__(self, kind, package, name, count, place):
        # kind: ROS's name without its package; package: None for built-in types; count: None, "" (any number) or a
        # number
        self.kind, self.package, self.name, self.count, self.place = kind, package, name, count, place

    def header(self):
        return f"{self.package}/{self.kind}" if self.package else None

    def element(self):
        if self.package is None:
            return BUILT_IN[self.kind][0]
        return f"::{self.package}::{self.kind}_<ContainerAllocator>"

    def cpp(self):
        if self.count is None:
            return self.element()
        if self.count == "":
            return f"std::vector<{self.element()}>"
        return f"ros_shim::array<{self.element()}, {self.count}>"


class Constant:
    def __init__(self, kind, name, value):
        self.kind, self.name, self.value = kind, name, value


class Message:
    def __init__(self, package, name, file):
        self.package, self.name, self.file = package, name, file
        self.fields, self.constants = [], []

    def type(self):
        return f"{self.package}/{self.name}"


def constant_of(kind, name, text, place):
    if BUILT_IN[kind][1] is None:
        raise place.problem(f"a constant can't be a {kind}")
    if BUILT_IN[kind][1] == "text":
        return Constant(kind, name, text)
    if BUILT_IN[kind][1] == "real":
        try:
            return Constant(kind, name, float(text))
        except ValueError:
            raise place.problem(f'"{text}" is no number') from None
    words = {"true": 1, "false": 0} if kind == "bool" else {}
    try:
        value = words[text.lower()] if text.lower() in words else int(text, 0)
    except ValueError:
        raise place.problem(f'"{text}" is no whole number') from None
    low, high = RANGES[kind]
    if not low <= value <= high:
        raise place.problem(f"{text} is not of {kind}: from {low} to {high}")
    return Constant(kind, name, value)


def field_type(message, word, place):
    match = TYPE.fullmatch(word)
    if not match:
        raise place.problem(f'"{word}" is no type: as float64, geometry_msgs/Point, uint8[] or float64[9]')
    kind, count = match[1], match[3] if match[2] else None
    if count == "0":
        raise place.problem("an array of no elements")
    if kind in BUILT_IN:
        return kind, None, count
    if kind == "Header":
        return "Header", "std_msgs", count
    package, _, name = kind.rpartition("/")
    return name, package or message.package, count


def read_line(message, line, file, number):
    """One line of a .msg file into a field or a constant."""
    # A text constant has all that is left, with what looks like a comment.
    is_text = re.match(r"\s*string\s+\w+\s*=", line)
    code = line if is_text else line.split("#")[0]
    if not code.strip():
        return
    words = [(match[0], Place(file, number, match.start() + 1)) for match in re.finditer(r"[^\s=]+", code)]
    if code.lstrip().startswith("="):
        raise Place(file, number, code.index("=") + 1).problem("a type and a name come before =")
    place = words[0][1]
    kind, package, count = field_type(message, words[0][0], place)
    if len(words) < 2 or "=" in code[place.column - 1 : words[1][1].column - 1]:
        raise place.problem(f'"{words[0][0]}" without a name')
    name, at = words[1]
    if not NAME.fullmatch(name):
        raise at.problem(f'"{name}" is no name: letters, digits and _, a letter first')
    if name in KEYWORDS:
        raise at.problem(f'"{name}" is a word of C++')
    if any(name == other.name for other in message.fields + message.constants):
        raise at.problem(f'"{name}" is there already')
    rest = code[at.column - 1 + len(name) :]
    if rest.lstrip().startswith("="):
        value = rest.lstrip()[1:].strip()
        behind = rest[rest.index("=") + 1 :]
        where = Place(file, number, len(code) - len(behind.lstrip() or behind) + 1)
        if package or count is not None:
            raise place.problem("a constant is of a built-in type and no array")
        if not value and kind != "string":
            raise where.problem("a constant without a value")
        message.constants.append(constant_of(kind, name, value, where))
        return
    if rest.strip():
        column = at.column + len(name) + len(rest) - len(rest.lstrip())
        raise Place(file, number, column).problem(f'"{rest.strip()}" behind the name; ROS 1 has no defaults')
    message.fields.append(Field(kind, package, name, count, place))


def read_messages(package, file):
    """The message of a .msg file; the request and the response of a .srv file, which a line of --- parts."""
    if not NAME.fullmatch(file.stem):
        raise Place(file, 1, 1).problem(f'"{file.stem}" is no name of a message')
    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        raise Place(file, 1, 1).problem("this is no text in UTF-8") from None
    parts = [""] if file.suffix == ".msg" else PARTS
    messages = [Message(package, file.stem + part, file) for part in parts]
    at = 0
    for number, line in enumerate(lines, 1):
        if file.suffix == ".srv" and re.fullmatch(r"---+\s*", line):
            at += 1
            if at == len(messages):
                raise Place(file, number, 1).problem("a second ---: a service has a request and a response")
            continue
        read_line(messages[at], line, file, number)
    if at + 1 < len(messages):
        raise Place(file, len(lines) + 1, 1).problem("no --- between the request and the response")
    return messages


def service_text(package, name):
    """The header of a service, over those of its two messages."""
    guard = f"{package.upper()}_SERVICE_{name.upper()}_H"
    return "\n".join(
        [
            f"// {package}/{name}, by make_messages.py.",
            f"#ifndef {guard}",
            f"#define {guard}",
            "",
            *[f'#include "{package}/{name}{part}.h"' for part in PARTS],
            "",
            f"namespace {package} {{",
            "",
            f"struct {name} {{",
            *[f"  using {part} = {name}{part};\n  using {part}Type = {part};" for part in PARTS],
            "  Request request;",
            "  Response response;",
            "};",
            "",
            f"}}  // namespace {package}",
            "",
            "#endif",
            "",
        ]
    )


def package_name(folder):
    description = folder / "package.xml"
    if description.exists():
        match = re.search(r"<name>\s*([A-Za-z][A-Za-z0-9_]*)\s*</name>", description.read_text(encoding="utf-8"))
        if not match:
            raise Place(description, 1, 1).problem("no <name> of a package")
        return match[1]
    return folder.name


def package_files(path):
    """(package, .msg, .srv or .cfg file) of what the command line names; the last are for make_configs.py."""
    path = path.resolve()
    if path.suffix in (".msg", ".srv", ".cfg"):
        folder = path.parent.parent if path.parent.name in ("msg", "srv", "cfg") else path.parent
        return [(package_name(folder), path)]
    if not path.is_dir():
        raise Problem(f"{path}: no such folder")
    if path.name in ("msg", "srv", "cfg"):
        path = path.parent
    files = []
    for kind in ("msg", "srv"):
        files += sorted((path / kind if (path / kind).is_dir() else path).glob(f"*.{kind}"))
    files += sorted((path / "cfg").glob("*.cfg"))
    if not files:
        raise Problem(
            f"{path}: no .msg or .srv files in it or its folders msg and srv, no .cfg files in its folder cfg"
        )
    return [(package_name(path), file) for file in files]


def constant_lines(message):
    """As ROS: whole numbers of up to 32 bits are an enum, so that nobody needs a definition of them."""
    inside, outside = [], []
    for constant in message.constants:
        kind, name = BUILT_IN[constant.kind], constant.name
        if kind[1] == "integer" and not constant.kind.endswith("64"):
            suffix = "u" if constant.value > 0x7FFFFFFF or constant.kind.startswith("uint") else ""
            inside.append(f"  enum {{ {name} = {value_text(constant.value, suffix)} }};")
            continue
        inside.append(f"  static const {kind[0]} {name};")
        outside += [
            "template <class ContainerAllocator>",
            f"const {kind[0]} {message.name}_<ContainerAllocator>::{name} = {cpp_value(constant)};",
        ]
    return inside, outside


def value_text(value, suffix):
    if value == -(2**31):
        return "-2147483647 - 1"
    return f"{value}{suffix}"


def quoted(text):
    """A string of C++ with these bytes in UTF-8."""
    return (
        '"'
        + "".join(
            c if 32 <= ord(c) < 127 and c not in '"\\?' else "".join(f"\\{b:03o}" for b in c.encode()) for c in text
        )
        + '"'
    )


def cpp_value(constant):
    if constant.kind == "string":
        return quoted(constant.value)
    if constant.kind == "uint64":
        return f"{constant.value}ULL"
    if constant.kind == "int64":
        return f"{constant.value}LL" if constant.value != -(2**63) else "-9223372036854775807LL - 1"
    if constant.value != constant.value or abs(constant.value) == float("inf"):
        kind = BUILT_IN[constant.kind][0]
        if constant.value != constant.value:
            return f"std::numeric_limits<{kind}>::quiet_NaN()"
        return ("-" if constant.value < 0 else "") + f"std::numeric_limits<{kind}>::infinity()"
    return repr(constant.value) + ("F" if constant.kind == "float32" else "")


def initial(field):
    """Numbers begin as zero, as in ROS."""
    if field.count == "" or (field.count is None and (field.package or field.kind in ("string", "time", "duration"))):
        return ""
    return "{}"


def printed(field):
    """Lines that print the field as ROS does."""
    value = f"message.{field.name}"
    if field.count is not None:
        return [f'  ros_shim::print_list(out, indent, "{field.name}", {value});']
    return [f'  ros_shim::print_field(out, indent, "{field.name}", {value});']


def header_text(message):
    name, package = message.name, message.package
    guard = f"{package.upper()}_MESSAGE_{name.upper()}_H"
    own = f"{name}_<ContainerAllocator>"
    includes = sorted({field.header() for field in message.fields if field.header()})
    inside, outside = constant_lines(message)
    equal = " && ".join(f"a.{field.name} == b.{field.name}" for field in message.fields) or "true"
    unused = "" if message.fields else "/*{}*/"

    def parameter(word):
        return unused.format(word) if unused else word

    lines = [
        f"// {message.type()}, by make_messages.py.",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        "#include <cstdint>",
        "#include <limits>",
        "#include <memory>",
        "#include <ostream>",
        "#include <string>",
        "#include <vector>",
        "",
        '#include "ros/message_traits.h"',
        '#include "ros/time.h"',
        '#include "ros_shim/pointer.h"',
        '#include "ros_shim/print.h"',
        *[f'#include "{header}.h"' for header in includes],
        "",
        f"namespace {package} {{",
        "",
        "template <class ContainerAllocator>",
        f"struct {name}_ {{",
        f"  using Type = {own};",
        f"  using Ptr = ros_shim::shared_ptr<{own}>;",
        f"  using ConstPtr = ros_shim::shared_ptr<const {own}>;",
        "",
        f"  {name}_() = default;",
        f"  explicit {name}_(const ContainerAllocator&) {{}}",
    ]
    lines += (
        [""] + [f"  {field.cpp()} {field.name}{initial(field)};" for field in message.fields] if message.fields else []
    )
    lines += [""] + inside if inside else []
    lines += [
        "};",
        f"using {name} = {name}_<std::allocator<void>>;",
        f"using {name}Ptr = ros_shim::shared_ptr<{name}>;",
        f"using {name}ConstPtr = ros_shim::shared_ptr<const {name}>;",
        "",
        *outside,
        *([""] if outside else []),
        "template <class ContainerAllocator>",
        f"bool operator==(const {own}& {parameter('a')}, const {own}& {parameter('b')}) {{",
        f"  return {equal};",
        "}",
        "template <class ContainerAllocator>",
        f"bool operator!=(const {own}& a, const {own}& b) {{",
        "  return !(a == b);",
        "}",
        "template <class ContainerAllocator>",
        f"void print_message(std::ostream& {parameter('out')}, const std::string& {parameter('indent')}, "
        f"const {own}& {parameter('message')}) {{",
        *[line for field in message.fields for line in printed(field)],
        "}",
        "template <class ContainerAllocator>",
        f"std::ostream& operator<<(std::ostream& out, const {own}& message) {{",
        '  print_message(out, "", message);',
        "  return out;",
        "}",
        "",
        f"}}  // namespace {package}",
        "",
        "namespace ros {",
        "namespace message_traits {",
        "template <class ContainerAllocator>",
        f"struct DataType<::{package}::{own}> {{",
        f'  static const char* value() {{ return "{message.type()}"; }}',
        "};",
        "}  // namespace message_traits",
        "}  // namespace ros",
        "",
        "#endif",
        "",
    ]
    return "\n".join(lines)


def require_no_cycles(messages):
    """A message that contains itself has no size."""
    by_type = {message.type(): message for message in messages}
    done = set()

    def visit(message, way):
        for field in message.fields:
            inner = by_type.get(field.header() or "")
            if inner is None or inner.type() in done:
                continue
            if inner.type() in way:
                raise field.place.problem(f"{inner.type()} contains itself")
            visit(inner, way | {inner.type()})
        done.add(message.type())

    for message in messages:
        visit(message, {message.type()})


def write(file, text):
    """Where it changes the file: what includes it compiles again only then."""
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists() or file.read_text() != text:
        file.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--list", action="store_true")
    parser.add_argument(
        "--known", type=pathlib.Path, action="append", default=[], help="packages whose headers are there already"
    )
    asked = parser.parse_args()
    try:
        files = [one for package in asked.packages for one in package_files(package) if one[1].suffix != ".cfg"]
        if asked.list:
            print("\n".join(f"{package}/{file.stem}.h" for package, file in files))
            return 0
        messages = [message for package, file in files for message in read_messages(package, file)]
        known = {f"{package}/{file.stem}" for folder in asked.known for package, file in package_files(folder)}
        known |= {message.type() for message in messages}
        for message in messages:
            for field in message.fields:
                if field.header() and field.header() not in known:
                    raise field.place.problem(f"there is no message {field.header()}: is its package among MESSAGES?")
        require_no_cycles(messages)
    except Problem as problem:
        print(problem, file=sys.stderr)
        return 1
    if asked.out is None:
        parser.error("--out FOLDER or --list")
    headers = {message.type(): header_text(message) for message in messages}
    headers |= {
        f"{package}/{file.stem}": service_text(package, file.stem) for package, file in files if file.suffix == ".srv"
    }
    for name, text in headers.items():
        write(asked.out / f"{name}.h", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
