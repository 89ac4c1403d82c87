//! Distributions of inputs, each as the value at a standard normal number: x = F⁻¹(Φ(u)).

use std::f64::consts::PI;

use crate::reliability::normal::{cumulative, density, quantile};

/// Euler's constant.
const GAMMA: f64 = 0.577_215_664_901_532_9;

#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    Normal {
        mean: f64,
        deviation: f64,
    },
    /// By its own mean and standard deviation, not those of its logarithm.
    Lognormal {
        mean: f64,
        deviation: f64,
    },
    Uniform {
        from: f64,
        to: f64,
    },
    Triangular {
        from: f64,
        mode: f64,
        to: f64,
    },
    /// Of largest values.
    Gumbel {
        mean: f64,
        deviation: f64,
    },
    /// Rising values with the probability that each is not exceeded, from 0 to 1; straight between them.
    Table(Vec<[f64; 2]>),
}

/// A distribution within bounds: what lies outside is cut off, and the rest grows to a probability of 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounded {
    pub of: Distribution,
    pub least: Option<f64>,
    pub most: Option<f64>,
}

/// A probability p with 1 − p, neither of which is lost where it is small.
#[derive(Clone, Copy)]
struct Share {
    below: f64,
    above: f64,
}

impl Distribution {
    /// What is wrong with its numbers.
    pub fn wrong(&self) -> Option<&'static str> {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        match self {
            Self::Normal { mean, deviation } | Self::Gumbel { mean, deviation } => {
                (!finite(&[*mean, *deviation]) || *deviation <= 0.0).then_some("a standard deviation above 0")
            }
            Self::Lognormal { mean, deviation } => (!finite(&[*mean, *deviation]) || *deviation <= 0.0 || *mean <= 0.0)
                .then_some("a mean and a standard deviation above 0"),
            Self::Uniform { from, to } => (!finite(&[*from, *to]) || from >= to).then_some("from below to"),
            Self::Triangular { from, mode, to } => {
                (!finite(&[*from, *mode, *to]) || from >= to || mode < from || mode > to)
                    .then_some("from below to, and the mode between them")
            }
            Self::Table(rows) => {
                let rising = rows.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] <= pair[1][1]);
                let ends = rows.len() >= 2 && rows[0][1] == 0.0 && rows[rows.len() - 1][1] == 1.0;
                (!rising || !ends || !finite(&rows.concat()))
                    .then_some("two rows at least, rising values, and cumulative probabilities that rise from 0 to 1")
            }
        }
    }

    /// F(x).
    fn cumulative(&self, x: f64) -> Share {
        let score = |u: f64| Share { below: cumulative(u), above: cumulative(-u) };
        let share = |below: f64| {
            let below = below.clamp(0.0, 1.0);
            Share { below, above: 1.0 - below }
        };
        match self {
            Self::Normal { mean, deviation } => score((x - mean) / deviation),
            Self::Lognormal { .. } if x <= 0.0 => share(0.0),
            Self::Lognormal { mean, deviation } => {
                let [location, scale] = of_the_logarithm(*mean, *deviation);
                score((libm::log(x) - location) / scale)
            }
            Self::Uniform { from, to } => share((x - from) / (to - from)),
            Self::Triangular { from, mode, to } => {
                if x <= *from {
                    share(0.0)
                } else if x >= *to {
                    share(1.0)
                } else if x <= *mode {
                    share((x - from).powi(2) / ((to - from) * (mode - from)))
                } else {
                    let above = (to - x).powi(2) / ((to - from) * (to - mode));
                    Share { below: 1.0 - above, above }
                }
            }
            Self::Gumbel { mean, deviation } => {
                let [location, scale] = of_largest(*mean, *deviation);
                let rate = libm::exp(-(x - location) / scale);
                Share { below: libm::exp(-rate), above: -libm::expm1(-rate) }
            }
            Self::Table(rows) => {
                let above = rows.iter().position(|row| row[0] >= x);
                match above {
                    None => share(1.0),
                    Some(0) => share(0.0),
                    Some(place) => {
                        let [[x0, p0], [x1, p1]] = [rows[place - 1], rows[place]];
                        share(p0 + (p1 - p0) * (x - x0) / (x1 - x0))
                    }
                }
            }
        }
    }

    /// F⁻¹ of a share.
    fn at_share(&self, Share { below, above }: Share) -> f64 {
        // From the nearer tail.
        let score = || if below <= above { quantile(below) } else { -quantile(above) };
        match self {
            Self::Normal { mean, deviation } => mean + deviation * score(),
            Self::Lognormal { mean, deviation } => {
                let [location, scale] = of_the_logarithm(*mean, *deviation);
                libm::exp(location + scale * score())
            }
            Self::Uniform { from, to } => {
                if below <= above {
                    from + below * (to - from)
                } else {
                    to - above * (to - from)
                }
            }
            Self::Triangular { from, mode, to } => {
                if below <= (mode - from) / (to - from) {
                    from + (below * (to - from) * (mode - from)).sqrt()
                } else {
                    to - (above * (to - from) * (to - mode)).sqrt()
                }
            }
            Self::Gumbel { mean, deviation } => {
                let [location, scale] = of_largest(*mean, *deviation);
                let rate = if above < 0.5 { -libm::log1p(-above) } else { -libm::log(below) };
                location - scale * libm::log(rate)
            }
            Self::Table(rows) => {
                let place = rows.iter().position(|row| row[1] >= below).unwrap_or(rows.len() - 1).max(1);
                let [[x0, p0], [x1, p1]] = [rows[place - 1], rows[place]];
                if p1 > p0 { x0 + (x1 - x0) * ((below - p0) / (p1 - p0)).clamp(0.0, 1.0) } else { x1 }
            }
        }
    }
}

