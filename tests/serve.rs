//! The page on the loopback address: what it answers, and what it does not, whoever asks.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

const PROGRAM: &str = env!("CARGO_BIN_EXE_barrier-check");
const DESIGNS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/designs");
const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/tiny.yaml");

/// A server of a folder of its own.
struct Server {
    child: Child,
    port: u16,
    token: String,
    folder: PathBuf,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or(Value::Null)
    }

    /// Why it was refused.
    fn why(&self) -> String {
        self.json()["error"].as_str().unwrap_or_default().to_string()
    }
}

fn fresh_folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("barrier-check-serve-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("site")).expect("a folder");
    std::fs::copy(TINY, folder.join("site/tiny.yaml")).expect("a copy");
    std::fs::copy(format!("{DESIGNS}/small_net.yaml"), folder.join("site/small_net.yaml")).expect("a copy");
    std::fs::write(folder.join("secret.yaml"), "secret: words").expect("a file");
    folder
}

impl Server {
    fn of(folder: &Path) -> Self {
        let mut child = Command::new(PROGRAM)
            .args(["serve", "--no-open"])
            .arg(folder.join("site"))
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut lines = BufReader::new(child.stdout.take().expect("its output")).lines();
        let address = loop {
            let line = lines.next().expect("an address").expect("a line");
            if let Some((_, rest)) = line.split_once("http://127.0.0.1:") {
                break rest.to_string();
            }
        };
        std::thread::spawn(move || lines.for_each(drop));
        let (port, token) = address.split_once("/#token=").expect("a token");
        Self { child, port: port.parse().expect("a port"), token: token.to_string(), folder: folder.to_path_buf() }
    }

    /// The answer to bytes as they are sent.
    fn raw(&self, request: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a server");
        stream.set_read_timeout(Some(Duration::from_secs(60))).expect("a time");
        // What is refused early is not read to its end.
        let _ = stream.write_all(request);
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
        let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
        Answer { status, head: head.to_ascii_lowercase(), body: body.to_string() }
    }

    /// With headers as given, and nothing else but what ends the connection.
    fn with(&self, line: &str, headers: &[String], body: &str) -> Answer {
        let headers: String = headers.iter().map(|header| format!("{header}\r\n")).collect();
        let length = if body.is_empty() { String::new() } else { format!("Content-Length: {}\r\n", body.len()) };
        self.raw(format!("{line} HTTP/1.1\r\n{headers}{length}Connection: close\r\n\r\n{body}").as_bytes())
    }

    fn host(&self) -> String {
        format!("Host: 127.0.0.1:{}", self.port)
    }

    fn key(&self) -> String {
        format!("X-Barrier-Check-Token: {}", self.token)
    }

    fn origin(&self) -> String {
        format!("Origin: http://127.0.0.1:{}", self.port)
    }

    fn get(&self, path: &str) -> Answer {
        self.with(&format!("GET {path}"), &[self.host(), self.key()], "")
    }

    /// A file of a report.
    fn report(&self, path: &str) -> Answer {
        self.with(&format!("GET /report/{}/{path}", self.token), &[self.host()], "")
    }

    fn send(&self, method: &str, path: &str, body: &Value) -> Answer {
        let headers = [self.host(), self.key(), self.origin(), "Content-Type: application/json".into()];
        self.with(&format!("{method} {path}"), &headers, &body.to_string())
    }

