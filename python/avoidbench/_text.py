"""Python's values as the YAML that the program reads."""

import json
import math
import os
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
        return os.fspath(value)
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise TypeError(f"{name}: keys must be text, not {type(key).__name__} {key!r}")
        return {key: _plain(item, f"{name}.{key}") for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{name}[{i}]") for i, item in enumerate(value)]
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{name}: {value} is not finite")
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    raise TypeError(f"{name}: a number, text, list or mapping is wanted, not {type(value).__name__}")


def yaml_text(value: Any, name: str) -> str:
    """`value` as YAML of one line. NumPy's numbers and arrays are taken as Python's, paths as text.

    Raises TypeError for what YAML has no word for, ValueError for numbers that are not finite; `name` stands in the message."""
    return json.dumps(_plain(value, name), ensure_ascii=False, allow_nan=False)


def overrides(fields: Mapping[str, Any], prefix: str = "") -> list[str]:
    """`prefix + key=value` for each field, as the program's option `--set` takes it.

    Raises TypeError and ValueError as yaml_text."""
    for key in fields:
        if not isinstance(key, str) or not key or "=" in key:
            raise ValueError(f"{key!r} is no name of a field")
    return [f"{prefix}{key}={yaml_text(value, key)}" for key, value in fields.items()]
