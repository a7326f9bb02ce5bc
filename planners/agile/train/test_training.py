"""Tests of the training: python -m pytest planners/agile/train/test_training.py, or python
planners/agile/train/test_training.py."""

from __future__ import annotations

import dataclasses
import json
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
import torch

sys.path.insert(0, str(Path(__file__).parent))

import check
import cost as costs
import network as networks
import recipes
import samples as sample_files
import success
import synthetic
import train

torch.set_num_threads(min(2, torch.get_num_threads()))


class WithSamples(unittest.TestCase):
    """Has two small folders of made-up samples."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        synthetic.write(cls.root / "a", maps=10, count=24, seed=1)
        synthetic.write(cls.root / "b", maps=2, count=24, seed=2)
        cls.data = sample_files.read([cls.root / "a", cls.root / "b"])
        cls.cost = costs.Cost(cls.data.grids, cls.data.cell_m)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.folder.cleanup()

    def some_points(self, count: int) -> torch.Tensor:
        """(count, 3, 10, 3) trajectories, not too smooth."""
        random = torch.Generator().manual_seed(5)
        guess = networks.first_guess()[:, 1:].view(3, 10, 3)
        return guess + 0.05 * torch.randn(count, 3, 10, 3, generator=random)


class Samples(WithSamples):
    def test_reads_folders_and_holds_out_maps(self) -> None:
        data = self.data
        self.assertEqual((len(data), data.left_out), (12 * 24, 0))
        self.assertEqual(data.grids.numel(), 12 * 80 * 60 * 20)
        training, held_out = data.split()
        self.assertEqual(set(data.map_numbers[held_out].tolist()), {9})
        self.assertEqual(len(training) + len(held_out), len(data))
        images = numpy.load(self.root / "b" / "0001.images.npy")
        batch = data.batch(torch.tensor([11 * 24 + 3]))
        self.assertTrue(torch.equal((batch.images[0, 0] * 255).round().to(torch.uint8), torch.from_numpy(images[3])))
        self.assertEqual(int(batch.places.offset[0]), 11 * 80 * 60 * 20)

    def test_leaves_out_what_is_not_finite(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            synthetic.write(Path(folder), maps=1, count=8, seed=3)
            inputs = numpy.load(Path(folder) / "0000.inputs.npy")
            inputs[2, 5] = numpy.nan
            numpy.save(Path(folder) / "0000.inputs.npy", inputs)
            data = sample_files.read([Path(folder)])
            self.assertEqual((len(data), data.left_out), (7, 1))
            training, held_out = data.split()
            self.assertTrue(torch.equal(training, held_out))

    def test_mirror_leaves_the_cost(self) -> None:
        count = 64
        batch = self.data.batch(torch.arange(count))
        which = torch.arange(count) % 3 == 0
        other = sample_files.mirrored(batch, which)
        points = self.some_points(count)
        flipped = torch.where(which.view(-1, 1, 1, 1), points * torch.tensor([1.0, -1.0, 1.0]), points)
        one, two = self.cost(points, batch.inputs, batch.places), self.cost(flipped, other.inputs, other.places)
        for name in one.parts:
            torch.testing.assert_close(one.parts[name], two.parts[name], rtol=1e-4, atol=1e-4)
        torch.testing.assert_close(one.clearance_m, two.clearance_m, rtol=0, atol=1e-5)
        torch.testing.assert_close(
            recipes.label_error(one.points, batch.labels), recipes.label_error(two.points, other.labels)
        )
        for field in ("images", "inputs", "labels"):  # twice is not at all
            again = sample_files.mirrored(other, which)
            self.assertTrue(torch.equal(getattr(again, field), getattr(batch, field)))
        self.assertTrue(torch.equal(other.images[0, 0, :, 0], batch.images[0, 0, :, 95]))
        self.assertEqual(float(other.inputs[0, 20]), float(batch.inputs[0, 21]))
        self.assertTrue(torch.equal(other.inputs[1], batch.inputs[1]))

    def test_mirror_is_what_a_mirrored_world_gives(self) -> None:
        random = numpy.random.default_rng(6)
        poles = numpy.concatenate([random.uniform([1, -4], [9, 4], (6, 2)), random.uniform(0.15, 0.6, (6, 1))], 1)
        origin, yaw = numpy.array([0.0, 0.2, 1.5]), 0.15
        seen = synthetic.image(origin, yaw, poles)
        in_mirror = synthetic.image(origin * [1, -1, 1], -yaw, poles * [1, -1, 1])
        self.assertTrue(numpy.array_equal(in_mirror, seen[:, ::-1]))
        self.assertFalse(numpy.array_equal(in_mirror, seen))
        # The y of vectors, the x of "up" (camera: right, down, ahead), and the two sides.
        batch = self.data.batch(torch.arange(1))
        batch.inputs[0] = torch.arange(1, 23)
        expected = [1, -2, 3, 4, -5, 6, 7, -8, 9, -10, 11, 12, 13, -14, 15, 16, 17, 18, 19, 20, 22, 21]
        self.assertEqual(sample_files.mirrored(batch, torch.tensor([True])).inputs[0].tolist(), expected)


class CostOfTrajectories(WithSamples):
    def test_projection_keeps_polynomials(self) -> None:
        random = numpy.random.default_rng(1)
        coefficients = random.normal(0, 0.5, (4, 3, 5))  # of s … s⁵, by sample and axis
        inputs = torch.from_numpy(random.normal(0, 1, (4, 22)))
        inputs[:, 16] = torch.tensor([0.3, 0.5, 0.8, 1.0])
        v_des = 5.0 * inputs[:, 16:17].numpy()
        inputs[:, 3:6] = torch.from_numpy(coefficients[:, :, 0])
        inputs[:, 6:9] = torch.from_numpy(coefficients[:, :, 1] * 2 * v_des / costs.HORIZON_S / 10.0)

        def values(times: numpy.ndarray, derivative: int) -> numpy.ndarray:
            polynomials = [
                [numpy.polynomial.Polynomial([0, *axis]).deriv(derivative)(times) for axis in axes]
                for axes in coefficients
            ]
            return numpy.array(polynomials).transpose(0, 2, 1)

        points = torch.from_numpy(values(numpy.arange(1, 11) / 10, 0)).unsqueeze(1)
        self.cost.projection, kept = torch.from_numpy(costs.projection_matrix()), self.cost.projection
        found = self.cost.project(points, inputs)
        self.cost.projection = kept
        for derivative in range(4):
            numpy.testing.assert_allclose(
                found[derivative, :, 0].numpy(), values(numpy.arange(1, 21) / 20, derivative), atol=1e-9
            )
        # In float32 as it is used.
        found = self.cost.project(points.float(), inputs.float())
        numpy.testing.assert_allclose(found[3, :, 0].numpy(), values(numpy.arange(1, 21) / 20, 3), atol=0.05)

    def test_lookup_is_trilinear(self) -> None:
        random = numpy.random.default_rng(2)
        shapes = [(3, 5, 4), (1, 6, 2), (7, 4, 9)]  # z, y, x
        grids = [random.integers(0, 256, shape, numpy.uint8) for shape in shapes]
        cost = costs.Cost(torch.from_numpy(numpy.concatenate([grid.ravel() for grid in grids])), 0.2)
        offsets = numpy.cumsum([0] + [grid.size for grid in grids])[:3]
        shape = torch.tensor([s[::-1] for s in shapes])
        places = costs.Places(
            torch.zeros(3, 3),
            torch.zeros(3, 2),
            torch.zeros(3, 3),
            torch.zeros(3, 3),
            shape,
            torch.from_numpy(offsets),
            torch.ones(3),
        )
        cells = random.uniform(-1.5, 1.5, (3, 200, 3)) + random.uniform(0, 1, (3, 200, 3)) * shape.numpy()[:, None]
        cells[:, :8] = numpy.round(cells[:, :8])
        found = cost.surface_distance(torch.from_numpy(cells), places).numpy()
        for m, grid in enumerate(grids):
            for k, cell in enumerate(cells[m]):
                cell = numpy.clip(cell, 0, shape[m].numpy() - 1)
                low = numpy.floor(cell).astype(int)
                expected = 0.0
                for corner in numpy.ndindex(2, 2, 2):
                    weight = numpy.prod(numpy.where(corner, cell - low, 1 - (cell - low)))
                    if weight > 0:
                        x, y, z = low + corner
                        expected += weight * grid[z, y, x]
                self.assertAlmostEqual(found[m, k], expected * 0.01 - 0.5, places=9)

    def test_clearance_is_that_of_the_map(self) -> None:
        """Against the formula that made the map: the grid's error of a few cm is all that is left."""
        batch = self.data.batch(torch.arange(24))
        frames = numpy.load(self.root / "a" / "0000.frames.npy")
        random = numpy.random.default_rng(4)
        points = random.uniform([0, -2, -0.5], [3, 2, 0.5], (24, 50, 3))
        cosine, sine = numpy.cos(frames[:, 3:4]), numpy.sin(frames[:, 3:4])
        world = frames[:, None, :3] + numpy.stack(
            [
                cosine * points[..., 0] - sine * points[..., 1],
                sine * points[..., 0] + cosine * points[..., 1],
                points[..., 2],
            ],
            -1,
        )
        poles = synthetic.poles_of(numpy.random.default_rng([1, 0]))
        inside = numpy.minimum((world - synthetic.LOWEST)[..., :2].min(-1), (synthetic.HIGHEST - world).min(-1))
        expected = numpy.minimum(synthetic.clearance(world, poles), inside)
        found = self.cost.clearance(torch.from_numpy(points), batch.places).numpy()
        compared = (expected > -0.3) & (expected < 1.8)
        self.assertGreater(compared.sum(), 500)
        self.assertLess(abs(found - expected)[compared].max(), 0.15)
        self.assertLess(numpy.median(abs(found - expected)[compared]), 0.02)

    def test_parts_by_hand(self) -> None:
        distances = torch.tensor([1.5, 0.9, 0.65, 0.4, 0.2, 0.0, -0.1], dtype=torch.float64)
        torch.testing.assert_close(
            costs.collision_cost(distances), torch.tensor([0, 0, 0.375, 1.0, 3.25, 4.0, 4.8], dtype=torch.float64)
        )
        # Flight straight on at v_des: no cost but that the goal is to the left for the second.
        inputs = torch.zeros(2, 22)
        inputs[:, 3], inputs[:, 16] = 1.0, 0.6
        inputs[0, 12], inputs[1, 13] = 1.0, 1.0
        places = costs.Places(
            torch.zeros(2, 3),
            torch.tensor([[1.0, 0.0]] * 2),
            torch.full((2, 3), -50.0),
            torch.full((2, 3), 50.0),
            torch.ones(2, 3, dtype=torch.int64),
            torch.zeros(2, dtype=torch.int64),
            torch.ones(2),
        )
        free = costs.Cost(torch.full((1,), 255, dtype=torch.uint8), 0.2)
        points = torch.zeros(2, 1, 10, 3)
        points[..., 0] = torch.arange(1, 11) / 10
        found = free(points, inputs, places)
        torch.testing.assert_close(found.total[:, 0], torch.tensor([0.0, 3.25**0.5 - 0.5]), atol=1e-4, rtol=0)

    def test_gradient_by_differences(self) -> None:
        batch = self.data.batch(torch.arange(0, 240, 10))
        inputs = batch.inputs.double()
        points = self.some_points(24).double().requires_grad_()
        (gradient,) = torch.autograd.grad(self.cost(points, inputs, batch.places).total.sum(), points)
        self.assertTrue(torch.isfinite(gradient).all())
        random = torch.Generator().manual_seed(7)
        agree = []
        for _ in range(20):
            # At kinks (cells' sides, limits) differences are wrong; of a few directions almost all must agree.
            direction = torch.randn(points.shape, generator=random, dtype=torch.float64) * 1e-6
            with torch.no_grad():
                up, down = (self.cost(points + sign * direction, inputs, batch.places).total for sign in (1, -1))
            difference, slope = up - down, 2 * (gradient * direction).sum((2, 3))
            agree.append((difference - slope).abs() <= 1e-3 * slope.abs() + 1e-8)
        self.assertGreater(float(torch.stack(agree).float().mean()), 0.99)

    def test_is_finite_where_nothing_moves(self) -> None:
        batch = self.data.batch(torch.arange(4))
        inputs = batch.inputs.clone()
        inputs[:, 3:9] = 0
        inputs[:, 12:16] = torch.tensor([1.0, 0.0, 0.0, 0.0])
        points = torch.zeros(4, 3, 10, 3, requires_grad=True)
        total = self.cost(points, inputs, batch.places).total
        total.sum().backward()
        self.assertTrue(torch.isfinite(total).all() and torch.isfinite(points.grad).all())


