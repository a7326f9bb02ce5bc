"""Made-up samples for the tests and for measuring the training's speed: poles on a plain, seen by a perfect camera.
Nobody trains on these to fly.

    python synthetic.py FOLDER --maps 20 --samples 200 --seed 1
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy
import samples as sample_files
import torch
from cost import HORIZON_S, Cost
from network import COLUMNS, INPUTS, ROWS

CELL_M, FOCAL_PX, CENTRE_COLUMN, CENTRE_ROW = 0.2, 48.0, 47.5, 31.5
LOWEST, HIGHEST = numpy.array([0.0, 0.0, 0.0]), numpy.array([16.0, 12.0, 4.0])


def poles_of(random: numpy.random.Generator) -> numpy.ndarray:
    """(8, 3): x, y, radius."""
    return numpy.concatenate([random.uniform(LOWEST[:2], HIGHEST[:2], (8, 2)), random.uniform(0.15, 0.6, (8, 1))], 1)


def clearance(points: numpy.ndarray, poles: numpy.ndarray) -> numpy.ndarray:
    """Distance, m, of points (…, 3) to the ground and to poles (n, 3): x, y, radius."""
    to_poles = numpy.hypot(points[..., None, 0] - poles[:, 0], points[..., None, 1] - poles[:, 1]) - poles[:, 2]
    return numpy.minimum(to_poles.min(-1), points[..., 2])


def image(origin: numpy.ndarray, yaw: float, poles: numpy.ndarray) -> numpy.ndarray:
    """(64, 96) nearness as the level camera sees it."""
    aside = -(numpy.arange(COLUMNS) - CENTRE_COLUMN) / FOCAL_PX
    down = (numpy.arange(ROWS) - CENTRE_ROW) / FOCAL_PX
    cosine, sine = numpy.cos(yaw), numpy.sin(yaw)
    x, y = cosine - sine * aside, sine + cosine * aside  # rays of depth 1
    from_pole = origin[:2] - poles[:, :2]
    a, b = x * x + y * y, from_pole[:, :1] * x + from_pole[:, 1:] * y
    root = b * b - a * ((from_pole**2).sum(1) - poles[:, 2] ** 2)[:, None]
    depth = numpy.where(root > 0, (-b - numpy.sqrt(numpy.maximum(root, 0))) / a, numpy.inf)
    depth = numpy.where(depth > 0.05, depth, numpy.inf).min(0)
    ground = numpy.where(down > 0, origin[2] / numpy.maximum(down, 1e-9), numpy.inf)
    nearest = numpy.minimum(depth[None], ground[:, None])
    return numpy.round(255 * numpy.minimum(1.0, 1.0 / nearest)).astype(numpy.uint8)


def way_to_side(origin: numpy.ndarray, direction: numpy.ndarray) -> float:
    """m along a level direction until the box's side."""
    with numpy.errstate(divide="ignore"):
        ways = numpy.where(direction[:2] > 0, (HIGHEST - origin)[:2], (LOWEST - origin)[:2]) / direction[:2]
    return float(ways.min())


