//! Materials to jobs: what several of them want alike is planned once.

use std::collections::BTreeMap;

use super::job::{FitJob, FitPromise, Limit, ROUGHNESS_WIDTH_MIN, TableJob};
use crate::data::{AlphaMap, Smith, TexelFormat};
use crate::scene::{Layout, Material, Scene, TableWant, Wants, smallest_rough};

/// The different tables that rough materials want, in order of first mention.
pub(super) fn tables(scene: &Scene) -> Vec<TableJob> {
    let mut jobs: Vec<TableJob> = Vec::new();
    let mut index: BTreeMap<String, usize> = BTreeMap::new();
    for (i, material, roughness) in rough(scene) {
        let Some(want) = &material.wants.table else { continue };
        let name = table_name(scene.smith, want);
        let limit = want.max_error.map(|max_error| Limit {
            material: material.name.clone(),
            field: format!("materials[{i}].wants.table.max_error"),
            max_error,
        });
        match index.get(&name) {
            Some(&known) => {
                let job = &mut jobs[known];
                job.limits.extend(limit);
                job.roughness = hull(job.roughness, roughness);
                job.max_error = strictest(job.max_error, want.max_error);
                job.materials.push(material.name.clone());
            }
            None => {
                index.insert(name.clone(), jobs.len());
                let mut job = table_job(scene, name, want, material, roughness);
                job.limits.extend(limit);
                jobs.push(job);
            }
        }
    }
    for job in &mut jobs {
        job.roughness = widened(job.roughness, scene.alpha);
    }
    jobs
}

fn table_job(
    scene: &Scene,
    name: String,
    want: &TableWant,
    material: &Material,
    roughness: [f64; 2],
) -> TableJob {
    TableJob {
        name,
        smith: scene.smith,
        alpha_map: scene.alpha,
        columns: want.size.map(|s| s[0]),
        rows: want.size.map(|s| s[1]),
        format: want.format,
        layout: want.layout,
        serves: want.serves,
        roughness,
        max_error: want.max_error,
        limits: Vec::new(),
        materials: vec![material.name.clone()],
    }
}

/// Says everything that tells two tables of a scene apart, and the defaults not at all.
fn table_name(smith: Smith, want: &TableWant) -> String {
    let mut name = format!("ggx-dfg-{}-", smith.name());
    match want.size {
        Some([columns, rows]) => name += &format!("{columns}x{rows}"),
        None => name += "auto",
    }
    if want.format != TexelFormat::F16 {
        name = format!("{name}-{}", want.format.name());
    }
    if want.layout != Layout::default() {
        name = format!("{name}-{}", want.layout.name());
    }
    if want.serves != Default::default() {
        name = format!("{name}-{}", want.serves.name());
    }
    name
}

/// The fit that the scene's rough materials want together.
pub(super) fn fit(scene: &Scene) -> Option<FitJob> {
    let mut job: Option<FitJob> = None;
    for (i, material, roughness) in rough(scene) {
        let Some(want) = &material.wants.fit else { continue };
        let job = job.get_or_insert_with(|| FitJob {
            smith: scene.smith,
            alpha_map: scene.alpha,
            roughness,
            mu: scene.mu,
            max_ops: want.max_ops,
            max_error: None,
            promises: Vec::new(),
            norms: Vec::new(),
            average: false,
            blend: false,
            hypotheses: Vec::new(),
            materials: Vec::new(),
        });
        job.roughness = hull(job.roughness, roughness);
        job.max_ops = job.max_ops.zip(want.max_ops).map(|(a, b)| a.max(b));
        job.max_error = strictest(job.max_error, want.max_error);
        job.average |= want.average;
        job.blend |= want.blend;
        job.norms.extend(&want.norms);
        job.norms.sort();
        job.norms.dedup();
        for path in &want.hypotheses {
            if !job.hypotheses.contains(path) {
                job.hypotheses.push(path.clone());
            }
        }
        if let Some(max_error) = want.max_error {
            let field = format!("materials[{i}].wants.fit.max_error");
            promise(
                &mut job.promises,
                want.max_ops,
                Limit { material: material.name.clone(), field, max_error },
            );
        }
        job.materials.push(material.name.clone());
    }
    if let Some(job) = &mut job {
        job.roughness = widened(job.roughness, scene.alpha);
    }
    job
}

/// Adds a material to the promise that is like its own.
pub(super) fn promise(promises: &mut Vec<FitPromise>, max_ops: Option<u32>, limit: Limit) {
    let (max_error, material) = (limit.max_error, limit.material.clone());
    match promises.iter_mut().find(|p| p.max_ops == max_ops && p.max_error == max_error) {
        Some(known) => {
            known.materials.push(material);
            known.limits.push(limit);
        }
        None => {
            promises.push(FitPromise { max_ops, max_error, materials: vec![material], limits: vec![limit] })
        }
    }
}

/// Materials with a rough specular lobe: place in the scene, material, roughness range.
pub(super) fn rough(scene: &Scene) -> impl Iterator<Item = (usize, &Material, [f64; 2])> {
    let materials = scene.materials.iter().enumerate();
    materials.filter_map(|(i, m)| m.rough_range(scene.alpha).map(|range| (i, m, range)))
}

/// Whether a material's lobe is rough somewhere.
pub(super) fn is_rough(scene: &Scene, material: &Material) -> bool {
    material.rough_range(scene.alpha).is_some()
}

/// Those of them that want an approximation of the isotropic lobe.
pub(super) fn isotropic(scene: &Scene) -> impl Iterator<Item = (usize, &Material, [f64; 2])> {
    rough(scene).filter(|(_, m, _)| m.wants.table.is_some() || m.wants.fit.is_some())
}

/// The forms of approximation of the isotropic lobe that a material wants, in words. It wants at least one.
pub(super) fn forms(wants: &Wants) -> &'static str {
    match (wants.table.is_some(), wants.fit.is_some()) {
        (true, true) => "a table and fits",
        (true, false) => "a table",
        (false, _) => "fits",
    }
}

pub(super) fn hull(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

pub(super) fn strictest(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (one, None) | (None, one) => one,
    }
}

/// The range, or where it is narrower than [`ROUGHNESS_WIDTH_MIN`], one of that width about it inside the domain.
pub(super) fn widened(range: [f64; 2], map: AlphaMap) -> [f64; 2] {
    widened_in(range, ROUGHNESS_WIDTH_MIN, [smallest_rough(map), 1.0])
}

/// The range, or where it is narrower than `width`, one of that width about it inside the domain.
pub(super) fn widened_in(range: [f64; 2], width: f64, domain: [f64; 2]) -> [f64; 2] {
    if range[1] - range[0] >= width {
        return range;
    }
    let middle = 0.5 * (range[0] + range[1]);
    let lo = (middle - 0.5 * width).max(domain[0]).min(domain[1] - width);
    [lo.min(range[0]), (lo + width).min(domain[1]).max(range[1])]
}
