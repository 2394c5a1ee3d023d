//! What can be asked of a live session, and who asks.

use std::sync::Arc;

use espalier_proto::{
    Command, DesignInForce, Mesh, Pause, PlacedObstacle, Problem, access::Role, comment::Pin,
};
use espalier_session::{Anchor, ClientId, Entrant, Place, Principal, ReadDocument, Register};
use espalier_settings::ParameterValues;
use tokio::sync::{mpsc, oneshot};
use tokio_util::sync::CancellationToken;

use super::{
    outbox::Outbox,
    readers::{Answer, Unread},
};

/// What is asked of a session.
#[derive(Debug)]
pub(super) enum Request {
    Join(Outbox, Entrant, oneshot::Sender<ClientId>),
    /// They may do what this role may, from now on.
    Grant(ClientId, Role),
    Text(ClientId, String),
    Binary(ClientId),
    /// Somebody is there.
    Heard(ClientId),
    /// So many control messages have gone out.
    Written(ClientId, usize),
    Leave(ClientId),
    Read(Answer),
    Act(Principal, Entrant, Box<Command>, oneshot::Sender<Outcome>),
    Parameters(oneshot::Sender<ParameterValues>),
    Mesh(u32, oneshot::Sender<Option<Arc<Mesh>>>),
    Design(oneshot::Sender<Option<DesignInForce>>),
    People(oneshot::Sender<Vec<Principal>>),
    /// Everybody who has been here.
    Register(oneshot::Sender<Register>),
    /// Those who are here and have a name.
    Named(oneshot::Sender<Vec<PersonNamed>>),
    /// Whoever has a number in the session, and what whoever asks is called there.
    Person(u32, Principal, oneshot::Sender<PersonHere>),
    /// The place of a row.
    Anchor(u32, oneshot::Sender<Option<Anchor>>),
    /// What people say of the tree has changed: all that is pinned, and the threads.
    Commented(Vec<Place>, Vec<u32>),
    /// Where comments are pinned now.
    Pins(oneshot::Sender<Vec<Pin>>),
    /// What rests because the server did not outlive it is to go on; whether anything does.
    GoOn(oneshot::Sender<bool>),
    Look(oneshot::Sender<SessionFigures>),
    /// Nothing can be kept any more, for this reason.
    StoreFailed(String),
}

/// Somebody's number, who they are, and what they are called.
pub type PersonNamed = (u32, Arc<str>, Arc<str>);

/// Whoever has a number, if they are here; and the name of whoever asks, if they are and have one.
pub type PersonHere = (Option<Entrant>, Option<Arc<str>>);

/// What became of a command from outside: the obstacle it placed, if it placed one.
pub type Outcome = Result<Option<PlacedObstacle>, Problem>;

/// Figures of a live session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SessionFigures {
    /// Who has said hello and is there.
    pub people: u32,
    /// Living metamers.
    pub metamers: u32,
    /// Bytes of memory that are taken for it.
    pub memory: u64,
    /// Commands that wait.
    pub waiting: usize,
    /// Bytes of frames that were sent and not answered.
    pub unanswered: usize,
    /// Why its growth rests.
    pub paused: Option<Pause>,
}

/// Reaches a live session.
#[derive(Clone, Debug)]
pub struct SessionHandle {
    requests: mpsc::Sender<Request>,
    /// The session has left the memory and may be loaded again.
    pub(super) gone: CancellationToken,
}

/// The session has ended meanwhile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ended;

impl SessionHandle {
    pub(super) fn new(requests: mpsc::Sender<Request>) -> Self {
        Self { requests, gone: CancellationToken::new() }
    }

    pub(super) fn is_ended(&self) -> bool {
        self.requests.is_closed()
    }

    pub(super) async fn send(&self, request: Request) -> Result<(), Ended> {
        self.requests.send(request).await.map_err(|_| Ended)
    }

    pub(super) async fn join(&self, outbox: Outbox, entrant: Entrant) -> Result<ClientId, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Join(outbox, entrant, answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// The document as it is between two commands.
    pub async fn read(&self) -> Result<ReadDocument, Unread> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Read(answer)).await?;
        answered.await.unwrap_or(Err(Unread::Ended))
    }

    /// Does a command that comes over no socket; answers when it is durable.
    pub async fn act(&self, principal: Principal, by: Entrant, command: Command) -> Result<Outcome, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Act(principal, by, Box::new(command), answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// The place of a row, if a living metamer has it.
    pub async fn anchor(&self, row: u32) -> Result<Option<Anchor>, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Anchor(row, answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Where comments are pinned, as clients were told last.
    pub(super) async fn pins(&self) -> Result<Vec<Pin>, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Pins(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Tells that what people say of the tree has changed.
    pub(super) async fn comment(&self, places: Vec<Place>, threads: Vec<u32>) -> Result<(), Ended> {
        self.send(Request::Commented(places, threads)).await
    }

    /// Who is here, once for each of their clients.
    pub async fn people(&self) -> Result<Vec<Principal>, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::People(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Everybody who has been here, and what they are called.
    pub async fn register(&self) -> Result<Register, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Register(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Those who are here and have a name.
    pub(super) async fn named(&self) -> Result<Vec<PersonNamed>, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Named(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Whoever has a number here, and what whoever asks is called here.
    pub(super) async fn person(&self, number: u32, asking: Principal) -> Result<PersonHere, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Person(number, asking, answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Its figures now.
    pub(super) async fn look(&self) -> Result<SessionFigures, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Look(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Has that go on which the server did not outlive; false if nothing rests for that (`OP5`).
    pub async fn go_on(&self) -> Result<bool, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::GoOn(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// Ends the session: what is done in it can no longer be kept.
    pub(super) async fn fail(&self, reason: &str) -> Result<(), Ended> {
        self.send(Request::StoreFailed(reason.to_owned())).await
    }

    /// The parameters in force.
    pub async fn parameters(&self) -> Result<ParameterValues, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Parameters(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// The design in force, if there is one.
    pub async fn design(&self) -> Result<Option<DesignInForce>, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Design(answer)).await?;
        answered.await.map_err(|_| Ended)
    }

    /// The mesh of an obstacle in the scene, if it is one and has one.
    pub async fn mesh(&self, obstacle: u32) -> Result<Option<Arc<Mesh>>, Ended> {
        let (answer, answered) = oneshot::channel();
        self.send(Request::Mesh(obstacle, answer)).await?;
        answered.await.map_err(|_| Ended)
    }
}
