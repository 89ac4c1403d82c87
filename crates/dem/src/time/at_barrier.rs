//! The grains of a block that touch the barrier, or could within a step of theirs.
//!
//! Where the barrier takes several steps in one of the grains', m of δ = Δt/m, these grains take them as well, so that the stiff contacts with
//! light pieces of rope are followed as finely as what holds the ropes together. The substeps of the step that takes t to t + Δt stand at
//! t − c to t + c with c = (Δt − δ)/2. In all of them neighbours, ground and gravity push with the same force, that of the place x(t) =
//! x(t−c) + c v, to which the grain goes on from the first substep at the velocity v that it has then: the extrapolation of the slow forces to the
//! middle (Barth & Schlick 1998). So a grain at rest between its neighbours and a rope is at rest in every substep, and one that no rope
//! touches moves as by the leapfrog. The table of all grains holds x(t).
//!
//! Neighbours and the ground feel the mean velocity of such a grain, v̄ = (x(t) − x(t−Δt))/Δt, as they do of any other, so that the way a contact
//! slips is the way the bodies have really gone; what it moves with at the end is kept beside.

use std::ops::Range;

use crate::Vec3;
use crate::contact::ropes::{OnBarrier, Push, RopeContacts, RopeContext};
use crate::ledger::{ContactSums, MotionEnergy};
use crate::neighbours::clocks::Clock;
use crate::simd::quad::Quad;
use crate::tables::barrier::Barrier;
use crate::tables::grain_rows::{GrainRows, Prefetcher};
use crate::tables::grain_table::{GrainLoad, GrainTable};
use crate::tables::grains::GrainShape;
use crate::tables::moving_rows::{Drifting, MovingRows};
use crate::time::integrate::{Pace, StepInterval, turn_axes};

/// What is known of the motion of each grain, besides its row.
#[derive(Clone, Copy)]
pub struct Moving<'a> {
    pub drift: &'a [Drifting],
    /// See [`GrainTable::ahead`].
    pub ahead: &'a [[Vec3; 2]],
}

/// Copies of the rows of these grains, which are moved on their own and put back at the end of the step.
#[derive(Clone, Debug)]
pub struct AtBarrier {
    /// Their rows, in rising order.
    rows: Vec<u32>,
    table: GrainTable,
    loads: Vec<GrainLoad>,
    /// What neighbours, ground and gravity do to each, the same in all substeps.
    steady: Vec<GrainLoad>,
    drift: Vec<Drifting>,
    /// The pairs of the list of the ropes, with the members numbered as in `table`.
    pairs: Vec<[u32; 2]>,
    /// Whether each may touch a rope in this step; the others did so in the last.
    pressed: Vec<bool>,
    /// Forces on the nodes in the substep at hand, and their means over the substeps for each pair.
    pub pushes: Vec<Push>,
    mean_pushes: Vec<Push>,
    /// Share of one substep in the step.
    share_of_step: f64,
    /// What the contacts store and lose in the substep at hand, and their largest overlap.
    pub sums: ContactSums,
    /// Where they were when the step began, and by how much they have turned since (rad).
    before: Vec<Quad>,
    turned: Vec<Vec3>,
    pace: Pace,
    /// Their energies of motion and place in the middle of the substeps, where the account is kept.
    pub motion: MotionEnergy,
}

impl Default for AtBarrier {
    fn default() -> Self {
        Self {
            rows: Vec::new(),
            table: GrainTable::of(GrainShape::Sphere, &[]),
            loads: Vec::new(),
            steady: Vec::new(),
            drift: Vec::new(),
            pairs: Vec::new(),
            pressed: Vec::new(),
            pushes: Vec::new(),
            mean_pushes: Vec::new(),
            share_of_step: 1.0,
            sums: ContactSums::default(),
            before: Vec::new(),
            turned: Vec::new(),
            pace: Pace::default(),
            motion: MotionEnergy::default(),
        }
    }
}

