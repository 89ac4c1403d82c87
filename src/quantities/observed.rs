//! What the simulation showed, as numbers: a value for each quantity of the list, or one for each rope or segment.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::design::Design;
use crate::guideline::Guideline;
use crate::quantities::coefficients::Coefficients;
use crate::quantities::counts::Counts;
use crate::quantities::quantity::Quantity;
use crate::quantities::reading::{Reading, Samples};
use crate::quantities::{QUANTITIES, earth_pressure, height, incoming, mass};
use dem::recorders::gauge::Gauge;
use dem::recorders::histories::Histories;

/// Numbers read off the histories of one run, SI.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Observed {
    /// By the id of their quantity.
    values: BTreeMap<String, Vec<f64>>,
    /// The smoothed total force, sample by sample (N).
    pub force: Vec<f64>,
    /// The flow just upstream of the barrier when its momentum flux was largest, before grains came to rest there.
    pub incoming: Gauge,
    /// K and λ over time by the split into grains at rest and moving ones.
    pub coefficients: Coefficients,
}

impl Observed {
    /// Reads every quantity off a run.
    pub fn read(histories: &Histories, design: &Design, guideline: &Guideline, samples: Samples) -> Self {
        let reading = Reading::of(histories, design, guideline, samples);
        let values = QUANTITIES.iter().map(|quantity| (quantity.id.to_string(), (quantity.read)(&reading))).collect();
        Self { values, force: reading.smooth, incoming: reading.incoming, coefficients: reading.coefficients }
    }

    /// A run in which nothing happened to a barrier of so many parts: all is held and stands.
    pub fn of_nothing(counts: Counts) -> Self {
        let zeros = |quantity: &Quantity| vec![0.0; counts.values(quantity.of)[0]];
        let values = QUANTITIES.iter().map(|quantity| (quantity.id.to_string(), zeros(quantity))).collect();
        Self { values, ..Self::default() }.with(&mass::RETAINED, &[1.0]).with(&height::RESIDUAL, &[1.0])
    }

    /// The same with other values of a quantity.
    pub fn with(mut self, quantity: &Quantity, values: &[f64]) -> Self {
        self.values.insert(quantity.id.to_string(), values.to_vec());
        self
    }

    /// The same without some of what a run may not tell.
    pub fn without(self, quantities: &[&Quantity]) -> Self {
        quantities.iter().fold(self, |seen, quantity| seen.with(quantity, &[]))
    }

    /// The same with what another part of the run tells of the flow that comes, and of its λ.
    pub fn arriving_as(mut self, first: &Self) -> Self {
        for quantity in [&incoming::DEPTH, &incoming::VELOCITY, &incoming::FRONT, &earth_pressure::DYNAMIC] {
            self = self.with(quantity, first.each(quantity));
        }
        self.incoming = first.incoming;
        self
    }

    /// The value of a quantity of the run. One that is not there is not a number, so that nothing is judged by it.
    pub fn one(&self, quantity: &Quantity) -> f64 {
        self.known(quantity).unwrap_or(f64::NAN)
    }

    /// The same of a quantity that a run may not tell.
    pub fn known(&self, quantity: &Quantity) -> Option<f64> {
        self.each(quantity).first().copied()
    }

    /// The values of a quantity of each rope or segment.
    pub fn each(&self, quantity: &Quantity) -> &[f64] {
        self.values.get(quantity.id).map_or(&[], Vec::as_slice)
    }

    /// One of them, counted from 0; what a run does not give is not a number, so that nothing is judged by it.
    pub fn nth(&self, quantity: &Quantity, number: usize) -> f64 {
        self.each(quantity).get(number).copied().unwrap_or(f64::NAN)
    }

    /// Shares of the mass that went through, under, beside and over the barrier.
    pub fn lost(&self) -> [f64; 4] {
        mass::WAYS.map(|(_, quantity)| self.one(quantity))
    }

