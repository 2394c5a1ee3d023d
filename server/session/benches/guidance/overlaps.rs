//! How much of a drawn outline a tree covers, seen from the front, and how much it sticks out.

use espalier_mesh::{
    Style,
    leaves::{self, Leaf},
};
use espalier_plant::MetamerId;
use espalier_proto::{Action, Depth, Direction, DrawingPlane, PlanePoint, Position};
use espalier_session::{Document, Principal, style_options};
use glam::{Vec2, Vec3};

/// Edge of a pixel.
const PIXEL: f32 = 0.25;
/// What is near to a node is covered by it.
const COVERED: f32 = 1.0;
/// Half the width of a leaf, and how far from its base it is widest, in its length.
const HALF_WIDTH: f32 = 0.3;
const WIDEST: f32 = 0.42;

/// The overlaps of one tree with its outline: area in both over area in either.
#[derive(Clone, Copy, Debug)]
pub struct Overlaps {
    /// Of discs around its nodes.
    pub metamers: f32,
    /// Of its leaves and axes, gaps as wide as two internodes closed.
    pub leaves: f32,
    /// Shares of the outline that they leave free, and that they cover beside it.
    pub missed: f32,
    pub spilt: f32,
    pub count: u32,
}

/// A seedling that has grown into an outline.
pub fn enclosed(seed: u32, outline: &[Vec2]) -> Document {
    let mut document = Document::new(seed);
    enclose(&mut document, outline);
    document
}

/// Lets a document grow into an outline.
pub fn enclose(document: &mut Document, outline: &[Vec2]) {
    let direction = |axis: Vec3| Direction::try_from(axis).expect("of length 1");
    let plane = DrawingPlane::new(Position::ORIGIN, direction(Vec3::X), direction(Vec3::Y));
    let points: Vec<PlanePoint> =
        outline.iter().map(|&point| point.try_into().expect("within the world")).collect();
    let lasso = Action::Lasso {
        outline: points.try_into().expect("not too many points"),
        plane: plane.expect("perpendicular"),
        depth: Depth::MOST,
        bud: None,
    };
    document.apply(&Principal::visitor(), &lasso.into()).expect("a lasso can be drawn");
}

impl Overlaps {
    pub fn of(document: &mut Document, outline: &[Vec2]) -> Self {
        let style = Style::new(style_options(&document.parameters()));
        let plant = document.portrait();
        let living: Vec<MetamerId> = (0..plant.metamer_count())
            .map(MetamerId::new)
            .filter(|&id| plant.is_alive(id) && !plant.is_seed(id))
            .collect();
        let blades: Vec<[Vec2; 4]> =
            living.iter().flat_map(|&id| leaves::of(plant, id, &style)).map(|leaf| blade(&leaf)).collect();
        let nodes: Vec<Vec2> = living.iter().map(|&id| plant.metamers().end(id).truncate()).collect();
        let corners = blades.iter().flatten().copied();
        let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for point in outline.iter().chain(&nodes).copied().chain(corners) {
            (low, high) = (low.min(point - COVERED), high.max(point + COVERED));
        }
        let mut picture = Picture::new(low, high);
        for &node in &nodes {
            picture.fill(node - COVERED, node + COVERED, |p| p.distance_squared(node) <= COVERED * COVERED);
        }
        let [metamers, ..] = picture.overlap(outline);
        picture.covered.fill(false);
        for &id in &living {
            let ends =
                [plant.metamers().parent(id).unwrap_or(id), id].map(|id| plant.metamers().end(id).truncate());
            (0..8u8)
                .map(|i| ends[0].lerp(ends[1], f32::from(i) / 8.0))
                .for_each(|p| picture.fill(p, p, |_| true));
        }
        for &[base, left, tip, right] in &blades {
            picture.fill_triangle([base, left, tip]);
            picture.fill_triangle([base, tip, right]);
        }
        picture.close_gaps();
        let [leaves, missed, spilt] = picture.overlap(outline);
        Self { metamers, leaves, missed, spilt, count: plant.living_count() }
    }
}

