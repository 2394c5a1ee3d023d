//! What holds for every request: who asks, how long it may take, what the browser may do with the answer.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use axum::{
    extract::{FromRequestParts, RawPathParams, Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, header, request::Parts},
    middleware::Next,
    response::{IntoResponse, Response},
};

use espalier_proto::{Problem, Reason, access::Role};
use espalier_session::Principal;

use super::{
    Shared,
    audit::{self, Made},
    failure::{Failure, NoTree},
    keys::Repeated,
    removals, trees,
};
use crate::{
    access::{Action, Caller, Object, Peer, Rate, SecretHash},
    store::{EXPORT, Finding, Gift, Gifts, Library, Missing, Room, Standing, Standings, StoreError},
    time::now,
};

/// What is noted and not counted, for it takes from nobody else and gives nothing away: it protects.
const PROTECTIVE: [&str; 8] =
    ["token-revoke", "password", "remove", "unlink", "take-back", "lock", "delete-comment", "review"];

/// The key of the client that asks, as in its hello.
pub(super) const CLIENT: HeaderName = HeaderName::from_static("espalier-client");

/// A request whose body or answer takes longer is dropped.
pub(super) const TIME_LIMIT: Duration = Duration::from_secs(30);

/// What somebody does in ten minutes that is noted on the list of what was done.
const NOTED_OF: u32 = 60;
const NOTED_TIME: Duration = Duration::from_mins(10);

/// How much of what is noted was done, by whom (`AC10`): the list is bounded, and nobody fills it alone.
#[derive(Debug)]
pub struct NotedDone(Rate<SecretHash>);

impl Default for NotedDone {
    fn default() -> Self {
        Self(Rate::new(NOTED_OF, NOTED_TIME))
    }
}

/// Scripts come from this server only. Styles may stand in the page, pictures may be made by the page itself.
const CONTENT_SECURITY_POLICY: &str = "default-src 'self'; \
    script-src 'self'; \
    style-src 'self' 'unsafe-inline'; \
    img-src 'self' data: blob:; \
    connect-src 'self' data: blob:; \
    worker-src 'self' blob:; \
    object-src 'none'; \
    base-uri 'none'; \
    form-action 'self'; \
    frame-ancestors 'none'";

/// A session's link is its key, so it must not travel to other sites as a referrer.
const HEADERS: [(HeaderName, HeaderValue); 5] = [
    (header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(CONTENT_SECURITY_POLICY)),
    (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    (header::REFERRER_POLICY, HeaderValue::from_static("same-origin")),
    (HeaderName::from_static("cross-origin-opener-policy"), HeaderValue::from_static("same-origin")),
    (HeaderName::from_static("cross-origin-resource-policy"), HeaderValue::from_static("same-origin")),
];

pub(super) async fn headers(mut response: Response) -> Response {
    for (name, value) in HEADERS {
        // What is stricter was said by whoever answers.
        response.headers_mut().entry(name).or_insert(value);
    }
    // Answers of the API change all the time; whoever knows better has said so.
    response.headers_mut().entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    response
}

pub(super) async fn within(limit: Duration, request: Request, next: Next) -> Response {
    match tokio::time::timeout(limit, next.run(request)).await {
        Ok(response) => response,
        Err(_) => Failure::new(Reason::Late, "The request took too long.").into_response(),
    }
}

/// What is asked for at an address.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    pub(super) shared: Shared,
    pub(super) action: Action,
    /// How the list of what was done calls it, if it is noted there.
    pub(super) noted: Option<&'static str>,
}

