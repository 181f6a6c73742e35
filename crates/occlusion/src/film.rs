//! A camera's path through a world, with its depth frame by frame.

use std::borrow::Cow;

use rayon::prelude::*;

use crate::camera::Camera;
use crate::depth::Depth;
use crate::grid::Grid;
use crate::raster::rendered;
use crate::site::Site;
use lobefit::scene::CameraPath;
use lobefit_math::ops::{cos, sin};

/// How a camera moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Its path.
    pub path: CameraPath,
    /// Which of the nine places of a site it starts from.
    pub start: usize,
    /// Times the usual speed, at which a turn is 3 degrees a frame, a step sideways 0.25 m and one
    /// ahead 0.35 m.
    pub speed: f64,
}

impl Shot {
    /// The camera of a frame.
    pub fn camera(&self, frame: usize, site: &Site, size: [usize; 2]) -> Camera {
        let start = &site.starts[self.start];
        // From the middle place the first look is along y: in a town along a street.
        let (time, first) = (frame as f64 * self.speed, 1.45 + 0.7 * (self.start as f64 - 4.0));
        // Degrees a frame at the fastest are those of the amplitude times the frequency.
        let swing = |amplitude: f64, most: f64| match amplitude > 0.0 {
            true => amplitude * sin(time * most / amplitude),
            false => 0.0,
        };
        let step = |most: f64, each: f64| swing(most.min(start.room), each);
        let (along, angles) = match self.path {
            CameraPath::Turn => {
                (0.0, [first + swing(1.2, 3_f64.to_radians()), -0.05 + 0.05 * cos(0.1 * time)])
            }
            CameraPath::Strafe => (step(9.0, 0.25), [0.1 * first, 0.0]),
            CameraPath::Walk => (step(24.0, 0.35), [std::f64::consts::FRAC_PI_2 + swing(0.5, 0.02), 0.0]),
        };
        let [x, y, z] = start.eye;
        Camera::new([x, y + along as f32, z], angles, size)
    }
}

/// Cameras and depth of the frames of a shot, at the resolution of the buffer and finer.
#[derive(Clone, Debug)]
pub struct Film<'a> {
    /// What is looked at.
    pub site: &'a Site,
    /// Size of the buffer.
    pub size: [usize; 2],
    /// Cameras, frame by frame.
    pub cameras: Vec<Camera>,
    /// Depth at the buffer's resolution.
    pub depth: Vec<Depth>,
    /// Depth so many times as fine, of the frames that are asked for.
    fine: Vec<(usize, Vec<Option<Depth>>)>,
}

impl<'a> Film<'a> {
    /// Renders the frames of a shot; finer ones at `frames`.
    pub fn new(
        site: &'a Site,
        (shot, count): (Shot, usize),
        size: [usize; 2],
        fineness: &[usize],
        frames: &[usize],
    ) -> Film<'a> {
        let cameras: Vec<Camera> = (0..count).map(|frame| shot.camera(frame, site, size)).collect();
        let depth = cameras.par_iter().map(|camera| rendered(camera, &site.solids, size)).collect();
        let at = |times: usize| {
            let one = |(i, camera): (usize, &Camera)| {
                frames.contains(&i).then(|| rendered(camera, &site.solids, size.map(|n| n * times)))
            };
            (times, cameras.par_iter().enumerate().map(one).collect())
        };
        let fine = fineness.iter().filter(|times| **times > 1).map(|times| at(*times)).collect();
        Film { site, size, cameras, depth, fine }
    }

    /// The depth of a frame, so many times as fine: rendered here where [`Film::new`] was not
    /// asked for it.
    pub fn fine(&self, times: usize, frame: usize) -> Cow<'_, Depth> {
        if times == 1 {
            return Cow::Borrowed(&self.depth[frame]);
        }
        let known = self.fine.iter().find(|(known, _)| *known == times);
        match known.and_then(|(_, depth)| depth[frame].as_ref()) {
            Some(depth) => Cow::Borrowed(depth),
            None => {
                let size = self.size.map(|n| n * times);
                Cow::Owned(rendered(&self.cameras[frame], &self.site.solids, size))
            }
        }
    }

    /// Adds what frames show to a grid. Texels and voxels touched.
    pub fn accumulated(&self, grid: &mut Grid, frames: std::ops::Range<usize>) -> u64 {
        frames.map(|frame| grid.accumulate(&self.depth[frame], &self.cameras[frame])).sum()
    }
}
