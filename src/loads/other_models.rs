//! Impact models beside the guideline's, so that a reader sees how far they differ for one flow.
//!
//! Each gives the force of a surge on the empty barrier per metre of width. None decides a check: they show the spread.

use crate::loads::cases::load_case::Certainty;
use crate::loads::input::GuidelineInput;

/// One model of the ladder.
pub struct Model {
    pub name: &'static str,
    pub formula: &'static str,
    /// Where it was found or is said to hold.
    pub range: &'static str,
    /// Froude numbers of that range, if it names them.
    pub froude: Option<[f64; 2]>,
    pub certainty: Certainty,
    /// Smallest and largest force (N/m); equal for a single value.
    force: fn(&GuidelineInput) -> [f64; 2],
}

impl Model {
    pub fn force(&self, input: &GuidelineInput) -> [f64; 2] {
        (self.force)(input)
    }

    /// Whether the flow's Froude number is within the range, where one is named.
    pub fn in_range(&self, input: &GuidelineInput) -> bool {
        self.froude.is_none_or(|[low, high]| (low..=high).contains(&input.froude()))
    }
}

/// ρ v² h (N/m).
fn momentum(input: &GuidelineInput) -> f64 {
    input.density * input.velocity.powi(2) * input.depth
}

fn factor(input: &GuidelineInput, low: f64, high: f64) -> [f64; 2] {
    [low, high].map(|alpha| alpha * momentum(input))
}

