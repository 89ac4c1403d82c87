//! Renewal of the candidate lists, with the memory of touching pairs carried over.

use rayon::prelude::*;

use crate::dem::Vec3;
use crate::dem::contact::candidates::CandidateList;
use crate::dem::neighbours::blocks::{Block, make_blocks};
use crate::dem::neighbours::broad_phase::{Box3, BoxTree};
use crate::dem::neighbours::candidates::{
    find_grain_pairs, find_rope_pairs, find_surface_pairs, grain_box, segment_boxes,
};
use crate::dem::neighbours::drift::{Drift, Reference, Strayed};
use crate::dem::neighbours::memory_rows::MemoryRows;
use crate::dem::neighbours::order::morton_code;
use crate::dem::tables::barrier::Barrier;
use crate::dem::tables::grains::{Grain, GrainShape, Member, place_members};
use crate::dem::tables::surfaces::Surface;

/// Reach of the lists of surfaces and ropes over that of the lists of grains.
const FIXED_SKIN: f64 = 3.0;
/// Renewals between two reorderings of the grain table.
const RENEWALS_PER_ORDERING: u64 = 20;

/// Candidate lists and what is needed to know when they expire.
pub struct Neighbours {
    pub blocks: Vec<Block>,
    /// Extra reach of the lists (m).
    pub skin: f64,
    pub renewals: u64,
    /// Places and drift of the members when the lists were made.
    pub references: Vec<Reference>,
    /// Time since then (s).
    pub elapsed: f64,
    steepness: f64,
    largest_radius: f64,
    node_reference: Vec<Vec3>,
    /// Grain numbers in the order of the rows the lists speak of.
    row_ids: Vec<u32>,
    tree: Option<BoxTree>,
}

/// What a renewal reads; the grains may be reordered.
pub struct Bodies<'a> {
    pub shape: GrainShape,
    pub grains: &'a mut [Grain],
    pub surfaces: &'a [Surface],
    pub barrier: Option<&'a Barrier>,
    /// Number of the last step made.
    pub step: u32,
}

/// Memories of all contacts in force, under the new row numbers.
struct Memories {
    grains: MemoryRows,
    surfaces: MemoryRows,
    ropes: MemoryRows,
}

impl Neighbours {
    pub fn new(skin: f64) -> Self {
        Self {
            blocks: Vec::new(),
            skin,
            renewals: 0,
            references: Vec::new(),
            elapsed: 0.0,
            steepness: 0.0,
            largest_radius: 0.0,
            node_reference: Vec::new(),
            row_ids: Vec::new(),
            tree: None,
        }
    }

    /// Whether something has moved so far that a pair outside the lists could touch.
    pub fn expired(&self, barrier: Option<&Barrier>) -> bool {
        let (mut moved, mut strayed) = (0.0_f64, 0.0_f64);
        for block in &self.blocks {
            moved = moved.max(block.strayed.moved.sqrt());
            strayed = strayed.max(block.strayed.strayed.sqrt());
        }
        let node_moves = barrier.into_iter().flat_map(|barrier| barrier.nodes.iter().zip(&self.node_reference));
        let mut node_moved = 0.0_f64;
        for (node, old) in node_moves {
            let distance = (node.position - old).norm();
            node_moved = if distance <= node_moved { node_moved } else { distance };
        }
        let drawn_out = self.steepness * self.elapsed;
        let pairs_hold = 2.0 * strayed < self.skin - drawn_out * (2.0 * self.largest_radius + self.skin);
        // Asked as "holds", so that a NaN expires the lists.
        let fixed_hold = moved + node_moved < self.fixed_skin();
        self.blocks.is_empty() || !pairs_hold || !fixed_hold
    }

    /// Reach of the lists of surfaces and ropes: wider, because the whole motion of the flow counts for them (m).
    fn fixed_skin(&self) -> f64 {
        FIXED_SKIN * self.skin
    }

    /// Drops the surface candidates because surfaces have gone; the next step renews all lists.
    pub fn forget_surfaces(&mut self) {
        for block in &mut self.blocks {
            block.surfaces = CandidateList::default();
            block.strayed = Strayed::LOST;
        }
    }

