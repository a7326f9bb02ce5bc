"""Reads what the program agile_samples wrote: for each map images, inputs, the expert's trajectories and the map's
clearance."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterable
from pathlib import Path

import numpy
import torch
from cost import Places
from network import COLUMNS, INPUTS, MODES, POINTS, ROWS
from torch import Tensor

HELD_OUT_OF = 10  # each tenth map, by its number, is for validation
# Components of the inputs that change their sign in a mirror: y of the start, its velocity and acceleration, of the
# goal; the right in "up".
MIRROR_SIGNS = numpy.ones(INPUTS, numpy.float32)
MIRROR_SIGNS[[1, 4, 7, 9, 13]] = -1
MIRROR_ORDER = [*range(20), 21, 20]  # the ways to the box on the left and on the right


@dataclasses.dataclass
class Batch:
    """Some samples, as the network and the cost take them."""

    images: Tensor  # (B, 1, 64, 96) 0 … 1
    inputs: Tensor  # (B, 22)
    labels: Tensor  # (B, 3, 10, 3)
    places: Places


@dataclasses.dataclass
class Samples:
    """All samples of some folders, and their maps' clearances."""

    images: Tensor  # (n, 64, 96) uint8
    inputs: Tensor
    labels: Tensor
    label_costs: Tensor  # (n, 3) as the expert had them
    places: Places
    map_numbers: Tensor  # (n)
    grids: Tensor  # uint8, flat
    cell_m: float
    left_out: int  # samples that aren't finite

    def __len__(self) -> int:
        return len(self.images)

    def to(self, device: torch.device) -> Samples:
        moved = {
            name: getattr(self, name).to(device)
            for name in ("images", "inputs", "labels", "label_costs", "places", "map_numbers", "grids")
        }
        return dataclasses.replace(self, **moved)

    def batch(self, index: Tensor) -> Batch:
        return Batch(
            self.images[index].unsqueeze(1).float().div_(255.0),
            self.inputs[index],
            self.labels[index],
            self.places.at(index),
        )

    def split(self) -> tuple[Tensor, Tensor]:
        """Indices of the samples for training and of those for validation, which are of other maps. Of fewer than ten
        maps the last one is for validation; of a single map all samples are for both."""
        numbers = self.map_numbers
        held_out = numbers % HELD_OUT_OF == HELD_OUT_OF - 1
        if not held_out.any():
            held_out = numbers == numbers.max()
        if held_out.all():
            everything = torch.arange(len(self), device=numbers.device)
            return everything, everything
        return torch.nonzero(~held_out).flatten(), torch.nonzero(held_out).flatten()


def mirrored(batch: Batch, which: Tensor) -> Batch:
    """The batch with the samples of which (B) seen in a mirror: left is right. Their cost is looked up at the place in
    the map that the mirrored trajectory is the image of."""
    signs = torch.from_numpy(MIRROR_SIGNS).to(batch.inputs)
    flip = which.view(-1, 1)
    images = torch.where(which.view(-1, 1, 1, 1), batch.images.flip(3), batch.images)
    inputs = torch.where(flip, (batch.inputs * signs)[:, MIRROR_ORDER], batch.inputs)
    labels = torch.where(
        which.view(-1, 1, 1, 1), batch.labels * batch.labels.new_tensor([1.0, -1.0, 1.0]), batch.labels
    )
    places = dataclasses.replace(batch.places, side=torch.where(which, -batch.places.side, batch.places.side))
    return Batch(images, inputs, labels, places)


