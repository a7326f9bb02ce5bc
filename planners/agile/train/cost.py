"""The cost J of predicted trajectories, in torch and differentiable. The expert in C++ has the same.

A trajectory is a polynomial of degree 5 over s = t/T, whose position, velocity and acceleration at s = 0 are those of
the plan's start, fitted by least squares to the ten points that the network predicts. Points are in the unit v_des T,
relative to the start, in the axes of the image frame: origin at the camera at exposure, x along the camera's heading
(level), y left, z up."""

from __future__ import annotations

import dataclasses
import math

import numpy
import torch
from torch import Tensor

HORIZON_S = 2.0  # T
POINTS, TIMES = 10, 20  # what the network predicts; where the cost looks
SPEED_UNIT_MPS, ACCELERATION_UNIT_MPS2 = 5.0, 10.0  # of the inputs 16 and 6 to 8
COLLISION_M = 0.3  # nearer counts as a collision in the figures
SAFE_M, NEAR_M = 0.8, 0.4  # where the collision's cost begins; where it gets steep
MAX_ACCELERATION_MPS2, MAX_JERK_MPS3 = 6.0, 40.0
VIEW_TIMES, VIEW_RAD, VIEW_SCALE_RAD, VIEW_FROM_M = 8, math.radians(40), math.radians(10), 0.3
GOAL_REACH = 1.5  # the goal counts as this far away, in the unit v_des T; the planner itself flies slower near it
TINY = 1e-12  # keeps a norm's gradient finite at zero


def projection_matrix() -> numpy.ndarray:
    """(12, 80): takes an axis' ten points, start velocity (unit v_des) and half start acceleration (unit v_des / T) to
    its position and first three derivatives by s at the 20 times i/20: first all positions, then all first derivatives,
    and so on."""

    def powers(s: numpy.ndarray, derivative: int) -> numpy.ndarray:
        """(len(s), 5): the derivative of s¹ … s⁵."""
        return numpy.stack(
            [math.perm(k, derivative) * s ** (k - derivative) if k >= derivative else 0 * s for k in range(1, 6)], 1
        )

    at_points = powers(numpy.arange(1, POINTS + 1) / POINTS, 0)
    fit = numpy.linalg.pinv(at_points[:, 2:])  # (3, 10)
    # The coefficients (5) from the points (10) and the first two coefficients.
    coefficients = numpy.zeros((5, POINTS + 2))
    coefficients[0, POINTS] = coefficients[1, POINTS + 1] = 1.0
    coefficients[2:, :POINTS] = fit
    coefficients[2:, POINTS:] = -fit @ at_points[:, :2]
    times = numpy.arange(1, TIMES + 1) / TIMES
    return numpy.concatenate([powers(times, d) for d in range(4)]).dot(coefficients).T


@dataclasses.dataclass
class Places:
    """Where each of B samples lies in its map."""

    cell: Tensor  # (B, 3) the image frame's origin in cells of the clearance grid, x, y, z
    turn: Tensor  # (B, 2) cosine and sine of the image frame's yaw
    lowest: Tensor  # (B, 3) the map's box relative to the image frame's origin, m, in the world's axes
    highest: Tensor  # (B, 3)
    shape: Tensor  # (B, 3) int64: the grid's cells along x, y, z
    offset: Tensor  # (B) int64: where its grid begins among all grids
    side: Tensor  # (B) 1, or -1 where the sample is mirrored: its y axis points to the right of what the map has

    def at(self, index: Tensor) -> Places:
        return Places(*(getattr(self, field.name)[index] for field in dataclasses.fields(self)))

    def to(self, device: torch.device) -> Places:
        return Places(*(getattr(self, field.name).to(device) for field in dataclasses.fields(self)))


