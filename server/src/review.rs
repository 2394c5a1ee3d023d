//! What people have said of a tree, as one file to read, send and print (`CT6`): no script, pictures inside, everything
//! that somebody wrote escaped.

use std::{collections::BTreeMap, fmt::Write as _};

use base64::{Engine, engine::general_purpose::STANDARD};
use espalier_proto::comment::{Pin, PinState};
use espalier_session::{Document, Search};

use crate::{
    http::SaidComment,
    live::StoredPin,
    store::{Comments, Library, Picture, StoreError, StoredThread, StoredTree},
    time::readable,
};

/// Bytes of pictures in one file; the threads that follow are without theirs.
pub const MOST_PICTURES: usize = 40 * 1024 * 1024;
/// Threads read at once.
const PAGE: u32 = 100;

/// What a browser may do with the file: show it.
pub const CONTENT_SECURITY_POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The language of a summary.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, schemars::JsonSchema, clap::ValueEnum,
)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub enum Language {
    /// English.
    #[default]
    En,
    /// German.
    De,
}

/// A word in English and German.
type Word = [&'static str; 2];

const REVIEW: Word = ["Comments on", "Kommentare zu"];
const MADE: Word = ["As of", "Stand"];
const OPEN: Word = ["open", "offen"];
const DONE: Word = ["resolved by", "erledigt von"];
const WHOLE: Word = ["On the tree as a whole", "Zum ganzen Baum"];
const NONE: Word =
    ["Nobody has said anything of this tree yet.", "Noch hat niemand etwas zu diesem Baum gesagt."];
const STEP: Word = ["Step", "Schritt"];
const LEFT_OUT: Word =
    ["The picture found no room in this file.", "Das Bild fand in dieser Datei keinen Platz."];
const CHANGED: Word = ["changed", "geändert"];
const FOR: Word = ["For", "Für"];
const PICTURE: Word = ["What was seen", "Was zu sehen war"];
const STATES: [(PinState, Word); 5] = [
    (PinState::Standing, ["On the branch", "Am Ast"]),
    (PinState::NotYet, ["Grows later", "Wächst später"]),
    (PinState::Detached, ["Its branch is gone", "Der Ast ist weg"]),
    (PinState::Regrown, ["Its branch has grown again", "Der Ast ist nachgewachsen"]),
    (PinState::Elsewhere, ["On another line of time", "In einer anderen Zukunft"]),
];

impl Language {
    fn of(self, [english, german]: Word) -> &'static str {
        match self {
            Self::En => english,
            Self::De => german,
        }
    }

    fn code(self) -> &'static str {
        match self {
            Self::En => "en",
            Self::De => "de",
        }
    }
}

/// Where the pins of a tree are in a document.
pub fn states(document: &Document, threads: &[(u32, String)]) -> BTreeMap<u32, Pin> {
    let pins = threads.iter().filter_map(|(thread, json)| {
        let StoredPin { at, anchor } = StoredPin::from_json(*thread, json).ok()?;
        Some((*thread, anchor, at.place.get()))
    });
    let pins: Vec<_> = pins.collect();
    let all =
        document.whereabouts(pins.iter().map(|(_, anchor, place)| (anchor, *place)), Search::Everywhere);
    let found = pins.iter().zip(all).map(|(&(thread, ..), found)| {
        let (state, row, step, line) = (found.state, found.row, found.step, found.line);
        (thread, Pin { thread, state, row, step, line })
    });
    found.collect()
}

