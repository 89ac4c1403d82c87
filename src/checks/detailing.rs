//! Rules of detailing, and the range in which the guideline has been used. They warn; they do not fail a design.

use crate::demand::from_loads::Guideline;
use crate::design::{BarrierDesign, Bottom, Design, FlexibleNet, LateralTo};
use crate::loads::fill::Retention;

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
    Rule { title, found, least: None, most: Some(most), unit, source, advice }
}

fn least(
    title: &'static str,
    found: f64,
    least: f64,
    unit: &'static str,
    source: &'static str,
    advice: &'static str,
) -> Rule {
    Rule { title, found, least: Some(least), most: None, unit, source, advice }
}

const ALBABA: &str = "Albaba 2015";
const RANGE: &str = "standard range of flexible barriers (IABSE 2015 paper, read in excerpt)";
const SPECIAL: &str = "outside the range the guideline was made for: a special design";

/// All rules that apply to the design.
pub fn rules(design: &Design, guideline: &Guideline) -> Vec<Rule> {
    let input = &guideline.input;
    let mut rules = vec![
        most("Depth of the flow", input.depth, 2.0, "m", RANGE, SPECIAL),
        most("Velocity of the flow", input.velocity, 10.0, "m/s", RANGE, SPECIAL),
        Rule {
            title: "Density of the flow",
            found: input.density,
            least: Some(1600.0),
            most: Some(2200.0),
            unit: "kg/m³",
            source: "Volkwein 2014 (after Albaba 2015)",
            advice: "K and λ of the guideline were set for denser or lighter flows than this one; see the ladder of models",
        },
        least(
            "Froude number",
            input.froude(),
            2.0,
            "",
            "derived from the ladder of models",
            "below 2, models that follow the Froude number ask for more than a fixed λ of 2",
        ),
    ];
    if let BarrierDesign::FlexibleNet(net) = &design.barrier {
        rules.extend(of_net(design, net));
        rules.extend(guideline.retention.map(of_volume));
    }
    rules
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
    let width = design.channel.width;
    let coarse = design.flow.sizes.quantile(0.9);
    let lean = (design.channel.slope + net.tilt).to_degrees();
    let mut rules = vec![
        most(
            "Mesh opening against D90",
            net.mesh_opening,
            coarse,
            "m",
            ALBABA,
            "a mesh wider than D90 lets the flow through: with D90 97 % are held",
        ),
        most(
            "Free span",
            width,
            15.0,
            "m",
            "Trumer, manufacturer's practice",
            "wider spans want posts, or ropes whose sag has been looked at",
        ),
        most("Width", width, 30.0, "m", RANGE, SPECIAL),
        most("Height", net.height, 6.0, "m", RANGE, SPECIAL),
        least(
            "Angle between the net and the bed's normal",
            lean,
            5.0,
            "deg",
            ALBABA,
            "a net normal to the bed holds much less and ends lower than a plumb one",
        ),
    ];
    if let Bottom::Opening(gap) = net.bottom {
        let advice = "a free lowest rope lifts and lets the flow under; bolt it to the bed or keep the gap below D90";
        rules.push(most("Gap below the net against D90", gap, coarse, "m", ALBABA, advice));
    }
    if let Some(dissipators) = net.dissipators {
        rules.push(least(
            "Design resistance of an anchor against the plateau with the load factor",
            net.anchor_resistance / design.factors.anchor,
            design.factors.load * dissipators.plateau,
            "N",
            "derived: a dissipator at work loads its anchor with its plateau, whatever this flow shows",
            "choose a stronger anchor or a lower plateau",
        ));
        let bypass = if net.lateral_to == LateralTo::Anchors { 1.0 } else { 0.0 };
        rules.push(most(
            "Lateral ropes that pass the dissipators by",
            bypass,
            0.0,
            "",
            ALBABA,
            "tied to the anchors they load them far above the plateau; tie them to the rope ends",
        ));
    }
    rules
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::from_loads::guideline;
    use crate::design::read::read_design;

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
        assert_eq!(added(&|design| net(design).bottom = Bottom::Opening(2.0)), ["Gap below the net against D90"]);
        assert_eq!(added(&|design| net(design).height = 7.0), ["Height"]);
        assert_eq!(
            added(&|design| net(design).lateral_to = LateralTo::Anchors),
            ["Lateral ropes that pass the dissipators by"]
        );
        assert_eq!(
            added(&|design| {
                let slope = design.channel.slope;
                net(design).tilt = -slope;
            }),
            ["Angle between the net and the bed's normal"]
        );
    }
}
