//! `result.json`: the contract that other programs script against. Fields may be added, never renamed.

use schemars::JsonSchema;
use serde::Serialize;

use crate::checks::outcome::Outcome;
use crate::fidelity::ladder::{RUNGS, Step};
use crate::guideline::Guideline;
use crate::pipeline::Run;
use crate::program::PROGRAM;
use crate::report::measured::Measured;
use crate::report::spreads::over_packings;
use crate::report::warnings;
use crate::simulated::Simulated;
use crate::stages::{SurgeResult, stages};
use crate::starts::Spread;

/// Version of this contract.
pub const SCHEMA_VERSION: u32 = 1;

#[derive(Debug, Serialize, JsonSchema)]
pub struct ResultFile {
    pub schema_version: u32,
    pub design: DesignPart,
    /// pass, fail or undecided
    pub verdict: String,
    /// Why the simulation cannot be relied on; only a failure by the equations stands beside one.
    pub doubts: Vec<String>,
    /// What a reviewer should know before the numbers.
    pub warnings: Vec<warnings::Told>,
    pub checks: Vec<CheckPart>,
    pub guideline: GuidelinePart,
    /// What the first start showed; absent where the equations alone were asked for.
    pub simulation: Option<SimulationPart>,
    pub numerics: Option<NumericsPart>,
    /// The rungs of the ladder that ran, where the design says `fidelity: auto`; the last is what is reported.
    pub rungs: Vec<RungPart>,
    /// The event surge by surge, where it comes in several and was simulated; means over the packings.
    pub surges: Vec<SurgePart>,
    /// Observables over all starts.
    pub starts: Vec<SpreadPart>,
    /// Version of the program.
    pub program_version: String,
    /// The program that made this file, with version and commit.
    pub program: String,
}

/// One surge of several. Forces without partial factors, along the bed.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SurgePart {
    pub volume_m3: f64,
    pub depth_m: f64,
    pub velocity_m_s: f64,
    /// Depth of the deposit at the barrier before the surge comes, and after.
    pub deposit_before_m: f64,
    pub deposit_after_m: f64,
    pub force_peak_n: f64,
    /// Standard deviation over the packings; 0 for a single one.
    pub force_peak_deviation_n: f64,
    /// By the guideline, over the same deposit.
    pub force_guideline_n: f64,
    /// lambda that the force means for the depth and velocity as given, where the deposit leaves room for the flow, and as measured at the
    /// barrier.
    pub lambda: Option<f64>,
    pub lambda_measured: Option<f64>,
    pub k_at_rest: Option<f64>,
    pub level_m: f64,
    /// Mass that went past the barrier, over that of the surge.
    pub lost_fraction: f64,
    pub rope_tension_peak_n: Option<f64>,
    pub net_tension_peak_n: Option<f64>,
    pub anchor_force_peak_n: Option<f64>,
    /// Longest stroke of a dissipator, in all since the first surge, and by this surge.
    pub brake_stroke_m: Option<f64>,
    pub brake_stroke_added_m: Option<f64>,
}

/// A rung of the ladder that ran.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RungPart {
    /// equations, coarse, grains, starts or fine
    pub name: String,
    pub wall_clock_s: f64,
    /// pass, fail or undecided
    pub verdict: String,
    /// Checks that a finer model may decide otherwise.
    pub open: Vec<String>,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct DesignPart {
    pub name: String,
    pub sha256: String,
}

