//! Meshes as obstacles: uploaded as glTF or OBJ, fetched as they stand.

use axum::{
    Extension, Json,
    extract::State,
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_import::{ImportError, Limits, Model, Size, Triangles, read_model};
use espalier_proto::{
    Action, Mesh, MeshSize, Obstacle, Pose, Position, Problem, Reason, Scale, Shape, UnitRotation,
    UploadedObstacle,
    version::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES, MAX_MODEL_TRIANGLES},
};
use espalier_session::Principal;

use crate::{access::Caller, pool::Class};

use super::{
    Shared,
    failure::{Failure, Path},
    ranges, sessions,
    uploads::FileOnDisk,
};

/// What an upload may have, and what is kept of it (`LM6`).
const LIMITS: Limits = Limits {
    vertices: MAX_MESH_VERTICES,
    triangles: MAX_MESH_TRIANGLES,
    most_triangles: MAX_MODEL_TRIANGLES,
};

/// Places the triangles of a file with its own origin at the scene's.
pub(super) async fn upload(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    caller: Caller,
    Path(session): Path<String>,
    FileOnDisk(mut file, turn): FileOnDisk,
) -> Result<impl IntoResponse, Failure> {
    let session = sessions::open(&shared, &session).await?;
    let metres = session.parameters().await?.internode_length;
    let model = shared.pool.run(Class::Whole, principal.name().into(), move |_| {
        let model = read_model(&mut file, &LIMITS);
        // Not before, whether or not anybody still waits: it is for the memory that reading takes.
        drop(turn);
        model
    });
    let Model { triangles, simplified_from } = model.await?.map_err(|error| refusal(&error))?;
    let Triangles { vertices, corners } = triangles;
    let mesh = Mesh { vertices, triangles: corners };
    let scale = Scale::try_from(1.0 / metres)
        .map_err(|fault| Problem::out_of_range("scale", fault.found, fault.allowed))?;
    let shape = Shape::Mesh { mesh, scale };
    let pose = Pose { position: Position::ORIGIN, rotation: UnitRotation::IDENTITY };
    let action = Action::PlaceObstacle { obstacle: Obstacle { shape, pose } };
    let simplified_from = simplified_from.map(|Size { vertices, triangles }| MeshSize {
        vertices: vertices as u32,
        triangles: triangles as u32,
    });
    match session.act(principal, caller.entrant(), action.into()).await?? {
        Some(placed) => Ok((StatusCode::CREATED, Json(UploadedObstacle::new(placed, simplified_from)))),
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
const MODEL: &str = "glTF 2.0 as .glb, or as .gltf with its buffers inside, or .obj";
/// What one must be that is glTF.
const GLTF: &str = "glTF 2.0 as .glb, or as .gltf with its buffers inside";

/// Why no obstacle came of a file.
fn refusal(error: &ImportError) -> Failure {
    if let ImportError::Unread(why) = error {
        tracing::error!(why, "a file that was taken in cannot be read");
        return Failure::new(Reason::Failed, "The server cannot read the file; nothing was changed.");
    }
    no_obstacle(error).into()
}

/// Why a file cannot be an obstacle, and what one must have.
fn no_obstacle(error: &ImportError) -> Problem {
    let message = format!("The file cannot be an obstacle: {error}.");
    let gltf = || GLTF.to_owned();
    let (reason, field, allowed, cause) = match error {
        ImportError::NotModel(why) => (Reason::NotModel, None, MODEL.to_owned(), Some(why.clone())),
        ImportError::NotGltf(_) => (Reason::NotGltf, None, gltf(), None),
        ImportError::Version(version) => (Reason::GltfVersion, None, gltf(), Some(version.clone())),
        ImportError::ExternalBuffer(_) => (Reason::GltfBuffers, None, gltf(), None),
        ImportError::Unsupported(what) => {
            (Reason::GltfNeeds, None, format!("{GLTF}, without {what}"), Some(what.clone()))
        }
        ImportError::Member { field, allowed, .. } => {
            (Reason::GltfDamaged, Some(field.clone()), allowed.clone(), None)
        }
        ImportError::Line { line, what, allowed } => {
            (Reason::ObjDamaged, Some(format!("line {line}")), allowed.clone(), Some(what.clone()))
        }
        ImportError::Damaged(_) | ImportError::NotFinite | ImportError::Unread(_) => {
            (Reason::GltfDamaged, None, gltf(), None)
        }
        ImportError::Empty => (Reason::EmptyMesh, None, "at least one triangle".to_owned(), None),
        ImportError::TooLarge(Limits { most_triangles, .. }) => {
            (Reason::LargeMesh, None, format!("up to {most_triangles} triangles"), None)
        }
    };
    let problem = Problem::new(reason, message);
    Problem { cause, ..problem.at(field.unwrap_or_else(|| "body".to_owned()), allowed) }
}
