//! Memory of the contacts in force, reachable by member, for the time their lists are made anew.

use crate::contact::law::Memory;

/// A contact in force, seen from one of its members.
#[derive(Clone, Copy, Debug)]
pub struct Remembered {
    pub member: u32,
    /// The other party: a member, a surface or a segment, by the kind of list.
    pub other: u32,
    pub memory: Memory,
}

/// Contacts grouped by member.
#[derive(Debug, Default)]
pub struct MemoryRows {
    starts: Vec<u32>,
    rows: Vec<(u32, Memory)>,
}

impl MemoryRows {
    /// Groups `contacts` for a table of `members` rows (counting sort).
    pub fn group(contacts: &[Remembered], members: usize) -> Self {
        let mut starts = vec![0_u32; members + 1];
        for contact in contacts {
            starts[contact.member as usize + 1] += 1;
        }
        for index in 0..members {
            starts[index + 1] += starts[index];
        }
        let mut next = starts.clone();
        let mut rows = vec![(0, Memory::default()); contacts.len()];
        for contact in contacts {
            let place = &mut next[contact.member as usize];
            rows[*place as usize] = (contact.other, contact.memory);
            *place += 1;
        }
        Self { starts, rows }
    }

    /// All contacts of a member: the other party and the memory.
    pub fn of_member(&self, member: u32) -> impl Iterator<Item = (u32, Memory)> {
        let range = self.starts[member as usize] as usize..self.starts[member as usize + 1] as usize;
        self.rows[range].iter().copied()
    }

    /// Memory of the contact between `member` and `other`; empty where they did not touch.
    pub fn recall(&self, [member, other]: [u32; 2]) -> Memory {
        self.of_member(member).find(|(party, _)| *party == other).map_or_else(Memory::default, |(_, memory)| memory)
    }
}

impl Remembered {
    /// The same contact seen from the other member.
    pub fn mirrored(self) -> Self {
        let memory = Memory { tangential: self.memory.tangential.map(|value| -value), ..self.memory };
        Self { member: self.other, other: self.member, memory }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_each_contact_under_its_member_only() {
        let memory = |value: f64| Memory { tangential: [value, 0.0, 0.0], dashpot: value };
        let contacts = [(2, 7, 1.0), (0, 7, 2.0), (2, 5, 3.0)].map(|(member, other, value)| Remembered {
            member,
            other,
            memory: memory(value),
        });
        let rows = MemoryRows::group(&contacts, 4);
        assert_eq!(rows.recall([2, 7]), memory(1.0));
        assert_eq!(rows.recall([2, 5]), memory(3.0));
        assert_eq!(rows.recall([0, 7]), memory(2.0));
        assert_eq!(rows.recall([1, 7]), Memory::default());
        assert_eq!(rows.recall([3, 5]), Memory::default());
    }
}
