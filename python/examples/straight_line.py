"""A planner in Python: the library straight_line written again. Its flights are the library's to the last bit.

python straight_line.py [SWEEP]      flies the sweep ("quick") with it and prints the report"""

import math
import sys

import avoidbench
from avoidbench import portable_math
from avoidbench.planner import Mission, Observation, Parameter, Planner, Setup, Velocity


class StraightLine(Planner):
    """Flies the straight line to the goal and avoids nothing."""

    name = "straight_line"
    version = "1.0"
    summary = "Flies the straight line to the goal and avoids nothing."
    inputs = ("state", "goals")
    commands = ("velocity",)
    parameters = (
        Parameter("max_speed_mps", 3.0, "Speed held until the goal is near.", "m/s", 0.1, 20.0),
        Parameter("line_gain_hz", 1.0, "Speed back toward the line for each metre beside it.", "1/s", 0.0, 5.0),
    )

    def __init__(self, setup: Setup) -> None:
        self.max_speed_mps = min(setup.parameters["max_speed_mps"], setup.max_speed_mps)
        self.line_gain_hz = setup.parameters["line_gain_hz"]
        self.braking_mps2 = 0.3 * setup.max_acceleration_mps2

    def reset(self, mission: Mission) -> None:
        self.yaw_rad = mission.start_yaw_rad
        self.aim(mission.start_world_m.tolist(), mission.goal_world_m.tolist())

    def aim(self, start: list[float], goal: list[float]) -> None:
        """The line to the goal begins here."""
        self.goal_world_m = goal
        along = [goal[i] - start[i] for i in range(3)]
        length_m = math.sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2])
        self.course = [a / length_m if length_m > 0.0 else 0.0 for a in along]
        if along[0] * along[0] + along[1] * along[1] > 1e-6:  # a course straight up has no heading
            self.yaw_rad = portable_math.atan2(along[1], along[0])

    def plan(self, observation: Observation) -> Velocity:
        place = observation.position_world_m.tolist()
        assert observation.goal_world_m is not None
        if observation.goal_world_m.tolist() != self.goal_world_m:
            self.aim(place, observation.goal_world_m.tolist())
        left_m = 0.0
        for i in range(3):
            left_m += (self.goal_world_m[i] - place[i]) * self.course[i]
        # As fast as it can still stop from within the way that is left, and back to the line.
        speed_mps = min(self.max_speed_mps, math.sqrt(2.0 * self.braking_mps2 * abs(left_m)))
        speed_mps = math.copysign(min(speed_mps, 2.0 * abs(left_m)), left_m)
        velocity_world_mps = []
        for i in range(3):
            on_line_m = self.goal_world_m[i] - left_m * self.course[i]
            velocity_world_mps.append(speed_mps * self.course[i] + self.line_gain_hz * (on_line_m - place[i]))
        return Velocity(velocity_world_mps, yaw_rad=self.yaw_rad)


if __name__ == "__main__":
    print(avoidbench.fly(sys.argv[1] if len(sys.argv) > 1 else "quick", StraightLine).report())
