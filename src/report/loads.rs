//! The load side of the report: cases with their numbers put in, ropes, other models, what is held, what matters most.

use serde::Serialize;

use crate::checks::between_bolts::{concentration, tension_between};
use crate::checks::detailing;
use crate::design::{BarrierDesign, Contacts};
use crate::guideline::{RopeLoad, wall_of};
use crate::loads::cases::load_case::LoadCase;
use crate::loads::cases::split;
use crate::loads::other_models::MODELS;
use crate::loads::ring_net::RingNet;
use crate::loads::rope::RopeInput;
use crate::pipeline::Run;
use crate::quantities::bed;
use crate::report::numbers::{figures, percent, with_unit};
use crate::report::plots::pressure::pressure_diagram;
use crate::report::row::{Row, lower_first};
use crate::section::Section;
use crate::sensitivity;

#[derive(Debug, Serialize)]
pub struct CaseRow {
    pub title: &'static str,
    pub deposit: String,
    pub moving: String,
    pub pressure_static: String,
    pub pressure_dynamic: String,
    pub force_per_width: String,
    pub moment: String,
    pub total: String,
    /// The resultant in symbols and in numbers.
    pub formula: &'static str,
    pub working: String,
    pub remark: String,
    pub source: String,
    /// Name of the picture's file beside the Markdown report.
    pub file: String,
    pub svg: String,
}

#[derive(Debug, Serialize)]
pub struct RopeRow {
    pub rope: usize,
    pub strip: String,
    pub case: String,
    pub load: String,
    pub sag: String,
    pub tension: String,
    pub stroke: String,
    pub anchor: String,
    pub working: String,
}

#[derive(Debug, Serialize)]
pub struct ModelRow {
    pub name: &'static str,
    pub formula: &'static str,
    pub force: String,
    /// As a share of the guideline's with the design's λ.
    pub share: String,
    pub range: String,
    pub certainty: &'static str,
}

#[derive(Debug, Serialize)]
pub struct RuleRow {
    pub title: &'static str,
    pub found: String,
    pub advised: String,
    pub verdict: &'static str,
    pub remark: String,
}

#[derive(Debug, Serialize)]
pub struct SwingRow {
    pub name: String,
    pub force: String,
    pub utilisation: String,
    pub governing: String,
}

pub fn cases(run: &Run) -> Vec<CaseRow> {
    let width = run.file.design.channel.width;
    let highest = run.guideline.cases.iter().map(|case| case.diagram.at(0.0)).fold(0.0, f64::max);
    let tallest = run.guideline.cases.iter().map(|case| case.diagram.top).fold(0.0, f64::max);
    let row = |case: &LoadCase| CaseRow {
        title: case.title,
        deposit: with_unit(case.deposit, "m"),
        moving: with_unit(case.moving, "m"),
        pressure_static: with_unit(case.pressure_static(), "Pa"),
        pressure_dynamic: with_unit(case.diagram.block, "Pa"),
        force_per_width: with_unit(case.force_per_width(), "N/m"),
        moment: with_unit(case.mean_moment(width), "N m/m"),
        total: with_unit(case.total_force(&run.guideline.section), "N"),
        formula: case.formula,
        working: working(case),
        remark: remark(run, case),
        source: format!("{}; {}", case.source, case.certainty.word()),
        file: format!("case_{}.svg", case.id),
        svg: pressure_diagram(&case.diagram, highest, tallest),
    };
    run.guideline.cases.iter().map(row).collect()
}

/// What "per width" means where the section is no rectangle; empty where it is one.
pub fn per_width(run: &Run) -> String {
    let section = &run.guideline.section;
    let Section::Surveyed(survey) = section else { return String::new() };
    let top = run.guideline.input.barrier_height;
    format!(
        "The section is not a rectangle: pressures, force per width and moment are those of a metre of width at its lowest point. The force is integrated over the width at each height, R = ∫ p(z) w(z) dz, with w = {:.2} m at the bed and {:.2} m at the barrier's top, and {:.1} m² between them.{} Heights of the survey ({} points) count normal to the bed, vertical heights times cos α.",
        section.width(0.0),
        section.width(top),
        section.area(top),
        match &run.file.design.barrier {
            BarrierDesign::FlexibleNet(_) => {
                " A main rope takes, over its own span, the even load that bends a beam and pushes on its supports no less than the pressures on its strip do, each metre of width from the ground up; what presses beside the span goes to its ends."
            }
            BarrierDesign::RigidWall(_) => {
                " The wall is checked by its deepest metre; steps of its foundation along the banks, and what the banks hold of it, are not modelled."
            }
        },
        survey.points().len()
    )
}

