"""takes_depth.cpp in Python."""

from avoidbench.planner import Planner, Velocity


class TakesDepth(Planner):
    name = "takes_depth"
    version = "1"
    summary = "Is given depth images and flies ahead."
    sees = ("state", "depth")

    def plan(self, observation):
        is_free = not observation.depth or observation.depth[0].depth_m[0, 0] > 0.0
        return Velocity([1.0 if is_free else 0.0, 0.0, 0.0], yaw_rad=0.0)
