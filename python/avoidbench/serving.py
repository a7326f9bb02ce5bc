"""Serves a planner written in Python to the program avoidbench, which starts it: docs/process_planners.md has the
protocol. Needs NumPy and nothing else.

    if __name__ == "__main__":
        avoidbench.serve(MyPlanner)

A file that defines one planner needs not even that: `python -m avoidbench.serving FILE` serves it."""

import ast
import importlib.util
import inspect
import mmap
import os
import runpy
import struct
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from avoidbench import planner as p
from avoidbench import planner_abi as abi
from avoidbench.planner_files import planner_files
from avoidbench.planner_table import Table, error_line, fill_command

PROTOCOL = 1
MAGIC = b"avoidben"
VARIABLE = "AVOIDBENCH_PLANNER_FDS"
HELLO, CREATE, RESET, PLAN, DESTROY = 1, 2, 3, 4, 5

# Little-endian; in the segment each pointer is an offset. Names as in process_protocol.h and planner.h.
HEADER = struct.Struct("<8sIIQQQQ16x")
WORD = struct.Struct("<II")
REQUEST = struct.Struct("<IIQQ8x")
ANSWER = struct.Struct("<IIiIQQQQ16x")
DESCRIPTION = struct.Struct("<IIQQ")
PLANNER = struct.Struct("<IIQQQIIIIQQQQQQIIQdd")
PARAMETER = struct.Struct("<IiQQQdddQQ")
FILES = struct.Struct("<IIQ")
SETUP = struct.Struct("<IIQddd3ddddQIIQ")
VALUE = struct.Struct("<IIdQ")
CAMERA = struct.Struct("<IiiI4d3d4ddddd")
MISSION = struct.Struct("<IIQ3dd3ddd3d3dd")
OBSERVATION = struct.Struct("<IIQQIIQQIIQdIIQ")
DEPTH = struct.Struct("<IiiIddddd3d4dQII")
PICTURE = struct.Struct("<IiiIIIddddd3d4dQ")
STEREO = struct.Struct("<IIdQQ")
STATE_NUMBERS = 14
IMU_NUMBERS = 7
COMMAND_BYTES = 152
COMMAND_POINTS = 136


class _Segment:
    """The memory that is shared with the program."""

    def __init__(self, fd: int) -> None:
        self._fd = fd
        self.size = 0
        self.memory: Any = None
        self.look()

    def look(self) -> None:
        """Maps it as large as it is now."""
        if self.memory is None:
            header = os.pread(self._fd, HEADER.size, 0)
        else:
            header = self.memory[: HEADER.size]
        magic, protocol, abi_version, size, self.answer, self.answer_bytes, self.request = HEADER.unpack(header)
        if size == self.size:
            return
        if magic != MAGIC or protocol != PROTOCOL or abi_version != abi.ABI_VERSION:
            sys.exit(
                f"this avoidbench for Python speaks protocol {PROTOCOL} of ABI {abi.ABI_VERSION}, the program "
                f"{protocol} of {abi_version}"
            )
        # Pixels that a planner kept hold the old one.
        self.memory = mmap.mmap(self._fd, size)
        self.size = size

    def text(self, offset: int) -> str:
        end = self.memory.find(b"\0", offset)
        return bytes(self.memory[offset:end]).decode("utf-8", errors="replace")

    def offsets(self, offset: int, count: int) -> tuple[int, ...]:
        return struct.unpack_from(f"<{count}Q", self.memory, offset) if count else ()

    def pixels(self, kind: Any, offset: int, shape: tuple[int, ...]) -> NDArray[Any]:
        count = 1
        for length in shape:
            count *= length
        array: NDArray[Any] = np.frombuffer(self.memory, kind, count, offset).reshape(shape)
        array.flags.writeable = False
        return array


