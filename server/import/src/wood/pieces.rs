//! Pieces of wood in metres become nodes an internode apart.

use espalier_plant::{
    DormantBuds, Wood, WoodAxis, WoodNode,
    wood::{SHORTEST, as_written},
};
use glam::{DVec3, Vec3};

use super::{
    Fault, MAX_SHED, MAX_STEP, Place, WoodNote, WoodOptions, internode, malformed, out_of_range, too_many,
};

/// A piece that begins farther than this from the wood that bears it, in internodes, is joined to it by a node where
/// it begins.
const GAP: f64 = 0.5;

/// A straight piece of wood, in metres, Y up.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// The piece that bears it.
    pub parent: Option<u32>,
    /// Whether it goes on where its parent ends.
    pub continues: bool,
    /// Where it begins, if the file says so; a piece without parent and beginning is a seed.
    pub start: Option<DVec3>,
    /// Where it ends.
    pub end: DVec3,
    /// Its radius in metres.
    pub radius: Option<f64>,
    /// The step in which it grew.
    pub birth: Option<u32>,
    /// Its number in the program that wrote it.
    pub id: Option<u32>,
    /// Tips of twigs that were shed from it.
    pub shed: u32,
    /// Whether it is one internode, however long.
    pub is_whole: bool,
    /// The line that it stands in.
    pub line: u64,
    /// The column of its radius, from 1.
    pub thickness: u64,
}

impl Piece {
    /// How long it is in metres; a seed has no length.
    pub(super) fn length(&self, pieces: &[Self]) -> Option<f64> {
        let start = self.start.or_else(|| Some(pieces[self.parent? as usize].end))?;
        Some(start.distance(self.end))
    }
}

/// Turned as plants stand here: from Z up to Y up.
pub(super) fn y_up([x, y, z]: [f64; 3]) -> DVec3 {
    DVec3::new(x, z, -y)
}

/// Joins pieces to wood: long ones are cut into internodes, and the base of the first trunk comes to the origin. Gives
/// the length of an internode in metres as well, which the file may have said.
pub(super) fn join(pieces: &[Piece], said: Option<f32>, options: &WoodOptions) -> Result<(Wood, f32), Fault> {
    let order = in_order(pieces)?;
    let Some(&first) = order.first() else { return Err(malformed(None, "it holds no wood")) };
    let first = &pieces[first as usize];
    let origin = first.start.unwrap_or(first.end);
    let has_births = pieces.iter().any(|piece| piece.birth.is_some());
    let length = options.internode_length.or(said);
    let length = length.unwrap_or_else(|| internode::length(pieces, origin, options));
    let mut joinery = Joinery {
        options,
        length,
        metres: as_written(length),
        origin,
        has_births,
        nodes: Vec::new(),
        axes: Vec::new(),
        shed: 0,
        scars: Vec::new(),
    };
    let mut ends: Vec<Option<Joined>> = vec![None; pieces.len()];
    for at in order {
        let piece = &pieces[at as usize];
        let parent = piece.parent.and_then(|parent| ends[parent as usize]);
        ends[at as usize] = Some(joinery.add(piece, parent)?);
    }
    // A seed may stand alone, but a file that has wood is not meant to be one.
    let has_wood = |piece: &Piece| piece.start.is_some() || piece.parent.is_some();
    if pieces.iter().any(has_wood) && joinery.nodes.iter().all(|(node, ..)| node.parent.is_none()) {
        let what = "it holds no wood: nothing in it is as long as a hundredth of an internode";
        return Err(malformed(None, what));
    }
    Ok((joinery.finish(), length))
}

/// A trunk that is thicker than this share of its tree's height is one of few, or in another unit.
const THICK: f64 = 0.25;

/// Says so where the first trunk is too thick for the tree to be likely.
pub(super) fn too_thick(pieces: &[Piece]) -> Option<WoodNote> {
    let foot = pieces.iter().find(|piece| piece.parent.is_none())?;
    let ground = foot.start.unwrap_or(foot.end).y;
    // A seed has no girth of its own.
    let first = pieces.iter().find(|piece| piece.radius.is_some())?;
    let tall = pieces.iter().fold(0.0_f64, |tall, piece| tall.max(piece.end.y - ground));
    let share = 2.0 * first.radius? / tall;
    (tall > 0.0 && share > THICK).then(|| WoodNote::Thick { percent: (100.0 * share).round() as u32 })
}

