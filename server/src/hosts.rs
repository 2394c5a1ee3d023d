//! The names that this server goes by.

use std::{collections::BTreeSet, net::IpAddr, sync::Arc};

use axum::http::uri::Authority;
use gethostname::gethostname;

/// The names under which requests may come.
#[derive(Clone, Debug)]
pub struct Hosts(Arc<BTreeSet<HostName>>);

/// The name of a machine, in small letters.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HostName(String);

impl HostName {
    /// Labels of letters, digits, `-` and `_` with dots between them; nothing else is a name.
    pub fn parse(text: &str) -> Option<Self> {
        let name = text.strip_suffix('.').unwrap_or(text).to_ascii_lowercase();
        let is_label = |label: &str| {
            let allowed = |byte: u8| byte.is_ascii_alphanumeric() || b"-_".contains(&byte);
            (1..=63).contains(&label.len()) && label.bytes().all(allowed)
        };
        (name.len() <= 253 && name.split('.').all(is_label)).then_some(Self(name))
    }
}

impl Hosts {
    /// The names of this machine, and more.
    pub fn new(more: &[HostName]) -> Self {
        let name = gethostname().to_string_lossy().into_owned();
        let short = name.split('.').next().unwrap_or_default();
        let own = [name.clone(), short.to_owned(), format!("{short}.local")];
        Self(Arc::new(
            own.iter().filter_map(|name| HostName::parse(name)).chain(more.iter().cloned()).collect(),
        ))
    }

    /// Whether a `Host` leads here (`GU1`). Any address does: no other site's page can be made to carry an address
    /// that is not its own, and behind a container or a router the server does not know all of its addresses.
    pub fn have(&self, host: &str) -> bool {
        match Host::parse(host) {
            None => false,
            Some(Host::Address(_)) => true,
            Some(Host::Name(name)) => is_localhost(&name) || self.0.contains(&name),
        }
    }
}

/// Whether a `Host` means the machine that asks, whatever it is called elsewhere.
pub fn is_loopback(host: &str) -> bool {
    match Host::parse(host) {
        None => false,
        Some(Host::Address(address)) => address.is_loopback(),
        Some(Host::Name(name)) => is_localhost(&name),
    }
}

/// The port in a `Host`, where it has one.
pub fn port(host: &str) -> Option<u16> {
    host.parse::<Authority>().ok()?.port_u16()
}

/// What a `Host` header names, without its port.
enum Host {
    Address(IpAddr),
    Name(HostName),
}

impl Host {
    fn parse(text: &str) -> Option<Self> {
        let authority: Authority = text.parse().ok().filter(|_| !text.contains('@'))?;
        let host = authority.host();
        let inner = host.strip_prefix('[').and_then(|host| host.strip_suffix(']')).unwrap_or(host);
        inner.parse().map(Self::Address).ok().or_else(|| HostName::parse(host).map(Self::Name))
    }
}

/// Browsers look up neither of these anywhere: they are always this machine.
fn is_localhost(name: &HostName) -> bool {
    name.0 == "localhost" || name.0.ends_with(".localhost")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gu1_addresses_and_own_names_lead_here() {
        let hosts = Hosts::new(&[HostName::parse("Trees.Example").unwrap()]);
        for host in [
            "127.0.0.1:7700",
            "192.168.1.7",
            "[::1]:7700",
            "[fe80::1]",
            "localhost",
            "LOCALHOST:7700",
            "oak.localhost:80",
            "localhost.:7700",
            "trees.example",
            "TREES.example:443",
        ] {
            assert!(hosts.have(host), "{host}");
        }
        for host in [
            "",
            ":7700",
            "evil.example",
            "trees.example.evil",
            "nottrees.example",
            "localhost.evil",
            "notlocalhost",
            "evil.example@localhost",
            "localhost/evil",
            "127.0.0.1.evil.example",
            "a b",
        ] {
            assert!(!hosts.have(host), "{host}");
        }
    }

    #[test]
    fn gu1_this_machine_is_known_by_its_name() {
        let name = gethostname().to_string_lossy().into_owned();
        let short = name.split('.').next().unwrap();
        let hosts = Hosts::new(&[]);
        for host in [name.clone(), format!("{short}.local:7700"), name.to_uppercase()] {
            assert!(hosts.have(&host), "{host}");
        }
    }

    #[test]
    fn what_is_no_name_is_not_taken_for_one() {
        for text in ["", ".", "a..b", "http://trees.example", "trees.example:443", "a b", &"a".repeat(64)] {
            assert_eq!(HostName::parse(text), None, "{text}");
        }
    }
}
