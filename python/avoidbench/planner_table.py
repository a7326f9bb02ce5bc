"""A class of avoidbench.Planner as the C table by which libraries are flown: the program's side sees no difference."""

import ctypes as c
import os
import re
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from avoidbench import planner as p
from avoidbench import planner_abi as abi


@dataclass
class _Instance:
    """A planner that was made, and what the program needs beside it."""

    planner: p.Planner
    host: Any
    cameras: tuple[p.Camera, ...]
    points: Any = field(default=None)
    """Of the last trajectory: the program reads them after plan() has returned."""


def _vector(values: Any) -> NDArray[np.float64]:
    return np.array(values, np.float64)


def _text(value: bytes | None) -> str:
    return (value or b"").decode("utf-8", errors="replace")


def _parameter_struct(parameter: p.Parameter) -> abi.ParameterStruct:
    preset = parameter.preset
    if isinstance(preset, bool) or not isinstance(preset, (int, float, str)):
        raise TypeError(
            f"parameter {parameter.name}: the preset must be a number or a text, not {type(preset).__name__}"
        )
    struct = abi.ParameterStruct(
        struct_size=c.sizeof(abi.ParameterStruct),
        name=parameter.name.encode(),
        unit=parameter.unit.encode(),
        doc=parameter.doc.encode(),
    )
    if isinstance(preset, str):
        struct.kind = abi.CHOICE if parameter.choices else abi.TEXT
        struct.choices = "|".join(parameter.choices).encode()
        struct.preset_text = preset.encode()
        return struct
    struct.kind = abi.INTEGER if isinstance(preset, int) else abi.NUMBER
    struct.lowest, struct.highest, struct.preset = parameter.lowest, parameter.highest, preset
    return struct


def _camera(struct: abi.CameraStruct) -> p.Camera:
    return p.Camera(
        struct.width_px,
        struct.height_px,
        struct.fx_px,
        struct.fy_px,
        struct.cx_px,
        struct.cy_px,
        _vector(struct.position_body_m),
        _vector(struct.q_body_camera),
        struct.rate_hz,
        struct.min_range_m,
        struct.max_range_m,
        struct.baseline_m,
    )


def _setup(struct: abi.SetupStruct, parameters: tuple[p.Parameter, ...]) -> p.Setup:
    values: dict[str, Any] = {}
    for i, parameter in enumerate(parameters):
        value = struct.values[i].contents
        preset = parameter.preset
        values[parameter.name] = (
            _text(value.text)
            if isinstance(preset, str)
            else int(value.number)
            if isinstance(preset, int)
            else value.number
        )
    return p.Setup(
        values,
        struct.max_speed_mps,
        struct.max_acceleration_mps2,
        struct.max_yaw_rate_radps,
        _vector(struct.body_size_m),
        struct.body_radius_m,
        struct.plan_period_s,
        struct.gravity_mps2,
        tuple(_camera(struct.cameras[i].contents) for i in range(struct.camera_count)),
    )


def _mission(struct: abi.MissionStruct) -> p.Mission:
    return p.Mission(
        struct.seed,
        _vector(struct.start_world_m),
        struct.start_yaw_rad,
        _vector(struct.goal_world_m),
        struct.goal_radius_m,
        struct.time_limit_s,
        _vector(struct.lowest_world_m),
        _vector(struct.highest_world_m),
        struct.command_latency_s,
    )


def _pixels(pointer: Any, shape: tuple[int, ...]) -> NDArray[Any]:
    pixels = np.ctypeslib.as_array(pointer, shape=shape)
    pixels.flags.writeable = False
    return pixels


def _depth(struct: abi.DepthStruct) -> p.DepthImage:
    return p.DepthImage(
        struct.time_s,
        _pixels(struct.depth_m, (struct.height_px, struct.width_px)),
        _vector(struct.position_world_m),
        _vector(struct.q_world_camera),
        struct.camera,
    )


def _picture(struct: abi.PictureStruct) -> p.Picture:
    shape: tuple[int, ...] = (struct.height_px, struct.width_px)
    if struct.channels != 1:
        shape = (*shape, struct.channels)
    return p.Picture(
        struct.time_s,
        _pixels(struct.pixels, shape),
        _vector(struct.position_world_m),
        _vector(struct.q_world_camera),
        struct.camera,
    )


def _imu(struct: abi.ObservationStruct) -> p.ImuSamples:
    if struct.imu_count == 0:
        return p.ImuSamples(np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)))
    numbers = np.ctypeslib.as_array(c.cast(struct.imu, c.POINTER(c.c_double)), shape=(struct.imu_count, 7)).copy()
    return p.ImuSamples(numbers[:, 0], numbers[:, 1:4], numbers[:, 4:7])


