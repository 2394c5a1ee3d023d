//! Options of `espalier group`.

use clap::{
    Args, Subcommand,
    builder::{PossibleValuesParser, TypedValueParser},
};
use espalier_proto::access::Role;

use super::{
    Database,
    people::{Listed, parse_name},
};

/// `group`: users who have a role together. What somebody may do is the most of their own role and those of their
/// groups.
#[derive(Debug, Subcommand)]
pub enum Group {
    /// Add a group, which has no members yet.
    Add(NewGroup),
    /// List the groups with their members.
    Ls(Listed),
    /// Give a group another role, at once wherever its members are logged in.
    Role(GroupOfRole),
    /// Make users members.
    Join(Members),
    /// Make users members no longer.
    Leave(Members),
    /// Remove a group; its members stay users.
    Remove(NamedGroup),
}

/// Options of `group add`.
#[derive(Debug, Args)]
pub struct NewGroup {
    /// How to call it.
    #[arg(value_parser = parse_name)]
    pub name: String,
    /// What its members may do.
    #[arg(long, default_value = Role::Editor.name(), value_parser = roles())]
    pub role: Role,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `group role`.
#[derive(Debug, Args)]
pub struct GroupOfRole {
    /// Its name, as `ls` lists it.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// What its members may do from now on.
    #[arg(value_parser = roles())]
    pub role: Role,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `group join` and `group leave`.
#[derive(Debug, Args)]
pub struct Members {
    /// The group's name, as `ls` lists it.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// The names of the users, as `espalier user ls` lists them.
    #[arg(value_name = "USER", required = true)]
    pub users: Vec<String>,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `group remove`.
#[derive(Debug, Args)]
pub struct NamedGroup {
    /// Its name, as `ls` lists it.
    #[arg(value_name = "NAME")]
    pub name: String,
    #[command(flatten)]
    pub database: Database,
}

/// Administrators are made one by one, so that the last of them is known.
fn roles() -> impl TypedValueParser<Value = Role> {
    let of_groups = [Role::None].into_iter().chain(Role::ALL).filter(|&role| role != Role::Admin);
    PossibleValuesParser::new(of_groups.map(Role::name))
        .try_map(|name| Role::named(&name).ok_or_else(|| format!("there is no role {name}")))
}
