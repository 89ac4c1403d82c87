//! Licences of everything the program is built from on this kind of machine, as `.ci/deny.toml` allows them.

use std::process::Command;

/// Whether a licence expression is satisfied by `allowed`: one alternative of each part that is joined by AND.
fn allowed(expression: &str, licences: &[String]) -> bool {
    let plain = expression.replace(['(', ')'], "").replace('/', " OR ");
    plain
        .split(" AND ")
        .all(|part| part.split(" OR ").any(|licence| licences.iter().any(|allowed| allowed == licence.trim())))
}

fn allowed_licences() -> Vec<String> {
    let text = include_str!("../.ci/deny.toml");
    let list = text.split_once("allow = [").and_then(|(_, rest)| rest.split_once(']')).expect("a list").0;
    list.split('"').skip(1).step_by(2).map(str::to_string).collect()
}

/// The platform that cargo builds for here; packages of others need not be on this machine.
fn host(cargo: &str) -> String {
    let output = Command::new(cargo).arg("-vV").output().expect("cargo starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.lines().find_map(|line| line.strip_prefix("host: ")).expect("a host").to_string()
}

#[test]
fn every_licence_is_allowed() {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_string());
    let output = Command::new(&cargo)
        .args(["metadata", "--format-version", "1", "--offline", "--locked", "--filter-platform", &host(&cargo)])
        .output()
        .expect("cargo starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let packages = metadata["packages"].as_array().expect("packages");
    assert!(packages.len() > 50);
    let licences = allowed_licences();
    let bad: Vec<String> = packages
        .iter()
        .filter(|package| !package["license"].as_str().is_some_and(|licence| allowed(licence, &licences)))
        .map(|package| format!("{} {}: {}", package["name"], package["version"], package["license"]))
        .collect();
    assert!(bad.is_empty(), "{bad:#?}");
}

#[test]
fn an_expression_needs_all_its_parts() {
    let licences = ["MIT".to_string(), "Unicode-3.0".to_string()];
    assert!(allowed("(MIT OR GPL-3.0) AND Unicode-3.0", &licences));
    assert!(allowed("Apache-2.0/MIT", &licences));
    assert!(!allowed("MIT AND GPL-3.0", &licences));
    assert!(!allowed("GPL-3.0", &licences));
}