/// The summary of a tree's comments at a time, the oldest first.
pub async fn summary(
    store: &(impl Comments + Library),
    tree: &StoredTree,
    states: &BTreeMap<u32, Pin>,
    at: &str,
    language: Language,
) -> Result<String, StoreError> {
    let mut threads = Vec::new();
    loop {
        let before = threads.last().map(|thread: &StoredThread| thread.number);
        let page = store.threads(&tree.id, PAGE, before).await?;
        let is_last = page.len() < PAGE as usize;
        threads.extend(page);
        if is_last {
            break;
        }
    }
    threads.reverse();
    let mut out = Page::new(&tree.name, at, language);
    if let Some(picture) = store.thumbnail(&tree.id, tree.head.number).await? {
        out.picture(&picture, "tree");
    }
    if threads.is_empty() {
        out.paragraph(language.of(NONE));
    }
    let mut held = 0;
    for thread in &threads {
        let StoredThread { number, pin, resolved, comments } = thread;
        let state = states.get(number).and_then(|pin| STATES.iter().find(|(state, _)| *state == pin.state));
        let place = match (pin, state) {
            (None, _) => language.of(WHOLE),
            (Some(_), Some((_, word))) => language.of(*word),
            (Some(_), None) => "",
        };
        let standing = match resolved {
            Some((by, at)) => format!("{} {by}, {}", language.of(DONE), readable(at)),
            None => language.of(OPEN).to_owned(),
        };
        out.begin_thread(*number, place, &standing, resolved.is_some());
        for comment in comments {
            let said = SaidComment::from_json(&comment.said)?;
            let changed = comment.edited_at.as_ref().map(|_| language.of(CHANGED));
            let mut when = readable(&comment.written_at);
            if let Some(bookmark) = &said.bookmark {
                let _ = write!(when, " · {} {}", language.of(STEP), bookmark.step);
            }
            if let Some(changed) = changed {
                let _ = write!(when, " · {changed}");
            }
            out.begin_comment(&comment.author, &when);
            if comment.has_picture
                && let Some(picture) = store.comment_picture(&tree.id, *number, comment.number).await?
            {
                if held + picture.bytes.len() <= MOST_PICTURES {
                    held += picture.bytes.len();
                    out.picture(&picture, "view");
                } else {
                    out.paragraph(language.of(LEFT_OUT));
                }
            }
            let names: Vec<&str> = said.mentions.iter().map(|one| one.name()).collect();
            if !names.is_empty() {
                out.note(&format!("{} {}", language.of(FOR), names.join(", ")));
            }
            out.text(&said.text);
            out.end_comment();
        }
        out.end_thread();
    }
    Ok(out.finish())
}

