//! The ground of a surveyed section, as the engine and its recorders take it.

use crate::design::Channel;
use crate::section::{Section, Survey};
use dem::recorders::across::{Across, GroundLine};
use dem::tables::surfaces::SurfaceRole;
use dem::tables::terrain::{Terrain, strips};

/// By which a vertical bank leans outwards in the model, over its height: facets have an extent seen from above.
const LEAN: f64 = 1e-4;
/// Rows of the table of areas.
const AREAS: usize = 1000;
/// How far the table goes, over the height of the higher end.
const BEYOND: f64 = 1.5;

/// Facets of the section from one place along the channel to another (m), friction (tan φ) by whether they are bed.
pub fn terrain(survey: &Survey, along: [f64; 2], friction: impl Fn(bool) -> f64) -> Terrain {
    let kinds: Vec<(SurfaceRole, f64)> = survey
        .strips()
        .map(|strip| (if strip.is_bed { SurfaceRole::Base } else { SurfaceRole::Side }, friction(strip.is_bed)))
        .collect();
    strips(&leaning(survey.points()), along, &kinds)
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
    let Some(survey) = &channel.survey else { return Across::Even(channel.width) };
    let section = Section::Surveyed(survey.clone());
    let highest = survey.points().iter().map(|point| point[1]).fold(0.0, f64::max);
    let height = |row: usize| BEYOND * highest * row as f64 / AREAS as f64;
    let areas = (0..=AREAS).map(|row| [height(row), section.area(height(row))]).collect();
    Across::Ground(GroundLine { points: survey.points().to_vec(), areas })
}

#[cfg(test)]
mod tests {
    use super::*;
    use dem::Vec3;

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

    #[test]
    fn the_table_of_areas_is_that_of_the_section() {
        let survey = Survey::new(&[[-7.0, 5.0], [-2.0, 0.0], [2.0, 0.0], [7.0, 5.0]], 0.0);
        let channel = Channel {
            width: 6.0,
            survey: Some(survey),
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
