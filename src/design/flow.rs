//! The design flow: how much of what, and how it comes.

use crate::design::hydrograph::Hydrograph;
use crate::design::sizes::SizeCurve;

/// The design flow.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    pub mass: f64,
    /// With pores, of the whole event; the flow is one surge of it, or all (m³).
    pub event_volume: f64,
    /// kg/m³, grains with pores.
    pub bulk_density: f64,
    /// kg/m³, grains alone.
    pub solid_density: f64,
    /// As simulated.
    pub sizes: SizeCurve,
    /// Share of the mass below which nothing is given of the curve: it is continued from there.
    pub known_from: f64,
    /// What of the design's curve was made coarser, if anything was.
    pub cut: Option<CurveCut>,
    /// Length over width of a grain, 1 (sphere) to 2.
    pub aspect: f64,
    pub grain_friction: f64,
    pub restitution: f64,
    /// Contact modulus of the grains (Pa).
    pub modulus: f64,
    /// What is in its pores; nothing in a dry flow.
    pub pore_fluid: Option<PoreFluid>,
    /// How it comes; where it comes in several surges, the first of them, whose mass is `mass`.
    pub arrival: Arrival,
    /// How it comes by time at an inlet; its arrival is then that of a surge of the whole with the depth and the velocity of the hardest row.
    pub hydrograph: Option<Hydrograph>,
    /// Boulders that come with it, or with the first of several surges; a part of its mass.
    pub boulders: Vec<Boulders>,
    /// The surges that come after the first, in their order.
    pub later: Vec<LaterSurge>,
}

/// Water, or mud with the finest of the flow, in the pores: it moves with the grains and carries a part of the pressure between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreFluid {
    /// kg/m³
    pub density: f64,
    /// r_u, pore pressure over the total pressure, as the flow arrives.
    pub pressure_ratio: f64,
    /// Time in which the pressure of the fluid falls to 37 % where the flow rests (s).
    pub drains_in: f64,
    /// r_u that stays, that of the fluid at rest unless the design says that it runs off.
    pub drains_to: f64,
}

impl PoreFluid {
    /// K of the whole pressure where the grains' share of it has a K of their own: r_u + (1 − r_u) K.
    pub fn of_the_whole(&self, earth_pressure: f64) -> f64 {
        self.pressure_ratio + (1.0 - self.pressure_ratio) * earth_pressure
    }
}

/// Boulders of one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boulders {
    /// Of a sphere of the same volume (m).
    pub diameter: f64,
    pub number: u32,
    /// Ahead of the front of the flow, side by side on the bed; else anywhere in it.
    pub at_front: bool,
    /// kg/m³
    pub density: f64,
}

/// Distance between boulders side by side, and between their rows, over their sizes.
const PITCH: f64 = 1.05;

impl Boulders {
    /// Of all (kg).
    pub fn mass(&self) -> f64 {
        f64::from(self.number) * self.density * std::f64::consts::PI / 6.0 * self.diameter.powi(3)
    }

    /// No less than the length and the breadth of one of them (m), with the length over breadth of the grains.
    pub fn extent(&self, aspect: f64) -> [f64; 2] {
        [aspect * self.diameter, self.diameter]
    }

    /// Way that one of them may lie aside within a share of the width (m), with the length over breadth of the grains.
    pub fn room_aside(&self, share: f64, aspect: f64) -> f64 {
        (share - PITCH * self.extent(aspect)[0]).max(0.0)
    }

    /// How many of a length and breadth lie side by side across a width, and how long all their rows are along the bed (m).
    pub fn rows(&self, width: f64, [length, breadth]: [f64; 2]) -> (u32, f64) {
        let abreast = ((width / (PITCH * length)).floor() as u32).clamp(1, self.number.max(1));
        (abreast, f64::from(self.number.div_ceil(abreast)) * PITCH * breadth)
    }
}

/// A surge that comes onto what those before it have left.
#[derive(Clone, Debug, PartialEq)]
pub struct LaterSurge {
    /// With pores (m³).
    pub volume: f64,
    pub surge: Surge,
    /// Its grains, where they are others than the flow's.
    pub own: Option<OwnSizes>,
    /// Time from the release of the surge before it to its own (s); nothing where it waits until that has come to rest.
    pub after: Option<f64>,
}

