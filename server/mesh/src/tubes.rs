//! Wood as triangles: a tube swept along each limb. A lateral begins inside its bearer, with a collar; a stub ends
//! with the face of its cut.

use std::{f32::consts::TAU, sync::Arc};

use espalier_plant::{AxisId, MetamerId, Plant};
use espalier_settings::{BARK_SQUARES, BarkLook, THINNEST_BARK};
use glam::{Vec2, Vec3, Vec4};

use crate::{
    drawn::{
        course::{Course, Courses, End, Flare, ribs},
        curve::{Sample, samples},
    },
    grain::Grain,
    limbs::Limbs,
    rotation_minimising,
    sheet::{Closing, Sheet},
    style::Style,
    triangle_mesh::TriangleMesh,
};

const FEWEST_SIDES: u32 = 3;
/// Normals lean no further along the axis than this slope has them: beside a bend they would belong to its other side.
const STEEPEST: f32 = 0.8;
/// A tube of fewer sides shows no ribs at its foot: they would fall between its corners.
const LEAST_RIBBED: u32 = 14;

/// The wood of one plant: a closed body for each limb, so that no edge is open; bodies lie one in another where a branch
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
    /// Whose surface it is at each vertex.
    pub metamers: Vec<MetamerId>,
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
    courses: Arc<Courses>,
    smoothing: f32,
    grain: Grain,
    /// Radius of the thinnest twigs.
    twig: f32,
}

impl Bodies {
    /// All limbs that are drawn in such a grain, those that bear before those that are borne.
    pub fn of(plant: &Plant, style: &Style, look: &BarkLook, grain: Grain) -> Self {
        let courses = Arc::new(Courses::of(plant, style, look));
        Self { courses, smoothing: look.smoothing, grain, twig: 0.5 * style.options().twig_diameter }
    }

    /// The same wood in another grain.
    pub fn in_grain(&self, grain: Grain) -> Self {
        Self { courses: Arc::clone(&self.courses), grain, ..*self }
    }

    /// The bodies, one for each limb.
    pub fn iter(&self) -> impl Iterator<Item = Body<'_>> {
        let thickest = |course: &Course| course.nodes.iter().map(|node| node.radius).fold(0.0, f32::max);
        let thinnest = self.twig * self.grain.thinnest;
        let courses = self.courses.all.iter().filter(move |course| thickest(course) >= thinnest);
        courses.map(|course| Body { course, smoothing: self.smoothing, grain: self.grain })
    }

    /// Which rows are one limb.
    pub fn limbs(&self) -> &Limbs {
        &self.courses.limbs
    }

    /// Where the node of each metamer is drawn, by rows.
    pub fn places(&self) -> &[Vec3] {
        &self.courses.places
    }
}

/// The closed body of one limb, which is still to be made.
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

    /// The axis that it begins with; it may go on along others.
    pub fn axis(&self) -> AxisId {
        self.course.axis
    }

    /// Its metamers, base first.
    pub fn metamers(&self) -> &[MetamerId] {
        &self.course.rows
    }

    /// Where its nodes are drawn: the one at which it begins, and that of each metamer.
    pub fn nodes(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.course.nodes.iter().map(|node| node.place)
    }

    /// Where it begins: a node of its bearer, or the seed.
    pub fn foot(&self) -> Vec3 {
        self.course.nodes[0].place
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
    let last = samples.len() - 1;
    // A grown tip is a cone as high as it is wide.
    let tip = if end == End::Grown { -1.0 } else { 0.0 };
    let at = |i: usize| {
        let (below, above) = (&samples[i.saturating_sub(1)], &samples[(i + 1).min(last)]);
        let beside = [rise(below, &samples[i]), if i < last { rise(&samples[i], above) } else { tip }];
        // Where wood swells and shrinks at once, a normal still belongs to the surface on both sides.
        let limited = |mean: f32, side: f32| if mean * side < -0.5 { -0.5 / side } else { mean };
        beside.into_iter().fold(rise(below, above), limited).clamp(-STEEPEST, STEEPEST)
    };
    (0..samples.len()).map(at).collect()
}

/// How fast the radius grows from one place to another.
fn rise(a: &Sample, b: &Sample) -> f32 {
    let length = b.arc - a.arc;
    if length > 0.0 { (b.radius - a.radius) / length } else { 0.0 }
}

