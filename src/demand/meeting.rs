//! How the value that is checked is made of a quantity: by the equations, and by the packings that were simulated.

use crate::demand::value::{Demand, SimulatedRuns};
use crate::design::{AnchorOf, Factors};
use crate::guideline::{Guideline, PostLoad, RopeLoad};
use crate::larger::larger_or_nan;
use crate::quantities::observed::Observed;
use crate::quantities::quantity::{Demanded, OverPlateau, Quantity};
use crate::quantities::{dissipator, posts};
use crate::starts::Spread;

/// Factor up to which a load counts as at its cap: rounding, and the elastic part of a dissipator, lift it a little above.
pub const CAP_TOLERANCE: f64 = 1.01;

/// Share of its stroke from which a dissipator counts as used up.
pub const USED_UP: f64 = 0.999;

type Read<'q> = &'q dyn Fn(&Observed) -> f64;

fn spread(observed: &[&Observed], read: Read) -> Option<Spread> {
    (!observed.is_empty()).then(|| Spread::of(&observed.iter().map(|seen| read(seen)).collect::<Vec<_>>()))
}

/// NaN if any is; 0 for none.
fn largest(observed: &[&Observed], read: Read) -> f64 {
    observed.iter().map(|seen| read(seen)).fold(0.0, larger_or_nan)
}

/// What the next packing exceeds with a probability of 5 %; no more than the cap as long as no packing has gone beyond it.
fn capped(observed: &[&Observed], read: Read, cap: f64) -> Option<f64> {
    let most = largest(observed, read);
    let upper = spread(observed, read)?.upper();
    Some(if upper > cap && most <= cap * CAP_TOLERANCE { most.max(cap) } else { upper })
}

/// Where the two routes meet.
pub struct Meeting<'a> {
    pub guideline: &'a Guideline,
    pub factors: &'a Factors,
    pub seen: &'a SimulatedRuns<'a>,
    /// What the factored actions did, and the factor still to be put on its forces.
    pub governing: &'a [&'a Observed],
    pub factor: f64,
}

