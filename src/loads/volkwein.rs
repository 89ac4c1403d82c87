//! Loads of the WSL guideline on a barrier (Volkwein 2014, after Wendeler 2008).
//!
//! p_stat = K ρ g cos α H at depth H below the surface, p_dyn = λ ρ v² over the depth of the moving flow. Forces
//! are per metre of width and normal to the bed's normal, i.e. along the channel.

/// Flow and coefficients, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidelineInput {
    /// ρ, bulk density (kg/m³).
    pub density: f64,
    /// g cos α (m/s²).
    pub gravity_normal: f64,
    /// K
    pub earth_pressure: f64,
    /// λ
    pub dynamic_pressure: f64,
    /// Depth of the moving flow h (m).
    pub depth: f64,
    /// Velocity of the moving flow v (m/s).
    pub velocity: f64,
    /// Height to which the barrier fills, normal to the bed (m).
    pub fill_height: f64,
}

/// Pressures and force of one stage of filling.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCase {
    pub id: &'static str,
    pub title: &'static str,
    /// Height of the deposit at rest H_d (m).
    pub deposit: f64,
    /// Depth of the flow moving over it h (m); 0 when nothing moves.
    pub moving: f64,
    /// Static pressure at the bed (Pa).
    pub pressure_static: f64,
    /// Dynamic pressure on the moving depth (Pa).
    pub pressure_dynamic: f64,
    /// Resultant (N/m).
    pub force_per_width: f64,
}

/// Depths of deposit tried between the empty and the full barrier.
const STAGES: usize = 50;

impl GuidelineInput {
    /// Froude number v/√(g cos α h).
    pub fn froude(&self) -> f64 {
        self.velocity / (self.gravity_normal * self.depth).sqrt()
    }

    /// First surge on the empty barrier, last surge over the deposit, full barrier at rest.
    pub fn cases(&self) -> Vec<LoadCase> {
        let depth = self.depth.min(self.fill_height);
        vec![
            self.case("first_surge", "First surge on the empty barrier", 0.0, depth),
            self.case("last_surge", "Last surge over the deposit", self.fill_height - depth, depth),
            self.case("full", "Full, at rest", self.fill_height, 0.0),
        ]
    }

    /// One stage: R = ½ K ρ g' (H_d + h)² + λ ρ v² h.
    fn case(&self, id: &'static str, title: &'static str, deposit: f64, moving: f64) -> LoadCase {
        let unit = self.earth_pressure * self.density * self.gravity_normal;
        let total = deposit + moving;
        let dynamic = if moving > 0.0 { self.dynamic_pressure * self.density * self.velocity.powi(2) } else { 0.0 };
        LoadCase {
            id,
            title,
            deposit,
            moving,
            pressure_static: unit * total,
            pressure_dynamic: dynamic,
            force_per_width: 0.5 * unit * total * total + dynamic * moving,
        }
    }

    /// Largest force per width (N/m) on the strip between two heights over all stages of filling: the barrier full at
    /// rest, and the surge over every depth of deposit that leaves it room.
    pub fn governing_strip_force(&self, low: f64, high: f64) -> f64 {
        let depth = self.depth.min(self.fill_height);
        let room = self.fill_height - depth;
        let stages = (0..=STAGES).map(|stage| self.case("stage", "", room * stage as f64 / STAGES as f64, depth));
        let full = self.case("full", "", self.fill_height, 0.0);
        stages.chain([full]).map(|case| self.strip_force(&case, low, high)).fold(0.0, f64::max)
    }

    /// Force per width (N/m) that one stage puts on the strip between two heights (m) above the bed.
    pub fn strip_force(&self, case: &LoadCase, low: f64, high: f64) -> f64 {
        let unit = self.earth_pressure * self.density * self.gravity_normal;
        let total = case.deposit + case.moving;
        let depth_at = |height: f64| (total - height).max(0.0);
        let static_part = 0.5 * unit * (depth_at(low).powi(2) - depth_at(high).powi(2));
        let moving_span = high.min(total).max(case.deposit) - low.clamp(case.deposit, total);
        static_part + case.pressure_dynamic * moving_span.max(0.0)
    }
}

