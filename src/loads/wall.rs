//! A wall that stands by its weight on a base of slope β, per metre of width: sliding along the base, overturning about its downstream
//! edge, and the pressure under it, under a load R along a bed of slope α.
//!
//! Its weight W = ρ g t H presses N = W cos β on the base and pulls T = W sin β down it; H is its height normal to the base, t its thickness
//! along it. Its face leans upstream by θ from the bed's normal, and so by ε = θ − δ from the base's, δ = α − β: its weight acts
//! a = t/2 − H tan ε/2 from the upstream end of the base. The flow pushes normal to the face, R along the bed and R tan θ off it. That is
//! R (cos δ + tan θ sin δ) along the base, and a lift L = R (tan θ cos δ − sin δ) off it where that is positive; where it is negative it
//! presses the wall down, which is left out. Sliding: R (cos δ + tan θ sin δ) + T ≤ (N − L) tan φ. Overturning: M_R + L b + T H/2 ≤ N (b − a),
//! with b the width of the base from the wall's upstream face and M_R the moment of the load about the upstream end of the base. Under the
//! base (N − L)/(b − 2 e) presses, e being the eccentricity of the resultant; there what the flow presses down with counts. The wall must
//! stand without the flow as well. Water under the base, with a head h at its upstream edge and none at its downstream edge, lifts with
//! U = ρ_w g h b/2 at 2 b/3 from the downstream edge: U tan φ and 2 U b/3 come beside the load, and N − U bears. The weight of the flow and
//! its friction on the wall are left out, which is on the safe side.
//!
//! The ground presses on the buried part of the face, of the depth d, with E = K (γ d²/2 + q d), and M_E = K (γ d³/6 + q d²/2) about the base,
//! both times the factor on loads and cos (α − β), because the pressure goes along the surface: K is Rankine's of active pressure under a surface
//! that rises with the bed, with the friction of the base, or 35° where that is more, and q what lies on the ground; that it presses the wall
//! down is left out. The ground in front, of the depth d₂ at the downstream edge, holds
//! with no more than its active pressure under a level surface, K₀ γ d₂²/2: the passive resistance, for which the wall would have to move, is
//! left out.

use crate::larger::larger_or_nan;

/// A gravity wall of even thickness, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallInput {
    /// Normal to its base (m).
    pub height: f64,
    /// Along its base (m).
    pub thickness: f64,
    pub base_width: f64,
    pub density: f64,
    pub base_friction: f64,
    /// Of the base, and of the bed along which the load acts (rad).
    pub base_slope: f64,
    pub bed_slope: f64,
    /// Of the face, upstream from the bed's normal (rad).
    pub face_lean: f64,
    /// Of the water under the upstream edge of the base (m).
    pub water_head: f64,
    /// How far the face goes on below the bed (m).
    pub buried: f64,
    pub ground: Ground,
}

/// The ground that a wall is founded in, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// With what is in its pores (kg/m³).
    pub density: f64,
    /// What lies on it upstream of the wall (Pa).
    pub surcharge: f64,
    /// Its depth over the downstream edge of the base (m).
    pub in_front: f64,
    /// Partial factor on what it presses with.
    pub factor: f64,
}

/// Friction angle (rad) beyond which the ground behind the face is not relied on: 35 degrees. A base that is rougher stands on rock or is keyed in,
/// and what its face is filled against need not be.
const MOST_FRICTION: f64 = 35.0 * std::f64::consts::PI / 180.0;

/// Rankine's coefficient of active pressure (-) of ground with the friction tan φ whose surface rises from the wall with the slope β (rad); a surface
/// steeper than such ground can stand is taken as steep as it can.
fn active(friction: f64, slope: f64) -> f64 {
    let steepest = libm::atan(friction);
    // Asked so that what is not a number stays so.
    let steepest = if steepest > MOST_FRICTION { MOST_FRICTION } else { steepest };
    let cosine = libm::cos(if slope < steepest { slope } else { steepest });
    let under_the_root = cosine * cosine - libm::cos(steepest).powi(2);
    let root = if under_the_root < 0.0 { 0.0 } else { under_the_root.sqrt() };
    cosine * (cosine - root) / (cosine + root)
}

