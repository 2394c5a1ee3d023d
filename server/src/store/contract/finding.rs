//! The contract of what trees are found by.

use super::{
    super::{
        Collection, CollectionChange, Contents, Deletion, Finding, Library, Missing, Sort, StoreError,
        TreeChange, TreeQuery,
        folding::{folded, searched},
    },
    library::{ids, page, tree},
};

async fn change(store: &impl Library, id: &str, change: TreeChange) {
    store.change_tree(id, None, change).await.unwrap();
}

fn tagged(tags: &[&str]) -> TreeChange {
    TreeChange { tags: Some(tags.iter().map(|&tag| tag.into()).collect()), ..TreeChange::default() }
}

fn lying_in(collection: Option<&str>) -> TreeChange {
    TreeChange { collection: Some(collection.map(str::to_owned)), ..TreeChange::default() }
}

pub(super) async fn collections_lie_in_each_other(store: &(impl Library + Finding)) {
    let new = |id: &str, parent: Option<&str>| Collection {
        id: id.into(),
        name: format!("Ä {id}"),
        parent: parent.map(str::to_owned),
        trees: 0,
    };
    for (id, parent) in [("wood", None), ("copse", Some("wood")), ("grove", Some("copse"))] {
        store.add_collection(new(id, parent)).await.unwrap();
    }
    let missing = store.add_collection(new("none", Some("nowhere"))).await;
    assert!(matches!(missing, Err(StoreError::NotFound(Missing::Parent))));
    let under =
        |parent: &str| CollectionChange { parent: Some(Some(parent.into())), ..CollectionChange::default() };
    for parent in ["wood", "copse", "grove"] {
        let inside_itself = store.change_collection("wood", under(parent)).await;
        assert!(matches!(inside_itself, Err(StoreError::Cycle)), "{parent}");
    }
    store.add_tree(tree("ash", "2026")).await.unwrap();
    store.add_tree(tree("elm", "2026")).await.unwrap();
    change(store, "ash", lying_in(Some("copse"))).await;
    let nowhere = store.change_tree("ash", None, lying_in(Some("nowhere"))).await;
    assert!(matches!(nowhere, Err(StoreError::NotFound(Missing::Collection))));
    let lying = async |collection: Option<&str>| {
        let collection = Some(collection.map(str::to_owned));
        ids(store, &TreeQuery { collection, ..TreeQuery::default() }).await
    };
    assert_eq!((lying(Some("copse")).await, lying(None).await), (vec!["ash".into()], vec!["elm".into()]));
    assert_eq!(lying(Some("nowhere")).await, Vec::<String>::new());
    let renamed = CollectionChange { name: Some("Zoo".into()), ..CollectionChange::default() };
    store.change_collection("wood", renamed).await.unwrap();
    let listed = |all: Vec<Collection>| -> Vec<_> {
        all.into_iter().map(|one| (one.id, one.parent.unwrap_or_default(), one.trees)).collect()
    };
    let expected = [("copse", "wood", 1), ("grove", "copse", 0), ("wood", "", 0)];
    let owned = |(id, parent, trees): (&str, &str, u32)| (id.to_owned(), parent.to_owned(), trees);
    assert_eq!(listed(store.collections().await.unwrap()), expected.map(owned));
    store.delete_collection("copse").await.unwrap();
    assert_eq!(
        listed(store.collections().await.unwrap()),
        [("grove", "wood", 0), ("wood", "", 1)].map(owned)
    );
    assert_eq!(lying(Some("wood")).await, ["ash"], "what lay there lies in its parent");
    let gone = store.delete_collection("copse").await;
    assert!(matches!(gone, Err(StoreError::NotFound(Missing::Collection))));
    let under_it = store.change_collection("grove", under("copse")).await;
    assert!(matches!(under_it, Err(StoreError::NotFound(Missing::Parent))));
    store
        .change_collection("grove", CollectionChange { parent: Some(None), ..CollectionChange::default() })
        .await
        .unwrap();
    store.delete_collection("wood").await.unwrap();
    assert_eq!(lying(None).await, ["elm", "ash"]);
}

