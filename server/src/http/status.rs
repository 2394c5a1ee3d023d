//! Seeing inside: whether the server lives, whether it is ready, its figures, and its sessions for owners.

use axum::{
    Json,
    extract::State,
    http::header,
    response::{IntoResponse, Response},
};
use espalier_proto::{
    Reason,
    status::{MemoryUse, ServerStatus, SessionStatus},
};

use super::{Shared, failure::Failure};
use crate::{
    figures::{Figures, Kind},
    headless::resident_memory_bytes,
    live::{Looked, SessionFigures},
    memory::{AGAIN, Use},
    pool::{Class, Done},
    store::{Library, Store},
};

/// Whether the process answers at all. What it needs is not asked: to start it anew would not bring that back.
pub(super) async fn live() -> &'static str {
    "ok"
}

/// Whether the server can serve: what is drawn gets where it is kept.
pub(super) async fn health(State(shared): State<Shared>) -> Result<&'static str, Failure> {
    shared.store.check_place().await?;
    Ok("ok")
}

/// Whether more may be sent here: it can serve, does not stop, and has memory for somebody who comes.
pub(super) async fn ready(State(shared): State<Shared>) -> Result<&'static str, Failure> {
    if shared.sessions.is_stopping() {
        return Err(Failure::new(Reason::Stopping, "The server is stopping."));
    }
    shared.store.check_place().await?;
    if shared.memory.look().left() == 0 {
        let sentence = "The server has no memory left for anybody who comes.";
        return Err(Failure::new(Reason::MemoryFull, sentence).after(AGAIN));
    }
    Ok("ready")
}

