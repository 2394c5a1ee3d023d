//! How a leaf looks in its season: whether it is there, its size, where it points, and its colour, all as the client's
//! shaders have it. Both must find what is in `golden/leaf-look.json`.
//!
//! After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-export leaf_look`.

use std::f32::consts::TAU;

use espalier_mesh::leaves::Leaf;
use espalier_plant::{MetamerId, Plant};
use espalier_settings::LeafLook;
use glam::{Vec3, Vec4};

use crate::colour::{linear, smooth};

const BRIGHTNESS: Vec3 = Vec3::new(0.30, 0.59, 0.11);

/// A look in its season. Colours are linear.
#[derive(Clone, Debug)]
pub(crate) struct LeafPainter {
    tint: Vec3,
    /// Colours at first, at last, and dead.
    autumn: [Vec3; 3],
    /// 1 for sprays of many small leaves, 0 for single leaves.
    spray: f32,
    lean: f32,
    orientation: f32,
    bend: f32,
    blades: u32,
    vigor_shift: f32,
    unfolded: f32,
    present: f32,
    fresh: f32,
    turned: f32,
    withered: f32,
}

/// The colours of a leaf, linear.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hues {
    pub middle: Vec3,
    /// Along the margin of a blade, which turns first.
    pub margin: Vec3,
}

/// What the shoot that bears a leaf is like, each number 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shoot {
    /// Unit vector along it.
    pub heading: Vec3,
    /// Share of the greatest vigor, in the sixteen levels that clients know.
    pub vigor: f32,
    /// Exposure to light.
    pub light: f32,
}

impl Shoot {
    /// The metamer as it is in the present.
    pub(crate) fn of(plant: &Plant, id: MetamerId) -> Self {
        let to = plant.metamers().end(id);
        let from = plant.metamers().parent(id).map_or(to, |parent| plant.metamers().end(parent));
        let seen = plant.metamers().condition(id);
        Self {
            heading: (to - from).normalize_or(Vec3::Y),
            vigor: f32::from(seen.vigor >> 4) / 15.0,
            light: f32::from(seen.light) / 255.0,
        }
    }
}

impl LeafPainter {
    /// Of this look.
    pub(crate) fn new(look: &LeafLook) -> Self {
        let nature = look.shape.nature();
        let season = look.season;
        Self {
            tint: linear(look.tint),
            autumn: nature.autumn.map(linear),
            spray: f32::from(u8::from(nature.is_spray)),
            lean: nature.lean,
            orientation: look.orientation,
            bend: nature.bend,
            blades: look.blades,
            vigor_shift: look.vigor_shift,
            unfolded: nature.unfolded.at(season),
            present: nature.present.at(season),
            fresh: nature.fresh.at(season),
            turned: nature.turned.at(season),
            withered: nature.withered.at(season),
        }
    }

    /// The blades of a leaf as they hang in their season, and their colours; nothing of those that have fallen.
    pub(crate) fn paint(&self, leaf: Leaf, shoot: Shoot) -> impl Iterator<Item = (Leaf, Vec3)> {
        let direction = pointing(leaf.direction, shoot.heading, self.lean, self.orientation);
        let side = leaf.direction.cross(leaf.normal).reject_from_normalized(direction);
        let normal = side.normalize_or(direction.any_orthonormal_vector()).cross(direction);
        let whole = Leaf { direction, normal, ..leaf };
        (0..self.blades).filter_map(move |number| {
            let blade = blade_of(&whole, self.blades, number, self.bend);
            let own = own_numbers(blade.random);
            let there = presence(self.present, own.z);
            let size = blade.size * there * unfolding(self.unfolded, own.y);
            let hue = self.hues(shoot.vigor, shoot.light, Vec3::new(blade.random, own.y, own.w)).middle;
            (there > 0.0).then_some((Leaf { size, ..blade }, hue))
        })
    }

    /// The colours of a leaf as most are.
    pub(crate) fn typical(&self) -> Hues {
        self.hues(0.2, 0.6, Vec3::splat(0.5))
    }

    /// The brightest that any of a leaf's three colours gets.
    pub(crate) fn brightest(&self) -> f32 {
        let ends = (0..32).map(|i| [1, 2, 4, 8, 16].map(|bit| f32::from(u8::from(i & bit != 0))));
        ends.fold(0.0, |most, [vigor, light, x, y, z]| {
            self.hues(vigor, light, Vec3::new(x, y, z)).middle.max_element().max(most)
        })
    }

