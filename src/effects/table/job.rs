//! Tables of three axes that a scene wants of an effect: demands, jobs, and what a plan says of them.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use crate::data::{AlphaMap, Smith, TexelFormat, VolumeLayout};
use crate::effects::demand::{
    Demand, Goals, JUDGED_MU, Job, ROUGHNESS_WIDTH_MIN, Ranges, Span, listed, range_text,
};
use crate::effects::who::rough;
use crate::effects::{BakeError, JobSummary};
use crate::scene::limits::{GLASS_IOR, PATH_TRACER_IOR};
use crate::scene::{Lobe, Material, Scene, VolumeWant};
use lobefit_truth::integrate::glass::Side;

/// Narrowest range of anisotropy or index of refraction of a job: one value would leave no axis to interpolate along.
pub const SPAN_WIDTH_MIN: f64 = 0.01;

/// What a table of three axes holds the albedo of, with the hull of the materials' ranges, at least `SPAN_WIDTH_MIN`
/// wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VolumeSpan {
    /// An anisotropic lobe: range of the anisotropy in [0, 1].
    Anisotropy([f64; 2]),
    /// Rough glass: range of the index of refraction in [1, 3].
    Ior([f64; 2]),
}

impl VolumeSpan {
    /// The variable's name: `anisotropy` or `ior`.
    pub fn input(self) -> &'static str {
        match self {
            VolumeSpan::Anisotropy(_) => "anisotropy",
            VolumeSpan::Ior(_) => "ior",
        }
    }

    /// Its range.
    pub fn range(self) -> [f64; 2] {
        match self {
            VolumeSpan::Anisotropy(range) | VolumeSpan::Ior(range) => range,
        }
    }

    /// The same quantity over another range.
    fn over(self, range: [f64; 2]) -> VolumeSpan {
        match self {
            VolumeSpan::Anisotropy(_) => VolumeSpan::Anisotropy(range),
            VolumeSpan::Ior(_) => VolumeSpan::Ior(range),
        }
    }

    /// What a material's tables span; `None` of an isotropic one, which has none.
    pub fn of(material: &Material) -> Option<VolumeSpan> {
        match material.lobe() {
            Lobe::Isotropic => None,
            Lobe::Anisotropic => Some(VolumeSpan::Anisotropy(material.anisotropy)),
            Lobe::Glass => material.ior.map(VolumeSpan::Ior),
        }
    }

    /// The range, at least [`SPAN_WIDTH_MIN`] wide, inside what the layout reaches.
    fn wide(self, layout: VolumeLayout) -> Span {
        let ior = if layout == VolumeLayout::PathTracer { PATH_TRACER_IOR } else { GLASS_IOR };
        match self {
            VolumeSpan::Anisotropy(range) => Span::at_least(range, SPAN_WIDTH_MIN, [0.0, 1.0]),
            VolumeSpan::Ior(range) => Span::at_least(range, SPAN_WIDTH_MIN, [1.0, ior]),
        }
    }
}

/// One table of a [`VolumeJob`].
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeTable {
    /// Name, unique in its plan: `ggx-aniso-correlated-64x64x32`, `ggx-glass-inside-correlated-128x128x32`,
    /// `path-tracer-reflection-separable-64x64x32`, with `-azimuth` before the shadowing form and `-f32` at the end
    /// where they apply.
    pub name: String,
    /// Where the ray comes from; `None` of an anisotropic lobe.
    pub side: Option<Side>,
}

/// The tables of three axes to bake for all materials that want the same size, format and layout: one of an anisotropic
/// lobe, of rough glass one for each side.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeJob {
    /// The tables; of glass outside, inside. All of the same size.
    pub tables: Vec<VolumeTable>,
    /// Shadowing form: the scene's; separable in the path tracer's layout.
    pub smith: Smith,
    /// How roughness becomes alpha: as the scene says; alpha = roughness in the path tracer's layout.
    pub alpha_map: AlphaMap,
    /// Coordinates.
    pub layout: VolumeLayout,
    /// Columns, rows and slices.
    pub size: [usize; 3],
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Roughness that the rows span: the hull of the materials' rough ranges, at least `ROUGHNESS_WIDTH_MIN` wide, from alpha = 4e-4 on.
    pub roughness: [f64; 2],
    /// The lobe and its range.
    pub span: VolumeSpan,
    /// Limit on the error of the trilinear lookup: the strictest of the materials'. `None` in the path tracer's layout.
    pub max_error: Option<f64>,
    /// The materials that set `max_error`, with the field of each: `gold (materials[0].wants.tables[1].max_error)`.
    pub limited_by: String,
    /// The materials whose limits cannot be judged, since their roughness lies below all rows; none where all can.
    pub unjudged_by: Option<String>,
}

