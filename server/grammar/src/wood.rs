//! Words as wood: what the turtle draws becomes nodes and axes, and what goes on growing becomes buds.

use espalier_plant::{
    DormantBuds, KeyTable, Organ, OrganKind, Organs, Stance, Wood, WoodAxis, WoodNode,
    organs::{MOST_ORGANS, shortest_sides},
    wood::SHORTEST,
};
use glam::{DVec3, Vec3};

use crate::{
    derivation::Derivation,
    environment::Environment,
    grammar::{Buds, Radii},
    keys,
    limits::Stop,
    program::Program,
    reading::{Cost, Pen, Reading},
    turtle::State,
    word::Tag,
};

/// What is drawn is joined until a node is so far from the one before, in internodes.
const SHORT: f64 = 0.25;
/// What is left at the end of a branch must be so long to be a node of its own.
const LEAST: f64 = 2.0 * SHORTEST as f64;
/// Wood that begins farther from its bearer stands by itself.
const GAP: f64 = 0.1;
/// The thickest wood, in internodes.
const THICKEST: f64 = 1000.0;

/// What bounds the wood, and turns widths into radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WoodOptions {
    /// The most nodes.
    pub nodes: usize,
    /// How far wood may be from where the turtle begins on each axis, in internodes.
    pub extent: u32,
    /// The radius that the thinnest wood gets where the grammar sets widths, in internodes.
    pub twig_radius: f64,
}

/// Wood, and which module drew each node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// The wood. A node's birth is the step in which its module came to be; one more where the axiom draws.
    pub wood: Wood,
    /// The key of each node: equal from step to step while its module goes on. A seed has that of what it bears.
    pub keys: Vec<u64>,
    /// Axes that the grammar goes on from: those with a module at their tip that rules rewrite.
    pub growing: usize,
    /// For each node the key of the module of the word that drew it, by way of the homomorphism or not, if a
    /// derivation is [traced](Derivation::traced).
    pub modules: Vec<u64>,
    /// Lines that the turtle drew.
    pub lines: usize,
    /// Lines that were too short to be nodes, and were joined with what follows.
    pub joined: usize,
    /// Organs that stand on no wood, or where there are as many as can be.
    pub unborne: usize,
    /// What drawing has cost, as [`Drawing::work`] says.
    pub read: u64,
}

/// A word on its way to wood.
#[derive(Clone, Debug)]
pub struct Drawing {
    reading: Reading,
    at: usize,
    carpenter: Carpenter,
}

impl Derivation {
    /// Begins to draw the word of the last step.
    pub fn drawing(&self, options: WoodOptions) -> Drawing {
        let program = self.program();
        let reading = Reading::new(program, self.when(), self.limits());
        let mut carpenter = Carpenter::new(program, options);
        carpenter.modules = self.is_traced().then(Vec::new);
        Drawing { reading, at: 0, carpenter }
    }

    /// Begins to draw it as it goes on from a drawing of a word before, in which nodes had these keys. What was one node stays one, and what was several stays as many, however long it has become: so what bears
    /// a node is the same from step to step.
    pub fn drawing_on(&self, options: WoodOptions, keys: &[u64]) -> Drawing {
        let mut drawing = self.drawing(options);
        drawing.carpenter.known =
            Some(Known { keys: KeyTable::new(keys.iter().copied()), depth: self.depth() });
        drawing
    }

    /// Draws the word of the last step.
    ///
    /// # Errors
    /// Where there is too much wood, it reaches too far, or a number is none.
    pub fn draw(&self, surroundings: &dyn Environment, options: WoodOptions) -> Result<Drawn, Stop> {
        self.drawing(options).complete(self, surroundings)
    }

    /// Draws the word of the last step as [`Derivation::drawing_on`] says.
    ///
    /// # Errors
    /// As [`Derivation::draw`] does.
    pub fn draw_on(
        &self,
        surroundings: &dyn Environment,
        options: WoodOptions,
        keys: &[u64],
    ) -> Result<Drawn, Stop> {
        self.drawing_on(options, keys).complete(self, surroundings)
    }
}

