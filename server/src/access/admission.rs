//! How somebody is let in: invited, and then as a device; with a password; or as a program with a token.

use std::time::{Duration, SystemTime};

use espalier_proto::access::Role;

use super::{Secret, hash};
use crate::{
    name,
    store::{Holder, Pass, PassKind, Passes, StoreError, User},
    time::written,
};

/// An invitation waits so long.
pub const INVITATION_LIFE: Duration = Duration::from_mins(10);
/// A device that is not used is forgotten after this,
pub const DEVICE_IDLE: Duration = Duration::from_hours(30 * 24);
/// and each after this.
pub const DEVICE_LIFE: Duration = Duration::from_hours(180 * 24);
/// What tokens begin with.
pub const TOKEN: &str = "esp_";
/// The longest that anything may be good for.
pub const LONGEST: Duration = Duration::from_hours(10 * 365 * 24);

/// What a device is called that nobody has named: by an invitation,
pub const UNNAMED_DEVICE: &str = "device";
/// and by a link.
pub const UNNAMED_LINK: &str = "link";

/// Whom to invite.
#[derive(Clone, Debug)]
pub struct Invite {
    /// How people call them.
    pub name: String,
    /// What they may do.
    pub role: Role,
    /// The only tree they may see.
    pub tree: Option<String>,
    /// For how long they are let in, and the invitation waits; if nothing is said, it waits ten minutes.
    pub lasts: Option<Duration>,
}

impl Default for Invite {
    fn default() -> Self {
        Self { name: UNNAMED_DEVICE.into(), role: Role::Owner, tree: None, lasts: None }
    }
}

/// Invites somebody; whoever redeems the secret first has come.
pub async fn invite(store: &impl Passes, invite: Invite, now: SystemTime) -> Result<Secret, StoreError> {
    let waits = invite.lasts.unwrap_or(INVITATION_LIFE);
    let (secret, pass) = invitation(invite, waits, now);
    store.add_pass(secret.hash(), pass).await?;
    Ok(secret)
}

/// The same for a tree for which up to so many are let in, with an invitation that waits so long; with its identifier.
pub async fn link(
    store: &impl Passes,
    invite: Invite,
    (waits, most): (Duration, u32),
    now: SystemTime,
) -> Result<(Secret, String), StoreError> {
    let (secret, pass) = invitation(invite, waits, now);
    let id = pass.id.clone();
    store.add_pass_up_to(most, secret.hash(), pass).await?;
    Ok((secret, id))
}

fn invitation(invite: Invite, waits: Duration, now: SystemTime) -> (Secret, Pass) {
    let (secret, id) = (Secret::short(), name::unguessable());
    let Invite { name, role, tree, lasts } = invite;
    let pass = Pass {
        id,
        kind: PassKind::Invitation,
        name,
        role,
        holder: None,
        most: None,
        tree,
        created_at: written(now),
        expires_at: written(now + waits),
        ends_at: written(now + lasts.unwrap_or(LONGEST)),
    };
    (secret, pass)
}

/// Makes a device of whoever has the secret of an invitation, which is used up by that; the device has its identifier. None
/// where there is no such invitation, or its tree is deleted.
pub async fn redeem(
    store: &impl Passes,
    secret: &str,
    now: SystemTime,
) -> Result<Option<(Secret, Pass)>, StoreError> {
    let found = store.pass(hash(secret.trim()), &written(now)).await?;
    let Some(invitation) = found.filter(|pass| pass.kind == PassKind::Invitation) else { return Ok(None) };
    let (secret, device) = cookie_of(Pass { kind: PassKind::Device, ..invitation }, now);
    Ok(store.redeem_pass(secret.hash(), &device).await?.then_some((secret, device)))
}

