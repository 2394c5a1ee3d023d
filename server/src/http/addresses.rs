//! The addresses of the API: what is asked for at each, how it is answered, and what its description says.

use std::{borrow::Cow, collections::BTreeMap, time::Duration};

use axum::routing::{MethodRouter, delete, get, patch, post, put};
use espalier_proto::{
    CheckGrammar, GrammarOrigins, GrammarReport, ShippedGrammar,
    access::{
        Admitted, AuditEvent, ChangeGroup, ChangeLink, ChangePassword, ChangeUser, Entrance, GuestHere,
        HandOver, KeptOut, ListedGroup, ListedToken, ListedUser, LogIn, MadeLink, MadeToken, Me, NewGroup,
        NewLink, NewMember, NewToken, NewUser, Redeem, RemovedPerson, TreeLink, TreeLock, TreeMember,
        TreeOwner,
    },
    comment::{ChangeComment, ChangeThread, NewComment, NewThread, Seen, Thread},
    design::{DesignInForce, MAX_DESIGN_BYTES, PutDesign},
    library::{
        ChangeCollection, ChangeTree, ChangeVersion, CopyTree, ExportFormat, ExportProgress, NewCollection,
        NewSession, RestoreVersion, SaveTree, SaveVersion, SavedTree, SessionCreated, SessionPage,
        TreeAuthor, TreeCollection, TreePage, TreeTag, TreeVersion,
    },
    obstacle::UploadedObstacle,
    schematic::Schematic,
    species::Species,
    status::ServerStatus,
    thumbnail::MAX_THUMBNAIL_BYTES,
    version::{KEPT_DAYS, MAX_MODEL_BYTES, MAX_WOOD_BYTES},
};
use espalier_settings::ParameterValues;
use tower::limit::GlobalConcurrencyLimitLayer;

use super::{
    Shared, audit, collections, comments, description, description::About, designs, entry, exports,
    failure::Path, grammars, groups, guard::TIME_LIMIT, guests, imports, jobs, keys::Shown, links, locks,
    members, obstacles, origin::METRICS, owners, removals, reviews, schematic, session_list, sessions,
    species, status, tokens, trees, uploads::uploads, users, versions,
};
use crate::{
    access::Action,
    export_options::ExportOptions,
    formats::{FORMATS, FormatRow},
    store::EXPORT,
};

/// A request for a session is tiny.
const MAX_SMALL_BODY: usize = 4 * 1024;
/// A note of 2000 characters, with room for the rest of the request.
const MAX_SAID_BODY: usize = 32 * 1024;
/// A thumbnail as base64, with room for the rest of the request.
const MAX_TREE_BODY: usize = MAX_THUMBNAIL_BYTES.div_ceil(3) * 4 + 8 * 1024;
/// A comment with a picture and a sketch, with room for the rest of the request.
const MAX_COMMENT_BODY: usize = MAX_TREE_BODY + 32 * 1024;
/// Summaries made at once: each may hold 40 MB of pictures.
const MAX_REVIEWS: usize = 1;
/// Obstacles read at once: each holds millions of triangles.
const MAX_UPLOADS: usize = 1;
/// How long a request may take that brings an obstacle or a tree: so that it may be large, and the network slow.
const UPLOAD_TIME: Duration = Duration::from_mins(10);
/// Files read at once that become trees: a section of a document may unpack to 2 GB.
const MAX_IMPORTS: usize = 1;
/// Pictures of species made at once: sessions grow on the same threads.
const MAX_PICTURES: usize = 1;
/// How long a request for a turntable may take: those of the largest trees that a server keeps are drawn on a busy machine.
const TURNTABLE_TIME: Duration = Duration::from_mins(5);
/// Texts checked at once; each may take a tenth of a second where its sizes are wanted.
const MAX_CHECKS: usize = 2;
/// Sessions looked through at once for what a grammar wrote.
const MAX_ORIGINS: usize = 1;
/// The longest text of a grammar as JSON, with room for the rest of the request.
const MAX_GRAMMAR_BODY: usize = 2 * espalier_grammar::MAX_TEXT + 16 * 1024;
/// The largest graph of a design, with room for the rest of the request.
const MAX_DESIGN_BODY: usize = MAX_DESIGN_BYTES + 4 * 1024;
/// Schematics grown at once; each takes some milliseconds.
const MAX_SCHEMATICS: usize = 4;

