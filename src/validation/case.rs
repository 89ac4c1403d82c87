//! What a validation case is: a scene with a known answer, how well it must be met, how good the evidence is and where it
//! is weak.

use std::time::{Duration, Instant};

use dem::simulation::Unstable;

/// One case: a constant in its own file and a line in [`crate::validation::CASES`].
pub struct Case {
    /// Short name by which it is called.
    pub id: &'static str,
    pub suite: Suite,
    pub title: &'static str,
    /// Where the expected numbers come from.
    pub source: &'static str,
    pub tier: Tier,
    /// What this case cannot show.
    pub weakness: &'static str,
    pub cost: Cost,
    pub run: fn() -> Result<Vec<Finding>, Broken>,
}

/// A case that has run.
pub struct CaseRun {
    pub case: &'static Case,
    pub outcome: Result<Vec<Finding>, Broken>,
    pub time: Duration,
}

impl CaseRun {
    /// Runs one case.
    pub fn of(case: &'static Case) -> Self {
        let started = Instant::now();
        // Inside a pool no step has to enter one; cases that gain from more threads make their own.
        let outcome = match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
            Ok(pool) => pool.install(case.run),
            Err(error) => Err(Broken::Scene(error.to_string())),
        };
        Self { case, outcome, time: started.elapsed() }
    }

    pub fn passed(&self) -> bool {
        self.outcome.as_ref().is_ok_and(|findings| findings.iter().all(Finding::holds))
    }
}

/// The suites that `barrier-check validate` knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Suite {
    /// One contact, or one grain.
    Contact,
    /// Many grains.
    Bulk,
    /// Grains on rigid walls.
    Wall,
    /// Ropes and cylinders.
    Rope,
    /// Dissipators.
    Dissipator,
    /// Nets.
    Net,
    /// Whole barriers in the design's own scenes.
    FullScale,
}

impl Suite {
    pub const ALL: [Self; 7] =
        [Self::Contact, Self::Bulk, Self::Wall, Self::Rope, Self::Dissipator, Self::Net, Self::FullScale];

    pub fn word(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::Bulk => "bulk",
            Self::Wall => "wall",
            Self::Rope => "rope",
            Self::Dissipator => "dissipator",
            Self::Net => "net",
            Self::FullScale => "full-scale",
        }
    }
}

/// How good the evidence behind the expected numbers is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// A closed form or an identity.
    ClosedForm,
    /// Numbers of another code or of an experiment, read at their source.
    Published,
    /// Numbers quoted by others.
    SecondHand,
}

impl Tier {
    pub fn word(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Published => "published",
            Self::SecondHand => "second hand",
        }
    }
}

/// How long a case takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// A few seconds; also a test.
    Quick,
    /// Up to some minutes.
    Long,
}

/// One number that a case measured, and what was wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub what: String,
    pub measured: f64,
    pub wanted: Wanted,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    Near {
        value: f64,
        /// Absolute.
        tolerance: f64,
    },
    Between {
        low: f64,
        high: f64,
    },
    /// Told, not judged.
    Nothing,
}

impl Finding {
    /// Wanted within a share of the expected value.
    pub fn near(what: impl Into<String>, measured: f64, value: f64, share: f64) -> Self {
        Self::close(what, measured, value, share * value.abs())
    }

    /// Wanted within an absolute tolerance.
    pub fn close(what: impl Into<String>, measured: f64, value: f64, tolerance: f64) -> Self {
        Self { what: what.into(), measured, wanted: Wanted::Near { value, tolerance } }
    }

    pub fn between(what: impl Into<String>, measured: f64, low: f64, high: f64) -> Self {
        Self { what: what.into(), measured, wanted: Wanted::Between { low, high } }
    }

    pub fn told(what: impl Into<String>, measured: f64) -> Self {
        Self { what: what.into(), measured, wanted: Wanted::Nothing }
    }

    /// Whether it is as wanted; a number that is not finite never is.
    pub fn holds(&self) -> bool {
        match self.wanted {
            Wanted::Near { value, tolerance } => (self.measured - value).abs() <= tolerance,
            Wanted::Between { low, high } => (low..=high).contains(&self.measured),
            Wanted::Nothing => self.measured.is_finite(),
        }
    }
}

/// Why a case has no findings.
#[derive(Debug, thiserror::Error)]
pub enum Broken {
    #[error(transparent)]
    Unstable(#[from] Unstable),
    #[error("{0}")]
    Scene(String),
}
