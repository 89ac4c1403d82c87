//! Templates to text.

use serde::Serialize;
use tera::{Context, Kwargs, State, Tera};

use crate::report::chart::PICTURE_STYLE;
use crate::report::view::View;

const HTML: &str = include_str!("../../templates/report.html");
const MARKDOWN: &str = include_str!("../../templates/report.md");

/// The two readable forms of a report.
pub struct Rendered {
    pub html: String,
    pub markdown: String,
}

/// Renders a view. Fails only if a template and the view do not fit, which a test guards.
pub fn render(view: &View) -> Result<Rendered, tera::Error> {
    render_as("report", view, [HTML, MARKDOWN])
}

/// Renders what the templates know as `name` in HTML, whose text is escaped, and Markdown, where texts that a person has written go
/// through the filter `md`.
pub fn render_as(name: &str, view: &impl Serialize, [html, markdown]: [&str; 2]) -> Result<Rendered, tera::Error> {
    let mut tera = Tera::default();
    tera.register_filter("md", |text: &str, _: Kwargs, _: &State| plain(text));
    tera.add_raw_templates(vec![("page.html", html), ("page.md", markdown)])?;
    let mut context = Context::new();
    context.insert("program", &Program::THIS);
    context.insert(name.to_string(), view);
    Ok(Rendered { html: tera.render("page.html", &context)?, markdown: tera.render("page.md", &context)? })
}

/// What every page tells of the program, and looks like.
#[derive(Serialize)]
struct Program {
    version: &'static str,
    commit: &'static str,
    page_style: &'static str,
    picture_style: &'static str,
}

impl Program {
    const THIS: Self = Self {
        version: env!("CARGO_PKG_VERSION"),
        commit: env!("BARRIER_CHECK_COMMIT"),
        page_style: include_str!("../../templates/page.css"),
        picture_style: PICTURE_STYLE,
    };
}

/// Text that Markdown shows as it was written: no markup, no table cell, no line ends where it is.
fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => plain.push_str("&amp;"),
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '\n' | '\r' => plain.push(' '),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' | '!' | '$' => plain.extend(['\\', letter]),
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn no_markup_comes_through() {
        assert_eq!(plain("<b>a|b</b>\n# *x* [y](z)"), "&lt;b&gt;a\\|b&lt;/b&gt; \\# \\*x\\* \\[y\\](z)");
        assert_eq!(plain("32 mm, K ρ g H"), "32 mm, K ρ g H");
    }
}
