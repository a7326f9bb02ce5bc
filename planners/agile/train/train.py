#!/usr/bin/env python3
"""Trains the network of the planner agile on what agile_samples wrote.

    python train.py --recipe imitation --minutes 40 --samples build/agile/round0 --out agile.safetensors --plot
    curves.png --log log.json

--init goes on from weights, for a further round of samples. A training ends after --minutes or after --steps, whichever
comes first. With
--steps alone the same options give the same weights on the same machine with the same number of threads.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import time
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_WAIT_POLICY", "passive")  # of use where other programs share the processor

import curves
import recipes
import samples as sample_files
import torch
from cost import Cost
from network import Network, read_weights, rounded, with_batch_norm, write_weights
from samples import Batch, Samples

RATE, RATE_AFTER_INIT, LAST_RATE_SHARE, WEIGHT_DECAY, GRADIENT_LIMIT = 1.5e-3, 5e-4, 0.02, 1e-4, 1.0
WARM_UP_STEPS, WARM_UP_SHARE = 200, 0.05  # whichever ends first
LINE_S, VALIDATIONS, VALIDATION_SAMPLES, VALIDATION_BATCH = 10.0, 20, 2048, 256
MOST_BAD_STEPS = 50  # with no finite loss, one after another


class Order:
    """Batches of indices, each sample once an epoch, in an order that a seed gives; with each a draw of which are
    mirrored."""

    def __init__(self, indices: torch.Tensor, size: int, seed: int) -> None:
        self.random = torch.Generator().manual_seed(seed)
        self.indices, self.size = indices, min(size, len(indices))
        self.left = torch.empty(0, dtype=torch.int64)

    def take(self) -> tuple[torch.Tensor, torch.Tensor]:
        if len(self.left) < self.size:
            self.left = torch.randperm(len(self.indices), generator=self.random)
        chosen, self.left = self.left[: self.size], self.left[self.size :]
        which = torch.rand(self.size, generator=self.random) < 0.5
        return self.indices[chosen.to(self.indices.device)], which.to(self.indices.device)


class Clock:
    """How much of the training is done, 0 … 1."""

    def __init__(self, started: float, minutes: float | None, steps: int | None) -> None:
        self.started, self.limit_s, self.steps = started, minutes * 60.0 if minutes else None, steps

    def seconds(self) -> float:
        return time.monotonic() - self.started

    def progress(self, step: int) -> float:
        by_time = self.seconds() / self.limit_s if self.limit_s else 0.0
        return min(1.0, max(by_time, step / self.steps if self.steps else 0.0))


def learning_rate(greatest: float, step: int, progress: float) -> float:
    """Rises for some steps, then falls along a cosine."""
    warm = min(1.0, max((step + 1) / WARM_UP_STEPS, progress / WARM_UP_SHARE))
    return greatest * warm * (LAST_RATE_SHARE + (1.0 - LAST_RATE_SHARE) * 0.5 * (1.0 + math.cos(math.pi * progress)))


def batches_of(data: Samples, indices: torch.Tensor) -> list[Batch]:
    """Batches for validation."""
    return [data.batch(part) for part in indices.split(VALIDATION_BATCH)]


def few_of(indices: torch.Tensor) -> torch.Tensor:
    """VALIDATION_SAMPLES of the indices or fewer, spread over all of them."""
    if len(indices) <= VALIDATION_SAMPLES:
        return indices
    return indices[
        torch.linspace(0, len(indices) - 1, VALIDATION_SAMPLES, dtype=torch.float64).long().to(indices.device)
    ]


def text_of(values: dict[str, float]) -> str:
    return (
        f"labels {values['label_error']:.5f}  J chosen {values['chosen_cost']:.3f} best {values['best_cost']:.3f}  "
        f"collision chosen "
        f"{100 * values['chosen_collision']:.1f} % best {100 * values['best_collision']:.1f} %  alpha "
        f"{values['alpha_error']:.4f}"
    )


class Training:
    """A training under way."""

    def __init__(self, options: argparse.Namespace, started: float) -> None:
        self.options = options
        self.device = torch.device("cuda" if torch.cuda.is_available() and not options.cpu else "cpu")
        self.data = sample_files.read(options.samples).to(self.device)
        self.training, self.held_out = self.data.split()
        self.cost = Cost(self.data.grids, self.data.cell_m)
        self.network = self.first_network().to(memory_format=torch.channels_last).train()
        self.order = Order(self.training, options.batch, options.seed)
        self.greatest_rate = options.rate or (RATE_AFTER_INIT if options.init else RATE)
        self.optimizer = torch.optim.AdamW(self.network.parameters(), lr=self.greatest_rate, weight_decay=WEIGHT_DECAY)
        self.clock = Clock(started, options.minutes, options.steps)
        self.rows: list[dict[str, Any]] = []
        self.losses: list[float] = []  # of the first steps, for tests
        self.step = self.bad_steps = self.bad_in_turn = self.snapshots = 0
        held_out_costs = self.data.label_costs[self.held_out]
        self.expert = recipes.expert(batches_of(self.data, few_of(self.held_out)), few_of(held_out_costs), self.cost)

    def first_network(self) -> Network:
        if not self.options.init:
            return Network().to(self.device)
        plain, _ = read_weights(self.options.init)
        some = self.training[torch.randperm(len(self.training))[:1024].to(self.device)]
        return with_batch_norm(plain.to(self.device), self.data.batch(some).images)

    def describe(self) -> None:
        data, options = self.data, self.options
        print(
            f"{len(data)} samples of {len(data.map_numbers.unique())} map numbers ({data.left_out} left out, not "
            f"finite); "
            f"{len(self.training)} for training, {len(self.held_out)} held out; grids {data.grids.numel() / 1e6:.0f} MB"
        )
        print(
            f"recipe {options.recipe}, seed {options.seed}, batch {self.order.size}, {self.device}, "
            f"{torch.get_num_threads()} threads, "
            f"torch {torch.__version__}"
        )
        print(
            f"expert on held-out maps: J {self.expert['best_cost']:.3f}, in collision "
            f"{100 * self.expert['best_collision']:.1f} %; its "
            f"costs differ from these by {self.expert['median_cost_difference']:.4f} in the median, by "
            f"{self.expert['greatest_cost_difference']:.4f} at most",
            flush=True,
        )
        if self.expert["median_cost_difference"] > 0.02:
            print("warning: the expert's cost and this one disagree", file=sys.stderr)

    def one_step(self, progress: float) -> tuple[dict[str, torch.Tensor], float]:
        indices, which = self.order.take()
        batch = sample_files.mirrored(self.data.batch(indices), which)
        rate = learning_rate(self.greatest_rate, self.step, progress)
        for group in self.optimizer.param_groups:
            group["lr"] = rate
        label_share = 0.0 if self.options.init else max(0.0, 1.0 - progress / recipes.BEGINNING)
        output = self.network(batch.images.contiguous(memory_format=torch.channels_last), batch.inputs)
        loss, figures = recipes.loss(self.options.recipe, output, batch, self.cost, label_share)
        self.optimizer.zero_grad(set_to_none=True)
        loss.backward()
        size = torch.nn.utils.clip_grad_norm_(self.network.parameters(), GRADIENT_LIMIT)
        value = float(loss.detach())
        if math.isfinite(value) and bool(torch.isfinite(size)):
            self.optimizer.step()
            self.bad_in_turn = 0
        else:
            self.bad_steps, self.bad_in_turn, figures = self.bad_steps + 1, self.bad_in_turn + 1, {}
            if self.bad_in_turn > MOST_BAD_STEPS:
                raise ArithmeticError(f"no finite loss or gradient in {self.bad_in_turn} steps one after another")
        if len(self.losses) < 100:
            self.losses.append(value)
        self.step += 1
        return ({**figures, "loss": loss.detach()} if figures else {}), rate

    def run(self) -> None:
        few = few_of(self.held_out)
        means, next_line, next_validation = recipes.Means(), self.clock.seconds() + LINE_S, 0.0
        while (progress := self.clock.progress(self.step)) < 1.0:
            self.keep_snapshot(progress)
            figures, rate = self.one_step(progress)
            if figures:
                means.add(figures, self.order.size)
            row: dict[str, Any] = {}
            if (self.clock.seconds() >= next_line or progress >= next_validation and self.step > 1) and means.count:
                row["training"] = {**means.take(), "rate": rate}
                next_line = self.clock.seconds() + LINE_S
            if progress >= next_validation and self.step > 1:
                row["validation"] = recipes.validate(self.network, batches_of(self.data, few), self.cost)
                next_validation = (math.floor(progress * VALIDATIONS) + 1) / VALIDATIONS
            if row:
                self.rows.append({"seconds": round(self.clock.seconds(), 1), "step": self.step, **row})
                self.print_row(progress, row)

    def keep_snapshot(self, progress: float) -> None:
        """Writes the weights after each of the training's parts but the last, whose weights are the training's own."""
        options = self.options
        if self.snapshots + 1 < options.snapshots and progress >= (self.snapshots + 1) / options.snapshots:
            self.snapshots += 1
            options.out.parent.mkdir(parents=True, exist_ok=True)
            file = options.out.with_name(f"{options.out.stem}_{self.snapshots}of{options.snapshots}.safetensors")
            write_weights(file, self.network, {"seed": str(options.seed), "steps": str(self.step)})

    def print_row(self, progress: float, row: dict[str, Any]) -> None:
        start = f"{100 * progress:3.0f} %  {self.clock.seconds():5.0f} s  step {self.step}"
        for part, values in row.items():
            print(f"{start}  {part:10}  {text_of(values)}", flush=True)

    def finish(self) -> dict[str, float]:
        """Judges the rounded weights on all held-out samples, writes them, the log and the curves."""
        options = self.options
        minutes = self.clock.seconds() / 60.0
        final = rounded(self.network)
        found = recipes.validate(final, batches_of(self.data, self.held_out), self.cost)
        print(f"weights as written, held-out maps: {text_of(found)}")
        metadata = {
            "recipe": options.recipe,
            "seed": str(options.seed),
            "steps": str(self.step),
            "batch": str(self.order.size),
            "minutes": f"{minutes:.1f}",
            "samples": str(len(self.training)),
            "held_out_samples": str(len(self.held_out)),
            "device": self.device.type,
            "torch": torch.__version__,
            **{f"validation_{name}": f"{value:.5f}" for name, value in found.items()},
        }
        if options.init:
            metadata["init"] = options.init.name
        options.out.parent.mkdir(parents=True, exist_ok=True)
        write_weights(options.out, final, metadata)
        self.rows.append({"seconds": round(self.clock.seconds(), 1), "step": self.step, "validation": found})
        if options.log:
            log = {
                **metadata,
                "steps_without_finite_loss": self.bad_steps,
                "samples_left_out": self.data.left_out,
                "expert": self.expert,
                "validation": found,
                "rows": self.rows,
            }
            options.log.write_text(json.dumps(log, indent=1) + "\n")
        if options.plot:
            curves.draw(
                self.rows,
                self.expert,
                f"{options.recipe}, {len(self.training)} samples, {self.step} steps, {minutes:.1f} min",
                options.plot,
            )
        return found


def arguments(given: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Trains the network of the planner agile.")
    parser.add_argument("--recipe", choices=recipes.RECIPES, default="imitation")
    parser.add_argument("--minutes", type=float, help="wall time, reading the samples included")
    parser.add_argument("--steps", type=int, help="steps of the optimizer")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=Path, nargs="+", required=True, metavar="DIR")
    parser.add_argument("--init", type=Path, metavar="FILE", help="weights to go on from")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE", help="where the weights go")
    parser.add_argument(
        "--snapshots", type=int, default=1, metavar="N", help="also write the weights after each N-th of the training"
    )
    parser.add_argument("--plot", type=Path, metavar="PNG", help="where the curves go")
    parser.add_argument("--log", type=Path, metavar="JSON", help="where the figures go")
    parser.add_argument("--batch", type=int, default=64)
    parser.add_argument("--rate", type=float, help=f"greatest learning rate ({RATE}; with --init {RATE_AFTER_INIT})")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--cpu", action="store_true", help="no GPU, even where there is one")
    options = parser.parse_args(given)
    if not options.minutes and not options.steps:
        parser.error("--minutes or --steps is needed")
    return options


def main(given: list[str] | None = None) -> Training:
    started = time.monotonic()
    options = arguments(given)
    torch.manual_seed(options.seed)
    torch.set_num_threads(options.threads)
    torch.set_flush_denormal(True)
    training = Training(options, started)
    training.describe()
    training.run()
    training.finish()
    return training


if __name__ == "__main__":
    main()