    /// What a run has told once something holds of it.
    fn run_until(&self, folder: &str, holds: impl Fn(&Value) -> bool) -> Value {
        let began = Instant::now();
        loop {
            let now = self.get(&format!("/api/runs/{folder}")).json();
            if holds(&now) {
                return now;
            }
            assert!(began.elapsed() < Duration::from_secs(240), "{now}");
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

#[test]
fn only_the_page_that_was_given_the_token_is_answered() {
    let folder = fresh_folder("guard");
    let server = Server::of(&folder);
    let (host, key, origin) = (server.host(), server.key(), server.origin());
    let get = |path: &str, headers: &[&str]| {
        let headers: Vec<String> = headers.iter().map(|header| header.to_string()).collect();
        server.with(&format!("GET {path}"), &headers, "")
    };
    // The page holds nothing that is secret, and gives none: no cookie, which would go to every port of the address.
    for path in ["/", "/page/bundle.js", "/page/page.css", "/?token=x"] {
        let answer = get(path, &[&host]);
        assert!(
            answer.status == 200 && !answer.head.contains("cookie") && !answer.body.contains(&server.token),
            "{path}"
        );
    }
    // Without the token, with another one, a part of it, or two.
    let keys = [
        String::new(),
        format!("X-Barrier-Check-Token: {}0", &server.token[1..]),
        format!("X-Barrier-Check-Token: {}", &server.token[..32]),
        format!("Cookie: barrier_check_{}={}", server.port, server.token),
    ];
    for wrong in &keys {
        for path in ["/api/start", "/api/runs", "/nowhere", "/report/x/report.html", "/report/x/y/report.html"] {
            let headers: Vec<&str> = [host.as_str(), wrong].into_iter().filter(|header| !header.is_empty()).collect();
            let answer = get(path, &headers);
            assert_eq!((answer.status, answer.why().contains("token")), (403, true), "{path}");
        }
    }
    assert_eq!(get("/api/start", &[&host, &key, &keys[1]]).status, 403);
    assert_eq!(get("/api/start", &[&host, &key]).status, 200);
    // A name that an attacker's server makes point here, none, or two.
    let elsewhere = format!("Host: evil.example:{}", server.port);
    let numbered = format!("Host: 127.0.0.1.evil.example:{}", server.port);
    for headers in [
        vec![elsewhere.as_str()],
        vec![&numbered],
        vec!["Host: 127.0.0.1"],
        vec!["Host: 127.0.0.1:1"],
        vec![&host, &elsewhere],
    ] {
        let headers: Vec<&str> = headers.into_iter().chain([key.as_str()]).collect();
        assert_ne!(get("/api/start", &headers).status, 200, "{headers:?}");
    }
    assert_ne!(get("/api/start", &[&key]).status, 200);
    // Another page in the same browser.
    for foreign in [
        "Origin: http://evil.example",
        "Origin: null",
        "Origin: http://127.0.0.1:1",
        "Sec-Fetch-Site: cross-site",
        "Sec-Fetch-Site: same-site",
    ] {
        assert_eq!(get("/api/start", &[&host, &key, foreign]).status, 403, "{foreign}");
    }
    let change = |headers: &[&str]| {
        let headers: Vec<String> = headers
            .iter()
            .copied()
            .chain([host.as_str(), &key, "Content-Type: application/json"])
            .map(String::from)
            .collect();
        let body = json!({ "path": "new.yaml", "text": "x", "before": null }).to_string();
        server.with("PUT /api/design", &headers, &body).status
    };
    assert_eq!(change(&[]), 403);
    assert_eq!(change(&["Origin: http://evil.example"]), 403);
    assert!(!folder.join("site/new.yaml").exists());
    assert_eq!(change(&[&origin]), 200);
    // What a form of another page could send is not taken for JSON.
    let form = server.with(
        "POST /api/look",
        &[host.clone(), key.clone(), origin.clone(), "Content-Type: text/plain".into()],
        "{}",
    );
    assert_eq!(form.status, 415);
    // Every answer keeps the browser from more than is meant.
    for answer in [server.get("/"), server.get("/nowhere"), get("/", &[&host])] {
        for header in [
            "content-security-policy: default-src 'none'",
            "x-content-type-options: nosniff",
            "x-frame-options: sameorigin",
            "referrer-policy: no-referrer",
            "cache-control: no-store",
        ] {
            assert!(answer.head.contains(header), "{header}: {}", answer.head);
        }
    }
    std::fs::remove_dir_all(folder).expect("the folder");
}

/// The addresses on which somebody listens at a port, as the system lists them.
#[cfg(target_os = "linux")]
#[test]
fn no_other_address_is_listened_on() {
    let folder = fresh_folder("address");
    let server = Server::of(&folder);
    let port = format!(":{:04X}", server.port);
    let listed =
        ["/proc/net/tcp", "/proc/net/tcp6"].map(|list| std::fs::read_to_string(list).unwrap_or_default()).concat();
    let places = listed.lines().filter_map(|line| {
        let mut parts = line.split_whitespace().skip(1);
        let (place, state) = (parts.next()?, parts.nth(1)?);
        (place.ends_with(&port) && state == "0A").then(|| place.to_string())
    });
    let places: Vec<String> = places.collect();
    assert_eq!(places, [format!("0100007F{port}")]);
    std::fs::remove_dir_all(folder).expect("the folder");
}

#[test]
fn nothing_outside_the_folder_is_read_or_written() {
    let folder = fresh_folder("outside");
    let server = Server::of(&folder);
    let site = folder.join("site");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(folder.join("secret.yaml"), site.join("link.yaml")).expect("a link");
        std::os::unix::fs::symlink(&folder, site.join("linked")).expect("a link");
    }
    std::fs::write(site.join(".hidden.yaml"), "hidden: words").expect("a file");
    std::fs::write(site.join("notes.txt"), "notes").expect("a file");
    std::fs::create_dir(site.join("folder.yaml")).expect("a folder");
    let absolute = folder.join("secret.yaml").display().to_string();
    let names = [
        "../secret.yaml",
        "a/../../secret.yaml",
        "./../secret.yaml",
        &absolute,
        "/etc/passwd",
        "..\\secret.yaml",
        "C:secret.yaml",
        "link.yaml",
        "linked/secret.yaml",
        ".hidden.yaml",
        "notes.txt",
        "",
        ".",
        "..",
        "folder.yaml",
        "tiny.yaml\u{0}.txt",
        "tiny.yaml/x.yaml",
    ];
    for name in names {
        let escaped: String = name.bytes().map(|byte| format!("%{byte:02x}")).collect();
        let read = server.get(&format!("/api/design?path={escaped}"));
        assert!(
            (400..500).contains(&read.status) && !read.body.contains("words"),
            "{name:?}: {} {}",
            read.status,
            read.body
        );
        for (method, path) in [("PUT", "/api/design"), ("POST", "/api/look"), ("POST", "/api/runs")] {
            let answer = server.send(method, path, &json!({ "path": name, "text": "mine", "before": null }));
            assert!((400..500).contains(&answer.status), "{path} {name:?}: {}", answer.status);
        }
        let answers: Vec<String> = server.get("/api/start").json()["questions"]
            .as_array()
            .expect("questions")
            .iter()
            .map(|question| question["usual"].as_str().expect("a text").to_string())
            .collect();
        let new = server.send("POST", "/api/new", &json!({ "path": name, "answers": answers }));
        assert!((400..500).contains(&new.status) || new.json()["wrong"].is_string(), "{name:?}: {}", new.body);
    }
    assert_eq!(std::fs::read_to_string(folder.join("secret.yaml")).expect("it"), "secret: words");
    let listed = server.get("/api/start").json()["designs"].to_string();
    assert!(
        listed.contains("tiny.yaml")
            && !listed.contains("secret")
            && !listed.contains("link")
            && !listed.contains("hidden"),
        "{listed}"
    );
    // A design that names a file elsewhere.
    let tiny = std::fs::read_to_string(TINY).expect("a design");
    for elsewhere in ["../secret.yaml", &absolute, "/etc/passwd"] {
        let text = format!("{tiny}\nfactors:\n  set: none\n")
            .replace("barrier:\n  flexible_net:", &format!("barrier:\n  kit: {elsewhere}\n  flexible_net:"));
        let problems =
            server.send("POST", "/api/look", &json!({ "path": "tiny.yaml", "text": text })).json()["problems"]
                .to_string();
        assert!(
            problems.contains("outside the folder") && !problems.contains("words") && !problems.contains("root:"),
            "{problems}"
        );
    }
    // Links where the program reads beside a design, and where reports go.
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink(&folder, site.join("attached")).expect("a link");
        let text = tiny.replace("barrier:\n  flexible_net:", "barrier:\n  kit: gone/secret.yaml\n  flexible_net:");
        let problems = server.send("POST", "/api/look", &json!({ "path": "tiny.yaml", "text": text })).json();
        assert!(!problems["problems"].to_string().contains("words"), "{problems}");
        std::fs::create_dir(folder.join("elsewhere")).expect("a folder");
        symlink(folder.join("elsewhere"), site.join("out")).expect("a link");
        let run = || server.send("POST", "/api/runs", &json!({ "path": "tiny.yaml" })).status;
        assert_eq!(run(), 400);
        std::fs::remove_file(site.join("out")).expect("the link");
        std::fs::create_dir(site.join("out")).expect("a folder");
        symlink(folder.join("elsewhere"), site.join("out/tiny")).expect("a link");
        assert_eq!(run(), 400);
        assert_eq!(server.send("POST", "/api/runs/tiny%2f/resume", &json!({})).status, 400);
        assert_eq!(std::fs::read_dir(folder.join("elsewhere")).expect("a folder").count(), 0);
    }
    // Reports: what the program has written into the folders of `out`, nothing else.
    std::fs::create_dir_all(site.join("out/mine")).expect("a folder");
    std::fs::write(site.join("out/mine/report.html"), "words").expect("a file");
    for path in [
        "/report/TOKEN/mine/report.html",
        "/report/TOKEN/../tiny.yaml",
        "/report/TOKEN/%2e%2e/tiny.yaml",
        "/report/TOKEN/mine/%2e%2e%2f%2e%2e%2ftiny.yaml",
        "/report/TOKEN/mine/..%2f..%2ftiny.yaml",
        "/report/TOKEN/.%2f/x",
        "/report/TOKEN/%2fetc/passwd",
        "/page/..%2f..%2fCargo.toml",
    ] {
        let answer = server.get(&path.replace("TOKEN", &server.token));
        assert!((400..500).contains(&answer.status) && !answer.body.contains("words"), "{path}: {}", answer.status);
    }
    for (path, body) in [
        ("/api/runs/../x/stop", json!({})),
        ("/api/runs/%2e%2e/resume", json!({})),
        ("/api/compare", json!({ "folders": ["..", "/etc"] })),
    ] {
        let status = server.send("POST", path, &body).status;
        assert!((400..500).contains(&status), "{path}: {status}");
    }
    std::fs::remove_dir_all(folder).expect("the folder");
}

#[test]
fn what_is_too_much_or_no_request_is_refused_and_stops_nobody() {
    let folder = fresh_folder("size");
    let server = Server::of(&folder);
    let sent = |body: &str| {
        let headers = [server.host(), server.key(), server.origin(), "Content-Type: application/json".into()];
        server.with("POST /api/look", &headers, body).status
    };
    // Slow ones that never end hold up nobody.
    let _slow: Vec<TcpStream> = (0..50)
        .map(|_| {
            let mut stream = TcpStream::connect(("127.0.0.1", server.port)).expect("a server");
            stream.write_all(b"POST /api/look HTTP/1.1\r\nHost: ").expect("a part");
            stream
        })
        .collect();
    let large = json!({ "path": "tiny.yaml", "text": "x".repeat(5 << 20) }).to_string();
    assert!([413, 0].contains(&sent(&large)));
    assert_eq!(sent("{ no json"), 400);
    assert_eq!(sent("[]"), 422);
    assert_eq!(sent(&json!({ "path": 1, "text": [] }).to_string()), 422);
    // A text that unfolds to more than there is memory, one that is nested without end, and one that is none.
    let bomb: String =
        (1..30).map(|level| format!("a{level}: &a{level} [*a{0}, *a{0}, *a{0}, *a{0}]\n", level - 1)).collect();
    for text in [format!("a0: &a0 [x]\n{bomb}"), "[".repeat(100_000), "{a: ".repeat(50_000), "\u{0}\u{1}".into()] {
        let began = Instant::now();
        let answer = server.send("POST", "/api/look", &json!({ "path": "tiny.yaml", "text": text }));
        assert!(
            answer.status == 200 && !answer.json()["problems"].as_array().expect("problems").is_empty(),
            "{}",
            answer.body
        );
        assert!(began.elapsed() < Duration::from_secs(20));
    }
    for body in [
        json!({ "path": "tiny.yaml", "seeds": 0 }),
        json!({ "path": "tiny.yaml", "seeds": 1_000_000 }),
        json!({ "path": "tiny.yaml", "seeds": -1 }),
        json!({ "path": "none.yaml" }),
    ] {
        assert!((400..500).contains(&server.send("POST", "/api/runs", &body).status), "{body}");
    }
    assert_eq!(server.send("DELETE", "/api/design", &json!({})).status, 405);
    assert_eq!(server.send("POST", "/api/new", &json!({ "path": "x.yaml", "answers": ["one"] })).status, 400);
    for junk in
        [&b"\x16\x03\x01\x02\x00\x01"[..], b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\r\n\r\n\r\n", &[b'A'; 100_000]]
    {
        assert!(server.raw_short(junk) != 200);
    }
    let long = format!("Cookie: {}", "x".repeat(1 << 20));
    assert_ne!(server.with("GET /api/start", &[server.host(), long], "").status, 200);
    assert_eq!(server.get("/api/start").status, 200);
    std::fs::remove_dir_all(folder).expect("the folder");
}

impl Server {
    /// Status of the answer to what is no request, or 0; whoever sends it closes first.
    fn raw_short(&self, bytes: &[u8]) -> u16 {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a server");
        let _ = stream.write_all(bytes);
        let _ = stream.shutdown(std::net::Shutdown::Write);
        let mut answer = String::new();
        let _ = stream.set_read_timeout(Some(Duration::from_secs(10)));
        let _ = stream.read_to_string(&mut answer);
        answer.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0)
    }
}

#[test]
fn nothing_that_somebody_else_has_written_is_overwritten() {
    let folder = fresh_folder("conflict");
    let server = Server::of(&folder);
    let place = folder.join("site/tiny.yaml");
    let read = server.get("/api/design?path=tiny.yaml").json();
    let text = read["text"].as_str().expect("a text");
    let put = |path: &str, text: &str, before: Value| {
        server.send("PUT", "/api/design", &json!({ "path": path, "text": text, "before": before }))
    };
    let first = put("tiny.yaml", &format!("{text}# one\n"), read["digest"].clone());
    assert_eq!(first.status, 200);
    // The other tab still has what was there before.
    let second = put("tiny.yaml", &format!("{text}# two\n"), read["digest"].clone());
    let conflict = |answer: Answer| answer.json()["conflict"].as_str().map(str::to_string);
    assert!(conflict(second).is_some_and(|why| why.contains("changed elsewhere")));
    assert!(std::fs::read_to_string(&place).expect("it").ends_with("# one\n"));
    // A new one in the place of one that is there, and one whose file has gone.
    assert!(conflict(put("tiny.yaml", "mine", Value::Null)).is_some());
    std::fs::remove_file(&place).expect("it");
    assert!(conflict(put("tiny.yaml", "mine", first.json()["written"]["digest"].clone())).is_some());
    assert!(!place.exists());
    // Of two at once one is told, and what was protected stays so.
    std::fs::write(&place, text).expect("a file");
    let digest = server.get("/api/design?path=tiny.yaml").json()["digest"].clone();
    let answers: Vec<Answer> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8)
            .map(|number| {
                let (put, digest) = (&put, digest.clone());
                scope.spawn(move || put("tiny.yaml", &format!("{text}# {number}\n"), digest))
            })
            .collect();
        threads.into_iter().map(|thread| thread.join().expect("an answer")).collect()
    });
    assert_eq!(answers.iter().filter(|answer| answer.json()["written"].is_object()).count(), 1);
    let digest = server.get("/api/design?path=tiny.yaml").json()["digest"].clone();
    let mut protected = std::fs::metadata(&place).expect("it").permissions();
    protected.set_readonly(true);
    std::fs::set_permissions(&place, protected).expect("it");
    assert_eq!(put("tiny.yaml", "mine", digest).status, 500);
    let left: Vec<_> = std::fs::read_dir(folder.join("site"))
        .expect("a folder")
        .flatten()
        .filter(|entry| entry.file_name().to_string_lossy().ends_with(".tmp"))
        .collect();
    assert!(left.is_empty());
    std::fs::remove_dir_all(folder).expect("the folder");
}

