//! Connections: accepted, served over HTTP/1.1, and ended when the server stops.

use std::{sync::Arc, time::Duration};

use axum::Router;
use futures_util::future::join_all;
use hyper::{Request, body::Incoming, server::conn::http1};
use hyper_util::{
    rt::{TokioIo, TokioTimer},
    service::TowerToHyperService,
};
use tokio::{
    net::{TcpListener, TcpStream},
    sync::Semaphore,
    time::sleep,
};
use tokio_util::{sync::CancellationToken, task::TaskTracker};
use tower::util::MapRequest;

use crate::access::Peer;

/// A client that takes longer to send a request's head is let go: it would hold a connection for nothing.
const HEADER_TIMEOUT: Duration = Duration::from_secs(5);
/// HTTP connections at a time; further ones wait to be accepted. Sockets are counted by themselves.
const MAX_CONNECTIONS: usize = 1024;
/// Before accepting again when the system has no more file descriptors, say.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Serves until `stop` is cancelled, then until every connection has ended.
pub async fn serve(listeners: Vec<TcpListener>, router: Router, stop: CancellationToken) {
    let connections = TaskTracker::new();
    let places = Arc::new(Semaphore::new(MAX_CONNECTIONS));
    let accepting =
        listeners.into_iter().map(|listener| accept(listener, &router, &connections, &places, &stop));
    join_all(accepting).await;
    connections.close();
    connections.wait().await;
}

/// Accepts connections at one address, each of which takes a place.
async fn accept(
    listener: TcpListener,
    router: &Router,
    connections: &TaskTracker,
    places: &Arc<Semaphore>,
    stop: &CancellationToken,
) {
    loop {
        let accepted = async {
            let place = Arc::clone(places).acquire_owned().await;
            (place, listener.accept().await)
        };
        let (place, accepted) = tokio::select! {
            () = stop.cancelled() => break,
            accepted = accepted => accepted,
        };
        match accepted {
            Ok((stream, from)) => {
                let (router, stop) = (router.clone(), stop.clone());
                connections.spawn(async move {
                    connection(stream, Peer(from.ip()), router, stop).await;
                    drop(place);
                });
            }
            Err(error) => {
                tracing::warn!(%error, "a connection could not be accepted");
                sleep(ACCEPT_PAUSE).await;
            }
        }
    }
}

async fn connection(stream: TcpStream, peer: Peer, router: Router, stop: CancellationToken) {
    // Small deltas should not wait for company.
    if let Err(error) = stream.set_nodelay(true) {
        tracing::debug!(%error, "TCP_NODELAY cannot be set");
    }
    let service = MapRequest::new(router, move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(peer);
        request
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEADER_TIMEOUT)
        .serve_connection(TokioIo::new(stream), TowerToHyperService::new(service))
        .with_upgrades();
    let mut connection = std::pin::pin!(connection);
    let ended = tokio::select! {
        ended = &mut connection => ended,
        () = stop.cancelled() => {
            connection.as_mut().graceful_shutdown();
            connection.await
        }
    };
    if let Err(error) = ended {
        tracing::debug!(%error, "a connection broke");
    }
}
