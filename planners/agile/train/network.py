"""The network of the planner agile: three trajectories with a predicted cost each, from one small depth image and 22
numbers.

Its trained form, without batch normalisation and rounded to half floats, lies in a safetensors file that C++ reads as
well: eight bytes with the length of a JSON header, the header, the tensors' bytes one after another."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy
import torch
from torch import Tensor, nn

ROWS, COLUMNS = 64, 96  # of the image
INPUTS, MODES, POINTS = 22, 3, 10
MODE_OUTPUTS = 1 + 3 * POINTS  # alpha, then x, y, z of each point
FORMAT = "agile/1"
# Output channels, kernel size, stride and padding of conv1 … conv5.
CONVOLUTIONS = ((16, 5, 2, 2), (32, 3, 2, 1), (64, 3, 2, 1), (64, 3, 1, 1), (96, 3, 2, 1))
LAYERS = ("image_full", "state1", "state2", "head1", "head2", "out")


class Network(nn.Module):
    """forward(image (B, 1, 64, 96) of nearness 0 … 1, inputs (B, 22)) gives (B, 3, 31). As trained it has batch
    normalisation behind the convolutions; with batch_norm=False its convolutions have a bias instead, as in the
    file."""

    def __init__(self, batch_norm: bool = True) -> None:
        super().__init__()
        channels = 1
        rows, columns = ROWS, COLUMNS
        for i, (out, kernel, stride, padding) in enumerate(CONVOLUTIONS, 1):
            setattr(self, f"conv{i}", nn.Conv2d(channels, out, kernel, stride, padding, bias=not batch_norm))
            setattr(self, f"norm{i}", nn.BatchNorm2d(out) if batch_norm else nn.Identity())
            channels = out
            rows, columns = (rows + 2 * padding - kernel) // stride + 1, (columns + 2 * padding - kernel) // stride + 1
        self.batch_norm = batch_norm
        self.image_full = nn.Linear(channels * rows * columns, 128)
        self.state1, self.state2 = nn.Linear(INPUTS, 64), nn.Linear(64, 64)
        self.head1, self.head2 = nn.Linear(128 + 64, 256), nn.Linear(256, 256)
        self.out = nn.Linear(256, MODES * MODE_OUTPUTS)
        with torch.no_grad():
            self.out.weight.mul_(0.1)
            self.out.bias.copy_(first_guess().flatten())

    def blocks(self) -> list[tuple[nn.Module, nn.Module]]:
        """Each convolution with what follows it."""
        return [(getattr(self, f"conv{i}"), getattr(self, f"norm{i}")) for i in range(1, len(CONVOLUTIONS) + 1)]

    def forward(self, image: Tensor, inputs: Tensor) -> Tensor:
        x = image
        for convolution, norm in self.blocks():
            x = torch.relu(norm(convolution(x)))
        seen = torch.relu(self.image_full(x.contiguous().flatten(1)))
        state = torch.relu(self.state2(torch.relu(self.state1(inputs))))
        head = torch.relu(self.head2(torch.relu(self.head1(torch.cat([seen, state], 1)))))
        return self.out(head).view(-1, MODES, MODE_OUTPUTS)


def first_guess() -> Tensor:
    """(3, 31): what an untrained network says: straight on, an arc to the left and one to the right, at a cost of 1
    each. Three unlike beginnings, lest the modes learn the same."""
    modes = torch.zeros(MODES, MODE_OUTPUTS)
    modes[:, 0] = 1.0
    s = torch.arange(1, POINTS + 1) / POINTS
    for mode, aside in zip(modes, (0.0, 0.3, -0.3)):
        points = mode[1:].view(POINTS, 3)
        points[:, 0] = 0.8 * s
        points[:, 1] = aside * s * s
    return modes


def alphas_and_points(output: Tensor) -> tuple[Tensor, Tensor]:
    """(B, 3) predicted costs and (B, 3, 10, 3) points of the network's output."""
    return output[:, :, 0], output[:, :, 1:].reshape(-1, MODES, POINTS, 3)


def folded(network: Network) -> Network:
    """The same function as the trained network's in evaluation, without batch normalisation."""
    if not network.batch_norm:
        return network
    plain = Network(batch_norm=False).to(next(network.parameters()).device)
    with torch.no_grad():
        for (convolution, norm), (target, _) in zip(network.blocks(), plain.blocks()):
            scale = norm.weight.double() / torch.sqrt(norm.running_var.double() + norm.eps)
            target.weight.copy_((convolution.weight.double() * scale.view(-1, 1, 1, 1)).float())
            target.bias.copy_((norm.bias.double() - norm.running_mean.double() * scale).float())
        for name in LAYERS:
            getattr(plain, name).load_state_dict(getattr(network, name).state_dict())
    return plain.eval()


def with_batch_norm(plain: Network, images: Tensor) -> Network:
    """The reverse: a network with batch normalisation that is the same function where the images' statistics are as in
    these, to be trained on."""
    network = Network().to(images.device)
    with torch.no_grad():
        x = images
        for (convolution, norm), (source, _) in zip(network.blocks(), plain.blocks()):
            convolution.weight.copy_(source.weight)
            y = convolution(x)
            variance, mean = torch.var_mean(y.double(), (0, 2, 3), unbiased=True)
            norm.running_mean.copy_(mean)
            norm.running_var.copy_(variance)
            norm.weight.copy_(torch.sqrt(variance + norm.eps))
            norm.bias.copy_(mean + source.bias)
            x = torch.relu(y + source.bias.view(1, -1, 1, 1))
        for name in LAYERS:
            getattr(network, name).load_state_dict(getattr(plain, name).state_dict())
    return network


def rounded(network: Network) -> Network:
    """The network as the file will have it: folded, each weight the nearest half float."""
    plain = folded(network)
    with torch.no_grad():
        for name, weights in plain.named_parameters():
            half = weights.half()
            if not torch.isfinite(half).all():
                raise ValueError(f"{name} has weights that are no half floats")
            weights.copy_(half.float())
    return plain.eval()


def write_weights(file: Path, network: Network, metadata: dict[str, str]) -> None:
    """Writes the rounded network. The same weights and metadata give the same bytes."""
    header: dict[str, object] = {"__metadata__": {"format": FORMAT, **metadata}}
    data = b""
    for name, weights in rounded(network).named_parameters():
        values = weights.detach().cpu().numpy().astype("<f2").tobytes()
        header[name] = {
            "dtype": "F16",
            "shape": list(weights.shape),
            "data_offsets": [len(data), len(data) + len(values)],
        }
        data += values
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 8)
    file.write_bytes(struct.pack("<Q", len(text)) + text + data)


def read_weights(file: Path) -> tuple[Network, dict[str, str]]:
    """The network (without batch normalisation) and the metadata of a file."""
    content = file.read_bytes()
    length = struct.unpack_from("<Q", content)[0]
    header = json.loads(content[8 : 8 + length])
    metadata = header.pop("__metadata__", {})
    if metadata.get("format") != FORMAT:
        raise ValueError(f"{file}: its format is {metadata.get('format')!r}, not {FORMAT!r}")
    network = Network(batch_norm=False)
    weights = {}
    for name, entry in header.items():
        if entry["dtype"] != "F16":
            raise ValueError(f"{file}: {name} is of type {entry['dtype']}, not F16")
        first, last = entry["data_offsets"]
        values = numpy.frombuffer(content, "<f2", (last - first) // 2, 8 + length + first)
        weights[name] = torch.from_numpy(values.astype(numpy.float32).reshape(entry["shape"]))
    network.load_state_dict(weights)
    return network.eval(), metadata
