//! Plants of designs, on the command line.

use std::path::Path;

use espalier_design::TEMPLATES;
use espalier_proto::{Action, DesignValue, Position, Slug};
use glam::Vec3;

use super::{HeadlessError, read};
use crate::similar::asked_for;

/// The command that plants a design: of a file, or of a template where no file has that name. With a seed, chance falls by
/// it and not by that of the file.
pub(super) fn planted(path: &Path, seed: Option<u32>) -> Result<Action, HeadlessError> {
    let position = Some(Position::nearest(Vec3::ZERO));
    let template = path.to_str().and_then(|name| Slug::try_from(name.to_owned()).ok());
    if let Some(template) = template.filter(|_| !path.exists()) {
        let known = TEMPLATES.iter().map(|template| template.name);
        if !known.clone().any(|name| name == template.as_str()) {
            let name = template.as_str().to_owned();
            return Err(HeadlessError::NoDesign { hint: asked_for(&name, known), name });
        }
        return Ok(Action::NewDesign { position, template: Some(template), graph: None });
    }
    let unread = |cause: String| HeadlessError::Design { path: path.to_owned(), cause };
    let bytes = read(path).map_err(|cause| HeadlessError::Read { path: path.to_owned(), cause })?;
    let mut graph: serde_json::Value =
        serde_json::from_slice(&bytes).map_err(|cause| unread(cause.to_string()))?;
    if let (Some(seed), Some(object)) = (seed, graph.as_object_mut()) {
        object.insert("seed".to_owned(), seed.into());
    }
    let graph: DesignValue = serde_json::from_value(graph).map_err(|cause| unread(cause.to_string()))?;
    Ok(Action::NewDesign { position, template: None, graph: Some(graph) })
}
