//! A main rope under a uniform load: sag, tension and stroke of its dissipators.
//!
//! Parabola with sag f over span L: H = q L²/(8 f), end tension T = √(H² + (qL/2)²), exact arc length S(f).
//! The rope is as long as L (1 + T/EA) plus what both dissipators give. Over posts, on whose heads it slides without friction, it has one H
//! in all its spans, so that their sags go with L², and lengths and arcs are those of all spans together.

use crate::yield_curve::YieldCurve;

/// What the equations know of a dissipator: it is rigid until it yields.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Yielding {
    /// Plateau force, or the largest of the curve (N).
    pub largest: f64,
    /// m
    pub stroke: f64,
    pub curve: YieldCurve,
}

impl Yielding {
    /// Force at which it yields when it has paid out `stroke` (m).
    fn force(&self, stroke: f64) -> f64 {
        self.largest * self.curve.force(stroke / self.stroke)
    }

    /// Below this force (N) it never yields.
    pub fn least(&self) -> f64 {
        self.largest * self.curve.least()
    }
}

/// Parts in which a falling part of a curve is searched.
const PARTS_OF_A_FALL: u32 = 64;

/// A main rope with its dissipators, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct RopeInput {
    /// Span between the anchors L, or the longest between banks and posts (m).
    pub span: f64,
    /// The other spans of a rope that runs over posts (m).
    pub other_spans: Vec<f64>,
    /// Of the rope beyond its spans, at both ends together, which stretches with it (m).
    pub to_anchors: f64,
    /// Axial stiffness EA (N).
    pub axial_stiffness: f64,
    /// How each dissipator yields, if there are any.
    pub dissipator: Option<Yielding>,
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
        match &self.dissipator {
            Some(dissipator) if elastic.tension > dissipator.force(0.0) => match dissipator.curve.is_plateau() {
                true => self.yielding(load, dissipator.largest, dissipator.stroke),
                false => self.along_the_curve(load, dissipator),
            },
            _ => elastic,
        }
    }

    /// Where the tension, which falls with the stroke, first meets the curve; beyond its end the rope takes what comes.
    fn along_the_curve(&self, load: f64, dissipator: &Yielding) -> RopeState {
        let short = |stroke: f64| self.with_stroke(load, stroke).tension > dissipator.force(stroke);
        let points = dissipator.curve.points();
        // Along a part that falls the two may meet twice; along any other, once at the most.
        let ends = points.windows(2).flat_map(|pair| {
            let parts = if pair[1][1] < pair[0][1] { PARTS_OF_A_FALL } else { 1 };
            let length = (pair[1][0] - pair[0][0]) / f64::from(parts);
            (1..=parts).map(move |part| if part == parts { pair[1][0] } else { pair[0][0] + f64::from(part) * length })
        });
        let mut low = 0.0;
        for end in ends.map(|share| share * dissipator.stroke) {
            if short(end) {
                low = end;
                continue;
            }
            let mut high = end;
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if short(middle) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            return self.with_stroke(load, high);
        }
        self.with_stroke(load, dissipator.stroke)
    }

    /// On the plateau as long as stroke is left; beyond it the rope takes what comes.
    fn yielding(&self, load: f64, plateau: f64, stroke: f64) -> RopeState {
        let half = 0.5 * load * self.span;
        if half < plateau {
            let horizontal = (plateau * plateau - half * half).sqrt();
            let sag = load * self.span * self.span / (8.0 * horizontal);
            let used = 0.5 * (self.arcs(sag) - self.stretched(plateau));
            if used <= stroke {
                return RopeState { sag, tension: plateau, stroke: used.max(0.0) };
            }
        }
        self.with_stroke(load, stroke)
    }

    /// Equilibrium with a given stroke at both ends, by bisection on the sag.
    fn with_stroke(&self, load: f64, stroke: f64) -> RopeState {
        let tension_at = |sag: f64| libm::hypot(load * self.span * self.span / (8.0 * sag), 0.5 * load * self.span);
        let excess = |sag: f64| self.arcs(sag) - self.stretched(tension_at(sag)) - 2.0 * stroke;
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

    /// All spans together (m).
    pub fn length(&self) -> f64 {
        self.span + self.other_spans.iter().sum::<f64>()
    }

    /// Length that the rope of all spans has under a tension (N), with what comes out of it from beyond them (m).
    pub fn stretched(&self, tension: f64) -> f64 {
        self.length() * (1.0 + tension / self.axial_stiffness) + self.to_anchors * tension / self.axial_stiffness
    }

    /// Length of the arcs of all spans together, with this sag of the longest, and by how much the rope beyond them is longer than straight across
    /// because it goes on as steeply as the longest span ends (m).
    pub fn arcs(&self, sag: f64) -> f64 {
        let other = |span: &f64| arc(*span, sag * (span / self.span).powi(2));
        let aslant = match self.to_anchors > 0.0 {
            true => self.to_anchors * (libm::hypot(1.0, 4.0 * sag / self.span) - 1.0),
            false => 0.0,
        };
        arc(self.span, sag) + self.other_spans.iter().map(other).sum::<f64>() + aslant
    }
}

