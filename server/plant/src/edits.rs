//! What is done to wood that has grown: shed, pruned, carried elsewhere, grafted, widened.
//!
//! Each edit belongs to a step and can be taken back exactly: what dies keeps its rows, and what moves is
//! swapped with where it was. TreeSketch §3.3 keeps both on a stack as well.

use std::mem;

use glam::Vec3;

use crate::{
    given::Given,
    id::{AxisId, MetamerId},
    metamers::Row,
    motion::Motion,
    organs::Organs,
    plant::Plant,
    resettled::Resettled,
};

/// A shorter internode has no direction.
pub const SHORTEST: f32 = 0.01;

/// One edit, as the timeline keeps it.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// The branch that begins with an axis was shed; the wood below keeps its girth.
    Shed(AxisId),
    /// A metamer was cut off with everything above it, as if they had never been.
    Pruned(MetamerId),
    /// An axis was grafted onto the node that bears it.
    Grafted(AxisId),
    /// Wood stands elsewhere.
    Carried(Box<Carried>),
    /// A metamer of a graft carries so many tips of twigs that were shed from what it was copied from.
    Scarred(MetamerId, u32),
    /// A width constraint came, went, or changed. The diameter is that on the other side of this step.
    Width(MetamerId, Option<f32>),
    /// Radii were given or taken away.
    Given(Box<Given>),
    /// Organs were given or taken away.
    Borne(Box<Given<Option<Organs>>>),
    /// Wood fell and rose: which of it stands was settled anew.
    Resettled(Box<Resettled>),
}

/// Where wood stands on the other side of a step: before it for those who look back, after it for the past.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Carried {
    /// What moved, in birth order.
    pub metamers: Vec<MetamerId>,
    /// Their nodes.
    pub ends: Vec<Vec3>,
    /// Their normals.
    pub normals: Vec<Vec3>,
    /// The axes that they bear, in birth order.
    pub axes: Vec<AxisId>,
    /// The directions of those axes' buds when they were laid down.
    pub directions: Vec<Vec3>,
}

impl Carried {
    /// Whether the columns fit each other and the metamers and axes that there are.
    pub(crate) fn is_sound(&self, [metamers, axes]: [u32; 2]) -> bool {
        let places = self.ends.iter().chain(&self.normals).chain(&self.directions);
        [self.ends.len(), self.normals.len()] == [self.metamers.len(); 2]
            && self.directions.len() == self.axes.len()
            && self.metamers.iter().all(|id| id.raw() < metamers)
            && self.axes.iter().all(|axis| axis.raw() < axes)
            && places.into_iter().all(|place| place.is_finite())
    }
}

/// What died in one go, in birth order.
#[derive(Default)]
struct Fallen {
    metamers: Vec<MetamerId>,
    /// Those of the metamers that nothing below drew along.
    roots: Vec<MetamerId>,
    axes: Vec<AxisId>,
}

/// No motion bears a row.
const UNMOVED: u32 = u32::MAX;

impl Plant {
    /// Cuts off metamers and everything above them, within a step: girth becomes what it would be without them.
    /// What remains of their axes has no buds any more. Returns what was cut off, in birth order.
    ///
    /// # Panics
    /// If one is a seed, or dead.
    pub fn prune(&mut self, cuts: &[MetamerId]) -> Vec<MetamerId> {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        assert!(
            cuts.iter().all(|&cut| !self.is_seed(cut) && self.is_alive(cut)),
            "only living wood can be cut"
        );
        let Fallen { metamers, roots, .. } = self.fell(cuts);
        for cut in roots {
            self.take_off_tips(cut);
            self.timeline.edits.push(Edit::Pruned(cut));
        }
        metamers
    }

    /// Sheds the branches that begin with some axes, within a step; their girth stays in the wood below.
    /// Returns what was shed, and the axes whose buds died with it, both in birth order.
    pub fn shed(&mut self, axes: &[AxisId]) -> (Vec<MetamerId>, Vec<AxisId>) {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        let wood = axes.iter().filter_map(|&axis| self.axes.first(axis));
        let wood: Vec<MetamerId> = wood.filter(|&first| self.is_alive(first)).collect();
        let Fallen { metamers, roots, axes: mut dead } = self.fell(&wood);
        self.timeline.edits.extend(roots.iter().map(|&root| Edit::Shed(self.metamers.axis(root))));
        for &bud in axes {
            if self.axes.first(bud).is_none() && self.is_axis_alive(bud) {
                self.axes.death.set(bud.index(), self.timeline.now);
                self.timeline.edits.push(Edit::Shed(bud));
                dead.push(bud);
            }
        }
        (metamers, dead)
    }

