//! What obstacles answer, against plain definitions.

use std::sync::Arc;

use glam::Quat;
use proptest::prelude::*;

use super::{mesh::tests::cuboid, triangle::Edges, triangle::Triangle, *};

fn obstacles(shapes: impl IntoIterator<Item = Shape>) -> Obstacles {
    Obstacles::new(shapes.into_iter().map(|shape| Obstacle::new(shape).expect("valid")).collect())
}

/// A mesh where it was made.
fn standing(mesh: TriangleMesh) -> Shape {
    Shape::Mesh { mesh: Arc::new(mesh), position: Vec3::ZERO, rotation: Quat::IDENTITY }
}

fn vector(range: core::ops::Range<f32>) -> impl Strategy<Value = Vec3> {
    (range.clone(), range.clone(), range).prop_map(Vec3::from)
}

fn unit() -> impl Strategy<Value = Vec3> {
    vector(-1.0..1.0).prop_filter_map("not nothing", |v| v.try_normalize())
}

fn rotation() -> impl Strategy<Value = Quat> {
    (vector(-1.0..1.0), -1.0f32..1.0)
        .prop_filter("not nothing", |(v, w)| v.length() + w.abs() > 0.1)
        .prop_map(|(v, w)| Quat::from_xyzw(v.x, v.y, v.z, w).normalize())
}

fn shape() -> impl Strategy<Value = Shape> {
    prop_oneof![
        (vector(-6.0..6.0), vector(0.2..5.0), rotation())
            .prop_map(|(centre, half_extents, rotation)| { Shape::Box { centre, half_extents, rotation } }),
        (vector(-6.0..6.0), 0.2f32..5.0).prop_map(|(centre, radius)| Shape::Sphere { centre, radius }),
        (vector(-6.0..6.0), unit()).prop_map(|(point, normal)| Shape::Plane { point, normal }),
        (vector(-6.0..6.0), vector(0.2..5.0), rotation()).prop_map(|(position, size, rotation)| {
            let mesh = Arc::new(cuboid(-0.5 * size, 0.5 * size));
            Shape::Mesh { mesh, position, rotation }
        }),
    ]
}

/// A soup of triangles, closed only by chance.
fn soup() -> impl Strategy<Value = TriangleMesh> {
    let triangle = (vector(-8.0..8.0), vector(-9.0..9.0), vector(-9.0..9.0));
    prop::collection::vec(triangle, 1..80).prop_filter_map("has an area", |triangles| {
        let vertices: Vec<Vec3> = triangles.iter().flat_map(|&(a, u, v)| [a, a + u, a + v]).collect();
        let corners = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        TriangleMesh::new(vertices, corners).ok()
    })
}

fn triangles(mesh: &TriangleMesh) -> Vec<Triangle> {
    let place = |corner: u32| mesh.vertices()[corner as usize];
    mesh.triangles().iter().map(|corners| Triangle(corners.map(place))).collect()
}

