//! Watches a simulation and fills its histories.

use serde::{Deserialize, Serialize};

use std::borrow::Cow;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use crate::Vec3;
use crate::recorders::body::BodyRecorder;
use crate::recorders::dead_zone::{push_at_rest, pushes_by_state};
use crate::recorders::deposit::first_gap;
use crate::recorders::gauge::{Gauge, GaugeWindow, front};
use crate::recorders::histories::Histories;
use crate::recorders::of_anchors::OfAnchors;
use crate::recorders::of_boulders::OfBoulders;
use crate::recorders::of_dissipators::OfDissipators;
use crate::recorders::of_level::OfLevel;
use crate::recorders::of_posts::OfPosts;
use crate::recorders::of_ropes::OfRopes;
use crate::recorders::of_wall::OfWall;
use crate::recorders::passage::{Screen, WAYS, Way};
use crate::recorders::setup::RecorderSetup;
use crate::recorders::snapshots::{Moment, Snapshot};
use crate::simulation::{Simulation, Unstable};
use crate::tables::grains::Grain;

/// A grain is at rest below this share of the highest mean velocity (Albaba 2015, section 3.3.3).
const DEAD_SHARE: f64 = 0.05;

/// A force counts as a new largest, worth a snapshot, if it exceeds the last by this factor.
const NEW_LARGEST: f64 = 1.005;

/// Way on which the front is timed before it reaches the middle of the gauge, over the gauge's length.
const TRACK: f64 = 2.0;

/// Rounding of the sum of all masses.
const UNSEEN: f64 = 1e-9;

#[derive(Serialize, Deserialize)]
pub struct Recorder {
    setup: RecorderSetup,
    pub histories: Histories,
    sum: IntervalSum,
    bodies: Bodies,
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
    /// Number of the first grain of the surge that is under way; velocity, front and gauges are of its grains.
    under_way: u32,
    /// The same of the surges before it.
    before: Vec<u32>,
    /// Where a later surge is gauged as it comes to what lies there.
    on_deposit: Option<GaugeWindow>,
    /// Share of the mass that has not been let go yet, and of the surge under way.
    waiting: f64,
    pub share_under_way: f64,
}

/// Sums over the steps of one sampling interval.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct IntervalSum {
    steps: u32,
    time: f64,
    force: Vec3,
    force_instant: f64,
    force_square: f64,
}

/// The recorders of all kinds of parts.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Bodies {
    level: OfLevel,
    wall: OfWall,
    ropes: OfRopes,
    dissipators: OfDissipators,
    anchors: OfAnchors,
    boulders: OfBoulders,
    posts: OfPosts,
}

impl Bodies {
    fn each(&mut self) -> [&mut dyn BodyRecorder; 7] {
        [
            &mut self.level,
            &mut self.wall,
            &mut self.ropes,
            &mut self.dissipators,
            &mut self.anchors,
            &mut self.boulders,
            &mut self.posts,
        ]
    }
}

