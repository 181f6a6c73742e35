//! The effects `glass` and `beckmann-glass`, of either distribution of normals: tables of R + T of a rough
//! dielectric interface over mu, roughness and index of refraction, one for rays from outside and one for
//! rays from inside.
//!
//! | table | size | columns | rows | slices | texel |
//! |---|---|---|---|---|---|
//! | each side | 128 x 128 x 32 | mu, `homogeneous-ior` | roughness | ior, `ior` | loss |

pub mod compensation;
mod path_tracer;
mod table;

use super::effect::{Note, Profile};
use super::table::{
    BuildError, Family, Further, LookupPoints, Made, RUN, Region, Sliced, Spec, TableJob, Truths,
};
use super::who::{NO_GLASS, about, no_beckmann_glass, no_distribution, stay_smooth};
use super::{NOTE_F0, NOTE_LOOKUP, NOTE_PATH_TRACER, beckmann, ggx};
use crate::approximate::Memo;
use crate::data::{Layout, Ndf, Serves, Smith, Table};
use crate::effects::Albedo;
use crate::scene::{Lobe, Material, Scene};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points;
use lobefit_truth::quantity::{self, BECKMANN_GLASS, GGX_GLASS};

use path_tracer::NOTE as PATH_TRACER_NOTE;
pub use table::{glass_axes, path_tracer};

/// The effect, of one distribution of normals.
pub struct Glass {
    ndf: Ndf,
    profile: Profile,
    /// Name of its functions, but in the path tracer's layout.
    role: &'static str,
    quantity: &'static dyn quantity::Glass,
    /// Times what GGX takes.
    price: f64,
}

/// Of GGX.
pub static GGX: Glass = Glass {
    ndf: Ndf::Ggx,
    profile: Profile {
        name: "glass",
        prefixes: &["ggx_glass_", "path_tracer_"],
        lobe: ggx,
        notes: &NOTES,
        ..Profile::NONE
    },
    role: "ggx_glass_albedo",
    quantity: GGX_GLASS,
    price: 1.0,
};

/// Of Beckmann's distribution, in our layout.
pub static BECKMANN: Glass = Glass {
    ndf: Ndf::Beckmann,
    profile: Profile {
        name: "beckmann-glass",
        prefixes: &["beckmann_glass_"],
        lobe: beckmann,
        notes: &NOTES,
        ..Profile::NONE
    },
    role: "beckmann_glass_albedo",
    quantity: BECKMANN_GLASS,
    price: 2.3,
};

const NOTES: [Note; 4] = [
    NOTE_PATH_TRACER,
    NOTE_F0,
    NOTE_LOOKUP,
    (
        &["ior: f32", "float ior"],
        &["ior is the index of refraction, inside over outside, for rays from either side."],
    ),
];

/// Seconds on one core of a sampled and of an optimised texel of one side, and of the truth at the
/// points where a table is measured.
const SAMPLED_S: f64 = 0.45e-6;
const OPTIMISED_S: f64 = 4.6e-6;
const TRUTH_S: f64 = 0.3;

/// 2^12 groups of eight uniform points, half as many in the layer and about the critical angle, and
/// the edges.
const LOG2_GROUPS: u32 = 12;

/// Tolerance of the truths that lookups are judged against.
const JUDGED: f64 = 1e-6;

impl Family for Glass {
    fn prefix(&self, layout: Layout) -> &'static str {
        if layout == Layout::PathTracer { "path-tracer-glass" } else { self.quantity.name() }
    }

    fn role(&self, layout: Layout, _: Serves) -> &'static str {
        if layout == Layout::PathTracer { "path_tracer_glass_albedo" } else { self.role }
    }

    fn sides(&self) -> &'static [Option<Side>] {
        &[Some(Side::Outside), Some(Side::Inside)]
    }

    fn described(&self, _: &TableJob, side: Option<Side>) -> String {
        format!("of glass for rays from {}", side.map_or("", Side::name))
    }

    fn seconds(&self, i: usize, jobs: &[TableJob]) -> f64 {
        let texel = if jobs[i].want.layout == Layout::PathTracer { SAMPLED_S } else { OPTIMISED_S };
        self.price * (jobs[i].texels() as f64 * texel + TRUTH_S)
    }

    fn note(&self, layout: Layout) -> Option<&'static str> {
        (layout == Layout::PathTracer).then_some(PATH_TRACER_NOTE)
    }

    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError> {
        memo.add(spec.names.len() * spec.size.iter().product::<usize>());
        table::build(self.quantity, spec)
    }

    fn points(&self, region: &Region, _: bool) -> Result<LookupPoints, BuildError> {
        Ok(LookupPoints::certification(region, LOG2_GROUPS))
    }

    fn truths(
        &self,
        smith: Smith,
        points: &LookupPoints,
        _: bool,
        memo: &Memo,
    ) -> Result<Truths, IntegrateError> {
        let quantity = self.quantity;
        let (sides, evaluations) = truths(quantity, smith, points)?;
        memo.add(sides.len() * points.len());
        let sides = sides.map(|e| Albedo { e, b: Vec::new() }).to_vec();
        let further = Further::new(move |i, points, memo| {
            memo.add(points.len());
            let (e, _) = quantity.one_side((smith, Side::ALL[i]), &inputs(places(points)), JUDGED)?;
            Ok(Albedo { e, b: Vec::new() })
        });
        Ok(Truths { sides, made: Made { evaluations, integration: JUDGED }, further })
    }
}

