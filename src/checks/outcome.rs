//! The outcome of one check: demand, capacity, utilisation, verdict and where the rule comes from. The report
//! prints this object and never recomputes.

use crate::demand::Demand;

/// Share of its limit from which a passing check warns.
const WARN_FROM: f64 = 0.9;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckVerdict {
    Pass,
    /// Passes with less than 10 % to spare.
    Warn,
    Fail,
    /// Nothing to compare with: a demand without a capacity.
    Info,
}

impl CheckVerdict {
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Warn => "warn",
            Self::Fail => "fail",
            Self::Info => "info",
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
    /// SI unit of demand and capacity; `-` for shares.
    pub unit: &'static str,
    pub verdict: CheckVerdict,
    pub source: &'static str,
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
    pub unit: &'static str,
    pub source: &'static str,
}

impl CheckName {
    pub fn new(id: impl Into<String>, title: impl Into<String>, unit: &'static str, source: &'static str) -> Self {
        Self { id: id.into(), title: title.into(), unit, source }
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
        Self::judged(name, demand, Some(least), utilisation)
    }

    /// A demand that nothing is held against.
    pub fn informative(name: CheckName, demand: Demand) -> Self {
        Self::judged(name, demand, None, None)
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
        Self { id, title, demand, capacity, resistance: None, utilisation, unit, verdict, source }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(value: f64) -> CheckVerdict {
        let demand = Demand { guideline: Some(1.0), simulation: Some(value), cap: None };
        Outcome::at_most(
            CheckName::new("x", "x", "N", "x"),
            demand,
            Resistance { characteristic: 100.0, factor: 1.0 },
            1.0,
        )
        .verdict
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
        assert_eq!(Outcome::at_most(CheckName::new("x", "x", "N", "x"), demand, none, 1.0).verdict, CheckVerdict::Fail);
    }

    #[test]
    fn a_least_share_is_used_up_by_what_is_missing() {
        let outcome = |value, least| {
            let demand = Demand { simulation: Some(value), ..Demand::default() };
            Outcome::at_least(CheckName::new("x", "x", "-", "x"), demand, least)
        };
        assert!((outcome(0.95, 0.9).utilisation.unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(outcome(0.85, 0.9).verdict, CheckVerdict::Fail);
        assert_eq!(outcome(1.0, 1.0).verdict, CheckVerdict::Pass);
        assert_eq!(outcome(0.999, 1.0).verdict, CheckVerdict::Fail);
        assert_eq!(outcome(0.0, 0.0).verdict, CheckVerdict::Warn);
    }
}
