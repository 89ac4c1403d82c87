//! What the simulation showed, as numbers.

use serde::{Deserialize, Serialize};

use crate::demand::coefficients::{Coefficients, STANDING, coefficients};
use crate::demand::from_loads::{Guideline, wall_of};
use crate::design::{BarrierDesign, Design};
use dem::recorders::histories::{Gauge, Histories, peak, smoothed, tail_mean};

/// Numbers read off the histories of one run, SI.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Observed {
    /// Largest total force of the smoothed signal (N) and its time (s).
    pub force_peak: f64,
    pub force_peak_time: f64,
    /// Largest force along the bed of the smoothed signal (N).
    pub push_peak: f64,
    /// Largest total force within one sampling interval (N).
    pub force_peak_sampled: f64,
    /// The smoothed signal, sample by sample (N).
    pub force: Vec<f64>,
    /// Mean total force over the last stretch of the run (N).
    pub force_residual: f64,
    /// Highest mean velocity of all grains along the channel (m/s), and its time (s).
    pub velocity_peak: f64,
    pub velocity_peak_time: f64,
    /// Of the mass that has come to the barrier, the share that it holds.
    pub retained: f64,
    /// Share of the mass that came to rest upstream, without leaning on the barrier.
    pub stopped_upstream: f64,
    /// Shares that went through, under, beside, over.
    pub lost: [f64; 4],
    /// Lowest height of the top rope at the end over its initial height; 1 for a wall.
    pub residual_height: f64,
    /// Largest tension anywhere along each main rope, its dissipators included (N).
    pub rope_tension_peak: Vec<f64>,
    /// Largest mean tension along each main rope, and its mean at the end (N).
    pub rope_mean_peak: Vec<f64>,
    pub rope_mean_residual: Vec<f64>,
    /// How far downstream each main rope bulged at the most (m).
    pub extension: Vec<f64>,
    /// Largest load of each rope's higher loaded anchor (N).
    pub anchor_force_peak: Vec<f64>,
    /// Larger stroke used by each rope's two dissipators (m).
    pub brake_stroke: Vec<f64>,
    /// Mean stroke used by each rope's two dissipators (m).
    pub brake_stroke_mean: Vec<f64>,
    /// Largest tension of each rope's dissipators (N).
    pub brake_force_peak: Vec<f64>,
    /// Largest tension of the lateral ropes (N).
    pub lateral_tension_peak: f64,
    /// Largest force on what holds the lowest rope to the bed (N).
    pub bed_force_peak: f64,
    /// Largest force on one of its bolts, and the largest lift of one (N); 0 where their distance is not known.
    pub bolt_force_peak: f64,
    pub bolt_lift_peak: f64,
    pub net_tension_peak: f64,
    /// Largest tension of the net at the end (N).
    pub net_tension_residual: f64,
    /// Pieces of rope that broke, and when the first did (s).
    pub broken_pieces: f64,
    pub first_break: Option<f64>,
    /// Largest permanent elongation of a piece of rope, over its first length.
    pub drawn_out: f64,
    /// Per metre of width (N/m), from the bottom.
    pub segment_peak: Vec<f64>,
    pub segment_residual: Vec<f64>,
    /// Largest moment about the toe (N m/m).
    pub moment_peak: f64,
    /// The same within one sampling interval.
    pub moment_peak_sampled: f64,
    /// Of a wall that stands by its weight: largest force that slides it along its base, with what the lift takes of its friction (N/m),
    /// and largest moment about the upstream end of its base, with that of the lift (N m/m).
    pub wall_sliding_peak: f64,
    pub wall_overturning_peak: f64,
    /// What presses on its base beside its weight, at the most (N/m).
    pub wall_press_peak: f64,
    /// The flow just upstream of the barrier when its momentum flux was largest, before grains came to rest there.
    pub incoming: Gauge,
    /// Speed of the front on the last stretch before the gauge just upstream of the barrier (m/s); absent where it was not seen there.
    pub front_velocity: Option<f64>,
    /// The flow a barrier's height upstream when the total force peaked: thickness and velocity as the laboratory measured them.
    pub incoming_at_peak: Gauge,
    /// Depth of the deposit at the barrier at the end, at bulk density (m).
    pub deposit_depth: f64,
    /// K and λ over time by the split into grains at rest and moving ones.
    pub coefficients: Coefficients,
    /// K that the residual force means, where there is a deposit.
    pub k_effective: Option<f64>,
    /// λ that the peak force means, where a flow was gauged.
    pub lambda_effective: Option<f64>,
}