class _Writer:
    """An answer, written behind its head."""

    def __init__(self, segment: _Segment) -> None:
        self._segment = segment
        self.used = ANSWER.size

    def add(self, data: bytes) -> int:
        at = (self.used + 7) // 8 * 8
        if at + len(data) > self._segment.answer_bytes:
            raise ValueError(f"the answer is longer than {self._segment.answer_bytes} bytes")
        begin = self._segment.answer + at
        self._segment.memory[begin : begin + len(data)] = data
        self.used = at + len(data)
        return int(begin)

    def text(self, text: str) -> int:
        return self.add(text.encode("utf-8", errors="replace").replace(b"\0", b"") + b"\0")

    def offsets(self, offsets: Sequence[int]) -> int:
        return self.add(struct.pack(f"<{len(offsets)}Q", *offsets)) if offsets else 0


def _description(writer: _Writer, planner: type[p.Planner], table: Table, files: Sequence[str]) -> int:
    known = table.struct
    parameters = []
    for one in table.parameter_structs:
        texts = [
            0 if text is None else writer.add(text + b"\0")
            for text in (one.name, one.unit, one.doc, one.choices, one.preset_text)
        ]
        parameters.append(
            writer.add(
                PARAMETER.pack(PARAMETER.size, one.kind, *texts[:3], one.lowest, one.highest, one.preset, *texts[3:])
            )
        )
    name, version, summary = (writer.add(text + b"\0") for text in (known.name, known.version, known.summary))
    at = writer.add(
        PLANNER.pack(
            PLANNER.size,
            abi.ABI_VERSION,
            name,
            version,
            summary,
            known.needs,
            known.commands,
            len(parameters),
            0,
            writer.offsets(parameters),
            0,
            0,
            0,
            0,
            0,
            0,
            0,
            0,
            known.least_fov_x_rad,
            known.least_fov_y_rad,
        )
    )
    named = writer.offsets([writer.text(file) for file in files])
    files_at = writer.add(FILES.pack(FILES.size, len(files), named)) if files else 0
    return writer.add(DESCRIPTION.pack(DESCRIPTION.size, PROTOCOL, at, files_at))


def _setup(segment: _Segment, at: int, parameters: Sequence[p.Parameter]) -> p.Setup:
    (
        _,
        value_count,
        values_at,
        max_speed,
        max_acceleration,
        max_yaw_rate,
        *body,
        radius,
        period,
        gravity,
        _,
        camera_count,
        _,
        cameras_at,
    ) = SETUP.unpack_from(segment.memory, at)
    values: dict[str, Any] = {}
    for parameter, offset in zip(parameters, segment.offsets(values_at, value_count), strict=False):
        _, _, number, text = VALUE.unpack_from(segment.memory, offset)
        preset = parameter.preset
        values[parameter.name] = (
            segment.text(text) if isinstance(preset, str) else int(number) if isinstance(preset, int) else number
        )
    cameras = []
    for offset in segment.offsets(cameras_at, camera_count):
        _, width, height, _, fx, fy, cx, cy, *rest = CAMERA.unpack_from(segment.memory, offset)
        cameras.append(p.Camera(width, height, fx, fy, cx, cy, np.array(rest[:3]), np.array(rest[3:7]), *rest[7:]))
    return p.Setup(
        values, max_speed, max_acceleration, max_yaw_rate, np.array(body), radius, period, gravity, tuple(cameras)
    )


def _mission(segment: _Segment, at: int) -> p.Mission:
    _, _, seed, *numbers = MISSION.unpack_from(segment.memory, at)
    return p.Mission(
        seed,
        np.array(numbers[:3]),
        numbers[3],
        np.array(numbers[4:7]),
        numbers[7],
        numbers[8],
        np.array(numbers[9:12]),
        np.array(numbers[12:15]),
        numbers[15],
    )


def _depth(segment: _Segment, at: int) -> p.DepthImage:
    _, width, height, _, time_s, _, _, _, _, *pose, pixels, camera, _ = DEPTH.unpack_from(segment.memory, at)
    return p.DepthImage(
        time_s, segment.pixels(np.float32, pixels, (height, width)), np.array(pose[:3]), np.array(pose[3:]), camera
    )


