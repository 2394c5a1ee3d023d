//! Replays: copies of sessions in which one person plays the design from its beginning (`RP1`).

use espalier_session::Session;

use super::Shared;
use crate::{
    live::{OpenError, SessionHandle},
    memory::{self, Growing, Use},
    pool::Class,
};

/// A copy of a session as it is now, which nobody else finds and of which nothing is kept.
pub(super) async fn copied(
    shared: &Shared,
    name: &str,
    session: &SessionHandle,
) -> Result<SessionHandle, OpenError> {
    let document = session.read().await?;
    let people = session.register().await?;
    let claim = shared.memory.take_soon(Use::Session, memory::restore(document.bytes.len())).await?;
    let (room, of, epoch) = (Growing::new(claim), name.to_owned(), rand::random());
    let copying = shared
        .pool
        .run(Class::Whole, name.into(), move |_| Session::replay(of, epoch, &document.bytes, people));
    Ok(shared.sessions.play(name, copying.await??, room))
}
