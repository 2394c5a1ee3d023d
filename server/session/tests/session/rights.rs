//! Who may join and edit a session (`AU`).

use espalier_proto::{Command, ProblemCode, ServerMessage, version::CloseCode};
use espalier_session::{Access, ActId, Input, Principal, Rights};

use crate::world::{World, grow};

#[test]
fn au2_a_hello_is_asked_for_the_client_it_names() {
    let mut world = World::new();
    let member = world.join("birch-01");
    let only = Principal::client("birch-01");
    world.session.guard(Rights::new(move |who, access| {
        assert_eq!(access, Access::Join);
        Some(who) == only.as_ref()
    }));
    let stranger = world.join("stranger");
    assert_eq!(world.peer(stranger).closed, Some(CloseCode::CannotOpen));
    assert!(world.peer(stranger).texts.is_empty(), "nothing is told to a stranger");
    let again = world.join("birch-01");
    assert_eq!(world.peer(member).closed, Some(CloseCode::Replaced));
    assert!(matches!(world.peer(again).texts.first(), Some(ServerMessage::Welcome { .. })));
    // Nobody is sent away by somebody who may not come in himself.
    let watcher = Principal::client("birch-02");
    world.session.guard(Rights::new(move |who, _| Some(who) == watcher.as_ref()));
    world.join("birch-01");
    assert_eq!(world.peer(again).closed, None);
}

#[test]
fn au2_each_command_is_asked_for_before_it_enters_the_journal() {
    let mut world = World::new();
    let only = Principal::client("birch-01");
    world.session.guard(Rights::new(move |who, access| access == Access::Join || Some(who) == only.as_ref()));
    let (author, viewer) = (world.join("birch-01"), world.join("viewer-1"));
    world.command(viewer, 1, grow(1));
    world.command(author, 1, grow(1));
    world.command(viewer, 2, grow(1));
    // Sent again, as after a reconnection.
    world.command(viewer, 2, grow(1));
    let command = Command::from_json(r#"{"kind":"grow","steps":1}"#).unwrap();
    world.handle(Input::Act(ActId(1), Principal::visitor(), Box::new(command)));
    world.settle();
    let refused: Vec<_> = world
        .peer(viewer)
        .texts
        .iter()
        .filter_map(|text| match text {
            ServerMessage::Refused { id, problem } => Some((*id, problem.code, problem.message.as_str())),
            _ => None,
        })
        .collect();
    let sentence = "You may not do this here.";
    assert_eq!(refused[..2], [(1, ProblemCode::Refused, sentence), (2, ProblemCode::Refused, sentence)]);
    assert_eq!(refused[2].0, 2);
    let journaled: Vec<_> = world.disk.iter().map(|entry| entry.principal.to_string()).collect();
    assert_eq!(journaled, ["birch-01"]);
    assert!(matches!(world.acts.as_slice(), [(ActId(1), Err(problem))] if problem.message == sentence));
    assert_eq!(world.document().figures().step, 1);
}