/// What the materials of a lobe want.
pub fn demands(scene: &Scene, lobe: Lobe) -> Vec<Demand> {
    let materials = rough(scene).filter(|(_, material, _)| material.lobe() == lobe);
    let of_material = |(i, material, _): (usize, &Material, [f64; 2])| {
        let wants = material.wants.tables.iter().enumerate();
        let one = |(j, want): (usize, &VolumeWant)| demand(scene, (i, material), (j, want));
        wants.filter_map(one).collect::<Vec<Demand>>()
    };
    materials.flat_map(of_material).collect()
}

/// The Smith form of a layout, and its roughness to alpha. In the path tracer's layout alpha = roughness, which is rough wherever
/// another map is: its alpha is the largest.
fn conventions(scene: &Scene, layout: VolumeLayout) -> (Smith, AlphaMap) {
    match layout {
        VolumeLayout::PathTracer => (Smith::Separable, AlphaMap::Roughness),
        VolumeLayout::Optimised | VolumeLayout::Azimuth => (scene.smith, scene.alpha),
    }
}

fn demand(
    scene: &Scene,
    (of, material): (usize, &Material),
    (item, want): (usize, &VolumeWant),
) -> Option<Demand> {
    let span = VolumeSpan::of(material)?;
    let (smith, alpha_map) = conventions(scene, want.layout);
    let names: Vec<String> = tables(span, smith, want).into_iter().map(|table| table.name).collect();
    let mut spans = BTreeMap::from([
        ("mu", Span::new(JUDGED_MU)),
        ("roughness", rows(material.rough_range(alpha_map)?, alpha_map)),
        (span.input(), span.wide(want.layout)),
    ]);
    if want.layout == VolumeLayout::Azimuth {
        // The albedo is even about both tangents.
        spans.insert("phi", Span::new([0.0, FRAC_PI_2]));
    }
    Some(Demand {
        job: names.join(" "),
        rank: 0,
        of,
        item,
        name: material.name.clone(),
        field: format!("materials[{of}].wants.tables[{item}]"),
        because: because(scene, material, span)?,
        spans,
        goals: Goals::error(want.max_error),
    })
}

impl VolumeJob {
    /// The tables of a job.
    ///
    /// # Errors
    /// A job of other demands than [`demands`] makes: a defect of the effect.
    pub fn of(scene: &Scene, job: &Job) -> Result<VolumeJob, BakeError> {
        let lacks = || BakeError::Internal(format!("{}: no table is wanted", job.name));
        let wants = |demand: &Demand| {
            let material = scene.materials.get(demand.of)?;
            Some((material, material.wants.tables.get(demand.item)?))
        };
        let (material, want) = job.demands.first().and_then(wants).ok_or_else(lacks)?;
        let span = VolumeSpan::of(material).ok_or_else(lacks)?;
        let (smith, alpha_map) = conventions(scene, want.layout);
        let below = |demand: &&Demand| {
            let range = wants(demand).and_then(|(material, _)| material.rough_range(alpha_map));
            demand.goals.max_error.is_some() && range.is_some_and(|r| r[1] < smallest_row(alpha_map))
        };
        let unjudged: Vec<_> = job.demands.iter().filter(below).map(Demand::limit).collect();
        Ok(VolumeJob {
            tables: tables(span, smith, want),
            smith,
            alpha_map,
            layout: want.layout,
            size: want.size,
            format: want.format,
            roughness: job.range("roughness")?,
            span: span.over(job.range(span.input())?),
            max_error: job.goals.max_error,
            limited_by: job.limited_by(),
            unjudged_by: (!unjudged.is_empty()).then(|| listed(&unjudged)),
        })
    }

    /// Those of all jobs.
    ///
    /// # Errors
    /// As [`VolumeJob::of`].
    pub fn all(scene: &Scene, jobs: &[Job]) -> Result<Vec<VolumeJob>, BakeError> {
        jobs.iter().map(|job| VolumeJob::of(scene, job)).collect()
    }

    /// Texels of one of its tables.
    pub fn texels(&self) -> usize {
        self.size.iter().product()
    }

    /// Bytes of the texels of one of its tables, all channels.
    fn bytes(&self) -> u64 {
        self.texels() as u64 * self.layout.channels() * self.format.bytes()
    }
}

/// Smallest roughness of a table of three axes: that of alpha = 4e-4, where its integrals begin. Below it a lookup clamps to the edge,
/// and the lobe is so narrow that its loss matters at grazing views alone.
fn smallest_row(map: AlphaMap) -> f64 {
    map.roughness(4e-4)
}

/// The roughness that the rows span: at least `ROUGHNESS_WIDTH_MIN` wide, from the smallest row on.
fn rows(range: [f64; 2], map: AlphaMap) -> Span {
    let least = smallest_row(map);
    Span::at_least(range.map(|r| r.max(least)), ROUGHNESS_WIDTH_MIN, [least, 1.0])
}

