//! Files that are sent to the server: taken in on its disk, so that nobody who sends slowly holds up others or memory,
//! and then read, few at once.

use std::{
    fs::File as OnDisk,
    io::{self, Read, Seek, Write},
    net::IpAddr,
    sync::Arc,
    time::Duration,
};

use axum::{
    Extension,
    body::Bytes,
    extract::{FromRequest, Request},
};
use espalier_proto::{Problem, Reason};
use futures_util::StreamExt;
use tokio::{
    sync::{OwnedSemaphorePermit, Semaphore},
    task::spawn_blocking,
    time::timeout,
};

use super::failure::{BODY, Failure, MostBytes};
use crate::{
    access::{self, Peer},
    memory::{self, Claim, Memory, Use},
    places::Places,
};

/// Files that arrive at once, for each address of the API,
const ARRIVING: usize = 32;
/// and those of one network, but for this machine.
const ARRIVING_OF_ONE: usize = 8;
/// A file of which nothing arrives for so long is given up.
const PATIENCE: Duration = Duration::from_secs(10);
/// Bytes that wait in memory for the disk.
const PIECE: usize = 256 * 1024;
/// When whoever finds no place may try again.
const AGAIN: Duration = Duration::from_secs(30);

/// What an address does with the files that it takes.
#[derive(Clone, Debug)]
pub(super) struct Uploads {
    arriving: Places,
    reading: Arc<Semaphore>,
    patience: Duration,
}

/// Takes files, and reads so many at once.
pub(super) fn uploads(at_once: usize) -> Extension<Uploads> {
    Extension(Uploads {
        arriving: Places::new(ARRIVING, ARRIVING_OF_ONE),
        reading: Arc::new(Semaphore::new(at_once)),
        patience: PATIENCE,
    })
}

/// The body of a request as a file, and the right to read it while this is held.
#[derive(Debug)]
pub(super) struct File(pub(super) Bytes, pub(super) Turn);

/// The same, on the disk still, for those who need not have all of it at once.
#[derive(Debug)]
pub(super) struct FileOnDisk(pub(super) OnDisk, pub(super) Turn);

/// The right to read a file.
#[derive(Debug)]
pub(super) struct Turn {
    _permit: OwnedSemaphorePermit,
    /// What reading it takes.
    _claim: Option<Claim>,
}

impl<S: Send + Sync> FromRequest<S> for File {
    type Rejection = Failure;

    async fn from_request(request: Request, state: &S) -> Result<Self, Failure> {
        let FileOnDisk(file, turn) = FileOnDisk::from_request(request, state).await?;
        let bytes = on_disk(move || read(file)).await.map_err(|error| failed(&error))?;
        Ok(Self(bytes, turn))
    }
}

impl<S: Send + Sync> FromRequest<S> for FileOnDisk {
    type Rejection = Failure;

    async fn from_request(request: Request, _: &S) -> Result<Self, Failure> {
        let Some(uploads) = request.extensions().get::<Uploads>().cloned() else {
            return Err(failed(&io::Error::other("this address takes no files")));
        };
        let from = access::address(request.extensions().get::<Peer>());
        let memory = request.extensions().get::<Memory>().cloned();
        uploads.take(from, memory, request).await
    }
}

impl Uploads {
    async fn take(
        self,
        from: IpAddr,
        memory: Option<Memory>,
        request: Request,
    ) -> Result<FileOnDisk, Failure> {
        let most = MostBytes::of(&request);
        if most.are_exceeded(request.headers()) {
            return Err(too_large(most));
        }
        let place = self.arriving.take(from);
        let place = place.ok_or_else(|| Failure::too_often(BODY, "Too many files arrive already.", AGAIN))?;
        let file = self.arrive(request, most).await?;
        drop(place);
        let permit = self.reading.acquire_owned().await;
        let permit = permit.map_err(|error| failed(&io::Error::other(error)))?;
        let claim = match memory {
            Some(memory) => {
                let bytes = file.metadata().map_err(|error| failed(&error))?.len();
                Some(memory.take_soon(Use::Upload, memory::upload(bytes)).await?)
            }
            None => None,
        };
        Ok(FileOnDisk(file, Turn { _permit: permit, _claim: claim }))
    }

    /// A file on disk, when all of it has come.
    async fn arrive(&self, request: Request, most: MostBytes) -> Result<OnDisk, Failure> {
        let mut pieces = request.into_body().into_data_stream();
        let mut file = on_disk(tempfile::tempfile).await.map_err(|error| failed(&error))?;
        let (mut waiting, mut arrived) = (Vec::new(), 0);
        loop {
            let piece = match timeout(self.patience, pieces.next()).await {
                Ok(piece) => piece.transpose().map_err(|_| cut_off())?,
                Err(_) => return Err(Failure::new(Reason::Late, "The file takes too long to arrive.")),
            };
            let is_whole = piece.is_none();
            let piece = piece.unwrap_or_default();
            arrived += piece.len();
            if arrived > most.bytes() {
                return Err(too_large(most));
            }
            waiting.extend_from_slice(&piece);
            if is_whole || waiting.len() >= PIECE {
                let bytes = std::mem::take(&mut waiting);
                let written = on_disk(move || file.write_all(&bytes).map(|()| file)).await;
                file = written.map_err(|error| failed(&error))?;
            }
            if is_whole {
                return Ok(file);
            }
        }
    }
}