#[test]
fn a_design_is_looked_at_run_and_its_report_handed_out() {
    let folder = fresh_folder("run");
    let server = Server::of(&folder);
    let text = server.get("/api/design?path=tiny.yaml").json()["text"].as_str().expect("a text").to_string();
    let look = |text: &str| server.send("POST", "/api/look", &json!({ "path": "tiny.yaml", "text": text })).json();
    let seen = look(&text)["seen"].clone();
    assert!(seen["checks"].as_array().is_some_and(|checks| checks.len() > 3));
    assert!(seen["drawings"][0]["svg"].as_str().is_some_and(|svg| svg.starts_with("<svg")));
    // By the equations alone no net passes.
    assert_eq!(seen["verdict"], "undecided");
    let wrong = look(&text.replace("flow:", "flaw:"));
    assert!(wrong["seen"].is_null() && wrong["problems"][0]["line"].is_u64(), "{wrong}");
    let begun = server.send("POST", "/api/runs", &json!({ "path": "tiny.yaml", "seeds": 1 }));
    assert_eq!((begun.status, &begun.json()["folder"]), (200, &json!("tiny")));
    let ended = server.run_until("tiny", |now| now["state"] == "ended");
    assert_eq!(ended["page"], "report.html", "{ended}");
    let page = server.report("tiny/report.html");
    assert!(
        page.status == 200 && page.head.contains("text/html") && page.body.contains("SHA-256 of the design file"),
        "{}",
        page.head
    );
    // The report may show itself, and fetch nothing.
    assert!(page.head.contains("script-src 'sha256-") && !page.head.contains("connect-src 'self'"));
    assert_eq!(
        server.report("tiny/result.json").json()["verdict"],
        server.get("/api/runs").json()["runs"][0]["verdict"]
    );
    std::fs::write(folder.join("site/out/tiny/mine.txt"), "words").expect("a file");
    assert_eq!(server.report("tiny/mine.txt").status, 404);
    #[cfg(unix)]
    {
        let swapped = folder.join("site/out/tiny/report.md");
        std::fs::remove_file(&swapped).expect("it");
        std::os::unix::fs::symlink(folder.join("secret.yaml"), &swapped).expect("a link");
        assert_eq!(server.report("tiny/report.md").status, 404);
    }
    std::fs::remove_dir_all(folder).expect("the folder");
}

