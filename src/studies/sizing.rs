//! The cheapest way to put choices together that passes, and how it is found.
//!
//! Every way is priced, and asked in the order of its price. What the equations refute needs no simulation; what they leave is simulated once, with
//! coarse grains where these decide it ([`crate::fidelity::ladder`]). What then passes, or is too close to tell, is simulated with several packings.
//! The first that passes these with the margin wanted is the cheapest: all that cost less have failed, or are told as undecided.
//!
//! Ways that differ in resistances alone move alike, and are simulated once ([`mechanics`]).

use schemars::JsonSchema;
use serde::Serialize;

use crate::checks::outcome::{CheckVerdict, OpenReason, Outcome, most_used};
use crate::design::anchors::AnchorResistance;
use crate::design::{BarrierDesign, Design, Project};
use crate::pipeline::{Run, Verdict};

/// What is asked of the way that is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Of every check, the share of what it may use that is to be left.
    pub margin: f64,
    /// Whether the equations alone decide.
    pub by_equations: bool,
    /// Packings with which the cheapest is confirmed.
    pub packings: u32,
    /// Ways that are simulated at the most.
    pub most_simulated: usize,
}

/// What a way came to.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "is")]
pub enum CandidateResult {
    /// It is no design.
    Impossible {
        why: String,
    },
    /// It costs more than the cheapest that passes, or the search has ended before.
    NotAsked,
    Fails {
        by: String,
        check: String,
        used: f64,
    },
    Undecided {
        by: String,
        why: String,
        used: f64,
    },
    Passes {
        by: String,
        check: String,
        used: f64,
    },
}

/// A way to put the choices together.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Candidate {
    /// Its number among all.
    pub number: usize,
    /// Nothing where it is no design.
    pub price: Option<f64>,
    pub fate: CandidateResult,
}

/// Why a way has no run.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// It cannot be simulated.
    OfTheWay(String),
    /// The search cannot go on.
    OfAll(String),
}

/// What the search needs of the ways.
pub trait Candidates: Sync {
    fn count(&self) -> usize;
    /// Price of a way, or why it is no design.
    fn price(&self, number: usize) -> Result<f64, String>;
    fn by_equations(&self, number: usize) -> Result<Run, String>;
    /// By a single simulation, of coarse grains where these decide it, and with so many packings.
    fn simulated_once(&self, number: usize) -> Result<Run, Fault>;
    fn confirmed(&self, number: usize, packings: u32) -> Result<Run, Fault>;
    /// Jobs side by side, their results in order.
    fn side_by_side<T: Send>(&self, numbers: &[usize], job: impl Fn(usize) -> T + Sync) -> Vec<T>;
    /// How many jobs run at once.
    fn at_once(&self) -> usize;
    fn tell(&self, way: &Candidate);
}

/// What came of a search.
#[derive(Clone, Debug)]
pub struct Found {
    /// In the order of their price, those that are no designs last.
    pub ways: Vec<Candidate>,
    /// The cheapest that passes, or by equations alone that they do not refute, by its place in that list.
    pub cheapest: Option<usize>,
    /// Whether ways were left because enough had been simulated.
    pub out_of_budget: bool,
}

/// What refutes a way for certain: a check that fails by the equations, or one that uses more by them than the margin leaves. Where such a check
/// is open, no simulation closes it so: the larger of both demands governs.
fn refuted(run: &Run, wanted: &Wanted) -> Option<(String, f64)> {
    let limit = 1.0 - wanted.margin;
    let fails = |outcome: &&Outcome| {
        let judged = outcome.verdict != CheckVerdict::Info;
        let beyond = judged && outcome.utilisation.is_some_and(|used| used > limit);
        outcome.fails_by_equations() || beyond
    };
    worst_of(run.outcomes.iter().filter(fails))
}

/// The worst of checks that fail, and how much it uses; one without a share to tell, such as a dissipator that is used up, is beyond all.
fn worst_of<'a>(failing: impl Iterator<Item = &'a Outcome>) -> Option<(String, f64)> {
    let used = failing.map(|outcome| (outcome.used().unwrap_or(f64::INFINITY), outcome));
    used.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(used, outcome)| (outcome.title.clone(), used))
}