/// An address of the API.
pub(super) struct Route {
    /// Method and path, in which `{session}` and `{tree}` name what is asked for.
    pub address: Cow<'static, str>,
    /// What is asked for; nothing where whoever is not let in yet may come.
    pub action: Option<Action>,
    pub answer: MethodRouter<Shared>,
    /// How the list of what was done calls it, if it is noted there.
    pub noted: Option<&'static str>,
    /// Bytes that the body of a request may have.
    pub most_bytes: usize,
    /// How long a request may take; `None` where it takes as long as it takes.
    pub time_limit: Option<Duration>,
    /// What becomes of the answer to a request with a key.
    pub shown: Shown,
    pub about: About,
}

impl Route {
    /// It is noted on the list of what was done.
    fn noted(mut self, noted: &'static str) -> Self {
        self.noted = Some(noted);
        self
    }

    /// The body of a request may have so many bytes.
    fn up_to(mut self, most_bytes: usize) -> Self {
        self.most_bytes = most_bytes;
        self
    }

    /// A request may take so long.
    fn within(mut self, time_limit: Duration) -> Self {
        self.time_limit = Some(time_limit);
        self
    }

    /// Its answer has a secret, and is given once.
    fn once(mut self) -> Self {
        self.shown = Shown::Once;
        self
    }

    /// Whether a request may have a key (`IK1`): something is made there, by somebody who was let in.
    pub(super) fn takes_keys(&self) -> bool {
        self.address.starts_with("POST ") && self.action.is_some_and(|action| action != Action::Look)
    }
}

fn route(
    address: impl Into<Cow<'static, str>>,
    action: impl Into<Option<Action>>,
    answer: MethodRouter<Shared>,
    about: About,
) -> Route {
    Route {
        address: address.into(),
        action: action.into(),
        answer,
        noted: None,
        most_bytes: MAX_SMALL_BODY,
        time_limit: Some(TIME_LIMIT),
        shown: Shown::Again,
        about,
    }
}

/// The path of an address.
pub(super) fn path_of(address: &str) -> &str {
    address.split_once(' ').map_or(address, |(_, path)| path)
}

/// The methods that an address which is read takes.
const READ: &str = "GET, HEAD";

/// The methods of each path in the list, as `Allow` has them; all other paths of the server are read.
pub(super) fn methods() -> impl Fn(&str) -> String + Clone {
    let mut all: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for Route { address, .. } in routes().into_iter().chain(downloads()) {
        let method = address.split(' ').next().map(|method| if method == "GET" { READ } else { method });
        all.entry(path_of(&address).into()).or_default().extend(method.map(str::to_owned));
    }
    move |path| all.get(path).map_or_else(|| READ.to_owned(), |methods| methods.join(", "))
}

/// A socket: its address, who may open it, and what the description says of it. A page is told by its close why it may
/// not come in.
pub(super) struct SocketRoute {
    pub(super) address: &'static str,
    pub(super) about: About,
    pub(super) answer: MethodRouter<Shared>,
}

/// What may be done who opens a socket.
pub(super) const OF_SOCKETS: Action = Action::JoinSession;

/// All sockets.
pub(super) fn sockets() -> [SocketRoute; 2] {
    [
        SocketRoute {
            address: "GET /api/v1/sessions/{session}/socket",
            about: About::new("The WebSocket: messages as in `protocol.schema.json`, and frames (FR).")
                .switches(),
            answer: get(sessions::socket),
        },
        SocketRoute {
            address: "GET /api/v1/sessions/{session}/replay",
            about: About::new("The same for a copy in which one goes through the design step by step (RP1).")
                .switches(),
            answer: get(sessions::replay),
        },
    ]
}

