//! What is measured, each by its name.

use std::{sync::Arc, time::Duration};

use futures_util::{StreamExt, stream};
use serde_json::json;
use tokio::{
    io::{AsyncReadExt, AsyncWriteExt},
    task::JoinSet,
    time::{Instant, sleep_until, timeout},
};
use tokio_util::sync::CancellationToken;

use super::{
    Load, LoadError,
    delays::{Delays, Table},
    person::{Measured, Person},
    progress::Progress,
    site::Site,
};

/// What can be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Scenario {
    /// Sessions of which one in ten is drawn in, all with two people who look.
    Drawing,
    /// The same where somebody draws in each.
    AllDraw,
    /// People who draw, each in a session of their own, beside trees that grow to the budget of metamers.
    Growers,
    /// The same beside large trees that are opened again and again.
    Restores,
    /// Sockets on which nothing happens: what one takes of memory.
    Idle,
    /// Connections that send nonsense: what is left of them in memory.
    Malformed,
}

impl Scenario {
    /// Measures it.
    pub async fn run(self, site: &Arc<Site>, load: &Load) -> Result<Table, LoadError> {
        match self {
            Self::Drawing => sessions(site, load, 10).await,
            Self::AllDraw => sessions(site, load, 1).await,
            Self::Growers => growers(site, load).await,
            Self::Restores => restores(site, load).await,
            Self::Idle => idle(site, load).await,
            Self::Malformed => malformed(site, load).await,
        }
    }
}

/// Before anybody draws everybody is there.
const GATHERING: Duration = Duration::from_secs(2);
/// Tasks that begin at once, so that the server is not asked for everything in one moment.
const AT_ONCE: usize = 16;

/// Connections that send nonsense at once: fewer than the server has places for.
const CONNECTED_AT_ONCE: usize = 64;
/// Nonsense that is not answered, because more may come, is given up after so long.
const GIVEN_UP: Duration = Duration::from_millis(200);

/// Sessions, in one of `one_in` of which somebody draws.
async fn sessions(site: &Arc<Site>, load: &Load, one_in: u32) -> Result<Table, LoadError> {
    let all_here = CancellationToken::new();
    let mut begun = stream::iter(0..load.sessions)
        .map(async |number| {
            let (session, drawer) = planted(site, number, load.metamers).await?;
            let viewer = Person::join(site, &session, &key("viewer", number)).await?;
            Ok::<_, LoadError>((number, drawer, viewer))
        })
        .buffer_unordered(AT_ONCE);
    let mut waiting = JoinSet::new();
    let mut progress = Progress::of(load.sessions, "sessions are planted");
    while let Some(one) = begun.next().await {
        let ((number, drawer, viewer), all_here) = (one?, all_here.clone());
        waiting.spawn(async move {
            let (drawer, viewer) = tokio::try_join!(drawer.wait(all_here.clone()), viewer.wait(all_here))?;
            Ok::<_, LoadError>((number, drawer, viewer))
        });
        progress.count();
    }
    all_here.cancel();
    let people = waiting.join_all().await.into_iter().collect::<Result<Vec<_>, _>>()?;
    let first = Instant::now() + GATHERING;
    let until = first + load.time();
    let mut under_way = JoinSet::new();
    let mut drawing = 0;
    for (number, mut drawer, mut viewer) in people {
        let draws = number % one_in == 0;
        drawing += u32::from(draws);
        under_way.spawn(async move {
            // Not all hands move at once.
            let first = first + Duration::from_micros(u64::from(number) * 7_919 % 100_000);
            let drawn = async {
                if draws { drawer.draw(first, until).await } else { drawer.stay(until).await }?;
                Ok(drawer.leave().await)
            };
            let seen = async {
                viewer.stay(until).await?;
                Ok::<_, LoadError>(viewer.leave().await)
            };
            let (measured, _) = tokio::try_join!(drawn, seen)?;
            Ok(measured)
        });
    }
    let mut table = Table::default();
    measured(&mut table, "", under_way.join_all().await)?;
    table.figure("sessions", load.sessions);
    table.figure("sockets", 2 * load.sessions);
    table.figure("of which draw", drawing);
    with_memory(site, &mut table).await;
    Ok(table)
}

