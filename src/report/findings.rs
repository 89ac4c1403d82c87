//! Rows of the report that tell what the simulation showed.

use crate::design::{BarrierDesign, Design};
use crate::pipeline::Run;
use crate::quantities::coefficients::Coefficients;
use crate::quantities::observed::Observed;
use crate::quantities::{boulder, earth_pressure, incoming, mass, rope_tension, total_force, wall};
use crate::report::numbers::with_unit;
use crate::report::row::{Row, row};
use crate::simulated::Simulated;
use crate::units::GRAVITY;

/// What the first start showed.
pub fn rows(run: &Run, simulated: &Simulated) -> Vec<Row> {
    let (design, seen) = (&run.file.design, simulated.first());
    [
        flow_rows(design, seen),
        force_rows(design, simulated),
        coefficient_rows(run, seen),
        loss_rows(seen),
        wall_rows(seen),
    ]
    .concat()
}

fn per_width(force: f64, design: &Design) -> String {
    let width = if design.channel.survey.is_some() { "mean width" } else { "width" };
    format!("{} of {width}", with_unit(force / design.channel.width, "N/m"))
}

fn flow_rows(design: &Design, seen: &Observed) -> Vec<Row> {
    let of_all = design.flow.mass_of_all();
    let weight = of_all * GRAVITY;
    let downhill = with_unit(weight * libm::sin(design.channel.slope), "N");
    let incoming =
        format!("{} deep, {}", with_unit(seen.incoming.depth, "m"), with_unit(seen.incoming.velocity, "m/s"));
    let fastest = format!("at {:.2} s", seen.one(&mass::VELOCITY_TIME));
    vec![
        row(
            "Mass of the flow",
            with_unit(of_all, "kg"),
            format!(
                "weight {}, its component along the bed {downhill}{}",
                with_unit(weight, "N"),
                if design.channel.profile.is_some() { " on the slope at the barrier" } else { "" }
            ),
        ),
        row(
            match design.flow.surges() {
                1 => "Highest mean velocity of all grains",
                _ => "Highest mean velocity of the grains of a surge",
            },
            with_unit(seen.one(&mass::VELOCITY), "m/s"),
            fastest,
        ),
        row(
            "Incoming flow",
            incoming,
            "0.1 to 0.3 barrier heights upstream of the barrier, when its momentum flux h v² was largest and before grains came to rest there; depth: that of the mass there at the bulk density of the design",
        ),
        row(
            "Velocity of the front",
            seen.known(&incoming::FRONT).map_or("not seen".to_string(), |front| with_unit(front, "m/s")),
            "over the last 0.4 barrier heights before that section; the front is where 2 % of the mass has passed",
        ),
        row(
            "Depth of the deposit at the barrier",
            with_unit(seen.one(&incoming::DEPOSIT), "m"),
            "at the end of the simulation; that of the mass there at the bulk density of the design",
        ),
    ]
}

fn force_rows(design: &Design, simulated: &Simulated) -> Vec<Row> {
    let seen = simulated.first();
    vec![
        row(
            "Largest force within a sampling interval",
            with_unit(seen.one(&total_force::PEAK_SAMPLED), "N"),
            format!(
                "mean over {:.1} ms only; the check of the total force uses the next row. A part that responds faster than the smoothing window, such as a stiff wall, is loaded by this",
                1e3 * simulated.facts.sampling
            ),
        ),
        row(
            "Largest total force",
            with_unit(seen.one(&total_force::PEAK), "N"),
            format!(
                "at {:.2} s; {}; length of the vector, mean over the smoothing window; the largest part along the bed is {}",
                seen.one(&total_force::PEAK_TIME),
                per_width(seen.one(&total_force::PEAK), design),
                with_unit(seen.one(&total_force::PUSH), "N")
            ),
        ),
        row("Total force at rest", with_unit(seen.one(&total_force::RESIDUAL), "N"), at_rest_remark(design, seen)),
    ]
    .into_iter()
    .chain(extension_row(seen))
    .chain(boulder_rows(design, seen))
    .collect()
}

/// How far the net bulges: the room it needs downstream.
fn extension_row(seen: &Observed) -> Option<Row> {
    let most = seen.each(&rope_tension::DEFLECTION).iter().copied().fold(0.0, f64::max);
    let ropes: Vec<String> =
        seen.each(&rope_tension::DEFLECTION).iter().map(|extension| with_unit(*extension, "m")).collect();
    (most > 0.0).then(|| {
        let remark = format!(
            "downstream, in the simulated surge; of main ropes from the bottom: {}. Keep clear the larger of this and the sag by the guideline",
            ropes.join(", ")
        );
        row("Largest extension of the net", with_unit(most, "m"), remark)
    })
}

/// What single boulders do, where the flow has some: a matter of where they happen to hit.
fn boulder_rows(design: &Design, seen: &Observed) -> Vec<Row> {
    if design.flow.boulders.is_empty() {
        return Vec::new();
    }
    let on_a_net = matches!(design.barrier, BarrierDesign::FlexibleNet(_)).then(|| {
        row(
            "Largest tension of the net beside a boulder",
            with_unit(seen.one(&boulder::NET), "N"),
            "within one mesh of it",
        )
    });
    let hit = row(
        "Largest force of a boulder on the barrier",
        with_unit(seen.one(&boulder::FORCE), "N"),
        "of one boulder, in this run; which part of the barrier it hits differs from run to run, so that several seeds are needed to know its scatter",
    );
    std::iter::once(hit).chain(on_a_net).collect()
}

