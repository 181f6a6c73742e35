//! What there is to time of a bake: the functions that its manifest lists.

use std::collections::BTreeMap;

use super::GpuError;
use super::shader::{Fetches, Shader};
use super::texture::{Shape, Texels};
use super::variable::Ranges;
use lobefit::bake::Baked;
use lobefit::data::TexelFormat;
use lobefit::data::Use;
use lobefit::emit::call::LookupFunction;
use lobefit::emit::call::MipEntry;
use lobefit::emit::include::Include;
use lobefit::emit::manifest::{Entries, FitEntry, Manifest, TableEntry};
use lobefit::report::{self, GpuKind, GpuLeftOut};
use lobefit::store::MANIFEST;

/// Levels of the cubemap that lookups fetch from, and texels along an edge of its first: 128 down
/// to 2.
pub(super) const LEVELS: u32 = 7;
const EDGE: u32 = 128;

/// Something to time.
pub(super) struct Job {
    /// Name in the manifest, or of the fetch.
    pub name: String,
    /// What it is.
    pub kind: GpuKind,
    /// The emitted function, with the hash of its code.
    pub function: Option<(String, String)>,
    /// Operations by the model.
    pub ops: Option<u32>,
    /// Fetches in it.
    pub fetches: u32,
    /// What it approximates and how well.
    pub error: Option<report::GpuError>,
    /// The code to run.
    pub shader: Shader,
    /// What it fetches from.
    pub texture: Option<Texels>,
    /// Index of the job of the plain fetch to compare with.
    pub against: Option<usize>,
}

/// Everything to time, plain fetches first.
pub(super) struct Jobs {
    pub all: Vec<Job>,
    pub left_out: Vec<GpuLeftOut>,
}

/// Collects jobs.
struct Collector {
    include: Include,
    module: naga::Module,
    jobs: Jobs,
    /// Jobs of plain fetches.
    fetches: BTreeMap<String, usize>,
    unfiltered: Vec<TexelFormat>,
}

impl Jobs {
    /// Of a bake with an include file, for a device that does not filter textures of some formats.
    pub fn of(include: Include, baked: &Baked, unfiltered: Vec<TexelFormat>) -> Result<Jobs, GpuError> {
        let wrong = |place: &str, reason: String| GpuError::Bake { place: place.into(), reason };
        let module = naga::front::wgsl::parse_str(&include.text)
            .map_err(|e| wrong("fits/lobefit.wgsl", e.emit_to_string(&include.text)))?;
        let manifest = baked.files.get(MANIFEST).ok_or_else(|| wrong(MANIFEST, "not in the bake".into()))?;
        let manifest = Manifest::read(manifest).map_err(|e| wrong(MANIFEST, e.to_string()))?;
        let jobs = Jobs { all: Vec::new(), left_out: Vec::new() };
        let mut collector = Collector { include, module, jobs, fetches: BTreeMap::new(), unfiltered };
        let manifest = manifest.entries;
        collector.plain(&manifest);
        manifest.lookups.iter().try_for_each(|lookup| collector.lookup(lookup))?;
        manifest.tables.iter().try_for_each(|table| collector.table(table))?;
        manifest.fits.iter().try_for_each(|fit| collector.fit(fit))?;
        manifest.mips.iter().try_for_each(|mip| collector.mip(mip))?;
        Ok(collector.jobs)
    }
}

/// The fetch that formulas and tables of two axes are compared with, that of tables of three, and
/// that of lookups.
const FLAT: Texels = Texels { shape: Shape::Flat([64, 64], 2), format: TexelFormat::F16 };
const SOLID: Texels = Texels { shape: Shape::Solid([64, 64, 32], 1), format: TexelFormat::F16 };
const CUBE: Texels = Texels { shape: Shape::Cube(EDGE, LEVELS), format: TexelFormat::F16 };

/// Those two in other formats, to compare formats by.
const FORMATS: [TexelFormat; 3] = [TexelFormat::Unorm8, TexelFormat::Unorm16, TexelFormat::F32];

impl Collector {
    /// The fetches to compare with that something is compared with, and of textures the same in every
    /// format that the device filters.
    fn plain(&mut self, manifest: &Entries) {
        let solid = manifest.tables.iter().any(|table| table.axes.len() > 2);
        let flat = !manifest.fits.is_empty() || manifest.tables.iter().any(|table| table.axes.len() == 2);
        let formats = FORMATS.iter().filter(|format| !self.unfiltered.contains(format));
        let others = |of: Texels| formats.clone().map(move |format| Texels { format: *format, ..of });
        let of_tables = [(FLAT, flat), (SOLID, solid)];
        let other = of_tables.iter().flat_map(|(of, wanted)| others(*of).map(move |of| (of, *wanted)));
        let wanted = of_tables.into_iter().chain([(CUBE, !manifest.lookups.is_empty())]);
        let wanted: Vec<_> = wanted.chain(other).filter(|(_, wanted)| *wanted).collect();
        for (texels, _) in wanted {
            let name = format!("fetch: {texels}");
            self.fetches.insert(texels.to_string(), self.jobs.all.len());
            self.jobs.all.push(Job {
                name,
                kind: match texels.shape {
                    Shape::Cube(..) => GpuKind::CubemapFetch,
                    Shape::Flat(..) | Shape::Solid(..) => GpuKind::Fetch,
                },
                function: None,
                ops: None,
                fetches: 1,
                error: None,
                shader: Shader::of_fetch(texels),
                texture: Some(texels),
                against: None,
            });
        }
    }

