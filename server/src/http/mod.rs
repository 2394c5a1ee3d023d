//! The routes of `PROTOCOL.md`, and the client itself.

mod access_log;
mod addresses;
mod ahead;
mod audit;
mod client;
mod collections;
mod comments;
mod description;
mod designs;
mod entry;
mod exports;
mod failure;
mod file_name;
mod grammars;
mod groups;
mod guard;
mod guests;
mod held;
mod imports;
mod jobs;
mod keys;
mod limit;
mod links;
mod locks;
mod members;
mod mentions;
mod obstacles;
mod origin;
mod owners;
mod proxies;
mod ranges;
mod removals;
mod replays;
mod reviews;
mod revision;
mod schematic;
mod sending;
mod session_list;
mod sessions;
mod species;
mod status;
mod tokens;
mod trees;
mod turns;
mod uploads;
mod users;
mod versions;

use std::{net::IpAddr, sync::Arc, time::Duration};

use axum::{
    Extension, Router,
    extract::MatchedPath,
    middleware::{from_fn, from_fn_with_state, map_response},
    routing::{MethodRouter, any, get},
};
use espalier_proto::Reason;
use tokio::sync::{Notify, watch};
use tower::ServiceBuilder;

pub(crate) use self::comments::Said as SaidComment;
pub use self::{
    access_log::Requests,
    ahead::{Ahead, draw_ahead},
    audit::described,
    comments::CommentsWritten,
    entry::Logins,
    exports::{Progresses, rooms},
    guard::NotedDone,
    keys::{KEPT, UnderWay},
    members::NamesTried,
    proxies::Proxies,
    sessions::{Opening, SessionsBegun},
    turns::Turns,
};
use self::{
    addresses::{Route, downloads, methods, path_of, routes, sockets},
    failure::Failure,
    guard::Asked,
    keys::Keyed,
};
use crate::{
    access::{SecretHash, Tries, password::Passwords},
    drawn::DrawnPictures,
    hosts::Hosts,
    jobs::Jobs,
    live::Sessions,
    memory::Memory,
    pool::SimulationPool,
    portrait::Portraits,
    spool::Rooms,
    store::AnyStore,
};

/// When whoever finds no place may try again.
const AGAIN: Duration = Duration::from_secs(5);

/// What the handlers work with.
#[derive(Clone, Debug)]
pub struct Shared {
    /// What is kept.
    pub store: Arc<AnyStore>,
    /// The sessions in memory.
    pub sessions: Sessions,
    /// For what takes long.
    pub pool: SimulationPool,
    /// How requests were answered.
    pub requests: Requests,
    /// What there is of memory.
    pub memory: Memory,
    /// Metamers that each session begun here may hold.
    pub metamer_budget: u32,
    /// Pictures of the species.
    pub portraits: Portraits,
    /// Pictures of versions that were saved without one.
    pub drawn: DrawnPictures,
    /// What was saved and waits for its pictures.
    pub ahead: Ahead,
    /// The names that requests may come under.
    pub hosts: Hosts,
    /// Where other machines reach the server, where they do: the likeliest first.
    pub addresses: Arc<[String]>,
    /// The proxies in front.
    pub proxies: Proxies,
    /// Whether whoever sits at this machine may do everything.
    pub trusts_local: bool,
    /// How often secrets and passwords were tried, by the network that they came from.
    pub tries: Arc<Tries<IpAddr>>,
    /// How often passwords were tried, by the name that they were for.
    pub tries_for: Arc<Tries<SecretHash>>,
    /// How many sessions were begun, by whom.
    pub sessions_begun: Arc<SessionsBegun>,
    /// How many comments were written, by whom.
    pub comments_written: Arc<CommentsWritten>,
    /// How much that is noted was done, by whom.
    pub noted_done: Arc<NotedDone>,
    /// How often somebody was to be given something who is nobody, by whom.
    pub names_tried: Arc<NamesTried>,
    /// Tells when somebody may do more or less with a tree, so that open sockets hear of it at once.
    pub standings: watch::Sender<()>,
    /// How often people have logged in.
    pub logins: Arc<Logins>,
    /// Checks passwords.
    pub passwords: Arc<Passwords>,
    /// Held by whoever opens a tree.
    pub opening: Arc<Opening>,
    /// Told where there is something to give back to the disk.
    pub tidying: Arc<Notify>,
    /// How far exports are.
    pub progresses: Progresses,
    /// Room on the disk for what is downloaded.
    pub rooms: Rooms,
    /// Whose turn it is to have one made.
    pub turns: Turns,
    /// Trees that are grown on request.
    pub jobs: Jobs,
    /// Requests with keys that are being done.
    pub under_way: UnderWay,
}