def read(folders: Iterable[Path]) -> Samples:
    """All samples of the folders. The same number in two folders is taken for the same map when it comes to holding
    out."""
    maps = []
    for folder in folders:
        found = sorted(folder.glob("[0-9][0-9][0-9][0-9].json"))
        if not found:
            raise FileNotFoundError(f"{folder}: no samples here (0000.json and so on)")
        maps += [(folder, file.stem, json.loads(file.read_text())) for file in found]
    maps = [entry for entry in maps if entry[2]["samples"] > 0]
    count = sum(entry[2]["samples"] for entry in maps)
    if count == 0:
        raise ValueError("no samples in these folders")
    cells = {float(entry[2]["cell_m"]) for entry in maps}
    if len(cells) != 1:
        raise ValueError(f"the maps have cells of several sizes: {sorted(cells)} m")
    cell_m = cells.pop()

    images = numpy.empty((count, ROWS, COLUMNS), numpy.uint8)
    parts: dict[str, list[numpy.ndarray]] = {
        name: [] for name in ("inputs", "labels", "label_costs", "map_numbers", "place")
    }
    grids: list[numpy.ndarray] = []
    first = offset = 0
    for folder, stem, about in maps:
        n = about["samples"]
        arrays = {
            name: numpy.load(folder / f"{stem}.{name}.npy") for name in ("inputs", "frames", "labels", "label_costs")
        }
        images[first : first + n] = checked(
            folder, stem, "images", numpy.load(folder / f"{stem}.images.npy"), (n, ROWS, COLUMNS)
        )
        for name, shape in (
            ("inputs", (n, INPUTS)),
            ("labels", (n, MODES, POINTS, 3)),
            ("label_costs", (n, MODES)),
            ("frames", (n, 5)),
        ):
            checked(folder, stem, name, arrays[name], shape)
        grid = numpy.load(folder / f"{stem}.clearance.npy")
        for name in ("inputs", "labels", "label_costs"):
            parts[name].append(arrays[name].astype(numpy.float32, copy=False))
        parts["map_numbers"].append(numpy.full(n, int(stem), numpy.int64))
        parts["place"].append(places_of(arrays["frames"], about, grid.shape, offset))
        grids.append(grid.reshape(-1))
        first, offset = first + n, offset + grid.size

    joined = {name: numpy.concatenate(arrays) for name, arrays in parts.items()}
    finite = (
        numpy.isfinite(joined["inputs"]).all(1)
        & numpy.isfinite(joined["labels"]).all((1, 2, 3))
        & numpy.isfinite(joined["place"]).all(1)
    )
    finite &= joined["inputs"][:, 16] > 0
    if not finite.all():
        images, joined = images[finite], {name: array[finite] for name, array in joined.items()}
    tensors = {name: torch.from_numpy(joined[name]) for name in ("inputs", "labels", "label_costs", "map_numbers")}
    return Samples(
        torch.from_numpy(images),
        tensors["inputs"],
        tensors["labels"],
        tensors["label_costs"],
        as_places(joined["place"]),
        tensors["map_numbers"],
        torch.from_numpy(numpy.concatenate(grids)),
        cell_m,
        int((~finite).sum()),
    )


def checked(folder: Path, stem: str, name: str, array: numpy.ndarray, shape: tuple[int, ...]) -> numpy.ndarray:
    if array.shape != shape:
        raise ValueError(f"{folder / stem}.{name}.npy has the shape {array.shape}, not {shape}")
    return array


def places_of(frames: numpy.ndarray, about: dict, grid_shape: tuple[int, ...], offset: int) -> numpy.ndarray:
    """(n, 15) float64: cell 3, turn 2, lowest 3, highest 3, shape 3, offset of a map's samples."""
    origin = frames[:, :3]
    same = numpy.ones((len(frames), 1))
    return numpy.concatenate(
        [
            (origin - numpy.array(about["origin"])) / about["cell_m"],
            numpy.cos(frames[:, 3:4]),
            numpy.sin(frames[:, 3:4]),
            numpy.array(about["lowest"]) - origin,
            numpy.array(about["highest"]) - origin,
            same * numpy.array(grid_shape[::-1]),
            same * offset,
        ],
        1,
    )


def as_places(values: numpy.ndarray) -> Places:
    real = torch.from_numpy(values[:, :11].astype(numpy.float32))
    whole = torch.from_numpy(values[:, 11:].astype(numpy.int64))
    return Places(
        real[:, :3].contiguous(),
        real[:, 3:5].contiguous(),
        real[:, 5:8].contiguous(),
        real[:, 8:11].contiguous(),
        whole[:, :3].contiguous(),
        whole[:, 3].contiguous(),
        torch.ones(len(values)),
    )
