//! Renewal of the pair lists, with the memory of touching pairs carried over.

use std::sync::RwLock;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::contact::surfaces::OnFixed;
use crate::neighbours::blocks::{Block, OutgoingLoads, make_blocks, make_outgoing};
use crate::neighbours::broad_phase::{Box3, BoxTree};
use crate::neighbours::candidates::{
    Sought, find_border_pairs, find_fixed_pairs, find_inner_pairs, find_rope_pairs, grain_box, line_boxes,
    margin_of_lines,
};
use crate::neighbours::clocks::{Clocks, STEPS_AHEAD};
use crate::neighbours::drift::Drift;
use crate::neighbours::kept::Kept;
use crate::neighbours::memory_rows::MemoryRows;
use crate::neighbours::order::morton_code;
use crate::neighbours::reach::{Reach, Reaches, strayed};
use crate::tables::barrier::Barrier;
use crate::tables::fixed::Fixed;
use crate::tables::grain_table::GrainTable;
use crate::tables::moving_rows::Drifting;
use crate::time::integrate::Pace;
use crate::workers;
use crate::{Vec3, larger_or_nan};

/// Way that nodes of the barrier may go while the next lists live, over that of the last.
const NODE_RESERVE: f64 = 1.5;
/// Renewals between two reorderings of the grain table.
const RENEWALS_PER_ORDERING: u64 = 20;
/// Grains that are noted in one go.
const GRAINS_IN_PART: usize = 2048;
/// Share of a list's reach that a survey must leave, or the list is renewed.
const WORTH_KEEPING: f64 = 0.1;

/// Ages of lists (steps) below and above which the reach of the next ones is changed, by how much, and its largest value
/// over the least.
const AGE_TO_WIDEN: u32 = 100;
const AGE_TO_NARROW: u32 = 400;
const SKIN_CHANGE: f64 = 1.1;
const WIDEST_SKIN: f64 = 1.5;

/// Pair lists and what is needed to know when they expire.
pub struct Neighbours {
    pub blocks: Vec<Block>,
    /// What each block has for others; locked because blocks are worked on at the same time.
    pub outgoing: Vec<RwLock<OutgoingLoads>>,
    /// Extra reach of the lists (m): wider where they soon expire, down to the given one where they last.
    pub skin: f64,
    least_skin: f64,
    /// Longest way of a node when the last lists expired (m).
    node_way: f64,
    /// Steps since the lists were made.
    age: u32,
    pub renewals: u64,
    pub clocks: Clocks,
    /// Drift of the flow at each grain.
    pub drift: Vec<Drifting>,
    /// Reach of each grain.
    reaches: Vec<Reach>,
    bounds: Reaches,
    /// Places of the members when the lists were made.
    references: Vec<Vec3>,
    node_reference: Vec<Vec3>,
    /// Grain numbers in the order of the rows the lists speak of.
    row_ids: Vec<u32>,
    /// A tree over the grains of each block.
    trees: Vec<BoxTree>,
    lost: bool,
    /// Whether the lists end at a stop of the run, not because they have expired.
    at_stop: bool,
}

