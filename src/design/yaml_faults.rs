//! What a YAML parser says of a text it cannot read, turned into the line where the fault is and its usual cause.

use crate::problem::{Position, Problem};

/// The problem behind a parser's `message` about `text`, which it gave up reading at `gave_up`.
pub fn explain(message: &str, gave_up: Option<Position>, text: &str) -> Problem {
    let said = message.split(" at line ").next().unwrap_or(message);
    // Where the parser began with what it could not finish is nearer to the fault than where it gave up.
    let began = message.rsplit_once(", while ").and_then(|(_, context)| mark_in(context));
    let started_before = ["expected ':'", "expected ',' or", "unexpected end of stream"];
    let position = match began {
        Some(began) if started_before.iter().any(|known| said.contains(known)) => Some(began),
        _ if said.contains("more than one document") => second_document(text).or_else(|| first_indented(text)),
        _ if said.contains("expected key") => gave_up.and_then(|place| without_a_colon_above(text, place)).or(gave_up),
        _ if said.contains("control characters") => control_character(text),
        _ => gave_up,
    };
    let line = position.and_then(|place| text.lines().nth(place.line - 1)).unwrap_or("");
    let [found, allowed] = found_and_allowed(said);
    let problem = Problem::new("", found, allowed);
    match cause(said, line, position) {
        Some(hint) => problem.hint(hint),
        None => problem,
    }
    .at(position)
}

/// Longest line that a hint repeats (characters).
const LONGEST_SHOWN: usize = 200;

/// The usual cause of what a parser said of a line.
fn cause(said: &str, line: &str, position: Option<Position>) -> Option<String> {
    let content = without_comment(line).trim();
    if content.chars().count() > LONGEST_SHOWN {
        return None;
    }
    let (key, value) = content.split_once(':').unwrap_or((content, ""));
    let value = value.trim();
    Some(match said {
        _ if said.contains("tab character") => "indent with spaces: the line is indented with a tab".to_string(),
        _ if said.contains("expected ':'") => match content.split_once(':') {
            Some((key, value)) => format!("put a space after the colon: `{key}: {}`", value.trim()),
            None => without_a_colon(content),
        },
        _ if said.contains("mapping values are not allowed") && value.contains(": ") => {
            format!("a value that holds a colon needs quotes: `{key}: {}`", quoted(value))
        }
        _ if said.contains("mapping values are not allowed") => {
            format!(
                "the keys of a group begin in one column: `{key}` is indented more than the line above it, or that line lacks its colon"
            )
        }
        _ if said.contains("expected key") => where_a_key_belongs(content, key, value),
        _ if said.contains("cannot start any token") || said.contains("alphabetic or numeric character") => {
            let first = value.chars().next().unwrap_or(' ');
            format!("a text that begins with `{first}` needs quotes: `{key}: {}`", quoted(value))
        }
        _ if said.contains("expected ',' or") => {
            let open =
                position.and_then(|place| line.chars().nth(place.column - 1)).filter(|open| "[{".contains(*open));
            let open = open.unwrap_or(if said.contains('}') { '{' } else { '[' });
            format!(
                "the bracket `{open}` that is opened here is not closed as it should be; a text that begins with one needs quotes"
            )
        }
        _ if said.contains("unexpected end of stream") => {
            "the quotation mark that is opened here is not closed".to_string()
        }
        _ if said.contains("more than one document") && line.starts_with([' ', '\t']) => {
            format!("the keys of a group begin in one column: `{key}` is indented otherwise than those below it")
        }
        _ if said.contains("more than one document") => {
            "a design file holds one design: leave out the line `---` and what follows it".to_string()
        }
        _ if said.contains("unknown anchor") => {
            format!(
                "`*` repeats what was named with `&` further up, and nothing was: a text that begins with it needs quotes, `{key}: \"{value}\"`"
            )
        }
        _ if said.contains("unknown escape") => {
            format!(
                "between double quotation marks a backslash begins a special character: use single ones, `{key}: '{}'`",
                value.trim_matches('"')
            )
        }
        _ if said.contains("invalid type: enum") => {
            format!(
                "a value that begins with `!` is a tag, which no key of a design takes; a text that does needs quotes: `{key}: {}`",
                quoted(value)
            )
        }
        _ if said.contains("invalid type: integer") => "no number of a design has so many digits".to_string(),
        _ if said.contains("control characters") => {
            "the file holds a character that no text has: is it text, and saved as UTF-8?".to_string()
        }
        _ => return None,
    })
}