/// The formula with its numbers.
fn working(case: &LoadCase) -> String {
    let drag = if case.shear > 0.0 && case.shear_certainty.decides() {
        format!(" + {:.3} (drag on the top)", case.shear / 1e3)
    } else {
        String::new()
    };
    let result = with_unit(case.force_per_width(), "N/m");
    format!("{}R = {}{drag} = {result}", case.working.pressures(), case.working.force())
}

fn remark(run: &Run, case: &LoadCase) -> String {
    let mut parts = Vec::new();
    if case.moving > 0.0 && case.deposit > 0.0 && case.shear == 0.0 && case.diagram.top >= case.diagram.surface {
        let (first, second) = split(&run.guideline.input, case);
        parts.push(format!(
            "the deposit's part of it is F₁ = {}, that of the moving flow F₂ = {}",
            with_unit(first, "N/m"),
            with_unit(second, "N/m")
        ));
    }
    if case.shear > 0.0 {
        let enters = if case.shear_certainty.decides() {
            "enters the checks"
        } else {
            "length as deep as the flow and φ = 25° by default, for information only: give loads.overflow_friction and overflow_length to have it checked"
        };
        parts.push(format!(
            "drag on the barrier's top = ρ g' h_o · length · tan φ = {} ({enters})",
            with_unit(case.shear, "N/m")
        ));
    }
    if let Some(point) = case.point {
        parts.push(format!(
            "in force and moment, not in force per width: {} at {}{}",
            with_unit(point.force, "N"),
            with_unit(point.height, "m"),
            if run.guideline.ropes.is_empty() {
                ""
            } else {
                "; on a rope as the uniform load 2 P/L, shared by lever between the ropes beside it"
            }
        ));
    }
    parts.join("; ")
}

/// How the demand of the total force follows from the load cases, where it is more than the largest of them.
pub fn face_remark(run: &Run) -> String {
    let (guideline, factor) = (&run.guideline, run.file.design.factors.load);
    if guideline.lean == 0.0 && factor == 1.0 {
        return String::new();
    }
    format!(
        "The check of the total force takes what acts normal to the face: {} along the bed / cos {:.1}° (lean of the face from the bed's normal) · partial factor {factor:.2} = {}.",
        with_unit(guideline.largest_force, "N"),
        guideline.lean.abs().to_degrees(),
        with_unit(factor * guideline.face_force, "N")
    )
}

pub fn ropes(run: &Run) -> Vec<RopeRow> {
    let row = |(index, rope): (usize, &RopeLoad)| {
        let case = rope.case.as_ref().filter(|_| rope.load > 0.0)?;
        let strip = if rope.strip[1].is_finite() {
            format!("{:.2} to {:.2} m", rope.strip[0], rope.strip[1])
        } else {
            format!("{:.2} m to the top", rope.strip[0])
        };
        let deposit = if case.one_of_the_stages { format!(" of {:.2} m", case.deposit) } else { String::new() };
        Some(RopeRow {
            rope: index + 1,
            strip,
            case: format!("{}{deposit}", case.title),
            load: with_unit(rope.load, "N/m"),
            sag: with_unit(rope.state.sag, "m"),
            tension: with_unit(rope.state.tension, "N"),
            stroke: with_unit(rope.state.stroke, "m"),
            anchor: format!(
                "{} along the span, {} down the channel",
                with_unit(rope.anchor[0], "N"),
                with_unit(rope.anchor[1], "N")
            ),
            working: rope_working(run, index, rope, case),
        })
    };
    run.guideline.ropes.iter().enumerate().filter_map(row).collect()
}

/// EA of one of the ropes of a level (N); 0 for a wall.
fn axial_stiffness(run: &Run, level: usize) -> f64 {
    match &run.file.design.barrier {
        BarrierDesign::FlexibleNet(net) => net.main_ropes.levels[level].rope.axial_stiffness(),
        BarrierDesign::RigidWall(_) => 0.0,
    }
}

