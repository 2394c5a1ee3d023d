//! An envelope while it is grown into: limbs lead through it, and markers are laid as growth comes near.

use std::sync::Arc;

use espalier_plant::{AxisId, MetamerId};
use glam::Vec3;

use crate::{
    brush::BrushSample,
    guide::Guide,
    lasso::{Envelope, Sowing},
    random::Draw,
    scene::Scene,
    selection::Selection,
};

/// An envelope that is grown into.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosure {
    pub(crate) envelope: Arc<Envelope>,
    /// What has grown for it has at least this id.
    pub(crate) first_born: MetamerId,
    /// Limbs that lead through it, those first that others begin on; none before the first step.
    pub(crate) limbs: Option<Vec<Guide>>,
    sowing: Sowing,
    /// Metamers near which markers have been laid.
    noticed: usize,
}

impl Enclosure {
    /// An envelope in which so many markers will lie, drawn beside a plant with so many metamers.
    pub(crate) fn new(envelope: Envelope, count: usize, draw: Draw, metamers: usize) -> Self {
        let sowing = Sowing::new(&envelope, count, draw);
        let first_born = MetamerId::new(metamers);
        Self { envelope: Arc::new(envelope), first_born, limbs: None, sowing, noticed: 0 }
    }

    /// Calls `lay` with the markers that a bud may perceive by now, within `reach` of it, above ground and beside obstacles.
    pub(crate) fn sow(&mut self, scene: &Scene, reach: f32, mut lay: impl FnMut(Vec3)) {
        let Scene { plant, obstacles, .. } = scene;
        for id in (self.noticed..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)) {
            self.sowing.come_near(&self.envelope, plant.metamers().end(id), reach, |place| {
                if place.y > 0.0 && !obstacles.contains(place) {
                    lay(place);
                }
            });
        }
        self.noticed = plant.metamer_count();
    }

    /// Lays limbs through the envelope, the first from the bud that is nearest to it, if that is not done.
    pub(crate) fn lead(&mut self, scene: &Scene, selection: &Selection, zone: f32) -> &mut Vec<Guide> {
        let Self { envelope, limbs, .. } = self;
        limbs.get_or_insert_with(|| limbs_through(envelope, scene, selection, zone))
    }
}

fn limbs_through(envelope: &Envelope, scene: &Scene, selection: &Selection, zone: f32) -> Vec<Guide> {
    let Scene { plant, space, obstacles, .. } = scene;
    let axes = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| selection.includes(axis));
    let buds = axes.filter_map(|axis| space.bud(axis).map(|bud| bud.position));
    let away = |&bud: &Vec3| if envelope.contains(bud) { -1.0 } else { envelope.distance_to_box(bud) };
    let Some(nearest) = buds.min_by(|a, b| away(a).total_cmp(&away(b))) else { return Vec::new() };
    let lead = |places: Vec<_>| {
        let mut limb = Guide::new(plant.metamer_count());
        let free = places.into_iter().filter(|place: &BrushSample| !obstacles.contains(place.position));
        free.for_each(|place| limb.follow(place, zone));
        limb
    };
    envelope.limbs(nearest).into_iter().map(lead).collect()
}
