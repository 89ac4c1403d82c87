//! Bed, barrier and deposits along the channel, to scale, gravity downwards.

use std::fmt::Write;

use crate::loads::fill::Surface as Slope;
use crate::profile::Profile;

const WIDTH: f64 = 720.0;
const MARGIN: f64 = 12.0;
/// Length of a reach in the picture from which its slope is written beside it.
const SHORTEST_REACH: f64 = 40.0;
/// Height of the picture at the most.
const TALLEST: f64 = 420.0;
/// Room below the bed for the scale, and above for names.
const BELOW: f64 = 30.0;
const ABOVE: f64 = 22.0;
/// Bed drawn downstream of the barrier, over the height of the barrier.
const DOWNSTREAM: f64 = 1.5;
/// Least length drawn upstream of it, over the same.
const UPSTREAM: f64 = 4.0;

/// The surface of a deposit, from the barrier upstream.
pub struct Surface {
    pub name: String,
    /// Height at the barrier, normal to the bed (m).
    pub height: f64,
    pub slope: Slope,
    /// Level, from the foot to where it meets the bed (m).
    pub length: f64,
}

/// What is drawn.
pub struct LongProfile {
    /// Of the bed at the barrier (rad).
    pub slope: f64,
    pub profile: Profile,
    /// Top of the barrier over its foot: along the bed, and normal to it (m).
    pub top: [f64; 2],
    pub surfaces: Vec<Surface>,
}

impl LongProfile {
    /// Level and plumb, from what is along the bed and normal to it at the barrier.
    pub fn turned(&self, [along, normal]: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = libm::sincos(self.slope);
        [along * cosine + normal * sine, normal * cosine - along * sine]
    }

    /// From where to where along the channel it is drawn, level, from the barrier's foot (m).
    pub fn stretch(&self) -> [f64; 2] {
        let tall = self.turned(self.top)[1].abs().max(self.top[1]);
        let longest = self.surfaces.iter().map(|surface| surface.length).fold(UPSTREAM * tall, f64::max);
        [-1.05 * longest, DOWNSTREAM * tall]
    }

    /// Places of the bed between two others, its corners included.
    pub fn bed(&self, from: f64, to: f64) -> Vec<[f64; 2]> {
        let corners = self.profile.corners().iter().map(|corner| corner[0]).filter(|x| *x > from && *x < to);
        let mut places: Vec<f64> = corners.collect();
        places.insert(0, from);
        places.push(to);
        places.into_iter().map(|x| [x, self.profile.elevation(x)]).collect()
    }

    /// The surface from the barrier to where it meets the bed.
    pub fn surface(&self, surface: &Surface) -> Vec<[f64; 2]> {
        let lean = self.top[0] / self.top[1];
        let [x, z] = self.turned([lean * surface.height, surface.height]);
        let bed = self.bed(-surface.length, x.min(0.0));
        let mut line = vec![[x, z]];
        for pair in bed.windows(2).rev() {
            let [last_x, last_z] = line[line.len() - 1];
            let slope =
                libm::tan(surface.slope.slope(libm::atan((pair[0][1] - pair[1][1]) / (pair[1][0] - pair[0][0]))));
            line.push([pair[0][0], last_z + slope * (last_x - pair[0][0])]);
        }
        line
    }
}

