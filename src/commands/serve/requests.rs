//! What the page asks for, one function each.

use std::sync::Arc;

use axum::Json;
use axum::extract::rejection::JsonRejection;
use axum::extract::{Path, Query, State};
use axum::http::HeaderValue;
use axum::http::header::{CONTENT_SECURITY_POLICY, CONTENT_TYPE};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use tokio::task::spawn_blocking;

use super::answer::Refused;
use super::design_folder::Written;
use super::guard::REPORT_POLICY;
use super::preview::{Look, look as look_at};
use super::runs::How;
use super::state::Served;
use crate::commands::check::MOST_STARTS;
use crate::commands::schema::SchemaOf;
use crate::explain;
use crate::new_design::{Beside, QUESTIONS, text as text_of};
use crate::program::PROGRAM;

type Shared = State<Arc<Served>>;
type Body<T> = Result<Json<T>, JsonRejection>;

/// Takes work that reads files or computes off the threads that answer.
async fn apart<T: Send + 'static>(
    served: Arc<Served>,
    work: impl FnOnce(&Served) -> Result<T, Refused> + Send + 'static,
) -> Result<T, Refused> {
    spawn_blocking(move || work(&served)).await.map_err(Refused::failed)?
}

/// What was sent, where it is what is wanted.
fn sent<T>(body: Body<T>) -> Result<T, Refused> {
    body.map(|Json(sent)| sent).map_err(|error| Refused::new(error.status(), error.body_text()))
}

/// All that the page needs to begin: the designs, the keys they have, and what is told of each.
pub async fn start(State(served): Shared) -> Result<Json<Value>, Refused> {
    apart(served, |served| {
        let questions: Vec<Value> = QUESTIONS
            .iter()
            .map(|question| json!({ "name": question.name, "ask": question.ask, "usual": question.usual }))
            .collect();
        let explained: Vec<Value> = explain::all()
            .into_iter()
            .map(|entry| json!({ "id": entry.id, "meaning": entry.meaning, "formula": entry.formula, "source": entry.source }))
            .collect();
        Ok(Json(json!({
            "program": PROGRAM,
            "folder": served.chosen.root().display().to_string(),
            "designs": served.chosen.designs(),
            "questions": questions,
            "schema": SchemaOf::Design.schema(),
            "explained": explained,
        })))
    })
    .await
}

#[derive(Deserialize)]
pub struct Named {
    path: String,
}

pub async fn read(State(served): Shared, Query(named): Query<Named>) -> Result<Json<Written>, Refused> {
    apart(served, move |served| served.chosen.read(&named.path).map(Json)).await
}

#[derive(Deserialize)]
pub struct ToWrite {
    path: String,
    text: String,
    before: Option<String>,
}

/// What became of a text that was to be written. What stands in the way is something to choose from, no error.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Wrote {
    Written(Written),
    Conflict(String),
    /// What is wrong with the answers.
    Wrong(String),
}

impl Wrote {
    fn of(written: Result<Written, Refused>) -> Result<Json<Self>, Refused> {
        match written {
            Ok(written) => Ok(Json(Self::Written(written))),
            Err(refused) if refused.is_conflict() => Ok(Json(Self::Conflict(refused.why().to_string()))),
            Err(refused) => Err(refused),
        }
    }
}

pub async fn write(State(served): Shared, body: Body<ToWrite>) -> Result<Json<Wrote>, Refused> {
    let ToWrite { path, text, before } = sent(body)?;
    apart(served, move |served| Wrote::of(served.chosen.write(&path, &text, before.as_deref()))).await
}

#[derive(Deserialize)]
pub struct Answers {
    path: String,
    answers: Vec<String>,
}

/// Writes a new design from ten answers.
pub async fn new(State(served): Shared, body: Body<Answers>) -> Result<Json<Wrote>, Refused> {
    let Answers { path, answers } = sent(body)?;
    let answers: [String; 10] = answers.try_into().map_err(|_| Refused::bad("ten answers are wanted"))?;
    let wrong: Vec<String> = QUESTIONS
        .iter()
        .zip(&answers)
        .filter_map(|(question, answer)| {
            let [found, allowed] = question.wrong(answer)?;
            Some(format!("{}: found {found}, allowed is {allowed}", question.ask))
        })
        .collect();
    if !wrong.is_empty() {
        return Ok(Json(Wrote::Wrong(wrong.join("\n"))));
    }
    apart(served, move |served| {
        let beside = Beside { file: &path, density: "1800 kg/m3", factors: "en_1997", kit: None };
        let text = text_of(&answers, beside).map_err(Refused::failed)?;
        match served.chosen.design(&path, &text) {
            // The name of the file is an answer as well.
            Err(refused) if refused.is_bad_request() => Ok(Json(Wrote::Wrong(refused.why().to_string()))),
            Err(refused) => Err(refused),
            Ok(Err(problems)) => {
                Ok(Json(Wrote::Wrong(format!("these answers make no design: {}", problems.to_string().trim_end()))))
            }
            Ok(Ok(_)) => Wrote::of(served.chosen.write(&path, &text, None)),
        }
    })
    .await
}

