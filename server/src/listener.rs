//! Connections: accepted, served over HTTP/1.1, and ended when the server stops.

mod crowd;
mod paced;
mod unfinished;
mod unread;

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use axum::Router;
use futures_util::future::join_all;
use hyper::{Request, body::Incoming, server::conn::http1};
use hyper_util::{
    rt::{TokioIo, TokioTimer},
    service::TowerToHyperService,
};
use ipnet::IpNet;
use tokio::{
    net::{TcpListener, TcpStream},
    time::{sleep, timeout},
};
use tokio_util::{sync::CancellationToken, task::TaskTracker};
use tower::util::MapRequest;

pub use self::unfinished::Unfinished;
use self::{
    crowd::Crowd,
    paced::{PATIENCE, Paced},
};
use crate::{access::Peer, places::Places};

/// A client that takes longer to send a request's head is let go: it would hold a connection for nothing.
const HEADER_TIMEOUT: Duration = Duration::from_secs(5);
/// How long a connection lasts for which there is no place.
const BRIEF: Duration = Duration::from_secs(2);
/// Bytes of requests that are read ahead of what is answered, and of answers that wait to be sent.
const BUFFER: usize = 32 * 1024;
/// Before accepting again when the system has no more file descriptors, say.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// What connections may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// HTTP connections at a time. Sockets are counted by themselves.
    pub connections: usize,
    /// Those of one network, but for this machine.
    pub of_one: usize,
    /// Of those for which there is no place so many are told so at a time; further ones close the oldest of them.
    pub told: usize,
    /// How long a peer may take nothing of what is sent,
    pub patience: Duration,
    /// and how long it may take to say what it asks for.
    pub asking: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self { connections: 1024, of_one: 256, told: 32, patience: PATIENCE, asking: HEADER_TIMEOUT }
    }
}

/// Who answers.
#[derive(Clone, Debug)]
pub struct Answers {
    /// Everything.
    pub all: Router,
    /// Connections for which there is no place.
    pub crowded: Router,
}

struct Listening {
    answers: Answers,
    limits: Limits,
    places: Places,
    crowd: Crowd,
    connections: TaskTracker,
    stop: CancellationToken,
}

/// Serves until `stop` is cancelled, then until every connection has ended. Proxies have connections for many networks.
pub async fn serve(
    listeners: Vec<TcpListener>,
    answers: Answers,
    limits: Limits,
    proxies: Vec<IpNet>,
    stop: CancellationToken,
) {
    let listening = Arc::new(Listening {
        answers,
        limits,
        places: Places::with_proxies(limits.connections, limits.of_one, proxies),
        crowd: Crowd::new(limits.told),
        connections: TaskTracker::new(),
        stop,
    });
    join_all(listeners.into_iter().map(|listener| Arc::clone(&listening).accept(listener))).await;
    listening.connections.close();
    listening.connections.wait().await;
}

impl Listening {
    /// Accepts connections at one address.
    async fn accept(self: Arc<Self>, listener: TcpListener) {
        loop {
            let accepted = tokio::select! {
                () = self.stop.cancelled() => break,
                accepted = listener.accept() => accepted,
            };
            match accepted {
                Ok((stream, from)) => {
                    let (listening, peer) = (Arc::clone(&self), Peer(from.ip()));
                    let place = self.places.take(from.ip());
                    self.connections.spawn(async move {
                        if let Some(_place) = place {
                            listening.converse(stream, peer).await;
                        } else {
                            listening.tell(stream, peer).await;
                        }
                    });
                }
                Err(error) => {
                    tracing::warn!(%error, "a connection could not be accepted");
                    sleep(ACCEPT_PAUSE).await;
                }
            }
        }
    }

    /// Answers requests until the peer or the server has enough.
    async fn converse(&self, stream: TcpStream, peer: Peer) {
        let (unfinished, asked, makes_way) =
            (Unfinished::default(), Arc::<AtomicBool>::default(), CancellationToken::new());
        let paced = self.paced(stream, unfinished.clone()).until(makes_way.clone());
        let answers = of_peer(self.answers.all.clone(), peer, unfinished, Arc::clone(&asked));
        let service = TowerToHyperService::new(answers);
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(self.limits.asking)
            .max_buf_size(BUFFER)
            .serve_connection(TokioIo::new(paced), service)
            .with_upgrades();
        let mut connection = std::pin::pin!(connection);
        let ended = tokio::select! {
            ended = &mut connection => ended,
            () = self.stop.cancelled() => {
                // Hyper would wait for the first request.
                if !asked.load(Ordering::Relaxed) {
                    return makes_way.cancel();
                }
                connection.as_mut().graceful_shutdown();
                connection.await
            }
        };
        if let Err(error) = ended {
            tracing::debug!(%error, "a connection broke");
        }
    }

    /// Answers one request of somebody for whom there is no place.
    async fn tell(&self, stream: TcpStream, peer: Peer) {
        let told = self.crowd.enter();
        let unfinished = Unfinished::default();
        let answers = of_peer(self.answers.crowded.clone(), peer, unfinished.clone(), Arc::default());
        let service = TowerToHyperService::new(answers);
        let paced = self.paced(stream, unfinished).until(told.makes_way.clone());
        let connection = http1::Builder::new()
            .keep_alive(false)
            .max_buf_size(BUFFER)
            .serve_connection(TokioIo::new(paced), service);
        let ended = tokio::select! {
            ended = timeout(BRIEF, connection) => matches!(ended, Ok(Ok(()))),
            () = told.makes_way.cancelled() => false,
        };
        if !ended {
            tracing::debug!("a connection without a place broke");
        }
    }

    fn paced(&self, stream: TcpStream, unfinished: Unfinished) -> Paced {
        let lingering = self.connections.clone();
        Paced::new(stream, self.limits.patience, unfinished, self.stop.clone(), lingering)
    }
}

/// The router, with who asks, what counts their messages, and a note that they have asked for something.
fn of_peer(
    router: Router,
    peer: Peer,
    unfinished: Unfinished,
    asked: Arc<AtomicBool>,
) -> MapRequest<Router, impl FnMut(Request<Incoming>) -> Request<Incoming> + Clone> {
    MapRequest::new(router, move |mut request: Request<Incoming>| {
        asked.store(true, Ordering::Relaxed);
        request.extensions_mut().insert(peer);
        request.extensions_mut().insert(unfinished.clone());
        request
    })
}

#[cfg(test)]
mod tests;
