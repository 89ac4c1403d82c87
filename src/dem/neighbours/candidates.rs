//! Which pairs could touch before the lists are renewed.

use crate::dem::contact::grain_pairs::Members;
use crate::dem::contact::pair_list::Separation;
use crate::dem::contact::ropes::OnRopes;
use crate::dem::contact::surfaces::OnSurfaces;
use crate::dem::neighbours::blocks::Block;
use crate::dem::neighbours::broad_phase::{Box3, BoxTree};
use crate::dem::tables::barrier::Barrier;
use crate::dem::tables::grain_table::GrainTable;
use crate::dem::tables::surfaces::Surface;

/// Box around all members of the grain in `row`, grown by `margin` (m).
pub fn grain_box(grains: &GrainTable, row: usize, margin: f64) -> Box3 {
    let per_grain = grains.shape.members();
    let member_box = |index: usize| {
        let (centre, radius) = grains.sphere(index);
        Box3::around(&centre, radius + margin)
    };
    let first = row * per_grain;
    (first + 1..first + per_grain).fold(member_box(first), |whole, index| Box3::joining(&whole, &member_box(index)))
}

/// Boxes around all rope segments, grown by `margin` (m).
pub fn segment_boxes(barrier: &Barrier, margin: f64) -> Vec<Box3> {
    let grown = |node: u32, reach: f64| Box3::around(&barrier.nodes[node as usize].position, reach);
    (0..barrier.segments.len())
        .map(|index| {
            let reach = barrier.thickness(index as u32) + margin;
            let [a, b] = barrier.segments[index].nodes;
            Box3::joining(&grown(a, reach), &grown(b, reach))
        })
        .collect()
}

/// Files every pair of members nearer than `skin` with the block of the first.
pub fn find_grain_pairs(tree: &mut BoxTree, grains: &GrainTable, skin: f64, blocks: &mut [Block]) {
    let block_size = blocks.first().map_or(1, |block| block.grains.len());
    let per_grain = grains.shape.members() as u32;
    tree.pairs(|a, b| {
        let (a, b) = (a.min(b), a.max(b));
        let block = &mut blocks[a as usize / block_size];
        let same = (b as usize) < block.grains.end;
        for first in a * per_grain..(a + 1) * per_grain {
            for second in b * per_grain..(b + 1) * per_grain {
                let gap = Members(grains).gap([first, second]);
                if gap < skin {
                    let list = if same { &mut block.inner } else { &mut block.border };
                    list.add([first, second], gap);
                }
            }
        }
    });
}

/// Files every pair of member and rope segment nearer than `skin`.
pub fn find_rope_pairs(
    trees: (&BoxTree, &BoxTree),
    barrier: &Barrier,
    grains: &GrainTable,
    skin: f64,
    blocks: &mut [Block],
) {
    let block_size = blocks.first().map_or(1, |block| block.grains.len());
    let per_grain = grains.shape.members();
    let (grain_tree, segments) = trees;
    grain_tree.pairs_with(segments, |row, segment| {
        let list = &mut blocks[row as usize / block_size].ropes.list;
        for index in row as usize * per_grain..(row as usize + 1) * per_grain {
            let gap = OnRopes { grains, barrier }.gap([index as u32, segment]);
            if gap < skin {
                list.add([index as u32, segment], gap);
            }
        }
    });
}

/// Files every pair of the block's members and a surface nearer than `skin`.
pub fn find_surface_pairs(block: &mut Block, grains: &GrainTable, surfaces: &[Surface], skin: f64) {
    let per_grain = grains.shape.members();
    for index in block.grains.start * per_grain..block.grains.end * per_grain {
        for number in 0..surfaces.len() {
            let pair = [index as u32, number as u32];
            let gap = OnSurfaces { grains, surfaces }.gap(pair);
            if gap < skin {
                block.surfaces.add(pair, gap);
            }
        }
    }
}
