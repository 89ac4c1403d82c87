//! Which pairs could touch before the lists are renewed.

use crate::Vec3;
use crate::contact::pair_list::{PairList, Separation};
use crate::contact::ropes::OnRopes;
use crate::contact::surfaces::OnFixed;
use crate::neighbours::blocks::Block;
use crate::neighbours::broad_phase::{Box3, BoxTree};
use crate::neighbours::reach::Reach;
use crate::tables::barrier::Barrier;
use crate::tables::fixed::Fixed;
use crate::tables::grain_rows::GrainRows;
use crate::workers;

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
            let reach = barrier.lines[index].thickness + margin;
            let [a, b] = barrier.lines[index].nodes;
            Box3::joining(&grown(a, reach), &grown(b, reach))
        })
        .collect()
}

/// Grains with what is known of each when lists are made.
#[derive(Clone, Copy)]
pub struct Sought<'a> {
    pub grains: GrainRows<'a>,
    /// Centres of all members (m).
    pub members: &'a [Vec3],
    pub reaches: &'a [Reach],
}

/// Files every pair of members of one block in reach of each other; the boxes of `tree` are those of the block's grains.
pub fn find_inner_pairs(tree: &mut BoxTree, sought: &Sought, block: &mut Block) {
    let start = block.grains.start as u32;
    tree.pairs(|a, b| add_near(&mut block.inner, sought, [start + a.min(b), start + a.max(b)]));
}

/// Files every pair in reach of each other of a member of `block` and one of a later block, whose rows begin at `other_start`.
pub fn find_border_pairs(trees: [&BoxTree; 2], other_start: usize, sought: &Sought, block: &mut Block) {
    let (start, other) = (block.grains.start as u32, other_start as u32);
    trees[0].pairs_with(trees[1], |a, b| add_near(&mut block.border, sought, [start + a, other + b]));
}

/// Adds the pairs of members of two grains that are in reach of each other.
fn add_near(list: &mut PairList, sought: &Sought, [a, b]: [u32; 2]) {
    let Sought { grains, members, reaches } = *sought;
    let per_grain = grains.shape.members() as u32;
    let touching = grains.place(a as usize).fourth() + grains.place(b as usize).fourth();
    let reach = touching + reaches[a as usize].reach + reaches[b as usize].reach;
    for first in a * per_grain..(a + 1) * per_grain {
        for second in b * per_grain..(b + 1) * per_grain {
            let square = (members[second as usize] - members[first as usize]).norm_squared();
            if square < reach * reach {
                list.add([first, second], square.sqrt() - touching);
            }
        }
    }
}

/// Files every pair of a member of the block and a line of the barrier within its reach.
pub fn find_rope_pairs(
    tree: &BoxTree,
    lines: &BoxTree,
    barrier: &Barrier,
    Sought { grains, reaches, .. }: Sought,
    block: &mut Block,
) {
    let per_grain = grains.shape.members();
    let start = block.grains.start;
    tree.pairs_with(lines, |row, line| {
        let first = (start + row as usize) * per_grain;
        for index in first..first + per_grain {
            let gap = OnRopes { grains, barrier }.gap([index as u32, line]);
            if gap < reaches[index / per_grain].fixed {
                block.ropes.list.add([index as u32, line], gap);
            }
        }
    });
}

/// By how much the boxes of lines must be grown to meet those of all grains that have a line within their reach (m).
pub fn margin_of_lines(barrier: &Barrier, Sought { grains, members, reaches }: Sought) -> f64 {
    let boxes = line_boxes(barrier, 0.0);
    let Some(whole) = boxes.into_iter().reduce(|a, b| Box3::joining(&a, &b)) else { return 0.0 };
    let per_grain = grains.shape.members();
    let margins = workers::map(members.chunks(MEMBERS_IN_PART), |part, members| {
        let mut margin = 0.0_f64;
        for (index, centre) in (part * MEMBERS_IN_PART..).zip(members) {
            let Reach { reach, fixed, .. } = reaches[index / per_grain];
            let to_it = Box3::around(centre, grains.place(index / per_grain).fourth() + fixed);
            if to_it.meets(&whole) {
                margin = margin.max(fixed - reach);
            }
        }
        margin
    });
    margins.into_iter().fold(0.0, f64::max)
}

/// Members that are looked at in one go.
const MEMBERS_IN_PART: usize = 4096;

/// Files every pair of the block's members and what does not move within their reach.
pub fn find_fixed_pairs(block: &mut Block, Sought { grains, reaches, .. }: Sought, fixed: Fixed) {
    let per_grain = grains.shape.members();
    for index in block.grains.start * per_grain..block.grains.end * per_grain {
        let (centre, radius) = grains.sphere(index);
        let reach = reaches[index / per_grain].fixed;
        fixed.near(&centre, radius + reach, |number| {
            let pair = [index as u32, number];
            let gap = OnFixed { grains, fixed }.gap(pair);
            if gap < reach {
                block.surfaces.add(pair, gap);
            }
        });
    }
}