impl Meeting<'_> {
    /// The demands of a quantity: one, or one for each rope; nothing where none is asked for.
    pub fn demands(&self, quantity: &Quantity) -> Vec<Demand> {
        match quantity.demanded {
            None => Vec::new(),
            Some(Demanded::Load(by_equations)) => {
                vec![self.force(by_equations(self.guideline, self.factors), &|seen| seen.one(quantity))]
            }
            Some(Demanded::RopeLoad { capped }) => self.by_rope(quantity, capped),
            Some(Demanded::Stroke) => self.strokes(quantity),
            Some(Demanded::LoadOfAnchor) => self.loads_of_anchors(quantity),
            Some(Demanded::LoadOfPost(by_equations, over)) => self.loads_of_posts(quantity, by_equations, over),
            Some(Demanded::StrokeOfPost) => self.strokes_of_posts(quantity),
            Some(Demanded::Plateau) => vec![Demand {
                guideline: self.guideline.ropes.iter().map(|rope| rope.state.tension).reduce(larger_or_nan),
                // Capped at the plateau, and so judged by the largest of the packings.
                simulation: self
                    .worst(&|seen| seen.each(quantity).iter().copied().reduce(larger_or_nan).unwrap_or(f64::NAN)),
                ..Demand::default()
            }],
            Some(Demanded::Worst) => {
                vec![Demand { simulation: self.worst(&|seen| seen.one(quantity)), ..Demand::default() }]
            }
            Some(Demanded::Level(by_equations)) => {
                vec![self.level(by_equations(self.guideline), &|seen| seen.one(quantity))]
            }
            Some(Demanded::Kept) => vec![self.kept(&|seen| seen.one(quantity))],
        }
    }

    fn worst(&self, read: Read) -> Option<f64> {
        self.governing.iter().map(|seen| read(seen)).reduce(larger_or_nan)
    }

    /// Whether the characteristic values differ from those that are judged.
    fn is_factored(&self) -> bool {
        !self.seen.factored.is_empty() || self.factor != 1.0
    }

    fn characteristic(&self, read: Read) -> Option<f64> {
        spread(&self.seen.characteristic, read).filter(|_| self.is_factored()).map(|spread| spread.upper())
    }

    /// A force or moment; the guideline's value is factored already.
    fn force(&self, guideline: Option<f64>, read: Read) -> Demand {
        Demand {
            guideline,
            simulation: spread(self.governing, read).map(|spread| self.factor * spread.upper()),
            characteristic: self.characteristic(read),
            cap: None,
        }
    }

    /// A level, in the characteristic and in the factored case.
    fn level(&self, guideline: f64, read: Read) -> Demand {
        let upper = |observed: &[&Observed]| spread(observed, read).map(|spread| spread.upper());
        let both = upper(self.governing).into_iter().chain(upper(&self.seen.characteristic));
        let characteristic = upper(&self.seen.characteristic).filter(|_| !self.seen.factored.is_empty());
        Demand {
            guideline: Some(guideline),
            simulation: both.reduce(larger_or_nan),
            characteristic,
            ..Demand::default()
        }
    }

    /// A share that must be kept, in the characteristic and in the factored case.
    fn kept(&self, read: Read) -> Demand {
        // No less than nothing is kept, whatever the scatter makes of it.
        let share = |lower: f64| if lower < 0.0 { 0.0 } else { lower };
        let lower = |observed: &[&Observed]| spread(observed, read).map(|spread| share(spread.lower()));
        let smaller = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) };
        let both = lower(self.governing).into_iter().chain(lower(&self.seen.characteristic));
        let characteristic = lower(&self.seen.characteristic).filter(|_| !self.seen.factored.is_empty());
        Demand { simulation: both.reduce(smaller), characteristic, ..Demand::default() }
    }

    /// What a dissipator of a rope may pull with beyond its plateau, or beyond its curve wherever on it (N).
    fn excess(&self) -> f64 {
        self.guideline.dissipator.as_ref().map_or(0.0, |given| (self.factors.overstrength - 1.0) * given.largest)
    }

    fn plateau(&self) -> f64 {
        self.guideline.dissipator.as_ref().map_or(f64::INFINITY, |given| given.largest)
    }

    /// Whether a load of this size means that a dissipator yields; one that is not known may.
    fn yields(&self, load: f64) -> bool {
        let least = self.guideline.dissipator.as_ref().map_or(f64::INFINITY, |given| given.least());
        let stays = load < least / CAP_TOLERANCE;
        !stays
    }

    /// Whether the dissipators of a rope are used up: then nothing caps its load.
    fn may_be_used_up(&self, rope: usize) -> bool {
        let Some(given) = &self.guideline.dissipator else { return false };
        let stroke = |seen: &Observed| seen.nth(&dissipator::STROKE, rope);
        let left = largest(self.governing, &stroke) < USED_UP * given.stroke;
        !left
    }

    fn ropes(&self, quantity: &Quantity) -> usize {
        self.governing.first().map_or(self.guideline.ropes.len(), |seen| seen.each(quantity).len())
    }

    fn by_rope(&self, quantity: &Quantity, at_plateau: bool) -> Vec<Demand> {
        let of = |rope: usize| self.load_at_a_rope(quantity, rope, rope, at_plateau);
        (0..self.ropes(quantity)).map(of).collect()
    }

    /// Of each anchor of a main rope.
    fn loads_of_anchors(&self, quantity: &Quantity) -> Vec<Demand> {
        let of = |(number, anchor): (usize, &AnchorOf)| match anchor {
            AnchorOf::Main { rope, .. } => self.load_at_a_rope(quantity, number, *rope, true),
            AnchorOf::Retaining { .. } => Demand::default(),
        };
        self.guideline.anchors.iter().enumerate().map(of).collect()
    }

    /// One of the values of a quantity, at a main rope.
    fn load_at_a_rope(&self, quantity: &Quantity, number: usize, rope: usize, at_plateau: bool) -> Demand {
        let is_capped = at_plateau && self.guideline.anchors_capped && !self.may_be_used_up(rope);
        let cap = if is_capped { self.plateau() } else { f64::INFINITY };
        let value = |seen: &Observed| seen.nth(quantity, number);
        let yields = self.yields(largest(self.governing, &|seen: &Observed| seen.nth(&dissipator::TENSION, rope)));
        let excess = if yields { self.excess() } else { 0.0 };
        let most = largest(self.governing, &value);
        let within = most <= cap * CAP_TOLERANCE;
        Demand {
            guideline: self.by_equations(rope, at_plateau),
            simulation: capped(self.governing, &value, cap).map(|upper| self.factor * upper + excess),
            characteristic: capped(&self.seen.characteristic, &value, cap).filter(|_| self.is_factored()),
            cap: (within && cap.is_finite() && !self.governing.is_empty())
                .then_some(self.factor * most.max(cap) + excess),
        }
    }

    /// A rope that the equations put a load on, or one that is not a number.
    fn loaded(&self, rope: usize) -> Option<&RopeLoad> {
        self.guideline.ropes.get(rope).filter(|rope| rope.load > 0.0 || rope.load.is_nan())
    }

    /// Tension by the equations, with the overstrength of a dissipator that yields.
    fn by_equations(&self, rope: usize, at_its_end: bool) -> Option<f64> {
        let rope = self.loaded(rope)?;
        let weak = rope.weak.map_or(0.0, |weak| weak.tension);
        let tension = larger_or_nan(rope.state.tension, weak);
        let excess = if self.yields(tension) { self.excess() } else { 0.0 };
        // Between posts, beyond heads that hold it, a rope may be pulled more than at its ends.
        Some((tension + excess) * if at_its_end { 1.0 } else { rope.over_heads })
    }

    /// Loads of posts, with what their dissipators may pull beyond their plateau.
    fn loads_of_posts(
        &self,
        quantity: &Quantity,
        by_equations: fn(&PostLoad) -> f64,
        over: OverPlateau,
    ) -> Vec<Demand> {
        let retaining = self.guideline.retaining.as_ref();
        let least = retaining.map_or(f64::INFINITY, |given| given.least());
        // Asked so that a tension that is not known may yield.
        let with_more = |load: f64, tension: f64| {
            let stays = tension < least / CAP_TOLERANCE;
            match (over, retaining) {
                (_, None) | (OverPlateau::Stays, _) => load,
                _ if stays => load,
                (OverPlateau::Adds, Some(given)) => load + (self.factors.overstrength - 1.0) * given.largest,
                (OverPlateau::Grows, Some(_)) => load * self.factors.overstrength,
            }
        };
        let of = |(number, post): (usize, &PostLoad)| {
            let value = |seen: &Observed| seen.nth(quantity, number);
            let tension = |seen: &Observed| seen.nth(&posts::RETAINING, number);
            let pulled = largest(self.governing, &tension);
            let simulated =
                spread(self.governing, &value).map(|spread| with_more(self.factor * spread.upper(), pulled));
            Demand {
                guideline: Some(with_more(by_equations(post), post.head.tension)),
                simulation: simulated,
                characteristic: self.characteristic(&value),
                cap: None,
            }
        };
        self.guideline.posts.iter().enumerate().map(of).collect()
    }

    fn strokes_of_posts(&self, quantity: &Quantity) -> Vec<Demand> {
        let stop = self.guideline.retaining.as_ref().map_or(f64::INFINITY, |given| given.stroke);
        let posts = self.guideline.posts.iter().enumerate();
        posts.map(|(number, post)| self.stroke(quantity, number, Some(post.stroke), stop)).collect()
    }

    fn strokes(&self, quantity: &Quantity) -> Vec<Demand> {
        let stop = self.guideline.dissipator.as_ref().map_or(f64::INFINITY, |given| given.stroke);
        let by_equations = |rope: usize| self.loaded(rope).map(|rope| rope.weak.unwrap_or(rope.state).stroke);
        (0..self.ropes(quantity)).map(|rope| self.stroke(quantity, rope, by_equations(rope), stop)).collect()
    }

    /// A stroke, which ends at its stop (m), whatever the scatter says.
    fn stroke(&self, quantity: &Quantity, number: usize, guideline: Option<f64>, stop: f64) -> Demand {
        let value = |seen: &Observed| seen.nth(quantity, number);
        // Asked so that what is not a number stays so.
        let stopped = |stroke: f64| if stroke > stop { stop } else { stroke };
        Demand {
            guideline,
            simulation: spread(self.governing, &value).map(|spread| stopped(spread.upper())),
            characteristic: self.characteristic(&value).map(stopped),
            cap: None,
        }
    }
}