/// How fast ribs of roots rise along the axis at each place.
fn rib_slopes(samples: &[Sample]) -> Vec<f32> {
    let at = |i: usize| {
        let (below, above) = (&samples[i.saturating_sub(1)], &samples[(i + 1).min(samples.len() - 1)]);
        let length = above.arc - below.arc;
        if length > 0.0 { (above.ribs - below.ribs) / length } else { 0.0 }
    };
    (0..samples.len()).map(at).collect()
}

impl Wood {
    /// No wood yet, of the plant of a seed.
    pub fn of(seed: MetamerId) -> Self {
        let (surface, cuts, radii, metamers, tangents) = Default::default();
        Self { seed, surface, cuts, radii, metamers, tangents }
    }

    /// Forgets all triangles, but not their room.
    pub fn clear(&mut self) {
        self.surface.clear();
        self.cuts.clear();
        self.radii.clear();
        self.metamers.clear();
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
        let mut samples = samples(course, smoothing, grain.tolerance);
        let before = self.marks();
        loop {
            let last = samples.len().checked_sub(1).filter(|&last| last > 0)?;
            match self.sweep_through(&samples, course, grain) {
                Ok(sheet) => return Some(sheet),
                // Rings that differ much in width and direction may have skin between them that is turned over.
                Err(ring) => {
                    self.go_back(before);
                    if last > 1 {
                        samples.remove(if ring == last { ring - 1 } else { ring });
                    } else {
                        let along = (samples[1].point - samples[0].point).normalize_or(samples[0].tangent);
                        samples.iter_mut().for_each(|sample| sample.tangent = along);
                    }
                }
            }
        }
    }

    /// Sweeps a tube through at least two rings; gives the number of one that cannot stand on the one below.
    fn sweep_through(&mut self, samples: &[Sample], course: &Course, grain: &Grain) -> Result<Sheet, usize> {
        let (first, last) = (&samples[0], &samples[samples.len() - 1]);
        let are_parallel = samples.len() == 2 && first.tangent == last.tangent;
        let thickest = course.nodes.iter().map(|node| node.radius).fold(0.0, f32::max);
        let across = rotation_minimising::normals(samples.iter().map(|sample| sample.tangent), course.normal);
        let (slopes, rib_slopes) = (slopes(samples, course.end), rib_slopes(samples));
        let rises = matches!(course.flare, Flare::Roots { .. });
        let tube = Tube::new(sides(thickest, grain), squares(thickest), rises);
        let foot = self.add_ring(&tube, first, across[0], [slopes[0], rib_slopes[0]], 0.0);
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
            // Bark follows the surface, which is longer than the axis where wood spreads.
            let way = Vec2::new(to.arc - from.arc, to.radius - from.radius).length();
            v += tube.tiles_along(way, 0.5 * (to.radius + from.radius));
            let slopes = [slopes[i + 1], rib_slopes[i + 1]];
            let ring = self.add_ring(&tube, to, across[i + 1], slopes, v);
            if !self.join(&tube, below, ring) && !are_parallel {
                return Err(i + 1);
            }
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
        Ok(Sheet { sides: tube.sides(), rings, foot: face, end })
    }

    /// How many vertices, indices and indices of cuts there are.
    fn marks(&self) -> [usize; 3] {
        [self.radii.len(), self.surface.indices.len(), self.cuts.len()]
    }

    /// Forgets what was added since.
    fn go_back(&mut self, [vertices, indices, cuts]: [usize; 3]) {
        self.surface.positions.truncate(vertices);
        self.surface.normals.truncate(vertices);
        self.surface.uvs.truncate(vertices);
        self.surface.indices.truncate(indices);
        self.cuts.truncate(cuts);
        self.radii.truncate(vertices);
        self.metamers.truncate(vertices);
        self.tangents.truncate(vertices);
    }

    /// Vertices so far.
    fn count(&self) -> u32 {
        self.radii.len() as u32
    }

    /// Adds a vertex of a ring, or of what closes it.
    fn vertex(&mut self, position: Vec3, normal: Vec3, uv: Vec2, ring: &Sample, tangent: Vec4) -> u32 {
        self.radii.push(ring.radius);
        self.metamers.push(ring.metamer);
        self.tangents.push(tangent);
        self.surface.vertex(position, normal, uv)
    }

