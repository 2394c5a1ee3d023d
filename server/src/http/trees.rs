//! The library: its trees as a whole.

use std::collections::BTreeSet;

use axum::{
    Extension, Json,
    extract::State,
    http::StatusCode,
    response::{IntoResponse, Response},
};
use base64::{Engine, engine::general_purpose::URL_SAFE_NO_PAD};
use espalier_proto::{
    Problem, Reason,
    library::{ChangeTree, CopyTree, ImportNote, Origin, SaveTree, SavedTree, TreePage},
    text::{self, Identifier, Name},
    version::KEPT_DAYS,
};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared, audit,
    failure::{Body, Failure, Path, Query},
    guard::Named,
    limit::Limit,
    revision::{self, Expected},
    versions::{self, Said, Saving},
};
use crate::{
    access::{Action, Caller, Peer},
    name,
    similar::{no_species, similar},
    store::{
        Contents, DONE, Deletion, Finding, Library, NOT_SO_LONG_AGO, NewTree, NewVersion, Sort, StoreError,
        StoredTree, TreeChange, TreePlace, TreeQuery,
    },
    time::{Time, now},
};

/// Trees in one answer.
const MAX_TREES: u32 = 500;
/// Words, or tags, that are searched at once.
const MAX_WORDS: usize = 8;

/// Which trees of the library to list (`LB7`).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Page {
    /// How many at most, 1 to 500.
    #[serde(default)]
    limit: Limit<MAX_TREES>,
    /// The `next` of the page before.
    after: Option<String>,
    /// Those that were deleted, the last first.
    #[serde(default)]
    deleted: bool,
    /// Those that new trees are begun with, or the others.
    template: Option<bool>,
    /// Up to 8 words of up to 80 characters, each found anywhere in the name, a tag, the note or the species; `oak|ash` where either is.
    #[serde(default)]
    q: String,
    /// Up to 8 tags with commas between; a tree has all of them.
    #[serde(default)]
    tags: String,
    /// A collection; an empty text for none.
    collection: Option<Identifier>,
    /// Only favourites of whoever asks.
    #[serde(default)]
    favourite: bool,
    /// The short name of a species.
    species: Option<Identifier>,
    /// Who saved it last.
    author: Option<Name>,
    /// Only those that whoever asks saved last.
    #[serde(default)]
    mine: bool,
    /// The fewest metamers.
    min_metamers: Option<u32>,
    /// The most metamers.
    max_metamers: Option<u32>,
    /// Saved at this time or later: RFC 3339, UTC.
    #[schemars(with = "String")]
    saved_from: Option<Time>,
    /// Saved before this time.
    #[schemars(with = "String")]
    saved_before: Option<Time>,
    /// The order.
    #[serde(default)]
    sort: Order,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
enum Order {
    #[default]
    Newest,
    Oldest,
    Name,
    Largest,
    Smallest,
}

