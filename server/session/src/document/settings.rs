//! Changes of settings, that make nothing grow at once: of parameters and of looks (`AP`); obstacles stand beside.

use std::sync::Arc;

use espalier_proto::Problem;
use espalier_settings::{Appearance, AppearancePatch, ParametersPatch};
use serde::Serialize;

use super::{
    Document,
    history::{Kind, Setting},
};
use crate::{appearance::AppearanceChange, cause::Cause};

impl Document {
    /// How the tree looks.
    pub fn appearance(&self) -> &Appearance {
        &self.appearance
    }

    pub(super) fn set_parameters(
        &mut self,
        cause: Cause<'_>,
        patch: &ParametersPatch,
    ) -> Result<(), Problem> {
        let wanted =
            self.schedule().with(patch, self.age()).map_err(|problem| problem.within("parameters"))?;
        self.change_schedule(cause, wanted);
        Ok(())
    }

    pub(super) fn set_appearance(
        &mut self,
        cause: Cause<'_>,
        patch: &AppearancePatch,
    ) -> Result<(), Problem> {
        let wanted = AppearanceChange::parse(patch)?.applied_to(&self.appearance);
        if wanted != *self.appearance {
            let setting = Setting { appearance: Arc::new(wanted), ..self.setting() };
            self.change_setting(Kind::Appearance, cause, setting);
        }
        Ok(())
    }

    /// Makes this setting that of an operation: of the last one if that is part of the same gesture (`AP2`, `OB2`).
    pub(super) fn change_setting(&mut self, kind: Kind, cause: Cause<'_>, mut setting: Setting) {
        let now = self.plant().step();
        let kinds: &[Kind] = match kind {
            Kind::Obstacle => &[Kind::Obstacle],
            _ => &[Kind::Parameters, Kind::Appearance],
        };
        let continues = self.history.continues(kinds, cause, now);
        if !continues {
            self.record(kind, cause);
        }
        self.history.share_former_obstacles(&mut setting);
        self.set(&setting);
        self.history.settle(setting);
        if continues {
            self.history.widen(kind);
            // Back where the gesture began, there is nothing to undo.
            if self.history.changes_nothing() {
                self.unrecord();
            }
        }
        self.note_state();
    }
}

/// All values as words, for hashing.
pub(super) fn to_words(settings: &impl Serialize) -> Vec<u64> {
    // The JSON text of a float is its shortest exact form, so equal text means equal bits.
    let text = serde_json::to_vec(settings).unwrap_or_default();
    text.chunks(8).map(|chunk| chunk.iter().fold(0, |word, &byte| word << 8 | u64::from(byte))).collect()
}