class NetworkFile(unittest.TestCase):
    def trained_network(self) -> networks.Network:
        """With statistics and weights unlike those of the beginning."""
        torch.manual_seed(3)
        network = networks.Network()
        for _, norm in network.blocks():
            torch.nn.init.uniform_(norm.weight, 0.5, 1.5)
            torch.nn.init.normal_(norm.bias, 0.0, 0.2)
        torch.nn.init.normal_(network.out.weight, 0.0, 0.1)
        for _ in range(10):
            network(torch.rand(16, 1, 64, 96), torch.randn(16, 22))
        return network.eval()

    @torch.no_grad()
    def test_folding_and_unfolding(self) -> None:
        network = self.trained_network()
        images, inputs = torch.rand(32, 1, 64, 96), torch.randn(32, 22)
        plain = networks.folded(network)
        torch.testing.assert_close(plain(images, inputs), network(images, inputs), atol=1e-5, rtol=1e-5)
        again = networks.with_batch_norm(plain, images)
        torch.testing.assert_close(again.eval()(images, inputs), plain(images, inputs), atol=1e-4, rtol=1e-4)
        # In training it has the batch's own statistics, which here are the same but for n against n - 1.
        torch.testing.assert_close(again.train()(images, inputs), plain(images, inputs), atol=1e-3, rtol=1e-3)

    @torch.no_grad()
    def test_first_guess(self) -> None:
        alphas, points = networks.alphas_and_points(
            networks.Network().eval()(torch.rand(2, 1, 64, 96), torch.randn(2, 22))
        )
        self.assertLess(float((alphas - 1.0).abs().max()), 0.2)
        torch.testing.assert_close(
            points[0, :, 9], torch.tensor([[0.8, 0.0, 0.0], [0.8, 0.3, 0.0], [0.8, -0.3, 0.0]]), atol=0.2, rtol=0
        )

    @torch.no_grad()
    def test_file_round_trip(self) -> None:
        network = self.trained_network()
        images, inputs = torch.rand(4, 1, 64, 96), torch.randn(4, 22)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.safetensors"
            networks.write_weights(file, network, {"recipe": "none"})
            read, metadata = networks.read_weights(file)
            self.assertEqual(metadata, {"format": "agile/1", "recipe": "none"})
            torch.testing.assert_close(read(images, inputs), networks.rounded(network)(images, inputs), atol=0, rtol=0)
            torch.testing.assert_close(read(images, inputs), network(images, inputs), atol=0.05, rtol=0.01)
            other = Path(folder) / "b.safetensors"
            networks.write_weights(other, read, metadata)
            self.assertEqual(file.read_bytes(), other.read_bytes())
            length = int.from_bytes(file.read_bytes()[:8], "little")
            header = json.loads(file.read_bytes()[8 : 8 + length])
            self.assertEqual(length % 8, 0)
            self.assertEqual(header["conv1.weight"], {"dtype": "F16", "shape": [16, 1, 5, 5], "data_offsets": [0, 800]})
            self.assertEqual(header["image_full.weight"]["shape"], [128, 2304])
            self.assertEqual(
                8 + length + max(entry["data_offsets"][1] for name, entry in header.items() if name != "__metadata__"),
                file.stat().st_size,
            )
            vector = check.vector(file)
            self.assertEqual((len(vector["inputs"]), len(vector["outputs"])), (22, 93))
            broken = file.read_bytes().replace(b"agile/1", b"agile/9")
            other.write_bytes(broken)
            with self.assertRaises(ValueError):
                networks.read_weights(other)


