//! The arena: plants growing, losing branches, and travelling in time.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::{
    axes::Axes,
    deaths::ALIVE,
    edits::Edit,
    hash::StableHash,
    id::{AxisId, MetamerId},
    metamers::{Condition, Metamers, Row},
    timeline::{StepEnd, Timeline},
};

/// One or several plants in one scene, with their whole history.
///
/// Rows beyond the present are the future that was gone back from; it stays until something new is recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    pub(crate) metamers: Metamers,
    pub(crate) axes: Axes,
    pub(crate) timeline: Timeline,
    /// Axes grafted onto nodes, beside those the nodes have borne themselves.
    pub(crate) grafts: BTreeMap<MetamerId, Vec<AxisId>>,
    /// Width constraints of the present, those on dead metamers included: diameters in internodes.
    pub(crate) widths: BTreeMap<MetamerId, f32>,
    /// Wraps while parts from outside are tried out; the checks compare it with a count.
    pub(crate) living: u32,
}

/// Metamers on the way from a tip to its seed, roughly: only speed depends on it.
const TYPICAL_DEPTH: usize = 128;

/// What the bud of an axis adds to it.
#[derive(Clone, Copy, Debug)]
pub struct Internode<'a> {
    /// Where the new node is.
    pub end: Vec3,
    /// Unit vector across the internode towards the first lateral bud.
    pub normal: Vec3,
    /// Unit directions of the lateral buds at the new node.
    pub laterals: &'a [Vec3],
}

impl Plant {
    /// One seed at `position`, in step 0.
    pub fn new(position: Vec3) -> Self {
        let mut plant = Self {
            metamers: Metamers::default(),
            axes: Axes::default(),
            timeline: Timeline { recording: true, ..Timeline::default() },
            grafts: BTreeMap::new(),
            widths: BTreeMap::new(),
            living: 0,
        };
        plant.sow(position);
        plant.end_step();
        plant
    }

    /// The columns of metamers. Rows at [`Plant::metamer_count`] and beyond are not in the present.
    pub fn metamers(&self) -> &Metamers {
        &self.metamers
    }

    /// The columns of axes. Rows at [`Plant::axis_count`] and beyond are not in the present.
    pub fn axes(&self) -> &Axes {
        &self.axes
    }

    /// Metamers ever born up to the present, seeds and the dead included.
    pub fn metamer_count(&self) -> usize {
        if self.timeline.recording {
            self.metamers.parent.len()
        } else {
            self.timeline.present().metamers as usize
        }
    }

    /// Metamers of the whole line of time: those ever born up to the present, and those recorded beyond it.
    pub fn recorded_metamers(&self) -> usize {
        self.metamers.parent.len()
    }

    /// Axes ever born up to the present, buds and the dead included.
    pub fn axis_count(&self) -> usize {
        if self.timeline.recording { self.axes.bearer.len() } else { self.timeline.present().axes as usize }
    }

    /// Living metamers, seeds not counted.
    pub fn living_count(&self) -> u32 {
        self.living
    }

    /// Axes with living wood; buds are not counted.
    pub fn living_axes_count(&self) -> u32 {
        (0..self.axis_count()).map(AxisId::new).filter(|&axis| self.has_living_wood(axis)).count() as u32
    }

    /// Whether an axis has living wood, with or without a bud at its end (a seed is none).
    pub fn has_living_wood(&self, axis: AxisId) -> bool {
        let Some(first) = self.axes.first(axis).filter(|&first| self.is_alive(first)) else { return false };
        if !self.is_seed(first) {
            return true;
        }
        // A trunk that was cut may be cut down to its seed.
        let is_wood = |id: MetamerId| self.metamers.axis(id) == axis && self.is_alive(id) && id != first;
        match self.is_axis_alive(axis) {
            true => self.has_grown(axis),
            false => (first.index()..self.metamer_count()).map(MetamerId::new).any(is_wood),
        }
    }

    /// The present step.
    pub fn step(&self) -> u32 {
        self.timeline.now
    }

    /// The last step recorded; beyond [`Plant::step`] if the plant has gone back in time.
    pub fn last_step(&self) -> u32 {
        self.timeline.ends.len() as u32 - 1
    }

    /// What was cut off in a step, each with all that stood on it.
    pub fn cut_in(&self, step: u32) -> impl Iterator<Item = MetamerId> {
        let [from, to] =
            [self.timeline.before(step), self.timeline.before(step + 1)].map(|end| end.edits as usize);
        let edits = self.timeline.edits.get(from..to).unwrap_or_default();
        edits.iter().filter_map(|edit| if let Edit::Pruned(cut) = edit { Some(*cut) } else { None })
    }