#[derive(Deserialize)]
pub struct ToLookAt {
    path: String,
    text: String,
}

pub async fn look(State(served): Shared, body: Body<ToLookAt>) -> Result<Json<Look>, Refused> {
    let ToLookAt { path, text } = sent(body)?;
    apart(served, move |served| look_at(&served.chosen, &path, &text).map(Json)).await
}

pub async fn runs(State(served): Shared) -> Result<Json<Value>, Refused> {
    apart(served, |served| Ok(Json(json!({ "runs": served.runs.list() })))).await
}

#[derive(Deserialize)]
pub struct ToRun {
    path: String,
    #[serde(default = "one")]
    seeds: u32,
}

fn one() -> u32 {
    1
}

/// Begins to run a design as it stands on the disk.
pub async fn begin(State(served): Shared, body: Body<ToRun>) -> Result<Json<Value>, Refused> {
    let ToRun { path, seeds } = sent(body)?;
    if !(1..=MOST_STARTS).contains(&seeds) {
        return Err(Refused::bad(format!("from 1 to {MOST_STARTS} packings")));
    }
    apart(served, move |served| {
        let written = served.chosen.read(&path)?;
        // The run would find the same, but also what lies outside the folder.
        if let Err(problems) = served.chosen.design(&path, &written.text)? {
            return Err(Refused::bad(problems.to_string().trim_end()));
        }
        Ok(Json(json!({ "folder": served.runs.begin(&path, &written.digest, How { seeds })? })))
    })
    .await
}

#[derive(Deserialize)]
pub struct After {
    #[serde(default)]
    after: usize,
}

pub async fn progress(
    State(served): Shared,
    Path(folder): Path<String>,
    Query(After { after }): Query<After>,
) -> Result<Response, Refused> {
    apart(served, move |served| Ok(Json(served.runs.progress(&folder, after)?).into_response())).await
}

pub async fn stop(State(served): Shared, Path(folder): Path<String>) -> Result<Json<Value>, Refused> {
    apart(served, move |served| served.runs.stop(&folder).map(|()| Json(json!({})))).await
}

pub async fn resume(State(served): Shared, Path(folder): Path<String>) -> Result<Json<Value>, Refused> {
    apart(served, move |served| served.runs.resume(&folder).map(|()| Json(json!({})))).await
}

#[derive(Deserialize)]
pub struct ToCompare {
    folders: [String; 2],
}

pub async fn compare(State(served): Shared, body: Body<ToCompare>) -> Result<Json<Value>, Refused> {
    let ToCompare { folders } = sent(body)?;
    apart(served, move |served| Ok(Json(json!({ "page": served.runs.compare(&folders)? })))).await
}

/// A file of a report.
pub async fn report_file(
    State(served): Shared,
    // The token is looked at by the guard.
    Path((_, folder, file)): Path<(String, String, String)>,
) -> Result<Response, Refused> {
    let kind = kind_of(&file);
    let bytes = apart(served, move |served| served.runs.file(&folder, &file)).await?;
    Ok(([(CONTENT_TYPE, HeaderValue::from_static(kind)), (CONTENT_SECURITY_POLICY, REPORT_POLICY.clone())], bytes)
        .into_response())
}

/// What the browser takes a file for; it shows no other as a page.
fn kind_of(file: &str) -> &'static str {
    match file.rsplit_once('.').map_or("", |(_, ending)| ending) {
        "html" => "text/html; charset=utf-8",
        "svg" => "image/svg+xml",
        "json" => "application/json",
        "csv" => "text/csv; charset=utf-8",
        "md" | "yaml" => "text/plain; charset=utf-8",
        "xlsx" => "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
        "dxf" => "image/vnd.dxf",
        "pdf" => "application/pdf",
        _ => "application/octet-stream",
    }
}
