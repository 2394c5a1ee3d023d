//! Who is here, where their pointers are, and what they see (`PS`). None of it is kept.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{
    access::Role,
    bounded::{EyeDistance, Pitch, Share, Yaw},
    place::{Offset, Position},
    reading::tagged_enum,
};

tagged_enum! {
    "kind",

    /// Where somebody points.
    pub enum Pointer {
        /// On wood or near it: the place rides with the metamer.
        Wood {
            /// The metamer's row.
            row: u32,
            /// How far along the metamer, from where it begins (0) to where it ends (1).
            along: Share,
            /// From there, in internode lengths along the axes h, u and w of `LF1`.
            offset: Offset,
        },
        /// Anywhere else.
        Space {
            /// The place.
            position: Position,
        },
    }
}

/// How somebody looks at the tree: from a place on a sphere around a target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with target, yaw, pitch and distance")]
pub struct Camera {
    /// What is in the middle of the picture.
    pub target: Position,
    /// Turn around the vertical, in degrees; 0 looks along −z.
    pub yaw: Yaw,
    /// Height of the eye above the horizontal through the target, in degrees.
    pub pitch: Pitch,
    /// From the target to the eye, in internode lengths.
    pub distance: EyeDistance,
}

impl Camera {
    /// As frames have it: target, yaw, pitch, distance.
    pub fn numbers(&self) -> [f32; 6] {
        let [x, y, z] = self.target.get().to_array();
        [x, y, z, self.yaw.get(), self.pitch.get(), self.distance.get()]
    }
}

/// Somebody who is here, on one device or several (`PS3`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Person {
    /// Their number in this session, by which clients choose their colour.
    pub person: u32,
    /// What they are called, if they have a name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<String>,
    /// What they may do.
    pub role: Role,
    /// Their pages, by their numbers.
    pub devices: Vec<Device>,
}

/// Somebody who did what stands on the line of time (`RP3`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Author {
    /// Their number, as in the operations of `timeline`.
    pub person: u32,
    /// What they were called last, if the session knows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<String>,
}

/// A page that somebody has open.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// Its number in this session; a page that connects again keeps it.
    pub device: u32,
    /// Whether its person looks at it.
    pub state: Whereabouts,
    /// The tool that is in hand there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tool: Option<String>,
    /// The device whose camera it follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub follows: Option<u32>,
}

/// Whether somebody is at a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum Whereabouts {
    /// They are.
    #[default]
    Here,
    /// They look at something else.
    Away,
    /// It has not answered for some seconds.
    Gone,
}
