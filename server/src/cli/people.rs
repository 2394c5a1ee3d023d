//! The commands that let people and programs in.

use std::time::Duration;

use clap::{
    Args, Subcommand, ValueEnum,
    builder::{PossibleValuesParser, TypedValueParser},
};
use espalier_proto::{access::Role, text::Name};

use super::Database;
use crate::{
    access::admission::{LONGEST, UNNAMED_DEVICE},
    store::folded,
};

/// Options of `invite`.
#[derive(Debug, Args)]
pub struct Invite {
    /// What whoever comes may do.
    #[arg(long, default_value = Role::Owner.name(), value_parser = roles())]
    pub role: Role,
    /// The only tree they may see: its identifier, as in `GET /api/v1/trees`.
    #[arg(long, value_name = "ID")]
    pub tree: Option<String>,
    /// How long they are let in, from now on, such as 7d; the invitation waits as long. Without it they stay as long as
    /// they come every month, half a year at most, and the invitation waits ten minutes.
    #[arg(long = "for", value_name = "TIME", value_parser = parse_time)]
    pub lasts: Option<Duration>,
    /// How to call their device in `espalier device ls`.
    #[arg(long, default_value = UNNAMED_DEVICE, value_parser = parse_name)]
    pub name: String,
    /// Where others reach the server, such as <https://trees.example>; if not given, the addresses of this machine.
    #[arg(long, value_name = "URL", value_parser = parse_url)]
    pub url: Option<String>,
    /// The server's port.
    #[arg(long, env = "ESPALIER_PORT", default_value_t = super::serve::PORT)]
    pub port: u16,
    #[command(flatten)]
    pub database: Database,
}

/// `user`: who logs in with a password, which is asked for twice, or is the next line of standard input.
#[derive(Debug, Subcommand)]
pub enum User {
    /// Add somebody.
    Add(NewUser),
    /// List those who can log in.
    Ls(Listed),
    /// Give somebody another password; wherever they are logged in, that ends.
    Passwd(NamedUser),
    /// Give somebody another role, at once wherever they are logged in.
    Role(RoleOfUser),
    /// Let somebody log in no longer; an open page of theirs ends within seconds.
    Remove(RemovedUser),
}

/// Options of `user add`.
#[derive(Debug, Args)]
pub struct NewUser {
    /// What they are called, and log in by.
    #[arg(value_parser = parse_name)]
    pub name: String,
    /// They may do everything, and look after who comes in.
    #[arg(long, conflicts_with = "role")]
    pub admin: bool,
    /// What they may do.
    #[arg(long, default_value = Role::Editor.name(), value_parser = roles_of_users())]
    pub role: Role,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `user passwd`.
#[derive(Debug, Args)]
pub struct NamedUser {
    /// Their name, as `ls` lists it.
    #[arg(value_name = "NAME")]
    pub name: String,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `user remove`.
#[derive(Debug, Args)]
pub struct RemovedUser {
    /// Their name, as `ls` lists it.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// Also where they are the last administrator.
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `user role`.
#[derive(Debug, Args)]
pub struct RoleOfUser {
    /// Their name, as `ls` lists it.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// What they may do from now on.
    #[arg(value_parser = roles_of_users())]
    pub role: Role,
    /// Also where they are the last administrator.
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    pub database: Database,
}

/// `device`: who was invited and has come.
#[derive(Debug, Subcommand)]
pub enum Device {
    /// List the devices that are let in.
    Ls(Listed),
    /// Let a device in no longer; an open page of it ends within seconds.
    Revoke(Revoked),
}

/// `token`: programs that may ask the server.
#[derive(Debug, Subcommand)]
pub enum Token {
    /// Make a token and print it: it is shown this once.
    Create(NewToken),
    /// List the tokens that are good.
    Ls(Listed),
    /// Let a program in no longer.
    Revoke(Revoked),
}

/// Options of `token create`.
#[derive(Debug, Args)]
pub struct NewToken {
    /// How to call it.
    #[arg(value_parser = parse_name)]
    pub name: String,
    /// What the program may do.
    #[arg(long, default_value = "read")]
    pub scope: Scope,
    /// How long it is good, from now on.
    #[arg(long = "for", value_name = "TIME", default_value = "90d", value_parser = parse_time)]
    pub lasts: Duration,
    #[command(flatten)]
    pub database: Database,
}

/// What a program may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Scope {
    /// What viewers may.
    Read,
    /// What commenters may.
    Comment,
    /// What editors may.
    Write,
}

/// Options of `user ls`, `device ls` and `token ls`.
#[derive(Debug, Args)]
pub struct Listed {
    #[command(flatten)]
    pub database: Database,
}

/// Options of `device revoke` and `token revoke`.
#[derive(Debug, Args)]
pub struct Revoked {
    /// Its name or its identifier, as `ls` lists them.
    #[arg(value_name = "NAME")]
    pub name: String,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `audit`.
#[derive(Debug, Args)]
pub struct Audit {
    /// Print JSON lines, each as `GET /api/v1/audit` tells an event.
    #[arg(long)]
    pub json: bool,
    /// How many at most, newest first.
    #[arg(long, default_value_t = 100, value_name = "N")]
    pub limit: u32,
    #[command(flatten)]
    pub database: Database,
}

/// The same, and none, for those who see what they were given alone.
fn roles_of_users() -> impl TypedValueParser<Value = Role> {
    PossibleValuesParser::new([Role::None].into_iter().chain(Role::ALL).map(Role::name))
        .try_map(|name| Role::named(&name).ok_or_else(|| format!("there is no role {name}")))
}

fn roles() -> impl TypedValueParser<Value = Role> {
    PossibleValuesParser::new(Role::ALL.map(Role::name))
        .try_map(|name| Role::named(&name).ok_or_else(|| format!("there is no role {name}")))
}

fn parse_time(text: &str) -> Result<Duration, String> {
    let time = humantime::parse_duration(text).map_err(|_| "write a time such as 7d or 12h".to_owned())?;
    if (Duration::from_mins(1)..=LONGEST).contains(&time) {
        Ok(time)
    } else {
        Err("from a minute to ten years is allowed".into())
    }
}

pub(super) fn parse_name(text: &str) -> Result<String, String> {
    let name = text.parse::<Name>()?;
    // What a login finds a user by must be something.
    if folded(name.as_str()).is_empty() {
        Err("a name needs a letter or a digit".into())
    } else {
        Ok(name.into())
    }
}

fn parse_url(text: &str) -> Result<String, String> {
    let url = text.trim_end_matches('/');
    let host = url.strip_prefix("https://").or_else(|| url.strip_prefix("http://"));
    match host {
        Some(host) if !host.is_empty() && !host.contains(['/', '#', '?', ' ']) => Ok(url.to_owned()),
        _ => Err("write it as https://trees.example".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_names_and_addresses_are_checked() {
        assert_eq!(parse_time("7d"), Ok(Duration::from_hours(7 * 24)));
        for text in ["", "7", "soon", "1s", "11y"] {
            assert!(parse_time(text).is_err(), "{text}");
        }
        assert_eq!(parse_name(" Ada's tablet "), Ok("Ada's tablet".into()));
        for text in ["", " ", "a\u{7}b", "\u{202e}ada", "\u{301}", &"a".repeat(81)] {
            assert!(parse_name(text).is_err(), "{text}");
        }
        assert_eq!(parse_url("https://trees.example/"), Ok("https://trees.example".into()));
        for text in ["trees.example", "https://", "http://a/b", "ftp://a", "http://a#b"] {
            assert!(parse_url(text).is_err(), "{text}");
        }
    }
}
