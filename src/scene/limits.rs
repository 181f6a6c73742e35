//! Every limit on what a scene may ask for, in one place. They bound time and memory before either
//! is spent.

pub use lobefit_import::limits::{GLASS_IOR, MATERIALS};
pub use lobefit_strict::limits::{DEPTH, FILE_BYTES, STRING_BYTES};

/// Largest hypothesis file, bytes.
pub const HYPOTHESIS_BYTES: u64 = 1 << 20;
/// Fewest texels of a table axis: a lookup interpolates between two.
pub const AXIS_MIN: usize = 2;
/// Most texels of a table axis.
pub const AXIS_MAX: usize = 1024;
/// Fewest texels of an axis of a table with a third: below it nothing is left to choose texels for.
pub const SLICED_AXIS_MIN: usize = 4;
/// Most texels of an axis of a table of three.
pub const SLICED_AXIS_MAX: usize = 256;
/// Most texels of a table of three axes. One whose texels are optimised has eight samples a texel,
/// which with their errors take 17 bytes each: of this size 0.6 GB, of glass, whose sides share
/// their integrals, 0.9 GB.
pub const SLICED_CELLS: usize = 1 << 22;
/// Most columns times slices of a table of three axes whose texels are optimised. Each is sampled
/// eightfold at up to 26 alphas, so that this takes up to 3.4 million integrals of some ten
/// microseconds, and 0.3 GB for their inputs and values.
pub const SLICED_LINES: usize = 1 << 14;
/// Most slices of a texture: what every graphics interface has. Axes beyond the third are slices too.
pub const TEXTURE_DEPTH: usize = 2048;
/// Most tables that a material may want.
pub const TABLES: usize = 4;
/// Most texels of all tables of a scene together.
pub const CELLS: u64 = 1 << 24;
/// Most bytes of all texels of a scene together.
pub const TEXEL_BYTES: u64 = 512 << 20;
/// Most hypothesis files of a scene, counted once per material that names them.
pub const HYPOTHESES: usize = 256;
/// Most probes of a scene.
pub const PROBES: usize = 4096;
/// Fewest levels of a prefiltered chain: roughness 0 and 1.
pub const LEVELS_MIN: usize = 2;
/// Most levels of a prefiltered chain: a cube of 32768 texels a side has as many.
pub const LEVELS_MAX: usize = 16;
/// Most widths of a kernel's table.
pub const KERNEL_LOBES: usize = 64;
/// Most angles of a lobe in a kernel's table.
pub const KERNEL_ANGLES: usize = 4096;
/// Most lookups of a probe.
pub const LOOKUPS_MAX: usize = 16;
/// Fewest planes of a proxy: those of a tetrahedron.
pub const PLANES_MIN: u32 = 4;
/// Most planes of a proxy.
pub const PLANES_MAX: u32 = 64;
/// Most fetches of a lookup.
pub const TAPS_MAX: u32 = 3;
/// Most voxels of a grid, a byte each.
pub const VOXELS: u64 = 1 << 25;
/// Most operations that a fit may be allowed.
pub const FIT_OPS: u32 = 1000;
/// Most worker threads.
pub const THREADS: usize = 256;

/// Smallest GGX alpha that counts as rough. Below it the lobe is narrower than the accuracy promise
/// of the integrals reaches (alpha in [1e-4, 1]), and its albedo differs from the mirror's by less
/// than 2e-4 for mu >= 1e-3 (the albedo depends on mu/alpha alone there): such a material is
/// smooth.
pub const SMOOTH_ALPHA: f64 = 1e-4;
/// Least alpha of tables with slices and of dielectrics with the exact Fresnel term: below it every value
/// of the truth is an integral of its own.
pub const SLICED_ALPHA: f64 = 4e-4;
/// Largest index of refraction that the path tracer's tables reach.
pub const PATH_TRACER_IOR: f64 = 2.0;
/// Largest index of refraction of fits with the exact Fresnel term: the truth is quick up to there.
pub const EXACT_IOR: f64 = GLASS_IOR;
/// Smallest mu of the domain of a fit: where the accuracy promise of the integrals ends.
pub const MU_MIN: f64 = 1e-4;

/// Cells and bytes of a table with `columns` x `rows` texels of `texel_bytes` each (all channels),
/// or `None` where the product overflows or exceeds [`CELLS`] or [`TEXEL_BYTES`].
pub fn texels(columns: usize, rows: usize, texel_bytes: u64) -> Option<(u64, u64)> {
    let cells = u64::try_from(columns).ok()?.checked_mul(u64::try_from(rows).ok()?)?;
    let bytes = cells.checked_mul(texel_bytes)?;
    within(cells, bytes)
}

/// Sum of two counts of cells and bytes, or `None` beyond the limits.
pub fn add_texels(a: (u64, u64), b: (u64, u64)) -> Option<(u64, u64)> {
    within(a.0.checked_add(b.0)?, a.1.checked_add(b.1)?)
}

fn within(cells: u64, bytes: u64) -> Option<(u64, u64)> {
    (cells <= CELLS && bytes <= TEXEL_BYTES).then_some((cells, bytes))
}

/// Range of mu over which a table is measured where the scene does not say.
pub const TABLE_MU: [f64; 2] = [1e-3, 1.0];