/// How the histories were sampled and are to be read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Samples in the smoothing window.
    pub window: usize,
    /// Samples at the end over which residuals are averaged.
    pub tail: usize,
}

impl Observed {
    /// Nothing seen yet of a net on so many main ropes.
    #[cfg(test)]
    pub fn of_ropes(ropes: usize) -> Self {
        let none = || vec![0.0; ropes];
        Self {
            anchor_force_peak: none(),
            rope_tension_peak: none(),
            brake_stroke: none(),
            brake_force_peak: none(),
            retained: 1.0,
            residual_height: 1.0,
            ..Self::default()
        }
    }

    /// Whether there is a number for each main rope of the design, and for each segment of its wall: what was read from a file may have
    /// been forged.
    pub fn fits(&self, design: &Design) -> bool {
        let (ropes, segments) = match &design.barrier {
            BarrierDesign::FlexibleNet(net) => (net.main_ropes.heights.len(), 0),
            BarrierDesign::RigidWall(wall) => (0, wall.segment_tops.len()),
        };
        let by_rope = [
            &self.rope_tension_peak,
            &self.rope_mean_peak,
            &self.rope_mean_residual,
            &self.extension,
            &self.anchor_force_peak,
            &self.brake_stroke,
            &self.brake_stroke_mean,
            &self.brake_force_peak,
        ];
        by_rope.iter().all(|row| row.len() == ropes)
            && [&self.segment_peak, &self.segment_residual].iter().all(|row| row.len() == segments)
            && self.coefficients.is_whole()
    }

    pub fn read(histories: &Histories, design: &Design, guideline: &Guideline, reading: Reading) -> Self {
        let force: Vec<f64> = histories.force.iter().map(|force| force.norm()).collect();
        let smooth = smoothed(&force, reading.window);
        let (at_peak, force_peak) = peak(&smooth);
        let velocity: Vec<f64> = histories.velocity.iter().map(|velocity| velocity[0]).collect();
        let (at_fastest, velocity_peak) = peak(&velocity);
        let lost = histories.lost.last().copied().unwrap_or_default();
        let all_lost = lost.iter().sum::<f64>();
        let held = 1.0 - all_lost - histories.stopped_upstream;
        let time = |index: usize| histories.time.get(index).copied().unwrap_or(0.0);
        let raw_peaks = |rows: &[Vec<f64>]| rows.iter().map(|row| peak(row).1).collect::<Vec<_>>();
        let width = design.channel.width;
        let mut observed = Self {
            force_peak,
            force_peak_sampled: peak(&force).1,
            force: smooth,
            force_peak_time: time(at_peak),
            force_residual: tail_mean(&force, reading.tail),
            velocity_peak,
            velocity_peak_time: time(at_fastest),
            retained: held / (held + all_lost),
            stopped_upstream: histories.stopped_upstream,
            lost,
            residual_height: residual_height(histories),
            rope_tension_peak: raw_peaks(&histories.rope_largest),
            rope_mean_peak: raw_peaks(&histories.rope_mean),
            rope_mean_residual: histories.rope_mean.iter().map(|row| tail_mean(row, reading.tail)).collect(),
            extension: raw_peaks(&histories.extension),
            anchor_force_peak: raw_peaks(&histories.anchors),
            brake_stroke: raw_peaks(&histories.strokes),
            brake_stroke_mean: raw_peaks(&histories.strokes_mean),
            brake_force_peak: raw_peaks(&histories.brakes),
            lateral_tension_peak: peak(&histories.lateral_largest).1,
            bed_force_peak: peak(&histories.bed_force).1,
            bolt_force_peak: peak(&histories.bolt_largest).1,
            bolt_lift_peak: peak(&histories.bolt_lift).1,
            net_tension_peak: peak(&histories.net_largest).1,
            net_tension_residual: tail_mean(&histories.net_largest, reading.tail),
            broken_pieces: peak(&histories.broken_pieces).1,
            first_break: histories.broken_pieces.iter().position(|count| *count > 0.0).map(time),
            drawn_out: peak(&histories.drawn_out).1,
            segment_peak: histories.segments.iter().map(|row| peak(&smoothed(row, reading.window)).1 / width).collect(),
            segment_residual: histories.segments.iter().map(|row| tail_mean(row, reading.tail) / width).collect(),
            moment_peak: peak(&smoothed(&histories.moment, reading.window)).1 / width,
            moment_peak_sampled: peak(&histories.moment).1 / width,
            incoming_at_peak: histories.approaching.get(at_peak).copied().unwrap_or_default(),
            deposit_depth: histories.barrier_depth.last().copied().unwrap_or(0.0),
            front_velocity: front_velocity(histories),
            ..Self::default()
        };
        observed.measure_wall(histories, design, reading);
        observed.measure_coefficients(histories, design, guideline, reading);
        let grain = design.flow.sizes.quantile(0.5);
        observed.coefficients = coefficients(histories, &guideline.input, width, reading.window, grain);
        observed
    }

