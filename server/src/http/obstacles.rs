//! Meshes as obstacles: uploaded as glTF, fetched as they stand.

use axum::{
    Extension, Json,
    extract::State,
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_import::{ImportError, Limits};
use espalier_proto::{
    Action, Mesh, Obstacle, Pose, Position, Problem, Reason, Scale, Shape, UnitRotation,
    version::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES},
};
use espalier_session::Principal;

use crate::pool::Class;

use super::{
    Shared,
    failure::{Failure, Path},
    ranges, sessions,
    uploads::File,
};

/// What the mesh of an upload may have (`LM6`).
const LIMITS: Limits = Limits { vertices: MAX_MESH_VERTICES, triangles: MAX_MESH_TRIANGLES };

/// Places the triangles of a file with its own origin at the scene's.
pub(super) async fn upload(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Path(session): Path<String>,
    File(file, _turn): File,
) -> Result<impl IntoResponse, Failure> {
    let session = sessions::open(&shared, &session).await?;
    let metres = session.parameters().await?.internode_length;
    let mesh = shared.pool.run(Class::Whole, principal.name().into(), move |_| mesh_of(&file)).await?;
    let mesh = mesh.map_err(|error| no_obstacle(&error))?;
    let scale = Scale::try_from(1.0 / metres)
        .map_err(|fault| Problem::out_of_range("scale", fault.found, fault.allowed))?;
    let shape = Shape::Mesh { mesh, scale };
    let pose = Pose { position: Position::ORIGIN, rotation: UnitRotation::IDENTITY };
    let action = Action::PlaceObstacle { obstacle: Obstacle { shape, pose } };
    match session.act(principal, action.into()).await?? {
        Some(placed) => Ok((StatusCode::CREATED, Json(placed))),
        None => Err(Failure::new(Reason::NotPlaced, "The obstacle was not placed.")),
    }
}

/// The mesh of one obstacle (`OB5`).
pub(super) async fn mesh(
    State(shared): State<Shared>,
    Path((session, obstacle)): Path<(String, u32)>,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    let session = sessions::open(&shared, &session).await?;
    let mesh = session.mesh(obstacle).await?;
    let mesh =
        mesh.ok_or_else(|| Failure::none_such("mesh", "obstacle", "the id of an obstacle that is a mesh"))?;
    ranges::answer_with(&asked, [(header::CONTENT_TYPE, "application/octet-stream")], mesh.to_bytes())
}

/// What a file must be to be read at all.
const GLTF: &str = "glTF 2.0 as .glb, or as .gltf with its buffers inside";

/// Why a file cannot be an obstacle, and what one must have.
fn no_obstacle(error: &ImportError) -> Problem {
    let message = format!("The file cannot be an obstacle: {error}.");
    if let ImportError::Member { field, allowed, .. } = error {
        return Problem::new(Reason::GltfDamaged, message).at(field, allowed);
    }
    let gltf = || GLTF.to_owned();
    let (reason, allowed, cause) = match error {
        ImportError::NotGltf(_) => (Reason::NotGltf, gltf(), None),
        ImportError::Version(version) => (Reason::GltfVersion, gltf(), Some(version.clone())),
        ImportError::ExternalBuffer(_) => (Reason::GltfBuffers, gltf(), None),
        ImportError::Unsupported(what) => {
            (Reason::GltfNeeds, format!("{GLTF}, without {what}"), Some(what.clone()))
        }
        ImportError::Damaged(_) | ImportError::Member { .. } | ImportError::NotFinite => {
            (Reason::GltfDamaged, gltf(), None)
        }
        ImportError::Empty => (Reason::EmptyMesh, "at least one triangle".to_owned(), None),
        ImportError::TooLarge(Limits { vertices, triangles }) => {
            (Reason::LargeMesh, format!("up to {triangles} triangles and {vertices} vertices"), None)
        }
    };
    let problem = Problem::new(reason, message);
    Problem { cause, ..problem.at("body", allowed) }
}

/// The triangles of a file.
fn mesh_of(file: &[u8]) -> Result<Mesh, ImportError> {
    let read = espalier_import::read(file, LIMITS)?;
    Ok(Mesh { vertices: read.vertices, triangles: read.corners })
}
