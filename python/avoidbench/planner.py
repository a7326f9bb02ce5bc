"""Planners written in Python: the same interface as for planner libraries, in Python's terms.

Units are SI, angles radians. World frame: ENU, z up. Body frame: FLU, x forward. Camera frame: RDF, z forward. A
quaternion q_a_b is (w, x, y, z) and takes coordinates in b to coordinates in a. Use randomness only
from Mission.seed and time only from the observation: after reset(), equal inputs must give equal outputs. Elementary
functions with the same bits on every machine are in avoidbench.portable_math."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Parameter:
    """One parameter of a planner, declared so that a typo in a sweep is found before the first trial.

    preset: a number in [lowest, highest] (whole if it is an int), or a text (one of `choices`, if there are any)."""

    name: str
    """With its unit, as in sweep files: "cruise_speed_mps"."""
    preset: float | int | str
    doc: str
    unit: str = ""
    lowest: float = -1e6
    highest: float = 1e6
    choices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Camera:
    """A pinhole camera without distortion; for a stereo camera, the left eye."""

    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    position_body_m: Vector
    q_body_camera: Vector
    rate_hz: float
    min_range_m: float
    max_range_m: float
    baseline_m: float


@dataclass(frozen=True)
class Lidar:
    """A lidar: beams that sweep about its z axis. Its frame is FLU."""

    is_deskewed: bool
    """Whether points are as seen from where the lidar is at the sweep's end; else each as from where it was then."""
    position_body_m: Vector
    q_body_lidar: Vector
    rate_hz: float
    """Of sweeps."""
    min_range_m: float
    max_range_m: float
    lowest_elevation_rad: float
    highest_elevation_rad: float
    shots: int
    """Per sweep, including those without a return."""


@dataclass(frozen=True)
class Setup:
    """What a planner is made for."""

    parameters: Mapping[str, Any]
    """The value of each parameter that it declares."""
    max_speed_mps: float
    max_acceleration_mps2: float
    max_yaw_rate_radps: float
    body_size_m: Vector
    """(3,): box, body FLU, centred."""
    body_radius_m: float
    plan_period_s: float
    gravity_mps2: float
    cameras: tuple[Camera, ...]
    lidars: tuple[Lidar, ...] = ()
    """Only for planners that declare points."""


@dataclass(frozen=True)
class Mission:
    """One flight's task."""

    seed: int
    start_world_m: Vector
    start_yaw_rad: float
    goal_world_m: Vector
    goal_radius_m: float
    """The goal is reached within this horizontal distance."""
    time_limit_s: float
    lowest_world_m: Vector
    highest_world_m: Vector
    """The map's box, from ground to ceiling: the trial ends where the vehicle's centre leaves it."""
    command_latency_s: float
    """From a call to when its command acts; NaN if it is measured: as long as the call takes."""
    goals_world_m: Vector
    """(N, 3): all goals, to be reached in this order, the first one goal_world_m; the trial ends at the last."""


@dataclass(frozen=True)
class DepthImage:
    """Depth along camera z; +inf: no return, NaN: invalid. The program owns the pixels: read them in the call, and copy
    what you keep."""

    time_s: float
    depth_m: NDArray[np.float32]
    """(H, W)."""
    position_world_m: Vector
    q_world_camera: Vector
    camera: int
    """Index into Setup.cameras."""


@dataclass(frozen=True)
class Picture:
    """An 8-bit picture, sRGB encoded. The program owns the pixels: read them in the call, and copy what you keep."""

    time_s: float
    pixels: NDArray[np.uint8]
    """(H, W) grey or (H, W, 3) red, green, blue."""
    position_world_m: Vector
    q_world_camera: Vector
    camera: int


@dataclass(frozen=True)
class StereoPair:
    """Two grey pictures of one moment, rectified."""

    left: Picture
    right: Picture
    baseline_m: float


@dataclass(frozen=True)
class Cloud:
    """A sweep of a lidar. The program owns the arrays: read them in the call, and copy what you keep."""

    time_s: float
    """Of the sweep's end."""
    points_lidar_m: NDArray[np.float32]
    """(N, 3), in the order of the shots."""
    point_times_s: NDArray[np.float32]
    """(N,), after the sweep's end: at most 0."""
    intensities: NDArray[np.float32]
    """(N,), reflectance times the cosine of incidence, 0 to 1."""
    misses_lidar: NDArray[np.float32]
    """(M, 3): unit directions of shots without a return."""
    position_world_m: Vector
    """Of the lidar, at that time."""
    q_world_lidar: Vector
    lidar: int
    """Index into Setup.lidars."""


