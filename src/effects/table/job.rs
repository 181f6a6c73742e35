//! Tables that a scene wants of an effect: demands, jobs, and what a plan says of them.

use std::f64::consts::FRAC_PI_2;

use super::{Family, Region, SliceAxis, Sliced, Slices};
use crate::approximate;
use crate::data::{AlphaMap, Decode, Layout, Serves, Smith, TexelFormat};
use crate::effects::demand::{Caller, Demand, Job, ROUGHNESS_WIDTH_MIN, Span, listed, range_text};
use crate::effects::who::rough;
use crate::effects::{BakeError, JobSummary};
use crate::emit::lookup::TableNames;
use crate::scene::limits::{GLASS_IOR, PATH_TRACER_IOR, SLICED_ALPHA, SLICED_AXIS_MIN};
use crate::scene::{Goals, Lobe, Material, Scene, TableWant};
use lobefit_truth::integrate::glass::Side;

/// Narrowest range of anisotropy or index of refraction of a job: one value would leave no axis to
/// interpolate along.
pub const SLICES_WIDTH_MIN: f64 = 0.01;

/// Squares tried in turn where the scene leaves the size open.
const SIZES: [usize; 4] = [16, 32, 64, AUTO_SIDE];

/// Side of the largest of them.
pub(super) const AUTO_SIDE: usize = 128;

/// What a plan says of the size that the bake chooses.
pub(super) const OPEN_SIZE: &str = "of the smallest sufficient side of 16, 32, 64 and 128";

/// The tables to bake for all materials that want the same layout, size, format and use: one of a
/// lobe that reflects, of rough glass one for each side.
#[derive(Clone, Debug, PartialEq)]
pub struct TableJob {
    /// Names of the tables, unique in their plan, one for each side: `ggx-dfg-correlated-32x32`,
    /// `ggx-glass-inside-correlated-128x128x32`; `auto` in place of the size where the bake chooses
    /// it, and what differs from the defaults appended (`-f32`, `-plain`, `-split-sum`).
    pub names: Vec<String>,
    /// Shadowing form: the scene's; separable in the path tracer's layout.
    pub smith: Smith,
    /// What is wanted, but for `n_dot_v`, which is each material's own: `max_error` is the strictest of the
    /// materials'.
    pub want: TableWant,
    /// Where lookups must hold: the hulls of the materials' ranges. Roughness spans at least
    /// `ROUGHNESS_WIDTH_MIN`, of tables with slices from alpha = 4e-4 on, slices at least `SLICES_WIDTH_MIN`;
    /// alpha = roughness in the path tracer's layout.
    pub region: Region,
    /// The materials that set `max_error`, with the field of each:
    /// `gold (materials[0].wants.tables[1].max_error)`.
    pub limited_by: String,
    /// The materials whose limits cannot be judged, since their roughness lies below all rows; none
    /// where all can.
    pub unjudged_by: Option<String>,
    /// Names of the materials that want it.
    pub wanted_by: Vec<Caller>,
}

/// What the materials of an effect's lobe want in the layouts that have slices.
pub fn demands<F: Sliced>(family: &F, scene: &Scene) -> Vec<Demand> {
    let own = |m: &Material| m.lobe() == family.lobe() && m.distribution == family.ndf();
    let materials = rough(scene).filter(|(_, material, _)| own(material));
    let of_material = |(of, material, _): (usize, &Material, [f64; 2])| {
        let because = because(family.lobe_text(), scene, material).unwrap_or_default();
        let one = |item| demand(family, scene, (of, material), item, because.clone());
        wanted(material, 3).filter_map(one).collect::<Vec<Demand>>()
    };
    materials.flat_map(of_material).collect()
}

/// The tables of so many axes, or of three and more, that a material wants, with their places in its list.
pub fn wanted(material: &Material, axes: usize) -> impl Iterator<Item = (usize, &TableWant)> {
    let tables = material.wants.tables.iter().enumerate();
    tables.filter(move |(_, want)| want.layout.axes().min(3) == axes && want.layout != Layout::AreaLights)
}

/// The Smith form of a layout, and its roughness to alpha. In the path tracer's layout
/// alpha = roughness, which is rough wherever another map is: its alpha is the largest.
fn conventions(scene: &Scene, layout: Layout) -> (Smith, AlphaMap) {
    match layout {
        Layout::PathTracer => (Smith::Separable, AlphaMap::Roughness),
        _ => (scene.smith, scene.alpha),
    }
}

