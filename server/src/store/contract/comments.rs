//! The contract of what people say of trees.

use super::{
    super::{
        CommentBytes, CommentChange, Comments, Deletion, Library, MOST_COMMENTS, Missing, NewComment,
        Picture, StoreError, TreeChange,
    },
    library::tree,
};

const AT: &str = "2026-05-01T12:00:00.000Z";

fn comment(author: &str, said: &str) -> NewComment {
    NewComment {
        person: format!("login {author}"),
        author: author.into(),
        written_at: AT.into(),
        said: said.into(),
        picture: None,
    }
}

fn picture(bytes: usize) -> Picture {
    Picture { media_type: "image/png".into(), bytes: vec![7; bytes] }
}

async fn said(store: &impl Comments, thread: u32) -> Vec<(u32, String)> {
    let found = store.thread("ash", thread).await.unwrap().expect("it is there");
    found.comments.into_iter().map(|comment| (comment.number, comment.said)).collect()
}

pub(super) async fn threads_are_listed_newest_first(store: &(impl Comments + Library)) {
    for id in ["ash", "yew"] {
        store.add_tree(tree(id, AT)).await.unwrap();
    }
    let nobody = store.add_thread("elm", None, comment("Ann", "?")).await;
    assert!(matches!(nobody, Err(StoreError::NotFound(Missing::Tree))));
    for n in 1..=3 {
        let pin = (n != 2).then(|| format!("[{n}]"));
        assert_eq!(store.add_thread("ash", pin, comment("Ann", &n.to_string())).await.unwrap(), n);
    }
    assert_eq!(store.add_thread("yew", None, comment("Ann", "yew")).await.unwrap(), 1, "of its own tree");
    let numbers = async |limit, before| {
        let found = store.threads("ash", limit, before).await.unwrap();
        found.into_iter().map(|thread| thread.number).collect::<Vec<_>>()
    };
    assert_eq!((numbers(2, None).await, numbers(2, Some(2)).await), (vec![3, 2], vec![1]));
    assert_eq!(store.pins("ash").await.unwrap(), [(1, "[1]".into()), (3, "[3]".into())]);
    assert_eq!(store.add_comment("ash", 2, comment("Bo", "two")).await.unwrap(), Some(2));
    assert_eq!(store.add_comment("ash", 4, comment("Bo", "?")).await.unwrap(), None);
    let found = store.thread("ash", 2).await.unwrap().unwrap();
    assert_eq!((found.comments[1].author.as_str(), found.comments[1].person.as_str()), ("Bo", "login Bo"));
    assert_eq!(found.resolved, None);
    let done = Some(("Cy".to_owned(), AT.to_owned()));
    assert!(store.resolve_thread("ash", 2, done.clone()).await.unwrap());
    assert_eq!(store.thread("ash", 2).await.unwrap().unwrap().resolved, done);
    assert!(store.resolve_thread("ash", 2, None).await.unwrap());
    assert_eq!(store.thread("ash", 2).await.unwrap().unwrap().resolved, None);
    assert!(!store.resolve_thread("ash", 4, None).await.unwrap());
}

pub(super) async fn comments_change_and_go(store: &(impl Comments + Library)) {
    store.add_tree(tree("ash", AT)).await.unwrap();
    let with_picture = NewComment { picture: Some(picture(9)), ..comment("Ann", "one") };
    store.add_thread("ash", Some("[]".into()), with_picture).await.unwrap();
    store.add_comment("ash", 1, comment("Bo", "two")).await.unwrap();
    assert_eq!(store.comment_picture("ash", 1, 1).await.unwrap(), Some(picture(9)));
    assert_eq!(store.comment_picture("ash", 1, 2).await.unwrap(), None);
    let edited = CommentChange::Edited { said: "ONE".into(), at: AT.into() };
    assert!(store.change_comment("ash", 1, 1, edited.clone()).await.unwrap());
    assert!(!store.change_comment("ash", 1, 3, edited).await.unwrap());
    assert_eq!(said(store, 1).await, [(1, "ONE".into()), (2, "two".into())]);
    assert_eq!(store.comment_picture("ash", 1, 1).await.unwrap(), Some(picture(9)), "it stays");
    assert!(store.change_comment("ash", 1, 1, CommentChange::Deleted).await.unwrap());
    assert!(!store.change_comment("ash", 1, 1, CommentChange::Deleted).await.unwrap(), "it is gone");
    assert_eq!(store.comment_picture("ash", 1, 1).await.unwrap(), None);
    assert_eq!(said(store, 1).await, [(2, "two".into())]);
    assert_eq!(store.add_comment("ash", 1, comment("Ann", "three")).await.unwrap(), Some(3));
    for number in [2, 3] {
        store.change_comment("ash", 1, number, CommentChange::Deleted).await.unwrap();
    }
    assert_eq!(store.thread("ash", 1).await.unwrap(), None, "a thread goes with its last comment");
    assert_eq!(store.threads("ash", 9, None).await.unwrap(), []);
    assert_eq!(store.pins("ash").await.unwrap(), []);
    assert_eq!(store.add_comment("ash", 1, comment("Ann", "?")).await.unwrap(), None);
    assert_eq!(store.add_thread("ash", None, comment("Ann", "?")).await.unwrap(), 2, "its number does not");
}

