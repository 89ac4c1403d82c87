//! One page, served on the loopback address to a browser that waits for it and to nobody else.

use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Receiver;
use std::time::Duration;

use crate::commands::random_name::random_name;

/// Longest that somebody may take to say what is wanted, and longest request (bytes).
const PATIENCE: Duration = Duration::from_secs(5);
const LONGEST_REQUEST: u64 = 16 * 1024;

pub struct OnePage {
    listener: TcpListener,
    pub address: Address,
}

/// Where the page is, for who knows its name.
#[derive(Clone)]
pub struct Address {
    socket: SocketAddr,
    /// Path of the page, which nobody can guess.
    path: String,
    done: Arc<AtomicBool>,
}

impl OnePage {
    pub fn listen() -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        let address = Address {
            socket: listener.local_addr()?,
            path: format!("/{}", random_name::<16>()?),
            done: Arc::default(),
        };
        Ok(Self { listener, address })
    }

    /// Waits for the page, then answers with it whoever asks for it by its name, until that is no longer wanted.
    pub fn serve(self, page: &Receiver<String>) {
        let Ok(html) = page.recv() else { return };
        for stream in self.listener.incoming() {
            if self.address.done.load(Ordering::Acquire) {
                return;
            }
            // Who asks badly, or goes, is no concern of the one who waits for the page.
            let _ = stream.and_then(|stream| self.address.answer(stream, &html));
        }
    }
}

impl Address {
    pub fn url(&self) -> String {
        format!("http://{}{}", self.socket, self.path)
    }

    /// Says that nobody wants the page any more.
    pub fn done(&self) {
        self.done.store(true, Ordering::Release);
        // Wakes who waits for the next to ask.
        drop(TcpStream::connect(self.socket));
    }

    fn answer(&self, mut stream: TcpStream, html: &str) -> io::Result<()> {
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        let mut request = Vec::new();
        let mut incoming = (&stream).take(LONGEST_REQUEST);
        let mut part = [0; 1024];
        while !request.windows(4).any(|end| end == b"\r\n\r\n") {
            match incoming.read(&mut part)? {
                0 => return Ok(()),
                length => request.extend_from_slice(&part[..length]),
            }
        }
        let (status, body) = match request.starts_with(format!("GET {} HTTP/1.", self.path).as_bytes()) {
            true => ("200 OK", html),
            false => ("404 Not Found", ""),
        };
        write!(
            stream,
            "HTTP/1.1 {status}\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n{body}",
            body.len()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    fn ask(address: &Address, path: &str) -> String {
        let mut stream = TcpStream::connect(address.socket).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: x\r\n\r\n").unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        answer
    }

    #[test]
    fn the_page_goes_to_who_knows_its_name_alone() {
        let server = OnePage::listen().unwrap();
        let address = server.address.clone();
        let (hand, handed) = mpsc::channel();
        let serving = std::thread::spawn(move || server.serve(&handed));
        // Who comes before the page waits for it.
        let early = std::thread::spawn({
            let address = address.clone();
            move || ask(&address, &address.path)
        });
        hand.send("<p>µ</p>".to_string()).unwrap();
        let told = early.join().unwrap();
        assert!(told.starts_with("HTTP/1.1 200 OK") && told.ends_with("<p>µ</p>"), "{told}");
        for other in ["/", "/report.html", &address.path[..20]] {
            let told = ask(&address, other);
            assert!(told.starts_with("HTTP/1.1 404") && !told.contains('µ'), "{told}");
        }
        address.done();
        serving.join().unwrap();
    }

    #[test]
    fn a_page_that_never_comes_ends_the_waiting() {
        let server = OnePage::listen().unwrap();
        let (hand, handed) = mpsc::channel::<String>();
        drop(hand);
        server.serve(&handed);
    }
}
