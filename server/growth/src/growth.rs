//! Growth by competition for light and space: the generator of TreeSketch. What happens within a step stands in
//! `step.rs`.

use std::collections::BTreeMap;

use espalier_plant::TimeShift;
use glam::Vec3;

use crate::{
    brush::StrokeId,
    canopy::{Canopy, Surroundings},
    claims::Claims,
    field::MarkerField,
    generator::Change,
    guide::Guide,
    lasso::Envelope,
    markers::{Marker, MarkerSource, Markers},
    observer::{NoObserver, Observer, Phase},
    parameter_table::ParameterTable,
    parameters::Parameters,
    random::{Draw, Purpose},
    scene::Scene,
    state::SimulationState,
};

/// Markers of an envelope per cubic internode, at least: with fewer a narrow neck may have a gap that no bud sees
/// across.
const LEAST_LASSO_DENSITY: f32 = 0.25;
/// Lasso markers a scene holds at most; a larger envelope is filled more thinly.
const MAX_LASSO_MARKERS: usize = 200_000;

/// What growth knows beside the scene: what guides it, and what it keeps from one step to the next.
#[derive(Clone, Debug)]
pub struct Growth {
    pub(crate) seed: u32,
    pub(crate) parameters: ParameterTable,
    pub(crate) tick: u32,
    pub(crate) markers: Markers,
    pub(crate) guides: BTreeMap<StrokeId, Guide>,
    /// Markers for growth without guidance; made when they are needed.
    pub(crate) field: Option<MarkerField>,
    pub(crate) canopy: Canopy,
    pub(crate) claims: Claims,
}

impl Growth {
    /// Growth as it was; what concerns the scene is in the scene.
    pub(crate) fn from_state(scene: &Scene, state: SimulationState) -> Self {
        let mut growth = Self {
            seed: state.seed,
            parameters: ParameterTable::new(state.parameters),
            tick: state.tick,
            markers: Markers::from_vec(state.markers),
            guides: state.guides,
            field: None,
            canopy: Canopy::default(),
            claims: Claims::default(),
        };
        growth.see_light(scene, &[], &mut NoObserver);
        growth
    }

    /// The parameters in force.
    pub fn parameters(&self) -> &Parameters {
        self.parameters.scene()
    }

    pub(crate) fn markers(&self) -> &[Marker] {
        self.markers.as_slice()
    }

    /// Changes the parameters; growth from here on uses them.
    pub fn set_parameters(&mut self, scene: &mut Scene, parameters: Parameters) {
        let same_shadows = self.parameters().casts_like(&parameters);
        self.parameters = ParameterTable::new(parameters);
        if !same_shadows {
            scene.rebuild(self.parameters.scene());
        }
        self.start_over(scene);
    }

    /// Forgets what guided growth so far: markers and strokes.
    pub fn drop_guidance(&mut self) {
        self.markers.remove_all();
        self.guides.clear();
    }

    pub(crate) fn enclose(&mut self, scene: &Scene, envelope: &Envelope) {
        let density = self.parameters().marker_density.max(LEAST_LASSO_DENSITY);
        let wanted = envelope.volume() * f64::from(density);
        let room = MAX_LASSO_MARKERS.saturating_sub(self.markers.count(MarkerSource::Lasso));
        // At least one: a speck of an envelope still says where to grow.
        let count = (wanted.round() as usize).max(1).min(room);
        if count == 0 {
            return;
        }
        // A second envelope in the same tick must not repeat the pattern of the first.
        let draw = Draw::new(self.seed, Purpose::Lasso, self.tick, self.markers.as_slice().len() as u32);
        for position in envelope.places(count, draw) {
            if position.y > 0.0 && !scene.obstacles.contains(position) {
                let marker = Marker { position, born: self.tick, source: MarkerSource::Lasso };
                self.markers.sow(marker);
            }
        }
    }

    pub(crate) fn drop_envelopes(&mut self) {
        self.markers.remove(MarkerSource::Lasso);
    }

    /// The strokes that guide growth.
    pub fn strokes(&self) -> impl Iterator<Item = StrokeId> + '_ {
        self.guides.keys().copied()
    }

    /// What guides growth along a stroke.
    pub fn guide(&self, stroke: StrokeId) -> Option<&Guide> {
        self.guides.get(&stroke)
    }

    /// Forgets the path of one stroke.
    pub fn end_stroke(&mut self, stroke: StrokeId) {
        self.guides.remove(&stroke);
    }

    /// Whether there is anything for a bud to grow towards: markers, path ahead of a leader, or a stroke that waits for
    /// one.
    pub fn has_guidance(&self, scene: &Scene) -> bool {
        let is_led = |guide: &Guide| {
            guide.leader.is_some_and(|leader| guide.is_ahead(scene.plant.bud_position(leader)))
        };
        !self.markers.as_slice().is_empty()
            || self.guides.values().any(|guide| guide.is_waiting() || is_led(guide))
    }

    pub(crate) fn show(&mut self, scene: &mut Scene) {
        self.canopy.write_conditions(&mut scene.plant);
    }

    pub(crate) fn take_in(&mut self, scene: &Scene, change: &Change) {
        match change {
            Change::Edited => self.start_over(scene),
            Change::Travelled(shift) => self.travel(scene, shift),
        }
    }

    /// Forgets what follows from the scene, and reads the light of the present.
    fn start_over(&mut self, scene: &Scene) {
        self.field = None;
        self.canopy.forget();
        self.see_light(scene, &[], &mut NoObserver);
    }

    fn travel(&mut self, scene: &Scene, shift: &TimeShift) {
        self.drop_guidance();
        self.field = None;
        if shift.is_edited {
            self.canopy.forget();
        } else if !shift.metamers_out.is_empty() {
            self.canopy.retreat(&scene.plant, &self.parameters);
        }
        let gone = shift.metamers_out.iter().map(|&(_, place)| place);
        let came = shift.metamers_in.iter().map(|&id| scene.plant.metamers().end(id));
        let changed: Vec<Vec3> = gone.chain(came).collect();
        self.see_light(scene, &changed, &mut NoObserver);
    }

    /// Makes light and vigor those of the present, after shadows have come or gone at these nodes. Where the
    /// canopy was forgotten, everything is read.
    pub(crate) fn see_light(&mut self, scene: &Scene, changed: &[Vec3], observer: &mut impl Observer) {
        let Self { canopy, parameters, .. } = self;
        let Scene { plant, space, shadows, obstacles, .. } = scene;
        observer.enter(Phase::Light);
        canopy.follow(plant, parameters);
        canopy.read_light(&Surroundings { plant, space, shadows, obstacles }, changed);
        observer.enter(Phase::Vigor);
        canopy.distribute_vigor(plant, parameters);
    }
}

impl AsRef<Self> for Growth {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl AsMut<Self> for Growth {
    fn as_mut(&mut self) -> &mut Self {
        self
    }
}
