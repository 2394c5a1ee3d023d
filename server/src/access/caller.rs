//! Who asks, and what they may.

use std::{
    net::{IpAddr, Ipv4Addr},
    time::{Duration, SystemTime},
};

use axum::http::{HeaderMap, header};
use base64::{Engine, prelude::BASE64_URL_SAFE_NO_PAD};
use espalier_proto::access::{Me, Role, Way};
use espalier_session::Entrant;

use super::{
    Action, Reach, SecretHash,
    admission::{self, DEVICE_IDLE, TOKEN},
    cookie, hash,
};
use crate::{
    hosts,
    store::{Holder, Pass, PassKind, Passes, Room, Standing, StoreError, Users, identity_of, person_of},
    time::written,
};

/// A device is kept for longer when so much of its time has gone, so that few requests write.
const EXTENDED_AFTER: Duration = Duration::from_hours(24);

/// Where a connection comes from.
#[derive(Clone, Copy, Debug)]
pub struct Peer(pub IpAddr);

/// Where a request comes from.
pub fn address(peer: Option<&Peer>) -> IpAddr {
    peer.map_or(IpAddr::V4(Ipv4Addr::UNSPECIFIED), |Peer(from)| *from)
}

/// What somebody may do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grant {
    role: Role,
    /// The only tree it is for.
    tree: Option<String>,
}

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Object<'a> {
    /// The server as a whole, and its library.
    Server,
    /// The tree with this identifier, or a session of it.
    Tree(&'a str),
    /// A session of no tree, or what is not there.
    Loose,
}

/// Somebody who is let in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Caller {
    grant: Grant,
    /// What they came in by; nothing at the machine itself.
    pass: Option<Held>,
}

/// A pass that somebody has shown.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Held {
    id: String,
    hash: SecretHash,
    kind: PassKind,
    name: String,
    /// Whoever holds it, as whom it lets in; if nobody is named, the device or program itself.
    holder: Option<Holder>,
    most: Option<Role>,
}

impl Held {
    fn of(hash: SecretHash, pass: &Pass) -> Self {
        let Pass { id, kind, name, holder, most, .. } = pass.clone();
        Self { id, hash, kind, name, holder, most }
    }

    /// Whom what is done with it counts for.
    fn person(&self) -> String {
        let pass = |hash| format!("pass {}", BASE64_URL_SAFE_NO_PAD.encode(hash));
        match &self.holder {
            Some(Holder::User { name, .. }) => person_of(name),
            Some(Holder::Device { hash, .. }) => pass(hash),
            None => pass(&self.hash),
        }
    }
}

/// Who somebody is, whatever they are called.
#[derive(Debug, PartialEq, Eq)]
enum Who {
    Machine,
    /// By their identifier.
    User(String),
    /// A device or a program, by its secret.
    Pass(SecretHash),
}

impl Held {
    fn who(&self) -> Who {
        match &self.holder {
            Some(Holder::User { id, .. }) => Who::User(id.clone()),
            Some(Holder::Device { hash, .. }) => Who::Pass(*hash),
            None => Who::Pass(self.hash),
        }
    }
}

/// Why somebody is not let in.
#[derive(Debug)]
pub enum Unknown {
    /// They show nothing that lets them in.
    NotLetIn,
    /// They come as two at once.
    Twofold,
    /// Nobody can say now.
    Store(StoreError),
}

impl From<StoreError> for Unknown {
    fn from(error: StoreError) -> Self {
        Self::Store(error)
    }
}

impl Caller {
    /// Whoever sits at the machine itself.
    pub fn local() -> Self {
        Self { grant: Grant { role: Role::Admin, tree: None }, pass: None }
    }

    /// Whoever sends a request with these headers over a connection (`AC1`, `AC2`).
    pub async fn of(
        headers: &HeaderMap,
        peer: Option<Peer>,
        trusts_local: bool,
        store: &impl Passes,
    ) -> Result<Self, Unknown> {
        let is_local = trusts_local && peer.is_some_and(|peer| is_local(headers, peer));
        let (hash, kinds) = match (bearer(headers), cookie::of(headers)) {
            (Some(_), Some(_)) => return Err(Unknown::Twofold),
            (Some(token), None) => (token, &[PassKind::Token][..]),
            (None, _) if is_local => return Ok(Self::local()),
            (None, Some(cookie)) => (cookie, &[PassKind::Device, PassKind::Login][..]),
            (None, None) => return Err(Unknown::NotLetIn),
        };
        let now = SystemTime::now();
        let pass = store.pass(hash, &written(now)).await?.filter(|pass| kinds.contains(&pass.kind));
        let pass = pass.ok_or(Unknown::NotLetIn)?;
        if pass.kind != PassKind::Token {
            extend(store, &pass, now).await?;
        }
        let held = Held::of(hash, &pass);
        Ok(Self { grant: Grant { role: pass.role, tree: pass.tree }, pass: Some(held) })
    }