/// What the slices of a material's tables span, where the layout has slices.
fn slices(material: &Material, layout: Layout) -> Option<Slices> {
    if layout.axes() < 3 {
        return None;
    }
    match material.lobe() {
        Lobe::Isotropic => None,
        Lobe::Anisotropic => Some(Slices { axis: SliceAxis::Anisotropy, range: material.anisotropy }),
        Lobe::Glass | Lobe::AnisotropicGlass => {
            material.ior.map(|range| Slices { axis: SliceAxis::Ior, range })
        }
    }
}

/// The range of slices, inside what the layout reaches and at least [`SLICES_WIDTH_MIN`] wide; of one slice
/// as it is.
pub(super) fn wide(slices: Slices, want: &TableWant) -> Span {
    if want.has_one_slice() {
        return Span::new(slices.range);
    }
    let domain = match slices.axis {
        SliceAxis::Anisotropy => [0.0, 1.0],
        SliceAxis::Ior if want.layout == Layout::PathTracer => [1.0, PATH_TRACER_IOR],
        SliceAxis::Ior => [1.0, GLASS_IOR],
    };
    Span::at_least(slices.range, SLICES_WIDTH_MIN, domain)
}

/// A material's demand for a table, if its lobe is rough.
pub fn demand(
    family: &dyn Family,
    scene: &Scene,
    (of, material): (usize, &Material),
    (item, want): (usize, &TableWant),
    because: String,
) -> Option<Demand> {
    let (smith, alpha_map) = conventions(scene, want.layout);
    let (slices, range) = (slices(material, want.layout), material.rough_range(alpha_map)?);
    let rows = if slices.is_some() { rows(range, alpha_map) } else { Span::roughness(range, alpha_map) };
    let mut spans = vec![("mu", Span::new(want.n_dot_v)), ("roughness", rows)];
    spans.extend(slices.map(|slices| (slices.axis.name(), wide(slices, want))));
    if want.layout == Layout::FiveAxis {
        let anisotropy = Slices { axis: SliceAxis::Anisotropy, range: material.anisotropy };
        spans.push((anisotropy.axis.name(), wide(anisotropy, want)));
    }
    if want.layout.has_azimuth() {
        // The albedo is even about both tangents.
        spans.push(("phi", Span::new([0.0, FRAC_PI_2])));
    }
    Some(Demand {
        job: names(family, smith, want).join(" ").into(),
        of,
        item,
        name: material.name.clone(),
        field: format!("materials[{of}].wants.tables[{item}]"),
        because,
        spans,
        goals: Goals::error(want.max_error),
        ..Demand::default()
    })
}

impl TableJob {
    /// The tables of a job.
    ///
    /// # Errors
    /// A job of other demands than [`demand`] makes: a defect of the effect.
    pub fn of(scene: &Scene, job: &Job) -> Result<TableJob, BakeError> {
        let lacks = || BakeError::Internal(format!("{}: no table is wanted", job.name));
        let wants = |demand: &Demand| {
            let material = scene.materials.get(demand.of)?;
            Some((material, material.wants.tables.get(demand.item)?))
        };
        let (material, want) = job.demands.first().and_then(wants).ok_or_else(lacks)?;
        let slices = slices(material, want.layout);
        let (smith, alpha_map) = conventions(scene, want.layout);
        let below = |demand: &&Demand| {
            let range = wants(demand).and_then(|(material, _)| material.rough_range(alpha_map));
            demand.goals.max_error.is_some() && range.is_some_and(|r| r[1] < smallest_row(alpha_map))
        };
        let unjudged: Vec<_> =
            job.demands.iter().filter(|_| slices.is_some()).filter(below).map(Demand::limit).collect();
        let over = |slices: Slices| job.range(slices.axis.name()).map(|range| Slices { range, ..slices });
        let anisotropy = (want.layout == Layout::FiveAxis).then(|| SliceAxis::Anisotropy.name());
        Ok(TableJob {
            names: job.name.split(' ').map(String::from).collect(),
            smith,
            want: TableWant { max_error: job.goals.max_error, ..want.clone() },
            region: Region {
                roughness: job.range("roughness")?,
                mu: job.range("mu")?,
                slices: slices.map(over).transpose()?,
                anisotropy: anisotropy.map(|name| job.range(name)).transpose()?,
                alpha_map,
            },
            limited_by: job.limited_by(),
            unjudged_by: (!unjudged.is_empty()).then(|| listed(&unjudged)),
            wanted_by: job.callers(),
        })
    }

    /// A job of the default layout, of which the size is open, for a region of roughness and the
    /// cosine.
    pub fn open(scene: &Scene, roughness: [f64; 2], mu: [f64; 2]) -> TableJob {
        let open = TableWant::flat(Layout::Homogeneous, [AUTO_SIDE; 2], TexelFormat::F16);
        let (smith, alpha_map) = conventions(scene, open.layout);
        TableJob {
            names: vec!["auto".into()],
            smith,
            want: TableWant { size: None, ..open },
            region: approximate::Region { roughness, mu, alpha_map }.into(),
            limited_by: String::new(),
            unjudged_by: None,
            wanted_by: Vec::new(),
        }
    }

