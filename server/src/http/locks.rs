//! Trees that owners alone change for now (`AC16`).

use axum::{Json, extract::State};
use espalier_proto::access::TreeLock;

use super::{
    Shared,
    comments::called,
    failure::{Failure, Path},
    trees,
};
use crate::{
    access::Caller,
    store::{Locks, Missing},
};

pub(super) async fn find(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
) -> Result<Json<TreeLock>, Failure> {
    trees::stored(&shared, &tree).await?;
    Ok(Json(TreeLock { by: shared.store.lock_of(&tree).await? }))
}

pub(super) async fn lock(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
    caller: Caller,
) -> Result<Json<TreeLock>, Failure> {
    let by = Some(called(&caller, None));
    locked(&shared, &tree, by).await
}

pub(super) async fn unlock(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
) -> Result<Json<TreeLock>, Failure> {
    locked(&shared, &tree, None).await
}

async fn locked(shared: &Shared, tree: &str, by: Option<String>) -> Result<Json<TreeLock>, Failure> {
    if shared.store.lock_tree(tree, by.clone()).await? {
        shared.tell_standings();
        Ok(Json(TreeLock { by }))
    } else {
        Err(Missing::Tree.into())
    }
}
