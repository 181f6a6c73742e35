//! The effect `ltc`: linearly transformed cosines, by which polygonal lights are shaded. A pair of
//! tables of a lobe: matrices, and what their shares of a light are scaled by.

mod bake;
mod engines;
mod page;

use super::context::Context;
use super::demand::{Demand, Job, ROUGHNESS_WIDTH_MIN, Span};
use super::effect::Profile;
use super::who::{self, about, anisotropy, verb};
use super::{BakeError, Called, Effect, JobSummary, Made, ggx};
use crate::approximate::CallOps;
use crate::data::{Engine, Layout};
use crate::scene::{Goals, Material, Scene, TableWant};
use bake::Baked;
use lobefit_ltc::{FUNCTIONS, Lobe, LtcError, QUAD, Quad, TEXT};
use lobefit_shade::round_up;

/// The effect.
pub struct Ltc;

/// Seconds on one core of a texel, and of measuring a pair: of GGX, of Charlie.
const SECONDS: [[f64; 2]; 2] = [[1e-3, 5.0], [1.5e-3, 20.0]];

/// What the error of a matrix is of.
const METRIC: &str = "share of the lobe's light that a square light is off by";

impl From<LtcError> for BakeError {
    fn from(error: LtcError) -> BakeError {
        BakeError::Effect(Box::new(error))
    }
}

/// The pairs that a material wants of its specular lobe and of its sheen, each with the roughness of
/// that, the layer, and its place.
fn wanted<'a>(
    scene: &'a Scene,
    material: &'a Material,
) -> impl Iterator<Item = (Lobe, [f64; 2], usize, &'a TableWant)> {
    let own = material.rough_range(scene.alpha);
    let specular =
        own.into_iter().flat_map(|range| of(Lobe::Ggx(scene.smith), range, &material.wants.tables));
    let least = scene.alpha.roughness(Lobe::Charlie.least());
    let sheen = material.sheen.iter().filter(move |s| s.roughness[1] >= least);
    let sheen = sheen.map(move |s| (s, [s.roughness[0].max(least), s.roughness[1]]));
    specular.chain(sheen.flat_map(|(sheen, range)| of(Lobe::Charlie, range, &sheen.tables)))
}

fn of(
    lobe: Lobe,
    range: [f64; 2],
    tables: &[TableWant],
) -> impl Iterator<Item = (Lobe, [f64; 2], usize, &TableWant)> {
    let pairs = tables.iter().enumerate().filter(|(_, table)| table.layout == Layout::AreaLights);
    pairs.map(move |(item, want)| (lobe, range, item, want))
}

/// Its place in a material, its layer.
fn field(lobe: Lobe) -> (&'static str, Option<&'static str>) {
    if lobe == Lobe::Charlie { ("sheen", Some("sheen")) } else { ("wants", None) }
}

/// The lobe and the want of a demand.
fn of_demand<'a>(scene: &'a Scene, demand: &Demand) -> Option<(Lobe, &'a TableWant)> {
    let mut all = wanted(scene, scene.materials.get(demand.of)?);
    let own = all.find(|(lobe, _, item, _)| (field(*lobe).1, *item) == (demand.layer, demand.item));
    own.map(|(lobe, _, _, want)| (lobe, want))
}

/// The lobe and the want of a job.
fn of_job<'a>(scene: &'a Scene, job: &Job) -> Result<(Lobe, &'a TableWant), BakeError> {
    let found = job.demands.first().and_then(|demand| of_demand(scene, demand));
    let lacks = || BakeError::Internal(format!("{}: no pair is wanted", job.name));
    found.ok_or_else(lacks)
}

/// The engines whose files the demands of a job ask for.
fn engines(scene: &Scene, job: &Job) -> Vec<Engine> {
    let wants = || job.demands.iter().filter_map(|demand| of_demand(scene, demand));
    let asked = |engine: &Engine| wants().any(|(_, want)| want.engines.contains(engine));
    Engine::ALL.into_iter().filter(asked).collect()
}

/// The files for engines beside the tables, in a plan.
fn for_engines(scene: &Scene, job: &Job) -> String {
    let names: Vec<&str> = engines(scene, job).into_iter().map(Engine::name).collect();
    if names.is_empty() { String::new() } else { format!(", and the files of {}", names.join(", ")) }
}

/// Texels along both axes.
fn side(want: &TableWant) -> usize {
    let stated = want.size.as_ref().and_then(|size| size.first()).copied().unwrap_or(lobefit_ltc::SIDE);
    lobefit_ltc::side_within(stated, want.format.bytes(), want.max_bytes.unwrap_or(u64::MAX))
}

/// `ggx-ltc-correlated-64x64`.
fn named(lobe: Lobe, want: &TableWant) -> String {
    let smith = if let Lobe::Ggx(smith) = lobe { format!("-{}", smith.name()) } else { String::new() };
    let (n, format) = (side(want), want.format.name());
    let format = if format == "f16" { String::new() } else { format!("-{format}") };
    format!("{}-ltc{smith}-{n}x{n}{format}", lobe.name())
}