def state(random: numpy.random.Generator, poles: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """Image, inputs and frame of a flight that is under way somewhere."""
    while True:
        origin = random.uniform(LOWEST + [1, 1, 0.7], HIGHEST - [1, 1, 1])
        if clearance(origin, poles) > 0.6:
            break
    yaw, v_des = random.uniform(-numpy.pi, numpy.pi), random.uniform(1.5, 4.0)
    reach = v_des * HORIZON_S
    start = random.normal(0, 0.05, 3)
    inputs = numpy.empty(INPUTS)
    inputs[0:3] = start
    inputs[3:6] = random.uniform(0.3, 1.0), random.normal(0, 0.1), random.normal(0, 0.05)
    inputs[6:9] = random.normal(0, 0.05, 3)
    up = numpy.array([random.normal(0, 0.1), -1.0, random.normal(0, 0.1)])
    inputs[9:12] = up / numpy.linalg.norm(up)
    goal = numpy.array([1.0, random.normal(0, 0.3), random.normal(0, 0.05)])
    inputs[12:15] = goal / numpy.linalg.norm(goal)
    inputs[15] = min(1.0, random.uniform(0.3, 6.0))
    inputs[16] = v_des / 5
    inputs[17] = min(2.0, (origin[2] + start[2] - LOWEST[2]) / 3)
    inputs[18] = min(2.0, (HIGHEST[2] - origin[2] - start[2]) / 3)
    for k, turn in enumerate((0.0, numpy.pi / 2, -numpy.pi / 2)):
        inputs[19 + k] = min(
            1.0, way_to_side(origin, numpy.array([numpy.cos(yaw + turn), numpy.sin(yaw + turn)])) / reach
        )
    return image(origin, yaw, poles), inputs, numpy.array([*origin, yaw, v_des])


def candidates() -> torch.Tensor:
    """(45, 10, 3) arcs to the left, to the right, up and down."""
    s = torch.arange(1, 11) / 10
    arcs = [
        torch.stack([ahead * s, aside * s * s, above * s * s], 1)
        for aside in numpy.linspace(-0.7, 0.7, 15)
        for ahead, above in ((0.85, 0.0), (0.6, 0.0), (0.85, 0.1))
    ]
    return torch.stack(arcs).float()


def label(folder: Path) -> None:
    """Writes each sample's three best arcs that end apart."""
    data = sample_files.read([folder])
    cost, arcs = Cost(data.grids, data.cell_m), candidates()
    batch = data.batch(torch.arange(len(data)))
    found = cost(arcs.expand(len(data), -1, -1, -1), batch.inputs, batch.places)
    order = found.total.argsort(1)
    ends = found.points[:, :, -1, :]
    for number in data.map_numbers.unique().tolist():
        labels, costs = [], []
        for i in torch.nonzero(data.map_numbers == number).flatten().tolist():
            chosen = [int(order[i, 0])]
            for j in order[i].tolist():
                if len(chosen) < 3 and all(float((ends[i, j] - ends[i, k]).norm()) > 0.2 for k in chosen):
                    chosen.append(j)
            chosen += chosen[:1] * (3 - len(chosen))
            labels.append(found.points[i, chosen].numpy())
            costs.append(found.total[i, chosen].numpy())
        numpy.save(folder / f"{number:04}.labels.npy", numpy.stack(labels))
        numpy.save(folder / f"{number:04}.label_costs.npy", numpy.stack(costs))


def write(folder: Path, maps: int, count: int, seed: int) -> None:
    """Writes a folder of samples: so many maps with so many samples each."""
    folder.mkdir(parents=True, exist_ok=True)
    axes = [numpy.arange(low + 0.5 * CELL_M, high, CELL_M) for low, high in zip(LOWEST, HIGHEST)]
    z, y, x = numpy.meshgrid(*axes[::-1], indexing="ij")
    centres = numpy.stack([x, y, z], -1)
    for number in range(maps):
        random = numpy.random.default_rng([seed, number])
        poles = poles_of(random)
        values = numpy.clip(numpy.round((clearance(centres, poles) + 0.5) * 100), 0, 255).astype(numpy.uint8)
        images, inputs, frames = (numpy.stack(column) for column in zip(*(state(random, poles) for _ in range(count))))
        arrays = {
            "images": images,
            "inputs": inputs.astype(numpy.float32),
            "frames": frames,
            "clearance": values,
            "labels": numpy.zeros((count, 3, 10, 3), numpy.float32),
            "label_costs": numpy.zeros((count, 3), numpy.float32),
        }
        for name, array in arrays.items():
            numpy.save(folder / f"{number:04}.{name}.npy", array)
        about = {
            "origin": centres[0, 0, 0].tolist(),
            "cell_m": CELL_M,
            "lowest": LOWEST.tolist(),
            "highest": HIGHEST.tolist(),
            "sweep": "synthetic",
            "map": f"poles {number}",
            "samples": count,
            "round": 0,
        }
        (folder / f"{number:04}.json").write_text(json.dumps(about))
    label(folder)


def main() -> None:
    parser = argparse.ArgumentParser(description="Writes made-up samples.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--maps", type=int, default=20)
    parser.add_argument("--samples", type=int, default=200, help="of each map")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    write(options.folder, options.maps, options.samples, options.seed)


if __name__ == "__main__":
    main()
