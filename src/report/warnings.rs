//! What a reviewer should know before the numbers, each with what to do about it. One function for each warning.

use crate::checks::outcome::{CheckVerdict, Outcome};
use crate::dem::recorders::histories::{peak, smoothed};
use crate::design::{BarrierDesign, FidelityWish, FlexibleNet};
use crate::fidelity::ladder::{RUNGS, Rung};
use crate::pipeline::Run;
use crate::report::numbers::with_unit;
use crate::report::validation::Kept;
use crate::simulated::Simulated;

type Warning = fn(&Run) -> Option<String>;

/// All warnings, in the order of the report.
const WARNINGS: &[Warning] = &[
    verdicts_that_could_flip,
    force_beyond_the_guideline,
    faster_flow_than_the_guideline_was_given,
    dissipators_used_up,
    ropes_broken,
    sag_beyond_the_equations,
    bolts_not_judged,
    loads_without_factor,
    soft_ropes,
    validation_case_like_this,
];

pub fn warnings(run: &Run) -> Vec<String> {
    WARNINGS.iter().filter_map(|warning| warning(run)).collect()
}

fn net(run: &Run) -> Option<&FlexibleNet> {
    match &run.file.design.barrier {
        BarrierDesign::FlexibleNet(net) => Some(net),
        BarrierDesign::RigidWall(_) => None,
    }
}

/// The rung of the ladder that a run whose fineness the design pins is like.
pub fn rung_of(run: &Simulated) -> &'static Rung {
    let several = RUNGS.iter().find(|rung| rung.starts > 1 && run.starts.len() >= rung.starts as usize);
    several.or_else(|| RUNGS.iter().find(|rung| rung.name == "grains")).unwrap_or(&RUNGS[0])
}

fn verdicts_that_could_flip(run: &Run) -> Option<String> {
    let seen = run.simulated.as_ref().filter(|_| run.climb.is_empty())?;
    let close = rung_of(seen).could_flip(&run.outcomes);
    let one = seen.starts.len() == 1;
    (!close.is_empty()).then(|| {
        let what = if one { "one start, whose scatter is not known" } else { "these starts" };
        format!(
            "With {what}, the simulation cannot tell for certain: {}. Run with --seeds 5, or let \"fidelity: auto\" choose.",
            listed(&close)
        )
    })
}

fn listed(titles: &[String]) -> String {
    const MOST: usize = 4;
    let shown: Vec<String> = titles.iter().take(MOST).map(|title| lower_first(title)).collect();
    let more = match titles.len().saturating_sub(MOST) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    shown.join("; ") + &more
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().collect::<String>() + letters.as_str())
}

/// Largest force of the simulation over the guideline's from which it is worth a word.
const WORTH_A_WORD: f64 = 1.1;

fn force_beyond_the_guideline(run: &Run) -> Option<String> {
    let seen = run.simulated.as_ref()?;
    // The guideline speaks of the force along the channel: the share of it that the first start shows.
    let along: Vec<f64> = seen.histories.force.iter().map(|force| force.x).collect();
    let (_, along) = peak(&smoothed(&along, crate::scene::build::SAMPLES_PER_WINDOW as usize));
    let share = along / seen.first().force_peak;
    let (simulated, guideline) = (share * seen.spread(|seen| seen.force_peak).mean, run.guideline.largest_force);
    let ratio = simulated / guideline;
    (ratio > WORTH_A_WORD).then(|| {
        format!(
            "The simulated flow pushes along the channel with {ratio:.2} times the guideline's largest force ({} against {}, without partial factors): the guideline's loads are low for it. Checks take the larger of both; compare K and λ with what the simulation shows before they are used elsewhere.",
            with_unit(simulated, "N"),
            with_unit(guideline, "N")
        )
    })
}

