"""The extension avoidbench._core, which is told here where the program lies.

Importing this raises ImportError, which says what to do, where there is no extension that this Python can load."""

from pathlib import Path

from avoidbench._location import tell_program_file


def _advice(error: ImportError) -> str:
    others = sorted(file.name for file in Path(__file__).parent.absolute().glob("_core.*.so"))
    of_another = f"; there is {', '.join(others)}" if isinstance(error, ModuleNotFoundError) and others else ""
    return (
        f"this needs the extension avoidbench._core, which can't be imported ({error}{of_another}). Install the "
        "package from a wheel or with `pip install .` in the repository (docs/install.md), or build it there with "
        "`cmake --build build/release --target python` and set PYTHONPATH=build/release/python. Without it, "
        "avoidbench.read() reads results"
    )


try:
    import avoidbench._core as core
except ImportError as missing:
    raise ImportError(_advice(missing), name="avoidbench._core") from missing

InputError = core.InputError
InputError.__module__ = "avoidbench"
tell_program_file(core.set_program_file)

__all__ = ["InputError", "core"]