/// Tables and names of a job: what tells it from another one of the scene, and the defaults not at all.
fn tables(span: VolumeSpan, smith: Smith, want: &VolumeWant) -> Vec<VolumeTable> {
    let [columns, rows, slices] = want.size;
    let format =
        if want.format == TexelFormat::F16 { String::new() } else { format!("-{}", want.format.name()) };
    let shape = format!("{}-{columns}x{rows}x{slices}{format}", smith.name());
    let path_tracer = want.layout == VolumeLayout::PathTracer;
    match span {
        VolumeSpan::Anisotropy(_) => {
            let family = match want.layout {
                VolumeLayout::Optimised => "ggx-aniso",
                VolumeLayout::Azimuth => "ggx-aniso-azimuth",
                VolumeLayout::PathTracer => "path-tracer-reflection",
            };
            vec![VolumeTable { name: format!("{family}-{shape}"), side: None }]
        }
        VolumeSpan::Ior(_) => {
            let family = if path_tracer { "path-tracer-glass" } else { "ggx-glass" };
            let sides = [Side::Outside, Side::Inside].into_iter();
            sides
                .map(|side| VolumeTable {
                    name: format!("{family}-{}-{shape}", side.name()),
                    side: Some(side),
                })
                .collect()
        }
    }
}

/// `None` of a material that is nowhere rough.
fn because(scene: &Scene, material: &Material, span: VolumeSpan) -> Option<String> {
    let (name, kind) = (&material.name, material.kind.name());
    let lobe = match span {
        VolumeSpan::Anisotropy(_) => "a rough anisotropic lobe",
        VolumeSpan::Ior(_) => "a rough surface that transmits",
    };
    // Of several tables, what those in the scene's own roughness hold.
    let theirs = material.wants.tables.iter().all(|want| want.layout == VolumeLayout::PathTracer);
    let map = if theirs { AlphaMap::Roughness } else { scene.alpha };
    let roughness = rows_text(material.rough_range(map)?, map);
    let range = span.wide(VolumeLayout::default()).text();
    let (input, forms) = (span.input(), forms(&material.wants.tables));
    Some(format!("{name}: {kind} with {lobe} (roughness {roughness}; {input} {range}) wants {forms}"))
}

/// A material's roughness and what rows hold of it: `0.3, widened to 0.295 to 0.305`, `0.01 to 1, in rows from 0.02 on, to which a
/// lookup below clamps`.
fn rows_text(range: [f64; 2], map: AlphaMap) -> String {
    let span = rows(range, map);
    let (own, rows) = (range_text(range), span.widened());
    if rows[0] <= range[0] {
        span.text()
    } else if range[1] < rows[0] {
        format!(
            "{own}, all below the rows, which begin at {}: every lookup clamps and none is judged",
            rows[0]
        )
    } else {
        format!("{own}, in rows from {} on, to which a lookup below clamps", rows[0])
    }
}

/// `a table in the optimised layout`, `tables in the optimised and path-tracer layouts`.
fn forms(wants: &[VolumeWant]) -> String {
    let mut layouts: Vec<&str> = Vec::new();
    for want in wants {
        if !layouts.contains(&want.layout.name()) {
            layouts.push(want.layout.name());
        }
    }
    let tables = if wants.len() == 1 { "a table" } else { "tables" };
    match layouts.split_last() {
        Some((last, [])) => format!("{tables} in the {last} layout"),
        Some((last, others)) => format!("{tables} in the {} and {last} layouts", others.join(", ")),
        None => tables.into(),
    }
}

/// What a plan says of the tables of jobs, each of which takes so many seconds.
pub fn summaries(scene: &Scene, jobs: &[Job], seconds: fn(&VolumeJob) -> f64) -> Vec<JobSummary> {
    let known = jobs.iter().filter_map(|job| Some((job, VolumeJob::of(scene, job).ok()?)));
    let of_job = |(job, volume): (&Job, VolumeJob)| {
        let one = |table: &VolumeTable| summary(&job.ranges, &volume, table, seconds(&volume));
        volume.tables.iter().map(one).collect::<Vec<JobSummary>>()
    };
    known.flat_map(of_job).collect()
}

fn summary(ranges: &Ranges, job: &VolumeJob, table: &VolumeTable, seconds: f64) -> JobSummary {
    let [columns, rows, slices] = job.size;
    let (format, layout) = (job.format.name(), job.layout.name());
    let of = match (table.side, job.layout) {
        (Some(side), _) => format!("of glass for rays from {}", side.name()),
        (None, VolumeLayout::Azimuth) => "of the anisotropic lobe with its azimuth".into(),
        (None, _) => "of the anisotropic lobe, mean over the azimuth".into(),
    };
    let fixed = if job.layout == VolumeLayout::PathTracer {
        format!(" ({} Smith, alpha = {})", job.smith.name(), job.alpha_map.name())
    } else {
        String::new()
    };
    JobSummary {
        name: table.name.clone(),
        approximation: format!("table {columns}x{rows}x{slices} {format}, {layout} layout{fixed}, {of}"),
        ranges: ranges.clone(),
        bytes: job.bytes(),
        bytes_at_most: false,
        expected_error: job.max_error,
        seconds,
    }
}