fn too_large(most: MostBytes) -> Failure {
    let problem = Problem::new(Reason::LargeFile, format!("The file is larger than {most}."));
    problem.at(BODY, most.to_string()).into()
}

fn cut_off() -> Failure {
    Problem::new(Reason::FileCutOff, "The file did not arrive whole.").at(BODY, "a whole file").into()
}

fn failed(error: &io::Error) -> Failure {
    tracing::error!(%error, "a file cannot be taken in");
    Failure::new(Reason::Failed, "The server cannot take the file in; nothing was changed.")
}

fn read(mut file: OnDisk) -> io::Result<Bytes> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    Ok(bytes.into())
}

async fn on_disk<T: Send + 'static>(work: impl FnOnce() -> io::Result<T> + Send + 'static) -> io::Result<T> {
    spawn_blocking(work).await.map_err(io::Error::other)?
}

#[cfg(test)]
mod tests {
    use axum::{
        Router,
        body::Body,
        http::{StatusCode, header},
        routing::post,
    };
    use futures_util::stream;
    use tower::ServiceExt;

    use super::{super::failure::body_limit, *};

    /// An address that takes files of up to ten bytes and reads one at once; it answers with their bytes.
    fn address() -> Router {
        Router::new().route(
            "/",
            post(async |File(bytes, _turn): File| bytes)
                .layer::<_, std::convert::Infallible>(uploads(1))
                .layer(body_limit(10)),
        )
    }

    fn sent(body: Body) -> Request {
        let mut request = Request::post("/").body(body).unwrap();
        request.extensions_mut().insert(Peer([10, 0, 0, 1].into()));
        request
    }

    /// The beginning of a file of which no more comes.
    fn begun() -> Body {
        let first = stream::iter([Ok::<_, io::Error>("a".to_owned())]);
        Body::from_stream(first.chain(stream::pending()))
    }

    #[tokio::test]
    async fn lm18_a_file_that_arrives_slowly_holds_up_no_other() {
        let address = address();
        let slow = [begun(), begun(), begun()].map(|body| {
            let mut answer = Box::pin(address.clone().oneshot(sent(body)));
            assert!(futures_util::FutureExt::now_or_never(&mut answer).is_none());
            answer
        });
        let answer = address.oneshot(sent(Body::from("abc"))).await.unwrap();
        assert_eq!(answer.status(), StatusCode::OK);
        assert_eq!(axum::body::to_bytes(answer.into_body(), 100).await.unwrap(), "abc");
        drop(slow);
    }

    #[tokio::test]
    async fn lm18_one_network_sends_so_many_files_at_once() {
        let address = address();
        let slow: Vec<_> = (0..ARRIVING_OF_ONE)
            .map(|_| {
                let mut answer = Box::pin(address.clone().oneshot(sent(begun())));
                assert!(futures_util::FutureExt::now_or_never(&mut answer).is_none());
                answer
            })
            .collect();
        let refused = address.clone().oneshot(sent(Body::from("abc"))).await.unwrap();
        assert_eq!(refused.status(), StatusCode::TOO_MANY_REQUESTS);
        assert_eq!(refused.headers()[header::RETRY_AFTER], "30");
        drop(slow);
        assert_eq!(address.oneshot(sent(Body::from("abc"))).await.unwrap().status(), StatusCode::OK);
    }

    #[tokio::test]
    async fn lm18_a_file_of_which_nothing_arrives_is_given_up() {
        let Extension(uploads) = uploads(1);
        let uploads = Uploads { patience: Duration::from_millis(10), ..uploads };
        let failure = uploads.take([10, 0, 0, 1].into(), None, sent(begun())).await.unwrap_err();
        assert_eq!(failure, Failure::new(Reason::Late, "The file takes too long to arrive."));
    }

    #[tokio::test]
    async fn a_file_that_is_too_large_or_cut_off_is_refused_as_soon_as_it_shows() {
        let pieces = stream::iter(["abcdef", "ghijkl"]).map(Ok::<_, io::Error>).chain(stream::pending());
        let answer = address().oneshot(sent(Body::from_stream(pieces))).await.unwrap();
        assert_eq!(answer.status(), StatusCode::PAYLOAD_TOO_LARGE);
        let cut = stream::iter([Ok("abc"), Err(io::Error::other("gone"))]);
        let answer = address().oneshot(sent(Body::from_stream(cut))).await.unwrap();
        assert_eq!(answer.status(), StatusCode::BAD_REQUEST);
        let whole = address().oneshot(sent(Body::from("abcdefghij"))).await.unwrap();
        assert_eq!(whole.status(), StatusCode::OK);
    }

    #[tokio::test]
    async fn lm19_a_file_is_read_when_there_is_memory_for_it() {
        let memory = Memory::with_patience(100, Duration::from_millis(1));
        let with = |body| {
            let mut request = sent(body);
            request.extensions_mut().insert(memory.clone());
            request
        };
        let address = address();
        // Ten bytes take forty, and 85 of 100 may be taken.
        let other = memory.take(Use::Session, memory::Need::Other, 50).unwrap();
        let refused = address.clone().oneshot(with(Body::from("abcdefghij"))).await.unwrap();
        assert_eq!(refused.status(), StatusCode::SERVICE_UNAVAILABLE);
        assert_eq!(refused.headers()[header::RETRY_AFTER], "5");
        drop(other);
        let taken = address.oneshot(with(Body::from("abcdefghij"))).await.unwrap();
        assert_eq!(taken.status(), StatusCode::OK);
        assert_eq!(memory.look().taken(), 0);
    }
}