    /// Whether there is a number for each part of the design's barrier: what was read from a file may have
    /// been forged.
    pub fn fits(&self, design: &Design) -> bool {
        let counts = Counts::of(design);
        let whole = |quantity: &&Quantity| {
            let [least, most] = counts.values(quantity.of);
            (least..=most).contains(&self.each(quantity).len())
        };
        QUANTITIES.iter().all(whole) && self.coefficients.is_whole()
    }
}
#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::design::{BarrierDesign, Stability};
    use crate::quantities::quantity::Quantity;
    use crate::quantities::{
        anchor_load, bed, dissipator, earth_pressure, incoming, other_ropes, rope_damage, rope_tension, total_force,
        wall,
    };
    use approx::assert_relative_eq;
    use dem::Vec3;
    use dem::recorders::channels::{Channel, Channels};
    use dem::recorders::{of_anchors, of_dissipators, of_ropes, of_wall};

    const SAMPLES: Samples = Samples { window: 1, tail: 1 };

    fn net() -> Design {
        read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design
    }

    fn rigid_wall() -> Design {
        read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design
    }

    fn read(histories: &Histories, design: &Design) -> Observed {
        Observed::read(histories, design, &crate::guideline::guideline(design), SAMPLES)
    }

    /// Histories of forces along the bed (N), a sample each second, with nothing else.
    fn forces(along: &[f64]) -> Histories {
        let samples = along.len();
        Histories {
            time: (0..samples).map(|sample| sample as f64).collect(),
            force: along.iter().map(|along| Vec3::new(*along, 0.0, 0.0)).collect(),
            velocity: vec![[0.0; 2]; samples],
            lost: vec![[0.0; 4]; samples],
            incoming: vec![Gauge::default(); samples],
            barrier_depth: vec![0.0; samples],
            dead_depth: vec![0.0; samples],
            pushes_by_state: vec![[0.0; 2]; samples],
            ..Histories::default()
        }
    }

    /// By hand, per metre: on a level base below a bed of 40° a force of 30 kN along the bed and 100 kN off it slides the wall with its
    /// level part, 30 cos 40° + 100 sin 40° = 87.26 kN, and with what its lift, 100 cos 40° − 30 sin 40° = 57.32 kN, takes from friction;
    /// the lift tips it about the edge of a base of 2 m beside the moment of 50 kN m.
    #[test]
    fn a_measured_push_slides_and_tips_a_wall_with_its_lift() {
        let mut design = rigid_wall();
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        wall.stability = Some(Stability {
            thickness: 2.0,
            density: 2400.0,
            base_width: 2.0,
            base_slope: Some(0.0),
            founding_depth: 0.0,
            base_friction: 0.5,
            ground_density: 2200.0,
            sliding_factor: 1.1,
            overturning_factor: 1.5,
            bearing_resistance: None,
            bearing_factor: 1.4,
            block_length: None,
            water_head: Some(0.0),
        });
        let width = design.channel.width;
        let histories = Histories {
            force: vec![Vec3::new(30e3, 0.0, 100e3) * width; 5],
            barrier: Channels::default().with(&of_wall::MOMENT, vec![vec![50e3 * width; 5]]),
            ..forces(&[0.0; 5])
        };
        let seen = read(&histories, &design);
        assert_relative_eq!(seen.one(&wall::SLIDING), 87.26e3 + 0.5 * 57.32e3, max_relative = 1e-3);
        assert_relative_eq!(seen.one(&wall::OVERTURNING), 50e3 + 2.0 * 57.32e3, max_relative = 1e-3);
    }

    /// A deposit of one grain has no K that could be reported, and still one that the equations are asked with: 2 F / (γ d²).
    #[test]
    fn k_of_a_thin_deposit_is_read_but_not_reported() {
        let design = net();
        let (grain, width) = (design.flow.sizes.quantile(0.5), design.channel.width);
        let input = crate::guideline::guideline(&design).input;
        let histories = Histories {
            force: vec![Vec3::new(2e3 * width, 0.0, 0.0); 5],
            barrier_depth: vec![grain; 5],
            ..forces(&[0.0; 5])
        };
        let seen = read(&histories, &design);
        assert_eq!(seen.known(&earth_pressure::AT_REST), None);
        let by_hand = 2.0 * 2e3 / (input.density * input.gravity_normal * grain.powi(2));
        assert_relative_eq!(seen.one(&earth_pressure::OF_ANY_DEPTH), by_hand, max_relative = 1e-9);
    }

    /// Each number of a net is read off its own history: its largest value, or its last, by rope.
    #[test]
    fn every_number_is_read_off_its_history() {
        let design = net();
        let ropes = |rows: [f64; 3]| rows.map(|row| vec![0.5 * row, row, 0.25 * row]).to_vec();
        let single = |peak: f64| vec![vec![0.2 * peak, peak, 0.5 * peak]];
        let gauge = Gauge { velocity: 4.0, depth: 0.9, flux: 14.0, ..Gauge::default() };
        let of_each_rope: [(&Channel, [f64; 3]); 9] = [
            (&of_ropes::MEAN, [1.0, 2.0, 3.0]),
            (&of_ropes::LARGEST, [4.0, 5.0, 6.0]),
            (&of_anchors::LOAD, [7.0, 8.0, 9.0]),
            (&of_ropes::LARGEST_AT_ONCE, [4.5, 5.5, 6.5]),
            (&of_anchors::LOAD_AT_ONCE, [7.5, 8.5, 9.5]),
            (&of_ropes::EXTENSION, [10.0, 11.0, 12.0]),
            (&of_dissipators::STROKE, [13.0, 14.0, 15.0]),
            (&of_dissipators::MEAN_STROKE, [16.0, 17.0, 18.0]),
            (&of_dissipators::TENSION, [19.0, 20.0, 21.0]),
        ];
        let of_the_net: [(&Channel, f64); 9] = [
            (&of_ropes::LATERAL, 22.0),
            (&of_anchors::BED, 23.0),
            (&of_anchors::BOLT, 24.0),
            (&of_anchors::BOLT_LIFT, 25.0),
            (&of_ropes::NET, 26.0),
            (&of_ropes::DRAWN_OUT, 0.27),
            (&of_ropes::LATERAL_AT_ONCE, 22.5),
            (&of_anchors::BOLT_AT_ONCE, 24.5),
            (&of_ropes::NET_AT_ONCE, 26.5),
        ];
        let mut barrier = Channels::default()
            .with(&of_ropes::BROKEN, vec![vec![0.0, 1.0, 2.0]])
            .with(&of_ropes::TOP_HEIGHT, vec![vec![2.0, 1.8, 1.5]]);
        // Of two anchors to a free rope, in a channel whose slope turns the vectors.
        let pulls = [[3.0, 0.0, 4.0], [0.0, 2.0, 0.0], [0.0, -2.0, 0.0], [1.0, 2.0, 2.0]];
        for (axis, channel) in of_anchors::EACH.iter().enumerate() {
            let rows = pulls.map(|pull| vec![0.0, pull[axis], 0.5 * pull[axis]]);
            barrier = barrier.with(channel, rows.to_vec());
        }
        for (channel, peaks) in of_each_rope {
            barrier = barrier.with(channel, ropes(peaks));
        }
        for (channel, peak) in of_the_net {
            barrier = barrier.with(channel, single(peak));
        }
        let histories = Histories {
            time: vec![1.0, 2.0, 3.0],
            barrier,
            velocity: vec![[5.0, 0.0], [3.0, 0.0], [0.0, 0.0]],
            lost: vec![[0.0; 4], [0.0; 4], [0.04, 0.03, 0.02, 0.01]],
            stopped_upstream: 0.1,
            incoming: vec![gauge; 3],
            approaching: [0.3, 0.4, 0.5].map(|thickness| Gauge { thickness, ..Gauge::default() }).to_vec(),
            gauges: [8.0, 2.0],
            barrier_depth: vec![0.0, 0.5, 0.7],
            front: vec![-8.0, -5.0, -2.0],
            ..forces(&[30.0, 90.0, 60.0])
        };
        let seen = read(&histories, &design);
        let single: [(&Quantity, f64); 24] = [
            (&total_force::PEAK, 90.0),
            (&total_force::PEAK_TIME, 2.0),
            (&total_force::PEAK_SAMPLED, 90.0),
            (&total_force::RESIDUAL, 60.0),
            (&total_force::PUSH, 90.0),
            (&mass::VELOCITY, 5.0),
            (&mass::VELOCITY_TIME, 1.0),
            (&mass::STOPPED_UPSTREAM, 0.1),
            (&height::TOP_ROPE, 1.5),
            (&other_ropes::LATERAL, 22.0),
            (&other_ropes::NET, 26.0),
            (&other_ropes::NET_RESIDUAL, 13.0),
            (&bed::FORCE, 23.0),
            (&bed::BOLT, 24.0),
            (&bed::BOLT_LIFT, 25.0),
            (&other_ropes::LATERAL_AT_ONCE, 22.5),
            (&bed::BOLT_AT_ONCE, 24.5),
            (&other_ropes::NET_AT_ONCE, 26.5),
            (&rope_damage::BROKEN, 2.0),
            (&rope_damage::FIRST_BREAK, 2.0),
            (&rope_damage::DRAWN_OUT, 0.27),
            (&incoming::DEPOSIT, 0.7),
            (&incoming::THICKNESS_AT_PEAK, 0.4),
            // From 8 m to 2 m before the barrier in the two seconds between samples.
            (&incoming::FRONT, 3.0),
        ];
        for (quantity, value) in single {
            assert_eq!(seen.one(quantity), value, "{}", quantity.id);
        }
        let by_rope: [(&Quantity, [f64; 3]); 10] = [
            (&rope_tension::MEAN_PEAK, [1.0, 2.0, 3.0]),
            (&rope_tension::MEAN_RESIDUAL, [0.25, 0.5, 0.75]),
            (&rope_tension::PEAK, [4.0, 5.0, 6.0]),
            (&anchor_load::PEAK, [7.0, 8.0, 9.0]),
            (&rope_tension::AT_ONCE, [4.5, 5.5, 6.5]),
            (&anchor_load::AT_ONCE, [7.5, 8.5, 9.5]),
            (&rope_tension::DEFLECTION, [10.0, 11.0, 12.0]),
            (&dissipator::STROKE, [13.0, 14.0, 15.0]),
            (&dissipator::MEAN_STROKE, [16.0, 17.0, 18.0]),
            (&dissipator::TENSION, [19.0, 20.0, 21.0]),
        ];
        for (quantity, values) in by_rope {
            assert_eq!(seen.each(quantity), values, "{}", quantity.id);
        }
        for (found, by_hand) in seen.each(&anchor_load::EACH).iter().zip([5.0, 2.0, 2.0, 3.0]) {
            assert_relative_eq!(*found, by_hand, max_relative = 1e-12);
        }
        // On 25°: 3 cos 25° + 4 sin 25° down the valley, 4 cos 25° − 3 sin 25° up.
        assert_relative_eq!(seen.each(&anchor_load::ALONG)[0], 4.409_4, max_relative = 1e-4);
        assert_relative_eq!(seen.each(&anchor_load::UP)[0], 2.357_4, max_relative = 1e-4);
        assert_eq!(seen.each(&anchor_load::ACROSS), [0.0, 2.0, -2.0, 2.0]);
        assert_eq!((seen.force.as_slice(), seen.lost()), (&[30.0, 90.0, 60.0][..], [0.04, 0.03, 0.02, 0.01]));
        assert_relative_eq!(seen.one(&height::RESIDUAL), 0.75);
        // 10 % went past, 10 % never came: 80 of the 90 % that came are held.
        assert_relative_eq!(seen.one(&mass::RETAINED), 0.8 / 0.9, max_relative = 1e-12);
        assert_eq!((seen.one(&incoming::DEPTH), seen.one(&incoming::VELOCITY)), (0.9, 4.0));
        assert!(seen.fits(&design) && histories.is_whole());
    }

    #[test]
    fn every_quantity_has_a_name_and_a_field_of_its_own() {
        let ids: std::collections::BTreeSet<&str> = QUANTITIES.iter().map(|quantity| quantity.id).collect();
        assert_eq!(ids.len(), QUANTITIES.len());
        let fields: Vec<String> = QUANTITIES.iter().map(|quantity| format!("{:?}", quantity.json)).collect();
        let named: Vec<&String> = fields.iter().filter(|field| *field != "Nowhere").collect();
        assert_eq!(named.iter().collect::<std::collections::BTreeSet<_>>().len(), named.len());
        // One that is not there is not a number, and so passes no check.
        assert!(Observed::default().one(&total_force::PEAK).is_nan());
    }

    /// K ρ g' H²/2 with K = 1.5 on a deposit of 2 m at rest; λ ρ v² h = 0.8 of a flow of h v² = 36 m³/s² before.
    #[test]
    fn k_and_lambda_are_read_off_the_force() {
        let mut design = rigid_wall();
        design.factors.earth_pressure = 1.2;
        let guideline = crate::guideline::guideline(&design);
        let (unit, width) = (guideline.input.density * guideline.input.gravity_normal, design.channel.width);
        let (at_peak, at_rest) =
            (0.5 * 1.2 * unit * 1.0 + 0.8 * guideline.input.density * 36.0, 0.5 * 1.5 * unit * 4.0);
        assert!(at_peak > at_rest);
        let gauge = Gauge { depth: 1.0, velocity: 6.0, flux: 36.0, ..Gauge::default() };
        let histories = Histories {
            barrier_depth: vec![0.0, 1.0, 2.0],
            incoming: vec![gauge, Gauge::default(), Gauge { at_rest: 0.5, flux: 99.0, ..gauge }],
            ..forces(&[0.0, at_peak * width, at_rest * width])
        };
        let seen = read(&histories, &design);
        assert_relative_eq!(seen.one(&earth_pressure::AT_REST), 1.5, max_relative = 1e-9);
        assert_relative_eq!(seen.one(&earth_pressure::DYNAMIC), 0.8, max_relative = 1e-9);
    }

    /// A wall of two segments, 15.2 m wide: forces and moment are told per metre.
    #[test]
    fn what_a_wall_takes_is_told_per_metre() {
        let text =
            include_str!("../../designs/rigid_wall.yaml").replace("    # segments:", "    segments: [2 m, 3.5 m] #");
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let row = |peak: f64| vec![0.0, 15.2 * peak, 7.6 * peak];
        let barrier = Channels::default()
            .with(&of_wall::SEGMENTS, vec![row(40.0), row(30.0)])
            .with(&of_wall::MOMENT, vec![row(50.0)]);
        let seen = read(&Histories { barrier, ..forces(&[0.0, 15.2 * 60.0, 0.0]) }, &design);
        let by_hand: [(&Quantity, &[f64]); 4] = [
            (&wall::SEGMENT, &[40.0, 30.0]),
            (&wall::SEGMENT_RESIDUAL, &[20.0, 15.0]),
            (&wall::MOMENT, &[50.0]),
            (&total_force::ON_A_METRE, &[60.0]),
        ];
        for (quantity, by_hand) in by_hand {
            assert_eq!(seen.each(quantity).len(), by_hand.len());
            for (found, by_hand) in seen.each(quantity).iter().zip(by_hand) {
                assert_relative_eq!(*found, *by_hand, max_relative = 1e-12);
            }
        }
        assert_eq!((seen.known(&incoming::FRONT), seen.one(&height::RESIDUAL)), (None, 1.0));
        assert!(seen.fits(&design));
    }

    /// What was forged: a number too few of a rope, of a segment, of a run, of a coefficient.
    #[test]
    fn what_has_not_a_number_for_each_part_does_not_fit() {
        let net = net();
        let whole = || Observed::of_nothing(Counts::of(&net));
        assert!(whole().fits(&net));
        assert!(!whole().with(&rope_tension::DEFLECTION, &[0.0; 2]).fits(&net));
        assert!(!whole().with(&wall::SEGMENT, &[0.0]).fits(&net));
        assert!(!whole().with(&total_force::PEAK, &[]).fits(&net));
        let coefficients = Coefficients { time: vec![0.0], ..Coefficients::default() };
        assert!(!Observed { coefficients, ..whole() }.fits(&net));
    }

    /// Timed from the far gauge, or from where the front starts nearer than that; not where it never came, or was there at once.
    #[test]
    fn the_front_is_timed_between_its_gauges() {
        let timed = |front: &[f64]| {
            let time = (0..front.len()).map(|sample| 0.5 * sample as f64).collect();
            let histories =
                Histories { time, front: front.to_vec(), gauges: [10.0, 1.0], ..forces(&vec![0.0; front.len()]) };
            read(&histories, &net()).known(&incoming::FRONT)
        };
        assert_eq!(timed(&[-12.0, -10.0, -5.0, -1.0, 0.0]), Some(9.0));
        assert_eq!(timed(&[-5.0, -3.0, -1.0]), Some(4.0));
        assert_eq!(timed(&[-12.0, -10.0, -5.0]), None);
        assert_eq!(timed(&[-0.5, 0.0]), None);
    }

    #[test]
    fn a_net_without_a_first_height_has_lost_none() {
        let left = |heights: &[f64]| {
            let barrier = Channels::default().with(&of_ropes::TOP_HEIGHT, vec![heights.to_vec()]);
            read(&Histories { barrier, ..forces(&vec![0.0; heights.len()]) }, &net()).one(&height::RESIDUAL)
        };
        assert_eq!((left(&[2.0, 1.0]), left(&[0.0, 1.0]), left(&[])), (0.5, 1.0, 1.0));
    }

    /// Grains of 450 mm: a deposit or a flow thinner than two of them, or than one for the flow, has no depth; neither has a flow of which
    /// more than a hundredth rests. K of a deposit of 6.5 m behind 4.213 m of wall: 2 F/(ρ g' t (2 d − t)).
    #[test]
    fn k_and_lambda_are_told_where_there_is_a_depth() {
        let design = rigid_wall();
        let guideline = crate::guideline::guideline(&design);
        let (unit, width) = (guideline.input.density * guideline.input.gravity_normal, design.channel.width);
        let grain = design.flow.sizes.quantile(0.5);
        let told = |deposit: f64, gauge: Gauge| {
            let histories = Histories {
                barrier_depth: vec![0.0, 0.0, deposit],
                incoming: vec![gauge, Gauge::default(), Gauge { flux: 99.0, depth: 2.0, velocity: 9.0, ..gauge }],
                ..forces(&[0.0, 500e3 * width, 300e3 * width])
            };
            let seen = read(&histories, &design);
            (seen.known(&earth_pressure::AT_REST), seen.known(&earth_pressure::DYNAMIC))
        };
        let flow = Gauge { depth: 1.0, velocity: 5.0, flux: 25.0, ..Gauge::default() };
        let top = guideline.input.barrier_height;
        let (k, lambda) = told(6.5, flow);
        assert_relative_eq!(k.unwrap(), 2.0 * 300e3 / (unit * top * (13.0 - top)), max_relative = 1e-9);
        assert_relative_eq!(lambda.unwrap(), 500e3 / (guideline.input.density * 25.0), max_relative = 1e-9);
        assert_eq!(told(1.9 * grain, flow).0, None);
        assert_eq!(told(2.0 * grain, flow).0, None);
        assert!(told(2.1 * grain, flow).0.is_some());
        assert_eq!(told(0.0, Gauge { depth: 0.9 * grain, ..flow }).1, None);
        assert_eq!(told(0.0, Gauge { depth: grain, ..flow }).1, None);
        assert!(told(0.0, Gauge { depth: 1.001 * grain, ..flow }).1.is_some());
        assert_eq!(told(0.0, Gauge { at_rest: 0.02, ..flow }).1, None);
        assert!(told(0.0, Gauge { at_rest: 0.01, ..flow }).1.is_some());
        assert_eq!(told(0.0, Gauge { flux: 0.0, ..flow }).1, None);
        // What arrives in the very sample in which the force is largest counts.
        let histories = Histories { incoming: vec![Gauge::default(), flow], ..forces(&[0.0, 500e3 * width]) };
        assert_eq!(read(&histories, &design).incoming.velocity, 5.0);
    }
}