    /// Steps of growth up to the present; edits are none.
    pub fn growths(&self) -> u32 {
        self.timeline.growths_at(self.timeline.now)
    }

    /// The step in which a metamer of the present was born.
    pub fn birth(&self, id: MetamerId) -> u32 {
        self.timeline.step_of(|end| end.metamers, id.raw())
    }

    /// How many metamers had been born by the end of a step, at most those of the present.
    pub fn born_by(&self, step: u32) -> u32 {
        self.timeline.ends[step.min(self.timeline.now) as usize].metamers
    }

    /// The step in which the bud of an axis of the present was born.
    pub fn axis_birth(&self, id: AxisId) -> u32 {
        self.timeline.step_of(|end| end.axes, id.raw())
    }

    /// Whether a metamer of the present is alive.
    pub fn is_alive(&self, id: MetamerId) -> bool {
        self.metamers.death.of(id.index()) > self.timeline.now
    }

    /// Steps of growth that a metamer of the present has lived through; edits take no time.
    pub fn age(&self, id: MetamerId) -> u32 {
        self.growths() - self.timeline.growths_at(self.birth(id))
    }

    /// For each number of steps of growth from 0 up, how many metamers had been born when so many had been taken; edits
    /// belong to the step of growth before them.
    pub fn births(&self) -> Vec<u32> {
        let mut births = Vec::new();
        for end in self.timeline.ends.iter().take(self.timeline.now as usize + 1) {
            births.resize(end.growths as usize + 1, end.metamers);
            if let Some(last) = births.last_mut() {
                *last = end.metamers;
            }
        }
        births
    }

    /// Whether the bud of an axis of the present is alive. Of an axis that was cut, wood without a bud remains.
    pub fn is_axis_alive(&self, id: AxisId) -> bool {
        self.axes.death.of(id.index()) > self.timeline.now
    }

    /// Whether a metamer is a seed: a point where a trunk begins.
    pub fn is_seed(&self, id: MetamerId) -> bool {
        self.metamers.parent[id.index()] == MetamerId::NONE
    }

    /// Whether a living seed lies at a place.
    pub fn has_seed_at(&self, place: Vec3) -> bool {
        let all = (0..self.metamer_count()).map(MetamerId::new);
        all.filter(|&id| self.is_seed(id)).any(|id| self.is_alive(id) && self.metamers.end(id) == place)
    }

    /// Unit direction of a metamer; its trunk's first direction for a seed.
    pub fn heading(&self, id: MetamerId) -> Vec3 {
        match self.metamers.parent(id) {
            Some(parent) => (self.metamers.end(id) - self.metamers.end(parent)).normalize(),
            None => self.axes.direction(self.metamers.axis(id)),
        }
    }

    /// The metamer at whose node the bud of an axis sits.
    pub fn bud_node(&self, id: AxisId) -> MetamerId {
        let last = self.axes.last[id.index()];
        if last == MetamerId::NONE { self.axes.bearer[id.index()] } else { last }
    }

