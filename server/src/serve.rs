//! `espalier serve`: start, serve, stop.

use std::{
    io::{self, IsTerminal, Write},
    net::{Ipv4Addr, Ipv6Addr, SocketAddr},
    sync::Arc,
    thread,
    time::{Duration, SystemTime},
};

use tokio::{
    net::TcpListener,
    signal,
    sync::{Notify, watch},
    time::timeout,
};
use tokio_util::sync::CancellationToken;
use tracing_subscriber::EnvFilter;

use crate::{
    access::admission::{self, Invite},
    announce::{self, Medium, OpenTo},
    cli,
    drawn::DrawnPictures,
    hosts::Hosts,
    http::{self, Shared},
    jobs::Jobs,
    listener::{self, Answers, Limits},
    live::Sessions,
    logging, maintenance,
    memory::Memory,
    pool::SimulationPool,
    portrait::Portraits,
    store::{AnyStore, Audit, Event, OpenError, SqliteStore, Store, StoreError, Users},
};

/// How long the server waits for sessions and connections when it stops.
const LAST_WORK: Duration = Duration::from_secs(10);

/// The server cannot start; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// `--log` cannot be read.
    #[error("The log filter {filter:?} cannot be read ({cause}); info or espalier=debug would do.")]
    Log {
        /// What was given.
        filter: String,
        /// Why not.
        cause: tracing_subscriber::filter::ParseError,
    },
    /// The runtime or its threads cannot be made.
    #[error("The server's threads cannot be started: {0}.")]
    Threads(#[from] io::Error),
    /// The simulation pool cannot be made.
    #[error("The simulation's threads cannot be started: {0}.")]
    Pool(#[from] rayon::ThreadPoolBuildError),
    /// The database cannot be used.
    #[error(transparent)]
    Database(#[from] OpenError),
    /// Nobody can be let in.
    #[error("Nobody can be let in: {}.", .0.in_words())]
    LetIn(#[from] StoreError),
    /// The address is taken.
    #[error("Port {port} on {host} is in use, perhaps by another Espalier; choose another with --port.", host = .0.ip(), port = .0.port())]
    PortInUse(SocketAddr),
    /// The address cannot be listened on.
    #[error("The server cannot listen on {address}: {cause}.")]
    Listen {
        /// Where.
        address: SocketAddr,
        /// Why not.
        cause: io::Error,
    },
}

/// Serves until the process is told to stop.
pub fn run(options: &cli::Serve) -> Result<(), ServeError> {
    let filter = EnvFilter::try_new(&options.log)
        .map_err(|cause| ServeError::Log { filter: options.log.clone(), cause })?;
    let _log = logging::start(filter, options.log_format)?;
    #[cfg(unix)]
    open_as_many_files_as_one_may();
    let pool = SimulationPool::new(None)?;
    tokio::runtime::Builder::new_multi_thread().enable_all().build()?.block_on(serve(options, pool))
}

async fn serve(options: &cli::Serve, pool: SimulationPool) -> Result<(), ServeError> {
    let address = SocketAddr::new(options.host, options.port);
    // First the port: two servers started by mistake differ in it, and the sentence about it helps more.
    let listener = TcpListener::bind(address).await.map_err(|cause| match cause.kind() {
        io::ErrorKind::AddrInUse => ServeError::PortInUse(address),
        _ => ServeError::Listen { address, cause },
    })?;
    let bound = listener.local_addr().map_err(|cause| ServeError::Listen { address, cause })?;
    let listeners = [Some(listener), beside(bound).await].into_iter().flatten().collect();
    let store = Arc::new(AnyStore::Sqlite(SqliteStore::open(&options.database.path).await?));

    let trusts_local = !options.no_local && !options.auth;
    let open_to = if options.auth {
        OpenTo::Users { any: !store.users().await?.is_empty() }
    } else if trusts_local && bound.ip().is_loopback() {
        OpenTo::Machine
    } else {
        let invite = Invite::default();
        store.note(Event::at_machine("invite", &invite.name)).await?;
        OpenTo::Invited(admission::invite(&*store, invite, SystemTime::now()).await?)
    };

    let stop = CancellationToken::new();
    let memory = Memory::found(options.memory);
    let sessions = Sessions::new(Arc::clone(&store), pool.clone(), memory.clone(), stop.clone());
    let jobs = Jobs::new(pool.clone(), memory.clone(), stop.clone());
    let under_way = http::UnderWay::new(stop.clone());
    let proxies = http::Proxies::new(&options.trusted_proxies);
    let tidying = Arc::<Notify>::default();
    let shared = Shared {
        jobs: jobs.clone(),
        store: Arc::clone(&store),
        sessions: sessions.clone(),
        pool,
        memory,
        requests: http::Requests::logged(options.access_log),
        metamer_budget: options.metamer_budget,
        portraits: Portraits::default(),
        drawn: DrawnPictures::default(),
        ahead: http::Ahead::default(),
        hosts: Hosts::new(&options.host_names),
        progresses: http::Progresses::default(),
        rooms: http::rooms(),
        turns: http::Turns::default(),
        under_way: under_way.clone(),
        addresses: if bound.ip().is_loopback() { Arc::default() } else { announce::addresses(bound).into() },
        proxies: proxies.clone(),
        trusts_local,
        tries: Arc::default(),
        tries_for: Arc::default(),
        sessions_begun: Arc::default(),
        comments_written: Arc::default(),
        noted_done: Arc::default(),
        names_tried: Arc::default(),
        standings: watch::Sender::default(),
        logins: Arc::default(),
        passwords: Arc::default(),
        opening: Arc::default(),
        tidying: Arc::clone(&tidying),
    };
    let growing = tokio::spawn(jobs.run(Arc::clone(&store)));
    let unsaved = Duration::from_hours(24 * u64::from(options.keep_unsaved));
    let caring = tokio::spawn(maintenance::run(Arc::clone(&store), unsaved, tidying, stop.clone()));
    let watching = tokio::spawn(maintenance::watch(Arc::clone(&store), sessions.clone(), stop.clone()));
    let drawing = tokio::spawn(http::draw_ahead(shared.clone(), stop.clone()));
    let answers = Answers { crowded: http::crowded(&shared), all: http::router(shared) };
    let serving = tokio::spawn(listener::serve(
        listeners,
        answers,
        Limits::default(),
        proxies.networks(),
        stop.clone(),
    ));

    let asked_to_stop = stop_requested();
    let medium = if io::stdout().is_terminal() { Medium::Terminal } else { Medium::Plain };
    let announcement = announce::text(bound, &open_to, medium);
    // Nobody may be reading; the server works all the same.
    thread::spawn(move || writeln!(io::stdout(), "{announcement}"));
    asked_to_stop.await;

    tracing::info!("stopping");
    stop.cancel();
    let ended = async {
        sessions.ended().await;
        let served = serving.await;
        under_way.ended().await;
        served.and(caring.await).and(watching.await).and(growing.await).and(drawing.await)
    };
    match timeout(LAST_WORK, ended).await {
        Ok(Ok(())) => {}
        Ok(Err(error)) => tracing::error!(%error, "the listener ended badly"),
        Err(_) => tracing::warn!("some connections did not end in time"),
    }
    store.close().await;
    Ok(())
}

/// A socket is a file to the system, which lets programs have few unless they ask.
#[cfg(unix)]
fn open_as_many_files_as_one_may() {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let Rlimit { current, maximum } = getrlimit(Resource::Nofile);
    if current != maximum
        && let Err(error) = setrlimit(Resource::Nofile, Rlimit { current: maximum, maximum })
    {
        tracing::warn!(%error, "no more than {} files can be open", current.unwrap_or(u64::MAX));
    }
}

/// The other address of `localhost`, which browsers try first: whoever has it would get what is meant for this server.
async fn beside(bound: SocketAddr) -> Option<TcpListener> {
    if bound.ip() != Ipv4Addr::LOCALHOST {
        return None;
    }
    let address = SocketAddr::from((Ipv6Addr::LOCALHOST, bound.port()));
    match TcpListener::bind(address).await {
        Ok(listener) => Some(listener),
        Err(error) if error.kind() == io::ErrorKind::AddrInUse => {
            tracing::warn!(
                "another program listens on {address}; browse to {bound}, for localhost may lead to it"
            );
            None
        }
        // The machine has no such address.
        Err(error) => {
            tracing::debug!(%error, "nothing listens on {address}");
            None
        }
    }
}

/// Ctrl+C, or SIGTERM as service managers send it.
///
/// From the call on, not only once it is awaited: whoever reads the server's address may stop it at once.
fn stop_requested() -> impl Future<Output = ()> {
    #[cfg(unix)]
    let terminated = {
        let signal = signal::unix::signal(signal::unix::SignalKind::terminate());
        async {
            match signal {
                Ok(mut signal) => drop(signal.recv().await),
                Err(error) => {
                    tracing::warn!(%error, "SIGTERM is not heard");
                    std::future::pending::<()>().await;
                }
            }
        }
    };
    #[cfg(not(unix))]
    let terminated = std::future::pending::<()>();
    async {
        tokio::select! {
            interrupted = signal::ctrl_c() => if let Err(error) = interrupted {
                tracing::warn!(%error, "Ctrl+C is not heard");
                std::future::pending::<()>().await;
            },
            () = terminated => {}
        }
    }
}
