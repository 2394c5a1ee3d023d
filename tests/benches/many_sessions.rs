//! Memory of a server that holds many small sessions: a seed and one stroke each, with somebody there and without.

use std::{sync::Arc, time::Duration};

use espalier_tests::{client::Client, scratch::Scratch, server::Server, strokes};
use tokio::{
    task::{JoinSet, block_in_place},
    time::sleep,
};

/// Sessions at a time; each person is in one. A server takes 1024 sockets (`MAX_SOCKETS`).
const SESSIONS: usize = 1000;
/// So often as many; those before them stay in memory for a minute after the last has left.
const ROUNDS: usize = 2;
/// People who draw at the same time.
const AT_ONCE: usize = 16;
/// The server has noticed by then that they are gone.
const UNTIL_LEFT: Duration = Duration::from_secs(3);

#[tokio::main]
async fn main() {
    let scratch = Scratch::new();
    let server = Arc::new(Server::start(&scratch.path("trees.db")));
    // What the first session of all takes is the program's own.
    let first = visit(Arc::clone(&server), 0).await;
    println!("{} kB with one session", server.resident_bytes() / 1000);
    for round in 1..=ROUNDS {
        let before = server.resident_bytes();
        let per_session =
            |server: &Server| (server.resident_bytes() as f64 - before as f64) / 1000.0 / SESSIONS as f64;
        let mut people: Vec<Client> = Vec::new();
        while people.len() < SESSIONS {
            let numbers = people.len()..SESSIONS.min(people.len() + AT_ONCE);
            let arriving =
                numbers.map(|number| visit(Arc::clone(&server), (round * SESSIONS + number) as u32));
            people.extend(arriving.collect::<JoinSet<_>>().join_all().await);
        }
        let metamers: usize = people.iter().map(|person| person.state.metamers as usize).sum();
        println!("round {round}, {} metamers a session:", metamers / SESSIONS);
        println!("  {:.0} kB a session with somebody in each", per_session(&server));
        drop(people);
        sleep(UNTIL_LEFT).await;
        println!("  {:.0} kB a session when they have left", per_session(&server));
    }
    drop(first);
}

/// Somebody plants a session of their own and draws one stroke.
async fn visit(server: Arc<Server>, seed: u32) -> Client {
    let session = block_in_place(|| server.new_session(seed));
    let mut client = Client::connect(server.port(), &session, &format!("somebody-{seed}")).await;
    for command in strokes::upward(1, 8.0, 1.0) {
        client.send(command).await;
    }
    client.until_settled().await;
    client
}