impl AtBarrier {
    /// Begins a step of the grains of a block: finds out which they are, and loads them for the first substep. The grains are still where they
    /// were.
    pub fn begin(
        &mut self,
        ropes: &mut RopeContacts,
        context: &RopeContext,
        moving: &Moving,
        block: &Range<usize>,
        substepping: &Substepping,
    ) -> ContactSums {
        ropes.wake(context, substepping.step, substepping.to_middle());
        let per_grain = context.grains.shape.members() as u32;
        self.rows.clear();
        self.rows.extend(ropes.list.touching.iter().map(|[member, _]| member / per_grain));
        // Whose last step had substeps moves otherwise than its row says.
        let ahead = block.clone().filter(|&row| moving.ahead[row] != [Vec3::zeros(); 2]);
        self.rows.extend(ahead.map(|row| row as u32));
        self.rows.sort_unstable();
        self.rows.dedup();
        self.copy(context.grains, moving, substepping);
        let rows = &self.rows;
        let number = |member: u32| {
            let place = rows.binary_search(&(member / per_grain)).unwrap_or_default();
            place as u32 * per_grain + member % per_grain
        };
        self.pairs.clear();
        self.pairs.extend(ropes.list.touching.iter().map(|&[member, line]| [number(member), line]));
        self.pressed.clear();
        self.pressed.resize(self.rows.len(), false);
        self.pairs.iter().for_each(|[member, _]| self.pressed[(member / per_grain) as usize] = true);
        self.pace = Pace::default();
        ropes.crossings = 0;
        let nothing = Push { row: 0, pair: 0, nodes: [0; 2], share: 0.0, force: Vec3::zeros() };
        self.mean_pushes.clear();
        self.mean_pushes.resize(self.pairs.len(), nothing);
        self.share_of_step = 1.0 / f64::from(substepping.substeps);
        self.press(ropes, context.barrier, &context.constants);
        // What is stored is told where the account is kept.
        ContactSums { stored: 0.0, ..self.sums }
    }

    fn copy(&mut self, grains: GrainRows, moving: &Moving, substepping: &Substepping) {
        let Self { rows, table, .. } = self;
        fn take<T>(to: &mut Vec<T>, rows: &[u32], from: impl Fn(usize) -> T) {
            to.clear();
            to.extend(rows.iter().map(|&row| from(row as usize)));
        }
        table.shape = grains.shape;
        take(&mut table.place, rows, |row| grains.place(row));
        take(&mut table.motion, rows, |row| grains.motion(row));
        take(&mut table.spin, rows, |row| grains.spin(row));
        if table.shape == GrainShape::Clump {
            take(&mut table.axis, rows, |row| grains.axis(row));
            take(&mut table.momentum, rows, |row| grains.momentum(row));
        }
        table.speed_up(rows, moving.ahead);
        self.before.clone_from(&table.place);
        self.go_on_freely(-substepping.to_middle());
        take(&mut self.drift, &self.rows, |row| moving.drift[row]);
        self.motion = MotionEnergy::default();
        self.turned.clear();
        self.turned.extend(self.table.spin.iter().map(|spin| spin.vector() * -substepping.to_middle()));
        self.loads.clear();
        self.loads.resize(self.rows.len(), GrainLoad::default());
    }

    /// Moves them for a while (s) as if nothing acted on them.
    fn go_on_freely(&mut self, time: f64) {
        let GrainTable { place, motion, spin, axis, .. } = &mut self.table;
        for (place, motion) in place.iter_mut().zip(&*motion) {
            place.set_vector(&(place.vector() + motion.vector() * time));
        }
        turn_axes(axis, spin, time);
    }

    /// Presses the grains on the ropes where both are now.
    pub fn press(&mut self, ropes: &mut RopeContacts, barrier: &Barrier, constants: &OnBarrier) {
        let Self { rows, table, loads, pairs, pushes, .. } = self;
        pushes.clear();
        let context = RopeContext { grains: table.rows(), barrier, constants: *constants, clock: Clock::default() };
        self.sums = ropes.press(pairs, &context, loads, 0, |row| rows[row], pushes);
        for push in pushes.iter() {
            let mean = &mut self.mean_pushes[push.pair as usize];
            *mean = Push { force: mean.force + push.force * self.share_of_step, ..*push };
        }
    }

    /// Takes what neighbours, ground and gravity do to them from how it has changed their motion in the table of all, where they have been
    /// moved through the whole step (s) as well: that is undone.
    pub fn hold(&mut self, grains: &GrainTable, step: f64) {
        let Self { rows, table, steady, .. } = self;
        table.bodies.clear();
        table.bodies.extend(rows.iter().map(|&row| grains.bodies[row as usize]));
        table.ids.clone_from(rows);
        steady.clear();
        for (place, &row) in rows.iter().enumerate() {
            let row = row as usize;
            let before = table.motion[place].vector() - grains.ahead[row][0];
            // Of the table: a grain that an inlet carries is heavier there than it is.
            let per_force = table.motion[place].fourth() * step;
            let force = (grains.motion[row].vector() - before) / per_force;
            let torque = match table.shape {
                GrainShape::Sphere => {
                    let before = table.spin[place].vector() - grains.ahead[row][1];
                    (grains.spin[row].vector() - before) / (table.spin[place].fourth() * step)
                }
                GrainShape::Clump => (grains.momentum[row].vector() - table.momentum[place].vector()) / step,
            };
            steady.push(GrainLoad { force: Quad::new(&force, 0.0), torque: Quad::new(&torque, 0.0) });
        }
    }

