//! Watches a simulation and fills its histories.

use serde::{Deserialize, Serialize};

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use crate::Vec3;
use crate::elements::segment::SegmentKind;
use crate::net::NetForces;
use crate::recorders::bolts::share_between_bolts;
use crate::recorders::dead_zone::{push_at_rest, pushes_by_state};
use crate::recorders::deposit::beyond_the_first_gap;
use crate::recorders::gauge::{GaugeWindow, front};
use crate::recorders::histories::Histories;
use crate::recorders::passage::{Screen, WAYS, WallFace, Way};
use crate::recorders::snapshots::{Moment, Snapshot};
use crate::simulation::{Simulation, Unstable};
use crate::tables::barrier::Barrier;
use crate::tables::grains::Grain;

/// A grain is at rest below this share of the highest mean velocity (Albaba 2015, section 3.3.3).
const DEAD_SHARE: f64 = 0.05;

/// A force counts as a new largest, worth a snapshot, if it exceeds the last by this factor.
const NEW_LARGEST: f64 = 1.005;

/// Way on which the front is timed before it reaches the middle of the gauge, over the gauge's length.
const TRACK: f64 = 2.0;

/// Rounding of the sum of all masses.
const UNSEEN: f64 = 1e-9;

/// What and how often to record.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RecorderSetup {
    /// Sampling interval (s).
    pub interval: f64,
    /// Time between two looks at which grains have passed (s).
    pub passage_interval: f64,
    /// Knots of the net, row by row; empty for a rigid wall.
    pub net_rows: Vec<Vec<u32>>,
    /// The same with all that a grain must have passed to be lost.
    pub screen_rows: Vec<Vec<u32>>,
    /// Main ropes of the net; 0 for a rigid wall.
    pub ropes: usize,
    /// Row of knots along each main rope, and where its nodes are at first along the channel (m).
    pub rope_rows: Vec<usize>,
    pub rope_places: Vec<f64>,
    /// The rigid wall, if that is the barrier.
    pub wall: Option<WallFace>,
    /// Spaces between the bolts of the lowest main rope; 0 where it has none or their distance is not known.
    pub bolt_spaces: usize,
    /// Window in which the incoming flow is gauged, just upstream of the barrier.
    pub incoming: GaugeWindow,
    /// The same about a barrier's height upstream.
    pub approaching: GaugeWindow,
    /// Where the depth of the deposit at the barrier is sought.
    pub deposit: GaugeWindow,
    /// Mass of the whole flow (kg).
    pub mass: f64,
    /// Height of the side walls, normal to the bed (m).
    pub side_walls: f64,
    /// Length upstream of the barrier within which whatever lies has arrived (m).
    pub near: f64,
}

#[derive(Serialize, Deserialize)]
pub struct Recorder {
    setup: RecorderSetup,
    pub histories: Histories,
    sum: IntervalSum,
    highest_velocity: f64,
    passed: BTreeMap<u32, Way>,
    lost: [f64; WAYS],
    impact: bool,
    next_passage: f64,
    /// Grains that have left the channel through its bed or a side wall.
    pub escaped: BTreeSet<u32>,
    /// Their share of the mass.
    pub escaped_share: f64,
    /// Largest force of which a snapshot was taken (N).
    pictured_force: f64,
}

/// Sums over the steps of one sampling interval.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct IntervalSum {
    steps: u32,
    time: f64,
    force: Vec3,
    force_instant: f64,
    force_square: f64,
    moment: f64,
    segments: Vec<f64>,
    rope_mean: Vec<f64>,
    rope_largest: Vec<f64>,
    anchors: Vec<f64>,
    brakes: Vec<f64>,
    net_largest: f64,
    lateral_largest: f64,
    bed_force: Vec3,
    bolts: Vec<Vec3>,
}

