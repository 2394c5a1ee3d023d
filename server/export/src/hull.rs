//! Convex bodies around trunk and crown, for collisions.

use std::{collections::BTreeSet, f32::consts::PI};

use espalier_mesh::TriangleMesh;
use espalier_plant::{MetamerId, Plant};
use glam::{Vec2, Vec3};

use crate::foliage::Foliage;

/// Directions in which a body reaches as far as what it holds.
const DIRECTIONS: u32 = 48;
/// How far a crown and a trunk reach beyond their nodes, in internodes, so that no body is flat.
const LEAF: f32 = 0.6;
const LEAST: f32 = 0.1;

/// The trunk below the lowest leaf, if there is one, and the crown.
pub(crate) fn of_plant(plant: &Plant, foliage: &Foliage<'_>, ids: &[MetamerId]) -> Vec<TriangleMesh> {
    let place = |id: &MetamerId| plant.metamers().end(*id);
    let leafy = ids.iter().filter(|&&id| foliage.is_leafy(id)).map(|id| place(id).y);
    let base = leafy.fold(f32::MAX, f32::min);
    let (crown, mut trunk): (Vec<MetamerId>, Vec<MetamerId>) =
        ids.iter().partition(|id| base == f32::MAX || place(id).y >= base);
    trunk.retain(|&id| plant.axes().order(plant.metamers().axis(id)) == 0);
    let foot = ids.first().and_then(|&id| plant.metamers().parent(id)).map(|seed| place(&seed));
    let around = |ids: &[MetamerId], margin: f32, foot: Option<Vec3>| {
        let thickest = ids.iter().map(|&id| foliage.radius(id)).fold(margin, f32::max);
        let points: Vec<Vec3> = ids.iter().map(place).chain(foot).collect();
        convex(&points, thickest)
    };
    let trunk = (!trunk.is_empty()).then(|| around(&trunk, LEAST, foot));
    trunk.into_iter().chain([around(&crown, LEAF, None)]).collect()
}

/// A closed convex body that holds all points, or nearly so, with so much around them; flat faces with their own normals.
fn convex(points: &[Vec3], margin: f32) -> TriangleMesh {
    let furthest = |direction: Vec3| {
        let further = |a: &&Vec3, b: &&Vec3| a.dot(direction).total_cmp(&b.dot(direction));
        points.iter().max_by(further).map(|&point| point + margin * direction)
    };
    let corners: Vec<Vec3> = directions().filter_map(furthest).collect();
    let mut mesh = TriangleMesh::default();
    for [a, b, c] in faces(&corners) {
        let [a, b, c] = [a, b, c].map(|corner| corners[corner]);
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
        let [a, b, c] = [a, b, c].map(|corner| mesh.vertex(corner, normal, Vec2::ZERO));
        mesh.triangle(a, b, c);
    }
    mesh
}

/// Unit vectors, spread evenly.
fn directions() -> impl Iterator<Item = Vec3> {
    (0..DIRECTIONS).map(|i| {
        let y = 1.0 - (2 * i + 1) as f32 / DIRECTIONS as f32;
        let (sin, cos) = libm::sincosf(PI * (3.0 - 5.0f32.sqrt()) * i as f32);
        Vec3::new(cos, 0.0, sin) * (1.0 - y * y).sqrt() + Vec3::Y * y
    })
}

/// The triangles of the convex hull of points, counter-clockwise from outside: each point in its turn replaces the faces
/// that it sees by a cone over their rim.
fn faces(points: &[Vec3]) -> Vec<[usize; 3]> {
    let Some(start) = tetrahedron(points) else { return Vec::new() };
    let sees = |[a, b, c]: [usize; 3], point: Vec3| {
        let [a, b, c] = [a, b, c].map(|corner| points[corner].as_dvec3());
        (b - a).cross(c - a).dot(point.as_dvec3() - a) > 1e-9
    };
    let [a, b, c, d] = start;
    let mut faces = vec![[a, b, c], [a, c, d], [a, d, b], [b, d, c]];
    for (index, &point) in points.iter().enumerate().filter(|(index, _)| !start.contains(index)) {
        let (seen, rest): (Vec<_>, Vec<_>) = faces.iter().partition(|&&face| sees(face, point));
        let edges: BTreeSet<[usize; 2]> =
            seen.iter().flat_map(|&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [c, a]]).collect();
        faces = rest;
        // The rim has only one side that is seen.
        faces.extend(edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a])).map(|&[a, b]| [a, b, index]));
    }
    faces
}

/// Four points that are in no plane, so turned that the first three are seen counter-clockwise from outside.
fn tetrahedron(points: &[Vec3]) -> Option<[usize; 4]> {
    let most = |measure: &dyn Fn(Vec3) -> f32| {
        let of = |&i: &usize| measure(points[i]);
        (0..points.len()).max_by(|a, b| of(a).total_cmp(&of(b))).filter(|i| of(i) > 1e-6)
    };
    let first = *points.first()?;
    let second = most(&|point| point.distance(first))?;
    let along = (points[second] - first).normalize();
    let third = most(&|point| (point - first).reject_from_normalized(along).length())?;
    let normal = along.cross(points[third] - first).normalize();
    let fourth = most(&|point| (point - first).dot(normal).abs())?;
    let is_above = (points[fourth] - first).dot(normal) > 0.0;
    Some(if is_above { [0, third, second, fourth] } else { [0, second, third, fourth] })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(points: &[Vec3], margin: f32) {
        let mesh = convex(points, margin);
        let triangles = mesh.indices.as_chunks::<3>().0;
        assert!(triangles.len() >= 4);
        let mut volume = 0.0;
        for corners in triangles {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            let normal = (b - a).cross(c - a).normalize();
            volume += a.dot(b.cross(c)) / 6.0;
            for &point in points.iter().chain(&mesh.positions) {
                assert!((point - a).dot(normal) < 1e-3, "{point} is outside");
            }
            // Closed: each edge is there once in each direction.
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let back = triangles.iter().flat_map(|corners| {
                    let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
                    [(b, a), (c, b), (a, c)]
                });
                assert_eq!(back.filter(|edge| *edge == (from, to)).count(), 1);
            }
        }
        assert!(volume > margin * margin * margin, "{volume}");
    }

    #[test]
    fn bodies_are_convex_closed_and_hold_what_they_are_made_of() {
        let line: Vec<Vec3> = (0..9).map(|i| Vec3::Y * i as f32).collect();
        let flat: Vec<Vec3> = (0..30).map(|i| Vec3::new((i % 6) as f32, (i / 6) as f32, 0.0)).collect();
        let ball: Vec<Vec3> = directions().map(|way| way * 5.0 + Vec3::Y * 20.0).collect();
        for points in [&[Vec3::ONE][..], &line, &flat, &ball] {
            holds(points, 0.5);
        }
    }
}
