//! Wood unrolled: each tube is slit along its seam, laid flat and cut across where it would be too long. A ring is as
//! long in the texture as it is around the limb, so a tapering tube becomes a tapering strip.

use std::{f32::consts::PI, iter::once, ops::Range};

use espalier_mesh::{Body, Closing, Sheet, Wood};
use glam::{Vec2, Vec3};

use super::LightMap;

/// A piece of a tube is about so long, of the side of a square that is as large as all wood.
const LONGEST: f32 = 0.5;
/// A tube is cut into no more pieces than this.
const MOST_PIECES: f32 = 256.0;
/// A cut moves so far to a ring that is there, of the distance between cuts.
const SNAP: f32 = 0.25;

/// All wood of a mesh in its texture.
pub(crate) struct WoodMap {
    pub map: LightMap,
    bodies: Vec<Outline>,
    /// About how long a piece of a tube is.
    longest: f32,
}

/// Wood with a place in the texture for each vertex. A ring at which a tube was cut stands there twice.
pub(crate) struct UnrolledWood {
    pub wood: Wood,
    pub places: Vec<Vec2>,
}

impl WoodMap {
    /// Of bodies, each of which is swept once and forgotten.
    pub(crate) fn of(bodies: &[Body<'_>], texels: u32) -> Self {
        let outlines = bodies.iter().filter_map(|body| {
            let mut wood = Wood::of(body.seed());
            body.sweep(&mut wood).map(|sheet| Outline::of(&wood, &sheet))
        });
        let bodies: Vec<Outline> = outlines.collect();
        let area: f32 = bodies.iter().map(|body| body.widest(0..body.rings.len()) * body.height()).sum();
        let tallest = bodies.iter().map(Outline::height).fold(0.0, f32::max);
        let longest = (LONGEST * area.sqrt()).max(tallest / MOST_PIECES).max(f32::MIN_POSITIVE);
        let sizes: Vec<Vec2> = bodies.iter().flat_map(|body| body.sizes(longest)).collect();
        Self { map: LightMap::of(&sizes, texels), bodies, longest }
    }

    /// Gives the same bodies one by one.
    pub(crate) fn each<E>(
        &self,
        bodies: &[Body<'_>],
        mut take: impl FnMut(&Body<'_>, &UnrolledWood) -> Result<(), E>,
    ) -> Result<(), E> {
        let (mut outlines, mut first) = (self.bodies.iter(), 0);
        for body in bodies {
            let mut wood = Wood::of(body.seed());
            let Some((sheet, outline)) = body.sweep(&mut wood).zip(outlines.next()) else { continue };
            let unrolled = Unrolling {
                map: &self.map,
                from: &wood,
                sides: sheet.sides,
                to: UnrolledWood { wood: Wood::of(body.seed()), places: Vec::new() },
            };
            take(body, &unrolled.run(&sheet, outline, &outline.cuts(self.longest), first))?;
            first += outline.sizes(self.longest).count();
        }
        Ok(())
    }
}

/// What one body is like when it lies flat, in internodes.
struct Outline {
    rings: Vec<Ring>,
    /// How high the sides of the cone at the end are; none where it ends with a face.
    cone: Option<f32>,
    /// How high the triangles of faces are, at the foot and at the end.
    faces: [f32; 2],
}

#[derive(Clone, Copy)]
struct Ring {
    /// Along the surface, from the foot.
    height: f32,
    /// Around.
    width: f32,
}

/// A place where a tube can be cut: so far from a ring to the next.
#[derive(Clone, Copy)]
struct Cut {
    ring: usize,
    share: f32,
}

/// The rings between two cuts.
fn inside(from: Cut, to: Cut) -> Range<usize> {
    from.ring + 1..to.ring + usize::from(to.share > 0.0)
}

impl Outline {
    fn of(wood: &Wood, sheet: &Sheet) -> Self {
        let angle = PI / sheet.sides as f32;
        let (around, inner) = (2.0 * sheet.sides as f32 * libm::sinf(angle), libm::cosf(angle));
        let radius = |first: u32| wood.radii[first as usize];
        let middle = |first: u32| {
            let ring = &wood.surface.positions[first as usize..(first + sheet.sides) as usize];
            ring.iter().sum::<Vec3>() / sheet.sides as f32
        };
        let mut rings: Vec<Ring> = Vec::with_capacity(sheet.rings.len());
        let mut below: Option<u32> = None;
        for &first in &sheet.rings {
            let climb = below.map_or(0.0, |below| {
                let [rise, swell] = [middle(first).distance(middle(below)), radius(first) - radius(below)];
                Vec2::new(rise, swell).length()
            });
            let height = rings.last().map_or(0.0, |ring| ring.height) + climb;
            rings.push(Ring { height, width: around * radius(first) });
            below = Some(first);
        }
        let ends =
            [sheet.rings.first(), sheet.rings.last()].map(|first| first.map_or(0.0, |&first| radius(first)));
        let cone = matches!(sheet.end, Closing::Cone(_)).then(|| ends[1] * Vec2::new(1.0, inner).length());
        Self { rings, cone, faces: ends.map(|radius| radius * inner) }
    }

    fn height(&self) -> f32 {
        self.rings.last().map_or(0.0, |ring| ring.height)
    }

    fn widest(&self, rings: Range<usize>) -> f32 {
        self.rings[rings].iter().map(|ring| ring.width).fold(0.0, f32::max)
    }

    fn at(&self, cut: Cut) -> Ring {
        let below = self.rings[cut.ring];
        let above = self.rings.get(cut.ring + 1).copied().unwrap_or(below);
        let mix = |a: f32, b: f32| a + (b - a) * cut.share;
        Ring { height: mix(below.height, above.height), width: mix(below.width, above.width) }
    }

    /// Where it is cut into pieces about so long, its two ends among them.
    fn cuts(&self, longest: f32) -> Vec<Cut> {
        let last = self.rings.len() - 1;
        let count = (self.height() / longest).ceil().max(1.0);
        let apart = self.height() / count;
        let mut cuts = vec![Cut { ring: 0, share: 0.0 }];
        for number in 1..count as usize {
            let height = apart * number as f32;
            let above = self.rings.partition_point(|ring| ring.height < height).clamp(1, last);
            let off = |ring: usize| (self.rings[ring].height - height).abs();
            let nearest = if off(above - 1) < off(above) { above - 1 } else { above };
            let [low, high] = [above - 1, above].map(|ring| self.rings[ring].height);
            cuts.push(if off(nearest) <= SNAP * apart {
                Cut { ring: nearest, share: 0.0 }
            } else {
                Cut { ring: above - 1, share: (height - low) / (high - low) }
            });
        }
        cuts.push(Cut { ring: last, share: 0.0 });
        cuts
    }

    /// The sizes of its pieces: the face at the foot, those of the tube, the face at the end if it has one.
    fn sizes(&self, longest: f32) -> impl Iterator<Item = Vec2> {
        let cuts = self.cuts(longest);
        let foot = Vec2::new(self.rings[0].width, self.faces[0]);
        let end =
            self.cone.is_none().then(|| Vec2::new(self.rings[self.rings.len() - 1].width, self.faces[1]));
        let count = cuts.len() - 1;
        let strips = (0..count).map(move |number| {
            let (from, to) = (cuts[number], cuts[number + 1]);
            let cone = if number + 1 == count { self.cone.unwrap_or(0.0) } else { 0.0 };
            let (low, high) = (self.at(from), self.at(to));
            let widest = low.width.max(high.width).max(self.widest(inside(from, to)));
            Vec2::new(widest, high.height - low.height + cone)
        });
        once(foot).chain(strips).chain(end)
    }
}

/// A ring of a strip, or where it was cut between two rings.
#[derive(Clone, Copy)]
struct Row {
    first: u32,
    /// After each vertex stands another one, where the diagonal of the side is cut.
    is_between: bool,
}

impl Row {
    fn at(self, side: u32) -> u32 {
        self.first + side * if self.is_between { 2 } else { 1 }
    }

    fn on_diagonal(self, side: u32) -> Option<u32> {
        self.is_between.then(|| self.at(side) + 1)
    }
}

/// One body on its way into the texture.
struct Unrolling<'a> {
    map: &'a LightMap,
    from: &'a Wood,
    sides: u32,
    to: UnrolledWood,
}

impl Unrolling<'_> {
    fn run(mut self, sheet: &Sheet, outline: &Outline, cuts: &[Cut], first: usize) -> UnrolledWood {
        let last = outline.rings.len() - 1;
        let back = self.face(sheet.foot, outline.rings[0].width, outline.faces[0], first);
        for triangle in back.as_chunks::<3>().0 {
            let &[a, b, c] = triangle;
            self.to.wood.surface.triangle(b, a, c);
        }
        let strips = cuts.len() - 1;
        for number in 0..strips {
            let (from, to, piece) = (cuts[number], cuts[number + 1], first + 1 + number);
            let inner = inside(from, to).map(|ring| Cut { ring, share: 0.0 });
            let rows: Vec<Cut> = once(from).chain(inner).chain([to]).collect();
            let widest = rows.iter().map(|&row| outline.at(row).width).fold(0.0, f32::max);
            let foot = outline.at(from).height;
            let mut below: Option<Row> = None;
            for cut in rows {
                let ring = outline.at(cut);
                let is_between = cut.share > 0.0;
                let row = Row { first: self.count(), is_between };
                for side in 0..=self.sides {
                    let across = ring.width * (side as f32 / self.sides as f32 - 0.5);
                    let at = Vec2::new(0.5 * widest + across, ring.height - foot);
                    let here = sheet.rings[cut.ring] + side;
                    if !is_between {
                        self.copy(here, self.map.at(piece, at));
                        continue;
                    }
                    let next = sheet.rings[cut.ring + 1] + side;
                    self.between([here, next], cut.share, self.map.at(piece, at));
                    if side < self.sides {
                        let along = cut.share * outline.rings[cut.ring + 1].width / self.sides as f32;
                        let place = self.map.at(piece, at + Vec2::new(along, 0.0));
                        self.between([here, next + 1], cut.share, place);
                    }
                }
                if let Some(below) = below {
                    (0..self.sides).for_each(|side| self.join([below, row], side));
                }
                below = Some(row);
            }
            if let (Closing::Cone(apex), Some(Row { first: ring, .. }), true) =
                (sheet.end, below, number + 1 == strips)
            {
                let end = outline.rings[last];
                let height = end.height - foot + outline.cone.unwrap_or(0.0);
                for side in 0..self.sides {
                    let across = (side as f32 + 0.5) / self.sides as f32 - 0.5;
                    let place = Vec2::new(0.5 * widest + end.width * across, height);
                    let top = self.copy(apex + side, self.map.at(piece, place));
                    self.to.wood.surface.triangle(ring + side, ring + side + 1, top);
                }
            }
        }
        if let Closing::Face(face) = sheet.end {
            self.to.wood.cuts =
                self.face(face, outline.rings[last].width, outline.faces[1], first + 1 + strips);
        }
        self.to
    }

    fn count(&self) -> u32 {
        self.to.places.len() as u32
    }

    /// Copies a vertex to a place in the texture.
    fn copy(&mut self, vertex: u32, place: Vec2) -> u32 {
        let (from, at) = (self.from, vertex as usize);
        let surface = &from.surface;
        self.to.places.push(place);
        self.to.wood.radii.push(from.radii[at]);
        self.to.wood.metamers.push(from.metamers[at]);
        self.to.wood.tangents.push(from.tangents[at]);
        self.to.wood.surface.vertex(surface.positions[at], surface.normals[at], surface.uvs[at])
    }

    /// Makes a vertex between two that an edge or a diagonal joins.
    fn between(&mut self, ends: [u32; 2], share: f32, place: Vec2) {
        let (from, [a, b]) = (self.from, ends.map(|vertex| vertex as usize));
        let surface = &from.surface;
        let normal = surface.normals[a].lerp(surface.normals[b], share).normalize_or(surface.normals[a]);
        let along = from.tangents[a].lerp(from.tangents[b], share).truncate().reject_from_normalized(normal);
        let tangent = along.normalize_or(normal.any_orthonormal_vector()).extend(from.tangents[a].w);
        self.to.places.push(place);
        self.to.wood.radii.push(from.radii[a] + (from.radii[b] - from.radii[a]) * share);
        self.to.wood.metamers.push(from.metamers[if share < 0.5 { a } else { b }]);
        self.to.wood.tangents.push(tangent);
        let position = surface.positions[a].lerp(surface.positions[b], share);
        self.to.wood.surface.vertex(position, normal, surface.uvs[a].lerp(surface.uvs[b], share));
    }

    /// Fills one side of the tube between two rows of a strip: what lies there of the two triangles that the tube has
    /// between its rings, so that a cut changes nothing of the surface.
    fn join(&mut self, [below, above]: [Row; 2], side: u32) {
        let ([a, b], [d, c]) =
            ([side, side + 1].map(|side| below.at(side)), [side, side + 1].map(|side| above.at(side)));
        let (low, high) = (below.on_diagonal(side), above.on_diagonal(side));
        let surface = &mut self.to.wood.surface;
        surface.triangle(low.unwrap_or(a), b, c);
        if let Some(high) = high {
            surface.triangle(low.unwrap_or(a), c, high);
        }
        surface.triangle(a, high.unwrap_or(c), d);
        if let Some(low) = low {
            surface.triangle(a, low, high.unwrap_or(c));
        }
    }

    /// Copies a face, its triangles side by side like teeth, and gives them as they are seen from above.
    fn face(&mut self, rim: u32, width: f32, height: f32, piece: usize) -> Vec<u32> {
        let sides = self.sides;
        let first = self.count();
        for side in 0..=sides {
            let place = Vec2::new(width * side as f32 / sides as f32, 0.0);
            self.copy(rim + side, self.map.at(piece, place));
        }
        let mut triangles = Vec::new();
        for side in 0..sides {
            let place = Vec2::new(width * (side as f32 + 0.5) / sides as f32, height);
            let middle = self.copy(rim + sides + 1 + side, self.map.at(piece, place));
            triangles.extend([first + side, first + side + 1, middle]);
        }
        triangles
    }
}
