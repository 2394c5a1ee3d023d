//! All branches of a design with their values, kept up to date by visiting what a change reaches.

use std::sync::Arc;

use espalier_plant::hash::StableHash;

use crate::{
    graph::{Graph, Owner},
    key::Key,
    node::{MAX_ORDER, NodeId},
    patch::Patch,
    places::Places,
    slots::{Slot, laid_out},
    table::{Table, Tables, tables},
};

/// Most branches of a design, those too short to be seen included.
pub const MAX_BRANCHES: usize = 65_536;

/// A branch with its values and its laterals.
#[derive(Clone, Debug)]
pub struct Branch {
    id: NodeId,
    t: f32,
    azimuth: f32,
    home: f32,
    mine: Arc<Table>,
    pass: Arc<Table>,
    laterals: Vec<Branch>,
    /// It and all that it bears.
    count: usize,
    /// A hash of all that.
    stamp: u64,
}

impl PartialEq for Branch {
    fn eq(&self, other: &Self) -> bool {
        (self.id, self.t.to_bits(), self.azimuth.to_bits(), self.count, self.stamp)
            == (other.id, other.t.to_bits(), other.azimuth.to_bits(), other.count, other.stamp)
            && *self.mine == *other.mine
            && *self.pass == *other.pass
            && self.laterals == other.laterals
    }
}

impl Branch {
    fn new(id: NodeId, table: &Arc<Table>) -> Self {
        Self {
            id,
            t: 0.0,
            azimuth: 0.0,
            home: 0.0,
            mine: table.clone(),
            pass: table.clone(),
            laterals: Vec::new(),
            count: 1,
            stamp: 0,
        }
    }

    /// Its name.
    pub fn id(&self) -> NodeId {
        self.id
    }

    /// Where on its bearer's axis it stands.
    pub fn t(&self) -> f32 {
        self.t
    }

    /// Its angle around its bearer's axis in degrees.
    pub fn azimuth(&self) -> f32 {
        self.azimuth
    }

    /// Its values.
    pub fn values(&self) -> &Table {
        &self.mine
    }

    /// Its values, to keep.
    pub fn table(&self) -> &Arc<Table> {
        &self.mine
    }

    /// Its laterals, from its base to its tip.
    pub fn laterals(&self) -> &[Self] {
        &self.laterals
    }

    /// It and all that it bears.
    pub fn count(&self) -> usize {
        self.count
    }

    /// A hash of its values and of everything above it.
    pub fn stamp(&self) -> u64 {
        self.stamp
    }

    /// A branch that stands on it, or it itself.
    pub fn find(&self, id: NodeId) -> Option<&Self> {
        let mut found = self;
        for order in self.id.order() + 1..=id.order() {
            let next = id.up_to(order);
            found = found.laterals.iter().find(|lateral| lateral.id == next)?;
        }
        (found.id == id).then_some(found)
    }

    /// It and all that it bears, bearers first.
    pub fn walk<'a>(&'a self, visit: &mut impl FnMut(&'a Self)) {
        visit(self);
        self.laterals.iter().for_each(|lateral| lateral.walk(visit));
    }

    /// Its laterals as slots, as they stand without any memory.
    pub(crate) fn implied_slots(&self) -> Vec<Slot> {
        let slot = |(place, lateral): (u16, &Self)| {
            let ordinal = lateral.id.bearer().map_or(0, |(_, ordinal)| ordinal);
            Slot { ordinal, home: lateral.home, azimuth: None, anchor: None, place: Some(place) }
        };
        let mut slots: Vec<_> = (0..).zip(&self.laterals).map(slot).collect();
        slots.sort_by_key(|slot| slot.ordinal);
        slots
    }

    pub(crate) fn places(&self) -> Places {
        places(&self.mine)
    }
}

fn places(values: &Table) -> Places {
    let whorl = values.scalar(Key::Whorl) as usize;
    Places::of(values.function(Key::Density), values.span(Key::Zone), whorl)
}