impl Recorder {
    pub fn new(setup: RecorderSetup) -> Self {
        let GaugeWindow { near, far, .. } = setup.incoming;
        let middle = 0.5 * (near + far);
        let gauges = [middle + TRACK * (far - near), middle];
        Self {
            setup,
            histories: Histories { gauges, ..Histories::default() },
            sum: IntervalSum::default(),
            highest_velocity: 0.0,
            passed: BTreeMap::new(),
            lost: [0.0; WAYS],
            impact: false,
            next_passage: 0.0,
            escaped: BTreeSet::new(),
            escaped_share: 0.0,
            pictured_force: 0.0,
        }
    }

    /// Makes one step and takes it in. Returns whether a sample was completed.
    pub fn step(&mut self, simulation: &mut Simulation) -> Result<bool, Unstable> {
        // Half a step of slack: rounding must not move samples about.
        let complete = self.sum.time + 1.5 * simulation.time_step >= self.setup.interval;
        if !complete && self.histories.time.is_empty() && self.sum.steps == 0 {
            // The account of a step is of the instant at which it begins: of the release.
            simulation.step_and_account()?;
            self.histories.at_release = simulation.ledger;
            self.add_step(simulation);
            return Ok(false);
        }
        if !complete {
            simulation.step()?;
            self.add_step(simulation);
            return Ok(false);
        }
        simulation.step_and_account()?;
        self.add_step(simulation);
        self.sample(simulation);
        self.sum = IntervalSum::default();
        Ok(true)
    }

    fn add_step(&mut self, simulation: &Simulation) {
        let sum = &mut self.sum;
        sum.steps += 1;
        sum.time += simulation.time_step;
        let surfaces = &simulation.sums.surfaces;
        let force = simulation.sums.net.from_grains + surfaces.wall;
        sum.force += force;
        sum.force_instant = sum.force_instant.max(force.x);
        sum.force_square += force.x * force.x;
        sum.moment += surfaces.wall_moment;
        add_rows(&mut sum.segments, &surfaces.wall_segments);
        if let Some(barrier) = &simulation.model.barrier {
            let net = &simulation.sums.net;
            add_tensions(sum, barrier, net, self.setup.ropes);
            sum.bed_force += bed_force(barrier, &net.forces, &self.setup.net_rows);
            add_rows(&mut sum.anchors, &anchor_loads(barrier, &net.forces, self.setup.ropes));
            if self.setup.bolt_spaces > 0 {
                let loads = bolt_loads(barrier, &self.setup, &net.forces);
                let sums = &mut self.sum.bolts;
                sums.resize(loads.len(), Vec3::zeros());
                sums.iter_mut().zip(&loads).for_each(|(sum, load)| *sum += load);
            }
        }
    }

