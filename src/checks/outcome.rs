//! The outcome of one check: demand, capacity, utilisation, verdict and where the rule comes from. The report
//! prints this object and never recomputes.

use crate::checks::between_bolts::{end_bolt_under_more, tension_under_more};
use crate::demand::Demand;
use crate::larger::larger_or_nan;
use crate::loads::posts::Strut;
use crate::loads::wall::WallInput;
use crate::quantities::quantity::{Quantity, Unit};

/// Share of its limit from which a passing check warns.
pub const WARN_FROM: f64 = 0.9;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckVerdict {
    Pass,
    /// Passes with less than 10 % to spare.
    Warn,
    Fail,
    /// Cannot be judged: something is missing, or the model cannot tell.
    Open,
    /// For information: the design sets no limit, and none is needed.
    Info,
}

impl CheckVerdict {
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Warn => "warn",
            Self::Fail => "fail",
            Self::Open => "open",
            Self::Info => "info",
        }
    }
}

/// What a check is of, where something hangs on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    #[default]
    Any,
    /// The load of the anchors of a main rope.
    Anchors,
    /// What a post, its foundation, its retaining ropes and their anchors bear.
    Posts,
    /// The share of the mass that is held.
    MassHeld,
    /// The share of its height that the barrier keeps.
    HeightLeft,
    /// The level that the flow reaches in front of the barrier.
    Level,
    /// The worst bolt of the lowest rope, whose load the equations spread evenly.
    Bolts,
    /// The lowest rope between its bolts, whose tension grows as the load of the worst bolt to the power of 2/3.
    BetweenBolts,
    /// The strength of a wall.
    WallStrength,
    /// The stroke of the dissipators of a rope, which ends at its stop.
    Stroke,
    /// The tension of dissipators, which passes their plateau only once a stroke is used up.
    DissipatorTension,
    /// The same of dissipators that yield along a curve, whose end may have less than its largest force.
    DissipatorCurve,
    /// The tension of a free main rope, of the lateral ropes, of the net.
    MainRope,
    LateralRopes,
    NetRopes,
    /// What acts at the base of a wall that stands by its weight, and does not grow in proportion to the load.
    BaseActions,
}

/// How a demand grows with the load of the flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoadScaling {
    /// In proportion, but for what is there without the flow: a wall's own pull and the water under it.
    InProportion { fixed: f64 },
    /// As the tension of a rope of this axial stiffness (N) between bolts that the load pulls on.
    BetweenBolts { axial: f64 },
    /// As the load of the bolt at the end of such a rope; in the simulation a lateral rope that grows in proportion pulls there too (N).
    EndBolt { axial: f64, lateral: f64 },
    /// As the pressure under a wall that stands by its weight.
    BasePressure(BasePressure),
    /// As the stroke of a dissipator beside which nothing else holds: in proportion up to where its rope is pulled with its force (N), and then all of
    /// it (m).
    ToItsStop { tension: f64, yields_at: f64, stroke: f64 },
    /// As the stroke (m) of the dissipators of a rope that hangs between two anchors.
    OfYieldingRope(YieldingRope),
    /// As the compression of a post whose moment grows with its compression.
    PostInteraction(PostInteraction),
}

/// A rope whose dissipators yield. Pulled with their force it sags in proportion to the load, and is longer than its span in proportion to the square of
/// that: with a stroke s and an elastic elongation e at that force, s + e grows with the square of the load beyond the one at which they begin to
/// yield. An elastic rope's tension grows less than in proportion, which makes that load larger than it is taken here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YieldingRope {
    /// As it was simulated, and with which the dissipators yield (N).
    pub tension: f64,
    pub yields_at: f64,
    /// Elongation of rope and dissipators at that, and the stroke that there is (m).
    pub elastic: f64,
    pub stroke: f64,
}

impl YieldingRope {
    /// The stroke (m) under so many times the load under which it is the given one. What is not a number stays so.
    fn stroke_under(&self, stroke: f64, more: f64) -> f64 {
        let pulled = self.tension / self.yields_at;
        let beyond = more * if pulled > 1.0 { 1.0 } else { pulled };
        let begins = if beyond <= 1.0 { 0.0 } else { self.elastic * (beyond * beyond - 1.0) };
        let grown = if more <= 1.0 { stroke * more } else { stroke * more * more + begins };
        if grown > self.stroke { self.stroke } else { grown }
    }
}