proptest! {
    #[test]
    fn mesh_answers_agree_with_every_triangle(
        mesh in soup(),
        from in vector(-12.0..12.0),
        to in vector(-12.0..12.0),
        radius in 0.05f32..3.0,
    ) {
        let along = to - from;
        let all = triangles(&mesh);
        let hits = || all.iter().filter_map(|t| t.meets(from, along, Edges::Belong));
        let first = hits().filter(|t| *t <= 1.0).fold(f64::INFINITY, f64::min);
        let found = mesh.first_hit(from, along).map_or(f32::INFINITY, |(t, _)| t);
        prop_assert_eq!(found, first as f32);
        prop_assert_eq!(mesh.meets_ray(from, along), hits().next().is_some());
        let nearest = all.iter().map(|t| t.nearest(from).distance(from)).fold(f32::INFINITY, f32::min);
        let found = mesh.nearest(from, radius).map(|point| point.distance(from));
        prop_assert_eq!(found, (nearest <= radius).then_some(nearest));
    }

    #[test]
    fn nearest_points_are_nearest(corners in [vector(-4.0..4.0), vector(-4.0..4.0), vector(-4.0..4.0)], place in vector(-6.0..6.0)) {
        let triangle = Triangle(corners);
        let distance = triangle.nearest(place).distance(place);
        let [a, b, c] = corners;
        for i in 0..=40 {
            for j in 0..=40 - i {
                let sample = a + (b - a) * (i as f32 / 40.0) + (c - a) * (j as f32 / 40.0);
                prop_assert!(distance <= sample.distance(place) + 1e-4);
            }
        }
    }

    #[test]
    fn a_boxy_mesh_answers_like_the_box(
        low in vector(-6.0..0.0),
        size in vector(0.5..6.0),
        from in vector(-8.0..8.0),
        to in vector(-8.0..8.0),
    ) {
        let mesh = obstacles([standing(cuboid(low, low + size))]);
        let solid = obstacles([Shape::Box {
            centre: low + 0.5 * size, half_extents: 0.5 * size, rotation: Quat::IDENTITY,
        }]);
        prop_assert_eq!(mesh.contains(from), solid.contains(from));
        prop_assert_eq!(mesh.hides(from, to), solid.hides(from, to));
        if !solid.contains(from) && !solid.contains(to) {
            let (a, b) = (mesh.contact(from, to, 0.5), solid.contact(from, to, 0.5));
            prop_assert_eq!(a.is_some(), b.is_some());
            if let (Some(a), Some(b)) = (a, b) {
                prop_assert!(a.point.distance(b.point) < 1e-3, "{:?} {:?}", a, b);
            }
        }
    }

    #[test]
    fn a_turned_mesh_answers_like_the_turned_box(
        half in vector(0.3..4.0),
        centre in vector(-6.0..6.0),
        rotation in rotation(),
        from in vector(-9.0..9.0),
        to in vector(-9.0..9.0),
    ) {
        let mesh = Arc::new(cuboid(-half, half));
        let mesh = obstacles([Shape::Mesh { mesh, position: centre, rotation }]);
        let at = |half_extents| obstacles([Shape::Box { centre, half_extents, rotation }]);
        // A hair's breadth is left to rounding.
        let (smaller, larger) = (at(half - 1e-3), at(half + 1e-3));
        prop_assert!(!smaller.contains(from) || mesh.contains(from));
        prop_assert!(!mesh.contains(from) || larger.contains(from));
        prop_assert!(!smaller.hides(from, to) || mesh.hides(from, to));
        prop_assert!(!mesh.hides(from, to) || larger.hides(from, to));
        let ray = |obstacles: &Obstacles| obstacles.bodies[0].meets_ray(from, to - from);
        prop_assert!(!ray(&smaller) || ray(&mesh));
        prop_assert!(!ray(&mesh) || ray(&larger));
        if !larger.contains(from) && !larger.contains(to) && smaller.hides(from, to) {
            let (a, b) = (mesh.contact(from, to, 0.5), smaller.contact(from, to, 0.5));
            let (a, b) = (a.expect("it is met"), b.expect("it is met"));
            prop_assert!(a.normal.dot(b.normal) > 0.99 || a.point.distance(b.point) < 0.1, "{:?} {:?}", a, b);
        }
    }

    #[test]
    fn what_is_hidden_has_something_in_between(shape in shape(), from in vector(-9.0..9.0), to in vector(-9.0..9.0)) {
        let obstacles = obstacles([shape]);
        let inside = |i: u32| obstacles.contains(from.lerp(to, i as f32 / 200.0));
        let touched = (0..=200).any(inside);
        if touched {
            prop_assert!(obstacles.hides(from, to));
        }
        // A way that only cuts a corner may pass between two samples, one that is well clear may not.
        let clear = (0..=200).all(|i| {
            let place = from.lerp(to, i as f32 / 200.0);
            !obstacles.contains(place) && obstacles.contact(place, place, 0.2).is_none()
        });
        if clear {
            prop_assert!(!obstacles.hides(from, to));
        }
    }

    #[test]
    fn contacts_face_who_comes(shape in shape(), from in vector(-9.0..9.0), to in vector(-9.0..9.0)) {
        let obstacles = obstacles([shape]);
        if let Some(Contact { point, normal }) = obstacles.contact(from, to, CLEARANCE)
            && !obstacles.contains(from)
        {
            prop_assert!((normal.length() - 1.0).abs() < 1e-3);
            // A step back from the surface is outside, but for a thin solid's other side.
            prop_assert!(!obstacles.contains(point + normal * 0.01));
        }
    }

    #[test]
    fn ways_around_are_free_and_one_internode_long(
        shapes in prop::collection::vec(shape(), 1..4),
        base in vector(-9.0..9.0),
        heading in unit(),
    ) {
        let obstacles = obstacles(shapes);
        if let Some(way) = obstacles.way_around(base, heading, || Vec3::X) {
            prop_assert!((way.length() - 1.0).abs() < 1e-3);
            prop_assert!(!obstacles.blocks(base, base + way, CLEARANCE));
        }
        if !obstacles.blocks(base, base + heading, CLEARANCE) {
            prop_assert_eq!(obstacles.way_around(base, heading, || Vec3::X), Some(heading));
        }
    }
}

