//! The reconstruction of a depth buffer, pass by pass.

use std::time::Instant;

use serde::Serialize;

use crate::camera::Camera;
use crate::depth::Depth;
use crate::grid::{Grid, Lod};
use crate::reproject::{reproject, reproject_conservatively};

/// Which passes there are, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Passes {
    /// Old depth as points, of the buffer's resolution or of `half` twice that; none: no points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub half: Option<bool>,
    /// Radius of the median that follows each pass of points; 0: none.
    pub median: usize,
    /// Splats of voxels, with their levels of detail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voxels: Option<Lod>,
    /// Largest radius of the dilation; 0: none.
    pub dilation: usize,
    /// Texels by which what stands in front shrinks at the end; 0: none.
    pub erosion: usize,
    /// Nothing is hidden that may be seen: the farthest point of each texel, of depth that is four
    /// times as fine, nothing known at edges and next to them. The other passes invent depth, and
    /// are left out.
    pub conservative: bool,
}

/// What each pass took: reprojection, medians, splats of voxels, dilation. Accumulating the voxels
/// is not among them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Work<T> {
    /// Of the points.
    pub reproject: T,
    /// Of both medians.
    pub median: T,
    /// Of the splats.
    pub voxels: T,
    /// Of the dilation and the erosion.
    pub dilation: T,
}

impl Work<u64> {
    /// All passes.
    pub fn total(&self) -> u64 {
        self.reproject + self.median + self.voxels + self.dilation
    }

    /// The sum of two.
    pub fn plus(self, other: Work<u64>) -> Work<u64> {
        Work {
            reproject: self.reproject + other.reproject,
            median: self.median + other.median,
            voxels: self.voxels + other.voxels,
            dilation: self.dilation + other.dilation,
        }
    }
}

/// What is there of an older frame.
#[derive(Clone, Copy, Debug)]
pub struct Late<'a> {
    /// Its camera.
    pub camera: &'a Camera,
    /// Its depth, as fine as the passes ask for.
    pub depth: &'a Depth,
    /// Voxels that were accumulated until then.
    pub grid: &'a Grid,
}

impl Passes {
    /// No pass at all.
    pub const NONE: Passes =
        Passes { half: None, median: 0, voxels: None, dilation: 0, erosion: 0, conservative: false };
    /// Old depth as points.
    pub const POINTS: Passes = Passes { half: Some(false), ..Passes::NONE };
    /// Nothing is hidden that may be seen.
    pub const CONSERVATIVE: Passes = Passes { conservative: true, ..Passes::POINTS };

    /// How many times as fine as the buffer the old depth is.
    pub fn fineness(&self) -> usize {
        match (self.conservative, self.half) {
            (true, _) => 4,
            (_, Some(true)) => 2,
            _ => 1,
        }
    }

    /// A buffer of a size from what is late, with the texels and voxels touched and the seconds
    /// taken. Seconds differ from run to run: nothing that is kept may follow from them.
    pub fn run(&self, late: Late, to: &Camera, size: [usize; 2]) -> (Depth, Work<u64>, Work<f64>) {
        let (mut work, mut seconds) = (Work::default(), Work::default());
        let mut out = Depth::empty(size);
        let timed = |touched: &mut u64, spent: &mut f64, pass: &mut dyn FnMut() -> u64| {
            let start = Instant::now();
            *touched += pass();
            *spent += start.elapsed().as_secs_f64();
        };
        if self.conservative {
            timed(&mut work.reproject, &mut seconds.reproject, &mut || {
                reproject_conservatively(late.depth, late.camera, to, &mut out)
            });
            return (out, work, seconds);
        }
        if self.half.is_some() {
            timed(&mut work.reproject, &mut seconds.reproject, &mut || {
                reproject(late.depth, late.camera, to, &mut out)
            });
            if self.median > 0 {
                timed(&mut work.median, &mut seconds.median, &mut || out.median(self.median));
            }
        }
        if let Some(lod) = self.voxels {
            timed(&mut work.voxels, &mut seconds.voxels, &mut || late.grid.splat(to, lod, &mut out));
            if self.median > 0 {
                timed(&mut work.median, &mut seconds.median, &mut || out.median(self.median));
            }
        }
        if self.dilation > 0 {
            timed(&mut work.dilation, &mut seconds.dilation, &mut || out.dilation(self.dilation));
        }
        if self.erosion > 0 {
            timed(&mut work.dilation, &mut seconds.dilation, &mut || {
                out = out.eroded(self.erosion);
                // By rows, then by columns.
                (out.texels.len() * 2 * (2 * self.erosion + 1)) as u64
            });
        }
        (out, work, seconds)
    }
}
