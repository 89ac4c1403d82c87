//! The ground of a surveyed section, as the engine and its recorders take it.

use crate::design::Channel;
use crate::design::channel_entries::STEEPEST_BED;
use crate::relief::Relief;
use crate::section::{Section, Survey};
use crate::units::GRAVITY;
use dem::Vec3;
use dem::recorders::across::{Across, GroundLine, HeightGrid};
use dem::tables::surfaces::SurfaceRole;
use dem::tables::terrain::{Patch, Terrain, strips};

/// By which a vertical bank leans outwards in the model, over its height: facets have an extent seen from above.
const LEAN: f64 = 1e-4;
/// How far the first and the last reach of a bed are told (m).
const FAR: f64 = 1e4;
/// Rows of the table of areas.
const AREAS: usize = 1000;
/// How far the table goes, over the height of the higher end.
const BEYOND: f64 = 1.5;

/// Facets of the section from one place along an even bed to another (m), friction (tan φ) by whether they are bed.
pub fn terrain(survey: &Survey, along: [f64; 2], friction: impl Fn(bool) -> f64) -> Terrain {
    strips(&leaning(survey.points()), along, &kinds(survey, friction))
}

fn kinds(survey: &Survey, friction: impl Fn(bool) -> f64) -> Vec<(SurfaceRole, f64)> {
    let kind = |is_bed: bool| (if is_bed { SurfaceRole::Base } else { SurfaceRole::Side }, friction(is_bed));
    survey.strips().map(|strip| kind(strip.is_bed)).collect()
}

/// The ground of a channel from one place along it to another (m, in its frame).
pub fn ground_of(channel: &Channel, survey: &Survey, along: [f64; 2], friction: impl Fn(bool) -> f64) -> Terrain {
    if let Some(mesh) = &channel.mesh {
        return of_relief(channel, mesh, along, friction);
    }
    let Some(profile) = &channel.profile else { return terrain(survey, along, friction) };
    let corners = profile.corners().iter().map(|corner| corner[0]).filter(|x| *x > along[0] && *x < along[1]);
    let mut stations = vec![along[0]];
    stations.extend(corners);
    stations.push(along[1]);
    let points = leaning(survey.points());
    let plumb = libm::cos(channel.slope);
    let corner = |x: f64, [y, z]: [f64; 2]| frame_of(channel.slope, x, y, profile.elevation(x) + z / plumb);
    let places = stations.iter().flat_map(|x| points.iter().map(|point| corner(*x, *point))).collect();
    let kinds = kinds(survey, friction);
    let patch = |station: usize, strip: usize| {
        let first = (station * points.len() + strip) as u32;
        let next = first + points.len() as u32;
        let (role, friction) = kinds[strip];
        Patch { corners: vec![first, next, next + 1, first + 1], role, friction }
    };
    let patches: Vec<Patch> = (1..stations.len())
        .flat_map(|station| (0..kinds.len()).map(move |strip| (station - 1, strip)))
        .map(|(station, strip)| patch(station, strip))
        .collect();
    Terrain::new(places, &patches)
}

/// Slope across the gully up to which a piece of a raster is bed, the rest being bank (tan).
const BED: f64 = 0.466;

/// Two triangles to each cell of a raster, as far as it goes.
fn of_relief(channel: &Channel, relief: &Relief, along: [f64; 2], friction: impl Fn(bool) -> f64) -> Terrain {
    let rows: Vec<usize> = (0..relief.rows()).filter(|row| (along[0]..=along[1]).contains(&relief.x(*row))).collect();
    let columns = relief.columns();
    let corner = |row: usize, column: usize| {
        frame_of(channel.slope, relief.x(row), relief.y(column), relief.corner(row, column))
    };
    let places = rows.iter().flat_map(|row| (0..columns).map(|column| corner(*row, column))).collect();
    let mut patches = Vec::new();
    for (index, pair) in rows.windows(2).enumerate() {
        for column in 0..columns - 1 {
            let rise = |row: usize| relief.corner(row, column + 1) - relief.corner(row, column);
            let across = 0.5 * (rise(pair[0]) + rise(pair[1])) / (relief.y(column + 1) - relief.y(column));
            let is_bed = across.abs() <= BED;
            let role = if is_bed { SurfaceRole::Base } else { SurfaceRole::Side };
            let first = (index * columns + column) as u32;
            let next = first + columns as u32;
            for corners in [[first, next, next + 1], [first, next + 1, first + 1]] {
                patches.push(Patch { corners: corners.to_vec(), role, friction: friction(is_bed) });
            }
        }
    }
    Terrain::new(places, &patches)
}

