//! Contradictions between what a design says of its posts and of the rest of its barrier.

use crate::design::channel_entries::{height_of_barrier, profile, section, survey};
use crate::design::entries::Entries;
use crate::design::posts::{OF_A_SECTION, RESISTANCES, post_key};
use crate::design::rope_entries::RETAINING;
use crate::design::rope_rules::is_described;
use crate::design::show::{at, length};
use crate::problem::Problem;
use crate::section::Section;

/// Most posts of one barrier.
const MOST_POSTS: usize = 20;

pub fn retaining_ropes_are_described(e: &Entries) -> Option<Problem> {
    is_described(e, RETAINING)
}

pub fn posts_stand_one_beside_the_other(e: &Entries) -> Option<Problem> {
    let (path, places) = (post_key("at"), e.numbers(&post_key("at"))?);
    if places.is_empty() || places.len() > MOST_POSTS {
        return Some(Problem::new(path, format!("{} places", places.len()), format!("1 to {MOST_POSTS} places")));
    }
    let pair = places.windows(2).find(|pair| pair[1] <= pair[0])?;
    Some(Problem::new(
        path,
        format!("{} after {}", length(pair[1]), length(pair[0])),
        "places that go from the left to the right, looking downstream",
    ))
}

/// Where the uppermost rope begins and ends, to the right looking downstream (m).
fn ends_of_the_top(e: &Entries) -> Option<[f64; 2]> {
    let top = height_of_barrier(e)?;
    match section(e)? {
        Section::Rectangle { width } => Some([-0.5 * width, 0.5 * width]),
        Section::Surveyed(_) => {
            let survey = survey(e)?;
            let [right, left] = survey.banks(top).map(|y| survey.surveyed(y));
            Some([left, right])
        }
    }
}

/// Posts stand between the banks, two ring spacings or more from each other and from the banks.
pub fn posts_stand_between_the_banks(e: &Entries) -> Option<Problem> {
    let (places, [left, right]) = (e.numbers(&post_key("at"))?, ends_of_the_top(e)?);
    let room = 2.0 * e.number(&at("main_ropes.rings.spacing"))?;
    let stops: Vec<f64> = [left].into_iter().chain(places.iter().copied()).chain([right]).collect();
    let [first, last] = [left + room, right - room];
    if let Some(outside) = places.iter().find(|place| **place < first || **place > last) {
        let found = format!("a post at {}", length(*outside));
        let allowed = format!(
            "{} to {}: two ring spacings, {}, from the ends of the uppermost rope",
            length(first),
            length(last),
            length(room)
        );
        let hint = match section(e)? {
            Section::Rectangle { .. } => {
                "places count from the middle of the channel, to the right looking downstream; those to the left are negative"
            }
            Section::Surveyed(_) => "places count like the points of the section, to the right looking downstream",
        };
        return Some(Problem::new(post_key("at"), found, allowed).hint(hint));
    }
    let pair = stops.windows(2).find(|pair| pair[1] > pair[0] && pair[1] - pair[0] < room)?;
    let found = format!("{} between {} and {}", length(pair[1] - pair[0]), length(pair[0]), length(pair[1]));
    let allowed = format!("two ring spacings, {}, or more between posts and to the banks", length(room));
    Some(Problem::new(post_key("at"), found, allowed))
}

/// Least height of a post over that of the barrier.
const LEAST_SHARE: f64 = 0.3;

pub fn posts_stand_on_low_ground(e: &Entries) -> Option<Problem> {
    let (places, survey, top) = (e.numbers(&post_key("at"))?, survey(e)?, height_of_barrier(e)?);
    let ground = |place: f64| survey.ground(survey.surveyed(0.0) - place);
    let short = places.iter().find(|place| top - ground(**place) < LEAST_SHARE * top)?;
    let found = format!("a post at {} whose ground is {} above the bed", length(*short), length(ground(*short)));
    let allowed = format!("posts of {} or more", length(LEAST_SHARE * top));
    Some(Problem::new(post_key("at"), found, allowed).hint("a bank so high carries the rope itself"))
}

/// Places along a retaining rope at which the ground is looked at, and by how much it may come above the rope (m): rounding.
const LOOKS: u32 = 40;
const ROUNDING: f64 = 1e-6;

