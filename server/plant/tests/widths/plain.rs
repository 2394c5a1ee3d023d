//! Widths as they are defined: every metamer asks for all leaves above it, each exponent is found by halving.

use espalier_plant::{MetamerId, Plant};

pub struct Plain<'a> {
    plant: &'a Plant,
    wanted: &'a [(MetamerId, f32)],
    exponent: f64,
    twig: f64,
    children: Vec<Vec<MetamerId>>,
}

impl<'a> Plain<'a> {
    pub fn new(plant: &'a Plant, wanted: &'a [(MetamerId, f32)], exponent: f64, twig: f64) -> Self {
        let mut children = vec![Vec::new(); plant.metamer_count()];
        for id in (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)) {
            if let Some(parent) = plant.metamers().parent(id) {
                children[parent.index()].push(id);
            }
        }
        Self { plant, wanted, exponent, twig, children }
    }

    fn wish(&self, id: MetamerId) -> Option<f64> {
        self.wanted.iter().find(|&&(of, _)| of == id).map(|&(_, wanted)| f64::from(wanted))
    }

    /// The diameter given to a metamer that nothing constrains.
    fn given(&self, id: MetamerId) -> Option<f64> {
        self.plant.given_radius(id).filter(|_| self.wish(id).is_none()).map(|radius| 2.0 * f64::from(radius))
    }

    /// Diameters of all leaves above a metamer in its subtree.
    fn leaves(&self, id: MetamerId) -> Vec<f64> {
        let children = &self.children[id.index()];
        let tips = |id| self.plant.metamers().tips(id);
        let own = tips(id) - children.iter().map(|&child| tips(child)).sum::<u32>();
        let mut leaves = vec![self.twig; own as usize];
        for &child in children {
            match self.effective(child).or_else(|| self.given(child)) {
                Some(diameter) => leaves.push(diameter),
                None => leaves.extend(self.leaves(child)),
            }
        }
        leaves
    }

    /// The diameter that a constrained metamer has.
    pub fn effective(&self, id: MetamerId) -> Option<f64> {
        self.wish(id).map(|wanted| self.leaves(id).into_iter().fold(wanted.max(self.twig), f64::max))
    }

    pub fn diameter(&self, id: MetamerId) -> f64 {
        if let Some(diameter) = self.effective(id).or_else(|| self.given(id)) {
            return diameter;
        }
        let leaves = self.leaves(id);
        let mut path = vec![id];
        while let Some(below) =
            self.plant.metamers().parent(path[path.len() - 1]).filter(|&b| !self.plant.is_seed(b))
        {
            path.push(below);
            if self.given(below).is_some() {
                break;
            }
            if let Some(diameter) = self.effective(below) {
                return self.between(&leaves, &self.leaves(below), diameter, &path);
            }
        }
        summed(&leaves, self.exponent)
    }

    /// The diameter over some leaves in a subtree with a root of a given diameter at the end of a path.
    fn between(&self, leaves: &[f64], all: &[f64], root: f64, path: &[MetamerId]) -> f64 {
        if all.len() == 1 || summed(all, 1.0) < root {
            let above = self.height(path[0]);
            let rise = above / (above + path.windows(2).map(|pair| self.length(pair[0])).sum::<f64>());
            summed(leaves, 1.0) * (root / summed(all, 1.0)).powf(rise)
        } else if exceeds(all, root, 8.0) {
            summed(leaves, 8.0).min(root)
        } else {
            let (mut low, mut high) = (1.0, 8.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if exceeds(all, root, middle) { low = middle } else { high = middle }
            }
            summed(leaves, low)
        }
    }

    fn length(&self, id: MetamerId) -> f64 {
        let end = |id| self.plant.metamers().end(id);
        self.plant.metamers().parent(id).map_or(0.0, |parent| f64::from(end(id).distance(end(parent))))
    }

    /// Length of the wood from a metamer's node to the farthest leaf.
    fn height(&self, id: MetamerId) -> f64 {
        let further = |&child: &MetamerId| {
            self.length(child)
                + if self.wish(child).or(self.given(child)).is_some() { 0.0 } else { self.height(child) }
        };
        self.children[id.index()].iter().map(further).fold(0.0, f64::max)
    }
}

fn summed(leaves: &[f64], exponent: f64) -> f64 {
    let thickest = leaves.iter().copied().fold(0.0, f64::max);
    let sum: f64 = leaves.iter().map(|leaf| (leaf / thickest).powf(exponent)).sum();
    thickest * sum.powf(1.0 / exponent)
}

/// Whether leaves are together thicker than a root. The thickest is set against the root first, for beside it others
/// may be too small to be seen in the sum.
fn exceeds(leaves: &[f64], root: f64, exponent: f64) -> bool {
    let mut ratios: Vec<f64> = leaves.iter().map(|leaf| leaf / root).collect();
    ratios.sort_by(f64::total_cmp);
    let thickest = ratios.pop().unwrap_or_default();
    ratios.iter().map(|ratio| ratio.powf(exponent)).sum::<f64>() > -(exponent * thickest.ln()).exp_m1()
}
