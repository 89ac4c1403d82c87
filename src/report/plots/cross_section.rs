//! The barrier in the section of its channel, to scale, looking downstream.

use std::fmt::Write;

const WIDTH: f64 = 720.0;
const MARGIN: f64 = 12.0;
/// Room at the right for the labels of the ropes.
const LABELS: f64 = 152.0;
/// Width of a letter, about, and of what leads to a label.
const LETTER: f64 = 6.3;
const LEADER: f64 = 17.0;
/// Room above for the width at the top, and below for the width of the bed and the scale.
const ABOVE: f64 = 30.0;
const BELOW: f64 = 54.0;
/// Ground drawn below the lowest point, over the height of the picture.
const UNDER: f64 = 0.06;
/// Room that the name of a surface takes.
const NAME: f64 = 90.0;
/// Least distance between two labels.
const LABEL_STEP: f64 = 14.0;

/// A horizontal member from bank to bank.
pub struct Member {
    pub label: String,
    /// Plumb height over the lowest point of the bed, and where it ends, to the right (m).
    pub height: f64,
    pub ends: [f64; 2],
    /// How far behind its ends it is anchored (m), where it is.
    pub anchored: Option<[f64; 2]>,
    /// Its line where it is not straight.
    pub line: Vec<[f64; 2]>,
}

/// A ring of a net.
pub enum Ring {
    Whole { middle: [f64; 2], diameter: f64 },
    Cut { contacts: Vec<[f64; 2]> },
}

/// What is drawn; distances to the right and plumb heights (m).
pub struct CrossSection {
    pub ground: Vec<[f64; 2]>,
    pub members: Vec<Member>,
    /// Foot and head of each post.
    pub posts: Vec<[[f64; 2]; 2]>,
    /// Outline of what closes the section: net or wall.
    pub outline: Vec<[f64; 2]>,
    /// Its rings, if it is a ring net.
    pub rings: Vec<Ring>,
    /// Where the bed begins and ends.
    pub bed: [f64; 2],
    /// Level surfaces with their names.
    pub surfaces: Vec<(String, f64)>,
}

