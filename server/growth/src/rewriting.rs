//! Wood that is written anew, step by step, by something else than growth: what has a name from before stays the row it
//! was, moves where it is drawn elsewhere, and only what is new is born.

mod frames;

use std::collections::{BTreeMap, BTreeSet};

use espalier_plant::{
    AxisId, Carried, DormantBuds, Internode, KeyTable, MetamerId, Organ, Organs, Plant, Wood,
};
use glam::{Quat, Vec3};

use self::frames::{Before, frame, normals};
use crate::{
    direction::{across, turn},
    edit_error::EditError,
    parameters::Parameters,
    scene::{Recording, Scene},
    world::is_in_world,
};

/// What stands nearer to where it is drawn is there, in parts of its length if that is short.
const MOVED: f32 = 1e-5;
/// A bud that points so nearly where wood is drawn is the bud of that wood: the cosine.
const SAME_WAY: f32 = 0.999;

/// Wood, with a name for each node that it keeps from drawing to drawing.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// The wood.
    pub wood: &'a Wood,
    /// The name of each node.
    pub keys: &'a [u64],
}

/// What is to stand in a scene.
#[derive(Clone, Copy, Debug)]
pub struct Rewriting<'a> {
    /// What is drawn now.
    pub now: Drawn<'a>,
    /// What was drawn last, where others have changed the plants since: what they moved stays moved.
    pub before: Option<Drawn<'a>>,
    /// The rows that names had, in order of the names.
    pub rows: &'a [(u64, u32)],
    /// What was told as [`Rewritten::ends`] then.
    pub ends: &'a [(u32, u32)],
    /// Where the drawing begins.
    pub at: Vec3,
}

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rewritten {
    /// The rows that names have now, in order of the names.
    pub rows: Vec<(u64, u32)>,
    /// The rows at which drawings, and not others, have ended what went on from them, each with the axis that went on from
    /// it last, in order: what goes on from there again may do so.
    pub ends: Vec<(u32, u32)>,
    /// How many metamers moved, and of how many that stay organs are others.
    pub moved: usize,
}

/// What becomes of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    /// It has a row, and keeps it.
    Stays(MetamerId),
    Born,
    /// Somebody cut it off, or it would stand on what was cut off or has grown elsewhere.
    Lost,
}

impl Rewriting<'_> {
    /// Whether a scene may hold it.
    ///
    /// # Errors
    /// Where it would stand outside the world, or be more than the scene may hold.
    pub fn check(&self, scene: &Scene) -> Result<(), EditError> {
        if !self.now.wood.nodes.iter().all(|node| is_in_world(node.end + self.at)) {
            return Err(EditError::OutOfWorld);
        }
        let table = self.table();
        let is_known = |key: &&u64| table.get(**key).is_some();
        let known = self.now.keys.iter().filter(is_known).count();
        let count = scene.plant().metamer_count() + self.now.keys.len() - known;
        if count > scene.metamer_budget() as usize { Err(EditError::OutOfBudget) } else { Ok(()) }
    }

    /// Makes it stand, within a step.
    ///
    /// # Errors
    /// Where what hands have moved cannot follow; then nothing changes.
    pub fn write(&self, step: &mut Recording<'_>, parameters: &Parameters) -> Result<Rewritten, EditError> {
        let mut writer = Writer::new(self, step.scene().plant(), parameters);
        writer.decide(step.scene().plant());
        writer.lay_out(step.scene().plant());
        if !writer.ends.iter().zip(&writer.fates).all(|(&end, fate)| *fate == Fate::Lost || is_in_world(end))
        {
            return Err(EditError::OutOfWorld);
        }
        let carried = writer.carried(step.scene().plant());
        let moved = carried.metamers.len();
        step.place(carried)?;
        step.prune(&writer.cuts);
        writer.find_buds(step);
        let moved = moved + writer.bear(step)?;
        Ok(Rewritten { rows: writer.rows(), ends: writer.ends_of_axes(), moved })
    }

    /// Where names stand among the rows.
    fn table(&self) -> KeyTable {
        KeyTable::new(self.rows.iter().map(|&(key, _)| key))
    }
}