pub fn long_profile(drawn: &LongProfile) -> String {
    let [top_x, top_z] = drawn.turned(drawn.top);
    let [left, right] = drawn.stretch();
    let bed = drawn.bed(left, right);
    let highest = bed.iter().map(|point| point[1]).fold(top_z, f64::max);
    let lowest = bed.iter().map(|point| point[1]).fold(0.0, f64::min);
    let scale = ((WIDTH - 2.0 * MARGIN) / (right - left)).min(TALLEST / (highest - lowest));
    let place = |[x, z]: [f64; 2]| [MARGIN + (x - left) * scale, ABOVE + (highest - z) * scale];
    let height = ABOVE + (highest - lowest) * scale + BELOW;
    let points = |line: &[[f64; 2]]| {
        let place = |point: &[f64; 2]| {
            let [x, y] = place(*point);
            format!("{x:.1},{y:.1}")
        };
        line.iter().map(place).collect::<Vec<_>>().join(" ")
    };
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"bed, barrier and deposits along the channel\">"
    );
    for surface in &drawn.surfaces {
        let mut outline = drawn.surface(surface);
        outline.extend(drawn.bed(-surface.length, 0.0).into_iter().skip(1));
        let _ = write!(svg, "<polygon class=\"deposit\" points=\"{}\"/>", points(&outline));
    }
    let _ = write!(svg, "<polyline class=\"bed\" fill=\"none\" points=\"{}\"/>", points(&bed));
    let ([x1, y1], [x2, y2]) = (place([0.0, 0.0]), place([top_x, top_z]));
    let _ = write!(svg, "<line class=\"wall\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>");
    svg += &reaches(drawn, [left, right], &place);
    // Names one below the other above the barrier, each with a line to its surface.
    for (index, surface) in drawn.surfaces.iter().enumerate() {
        let line = drawn.surface(surface);
        let [x, y] = place(point_at(&line, -0.6 * surface.length));
        let _ = write!(
            svg,
            "<polyline class=\"leader\" points=\"{x:.1},{y:.1} {:.1},{:.1}\"/><text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            WIDTH - 300.0,
            14.0 + 15.0 * index as f64,
            WIDTH - 296.0,
            18.0 + 15.0 * index as f64,
            super::escape(&surface.name)
        );
    }
    svg + &super::scale_bar(MARGIN, height - 10.0, scale, 0.25 * WIDTH) + "</svg>"
}

/// Slopes under the bed of its reaches, where they are long enough to be told apart.
fn reaches(drawn: &LongProfile, [left, right]: [f64; 2], place: &dyn Fn([f64; 2]) -> [f64; 2]) -> String {
    let bed = drawn.bed(left, right);
    let mut svg = String::new();
    for pair in bed.windows(2) {
        let [from, to] = [place(pair[0]), place(pair[1])];
        if to[0] - from[0] < SHORTEST_REACH {
            continue;
        }
        let slope = libm::atan((pair[0][1] - pair[1][1]) / (pair[1][0] - pair[0][0])).to_degrees();
        let [x, y] = [0, 1].map(|axis| 0.5 * (from[axis] + to[axis]));
        let _ = write!(svg, "<text text-anchor=\"end\" x=\"{:.1}\" y=\"{:.1}\">{slope:.1}°</text>", x - 4.0, y + 15.0);
    }
    svg
}

/// The point of a line that goes upstream at a level place.
fn point_at(line: &[[f64; 2]], x: f64) -> [f64; 2] {
    let pair = line.windows(2).find(|pair| pair[1][0] <= x);
    let Some([from, to]) = pair.map(|pair| [pair[0], pair[1]]) else { return line[line.len() - 1] };
    [x, from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0])]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plumb barrier of 3 m on 20°: its level deposit ends 3/tan 20° = 8.24 m upstream.
    #[test]
    fn a_level_deposit_ends_where_it_meets_the_bed() {
        let slope = 20_f64.to_radians();
        let normal = 3.0 * libm::cos(slope);
        let drawn = LongProfile {
            slope,
            profile: Profile::new(slope, &[], &[], 0.0),
            top: [-3.0 * libm::sin(slope), normal],
            surfaces: vec![Surface {
                name: "level".into(),
                height: normal,
                slope: Slope::Plane(0.0),
                length: 3.0 / libm::tan(slope),
            }],
        };
        let svg = long_profile(&drawn);
        let points = svg.split("class=\"deposit\" points=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
        let x: Vec<f64> = points.split(' ').map(|pair| pair.split(',').next().unwrap().parse().unwrap()).collect();
        let y: Vec<f64> = points.split(' ').map(|pair| pair.split(',').nth(1).unwrap().parse().unwrap()).collect();
        assert!((y[0] - y[1]).abs() < 0.2);
        let ratio = (x[0] - x[1]) / (y[2] - y[0]);
        assert!((ratio - 1.0 / libm::tan(slope)).abs() < 0.02, "{ratio}");
    }
}