pub fn cross_section(drawn: &CrossSection) -> String {
    let top = drawn.outline.iter().map(|point| point[1]).fold(0.0, f64::max);
    let highest_ground = drawn.ground.iter().map(|point| point[1]).fold(top, f64::max).min(1.4 * top);
    let visible: Vec<[f64; 2]> = cut(&drawn.ground, highest_ground);
    let anchors = || drawn.members.iter().flat_map(|member| heads(member).into_iter().map(|(place, ..)| place));
    let left = anchors().fold(visible[0][0], f64::min);
    let right = anchors().fold(visible[visible.len() - 1][0], f64::max);
    let longest = drawn.members.iter().map(|member| member.label.chars().count()).max().unwrap_or(0);
    let labels_take = LABELS.max(LEADER + LETTER * longest as f64);
    let scale = (WIDTH - 2.0 * MARGIN - labels_take) / (right - left);
    let height = highest_ground * scale;
    let foot = ABOVE + height;
    let x = |across: f64| MARGIN + (across - left) * scale;
    let y = |up: f64| foot - up * scale;
    let under = foot + UNDER * height + 6.0;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {:.0}\" role=\"img\" aria-label=\"barrier in the section of its channel\">",
        under + BELOW
    );
    let points = |list: &[[f64; 2]]| {
        list.iter().map(|point| format!("{:.1},{:.1}", x(point[0]), y(point[1]))).collect::<Vec<_>>().join(" ")
    };
    let _ = write!(
        svg,
        "<polygon class=\"earth\" points=\"{} {:.1},{under:.1} {:.1},{under:.1}\"/><polygon class=\"closed\" points=\"{}\"/>",
        points(&visible),
        x(right),
        x(left),
        points(&drawn.outline)
    );
    for ring in &drawn.rings {
        let _ = match ring {
            Ring::Whole { middle, diameter } => write!(
                svg,
                "<circle class=\"net-ring\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"{:.1}\"/>",
                x(middle[0]),
                y(middle[1]),
                0.5 * diameter * scale
            ),
            Ring::Cut { contacts } => write!(svg, "<polygon class=\"net-ring\" points=\"{}\"/>", points(contacts)),
        };
    }
    // A name stands over its line unless a member runs through it there.
    let hidden =
        |surface: f64| drawn.members.iter().any(|member| (-4.0..18.0).contains(&((member.height - surface) * scale)));
    for (name, surface) in &drawn.surfaces {
        let (from, to) = ends_at(&visible, *surface);
        // In the ground beside it, where there is room.
        let beside = x(from) - MARGIN > NAME;
        let _ = write!(
            svg,
            "<line class=\"level\" x1=\"{:.1}\" x2=\"{:.1}\" y1=\"{3:.1}\" y2=\"{3:.1}\"/><text text-anchor=\"{5}\" x=\"{2:.1}\" y=\"{4:.1}\">{name}</text>",
            x(from),
            x(to),
            if beside { x(from) - 5.0 } else { x(from) + 5.0 },
            y(*surface),
            if !beside && hidden(*surface) { y(*surface) + 13.0 } else { y(*surface) - 3.0 },
            if beside { "end" } else { "start" }
        );
    }
    for member in &drawn.members {
        let up = y(member.height);
        let straight = member.ends.map(|end| [end, member.height]);
        let line = if member.line.is_empty() { &straight[..] } else { &member.line };
        let _ = write!(svg, "<polyline class=\"rope\" points=\"{}\"/>", points(line));
        for (place, end, behind) in heads(member) {
            let [place, end] = [place, end].map(x);
            if behind > 0.0 {
                let _ = write!(
                    svg,
                    "<line class=\"behind\" x1=\"{end:.1}\" x2=\"{place:.1}\" y1=\"{up:.1}\" y2=\"{up:.1}\"/>"
                );
            }
            let _ = write!(svg, "<circle class=\"anchor\" cx=\"{place:.1}\" cy=\"{up:.1}\" r=\"3.5\"/>");
        }
    }
    svg += &posts(&drawn.posts, &x, &y);
    svg += &labels(drawn, &y, x(right));
    let widest = drawn.members.iter().map(|member| member.ends).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    if let Some([from, to]) = widest {
        svg += &dimension([x(from), x(to)], 18.0, &format!("{:.2} m", to - from));
    }
    let bed = drawn.bed[1] - drawn.bed[0];
    if bed * scale > 4.0 {
        svg += &dimension(drawn.bed.map(x), under + 20.0, &format!("bed {bed:.2} m"));
    }
    svg + &super::scale_bar(MARGIN, under + BELOW - 10.0, scale, 0.2 * WIDTH) + "</svg>"
}

/// Heads of the ground anchors of a member, each with the end that it holds and how far behind it is.
fn heads(member: &Member) -> Vec<(f64, f64, f64)> {
    let Some([left, right]) = member.anchored else { return Vec::new() };
    let [from, to] = member.ends;
    vec![(from - left, from, left), (to + right, to, right)]
}

/// Posts from foot to head, with their numbers.
fn posts(posts: &[[[f64; 2]; 2]], x: &dyn Fn(f64) -> f64, y: &dyn Fn(f64) -> f64) -> String {
    let mut svg = String::new();
    for (number, [foot, head]) in posts.iter().enumerate() {
        let _ = write!(
            svg,
            "<line class=\"post\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/><circle class=\"foot\" cx=\"{0:.1}\" cy=\"{1:.1}\" r=\"4\"/><text text-anchor=\"middle\" x=\"{2:.1}\" y=\"{4:.1}\">post {5}</text>",
            x(foot[0]),
            y(foot[1]),
            x(head[0]),
            y(head[1]),
            y(head[1]) - 5.0,
            number + 1
        );
    }
    svg
}

/// Names of the members at the right, from the top down, each with a line to its end.
fn labels(drawn: &CrossSection, y: &dyn Fn(f64) -> f64, right: f64) -> String {
    let mut svg = String::new();
    let mut lowest = f64::NEG_INFINITY;
    for member in drawn.members.iter().rev() {
        let own = y(member.height);
        let place = own.max(lowest + LABEL_STEP);
        lowest = place;
        let _ = write!(
            svg,
            "<polyline class=\"leader\" points=\"{:.1},{own:.1} {:.1},{place:.1}\"/><text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            right + 2.0,
            right + 12.0,
            right + 15.0,
            place + 4.0,
            super::escape(&member.label)
        );
    }
    svg
}

