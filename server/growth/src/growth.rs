//! Growth by competition for light and space: the generator of TreeSketch. What happens within a step stands in
//! `step.rs`.

use std::collections::BTreeMap;

use espalier_plant::{MetamerId, TimeShift};
use glam::Vec3;

use crate::{
    brush::StrokeId,
    canopy::Canopy,
    claims::Claims,
    enclosure::Enclosure,
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
    side_by_side::{Run, Work},
    state::SimulationState,
};

/// Metamers whose light and vigor are made those of the present after a change.
static SEEING: Work = Work::new(1 << 15);

/// Markers of an envelope per cubic internode, at least: with fewer a narrow neck may have a gap that no bud sees
/// across.
const LEAST_LASSO_DENSITY: f32 = 0.25;
/// Markers of an envelope at most.
const MAX_LASSO_MARKERS: usize = 4_000_000;
/// An envelope that would take more of the metamers that a scene may still hold is made flatter.
const WOOD_OVER_BUDGET: f32 = 0.25;

/// What growth knows beside the scene: what guides it, and what it keeps from one step to the next.
#[derive(Clone, Debug)]
pub struct Growth {
    pub(crate) seed: u32,
    pub(crate) parameters: ParameterTable,
    pub(crate) tick: u32,
    pub(crate) markers: Markers,
    pub(crate) guides: BTreeMap<StrokeId, Guide>,
    /// What is being grown into.
    pub(crate) enclosures: Vec<Enclosure>,
    /// Markers for growth without guidance; made when they are needed.
    pub(crate) field: Option<MarkerField>,
    pub(crate) canopy: Canopy,
    /// Whether the light of the present is still to be read: edits often follow each other before anybody needs it.
    pub(crate) is_blind: bool,
    pub(crate) claims: Claims,
    /// Steps after which, up to which, what was born is never shed.
    pub(crate) kept: Vec<(u32, u32)>,
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
            enclosures: state.enclosures,
            field: None,
            canopy: Canopy::default(),
            is_blind: false,
            claims: Claims::default(),
            kept: Vec::new(),
        };
        growth.see_all_light(scene);
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
        self.start_over();
    }

    /// From now on no axis is shed that began after the first and up to the second of any of these pairs of steps, nor
    /// what bears one. The pairs are in order and do not overlap.
    pub fn keep_what_began_in(&mut self, steps: Vec<(u32, u32)>) {
        self.kept = steps;
    }

    /// Forgets what guided growth so far: markers and strokes.
    pub fn drop_guidance(&mut self) {
        self.markers.remove_all();
        self.guides.clear();
        self.enclosures.clear();
    }

    pub(crate) fn enclose(&mut self, scene: &Scene, envelope: &Envelope) {
        let budget = scene.metamer_budget().saturating_sub(scene.plant.metamer_count() as u32);
        let wood = (budget as f32 * WOOD_OVER_BUDGET) as u32;
        let envelope = envelope.clone().filled_by(wood);
        let density = self.parameters().marker_density.max(LEAST_LASSO_DENSITY);
        // At least one: a speck of an envelope still says where to grow.
        let count = (envelope.marker_count(density).round() as usize).clamp(1, MAX_LASSO_MARKERS);
        // A second envelope in the same tick must not repeat the pattern of the first.
        let draw = Draw::new(self.seed, Purpose::Lasso, self.tick, self.enclosures.len() as u32);
        self.enclosures.push(Enclosure::new(envelope, count, draw, scene.plant.metamer_count()));
        self.sow_envelopes(scene);
    }

    /// Lays the markers of envelopes that growth has come near to.
    pub(crate) fn sow_envelopes(&mut self, scene: &Scene) {
        let Self { enclosures, markers, parameters, tick, .. } = self;
        for enclosure in enclosures {
            enclosure.sow(scene, parameters.farthest_perception(), |position| {
                markers.sow(Marker { position, born: *tick, source: MarkerSource::Lasso });
            });
        }
    }

    /// Whether an internode from one place to another takes its leaves out of the outlines it is in.
    pub(crate) fn leaves_outline(&self, base: Vec3, end: Vec3) -> bool {
        let is_held = |place| self.enclosures.iter().any(|one| one.envelope.holds_leaves(place));
        !is_held(end) && is_held(base)
    }

    /// How far apart nodes keep at a place in an envelope, where elsewhere it is `zone`.
    pub(crate) fn zone_at(&self, place: Vec3, zone: f32) -> f32 {
        self.enclosures.iter().filter_map(|one| one.envelope.zone_at(place)).fold(zone, f32::min)
    }

    pub(crate) fn drop_envelopes(&mut self) {
        self.markers.remove_lasso();
        self.enclosures.clear();
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

    /// The vigor that flows through a node for each tip above it, in no unit, as it was [looked at](Self::look) last; 0
    /// where no light comes from.
    pub fn vigor_at(&self, scene: &Scene, node: MetamerId) -> f32 {
        self.canopy.vigor_per_tip(&scene.plant, node)
    }

    /// The greatest vigor for each tip that any node has.
    pub fn greatest_vigor(&self, scene: &Scene) -> f32 {
        self.canopy.greatest_vigor(&scene.plant)
    }

    pub(crate) fn show(&mut self, scene: &mut Scene) {
        self.look(scene);
        self.canopy.write_conditions(scene, &self.parameters);
    }

    pub(crate) fn take_in(&mut self, scene: &Scene, change: &Change) {
        match change {
            Change::Edited => self.start_over(),
            Change::Travelled(shift) => self.travel(scene, shift),
        }
    }

    /// Forgets what follows from the scene.
    fn start_over(&mut self) {
        self.field = None;
        self.canopy.forget();
        self.is_blind = true;
    }

    /// Reads the light of the present and the vigor that follows from it, where that was put off.
    pub fn look(&mut self, scene: &Scene) {
        if self.is_blind {
            self.is_blind = false;
            self.see_all_light(scene);
        }
    }

    fn travel(&mut self, scene: &Scene, shift: &TimeShift) {
        self.drop_guidance();
        if shift.is_edited || self.is_blind {
            return self.start_over();
        }
        self.field = None;
        if !shift.metamers_out.is_empty() {
            self.canopy.retreat(&scene.plant, &self.parameters);
        }
        let gone = shift.metamers_out.iter().map(|&(_, place)| place);
        let came = shift.metamers_in.iter().map(|&id| scene.plant.metamers().end(id));
        let changed: Vec<Vec3> = gone.chain(came).collect();
        let run = SEEING.begin(scene.plant.living_count() as usize);
        self.see_light(scene, &changed, &mut NoObserver, &run);
        run.end();
    }

    /// Makes light and vigor those of the present, where shadows may have come or gone anywhere.
    fn see_all_light(&mut self, scene: &Scene) {
        let run = SEEING.begin(scene.plant.living_count() as usize);
        self.see_light(scene, &[], &mut NoObserver, &run);
        run.end();
    }

    /// Makes light and vigor those of the present, after shadows have come or gone at these nodes. Where the
    /// canopy was forgotten, everything is read.
    pub(crate) fn see_light(
        &mut self,
        scene: &Scene,
        changed: &[Vec3],
        observer: &mut impl Observer,
        run: &Run<'_>,
    ) {
        let Self { canopy, parameters, .. } = self;
        observer.enter(Phase::Light);
        canopy.follow(&scene.plant, parameters);
        canopy.read_light(scene, changed, parameters, run);
        observer.enter(Phase::Vigor);
        canopy.distribute_vigor(&scene.plant, parameters, run);
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
