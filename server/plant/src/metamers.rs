//! The columns of metamers.

use glam::Vec3;

use crate::{
    capacity::reserve,
    deaths::Deaths,
    given::{GivenOrgans, GivenRadii},
    id::{AxisId, MetamerId},
};

/// Light and vigor of a metamer: written by whatever grows the plant, read by whatever draws it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Condition {
    /// Light exposure, 0 dark to 255 full.
    pub light: u8,
    /// Vigor relative to the most vigorous bud, 0 to 255.
    pub vigor: u8,
}

impl Condition {
    /// Wood whose light has not been read yet is drawn as if in full light.
    pub(crate) const NEW: Self = Self { light: 255, vigor: 255 };
}

/// Metamers as parallel columns. The seed of each plant is a metamer without length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metamers {
    pub(crate) parent: Vec<MetamerId>,
    pub(crate) axis: Vec<AxisId>,
    pub(crate) death: Deaths,
    pub(crate) end: Vec<Vec3>,
    pub(crate) normal: Vec<Vec3>,
    pub(crate) tips: Vec<u32>,
    pub(crate) condition: Vec<Condition>,
    /// The first lateral axis at each node, if it bears any; the others follow it.
    pub(crate) lateral: Vec<AxisId>,
    /// Only rows of the present have any: edits keep those of futures.
    pub(crate) given_radius: GivenRadii,
    /// The same.
    pub(crate) given_organs: GivenOrgans,
}

/// One row of [`Metamers`], to append.
pub(crate) struct Row {
    pub parent: MetamerId,
    pub axis: AxisId,
    pub end: Vec3,
    pub normal: Vec3,
    /// The first of its laterals, which are to be laid down next.
    pub lateral: AxisId,
}

impl Metamers {
    pub(crate) fn push(&mut self, row: &Row) -> MetamerId {
        let id = MetamerId::new(self.parent.len());
        if self.parent.len() == self.parent.capacity() {
            self.reserve();
        }
        self.parent.push(row.parent);
        self.axis.push(row.axis);
        self.end.push(row.end);
        self.normal.push(row.normal);
        self.tips.push(0);
        self.condition.push(Condition::NEW);
        self.lateral.push(row.lateral);
        id
    }

    /// Reserves capacity for another row and more.
    #[cold]
    fn reserve(&mut self) {
        reserve(&mut self.parent, 1);
        reserve(&mut self.axis, 1);
        reserve(&mut self.end, 1);
        reserve(&mut self.normal, 1);
        reserve(&mut self.tips, 1);
        reserve(&mut self.condition, 1);
        reserve(&mut self.lateral, 1);
    }

    /// Cuts the columns off at a row and returns the rest.
    pub(crate) fn split_off(&mut self, at: usize) -> Self {
        Self {
            parent: self.parent.split_off(at),
            axis: self.axis.split_off(at),
            death: self.death.split_off(at),
            end: self.end.split_off(at),
            normal: self.normal.split_off(at),
            tips: self.tips.split_off(at),
            condition: self.condition.split_off(at),
            lateral: self.lateral.split_off(at),
            given_radius: GivenRadii::default(),
            given_organs: GivenOrgans::default(),
        }
    }

    /// Puts rows behind these.
    pub(crate) fn append(&mut self, mut more: Self) {
        self.death.append(self.parent.len(), more.death);
        self.parent.append(&mut more.parent);
        self.axis.append(&mut more.axis);
        self.end.append(&mut more.end);
        self.normal.append(&mut more.normal);
        self.tips.append(&mut more.tips);
        self.condition.append(&mut more.condition);
        self.lateral.append(&mut more.lateral);
    }

    /// The metamer this one grows from; none for a seed.
    pub fn parent(&self, id: MetamerId) -> Option<MetamerId> {
        self.parent[id.index()].some()
    }

    /// The axis this metamer belongs to.
    pub fn axis(&self, id: MetamerId) -> AxisId {
        self.axis[id.index()]
    }

    /// Where its node is; a seed's own place.
    pub fn end(&self, id: MetamerId) -> Vec3 {
        self.end[id.index()]
    }

    /// Unit vector across the metamer towards its node's first lateral bud.
    pub fn normal(&self, id: MetamerId) -> Vec3 {
        self.normal[id.index()]
    }

    /// Twig tips this metamer has ever carried, pruned ones taken off (see [`crate::girth`]).
    pub fn tips(&self, id: MetamerId) -> u32 {
        self.tips[id.index()]
    }

    /// Its light and vigor.
    pub fn condition(&self, id: MetamerId) -> Condition {
        self.condition[id.index()]
    }
}
