//! Edits from JSON; what is refused names its field and what is allowed there.

use espalier_reading::{Kind, NotAllowed, Refusal as Refused};
use serde_json::Value;

use super::{
    json::{Json, Object},
    reading::{key, names, setting_of, within},
    values::read,
};
use crate::{
    edit::{Edit, check_setting, check_value},
    graph::{Graph, Level, Name, Owner, ShareId, Source},
    node::NodeId,
    refusal::{Place, Refusal},
};

/// What can be done, by the field `edit`.
const EDITS: &str = "set, clear, name, share, set_shared, anchor, forget, copy, seed";

impl Edit {
    /// Reads an edit of a graph: the graph says of which parameter a shared value is.
    ///
    /// # Errors
    /// Where a field is missing, unknown, or holds something that is not allowed there.
    pub fn from_json(value: &Value, graph: &Graph) -> Result<Self, Refused> {
        let json = Json::root(value);
        let kind = json.any_object()?.needed("edit", EDITS)?;
        let fields: &[&str] = match kind.text()? {
            "set" => &["edit", "of", "key", "value"],
            "clear" => &["edit", "of", "key"],
            "name" => &["edit", "node", "name"],
            "share" => &["edit", "share", "key", "value", "members"],
            "set_shared" => &["edit", "share", "value"],
            "anchor" => &["edit", "node", "at"],
            "forget" => &["edit", "node"],
            "copy" => &["edit", "from", "to"],
            "seed" => &["edit", "seed"],
            other => {
                return Err(kind.refused(Kind::Malformed, format!("is `{other}`"), EDITS));
            }
        };
        let object = json.object(fields)?;
        match kind.text()? {
            "set" => set(&object, graph),
            "clear" => {
                Ok(Self::Clear { owner: owner(&object)?, key: key(&object.needed("key", &names())?)? })
            }
            "name" => {
                let name = object
                    .given("name")
                    .map(|json| Name::new(json.text()?).map_err(|fault| json.not_allowed(&fault)));
                Ok(Self::Name { node: branch(&object, "node")?, name: name.transpose()? })
            }
            "share" => share(&object),
            "set_shared" => {
                let id = object.needed("share", "the number of a shared value")?;
                let share = ShareId(id.whole(u32::MAX)?);
                let known = graph.share(share).ok_or_else(|| {
                    id.refused(Kind::OutOfRange, format!("is {}", share.0), "the number of a shared value")
                })?;
                let json = object.needed("value", known.key.row().kind.described())?;
                let value = read(&json, known.key.row().kind)?;
                check_value(Place::Share(share), known.key, &value)
                    .map_err(|refusal| said(&json, &refusal))?;
                Ok(Self::SetShared { share, value })
            }
            "anchor" => {
                let at = object.given("at").map(|json| within(&json, 0.0, 1.0)).transpose()?;
                Ok(Self::Anchor { node: branch(&object, "node")?, at })
            }
            "forget" => Ok(Self::Forget { node: branch(&object, "node")? }),
            "copy" => Ok(Self::Copy { from: branch(&object, "from")?, to: branch(&object, "to")? }),
            _ => Ok(Self::Seed { seed: object.needed("seed", "a whole number")?.whole(u32::MAX)? }),
        }
    }
}

fn set(object: &Object<'_>, graph: &Graph) -> Result<Edit, Refused> {
    let owner = owner(object)?;
    let key = key(&object.needed("key", &names())?)?;
    let json = object.needed("value", "an object with own, shared, add, multiply or inherited")?;
    let (setting, at) = setting_of(&json, key)?;
    if let Source::Shared(share) = setting.source
        && graph.share(share).is_none()
    {
        return Err(at.refused(Kind::OutOfRange, format!("is {}", share.0), "the number of a shared value"));
    }
    check_setting(owner, key, &setting).map_err(|refusal| said(&at, &refusal))?;
    Ok(Edit::Set { owner, key, setting })
}

fn share(object: &Object<'_>) -> Result<Edit, Refused> {
    let share = ShareId(object.needed("share", "a number that no shared value has")?.whole(u32::MAX)?);
    let key = key(&object.needed("key", &names())?)?;
    let json = object.needed("value", key.row().kind.described())?;
    let value = read(&json, key.row().kind)?;
    check_value(Place::Share(share), key, &value).map_err(|refusal| said(&json, &refusal))?;
    let members = object.needed("members", "a list of branches")?.list("a list of branches")?;
    let members = members.iter().map(named).collect::<Result<_, _>>()?;
    Ok(Edit::Share { share, key, value, members })
}

/// Who an edit is of: a branch, or all of an order.
fn owner(object: &Object<'_>) -> Result<Owner, Refused> {
    let json = object.needed("of", "/, /3, /3/0 … or level 1 to level 4")?;
    match json.text()?.strip_prefix("level ") {
        None => named(&json).map(Owner::Node),
        Some(order) => {
            let level = order.parse().ok().filter(|_| order.len() == 1).and_then(Level::new);
            let refused =
                || json.refused(Kind::OutOfRange, format!("is level {order}"), "level 1 to level 4");
            level.map(Owner::Level).ok_or_else(refused)
        }
    }
}

fn branch(object: &Object<'_>, field: &str) -> Result<NodeId, Refused> {
    named(&object.needed(field, "/, or the way to a branch, as /3 or /3/0")?)
}

fn named(json: &Json<'_>) -> Result<NodeId, Refused> {
    json.text()?.parse().map_err(|fault: NotAllowed| json.not_allowed(&fault))
}

/// A refusal of the graph in words of the field.
fn said(at: &Json<'_>, refusal: &Refusal) -> Refused {
    match refusal {
        Refusal::NotAllowed { fault, .. } => at.not_allowed(fault),
        other => Refused { allowed: None, ..at.refused(Kind::Malformed, format!("is refused: {other}"), "") },
    }
}
