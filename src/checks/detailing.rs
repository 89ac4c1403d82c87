//! Rules of detailing, and the range in which the guideline has been used. They warn; they do not fail a design.

use crate::design::{BarrierDesign, Bottom, Design, FlexibleNet, LateralTo};
use crate::guideline::{Guideline, event_fill, flows, height_over_bed};
use crate::larger::larger_or_nan;
use crate::loads::estimates::peak_discharge;
use crate::loads::fill::Retention;
use crate::loads::input::GuidelineInput;

/// Sag over span, and strain, up to which a main rope's parabola with small strains is known to hold.
pub const LARGEST_SAG: f64 = 0.3;

pub const LARGEST_STRAIN: f64 = 0.1;

/// Slope of a channel (deg) above which the equations are not known to hold.
const STEEPEST_CHANNEL: f64 = 50.0;

/// What hangs on a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bearing {
    /// A warning.
    Advice,
    /// Beyond it the guideline's pressures are used outside the range they are known for.
    Pressures,
    /// Beyond it the equations of a main rope are.
    Ropes,
    /// Beyond it the design flow itself is in doubt.
    Flow,
}

/// One rule: what was found against what is advised, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    pub title: &'static str,
    pub found: f64,
    pub least: Option<f64>,
    pub most: Option<f64>,
    pub unit: &'static str,
    pub source: &'static str,
    /// What to do where it does not hold.
    pub advice: &'static str,
    pub bearing: Bearing,
}

impl Rule {
    pub fn holds(&self) -> bool {
        self.least.is_none_or(|least| self.found >= least) && self.most.is_none_or(|most| self.found <= most)
    }
}

fn most(
    title: &'static str,
    found: f64,
    most: f64,
    unit: &'static str,
    source: &'static str,
    advice: &'static str,
) -> Rule {
    Rule { title, found, least: None, most: Some(most), unit, source, advice, bearing: Bearing::Advice }
}

fn least(
    title: &'static str,
    found: f64,
    least: f64,
    unit: &'static str,
    source: &'static str,
    advice: &'static str,
) -> Rule {
    Rule { title, found, least: Some(least), most: None, unit, source, advice, bearing: Bearing::Advice }
}

const ALBABA: &str = "Albaba 2015";
const RANGE: &str = "standard range of flexible barriers (IABSE 2015 paper, read in excerpt)";
const SPECIAL: &str = "outside the range the guideline was made for: a special design";

/// All rules that apply to the design.
pub fn rules(design: &Design, guideline: &Guideline) -> Vec<Rule> {
    let mut rules = of_worst_surge(design, guideline);
    if let BarrierDesign::FlexibleNet(net) = &design.barrier {
        rules.extend(of_net(design, net));
        rules.extend(of_sag(guideline));
        rules.extend(guideline.retention.map(of_volume));
        rules.extend(of_point_load(design, net));
    }
    rules.extend(guideline.retention.map(|held| {
        least(
            "Volume held against that of the event",
            held.volume,
            design.flow.event_volume,
            "m³",
            "derived, with the shares of height and slope of the design",
            "the event more than fills the barrier: what comes after goes over it",
        )
    }));
    rules.push(of_freeboard(design, guideline));
    rules.push(of_discharge(design, guideline));
    // What hangs on grains of which nothing is said.
    rules.retain(|rule| !rule.most.is_some_and(f64::is_nan));
    rules
}

/// Of each rule on a flow what one surge breaks, or else what it finds of the first.
fn of_worst_surge(design: &Design, guideline: &Guideline) -> Vec<Rule> {
    let of_surges = flows(design, guideline.input).into_iter().map(|flow| of_flow(design, &flow));
    let worse = |known: Rule, next: Rule| if known.holds() && !next.holds() { next } else { known };
    of_surges
        .reduce(|known, next| known.into_iter().zip(next).map(|(known, next)| worse(known, next)).collect())
        .unwrap_or_default()
}