fn faster_flow_than_the_guideline_was_given(run: &Run) -> Option<String> {
    let seen = run.simulated.as_ref()?;
    let incoming = seen.first().incoming;
    let given = run.guideline.input.velocity;
    (given > 0.0 && incoming.depth > 0.0 && incoming.velocity > 1.05 * given).then(|| {
        format!(
            "The simulated front arrives with {} where the guideline was given {}: dynamic pressures of the guideline would be {:.0} % higher with it. Give the velocity of the front, not the mean of the flow.",
            with_unit(incoming.velocity, "m/s"),
            with_unit(given, "m/s"),
            100.0 * ((incoming.velocity / given).powi(2) - 1.0)
        )
    })
}

/// When the dissipators of a rope were used up in the first start, and when the force was largest.
fn dissipators_used_up(run: &Run) -> Option<String> {
    let (seen, dissipators) = (run.simulated.as_ref()?, net(run)?.dissipators?);
    let used_up = seen.histories.strokes.iter().enumerate().filter_map(|(rope, strokes)| {
        let at = strokes.iter().position(|stroke| *stroke >= 0.999 * dissipators.stroke)?;
        Some((rope + 1, *seen.histories.time.get(at)?))
    });
    let (rope, time) = used_up.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let peak = seen.first().force_peak_time;
    let after = if peak > time {
        format!(
            "; the largest force follows {:.2} s later, when this rope stops what still moves, not when the front hits: λ from the largest force is no measure of the front then",
            peak - time
        )
    } else {
        String::new()
    };
    Some(format!(
        "The dissipators of main rope {rope} are used up after {time:.2} s{after}. From there on nothing limits the load of its anchors: more stroke, a higher plateau or more ropes would."
    ))
}

/// Strain from which a rope's state by the equations is no number to rely on.
const LARGE_STRAIN: f64 = 0.1;

fn sag_beyond_the_equations(run: &Run) -> Option<String> {
    let rope = &net(run)?.main_ropes.rope;
    let axial = rope.modulus * std::f64::consts::FRAC_PI_4 * rope.diameter.powi(2);
    let width = run.file.design.channel.width;
    let worst =
        run.guideline.ropes.iter().enumerate().max_by(|a, b| a.1.state.tension.total_cmp(&b.1.state.tension))?;
    let (number, state) = (worst.0 + 1, &worst.1.state);
    let (sag, strain) = (state.sag / width, state.tension / axial);
    (strain > LARGE_STRAIN).then(|| {
        format!(
            "By the equations main rope {number} stretches by {:.0} % and sags {:.0} % of its span: more than a wire rope can and small strains allow. What they say of its tension and anchors is an order of size, not a number.",
            100.0 * strain,
            100.0 * sag
        )
    })
}

/// From when on ropes have broken in the first start.
fn ropes_broken(run: &Run) -> Option<String> {
    let first = run.simulated.as_ref()?.first().first_break?;
    Some(format!(
        "From {first:.2} s on ropes have broken: what the simulation shows later is no load of the barrier as it was designed. Strengthen what broke first and run again."
    ))
}

fn bolts_not_judged(run: &Run) -> Option<String> {
    let bolts = run.outcomes.iter().find(|outcome| outcome.id == "bed_bolts")?;
    let demand = bolts.demand.largest()?;
    (bolts.capacity.is_none()).then(|| {
        format!(
            "What holds the lowest rope to the bed must bear {} in all, and is held against nothing: give anchors.bed_resistance.",
            with_unit(demand, bolts.unit)
        )
    })
}

fn loads_without_factor(run: &Run) -> Option<String> {
    (run.file.design.factors.load == 1.0).then(|| {
        "Loads carry no partial factor (factors.load: 1): choose the set of your code (factors.set) unless the design flow is itself a design value.".to_string()
    })
}

/// Modulus below which a wire rope would be unusually soft (Pa).
const SOFT: f64 = 20e9;

