//! What is known about a mesh's vertices before a fit: their confidences, and which of them are held.

use super::options::check_confidence;
use super::topology::Topology;
use crate::error::{Result, check_count};
use crate::scene::mesh::Mesh;

/// Additional information about the vertices of a mesh: their confidence, and which of them are held.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct MeshKnown {
    confidence: Vec<f64>,
    held: Vec<bool>,
}

impl MeshKnown {
    /// Sets the confidence of each vertex: the weight of its fidelity term; default 1.
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite) if a confidence is no finite number from 0 on.
    pub fn with_confidence(mut self, confidence: Vec<f64>) -> Result<Self> {
        check_confidence(&confidence, confidence.len())?;
        self.confidence = confidence;
        Ok(self)
    }

    /// Sets for each vertex whether it is held, that is stays where it is; default: none is.
    pub fn with_held(mut self, held: Vec<bool>) -> Self {
        self.held = held;
        self
    }

    /// Converts confidence and held flag of each of the mesh's vertices to those of the topology's vertices. Where
    /// several vertices are joined, the largest confidence counts, and the joined one is held if any is.
    pub(super) fn for_topology(
        self,
        mesh: &Mesh,
        topology: &Topology,
    ) -> Result<(Vec<f64>, Vec<bool>)> {
        let count = mesh.positions().len();
        let (mut confidence, mut held) = (Vec::new(), vec![false; topology.len()]);
        if !self.confidence.is_empty() {
            check_confidence(&self.confidence, count)?;
            confidence = vec![0.0f64; topology.len()];
            for (own, joined) in self.confidence.iter().zip(&topology.joined) {
                confidence[*joined as usize] = confidence[*joined as usize].max(*own);
            }
        }
        if !self.held.is_empty() {
            check_count("held vertices of the mesh", count, 1, self.held.len())?;
            for (own, joined) in self.held.iter().zip(&topology.joined) {
                held[*joined as usize] |= own;
            }
        }
        Ok((confidence, held))
    }
}