    /// Whether they may do it.
    #[cfg(test)]
    pub fn may(&self, action: Action, object: Object<'_>) -> bool {
        self.may_as(self.grant.role, action, object)
    }

    /// Whether they may do it where they have this role.
    pub fn may_as(&self, role: Role, action: Action, object: Object<'_>) -> bool {
        let is_theirs = match (&self.grant.tree, object) {
            (None, _) => true,
            (Some(own), Object::Tree(tree)) => own == tree,
            (Some(_), Object::Server) => action.reach() == Reach::Guests,
            (Some(_), Object::Loose) => false,
        };
        // What tells nothing of any tree is for whoever is let in.
        let is_for_all = object == Object::Server && action.reach() == Reach::Guests;
        let role = if is_for_all { role.max(Role::Viewer) } else { role };
        is_theirs && role >= action.least()
    }

    /// Whether what somebody ordered is theirs as well: they are the same, came in as the same user, or are an
    /// administrator.
    pub fn has_what_is_of(&self, other: &Self) -> bool {
        let holder = |caller: &Self| caller.pass.as_ref().map_or(Who::Machine, Held::who);
        let is_admin = self.grant.role == Role::Admin && self.grant.tree.is_none();
        is_admin || holder(self) == holder(other)
    }

    /// Whom what they do counts for: whoever sits at the machine, the user, or the device or program.
    pub fn person(&self) -> String {
        self.pass.as_ref().map_or_else(|| "machine".to_owned(), Held::person)
    }

    /// As whom authors know them: as [`Self::person`], but a user is the same under another name, and nobody after them.
    pub fn identity(&self) -> String {
        self.user().map_or_else(|| self.person(), identity_of)
    }

    /// The pass by which somebody came who is counted as a person (see [`Self::person`]), unless they have logged in.
    pub fn pass_of(person: &str) -> Option<SecretHash> {
        let hash = BASE64_URL_SAFE_NO_PAD.decode(person.strip_prefix("pass ")?).ok()?;
        hash.try_into().ok()
    }

    /// The only tree that they may see, if it is one.
    pub fn only_tree(&self) -> Option<&str> {
        self.grant.tree.as_deref()
    }

    /// They as they are let in now, perhaps with another role; nothing if they are no longer, or for another tree.
    pub async fn now(&self, store: &impl Passes) -> Result<Option<Self>, StoreError> {
        let Some(held) = &self.pass else { return Ok(Some(self.clone())) };
        let pass = store.pass(held.hash, &written(SystemTime::now())).await?;
        let pass = pass.filter(|pass| pass.tree == self.grant.tree);
        Ok(pass.map(|pass| {
            let held = Held::of(held.hash, &pass);
            Self { grant: Grant { role: pass.role, tree: pass.tree }, pass: Some(held) }
        }))
    }

    /// What is held by a user or a device, for what is made in their name: nobody at the machine, and no program, which
    /// makes nothing of the kind.
    pub fn holder(&self) -> Option<Holder> {
        let held = self.pass.as_ref().filter(|held| held.kind != PassKind::Token)?;
        Some(held.holder.clone().unwrap_or_else(|| {
            let Held { id, hash, name, .. } = held.clone();
            Holder::Device { id, hash, name }
        }))
    }

    /// The secret by which they have logged in, and as whom.
    pub fn login(&self) -> Option<(SecretHash, &str)> {
        let held = self.pass.as_ref().filter(|held| held.kind == PassKind::Login)?;
        Some((held.hash, &held.name))
    }

    /// The identifier of the user that they are, by a login or a program.
    pub fn user(&self) -> Option<&str> {
        match &self.pass.as_ref()?.holder {
            Some(Holder::User { id, .. }) => Some(id),
            _ => None,
        }
    }

    /// Whether all trees are theirs, not one that they were given, or are let in for.
    pub fn owns_all(&self) -> bool {
        self.grant.tree.is_none() && self.grant.role >= Role::Owner
    }

