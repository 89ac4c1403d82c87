//! Which pairs could touch before the lists are renewed.

use crate::contact::grain_pairs::Members;
use crate::contact::pair_list::{PairList, Separation};
use crate::contact::ropes::OnRopes;
use crate::contact::surfaces::OnFixed;
use crate::neighbours::blocks::Block;
use crate::neighbours::broad_phase::{Box3, BoxTree};
use crate::tables::barrier::Barrier;
use crate::tables::fixed::Fixed;
use crate::tables::grain_rows::GrainRows;

/// Box around all members of the grain in `row`, grown by `margin` (m).
pub fn grain_box(grains: GrainRows, row: usize, margin: f64) -> Box3 {
    let per_grain = grains.shape.members();
    let member_box = |index: usize| {
        let (centre, radius) = grains.sphere(index);
        Box3::around(&centre, radius + margin)
    };
    let first = row * per_grain;
    (first + 1..first + per_grain).fold(member_box(first), |whole, index| Box3::joining(&whole, &member_box(index)))
}

/// Boxes around all lines of the barrier, grown by `margin` (m).
pub fn line_boxes(barrier: &Barrier, margin: f64) -> Vec<Box3> {
    let grown = |node: u32, reach: f64| Box3::around(&barrier.nodes[node as usize].position, reach);
    (0..barrier.lines.len())
        .map(|index| {
            let reach = barrier.thickness(index as u32) + margin;
            let [a, b] = barrier.lines[index].nodes;
            Box3::joining(&grown(a, reach), &grown(b, reach))
        })
        .collect()
}

/// Files every pair of members of one block nearer than `skin`; the boxes of `tree` are those of the block's grains.
pub fn find_inner_pairs(tree: &mut BoxTree, grains: GrainRows, skin: f64, block: &mut Block) {
    let start = block.grains.start as u32;
    tree.pairs(|a, b| add_near(&mut block.inner, grains, [start + a.min(b), start + a.max(b)], skin));
}

/// Files every pair nearer than `skin` of a member of `block` and one of a later block, whose rows begin at `other_start`.
pub fn find_border_pairs(trees: [&BoxTree; 2], other_start: usize, grains: GrainRows, skin: f64, block: &mut Block) {
    let (start, other) = (block.grains.start as u32, other_start as u32);
    trees[0].pairs_with(trees[1], |a, b| add_near(&mut block.border, grains, [start + a, other + b], skin));
}

/// Adds the pairs of members of two grains that are nearer than `skin`.
fn add_near(list: &mut PairList, grains: GrainRows, [a, b]: [u32; 2], skin: f64) {
    let per_grain = grains.shape.members() as u32;
    for first in a * per_grain..(a + 1) * per_grain {
        for second in b * per_grain..(b + 1) * per_grain {
            let gap = Members(grains).gap([first, second]);
            if gap < skin {
                list.add([first, second], gap);
            }
        }
    }
}

/// Files every pair of a member of the block and a line of the barrier nearer than `skin`.
pub fn find_rope_pairs(
    tree: &BoxTree,
    lines: &BoxTree,
    barrier: &Barrier,
    grains: GrainRows,
    skin: f64,
    block: &mut Block,
) {
    let per_grain = grains.shape.members();
    let start = block.grains.start;
    tree.pairs_with(lines, |row, line| {
        let first = (start + row as usize) * per_grain;
        for index in first..first + per_grain {
            let gap = OnRopes { grains, barrier }.gap([index as u32, line]);
            if gap < skin {
                block.ropes.list.add([index as u32, line], gap);
            }
        }
    });
}

/// Files every pair of the block's members and what does not move nearer than `skin`.
pub fn find_fixed_pairs(block: &mut Block, grains: GrainRows, fixed: Fixed, skin: f64) {
    let per_grain = grains.shape.members();
    for index in block.grains.start * per_grain..block.grains.end * per_grain {
        let (centre, radius) = grains.sphere(index);
        fixed.near(&centre, radius + skin, |number| {
            let pair = [index as u32, number];
            let gap = OnFixed { grains, fixed }.gap(pair);
            if gap < skin {
                block.surfaces.add(pair, gap);
            }
        });
    }
}
