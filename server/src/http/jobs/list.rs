//! One's own jobs, page by page (`JB8`).

use axum::{Json, extract::State};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    super::{Shared, failure::Query, limit::Limit},
    JobState, address_of,
};
use crate::{
    access::Caller,
    jobs::{self, Listed},
};

/// Jobs in one answer.
const MAX_JOBS: u32 = 200;

/// Which jobs to list.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(in crate::http) struct Page {
    /// How many at most, 1 to 200.
    #[serde(default)]
    limit: Limit<MAX_JOBS>,
    /// Those before this number.
    before: Option<u64>,
}

/// Some jobs.
#[derive(Debug, Serialize, JsonSchema)]
pub(in crate::http) struct JobPage {
    /// The jobs, newest first.
    jobs: Vec<ListedJob>,
    /// The `before` of the next page, if there may be one.
    #[serde(skip_serializing_if = "Option::is_none")]
    next: Option<u64>,
}

/// A job in a list; at its address stand its results.
#[derive(Debug, Serialize, JsonSchema)]
struct ListedJob {
    /// Its name.
    id: String,
    /// Where it is told in full.
    address: String,
    /// When it was ordered: RFC 3339, UTC.
    ordered_at: String,
    /// How the names of its files end.
    format: &'static str,
    /// Where it is.
    state: JobState,
    /// Jobs that come first.
    ahead: usize,
    /// Seeds that have their file or their problem.
    done: usize,
    /// All seeds.
    all: usize,
}

/// One's own jobs (`JB8`).
pub(in crate::http) async fn list(
    State(shared): State<Shared>,
    caller: Caller,
    Query(page): Query<Page>,
) -> Json<JobPage> {
    let limit = page.limit.get() as usize;
    let found = shared.jobs.list(&caller, limit, page.before);
    let next = found.last().filter(|_| found.len() == limit).map(|last| last.job.number);
    let listed = found.into_iter().map(|Listed { name, job, ahead }| {
        let jobs::Progress { state, grown, failed, .. } = job.progress();
        ListedJob {
            address: address_of(&name),
            id: name,
            ordered_at: job.ordered_at.clone(),
            format: job.order.row.ending,
            state: state.into(),
            ahead,
            done: grown.len() + failed.len(),
            all: job.order.seeds.len(),
        }
    });
    Json(JobPage { jobs: listed.collect(), next })
}
