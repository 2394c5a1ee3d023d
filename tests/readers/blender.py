#!/usr/bin/env python3
"""Imports glTF, OBJ and USD files by Blender (pip install bpy) and counts what it made of them; fails on what is lost."""
import sys

import bpy

READERS = {
    ".glb": lambda path: bpy.ops.import_scene.gltf(filepath=path),
    ".obj": lambda path: bpy.ops.wm.obj_import(filepath=path),
    ".usda": lambda path: bpy.ops.wm.usd_import(filepath=path),
    ".usdz": lambda path: bpy.ops.wm.usd_import(filepath=path),
}

for path in sys.argv[1:]:
    ending = path[path.rindex(".") :]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert READERS[ending](path) == {"FINISHED"}, path
    graph = bpy.context.evaluated_depsgraph_get()
    objects = triangles = instances = 0
    low, high = [float("inf")] * 3, [float("-inf")] * 3
    for shown in graph.object_instances:
        if shown.object.type != "MESH":
            continue
        mesh = shown.object.data
        mesh.calc_loop_triangles()
        instances += shown.is_instance
        objects += not shown.is_instance
        triangles += len(mesh.loop_triangles)
        is_hull = shown.object.name.startswith("UCX_")
        assert is_hull or mesh.materials, f"{path}: {shown.object.name} has no material"
        for corner in shown.object.bound_box:
            place = shown.matrix_world @ type(shown.matrix_world.translation)(corner)
            low = [min(a, b) for a, b in zip(low, place)]
            high = [max(a, b) for a, b in zip(high, place)]
    pictures = [image for image in bpy.data.images if image.size[0] > 0]
    assert triangles > 0, f"{path}: nothing is seen"
    # A layer of USD alone has no textures with it.
    assert pictures or ending == ".usda", f"{path}: no texture was found"
    size = [round(b - a, 3) for a, b in zip(low, high)]
    print(
        f"{path}: {objects} objects and {instances} instances, {triangles} triangles, "
        f"{len(bpy.data.materials)} materials, {len(pictures)} pictures, {size} m (Z up)"
    )
