//! JSON from outside read into types; what is refused names its field and what is allowed there.
//!
//! Every type says in its `expecting` text, or in the `allowed` of a [`NotAllowed`], what it takes. A path-tracking
//! deserialiser says where. Nothing else knows the fields, so there is no second schema to keep.

mod bounded;
mod by_name;
mod fault;
mod once;

use serde::de::DeserializeOwned;
use serde_json::{Value, error::Category};

pub use self::{
    bounded::{Between, Bounded},
    fault::{Fault, Kind, NotAllowed, Refusal, joined, plain, shortened},
    once::value,
};
use crate::by_name::ByName;

/// Reads a JSON value.
///
/// # Errors
///
/// Where it is not what the type takes; the first such place.
pub fn from_value<T: DeserializeOwned>(value: &Value) -> Result<T, Fault> {
    serde_path_to_error::deserialize(ByName(value)).map_err(Fault::from)
}

/// Why bytes cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unread {
    /// They are no JSON.
    NotJson {
        /// The line, counted from 1.
        line: u64,
        /// The byte of that line, counted from 1.
        column: u64,
        /// What is wrong there.
        what: String,
    },
    /// They are JSON that the type does not take.
    Refused(Refusal),
}

/// Reads JSON as it comes, without holding more of it than the type does.
///
/// # Errors
///
/// Where the bytes are no JSON, or a value is not what the type takes.
pub fn from_slice<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, Unread> {
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let error = match T::deserialize(ByName(&mut json)).and_then(|read| json.end().map(|()| read)) {
        Ok(read) => return Ok(read),
        Err(error) => error,
    };
    // To follow the path takes time, which only what is refused need cost.
    let again = || {
        let mut json = serde_json::Deserializer::from_slice(bytes);
        serde_path_to_error::deserialize::<_, T>(ByName(&mut json)).err()
    };
    match (error.classify(), again()) {
        (Category::Data, Some(error)) => Err(Unread::Refused(refusal::<T>(error.into()))),
        _ => Err(Unread::NotJson {
            line: error.line() as u64,
            column: error.column() as u64,
            what: fault::without_place(&error.to_string()).to_owned(),
        }),
    }
}

/// What a fault says of a type, of which a field that is missing says in its place what may stand there.
fn refusal<T: DeserializeOwned>(fault: Fault) -> Refusal {
    let Some(name) = fault.missing() else { return fault.refusal() };
    let field = joined(fault.path(), name);
    let nothing = fault::steps(&field).into_iter().rev().fold(Value::Null, |inner, step| match step {
        fault::Step::Field(name) => Value::Object([(name.to_owned(), inner)].into_iter().collect()),
        fault::Step::Entry => Value::Array(vec![inner]),
    });
    let told =
        from_value::<T>(&nothing).err().filter(|told| fault::steps(told.path()) == fault::steps(&field));
    Refusal::missing(&field, told.and_then(|told| told.refusal().allowed))
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Deserialize)]
    struct Tree {
        #[serde(rename = "metamers")]
        _metamers: Vec<Metamer>,
        #[serde(rename = "top", default)]
        _top: Option<Metamer>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "snake_case")]
    enum Side {
        Left,
        Right,
    }

    #[derive(Debug, Deserialize)]
    struct Leaf {
        #[serde(rename = "side")]
        _side: Side,
    }

    /// Whether a name is missing or is none, it is told which names there are.
    #[test]
    fn a_name_that_is_none_is_told_all_names() {
        for (value, what) in [
            (serde_json::json!({ "side": "top" }), "is top"),
            (serde_json::json!({ "side": null }), "cannot be read: invalid type: null"),
            (serde_json::json!({ "side": 5 }), "cannot be read: invalid type: integer `5`"),
            (serde_json::json!({ "side": [] }), "cannot be read: invalid type: sequence"),
        ] {
            let refusal = from_value::<Leaf>(&value).unwrap_err().refusal();
            assert_eq!((&*refusal.field, &*refusal.what), ("side", what));
            assert_eq!(refusal.allowed.as_deref(), Some("left, right"), "{value}");
        }
    }

    #[derive(Debug, Deserialize)]
    struct Metamer {
        #[serde(rename = "parent")]
        _parent: Option<u32>,
        #[serde(rename = "place")]
        _place: [f64; 2],
        #[serde(rename = "dead")]
        _dead: bool,
    }

    fn refused(text: &str) -> (String, Option<String>) {
        match from_slice::<Tree>(text.as_bytes()) {
            Err(Unread::Refused(refusal)) => (refusal.field, refusal.allowed),
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn what_is_refused_has_its_path_and_what_is_allowed() {
        for (text, field, allowed) in [
            ("[]", "", "an object"),
            ("5", "", "an object"),
            ("{}", "metamers", "a list"),
            (r#"{"metamers":{}}"#, "metamers", "a list"),
            (r#"{"metamers":[[null,[0,0],true]]}"#, "metamers[0]", "an object"),
            (r#"{"metamers":[],"top":[null,[0,0],true]}"#, "top", "an object"),
            (
                r#"{"metamers":[{"place":[0,0],"dead":true},{"place":[0,0]}]}"#,
                "metamers[1].dead",
                "true, false",
            ),
            (r#"{"metamers":[{"place":[0,"x"],"dead":true}]}"#, "metamers[0].place[1]", "a number"),
            (r#"{"metamers":[{"place":[0],"dead":true}]}"#, "metamers[0].place", "a list of 2 entries"),
            (r#"{"metamers":[{"dead":true,"dead":true}]}"#, "metamers[0].dead", "once"),
            (r#"{"metamers":[{"parent":-1}]}"#, "metamers[0].parent", "a whole number from 0 to 4294967295"),
        ] {
            assert_eq!(refused(text), (field.to_owned(), Some(allowed.to_owned())), "{text}");
        }
    }

    #[test]
    fn what_is_no_json_has_its_place() {
        for (text, line, column) in
            [("", 1, 0), ("{\n\"metamers\":[}", 2, 13), (r#"{"metamers":[]}x"#, 1, 16)]
        {
            let found = from_slice::<Tree>(text.as_bytes());
            let Err(Unread::NotJson { line: at, column: of, what }) = found else {
                panic!("{text}: {found:?}")
            };
            assert_eq!((at, of), (line, column), "{text}: {what}");
            assert!(!what.contains(" line "), "{what}");
        }
    }
}
