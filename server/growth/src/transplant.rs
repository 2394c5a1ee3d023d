//! Wood from elsewhere becomes a plant that growth goes on with: rows, axes, given radii, and the buds that growth
//! would have laid down.

use espalier_plant::{
    AxisId, BrokenPlant, DormantBuds, Edit, Given, GivenRadii, Internode, MetamerId, Organs, Plant,
    PlantParts, Wood, WoodAxis, WoodNode, given::GivenColumn,
};
use glam::{Quat, Vec3};

use crate::{
    direction::{across, transport, turn},
    edit_error::EditError,
    generator::Generator,
    growth::Growth,
    parameters::Parameters,
    scene::Recording,
    simulation::Simulation,
    world::is_in_world,
};

/// No row.
const NONE: u32 = u32::MAX;
/// Wood is young where less stands above it than so many steps grow at most.
const YOUNG: u32 = 2;
/// A lateral that stands off its bearer by a smaller sine says nothing of where the normal points.
const LEAST_SINE: f32 = 0.05;

/// A plant of this wood, in the step of its last birth. Its radii are given ones. Nodes that bear dormant buds bear as
/// many laterals as the parameters say. Those on young wood are young where less wood stands on them than two steps
/// grow at most: scans do not say when wood grew, and on what has grown since long few buds are left.
///
/// # Errors
/// Where nodes and axes do not fit together, or an internode has no length.
pub fn transplant(wood: &Wood, parameters: &Parameters) -> Result<Plant, BrokenPlant> {
    if wood.gaps.is_empty() {
        return Plant::from_parts(rooted(wood, parameters)?);
    }
    check(wood)?;
    let (wood, gone) = with_gaps(wood);
    let mut parts = rooted(&wood, parameters)?;
    for row in gone {
        parts.death[row] = wood.nodes[row].birth;
    }
    Plant::from_parts(parts)
}

/// The same wood with rows where it has gaps, and which rows these are: seeds that were gone as soon as they were laid
/// down, so that nothing else knows of them at any time.
fn with_gaps(wood: &Wood) -> (Wood, Vec<usize>) {
    let mut rows = Vec::with_capacity(wood.nodes.len());
    let (mut nodes, mut axes, mut gone) = (Vec::new(), wood.axes.clone(), Vec::new());
    let mut gaps = wood.gaps.iter().copied().peekable();
    let end = wood.nodes.first().map_or(Vec3::ZERO, |first| first.end);
    for (number, node) in wood.nodes.iter().enumerate() {
        let gap = gaps.next_if(|&(before, _)| before as usize == number).map_or(0, |(_, count)| count);
        for _ in 0..gap {
            gone.push(nodes.len());
            let axis = axes.len() as u32;
            axes.push(WoodAxis { bearer: None, direction: None, has_bud: false });
            nodes.push(WoodNode { parent: None, axis, end, normal: None, radius: None, birth: node.birth });
        }
        rows.push(nodes.len() as u32);
        nodes.push(WoodNode { parent: node.parent.map(|parent| rows[parent as usize]), ..*node });
    }
    let moved = |number: u32| rows[number as usize];
    for axis in &mut axes {
        axis.bearer = axis.bearer.map(moved);
    }
    let wood = Wood {
        nodes,
        axes,
        widths: wood.widths.iter().map(|&(number, width)| (moved(number), width)).collect(),
        scars: wood.scars.iter().map(|&(number, tips)| (moved(number), tips)).collect(),
        organs: wood.organs.iter().map(|(number, organs)| (moved(*number), organs.clone())).collect(),
        gaps: Vec::new(),
        buds: wood.buds,
    };
    (wood, gone)
}