    fn hues(&self, vigor: f32, light: f32, own: Vec3) -> Hues {
        let own = own.lerp(Vec3::splat(0.5), 0.55 * self.spray);
        let shade = Vec3::new(0.80, 0.88, 1.0).lerp(Vec3::new(1.04, 1.02, 0.96), light);
        let warmth = own.y - 0.5;
        let mut summer = self.tint * (0.80 + 0.40 * own.x) * shade;
        summer *= Vec3::new(1.0 + 0.34 * warmth, 1.0, 1.0 - 0.40 * warmth);
        // Most shoots have little of the greatest vigor there is.
        let weak = (1.0 - smooth(0.0, 0.42, vigor) + 0.36 * (own.z - 0.5)).clamp(0.0, 1.0);
        let shift = self.vigor_shift * weak * (1.0 - 0.5 * self.spray);
        let reddish = smooth(0.35, 0.95, shift);
        let warm = Vec3::new(1.36, 1.08, 0.24).lerp(Vec3::new(1.95, 0.55, 0.14), reddish);
        summer = summer.lerp(warm * summer.dot(BRIGHTNESS), 0.9 * shift);
        let young = summer * Vec3::new(1.55, 1.42, 0.85) + Vec3::new(0.02, 0.03, 0.0);
        summer = summer.lerp(young, self.fresh);
        // Weak shoots turn first, and leaves in the sun turn reddest.
        let late = 0.55 * own.z + 0.30 * vigor + 0.15 * (1.0 - light);
        let [middle, margin] =
            [-0.37, -0.09].map(|ahead| smooth(late - 0.25, late + 0.25, self.turned * 1.5 + ahead));
        let depth = (0.75 * own.x + 0.5 * light - 0.3 + 0.3 * (1.0 - vigor)).clamp(0.0, 1.0);
        let [first, last, dead] = self.autumn;
        let autumn = first.lerp(last, smooth(0.2, 0.9, depth)) * (0.82 + 0.36 * own.y);
        let dead = dead * (0.7 + 0.5 * own.y);
        let died = (self.withered * 1.3 - 0.3 * own.z).clamp(0.0, 1.0);
        let middle = summer.lerp(autumn, middle).lerp(dead, died);
        let margin = summer.lerp(autumn.lerp(last, 0.3), margin).lerp(dead, (1.4 * died).min(1.0));
        Hues { middle: self.natural(middle), margin: self.natural(margin) }
    }

    /// Greens as they are seen outdoors: duller than the tint of a leaf, those of sprays somewhat bluer.
    fn natural(&self, hue: Vec3) -> Vec3 {
        let green = (2.0 * (hue.y - hue.x.max(hue.z)) / hue.y.max(1e-3)).clamp(0.0, 1.0);
        let dull = Vec3::new(1.08, 1.02, 0.74).lerp(Vec3::new(1.0, 1.22, 1.2), self.spray);
        hue.lerp(dull * hue.dot(BRIGHTNESS), 0.4 * green)
    }
}

/// More numbers of a leaf's own, 0 to 1, or of a flower's or fruit's.
pub(crate) fn own_numbers(random: f32) -> Vec4 {
    (random * Vec4::new(57.31, 131.7, 313.3, 709.9)).fract()
}

/// A leaf is there while its number lies below a share; where that nears it, it shrinks away.
fn presence(share: f32, number: f32) -> f32 {
    ((share * 1.08 - number) / 0.08).clamp(0.0, 1.0)
}

/// The size of a leaf that unfolds a little earlier than others, or later.
fn unfolding(unfolded: f32, number: f32) -> f32 {
    unfolded + 0.35 * number * (1.0 - unfolded) * (1.0 - unfolded)
}

/// Where a leaf points that lies so far along its twig, and hangs (-1) or is raised (1).
fn pointing(direction: Vec3, heading: Vec3, lean: f32, orientation: f32) -> Vec3 {
    let way = if orientation < 0.0 { -Vec3::Y } else { Vec3::Y };
    direction.lerp(heading, lean).lerp(way, 0.92 * orientation.abs()).normalize_or(direction)
}