/// The reflected bore: h_r from ½ g' (h_r² − h²) = h v (v + c) with c = v h/(h_r − h).
///
/// Returns h_r (m) and c (m/s).
pub fn reflected_bore(input: &GuidelineInput) -> [f64; 2] {
    let GuidelineInput { depth, velocity, gravity_normal, .. } = *input;
    let celerity = |reflected: f64| velocity * depth / (reflected - depth);
    let excess = |reflected: f64| {
        0.5 * gravity_normal * (reflected * reflected - depth * depth)
            - depth * velocity * (velocity + celerity(reflected))
    };
    let (mut low, mut high) = (depth, 2.0 * depth);
    while excess(high) < 0.0 {
        high *= 2.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    [high, celerity(high)]
}

pub const MODELS: &[Model] = &[
    Model {
        name: "Volkwein 2014 / Wendeler 2008",
        formula: "½ K ρ g' h² + λ ρ v² h, λ 0.7 to 2",
        range: "flexible barriers",
        froude: None,
        certainty: Certainty::Cited,
        force: |input| {
            let fixed = 0.5 * input.unit_pressure() * input.depth.powi(2);
            factor(input, 0.7, 2.0).map(|moving| fixed + moving)
        },
    },
    Model {
        name: "Watanabe & Ikeya 1981",
        formula: "2 ρ v² h",
        range: "laminar, fine-grained",
        froude: None,
        certainty: Certainty::Cited,
        force: |input| factor(input, 2.0, 2.0),
    },
    Model {
        name: "Zhang 1993",
        formula: "3 to 5 ρ v² h",
        range: "coarse; from point gauges",
        froude: None,
        certainty: Certainty::Cited,
        force: |input| factor(input, 3.0, 5.0),
    },
    Model {
        name: "Bugnion et al. 2012",
        formula: "0.4 to 0.8 ρ v² h",
        range: "hillslope flows, v 2 to 13 m/s, h 0.3 to 1.0 m",
        froude: None,
        certainty: Certainty::Read,
        force: |input| factor(input, 0.4, 0.8),
    },
    Model {
        name: "Ng et al. 2016",
        formula: "about 1 ρ v² h",
        range: "centrifuge, rigid and flexible",
        froude: None,
        certainty: Certainty::Read,
        force: |input| factor(input, 1.0, 1.0),
    },
    Model {
        name: "Cui et al. 2015",
        formula: "5.3 Fr^−1.5 ρ v² h",
        range: "viscous flume, h 7 to 11 cm, v 2.4 to 5.2 m/s",
        froude: None,
        certainty: Certainty::Read,
        force: |input| [5.3 * libm::pow(input.froude(), -1.5) * momentum(input); 2],
    },
    Model {
        name: "Hungr et al. 1984",
        formula: "1.5 ρ v² h",
        range: "mean over the section, without boulders",
        froude: None,
        certainty: Certainty::Memory,
        force: |input| factor(input, 1.5, 1.5),
    },
    Model {
        name: "Lo 2000",
        formula: "3 ρ v² h",
        range: "Hong Kong, older practice",
        froude: None,
        certainty: Certainty::Memory,
        force: |input| factor(input, 3.0, 3.0),
    },
    Model {
        name: "Kwan 2012 (GEO), flexible to rigid",
        formula: "2.0 (flexible) to 2.5 (rigid) ρ v² h",
        range: "Hong Kong",
        froude: None,
        certainty: Certainty::Memory,
        force: |input| factor(input, 2.0, 2.5),
    },
    Model {
        name: "Hübl & Holzinger 2003",
        formula: "5 ρ v^0.8 (g h)^0.6 h",
        range: "fit to small-scale tests",
        froude: None,
        certainty: Certainty::Memory,
        force: |input| {
            let speed = libm::pow(input.gravity_normal * input.depth, 0.6) * libm::pow(input.velocity, 0.8);
            [5.0 * input.density * speed * input.depth; 2]
        },
    },
    Model {
        name: "Arattano & Franzi 2003",
        formula: "½ ρ g' h² + ρ v² h",
        range: "balance of momentum",
        froude: None,
        certainty: Certainty::Memory,
        force: |input| [0.5 * input.density * input.gravity_normal * input.depth.powi(2) + momentum(input); 2],
    },
    Model {
        name: "Armanini & Scotton 1993",
        formula: "½ ρ g' h_r², h_r of the reflected bore",
        range: "slow flows; above Fr 1 a vertical jet forms, and the bore underestimates the force",
        froude: Some([0.0, 1.0]),
        certainty: Certainty::Memory,
        force: |input| {
            let [reflected, _] = reflected_bore(input);
            [0.5 * input.density * input.gravity_normal * reflected * reflected; 2]
        },
    },
    Model {
        name: "NILIM, Japan",
        formula: "K_h ρ v² h, K_h = 1",
        range: "uniform over the depth",
        froude: None,
        certainty: Certainty::Memory,
        force: |input| factor(input, 1.0, 1.0),
    },
    Model {
        name: "Chinese code",
        formula: "λ ρ v² h, λ 1.0 (round) to 1.47 (square)",
        range: "upright face",
        froude: None,
        certainty: Certainty::Memory,
        force: |input| factor(input, 1.0, 1.47),
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// ρ 2000, h 1, v 6, g 9.81: Fr 1.92, ρ v² 72 kPa.
    fn input() -> GuidelineInput {
        GuidelineInput { gravity_normal: 9.81, ..crate::loads::cases::tests::input() }
    }

    fn of(name: &str) -> [f64; 2] {
        let model = MODELS.iter().find(|model| model.name.starts_with(name));
        model.map(|model| model.force(&input())).unwrap()
    }

    #[test]
    fn match_the_derived_ladder() {
        assert_relative_eq!(input().froude(), 1.92, max_relative = 3e-3);
        assert_eq!(of("Watanabe")[0], 144e3);
        assert_eq!(of("Zhang")[1], 360e3);
        assert_eq!(of("Kwan")[1], 180e3);
        assert_relative_eq!(of("Hübl")[0], 165.0e3, max_relative = 1e-3);
        assert_relative_eq!(of("Cui")[0], 143.9e3, max_relative = 2e-3);
        assert_relative_eq!(of("Arattano")[0], 81.8e3, max_relative = 1e-3);
        assert_relative_eq!(of("Armanini")[0], 112.1e3, max_relative = 1e-3);
        let [reflected, celerity] = reflected_bore(&input());
        assert_relative_eq!(reflected, 3.380, max_relative = 1e-3);
        assert_relative_eq!(celerity, 2.521, max_relative = 1e-3);
    }

    #[test]
    fn froude_models_cross_the_fixed_ones_where_derived() {
        // Hübl & Holzinger equals 2 ρ v² h at Fr 2.15 and 1 at 3.82.
        for (froude, alpha) in [(2.15, 2.0), (3.82, 1.0)] {
            let velocity = froude * (9.81_f64).sqrt();
            let input = GuidelineInput { velocity, ..input() };
            let model = MODELS.iter().find(|model| model.name.starts_with("Hübl")).unwrap();
            assert_relative_eq!(model.force(&input)[0] / momentum(&input), alpha, max_relative = 6e-3);
        }
    }

    /// ρ 1700, h 0.5, v 3, g' 9: ρ v² h = 7650 N/m, ρ g' h²/2 = 1912.5 N/m; K = 1.2.
    #[test]
    fn each_model_gives_its_formula() {
        let input = GuidelineInput {
            density: 1700.0,
            depth: 0.5,
            velocity: 3.0,
            gravity_normal: 9.0,
            earth_pressure: 1.2,
            ..crate::loads::cases::tests::input()
        };
        let froude = 3.0 / 4.5_f64.sqrt();
        let bore = reflected_bore(&input)[0];
        for (name, by_hand) in [
            ("Volkwein", [2295.0 + 5355.0, 2295.0 + 15300.0]),
            ("Watanabe", [15300.0; 2]),
            ("Zhang", [22950.0, 38250.0]),
            ("Bugnion", [3060.0, 6120.0]),
            ("Ng", [7650.0; 2]),
            ("Cui", [5.3 / libm::pow(froude, 1.5) * 7650.0; 2]),
            ("Hungr", [11475.0; 2]),
            ("Lo", [22950.0; 2]),
            ("Kwan", [15300.0, 19125.0]),
            ("Hübl", [5.0 * 1700.0 * libm::pow(4.5, 0.6) * libm::pow(3.0, 0.8) * 0.5; 2]),
            ("Arattano", [9562.5; 2]),
            ("Armanini", [0.5 * 1700.0 * 9.0 * bore * bore; 2]),
            ("NILIM", [7650.0; 2]),
            ("Chinese", [7650.0, 11245.5]),
        ] {
            let model = MODELS.iter().find(|model| model.name.starts_with(name)).expect(name);
            for (found, by_hand) in model.force(&input).iter().zip(by_hand) {
                assert_relative_eq!(*found, by_hand, max_relative = 1e-9);
            }
        }
        // The bore holds its two balances: mass (v + c) h = c h_r, and momentum.
        let [reflected, celerity] = reflected_bore(&input);
        assert_relative_eq!((3.0 + celerity) * 0.5, celerity * reflected, max_relative = 1e-9);
        assert_relative_eq!(4.5 * (reflected * reflected - 0.25), 1.5 * (3.0 + celerity), max_relative = 1e-9);
    }

    #[test]
    fn a_model_is_in_range_where_its_froude_numbers_are() {
        let bore = MODELS.iter().find(|model| model.name.starts_with("Armanini")).expect("a model");
        let at = |velocity: f64| GuidelineInput { velocity, depth: 1.0, gravity_normal: 9.0, ..input() };
        assert!(bore.in_range(&at(2.9)) && !bore.in_range(&at(3.1)));
        assert!(MODELS[0].in_range(&at(30.0)));
    }
}
