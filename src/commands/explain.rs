//! `barrier-check explain`: what a check, a load case, a warning or a key is, in the terminal.

use crate::commands::ExitCode;
use crate::explain::{find, list, reference};
use crate::terminal;

/// Prints what has this id; without one all ids, or with `all` the whole reference as Markdown.
pub fn explain(id: Option<&str>, all: bool) -> ExitCode {
    let said = match id {
        None => terminal::say(if all { reference() } else { list() }.trim_end()),
        Some(id) => match find(id) {
            Ok(found) => {
                let texts: Vec<String> = found.iter().map(|entry| entry.text()).collect();
                terminal::say(texts.join("\n").trim_end())
            }
            Err(near) => {
                let hint = near.map_or_else(
                    || "`barrier-check explain` lists all".to_string(),
                    |near| format!("did you mean `{near}`?"),
                );
                terminal::warn(format_args!(
                    "error: nothing is called `{id}`; allowed are the ids of checks, load cases and warnings in result.json and the keys of a design file\n  hint:    {hint}"
                ));
                false
            }
        },
    };
    if said { ExitCode::Pass } else { ExitCode::Undecided }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::input::beside;
    use crate::design::entries::Purpose;
    use crate::design::read::read_design_for;
    use crate::explain::{Of, all};
    use crate::pipeline::by_equations;
    use crate::report::warnings::ids;

    /// Whatever a report of the examples tells is explained.
    #[test]
    fn every_check_and_load_case_of_the_examples_is_explained() {
        for entry in std::fs::read_dir("designs").expect("designs") {
            let path = entry.expect("an entry").path();
            if path.extension().is_none_or(|extension| extension != "yaml") {
                continue;
            }
            let text = std::fs::read(&path).expect("a design");
            let open = |name: &str| beside(&path, name);
            let file = read_design_for(Purpose::Equations, &path.display().to_string(), &text, &open);
            let run = by_equations(file.unwrap_or_else(|problems| panic!("{problems}")));
            let ids = run.outcomes.iter().map(|outcome| outcome.id.as_str());
            for id in ids.chain(run.guideline.cases.iter().map(|case| case.id)) {
                let found = find(id).unwrap_or_else(|_| panic!("{id} of {} is not explained", path.display()));
                assert!(found.iter().any(|entry| entry.of != Of::Key), "{id}");
            }
        }
    }

    #[test]
    fn every_warning_is_explained_and_no_other() {
        let known: Vec<String> = ids().map(String::from).collect();
        let explained: Vec<String> =
            all().into_iter().filter(|entry| entry.of == Of::Warning).map(|entry| entry.id).collect();
        assert_eq!(known, explained);
    }

    /// The file is what the program prints: `barrier-check explain --all > docs/reference.md` makes it anew.
    #[test]
    fn the_reference_is_what_is_printed() {
        let kept = include_str!("../../docs/reference.md");
        assert!(kept == reference(), "docs/reference.md is not what `barrier-check explain --all` prints");
    }
}