/// Grain sizes of one surge, with what [`Flow`] says of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnSizes {
    pub sizes: SizeCurve,
    pub known_from: f64,
    pub cut: Option<CurveCut>,
}

/// The fine end of a grain-size curve that is not simulated as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveCut {
    /// Share of the mass below the cut.
    pub share: f64,
    /// The whole curve.
    pub whole: SizeCurve,
}

impl Flow {
    /// Whether its event is more than the first surge: more than rounding lies between their volumes.
    pub fn is_one_of_several(&self) -> bool {
        self.event_volume > 1.001 * self.volume()
    }

    /// Whether its event is more than all surges that are given.
    pub fn is_part_of_its_event(&self) -> bool {
        self.event_volume > 1.001 * self.volume_of_all()
    }

    /// Volume of the last surge of an event that is more than the surges that are given (m³): what surges as large as the first leave. Nothing where
    /// the event is no more.
    pub fn last_of_the_event(&self) -> Option<f64> {
        let surge = self.volume();
        let beyond = self.is_part_of_its_event().then(|| self.event_volume - self.volume_of_all())?;
        let left = beyond - surge * (beyond / surge).floor();
        // Rounding leaves no surge.
        Some(if left > 1e-3 * surge { left } else { surge })
    }

    /// Mass of its grains without the boulders (kg).
    pub fn mass_of_grains(&self) -> f64 {
        self.mass - self.boulders.iter().map(Boulders::mass).sum::<f64>()
    }

    /// The largest stone that it brings: its diameter (m) and its mass (kg).
    pub fn largest(&self) -> [f64; 2] {
        let diameter = self.sizes.quantile(1.0);
        let grain = [diameter, self.grain_density() * std::f64::consts::PI / 6.0 * diameter.powi(3)];
        let boulders =
            self.boulders.iter().map(|boulders| [boulders.diameter, boulders.mass() / f64::from(boulders.number)]);
        // A grain that is not known is none.
        boulders.fold(grain, |largest, boulder| if largest[1] >= boulder[1] { largest } else { boulder })
    }

    /// Whether that is known: the sizes of the grains are given up to their coarse end, or a boulder is larger than they seem to be.
    pub fn tells_the_largest(&self) -> bool {
        let seems = self.sizes.quantile(1.0);
        self.sizes.tells_the_largest() || self.boulders.iter().any(|boulders| boulders.diameter >= seems)
    }

    /// Volume of the flow with its pores, of the first surge where there are several (m³).
    pub fn volume(&self) -> f64 {
        self.mass / self.bulk_density
    }

    /// Volume of all surges with their pores (m³).
    pub fn volume_of_all(&self) -> f64 {
        self.volume() + self.later.iter().map(|later| later.volume).sum::<f64>()
    }

    /// Mass of all surges (kg).
    pub fn mass_of_all(&self) -> f64 {
        self.mass + self.later.iter().map(|later| later.volume * self.bulk_density).sum::<f64>()
    }

    /// How many surges there are.
    pub fn surges(&self) -> usize {
        1 + self.later.len()
    }

    /// Share of the volume that is grains: of a dry flow ρ/ρ_s, with a fluid in all pores (ρ − ρ_f)/(ρ_s − ρ_f).
    pub fn solid_share(&self) -> f64 {
        match self.pore_fluid {
            None => self.bulk_density / self.solid_density,
            Some(fluid) => (self.bulk_density - fluid.density) / (self.solid_density - fluid.density),
        }
    }

    /// Density of the grains as they are simulated, with the fluid that moves with them (kg/m³).
    pub fn grain_density(&self) -> f64 {
        if self.pore_fluid.is_some() { self.bulk_density / self.solid_share() } else { self.solid_density }
    }

    /// Friction (tan φ) as it acts on the flow as it comes, (1 − r_u) tan φ.
    pub fn effective(&self, friction: f64) -> f64 {
        self.pore_fluid.map_or(friction, |fluid| (1.0 - fluid.pressure_ratio) * friction)
    }

