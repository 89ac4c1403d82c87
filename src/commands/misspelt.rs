//! What arguments that cannot be read may have been meant for.

use std::path::Path;

use crate::problem::nearest;

/// A hint on `arguments` where a command of these `names` is misspelt, or comes after options that belong behind it.
pub fn meant(names: &[&str], arguments: &[String]) -> Option<String> {
    let words = || arguments.iter().filter(|argument| !argument.starts_with('-'));
    if let Some(late) = words().find(|word| names.contains(&word.as_str())) {
        let first = arguments.first().is_some_and(|first| first == late);
        return (!first).then(|| format!("`{late}` comes first, its options follow: barrier-check {late} ..."));
    }
    let word = words().next().filter(|word| !Path::new(word).exists())?;
    nearest(word, names.iter().copied()).map(|name| format!("did you mean `barrier-check {name}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_a_command_is_told() {
        let hint = |arguments: &[&str]| {
            meant(&["loads", "study"], &arguments.iter().map(ToString::to_string).collect::<Vec<_>>())
        };
        assert!(hint(&["load", "a.yaml"]).is_some_and(|hint| hint.contains("barrier-check loads")));
        assert!(hint(&["--threads", "1", "loads", "a.yaml"]).is_some_and(|hint| hint.contains("comes first")));
        assert_eq!(hint(&["loads", "--threds", "a.yaml"]), None);
        assert_eq!(hint(&["a.yaml", "b.yaml"]), None);
    }
}
