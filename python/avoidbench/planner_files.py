"""The files that decide what a planner written in Python does."""

import ast
from collections.abc import Iterator, Sequence
from pathlib import Path


def _imported(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """The dotted names that a module imports, each with the number of dots before it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for name in node.names:
                yield 0, name.name
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            yield node.level, base
            for name in node.names:
                yield node.level, f"{base}.{name.name}".lstrip(".")


def _module_files(folder: Path, name: str) -> Iterator[Path]:
    """The files below `folder` that the import of a dotted name runs."""
    place = folder
    for part in filter(None, name.split(".")):
        package, module = place / part / "__init__.py", place / f"{part}.py"
        if package.is_file():
            yield package
        elif module.is_file():
            yield module
            return
        elif not (place / part).is_dir():
            return
        place = place / part


def local_modules(script: Path) -> list[Path]:
    """What the script imports from its own folder, and what that imports, found in the sources: the same wherever it is
    asked. Sorted, relative to the folder."""
    folder = script.parent
    found: set[Path] = set()
    waiting = [script]
    while waiting:
        file = waiting.pop()
        try:
            tree = ast.parse(file.read_bytes())
        except (OSError, SyntaxError, ValueError):
            continue  # its import says what is wrong
        for level, name in _imported(tree):
            base = folder if level == 0 else file.parents[min(level, len(file.parents)) - 1]
            if not base.is_relative_to(folder):
                continue
            for module in _module_files(base, name):
                if module != script and module not in found:
                    found.add(module)
                    waiting.append(module)
    return sorted(module.relative_to(folder) for module in found)


def planner_files(script: Path, named: Sequence[str]) -> list[str]:
    """The files beside `script` that decide what its planner does: those that it names, and its local modules."""
    files = [str(name) for name in named]
    files += [module.as_posix() for module in local_modules(script) if module.as_posix() not in files]
    return files
