"""Reads a roslaunch file: the nodes that it would start, with their remappings and parameters. Of the arguments the
defaults are taken, or what the caller gives; nothing is started and no ROS is needed."""

import os
import pathlib
import re
from xml.etree import ElementTree
from xml.parsers import expat

import yaml

MOST_INCLUDES = 50  # one in another: a file that includes itself has no end
SUBSTITUTION = re.compile(r"\$\(([^()]*)\)")
SKIPPED = {"machine", "env", "test"}


class Problem(Exception):
    """What is wrong, as file:line: text."""


class Node:
    """A node as the launch file starts it."""

    def __init__(self, name, package, program, place):
        self.name, self.package, self.program, self.place = name, package, program, place
        self.namespace, self.arguments = "/", []
        self.remappings = {}  # as written
        self.params = {}  # name below the node, with / -> value


class Launch:
    def __init__(self):
        self.nodes = []
        self.params = {}  # of all nodes: full name -> value
        self.notes = []  # what was passed over


def _parse(file):
    """The file's elements, each with the line that it begins in as the attribute `:line`."""
    builder, parser = ElementTree.TreeBuilder(), expat.ParserCreate()

    def start(tag, attributes):
        builder.start(tag, {**attributes, ":line": str(parser.CurrentLineNumber)})

    parser.StartElementHandler, parser.EndElementHandler = start, builder.end
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(file.read_bytes(), True)
    except (expat.ExpatError, ValueError) as error:
        raise Problem(f"{file}:{getattr(error, 'lineno', 1)}: {error}") from None
    except OSError as error:
        raise Problem(f"{file}: {error.strerror}") from None
    return builder.close()


def _typed(text, kind):
    """A <param>'s value, as roslaunch takes it."""
    text = text.strip()
    if kind in ("str", "string"):
        return text
    if kind == "yaml":
        return yaml.safe_load(text)
    if kind == "bool" or (kind in (None, "auto") and text.lower() in ("true", "false")):
        if text.lower() not in ("true", "false", "1", "0"):
            raise ValueError(f'"{text}" is neither true nor false')
        return text.lower() in ("true", "1")
    if kind == "double":
        return float(text)
    if kind == "int":
        return int(text, 0)
    for read in (int, float):
        try:
            return read(text)
        except ValueError:
            pass
    return text


def _flat(value, prefix, found):
    """A tree of rosparam by names with /."""
    if isinstance(value, dict):
        for key, one in value.items():
            _flat(one, f"{prefix}/{key}" if prefix else str(key), found)
    elif value is not None:
        found[prefix] = value


