//! Wood as triangles: a tube swept along each axis. A lateral begins inside its bearer, with a collar; a stub ends
//! with the face of its cut.

use std::f32::consts::TAU;

use espalier_plant::{AxisId, MetamerId, Plant};
use espalier_settings::{BARK_SQUARES, BarkLook, THINNEST_BARK};
use glam::{Vec2, Vec3, Vec4};

use crate::{
    course::{Course, End, courses},
    curve::{Sample, samples},
    grain::Grain,
    rotation_minimising,
    sheet::{Closing, Sheet},
    style::Style,
    triangle_mesh::TriangleMesh,
};

const FEWEST_SIDES: u32 = 3;
/// Normals lean no further along the axis than this slope has them: beside a bend they would belong to its other side.
const STEEPEST: f32 = 0.8;

/// The wood of one plant: a closed body for each axis, so that no edge is open; bodies lie one in another where a branch
/// begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Wood {
    /// The seed that the plant has grown from.
    pub seed: MetamerId,
    /// All of it but the faces of cuts. Texture coordinates have square texels: u goes around in whole squares of bark, v
    /// along.
    pub surface: TriangleMesh,
    /// The faces of cuts, as triangles of the same vertices.
    pub cuts: Vec<u32>,
    /// How thick the wood is at each vertex: its radius in internodes.
    pub radii: Vec<f32>,
    /// At each vertex the unit vector along which u grows, and ±1 for the side of the normal on which v does.
    pub tangents: Vec<Vec4>,
}

/// All living wood, plant by plant in the order of their seeds; none of a seed that has not grown.
pub fn wood(plant: &Plant, style: &Style, look: &BarkLook) -> Vec<Wood> {
    let mut plants: Vec<Wood> = Vec::new();
    for body in Bodies::of(plant, style, look, Grain::default()).iter() {
        let seed = body.seed();
        let at = plants.binary_search_by_key(&seed, |wood| wood.seed).unwrap_or_else(|at| {
            plants.insert(at, Wood::of(seed));
            at
        });
        body.sweep(&mut plants[at]);
    }
    plants
}

/// The living wood of a scene, whose bodies are made one by one: so little is held of what takes much room.
#[derive(Clone, Debug)]
pub struct Bodies {
    courses: Vec<Course>,
    smoothing: f32,
    grain: Grain,
}

impl Bodies {
    /// All axes that are drawn in such a grain, in their order.
    pub fn of(plant: &Plant, style: &Style, look: &BarkLook, grain: Grain) -> Self {
        let thinnest = 0.5 * style.options().twig_diameter * grain.thinnest;
        let mut courses = courses(plant, style, look);
        courses.retain(|course| course.radii.iter().copied().fold(0.0, f32::max) >= thinnest);
        Self { courses, smoothing: look.smoothing, grain }
    }

    /// The bodies, one for each axis.
    pub fn iter(&self) -> impl Iterator<Item = Body<'_>> {
        self.courses.iter().map(|course| Body { course, smoothing: self.smoothing, grain: self.grain })
    }
}

/// The closed body of one axis, which is still to be made.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    course: &'a Course,
    smoothing: f32,
    grain: Grain,
}

impl Body<'_> {
    /// The seed that its plant has grown from.
    pub fn seed(&self) -> MetamerId {
        self.course.seed
    }

    /// The axis whose wood it is.
    pub fn axis(&self) -> AxisId {
        self.course.axis
    }

    /// Where it begins: a node of its bearer, or the seed.
    pub fn foot(&self) -> Vec3 {
        self.course.nodes[0]
    }

    /// Makes it, adds it to others and says how it hangs together; none where it has no length.
    pub fn sweep(&self, wood: &mut Wood) -> Option<Sheet> {
        wood.sweep(self.course, self.smoothing, &self.grain)
    }
}

/// Sides of a tube: as many as keep the error, between a prism and what looks round.
fn sides(radius: f32, grain: &Grain) -> u32 {
    let half_angle = libm::acosf((1.0 - grain.chord_error / radius).max(-1.0));
    ((TAU / (2.0 * half_angle)).ceil() as u32).clamp(FEWEST_SIDES, grain.most_sides)
}

/// Squares of bark around a tube.
fn squares(radius: f32) -> f32 {
    let octave = libm::log2f((radius / THINNEST_BARK).max(1.0)).round() as usize;
    f32::from(BARK_SQUARES[octave.min(BARK_SQUARES.len() - 1)])
}

