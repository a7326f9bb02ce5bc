"""Serves a planner written in Python to the program avoidbench, which starts it: docs/process_planners.md has the
protocol. Needs NumPy and nothing else.

    if __name__ == "__main__":
        avoidbench.serve(MyPlanner)

A file that defines one planner does not even need that: `python -m avoidbench.serving FILE` serves it; to choose one
of several, add the class's name."""

import ast
import importlib.util
import inspect
import mmap
import os
import re
import runpy
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from avoidbench import _layouts as layouts
from avoidbench import planner as p
from avoidbench.planner_files import planner_files

_WORDS = {
    "inputs": (
        "AB_INPUT_",
        (
            "state",
            "depth",
            "stereo",
            "color",
            "imu",
            "states",
            "one_camera",
            "reference",
            "points",
            "tracks",
            "goals",
            "command",
        ),
    ),
    "uses": ("AB_USES_", ("processes", "devices", "network", "globals")),
    "commands": ("AB_COMMAND_", ("position", "velocity", "acceleration", "trajectory", "rates")),
}
"""What a class may declare, and with which prefix planner.h has it."""

Made = TypeVar("Made")


class _Segment:
    """The memory that is shared with the program."""

    def __init__(self, fd: int) -> None:
        self._fd = fd
        self._size = 0
        self.memory = mmap.mmap(fd, layouts.ab_process_header.itemsize)
        self._header = self.struct(layouts.ab_process_header, 0)
        self.look()

    def look(self) -> None:
        """Maps it as large as it is now."""
        size = self._header["segment_bytes"].item()
        if size == self._size:
            return
        spoken = tuple(self._header[name].item() for name in ("magic", "protocol", "abi_version"))
        ours = (layouts.AB_PROCESS_MAGIC.encode(), layouts.AB_PROCESS_PROTOCOL, layouts.AVOIDBENCH_ABI_VERSION)
        if spoken != ours:
            sys.exit(
                f"this avoidbench for Python speaks protocol {ours[1]} of ABI {ours[2]}, the program {spoken[1]} of "
                f"{spoken[2]}"
            )
        # Pixels that a planner kept hold the old one.
        self.memory = mmap.mmap(self._fd, size)
        self._size = size
        self._header = self.struct(layouts.ab_process_header, 0)
        self.answer_at, self.answer_bytes, request_at = (
            self._header[name].item() for name in ("answer_offset", "answer_bytes", "request_offset")
        )
        self.answer = self.struct(layouts.ab_process_answer, self.answer_at)
        self.request = self.struct(layouts.ab_process_request, request_at)

    def struct(self, layout: np.dtype[np.void], offset: int) -> NDArray[np.void]:
        return np.ndarray((), layout, self.memory, offset)

    def text(self, offset: int) -> str:
        end = self.memory.find(b"\0", offset)
        return self.memory[offset:end].decode("utf-8", errors="replace")

    def offsets(self, given: NDArray[np.void], name: str, count: str) -> list[int]:
        """The offsets in the array that this field names, of which another has the count."""
        length = given[count].item()
        if length == 0:
            return []
        offsets: list[int] = np.ndarray(length, np.uint64, self.memory, given[name].item()).tolist()
        return offsets

    def pixels(self, kind: Any, offset: int, shape: tuple[int, ...]) -> NDArray[Any]:
        array: NDArray[Any] = np.ndarray(shape, kind, self.memory, offset)
        array.flags.writeable = False
        return array


def _set(struct: NDArray[np.void], **fields: Any) -> None:
    for name, value in fields.items():
        struct[name] = value


