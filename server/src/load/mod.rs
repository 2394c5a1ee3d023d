//! `espalier load`: many people at once on a server, and how long they wait ([docs/performance.md](../../../docs/performance.md#load)).

mod delays;
mod person;
mod progress;
mod scenarios;
mod site;

use std::{io, sync::Arc, time::Duration};

use clap::Args;

use self::site::Site;
pub use self::{scenarios::Scenario, site::Url};
use crate::output;

const NOTES: &str = "\
Scenarios: drawing and all-draw (--sessions, --metamers), growers (--people, --beside), restores (--people, --beside, --large), idle
(--sockets), malformed (--connections). The driver makes sessions on the server that it measures, so measure one that nobody needs,
from the same machine, for others may begin 20 sessions in two minutes. It prints a table, and fails where the server lets somebody go.";

/// Options of `load`.
#[derive(Debug, Args)]
#[command(after_help = NOTES)]
pub struct Load {
    /// What is measured.
    #[arg(value_enum)]
    pub scenario: Scenario,
    /// The server.
    #[arg(long, default_value = "http://127.0.0.1:7700")]
    pub url: Url,
    /// A token to come in with, where nobody is let in merely because they sit at the machine.
    #[arg(long, env = "ESPALIER_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: Option<String>,
    /// How long is measured.
    #[arg(long, default_value_t = 30, value_parser = clap::value_parser!(u64).range(1..=3600))]
    pub seconds: u64,
    /// Sessions, with two sockets each.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub sessions: u32,
    /// Living metamers of each tree that is drawn on.
    #[arg(long, default_value_t = 5000, value_parser = clap::value_parser!(u32).range(1..))]
    pub metamers: u32,
    /// People who draw beside what is heavy.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub people: u32,
    /// Trees that grow, or are opened, beside them.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=100))]
    pub beside: u32,
    /// Living metamers of each tree that is opened.
    #[arg(long, default_value_t = 500_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub large: u32,
    /// Sockets on which nothing happens.
    #[arg(long, default_value_t = 2000, value_parser = clap::value_parser!(u32).range(2..=50_000))]
    pub sockets: u32,
    /// Connections that send nonsense.
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub connections: u32,
}

impl Load {
    fn time(&self) -> Duration {
        Duration::from_secs(self.seconds)
    }
}

/// Nothing could be measured; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// There is no such machine.
    #[error("There is no machine of the name {0}.")]
    NotThere(String),
    /// The server does not answer.
    #[error("The server does not answer ({0}).")]
    Silent(String),
    /// The server refuses something.
    #[error("The server answers {path} with {status}: {body}")]
    Refused {
        /// What was asked for.
        path: String,
        /// Its answer.
        status: u16,
        /// What it says.
        body: String,
    },
    /// Somebody was let go.
    #[error("Somebody was let go ({0}).")]
    Lost(String),
    /// The driver's threads cannot be made, or its table not be written.
    #[error("The driver cannot work: {0}.")]
    Driver(#[from] io::Error),
}

/// Measures, and prints a table.
///
/// # Errors
/// Where the server does not do what is asked of it.
pub fn run(load: &Load) -> Result<(), LoadError> {
    // One thread, so that the driver takes no more of a small machine than it must.
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    let table = runtime.block_on(async {
        let site = Arc::new(Site::find(&load.url, load.token.clone()).await?);
        load.scenario.run(&site, load).await
    })?;
    Ok(output::print(table.text().as_bytes())?)
}
