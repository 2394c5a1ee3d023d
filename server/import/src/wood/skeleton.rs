//! Skeletons as this program writes them, of both versions.

mod fit;
mod values;

use espalier_plant::{DormantBuds, Wood, WoodAxis, WoodNode, wood::as_written};
use espalier_reading::{Kind, Refusal, Unread, from_slice};
use espalier_settings::{ParameterValues, ParametersPatch};
use glam::{DVec3, Vec3};
use serde::{Deserialize, de::DeserializeOwned};

use self::values::{
    Axes, AxisNumber, Bearer, Birth, Borne, Girth, Head, Metamers, Order, Parent, Row, Shed, Vector, Version,
};
use super::{
    Fault, FaultKind, MAX_SHED, MAX_STEP, Place, WoodFile, WoodOptions, malformed, out_of_range, too_many,
};

/// Version 1, which knew neither metres nor axes.
#[derive(Deserialize)]
struct First {
    metamers: Metamers<FirstMetamer>,
}

#[derive(Deserialize)]
struct FirstMetamer {
    parent: Option<Parent>,
    position: Vector<f64>,
    radius: Girth,
    order: Order,
    birth: Birth,
}

#[derive(Deserialize)]
struct Second {
    species: Option<String>,
    seed: Option<u32>,
    #[serde(default)]
    parameters: ParametersPatch,
    axes: Axes<Axis>,
    metamers: Metamers<Metamer>,
}

#[derive(Deserialize)]
struct Axis {
    bearer: Option<Bearer>,
    direction: Option<Vector<f32>>,
    #[serde(default = "yes")]
    bud: bool,
}

fn yes() -> bool {
    true
}

#[derive(Deserialize)]
struct Metamer {
    row: Option<Row>,
    parent: Option<Parent>,
    axis: AxisNumber,
    position: Vector<f64>,
    normal: Option<Vector<f32>>,
    radius: Option<Girth>,
    birth: Birth,
    width: Option<Girth>,
    shed: Option<Shed>,
    organs: Option<Borne>,
}

/// The wood of a skeleton.
pub(super) fn read(bytes: &[u8], options: &WoodOptions) -> Result<WoodFile, Fault> {
    let Head { version, .. } = json(bytes)?;
    let file = match version {
        Version::First => first(json(bytes)?, options),
        Version::Second => second(json(bytes)?, options),
    }?;
    check(&file.wood, options)?;
    Ok(file)
}

fn json<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, Fault> {
    from_slice(bytes).map_err(|unread| match unread {
        Unread::NotJson { line, column, what } => {
            malformed(Some(Place::Cell(line, column)), format!("it is no JSON: {what}"))
        }
        Unread::Refused(Refusal { field, kind, what, allowed }) => {
            let kind = match kind {
                Kind::OutOfRange => FaultKind::OutOfRange,
                Kind::TooMany => FaultKind::TooMany,
                Kind::Malformed | Kind::TooFew | Kind::Named(_) => FaultKind::Malformed,
            };
            let place = Some(field).filter(|field| !field.is_empty()).map(Place::Member);
            Fault { kind, place, what: format!("it {what}"), allowed }
        }
    })
}

fn first(First { metamers }: First, options: &WoodOptions) -> Result<WoodFile, Fault> {
    limit(metamers.len(), options)?;
    let (mut nodes, mut axes) = (Vec::<WoodNode>::with_capacity(metamers.len()), Vec::new());
    for (metamer, at) in metamers.iter().zip(0u32..) {
        let FirstMetamer { position, radius, order: Order(order), birth: Birth(birth), .. } = *metamer;
        let parent = metamer.parent.map(|Parent(parent)| parent);
        let below = match parent {
            Some(parent) if parent >= at => return Err(behind(at, parent)),
            Some(parent) => Some((metamers[parent as usize].order.0, nodes[parent as usize].axis, parent)),
            None => None,
        };
        let axis = match below {
            Some((of_parent, axis, _)) if of_parent == order => axis,
            _ => {
                axes.push(WoodAxis { bearer: parent, direction: None, has_bud: true });
                axes.len() as u32 - 1
            }
        };
        let end = within(at, DVec3::from_array(position.0), options)?;
        let radius = girth(at, "radius", parent.map(|_| radius), 1.0, options.extent)?;
        nodes.push(WoodNode { parent, axis, end, normal: None, radius, birth });
    }
    let wood = Wood { nodes, axes, buds: DormantBuds::OnYoungWood, ..Wood::default() };
    Ok(WoodFile { wood, ..WoodFile::default() })
}