    /// Whom a program acts as.
    pub fn acts_as(&self) -> Option<&str> {
        let held = self.pass.as_ref().filter(|held| held.kind == PassKind::Token)?;
        held.holder.as_ref().map(Holder::name)
    }

    /// Whether a program asks.
    pub fn is_program(&self) -> bool {
        self.pass.as_ref().is_some_and(|held| held.kind == PassKind::Token)
    }

    /// Whether a token is theirs: they made it, or it is the one that they show.
    pub fn has_token(&self, token: &Pass) -> bool {
        match (&self.pass, &token.holder) {
            (None, None) => true,
            (Some(held), None) => held.id == token.id,
            (None, Some(_)) => false,
            (Some(held), Some(Holder::User { id, .. })) => held.who() == Who::User(id.clone()),
            (Some(held), Some(Holder::Device { hash, .. })) => held.who() == Who::Pass(*hash),
        }
    }

    /// Whether the library is open to them as a whole; else they see what they were given alone.
    pub fn sees_all(&self) -> bool {
        self.grant.tree.is_none() && self.grant.role > Role::None
    }

    /// What they may do where they are given this role: a program no more than its token was made for.
    pub fn role_where(&self, given: Role) -> Role {
        let most = self.pass.as_ref().and_then(|held| held.most);
        let role = self.grant.role.max(given);
        most.map_or(role, |most| role.min(most))
    }

    /// The same in a room: what they were given of a tree, or are let in for, opens no session of it while it is deleted
    /// (`LB6`).
    pub fn role_in(&self, room: Room<'_>, given: Role, standing: &Standing) -> Role {
        match room {
            Room::Session(_) if standing.is_deleted && self.grant.tree.is_some() => Role::None,
            Room::Session(_) if standing.is_deleted => self.role_where(Role::None),
            _ => self.role_where(given),
        }
    }

    /// What they may do.
    pub fn role(&self) -> Role {
        self.grant.role
    }

    /// They as a session knows them. A device is called as its invitation says, unless nobody has named it.
    pub fn entrant(&self) -> Entrant {
        let named = self.pass.as_ref().and_then(|held| match &held.holder {
            Some(Holder::User { name, .. }) => Some(name.as_str()),
            Some(Holder::Device { name, .. }) => is_named(name).then_some(name.as_str()),
            None => is_named(&held.name).then_some(held.name.as_str()),
        });
        Entrant {
            person: self.person().into(),
            identity: self.identity().into(),
            name: named.map(Into::into),
            role: self.grant.role,
            is_anybody: self.pass.is_none(),
        }
    }

    /// Whether they may still do it to the server as a whole. A user may who has logged out.
    pub async fn still_may(&self, action: Action, store: &(impl Passes + Users)) -> Result<bool, StoreError> {
        let Some(held) = &self.pass else { return Ok(true) };
        let role = match &held.holder {
            Some(Holder::User { id, .. }) if held.kind == PassKind::Login => {
                let mut users = store.users().await?.into_iter();
                users.find(|user| user.id == *id).map(|user| user.allowed())
            }
            _ => store.pass(held.hash, &written(SystemTime::now())).await?.map(|pass| pass.role),
        };
        let now = |role| Self { grant: Grant { role, ..self.grant.clone() }, pass: None };
        Ok(role.is_some_and(|role| now(role).may_as(role, action, Object::Server)))
    }

    /// What they are called: as they log in, as they say, or as their device or program was named.
    pub fn called(&self, said: Option<String>) -> Option<String> {
        let known = self.entrant().name.map(|name| name.to_string());
        let is_user = self.pass.as_ref().is_some_and(|held| held.kind == PassKind::Login);
        if is_user { known.or(said) } else { said.or(known) }
    }

    /// Somebody who has logged in.
    #[cfg(test)]
    pub fn logged_in(name: &str, role: Role) -> Self {
        let (id, name) = (name.to_owned(), name.to_owned());
        let holder = Some(Holder::User { id: id.clone(), name: name.clone() });
        let held = Held { hash: hash(&id), id, kind: PassKind::Login, name, holder, most: None };
        Self { grant: Grant { role, tree: None }, pass: Some(held) }
    }

    /// Who they are, for themselves.
    pub fn described(&self) -> Me {
        let way = self.pass.as_ref().map_or(Way::Machine, |held| way_of(held.kind));
        let name = self.pass.as_ref().map(|held| held.name.clone());
        Me { role: self.grant.role, way, name, tree: self.grant.tree.clone() }
    }