@dataclasses.dataclass
class Evaluation:
    """What is known of B × M trajectories."""

    total: Tensor  # (B, M) J
    clearance_m: Tensor  # (B, M, 20) to the nearest surface or side of the box
    points: Tensor  # (B, M, 10, 3) of the projected trajectories, in the unit v_des T
    parts: dict[str, Tensor]  # the summands of J: collision, progress, effort, limits, view, height


class Cost:
    """The cost in some maps: grids is a flat uint8 tensor of all maps' clearances, one after another."""

    def __init__(self, grids: Tensor, cell_m: float) -> None:
        self.grids, self.cell_m = grids, cell_m
        device = grids.device
        self.projection = torch.from_numpy(projection_matrix()).float().to(device)
        weights = 1.5 - torch.arange(1, TIMES + 1, dtype=torch.float64) / TIMES
        self.weights = (weights / weights.mean()).float().to(device)

    def project(self, points: Tensor, inputs: Tensor) -> Tensor:
        """(4, B, M, 20, 3) positions relative to the start and their derivatives by s, unit v_des T, of points (B, M,
        10, 3)."""
        half_acceleration = (
            inputs[:, 6:9] * (0.5 * HORIZON_S * ACCELERATION_UNIT_MPS2 / SPEED_UNIT_MPS) / inputs[:, 16:17]
        )
        start = torch.stack([inputs[:, 3:6], half_acceleration], 1).unsqueeze(1).expand(-1, points.shape[1], -1, -1)
        given = torch.cat([points, start], 2).transpose(2, 3)  # (B, M, 3, 12)
        found = given @ self.projection.to(given.dtype)
        return found.unflatten(3, (4, TIMES)).permute(3, 0, 1, 4, 2)

    def clearance(self, points_m: Tensor, places: Places) -> Tensor:
        """(B, N) distances, m, of points (B, N, 3) of the image frame: to the nearest surface, the box's sides and its
        top."""
        cosine, sine = places.turn[:, :1], places.turn[:, 1:]
        x, y = points_m[:, :, 0], points_m[:, :, 1] * places.side.unsqueeze(1)
        world = torch.stack([cosine * x - sine * y, sine * x + cosine * y, points_m[:, :, 2]], 2)
        to_box = torch.minimum(
            (world[:, :, :2] - places.lowest[:, None, :2]).amin(2), (places.highest.unsqueeze(1) - world).amin(2)
        )
        return torch.minimum(self.surface_distance(places.cell.unsqueeze(1) + world / self.cell_m, places), to_box)

    def surface_distance(self, cell: Tensor, places: Places) -> Tensor:
        """(B, N) trilinear in the grid at (B, N, 3) in cells; outside as at the nearest place inside."""
        last = (places.shape - 1).unsqueeze(1)
        cell = torch.minimum(cell.clamp(min=0.0), last.to(cell.dtype))
        low = torch.minimum(cell.detach().floor().long(), (last - 1).clamp(min=0))
        part = cell - low.to(cell.dtype)
        step_y = places.shape[:, :1]
        step_z = step_y * places.shape[:, 1:2]
        base = places.offset.unsqueeze(1) + low[:, :, 0] + step_y * low[:, :, 1] + step_z * low[:, :, 2]
        has_next = (places.shape > 1).long()  # a grid of one cell along an axis has no neighbour there
        steps = torch.stack([has_next[:, 0], has_next[:, 1] * step_y[:, 0], has_next[:, 2] * step_z[:, 0]], 1)
        corners = torch.tensor([[k & 1, k >> 1 & 1, k >> 2] for k in range(8)], device=cell.device)
        index = base.unsqueeze(2) + (steps.unsqueeze(1) * corners).sum(2).unsqueeze(
            1
        )  # (B, N, 8); no matrix product, GPUs have none of int64
        value = self.grids[index].to(cell.dtype)
        value = torch.lerp(value[:, :, :4], value[:, :, 4:], part[:, :, 2:])
        value = torch.lerp(value[:, :, :2], value[:, :, 2:], part[:, :, 1:2])
        value = torch.lerp(value[:, :, 0], value[:, :, 1], part[:, :, 0])
        return value * 0.01 - 0.5

    def __call__(self, points: Tensor, inputs: Tensor, places: Places) -> Evaluation:
        """The cost of the trajectories through points (B, M, 10, 3)."""
        batch, modes = points.shape[:2]
        speed_mps = (inputs[:, 16] * SPEED_UNIT_MPS).view(-1, 1, 1, 1)
        reach_m = speed_mps * HORIZON_S
        at, first, second, third = self.project(points, inputs).unbind(0)
        seen_m = at * reach_m + inputs[:, None, None, :3]
        clearance_m = self.clearance(seen_m.flatten(1, 2), places).view(batch, modes, TIMES)
        acceleration = norm_squared(second * (speed_mps / HORIZON_S))
        jerk = norm_squared(third * (speed_mps / HORIZON_S**2))
        too_fast = torch.relu(torch.sqrt(norm_squared(first) + TINY) - 1.0)
        too_strong = torch.relu(torch.sqrt(acceleration + TINY) / MAX_ACCELERATION_MPS2 - 1.0)
        parts = {
            "collision": 2.0 * (collision_cost(clearance_m) * self.weights.to(clearance_m.dtype)).mean(2),
            "progress": progress_cost(at[:, :, -1], inputs),
            "effort": 0.1 * (acceleration / MAX_ACCELERATION_MPS2**2 + jerk / MAX_JERK_MPS3**2).mean(2),
            "limits": (20.0 * too_fast**2 + 4.0 * too_strong**2).mean(2),
            "view": view_cost(at[:, :, :VIEW_TIMES] * reach_m),
            "height": height_cost(at * reach_m, inputs),
        }
        return Evaluation(sum(parts.values(), torch.zeros_like(parts["view"])), clearance_m, at[:, :, 1::2], parts)