/// One of the blades that a leaf is divided into (LF6), which bends so far.
fn blade_of(leaf: &Leaf, blades: u32, number: u32, bend: f32) -> Leaf {
    let Leaf { base, direction, normal, size, random } = *leaf;
    if blades < 2 {
        return *leaf;
    }
    let (count, k) = (blades as f32, number as f32);
    let random = (random + 0.618_034 * k).fract();
    // A twig with one at its end and others around it, more of them to the sides than above and below.
    let open = if number + 1 == blades { 0.25 } else { 1.15 };
    let (sin, cos) = libm::sincosf(2.399_963 * k + TAU * leaf.random);
    let aside = direction.cross(normal) * cos + normal * (0.55 * sin);
    let way = direction + aside * open - Vec3::Y * (0.4 * bend * random);
    let way = way.normalize_or(direction);
    Leaf {
        base: base + direction * (size * (0.05 + 0.8 * (k + 0.5) / count)),
        direction: way,
        normal: normal.reject_from_normalized(way).normalize_or(way.any_orthonormal_vector()),
        size: size * (0.82 + 0.36 * random) / count.sqrt(),
        random,
    }
}

/// How far the tip of a blade bows and its halves rise from the midrib, each leaf by its own measure.
pub(crate) fn bending(random: f32, own: f32) -> [f32; 2] {
    [0.10 + 0.28 * random, 0.12 + 0.33 * own]
}

#[cfg(test)]
mod tests {
    use std::{fs, path::PathBuf};

    use espalier_settings::LeafKind;
    use serde_json::{Value, json};

    use super::*;

    const SEASONS: [f32; 10] = [0.0, 0.3, 0.7, 1.0, 1.4, 1.8, 2.1, 2.4, 2.7, 3.0];

    /// Rounded as far as clients compute the same, for whom a shader has 24 bits.
    fn rounded(numbers: &[f32]) -> Vec<f64> {
        numbers.iter().map(|&number| (f64::from(number) * 1e5).round() / 1e5).collect()
    }

    /// The colours of three leaves each on weak, middling and strong shoots, in shade and light.
    fn hues(painter: &LeafPainter) -> Value {
        let samples = (0..9).map(|i| {
            let random = (i as f32 * 0.618_034 + 0.1).fract();
            let (vigor, light) = ([0.0, 0.2, 1.0][i % 3], [0.0, 0.6, 1.0][(i + i / 3) % 3]);
            let own = [random, 1.0 - random, (random * 3.0).fract()];
            let Hues { middle, margin } = painter.hues(vigor, light, Vec3::from_array(own));
            let [middle, margin] = [middle, margin].map(|hue| rounded(&hue.to_array()));
            json!({ "vigor": vigor, "light": light, "own": own, "hue": middle, "margin": margin })
        });
        samples.collect()
    }

    fn looks() -> Value {
        let kinds = LeafKind::ALL.iter().enumerate();
        let looks = kinds.flat_map(|(i, &shape)| {
            SEASONS.iter().enumerate().map(move |(j, &season)| {
                let vigor_shift = [0.0, 0.4, 1.0][(i + j) % 3];
                let look = LeafLook { shape, season, vigor_shift, ..LeafLook::default() };
                let painter = LeafPainter::new(&look);
                let LeafPainter { unfolded, present, fresh, turned, withered, .. } = painter;
                json!({
                    "look": look,
                    "season": rounded(&[unfolded, present, fresh, turned, withered]),
                    "hues": hues(&painter),
                })
            })
        });
        looks.collect()
    }

    fn shapes() -> Value {
        let shapes = (0..24).map(|i| {
            let random = (i as f32 * 0.618_034).fract();
            let own = own_numbers(random);
            let share = i as f32 / 23.0;
            let heading = Vec3::new(0.2, 0.9, 0.1 * (i % 5) as f32).normalize();
            let direction = Vec3::new(random, 0.3 - share, 0.4).normalize();
            let (lean, orientation) = ([0.0, 0.6][i % 2], [-1.0, -0.4, 0.0, 0.5, 1.0][i % 5]);
            json!({
                "random": random,
                "own": rounded(&own.to_array()),
                "share": share,
                "presence": rounded(&[presence(share, own.z)]),
                "unfolding": rounded(&[unfolding(share, own.y)]),
                "direction": direction.to_array(),
                "heading": heading.to_array(),
                "lean": lean,
                "orientation": orientation,
                "bending": rounded(&bending(random, own.w)),
                "pointing": rounded(&pointing(direction, heading, lean, orientation).to_array()),
            })
        });
        shapes.collect()
    }