/// The section of the ground at a distance along the bed from the foot (m), normal to the bed there, and the y of its lowest point.
pub fn survey_at(channel: &Channel, along: f64) -> Option<(Survey, f64)> {
    let (relief, profile) = (channel.relief.as_ref()?, channel.profile.as_ref()?);
    let there = profile.at(along);
    let upright = libm::cos(there.slope);
    // Of the gully alone: a hollow beside it, beyond a crest, is none of it.
    let lowest = relief.thalweg()[relief.nearest_row(there.x)];
    let mut heights = relief.across(there.x);
    for column in lowest + 1..heights.len() {
        heights[column] = heights[column].max(heights[column - 1]);
    }
    for column in (0..lowest).rev() {
        heights[column] = heights[column].max(heights[column + 1]);
    }
    let width = relief.y(relief.columns() - 1);
    // As it is listed: from the left to the right.
    let listed: Vec<[f64; 2]> =
        heights.iter().enumerate().rev().map(|(column, z)| [width - relief.y(column), z * upright]).collect();
    Some((Survey::new(&listed, STEEPEST_BED), relief.y(lowest)))
}

/// Where the lowest ground is across the channel at a distance along the bed (m).
pub fn lowest_at(channel: &Channel, along: f64) -> Option<f64> {
    let (relief, profile) = (channel.relief.as_ref()?, channel.profile.as_ref()?);
    let line = relief.thalweg();
    let [from, _] = relief.stretch();
    let step = relief.x(1) - relief.x(0);
    let place = ((profile.at(along).x - from) / step).clamp(0.0, (relief.rows() - 1) as f64);
    let row = (place as usize).min(relief.rows() - 2);
    let [a, b] = [row, row + 1].map(|row| relief.y(line[row]));
    Some(a + (b - a) * (place - row as f64))
}

/// The ground along a channel as flat pieces with three or four corners each, from one place to another (m).
pub fn pieces(channel: &Channel, along: [f64; 2]) -> Vec<Vec<Vec3>> {
    let survey = channel.ground().unwrap_or_else(|| Survey::between_walls(channel.width, channel.wall_height));
    let terrain = ground_of(channel, &survey, along, |_| 0.0);
    (0..terrain.facets().len() as u32).map(|facet| terrain.outline(facet).collect()).collect()
}

/// The place of the ground at a distance along the bed from the barrier's foot and across the channel (m).
pub fn height_at(channel: &Channel, along: f64, across: f64) -> Vec3 {
    let own = channel.ground_at(across);
    let Some(profile) = &channel.profile else { return Vec3::new(along, across, own) };
    let there = profile.at(along);
    let plumb = match &channel.relief {
        Some(relief) => {
            let heights = relief.across(there.x);
            let step = relief.y(1) - relief.y(0);
            let place = ((across - relief.y(0)) / step).clamp(0.0, (heights.len() - 1) as f64);
            let column = (place as usize).min(heights.len() - 2);
            heights[column] + (heights[column + 1] - heights[column]) * (place - column as f64)
        }
        None => there.z + own / libm::cos(channel.slope),
    };
    frame_of(channel.slope, there.x, across, plumb)
}

/// The place of the bed at a distance along it from the foot (m), and the directions down the bed and out of it there.
pub fn bed_at(channel: &Channel, along: f64) -> (Vec3, [Vec3; 2]) {
    let Some(profile) = &channel.profile else { return (Vec3::x() * along, [Vec3::x(), Vec3::z()]) };
    let there = profile.at(along);
    // Steeper than at the barrier, it goes down in the frame.
    let (sine, cosine) = libm::sincos(there.slope - channel.slope);
    let directions = [Vec3::new(cosine, 0.0, -sine), Vec3::new(sine, 0.0, cosine)];
    (frame_of(channel.slope, there.x, 0.0, there.z), directions)
}

/// A place of the channel frame: from the level distance downstream of the foot, that across, and the plumb height over the foot (m).
pub fn frame_of(slope: f64, level: f64, across: f64, plumb: f64) -> Vec3 {
    let (sine, cosine) = libm::sincos(slope);
    Vec3::new(level * cosine - plumb * sine, across, level * sine + plumb * cosine)
}

/// Gravity in the frame of a channel on a slope (m/s²).
pub fn gravity(slope: f64) -> Vec3 {
    Vec3::new(GRAVITY * libm::sin(slope), 0.0, -GRAVITY * libm::cos(slope))
}

/// The points with every vertical bank leaning outwards a little.
fn leaning(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let deepest = points.iter().position(|point| point[1] <= 0.0).unwrap_or(0);
    let mut leaning = points.to_vec();
    let outwards = |from: [f64; 2], to: [f64; 2], moved: f64| match to[0] == from[0] {
        true => moved + LEAN * (to[1] - from[1]).abs(),
        false => moved,
    };
    let mut moved = 0.0;
    for index in deepest + 1..points.len() {
        moved = outwards(points[index - 1], points[index], moved);
        leaning[index][0] += moved;
    }
    moved = 0.0;
    for index in (0..deepest).rev() {
        moved = outwards(points[index + 1], points[index], moved);
        leaning[index][0] -= moved;
    }
    leaning
}

