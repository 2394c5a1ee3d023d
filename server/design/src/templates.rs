//! Designs to begin with: the six styles of bonsai of Boudon et al. 2003, Figures 11 to 15.

use crate::design::Design;

/// A design to begin with.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// Its name.
    pub name: &'static str,
    /// What the style is.
    pub sentence: &'static str,
    json: &'static str,
}

macro_rules! templates {
    ($($(#[doc = $sentence:literal])+ $name:literal;)+) => {
        /// All of them, in the order of the paper.
        pub const TEMPLATES: [Template; [$($name,)+].len()] = [$(Template {
            name: $name,
            sentence: concat!($($sentence),+),
            json: include_str!(concat!("../templates/", $name, ".json")),
        },)+];
    };
}

templates! {
    /// The free style of scholars: a tall bare stem in curves, and a small crown at its top.
    "bunjingi";
    /// A twisted cascade: a stem that winds and leans over, with pads of needles.
    "nejikan";
    /// Swept by the wind: everything goes to one side.
    "fukinagashi";
    /// Formal and upright: a straight stem, and limbs in level pads that become shorter towards the top.
    "chokkan";
    /// Three stems that rise from one point.
    "sankan";
    /// A cascade: a stem that falls below its own base.
    "kengai";
}

impl Template {
    /// The template of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        TEMPLATES.iter().find(|template| template.name == name)
    }

    /// Its design.
    ///
    /// # Panics
    /// Never: each template is read by a test.
    pub fn design(&self) -> Design {
        Design::from_json(self.json)
            .unwrap_or_else(|unread| unreachable!("{} is sound: {unread:?}", self.name))
    }
}