def _state(struct: abi.StateStruct) -> p.State:
    return p.State(
        struct.time_s,
        _vector(struct.position_world_m),
        _vector(struct.velocity_world_mps),
        _vector(struct.q_world_body),
        _vector(struct.rates_body_radps),
    )


def _observation(struct: abi.ObservationStruct, sees_imu: bool) -> p.Observation:
    state = struct.state.contents
    stereo = [struct.stereo[i].contents for i in range(struct.stereo_count)]
    return p.Observation(
        state.time_s,
        _vector(state.position_world_m),
        _vector(state.velocity_world_mps),
        _vector(state.q_world_body),
        _vector(state.rates_body_radps),
        depth=tuple(_depth(struct.depth[i].contents) for i in range(struct.depth_count)),
        stereo=tuple(
            p.StereoPair(_picture(pair.left.contents), _picture(pair.right.contents), pair.baseline_m)
            for pair in stereo
        ),
        color=tuple(_picture(struct.color[i].contents) for i in range(struct.color_count)),
        imu=_imu(struct) if sees_imu else None,
        call_time_s=struct.time_s,
        states=tuple(_state(struct.states[i].contents) for i in range(struct.state_count)),
    )


def _three(values: Any, name: str) -> list[float]:
    array = np.asarray(values, np.float64)
    if array.shape != (3,):
        raise ValueError(f"{name}: an array (3,) is wanted, not {array.shape}")
    return array.tolist()  # type: ignore[no-any-return]


def _fill_points(command: abi.CommandStruct, trajectory: p.Trajectory) -> Any:
    times = np.asarray(trajectory.time_s, np.float64)
    if times.ndim != 1:
        raise ValueError(f"time_s: an array (N,) is wanted, not {times.shape}")
    count = len(times)
    points = (abi.PointStruct * max(count, 1))()
    numbers = np.ctypeslib.as_array(c.cast(points, c.POINTER(c.c_double)), shape=(max(count, 1), 15))
    columns = [
        ("position_world_m", slice(1, 4)),
        ("velocity_world_mps", slice(4, 7)),
        ("acceleration_world_mps2", slice(7, 10)),
    ]
    for name, column in columns:
        array = np.asarray(getattr(trajectory, name), np.float64)
        if array.shape != (count, 3):
            raise ValueError(f"{name}: an array ({count}, 3) is wanted, not {array.shape}")
        numbers[:count, column] = array
    for name, index in (("yaw_rad", 13), ("yaw_rate_radps", 14)):
        array = np.asarray(getattr(trajectory, name), np.float64)
        if array.shape not in ((), (count,)):
            raise ValueError(f"{name}: an array ({count},) is wanted, not {array.shape}")
        numbers[:count, index] = array
    numbers[:count, 0] = times
    command.point_count = count
    command.points = c.cast(points, c.POINTER(abi.PointStruct))
    return points


def fill_command(command: abi.CommandStruct, given: p.Command) -> Any:
    """Writes the command; what must live as long as it."""
    command.horizon_s = given.horizon_s
    if isinstance(given, p.Trajectory):
        command.kind = abi.COMMANDS["trajectory"]
        return _fill_points(command, given)
    if isinstance(given, p.Rates):
        command.kind = abi.COMMANDS["rates"]
        command.rates_body_radps[:] = _three(given.rates_body_radps, "rates_body_radps")
        command.thrust_mps2 = given.thrust_mps2
        return None
    if given.yaw_rad is not None and given.yaw_rate_radps is not None:
        raise ValueError("yaw_rad and yaw_rate_radps: one of the two is wanted")
    if given.yaw_rad is not None:
        command.yaw_rad = given.yaw_rad
    else:
        command.flags = abi.YAW_IS_RATE
        command.yaw_rate_radps = given.yaw_rate_radps or 0.0
    if isinstance(given, p.Velocity):
        command.kind = abi.COMMANDS["velocity"]
        command.velocity_world_mps[:] = _three(given.velocity_world_mps, "velocity_world_mps")
    elif isinstance(given, p.Acceleration):
        command.kind = abi.COMMANDS["acceleration"]
        command.acceleration_world_mps2[:] = _three(given.acceleration_world_mps2, "acceleration_world_mps2")
    else:
        command.kind = abi.COMMANDS["position"]
        command.position_world_m[:] = _three(given.position_world_m, "position_world_m")
    return None


def error_line(error: BaseException, *ours: str) -> str:
    """The exception and its innermost place in no file of `ours` or this one, in one line."""
    frames = traceback.extract_tb(error.__traceback__)
    text = " ".join(f"{type(error).__name__}: {error}".split())
    own = [frame for frame in frames if frame.filename not in (__file__, *ours)]
    return f"{text} ({own[-1].filename.rsplit('/', 1)[-1]}:{own[-1].lineno})" if own else text