/// What a request names.
#[derive(Clone, Copy, Debug)]
pub(super) enum Named<'a> {
    /// Nothing but the server.
    Server,
    /// The session of this name.
    Session(&'a str),
    /// The saved tree with this identifier.
    Tree(&'a str),
}

/// Finds out who asks, and whether they may do what this address does to what it names.
pub(super) async fn ask(
    State(Asked { shared, action, noted }): State<Asked>,
    params: RawPathParams,
    request: Request,
    next: Next,
) -> Response {
    let (mut parts, body) = request.into_parts();
    let caller = match Caller::from_request_parts(&mut parts, &shared).await {
        Ok(caller) => caller,
        Err(failure) => return failure.into_response(),
    };
    let note = noted.map(|noted| {
        let object = params.iter().map(|(_, value)| value).collect::<Vec<_>>().join("/");
        (noted, object, audit::called(&caller), parts.extensions.get::<Peer>().copied())
    });
    let asked = async {
        let named = |name| params.iter().find(|(other, _)| *other == name).map(|(_, value)| value);
        let named = named("session").map(Named::Session).or_else(|| named("tree").map(Named::Tree));
        shared.ask(&caller, action, named.unwrap_or(Named::Server)).await?;
        if noted.is_some_and(|noted| noted != EXPORT && !PROTECTIVE.contains(&noted)) {
            shared.count_noted(&caller, action)?;
        }
        Ok::<_, Failure>(principal(&parts.headers)?)
    };
    let response = match asked.await {
        Ok(principal) => {
            // Guests are told of no tree but theirs.
            let sees_all = caller.sees_all();
            parts.extensions.insert(caller);
            parts.extensions.insert(principal);
            let response = next.run(Request::from_parts(parts, body)).await;
            let tree = params.iter().find(|(name, _)| *name == "tree").map(|(_, id)| id);
            match tree.filter(|_| sees_all && response.extensions().get::<NoTree>().is_some()) {
                Some(id) => trees::no_such(&shared, id).await.unwrap_or(response),
                None => response,
            }
        }
        Err(failure) => failure.into_response(),
    };
    // What was answered again was noted when it was done.
    let note = note.filter(|_| response.extensions().get::<Repeated>().is_none());
    if let Some((noted, mut object, who, peer)) = note {
        if let Some(Made(id)) = response.extensions().get() {
            object = format!("{object}/{id}");
        }
        shared.note(who, peer, noted, Some(object), audit::outcome(response.status())).await;
    }
    response
}

impl FromRequestParts<Shared> for Caller {
    type Rejection = Failure;

    async fn from_request_parts(parts: &mut Parts, shared: &Shared) -> Result<Self, Failure> {
        if let Some(caller) = parts.extensions.get::<Self>() {
            return Ok(caller.clone());
        }
        let peer = parts.extensions.get::<Peer>().copied();
        Ok(Self::of(&parts.headers, peer, shared.trusts_local, &*shared.store).await?)
    }
}

impl Shared {
    /// Whether somebody may do something to what a request names, in its address or in its body.
    pub(super) async fn ask(&self, caller: &Caller, action: Action, named: Named<'_>) -> Result<(), Failure> {
        let tree;
        let object = match named {
            Named::Server => Object::Server,
            Named::Tree(id) => Object::Tree(id),
            // To whom all trees are open it is the same which one it is.
            Named::Session(_) if caller.only_tree().is_none() => Object::Loose,
            Named::Session(name) => {
                tree = self.store.tree_of(name).await?;
                tree.as_ref().map_or(Object::Loose, |tree| Object::Tree(&tree.id))
            }
        };
        let (role, standing) = self.role_at(caller, named).await?;
        if let Some(removed) = standing.removed {
            return Err(removals::problem(&removed).into());
        }
        match named {
            // They may not know of it.
            Named::Tree(_) if role == Role::None => return Err(Failure::no_tree("")),
            Named::Session(_) if role == Role::None => return Err(Failure::no_session()),
            _ => {}
        }
        if !caller.may_as(role, action, object) {
            return Err(espalier_session::forbidden().into());
        }
        // Who may do less is refused already, and owners are not locked out.
        match standing.locked_by.filter(|_| role.under_lock() < action.least()) {
            None => Ok(()),
            Some(by) => Err(Problem::new(Reason::TreeLocked, format!("{by} has locked the tree."))
                .at("tree", "a tree that is not locked")
                .into()),
        }
    }

    /// What somebody may do with what a request names: the greatest of what they may on the server, what they were given
    /// and what was handed over to them; and how they stand with it.
    pub(super) async fn role_at(
        &self,
        caller: &Caller,
        named: Named<'_>,
    ) -> Result<(Role, Standing), StoreError> {
        let room = match named {
            // Owners of all trees are neither locked nor kept out of one.
            _ if caller.owns_all() => return Ok((caller.role(), Standing::default())),
            Named::Server => return Ok((caller.role(), Standing::default())),
            Named::Tree(id) => Room::Tree(id),
            Named::Session(name) => Room::Session(name),
        };
        let person = caller.person();
        let standing = self.store.standing(room, &person, &now()).await?;
        let given = if standing.is_heir { Role::Owner } else { self.store.role_given(room, &person).await? };
        Ok((caller.role_in(room, given, &standing), standing))
    }

    /// Counts something that is noted (`AC10`) and protects nobody. Tokens are everybody's own; what else owners of all trees do, they may do as
    /// often as they like.
    fn count_noted(&self, caller: &Caller, action: Action) -> Result<(), Failure> {
        let is_counted = action == Action::MakeToken || !caller.owns_all();
        let Some(by) = caller.counted_as().filter(|_| is_counted) else { return Ok(()) };
        let counted = self.noted_done.0.count(by, Instant::now());
        counted.map_err(|wait| Failure::too_often("path", "That was done too often.", wait))
    }

    /// Which were given to anybody of a collection and those that it lies in.
    async fn given_above(&self, collection: Option<&str>) -> Result<BTreeSet<String>, StoreError> {
        let all = self.store.collections().await?;
        let (mut next, mut given) = (collection, BTreeSet::new());
        while let Some(id) = next {
            if !self.store.given(Gift::Collection(id)).await?.is_empty() {
                given.insert(id.to_owned());
            }
            next =
                all.iter().find(|collection| collection.id == id).and_then(|found| found.parent.as_deref());
        }
        Ok(given)
    }

    /// Whether somebody may have something lie in a collection, or in none, instead of where it lies, and so be seen by
    /// those to whom that was given, and no longer by others: all trees are theirs, or it is seen by the same people; they
    /// see the collection themselves, and may do no more with it then than they may already. Says whether others see it
    /// then.
    pub(super) async fn ask_to_move(
        &self,
        caller: &Caller,
        role: Role,
        from: Option<&str>,
        collection: Option<&str>,
    ) -> Result<bool, Failure> {
        let there = match collection {
            Some(collection) => self.store.role_in(collection, &caller.person()).await?,
            None => Role::None,
        };
        if collection.is_some() && there == Role::None && !caller.sees_all() {
            return Err(Missing::Collection.into());
        }
        let (given, given_before) = (self.given_above(collection).await?, self.given_above(from).await?);
        if !caller.owns_all() && !given.is_subset(&given_before) {
            let sentence =
                "That collection was given to people: only owners of the server can put this there.";
            let allowed = "a collection that was given to nobody who does not see this already";
            return Err(Problem::new(Reason::Forbidden, sentence).at("collection", allowed).into());
        }
        if !caller.owns_all() && !given_before.is_subset(&given) {
            let sentence = "The collection where this lies was given to people: only owners of the server can take it away.";
            let allowed = "a collection that was given to all who see this already";
            return Err(Problem::new(Reason::Forbidden, sentence).at("collection", allowed).into());
        }
        if there <= role {
            return Ok(given != given_before);
        }
        let sentence = "You may do more with what lies in that collection than with this.";
        let allowed = "a collection with which you may do no more";
        Err(Problem::new(Reason::Forbidden, sentence).at("collection", allowed).into())
    }
}

fn principal(headers: &HeaderMap) -> Result<Principal, Problem> {
    let Some(key) = headers.get(CLIENT) else { return Ok(Principal::visitor()) };
    key.to_str().ok().and_then(Principal::client).ok_or_else(|| {
        Problem::new(Reason::Malformed, "The request cannot be read: its client key is none.")
            .at(CLIENT.as_str(), Principal::KEYS)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_client_key_that_is_none_is_named_with_what_is_allowed() {
        let headers = HeaderMap::from_iter([(CLIENT, HeaderValue::from_static("seven_7"))]);
        let problem = principal(&headers).expect_err("it is too short");
        assert_eq!((problem.field.as_deref(), problem.allowed.is_some()), (Some("espalier-client"), true));
    }
}