def _picture(segment: _Segment, at: int) -> p.Picture:
    _, width, height, channels, camera, _, time_s, _, _, _, _, *pose, pixels = PICTURE.unpack_from(segment.memory, at)
    shape = (height, width) if channels == 1 else (height, width, channels)
    return p.Picture(time_s, segment.pixels(np.uint8, pixels, shape), np.array(pose[:3]), np.array(pose[3:]), camera)


def _stereo(segment: _Segment, at: int) -> p.StereoPair:
    _, _, baseline_m, left, right = STEREO.unpack_from(segment.memory, at)
    return p.StereoPair(_picture(segment, left), _picture(segment, right), baseline_m)


def _imu(segment: _Segment, at: int, count: int) -> p.ImuSamples:
    numbers = np.frombuffer(segment.memory, np.float64, count * IMU_NUMBERS, at).reshape(count, IMU_NUMBERS).copy()
    return p.ImuSamples(numbers[:, 0], numbers[:, 1:4], numbers[:, 4:7])


def _state_numbers(segment: _Segment, at: int) -> tuple[float, p.Vector, p.Vector, p.Vector, p.Vector]:
    numbers = np.frombuffer(segment.memory, np.float64, STATE_NUMBERS, at + 8).copy()
    return float(numbers[0]), numbers[1:4], numbers[4:7], numbers[7:11], numbers[11:14]


def _observation(segment: _Segment, at: int, sees_imu: bool) -> p.Observation:
    (
        _,
        depth_count,
        state_at,
        depth_at,
        stereo_count,
        color_count,
        stereo_at,
        color_at,
        imu_count,
        _,
        imu_at,
        time_s,
        state_count,
        _,
        states_at,
    ) = OBSERVATION.unpack_from(segment.memory, at)
    return p.Observation(
        *_state_numbers(segment, state_at),
        depth=tuple(_depth(segment, offset) for offset in segment.offsets(depth_at, depth_count)),
        stereo=tuple(_stereo(segment, offset) for offset in segment.offsets(stereo_at, stereo_count)),
        color=tuple(_picture(segment, offset) for offset in segment.offsets(color_at, color_count)),
        imu=_imu(segment, imu_at, imu_count) if sees_imu else None,
        call_time_s=time_s,
        states=tuple(p.State(*_state_numbers(segment, offset)) for offset in segment.offsets(states_at, state_count)),
    )


class _Server:
    def __init__(self, planner: type[p.Planner], files: Sequence[str], socket: int, segment: _Segment) -> None:
        self._class = planner
        self._table = Table(planner)
        self._parameters = tuple(planner.parameters)
        self._files = files
        self._sees_imu = "imu" in planner.sees
        self._socket = socket
        self._segment = segment
        self._instance: p.Planner | None = None
        self._command = abi.CommandStruct()

    def _plan(self, body: int, writer: _Writer) -> tuple[int, int]:
        assert self._instance is not None
        given = self._instance.plan(_observation(self._segment, body, self._sees_imu))
        if given is None:
            return abi.AB_NO_PLAN, 0
        if not isinstance(given, p.Command):
            raise TypeError(f"plan() gave {type(given).__name__}, which is no command")
        command = abi.CommandStruct(struct_size=COMMAND_BYTES)
        points = fill_command(command, given)
        data = bytearray(command)
        if points is not None:
            struct.pack_into("<Q", data, COMMAND_POINTS, writer.add(bytes(points)))
        return abi.AB_OK, writer.add(bytes(data))

    def _do(self, kind: int, body: int, writer: _Writer) -> tuple[int, int]:
        """The status and the answer's body."""
        if kind == PLAN:
            return self._plan(body, writer)
        if kind == RESET:
            assert self._instance is not None
            self._instance.reset(_mission(self._segment, body))
        elif kind == CREATE:
            self._instance = None
            self._instance = self._class(_setup(self._segment, body, self._parameters))
        elif kind == DESTROY:
            self._instance = None
        elif kind == HELLO:
            return abi.AB_OK, _description(writer, self._class, self._table, self._files)
        else:
            raise ValueError(f"request {kind} is unknown")
        return abi.AB_OK, 0

    def _answer(self) -> bytes:
        sequence, kind, _, body = REQUEST.unpack_from(self._segment.memory, self._segment.request)
        writer = _Writer(self._segment)
        error = 0
        answer_body = 0
        try:
            status, answer_body = self._do(kind, body, writer)
        except p.GiveUp as reason:
            status = abi.AB_GIVE_UP
            error = writer.text(str(reason))
        except BaseException as problem:  # also what sys.exit() raises: an error of this trial, not the program's end
            status = abi.AB_ERROR
            writer.used = ANSWER.size
            error = writer.text(error_line(problem, __file__))
        ANSWER.pack_into(
            self._segment.memory, self._segment.answer, sequence, kind, status, 0, writer.used, answer_body, error, 0
        )
        return WORD.pack(sequence, kind)

    def run(self) -> None:
        """Until the program lets go of the planner."""
        while True:
            try:
                word = os.read(self._socket, WORD.size)
            except ConnectionResetError:
                return
            if len(word) < WORD.size:
                return
            self._segment.look()
            answer = self._answer()
            try:
                os.write(self._socket, answer)
            except BrokenPipeError:
                return