    /// As whom what they do is counted; whoever sits at the machine may do everything as often as they like.
    pub fn counted_as(&self) -> Option<SecretHash> {
        let held = self.pass.as_ref()?;
        // A user who logs in again is the same.
        Some(match held.who() {
            Who::User(id) => hash(&id),
            Who::Pass(hash) => hash,
            Who::Machine => return None,
        })
    }

    /// Whether they may lose what they have while they are here.
    pub fn is_revocable(&self) -> bool {
        self.pass.is_some()
    }
}

/// Whether a device is called as its invitation says: nobody has named the others.
fn is_named(name: &str) -> bool {
    ![admission::UNNAMED_DEVICE, admission::UNNAMED_LINK].contains(&name)
}

/// How a pass lets in.
pub const fn way_of(kind: PassKind) -> Way {
    match kind {
        PassKind::Token => Way::Token,
        PassKind::Login => Way::Login,
        PassKind::Device | PassKind::Invitation => Way::Device,
    }
}

/// A proxy on this machine would make everybody local; those that say so are told by what they add. Another machine's
/// name that leads here by a trick is none of localhost's.
fn is_local(headers: &HeaderMap, peer: Peer) -> bool {
    let is_passed_on = headers.keys().any(|name| {
        [header::FORWARDED, header::VIA].contains(name) || name.as_str().starts_with("x-forwarded-")
    });
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    peer.0.to_canonical().is_loopback() && hosts::is_loopback(host) && !is_passed_on
}

/// The token that a program sends.
fn bearer(headers: &HeaderMap) -> Option<SecretHash> {
    let value = headers.get(header::AUTHORIZATION)?.to_str().ok()?;
    let (scheme, token) = value.split_once(' ')?;
    let token = token.trim();
    (scheme.eq_ignore_ascii_case("bearer") && token.starts_with(TOKEN)).then(|| hash(token))
}

