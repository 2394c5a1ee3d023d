//! What a scene answers to grammars, and what it has answered.

use std::{
    cell::{Cell, OnceCell, RefCell},
    sync::Arc,
};

use espalier_grammar::{Environment, Stand};
use espalier_growth::{Growth, Scene};
use glam::{DVec3, Vec3};

use super::Source;

/// Wood farther from a place, in internodes, says nothing of the vigor there.
const NEAR: f32 = 4.0;

/// A scene that is asked, and notes what it answers.
pub(super) struct Asking<'a> {
    scene: &'a Scene,
    growth: &'a Growth,
    source: Arc<Source>,
    /// The greatest vigor of the scene, once somebody has asked for vigor.
    greatest: OnceCell<f32>,
    answers: RefCell<Vec<f64>>,
}

impl<'a> Asking<'a> {
    /// A scene, and the light and vigor that growth has read in it.
    pub(super) fn new(scene: &'a Scene, growth: &'a Growth, source: &Arc<Source>) -> Self {
        let source = Arc::clone(source);
        Self { scene, growth, source, greatest: OnceCell::new(), answers: RefCell::default() }
    }

    /// What it has answered since this was asked last.
    pub(super) fn answers(&self) -> Arc<[f64]> {
        self.answers.take().into()
    }

    fn place(&self, stand: &Stand) -> Vec3 {
        stand.place.as_vec3() + self.source.at
    }

    fn note(&self, answer: f64) -> f64 {
        if self.source.asks {
            self.answers.borrow_mut().push(answer);
        }
        answer
    }
}

impl Environment for Asking<'_> {
    fn light(&self, stand: &Stand) -> f64 {
        self.note(self.scene.exposure(self.place(stand)).into())
    }

    fn brighter(&self, stand: &Stand) -> DVec3 {
        let way = self.scene.towards_light(self.place(stand)).unwrap_or_default().as_dvec3();
        DVec3::from(way.to_array().map(|part| self.note(part)))
    }

    fn is_free(&self, stand: &Stand, radius: f64) -> bool {
        let radius = radius.clamp(0.0, 100.0) as f32;
        self.note(f64::from(u8::from(self.scene.is_free_of_others(self.place(stand), radius)))) > 0.0
    }

    fn is_inside(&self, stand: &Stand, body: u32) -> bool {
        let place = self.place(stand);
        let is_inside = match body.checked_sub(1) {
            None => self.source.within.as_ref().is_none_or(|(_, body)| body.contains(place)),
            Some(number) => self.scene.is_in_obstacle(number as usize, place),
        };
        self.note(f64::from(u8::from(is_inside))) > 0.0
    }

    fn has_body(&self, body: u32) -> bool {
        let is_there = match body.checked_sub(1) {
            None => self.source.within.is_some(),
            Some(number) => (number as usize) < self.scene.obstacles().len(),
        };
        self.note(f64::from(u8::from(is_there))) > 0.0
    }

    fn vigor(&self, stand: &Stand) -> f64 {
        let greatest = *self.greatest.get_or_init(|| self.growth.greatest_vigor(self.scene));
        let nearest = self.scene.nearest_node(self.place(stand), NEAR);
        let share = match nearest {
            Some(node) if greatest > 0.0 => self.growth.vigor_at(self.scene, node) / greatest,
            Some(_) => 0.0,
            None => 1.0,
        };
        self.note(share.into())
    }
}

/// What was answered before, told again in the same order.
pub(super) struct Told {
    answers: Arc<[f64]>,
    told: Cell<usize>,
}

impl Told {
    /// So many of them have been told already.
    pub(super) fn new(answers: Arc<[f64]>, told: usize) -> Self {
        Self { answers, told: Cell::new(told) }
    }

    /// How many have been told.
    pub(super) fn told(&self) -> usize {
        self.told.get()
    }

    fn next(&self) -> f64 {
        let at = self.told.replace(self.told.get() + 1);
        self.answers.get(at).copied().unwrap_or_default()
    }
}

impl Environment for Told {
    fn light(&self, _: &Stand) -> f64 {
        self.next()
    }

    fn brighter(&self, _: &Stand) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }

    fn is_free(&self, _: &Stand, _: f64) -> bool {
        self.next() > 0.0
    }

    fn is_inside(&self, _: &Stand, _: u32) -> bool {
        self.next() > 0.0
    }

    fn has_body(&self, _: u32) -> bool {
        self.next() > 0.0
    }

    fn vigor(&self, _: &Stand) -> f64 {
        self.next()
    }
}