/// How fast the radius grows along the axis at each place, as normals have it.
fn slopes(samples: &[Sample], end: End) -> Vec<f32> {
    let slope = |a: &Sample, b: &Sample| {
        let length = b.arc - a.arc;
        if length > 0.0 { (b.radius - a.radius) / length } else { 0.0 }
    };
    let last = samples.len() - 1;
    // A grown tip is a cone as high as it is wide.
    let tip = if end == End::Grown { -1.0 } else { 0.0 };
    let at = |i: usize| {
        let (below, above) = (&samples[i.saturating_sub(1)], &samples[(i + 1).min(last)]);
        let beside = [slope(below, &samples[i]), if i < last { slope(&samples[i], above) } else { tip }];
        // Where wood swells and shrinks at once, a normal still belongs to the surface on both sides.
        let limited = |mean: f32, side: f32| if mean * side < -0.5 { -0.5 / side } else { mean };
        beside.into_iter().fold(slope(below, above), limited).clamp(-STEEPEST, STEEPEST)
    };
    (0..samples.len()).map(at).collect()
}

impl Wood {
    /// No wood yet, of the plant of a seed.
    pub fn of(seed: MetamerId) -> Self {
        let (surface, cuts, radii, tangents) = Default::default();
        Self { seed, surface, cuts, radii, tangents }
    }

    /// Forgets all triangles, but not their room.
    pub fn clear(&mut self) {
        self.surface.clear();
        self.cuts.clear();
        self.radii.clear();
        self.tangents.clear();
    }

    /// All its triangles, the faces of cuts last.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let (surface, cuts) = (self.surface.indices.as_chunks::<3>().0, self.cuts.as_chunks::<3>().0);
        surface.iter().chain(cuts).copied()
    }

    /// All its triangles as one mesh, the faces of cuts last.
    pub fn into_mesh(mut self) -> TriangleMesh {
        self.surface.indices.append(&mut self.cuts);
        self.surface
    }

    fn sweep(&mut self, course: &Course, smoothing: f32, grain: &Grain) -> Option<Sheet> {
        let samples = samples(course, smoothing, grain.tolerance);
        let [first, .., last] = &samples[..] else { return None };
        let across = rotation_minimising::normals(samples.iter().map(|sample| sample.tangent), course.normal);
        let thickest = course.radii.iter().copied().fold(0.0, f32::max);
        let slopes = slopes(&samples, course.end);
        let tube = Tube::new(sides(thickest, grain), squares(thickest));
        let foot = self.add_ring(&tube, first, across[0], slopes[0], 0.0);
        let mut rings = vec![foot];
        let face = self.count();
        let back = self.add_face(&tube, foot, first, -first.tangent, 0.0);
        for triangle in back.as_chunks::<3>().0 {
            let &[a, b, c] = triangle;
            self.surface.triangle(b, a, c);
        }
        let (mut v, mut below) = (0.0, foot);
        for (i, pair) in samples.windows(2).enumerate() {
            let [from, to] = pair else { continue };
            v += tube.tiles_along(to.arc - from.arc, 0.5 * (to.radius + from.radius));
            let ring = self.add_ring(&tube, to, across[i + 1], slopes[i + 1], v);
            self.join(&tube, below, ring);
            rings.push(ring);
            below = ring;
        }
        let top = self.count();
        let end = match course.end {
            End::Grown => {
                self.close(&tube, below, last, v);
                Closing::Cone(top)
            }
            End::Cut => {
                let face = self.add_face(&tube, below, last, last.tangent, v);
                self.cuts.extend(face);
                Closing::Face(top)
            }
        };
        Some(Sheet { sides: tube.sides(), rings, foot: face, end })
    }

    /// Vertices so far.
    fn count(&self) -> u32 {
        self.radii.len() as u32
    }

    fn vertex(&mut self, position: Vec3, normal: Vec3, uv: Vec2, radius: f32, tangent: Vec4) -> u32 {
        self.radii.push(radius);
        self.tangents.push(tangent);
        self.surface.vertex(position, normal, uv)
    }

    /// The tangent half-way between a vertex of a ring and the next one.
    fn between(&self, corner: u32) -> Vec4 {
        let [a, b] = [corner, corner + 1].map(|corner| self.tangents[corner as usize]);
        (a + b).truncate().normalize_or(a.truncate()).extend(a.w)
    }

    /// Adds a ring and returns its first vertex.
    fn add_ring(&mut self, tube: &Tube, sample: &Sample, across: Vec3, slope: f32, v: f32) -> u32 {
        let binormal = sample.tangent.cross(across);
        let first = self.count();
        for &(cos, sin, u) in &tube.around {
            let outward = across * cos + binormal * sin;
            let normal = (outward - sample.tangent * slope).normalize();
            let place = sample.point + outward * sample.radius;
            let around = (binormal * cos - across * sin).extend(1.0);
            self.vertex(place, normal, Vec2::new(u, v), sample.radius, around);
        }
        first
    }

    fn join(&mut self, tube: &Tube, below: u32, above: u32) {
        for side in 0..tube.sides() {
            self.surface.triangle(below + side, below + side + 1, above + side + 1);
            self.surface.triangle(below + side, above + side + 1, above + side);
        }
    }

    /// Closes the tip with a cone as high as it is wide.
    fn close(&mut self, tube: &Tube, ring: u32, tip: &Sample, v: f32) {
        let apex = tip.point + tip.tangent * tip.radius;
        let v = v + tube.tiles_along(tip.radius, tip.radius);
        for side in 0..tube.sides() {
            // An apex for each side: one for all could have only one place in the texture.
            let around = self.between(ring + side);
            let top = self.vertex(apex, tip.tangent, Vec2::new(tube.middle(side), v), tip.radius, around);
            self.surface.triangle(ring + side, ring + side + 1, top);
        }
    }

    /// The triangles of a flat face over a ring, as seen from above it.
    fn add_face(&mut self, tube: &Tube, ring: u32, end: &Sample, normal: Vec3, v: f32) -> Vec<u32> {
        // The rim once more, for the face has another normal than the sides; texels go on as they come over the rim.
        let rim = self.count();
        // Seen from behind v still grows inwards.
        let hand = if normal.dot(end.tangent) < 0.0 { -1.0 } else { 1.0 };
        for corner in (ring..=ring + tube.sides()).map(|corner| corner as usize) {
            let (place, uv) = (self.surface.positions[corner], self.surface.uvs[corner]);
            let around = self.tangents[corner].truncate().extend(hand);
            self.vertex(place, normal, uv, end.radius, around);
        }
        let v = v + tube.tiles_along(end.radius, end.radius);
        let triangle = |side| {
            let around = self.between(rim + side);
            let middle = self.vertex(end.point, normal, Vec2::new(tube.middle(side), v), end.radius, around);
            [rim + side, rim + side + 1, middle]
        };
        (0..tube.sides()).flat_map(triangle).collect()
    }
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

    /// The texture coordinate of a side's middle.
    fn middle(&self, side: u32) -> f32 {
        self.tiles * (side as f32 + 0.5) / self.sides() as f32
    }

    /// Tiles along a piece, so many that texels are as long as they are wide.
    fn tiles_along(&self, length: f32, radius: f32) -> f32 {
        self.tiles * length / (TAU * radius)
    }
}