#[test]
fn a_shoot_turns_along_a_wall() {
    let wall = obstacles([Shape::Plane { point: Vec3::X * 5.0, normal: Vec3::NEG_X }]);
    let base = Vec3::new(4.5, 3.0, 0.0);
    let slanted = wall.way_around(base, Vec3::new(0.8, 0.6, 0.0), || Vec3::Z).expect("a way");
    assert!(slanted.distance(Vec3::Y) < 1e-3, "{slanted}");
    let head_on = wall.way_around(base, Vec3::X, || Vec3::Z).expect("a way");
    assert!(head_on.distance(Vec3::Y) < 1e-3, "{head_on}");
    let ceiling = obstacles([Shape::Plane { point: Vec3::Y * 5.0, normal: Vec3::NEG_Y }]);
    let under = ceiling.way_around(Vec3::Y * 4.6, Vec3::Y, || Vec3::Z).expect("a way");
    assert!(under.distance(Vec3::Z) < 1e-3, "{under}");
}

#[test]
fn there_is_no_way_out_of_a_solid() {
    let ball = obstacles([Shape::Sphere { centre: Vec3::ZERO, radius: 9.0 }]);
    assert_eq!(ball.way_around(Vec3::X, Vec3::Y, || Vec3::Z), None);
    assert!(ball.hides(Vec3::X, Vec3::Y * 30.0));
}

#[test]
fn an_open_mesh_blocks_as_a_sheet() {
    let corners = vec![Vec3::new(-5.0, 0.0, -5.0), Vec3::X * 9.0, Vec3::Z * 9.0];
    let sheet = TriangleMesh::new(corners, vec![[0, 1, 2]]).expect("a mesh");
    let sheet = obstacles([standing(sheet)]);
    for (from, to) in [(1.0, -1.0), (-1.0, 1.0)] {
        assert!(sheet.hides(Vec3::Y * from, Vec3::Y * to));
    }
    assert!(!sheet.contains(Vec3::Y * -0.5) && !sheet.hides(Vec3::Y * 2.0, Vec3::Y));
    assert!(sheet.blocks(Vec3::Y * 2.0, Vec3::Y * 0.1, CLEARANCE));
}

#[test]
fn a_hollow_mesh_is_solid_between_its_shells() {
    let (outer, inner) =
        (cuboid(Vec3::splat(-9.0), Vec3::splat(9.0)), cuboid(Vec3::splat(-3.0), Vec3::splat(3.0)));
    let vertices = [outer.vertices(), inner.vertices()].concat();
    let shifted = inner.triangles().iter().map(|corners| corners.map(|corner| corner + 8));
    let triangles = outer.triangles().iter().copied().chain(shifted).collect();
    let shell = obstacles([standing(TriangleMesh::new(vertices, triangles).expect("a mesh"))]);
    assert!(shell.contains(Vec3::X * 6.0));
    assert!(!shell.contains(Vec3::ZERO) && !shell.contains(Vec3::X * 10.0));
}