/// Values in the SI unit named by `unit`; `-` for shares. With partial factors.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CheckPart {
    pub id: String,
    pub title: String,
    pub demand_guideline: Option<f64>,
    pub demand_simulation: Option<f64>,
    /// Of the simulation of the characteristic flow, where loads carry a partial factor.
    pub demand_characteristic: Option<f64>,
    pub capacity: Option<f64>,
    pub utilisation: Option<f64>,
    /// Under the larger load that the guideline has for the barrier, where the check was simulated under less.
    pub utilisation_scaled: Option<f64>,
    pub unit: String,
    /// pass, warn, fail, open or info
    pub verdict: String,
    /// Why the check is open, and what would close it; empty for any other verdict.
    pub open: String,
    pub source: String,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct GuidelinePart {
    pub k: f64,
    pub lambda: f64,
    pub froude: f64,
    pub depth_m: f64,
    pub velocity_m_s: f64,
    pub cases: Vec<CasePart>,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct CasePart {
    pub id: String,
    pub pressure_static_pa: f64,
    pub pressure_dynamic_pa: f64,
    pub force_n_per_m: f64,
}

/// Ropes and anchors in order from the bottom. Peaks of the total force and of the wall are of the signal
/// smoothed over `smoothing_s`; peaks of ropes and anchors are of means over `sampling_s`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SimulationPart {
    /// The program that simulated, with version and commit: another than `program` where the report was made again.
    pub program: String,
    pub fidelity: String,
    pub seed: u64,
    pub grains: usize,
    pub spheres: usize,
    pub barrier_nodes: usize,
    pub barrier_elements: usize,
    pub simulated_s: f64,
    /// Whether the run ended because its answer no longer changed.
    pub ended_steady: bool,
    pub smoothing_s: f64,
    pub sampling_s: f64,
    #[serde(flatten)]
    pub measured: Measured,
}

/// An observable over the starts, in the SI unit named by `unit`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SpreadPart {
    pub id: String,
    pub unit: String,
    pub starts: usize,
    pub mean: f64,
    /// Standard deviation; 0 for a single start.
    pub deviation: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
pub struct NumericsPart {
    pub steps: u64,
    pub time_step_s: f64,
    /// Largest found by the audits, an upper bound.
    pub time_step_over_critical: f64,
    pub time_step_cuts: u32,
    /// Steps of the barrier in one of the grains'.
    pub barrier_steps_per_step: u32,
    /// How often a grain has slipped through a rope; any makes the run undecided.
    pub rope_crossings: u32,
    pub grains_outside: u32,
    pub energy_error_relative: f64,
    pub overlap_max_relative: f64,
    /// Mass of the grains outside, over the whole.
    pub grains_outside_share: f64,
    /// Energy stored in contacts at the release of a surge, over its energy of motion.
    pub stored_at_release_relative: f64,
    /// Density of the packed flow over the one asked for.
    pub packed_density_relative: f64,
    pub neighbour_rebuilds: u64,
    pub threads: usize,
    pub wall_clock_s: f64,
    pub sphere_steps_per_s: f64,
}

impl ResultFile {
    pub fn of(run: &Run) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            design: DesignPart { name: run.file.name.clone(), sha256: run.file.sha256.clone() },
            verdict: run.verdict.word().to_string(),
            doubts: run.doubts.clone(),
            warnings: warnings::warnings(run),
            checks: run.outcomes.iter().map(check_part).collect(),
            guideline: guideline_part(&run.guideline),
            simulation: run.simulated.as_ref().map(simulation_part),
            numerics: run.simulated.as_ref().map(numerics_part),
            rungs: run.climb.iter().map(rung_part).collect(),
            surges: run
                .simulated
                .as_ref()
                .map_or_else(Vec::new, |seen| stages(&run.file.design, seen).iter().map(surge_part).collect()),
            starts: run.simulated.as_ref().map_or_else(Vec::new, spread_parts),
            program_version: env!("CARGO_PKG_VERSION").to_string(),
            program: PROGRAM.to_string(),
        }
    }
}

fn check_part(outcome: &Outcome) -> CheckPart {
    CheckPart {
        id: outcome.id.clone(),
        title: outcome.title.clone(),
        demand_guideline: outcome.demand.guideline,
        demand_simulation: outcome.demand.simulation,
        demand_characteristic: outcome.demand.characteristic,
        capacity: outcome.capacity,
        utilisation: outcome.utilisation,
        utilisation_scaled: outcome.scaled.map(|scaled| scaled.used),
        unit: outcome.unit.symbol().to_string(),
        verdict: outcome.verdict.word().to_string(),
        open: outcome.open.as_ref().map_or(String::new(), |open| open.words().to_string()),
        source: outcome.source.to_string(),
    }
}

