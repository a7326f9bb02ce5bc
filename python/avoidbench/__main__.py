"""The program itself: `avoidbench …` and `python -m avoidbench …`."""

import os
import sys

from avoidbench._location import program_file


def main() -> None:
    """Becomes the program, with this process's arguments. Exits with code 2 if it is missing."""
    try:
        file = program_file()
    except FileNotFoundError as error:
        print(f"avoidbench: {error}", file=sys.stderr)
        sys.exit(2)
    os.execv(file, ["avoidbench", *sys.argv[1:]])


if __name__ == "__main__":
    main()