async fn growers(site: &Arc<Site>, load: &Load) -> Result<Table, LoadError> {
    let mut table = Table::default();
    draw(site, load, &mut table, "alone").await?;
    let mut growing = Vec::new();
    for number in 0..load.beside {
        let session = site.begin_session(&json!({ "seed": 1000 + number })).await?;
        let mut grower = Person::join(site, &session, &key("grower", number)).await?;
        grower.command(&json!({ "kind": "grow", "steps": 1000 })).await?;
        growing.push(grower);
    }
    let until = Instant::now() + load.time() + GATHERING;
    let under_way: JoinSet<_> = growing
        .into_iter()
        .map(|mut grower| async move {
            grower.stay(until).await?;
            grower.command(&json!({ "kind": "stop" })).await?;
            Ok::<_, LoadError>(grower.leave().await)
        })
        .collect();
    draw(site, load, &mut table, &format!("beside {} growing", load.beside)).await?;
    for one in under_way.join_all().await {
        one?;
    }
    with_memory(site, &mut table).await;
    Ok(table)
}

async fn restores(site: &Arc<Site>, load: &Load) -> Result<Table, LoadError> {
    let mut table = Table::default();
    let (session, mut planter) = planted(site, 1, load.large).await?;
    planter.stay(Instant::now()).await?;
    let saved =
        site.ask_json("POST", "/api/v1/trees", &json!({ "session": session, "name": "Load" })).await?;
    let tree = saved["id"].as_str().unwrap_or_default().to_owned();
    planter.leave().await;
    draw(site, load, &mut table, "alone").await?;
    let until = Instant::now() + load.time() + GATHERING;
    let opening: JoinSet<_> = (0..load.beside)
        .map(|number| {
            let (site, tree) = (Arc::clone(site), tree.clone());
            async move {
                let mut delays = Delays::default();
                while Instant::now() < until {
                    let begun = Instant::now();
                    let session = site.begin_session(&json!({ "tree": tree, "template": true })).await?;
                    let person = Person::join(&site, &session, &key("opener", number)).await?;
                    delays.push(begun.elapsed());
                    person.leave().await;
                }
                Ok::<_, LoadError>(delays)
            }
        })
        .collect();
    draw(site, load, &mut table, &format!("beside {} opening {} metamers", load.beside, load.large)).await?;
    let mut delays = Delays::default();
    for one in opening.join_all().await {
        delays.append(one?);
    }
    table.delays("a large tree opened, to its welcome", delays);
    site.ask("DELETE", &format!("/api/v1/trees/{tree}"), None).await?;
    with_memory(site, &mut table).await;
    Ok(table)
}

async fn idle(site: &Arc<Site>, load: &Load) -> Result<Table, LoadError> {
    let mut table = Table::default();
    let session = site.begin_session(&json!({})).await?;
    let first = Person::join(site, &session, "somebody").await?;
    let before = site.memory().await?;
    // Everybody hears of everybody who comes, and takes that in.
    let measured = CancellationToken::new();
    let mut people = JoinSet::new();
    people.spawn(first.wait(measured.clone()));
    let mut coming = stream::iter(1..load.sockets)
        .map(async |number| Person::join(site, &session, &key("idle", number)).await)
        .buffer_unordered(AT_ONCE);
    let mut progress = Progress::of(load.sockets, "sockets are there");
    while let Some(person) = coming.next().await {
        people.spawn(person?.wait(measured.clone()));
        progress.count();
        // Nobody leaves of themselves: whoever is let go is told of at once.
        if let Some(gone) = people.try_join_next() {
            gone.map_err(|error| LoadError::Lost(error.to_string()))??;
        }
    }
    sleep_until(Instant::now() + GATHERING).await;
    if let (Some(before), Some(after)) = (before, site.memory().await?) {
        let each = after.saturating_sub(before) / u64::from(load.sockets.max(2) - 1);
        table.figure("kB of memory for a socket", format!("{:.1}", each as f64 / 1e3));
    }
    with_memory(site, &mut table).await;
    measured.cancel();
    let people = people.join_all().await.into_iter().collect::<Result<Vec<_>, _>>()?;
    table.figure("sockets", people.len());
    Ok(table)
}

