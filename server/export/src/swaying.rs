//! What files say of how plants sway: bones, clips, and which vertices go along with which row.

use std::{collections::BTreeMap, sync::Arc};

use espalier_growth::{Obstacle, Shape};
use espalier_mesh::{Body, RingTable, Style};
use espalier_motion::{
    Bone, Joints, Limbs, Rig, Rows, Scale, Weather, Wood,
    clips::{Clip, Conditions, blow, clips, reaches},
    flutter::Air,
    loads::{self, Loading},
    shelter::{Form, Solid, Triangles},
};
use espalier_plant::{MetamerId, Plant};
use espalier_settings::looks::{GUST_SEED, WindLook};
use glam::{DQuat, DVec3, DVec4, Quat, Vec3};

use crate::{ExportError, Sink};

/// The wind that moves files of trees that stand in a calm, m/s.
const BREEZE: f32 = 4.0;
/// The most bones of a scene through whose gust bodies are stepped; they take some two seconds. In larger scenes each joint
/// goes on answering by itself.
const MOST_BODIES: usize = 2048;

/// The row that a vertex goes along with, and where between the node below and its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rider {
    pub row: u32,
    pub share: f32,
    /// How much it flutters besides: 1 at the tips of leaves, 0 where they hang and on wood.
    pub flutter: f32,
}

/// How a bone stands on the one below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Local {
    /// Its turn against that one's, of the two that are the same the nearer one, so that keys blend the short way.
    pub turn: DQuat,
    /// Its place as that one has turned, m.
    pub place: DVec3,
}

/// The joints of all plants of a scene, and how they move.
pub(crate) struct Swaying {
    pub limbs: Limbs,
    pub wood: Wood,
    pub joints: Joints,
    pub clips: [Clip; 2],
    conditions: Conditions,
    reach: Vec<f64>,
}

impl Swaying {
    /// In the wind of a look, among obstacles and under what the look says lies on plants; in a calm, in a breeze. `metres` is
    /// the length of an internode.
    pub(crate) fn of(
        plant: &Plant,
        style: &Style,
        look: &WindLook,
        metres: f32,
        around: &[Obstacle],
    ) -> Self {
        let grown = Grown::of(plant, style, look, metres);
        let conditions = grown.conditions(look, metres, around);
        let Grown { limbs, wood, joints, .. } = grown;
        let clips = clips(&joints, &wood, &conditions);
        let reach = reaches(&clips, joints.all().len());
        Self { limbs, wood, joints, clips, conditions, reach }
    }

    /// The same with the gust of jointed bodies, one for each piece between the bones that the plants' files will have.
    ///
    /// # Errors
    /// Where the file is given up meanwhile.
    pub(crate) fn blown(mut self, plant: &Plant, most: u32, out: &mut dyn Sink) -> Result<Self, ExportError> {
        let is_standing = |&id: &MetamerId| plant.is_seed(id) && plant.is_alive(id);
        let seeds = (0..plant.metamer_count()).map(MetamerId::new).filter(is_standing);
        let rigs: Vec<Rig> = seeds.map(|seed| self.rig(seed, most)).collect();
        if rigs.iter().map(|rig| rig.bones().len()).sum::<usize>() > MOST_BODIES {
            return Ok(self);
        }
        let Self { limbs, wood, joints, conditions, clips: [_, gust], .. } = &mut self;
        blow(gust, &rigs, (joints, limbs, wood), conditions, || Ok::<(), ExportError>(out.flush()?))?;
        Ok(self)
    }

    /// How all joints rest under what lies on plants when no wind blows.
    pub(crate) fn rest(&self) -> &[DVec3] {
        let [_, gust] = &self.clips;
        gust.keys.first().map_or(&[], Vec::as_slice)
    }

    /// The air in its loop.
    pub(crate) fn air(&self) -> Air {
        self.conditions.air((&self.joints, &self.limbs, &self.wood))
    }

    /// At most so many bones for the plant of a seed.
    pub(crate) fn rig(&self, seed: MetamerId, most: u32) -> Rig {
        let Self { limbs, wood, joints, reach, .. } = self;
        Rig::of(joints, limbs, wood, seed.raw(), reach, most as usize)
    }

    /// How all bones of a rig stand on those below them at a key of a clip; the first stands on nothing.
    pub(crate) fn locals(&self, rig: &Rig, key: &[DVec3]) -> Vec<Local> {
        let nodes = rig.stand(&self.joints, &self.wood, key);
        let of = |(number, bone): (usize, &Bone)| {
            let own = nodes[number];
            let Some(parent) = bone.parent else { return Local { turn: own.turn, place: own.place } };
            let below = nodes[parent as usize];
            let back = below.turn.inverse();
            let turn = (back * own.turn).normalize();
            let turn = if turn.w < 0.0 { DQuat::from_vec4(-DVec4::from(turn)) } else { turn };
            Local { turn, place: back * (own.place - below.place) }
        };
        rig.bones().iter().enumerate().map(of).collect()
    }