    /// Lets living metamers die, and all that stands on them.
    fn fell(&mut self, roots: &[MetamerId]) -> Fallen {
        let mut fallen = Fallen::default();
        let mut roots = roots.to_vec();
        roots.sort_unstable();
        for root in roots {
            // What falls with another is younger than that.
            if self.is_alive(root) {
                fallen.roots.push(root);
                self.fell_branch(root, &mut fallen);
            }
        }
        fallen.metamers.sort_unstable();
        fallen.axes.sort_unstable();
        self.living = self.living.wrapping_sub(fallen.metamers.len() as u32);
        fallen
    }

    /// Lets a metamer die, and all that stands on it.
    fn fell_branch(&mut self, root: MetamerId, fallen: &mut Fallen) {
        let now = self.timeline.now;
        // Axes, and the first of their metamers to fall; none of a bud that has not grown.
        let mut waiting = vec![(self.metamers.axis(root), Some(root))];
        while let Some((axis, lowest)) = waiting.pop() {
            if self.is_axis_alive(axis) {
                self.axes.death.set(axis.index(), now);
                fallen.axes.push(axis);
            }
            let Some(lowest) = lowest else { continue };
            let mut next = self.axes.last(axis);
            while let Some(id) = next {
                // The top of an axis may have been cut off before.
                if self.is_alive(id) {
                    self.metamers.death.set(id.index(), now);
                    fallen.metamers.push(id);
                    let standing = self.laterals(id).filter(|&lateral| self.is_standing(lateral));
                    waiting.extend(standing.map(|lateral| (lateral, self.axes.first(lateral))));
                }
                next = self.metamers.parent(id).filter(|_| id != lowest);
            }
        }
    }

    /// Moves the wood on a path and what it bears, within a step. A row of the path goes with its own motion,
    /// every other one with that of the row which bears it. Returns what moved and where it was.
    ///
    /// # Panics
    /// If the path is empty, does not go from parents to children, or has another number of motions.
    pub fn carry(&mut self, path: &[MetamerId], motions: &[Motion]) -> Vec<(MetamerId, Vec3)> {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        assert_eq!(path.len(), motions.len(), "each row of the path has its motion");
        let on_path = |pair: &[MetamerId]| self.metamers.parent(pair[1]) == Some(pair[0]);
        assert!(path.windows(2).all(on_path), "a path goes from parents to children");
        let mut motions = motions.to_vec();
        let first = path[0].index();
        let mut bearers = vec![UNMOVED; self.metamer_count() - first];
        let mut carried = Carried::default();
        let mut next = 0;
        for index in first..self.metamer_count() {
            let id = MetamerId::new(index);
            let parent = self.metamers.parent[index];
            let is_on_path = path.get(next) == Some(&id);
            if is_on_path {
                bearers[index - first] = next as u32;
            } else if self.is_alive(id) && parent != MetamerId::NONE && parent.index() >= first {
                bearers[index - first] = bearers[parent.index() - first];
            }
            let Some(motion) = motions.get_mut(bearers[index - first] as usize) else { continue };
            if is_on_path {
                next += 1;
                let heading = self.heading(id);
                // Its parent's node is where it shall be by now, for parents come first.
                let placed = |parent: MetamerId| match carried.metamers.binary_search(&parent) {
                    Ok(at) => carried.ends[at],
                    Err(_) => self.metamers.end(parent),
                };
                let below = self.metamers.parent(id).map(placed);
                let end = motion.apply(self.metamers.end(id));
                let end = match below {
                    Some(below) if end.distance(below) < SHORTEST => below + SHORTEST * motion.turn(heading),
                    _ => end,
                };
                *motion = Motion { from: self.metamers.end(id), to: end, ..*motion };
                if motion.is_rest() {
                    continue;
                }
                let heading = below.map_or(heading, |below| (end - below).normalize());
                let normal = motion.turn(self.metamers.normal(id)).reject_from_normalized(heading);
                carried.metamers.push(id);
                carried.ends.push(end);
                carried
                    .normals
                    .push(normal.try_normalize().unwrap_or_else(|| heading.any_orthonormal_vector()));
            } else if !motion.is_rest() {
                carried.metamers.push(id);
                carried.ends.push(motion.apply(self.metamers.end(id)));
                carried.normals.push(motion.turn(self.metamers.normal(id)));
            }
        }
        for axis in self.axes_from(path).filter(|&axis| self.is_standing(axis)) {
            let Some(bearer) = self.axes.bearer(axis).filter(|bearer| bearer.index() >= first) else {
                continue;
            };
            let Some(motion) = motions.get(bearers[bearer.index() - first] as usize) else { continue };
            if self.is_alive(bearer) && !motion.is_rest() {
                carried.axes.push(axis);
                carried.directions.push(motion.turn(self.axes.direction(axis)));
            }
        }
        self.swap(&mut carried);
        let moved = carried.metamers.iter().copied().zip(carried.ends.iter().copied()).collect();
        if !carried.metamers.is_empty() {
            self.timeline.edits.push(Edit::Carried(Box::new(carried)));
        }
        moved
    }