/// The same where a key of a group was expected.
fn where_a_key_belongs(content: &str, key: &str, value: &str) -> String {
    match content {
        _ if content.starts_with("- ") => {
            format!("a dash begins an item of a list; a key has none: `{}`", content.trim_start_matches("- "))
        }
        _ if !content.contains(':') => without_a_colon(content),
        _ if beyond_its_end(value, ["\"\"", "''"]) => {
            format!("the whole value stands between the quotation marks: `{key}: \"{}\"`", value.replace('"', "'"))
        }
        _ if beyond_its_end(value, ["[]", "{}"]) => {
            "the bracket that is closed here ends the value; in a list each item has its own unit, as in `[0 m, 0.5 m]`"
                .to_string()
        }
        _ => format!("the keys of a group begin in one column: `{key}` is indented otherwise than those above it"),
    }
}

fn without_a_colon(content: &str) -> String {
    match content.split_once(' ') {
        Some((key, value)) => format!("a key is followed by a colon: `{key}: {}`", value.trim()),
        None => format!("a key is followed by a colon: `{content}:`"),
    }
}

/// A value between quotation marks that leave it as it is: a backslash means something between double ones.
fn quoted(value: &str) -> String {
    if value.contains('\\') {
        format!("'{}'", value.replace('\'', "''"))
    } else {
        format!("\"{}\"", value.replace('"', "'"))
    }
}

/// Whether a value begins with the first of a pair of marks and goes on behind the second.
fn beyond_its_end(value: &str, pairs: [&str; 2]) -> bool {
    pairs.iter().any(|pair| {
        let inside = value.strip_prefix(&pair[..1]);
        inside.and_then(|inside| inside.split_once(&pair[1..])).is_some_and(|(_, behind)| !behind.trim().is_empty())
    })
}

/// What is found and what is allowed: of values that no design has in the words of the reader.
fn found_and_allowed(said: &str) -> [String; 2] {
    let found = match said {
        _ if said.contains("invalid type: integer") => "a whole number that is too large",
        _ if said.contains("invalid type: enum") => "a value with a tag",
        _ => {
            return [format!("text that is not YAML: {said}"), "YAML: `key: value` lines, indented with spaces".into()];
        }
    };
    [found.into(), "a text, a number, a list or a group of keys".into()]
}

/// Where the first control character stands: the parser tells only how many bytes come before it.
fn control_character(text: &str) -> Option<Position> {
    let forbidden = |letter: char| letter.is_control() && !"\n\r\t\u{85}".contains(letter);
    let mut lines = text.lines().enumerate();
    lines.find_map(|(line, text)| {
        let column = text.chars().position(forbidden)?;
        Some(Position { line: line + 1, column: column + 1 })
    })
}

/// `... at line 14 column 3`
fn mark_in(text: &str) -> Option<Position> {
    let (_, mark) = text.rsplit_once("at line ")?;
    let (line, column) = mark.split_once(" column ")?;
    let column: String = column.chars().take_while(char::is_ascii_digit).collect();
    Some(Position { line: line.parse().ok()?, column: column.parse().ok()? })
}

fn second_document(text: &str) -> Option<Position> {
    let written = |line: &str| !without_comment(line).trim().is_empty();
    let mut lines = text.lines().enumerate();
    lines.find(|(_, line)| written(line) && !line.starts_with("---"))?;
    let (index, _) = lines.find(|(_, line)| line.starts_with("---"))?;
    Some(Position { line: index + 1, column: 1 })
}

/// The first line that says something, where it is indented.
fn first_indented(text: &str) -> Option<Position> {
    let said = |(_, line): &(usize, &str)| !line.trim().is_empty() && !line.trim().starts_with('#');
    let (index, line) = text.lines().enumerate().find(said)?;
    let column = line.len() - line.trim_start().len();
    (column > 0).then_some(Position { line: index + 1, column: column + 1 })
}