class _Writer:
    """An answer, written behind its head."""

    def __init__(self, segment: _Segment) -> None:
        self._segment = segment
        self.used = layouts.ab_process_answer.itemsize

    def add(self, data: bytes) -> int:
        at = (self.used + 7) // 8 * 8
        if at + len(data) > self._segment.answer_bytes:
            raise ValueError(f"the answer is longer than {self._segment.answer_bytes} bytes")
        begin = self._segment.answer_at + at
        self._segment.memory[begin : begin + len(data)] = data
        self.used = at + len(data)
        return int(begin)

    def text(self, text: str) -> int:
        return self.add(text.encode("utf-8", errors="replace").replace(b"\0", b"") + b"\0")

    def offsets(self, offsets: Sequence[int]) -> int:
        return self.add(np.array(offsets, np.uint64).tobytes()) if offsets else 0

    def struct(self, layout: np.dtype[np.void], **fields: Any) -> int:
        """What is not given is 0."""
        struct = np.zeros((), layout)
        _set(struct, struct_size=layout.itemsize, **fields)
        return self.add(struct.tobytes())


def _bits(planner: type[p.Planner], what: str) -> int:
    words = getattr(planner, what)
    prefix, known = _WORDS[what]
    if isinstance(words, str):
        raise TypeError(f"{planner.__name__}.{what}: expected a list of words, got the text {words!r}")
    for word in words:
        if word not in known:
            raise ValueError(f"{planner.__name__}.{what}: expected words of {', '.join(known)}, got {word!r}")
    return sum(getattr(layouts, prefix + word.upper()) for word in set(words))


def check(planner: type[p.Planner]) -> None:
    """Raises TypeError and ValueError for what a class declares wrongly; the program checks the rest."""
    if not (isinstance(planner, type) and issubclass(planner, p.Planner)):
        raise TypeError(f"expected a subclass of avoidbench.Planner, got {planner!r}")
    name = getattr(planner, "name", None)
    if not isinstance(name, str) or not re.fullmatch("[a-z0-9_]+", name):
        raise ValueError(f"{planner.__name__}.name: expected a text of a-z 0-9 _, got {name!r}")
    for what in _WORDS:
        _bits(planner, what)
    for parameter in planner.parameters:
        preset = parameter.preset
        if isinstance(preset, bool) or not isinstance(preset, (int, float, str)):
            raise TypeError(
                f"parameter {parameter.name}: expected a number or a text as its preset, got {type(preset).__name__}"
            )


def _parameter(writer: _Writer, parameter: p.Parameter) -> int:
    fields: dict[str, Any] = {name: writer.text(getattr(parameter, name)) for name in ("name", "unit", "doc")}
    preset = parameter.preset
    if isinstance(preset, str):
        fields["kind"] = layouts.AB_CHOICE if parameter.choices else layouts.AB_TEXT
        fields["choices"] = writer.text("|".join(parameter.choices))
        fields["preset_text"] = writer.text(preset)
    else:
        fields["kind"] = layouts.AB_INTEGER if isinstance(preset, int) else layouts.AB_NUMBER
        fields.update(lowest=parameter.lowest, highest=parameter.highest, preset=preset)
    return writer.struct(layouts.ab_parameter, **fields)


def _description(writer: _Writer, planner: type[p.Planner], files: Sequence[str]) -> int:
    check(planner)
    parameters = [_parameter(writer, parameter) for parameter in planner.parameters]
    described = writer.struct(
        layouts.ab_planner,
        abi_version=layouts.AVOIDBENCH_ABI_VERSION,
        name=writer.text(planner.name),
        version=writer.text(planner.version),
        summary=writer.text(planner.summary or planner.name),
        needs=_bits(planner, "inputs") | layouts.AB_INPUT_STATE | _bits(planner, "uses"),
        commands=_bits(planner, "commands"),
        parameter_count=len(parameters),
        parameters=writer.offsets(parameters),
        least_fov_x_rad=planner.least_fov_rad[0],
        least_fov_y_rad=planner.least_fov_rad[1],
    )
    named = writer.offsets([writer.text(file) for file in files])
    return writer.struct(
        layouts.ab_process_description,
        protocol=layouts.AB_PROCESS_PROTOCOL,
        planner=described,
        files=writer.struct(layouts.ab_files, file_count=len(files), files=named) if files else 0,
    )


