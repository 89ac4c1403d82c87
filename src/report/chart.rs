//! A picture of the report: its title, its file, what is drawn and what is said of it.

use serde::Serialize;

use crate::report::plots::escape;

#[derive(Debug, Serialize)]
pub struct Chart {
    pub title: &'static str,
    /// Name of the picture's file beside the Markdown report.
    pub file: String,
    pub svg: String,
    pub note: String,
}

impl Chart {
    /// A picture whose file is called as its title is.
    pub fn of(title: &'static str, svg: String, note: impl Into<String>) -> Self {
        let note = note.into();
        Self { title, file: file_name(title), svg: labelled(&svg, title), note }
    }

    /// The picture as a file that stands alone.
    pub fn alone(&self) -> String {
        alone(&self.svg)
    }
}

/// The picture with its title as what is read out in its place.
pub fn labelled(svg: &str, title: &str) -> String {
    let Some((before, rest)) = svg.split_once("aria-label=\"") else { return svg.to_string() };
    let Some((_, after)) = rest.split_once('"') else { return svg.to_string() };
    format!("{before}aria-label=\"{}\"{after}", escape(title))
}

/// A picture of the page as a file that stands alone.
pub fn alone(svg: &str) -> String {
    let styled = svg.replacen("<svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"", 1);
    styled.replacen('>', &format!("><style>{PICTURE_STYLE}</style>"), 1) + "\n"
}

pub const PICTURE_STYLE: &str = include_str!("../../templates/pictures.css");

/// Name of the file of a picture with a title.
pub fn file_name(title: &str) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' };
    format!("{}.svg", title.replace('λ', "lambda").chars().map(letter).collect::<String>())
}