/// The parts of a plant of this wood.
fn rooted(wood: &Wood, parameters: &Parameters) -> Result<PlantParts, BrokenPlant> {
    check(wood)?;
    let mut rooting = Rooting {
        wood,
        parameters,
        borne: Borne::of(wood),
        above: above(wood),
        parts: PlantParts::default(),
        rows_of_axes: vec![NONE; wood.axes.len()],
    };
    for node in 0..wood.nodes.len() {
        rooting.add(node);
    }
    rooting.bury_buds();
    rooting.record_time();
    Ok(rooting.parts)
}

impl<G: Generator + AsRef<Growth>> Simulation<G> {
    /// Plants wood beside the plants that there are, moved by so much, and cuts some wood off, in a step of its own, in
    /// which nothing grows older. Its rows stand in the order of its nodes; width constraints, gaps and what was shed are
    /// left out.
    ///
    /// # Errors
    /// Where it would stand outside the world or be more than the scene may hold, or does not fit together; then
    /// nothing changes.
    pub fn replant(&mut self, cuts: &[MetamerId], wood: &Wood, by: Vec3) -> Result<(), EditError> {
        let count = self.plant().metamer_count() + wood.nodes.len();
        if count > self.scene().metamer_budget() as usize {
            return Err(EditError::OutOfBudget);
        }
        if !wood.nodes.iter().all(|node| is_in_world(node.end + by)) {
            return Err(EditError::OutOfWorld);
        }
        let mut parts =
            rooted(wood, self.generator().as_ref().parameters()).map_err(|_| EditError::Broken)?;
        parts.end.iter_mut().for_each(|end| *end += by);
        let before = self.plant().step();
        let planted = self.edit(|step| {
            if !cuts.is_empty() {
                step.prune(cuts);
            }
            set(step, &parts)
        });
        if planted.is_err() {
            self.go_to(before);
            self.stash_future();
        }
        planted
    }
}

/// Lets what parts say grow in the step that is recorded.
fn set(step: &mut Recording<'_>, parts: &PlantParts) -> Result<(), EditError> {
    let first = step.scene().plant().metamer_count();
    let mut axes = vec![None; parts.bearer.len()];
    // Axes stand in the order of their bearers.
    let mut borne = 0;
    for (row, &end) in parts.end.iter().enumerate() {
        while parts.bearer.get(borne).is_some_and(|&bearer| bearer == NONE) {
            borne += 1;
        }
        let from = borne;
        while parts.bearer.get(borne) == Some(&(row as u32)) {
            borne += 1;
        }
        let axis = parts.axis[row] as usize;
        if parts.parent[row] == NONE {
            axes[axis] = Some(step.sow(end));
            continue;
        }
        let Some(axis) = axes[axis] else { continue };
        let internode = Internode { end, normal: parts.normal[row], laterals: &parts.direction[from..borne] };
        let Some(id) = step.extend(axis, &internode) else { continue };
        let laterals: Vec<AxisId> = step.scene().plant().laterals(id).collect();
        for (at, axis) in (from..borne).zip(laterals) {
            axes[at] = Some(axis);
        }
    }
    let given = parts.given_radii.iter();
    let radii: Vec<_> =
        given.map(|&(row, radius)| (MetamerId::new(first + row as usize), Some(radius))).collect();
    step.give_radii(&radii)?;
    let organs = parts.given_organs.iter();
    let organs: Vec<_> =
        organs.map(|(row, organs)| (MetamerId::new(first + *row as usize), Some(organs.clone()))).collect();
    step.give_organs(&organs)?;
    Ok(())
}