class Table:
    """The ab_planner of a class. Keep it for as long as the class may be flown.

    Raises TypeError and ValueError for what a class declares wrongly; the program checks the rest."""

    def __init__(self, planner: type[p.Planner]) -> None:
        if not (isinstance(planner, type) and issubclass(planner, p.Planner)):
            raise TypeError(f"a subclass of avoidbench.Planner is wanted, not {planner!r}")
        name = getattr(planner, "name", None)
        if not isinstance(name, str) or not re.fullmatch("[a-z0-9_]+", name):
            raise ValueError(f"{planner.__name__}.name: a text of a-z 0-9 _ is wanted, not {name!r}")
        self._class = planner
        self._parameters = tuple(planner.parameters)
        self._instances: dict[int, _Instance] = {}
        self._last = 0
        self.parameter_structs = [_parameter_struct(parameter) for parameter in self._parameters]
        structs = self.parameter_structs
        pointers = (c.POINTER(abi.ParameterStruct) * max(len(structs), 1))(*[c.pointer(struct) for struct in structs])
        self._files = abi.FilesStruct()
        # ctypes keeps neither functions nor structs alive that a struct points to.
        self._kept: list[Any] = [pointers]
        self.struct = abi.PlannerStruct(
            struct_size=c.sizeof(abi.PlannerStruct),
            abi_version=abi.ABI_VERSION,
            name=name.encode(),
            version=planner.version.encode(),
            summary=(planner.summary or name).encode(),
            needs=self._bits("sees", planner.sees, abi.SEES)
            | abi.SEES["state"]
            | self._bits("uses", planner.uses, abi.USES),
            commands=self._bits("commands", planner.commands, abi.COMMANDS),
            parameter_count=len(structs),
            parameters=c.cast(pointers, c.POINTER(c.POINTER(abi.ParameterStruct))),
            create=abi.Create(self._create),
            destroy=abi.Destroy(self._destroy),
            reset=abi.Reset(self._reset),
            plan=abi.Plan(self._plan),
            get_extension=abi.GetExtension(self._get_extension),
            least_fov_x_rad=planner.least_fov_rad[0],
            least_fov_y_rad=planner.least_fov_rad[1],
        )

    def name_files(self, files: Sequence[str]) -> None:
        """The files that the planner depends on, from now on: before it is registered."""
        names = (c.c_char_p * max(len(files), 1))(*[os.fsencode(file) for file in files])
        self._files = abi.FilesStruct(
            struct_size=c.sizeof(abi.FilesStruct), file_count=len(files), files=c.cast(names, c.POINTER(c.c_char_p))
        )
        self._kept.append(names)

    def _get_extension(self, number: int | None, name: bytes) -> int | None:
        return c.addressof(self._files) if name == abi.FILES_EXTENSION and self._files.file_count else None

    @property
    def address(self) -> int:
        return c.addressof(self.struct)

    def _bits(self, what: str, words: Any, known: dict[str, int]) -> int:
        if isinstance(words, str):
            raise TypeError(f"{self._class.__name__}.{what}: a list of words is wanted, not the text {words!r}")
        for word in words:
            if word not in known:
                raise ValueError(f"{self._class.__name__}.{what}: {word!r} is none of {', '.join(known)}")
        return sum(known[word] for word in set(words))

    def _create(self, host: Any, setup: Any) -> int:
        try:
            made = _setup(setup.contents, self._parameters)
            planner = self._class(made)
        except BaseException as error:
            host.contents.set_error(host.contents.context, error_line(error).encode())
            return 0
        self._last += 1
        self._instances[self._last] = _Instance(planner, host.contents, made.cameras)
        return self._last

    def _destroy(self, number: int) -> None:
        self._instances.pop(number, None)

    def _guarded(self, number: int, call: Callable[[_Instance], int]) -> int:
        instance = self._instances[number]
        try:
            return call(instance)
        except p.GiveUp as error:
            instance.host.set_error(instance.host.context, str(error).encode())
            return abi.AB_GIVE_UP
        except BaseException as error:  # none may leave a call
            instance.host.set_error(instance.host.context, error_line(error).encode())
            return abi.AB_ERROR

    def _reset(self, number: int, mission: Any) -> int:
        def call(instance: _Instance) -> int:
            instance.planner.reset(_mission(mission.contents))
            return abi.AB_OK

        return self._guarded(number, call)

    def _plan(self, number: int, observation: Any, command: Any) -> int:
        def call(instance: _Instance) -> int:
            given = instance.planner.plan(_observation(observation.contents, "imu" in self._class.sees))
            if given is None:
                return abi.AB_NO_PLAN
            if not isinstance(given, p.Command):
                raise TypeError(f"plan() gave {type(given).__name__}, which is no command")
            instance.points = fill_command(command.contents, given)
            return abi.AB_OK

        return self._guarded(number, call)
