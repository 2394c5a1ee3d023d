//! Designs from JSON; what is refused names its field and what is allowed there.

use std::collections::{BTreeMap, BTreeSet};

use espalier_reading::{Kind, Refusal as Refused, Unread, value};

use super::{VERSION, json::Json, values::read};
use crate::{
    design::Design,
    edit::{Standing, check_setting, check_value, standing},
    graph::{From, Graph, Level, Name, Owner, Record, Setting, Share, ShareId, Source, Visibility},
    key::{Key, ROWS},
    node::{MAX_ORDER, MAX_ORDINAL, NodeId},
    refusal::{MAX_SHARES, MAX_VALUES, Place, Refusal},
    slots::Slot,
    value::Op,
};

/// Most bytes of a file.
pub const MOST_BYTES: usize = 4 << 20;

impl Design {
    /// Reads what [`Design::to_json`] has written. Where laterals of which something is said have no slots, they are
    /// those that the values of their bearer give, by their numbers in order.
    ///
    /// # Errors
    /// Where the text is too long or no JSON, or a field holds something that is not allowed there.
    pub fn from_json(text: &str) -> Result<Self, Unread> {
        if text.len() > MOST_BYTES {
            return Err(Unread::Refused(Refused {
                field: String::new(),
                kind: Kind::TooMany,
                what: format!("has {} bytes", text.len()),
                allowed: Some(format!("{MOST_BYTES} at most")),
            }));
        }
        let value = value(text)?;
        design(&Json::root(&value)).map_err(Unread::Refused)
    }
}

fn design(json: &Json<'_>) -> Result<Design, Refused> {
    let fields = ["version", "seed", "nodes", "levels", "shares", "laterals"];
    // A later version may have other fields.
    let head = json.any_object()?;
    let version = head.needed("version", "1")?;
    if version.whole(u32::MAX)? != VERSION {
        return Err(version.refused(Kind::Malformed, format!("is {}", version.value), "1"));
    }
    let object = json.object(&fields)?;
    let mut graph = Graph::default();
    if let Some(seed) = object.field("seed") {
        graph.seed = seed.whole(u32::MAX)?;
    }
    if let Some(json) = object.field("shares") {
        graph.shares = shares(&json)?;
    }
    for name in ["levels", "nodes"] {
        if let Some(json) = object.field(name) {
            records(&json, &mut graph)?;
        }
    }
    let values = graph.values();
    if values > MAX_VALUES {
        let whole = Json { path: "nodes".into(), ..json.clone() };
        return Err(whole.refused(
            Kind::TooMany,
            format!("has {values} values"),
            format!("{MAX_VALUES} at most"),
        ));
    }
    for (&id, share) in &graph.shares {
        if graph.members(id).next().is_none() {
            let at = Json { path: format!("shares.{}", id.0), ..json.clone() };
            let allowed = format!("at least one branch of order {} with it", share.level.order());
            return Err(at.refused(Kind::Malformed, "is shared by nobody", allowed));
        }
    }
    if let Some(json) = object.field("laterals") {
        graph.slots = laterals(&json)?;
    }
    let design = Design::of(graph).map_err(|refusal| refused(json, &refusal))?;
    known(design, json)
}

/// What a refusal of the graph is in words of the file.
fn refused(at: &Json<'_>, refusal: &Refusal) -> Refused {
    match refusal {
        Refusal::NotAllowed { fault, .. } => at.not_allowed(fault),
        other => Refused {
            field: at.path.clone(),
            kind: Kind::Malformed,
            what: format!("is refused: {other}"),
            allowed: None,
        },
    }
}

fn shares(json: &Json<'_>) -> Result<BTreeMap<ShareId, Share>, Refused> {
    let object = json.any_object()?;
    if object.len() > MAX_SHARES {
        return Err(json.refused(
            Kind::TooMany,
            format!("has {} fields", object.len()),
            format!("{MAX_SHARES} at most"),
        ));
    }
    let mut shares = BTreeMap::new();
    for (name, json) in object.fields() {
        let number = name.parse().ok().filter(|number: &u32| number.to_string() == name);
        let number = number.ok_or_else(|| json.refused(Kind::Malformed, "is no number", "0, 1, 2 …"))?;
        let share = json.object(&["key", "level", "value"])?;
        let key = key(&share.needed("key", &names())?)?;
        let level = share.needed("level", "1 to 4")?;
        let order = u8::try_from(level.whole(u32::MAX)?).ok();
        let level = order
            .and_then(Level::new)
            .ok_or_else(|| level.refused(Kind::OutOfRange, format!("is {}", level.value), "1 to 4"))?;
        let json = share.needed("value", key.row().kind.described())?;
        let value = read(&json, key.row().kind)?;
        let id = ShareId(number);
        check_value(Place::Share(id), key, &value).map_err(|refusal| refused(&json, &refusal))?;
        shares.insert(id, Share { key, level, value });
    }
    Ok(shares)
}

