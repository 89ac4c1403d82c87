//! Contradictions between the values of a design's surges.

use crate::design::channel_entries::{section, survey};
use crate::design::entries::Entries;
use crate::design::flow_entries::size_curve_at;
use crate::design::hydrograph_entries::HYDROGRAPH;
use crate::design::show::length;
use crate::design::size_rules::{curve_has_two_quantiles_at, curve_increases_at, sizes_have_an_order_at};
use crate::design::surge_entries::{SURGES, surge, surges, volume_of};
use crate::problem::Problem;

/// The first problem that a rule finds with a surge.
fn any(e: &Entries, rule: impl Fn(&Entries, &str) -> Option<Problem>) -> Option<Problem> {
    surges(e).iter().find_map(|path| rule(e, path))
}

/// Of each surge of a list its volume is wanted, one way.
pub fn surges_have_one_size(e: &Entries) -> Option<Problem> {
    let listed = if e.has_list(SURGES) { surges(e) } else { Vec::new() };
    listed.iter().find_map(|path| {
        let typed = ["volume", "length"].map(|key| e.mentions(&format!("{path}.{key}")));
        let found = match typed {
            [true, true] => "both a volume and a length",
            [false, false] => "neither volume nor length",
            _ => return None,
        };
        Some(Problem::new(path, found, "either volume or length of each surge").hint("the depth gives the other"))
    })
}

/// The surges of a list have their own volumes, and so has a hydrograph.
pub fn surges_make_the_flow(e: &Entries) -> Option<Problem> {
    let typed = ["flow.mass", "flow.volume"].into_iter().find(|path| e.mentions(path))?;
    let (beside, hint) = match (e.has_list(SURGES), e.has_section(HYDROGRAPH)) {
        (true, _) => (
            "a list of surges",
            "each surge of flow.arrival.surges has a volume of its own, and the flow is all of them",
        ),
        (_, true) => {
            ("a hydrograph", "the volume of the flow is what the hydrograph brings, section times velocity over time")
        }
        _ => return None,
    };
    let found = format!("`{}` beside {beside}", e.typed(typed));
    Some(Problem::new(typed, found, "no mass or volume of the flow").hint(hint))
}

/// The first surge has nothing to wait for.
pub fn first_surge_comes_first(e: &Entries) -> Option<Problem> {
    let path = format!("{}.after", surge(0));
    e.mentions(&path).then(|| {
        Problem::new(
            &path,
            format!("`{}` of the first surge", e.typed(&path)),
            "a time for the second surge and later ones",
        )
        .hint("it is counted from the release of the surge before")
    })
}

pub fn surge_within_the_section(e: &Entries) -> Option<Problem> {
    let survey = survey(e)?;
    any(e, |e, path| {
        let path = format!("{path}.depth");
        let depth = e.number(&path)?;
        (depth > survey.lower_end()).then(|| {
            let found = format!(
                "a flow {} deep in a section whose lower bank ends at {}",
                length(depth),
                length(survey.lower_end())
            );
            Problem::new(path, found, "at most the height of the lower bank, normal to the bed")
        })
    })
}

pub fn surge_within_side_walls(e: &Entries) -> Option<Problem> {
    let wall = e.number("channel.wall_height")?;
    any(e, |e, path| {
        let path = format!("{path}.depth");
        let depth = e.number(&path)?;
        (depth > wall).then(|| {
            let found = format!("a flow {} deep between walls of {}", length(depth), length(wall));
            Problem::new(path, found, "at most channel.wall_height")
        })
    })
}

/// Grain sizes of a surge of the list are sound, and fit it.
pub fn surges_have_sound_sizes(e: &Entries) -> Option<Problem> {
    any(e, |e, path| {
        let sizes = format!("{path}.grain_sizes");
        sizes_have_an_order_at(e, &sizes)
            .or_else(|| curve_has_two_quantiles_at(e, &sizes))
            .or_else(|| curve_increases_at(e, &sizes))
    })
}

/// A later surge is a body of grains, deeper and longer than they are, and no wider grains than a third of the channel.
pub fn later_surges_larger_than_their_grains(e: &Entries) -> Option<Problem> {
    let section = section(e)?;
    surges(e).iter().skip(1).find_map(|path| {
        let sizes = format!("{path}.grain_sizes");
        let curve = size_curve_at(e, &sizes).or_else(|| size_curve_at(e, "flow.grain_sizes"))?;
        let (largest, depth) = (curve.quantile(1.0), e.number(&format!("{path}.depth"))?);
        let long = volume_of(e, path)? / section.area(depth);
        let width = section.width(depth);
        if depth.min(long) < 1.2 * largest {
            let found =
                format!("a surge {} long and {} deep of grains up to {}", length(long), length(depth), length(largest));
            return Some(Problem::new(path, found, "a surge longer and deeper than 1.2 times its largest grains"));
        }
        (3.0 * largest > width).then(|| {
            let found = format!("grains of {} in a channel {} wide", length(largest), length(width));
            Problem::new(path, found, "grains of at most a third of the channel's width")
        })
    })
}
