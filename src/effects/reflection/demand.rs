//! What rough materials want of the lobe that only reflects: tables and one family of fits.

use std::cell::LazyCell;

use super::Reflection;
use crate::approximate::{CallOps, Emission, Formulas};
use crate::data::{AlphaMap, Pick, Smith};
use crate::effects::JobSummary;
use crate::effects::demand::{Budget, Demand, Job, Span};
use crate::effects::table::{self, TableJob};
use crate::effects::who::{
    about, anisotropy, is_rough, named, no_distribution, reasons, rough, stay_smooth, verb,
};
use crate::emit::compensation;
use crate::scene::{Lobe, Material, Scene, Serves};
use lobefit_math::ops::log;
use lobefit_truth::quantity::Specular;

/// Seconds of the truth of a distribution on one core.
pub(super) struct TruthPrice {
    /// Of E, and of E and B, at a point that tables are judged at.
    judged: [f64; 2],
    /// Of E at a point of a certificate of a fit.
    certified: f64,
    /// Of the fits of f0 A + B.
    blends: f64,
}

/// Of GGX, whose lobe is integrated in lanes.
pub(super) const GGX_PRICE: TruthPrice =
    TruthPrice { judged: [0.65e-6, 7e-6], certified: 0.65e-6, blends: 0.9 };

/// Of Beckmann, whose B is integrated at single points.
pub(super) const BECKMANN_PRICE: TruthPrice =
    TruthPrice { judged: [2e-6, 8e-6], certified: 0.65e-6, blends: 2.8 };

/// Seconds of one optimised texel of a table of E: some 17 truths and its share of the
/// optimisation.
const TEXEL_E_S: f64 = 45e-6;
/// The same of a table of E and B.
const TEXEL_SPLIT_S: f64 = 370e-6;
/// Points at which the tables of a region are judged: 2^17 uniform, half as many in the layer, and
/// the edges.
pub const JUDGED: f64 = 221_000.0;
/// Texels of the squares that are tried one after the other where the size is left open and 32x32
/// is found enough: 16^2 + 32^2.
const AUTO_TEXELS: f64 = 1_280.0;
/// Points of a certificate of a fit: 2^20 uniform, half as many in the layer, and the edges.
pub const CERTIFIED: f64 = 1.6e6;
/// Seconds of one evaluation of one formula in its certificate.
const EVALUATION_S: f64 = 22e-9;
/// Seconds of one optimisation with its restarts: a round figure between the forms of one parameter
/// and of twenty.
const OPTIMISE_S: f64 = 0.04;
/// What a range of roughness narrower than this adds to it, per factor e: descents go along longer
/// valleys where a formula has more parameters than the range determines. Measured down to one hundredth.
const NARROW: (f64, f64) = (0.6, 3.0);
/// Of the searches and certificates, those that a bake makes that shows no page: it stops at the formula
/// that it emits.
const UNSHOWN: f64 = 0.25;

/// Seconds of a fit of f0 A + B.
const BLEND_FIT_S: f64 = 0.1;

/// Name of the job of fits: one for the whole scene, because a fit over the hull of the ranges
/// holds in each of them.
const FITS: &str = "normalisation";

/// Operations and error of the normalisations that none beats in both, over roughness 0.02 to 1 and
/// mu from 0.01, with correlated Smith and alpha = roughness^2.
pub const REACHED: [(u32, f64); 18] = [
    (1, 0.513),
    (2, 0.254),
    (3, 0.098),
    (4, 0.082),
    (5, 0.077),
    (6, 0.0625),
    (8, 0.055),
    (10, 0.0323),
    (11, 0.0234),
    (12, 0.0198),
    (13, 0.01134),
    (14, 0.00972),
    (15, 0.00624),
    (16, 0.0049),
    (17, 0.0034),
    (18, 0.00255),
    (19, 0.00191),
    (20, 0.0017),
];