/// Checks what else would lead out of bounds; the rest is checked with the parts.
fn check(wood: &Wood) -> Result<(), BrokenPlant> {
    let broken = |what: &str| Err(BrokenPlant(what.to_owned()));
    let nodes = wood.nodes.len() as u32;
    if wood.nodes.first().is_none_or(|first| first.birth > 0) {
        return broken("there is no first seed");
    }
    if !wood.nodes.is_sorted_by(|a, b| a.birth <= b.birth) {
        return broken("births are out of order");
    }
    if wood.nodes.iter().zip(0..).any(|(node, at)| node.parent.is_some_and(|parent| parent >= at)) {
        return broken("a node stands before its parent");
    }
    // Time goes back no farther than to the first step.
    if wood.nodes.iter().any(|node| node.parent.is_some() && node.birth == 0) {
        return broken("wood is as old as the first seed");
    }
    if wood.nodes.iter().any(|node| node.axis as usize >= wood.axes.len()) {
        return broken("a node belongs to no axis");
    }
    if wood.axes.iter().any(|axis| axis.bearer.is_some_and(|bearer| bearer >= nodes)) {
        return broken("an axis is borne by nothing");
    }
    let is_borne = |axis: u32| wood.axes[axis as usize].bearer.is_some();
    if wood.nodes.iter().any(|node| node.parent.is_none() && is_borne(node.axis)) {
        return broken("a seed stands on a branch");
    }
    if !wood.gaps.is_sorted_by(|a, b| a.0 < b.0) || wood.gaps.iter().any(|&(node, _)| node >= nodes) {
        return broken("a gap is before nothing");
    }
    if wood.widths.iter().any(|&(row, _)| row >= nodes) {
        return broken("a width constraint is on nothing");
    }
    let is_there = |row: u32| wood.nodes.get(row as usize).is_some_and(|node| node.parent.is_some());
    if !wood.scars.is_sorted_by(|a, b| a.0 < b.0) || !wood.scars.iter().all(|&(row, _)| is_there(row)) {
        return broken("what was shed stood on nothing");
    }
    if !wood.organs.is_sorted_by(|a, b| a.0 < b.0) || !wood.organs.iter().all(|&(row, _)| is_there(row)) {
        return broken("organs are borne by nothing");
    }
    Ok(())
}

/// How many internodes stand on each node on the way to the farthest tip.
fn above(wood: &Wood) -> Vec<u32> {
    let mut above = vec![0; wood.nodes.len()];
    for (at, node) in wood.nodes.iter().enumerate().rev() {
        if let Some(parent) = node.parent {
            above[parent as usize] = above[parent as usize].max(above[at] + 1);
        }
    }
    above
}

/// Which axes each node bears, and where axes begin.
struct Borne {
    /// Bearers and axes, in order.
    axes: Vec<(u32, u32)>,
    /// The first node of each axis.
    first: Vec<u32>,
}

impl Borne {
    fn of(wood: &Wood) -> Self {
        let bearers = wood.axes.iter().zip(0..).filter_map(|(axis, number)| Some((axis.bearer?, number)));
        let mut axes: Vec<_> = bearers.collect();
        axes.sort_unstable();
        let mut first = vec![NONE; wood.axes.len()];
        for (number, node) in wood.nodes.iter().enumerate().rev() {
            first[node.axis as usize] = number as u32;
        }
        Self { axes, first }
    }

    /// The axes that a node bears.
    fn by(&self, node: u32) -> &[(u32, u32)] {
        let from = self.axes.partition_point(|&(bearer, _)| bearer < node);
        let to = self.axes.partition_point(|&(bearer, _)| bearer <= node);
        &self.axes[from..to]
    }
}

struct Rooting<'a> {
    wood: &'a Wood,
    parameters: &'a Parameters,
    borne: Borne,
    /// How many internodes stand on each node.
    above: Vec<u32>,
    parts: PlantParts,
    /// The row of each axis of the wood, once it has one.
    rows_of_axes: Vec<u32>,
}

