//! Wood as triangles: a tube swept along each axis. A lateral begins inside its bearer, with a collar; a stub ends
//! with the face of its cut.

use std::f32::consts::TAU;

use espalier_plant::Plant;
use glam::{Vec2, Vec3};

use crate::{
    course::{Course, End, courses},
    curve::{Sample, samples},
    rotation_minimising,
    style::Style,
    triangle_mesh::TriangleMesh,
};

/// How far the flat sides of a tube may lie inside the round one, in internodes.
const CHORD_ERROR: f32 = 0.01;
const FEWEST_SIDES: u32 = 3;
const MOST_SIDES: u32 = 24;
/// Width of one tile of bark texture, in internodes.
const BARK_TILE: f32 = 1.0;

/// All living wood. Texture coordinates have square texels: u goes around in whole tiles, v along.
pub fn bark_mesh(plant: &Plant, style: &Style) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for course in courses(plant, style) {
        sweep(&mut mesh, &course);
    }
    mesh
}

/// Sides of a tube: as many as keep the error, between a prism and what looks round.
fn sides(radius: f32) -> u32 {
    let half_angle = libm::acosf((1.0 - CHORD_ERROR / radius).max(-1.0));
    ((TAU / (2.0 * half_angle)).ceil() as u32).clamp(FEWEST_SIDES, MOST_SIDES)
}

fn sweep(mesh: &mut TriangleMesh, course: &Course) {
    let samples = samples(course);
    let across = rotation_minimising::normals(samples.iter().map(|s| (s.point, s.tangent)), course.normal);
    let thickest = course.radii.iter().copied().fold(0.0, f32::max);
    let tube = Tube::new(sides(thickest), (TAU * thickest / BARK_TILE).round().max(1.0));
    let mut v = 0.0;
    let mut below = None;
    for (i, sample) in samples.iter().enumerate() {
        if let Some(last) = i.checked_sub(1).map(|last| &samples[last]) {
            v += tube.tiles_along(sample.arc - last.arc, 0.5 * (sample.radius + last.radius));
        }
        let ring = tube.add_ring(mesh, sample, across[i], slope(&samples, i), v);
        if let Some(below) = below {
            tube.join(mesh, below, ring);
        }
        below = Some(ring);
    }
    if let (Some(ring), Some(last)) = (below, samples.last()) {
        match course.end {
            End::Grown => tube.close(mesh, ring, last, v),
            End::Cut => tube.cut(mesh, ring, last, v),
        }
    }
}

/// How fast the radius grows along the axis.
fn slope(samples: &[Sample], i: usize) -> f32 {
    let (a, b) = (&samples[i.saturating_sub(1)], &samples[(i + 1).min(samples.len() - 1)]);
    let length = b.arc - a.arc;
    if length > 0.0 { (b.radius - a.radius) / length } else { 0.0 }
}

/// What all rings of one tube have in common.
struct Tube {
    tiles: f32,
    /// Cosine, sine and texture coordinate of each vertex of a ring; the seam's stand at both ends.
    around: Vec<(f32, f32, f32)>,
}

impl Tube {
    fn new(sides: u32, tiles: f32) -> Self {
        let around = (0..=sides).map(|side| {
            let turn = side as f32 / sides as f32;
            // The seam's two vertices must be at the same place to the last bit.
            let angle = if side == sides { 0.0 } else { TAU * turn };
            (libm::cosf(angle), libm::sinf(angle), tiles * turn)
        });
        Self { tiles, around: around.collect() }
    }

    fn sides(&self) -> u32 {
        self.around.len() as u32 - 1
    }

    /// Tiles along a piece, so many that texels are as long as they are wide.
    fn tiles_along(&self, length: f32, radius: f32) -> f32 {
        self.tiles * length / (TAU * radius)
    }

    /// Adds a ring and returns its first vertex.
    fn add_ring(&self, mesh: &mut TriangleMesh, sample: &Sample, across: Vec3, slope: f32, v: f32) -> u32 {
        let binormal = sample.tangent.cross(across);
        let first = mesh.positions.len() as u32;
        for &(cos, sin, u) in &self.around {
            let outward = across * cos + binormal * sin;
            let normal = (outward - sample.tangent * slope).normalize();
            mesh.vertex(sample.point + outward * sample.radius, normal, Vec2::new(u, v));
        }
        first
    }

    fn join(&self, mesh: &mut TriangleMesh, below: u32, above: u32) {
        for side in 0..self.sides() {
            mesh.triangle(below + side, below + side + 1, above + side + 1);
            mesh.triangle(below + side, above + side + 1, above + side);
        }
    }

