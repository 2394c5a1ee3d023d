//! Obstacles: what stands in the way of growth and light.

use espalier_reading::NotAllowed;
use schemars::{JsonSchema, json_schema};
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{
    bounded::{Scale, SphereRadius, written_as},
    mesh::Mesh,
    place::{BoxSize, Position, UnitRotation},
    reading::tagged_enum,
    schema::schemas,
};

/// No rotation.
fn upright() -> UnitRotation {
    UnitRotation::IDENTITY
}

/// A mesh is as large as its coordinates say unless a scale is given.
fn full_size() -> Scale {
    Scale::nearest(1.0)
}

/// Where something stands, and how it is turned.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with position and rotation")]
pub struct Pose {
    /// Where its own origin lies, in internode lengths.
    pub position: Position,
    /// A quaternion x, y, z, w; of unit length, within a hundredth.
    #[serde(default = "upright")]
    #[ts(as = "Option<[f32; 4]>", optional)]
    pub rotation: UnitRotation,
}

tagged_enum! {
    "kind",

    /// What shape an obstacle has, around its own origin, in internode lengths.
    pub enum Shape {
        /// A box around the origin.
        Box {
            /// Its whole width, height and depth, each 0.1 to 1000.
            size: BoxSize,
        },
        /// A sphere around the origin.
        Sphere {
            /// 0.1 to 500.
            radius: SphereRadius,
        },
        /// Everything below the plane through the origin: nothing grows where the obstacle's own y is below 0.
        Plane {},
        /// A triangle mesh.
        Mesh {
            /// The mesh in base64 (`OB4`).
            #[schemars(with = "String")]
            #[ts(as = "String")]
            mesh: Mesh,
            /// 0.001 to 1000: coordinates are multiplied by this.
            #[serde(default = "full_size")]
            #[ts(as = "Option<f32>", optional)]
            scale: Scale,
        },
    }
}

/// Any shape but a mesh, which is what it was placed as (`OB2`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Shape")]
pub struct SimpleShape(Shape);

impl SimpleShape {
    /// The shape.
    pub fn get(&self) -> &Shape {
        &self.0
    }
}

impl TryFrom<Shape> for SimpleShape {
    type Error = NotAllowed;

    fn try_from(shape: Shape) -> Result<Self, NotAllowed> {
        match shape {
            Shape::Mesh { .. } => {
                Err(NotAllowed { at: "kind".into(), ..NotAllowed::new("mesh", "box, sphere or plane") })
            }
            simple => Ok(Self(simple)),
        }
    }
}

written_as! { SimpleShape as Shape; }
schemas! {
    SimpleShape = |generator| {
        let shape = generator.subschema_for::<Shape>();
        let mesh = json_schema!({ "properties": { "kind": { "const": "mesh" } } });
        json_schema!({ "allOf": [shape], "not": mesh })
    };
}

/// An obstacle as it is placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with shape and pose")]
pub struct Obstacle {
    /// What it is.
    pub shape: Shape,
    /// Where it stands.
    pub pose: Pose,
}

/// The shape of an obstacle that is in the scene; a mesh is fetched apart (`OB5`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum PlacedShape {
    /// A box around the origin.
    Box {
        /// Its whole width, height and depth.
        size: [f32; 3],
    },
    /// A sphere around the origin.
    Sphere {
        /// Its radius.
        radius: f32,
    },
    /// Everything below the plane through the origin.
    Plane {},
    /// A triangle mesh.
    Mesh {
        /// How many vertices it has.
        vertices: u32,
        /// How many triangles it has.
        triangles: u32,
        /// Coordinates are multiplied by this.
        scale: f32,
    },
}

/// An obstacle in the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct PlacedObstacle {
    /// Names it; never used again for another one of the same session.
    pub id: u32,
    /// What it is.
    pub shape: PlacedShape,
    /// Where it stands.
    pub pose: Pose,
}

/// How large a mesh is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct MeshSize {
    /// Different places of corners.
    pub vertices: u32,
    /// Triangles.
    pub triangles: u32,
}

/// An obstacle that a file has become (`OB6`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct UploadedObstacle {
    /// Names it; never used again for another one of the same session.
    pub id: u32,
    /// What it is.
    pub shape: PlacedShape,
    /// Where it stands.
    pub pose: Pose,
    /// How much the file has, where the obstacle has less.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub simplified_from: Option<MeshSize>,
}

impl UploadedObstacle {
    /// An obstacle, and what it was simplified from.
    pub fn new(placed: PlacedObstacle, simplified_from: Option<MeshSize>) -> Self {
        let PlacedObstacle { id, shape, pose } = placed;
        Self { id, shape, pose, simplified_from }
    }
}