fn guideline_part(guideline: &Guideline) -> GuidelinePart {
    let cases = guideline.cases.iter().map(|case| CasePart {
        id: case.id.to_string(),
        pressure_static_pa: case.pressure_static(),
        pressure_dynamic_pa: case.diagram.block,
        force_n_per_m: case.force_per_width(),
    });
    GuidelinePart {
        k: guideline.input.earth_pressure,
        lambda: guideline.input.dynamic_pressure,
        froude: guideline.input.froude(),
        depth_m: guideline.input.depth,
        velocity_m_s: guideline.input.velocity,
        cases: cases.collect(),
    }
}

fn simulation_part(run: &Simulated) -> SimulationPart {
    let facts = &run.facts;
    SimulationPart {
        program: run.facts.program.clone(),
        fidelity: run.fidelity.name.to_string(),
        seed: run.starts[0].seed,
        grains: facts.grains,
        spheres: facts.spheres,
        barrier_nodes: facts.barrier_nodes,
        barrier_elements: facts.barrier_elements,
        simulated_s: facts.simulated,
        ended_steady: facts.steady,
        smoothing_s: facts.smoothing,
        sampling_s: facts.sampling,
        measured: Measured::of(run.first()),
    }
}

fn surge_part(stage: &SurgeResult) -> SurgePart {
    let mean = |spread: Option<Spread>| spread.map(|spread| spread.mean);
    SurgePart {
        volume_m3: stage.volume,
        depth_m: stage.depth,
        velocity_m_s: stage.velocity,
        deposit_before_m: stage.before.mean,
        deposit_after_m: stage.after.mean,
        force_peak_n: stage.force.mean,
        force_peak_deviation_n: stage.force.deviation,
        force_guideline_n: stage.guideline,
        lambda: mean(stage.lambda),
        lambda_measured: mean(stage.lambda_measured),
        k_at_rest: mean(stage.k_at_rest),
        level_m: stage.level.mean,
        lost_fraction: stage.lost.mean,
        rope_tension_peak_n: mean(stage.rope),
        net_tension_peak_n: mean(stage.net),
        anchor_force_peak_n: mean(stage.anchor),
        brake_stroke_m: stage.stroke.map(|[all, _]| all.mean),
        brake_stroke_added_m: stage.stroke.map(|[_, own]| own.mean),
    }
}

fn rung_part(step: &Step) -> RungPart {
    RungPart {
        name: RUNGS[step.rung].name.to_string(),
        wall_clock_s: step.wall_clock,
        verdict: step.said.clone(),
        open: step.open.clone(),
    }
}

fn spread_parts(run: &Simulated) -> Vec<SpreadPart> {
    over_packings(run)
        .into_iter()
        .map(|(observable, spread)| SpreadPart {
            id: observable.id,
            unit: observable.unit.symbol().to_string(),
            starts: spread.starts,
            mean: spread.mean,
            deviation: spread.deviation,
        })
        .collect()
}

fn numerics_part(run: &Simulated) -> NumericsPart {
    let facts = &run.facts;
    NumericsPart {
        steps: facts.steps,
        time_step_s: facts.time_step,
        time_step_over_critical: facts.step_ratio.value,
        time_step_cuts: facts.step_cuts,
        barrier_steps_per_step: facts.barrier_substeps,
        rope_crossings: run.numerics.crossings,
        grains_outside: run.numerics.escaped,
        energy_error_relative: run.numerics.energy_error,
        overlap_max_relative: run.numerics.overlap,
        grains_outside_share: run.numerics.escaped_share,
        stored_at_release_relative: run.numerics.stored_at_release,
        packed_density_relative: 1.0 - run.numerics.packing_shortfall,
        neighbour_rebuilds: facts.renewals,
        threads: facts.threads,
        wall_clock_s: facts.wall_clock,
        sphere_steps_per_s: facts.steps as f64 * facts.spheres as f64 / facts.wall_clock.max(1e-9),
    }
}