fn of_flow(design: &Design, flow: &GuidelineInput) -> Vec<Rule> {
    let mut rules = of_pressures(design, flow);
    if let BarrierDesign::FlexibleNet(_) = &design.barrier {
        let special = |title, found, limit, unit| Rule {
            bearing: Bearing::Pressures,
            ..most(title, found, limit, unit, RANGE, SPECIAL)
        };
        rules.push(special("Depth of the flow", flow.depth, 2.0, "m"));
        rules.push(special("Velocity of the flow", flow.velocity, 10.0, "m/s"));
    }
    rules
}

/// Where the guideline's pressures are known to hold.
fn of_pressures(design: &Design, input: &GuidelineInput) -> Vec<Rule> {
    let mut rules = vec![
        Rule {
            title: "Density of the flow against the guideline's range",
            found: input.density,
            least: Some(1600.0),
            most: Some(2200.0),
            unit: "kg/m³",
            source: "Volkwein 2014 (as cited by Albaba 2015)",
            advice: "advice only, which leaves no check open: pressures are proportional to the density, and K and λ are chosen in the design; the guideline set them for flows within this range: compare with \"Other models for the first surge\", and with K and λ of the simulation",
            // Pressures are proportional to the density; that K or λ hang on it as well is not known.
            bearing: Bearing::Advice,
        },
        Rule {
            bearing: Bearing::Pressures,
            ..most(
                "Slope of the bed at the barrier",
                design.channel.slope.to_degrees(),
                STEEPEST_CHANNEL,
                "deg",
                "a limit set here by judgement; no source was found",
                "what comes down so steep a slope falls onto the barrier rather than flows against it: give the slope of the reach in which the barrier stands",
            )
        },
        Rule {
            bearing: Bearing::Pressures,
            ..least(
                "Froude number",
                input.froude(),
                libm::pow(5.3 / input.dynamic_pressure, 1.0 / 1.5),
                "",
                "below that value the formula of Cui et al. 2015, λ = 5.3 Fr^−1.5, gives more than the design's λ",
                "a model that follows the Froude number asks for more than the design's λ: compare with \"Other models for the first surge\" and raise λ if they agree",
            )
        },
    ];
    rules.push(Rule {
        bearing: Bearing::Pressures,
        ..least(
            "Density of the flow against water",
            input.density,
            1000.0,
            "kg/m³",
            "that of water",
            "no debris flow is lighter than water",
        )
    });
    rules.push(Rule {
        bearing: Bearing::Pressures,
        ..most(
            if design.channel.survey.is_some() { "Height of filling beside the lower bank" } else { "Height of filling beside the side walls" },
            input.fill_height,
            design.channel.wall_height,
            "m",
            "derived, normal to the bed",
            if design.channel.survey.is_some() {
                "a deposit above the lower bank goes round the barrier: survey the banks further up if they are higher"
            } else {
                "a deposit above the side walls goes round the barrier: raise channel.wall_height if the banks are higher"
            },
        )
    });
    rules.push(Rule {
        bearing: Bearing::Pressures,
        ..most(
            "Inclination of the barrier from the vertical",
            tilt_of(design).abs().to_degrees(),
            MOST_TILT,
            "deg",
            "Albaba 2015 tried 0 to 20 deg; pressures are taken along the bed on the height normal to it",
            "the pressure normal to a face that leans more is not what the guideline has",
        )
    });
    rules.extend(of_coefficients(input));
    rules
}

/// The smallest K and λ of the guideline.
pub const LEAST_K: f64 = 1.0;
pub const LEAST_LAMBDA: f64 = 0.7;

fn of_coefficients(input: &GuidelineInput) -> [Rule; 2] {
    let coefficient = |title, found, smallest| Rule {
        bearing: Bearing::Pressures,
        ..least(
            title,
            found,
            smallest,
            "",
            "Volkwein 2014 (as cited by Albaba 2015): K = 1, λ = 0.7 to 2; larger values are on the safe side",
            "smaller than the guideline has it: say where the value is from, and compare with what the simulation shows",
        )
    };
    [
        coefficient("Coefficient K", input.earth_pressure, LEAST_K),
        coefficient("Coefficient λ", input.dynamic_pressure, LEAST_LAMBDA),
    ]
}

