//! Fetches integrated in a room from where a bake sees it.

use super::viewpoint::Viewpoint;
use crate::effects::room::{Convex, Fan, Fetch, Room, Tap};

/// Fetches without texels or levels.
#[derive(Clone, Copy, Debug)]
pub struct Integrated<'a> {
    /// The room.
    pub room: &'a Room,
    /// What the bake takes it for.
    pub proxy: &'a Convex,
    /// From where.
    pub viewpoint: Viewpoint,
    /// Directions of its lobes.
    pub fan: &'a Fan,
}

impl Fetch for Integrated<'_> {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        let eye = self.viewpoint.eye(self.proxy, self.room.probe, tap.towards, tap.alpha);
        self.fan.lobe(self.room, eye.place, eye.axis, None, eye.alpha)
    }
}
