//! What files say of how plants sway: bones, clips, and which vertices go along with which row.

use espalier_mesh::{Body, RingTable, Style};
use espalier_motion::{
    Bone, Joints, Limbs, Rig, Rows, Scale, Weather, Wood,
    clips::{Clip, blow, clips, reaches},
};
use espalier_plant::{MetamerId, Plant};
use espalier_settings::looks::WindLook;
use glam::{DQuat, DVec3, DVec4, Vec3};

/// The wind that moves files of trees that stand in a calm, m/s.
const BREEZE: f32 = 4.0;
/// The most bones of a scene through whose gust bodies are stepped; they take some two seconds.
const MOST_BODIES: usize = 2048;
/// Which gusts come: those that clients draw.
const SEED: u32 = 7;

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
    /// How much leaves flutter, 0 to 1: in a breeze of 6 m/s and more all of it.
    pub stir: f32,
    reach: Vec<f64>,
}

impl Swaying {
    /// In the wind of a look; in a calm, in a breeze. `metres` is the length of an internode.
    pub(crate) fn of(plant: &Plant, style: &Style, look: &WindLook, metres: f32) -> Self {
        let (limbs, wood, joints) = grown(plant, style, look, metres);
        let clips = clips(&joints, &wood, &weather(look));
        let reach = reaches(&clips, joints.all().len());
        let stir = (weather(look).velocity.length() / 6.0).min(1.0) as f32 * look.flutter;
        Self { limbs, wood, joints, clips, stir, reach }
    }

    /// The same with the gust of jointed bodies, one for each piece between the bones that the plants' files will have. In
    /// scenes with very many each joint goes on answering by itself: nothing can stop bodies once they are on their way.
    pub(crate) fn blown(mut self, plant: &Plant, look: &WindLook, most: u32) -> Self {
        let is_standing = |&id: &MetamerId| plant.is_seed(id) && plant.is_alive(id);
        let seeds = (0..plant.metamer_count()).map(MetamerId::new).filter(is_standing);
        let rigs: Vec<Rig> = seeds.map(|seed| self.rig(seed, most)).collect();
        if rigs.iter().map(|rig| rig.bones().len()).sum::<usize>() > MOST_BODIES {
            return self;
        }
        let Self { limbs, wood, joints, clips: [_, gust], .. } = &mut self;
        blow(gust, &rigs, joints, limbs, wood, &weather(look));
        self
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
pub(crate) fn grown(plant: &Plant, style: &Style, look: &WindLook, metres: f32) -> (Limbs, Wood, Joints) {
    let mut table = RingTable::new();
    table.sync(plant, style, 1);
    let leaf_size = f64::from(style.options().leaf_size);
    let scale = Scale { internode_length: f64::from(metres), leaf_size };
    let (limbs, wood, joints) = Joints::grown(&Rows::of(&table), &scale, f64::from(look.suppleness));
    (limbs, wood, joints.damped(f64::from(look.damping)))
}

/// The wind of a look; in a calm, a breeze.
fn weather(look: &WindLook) -> Weather {
    let is_calm = look.speed == 0.0 && look.rise == 0.0;
    let speed = f64::from(if is_calm { BREEZE } else { look.speed });
    let (sin, cos) = libm::sincos(f64::from(look.direction).to_radians());
    let velocity = DVec3::new(speed * cos, f64::from(look.rise), speed * sin);
    Weather { velocity, turbulence: f64::from(look.turbulence), seed: SEED }
}
