//! How far a reconstructed buffer is from the depth of its frame, and what that does to culling.

use rayon::prelude::*;
use serde::Serialize;

use crate::camera::Camera;
use crate::cull::Footprint;
use crate::depth::{Depth, EMPTY};
use crate::film::Film;
use crate::grid::Grid;
use crate::passes::{Late, Passes, Work};
use crate::raster::{Cuboid, is_seen};

/// Part of the depth by which a texel may be off before it counts as wrong: about a voxel at 25 m.
pub const TOLERANCE: f32 = 0.02;

/// Sums over frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// Frames.
    pub frames: u64,
    /// Texels of all frames.
    pub texels: u64,
    /// Texels that nothing was written to.
    pub holes: u64,
    /// Texels that are too near: false occlusion.
    pub near: u64,
    /// Texels that are too far, holes among them: false disocclusion.
    pub far: u64,
    /// Boxes that the true depth keeps, and that the buffer culls.
    pub seen: u64,
    /// Of these, wrongly culled.
    pub culled: u64,
    /// Of these, boxes of which a pixel of the frame would be seen: they vanish.
    pub vanished: u64,
    /// Boxes that the true depth culls.
    pub hidden: u64,
    /// Of these, wrongly kept.
    pub kept: u64,
    /// Texels and voxels touched by each pass.
    pub work: Work<u64>,
    /// Texels read by the tests of boxes.
    pub reads: u64,
}

impl Tally {
    /// Part of the visible boxes that is wrongly culled.
    pub fn wrongly_culled(&self) -> f64 {
        part(self.culled, self.seen)
    }

    /// Part of the hidden boxes that is wrongly kept.
    pub fn wrongly_kept(&self) -> f64 {
        part(self.kept, self.hidden)
    }

    /// Texels and voxels touched per texel of the buffer.
    pub fn work_per_texel(&self) -> f64 {
        part(self.work.total(), self.texels)
    }

    /// The sum of two.
    pub fn plus(self, other: Tally) -> Tally {
        Tally {
            frames: self.frames + other.frames,
            texels: self.texels + other.texels,
            holes: self.holes + other.holes,
            near: self.near + other.near,
            far: self.far + other.far,
            seen: self.seen + other.seen,
            culled: self.culled + other.culled,
            vanished: self.vanished + other.vanished,
            hidden: self.hidden + other.hidden,
            kept: self.kept + other.kept,
            work: self.work.plus(other.work),
            reads: self.reads + other.reads,
        }
    }
}

/// A part of a whole; 0 of nothing.
pub fn part(of: u64, whole: u64) -> f64 {
    if whole == 0 { 0.0 } else { of as f64 / whole as f64 }
}

/// The error of a texel relative to its true depth, in [-1, 1]: negative where it is too near, 1
/// where it is infinite and the true depth is not, -1 where that alone is infinite, 0 where both
/// are; none where nothing was written.
pub fn error(found: f32, truth: f32) -> Option<f32> {
    match (found, truth) {
        (EMPTY, _) => None,
        (f32::INFINITY, f32::INFINITY) => Some(0.0),
        (f32::INFINITY, _) => Some(1.0),
        (_, f32::INFINITY) => Some(-1.0),
        _ => Some(((found - truth) / truth).clamp(-1.0, 1.0)),
    }
}

/// Texels that no old point reached, by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Holes {
    /// Texels.
    pub texels: u64,
    /// What is seen there was beside or behind the old frame.
    pub out_of_frame: u64,
    /// It was seen, by too few points.
    pub stretched: u64,
    /// It was hidden.
    pub disoccluded: u64,
}

impl Holes {
    /// Of a buffer, by the true depth: what is seen in an empty texel is looked for in the old
    /// frame.
    pub fn of(buffer: &Depth, truth: (&Depth, &Camera), old: (&Depth, &Camera)) -> Holes {
        let ((depth, camera), (before, from), size) = (truth, old, buffer.size);
        let [corner, across, down] = camera.rays(size);
        let mut holes = Holes { texels: buffer.texels.len() as u64, ..Holes::default() };
        for i in (0..buffer.texels.len()).filter(|i| buffer.texels[*i] == EMPTY) {
            let (x, y) = ((i % size[0]) as f32 + 0.5, (i / size[0]) as f32 + 0.5);
            // What is infinitely far is as good as very far.
            let z = depth.texels[i].min(1e6);
            let place = [0, 1, 2].map(|k| camera.eye[k] + z * (corner[k] + x * across[k] + y * down[k]));
            let view = from.view(place);
            let inside = |p: [f32; 2]| (0..2).all(|k| p[k] >= 0.0 && p[k] < before.size[k] as f32);
            match from.pixel(view, before.size).filter(|p| inside(*p)) {
                None => holes.out_of_frame += 1,
                Some([x, y]) => {
                    let known = before.texels[y as usize * before.size[0] + x as usize];
                    let hidden = known < view[2] * (1.0 - TOLERANCE);
                    if hidden { holes.disoccluded += 1 } else { holes.stretched += 1 }
                }
            }
        }
        holes
    }
}