/// What a run says of a way, with the margin wanted.
fn fate_of(run: &Run, by: &str, wanted: &Wanted) -> CandidateResult {
    let titled = |outcome: &Outcome| Some((outcome.used()?, outcome.title.clone()));
    let (used, check) = most_used(&run.outcomes).and_then(titled).unwrap_or((f64::NAN, String::new()));
    let by = by.to_string();
    match run.verdict {
        Verdict::Fail => {
            let failed = run.outcomes.iter().filter(|outcome| outcome.verdict == CheckVerdict::Fail);
            let (check, used) = worst_of(failed).unwrap_or((check, used));
            CandidateResult::Fails { by, check, used }
        }
        Verdict::Undecided => {
            let open = run.outcomes.iter().filter(|outcome| outcome.verdict == CheckVerdict::Open);
            let open: Vec<&Outcome> = open.collect();
            let titles: Vec<&str> = open.iter().take(3).map(|outcome| outcome.title.as_str()).collect();
            let more = if open.len() > 3 { format!(" and {} more", open.len() - 3) } else { String::new() };
            let first = open.first().and_then(|outcome| outcome.open.as_ref()).map_or("", OpenReason::words);
            let why = run.doubts.first().cloned().unwrap_or_else(|| format!("{}{more}: {first}", titles.join(", ")));
            CandidateResult::Undecided { by, why, used }
        }
        // Asked so that what is not a number does not pass.
        Verdict::Pass if used <= 1.0 - wanted.margin => CandidateResult::Passes { by, check, used },
        Verdict::Pass => CandidateResult::Fails { by, check, used },
    }
}

/// The rung that decided a run, in words.
fn rung_of(run: &Run) -> String {
    let packings = run.simulated.as_ref().map_or(0, |simulated| simulated.starts.len());
    match packings {
        0 => BY_EQUATIONS.to_string(),
        1 => "one simulation".to_string(),
        several => format!("{several} simulations"),
    }
}

pub const BY_EQUATIONS: &str = "equations";

/// Searches the cheapest way that passes.
pub fn search(ways: &impl Candidates, wanted: &Wanted) -> Result<Found, String> {
    let numbers: Vec<usize> = (0..ways.count()).collect();
    let prices = ways.side_by_side(&numbers, |number| ways.price(number));
    let mut list: Vec<Candidate> = numbers
        .into_iter()
        .zip(prices)
        .map(|(number, price)| match price {
            Ok(price) => Candidate { number, price: Some(price), fate: CandidateResult::NotAsked },
            Err(why) => Candidate { number, price: None, fate: CandidateResult::Impossible { why } },
        })
        .collect();
    // What costs nothing is no cheapest: the order would be that of the list.
    if list.iter().any(|way| way.price.is_some()) && list.iter().all(|way| way.price.is_none_or(|price| price <= 0.0)) {
        return Err("prices: nothing that is priced is part of these barriers, so that all cost nothing (without prices the mass of steel counts, and a wall has none); price what the choices change, for example wall_volume and foundation_volume".into());
    }
    let order = |way: &Candidate| way.price.unwrap_or(f64::INFINITY);
    list.sort_by(|a, b| order(a).total_cmp(&order(b)).then(a.number.cmp(&b.number)));
    let mut found = Found { ways: list, cheapest: None, out_of_budget: false };
    let mut simulated = 0;
    let possible = found.ways.iter().filter(|way| way.price.is_some()).count();
    let mut next = 0;
    // What the equations leave, in the order of its price, and not yet simulated.
    let mut left: Vec<usize> = Vec::new();
    while found.cheapest.is_none() {
        while left.len() < ways.at_once() && next < possible {
            let block: Vec<usize> = (next..(next + BLOCK).min(possible)).collect();
            next += block.len();
            let runs = ways.side_by_side(&block, |place| ways.by_equations(found.ways[place].number));
            for (place, run) in block.into_iter().zip(runs) {
                let run = run?;
                match refuted(&run, wanted) {
                    Some((check, used)) => {
                        found.ways[place].fate = CandidateResult::Fails { by: BY_EQUATIONS.into(), check, used };
                    }
                    // What the equations do not refute need not pass: the verdict says.
                    None if wanted.by_equations => {
                        if found.cheapest.is_none() {
                            found.ways[place].fate = fate_of(&run, BY_EQUATIONS, wanted);
                            found.cheapest = Some(place);
                        }
                    }
                    None => {
                        match run.outcomes.iter().find(|outcome| matches!(outcome.open, Some(OpenReason::NotGiven(_))))
                        {
                            // No simulation gives what the design leaves out.
                            Some(_) => found.ways[place].fate = fate_of(&run, BY_EQUATIONS, wanted),
                            None => left.push(place),
                        }
                    }
                }
            }
            if found.cheapest.is_some() {
                return Ok(found);
            }
        }
        let room = wanted.most_simulated.saturating_sub(simulated);
        let wave: Vec<usize> = left.drain(..left.len().min(ways.at_once()).min(room)).collect();
        if wave.is_empty() {
            found.out_of_budget = !left.is_empty();
            break;
        }
        simulated += wave.len();
        let runs = ways.side_by_side(&wave, |place| ways.simulated_once(found.ways[place].number));
        for (place, run) in wave.into_iter().zip(runs) {
            let (mut fate, run) = told(run, wanted)?;
            if found.cheapest.is_none() && run.is_some_and(|run| several_may_pass(&run, &fate)) {
                let confirmed = ways.confirmed(found.ways[place].number, wanted.packings);
                fate = told(confirmed, wanted)?.0;
                if matches!(fate, CandidateResult::Passes { .. }) {
                    found.cheapest = Some(place);
                }
            }
            found.ways[place].fate = fate;
            ways.tell(&found.ways[place]);
        }
    }
    Ok(found)
}