class Recipes(unittest.TestCase):
    def test_label_error_by_hand(self) -> None:
        points, labels = torch.zeros(1, 3, 10, 3), torch.zeros(1, 3, 10, 3)
        points[0, 1], points[0, 2] = 1.0, 5.0
        labels[0, 0], labels[0, 1], labels[0, 2] = 0.1, 0.8, 0.3  # nearest to the modes 0, 1, 0; mode 2 is idle
        expected = (0.95 * (0.01 + 0.04 + 0.09) + 0.05 / 2 * 4.9**2) / 3
        self.assertAlmostEqual(float(recipes.label_error(points, labels)), expected, places=5)


class WholeTraining(WithSamples):
    def run_training(self, name: str, *more: str) -> train.Training:
        return train.main(
            [
                "--samples",
                str(self.root / "a"),
                str(self.root / "b"),
                "--out",
                str(self.root / name),
                "--batch",
                "32",
                "--threads",
                "2",
                "--cpu",
                *more,
            ]
        )

    def test_learns_and_goes_on(self) -> None:
        picture, log = self.root / "curves.png", self.root / "log.json"
        training = self.run_training("a.safetensors", "--steps", "60", "--plot", str(picture), "--log", str(log))
        self.assertLess(sum(training.losses[-10:]), 0.6 * sum(training.losses[:10]))
        self.assertLess(training.expert["greatest_cost_difference"], 0.01)
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))
        written = json.loads(log.read_text())
        network, metadata = networks.read_weights(self.root / "a.safetensors")
        self.assertEqual(
            (metadata["recipe"], metadata["steps"], metadata["seed"], metadata["samples"]),
            ("imitation", "60", "1", "264"),
        )
        self.assertEqual(metadata["validation_best_cost"], f"{written['validation']['best_cost']:.5f}")
        batches = train.batches_of(training.data, training.held_out)
        self.assertAlmostEqual(
            recipes.validate(network, batches, training.cost)["best_cost"], written["validation"]["best_cost"], places=4
        )
        # A second round begins where the first ended.
        further = self.run_training("b.safetensors", "--steps", "20", "--init", str(self.root / "a.safetensors"))
        self.assertLess(sum(further.losses[:5]) / 5, 1.5 * sum(training.losses[-5:]) / 5)

    def test_descends(self) -> None:
        training = self.run_training("c.safetensors", "--recipe", "descent", "--steps", "40")
        costs_seen = [row["validation"]["best_cost"] for row in training.rows if "validation" in row]
        self.assertLess(costs_seen[-1], 0.8 * costs_seen[0])

    def test_seed_gives_the_losses(self) -> None:
        one, two, other = (
            self.run_training("d.safetensors", "--steps", "5", "--seed", seed) for seed in ("4", "4", "5")
        )
        self.assertEqual(one.losses, two.losses)
        self.assertNotEqual(one.losses, other.losses)

    def test_keeps_weights_on_the_way(self) -> None:
        self.run_training("f.safetensors", "--steps", "9", "--snapshots", "3")
        steps = {file.name: networks.read_weights(file)[1]["steps"] for file in self.root.glob("f*.safetensors")}
        self.assertEqual(steps, {"f_1of3.safetensors": "3", "f_2of3.safetensors": "6", "f.safetensors": "9"})
        # They have no part in the training.
        self.run_training("g.safetensors", "--steps", "9")
        self.assertTrue(
            all(
                torch.equal(a, b)
                for a, b in zip(
                    *(networks.read_weights(self.root / f"{name}.safetensors")[0].parameters() for name in "fg")
                )
            )
        )

    def test_success_is_drawn(self) -> None:
        for end in success.wilson(45, 50):  # where 0.9 lies 1.96 standard deviations from the rate
            self.assertAlmostEqual(abs(0.9 - end) / (end * (1.0 - end) / 50) ** 0.5, 1.95996, places=4)
        for name, ends in (("x_1of2", {"flights": 4, "collided": 4}), ("x", {"flights": 4, "reached_goal": 4})):
            (self.root / f"{name}_flights.json").write_text(json.dumps(ends))
        success.main(
            [
                "--plot",
                str(self.root / "success.png"),
                str(self.root / "x_1of2_flights.json"),
                str(self.root / "x_flights.json"),
            ]
        )
        self.assertTrue((self.root / "success.png").read_bytes().startswith(b"\x89PNG"))

    def test_stops_at_the_time_limit_and_skips_what_is_not_finite(self) -> None:
        training = self.run_training("e.safetensors", "--minutes", "0.02")
        self.assertLess(training.clock.seconds(), 10.0)
        self.assertEqual(training.bad_steps, 0)
        before = [parameter.clone() for parameter in training.network.parameters()]
        training.data = dataclasses.replace(training.data, labels=training.data.labels * float("nan"))
        self.assertEqual(training.one_step(0.5)[0], {})
        self.assertEqual(training.bad_steps, 1)
        self.assertTrue(all(torch.equal(a, b) for a, b in zip(before, training.network.parameters())))


if __name__ == "__main__":
    unittest.main()
