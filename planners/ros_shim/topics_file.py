"""Reads YAML with the place of every value, so that each problem says file:line:column. Needs PyYAML (python3-yaml)."""

import difflib
import math
import re

import yaml

# Far beyond any topics file, and read in some seconds: of what is larger nothing is read.
MOST_BYTES, MOST_DEPTH, MOST_VALUES = 256 * 1024, 50, 50_000
NO_TEXT = re.compile("[\0\ud800-\udfff]")  # ends a text in C++, or is none in UTF-8
FLOAT = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


class Problem(Exception):
    """What is wrong, and where."""


def shown(text):
    """A text for a message, where it is long its beginning."""
    return text if len(text) <= 60 else text[:57] + "..."


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
            place.require_text()
            if key.value in seen:
                raise place.problem(f'"{shown(key.value)}" is there already')
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
                near = difflib.get_close_matches(shown(key), known, 1)
                hint = f"; did you mean {near[0]}?" if near else f"; there are {', '.join(sorted(known))}"
                raise place.problem(f'there is no "{shown(key)}" here{hint}')
            values[key] = value
        return values

    def require_text(self):
        found = NO_TEXT.search(self.node.value)
        if found:
            raise self.problem(f"the character U+{ord(found[0]):04X} can't stand in a text")

    def scalar(self):
        """A bool, an int of 64 bits, a float, a text or None."""
        if not isinstance(self.node, yaml.ScalarNode):
            raise self.problem("a single value stands here")
        self.require_text()
        if self.node.style is not None:
            return self.node.value
        tag = self.node.tag.rpartition(":")[2]
        try:
            if FLOAT.fullmatch(self.node.value) and not re.fullmatch(r"[-+]?\d+", self.node.value):
                value = float(self.node.value)  # YAML 1.1 takes 1e-3 for a text
                if math.isinf(value):
                    raise OverflowError
                return value
            value = yaml.safe_load(self.node.value) if tag in ("int", "float", "bool", "null") else self.node.value
            return float(value) if isinstance(value, int) and abs(value) >= 2**63 else value
        except (OverflowError, ValueError):  # the second is of whole numbers of thousands of digits
            raise self.problem(f"{shown(self.node.value)} is beyond the greatest number, 1.8e308") from None

    def text(self):
        value = self.scalar()
        if not isinstance(value, str):
            raise self.problem(f"a text stands here, not {value}")
        return value

    def number(self, low=None, high=None):
        value = self.scalar()
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.problem(f'"{shown(str(self.node.value))}" is no number')
        if not math.isfinite(value):
            raise self.problem(f"{value} is not finite")
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


class Loader(yaml.SafeLoader):
    """Stops where a file nests too deep: what reads the tree calls itself for each level."""

    depth = 0

    def compose_node(self, parent, index):
        self.depth += 1
        if self.depth > MOST_DEPTH:
            raise yaml.MarkedYAMLError(
                problem=f"this nests more than {MOST_DEPTH} deep", problem_mark=self.peek_event().start_mark
            )
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node


def require_bounded(file, root):
    """A value that several aliases stand for counts each time."""
    count = 0

    def visit(node, around):
        nonlocal count
        count += 1
        place = Tree(file, node)
        if node in around:
            raise place.problem("this contains itself")
        if len(around) >= MOST_DEPTH:
            raise place.problem(f"with its aliases this nests more than {MOST_DEPTH} deep")
        if count > MOST_VALUES:
            raise place.problem(f"with its aliases the file has more than {MOST_VALUES} values")
        if not isinstance(node, yaml.ScalarNode):
            for one in node.value:
                for inner in one if isinstance(node, yaml.MappingNode) else (one,):
                    visit(inner, (*around, node))

    visit(root, ())


def read(file):
    try:
        with open(file, "rb") as stream:
            text = stream.read(MOST_BYTES + 1)
        if len(text) > MOST_BYTES:
            raise Problem(f"{file}: more than {MOST_BYTES // 1024} KiB are no topics file")
        node = yaml.compose(text.decode("utf-8"), Loader=Loader)
    except OSError as error:
        raise Problem(f"{file}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise Problem(f"{file}:1:1: this is no text in UTF-8") from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"{mark.line + 1}:{mark.column + 1}" if mark else "1:1"
        raise Problem(f"{file}:{place}: {error.problem or error.context}") from None
    except (
        yaml.YAMLError,
        ValueError,
        OverflowError,
    ) as error:  # the last two from PyYAML, of "\\U00110000" and "\\UFFFFFFFF"
        raise Problem(f"{file}:1:1: {str(error).splitlines()[0]}") from None
    if node is None:
        raise Problem(f"{file}:1:1: the file is empty")
    require_bounded(file, node)
    return Tree(file, node)
