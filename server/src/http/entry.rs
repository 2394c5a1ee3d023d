//! The door: coming in by an invitation or a password, as whom one is in, and going out.

use std::{
    net::IpAddr,
    time::{Duration, Instant, SystemTime},
};

use axum::{
    Extension, Json,
    extract::State,
    http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_proto::{
    Problem, Reason,
    access::{Admitted, Entrance, LogIn, Me, Redeem, Way},
    version::MAX_NAME_CHARACTERS,
};

use super::{
    Shared, audit,
    failure::{Body, Failure},
};
use crate::{
    access::{self, Caller, Peer, Rate, Secret, SecretHash, admission, cookie, network},
    store::{Missing, Pass, Passes, StoreError, User, Users, folded},
    time::now,
};

/// Right logins from one network in ten minutes: a class may come in together.
const LOGINS_FROM: u32 = 100;
/// Right logins of one user in ten minutes.
const LOGINS_OF: u32 = 20;
const LOGINS_TIME: Duration = Duration::from_mins(10);
const TOO_MANY: &str = "There were too many tries.";

/// How often people have logged in (`AC11`): each login is kept, and who logs in without end would fill the database.
#[derive(Debug)]
pub struct Logins {
    from: Rate<IpAddr>,
    of: Rate<SecretHash>,
}

impl Default for Logins {
    fn default() -> Self {
        Self { from: Rate::new(LOGINS_FROM, LOGINS_TIME), of: Rate::new(LOGINS_OF, LOGINS_TIME) }
    }
}

impl Logins {
    fn count(&self, from: IpAddr, by_name: SecretHash, now: Instant) -> Result<(), Duration> {
        self.from.count(from, now)?;
        self.of.count(by_name, now)
    }
}

/// Has the browser of whoever came in keep their cookie.
type Welcome = (Option<[(HeaderName, HeaderValue); 1]>, Json<Admitted>);

/// Makes a device of whoever has the secret of an invitation (`AC3`).
pub(super) async fn redeem(
    State(shared): State<Shared>,
    peer: Option<Extension<Peer>>,
    headers: HeaderMap,
    Body(Redeem { secret }): Body<Redeem>,
) -> Result<Welcome, Response> {
    let peer = peer.map(|Extension(peer)| peer);
    let from = network(access::address(peer.as_ref()));
    shared.tries.count(from, Instant::now()).map_err(|wait| too_often("secret", wait))?;
    let redeemed = admission::redeem(&*shared.store, &secret, SystemTime::now()).await;
    let come = redeemed.map_err(Failure::from).and_then(|come| come.ok_or_else(no_invitation));
    let name = come.as_ref().map_or("", |(_, pass)| &*pass.name);
    note(&shared, Way::Device, name, peer, "come-in", passed(&come)).await;
    let welcome = welcome(come.map_err(Failure::into_response)?, &headers);
    shared.tries.forget(from);
    Ok(welcome)
}

/// Lets in whoever has a user's password (`AC9`).
pub(super) async fn log_in(
    State(shared): State<Shared>,
    peer: Option<Extension<Peer>>,
    headers: HeaderMap,
    Body(LogIn { name, password }): Body<LogIn>,
) -> Result<Welcome, Response> {
    let peer = peer.map(|Extension(peer)| peer);
    let name = name.trim();
    let tried = Tried::count(&shared, peer, name, Instant::now()).map_err(Failure::into_response)?;
    let user = check(&shared, name, "password", &password).await;
    if user.is_ok() {
        let counted = shared.logins.count(tried.from, tried.by_name, Instant::now());
        counted.map_err(|wait| too_often("password", wait))?;
    }
    let come = match user {
        Ok(user) => let_in(&shared, user).await,
        Err(failure) => Err(failure),
    };
    note(&shared, Way::Login, name, peer, "log-in", passed(&come)).await;
    let come = come.map_err(Failure::into_response)?;
    tried.was_right(&shared);
    Ok(welcome(come, &headers))
}

/// A try of a password (`AC7`), which is counted where it comes from and for the name.
#[derive(Debug)]
pub(super) struct Tried {
    from: IpAddr,
    by_name: SecretHash,
}

impl Tried {
    /// Counts one, unless it comes too soon.
    pub(super) fn count(
        shared: &Shared,
        peer: Option<Peer>,
        name: &str,
        now: Instant,
    ) -> Result<Self, Failure> {
        let from = network(access::address(peer.as_ref()));
        let by_name = access::hash(&folded(name));
        let counted = shared.tries.count(from, now).and_then(|()| shared.tries_for.count(by_name, now));
        counted.map_err(|wait| Failure::too_often("password", TOO_MANY, wait))?;
        Ok(Self { from, by_name })
    }

    /// It was the right one.
    pub(super) fn was_right(&self, shared: &Shared) {
        shared.tries.forget(self.from);
        shared.tries_for.forget(self.by_name);
    }
}

/// The user with this password, which a field has.
pub(super) async fn check(shared: &Shared, name: &str, field: &str, password: &str) -> Result<User, Failure> {
    let user = shared.store.user(name).await?;
    let kept = user.as_ref().map(|user| user.password.clone());
    let is_right = shared.passwords.is_right(password, kept).await;
    user.filter(|_| is_right).ok_or_else(|| wrong_password(field))
}

/// Lets in somebody whose password was checked, if it is theirs still.
pub(super) async fn let_in(shared: &Shared, user: User) -> Result<(Secret, Pass), Failure> {
    let (id, password) = (user.id.clone(), user.password.clone());
    let come = match admission::log_in(&*shared.store, user, SystemTime::now()).await {
        // They were removed just now.
        Err(StoreError::NotFound(Missing::User)) => return Err(wrong_password("password")),
        come => come?,
    };
    // Another password ends the logins that there are; this one may have come right after.
    if shared.store.users().await?.iter().any(|user| user.id == id && user.password == password) {
        return Ok(come);
    }
    shared.store.take_pass(&come.1.id).await?;
    Err(wrong_password("password"))
}

/// Ends what a browser came in by.
pub(super) async fn log_out(
    State(shared): State<Shared>,
    peer: Option<Extension<Peer>>,
    headers: HeaderMap,
) -> Result<impl IntoResponse, Failure> {
    if let Some(cookie) = cookie::of(&headers)
        && let Some(pass) = shared.store.pass(cookie, &now()).await?
    {
        shared.store.take_pass(&pass.id).await?;
        let peer = peer.map(|Extension(peer)| peer);
        note(&shared, access::way_of(pass.kind), &pass.name, peer, "log-out", Ok(&pass)).await;
    }
    Ok((set(cookie::forgetting(&headers)), StatusCode::NO_CONTENT))
}

/// Says what one can come in by.
pub(super) async fn entrance(State(shared): State<Shared>) -> Result<Json<Entrance>, Failure> {
    Ok(Json(Entrance { passwords: !shared.store.users().await?.is_empty() }))
}

/// Says who asks.
pub(super) async fn me(caller: Caller) -> Json<Me> {
    Json(caller.described())
}

/// By which pass somebody came in, or what they were answered.
fn passed(come: &Result<(Secret, Pass), Failure>) -> Result<&Pass, StatusCode> {
    come.as_ref().map(|(_, pass)| pass).map_err(Failure::status)
}

/// Notes that somebody came, went or tried to (`AC10`), and with which pass: a link keeps its identifier.
async fn note(
    shared: &Shared,
    way: Way,
    name: &str,
    peer: Option<Peer>,
    action: &str,
    pass: Result<&Pass, StatusCode>,
) {
    let outcome = audit::outcome(pass.err().unwrap_or(StatusCode::OK));
    let object =
        pass.ok().map(|pass| pass.tree.iter().chain([&pass.id]).cloned().collect::<Vec<_>>().join("/"));
    let name: String = name.chars().take(MAX_NAME_CHARACTERS).collect();
    shared.note(format!("{} {name}", way.name()).trim_end().to_owned(), peer, action, object, outcome).await;
}

fn too_often(field: &str, wait: Duration) -> Response {
    Failure::too_often(field, TOO_MANY, wait).into_response()
}

fn no_invitation() -> Failure {
    let sentence = "This invitation was used, has expired, or never was.";
    Problem::new(Reason::NoInvitation, sentence)
        .at("secret", "the secret of an invitation not used yet")
        .into()
}

fn wrong_password(field: &str) -> Failure {
    Problem::new(Reason::WrongPassword, "The name or the password is wrong.")
        .at(field, "the password of the user with this name")
        .into()
}

fn welcome((secret, pass): (Secret, Pass), headers: &HeaderMap) -> Welcome {
    let Pass { id, name, role, tree, .. } = pass;
    tracing::info!(pass = id, name, role = role.name(), "somebody has come in");
    (set(cookie::keeping(&secret, headers)), Json(Admitted { role, tree }))
}

fn set(cookie: Option<HeaderValue>) -> Option<[(HeaderName, HeaderValue); 1]> {
    cookie.map(|cookie| [(header::SET_COOKIE, cookie)])
}