/// kg/m³
const WATER: f64 = 1000.0;

impl WallInput {
    /// N/m
    pub fn weight(&self) -> f64 {
        self.density * crate::units::GRAVITY * self.thickness * self.height
    }

    /// Uplift of the water under the base (N/m).
    pub fn uplift(&self) -> f64 {
        0.5 * WATER * crate::units::GRAVITY * self.water_head * self.base_width
    }

    /// Thrust of that water on the buried part of the face (N/m), and its moment about the base (N m/m).
    pub fn water_thrust(&self) -> [f64; 2] {
        let (head, depth) = (self.water_head, self.water_head.min(self.buried));
        let unit = WATER * crate::units::GRAVITY;
        [unit * depth * (head - 0.5 * depth), unit * depth * depth * (0.5 * head - depth / 3.0)]
    }

    /// What the ground presses with on the buried part of the face, less what that in front holds (N/m), and its moment about the base (N m/m).
    pub fn earth_thrust(&self) -> [f64; 2] {
        let Ground { density, surcharge, in_front, factor } = self.ground;
        let (unit, depth) = (density * crate::units::GRAVITY, self.buried);
        let [behind, before] = [self.bed_slope, 0.0].map(|slope| active(self.base_friction, slope));
        let behind = behind * libm::cos(self.difference());
        let pressed = factor * behind * depth * (0.5 * unit * depth + surcharge);
        let tipped = factor * behind * depth * depth * (unit * depth / 6.0 + 0.5 * surcharge);
        let held = before * unit * in_front * in_front * 0.5;
        // Asked so that what is not a number stays so.
        let no_less = |value: f64| if value <= 0.0 { 0.0 } else { value };
        [no_less(pressed - held), no_less(tipped - held * in_front / 3.0)]
    }

    /// What of the weight presses on the ground, the uplift taken off (N/m); 0 for a wall that floats.
    pub fn bears(&self) -> f64 {
        (self.weight() * libm::cos(self.base_slope) - self.uplift()).max(0.0)
    }

    fn difference(&self) -> f64 {
        self.bed_slope - self.base_slope
    }

