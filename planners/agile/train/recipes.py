"""What the training makes small, and the figures by which it is judged.

imitation: the modes follow the expert's three trajectories, as in Loquercio et al. (2021), and go down the cost a
little as well. descent: after a beginning by the expert's trajectories the modes go down the cost alone. Both teach
alpha what the mode's cost is."""

from __future__ import annotations

import torch
from cost import COLLISION_M, Cost, Evaluation
from network import MODES, Network, alphas_and_points
from samples import Batch
from torch import Tensor

RECIPES = ("imitation", "descent")
WINNER_SHARE = 0.95  # of a label's error for the mode nearest to it
LABEL_WEIGHT, ALPHA_WEIGHT, COST_WEIGHT = 100.0, 2.0, 0.3
GREATEST_ALPHA = 4.0  # costs above are learned as this
TAME_FROM = 10.0  # costs above count by their logarithm, lest one wild trajectory decides a step
BEST_SHARE = 0.8  # of descent: for the best mode; the rest for the mean of all
BEGINNING = 0.15  # of descent's time: while the labels' error fades out
APART, APART_WEIGHT = 0.2, 0.05  # of descent: how far from each other modes should end, unit v_des T


def label_error(points: Tensor, labels: Tensor) -> Tensor:
    """(B): relaxed winner-takes-all of projected points (B, 3, 10, 3). Each label draws the mode that is nearest to it;
    a mode that is nearest to none is drawn a little by the best label."""
    errors = (points.unsqueeze(1) - labels.unsqueeze(2)).square().mean((3, 4))  # (B, label, mode)
    won = torch.nn.functional.one_hot(errors.argmin(2), MODES).to(errors.dtype)
    idle = (won.sum(1) == 0).to(errors.dtype)
    of_modes = WINNER_SHARE * (won * errors).sum(1) + idle * ((1.0 - WINNER_SHARE) / (MODES - 1)) * errors[:, 0]
    return of_modes.mean(1)


def alpha_error(alphas: Tensor, found: Evaluation) -> Tensor:
    """(B): mean square over the modes."""
    return (alphas - found.total.detach().clamp(max=GREATEST_ALPHA)).square().mean(1)


def tame(total: Tensor) -> Tensor:
    return torch.where(total > TAME_FROM, TAME_FROM * (1.0 + torch.log(total.clamp(min=TAME_FROM) / TAME_FROM)), total)


def closeness(points: Tensor) -> Tensor:
    """(B): mean over pairs of modes: 1 where they end at the same place, 0 where APART or farther from each other."""
    ends = points[:, :, -1]
    pairs = [torch.sqrt((ends[:, i] - ends[:, j]).square().sum(1) + 1e-8) for i in range(MODES) for j in range(i)]
    return torch.relu(1.0 - torch.stack(pairs, 1) / APART).mean(1)


def loss(recipe: str, output: Tensor, batch: Batch, cost: Cost, label_share: float) -> tuple[Tensor, dict[str, Tensor]]:
    """The mean loss of a batch, and its figures. label_share: of descent, 1 at the beginning, then 0."""
    alphas, points = alphas_and_points(output)
    found = cost(points, batch.inputs, batch.places)
    of_labels, tamed = label_error(found.points, batch.labels), tame(found.total)
    of_samples = ALPHA_WEIGHT * alpha_error(alphas, found)
    if recipe == "imitation":
        of_samples = of_samples + LABEL_WEIGHT * of_labels + COST_WEIGHT * tamed.mean(1)
    else:
        descent = BEST_SHARE * tamed.amin(1) + (1.0 - BEST_SHARE) * tamed.mean(1)
        of_samples = of_samples + descent + APART_WEIGHT * closeness(found.points)
        if label_share > 0.0:
            of_samples = of_samples + label_share * LABEL_WEIGHT * of_labels
    return of_samples.mean(), figures(alphas.detach(), found, of_labels)


def figures(alphas: Tensor, found: Evaluation, of_labels: Tensor) -> dict[str, Tensor]:
    """Means over a batch."""
    total, clearance_m = found.total.detach(), found.clearance_m.detach()
    chosen = alphas.argmin(1, keepdim=True)
    collides = (clearance_m.amin(2) < COLLISION_M).to(total.dtype)
    return {
        "label_error": of_labels.detach().mean(),
        "chosen_cost": total.gather(1, chosen).mean(),
        "best_cost": total.amin(1).mean(),
        "chosen_collision": collides.gather(1, chosen).mean(),
        "best_collision": collides.amin(1).mean(),
        "alpha_error": alpha_error(alphas, found).mean(),
        "closeness": closeness(found.points.detach()).mean(),
    }


class Means:
    """Means of figures over batches."""

    def __init__(self) -> None:
        self.sums: dict[str, Tensor] = {}
        self.count = 0

    def add(self, values: dict[str, Tensor], count: int) -> None:
        for name, value in values.items():
            self.sums[name] = (
                self.sums.get(name, torch.zeros((), dtype=torch.float64, device=value.device)) + value.double() * count
            )
        self.count += count

    def take(self) -> dict[str, float]:
        """The means since the last call."""
        means = {name: float(value) / self.count for name, value in self.sums.items()}
        self.sums, self.count = {}, 0
        return means


@torch.no_grad()
def validate(network: Network, batches: list[Batch], cost: Cost) -> dict[str, float]:
    was_training = network.training
    network.eval()
    means = Means()
    for batch in batches:
        alphas, points = alphas_and_points(network(batch.images, batch.inputs))
        found = cost(points, batch.inputs, batch.places)
        means.add(figures(alphas, found, label_error(found.points, batch.labels)), len(batch.inputs))
    network.train(was_training)
    return means.take()


@torch.no_grad()
def expert(batches: list[Batch], label_costs: Tensor, cost: Cost) -> dict[str, float]:
    """The same figures of the expert's trajectories, and how far this cost of them is from the expert's own: the two
    should agree."""
    means = Means()
    differences = []
    first = 0
    for batch in batches:
        found = cost(batch.labels, batch.inputs, batch.places)
        collides = (found.clearance_m.amin(2) < COLLISION_M).float()
        means.add({"best_cost": found.total[:, 0].mean(), "best_collision": collides[:, 0].mean()}, len(batch.inputs))
        differences.append((found.total - label_costs[first : first + len(batch.inputs)]).abs())
        first += len(batch.inputs)
    difference = torch.cat(differences).flatten()
    return {
        **means.take(),
        "median_cost_difference": float(difference.median()),
        "greatest_cost_difference": float(difference.max()),
    }
