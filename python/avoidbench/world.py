"""Maps as arrays: meshes, depth images, distances and occupied cells, without a flight."""

import operator
import os
import warnings
from collections.abc import Mapping
from typing import Any, NamedTuple, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from avoidbench._extension import core as _core
from avoidbench._input import plain_places
from avoidbench._text import overrides, plain_text, yaml_text

_MOST_SEED = 2**64 - 1


class Nearest(NamedTuple):
    """The surface points nearest to N points."""

    distances_m: NDArray[np.float64]
    """(N,); +inf where nothing is within the limit."""
    points_world: NDArray[np.float64]
    """(N, 3), metres; NaN where nothing is within the limit."""


class Occupancy(NamedTuple):
    """Cubic cells over a map's bounds."""

    is_occupied: NDArray[np.bool_]
    """(X, Y, Z): whether a surface touches the cell. The inside of obstacles is not occupied."""
    origin_world: NDArray[np.float64]
    """(3,), metres: the low corner of cell (0, 0, 0). The centre of cell c is at origin_world + (c + 0.5) *
    resolution_m."""
    resolution_m: float
    """Side of a cell."""


class Missions(NamedTuple):
    """Starts and goals of N flights."""

    starts_world: NDArray[np.float64]
    """(N, 3), metres."""
    goals_world: NDArray[np.float64]
    """(N, 3), metres."""
    start_yaws_rad: NDArray[np.float64]
    """(N,): heading about world z at the start, 0 along x."""


class Obstacle(NamedTuple):
    """One thing that a vehicle may hit."""

    kind: str
    """"tree", "bush", "cylinder", "wall", "ground", …"""
    position_world: tuple[float, float, float]
    """Of its foot, metres."""
    width_m: float
    """At flight height; 0 for ground and walls."""


def _numbers(given: ArrayLike, name: str, wanted: str) -> NDArray[np.float64]:
    try:
        array = np.asarray(given)
    except ValueError as error:
        raise ValueError(f"{name}: expected {wanted}: {error}") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: expected {wanted} of real numbers, got {array.dtype}")
    return np.asarray(array, dtype=np.float64, order="C")


