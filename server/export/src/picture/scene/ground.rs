//! What a plant stands on: a pot, and the ground.

use espalier_growth::species::Stand;
use espalier_mesh::TriangleMesh;
use glam::{Vec2, Vec3};

use super::meshes::{Painted, Skin};
use crate::colour::linear;

/// Puts a pot under the plant; returns the height of the ground.
pub(super) fn stand(meshes: &mut Vec<(Skin, Painted)>, stand: Stand, reach: f32) -> f32 {
    let (half_width, half_depth, height, taper) = match stand {
        Stand::Ground => return 0.0,
        Stand::Tray => (0.42 * reach, 0.26 * reach, 0.11 * reach, 0.86),
        Stand::Pot => (0.2 * reach, 0.2 * reach, 0.42 * reach, 0.78),
    };
    let glaze = linear([92, 62, 50]);
    let mut pot = Painted::default();
    // From the inside of the rim over its edge down to the foot: height, width, colour.
    let soil = linear([74, 84, 48]);
    let profile = [
        (-0.02, 0.0, soil),
        (-0.02, 0.95, soil),
        (0.0, 0.95, glaze),
        (0.0, 1.0, glaze),
        (-0.16, 1.0, glaze),
        (-0.16, 0.95, glaze),
        (-1.0, taper, glaze),
    ];
    const SIDES: u32 = 48;
    for pair in profile.windows(2) {
        let first = pot.mesh.positions.len() as u32;
        for side in 0..=SIDES {
            let (sin, cos) = libm::sincosf(std::f32::consts::TAU * side as f32 / SIDES as f32);
            // A square with round corners.
            let swell = |c: f32| c.signum() * libm::powf(c.abs(), 0.5);
            let out = Vec3::new(swell(cos), 0.0, swell(sin));
            for &(level, width, colour) in pair {
                let place = Vec3::new(out.x * half_width * width, level * height, out.z * half_depth * width);
                let flat = (pair[0].0 - pair[1].0).abs() < 0.01;
                let normal = if flat { Vec3::Y } else { Vec3::new(cos, 0.15, sin).normalize() };
                pot.mesh.vertex(place, normal, Vec2::ZERO);
                pot.colours.push(colour);
            }
        }
        for side in 0..SIDES {
            let corner = first + 2 * side;
            pot.mesh.triangle(corner, corner + 1, corner + 2);
            pot.mesh.triangle(corner + 1, corner + 2, corner + 3);
        }
    }
    meshes.push((Skin::Glaze, pot));
    -height
}

/// Puts a lawn at the height `base`, as far as can be seen.
pub(super) fn ground(meshes: &mut Vec<(Skin, Painted)>, base: f32, reach: f32) {
    let mut mesh = TriangleMesh::default();
    let far = 8.0 * reach;
    for (x, z) in [(-far, -far), (far, -far), (far, far), (-far, far)] {
        mesh.vertex(Vec3::new(x, base - 1e-3, z), Vec3::Y, Vec2::ZERO);
    }
    mesh.triangle(0, 1, 2);
    mesh.triangle(0, 2, 3);
    let colours = vec![Vec3::ONE; mesh.positions.len()];
    meshes.push((
        Skin::Ground,
        Painted { mesh, colours, texture: None, riders: Vec::new(), grids: Vec::new() },
    ));
}
