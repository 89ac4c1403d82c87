//! What is simulated: grains, surfaces, barrier, and what they are made of.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::contact::material::Material;
use crate::tables::barrier::Barrier;
use crate::tables::fixed::Fixed;
use crate::tables::grains::{Grain, GrainShape};
use crate::tables::pores::Pores;
use crate::tables::surfaces::Surface;
use crate::tables::terrain::Terrain;
use crate::tables::wall::WallShape;
use crate::time::inlet::Inlet;

/// Everything that is simulated.
///
/// [`Simulation::new`](crate::simulation::Simulation::new) has an example.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Model {
    pub shape: GrainShape,
    /// The grains as they start; a running simulation keeps them in its own table.
    pub grains: Vec<Grain>,
    pub surfaces: Vec<Surface>,
    /// The ground, where it is not of surfaces.
    pub terrain: Option<Terrain>,
    pub barrier: Option<Barrier>,
    pub material: Material,
    /// Fluid in the pores of the grains; none in a dry flow.
    pub pores: Option<Pores>,
    /// Where grains come in during the run; nothing where all are there from the start.
    pub inlet: Option<Inlet>,
    /// m/s², in the channel frame.
    pub gravity: Vec3,
    /// How forces on a rigid wall are told apart.
    pub wall: WallShape,
    /// Grains beyond this x are taken out of the model (m).
    pub outlet: f64,
}

impl Model {
    /// All that does not move.
    pub fn fixed(&self) -> Fixed<'_> {
        Fixed { surfaces: &self.surfaces, terrain: self.terrain.as_ref() }
    }

    /// Empty space without gravity, whose grains will be of this shape, of a soft stone.
    pub fn empty(shape: GrainShape) -> Self {
        Self {
            shape,
            grains: Vec::new(),
            surfaces: Vec::new(),
            terrain: None,
            barrier: None,
            material: Material::new(1e8, 0.3, 0.5),
            pores: None,
            inlet: None,
            gravity: Vec3::zeros(),
            wall: WallShape::default(),
            outlet: f64::INFINITY,
        }
    }
}
