//! Tells the person at the terminal where the server is, and a tablet beside it by a QR code.

use std::{
    fmt::Write as _,
    net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket},
    time::Duration,
};

use qrcode::{EcLevel, QrCode, render::unicode::Dense1x2};

use crate::access::{Secret, admission::INVITATION_LIFE};

/// Where the text goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// A terminal, which can show colours.
    Terminal,
    /// A file or a pipe.
    Plain,
}

/// Who is let in.
#[derive(Clone)]
pub enum OpenTo {
    /// Those at this machine.
    Machine,
    /// Others as well, who are invited: the secret of an invitation.
    Invited(Secret),
    /// Those who log in, if there is anybody who can.
    Users {
        /// Whether there is.
        any: bool,
    },
}

/// What is printed once the server listens. The first line is for programs too.
pub fn text(bound: SocketAddr, open_to: &OpenTo, medium: Medium) -> String {
    let here = if bound.ip().is_unspecified() { IpAddr::V4(Ipv4Addr::LOCALHOST) } else { bound.ip() };
    let mut text = format!("Espalier is listening on {}\n", url(here, bound.port()));
    match open_to {
        OpenTo::Invited(secret) => {
            text.push_str(&invitation(&addresses(bound), secret.text(), INVITATION_LIFE, medium));
            text.push_str("`espalier invite` prints another one.\n");
        }
        OpenTo::Machine => text.push_str(
            "It is there for this machine alone; --host 0.0.0.0 opens it to a tablet in the same network.\n",
        ),
        OpenTo::Users { any: true } => {
            text.push_str("It lets in whoever logs in; `espalier user add NAME` adds somebody.\n");
        }
        OpenTo::Users { any: false } => text.push_str(
            "Nobody can log in yet: `espalier user add --admin NAME` adds the first, while this server runs.\n",
        ),
    }
    text.push_str("Ctrl+C stops the server.");
    text
}

/// The links of an invitation that waits so long, and a QR code of the first one. `addresses` are those of the server.
pub fn invitation(addresses: &[String], secret: &str, waits: Duration, medium: Medium) -> String {
    let links: Vec<String> = addresses.iter().map(|address| format!("{address}/pair#{secret}")).collect();
    let waits = humantime::format_duration(waits);
    let mut text =
        format!("To let somebody in, on a tablet in the same network, say, open there within {waits}\n");
    for link in &links {
        let _ = writeln!(text, "  {link}");
    }
    match links.first().and_then(|link| qr_code(link, medium)) {
        Some(code) => {
            let _ = write!(text, "or scan:\n\n{code}\n");
        }
        None => text.push('\n'),
    }
    text
}

/// Where others reach a server that listens there.
pub fn addresses(bound: SocketAddr) -> Vec<String> {
    let addresses = if bound.ip().is_unspecified() { lan_addresses() } else { vec![bound.ip()] };
    addresses.into_iter().map(|address| url(address, bound.port())).collect()
}

fn url(address: IpAddr, port: u16) -> String {
    format!("http://{}", SocketAddr::new(address, port))
}

/// The addresses other machines may reach, the one that leads out of here first.
fn lan_addresses() -> Vec<IpAddr> {
    let mut addresses: Vec<IpAddr> = if_addrs::get_if_addrs()
        .unwrap_or_default()
        .into_iter()
        .map(|interface| interface.ip())
        .filter(|address| matches!(address, IpAddr::V4(v4) if !v4.is_loopback() && !v4.is_link_local()))
        .collect();
    addresses.sort();
    addresses.dedup();
    if let Some(routed) = routed_address() {
        addresses.retain(|&address| address != routed);
        addresses.insert(0, routed);
    }
    addresses
}

/// Connecting a UDP socket sends nothing, but lets the system choose the interface (the address is for documentation).
fn routed_address() -> Option<IpAddr> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
    socket.connect((Ipv4Addr::new(192, 0, 2, 1), 9)).ok()?;
    socket.local_addr().ok().map(|address| address.ip()).filter(|address| !address.is_loopback())
}

fn qr_code(url: &str, medium: Medium) -> Option<String> {
    let code = QrCode::with_error_correction_level(url, EcLevel::L).ok()?;
    let code = code.render::<Dense1x2>().dark_color(Dense1x2::Dark).light_color(Dense1x2::Light).build();
    // Scanners expect dark on light, whatever the terminal's colours are.
    let (before, after) = match medium {
        Medium::Terminal => ("\x1b[30;107m", "\x1b[0m\n"),
        Medium::Plain => ("", "\n"),
    };
    Some(code.lines().fold(String::new(), |text, line| text + before + line + after))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_is_where_to_connect() {
        let first = |address: &str| {
            text(address.parse().unwrap(), &OpenTo::Machine, Medium::Plain).lines().next().unwrap().to_owned()
        };
        assert_eq!(first("0.0.0.0:7700"), "Espalier is listening on http://127.0.0.1:7700");
        assert_eq!(first("127.0.0.1:80"), "Espalier is listening on http://127.0.0.1:80");
        assert_eq!(first("[::1]:7700"), "Espalier is listening on http://[::1]:7700");
    }

    #[test]
    fn a_server_for_this_machine_shows_no_code() {
        let text = text("127.0.0.1:7700".parse().unwrap(), &OpenTo::Machine, Medium::Terminal);
        assert!(!text.contains("scan") && text.contains("--host 0.0.0.0"), "{text}");
    }

    #[test]
    fn ac9_a_server_without_users_says_how_to_add_one() {
        let text = |any| text("127.0.0.1:7700".parse().unwrap(), &OpenTo::Users { any }, Medium::Plain);
        assert!(text(false).contains("`espalier user add --admin NAME`"), "{}", text(false));
        assert!(!text(true).contains("--admin") && !text(true).contains("/pair#"), "{}", text(true));
    }

    #[test]
    fn ac3_the_secret_stands_behind_the_hash_of_a_link() {
        let secret = Secret::short();
        let link = format!("  http://192.168.1.7:7700/pair#{}\n", secret.text());
        let text = text("192.168.1.7:7700".parse().unwrap(), &OpenTo::Invited(secret), Medium::Plain);
        assert!(text.contains(&link), "{text}");
        assert!(text.contains("scan") && text.contains('█'), "{text}");
    }

    #[test]
    fn lines_of_the_code_are_equally_wide() {
        let code = qr_code("http://192.168.178.23:7700", Medium::Plain).unwrap();
        let widths: Vec<usize> = code.lines().map(|line| line.chars().count()).collect();
        assert!(widths.len() > 10 && widths.iter().all(|&width| width == widths[0]), "{widths:?}");
    }
}
