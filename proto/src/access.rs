//! Who may come in, over HTTP.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{bounded::LinkHours, text::Name};

/// What somebody may do; each may do what those before it may.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema, TS,
)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Nothing, but what they were given: trees, or collections of them (`AC22`).
    None,
    /// Look, and take copies away.
    Viewer,
    /// Say what they think of it.
    Commenter,
    /// Draw and save.
    Editor,
    /// Delete.
    Owner,
    /// Look after who comes in.
    Admin,
}

impl Role {
    /// All that may something everywhere, those that may least first.
    pub const ALL: [Self; 5] = [Self::Viewer, Self::Commenter, Self::Editor, Self::Owner, Self::Admin];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Viewer => "viewer",
            Self::Commenter => "commenter",
            Self::Editor => "editor",
            Self::Owner => "owner",
            Self::Admin => "admin",
        }
    }

    /// What somebody of this role may do with a tree that is locked (`AC16`): who may draw otherwise comments.
    pub const fn under_lock(self) -> Self {
        match self {
            Self::Editor => Self::Commenter,
            other => other,
        }
    }

    /// The role of this name.
    pub fn named(name: &str) -> Option<Self> {
        [Self::None].into_iter().chain(Self::ALL).find(|role| role.name() == name)
    }
}

/// `POST /api/v1/redeem`: come in by an invitation (`AC3`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Redeem {
    /// What stands behind the `#` of its link.
    pub secret: String,
}

/// `POST /api/v1/login`: come in with a password (`AC9`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct LogIn {
    /// Who one is.
    pub name: String,
    /// What only they know.
    pub password: String,
}

/// `GET /api/v1/entry`: what somebody can come in by.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Entrance {
    /// Whether anybody has a password here.
    pub passwords: bool,
}

/// Somebody who can log in (`AC19`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ListedUser {
    /// Their identifier, which stays theirs whatever they are called.
    pub id: String,
    /// What they are called, and log in by.
    pub name: String,
    /// What they may do, by themselves or by a group.
    pub role: Role,
    /// What they may do by themselves.
    pub own_role: Role,
    /// The names of the groups that they are in.
    pub groups: Vec<String>,
    /// When they were added, in UTC.
    pub created_at: String,
    /// How often their name, role or password was changed, and 1; the `ETag` has it as well.
    #[ts(type = "number")]
    pub revision: u64,
}

/// `POST /api/v1/users`: somebody can log in from now on (`AC19`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct NewUser {
    /// What they are called, and log in by.
    pub name: Name,
    /// What they may do by themselves.
    pub role: Role,
    /// What they log in with: 8 to 200 characters.
    pub password: String,
}

/// `PATCH /api/v1/users/{user}`: change somebody who can log in (`AC19`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangeUser {
    /// What they are called, and log in by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<Name>,
    /// What they may do by themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub role: Option<Role>,
    /// What they log in with; wherever they are logged in, that ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub password: Option<String>,
}

/// `PUT /api/v1/me/password`: log in with another password from now on (`AC19`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangePassword {
    /// The one until now.
    pub old: String,
    /// The one from now on: 8 to 200 characters.
    pub new: String,
}

/// Users who have a role together (`AC20`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ListedGroup {
    /// Its identifier, which stays whatever it is called.
    pub id: String,
    /// What it is called.
    pub name: String,
    /// What its members may do, if their own role is not more.
    pub role: GroupRole,
    /// Who is in it, by name.
    pub members: Vec<GroupMember>,
    /// When it was added, in UTC.
    pub created_at: String,
    /// How often its name, role or members were changed, and 1; the `ETag` has it as well.
    #[ts(type = "number")]
    pub revision: u64,
}

/// Somebody in a group.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GroupMember {
    /// The identifier of the user.
    pub id: String,
    /// What they are called.
    pub name: String,
}

/// What a group may allow: administrators are made one by one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum GroupRole {
    /// As the role.
    None,
    /// As the role.
    Viewer,
    /// As the role.
    Commenter,
    /// As the role.
    Editor,
    /// As the role.
    Owner,
}

impl From<GroupRole> for Role {
    fn from(role: GroupRole) -> Self {
        match role {
            GroupRole::None => Self::None,
            GroupRole::Viewer => Self::Viewer,
            GroupRole::Commenter => Self::Commenter,
            GroupRole::Editor => Self::Editor,
            GroupRole::Owner => Self::Owner,
        }
    }
}

