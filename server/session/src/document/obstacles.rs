//! The obstacles of a document: placed, moved, reshaped, removed, by one gesture as one operation.

use std::{collections::BTreeMap, sync::Arc};

use espalier_growth::Obstacle as Solid;
use espalier_plant::hash::StableHash;
use espalier_proto::{
    Obstacle as WireObstacle, PlacedObstacle, Pose, Problem, Reason, SimpleShape, version::MAX_OBSTACLES,
};

use super::{
    Document,
    history::{Kind, Setting},
};
use crate::{
    cause::Cause,
    obstacle::{Form, Mesh, Obstacle, Standing},
};

/// All obstacles at one time, in order of their ids.
pub(super) type Standings = Arc<Vec<Standing>>;

/// Triangles of all meshes that the scene or an operation holds on to; undo needs them (`LM6`).
pub(super) const MAX_HELD_TRIANGLES: usize = 1_000_000;

/// The obstacles in the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Obstacles {
    pub standing: Standings,
    /// Obstacles ever placed: names the next one.
    pub placed: u32,
}

impl Obstacles {
    /// The obstacles as growth sees them.
    pub fn solids(standing: &Standings) -> Vec<Solid> {
        // Each was tried when it was placed, so none is left out.
        standing.iter().filter_map(|standing| standing.obstacle.solid().ok()).collect()
    }

    pub fn hash(&self, hash: &mut StableHash) {
        hash.word(u64::from(self.placed));
        for standing in &*self.standing {
            let text = serde_json::to_vec(&standing.to_proto()).unwrap_or_default();
            let mesh = standing.obstacle.mesh().map(|mesh| mesh.to_bytes()).unwrap_or_default();
            for part in [text, mesh] {
                hash.word(part.len() as u64);
                for chunk in part.chunks(8) {
                    hash.word(chunk.iter().fold(0, |word, &byte| word << 8 | u64::from(byte)));
                }
            }
        }
    }

    fn find(&self, id: u32) -> Result<usize, Problem> {
        self.standing.binary_search_by_key(&id, |standing| standing.id).map_err(|_| {
            Problem::new(Reason::ObstacleGone, format!("there is no obstacle {id}"))
                .at("id", "the id of an obstacle in the scene")
        })
    }
}

impl Document {
    /// The obstacles in the scene, in order of their ids.
    pub fn obstacles(&self) -> Vec<PlacedObstacle> {
        self.obstacles.standing.iter().map(Standing::to_proto).collect()
    }

    /// The same as growth has them.
    pub fn solids(&self) -> Vec<Solid> {
        Obstacles::solids(&self.obstacles.standing)
    }

    /// The meshes in the scene by the id of their obstacles.
    pub(crate) fn meshes(&self) -> BTreeMap<u32, Arc<Mesh>> {
        let mesh = |standing: &Standing| Some((standing.id, Arc::clone(standing.obstacle.mesh()?)));
        self.obstacles.standing.iter().filter_map(mesh).collect()
    }

    /// Whether both have the very same obstacles; costs nothing.
    pub(crate) fn has_obstacles_of(&self, other: &ObstaclesMark) -> bool {
        Arc::ptr_eq(&self.obstacles.standing, &other.0)
    }

    /// What [`Document::has_obstacles_of`] compares with.
    pub(crate) fn obstacles_mark(&self) -> ObstaclesMark {
        ObstaclesMark(Arc::clone(&self.obstacles.standing))
    }

    pub(super) fn place_obstacle(&mut self, cause: Cause<'_>, wire: &WireObstacle) -> Result<(), Problem> {
        let standing = &self.obstacles.standing;
        if standing.len() >= MAX_OBSTACLES {
            let message = format!("the scene has {MAX_OBSTACLES} obstacles; remove one first");
            return Err(Problem::new(Reason::ObstaclesFull, message)
                .at("obstacle", format!("up to {MAX_OBSTACLES} obstacles")));
        }
        let obstacle = Obstacle::of(wire)?;
        let new = obstacle.mesh().map_or(0, |mesh| mesh.triangles.len());
        if new > 0 && self.held_triangles() + new > MAX_HELD_TRIANGLES {
            let message = format!(
                "the meshes of the scene and its history may have {MAX_HELD_TRIANGLES} triangles; this would be more"
            );
            return Err(Problem::new(Reason::TrianglesFull, message)
                .at("obstacle.shape.mesh", format!("up to {MAX_HELD_TRIANGLES} triangles")));
        }
        self.obstacles.placed += 1;
        let mut after = standing.to_vec();
        after.push(Standing { id: self.obstacles.placed, obstacle });
        self.change_obstacles(cause, after);
        Ok(())
    }