#[test]
fn a_run_that_is_stopped_or_whose_server_is_killed_goes_on_where_it_was() {
    let folder = fresh_folder("resume");
    let mut server = Server::of(&folder);
    let begin = |server: &Server| server.send("POST", "/api/runs", &json!({ "path": "small_net.yaml", "seeds": 2 }));
    assert_eq!(begin(&server).status, 200);
    // Not twice into one folder.
    assert_eq!(begin(&server).status, 409);
    let under_way = |now: &Value| now["told"]["share"].as_f64().is_some_and(|share| share > 0.1);
    let now = server.run_until("small_net", |now| under_way(now) && now["pictures"][0].is_array());
    assert!(now["pictures"][0][1]["grains"].as_array().is_some_and(|grains| grains.len() > 100), "a picture");
    assert_eq!(server.send("POST", "/api/runs/small_net/stop", &json!({})).status, 200);
    let stopped = server.run_until("small_net", |now| now["state"] == "ended");
    assert_eq!((&stopped["exit_code"], &stopped["page"]), (&json!(2), &Value::Null), "{stopped}");
    let state = |server: &Server| server.get("/api/runs").json()["runs"][0]["state"].clone();
    assert_eq!(state(&server), "kept");
    assert_eq!(server.send("POST", "/api/runs/small_net/resume", &json!({})).status, 200);
    server.run_until("small_net", under_way);
    // Killed without a word; the run notices, keeps what it has and ends.
    server.child.kill().expect("it");
    server.child.wait().expect("it");
    let again = Server::of(&server.folder);
    let began = Instant::now();
    loop {
        let resumed = again.send("POST", "/api/runs/small_net/resume", &json!({}));
        assert_eq!(resumed.status, 200);
        let ended = again.run_until("small_net", |now| now["state"] == "ended");
        if ended["page"] == "report.html" {
            break;
        }
        // The one before may hold the folder until it has kept itself.
        assert!(began.elapsed() < Duration::from_secs(60), "{ended}");
        std::thread::sleep(Duration::from_millis(200));
    }
    let result = again.report("small_net/result.json").json();
    let alone = folder.join("alone");
    let ran = Command::new(PROGRAM)
        .arg(folder.join("site/small_net.yaml"))
        .args(["--seeds", "2", "--out"])
        .arg(&alone)
        .output()
        .expect("the program starts");
    assert!(ran.status.code().is_some_and(|code| code <= 2));
    let other: Value =
        serde_json::from_slice(&std::fs::read(alone.join("result.json")).expect("a result")).expect("JSON");
    assert_eq!(result["checks"], other["checks"]);
    std::fs::remove_dir_all(folder).expect("the folder");
}