impl Drawing {
    /// Reads so many modules of the word that it was begun with, or fewer that are read as many others or compute long;
    /// whether all have been read.
    ///
    /// # Errors
    /// Where there is too much wood, it reaches too far, or a number is none.
    pub fn advance(
        &mut self,
        derivation: &Derivation,
        surroundings: &dyn Environment,
        modules: usize,
    ) -> Result<bool, Stop> {
        let (program, word) = (derivation.program(), derivation.word());
        let end = self.at.saturating_add(modules.max(1)).min(word.len());
        let until = self.reading.cost.until(modules.max(1));
        while self.at < end && self.reading.cost.is_below(&until) {
            self.carpenter.module = word.key(self.at);
            self.reading.read(program, word, self.at, surroundings, &mut self.carpenter)?;
            self.at += 1;
        }
        Ok(self.at == word.len())
    }

    /// What it has cost: modules that it has read, as what they stand for, and steps of computing.
    pub fn work(&self) -> u64 {
        self.at as u64 + self.reading.cost.since(&Cost::default())
    }

    fn complete(mut self, derivation: &Derivation, surroundings: &dyn Environment) -> Result<Drawn, Stop> {
        while !self.advance(derivation, surroundings, usize::MAX)? {}
        self.finish()
    }

    /// The wood.
    ///
    /// # Errors
    /// Where there is too much of it, or it reaches too far.
    pub fn finish(mut self) -> Result<Drawn, Stop> {
        self.carpenter.end_axis()?;
        let read = self.work();
        Ok(Drawn { read, ..self.carpenter.finish() })
    }
}

/// Where wood goes on within a branch.
#[derive(Clone, Copy, Debug, Default)]
struct Level {
    /// The last node; that which bears the branch while it has none.
    node: Option<u32>,
    /// The axis, once it has wood.
    axis: Option<u32>,
    /// What has been drawn since the last node.
    loose: Option<Loose>,
    /// Whether the turtle has gone elsewhere.
    has_jumped: bool,
    /// Where what comes next begins, if it went elsewhere or there is no node.
    from: DVec3,
    /// Where a module that goes on growing points, if nothing has been drawn since.
    apex: Option<DVec3>,
    is_cut: bool,
}

/// A line that is no node yet.
#[derive(Clone, Copy, Debug)]
struct Loose {
    tag: Tag,
    /// Where it ends.
    end: DVec3,
    /// Its radius, as the grammar has it.
    radius: f64,
    /// The key of the module of the word that draws it.
    module: u64,
}

/// What was drawn before.
#[derive(Clone, Debug)]
struct Known {
    keys: KeyTable,
    /// The step of the word that is drawn now.
    depth: u32,
}

impl Known {
    fn has(&self, key: u64) -> bool {
        self.keys.get(key).is_some()
    }

    /// How long what a module draws must be to be a node of its own. What came to be earlier and was none then would
    /// part what stands on it from what bears that.
    fn least(&self, tag: Tag) -> f64 {
        match self.has(tag.key) {
            true => LEAST,
            false if tag.born == self.depth => SHORT,
            false => f64::INFINITY,
        }
    }

    /// In how many pieces it was drawn.
    fn pieces(&self, key: u64) -> Option<usize> {
        let more = || (1..).take_while(|&number| self.has(keys::piece(key, number))).count();
        self.has(key).then(|| 1 + more())
    }
}

/// Joins what the turtle draws.
#[derive(Clone, Debug)]
struct Carpenter {
    options: WoodOptions,
    known: Option<Known>,
    buds: Buds,
    radii: Radii,
    nodes: Vec<WoodNode>,
    keys: Vec<u64>,
    modules: Option<Vec<u64>>,
    /// The key of the module of the word that is read.
    module: u64,
    axes: Vec<WoodAxis>,
    level: Level,
    levels: Vec<Level>,
    /// Whether something that the axiom holds draws.
    axiom_draws: bool,
    growing: usize,
    lines: usize,
    joined: usize,
    /// Organs and the nodes that bear them, if the grammar says where they are.
    organs: Option<Vec<(u32, Organ)>>,
    unborne: usize,
}