    pub(super) fn move_obstacle(&mut self, cause: Cause<'_>, id: u32, pose: &Pose) -> Result<(), Problem> {
        let index = self.obstacles.find(id)?;
        let now = &self.obstacles.standing[index].obstacle;
        let placement = pose.into();
        if now.placement == placement {
            return Ok(());
        }
        let moved = Obstacle::new(now.form.clone(), placement)?;
        let mut after = self.obstacles.standing.to_vec();
        after[index].obstacle = moved;
        self.change_obstacles(cause, after);
        Ok(())
    }

    pub(super) fn reshape_obstacle(
        &mut self,
        cause: Cause<'_>,
        id: u32,
        shape: &SimpleShape,
    ) -> Result<(), Problem> {
        let index = self.obstacles.find(id)?;
        let now = &self.obstacles.standing[index].obstacle;
        // The bytes of a mesh are asked for by its id, and stay what they are (`OB5`).
        if matches!(now.form, Form::Mesh { .. }) {
            let message = format!("obstacle {id} is a mesh; a mesh keeps its shape");
            return Err(
                Problem::new(Reason::MeshKeepsShape, message).at("id", "the id of a box, sphere or plane")
            );
        }
        let form = Form::of(shape.get()).map_err(|problem| problem.within("shape"))?;
        if now.form == form {
            return Ok(());
        }
        let reshaped = Obstacle::new(form, now.placement)?;
        let mut after = self.obstacles.standing.to_vec();
        after[index].obstacle = reshaped;
        self.change_obstacles(cause, after);
        Ok(())
    }

    pub(super) fn remove_obstacle(&mut self, cause: Cause<'_>, id: u32) -> Result<(), Problem> {
        let index = self.obstacles.find(id)?;
        let mut after = self.obstacles.standing.to_vec();
        after.remove(index);
        self.change_obstacles(cause, after);
        Ok(())
    }

    /// Puts a setting in force; what is the same stays untouched.
    pub(super) fn set(&mut self, setting: &Setting) {
        self.turn_to(&setting.schedule);
        if !Arc::ptr_eq(&setting.obstacles, &self.obstacles.standing) {
            self.obstacles.standing = Arc::clone(&setting.obstacles);
            self.simulation.set_obstacles(Obstacles::solids(&setting.obstacles));
        }
        self.appearance = Arc::clone(&setting.appearance);
        self.show_design(setting.design.as_ref());
    }

    pub(super) fn setting(&self) -> Setting {
        Setting {
            schedule: Arc::clone(self.schedule()),
            obstacles: Arc::clone(&self.obstacles.standing),
            appearance: Arc::clone(&self.appearance),
            design: self.history.setting().design.clone(),
            let_go: Arc::clone(&self.history.setting().let_go),
        }
    }

    fn change_obstacles(&mut self, cause: Cause<'_>, after: Vec<Standing>) {
        let setting = Setting { obstacles: Arc::new(after), ..self.setting() };
        self.change_setting(Kind::Obstacle, cause, setting);
    }

    /// Triangles of all meshes, those that undo needs included. Goes through the whole history.
    pub(crate) fn held_triangles(&self) -> usize {
        if self.obstacles.placed == 0 {
            return 0;
        }
        let futures = self.futures.all.iter().flat_map(|future| &future.operations);
        let operations = self.history.operations.iter().chain(futures);
        let history = operations.map(|operation| &operation.after.obstacles);
        let sets = history.chain([&self.history.initial.obstacles, &self.obstacles.standing]);
        let meshes: BTreeMap<u32, usize> = sets
            .flat_map(|set| set.iter())
            .filter_map(|standing| Some((standing.id, standing.obstacle.mesh()?.triangles.len())))
            .collect();
        meshes.values().sum()
    }
}

/// Whether the same obstacles stand in the same places; a mesh keeps its shape, so its triangles are not compared.
pub(super) fn stand_alike(some: &Standings, others: &Standings) -> bool {
    let alike = |one: &Standing, other: &Standing| {
        let (a, b) = (&one.obstacle, &other.obstacle);
        one.id == other.id && a.placement == b.placement && (a.mesh().is_some() || a.form == b.form)
    };
    some.len() == others.len() && some.iter().zip(&**others).all(|(one, other)| alike(one, other))
}

/// The obstacles of a document at one time, to be compared.
#[derive(Clone, Debug)]
pub(crate) struct ObstaclesMark(Standings);
