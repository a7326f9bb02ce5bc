#!/usr/bin/env python3
"""check_clouds.py --program AVOIDBENCH: maps of LAS files that laspy wrote, and of OctoMap files that this script
writes from the format's description, against the same points as PLY. Exits with 77 where laspy is missing.
"""

import argparse
import csv
import io
import itertools
import random
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import laspy
    import numpy as np
except ImportError:
    sys.exit(77)

UTM = (512345.0, 5412345.0, 431.0)
FORMATS = {"1.2": (0, 1, 2, 3), "1.3": (4, 5), "1.4": (1, 3, 6, 7, 8, 9, 10)}
SWEEP = """sweep: cloud
planners: [straight_line]
maps:
  generator: point_cloud
  file: {file}
  resolution_m: {resolution}
  bounds: {{lowest_m: [0, 0, 0], highest_m: [20, 20, 5]}}
  origin_m: {origin}
  seeds: [1]
"""


def write_ply(file, points):
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    header += "".join(f"property double {axis}\n" for axis in "xyz") + "end_header\n"
    file.write_bytes(header.encode() + np.ascontiguousarray(points, "<f8").tobytes())


def write_las(file, points, version, point_format, withheld):
    """Writes the points with an attribute more, then withheld ones; returns what the points are rounded to."""
    header = laspy.LasHeader(version=version, point_format=point_format)
    header.add_extra_dim(laspy.ExtraBytesParams("reflectance", np.float32))
    header.offsets, header.scales = UTM, (0.001, 0.001, 0.002)
    header.vlrs.append(laspy.VLR("avoidbench", 7, "test", bytes(point_format)))
    las = laspy.LasData(header)
    everything = np.vstack([points, withheld])
    las.x, las.y, las.z = everything.T
    las.withheld = np.arange(len(everything)) >= len(points)
    las.synthetic = np.arange(len(everything)) % 3 == 0
    las.classification = np.full(len(everything), 5)
    las.write(file)
    read = laspy.read(file)
    return np.column_stack([read.x, read.y, read.z])[: len(points)]


class Octree:
    """An OctoMap tree of 16 levels as nested lists: a node has 8 children, each None, "free", "occupied" or a node."""

    def __init__(self, resolution):
        self.resolution, self.root = resolution, [None] * 8

    def set(self, key, value):
        node = self.root
        for bit in range(15, -1, -1):
            child = sum((key[axis] >> bit & 1) << axis for axis in range(3))
            if bit == 0:
                node[child] = value
            elif node[child] is None:
                node[child] = [None] * 8
            node = node[child]

    def prune(self, node):
        """Makes a leaf of nodes whose 8 children are equal leaves, as OctoMap does."""
        for i, child in enumerate(node):
            if isinstance(child, list):
                self.prune(child)
                if child[0] in ("free", "occupied") and all(c == child[0] for c in child):
                    node[i] = child[0]

    def count(self, node):
        return 1 + sum(self.count(c) if isinstance(c, list) else c is not None for c in node)

    def encode(self, node):
        bits = 0
        for i, child in enumerate(node):
            bits |= (0 if child is None else 1 if child == "free" else 2 if child == "occupied" else 3) << 2 * i
        return struct.pack("<H", bits) + b"".join(self.encode(c) for c in node if isinstance(c, list))

    def write(self, file):
        text = f"# Octomap OcTree binary file\n#\nid OcTree\nsize {self.count(self.root)}\n"
        text += f"res {self.resolution}\ndata\n"
        file.write_bytes(text.encode() + self.encode(self.root))


def octree_of(points, resolution, is_pruned):
    """The tree of the voxels that hold a point, with free space around some; and the voxels' centres."""
    tree = Octree(resolution)
    keys = {tuple(int(np.floor(c / resolution)) + 32768 for c in p) for p in points}
    # A block that is pruned to leaves of several sizes.
    keys |= {(32776 + x, 32776 + y, 32776 + z) for x, y, z in itertools.product(range(13), range(9), range(8))}
    for key in sorted(keys):
        tree.set((key[0], key[1], key[2] + 1), "free")
    for key in sorted(keys):
        tree.set(key, "occupied")
    if is_pruned:
        tree.prune(tree.root)
    return tree, (np.array(sorted(keys)) - 32768 + 0.5) * resolution


def map_info(program, file, resolution, origin):
    """What `maps info` says of the map, without the file's own lines."""
    sweep = file.with_suffix(file.suffix + ".yaml")
    sweep.write_text(SWEEP.format(file=file.name, resolution=resolution, origin=list(origin)))
    command = [program, "maps", "info", sweep, "--format", "csv"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{file.name}: {run.stderr}")
    return {row[0]: row[1:] for row in csv.reader(io.StringIO(run.stdout)) if row}


def expect_equal(name, found, expected):
    if "digest" not in expected:
        sys.exit("maps info gives no digest")
    for key, value in expected.items():
        if found.get(key) != value:
            sys.exit(f"{name}: {key}: {found.get(key)}, expected {value}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True, type=Path)
    program = parser.parse_args().program
    draws = random.Random(7)
    points = np.array([[draws.uniform(0, 20), draws.uniform(0, 20), draws.uniform(0, 5)] for _ in range(800)])
    withheld = np.array([[10.0, y / 10, z / 2] for y in range(200) for z in range(10)])  # a wall
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        expected = None
        for version, formats in FORMATS.items():
            for point_format in formats:
                las = folder / f"v{version[2]}_{point_format}.las"
                rounded = write_las(las, points + UTM, version, point_format, withheld + UTM)
                if expected is None:
                    write_ply(folder / "las.ply", rounded)
                    expected = map_info(program, folder / "las.ply", 0.4, UTM)
                expect_equal(las.name, map_info(program, las, 0.4, UTM), expected)
        for resolution in (0.2, 0.25):
            whole, pruned, ply = (folder / f"{resolution}{name}" for name in (".bt", "_pruned.bt", ".ply"))
            for file in (whole, pruned):
                tree, centres = octree_of(points, resolution, is_pruned=file == pruned)
                tree.write(file)
            write_ply(ply, centres)
            for side in (resolution, 2 * resolution):
                expected = map_info(program, ply, side, (0, 0, 0))
                for file in (whole, pruned):
                    expect_equal(file.name, map_info(program, file, side, (0, 0, 0)), expected)
            if pruned.stat().st_size >= whole.stat().st_size:
                sys.exit("nothing was pruned")


if __name__ == "__main__":
    main()
