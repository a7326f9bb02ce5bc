"""Wrong arguments are refused with a text that says what is wrong; none ends the process."""

from pathlib import Path
from typing import Any

import avoidbench
import numpy as np
import pytest
from avoidbench import _core


@pytest.fixture(scope="module")
def world() -> avoidbench.World:
    return avoidbench.make_world("hall", seed=1)


def pose() -> np.ndarray:
    return avoidbench.look_at([10.0, 5.0, 2.0], [10.0, 15.0, 2.0])[0]


def changed(row: int, column: int, value: float) -> np.ndarray:
    matrix = pose()
    matrix[row, column] = value
    return matrix


@pytest.mark.parametrize(
    ("source", "fields", "error", "text"),
    [
        ("forrest", {}, avoidbench.InputError, "did you mean forest"),
        ("forest", {"poisson_radius_m": 0.1}, avoidbench.InputError, r"poisson_radius_m: 0.1 is outside \[1, 20\]"),
        ("forest", {"poison_radius_m": 3}, avoidbench.InputError, "did you mean poisson_radius_m"),
        ("hall", {"flight_height_m": 9, "height_m": 4}, avoidbench.InputError, "flight_height_m"),
        ("mesh", {}, avoidbench.InputError, "maps.file"),
        ("mesh", {"file": "none.obj"}, avoidbench.InputError, "no file .*none.obj"),
        ("no/such/file.yaml", {}, avoidbench.InputError, "neither a file"),
        ("", {}, avoidbench.InputError, "neither a file"),
        ("-", {}, ValueError, "got '-'"),
        ("a\0b", {}, ValueError, "byte 0"),
        ("\udcff", {}, ValueError, "UTF-8"),
        (b"forest", {}, TypeError, "got bytes"),
        (None, {}, TypeError, "got NoneType"),
        ({"generator": "hall", 3: 4}, {}, TypeError, "expected text as a key"),
        ({"generator": "hall", "crates_ratio": "much"}, {}, avoidbench.InputError, r"^source: .*crates_ratio"),
        ({"generator": {}}, {}, avoidbench.InputError, "generator"),
        ({"maps": [1]}, {}, avoidbench.InputError, "maps"),
        ("forest", {"area_m": [20, float("nan")]}, ValueError, r"area_m\[1\]: nan is not finite"),
        ("forest", {"area_m": np.zeros((2, 2))}, avoidbench.InputError, "area_m"),
        ("forest", {"area_m": object()}, TypeError, "area_m: expected a number"),
        ("forest", {"a=b": 1}, ValueError, "not the name of a field"),
        ("forest", {"a[": 1}, avoidbench.InputError, "not a dotted path"),
        ("forest", {"seed": -1}, ValueError, "seed"),
        ("forest", {"seed": 2**64}, ValueError, "seed"),
        ("forest", {"seed": 1.5}, TypeError, "float"),
        ("forest", {"seed": "1"}, TypeError, "str"),
    ],
)
def test_maps_that_can_not_be_are_refused(
    source: Any, fields: dict[str, Any], error: type[Exception], text: str
) -> None:
    with pytest.raises(error, match=text):
        avoidbench.make_world(source, **fields)


def test_all_problems_of_a_file_are_told_with_their_places(tmp_path: Path) -> None:
    file = tmp_path / "wrong.yaml"
    file.write_text("maps:\n  generator: forest\n  bush_ratio: 3\n  heigth_m: 5\n")
    with pytest.raises(avoidbench.InputError) as caught:
        avoidbench.make_world(file)
    lines = str(caught.value).splitlines()
    assert [line.split(": ")[0] for line in lines] == [f"{file}:3:15", f"{file}:4:3"]
    assert isinstance(caught.value, ValueError)
    assert type(caught.value).__module__ == "avoidbench"


def test_a_file_that_is_no_yaml_is_told_with_its_place(tmp_path: Path) -> None:
    file = tmp_path / "wrong.yaml"
    file.write_text("maps: {generator: forest\n")
    with pytest.raises(avoidbench.InputError, match=r"wrong.yaml:\d+:\d+: "):
        avoidbench.make_world(file)


