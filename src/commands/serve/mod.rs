//! `barrier-check serve`: a page on the loopback address to write designs, see them judged by the equations while they are typed, simulate them
//! and read their reports.

mod answer;
mod design_folder;
mod guard;
mod page;
mod preview;
mod requests;
mod runs;
mod state;

use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::extract::DefaultBodyLimit;
use axum::middleware::{from_fn, from_fn_with_state};
use axum::routing::{get, post};
use axum::{Router, serve as serve_router};

use crate::commands::input::LONGEST_TEXT;
use crate::commands::scratch::Scratch;
use crate::commands::signals::{listen, stop};
use crate::commands::{ExitCode, Failure};
use crate::terminal;

use self::design_folder::Chosen;
use self::guard::Guard;
use self::runs::Runs;
use self::state::Served;

/// How the page is served.
#[derive(Clone, Debug)]
pub struct Options {
    /// Where the designs are, and the reports go; nothing outside it is read or written.
    pub folder: PathBuf,
    /// The usual one, or one that is free, unless given.
    pub port: Option<u16>,
    /// Whether to open the page in the browser of the system.
    pub open: bool,
}

/// Where the page is, unless that port is taken or another is named.
const USUAL_PORT: u16 = 8732;

/// How long runs have to be kept when the program is asked to end.
const LAST_WAIT: Duration = Duration::from_secs(60);
/// How often it is looked whether the program is asked to end.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Serves the page until the program is asked to end.
pub fn serve(options: &Options) -> ExitCode {
    match run(options) {
        Ok(()) => ExitCode::Pass,
        Err(error) => {
            terminal::warn(format_args!("error: {error}"));
            ExitCode::Undecided
        }
    }
}

fn run(options: &Options) -> Result<(), Failure> {
    listen();
    let chosen = Chosen::open(&options.folder)
        .map_err(|error| format!("{}: the folder cannot be served: {error}", options.folder.display()))?;
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
    runtime.block_on(async {
        // No other address is ever listened on.
        let at = |port: u16| tokio::net::TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
        let listener = match options.port {
            // The same port each time keeps what a browser holds for the page; where it is taken, any other will do.
            None => match at(USUAL_PORT).await {
                Ok(listener) => listener,
                Err(_) => at(0).await?,
            },
            Some(port) => at(port)
                .await
                .map_err(|error| format!("port {port} cannot be used ({error}): name another with --port"))?,
        };
        let guard = Guard::new(listener.local_addr()?.port())?;
        let address = guard.address();
        terminal::say(format_args!(
            "barrier-check serves {} at\n  {address}\nto this machine and whoever has that address alone. Ctrl-C ends it; runs that go on are kept, to be resumed.",
            chosen.root().display()
        ));
        // By a file that its owner alone can read: what a program is started with, everybody on the machine can.
        let leads_there = if options.open { Scratch::new().ok() } else { None };
        if options.open && !leads_there.as_ref().is_some_and(|folder| opened(folder.path(), &address)) {
            terminal::warn("note: no browser could be opened: open the address above");
        }
        let runs = Runs::new(chosen.root());
        let state = Arc::new(Served { chosen, runs });
        let asked_to_end = async {
            while !stop().load(Ordering::Relaxed) {
                tokio::time::sleep(LOOK_EVERY).await;
            }
        };
        tokio::select! {
            state = serve_router(listener, router(Arc::clone(&state), guard)).into_future() => state?,
            () = asked_to_end => {}
        }
        state.runs.stop_all(LAST_WAIT);
        Ok(())
    })
}

/// Opens an address in the browser of the system; whether that could be asked for.
fn opened(folder: &Path, address: &str) -> bool {
    let page = folder.join("barrier-check.html");
    let leads =
        format!("<!doctype html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0; url={address}\">");
    std::fs::write(&page, leads).is_ok() && open::that_detached(&page).is_ok()
}

fn router(state: Arc<Served>, guard: Guard) -> Router {
    let router = Router::new()
        .route("/", get(page::index))
        .route("/page/{name}", get(page::asset))
        .route("/report/{token}/{folder}/{*file}", get(requests::report_file))
        .route("/api/start", get(requests::start))
        .route("/api/design", get(requests::read).put(requests::write))
        .route("/api/new", post(requests::new))
        .route("/api/look", post(requests::look))
        .route("/api/runs", get(requests::runs).post(requests::begin))
        .route("/api/runs/{folder}", get(requests::progress))
        .route("/api/runs/{folder}/stop", post(requests::stop))
        .route("/api/runs/{folder}/resume", post(requests::resume))
        .route("/api/compare", post(requests::compare))
        .fallback(answer::nothing_there);
    router
        .layer(DefaultBodyLimit::max(2 * LONGEST_TEXT as usize))
        .layer(from_fn_with_state(Arc::new(guard), guard::admit))
        .layer(from_fn(guard::harden))
        .with_state(state)
}
