//! Who may ask: pages of this server in the browser that was given its address, nobody else.
//!
//! Another program on the machine, and another page in the same browser, lack the token: it comes to the page behind the `#` of its address, which no
//! browser sends, and stays in what the browser keeps for this host and port alone; cookies would go to every port of the address. A name that an
//! attacker's server makes point to the loopback address is no host that is known here.

use std::sync::{Arc, LazyLock};

use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, HOST, HeaderName, ORIGIN, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
    X_FRAME_OPTIONS,
};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::Digest;

use super::answer::Refused;
use crate::commands::Failure;
use crate::commands::random_name::random_name;
use crate::report::pictures::REPLAY_SCRIPT;

/// The secret of this server, and the names that it goes by.
pub struct Guard {
    port: u16,
    token: String,
}

impl Guard {
    /// With a token of 256 random bits.
    pub fn new(port: u16) -> Result<Self, Failure> {
        Ok(Self { port, token: random_name::<32>()? })
    }

    /// What is opened in a browser.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/#token={}", self.port, self.token)
    }

    fn is_known(&self, host: &str) -> bool {
        ["127.0.0.1", "localhost"].iter().any(|name| host == format!("{name}:{}", self.port))
    }

    /// Whether it is this server's token, found out in a time that does not tell how much of it is right.
    fn is_the_token(&self, found: &str) -> bool {
        let differing = self.token.bytes().zip(found.bytes()).fold(0, |differing, (a, b)| differing | (a ^ b));
        found.len() == self.token.len() && differing == 0
    }

    /// Whether a request brings the token: one of the page in a header, one for a report, which a link leads to, in its address. The page itself holds
    /// nothing that is secret.
    fn admits(&self, headers: &HeaderMap, path: &str) -> bool {
        if path == "/" || path.starts_with("/page/") {
            return true;
        }
        match path.strip_prefix("/report/") {
            Some(rest) => self.is_the_token(rest.split('/').next().unwrap_or_default()),
            None => one(headers, &TOKEN).is_some_and(|found| self.is_the_token(found)),
        }
    }
}

/// The header in which the page brings the token.
const TOKEN: HeaderName = HeaderName::from_static("x-barrier-check-token");

/// The one value of a header, as text.
fn one<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    let mut values = headers.get_all(name).iter();
    values.next().filter(|_| values.next().is_none())?.to_str().ok()
}

/// Lets a request through if it comes from a page of this server that was given the token.
pub async fn admit(State(guard): State<Arc<Guard>>, request: Request, next: Next) -> Response {
    let headers = request.headers();
    let forbidden = |why: &str| Refused::new(StatusCode::FORBIDDEN, why).into_response();
    if !one(headers, &HOST).is_some_and(|host| guard.is_known(host)) {
        return Refused::new(StatusCode::MISDIRECTED_REQUEST, "this server goes by another name").into_response();
    }
    let origin = one(headers, &ORIGIN).and_then(|origin| origin.strip_prefix("http://"));
    if headers.contains_key(ORIGIN) && !origin.is_some_and(|origin| guard.is_known(origin)) {
        return forbidden("requests of other pages are not answered");
    }
    if headers.get("sec-fetch-site").is_some_and(|site| site != "same-origin" && site != "none") {
        return forbidden("requests of other pages are not answered");
    }
    let reads = request.method() == Method::GET || request.method() == Method::HEAD;
    if !reads && origin.is_none() {
        return forbidden("what changes something must come from the page of this server");
    }
    if !guard.admits(headers, request.uri().path()) {
        return forbidden("open the address that barrier-check printed when it was started, with its token");
    }
    next.run(request).await
}

/// What a page of this server may do: nothing from elsewhere, in no frame of another page, kept nowhere.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; font-src 'self'; connect-src 'self'; frame-src 'self'; frame-ancestors 'self'; base-uri 'none'; form-action 'none'";
/// What a report may do, whose looks stand in it: show itself. Of programs it may run the replay alone, known by its digest, so that a report which
/// somebody has forged runs none.
pub static REPORT_POLICY: LazyLock<HeaderValue> = LazyLock::new(|| {
    let digest = STANDARD.encode(sha2::Sha256::digest(REPLAY_SCRIPT.as_bytes()));
    let policy = format!(
        "default-src 'none'; script-src 'sha256-{digest}'; style-src 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'self'; base-uri 'none'; form-action 'none'"
    );
    HeaderValue::try_from(policy).unwrap_or(HeaderValue::from_static("default-src 'none'"))
});

/// Adds to every answer what keeps the browser from doing more with it than is meant.
pub async fn harden(request: Request, next: Next) -> Response {
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    headers.entry(CONTENT_SECURITY_POLICY).or_insert(HeaderValue::from_static(POLICY));
    let others = [
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (X_FRAME_OPTIONS, "SAMEORIGIN"),
        (REFERRER_POLICY, "no-referrer"),
        (CACHE_CONTROL, "no-store"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    ];
    for (name, value) in others {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}
