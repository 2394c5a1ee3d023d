//! What a proxy says of the request that it passes on (`AC14`).

use std::{
    net::{IpAddr, SocketAddr},
    sync::Arc,
};

use axum::{
    extract::{Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, header},
    middleware::Next,
    response::Response,
};
use ipnet::IpNet;

use crate::access::Peer;

const FOR: HeaderName = HeaderName::from_static("x-forwarded-for");
const HOST: HeaderName = HeaderName::from_static("x-forwarded-host");
const PROTO: HeaderName = HeaderName::from_static("x-forwarded-proto");

/// The proxies that are believed.
#[derive(Clone, Debug, Default)]
pub struct Proxies(Arc<[IpNet]>);

impl Proxies {
    /// Those in these networks.
    pub fn new(networks: &[IpNet]) -> Self {
        Self(networks.into())
    }

    /// Where they are.
    pub fn networks(&self) -> Vec<IpNet> {
        self.0.to_vec()
    }

    fn has(&self, address: IpAddr) -> bool {
        let address = address.to_canonical();
        self.0.iter().any(|network| network.contains(&address))
    }

    /// Where a request comes from that a proxy passes on: the last address in its header that is no proxy's, and how many
    /// proxies have added one behind it. Those before it may be made up.
    fn origin(&self, headers: &HeaderMap, proxy: IpAddr) -> (IpAddr, usize) {
        let mut origin = (proxy, 0);
        for (behind, hop) in hops(headers, &FOR).into_iter().rev().enumerate() {
            let Some(hop) = address(hop) else { break };
            origin = (hop, behind);
            if !self.has(hop) {
                break;
            }
        }
        origin
    }
}

/// What each proxy has added to a header, the first first.
fn hops<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Vec<&'a str> {
    let values = headers.get_all(name).iter().filter_map(|value| value.to_str().ok());
    values.flat_map(|value| value.split(',')).map(str::trim).collect()
}

/// What the proxy has added that the client asked, where so many stand behind it; a proxy that sets a header anew instead
/// speaks for those before it.
fn said(headers: &HeaderMap, name: &HeaderName, behind: usize) -> Option<HeaderValue> {
    let hops = hops(headers, name);
    let said = hops.get(hops.len().saturating_sub(behind + 1))?;
    HeaderValue::from_str(said).ok()
}

/// An address, with a port or without.
fn address(text: &str) -> Option<IpAddr> {
    text.parse().ok().or_else(|| text.parse::<SocketAddr>().ok().map(|address| address.ip()))
}

/// Has a request be as its proxy got it. What anybody else says is taken away, but for that somebody said it.
pub(super) async fn believe(State(proxies): State<Proxies>, mut request: Request, next: Next) -> Response {
    let proxy = request.extensions().get::<Peer>().map(|Peer(address)| *address);
    if let Some(proxy) = proxy.filter(|&peer| proxies.has(peer)) {
        let (origin, behind) = proxies.origin(request.headers(), proxy);
        request.extensions_mut().insert(Peer(origin));
        for (said_in, name) in [(HOST, header::HOST), (PROTO, PROTO)] {
            if let Some(value) = said(request.headers(), &said_in, behind) {
                request.headers_mut().insert(name, value);
            }
        }
    } else {
        let headers = request.headers_mut();
        let said = [HOST, PROTO].map(|name| headers.remove(name).is_some());
        if said.contains(&true) {
            // A request that was passed on never comes from whoever sits at the machine (`AC1`).
            headers.entry(FOR).or_insert(HeaderValue::from_static("unknown"));
        }
    }
    next.run(request).await
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ac14_the_last_address_that_is_no_proxys_counts() {
        let proxies =
            Proxies::new(&["10.0.0.0/30", "2001:db8:1::/48"].map(|network| network.parse().unwrap()));
        let own = "10.0.0.1".parse().unwrap();
        for (values, expected) in [
            (&["203.0.113.5"][..], "203.0.113.5"),
            (&["198.51.100.1, 203.0.113.5"], "203.0.113.5"),
            (&["198.51.100.1", "203.0.113.5, 10.0.0.2"], "203.0.113.5"),
            (&["203.0.113.5, 2001:db8:1::7"], "203.0.113.5"),
            (&["203.0.113.5:4711"], "203.0.113.5"),
            (&["[2001:db8::1]:4711"], "2001:db8::1"),
            (&["203.0.113.5, unknown"], "10.0.0.1"),
            (&["10.0.0.2"], "10.0.0.2"),
            (&[], "10.0.0.1"),
        ] {
            let headers = values.iter().map(|value| (FOR, HeaderValue::from_static(value)));
            let headers = headers.fold(HeaderMap::new(), |mut all, (name, value)| {
                all.append(name, value);
                all
            });
            assert_eq!(proxies.origin(&headers, own).0, expected.parse::<IpAddr>().unwrap(), "{values:?}");
        }
    }

    #[test]
    fn ac14_what_else_a_proxy_says_is_read_at_the_hop_of_the_client() {
        let proxies = Proxies::new(&["10.0.0.0/30"].map(|network| network.parse().unwrap()));
        let own = "10.0.0.1".parse().unwrap();
        for (from, protocols, expected) in [
            ("203.0.113.5", "https", "https"),
            ("203.0.113.5, 10.0.0.2", "https, http", "https"),
            ("203.0.113.5, 10.0.0.2", "http, https", "http"),
            // What the client has made up stands in front.
            ("198.51.100.1, 203.0.113.5, 10.0.0.2", "https, http, https", "http"),
            ("203.0.113.5, 10.0.0.2", "https", "https"),
            ("203.0.113.5", "https, http", "http"),
        ] {
            let headers = [(FOR, from), (PROTO, protocols)]
                .map(|(name, value)| (name, HeaderValue::from_static(value)));
            let headers = HeaderMap::from_iter(headers);
            let (_, behind) = proxies.origin(&headers, own);
            assert_eq!(said(&headers, &PROTO, behind).unwrap(), expected, "{from}: {protocols}");
        }
    }
}
