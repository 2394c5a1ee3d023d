//! A proxy that speaks TLS before a server, as a studio has one.

use std::{fs, path::Path, sync::Arc};

use rcgen::CertifiedKey;
use tokio::{
    io::copy_bidirectional,
    net::{TcpListener, TcpStream},
    task::AbortHandle,
};
use tokio_rustls::{
    TlsAcceptor,
    rustls::{
        ServerConfig,
        crypto::ring,
        pki_types::{PrivateKeyDer, PrivatePkcs8KeyDer},
    },
};

/// A proxy of `localhost`, until it is dropped.
#[derive(Debug)]
pub struct TlsProxy {
    port: u16,
    listening: AbortHandle,
}

impl TlsProxy {
    /// Passes on to a server on this machine; the certificate, which nobody has signed but itself, lies in a file.
    pub async fn before(server: u16, certificate: &Path) -> Self {
        let CertifiedKey { cert, signing_key } =
            rcgen::generate_simple_self_signed(["localhost".to_owned()]).expect("a certificate is made");
        fs::write(certificate, cert.pem()).expect("the file is written");
        let key = PrivateKeyDer::from(PrivatePkcs8KeyDer::from(signing_key.serialize_der()));
        let config = ServerConfig::builder_with_provider(Arc::new(ring::default_provider()))
            .with_safe_default_protocol_versions()
            .expect("the provider has them")
            .with_no_client_auth()
            .with_single_cert(vec![cert.der().clone()], key)
            .expect("the key is that of the certificate");
        let listener = TcpListener::bind(("localhost", 0)).await.expect("there is a port");
        let port = listener.local_addr().expect("it is bound").port();
        let listening = tokio::spawn(listen(listener, TlsAcceptor::from(Arc::new(config)), server));
        Self { port, listening: listening.abort_handle() }
    }

    /// Where it is.
    pub fn url(&self) -> String {
        format!("https://localhost:{}", self.port)
    }
}

impl Drop for TlsProxy {
    fn drop(&mut self) {
        self.listening.abort();
    }
}

async fn listen(listener: TcpListener, acceptor: TlsAcceptor, server: u16) {
    while let Ok((visitor, _)) = listener.accept().await {
        let acceptor = acceptor.clone();
        tokio::spawn(async move {
            // A visitor who does not trust the certificate goes away.
            let Ok(mut visitor) = acceptor.accept(visitor).await else { return };
            let Ok(mut behind) = TcpStream::connect(("127.0.0.1", server)).await else { return };
            // Either side may end it at any time.
            let _ = copy_bidirectional(&mut visitor, &mut behind).await;
        });
    }
}