def _made(kind: type[Made], given: NDArray[np.void], /, **others: Any) -> Made:
    """One of planner.py's dataclasses, whose fields are named as in the struct, except for `others`."""
    for name in kind.__dataclass_fields__:  # type: ignore[attr-defined]
        if name not in others:
            value = given[name]
            others[name] = value.copy() if value.shape else value.item()
    return kind(**others)


def _setup(segment: _Segment, at: int, parameters: Sequence[p.Parameter]) -> p.Setup:
    given = segment.struct(layouts.ab_setup, at)
    values: dict[str, Any] = {}
    for parameter, offset in zip(parameters, segment.offsets(given, "values", "value_count"), strict=True):
        value, preset = segment.struct(layouts.ab_value, offset), parameter.preset
        if isinstance(preset, str):
            values[parameter.name] = segment.text(value["text"].item())
        else:
            number = value["number"].item()
            values[parameter.name] = int(number) if isinstance(preset, int) else number
    cameras = (
        segment.struct(layouts.ab_camera, offset) for offset in segment.offsets(given, "cameras", "camera_count")
    )
    lidars = (segment.struct(layouts.ab_lidar, offset) for offset in segment.offsets(given, "lidars", "lidar_count"))
    return _made(
        p.Setup,
        given,
        parameters=values,
        cameras=tuple(_made(p.Camera, camera) for camera in cameras),
        lidars=tuple(_made(p.Lidar, lidar, is_deskewed=lidar["is_deskewed"].item() == 1) for lidar in lidars),
    )


def _depth(segment: _Segment, at: int) -> p.DepthImage:
    given = segment.struct(layouts.ab_depth_image, at)
    shape = (given["height_px"].item(), given["width_px"].item())
    return _made(p.DepthImage, given, depth_m=segment.pixels(np.float32, given["depth_m"].item(), shape))


def _picture(segment: _Segment, at: int) -> p.Picture:
    given = segment.struct(layouts.ab_picture, at)
    channels = given["channels"].item()
    shape = (given["height_px"].item(), given["width_px"].item(), *((channels,) if channels != 1 else ()))
    return _made(p.Picture, given, pixels=segment.pixels(np.uint8, given["pixels"].item(), shape))


def _stereo(segment: _Segment, at: int) -> p.StereoPair:
    given = segment.struct(layouts.ab_stereo_pair, at)
    left, right = (_picture(segment, given[name].item()) for name in ("left", "right"))
    return _made(p.StereoPair, given, left=left, right=right)


def _cloud(segment: _Segment, at: int) -> p.Cloud:
    given = segment.struct(layouts.ab_cloud, at)
    shape = (given["point_count"].item(), 5)
    numbers = segment.pixels(np.float32, given["points"].item(), shape)
    misses = segment.pixels(np.float32, given["misses_lidar"].item(), (given["miss_count"].item(), 3))
    return _made(
        p.Cloud,
        given,
        points_lidar_m=numbers[:, :3],
        point_times_s=numbers[:, 3],
        intensities=numbers[:, 4],
        misses_lidar=misses,
    )


def _imu(segment: _Segment, given: NDArray[np.void]) -> p.ImuSamples:
    samples: NDArray[np.void] = np.ndarray(
        given["imu_count"].item(), layouts.ab_imu_sample, segment.memory, given["imu"].item()
    )
    return _made(p.ImuSamples, samples)


def _reference(segment: _Segment, at: int) -> p.Reference | None:
    if at == 0:
        return None
    point: NDArray[np.void] = np.ndarray((), layouts.ab_point, segment.memory, at)
    return _made(p.Reference, point)


def _mission(segment: _Segment, at: int) -> p.Mission:
    given = segment.struct(layouts.ab_mission, at)
    shape = (given["goal_count"].item(), 3)
    return _made(
        p.Mission, given, goals_world_m=segment.pixels(np.float64, given["goals_world_m"].item(), shape).copy()
    )


_TRACK_KINDS = ("other", "person", "box", "ball", "pole")


def _tracks(segment: _Segment, given: NDArray[np.void]) -> tuple[p.Track, ...]:
    count = int(given["track_count"])
    if count == 0:
        return ()
    tracks: NDArray[np.void] = np.ndarray((count,), layouts.ab_track, segment.memory, int(given["tracks"]))
    return tuple(_made(p.Track, track, kind=_TRACK_KINDS[track["kind"].item()]) for track in tracks)