impl From<Role> for GroupRole {
    /// No more than a group may have.
    fn from(role: Role) -> Self {
        match role {
            Role::None => Self::None,
            Role::Viewer => Self::Viewer,
            Role::Commenter => Self::Commenter,
            Role::Editor => Self::Editor,
            Role::Owner | Role::Admin => Self::Owner,
        }
    }
}

/// `POST /api/v1/groups`: users may have a role together (`AC20`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct NewGroup {
    /// What it is called.
    pub name: Name,
    /// What its members may do.
    pub role: GroupRole,
}

/// `PATCH /api/v1/groups/{group}`: change a group (`AC20`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangeGroup {
    /// What it is called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<Name>,
    /// What its members may do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub role: Option<GroupRole>,
}

/// Somebody to whom a tree or a collection was given (`AC22`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeMember {
    /// The identifier of the user or the group.
    pub id: String,
    /// What they are called.
    pub name: String,
    /// Whether it is a group.
    pub group: bool,
    /// What they may do there, if they may do no more anyhow.
    pub role: MemberRole,
}

/// `POST /api/v1/trees/{tree}/members`, `POST /api/v1/collections/{collection}/members`: give it to a user or a group
/// (`AC22`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct NewMember {
    /// What the user or the group is called.
    pub name: Name,
    /// Whether it is a group.
    #[serde(default)]
    #[ts(optional, as = "Option<bool>")]
    pub group: bool,
    /// What they may do there.
    pub role: MemberRole,
}

/// What a tree or a collection may be given with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum MemberRole {
    /// As the role.
    Viewer,
    /// As the role.
    Commenter,
    /// As the role.
    Editor,
    /// As the role.
    Owner,
}

impl From<MemberRole> for Role {
    fn from(role: MemberRole) -> Self {
        match role {
            MemberRole::Viewer => Self::Viewer,
            MemberRole::Commenter => Self::Commenter,
            MemberRole::Editor => Self::Editor,
            MemberRole::Owner => Self::Owner,
        }
    }
}

impl From<Role> for MemberRole {
    /// The nearest that something may be given with.
    fn from(role: Role) -> Self {
        match role {
            Role::None | Role::Viewer => Self::Viewer,
            Role::Commenter => Self::Commenter,
            Role::Editor => Self::Editor,
            Role::Owner | Role::Admin => Self::Owner,
        }
    }
}

/// A program that may ask the server (`AC21`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ListedToken {
    /// Its identifier; no secret.
    pub id: String,
    /// What the program is called.
    pub name: String,
    /// What it may do now: never more than whoever made it.
    pub role: Role,
    /// What whoever made it is called, as whom the program acts; nobody, where it was made at the machine itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub of: Option<String>,
    /// When it was made, in UTC.
    pub since: String,
    /// When it ends.
    pub until: String,
}

/// `POST /api/v1/tokens`: let a program act as oneself (`AC21`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct NewToken {
    /// What the program is called.
    pub name: Name,
    /// The most that it may do.
    pub role: LinkRole,
    /// For how many hours, from now on; without it for 90 days.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub hours: Option<LinkHours>,
}

/// A token as it is shown once.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct MadeToken {
    /// Its identifier.
    pub id: String,
    /// What the program sends as `Authorization: Bearer TOKEN`.
    pub token: String,
}

/// Somebody has come in; the cookie of the answer says so from now on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Admitted {
    /// What they may do.
    pub role: Role,
    /// The only tree that they may see, if it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tree: Option<String>,
}

/// `GET /api/v1/me`: who asks, and what they may do (`AC8`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Me {
    /// What they may do.
    pub role: Role,
    /// How they have come in.
    pub way: Way,
    /// What they are called, or their device or program; nobody at the machine itself is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<String>,
    /// The only tree that they may see, if it is one. They may not ask for the library as a whole then: its collections,
    /// tags and authors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tree: Option<String>,
}