/// The force at rest beside the weight of what is held.
fn at_rest_remark(design: &Design, seen: &Observed) -> String {
    let downhill = seen.one(&mass::RETAINED) * design.flow.mass_of_all() * GRAVITY * libm::sin(design.channel.slope);
    let springs = matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    let along = seen.one(&total_force::PUSH_RESIDUAL);
    let why = if along > downhill && springs {
        "; more, because the barrier has sprung back and presses the deposit up the slope, against the friction of the bed"
    } else if along > downhill {
        "; more, because the flow that was stopped last has pressed the deposit against the wall, and friction on the bed holds it there"
    } else {
        "; the rest is borne by the bed"
    };
    format!(
        "{}; of it {} along the bed, where the component of the held mass's weight is {}{why}",
        per_width(seen.one(&total_force::RESIDUAL), design),
        with_unit(along, "N"),
        with_unit(downhill, "N")
    )
}

fn coefficient_rows(run: &Run, seen: &Observed) -> Vec<Row> {
    let input = &run.guideline.input;
    let told = &seen.coefficients;
    let of = |value: Option<f64>| value.map_or("–".to_string(), |value| format!("{value:.2}"));
    let k = seen.known(&earth_pressure::AT_REST).map(|k| {
        let remark = format!(
            "from the force at rest along the channel: the value to compare with the design's K of {}",
            input.earth_pressure
        );
        row("K at rest", format!("{k:.2}"), remark)
    });
    let lambda = seen.known(&earth_pressure::DYNAMIC).map(|lambda| {
        let remark = format!(
            "from the largest force along the channel less the static part with the design's K, over ρ v² h of the incoming flow: the value to compare with the design's λ of {}",
            input.dynamic_pressure
        );
        row("λ from the largest force", format!("{lambda:.2}"), remark)
    });
    let at_peak = row(
        "K back-calculated from the grains at rest, at their peak force F₁",
        of(Coefficients::at_peak_of(&told.earth_pressure, &told.force_dead)),
        format!(
            "F₁ over ρ g' H_d (H_d/2 + h), along the channel, at one sample; {}",
            words_at(told, Coefficients::peak_of(&told.force_dead))
        ),
    );
    let moving = row(
        "λ back-calculated from the moving grains, at their peak force F₂",
        format!(
            "{} / {}",
            of(Coefficients::at_peak_of(&told.dynamic_upstream, &told.force_moving)),
            of(Coefficients::at_peak_of(&told.dynamic_mean, &told.force_moving))
        ),
        format!(
            "(F₂ − ½ K ρ g' h²)/(ρ v² h), along the channel, at one sample and not smoothed, so larger than the value above; with the design's K, with the velocity just upstream / with the mean velocity of all grains; {}",
            words_at(told, Coefficients::peak_of(&told.force_moving))
        ),
    );
    k.into_iter().chain(lambda).chain([at_peak, moving, side_row(told)]).collect()
}

/// What the split is made of at one sample.
fn words_at(told: &Coefficients, sample: usize) -> String {
    let of = |series: &[f64], unit| with_unit(series.get(sample).copied().unwrap_or(0.0), unit);
    format!(
        "at {:.3} s F₁ = {}, F₂ = {}, H_d = {}, h = {}, v = {} upstream, {} mean",
        told.time.get(sample).copied().unwrap_or(0.0),
        of(&told.force_dead, "N/m"),
        of(&told.force_moving, "N/m"),
        of(&told.deposit, "m"),
        of(&told.moving, "m"),
        of(&told.velocity_upstream, "m/s"),
        of(&told.velocity_mean, "m/s"),
    )
}

/// On which side the guideline errs.
fn side_row(told: &Coefficients) -> Row {
    let highest = |series: &[f64]| series.iter().copied().fold(0.0, f64::max);
    let side = |simulated: f64, guideline: f64| {
        let ratio = guideline / simulated;
        if !ratio.is_finite() {
            "cannot be told".to_string()
        } else {
            format!("{:.0} % of the simulated value", 100.0 * ratio)
        }
    };
    let dead = side(highest(&told.force_dead), highest(&told.guideline_dead));
    let moving = side(highest(&told.force_moving), highest(&told.guideline_moving));
    row(
        "Guideline compared with this simulation",
        format!("F₁ {dead}; F₂ {moving}"),
        "largest value over time of each, not at the same instant: the guideline's with the simulated depths and mean velocity and the design's K and λ. For information; the checks use the larger of guideline and simulation",
    )
}

fn loss_rows(seen: &Observed) -> Vec<Row> {
    let [through, under, beside, over] = seen.lost().map(|share| with_unit(share, "-"));
    let ways = format!("through {through}, under {under}, beside {beside}, over {over}");
    let stopped = with_unit(seen.one(&mass::STOPPED_UPSTREAM), "-");
    vec![
        row("Mass lost", with_unit(seen.lost().iter().sum(), "-"), ways),
        row(
            "Mass that stopped upstream",
            stopped,
            "came to rest without contact with the deposit at the barrier; not counted as retained",
        ),
    ]
}

fn wall_rows(seen: &Observed) -> Vec<Row> {
    if seen.each(&wall::SEGMENT).is_empty() {
        return Vec::new();
    }
    let list = |values: &[f64]| values.iter().map(|value| with_unit(*value, "N/m")).collect::<Vec<_>>().join(", ");
    vec![
        row("Wall segments, largest", list(seen.each(&wall::SEGMENT)), "from the bottom up"),
        row("Wall segments, at rest", list(seen.each(&wall::SEGMENT_RESIDUAL)), "from the bottom up"),
        row("Moment about the toe, largest", with_unit(seen.one(&wall::MOMENT), "N m/m"), ""),
    ]
}
