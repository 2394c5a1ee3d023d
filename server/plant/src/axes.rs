//! The columns of axes.

use glam::Vec3;

use crate::{
    capacity::reserve,
    deaths::Deaths,
    id::{AxisId, MetamerId},
};

/// Axes as parallel columns; each is the bud at its tip and the metamers behind it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axes {
    pub(crate) bearer: Vec<MetamerId>,
    pub(crate) first: Vec<MetamerId>,
    pub(crate) last: Vec<MetamerId>,
    pub(crate) direction: Vec<Vec3>,
    pub(crate) order: Vec<u16>,
    pub(crate) death: Deaths,
}

impl Axes {
    pub(crate) fn push(&mut self, bearer: MetamerId, direction: Vec3, order: u32) -> AxisId {
        let id = AxisId::new(self.bearer.len());
        if self.bearer.len() == self.bearer.capacity() {
            self.reserve();
        }
        self.bearer.push(bearer);
        self.first.push(MetamerId::NONE);
        self.last.push(MetamerId::NONE);
        self.direction.push(direction);
        self.order.push(stored_order(order));
        id
    }

    /// Reserves capacity for another row and more.
    #[cold]
    fn reserve(&mut self) {
        reserve(&mut self.bearer, 1);
        reserve(&mut self.first, 1);
        reserve(&mut self.last, 1);
        reserve(&mut self.direction, 1);
        reserve(&mut self.order, 1);
    }

    /// The axis that will be laid down next.
    pub(crate) fn next(&self) -> AxisId {
        AxisId::new(self.bearer.len())
    }

    /// Cuts the columns off at a row and returns the rest.
    pub(crate) fn split_off(&mut self, at: usize) -> Self {
        Self {
            bearer: self.bearer.split_off(at),
            first: self.first.split_off(at),
            last: self.last.split_off(at),
            direction: self.direction.split_off(at),
            order: self.order.split_off(at),
            death: self.death.split_off(at),
        }
    }

    /// Puts rows behind these.
    pub(crate) fn append(&mut self, mut more: Self) {
        self.death.append(self.bearer.len(), more.death);
        self.bearer.append(&mut more.bearer);
        self.first.append(&mut more.first);
        self.last.append(&mut more.last);
        self.direction.append(&mut more.direction);
        self.order.append(&mut more.order);
    }

    /// The metamer whose node bears this axis; none for a trunk, which begins with its seed.
    pub fn bearer(&self, id: AxisId) -> Option<MetamerId> {
        self.bearer[id.index()].some()
    }

    /// Its first metamer (a trunk's is its seed); none while it is a bud.
    pub fn first(&self, id: AxisId) -> Option<MetamerId> {
        self.first[id.index()].some()
    }

    /// The metamer at its tip; none while it is a bud.
    pub fn last(&self, id: AxisId) -> Option<MetamerId> {
        self.last[id.index()].some()
    }

    /// Unit direction in which the bud was laid down.
    pub fn direction(&self, id: AxisId) -> Vec3 {
        self.direction[id.index()]
    }

    /// Branching order: 0 for trunks.
    pub fn order(&self, id: AxisId) -> u32 {
        u32::from(self.order[id.index()])
    }
}

/// An order as the column holds it; higher ones than it can hold are all the same.
pub(crate) fn stored_order(order: u32) -> u16 {
    u16::try_from(order).unwrap_or(u16::MAX)
}
