//! What people say of a tree as one page (`CT6`).

use std::collections::BTreeMap;

use axum::{
    extract::State,
    http::header,
    response::{IntoResponse, Response},
};
use espalier_proto::comment::Pin;
use espalier_session::Document;
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared, comments,
    failure::{Failure, Path, Query},
    file_name, held, sessions, trees,
};
use crate::{
    memory::{self, Need, Use},
    pool::Class,
    review::{self, CONTENT_SECURITY_POLICY, Language},
    store::{Comments, StoredTree},
    time::now,
};

/// How the page is to be.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Asked {
    /// In which language: `en` or `de`.
    #[serde(default)]
    language: Language,
}

pub(super) async fn page(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
    Query(Asked { language }): Query<Asked>,
) -> Result<Response, Failure> {
    let stored = trees::stored(&shared, &tree).await?;
    let states = states(&shared, &stored).await?;
    let bytes = shared.store.comment_bytes(&tree).await?;
    let pictures = bytes.pictures.min(review::MOST_PICTURES as u64);
    let claim = comments::room(&shared, memory::review(bytes.said, pictures)).await?;
    let html = review::summary(&*shared.store, &stored, &states, &now(), language).await?;
    let headers = [
        (header::CONTENT_TYPE, "text/html; charset=utf-8".to_owned()),
        (header::CONTENT_SECURITY_POLICY, CONTENT_SECURITY_POLICY.to_owned()),
        (header::CONTENT_DISPOSITION, file_name::inline(&format!("{} review", stored.name), "html")),
    ];
    Ok((headers, held::body(html, claim)).into_response())
}

/// Where the pins are: in the session of the tree if it is in memory, else in what was saved last.
async fn states(shared: &Shared, tree: &StoredTree) -> Result<BTreeMap<u32, Pin>, Failure> {
    if let Some(session) = &tree.session
        && let Some(pins) = shared.sessions.pins(session).await.filter(|pins| !pins.is_empty())
    {
        return Ok(pins.into_iter().map(|pin| (pin.thread, pin)).collect());
    }
    let pins = shared.store.pins(&tree.id).await?;
    if pins.is_empty() {
        return Ok(BTreeMap::new());
    }
    let document = sessions::kept_document(shared, &tree.id, tree.head.number).await?;
    let claim = shared.memory.take(Use::Export, Need::Other, memory::restore(document.bytes.len()))?;
    let found = shared.pool.run(Class::Whole, tree.id.as_str().into(), move |_| {
        let read = Document::from_bytes(&document.bytes).map(|document| review::states(&document, &pins));
        drop(claim);
        read
    });
    found.await?.map_err(|error| sessions::unreadable(&tree.id, &error))
}