/// How the demand of the lowest rope between its bolts, and of its worst bolt, follows from the guideline; empty where it has none.
pub fn bolted_rope(run: &Run) -> String {
    let (BarrierDesign::FlexibleNet(net), Some(load)) = (&run.file.design.barrier, run.guideline.bolt_force) else {
        return String::new();
    };
    let bed = run.guideline.section.bed_length();
    let spaces = net.bed_bolts.map_or(1, |bolts| bolts.spaces(bed));
    let spacing = bed / spaces as f64;
    let more = concentration(spacing / net.main_ropes.ring_spacing);
    let lowest = &net.main_ropes.levels[0];
    let ropes = f64::from(lowest.ropes);
    let axial = ropes * lowest.rope.axial_stiffness() * more;
    let along = libm::cbrt(load * load * axial / 24.0);
    let together = match lowest.ropes {
        1 => String::new(),
        ropes => format!(
            " H, T and EA are of the {ropes} ropes of the level together, which the bolts hold; each bears T/{ropes} = {:.1} kN.",
            tension_between(load, axial) / ropes as f64 / 1e3
        ),
    };
    let simulated = run
        .simulated
        .as_ref()
        .map_or(String::new(), |seen| format!(", {} in the first run", with_unit(seen.first().one(&bed::SPACE), "N")));
    format!(
        "Rope 1, bolted to the bed: its strip, {:.2} to {:.2} m, carries {:.1} kN in all, so P = {:.2} kN on each of {spaces} spaces of {spacing:.3} m between bolts, with m = {:.0} rings in each; along the rope H = (c P² EA/24)^⅓ = ({more:.2} · {:.2}² · {:.0}/24)^⅓ = {:.1} kN, c = 1 + 2/m² for a load that comes in at the m rings of a space; T = √(H² + (P/2)²) = {:.1} kN. A bolt at an end of the rope bears the whole T, as no rope pulls from its other side. The simulation gives P of the worst space{simulated}, H and T follow likewise, and the pull of the lateral rope is added to the bolt at the end.{together}",
        run.guideline.ropes.first().map_or(0.0, |rope| rope.strip[0]),
        run.guideline.ropes.first().map_or(0.0, |rope| rope.strip[1]),
        run.guideline.bed_force.unwrap_or(0.0) / 1e3,
        load / 1e3,
        (spacing / net.main_ropes.ring_spacing).floor().max(1.0),
        load / 1e3,
        axial / more / 1e3,
        along / 1e3,
        tension_between(load, axial) / 1e3
    )
}

/// How the demand of the rings of a ring net follows from the guideline; empty where it has none.
pub fn ring_net(run: &Run) -> String {
    let (BarrierDesign::FlexibleNet(net), Some(found)) = (&run.file.design.barrier, run.guideline.rings) else {
        return String::new();
    };
    let Some(rings) = &net.rings else { return String::new() };
    let of = RingNet { lattice: rings.lattice(), taut_from: rings.law().taut_from };
    let taut = match rings.contacts {
        Contacts::Four => format!("a way P₁ = {:.3} m round their contacts, L = P₁", of.taut_from),
        Contacts::Six => format!(
            "a way P₁ = {:.3} m round their contacts, of which L = P₁ − s = {:.3} m rises",
            of.taut_from,
            of.rising()
        ),
    };
    format!(
        "Rings of the net: the bay of b = {:.2} m whose pressure is largest bears q = {:.1} kN on a metre of width. Rings that stay side by side, s = {:.3} m from centre to centre, are taut when they are d = {:.3} m high instead of d₀ = {:.3} m, with {taut}, and the net bulges by f = b √(⅜ (d/d₀ − 1)) = {:.3} m; a width of one ring pulls with V = s q √((b/8f)² + ¼), and a leg with T = V L/(4 d) = {:.1} kN. Single grains load rings more than that: the simulation tells, and the equations alone never let the rings pass.",
        found.bay,
        found.load / 1e3,
        of.spacing(),
        of.height(),
        of.hung(),
        found.bulge,
        found.leg / 1e3
    )
}