    /// Grows a copy of the branch that begins with `source` from the node of `onto`, within a step; the copy
    /// stands where the motion takes what is copied, with its width constraints. Returns its axis.
    ///
    /// # Panics
    /// If `source` is a seed, or one of them is dead.
    pub fn graft(&mut self, source: MetamerId, onto: MetamerId, motion: &Motion) -> AxisId {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        assert!(
            !self.is_seed(source) && self.is_alive(source) && self.is_alive(onto),
            "grafts are living wood"
        );
        let rows = self.above(source);
        let axes = self.borne_by(&rows);
        let root = self.axes.push(
            onto,
            motion.turn(self.heading(source)),
            self.axes.order(self.metamers.axis(onto)) + 1,
        );
        self.timeline.edits.push(Edit::Grafted(root));
        self.grafts.entry(onto).or_default().push(root);
        let first_row = self.metamers.parent.len();
        let copy_of = |id: MetamerId| rows.binary_search(&id).ok().map(|at| MetamerId::new(first_row + at));
        let copy_of_axis =
            |id: AxisId| axes.binary_search(&id).map_or(root, |at| AxisId::new(root.index() + 1 + at));
        let (mut radii, mut organs) = (Vec::new(), Vec::new());
        for &row in &rows {
            let parent = self.metamers.parent(row).and_then(copy_of).unwrap_or(onto);
            let lateral = self.metamers.lateral[row.index()];
            let first_alive = self.whorl(row).find(|axis| axes.binary_search(axis).is_ok());
            let lateral = first_alive.filter(|_| lateral != AxisId::NONE).map_or(AxisId::NONE, copy_of_axis);
            let id = self.metamers.push(&Row {
                parent,
                axis: copy_of_axis(self.metamers.axis(row)),
                end: motion.apply(self.metamers.end(row)),
                normal: motion.turn(self.metamers.normal(row)),
                lateral,
            });
            self.living = self.living.wrapping_add(1);
            if let Some(&diameter) = self.widths.get(&row) {
                self.set_width(id, Some(diameter));
            }
            if let Some(radius) = self.given_radius(row) {
                radii.push((id, Some(radius)));
            }
            if let Some(borne) = self.given_organs(row) {
                organs.push((id, Some(borne.clone())));
            }
        }
        for &axis in &axes {
            let bearer = self.axes.bearer(axis).and_then(copy_of).unwrap_or(onto);
            let order = self.axes.order(self.metamers.axis(bearer)) + 1;
            let copy = self.axes.push(bearer, motion.turn(self.axes.direction(axis)), order);
            if !self.is_axis_alive(axis) {
                self.axes.death.set(copy.index(), self.timeline.now);
            }
            if self.is_graft(axis) {
                self.timeline.edits.push(Edit::Grafted(copy));
                self.grafts.entry(bearer).or_default().push(copy);
            }
        }
        if !self.is_axis_alive(self.metamers.axis(source)) {
            self.axes.death.set(root.index(), self.timeline.now);
        }
        for index in first_row..self.metamers.parent.len() {
            self.link(MetamerId::new(index));
        }
        // They are those of living wood, so none is refused.
        let _given = self.give_radii(&radii);
        let _borne = self.give_organs(&organs);
        for (at, shed) in self.tips_of_shed(&rows).into_iter().enumerate().filter(|&(_, shed)| shed > 0) {
            self.timeline.edits.push(Edit::Scarred(MetamerId::new(first_row + at), shed));
        }
        root
    }

    /// Lays down a bud at the node of wood that was there before this step, within a step; returns its axis. In the
    /// timeline it is a graft without wood.
    ///
    /// # Panics
    /// If the wood is dead.
    pub fn graft_bud(&mut self, onto: MetamerId, direction: Vec3) -> AxisId {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        assert!(self.is_alive(onto), "buds are borne by living wood");
        let order = self.axes.order(self.metamers.axis(onto)) + 1;
        let axis = self.axes.push(onto, direction, order);
        self.timeline.edits.push(Edit::Grafted(axis));
        self.grafts.entry(onto).or_default().push(axis);
        axis
    }

    /// Tips of twigs that were shed from each of the living metamers of a branch or a plant, which are in birth order.
    pub fn tips_of_shed(&self, rows: &[MetamerId]) -> Vec<u32> {
        // An end carries one tip of its own.
        let mut living = vec![1u32; rows.len()];
        let mut goes_on = vec![false; rows.len()];
        for &row in rows {
            let Some(at) = self.metamers.parent(row).and_then(|parent| rows.binary_search(&parent).ok())
            else {
                continue;
            };
            living[at] += self.metamers.tips(row);
            goes_on[at] |= !self.begins_wood(row);
        }
        let own = |at: usize| living[at] - u32::from(goes_on[at]);
        rows.iter().enumerate().map(|(at, &row)| self.metamers.tips(row).saturating_sub(own(at))).collect()
    }