/// What recorders know of the section.
pub fn across(channel: &Channel) -> Across {
    let Some(survey) = channel.ground() else { return Across::Even(channel.width) };
    let section = Section::Surveyed(survey.clone());
    let bed = channel.profile.as_ref().map_or(Vec::new(), |profile| {
        let corners = profile.corners();
        let far = [corners[0][0] - FAR, corners[corners.len() - 1][0] + FAR].map(|x| [x, profile.elevation(x)]);
        [&far[..1], corners, &far[1..]].concat()
    });
    let highest = survey.points().iter().map(|point| point[1]).fold(0.0, f64::max);
    let height = |row: usize| BEYOND * highest * row as f64 / AREAS as f64;
    let areas = (0..=AREAS).map(|row| [height(row), section.area(height(row))]).collect();
    let grid = channel.mesh.as_ref().map(|relief| HeightGrid {
        first: [relief.x(0), relief.y(0)],
        step: relief.x(1) - relief.x(0),
        columns: relief.columns(),
        heights: (0..relief.rows())
            .flat_map(|row| (0..relief.columns()).map(move |column| relief.corner(row, column)))
            .collect(),
    });
    Across::Ground(GroundLine {
        grid,
        points: survey.points().to_vec(),
        areas,
        slope: channel.slope,
        bed,
        width: channel.width,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertical_banks_lean_outwards_and_the_rest_stays() {
        let survey = Survey::new(&[[0.0, 5.0], [0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [9.0, 5.0]], 0.1);
        let leaning = leaning(survey.points());
        assert_eq!(leaning[3..], [[9.0, 0.0], [9.0 + 5e-4, 5.0]]);
        assert_eq!(leaning[2], [3.0, 0.0]);
        assert!((leaning[1][0] - (3.0 - 4e-4)).abs() < 1e-12 && (leaning[0][0] + 4e-4).abs() < 1e-12);
    }

    #[test]
    fn bed_and_banks_have_their_roles_and_frictions() {
        let survey = Survey::new(&[[-7.0, 5.0], [-2.0, 0.0], [2.0, 0.0], [7.0, 5.0]], 0.0);
        let ground = terrain(&survey, [-10.0, 10.0], |is_bed| if is_bed { 0.5 } else { 0.2 });
        let seen: Vec<_> = ground.facets().iter().map(|facet| (facet.role, facet.friction)).collect();
        let [base, side] = [(SurfaceRole::Base, 0.5), (SurfaceRole::Side, 0.2)];
        assert_eq!(seen, [side, base, side]);
        assert_eq!(ground.facet(1).normal, Vec3::z());
    }

    /// 20° at the barrier and 10° from 5 m upstream on: the ground there is turned by 10° against the frame.
    #[test]
    fn a_bed_of_reaches_is_a_mesh_with_its_breaks() {
        let slope = 20_f64.to_radians();
        let survey = Survey::new(&[[-7.0, 5.0], [-2.0, 0.0], [2.0, 0.0], [7.0, 5.0]], 0.0);
        let profile = crate::profile::Profile::new(slope, &[[5.0, 10_f64.to_radians()]], &[], 0.0);
        let channel = Channel {
            width: 6.0,
            survey: Some(survey.clone()),
            profile: Some(profile),
            relief: None,
            mesh: None,
            slope,
            wall_height: 5.0,
            base_friction: 0.4,
            side_friction: 0.4,
            barrier_friction: 0.4,
        };
        let ground = ground_of(&channel, &survey, [-30.0, 10.0], |_| 0.4);
        // Three reaches of facets (the foot is a corner), three strips each.
        assert_eq!(ground.facets().len(), 9);
        let turned = 10_f64.to_radians();
        let expected = Vec3::new(-libm::sin(turned), 0.0, libm::cos(turned));
        assert!((ground.facet(1).normal - expected).norm() < 1e-9, "{}", ground.facet(1).normal);
        assert!((ground.facet(4).normal - Vec3::z()).norm() < 1e-9);
        let Across::Ground(line) = across(&channel) else { panic!("ground") };
        // A metre over the bed 10 m upstream, level, and half a metre over the bank there.
        let bed = 5.0 * libm::tan(slope) + 5.0 * libm::tan(turned);
        for (y, over) in [(7.0, 1.0), (3.0, 0.5)] {
            let bank = if y == 3.0 { 2.0 / libm::cos(slope) } else { 0.0 };
            let (clear, _) = Across::Ground(line.clone()).clearance(&frame_of(slope, -10.0, y, bed + bank + over));
            assert!((clear - over * libm::cos(slope)).abs() < 1e-9, "{y}: {clear}");
        }
    }

    #[test]
    fn the_table_of_areas_is_that_of_the_section() {
        let survey = Survey::new(&[[-7.0, 5.0], [-2.0, 0.0], [2.0, 0.0], [7.0, 5.0]], 0.0);
        let channel = Channel {
            width: 6.0,
            survey: Some(survey),
            profile: None,
            relief: None,
            mesh: None,
            slope: 0.3,
            wall_height: 5.0,
            base_friction: 0.4,
            side_friction: 0.4,
            barrier_friction: 0.4,
        };
        // 1.5 m deep: 4 · 1.5 + 1.5².
        let depth = across(&channel).depth_of(8.25 * 1000.0, 1000.0, 1.0);
        assert!((depth - 1.5).abs() < 1e-4, "{depth}");
    }
}