    /// Closes the tip with a cone as high as it is wide.
    fn close(&self, mesh: &mut TriangleMesh, ring: u32, tip: &Sample, v: f32) {
        let apex = tip.point + tip.tangent * tip.radius;
        let v = v + self.tiles_along(tip.radius, tip.radius);
        for side in 0..self.sides() {
            // An apex for each side: one for all could have only one place in the texture.
            let u = self.tiles * (side as f32 + 0.5) / self.sides() as f32;
            let top = mesh.vertex(apex, tip.tangent, Vec2::new(u, v));
            mesh.triangle(ring + side, ring + side + 1, top);
        }
    }

    /// Closes a cut end with a flat face.
    fn cut(&self, mesh: &mut TriangleMesh, ring: u32, end: &Sample, v: f32) {
        // The rim once more, for the face has another normal than the sides; texels go on as they come over the rim.
        let rim = mesh.positions.len() as u32;
        for corner in ring..=ring + self.sides() {
            let corner = corner as usize;
            mesh.vertex(mesh.positions[corner], end.tangent, mesh.uvs[corner]);
        }
        let v = v + self.tiles_along(end.radius, end.radius);
        for side in 0..self.sides() {
            let u = self.tiles * (side as f32 + 0.5) / self.sides() as f32;
            let middle = mesh.vertex(end.point, end.tangent, Vec2::new(u, v));
            mesh.triangle(rim + side, rim + side + 1, middle);
        }
    }
}

#[cfg(test)]
mod tests {
    use espalier_plant::{AxisId, Internode, MetamerId};

    use super::*;
    use crate::{checks, style::StyleOptions};