/// Load and tension with their numbers, in kN and m.
fn rope_working(run: &Run, number: usize, rope: &RopeLoad, case: &LoadCase) -> String {
    let design = &run.file.design;
    let diagram = &case.diagram;
    let (low, high) = (rope.strip[0], rope.strip[1].min(diagram.top));
    let depth = |height: f64| (diagram.surface - height).max(0.0);
    let beside = (high.min(diagram.block_to) - low.max(diagram.block_from)).max(0.0);
    let factor = if design.factors.load == 1.0 { String::new() } else { format!("{:.2} · ", design.factors.load) };
    // What the pressure alone does not make of q, on this rope and in this case.
    let leans = libm::cos(run.guideline.lean);
    let pressure = design.factors.load * diagram.force(rope.strip[0], rope.strip[1]) / leans;
    let beside_pressure = rope.point > 0.0
        || (case.shear > 0.0 && case.shear_certainty.decides() && rope.strip[1] >= case.diagram.top)
        || (design.loads.self_weight.is_some() && rope.strip[1].is_infinite());
    let differs = (rope.load - pressure).abs() > 1e-9 * rope.load;
    let more = match (&design.channel.survey, differs) {
        (_, false) => String::new(),
        (None, true) => ", with point load, drag or weight on this rope".to_string(),
        (Some(_), true) => format!(
            ", over the section taken with {:.3} (the even load on the span that bends and pushes as much{})",
            rope.load / pressure,
            if beside_pressure { "; with point load, drag or weight on this rope" } else { "" }
        ),
    };
    let span = rope.span;
    let of_one = rope.of_one;
    let horizontal = of_one * span * span / (8.0 * rope.state.sag) / 1e3;
    let half = 0.5 * of_one * span / 1e3;
    let shared = match rope.ropes {
        1 => String::new(),
        ropes => format!(", shared by {ropes} ropes: {:.2} kN/m on each", of_one / 1e3),
    };
    let tension = libm::hypot(horizontal, half);
    let lean = run.guideline.lean.abs().to_degrees();
    let over_posts = match rope.other_spans.len() {
        0 => String::new(),
        posts => format!(
            " Over {posts} post{} the rope has one H in all its spans, {} m; shown is the longest, and lengths and arcs are those of all.",
            if posts > 1 { "s" } else { "" },
            [rope.span].iter().chain(&rope.other_spans).map(|span| format!("{span:.2}")).collect::<Vec<_>>().join(", ")
        ),
    };
    let load = format!(
        "q = {factor}(½ · {:.3} · ({:.3}² − {:.3}²) + {:.2} · {beside:.3})/cos {lean:.1}°{more} = {:.2} kN/m{shared}",
        diagram.unit / 1e3,
        depth(low),
        depth(high),
        diagram.block / 1e3,
        rope.load / 1e3,
    );
    let (q, sag) = (of_one / 1e3, rope.state.sag);
    let others = rope.other_spans.clone();
    let line = RopeInput {
        span,
        other_spans: others,
        to_anchors: rope.to_anchors,
        axial_stiffness: axial_stiffness(run, number),
        dissipator: None,
    };
    let arc = line.arcs(sag);
    let dissipator = run.guideline.dissipator.as_ref();
    let from = match dissipator.filter(|dissipator| !dissipator.curve.is_plateau()) {
        Some(_) => format!("yield along their curve, after {:.3} m with", rope.state.stroke),
        None => "yield, so".to_string(),
    };
    let paid_out = dissipator.filter(|dissipator| rope.state.stroke >= dissipator.stroke).map_or(String::new(), |_| {
        format!(
            ", and longer by the strokes of its two dissipators, which are used up ({:.3} m each)",
            rope.state.stroke
        )
    });
    let yields = dissipator.is_some_and(|dissipator| {
        let on_its_way = rope.state.stroke > 0.0 && rope.state.stroke < dissipator.stroke;
        on_its_way || rope.state.tension == dissipator.largest
    });
    if yields {
        format!(
            "{load}; the dissipators {from} T = {tension:.1} kN; H = √(T² − (q L/2)²) = √({tension:.1}² − {half:.1}²) = {horizontal:.1} kN; f = q L²/(8 H) = {q:.2} · {span:.2}²/(8 · {horizontal:.1}) = {sag:.3} m; stroke of each of the two = (s − L (1 + T/EA))/2 = ({arc:.3} − {:.3})/2 = {:.3} m, s being the arc of the parabola.{over_posts}",
            line.stretched(tension * 1e3),
            rope.state.stroke
        )
    } else {
        format!(
            "{load}; f = {sag:.3} m, at which the rope, stretched by H = q L²/(8 f) = {q:.2} · {span:.2}²/(8 · {sag:.3}) = {horizontal:.1} kN{paid_out}, has the length of its curve; T = √(H² + (q L/2)²) = √({horizontal:.1}² + {half:.1}²) = {tension:.1} kN.{over_posts}"
        )
    }
}

