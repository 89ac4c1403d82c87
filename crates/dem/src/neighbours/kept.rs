//! What of the neighbour lists is kept with a run that is taken up again later: the contacts in force with what they remember, and
//! what the next lists depend on. The lists themselves are made anew, as they are at every stop of a run.

use serde::{Deserialize, Serialize};

use crate::contact::pair_list::PairList;
use crate::neighbours::blocks::Block;
use crate::simd::quad::Quad;

/// Contacts in force: rows of the pairs, and what each remembers.
type Contacts = (Vec<[u32; 2]>, Vec<Quad>);

#[derive(Serialize, Deserialize)]
pub struct Kept {
    /// Reach of the lists (m): the present, the least; and the way of a node of the barrier (m).
    pub skins: [f64; 3],
    pub renewals: u64,
    /// Grain numbers in the order of the rows the contacts speak of.
    pub row_ids: Vec<u32>,
    grains: Contacts,
    surfaces: Contacts,
    ropes: Contacts,
}

impl Kept {
    pub fn of(skins: [f64; 3], renewals: u64, row_ids: &[u32], blocks: &[Block]) -> Self {
        fn all<'a>(lists: impl Iterator<Item = &'a PairList>) -> Contacts {
            let (mut pairs, mut memories) = (Vec::new(), Vec::new());
            for list in lists {
                pairs.extend_from_slice(&list.touching);
                memories.extend_from_slice(&list.memory);
            }
            (pairs, memories)
        }
        Self {
            skins,
            renewals,
            row_ids: row_ids.to_vec(),
            grains: all(blocks.iter().flat_map(|block| [&block.inner, &block.border])),
            surfaces: all(blocks.iter().map(|block| &block.surfaces)),
            ropes: all(blocks.iter().map(|block| &block.ropes.list)),
        }
    }

    /// A block that holds all contacts, and no grains: the next renewal takes what it remembers and makes blocks of its own.
    pub fn block(self) -> Block {
        let fill =
            |list: &mut PairList, (touching, memory): Contacts| (list.touching, list.memory) = (touching, memory);
        let mut block = Block::default();
        fill(&mut block.inner, self.grains);
        fill(&mut block.surfaces, self.surfaces);
        fill(&mut block.ropes.list, self.ropes);
        block
    }
}