impl Rooting<'_> {
    /// Adds a node, and the axes that it bears.
    fn add(&mut self, number: usize) {
        let node = self.wood.nodes[number];
        while self.parts.ends.len() <= node.birth as usize {
            let growths = self.parts.ends.len() as u32;
            let [metamers, axes, ..] = self.parts.ends.last().copied().unwrap_or_default();
            self.parts.ends.push([metamers, axes, 0, growths]);
        }
        let Some(parent) = node.parent else {
            self.rows_of_axes[node.axis as usize] = self.push_axis(NONE, Vec3::Y);
            self.push_row(number, Vec3::X);
            return;
        };
        let heading = (node.end - self.parts.end[parent as usize]).normalize_or(Vec3::Y);
        let laterals: Vec<(u32, Vec3)> = (self.borne.by(number as u32).iter())
            .map(|&(_, axis)| (axis, self.direction(axis, node.end, heading)))
            .collect();
        let normal = node.normal.unwrap_or_else(|| self.normal(number, heading, &laterals));
        self.push_row(number, normal);
        for &(axis, direction) in &laterals {
            self.rows_of_axes[axis as usize] = self.push_axis(number as u32, direction);
        }
        if self.has_dormant_buds(number) {
            let (sin, cos) = self.parameters.branching;
            let buds = self.parameters.buds_per_node as usize;
            for &around in self.parameters.whorl.iter().take(buds).skip(laterals.len()) {
                let direction = (heading * cos + turn(normal, heading, around) * sin).normalize_or(heading);
                self.push_axis(number as u32, direction);
            }
        }
    }

    /// Whether laterals of a node that have not grown are dormant buds.
    fn has_dormant_buds(&self, number: usize) -> bool {
        match self.wood.buds {
            DormantBuds::Everywhere => true,
            DormantBuds::OnYoungWood => {
                self.above[number] < YOUNG.saturating_mul(self.parameters.max_shoot_length)
            }
            DormantBuds::Known => false,
        }
    }

    /// Where the bud of a lateral pointed: where its wood goes, if nothing else is known.
    fn direction(&self, axis: u32, from: Vec3, heading: Vec3) -> Vec3 {
        let first = self.wood.nodes.get(self.borne.first[axis as usize] as usize);
        let known = self.wood.axes[axis as usize].direction;
        known.or_else(|| (first?.end - from).try_normalize()).unwrap_or(heading)
    }

    /// The unit vector across an internode towards its first lateral, or as growth would turn it.
    fn normal(&self, number: usize, heading: Vec3, laterals: &[(u32, Vec3)]) -> Vec3 {
        let sideways = laterals.first().map(|&(_, direction)| direction.reject_from_normalized(heading));
        if let Some(sideways) = sideways.filter(|sideways| sideways.length() > LEAST_SINE) {
            return across(sideways.normalize(), heading);
        }
        let node = &self.wood.nodes[number];
        let below = node.parent.filter(|&parent| self.wood.nodes[parent as usize].axis == node.axis);
        let begins = below.and_then(|below| {
            let before = self.wood.nodes[below as usize];
            let base = self.parts.end[before.parent? as usize];
            Some((self.parts.normal[below as usize], (before.end - base).try_normalize()?))
        });
        match begins {
            Some((normal, before)) => {
                let carried = across(transport(normal, before, heading), heading);
                across(turn(carried, heading, self.parameters.phyllotaxis), heading)
            }
            None => across(heading.cross(Vec3::Y), heading),
        }
    }

    fn push_row(&mut self, number: usize, normal: Vec3) {
        let node = self.wood.nodes[number];
        self.parts.parent.push(node.parent.unwrap_or(NONE));
        self.parts.axis.push(self.rows_of_axes[node.axis as usize]);
        self.parts.death.push(NONE);
        self.parts.end.push(node.end);
        self.parts.normal.push(normal);
        self.count();
    }

    fn push_axis(&mut self, bearer: u32, direction: Vec3) -> u32 {
        self.parts.bearer.push(bearer);
        self.parts.direction.push(direction);
        self.parts.axis_death.push(NONE);
        self.count();
        self.parts.bearer.len() as u32 - 1
    }

    /// The step in progress ends behind what there is.
    fn count(&mut self) {
        if let Some(end) = self.parts.ends.last_mut() {
            (end[0], end[1]) = (self.parts.parent.len() as u32, self.parts.bearer.len() as u32);
        }
    }

    /// Axes whose bud was cut lost it when they got their last node.
    fn bury_buds(&mut self) {
        for node in &self.wood.nodes {
            if !self.wood.axes[node.axis as usize].has_bud {
                let axis = self.rows_of_axes[node.axis as usize];
                if let Some(death) = self.parts.axis_death.get_mut(axis as usize) {
                    *death = node.birth;
                }
            }
        }
    }

    /// Organs as a row bears them.
    fn organs_on(&self, row: u32, organs: &Organs) -> Organs {
        let parts = &self.parts;
        let base = parts.end[parts.parent[row as usize] as usize];
        let heading = (parts.end[row as usize] - base).normalize_or(Vec3::Y);
        let normal = parts.normal[row as usize];
        organs.iter().map(|organ| organ.carried(heading, Quat::IDENTITY, heading, normal)).collect()
    }

    /// Each step gives radii, widths and the tips of what was shed to what is born in it.
    fn record_time(&mut self) {
        let Wood { nodes, widths, scars, .. } = self.wood;
        let radius = |row: usize| nodes[row].parent.and(nodes[row].radius);
        let mut wanted = widths.iter().peekable();
        let mut shed = scars.iter().peekable();
        let mut organs = self.wood.organs.iter().map(|&(row, _)| row).peekable();
        let mut from = 0;
        for end in &mut self.parts.ends {
            let born = from..end[0] as usize;
            from = born.end;
            let rows: Vec<usize> = born.filter(|&row| radius(row).is_some()).collect();
            if !rows.is_empty() {
                // What an edit keeps is what was before it.
                let radii = GivenColumn(vec![GivenRadii::NONE; rows.len()]);
                let metamers = rows.iter().map(|&row| MetamerId::new(row)).collect();
                self.parts.edits.push(Edit::Given(Box::new(Given { metamers, values: radii })));
            }
            let bearers: Vec<_> =
                std::iter::from_fn(|| organs.next_if(|&row| (row as usize) < from)).collect();
            if !bearers.is_empty() {
                let values = GivenColumn(vec![None; bearers.len()]);
                let metamers = bearers.iter().map(|&row| MetamerId::new(row as usize)).collect();
                self.parts.edits.push(Edit::Borne(Box::new(Given { metamers, values })));
            }
            while let Some((row, _)) = wanted.next_if(|(row, _)| (*row as usize) < from) {
                self.parts.edits.push(Edit::Width(MetamerId::new(*row as usize), None));
            }
            while let Some(&(row, tips)) = shed.next_if(|(row, _)| (*row as usize) < from) {
                self.parts.edits.push(Edit::Scarred(MetamerId::new(row as usize), tips));
            }
            end[2] = self.parts.edits.len() as u32;
        }
        self.parts.given_radii =
            (0..nodes.len()).filter_map(|row| Some((row as u32, radius(row)?))).collect();
        self.parts.given_organs =
            self.wood.organs.iter().map(|(row, organs)| (*row, self.organs_on(*row, organs))).collect();
        self.parts.widths.clone_from(widths);
        self.parts.now = self.parts.ends.len() as u32 - 1;
    }
}

