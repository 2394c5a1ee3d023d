//! Guests who are in a session, with the links by which they came (`AC12`).

use axum::{Json, extract::State};
use espalier_proto::access::GuestHere;

use super::{
    Shared,
    failure::{Failure, Path},
    links,
    removals::tree_of,
};
use crate::{access::Caller, store::Passes, time::now};

pub(super) async fn list(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<Json<Vec<GuestHere>>, Failure> {
    // A guest is there for the tree of the session, so that one without a tree has none.
    let Some(tree) = tree_of(&shared, &session).await? else { return Ok(Json(Vec::new())) };
    let at = now();
    let mut all = Vec::new();
    // Whoever comes by a link has the name of the link at least.
    for (person, is, _) in shared.sessions.named(&session).await {
        let Some(hash) = Caller::pass_of(&is) else { continue };
        let pass = shared.store.pass(hash, &at).await?;
        if let Some(pass) = pass.filter(|pass| pass.tree.as_ref() == Some(&tree)) {
            all.push(GuestHere { person, tree: tree.clone(), link: links::described(pass) });
        }
    }
    Ok(Json(all))
}
