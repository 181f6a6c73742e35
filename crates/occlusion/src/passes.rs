//! The reconstruction of a depth buffer, pass by pass.

use std::ops::Add;
use std::time::Instant;

use serde::{Deserialize, Serialize};

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

/// What each pass took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Work<T> {
    /// Of the points.
    pub reproject: T,
    /// Of both medians.
    pub median: T,
    /// Of the depth of a frame, added to the voxels; [`Passes::run`] is given them, and counts none.
    pub accumulate: T,
    /// Of the splats.
    pub voxels: T,
    /// Of the dilation and the erosion.
    pub dilation: T,
}

impl<T: Copy + Add<Output = T>> Work<T> {
    /// All passes.
    pub fn total(&self) -> T {
        self.reproject + self.median + self.accumulate + self.voxels + self.dilation
    }

    /// What `with` makes of each pass of two.
    pub fn zip<U: Copy, V>(self, other: Work<U>, with: impl Fn(T, U) -> V) -> Work<V> {
        Work {
            reproject: with(self.reproject, other.reproject),
            median: with(self.median, other.median),
            accumulate: with(self.accumulate, other.accumulate),
            voxels: with(self.voxels, other.voxels),
            dilation: with(self.dilation, other.dilation),
        }
    }

    /// The sum of two.
    pub fn plus(self, other: Work<T>) -> Work<T> {
        self.zip(other, |a, b| a + b)
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
        if self.dilation > 0 || self.erosion > 0 {
            timed(&mut work.dilation, &mut seconds.dilation, &mut || self.finish(&mut out));
        }
        (out, work, seconds)
    }

    /// The dilation and the erosion of a buffer that the other passes made. Texels touched.
    pub fn finish(&self, out: &mut Depth) -> u64 {
        self.dilate(out) + self.erode(out)
    }

    /// The dilation alone.
    pub fn dilate(&self, out: &mut Depth) -> u64 {
        if self.dilation > 0 && !self.conservative { out.dilation(self.dilation) } else { 0 }
    }

    /// The erosion after it.
    pub fn erode(&self, out: &mut Depth) -> u64 {
        if self.erosion == 0 || self.conservative {
            return 0;
        }
        *out = out.eroded(self.erosion);
        // By rows, then by columns.
        (out.texels.len() * 2 * (2 * self.erosion + 1)) as u64
    }
}