/// The pieces, parents before children, in the order of the file but for that.
fn in_order(pieces: &[Piece]) -> Result<Vec<u32>, Fault> {
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); pieces.len()];
    let mut waiting = Vec::new();
    for (piece, at) in pieces.iter().zip(0..) {
        match piece.parent {
            Some(parent) => children[parent as usize].push(at),
            None => waiting.push(at),
        }
    }
    waiting.reverse();
    let mut order = Vec::with_capacity(pieces.len());
    while let Some(at) = waiting.pop() {
        order.push(at);
        waiting.extend(children[at as usize].iter().rev());
    }
    if order.len() == pieces.len() {
        return Ok(order);
    }
    // Whoever has not been reached stands on a ring: as many steps down as there are pieces end in it.
    let mut is_reached = vec![false; pieces.len()];
    order.iter().for_each(|&at| is_reached[at as usize] = true);
    let lost = is_reached.iter().position(|reached| !reached).unwrap_or(0);
    let down = |at: usize| pieces[at].parent.map_or(at, |parent| parent as usize);
    let on_ring = (0..pieces.len()).fold(lost, |at, _| down(at));
    let ring = std::iter::successors(Some(down(on_ring)), |&at| Some(down(at)).filter(|_| at != on_ring));
    let first = ring.map(|at| pieces[at].line).min();
    Err(malformed(first.map(Place::Line), "what stands here bears itself"))
}

/// What has become of a piece.
#[derive(Clone, Copy)]
struct Joined {
    /// The node below its first one.
    base: u32,
    /// Its first node; behind `last` if it has none.
    first: u32,
    /// Its last node, or where it would be.
    last: u32,
    /// Its axis; none if it has no node.
    axis: Option<u32>,
}

struct Joinery<'a> {
    options: &'a WoodOptions,
    /// Of an internode, in metres.
    length: f32,
    /// The same as it is written.
    metres: f64,
    origin: DVec3,
    has_births: bool,
    /// Nodes, and their numbers where they were written.
    nodes: Vec<(WoodNode, Option<u32>, Depth)>,
    /// Axes, and their last nodes.
    axes: Vec<(WoodAxis, u32)>,
    /// Tips of all twigs that were shed so far.
    shed: u32,
    /// Nodes that carry some, and how many.
    scars: Vec<(u32, u32)>,
}

/// Internodes from a node down to its seed.
type Depth = u32;