    /// What slides and what tips a wall that stands by its weight.
    fn measure_wall(&mut self, histories: &Histories, design: &Design, reading: Reading) {
        let Some(wall) = wall_of(design) else { return };
        let width = design.channel.width;
        let part = |axis: usize| -> Vec<f64> { histories.force.iter().map(|force| force[axis] / width).collect() };
        let [along, off] = [part(0), part(2)].map(|part| smoothed(&part, reading.window));
        let moment: Vec<f64> = histories.moment.iter().map(|moment| moment / width).collect();
        let moment = smoothed(&moment, reading.window);
        let pushes = || along.iter().zip(&off);
        let slides: Vec<f64> = pushes().map(|(along, off)| wall.sliding_demand(*along, *off)).collect();
        let tips =
            pushes().zip(&moment).map(|((along, off), moment)| moment + wall.lift(*along, *off) * wall.base_width);
        self.wall_press_peak = peak(&pushes().map(|(along, off)| wall.press(*along, *off)).collect::<Vec<_>>()).1;
        self.wall_sliding_peak = peak(&slides).1;
        self.wall_overturning_peak = peak(&tips.collect::<Vec<_>>()).1;
    }

    /// K from the force along the channel at rest, λ from its peak with the design's K for the static part. Neither is told
    /// where the deposit or the flow is thinner than two grains: it has no depth then.
    fn measure_coefficients(
        &mut self,
        histories: &Histories,
        design: &Design,
        guideline: &Guideline,
        reading: Reading,
    ) {
        let along: Vec<f64> = histories.force.iter().map(|force| force.x).collect();
        let (at_peak, peak_along) = peak(&smoothed(&along, reading.window));
        let unit = guideline.input.density * guideline.input.gravity_normal;
        let width = design.channel.width;
        let thin = 2.0 * design.flow.sizes.quantile(0.5);
        self.push_peak = peak_along;
        if self.deposit_depth > thin {
            let at_rest = tail_mean(&along, reading.tail);
            // What stands above the barrier's top presses on what is below it.
            let (depth, top) = (self.deposit_depth, self.deposit_depth.min(guideline.input.barrier_height));
            self.k_effective = Some(2.0 * at_rest / width / (unit * top * (2.0 * depth - top)));
        }
        // Grains at rest in the window are deposit, no flow that comes.
        let flux = |gauge: &Gauge| if gauge.at_rest > STANDING { 0.0 } else { gauge.flux };
        let flux: Vec<f64> = histories.incoming.iter().map(flux).collect();
        let (at_largest, largest_flux) = peak(&smoothed(&flux[..flux.len().min(at_peak + 1)], reading.window));
        self.incoming = histories.incoming.get(at_largest).copied().unwrap_or_default();
        if self.incoming.depth > 0.5 * thin && self.incoming.at_rest <= STANDING && largest_flux > 0.0 {
            let standing = histories.barrier_depth.get(at_peak).copied().unwrap_or(0.0);
            let fixed = 0.5 * guideline.input.earth_pressure * unit * standing.powi(2);
            self.lambda_effective = Some((peak_along / width - fixed) / (guideline.input.density * largest_flux));
        }
    }
}