/// Arc length of a parabola of a span with a sag (m).
pub fn arc(span: f64, sag: f64) -> f64 {
    let slope = 4.0 * sag / span;
    if slope < 1e-6 {
        return span * (1.0 + slope * slope / 6.0);
    }
    0.5 * span * ((1.0 + slope * slope).sqrt() + libm::asinh(slope) / slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn plateau(largest: f64, stroke: f64) -> Yielding {
        Yielding { largest, stroke, curve: YieldCurve::default() }
    }

    /// On the curve the tension is that of the dissipators at their stroke; a curve of one force is a plateau, and a harder one gives less stroke.
    #[test]
    fn a_rope_stops_where_its_tension_meets_the_curve() {
        let held = |points: &[[f64; 2]]| {
            let (curve, [largest, stroke]) = YieldCurve::of(points);
            RopeInput {
                span: 15.0,
                other_spans: Vec::new(),
                to_anchors: 0.0,
                axial_stiffness: 3.2e6,
                dissipator: Some(Yielding { largest, stroke, curve }),
            }
        };
        let flat = held(&[[0.0, 250e3], [2.5, 250e3]]);
        assert_eq!(flat.under(20e3), RopeInput { dissipator: Some(plateau(250e3, 2.5)), ..flat.clone() }.under(20e3));
        let rising = held(&[[0.0, 100e3], [0.5, 200e3], [2.5, 250e3]]);
        for load in [10e3, 15e3, 20e3] {
            let state = rising.under(load);
            let wanted =
                if state.stroke < 0.5 { 100e3 + 200e3 * state.stroke } else { 200e3 + 25e3 * (state.stroke - 0.5) };
            assert_relative_eq!(state.tension, wanted, max_relative = 1e-6);
            let more = flat.under(load);
            assert!(state.stroke > more.stroke && state.tension < more.tension, "{state:?} {more:?}");
        }
        // Straight across a fall and up again: the first place where it can stop.
        let falling = held(&[[0.0, 240e3], [0.4, 120e3], [2.5, 260e3]]);
        let state = falling.under(20e3);
        assert_relative_eq!(state.tension, 120e3 + 140e3 * (state.stroke - 0.4) / 2.1, max_relative = 1e-6);
        // A fall that is below the tension at both its ends and above it between them: it stops within.
        let free = RopeInput {
            span: 15.0,
            other_spans: Vec::new(),
            to_anchors: 0.0,
            axial_stiffness: 3.2e6,
            dissipator: None,
        };
        let [from, to] = [0.0, 0.9].map(|stroke| 0.99 * free.with_stroke(20e3, stroke).tension);
        let state = held(&[[0.0, from], [0.9, to]]).under(20e3);
        assert_relative_eq!(state.tension, from + (to - from) * state.stroke / 0.9, max_relative = 1e-6);
        assert!(state.stroke < 0.2, "{}", state.stroke);
        // Used up.
        let short = held(&[[0.0, 100e3], [0.2, 150e3]]);
        assert_eq!(short.under(30e3).stroke, 0.2);
        assert!(short.under(30e3).tension > 150e3);
    }

    #[test]
    fn matches_the_worked_example_on_the_plateau() {
        // q 20 kN/m, L 15 m, plateau 250 kN: f = 2.8125 m, arc 16.306 m, ΔS = 1.306 m (inextensible rope).
        let rope = RopeInput {
            span: 15.0,
            other_spans: Vec::new(),
            to_anchors: 0.0,
            axial_stiffness: 1e15,
            dissipator: Some(plateau(250e3, 2.5)),
        };
        let state = rope.under(20e3);
        assert_relative_eq!(state.sag, 2.8125, max_relative = 1e-9);
        assert_relative_eq!(rope.arcs(state.sag), 16.306, max_relative = 1e-4);
        assert_relative_eq!(2.0 * state.stroke, 1.306, max_relative = 1e-3);
        assert_eq!(state.tension, 250e3);
    }

    #[test]
    fn exhausted_stroke_lets_the_tension_grow() {
        let rope = RopeInput {
            span: 15.0,
            other_spans: Vec::new(),
            to_anchors: 0.0,
            axial_stiffness: 3.2e6,
            dissipator: Some(plateau(250e3, 0.2)),
        };
        let state = rope.under(30e3);
        assert_eq!(state.stroke, 0.2);
        assert!(state.tension > 250e3);
    }

    /// Length of a parabola by adding up short chords.
    fn length(span: f64, sag: f64) -> f64 {
        let count = 20_000;
        let height = |at: f64| 4.0 * sag * at * (1.0 - at);
        let point = |index: i32| f64::from(index) / f64::from(count);
        let rise = |index: i32| height(point(index + 1)) - height(point(index));
        (0..count).map(|index| libm::hypot(span / f64::from(count), rise(index))).sum()
    }

    /// Any rope is in balance, q L²/8 = H f and T² = H² + (q L/2)², and as long as its stretch and strokes make it.
    #[test]
    fn a_rope_is_in_balance_and_as_long_as_it_is_stretched() {
        let elastic =
            RopeInput { span: 12.0, other_spans: Vec::new(), to_anchors: 0.0, axial_stiffness: 8e6, dissipator: None };
        let used_up = RopeInput { dissipator: Some(plateau(100e3, 0.3)), ..elastic.clone() };
        // So much stroke that it hangs deeper than it spans.
        let deep = RopeInput {
            span: 2.0,
            other_spans: Vec::new(),
            to_anchors: 0.0,
            axial_stiffness: 8e6,
            dissipator: Some(plateau(1e3, 5.0)),
        };
        for (rope, load, stroke) in
            [(elastic.clone(), 15e3, 0.0), (elastic, 200.0, 0.0), (used_up, 40e3, 0.3), (deep.clone(), 10e3, 5.0)]
        {
            let RopeState { sag, tension, stroke: used } = rope.under(load);
            assert_eq!(used, stroke);
            let (across, horizontal) = (0.5 * load * rope.span, load * rope.span * rope.span / (8.0 * sag));
            assert_relative_eq!(tension, libm::hypot(across, horizontal), max_relative = 1e-9);
            let stretched = rope.span * (1.0 + tension / rope.axial_stiffness) + 2.0 * stroke;
            assert_relative_eq!(length(rope.span, sag), stretched, max_relative = 1e-7);
        }
        assert!(deep.under(10e3).sag > deep.span);
    }

    /// Below its plateau a dissipator holds; EA of 10 MN and 5 kN/m on 10 m.
    #[test]
    fn a_dissipator_below_its_plateau_is_as_if_it_were_not_there() {
        let free =
            RopeInput { span: 10.0, other_spans: Vec::new(), to_anchors: 0.0, axial_stiffness: 1e7, dissipator: None };
        let held = RopeInput { dissipator: Some(plateau(1e9, 1.0)), ..free.clone() };
        assert_eq!(held.under(5e3), free.under(5e3));
        assert!(free.under(5e3).tension < 1e9);
    }

    /// Over posts 6, 12 and 6 m apart: one pull in all spans, each as deep as q L²/(8 H), and all of them as long as the rope has become.
    #[test]
    fn over_posts_a_rope_has_one_pull() {
        let rope = RopeInput {
            span: 12.0,
            other_spans: vec![6.0, 6.0],
            to_anchors: 0.0,
            axial_stiffness: 8e6,
            dissipator: Some(plateau(100e3, 3.0)),
        };
        let state = rope.under(12e3);
        assert_eq!(state.tension, 100e3);
        let pull = (100e3_f64.powi(2) - 72e3_f64.powi(2)).sqrt();
        let sags = [12.0, 6.0, 6.0].map(|span| (span, 12e3 * span * span / (8.0 * pull)));
        assert_relative_eq!(state.sag, sags[0].1, max_relative = 1e-12);
        let arcs: f64 = sags.iter().map(|(span, sag)| length(*span, *sag)).sum();
        assert_relative_eq!(2.0 * state.stroke, arcs - 24.0 * (1.0 + 100e3 / 8e6), max_relative = 1e-6);
        // Without posts it sags more and pays out more.
        let free = RopeInput { span: 24.0, other_spans: Vec::new(), ..rope };
        assert!(free.under(6e3).stroke > 1.5 * state.stroke);
    }

    #[test]
    fn an_almost_straight_rope_is_longer_by_two_thirds_of_its_slope_squared() {
        let rope =
            RopeInput { span: 10.0, other_spans: Vec::new(), to_anchors: 0.0, axial_stiffness: 1e7, dissipator: None };
        // A slope of 4e-7 at its ends: 16e-14/6.
        assert!((rope.arcs(1e-6) / 10.0 - 1.0 - 16e-14 / 6.0).abs() < 1e-15);
        assert_relative_eq!(rope.arcs(1e-3), length(10.0, 1e-3), max_relative = 1e-12);
    }
}