impl Shared {
    /// Somebody may do more or less with a tree from now on.
    fn tell_standings(&self) {
        self.standings.send_replace(());
    }
}

/// Everything the server answers.
pub fn router(shared: Shared) -> Router {
    let asked = |answer: MethodRouter<Shared>, action, noted| {
        let asked = Asked { shared: shared.clone(), action, noted };
        answer.layer(from_fn_with_state(asked, guard::ask))
    };
    let keyed = |answer: MethodRouter<Shared>, shown, time_limit| {
        let keyed = Keyed { shared: shared.clone(), shown, time_limit };
        answer.layer(from_fn_with_state(keyed, keys::once))
    };
    let api = |routes: Vec<Route>| {
        routes.into_iter().fold(Router::new(), |router, route| {
            let takes_keys = route.takes_keys();
            let Route { address, action, answer, noted, most_bytes, time_limit, shown, about } = route;
            let answer = match about.asks_nothing() {
                true => answer.layer(from_fn(failure::without_query)),
                false => answer,
            };
            let answer = match about.has_revisions() {
                true => answer,
                false => answer.layer(from_fn(revision::none_here)),
            };
            let answer = match time_limit {
                Some(limit) if takes_keys => keyed(answer, shown, limit),
                _ => answer,
            };
            let answer = answer.layer(failure::body_limit(most_bytes)).layer(from_fn(failure::unpacked));
            let answer = action.map_or(answer.clone(), |action| asked(answer, action, noted));
            let answer = answer.layer(from_fn(failure::legible));
            router.route(path_of(&address), time_limit.map_or(answer.clone(), |limit| within(limit, answer)))
        })
    };
    let methods_of = methods();
    // A socket lasts as long as its drawing, so no time limit holds there.
    let sockets = sockets()
        .into_iter()
        .fold(Router::new(), |router, socket| router.route(path_of(socket.address), socket.answer));
    Router::new()
        .merge(sockets)
        .merge(api(routes()))
        .merge(api(downloads()))
        .route("/api/{*unknown}", any(failure::unknown_route))
        .route("/health", within(guard::TIME_LIMIT, get(status::health)))
        .route("/live", get(status::live))
        .route("/ready", within(guard::TIME_LIMIT, get(status::ready)))
        .route("/", get(client::page))
        .route("/api", get(client::api_page))
        .route("/s/{name}", get(client::page))
        .route("/pair", get(client::page))
        .fallback(client::file)
        .method_not_allowed_fallback(async move |path: MatchedPath| {
            Failure::wrong_method(&methods_of(path.as_str()))
        })
        .layer(
            ServiceBuilder::new()
                .layer(Extension(shared.memory.clone()))
                .layer(map_response(guard::headers))
                .layer(from_fn_with_state(shared.proxies.clone(), proxies::believe))
                .layer(from_fn_with_state(shared.requests.clone(), access_log::numbered))
                .layer(from_fn_with_state(shared.hosts.clone(), origin::known_host))
                .layer(from_fn(origin::same_site)),
        )
        .with_state(shared)
}

/// An answer for which there is so much time.
fn within(limit: Duration, answer: MethodRouter<Shared>) -> MethodRouter<Shared> {
    answer.layer(from_fn(move |request, next| guard::within(limit, request, next)))
}

/// What the server answers where there is no place for another connection: that, and whether it can serve at all.
pub fn crowded(shared: &Shared) -> Router {
    Router::new()
        .route("/live", get(status::live))
        .route("/health", get(status::health))
        .route("/ready", get(status::ready))
        .fallback(async || {
            let sentence = "As many connections as may be are open; try again.";
            Failure::new(Reason::ManyPeople, sentence).after(AGAIN)
        })
        .layer(
            ServiceBuilder::new()
                .layer(map_response(guard::headers))
                .layer(from_fn_with_state(shared.hosts.clone(), origin::known_host)),
        )
        .with_state(shared.clone())
}

#[cfg(test)]
mod tests;