impl Page {
    fn query(self, caller: &Caller) -> Result<TreeQuery, Problem> {
        let words: Vec<String> = self.q.split_whitespace().map(str::to_owned).collect();
        let tags = self.tags.split(',').map(str::trim).filter(|tag| !tag.is_empty());
        let tags: Vec<String> = tags.map(str::to_owned).collect();
        for (field, count) in [("q", words.len()), ("tags", tags.len())] {
            if count > MAX_WORDS {
                let allowed = format!("up to {MAX_WORDS} words");
                let problem = Problem::out_of_range(field, format!("{count} words"), allowed);
                return Err(Problem { reason: Reason::ManyWords, ..problem });
            }
        }
        for word in words.iter().flat_map(|word| word.split('|')).filter(|word| !word.is_empty()) {
            text::name("q", word)?;
        }
        for tag in &tags {
            text::name("tags", tag)?;
        }
        let (least, most) = (self.min_metamers.unwrap_or(0), self.max_metamers.unwrap_or(u32::MAX));
        if most < least {
            return Err(Problem::out_of_range(
                "max_metamers",
                most,
                format!("min_metamers, {least}, or more"),
            ));
        }
        if let (Some(from), Some(before)) = (&self.saved_from, &self.saved_before)
            && before.0 <= from.0
        {
            let allowed = format!("a time after saved_from, {}", from.0);
            return Err(Problem::out_of_range("saved_before", &before.0, allowed));
        }
        let whoever = || Some(caller.person());
        Ok(TreeQuery {
            is_deleted: self.deleted,
            is_template: self.template,
            words,
            tags,
            collection: self.collection.map(String::from).map(Some).map(|id| id.filter(|id| !id.is_empty())),
            favourites_of: self.favourite.then(whoever).flatten(),
            only: caller.only_tree().map(str::to_owned),
            seen_by: (!caller.sees_all() && caller.only_tree().is_none()).then(|| caller.person()),
            species: self.species.map(String::from),
            author: self.author.map(String::from),
            saved_by: self.mine.then(whoever).flatten(),
            metamers: least..=most,
            saved_from: self.saved_from.map(|time| time.0),
            saved_before: self.saved_before.map(|time| time.0),
            sort: match self.sort {
                Order::Newest => Sort::Newest,
                Order::Oldest => Sort::Oldest,
                Order::Name => Sort::Name,
                Order::Largest => Sort::Largest,
                Order::Smallest => Sort::Smallest,
            },
            limit: self.limit.get(),
            after: self.after.as_deref().map(read_place).transpose()?,
        })
    }
}

pub(super) async fn list(
    State(shared): State<Shared>,
    caller: Caller,
    Query(page): Query<Page>,
) -> Result<Json<TreePage>, Failure> {
    let query = page.query(&caller)?;
    let trees = shared.store.trees(&query).await?;
    // Trees of a later program may be of a species that this one does not know.
    let unknown = query.species.as_deref().filter(|_| trees.is_empty()).and_then(no_species);
    if let Some((species, sentence)) = query.species.as_deref().zip(unknown) {
        let allowed = "the short name of a species, as GET /api/v1/species lists them";
        let problem = Problem::out_of_range("species", species, allowed);
        return Err(Problem { message: sentence, ..problem }.into());
    }
    let last = trees.last().filter(|_| trees.len() == query.limit as usize);
    let next = last.map(|tree| write_place(&query.place_of(tree)));
    let favourites = shared.store.favourites(&caller.person()).await?;
    let mut listed = Vec::with_capacity(trees.len());
    for tree in trees {
        listed.push(to_proto(&shared, tree, &favourites).await?);
    }
    Ok(Json(TreePage { trees: listed, next }))
}

/// A place in a list, as whoever lists hands it back unread.
fn write_place(place: &TreePlace) -> String {
    URL_SAFE_NO_PAD.encode(format!("{}\0{}", place.id, place.value))
}

fn read_place(text: &str) -> Result<TreePlace, Problem> {
    let bytes = URL_SAFE_NO_PAD.decode(text).ok();
    let read = bytes.and_then(|bytes| String::from_utf8(bytes).ok());
    let parts = read.as_deref().and_then(|read| read.split_once('\0'));
    let place = parts.map(|(id, value)| TreePlace { id: id.to_owned(), value: value.to_owned() });
    place.ok_or_else(|| {
        Problem::new(Reason::Malformed, "after is not the next of a page")
            .at("after", "the next of the page before")
    })
}

pub(super) async fn find(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
) -> Result<impl IntoResponse, Failure> {
    answer(&shared, &caller, &id).await
}

pub(super) async fn save(
    State(shared): State<Shared>,
    caller: Caller,
    Body(save): Body<SaveTree>,
) -> Result<impl IntoResponse, Failure> {
    let SaveTree { session, name, note, author, thumbnail } = save;
    let version = versions::read(&shared, &caller, Saving { session, note, author, thumbnail }).await?;
    Ok((StatusCode::CREATED, add(&shared, &caller, name.into(), version).await?))
}