impl Recorder {
    pub fn new(setup: RecorderSetup) -> Self {
        let GaugeWindow { near, far, .. } = setup.incoming;
        let middle = 0.5 * (near + far);
        let gauges = [middle + TRACK * (far - near), middle];
        let first = setup.at_first / setup.mass;
        Self {
            under_way: 0,
            before: Vec::new(),
            on_deposit: None,
            waiting: 1.0 - first + setup.to_come / setup.mass,
            share_under_way: first,
            setup,
            histories: Histories { gauges, shares: vec![first], ..Histories::default() },
            sum: IntervalSum::default(),
            bodies: Bodies::default(),
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

    /// Takes note of a surge that is let go: its first grain, its mass (kg), and where the last grain lies that is there (m).
    pub fn next_surge(&mut self, first: u32, mass: f64, last: f64) {
        self.histories.surges.push(self.histories.time.len());
        // As long as the one before the barrier, and as far before what lies there, which dams the surge up as soon as it comes to it.
        let GaugeWindow { near, far, .. } = self.setup.incoming;
        let (near, far) = (far - near - last, 2.0 * (far - near) - last);
        self.on_deposit = Some(GaugeWindow { near, far, ..self.setup.incoming.clone() });
        self.histories.shares.push(mass / self.setup.mass);
        self.before.push(self.under_way);
        self.under_way = first;
        self.share_under_way = mass / self.setup.mass;
        self.waiting = (self.waiting - self.share_under_way).max(0.0);
    }

    /// Takes note of a mass (kg) that has come in of the surge under way.
    pub fn let_in(&mut self, mass: f64) {
        self.waiting = (self.waiting - mass / self.setup.mass).max(0.0);
    }

    /// Samples since the surge under way was let go.
    pub fn samples_under_way(&self) -> usize {
        self.histories.time.len() - self.histories.surges.last().copied().unwrap_or(0)
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
        self.bodies.each().into_iter().for_each(|body| body.add_step(simulation, &self.setup));
    }

    fn sample(&mut self, simulation: &Simulation) {
        let mean = 1.0 / f64::from(self.sum.steps);
        let histories = &mut self.histories;
        histories.time.push(simulation.time);
        histories.force.push(self.sum.force * mean);
        histories.force_instant.push(self.sum.force_instant);
        let variance = self.sum.force_square * mean - (self.sum.force.x * mean).powi(2);
        histories.force_scatter.push(variance.max(0.0).sqrt());
        let bodies = self.bodies.each().into_iter();
        bodies.for_each(|body| body.sample(simulation, &self.setup, self.sum.steps, &mut histories.barrier));
        histories.ledger.push(simulation.ledger);
        if let Some(inlet) = &simulation.model.inlet {
            histories.entered.push(inlet.passed);
        }
        self.impact |= self.sum.force.norm() > 0.0;
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
        let coming: Cow<[Grain]> = match self.under_way {
            0 => Cow::Borrowed(&grains),
            first => grains.iter().filter(|grain| grain.id >= first).cloned().collect(),
        };
        let slow: Vec<bool> = coming.iter().map(|grain| grain.velocity.norm_squared() <= limit).collect();
        self.histories.incoming.push(self.setup.incoming.read(&coming, &slow));
        self.histories.approaching.push(self.setup.approaching.read(&coming, &slow));
        let on_deposit = self.on_deposit.as_ref().map_or(Gauge::default(), |window| window.read(&coming, &slow));
        self.histories.on_deposit.push(on_deposit);
        self.histories.front.push(front(&coming));
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
        self.note_what_stopped_upstream(simulation, &grains);
        self.histories.snapshots.sort_by(|a, b| a.time.total_cmp(&b.time));
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
        for grain in grains {
            let reach = grain.body.radius + grain.body.offset;
            let (y, z) = (grain.position.y, grain.position.z);
            let across = &self.setup.incoming.across;
            let (clear, cosine) = across.clearance(&grain.position);
            let below = clear < -reach / cosine;
            let beyond = y < -reach || y > across.breadth() + reach;
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

    /// Notes the share of the mass, and of each surge's, that lies upstream without leaning on the barrier, at rest or not.
    fn note_what_stopped_upstream(&mut self, simulation: &Simulation, grains: &[Grain]) {
        let face = match &simulation.model.barrier {
            Some(barrier) => -barrier.face(),
            None => 0.0,
        };
        let here: Vec<&Grain> = grains.iter().filter(|grain| !self.passed.contains_key(&grain.id)).collect();
        let upstream = |grain: &Grain| face - grain.position.x;
        let places = here.iter().map(|grain| (upstream(grain), grain.body.mass));
        let gap = first_gap(places, &self.setup.incoming, self.setup.near);
        let stopped = |of: std::ops::Range<u32>| {
            let beyond = here.iter().filter(|grain| of.contains(&grain.id) && upstream(grain) >= gap);
            beyond.fold(0.0, |sum, grain| sum + grain.body.mass) / self.setup.mass
        };
        self.histories.stopped_upstream = stopped(0..u32::MAX);
        let starts: Vec<u32> = self.before.iter().copied().chain([self.under_way, u32::MAX]).collect();
        let of_each = starts.windows(2).zip(&self.histories.shares);
        self.histories.stopped_of = of_each.map(|(pair, share)| stopped(pair[0]..pair[1]) / share).collect();
    }

    fn sample_grains(&mut self, grains: &[Grain]) {
        let coming = grains.iter().filter(|grain| grain.id >= self.under_way);
        let (sum, count) = coming.fold((Vec3::zeros(), 0.0), |(sum, count), grain| (sum + grain.velocity, count + 1.0));
        let count = f64::max(count, 1.0);
        self.histories.velocity.push([sum.x / count, sum.z / count]);
        self.highest_velocity = self.highest_velocity.max(sum.x / count);
        let limit = (DEAD_SHARE * self.highest_velocity).powi(2);
        let (mut dead, mut moving) = (0.0, 0.0);
        for grain in grains.iter().filter(|grain| !self.passed.contains_key(&grain.id)) {
            let at_rest = grain.velocity.norm_squared() <= limit;
            *(if at_rest { &mut dead } else { &mut moving }) += grain.body.mass / self.setup.mass;
        }
        // What is neither here nor known to have passed has left the model between two looks: it is lost all the same.
        let unseen = 1.0 - self.waiting - dead - moving - self.lost.iter().sum::<f64>();
        if unseen > UNSEEN {
            self.lost[Way::Over as usize] += unseen;
        }
        self.histories.dead.push(if self.impact { dead } else { 0.0 });
        self.histories.moving.push(moving);
        self.histories.lost.push(self.lost);
    }
}