struct Writer<'a> {
    rewriting: &'a Rewriting<'a>,
    table: KeyTable,
    parameters: &'a Parameters,
    /// The axes that nodes bear: bearers and axes, in order.
    borne: Vec<(u32, u32)>,
    /// The first node of each axis.
    first: Vec<Option<u32>>,
    fates: Vec<Fate>,
    /// Where nodes are to stand, and their normals.
    ends: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// By what the drawing at a node is turned against the wood.
    turns: Vec<Quat>,
    cuts: Vec<MetamerId>,
    /// Whether the bud of an axis that a node would go on from lived before anything was cut, or what went on from there
    /// is cut now.
    may_go_on: Vec<bool>,
    /// Where drawings have ended what went on, with the axis that went on last.
    ended: BTreeMap<MetamerId, AxisId>,
    /// The axis that each node is to be born on, where it is known.
    buds: Vec<Option<AxisId>>,
    /// The rows of nodes.
    rows: Vec<Option<MetamerId>>,
}

impl<'a> Writer<'a> {
    fn new(rewriting: &'a Rewriting<'a>, plant: &Plant, parameters: &'a Parameters) -> Self {
        let wood = rewriting.now.wood;
        let bearers = wood.axes.iter().zip(0..).filter_map(|(axis, number)| Some((axis.bearer?, number)));
        let mut borne: Vec<(u32, u32)> = bearers.collect();
        borne.sort_unstable();
        let mut first = vec![None; wood.axes.len()];
        for (node, number) in wood.nodes.iter().zip(0..) {
            first[node.axis as usize].get_or_insert(number);
        }
        let count = wood.nodes.len();
        debug_assert!(plant.metamer_count() >= 1, "plants begin with a seed");
        Self {
            rewriting,
            table: rewriting.table(),
            parameters,
            borne,
            first,
            fates: Vec::with_capacity(count),
            ends: Vec::with_capacity(count),
            normals: Vec::with_capacity(count),
            turns: Vec::with_capacity(count),
            cuts: Vec::new(),
            may_go_on: vec![false; count],
            ended: BTreeMap::new(),
            buds: vec![None; count],
            rows: vec![None; count],
        }
    }

    /// The row that a name had.
    fn row(&self, key: u64) -> Option<MetamerId> {
        self.table.get(key).map(|at| MetamerId::new(self.rewriting.rows[at].1 as usize))
    }