/// Mean and standard deviation of the logarithm.
fn of_the_logarithm(mean: f64, deviation: f64) -> [f64; 2] {
    let variance = libm::log1p((deviation / mean).powi(2));
    [libm::log(mean) - 0.5 * variance, variance.sqrt()]
}

/// Location and scale of a Gumbel distribution of largest values.
fn of_largest(mean: f64, deviation: f64) -> [f64; 2] {
    let scale = deviation * 6.0_f64.sqrt() / PI;
    [mean - GAMMA * scale, scale]
}

impl Bounded {
    /// What is wrong with its numbers.
    pub fn wrong(&self) -> Option<&'static str> {
        let least = self.least.unwrap_or(f64::NEG_INFINITY);
        let most = self.most.unwrap_or(f64::INFINITY);
        self.of.wrong().or_else(|| {
            // Where next to nothing lies between the bounds, what is left of the digits tells nothing.
            let between = least < most && self.kept(least, most) > 1e-3;
            (!between).then_some("bounds that leave a thousandth of the distribution at least")
        })
    }

    /// Share of the distribution that the bounds cut off.
    pub fn cut(&self) -> f64 {
        let below = self.least.map_or(0.0, |least| self.of.cumulative(least).below);
        let above = self.most.map_or(0.0, |most| self.of.cumulative(most).above);
        below + above
    }

    fn kept(&self, least: f64, most: f64) -> f64 {
        self.of.cumulative(most).below - self.of.cumulative(least).below
    }

    /// The value at a standard normal number.
    pub fn at(&self, u: f64) -> f64 {
        let share = Share { below: cumulative(u), above: cumulative(-u) };
        match (self.least, self.most) {
            (None, None) => match &self.of {
                // Without the way over Φ and back.
                Distribution::Normal { mean, deviation } => mean + deviation * u,
                Distribution::Lognormal { mean, deviation } => {
                    let [location, scale] = of_the_logarithm(*mean, *deviation);
                    libm::exp(location + scale * u)
                }
                of => of.at_share(share),
            },
            (least, most) => {
                let low = least.map_or(Share { below: 0.0, above: 1.0 }, |least| self.of.cumulative(least));
                let high = most.map_or(Share { below: 1.0, above: 0.0 }, |most| self.of.cumulative(most));
                let below = low.below * share.above + high.below * share.below;
                let above = low.above * share.above + high.above * share.below;
                let value = self.of.at_share(Share { below, above });
                value.clamp(least.unwrap_or(f64::NEG_INFINITY), most.unwrap_or(f64::INFINITY))
            }
        }
    }

    /// The standard normal number of a value; infinite where the value never comes.
    pub fn score(&self, x: f64) -> f64 {
        let low = self.least.map_or(0.0, |least| self.of.cumulative(least).below);
        let cut = self.most.map_or(0.0, |most| self.of.cumulative(most).above);
        let Share { below, above } = self.of.cumulative(x);
        let kept = 1.0 - low - cut;
        let [below, above] = [(below - low) / kept, (above - cut) / kept];
        if below <= above { quantile(below.max(0.0)) } else { -quantile(above.max(0.0)) }
    }

    /// Mean and standard deviation, by the midpoint rule over u from −8 to 8.
    pub fn moments(&self) -> [f64; 2] {
        let steps = 4000;
        let weigh = |of: &dyn Fn(f64) -> f64| {
            let step = 16.0 / f64::from(steps);
            (0..steps)
                .map(|number| {
                    let u = -8.0 + (f64::from(number) + 0.5) * step;
                    step * density(u) * of(self.at(u))
                })
                .sum::<f64>()
        };
        let mean = weigh(&|x| x);
        [mean, weigh(&|x| (x - mean).powi(2)).sqrt()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn free(of: Distribution) -> Bounded {
        Bounded { of, least: None, most: None }
    }

    fn all() -> Vec<Distribution> {
        vec![
            Distribution::Normal { mean: 3.0, deviation: 0.5 },
            Distribution::Lognormal { mean: 3.0, deviation: 0.5 },
            Distribution::Uniform { from: 3.0 - 0.5 * 3.0_f64.sqrt(), to: 3.0 + 0.5 * 3.0_f64.sqrt() },
            Distribution::Gumbel { mean: 3.0, deviation: 0.5 },
        ]
    }

    #[test]
    fn each_has_the_mean_and_the_deviation_it_is_given() {
        for of in all() {
            let [mean, deviation] = free(of.clone()).moments();
            assert_relative_eq!(mean, 3.0, max_relative = 1e-4);
            assert_relative_eq!(deviation, 0.5, max_relative = 2e-3);
        }
        // Triangular: mean (a + b + c)/3, variance (a² + b² + c² − ab − ac − bc)/18.
        let [mean, deviation] = free(Distribution::Triangular { from: 1.0, mode: 2.0, to: 5.0 }).moments();
        assert_relative_eq!(mean, 8.0 / 3.0, max_relative = 1e-5);
        assert_relative_eq!(deviation, (13.0 / 18.0_f64).sqrt(), max_relative = 1e-4);
        let table = free(Distribution::Table(vec![[0.0, 0.0], [1.0, 0.5], [3.0, 1.0]]));
        assert_relative_eq!(table.moments()[0], 0.5 * 0.5 + 0.5 * 2.0, max_relative = 1e-5);
    }

    #[test]
    fn the_value_at_a_number_has_that_numbers_probability() {
        let mut each = all();
        each.push(Distribution::Triangular { from: 1.0, mode: 2.0, to: 5.0 });
        each.push(Distribution::Table(vec![[0.0, 0.0], [1.0, 0.5], [3.0, 1.0]]));
        for of in each {
            for u in [-4.0, -1.0, 0.0, 0.7, 3.0, 6.0] {
                let found = of.cumulative(free(of.clone()).at(u));
                assert_relative_eq!(found.below, cumulative(u), max_relative = 1e-8);
                if !matches!(of, Distribution::Table(_) | Distribution::Uniform { .. }) {
                    assert_relative_eq!(found.above, cumulative(-u), max_relative = 1e-7);
                }
            }
        }
    }

    #[test]
    fn what_is_cut_off_never_comes_and_the_rest_keeps_its_shape() {
        let of = Distribution::Normal { mean: 3.0, deviation: 0.5 };
        let cut = Bounded { of: of.clone(), least: Some(2.5), most: None };
        assert!(cut.at(-30.0) >= 2.5);
        // The median of what is above one standard deviation below the mean: Φ⁻¹(Φ(−1) + (1 − Φ(−1))/2).
        assert_relative_eq!(cut.at(0.0), 3.0 + 0.5 * 0.200_174, max_relative = 1e-6);
        let both = Bounded { of, least: Some(2.5), most: Some(3.5) };
        assert_relative_eq!(both.at(0.0), 3.0, max_relative = 1e-12);
        assert!(both.at(9.0) <= 3.5 && both.at(-9.0) >= 2.5);
        for u in [-3.0, -0.5, 2.0] {
            assert_relative_eq!(both.score(both.at(u)), u, max_relative = 1e-6);
            assert_relative_eq!(cut.score(cut.at(u)), u, max_relative = 1e-6);
        }
        assert!(both.score(2.4) == f64::NEG_INFINITY && both.score(3.6) == f64::INFINITY);
    }

    #[test]
    fn numbers_that_make_no_distribution_are_refused() {
        for of in [
            Distribution::Normal { mean: 1.0, deviation: 0.0 },
            Distribution::Lognormal { mean: -1.0, deviation: 1.0 },
            Distribution::Uniform { from: 2.0, to: 1.0 },
            Distribution::Triangular { from: 1.0, mode: 9.0, to: 2.0 },
            Distribution::Gumbel { mean: f64::NAN, deviation: 1.0 },
            Distribution::Table(vec![[0.0, 0.0], [1.0, 0.9]]),
            Distribution::Table(vec![[0.0, 0.0], [0.0, 1.0]]),
        ] {
            assert!(free(of.clone()).wrong().is_some(), "{of:?}");
        }
        let of = Distribution::Normal { mean: 0.0, deviation: 1.0 };
        assert!(Bounded { of: of.clone(), least: Some(9.0), most: None }.wrong().is_some());
        assert!(Bounded { of, least: Some(1.0), most: Some(0.0) }.wrong().is_some());
    }
}