class _Reader:
    def __init__(self, packages, launch):
        self.packages, self.launch, self.depth = packages, launch, 0  # packages: name -> folder

    def read(self, file, given, namespace="/"):
        self.depth += 1
        if self.depth > MOST_INCLUDES:
            raise Problem(f"{file}:1: more than {MOST_INCLUDES} files, each included by the one before")
        root = _parse(file)
        if root.tag != "launch":
            raise Problem(f"{file}:{root.get(':line')}: <launch> stands here, not <{root.tag}>")
        self.children(root, _Scope(file, namespace, dict(given)))
        self.depth -= 1

    def children(self, element, scope):
        for child in element:
            if self.holds(child, scope) and child.tag not in SKIPPED:
                handler = getattr(self, "on_" + child.tag, None)
                if handler is None:
                    raise self.problem(child, scope, f"<{child.tag}> is no tag of a launch file")
                handler(child, scope)

    def problem(self, element, scope, text):
        return Problem(f"{scope.file}:{element.get(':line')}: {text}")

    def attribute(self, element, scope, name, preset=None):
        if element.get(name) is None:
            if preset is None:
                raise self.problem(element, scope, f"<{element.tag}> has no {name}")
            return preset
        return self.substituted(element.get(name), element, scope)

    def substituted(self, text, element, scope):
        if text.startswith("$(eval"):
            return self.evaluated(text[len("$(eval") : -1].strip(), element, scope)

        def value(match):
            word, _, rest = match[1].strip().partition(" ")
            words = rest.split()
            if word == "arg" and words:
                if words[0] not in scope.arguments:
                    raise self.problem(element, scope, f"no value for the argument {words[0]}: give {words[0]}:=VALUE")
                return scope.arguments[words[0]]
            if word == "find" and words:
                if words[0] not in self.packages:
                    raise self.problem(element, scope, f"no package {words[0]} in the workspace: --workspace FOLDER")
                return str(self.packages[words[0]])
            if word == "optenv" and words:
                return os.environ.get(words[0], " ".join(words[1:]))
            if word == "env" and words and words[0] in os.environ:
                return os.environ[words[0]]
            if word == "dirname":
                return str(scope.file.parent)
            if word == "anon" and words:
                return words[0]
            raise self.problem(element, scope, f"no value for $({match[1]})")

        return SUBSTITUTION.sub(value, text)

    def evaluated(self, text, element, scope):
        """$(eval …): Python over the arguments, without anything else."""
        names = {name: _typed(value, None) for name, value in scope.arguments.items()}
        names["arg"] = names.get
        if "__" in text:
            raise self.problem(element, scope, "$(eval …) with __")
        try:
            return str(eval(text, {"__builtins__": {}}, names))
        except Exception as error:
            raise self.problem(element, scope, f"$(eval {text}): {error}") from None

    def holds(self, element, scope):
        for name, wanted in (("if", True), ("unless", False)):
            if element.get(name) is not None:
                text = self.substituted(element.get(name), element, scope).strip().lower()
                if text not in ("true", "false", "1", "0"):
                    raise self.problem(element, scope, f'{name}="{text}" is neither true nor false')
                if (text in ("true", "1")) != wanted:
                    return False
        return True

    def on_arg(self, element, scope):
        name = self.attribute(element, scope, "name")
        if element.get("value") is not None:
            scope.arguments[name] = self.attribute(element, scope, "value")
        elif name not in scope.arguments and element.get("default") is not None:
            scope.arguments[name] = self.attribute(element, scope, "default")

    def on_include(self, element, scope):
        file = pathlib.Path(self.attribute(element, scope, "file"))
        if not file.exists():
            self.launch.notes.append(f"{scope.file}:{element.get(':line')}: passed over, not there: {file}")
            return
        all_given = element.get("pass_all_args", "false") == "true"
        given = dict(scope.arguments) if all_given else {}
        for child in element:
            if child.tag == "arg" and self.holds(child, scope) and child.get("value") is not None:
                given[self.attribute(child, scope, "name")] = self.attribute(child, scope, "value")
        self.read(file, given, scope.joined(self.attribute(element, scope, "ns", "")))

    def on_group(self, element, scope):
        inner = _Scope(scope.file, scope.joined(self.attribute(element, scope, "ns", "")), scope.arguments)
        inner.remappings = dict(scope.remappings)
        self.children(element, inner)

    def on_remap(self, element, scope):
        scope.remappings[self.attribute(element, scope, "from")] = self.attribute(element, scope, "to")

    def on_node(self, element, scope):
        place = f"{scope.file}:{element.get(':line')}"
        node = Node(*(self.attribute(element, scope, one) for one in ("name", "pkg", "type")), place)
        node.namespace = scope.joined(self.attribute(element, scope, "ns", ""))
        node.arguments = self.attribute(element, scope, "args", "").split()
        inner = _Scope(scope.file, node.namespace, scope.arguments)
        inner.remappings, inner.node = dict(scope.remappings), node
        self.children(element, inner)
        node.remappings = inner.remappings
        self.launch.nodes.append(node)

    def on_param(self, element, scope):
        name = self.attribute(element, scope, "name")
        if element.get("value") is None:
            self.launch.notes.append(
                f"{scope.file}:{element.get(':line')}: passed over: {name} is of a file or command"
            )
            return
        text = self.attribute(element, scope, "value")
        try:
            scope.keep(self.launch, name, _typed(text, element.get("type")))
        except (ValueError, yaml.YAMLError) as error:
            raise self.problem(element, scope, f"{name}: {error}") from None

    def on_rosparam(self, element, scope):
        if element.get("command", "load") != "load":
            return
        text = element.text or ""
        try:
            if element.get("file") is not None:
                file = pathlib.Path(self.attribute(element, scope, "file"))
                text = file.read_text()
            elif element.get("subst_value") == "true":
                text = self.substituted(text, element, scope)
            value = yaml.safe_load(text)
        except OSError as error:
            raise self.problem(element, scope, f"{error.filename}: {error.strerror}") from None
        except (yaml.YAMLError, UnicodeDecodeError) as error:
            raise self.problem(element, scope, str(error)) from None
        found = {}
        space = self.attribute(element, scope, "ns", "").strip("/")
        name = self.attribute(element, scope, "param", "").strip("/")
        _flat(value, "/".join(one for one in (space, name) if one), found)
        for each, one in found.items():
            scope.keep(self.launch, each, one)


class _Scope:
    def __init__(self, file, namespace, arguments):
        self.file, self.namespace, self.arguments = file, namespace, arguments
        self.remappings, self.node = {}, None

    def joined(self, inner):
        if inner.startswith("/"):
            return "/" + inner.strip("/")
        return "/" + "/".join(one for one in (self.namespace.strip("/"), inner.strip("/")) if one)

    def keep(self, launch, name, value):
        if self.node is not None and not name.startswith("/"):
            self.node.params[name.lstrip("~").strip("/")] = value
        else:
            launch.params[self.joined(name.lstrip("~"))] = value


def read_launch(file, packages, arguments):
    """The launch file with these arguments (name -> text) and packages (name -> folder)."""
    launch = Launch()
    _Reader(packages, launch).read(file.absolute(), arguments)
    return launch