/// A leaf as seen from the front: from its base by its widest place, on both sides, to its tip.
fn blade(leaf: &Leaf) -> [Vec2; 4] {
    let side = leaf.direction.cross(leaf.normal) * HALF_WIDTH;
    let widest = leaf.direction * WIDEST;
    [Vec3::ZERO, widest - side, leaf.direction, widest + side]
        .map(|place| (leaf.base + leaf.size * place).truncate())
}

/// Which pixels are covered.
struct Picture {
    low: Vec2,
    width: usize,
    covered: Vec<bool>,
}

impl Picture {
    fn new(low: Vec2, high: Vec2) -> Self {
        let [width, height] = ((high - low) / PIXEL).to_array().map(|pixels| pixels.ceil() as usize + 1);
        Self { low, width, covered: vec![false; width * height] }
    }

    fn centre(&self, index: usize) -> Vec2 {
        self.low + Vec2::new((index % self.width) as f32, (index / self.width) as f32) * PIXEL
    }

    /// Covers the pixels of a box for which something holds.
    fn fill(&mut self, low: Vec2, high: Vec2, is_covered: impl Fn(Vec2) -> bool) {
        self.visit(low, high, |covered, p| *covered |= is_covered(p));
    }

    fn fill_triangle(&mut self, [a, b, c]: [Vec2; 3]) {
        let turn = |a: Vec2, b: Vec2, p: Vec2| (b - a).perp_dot(p - a);
        self.fill(a.min(b).min(c), a.max(b).max(c), |p| {
            let sides = [turn(a, b, p), turn(b, c, p), turn(c, a, p)];
            sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
        });
    }

    /// Calls `visit` with the pixels of a box.
    fn visit(&mut self, low: Vec2, high: Vec2, mut visit: impl FnMut(&mut bool, Vec2)) {
        let [left, bottom] = ((low - self.low) / PIXEL).to_array().map(|at| at.max(0.0) as usize);
        let [right, top] = ((high - self.low) / PIXEL).to_array().map(|at| at.ceil() as usize);
        for y in bottom..=top.min(self.covered.len() / self.width - 1) {
            for x in left..=right.min(self.width - 1) {
                let index = y * self.width + x;
                let centre = self.centre(index);
                visit(&mut self.covered[index], centre);
            }
        }
    }

    /// Covers what lies between covered places: all that no disc as wide as [`COVERED`] holds without touching one.
    fn close_gaps(&mut self) {
        for is_covered in [true, false] {
            let from = self.covered.clone();
            for (index, _) in from.iter().enumerate().filter(|&(_, &covered)| covered == is_covered) {
                let centre = self.centre(index);
                let near = |p: Vec2| p.distance_squared(centre) <= COVERED * COVERED;
                self.visit(centre - COVERED, centre + COVERED, |covered, p| {
                    if near(p) {
                        *covered = is_covered;
                    }
                });
            }
        }
    }

    /// Area in both over area in either; and, in areas of the outline, what is missed and what is spilt.
    fn overlap(&self, outline: &[Vec2]) -> [f32; 3] {
        let (mut both, mut either, mut area) = (0u32, 0u32, 0u32);
        for (index, &covered) in self.covered.iter().enumerate() {
            let drawn = is_inside(outline, self.centre(index));
            both += u32::from(covered && drawn);
            either += u32::from(covered || drawn);
            area += u32::from(drawn);
        }
        let share = |pixels: u32, of: u32| pixels as f32 / of as f32;
        [share(both, either), share(area - both, area), share(either - area, area)]
    }
}

/// Whether a point lies in an outline by the even-odd rule.
fn is_inside(outline: &[Vec2], p: Vec2) -> bool {
    let ends = outline.iter().cycle().skip(1);
    let crossings = outline.iter().zip(ends).filter(|&(&a, &b)| {
        let is_level = (a.y > p.y) != (b.y > p.y);
        is_level && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossings.count() % 2 == 1
}
