//! The resultant of a load case with its numbers put in, in kN and m, so that it can be followed with a pocket calculator.

use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;

/// How the resultant of a case is worked out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Working {
    /// There is nothing to work out.
    #[default]
    None,
    /// Of a deposit and a moving flow over it.
    OfASurge { input: GuidelineInput, diagram: Diagram, deposit: f64, moving: f64 },
    /// Of a deposit at rest.
    AtRest { input: GuidelineInput, diagram: Diagram },
    /// Of a full barrier with a depth of flow over its top.
    Overtopped { input: GuidelineInput, diagram: Diagram, depth: f64 },
    /// Of an even pressure over the whole height.
    Even { diagram: Diagram },
}

impl Working {
    /// The pressures that enter it, as sentences; empty where there are none.
    pub fn pressures(&self) -> String {
        match self {
            Self::None | Self::Even { .. } => String::new(),
            Self::OfASurge { input, .. } => {
                let (symbol, wood) = match input.wood == 1.0 {
                    true => ("", String::new()),
                    false => ("f_w ", format!("{:.2} · ", input.wood)),
                };
                let dynamic = format!(
                    "{symbol}λ ρ v² = {wood}{:.2} · {:.0} · {:.2}² = {:.1} kPa",
                    input.dynamic_pressure,
                    input.density,
                    input.velocity,
                    input.impact_pressure() / 1e3
                );
                format!("{}; {dynamic}. ", unit_weight(input))
            }
            Self::AtRest { input, .. } | Self::Overtopped { input, .. } => format!("{}. ", unit_weight(input)),
        }
    }

    /// The force per width, as a term.
    pub fn force(&self) -> String {
        match *self {
            Self::None => String::new(),
            Self::OfASurge { diagram, deposit, moving, .. } => {
                let (unit, block, height) = (diagram.unit / 1e3, diagram.block / 1e3, deposit + moving);
                let over = height - diagram.top;
                if over > 0.0 {
                    let beside = diagram.top - deposit;
                    return format!(
                        "½ · {unit:.3} · ({height:.3}² − {over:.3}²) + {block:.3} · {beside:.3} (the flow is deeper than the barrier)"
                    );
                }
                format!("½ · {unit:.3} · {height:.3}² + {block:.3} · {moving:.3}")
            }
            Self::AtRest { diagram, .. } => format!("½ · {:.3} · {:.3}²", diagram.unit / 1e3, diagram.surface),
            Self::Overtopped { diagram, depth, .. } => {
                let (unit, top) = (diagram.unit / 1e3, diagram.top);
                format!("½ · {unit:.3} · ({top:.3}² + 2 · {top:.3} · {depth:.3})")
            }
            Self::Even { diagram } => format!("{:.3} · {:.3}", diagram.block / 1e3, diagram.top),
        }
    }
}

/// K ρ g' with its numbers.
fn unit_weight(input: &GuidelineInput) -> String {
    format!(
        "K ρ g' = {:.2} · {:.0} · {:.3} = {:.3} kN/m³",
        input.earth_pressure,
        input.density,
        input.gravity_normal,
        input.unit_pressure() / 1e3
    )
}
