//! Pictures that are drawn before anybody asks for them: of what was saved, when nobody's work is in the way.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};

use tokio::sync::Notify;
use tokio_util::sync::CancellationToken;

use super::{
    Shared,
    versions::{THUMBNAIL, TURNTABLE, picture_of},
};
use crate::{drawn::Why, store::Library};

/// Trees that wait at most; of those that waited longest pictures are drawn when they are asked for.
const MOST: usize = 1000;

/// Versions that were saved and wait for their pictures, of each tree the newest alone.
#[derive(Clone, Debug, Default)]
pub struct Ahead(Arc<Waiting>);

#[derive(Debug, Default)]
struct Waiting {
    versions: Mutex<VecDeque<(String, u32)>>,
    some: Notify,
}

impl Ahead {
    /// A version was saved.
    pub(super) fn add(&self, tree: &str, version: u32) {
        let mut versions = self.versions();
        match versions.iter_mut().find(|(other, _)| other == tree) {
            Some((_, newest)) => *newest = version.max(*newest),
            None => versions.push_back((tree.to_owned(), version)),
        }
        if versions.len() > MOST {
            versions.pop_front();
        }
        drop(versions);
        self.0.some.notify_one();
    }

    /// The version that waits longest, once there is one.
    async fn next(&self) -> (String, u32) {
        loop {
            if let Some(next) = self.versions().pop_front() {
                return next;
            }
            self.0.some.notified().await;
        }
    }

    fn versions(&self) -> std::sync::MutexGuard<'_, VecDeque<(String, u32)>> {
        self.0.versions.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Draws the pictures of what is saved, one after the other, until the server stops.
pub async fn draw_ahead(shared: Shared, stop: CancellationToken) {
    let work = async {
        loop {
            let (tree, version) = shared.ahead.next().await;
            for kind in [THUMBNAIL, TURNTABLE] {
                // What is deleted, or has no room now, is drawn when it is asked for; and a newer version comes by itself.
                let is_newest = shared
                    .store
                    .tree(&tree)
                    .await
                    .ok()
                    .flatten()
                    .is_some_and(|now| now.deleted_at.is_none() && now.head.number == version);
                let has_one = kind == THUMBNAIL
                    && shared.store.thumbnail(&tree, version).await.is_ok_and(|picture| picture.is_some());
                if is_newest
                    && !has_one
                    && let Err(failure) = picture_of(&shared, Why::Ahead, &tree, version, kind).await
                {
                    tracing::debug!(tree, version, ?failure, "no picture was drawn ahead");
                }
            }
        }
    };
    stop.run_until_cancelled(work).await;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn of_each_tree_the_newest_version_waits_in_the_place_of_the_first() {
        let ahead = Ahead::default();
        for (tree, version) in [("ash", 1), ("yew", 1), ("ash", 3), ("ash", 2)] {
            ahead.add(tree, version);
        }
        assert_eq!(ahead.next().await, ("ash".into(), 3));
        ahead.add("ash", 4);
        assert_eq!(ahead.next().await, ("yew".into(), 1));
        assert_eq!(ahead.next().await, ("ash".into(), 4));
        for number in 0..=MOST {
            ahead.add(&number.to_string(), 1);
        }
        assert_eq!((ahead.next().await.0, ahead.versions().len()), ("1".into(), MOST - 1));
    }
}
