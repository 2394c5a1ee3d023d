//! What stands behind the question mark of an address, and the JSON of a request's body.

use std::fmt::Debug;

use espalier_proto::{
    Problem,
    library::{
        ChangeCollection, ChangeTree, ChangeVersion, CopyTree, NewCollection, NewSession, RestoreVersion,
        SaveTree, SaveVersion,
    },
    reading::{from_json, from_query},
};
use espalier_settings::ParameterValues;
use serde::{Serialize, de::DeserializeOwned};

/// Reads the bytes as the query and as the body of each kind of request; what one takes is written and read again.
pub fn read(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let taken = [
        is_taken::<NewSession>(text),
        is_taken::<SaveTree>(text),
        is_taken::<SaveVersion>(text),
        is_taken::<RestoreVersion>(text),
        is_taken::<CopyTree>(text),
        is_taken::<ChangeTree>(text),
        is_taken::<ChangeVersion>(text),
        is_taken::<NewCollection>(text),
        is_taken::<ChangeCollection>(text),
        are_parameters(text),
    ];
    taken.contains(&true)
}

/// Queries and bodies with numbers, texts, truth values and lists.
pub fn seeds() -> Vec<Vec<u8>> {
    let whole = ParameterValues::default();
    let texts = [
        "seed=5&tree=ash&version=2&template=true".to_owned(),
        "name=A+tall%20tree&author=%C3%84da&version=5".to_owned(),
        r#"{"seed":5,"tree":"ash","version":2,"template":true}"#.to_owned(),
        r#"{"session":"oak","name":"Oak","note":"Pruned","author":"Ada"}"#.to_owned(),
        r#"{"name":"Oak","note":"Old","template":true,"tags":["old","red"],"collection":""}"#.to_owned(),
        serde_json::to_string(&whole).unwrap_or_default(),
    ];
    texts.map(String::into_bytes).to_vec()
}

/// What the type leaves open (a number too large for it is infinite) is checked where parameters are used.
fn are_parameters(text: &str) -> bool {
    let is_finite = |read: Result<ParameterValues, Problem>| read.is_ok_and(|values| values.check().is_ok());
    is_finite(from_json(text)) && is_taken::<ParameterValues>(text)
}

fn is_taken<T: Serialize + DeserializeOwned + PartialEq + Debug>(text: &str) -> bool {
    [from_query::<T>(text), from_json::<T>(text)].into_iter().fold(false, |taken, read| match read {
        Ok(read) => {
            let written = serde_json::to_string(&read).unwrap_or_default();
            assert_eq!(from_json::<T>(&written).as_ref(), Ok(&read), "{written}");
            true
        }
        Err(problem) => {
            check(&problem, text);
            taken
        }
    })
}

/// A refusal says what is allowed where, and does not send back all that came.
fn check(problem: &Problem, text: &str) {
    let Problem { field, allowed, message, .. } = problem;
    let is_whole = message.starts_with("the message");
    assert!(allowed.is_some() && (field.is_some() || is_whole), "{text}: {problem:?}");
    assert!(message.len() < 2000 + 16 * LONGEST_FIELD, "{text}: {problem:?}");
}

/// Bytes of a field's name that a refusal tells again, with the sign that more follows.
const LONGEST_FIELD: usize = 4 * 120 + 8;