    /// Moves them through a substep of the step under the loads at hand; `weight` is that of the substep in the account, where it has some.
    pub fn go(&mut self, substep: &StepInterval, weight: Option<f64>) {
        let before = weight.map(|weight| (weight, self.table.grains()));
        if let Some(weight) = weight {
            self.account(&substep.gravity, weight);
        }
        self.loads.iter_mut().zip(&self.steady).for_each(|(load, steady)| load.join(steady));
        let nothing = GrainTable::of(self.table.shape, &[]);
        let GrainTable { place, motion, spin, axis, momentum, .. } = &mut self.table;
        let moving = MovingRows { place, motion, spin, axis, momentum, loads: &mut self.loads, drift: &self.drift };
        // They are in what is the same in all substeps.
        let substep = StepInterval { drag: 0.0, gravity: Vec3::zeros(), ..*substep };
        let pace = moving.advance(&substep, &mut Prefetcher::none(nothing.rows()));
        self.pace.stray = self.pace.stray.max(pace.stray);
        self.turned.iter_mut().zip(&self.table.spin).for_each(|(angle, spin)| *angle += spin.vector() * substep.step);
        if let Some((weight, before)) = before {
            self.motion.add(&MotionEnergy::between(before.iter().zip(&self.table.grains()), &Vec3::zeros()), weight);
        }
    }

    /// Their rows in the table of all, in rising order.
    pub fn rows(&self) -> &[u32] {
        &self.rows
    }

    /// Number of pairs of them and ropes that may touch.
    pub fn pairs(&self) -> usize {
        self.pairs.len()
    }

    /// Takes the grains into the account at a substep of the given weight. Their energies of place are where they stand for their neighbours,
    /// x(t). The forces F that are the same in all substeps have done their work for neighbours up to x(t), and for the grain up to where the substep
    /// has it, x: F·(x − x(t)) more, which is left out of its energy of motion.
    fn account(&mut self, gravity: &Vec3, weight: f64) {
        let Self { table, steady, before, turned, motion, .. } = self;
        for (place, load) in steady.iter().enumerate() {
            let [x, at] = [&table.place, &*before].map(|rows| rows[place].vector());
            let rotational = weight * load.torque.vector().dot(&turned[place]);
            motion.kinetic -= weight * load.force.vector().dot(&(x - at)) + rotational;
            motion.rotational -= rotational;
            motion.potential -= weight * table.bodies[place].mass * gravity.dot(&at);
        }
    }

    /// Puts the grains back after a step, and lets go of the pairs that no longer touch. Returns how fast they went.
    pub fn finish(&mut self, ropes: &mut RopeContacts, grains: &mut GrainTable, substepping: &Substepping) -> Pace {
        ropes.list.end_contacts();
        ropes.pushes.clear();
        ropes.pushes.extend(self.mean_pushes.iter().filter(|push| push.force != Vec3::zeros()));
        self.go_on_freely(substepping.to_middle());
        let Self { rows, table, .. } = self;
        for (place, &row) in rows.iter().enumerate() {
            let row = row as usize;
            let [velocity, spin] = [&table.motion, &table.spin].map(|rows| rows[place].vector());
            // What no rope has touched went at one velocity.
            let mean = match self.pressed[place] {
                true => {
                    let way = table.place[place].vector() - self.before[place].vector();
                    [way / substepping.step, (self.turned[place] + spin * substepping.to_middle()) / substepping.step]
                }
                false => [velocity, spin],
            };
            // The way from x(t) to x(t + Δt) may be longer than that in the substeps, which begin and end elsewhere.
            let [x, y, z, _] = self.drift[place].map(f64::from);
            let turning = match table.shape {
                GrainShape::Sphere => 0.0,
                GrainShape::Clump => mean[1].norm() * table.spin[place].fourth(),
            };
            self.pace.stray = self.pace.stray.max((mean[0] - Vec3::new(x, y, z)).norm() + turning);
            grains.ahead[row] = [velocity - mean[0], spin - mean[1]];
            grains.place[row] = table.place[place];
            grains.motion[row].set_vector(&mean[0]);
            grains.spin[row].set_vector(&mean[1]);
            if table.shape == GrainShape::Clump {
                grains.axis[row] = table.axis[place];
                grains.momentum[row] = table.momentum[place];
            }
        }
        self.pace
    }
}

/// How a step of the grains is divided for the barrier.
#[derive(Clone, Copy, Debug)]
pub struct Substepping {
    /// The whole step (s).
    pub step: f64,
    pub substeps: u32,
}

impl Substepping {
    /// From the first substep to the middle of all, c = (Δt − Δt/m)/2 (s).
    fn to_middle(self) -> f64 {
        0.5 * (self.step - self.step / f64::from(self.substeps))
    }
}