#[cfg(test)]
mod tests {
    use espalier_plant::Internode;

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

    fn courses_of(plant: &Plant) -> Vec<Course> {
        courses(plant, &style(0.1), &BarkLook::default())
    }

    /// The wood of the only plant, which is closed.
    fn wood_of(plant: &Plant, style: &Style) -> Wood {
        let mut plants = wood(plant, style, &BarkLook::default());
        let wood = plants.pop().expect("it has grown");
        assert!(plants.is_empty());
        assert_eq!(checks::wood(&wood), Ok(()));
        wood
    }

    fn bark_of(plant: &Plant, style: &Style) -> TriangleMesh {
        wood_of(plant, style).surface
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
        assert!(wood(&Plant::new(Vec3::ZERO), &Style::default(), &BarkLook::default()).is_empty());
    }

    #[test]
    fn sides_keep_the_chord_error() {
        // cos(36°) = 0.809, so a pentagon keeps 0.01 up to a radius of 0.0523.
        assert_eq!(
            [0.004, 0.05, 0.053, 1.0, 100.0].map(|radius| sides(radius, &Grain::default())),
            [3, 5, 6, 23, 24]
        );
    }

    #[test]
    fn trunk_is_round_faces_out_and_tapers() {
        let mesh = bark_of(&trunk(4, false), &style(0.1));
        // The roots spread by 0.65; the tip is slim.
        assert!((girth_at(&mesh, 0.0) - 0.05 * 1.65).abs() < 1e-5);
        assert!((girth_at(&mesh, 3.0) - 0.05).abs() < 1e-5);
        assert!((girth_at(&mesh, 4.0) - 0.05 * 0.45).abs() < 1e-5);
    }

