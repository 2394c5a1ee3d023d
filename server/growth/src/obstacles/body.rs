//! Obstacles with what is computed from them once, and the questions each answers.

use std::sync::Arc;

use glam::{Mat3, Vec3};

use super::{Contact, mesh::TriangleMesh, shape::Shape};

/// An obstacle, ready to be asked.
#[derive(Clone, Debug)]
pub(super) enum Body {
    Box(Cuboid),
    Sphere { centre: Vec3, radius: f32 },
    Plane { point: Vec3, normal: Vec3 },
    Mesh(Placed),
}

/// A box and its axes.
#[derive(Clone, Debug)]
pub(super) struct Cuboid {
    centre: Vec3,
    half_extents: Vec3,
    world_from_box: Mat3,
}

/// A mesh and where it stands. What is asked is turned, not the mesh: moving it costs nothing.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    mesh: Arc<TriangleMesh>,
    position: Vec3,
    world_from_mesh: Mat3,
}

impl Body {
    /// The body of a valid shape.
    pub(super) fn new(shape: &Shape) -> Self {
        match shape {
            &Shape::Box { centre, half_extents, rotation } => {
                Self::Box(Cuboid { centre, half_extents, world_from_box: matrix(rotation.to_array()) })
            }
            &Shape::Sphere { centre, radius } => Self::Sphere { centre, radius },
            &Shape::Plane { point, normal } => Self::Plane { point, normal: normal.normalize() },
            Shape::Mesh { mesh, position, rotation } => Self::Mesh(Placed {
                mesh: Arc::clone(mesh),
                position: *position,
                world_from_mesh: matrix(rotation.to_array()),
            }),
        }
    }

    /// The box along the axes that holds the body, a hair too large.
    pub(super) fn bounds(&self) -> (Vec3, Vec3) {
        let around = |centre: Vec3, half: Vec3| {
            let half = half + (centre.abs() + half) * 1.0e-5;
            (centre - half, centre + half)
        };
        match self {
            Self::Box(cuboid) => around(cuboid.centre, extent(&cuboid.world_from_box, cuboid.half_extents)),
            &Self::Sphere { centre, radius } => around(centre, Vec3::splat(radius)),
            Self::Plane { .. } => (Vec3::NEG_INFINITY, Vec3::INFINITY),
            Self::Mesh(placed) => {
                let (low, high) = placed.mesh.bounds();
                let centre = placed.position + placed.world_from_mesh * (0.5 * (low + high));
                around(centre, extent(&placed.world_from_mesh, 0.5 * (high - low)))
            }
        }
    }

    /// Whether a place lies in the solid.
    pub(super) fn contains(&self, place: Vec3) -> bool {
        match self {
            Self::Box(cuboid) => {
                let local = cuboid.to_local(place - cuboid.centre);
                (cuboid.half_extents - local.abs()).min_element() > 0.0
            }
            Self::Sphere { centre, radius } => place.distance_squared(*centre) < radius * radius,
            Self::Plane { point, normal } => (place - *point).dot(*normal) < 0.0,
            Self::Mesh(placed) => placed.mesh.contains(placed.local(place)),
        }
    }

    /// How far along the way from one place to another the surface is met, from 0 to 1, and where. At once if
    /// the way begins in the solid.
    pub(super) fn hit(&self, from: Vec3, to: Vec3) -> Option<(f32, Contact)> {
        let along = to - from;
        match self {
            Self::Box(cuboid) => {
                let start = cuboid.to_local(from - cuboid.centre);
                let (t, normal) = cuboid.enter(start, cuboid.to_local(along), 1.0)?;
                let normal = cuboid.world_from_box * normal;
                Some((t, Contact { point: from + along * t, normal }))
            }
            Self::Sphere { centre, radius } => {
                let t = enter_sphere(from - *centre, along, *radius, 1.0)?;
                let point = from + along * t;
                Some((t, Contact { point, normal: (point - *centre).try_normalize().unwrap_or(Vec3::Y) }))
            }
            Self::Plane { point, normal } => {
                let height = (from - *point).dot(*normal);
                let end = (to - *point).dot(*normal);
                let t = if height < 0.0 { 0.0 } else { height / (height - end) };
                let meets = height < 0.0 || end < 0.0;
                meets.then(|| (t, Contact { point: from + along * t, normal: *normal }))
            }
            Self::Mesh(placed) => {
                let (t, normal) = placed.mesh.first_hit(placed.local(from), placed.turned(along))?;
                Some((t, Contact { point: from + along * t, normal: placed.world_from_mesh * normal }))
            }
        }
    }

