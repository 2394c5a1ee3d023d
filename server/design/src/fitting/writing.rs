//! A graph from the shapes of limbs: what all of an order have in common, and what some say themselves.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::{
    course::{along, apart, density, fitted},
    going::{Angle, Going, pull},
    limbs::Wood,
    outline,
    shape::{Shape, Stem, Usual},
    sharing::{SAME, SAME_OUTLINE, is_same},
};
use crate::{
    axis::{OUTSIDE, Placed, lay, placed_at, stem},
    curve::Curve,
    design::Design,
    frame::turn_between,
    function::Function,
    graph::{Graph, Level, Owner, Record, Setting},
    key::Key,
    node::NodeId,
    places::Places,
    refusal::Refusal,
    slots::Slot,
    value::{Held, Value},
};

/// Tips that are not farther apart are in one place, in internodes.
const SAME_PLACE: f32 = 0.75;
/// Courses are the same that are nowhere farther apart, in internodes.
const SAME_COURSE: f32 = 0.15;
/// Most laterals whose places are written down, so that a design is no larger than one that comes over the wire may be;
/// those of higher orders follow from the density alone.
const MOST_SLOTS: usize = 768;

/// Something that a limb might say itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wish {
    /// The limb.
    pub limb: usize,
    pub key: Key,
    /// How much wood stands elsewhere without it, times how far: nodes by internodes.
    pub gain: f32,
}

impl Wish {
    /// Whether it does not depend on where limbs stand.
    pub(super) fn is_of_form(&self) -> bool {
        matches!(self.key, Key::Axis | Key::Silhouette | Key::Girth)
    }
}

/// Which limbs say what themselves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Said(BTreeMap<usize, Vec<Key>>);

impl Said {
    /// These limbs say these things as well.
    pub(super) fn add(&mut self, wishes: &[Wish]) {
        for wish in wishes {
            let keys = self.0.entry(wish.limb).or_default();
            if !keys.contains(&wish.key) {
                keys.push(wish.key);
            }
        }
    }

    /// These things are said no longer.
    pub(super) fn without(&self, part: &[(usize, Key)]) -> Self {
        let mut said = self.clone();
        for (limb, key) in part {
            if let Some(keys) = said.0.get_mut(limb) {
                keys.retain(|other| other != key);
            }
        }
        said.0.retain(|_, keys| !keys.is_empty());
        said
    }

    /// All that is said, and by which limb.
    pub(super) fn all(&self) -> impl Iterator<Item = (usize, Key)> {
        self.0.iter().flat_map(|(&limb, keys)| keys.iter().map(move |&key| (limb, key)))
    }

    pub(super) fn has(&self, limb: usize, key: Key) -> bool {
        self.0.get(&limb).is_some_and(|keys| keys.contains(&key))
    }

    /// Whether no limb says anything: then it is found out what each might say.
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// All that is known of a plant, to be written down.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Writer {
    wood: Wood,
    shapes: Vec<Shape>,
    stem: Stem,
    /// The course of the stem.
    axis: Curve,
    /// By order.
    usual: Vec<Usual>,
    ids: Vec<Option<NodeId>>,
    /// Limbs whose laterals have slots.
    anchored: Vec<usize>,
}

/// The values that limbs of an order have unless they say others, order by order.
type Common = BTreeMap<Key, Held>;

impl Writer {
    pub(super) fn new(wood: Wood) -> Self {
        let mut shapes: Vec<Shape> = (0..wood.limbs.len()).map(|limb| Shape::of(&wood, limb)).collect();
        let usual: Vec<Usual> = (0..).map_while(|order| Usual::of(&wood, &mut shapes, order)).collect();
        let mut ids = vec![None; wood.limbs.len()];
        ids[0] = Some(NodeId::ROOT);
        let (mut slots, mut anchored) = (0, Vec::new());
        for (number, limb) in wood.limbs.iter().enumerate() {
            let Some(id) = ids[number].filter(|_| !limb.laterals.is_empty()) else { continue };
            slots += limb.laterals.len();
            if slots > MOST_SLOTS {
                break;
            }
            anchored.push(number);
            for (&lateral, ordinal) in limb.laterals.iter().zip(0..) {
                ids[lateral] = NodeId::child(id, ordinal);
            }
        }
        let axis = shapes[0].axis(&wood.limbs[0]);
        let stem = Stem::of(&wood);
        Self { wood, shapes, stem, axis, usual, ids, anchored }
    }

