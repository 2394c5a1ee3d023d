//! The cookie that a browser comes in by.

use std::time::Duration;

use axum::http::{HeaderMap, HeaderValue, header};

use super::{Secret, SecretHash, admission::DEVICE_LIFE, hash};
use crate::hosts;

/// Its name over plain http, where an address has no port; with one, that stands behind it.
pub const NAME: &str = "espalier";
/// What begins with this no other host, and nothing over plain http, can have set.
const SECURE: &str = "__Host-";

/// The secret in the cookie of a request.
pub fn of(headers: &HeaderMap) -> Option<SecretHash> {
    let pairs = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
    let pairs: Vec<_> =
        pairs.flat_map(|value| value.split(';')).filter_map(|pair| pair.trim().split_once('=')).collect();
    let of_name = |wanted: &str| pairs.iter().find(|(name, _)| *name == wanted).map(|(_, value)| hash(value));
    let name = name(headers);
    of_name(&format!("{SECURE}{name}")).or_else(|| of_name(&name))
}

/// What has a browser keep a secret. `headers` are those of its request, which tell whether it came by https.
pub fn keeping(secret: &Secret, headers: &HeaderMap) -> Option<HeaderValue> {
    set(secret.text(), DEVICE_LIFE, headers)
}

/// What has a browser forget its secret.
pub fn forgetting(headers: &HeaderMap) -> Option<HeaderValue> {
    set("", Duration::ZERO, headers)
}

/// Whether a request came by https to a proxy.
pub fn is_secure(headers: &HeaderMap) -> bool {
    headers.get("x-forwarded-proto").is_some_and(|protocol| protocol == "https")
}

fn set(text: &str, lasts: Duration, headers: &HeaderMap) -> Option<HeaderValue> {
    let (begins, more) = if is_secure(headers) { (SECURE, "; Secure") } else { ("", "") };
    let (name, lasts) = (name(headers), lasts.as_secs());
    let cookie = format!("{begins}{name}={text}; Path=/; HttpOnly; SameSite=Strict; Max-Age={lasts}{more}");
    HeaderValue::try_from(cookie).ok()
}

/// Browsers send a cookie to all ports of a host; under a name for each, two servers do not lose each other's.
fn name(headers: &HeaderMap) -> String {
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok());
    host.and_then(hosts::port).map_or_else(|| NAME.to_owned(), |port| format!("{NAME}-{port}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ac3_no_script_and_no_other_site_gets_at_the_cookie() {
        let secret = Secret::short();
        let plain = keeping(&secret, &HeaderMap::new()).unwrap();
        let plain = plain.to_str().unwrap();
        assert!(plain.starts_with(&format!("espalier={}; ", secret.text())), "{plain}");
        for part in ["HttpOnly", "SameSite=Strict", "Path=/", "Max-Age=15552000"] {
            assert!(plain.contains(part), "{plain}");
        }
        let by_https = HeaderMap::from_iter([(
            header::HeaderName::from_static("x-forwarded-proto"),
            HeaderValue::from_static("https"),
        )]);
        let secure = keeping(&secret, &by_https).unwrap();
        let secure = secure.to_str().unwrap();
        assert!(secure.starts_with("__Host-espalier=") && secure.ends_with("; Secure"), "{secure}");
    }

    #[test]
    fn the_secret_is_found_among_other_cookies() {
        for (sent, found) in [
            ("espalier=a", Some("a")),
            ("theme=dark; espalier=b ; x=y", Some("b")),
            ("espalier=c; __Host-espalier=d", Some("d")),
            ("xespalier=e", None),
            ("espalier", None),
        ] {
            let headers = HeaderMap::from_iter([(header::COOKIE, HeaderValue::from_static(sent))]);
            assert_eq!(of(&headers), found.map(hash), "{sent}");
        }
    }

    #[test]
    fn ac3_servers_on_two_ports_of_a_host_have_a_cookie_each() {
        let at = |host: &'static str, cookie: &str| {
            let cookie = HeaderValue::try_from(cookie).unwrap();
            HeaderMap::from_iter([(header::HOST, HeaderValue::from_static(host)), (header::COOKIE, cookie)])
        };
        let (first, second) = (Secret::short(), Secret::short());
        let kept = |host, secret: &Secret| {
            let kept = keeping(secret, &at(host, "")).unwrap();
            kept.to_str().unwrap().split(';').next().unwrap().to_owned()
        };
        let (one, other) = ("192.168.1.7:7700", "192.168.1.7:7701");
        let both = format!("{}; {}", kept(one, &first), kept(other, &second));
        assert_eq!(of(&at(one, &both)), Some(first.hash()));
        assert_eq!(of(&at(other, &both)), Some(second.hash()));
        assert_eq!(of(&at("192.168.1.7", &both)), None);
        assert_eq!(of(&at("[::1]:7700", &both)), Some(first.hash()));
    }
}
