//! What has come of a message that is not whole yet: it takes memory like all else that is large (`LM19`).

use std::{
    io::{self, ErrorKind},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use crate::memory::{Claim, MESSAGE, Memory, Need, Use};

/// So much of a message is in what a socket takes.
const FREE: usize = 16 * 1024;
/// The head of a ping or a pong, with its mask.
const HEAD: usize = 6;

/// What is counted of one connection, by whoever reads its bytes and whoever reads its messages.
#[derive(Clone, Debug, Default)]
pub struct Unfinished(Arc<Mutex<Counted>>);

#[derive(Debug, Default)]
struct Counted {
    /// Where memory is taken from; nothing while the connection speaks HTTP.
    memory: Option<Memory>,
    /// Bytes since the last message was whole.
    bytes: usize,
    claim: Option<Claim>,
}

impl Unfinished {
    /// From now on there are messages, which take memory from here.
    pub fn count_in(&self, memory: Memory) {
        self.counted().memory = Some(memory);
    }

    /// So many bytes have come. Fails where there is no memory for a message as long.
    pub fn came(&self, bytes: usize) -> io::Result<()> {
        let mut counted = self.counted();
        let Some(memory) = counted.memory.clone() else { return Ok(()) };
        counted.bytes += bytes;
        if counted.bytes > FREE && counted.claim.is_none() {
            let taken = memory.take(Use::Socket, Need::Other, MESSAGE);
            counted.claim = Some(taken.map_err(|_| io::Error::from(ErrorKind::OutOfMemory))?);
        }
        Ok(())
    }

    /// Of what has come a ping or a pong with so many bytes was no part of a message.
    pub fn came_between(&self, bytes: usize) {
        let mut counted = self.counted();
        counted.bytes = counted.bytes.saturating_sub(HEAD + bytes);
    }

    /// A message is whole.
    pub fn is_whole(&self) {
        let mut counted = self.counted();
        counted.bytes = 0;
        counted.claim = None;
    }

    fn counted(&self) -> MutexGuard<'_, Counted> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_between_the_pieces_of_a_message_does_not_make_it_whole() {
        let (memory, socket) = (Memory::of(2 * MESSAGE), Unfinished::default());
        socket.count_in(memory.clone());
        socket.came(FREE).expect("that is in what a socket takes");
        for _ in 0..1000 {
            socket.came(HEAD + 4).expect("there is memory");
            socket.came_between(4);
        }
        assert_eq!(
            memory.look().taken_for(Use::Socket),
            MESSAGE,
            "a ping came before it was known to be one"
        );
        socket.is_whole();
        for _ in 0..10_000 {
            socket.came(HEAD + 4).expect("there is memory");
            socket.came_between(4);
        }
        assert_eq!(memory.look().taken_for(Use::Socket), 0, "pings alone add up to nothing");
    }

    #[test]
    fn lm19_messages_that_are_not_whole_take_memory() {
        let memory = Memory::of(3 * MESSAGE);
        let sockets: Vec<Unfinished> = (0..8).map(|_| Unfinished::default()).collect();
        assert!(sockets[0].came(1 << 30).is_ok(), "of HTTP nothing is counted here");
        for socket in &sockets {
            socket.count_in(memory.clone());
            socket.came(FREE).expect("that is in what a socket takes");
        }
        assert_eq!(memory.look().taken_for(Use::Socket), 0);
        let begun = sockets.iter().filter(|socket| socket.came(1).is_ok()).count();
        assert!((1..=3).contains(&begun), "{begun}");
        assert_eq!(memory.look().taken_for(Use::Socket), begun as u64 * MESSAGE);
        sockets[0].came(FREE).expect("a message takes memory once");
        let last = sockets.last().expect("there are some");
        assert_eq!(last.came(1).expect_err("no memory is left").kind(), ErrorKind::OutOfMemory);
        sockets[0].is_whole();
        last.came(1).expect("there is some again");
        drop((memory.clone(), sockets));
        assert_eq!(memory.look().taken_for(Use::Socket), 0, "whoever goes gives it back");
    }
}
