//! The rings of a ring net, and what the entries of a design say of them.

use crate::design::entries::Entries;
use crate::design::rope::Rope;
use crate::design::rope_entries::breaks;
use crate::design::show::at;
use crate::lattice::Lattice;
use crate::ring_law::{Chain, LOWEST_OF_TESTS, RingLaw, Wires, chain_of, is_known};

/// Rings, each of which meets so many others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NetRings {
    /// m
    pub diameter: f64,
    pub contacts: Contacts,
    pub wires: Wires,
    /// A chain of such rings, as a test or the wires tell.
    pub chain: Chain,
    /// Whether a test of such a chain is given.
    pub tested: bool,
    /// Whether a ring breaks in the simulation where its chain would.
    pub breaks: bool,
}

/// How many others a ring meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contacts {
    Four,
    Six,
}

impl Contacts {
    pub fn number(self) -> usize {
        match self {
            Self::Four => 4,
            Self::Six => 6,
        }
    }
}

impl NetRings {
    /// Distance between the centres of rings that meet (m). Rings that meet four others hang side by side; those that meet six are held
    /// by all of them, so that they stand as close as interlinked rings do, a diameter less their thickness.
    pub fn spacing(&self) -> f64 {
        match self.contacts {
            Contacts::Four => self.diameter,
            Contacts::Six => self.diameter - self.wires.bundle(),
        }
    }

    /// How the contacts of the rings lie.
    pub fn lattice(&self) -> Lattice {
        let spacing = self.spacing();
        match self.contacts {
            Contacts::Four => Lattice::FourContacts { spacing },
            Contacts::Six => Lattice::SixContacts { spacing },
        }
    }

    pub fn law(&self) -> RingLaw {
        RingLaw::of(&self.chain, self.diameter)
    }

    /// Force of one leg of a ring at the break of its chain (N).
    pub fn leg(&self) -> f64 {
        0.5 * self.chain[1][1]
    }

    /// Share of its wires' strength that the chain uses at its break.
    pub fn used(&self) -> f64 {
        self.leg() / self.wires.breaking_load()
    }

    /// What a leg is held against (N): that of the test given, or the lowest that the tests behind the law allow for.
    pub fn characteristic_leg(&self) -> f64 {
        if self.tested { self.leg() } else { LOWEST_OF_TESTS * self.leg() }
    }

    /// Whether what the rings withstand is known: from a test, or because they are of the kind that has been tested.
    pub fn is_known(&self) -> bool {
        self.tested || (self.contacts == Contacts::Four && is_known(&self.wires, self.diameter))
    }

    /// A rope as thick as the bundle, as stiff as a taut ring and as strong as one leg.
    pub fn as_rope(&self) -> Rope {
        let diameter = self.wires.bundle();
        let circle = std::f64::consts::FRAC_PI_4 * diameter.powi(2);
        Rope {
            diameter,
            modulus: self.law().axial_stiffness() / circle,
            breaking_load: self.leg(),
            elastic_limit: None,
            breaks: self.breaks,
        }
    }

    /// Side of the square mesh whose knots lie as the contacts of the rings do (m).
    pub fn mesh(&self) -> f64 {
        self.diameter * std::f64::consts::FRAC_1_SQRT_2
    }
}

/// Four where the design does not say.
pub fn contacts(e: &Entries) -> Contacts {
    match e.number(&ring_key("contacts")) {
        Some(6.0) => Contacts::Six,
        _ => Contacts::Four,
    }
}

/// Where a key of the rings stands.
pub fn ring_key(name: &str) -> String {
    at(&format!("net.rings.{name}"))
}

/// Wires of the rings; nothing where they are not told.
pub fn wires(e: &Entries) -> Option<Wires> {
    Some(Wires {
        windings: e.number(&ring_key("windings"))? as u32,
        diameter: e.number(&ring_key("wire_diameter"))?,
        strength: e.number(&ring_key("wire_strength"))?,
    })
}

/// The chain of a test, if its two points are told.
pub fn tested_chain(e: &Entries) -> Option<Chain> {
    e.points(&ring_key("chain_test")).and_then(|points| points.try_into().ok())
}

/// The rings of the net; nothing where the net has none, or they are not told soundly.
pub fn net_rings(e: &Entries) -> Option<NetRings> {
    let wires = wires(e)?;
    let tested = tested_chain(e);
    let given = e.mentions(&ring_key("chain_test"));
    Some(NetRings {
        diameter: e.number(&ring_key("diameter"))?,
        contacts: contacts(e),
        wires,
        chain: if given { tested? } else { chain_of(&wires) },
        tested: given,
        breaks: breaks(e, &ring_key("at_breaking_load"))?,
    })
}