pub(super) fn names() -> String {
    ROWS.map(|row| row.name).join(", ")
}

pub(super) fn key(json: &Json<'_>) -> Result<Key, Refused> {
    let name = json.text()?;
    Key::named(name).ok_or_else(|| json.refused(Kind::Malformed, format!("is `{name}`"), names()))
}

fn node(name: &str, json: &Json<'_>) -> Result<NodeId, Refused> {
    name.parse().map_err(|fault: espalier_reading::NotAllowed| {
        json.refused(Kind::Malformed, "is no branch", fault.allowed)
    })
}

fn records(json: &Json<'_>, graph: &mut Graph) -> Result<(), Refused> {
    let of_levels = json.path == "levels";
    for (name, json) in json.any_object()?.fields() {
        let owner = if of_levels {
            let level = name.parse().ok().filter(|_| name.len() == 1).and_then(Level::new);
            let allowed = format!("1 to {MAX_ORDER}");
            Owner::Level(level.ok_or_else(|| json.refused(Kind::Malformed, "is no order", allowed))?)
        } else {
            Owner::Node(node(name, &json)?)
        };
        let known: &[&str] = if of_levels { &["values"] } else { &["name", "values"] };
        let object = json.object(known)?;
        let mut record = Record::default();
        if let Some(json) = object.field("name") {
            record.name = Some(Name::new(json.text()?).map_err(|fault| json.not_allowed(&fault))?);
        }
        let values = object.field("values").map(|json| json.any_object()).transpose()?;
        for (name, json) in values.iter().flat_map(|values| values.fields()) {
            let key = Key::named(name)
                .ok_or_else(|| json.refused(Kind::Malformed, "is no known field", names()))?;
            record.settings.insert(key, setting(&json, owner, key, &graph.shares)?);
        }
        if !record.is_empty() {
            graph.records.insert(owner, record);
        }
    }
    Ok(())
}

fn setting(
    json: &Json<'_>,
    owner: Owner,
    key: Key,
    shares: &BTreeMap<ShareId, Share>,
) -> Result<Setting, Refused> {
    let (setting, at) = setting_of(json, key)?;
    if let Source::Shared(id) = setting.source {
        let order = if let Owner::Node(node) = owner { node.order() } else { 0 };
        let fits = shares.get(&id).is_some_and(|share| share.key == key && share.level.order() == order);
        if !fits {
            let allowed = format!("a number of `shares` with key {key} and level {order}");
            return Err(at.refused(Kind::Malformed, format!("is {}", id.0), allowed));
        }
    }
    check_setting(owner, key, &setting).map_err(|refusal| refused(&at, &refusal))?;
    Ok(setting)
}

/// What is said of a parameter, and where its value stands; whether it is allowed there is not looked at.
pub(super) fn setting_of<'a>(json: &Json<'a>, key: Key) -> Result<(Setting, Json<'a>), Refused> {
    const SOURCES: [&str; 5] = ["own", "shared", "add", "multiply", "inherited"];
    let object = json.object(&["own", "shared", "add", "multiply", "inherited", "private", "below"])?;
    let mut sources = SOURCES.into_iter().filter_map(|name| Some((name, object.field(name)?)));
    let one_of = "one field of own, shared, add, multiply, inherited";
    let (name, at) = sources.next().ok_or_else(|| json.refused(Kind::Malformed, "says nothing", one_of))?;
    if let Some((_, second)) = sources.next() {
        return Err(second.refused(Kind::Malformed, "stands beside another", one_of));
    }
    let kind = key.row().kind;
    let source = match name {
        "own" => Source::Explicit(read(&at, kind)?),
        "add" => Source::Relative(Op::Add, read(&at, kind)?),
        "multiply" => Source::Relative(Op::Multiply, read(&at, kind)?),
        "shared" => Source::Shared(ShareId(at.whole(u32::MAX)?)),
        _ => {
            at.mark()?;
            Source::Inherited
        }
    };
    let mut setting = Setting::from(source);
    if let Some(json) = object.field("private") {
        json.mark()?;
        setting.visibility = Visibility::Private;
    }
    if let Some(json) = object.field("below") {
        json.mark()?;
        setting.from = From::Below;
    }
    Ok((setting, at))
}

