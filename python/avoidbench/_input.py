"""Errors of what was given as a dict."""

from collections.abc import Iterator
from contextlib import contextmanager

from avoidbench._extension import InputError
from avoidbench._text import without_columns


@contextmanager
def plain_places(name: str | None) -> Iterator[None]:
    """Within it, an InputError names the keys of the dict called `name`, and no column of the line that was made of it.
    None: of files, whose errors keep their places."""
    try:
        yield
    except InputError as error:
        if name is None:
            raise
        raise InputError(without_columns(str(error), name)) from None
