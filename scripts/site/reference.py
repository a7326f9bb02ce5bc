"""The reference pages of the site, made by asking the program, the headers and the Python package themselves."""

import pathlib
import re
import subprocess


def asked(program: str, *arguments: str) -> str:
    """What the program prints."""
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def subcommands(help_text: str) -> list[str]:
    """The names under "Subcommands:" in a help text."""
    listed = re.search(r"^Subcommands:\n((?:  .*\n|\n)*)", help_text, flags=re.MULTILINE)
    return re.findall(r"^  ([a-z][\w-]*)", listed.group(1), flags=re.MULTILINE) if listed else []


def commands_page(program: str) -> str:
    """--help of every command."""

    def section(words: list[str]) -> str:
        text = asked(program, *words, "--help")
        title = " ".join(["avoidbench", *words])
        own = f"{'#' * min(2 + max(len(words) - 1, 0), 3)} {title}\n\n```text\n{text.rstrip()}\n```\n"
        return "\n".join([own, *(section([*words, name]) for name in subcommands(text))])

    return "# Commands\n\nWhat `--help` of each command prints.\n\n" + section([])


def sweep_keys_page(program: str) -> str:
    defaults = asked(program, "config", "defaults").rstrip()
    return (
        "# Keys of a sweep file\n\nEvery key at its default, with its meaning and range, as printed by "
        "`avoidbench config defaults`. "
        "`avoidbench config explain KEY` says more about one; [how to write sweeps](../sweep_files.md).\n\n"
        f"```yaml\n{defaults}\n```\n"
    )


def metrics_page(program: str) -> str:
    return (
        "# Metrics\n\nAs printed by `avoidbench metrics`; "
        "[the glossary](../glossary.md) names the file that computes each.\n\n"
        f"{asked(program, 'metrics', '--format', 'markdown')}\n"
    )


def lists_page(program: str) -> str:
    tables = {"Sensors": "sensors", "Maps": "maps", "Planners": "planners"}
    sections = [
        f"## {title}\n\n{asked(program, noun, 'list', '--format', 'markdown')}" for title, noun in tables.items()
    ]
    return (
        "# Sensors, maps, planners\n\n"
        "The built-in ones, as printed by `avoidbench sensors list`, `maps list` and `planners list`.\n\n"
        + "\n".join(sections)
    )


def planner_api_page(root: pathlib.Path) -> str:
    folder = root / "lib/sdk/planner_api/avoidbench"
    parts = [
        "# The C and C++ interface\n\nThe headers as installed; [how to write a planner](../planners/README.md).\n",
    ]
    for name, language in (
        ("planner.h", "c"),
        ("planner.hpp", "cpp"),
        ("tracks.hpp", "cpp"),
        ("repeatable.hpp", "cpp"),
    ):
        parts.append(f"## {name}\n\n```{language}\n{(folder / name).read_text().rstrip()}\n```\n")
    return "\n".join(parts)


def python_page(root: pathlib.Path) -> str:
    """The public modules of the package, for mkdocstrings."""
    package = root / "python/avoidbench"
    names = [file.stem for file in sorted(package.glob("*.py")) if not file.stem.startswith("_")]
    modules = ["avoidbench", *(f"avoidbench.{name}" for name in names)]
    return "# The Python package\n\n[In ten minutes](../python.md).\n\n" + "\n".join(
        f"::: {name}\n" for name in modules
    )


def pages(program: str, root: pathlib.Path) -> dict[str, str]:
    """The pages by their place on the site."""
    return {
        "reference/commands.md": commands_page(program),
        "reference/sweep_keys.md": sweep_keys_page(program),
        "reference/metrics.md": metrics_page(program),
        "reference/lists.md": lists_page(program),
        "reference/planner_api.md": planner_api_page(root),
        "reference/python.md": python_page(root),
    }