    /// The tangent half-way between a vertex of a ring and the next one.
    fn between(&self, corner: u32) -> Vec4 {
        let [a, b] = [corner, corner + 1].map(|corner| self.tangents[corner as usize]);
        (a + b).truncate().normalize_or(a.truncate()).extend(a.w)
    }

    /// Adds a ring and returns its first vertex; slopes are those of the radius and of ribs.
    fn add_ring(
        &mut self,
        tube: &Tube,
        sample: &Sample,
        across: Vec3,
        [slope, rib_slope]: [f32; 2],
        v: f32,
    ) -> u32 {
        let binormal = sample.tangent.cross(across);
        let first = self.count();
        for &Corner { cos, sin, u, rib, bulge } in &tube.around {
            let outward = across * cos + binormal * sin;
            let around = binormal * cos - across * sin;
            let radius = sample.radius + sample.ribs * rib;
            let bulge = sample.ribs * bulge / radius;
            let slope = (slope + rib_slope * rib).clamp(-STEEPEST, STEEPEST);
            let normal = (outward - around * bulge - sample.tangent * slope).normalize();
            let place = sample.point + outward * radius;
            let along_u = (around + outward * bulge).normalize().extend(1.0);
            self.vertex(place, normal, Vec2::new(u, v), sample, along_u);
        }
        first
    }

    /// Adds the skin between two rings, and says whether all of it faces the way its normals do.
    fn join(&mut self, tube: &Tube, below: u32, above: u32) -> bool {
        let mut faces_out = true;
        for side in 0..tube.sides() {
            for [a, b, c] in [
                [below + side, below + side + 1, above + side + 1],
                [below + side, above + side + 1, above + side],
            ] {
                self.surface.triangle(a, b, c);
                faces_out &= self.faces_out([a, b, c]);
            }
        }
        faces_out
    }

    fn faces_out(&self, triangle: [u32; 3]) -> bool {
        let [a, b, c] = triangle.map(|corner| self.surface.positions[corner as usize]);
        let outward: Vec3 = triangle.iter().map(|&corner| self.surface.normals[corner as usize]).sum();
        (b - a).cross(c - a).dot(outward) > 0.0
    }

    /// Closes the tip with a cone as high as it is wide.
    fn close(&mut self, tube: &Tube, ring: u32, tip: &Sample, v: f32) {
        let apex = tip.point + tip.tangent * tip.radius;
        let v = v + tube.tiles_along(tip.radius, tip.radius);
        for side in 0..tube.sides() {
            // An apex for each side: one for all could have only one place in the texture.
            let around = self.between(ring + side);
            let top = self.vertex(apex, tip.tangent, Vec2::new(tube.middle(side), v), tip, around);
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
            self.vertex(place, normal, uv, end, around);
        }
        let v = v + tube.tiles_along(end.radius, end.radius);
        let triangle = |side| {
            let around = self.between(rim + side);
            let middle = self.vertex(end.point, normal, Vec2::new(tube.middle(side), v), end, around);
            [rim + side, rim + side + 1, middle]
        };
        (0..tube.sides()).flat_map(triangle).collect()
    }
}

/// What all rings of one tube have in common.
struct Tube {
    tiles: f32,
    /// The vertices of a ring; the seam's stand at both ends.
    around: Vec<Corner>,
}

/// One vertex of every ring.
struct Corner {
    cos: f32,
    sin: f32,
    /// Its texture coordinate.
    u: f32,
    /// How high the ribs of roots are there, and how fast they rise by the angle.
    rib: f32,
    bulge: f32,
}

impl Tube {
    fn new(sides: u32, tiles: f32, rises: bool) -> Self {
        const STEP: f32 = 0.01;
        let around = (0..=sides).map(|side| {
            // The seam's two vertices must be at the same place to the last bit.
            let turn = if side == sides { 0.0 } else { side as f32 / sides as f32 };
            let u = tiles * side as f32 / sides as f32;
            let (sin, cos) = libm::sincosf(TAU * turn);
            let [rib, bulge] = if rises && sides >= LEAST_RIBBED {
                [ribs(turn), (ribs(turn + STEP) - ribs(turn - STEP)) / (2.0 * TAU * STEP)]
            } else {
                [0.0; 2]
            };
            Corner { cos, sin, u, rib, bulge }
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
mod tests;