/// What the materials of the fits want beside normalisations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitJob {
    /// Also fit E_avg(alpha).
    pub average: bool,
    /// Also emit the lobe that takes it.
    pub multiscatter: bool,
    /// Also fit f0 A + B.
    pub blend: bool,
    /// Whether a material's compensation has a colour, as a metal's.
    pub coloured: bool,
    /// What multiplies the dielectrics that its metals are mixed with, each once.
    pub mixed: Vec<Specular>,
    /// The user's hypothesis files, relative to the scene file, each once.
    pub hypotheses: Vec<String>,
}

impl Reflection {
    /// Demands for tables and for fits, of each material of the distribution that is rough.
    pub(super) fn wanted(&self, scene: &Scene) -> Vec<Demand> {
        // Of a metal's call beside the normalisation: it takes the form for three channels. A text that does
        // not parse is a defect, which the bake names.
        let coloured = LazyCell::new(|| compensation::coloured_ops().unwrap_or(0));
        let of_material = |(of, material, range): (usize, &Material, [f64; 2])| {
            let beside = if is_coloured(material) { *coloured } else { 0 };
            let roughness = Span::roughness(range, scene.alpha);
            let of_fits = roughness.or_one(false);
            let has_tables = table::wanted(material, 2).count() > 0;
            let because = because(material, if has_tables { roughness } else { of_fits });
            let tables = table::wanted(material, 2)
                .filter_map(|want| table::demand(self, scene, (of, material), want, because.clone()));
            let fit = material.wants.fit.as_ref().filter(|_| !material.lobe().is_glass());
            let fit = fit.map(|want| Demand {
                job: FITS.into(),
                rank: 1,
                of,
                name: material.name.clone(),
                field: format!("materials[{of}].wants.fit"),
                because: because.clone(),
                spans: vec![("mu", Span::new(scene.mu)), ("roughness", of_fits)],
                goals: want.goals.clone(),
                call: CallOps { beside, ..CallOps::default() },
                ..Demand::default()
            });
            tables.chain(fit).collect::<Vec<Demand>>()
        };
        let own = rough(scene).filter(|(_, material, _)| material.distribution == self.ndf);
        own.flat_map(of_material).collect()
    }
}

fn because(material: &Material, roughness: Span) -> String {
    let (name, kind, forms) = (&material.name, material.kind.name(), forms(material));
    let ignored = anisotropy(material).map_or(
        "",
        |_| "; its anisotropy is left out of them: the layouts `optimised` and `azimuth` have it",
    );
    let range = roughness.text();
    format!("{name}: {kind} with a rough specular lobe (roughness {range}) wants {forms}{ignored}")
}

/// The forms of approximation of the isotropic lobe that a material wants, in words. It wants at
/// least one.
fn forms(material: &Material) -> &'static str {
    match (table::wanted(material, 2).count(), material.wants.fit.is_some()) {
        (0, _) => "fits",
        (1, true) => "a table and fits",
        (1, false) => "a table",
        (_, true) => "tables and fits",
        (_, false) => "tables",
    }
}

impl Reflection {
    /// Materials that ask for it and are smooth throughout.
    pub(super) fn unserved_smooth(&self, scene: &Scene) -> Option<String> {
        let asks = |m: &Material| m.wants.fit.is_some() || table::wanted(m, 2).next().is_some();
        let own = scene.materials.iter().filter(|m| !m.lobe().is_glass() && m.distribution == self.ndf);
        let smooth: Vec<&Material> = own.filter(|m| asks(m) && !is_rough(scene, m)).collect();
        about(&smooth, stay_smooth)
    }