pub(super) async fn what_is_seen_of_threads_only_grows(store: &(impl Comments + Library)) {
    store.add_tree(tree("ash", AT)).await.unwrap();
    store.add_thread("ash", None, comment("Ann", "one")).await.unwrap();
    store.add_comment("ash", 1, comment("Ann", "two")).await.unwrap();
    assert!(store.see_thread("ash", "bo", 1, 1).await.unwrap());
    assert!(!store.see_thread("ash", "bo", 2, 1).await.unwrap());
    assert_eq!(store.seen_threads("ash", "bo").await.unwrap(), [(1, 1)]);
    assert_eq!(store.seen_threads("ash", "cy").await.unwrap(), []);
    store.see_thread("ash", "bo", 1, 77).await.unwrap();
    assert_eq!(store.seen_threads("ash", "bo").await.unwrap(), [(1, 2)], "no more than there is");
    store.see_thread("ash", "bo", 1, 1).await.unwrap();
    assert_eq!(store.seen_threads("ash", "bo").await.unwrap(), [(1, 2)]);
}

pub(super) async fn comments_are_bounded(store: &(impl Comments + Library)) {
    store.add_tree(tree("ash", AT)).await.unwrap();
    store.add_thread("ash", None, comment("Ann", "1")).await.unwrap();
    for _ in 1..MOST_COMMENTS {
        store.add_comment("ash", 1, comment("Ann", "more")).await.unwrap();
    }
    assert!(matches!(store.add_comment("ash", 1, comment("Ann", "?")).await, Err(StoreError::Full)));
    let large = |bytes| NewComment { picture: Some(picture(bytes)), ..comment("Ann", "large") };
    store.add_thread("ash", None, large(60 << 20)).await.unwrap();
    assert!(matches!(store.add_thread("ash", None, large(5 << 20)).await, Err(StoreError::Full)));
    store.change_comment("ash", 2, 1, CommentChange::Deleted).await.unwrap();
    store.add_thread("ash", None, large(5 << 20)).await.unwrap();
    let wordy = |bytes: usize| comment("Ann", &"\u{e4}".repeat(bytes / 2));
    let before = store.comment_bytes("ash").await.unwrap();
    assert_eq!(before.pictures, 5 << 20);
    store.add_thread("ash", None, wordy(60 << 20)).await.unwrap();
    assert_eq!(
        store.comment_bytes("ash").await.unwrap().said,
        before.said + (60 << 20),
        "bytes, not letters"
    );
    assert!(matches!(store.add_thread("ash", None, wordy(5 << 20)).await, Err(StoreError::Full)));
    assert!(matches!(store.add_comment("ash", 4, wordy(5 << 20)).await, Err(StoreError::Full)));
    let edited = |bytes: usize| CommentChange::Edited { said: wordy(bytes).said, at: AT.into() };
    assert!(matches!(store.change_comment("ash", 4, 1, edited(65 << 20)).await, Err(StoreError::Full)));
    assert!(store.change_comment("ash", 4, 1, edited(58 << 20)).await.unwrap());
    assert_eq!(store.add_comment("ash", 4, wordy(5 << 20)).await.unwrap(), Some(2));
    assert_eq!(store.comment_bytes("elm").await.unwrap(), CommentBytes::default());
}

pub(super) async fn comments_go_with_their_tree(store: &(impl Comments + Library)) {
    store.add_tree(tree("ash", AT)).await.unwrap();
    store.add_thread("ash", None, comment("Ann", "1")).await.unwrap();
    let gone = TreeChange { deletion: Some(Deletion::Deleted(AT.into())), ..TreeChange::default() };
    store.change_tree("ash", None, gone).await.unwrap();
    assert_eq!(store.threads("ash", 9, None).await.unwrap().len(), 1, "it may come back");
    store.purge("2027", 9).await.unwrap();
    assert_eq!(store.threads("ash", 9, None).await.unwrap(), []);
}