    /// Those of all jobs.
    ///
    /// # Errors
    /// As [`TableJob::of`].
    pub fn all(scene: &Scene, jobs: &[Job]) -> Result<Vec<TableJob>, BakeError> {
        jobs.iter().map(|job| TableJob::of(scene, job)).collect()
    }

    /// A size as its tables' names have it. Where the bake chose the size, and another of the jobs
    /// asks for it by name, the size says so.
    pub(super) fn sized(&self, size: &[usize], jobs: &[TableJob]) -> String {
        let text = size_text(size);
        let named = |text: &str| self.names.iter().map(|name| name.replace("auto", text)).collect::<Vec<_>>();
        let taken = self.is_open() && jobs.iter().any(|other| other.names == named(&text));
        if taken { format!("{text}-auto") } else { text }
    }

    /// Names of the functions of its tables, baked in a size: by their role, to which tables that
    /// are not the first of it among the jobs append what tells them apart.
    pub(super) fn functions(&self, family: &dyn Family, size: &str, before: &[TableJob]) -> Vec<TableNames> {
        let role = |job: &TableJob| family.role(job.want.layout, job.want.serves);
        let stem = match before.iter().any(|other| role(other) == role(self)) {
            true => format!("{}_{}", role(self), shape(size, self.want.format, self.want.layout)),
            false => role(self).to_string(),
        };
        let stem = stem.replace('-', "_");
        let named = |side: &Option<Side>| {
            let side = side.map_or_else(String::new, |side| format!("_{}", side.name()));
            TableNames { lookup: format!("{stem}{side}"), stem: stem.clone() }
        };
        family.sides().iter().map(named).collect()
    }

    /// Texels of one of its tables; of the largest where the size is open.
    pub fn texels(&self) -> usize {
        self.want.size.as_ref().map_or(AUTO_SIDE * AUTO_SIDE, |size| size.iter().product())
    }

    /// Bytes of the texels of one of its tables, all channels.
    fn bytes(&self) -> u64 {
        self.bytes_of(self.texels())
    }

    fn bytes_of(&self, texels: usize) -> u64 {
        let channels = Decode::of(self.want.layout, self.want.serves).channels();
        (texels * channels) as u64 * self.want.format.bytes()
    }

    /// Whether the bake chooses the size.
    fn is_open(&self) -> bool {
        self.want.size.is_none() || self.want.max_bytes.is_some()
    }

    /// The sizes that are tried in turn: the one that is asked for, or squares, or of three axes
    /// halves of the largest; those within the bytes, and the smallest where all take more.
    pub(super) fn sizes(&self) -> Vec<Vec<usize>> {
        let halves = |size: &Vec<usize>| -> Vec<Vec<usize>> {
            let least = |n: usize| n.min(SLICED_AXIS_MIN);
            let part = |by: usize| size.iter().map(|n| (n / by).max(least(*n))).collect();
            [4, 2, 1].map(part).to_vec()
        };
        let mut sizes = match (&self.want.size, self.want.max_bytes) {
            (None, _) => SIZES.map(|n| vec![n, n]).to_vec(),
            (Some(size), Some(_)) => halves(size),
            (Some(size), None) => vec![size.clone()],
        };
        let most = self.want.max_bytes.unwrap_or(u64::MAX);
        let within = sizes.iter().filter(|size| self.bytes_of(size.iter().product()) <= most).count();
        sizes.truncate(within.max(1));
        sizes
    }
}

/// Smallest roughness of a table with slices: that of alpha = 4e-4, where its integrals begin.
/// Below it a lookup clamps to the edge, and the lobe is so narrow that its loss matters at grazing
/// views alone.
fn smallest_row(map: AlphaMap) -> f64 {
    map.roughness(SLICED_ALPHA)
}

/// The roughness that the rows of a table with slices span: at least `ROUGHNESS_WIDTH_MIN` wide,
/// from the smallest row on.
fn rows(range: [f64; 2], map: AlphaMap) -> Span {
    let least = smallest_row(map);
    Span::at_least(range.map(|r| r.max(least)), ROUGHNESS_WIDTH_MIN, [least, 1.0])
}

/// `64x64x32`; of one slice `64x64`.
pub(super) fn size_text(size: &[usize]) -> String {
    let size = size.strip_suffix(&[1]).unwrap_or(size);
    size.iter().map(ToString::to_string).collect::<Vec<_>>().join("x")
}