/// Compression (N) and moment (N m) of a post, by the equations and by the simulation, and what it withstands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PostInteraction {
    pub strut: Strut,
    pub guideline: Option<[f64; 2]>,
    pub simulation: Option<[f64; 2]>,
}

impl PostInteraction {
    /// The compression that uses up as much (N) by one route with so many times its load.
    pub fn compression(&self, route: Route, more: f64) -> Option<f64> {
        let [compression, moment] = match route {
            Route::Guideline => self.guideline,
            Route::Simulation => self.simulation,
        }?;
        Some(self.strut.with_moment(more * compression, more * moment))
    }
}

impl Default for LoadScaling {
    fn default() -> Self {
        Self::InProportion { fixed: 0.0 }
    }
}

/// A wall that stands by its weight, and what the flow does to it, by the equations and by the simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BasePressure {
    pub wall: WallInput,
    /// Factor on its weight.
    pub weight_factor: f64,
    /// Moment about the upstream end of its base, and force that presses on it beside its weight, per width (N m/m, N/m).
    pub guideline: Option<[f64; 2]>,
    pub simulation: Option<[f64; 2]>,
}

impl BasePressure {
    /// The pressure (Pa) by one route with so many times its load.
    pub fn pressure(&self, route: Route, more: f64) -> Option<f64> {
        let [moment, press] = match route {
            Route::Guideline => self.guideline,
            Route::Simulation => self.simulation,
        }?;
        Some(self.wall.pressure_under(more * moment, more * press, self.weight_factor))
    }
}

/// Where a demand comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    Guideline,
    Simulation,
}

/// Why a check is open, with what would close it, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OpenReason {
    /// The design gives no resistance for a part that carries load.
    NotGiven(String),
    /// The equations cannot make this check.
    NeedsSimulation(String),
    /// The demand is closer to the limit than the model is accurate.
    TooClose(String),
    /// The formula that governs is used outside its range.
    OutOfRange(String),
    /// What the simulation shows contradicts what the check rests on; a finer one may show otherwise.
    Contradicted(String),
}

impl OpenReason {
    pub fn words(&self) -> &str {
        match self {
            Self::NotGiven(words)
            | Self::NeedsSimulation(words)
            | Self::TooClose(words)
            | Self::OutOfRange(words)
            | Self::Contradicted(words) => words,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    pub id: String,
    pub title: String,
    /// With partial factors, SI.
    pub demand: Demand,
    /// Design resistance times the share of it that may be used.
    pub capacity: Option<f64>,
    /// Where the capacity is a resistance: its characteristic value, the partial factor, the share that may be used.
    pub resistance: Option<(Resistance, f64)>,
    /// Governing demand over capacity; for a least share, what is missing over what may be missing. At most 1 to pass.
    pub utilisation: Option<f64>,
    /// Of demand and capacity.
    pub unit: Unit,
    pub verdict: CheckVerdict,
    /// Why the check is open; nothing for any other verdict.
    pub open: Option<OpenReason>,
    /// Why the check would be open, where the design lets it stand all the same (`limits.outside_range`).
    pub stands_despite: Vec<OpenReason>,
    /// The main rope, counted from 0, whose parabola by the equations gives the guideline's demand, if one does.
    pub rope: Option<usize>,
    /// Whether the guideline's demand follows from its pressures.
    pub rests_on_pressures: bool,
    /// Whether it holds parts against each other, whatever the event: a rule of design, not a failure in the event.
    pub of_parts: bool,
    pub kind: Kind,
    /// How the demand grows with the load of the flow.
    pub growth: LoadScaling,
    /// What of the guideline's demand is from the simulation: the pull of a lateral rope (N).
    pub beside: f64,
    /// Where by the guideline more presses on the barrier than was simulated: how many times as much, and the utilisation scaled up to that.
    pub scaled: Option<Scaled>,
    pub source: &'static str,
}

/// A simulated demand under the larger load that the guideline has for the barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    /// Load by the guideline over the one that was simulated.
    pub more: f64,
    /// Utilisation under it.
    pub used: f64,
}

/// The check that uses most of its capacity, of those that have a share to tell.
pub fn most_used<'a>(outcomes: impl IntoIterator<Item = &'a Outcome>) -> Option<&'a Outcome> {
    let used = outcomes.into_iter().filter_map(|outcome| Some((outcome.used()?, outcome)));
    used.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, outcome)| outcome)
}

