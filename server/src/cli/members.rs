//! Options of `espalier member`.

use clap::{
    Args, Subcommand,
    builder::{PossibleValuesParser, TypedValueParser},
};
use espalier_proto::access::Role;

use super::Database;

/// `member`: to whom a tree or a collection is given, beside what they may do on the server.
#[derive(Debug, Subcommand)]
pub enum Member {
    /// Give a tree or a collection to a user or a group, or with another role; at once wherever they are logged in.
    Add(NewMember),
    /// List to whom a tree or a collection was given.
    Ls(MembersOf),
    /// Take a tree or a collection back from a user or a group.
    Remove(RemovedMember),
}

/// What is given.
#[derive(Debug, Args)]
pub struct Shared {
    /// A tree, or with --collection a collection: its identifier, or its name where no other one has it.
    #[arg(value_name = "TREE")]
    pub what: String,
    /// It is a collection, with all that lies in it.
    #[arg(long)]
    pub collection: bool,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `member ls`.
#[derive(Debug, Args)]
pub struct MembersOf {
    #[command(flatten)]
    pub shared: Shared,
}

/// Options of `member add`.
#[derive(Debug, Args)]
pub struct NewMember {
    #[command(flatten)]
    pub shared: Shared,
    /// The name of a user, or with --group of a group.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// It is a group.
    #[arg(long)]
    pub group: bool,
    /// What they may do with it, if they may do no more anyhow.
    #[arg(long, default_value = Role::Editor.name(), value_parser = roles())]
    pub role: Role,
}

/// Options of `member remove`.
#[derive(Debug, Args)]
pub struct RemovedMember {
    #[command(flatten)]
    pub shared: Shared,
    /// The name of a user, or with --group of a group.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// It is a group.
    #[arg(long)]
    pub group: bool,
}

/// Administrators are those of the server.
fn roles() -> impl TypedValueParser<Value = Role> {
    let given = Role::ALL.into_iter().filter(|&role| role != Role::Admin);
    PossibleValuesParser::new(given.map(Role::name))
        .try_map(|name| Role::named(&name).ok_or_else(|| format!("there is no role {name}")))
}