    /// Adds the tips of shed twigs that grafts of a step have brought along, or takes them away.
    pub(crate) fn scar(&mut self, edits: std::ops::Range<usize>, sign: i32) {
        for at in edits {
            if let Edit::Scarred(id, tips) = self.timeline.edits[at] {
                self.add_tips(id, sign.wrapping_mul(tips as i32));
            }
        }
    }

    /// Sets, changes or removes a width constraint within a step: the diameter of a metamer in internodes.
    pub fn set_width(&mut self, id: MetamerId, diameter: Option<f32>) {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        let former = self.replace_width(id, diameter);
        if former != diameter {
            self.timeline.edits.push(Edit::Width(id, former));
        }
    }

    /// Width constraints on living metamers, in birth order: their diameters in internodes.
    pub fn widths(&self) -> impl Iterator<Item = (MetamerId, f32)> + '_ {
        self.widths.iter().map(|(&id, &diameter)| (id, diameter)).filter(|&(id, _)| self.is_alive(id))
    }

    /// The edits up to the present.
    pub(crate) fn past_edits(&self) -> &[Edit] {
        &self.timeline.edits[..self.timeline.present().edits as usize]
    }

    /// The living metamers of the branch that begins with a living one, in birth order.
    pub fn above(&self, first: MetamerId) -> Vec<MetamerId> {
        let mut inside = vec![false; self.metamer_count() - first.index()];
        let mut found = Vec::new();
        for index in first.index()..self.metamer_count() {
            let id = MetamerId::new(index);
            let parent = self.metamers.parent[index];
            let stands_on =
                parent != MetamerId::NONE && parent >= first && inside[parent.index() - first.index()];
            if (id == first || stands_on) && self.is_alive(id) {
                inside[index - first.index()] = true;
                found.push(id);
            }
        }
        found
    }

    /// The axes that some metamers bear, which are in birth order: living buds and standing wood.
    fn borne_by(&self, metamers: &[MetamerId]) -> Vec<AxisId> {
        let is_there = membership(metamers);
        let standing = self.axes_from(metamers).filter(|&axis| self.is_standing(axis));
        standing.filter(|&axis| self.axes.bearer(axis).is_some_and(&is_there)).collect()
    }

    /// The axes among which those of a branch are: none is older than that of its first metamer.
    fn axes_from(&self, metamers: &[MetamerId]) -> impl Iterator<Item = AxisId> + use<> {
        let first = metamers.first().map_or(self.axis_count(), |&first| self.metamers.axis(first).index());
        (first..self.axis_count()).map(AxisId::new)
    }

    /// Takes the tips of a branch off the wood below, as if it had never grown.
    fn take_off_tips(&mut self, cut: MetamerId) {
        let lost = self.tips_lost_with(cut);
        self.add_tips(self.metamers.parent[cut.index()], -lost);
    }

    /// Tips that the wood below a metamer loses when it is cut off: where its axis went on, the end is a tip again.
    pub(crate) fn tips_lost_with(&self, cut: MetamerId) -> i32 {
        let remains = u32::from(!self.begins_wood(cut));
        self.metamers.tips(cut).wrapping_sub(remains) as i32
    }

    /// Swaps where wood stands with where it stood.
    pub(crate) fn swap(&mut self, carried: &mut Carried) {
        for ((&id, end), normal) in carried.metamers.iter().zip(&mut carried.ends).zip(&mut carried.normals) {
            mem::swap(end, &mut self.metamers.end[id.index()]);
            mem::swap(normal, &mut self.metamers.normal[id.index()]);
        }
        for (&axis, direction) in carried.axes.iter().zip(&mut carried.directions) {
            mem::swap(direction, &mut self.axes.direction[axis.index()]);
        }
    }

    /// Puts another width constraint in place of one; returns the one that was.
    pub(crate) fn replace_width(&mut self, id: MetamerId, diameter: Option<f32>) -> Option<f32> {
        match diameter {
            Some(diameter) => self.widths.insert(id, diameter),
            None => self.widths.remove(&id),
        }
    }
}

/// Tells which metamers are among some, which are in birth order.
fn membership(metamers: &[MetamerId]) -> impl Fn(MetamerId) -> bool + use<> {
    let first = metamers.first().map_or(0, |first| first.index());
    let len = metamers.last().map_or(0, |last| last.index() + 1 - first);
    let mut inside = vec![false; len];
    for id in metamers {
        inside[id.index() - first] = true;
    }
    move |id| id.index().checked_sub(first).and_then(|at| inside.get(at)).is_some_and(|&inside| inside)
}
