//! `drawing.dxf`: the barrier from upstream in its section, and along the channel, in metres, one unit to a metre, for a drawing program.

use dxf::entities::{Circle, Entity, EntityType, Line, LwPolyline, Text};
use dxf::enums::{AcadVersion, Units};
use dxf::tables::Layer;
use dxf::{Color, Drawing, DxfResult, LwPolylineVertex, Point};

use crate::pipeline::Run;
use crate::report::plots::cross_section::{CrossSection, Member, Ring};
use crate::report::plots::long_profile::LongProfile;
use crate::report::site::{profile_drawn, section_drawn};

/// Name of the file.
pub const FILE: &str = "drawing.dxf";

/// The layers and their colours by AutoCAD's index.
const LAYERS: [(&str, u8); 9] =
    [(GROUND, 8), (BARRIER, 30), (ROPES, 5), (RINGS, 4), (ANCHORS, 1), (POSTS, 6), (FLOW, 3), (DEPOSIT, 42), (TEXT, 7)];
const GROUND: &str = "GROUND";
/// What closes the section: the outline of the net or of the wall.
const BARRIER: &str = "BARRIER";
const ROPES: &str = "ROPES";
const RINGS: &str = "RINGS";
const ANCHORS: &str = "ANCHORS";
const POSTS: &str = "POSTS";
const FLOW: &str = "FLOW";
const DEPOSIT: &str = "DEPOSIT";
const TEXT: &str = "TEXT";

/// Height of letters, and size of an anchor's head, over the height of the barrier.
const LETTER: f64 = 0.05;
const HEAD: f64 = 0.02;
/// Room between the two drawings, over the height of the barrier.
const GAP: f64 = 1.5;

/// The bytes of the file.
pub fn dxf(run: &Run) -> DxfResult<Vec<u8>> {
    let mut sheet = Sheet::new(run.guideline.input.barrier_height);
    let section = section_drawn(run);
    sheet.title([section.bed[0], -4.0 * sheet.letter()], "Barrier in its section, looking downstream");
    across(&mut sheet, &section);
    let profile = profile_drawn(run);
    let right = section.ground.iter().map(|point| point[0]).fold(section.bed[1], f64::max);
    let [from, _] = profile.stretch();
    // Its own place to the right of the other, both at the height of the barrier's foot.
    sheet.origin = right + GAP * sheet.tall - from;
    sheet.title([from, -4.0 * sheet.letter()], "Bed and barrier along the channel");
    along(&mut sheet, &profile);
    let mut bytes = Vec::new();
    sheet.drawing.save(&mut bytes)?;
    Ok(bytes)
}

/// The drawing under way.
struct Sheet {
    drawing: Drawing,
    /// What the place 0 of the present part is drawn at (m).
    origin: f64,
    /// Height of the barrier (m), by which letters are as large as they should be.
    tall: f64,
}

impl Sheet {
    fn new(tall: f64) -> Self {
        let mut drawing = Drawing::new();
        drawing.header.version = AcadVersion::R2000;
        drawing.header.default_drawing_units = Units::Meters;
        for (name, colour) in LAYERS {
            drawing.add_layer(Layer { name: name.to_string(), color: Color::from_index(colour), ..Layer::default() });
        }
        Self { drawing, origin: 0.0, tall }
    }

    fn letter(&self) -> f64 {
        LETTER * self.tall
    }

    fn point(&self, [x, y]: [f64; 2]) -> Point {
        Point::new(self.origin + x, y, 0.0)
    }

    fn add(&mut self, layer: &str, what: EntityType) {
        let mut entity = Entity::new(what);
        entity.common.layer = layer.to_string();
        self.drawing.add_entity(entity);
    }

    fn line(&mut self, layer: &str, from: [f64; 2], to: [f64; 2]) {
        let line = Line::new(self.point(from), self.point(to));
        self.add(layer, EntityType::Line(line));
    }

    fn polyline(&mut self, layer: &str, points: &[[f64; 2]], closed: bool) {
        let vertex = |[x, y]: &[f64; 2]| LwPolylineVertex { x: self.origin + x, y: *y, ..LwPolylineVertex::default() };
        let mut line = LwPolyline { vertices: points.iter().map(vertex).collect(), ..LwPolyline::default() };
        line.set_is_closed(closed);
        self.add(layer, EntityType::LwPolyline(line));
    }

    fn circle(&mut self, layer: &str, middle: [f64; 2], radius: f64) {
        let circle = Circle::new(self.point(middle), radius);
        self.add(layer, EntityType::Circle(circle));
    }

    fn title(&mut self, place: [f64; 2], words: &str) {
        // Drawing programs of before 2007 know no other letters.
        let value = words.replace('×', "x").replace('³', "3").replace('–', "-");
        let text = Text { location: self.point(place), text_height: self.letter(), value, ..Text::default() };
        self.add(TEXT, EntityType::Text(text));
    }
}

fn across(sheet: &mut Sheet, drawn: &CrossSection) {
    let letter = sheet.letter();
    sheet.polyline(GROUND, &drawn.ground, false);
    sheet.polyline(BARRIER, &drawn.outline, true);
    for ring in &drawn.rings {
        match ring {
            Ring::Whole { middle, diameter } => sheet.circle(RINGS, *middle, 0.5 * diameter),
            Ring::Cut { contacts } => sheet.polyline(RINGS, contacts, true),
        }
    }
    for member in &drawn.members {
        rope(sheet, member);
    }
    for (number, [foot, head]) in (1..).zip(&drawn.posts) {
        sheet.line(POSTS, *foot, *head);
        sheet.title([head[0], head[1] + 0.5 * letter], &format!("post {number}"));
    }
    for (name, height) in &drawn.surfaces {
        let [from, to] = drawn.bed;
        sheet.line(FLOW, [from, *height], [to, *height]);
        sheet.title([from + letter, height + 0.3 * letter], name);
    }
}

/// A member with its anchors and its name behind its right end.
fn rope(sheet: &mut Sheet, member: &Member) {
    let (letter, head) = (sheet.letter(), HEAD * sheet.tall);
    let [from, to] = member.ends;
    match member.line.is_empty() {
        true => sheet.line(ROPES, [from, member.height], [to, member.height]),
        false => sheet.polyline(ROPES, &member.line, false),
    }
    let mut behind = to;
    if let Some([left, right]) = member.anchored {
        for (end, anchor) in [(from, from - left), (to, to + right)] {
            if anchor != end {
                sheet.line(ANCHORS, [end, member.height], [anchor, member.height]);
            }
            sheet.circle(ANCHORS, [anchor, member.height], head);
        }
        behind += right;
    }
    sheet.title([behind + letter, member.height], &member.label);
}

fn along(sheet: &mut Sheet, drawn: &LongProfile) {
    let letter = sheet.letter();
    let [from, to] = drawn.stretch();
    sheet.polyline(GROUND, &drawn.bed(from, to), false);
    let top = drawn.turned(drawn.top);
    sheet.line(BARRIER, [0.0, 0.0], top);
    sheet.title([top[0] + letter, top[1]], "barrier");
    for surface in &drawn.surfaces {
        let line = drawn.surface(surface);
        sheet.polyline(DEPOSIT, &line, false);
        let middle = line[line.len() / 2];
        sheet.title([middle[0], middle[1] + 0.5 * letter], &surface.name);
    }
}