    /// Part along the base of what presses on the face, over the load R along the bed.
    pub fn along_share(&self) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        cosine + libm::tan(self.face_lean) * sine
    }

    /// Demand on sliding over the load R along the bed: its part along the base, and what its lift takes of the friction.
    pub fn sliding_share(&self) -> f64 {
        self.along_share() + self.base_friction * self.lift_share()
    }

    /// Lift off the base over the load R along the bed.
    pub fn lift_share(&self) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        (libm::tan(self.face_lean) * cosine - sine).max(0.0)
    }

    /// What presses on the base over the load R along the bed, beside the weight; nothing where it lifts.
    pub fn press_share(&self) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        (sine - libm::tan(self.face_lean) * cosine).max(0.0)
    }

    /// What presses on the base of a force on the wall (N/m), along the bed and normal to it, likewise.
    pub fn press(&self, along: f64, off: f64) -> f64 {
        self.lift(-along, -off)
    }

    /// How far its centre of weight lies upstream of the middle of its foot (m).
    fn hangs_upstream(&self) -> f64 {
        0.5 * self.height * libm::tan(self.face_lean - self.difference())
    }

    /// Eccentricity of its weight alone in its own thickness, towards the upstream edge (m): the wall stands without the flow as well.
    pub fn eccentricity_at_rest(&self) -> f64 {
        self.hangs_upstream() - 0.5 * self.height * libm::tan(self.base_slope)
    }

    /// Mean pressure (Pa) on the part of the base, b − 2 e, that is centred under the resultant (Meyerhof), with e its eccentricity towards
    /// the downstream edge (m) and the load that presses beside the weight (N/m); no more of the base bears than under the weight alone.
    /// Infinite where the resultant lies beyond an edge.
    pub fn pressure(&self, eccentricity: f64, press: f64) -> f64 {
        let from_upstream = 0.5 * self.thickness - self.eccentricity_at_rest();
        let at_rest = 2.0 * from_upstream.min(self.base_width - from_upstream);
        let loaded = self.base_width - 2.0 * eccentricity;
        // Asked so that what is not a number stays so.
        let bears = if loaded > at_rest { at_rest } else { loaded };
        let load = self.weight() * libm::cos(self.base_slope) + press;
        if bears <= 0.0 { f64::INFINITY } else { load / bears }
    }

    /// That pressure (Pa) under a moment about the upstream end of the base (N m/m) and a force that presses beside the weight (N/m), with
    /// the weight as it is or, where that is worse, times a factor. NaN if anything is.
    pub fn pressure_under(&self, moment: f64, press: f64, weight_factor: f64) -> f64 {
        let with = |factor: f64| {
            let wall = Self { density: factor * self.density, ..*self };
            let [holds, tilt] = wall.overturning();
            wall.pressure(0.5 * wall.base_width - (holds - tilt - moment) / wall.bears(), press)
        };
        larger_or_nan(with(1.0), with(weight_factor))
    }

    /// Demand on sliding of a force on the wall (N/m), along the bed and normal to it, likewise.
    pub fn sliding_demand(&self, along: f64, off: f64) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        along * cosine + off * sine + self.base_friction * self.lift(along, off)
    }

    /// Lift off the base of that force (N/m).
    pub fn lift(&self, along: f64, off: f64) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        let lift = off * cosine - along * sine;
        // Asked so that what is not a number stays so.
        if lift <= 0.0 { 0.0 } else { lift }
    }

    /// Per width (N/m): N tan φ, which friction holds, without partial factor, and T + U tan φ with the thrust of water and ground on the buried
    /// face, which come beside the load.
    pub fn sliding(&self) -> [f64; 2] {
        [
            self.weight() * libm::cos(self.base_slope) * self.base_friction,
            self.weight() * libm::sin(self.base_slope)
                + self.base_friction * self.uplift()
                + self.water_thrust()[0]
                + self.earth_thrust()[0],
        ]
    }

    /// Moments about the downstream edge (N m/m): what holds, and what the wall's own pull, the uplift and the thrust on the buried face add to the
    /// load.
    pub fn overturning(&self) -> [f64; 2] {
        let arm = self.base_width - 0.5 * self.thickness + self.hangs_upstream();
        [
            self.weight() * libm::cos(self.base_slope) * arm,
            self.weight() * libm::sin(self.base_slope) * 0.5 * self.height
                + self.uplift() * self.base_width * 2.0 / 3.0
                + self.water_thrust()[1]
                + self.earth_thrust()[1],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// 2 m high and 1 m thick, on a level and dry base below a level bed.
    const BLOCK: WallInput = WallInput {
        height: 2.0,
        thickness: 1.0,
        base_width: 1.0,
        density: 2400.0,
        base_friction: 0.7,
        base_slope: 0.0,
        bed_slope: 0.0,
        face_lean: 0.0,
        water_head: 0.0,
        buried: 0.0,
        ground: Ground { density: 2000.0, surcharge: 0.0, in_front: 0.0, factor: 1.0 },
    };

    /// Level ground of 30° has K = 1/3: 2 t/m³ on 3 m of the face press with 19.613 · 9/6 = 29.42 kN/m at 1 m, 30 kPa on it with 30 kN/m at 1.5 m. As deep
    /// in front it holds the first part of itself. Under a surface of its own steepness, 30°, K = cos 30°, under one of 20° 0.4142 (of tables).
    #[test]
    fn the_ground_presses_on_the_buried_face() {
        let friction = libm::tan(30_f64.to_radians());
        let wall = |surcharge: f64, in_front: f64| WallInput {
            base_friction: friction,
            buried: 3.0,
            ground: Ground { surcharge, in_front, ..BLOCK.ground },
            ..BLOCK
        };
        let [force, moment] = wall(0.0, 0.0).earth_thrust();
        assert_relative_eq!(force, 29.42e3, max_relative = 1e-3);
        assert_relative_eq!(moment, force, max_relative = 1e-9);
        let [with, about] = wall(30e3, 0.0).earth_thrust();
        assert_relative_eq!(with - force, 30e3, max_relative = 1e-9);
        assert_relative_eq!(about - moment, 45e3, max_relative = 1e-9);
        assert_eq!(wall(0.0, 3.0).earth_thrust(), [0.0, 0.0]);
        assert_relative_eq!(wall(30e3, 3.0).earth_thrust()[0], 30e3, max_relative = 1e-9);
        assert!(wall(f64::NAN, 3.0).earth_thrust()[0].is_nan());
        assert_relative_eq!(active(friction, 30_f64.to_radians()), 0.866_025_4, max_relative = 1e-6);
        assert_relative_eq!(active(friction, 20_f64.to_radians()), 0.4142, max_relative = 1e-3);
        assert_eq!(active(friction, 0.7), active(friction, 30_f64.to_radians()));
        // A base on rock says nothing of what its face is filled against.
        assert_relative_eq!(active(2.0, 0.0), 0.271, max_relative = 1e-3);
        assert!(active(f64::NAN, 0.0).is_nan());
    }

    #[test]
    fn a_block_on_level_ground_slides_at_w_tan_phi_and_tips_at_half_its_thickness() {
        let wall = WallInput { base_friction: 0.5, ..BLOCK };
        assert_relative_eq!(wall.weight(), 2400.0 * 9.81 * 2.0, max_relative = 1e-4);
        assert_eq!(wall.sliding(), [0.5 * wall.weight(), 0.0]);
        assert_eq!(wall.overturning(), [0.5 * wall.weight(), 0.0]);
    }

    #[test]
    fn a_block_on_its_friction_angle_holds_nothing_more() {
        let slope = 0.4_f64;
        let wall = WallInput { base_friction: libm::tan(slope), base_slope: slope, bed_slope: slope, ..BLOCK };
        let [hold, pull] = wall.sliding();
        assert_relative_eq!(hold, pull, max_relative = 1e-12);
    }

    #[test]
    fn a_plumb_face_is_pushed_level_and_an_overhanging_one_is_lifted() {
        let wall = |face_lean: f64| WallInput { bed_slope: 0.7, face_lean, ..BLOCK };
        // Plumb on a level base: a force R along the bed is R / cos α, level, and lifts nothing.
        let plumb = wall(0.7);
        assert_relative_eq!(plumb.sliding_share(), 1.0 / libm::cos(0.7_f64), max_relative = 1e-12);
        assert!(plumb.lift_share() < 1e-12);
        let force = [libm::cos(0.7_f64), libm::sin(0.7_f64)];
        assert_relative_eq!(plumb.sliding_demand(force[0], force[1]), 1.0, max_relative = 1e-12);
        // Normal to the bed it is pressed down.
        assert_relative_eq!(wall(0.0).sliding_share(), libm::cos(0.7_f64), max_relative = 1e-12);
        let over = wall(1.0);
        assert!(over.lift_share() > 0.0 && over.sliding_share() > plumb.sliding_share());
        assert!(plumb.lift(f64::NAN, 1.0).is_nan());
    }

    /// 2 m high and leaning downstream by tan ε = 0.1: the weight acts 0.1 m downstream of the middle of a foot of 1 m, 0.4 m from its edge, and
    /// bears on 0.8 m of it at rest; leaning upstream likewise, 0.6 m from the edge.
    #[test]
    fn a_leaning_wall_s_weight_acts_where_its_centre_is() {
        let wall = |lean: f64| WallInput { bed_slope: 0.4, face_lean: 0.4 + lean, ..BLOCK };
        let lean = libm::atan(0.1_f64);
        for (lean, arm) in [(-lean, 0.4), (0.0, 0.5), (lean, 0.6)] {
            let wall = wall(lean);
            assert_relative_eq!(wall.overturning()[0], arm * wall.weight(), max_relative = 1e-12);
            assert_relative_eq!(wall.eccentricity_at_rest(), arm - 0.5, max_relative = 1e-9, epsilon = 1e-12);
            let bears = 2.0 * f64::min(arm, 1.0 - arm);
            assert_relative_eq!(wall.pressure(-1.0, 0.0), wall.weight() / bears, max_relative = 1e-12);
        }
    }

    /// 2.4 t/m³, 2 m high and 1 m thick: 47.07 kN/m, at rest on no more than the metre below it, and off its centre by 0.2 m on 0.6 m.
    #[test]
    fn the_pressure_under_a_wall_is_its_weight_over_what_bears() {
        let wall = |base_width: f64| WallInput { base_width, bed_slope: 0.4, face_lean: 0.4, ..BLOCK };
        let weight = wall(1.0).weight();
        assert_relative_eq!(wall(1.0).pressure(0.2, 0.0), weight / 0.6, max_relative = 1e-12);
        assert_relative_eq!(wall(1.0).pressure(0.2, 6e3), (weight + 6e3) / 0.6, max_relative = 1e-12);
        assert_relative_eq!(wall(3.0).pressure(-1.0, 0.0), weight, max_relative = 1e-12);
        assert_eq!(wall(1.0).pressure(0.5, 0.0), f64::INFINITY);
        assert!(wall(1.0).pressure(f64::NAN, 0.0).is_nan() && wall(1.0).pressure(0.0, f64::NAN).is_nan());
        let wall = |base_width: f64| WallInput { face_lean: 0.0, ..wall(base_width) };
        // On a level base below a bed of 0.4 rad a force of 1 along it presses with sin 0.4, one off it lifts.
        assert_relative_eq!(wall(1.0).press_share(), 0.389_418_342, max_relative = 1e-9);
        assert_relative_eq!(wall(1.0).press(1.0, 0.1), 0.389_418_342 - 0.1 * 0.921_060_994, max_relative = 1e-8);
        assert_eq!(wall(1.0).press(0.0, 1.0), 0.0);
    }

    /// A head of 2 m lifts a base of 3 m with 1000 · 9.81 · 2 · 3/2 = 29.43 kN/m, 2 m from its downstream edge.
    #[test]
    fn water_under_the_base_lifts_the_wall() {
        let dry = WallInput { base_width: 3.0, base_friction: 0.5, ..BLOCK };
        let wet = WallInput { water_head: 2.0, ..dry };
        assert_relative_eq!(wet.uplift(), 29.43e3, max_relative = 1e-4);
        assert_relative_eq!(wet.bears(), dry.bears() - 29.43e3, max_relative = 1e-3);
        assert_relative_eq!(wet.sliding()[1], 14.715e3, max_relative = 1e-4);
        assert_relative_eq!(wet.overturning()[1], 58.86e3, max_relative = 1e-4);
        assert_eq!((wet.sliding()[0], wet.overturning()[0]), (dry.sliding()[0], dry.overturning()[0]));
        assert_eq!(WallInput { water_head: 9.0, ..dry }.bears(), 0.0);
    }

    /// 3.55 m of water on a face that goes on 4.7 m below the bed: ½ · 9.81 · 3.55² = 61.82 kN/m, a third of 3.55 m up. 3 m on one of 1 m: the lower
    /// metre of the triangle, 9.81 · 1 · 2.5 = 24.53 kN/m with 9.81 · (3/2 − 1/3) = 11.45 kN m/m.
    #[test]
    fn water_pushes_the_part_of_the_face_that_is_in_the_ground() {
        let thrust = |head: f64, buried: f64| WallInput { water_head: head, buried, ..BLOCK }.water_thrust();
        let [force, moment] = thrust(3.55, 4.7);
        assert_relative_eq!(force, 61.816e3, max_relative = 1e-4);
        assert_relative_eq!(moment, 61.816e3 * 3.55 / 3.0, max_relative = 1e-4);
        let [force, moment] = thrust(3.0, 1.0);
        assert_relative_eq!(force, 24.525e3, max_relative = 1e-4);
        assert_relative_eq!(moment, 11.445e3, max_relative = 1e-4);
        assert_eq!(thrust(3.0, 0.0), [0.0, 0.0]);
        let ground = Ground { density: 0.0, ..BLOCK.ground };
        let wet = WallInput { water_head: 3.55, buried: 4.7, ground, ..BLOCK };
        assert_relative_eq!(wet.sliding()[1] - wet.base_friction * wet.uplift(), 61.816e3, max_relative = 1e-4);
    }
}