/// What a renewal reads; the grains may be reordered.
pub struct Bodies<'a> {
    pub grains: &'a mut GrainTable,
    pub fixed: Fixed<'a>,
    pub barrier: Option<&'a Barrier>,
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
            outgoing: Vec::new(),
            skin,
            least_skin: skin,
            node_way: 0.0,
            age: 0,
            renewals: 0,
            clocks: Clocks::default(),
            drift: Vec::new(),
            reaches: Vec::new(),
            bounds: Reaches::default(),
            references: Vec::new(),
            node_reference: Vec::new(),
            row_ids: Vec::new(),
            trees: Vec::new(),
            lost: true,
            at_stop: false,
        }
    }

    /// What is kept of the lists at a stop of the run.
    pub fn keep(&self) -> Kept {
        Kept::of([self.skin, self.least_skin, self.node_way], self.renewals, &self.row_ids, &self.blocks)
    }

    /// Lists that are made anew before the next step, with the contacts kept.
    pub fn take_up(kept: Kept) -> Self {
        let Kept { skins: [skin, least_skin, node_way], renewals, .. } = kept;
        let mut neighbours = Self { least_skin, node_way, renewals, row_ids: kept.row_ids.clone(), ..Self::new(skin) };
        neighbours.blocks = vec![kept.block()];
        neighbours.rest();
        neighbours
    }

    /// Whether a pair outside the lists could touch now. The clocks run at the fastest pace of all; when they say that
    /// it could be, a survey of what has really moved may give them more time. Where the barrier and grains at it move within a step
    /// (`finer`), no rope may be reached in that either.
    pub fn expired(&mut self, grains: &GrainTable, barrier: Option<&Barrier>, finer: bool) -> bool {
        if self.lost {
            return true;
        }
        let steps_ahead = if finer { STEPS_AHEAD } else { 0.0 };
        if self.clocks.hold(steps_ahead) {
            return false;
        }
        let elapsed = self.clocks.elapsed();
        let gone = strayed(&self.references, grains, &self.drift, &self.reaches, elapsed);
        let pairs_left = self.bounds.left(&gone, elapsed);
        self.node_way = self.way_of_nodes(barrier);
        let fixed_left = -gone.moved_over - self.node_way;
        self.clocks.extend(pairs_left, fixed_left);
        // Asked as "holds", so that a NaN expires the lists.
        let fixed_after = fixed_left - self.clocks.fixed_ahead(steps_ahead);
        let holds =
            pairs_left > WORTH_KEEPING * 2.0 * self.bounds.least && fixed_after > WORTH_KEEPING * self.bounds.least;
        !holds
    }

    /// Moves all clocks on through a step of length `step` (s) in which the blocks went at `paces` and no barrier node
    /// faster than `nodes` (m/s).
    pub fn tick(&mut self, paces: &[Pace], step: f64, nodes: f64) {
        self.age += 1;
        let stray = paces.iter().map(|pace| pace.stray).fold(0.0, f64::max);
        self.clocks.tick(step, stray, nodes);
        for (block, pace) in self.blocks.iter_mut().zip(paces) {
            self.clocks.tick_block(&mut block.clocks, step, pace.stray, stray, nodes);
        }
    }

    /// Says that bodies were moved by other means than steps, or that surfaces have gone: all lists expire.
    pub fn lose(&mut self) {
        self.lost = true;
    }

    /// Ends all lists at a stop of the run: those to come depend on nothing but bodies, contacts in force, reach and count, which
    /// can be kept.
    pub fn rest(&mut self) {
        self.trees.clear();
        (self.lost, self.at_stop) = (true, true);
    }

    /// Drops the surface candidates because surfaces have gone; the next step renews all lists.
    pub fn forget_surfaces(&mut self) {
        let reach = self.bounds.fixed;
        self.blocks.iter_mut().for_each(|block| block.surfaces.reset(reach));
        self.lose();
    }

    /// Longest way of a node since the lists were made (m); NaN if one is nowhere.
    fn way_of_nodes(&self, barrier: Option<&Barrier>) -> f64 {
        let nodes = barrier.into_iter().flat_map(|barrier| barrier.nodes.iter().zip(&self.node_reference));
        let ways = nodes.map(|(node, old)| (node.position - old).norm());
        ways.fold(0.0, larger_or_nan)
    }

    /// Renews all lists. The grain table may have been thinned out since the last time.
    pub fn renew(&mut self, bodies: &mut Bodies) {
        if self.renewals.is_multiple_of(RENEWALS_PER_ORDERING) {
            reorder(bodies.grains);
        }
        if !std::mem::take(&mut self.at_stop) {
            self.adapt_skin();
        }
        self.age = 0;
        let grains = &*bodies.grains;
        let new_rows = self.rows_now(grains);
        let memories = self.collect(&new_rows, grains.members());
        if self.row_ids != grains.ids {
            self.row_ids.clone_from(&grains.ids);
            self.trees.clear();
        }
        let drift = self.start(bodies);
        self.fill(bodies, &memories);
        self.start_clocks(&drift, bodies);
        self.renewals += 1;
    }

    /// Chooses the reach of the next lists by how long the last ones lived: long lists cost little in a step, since their
    /// pairs sleep, but more to make, and memory.
    fn adapt_skin(&mut self) {
        if self.renewals > 0 && self.age < AGE_TO_WIDEN {
            self.skin = (self.skin * SKIN_CHANGE).min(WIDEST_SKIN * self.least_skin);
        } else if self.age > AGE_TO_NARROW {
            self.skin = (self.skin / SKIN_CHANGE).max(self.least_skin);
        }
    }

    /// Notes where everything is now, and how far the lists of each grain are to reach.
    fn start(&mut self, bodies: &Bodies) -> Drift {
        let grains = &*bodies.grains;
        let drift = Drift::fit(grains);
        self.bounds = Reaches::choose(grains, &drift, self.skin, NODE_RESERVE * self.node_way, &mut self.reaches);
        self.drift.resize(grains.len(), Drifting::default());
        self.references.resize(grains.members(), Vec3::zeros());
        let (rows, per_grain) = (grains.rows(), grains.shape.members());
        let starts = self.drift.chunks_mut(GRAINS_IN_PART).zip(self.references.chunks_mut(GRAINS_IN_PART * per_grain));
        workers::for_each(starts, |part, (drifts, references)| {
            let first = part * GRAINS_IN_PART;
            for (row, drifting) in (first..).zip(drifts) {
                *drifting = drift.at(rows.place(row).0[0]);
            }
            for (member, reference) in (first * per_grain..).zip(references) {
                *reference = rows.sphere(member).0;
            }
        });
        self.node_reference = bodies.barrier.map_or(Vec::new(), |b| b.nodes.iter().map(|n| n.position).collect());
        drift
    }

    fn start_clocks(&mut self, drift: &Drift, bodies: &Bodies) {
        let Reaches { least, .. } = self.bounds;
        let pairs_left = if bodies.grains.is_empty() { self.skin } else { 2.0 * least };
        self.clocks = Clocks::start(drift, self.bounds.span(), pairs_left, least);
        self.lost = false;
    }

    /// For each member row of the old lists, its row now; `u32::MAX` for grains that are gone.
    fn rows_now(&self, grains: &GrainTable) -> Vec<u32> {
        let per_grain = grains.shape.members();
        let highest = grains.ids.iter().chain(&self.row_ids).max().copied().unwrap_or(0);
        let mut row_of_id = vec![u32::MAX; highest as usize + 1];
        for (row, id) in grains.ids.iter().enumerate() {
            row_of_id[*id as usize] = row as u32;
        }
        let member_row = |id: &u32, side: usize| match row_of_id[*id as usize] {
            u32::MAX => u32::MAX,
            row => row * per_grain as u32 + side as u32,
        };
        self.row_ids.iter().flat_map(|id| (0..per_grain).map(move |side| member_row(id, side))).collect()
    }

    /// Memories of the contacts in force. Pairs of grains are wanted from both sides: the order of rows may change.
    fn collect(&self, new_rows: &[u32], members: usize) -> Memories {
        let (mut grains, mut surfaces, mut ropes) = (Vec::new(), Vec::new(), Vec::new());
        let rename = |member: u32| new_rows[member as usize];
        for block in &self.blocks {
            for contact in block.inner.remembered(new_rows, rename).chain(block.border.remembered(new_rows, rename)) {
                grains.push(contact);
                grains.push(contact.mirrored());
            }
            surfaces.extend(block.surfaces.remembered(new_rows, |surface| surface));
            ropes.extend(block.ropes.list.remembered(new_rows, |segment| segment));
        }
        Memories {
            grains: MemoryRows::group(&grains, members),
            surfaces: MemoryRows::group(&surfaces, members),
            ropes: MemoryRows::group(&ropes, members),
        }
    }

    fn fill(&mut self, bodies: &Bodies, memories: &Memories) {
        let grains = bodies.grains.rows();
        let Reaches { largest, fixed, .. } = self.bounds;
        let sought = Sought { grains, members: &self.references, reaches: &self.reaches };
        let covered = self.blocks.last().map_or(0, |block| block.grains.end);
        if covered != bodies.grains.len() || self.outgoing.len() != self.blocks.len() {
            self.blocks = make_blocks(bodies.grains.len(), grains.shape);
            self.outgoing = make_outgoing(&self.blocks);
        }
        if self.trees.len() != self.blocks.len() {
            self.trees.clear();
            self.trees.resize_with(self.blocks.len(), BoxTree::default);
        }
        workers::for_each(self.blocks.iter_mut().zip(&mut self.trees), |_, (block, tree)| {
            block.reset(2.0 * largest, fixed);
            let boxes = block.grains.clone().map(|row| grain_box(grains, row, sought.reaches[row].reach));
            tree.fit(&boxes.collect::<Vec<Box3>>());
            find_inner_pairs(tree, &sought, block);
            find_fixed_pairs(block, sought, bodies.fixed);
        });
        let barrier = bodies.barrier.filter(|barrier| !barrier.lines.is_empty());
        // The boxes of the grains do not reach as far as these lists, so those of the lines do.
        let ropes =
            barrier.map(|barrier| (barrier, BoxTree::new(&line_boxes(barrier, margin_of_lines(barrier, sought)))));
        let fastest_node = bodies
            .barrier
            .map_or(0.0, |barrier| barrier.nodes.iter().map(|node| node.velocity.norm()).fold(0.0, f64::max));
        let closing = self.bounds.fastest + fastest_node;
        let starts: Vec<usize> = self.blocks.iter().map(|block| block.grains.start).collect();
        let trees = &self.trees;
        workers::for_each(&mut self.blocks, |number, block| {
            for other in number + 1..trees.len() {
                find_border_pairs([&trees[number], &trees[other]], starts[other], &sought, block);
            }
            if let Some((barrier, ropes)) = &ropes {
                find_rope_pairs(&trees[number], ropes, barrier, sought, block);
                block.ropes.list.keep_contacts(&memories.ropes);
                block.ropes.closing = closing;
            }
            block.inner.settle(&memories.grains);
            block.border.settle(&memories.grains);
            block.surfaces.settle(&memories.surfaces);
            OnFixed { grains, fixed: bodies.fixed }.hand_over_renewed(&mut block.surfaces, &memories.surfaces);
            block.ropes.list.settle(&memories.ropes);
        });
    }
}

/// Sorts the grains along a space-filling curve with cells of about two grains.
fn reorder(grains: &mut GrainTable) {
    let low = grains.place.iter().fold(Vec3::repeat(f64::INFINITY), |low, place| low.inf(&place.vector()));
    let widest = grains.bodies.iter().map(|body| body.radius + body.offset).fold(0.0, f64::max);
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    order.sort_by_cached_key(|&row| {
        let row = row as usize;
        (morton_code(&grains.place[row].vector(), &low, 2.0 * widest), grains.ids[row])
    });
    grains.arrange(&order);
}

impl Serialize for Neighbours {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.keep().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Neighbours {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Kept::deserialize(deserializer).map(Self::take_up)
    }
}