/// What no server should be asked.
const NONSENSE: [&[u8]; 6] = [
    b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
    b"GET / HTTP/9.9\r\n\r\n",
    b"\r\n\r\n\r\n\r\n",
    b"GET /api/v1/sessions/none/socket HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n\r\n",
    b"POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999999\r\n\r\n{",
    b"GET /../../etc/passwd HTTP/1.1\r\nHost: nowhere\r\n\r\n",
];

async fn malformed(site: &Arc<Site>, load: &Load) -> Result<Table, LoadError> {
    let mut table = Table::default();
    let before = site.memory().await?;
    let mut delays = Delays::default();
    let mut begun = stream::iter(0..load.connections)
        .map(async |number| {
            let begun = Instant::now();
            let mut stream = site.connect().await?;
            // Whether it is taken or refused is the server's affair.
            let _ = stream.write_all(NONSENSE[number as usize % NONSENSE.len()]).await;
            let mut answer = [0; 1024];
            let _ = timeout(GIVEN_UP, stream.read(&mut answer)).await;
            Ok::<_, LoadError>(begun.elapsed())
        })
        .buffer_unordered(CONNECTED_AT_ONCE);
    let mut progress = Progress::of(load.connections, "connections are done");
    while let Some(one) = begun.next().await {
        delays.push(one?);
        progress.count();
    }
    sleep_until(Instant::now() + GATHERING).await;
    table.delays("a connection, until it is answered or given up", delays);
    table.figure("connections", load.connections);
    if let (Some(before), Some(after)) = (before, site.memory().await?) {
        let more = after as f64 - before as f64;
        table.figure("MB of memory more afterwards", format!("{:.1}", more / 1e6));
    }
    Ok(table)
}

/// A session with a tree of so many metamers, and who grew it.
async fn planted(site: &Site, number: u32, metamers: u32) -> Result<(String, Person), LoadError> {
    let session = site.begin_session(&json!({ "seed": number })).await?;
    let mut person = Person::join(site, &session, &key("drawer", number)).await?;
    person.grow_to(metamers).await?;
    Ok((session, person))
}

/// People who draw, each in a session of their own, for as long as is measured.
async fn draw(site: &Arc<Site>, load: &Load, table: &mut Table, when: &str) -> Result<(), LoadError> {
    let until = Instant::now() + load.time();
    let people: JoinSet<_> = (0..load.people)
        .map(|number| {
            let (site, metamers) = (Arc::clone(site), load.metamers);
            async move {
                let (_, mut person) = planted(&site, number, metamers).await?;
                person
                    .draw(Instant::now() + Duration::from_millis(u64::from(number) * 5 % 100), until)
                    .await?;
                Ok::<_, LoadError>(person.leave().await)
            }
        })
        .collect();
    measured(table, &format!(", {when}"), people.join_all().await)
}

fn measured(table: &mut Table, when: &str, all: Vec<Result<Measured, LoadError>>) -> Result<(), LoadError> {
    let mut sum = Measured::default();
    for one in all {
        sum.append(one?);
    }
    table.delays(format!("part of a stroke to its frame{when}"), sum.to_delta);
    table.delays(format!("command to its acknowledgement{when}"), sum.to_acknowledged);
    if sum.in_vain > 0 {
        table.figure(format!("parts of strokes by which nothing grew{when}"), sum.in_vain);
    }
    if sum.refused > 0 {
        table.figure(format!("commands refused{when}"), sum.refused);
    }
    Ok(())
}

async fn with_memory(site: &Site, table: &mut Table) {
    if let Ok(Some(bytes)) = site.memory().await {
        table.figure("MB of memory that the server has", format!("{:.0}", bytes as f64 / 1e6));
    }
}

fn key(what: &str, number: u32) -> String {
    format!("load-{what}-{number}")
}
