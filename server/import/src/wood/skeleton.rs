//! Skeletons as this program writes them, of both versions.

use espalier_plant::{Wood, WoodAxis, WoodNode, wood::as_written};
use espalier_settings::ParametersPatch;
use glam::{DVec3, Vec3};
use serde::Deserialize;

use super::{Fault, MAX_STEP, Place, WoodFile, WoodOptions, malformed, out_of_range, too_many};

/// What says how to read the rest.
#[derive(Deserialize)]
struct Head {
    format: String,
    version: u32,
}

/// Version 1, which knew neither metres nor axes.
#[derive(Deserialize)]
struct First {
    metamers: Vec<FirstMetamer>,
}

#[derive(Deserialize)]
struct FirstMetamer {
    parent: Option<u32>,
    position: [f64; 3],
    radius: f64,
    order: u32,
    birth: u32,
}

#[derive(Deserialize)]
struct Second {
    species: Option<String>,
    seed: Option<u32>,
    #[serde(default)]
    parameters: ParametersPatch,
    axes: Vec<Axis>,
    metamers: Vec<Metamer>,
}

#[derive(Deserialize)]
struct Axis {
    bearer: Option<u32>,
    direction: Option<[f32; 3]>,
    #[serde(default = "yes")]
    bud: bool,
}

fn yes() -> bool {
    true
}

#[derive(Deserialize)]
struct Metamer {
    parent: Option<u32>,
    axis: u32,
    position: [f64; 3],
    normal: Option<[f32; 3]>,
    radius: Option<f64>,
    birth: u32,
    width: Option<f64>,
}

/// The wood of a skeleton.
pub(super) fn read(bytes: &[u8], options: &WoodOptions) -> Result<WoodFile, Fault> {
    let head: Head = json(bytes)?;
    if head.format != "espalier-skeleton" {
        return Err(malformed(Some(Place::Member("format".into())), "it is not `espalier-skeleton`"));
    }
    let file = match head.version {
        1 => first(json(bytes)?, options),
        2 => second(json(bytes)?, options),
        later => {
            let what = format!("it is {later}; versions 1 and 2 are read");
            return Err(malformed(Some(Place::Member("version".into())), what));
        }
    }?;
    check(&file.wood, options)?;
    Ok(file)
}

fn json<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, Fault> {
    serde_json::from_slice(bytes).map_err(|error| {
        let place = Place::Cell(error.line() as u64, error.column() as u64);
        // The place stands before the message.
        let text = error.to_string();
        let what = text.rsplit_once(" at line ").map_or(&*text, |(what, _)| what);
        malformed(Some(place), format!("it is no skeleton: {what}"))
    })
}

fn first(First { metamers }: First, options: &WoodOptions) -> Result<WoodFile, Fault> {
    limit(metamers.len(), options)?;
    let (mut nodes, mut axes) = (Vec::<WoodNode>::with_capacity(metamers.len()), Vec::new());
    for (metamer, at) in metamers.iter().zip(0u32..) {
        let FirstMetamer { parent, position, radius, order, birth } = *metamer;
        let below = match parent {
            Some(parent) if parent >= at => return Err(behind(at, parent)),
            Some(parent) => Some((metamers[parent as usize].order, nodes[parent as usize].axis, parent)),
            None => None,
        };
        let axis = match below {
            Some((of_parent, axis, _)) if of_parent == order => axis,
            _ => {
                axes.push(WoodAxis { bearer: parent, direction: None, has_bud: true });
                axes.len() as u32 - 1
            }
        };
        let end = within(at, DVec3::from_array(position), options)?;
        let radius = girth(at, "radius", parent.map(|_| radius), 1.0)?;
        nodes.push(WoodNode { parent, axis, end, normal: None, radius, birth });
    }
    Ok(WoodFile { wood: Wood { nodes, axes, ..Wood::default() }, ..WoodFile::default() })
}