#[cfg(test)]
mod tests {
    use espalier_plant::{Girth, Widths, checks};

    use super::*;
    use crate::{NoObserver, Simulation, SimulationState, StepInput};

    fn node(parent: Option<u32>, axis: u32, end: [f32; 3], birth: u32) -> WoodNode {
        let radius = parent.map(|_| 0.25);
        WoodNode { parent, axis, end: Vec3::from_array(end), normal: None, radius, birth }
    }

    fn axis(bearer: Option<u32>) -> WoodAxis {
        WoodAxis { bearer, direction: None, has_bud: true }
    }

    /// A trunk of three internodes with a branch of one at its first node.
    fn sapling() -> Wood {
        Wood {
            nodes: vec![
                node(None, 0, [0.0, 0.0, 0.0], 0),
                node(Some(0), 0, [0.0, 1.0, 0.0], 1),
                node(Some(1), 0, [0.0, 2.0, 0.1], 1),
                node(Some(1), 1, [0.8, 1.5, 0.0], 2),
                node(Some(2), 0, [0.0, 3.0, 0.1], 2),
            ],
            axes: vec![axis(None), axis(Some(1))],
            ..Wood::default()
        }
    }

    fn planted(wood: &Wood) -> Plant {
        let plant = transplant(wood, &Parameters::default()).expect("it fits together");
        assert_eq!(checks::all(&plant), Ok(()));
        plant
    }

