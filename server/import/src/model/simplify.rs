//! A mesh with fewer triangles.
//!
//! A tree is thousands of pieces: limbs, and leaves of a few triangles each, which cannot have fewer. So small pieces are
//! thinned first: of many, some stay, and grow to cover as much as all did (Cook et al., "Stochastic simplification of
//! aggregate detail", 2007). What is then still too much loses triangles where the surface changes least.

use glam::Vec3;
use meshopt::SimplifyOptions;

use super::{
    ImportError, Limits, Triangles,
    components::{Component, Components},
};

/// Vertices that a piece needs to keep its shape.
const ENOUGH: u32 = 8;
/// Pieces that stay for others become at most so many times as large.
const MAX_GROWTH: f32 = 4.0;
/// How often triangles are taken away; once or twice are usual.
const MAX_ROUNDS: usize = 12;

/// The mesh within the limits.
pub(super) fn simplified(mesh: Triangles, limits: &Limits) -> Result<Triangles, ImportError> {
    let mesh = thinned(mesh, limits);
    let places = within_one(&mesh.vertices).ok_or(ImportError::NotFinite)?;
    let corners = reduced(mesh.corners, &places, limits).ok_or(ImportError::TooLarge(*limits))?;
    Ok(used(&mesh.vertices, corners))
}

/// What a piece costs, when it is as simple as it can be.
fn cost(component: &Component) -> f64 {
    f64::from(component.vertices.min(ENOUGH))
}

/// The mesh with as many pieces as there can be. Half of the room is for the largest; those of the rest that stay are
/// spread evenly over it.
fn thinned(mesh: Triangles, limits: &Limits) -> Triangles {
    let Components { of, all } = Components::of(&mesh);
    let room = limits.vertices as f64;
    if all.iter().map(cost).sum::<f64>() <= room {
        return mesh;
    }
    let mut by_size: Vec<u32> = (0..all.len() as u32).collect();
    by_size.sort_by(|&a, &b| {
        let extent = |number: u32| all[number as usize].extent();
        extent(b).total_cmp(&extent(a)).then(a.cmp(&b))
    });
    let mut is_large = vec![false; all.len()];
    let mut taken = 0.0;
    for number in by_size {
        taken += cost(&all[number as usize]);
        if taken > room / 2.0 {
            break;
        }
        is_large[number as usize] = true;
    }
    let small: f64 =
        all.iter().zip(&is_large).filter(|(_, is_large)| !**is_large).map(|(one, _)| cost(one)).sum();
    let share = room / 2.0 / small;
    let growth = (libm::sqrt(1.0 / share) as f32).clamp(1.0, MAX_GROWTH);
    let mut credit = 0.0;
    // How much each piece grows; 0 for those that go.
    let growths: Vec<f32> = is_large
        .iter()
        .map(|&is_large| {
            if is_large {
                return 1.0;
            }
            credit += share;
            if credit < 1.0 {
                return 0.0;
            }
            credit -= 1.0;
            growth
        })
        .collect();
    let growth_of = |vertex: u32| growths[of[vertex as usize] as usize];
    let corners = mesh.corners.into_iter().filter(|&[corner, ..]| growth_of(corner) > 0.0).collect();
    let places: Vec<Vec3> = mesh
        .vertices
        .iter()
        .zip(&of)
        .map(|(&place, &number)| {
            let middle = all[number as usize].middle();
            let growth = growths[number as usize];
            if growth == 1.0 { place } else { middle + (place - middle) * growth }
        })
        .collect();
    used(&places, corners)
}

/// Places from -1 to 1 around their middle; nothing where they reach too far to be measured.
fn within_one(places: &[Vec3]) -> Option<Vec<[f32; 3]>> {
    let low = places.iter().copied().reduce(Vec3::min)?.as_dvec3();
    let high = places.iter().copied().reduce(Vec3::max)?.as_dvec3();
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low).max_element());
    if !(half.is_finite() && half > 0.0) {
        return None;
    }
    Some(places.iter().map(|place| ((place.as_dvec3() - middle) / half).as_vec3().to_array()).collect())
}

