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
    pub capacity: Option<f64>,
    /// Governing demand over capacity; for a least value, capacity over demand.
    pub utilisation: Option<f64>,
    /// SI unit of demand and capacity; `-` for shares.
    pub unit: &'static str,
    pub verdict: CheckVerdict,
    pub source: &'static str,
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
    /// The governing demand must stay below `limit` times `capacity`.
    pub fn at_most(name: CheckName, demand: Demand, capacity: f64, limit: f64) -> Self {
        let utilisation = demand.largest().map(|largest| largest / capacity);
        Self::judged(name, demand, Some(capacity), utilisation, limit)
    }

    /// The simulated value must reach `least`.
    pub fn at_least(name: CheckName, demand: Demand, least: f64) -> Self {
        let utilisation = demand.simulation.map(|value| if least <= 0.0 { 0.0 } else { least / value.max(1e-300) });
        Self::judged(name, demand, Some(least), utilisation, 1.0)
    }

    /// A demand that nothing is held against.
    pub fn informative(name: CheckName, demand: Demand) -> Self {
        Self::judged(name, demand, None, None, 1.0)
    }

    fn judged(name: CheckName, demand: Demand, capacity: Option<f64>, utilisation: Option<f64>, limit: f64) -> Self {
        let verdict = match utilisation {
            None => CheckVerdict::Info,
            // Asked as "within", so that a NaN fails.
            Some(value) if value <= WARN_FROM * limit => CheckVerdict::Pass,
            Some(value) if value <= limit => CheckVerdict::Warn,
            Some(_) => CheckVerdict::Fail,
        };
        let CheckName { id, title, unit, source } = name;
        Self { id, title, demand, capacity, utilisation, unit, verdict, source }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(value: f64) -> CheckVerdict {
        let demand = Demand { guideline: Some(1.0), simulation: Some(value) };
        Outcome::at_most(CheckName::new("x", "x", "N", "x"), demand, 100.0, 1.0).verdict
    }

    #[test]
    fn the_larger_demand_governs_and_nan_fails() {
        assert_eq!(verdict(89.0), CheckVerdict::Pass);
        assert_eq!(verdict(95.0), CheckVerdict::Warn);
        assert_eq!(verdict(101.0), CheckVerdict::Fail);
        assert_eq!(verdict(f64::NAN), CheckVerdict::Fail);
    }
}
