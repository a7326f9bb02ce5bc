"""Where a track is at another time, and how far places are from it: the numbers of tests/abi/tracks_test.cpp."""

import numpy as np
import pytest
from avoidbench.planner import Track


def moving(kind: str, size_m: tuple[float, float, float]) -> Track:
    """At (1, 2, 3) at 10 s, by 1 m/s to the left and 0.5 m/s up."""
    return Track(
        id=1,
        kind=kind,
        time_s=10.0,
        center_world_m=np.array([1.0, 2.0, 3.0]),
        velocity_world_mps=np.array([0.0, 1.0, 0.5]),
        size_m=np.array(size_m),
    )


def test_a_track_goes_on_with_its_velocity() -> None:
    track = moving("ball", (1.0, 1.0, 1.0))
    assert track.center_at(12.0).tolist() == [1.0, 4.0, 4.0]
    assert track.center_at(8.0).tolist() == [1.0, 0.0, 2.0]


@pytest.mark.parametrize(
    ("kind", "size_m", "radius_m"),
    [
        ("person", (0.3, 0.5, 1.75), 0.25),
        ("pole", (0.2, 0.2, 4.0), 0.1),
        ("ball", (0.8, 0.8, 0.8), 0.4),
        ("box", (0.6, 0.8, 2.0), 0.5),
        ("other", (0.6, 0.8, 2.0), 0.5),
    ],
)
def test_the_radius_holds_the_box_whatever_its_heading(
    kind: str, size_m: tuple[float, float, float], radius_m: float
) -> None:
    assert moving(kind, size_m).radius_m == pytest.approx(radius_m)


def test_distances_are_those_to_a_ball_and_to_a_cylinder() -> None:
    ball = moving("ball", (1.0, 1.0, 1.0))
    assert ball.distance_m([4.0, 2.0, 7.0], 10.0) == pytest.approx(4.5)
    assert ball.distance_m([3.0, 5.0, 6.0], 12.0) == pytest.approx(2.5)
    box = moving("box", (0.6, 0.8, 2.0))
    places = [[4.0, 6.0, 3.5], [1.2, 2.0, 7.0], [1.2, 2.0, 0.0], [4.5, 2.0, 8.0], [1.25, 2.0, 3.0], [1.0, 2.0, 3.875]]
    assert box.distance_m(places, 10.0) == pytest.approx([4.5, 3.0, 2.0, 5.0, -0.25, -0.125])
    assert box.distance_m([places, places], 10.0).shape == (2, 6)
    assert box.distance_m([4.0, 8.0, 4.5], 12.0) == pytest.approx(4.5)
