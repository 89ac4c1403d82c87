//! `--pdf`: the report as a browser of the Chromium family prints it. A library that sets pages would be several times as large as the program, and
//! a second form of every page to keep.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use std::{fs, io, thread};

use crate::commands::one_page::{Address, OnePage};
use crate::commands::scratch::Scratch;

/// Name of the file.
pub const FILE: &str = "report.pdf";

/// What such browsers are called, and where they are when they are not on the path.
const NAMES: [&str; 8] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "msedge",
    "microsoft-edge",
    "microsoft-edge-stable",
];
const PLACES: [&str; 6] = [
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
    r"C:\Program Files\Microsoft\Edge\Application\msedge.exe",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
];
/// Names the browser, before all of these.
const VARIABLE: &str = "CHROMIUM";

/// Longest that a browser may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// Why there is no PDF.
#[derive(Debug, thiserror::Error)]
pub enum PrintError {
    #[error(
        "--pdf needs a browser of the Chromium family (Chromium, Chrome or Edge), and none was found: install one, name its program in the environment variable {VARIABLE}, or leave out --pdf and print report.html from any browser"
    )]
    NoBrowser,
    #[error("the browser {0} did not print the report: {1}")]
    Browser(String, String),
    #[error("the report could not be handed to the browser: {0}")]
    File(#[from] io::Error),
}

/// A browser that prints.
pub struct Browser(PathBuf);

impl Browser {
    /// The one of this machine.
    pub fn find() -> Result<Self, PrintError> {
        if let Some(named) = std::env::var_os(VARIABLE).filter(|named| !named.is_empty()) {
            return Ok(Self(PathBuf::from(named)));
        }
        let path = std::env::var_os("PATH").unwrap_or_default();
        let on_the_path = std::env::split_paths(&path)
            .flat_map(|folder| NAMES.map(|name| folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX))));
        let found = on_the_path.chain(PLACES.map(PathBuf::from)).find(|place| place.is_file());
        found.map(Self).ok_or(PrintError::NoBrowser)
    }

    /// Starts it, so that it is there when the page is: that takes as long as to make the report.
    pub fn start(self) -> Result<Printing, PrintError> {
        let folder = Scratch::new()?;
        let server = OnePage::listen()?;
        let address = server.address.clone();
        let (hand, handed) = mpsc::channel();
        let printed = thread::spawn(move || {
            let served = thread::spawn(move || server.serve(&handed));
            let printed = self.run_to_the_end(&folder, &address);
            address.done();
            served.join().map_err(|_| io::Error::other("the page could not be served"))?;
            printed
        });
        Ok(Printing { hand: Some(hand), printed: Some(printed) })
    }

    fn run_to_the_end(&self, folder: &Scratch, address: &Address) -> Result<Vec<u8>, PrintError> {
        let printed = folder.path().join(FILE);
        // Without its sandbox only where it would not start with it, as for root or in a container: the page is the program's own, and asks for
        // nothing.
        let mut told = String::new();
        if !is_roots(folder.path()) {
            told = self.run(folder.path(), address, &printed, &[])?;
        }
        if !printed.is_file() {
            told = self.run(folder.path(), address, &printed, &["--no-sandbox"])?;
        }
        fs::read(&printed).map_err(|_| PrintError::Browser(self.0.display().to_string(), told))
    }

    /// Runs the browser to its end; what it told.
    fn run(&self, folder: &Path, address: &Address, printed: &Path, more: &[&str]) -> Result<String, PrintError> {
        let failed = |error: String| PrintError::Browser(self.0.display().to_string(), error);
        let log = folder.join("told.txt");
        let mut child = Command::new(&self.0)
            .args([
                "--headless",
                "--disable-gpu",
                "--no-first-run",
                "--disable-extensions",
                "--disable-background-networking",
            ])
            .args(["--disable-sync", "--disable-component-update", "--no-pdf-header-footer", "--no-proxy-server"])
            .args(more)
            .arg(format!("--user-data-dir={}", folder.join("profile").display()))
            .arg(format!("--print-to-pdf={}", printed.display()))
            .arg(address.url())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(fs::File::create(&log)?)
            .spawn()
            .map_err(|error| failed(error.to_string()))?;
        if !ends(&mut child)? {
            return Err(failed(format!("it had not ended after {} s", PATIENCE.as_secs())));
        }
        let told = fs::read_to_string(&log).unwrap_or_default();
        Ok(told.lines().last().unwrap_or("it told nothing").to_string())
    }
}

/// A browser that has been started, and waits for the page that it is to print.
pub struct Printing {
    hand: Option<mpsc::Sender<String>>,
    printed: Option<JoinHandle<Result<Vec<u8>, PrintError>>>,
}

impl Printing {
    /// Hands it the page.
    pub fn print(&self, html: String) {
        // Where it has ended already, `take` tells why.
        let _ = self.hand.as_ref().map(|hand| hand.send(html));
    }

    /// The page as PDF, once it is there.
    pub fn take(mut self) -> Result<Vec<u8>, PrintError> {
        self.end()
    }

    fn end(&mut self) -> Result<Vec<u8>, PrintError> {
        self.hand = None;
        let printed = self.printed.take().map(JoinHandle::join);
        printed.and_then(Result::ok).unwrap_or_else(|| Err(io::Error::other("the browser could not be watched").into()))
    }
}

/// Where no page comes the browser ends by itself, and its folder is taken away.
impl Drop for Printing {
    fn drop(&mut self) {
        let _ = self.end();
    }
}

/// Whether a folder of this program's belongs to root, who the program is then.
fn is_roots(folder: &Path) -> bool {
    #[cfg(unix)]
    return fs::metadata(folder).is_ok_and(|of| std::os::unix::fs::MetadataExt::uid(&of) == 0);
    #[cfg(not(unix))]
    {
        let _ = folder;
        false
    }
}

/// Waits for the end; whether it came.
fn ends(child: &mut Child) -> io::Result<bool> {
    let began = Instant::now();
    while child.try_wait()?.is_none() {
        if began.elapsed() > PATIENCE {
            child.kill()?;
            child.wait()?;
            return Ok(false);
        }
        thread::sleep(Duration::from_millis(10));
    }
    Ok(true)
}