/// A characteristic resistance and the partial factor on it, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resistance {
    pub characteristic: f64,
    pub factor: f64,
}

/// What a check is called and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckName {
    pub id: String,
    pub title: String,
    pub unit: Unit,
    pub source: &'static str,
}

impl CheckName {
    /// The check of a quantity, of a rope that of its number, by the quantity's own title.
    pub fn of(quantity: &Quantity, index: usize, id: impl Into<String>, source: &'static str) -> Self {
        Self::new(id, quantity.title_of(index), quantity.unit, source)
    }

    pub fn new(id: impl Into<String>, title: impl Into<String>, unit: Unit, source: &'static str) -> Self {
        Self { id: id.into(), title: title.into(), unit, source }
    }

    /// The same, of each of so many ropes that run side by side.
    pub fn each_of(mut self, ropes: u16) -> Self {
        if ropes > 1 {
            self.title += &format!(", each of {ropes}");
        }
        self
    }
}

impl Outcome {
    /// The governing demand must stay below the share `limit` of the design resistance; the capacity shown is their product.
    pub fn at_most(name: CheckName, demand: Demand, resistance: Resistance, limit: f64) -> Self {
        let capacity = resistance.characteristic / resistance.factor * limit;
        // No capacity at all, or less than none, is no capacity to divide by.
        let used = |largest: f64| if capacity > 0.0 { largest / capacity } else { f64::INFINITY };
        let utilisation = demand.largest().map(used);
        Self { resistance: Some((resistance, limit)), ..Self::judged(name, demand, Some(capacity), utilisation) }
    }

    /// The simulated share must reach `least`; used is what is missing to 1, of what may be missing.
    pub fn at_least(name: CheckName, demand: Demand, least: f64) -> Self {
        let utilisation = demand.simulation.map(|value| match (1.0 - value, 1.0 - least) {
            (missing, _) if missing <= 0.0 => 0.0,
            (missing, allowed) if allowed > 0.0 => missing / allowed,
            // Nothing may be missing, and something is.
            (missing, _) => 1.0 + missing,
        });
        if least <= 0.0 && utilisation.is_none() {
            // Whatever is kept is enough.
            return Self::informative(name, demand);
        }
        Self::judged(name, demand, Some(least), utilisation)
    }

    /// A demand that needs no limit.
    pub fn informative(name: CheckName, demand: Demand) -> Self {
        Self::judged(name, demand, None, None)
    }

    /// A demand on a part for which the design gives no resistance: open as soon as the part carries load, with what to `give`.
    pub fn without_resistance(name: CheckName, demand: Demand, give: &str) -> Self {
        let mut outcome = Self::informative(name, demand);
        // Asked as "unloaded", so that a demand that is unknown or not a number leaves the check open.
        let unloaded = demand.largest().is_some_and(|largest| largest <= 0.0);
        if !unloaded {
            outcome.leave_open(OpenReason::NotGiven(format!(
                "the part carries load and the design gives no resistance for it (give {give})"
            )));
        }
        outcome
    }

    /// Leaves a check that would otherwise hold open where nothing was simulated, because the equations alone cannot make it.
    pub fn only_by_simulation(mut self, why: &str) -> Self {
        if self.demand.simulation.is_none() && matches!(self.verdict, CheckVerdict::Pass | CheckVerdict::Warn) {
            self.leave_open(OpenReason::NeedsSimulation(format!("{why} (run the simulation)")));
        }
        self
    }

    /// The guideline's demand comes from the parabola of this main rope.
    pub fn of_rope(self, rope: usize) -> Self {
        Self { rope: Some(rope), ..self }
    }

