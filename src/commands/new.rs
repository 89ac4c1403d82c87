//! `barrier-check new FILE`: asks ten questions, or takes their answers from flags, and writes a commented design that runs at once.

use std::io::{BufRead, IsTerminal, Write};
use std::path::{Path, PathBuf};

use crate::commands::{ExitCode, Failure, input};
use crate::design::entries::Purpose;
use crate::design::read::read_design_for;
use crate::new_design::{Beside, QUESTIONS, Question, text};
use crate::terminal;
use crate::units::{Dimension, parse};

/// What is given on the command line.
#[derive(Clone, Debug)]
pub struct Given {
    pub file: PathBuf,
    /// In the order of the questions.
    pub answers: [Option<String>; 10],
    pub density: String,
    pub factors: String,
    pub kit: Option<String>,
}

/// Writes the design, unless a file stands there or the answers make no design.
pub fn new(given: &Given) -> ExitCode {
    match written(given) {
        Ok(()) => ExitCode::Pass,
        Err(error) => {
            terminal::warn(error.to_string().trim_end());
            ExitCode::Undecided
        }
    }
}

fn written(given: &Given) -> Result<(), Failure> {
    let file = &given.file;
    if file.as_os_str() == "-" {
        return Err("error: `-` is no name of a file; name the one that the design is to be written to".into());
    }
    if file.symlink_metadata().is_ok() {
        return Err(format!("error: {} is there already; name another file", file.display()).into());
    }
    flags_are_sound(given)?;
    let answers = asked(given)?;
    let name = input::name_of(file);
    let beside = Beside { file: &name, density: &given.density, factors: &given.factors, kit: given.kit.as_deref() };
    let design = text(&answers, beside)?;
    read_design_for(Purpose::Simulation, &name, design.as_bytes(), &|other| input::beside(file, other))
        .map_err(|problems| format!("{problems}No design was written: answer otherwise."))?;
    create(file, &design).map_err(|error| format!("error: {name} could not be written: {error}"))?;
    terminal::say(format_args!(
        "{name} is written. Replace what is marked CHECK, then run `barrier-check loads {name}` and `barrier-check {name}`."
    ));
    Ok(())
}

/// All that is wrong with the flags, at once.
fn flags_are_sound(given: &Given) -> Result<(), Failure> {
    let mut wrong: Vec<String> = QUESTIONS
        .iter()
        .zip(&given.answers)
        .filter_map(|(question, answer)| {
            let [found, allowed] = question.wrong(answer.as_ref()?)?;
            Some(format!("error: --{}\n  found:   {found}\n  allowed: {allowed}", question.name))
        })
        .collect();
    if parse(&given.density, Dimension::Density).is_err() {
        wrong.push(format!(
            "error: --density\n  found:   `{}`\n  allowed: a density with unit ({})",
            given.density,
            Dimension::Density.symbols().join(", ")
        ));
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n").into()) }
}

/// The answers: those of the flags, and where somebody is there to ask, of the questions that these leave; else what is usual.
fn asked(given: &Given) -> Result<[String; 10], Failure> {
    let somebody = std::io::stdin().is_terminal();
    let mut answers = QUESTIONS.map(|question| question.usual.to_string());
    let mut taken = Vec::new();
    for ((question, flag), answer) in QUESTIONS.iter().zip(&given.answers).zip(&mut answers) {
        match flag {
            Some(flag) => answer.clone_from(flag),
            None if somebody => *answer = ask(question)?,
            None => taken.push(format!("--{} {}", question.name, question.usual)),
        }
    }
    if !taken.is_empty() {
        terminal::warn(format_args!("note: nobody is there to ask, so these are taken: {}", taken.join(", ")));
    }
    Ok(answers)
}

/// Asks until the answer is sound; an empty line is the usual answer.
fn ask(question: &Question) -> Result<String, Failure> {
    loop {
        terminal::say(format_args!("{} [{}]:", question.ask, question.usual));
        let mut line = String::new();
        if std::io::stdin().lock().read_line(&mut line)? == 0 {
            return Err("error: no more answers came; no design was written".into());
        }
        let answer = if line.trim().is_empty() { question.usual } else { line.trim() };
        match question.wrong(answer) {
            None => return Ok(answer.to_string()),
            Some([found, allowed]) => {
                terminal::warn(format_args!("  found:   {found}\n  allowed: {allowed}"));
            }
        }
    }
}

/// Makes the file, never over another and never by half.
fn create(path: &Path, text: &str) -> std::io::Result<()> {
    let mut file = std::fs::File::create_new(path)?;
    let written = file.write_all(text.as_bytes()).and_then(|()| file.sync_all());
    if written.is_err() {
        let _ = std::fs::remove_file(path);
    }
    written
}