    /// Why no material calls for it.
    pub(super) fn why_not(&self, scene: &Scene) -> String {
        if scene.materials.is_empty() {
            return "no material has a lobe".into();
        }
        let own = scene.materials.iter().filter(|m| m.distribution == self.ndf);
        let (rough, smooth): (Vec<&Material>, Vec<&Material>) = own.partition(|m| is_rough(scene, m));
        if rough.is_empty() && smooth.is_empty() {
            return no_distribution(self.ndf, "material");
        }
        if rough.is_empty() {
            return format!("no material has a rough specular lobe: {}", stay_smooth(&smooth));
        }
        // What is rough and is not of this effect is anisotropic or glass, or wants other things alone.
        let (glass, others): (Vec<&Material>, Vec<&Material>) =
            rough.into_iter().partition(|m| m.lobe().is_glass());
        let (isotropic, anisotropic): (Vec<&Material>, Vec<&Material>) =
            others.into_iter().partition(|m| m.lobe() == Lobe::Isotropic);
        let unwanted = |m: &[&Material]| {
            format!("{} {} anisotropic and {} tables of that", named(m), verb(m, "are"), verb(m, "want"))
        };
        let (exact, other): (Vec<&Material>, Vec<&Material>) =
            isotropic.into_iter().partition(|m| m.wants.exact_fresnel.is_some());
        let why = reasons([
            about(&anisotropic, unwanted),
            about(&exact, |m| format!("{} {} the exact Fresnel term alone", named(m), verb(m, "want"))),
            about(&other, |m| format!("{} {} other things alone", named(m), verb(m, "want"))),
            about(&glass, |m| format!("{} {} light", named(m), verb(m, "transmit"))),
            about(&smooth, stay_smooth),
        ]);
        format!("no material wants a table or fits of a lobe that only reflects: {}", why.unwrap_or_default())
    }
}

/// The jobs of tables, and that of fits.
pub(super) fn parted(jobs: &[Job]) -> (&[Job], Option<&Job>) {
    match jobs.split_last() {
        Some((fits, tables)) if fits.name == FITS => (tables, Some(fits)),
        _ => (jobs, None),
    }
}

/// Whether its call is the form for three channels; that of one that is mixed is N itself.
pub(super) fn is_coloured(material: &Material) -> bool {
    material.specular() == Specular::Compensated && material.mixed.is_none()
}

impl FitJob {
    /// What the materials of a job of fits want.
    pub fn of(scene: &Scene, job: &Job) -> FitJob {
        let wants = |demand: &Demand| scene.materials.get(demand.of)?.wants.fit.as_ref();
        let materials = job.demands.iter().filter_map(|demand| scene.materials.get(demand.of));
        let (mut coloured, mut mixed) = (false, Vec::new());
        for material in materials {
            coloured |= is_coloured(material);
            mixed.extend(material.mixed.as_ref().map(|own| own.specular));
        }
        mixed.sort();
        mixed.dedup();
        let mut fits = FitJob { coloured, mixed, ..FitJob::default() };
        for want in job.demands.iter().filter_map(wants) {
            fits.average |= want.average;
            fits.multiscatter |= want.multiscatter;
            fits.blend |= want.blend;
            let new = want.hypotheses.iter().filter(|path| !fits.hypotheses.contains(path));
            let new: Vec<String> = new.cloned().collect();
            fits.hypotheses.extend(new);
        }
        fits
    }
}

impl Reflection {
    /// What a plan says of the tables and of the fits.
    pub(super) fn summaries(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        let (tables, fits) = parted(jobs);
        let tables = table::summaries(self, scene, tables);
        tables.into_iter().chain(fits.map(|job| self.fit_summary(scene, job))).collect()
    }

    fn fit_summary(&self, scene: &Scene, job: &Job) -> JobSummary {
        let wants = FitJob::of(scene, job);
        let more = match (wants.average, wants.blend) {
            (true, true) => ", of the average albedo and of f0 A + B",
            (true, false) => " and of the average albedo",
            (false, true) => " and of f0 A + B",
            (false, false) => "",
        };
        let summary =
            JobSummary::fits(job, &format!("the normalisation{more}"), self.fit_seconds(scene, job, &wants));
        if !wants.hypotheses.is_empty() {
            return summary;
        }
        let summary = summary.doubting(job, Formulas::of(self.normalisations));
        JobSummary { doubt: summary.doubt.or_else(|| self.doubt(scene, job)), ..summary }
    }

