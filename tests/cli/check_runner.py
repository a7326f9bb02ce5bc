#!/usr/bin/env python3
"""The runner of the *.test files passes what is as expected, whatever its lines begin with, and nothing else.

usage: check_runner.py
"""

import contextlib
import io
import pathlib
import sys
import tempfile

import run_cli_tests

PASSING = {
    "output": "$ echo a\nstdout:\na\n",
    "exit code": "$ exit 3\nexit: 3\n",
    "a heading": "$ echo '# a' && echo b\nstdout:\n\\# a\nb\n",
    "a comment behind": "$ echo a\nstdout:\na\n# The next.\n$ echo b\nstdout:\nb\n",
    "a command": "$ echo '$ ls' && echo '~~~ a'\nstdout:\n\\$ ls\n\\~~~ a\n",
    "words of the format": "$ echo stdout: && echo stderr:\nstdout:\n\\stdout:\n\\stderr:\n",
    "a backslash": "$ printf '\\\\%s\\n' a\nstdout:\n\\\\a\n",
    "any lines": "$ printf 'a\\nb\\nc\\n'\nstdout:\na\n...\nc\n",
    "any text": "$ echo abc\nstdout:\na...c\n",
    "no output": "$ true\nstdout:\nstderr:\n",
    "a file": "~~~ a/b.txt\n# a\n~~~\n$ cat a/b.txt\nstdout:\n\\# a\n",
}
FAILING = {
    "other output": "$ echo b\nstdout:\na\n",
    "another heading": "$ echo '# b'\nstdout:\n\\# a\n",
    "no heading": "$ echo b\nstdout:\n\\# a\nb\n",
    "other errors": "$ echo b >&2\nstderr:\na\n",
    "another exit code": "$ exit 3\n",
    "no failure": "$ true\nexit: 1\n",
    "more lines": "$ printf 'a\\nb\\n'\nstdout:\na\n",
    "fewer lines": "$ echo a\nstdout:\na\n...\nb\n",
    "output where none is expected": "$ echo a\nstdout:\n",
    "a line of no kind": "a\n$ true\n",
    "an expectation behind a comment": "$ echo a\nstdout:\n# The next.\na\n",
    "no command": "# $ true\n~~~ a\n$ true\n~~~\n",
}


def passes(text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "a.test")
        path.write_text(text)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                return not run_cli_tests.run_file(path, "/bin/true", folder)
        except SystemExit:
            return False


def main():
    wrong = [f"fails: {name}" for name, text in PASSING.items() if not passes(text)]
    wrong += [f"passes: {name}" for name, text in FAILING.items() if passes(text)]
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
