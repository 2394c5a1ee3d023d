//! What is to be known of the trees of a job (`JB10`).

use espalier_proto::OperationKind;
use espalier_session::LeftOut;
use schemars::JsonSchema;
use serde::Serialize;

/// What is to be known of all trees of a job.
#[derive(Debug, Serialize, JsonSchema)]
pub(in crate::http) struct JobNote {
    /// Which it is, for programs that have words of their own for it.
    note: JobNoteKind,
    /// What was done by hand.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    operations: Vec<DoneByHand>,
    /// A sentence that says it.
    message: String,
}

/// What there is to say of trees of jobs.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(inline)]
enum JobNoteKind {
    /// What was drawn and done by hand in the tree that they are like is no part of them.
    ByHandLeftOut,
    /// That tree began with wood, as one of a scan does, and that is no part of them.
    WoodLeftOut,
}

/// What was done by hand, and how often.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(inline)]
struct DoneByHand {
    kind: OperationKind,
    count: u32,
}

/// What trees are without, in sentences; nothing where they are without nothing.
pub(super) fn notes_of(LeftOut { by_hand, is_of_wood }: &LeftOut) -> Vec<JobNote> {
    let operations: Vec<_> = by_hand.iter().map(|&(kind, count)| DoneByHand { kind, count }).collect();
    let by_hand = (!operations.is_empty()).then(|| JobNote {
        note: JobNoteKind::ByHandLeftOut,
        operations,
        message: "What was drawn and done by hand in the tree of the template is no part of these trees."
            .into(),
    });
    let wood = is_of_wood.then(|| JobNote {
        note: JobNoteKind::WoodLeftOut,
        operations: Vec::new(),
        message: "The wood that the tree of the template began with is no part of these trees.".into(),
    });
    by_hand.into_iter().chain(wood).collect()
}
