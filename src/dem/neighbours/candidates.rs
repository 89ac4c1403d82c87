//! Which pairs could touch before the lists are renewed.

use crate::dem::geometry::point_segment::nearest_on_segment;
use crate::dem::neighbours::blocks::Block;
use crate::dem::neighbours::broad_phase::{Box3, BoxTree};
use crate::dem::tables::barrier::Barrier;
use crate::dem::tables::grains::Member;
use crate::dem::tables::surfaces::Surface;

/// Box around all members of one grain, grown by `margin` (m).
pub fn grain_box(members: &[Member], margin: f64) -> Box3 {
    let mut whole = Box3::around(&members[0].centre(), members[0].radius() + margin);
    for member in &members[1..] {
        whole = Box3::joining(&whole, &Box3::around(&member.centre(), member.radius() + margin));
    }
    whole
}

/// Boxes around all rope segments, grown by half of `skin` (m).
pub fn segment_boxes(barrier: &Barrier, skin: f64) -> Vec<Box3> {
    let grown = |node: u32, reach: f64| Box3::around(&barrier.nodes[node as usize].position, reach);
    (0..barrier.segments.len())
        .map(|index| {
            let reach = thickness(barrier, index) + 0.5 * skin;
            let [a, b] = barrier.segments[index].nodes;
            Box3::joining(&grown(a, reach), &grown(b, reach))
        })
        .collect()
}

/// Radius with which grains may touch a segment or either of its nodes (m).
fn thickness(barrier: &Barrier, segment: usize) -> f64 {
    let segment = &barrier.segments[segment];
    let ends = segment.nodes.map(|node| barrier.nodes[node as usize].radius);
    segment.radius.max(ends[0]).max(ends[1])
}

/// Files every pair of members nearer than `skin` into the block, or the two blocks, that own them.
pub fn find_grain_pairs(tree: &mut BoxTree, members: &[Member], per_grain: usize, skin: f64, blocks: &mut [Block]) {
    let block_size = blocks.first().map_or(1, |block| block.members.len());
    tree.pairs(|a, b| {
        let (a, b) = (a.min(b) as usize, a.max(b) as usize);
        for first in a * per_grain..(a + 1) * per_grain {
            for second in b * per_grain..(b + 1) * per_grain {
                if within(&members[first], &members[second], skin) {
                    file_pair(blocks, block_size, first, second);
                }
            }
        }
    });
}

fn within(a: &Member, b: &Member, skin: f64) -> bool {
    let reach = a.place[3] + b.place[3] + skin;
    (a.centre() - b.centre()).norm_squared() < reach * reach
}

fn file_pair(blocks: &mut [Block], block_size: usize, first: usize, second: usize) {
    let (home, other) = (first / block_size, second / block_size);
    if home == other {
        blocks[home].inner.push([first as u32, second as u32]);
    } else {
        blocks[home].border.push([first as u32, second as u32]);
        blocks[other].border.push([second as u32, first as u32]);
    }
}

/// Files every pair of member and rope segment nearer than `skin`.
pub fn find_rope_pairs(
    trees: (&BoxTree, &BoxTree),
    barrier: &Barrier,
    members: &[Member],
    per_grain: usize,
    skin: f64,
    blocks: &mut [Block],
) {
    let block_size = blocks.first().map_or(1, |block| block.members.len());
    let (grains, segments) = trees;
    grains.pairs_with(segments, |grain, segment| {
        let rope = thickness(barrier, segment as usize);
        let [a, b] = barrier.segments[segment as usize].nodes.map(|node| &barrier.nodes[node as usize].position);
        let first = grain as usize * per_grain;
        for (index, member) in members.iter().enumerate().skip(first).take(per_grain) {
            let centre = member.centre();
            let reach = member.radius() + rope + skin;
            if (nearest_on_segment(&centre, a, b).point - centre).norm_squared() < reach * reach {
                blocks[index / block_size].ropes.list.push([index as u32, segment]);
            }
        }
    });
}

/// Files every pair of the block's members and a surface nearer than `skin`.
pub fn find_surface_pairs(block: &mut Block, members: &[Member], surfaces: &[Surface], skin: f64) {
    for index in block.members.clone() {
        let member = &members[index];
        for (number, surface) in surfaces.iter().enumerate() {
            if surface.height_above(&member.centre()).abs() < member.radius() + skin {
                block.surfaces.push([index as u32, number as u32]);
            }
        }
    }
}
