#!/usr/bin/env python3
"""Makes the maps of maps/: courtyard.glb and thicket.pcd. Needs only Python.

usage: scripts/make_maps.py [FOLDER]      (default: maps/ of this repository)
"""

import json
import math
import pathlib
import random
import struct
import sys

MATERIALS = ["concrete", "brick", "soil", "leaf", "bark", "painted_metal"]


class Glb:
    """A glTF scene, y up. Positions are given z up, as the program has them."""

    def __init__(self):
        self.json = {
            "asset": {"version": "2.0", "generator": "avoidbench scripts/make_maps.py"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
            "materials": [{"name": name} for name in MATERIALS],
        }
        self.bytes = b""

    def _accessor(self, data, count, component, kind, **limits):
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.json["accessors"].append(
            {
                "bufferView": len(self.json["bufferViews"]) - 1,
                "componentType": component,
                "count": count,
                "type": kind,
                **limits,
            }
        )
        self.bytes += data + b"\0" * (-len(data) % 4)
        return len(self.json["accessors"]) - 1

    def mesh(self, name, vertices, triangles, material):
        turned = [(x, z, -y) for x, y, z in vertices]
        columns = list(zip(*turned))
        positions = self._accessor(
            b"".join(struct.pack("<3f", *v) for v in turned),
            len(turned),
            5126,
            "VEC3",
            min=[min(c) for c in columns],
            max=[max(c) for c in columns],
        )
        indices = self._accessor(
            b"".join(struct.pack("<3H", *t) for t in triangles), 3 * len(triangles), 5123, "SCALAR"
        )
        primitive = {"attributes": {"POSITION": positions}, "indices": indices, "material": MATERIALS.index(material)}
        self.json["meshes"].append({"name": name, "primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def node(self, name, mesh, at=(0, 0, 0)):
        self.json["nodes"].append({"name": name, "mesh": mesh, "translation": [at[0], at[2], -at[1]]})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def box(self, name, low, high, material):
        """A separate node, at the centre of the box's base."""
        foot = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2])
        self.node(
            name,
            self.mesh(name, *box([a - f for a, f in zip(low, foot)], [h - f for h, f in zip(high, foot)]), material),
            foot,
        )

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = (
            struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.bytes), b"BIN\0") + self.bytes
        )
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def box(low, high):
    vertices = [
        (high[0] if i & 1 else low[0], high[1] if i & 2 else low[1], high[2] if i & 4 else low[2]) for i in range(8)
    ]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return vertices, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]


def turned_solid(profile, sides=16):
    """A solid of revolution around z: profile is [(radius, height), ...] from bottom to top."""
    vertices, triangles = [], []
    for radius, height in profile:
        vertices += [
            (radius * math.cos(math.tau * k / sides), radius * math.sin(math.tau * k / sides), height)
            for k in range(sides)
        ]
    for ring in range(len(profile) - 1):
        for k in range(sides):
            a, b = ring * sides + k, ring * sides + (k + 1) % sides
            triangles += [(a, b, b + sides), (a, b + sides, a + sides)]
    last = (len(profile) - 1) * sides
    for k in range(1, sides - 1):
        triangles += [(0, k + 1, k), (last, last + k, last + k + 1)]
    return vertices, triangles