    fn sample(&mut self, simulation: &Simulation) {
        let mean = 1.0 / f64::from(self.sum.steps);
        let histories = &mut self.histories;
        histories.time.push(simulation.time);
        histories.force.push(self.sum.force * mean);
        histories.force_instant.push(self.sum.force_instant);
        let variance = self.sum.force_square * mean - (self.sum.force.x * mean).powi(2);
        histories.force_scatter.push(variance.max(0.0).sqrt());
        histories.moment.push(self.sum.moment * mean);
        push_rows(&mut histories.segments, &self.sum.segments, mean);
        push_rows(&mut histories.rope_mean, &self.sum.rope_mean, mean);
        push_rows(&mut histories.rope_largest, &self.sum.rope_largest, mean);
        push_rows(&mut histories.anchors, &self.sum.anchors, mean);
        if let Some(barrier) = &simulation.model.barrier {
            push_rows(&mut histories.brakes, &self.sum.brakes, mean);
            histories.net_largest.push(self.sum.net_largest * mean);
            histories.lateral_largest.push(self.sum.lateral_largest * mean);
            histories.bed_force.push(self.sum.bed_force.norm() * mean);
            if self.setup.bolt_spaces > 0 {
                let most = |of: fn(&Vec3) -> f64| self.sum.bolts.iter().map(of).fold(0.0, f64::max) * mean;
                histories.bolt_largest.push(most(|load| load.norm()));
                histories.bolt_lift.push(most(|load| load.z));
            }
            let [broken, drawn_out] = wear(barrier);
            histories.broken_pieces.push(broken);
            histories.drawn_out.push(drawn_out);
        }
        histories.ledger.push(simulation.ledger);
        self.impact |= self.sum.force.norm() > 0.0;
        if let Some(barrier) = &simulation.model.barrier {
            self.sample_shape(barrier);
        }
        let grains = simulation.snapshot();
        if simulation.time >= self.next_passage {
            self.look_for_passed(simulation, &grains);
            self.next_passage = simulation.time + self.setup.passage_interval;
        }
        self.look_for_strays(&grains);
        self.sample_grains(&grains);
        let limit = (DEAD_SHARE * self.highest_velocity).powi(2);
        let dead: Vec<bool> =
            grains.iter().map(|grain| self.impact && grain.velocity.norm_squared() <= limit).collect();
        if self.setup.wall.is_some_and(|wall| wall.lean == 0.0) {
            self.histories.push_at_rest.push(push_at_rest(simulation, &grains, &dead));
        }
        self.histories.pushes_by_state.push(pushes_by_state(simulation, &dead));
        let slow: Vec<bool> = grains.iter().map(|grain| grain.velocity.norm_squared() <= limit).collect();
        self.histories.incoming.push(self.setup.incoming.read(&grains, &slow));
        self.histories.approaching.push(self.setup.approaching.read(&grains, &slow));
        self.histories.front.push(front(&grains));
        let [all, at_rest] = self.setup.deposit.depths(&grains, &dead);
        self.histories.barrier_depth.push(all);
        self.histories.dead_depth.push(at_rest);
        self.picture(simulation, &grains);
        self.histories.film.take(simulation, &grains);
    }

    /// Takes a snapshot if the moment is one of those kept.
    fn picture(&mut self, simulation: &Simulation, grains: &[Grain]) {
        if !self.impact {
            return;
        }
        let force = self.histories.force.last().map_or(0.0, |force| force.norm());
        let half = self.histories.dead.last().is_some_and(|dead| *dead >= 0.5);
        if self.histories.snapshots.is_empty() {
            self.keep(Moment::FirstContact, simulation, grains);
        }
        if force > self.pictured_force * NEW_LARGEST {
            self.pictured_force = force;
            self.histories.snapshots.retain(|snapshot| snapshot.moment != Moment::LargestForce);
            self.keep(Moment::LargestForce, simulation, grains);
        }
        if half && !self.histories.snapshots.iter().any(|snapshot| snapshot.moment == Moment::HalfAtRest) {
            self.keep(Moment::HalfAtRest, simulation, grains);
        }
    }

    fn keep(&mut self, moment: Moment, simulation: &Simulation, grains: &[Grain]) {
        self.histories.snapshots.push(Snapshot::of(moment, simulation, grains));
    }

    /// Takes the last snapshot and puts all in the order of time.
    pub fn finish(&mut self, simulation: &Simulation) {
        let grains = simulation.snapshot();
        self.keep(Moment::End, simulation, &grains);
        self.histories.film.finish(simulation, &grains);
        self.histories.stopped_upstream = self.stopped_upstream(simulation, &grains);
        self.histories.snapshots.sort_by(|a, b| a.time.total_cmp(&b.time));
    }

    fn sample_shape(&mut self, barrier: &Barrier) {
        let mut strokes = vec![0.0_f64; self.setup.ropes];
        let mut sums = strokes.clone();
        for dissipator in &barrier.dissipators {
            let rope = dissipator.rope as usize;
            strokes[rope] = strokes[rope].max(dissipator.used);
            sums[rope] += dissipator.used;
        }
        push_rows(&mut self.histories.strokes, &strokes, 1.0);
        push_rows(&mut self.histories.strokes_mean, &sums, 0.5);
        let extension = |(&row, &place): (&usize, &f64)| {
            let nodes = self.setup.net_rows[row].iter().map(|&node| barrier.nodes[node as usize].position.x - place);
            nodes.fold(0.0, f64::max)
        };
        let extensions: Vec<f64> = self.setup.rope_rows.iter().zip(&self.setup.rope_places).map(extension).collect();
        push_rows(&mut self.histories.extension, &extensions, 1.0);
        let top = self.setup.net_rows.last().into_iter().flatten();
        let lowest = top.map(|&node| barrier.nodes[node as usize].position.z).fold(f64::INFINITY, f64::min);
        self.histories.top_rope_height.push(lowest);
    }