fn second(file: Second, options: &WoodOptions) -> Result<WoodFile, Fault> {
    limit(file.metamers.len(), options)?;
    limit(file.axes.len() / 5, options)?;
    let length = file.parameters.internode_length.unwrap_or(options.internode_length);
    if !(length.is_finite() && length > 0.0) {
        let place = Place::Member("parameters.internode_length".into());
        return Err(out_of_range(Some(place), format!("it is {length}"), "more than 0"));
    }
    let scale = as_written(length);
    let (mut nodes, mut widths) = (Vec::with_capacity(file.metamers.len()), Vec::new());
    for (metamer, at) in file.metamers.iter().zip(0u32..) {
        let &Metamer { parent, axis, position, normal, radius, birth, width } = metamer;
        if let Some(parent) = parent.filter(|&parent| parent >= at) {
            return Err(behind(at, parent));
        }
        let end = within(at, DVec3::from_array(position) / scale, options)?;
        let radius = girth(at, "radius", radius.filter(|_| parent.is_some()), scale)?;
        widths.extend(girth(at, "width", width, scale)?.map(|width| (at, width)));
        nodes.push(WoodNode { parent, axis, end, normal: normal.map(Vec3::from_array), radius, birth });
    }
    let axis = |axis: &Axis| WoodAxis {
        bearer: axis.bearer,
        direction: axis.direction.map(Vec3::from_array),
        has_bud: axis.bud,
    };
    let wood = Wood { nodes, axes: file.axes.iter().map(axis).collect(), widths, has_buds: true };
    Ok(WoodFile { wood, parameters: file.parameters, species: file.species, seed: file.seed })
}

/// Checks what both versions have alike.
fn check(wood: &Wood, options: &WoodOptions) -> Result<(), Fault> {
    limit(wood.nodes.len(), options)?;
    let mut before = 0;
    for (at, node) in wood.nodes.iter().enumerate() {
        // Nothing has grown in the step of the first seed.
        let last = u32::from(node.parent.is_some()).max(before);
        if node.birth > MAX_STEP || node.birth < last {
            let allowed = format!("{last}, the birth of the one before, to {MAX_STEP}");
            return Err(out_of_range(member(at, "birth"), format!("it is {}", node.birth), allowed));
        }
        before = node.birth;
        if node.axis as usize >= wood.axes.len() {
            let allowed = format!("numbers below {}, as many as there are axes", wood.axes.len());
            return Err(out_of_range(member(at, "axis"), format!("there is no axis {}", node.axis), allowed));
        }
        let below = node.parent.map(|parent| wood.nodes[parent as usize].end);
        if below == Some(node.end) {
            return Err(malformed(member(at, "position"), "its internode has no length"));
        }
    }
    Ok(())
}

fn member(at: usize, name: &str) -> Option<Place> {
    Some(Place::Member(format!("metamers[{at}].{name}")))
}

fn behind(at: u32, parent: u32) -> Fault {
    let allowed = format!("numbers below {at}, for a metamer stands behind the one it grows from");
    out_of_range(member(at as usize, "parent"), format!("it is {parent}"), allowed)
}

fn limit(count: usize, options: &WoodOptions) -> Result<(), Fault> {
    if count > options.nodes {
        Err(too_many(Some(Place::Member("metamers".into())), options))
    } else {
        Ok(())
    }
}

/// A place in internodes.
fn within(at: u32, place: DVec3, options: &WoodOptions) -> Result<Vec3, Fault> {
    if place.is_finite() && place.abs().max_element() <= f64::from(options.extent) {
        return Ok(place.as_vec3());
    }
    let allowed = format!("up to {} internodes on each axis", options.extent);
    Err(out_of_range(member(at as usize, "position"), "it lies too far from the origin", allowed))
}

/// A radius or diameter in internodes; none where it is 0.
fn girth(at: u32, name: &str, metres: Option<f64>, scale: f64) -> Result<Option<f32>, Fault> {
    let Some(metres) = metres else { return Ok(None) };
    let internodes = (metres / scale) as f32;
    if metres < 0.0 || !internodes.is_finite() {
        return Err(out_of_range(member(at as usize, name), format!("it is {metres}"), "0 and more"));
    }
    Ok(Some(internodes).filter(|&internodes| internodes > 0.0))
}