    fn wood(&self) -> &'a Wood {
        self.rewriting.now.wood
    }

    /// Whether a node goes on along the axis of its parent.
    fn goes_on(&self, node: usize) -> bool {
        let nodes = &self.wood().nodes;
        nodes[node].parent.is_some_and(|parent| nodes[parent as usize].axis == nodes[node].axis)
    }

    /// Finds out which nodes stay, are born and are lost, and what is cut.
    fn decide(&mut self, plant: &Plant) {
        let mut stays = vec![false; plant.metamer_count()];
        for number in 0..self.wood().nodes.len() {
            let fate = self.fate(plant, number);
            if let Fate::Stays(row) = fate {
                stays[row.index()] = true;
            }
            self.fates.push(fate);
        }
        let known = self.rewriting.rows.iter().map(|&(_, row)| MetamerId::new(row as usize));
        let is_gone = |id: &MetamerId| {
            id.index() < stays.len() && plant.is_alive(*id) && !plant.is_seed(*id) && !stays[id.index()]
        };
        self.cuts = known.filter(is_gone).collect();
        self.cuts.sort_unstable();
        let metamers = plant.metamers();
        let mut bared: Vec<MetamerId> = self.cuts.iter().filter_map(|&row| metamers.parent(row)).collect();
        bared.sort_unstable();
        self.ended = self.ended_before(plant);
        for &cut in &self.cuts {
            let below = metamers.parent(cut).filter(|&below| metamers.axis(below) == metamers.axis(cut));
            if let Some(below) = below {
                self.ended.entry(below).or_insert(metamers.axis(cut));
            }
        }
        for number in 0..self.wood().nodes.len() {
            let parent = self.wood().nodes[number].parent.map(|parent| self.fates[parent as usize]);
            if let (Fate::Born, Some(Fate::Stays(parent))) = (self.fates[number], parent) {
                let is_alive = plant.is_axis_alive(metamers.axis(parent));
                let is_bare = || bared.binary_search(&parent).is_ok() || self.ended.contains_key(&parent);
                self.may_go_on[number] = is_alive || is_bare();
            }
        }
    }

    /// Where drawings ended before what went on, but for where others have cut what went on since.
    fn ended_before(&self, plant: &Plant) -> BTreeMap<MetamerId, AxisId> {
        let (rows, metamers) = (plant.metamer_count(), plant.metamers());
        let ends = self.rewriting.ends.iter().filter(|&&(row, _)| (row as usize) < rows);
        let mut ended: BTreeMap<MetamerId, AxisId> =
            ends.map(|&(row, axis)| (MetamerId::new(row as usize), AxisId::new(axis as usize))).collect();
        if ended.is_empty() {
            return ended;
        }
        // A name whose row is dead was cut by others: what a drawing cuts has no name then.
        let known = self.rewriting.rows.iter().map(|&(_, row)| MetamerId::new(row as usize));
        for cut in known.filter(|&row| row.index() < rows && !plant.is_alive(row)) {
            let Some(below) = metamers.parent(cut) else { continue };
            if ended.get(&below) == Some(&metamers.axis(cut)) {
                ended.remove(&below);
            }
        }
        ended
    }

    fn fate(&self, plant: &Plant, number: usize) -> Fate {
        let node = self.wood().nodes[number];
        let known = self.row(self.rewriting.now.keys[number]);
        let Some(parent) = node.parent else {
            let is_seed = |id: &MetamerId| id.index() < plant.metamer_count() && plant.is_seed(*id);
            let unused = || (number == 0).then(|| unused_seed(plant, node.end + self.rewriting.at)).flatten();
            return known.filter(is_seed).or_else(unused).map_or(Fate::Born, Fate::Stays);
        };
        let Fate::Stays(below) = self.fates[parent as usize] else { return self.fates[parent as usize] };
        let Some(row) = known else { return Fate::Born };
        if row.index() >= plant.metamer_count() || plant.is_seed(row) || !plant.is_alive(row) {
            return Fate::Lost;
        }
        let metamers = plant.metamers();
        // An axis that was cut goes on as a graft, so what goes on may well lie on an axis of its own.
        let is_same = metamers.parent(row) == Some(below)
            && (self.goes_on(number) || metamers.axis(row) != metamers.axis(below));
        if is_same { Fate::Stays(row) } else { Fate::Born }
    }

    /// Says where all nodes are to stand: as drawn, or turned as hands have turned the wood below.
    fn lay_out(&mut self, plant: &Plant) {
        let wood = self.wood();
        let drawn = normals(wood);
        let before = self.rewriting.before.map(|before| Before::new(&before));
        for (number, node) in wood.nodes.iter().enumerate() {
            let Some(parent) = node.parent.map(|parent| parent as usize) else {
                let end = match self.fates[number] {
                    Fate::Stays(seed) => plant.metamers().end(seed),
                    Fate::Born | Fate::Lost => node.end + self.rewriting.at,
                };
                self.ends.push(end);
                self.normals.push(Vec3::X);
                self.turns.push(Quat::IDENTITY);
                continue;
            };
            let Some(before) = &before else {
                self.ends.push(node.end + self.rewriting.at);
                self.normals.push(drawn[number]);
                self.turns.push(Quat::IDENTITY);
                continue;
            };
            let own = match self.fates[number] {
                Fate::Stays(row) => before.turn_of(self.rewriting.now.keys[number], plant, row),
                Fate::Born | Fate::Lost => None,
            };
            let turned = own.unwrap_or(self.turns[parent]);
            let along = node.end - wood.nodes[parent].end;
            let heading = (turned * along).normalize_or(Vec3::Y);
            self.ends.push(self.ends[parent] + turned * along);
            self.normals.push(across(turned * drawn[number], heading));
            self.turns.push(turned);
        }
    }

    /// Where living wood goes: what is drawn elsewhere than it stands, and what others have grown on it.
    fn carried(&self, plant: &Plant) -> Carried {
        let mut node_of: Vec<Option<u32>> = vec![None; plant.metamer_count()];
        for (fate, number) in self.fates.iter().zip(0..) {
            if let Fate::Stays(row) = *fate {
                node_of[row.index()] = Some(number);
            }
        }
        let metamers = plant.metamers();
        let mut ends: Vec<Vec3> = Vec::with_capacity(node_of.len());
        let mut turns: Vec<Option<Quat>> = Vec::with_capacity(node_of.len());
        let mut columns = Carried::default();
        let mut axes: Vec<(AxisId, Vec3)> = Vec::new();
        for id in (0..node_of.len()).map(MetamerId::new) {
            let (was, normal) = (metamers.end(id), metamers.normal(id));
            let parent = metamers.parent(id).filter(|_| plant.is_alive(id));
            let moves = parent.and_then(|parent| match node_of[id.index()] {
                Some(node) => {
                    let (to, across) = (self.ends[node as usize], self.normals[node as usize]);
                    let along = to - ends[parent.index()];
                    let heading = along.try_normalize()?;
                    // In proportion to short wood, or what stands nearly there would not be across its normal.
                    let near = MOVED * along.length().min(1.0);
                    let is_there = to.distance(was) <= near && across.distance(normal) <= near;
                    (!is_there).then(|| {
                        let old = frame(plant.heading(id), normal);
                        (to, across, frame(heading, across) * old.inverse())
                    })
                }
                None => {
                    let turned = turns[parent.index()]?;
                    let to = ends[parent.index()] + turned * (was - metamers.end(parent));
                    let heading = (to - ends[parent.index()]).try_normalize()?;
                    Some((to, across(turned * normal, heading), turned))
                }
            });
            let Some((to, across, turned)) = moves else {
                ends.push(was);
                turns.push(None);
                continue;
            };
            ends.push(to);
            turns.push(Some(turned));
            columns.metamers.push(id);
            columns.ends.push(to);
            columns.normals.push(across);
            for axis in plant.laterals(id).filter(|&axis| plant.is_standing(axis)) {
                axes.push((axis, (turned * plant.axes().direction(axis)).normalize_or(Vec3::Y)));
            }
        }
        axes.sort_unstable_by_key(|&(axis, _)| axis);
        columns.axes = axes.iter().map(|&(axis, _)| axis).collect();
        columns.directions = axes.into_iter().map(|(_, direction)| direction).collect();
        columns
    }

    /// Finds the buds that new branches of old wood grow from, or lays them down.
    fn find_buds(&mut self, step: &mut Recording<'_>) {
        let mut taken: BTreeSet<AxisId> = BTreeSet::new();
        for number in 0..self.fates.len() {
            let Some(parent) = self.wood().nodes[number].parent.map(|parent| parent as usize) else {
                continue;
            };
            let (Fate::Born, Fate::Stays(below)) = (self.fates[number], self.fates[parent]) else { continue };
            let plant = step.scene().plant();
            let direction = (self.ends[number] - self.ends[parent]).normalize_or(Vec3::Y);
            if self.goes_on(number) {
                let axis = plant.metamers().axis(below);
                if plant.is_axis_alive(axis) && plant.bud_node(axis) == below {
                    self.buds[number] = Some(axis);
                    continue;
                }
                // What went on from here was cut in this very step; otherwise others have cut it, or grown it on.
                if plant.is_axis_alive(axis) || !self.may_go_on[number] || plant.is_seed(below) {
                    continue;
                }
            } else {
                let points = |axis: &AxisId| {
                    plant.is_axis_alive(*axis)
                        && !plant.has_grown(*axis)
                        && plant.axes().direction(*axis).dot(direction) > SAME_WAY
                };
                let found = plant.laterals(below).filter(points).find(|axis| !taken.contains(axis));
                if let Some(axis) = found {
                    taken.insert(axis);
                    self.buds[number] = Some(axis);
                    continue;
                }
            }
            let axis = step.graft_bud(below, direction);
            if self.goes_on(number) {
                self.ended.insert(below, axis);
            }
            self.buds[number] = Some(axis);
        }
    }

    /// Lets everything new be born, parents first; returns of how many metamers that stay organs are others.
    fn bear(&mut self, step: &mut Recording<'_>) -> Result<usize, EditError> {
        let wood = self.wood();
        let mut axes: Vec<Option<AxisId>> = vec![None; wood.axes.len()];
        let (mut radii, mut organs, mut others) = (Vec::new(), Vec::new(), 0);
        let mut borne = wood.organs.iter().peekable();
        // Where the axes that nodes bear begin among all of them, and room for the directions of those of one.
        let (mut from, mut directions) = (0, Vec::new());
        for (number, node) in wood.nodes.iter().enumerate() {
            let bears = borne.next_if(|(node, _)| *node as usize == number).map(|(_, organs)| organs);
            match self.fates[number] {
                Fate::Stays(row) => self.rows[number] = Some(row),
                Fate::Lost => continue,
                Fate::Born if node.parent.is_none() => {
                    let axis = step.sow(self.ends[number]);
                    axes[node.axis as usize] = Some(axis);
                    self.rows[number] = step.scene().plant().axes().first(axis);
                }
                Fate::Born => {
                    let Some(axis) = self.buds[number].or(axes[node.axis as usize]) else { continue };
                    // It may stand on what is new and found no place.
                    let is_below = node.parent.is_some_and(|parent| self.rows[parent as usize].is_some());
                    if !is_below || !step.scene().plant().is_axis_alive(axis) {
                        continue;
                    }
                    axes[node.axis as usize] = Some(axis);
                    let borne = &self.borne[from..];
                    from += borne.iter().take_while(|&&(bearer, _)| (bearer as usize) < number).count();
                    let borne = &self.borne[from..];
                    let count = borne.iter().take_while(|&&(bearer, _)| bearer as usize == number).count();
                    directions.clear();
                    let laterals = &borne[..count];
                    self.rows[number] = self.extend(step, number, axis, laterals, &mut directions, &mut axes);
                }
            }
            let plant = step.scene().plant();
            let Some(row) = self.rows[number].filter(|&row| !plant.is_seed(row)) else { continue };
            if plant.given_radius(row) != node.radius {
                radii.push((row, node.radius));
            }
            let bears = bears.map(|bears| self.organs_on(plant, number, row, bears));
            if plant.given_organs(row) != bears.as_ref() {
                others += usize::from(matches!(self.fates[number], Fate::Stays(_)));
                organs.push((row, bears));
            }
        }
        radii.sort_unstable_by_key(|&(row, _)| row);
        step.give_radii(&radii)?;
        organs.sort_unstable_by_key(|&(row, _)| row);
        step.give_organs(&organs)?;
        Ok(others)
    }

    /// Organs as the row of a node bears them, turned as the wood is.
    fn organs_on(&self, plant: &Plant, number: usize, row: MetamerId, organs: &Organs) -> Organs {
        let nodes = &self.wood().nodes;
        let base = nodes[number].parent.map_or(Vec3::ZERO, |parent| nodes[parent as usize].end);
        let drawn = (nodes[number].end - base).normalize_or(Vec3::Y);
        let (heading, normal) = (plant.heading(row), plant.metamers().normal(row));
        let carried = |organ: &Organ| organ.carried(drawn, self.turns[number], heading, normal);
        organs.iter().map(carried).collect()
    }

    fn extend(
        &self,
        step: &mut Recording<'_>,
        number: usize,
        axis: AxisId,
        laterals: &[(u32, u32)],
        directions: &mut Vec<Vec3>,
        axes: &mut [Option<AxisId>],
    ) -> Option<MetamerId> {
        let (end, normal) = (self.ends[number], self.normals[number]);
        let heading = (end - step.scene().plant().bud_position(axis)).try_normalize()?;
        let normal = across(normal, heading);
        directions
            .extend(laterals.iter().map(|&(_, lateral)| self.direction(lateral as usize, number, heading)));
        if self.wood().buds != DormantBuds::Known {
            let (sin, cos) = self.parameters.branching;
            let buds = self.parameters.buds_per_node as usize;
            for &around in self.parameters.whorl.iter().take(buds).skip(directions.len()) {
                let aside = turn(normal, heading, around);
                directions.push((heading * cos + aside * sin).normalize_or(heading));
            }
        }
        let born = step.extend(axis, &Internode { end, normal, laterals: directions })?;
        for (&(_, lateral), axis) in laterals.iter().zip(step.scene().plant().laterals(born)) {
            axes[lateral as usize] = Some(axis);
        }
        Some(born)
    }

    /// Where the bud of a branch points: where its wood goes.
    fn direction(&self, axis: usize, bearer: usize, heading: Vec3) -> Vec3 {
        let wood =
            self.first[axis].and_then(|node| (self.ends[node as usize] - self.ends[bearer]).try_normalize());
        let drawn = || Some((self.turns[bearer] * self.wood().axes[axis].direction?).normalize_or(heading));
        wood.or_else(drawn).unwrap_or(heading)
    }

    /// The rows of names: those that were cut off as well, as long as they are drawn, so that they stay away.
    fn rows(&self) -> Vec<(u64, u32)> {
        let row = |(number, &key): (usize, &u64)| {
            let known = || self.row(key).filter(|_| self.fates[number] == Fate::Lost);
            Some((key, self.rows[number].or_else(known)?.raw()))
        };
        let mut rows: Vec<(u64, u32)> = self.rewriting.now.keys.iter().enumerate().filter_map(row).collect();
        rows.sort_unstable();
        rows.dedup_by_key(|&mut (key, _)| key);
        rows
    }

    /// Where drawings have ended what went on from rows that are still drawn.
    fn ends_of_axes(&self) -> Vec<(u32, u32)> {
        let mut drawn: Vec<MetamerId> = self.rows.iter().flatten().copied().collect();
        drawn.sort_unstable();
        let ended = self.ended.iter().filter(|(row, _)| drawn.binary_search(row).is_ok());
        ended.map(|(row, axis)| (row.raw(), axis.raw())).collect()
    }
}

/// A seed at a place that nothing has grown from.
fn unused_seed(plant: &Plant, place: Vec3) -> Option<MetamerId> {
    let mut seeds = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_seed(id));
    let is_unused = |id: &MetamerId| {
        let axis = plant.metamers().axis(*id);
        plant.metamers().end(*id) == place && plant.is_axis_alive(axis) && !plant.has_grown(axis)
    };
    seeds.find(is_unused)
}