def _script_of(planner: type[p.Planner]) -> Path:
    return Path(inspect.getfile(planner)).absolute()


def serve(planner: type[p.Planner], *, is_script_file: bool = True) -> None:
    """Serves `planner` until the program avoidbench, which started this process, lets go of it. Call it at the end of
    the script.

    is_script_file: whether the planner's file, of which trials know it, is the script that defines the class. With
    `command: [my_tool, model.yaml]` it is model.yaml: `files` are relative to its folder then, and modules of the
    script count only where `files` names them.

    Raises TypeError and ValueError for what the class declares wrongly. Started by hand it says how a planner is flown,
    with exit code 2."""
    given = os.environ.get(VARIABLE)
    if given is None:
        sys.exit(
            f"{planner.name} is a planner: name this file in a sweep of avoidbench, as plugin: "
            f"./{Path(sys.argv[0]).name}"
        )
    socket, segment = (int(fd) for fd in given.split(","))
    files = (
        planner_files(_script_of(planner), planner.files) if is_script_file else [str(name) for name in planner.files]
    )
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


def _planners_of(module: Any) -> list[type[p.Planner]]:
    return [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, p.Planner) and value.__module__ == module.__name__
    ]


def main(file: str) -> None:
    """Serves the planner of a file: by its own call of serve(), else the only one that it defines. A file without a
    planner is run as it is: it may speak the protocol itself."""
    script = Path(file).absolute()
    sys.argv = [str(script)]
    sys.path.insert(0, str(script.parent))
    if _serves_itself(script.read_bytes()):
        runpy.run_path(str(script), run_name="__main__")
        return
    spec = importlib.util.spec_from_file_location(script.stem, script)
    if spec is None or spec.loader is None:
        sys.exit(f"{script.name} can't be imported")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    planners = list(dict.fromkeys(_planners_of(module)))
    if len(planners) == 1:
        serve(planners[0])
    elif planners:
        sys.exit(
            f"{script.name} defines the planners {', '.join(one.__name__ for one in planners)}: say which one it is, "
            f'by if __name__ == "__main__": avoidbench.serve({planners[0].__name__}) at its end'
        )
    elif "AVOIDBENCH_PLANNER_FDS" in script.read_text(encoding="utf-8", errors="replace"):
        runpy.run_path(str(script), run_name="__main__")
    else:
        sys.exit(f"{script.name} defines no subclass of avoidbench.Planner")


if __name__ == "__main__":
    # By its import, not by this copy of it that Python runs as __main__.
    from avoidbench.serving import main as _main

    _main(sys.argv[1])
