//! Posts that carry the uppermost main ropes between the banks, and what the entries of a design say of them.

use crate::design::dissipator::DissipatorDesign;
use crate::design::dissipator_entries::{OF_RETAINING_ROPES, dissipators};
use crate::design::entries::Entries;
use crate::design::rope::Rope;
use crate::design::rope_entries::{RETAINING, rope};
use crate::design::show::at;

/// Equal posts on hinged feet, each held upstream by ropes.
#[derive(Clone, Debug, PartialEq)]
pub struct Posts {
    /// Where they stand across the channel as the design lists them, to the right looking downstream (m): in the coordinates of a surveyed
    /// section, or from the middle between side walls.
    pub at: Vec<f64>,
    /// Width that faces the flow (m).
    pub width: f64,
    /// Cross-section of steel (m²).
    pub area: f64,
    /// Young's modulus (Pa).
    pub modulus: f64,
    pub strength: PostStrength,
    /// Of the foundation of one post to the force of its foot (N), if known.
    pub foot_resistance: Option<f64>,
    /// Of a post and its foundation to being pulled up (N), if known.
    pub uplift_resistance: Option<f64>,
    /// Friction coefficient between a rope and the head of a post.
    pub head_friction: f64,
    pub retaining: RetainingRopes,
}

/// Density of steel (kg/m³).
const STEEL: f64 = 7850.0;

impl Posts {
    /// Mass of a post of this length (m; kg).
    pub fn mass(&self, length: f64) -> f64 {
        STEEL * self.area * length
    }
}

/// What a post withstands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PostStrength {
    /// Nobody says.
    Unknown,
    /// Characteristic resistances to compression, buckling included (N), and to bending (N m).
    Given {
        compression: f64,
        bending: f64,
    },
    Section(SteelSection),
}

/// A steel section, hinged at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteelSection {
    /// √(I/A) about the weaker axis (m).
    pub radius_of_gyration: f64,
    /// Elastic section modulus W against bending down the channel (m³), and the share χ_LT of it that lateral-torsional buckling leaves, if known.
    pub section_modulus: f64,
    pub lateral_torsional: Option<f64>,
    /// Pa
    pub yield_strength: f64,
    /// Imperfection factor α of its buckling curve.
    pub imperfection: f64,
}

/// The ropes that hold the head of a post upstream.
#[derive(Clone, Debug, PartialEq)]
pub struct RetainingRopes {
    pub rope: Rope,
    /// Distance of the anchors upstream of the foot, along the bed (m).
    pub set_back: f64,
    /// Distance of each of the two anchors to its side of the post (m); with 0 there is one rope.
    pub spread: f64,
    pub dissipators: Option<DissipatorDesign>,
    /// Characteristic resistance of one anchor (N).
    pub anchor_resistance: f64,
}

impl RetainingRopes {
    /// Ropes of one post.
    pub fn count(&self) -> usize {
        self.sides().len()
    }

    /// To which side of the post each of them goes, to the right looking downstream first (m).
    pub fn sides(&self) -> Vec<f64> {
        if self.spread > 0.0 { vec![self.spread, -self.spread] } else { vec![0.0] }
    }
}

/// Buckling curves by their letters, with the imperfection factor of each (EN 1993-1-1, Table 6.1).
pub const CURVES: [&str; 4] = ["a", "b", "c", "d"];
const IMPERFECTIONS: [f64; 4] = [0.21, 0.34, 0.49, 0.76];

/// Where a key of the posts stands.
pub fn post_key(name: &str) -> String {
    at(&format!("posts.{name}"))
}

/// Keys of the two ways in which the strength of a post is told.
pub const RESISTANCES: [&str; 2] = ["resistance", "bending_resistance"];
pub const OF_A_SECTION: [&str; 3] = ["radius_of_gyration", "section_modulus", "yield_strength"];

/// The posts of the net; nothing where it has none, or they are not told soundly.
pub fn posts(e: &Entries) -> Option<Posts> {
    let value = |name: &str| e.number(&post_key(name));
    let of_rope = |name: &str| value(&format!("retaining_ropes.{name}"));
    let has_dissipators = e.has_section(OF_RETAINING_ROPES);
    let ring_friction = e.number(&at("main_ropes.rings.friction"));
    Some(Posts {
        at: e.numbers(&post_key("at"))?.to_vec(),
        width: value("width")?,
        area: value("area")?,
        modulus: value("modulus")?,
        strength: strength(e),
        foot_resistance: value("foot_resistance"),
        uplift_resistance: value("uplift_resistance"),
        head_friction: libm::tan(value("head_friction").or(ring_friction)?),
        retaining: RetainingRopes {
            rope: rope(e, &[RETAINING])?,
            set_back: of_rope("set_back")?,
            spread: of_rope("spread")?,
            dissipators: if has_dissipators { Some(dissipators(e, OF_RETAINING_ROPES)?) } else { None },
            anchor_resistance: of_rope("anchor_resistance")?,
        },
    })
}

fn strength(e: &Entries) -> PostStrength {
    let value = |name: &str| e.number(&post_key(name));
    if let (Some(compression), Some(bending)) = (value(RESISTANCES[0]), value(RESISTANCES[1])) {
        return PostStrength::Given { compression, bending };
    }
    let curve = e.text(&post_key("buckling_curve")).and_then(|curve| CURVES.iter().position(|known| *known == curve));
    let of_section = || {
        Some(SteelSection {
            radius_of_gyration: value(OF_A_SECTION[0])?,
            lateral_torsional: value("lateral_torsional_factor"),
            section_modulus: value(OF_A_SECTION[1])?,
            yield_strength: value(OF_A_SECTION[2])?,
            imperfection: IMPERFECTIONS[curve?],
        })
    };
    of_section().map_or(PostStrength::Unknown, PostStrength::Section)
}