pub(super) async fn copy(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
    Body(copy): Body<CopyTree>,
) -> Result<impl IntoResponse, Failure> {
    shared.ask(&caller, Action::SaveTree, Named::Server).await?;
    let said = Said::by(&caller, copy.author, copy.note);
    let version = match copy.version {
        Some(version) => version,
        None => stored(&shared, &id).await?.head.number,
    };
    let contents = Contents::Of { tree: id, version };
    let version = versions::new(&caller, said, contents);
    Ok((StatusCode::CREATED, add(&shared, &caller, copy.name.into(), version).await?))
}

/// Puts a new tree into the library.
pub(super) async fn add(
    shared: &Shared,
    caller: &Caller,
    name: String,
    version: NewVersion,
) -> Result<impl IntoResponse + use<>, Failure> {
    add_noted(shared, caller, name, version, Vec::new()).await
}

/// The same with what is to be known of the file that it was made of (`IM3`).
pub(super) async fn add_noted(
    shared: &Shared,
    caller: &Caller,
    name: String,
    version: NewVersion,
    notes: Vec<ImportNote>,
) -> Result<impl IntoResponse + use<>, Failure> {
    let id = name::unguessable();
    shared.store.add_tree(NewTree { id: id.clone(), name, version }).await?;
    shared.ahead.add(&id, 1);
    answer_noted(shared, caller, &id, notes).await
}

pub(super) async fn change(
    State(shared): State<Shared>,
    caller: Caller,
    peer: Option<Extension<Peer>>,
    Path(id): Path<String>,
    Expected(expected): Expected,
    Body(change): Body<ChangeTree>,
) -> Result<impl IntoResponse, Failure> {
    let change = TreeChange {
        name: change.name.map(String::from),
        note: change.note.map(String::from),
        is_template: change.template,
        tags: change.tags.map(Vec::from),
        collection: change.collection.map(Some).map(|id| id.filter(|id| !id.is_empty())),
        ..TreeChange::default()
    };
    let (role, _) = shared.role_at(&caller, Named::Tree(&id)).await?;
    let moved = match &change.collection {
        None => None,
        Some(to) => {
            let from = stored(&shared, &id).await?.collection;
            let is_seen_by_others = shared.ask_to_move(&caller, role, from.as_deref(), to.as_deref()).await?;
            is_seen_by_others.then(|| format!("{id}/{}", to.as_deref().unwrap_or_default()))
        }
    };
    shared.store.change_tree(&id, expected, change).await?;
    if let Some(moved) = moved {
        let (who, peer) = (audit::called(&caller), peer.map(|Extension(peer)| peer));
        shared.note(who, peer, audit::MOVE, Some(moved), DONE.into()).await;
    }
    // Whoever was given what lies in a collection may have it no longer, or from now on.
    shared.tell_standings();
    answer(&shared, &caller, &id).await
}

pub(super) async fn delete(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
) -> Result<StatusCode, Failure> {
    let deletion = Some(Deletion::Deleted(now()));
    shared.store.change_tree(&id, expected, TreeChange { deletion, ..TreeChange::default() }).await?;
    // Whoever came by a link, or was given it, is let out of its sessions.
    shared.tell_standings();
    Ok(StatusCode::NO_CONTENT)
}

/// A tree that was deleted goes at once; its room on the disk follows. Nobody can take that back, so that it is not for
/// whoever owns that tree alone (`AC18`, `AC22`).
pub(super) async fn delete_for_good(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
    Expected(expected): Expected,
) -> Result<StatusCode, Failure> {
    if !caller.owns_all() {
        let sentence = format!(
            "Owners of the server alone delete a tree for good; a deleted one goes by itself after {KEPT_DAYS} days."
        );
        return Err(Problem::new(Reason::Forbidden, sentence)
            .at("tree", "a tree to delete, or to take back")
            .into());
    }
    let deletion = Some(Deletion::ForGood);
    shared.store.change_tree(&id, expected, TreeChange { deletion, ..TreeChange::default() }).await?;
    shared.store.purge(NOT_SO_LONG_AGO, 1).await?;
    shared.tidying.notify_one();
    Ok(StatusCode::NO_CONTENT)
}