/// Files of any format, each of which takes as long as it takes.
pub(super) fn downloads() -> Vec<Route> {
    let download = |row: &'static FormatRow, path: &str, action, what: &str, answer: MethodRouter<Shared>| {
        let about = About::new(format!("{what}: {}.", row.what))
            .asks::<ExportOptions>()
            .among(row.options)
            .gives_parts(row.media_type);
        let address = format!("GET {path}/tree.{}", row.ending);
        // Whoever no longer waits closes the connection, and that ends the work.
        let time_limit = None;
        let take = route(address, action, answer, about).noted(EXPORT);
        Route { time_limit, ..take }
    };
    let of_session = |row| {
        let answer = get(move |state, path: Path<String>, caller, query, asked| {
            exports::take(state, path, caller, (query, asked), row)
        });
        download(row, "/api/v1/sessions/{session}", Action::TakeTree, "Download", answer)
    };
    let of_version = |row| {
        let answer = get(move |state, path: Path<(String, u32)>, caller, query, asked| {
            exports::take_version(state, path, caller, (query, asked), row)
        });
        let path = "/api/v1/trees/{tree}/versions/{version}";
        download(row, path, Action::OpenTree, "Download of a version", answer)
    };
    FORMATS.iter().map(of_session).chain(FORMATS.iter().map(of_version)).collect()
}

