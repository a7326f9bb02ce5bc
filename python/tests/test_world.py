"""Maps as arrays: against closed forms, brute force, each other and the program."""

import json
import signal
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import avoidbench
import numpy as np
import pytest
from avoidbench._location import program_file

HALL = {"area_m": [20, 30], "height_m": 5.0}


def empty_hall() -> avoidbench.World:
    """A hall of a few cylinders that are lower than every camera here."""
    return avoidbench.make_world(
        "hall", **HALL, poisson_radius_m=10.0, cylinder_height_m=[0.3, 0.3], flight_height_m=2.0
    )


def pixel_rays(width: int, height: int, fov_x_deg: float) -> np.ndarray:
    """(height, width, 3): rays through the pixels' centres, camera frame, z = 1."""
    focal = 0.5 * width / np.tan(0.5 * np.radians(fov_x_deg))
    x = (np.arange(width) - 0.5 * (width - 1)) / focal
    y = (np.arange(height) - 0.5 * (height - 1)) / focal
    return np.stack([*np.broadcast_arrays(x[np.newaxis], y[:, np.newaxis]), np.ones((height, width))], axis=2)


def triangle_distances(point: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Distance from a point (3,) to each of the triangles (F, 3, 3): the least of those to its plane inside and to its
    edges."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    best = np.full(len(triangles), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        edge = end - start
        t = np.clip(((point - start) * edge).sum(1) / np.maximum((edge * edge).sum(1), 1e-300), 0, 1)
        best = np.minimum(best, np.linalg.norm(start + t[:, np.newaxis] * edge - point, axis=1))
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    unit = normal / np.maximum(area, 1e-300)[:, np.newaxis]
    height = ((point - a) * unit).sum(1)
    foot = point - height[:, np.newaxis] * unit
    inside = area > 0
    for start, end in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(end - start, foot - start) * unit).sum(1) >= 0
    return np.where(inside, np.minimum(best, np.abs(height)), best)


def test_depth_of_a_wall_is_its_distance() -> None:
    world = empty_hall()
    (x0, _, _), (x1, y1, _) = world.bounds_m
    camera = np.array([0.5 * (x0 + x1), y1 - 3.0, 2.5])
    pose = avoidbench.look_at(camera, camera + [0.0, 1.0, 0.0])
    depth = world.depth(pose[0], width_px=64, height_px=32, fov_x_deg=60)
    assert depth.shape == (32, 64) and depth.dtype == np.float32
    np.testing.assert_allclose(depth, y1 - camera[1], atol=1e-5)


def test_depth_of_the_floor_follows_from_the_rays() -> None:
    world = empty_hall()
    low, high = world.bounds_m
    camera = np.array([0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 3.0])
    pose = avoidbench.look_at(camera, camera + [0.3, 1.0, -1.0])[0]
    depth = world.depth(pose, width_px=80, height_px=60, fov_x_deg=30, min_range_m=0)
    rays_world = pixel_rays(80, 60, 30) @ pose[:3, :3].T
    floor = -camera[2] / rays_world[..., 2]
    # Cylinders of 0.3 m may stand before some of it.
    assert np.mean(np.abs(depth - floor) < 1e-4) > 0.8
    assert (depth <= floor + 1e-4).all()


def test_depth_is_infinite_beyond_the_range_and_invalid_before_it() -> None:
    world = empty_hall()
    low, high = world.bounds_m
    pose = avoidbench.look_at([10.0, high[1] - 3.0, 2.5], [10.0, high[1], 2.5])
    size = {"width_px": 16, "height_px": 8, "fov_x_deg": 20}
    assert np.isposinf(world.depth(pose, **size, max_range_m=2.9)).all()
    assert np.isnan(world.depth(pose, **size, min_range_m=3.1)).all()
    assert np.isfinite(world.depth(pose, **size, min_range_m=2.9, max_range_m=3.1)).all()


def test_depth_by_quaternions_is_that_by_matrices() -> None:
    world = avoidbench.make_world("forest", seed=3)
    # (w, x, y, z) that takes camera x, y, z (right, down, forward) to world x, -z, y: looks along y.
    quaternion = np.array([np.sqrt(0.5), -np.sqrt(0.5), 0.0, 0.0])
    positions = np.array([[20.0, 5.0, 2.5], [12.0, 8.0, 3.0]])
    by_matrix = world.depth(avoidbench.look_at(positions, positions + [0, 1, 0]), width_px=32, height_px=24)
    by_quaternion = world.depth(positions_world=positions, quaternions_wxyz=quaternion, width_px=32, height_px=24)
    np.testing.assert_allclose(by_quaternion, by_matrix, rtol=1e-4, atol=1e-4)
    single = world.depth(positions_world=positions[1], quaternions_wxyz=quaternion, width_px=32, height_px=24)
    np.testing.assert_array_equal(single, by_quaternion[1])