/// A length between two places, with its number over the middle.
fn dimension([from, to]: [f64; 2], y: f64, text: &str) -> String {
    let mut svg = format!("<line class=\"dimension\" x1=\"{from:.1}\" x2=\"{to:.1}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>");
    for end in [from, to] {
        let _ = write!(
            svg,
            "<line class=\"dimension\" x1=\"{end:.1}\" x2=\"{end:.1}\" y1=\"{:.1}\" y2=\"{:.1}\"/>",
            y - 4.0,
            y + 4.0
        );
    }
    let _ =
        write!(svg, "<text text-anchor=\"middle\" x=\"{:.1}\" y=\"{:.1}\">{text}</text>", 0.5 * (from + to), y - 5.0);
    svg
}

/// The ground without what is higher than a height beyond its banks.
fn cut(ground: &[[f64; 2]], highest: f64) -> Vec<[f64; 2]> {
    let first = ground.iter().position(|point| point[1] < highest).unwrap_or(0);
    let last = ground.iter().rposition(|point| point[1] < highest).unwrap_or(ground.len() - 1);
    let crossing = |inside: [f64; 2], outside: [f64; 2]| {
        let share = (highest - inside[1]) / (outside[1] - inside[1]);
        [inside[0] + share * (outside[0] - inside[0]), highest]
    };
    let mut kept = Vec::new();
    if let Some(outside) = first.checked_sub(1) {
        kept.push(crossing(ground[first], ground[outside]));
    }
    kept.extend_from_slice(&ground[first..=last]);
    if let Some(outside) = ground.get(last + 1) {
        kept.push(crossing(ground[last], *outside));
    }
    kept
}

/// From where to where the ground is below a height.
fn ends_at(ground: &[[f64; 2]], height: f64) -> (f64, f64) {
    let below = cut(ground, height);
    (below[0][0], below[below.len() - 1][0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ground_is_cut_at_a_height() {
        let ground = [[-6.0, 4.0], [-2.0, 0.0], [2.0, 0.0], [6.0, 8.0]];
        assert_eq!(cut(&ground, 2.0), [[-4.0, 2.0], [-2.0, 0.0], [2.0, 0.0], [3.0, 2.0]]);
        assert_eq!(cut(&ground, 9.0), ground);
        assert_eq!(ends_at(&ground, 4.0), (-6.0, 4.0));
    }

    #[test]
    fn ropes_are_drawn_from_bank_to_bank_with_their_spans() {
        let drawn = CrossSection {
            ground: vec![[-6.0, 4.0], [-2.0, 0.0], [2.0, 0.0], [6.0, 4.0]],
            members: vec![
                Member {
                    label: "rope 1, 4.00 m".into(),
                    height: 0.0,
                    ends: [-2.0, 2.0],
                    anchored: None,
                    line: Vec::new(),
                },
                Member {
                    label: "rope 2, 8.00 m".into(),
                    height: 2.0,
                    ends: [-4.0, 4.0],
                    anchored: Some([0.0, 0.4]),
                    line: Vec::new(),
                },
            ],
            posts: vec![[[0.0, 0.0], [0.0, 2.0]]],
            outline: vec![[-2.0, 0.0], [2.0, 0.0], [4.0, 2.0], [-4.0, 2.0]],
            rings: vec![
                Ring::Whole { middle: [0.0, 1.0], diameter: 0.3 },
                Ring::Cut { contacts: vec![[2.0, 1.0], [2.2, 1.2], [2.1, 0.8]] },
            ],
            bed: [-2.0, 2.0],
            surfaces: vec![("flow".into(), 1.0)],
        };
        let svg = cross_section(&drawn);
        assert_eq!(svg.matches("class=\"anchor\"").count(), 2);
        assert_eq!(svg.matches("class=\"net-ring\"").count(), 2);
        assert_eq!((svg.matches("class=\"post\"").count(), svg.matches("class=\"behind\"").count()), (1, 1));
        for text in ["rope 2, 8.00 m", ">8.00 m<", "bed 4.00 m", ">flow<"] {
            assert!(svg.contains(text), "{text}");
        }
    }
}