    #[test]
    fn wood_becomes_rows_with_given_radii_and_buds() {
        let plant = planted(&sapling());
        assert_eq!((plant.step(), plant.living_count(), plant.living_axes_count()), (2, 4, 2));
        let births: Vec<_> = (0..5).map(|row| plant.birth(MetamerId::new(row))).collect();
        assert_eq!(births, [0, 1, 1, 2, 2]);
        let girth = Girth::new(2.5, 0.1);
        let widths = Widths::of(&plant, &girth);
        assert!((1..5).all(|row| (widths.radius(MetamerId::new(row)) - 0.25).abs() < 1e-6));
        // Each node bears one lateral; that of the first has grown, and the normal points to it.
        let buds: Vec<_> = (1..5).map(|row| plant.laterals(MetamerId::new(row)).count()).collect();
        assert_eq!(buds, [1, 1, 1, 1]);
        assert!(plant.metamers().normal(MetamerId::new(1)).distance(Vec3::X) < 1e-6);
    }

    #[test]
    fn it_goes_back_to_its_seed_and_forth_again() {
        let mut wood = sapling();
        wood.widths = vec![(2, 1.5)];
        wood.scars = vec![(3, 2)];
        let mut plant = planted(&wood);
        let hash = plant.hash();
        plant.go_to(0);
        assert_eq!((plant.living_count(), plant.widths().count()), (0, 0));
        assert_eq!(checks::all(&plant), Ok(()));
        plant.go_to(2);
        assert_eq!((plant.hash(), plant.widths().count()), (hash, 1));
        assert_eq!(Plant::from_parts(plant.to_parts()), Ok(plant));
    }

