//! Sessions that the server does not outlive (`OP5`).

use espalier_proto::Pause;

use super::*;

/// A session whose journal asks for growth that is in no snapshot.
async fn with_growth(house: &House) -> Lease {
    let lease = house.store.acquire("oak").await.unwrap();
    house.store.append(&lease, SIMULATION_VERSION, &[grown(1), grown(2)]).await.unwrap();
    lease
}

#[tokio::test]
async fn op5_what_was_tried_twice_and_came_to_no_end_waits_for_an_owner() {
    let house = House::new().await;
    let lease = with_growth(&house).await;
    for tried in 1..=2 {
        let begin: restoring::Begin = |_, _, _, _, _, _| panic!("on purpose, for a test");
        let (services, progress) = (&house.sessions.0.services, Progress::default());
        let opened = restoring::restored_by(begin, services, "oak", &lease, &progress).await;
        assert!(matches!(opened, Err(OpenError::Panicked(_))), "{tried}");
    }
    let mut visitor = house.visit().await;
    let (_, acknowledged, metamers) = visitor.welcome().await;
    assert_eq!((acknowledged, metamers), (2, 0), "it is kept and not done");
    let paused = |message| match message {
        ServerMessage::State { state } => Some(state.paused),
        _ => None,
    };
    assert_eq!(visitor.hear(paused).await, Some(Pause::Crashes));
    // To leave and come back is no way around it.
    let house = house.restarted().await;
    let mut visitor = house.visit().await;
    assert_eq!(visitor.hear(paused).await, Some(Pause::Crashes));
    assert_eq!(visitor.session.go_on().await, Ok(true));
    visitor.reached(4).await;
    assert_eq!(visitor.session.go_on().await, Ok(false), "nothing waits any more");

    // It lives: the next time counts anew.
    let house = house.restarted().await;
    assert_eq!(house.store.count_try(&house.store.acquire("oak").await.unwrap()).await.unwrap(), 1);
}

#[tokio::test]
async fn op5_a_session_that_opens_is_not_counted() {
    let house = House::new().await;
    with_growth(&house).await;
    for _ in 0..4 {
        // The journal is done again each time, for the server is killed before there is a snapshot.
        let session = house.sessions.open("oak").await.unwrap().unwrap();
        session.read().await.unwrap();
        let _ = session.fail("on purpose, for a test").await;
        session.gone.cancelled().await;
    }
    let mut visitor = house.visit().await;
    let paused = |message| match message {
        ServerMessage::State { state } => Some(state.paused),
        _ => None,
    };
    assert_eq!(visitor.hear(paused).await, None);
}

#[tokio::test]
async fn op5_a_session_whose_snapshot_the_server_does_not_outlive_waits_as_a_whole() {
    let house = House::new().await;
    let lease = house.store.acquire("oak").await.unwrap();
    // The journal holds nothing.
    let dies: restoring::Begin = |_, _, _, _, _, _| panic!("on purpose, for a test");
    let (services, progress) = (&house.sessions.0.services, Progress::default());
    for _ in 0..2 {
        let opened = restoring::restored_by(dies, services, "oak", &lease, &progress).await;
        assert!(matches!(opened, Err(OpenError::Panicked(_))));
    }
    house.store.release(lease).await;
    // It is not even tried, however often somebody comes and whichever server that is.
    for _ in 0..2 {
        let waits = house.sessions.open("oak").await.unwrap_err();
        assert!(matches!(waits, OpenError::Waits) && waits.is_final(), "{waits}");
    }
    let house = house.restarted().await;
    let lease = house.store.acquire("oak").await.unwrap();
    let (services, progress) = (&house.sessions.0.services, Progress::default());
    let untried = restoring::restored_by(dies, services, "oak", &lease, &progress).await;
    assert!(matches!(untried, Err(OpenError::Waits)));
    house.store.release(lease).await;
    // An owner has it tried, and it opens: it counts anew from then on.
    assert!(house.sessions.open_anew("oak").await.unwrap().is_some());
    let mut visitor = house.visit().await;
    assert_eq!(visitor.welcome().await.1, 0);
    let house = house.restarted().await;
    assert_eq!(house.store.count_try(&house.store.acquire("oak").await.unwrap()).await.unwrap(), 1);
}

#[tokio::test]
async fn op5_what_cannot_be_restored_is_damaged_however_often_it_is_tried() {
    let house = House::new().await;
    let lease = house.store.acquire("oak").await.unwrap();
    let damaged: restoring::Begin = |_, _, _, _, _, _| Err(RestoreError::Gap { expected: 1, found: 2 });
    for tried in 1..5 {
        let (services, progress) = (&house.sessions.0.services, Progress::default());
        let opened = restoring::restored_by(damaged, services, "oak", &lease, &progress).await;
        assert!(matches!(opened, Err(OpenError::Restore(_))), "{tried}");
    }
}

#[tokio::test]
async fn a_server_that_stops_waits_for_no_journal() {
    let house = House::new().await;
    let lease = with_growth(&house).await;
    let (services, progress) = (&house.sessions.0.services, Progress::default());
    services.stop.cancel();
    let opened = restoring::restored(services, "oak", &lease, &progress).await;
    assert!(matches!(opened, Err(OpenError::Stopping)));
    let stored = house.store.load_session("oak", None).await.unwrap().unwrap();
    assert_eq!((stored.entries.len(), stored.damage), (2, vec![]), "all of it is there for the next time");
    assert_eq!(house.store.count_try(&lease).await.unwrap(), 1, "it has not failed");
}