fn second(mut file: Second, options: &WoodOptions) -> Result<WoodFile, Fault> {
    limit(file.metamers.len(), options)?;
    limit(file.axes.len() / 5, options)?;
    let length = options.internode_length.or(file.parameters.internode_length);
    let length = length.unwrap_or(ParameterValues::default().internode_length);
    file.parameters.internode_length = Some(length);
    if !(length.is_finite() && length > 0.0) {
        let place = Place::Member("parameters.internode_length".into());
        return Err(out_of_range(Some(place), format!("it is {length}"), "more than 0"));
    }
    let scale = as_written(length);
    let (mut nodes, mut widths, mut scars) =
        (Vec::with_capacity(file.metamers.len()), Vec::new(), Vec::new());
    let (mut gaps, mut organs, mut next) = (Vec::new(), Vec::new(), 0);
    let mut all_shed = 0;
    for (metamer, at) in file.metamers.iter().zip(0u32..) {
        let &Metamer {
            axis: AxisNumber(axis),
            position,
            normal,
            radius,
            birth: Birth(birth),
            width,
            shed,
            row,
            ..
        } = metamer;
        let Row(row) = row.unwrap_or(Row(next));
        if row < next {
            let allowed = format!("{next}, the row behind the one before, or more");
            return Err(out_of_range(member(at as usize, "row"), format!("it is {row}"), allowed));
        }
        if row > next {
            gaps.push((at, row - next));
        }
        next = row + 1;
        let parent = metamer.parent.map(|Parent(parent)| parent);
        if let Some(parent) = parent.filter(|&parent| parent >= at) {
            return Err(behind(at, parent));
        }
        let end = within(at, DVec3::from_array(position.0) / scale, options)?;
        let radius = girth(at, "radius", radius.filter(|_| parent.is_some()), scale, options.extent)?;
        widths.extend(girth(at, "width", width, scale, 2.0 * options.extent)?.map(|width| (at, width)));
        if let Some(Shed(shed)) = shed.filter(|&Shed(shed)| shed > 0 && parent.is_some()) {
            all_shed += shed;
            if all_shed > MAX_SHED {
                let allowed = format!("up to {MAX_SHED} in a file");
                return Err(out_of_range(member(at as usize, "shed"), "too many twigs were shed", allowed));
            }
            scars.push((at, shed));
        }
        if let Some(Borne(borne)) = metamer.organs.as_ref().filter(|_| parent.is_some()) {
            organs.push((at, borne.clone()));
        }
        let normal = normal.map(|Vector(normal)| Vec3::from_array(normal));
        nodes.push(WoodNode { parent, axis, end, normal, radius, birth });
    }
    let axis = |axis: &Axis| WoodAxis {
        bearer: axis.bearer.map(|Bearer(bearer)| bearer),
        direction: axis.direction.map(|Vector(direction)| Vec3::from_array(direction)),
        has_bud: axis.bud,
    };
    let axes = file.axes.iter().map(axis).collect();
    // Rows without end would be memory without end; where they are closed up leaves turn otherwise.
    if next as usize > options.nodes {
        gaps.clear();
    }
    let wood = Wood { nodes, axes, widths, scars, organs, gaps, buds: DormantBuds::Known };
    let notes = Vec::new();
    Ok(WoodFile { wood, parameters: file.parameters, species: file.species, seed: file.seed, notes })
}

/// Checks what both versions have alike.
fn check(wood: &Wood, options: &WoodOptions) -> Result<(), Fault> {
    limit(wood.nodes.len(), options)?;
    let mut before = 0;
    for (at, node) in wood.nodes.iter().enumerate() {
        // Nothing has grown in the step of the first seed.
        let last = u32::from(node.parent.is_some()).max(before);
        if at == 0 && node.birth > 0 {
            return Err(out_of_range(
                member(at, "birth"),
                format!("it is {}", node.birth),
                "0 for the first",
            ));
        }
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
    fit::check(wood)
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

/// A radius or diameter in internodes, of so many at most; none where it is 0.
fn girth(at: u32, name: &str, metres: Option<Girth>, scale: f64, most: f32) -> Result<Option<f32>, Fault> {
    let Some(Girth(metres)) = metres else { return Ok(None) };
    let internodes = (metres / scale) as f32;
    if internodes > most {
        let allowed = format!("0 to {}", f64::from(most) * scale);
        return Err(out_of_range(member(at as usize, name), format!("it is {metres}"), allowed));
    }
    Ok(Some(internodes).filter(|&internodes| internodes > 0.0))
}