    #[test]
    fn it_grows_on() {
        let parameters = Parameters::default();
        let state = SimulationState {
            seed: 1,
            parameters,
            markers: Vec::new(),
            guides: Default::default(),
            enclosures: Vec::new(),
            obstacles: Vec::new(),
            metamer_budget: 1000,
            tick: 2,
        };
        let mut simulation = Simulation::from_state(planted(&sapling()), state);
        let grown = simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, &mut NoObserver);
        assert!(grown.metamers_grown > 0);
        assert_eq!(checks::all(simulation.plant()), Ok(()));
    }

    #[test]
    fn a_cut_axis_has_no_bud_and_known_buds_are_all_there_are() {
        let mut wood = sapling();
        wood.buds = DormantBuds::Known;
        wood.axes[1].has_bud = false;
        wood.axes.push(WoodAxis { bearer: Some(2), direction: Some(Vec3::Z), has_bud: true });
        let mut plant = planted(&wood);
        let branch = plant.metamers().axis(MetamerId::new(3));
        assert_eq!((plant.axis_count(), plant.is_axis_alive(branch)), (3, false));
        plant.go_to(1);
        assert!(plant.is_axis_alive(branch), "it was a bud then");
    }

    #[test]
    fn what_was_shed_counts_among_the_tips_of_what_bore_it() {
        let tips = |wood: &Wood| {
            let plant = planted(wood);
            (0..5).map(|row| plant.metamers().tips(MetamerId::new(row))).collect::<Vec<_>>()
        };
        let mut wood = sapling();
        assert_eq!(tips(&wood), [2, 2, 1, 1, 1]);
        wood.scars = vec![(2, 3), (3, 1)];
        assert_eq!(tips(&wood), [6, 6, 4, 2, 1]);
    }

    #[test]
    fn gaps_are_rows_of_which_nothing_is_seen_at_any_time() {
        let mut wood = sapling();
        wood.scars = vec![(1, 3)];
        wood.widths = vec![(3, 0.5)];
        let plain = planted(&wood);
        wood.gaps = vec![(1, 2), (3, 1), (4, 4)];
        let mut plant = planted(&wood);
        let rows = [0, 3, 4, 6, 11].map(MetamerId::new);
        let living = |plant: &Plant| -> Vec<MetamerId> {
            (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)).collect()
        };
        assert_eq!((living(&plant), plant.metamer_count()), (rows.to_vec(), 12));
        assert_eq!(plant.widths().map(|(id, _)| id).collect::<Vec<_>>(), [rows[3]]);
        assert_eq!(plant.living_axes_count(), plain.living_axes_count());
        for (number, &row) in rows.iter().enumerate() {
            let old = MetamerId::new(number);
            assert_eq!(plant.metamers().end(row), plain.metamers().end(old));
            assert_eq!(plant.metamers().tips(row), plain.metamers().tips(old));
            assert_eq!(plant.birth(row), plain.birth(old));
            let parent = plain.metamers().parent(old).map(|parent| rows[parent.index()]);
            assert_eq!(plant.metamers().parent(row), parent);
        }
        for (step, count) in [(1, 3), (0, 1)] {
            plant.go_to(step);
            assert_eq!(living(&plant), rows[..count], "step {step}");
            assert_eq!(checks::all(&plant), Ok(()));
        }
        // It is written down and read again as any other.
        assert_eq!(
            Plant::from_parts(planted(&wood).to_parts()).map(|plant| living(&plant)),
            Ok(rows.to_vec())
        );
    }

    #[test]
    fn young_wood_alone_has_dormant_buds_where_no_others_are_known() {
        // A pole of so many internodes that the lower half has long outgrown its buds.
        let parameters = Parameters::default();
        let young = YOUNG * parameters.max_shoot_length;
        let nodes = (0..=2 * young).map(|at| node(at.checked_sub(1), 0, [0.0, at as f32, 0.0], at));
        let pole = Wood {
            nodes: nodes.collect(),
            axes: vec![axis(None)],
            buds: DormantBuds::OnYoungWood,
            ..Wood::default()
        };
        let plant = planted(&pole);
        let bears = |row: u32| plant.laterals(MetamerId::new(row as usize)).count() as u32;
        let buds = parameters.buds_per_node;
        assert!((1..=young).all(|row| bears(row) == 0));
        assert!((young + 1..=2 * young).all(|row| bears(row) == buds));
    }

    #[test]
    fn wood_that_does_not_fit_together_is_refused() {
        let broken: [fn(&mut Wood); 14] = [
            |wood| wood.nodes.clear(),
            |wood| wood.nodes[0].birth = 1,
            |wood| wood.nodes[4].birth = 0,
            |wood| wood.nodes[1].birth = 0,
            |wood| wood.nodes[2].parent = Some(2),
            |wood| wood.nodes[3].axis = 9,
            |wood| wood.axes[1].bearer = Some(99),
            |wood| wood.axes[1].bearer = Some(4),
            |wood| wood.nodes[4].end = wood.nodes[2].end,
            |wood| wood.scars = vec![(5, 1)],
            |wood| wood.scars = vec![(2, 1), (2, 1)],
            |wood| wood.gaps = vec![(5, 1)],
            |wood| wood.gaps = vec![(3, 1), (2, 1)],
            |wood| (wood.gaps, wood.widths) = (vec![(1, 1)], vec![(5, 1.0)]),
        ];
        for (case, damage) in broken.into_iter().enumerate() {
            let mut wood = sapling();
            damage(&mut wood);
            assert!(transplant(&wood, &Parameters::default()).is_err(), "case {case}");
        }
    }
}