def courtyard(path):
    """Two courts of 24 m × 15 m, a wall with a gate and two windows between them, a colonnade, stairs, planters."""
    glb = Glb()
    wide, deep, high, thick = 24.0, 30.0, 4.0, 0.4
    glb.box("floor", (-thick, -thick, -0.3), (wide + thick, deep + thick, 0), "concrete")
    glb.box("wall.001", (-thick, -thick, 0), (0, deep + thick, high), "brick")
    glb.box("wall.002", (wide, -thick, 0), (wide + thick, deep + thick, high), "brick")
    glb.box("wall.003", (0, -thick, 0), (wide, 0, high), "brick")
    glb.box("wall.004", (0, deep, 0), (wide, deep + thick, high), "brick")

    # The wall between: piers from x to x, with lintels over the openings and sills under the windows.
    y0, y1 = 14.8, 15.2
    openings = [(4.0, 5.6, 1.2, 2.8), (10.8, 13.2, 0.0, 2.6), (18.4, 20.0, 1.2, 2.8)]  # x, x, sill, lintel
    x = 0.0
    for i, (x0, x1, sill, lintel) in enumerate(openings):
        glb.box(f"pier.{i}", (x, y0, 0), (x0, y1, high), "brick")
        glb.box(f"lintel.{i}", (x0, y0, lintel), (x1, y1, high), "concrete")
        if sill > 0:
            glb.box(f"sill.{i}", (x0, y0, 0), (x1, y1, sill), "concrete")
        x = x1
    glb.box("pier.9", (x, y0, 0), (wide, y1, high), "brick")

    pillar = glb.mesh(
        "pillar",
        *turned_solid([(0.45, 0.0), (0.45, 0.25), (0.30, 0.40), (0.26, 3.2), (0.42, 3.45), (0.42, 3.6)]),
        "concrete",
    )
    for i in range(6):  # a colonnade of two rows in the far court, beams on top
        for side, px in enumerate((7.0, 17.0)):
            glb.node(f"pillar.{2 * i + side}", pillar, (px, 17.5 + 2.2 * i, 0))
    for i in range(6):
        y = 17.5 + 2.2 * i
        glb.box(f"beam.{i}", (6.6, y - 0.15, 3.6), (17.4, y + 0.15, 3.9), "bark")

    rise, run, width = 0.25, 0.4, 3.0  # stairs along the west wall of the near court, to a platform
    for i in range(6):
        glb.box(f"step.{i}", (0, 5.0 + run * i, 0), (width, 5.0 + run * (i + 1), rise * (i + 1)), "concrete")
    glb.box("platform", (0, 7.4, 0), (width, 10.4, 1.5), "concrete")

    for i, (px, py) in enumerate(((8.0, 8.5), (12.0, 10.0), (16.0, 8.0), (20.5, 10.5), (20.5, 6.0), (12.0, 6.5))):
        glb.box(f"planter.{i}", (px - 0.7, py - 0.7, 0), (px + 0.7, py + 0.7, 0.7), "brick")
        crown = turned_solid([(0.08, 0.7), (0.10, 1.3), (0.75, 1.7), (0.95, 2.3), (0.6, 3.0), (0.1, 3.4)], 10)
        glb.node(f"shrub.{i}", glb.mesh("shrub", *crown, "leaf"), (px, py, 0))
    basin = glb.mesh(
        "basin",
        *turned_solid([(1.3, 0.0), (1.3, 0.5), (0.25, 0.55), (0.2, 1.6), (0.7, 1.8), (0.7, 1.9)], 24),
        "concrete",
    )
    glb.node("fountain", basin, (12.0, 23.0, 0))
    glb.write(path)


def lzf_compressed(data):
    """LZF, as LibLZF reads it: greedy, remembering the last position of each three bytes."""
    out, literal, seen, at = bytearray(), bytearray(), {}, 0

    def flush():
        for i in range(0, len(literal), 32):
            piece = literal[i : i + 32]
            out.append(len(piece) - 1)
            out.extend(piece)
        literal.clear()

    while at < len(data):
        key = data[at : at + 3]
        before = seen.get(key, -1) if len(key) == 3 else -1
        seen[key] = at
        if before < 0 or at - before > 8192:
            literal.append(data[at])
            at += 1
            continue
        length = 3
        while length < 264 and at + length < len(data) and data[before + length] == data[at + length]:
            length += 1
        flush()
        distance, code = at - before - 1, length - 2
        if code < 7:
            out.append((code << 5) | (distance >> 8))
        else:
            out += bytes([(7 << 5) | (distance >> 8), code - 7])
        out.append(distance & 255)
        at += length
    flush()
    return bytes(out)


