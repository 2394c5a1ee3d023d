//! The limbs of a plant by thickest heir, bearers first.

use std::{collections::VecDeque, ops::Range};

use espalier_plant::{Girth, MetamerId, Plant, Widths};
use glam::Vec3;

/// A limb has at least so many internodes; what is shorter is foliage.
const LEAST_INTERNODES: u32 = 2;
/// A limb that says something of itself has at least so many.
const LEAST_OF_SAYERS: usize = 4;
/// A child with a smaller share of the wood of a sibling is a stub, and continues nothing.
const STUB: f32 = 0.05;
/// Trunks part within this share of the length of the longest one.
const LOW: f32 = 0.05;
/// So many trunks make a stem end, each as thick and as long as such a share of the one that would go on.
const LEAST_TRUNKS: usize = 3;
const TRUNK: f32 = 0.5;
const TALL: f32 = 0.25;
/// Most limbs on one axis: a density has no more.
const MOST_LATERALS: usize = 60;

/// The living wood of one seed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wood {
    /// Nodes without the seed, each followed by all that stands on it.
    pub places: Vec<Vec3>,
    /// Limbs, bearers first, lower orders first; the stem is the first one.
    pub limbs: Vec<Limb>,
}

/// One limb.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Limb {
    /// The limb that bears it, and at which place of that one's line; none for the stem.
    pub bearer: Option<(usize, usize)>,
    /// Its order of branching.
    pub order: u8,
    /// Its base and its nodes.
    pub line: Vec<Vec3>,
    /// Length from the base to each place of the line.
    pub passed: Vec<f32>,
    /// Radius at each node.
    pub radii: Vec<f32>,
    /// Radius of what bears it, where it stands.
    pub bearer_radius: f32,
    /// Its nodes and all that stand on them.
    pub within: Range<usize>,
    /// Limbs that it bears, from its base to its tip.
    pub laterals: Vec<usize>,
    /// The share of it below each of its laterals, in order.
    pub places: Vec<f32>,
}

impl Limb {
    pub(super) fn base(&self) -> Vec3 {
        self.line[0]
    }

    /// From its base to its tip.
    pub(super) fn chord(&self) -> Vec3 {
        self.line[self.line.len() - 1] - self.line[0]
    }

    /// Its length along its course.
    pub(super) fn course(&self) -> f32 {
        self.passed[self.passed.len() - 1]
    }

    /// The share of its length below a place of its line.
    pub(super) fn share(&self, at: usize) -> f32 {
        self.passed[at] / self.course()
    }

    /// Where it goes below a place of its line.
    pub(super) fn heading(&self, at: usize) -> Vec3 {
        let to = at.max(1);
        (self.line[to] - self.line[to - 1]).normalize_or(Vec3::Y)
    }

    /// The place at a share of its length.
    pub(super) fn at(&self, share: f32) -> Vec3 {
        let wanted = share * self.course();
        let next = self.passed.partition_point(|&passed| passed < wanted).clamp(1, self.line.len() - 1);
        let (below, above) = (self.passed[next - 1], self.passed[next]);
        let within = if above > below { ((wanted - below) / (above - below)).clamp(0.0, 1.0) } else { 0.0 };
        self.line[next - 1].lerp(self.line[next], within)
    }

    /// Whether it is long enough to say something of itself.
    pub(super) fn says(&self) -> bool {
        self.radii.len() >= LEAST_OF_SAYERS
    }

    /// Nodes of it and of all that it bears.
    pub(super) fn size(&self) -> f32 {
        self.within.len() as f32
    }

    /// Ends it at its node that is farthest from its base: the way from base to tip is then as long as any in it.
    fn end_at_farthest(&mut self) {
        let base = self.base();
        let far = |at: &usize| self.line[*at].distance_squared(base);
        let farthest = (1..self.line.len()).max_by(|a, b| far(a).total_cmp(&far(b)));
        let end = farthest.unwrap_or(self.line.len() - 1);
        self.line.truncate(end + 1);
        self.passed.truncate(end + 1);
        self.radii.truncate(end);
    }
}

/// A limb that is still to be followed to its end.
struct Start {
    row: u32,
    bearer: Option<(usize, usize)>,
    order: u8,
}

