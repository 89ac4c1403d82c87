//! The resultant of a load case with its numbers put in, in kN and m, so that it can be followed with a pocket calculator.

use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;

/// How the resultant of a case is worked out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Working {
    /// The pressures that enter it, as sentences; empty where there is nothing to work out.
    pub pressures: String,
    /// The force per width, as a term.
    pub force: String,
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

/// Of a deposit and a moving flow over it.
pub fn of_a_surge(input: &GuidelineInput, diagram: &Diagram, deposit: f64, moving: f64) -> Working {
    let (unit, block, height) = (diagram.unit / 1e3, diagram.block / 1e3, deposit + moving);
    let over = height - diagram.top;
    let force = if over > 0.0 {
        let beside = diagram.top - deposit;
        format!(
            "½ · {unit:.3} · ({height:.3}² − {over:.3}²) + {block:.3} · {beside:.3} (the flow is deeper than the barrier)"
        )
    } else {
        format!("½ · {unit:.3} · {height:.3}² + {block:.3} · {moving:.3}")
    };
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
    Working { pressures: format!("{}; {dynamic}. ", unit_weight(input)), force }
}

/// Of a deposit at rest.
pub fn at_rest(input: &GuidelineInput, diagram: &Diagram) -> Working {
    let force = format!("½ · {:.3} · {:.3}²", diagram.unit / 1e3, diagram.surface);
    Working { pressures: format!("{}. ", unit_weight(input)), force }
}

/// Of a full barrier with a depth of flow over its top.
pub fn overtopped(input: &GuidelineInput, diagram: &Diagram, depth: f64) -> Working {
    let (unit, top) = (diagram.unit / 1e3, diagram.top);
    let force = format!("½ · {unit:.3} · ({top:.3}² + 2 · {top:.3} · {depth:.3})");
    Working { pressures: format!("{}. ", unit_weight(input)), force }
}

/// Of an even pressure over the whole height.
pub fn even(diagram: &Diagram) -> Working {
    Working { pressures: String::new(), force: format!("{:.3} · {:.3}", diagram.block / 1e3, diagram.top) }
}
