//! Depth, velocity and momentum flux of the flow in a stretch of the channel, and how far its front has come.

use serde::{Deserialize, Serialize};

use crate::recorders::across::Across;
use crate::tables::grains::Grain;

/// The flow in a window across the channel; zeros where there are no grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Gauge {
    /// Height below which 90 % of the grain centres lie, plus half a grain (m).
    pub thickness: f64,
    /// Mean velocity along the channel (m/s).
    pub velocity: f64,
    /// Depth that the mass in the window has at the flow's bulk density (m).
    pub depth: f64,
    /// Share of the mass in the window that is at rest.
    pub at_rest: f64,
    /// Σ m v² over the window's length, the bulk density and a width: h v² of an even flow, A v²/W in a section of another form (m³/s²).
    pub flux: f64,
}

/// A window across the channel, between two distances upstream of the barrier's foot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GaugeWindow {
    pub near: f64,
    pub far: f64,
    pub across: Across,
    /// kg/m³
    pub bulk_density: f64,
    /// Mean diameter of the grains (m).
    pub mean_diameter: f64,
}

/// Windows into which the stretch of the deposit is cut; neighbours overlap by half.
const DEPOSIT_WINDOWS: usize = 12;

impl GaugeWindow {
    /// Largest depth that the mass has at bulk density, over windows along the stretch, and the depth of the dead part in that
    /// same window: a leaning or bulging barrier takes part of each window's room, so the one with most mass is the one that tells.
    pub fn depths(&self, grains: &[Grain], dead: &[bool]) -> [f64; 2] {
        let cell = (self.far - self.near) / (DEPOSIT_WINDOWS + 1) as f64;
        let mut cells = [[0.0; 2]; DEPOSIT_WINDOWS + 1];
        for (grain, dead) in grains.iter().zip(dead) {
            let place = (-grain.position.x - self.near) / cell;
            if place >= 0.0 && (place as usize) < cells.len() {
                let [all, at_rest] = &mut cells[place as usize];
                *all += grain.body.mass;
                *at_rest += if *dead { grain.body.mass } else { 0.0 };
            }
        }
        let windows = cells.windows(2).map(|pair| [pair[0][0] + pair[1][0], pair[0][1] + pair[1][1]]);
        let most = windows.fold([0.0; 2], |most, window| if window[0] > most[0] { window } else { most });
        most.map(|mass| self.across.depth_of(mass, self.bulk_density, 2.0 * cell))
    }

    /// Height above which there is less mass than one row of grains across the channel has, and half a grain: the level of a flow, or of a
    /// jet one grain thick that runs up the barrier, without the few grains that fly above it, however long the window is (m); 0 without grains.
    pub fn level(&self, grains: &[Grain]) -> f64 {
        let stretch = -self.far..=-self.near;
        let inside = grains.iter().filter(|grain| stretch.contains(&grain.position.x));
        let mut heights: Vec<[f64; 2]> =
            inside.map(|grain| [self.across.over_the_bed(&grain.position), grain.body.mass]).collect();
        heights.sort_unstable_by(|a, b| b[0].total_cmp(&a[0]));
        let wanted = self.mean_diameter.powi(2) * self.across.width() * self.bulk_density;
        let mut above = 0.0;
        let reached = heights.iter().find(|[_, mass]| {
            above += mass;
            above >= wanted
        });
        reached.map_or(0.0, |[height, _]| height + 0.5 * self.mean_diameter)
    }

    /// `slow` tells which grains are at rest.
    pub fn read(&self, grains: &[Grain], slow: &[bool]) -> Gauge {
        let stretch = -self.far..=-self.near;
        let inside = grains.iter().zip(slow).filter(|(grain, _)| stretch.contains(&grain.position.x));
        let mut heights = Vec::new();
        let (mut velocity, mut mass, mut momentum_flux, mut at_rest) = (0.0, 0.0, 0.0, 0.0);
        for (grain, slow) in inside {
            heights.push(self.across.over_the_bed(&grain.position));
            at_rest += if *slow { grain.body.mass } else { 0.0 };
            velocity += grain.velocity.x;
            mass += grain.body.mass;
            momentum_flux += grain.body.mass * grain.velocity.x.powi(2);
        }
        if heights.is_empty() {
            return Gauge::default();
        }
        let count = heights.len();
        let rank = (count * 9 / 10).min(count - 1);
        let (_, ninety, _) = heights.select_nth_unstable_by(rank, f64::total_cmp);
        let depth = self.across.depth_of(mass, self.bulk_density, self.far - self.near);
        Gauge {
            thickness: *ninety + 0.5 * self.mean_diameter,
            velocity: velocity / count as f64,
            at_rest: at_rest / mass,
            depth,
            flux: momentum_flux / (self.bulk_density * self.across.width() * (self.far - self.near)),
        }
    }
}

/// Share of the mass in front of what is called the front.
const AHEAD: f64 = 0.02;

/// The place along the channel of which this share of the grains' mass is downstream (m).
pub fn front(grains: &[Grain]) -> f64 {
    let mut places: Vec<[f64; 2]> = grains.iter().map(|grain| [grain.position.x, grain.body.mass]).collect();
    places.sort_unstable_by(|a, b| b[0].total_cmp(&a[0]));
    let wanted = AHEAD * places.iter().map(|[_, mass]| mass).sum::<f64>();
    let mut ahead = 0.0;
    let reached = places.iter().find(|[_, mass]| {
        ahead += mass;
        ahead >= wanted
    });
    reached.map_or(0.0, |[place, _]| *place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;
    use crate::tables::grains::GrainBody;

    /// Grains of 0.1 m and 1 kg at heights, in a channel 1 m wide in which a row of them has 0.1² · 250 = 2.5 kg, whatever the window.
    #[test]
    fn a_few_grains_that_fly_are_none_of_the_level() {
        let window =
            GaugeWindow { near: 0.0, far: 3.0, across: Across::Even(1.0), bulk_density: 250.0, mean_diameter: 0.1 };
        let grain = |height: f64| {
            let body = GrainBody { mass: 1.0, ..GrainBody::sphere(0.05, 1000.0) };
            Grain::at(0, Vec3::new(-0.5, 0.5, height), Vec3::x(), body)
        };
        let level = |heights: &[f64]| window.level(&heights.iter().map(|height| grain(*height)).collect::<Vec<_>>());
        assert_eq!(level(&[]), 0.0);
        assert_eq!(level(&[0.05, 0.15, 0.25, 9.0, 8.0]), 0.3);
        // Three fly: that is no longer few.
        assert_eq!(level(&[0.05, 7.0, 9.0, 8.0]), 7.05);
        // Less than a row is nothing.
        assert_eq!(level(&[0.05, 0.05]), 0.0);
    }
}
