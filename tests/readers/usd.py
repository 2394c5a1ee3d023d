#!/usr/bin/env python3
"""Opens USD files by usd-core (pip install usd-core) and counts what is in them; fails on what is no valid scene."""
import sys

from pxr import Usd, UsdGeom, UsdShade

for path in sys.argv[1:]:
    stage = Usd.Stage.Open(path)
    assert stage, path
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1 and UsdGeom.GetStageUpAxis(stage) == "Y", path
    meshes = points = triangles = leaves = 0
    for prim in stage.Traverse():
        if prim.IsA(UsdGeom.Mesh):
            mesh = UsdGeom.Mesh(prim)
            count, indices = len(mesh.GetPointsAttr().Get()), mesh.GetFaceVertexIndicesAttr().Get()
            faces = mesh.GetFaceVertexCountsAttr().Get()
            valid, why = UsdGeom.Mesh.ValidateTopology(indices, faces, count)
            assert valid, f"{path} {prim.GetPath()}: {why}"
            assert len(mesh.GetNormalsAttr().Get()) == count, f"{path} {prim.GetPath()}"
            subsets = UsdGeom.Subset.GetGeomSubsets(mesh, UsdGeom.Tokens.face, "materialBind")
            if subsets:
                kind = UsdGeom.Subset.GetFamilyType(mesh, "materialBind")
                whole, why = UsdGeom.Subset.ValidateFamily(mesh, UsdGeom.Tokens.face, "materialBind")
                assert kind == UsdGeom.Tokens.partition and whole, f"{path} {prim.GetPath()}: {kind} {why}"
            meshes, points, triangles = meshes + 1, points + count, triangles + len(faces)
            if "Collision" not in str(prim.GetAppliedSchemas()):
                material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
                assert material, f"{path} {prim.GetPath()} has no material"
                assert material.ComputeSurfaceSource()[0], f"{path} {material.GetPath()}"
        if prim.IsA(UsdGeom.PointInstancer):
            places = UsdGeom.PointInstancer(prim)
            count = len(places.GetPositionsAttr().Get())
            lists = [places.GetProtoIndicesAttr(), places.GetOrientationsAttr(), places.GetScalesAttr()]
            assert all(len(one.Get()) == count for one in lists), f"{path} {prim.GetPath()}"
            leaves += count
    box = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default"]).ComputeWorldBound(stage.GetPseudoRoot())
    size = [round(side, 3) for side in box.ComputeAlignedRange().GetSize()]
    print(f"{path}: {meshes} meshes, {points} points, {triangles} triangles, {leaves} leaves as instances, {size} m")