/// Greatest lean from plumb for which the guideline's pressures are taken (deg); a wall normal to the bed is that of the source.
const MOST_TILT: f64 = 20.0;

/// Lean of a net from plumb, or of a wall from plumb or the bed's normal, whichever is less (rad).
fn tilt_of(design: &Design) -> f64 {
    match &design.barrier {
        BarrierDesign::FlexibleNet(net) => net.tilt,
        BarrierDesign::RigidWall(wall) => {
            let plumb = wall.lean - design.channel.slope;
            if plumb.abs() < wall.lean.abs() { plumb } else { wall.lean }
        }
    }
}

/// What one event may heap up against the barrier, run-up included, stays below its top.
fn of_freeboard(design: &Design, guideline: &Guideline) -> Rule {
    let heaped =
        flows(design, guideline.input).iter().map(|flow| event_fill(design, flow).height()).fold(0.0, larger_or_nan);
    least(
        "Height of the barrier above the deposit of one event",
        guideline.input.barrier_height - heaped,
        0.0,
        "m",
        "derived: barrier less the event heaped up against it at the angle of repose, no higher than it runs up: an upper bound",
        "the event may go over the barrier: a higher barrier, or a second one",
    )
}

/// Most that the discharge of the design flow and the estimate from the event's volume may differ, either way.
const LIKE_DISCHARGES: f64 = 3.0;

/// b h v of the design flow, or A v in another section, against what flows of the event's volume discharge (Rickenmann 1999): a volume that is one surge of several,
/// or a wrong depth or velocity, shows here.
fn of_discharge(design: &Design, guideline: &Guideline) -> Rule {
    let [estimate, ..] = peak_discharge(design.flow.event_volume);
    let discharge = |flow: &GuidelineInput| guideline.section.area(flow.depth) * flow.velocity;
    let largest = flows(design, guideline.input).iter().map(discharge).fold(0.0, larger_or_nan);
    Rule {
        title: "Discharge (width × depth × velocity) over the estimate from the event volume",
        found: largest / estimate.value,
        least: Some(1.0 / LIKE_DISCHARGES),
        most: Some(LIKE_DISCHARGES),
        unit: "",
        source: "Rickenmann 1999, Q = 0.1 V^0.833, not checked against the original; such estimates scatter by a factor of two and more",
        advice: match design.flow.hydrograph {
            Some(_) => {
                "the discharge and the volume of the hydrograph look inconsistent: is it a part of a larger event (flow.event_volume)?"
            }
            None => {
                "volume, depth and velocity look inconsistent: is flow.volume one surge of a larger event (flow.event_volume)?"
            }
        },
        bearing: Bearing::Flow,
    }
}

/// Beyond a sag of a third of the span a rope hangs down the channel more than it spans it.
fn of_sag(guideline: &Guideline) -> Option<Rule> {
    let sag = guideline.ropes.iter().map(|rope| rope.state.sag / rope.span).reduce(f64::max)?;
    Some(Rule {
        bearing: Bearing::Ropes,
        ..most(
            "Largest sag of a main rope / span, by the guideline",
            sag,
            LARGEST_SAG,
            "-",
            "derived: the parabola and small strains no longer hold",
            "shorten the span, stiffen the rope or share the load among more ropes",
        )
    })
}

fn of_point_load(design: &Design, net: &FlexibleNet) -> Option<Rule> {
    let height = design.loads.point_load?.1?;
    let second = net.main_ropes.levels.get(1)?.height * libm::cos(design.channel.slope + net.tilt);
    (net.bottom == Bottom::Fixed).then(|| {
        least(
            "Height of the point load over the second main rope",
            height,
            second,
            "m",
            "derived",
            "below it a part goes into the rope that the bed holds; anchors.bed_bolt_spacing and bed_bolt_resistance have its bolts checked",
        )
    })
}