    /// A job of a function over ranges of its arguments, without what it costs and approximates.
    fn job(
        &mut self,
        name: &str,
        kind: GpuKind,
        function: &str,
        ranges: &Ranges,
        texture: Option<Texels>,
        fetches: Option<Fetches>,
    ) -> Result<&mut Job, GpuError> {
        let place = || GpuError::Bake { place: function.into(), reason: "not in the include file".into() };
        let hash = self.include.hash(function).ok_or_else(place)?;
        let code = self.include.code(function).ok_or_else(place)?;
        let shader = Shader::of_function(&code, &self.module, function, ranges, texture, fetches)?;
        let beside = match texture.map(|texels| texels.shape) {
            Some(Shape::Solid(..)) => SOLID,
            Some(Shape::Cube(..)) => CUBE,
            None if kind == GpuKind::Lookup => CUBE,
            Some(Shape::Flat(..)) | None => FLAT,
        };
        let at = self.jobs.all.len();
        self.jobs.all.push(Job {
            name: name.into(),
            kind,
            function: Some((function.into(), hash)),
            ops: None,
            fetches: 0,
            error: None,
            shader,
            texture,
            against: self.fetches.get(&beside.to_string()).copied(),
        });
        Ok(&mut self.jobs.all[at])
    }

    fn lookup(&mut self, lookup: &LookupFunction) -> Result<(), GpuError> {
        let fetches = Fetches { count: lookup.cost.fetches, levels: lookup.gives == "mip" };
        let (name, ranges) = (&lookup.function, Ranges::new());
        self.job(name, GpuKind::Lookup, name, &ranges, None, None)?.ops = Some(lookup.cost.ops);
        let job = self.job(name, GpuKind::LookupFetches, name, &ranges, Some(CUBE), Some(fetches))?;
        (job.ops, job.fetches) = (Some(lookup.cost.ops), lookup.cost.fetches);
        Ok(())
    }

    fn table(&mut self, table: &TableEntry) -> Result<(), GpuError> {
        let function = table.function.clone();
        let sizes: Vec<u32> = table.axes.iter().map(|axis| axis.size as u32).collect();
        let channels = table.channels.len() as u32;
        let shape = match sizes.as_slice() {
            [columns, rows] => Shape::Flat([*columns, *rows], channels),
            [columns, rows, slices] => Shape::Solid([*columns, *rows, *slices], channels),
            _ => return Err(GpuError::Bake { place: function, reason: format!("{} axes", sizes.len()) }),
        };
        let texels = Texels { shape, format: table.format };
        if self.unfiltered.contains(&table.format) {
            let reason = format!("a texture of {}, which this device does not filter", table.format.name());
            self.jobs.left_out.push(GpuLeftOut { function, reason });
            return Ok(());
        }
        let ranges = table.axes.iter().map(|axis| (axis.name.clone(), [axis.min, axis.max])).collect();
        let job = self.job(&table.name, GpuKind::Table, &function, &ranges, Some(texels), None)?;
        (job.ops, job.fetches) = (Some(table.cost.ops), table.cost.fetches);
        job.error = Some(report::GpuError {
            quantity: table.quantity.clone(),
            column: String::new(),
            used_as: used_as(&table.function, &table.used_as)?,
            max: table.error.lookup.max,
            published: false,
        });
        Ok(())
    }

    fn fit(&mut self, fit: &FitEntry) -> Result<(), GpuError> {
        let job = self.job(&fit.name, GpuKind::Fit, &fit.function, &fit.certificate.domain, None, None)?;
        (job.ops, job.fetches) = (Some(fit.cost.ops), fit.cost.fetches);
        job.error = Some(report::GpuError {
            quantity: fit.quantity.clone(),
            column: fit.column.clone(),
            used_as: used_as(&fit.function, &fit.used_as)?,
            max: fit.certificate.max_abs,
            published: fit.source != "fitted",
        });
        Ok(())
    }

    fn mip(&mut self, mip: &MipEntry) -> Result<(), GpuError> {
        self.job(&mip.function, GpuKind::Level, &mip.function, &Ranges::new(), None, None)?.ops =
            Some(mip.ops);
        Ok(())
    }
}

/// The use that a manifest names.
fn used_as(function: &str, name: &str) -> Result<Use, GpuError> {
    Use::of(name).ok_or_else(|| GpuError::Bake { place: function.into(), reason: format!("use {name}") })
}