/// What a simulation says of a way; one that cannot be made leaves it undecided.
fn told(run: Result<Run, Fault>, wanted: &Wanted) -> Result<(CandidateResult, Option<Run>), String> {
    match run {
        Ok(run) => Ok((fate_of(&run, &rung_of(&run), wanted), Some(run))),
        Err(Fault::OfTheWay(why)) => {
            Ok((CandidateResult::Undecided { by: "no simulation".into(), why, used: f64::NAN }, None))
        }
        Err(Fault::OfAll(why)) => Err(why),
    }
}

/// Whether several packings may pass what one simulation shows: it passes, or nothing is open that none of them can close.
fn several_may_pass(run: &Run, fate: &CandidateResult) -> bool {
    let closable = |outcome: &Outcome| match &outcome.open {
        Some(OpenReason::TooClose(_) | OpenReason::Contradicted(_)) | None => true,
        Some(OpenReason::NotGiven(_) | OpenReason::NeedsSimulation(_) | OpenReason::OutOfRange(_)) => false,
    };
    match fate {
        CandidateResult::Passes { .. } => true,
        CandidateResult::Undecided { .. } => run.doubts.is_empty() && run.outcomes.iter().all(closable),
        CandidateResult::Fails { .. } | CandidateResult::Impossible { .. } | CandidateResult::NotAsked => false,
    }
}

/// Ways that the equations are asked of at a time.
const BLOCK: usize = 64;