    /// For each vertex of a body what it goes along with.
    pub(crate) fn along(&self, body: &Body<'_>, vertices: &[Vec3]) -> Vec<Rider> {
        let nodes: Vec<Vec3> = body.nodes().collect();
        let ways = nodes.windows(2).map(|pair| (pair[0], pair[1] - pair[0]));
        let pieces: Vec<(u32, Vec3, Vec3)> =
            body.metamers().iter().zip(ways).map(|(id, (from, way))| (id.raw(), from, way)).collect();
        let nearest = |vertex: &Vec3| {
            let mut best = (f32::INFINITY, Rider { row: 0, share: 0.0, flutter: 0.0 });
            for &(row, from, way) in &pieces {
                let squared = way.length_squared();
                let share =
                    if squared > 0.0 { ((*vertex - from).dot(way) / squared).clamp(0.0, 1.0) } else { 1.0 };
                let away = (from + share * way).distance_squared(*vertex);
                if away < best.0 {
                    best = (away, Rider { row, share, flutter: 0.0 });
                }
            }
            best.1
        };
        vertices.iter().map(nearest).collect()
    }
}

/// Limbs, wood and joints of all plants of a scene.
pub(crate) struct Grown {
    limbs: Limbs,
    pub wood: Wood,
    pub joints: Joints,
    /// How each joint turns under what lies on plants.
    pub loads: Vec<DVec3>,
}

impl Grown {
    pub(crate) fn of(plant: &Plant, style: &Style, look: &WindLook, metres: f32) -> Self {
        let mut table = RingTable::new();
        table.sync(plant, style, 1);
        let leaf_size = f64::from(style.options().leaf_size);
        let scale = Scale { internode_length: f64::from(metres), leaf_size };
        let rows = Rows::of(&table);
        let (limbs, wood, joints) = Joints::grown(&rows, &scale, f64::from(look.suppleness));
        let [sag, snow, rain] = [look.sag, look.snow, look.rain].map(f64::from);
        let loads = loads::turns(&rows, &limbs, &wood, &joints, &scale, &Loading { sag, snow, rain });
        Self { limbs, wood, joints: joints.damped(f64::from(look.damping)), loads }
    }

    /// What moves them.
    pub(crate) fn conditions(&self, look: &WindLook, metres: f32, around: &[Obstacle]) -> Conditions {
        Conditions::new(&self.wood, weather(look), &solids(around, metres), self.loads.clone())
    }
}

/// Obstacles as the wind meets them. The half-space behind a plane is land, and shelters nothing.
fn solids(around: &[Obstacle], metres: f32) -> Vec<Solid> {
    // Many obstacles may be of one mesh.
    let mut meshes: BTreeMap<usize, Arc<Triangles>> = BTreeMap::new();
    let solid = |obstacle: &Obstacle| {
        let (form, place, turn) = match obstacle.shape() {
            Shape::Box { centre, half_extents, rotation } => {
                (Form::Box(half_extents.as_dvec3()), *centre, *rotation)
            }
            Shape::Sphere { centre, radius } => (Form::Ball(f64::from(*radius)), *centre, Quat::IDENTITY),
            Shape::Plane { .. } => return None,
            Shape::Mesh { mesh, position, rotation } => {
                let corner = |number: u32| mesh.vertices()[number as usize];
                let triangles = || {
                    let corners = mesh.triangles().iter().map(|corners| corners.map(corner));
                    Arc::new(Triangles::new(corners))
                };
                let triangles = meshes.entry(Arc::as_ptr(mesh) as usize).or_insert_with(triangles);
                (Form::Mesh(Arc::clone(triangles)), *position, *rotation)
            }
        };
        Solid::new(form, place.as_dvec3(), turn.as_dquat(), f64::from(metres))
    };
    around.iter().filter_map(solid).collect()
}

/// The wind of a look; in a calm, a breeze.
fn weather(look: &WindLook) -> Weather {
    let is_calm = look.speed == 0.0 && look.rise == 0.0;
    let speed = f64::from(if is_calm { BREEZE } else { look.speed });
    let blows = [speed, f64::from(look.direction), f64::from(look.rise)];
    Weather::blowing(blows, f64::from(look.turbulence), GUST_SEED)
}
