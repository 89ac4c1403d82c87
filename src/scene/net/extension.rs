//! Side extensions of the net: strips along the side walls that close the windows which open beside the barrier when its
//! dissipators pay out.
//!
//! A strip goes on from the knots at the side of the net with the same mesh, and lies downstream of the barrier, flat on the side
//! wall. What holds it there, friction on the wall and the deposit, is a small force on each of its knots, towards the place where
//! the knot first lay; a knot that comes back from where it has slipped to is not pulled on (Albaba 2015, section 5.5.2, holds its extensions by small forces too; how large is not printed).

use std::collections::BTreeMap;

use crate::design::SideExtension;
use crate::scene::net::build::Builder;
use dem::Vec3;
use dem::elements::dissipator::Dissipator;
use dem::elements::segment::SegmentKind;
use dem::elements::yield_curve::YieldCurve;

/// Way after which a knot has its whole holding force (m).
const GIVE: f64 = 0.01;

impl Builder<'_> {
    /// Adds a strip on each side, and puts its knots into `wings`, row by row from the net outwards.
    pub(super) fn add_side_extensions(&mut self, extension: &SideExtension) {
        let half_diagonal = self.across(1) - self.across(0);
        let strips = ((extension.length / half_diagonal).round() as usize).max(1);
        let rows = self.grid.row_heights.len();
        self.wings = vec![[Vec::new(), Vec::new()]; rows];
        for side in 0..2 {
            let edge = [0, self.grid.columns][side];
            let mut knots: BTreeMap<(usize, usize), u32> = BTreeMap::new();
            for row in 0..rows {
                if let Some(&knot) = self.knots.get(&(edge, row)) {
                    knots.insert((0, row), knot);
                }
                // The columns are even, so the pattern of knots goes on beyond both sides.
                for strip in (1..=strips).filter(|strip| (strip + row) % 2 == 1) {
                    let place = self.place(side as f64 * self.channel.width, self.grid.row_heights[row]);
                    let place = place + Vec3::x() * (strip as f64 * half_diagonal);
                    let knot = self.add_node(place, false);
                    let pin = self.add_node(place, true);
                    self.barrier.holds.push(Dissipator {
                        nodes: [pin, knot],
                        kind: SegmentKind::Net,
                        rest_length: 0.0,
                        radius: 0.0,
                        stiffness: extension.holding_force / GIVE,
                        plateau: extension.holding_force,
                        curve: YieldCurve::default(),
                        stroke: f64::MAX,
                        used: 0.0,
                    });
                    knots.insert((strip, row), knot);
                    self.wings[row][side].push(knot);
                }
            }
            for (&(strip, row), &knot) in &knots {
                for nearer in [strip.checked_sub(1), Some(strip + 1)].into_iter().flatten() {
                    if let Some(&above) = knots.get(&(nearer, row + 1)) {
                        self.add_line([knot, above], SegmentKind::Net, &self.design.net_rope);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::design::read::read_design;
    use crate::design::{BarrierDesign, BarrierModel, SideExtension};
    use crate::scene::net::build::build;

    #[test]
    fn strips_lie_on_the_side_walls_downstream_and_are_held_knot_by_knot() {
        let design = read_design("x", include_bytes!("../../../designs/site_a.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        for model in [BarrierModel::SlidingRopes, BarrierModel::Cylinders] {
            let bare = build(net, &design.channel, model, 1);
            let extension = Some(SideExtension { length: 2.0, holding_force: 1e3, holding_force_given: true });
            let wide = build(
                &crate::design::FlexibleNet { side_extension: extension, ..(**net).clone() },
                &design.channel,
                model,
                1,
            );
            assert_eq!(bare.screen_rows, bare.rows);
            assert_eq!(wide.rows, bare.rows);
            // Nine strips of 0.21 m with half the knots of 25 rows or so, on both sides.
            let holds = &wide.barrier.holds;
            assert!((150..300).contains(&holds.len()), "{}", holds.len());
            for hold in holds {
                let [pin, knot] = hold.nodes.map(|node| &wide.barrier.nodes[node as usize]);
                assert!(pin.fixed && !knot.fixed && pin.position == knot.position);
                assert!(knot.position.y == 0.0 || knot.position.y == design.channel.width);
                assert!(knot.mass > 0.0 && !wide.barrier.line_ends.at(hold.nodes[1]).is_empty());
            }
            let strips: usize =
                wide.screen_rows.iter().zip(&wide.rows).map(|(wide, rows)| wide.len() - rows.len()).sum();
            assert_eq!(strips, holds.len());
            // From the far end of one strip to that of the other.
            let across = |node: &u32| wide.barrier.nodes[*node as usize].position.y;
            assert!(wide.screen_rows.iter().all(|row| row.is_sorted_by(|a, b| across(a) <= across(b))));
        }
    }
}
