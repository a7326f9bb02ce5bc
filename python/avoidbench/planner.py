"""Planners written in Python: the same interface as that of planner libraries, in Python's terms.

Units are SI, angles radians. World frame: ENU, z up. Body frame: FLU, x forward. Camera frame: RDF, z forward. A
quaternion q_a_b is (w, x, y, z) and takes coordinates in b to coordinates in a. Randomness only from Mission.seed, time
only from the observation: after reset() equal inputs give equal outputs. Elementary functions with the same bits on
every machine are in avoidbench.portable_math."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Parameter:
    """One parameter of a planner, declared so that a typo in a sweep is found before the first trial.

    preset: a number in [lowest, highest] (whole if it is an int), or a text: one of `choices`, where there are any."""

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
    """A pinhole camera without distortion; of a stereo camera the left eye."""

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
    """Of a sweep, those that come back with nothing included."""


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
    """Of who declares points."""


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
    """From a call to when its command acts; NaN where that is measured: as long as the call takes."""
    goals_world_m: Vector
    """(N, 3): all goals, to be reached in this order, the first one goal_world_m; the trial ends at the last."""


@dataclass(frozen=True)
class DepthImage:
    """Depth along camera z; +inf: no return, NaN: invalid. The pixels are the program's: read them in the call, copy
    what is kept."""

    time_s: float
    depth_m: NDArray[np.float32]
    """(H, W)."""
    position_world_m: Vector
    q_world_camera: Vector
    camera: int
    """Index into Setup.cameras."""


@dataclass(frozen=True)
class Picture:
    """An 8-bit picture, sRGB encoded. The pixels are the program's: read them in the call, copy what is kept."""

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
    """A sweep of a lidar. The arrays are the program's: read them in the call, copy what is kept."""

    time_s: float
    """Of the sweep's end."""
    points_lidar_m: NDArray[np.float32]
    """(N, 3), in the order of the shots."""
    point_times_s: NDArray[np.float32]
    """(N,), after the sweep's end: at most 0."""
    intensities: NDArray[np.float32]
    """(N,), reflectance times the cosine of incidence, 0 to 1."""
    misses_lidar: NDArray[np.float32]
    """(M, 3): unit directions of shots that came back with nothing."""
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
    """As the odometry says it."""

    time_s: float
    """Since the start of the trial; of the past where the odometry has a delay."""
    position_world_m: Vector
    velocity_world_mps: Vector
    q_world_body: Vector
    rates_body_radps: Vector


@dataclass(frozen=True)
class Reference:
    """Where the vehicle is told to be at this call: where a smooth trajectory begins."""

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
    """The same thing has the same in all observations of a trial."""
    kind: str
    """person, box, ball, pole or other"""
    time_s: float
    center_world_m: Vector
    velocity_world_mps: Vector
    size_m: Vector
    """Of its box in its own frame, z up."""

    def center_at(self, time_s: float) -> Vector:
        """(3,), world, metres: its middle at this time of the trial, as if it had gone on with the scan's velocity."""
        return self.center_world_m + (time_s - self.time_s) * self.velocity_world_mps

    @property
    def radius_m(self) -> float:
        """Of the upright cylinder around its box, whatever its heading, which a track does not tell: half of the longer
        side of what is round (person, ball, pole), half of the diagonal of the rest."""
        half = 0.5 * self.size_m[:2]
        return float(half.max() if self.kind in ("person", "ball", "pole") else np.hypot(*half))

    def distance_m(self, places_world_m: ArrayLike, time_s: float) -> NDArray[np.float64]:
        """(…,), metres: how far places (…, 3) in the world are from its surface at this time of the trial; negative
        inside. The surface is a ball's, or else that of an upright cylinder of radius_m, so that the distance to the
        thing itself is never less, as long as it keeps its velocity."""
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
    """Of this call; time_s is older where the odometry has a delay."""
    states: tuple[State, ...] = ()
    reference: Reference | None = None
    """Where the commands so far tell the vehicle to be, of who declares it; None while rates are commanded."""
    clouds: tuple[Cloud, ...] = ()
    """Sweeps of lidars, newest first."""
    goal_index: int = 0
    """Of the goal to reach now, in Mission.goals_world_m."""
    goal_world_m: Vector | None = None
    """Where it is at this call, of who declares "goals"."""
    tracks: tuple[Track, ...] = ()
    """What moves around the vehicle, by the newest scan, of who declares it."""
    wanted: "Command | None" = None
    """The command of the planner below, of a filter, which declares "command"; None where it has no plan. A filter
    returns it to let it pass."""

    def newest_depth(self, camera: int) -> DepthImage | None:
        """The newest depth image of this camera (index into Setup.cameras) since the last call, or None: none is
        new."""
        return next((image for image in self.depth if image.camera == camera), None)

    def newest_stereo(self, camera: int) -> StereoPair | None:
        """As newest_depth(), of stereo pairs."""
        return next((pair for pair in self.stereo if pair.left.camera == camera), None)

    def newest_color(self, camera: int) -> Picture | None:
        """As newest_depth(), of colour pictures."""
        return next((picture for picture in self.color if picture.camera == camera), None)

    def newest_cloud(self, lidar: int) -> Cloud | None:
        """As newest_depth(), of the sweeps of this lidar (index into Setup.lidars)."""
        return next((cloud for cloud in self.clouds if cloud.lidar == lidar), None)


@dataclass(frozen=True, kw_only=True)
class _Held:
    horizon_s: float = 0.0
    """How long the command is believed to be safe; after it the vehicle brakes; 0: for ever."""


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
    """Raised in plan(): the goal can't be reached. The trial ends with planner_gave_up and this text."""


class Planner:
    """A planner: subclass it, say what it sees and gives, and write plan(). Any other exception than GiveUp ends the
    trial with planner_error and its text. A sweep flies it as `plugin: ./its_file.py`, in a process of its own
    (avoidbench.serving); avoidbench.fly() does that from Python."""

    name: ClassVar[str]
    """[a-z0-9_]+"""
    version: ClassVar[str] = "0"
    summary: ClassVar[str] = ""
    """One line."""
    inputs: ClassVar[Sequence[str]] = ("state",)
    """Of state, depth, stereo, color, imu, states, reference, points, tracks, goals (the goal to reach now: without it
    missions of several goals are refused); with one_camera of a rig one camera alone, which a sweep names
    (`camera: 0`); with command it is a filter, which a sweep names beside a planner (`filter: ./its_file.py`)."""
    commands: ClassVar[Sequence[str]] = ("velocity",)
    """Of position, velocity, acceleration, trajectory, rates: what plan() may return, and a filter takes."""
    uses: ClassVar[Sequence[str]] = ()
    """Of processes, devices, network, globals: what it does beside computing and reading files (AB_USES_… of
    planner.h)."""
    parameters: ClassVar[Sequence[Parameter]] = ()
    least_fov_rad: ClassVar[tuple[float, float]] = (0.0, 0.0)
    """View across and down that each of its cameras must have; a sweep with a narrower one is refused before its first
    trial."""
    files: ClassVar[Sequence[str]] = ()
    """Further files that decide what it does, as weights, relative to the folder of its own: trials of other contents
    are other trials. The modules that its file imports from that folder count by themselves."""

    def __init__(self, setup: Setup) -> None:
        self.setup = setup

    def reset(self, mission: Mission) -> None:
        """Begins a trial: forget all earlier ones."""

    def plan(self, observation: Observation) -> Command | None:
        """One command for what is seen now; None: no plan, the vehicle brakes and hovers, and is asked again."""
        raise NotImplementedError