/// The design without what only its checks ask of it: two designs that are alike in this move alike.
pub fn mechanics(design: &Design) -> Design {
    let mut bare = design.clone();
    bare.project = Project::default();
    match &mut bare.barrier {
        BarrierDesign::FlexibleNet(net) => {
            let bare_anchor = AnchorResistance::Characteristic(0.0);
            net.anchor_designs.all.resistance = bare_anchor;
            net.anchor_designs.each.iter_mut().for_each(|(_, _, anchor)| anchor.resistance = bare_anchor);
            if let Some(bolts) = &mut net.bed_bolts {
                bolts.resistance = None;
            }
        }
        BarrierDesign::RigidWall(wall) => {
            (wall.resistance, wall.moment_resistance) = (None, None);
        }
    }
    bare
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::{DesignFile, read_design};
    use crate::pipeline::by_equations;
    use crate::starts::side_by_side;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// A wall with its thickness, founding, friction and density chosen, by the equations alone.
    struct Walls {
        file: DesignFile,
        asked: AtomicUsize,
    }

    const EACH: usize = 10;

    impl Walls {
        fn file(&self, number: usize) -> DesignFile {
            let digit = |place: u32| (number / EACH.pow(place) % EACH) as f64;
            let mut file = self.file.clone();
            let BarrierDesign::RigidWall(wall) = &mut file.design.barrier else { panic!("a wall") };
            let stability = wall.stability.as_mut().expect("stability");
            stability.thickness = 3.0 + 0.5 * digit(0);
            stability.base_width = stability.thickness;
            stability.founding_depth = 1.9 + 0.1 * digit(1);
            stability.base_friction = 0.4 + 0.03 * digit(2);
            stability.density = 2000.0 + 50.0 * digit(3);
            file
        }
    }

    impl Candidates for Walls {
        fn count(&self) -> usize {
            EACH.pow(4)
        }

        /// Concrete by its weight, excavation, and a dearer base.
        fn price(&self, number: usize) -> Result<f64, String> {
            let BarrierDesign::RigidWall(wall) = self.file(number).design.barrier else { return Err("no wall".into()) };
            let stability = wall.stability.expect("stability");
            let concrete = stability.thickness * (wall.height + stability.founding_depth);
            Ok(0.12 * stability.density * concrete + 80.0 * stability.founding_depth + 700.0 * stability.base_friction)
        }

        fn by_equations(&self, number: usize) -> Result<Run, String> {
            self.asked.fetch_add(1, Ordering::Relaxed);
            Ok(by_equations(self.file(number)))
        }

        fn simulated_once(&self, _: usize) -> Result<Run, Fault> {
            Err(Fault::OfAll("nothing is simulated here".into()))
        }

        fn confirmed(&self, _: usize, _: u32) -> Result<Run, Fault> {
            Err(Fault::OfAll("nothing is simulated here".into()))
        }

        fn side_by_side<T: Send>(&self, numbers: &[usize], job: impl Fn(usize) -> T + Sync) -> Vec<T> {
            side_by_side(self.at_once(), numbers.len(), |index| job(numbers[index]))
        }

        fn at_once(&self) -> usize {
            2
        }

        fn tell(&self, _: &Candidate) {}
    }

    const WANTED: Wanted = Wanted { margin: 0.1, by_equations: true, packings: 5, most_simulated: 10 };

    /// Of ten thousand walls the search finds what trying them all finds, and asks of fewer.
    #[test]
    fn the_cheapest_is_that_of_an_exhaustive_search() {
        let file = read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap();
        let walls = Walls { file, asked: AtomicUsize::new(0) };
        let found = search(&walls, &WANTED).unwrap();
        let asked = walls.asked.load(Ordering::Relaxed);
        let place = found.cheapest.expect("a wall that is not refuted");
        let all: Vec<usize> = (0..walls.count()).collect();
        let stands = walls.side_by_side(&all, |number| {
            let run = walls.by_equations(number).unwrap();
            refuted(&run, &WANTED).is_none().then(|| walls.price(number).unwrap())
        });
        let least = stands.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(found.ways[place].price, Some(least));
        assert!(stands.iter().flatten().count() > 100, "a choice worth searching");
        assert!((100..walls.count() / 2).contains(&asked), "{asked} asked");
        // The equations alone do not pass it: what is found is no verdict.
        assert!(matches!(found.ways[place].fate, CandidateResult::Undecided { .. }), "{:?}", found.ways[place].fate);
    }

    /// Designs that differ in resistances alone are one to the simulation, and others are not.
    #[test]
    fn resistances_do_not_move_a_barrier() {
        let text = include_str!("../../tests/fixtures/even_net.yaml");
        let bare = |text: &str| mechanics(&read_design("x", text.as_bytes()).unwrap().design);
        let own = bare(text);
        for (from, to) in [
            ("resistance: 290 kN", "resistance: 200 kN"),
            ("resistance: 800 kN", "resistance: 300 kN"),
            ("revision: A", "revision: B"),
        ] {
            let changed = text.replace(from, to);
            assert!(changed != text && bare(&changed) == own, "{from}");
        }
        for (from, to) in [
            ("plateau_force: 150 kN", "plateau_force: 100 kN"),
            ("diameter: 28 mm", "diameter: 26 mm"),
            ("velocity: 4.6 m/s", "velocity: 4 m/s"),
        ] {
            let changed = text.replace(from, to);
            assert!(changed != text && bare(&changed) != own, "{from}");
        }
    }
}
