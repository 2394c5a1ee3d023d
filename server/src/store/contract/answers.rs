//! The contract of answers that are given again.

use super::super::{Answer, AnswerKey, Answering, Answers, MostAnswers};

/// The key of this number, of somebody.
fn key(caller: u8, number: u32) -> AnswerKey {
    let mut key = [caller; 32];
    key[..4].copy_from_slice(&number.to_le_bytes());
    AnswerKey { caller: [caller; 32], key }
}

fn answer(body: &[u8]) -> Answer {
    let headers = vec![("location".to_owned(), "/api/v1/jobs/a \"job\"".to_owned())];
    Answer { request: [7; 32], status: 202, headers, body: body.to_owned() }
}

pub(super) async fn an_answer_is_kept_for_one_request(store: &impl Answers) {
    let begin =
        async |key, at, since| store.begin_answer(key, at, since, MostAnswers::default()).await.unwrap();
    assert_eq!(store.answer(key(1, 1)).await.unwrap(), None);
    let (a, b, c) = tokio::join!(
        begin(key(1, 1), "2026-05", "2026-04"),
        begin(key(1, 1), "2026-05", "2026-04"),
        begin(key(2, 1), "2026-05", "2026-04"),
    );
    assert_eq!((u8::from(a) + u8::from(b), c), (1, true), "of two with one key one is the first");
    assert_eq!(store.answer(key(1, 1)).await.unwrap(), Some(Answering::UnderWay));
    store.keep_answer(key(1, 1), answer(b"{}")).await.unwrap();
    assert!(!begin(key(1, 1), "2026-06", "2026-05").await);
    assert_eq!(store.answer(key(1, 1)).await.unwrap(), Some(Answering::Answered(answer(b"{}"))));
    assert_eq!(store.answer(key(2, 1)).await.unwrap(), Some(Answering::UnderWay), "another's is untouched");

    store.forget_answer(key(2, 1)).await.unwrap();
    assert_eq!(store.answer(key(2, 1)).await.unwrap(), None);
    assert!(begin(key(2, 1), "2026-06", "2026-05").await);
    // What is old counts for nothing, also before it is purged.
    assert!(begin(key(1, 1), "2026-07", "2026-06").await);
    assert_eq!(store.answer(key(1, 1)).await.unwrap(), Some(Answering::UnderWay));
    store.purge_answers("2026-07").await.unwrap();
    assert_eq!(store.answer(key(2, 1)).await.unwrap(), None);
    assert!(store.answer(key(1, 1)).await.unwrap().is_some());
    // An answer that comes after its request was forgotten is dropped.
    store.keep_answer(key(2, 1), answer(b"late")).await.unwrap();
    assert_eq!(store.answer(key(2, 1)).await.unwrap(), None);
}

pub(super) async fn answers_of_one_caller_are_bounded(store: &impl Answers) {
    let most = MostAnswers::default();
    let begin = async |key| assert!(store.begin_answer(key, "2026-05", "2026-04", most).await.unwrap());
    begin(key(2, 0)).await;
    let many = (0..=most.of_one as u32).map(|number| begin(key(1, number)));
    futures_util::future::join_all(many).await;
    // In which order those that wait for the same write come is not said, but the first group holds the first of them.
    let mut there = 0;
    for number in 0..=most.of_one as u32 {
        there += u64::from(store.answer(key(1, number)).await.unwrap().is_some());
    }
    assert_eq!(there, most.of_one);
    assert!(store.answer(key(2, 0)).await.unwrap().is_some(), "others keep theirs");
}

pub(super) async fn answers_of_all_callers_are_bounded(store: &impl Answers) {
    let most = MostAnswers { of_one: 4, of_all: 6 };
    let all: Vec<_> =
        [1, 1, 1, 2, 2, 2, 3, 3].into_iter().zip(0..).map(|(caller, at)| key(caller, at)).collect();
    for key in &all {
        assert!(store.begin_answer(*key, "2026-05", "2026-04", most).await.unwrap());
        store.keep_answer(*key, answer(b"{}")).await.unwrap();
    }
    let mut there = Vec::new();
    for key in &all {
        there.push(store.answer(*key).await.unwrap().is_some());
    }
    assert_eq!(there, [false, false, true, true, true, true, true, true], "the oldest go, whosever they are");
    assert!(store.begin_answer(all[0], "2026-05", "2026-04", most).await.unwrap(), "what has gone is new");
    assert_eq!(store.answer(all[2]).await.unwrap(), None);
}