/// The rest of the API, but for the socket.
pub(super) fn routes() -> Vec<Route> {
    let at_once = GlobalConcurrencyLimitLayer::new;
    let files = uploads(MAX_IMPORTS);
    vec![
        route("POST /api/v1/redeem", None, post(entry::redeem), About::new("Come in by an invitation (AC3); the answer sets a cookie.").takes::<Redeem>().gives::<Admitted>(200)),
        route("GET /api/v1/entry", None, get(entry::entrance), About::new("What one can come in by.").gives::<Entrance>(200)),
        route("POST /api/v1/login", None, post(entry::log_in), About::new("Come in with a password (AC9); the answer sets a cookie.").takes::<LogIn>().gives::<Admitted>(200)),
        route("POST /api/v1/logout", None, post(entry::log_out), About::new("Be let in no longer by the cookie of the request, which goes.").gives_nothing()),
        route("GET /api/v1/me", Action::Look, get(entry::me), About::new("Who asks, and what they may do (AC8).").gives::<Me>(200)),
        route("PUT /api/v1/me/password", Action::OwnPassword, put(users::change_own_password), About::new("Log in with another password from now on; one's other logins end (AC19).").takes::<ChangePassword>().gives_nothing()).noted("password"),
        route("GET /api/v1/users", Action::SeePeople, get(users::list), About::new("Who can log in, by name (AC19).").gives::<Vec<ListedUser>>(200)),
        route("POST /api/v1/users", Action::ChangePeople, post(users::add), About::new("Let somebody log in (AC19).").takes::<NewUser>().gives::<ListedUser>(201)).noted("user-add"),
        route("GET /api/v1/users/{user}", Action::SeePeople, get(users::find), About::new("Somebody who can log in, with an `ETag`.").gives::<ListedUser>(200)),
        route("PATCH /api/v1/users/{user}", Action::ChangePeople, patch(users::change), About::new("Change somebody's name, role or password (AC19); the last administrator stays one.").takes::<ChangeUser>().gives::<ListedUser>(200).revised()).noted("user-change"),
        route("DELETE /api/v1/users/{user}", Action::ChangePeople, delete(users::remove), About::new("Let somebody log in no longer (AC19); the last administrator stays.").gives_nothing().revised()).noted("user-remove"),
        route("GET /api/v1/groups", Action::SeePeople, get(groups::list), About::new("Groups of users, by name (AC20).").gives::<Vec<ListedGroup>>(200)),
        route("POST /api/v1/groups", Action::ChangePeople, post(groups::add), About::new("Make a group (AC20).").takes::<NewGroup>().gives::<ListedGroup>(201)).noted("group-add"),
        route("GET /api/v1/groups/{group}", Action::SeePeople, get(groups::find), About::new("One group, with an `ETag`.").gives::<ListedGroup>(200)),
        route("PATCH /api/v1/groups/{group}", Action::ChangePeople, patch(groups::change), About::new("Change the name or the role of a group (AC20).").takes::<ChangeGroup>().gives::<ListedGroup>(200).revised()).noted("group-change"),
        route("DELETE /api/v1/groups/{group}", Action::ChangePeople, delete(groups::remove), About::new("Remove a group; its members stay users.").gives_nothing().revised()).noted("group-remove"),
        route("PUT /api/v1/groups/{group}/members/{user}", Action::ChangePeople, put(groups::join), About::new("Make a user a member (AC20).").gives::<ListedGroup>(200).revised()).noted("group-join"),
        route("DELETE /api/v1/groups/{group}/members/{user}", Action::ChangePeople, delete(groups::leave), About::new("Make a user a member no longer.").gives::<ListedGroup>(200).revised()).noted("group-leave"),
        route("GET /api/v1/tokens", Action::OwnTokens, get(tokens::list), About::new("Programs that act as whoever asks, newest first (AC21).").gives::<Vec<ListedToken>>(200)),
        route("POST /api/v1/tokens", Action::MakeToken, post(tokens::add), About::new("Let a program act as oneself; its token is shown this once (AC21).").takes::<NewToken>().gives::<MadeToken>(201)).noted("token").once(),
        route("GET /api/v1/tokens/all", Action::SeePeople, get(tokens::list_all), About::new("Programs of everybody, newest first (AC21).").gives::<Vec<ListedToken>>(200)),
        route("DELETE /api/v1/tokens/{token}", Action::OwnTokens, delete(tokens::revoke), About::new("Let a program in no longer (AC21); administrators revoke any.").gives_nothing()).noted("token-revoke"),
        route("GET /api/v1/status", Action::SeeServer, get(status::status), About::new("How the server is: memory by what it is taken for, sessions with theirs (SV2).").gives::<ServerStatus>(200)),
        route(format!("GET {METRICS}"), Action::SeeFigures, get(status::metrics), About::new("Figures of the server as Prometheus reads them (SV2).").gives_file("text/plain")),
        route("GET /api/v1/audit", Action::SeePeople, get(audit::list), About::new("What was done and by whom, newest first (AC10).").asks::<audit::Page>().gives::<Vec<AuditEvent>>(200)),
        route("GET /api/v1/openapi.json", Action::Look, get(description::show), About::new("The description of this API (OpenAPI 3.1).").gives_file("application/json")),
        route("GET /api/v1/formats", Action::Look, get(exports::formats), About::new("What a tree can be downloaded as (EX1).").gives::<Vec<ExportFormat>>(200)),
        route("GET /api/v1/sessions/{session}/exports/{ticket}", Action::TakeTree, get(exports::progress), About::new("How far a file is that is being made (EX3).").gives::<ExportProgress>(200)),
        route("POST /api/v1/sessions", Action::EnterSession, post(sessions::create), About::new("Begin a session, or come into the one of a tree: 200 where it is there already (LB3).").takes::<NewSession>().gives::<SessionCreated>(201).gives::<SessionCreated>(200)),
        route("GET /api/v1/sessions", Action::ListSessions, get(session_list::list), About::new("Sessions that one may see, those first in which something was done last, page by page (LB11).").asks::<session_list::Page>().gives::<SessionPage>(200)),
        route("DELETE /api/v1/sessions/{session}", Action::ForgetSession, delete(session_list::forget), About::new("Take a session off one's list; whoever knows its name comes into it still (LB11).").gives_nothing()),
        route("GET /api/v1/sessions/{session}", Action::SeeSession, get(sessions::find), About::new("Whether there is such a session.").gives::<SessionCreated>(200)),
        route("POST /api/v1/sessions/{session}/resume", Action::ResumeSession, post(sessions::resume), About::new("Let go on what rests because the server did not outlive it twice (OP5).").gives_nothing()),
        route("POST /api/v1/sessions/{session}/obstacles", Action::EditSession, post(obstacles::upload).layer(uploads(MAX_UPLOADS)), About::new("Place a glTF or OBJ model as an obstacle (OB6).").takes_file("model/gltf-binary").gives::<UploadedObstacle>(201)).up_to(MAX_MODEL_BYTES).within(UPLOAD_TIME),
        route("GET /api/v1/sessions/{session}/obstacles/{obstacle}", Action::SeeObstacle, get(obstacles::mesh), About::new("The mesh of an obstacle (OB5).").gives_parts("application/octet-stream")),
        route("DELETE /api/v1/sessions/{session}/people/{person}", Action::ShareTree, delete(removals::remove), About::new("Remove somebody from the session and its tree (AC17); the number is that of `people`.").gives::<RemovedPerson>(200)).noted("remove"),
        route("GET /api/v1/sessions/{session}/guests", Action::ShareTree, get(guests::list), About::new("Who of those in the session came by a link of its tree, and by which (AC12); the numbers are those of `people`.").gives::<Vec<GuestHere>>(200)),
        route("GET /api/v1/sessions/{session}/removals", Action::ShareTree, get(removals::list), About::new("Who is kept out of the session and its tree, and can be let back (AC17).").gives::<Vec<KeptOut>>(200)),
        route("DELETE /api/v1/sessions/{session}/removals/{removal}", Action::ShareTree, delete(removals::let_back), About::new("Let somebody back before their time.").gives_nothing()).noted("let-back"),
        route("GET /api/v1/sessions/{session}/owner", Action::SeeSession, get(owners::find), About::new("To whom the tree of the session was handed over (AC18).").gives::<TreeOwner>(200)),
        route("PUT /api/v1/sessions/{session}/owner", Action::ShareTree, put(owners::hand_over), About::new("Hand the tree over to somebody who is in the session (AC18).").takes::<HandOver>().gives::<TreeOwner>(200)).noted("hand-over"),
        route("DELETE /api/v1/sessions/{session}/owner", Action::ShareTree, delete(owners::take_back), About::new("The tree is handed over to nobody any more.").gives::<TreeOwner>(200)).noted("hand-over"),
        route("GET /api/v1/species", Action::Look, get(species::list), About::new("All species, in the order of a picker. Picking one is a `set_programme` with its `programme` and a `set_appearance` with the sections of its `appearance` but the background and the wind, both with one gesture.").gives::<Vec<Species>>(200)),
        route("GET /api/v1/species/{slug}/picture", Action::Look, get(species::picture).layer(at_once(MAX_PICTURES)), About::new("A tree of that species, with an `ETag`.").gives_parts("image/png")),
        route("GET /api/v1/grammars", Action::Look, get(grammars::list), About::new("Grammars that come with the program, in the order of a picker (GR7).").gives::<Vec<ShippedGrammar>>(200)),
        route("GET /api/v1/grammars/{name}/picture", Action::Look, get(grammars::picture).layer(at_once(MAX_PICTURES)), About::new("What that grammar writes, with an `ETag`.").gives_parts("image/png")),
        route("POST /api/v1/grammars/check", Action::Look, post(grammars::check).layer(at_once(MAX_CHECKS)), About::new("What is wrong with the text of a grammar, its sliders and its sizes (GR6).").takes::<CheckGrammar>().gives::<GrammarReport>(200)).up_to(MAX_GRAMMAR_BODY),
        route("GET /api/v1/sessions/{session}/design", Action::SeeSession, get(designs::find), About::new("The design in force (DS11).").gives::<DesignInForce>(200)),
        route("PUT /api/v1/sessions/{session}/design", Action::EditSession, put(designs::put), About::new("Plant the wood of a design, or let it take the place of the one in force (DS11).").takes::<PutDesign>().gives_nothing()).up_to(MAX_DESIGN_BODY),
        route("GET /api/v1/sessions/{session}/grammar", Action::SeeSession, get(grammars::origins).layer(at_once(MAX_ORIGINS)), About::new("Which rule of the grammar in force made which row (GR8).").gives::<GrammarOrigins>(200)),
        route("POST /api/v1/grow", Action::GrowTrees, post(jobs::grow), About::new("Grow a tree for each of many seeds into files, as a job (JB1).").takes::<jobs::GrowTrees>().gives::<jobs::JobNow>(202)).up_to(MAX_SAID_BODY),
        route("GET /api/v1/jobs", Action::OwnJobs, get(jobs::list), About::new("One's own jobs, newest first, page by page (JB8).").asks::<jobs::Page>().gives::<jobs::JobPage>(200)),
        route("GET /api/v1/jobs/{job}", Action::OwnJobs, get(jobs::find), About::new("How far a job is, and its files so far (JB2).").gives::<jobs::JobNow>(200)),
        route("DELETE /api/v1/jobs/{job}", Action::OwnJobs, delete(jobs::give_up), About::new("Give a job up; its files go (JB4).").gives_nothing()),
        route("GET /api/v1/jobs/{job}/results.zip", Action::OwnJobs, get(jobs::archive), About::new("All files of a job so far in one (JB9).").gives_parts("application/zip")),
        route("GET /api/v1/jobs/{job}/results/{seed}", Action::OwnJobs, get(jobs::result), About::new("A file of a job (JB3).").gives_parts("application/octet-stream")),
        route("POST /api/v1/schematic", Action::Look, post(schematic::draw).layer(at_once(MAX_SCHEMATICS)), About::new("A small tree that shows what parameters do (SC1).").takes::<ParameterValues>().gives::<Schematic>(200)),
        route("GET /api/v1/trees", Action::ListTrees, get(trees::list), About::new("Trees of the library, page by page (LB7).").asks::<trees::Page>().gives::<TreePage>(200)),
        route("POST /api/v1/trees", Action::SaveTree, post(trees::save), About::new("Save a session as a new tree.").takes::<SaveTree>().gives::<SavedTree>(201)).up_to(MAX_TREE_BODY),
        route("POST /api/v1/trees/import", Action::SaveTree, post(imports::upload).layer(files.clone()), About::new("Make a tree of a file (IM1).").asks::<imports::Upload>().takes_file("application/octet-stream").gives::<SavedTree>(201)).up_to(MAX_WOOD_BYTES).within(UPLOAD_TIME),
        route("GET /api/v1/trees/{tree}", Action::SeeTree, get(trees::find), About::new("One tree; one that was deleted as well, with its `deleted_at`.").gives::<SavedTree>(200)),
        route("PATCH /api/v1/trees/{tree}", Action::ChangeTree, patch(trees::change), About::new("Change what is said of a tree.").takes::<ChangeTree>().gives::<SavedTree>(200).revised()).up_to(MAX_SAID_BODY),
        route("DELETE /api/v1/trees/{tree}", Action::DeleteTree, delete(trees::delete), About::new(format!("Delete a tree; it can be taken back for {KEPT_DAYS} days (LB6).")).gives_nothing().revised()).noted("delete"),
        route("DELETE /api/v1/trees/{tree}/for-good", Action::DeleteTree, delete(trees::delete_for_good), About::new("Delete a tree that was deleted, with all of its versions, so that it cannot be taken back (LB6).").gives_nothing().revised()).noted("delete-for-good"),
        route("POST /api/v1/trees/{tree}/undelete", Action::DeleteTree, post(trees::undelete), About::new("Take a deleted tree back.").gives::<SavedTree>(200).revised()).noted("undelete"),
        route("POST /api/v1/trees/{tree}/copies", Action::OpenTree, post(trees::copy), About::new("Duplicate a tree, or branch from a version; the answer is the new tree.").takes::<CopyTree>().gives::<SavedTree>(201)).up_to(MAX_SAID_BODY),
        route("GET /api/v1/trees/{tree}/links", Action::ShareTree, get(links::list), About::new("Who was invited to this tree alone, newest first (AC12).").gives::<Vec<TreeLink>>(200)),
        route("POST /api/v1/trees/{tree}/links", Action::ShareTree, post(links::add), About::new("Make a link that lets one device in for this tree; it is shown this once.").takes::<NewLink>().gives::<MadeLink>(201)).noted("link").once(),
        route("PATCH /api/v1/trees/{tree}/links/{link}", Action::ShareTree, patch(links::change), About::new("Let whoever was invited do more or less; it holds at once, also where they are connected (AU3).").takes::<ChangeLink>().gives::<TreeLink>(200)).noted("link-role"),
        route("DELETE /api/v1/trees/{tree}/links/{link}", Action::ShareTree, delete(links::revoke), About::new("Revoke a link; who came by it is let in no longer.").gives_nothing()).noted("unlink"),
        route("GET /api/v1/trees/{tree}/members", Action::ShareTree, get(members::of_tree), About::new("To whom a tree was given (AC22).").gives::<Vec<TreeMember>>(200)),
        route("POST /api/v1/trees/{tree}/members", Action::ShareTree, post(members::add_to_tree), About::new("Give a tree to a user or a group, or with another role (AC22).").takes::<NewMember>().gives::<TreeMember>(201)).noted("give"),
        route("DELETE /api/v1/trees/{tree}/members/{member}", Action::ShareTree, delete(members::remove_from_tree), About::new("Take a tree back from a user or a group (AC22).").gives_nothing()).noted("take-back"),
        route("GET /api/v1/trees/{tree}/lock", Action::SeeTree, get(locks::find), About::new("Whether owners alone change a tree (AC16).").gives::<TreeLock>(200)),
        route("PUT /api/v1/trees/{tree}/lock", Action::ShareTree, put(locks::lock), About::new("Owners alone change the tree from now on, also where others are connected (AC16).").gives::<TreeLock>(200)).noted("lock"),
        route("DELETE /api/v1/trees/{tree}/lock", Action::ShareTree, delete(locks::unlock), About::new("Who may draw may draw again (AC16).").gives::<TreeLock>(200)).noted("unlock"),
        route("GET /api/v1/trees/{tree}/threads", Action::ReadComments, get(comments::list), About::new("What people say of a tree, newest thread first, page by page (CT1).").asks::<comments::Page>().gives::<Vec<Thread>>(200)),
        route("POST /api/v1/trees/{tree}/threads", Action::Comment, post(comments::begin), About::new("Begin a thread, pinned to a place or about the tree as a whole (CT1).").takes::<NewThread>().gives::<Thread>(201)).up_to(MAX_COMMENT_BODY),
        route("GET /api/v1/trees/{tree}/threads/{thread}", Action::ReadComments, get(comments::find), About::new("One thread.").gives::<Thread>(200)),
        route("PATCH /api/v1/trees/{tree}/threads/{thread}", Action::Comment, patch(comments::change), About::new("What it is about is done, or not any more (CT4).").takes::<ChangeThread>().gives::<Thread>(200)),
        route("PUT /api/v1/trees/{tree}/threads/{thread}/seen", Action::ReadComments, put(comments::see), About::new("Whoever asks has seen the thread up to a comment (CT4).").takes::<Seen>().gives_nothing()),
        route("POST /api/v1/trees/{tree}/threads/{thread}/comments", Action::Comment, post(comments::reply), About::new("Answer in a thread (CT1).").takes::<NewComment>().gives::<Thread>(201)).up_to(MAX_COMMENT_BODY),
        route("PATCH /api/v1/trees/{tree}/threads/{thread}/comments/{comment}", Action::Comment, patch(comments::edit), About::new("Change the words of one's own comment, for 15 minutes (CT5).").takes::<ChangeComment>().gives::<Thread>(200)).up_to(MAX_SAID_BODY),
        route("DELETE /api/v1/trees/{tree}/threads/{thread}/comments/{comment}", Action::Comment, delete(comments::delete), About::new("Delete one's own comment; owners delete any (CT5).").gives_nothing()).noted("delete-comment"),
        route("GET /api/v1/trees/{tree}/threads/{thread}/comments/{comment}/picture", Action::ReadComments, get(comments::picture), About::new("What was seen.").gives_file("image/*")),
        route("GET /api/v1/trees/{tree}/review.html", Action::ReadComments, get(reviews::page).layer(at_once(MAX_REVIEWS)), About::new("What people say of a tree as one page to read and print (CT6).").asks::<reviews::Asked>().gives_file("text/html")).noted("review"),
        route("PUT /api/v1/trees/{tree}/favourite", Action::SeeTree, put(collections::like), About::new("It is a favourite of whoever asks.").gives_nothing()),
        route("DELETE /api/v1/trees/{tree}/favourite", Action::SeeTree, delete(collections::unlike), About::new("It is none.").gives_nothing()),
        route("GET /api/v1/tags", Action::SeeLibrary, get(collections::tags), About::new("All tags.").gives::<Vec<TreeTag>>(200)),
        route("GET /api/v1/authors", Action::SeeLibrary, get(collections::authors), About::new("Who saved trees last, by name.").gives::<Vec<TreeAuthor>>(200)),
        route("GET /api/v1/collections", Action::ListCollections, get(collections::list), About::new("All collections that one may see, by name.").gives::<Vec<TreeCollection>>(200)),
        route("POST /api/v1/collections", Action::ChangeCollections, post(collections::add), About::new("Make a collection.").takes::<NewCollection>().gives::<TreeCollection>(201)),
        route("PATCH /api/v1/collections/{collection}", Action::ChangeCollections, patch(collections::change), About::new("Rename or move a collection; 409 where it would lie in itself.").takes::<ChangeCollection>().gives::<TreeCollection>(200)),
        route("DELETE /api/v1/collections/{collection}", Action::ChangeCollections, delete(collections::delete), About::new("Delete a collection; what lies in it lies in its parent then.").gives_nothing()),
        route("GET /api/v1/collections/{collection}/members", Action::ShareCollection, get(members::of_collection), About::new("To whom a collection was given (AC22).").gives::<Vec<TreeMember>>(200)),
        route("POST /api/v1/collections/{collection}/members", Action::ShareCollection, post(members::add_to_collection), About::new("Give a collection with all that lies in it to a user or a group, or with another role (AC22).").takes::<NewMember>().gives::<TreeMember>(201)).noted("give"),
        route("DELETE /api/v1/collections/{collection}/members/{member}", Action::ShareCollection, delete(members::remove_from_collection), About::new("Take a collection back from a user or a group (AC22).").gives_nothing()).noted("take-back"),
        route("GET /api/v1/trees/{tree}/versions", Action::SeeTree, get(versions::list), About::new("Versions of a tree, newest first, page by page.").asks::<versions::Page>().gives::<Vec<TreeVersion>>(200)),
        route("POST /api/v1/trees/{tree}/versions", Action::ChangeTree, post(versions::save), About::new("Save a session as the newest version of a tree.").takes::<SaveVersion>().gives::<TreeVersion>(201).revised()).up_to(MAX_TREE_BODY),
        route("POST /api/v1/trees/{tree}/versions/import", Action::ChangeTree, post(imports::upload_version).layer(files), About::new("Save a file as the newest version of a tree (IM2).").asks::<imports::VersionUpload>().takes_file("application/octet-stream").gives::<TreeVersion>(201).revised()).up_to(MAX_WOOD_BYTES).within(UPLOAD_TIME),
        route("PATCH /api/v1/trees/{tree}/versions/{version}", Action::ChangeTree, patch(versions::change), About::new("Change what is said of a version.").takes::<ChangeVersion>().gives::<TreeVersion>(200).revised()).up_to(MAX_SAID_BODY),
        route("POST /api/v1/trees/{tree}/versions/{version}/restore", Action::ChangeTree, post(versions::restore), About::new("What was saved then becomes the newest version, which has the next number.").takes::<RestoreVersion>().gives::<TreeVersion>(201).revised()).noted("restore"),
        route("GET /api/v1/trees/{tree}/versions/{version}/document", Action::OpenTree, get(versions::document), About::new("The document of a version ([docs/document.md](../docs/document.md)).").gives_parts("application/octet-stream")).noted(EXPORT),
        route("GET /api/v1/trees/{tree}/versions/{version}/exports/{ticket}", Action::OpenTree, get(exports::progress_of_version), About::new("How far a file of a version is that is being made (EX3).").gives::<ExportProgress>(200)),
        route("GET /api/v1/trees/{tree}/versions/{version}/thumbnail", Action::SeeTree, get(versions::thumbnail), About::new("The picture of a version.").gives_parts("image/*")),
        route("GET /api/v1/trees/{tree}/versions/{version}/turntable", Action::SeeTree, get(versions::turntable), About::new("Twelve pictures of a version from all around, side by side (LB9).").gives_parts("image/png")).within(TURNTABLE_TIME),
    ]
}