/// A reconstruction and the margin of its tests.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// The passes.
    pub passes: Passes,
    /// The part of a depth that is added in tests of boxes.
    pub bias: f32,
}

/// How old depth is, the frames that are measured, and the voxels of the grid.
#[derive(Clone, Debug)]
pub struct Span<'a> {
    /// Frames that depth is old.
    pub latency: usize,
    /// Frames that are measured, ascending, each at least as late as the latency.
    pub frames: &'a [usize],
    /// Voxels along each axis.
    pub voxels: [u32; 3],
}

/// Measures trials over frames of a film, with the objects of its site: a tally for each trial.
pub fn measured(film: &Film, span: &Span, trials: &[Trial]) -> Vec<Tally> {
    let mut tallies = vec![Tally::default(); trials.len()];
    let mut grid = Grid::new(span.voxels, &film.site.bounds);
    let mut next = 0;
    for &frame in span.frames {
        let late = frame - span.latency;
        film.accumulated(&mut grid, next..late);
        let arrived = film.accumulated(&mut grid, late..late + 1);
        next = late + 1;
        let (camera, truth) = (&film.cameras[frame], &film.depth[frame]);
        let tested: Vec<Tested> =
            film.site.objects.iter().filter_map(|cuboid| Tested::new(cuboid, camera, truth)).collect();
        let one = |trials: &&[Trial]| {
            let passes = trials[0].passes;
            let depth = film.fine(passes.fineness(), late);
            let late = Late { camera: &film.cameras[late], depth: &depth, grid: &grid };
            let (buffer, mut work, _) = passes.run(late, camera, film.size);
            work.accumulate = if passes.voxels.is_some() { arrived } else { 0 };
            let tested = |trial: &Trial| tally((&buffer, work), (truth, camera), &tested, trial.bias);
            trials.iter().map(tested).collect()
        };
        // Trials of the same passes that stand side by side share their buffer.
        let shared: Vec<&[Trial]> = trials.chunk_by(|a, b| a.passes == b.passes).collect();
        let found: Vec<Vec<Tally>> = shared.par_iter().map(one).collect();
        tallies.iter_mut().zip(found.into_iter().flatten()).for_each(|(sum, one)| *sum = sum.plus(one));
    }
    tallies
}

/// A box that has a rectangle in the frame, and whether the true depth hides it.
struct Tested<'a> {
    cuboid: &'a Cuboid,
    footprint: Footprint,
    hidden: bool,
}

impl Tested<'_> {
    fn new<'a>(cuboid: &'a Cuboid, camera: &Camera, truth: &Depth) -> Option<Tested<'a>> {
        let footprint = Footprint::of(camera, cuboid, truth.size).ok()?;
        Some(Tested { cuboid, footprint, hidden: footprint.is_hidden(truth, 0.0).0 })
    }
}

fn tally(
    (buffer, work): (&Depth, Work<u64>),
    (truth, camera): (&Depth, &Camera),
    boxes: &[Tested],
    bias: f32,
) -> Tally {
    let mut tally = Tally {
        frames: 1,
        texels: buffer.texels.len() as u64,
        holes: buffer.holes() as u64,
        work,
        ..Tally::default()
    };
    for (found, truth) in buffer.texels.iter().zip(&truth.texels) {
        let error = error(*found, *truth).unwrap_or(1.0);
        tally.near += u64::from(error < -TOLERANCE);
        tally.far += u64::from(error > TOLERANCE);
    }
    for Tested { cuboid, footprint, hidden } in boxes {
        let (culled, reads) = footprint.is_hidden(buffer, bias);
        tally.reads += reads;
        if *hidden {
            (tally.hidden, tally.kept) = (tally.hidden + 1, tally.kept + u64::from(!culled));
        } else {
            (tally.seen, tally.culled) = (tally.seen + 1, tally.culled + u64::from(culled));
            tally.vanished += u64::from(culled && is_seen(camera, cuboid, truth));
        }
    }
    tally
}