impl Sliced for Glass {
    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn lobe(&self) -> Lobe {
        Lobe::Glass
    }

    fn ndf(&self) -> Ndf {
        self.ndf
    }

    fn lobe_text(&self) -> &'static str {
        "a rough surface that transmits"
    }

    fn left_out(&self, scene: &Scene) -> String {
        let all = || scene.materials.iter().filter(|m| m.lobe() == Lobe::Glass);
        let glass = || all().filter(|m| m.distribution == self.ndf);
        match (glass().next(), self.unserved(scene)) {
            (None, _) if self.ndf == Ndf::Beckmann => no_beckmann_glass(scene),
            (None, _) if all().next().is_some() => no_distribution(self.ndf, "glass"),
            (None, _) if scene.materials.iter().any(|m| m.lobe().is_glass()) => {
                "every glass has anisotropy".into()
            }
            (None, _) => NO_GLASS.into(),
            (_, None) => "no glass wants tables".into(),
            (_, Some(why)) => format!("no glass is rough: {why}"),
        }
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let glass = scene.materials.iter().filter(|m| (m.lobe(), m.distribution) == (Lobe::Glass, self.ndf));
        let wanting: Vec<&Material> = glass.filter(|m| !m.wants.tables.is_empty()).collect();
        about(&wanting, stay_smooth)
    }

    fn shown(&self) -> &'static [f64] {
        &[1.1, 1.5, 2.0]
    }

    fn title(&self, slice: f64, side: Option<Side>) -> String {
        let side = side.map_or_else(String::new, |side| format!(", from {}", side.name()));
        format!("Glass, index of refraction {slice}{side}")
    }

    fn layer(&self, slice: f64) -> f64 {
        slice - 1.0
    }

    fn path_tracer_error(&self, [x, alpha, z]: [f64; 3]) -> Result<f64, IntegrateError> {
        let side = if z < 0.5 { Side::Outside } else { Side::Inside };
        let [_, _, loss] = self.quantity.drawn((Smith::Separable, side), [alpha, x * x, 1.0 + z], RUN)?;
        Ok(loss.standard_error)
    }
}

/// alpha, mu and ior of the points of lookups.
fn places(points: &LookupPoints) -> impl Iterator<Item = [f64; 3]> {
    points.all.iter().map(|p| [p.alpha, p.mu, p.ior].map(f64::from))
}

/// The inputs of the quantity.
fn inputs(places: impl Iterator<Item = [f64; 3]>) -> points::Points {
    let places: Vec<[f64; 3]> = places.collect();
    let column = |k: usize| places.iter().map(|place| place[k]).collect::<Vec<f64>>();
    points::Points::new([("alpha", column(0)), ("mu", column(1)), ("ior", column(2))])
}

/// E from outside and E from inside at every point, within `JUDGED`, and the evaluations that
/// they took.
pub fn truths(
    glass: &dyn quantity::Glass,
    smith: Smith,
    points: &LookupPoints,
) -> Result<([Vec<f64>; 2], u64), IntegrateError> {
    energies((glass, smith), places(points), JUDGED)
}

/// E of both sides at (alpha, mu, ior), and the evaluations that they took.
fn energies(
    (glass, smith): (&dyn quantity::Glass, Smith),
    places: impl Iterator<Item = [f64; 3]>,
    tolerance: f64,
) -> Result<([Vec<f64>; 2], u64), IntegrateError> {
    let sides = glass.both_sides(smith, &inputs(places), tolerance)?;
    let evaluations = sides[0].evaluations;
    Ok((sides.map(|side| side.arrays::<3>()).map(|[_, _, e]| e), evaluations))
}
