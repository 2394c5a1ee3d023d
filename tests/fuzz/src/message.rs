//! What a client sends to a session, from its first message on.

use espalier_proto::access::Role;
use espalier_session::{ClientId, Entrant, Input, JournalEntry, Output, Session};

use crate::{METAMERS, SEED, command};

/// Work is done in so many slices at most.
const SLICES: usize = 60;
const CLIENT: ClientId = ClientId(1);

/// Sends each line as a message; the session lives on, and its journal alone gives the same document. Messages count as
/// taken when the client is still there in the end.
pub fn read(bytes: &[u8]) -> bool {
    let snapshot = Session::seedling(SEED, METAMERS);
    let Ok(session) = Session::restore("fuzzed", 1, Some(&snapshot), SEED, []) else { return false };
    let mut house = House { session, journal: Vec::new(), slices: 0, is_open: true };
    house.handle(Input::Connected(CLIENT, Entrant::new("somebody", Role::Editor)));
    for message in bytes.split(|&byte| byte == b'\n') {
        if !house.is_open {
            return false;
        }
        match std::str::from_utf8(message) {
            Ok(text) => house.handle(Input::Text(CLIENT, text.into())),
            Err(_) => house.handle(Input::Binary(CLIENT)),
        }
    }
    let House { session, journal, slices, is_open } = house;
    if let Some(document) = session.document()
        && slices < SLICES
    {
        let replayed = Session::restore("fuzzed", 2, Some(&snapshot), SEED, journal);
        let replayed = replayed.map(|session| session.document().map(|document| document.hash()));
        assert_eq!(replayed.as_ref().ok(), Some(&Some(document.hash())), "{replayed:?}");
    }
    is_open
}

/// Commands of all kinds and questions, behind a hello.
pub fn seeds() -> Vec<Vec<u8>> {
    const HELLO: &str = r#"{"type":"hello","protocol":4,"client":"a-key-of-the-test"}"#;
    const RETURN: &str = r#"{"type":"hello","protocol":4,"client":"a-key-of-the-test","resume":{"epoch":1,"generations":[1],"rows":1}}"#;
    let commands = (1..)
        .zip(command::lines())
        .map(|(id, command)| format!(r#"{{"type":"command","id":{id},"command":{command}}}"#));
    let all: Vec<String> = std::iter::once(HELLO.to_owned()).chain(commands).collect();
    let questions = [
        RETURN,
        r#"{"type":"ping","nonce":3}"#,
        r#"{"type":"received","sequence":1}"#,
        r#"{"type":"predict","rows":[],"steps":2}"#,
        r#"{"type":"here","pointer":{"kind":"wood","row":1,"along":0.5,"offset":[0,1,0]},"tool":"brush","radius":2}"#,
        r#"{"type":"follow","device":1}"#,
        r#"{"type":"command","id":1,"command":{"kind":"undo"}}"#,
    ];
    vec![all.join("\n").into_bytes(), all[..6].join("\n").into_bytes(), questions.join("\n").into_bytes()]
}

/// Everything around a session, at once: the journal is written and work is done as soon as it is asked for.
struct House {
    session: Session,
    journal: Vec<JournalEntry>,
    slices: usize,
    is_open: bool,
}

impl House {
    fn handle(&mut self, input: Input) {
        let mut inputs = vec![input];
        while let Some(input) = inputs.pop() {
            self.session.handle(0, input);
            while let Some(output) = self.session.poll_output() {
                match output {
                    Output::Journal(entries) => {
                        let through = entries.last().map_or(0, |entry| entry.number);
                        self.journal.extend(entries);
                        inputs.push(Input::Journaled(through));
                    }
                    Output::Work(mut work) if self.slices < SLICES => {
                        self.slices += 1;
                        work.run(|| false);
                        inputs.push(Input::Worked(work));
                    }
                    Output::Text(client, _) => inputs.push(Input::Written(client, 1)),
                    Output::Close(..) => self.is_open = false,
                    // Nothing else needs an answer, and predictions may take as long as they like.
                    _ => {}
                }
            }
        }
    }
}