    /// What the errors [`REACHED`] say against the goals of a job of normalisations in their domain: what is
    /// reached within the budget, and which budget reaches the limit. `bake` knows: it fits them over the
    /// job's own region.
    fn doubt(&self, scene: &Scene, job: &Job) -> Option<String> {
        let [roughness, mu] = [job.range("roughness").ok()?, job.range("mu").ok()?];
        let is_known = scene.smith == Smith::Correlated && scene.alpha == AlphaMap::RoughnessSquared;
        // Of one roughness other formulas are taken.
        if !is_known || roughness[0] == roughness[1] || roughness[0] < 0.02 || mu[0] < 0.01 {
            return None;
        }
        let Budget { max_ops, call } = job.budget();
        let most = max_ops.unwrap_or(u32::MAX);
        let (ops, least) = self.reached.iter().rfind(|(ops, _)| call.ops(*ops) <= most)?;
        let limit = job.goals.max_error.filter(|limit| limit < least)?;
        let keeps = self.reached.iter().find(|(_, error)| *error <= limit);
        let instead = keeps.map_or(
            ", and no formula less: `bake` fails, and names the table that keeps it".into(),
            |(ops, error)| format!(", {} reach {error}", call.ops(*ops)),
        );
        Some(format!(
            "max_error {limit} is doubtful: over roughness 0.02 to 1, {} operations reach {least}{instead}",
            call.ops(*ops)
        ))
    }
}

/// Seconds of table job `i` on one core. The truth at the points of a region is computed once, for
/// the first of the tables that are measured there.
pub(super) fn table_seconds(i: usize, jobs: &[TableJob], price: &TruthPrice) -> f64 {
    let job = &jobs[i];
    let texels = if job.want.size.is_none() { AUTO_TEXELS } else { job.texels() as f64 };
    let own = texels * texel_seconds(job);
    if jobs[..i].iter().any(|other| other.region.roughness == job.region.roughness) {
        return own;
    }
    let split =
        |j: &TableJob| j.region.roughness == job.region.roughness && j.want.serves == Serves::SplitSum;
    own + JUDGED * price.judged[usize::from(jobs.iter().any(split))]
}

/// Seconds of an optimised texel.
fn texel_seconds(job: &TableJob) -> f64 {
    match job.want.serves {
        Serves::Albedo => TEXEL_E_S,
        Serves::SplitSum => TEXEL_SPLIT_S,
    }
}

impl Reflection {
    /// Seconds of a fit job on one core: the truth at the points of the certificates, which all
    /// normalisations share; the searches; a certificate for every fit and for the published formulas.
    fn fit_seconds(&self, scene: &Scene, job: &Job, wants: &FitJob) -> f64 {
        let norms = job.goals.norms.len();
        let normalisations = job.formulas(Formulas::of(self.normalisations)).len() + wants.hypotheses.len();
        let averages = if wants.average { self.averages.len() } else { 0 };
        let searches = ((normalisations + averages) * norms) as f64;
        let certificates = searches + (self.seeds.len() + self.published.len()) as f64;
        let blends = if wants.blend {
            self.price.blends + (self.blends.len() * norms) as f64 * BLEND_FIT_S
        } else {
            0.0
        };
        let width = job.range("roughness").map_or(NARROW.0, |[low, high]| high - low);
        // Of one roughness the formulas are of the cosine alone, each a linear program.
        let narrow = if width > 0.0 { NARROW.1 * log(NARROW.0 / width).max(0.0) } else { 0.0 };
        let search = OPTIMISE_S * (1.0 + narrow);
        let Emission { pick, shown, .. } = job.emission(scene, self.roles[0]);
        let made = if shown || pick != Pick::Best { 1.0 } else { UNSHOWN };
        CERTIFIED * self.price.certified
            + made * (searches * search + certificates * CERTIFIED * EVALUATION_S)
            + blends
    }
}
