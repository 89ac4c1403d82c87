//! The energy account of a run: what came in, where it is, where it went.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::contact::law::Response;
use crate::tables::grains::Grain;

/// Sums over the contacts of one block in one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactSums {
    /// Elastic energy stored in contacts now (J).
    pub stored: f64,
    /// Lost in dashpots during this step (J).
    pub lost_damping: f64,
    /// Lost by slip during this step (J).
    pub lost_friction: f64,
    /// Largest overlap over the smaller radius.
    pub overlap_ratio: f64,
}

impl ContactSums {
    pub fn add(&mut self, other: &Self) {
        self.stored += other.stored;
        self.lost_damping += other.lost_damping;
        self.lost_friction += other.lost_friction;
        self.overlap_ratio = self.overlap_ratio.max(other.overlap_ratio);
    }

    /// Books one contact.
    #[inline(always)]
    pub fn count(&mut self, response: &Response, overlap_ratio: f64) {
        self.stored += response.stored;
        self.lost_damping += response.lost_damping;
        self.lost_friction += response.lost_friction;
        self.overlap_ratio = self.overlap_ratio.max(overlap_ratio);
    }
}

/// Energies of motion and place at one instant (J).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MotionEnergy {
    pub kinetic: f64,
    /// Its rotational part.
    pub rotational: f64,
    /// Gravity potential.
    pub potential: f64,
}

impl MotionEnergy {
    /// Adds a share of another.
    pub fn add(&mut self, other: &Self, share: f64) {
        self.kinetic += share * other.kinetic;
        self.rotational += share * other.rotational;
        self.potential += share * other.potential;
    }

    /// Energy of grains at the instant between their motion before and after, half a step from either, at the places that they had before.
    pub fn between<'a>(grains: impl Iterator<Item = (&'a Grain, &'a Grain)>, gravity: &Vec3) -> Self {
        let mut sums = Self::default();
        for (before, after) in grains {
            let rotational =
                0.25 * (before.spin().dot(&after.angular_momentum) + after.spin().dot(&before.angular_momentum));
            sums.kinetic += 0.5 * before.body.mass * before.velocity.dot(&after.velocity) + rotational;
            sums.rotational += rotational;
            sums.potential -= before.body.mass * gravity.dot(&before.position);
        }
        sums
    }
}

/// Energies of the whole model at one instant, and losses since the start (all J).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    pub kinetic: f64,
    /// Rotational part of `kinetic`.
    pub rotational: f64,
    /// Gravity potential, zero at the origin of the channel's frame.
    pub potential: f64,
    pub stored_contacts: f64,
    pub stored_barrier: f64,
    pub lost_damping: f64,
    pub lost_friction: f64,
    pub lost_ropes: f64,
    pub lost_dissipators: f64,
    /// Energy of grains that left the model.
    pub carried_out: f64,
    /// Energy of grains that came in since the start.
    pub carried_in: f64,
}

impl Ledger {
    /// Everything that must stay constant.
    pub fn total(&self) -> f64 {
        self.kinetic
            + self.potential
            + self.stored_contacts
            + self.stored_barrier
            + self.lost_damping
            + self.lost_friction
            + self.lost_ropes
            + self.lost_dissipators
            + self.carried_out
            - self.carried_in
    }

    /// Energy dissipated so far.
    pub fn dissipated(&self) -> f64 {
        self.lost_damping + self.lost_friction + self.lost_ropes + self.lost_dissipators
    }

    /// Imbalance against `start`, relative to the energy put in: the kinetic energy at the start plus the potential energy released
    /// since, with what grains that came in since have brought, less all that departed grains carry, their motion too, so that the share is
    /// rather too large. Dashpots that have gained count as energy from nowhere. Zero while nothing was put in.
    pub fn relative_error(&self, start: &Self) -> f64 {
        let released = start.potential - self.potential - self.carried_out + self.carried_in;
        let put_in = start.kinetic + released.max(0.0);
        let imbalance = self.total() - start.total() - self.lost_damping.min(0.0);
        match imbalance.is_nan() {
            true => f64::NAN,
            false if put_in > 0.0 => imbalance / put_in,
            false => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_from_dashpots_is_energy_from_nowhere() {
        let start = Ledger { kinetic: 100.0, ..Ledger::default() };
        let lost = Ledger { kinetic: 90.0, lost_damping: 10.0, ..Ledger::default() };
        let gained = Ledger { kinetic: 105.0, lost_damping: -5.0, ..Ledger::default() };
        assert_eq!(lost.relative_error(&start), 0.0);
        assert_eq!(gained.relative_error(&start), 0.05);
    }
}