    /// A straight trunk of some internodes with one lateral to +X at its first node.
    fn trunk(internodes: u32, lateral: bool) -> Plant {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        for height in 1..=internodes {
            let end = Vec3::Y * height as f32;
            plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::X, laterals: &[Vec3::X] });
        }
        if lateral {
            let internode = Internode { end: Vec3::new(1.0, 1.0, 0.0), normal: Vec3::Y, laterals: &[] };
            plant.extend(AxisId::new(1), &internode);
        }
        plant.end_step();
        plant
    }

    fn style(twig_diameter: f32) -> Style {
        Style::new(StyleOptions { twig_diameter, ..StyleOptions::default() })
    }

    /// The largest distance from the trunk's middle at a height.
    fn girth_at(mesh: &TriangleMesh, height: f32) -> f32 {
        let ring = mesh.positions.iter().filter(|p| (p.y - height).abs() < 1e-5);
        ring.map(|p| Vec3::new(p.x, 0.0, p.z).length()).fold(0.0, f32::max)
    }

    #[test]
    fn seed_alone_has_no_wood() {
        assert!(bark_mesh(&Plant::new(Vec3::ZERO), &Style::default()).is_empty());
    }

    #[test]
    fn sides_keep_the_chord_error() {
        // cos(36°) = 0.809, so a pentagon keeps 0.01 up to a radius of 0.0523.
        assert_eq!([0.004, 0.05, 0.053, 1.0, 100.0].map(sides), [3, 5, 6, 23, 24]);
    }

    #[test]
    fn trunk_is_round_faces_out_and_tapers() {
        let mesh = bark_mesh(&trunk(4, false), &style(0.1));
        assert_eq!(checks::mesh(&mesh), Ok(()));
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            let middle = (a + b + c) / 3.0;
            let outward = Vec3::new(middle.x, 0.0, middle.z);
            assert!((b - a).cross(c - a).dot(outward) > 0.0, "a triangle at {middle} faces inwards");
        }
        // The roots spread by 0.65; the tip is slim.
        assert!((girth_at(&mesh, 0.0) - 0.05 * 1.65).abs() < 1e-5);
        assert!((girth_at(&mesh, 3.0) - 0.05).abs() < 1e-5);
        assert!((girth_at(&mesh, 4.0) - 0.05 * 0.45).abs() < 1e-5);
    }

    #[test]
    fn lateral_begins_in_its_bearer_with_a_collar() {
        let plant = trunk(3, true);
        let courses = courses(&plant, &style(0.1));
        assert_eq!(courses.len(), 2);
        let lateral = &courses[1];
        assert_eq!((lateral.nodes[0], lateral.before), (Vec3::Y, Vec3::ZERO));
        let bearing = 0.05 * libm::powf(2.0, 0.4);
        let first = samples(lateral)[0].radius;
        assert!((first - 0.95 * bearing).abs() < 1e-5, "the collar is {first} wide on a trunk of {bearing}");
    }

    #[test]
    fn shed_wood_is_not_drawn() {
        let mut plant = trunk(3, true);
        let whole = bark_mesh(&plant, &style(0.1));
        plant.begin_step();
        plant.shed(&[AxisId::new(1)]);
        plant.end_step();
        let rest = bark_mesh(&plant, &style(0.1));
        assert!(rest.positions.len() < whole.positions.len());
        assert!(rest.bounds().is_some_and(|[_, high]| high.x < 0.2));
    }

    #[test]
    fn texels_are_square_and_close_at_the_seam() {
        let mesh = bark_mesh(&trunk(3, false), &style(1.0));
        // From node 1 to node 2 the radius is 0.5 and the flare nearly gone.
        let v_at = |height: f32| {
            let at =
                mesh.positions.iter().position(|p| (p.y - height).abs() < 1e-5).expect("a node has a ring");
            mesh.uvs[at].y
        };
        let circumference = TAU * 0.5;
        let tiles = circumference.round();
        assert!((v_at(2.0) - v_at(1.0) - tiles / circumference).abs() < 0.08);
        let (first, last) = (0, sides(0.5) as usize);
        assert_eq!(mesh.positions[first], mesh.positions[last]);
        assert_eq!((mesh.uvs[first].x, mesh.uvs[last].x), (0.0, tiles));
    }

    /// Sets the diameters of rows, then cuts a row off.
    fn edit(plant: &mut Plant, widths: &[(usize, f32)], cut: Option<usize>) {
        plant.begin_edit();
        for &(row, diameter) in widths {
            plant.set_width(MetamerId::new(row), Some(diameter));
        }
        if let Some(cut) = cut {
            plant.prune(&[MetamerId::new(cut)]);
        }
        plant.end_step();
    }

    #[test]
    fn stub_keeps_its_width_and_ends_flat() {
        let mut plant = trunk(5, false);
        edit(&mut plant, &[(3, 0.4)], Some(4));
        let mesh = bark_mesh(&plant, &style(0.1));
        assert_eq!(checks::mesh(&mesh), Ok(()));
        assert!(mesh.bounds().is_some_and(|[_, high]| (high.y - 3.0).abs() < 1e-6));
        assert!((girth_at(&mesh, 3.0) - 0.2).abs() < 1e-5 && (girth_at(&mesh, 2.0) - 0.2).abs() < 1e-4);
        // The face is a whole polygon of upright triangles.
        let mut face = 0.0;
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            if [a, b, c].iter().all(|p| (p.y - 3.0).abs() < 1e-5) {
                let area = 0.5 * (b - a).cross(c - a);
                assert!(area.y > 0.0 && area.x.abs() < 1e-6 && area.z.abs() < 1e-6);
                assert!(corners.iter().all(|&corner| mesh.normals[corner as usize].y > 0.999));
                face += area.y;
            }
        }
        let sides = sides(0.2) as f32;
        let polygon = 0.5 * sides * 0.04 * libm::sinf(TAU / sides);
        assert!((face - polygon).abs() < 1e-5, "the face has {face}, not {polygon}");
    }

    #[test]
    fn cut_without_a_width_is_a_twig() {
        let mut plant = trunk(5, true);
        edit(&mut plant, &[], Some(3));
        let mesh = bark_mesh(&plant, &style(0.1));
        assert_eq!(checks::mesh(&mesh), Ok(()));
        // As if nothing had been above, but neither slim nor pointed.
        assert!((girth_at(&mesh, 2.0) - 0.05).abs() < 1e-5);
        assert!(mesh.bounds().is_some_and(|[_, high]| high.y < 2.0 + 1e-5 && high.x > 1.0));
    }

    #[test]
    fn lateral_closes_the_cut_above_it() {
        let mut plant = trunk(5, true);
        edit(&mut plant, &[(1, 0.4)], Some(2));
        let courses = courses(&plant, &style(0.1));
        assert_eq!(courses.iter().map(|course| course.end).collect::<Vec<_>>(), [End::Grown; 2]);
        assert_eq!(courses[0].nodes, [Vec3::ZERO, Vec3::Y]);
        assert_eq!(checks::mesh(&bark_mesh(&plant, &style(0.1))), Ok(()));
    }

    #[test]
    fn constrained_tip_is_not_slim() {
        let mut plant = trunk(3, false);
        edit(&mut plant, &[(1, 0.8), (3, 0.2)], None);
        let mesh = bark_mesh(&plant, &style(0.1));
        // Halved and halved again; at the second node the flare of the roots is gone but for a thousandth.
        assert!((girth_at(&mesh, 2.0) - 0.2).abs() < 2e-3);
        assert!((girth_at(&mesh, 3.0) - 0.1).abs() < 1e-3);
    }
}