    /// Renews all lists. The grain table may have been thinned out since the last time; `members` is rewritten
    /// to follow it.
    pub fn renew(&mut self, bodies: &mut Bodies, members: &mut Vec<Member>) {
        let per_grain = bodies.shape.members();
        if self.renewals.is_multiple_of(RENEWALS_PER_ORDERING) {
            reorder(bodies.grains);
        }
        let new_rows = self.rows_now(bodies.grains, per_grain);
        let memories = self.collect(&new_rows, bodies.grains.len() * per_grain, bodies.step);
        if self.rows_changed(bodies.grains) {
            self.row_ids = bodies.grains.iter().map(|grain| grain.id).collect();
            self.tree = None;
            members.resize(bodies.grains.len() * per_grain, Member::default());
            for (grain, rows) in bodies.grains.iter().zip(members.chunks_exact_mut(per_grain)) {
                place_members(grain, rows);
            }
        }
        self.fill(bodies, members, &memories);
        let drift = Drift::fit(members);
        self.references.clear();
        self.references.extend(members.iter().map(|member| drift.reference(member)));
        self.steepness = drift.steepness;
        self.largest_radius = members.iter().map(Member::radius).fold(0.0, f64::max);
        self.elapsed = 0.0;
        self.node_reference = bodies.barrier.map_or(Vec::new(), |b| b.nodes.iter().map(|n| n.position).collect());
        self.renewals += 1;
    }

    fn rows_changed(&self, grains: &[Grain]) -> bool {
        self.row_ids.len() != grains.len() || self.row_ids.iter().zip(grains).any(|(id, grain)| *id != grain.id)
    }

    /// For each member row of the old lists, its row now; `u32::MAX` for grains that are gone.
    fn rows_now(&self, grains: &[Grain], per_grain: usize) -> Vec<u32> {
        let highest = grains.iter().map(|grain| grain.id).chain(self.row_ids.iter().copied()).max().unwrap_or(0);
        let mut row_of_id = vec![u32::MAX; highest as usize + 1];
        for (row, grain) in grains.iter().enumerate() {
            row_of_id[grain.id as usize] = row as u32;
        }
        let member_row = |id: &u32, side: usize| match row_of_id[*id as usize] {
            u32::MAX => u32::MAX,
            row => row * per_grain as u32 + side as u32,
        };
        self.row_ids.iter().flat_map(|id| (0..per_grain).map(move |side| member_row(id, side))).collect()
    }

    /// Memories of the contacts in force. Pairs inside a block stand there once but are wanted from both sides.
    fn collect(&self, new_rows: &[u32], members: usize, step: u32) -> Memories {
        let (mut grains, mut surfaces, mut ropes) = (Vec::new(), Vec::new(), Vec::new());
        let rename = |member: u32| new_rows[member as usize];
        for block in &self.blocks {
            for contact in block.inner.in_force(new_rows, step, rename) {
                grains.push(contact);
                grains.push(contact.mirrored());
            }
            grains.extend(block.border.in_force(new_rows, step, rename));
            surfaces.extend(block.surfaces.in_force(new_rows, step, |surface| surface));
            ropes.extend(block.ropes.list.in_force(new_rows, step, |segment| segment));
        }
        Memories {
            grains: MemoryRows::group(&grains, members),
            surfaces: MemoryRows::group(&surfaces, members),
            ropes: MemoryRows::group(&ropes, members),
        }
    }

    fn fill(&mut self, bodies: &Bodies, members: &[Member], memories: &Memories) {
        let per_grain = bodies.shape.members();
        let (skin, fixed_skin) = (self.skin, self.fixed_skin());
        let mut blocks = make_blocks(bodies.grains.len(), per_grain);
        let boxes: Vec<Box3> = members.chunks_exact(per_grain).map(|rows| grain_box(rows, 0.5 * skin)).collect();
        let tree = match self.tree.take() {
            Some(mut tree) => {
                tree.refit(&boxes);
                self.tree.insert(tree)
            }
            None => self.tree.insert(BoxTree::new(&boxes)),
        };
        find_grain_pairs(tree, members, per_grain, skin, &mut blocks);
        if let Some(barrier) = bodies.barrier.filter(|barrier| !barrier.segments.is_empty()) {
            let ropes = BoxTree::new(&segment_boxes(barrier, 2.0 * fixed_skin));
            find_rope_pairs((tree, &ropes), barrier, members, per_grain, fixed_skin, &mut blocks);
        }
        blocks.par_iter_mut().for_each(|block| {
            find_surface_pairs(block, members, bodies.surfaces, fixed_skin);
            block.inner.settle(&memories.grains, bodies.step);
            block.border.settle(&memories.grains, bodies.step);
            block.surfaces.settle(&memories.surfaces, bodies.step);
            block.ropes.list.settle(&memories.ropes, bodies.step);
        });
        self.blocks = blocks;
    }
}

/// Sorts the grains along a space-filling curve with cells of about two grains.
fn reorder(grains: &mut [Grain]) {
    let low = grains.iter().fold(Vec3::repeat(f64::INFINITY), |low, grain| low.inf(&grain.position));
    let widest = grains.iter().map(|grain| grain.body.radius + grain.body.offset).fold(0.0, f64::max);
    grains.sort_by_cached_key(|grain| (morton_code(&grain.position, &low, 2.0 * widest), grain.id));
}
