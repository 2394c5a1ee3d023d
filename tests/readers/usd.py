#!/usr/bin/env python3
"""Opens USD files by usd-core (pip install usd-core) and counts what is in them; fails on what is no valid scene."""
import sys

from pxr import Gf, Usd, UsdGeom, UsdShade, UsdSkel




def swaying(stage, path):
    """Holds skeletons to what UsdSkel asks of them; how many bones there are, and the furthest that a vertex goes in metres."""
    bones, furthest = 0, 0.0
    first, last = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    for prim in stage.Traverse():
        if not prim.IsA(UsdSkel.Root):
            continue
        root, cache = UsdSkel.Root(prim), UsdSkel.Cache()
        cache.Populate(root, Usd.PrimDefaultPredicate)
        for binding in cache.ComputeSkelBindings(root, Usd.PrimDefaultPredicate):
            skeleton = cache.GetSkelQuery(binding.GetSkeleton())
            where = f"{path} {skeleton.GetPrim().GetPath()}"
            joints, moves = skeleton.GetJointOrder(), skeleton.GetAnimQuery()
            valid, why = skeleton.GetTopology().Validate()
            assert valid and moves and list(moves.GetJointOrder()) == list(joints), f"{where}: {why}"
            assert moves.GetJointTransformTimeSamples()[-1] == last > first, where
            poses = [list(moves.ComputeJointLocalTransforms(time)) for time in (first, last)]
            assert poses[0] == poses[1], f"{where}: the loop has a seam"
            bones += len(joints)
            for target in binding.GetSkinningTargets():
                mesh = UsdGeom.Mesh(target.GetPrim())
                points = mesh.GetPointsAttr().Get()
                which, shares = target.ComputeVaryingJointInfluences(len(points))
                each = target.GetNumInfluencesPerComponent()
                assert len(which) == len(shares) == each * len(points), f"{where} {mesh.GetPath()}"
                sums = [sum(shares[at : at + each]) for at in range(0, len(shares), each)]
                assert all(abs(sum - 1) < 1e-5 for sum in sums), f"{where} {mesh.GetPath()}"
                assert all(0 <= bone < len(joints) for bone in which), f"{where} {mesh.GetPath()}"
                # How far vertices go from where they rest, in the skeleton's space.
                bind = target.GetGeomBindTransform()
                ways = []
                for pose in (skeleton.ComputeSkinningTransforms(first), skeleton.ComputeSkinningTransforms(last / 2)):
                    moved = type(points)(points)
                    assert target.ComputeSkinnedPoints(pose, moved, first), f"{where} {mesh.GetPath()}"
                    rest = [Gf.Vec3f(bind.Transform(Gf.Vec3d(point))) for point in points]
                    ways.append(max((one - other).GetLength() for one, other in zip(moved, rest)))
                assert max(ways) > 0, f"{where} {mesh.GetPath()} stands still"
                furthest = max(furthest, *ways)
    return bones, furthest


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
    bones, furthest = swaying(stage, path)
    if bones:
        print(f"{path}: {bones} bones, which move vertices by {furthest:.2f} m at most")