async fn tags_that_differ_in_case_are_one(store: &(impl Library + Finding)) {
    change(store, "cedar", tagged(&["TALL", "Ähre", "ÄHRE", "Ahre"])).await;
    let tags = store.tree("cedar").await.unwrap().unwrap().tags;
    assert_eq!(tags, ["Ahre", "tall", "Ähre"], "spelt as another tree has it, or as it came first");
    assert_eq!(store.tags().await.unwrap(), [("Ahre".into(), 1), ("tall".into(), 2), ("Ähre".into(), 1)]);
    for (tag, expected) in [("Tall", vec!["birch", "cedar"]), ("ähre", vec!["cedar"]), ("ähr", vec![])] {
        let mut found = ids(store, &TreeQuery { tags: vec![tag.into()], ..TreeQuery::default() }).await;
        found.sort();
        assert_eq!(found, expected, "{tag}");
    }
    change(store, "cedar", tagged(&["Ähre"])).await;
    change(store, "cedar", tagged(&[])).await;
}

pub(super) async fn tags_and_favourites_find_trees(store: &(impl Library + Finding)) {
    for id in ["ash", "birch", "cedar"] {
        store.add_tree(tree(id, "2026")).await.unwrap();
    }
    change(store, "ash", tagged(&["tall", "old", "tall"])).await;
    change(store, "birch", tagged(&["tall"])).await;
    assert_eq!(store.tree("ash").await.unwrap().unwrap().tags, ["old", "tall"]);
    assert_eq!(store.tags().await.unwrap(), [("old".into(), 1), ("tall".into(), 2)]);
    let with = async |tags: &[&str]| {
        let tags = tags.iter().map(|&tag| tag.into()).collect();
        ids(store, &TreeQuery { tags, ..TreeQuery::default() }).await
    };
    assert_eq!((with(&["tall"]).await.len(), with(&["tall", "old"]).await), (2, vec!["ash".into()]));
    change(store, "ash", tagged(&[])).await;
    assert_eq!(store.tags().await.unwrap(), [("tall".into(), 1)]);
    tags_that_differ_in_case_are_one(store).await;

    store.set_favourite("ada-browser", "ash", true).await.unwrap();
    store.set_favourite("ada-browser", "ash", true).await.unwrap();
    store.set_favourite("bo-browser", "cedar", true).await.unwrap();
    let nowhere = store.set_favourite("bo-browser", "elm", true).await;
    assert!(matches!(nowhere, Err(StoreError::NotFound(Missing::Tree))));
    assert_eq!(store.favourites("ada-browser").await.unwrap().into_iter().collect::<Vec<_>>(), ["ash"]);
    let of = |who: &str| TreeQuery { favourites_of: Some(who.into()), ..TreeQuery::default() };
    assert_eq!(ids(store, &of("bo-browser")).await, ["cedar"]);
    store.set_favourite("ada-browser", "ash", false).await.unwrap();
    assert_eq!(ids(store, &of("ada-browser")).await, Vec::<String>::new());
    let deletion = Some(Deletion::Deleted("2026".into()));
    change(store, "cedar", TreeChange { deletion, ..TreeChange::default() }).await;
    store.purge("2027", 9).await.unwrap();
    assert!(store.favourites("bo-browser").await.unwrap().is_empty());
}

/// ST6 of the contract: searching finds what looking into every text finds.
pub(super) async fn searching_is_looking_into_every_text(store: &(impl Library + Finding)) {
    const PIECES: [&str; 16] = [
        "Eiche",
        "Äpfel",
        "ÉRABLE",
        "木の葉",
        "a\"b\"c",
        "100%",
        "_",
        "*",
        "NEAR",
        "OR",
        "oak's",
        "(x)",
        "Straße",
        "-wide",
        "fir",
        "İri",
    ];
    let piece = |number: usize| PIECES[number % PIECES.len()];
    let mut texts = Vec::new();
    for number in 0..120 {
        let (id, note) =
            (format!("tree-{number:03}"), format!("{} {}", piece(number / 3), piece(number * 7)));
        let name = format!("{} {}", piece(number), piece(number / 5 + 3));
        let tags = vec![piece(number * 5 + 1).to_owned()];
        store.add_tree(tree(&id, "2026")).await.unwrap();
        texts.push((id.clone(), searched(&name, &tags, &note, Some("oak"))));
        let said =
            TreeChange { name: Some(name), note: Some(note), tags: Some(tags), ..TreeChange::default() };
        change(store, &id, said).await;
    }
    texts.reverse();
    let pieces = PIECES.iter().map(|piece| (*piece).to_owned());
    let parts = PIECES.iter().map(|piece| piece.chars().skip(1).take(3).collect::<String>());
    let short = PIECES.iter().map(|piece| piece.chars().take(2).collect::<String>());
    let others = ["apf", "OAK", "%", "\u{0}abc", "zz", "eiche*", "tree-001"].map(str::to_owned);
    for word in pieces.chain(parts).chain(short).chain(others).filter(|word| !word.is_empty()) {
        let query = TreeQuery { words: vec![word.clone(), "k".into()], ..TreeQuery::default() };
        let looked = texts.iter().filter(|(_, text)| text.contains(&folded(&word)) && text.contains('k'));
        let looked: Vec<&String> = looked.map(|(id, _)| id).collect();
        assert_eq!(ids(store, &query).await.iter().collect::<Vec<_>>(), looked, "{word:?}");
    }
    for (word, parts) in
        [("eiche|ÖL", ["eiche", "ol"]), ("zz|k", ["zz", "k"]), ("apf|nowhere", ["apf", "nowhere"])]
    {
        let query = TreeQuery { words: vec![word.into(), "oak".into()], ..TreeQuery::default() };
        let looked = texts.iter().filter(|(_, text)| parts.iter().any(|part| text.contains(part)));
        let looked: Vec<&String> = looked.map(|(id, _)| id).collect();
        assert_eq!(ids(store, &query).await.iter().collect::<Vec<_>>(), looked, "{word:?}");
    }
}