@dataclass(frozen=True)
class ImuSamples:
    """Since the last call, oldest first."""

    time_s: NDArray[np.float64]
    """(K,)."""
    rates_body_radps: NDArray[np.float64]
    """(K, 3)."""
    specific_force_body_mps2: NDArray[np.float64]
    """(K, 3): acceleration less gravity, (0, 0, 9.81) at rest."""


@dataclass(frozen=True)
class State:
    """As the odometry estimates it."""

    time_s: float
    """Since the start of the trial; in the past if the odometry has a delay."""
    position_world_m: Vector
    velocity_world_mps: Vector
    q_world_body: Vector
    rates_body_radps: Vector


@dataclass(frozen=True)
class Reference:
    """Where the vehicle is commanded to be at this call: the start of a smooth trajectory."""

    time_s: float
    position_world_m: Vector
    velocity_world_mps: Vector
    acceleration_world_mps2: Vector
    jerk_world_mps3: Vector
    yaw_rad: float
    yaw_rate_radps: float


@dataclass(frozen=True)
class Track:
    """Something that moves, at the time of a scan."""

    id: int
    """An object keeps its id in all observations of a trial."""
    kind: str
    """person, box, ball, pole or other"""
    time_s: float
    center_world_m: Vector
    velocity_world_mps: Vector
    size_m: Vector
    """Of its box in its own frame, z up."""

    def center_at(self, time_s: float) -> Vector:
        """(3,), world, metres: its middle at this time of the trial, if it keeps the scan's velocity."""
        return self.center_world_m + (time_s - self.time_s) * self.velocity_world_mps

    @property
    def radius_m(self) -> float:
        """Radius of the upright cylinder around its box for any heading, since a track has none: half of the longer
        side for round objects (person, ball, pole), half of the diagonal for others."""
        half = 0.5 * self.size_m[:2]
        return float(half.max() if self.kind in ("person", "ball", "pole") else np.hypot(*half))

    def distance_m(self, places_world_m: ArrayLike, time_s: float) -> NDArray[np.float64]:
        """(…,), metres: how far places (…, 3) in the world are from its surface at this time of the trial; negative
        inside. The surface is a ball's, or else that of an upright cylinder of radius_m, so the distance to the
        object itself is never less, as long as it keeps its velocity."""
        away = np.asarray(places_world_m, dtype=np.float64) - self.center_at(time_s)
        if self.kind == "ball":
            return np.asarray(np.linalg.norm(away, axis=-1) - self.radius_m)
        beside = np.linalg.norm(away[..., :2], axis=-1) - self.radius_m
        above = np.abs(away[..., 2]) - 0.5 * self.size_m[2]
        outside = np.hypot(np.maximum(beside, 0.0), np.maximum(above, 0.0))
        return np.asarray(outside + np.minimum(np.maximum(beside, above), 0.0))


@dataclass(frozen=True)
class Observation(State):
    """What a planner sees in one call: the newest state, and since the last call, of what it declares in `inputs`,
    images and sweeps, newest first, samples of the IMU, states at the IMU's rate, oldest first, and the reference."""

    depth: tuple[DepthImage, ...] = ()
    stereo: tuple[StereoPair, ...] = ()
    color: tuple[Picture, ...] = ()
    imu: ImuSamples | None = None
    call_time_s: float = float("nan")
    """Of this call; time_s is older if the odometry has a delay."""
    states: tuple[State, ...] = ()
    reference: Reference | None = None
    """Where the vehicle is commanded to be, for planners that declare it; None while rates are commanded."""
    clouds: tuple[Cloud, ...] = ()
    """Sweeps of lidars, newest first."""
    goal_index: int = 0
    """Of the goal to reach now, in Mission.goals_world_m."""
    goal_world_m: Vector | None = None
    """Where it is at this call, for planners that declare "goals"."""
    tracks: tuple[Track, ...] = ()
    """Moving objects around the vehicle in the newest scan, for planners that declare it."""
    wanted: "Command | None" = None
    """For a filter, which declares "command": the command of the planner below; None if it has no plan. To let it pass,
    a filter returns it."""

    def newest_depth(self, camera: int) -> DepthImage | None:
        """The newest depth image of this camera (index into Setup.cameras) since the last call, or None if there
        is no new one."""
        return next((image for image in self.depth if image.camera == camera), None)

    def newest_stereo(self, camera: int) -> StereoPair | None:
        """As newest_depth(), for stereo pairs."""
        return next((pair for pair in self.stereo if pair.left.camera == camera), None)

    def newest_color(self, camera: int) -> Picture | None:
        """As newest_depth(), for colour pictures."""
        return next((picture for picture in self.color if picture.camera == camera), None)

    def newest_cloud(self, lidar: int) -> Cloud | None:
        """As newest_depth(), for the sweeps of this lidar (index into Setup.lidars)."""
        return next((cloud for cloud in self.clouds if cloud.lidar == lidar), None)