impl Carpenter {
    fn new(program: &Program, options: WoodOptions) -> Self {
        Self {
            options,
            known: None,
            buds: program.buds,
            radii: program.radii,
            nodes: Vec::new(),
            keys: Vec::new(),
            modules: None,
            module: 0,
            axes: Vec::new(),
            level: Level::default(),
            levels: Vec::new(),
            axiom_draws: false,
            growing: 0,
            lines: 0,
            joined: 0,
            organs: program.has_organs.then(Vec::new),
            unborne: 0,
        }
    }

    fn place(&self, node: u32) -> DVec3 {
        self.nodes[node as usize].end.as_dvec3()
    }

    fn add(&mut self, node: WoodNode, key: u64, module: u64) -> Result<u32, Stop> {
        if self.nodes.len() >= self.options.nodes {
            return Err(Stop::Nodes(self.options.nodes));
        }
        let reach = node.end.abs().max_element();
        if reach.is_nan() || reach > self.options.extent as f32 {
            return Err(Stop::Extent(self.options.extent));
        }
        self.nodes.push(node);
        self.keys.push(key);
        self.modules.iter_mut().for_each(|modules| modules.push(module));
        Ok(self.nodes.len() as u32 - 1)
    }

    /// Plants a seed.
    fn sow(&mut self, place: DVec3, tag: Tag) -> Result<(), Stop> {
        let axis = self.axes.len() as u32;
        let (end, birth) = (place.as_vec3(), tag.born);
        let seed = WoodNode { parent: None, axis, end, normal: None, radius: None, birth };
        let seed = self.add(seed, keys::piece(tag.key, usize::MAX), self.module)?;
        self.axes.push(WoodAxis { bearer: None, direction: None, has_bud: false });
        (self.level.node, self.level.axis) = (Some(seed), Some(axis));
        Ok(())
    }

    /// Makes nodes of what is loose, if that is long enough.
    fn fix(&mut self, least: f64) -> Result<(), Stop> {
        let Some(Loose { tag, end: to, radius, module }) = self.level.loose else { return Ok(()) };
        let from = match self.level.node {
            Some(node) if !self.stands_apart(node) => self.place(node),
            _ => self.level.from,
        };
        let length = to.distance(from);
        if !length.is_finite() {
            return Err(Stop::Extent(self.options.extent));
        }
        if length < least {
            return Ok(());
        }
        let bearer = self.level.node.filter(|&node| !self.stands_apart(node));
        match (bearer, self.level.axis) {
            (Some(_), Some(_)) => {}
            // A seed bears its trunk alone; what else begins there is a trunk of its own.
            (Some(node), None) if self.nodes[node as usize].parent.is_some() => {
                let direction = ((to - from) / length).as_vec3().try_normalize();
                self.level.axis = Some(self.axes.len() as u32);
                self.axes.push(WoodAxis { bearer: Some(node), direction, has_bud: false });
            }
            _ => {
                self.finish_axis();
                self.sow(from, tag)?;
            }
        }
        self.level.has_jumped = false;
        let known = self.known.as_ref().and_then(|known| known.pieces(tag.key));
        let count = known.map_or(length.round().max(1.0), |pieces| pieces as f64);
        if count > self.options.nodes as f64 {
            return Err(Stop::Nodes(self.options.nodes));
        }
        let radius = (self.radii == Radii::Grammar).then_some(radius);
        let radius = radius.filter(|radius| *radius > 0.0).map(|radius| radius as f32);
        for number in 0..count as usize {
            let end = from.lerp(to, (number + 1) as f64 / count).as_vec3();
            let (parent, axis) = (self.level.node, self.level.axis.unwrap_or_default());
            let node = WoodNode { parent, axis, end, normal: None, radius, birth: tag.born };
            self.level.node = Some(self.add(node, keys::piece(tag.key, number), module)?);
        }
        self.axiom_draws |= tag.born == 0;
        self.level.loose = None;
        Ok(())
    }