    fn look_for_passed(&mut self, simulation: &Simulation, grains: &[Grain]) {
        let screen = match (&simulation.model.barrier, self.setup.wall) {
            (Some(barrier), _) => Screen::of_net(barrier, &self.setup.screen_rows),
            (None, Some(wall)) => Screen::of_wall(&wall),
            (None, None) => return,
        };
        for grain in grains {
            if self.passed.contains_key(&grain.id) {
                continue;
            }
            if let Some(way) = screen.way_of(&grain.position, grain.body.radius + grain.body.offset) {
                // A grain first seen behind a wall, below its top, has come over it.
                let way = if self.setup.wall.is_some() && way == Way::Through { Way::Over } else { way };
                self.passed.insert(grain.id, way);
                self.lost[way as usize] += grain.body.mass / self.setup.mass;
            }
        }
    }

    /// Notes grains that are where none can get, wholly below the bed or wholly beyond a side wall that they have not gone over, and
    /// counts all that have left the channel as lost.
    fn look_for_strays(&mut self, grains: &[Grain]) {
        let width = self.setup.incoming.width;
        for grain in grains {
            let reach = grain.body.radius + grain.body.offset;
            let (y, z) = (grain.position.y, grain.position.z);
            let below = z < -reach;
            let beyond = y < -reach || y > width + reach;
            if !(below || beyond) {
                continue;
            }
            if let Entry::Vacant(entry) = self.passed.entry(grain.id) {
                entry.insert(Way::Beside);
                self.lost[Way::Beside as usize] += grain.body.mass / self.setup.mass;
            }
            if (below || z < self.setup.side_walls) && self.escaped.insert(grain.id) {
                self.escaped_share += grain.body.mass / self.setup.mass;
            }
        }
    }

    /// Share of the mass that lies upstream without leaning on the barrier, at rest or not.
    fn stopped_upstream(&self, simulation: &Simulation, grains: &[Grain]) -> f64 {
        let face = match &simulation.model.barrier {
            Some(barrier) => barrier.nodes.iter().map(|node| node.position.x).fold(0.0, f64::min),
            None => 0.0,
        };
        let here = grains.iter().filter(|grain| !self.passed.contains_key(&grain.id));
        let here = here.map(|grain| (face - grain.position.x, grain.body.mass));
        beyond_the_first_gap(here, &self.setup.incoming, self.setup.near) / self.setup.mass
    }

    fn sample_grains(&mut self, grains: &[Grain]) {
        let count = grains.len().max(1) as f64;
        let sum = grains.iter().fold(Vec3::zeros(), |sum, grain| sum + grain.velocity);
        self.histories.velocity.push([sum.x / count, sum.z / count]);
        self.highest_velocity = self.highest_velocity.max(sum.x / count);
        let limit = (DEAD_SHARE * self.highest_velocity).powi(2);
        let (mut dead, mut moving) = (0.0, 0.0);
        for grain in grains.iter().filter(|grain| !self.passed.contains_key(&grain.id)) {
            let at_rest = grain.velocity.norm_squared() <= limit;
            *(if at_rest { &mut dead } else { &mut moving }) += grain.body.mass / self.setup.mass;
        }
        // What is neither here nor known to have passed has left the model between two looks: it is lost all the same.
        let unseen = 1.0 - dead - moving - self.lost.iter().sum::<f64>();
        if unseen > UNSEEN {
            self.lost[Way::Over as usize] += unseen;
        }
        self.histories.dead.push(if self.impact { dead } else { 0.0 });
        self.histories.moving.push(moving);
        self.histories.lost.push(self.lost);
    }
}