/// `GET /api/v1/audit`: something that was done, or refused (`AC10`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct AuditEvent {
    /// Its number; later ones have larger numbers.
    #[ts(type = "number")]
    pub number: u64,
    /// When, in UTC.
    pub at: String,
    /// By whom: the way that they came in (`Way`), and how they are called.
    pub who: String,
    /// Where they asked from; nothing where they sat at the machine's own command line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub address: Option<String>,
    /// What.
    pub action: String,
    /// To what.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub object: Option<String>,
    /// `done`, or the status that it was refused with.
    pub outcome: String,
    /// How often: what is refused again, or taken again, within a day is counted here.
    pub times: u32,
    /// When it came last, where it came again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub last_at: Option<String>,
}

/// `POST /api/v1/trees/{tree}/links`: let somebody in for one tree (`AC12`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct NewLink {
    /// What they may do.
    pub role: LinkRole,
    /// For how many hours, from now on; without it as long as they come every month, half a year at most, and the link
    /// waits for a year.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub hours: Option<LinkHours>,
    /// What their device is called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<Name>,
}

/// `PATCH /api/v1/trees/{tree}/links/{link}`: let somebody do more or less (`AC12`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangeLink {
    /// What they may do from now on.
    pub role: LinkRole,
}

/// What a link or a token may allow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum LinkRole {
    /// As the role.
    Viewer,
    /// As the role.
    Commenter,
    /// As the role.
    Editor,
}

impl From<LinkRole> for Role {
    fn from(role: LinkRole) -> Self {
        match role {
            LinkRole::Viewer => Self::Viewer,
            LinkRole::Commenter => Self::Commenter,
            LinkRole::Editor => Self::Editor,
        }
    }
}

/// `GET /api/v1/trees/{tree}/links`: somebody who was invited to a tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeLink {
    /// Its identifier, which stays that of the device that came by it; no secret.
    pub id: String,
    /// What their device is called.
    pub name: String,
    /// What they may do.
    pub role: Role,
    /// When it was made or, where somebody has come by it, when that was; in UTC.
    pub since: String,
    /// When it ends, unless they come again before.
    pub until: String,
    /// Whether somebody has come by it.
    pub used: bool,
}

/// `GET /api/v1/sessions/{session}/guests`: somebody who is in a session and came by a link of a tree (`AC12`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GuestHere {
    /// Their number, as in `people` (`PS3`).
    pub person: u32,
    /// The identifier of the tree.
    pub tree: String,
    /// The link by which they came.
    pub link: TreeLink,
}

/// `GET`, `PUT`, `DELETE /api/v1/trees/{tree}/lock`: whether owners alone change a tree (`AC16`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeLock {
    /// Who has locked it, if anybody has.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub by: Option<String>,
}

/// `DELETE /api/v1/sessions/{session}/people/{person}`: somebody was removed (`AC17`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct RemovedPerson {
    /// What they are called.
    pub name: String,
    /// Until when they are kept out, in UTC; nothing where the link by which they came was revoked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub until: Option<String>,
}

/// `GET /api/v1/sessions/{session}/removals`: somebody is kept out for some hours (`AC17`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct KeptOut {
    /// The identifier of their removal.
    pub id: String,
    /// What they are called.
    pub name: String,
    /// What whoever removed them is called.
    pub by: String,
    /// Until when, in UTC.
    pub until: String,
}

/// `PUT /api/v1/sessions/{session}/owner`: hand the tree over (`AC18`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct HandOver {
    /// The number of somebody who is in the session.
    pub person: u32,
}

/// `GET`, `PUT`, `DELETE /api/v1/sessions/{session}/owner`: to whom the tree was handed over (`AC18`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeOwner {
    /// What they are called, if it was handed over to anybody.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<String>,
}

/// A link as it is shown once.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct MadeLink {
    /// Its identifier.
    pub id: String,
    /// What to open on the device that is to be let in.
    pub url: String,
}

/// How somebody has come in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// They sit at the server's machine.
    Machine,
    /// They were invited.
    Device,
    /// They have logged in.
    Login,
    /// A program has a token.
    Token,
}

impl Way {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Machine => "machine",
            Self::Device => "device",
            Self::Login => "login",
            Self::Token => "token",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_role_is_written_by_its_name() {
        for role in Role::ALL {
            assert_eq!(Role::named(role.name()), Some(role));
            assert_eq!(serde_json::to_value(role).unwrap(), role.name());
        }
        assert!(Role::ALL.is_sorted());
    }
}
