//! Options of `serve`.

use std::{net::IpAddr, ops::RangeInclusive};

use clap::Args;
use espalier_growth::DEFAULT_METAMER_BUDGET;
use espalier_session::MAX_METAMER_BUDGET;
use ipnet::IpNet;

use super::Database;
use crate::{hosts::HostName, logging::LogFormat, memory::Bytes};

/// Where the server listens unless it is told otherwise.
pub(super) const PORT: u16 = 7700;

/// Budgets of metamers of a session, whose document is kept.
const SESSION_BUDGETS: RangeInclusive<i64> = 1..=MAX_METAMER_BUDGET as i64;

/// Less than this is no server.
const LEAST_MEMORY: u64 = 64 << 20;

const SERVE_NOTES: &str = "\
The server prints its address and, with --host 0.0.0.0, a link and a QR code that let a tablet in the same network in;
`espalier invite` prints more of them.
Everything is kept in one SQLite file; Ctrl+C stops the server, and even a crash loses nothing acknowledged.";

/// Options of `serve`.
#[derive(Clone, Debug, Args)]
#[command(after_help = SERVE_NOTES)]
pub struct Serve {
    /// Address to listen on; 0.0.0.0 lets other machines in, a tablet, say.
    #[arg(long, env = "ESPALIER_HOST", default_value = "127.0.0.1")]
    pub host: IpAddr,
    /// A name of this server besides localhost and the machine's own, as a proxy in front of it passes it on; may be
    /// given again.
    #[arg(
        id = "host-name",
        long = "host-name",
        env = "ESPALIER_HOST_NAME",
        value_name = "NAME",
        value_delimiter = ',',
        value_parser = parse_host_name
    )]
    pub host_names: Vec<HostName>,
    /// Address of a proxy in front, or the network of several, whose X-Forwarded-For, X-Forwarded-Proto and X-Forwarded-Host are believed; may be
    /// given again.
    #[arg(
        id = "trusted-proxy",
        long = "trusted-proxy",
        env = "ESPALIER_TRUSTED_PROXY",
        value_name = "ADDRESS",
        value_parser = parse_proxies,
        value_delimiter = ','
    )]
    pub trusted_proxies: Vec<IpNet>,
    /// Invite also whoever sits at this machine; for machines that strangers have accounts on.
    #[arg(long, env = "ESPALIER_NO_LOCAL")]
    pub no_local: bool,
    /// Let in whoever logs in, and nobody merely because they sit at this machine; `espalier user add` adds people.
    #[arg(long, env = "ESPALIER_AUTH", conflicts_with = "no_local")]
    pub auth: bool,
    /// Port to listen on; 0 takes a free one.
    #[arg(long, env = "ESPALIER_PORT", default_value_t = PORT)]
    pub port: u16,
    #[command(flatten)]
    pub database: Database,
    /// Metamers that a session begun from now on may hold, dead ones included; growth stops there.
    #[arg(
        long,
        env = "ESPALIER_METAMER_BUDGET",
        default_value_t = DEFAULT_METAMER_BUDGET,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(SESSION_BUDGETS)
    )]
    pub metamer_budget: u32,
    /// Days that the server keeps a session which is not saved after somebody was in it last; saved ones go after 30 at most.
    #[arg(
        long,
        env = "ESPALIER_KEEP_UNSAVED",
        default_value_t = 90,
        value_name = "DAYS",
        value_parser = clap::value_parser!(u32).range(1..=36_500)
    )]
    pub keep_unsaved: u32,
    /// The most memory that the server may use: 512M, 2G; less if its container or the machine has less. Growth, files and
    /// visitors wait where there is none left.
    #[arg(long, env = "ESPALIER_MEMORY", value_name = "SIZE", value_parser = parse_memory)]
    pub memory: Option<Bytes>,
    /// What to log to stderr: error, warn, info, debug, trace, or a filter such as espalier=debug,sqlx=warn.
    #[arg(long, env = "ESPALIER_LOG", default_value = "info", value_name = "LEVEL")]
    pub log: String,
    /// How lines of the log are written.
    #[arg(long, env = "ESPALIER_LOG_FORMAT", value_enum, default_value_t = LogFormat::Text, value_name = "FORMAT")]
    pub log_format: LogFormat,
    /// Log each request when it is answered: its number, method, path, status, time and who asked.
    #[arg(long, env = "ESPALIER_ACCESS_LOG")]
    pub access_log: bool,
}

fn parse_memory(text: &str) -> Result<Bytes, String> {
    let bytes: Bytes = text.parse()?;
    if bytes.0 < LEAST_MEMORY { Err("it needs 64M at least".into()) } else { Ok(bytes) }
}

fn parse_host_name(text: &str) -> Result<HostName, String> {
    HostName::parse(text).ok_or_else(|| "write a name alone, such as trees.example".to_owned())
}

/// A network, or an address as a network of its own.
fn parse_proxies(text: &str) -> Result<IpNet, String> {
    let address = || text.parse::<IpAddr>().map(IpNet::from);
    text.parse()
        .or_else(|_| address())
        .map_err(|_| "allowed: an address, or a network as in 10.0.0.0/8".to_owned())
}
