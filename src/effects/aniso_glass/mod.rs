//! The effect `aniso-glass`: tables of R + T of a rough dielectric interface that is wider along one
//! tangent than along the other, one for rays from outside and one for rays from inside.
//!
//! | axes | warp |
//! |---|---|
//! | mu, square of the cosine of the azimuth | `homogeneous-ior`, linear |
//! | roughness, anisotropy: the two widths | linear, `aspect` |
//! | ior | linear, or from near 1 on `ior` |
//!
//! Texels are exact losses. They are few and dear: a table is judged at a number of points in proportion.

use rayon::prelude::*;

use super::effect::Profile;
use super::table::{
    BuildError, Family, Further, LookupPoints, Made, Point, Region, SliceAxis, Sliced, Spec, TableJob,
    Truths, aspect, even, ior_axis,
};
use super::who::{NO_GLASS, named, verb};
use super::{Albedo, NOTE_F0, NOTE_LOOKUP, ggx};
use crate::approximate::Memo;
use crate::data::{Axis, Channel, Layout, Serves, Smith, Surface, Table, Warp};
use crate::scene::{Lobe, Material, Scene};
use lobefit_math::ops;
use lobefit_truth::integrate::aniso::glass::{QUANTITY, glass};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::{IntegrateError, aniso};

/// The effect.
pub struct AnisoGlass;

/// Largest error of a texel and of a truth that judges lookups: hundredths of what lookups leave.
const TOLERANCE: f64 = 1e-4;

/// Seconds of a truth from one side on one core.
const TRUTH_S: f64 = 0.009;

/// Points of a region at which every table is judged, and how many texels call for one more.
const POINTS: u32 = 32;
const TEXELS: usize = 16;

/// The axes over a region.
fn axes(size: [usize; 5], region: &Region) -> Result<[Axis; 5], BuildError> {
    let (ior, anisotropy) = (region.slices()?.range, region.anisotropy.ok_or(BuildError::Slices)?);
    Ok([
        Axis::ends("mu", size[0], Warp::HomogeneousIor, [0.0, 1.0]),
        Axis::ends("cos2_phi", size[1], Warp::Linear, [0.0, 1.0]),
        Axis::ends("roughness", size[2], Warp::Linear, region.roughness),
        Axis::ends("anisotropy", size[3], Warp::Aspect, anisotropy),
        ior_axis(size[4], ior),
    ])
}

/// What a view meets.
#[derive(Clone, Copy)]
struct Place {
    alpha: [f64; 2],
    view: [f64; 2],
    ior: f64,
}

impl Place {
    fn new([alpha, anisotropy, mu, cos2_phi, ior]: [f64; 5]) -> Place {
        let (aspect, sin2_phi) = (aspect(anisotropy), (1.0 - cos2_phi).max(0.0));
        let phi = ops::atan2(sin2_phi.sqrt(), cos2_phi.max(0.0).sqrt());
        Place { alpha: [alpha / aspect, alpha * aspect], view: [mu, phi], ior }
    }

    fn of(p: &Point) -> Place {
        Place::new([p.alpha, p.anisotropy, p.mu, p.cos2_phi, p.ior].map(f64::from))
    }

    /// The loss from a side. A width rounded to below the least is the least.
    fn loss(&self, smith: Smith, side: Side) -> Result<f64, IntegrateError> {
        let alpha = self.alpha.map(|alpha| alpha.max(aniso::ALPHA[0]));
        Ok(glass(smith, alpha, self.view, (self.ior, side), TOLERANCE)?.loss)
    }
}

/// The losses of places from a side.
fn losses(smith: Smith, side: Side, places: &[Place]) -> Result<Vec<f64>, IntegrateError> {
    places.par_iter().map(|place| place.loss(smith, side)).collect()
}

/// The places of the texels, the first axis fastest.
fn texels(axes: &[Axis; 5], region: &Region) -> Vec<Place> {
    let sizes = axes.each_ref().map(|axis| axis.size);
    let place = |mut i: usize| {
        let at = sizes.map(|n| {
            let at = i % n;
            i /= n;
            at
        });
        let flat = Surface::<f64>::rough(0.0);
        let alpha = region.alpha_map.alpha(axes[2].node(at[2], flat));
        let (cos2_phi, anisotropy) = (axes[1].node(at[1], flat), axes[3].node(at[3], flat));
        let surface = Surface { anisotropy, cos2_phi, ..Surface::<f64>::rough(alpha) };
        let ior = axes[4].node(at[4], surface);
        let mu = axes[0].node(at[0], Surface { ior, ..surface });
        // Below the region's mu a lookup at its edge still blends with a texel.
        Place::new([alpha, anisotropy, mu.clamp(0.25 * region.mu[0], 1.0), cos2_phi, ior])
    };
    (0..sizes.iter().product()).map(place).collect()
}

