//! A main rope under a uniform load: sag, tension and stroke of its dissipators.
//!
//! Parabola with sag f over span L: H = q L²/(8 f), end tension T = √(H² + (qL/2)²), exact arc length S(f).
//! The rope is as long as L (1 + T/EA) plus what both dissipators give.

/// A main rope with its dissipators, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeInput {
    /// Span between the anchors L (m).
    pub span: f64,
    /// Axial stiffness EA (N).
    pub axial_stiffness: f64,
    /// Plateau force (N) and stroke (m) of each dissipator, if there are any.
    pub dissipator: Option<[f64; 2]>,
}

/// State of the rope under its load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RopeState {
    /// Sag f (m).
    pub sag: f64,
    /// Tension at the ends (N); also the load of each anchor.
    pub tension: f64,
    /// Stroke used by each dissipator (m).
    pub stroke: f64,
}

impl RopeInput {
    /// Equilibrium under `load` (N/m, across the span).
    pub fn under(&self, load: f64) -> RopeState {
        if load <= 0.0 {
            return RopeState::default();
        }
        let elastic = self.with_stroke(load, 0.0);
        match self.dissipator {
            Some([plateau, stroke]) if elastic.tension > plateau => self.yielding(load, plateau, stroke),
            _ => elastic,
        }
    }

    /// On the plateau as long as stroke is left; beyond it the rope takes what comes.
    fn yielding(&self, load: f64, plateau: f64, stroke: f64) -> RopeState {
        let half = 0.5 * load * self.span;
        if half < plateau {
            let horizontal = (plateau * plateau - half * half).sqrt();
            let sag = load * self.span * self.span / (8.0 * horizontal);
            let used = 0.5 * (self.arc(sag) - self.span * (1.0 + plateau / self.axial_stiffness));
            if used <= stroke {
                return RopeState { sag, tension: plateau, stroke: used.max(0.0) };
            }
        }
        self.with_stroke(load, stroke)
    }

    /// Equilibrium with a given stroke at both ends, by bisection on the sag.
    fn with_stroke(&self, load: f64, stroke: f64) -> RopeState {
        let tension_at = |sag: f64| libm::hypot(load * self.span * self.span / (8.0 * sag), 0.5 * load * self.span);
        let excess =
            |sag: f64| self.arc(sag) - self.span * (1.0 + tension_at(sag) / self.axial_stiffness) - 2.0 * stroke;
        let (mut low, mut high) = (1e-9 * self.span, self.span);
        while excess(high) < 0.0 && high < 1e6 * self.span {
            high *= 2.0;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if excess(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let sag = 0.5 * (low + high);
        RopeState { sag, tension: tension_at(sag), stroke }
    }

    /// Arc length of a parabola of the given sag.
    fn arc(&self, sag: f64) -> f64 {
        let slope = 4.0 * sag / self.span;
        if slope < 1e-6 {
            return self.span * (1.0 + slope * slope / 6.0);
        }
        0.5 * self.span * ((1.0 + slope * slope).sqrt() + libm::asinh(slope) / slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn matches_the_worked_example_on_the_plateau() {
        // q 20 kN/m, L 15 m, plateau 250 kN: f = 2.8125 m, arc 16.306 m, ΔS = 1.306 m (inextensible rope).
        let rope = RopeInput { span: 15.0, axial_stiffness: 1e15, dissipator: Some([250e3, 2.5]) };
        let state = rope.under(20e3);
        assert_relative_eq!(state.sag, 2.8125, max_relative = 1e-9);
        assert_relative_eq!(rope.arc(state.sag), 16.306, max_relative = 1e-4);
        assert_relative_eq!(2.0 * state.stroke, 1.306, max_relative = 1e-3);
        assert_eq!(state.tension, 250e3);
    }

    #[test]
    fn exhausted_stroke_lets_the_tension_grow() {
        let rope = RopeInput { span: 15.0, axial_stiffness: 3.2e6, dissipator: Some([250e3, 0.2]) };
        let state = rope.under(30e3);
        assert_eq!(state.stroke, 0.2);
        assert!(state.tension > 250e3);
    }
}