async fn extend(store: &impl Passes, pass: &Pass, now: SystemTime) -> Result<(), StoreError> {
    let until = |lasts: Duration| written(now + lasts).min(pass.ends_at.clone());
    if pass.expires_at < until(DEVICE_IDLE - EXTENDED_AFTER) {
        store.extend_pass(&pass.id, &until(DEVICE_IDLE)).await?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use axum::http::{HeaderName, HeaderValue};

    use super::*;
    use crate::{
        access::admission::{self, Invite},
        store::MemoryStore,
    };

    fn headers(all: &[(&str, &str)]) -> HeaderMap {
        let each = all.iter().map(|(name, value)| {
            (HeaderName::try_from(*name).unwrap(), HeaderValue::try_from(*value).unwrap())
        });
        each.collect()
    }

    fn peer(address: &str) -> Option<Peer> {
        Some(Peer(address.parse().unwrap()))
    }

    async fn who(all: &[(&str, &str)], from: &str, store: &MemoryStore) -> Result<Caller, Unknown> {
        Caller::of(&headers(all), peer(from), true, store).await
    }

    #[tokio::test]
    async fn ac1_who_sits_at_the_machine_may_do_everything() {
        let store = MemoryStore::default();
        for (host, from) in [
            ("localhost:7700", "127.0.0.1"),
            ("127.0.0.1:7700", "127.0.0.1"),
            ("[::1]:7700", "::1"),
            ("oak.localhost", "::ffff:127.0.0.1"),
        ] {
            assert_eq!(who(&[("host", host)], from, &store).await.unwrap(), Caller::local(), "{host}");
        }
        for all in [
            &[("host", "192.168.1.7:7700")][..],
            &[("host", "oak.example")],
            &[("host", "localhost"), ("x-forwarded-for", "192.168.1.9")],
            &[("host", "localhost"), ("x-forwarded-proto", "https")],
            &[("host", "localhost"), ("forwarded", "for=192.168.1.9")],
            &[("host", "localhost"), ("via", "1.1 proxy")],
            &[],
        ] {
            assert!(matches!(who(all, "127.0.0.1", &store).await, Err(Unknown::NotLetIn)), "{all:?}");
        }
        let local = [("host", "localhost:7700")];
        assert!(matches!(who(&local, "192.168.1.9", &store).await, Err(Unknown::NotLetIn)));
        let distrusted = Caller::of(&headers(&local), peer("127.0.0.1"), false, &store).await;
        assert!(matches!(distrusted, Err(Unknown::NotLetIn)));
    }

    #[test]
    fn jb5_what_was_ordered_is_that_of_the_user_and_of_administrators() {
        let caller = |kind, name: &str, secret: &str, role| Caller {
            grant: Grant { role, tree: None },
            pass: Some(Held {
                id: secret.to_owned(),
                hash: hash(secret),
                kind,
                name: name.to_owned(),
                holder: (kind == PassKind::Login)
                    .then(|| Holder::User { id: name.to_owned(), name: name.to_owned() }),
                most: None,
            }),
        };
        let ordered = caller(PassKind::Login, "Ada", "one", Role::Editor);
        assert!(ordered.has_what_is_of(&ordered));
        assert!(
            caller(PassKind::Login, "Ada", "two", Role::Editor).has_what_is_of(&ordered),
            "another browser"
        );
        assert!(caller(PassKind::Login, "Ben", "three", Role::Admin).has_what_is_of(&ordered));
        assert!(Caller::local().has_what_is_of(&ordered));
        for other in [
            caller(PassKind::Login, "Ben", "four", Role::Owner),
            caller(PassKind::Token, "Ada", "five", Role::Owner),
            caller(PassKind::Device, "Ada", "six", Role::Owner),
        ] {
            assert!(!other.has_what_is_of(&ordered), "{other:?}");
        }
        let guest = Caller {
            grant: Grant { role: Role::Admin, tree: Some("elm".into()) },
            ..caller(PassKind::Device, "Eve", "seven", Role::Admin)
        };
        assert!(!guest.has_what_is_of(&ordered));
    }

    #[tokio::test]
    async fn ac3_a_device_comes_in_by_its_cookie_until_it_is_not_used() {
        let store = MemoryStore::default();
        let now = SystemTime::now();
        let days = |days: u64| Duration::from_hours(24 * days);
        let invited = admission::invite(&store, Invite::default(), now).await.unwrap();
        let (cookie, _) = admission::redeem(&store, invited.text(), now).await.unwrap().unwrap();
        let sent = format!("theme=dark; espalier-7700={}", cookie.text());
        let with_cookie = [("host", "192.168.1.7:7700"), ("cookie", &*sent)];
        let caller = who(&with_cookie, "192.168.1.9", &store).await.unwrap();
        assert_eq!(caller.grant, Grant { role: Role::Owner, tree: None });
        // What is used some days later is kept for longer, but not beyond its end.
        let pass = async || store.pass(cookie.hash(), "2026").await.unwrap().unwrap();
        let first = pass().await;
        assert_eq!(first.expires_at, written(now + days(30)));
        extend(&store, &first, now + days(3)).await.unwrap();
        assert_eq!(pass().await.expires_at, written(now + days(33)));
        extend(&store, &pass().await, now + days(170)).await.unwrap();
        assert_eq!(pass().await.expires_at, first.ends_at);
        store.take_pass(&first.id).await.unwrap();
        assert_eq!(caller.now(&store).await.unwrap(), None);
        assert!(matches!(who(&with_cookie, "192.168.1.9", &store).await, Err(Unknown::NotLetIn)));
        // An invitation's own secret is no cookie.
        let invited = admission::invite(&store, Invite::default(), now).await.unwrap();
        let sent = format!("espalier={}", invited.text());
        let with_cookie = [("host", "192.168.1.7"), ("cookie", &*sent)];
        assert!(matches!(who(&with_cookie, "192.168.1.9", &store).await, Err(Unknown::NotLetIn)));
    }

    #[test]
    fn ac5_a_guest_gets_to_one_tree() {
        let grant = Grant { role: Role::Editor, tree: Some("ash".into()) };
        let (id, name, holder) = ("tablet".into(), "tablet".into(), None);
        let held = Held { id, hash: [1; 32], kind: PassKind::Device, name, holder, most: None };
        let guest = Caller { grant, pass: Some(held) };
        for (action, object, expected) in [
            (Action::SeeTree, Object::Tree("ash"), true),
            (Action::EditSession, Object::Tree("ash"), true),
            (Action::DeleteTree, Object::Tree("ash"), false),
            (Action::SeeTree, Object::Tree("elm"), false),
            (Action::JoinSession, Object::Loose, false),
            (Action::ListTrees, Object::Server, true),
            (Action::SeeLibrary, Object::Server, false),
            (Action::SaveTree, Object::Server, false),
        ] {
            assert_eq!(guest.may(action, object), expected, "{action:?} {object:?}");
        }
    }
}
