//! Who is here, over real sockets (`PS`).

use espalier_proto::{PointerNews, PointerPlace, Whereabouts};
use espalier_tests::{client::Client, scratch::Scratch, server::Server};
use serde_json::json;

async fn here(client: &mut Client, x: f32) {
    let pointer = json!({ "kind": "space", "position": [x, 1.0, 0.0] });
    client.send_message(&json!({ "type": "here", "pointer": pointer, "tool": "brush", "radius": 2.0 })).await;
}

fn states(client: &Client) -> Vec<Whereabouts> {
    client.people.iter().flat_map(|person| &person.devices).map(|device| device.state).collect()
}

#[tokio::test]
async fn ps3_who_does_not_answer_is_gone_and_who_closes_is_not_there() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(7);
    let mut ann = Client::connect(server.port(), &session, "ann-tablet").await;
    let mut ben = Client::connect(server.port(), &session, "ben-tablet").await;
    here(&mut ann, 1.0).await;
    here(&mut ben, 2.0).await;
    ann.until("both are here", |ann| states(ann) == [Whereabouts::Here; 2]).await;
    // Both sit at the server's machine: they are one person with two devices.
    assert_eq!(ann.people.len(), 1);
    let told = |ann: &Client| {
        let mut all = ann.presence.iter().flat_map(|frame| &frame.devices);
        all.find(|news| news.device == 2).and_then(|news| news.pointer)
    };
    ann.until("the pointer of the other one comes", |ann| told(ann).is_some()).await;
    let expected = PointerNews { place: PointerPlace::Space([64, 32, 0]), radius: 128 };
    assert_eq!(told(&ann), Some(expected));
    // Nobody takes what comes for the other one, so that its pings stay unanswered.
    ann.until("it is gone", |ann| states(ann) == [Whereabouts::Here, Whereabouts::Gone]).await;
    here(&mut ben, 3.0).await;
    ann.until("it is back", |ann| states(ann) == [Whereabouts::Here; 2]).await;
    ben.vanish();
    ann.until("it is not there", |ann| states(ann) == [Whereabouts::Here]).await;
}