pub(super) async fn every_order_goes_page_by_page(store: &(impl Library + Finding)) {
    for number in 0..30_u32 {
        let mut new = tree(&format!("tree-{number:02}"), &format!("2026-05-{:02}", 1 + number % 4));
        new.name = ["Öl", "olive", "Zeder", "apfel", "Birke"][number as usize % 5].into();
        if let Contents::New(saved) = &mut new.version.contents {
            saved.metamers = [9, 10, 2_000_000_000, 11][number as usize % 4];
        }
        store.add_tree(new).await.unwrap();
    }
    for sort in [Sort::Newest, Sort::Oldest, Sort::Name, Sort::Largest, Sort::Smallest] {
        let all = store.trees(&TreeQuery { sort, ..TreeQuery::default() }).await.unwrap();
        let query = TreeQuery { sort, ..page(7, None) };
        let places: Vec<_> = all.iter().map(|tree| query.place_of(tree)).collect();
        let mut sorted = places.clone();
        sorted.sort();
        if matches!(sort, Sort::Newest | Sort::Largest) {
            sorted.reverse();
        }
        assert_eq!(places, sorted, "{sort:?}");
        let mut paged = Vec::new();
        while let Some(next) = {
            let query = TreeQuery { after: paged.last().cloned(), ..query.clone() };
            let page = store.trees(&query).await.unwrap();
            paged.extend(page.iter().map(|tree| query.place_of(tree)));
            page.last().map(|_| ())
        } {
            let () = next;
        }
        assert_eq!(paged, places, "{sort:?}");
    }
}

pub(super) async fn filters_hold_at_once(store: &(impl Library + Finding)) {
    for (id, metamers, species, author, saved_at) in [
        ("ash", 10, "common-ash", "Ada", "2026-01"),
        ("birch", 20, "silver-birch", "Ada", "2026-02"),
        ("cedar", 30, "silver-birch", "Bo", "2026-03"),
    ] {
        let mut new = tree(id, saved_at);
        if let Contents::New(saved) = &mut new.version.contents {
            (saved.metamers, saved.species) = (metamers, Some(species.into()));
        }
        (new.version.author, new.version.principal) = (Some(author.into()), format!("{author}-browser"));
        store.add_tree(new).await.unwrap();
    }
    assert_eq!(store.authors().await.unwrap(), [("Ada".into(), 2), ("Bo".into(), 1)]);
    let any = TreeQuery::default;
    let birch = || Some("silver-birch".to_owned());
    for (query, expected) in [
        (TreeQuery { species: birch(), ..any() }, vec!["cedar", "birch"]),
        (TreeQuery { only: Some("birch".into()), ..any() }, vec!["birch"]),
        (TreeQuery { only: Some("nowhere".into()), ..any() }, vec![]),
        (TreeQuery { author: Some("Ada".into()), ..any() }, vec!["birch", "ash"]),
        (TreeQuery { saved_by: Some("Bo-browser".into()), ..any() }, vec!["cedar"]),
        (TreeQuery { metamers: 10..=20, ..any() }, vec!["birch", "ash"]),
        (TreeQuery { saved_from: Some("2026-02".into()), ..any() }, vec!["cedar", "birch"]),
        (TreeQuery { saved_before: Some("2026-02".into()), ..any() }, vec!["ash"]),
        (
            TreeQuery { species: birch(), author: Some("Ada".into()), words: vec!["birch".into()], ..any() },
            vec!["birch"],
        ),
        (TreeQuery { species: birch(), metamers: 0..=10, ..any() }, vec![]),
    ] {
        assert_eq!(ids(store, &query).await, expected, "{query:?}");
    }
}