/// What tells a table from others of its role: its size, and of format and layout what is not the
/// default.
pub(super) fn shape(size: &str, format: TexelFormat, layout: Layout) -> String {
    let mut shape = size.to_string();
    if format != TexelFormat::F16 {
        shape = format!("{shape}-{}", format.name());
    }
    if matches!(layout, Layout::Plain | Layout::PlainSquared) {
        shape = format!("{shape}-{}", layout.name());
    }
    shape
}

/// Names of a family's tables: what tells them from others of the scene, and the defaults not at
/// all.
fn names(family: &dyn Family, smith: Smith, want: &TableWant) -> Vec<String> {
    let stated = want.size.as_ref().filter(|_| want.max_bytes.is_none());
    let size = stated.map_or_else(|| "auto".into(), |size| size_text(size));
    let mut shape = format!("{}-{}", smith.name(), shape(&size, want.format, want.layout));
    if want.serves != Serves::default() {
        shape = format!("{shape}-{}", want.serves.name());
    }
    let prefix = family.prefix(want.layout);
    let name = |side: &Option<Side>| match side {
        Some(side) => format!("{prefix}-{}-{shape}", side.name()),
        None => format!("{prefix}-{shape}"),
    };
    family.sides().iter().map(name).collect()
}

/// Why a material calls for tables with slices; `None` of a material that is nowhere rough, or
/// wants none.
fn because(lobe: &str, scene: &Scene, material: &Material) -> Option<String> {
    let wants: Vec<&TableWant> = wanted(material, 3).map(|(_, want)| want).collect();
    let first = wants.first()?;
    let slices = slices(material, first.layout)?;
    let (name, kind) = (&material.name, material.kind.name());
    // Of several tables, what those in the scene's own roughness hold.
    let path_tracer = wants.iter().all(|want| want.layout == Layout::PathTracer);
    let map = if path_tracer { AlphaMap::Roughness } else { scene.alpha };
    let roughness = rows_text(material.rough_range(map)?, map);
    let range = wide(slices, first).text();
    let (input, forms) = (slices.axis.name(), forms(&wants));
    Some(format!("{name}: {kind} with {lobe} (roughness {roughness}; {input} {range}) wants {forms}"))
}

/// A material's roughness and what rows hold of it: `0.3, widened to 0.295 to 0.305`,
/// `0.01 to 1, in rows from 0.02 on, to which a lookup below clamps`.
fn rows_text(range: [f64; 2], map: AlphaMap) -> String {
    let span = rows(range, map);
    let (own, rows) = (range_text(range), span.widened());
    if rows[0] <= range[0] {
        span.text()
    } else if range[1] < rows[0] {
        format!(
            "{own}, all below the rows, which begin at {}: every lookup clamps, and is not judged",
            rows[0]
        )
    } else {
        format!("{own}, in rows from {} on, to which a lookup below clamps", rows[0])
    }
}

/// `a table in the optimised layout`, `tables in the optimised and path-tracer layouts`.
fn forms(wants: &[&TableWant]) -> String {
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

/// What a plan says of the tables of jobs.
pub fn summaries(family: &dyn Family, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
    let (mut known, mut tables, mut defects) = (Vec::new(), Vec::new(), Vec::new());
    for job in jobs {
        match TableJob::of(scene, job) {
            Ok(table) => {
                known.push(job);
                tables.push(table);
            }
            // The bake ends with this error.
            Err(error) => defects
                .push(JobSummary { approximation: error.to_string(), ..JobSummary::fits(job, "", 0.0) }),
        }
    }
    let jobs = known;
    let of_job = |i: usize| {
        let (ranges, job, seconds) = (&jobs[i].ranges, &tables[i], family.seconds(i, &tables));
        let named = job.names.iter().zip(family.sides());
        named.map(move |(name, side)| JobSummary {
            name: name.clone(),
            approximation: summary(family, job, *side),
            ranges: ranges.clone(),
            bytes: job.bytes(),
            bytes_at_most: job.is_open(),
            expected_error: job.want.max_error,
            seconds,
            ..JobSummary::default()
        })
    };
    (0..jobs.len()).flat_map(of_job).chain(defects).collect()
}

/// `table 32x32 f16, homogeneous layout, for albedo`.
fn summary(family: &dyn Family, job: &TableJob, side: Option<Side>) -> String {
    let size = job.want.size.as_ref().map_or_else(|| OPEN_SIZE.into(), |n| size_text(n));
    let (format, layout, of) = (job.want.format.name(), job.want.layout.name(), family.described(job, side));
    let fixed = if job.want.layout == Layout::PathTracer {
        format!(" ({} Smith, alpha = {})", job.smith.name(), job.region.alpha_map.name())
    } else {
        String::new()
    };
    format!("table {size} {format}, {layout} layout{fixed}, {of}")
}
