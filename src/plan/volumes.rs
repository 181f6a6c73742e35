//! Wanted tables of three axes: materials to jobs, and what a plan says of them.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use super::effect::{Effect, EffectName, JobSummary};
use super::job::{JUDGED_MU, Limit, ROUGHNESS_WIDTH_MIN, SPAN_WIDTH_MIN, VolumeJob, VolumeSpan, VolumeTable};
use super::merge::{hull, rough, strictest, widened_in};
use super::reflection::range_text;
use super::work;
use crate::data::{AlphaMap, Smith, TexelFormat};
use crate::scene::limits::{GLASS_IOR, PATH_TRACER_IOR};
use crate::scene::{Lobe, Material, Scene, VolumeLayout, VolumeWant};
use lobefit_truth::integrate::glass::Side;

/// The different tables of three axes that rough materials want, in order of first mention.
pub(super) fn volumes(scene: &Scene) -> Vec<VolumeJob> {
    let mut jobs: Vec<VolumeJob> = Vec::new();
    let mut index: BTreeMap<String, usize> = BTreeMap::new();
    for (i, material, _) in rough(scene) {
        let Some(span) = span(material) else { continue };
        for (j, want) in material.wants.tables.iter().enumerate() {
            let Some(mut job) = volume_job(scene, material, want, span) else { continue };
            let limit = want.max_error.map(|max_error| Limit {
                material: material.name.clone(),
                field: format!("materials[{i}].wants.tables[{j}].max_error"),
                max_error,
            });
            if job.roughness[1] < smallest_row(job.alpha_map) {
                job.unjudged.extend(limit.clone());
            }
            job.limits.extend(limit);
            let key = job.tables.iter().map(|t| t.name.as_str()).collect::<Vec<_>>().join(" ");
            match index.get(&key) {
                Some(&known) => join(&mut jobs[known], job),
                None => {
                    index.insert(key, jobs.len());
                    jobs.push(job);
                }
            }
        }
    }
    for job in &mut jobs {
        job.roughness = rows(job.roughness, job.alpha_map);
        job.span = wide_span(job.span, job.layout);
    }
    jobs
}

/// Smallest roughness of a table of three axes: that of alpha = 4e-4, where its integrals begin. Below it a lookup clamps to the edge,
/// and the lobe is so narrow that its loss matters at grazing views alone.
fn smallest_row(map: AlphaMap) -> f64 {
    map.roughness(4e-4)
}

/// The roughness that the rows span: at least `ROUGHNESS_WIDTH_MIN` wide, from the smallest row on.
fn rows(range: [f64; 2], map: AlphaMap) -> [f64; 2] {
    let least = smallest_row(map);
    widened_in(range.map(|r| r.max(least)), ROUGHNESS_WIDTH_MIN, [least, 1.0])
}

/// The job of one material alone, without its limit. In the path tracer's layout alpha = roughness, which is rough wherever
/// another map is: its alpha is the largest.
fn volume_job(scene: &Scene, material: &Material, want: &VolumeWant, span: VolumeSpan) -> Option<VolumeJob> {
    let (smith, alpha_map) = match want.layout {
        VolumeLayout::PathTracer => (Smith::Separable, AlphaMap::Roughness),
        VolumeLayout::Optimised | VolumeLayout::Azimuth => (scene.smith, scene.alpha),
    };
    Some(VolumeJob {
        tables: tables(span, smith, want),
        smith,
        alpha_map,
        layout: want.layout,
        size: want.size,
        format: want.format,
        roughness: material.rough_range(alpha_map)?,
        span,
        max_error: want.max_error,
        limits: Vec::new(),
        unjudged: Vec::new(),
        materials: vec![material.name.clone()],
    })
}

/// What a material's tables span; `None` of an isotropic one, which has none.
fn span(material: &Material) -> Option<VolumeSpan> {
    match material.lobe() {
        Lobe::Isotropic => None,
        Lobe::Anisotropic => Some(VolumeSpan::Anisotropy(material.anisotropy)),
        Lobe::Glass => material.ior.map(VolumeSpan::Ior),
    }
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

/// Adds a material's job to the one of the same tables.
fn join(known: &mut VolumeJob, job: VolumeJob) {
    known.roughness = hull(known.roughness, job.roughness);
    known.span = match known.span {
        VolumeSpan::Anisotropy(range) => VolumeSpan::Anisotropy(hull(range, job.span.range())),
        VolumeSpan::Ior(range) => VolumeSpan::Ior(hull(range, job.span.range())),
    };
    known.max_error = strictest(known.max_error, job.max_error);
    known.limits.extend(job.limits);
    known.unjudged.extend(job.unjudged);
    known.materials.extend(job.materials);
}

/// The span, at least [`SPAN_WIDTH_MIN`] wide, inside what the layout reaches.
fn wide_span(span: VolumeSpan, layout: VolumeLayout) -> VolumeSpan {
    let ior = if layout == VolumeLayout::PathTracer { PATH_TRACER_IOR } else { GLASS_IOR };
    let wide = |range, domain| widened_in(range, SPAN_WIDTH_MIN, domain);
    match span {
        VolumeSpan::Anisotropy(range) => VolumeSpan::Anisotropy(wide(range, [0.0, 1.0])),
        VolumeSpan::Ior(range) => VolumeSpan::Ior(wide(range, [1.0, ior])),
    }
}

/// The anisotropy or the glass effect, where a rough material calls for it.
pub(super) fn effect(scene: &Scene, jobs: &[VolumeJob], name: EffectName) -> Option<Effect> {
    let because: Vec<String> = rough(scene)
        .filter(|(_, m, _)| !m.wants.tables.is_empty())
        .filter_map(|(_, m, _)| because(scene, m, span(m).filter(|s| s.effect() == name)?))
        .collect();
    if because.is_empty() {
        return None;
    }
    let own = || jobs.iter().filter(|job| job.span.effect() == name);
    let summaries = own().flat_map(|job| job.tables.iter().map(|table| summary(job, table))).collect();
    Some(Effect::new(name, because, summaries, work::volume_report_seconds(own())))
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
    let range = range_text(span.range(), wide_span(span, VolumeLayout::default()).range());
    let (input, forms) = (span.input(), forms(&material.wants.tables));
    Some(format!("{name}: {kind} with {lobe} (roughness {roughness}; {input} {range}) wants {forms}"))
}

/// A material's roughness and what rows hold of it: `0.3, widened to 0.295 to 0.305`, `0.01 to 1, in rows from 0.02 on, to which a
/// lookup below clamps`.
fn rows_text(range: [f64; 2], map: AlphaMap) -> String {
    let rows = rows(range, map);
    let own = range_text(range, range);
    if rows[0] <= range[0] {
        range_text(range, rows)
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

fn summary(job: &VolumeJob, table: &VolumeTable) -> JobSummary {
    let mut ranges = BTreeMap::from([
        ("mu", JUDGED_MU),
        ("roughness", job.roughness),
        (job.span.input(), job.span.range()),
    ]);
    if job.layout == VolumeLayout::Azimuth {
        // The albedo is even about both tangents.
        ranges.insert("phi", [0.0, FRAC_PI_2]);
    }
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
        ranges,
        bytes: work::volume_bytes(job),
        bytes_at_most: false,
        expected_error: job.max_error,
        seconds: work::volume_seconds(job),
    }
}
