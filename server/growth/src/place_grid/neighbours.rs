//! The cells that a short radius reaches from a place: its own, and along each axis the nearer one beside it.

use glam::Vec3;

/// Such cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neighbours {
    /// The squared radius.
    limit: f32,
    /// Along each axis the place's own cell and the one beside it, each with the squared gap to it.
    axes: [[(i32, f32); 2]; 3],
}

impl Neighbours {
    /// The longest radius that reaches no farther, in edges of a cell: a hair less than half, against rounding.
    pub(super) const LONGEST: f32 = 0.49;

    /// Those around a place in this cell.
    #[inline(always)]
    pub(super) fn new(place: Vec3, own: [i32; 3], edge: f32, radius: f32) -> Self {
        let low = Vec3::from_array(own.map(|cell| cell as f32)) * edge;
        let (below, above) = (place - low, low + edge - place);
        let is_below = below.cmplt(above);
        let gaps = Vec3::select(is_below, below, above).max(Vec3::ZERO);
        // A hair less than it is, for the gap itself is rounded.
        let gaps = (gaps * gaps * 0.9999).to_array();
        let axes = core::array::from_fn(|axis| {
            let beside = own[axis] + if is_below.test(axis) { -1 } else { 1 };
            [(own[axis], 0.0), (beside, gaps[axis])]
        });
        Self { limit: radius * radius, axes }
    }

    /// A cell such that those in reach lie between it and the place's own.
    #[inline(always)]
    pub(super) fn corner(&self) -> [i32; 3] {
        self.axes.map(|[own, beside]| if beside.1 <= self.limit { beside.0 } else { own.0 })
    }

    /// All eight cells, each with whether it is in reach; the place's own comes last.
    #[inline(always)]
    pub(super) fn cells(&self) -> impl Iterator<Item = ([i32; 3], bool)> {
        let Self { limit, axes: [x, y, z] } = *self;
        (0..8).rev().map(move |corner| {
            let (x, y, z) = (x[corner & 1], y[corner >> 1 & 1], z[corner >> 2]);
            ([x.0, y.0, z.0], x.1 + y.1 + z.1 <= limit)
        })
    }
}
