//! Tells the person at the terminal where the server is, and a tablet beside it by a QR code.

use std::{
    fmt::Write as _,
    net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket},
};

use qrcode::{EcLevel, QrCode, render::unicode::Dense1x2};

/// Where the text goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// A terminal, which can show colours.
    Terminal,
    /// A file or a pipe.
    Plain,
}

/// What is printed once the server listens. The first line is for programs too.
pub fn text(bound: SocketAddr, medium: Medium) -> String {
    let here = if bound.ip().is_unspecified() { IpAddr::V4(Ipv4Addr::LOCALHOST) } else { bound.ip() };
    let mut text = format!("Espalier is listening on {}\n", url(here, bound.port()));
    let addresses = if bound.ip().is_unspecified() { lan_addresses() } else { Vec::new() };
    if let Some(&first) = addresses.first() {
        let urls: Vec<String> = addresses.iter().map(|&address| url(address, bound.port())).collect();
        let _ = write!(text, "On a tablet in the same network, open {}", urls.join(" or "));
        match qr_code(&url(first, bound.port()), medium) {
            Some(code) => {
                let _ = write!(text, " or scan:\n\n{code}\n");
            }
            None => text.push('\n'),
        }
    }
    text.push_str("Ctrl+C stops the server.");
    text
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
        let first =
            |address: &str| text(address.parse().unwrap(), Medium::Plain).lines().next().unwrap().to_owned();
        assert_eq!(first("0.0.0.0:7700"), "Espalier is listening on http://127.0.0.1:7700");
        assert_eq!(first("127.0.0.1:80"), "Espalier is listening on http://127.0.0.1:80");
        assert_eq!(first("[::1]:7700"), "Espalier is listening on http://[::1]:7700");
    }

    #[test]
    fn a_server_for_this_machine_shows_no_code() {
        assert!(!text("127.0.0.1:7700".parse().unwrap(), Medium::Terminal).contains("scan"));
    }

    #[test]
    fn lines_of_the_code_are_equally_wide() {
        let code = qr_code("http://192.168.178.23:7700", Medium::Plain).unwrap();
        let widths: Vec<usize> = code.lines().map(|line| line.chars().count()).collect();
        assert!(widths.len() > 10 && widths.iter().all(|&width| width == widths[0]), "{widths:?}");
    }
}