/// What of a graph has changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dirty {
    /// Branches of which something else is said, in order.
    nodes: Vec<NodeId>,
    /// The highest order whose level says something else.
    level: u8,
}

impl Dirty {
    /// All of it.
    pub(crate) fn everything() -> Self {
        Self { nodes: Vec::new(), level: MAX_ORDER }
    }

    pub(crate) fn of(patch: &Patch, graph: &Graph) -> Self {
        let mut dirty = Self { nodes: patch.slots.keys().copied().collect(), level: 0 };
        for owner in patch.records.keys() {
            match owner {
                Owner::Level(level) => dirty.level = dirty.level.max(level.order()),
                Owner::Node(node) => dirty.nodes.push(*node),
            }
        }
        for &share in patch.shares.keys() {
            dirty.nodes.extend(graph.members(share));
        }
        dirty.nodes.sort_unstable();
        dirty.nodes.dedup();
        dirty
    }

    /// Whether something within a branch may have changed.
    fn touches(&self, id: NodeId) -> bool {
        let within = id.subtree();
        let at = self.nodes.partition_point(|node| node < within.start());
        id.order() <= self.level && self.level > 0
            || self.nodes.get(at).is_some_and(|node| within.contains(node))
    }
}

/// What a change has reached.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reached {
    /// Branches whose values or laterals are others than before, new ones included; each after what it bears.
    pub changed: Vec<NodeId>,
    /// How many branches were looked at.
    pub visited: usize,
}

/// A design grows too many branches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Overgrown;

/// A tree of all branches from scratch; slots of the graph that no longer fit are laid out anew.
pub(crate) fn resolve(graph: &mut Graph, undo: &mut Patch) -> Result<Branch, Overgrown> {
    let mut root = Branch::new(NodeId::ROOT, &Arc::new(Table::default()));
    refresh(&mut root, graph, &Dirty::everything(), undo)?;
    Ok(root)
}

/// Brings a tree up to date with a graph.
pub(crate) fn refresh(
    root: &mut Branch,
    graph: &mut Graph,
    dirty: &Dirty,
    undo: &mut Patch,
) -> Result<Reached, Overgrown> {
    let mut refresh = Refresh { graph, dirty, undo, new: 0, reached: Reached::default() };
    let table = Arc::new(Table::default());
    refresh.branch(root, Tables { mine: table.clone(), pass: table.clone(), along: table }, false)?;
    if root.count > MAX_BRANCHES { Err(Overgrown) } else { Ok(refresh.reached) }
}

struct Refresh<'a> {
    graph: &'a mut Graph,
    dirty: &'a Dirty,
    undo: &'a mut Patch,
    new: usize,
    reached: Reached,
}

