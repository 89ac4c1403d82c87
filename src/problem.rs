//! What is wrong with an input, said so that its author can mend it: where, what was found, what is allowed,
//! and a hint.

use std::fmt;

/// A position in a file, both counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    pub line: usize,
    pub column: usize,
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Key path such as `barrier.flexible_net.height`; empty for the file as a whole.
    pub path: String,
    pub position: Option<Position>,
    pub found: String,
    pub allowed: String,
    pub hint: Option<Box<str>>,
    /// Whether it is the second of two keys of that path.
    pub again: bool,
}

impl Problem {
    pub fn new(path: impl Into<String>, found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            position: None,
            found: found.into(),
            allowed: allowed.into(),
            hint: None,
            again: false,
        }
    }

    /// One whose place is told later, by [`Self::under`].
    pub fn of(found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self::new("", found, allowed)
    }

    pub fn under(self, path: impl Into<String>) -> Self {
        Self { path: path.into(), ..self }
    }

    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into().into_boxed_str());
        self
    }

    pub fn again(self) -> Self {
        Self { again: true, ..self }
    }

    pub fn at(mut self, position: Option<Position>) -> Self {
        self.position = position;
        self
    }
}

/// All that is wrong with one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems {
    /// The file's name as the user gave it.
    pub file: String,
    pub list: Vec<Problem>,
}

/// The same in one line.
fn in_a_line(text: &str) -> String {
    harmless(text).replace('\n', "\\n")
}

/// Text of a file as a terminal may show it: what would steer the terminal, or turn the text round, is made visible.
pub fn harmless(text: &str) -> String {
    let steers = |letter: char| {
        letter.is_control() && !"\n\t".contains(letter)
            || "\u{2028}\u{2029}".contains(letter)
            || "\u{061c}\u{200b}\u{200e}\u{200f}\u{feff}".contains(letter)
            || ('\u{e0000}'..='\u{e007f}').contains(&letter)
            || ('\u{202a}'..='\u{202e}').contains(&letter)
            || ('\u{2066}'..='\u{2069}').contains(&letter)
    };
    text.chars().map(|letter| if steers(letter) { '\u{fffd}' } else { letter }).collect()
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        self.write(&mut text)?;
        f.write_str(&harmless(&text))
    }
}

impl Problems {
    fn write(&self, f: &mut impl fmt::Write) -> fmt::Result {
        for problem in &self.list {
            write!(f, "error: {}", self.file)?;
            if let Some(Position { line, column }) = problem.position {
                write!(f, ":{line}:{column}")?;
            }
            if !problem.path.is_empty() {
                write!(f, ": {}", in_a_line(&problem.path))?;
            }
            writeln!(f, "\n  found:   {}", in_a_line(&problem.found))?;
            writeln!(f, "  allowed: {}", in_a_line(&problem.allowed))?;
            if let Some(hint) = &problem.hint {
                writeln!(f, "  hint:    {}", in_a_line(hint))?;
            }
        }
        let count = self.list.len();
        writeln!(f, "{count} problem{} in {}; nothing was run.", if count == 1 { "" } else { "s" }, self.file)
    }
}

impl std::error::Error for Problems {}

/// Problems of a file that are told at once.
pub const MOST_PROBLEMS: usize = 50;

fn digits(text: &str) -> String {
    text.chars().filter(char::is_ascii_digit).collect()
}

/// The nearest of `known` to a mistyped `word`, if any is near.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(word, candidate), candidate))
        // A number in a name is no slip of the hand: d16 is not d10.
        .filter(|(_, candidate)| {
            !word.contains(|letter: char| letter.is_ascii_digit()) || digits(word) == digits(candidate)
        })
        // Not every letter may be another.
        .filter(|(distance, candidate)| *distance <= 1 + candidate.len() / 8 && *distance < candidate.chars().count())
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}