fn laterals(json: &Json<'_>) -> Result<BTreeMap<NodeId, Vec<Slot>>, Refused> {
    let mut all = BTreeMap::new();
    for (name, json) in json.any_object()?.fields() {
        let bearer = node(name, &json)?;
        let mut slots: Vec<Slot> = Vec::new();
        let mut places = BTreeSet::new();
        for json in json.list("a list of laterals")? {
            let object = json.object(&["number", "home", "azimuth", "anchor", "place"])?;
            let number = object.needed("number", "a whole number")?;
            let ordinal = number.whole(MAX_ORDINAL.into())? as u16;
            if slots.last().is_some_and(|last| last.ordinal >= ordinal) {
                let allowed = "a number above that of the lateral before";
                return Err(number.refused(Kind::Malformed, format!("is {ordinal}"), allowed));
            }
            let share = |name| object.field(name).map(|json: Json<'_>| within(&json, 0.0, 1.0)).transpose();
            let home = share("home")?
                .ok_or_else(|| Refused::missing(&format!("{}.home", json.path), Some("0 to 1".into())))?;
            let anchor = share("anchor")?;
            let azimuth = object.field("azimuth").map(|json| within(&json, -1e6, 1e6)).transpose()?;
            let place = object.field("place");
            let number = place.as_ref().map(|json| json.whole(MAX_ORDINAL.into())).transpose()?;
            if let (Some(json), Some(number)) = (&place, number)
                && !places.insert(number)
            {
                return Err(json.refused(
                    Kind::Malformed,
                    format!("is {number}"),
                    "a place where no other lateral is",
                ));
            }
            slots.push(Slot { ordinal, home, azimuth, anchor, place: number.map(|number| number as u16) });
        }
        if let Some(&last) = places.last().filter(|&&last| last as usize + 1 != places.len()) {
            let allowed = format!("places from 0 to {}, each once", places.len() - 1);
            return Err(json.refused(
                Kind::Malformed,
                format!("has a place {last} and not all below it"),
                allowed,
            ));
        }
        all.insert(bearer, slots);
    }
    Ok(all)
}

pub(super) fn within(json: &Json<'_>, least: f32, most: f32) -> Result<f32, Refused> {
    let number = json.number()?;
    if (least..=most).contains(&number) {
        Ok(number)
    } else {
        Err(json.refused(Kind::OutOfRange, format!("is {number}"), format!("{least} to {most}")))
    }
}

/// Checks that everything that is said is said of a branch, and gives those slots that need them and have none.
fn known(mut design: Design, json: &Json<'_>) -> Result<Design, Refused> {
    let (graph, root) = design.parts();
    let nodes: Vec<NodeId> = graph
        .records
        .keys()
        .filter_map(|owner| if let Owner::Node(node) = owner { Some(*node) } else { None })
        .collect();
    for node in nodes {
        if standing(graph, root, node) == Standing::Unknown {
            let at = Json { path: format!("nodes.{node}"), ..json.clone() };
            return Err(at.refused(Kind::Malformed, "is no branch", "a lateral that its bearer has"));
        }
        for child in node.path() {
            let Some((bearer, ordinal)) = child.bearer() else { continue };
            if let Some(stands) = root.find(bearer) {
                let azimuth = root.find(child).map(|branch| branch.azimuth());
                let slots = graph.slots.entry(bearer).or_insert_with(|| stands.implied_slots());
                for slot in slots.iter_mut().filter(|slot| slot.ordinal == ordinal) {
                    slot.azimuth = slot.azimuth.or(azimuth);
                }
            }
        }
    }
    // Slots that nobody needs would only be in the way.
    let bearers: Vec<NodeId> = graph.slots.keys().rev().copied().collect();
    for bearer in bearers {
        let slots = graph.slots.get(&bearer).map_or(&[][..], Vec::as_slice);
        let is_needed =
            |slot: &Slot| bearer.child(slot.ordinal).is_some_and(|child| graph.is_personal(child));
        if standing(graph, root, bearer) == Standing::Unknown || !slots.iter().any(is_needed) {
            graph.slots.remove(&bearer);
        }
    }
    Design::of(std::mem::take(graph)).map_err(|refusal| refused(json, &refusal))
}
