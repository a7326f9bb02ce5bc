"""Reads YAML with the place of every value, so that each problem says file:line:column. Needs PyYAML (python3-yaml)."""
import difflib
import re

import yaml

FLOAT = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


class Problem(Exception):
    """What is wrong, and where."""


class Tree:
    """A value of the file with its place."""

    def __init__(self, file, node):
        self.file, self.node = file, node

    def problem(self, text):
        mark = self.node.start_mark
        return Problem(f"{self.file}:{mark.line + 1}:{mark.column + 1}: {text}")

    def is_map(self):
        return isinstance(self.node, yaml.MappingNode)

    def is_list(self):
        return isinstance(self.node, yaml.SequenceNode)

    def items(self):
        """(key, key's place, value) of a map, in the file's order."""
        if not self.is_map():
            raise self.problem("a map of names and values stands here")
        seen = {}
        for key, value in self.node.value:
            place = Tree(self.file, key)
            if not isinstance(key, yaml.ScalarNode):
                raise place.problem("a name stands here")
            if key.value in seen:
                raise place.problem(f'"{key.value}" is there already')
            seen[key.value] = True
            yield key.value, place, Tree(self.file, value)

    def list(self):
        """The values of a list; a single one stands for a list of it."""
        return [Tree(self.file, node) for node in self.node.value] if self.is_list() else [self]

    def map(self, known):
        """The map's values by name, of these names alone."""
        values = {}
        for key, place, value in self.items():
            if key not in known:
                near = difflib.get_close_matches(key, known, 1)
                hint = f"; did you mean {near[0]}?" if near else f"; there are {', '.join(sorted(known))}"
                raise place.problem(f'there is no "{key}" here{hint}')
            values[key] = value
        return values

    def scalar(self):
        """A bool, an int, a float, a text or None."""
        if not isinstance(self.node, yaml.ScalarNode):
            raise self.problem("a single value stands here")
        if self.node.style is not None:
            return self.node.value
        if FLOAT.fullmatch(self.node.value) and not re.fullmatch(r"[-+]?\d+", self.node.value):
            return float(self.node.value)  # YAML 1.1 takes 1e-3 for a text
        tag = self.node.tag.rpartition(":")[2]
        return yaml.safe_load(self.node.value) if tag in ("int", "float", "bool", "null") else self.node.value

    def text(self):
        value = self.scalar()
        if not isinstance(value, str):
            raise self.problem(f"a text stands here, not {value}")
        return value

    def number(self, low=None, high=None):
        value = self.scalar()
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.problem(f'"{self.node.value}" is no number')
        if (low is not None and value < low) or (high is not None and value > high):
            raise self.problem(f"{value} is not from {low} to {'any' if high is None else high}")
        return value

    def integer(self, low=None, high=None):
        value = self.number(low, high)
        if not isinstance(value, int):
            raise self.problem(f"{value} is no whole number")
        return value

    def truth(self):
        value = self.scalar()
        if not isinstance(value, bool):
            raise self.problem(f'"{self.node.value}" is neither true nor false')
        return value

    def word(self, words):
        value = self.text()
        if value not in words:
            raise self.problem(f'"{value}" is none of {", ".join(words)}')
        return value


def read(file):
    try:
        node = yaml.compose(file.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    except OSError as error:
        raise Problem(f"{file}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise Problem(f"{file}:1:1: this is no text in UTF-8") from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"{mark.line + 1}:{mark.column + 1}" if mark else "1:1"
        raise Problem(f"{file}:{place}: {error.problem or error.context}") from None
    except yaml.YAMLError as error:
        raise Problem(f"{file}:1:1: {str(error).splitlines()[0]}") from None
    if node is None:
        raise Problem(f"{file}:1:1: the file is empty")
    return Tree(file, node)