    /// The lateral axes that a metamer's node bears: those it has laid down, the dead included, and its grafts.
    pub fn laterals(&self, id: MetamerId) -> impl Iterator<Item = AxisId> + use<'_> {
        let grafts = if self.grafts.is_empty() { None } else { self.grafts.get(&id) };
        self.whorl(id).chain(grafts.into_iter().flatten().copied())
    }

    /// The lateral axes that a metamer's node has laid down, the dead included.
    pub(crate) fn whorl(&self, id: MetamerId) -> impl Iterator<Item = AxisId> + use<> {
        let first = self.metamers.lateral[id.index()];
        let end = self.axis_count();
        let from = if first == AxisId::NONE { end } else { first.index() };
        let mut borne = self.axes.bearer[from..end].iter().take_while(|&&bearer| bearer == id).count();
        // A graft that was made right after it follows the whorl without being of it.
        if !self.grafts.is_empty() {
            borne = (from..from + borne).take_while(|&axis| !self.is_graft(AxisId::new(axis))).count();
        }
        (from..from + borne).map(AxisId::new)
    }

    /// Whether an axis was grafted onto the node that bears it.
    pub(crate) fn is_graft(&self, id: AxisId) -> bool {
        self.grafts.get(&self.axes.bearer[id.index()]).is_some_and(|grafts| grafts.contains(&id))
    }

    /// Whether an axis has a living bud, or living wood whose bud was cut off.
    pub fn is_standing(&self, id: AxisId) -> bool {
        self.is_axis_alive(id) || self.axes.first(id).is_some_and(|first| self.is_alive(first))
    }

    /// Where the bud of an axis is.
    pub fn bud_position(&self, id: AxisId) -> Vec3 {
        self.metamers.end(self.bud_node(id))
    }

    /// Unit direction in which the bud of an axis points.
    pub fn bud_direction(&self, id: AxisId) -> Vec3 {
        match self.axes.last(id) {
            Some(last) => self.heading(last),
            None => self.axes.direction(id),
        }
    }

    /// Whether an axis has grown at least one metamer (a seed is none).
    pub fn has_grown(&self, id: AxisId) -> bool {
        self.axes.last(id).is_some_and(|last| !self.is_seed(last))
    }

    /// Starts a new step of growth; whatever future there was is forgotten, unless it was
    /// [stashed](Plant::stash_future).
    ///
    /// # Panics
    /// If a step is being recorded already.
    pub fn begin_step(&mut self) {
        self.begin(true);
    }

    /// Starts a step in which nothing grows older: an edit.
    ///
    /// # Panics
    /// If a step is being recorded already.
    pub fn begin_edit(&mut self) {
        self.begin(false);
    }

    fn begin(&mut self, grows: bool) {
        assert!(!self.timeline.recording, "steps do not nest");
        if self.timeline.now < self.last_step() {
            self.stash_future();
        }
        self.timeline.now += 1;
        self.timeline.recording = true;
        self.timeline.grows = grows;
    }

    /// Ends the step: girth follows from what has grown. A step in which nothing happened is not recorded, so
    /// that going back one step always shows; returns whether it was.
    pub fn end_step(&mut self) -> bool {
        debug_assert!(self.timeline.recording, "end_step follows begin_step");
        let before = self.timeline.before(self.timeline.now);
        let end = StepEnd {
            metamers: self.metamers.parent.len() as u32,
            axes: self.axes.bearer.len() as u32,
            edits: self.timeline.edits.len() as u32,
            growths: before.growths,
        };
        self.timeline.recording = false;
        if self.timeline.now > 0 && end == before {
            self.timeline.grows = false;
            self.timeline.now -= 1;
            return false;
        }
        self.thicken_from(before.metamers as usize, self.metamers.parent.len());
        self.scar(before.edits as usize..end.edits as usize, 1);
        let growths = before.growths + u32::from(std::mem::take(&mut self.timeline.grows));
        self.timeline.ends.push(StepEnd { growths, ..end });
        true
    }

    /// Plants a seed, within a step.
    pub fn sow(&mut self, position: Vec3) -> AxisId {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        let axis = self.axes.push(MetamerId::NONE, Vec3::Y, 0);
        let seed = self.metamers.push(&Row {
            parent: MetamerId::NONE,
            axis,
            end: position,
            normal: Vec3::X,
            lateral: AxisId::NONE,
        });
        self.axes.first[axis.index()] = seed;
        self.axes.last[axis.index()] = seed;
        axis
    }

    /// Lets the bud of an axis add one internode, within a step.
    pub fn extend(&mut self, axis: AxisId, internode: &Internode<'_>) -> MetamerId {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        debug_assert!(self.is_axis_alive(axis), "a dead bud does not grow");
        let parent = self.bud_node(axis);
        let id = self.metamers.push(&Row {
            parent,
            axis,
            end: internode.end,
            normal: internode.normal,
            lateral: if internode.laterals.is_empty() { AxisId::NONE } else { self.axes.next() },
        });
        self.link(id);
        self.living = self.living.wrapping_add(1);
        let order = self.axes.order(axis) + 1;
        for &direction in internode.laterals {
            self.axes.push(id, direction, order);
        }
        id
    }

    /// Enters a metamer into its axis.
    pub(crate) fn link(&mut self, id: MetamerId) {
        let axis = self.metamers.axis[id.index()];
        let parent = self.metamers.parent[id.index()];
        if self.axes.first[axis.index()] == MetamerId::NONE || parent == MetamerId::NONE {
            self.axes.first[axis.index()] = id;
        }
        self.axes.last[axis.index()] = id;
    }

    /// Enters the metamers of a range of rows, the last of the present, which have no tips yet, into the girth of those below them.
    pub(crate) fn thicken_from(&mut self, born: usize, count: usize) {
        // Each new axis is a path down to the roots; where there are many, one pass over all wood is shorter.
        if (count - born) * TYPICAL_DEPTH < count {
            for index in born..count {
                self.thicken(MetamerId::new(index));
            }
            return;
        }
        let mut gains = Gains::new(count);
        for index in (born..count).rev() {
            let id = MetamerId::new(index);
            if self.is_seed(id) {
                continue;
            }
            self.metamers.tips[index] = 1;
            if self.begins_wood(id) {
                gains.add(self.metamers.parent[index].index(), 1);
            }
        }
        for index in (0..count).rev() {
            let gain = gains.at(index);
            if gain == 0 {
                continue;
            }
            self.metamers.tips[index] = self.metamers.tips[index].wrapping_add(gain);
            if let Some(parent) = self.metamers.parent[index].some() {
                gains.add(parent.index(), gain);
            }
        }
    }

    /// Enters a metamer into the girth of those below it.
    fn thicken(&mut self, id: MetamerId) {
        if self.is_seed(id) {
            return;
        }
        // A continuing metamer takes over the tip its parent carried until now.
        self.metamers.tips[id.index()] = 1;
        if self.begins_wood(id) {
            self.add_tips(self.metamers.parent[id.index()], 1);
        }
    }

    pub(crate) fn unlink(&mut self, id: MetamerId) {
        let axis = self.metamers.axis[id.index()];
        let parent = self.metamers.parent[id.index()];
        if parent != MetamerId::NONE && self.begins_wood(id) {
            self.add_tips(parent, -1);
        }
        self.metamers.tips[id.index()] = 0;
        if self.axes.first[axis.index()] == id {
            self.axes.first[axis.index()] = MetamerId::NONE;
            self.axes.last[axis.index()] = MetamerId::NONE;
        } else {
            self.axes.last[axis.index()] = parent;
        }
    }

    /// Whether a metamer is the first wood of its axis, so that a new tip came with it.
    pub(crate) fn begins_wood(&self, id: MetamerId) -> bool {
        let parent = self.metamers.parent[id.index()];
        self.metamers.axis[parent.index()] != self.metamers.axis[id.index()] || self.is_seed(parent)
    }

    pub(crate) fn add_tips(&mut self, from: MetamerId, change: i32) {
        let mut id = from;
        while id != MetamerId::NONE {
            let tips = &mut self.metamers.tips[id.index()];
            *tips = tips.wrapping_add_signed(change);
            id = self.metamers.parent[id.index()];
        }
    }

    /// Writes how much light and vigor a metamer has.
    pub fn set_condition(&mut self, id: MetamerId, condition: Condition) {
        self.metamers.condition[id.index()] = condition;
    }

    /// A hash of the present: equal plants, equal hash, on every machine. Condition is not part of it.
    pub fn hash(&self) -> u64 {
        let mut hash = StableHash::default();
        hash.word(u64::from(self.timeline.now));
        for index in 0..self.metamer_count() {
            let id = MetamerId::new(index);
            let m = &self.metamers;
            hash.word(u64::from(m.parent[index].raw()) | u64::from(m.axis[index].raw()) << 32);
            let death = if self.is_alive(id) { ALIVE } else { m.death.of(index) };
            hash.word(u64::from(self.birth(id)) | u64::from(death) << 32);
            hash.vector(m.end[index]);
            hash.vector(m.normal[index]);
            hash.word(u64::from(m.tips[index]));
        }
        for index in 0..self.axis_count() {
            let a = &self.axes;
            hash.word(u64::from(a.bearer[index].raw()) | u64::from(a.last[index].raw()) << 32);
            hash.vector(a.direction[index]);
            hash.word(u64::from(self.is_axis_alive(AxisId::new(index))));
        }
        for (id, diameter) in self.widths() {
            hash.word(u64::from(id.raw()) | u64::from(diameter.to_bits()) << 32);
        }
        for (id, radius) in self.given_radii() {
            // The other way about than a width constraint.
            hash.word(u64::from(radius.to_bits()) | u64::from(id.raw()) << 32);
        }
        let given = self.metamers.given_organs.rows().map(|(row, organs)| (MetamerId::new(row), organs));
        for (id, organs) in given.filter(|(id, _)| id.index() < self.metamer_count() && self.is_alive(*id)) {
            let organs = organs.iter().flat_map(|organs| organs.iter());
            hash.word(u64::from(id.raw()) | 1 << 63);
            organs.for_each(|organ| hash.word(u64::from(organ.to_number())));
        }
        hash.finish()
    }
}

/// Tips that metamers have gained in a step. Most gain few, and a column of bytes stays in the cache.
struct Gains {
    few: Vec<u8>,
    /// Gains of those whose byte says [`Gains::MANY`].
    many: BTreeMap<usize, u32>,
}

impl Gains {
    const MANY: u8 = u8::MAX;

    fn new(count: usize) -> Self {
        Self { few: vec![0; count], many: BTreeMap::new() }
    }

    fn at(&self, index: usize) -> u32 {
        match self.few[index] {
            Self::MANY => self.many.get(&index).copied().unwrap_or(0),
            few => u32::from(few),
        }
    }

    fn add(&mut self, index: usize, gain: u32) {
        let sum = self.at(index) + gain;
        match u8::try_from(sum) {
            Ok(few) if few != Self::MANY => self.few[index] = few,
            _ => {
                self.few[index] = Self::MANY;
                self.many.insert(index, sum);
            }
        }
    }
}
