//! Leaves of each kind as triangles, with a colour at each corner.

use std::f32::consts::TAU;

use espalier_mesh::{
    Style, TriangleMesh, foliage,
    leaves::{self, Leaf},
};
use espalier_plant::{MetamerId, Plant, Widths};
use espalier_settings::{Appearance, LeafKind};
use glam::{Vec2, Vec3};

use super::{
    leaf_look::{LeafPainter, Shoot},
    ornaments::{self, Bearer},
    scene::Painted,
};

/// Half an outline: how far along the blade, and how far out, in lengths of the leaf.
pub(super) type Outline = &'static [(f32, f32)];

const OVATE: Outline = &[(0.25, 0.24), (0.6, 0.22), (1.0, 0.0)];
const LANCEOLATE: Outline = &[(0.3, 0.1), (0.65, 0.085), (1.0, 0.0)];
const LOBED: Outline =
    &[(0.18, 0.08), (0.3, 0.22), (0.4, 0.12), (0.55, 0.3), (0.66, 0.16), (0.82, 0.22), (1.0, 0.0)];
const ROUND: Outline = &[(0.15, 0.26), (0.45, 0.42), (0.8, 0.3), (1.0, 0.0)];
const LEAFLET: Outline = &[(0.5, 0.22), (1.0, 0.0)];

/// All leaves of the present, with the flowers and fruits among them and on the wood.
pub(crate) fn foliage(plant: &Plant, style: &Style, appearance: &Appearance) -> Painted {
    let Appearance { leaves: look, flowers, fruits, .. } = appearance;
    let mut painter = Painter { painted: Painted::default(), colour: Vec3::ONE };
    let goes_on = goes_on(plant);
    let widths = Widths::of(plant, style.girth());
    let leaf_painter = LeafPainter::new(look);
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        if plant.is_seed(id) || !plant.is_alive(id) {
            continue;
        }
        let count = foliage::leaves(plant, id, style);
        let to = plant.metamers().end(id);
        let from = plant.metamers().parent(id).map_or(to, |parent| plant.metamers().end(parent));
        let shoot = Shoot::of(plant, id);
        // The shadows of the simulation are soft: deep in a crown there is little of the sky.
        let sky = 0.62 + 0.38 * shoot.light;
        for leaf in leaves::of(plant, id, style) {
            if let Some((leaf, hue)) = leaf_painter.paint(&leaf, &shoot) {
                painter.colour = hue * sky;
                painter.leaf(&leaf, look.shape);
            }
        }
        let bearer = Bearer {
            row: id.raw(),
            ends: [from, to],
            radius: widths.radius(id),
            is_leafy: count > 0,
            is_tip: !goes_on[id.index()],
            vigor: shoot.vigor,
        };
        ornaments::flowers(&mut painter, &bearer, flowers);
        ornaments::fruits(&mut painter, &bearer, fruits);
    }
    painter.painted
}

/// Which metamers their axis goes on beyond.
fn goes_on(plant: &Plant) -> Vec<bool> {
    let mut goes_on = vec![false; plant.metamer_count()];
    for id in (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)) {
        let metamers = plant.metamers();
        if let Some(parent) = metamers.parent(id).filter(|&parent| metamers.axis(parent) == metamers.axis(id))
        {
            goes_on[parent.index()] = true;
        }
    }
    goes_on
}

/// Collects triangles in the colour of the moment.
pub(super) struct Painter {
    pub(super) painted: Painted,
    pub(super) colour: Vec3,
}

impl Painter {
    fn leaf(&mut self, leaf: &Leaf, kind: LeafKind) {
        let Leaf { base, direction, normal, size, random } = *leaf;
        let side = direction.cross(normal);
        match kind {
            LeafKind::Ovate => self.blade(base, direction, side, size, OVATE),
            LeafKind::Round => self.blade(base, direction, side, size, ROUND),
            LeafKind::Lanceolate => self.blade(base, direction, side, size, LANCEOLATE),
            LeafKind::Lobed => self.blade(base, direction, side, size, LOBED),
            LeafKind::Palmate => {
                let centre = base + direction * (0.35 * size);
                for (turn, reach) in [(-0.3, 0.45), (-0.15, 0.6), (0.0, 0.68), (0.15, 0.6), (0.3, 0.45)] {
                    let (sin, cos) = libm::sincosf(TAU * turn);
                    let (lobe, across) = (direction * cos + side * sin, side * cos - direction * sin);
                    self.blade(centre, lobe, across, reach * size, &[(0.4, 0.24), (1.0, 0.0)]);
                }
            }
            LeafKind::Fan => {
                let centre = base + direction * (0.3 * size);
                for turn in [-0.09, 0.09] {
                    let (sin, cos) = libm::sincosf(TAU * turn);
                    let (lobe, across) = (direction * cos + side * sin, side * cos - direction * sin);
                    self.blade(centre, lobe, across, 0.7 * size, &[(0.85, 0.42), (1.0, 0.0)]);
                }
            }
            LeafKind::Needle => {
                for needle in 0..6 {
                    let turn = TAU * (needle as f32 / 6.0 + random);
                    let (sin, cos) = libm::sincosf(turn);
                    let out = normal * cos + side * sin;
                    let along = (direction * 0.75 + out * 0.66).normalize_or(direction);
                    let across = along.cross(direction).normalize_or(side);
                    self.blade(base, along, across, size, &[(0.5, 0.045), (1.0, 0.0)]);
                }
            }
            LeafKind::Scale => {
                self.blade(base, direction, side, size, &[(0.4, 0.17), (1.0, 0.0)]);
                self.blade(base, direction, normal, size, &[(0.4, 0.17), (1.0, 0.0)]);
            }
            LeafKind::Compound => {
                for pair in 0..4 {
                    let from = base + direction * (size * (0.25 + 0.2 * pair as f32));
                    for hand in [-1.0, 1.0] {
                        let along = (side * hand + 0.5 * direction).normalize_or(direction);
                        self.blade(from, along, along.cross(normal), 0.36 * size, LEAFLET);
                    }
                }
            }
        }
    }

    /// A flat blade with a slight fold along its middle.
    pub(super) fn blade(&mut self, base: Vec3, along: Vec3, across: Vec3, size: f32, outline: Outline) {
        let normal = along.cross(across).normalize_or(Vec3::Y);
        let mut below = [self.vertex(base, normal); 2];
        for &(far, out) in outline {
            let middle = base + along * (far * size);
            let sides = [-1.0, 1.0].map(|hand| {
                let place = middle + across * (hand * out * size) - normal * (0.25 * out * size);
                self.vertex(place, (normal + across * (0.35 * hand)).normalize_or(normal))
            });
            let mesh = &mut self.painted.mesh;
            mesh.triangle(below[0], below[1], sides[1]);
            mesh.triangle(below[0], sides[1], sides[0]);
            below = sides;
        }
    }

    pub(super) fn vertex(&mut self, place: Vec3, normal: Vec3) -> u32 {
        self.painted.colours.push(self.colour);
        TriangleMesh::vertex(&mut self.painted.mesh, place, normal, Vec2::ZERO)
    }
}