def test_depth_agrees_with_the_mesh() -> None:
    world = avoidbench.make_world("poles", seed=2)
    vertices, triangles = world.mesh()
    mission = world.missions(1)
    pose = avoidbench.look_at(mission.starts_world, mission.goals_world)[0]
    depth = world.depth(pose, width_px=16, height_px=12, max_range_m=1000)
    points = pose[:3, 3] + (pixel_rays(16, 12, 90) * depth[..., np.newaxis]).reshape(-1, 3) @ pose[:3, :3].T
    points = points[np.isfinite(points).all(1)]
    assert len(points) > 50
    for point in points:
        assert triangle_distances(point, vertices[triangles]).min() < 1e-3


def test_noise_follows_from_the_seed() -> None:
    world = avoidbench.make_world("hall", seed=1)
    mission = world.missions(2)
    poses = avoidbench.look_at(mission.starts_world, mission.goals_world)
    options = {"sensor": "depth_noisy", "width_px": 64, "height_px": 48}
    first = world.depth(poses, seed=5, **options)
    np.testing.assert_array_equal(first, world.depth(poses, seed=5, **options))
    assert (first != world.depth(poses, seed=6, **options)).mean() > 0.1
    # Image i has its own noise, wherever the call ends.
    np.testing.assert_array_equal(first[0], world.depth(poses[0], seed=5, **options))
    true = world.depth(poses, sensor={"preset": "depth_noisy", "kind": "depth_ideal"}, width_px=64, height_px=48)
    both = np.isfinite(first) & np.isfinite(true)
    disparity_at_1m_px = 32 * 0.12
    assert both.mean() > 0.3
    assert 0.05 < np.median(np.abs(disparity_at_1m_px / first[both] - disparity_at_1m_px / true[both])) < 0.4


def test_depth_is_written_to_an_array_that_is_given() -> None:
    world = avoidbench.make_world("hall", seed=1)
    mission = world.missions(3)
    poses = avoidbench.look_at(mission.starts_world, mission.goals_world)
    out = np.full((3, 24, 32), -1, dtype=np.float32)
    assert world.depth(poses, width_px=32, height_px=24, out=out) is out
    np.testing.assert_array_equal(out, world.depth(poses, width_px=32, height_px=24))
    assert world.depth(poses[:0], width_px=32, height_px=24).shape == (0, 24, 32)


@pytest.mark.parametrize("generator", ["hall", "maze"])
def test_nearest_is_that_of_brute_force(generator: str) -> None:
    world = avoidbench.make_world(generator, seed=4)
    vertices, triangles = world.mesh()
    low, high = world.flight_bounds_m
    points = low + np.random.default_rng(1).random((200, 3)) * (high - low)
    distances, nearest = world.nearest(points)
    corners = vertices[triangles]
    expected = [triangle_distances(point, corners).min() for point in points]
    np.testing.assert_allclose(distances, expected, rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(points - nearest, axis=1), distances, atol=1e-12)


def test_nearest_beyond_the_limit_is_nothing() -> None:
    world = empty_hall()
    point = [10.0, 15.0, 2.5]
    distance = world.nearest(point).distances_m[0]
    within = world.nearest(point, limit_m=1.01 * distance)
    assert within.distances_m[0] == distance
    beyond = world.nearest([point, point], limit_m=0.99 * distance)
    assert np.isposinf(beyond.distances_m).all() and np.isnan(beyond.points_world).all()


def test_a_cell_is_occupied_where_a_surface_is_near() -> None:
    world = avoidbench.make_world("hall", seed=2)
    occupancy = world.occupancy(0.5)
    assert occupancy.is_occupied.dtype == np.bool_
    size = world.bounds_m[1] - world.bounds_m[0]
    assert occupancy.is_occupied.shape == tuple(np.ceil(size / 0.5).astype(int))
    np.testing.assert_array_equal(occupancy.origin_world, world.bounds_m[0])
    cells = np.argwhere(np.ones_like(occupancy.is_occupied))
    centres = occupancy.origin_world + (cells + 0.5) * occupancy.resolution_m
    distances, nearest = world.nearest(centres)
    is_occupied = occupancy.is_occupied[tuple(cells.T)]
    half = 0.5 * occupancy.resolution_m
    # The nearest point is in the cell: occupied. Farther than a corner: not. In between either may be.
    assert is_occupied[(np.abs(nearest - centres) < half - 1e-9).all(1)].all()
    assert not is_occupied[distances > np.sqrt(3) * half + 1e-9].any()
    assert 0.01 < is_occupied.mean() < 0.9


def test_missions_are_in_the_flight_space_and_free() -> None:
    world = avoidbench.make_world("forest", seed=7, mission={"free_radius_m": 1.5})
    missions = world.missions(20)
    for places in (missions.starts_world, missions.goals_world):
        assert places.shape == (20, 3)
        assert (places >= world.flight_bounds_m[0]).all() and (places <= world.flight_bounds_m[1]).all()
        assert (world.nearest(places).distances_m >= 1.5).all()
    way = missions.goals_world - missions.starts_world
    np.testing.assert_allclose(missions.start_yaws_rad, np.arctan2(way[:, 1], way[:, 0]), atol=1e-9)
    np.testing.assert_array_equal(world.missions(5).starts_world, missions.starts_world[:5])
    assert world.missions(0).starts_world.shape == (0, 3)


