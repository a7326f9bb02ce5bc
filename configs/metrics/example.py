"""Custom metrics in Python: avoidbench report --metrics-from example.py

Each public function is a metric: it takes a flight (described in scripts/custom_metrics.py) and returns a number, or
None if the metric is not defined. The first line of its docstring describes it."""

import numpy


def yaw_travel_rad(flight):
    """Sum of all turns about the vertical [rad]; less is better"""
    if len(flight.time_s) < 2:
        return None
    w, x, y, z = flight.q_world_body.T
    yaw_rad = numpy.unwrap(numpy.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    return numpy.abs(numpy.diff(yaw_rad)).sum()


def time_near_obstacles_pct(flight):
    """Share of the flight within half a metre of a surface [%]; less is better"""
    if len(flight.time_s) == 0:
        return None
    return 100 * numpy.mean(flight.clearance_m < 0.5)
