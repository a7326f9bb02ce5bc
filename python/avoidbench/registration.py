"""The environments that `gymnasium.make` knows once avoidbench is imported."""

from typing import Any

import gymnasium

_CAMERA = {"preset": "depth_ideal", "width_px": 64, "height_px": 48}

FOREST: dict[str, Any] = {
    "sweep": "env_forest",
    "maps": {"generator": "forest", "area_m": [40, 40], "poisson_radius_m": 5.5, "seeds": [1, 2, 3, 4, 5, 6, 7, 8]},
    "trials": 40,
    "mission": {"time_limit_s": 30},
    "sensor": _CAMERA,
}
"""Eight forests with 40 missions each, 64 × 48 true depth, commands after 33 ms."""

HALL: dict[str, Any] = {
    "sweep": "env_hall",
    "maps": {"generator": "hall", "area_m": [20, 30], "poisson_radius_m": 3.5, "seeds": [1, 2, 3, 4, 5, 6, 7, 8]},
    "trials": 40,
    "mission": {"time_limit_s": 30},
    "sensor": _CAMERA,
}
"""Eight halls of cylinders with 40 missions each, 64 × 48 true depth, commands after 33 ms."""

FOREST_LIDAR: dict[str, Any] = {
    **FOREST,
    "sweep": "env_forest_lidar",
    "sensor": {"name": "lidar_16x90", "kind": "none", "lidars": [{"preset": "velodyne_16", "columns": 90}]},
}
"""The same forests with only a lidar: 90 directions around, 16 beams above one another in each, 10 Hz."""

IDS = ("avoidbench/Forest-v0", "avoidbench/Hall-v0", "avoidbench/ForestLidar-v0", "avoidbench/Sweep-v0")


def register() -> None:
    """Makes IDS known to Gymnasium; once is enough. Sweep-v0 needs the argument `sweep`."""
    by_lidar = {"sweep": FOREST_LIDAR, "observe": ("ranges", "state", "goal")}
    arguments: tuple[dict[str, Any], ...] = ({"sweep": FOREST}, {"sweep": HALL}, by_lidar, {})
    for name, kwargs in zip(IDS, arguments, strict=True):
        if name not in gymnasium.registry:
            gymnasium.register(
                id=name,
                entry_point="avoidbench.env:AvoidbenchEnv",
                vector_entry_point="avoidbench.env:AvoidbenchVectorEnv",
                kwargs=kwargs,
            )
