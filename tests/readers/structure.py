#!/usr/bin/env python3
"""Reads files of structure by other programs' means: point clouds by trimesh (pip install trimesh), tables of cylinders
by Python's own module, and graphs by openalea.mtg where that can be imported, else by the few rules of the format below.
Says what is in each, and fails where parts do not fit together."""
import csv
import math
import sys
from pathlib import Path

import numpy
import trimesh


def cloud(path):
    points = trimesh.load(path)
    vertex = points.metadata["_ply_raw"]["vertex"]["data"]
    labels, metamers = numpy.unique(vertex["label"]), numpy.unique(vertex["metamer"])
    normals = numpy.stack([vertex[axis] for axis in ("nx", "ny", "nz")], axis=-1)
    assert set(labels) <= {0, 1, 2, 3}, f"{path}: labels {labels}"
    assert numpy.allclose(numpy.linalg.norm(normals, axis=1), 1, atol=1e-3), f"{path}: a normal is no unit vector"
    wood, *borne = [int((vertex["label"] == label).sum()) for label in range(4)]
    parts = "".join(f", {count} of {what}" for count, what in zip(borne, ("leaves", "flowers", "fruits")) if count)
    print(f"{path}: {len(vertex)} points, {wood} of wood{parts}, of {len(metamers)} metamers")


def cylinders(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    number = lambda row, names: [float(row[name]) for name in names]
    volume = roots = 0
    for at, row in enumerate(rows, 1):
        radius, length = number(row, ("radius", "length"))
        assert radius > 0 and length >= 0, f"{path}: line {at + 1}"
        assert abs(math.hypot(*number(row, ("axis.x", "axis.y", "axis.z"))) - 1) < 1e-3, f"{path}: line {at + 1}"
        # Cylinders are counted from 1, and each is born before what it bears.
        assert 0 <= int(row["parent"]) < at, f"{path}: line {at + 1}"
        roots += row["parent"] == "0"
        volume += math.pi * radius**2 * length
    order = max(int(row["BranchOrder"]) for row in rows)
    print(f"{path}: {len(rows)} cylinders, {roots} of no other, order {order}, {volume:.4g} m³")


def graph(path):
    try:
        from openalea.mtg.io import read_mtg_file
    except ImportError:
        tops, follow, branch, reader = own_graph(path)
    else:
        read = read_mtg_file(path)
        finest = list(read.vertices(scale=read.max_scale()))
        edges = [read.edge_type(vertex) for vertex in finest]
        tops, follow, branch, reader = len(finest), edges.count("<"), edges.count("+"), "openalea.mtg"
    assert tops == follow + branch + 1, f"{path}: {tops} components, {follow} that follow, {branch} that branch"
    print(f"{path}: {tops} components of the finest scale, {follow} follow, {branch} branch, says {reader}")


def own_graph(path):
    """A component a line: it hangs on what the column before it, or this column above it, had last."""
    head, _, body = Path(path).read_text().partition("\nMTG:")
    classes = head.partition("CLASSES:")[2].partition("DESCRIPTION")[0].split("\n")
    scales = {cells[0]: int(cells[1]) for line in classes if len(cells := line.split()) == 5 and cells[1].isdigit()}
    finest = max(scales.values())
    tops = follow = branch = 0
    lines = [line for line in body.split("\n") if line.strip()]
    columns = lines[0].split("\t").index("XX")
    for line in lines[1:]:
        code = next(cell for cell in line.split("\t")[:columns] if cell)
        # What a line begins with `^` for stands above it already.
        parts = code.removeprefix("^").replace("/", " /").replace("<", " <").replace("+", " +").split()
        for part in parts:
            if scales[part[1]] == finest:
                tops, follow, branch = tops + 1, follow + (part[0] == "<"), branch + (part[0] == "+")
            elif part[0] == "+":
                # An axis that branches off does so with its first component.
                branch += 1
    return tops, follow, branch, "the reader here"


READERS = {".ply": cloud, ".csv": cylinders, ".mtg": graph}

for path in sys.argv[1:]:
    READERS[Path(path).suffix](path)
