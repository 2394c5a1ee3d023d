#!/usr/bin/env python3
"""Opens glTF files by trimesh (pip install trimesh) and looks whether each piece of wood is closed and wound outwards."""
import sys
from collections import defaultdict

import trimesh

for path in sys.argv[1:]:
    scene = trimesh.load(path, force="scene")
    # Bark and the faces of cuts are parts of one mesh, which have its name with a number.
    pieces = defaultdict(list)
    for name, mesh in scene.geometry.items():
        before, is_wood, _ = name.partition(" Wood")
        if is_wood:
            pieces[before].append(trimesh.Trimesh(mesh.vertices, mesh.faces, process=False))
    assert pieces, f"{path}: no wood"
    for name, parts in pieces.items():
        wood = trimesh.util.concatenate(parts)
        # Along the seam of a texture a place has two vertices.
        wood.merge_vertices(merge_tex=True, merge_norm=True)
        assert wood.is_watertight, f"{path}: an edge of the wood of {name} is open"
        assert wood.is_winding_consistent, f"{path}: triangles of the wood of {name} are wound either way"
        assert wood.volume > 0, f"{path}: the wood of {name} is inside out"
        print(f"{path}: {name}: {len(wood.faces)} triangles of wood, {wood.volume:.4g} m³")
    size = [round(side, 3) for side in scene.extents.tolist()]
    print(f"{path}: {sum(len(mesh.faces) for mesh in scene.geometry.values())} triangles in all, {size} m")
