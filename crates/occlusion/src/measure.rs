//! How far a reconstructed buffer is from the depth of its frame, and what that does to culling.

use std::borrow::Cow;

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

/// Whether a texel's [`error`] is below -[`TOLERANCE`], without a branch. Of infinities the quotient is no
/// number, and compares as false.
pub fn is_near(found: f32, truth: f32) -> bool {
    let finite = (found < f32::INFINITY) & (truth == f32::INFINITY);
    (found != EMPTY) & (((found - truth) / truth < -TOLERANCE) | finite)
}

/// Whether it is above, or nothing was written.
pub fn is_far(found: f32, truth: f32) -> bool {
    (found == EMPTY) | ((found - truth) / truth > TOLERANCE)
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

impl Trial {
    /// The margin where nothing says another.
    pub const BIAS: f32 = 0.01;

    /// Passes with it.
    pub const fn usual(passes: Passes) -> Trial {
        Trial { passes, bias: Trial::BIAS }
    }
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

/// What passes do over frames, at every margin of the tests of boxes.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// What no margin changes; nothing is culled or kept in it.
    fixed: Tally,
    /// Of visible boxes that the buffer hides without a margin, the margin from which on each is kept,
    /// and whether a pixel of it would be seen.
    seen: Vec<(f32, bool)>,
    /// The same margins of hidden boxes.
    hidden: Vec<f32>,
}

impl Measured {
    /// With a margin.
    pub fn at(&self, bias: f32) -> Tally {
        let culled = || self.seen.iter().filter(|(margin, _)| *margin > bias);
        let rightly = self.hidden.iter().filter(|margin| **margin > bias).count();
        Tally {
            culled: culled().count() as u64,
            vanished: culled().filter(|(_, vanishes)| *vanishes).count() as u64,
            kept: self.fixed.hidden - rightly as u64,
            ..self.fixed
        }
    }

    /// The least margin that culls no larger part of the visible boxes: exact, for each of them is kept
    /// from its own margin on.
    pub fn least_bias(&self, part: f64) -> f32 {
        let mut margins: Vec<f32> = self.seen.iter().map(|(margin, _)| *margin).collect();
        margins.sort_by(|a, b| b.total_cmp(a));
        margins.get((part * self.fixed.seen as f64) as usize).copied().unwrap_or(0.0)
    }

    /// Adds a frame: its buffer, and what each box has to do with it.
    fn add(
        &mut self,
        (buffer, work): (&Depth, Work<u64>),
        (truth, camera): (&Depth, &Camera),
        boxes: &[Tested],
    ) {
        let mut frame = Tally {
            frames: 1,
            texels: buffer.texels.len() as u64,
            holes: buffer.holes() as u64,
            hidden: boxes.iter().filter(|tested| tested.hidden).count() as u64,
            work,
            ..Tally::default()
        };
        frame.seen = boxes.len() as u64 - frame.hidden;
        let pairs = || buffer.texels.iter().zip(&truth.texels);
        frame.near = pairs().map(|(found, truth)| u32::from(is_near(*found, *truth))).sum::<u32>().into();
        frame.far = pairs().map(|(found, truth)| u32::from(is_far(*found, *truth))).sum::<u32>().into();
        self.fixed = self.fixed.plus(frame);
        for Tested { cuboid, footprint, hidden } in boxes {
            let margin = footprint.margin(buffer);
            match hidden {
                _ if margin <= 0.0 => {}
                true => self.hidden.push(margin),
                false => self.seen.push((margin, is_seen(camera, cuboid, truth))),
            }
        }
    }
}

/// Measures reconstructions over frames of a film, with the objects of its site.
pub fn measured(film: &Film, span: &Span, passes: &[Passes]) -> Vec<Measured> {
    let mut all = vec![Measured::default(); passes.len()];
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
        // Passes that differ at their end alone share the buffer before it.
        let before = |passes: &Passes| Passes { dilation: 0, erosion: 0, ..*passes };
        let one = |shared: Vec<(&Passes, &mut Measured)>| {
            let first = before(shared[0].0);
            let depth = film.fine(first.fineness(), late);
            let late = Late { camera: &film.cameras[late], depth: &depth, grid: &grid };
            let (buffer, mut work, _) = first.run(late, camera, film.size);
            work.accumulate = if first.voxels.is_some() { arrived } else { 0 };
            // Those that follow one another with the same dilation share that too.
            let (mut dilated, mut touched, mut radius) = (buffer.clone(), 0, 0);
            for (passes, sum) in shared {
                if passes.dilation != radius {
                    dilated.clone_from(&buffer);
                    (touched, radius) = (passes.dilate(&mut dilated), passes.dilation);
                }
                let mut eroded = Cow::Borrowed(&dilated);
                let mut dilation = touched;
                if passes.erosion > 0 {
                    dilation += passes.erode(eroded.to_mut());
                }
                sum.add((&eroded, Work { dilation, ..work }), (truth, camera), &tested);
            }
        };
        let groups = lobefit_math::groups(passes.iter().zip(&mut all), |each| before(each.0));
        groups.into_par_iter().for_each(|(_, group)| one(group));
    }
    all
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
        Some(Tested { cuboid, footprint, hidden: footprint.is_hidden(truth, 0.0) })
    }
}