/// Triangles that the limits allow; nothing where there is no way to have fewer.
fn reduced(corners: Vec<[u32; 3]>, places: &[[f32; 3]], limits: &Limits) -> Option<Vec<[u32; 3]>> {
    let mut corners = corners.into_flattened();
    // First so that surfaces stay whole, then in any way there is.
    for method in [smoothly, roughly] {
        let mut target = limits.triangles;
        for _ in 0..MAX_ROUNDS {
            let (vertices, triangles) = (different(&corners), corners.len() / 3);
            if vertices <= limits.vertices && triangles <= limits.triangles && triangles > 0 {
                return Some(corners.as_chunks().0.to_vec());
            }
            let vertices_over = vertices as f64 / limits.vertices as f64;
            target = target.min((triangles as f64 / vertices_over * 0.98) as usize).max(1);
            let fewer = method(&corners, places, 3 * target);
            if fewer.is_empty() || fewer.len() == corners.len() && different(&fewer) == vertices {
                break;
            }
            corners = fewer;
        }
    }
    let is_allowed = different(&corners) <= limits.vertices && corners.len() / 3 <= limits.triangles;
    (is_allowed && !corners.is_empty()).then(|| corners.as_chunks().0.to_vec())
}

/// Edges are collapsed, those first that change the surface least.
fn smoothly(corners: &[u32], places: &[[f32; 3]], count: usize) -> Vec<u32> {
    meshopt::simplify_decoder(corners, places, count.min(corners.len()), 1.0, SimplifyOptions::None, None)
}

/// What lies in one cell of a grid becomes one vertex.
fn roughly(corners: &[u32], places: &[[f32; 3]], count: usize) -> Vec<u32> {
    meshopt::simplify_sloppy_decoder(corners, places, count.min(corners.len()), 1.0, None)
}

/// How many different vertices corners name.
fn different(corners: &[u32]) -> usize {
    let mut all = corners.to_vec();
    all.sort_unstable();
    all.dedup();
    all.len()
}