/// Lets in a user whose password was right.
pub async fn log_in(store: &impl Passes, user: User, now: SystemTime) -> Result<(Secret, Pass), StoreError> {
    let (role, name, most) = (user.allowed(), user.name, None);
    // Whoever goes by the name by the time it is kept may be somebody else.
    let holder = Some(Holder::User { id: user.id, name: name.clone() });
    let ends_at = written(now + DEVICE_LIFE);
    let (id, created_at, expires_at) = (name::unguessable(), String::new(), ends_at.clone());
    let pass = Pass {
        id,
        kind: PassKind::Login,
        name,
        role,
        holder,
        most,
        tree: None,
        created_at,
        expires_at,
        ends_at,
    };
    let (secret, pass) = cookie_of(pass, now);
    store.add_pass(secret.hash(), pass.clone()).await?;
    Ok((secret, pass))
}

/// A cookie of its own for whoever comes in now by such a pass.
fn cookie_of(like: Pass, now: SystemTime) -> (Secret, Pass) {
    let secret = Secret::long("");
    let ends_at = written(now + DEVICE_LIFE).min(like.ends_at);
    let pass = Pass {
        created_at: written(now),
        expires_at: written(now + DEVICE_IDLE).min(ends_at.clone()),
        ends_at,
        ..like
    };
    (secret, pass)
}

/// A token to be made.
#[derive(Clone, Debug)]
pub struct NewToken {
    /// What the program is called.
    pub name: String,
    /// What it may do, if whoever holds it may.
    pub role: Role,
    /// Whoever holds it; nobody, where it is made at the machine.
    pub holder: Option<Holder>,
    /// How long it is good.
    pub lasts: Duration,
    /// How many they may have with it.
    pub most: u32,
}

/// Makes a token for a program; with its identifier.
pub async fn token(
    store: &impl Passes,
    NewToken { name, role, holder, lasts, most: count }: NewToken,
    now: SystemTime,
) -> Result<(Secret, String), StoreError> {
    let (secret, id) = (Secret::long(TOKEN), name::unguessable());
    let ends_at = written(now + lasts);
    let pass = Pass {
        id: id.clone(),
        kind: PassKind::Token,
        name,
        role,
        holder,
        most: None,
        tree: None,
        created_at: written(now),
        expires_at: ends_at.clone(),
        ends_at,
    };
    store.add_pass_up_to(count, secret.hash(), pass).await?;
    Ok((secret, id))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::MemoryStore;

    const DAY: Duration = Duration::from_hours(24);

    #[tokio::test]
    async fn ac3_an_invitation_lets_one_in_for_ten_minutes() {
        let (store, now) = (MemoryStore::default(), SystemTime::now());
        let invited = invite(&store, Invite::default(), now).await.unwrap();
        let redeeming = async || redeem(&store, invited.text(), now).await.unwrap();
        let all = tokio::join!(redeeming(), redeeming(), redeeming());
        assert_eq!([all.0, all.1, all.2].iter().flatten().count(), 1, "of several one has it");
        assert!(redeem(&store, "something else", now).await.unwrap().is_none());

        let late = invite(&store, Invite::default(), now).await.unwrap();
        let later = now + INVITATION_LIFE;
        assert!(redeem(&store, late.text(), later).await.unwrap().is_none(), "it has expired");
        let last = later - Duration::from_millis(2);
        let (cookie, device) = redeem(&store, late.text(), last).await.unwrap().unwrap();
        assert_eq!((device.kind, &*device.ends_at), (PassKind::Device, &*written(last + DEVICE_LIFE)));
        assert_eq!(store.pass(cookie.hash(), &written(last)).await.unwrap(), Some(device));
        // What lets a device in is no invitation.
        assert!(redeem(&store, cookie.text(), last).await.unwrap().is_none());
    }

    #[tokio::test]
    async fn ac3_what_is_for_a_week_ends_after_it() {
        let (store, now) = (MemoryStore::default(), SystemTime::now());
        let week = Invite { role: Role::Viewer, lasts: Some(7 * DAY), ..Invite::default() };
        let invited = invite(&store, week, now).await.unwrap();
        let (_, device) = redeem(&store, invited.text(), now + 6 * DAY).await.unwrap().unwrap();
        let end = written(now + 7 * DAY);
        assert_eq!((device.role, &*device.expires_at, &*device.ends_at), (Role::Viewer, &*end, &*end));
    }
}
