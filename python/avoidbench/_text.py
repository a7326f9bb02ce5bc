"""Python's values as the YAML that the program reads."""

import json
import math
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy as np


def _plain(value: Any, name: str) -> Any:
    """`value` of dicts, lists, texts, numbers, bools and None alone."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    elif isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise TypeError(f"{name}: expected text as a key, got {type(key).__name__} {key!r}")
        return {plain_text(key, name): _plain(item, f"{name}.{key}") for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{name}[{i}]") for i, item in enumerate(value)]
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{name}: {value} is not finite")
    if isinstance(value, str):
        return plain_text(value, name)
    if value is None or isinstance(value, (bool, int, float)):
        return value
    raise TypeError(f"{name}: expected a number, text, list or mapping, got {type(value).__name__}")


def plain_text(text: str, name: str) -> str:
    """`text`, if the program can read it. Raises ValueError if it is not valid UTF-8 or has a byte 0."""
    try:
        text.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{name}: {text!r} can't be written in UTF-8") from None
    if "\0" in text:
        raise ValueError(f"{name}: {text!r} has a byte 0")
    return text


def yaml_text(value: Any, name: str) -> str:
    """`value` as YAML of one line. NumPy's numbers and arrays are taken as Python's, paths as text.

    Raises TypeError for values that YAML can't express, ValueError for numbers that are not finite; the message
    contains `name`."""
    return json.dumps(_plain(value, name), ensure_ascii=False, allow_nan=False)


def without_columns(message: str, name: str, shown: str | None = None) -> str:
    """A message about what yaml_text() wrote, without the places in that one line: what is wrong stands there by its
    key, and nobody saw the line. `name`: what the text is called there; `shown`: what it is called instead."""
    return re.sub(rf"^{re.escape(name)}(:1:\d+)?(?=: )", shown or name, message, flags=re.MULTILINE)


def overrides(fields: Mapping[str, Any], prefix: str = "") -> list[str]:
    """`prefix + key=value` for each field, as the program's option `--set` takes it.

    Raises TypeError and ValueError as yaml_text."""
    for key in fields:
        if not isinstance(key, str) or not key or "=" in key:
            raise ValueError(f"{key!r} is not the name of a field")
        plain_text(key, "name of a field")
    return [f"{prefix}{key}={yaml_text(value, key)}" for key, value in fields.items()]