impl Wood {
    /// The wood on a living seed, in limbs up to an order; none where there is no wood.
    pub(super) fn of(plant: &Plant, girth: &Girth, seed: MetamerId, orders: u8) -> Option<Self> {
        let rows = Rows::of(plant, girth, seed);
        let count = rows.all.len();
        let stem = rows.heirs[0]?;
        // Trunks that rise from one point are limbs of a stem that ends there, and what they bear may be as high as ever.
        let end = rows.parting(stem);
        let orders = orders + u8::from(end.is_some());
        let order = rows.preorder();
        let mut places = vec![Vec3::ZERO; count - 1];
        for row in 1..count {
            places[order[row] as usize - 1] = rows.place(row as u32);
        }
        let mut wood = Self { places, limbs: Vec::new() };
        let mut waiting = VecDeque::from([Start { row: stem, bearer: None, order: 0 }]);
        while let Some(start) = waiting.pop_front() {
            let number = wood.limbs.len();
            let (base, bearer_radius) = match start.bearer {
                None => (rows.place(0), 0.0),
                Some((bearer, at)) => {
                    let bearer = &wood.limbs[bearer];
                    (bearer.line[at], bearer.radii[at.saturating_sub(1)])
                }
            };
            let first = order[start.row as usize] as usize - 1;
            let size = rows.sizes[start.row as usize] as usize;
            let within = if start.order == 0 { 0..count - 1 } else { first..first + size };
            let mut limb = Limb {
                bearer: start.bearer,
                order: start.order,
                line: vec![base],
                passed: vec![0.0],
                radii: Vec::new(),
                bearer_radius,
                within,
                laterals: Vec::new(),
                places: Vec::new(),
            };
            // The stem begins at its seed, which may bear others.
            let mut chain = if start.order == 0 { vec![0] } else { Vec::new() };
            let mut next = Some(start.row);
            while let Some(row) = next {
                let (place, before) = (rows.place(row), limb.line[limb.line.len() - 1]);
                limb.passed.push(limb.course() + place.distance(before));
                limb.line.push(place);
                limb.radii.push(rows.widths.radius(rows.all[row as usize]));
                chain.push(row);
                next = rows.heirs[row as usize].filter(|_| end != Some(row));
            }
            limb.end_at_farthest();
            let offset = usize::from(start.order > 0);
            let mut starts: Vec<Start> = Vec::new();
            for (at, &row) in chain.iter().enumerate().map(|(at, row)| (at + offset, row)) {
                if at >= limb.line.len() {
                    break;
                }
                let heir = rows.heirs[row as usize].filter(|_| end != Some(row));
                let aside = rows.children(row).iter().filter(|&&child| heir != Some(child));
                for &child in aside {
                    if rows.chains[child as usize] >= LEAST_INTERNODES && start.order < orders {
                        let bearer = Some((number, at));
                        starts.push(Start { row: child, bearer, order: start.order + 1 });
                    }
                }
            }
            if starts.len() > MOST_LATERALS {
                let mut sizes: Vec<u32> = starts.iter().map(|start| rows.sizes[start.row as usize]).collect();
                sizes.sort_unstable_by(|a, b| b.cmp(a));
                let least = sizes[MOST_LATERALS - 1];
                starts.retain(|start| rows.sizes[start.row as usize] >= least);
                starts.truncate(MOST_LATERALS);
            }
            let at = |start: &Start| start.bearer.map_or(0.0, |(_, at)| limb.share(at));
            limb.places = starts.iter().map(at).collect();
            wood.limbs.push(limb);
            waiting.extend(starts);
        }
        for number in 1..wood.limbs.len() {
            if let Some((bearer, _)) = wood.limbs[number].bearer {
                wood.limbs[bearer].laterals.push(number);
            }
        }
        Some(wood)
    }
}

/// What stands on each row of a seed, itself the first one.
pub(super) struct Rows<'a> {
    plant: &'a Plant,
    pub widths: Widths<'a>,
    /// In order of birth.
    pub all: Vec<MetamerId>,
    /// Where the children of each begin.
    first: Vec<u32>,
    children: Vec<u32>,
    /// It and all that stands on it.
    sizes: Vec<u32>,
    /// The child that continues it.
    pub heirs: Vec<Option<u32>>,
    /// Internodes from it, its own included, to the end of what continues it.
    chains: Vec<u32>,
}

