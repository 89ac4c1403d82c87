//! Being asked to end: by Ctrl-C, by the system, by a terminal that closes.

use std::io::Read;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

/// Whether the run is asked to end.
static STOP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// What tells a run that it is to end at its next stop.
pub fn stop() -> &'static AtomicBool {
    &STOP
}

/// Takes the end of standard input as being asked to end: whoever started this program closes it to stop it, or is gone.
pub fn listen_to_whoever_started_it() {
    let wait = || {
        let mut stdin = std::io::stdin().lock();
        let mut bytes = [0; 64];
        while stdin.read(&mut bytes).is_ok_and(|read| read > 0) {}
        stop().store(true, Ordering::Relaxed);
    };
    // Without the thread the run cannot be stopped this way, and goes on to its end.
    let _ = std::thread::Builder::new().spawn(wait);
}

/// Listens: the first time the run is kept at its next stop and ends, the second time the program ends at once. What was ignored when the
/// program began, as `nohup` sees to, stays ignored.
#[cfg(unix)]
pub fn listen() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use std::sync::Once;
    static LISTENS: Once = Once::new();
    LISTENS.call_once(|| {
        let ignored = ignored_signals();
        for signal in [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0) {
            // In this order: the first time nothing has been asked for yet.
            let _ = signal_hook::flag::register_conditional_shutdown(signal, 2, Arc::clone(&STOP));
            let _ = signal_hook::flag::register(signal, Arc::clone(&STOP));
        }
    });
}

/// The signals that were ignored when the program began, a bit for each, where the system tells.
#[cfg(unix)]
fn ignored_signals() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    line.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// The same where there are no signals of that kind.
#[cfg(not(unix))]
pub fn listen() {
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(2);
        }
    });
}