/// The triangles and the places that they name, in the order in which they do.
fn used(places: &[Vec3], mut corners: Vec<[u32; 3]>) -> Triangles {
    const NONE: u32 = u32::MAX;
    let mut numbers = vec![NONE; places.len()];
    let mut vertices = Vec::new();
    for corner in corners.as_flattened_mut() {
        let number = &mut numbers[*corner as usize];
        if *number == NONE {
            *number = vertices.len() as u32;
            vertices.push(places[*corner as usize]);
        }
        *corner = *number;
    }
    Triangles { vertices, corners }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits { vertices: 400, triangles: 800, most_triangles: 1_000_000 };

    /// A ball of so many rings and twice as many sides.
    fn ball(rings: u32, centre: Vec3, radius: f32) -> Triangles {
        let sides = 2 * rings;
        let mut vertices = vec![centre + Vec3::Y * radius];
        for ring in 1..rings {
            let (sin, cos) = libm::sincosf(core::f32::consts::PI * ring as f32 / rings as f32);
            for side in 0..sides {
                let (z, x) = libm::sincosf(core::f32::consts::TAU * side as f32 / sides as f32);
                vertices.push(centre + Vec3::new(sin * x, cos, sin * z) * radius);
            }
        }
        vertices.push(centre - Vec3::Y * radius);
        let last = vertices.len() as u32 - 1;
        let at = |ring: u32, side: u32| 1 + (ring - 1) * sides + side % sides;
        let mut corners = Vec::new();
        for side in 0..sides {
            corners.push([0, at(1, side + 1), at(1, side)]);
            corners.push([last, at(rings - 1, side), at(rings - 1, side + 1)]);
            for ring in 1..rings - 1 {
                let [a, b] = [at(ring, side), at(ring, side + 1)];
                let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
                corners.extend([[a, b, c], [c, b, d]]);
            }
        }
        Triangles { vertices, corners }
    }

    fn joined(parts: impl IntoIterator<Item = Triangles>) -> Triangles {
        parts.into_iter().fold(Triangles::default(), |mut all, part| {
            let first = all.vertices.len() as u32;
            all.vertices.extend(part.vertices);
            all.corners.extend(part.corners.iter().map(|corners| corners.map(|corner| first + corner)));
            all
        })
    }

    fn leaf(place: Vec3) -> Triangles {
        let vertices = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Z, Vec3::Z].map(|corner| place + 0.1 * corner);
        Triangles { vertices: vertices.to_vec(), corners: vec![[0, 1, 2], [0, 2, 3]] }
    }

    fn check(mesh: &Triangles) {
        assert!(!mesh.corners.is_empty() && mesh.corners.len() <= LIMITS.triangles);
        assert!(mesh.vertices.len() <= LIMITS.vertices);
        assert!(mesh.corners.iter().flatten().all(|&corner| (corner as usize) < mesh.vertices.len()));
        assert!(mesh.vertices.iter().all(|vertex| vertex.is_finite()));
    }

    fn bounds(mesh: &Triangles) -> [Vec3; 2] {
        [Vec3::min, Vec3::max].map(|of| mesh.vertices.iter().copied().reduce(of).expect("vertices"))
    }

    #[test]
    fn a_body_stays_closed_and_as_large() {
        let before = ball(40, Vec3::new(100.0, 20.0, -7.0), 5.0);
        let after = simplified(before.clone(), &LIMITS).expect("it has fewer");
        check(&after);
        assert!(after.corners.len() > LIMITS.triangles / 2, "no more is lost than must be");
        for (before, after) in bounds(&before).into_iter().zip(bounds(&after)) {
            assert!(before.distance(after) < 0.5, "{before} {after}");
        }
        let mut edges: Vec<[u32; 2]> = after
            .corners
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[from, to]| [from.min(to), from.max(to)])
            .collect();
        edges.sort_unstable();
        assert!(edges.chunk_by(|a, b| a == b).all(|same| same.len() == 2), "every edge has two sides");
    }

    #[test]
    fn of_a_crown_the_wood_and_some_larger_leaves_stay() {
        let leaves = (0..4000).map(|i| {
            let [x, y, z] = [i % 20, i / 20 % 20, i / 400].map(|at| at as f32);
            leaf(Vec3::new(x, y, z))
        });
        let wood = ball(10, Vec3::splat(10.0), 3.0);
        let before = joined(leaves.chain([wood]));
        let after = simplified(before.clone(), &LIMITS).expect("it has fewer");
        check(&after);
        let pieces = Components::of(&after).all;
        assert!(pieces.iter().any(|piece| piece.extent() > 4.0), "the wood");
        let leaves: Vec<f32> = pieces.iter().map(Component::extent).filter(|&extent| extent < 4.0).collect();
        assert!(leaves.len() > 20, "{leaves:?}");
        assert!(leaves.iter().any(|&extent| extent > 0.3), "they cover for others: {leaves:?}");
        for (before, after) in bounds(&before).into_iter().zip(bounds(&after)) {
            assert!(before.distance(after) < 3.0, "{before} {after}");
        }
    }

    #[test]
    fn loose_triangles_far_and_near_come_within_the_limits() {
        let loose = |i: u32| {
            let place = Vec3::new((i % 7) as f32, (i * i % 101) as f32, (i % 13) as f32) * 1e30;
            Triangles {
                vertices: vec![place, place + 1e30 * Vec3::X, place + 1e29 * Vec3::Y],
                corners: vec![[0, 1, 2]],
            }
        };
        check(&simplified(joined((0..3000).map(loose)), &LIMITS).expect("it has fewer"));
        let far = Vec3::splat(f32::MAX);
        let fan =
            |i: u32| Triangles { vertices: vec![far, -far, Vec3::X * i as f32], corners: vec![[0, 1, 2]] };
        match simplified(joined((0..3000).map(fan)), &LIMITS) {
            Ok(mesh) => check(&mesh),
            Err(error) => assert_eq!(error, ImportError::NotFinite, "there is no room to grow"),
        }
    }
}