pub(super) async fn undelete(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
    Expected(expected): Expected,
) -> Result<impl IntoResponse, Failure> {
    let deletion = Some(Deletion::Undeleted);
    shared.store.change_tree(&id, expected, TreeChange { deletion, ..TreeChange::default() }).await?;
    answer(&shared, &caller, &id).await
}

/// A tree as it is now.
async fn answer(shared: &Shared, caller: &Caller, id: &str) -> Result<impl IntoResponse + use<>, Failure> {
    answer_noted(shared, caller, id, Vec::new()).await
}

async fn answer_noted(
    shared: &Shared,
    caller: &Caller,
    id: &str,
    import_notes: Vec<ImportNote>,
) -> Result<impl IntoResponse + use<>, Failure> {
    let tree = stored(shared, id).await?;
    let favourites = shared.store.favourites(&caller.person()).await?;
    let revision = revision::tag(tree.revision);
    let told = to_proto(shared, tree, &favourites).await?;
    Ok((revision, Json(SavedTree { import_notes, ..told })))
}

/// Trees that are looked through for one that may have been meant: the newest.
const LOOKED_THROUGH: u32 = 500;

/// The trees among which one may be that was meant.
pub(super) async fn mistakable(shared: &Shared) -> Result<Vec<StoredTree>, StoreError> {
    shared.store.trees(&TreeQuery { limit: LOOKED_THROUGH, ..TreeQuery::default() }).await
}

/// The question whether another tree was meant, where it was found among these by its identifier or its name.
pub(super) fn meant(trees: &[StoredTree], found: &str) -> String {
    let tree = trees.iter().find(|tree| tree.id == found || tree.name == found);
    let named = tree.map(|StoredTree { id, name, .. }| format!("{id}, which is called {name:?}"));
    format!("; did you mean {}?", named.as_deref().unwrap_or(found))
}

/// What whoever names no tree is told: also which one they may have meant, by its identifier or its name. None where
/// no name is alike, or nobody can say.
pub(super) async fn no_such(shared: &Shared, id: &str) -> Option<Response> {
    let trees = mistakable(shared).await.ok()?;
    let known = trees.iter().flat_map(|tree| [&*tree.id, &*tree.name]);
    let meant = meant(&trees, similar(id, known)?);
    Some(Failure::no_tree(&meant).into_response())
}

pub(super) async fn stored(shared: &Shared, id: &str) -> Result<StoredTree, Failure> {
    shared.store.tree(id).await?.ok_or_else(|| Failure::no_tree(""))
}

/// How many people are working on a tree: those in the session it was saved from last, unless that has become another
/// tree since (`LB3`).
async fn people_on(shared: &Shared, tree: &StoredTree) -> Result<u32, Failure> {
    let Some(session) = &tree.session else { return Ok(0) };
    let people = shared.sessions.people(session).await.len() as u32;
    let is_theirs = people > 0 && shared.store.tree_of(session).await?.is_some_and(|of| of.id == tree.id);
    Ok(if is_theirs { people } else { 0 })
}

async fn to_proto(
    shared: &Shared,
    tree: StoredTree,
    favourites: &BTreeSet<String>,
) -> Result<SavedTree, Failure> {
    let people = people_on(shared, &tree).await?;
    let head = tree.head;
    Ok(SavedTree {
        import_notes: Vec::new(),
        thumbnail: versions::thumbnail_of(&tree.id, head.number),
        favourite: favourites.contains(&tree.id),
        id: tree.id,
        name: tree.name,
        note: tree.note,
        version: head.number,
        metamers: head.metamers,
        saved_at: head.saved_at,
        author: head.author,
        species: head.species,
        created_at: tree.created_at,
        template: tree.is_template,
        tags: tree.tags,
        collection: tree.collection,
        origin: tree.origin.map(|(tree, version)| Origin { tree, version }),
        deleted_at: tree.deleted_at,
        people,
        revision: tree.revision,
    })
}
