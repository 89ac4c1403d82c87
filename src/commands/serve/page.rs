//! The page itself: made from `templates/serve` and carried by the program, so that nothing is fetched from anywhere.

use axum::extract::Path;
use axum::http::header::CONTENT_TYPE;
use axum::response::{Html, IntoResponse, Response};

use super::answer::Refused;
use crate::report::chart::PICTURE_STYLE;

const INDEX: &str = include_str!("../../../templates/serve/index.html");
const STYLE: &str = include_str!("../../../templates/serve/page.css");
/// Built from the sources beside it, whose README says how.
const SCRIPT: &str = include_str!("../../../templates/serve/bundle.js");

pub async fn index() -> Html<&'static str> {
    Html(INDEX)
}

pub async fn asset(Path(name): Path<String>) -> Response {
    let of_kind = |kind: &'static str, text: String| ([(CONTENT_TYPE, kind)], text).into_response();
    match name.as_str() {
        "page.css" => of_kind("text/css; charset=utf-8", format!("{STYLE}\n{PICTURE_STYLE}")),
        "bundle.js" => of_kind("text/javascript; charset=utf-8", SCRIPT.to_string()),
        _ => Refused::missing("this part of the page").into_response(),
    }
}
