//! What several effects say at the head of the include files.

use super::Note;
use crate::data::Ndf;
use crate::scene::Scene;

/// How the names of functions of tables in the path tracer's layout begin.
pub const PATH_TRACER: &str = "path_tracer_";

/// The conventions of these tables.
pub const PATH_TRACER_CONVENTIONS: &str = "`path_tracer_*`: GGX lobe, smith: separable; alpha = roughness";

/// Of the tables in the path tracer's layout.
pub(super) const NOTE_PATH_TRACER: Note = (&[PATH_TRACER], &[PATH_TRACER_CONVENTIONS]);

/// Of f0.
pub(super) const NOTE_F0: Note = (&["f0"], &["f0 is the reflectance at normal incidence."]);

/// Of lookups of E.
pub(super) const NOTE_LOOKUP: Note =
    (&["_uv(", "_uvw("], &["A function that takes a table looks E up in it; `ggx_compensate_*` take E."]);

/// The GGX lobe in the scene's conventions.
pub(super) fn ggx(scene: &Scene) -> String {
    lobe_of(Ndf::Ggx, scene)
}

/// The lobe of Beckmann's distribution in the scene's conventions.
pub(super) fn beckmann(scene: &Scene) -> String {
    lobe_of(Ndf::Beckmann, scene)
}

fn lobe_of(ndf: Ndf, scene: &Scene) -> String {
    format!("{} lobe, smith: {}; alpha = {}", ndf.name(), scene.smith.name(), scene.alpha.name())
}