def ground_m(x, y):
    return 0.35 + 0.2 * math.sin(0.31 * x + 0.7) + 0.15 * math.sin(0.23 * y - 0.12 * x)


def tree(rng, x, y, points):
    """Trunk, branches and a crown of leaves as points about 6 cm apart."""
    foot, height, radius = ground_m(x, y), rng.uniform(4.5, 6.5), rng.uniform(0.14, 0.28)
    lean = (rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05))

    def limb(a, b, r0, r1):
        length = math.dist(a, b)
        for i in range(max(2, int(length / 0.06))):
            t = i / max(1, int(length / 0.06))
            r = r0 + (r1 - r0) * t
            for _ in range(max(2, int(math.tau * r / 0.06))):
                angle = rng.uniform(0, math.tau)
                points.append(
                    (
                        a[0] + (b[0] - a[0]) * t + r * math.cos(angle),
                        a[1] + (b[1] - a[1]) * t + r * math.sin(angle),
                        a[2] + (b[2] - a[2]) * t,
                    )
                )

    def on_trunk(h):
        return (x + lean[0] * h, y + lean[1] * h, foot + h)

    limb(on_trunk(0), on_trunk(height), radius, 0.05)
    for _ in range(rng.randint(6, 9)):
        start = on_trunk(rng.uniform(0.42, 0.9) * height)
        angle, reach = rng.uniform(0, math.tau), rng.uniform(0.7, 1.5)
        end = (start[0] + reach * math.cos(angle), start[1] + reach * math.sin(angle), start[2] + rng.uniform(0.1, 0.7))
        limb(start, end, 0.05, 0.02)
        size = rng.uniform(0.35, 0.6)
        for _ in range(90):  # a tuft of leaves: points in a shell
            d = [rng.gauss(0, 1) for _ in range(3)]
            n = math.hypot(*d)
            r = size * rng.uniform(0.7, 1.0)
            points.append(tuple(e + r * k * v / n for e, k, v in zip(end, (1, 1, 0.7), d)))


def thicket(path):
    """A wood of 24 m × 30 m as a laser scanner would have it, one point a voxel of 12.5 cm."""
    rng, points = random.Random(24), []
    wide, deep = 24.0, 30.0
    feet = []
    for _ in range(4000):
        x, y = rng.uniform(1.0, wide - 1.0), rng.uniform(6.0, deep - 6.0)
        if all(math.hypot(x - a, y - b) >= 2.8 for a, b in feet):
            feet.append((x, y))
    for x, y in feet:
        tree(rng, x, y, points)
    step = 0.125
    for i in range(int(wide / step)):
        for j in range(int(deep / step)):
            x, y = (i + rng.random()) * step, (j + rng.random()) * step
            points.append((x, y, ground_m(x, y) + rng.uniform(-0.02, 0.02)))
    voxels = {}
    for p in points:
        if 0 <= p[0] < wide and 0 <= p[1] < deep:
            voxels.setdefault(tuple(math.floor(c / step) for c in p), p)
    kept = [tuple(round(c * 32) / 32 for c in voxels[key]) for key in sorted(voxels)]
    columns = b"".join(struct.pack(f"<{len(kept)}f", *column) for column in zip(*kept))
    packed = lzf_compressed(columns)
    header = (
        "# .PCD v0.7 - made by scripts/make_maps.py of avoidbench, MIT licence\nVERSION 0.7\nFIELDS x y z\n"
        f"SIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(kept)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
        f"POINTS {len(kept)}\nDATA binary_compressed\n"
    )
    path.write_bytes(header.encode() + struct.pack("<II", len(packed), len(columns)) + packed)


folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent / "maps"
courtyard(folder / "courtyard.glb")
thicket(folder / "thicket.pcd")