impl Joinery<'_> {
    fn add(&mut self, piece: &Piece, parent: Option<Joined>) -> Result<Joined, Fault> {
        let Some(parent) = parent else {
            let seed = self.sow(piece)?;
            if piece.start.is_none() {
                return Ok(Joined {
                    base: seed,
                    first: seed,
                    last: seed,
                    axis: Some(self.nodes[seed as usize].0.axis),
                });
            }
            let axis = Some(self.nodes[seed as usize].0.axis);
            return self.grow(piece, seed, axis);
        };
        let is_seed = |node: u32| self.nodes[node as usize].0.parent.is_none();
        let is_free = |axis: u32| self.axes[axis as usize].1 == parent.last;
        // What grows from a seed is its trunk, and what else does is the trunk of another one there.
        let continues = piece.continues || is_seed(parent.last);
        if let Some(axis) = parent.axis.filter(|&axis| continues && is_free(axis)) {
            return self.grow(piece, parent.last, Some(axis));
        }
        let bearer = if continues { parent.last } else { self.nearest(piece, parent) };
        if is_seed(bearer) {
            let place = self.nodes[bearer as usize].0.end.as_dvec3();
            let start = place * self.metres + self.origin;
            let seed = self.sow(&Piece { start: Some(start), birth: None, id: None, ..piece.clone() })?;
            let axis = Some(self.nodes[seed as usize].0.axis);
            return self.grow(piece, seed, axis);
        }
        self.grow(piece, bearer, None)
    }

    /// The node of a piece that is nearest to where another one begins.
    fn nearest(&self, piece: &Piece, Joined { base, first, last, .. }: Joined) -> u32 {
        let Some(start) = piece.start.map(|start| self.internodes(start)) else { return last };
        let away = |&node: &u32| self.nodes[node as usize].0.end.as_dvec3().distance_squared(start);
        // Those of a piece stand in a row: only the two between which it begins can be the nearest.
        let place = |node: u32| self.nodes[node as usize].0.end.as_dvec3();
        let (mut least, mut most) = (first, last.max(first));
        let along = place(last) - place(first.min(last));
        while least < most {
            let middle = least.midpoint(most);
            if (place(middle) - start).dot(along) < 0.0 { least = middle + 1 } else { most = middle }
        }
        let nodes = [base]
            .into_iter()
            .chain(least.saturating_sub(1).max(first)..least + 1)
            .filter(|&node| node <= last)
            .filter(|&node| node == last || self.nodes[node as usize].0.parent.is_some());
        nodes.min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(last)
    }

    fn internodes(&self, place: DVec3) -> DVec3 {
        (place - self.origin) / self.metres
    }

    fn sow(&mut self, piece: &Piece) -> Result<u32, Fault> {
        let place = self.internodes(piece.start.unwrap_or(piece.end));
        let is_itself = piece.start.is_none();
        let birth = piece.birth.filter(|_| is_itself && !self.nodes.is_empty()).unwrap_or(0);
        self.axes.push((WoodAxis { bearer: None, direction: None, has_bud: true }, 0));
        let axis = self.axes.len() as u32 - 1;
        let node = WoodNode {
            parent: None,
            axis,
            end: self.within(piece, place)?,
            normal: None,
            radius: None,
            birth,
        };
        self.push(piece, node, piece.id.filter(|_| is_itself), 0)
    }

    /// Lets the nodes of a piece grow from a node, on an axis or as a new one.
    fn grow(&mut self, piece: &Piece, bearer: u32, mut axis: Option<u32>) -> Result<Joined, Fault> {
        let below = self.nodes[bearer as usize].0;
        let from = below.end.as_dvec3();
        let end = self.internodes(piece.end);
        self.within(piece, end)?;
        let start = piece.start.map_or(from, |start| self.internodes(start));
        // Nothing has grown in the step of the first seed.
        let birth = piece.birth.unwrap_or(below.birth).max(1);
        if birth < below.birth {
            let what = format!("it was born in step {birth}, before what bears it");
            let allowed = format!("{} to {MAX_STEP}", below.birth);
            return Err(out_of_range(Some(Place::Line(piece.line)), what, allowed));
        }
        let count = if piece.is_whole { 1.0 } else { internode::cut(start.distance(end)) };
        let is_apart = start.distance(from) >= GAP;
        let places = (1..=count as u32).map(|k| start.lerp(end, f64::from(k) / count));
        let places = is_apart.then_some(start).into_iter().chain(places);
        let radius = self.radius(piece)?;
        let (base, first, mut last) = (bearer, self.nodes.len() as u32, bearer);
        for place in places {
            let place = self.within(piece, place)?;
            let (below, _, depth) = self.nodes[last as usize];
            if place.distance(below.end) < SHORTEST {
                continue;
            }
            let axis = *axis.get_or_insert_with(|| {
                self.axes.push((WoodAxis { bearer: Some(bearer), direction: None, has_bud: true }, bearer));
                self.axes.len() as u32 - 1
            });
            let birth = if self.has_births { birth } else { depth / self.options.shoot.max(1) + 1 };
            let node = WoodNode { parent: Some(last), axis, end: place, normal: None, radius, birth };
            last = self.push(piece, node, piece.id, depth + 1)?;
        }
        if piece.shed > 0 && last != bearer {
            self.shed = self.shed.saturating_add(piece.shed);
            if self.shed > MAX_SHED {
                let (place, what) = (Place::Line(piece.line), "too many twigs were shed");
                return Err(out_of_range(Some(place), what, format!("up to {MAX_SHED} in a file")));
            }
            self.scars.push((last, piece.shed));
        }
        Ok(Joined { base, first, last, axis })
    }

    /// The radius of a piece in internodes.
    fn radius(&self, piece: &Piece) -> Result<Option<f32>, Fault> {
        let Some(metres) = piece.radius else { return Ok(None) };
        let radius = (metres / self.metres) as f32;
        let most = self.options.extent;
        if radius > most {
            let (place, what) =
                (Place::Cell(piece.line, piece.thickness), format!("the radius is {metres} m"));
            let allowed =
                format!("up to {} m, which is {most} internodes of {} m", most * self.length, self.length);
            return Err(out_of_range(Some(place), what, allowed));
        }
        // Of one that is 0 or less than an f32 can hold, nothing is known; its width follows from what it bears.
        Ok(Some(radius).filter(|radius| *radius > 0.0))
    }

    fn push(&mut self, piece: &Piece, node: WoodNode, id: Option<u32>, depth: Depth) -> Result<u32, Fault> {
        if self.nodes.len() >= self.options.nodes {
            return Err(too_many(Some(Place::Line(piece.line)), self.options));
        }
        if node.birth > MAX_STEP {
            let what = format!("it was born in step {}", node.birth);
            return Err(out_of_range(Some(Place::Line(piece.line)), what, format!("0 to {MAX_STEP}")));
        }
        let number = self.nodes.len() as u32;
        self.axes[node.axis as usize].1 = number;
        self.nodes.push((node, id, depth));
        Ok(number)
    }

    fn within(&self, piece: &Piece, place: DVec3) -> Result<Vec3, Fault> {
        let (extent, internode_length) = (self.options.extent, self.length);
        if place.is_finite() && place.abs().max_element() <= f64::from(extent) {
            return Ok(place.as_vec3());
        }
        let reach = extent * internode_length;
        let what =
            "it lies too far from the first trunk; import it with longer internodes, or in another unit";
        let allowed = format!("up to {reach} m, as far as {extent} internodes of {internode_length} m reach");
        Err(out_of_range(Some(Place::Line(piece.line)), what, allowed))
    }

    /// The nodes in the order of their births; of those born together, in the order in which they were numbered.
    fn finish(self) -> Wood {
        let Self { nodes, axes, scars, .. } = self;
        let mut order: Vec<u32> = (0..nodes.len() as u32).collect();
        let key = |at: u32| (nodes[at as usize].0.birth, nodes[at as usize].1.unwrap_or(at));
        order.sort_by_key(|&at| key(at));
        let mut place = vec![0u32; nodes.len()];
        let renumber = |order: &[u32], place: &mut Vec<u32>| {
            order.iter().zip(0..).for_each(|(&at, number)| place[at as usize] = number);
        };
        renumber(&order, &mut place);
        let is_sorted = |place: &[u32]| {
            let parents = nodes.iter().zip(place).filter_map(|((node, ..), &own)| Some((node.parent?, own)));
            parents.clone().all(|(parent, own)| place[parent as usize] < own) && place.first() == Some(&0)
        };
        if !is_sorted(&place) {
            order.sort_by_key(|&at| (nodes[at as usize].0.birth, at));
            renumber(&order, &mut place);
        }
        let moved = |at: u32| place[at as usize];
        let node = |&at: &u32| {
            let (node, ..) = nodes[at as usize];
            WoodNode { parent: node.parent.map(moved), ..node }
        };
        let axis = |(axis, _): &(WoodAxis, u32)| WoodAxis { bearer: axis.bearer.map(moved), ..*axis };
        let mut scars: Vec<_> = scars.into_iter().map(|(at, tips)| (moved(at), tips)).collect();
        scars.sort_unstable();
        Wood {
            nodes: order.iter().map(node).collect(),
            axes: axes.iter().map(axis).collect(),
            scars,
            buds: DormantBuds::OnYoungWood,
            ..Wood::default()
        }
    }
}