@pytest.mark.parametrize(
    ("poses", "error", "text"),
    [
        (np.eye(3), ValueError, r"an array of shape \(N, 4, 4\) or \(4, 4\), got \(3, 3\)"),
        (np.zeros((2, 3, 4)), ValueError, r"got \(2, 3, 4\)"),
        (np.zeros((4, 4)), ValueError, "the last row"),
        (2 * np.eye(4), ValueError, "the last row"),
        (changed(0, 0, 1.1), ValueError, "no rotation"),
        (np.diag([1.0, 1.0, -1.0, 1.0]), ValueError, "no rotation"),
        (changed(0, 3, np.nan), ValueError, "not finite"),
        (changed(0, 0, np.inf), ValueError, "not finite"),
        (changed(0, 3, 1e7), ValueError, "beyond 1e6 m"),
        (np.stack([pose(), np.zeros((4, 4))]), ValueError, r"T_world_camera\[1\]"),
        (pose().astype(complex), TypeError, "complex128"),
        (pose().astype(object), TypeError, "object"),
        (np.eye(4, dtype=bool), TypeError, "bool"),
        ("front", TypeError, "real numbers"),
        ([[1, 2], [3]], ValueError, "T_world_camera"),
        (5.0, ValueError, r"got \(\)"),
        (None, TypeError, "either T_world_camera"),
    ],
)
def test_poses_that_are_none_are_refused(
    world: avoidbench.World, poses: Any, error: type[Exception], text: str
) -> None:
    with pytest.raises(error, match=text):
        world.depth(poses, width_px=16, height_px=8)


@pytest.mark.parametrize(
    ("positions", "quaternions", "error", "text"),
    [
        ([0, 0, 1], [1, 0, 0], ValueError, r"\(N, 4\) or \(4,\)"),
        ([0, 0, 1], [2, 0, 0, 0], ValueError, r"quaternions_wxyz\[0\] is not a unit quaternion: its norm is 2"),
        ([0, 0, 1], [np.nan, 0, 0, 0], ValueError, "not a unit quaternion"),
        ([0, 0, 1], [0, 0, 0, 0], ValueError, "not a unit quaternion"),
        ([0, 0, np.inf], [1, 0, 0, 0], ValueError, "not all are finite"),
        ([0, 0], [1, 0, 0, 0], ValueError, r"\(N, 3\) or \(3,\), got \(2,\)"),
        (np.zeros((2, 3)), np.tile([1, 0, 0, 0], (3, 1)), ValueError, "got 2 and 3"),
        ([0, 0, 1], None, TypeError, "both positions_world and quaternions_wxyz"),
    ],
)
def test_places_that_are_none_are_refused(
    world: avoidbench.World, positions: Any, quaternions: Any, error: type[Exception], text: str
) -> None:
    with pytest.raises(error, match=text):
        world.depth(positions_world=positions, quaternions_wxyz=quaternions)


@pytest.mark.parametrize(
    ("fields", "error", "text"),
    [
        ({"sensor": "eye"}, avoidbench.InputError, "is not a sensor; known: "),
        ({"sensor": {"kind": "eye"}}, avoidbench.InputError, "kind"),
        ({"sensor": 3}, avoidbench.InputError, "sensor"),
        ({"sensor": object()}, TypeError, "sensor"),
        ({"width": 64}, avoidbench.InputError, "did you mean width_px"),
        ({"width_px": 0}, avoidbench.InputError, "width_px: 0 is outside"),
        ({"width_px": 64.5}, avoidbench.InputError, "width_px"),
        ({"fov_x_deg": 180}, avoidbench.InputError, "fov_x_deg"),
        ({"min_range_m": 5, "max_range_m": 2}, avoidbench.InputError, "range"),
        ({"sensor": "stereo_sgbm", "block_px": 4}, avoidbench.InputError, "block_px"),
        ({"seed": -1}, ValueError, "seed"),
        ({"out": np.zeros((1, 240, 320))}, TypeError, "float32"),
        ({"out": np.zeros((1, 24, 32), np.float32)}, ValueError, r"\(1, 240, 320\), got \(1, 24, 32\)"),
        ({"out": np.zeros((320, 240, 1), np.float32).T}, ValueError, "C-contiguous"),
        ({"out": 3}, TypeError, "out"),
    ],
)
def test_sensors_that_are_none_are_refused(
    world: avoidbench.World, fields: dict[str, Any], error: type[Exception], text: str
) -> None:
    with pytest.raises(error, match=text):
        world.depth(pose(), **fields)


