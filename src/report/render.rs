//! Templates to text.

use tera::{Context, Tera};

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
    let mut tera = Tera::default();
    tera.add_raw_templates(vec![("report.html", HTML), ("report.md", MARKDOWN)])?;
    let mut context = Context::new();
    context.insert("report", view);
    let html = tera.render("report.html", &context)?;
    let markdown = tera.render("report.md", &context)?;
    Ok(Rendered { html, markdown })
}