def _wanted(segment: _Segment, at: int) -> p.Command | None:
    if at == 0:
        return None
    given = segment.struct(layouts.ab_command, at)
    held = {"horizon_s": given["horizon_s"].item()}
    kind = given["kind"].item()
    if kind == layouts.AB_COMMAND_TRAJECTORY:
        points: NDArray[np.void] = np.ndarray(
            given["point_count"].item(), layouts.ab_point, segment.memory, given["points"].item()
        )
        return _made(p.Trajectory, points, **held)
    if kind == layouts.AB_COMMAND_RATES:
        return _made(p.Rates, given, **held)
    turns = given["flags"].item() & layouts.AB_YAW_IS_RATE
    yaw = {
        "yaw_rad": None if turns else given["yaw_rad"].item(),
        "yaw_rate_radps": given["yaw_rate_radps"].item() if turns else None,
    }
    if kind == layouts.AB_COMMAND_VELOCITY:
        return _made(p.Velocity, given, **held, **yaw)
    if kind == layouts.AB_COMMAND_ACCELERATION:
        return _made(p.Acceleration, given, **held, **yaw)
    return _made(p.Position, given, **held, **yaw)


def _observation(segment: _Segment, at: int, inputs: Sequence[str]) -> p.Observation:
    given = segment.struct(layouts.ab_observation, at)
    states = (segment.struct(layouts.ab_state, offset) for offset in segment.offsets(given, "states", "state_count"))
    return _made(
        p.Observation,
        segment.struct(layouts.ab_state, given["state"].item()),
        depth=tuple(_depth(segment, offset) for offset in segment.offsets(given, "depth", "depth_count")),
        stereo=tuple(_stereo(segment, offset) for offset in segment.offsets(given, "stereo", "stereo_count")),
        color=tuple(_picture(segment, offset) for offset in segment.offsets(given, "color", "color_count")),
        imu=_imu(segment, given) if "imu" in inputs else None,
        call_time_s=given["time_s"].item(),
        states=tuple(_made(p.State, state) for state in states),
        reference=_reference(segment, given["reference"].item()),
        clouds=tuple(_cloud(segment, offset) for offset in segment.offsets(given, "clouds", "cloud_count")),
        goal_index=given["goal_index"].item(),
        goal_world_m=given["goal_world_m"].copy() if "goals" in inputs else None,
        tracks=_tracks(segment, given),
        wanted=_wanted(segment, given["wanted"].item()),
    )


def _shaped(values: ArrayLike, name: str, *shapes: tuple[int, ...]) -> NDArray[np.float64]:
    array = np.asarray(values, np.float64)
    if array.shape not in shapes:
        raise ValueError(f"{name}: expected an array of shape {shapes[-1]}, got {array.shape}")
    return array


def _points(trajectory: p.Trajectory) -> NDArray[np.void]:
    times = np.asarray(trajectory.time_s, np.float64)
    if times.ndim != 1:
        raise ValueError(f"time_s: expected an array of shape (N,), got {times.shape}")
    points = np.zeros(len(times), layouts.ab_point)
    points["time_s"] = times
    for name in ("position_world_m", "velocity_world_mps", "acceleration_world_mps2"):
        points[name] = _shaped(getattr(trajectory, name), name, (len(times), 3))
    for name in ("yaw_rad", "yaw_rate_radps"):
        points[name] = _shaped(getattr(trajectory, name), name, (), (len(times),))
    return points