fn add_rows(sums: &mut Vec<f64>, values: &[f64]) {
    sums.resize(values.len(), 0.0);
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}

fn push_rows(rows: &mut Vec<Vec<f64>>, values: &[f64], factor: f64) {
    rows.resize(values.len(), Vec::new());
    for (row, value) in rows.iter_mut().zip(values) {
        row.push(value * factor);
    }
}

fn add_tensions(sum: &mut IntervalSum, barrier: &Barrier, net: &NetForces, ropes: usize) {
    let (mut mean, mut largest) = (vec![[0.0, 0.0]; ropes], vec![0.0_f64; ropes]);
    let (mut net_largest, mut lateral_largest) = (0.0_f64, 0.0_f64);
    let segments = barrier.segments.iter().map(|segment| (segment.kind, segment.rest_length)).zip(&net.tensions);
    let cylinders = barrier.cylinders.iter().map(|cylinder| (cylinder.kind, cylinder.rest_length)).zip(&net.axial);
    for ((kind, rest_length), &tension) in segments.chain(cylinders) {
        match kind {
            SegmentKind::Main(rope) => {
                let [weighted, length] = &mut mean[rope as usize];
                *weighted += tension * rest_length;
                *length += rest_length;
                largest[rope as usize] = largest[rope as usize].max(tension);
            }
            SegmentKind::Net => net_largest = net_largest.max(tension),
            SegmentKind::Lateral => lateral_largest = lateral_largest.max(tension),
            SegmentKind::Ring => {}
        }
    }
    let mut brakes = vec![0.0_f64; ropes];
    for (dissipator, &tension) in barrier.dissipators.iter().zip(&net.brakes) {
        let rope = dissipator.rope as usize;
        brakes[rope] = brakes[rope].max(tension);
        largest[rope] = largest[rope].max(tension);
    }
    let mean: Vec<f64> = mean.iter().map(|[weighted, length]| weighted / length).collect();
    add_rows(&mut sum.rope_mean, &mean);
    add_rows(&mut sum.rope_largest, &largest);
    add_rows(&mut sum.brakes, &brakes);
    sum.net_largest += net_largest;
    sum.lateral_largest += lateral_largest;
}

/// How many pieces of rope have broken, and the largest permanent elongation of one over its first length.
fn wear(barrier: &Barrier) -> [f64; 2] {
    barrier.strengths().fold([0.0, 0.0], |[broken, drawn_out], strength| {
        let elongation = strength.drawn_out / strength.first_length;
        [broken + f64::from(u8::from(strength.broken)), f64::max(drawn_out, elongation)]
    })
}

/// Force on the fixed knots of the lowest row: what the bolts of a rope held by the bed must bear (N).
fn bed_force(barrier: &Barrier, forces: &[Vec3], rows: &[Vec<u32>]) -> Vec3 {
    let lowest = rows.first().into_iter().flatten().map(|&node| node as usize);
    lowest.filter(|&node| barrier.nodes[node].fixed).map(|node| forces[node]).sum()
}

/// Load of each rope's higher loaded anchor: the vector sum of all that is tied to it.
fn anchor_loads(barrier: &Barrier, forces: &[Vec3], ropes: usize) -> Vec<f64> {
    let mut loads = vec![0.0_f64; ropes];
    for anchor in &barrier.anchors {
        let load = &mut loads[anchor.rope as usize];
        *load = load.max(forces[anchor.node as usize].norm());
    }
    loads
}

/// Force on each bolt of the lowest rope (N).
fn bolt_loads(barrier: &Barrier, setup: &RecorderSetup, forces: &[Vec3]) -> Vec<Vec3> {
    let lowest = setup.net_rows.first().into_iter().flatten().map(|&node| node as usize);
    let held = lowest.filter(|&node| barrier.nodes[node].fixed);
    let knots = held.map(|node| (barrier.nodes[node].position.y, forces[node]));
    share_between_bolts(knots, setup.bolt_spaces, setup.incoming.width)
}