    /// The guideline's demand is a property of a part, whatever presses on the barrier.
    pub fn whatever_the_pressures(self) -> Self {
        Self { rests_on_pressures: false, ..self }
    }

    /// The check holds parts against each other, whatever the event.
    pub fn between_parts(self) -> Self {
        Self { of_parts: true, ..self.whatever_the_pressures() }
    }

    /// What is used of the capacity, under the load as it was simulated or scaled up to what the guideline has, whichever is more; what is not a
    /// number, of either sign, stands above all. Nothing where the check has no share.
    pub fn used(&self) -> Option<f64> {
        let scaled = self.scaled.map_or(f64::NEG_INFINITY, |scaled| scaled.used);
        self.utilisation
            .map(|used| larger_or_nan(used, scaled))
            .map(|used| if used.is_nan() { f64::NAN.abs() } else { used })
    }

    /// Takes down how much is used of a check that holds under a load larger than the simulated one.
    pub fn scale_up(&mut self, more: f64, used: f64) {
        self.scaled = Some(Scaled { more, used });
        if self.verdict == CheckVerdict::Pass && used > WARN_FROM {
            self.verdict = CheckVerdict::Warn;
        }
    }

    pub fn leave_open(&mut self, why: OpenReason) {
        (self.verdict, self.open) = (CheckVerdict::Open, Some(why));
    }

    /// Lets a check that passes stand with a warning, whatever speaks against it.
    pub fn stand_despite(&mut self, why: OpenReason) {
        if self.verdict == CheckVerdict::Pass {
            self.verdict = CheckVerdict::Warn;
        }
        self.stands_despite.push(why);
    }

    /// Whether the check holds, so far as it is judged.
    pub fn holds(&self) -> bool {
        matches!(self.verdict, CheckVerdict::Pass | CheckVerdict::Warn)
    }

    /// Whether it is of a rigid wall, which takes impacts as they come.
    pub fn is_of_a_wall(&self) -> bool {
        matches!(self.unit, Unit::NewtonPerMetre | Unit::NewtonMetrePerMetre | Unit::Pascal)
            || matches!(self.kind, Kind::WallStrength | Kind::BaseActions)
    }

    /// Whether the guideline's demand alone is beyond the capacity: no simulation can make such a check hold.
    pub fn fails_by_equations(&self) -> bool {
        let limit = self.capacity.filter(|_| self.resistance.is_some());
        self.verdict == CheckVerdict::Fail
            && self.demand.guideline.zip(limit).is_some_and(|(demand, capacity)| demand > capacity)
    }

    /// Whether the equations would fail it as they do `then`, the same check asked with something else, with what is beside them as well.
    pub fn would_fail(&self, then: &Self) -> bool {
        let with = then.demand.guideline.zip(self.capacity).filter(|_| self.beside > 0.0);
        // Asked as "within", so that what is not a number is not.
        let within = with.is_none_or(|(demand, capacity)| demand + self.beside <= capacity);
        then.fails_by_equations() || !within
    }

    /// The demand by one route with so many times the load of the flow.
    pub fn demand_under(&self, route: Route, more: f64) -> Option<f64> {
        let demand = match route {
            Route::Guideline => self.demand.guideline,
            Route::Simulation => self.demand.simulation,
        }?;
        match self.growth {
            LoadScaling::InProportion { fixed } => Some(fixed + (demand - fixed) * more),
            LoadScaling::BetweenBolts { axial } => Some(tension_under_more(demand, more, axial)),
            LoadScaling::EndBolt { axial, lateral } => {
                let lateral = if route == Route::Simulation { lateral } else { 0.0 };
                Some(end_bolt_under_more(demand - lateral, more, axial) + lateral * more)
            }
            LoadScaling::BasePressure(wall) => wall.pressure(route, more),
            LoadScaling::PostInteraction(post) => post.compression(route, more),
            LoadScaling::ToItsStop { tension, yields_at, stroke } if route == Route::Simulation => {
                // Asked so that a tension that is not a number yields.
                let stays = more <= 1.0 || more * tension < yields_at;
                Some(if stays { demand * more } else { stroke })
            }
            LoadScaling::OfYieldingRope(rope) if route == Route::Simulation => Some(rope.stroke_under(demand, more)),
            LoadScaling::ToItsStop { .. } | LoadScaling::OfYieldingRope(_) => Some(demand * more),
        }
    }