impl<'a> Rows<'a> {
    pub(super) fn of(plant: &'a Plant, girth: &'a Girth, seed: MetamerId) -> Self {
        const NONE: u32 = u32::MAX;
        let mut all = vec![seed];
        let mut parents = vec![NONE];
        let mut numbers = vec![NONE; plant.metamer_count()];
        numbers[seed.index()] = 0;
        // Parents stand before their children.
        for id in (seed.index() + 1..plant.metamer_count()).map(MetamerId::new) {
            let Some(parent) = plant.metamers().parent(id) else { continue };
            let parent = numbers[parent.index()];
            if parent != NONE && plant.is_alive(id) {
                numbers[id.index()] = all.len() as u32;
                all.push(id);
                parents.push(parent);
            }
        }
        let count = all.len();
        let mut first = vec![0u32; count + 1];
        for &parent in &parents[1..] {
            first[parent as usize + 1] += 1;
        }
        for row in 0..count {
            first[row + 1] += first[row];
        }
        let mut children = vec![0u32; count - 1];
        let mut next = first.clone();
        for (row, &parent) in parents.iter().enumerate().skip(1) {
            let at = &mut next[parent as usize];
            children[*at as usize] = row as u32;
            *at += 1;
        }
        let mut rows = Self {
            plant,
            widths: Widths::of(plant, girth),
            all,
            first,
            children,
            sizes: vec![1; count],
            heirs: vec![None; count],
            chains: vec![1; count],
        };
        for row in (0..count).rev() {
            rows.heirs[row] = rows.heir(row as u32);
            rows.chains[row] += rows.heirs[row].map_or(0, |heir| rows.chains[heir as usize]);
            if let Some(&parent) = parents.get(row).filter(|&&parent| parent != NONE) {
                rows.sizes[parent as usize] += rows.sizes[row];
            }
        }
        rows
    }

    pub(super) fn children(&self, row: u32) -> &[u32] {
        &self.children[self.first[row as usize] as usize..self.first[row as usize + 1] as usize]
    }

    pub(super) fn place(&self, row: u32) -> Vec3 {
        self.plant.metamers().end(self.all[row as usize])
    }

    /// Where the nodes of a limb and of what it bears stand, without those of its own axis below the first fork.
    pub(super) fn crown(&self, first: u32, axis: &[u32]) -> Vec<Vec3> {
        let bare = axis.iter().take_while(|&&row| self.children(row).len() == 1).count();
        let bare = &axis[..if bare == axis.len() { 0 } else { bare }];
        let mut nodes = Vec::with_capacity(self.sizes[first as usize] as usize);
        let mut waiting = vec![first];
        while let Some(row) = waiting.pop() {
            if bare.binary_search(&row).is_err() {
                nodes.push(self.place(row));
            }
            waiting.extend_from_slice(self.children(row));
        }
        nodes
    }

    /// The thickest child; of children as thick the one of the same axis, then the one that bears more.
    fn heir(&self, row: u32) -> Option<u32> {
        let children = self.children(row);
        let size = |child: u32| self.sizes[child as usize];
        let most = children.iter().map(|&child| size(child)).max()?;
        let axis = |row: u32| self.plant.metamers().axis(self.all[row as usize]);
        let rank = |child: u32| {
            let radius = self.widths.radius(self.all[child as usize]);
            (radius, axis(child) == axis(row), size(child))
        };
        let sound = children.iter().copied().filter(|&child| size(child) as f32 >= STUB * most as f32);
        sound.min_by(|&a, &b| {
            let (a, b) = (rank(a), rank(b));
            b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)).then(b.2.cmp(&a.2))
        })
    }

    /// The row low on a stem from which several trunks rise.
    fn parting(&self, stem: u32) -> Option<u32> {
        let low = (LOW * self.chains[stem as usize] as f32).max(1.0) as usize;
        let radius = |row: u32| self.widths.radius(self.all[row as usize]);
        let chain = |row: u32| self.chains[row as usize] as f32;
        let parts = |&row: &u32| {
            let Some(heir) = self.heirs[row as usize] else { return false };
            let is_trunk =
                |&&child: &&u32| radius(child) >= TRUNK * radius(heir) && chain(child) >= TALL * chain(heir);
            self.children(row).iter().filter(is_trunk).count() >= LEAST_TRUNKS
        };
        std::iter::successors(Some(stem), |&row| self.heirs[row as usize]).take(low).find(parts)
    }

    /// The number of each row when each is followed by all that stands on it.
    fn preorder(&self) -> Vec<u32> {
        let mut order = vec![0u32; self.all.len()];
        for row in 0..self.all.len() as u32 {
            let mut next = order[row as usize] + 1;
            for &child in self.children(row) {
                order[child as usize] = next;
                next += self.sizes[child as usize];
            }
        }
        order
    }
}