@dataclass(frozen=True, kw_only=True)
class _Held:
    horizon_s: float = 0.0
    """How long the planner considers the command safe; then the vehicle brakes; 0: forever."""


@dataclass(frozen=True, kw_only=True)
class _Turned(_Held):
    yaw_rad: float | None = None
    yaw_rate_radps: float | None = None
    """One of the two; neither: yaw rate 0."""


@dataclass(frozen=True)
class Position(_Turned):
    position_world_m: ArrayLike


@dataclass(frozen=True)
class Velocity(_Turned):
    velocity_world_mps: ArrayLike


@dataclass(frozen=True)
class Acceleration(_Turned):
    acceleration_world_mps2: ArrayLike


@dataclass(frozen=True)
class Rates(_Held):
    rates_body_radps: ArrayLike
    thrust_mps2: float
    """Collective, over mass: 9.81 hovers."""


@dataclass(frozen=True)
class Trajectory(_Held):
    """N points, at least 2; quintics join them."""

    time_s: ArrayLike
    """(N,), after the moment at which the command takes effect; rising from 0."""
    position_world_m: ArrayLike
    """(N, 3)."""
    velocity_world_mps: ArrayLike
    acceleration_world_mps2: ArrayLike
    yaw_rad: ArrayLike = field(default=0.0)
    """(N,), or one number for all."""
    yaw_rate_radps: ArrayLike = field(default=0.0)


Command = Position | Velocity | Acceleration | Rates | Trajectory


class GiveUp(Exception):
    """Raise it in plan() if the goal can't be reached. The trial ends with planner_gave_up and this text."""


class Planner:
    """A planner: subclass it, declare its inputs and commands, and write plan(). Any exception except GiveUp ends the
    trial with planner_error and its text. A sweep flies it as `plugin: ./its_file.py`, in its own process
    (avoidbench.serving); avoidbench.fly() does that from Python."""

    name: ClassVar[str]
    """[a-z0-9_]+"""
    version: ClassVar[str] = "0"
    summary: ClassVar[str] = ""
    """One line."""
    inputs: ClassVar[Sequence[str]] = ("state",)
    """From state, depth, stereo, color, imu, states, reference, points, tracks, goals (the goal to reach now; without
    it, missions of several goals are refused). one_camera: only one camera of a rig, which a sweep names (`camera: 0`).
    command: it is a filter, which a sweep names together with a planner (`filter: ./its_file.py`)."""
    commands: ClassVar[Sequence[str]] = ("velocity",)
    """From position, velocity, acceleration, trajectory, rates: what plan() may return, and what a filter accepts."""
    uses: ClassVar[Sequence[str]] = ()
    """From processes, devices, network, globals: what it does apart from computing and reading files (AB_USES_… of
    planner.h)."""
    parameters: ClassVar[Sequence[Parameter]] = ()
    least_fov_rad: ClassVar[tuple[float, float]] = (0.0, 0.0)
    """View across and down that each of its cameras must have; a sweep with a narrower one is refused before its first
    trial."""
    files: ClassVar[Sequence[str]] = ()
    """Further files that decide what it does, such as weights, relative to the folder of its own file: other contents
    make other trials. Modules that its file imports from that folder count automatically."""

    def __init__(self, setup: Setup) -> None:
        self.setup = setup

    def reset(self, mission: Mission) -> None:
        """Begins a trial: forget all earlier ones."""

    def plan(self, observation: Observation) -> Command | None:
        """One command for what is seen now; None: no plan; the vehicle brakes and hovers until the next call."""
        raise NotImplementedError