    /// The nearest point of the surface, if it is nearer than `clearance` to a place outside.
    pub(super) fn near(&self, place: Vec3, clearance: f32) -> Option<Contact> {
        match self {
            Self::Box(cuboid) => {
                let local = cuboid.to_local(place - cuboid.centre);
                let nearest = local.clamp(-cuboid.half_extents, cuboid.half_extents);
                let point = cuboid.centre + cuboid.world_from_box * nearest;
                contact_within(place, point, clearance)
            }
            Self::Sphere { centre, radius } => {
                let normal = (place - *centre).try_normalize().unwrap_or(Vec3::Y);
                let gap = place.distance(*centre) - radius;
                (gap < clearance).then(|| Contact { point: *centre + normal * *radius, normal })
            }
            Self::Plane { point, normal } => {
                let height = (place - *point).dot(*normal);
                (height < clearance).then(|| Contact { point: place - *normal * height, normal: *normal })
            }
            Self::Mesh(placed) => {
                let nearest = placed.mesh.nearest(placed.local(place), clearance)?;
                contact_within(place, placed.position + placed.world_from_mesh * nearest, clearance)
            }
        }
    }

    /// Whether a ray meets the body, however far away.
    pub(super) fn meets_ray(&self, from: Vec3, direction: Vec3) -> bool {
        match self {
            Self::Box(cuboid) => {
                let start = cuboid.to_local(from - cuboid.centre);
                cuboid.enter(start, cuboid.to_local(direction), f32::INFINITY).is_some()
            }
            Self::Sphere { centre, radius } => {
                enter_sphere(from - *centre, direction, *radius, f32::INFINITY).is_some()
            }
            Self::Plane { point, normal } => {
                (from - *point).dot(*normal) < 0.0 || direction.dot(*normal) < 0.0
            }
            Self::Mesh(placed) => placed.mesh.meets_ray(placed.local(from), placed.turned(direction)),
        }
    }
}

impl Placed {
    /// A place as the mesh sees it.
    fn local(&self, place: Vec3) -> Vec3 {
        self.turned(place - self.position)
    }

    /// A direction as the mesh sees it.
    fn turned(&self, direction: Vec3) -> Vec3 {
        self.world_from_mesh.transpose() * direction
    }
}

impl Cuboid {
    fn to_local(&self, v: Vec3) -> Vec3 {
        self.world_from_box.transpose() * v
    }

    /// When a moving point enters the box around the origin, and the normal of the face it passes; at once if
    /// it is inside.
    fn enter(&self, start: Vec3, along: Vec3, end: f32) -> Option<(f32, Vec3)> {
        let (mut since, mut until, mut face) = (0.0f32, end, None);
        for axis in 0..3 {
            let (at, speed, half) = (start[axis], along[axis], self.half_extents[axis]);
            if speed == 0.0 {
                if at.abs() > half {
                    return None;
                }
                continue;
            }
            let enters = (-half * speed.signum() - at) / speed;
            let leaves = (half * speed.signum() - at) / speed;
            if enters > since {
                since = enters;
                face = Some((axis, -speed.signum()));
            }
            until = until.min(leaves);
        }
        if since > until {
            return None;
        }
        let (axis, sign) = face.unwrap_or_else(|| self.nearest_face(start));
        let mut normal = Vec3::ZERO;
        normal[axis] = sign;
        Some((since, normal))
    }

    /// The face a point in the box is nearest to.
    fn nearest_face(&self, inside: Vec3) -> (usize, f32) {
        let depth = self.half_extents - inside.abs();
        let axis = (0..3).min_by(|&a, &b| depth[a].total_cmp(&depth[b])).unwrap_or(1);
        (axis, if inside[axis] < 0.0 { -1.0 } else { 1.0 })
    }
}

/// Half the size of the box along the world's axes around a turned box of this half size.
fn extent(world_from_box: &Mat3, half: Vec3) -> Vec3 {
    let Mat3 { x_axis, y_axis, z_axis } = world_from_box;
    x_axis.abs() * half.x + y_axis.abs() * half.y + z_axis.abs() * half.z
}

fn contact_within(place: Vec3, point: Vec3, clearance: f32) -> Option<Contact> {
    let gap = place.distance(point);
    let normal = (place - point).try_normalize().unwrap_or(Vec3::Y);
    (gap < clearance).then_some(Contact { point, normal })
}

/// When a moving point enters the ball around the origin, if by `end`; at once if it is inside.
fn enter_sphere(start: Vec3, along: Vec3, radius: f32, end: f32) -> Option<f32> {
    let c = start.length_squared() - radius * radius;
    if c < 0.0 {
        return Some(0.0);
    }
    let (a, b) = (along.length_squared(), start.dot(along));
    let under_root = b * b - a * c;
    if b >= 0.0 || under_root < 0.0 {
        return None;
    }
    // In this form nothing cancels: b is negative.
    let t = c / (under_root.sqrt() - b);
    (t <= end).then_some(t)
}

/// The rotation of a quaternion of length 1 or nearly, in plain arithmetic that rounds alike everywhere.
fn matrix([x, y, z, w]: [f32; 4]) -> Mat3 {
    let s = 2.0 / (x * x + y * y + z * z + w * w);
    Mat3::from_cols(
        Vec3::new(1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)),
        Vec3::new(s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x)),
        Vec3::new(s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y)),
    )
}