impl Family for AnisoGlass {
    fn prefix(&self, _: Layout) -> &'static str {
        QUANTITY
    }

    fn role(&self, _: Layout, _: Serves) -> &'static str {
        "ggx_glass_aniso_albedo"
    }

    fn sides(&self) -> &'static [Option<Side>] {
        &[Some(Side::Outside), Some(Side::Inside)]
    }

    fn described(&self, _: &TableJob, side: Option<Side>) -> String {
        format!("of anisotropic glass for rays from {}", side.map_or("", Side::name))
    }

    fn seconds(&self, i: usize, jobs: &[TableJob]) -> f64 {
        let texels = jobs[i].texels();
        TRUTH_S * (texels + texels / TEXELS + POINTS as usize) as f64
    }

    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError> {
        let axes = axes(spec.sizes()?, &spec.region)?;
        let places = texels(&axes, &spec.region);
        let channel = |side: Side| {
            memo.add(places.len());
            Ok(vec![Channel::new("loss", losses(spec.smith, side, &places)?)])
        };
        let channels = Side::ALL.into_iter().map(channel).collect::<Result<_, IntegrateError>>()?;
        Ok((spec.tables(QUANTITY, &axes, channels)?, Made { evaluations: 0, integration: TOLERANCE }))
    }

    fn points(&self, region: &Region, _: bool) -> Result<LookupPoints, BuildError> {
        let all = even((&axes([2; 5], region)?, region), POINTS);
        let uniform = vec![true; all.len()];
        Ok(LookupPoints::of(all, uniform, SliceAxis::Ior, true))
    }

    fn judged_at(&self, texels: usize) -> Option<u32> {
        Some((texels / TEXELS) as u32)
    }

    fn truths(
        &self,
        smith: Smith,
        points: &LookupPoints,
        _: bool,
        memo: &Memo,
    ) -> Result<Truths, IntegrateError> {
        let at = move |i: usize, points: &LookupPoints, memo: &Memo| {
            memo.add(points.len());
            let places: Vec<Place> = points.all.iter().map(Place::of).collect();
            let losses = losses(smith, Side::ALL[i], &places)?;
            Ok(Albedo { e: losses.into_iter().map(|loss| 1.0 - loss).collect(), b: Vec::new() })
        };
        let sides = [0, 1].into_iter().map(|i| at(i, points, memo)).collect::<Result<_, IntegrateError>>()?;
        let made = Made { evaluations: 0, integration: TOLERANCE };
        Ok(Truths { sides, made, further: Further::new(at) })
    }
}

impl Sliced for AnisoGlass {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "aniso-glass",
                prefixes: &["ggx_glass_aniso_"],
                lobe: ggx,
                notes: &[NOTE_F0, NOTE_LOOKUP],
                ..Profile::NONE
            }
        }
    }

    fn lobe(&self) -> Lobe {
        Lobe::AnisotropicGlass
    }

    fn lobe_text(&self) -> &'static str {
        "a rough anisotropic surface that transmits"
    }

    fn left_out(&self, scene: &Scene) -> String {
        let glass = |lobe| scene.materials.iter().filter(move |m: &&Material| m.lobe() == lobe);
        let own: Vec<&Material> = glass(Lobe::AnisotropicGlass).collect();
        match (own.is_empty(), glass(Lobe::Glass).next()) {
            (true, None) => NO_GLASS.into(),
            (true, _) => "no glass has anisotropy".into(),
            _ => format!("{} {} smooth or {} no tables", named(&own), verb(&own, "are"), verb(&own, "want")),
        }
    }

    fn shown(&self) -> &'static [f64] {
        &[]
    }

    fn title(&self, slice: f64, _: Option<Side>) -> String {
        format!("Anisotropic glass, index of refraction {slice}")
    }

    fn layer(&self, slice: f64) -> f64 {
        slice - 1.0
    }

    fn path_tracer_error(&self, _: [f64; 3]) -> Result<f64, IntegrateError> {
        Err(IntegrateError::NoBrdf { quantity: QUANTITY })
    }
}
