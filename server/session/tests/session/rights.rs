//! Who may edit a session (`AU`).

use espalier_proto::{ProblemCode, ServerMessage, access::Role};
use espalier_session::{Access, Entrant};

use crate::world::{World, grow, stranger_at};

#[test]
fn au2_who_may_look_sees_all_and_changes_nothing() {
    let mut world = World::new();
    let author = world.join("birch-01");
    let viewer = world.connect_with(Access::Look);
    world.hello(viewer, "viewer-1", None);
    world.command(viewer, 1, grow(1));
    world.command(author, 1, grow(1));
    world.command(viewer, 2, grow(1));
    // Sent again, as after a reconnection.
    world.command(viewer, 2, grow(1));
    world.settle();
    let texts = &world.peer(viewer).texts;
    assert!(matches!(texts.first(), Some(ServerMessage::Welcome { .. })));
    let refused: Vec<_> = texts
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
    assert_eq!(world.document().figures().step, 1);
}

#[test]
fn au2_what_one_may_is_told_of_each_connection() {
    let mut world = World::new();
    let viewer = world.connect_as(Entrant { role: Role::Viewer, ..stranger_at("birch-01") });
    world.hello(viewer, "birch-01", None);
    world.command(viewer, 1, grow(1));
    // The same client comes again, and may edit by now.
    let editor = world.join("birch-01");
    world.command(editor, 2, grow(1));
    world.settle();
    assert_eq!(world.document().figures().step, 1);
}