/// Way of the front between the two places over its time; from where it started, if that is nearer than the far one.
fn front_velocity(histories: &Histories) -> Option<f64> {
    let [far, near] = histories.gauges;
    let reached = |place: f64| {
        let sample = histories.front.iter().position(|front| *front >= -place)?;
        Some((*histories.time.get(sample)?, histories.front[sample]))
    };
    let ((from, start), (to, end)) = (reached(far)?, reached(near)?);
    (to > from).then(|| (end - start) / (to - from))
}

fn residual_height(histories: &Histories) -> f64 {
    match (histories.top_rope_height.first(), histories.top_rope_height.last()) {
        (Some(first), Some(last)) if *first > 0.0 => last / first,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Stability;
    use crate::design::read::read_design;
    use approx::assert_relative_eq;

    /// By hand, per metre: on a level base below a bed of 40° a force of 30 kN along the bed and 100 kN off it slides the wall with its
    /// level part, 30 cos 40° + 100 sin 40° = 87.26 kN, and with what its lift, 100 cos 40° − 30 sin 40° = 57.32 kN, takes from friction;
    /// the lift tips it about the edge of a base of 2 m beside the moment of 50 kN m.
    #[test]
    fn a_measured_push_slides_and_tips_a_wall_with_its_lift() {
        let mut design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let crate::design::BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        wall.stability = Some(Stability {
            thickness: 2.0,
            density: 2400.0,
            base_width: 2.0,
            base_slope: Some(0.0),
            base_friction: 0.5,
            sliding_factor: 1.1,
            overturning_factor: 1.5,
            bearing_resistance: None,
            bearing_factor: 1.4,
            water_head: Some(0.0),
        });
        let width = design.channel.width;
        let samples = 5;
        let histories = Histories {
            force: vec![dem::Vec3::new(30e3, 0.0, 100e3) * width; samples],
            moment: vec![50e3 * width; samples],
            ..Histories::default()
        };
        let mut observed = Observed::default();
        observed.measure_wall(&histories, &design, Reading { window: 1, tail: 1 });
        assert_relative_eq!(observed.wall_sliding_peak, 87.26e3 + 0.5 * 57.32e3, max_relative = 1e-3);
        assert_relative_eq!(observed.wall_overturning_peak, 50e3 + 2.0 * 57.32e3, max_relative = 1e-3);
    }

    /// Each number of a net is read off its own history: its largest value, or its last, by rope.
    #[test]
    fn every_number_is_read_off_its_history() {
        let design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let guideline = crate::demand::from_loads::guideline(&design);
        let ropes = |rows: [f64; 3]| rows.map(|row| vec![0.5 * row, row, 0.25 * row]).to_vec();
        let single = |peak: f64| vec![0.2 * peak, peak, 0.5 * peak];
        let gauge = Gauge { velocity: 4.0, depth: 0.9, flux: 14.0, ..Gauge::default() };
        let histories = Histories {
            time: vec![1.0, 2.0, 3.0],
            force: [30.0, 90.0, 60.0].map(|x| dem::Vec3::new(x, 0.0, 0.0)).to_vec(),
            rope_mean: ropes([1.0, 2.0, 3.0]),
            rope_largest: ropes([4.0, 5.0, 6.0]),
            anchors: ropes([7.0, 8.0, 9.0]),
            extension: ropes([10.0, 11.0, 12.0]),
            strokes: ropes([13.0, 14.0, 15.0]),
            strokes_mean: ropes([16.0, 17.0, 18.0]),
            brakes: ropes([19.0, 20.0, 21.0]),
            lateral_largest: single(22.0),
            bed_force: single(23.0),
            bolt_largest: single(24.0),
            bolt_lift: single(25.0),
            net_largest: single(26.0),
            broken_pieces: vec![0.0, 1.0, 2.0],
            drawn_out: single(0.27),
            top_rope_height: vec![2.0, 1.8, 1.5],
            velocity: vec![[5.0, 0.0], [3.0, 0.0], [0.0, 0.0]],
            lost: vec![[0.0; 4], [0.0; 4], [0.04, 0.03, 0.02, 0.01]],
            stopped_upstream: 0.1,
            incoming: vec![gauge; 3],
            approaching: [0.3, 0.4, 0.5].map(|depth| Gauge { depth, ..Gauge::default() }).to_vec(),
            gauges: [8.0, 2.0],
            barrier_depth: vec![0.0, 0.5, 0.7],
            dead_depth: vec![0.0; 3],
            pushes_by_state: vec![[0.0; 2]; 3],
            dead: vec![0.0; 3],
            moving: vec![0.0; 3],
            front: vec![-8.0, -5.0, -2.0],
            ..Histories::default()
        };
        let seen = Observed::read(&histories, &design, &guideline, Reading { window: 1, tail: 1 });
        assert_eq!((seen.force_peak, seen.force_peak_time, seen.force_residual), (90.0, 2.0, 60.0));
        assert_eq!((seen.push_peak, seen.velocity_peak, seen.velocity_peak_time), (90.0, 5.0, 1.0));
        assert_eq!((seen.force_peak_sampled, &seen.force), (90.0, &vec![30.0, 90.0, 60.0]));
        assert_eq!((seen.stopped_upstream, seen.lost), (0.1, [0.04, 0.03, 0.02, 0.01]));
        assert_eq!((seen.net_tension_residual, seen.incoming_at_peak.depth), (13.0, 0.4));
        // From 8 m to 2 m before the barrier in the two seconds between samples.
        assert_eq!(seen.front_velocity, Some(3.0));
        assert_eq!(seen.rope_mean_peak, [1.0, 2.0, 3.0]);
        assert_eq!(seen.rope_mean_residual, [0.25, 0.5, 0.75]);
        assert_eq!(seen.rope_tension_peak, [4.0, 5.0, 6.0]);
        assert_eq!(seen.anchor_force_peak, [7.0, 8.0, 9.0]);
        assert_eq!(seen.extension, [10.0, 11.0, 12.0]);
        assert_eq!(seen.brake_stroke, [13.0, 14.0, 15.0]);
        assert_eq!(seen.brake_stroke_mean, [16.0, 17.0, 18.0]);
        assert_eq!(seen.brake_force_peak, [19.0, 20.0, 21.0]);
        assert_eq!((seen.lateral_tension_peak, seen.bed_force_peak), (22.0, 23.0));
        assert_eq!((seen.bolt_force_peak, seen.bolt_lift_peak, seen.net_tension_peak), (24.0, 25.0, 26.0));
        assert_eq!((seen.broken_pieces, seen.first_break, seen.drawn_out), (2.0, Some(2.0), 0.27));
        assert_relative_eq!(seen.residual_height, 0.75);
        // 10 % went past, 10 % never came: 80 of the 90 % that came are held.
        assert_relative_eq!(seen.retained, 0.8 / 0.9, max_relative = 1e-12);
        assert_eq!((seen.deposit_depth, seen.incoming.velocity), (0.7, 4.0));
        assert!(seen.fits(&design) && histories.is_whole());
    }

    /// K ρ g' H²/2 with K = 1.5 on a deposit of 2 m at rest; λ ρ v² h = 0.8 of a flow of h v² = 36 m³/s² before.
    #[test]
    fn k_and_lambda_are_read_off_the_force() {
        let mut design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        design.factors.earth_pressure = 1.2;
        let guideline = crate::demand::from_loads::guideline(&design);
        let (unit, width) = (guideline.input.density * guideline.input.gravity_normal, design.channel.width);
        let (at_peak, at_rest) =
            (0.5 * 1.2 * unit * 1.0 + 0.8 * guideline.input.density * 36.0, 0.5 * 1.5 * unit * 4.0);
        assert!(at_peak > at_rest);
        let gauge = Gauge { depth: 1.0, velocity: 6.0, flux: 36.0, ..Gauge::default() };
        let histories = Histories {
            time: vec![0.0, 1.0, 2.0],
            force: [0.0, at_peak, at_rest].map(|along| dem::Vec3::new(along * width, 0.0, 0.0)).to_vec(),
            barrier_depth: vec![0.0, 1.0, 2.0],
            incoming: vec![gauge, Gauge::default(), Gauge { at_rest: 0.5, flux: 99.0, ..gauge }],
            ..Histories::default()
        };
        let mut seen = Observed { deposit_depth: 2.0, ..Observed::default() };
        seen.measure_coefficients(&histories, &design, &guideline, Reading { window: 1, tail: 1 });
        assert_relative_eq!(seen.k_effective.unwrap(), 1.5, max_relative = 1e-9);
        assert_relative_eq!(seen.lambda_effective.unwrap(), 0.8, max_relative = 1e-9);
    }

    /// A wall of two segments, 15.2 m wide: forces and moment are told per metre.
    #[test]
    fn what_a_wall_takes_is_told_per_metre() {
        let text =
            include_str!("../../designs/rigid_wall.yaml").replace("    # segments:", "    segments: [2 m, 3.5 m] #");
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let guideline = crate::demand::from_loads::guideline(&design);
        let row = |peak: f64| vec![0.0, 15.2 * peak, 7.6 * peak];
        let histories = Histories {
            time: vec![1.0, 2.0, 3.0],
            force: vec![dem::Vec3::zeros(); 3],
            segments: vec![row(40.0), row(30.0)],
            moment: row(50.0),
            velocity: vec![[0.0; 2]; 3],
            lost: vec![[0.0; 4]; 3],
            incoming: vec![Gauge::default(); 3],
            barrier_depth: vec![0.0; 3],
            dead_depth: vec![0.0; 3],
            pushes_by_state: vec![[0.0; 2]; 3],
            ..Histories::default()
        };
        let seen = Observed::read(&histories, &design, &guideline, Reading { window: 1, tail: 1 });
        for (found, by_hand) in [
            (&seen.segment_peak, [40.0, 30.0]),
            (&seen.segment_residual, [20.0, 15.0]),
            (&vec![seen.moment_peak; 2], [50.0; 2]),
        ] {
            for (found, by_hand) in found.iter().zip(by_hand) {
                assert_relative_eq!(*found, by_hand, max_relative = 1e-12);
            }
        }
        assert_eq!((seen.front_velocity, seen.residual_height), (None, 1.0));
        assert!(seen.fits(&design));
    }

    /// What was forged: a number too few of a rope, of a segment, of a coefficient.
    #[test]
    fn what_has_not_a_number_for_each_part_does_not_fit() {
        let net = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let whole = Observed {
            rope_mean_peak: vec![0.0; 3],
            rope_mean_residual: vec![0.0; 3],
            extension: vec![0.0; 3],
            brake_stroke_mean: vec![0.0; 3],
            ..Observed::of_ropes(3)
        };
        assert!(whole.fits(&net));
        assert!(!Observed { extension: vec![0.0; 2], ..whole.clone() }.fits(&net));
        assert!(!Observed { segment_peak: vec![0.0], ..whole.clone() }.fits(&net));
        let coefficients = Coefficients { time: vec![0.0], ..Coefficients::default() };
        assert!(!Observed { coefficients, ..whole }.fits(&net));
    }

    /// Timed from the far gauge, or from where the front starts nearer than that; not where it never came, or was there at once.
    #[test]
    fn the_front_is_timed_between_its_gauges() {
        let timed = |front: &[f64]| {
            let time = (0..front.len()).map(|sample| 0.5 * sample as f64).collect();
            front_velocity(&Histories { time, front: front.to_vec(), gauges: [10.0, 1.0], ..Histories::default() })
        };
        assert_eq!(timed(&[-12.0, -10.0, -5.0, -1.0, 0.0]), Some(9.0));
        assert_eq!(timed(&[-5.0, -3.0, -1.0]), Some(4.0));
        assert_eq!(timed(&[-12.0, -10.0, -5.0]), None);
        assert_eq!(timed(&[-0.5, 0.0]), None);
    }

    #[test]
    fn a_net_without_a_first_height_has_lost_none() {
        let left =
            |heights: &[f64]| residual_height(&Histories { top_rope_height: heights.to_vec(), ..Histories::default() });
        assert_eq!((left(&[2.0, 1.0]), left(&[0.0, 1.0]), left(&[])), (0.5, 1.0, 1.0));
    }

    /// Grains of 450 mm: a deposit or a flow thinner than two of them, or than one for the flow, has no depth; neither has a flow of which
    /// more than a hundredth rests. K of a deposit of 6.5 m behind 4.213 m of wall: 2 F/(ρ g' t (2 d − t)).
    #[test]
    fn k_and_lambda_are_told_where_there_is_a_depth() {
        let design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let guideline = crate::demand::from_loads::guideline(&design);
        let (unit, width) = (guideline.input.density * guideline.input.gravity_normal, design.channel.width);
        let grain = design.flow.sizes.quantile(0.5);
        let read = |deposit_depth: f64, gauge: Gauge| {
            let histories = Histories {
                time: vec![0.0, 1.0, 2.0],
                force: [0.0, 500e3, 300e3].map(|along| dem::Vec3::new(along * width, 0.0, 0.0)).to_vec(),
                barrier_depth: vec![0.0; 3],
                incoming: vec![gauge, Gauge::default(), Gauge { flux: 99.0, depth: 2.0, velocity: 9.0, ..gauge }],
                ..Histories::default()
            };
            let mut seen = Observed { deposit_depth, ..Observed::default() };
            seen.measure_coefficients(&histories, &design, &guideline, Reading { window: 1, tail: 1 });
            (seen.k_effective, seen.lambda_effective)
        };
        let flow = Gauge { depth: 1.0, velocity: 5.0, flux: 25.0, ..Gauge::default() };
        let top = guideline.input.barrier_height;
        let (k, lambda) = read(6.5, flow);
        assert_relative_eq!(k.unwrap(), 2.0 * 300e3 / (unit * top * (13.0 - top)), max_relative = 1e-9);
        assert_relative_eq!(lambda.unwrap(), 500e3 / (guideline.input.density * 25.0), max_relative = 1e-9);
        assert_eq!(read(1.9 * grain, flow).0, None);
        assert_eq!(read(2.0 * grain, flow).0, None);
        assert!(read(2.1 * grain, flow).0.is_some());
        assert_eq!(read(0.0, Gauge { depth: 0.9 * grain, ..flow }).1, None);
        assert_eq!(read(0.0, Gauge { depth: grain, ..flow }).1, None);
        assert!(read(0.0, Gauge { depth: 1.001 * grain, ..flow }).1.is_some());
        assert_eq!(read(0.0, Gauge { at_rest: 0.02, ..flow }).1, None);
        assert!(read(0.0, Gauge { at_rest: 0.01, ..flow }).1.is_some());
        assert_eq!(read(0.0, Gauge { flux: 0.0, ..flow }).1, None);
        // What arrives in the very sample in which the force is largest counts.
        let histories = Histories {
            time: vec![0.0, 1.0],
            force: [0.0, 500e3].map(|along| dem::Vec3::new(along * width, 0.0, 0.0)).to_vec(),
            barrier_depth: vec![0.0; 2],
            incoming: vec![Gauge::default(), flow],
            ..Histories::default()
        };
        let mut seen = Observed::default();
        seen.measure_coefficients(&histories, &design, &guideline, Reading { window: 1, tail: 1 });
        assert_eq!(seen.incoming.velocity, 5.0);
    }
}