@pytest.mark.parametrize(
    ("points", "limit", "error", "text"),
    [
        ([1, 2], np.inf, ValueError, r"an array of shape \(N, 3\) or \(3,\), got \(2,\)"),
        (np.zeros((2, 2)), np.inf, ValueError, r"got \(2, 2\)"),
        ([1, 2, np.nan], np.inf, ValueError, "finite"),
        ([1, 2, 1e300], np.inf, ValueError, r"points_world\[0\].*beyond 1e6 m"),
        (["a", "b", "c"], np.inf, TypeError, "real numbers"),
        ([1, 2, 3], 0.0, ValueError, "limit_m"),
        ([1, 2, 3], np.nan, ValueError, "limit_m"),
        ([1, 2, 3], "far", TypeError, "limit_m"),
    ],
)
def test_points_that_are_none_are_refused(
    world: avoidbench.World, points: Any, limit: Any, error: type[Exception], text: str
) -> None:
    with pytest.raises(error, match=text):
        world.nearest(points, limit)


@pytest.mark.parametrize("resolution", [0.0, -1.0, np.nan, np.inf, 1e-300, 1001.0])
def test_cells_that_can_not_be_are_refused(world: avoidbench.World, resolution: float) -> None:
    with pytest.raises(ValueError, match="resolution"):
        world.occupancy(resolution)


def test_missions_that_can_not_be_are_refused(world: avoidbench.World) -> None:
    with pytest.raises(ValueError, match="count"):
        world.missions(-1)
    with pytest.raises(TypeError, match="float"):
        world.missions(1.5)  # type: ignore[arg-type]


def test_cameras_that_look_at_themselves_are_refused() -> None:
    with pytest.raises(ValueError, match=r"targets_world\[1\] is where its camera is"):
        avoidbench.look_at(np.zeros((2, 3)), [[1, 0, 0], [0, 0, 0]])
    with pytest.raises(ValueError, match="got 2 and 3"):
        avoidbench.look_at(np.zeros((2, 3)), np.ones((3, 3)))


def test_the_extension_itself_checks_too() -> None:
    core = _core.read_world("hall", [], 1)
    sensor = _core.read_sensor(["sensor.width_px=16", "sensor.height_px=8"])
    poses = np.stack([pose()])
    with pytest.raises(ValueError, match="not of this sensor's size"):
        core.write_depth(sensor, poses, 1, np.empty((1, 9, 16), np.float32))
    with pytest.raises(TypeError):
        core.write_depth(sensor, poses.astype(np.float32), 1, np.empty((1, 8, 16), np.float32))
    with pytest.raises(TypeError):
        core.write_depth(sensor, poses[:, ::2], 1, np.empty((1, 8, 16), np.float32))
    with pytest.raises(ValueError, match="as many"):
        core.write_nearest(np.zeros((2, 3)), 1.0, np.empty(3), np.empty((2, 3)))
    with pytest.raises(ValueError, match="sizes"):
        core.write_mesh(np.empty((0, 3)), np.empty((0, 3), np.int32))
    read_only = np.empty((1, 8, 16), np.float32)
    read_only.flags.writeable = False
    with pytest.raises(TypeError):
        core.write_depth(sensor, poses, 1, read_only)
    with pytest.raises(TypeError):
        _core.World()
    assert np.isfinite(core.occupancy(1.0)[1]).all()
