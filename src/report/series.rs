//! `histories.csv` and `histories.parquet`: the time series, one row per sample, units in the names of the columns.

use parquet::errors::ParquetError;

use crate::report::columns::{self, Column};

use dem::recorders::CHANNELS;
use dem::recorders::channels::{Channel, Rows};
use dem::recorders::histories::Histories;

/// Columns by name, each with its values.
pub fn numbers(histories: &Histories) -> Vec<(String, Column)> {
    let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
    let mut add = |name: String, values: Vec<f64>| columns.push((name, values));
    add("time_s".into(), histories.time.clone());
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        add(format!("force_{name}_n"), histories.force.iter().map(|force| force[axis]).collect());
    }
    add("force_x_largest_of_a_step_n".into(), histories.force_instant.clone());
    add("force_x_scatter_of_steps_n".into(), histories.force_scatter.clone());
    for channel in CHANNELS {
        let Channel { name, unit, rows } = channel;
        let with_unit = |name: String| if unit.is_empty() { name } else { format!("{name}_{unit}") };
        match rows {
            Rows::One => add(with_unit(name.to_string()), histories.barrier.series(channel).to_vec()),
            Rows::EachRope | Rows::EachSegment | Rows::EachPost | Rows::EachAnchor => {
                for (index, row) in histories.barrier.rows(channel).iter().enumerate() {
                    add(with_unit(format!("{name}_{}", index + 1)), row.clone());
                }
            }
        }
    }
    add("velocity_mean_x_m_s".into(), histories.velocity.iter().map(|velocity| velocity[0]).collect());
    add("velocity_mean_z_m_s".into(), histories.velocity.iter().map(|velocity| velocity[1]).collect());
    add("push_at_rest_n".into(), histories.push_at_rest.clone());
    for (state, name) in ["at_rest", "moving"].into_iter().enumerate() {
        add(
            format!("touch_of_grains_{name}_n"),
            histories.pushes_by_state.iter().map(|pushes| pushes[state]).collect(),
        );
    }
    add("deposit_at_rest_depth_m".into(), histories.dead_depth.clone());
    add("dead_share".into(), histories.dead.clone());
    add("moving_share".into(), histories.moving.clone());
    for (index, way) in ["through", "under", "beside", "over"].into_iter().enumerate() {
        add(format!("lost_{way}_share"), histories.lost.iter().map(|lost| lost[index]).collect());
    }
    let incoming = &histories.incoming;
    add("incoming_thickness_m".into(), incoming.iter().map(|gauge| gauge.thickness).collect());
    add("incoming_depth_m".into(), incoming.iter().map(|gauge| gauge.depth).collect());
    add("incoming_velocity_m_s".into(), incoming.iter().map(|gauge| gauge.velocity).collect());
    add("approaching_thickness_m".into(), histories.approaching.iter().map(|gauge| gauge.thickness).collect());
    add("approaching_velocity_m_s".into(), histories.approaching.iter().map(|gauge| gauge.velocity).collect());
    add("entered_mass_kg".into(), histories.entered.iter().map(|[mass, ..]| *mass).collect());
    add("entered_momentum_kg_m_s".into(), histories.entered.iter().map(|[_, momentum, _]| *momentum).collect());
    add("front_m".into(), histories.front.clone());
    add("deposit_depth_m".into(), histories.barrier_depth.clone());
    add("kinetic_j".into(), histories.ledger.iter().map(|ledger| ledger.kinetic).collect());
    add("potential_j".into(), histories.ledger.iter().map(|ledger| ledger.potential).collect());
    add("dissipated_j".into(), histories.ledger.iter().map(|ledger| ledger.dissipated()).collect());
    add("total_j".into(), histories.ledger.iter().map(|ledger| ledger.total()).collect());
    // What the barrier does not have is left out; a run without a sample has all names and no row.
    columns.retain(|(_, values)| !values.is_empty() || histories.time.is_empty());
    for (_, values) in &mut columns {
        values.resize(histories.time.len(), 0.0);
    }
    columns.into_iter().map(|(name, values)| (name, Column::Numbers(values))).collect()
}

/// The text of `histories.csv`.
pub fn csv(histories: &Histories) -> String {
    columns::csv(&numbers(histories))
}

/// The bytes of `histories.parquet`: the same columns.
pub fn parquet(histories: &Histories) -> Result<Vec<u8>, ParquetError> {
    columns::parquet("histories", &numbers(histories))
}
