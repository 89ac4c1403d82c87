//! What is recorded of the barrier: series by their names, so that one more leaves the others, and files that were written before, alone.

use serde::{Deserialize, Serialize};

/// What one series is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rows {
    /// The barrier as a whole.
    One,
    /// Each main rope, from the lowest to the highest.
    EachRope,
    /// Each post of a net, from one bank to the other.
    EachPost,
    /// Each anchor of a net, in the order in which its model lists them.
    EachAnchor,
    /// Each segment of a rigid wall, from the lowest to the highest.
    EachSegment,
}

/// A series that a recorder of the barrier writes.
#[derive(Debug)]
pub struct Channel {
    pub name: &'static str,
    /// SI unit as it stands at the end of a column's name; empty for a number.
    pub unit: &'static str,
    pub rows: Rows,
}

/// Series by channel, a row for each thing that a channel is of, a value for each sample.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Channels(Vec<(String, Vec<Vec<f64>>)>);

impl Channels {
    /// The rows of a channel; none where the barrier has nothing that it is of.
    pub fn rows(&self, channel: &Channel) -> &[Vec<f64>] {
        self.0.iter().find(|(name, _)| name == channel.name).map_or(&[], |(_, rows)| rows)
    }

    /// The series of a channel that is of the barrier as a whole; empty where it has none.
    pub fn series(&self, channel: &Channel) -> &[f64] {
        self.rows(channel).first().map_or(&[], Vec::as_slice)
    }

    /// Takes in the values of one sample, one for each row.
    pub fn push(&mut self, channel: &Channel, values: &[f64]) {
        if values.is_empty() {
            return;
        }
        let rows = self.rows_of(channel);
        rows.resize(values.len(), Vec::new());
        rows.iter_mut().zip(values).for_each(|(row, value)| row.push(*value));
    }

    /// The same with other rows for one channel.
    pub fn with(mut self, channel: &Channel, rows: Vec<Vec<f64>>) -> Self {
        *self.rows_of(channel) = rows;
        self
    }

    /// Of some samples alone.
    pub fn part(&self, samples: &std::ops::Range<usize>) -> Self {
        let cut = |row: &Vec<f64>| row.get(samples.clone()).map_or(Vec::new(), <[f64]>::to_vec);
        Self(self.0.iter().map(|(name, rows)| (name.clone(), rows.iter().map(cut).collect())).collect())
    }

    /// Whether every row has a value for each of so many samples, or none, and the channels of each of these groups as many rows as each other.
    pub fn is_whole(&self, samples: usize, alike: &[Vec<&Channel>]) -> bool {
        let rows = self.0.iter().flat_map(|(_, rows)| rows);
        let even = |group: &Vec<&Channel>| {
            let counts = group.iter().map(|channel| self.rows(channel).len()).filter(|count| *count > 0);
            let counts: Vec<usize> = counts.collect();
            counts.windows(2).all(|two| two[0] == two[1])
        };
        rows.map(Vec::len).all(|count| count == 0 || count == samples) && alike.iter().all(even)
    }

    fn rows_of(&mut self, channel: &Channel) -> &mut Vec<Vec<f64>> {
        let known = self.0.iter().position(|(name, _)| name == channel.name);
        let place = known.unwrap_or_else(|| {
            self.0.push((channel.name.to_string(), Vec::new()));
            self.0.len() - 1
        });
        &mut self.0[place].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: Channel = Channel { name: "whole", unit: "n", rows: Rows::One };
    const MEAN: Channel = Channel { name: "mean", unit: "n", rows: Rows::EachRope };
    const LOAD: Channel = Channel { name: "load", unit: "n", rows: Rows::EachRope };

    #[test]
    fn series_are_told_apart_by_their_names_and_uneven_ones_are_noticed() {
        let mut channels = Channels::default();
        for sample in [1.0, 2.0] {
            channels.push(&WHOLE, &[sample]);
            channels.push(&MEAN, &[sample, 3.0 * sample]);
            channels.push(&LOAD, &[]);
        }
        assert_eq!(channels.series(&WHOLE), [1.0, 2.0]);
        assert_eq!(channels.rows(&MEAN), [vec![1.0, 2.0], vec![3.0, 6.0]]);
        assert!(channels.rows(&LOAD).is_empty());
        let of_ropes = [vec![&MEAN, &LOAD]];
        assert!(channels.is_whole(2, &of_ropes) && !channels.is_whole(3, &of_ropes));
        assert!(!channels.clone().with(&LOAD, vec![vec![0.0; 2]; 3]).is_whole(2, &of_ropes));
        assert!(channels.with(&LOAD, vec![vec![0.0; 2]; 2]).is_whole(2, &of_ropes));
    }
}
