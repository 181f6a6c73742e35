//! Fetches integrated in a room from where a bake sees it.

use super::viewpoint::Viewpoint;
use crate::study::parallax::room::{Convex, Fetch, Patches, Tap};
use lobefit_math::vector::Vec3;

/// Fetches without texels or levels.
#[derive(Clone, Copy, Debug)]
pub struct Integrated<'a> {
    /// Where the probe is.
    pub probe: Vec3,
    /// What the bake takes it for.
    pub proxy: &'a Convex,
    /// From where.
    pub viewpoint: Viewpoint,
    /// The room as lobes are integrated in it.
    pub exact: &'a Patches<'a>,
}

impl Fetch for Integrated<'_> {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        let eye = self.viewpoint.eye(self.proxy, self.probe, tap.towards, tap.alpha);
        self.exact.lobe(eye.place, eye.axis, eye.alpha)
    }
}