impl Refresh<'_> {
    /// Visits a branch; returns what the next one on the same axis gets. `from.pass` is what its bearer passes on.
    fn branch(&mut self, branch: &mut Branch, from: Tables, is_new: bool) -> Result<Arc<Table>, Overgrown> {
        self.reached.visited += 1;
        let next = tables(self.graph, branch.id, &from.pass, &from.along);
        let is_same = *next.mine == *branch.mine && *next.pass == *branch.pass;
        if is_same && !is_new && !self.dirty.touches(branch.id) {
            return Ok(next.along);
        }
        if !is_same {
            (branch.mine, branch.pass) = (next.mine, next.pass);
        }
        if self.laterals(branch)? || !is_same || is_new {
            self.reached.changed.push(branch.id);
        }
        branch.count = 1 + branch.laterals.iter().map(|lateral| lateral.count).sum::<usize>();
        let mut stamp = StableHash::default();
        stamp.word(branch.mine.hash());
        for lateral in &branch.laterals {
            stamp.word(lateral.id.raw());
            stamp.word(u64::from(lateral.t.to_bits()) | u64::from(lateral.azimuth.to_bits()) << 32);
            stamp.word(lateral.stamp);
        }
        branch.stamp = stamp.finish();
        Ok(next.along)
    }

    /// Brings the laterals of a branch up to date; whether others stand there, or elsewhere.
    fn laterals(&mut self, branch: &mut Branch) -> Result<bool, Overgrown> {
        let wanted = self.stands(branch);
        let mut old: Vec<Option<Branch>> =
            std::mem::take(&mut branch.laterals).into_iter().map(Some).collect();
        let mut differs = old.len() != wanted.len();
        let mut along = branch.pass.clone();
        branch.laterals.reserve(wanted.len());
        for (at, stand) in wanted.into_iter().enumerate() {
            let is_it = |branch: &Option<Branch>| branch.as_ref().is_some_and(|branch| branch.id == stand.id);
            let found = if old.get(at).is_some_and(is_it) { Some(at) } else { old.iter().position(is_it) };
            let known = found.and_then(|found| old[found].take());
            let is_new = known.is_none();
            let mut lateral = known.unwrap_or_else(|| Branch::new(stand.id, &branch.pass));
            let moved = (lateral.t.to_bits(), lateral.azimuth.to_bits());
            differs |= is_new || found != Some(at) || moved != (stand.t.to_bits(), stand.azimuth.to_bits());
            (lateral.t, lateral.azimuth, lateral.home) = (stand.t, stand.azimuth, stand.home);
            if is_new {
                self.new += 1;
                if self.new > MAX_BRANCHES {
                    return Err(Overgrown);
                }
            }
            let from = Tables { mine: branch.pass.clone(), pass: branch.pass.clone(), along };
            along = self.branch(&mut lateral, from, is_new)?;
            branch.laterals.push(lateral);
        }
        Ok(differs)
    }

    /// Where the laterals of a branch stand, from its base to its tip.
    fn stands(&mut self, branch: &Branch) -> Vec<Stand> {
        let values = &*branch.mine;
        let bears = f32::from(branch.id.order()) < values.scalar(Key::Orders);
        let places = places(values);
        let shares = if bears { places.shares() } else { Vec::new() };
        let (first, step) = (values.scalar(Key::Azimuth), values.scalar(Key::Phyllotaxis));
        let azimuth = |lateral: usize| {
            let (place, turn) = places.place(lateral);
            first + step * place as f32 + 360.0 * turn
        };
        let mut stands: Vec<Stand> = match self.graph.slots.get(&branch.id) {
            None => (shares.iter().enumerate())
                .filter_map(|(at, &home)| {
                    let id = branch.id.child(at as u16)?;
                    Some(Stand { id, t: places.at(home), azimuth: azimuth(at), home })
                })
                .collect(),
            Some(slots) => {
                let awake = slots.iter().filter(|slot| slot.place.is_some()).count();
                if awake != shares.len() {
                    let is_personal = |slot: &Slot| {
                        branch.id.child(slot.ordinal).is_some_and(|child| self.graph.is_personal(child))
                    };
                    let laid = laid_out(slots, is_personal, &shares);
                    self.undo.note_slots(self.graph, branch.id);
                    self.graph.slots.insert(branch.id, laid);
                }
                let slots = self.graph.slots.get(&branch.id).map_or(&[][..], Vec::as_slice);
                let stand = |slot: &Slot| {
                    let place = usize::from(slot.place?);
                    let share = *shares.get(place)?;
                    Some(Stand {
                        id: branch.id.child(slot.ordinal)?,
                        t: slot.anchor.unwrap_or_else(|| places.at(share)),
                        azimuth: slot.azimuth.unwrap_or_else(|| azimuth(place)),
                        home: slot.home,
                    })
                };
                slots.iter().filter_map(stand).collect()
            }
        };
        stands.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.home.total_cmp(&b.home)).then(a.id.cmp(&b.id)));
        stands
    }
}

struct Stand {
    id: NodeId,
    t: f32,
    azimuth: f32,
    home: f32,
}