    /// Whether the guideline's demand decides, because it is the larger one or the only one.
    pub fn governed_by_equations(&self) -> bool {
        match (self.demand.guideline, self.demand.simulation) {
            (Some(guideline), Some(simulation)) => guideline >= simulation,
            (guideline, _) => guideline.is_some(),
        }
    }

    fn judged(name: CheckName, demand: Demand, capacity: Option<f64>, utilisation: Option<f64>) -> Self {
        let verdict = match utilisation {
            None => CheckVerdict::Info,
            // Asked as "within", so that a NaN fails.
            Some(value) if value <= WARN_FROM => CheckVerdict::Pass,
            Some(value) if value <= 1.0 => CheckVerdict::Warn,
            Some(_) => CheckVerdict::Fail,
        };
        let CheckName { id, title, unit, source } = name;
        let mut outcome = Self {
            id,
            title,
            demand,
            capacity,
            resistance: None,
            utilisation,
            unit,
            verdict,
            open: None,
            stands_despite: Vec::new(),
            rope: None,
            rests_on_pressures: true,
            of_parts: false,
            kind: Kind::Any,
            growth: LoadScaling::default(),
            beside: 0.0,
            scaled: None,
            source,
        };
        if capacity.is_some() && utilisation.is_none() {
            outcome.leave_open(OpenReason::NeedsSimulation(
                "the equations give no demand for it (run the simulation)".into(),
            ));
        }
        outcome
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name() -> CheckName {
        CheckName::new("x", "x", Unit::Newton, "x")
    }

    fn verdict(value: f64) -> CheckVerdict {
        let demand = Demand { guideline: Some(1.0), simulation: Some(value), ..Demand::default() };
        Outcome::at_most(name(), demand, Resistance { characteristic: 100.0, factor: 1.0 }, 1.0).verdict
    }

    #[test]
    fn the_larger_demand_governs_and_nan_fails() {
        assert_eq!(verdict(89.0), CheckVerdict::Pass);
        assert_eq!(verdict(95.0), CheckVerdict::Warn);
        assert_eq!(verdict(101.0), CheckVerdict::Fail);
        assert_eq!(verdict(f64::NAN), CheckVerdict::Fail);
        assert_eq!(verdict(-f64::NAN), CheckVerdict::Fail);
        let demand = Demand { guideline: Some(1.0), ..Demand::default() };
        let none = Resistance { characteristic: -5.0, factor: 1.0 };
        assert_eq!(Outcome::at_most(name(), demand, none, 1.0).verdict, CheckVerdict::Fail);
    }

    #[test]
    fn a_least_share_is_used_up_by_what_is_missing() {
        let outcome = |value, least| {
            let demand = Demand { simulation: Some(value), ..Demand::default() };
            Outcome::at_least(CheckName::new("x", "x", Unit::Share, "x"), demand, least)
        };
        assert!((outcome(0.95, 0.9).utilisation.unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(outcome(0.85, 0.9).verdict, CheckVerdict::Fail);
        assert_eq!(outcome(1.0, 1.0).verdict, CheckVerdict::Pass);
        assert_eq!(outcome(0.999, 1.0).verdict, CheckVerdict::Fail);
        assert_eq!(outcome(0.0, 0.0).verdict, CheckVerdict::Warn);
    }

    #[test]
    fn a_loaded_part_without_resistance_is_open_and_an_unloaded_one_is_not() {
        let of = |demand| Outcome::without_resistance(name(), demand, "the key x").verdict;
        let loaded = |value| Demand { simulation: Some(value), ..Demand::default() };
        assert_eq!(of(loaded(1.0)), CheckVerdict::Open);
        assert_eq!(of(loaded(f64::NAN)), CheckVerdict::Open);
        assert_eq!(of(Demand::default()), CheckVerdict::Open);
        assert_eq!(of(Demand { guideline: Some(5.0), ..loaded(0.0) }), CheckVerdict::Open);
        assert_eq!(of(loaded(0.0)), CheckVerdict::Info);
    }

    #[test]
    fn what_the_equations_cannot_judge_is_open_unless_they_already_fail_it() {
        let capacity = Resistance { characteristic: 100.0, factor: 1.0 };
        let by_equations = |guideline: Option<f64>| {
            let demand = Demand { guideline, ..Demand::default() };
            Outcome::at_most(name(), demand, capacity, 1.0).only_by_simulation("why").verdict
        };
        assert_eq!(by_equations(None), CheckVerdict::Open);
        assert_eq!(by_equations(Some(10.0)), CheckVerdict::Open);
        assert_eq!(by_equations(Some(101.0)), CheckVerdict::Fail);
        let simulated = Demand { guideline: Some(10.0), simulation: Some(20.0), ..Demand::default() };
        let outcome = Outcome::at_most(name(), simulated, capacity, 1.0).only_by_simulation("why");
        assert_eq!((outcome.verdict, outcome.open), (CheckVerdict::Pass, None));
        // A least share needs the simulation, but for one of nothing.
        let least =
            |least| Outcome::at_least(CheckName::new("x", "x", Unit::Share, "x"), Demand::default(), least).verdict;
        assert_eq!((least(0.9), least(0.0)), (CheckVerdict::Open, CheckVerdict::Info));
    }

    #[test]
    fn verdicts_and_reasons_have_their_words() {
        use CheckVerdict::{Fail, Info, Open, Pass, Warn};
        assert_eq!([Pass, Warn, Fail, Open, Info].map(CheckVerdict::word), ["pass", "warn", "fail", "open", "info"]);
        type Why = fn(String) -> OpenReason;
        let reasons: [Why; 5] = [
            OpenReason::NotGiven,
            OpenReason::NeedsSimulation,
            OpenReason::TooClose,
            OpenReason::OutOfRange,
            OpenReason::Contradicted,
        ];
        assert!(reasons.iter().all(|why| why("words".into()).words() == "words"));
    }

    #[test]
    fn the_equations_govern_where_they_tell_no_less() {
        let governed = |guideline: Option<f64>, simulation: Option<f64>| {
            let demand = Demand { guideline, simulation, ..Demand::default() };
            Outcome::informative(name(), demand).governed_by_equations()
        };
        assert!(governed(Some(2.0), Some(1.0)) && governed(Some(1.0), Some(1.0)) && governed(Some(1.0), None));
        assert!(!governed(Some(1.0), Some(2.0)) && !governed(None, Some(1.0)) && !governed(None, None));
    }

    #[test]
    fn where_nothing_may_be_missing_what_is_missing_is_beyond() {
        let demand = Demand { simulation: Some(0.75), ..Demand::default() };
        assert_eq!(Outcome::at_least(name(), demand, 1.0).utilisation, Some(1.25));
        let full = Demand { simulation: Some(1.0), ..Demand::default() };
        assert_eq!(Outcome::at_least(name(), full, 1.0).utilisation, Some(0.0));
    }

    #[test]
    fn no_capacity_holds_nothing_and_a_demand_at_its_capacity_does_not_fail() {
        let of = |guideline: f64, simulation: f64, characteristic: f64| {
            let demand = Demand { guideline: Some(guideline), simulation: Some(simulation), ..Demand::default() };
            let resistance = Resistance { characteristic, factor: 1.0 };
            Outcome::at_most(CheckName::new("x", "x", Unit::Newton, "x"), demand, resistance, 1.0)
        };
        assert_eq!(of(0.0, 0.0, 0.0).utilisation, Some(f64::INFINITY));
        assert_eq!(of(1.0, 1.0, 1.0).verdict, CheckVerdict::Warn);
        let by_simulation = of(1.0, 2.0, 1.0);
        assert!(by_simulation.verdict == CheckVerdict::Fail && !by_simulation.fails_by_equations());
        assert!(of(1.1, 2.0, 1.0).fails_by_equations());
    }
}
