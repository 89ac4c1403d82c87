//! Nothing of the user's is lost, and nothing is half written.

use super::*;

fn place(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("barrier-check-{}-folder-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn files(names: &[&str]) -> Vec<ReportFile> {
    names.iter().map(|name| ReportFile::new(*name, format!("what {name} says"))).collect()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn claim(path: &Path) -> Result<Folder, Refusal> {
    Folder::claim(path, None, Named::Explicitly)
}

#[test]
fn what_a_run_no_longer_writes_goes_and_what_is_the_user_s_stays() {
    let path = place("stale");
    claim(&path).unwrap().write(&files(&["report.md", "old.svg", "vtk/1.vtu", "result.json"])).unwrap();
    fs::write(path.join("notes.txt"), "mine").unwrap();
    claim(&path).unwrap().write(&files(&["report.md", "new.svg", "result.json"])).unwrap();
    assert_eq!(names(&path), ["manifest.json", "new.svg", "notes.txt", "report.md", "result.json"]);
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_folder_of_the_user_and_a_changed_report_are_refused_and_left_alone() {
    let path = place("foreign");
    fs::create_dir_all(&path).unwrap();
    fs::write(path.join("design.yaml"), "mine").unwrap();
    assert!(matches!(claim(&path), Err(Refusal::Foreign(_, names)) if names == "design.yaml"));
    assert_eq!(names(&path), ["design.yaml"]);
    fs::remove_file(path.join("design.yaml")).unwrap();
    fs::write(path.join("manifest.json"), r#"{"name": "of something else"}"#).unwrap();
    assert!(matches!(claim(&path), Err(Refusal::Foreign(_, names)) if names == "manifest.json"));
    fs::remove_file(path.join("manifest.json")).unwrap();
    claim(&path).unwrap().write(&files(&["report.md", "result.json"])).unwrap();
    fs::write(path.join("report.md"), "with my remarks").unwrap();
    assert!(matches!(claim(&path), Err(Refusal::Changed(_, names)) if names == "report.md"));
    assert_eq!(fs::read_to_string(path.join("report.md")).unwrap(), "with my remarks");
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_manifest_of_the_user_that_turns_up_during_a_run_is_moved_aside() {
    let path = place("manifest");
    let mut folder = claim(&path).unwrap();
    fs::write(path.join("manifest.json"), r#"{"name": "mine"}"#).unwrap();
    let moved = folder.write(&files(&["report.md", "result.json"])).unwrap();
    assert_eq!(moved, [["manifest.json".to_string(), "manifest.json.1.kept".to_string()]]);
    assert_eq!(fs::read_to_string(path.join("manifest.json.1.kept")).unwrap(), r#"{"name": "mine"}"#);
    // The next run finds its own.
    drop(folder);
    assert!(claim(&path).is_ok());
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_result_of_the_user_beside_a_page_that_has_none_stays() {
    let path = place("result");
    claim(&path).unwrap().write(&files(&["compare.md"])).unwrap();
    fs::write(path.join("result.json"), "mine").unwrap();
    claim(&path).unwrap().write(&files(&["compare.md"])).unwrap();
    assert_eq!(fs::read_to_string(path.join("result.json")).unwrap(), "mine");
    fs::remove_dir_all(path).unwrap();
}

/// A folder of ours that somebody has moved elsewhere and put a link in its place: what lies there now is his.
#[cfg(unix)]
#[test]
fn nothing_behind_a_link_is_removed() {
    let (path, elsewhere) = (place("linked"), place("elsewhere"));
    claim(&path).unwrap().write(&files(&["report.md", "vtk/1.vtu", "result.json"])).unwrap();
    fs::rename(path.join("vtk"), &elsewhere).unwrap();
    std::os::unix::fs::symlink(&elsewhere, path.join("vtk")).unwrap();
    assert!(matches!(claim(&path), Err(Refusal::Changed(_, names)) if names == "vtk/1.vtu"));
    assert!(elsewhere.join("1.vtu").is_file());
    fs::remove_dir_all(path).unwrap();
    fs::remove_dir_all(elsewhere).unwrap();
}

#[test]
fn what_turns_up_during_a_run_is_moved_aside() {
    let path = place("aside");
    let mut folder = claim(&path).unwrap();
    fs::write(path.join("report.md"), "mine").unwrap();
    let moved = folder.write(&files(&["report.md", "result.json"])).unwrap();
    assert_eq!(moved, [["report.md".to_string(), "report.md.1.kept".to_string()]]);
    assert_eq!(fs::read_to_string(path.join("report.md.1.kept")).unwrap(), "mine");
    drop(folder);
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_folder_that_was_removed_or_a_file_in_the_place_of_one_loses_no_run() {
    let path = place("removed");
    let mut folder = claim(&path).unwrap();
    fs::remove_dir_all(&path).unwrap();
    folder.write(&files(&["report.md", "result.json"])).unwrap();
    assert_eq!(names(&path), [lock::FILE, "manifest.json", "report.md", "result.json"]);
    fs::write(path.join("vtk"), "mine").unwrap();
    let moved = folder.write(&files(&["report.md", "vtk/1.vtu", "result.json"])).unwrap();
    assert_eq!(moved, [["vtk".to_string(), "vtk.1.kept".to_string()]]);
    assert_eq!(fs::read_to_string(path.join("vtk.1.kept")).unwrap(), "mine");
    assert!(path.join("vtk/1.vtu").is_file());
    drop(folder);
    fs::remove_dir_all(path).unwrap();
}

/// What another run has put into a folder that was removed meanwhile is that one's, done or still at work.
#[cfg(unix)]
#[test]
fn a_folder_that_another_has_taken_is_left_to_it() {
    let path = place("taken");
    let mut first = claim(&path).unwrap();
    fs::remove_dir_all(&path).unwrap();
    let mut second = claim(&path).unwrap();
    assert!(first.write(&files(&["report.md", "result.json"])).is_err());
    second.write(&files(&["compare.md"])).unwrap();
    drop(second);
    assert!(first.write(&files(&["report.md", "result.json"])).is_err());
    drop(first);
    assert_eq!(names(&path), ["compare.md", "manifest.json"]);
    fs::remove_dir_all(path).unwrap();
}

/// A folder that the program names after a design is not that of a recording which was brought there.
#[test]
fn what_was_brought_has_another_owner() {
    let path = place("brought");
    let mut brought = claim(&path).unwrap();
    brought.write(&files(&["report.md", "result.json"])).unwrap();
    drop(brought);
    let design = path.with_extension("yaml");
    fs::write(&design, "x").unwrap();
    assert!(matches!(Folder::claim(&path, Some(&design), Named::ByDefault), Err(Refusal::OtherDesign(_))));
    assert!(Folder::claim(&path, Some(&design), Named::Explicitly).is_ok());
    fs::remove_file(design).unwrap();
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_replacement_that_was_cut_short_is_the_program_s_own() {
    let path = place("cut");
    claim(&path).unwrap().write(&files(&["report.md", "one.svg", "result.json"])).unwrap();
    // Killed after the first of the new files has taken its place.
    let mut folder = claim(&path).unwrap();
    let new = ["report.md", "one.svg"].map(|name| (name.to_string(), digest_of(b"new")));
    folder.manifest = folder.manifest.clone().replaced_by(PROGRAM.to_string(), new.into_iter().collect());
    folder.put_manifest().unwrap();
    fs::write(path.join("report.md"), "new").unwrap();
    drop(folder);
    claim(&path).unwrap().write(&files(&["report.md", "result.json"])).unwrap();
    assert_eq!(names(&path), ["manifest.json", "report.md", "result.json"]);
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_folder_into_which_nothing_came_is_left_as_it_was() {
    let path = place("empty");
    drop(claim(&path).unwrap());
    assert!(!path.exists());
    fs::create_dir_all(&path).unwrap();
    drop(claim(&path).unwrap());
    assert_eq!(names(&path), Vec::<String>::new());
    let held = claim(&path).unwrap();
    assert!(matches!(claim(&path), Err(Refusal::Taken(_))));
    drop(held);
    fs::remove_dir(path).unwrap();
}

#[test]
fn two_design_files_of_one_name_are_told_apart_unless_the_folder_is_named() {
    let path = place("two");
    for design in ["a", "b"] {
        fs::create_dir_all(path.join(design)).unwrap();
        fs::write(path.join(design).join("net.yaml"), "x").unwrap();
    }
    let (a, b, out) = (path.join("a/net.yaml"), path.join("b/net.yaml"), path.join("out"));
    Folder::claim(&out, Some(&a), Named::ByDefault).unwrap().write(&files(&["result.json"])).unwrap();
    assert!(Folder::claim(&out, Some(&a), Named::ByDefault).is_ok());
    assert!(matches!(Folder::claim(&out, Some(&b), Named::ByDefault), Err(Refusal::OtherDesign(_))));
    // Moved together they are the same.
    let moved = place("moved");
    fs::rename(&path, &moved).unwrap();
    assert!(Folder::claim(&moved.join("out"), Some(&moved.join("a/net.yaml")), Named::ByDefault).is_ok());
    assert!(Folder::claim(&moved.join("out"), Some(&moved.join("b/net.yaml")), Named::Explicitly).is_ok());
    fs::remove_dir_all(moved).unwrap();
}

#[test]
fn names_of_folders_lead_nowhere_else() {
    for (name, expected) in [
        ("site_a", "site_a"),
        ("Net Steg #2", "Net Steg _2"),
        ("..", "design"),
        (".hidden", "hidden"),
        ("a/../../b", "a_.._.._b"),
        ("Wildbach 土石流", "Wildbach 土石流"),
        ("javascript:alert(1)", "javascript_alert(1)"),
    ] {
        assert_eq!(folder_name(name), expected);
    }
}