fn of_volume(held: Retention) -> Rule {
    most(
        "Volume held by one net",
        held.volume,
        2000.0,
        "m³",
        "practice: up to 2000 m³ (Albaba 2015, citing 2008)",
        "more than one net has been asked to hold: think of several in a row",
    )
}

fn of_net(design: &Design, net: &FlexibleNet) -> Vec<Rule> {
    let width = design.channel.section().width(height_over_bed(design));
    let coarse = design.flow.sizes.named(0.9);
    let lean = (design.channel.slope + net.tilt).to_degrees();
    let mut rules = vec![
        most(
            if net.rings.is_some() { "Diameter of the rings against D90" } else { "Mesh opening against D90" },
            net.opening(),
            coarse,
            "m",
            ALBABA,
            "a mesh wider than D90 lets the flow through: with D90 97 % are held",
        ),
        match net.posts {
            None => most(
                "Free span",
                width,
                15.0,
                "m",
                "Trumer, manufacturer's practice",
                "wider spans want posts, or ropes whose sag has been looked at",
            ),
            Some(_) => most(
                "Span with posts",
                width,
                25.0,
                "m",
                "manufacturers' practice",
                "the ropes below the uppermost one span from bank to bank, past the posts",
            ),
        },
        most("Width", width, 30.0, "m", RANGE, SPECIAL),
        most("Height", net.height, 6.0, "m", RANGE, SPECIAL),
        least(
            "Angle between the net and the bed's normal",
            lean,
            5.0,
            "deg",
            ALBABA,
            "a net normal to the bed retains much less and ends lower than a vertical one",
        ),
    ];
    if let Bottom::Opening(gap) = net.bottom {
        let advice = "the gap lets the flow through; keep it below D90";
        rules.push(most("Gap below the net against D90", gap, coarse, "m", ALBABA, advice));
        let advice = "a free lowest rope lifts and let all of the flow under even with gaps of D30; bolt it to the bed";
        rules.push(most("Lowest ropes that are free", 1.0, 0.0, "count", ALBABA, advice));
    }
    if net.dissipators.is_some() {
        let bypass = if net.lateral_to == LateralTo::Anchors { 2.0 } else { 0.0 };
        rules.push(most(
            "Lateral ropes that bypass the dissipators",
            bypass,
            0.0,
            "count",
            ALBABA,
            "tied to the anchors they load them far above the plateau; tie them to the rope ends",
        ));
    }
    rules
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::guideline::guideline;

    fn broken(change: impl Fn(&mut Design)) -> Vec<&'static str> {
        let mut design = read_design("x", include_bytes!("../../designs/site_a.yaml")).unwrap().design;
        change(&mut design);
        let guideline = guideline(&design);
        rules(&design, &guideline).into_iter().filter(|rule| !rule.holds()).map(|rule| rule.title).collect()
    }

    fn net(design: &mut Design) -> &mut FlexibleNet {
        match &mut design.barrier {
            BarrierDesign::FlexibleNet(net) => net,
            BarrierDesign::RigidWall(_) => unreachable!("site A has a net"),
        }
    }

    #[test]
    fn each_rule_speaks_when_it_is_broken() {
        let before = broken(|_| ());
        let added = |change: &dyn Fn(&mut Design)| -> Vec<&'static str> {
            broken(change).into_iter().filter(|title| !before.contains(title)).collect()
        };
        assert_eq!(added(&|design| net(design).mesh_opening = 2.0), ["Mesh opening against D90"]);
        assert_eq!(
            added(&|design| net(design).bottom = Bottom::Opening(2.0)),
            ["Gap below the net against D90", "Lowest ropes that are free"]
        );
        assert_eq!(added(&|design| net(design).height = 7.0), ["Height"]);
        assert_eq!(
            added(&|design| net(design).lateral_to = LateralTo::Anchors),
            ["Lateral ropes that bypass the dissipators"]
        );
        assert_eq!(
            added(&|design| {
                let slope = design.channel.slope;
                net(design).tilt = -slope;
            }),
            ["Inclination of the barrier from the vertical", "Angle between the net and the bed's normal"]
        );
    }
}