    /// Whether what is drawn next does not touch a node.
    fn stands_apart(&self, node: u32) -> bool {
        self.level.has_jumped && self.level.from.distance(self.place(node)) > GAP
    }

    /// Says whether the axis of this level goes on.
    fn finish_axis(&mut self) {
        let Some(axis) = self.level.axis else { return };
        let grows = self.level.apex.is_some() && !self.level.is_cut;
        self.growing += usize::from(grows);
        let axis = &mut self.axes[axis as usize];
        axis.has_bud = grows || (self.buds == Buds::Fill && !self.level.is_cut);
    }

    fn end_axis(&mut self) -> Result<(), Stop> {
        self.fix(LEAST)?;
        match (self.level.axis, self.level.node, self.level.apex) {
            (Some(_), ..) => self.finish_axis(),
            // A branch without wood is a bud, if something in it grows.
            (None, Some(node), Some(direction))
                if !self.level.is_cut && self.nodes[node as usize].parent.is_some() =>
            {
                self.growing += 1;
                let direction = direction.as_vec3().try_normalize();
                self.axes.push(WoodAxis { bearer: Some(node), direction, has_bud: true });
            }
            _ => {}
        }
        Ok(())
    }

    fn finish(mut self) -> Drawn {
        if self.nodes.is_empty() {
            let seed =
                WoodNode { parent: None, axis: 0, end: Vec3::ZERO, normal: None, radius: None, birth: 0 };
            self.nodes.push(seed);
            self.keys.push(0);
            self.modules.iter_mut().for_each(|modules| modules.push(0));
            self.axes.push(WoodAxis { bearer: None, direction: None, has_bud: true });
        }
        self.scale_radii();
        self.date();
        self.sort();
        let buds = if self.buds == Buds::Grammar { DormantBuds::Known } else { DormantBuds::Everywhere };
        let organs = self.organs.take().map(|organs| self.borne(organs)).unwrap_or_default();
        let wood = Wood { nodes: self.nodes, axes: self.axes, buds, organs, ..Wood::default() };
        let modules = self.modules.unwrap_or_default();
        let (lines, joined, unborne) = (self.lines, self.joined, self.unborne);
        Drawn { wood, keys: self.keys, growing: self.growing, modules, lines, joined, unborne, read: 0 }
    }

    /// The organs of every node but seeds, those included that bear none.
    fn borne(&mut self, mut organs: Vec<(u32, Organ)>) -> Vec<(u32, Organs)> {
        organs.sort_by_key(|&(node, _)| node);
        let none = Organs::from([]);
        let mut rest = organs.as_slice();
        let bearers = (0u32..).zip(&self.nodes).filter(|(_, node)| node.parent.is_some());
        let borne = |(node, _): (u32, &WoodNode)| {
            let own = rest.partition_point(|&(bearer, _)| bearer <= node);
            let (own, behind) = rest.split_at(own);
            rest = behind;
            let kept = own.len().min(MOST_ORGANS);
            self.unborne += own.len() - kept;
            let organs = if kept == 0 { none.clone() } else { own[..kept].iter().map(|row| row.1).collect() };
            (node, organs)
        };
        bearers.map(borne).collect()
    }

    /// The thinnest wood is as thick as a twig.
    fn scale_radii(&mut self) {
        let radii = self.nodes.iter().filter_map(|node| node.radius);
        let Some(thinnest) = radii.min_by(f32::total_cmp) else { return };
        for radius in self.nodes.iter_mut().filter_map(|node| node.radius.as_mut()) {
            let scaled = f64::from(*radius) / f64::from(thinnest) * self.options.twig_radius;
            *radius = scaled.min(THICKEST) as f32;
        }
    }