    fn blades() -> Value {
        let blades = (0..24).map(|i| {
            let random = (i as f32 * 0.618_034 + 0.05).fract();
            let direction = Vec3::new(random - 0.5, 0.6 - 0.06 * i as f32, 0.4).normalize();
            let normal = Vec3::new(0.1, 1.0, -random).reject_from_normalized(direction).normalize();
            let whole = Leaf { base: Vec3::ZERO, direction, normal, size: 1.0, random };
            let (count, bend) = ([1, 2, 3, 5, 9, 12][i % 6], [1.0, 0.0, 0.5][i % 3]);
            let blade = blade_of(&whole, count, (i as u32 / 2) % count, bend);
            json!({
                "direction": direction.to_array(),
                "normal": normal.to_array(),
                "random": random,
                "count": count,
                "number": (i as u32 / 2) % count,
                "bend": bend,
                "base": rounded(&blade.base.to_array()),
                "way": rounded(&blade.direction.to_array()),
                "up": rounded(&blade.normal.to_array()),
                "size": rounded(&[blade.size]),
                "own": rounded(&[blade.random]),
            })
        });
        blades.collect()
    }

    #[test]
    fn leaves_look_as_it_was_written_down() {
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/leaf-look.json");
        let samples = json!({ "looks": looks(), "shapes": shapes(), "blades": blades() });
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(&file, format!("{samples}\n")).expect("the samples can be written");
        }
        let stored = fs::read_to_string(&file).expect("the samples can be read");
        let stored: Value = serde_json::from_str(&stored).expect("the samples are JSON");
        let written: Value = serde_json::from_str(&samples.to_string()).expect("so are these");
        assert!(stored == written, "leaves look otherwise than in golden/leaf-look.json");
    }

    const LEAF: Leaf =
        Leaf { base: Vec3::ZERO, direction: Vec3::X, normal: Vec3::Y, size: 1.0, random: 0.12 };
    const SHOOT: Shoot = Shoot { heading: Vec3::Z, vigor: 1.0, light: 0.5 };

    fn in_season(shape: LeafKind, season: f32) -> Option<(Leaf, Vec3)> {
        LeafPainter::new(&LeafLook { shape, season, ..LeafLook::default() }).paint(LEAF, SHOOT).next()
    }

    #[test]
    fn leaves_turn_and_fall() {
        let [summer, autumn] =
            [1.0, 2.0].map(|season| in_season(LeafKind::Palmate, season).expect("it hangs"));
        assert!(summer.1.y > summer.1.x && autumn.1.x > autumn.1.y, "{} turns {}", summer.1, autumn.1);
        assert_eq!(in_season(LeafKind::Palmate, 3.0), None);
    }

    #[test]
    fn evergreens_stay_green_in_winter() {
        let (leaf, colour) = in_season(LeafKind::Needle, 3.0).expect("it hangs");
        assert!(leaf.size == 1.0 && colour.y > colour.x, "{colour}");
    }

    #[test]
    fn weak_shoots_have_warmer_leaves() {
        let painter = LeafPainter::new(&LeafLook { vigor_shift: 1.0, ..LeafLook::default() });
        let warmth = |vigor| {
            let (_, colour) = painter.paint(LEAF, Shoot { vigor, ..SHOOT }).next().expect("it hangs");
            colour.x / colour.y
        };
        assert!(warmth(0.0) > warmth(0.2) && warmth(0.2) > warmth(1.0));
    }

    #[test]
    fn orientation_lifts_and_lowers_leaves() {
        let tip = |orientation| pointing(Vec3::X, Vec3::Z, 0.0, orientation).y;
        assert!(tip(-1.0) < -0.9 && tip(0.0) == 0.0 && tip(1.0) > 0.9);
    }

    #[test]
    fn lf6_blades_cover_as_much_as_their_leaf_and_stay_with_it() {
        for blades in [1, 2, 3, 6, 9, 12] {
            let look = LeafLook { blades, ..LeafLook::default() };
            let painter = LeafPainter::new(&look);
            let leaves = (0..400).map(|i| Leaf { random: (i as f32 * 0.618_034).fract(), ..LEAF });
            let all: Vec<Leaf> =
                leaves.flat_map(|leaf| painter.paint(leaf, SHOOT)).map(|(blade, _)| blade).collect();
            assert_eq!(all.len(), 400 * blades as usize);
            let covered: f32 = all.iter().map(|blade| blade.size * blade.size).sum();
            assert!((covered / 400.0 - 1.0).abs() < 0.05, "{blades} cover {covered}");
            for Leaf { base, direction, normal, size, .. } in all {
                let tip = base + size * direction;
                assert!(base.length() < 1.0 && tip.length() < 1.6, "from {base} to {tip}");
                assert!(direction.is_normalized() && normal.is_normalized());
                assert!(direction.dot(normal).abs() < 1e-4);
            }
        }
    }
}
