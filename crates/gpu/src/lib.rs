//! Time per evaluation of the emitted WGSL on a graphics processor, and its machine code.
//!
//! Every function that the manifest of a bake lists runs in a loop of a compute shader, and beside
//! it the same loop without the function: what an evaluation takes is the difference. Both are
//! dispatched one right after the other, and all functions take turns, several times over; figures
//! are medians over these.
//!
//! The program `lobefit` runs the binary of this package for `lobefit cost --gpu`. Records of times
//! are read, checked and shown without a driver, by [`lobefit::timing::record`].
//!
//! `lobefit cost --isa` compiles the same functions by drivers that need no GPU, and counts the
//! instructions. `--weights` fits to recorded counts what kinds of work cost.

mod cli;
mod device;
mod error;
mod isa;
mod jobs;
mod measure;
mod shader;
mod texture;
mod variable;
mod weights;

pub use cli::run;
pub use error::GpuError;
pub use isa::counted;
use measure::Measured;
pub use weights::least_squares;

use device::Gpu;
use jobs::Jobs;
use lobefit::bake::{Baked, Progress};
use lobefit::emit::include::Include;
use lobefit::report::{GpuRecord, Origin};
use lobefit::timing::record::METHOD;

/// How much work a measurement does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    /// Pixels along an edge of the square picture that is a dispatch, a multiple of 8.
    side: u32,
    /// Pairs of dispatches that a row is the median of, odd.
    repeats: u32,
    /// Shortest dispatch with a function in it, nanoseconds: below it a thread evaluates more.
    shortest: f64,
    /// Fewer than what is to be quoted.
    reduced: bool,
}

impl Work {
    /// What is recorded.
    pub const FULL: Work = Work { side: 2048, repeats: 15, shortest: 2e6, reduced: false };
    /// For software drivers and for trying out.
    pub const REDUCED: Work = Work { side: 128, repeats: 5, shortest: 2e5, reduced: true };
}

/// Measures the functions of a bake on the first device whose name holds `adapter`, or on the first
/// of all; none where the bake emits no functions.
///
/// # Errors
/// No device, a device that refuses or fails, results that are not finite; never a number in their
/// place.
pub fn measure(
    baked: &Baked,
    adapter: Option<&str>,
    work: Work,
    origin: Origin,
    progress: &dyn Progress,
) -> Result<Option<GpuRecord>, GpuError> {
    let Some(include) = Include::of(&baked.files) else { return Ok(None) };
    let gpu = Gpu::open(adapter)?;
    let jobs = Jobs::of(include, baked, gpu.unfiltered())?;
    let measured = Measured::of(&gpu, &jobs.all, work, progress)?;
    Ok(Some(GpuRecord {
        origin,
        method: METHOD,
        device: gpu.info.clone(),
        clock: gpu.clock,
        threads: work.side * work.side,
        repeats: work.repeats,
        reduced: work.reduced,
        rows: measured.rows(&jobs.all),
        left_out: jobs.left_out,
    }))
}