/// The line above a place that says something, if it lacks the colon of a key.
fn without_a_colon_above(text: &str, place: Position) -> Option<Position> {
    let above: Vec<&str> = text.lines().take(place.line.checked_sub(1)?).collect();
    let index =
        above.iter().rposition(|line| !without_comment(line).trim().is_empty() && !line.trim().starts_with('#'))?;
    let line = without_comment(above[index]);
    let bare = !line.contains(':') && !line.trim().starts_with('-') && !line.contains(['"', '\'', '[', '{', ']', '}']);
    bare.then_some(Position { line: index + 1, column: line.len() - line.trim_start().len() + 1 })
}

fn without_comment(line: &str) -> &str {
    line.split_once(" #").map_or(line, |(content, _)| content)
}

#[cfg(test)]
mod tests {
    use crate::design::document::Document;
    use crate::design::read::KEYS;

    #[test]
    fn a_first_key_that_is_indented_is_told_and_no_dashes_that_are_not_there() {
        let problem = Document::parse(b"# a design\n project:\n  name: x\nchannel: y\n", KEYS).expect_err("a fault");
        assert_eq!(problem.position.map(|place| place.line), Some(2));
        let hint = problem.hint.unwrap_or_default();
        assert!(hint.contains("`project` is indented otherwise than those below it"), "{hint}");
    }

    #[test]
    fn the_fault_is_told_where_it_is_with_its_usual_cause() {
        let text = "channel:\n  width: 3 m\n  slope: 25 deg\n  notes: none\n";
        let told = |from: &str, to: &str| {
            assert!(text.contains(from));
            let problem = Document::parse(text.replacen(from, to, 1).as_bytes(), KEYS).expect_err("a fault");
            (problem.position.map(|place| place.line), problem.hint.unwrap_or_default())
        };
        for (from, to, line, hint) in [
            ("slope: 25", "slope:25", 3, "put a space after the colon: `slope: 25 deg`"),
            ("slope: 25", "slope 25", 3, "a key is followed by a colon: `slope: 25 deg`"),
            ("width: 3 m", "width 3 m  # wide", 2, "a key is followed by a colon: `width: 3 m`"),
            ("  slope", "   slope", 3, "`slope` is indented more than the line above it"),
            ("  slope", " slope", 3, "`slope` is indented otherwise than those above it"),
            ("  slope", "  \tslope", 3, "indent with spaces"),
            ("  slope", "- slope", 3, "a key has none: `slope: 25 deg`"),
            ("none", "see: this", 4, "needs quotes: `notes: \"see: this\"`"),
            ("none", "see: C:\\temp", 4, "needs quotes: `notes: 'see: C:\\temp'`"),
            ("none", "@home", 4, "begins with `@` needs quotes: `notes: \"@home\"`"),
            ("none", "*bold*", 4, "begins with `*` needs quotes"),
            ("3 m", "\"3 m", 2, "the quotation mark that is opened here is not closed"),
            ("3 m", "[3 m", 2, "the bracket `[`"),
            ("none\n", "none\n---\na: 1\n", 5, "leave out the line `---`"),
            ("none", "\"see\" this", 4, "between the quotation marks: `notes: \"'see' this\"`"),
            ("3 m", "[3 m, 4 m] wide", 2, "in a list each item has its own unit"),
            ("3 m", "[3, 4] m", 2, "in a list each item has its own unit"),
            ("3 m", "*wide", 2, "nothing was: a text that begins with it needs quotes, `width: \"*wide\"`"),
            ("none", "\"C:\\qed\"", 4, "use single ones, `notes: 'C:\\qed'`"),
            ("none", "!important one", 4, "a text that does needs quotes: `notes: \"!important one\"`"),
            ("3 m", "99999999999999999999999", 2, "so many digits"),
            ("none", "n\u{0}ne", 4, "a character that no text has"),
            ("3 m", "3 m # wide\u{2028}", 2, "retype the blank there"),
            ("25 deg", "25 deg\u{85}", 3, "retype the blank there"),
            ("3 m", "3 m # as\rmeasured", 2, "retype the blank there"),
        ] {
            let (at, said) = told(from, to);
            assert_eq!(at, Some(line), "{to}: {said}");
            assert!(said.contains(hint), "{to}: {said}");
        }
    }
}