/// The balance of a wall that stands by its weight.
pub fn wall(run: &Run) -> Vec<Row> {
    let design = &run.file.design;
    let Some(wall) = wall_of(design) else { return Vec::new() };
    let row = |name: &str, value: String, remark: &str| Row { name: name.into(), value, remark: remark.into() };
    let ([hold, pull], [right, tilt]) = (wall.sliding(), wall.overturning());
    vec![
        row(
            "Height of the wall with its foundation",
            with_unit(wall.height, "m"),
            "square to its base of slope β, on which the wall stands upright: over the bed H/cos(α − β), and what is founded below it",
        ),
        row("Weight W", with_unit(wall.weight(), "N/m"), "ρ g t H"),
        row("Resistance to sliding", with_unit(hold, "N/m"), "W cos β tan φ, without partial factor"),
        row(
            "Demand for sliding",
            format!("R · {:.3} + {}", wall.sliding_share(), with_unit(pull, "N/m")),
            "R (cos δ + tan θ sin δ + tan φ · lift share) + W sin β + U tan φ + the thrust of water and ground on the buried face, δ = α − β, θ the lean of the face from the bed's normal; R with the partial factor on loads. By the simulation the parts of the force vector along and off the base stand for R",
        ),
        row(
            "Holds against overturning",
            with_unit(right, "N m/m"),
            "W cos β (b − a) about the downstream edge, a being where the weight acts, without partial factor",
        ),
        row(
            "Demand for overturning",
            format!("M + R · {:.3} + {}", wall.lift_share() * wall.base_width, with_unit(tilt, "N m/m")),
            "M of the load about the upstream end of the base + lift × width of the base + W sin β H/2 + 2 U b/3 + the moment of water and ground on the buried face",
        ),
        row(
            "Left out, which is conservative",
            "–".into(),
            "that the load presses the wall down; the weight of the deposit; friction of the deposit on the wall",
        ),
        row(
            "Uplift by water under the base",
            with_unit(wall.uplift(), "N/m"),
            "ρ_w g h b/2, h being the head at the upstream edge (barrier.rigid_wall.stability.water_head); its share tan φ is in the demand for sliding, its moment at 2 b/3 in that for overturning",
        ),
        row(
            "Thrust of the ground on the buried face",
            with_unit(wall.earth_thrust()[0], "N/m"),
            "γ_F K (γ d²/2 + q d) cos δ − K₀ γ d₂²/2: active pressure under a surface that rises with the bed and along it, q the weight of what fills the barrier, d₂ the depth of the ground over the downstream edge; it is in the demand for sliding, its moment about the base in that for overturning",
        ),
        row("Not checked", "–".into(), "the ground but for its bearing resistance, and scour"),
    ]
}

pub fn other_models(run: &Run) -> Vec<ModelRow> {
    let input = &run.guideline.input;
    let own = run.guideline.cases.first().map_or(1.0, LoadCase::force_per_width);
    let show = |[low, high]: [f64; 2], text: &dyn Fn(f64) -> String| {
        if low == high { text(low) } else { format!("{} to {}", text(low), text(high)) }
    };
    let row = |model: &crate::loads::other_models::Model| {
        let force = model.force(input);
        let outside = if model.in_range(input) { "" } else { "; this flow is outside" };
        ModelRow {
            name: model.name,
            formula: model.formula,
            force: show(force, &|force| with_unit(force, "N/m")),
            share: show(force, &|force| format!("{:.1}", force / own)),
            range: format!("{}{outside}", model.range),
            certainty: model.certainty.word(),
        }
    };
    MODELS.iter().map(row).collect()
}

