//! Who may ask: pages of this server in the browser that was given its address, nobody else.
//!
//! Another program on the machine lacks the token; another page in the same browser has a different origin, and the browser sends neither the
//! cookie nor the origin wanted here with its requests; a name that an attacker's server makes point to the loopback address is no host that is
//! known here.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, COOKIE, HOST, HeaderName, LOCATION, ORIGIN, REFERRER_POLICY, SET_COOKIE,
    X_CONTENT_TYPE_OPTIONS, X_FRAME_OPTIONS,
};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::answer::Refused;
use crate::commands::Failure;

/// The secret of this server, and the names that it goes by.
pub struct Guard {
    port: u16,
    token: String,
}

impl Guard {
    /// With a token of 256 random bits.
    pub fn new(port: u16) -> Result<Self, Failure> {
        let mut bytes = [0; 32];
        getrandom::fill(&mut bytes).map_err(|error| format!("the system gives no random numbers: {error}"))?;
        Ok(Self { port, token: bytes.iter().map(|byte| format!("{byte:02x}")).collect() })
    }

    /// What is opened in a browser.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.port, self.token)
    }

    /// Cookies are shared by all ports of an address.
    fn cookie(&self) -> String {
        format!("barrier_check_{}", self.port)
    }

    fn is_known(&self, host: &str) -> bool {
        ["127.0.0.1", "localhost"].iter().any(|name| host == format!("{name}:{}", self.port))
    }

    /// Whether it is this server's token, found out in a time that does not tell how much of it is right.
    fn is_the_token(&self, found: &str) -> bool {
        let differing = self.token.bytes().zip(found.bytes()).fold(0, |differing, (a, b)| differing | (a ^ b));
        found.len() == self.token.len() && differing == 0
    }

    fn has_the_cookie(&self, headers: &HeaderMap) -> bool {
        let name = self.cookie();
        let cookies = headers.get_all(COOKIE).iter().filter_map(|value| value.to_str().ok());
        let mut pairs = cookies.flat_map(|cookies| cookies.split(';')).filter_map(|pair| pair.trim().split_once('='));
        pairs.any(|(key, value)| key == name && self.is_the_token(value))
    }
}

/// The one value of a header, as text.
fn one<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    let mut values = headers.get_all(name).iter();
    values.next().filter(|_| values.next().is_none())?.to_str().ok()
}

/// Lets a request through if it comes from a page of this server; the first comes with the token, and is given a cookie for those after it.
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
    let token = request.uri().query().unwrap_or_default().split('&').find_map(|pair| pair.strip_prefix("token="));
    if reads && request.uri().path() == "/" && token.is_some_and(|token| guard.is_the_token(token)) {
        // The token does not stay in the address, where it could be seen over a shoulder.
        let cookie = format!("{}={}; HttpOnly; SameSite=Strict; Path=/", guard.cookie(), guard.token);
        return (StatusCode::SEE_OTHER, [(LOCATION, "/".to_string()), (SET_COOKIE, cookie)]).into_response();
    }
    if !guard.has_the_cookie(headers) {
        return forbidden("open the address that barrier-check printed when it was started, with its token");
    }
    next.run(request).await
}

/// What a page of this server may do: nothing from elsewhere, in no frame of another page, kept nowhere.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; font-src 'self'; connect-src 'self'; frame-src 'self'; frame-ancestors 'self'; base-uri 'none'; form-action 'none'";
/// What a report may do, whose program and looks stand in it: nothing but show itself.
pub const REPORT_POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'self'; base-uri 'none'; form-action 'none'";

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
