//! Whom comments are for: people, whatever they are called later (`CT7`).

use espalier_proto::comment::{Mention, NewMention};
use serde::{Deserialize, Serialize};

use super::Shared;
use crate::{
    access::Caller,
    live::PersonNamed,
    store::{Comments, StoreError, folded},
};

/// Threads that are looked through for people at a time.
const PAGE: u32 = 200;

/// Somebody whom a comment is for, as the store keeps it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Called {
    /// Of a comment from before people were looked for.
    Name(String),
    /// As they were called, and who they are: nobody, where nobody went by the name.
    People {
        /// As they were called.
        name: String,
        /// As the server knows them.
        people: Vec<String>,
    },
}

impl Called {
    /// As they were called.
    pub fn name(&self) -> &str {
        match self {
            Self::Name(name) | Self::People { name, .. } => name,
        }
    }

    /// As whoever asks is told of it.
    pub(super) fn told(self, caller: &Caller) -> Mention {
        let you = match &self {
            Self::People { people, .. } => people.contains(&caller.person()),
            Self::Name(name) => caller.entrant().name.is_some_and(|own| folded(&own) == folded(name)),
        };
        Mention { name: self.name().to_owned(), you }
    }
}

/// Finds whom a comment is for, among those in the session and those who have written about the tree.
pub(super) async fn found(
    shared: &Shared,
    tree: &str,
    session: Option<&str>,
    mentions: Vec<NewMention>,
) -> Result<Vec<Called>, StoreError> {
    if mentions.is_empty() {
        return Ok(Vec::new());
    }
    let there = match session {
        Some(session) => shared.sessions.named(session).await,
        None => Vec::new(),
    };
    let mut writers = None;
    let mut all = Vec::new();
    for mention in mentions {
        let mut people = among(&there, &mention);
        if people.is_empty() {
            if writers.is_none() {
                writers = Some(written(shared, tree).await?);
            }
            let name = folded(mention.name.as_str());
            let last = writers.iter().flatten().find(|(author, _)| folded(author) == name);
            people.extend(last.map(|(_, person)| person.clone()));
        }
        all.push(Called::People { name: mention.name.into(), people });
    }
    Ok(all)
}

/// The one who is meant by number, else all who have the name.
fn among(there: &[PersonNamed], NewMention { name, person }: &NewMention) -> Vec<String> {
    let wanted = folded(name.as_str());
    let named = there.iter().filter(|(_, _, name)| folded(name) == wanted);
    let one = person.and_then(|person| named.clone().find(|(number, ..)| *number == person));
    match one {
        Some((_, person, _)) => vec![person.to_string()],
        None => named.map(|(_, person, _)| person.to_string()).collect(),
    }
}

/// Who has written about a tree: what they were called, and who they are, who wrote last first.
async fn written(shared: &Shared, tree: &str) -> Result<Vec<(String, String)>, StoreError> {
    let mut written = Vec::new();
    let mut before = None;
    loop {
        let threads = shared.store.threads(tree, PAGE, before).await?;
        before = threads.last().map(|thread| thread.number);
        let is_last = threads.len() < PAGE as usize;
        let comments = threads.into_iter().flat_map(|thread| thread.comments);
        written.extend(comments.map(|comment| (comment.written_at, comment.author, comment.person)));
        if is_last {
            written.sort_by(|(one, ..), (other, ..)| other.cmp(one));
            return Ok(written.into_iter().map(|(_, author, person)| (author, person)).collect());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ct7_of_two_with_one_name_the_number_says_who_is_meant() {
        let there: Vec<PersonNamed> = [(1, "machine", "Ann"), (2, "pass a", "Bo"), (3, "pass b", "bo")]
            .map(|(number, person, name)| -> PersonNamed { (number, person.into(), name.into()) })
            .into();
        let found = |name: &str, person| {
            let name = name.try_into().unwrap();
            among(&there, &NewMention { name, person })
        };
        assert_eq!(found("Bo", Some(3)), ["pass b"]);
        assert_eq!(found("Bo", Some(2)), ["pass a"]);
        assert_eq!(found("BO", None), ["pass a", "pass b"], "nobody says which");
        assert_eq!(found("Ann", Some(2)), ["machine"], "the number is of another session");
        assert_eq!(found("Cy", None), [""; 0]);
    }

    #[test]
    fn what_was_kept_before_people_were_looked_for_is_a_name() {
        let kept: Vec<Called> =
            serde_json::from_str(r#"["Bo", {"name":"Ann","people":["machine"]}]"#).unwrap();
        assert_eq!(kept.iter().map(Called::name).collect::<Vec<_>>(), ["Bo", "Ann"]);
        let told: Vec<bool> = kept.into_iter().map(|one| one.told(&Caller::local()).you).collect();
        assert_eq!(told, [false, true]);
    }
}