def test_the_map_is_that_of_the_program() -> None:
    world = avoidbench.make_world("forest", seed=3, poisson_radius_m=4.5, area_m=[20, 25])
    command = [program_file(), "maps", "info", "forest", "--seed", "3", "--set", "poisson_radius_m=4.5"]
    command += ["--set", "area_m=[20, 25]", "--missions", "1", "--format", "json"]
    shown = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert world.digest in shown
    rows = {row["property"]: row["value"] for row in json.loads(shown)}
    assert int(rows["obstacle_count"]) == world.obstacle_count
    vertices, triangles = world.mesh()
    assert len(triangles) == int(rows["triangle_count"])
    assert triangles.min() == 0 and triangles.max() == len(vertices) - 1
    assert sum(obstacle.kind in ("tree", "bush") for obstacle in world.obstacles) == world.obstacle_count


def test_generators_files_and_mappings_give_the_same_map(tmp_path: Path) -> None:
    by_name = avoidbench.make_world("hall", seed=5, crates_ratio=0.25)
    assert (by_name.generator, by_name.seed) == ("hall", 5)
    file = tmp_path / "map.yaml"
    file.write_text("generator: hall\ncrates_ratio: 0.25\nseeds: [5]\n")
    sweep = {
        "sweep": "mine",
        "trials": 3,
        "maps": {"generator": "hall", "crates_ratio": np.float64(0.25), "seeds": [5, 6]},
    }
    others = [
        avoidbench.make_world(file),
        avoidbench.make_world(str(file), crates_ratio=0.25),
        avoidbench.make_world({"generator": "hall", "crates_ratio": 0.25}, seed=5),
        avoidbench.make_world(sweep),
        avoidbench.make_world(by_name.generator, seed=np.int64(5), **{"maps.crates_ratio": 0.25}),
    ]
    assert [world.digest for world in others] == [by_name.digest] * len(others)
    assert avoidbench.make_world("hall", seed=6, crates_ratio=0.25).digest != by_name.digest


def test_a_built_in_sweep_has_a_map() -> None:
    assert avoidbench.make_world("quick").obstacle_count > 0


def test_a_camera_may_look_straight_down() -> None:
    pose = avoidbench.look_at([1.0, 2.0, 3.0], [1.0, 2.0, 0.0])[0]
    np.testing.assert_allclose(pose[:3, :3], np.array([[1, 0, 0], [0, -1, 0], [0, 0, -1]]), atol=1e-12)


def test_several_threads_may_ask_one_world() -> None:
    world = avoidbench.make_world("forest", seed=2)
    missions = world.missions(8)
    poses = avoidbench.look_at(missions.starts_world, missions.goals_world)
    options = {"sensor": "stereo_sgm", "width_px": 96, "height_px": 64}
    alone = [world.depth(pose, **options) for pose in poses]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda pose: world.depth(pose, **options), poses))
        distances = list(pool.map(world.nearest, [missions.starts_world] * 8))
    np.testing.assert_array_equal(together, alone)
    np.testing.assert_array_equal([found.distances_m for found in distances], [distances[0].distances_m] * 8)


def test_long_calls_can_be_interrupted() -> None:
    world = avoidbench.make_world("forest", seed=2)
    points = np.tile(world.missions(1).starts_world, (20_000_000, 1))  # minutes

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        with pytest.raises(KeyboardInterrupt):
            world.nearest(points)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def bumps(cells: int) -> bytes:
    """A binary STL of a field of bumps, 60 m × 60 m, of 2 · cells² triangles."""
    at = np.linspace(0.0, 60.0, cells + 1)
    x, y = np.meshgrid(at, at, indexing="ij")
    v = np.stack([x, y, np.random.default_rng(1).uniform(0.0, 1.0, x.shape)], axis=-1)
    a, b, c, d = v[:-1, :-1], v[1:, :-1], v[1:, 1:], v[:-1, 1:]
    triangles = np.concatenate([np.stack(corners, axis=-2).reshape(-1, 3, 3) for corners in ((a, b, c), (a, c, d))])
    records = np.zeros(len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    records["corners"] = triangles
    return bytes(80) + np.uint32(len(records)).tobytes() + records.tobytes()


def test_making_a_map_is_interrupted_wherever_it_is(tmp_path: Path) -> None:
    (tmp_path / "bumps.stl").write_bytes(bumps(600))

    def make() -> float:
        """The processor's time that it takes."""
        began = time.process_time()
        avoidbench.make_world(
            "mesh", file=tmp_path / "bumps.stl", bounds={"lowest_m": [0, 0, 0], "highest_m": [60, 60, 10]}
        )
        return time.process_time() - began

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    whole_s = make()
    before = signal.signal(signal.SIGPROF, interrupt)
    try:
        for share in (0.05, 0.2, 0.35, 0.5, 0.65):
            signal.setitimer(signal.ITIMER_PROF, share * whole_s)
            began = time.process_time()
            with pytest.raises(KeyboardInterrupt):
                make()
            assert time.process_time() - began < (share + 0.2) * whole_s
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