/// The part of stage R that the guideline books to the deposit, F₁ = K ρ g' H_d (H_d/2 + h), and to the moving
/// flow, F₂ = ½ K ρ g' h² + λ ρ v² h (the thesis's Eq. 5.4 with the depth it lacks). They add up to R.
pub fn split(input: &GuidelineInput, case: &LoadCase) -> (f64, f64) {
    let unit = input.earth_pressure * input.density * input.gravity_normal;
    let deposit = unit * case.deposit * (0.5 * case.deposit + case.moving);
    (deposit, 0.5 * unit * case.moving.powi(2) + case.pressure_dynamic * case.moving)
}

/// Height normal to the bed of a deposit whose surface is level, for a volume per width V on a bed of slope α behind a
/// barrier that leans upstream by θ from the bed's normal: V = ½ H² (cot α + tan θ).
/// A level surface is the highest a deposit can have at the barrier; on a level bed it is 0.
pub fn level_deposit_height(volume_per_width: f64, slope: f64, lean: f64) -> f64 {
    let spread = slope.tan().recip() + lean.tan();
    if spread > 0.0 { (2.0 * volume_per_width / spread).sqrt() } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn input() -> GuidelineInput {
        GuidelineInput {
            density: 2000.0,
            gravity_normal: 9.81 * 20_f64.to_radians().cos(),
            earth_pressure: 1.0,
            dynamic_pressure: 1.0,
            depth: 1.0,
            velocity: 6.0,
            fill_height: 4.0,
        }
    }

    #[test]
    fn matches_the_worked_example() {
        // ρ 2000, α 20°, H_d 3 m, h 1 m, v 6 m/s, K = λ = 1: F1 138.28, F2 81.22, R 219.49 kN/m.
        let case = &input().cases()[1];
        let (first, second) = split(&input(), case);
        assert_relative_eq!(first, 138.28e3, max_relative = 1e-4);
        assert_relative_eq!(second, 81.22e3, max_relative = 1e-4);
        assert_relative_eq!(case.force_per_width, 219.49e3, max_relative = 1e-4);
    }

    #[test]
    fn the_governing_stage_reaches_every_strip_with_the_moving_flow() {
        let input = input();
        // In the middle of a barrier 4 m high a flow 1 m deep gives at least λρv² over a strip of 1 m.
        let dynamic = input.dynamic_pressure * input.density * input.velocity.powi(2);
        assert!(input.governing_strip_force(1.5, 2.5) > dynamic);
        for case in input.cases() {
            assert!(input.governing_strip_force(1.0, 2.0) >= input.strip_force(&case, 1.0, 2.0));
        }
    }

    #[test]
    fn a_level_deposit_fills_the_triangle_behind_the_barrier() {
        let height = level_deposit_height(10.0, 0.5, 0.3);
        assert_relative_eq!(0.5 * height * height * (1.0 / 0.5_f64.tan() + 0.3_f64.tan()), 10.0, max_relative = 1e-12);
        assert_eq!(level_deposit_height(10.0, 0.0, 0.0), 0.0);
    }

    proptest! {
        #[test]
        fn parts_and_strips_add_up(depth in 0.1..3.0_f64, velocity in 0.0..12.0_f64, fill in 0.2..8.0_f64, cut in 0.01..0.99_f64) {
            let input = GuidelineInput { depth, velocity, fill_height: fill, ..input() };
            for case in input.cases() {
                let (first, second) = split(&input, &case);
                prop_assert!((first + second - case.force_per_width).abs() <= 1e-12 * case.force_per_width.max(1.0));
                let top = case.deposit + case.moving;
                let strips = input.strip_force(&case, 0.0, cut * top) + input.strip_force(&case, cut * top, top);
                prop_assert!((strips - case.force_per_width).abs() <= 1e-9 * case.force_per_width.max(1.0));
            }
        }
    }
}
