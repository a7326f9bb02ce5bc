"""The page docs/python.md: its blocks run as they stand, in their order, in one process and an empty folder."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).parent.parent.parent / "docs" / "python.md"
_BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)

# Problems are told with the page's line.
_DRIVER = """
import sys
page, spaces = sys.argv[1], {"__name__": "__main__"}
for line, block in eval(sys.stdin.read()):
    exec(compile("\\n" * line + block, page, "exec"), spaces)
"""


def blocks(text: str) -> list[tuple[int, str]]:
    """How many lines are before each block, and its text."""
    return [(text.count("\n", 0, found.start(1)), found.group(1)) for found in _BLOCK.finditer(text)]


def test_blocks_of_the_page_run(tmp_path: Path) -> None:
    listed = blocks(PAGE.read_text(encoding="utf-8"))
    assert len(listed) >= 9
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    if "PYTHONPATH" in environment:  # the blocks run in another folder
        environment["PYTHONPATH"] = os.pathsep.join(
            os.path.abspath(part) for part in environment["PYTHONPATH"].split(os.pathsep)
        )
    # UTF-8 at both ends, in the locale "C" too: tables of results have dashes.
    done = subprocess.run(
        [sys.executable, "-X", "utf8", "-c", _DRIVER, str(PAGE)],
        input=repr(listed),
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        encoding="utf-8",
        timeout=560,
    )
    assert done.returncode == 0, done.stderr
    for name in ("paths.png", "rates.png", "last_view.png"):
        assert (tmp_path / name).stat().st_size > 100
    assert "outcome_reactive" in done.stdout


def test_files_that_the_page_names_are_there() -> None:
    names = re.findall(r"\]\((?!https?://)([^)#]+)", PAGE.read_text(encoding="utf-8"))
    assert names
    assert [name for name in names if not (PAGE.parent / name).exists()] == []