fn soft_ropes(run: &Run) -> Option<String> {
    let net = net(run)?;
    let ropes =
        [("main", net.main_ropes.rope.modulus), ("lateral", net.lateral_rope.modulus), ("net", net.net_rope.modulus)];
    let soft: Vec<&str> = ropes.iter().filter(|(_, modulus)| *modulus < SOFT).map(|(name, _)| *name).collect();
    (!soft.is_empty()).then(|| {
        format!(
            "Ropes with a modulus below {} ({}): wire ropes have several times as much. A softer rope sags more and is loaded less; say where the value is from.",
            with_unit(SOFT * 1e-9, "GPa"),
            soft.join(", ")
        )
    })
}

/// Validation cases that fail, for designs with what they fail in.
fn validation_case_like_this(run: &Run) -> Option<String> {
    run.simulated.as_ref()?;
    net(run)?.dissipators?;
    let kept = Kept::of_this_version()?;
    let case = kept.cases.iter().find(|case| case.id == "FS1" && !case.held)?;
    Some(format!(
        "Of the published barrier with dissipators this program meets forces and rope means within 15 %, but its dissipators pay out a fifth to a third more, and it holds 5 % less (case {}, which fails). Strokes and losses of the simulation are likely too large; the reason lies within what is not known of the published flow.",
        case.id
    ))
}

/// What is left in the check that uses most by the simulation; nothing where it fails one. What a dissipator caps does not
/// grow, and is left out: its stroke tells.
pub fn left_by_simulation(run: &Run) -> Option<String> {
    run.simulated.as_ref()?;
    let judged = run.outcomes.iter().filter(|outcome| !matches!(outcome.verdict, CheckVerdict::Info));
    let used: Vec<(&Outcome, f64)> =
        judged.filter_map(|outcome| Some((outcome, used_by_simulation(outcome)?))).collect();
    if used.iter().any(|(_, used)| *used > 1.0) {
        return None;
    }
    let (most, share) = used.into_iter().filter(|(_, used)| *used > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let grow = match most.unit {
        "N" | "N/m" | "N m/m" => format!(
            ": it may grow by {:.0} % until it fails, and if it grows with the square of the velocity, the velocity by {:.0} %",
            100.0 * (1.0 / share - 1.0),
            100.0 * ((1.0 / share).sqrt() - 1.0)
        ),
        _ => String::new(),
    };
    Some(format!("By the simulation {} uses most, {:.0} %{grow}.", lower_first(&most.title), 100.0 * share))
}

/// Demand of the simulation over capacity; of a least share, what is missing over what may be missing.
fn used_by_simulation(outcome: &Outcome) -> Option<f64> {
    let (simulation, capacity) = (outcome.demand.simulation?, outcome.capacity?);
    if outcome.utilisation.is_none() || outcome.demand.cap.is_some_and(|cap| simulation >= 0.99 * cap) {
        return None;
    }
    match outcome.resistance {
        Some(_) => Some(simulation / capacity),
        None => Some((1.0 - simulation) / (1.0 - capacity).max(1e-9)),
    }
}

/// Why a run as fine as this is enough, or what a finer one could change, where the design pins the fineness.
pub fn pinned_fidelity(run: &Run) -> Option<String> {
    let seen = run.simulated.as_ref().filter(|_| run.climb.is_empty())?;
    let rung = rung_of(seen);
    let open = rung.open(&run.outcomes);
    let band = &rung.band;
    let known = format!(
        "such a run may be off by {:.0} % in forces, {:.0} % in strokes and {:.0} points in shares",
        100.0 * band.force,
        100.0 * band.stroke,
        100.0 * band.share
    );
    let verdict = if open.is_empty() {
        "even so the verdict stands".to_string()
    } else {
        format!("with that {} could go either way", listed(&open))
    };
    let asked = match run.file.design.simulation.fidelity {
        FidelityWish::Fast => "fast",
        FidelityWish::Standard => "standard",
        FidelityWish::Fine => "fine",
        FidelityWish::Auto => "auto",
    };
    Some(format!("pinned by the design ({asked}); {known}: {verdict}"))
}