    /// Wood is born in a step of growth, and not before what it stands on.
    fn date(&mut self) {
        let later = u32::from(self.axiom_draws);
        for at in 0..self.nodes.len() {
            let own = match self.nodes[at].parent {
                Some(parent) => (self.nodes[at].birth + later).max(self.nodes[parent as usize].birth),
                None if at == 0 => 0,
                None => self.nodes[at].birth + later,
            };
            self.nodes[at].birth = own;
        }
    }

    /// Puts nodes into the order of their births.
    fn sort(&mut self) {
        if self.nodes.is_sorted_by_key(|node| node.birth) {
            return;
        }
        let mut order: Vec<u32> = (0..self.nodes.len() as u32).collect();
        order.sort_by_key(|&at| self.nodes[at as usize].birth);
        let mut places = vec![0u32; order.len()];
        for (place, &at) in (0..).zip(&order) {
            places[at as usize] = place;
        }
        let moved = |node: u32| places[node as usize];
        let node = |&at: &u32| {
            let node = self.nodes[at as usize];
            WoodNode { parent: node.parent.map(moved), ..node }
        };
        self.nodes = order.iter().map(node).collect();
        self.keys = order.iter().map(|&at| self.keys[at as usize]).collect();
        if let Some(modules) = &mut self.modules {
            *modules = order.iter().map(|&at| modules[at as usize]).collect();
        }
        for axis in &mut self.axes {
            axis.bearer = axis.bearer.map(moved);
        }
        for (bearer, _) in self.organs.iter_mut().flatten() {
            *bearer = moved(*bearer);
        }
    }
}

impl Pen for Carpenter {
    fn push(&mut self) -> Result<(), Stop> {
        self.fix(LEAST)?;
        self.levels.push(self.level);
        let Level { node, has_jumped, from, .. } = self.level;
        self.level = Level { node, has_jumped, from, ..Level::default() };
        Ok(())
    }

    fn pop(&mut self) -> Result<(), Stop> {
        self.end_axis()?;
        self.level = self.levels.pop().unwrap_or_default();
        Ok(())
    }

    fn draw(&mut self, turtle: &State, tag: Tag) -> Result<(), Stop> {
        self.level.apex = None;
        let radius = 0.5 * turtle.width * turtle.scale;
        self.level.loose = Some(Loose { tag, end: turtle.place, radius, module: self.module });
        let least = self.known.as_ref().map_or(SHORT, |known| known.least(tag));
        self.fix(least)?;
        self.lines += 1;
        self.joined += usize::from(self.level.loose.is_some());
        Ok(())
    }

    fn jump(&mut self, turtle: &State) -> Result<(), Stop> {
        self.fix(LEAST)?;
        self.level.loose = None;
        self.level.has_jumped = true;
        self.level.from = turtle.place;
        self.level.apex = None;
        Ok(())
    }

    fn apex(&mut self, turtle: &State) {
        self.level.apex = Some(turtle.heading);
    }

    fn cut(&mut self) {
        self.level.is_cut = true;
    }

    fn organ(&mut self, kind: OrganKind, stance: &Stance, length: Option<f64>) -> Result<(), Stop> {
        self.fix(LEAST)?;
        let heading = self.level.node.and_then(|node| {
            let WoodNode { parent, end, .. } = self.nodes[node as usize];
            Some((node, (end - self.nodes[parent? as usize].end).try_normalize()?))
        });
        let (Some((node, heading)), Some(organs)) = (heading, &mut self.organs) else {
            self.unborne += 1;
            return Ok(());
        };
        let length = length.filter(|length| *length > 0.0).map(|length| length as f32);
        organs.push((node, Organ::new(kind, heading, shortest_sides(heading), stance, length)));
        Ok(())
    }
}