/// Figures of the server, for programs that draw curves of them.
pub(super) async fn metrics(State(shared): State<Shared>) -> Response {
    let sessions = shared.sessions.look().await;
    let text = written(&shared, &sessions);
    ([(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")], text).into_response()
}

/// The server as an owner sees it.
pub(super) async fn status(State(shared): State<Shared>) -> Result<Json<ServerStatus>, Failure> {
    let looked = shared.sessions.look().await;
    let mut sessions = Vec::with_capacity(looked.len());
    for Looked { name, figures } in looked {
        let tree = shared.store.tree_of(&name).await?.map(|tree| tree.id);
        let figures = figures.as_ref();
        sessions.push(SessionStatus {
            tree,
            people: figures.map_or(0, |figures| figures.people),
            metamers: figures.map_or(0, |figures| figures.metamers),
            memory_bytes: figures.map_or(0, |figures| figures.memory),
            waiting_commands: figures.map_or(0, |figures| figures.waiting as u64),
            unanswered_bytes: figures.map_or(0, |figures| figures.unanswered as u64),
            paused: figures.and_then(|figures| figures.paused),
            answers: figures.is_some(),
            name,
        });
    }
    sessions.sort_by(|a, b| b.memory_bytes.cmp(&a.memory_bytes).then_with(|| a.name.cmp(&b.name)));
    let budget = shared.memory.look();
    let used = |(what, name): (Use, &str)| MemoryUse { what: name.into(), bytes: budget.taken_for(what) };
    Ok(Json(ServerStatus {
        version: env!("CARGO_PKG_VERSION").into(),
        up_seconds: shared.sessions.up().as_secs(),
        sockets: shared.sessions.sockets() as u32,
        memory_bytes: budget.all(),
        taken_bytes: budget.taken(),
        used: Use::ALL.map(used).into(),
        refused: budget.refused(),
        sessions,
    }))
}

/// A figure of each class of work: its name, what it says, and where it stands.
type Counter = (&'static str, &'static str, fn(&Done) -> f64);

fn written(shared: &Shared, sessions: &[Looked]) -> String {
    let mut out = Figures::default();
    let version = env!("CARGO_PKG_VERSION");
    out.figure(Kind::Gauge, "espalier_info", "The program.").value(&[("version", version)], 1);
    out.one(Kind::Gauge, "espalier_up_seconds", "Seconds since the start.", shared.sessions.up().as_secs());

    let (waiting, done) = shared.pool.figures();
    let mut figure =
        out.figure(Kind::Gauge, "espalier_slices_waiting", "Slices of work that wait for a worker.");
    for ((_, name), waiting) in Class::ALL.into_iter().zip(waiting) {
        figure.value(&[("class", name)], waiting);
    }
    let counters: [Counter; 3] = [
        ("espalier_slices_total", "Slices of work that were done.", |done| done.slices as f64),
        ("espalier_slices_waited_seconds_total", "Seconds that slices waited for a worker.", |done| {
            done.waited.as_secs_f64()
        }),
        ("espalier_slices_worked_seconds_total", "Seconds that workers worked.", |done| {
            done.worked.as_secs_f64()
        }),
    ];
    for (name, help, value) in counters {
        let mut figure = out.figure(Kind::Counter, name, help);
        for ((_, class), done) in Class::ALL.into_iter().zip(&done) {
            figure.value(&[("class", class)], value(done));
        }
    }

    let commits = shared.store.commits();
    out.one(Kind::Counter, "espalier_commits_total", "Transactions of the database.", commits.commits);
    out.one(Kind::Counter, "espalier_writes_total", "Writes in them.", commits.writes);
    out.one(Kind::Counter, "espalier_writes_failed_total", "Writes that failed.", commits.failed);
    let seconds = commits.took.as_secs_f64();
    out.one(Kind::Counter, "espalier_commits_seconds_total", "Seconds that transactions took.", seconds);

    let budget = shared.memory.look();
    out.one(Kind::Gauge, "espalier_memory_budget_bytes", "Memory that may be taken.", budget.all());
    let mut figure =
        out.figure(Kind::Gauge, "espalier_memory_taken_bytes", "Memory that is taken, by what for.");
    for (what, name) in Use::ALL {
        figure.value(&[("for", name)], budget.taken_for(what));
    }
    let help = "How often there was no memory for what was asked.";
    out.one(Kind::Counter, "espalier_memory_refused_total", help, budget.refused());
    if let Some(bytes) = resident_memory_bytes() {
        out.one(Kind::Gauge, "process_resident_memory_bytes", "Resident memory of the process.", bytes);
    }

    let figures: Vec<_> = sessions.iter().filter_map(|session| session.figures.as_ref()).collect();
    let sum = |of: fn(&SessionFigures) -> u64| figures.iter().map(|figures| of(figures)).sum::<u64>();
    let most = figures.iter().map(|figures| figures.memory).max().unwrap_or(0);
    let paused = figures.iter().filter(|figures| figures.paused.is_some()).count();
    out.one(Kind::Gauge, "espalier_sessions", "Sessions in memory.", sessions.len());
    out.one(Kind::Gauge, "espalier_sessions_paused", "Sessions whose growth rests.", paused);
    out.one(Kind::Gauge, "espalier_sockets", "Sockets that are open.", shared.sessions.sockets());
    out.one(Kind::Gauge, "espalier_people", "People who are in sessions.", sum(|one| one.people.into()));
    out.one(
        Kind::Gauge,
        "espalier_metamers",
        "Living metamers of all sessions.",
        sum(|one| one.metamers.into()),
    );
    out.one(Kind::Gauge, "espalier_session_memory_most_bytes", "Memory of the largest session.", most);
    let help = "Commands that wait to be done or to be durable.";
    out.one(Kind::Gauge, "espalier_commands_waiting", help, sum(|one| one.waiting as u64));
    let help = "Bytes of frames that were sent and not answered.";
    out.one(Kind::Gauge, "espalier_windows_bytes", help, sum(|one| one.unanswered as u64));

    let mut figure =
        out.figure(Kind::Counter, "espalier_requests_total", "Requests by how they were answered.");
    for (count, status) in shared.requests.answered().into_iter().zip(["1xx", "2xx", "3xx", "4xx", "5xx"]) {
        figure.value(&[("status", status)], count);
    }
    let help = "Seconds until answers began.";
    out.one(Kind::Counter, "espalier_requests_seconds_total", help, shared.requests.seconds());
    out.into_text()
}