pub fn rules(run: &Run) -> Vec<RuleRow> {
    let rules = detailing::rules(&run.file.design, &run.guideline);
    let row = |rule: detailing::Rule| {
        let show = |value: f64| with_unit(value, rule.unit);
        let advised = match (rule.least, rule.most) {
            (Some(least), Some(most)) => format!("{} to {}", show(least), show(most)),
            (Some(least), None) => format!("at least {}", show(least)),
            (None, Some(most)) => format!("at most {}", show(most)),
            (None, None) => String::new(),
        };
        let remark = if rule.holds() { rule.source.to_string() } else { format!("{}; {}", rule.source, rule.advice) };
        RuleRow {
            title: rule.title,
            found: show(rule.found),
            advised,
            verdict: if rule.holds() { "met" } else { "not met" },
            remark,
        }
    };
    rules.into_iter().map(row).collect()
}

pub fn tornado(run: &Run) -> Vec<SwingRow> {
    swing_rows(&sensitivity::swings(&run.file.design))
}

pub fn swing_rows(swings: &[sensitivity::Swing]) -> Vec<SwingRow> {
    let row = |swing: &sensitivity::Swing| SwingRow {
        name: format!("{} ± {:.0} %", swing.name, 100.0 * swing.share),
        force: format!("{} … {}", with_unit(swing.down.force, "N"), with_unit(swing.up.force, "N")),
        utilisation: format!("{} … {}", percent(swing.down.utilisation), percent(swing.up.utilisation)),
        governing: if swing.down.governing == swing.up.governing {
            swing.up.governing.clone()
        } else {
            format!(
                "decreased: {}; increased: {}",
                lower_first(&swing.down.governing),
                lower_first(&swing.up.governing)
            )
        },
    };
    swings.iter().map(row).collect()
}

pub fn margin(run: &Run) -> String {
    use sensitivity::Limit;
    let still = sensitivity::least(&run.file.design).map_or(String::new(), |point| {
        let used = percent(point.utilisation);
        format!(
            " With the barrier full and the flow almost at rest, the utilisation is still {used} ({}).",
            lower_first(&point.governing)
        )
    });
    let tell = |name: &str, limit: Limit| match limit {
        Limit::Unjudged => "no check is judged by the guideline".to_string(),
        Limit::AlwaysFails => format!("reducing only the {name} does not make all guideline checks pass"),
        Limit::NeverFails(most) => format!(
            "no {name} up to {} that of the design, the largest that was tried, fails a guideline check",
            times(most)
        ),
        Limit::At(factor, first) if factor >= 1.0 => format!(
            "the {name} could increase by {:.0} % before the first check by the guideline fails or is left open ({})",
            100.0 * (factor - 1.0),
            lower_first(&first)
        ),
        Limit::At(factor, _) => {
            let less = 100.0 * (1.0 - factor);
            format!("the {name} would have to be {less:.0} % smaller for all guideline checks to pass")
        }
    };
    let margin = sensitivity::margin(&run.file.design);
    if margin.velocity == Limit::Unjudged {
        return "No check is judged by the guideline.".into();
    }
    let still = if margin.velocity == Limit::AlwaysFails { still } else { String::new() };
    format!("Alone, {}; {}.{still}", tell("velocity", margin.velocity), tell("depth", margin.depth))
}

/// The smaller of the margins of velocity and depth, in words, where there is one.
pub fn least_margin(run: &Run) -> Option<String> {
    use sensitivity::Limit;
    let margin = sensitivity::margin(&run.file.design);
    let grown = |name: &'static str, limit: Limit| match limit {
        Limit::At(factor, first) if factor >= 1.0 => Some((factor, name, first)),
        _ => None,
    };
    let both = [grown("velocity", margin.velocity), grown("depth", margin.depth)];
    let (factor, name, first) = both.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(format!(
        "{:.0} % more {name} makes a check fail or leaves it open ({})",
        100.0 * (factor - 1.0),
        lower_first(&first)
    ))
}

/// A factor in words: "2.7 times".
fn times(factor: f64) -> String {
    format!("{} times", figures(factor))
}