const STYLE: &str = "\
:root { color-scheme: light; }
body { font: 11pt/1.45 system-ui, sans-serif; color: #222; background: #fff; max-width: 46rem; margin: 2rem auto; padding: 0 1rem; overflow-wrap: anywhere; }
h1 { font-size: 1.6em; margin: 0; }
h2 { font-size: 1.05em; margin: 0 0 .4em; }
.when, .place { color: #666; font-size: .85em; margin: 0; }
section { border-top: 1px solid #ccc; padding: 1em 0; }
h2, .place { break-after: avoid; }
section.done { color: #777; }
article { margin: .6em 0 .6em 0; break-inside: avoid; }
article p.said { white-space: pre-wrap; margin: .2em 0; }
img { max-width: 100%; border-radius: 6px; display: block; margin: .4em 0; }
img.tree { max-height: 9cm; }
img.view { max-height: 8cm; }
@page { size: A4; margin: 16mm; }
@media print { body { margin: 0; max-width: none; } }
";

/// The file as it is written.
struct Page {
    html: String,
    language: Language,
}

impl Page {
    fn new(name: &str, at: &str, language: Language) -> Self {
        let title = format!("{} {}", language.of(REVIEW), name);
        let mut html = String::new();
        // Writing to a string cannot fail.
        let _ = write!(
            html,
            "<!doctype html>\n<html lang=\"{}\">\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n\
             <title>{}</title>\n<style>\n{STYLE}</style>\n<h1>{}</h1>\n<p class=\"when\">{} {}</p>\n",
            language.code(),
            escaped(&title),
            escaped(&title),
            language.of(MADE),
            escaped(&readable(at)),
        );
        Self { html, language }
    }

    fn put(&mut self, text: &str) {
        self.html.push_str(text);
    }

    fn paragraph(&mut self, text: &str) {
        let _ = writeln!(self.html, "<p>{}</p>", escaped(text));
    }

    fn note(&mut self, text: &str) {
        let _ = writeln!(self.html, "<p class=\"place\">{}</p>", escaped(text));
    }

    fn text(&mut self, text: &str) {
        let _ = writeln!(self.html, "<p class=\"said\">{}</p>", escaped(text));
    }

    fn picture(&mut self, picture: &Picture, class: &str) {
        let (media_type, bytes) = (escaped(&picture.media_type), STANDARD.encode(&picture.bytes));
        let alt = self.language.of(PICTURE);
        let _ = writeln!(
            self.html,
            "<img class=\"{class}\" alt=\"{alt}\" src=\"data:{media_type};base64,{bytes}\">"
        );
    }

    fn begin_thread(&mut self, number: u32, place: &str, standing: &str, is_done: bool) {
        let class = if is_done { "done" } else { "open" };
        let (place, standing) = (escaped(place), escaped(standing));
        let _ = writeln!(
            self.html,
            "<section class=\"{class}\">\n<h2>{number} · {standing}</h2>\n<p class=\"place\">{place}</p>"
        );
    }

    fn begin_comment(&mut self, author: &str, when: &str) {
        let (author, when) = (escaped(author), escaped(when));
        let _ = writeln!(self.html, "<article><strong>{author}</strong> <span class=\"when\">{when}</span>");
    }

    fn end_comment(&mut self) {
        self.put("</article>\n");
    }

    fn end_thread(&mut self) {
        self.put("</section>\n");
    }

    fn finish(mut self) -> String {
        self.put("</html>\n");
        self.html
    }
}

/// Text that a browser shows as it stands.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::{MemoryStore, NewComment, tree};

    const EVIL: &str = "<script>alert(1)</script>\"'><img src=x onerror=alert(1)>&";

    /// Everything that somebody can write is there as text, and nothing of it as markup.
    #[tokio::test]
    async fn ct6_a_summary_escapes_every_field() {
        let store = MemoryStore::default();
        let mut evil = tree("ash", "2026-05-01T12:00:00.000Z");
        evil.name = EVIL.into();
        store.add_tree(evil).await.unwrap();
        let said = serde_json::json!({ "text": EVIL, "mentions": [EVIL] }).to_string();
        let comment = NewComment {
            person: "p".into(),
            author: EVIL.into(),
            written_at: EVIL.into(),
            said,
            picture: Some(Picture { media_type: EVIL.into(), bytes: vec![1, 2, 3] }),
        };
        store.add_thread("ash", Some("{}".into()), comment).await.unwrap();
        store.resolve_thread("ash", 1, Some((EVIL.into(), EVIL.into()))).await.unwrap();
        let stored = store.tree("ash").await.unwrap().unwrap();
        for language in [Language::En, Language::De] {
            let html = summary(&store, &stored, &BTreeMap::new(), EVIL, language).await.unwrap();
            for bad in ["<script", "onerror=alert(1)>&\"", "<img src=x", "'>"] {
                assert!(!html.contains(bad), "{bad}: {html}");
            }
            // Title, head, time, author, when, mention, text, by whom and when it was resolved.
            assert!(html.matches(&escaped(EVIL)).count() >= 8, "{html}");
            assert!(html.contains(";base64,AQID\""), "the picture lies in the file");
            for outside in ["://", "url(", "@import", "srcset", "<link", "<iframe"] {
                assert!(!html.contains(outside), "{outside}");
            }
        }
    }

    #[tokio::test]
    async fn ct6_a_summary_of_nothing_says_so_and_threads_come_in_order() {
        let store = MemoryStore::default();
        store.add_tree(tree("ash", "2026")).await.unwrap();
        let stored = store.tree("ash").await.unwrap().unwrap();
        let empty = summary(&store, &stored, &BTreeMap::new(), "now", Language::En).await.unwrap();
        assert!(empty.contains(NONE[0]));
        for n in 0..250 {
            let said = serde_json::json!({ "text": format!("word {n}.") }).to_string();
            let (person, author, written_at) = ("p".into(), "Ann".into(), "2026".into());
            let comment = NewComment { person, author, written_at, said, picture: None };
            store.add_thread("ash", None, comment).await.unwrap();
        }
        let html = summary(&store, &stored, &BTreeMap::new(), "now", Language::De).await.unwrap();
        let places: Vec<_> =
            (0..250).map(|n| html.find(&format!("word {n}.")).expect("it is there")).collect();
        assert!(places.is_sorted());
        assert!(html.contains(WHOLE[1]));
    }
}