impl Effect for Ltc {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "ltc",
                functions: &FUNCTIONS,
                prefixes: &["ggx_ltc", "sheen_ltc"],
                texts: &[TEXT],
                lobe: |scene| format!("{}; of a sheen Charlie with Neubelt's visibility", ggx(scene)),
                notes: &[(
                    &[QUAD],
                    &[
                        "`ltc_quad` is the share of a lobe's light within a quadrilateral of even radiance, clipped to the horizon: of the matrix that",
                        "`ggx_ltc_matrix` or `sheen_ltc_matrix` fetches, and of its corners, in turn, from the shaded point as (dot(c, t), dot(c, cross(n, t)),",
                        "dot(c, n)), t the tangent towards the view. With the x and y of `ggx_ltc_light` the light is radiance * share * (f0 * (x - y) + y).",
                    ],
                )],
                without: anisotropy,
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let materials = scene.materials.iter().enumerate();
        let all = materials.flat_map(|(of, m)| wanted(scene, m).map(move |pair| (of, m, pair)));
        all.map(|(of, material, (lobe, range, item, want))| {
            let (part, layer) = field(lobe);
            let rough = if layer.is_some() { "rough sheen" } else { "rough specular lobe" };
            let (name, [low, high]) = (material.name.clone(), range);
            Demand {
                job: named(lobe, want).into(),
                rank: usize::from(lobe == Lobe::Charlie),
                of,
                item,
                because: format!(
                    "{name}: {} with a {rough} (roughness {low} to {high}) wants area lights",
                    material.kind.name()
                ),
                name,
                field: format!("materials[{of}].{part}.tables[{item}]"),
                spans: vec![
                    ("mu", Span::new(want.n_dot_v)),
                    (
                        "roughness",
                        Span::at_least(
                            range,
                            ROUGHNESS_WIDTH_MIN,
                            [scene.alpha.roughness(lobe.least()), 1.0],
                        ),
                    ),
                ],
                goals: Goals::error(want.max_error),
                layer,
                call: CallOps::default(),
            }
        })
        .collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        self.unserved(scene).unwrap_or_else(|| "no material wants tables in the `area-lights` layout".into())
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let asks = |m: &&Material| m.tables().any(|(.., table)| table.layout == Layout::AreaLights);
        let asking: Vec<&Material> = scene.materials.iter().filter(asks).collect();
        about(&asking, |m| {
            format!(
                "{} {} smooth for area lights, or a sheen of alpha below 0.01",
                who::named(m),
                verb(m, "are")
            )
        })
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        let one = |job: &Job| {
            let (lobe, want) = of_job(scene, job).ok()?;
            let (n, [texel, measuring]) = (side(want), SECONDS[usize::from(lobe == Lobe::Charlie)]);
            Some(JobSummary {
                name: job.name.clone(),
                approximation: format!(
                    "two tables {n}x{n} {} of a linearly transformed cosine{}",
                    want.format.name(),
                    for_engines(scene, job)
                ),
                ranges: job.ranges.clone(),
                bytes: lobefit_ltc::bytes(n, want.format.bytes()),
                expected_error: job.goals.max_error,
                seconds: texel * (n * n) as f64 + measuring,
                merging: job.merging(),
                ..JobSummary::default()
            })
        };
        jobs.iter().filter_map(one).collect()
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        let mut baked: Vec<Baked> = Vec::new();
        for job in &called.work {
            context.progress.stage(&format!("tables {}", job.name));
            let (lobe, want) = of_job(context.scene, job)?;
            let is_first = baked.iter().all(|known| known.lobe != lobe);
            let stem = if is_first { format!("{}_ltc", lobe.name()) } else { job.name.replace('-', "_") };
            baked.push(bake::bake(job, (lobe, want), &stem, context)?);
        }
        let mut made = Made::new(called, baked.iter().map(Baked::error).reduce(f64::max), METRIC);
        for (job, one) in called.work.iter().zip(&baked) {
            let kept = |limit: f64| one.error() <= limit;
            let broken = job.promises.iter().filter(|promise| !kept(promise.max_error));
            made.broken.extend(broken.map(|promise| {
                let (limit, by) = (promise.max_error, promise.wanted_by());
                format!("table {}: error {} exceeds the max_error {limit} of {by}", job.name, one.error())
            }));
        }
        if !made.broken.is_empty() {
            return Ok(made);
        }
        for (job, one) in called.work.iter().zip(&baked) {
            one.entered(&mut made, job, context)?;
        }
        let off = baked.iter().map(|one| one.measured.code.max).fold(0.0, f64::max);
        let error = format!("In f32 it is off by {} of the light at most, as measured.", round_up(off, 2));
        made.code(context, |language| {
            let lookups: Result<String, BakeError> =
                baked.iter().map(|one| one.code(language, context)).collect();
            Ok(lookups? + &Quad::print(language, &error)?)
        })?;
        if context.reports(called.effect) {
            let figures = page::figures(&made.part.finding, &baked);
            made.page(page::page(context.origin(), &baked, |r| context.scene.alpha.alpha(r))?, &figures)?;
        }
        Ok(made)
    }
}