    /// Makes all that flows so many times as heavy: grains, boulders and the fluid between them.
    pub fn make_heavier(&mut self, factor: f64) {
        for value in [&mut self.mass, &mut self.bulk_density, &mut self.solid_density] {
            *value *= factor;
        }
        if let Some(fluid) = &mut self.pore_fluid {
            fluid.density *= factor;
        }
        self.boulders.iter_mut().for_each(|boulders| boulders.density *= factor);
    }

    /// Makes all grains so many times as large.
    pub fn coarsen(&mut self, factor: f64) {
        self.sizes = self.sizes.scaled(factor);
        for own in self.later.iter_mut().filter_map(|later| later.own.as_mut()) {
            own.sizes = own.sizes.scaled(factor);
        }
    }

    /// Makes all surges so many times as long.
    pub fn lengthen(&mut self, factor: f64) {
        self.mass *= factor;
        match &mut self.arrival {
            Arrival::DamBreak(block) => block.length *= factor,
            Arrival::Surge(surge) => surge.length *= factor,
        }
        self.hydrograph = self.hydrograph.as_ref().map(|hydrograph| hydrograph.longer(factor));
        for later in &mut self.later {
            later.volume *= factor;
            later.surge.length *= factor;
        }
    }

    /// One surge alone, counted from 0.
    pub fn alone(&self, number: usize) -> Self {
        let boulders = if number == 0 { self.boulders.clone() } else { Vec::new() };
        let alone = Self { later: Vec::new(), boulders, ..self.clone() };
        let Some(later) = number.checked_sub(1).and_then(|number| self.later.get(number)) else { return alone };
        let with_its_surge =
            Self { mass: later.volume * self.bulk_density, arrival: Arrival::Surge(later.surge), ..alone };
        match later.own.clone() {
            None => with_its_surge,
            Some(OwnSizes { sizes, known_from, cut }) => Self { sizes, known_from, cut, ..with_its_surge },
        }
    }

    /// All surges, with another of them first and the others after it.
    pub fn led_by(&self, number: usize) -> Self {
        let as_later = |number: usize| {
            let Self { arrival, sizes, known_from, cut, .. } = self.alone(number);
            let Arrival::Surge(surge) = arrival else { return None };
            let own = Some(OwnSizes { sizes, known_from, cut });
            Some(LaterSurge { volume: self.alone(number).volume(), surge, own, after: None })
        };
        let others = (0..self.surges()).filter(|other| *other != number);
        if number == 0 {
            self.clone()
        } else {
            Self { later: others.filter_map(as_later).collect(), ..self.alone(number) }
        }
    }

    /// The surges that differ in what they do to a barrier when they come first, by their numbers.
    pub fn distinct(&self) -> Vec<usize> {
        let alike = |one: usize, other: usize| {
            let [one, other] = [self.alone(one), self.alone(other)];
            let shape = |flow: &Self| match flow.arrival {
                Arrival::Surge(surge) => Some(Surge { length: 0.0, ..surge }),
                Arrival::DamBreak(_) => None,
            };
            shape(&one) == shape(&other) && one.sizes == other.sizes
        };
        let mut distinct: Vec<usize> = Vec::new();
        for number in 0..self.surges() {
            if !distinct.iter().any(|known| alike(*known, number)) {
                distinct.push(number);
            }
        }
        distinct
    }
}

/// How the flow comes to the barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arrival {
    DamBreak(DamBreak),
    Surge(Surge),
}

/// A body of grains upstream of the barrier, already moving down the channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surge {
    /// Of the even flow with its volume (m); with a sloping front it is longer at the bed and shorter at the surface.
    pub length: f64,
    pub depth: f64,
    pub velocity: f64,
    /// Angle between the front face and the bed (rad).
    pub front_angle: f64,
    /// From the foot of the front to the most upstream point of the barrier at the release (m).
    pub run_in: f64,
}

/// Way that a surge runs before it meets the barrier, over its depth, where the design says none: a block as it is packed moves as one
/// and hits far too hard; on this way it loosens and its front takes shape.
pub const RUN_IN: f64 = 4.0;

/// A block at rest behind a gate that opens at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DamBreak {
    pub length: f64,
    pub height: f64,
    /// From the gate to the barrier's foot.
    pub distance: f64,
    /// Depth and velocity on arrival, for the guideline loads, where the designer knows them.
    pub depth_at_barrier: Option<f64>,
    pub velocity_at_barrier: Option<f64>,
}