def norm_squared(vectors: Tensor) -> Tensor:
    return (vectors * vectors).sum(-1)


def collision_cost(clearance_m: Tensor) -> Tensor:
    """0 beyond 0.8 m, 1 at 0.4 m, 4 at a surface, and more inside of it."""
    far = (SAFE_M - clearance_m) / (SAFE_M - NEAR_M)
    near = 1.0 + 3.0 * (1.0 - (clearance_m / NEAR_M) ** 2)
    inside = 4.0 - 8.0 * clearance_m
    return torch.where(clearance_m < 0.0, inside, torch.where(clearance_m < NEAR_M, near, far.clamp(min=0.0)))


def progress_cost(end: Tensor, inputs: Tensor) -> Tensor:
    """(B, M): 0 where the trajectory's end (B, M, 3) has come v_des T nearer to a goal that lies 1.5 times as far away
    as that."""
    left = torch.sqrt(norm_squared((inputs[:, 12:15] * GOAL_REACH).unsqueeze(1) - end) + TINY)
    return 1.0 - (GOAL_REACH - left)


def view_cost(from_start_m: Tensor) -> Tensor:
    """(B, M): of the first places (B, M, 8, 3) relative to the start, how far they lie aside of what the camera
    sees."""
    aside = torch.sqrt(norm_squared(from_start_m[..., 1:]) + TINY)
    angle = torch.atan2(aside, from_start_m[..., 0])
    cost = 0.02 * (torch.relu(angle - VIEW_RAD) / VIEW_SCALE_RAD) ** 2
    return torch.where(norm_squared(from_start_m) > VIEW_FROM_M**2, cost, torch.zeros_like(cost)).mean(2)


def height_cost(from_start_m: Tensor, inputs: Tensor) -> Tensor:
    """(B, M): of places (B, M, 20, 3) relative to the start, how far they lie above or below the line to the goal."""
    to_goal = inputs[:, None, None, 12:15]
    along = (from_start_m * to_goal).sum(3)
    return 0.1 * (from_start_m[..., 2] - along * to_goal[..., 2]).square().mean(2)
