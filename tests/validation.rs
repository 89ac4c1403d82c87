//! The quick validation cases hold.

use barrier_check::commands::validate::Selection;
use barrier_check::report::validation::Row;
use barrier_check::validation::case::CaseRun;

fn holds(suite: &str) {
    let names = [suite.to_string()];
    let cases = Selection { names: &names, quick_only: true }.cases().expect("suite is known");
    for case in cases {
        let ran = CaseRun::of(case);
        assert!(ran.passed(), "{:#?}", Row::of(&ran));
    }
}

#[test]
fn contact_cases_hold() {
    holds("contact");
}

#[test]
fn bulk_cases_hold() {
    holds("bulk");
}

#[test]
fn wall_cases_hold() {
    holds("wall");
}

#[test]
fn barrier_cases_hold() {
    ["rope", "dissipator", "net"].into_iter().for_each(holds);
}

#[test]
fn unknown_names_are_told() {
    let names = ["contact".to_string(), "A99".to_string()];
    let unknown = Selection { names: &names, quick_only: false }.cases().err();
    assert_eq!(unknown, Some(vec!["A99".to_string()]));
}

/// `docs/validation.md` is what the program makes of its cases and their last outcome; `INSTA_UPDATE=always` writes it anew.
#[test]
fn the_page_on_validation_is_the_program_s_own() {
    let page = barrier_check::report::validation::document().expect("a page");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/validation.md");
    if std::env::var("INSTA_UPDATE").is_ok_and(|wish| wish == "always") {
        std::fs::write(path, &page).expect("it is written");
    }
    assert_eq!(std::fs::read_to_string(path).expect("the page"), page);
}