    #[test]
    fn lateral_begins_in_its_bearer_with_a_collar() {
        let plant = trunk(3, true);
        let courses = courses_of(&plant);
        assert_eq!(courses.len(), 2);
        let lateral = &courses[1];
        assert_eq!((lateral.nodes[0], lateral.before), (Vec3::Y, Vec3::ZERO));
        let bearing = 0.05 * libm::powf(2.0, 0.4);
        let first = samples(lateral, 1.0, 0.0)[0].radius;
        assert!((first - 0.95 * bearing).abs() < 1e-5, "the collar is {first} wide on a trunk of {bearing}");
    }

    #[test]
    fn shed_wood_is_not_drawn() {
        let mut plant = trunk(3, true);
        let whole = bark_of(&plant, &style(0.1));
        plant.begin_step();
        plant.shed(&[AxisId::new(1)]);
        plant.end_step();
        let rest = bark_of(&plant, &style(0.1));
        assert!(rest.positions.len() < whole.positions.len());
        assert!(rest.bounds().is_some_and(|[_, high]| high.x < 0.2));
    }

    #[test]
    fn texels_are_square_and_close_at_the_seam() {
        let mesh = bark_of(&trunk(3, false), &style(1.0));
        // From node 1 to node 2 the radius is 0.5 and the flare nearly gone.
        let v_at = |height: f32| {
            let at =
                mesh.positions.iter().position(|p| (p.y - height).abs() < 1e-5).expect("a node has a ring");
            mesh.uvs[at].y
        };
        let circumference = TAU * 0.5;
        let tiles = squares(0.5);
        assert_eq!(tiles, 1.0);
        assert!((v_at(2.0) - v_at(1.0) - tiles / circumference).abs() < 0.08);
        let (first, last) = (0, sides(0.5, &Grain::default()) as usize);
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
        let wood = wood_of(&plant, &style(0.1));
        let mesh = &wood.surface;
        assert!(mesh.bounds().is_some_and(|[_, high]| (high.y - 3.0).abs() < 1e-6));
        assert!((girth_at(mesh, 3.0) - 0.2).abs() < 1e-5 && (girth_at(mesh, 2.0) - 0.2).abs() < 1e-4);
        // The face is a whole polygon of upright triangles.
        let mut face = 0.0;
        for corners in wood.cuts.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            let area = 0.5 * (b - a).cross(c - a);
            assert!(area.y > 0.0 && area.x.abs() < 1e-6 && area.z.abs() < 1e-6);
            assert!(corners.iter().all(|&corner| mesh.normals[corner as usize].y > 0.999));
            face += area.y;
        }
        let sides = sides(0.2, &Grain::default()) as f32;
        let polygon = 0.5 * sides * 0.04 * libm::sinf(TAU / sides);
        assert!((face - polygon).abs() < 1e-5, "the face has {face}, not {polygon}");
    }

    #[test]
    fn cut_without_a_width_is_a_twig() {
        let mut plant = trunk(5, true);
        edit(&mut plant, &[], Some(3));
        let mesh = bark_of(&plant, &style(0.1));
        // As if nothing had been above, but neither slim nor pointed.
        assert!((girth_at(&mesh, 2.0) - 0.05).abs() < 1e-5);
        assert!(mesh.bounds().is_some_and(|[_, high]| high.y < 2.0 + 1e-5 && high.x > 1.0));
    }

    #[test]
    fn lateral_closes_the_cut_above_it() {
        let mut plant = trunk(5, true);
        edit(&mut plant, &[(1, 0.4)], Some(2));
        let courses = courses_of(&plant);
        assert_eq!(courses.iter().map(|course| course.end).collect::<Vec<_>>(), [End::Grown; 2]);
        assert_eq!(courses[0].nodes, [Vec3::ZERO, Vec3::Y]);
        bark_of(&plant, &style(0.1));
    }

    #[test]
    fn constrained_tip_is_not_slim() {
        let mut plant = trunk(3, false);
        edit(&mut plant, &[(1, 0.8), (3, 0.2)], None);
        let mesh = bark_of(&plant, &style(0.1));
        // Halved and halved again; at the second node the flare of the roots is gone but for a thousandth.
        assert!((girth_at(&mesh, 2.0) - 0.2).abs() < 2e-3);
        assert!((girth_at(&mesh, 3.0) - 0.1).abs() < 1e-3);
    }
}
