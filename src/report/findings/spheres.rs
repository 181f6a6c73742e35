//! Spheres under a sky, as a page shows them.

use super::super::Image;

/// Spheres under a sky: the lobe itself, and what stands in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct SkySpheres {
    /// What they are of.
    pub title: String,
    /// What to see in them.
    pub caption: String,
    /// Roughness of each column.
    pub roughness: Vec<f64>,
    /// Name of each row; the first is the lobe itself.
    pub rows: Vec<String>,
    /// `pictures[row][column]`.
    pub pictures: Vec<Vec<Image>>,
}