    /// The design in which these limbs say these things themselves, and what others might say.
    pub(super) fn write(&self, said: &Said) -> Result<(Design, Vec<Wish>), Refusal> {
        let mut writing = Writing {
            writer: self,
            said,
            graph: Graph::default(),
            common: vec![Common::new(); self.usual.len()],
            hidden: said.all().map(|(limb, key)| (usize::from(self.wood.limbs[limb].order), key)).collect(),
            wishes: Vec::new(),
        };
        writing.commons();
        writing.limbs();
        writing.directions()?;
        Ok((Design::of(writing.graph)?, writing.wishes))
    }
}

struct Writing<'a> {
    writer: &'a Writer,
    said: &'a Said,
    graph: Graph,
    common: Vec<Common>,
    /// What limbs of which order say for themselves.
    hidden: BTreeSet<(usize, Key)>,
    wishes: Vec<Wish>,
}

fn owner(order: usize) -> Owner {
    Level::new(order as u8).map_or(Owner::Node(NodeId::ROOT), Owner::Level)
}

fn scalar(key: Key, value: f32) -> Held {
    let (least, most) = key.row().range;
    Held::new(Value::Scalar(value.clamp(least, most)))
}

impl Writing<'_> {
    /// What limbs of an order have without saying anything.
    fn inherited(&self, order: usize, key: Key) -> &Held {
        let said = self.common[..=order].iter().rev().find_map(|common| common.get(&key));
        said.unwrap_or_else(|| key.default())
    }

    /// Says something of an order, unless it costs nothing to inherit it.
    fn say(&mut self, order: usize, key: Key, value: Held) {
        // What a limb says for itself alone hides from what it bears what its order says.
        let hidden = (1..order).filter(|&below| self.hidden.contains(&(below, key)));
        let mut inherited = hidden.map(|below| below - 1).chain([order]);
        if inherited.all(|order| is_same(key, self.inherited(order, key), &value)) {
            return;
        }
        self.record(owner(order)).settings.insert(key, Setting::own(value.clone()));
        self.common[order].insert(key, value);
    }

    fn record(&mut self, owner: Owner) -> &mut Record {
        self.graph.records.entry(owner).or_default()
    }

    fn function(&self, order: usize, key: Key) -> Function {
        match self.inherited(order, key).get() {
            Value::Function(function) => function.clone(),
            _ => unreachable!("{key} is a function"),
        }
    }

    fn number(&self, order: usize, key: Key) -> f32 {
        match self.inherited(order, key).get() {
            Value::Scalar(number) => *number,
            _ => unreachable!("{key} is a number"),
        }
    }

    fn zone(&self, order: usize) -> (f32, f32) {
        match self.inherited(order, Key::Zone).get() {
            &Value::Span(first, last) => (first, last),
            _ => unreachable!("a zone is a span"),
        }
    }

    /// What limbs of each order have in common.
    fn commons(&mut self) {
        let Writer { stem, axis, usual, wood, .. } = self.writer;
        let last = usual.len() - 1;
        self.say(0, Key::Orders, Held::new(Value::Scalar(last as f32)));
        self.say(0, Key::Height, scalar(Key::Height, stem.height));
        self.say(0, Key::Stem, scalar(Key::Stem, wood.limbs[0].radii.first().copied().unwrap_or(0.1)));
        self.say(0, Key::Silhouette, Held::new(Value::Envelope(stem.outline.clone())));
        if stem.cut < 1.0 {
            self.say(0, Key::Cut, scalar(Key::Cut, stem.cut));
        } else {
            self.say(0, Key::Axis, Held::new(Value::Curve(axis.clone())));
        }
        for (order, usual) in usual.iter().enumerate() {
            if order > 0 {
                self.say(order, Key::Cut, scalar(Key::Cut, 1.0));
                self.say(order, Key::Axis, Held::new(Value::Curve(usual.axis.clone())));
                if let Some(outline) = &usual.outline {
                    self.say(order, Key::Silhouette, Held::new(Value::Envelope(outline.clone())));
                }
                self.say(order, Key::Girth, scalar(Key::Girth, usual.girth));
            }
            if order < last {
                self.say(order, Key::Zone, Held::new(Value::Span(usual.zone.0, usual.zone.1)));
                // It belongs to the zone that there is, which may be an inherited one.
                let cut = if order == 0 { stem.cut } else { 1.0 };
                let places: Vec<f32> = self.places(order, cut);
                let most = Key::Density.row().range.1;
                let function = density(&places, usual.laterals, self.zone(order), most);
                self.say(order, Key::Density, Held::new(Value::Function(function)));
            } else {
                let (_, most) = Key::Leaves.row().range;
                let Value::Function(usually) = Key::Leaves.default().get() else { return };
                let leaves = (usually.at(0.5) * usual.foliage).min(most).round();
                self.say(order, Key::Leaves, Held::new(Value::Function(Function::constant(leaves))));
            }
            self.say(order, Key::Internode, scalar(Key::Internode, usual.internode));
            if let Some(taper) = &usual.taper {
                self.say(order, Key::Taper, Held::new(Value::Function(taper.clone())));
            }
        }
    }

    /// Where the laterals of all limbs of an order stand.
    fn places(&self, order: usize, cut: f32) -> Vec<f32> {
        let limbs = self.writer.wood.limbs.iter().filter(|limb| usize::from(limb.order) == order);
        limbs.flat_map(|limb| limb.places.iter().map(|place| place * cut)).collect()
    }

    /// What each limb says that does not depend on where it stands, and the slots of its laterals.
    fn limbs(&mut self) {
        let Writer { wood, shapes, ids, usual, .. } = self.writer;
        for (number, id) in ids.iter().enumerate().skip(1) {
            let Some(id) = *id else { continue };
            if self.said.is_empty() {
                self.wish_of_form(number);
                continue;
            }
            let shape = &shapes[number];
            if self.said.has(number, Key::Axis) {
                self.say_own(id, Key::Axis, Held::new(Value::Curve(shape.axis(&wood.limbs[number]))));
            }
            if let Some(outline) = shape.outline.as_ref().filter(|_| self.said.has(number, Key::Silhouette)) {
                self.say_own(id, Key::Silhouette, Held::new(Value::Envelope(outline.clone())));
            }
            if self.said.has(number, Key::Girth) {
                self.say_own(id, Key::Girth, scalar(Key::Girth, shape.girth));
            }
        }
        let bearers =
            wood.limbs.iter().enumerate().filter(|(_, limb)| usize::from(limb.order) + 1 < usual.len());
        for (number, limb) in bearers {
            let order = usize::from(limb.order);
            let Some(id) = ids[number] else { continue };
            let zone = self.zone(order);
            let mut function = self.function(order, Key::Density);
            let count = limb.places.len() as f32;
            let usually = Places::of(&function, zone, 1).laterals() as f32;
            let off = (count - usually).abs() / count.max(usually).max(1.0);
            if self.said.has(number, Key::Density) {
                function = density(&limb.places, count, zone, Key::Density.row().range.1);
                self.say_own(id, Key::Density, Held::new(Value::Function(function.clone())));
            } else if number > 0 && off > 0.0 && limb.says() {
                let length = shapes[number].length;
                let gain = 0.2 * off * limb.size().max(length * usual[order].foliage) * length;
                self.wishes.push(Wish { limb: number, key: Key::Density, gain });
            }
            // Where there are too many, those of higher orders follow from the density alone.
            if limb.laterals.first().is_none_or(|&lateral| ids[lateral].is_none()) {
                continue;
            }
            let places = Places::of(&function, zone, 1);
            let cut = if number == 0 { self.writer.stem.cut } else { 1.0 };
            let slot = |(ordinal, &lateral): (u16, &usize)| {
                let at = wood.limbs[lateral].bearer.map_or(0.0, |(_, at)| limb.share(at)) * cut;
                let home = places.share_at(at);
                Slot { ordinal, home, azimuth: None, anchor: Some(at.clamp(0.0, 1.0)), place: None }
            };
            self.graph.slots.insert(id, (0..).zip(&limb.laterals).map(slot).collect());
        }
    }

    /// What a limb might say of its form.
    fn wish_of_form(&mut self, number: usize) {
        let Writer { wood, shapes, usual, .. } = self.writer;
        let (limb, shape) = (&wood.limbs[number], &shapes[number]);
        if !limb.says() {
            return;
        }
        let order = usize::from(limb.order);
        let amount = limb.size() * shape.length;
        let common = self.inherited(order, Key::Silhouette).clone();
        let mut wish = |key: Key, gain: f32| self.wishes.push(Wish { limb: number, key, gain });
        let (off, farthest) = apart(&shape.course, &usual[order].course);
        if farthest * shape.length > SAME_COURSE {
            wish(Key::Axis, amount * off);
        }
        if let (Some(outline), Value::Envelope(common)) = (&shape.outline, common.get()) {
            let off = outline::difference(outline, common);
            if off > SAME_OUTLINE {
                wish(Key::Silhouette, 0.05 * amount * off);
            }
        }
        let girth = usual[order].girth;
        let off = (shape.girth - girth).abs();
        if off > SAME * shape.girth.max(girth) {
            wish(Key::Girth, limb.radii.len() as f32 * off * limb.bearer_radius);
        }
    }

    /// Says something of one limb.
    fn say_own(&mut self, id: NodeId, key: Key, value: Held) {
        self.record(Owner::Node(id)).settings.insert(key, Setting::own(value).private());
    }

    /// Which way limbs go and how long they are, order by order, for that depends on how their bearers stand.
    fn directions(&mut self) -> Result<(), Refusal> {
        let Writer { wood, shapes, anchored, ids, usual, .. } = self.writer;
        let design = Design::of(self.graph.clone())?;
        // What the design has laid out is what there is.
        self.graph.slots = design.graph().slots.clone();
        let (_, farthest) = Key::Reach.row().range;
        let mut standing: BTreeMap<usize, Placed> = BTreeMap::from([(0, stem(design.root()))]);
        for order in 0..usual.len() - 1 {
            let mut going = Vec::new();
            for &number in anchored.iter().filter(|&&limb| usize::from(wood.limbs[limb].order) == order) {
                let (Some(id), Some(placed)) = (ids[number], standing.get(&number)) else { continue };
                let Some(branch) = design.branch(id) else { continue };
                let laid = lay(branch, placed, 0);
                for &(lateral, node) in &laid.laterals {
                    let ordinal = lateral.id().bearer().map(|(_, ordinal)| usize::from(ordinal));
                    let of = ordinal.and_then(|ordinal| wood.limbs[number].laterals.get(ordinal));
                    if let Some(&of) = of {
                        let way = Going::of(of, lateral.t(), laid.nodes[node], wood.limbs[of].chord());
                        going.push((way, placed, lateral));
                    }
                }
            }
            let weighed: Vec<(&Going, f32)> =
                going.iter().map(|(going, ..)| (going, wood.limbs[going.limb].size())).collect();
            let pull = pull(&weighed);
            self.say(order + 1, Key::Pull, Held::new(Value::Vector(pull)));
            let pull = match self.inherited(order + 1, Key::Pull).get() {
                Value::Vector(pull) => *pull,
                _ => unreachable!("a pull is a vector"),
            };
            going.iter_mut().for_each(|(going, ..)| going.draw(pull));
            let range = Key::BranchingAngle.row().range;
            let bearer = |limb: usize| wood.limbs[limb].bearer.map_or(0, |(bearer, _)| bearer);
            let mut angles: BTreeMap<usize, Vec<Angle>> = BTreeMap::new();
            for (Going { limb, t, angle, .. }, ..) in &going {
                let force = wood.limbs[*limb].size() * shapes[*limb].length;
                let angle = Angle { t: *t, degrees: *angle, force, length: shapes[*limb].length };
                angles.entry(bearer(*limb)).or_default().push(angle);
            }
            let common = match angles.get(&0) {
                // What bears limbs is one axis.
                Some(angles) => along(angles.iter().map(Angle::weighed).collect(), range),
                None => fitted(angles.values().flatten().map(|angle| (angle.t, angle.degrees)), range),
            };
            if let Some(angle) = common {
                self.say(order, Key::BranchingAngle, Held::new(Value::Function(angle)));
            }
            let angle = self.function(order, Key::BranchingAngle);
            let own = self.own_angles(&angles, &angle);
            let angle_of = |going: &Going| own.get(&bearer(going.limb)).unwrap_or(&angle).at(going.t);
            // Which way each goes in the design, and how far its bearer's outline is there.
            let directions: Vec<Vec3> = (going.iter())
                .map(|(going, ..)| match self.said.has(going.limb, Key::Turn) {
                    true => going.direction,
                    false => going.unturned(angle_of(going), pull),
                })
                .collect();
            let ways: Vec<f32> = (going.iter().zip(&directions))
                .map(|((going, bearer, _), &direction)| {
                    bearer.distance(going.node.place, direction).unwrap_or(OUTSIDE).max(0.05)
                })
                .collect();
            let length = |limb: usize| shapes[limb].length;
            // All of them that say nothing themselves are together as long as they were.
            let silent =
                (going.iter().zip(&ways)).filter(|((going, ..), _)| !self.said.has(going.limb, Key::Reach));
            let (lengths, far) = silent.fold((0.0, 0.0), |(lengths, far), ((going, ..), way)| {
                (lengths + length(going.limb), far + way)
            });
            let all = if far > 0.0 { lengths / far } else { 1.0 };
            self.say(order + 1, Key::Reach, scalar(Key::Reach, all));
            let common = self.number(order + 1, Key::Reach);
            let mut stand = Vec::new();
            for (((going, bearer, lateral), &direction), &way) in going.iter().zip(&directions).zip(&ways) {
                let limb = going.limb;
                let Some(id) = ids[limb] else { continue };
                self.turn_slot(id, going.azimuth);
                let reach = (length(limb) / way).min(farthest);
                let off = 0.5 * length(limb) * wood.limbs[limb].size();
                let by = turn_between(going.unturned(angle_of(going), pull), going.direction);
                if self.said.has(limb, Key::Turn) {
                    self.say_own(id, Key::Turn, Held::new(Value::Vector(bearer.frame.transpose() * by)));
                } else if by.length().to_radians() * length(limb) > SAME_PLACE && wood.limbs[limb].says() {
                    self.wishes.push(Wish { limb, key: Key::Turn, gain: off * by.length().to_radians() });
                }
                let says = self.said.has(limb, Key::Reach);
                if says {
                    self.say_own(id, Key::Reach, scalar(Key::Reach, reach));
                } else if (reach - common).abs() * way > SAME_PLACE {
                    // Without it wood stands elsewhere, or more than there was.
                    let without = way * common;
                    let nodes = wood.limbs[limb].size().max(without * usual[order + 1].foliage);
                    let gain = 0.5 * (without - length(limb)).abs() * nodes;
                    self.wishes.push(Wish { limb, key: Key::Reach, gain });
                }
                let length = way * if says { reach } else { common };
                stand.push((limb, placed_at(lateral, &going.node, direction, length)));
            }
            standing.extend(stand);
        }
        Ok(())
    }

    /// The angles that limbs say their laterals stand at, and which might say it besides.
    fn own_angles(
        &mut self,
        angles: &BTreeMap<usize, Vec<Angle>>,
        usual: &Function,
    ) -> BTreeMap<usize, Function> {
        let key = Key::BranchingAngle;
        let mut own = BTreeMap::new();
        for (&limb, angles) in angles.iter().filter(|&(&limb, angles)| limb > 0 && angles.len() > 1) {
            let Some(id) = self.writer.ids[limb] else { continue };
            if !self.said.has(limb, key) {
                let gain = 0.5 * angles.iter().map(|angle| angle.off(usual)).sum::<f32>();
                self.wishes.push(Wish { limb, key, gain });
            } else if let Some(function) = along(angles.iter().map(Angle::weighed).collect(), key.row().range)
            {
                self.say_own(id, key, Held::new(Value::Function(function.clone())));
                own.insert(limb, function);
            }
        }
        own
    }

    fn turn_slot(&mut self, id: NodeId, azimuth: f32) {
        let Some((bearer, ordinal)) = id.bearer() else { return };
        let slots = self.graph.slots.get_mut(&bearer).into_iter().flatten();
        slots.filter(|slot| slot.ordinal == ordinal).for_each(|slot| slot.azimuth = Some(azimuth));
    }
}