/// A rope from a head to its anchor does not cut through a bank or a steeper reach of the bed.
pub fn retaining_ropes_run_clear_of_the_ground(e: &Entries) -> Option<Problem> {
    let (places, survey, top) = (e.numbers(&post_key("at"))?, survey(e), height_of_barrier(e)?);
    let slope = e.number("channel.slope")?;
    let rope = |name: &str| e.number(&at(&format!("{RETAINING}.{name}")));
    let (set_back, spread) = (rope("set_back")?, rope("spread")?);
    let lean = slope + e.number(&at("tilt"))?;
    let profile = profile(e);
    // Normal to the bed at the barrier.
    let ground = |along: f64, right: f64| {
        // Level between side walls.
        let own = survey.as_ref().map_or(0.0, |survey| survey.ground(survey.surveyed(0.0) - right));
        let Some(profile) = &profile else { return own };
        let bed = profile.at(along);
        let (sine, cosine) = libm::sincos(slope);
        bed.x * sine + bed.z * cosine + own
    };
    for place in places {
        let furthest = place.abs() + spread;
        if let (None, Some(width)) = (&survey, e.number("channel.width"))
            && furthest > 0.5 * width + ROUNDING
        {
            return Some(
                Problem::new(
                    format!("{}.spread", at(RETAINING)),
                    format!(
                        "an anchor of the post at {} that lies {} from the middle",
                        length(*place),
                        length(furthest)
                    ),
                    format!("anchors between the side walls, {} from the middle at the most", length(0.5 * width)),
                )
                .hint("a smaller spread, or the ground beyond the walls as a channel.section"),
            );
        }
        let tall = (top - ground(0.0, *place)) / libm::cos(lean);
        let head = [-libm::sin(lean) * tall, *place, top];
        for side in [spread, -spread] {
            let (along, right) = (-set_back, place + side);
            let anchor = [along, right, ground(along, right)];
            let through = |look: u32| {
                let share = f64::from(look) / f64::from(LOOKS);
                let [x, y, z] = [0, 1, 2].map(|axis| head[axis] + share * (anchor[axis] - head[axis]));
                ground(x, y) > z + ROUNDING
            };
            if (1..LOOKS).any(through) {
                let found =
                    format!("a rope from the head of the post at {} that runs through the ground", length(*place));
                return Some(
                    Problem::new(at(RETAINING), found, "ropes that are clear of the ground up to their anchors")
                        .hint("a smaller spread keeps them off the banks, a smaller set_back off a steeper bed"),
                );
            }
        }
    }
    None
}

/// The strength of a post is told one way, and wholly.
pub fn posts_have_one_strength(e: &Entries) -> Option<Problem> {
    let told = |names: &[&str]| names.iter().filter(|name| e.mentions(&post_key(name))).count();
    let [given, section] = [told(&RESISTANCES), told(&OF_A_SECTION)];
    let allowed = format!("`{}`, or `{}`", RESISTANCES.join("` and `"), OF_A_SECTION.join("`, `"));
    let found = match (given, section) {
        (0 | 2, 0) | (0, 3) => return None,
        (1.., 1..) => "resistances and properties of a section".to_string(),
        _ => {
            let all = if given > 0 { &RESISTANCES[..] } else { &OF_A_SECTION[..] };
            let missing: Vec<&str> = all.iter().copied().filter(|name| !e.mentions(&post_key(name))).collect();
            format!("no `{}`", missing.join("` and no `"))
        }
    };
    Some(
        Problem::new(at("posts"), found, allowed)
            .hint("without either the posts are simulated, and their check stays open"),
    )
}

/// No section about its weaker axis has a larger radius of gyration than half its width, and none twice as deep as wide a larger W/A than its
/// width.
pub fn posts_have_a_possible_section(e: &Entries) -> Option<Problem> {
    let value = |name: &str| e.number(&post_key(name));
    let (width, area) = (value("width")?, value("area")?);
    let hint = "look at the units of width, area and of the properties of the section";
    if let Some(radius) = value(OF_A_SECTION[0]).filter(|radius| *radius > 0.5 * width) {
        let found = format!("{} in a post {} wide", length(radius), length(width));
        let allowed = format!("at most half the width, {}", length(0.5 * width));
        return Some(Problem::new(post_key(OF_A_SECTION[0]), found, allowed).hint(hint));
    }
    let modulus = value(OF_A_SECTION[1]).filter(|modulus| *modulus > area * width)?;
    let show = |value: f64| format!("{:.0} cm3", value * 1e6);
    let allowed = format!("at most area times width, {}", show(area * width));
    Some(Problem::new(post_key(OF_A_SECTION[1]), show(modulus), allowed).hint(hint))
}

pub fn posts_belong_to_models_of_ropes(e: &Entries) -> Option<Problem> {
    let cylinders = e.text("simulation.barrier_model") == Some("cylinders");
    (e.has_section(&at("posts")) && cylinders).then(|| {
        Problem::new(at("posts"), "posts with barrier_model cylinders", "sliding_ropes or pinned_ropes")
            .hint("the heads of posts carry ropes that slide over them")
    })
}