def _command(writer: _Writer, given: p.Command) -> int:
    fields: dict[str, Any] = {"horizon_s": given.horizon_s}
    if isinstance(given, p.Trajectory):
        points = _points(given)
        fields.update(kind=layouts.AB_COMMAND_TRAJECTORY, point_count=len(points), points=writer.add(points.tobytes()))
        return writer.struct(layouts.ab_command, **fields)
    if isinstance(given, p.Rates):
        kind, name = layouts.AB_COMMAND_RATES, "rates_body_radps"
        fields["thrust_mps2"] = given.thrust_mps2
    elif given.yaw_rad is not None and given.yaw_rate_radps is not None:
        raise ValueError("expected yaw_rad or yaw_rate_radps, got both")
    elif given.yaw_rad is not None:
        fields["yaw_rad"] = given.yaw_rad
    else:
        fields.update(flags=layouts.AB_YAW_IS_RATE, yaw_rate_radps=given.yaw_rate_radps or 0.0)
    if isinstance(given, p.Velocity):
        kind, name = layouts.AB_COMMAND_VELOCITY, "velocity_world_mps"
    elif isinstance(given, p.Acceleration):
        kind, name = layouts.AB_COMMAND_ACCELERATION, "acceleration_world_mps2"
    elif isinstance(given, p.Position):
        kind, name = layouts.AB_COMMAND_POSITION, "position_world_m"
    fields[name] = _shaped(getattr(given, name), name, (3,))
    return writer.struct(layouts.ab_command, kind=kind, **fields)


def _passed_on(writer: _Writer, segment: _Segment, observation_at: int) -> int:
    """The wanted command as it came, bit for bit."""
    given = segment.struct(layouts.ab_command, segment.struct(layouts.ab_observation, observation_at)["wanted"].item())
    command = given.copy()
    count = given["point_count"].item()
    if count > 0:
        begin = given["points"].item()
        points = segment.memory[begin : begin + count * layouts.ab_point.itemsize]
        command["points"] = writer.add(points)
    return writer.add(command.tobytes())


def _error_line(error: BaseException) -> str:
    """The exception and its innermost place in no file of ours, in one line."""
    frames = traceback.extract_tb(error.__traceback__)
    text = " ".join(f"{type(error).__name__}: {error}".split())
    own = [frame for frame in frames if frame.filename != __file__]
    return f"{text} ({own[-1].filename.rsplit('/', 1)[-1]}:{own[-1].lineno})" if own else text


class _Server:
    def __init__(self, planner: type[p.Planner], files: Sequence[str], socket: int, segment: _Segment) -> None:
        self._class = planner
        self._files = files
        self._socket = socket
        self._segment = segment
        self._instance: p.Planner | None = None

    def _plan(self, body: int, writer: _Writer) -> tuple[int, int]:
        assert self._instance is not None
        observation = _observation(self._segment, body, self._class.inputs)
        given = self._instance.plan(observation)
        if given is None:
            return layouts.AB_NO_PLAN, 0
        if given is observation.wanted:
            return layouts.AB_OK, _passed_on(writer, self._segment, body)
        if not isinstance(given, p.Command):
            raise TypeError(f"plan(): expected a command or None, got {type(given).__name__}")
        return layouts.AB_OK, _command(writer, given)

    def _do(self, kind: int, body: int, writer: _Writer) -> tuple[int, int]:
        """The status and the answer's body."""
        if kind == layouts.AB_PROCESS_PLAN:
            return self._plan(body, writer)
        if kind == layouts.AB_PROCESS_RESET:
            assert self._instance is not None
            self._instance.reset(_mission(self._segment, body))
        elif kind == layouts.AB_PROCESS_CREATE:
            self._instance = None
            self._instance = self._class(_setup(self._segment, body, self._class.parameters))
        elif kind == layouts.AB_PROCESS_DESTROY:
            self._instance = None
        elif kind == layouts.AB_PROCESS_HELLO:
            return layouts.AB_OK, _description(writer, self._class, self._files)
        else:
            raise ValueError(f"request {kind} is unknown")
        return layouts.AB_OK, 0

    def _answer(self) -> None:
        sequence, kind, body = (self._segment.request[name].item() for name in ("sequence", "kind", "body"))
        writer = _Writer(self._segment)
        error = 0
        answer_body = 0
        try:
            status, answer_body = self._do(kind, body, writer)
        except p.GiveUp as reason:
            status = layouts.AB_GIVE_UP
            error = writer.text(str(reason))
        except BaseException as problem:  # also what sys.exit() raises: an error of this trial, not the program's end
            status = layouts.AB_ERROR
            writer.used = layouts.ab_process_answer.itemsize
            error = writer.text(_error_line(problem))
        _set(
            self._segment.answer,
            sequence=sequence,
            kind=kind,
            status=status,
            bytes=writer.used,
            body=answer_body,
            error=error,
            log_count=0,
            log=0,
        )

    def run(self) -> None:
        """Until the program lets go of the planner."""
        while True:
            try:
                word = os.read(self._socket, layouts.ab_process_word.itemsize)
            except ConnectionResetError:
                return
            if len(word) < layouts.ab_process_word.itemsize:
                return
            self._segment.look()
            self._answer()
            try:
                os.write(self._socket, word)
            except BrokenPipeError:
                return