def _points(given: ArrayLike, name: str) -> NDArray[np.float64]:
    """(N, 3); of one point (1, 3)."""
    wanted = "an array of shape (N, 3) or (3,)"
    array = _numbers(given, name, wanted)
    if array.shape == (3,):
        array = array[np.newaxis]
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: expected {wanted}, got {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: not all are finite")
    return array


def _poses(given: ArrayLike) -> NDArray[np.float64]:
    """(N, 4, 4); of one pose (1, 4, 4)."""
    wanted = "an array of shape (N, 4, 4) or (4, 4)"
    array = _numbers(given, "T_world_camera", wanted)
    if array.shape == (4, 4):
        array = array[np.newaxis]
    if array.ndim != 3 or array.shape[1:] != (4, 4):
        raise ValueError(f"T_world_camera: expected {wanted}, got {array.shape}")
    return array


def _rotations(quaternions_wxyz: ArrayLike) -> NDArray[np.float64]:
    """(N, 3, 3) of (N, 4) or (4,) unit quaternions."""
    wanted = "an array of shape (N, 4) or (4,), unit quaternions (w, x, y, z)"
    q = _numbers(quaternions_wxyz, "quaternions_wxyz", wanted)
    if q.shape == (4,):
        q = q[np.newaxis]
    if q.ndim != 2 or q.shape[1] != 4:
        raise ValueError(f"quaternions_wxyz: expected {wanted}, got {q.shape}")
    norms = np.sqrt((q * q).sum(axis=1))
    wrong = np.flatnonzero(~(np.abs(norms - 1.0) <= 1e-5))
    if wrong.size:
        raise ValueError(f"quaternions_wxyz[{wrong[0]}] is not a unit quaternion: its norm is {norms[wrong[0]]:g}")
    w, x, y, z = (q / norms[:, np.newaxis]).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _joined(positions: NDArray[np.float64], rotations: NDArray[np.float64], names: str) -> NDArray[np.float64]:
    """(N, 4, 4); a single position or rotation applies to all."""
    counts = {len(positions), len(rotations)} - {1}
    if len(counts) > 1:
        raise ValueError(f"{names}: expected equal lengths, got {len(positions)} and {len(rotations)}")
    poses = np.zeros((counts.pop() if counts else 1, 4, 4))
    poses[:, :3, :3] = rotations
    poses[:, :3, 3] = positions
    poses[:, 3, 3] = 1.0
    return poses


def look_at(positions_world: ArrayLike, targets_world: ArrayLike) -> NDArray[np.float64]:
    """Poses T_world_camera (N, 4, 4) of upright cameras that look from positions to targets.

    positions_world, targets_world: (N, 3) or (3,), metres; a single one applies to all. Camera frame: RDF. A camera
    that looks straight up or down has world x to the right.

    Raises TypeError if something is not numeric, ValueError for wrong shapes, numbers that are not finite, and a
    target at its camera."""
    positions, targets = _points(positions_world, "positions_world"), _points(targets_world, "targets_world")
    if len(positions) != len(targets) and 1 not in (len(positions), len(targets)):
        raise ValueError(
            f"positions_world and targets_world: expected equal lengths, got {len(positions)} and {len(targets)}"
        )
    forward = targets - positions
    lengths = np.sqrt((forward * forward).sum(axis=1))
    if not (lengths > 0.0).all():
        raise ValueError(f"targets_world[{np.flatnonzero(~(lengths > 0.0))[0]}] is where its camera is")
    forward = forward / lengths[:, np.newaxis]
    right = np.stack([forward[:, 1], -forward[:, 0], np.zeros(len(forward))], axis=1)  # forward × up
    across = np.sqrt((right * right).sum(axis=1))
    right = np.where(across[:, np.newaxis] > 1e-9, right / np.maximum(across, 1e-9)[:, np.newaxis], [1.0, 0.0, 0.0])
    down = np.cross(forward, right)
    down = down / np.sqrt((down * down).sum(axis=1))[:, np.newaxis]
    right = np.cross(down, forward)
    return _joined(positions, np.stack([right, down, forward], axis=2), "positions_world and targets_world")


def _seed(given: SupportsIndex, name: str) -> int:
    seed = operator.index(given)
    if not 0 <= seed <= _MOST_SEED:
        raise ValueError(f"{name}: expected a whole number in [0, 2**64), got {seed}")
    return seed


class World:
    """A map. make_world() makes one.

    World frame: ENU, z up, metres. The same map and the same results from the same arguments on every machine.
    Moving obstacles are where they are when a flight begins. Several threads may call it at the same time; long calls
    run without Python's lock."""

    def __init__(self, core: _core.World) -> None:
        self._core = core
        self._sensors: dict[str, _core.Sensor] = {}

    def __repr__(self) -> str:
        size = self.bounds_m[1] - self.bounds_m[0]
        return (
            f"<avoidbench.World {self.generator}, seed {self.seed}, {self.obstacle_count} obstacles, "
            f"{size[0]:.1f} × {size[1]:.1f} × {size[2]:.1f} m>"
        )

    @property
    def generator(self) -> str:
        """The kind of map, as `avoidbench maps list` has it."""
        return self._core.generator

    @property
    def seed(self) -> int:
        """The map's seed."""
        return self._core.seed

    @property
    def digest(self) -> str:
        """SHA-256 of the map, as `avoidbench maps info` shows it."""
        return self._core.digest

    @property
    def bounds_m(self) -> NDArray[np.float64]:
        """(2, 3): low and high corner of the map. A vehicle that leaves it has failed."""
        return np.array(self._core.bounds_m)

    @property
    def flight_bounds_m(self) -> NDArray[np.float64]:
        """(2, 3): low and high corner of where missions start and end; within bounds_m."""
        return np.array(self._core.flight_bounds_m)

    @property
    def obstacle_count(self) -> int:
        """Obstacles except ground, walls, ceiling and lamps."""
        return self._core.obstacle_count

    @property
    def obstacles(self) -> list[Obstacle]:
        """Everything that a vehicle may hit, including ground and walls."""
        return [Obstacle(kind, (row[0], row[1], row[2]), row[3]) for kind, row in self._core.obstacles()]

    def mesh(self) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """The map as one mesh: vertices (V, 3), world, metres, and triangles (F, 3), three vertices each,
        counter-clockwise seen from outside."""
        vertices = np.empty((self._core.vertex_count, 3))
        triangles = np.empty((self._core.triangle_count, 3), dtype=np.int32)
        self._core.write_mesh(vertices, triangles)
        return vertices, triangles

    def nearest(self, points_world: ArrayLike, limit_m: float = np.inf) -> Nearest:
        """For each of the points (N, 3) or (3,), world, metres: the distance to the nearest surface within limit_m, and
        the point there.

        Raises TypeError if something is not numeric, ValueError for wrong shapes, for points that are not finite or
        beyond 1e6 m, and for a limit that is not above 0."""
        points = _points(points_world, "points_world")
        distances, nearest = np.empty(len(points)), np.empty((len(points), 3))
        self._core.write_nearest(points, limit_m, distances, nearest)
        return Nearest(distances, nearest)

    def occupancy(self, resolution_m: float) -> Occupancy:
        """The cubic cells, sides of resolution_m, of the map's bounds that a surface touches.

        Raises ValueError for a resolution outside of (0, 1000], InputError for more than 500 million cells."""
        is_occupied, origin = self._core.occupancy(resolution_m)
        return Occupancy(is_occupied, np.array(origin), float(resolution_m))

    def missions(self, count: SupportsIndex) -> Missions:
        """The first `count` missions of the map, the ones that a sweep on it flies.

        Raises ValueError for a count that is negative or more than the sweep lists, InputError where no place is
        free."""
        rows = np.array(self._core.missions(operator.index(count))).reshape(-1, 7)
        return Missions(rows[:, 0:3].copy(), rows[:, 3:6].copy(), rows[:, 6].copy())

    def depth(
        self,
        T_world_camera: ArrayLike | None = None,
        *,
        positions_world: ArrayLike | None = None,
        quaternions_wxyz: ArrayLike | None = None,
        sensor: str | Mapping[str, Any] = "depth_ideal",
        seed: SupportsIndex = 1,
        out: NDArray[np.float32] | None = None,
        **fields: Any,
    ) -> NDArray[np.float32]:
        """What a depth camera sees from N places: depth along the camera's z, metres, float32 (N, height_px, width_px);
        from one place (height_px, width_px). +inf where nothing is within max_range_m; NaN where it is nearer than
        min_range_m or the sensor fails.

        T_world_camera: (N, 4, 4) or (4, 4), the camera's pose; camera frame RDF (x right, y down, z forward). look_at()
        makes such poses. Or instead positions_world (N, 3) or (3,), metres, and quaternions_wxyz (N, 4) or (4,), unit,
        which take camera coordinates to the world's; a single one applies to all.

        sensor: a name of `avoidbench sensors list`, or a mapping as a sweep file has it; of several cameras the first.
        The default, depth_ideal, has the true depth. fields: the sensor's fields that differ, such as width_px=64,
        height_px=48, fov_x_deg=90, min_range_m=0, max_range_m=1000; `avoidbench config explain sensor` lists them.

        seed: of the sensor's noise; image i has its own. out: a C-contiguous float32 array (N, height_px, width_px) to
        write to.

        Raises InputError for an invalid sensor, TypeError if something is not numeric, ValueError for wrong shapes,
        quaternions of another norm than 1, poses that are not a rotation and a translation, and places that are not
        finite or beyond 1e6 m."""
        is_single, poses = self._camera_poses(T_world_camera, positions_world, quaternions_wxyz)
        camera = self._sensor(sensor, fields)
        shape = (len(poses), camera.height_px, camera.width_px)
        if out is None:
            images = np.empty(shape, dtype=np.float32)
        elif not isinstance(out, np.ndarray) or out.dtype != np.float32:
            raise TypeError("out: expected an array of float32")
        elif out.shape != shape or not out.flags.c_contiguous or not out.flags.writeable:
            raise ValueError(f"out: expected a writeable, C-contiguous array of shape {shape}, got {out.shape}")
        else:
            images = out
        self._core.write_depth(camera, poses, _seed(seed, "seed"), images)
        return images[0] if is_single and out is None else images

    @staticmethod
    def _camera_poses(
        poses: ArrayLike | None, positions: ArrayLike | None, quaternions: ArrayLike | None
    ) -> tuple[bool, NDArray[np.float64]]:
        """Whether it is a single pose, not a list of them; (N, 4, 4)."""
        if poses is not None and positions is None and quaternions is None:
            checked = _poses(poses)
            return np.ndim(poses) == 2, checked
        if poses is None and positions is not None and quaternions is not None:
            names = "positions_world and quaternions_wxyz"
            joined = _joined(_points(positions, "positions_world"), _rotations(quaternions), names)
            return np.ndim(positions) == 1 and np.ndim(quaternions) == 1, joined
        raise TypeError("expected either T_world_camera, or both positions_world and quaternions_wxyz")

    def _sensor(self, sensor: str | Mapping[str, Any], fields: Mapping[str, Any]) -> _core.Sensor:
        options = [f"sensor={yaml_text(sensor, 'sensor')}", *overrides(fields, "sensor.")]
        key = "\n".join(options)
        if key not in self._sensors:
            self._sensors[key] = _core.read_sensor(options)
        return self._sensors[key]


def make_world(
    source: str | os.PathLike[str] | Mapping[str, Any], *, seed: SupportsIndex | None = None, **fields: Any
) -> World:
    """A map.

    source: the name of a generator ("forest"; `avoidbench maps list` has all), a sweep file, a file with a map's fields
    alone, a built-in sweep's name, or a mapping with the contents of such a file: {"generator": "hall", "crates_ratio":
    0.5} or {"maps": {…}, "mission": {…}}. Of a sweep with several maps, the first is used. seed: the map's; by default
    that of the file, else 1. fields: changes to the source, such as poisson_radius_m=3.5 or area_m=[20, 30]; also other
    settings of a sweep, such as mission={"free_radius_m": 1.0}, or **{"mission.free_radius_m": 1.0}.

    Raises InputError with all errors and their places; TypeError for values that a sweep file can't have."""
    options = overrides(fields)
    map_seed = None if seed is None else _seed(seed, "seed")
    if isinstance(source, Mapping):
        with plain_places("source"):
            core = _core.read_world_text(yaml_text(source, "source"), "source", options, map_seed)
    elif isinstance(source, (str, os.PathLike)):
        given = plain_text(os.fspath(source), "source")
        if given == "-":
            raise ValueError("source: expected a file or a name, got '-'")
        core = _core.read_world(given, options, map_seed)
    else:
        raise TypeError(f"source: expected a name, a file or a mapping, got {type(source).__name__}")
    for warning in core.warnings:
        warnings.warn(warning, stacklevel=2)
    return World(core)
