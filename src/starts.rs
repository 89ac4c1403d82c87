//! Several starts of one design: run side by side, and what they say together.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// Runs jobs side by side on `workers` cores, each on one thread; results in the order of the jobs. A job that panics panics here.
pub fn side_by_side<T: Send>(workers: usize, count: usize, job: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = std::sync::atomic::AtomicUsize::new(0);
    let work = || {
        // Without a pool of its own a job would use that of the whole program, which changes the time it takes alone.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            if index >= count {
                return done;
            }
            let result = pool.as_ref().map_or_else(|_| job(index), |pool| pool.install(|| job(index)));
            done.push((index, result));
        }
    };
    let joined = |thread: std::thread::ScopedJoinHandle<'_, Vec<(usize, T)>>| {
        thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    };
    let mut results: Vec<(usize, T)> = std::thread::scope(|scope| {
        // Where the system gives no more threads, those that are there do the work, or this one.
        let start = |_| std::thread::Builder::new().spawn_scoped(scope, work).ok();
        let threads: Vec<_> = (0..workers.min(count).max(1)).filter_map(start).collect();
        if threads.is_empty() {
            return work();
        }
        threads.into_iter().flat_map(joined).collect()
    });
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

/// A quantity over several starts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    pub mean: f64,
    /// Standard deviation; 0 for a single start.
    pub deviation: f64,
    pub starts: usize,
}

impl Spread {
    /// NaN if any value is.
    pub fn of(values: &[f64]) -> Self {
        let starts = values.len();
        let mean = values.iter().sum::<f64>() / starts as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = if starts > 1 { (squares / (starts - 1) as f64).sqrt() } else { 0.0 };
        Self { mean, deviation, starts }
    }

    /// The value that the next start exceeds with a probability of 5 %: mean + k_n s.
    pub fn upper(&self) -> f64 {
        self.mean + self.margin()
    }

    /// The value that the next start falls below with a probability of 5 %: mean − k_n s.
    pub fn lower(&self) -> f64 {
        self.mean - self.margin()
    }

    fn margin(&self) -> f64 {
        if self.deviation > 0.0 { k_n(self.starts) * self.deviation } else { 0.0 * self.deviation }
    }
}

const ROUNDED: f64 = 1e9;

/// k_n = t_0.95(n − 1) √(1 + 1/n): a normal quantity whose scatter is known from n values alone (EN 1990:2002, Annex D,
/// table D.1, "V_X unknown"). Rounded to ten digits: the distribution goes through the system's mathematical library, whose last bits
/// differ between machines.
pub fn k_n(starts: usize) -> f64 {
    let count = starts as f64;
    match StudentsT::new(0.0, 1.0, count - 1.0) {
        Ok(student) if starts > 1 => {
            (student.inverse_cdf(0.95) * (1.0 + 1.0 / count).sqrt() * ROUNDED).round() / ROUNDED
        }
        _ => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn k_n_is_that_of_the_code() {
        for (starts, expected) in
            [(3, 3.37), (4, 2.63), (5, 2.33), (6, 2.18), (8, 2.00), (10, 1.92), (20, 1.76), (30, 1.73)]
        {
            assert_relative_eq!(k_n(starts), expected, epsilon = 1.2e-2);
        }
    }

    #[test]
    fn a_single_start_has_no_scatter_and_nan_stays() {
        assert_eq!(Spread::of(&[3.0]).upper(), 3.0);
        assert_eq!(Spread::of(&[2.0, 2.0, 2.0]).lower(), 2.0);
        assert!(Spread::of(&[1.0, f64::NAN]).upper().is_nan());
        let spread = Spread::of(&[1.0, 2.0, 3.0]);
        assert_relative_eq!(spread.upper() - 2.0, 2.0 - spread.lower());
        assert_relative_eq!(spread.upper(), 2.0 + k_n(3), max_relative = 1e-12);
    }

    #[test]
    fn jobs_come_back_in_order() {
        assert_eq!(side_by_side(3, 7, |index| index * index), [0, 1, 4, 9, 16, 25, 36]);
    }
}