def serve(planner: type[p.Planner], *, is_script_file: bool = True) -> None:
    """Serves `planner` until the program avoidbench, which started this process, releases it. Call it at the end of
    the script.

    is_script_file: whether the planner's file, which identifies it in trials, is the script that defines the class.
    With `command: [my_tool, model.yaml]` it is model.yaml: `files` are then relative to its folder, and modules of the
    script count only if `files` names them.

    The program reports wrong declarations of the class. Started by hand, it prints how to fly a planner and exits with
    code 2."""
    given = os.environ.get(layouts.AB_PROCESS_VARIABLE)
    if given is None:
        sys.exit(
            f"{planner.name} is a planner: name this file in a sweep of avoidbench, as plugin: "
            f"./{Path(sys.argv[0]).name}"
        )
    socket, segment = (int(fd) for fd in given.split(","))
    script = Path(inspect.getfile(planner)).absolute()
    files = planner_files(script, planner.files) if is_script_file else [str(name) for name in planner.files]
    _Server(planner, files, socket, _Segment(segment)).run()


def _serves_itself(source: bytes) -> bool:
    """Whether the script calls serve()."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call):
            name = (
                node.func.attr
                if isinstance(node.func, ast.Attribute)
                else node.func.id
                if isinstance(node.func, ast.Name)
                else ""
            )
            if name == "serve":
                return True
    return False


def planners_of(module: Any) -> dict[str, type[p.Planner]]:
    """The planners that a module defines, by the names of their classes."""
    return {
        value.__name__: value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, p.Planner) and value.__module__ == module.__name__
    }


def main(file: str, name: str | None = None) -> None:
    """Serves the planner of a file: the class of this name, else by its own call of serve(), else the only one that it
    defines. A file without a planner is run as it is: it may speak the protocol itself."""
    script = Path(file).absolute()
    sys.argv = [str(script)]
    sys.path.insert(0, str(script.parent))
    if name is None and _serves_itself(script.read_bytes()):
        runpy.run_path(str(script), run_name="__main__")
        return
    spec = importlib.util.spec_from_file_location(script.stem, script)
    if spec is None or spec.loader is None:
        sys.exit(f"{script.name} can't be imported")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    planners = planners_of(module)
    if name in planners:
        serve(planners[name])
    elif name is not None:
        sys.exit(
            f"{script.name}: expected one of its planners ({', '.join(planners) or 'it defines none'}), got {name}"
        )
    elif len(planners) == 1:
        serve(*planners.values())
    elif planners:
        sys.exit(
            f"{script.name} defines the planners {', '.join(planners)}: choose one with `plugin: process, "
            f"parameters: {{command: [python3, -m, avoidbench.serving, {script.name}, {next(iter(planners))}]}}`"
        )
    elif layouts.AB_PROCESS_VARIABLE in script.read_text(encoding="utf-8", errors="replace"):
        runpy.run_path(str(script), run_name="__main__")
    else:
        sys.exit(f"{script.name} defines no subclass of avoidbench.Planner")


if __name__ == "__main__":
    # By its import, not by this copy of it that Python runs as __main__.
    from avoidbench.serving import main as _main

    _main(*sys.argv[1:3])
