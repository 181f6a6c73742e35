//! Everything that is measured of a scene's culling.

use rayon::prelude::*;
use serde::Serialize;

use crate::camera::Camera;
use crate::choice::{Choices, PATHS};
use crate::cull::Footprint;
use crate::depth::Depth;
use crate::film::{Film, Shot};
use crate::grid::{Grid, Lod};
use crate::measure::{Holes, Measured, Span, Tally, Trial, measured};
use crate::passes::{Late, Passes};
use crate::site::Site;
use lobefit::scene::{CameraPath, Culling, Pass};

/// Frames of a shot, of which the last ones are measured: before, voxels are accumulated.
pub const FRAMES: usize = 60;
pub(crate) const MEASURED: [usize; 8] = [20, 26, 31, 37, 42, 48, 53, 59];
/// Latencies of the sweep: all that a scene may ask for.
const LATENCIES: [usize; 8] = [1, 2, 3, 4, 5, 6, 7, 8];
/// What a scene does not say: radius of the median and of the dilation, levels of detail.
const MEDIAN: usize = 1;
const DILATION: usize = 2;
const LOD: Lod = Lod { near: 12.0, far: 48.0 };

/// Every pass that the source of the method proposes.
pub const ALL: Passes = Passes { median: MEDIAN, voxels: Some(LOD), dilation: DILATION, ..Passes::POINTS };

/// What a row of the comparison is.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// In words.
    pub name: String,
    /// Size of the buffer.
    pub buffer: [usize; 2],
    /// Voxels of the grid, where it is splatted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voxels: Option<[u32; 3]>,
    /// The passes and the margin.
    pub trial: Trial,
    /// What was measured.
    pub tally: Tally,
}

/// One measurement in a sweep.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// The path.
    pub path: CameraPath,
    /// Frames that depth is old.
    pub latency: usize,
    /// Times the usual speed.
    pub speed: f64,
    /// Of the old depth alone.
    pub points: Tally,
    /// Of all passes of the scene.
    pub all: Tally,
    /// Of the conservative mode.
    pub conservative: Tally,
    /// Of the chosen parameters.
    pub chosen: Tally,
}

/// Holes on a path.
#[derive(Clone, Debug, Serialize)]
pub struct Causes {
    /// The path.
    pub path: CameraPath,
    /// By cause.
    pub holes: Holes,
}

/// Buffers of one frame, in the order of the sheet.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// The depth of the frame.
    pub truth: Depth,
    /// The depth that is there.
    pub old: Depth,
    /// Names, and buffers: depth, voxels, both; then these with medians; then all passes, the conservative
    /// mode and the chosen parameters.
    pub buffers: Vec<(&'static str, Depth)>,
}

/// Everything that was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Results {
    /// What the scene asks for.
    pub culling: Culling,
    /// Every way to make the buffer, on the scene's path, at its resolutions and at others: see
    /// [`ways`].
    pub rows: Vec<Row>,
    /// Holes of the old depth by cause, on each path.
    pub causes: Vec<Causes>,
    /// Over latency at the usual speed, then over speed at the scene's latency.
    pub sweep: Vec<Point>,
    /// The free parameters.
    pub choices: Choices,
    /// The frame of the pictures.
    #[serde(skip)]
    pub pictures: Pictures,
}

/// The passes of a scene.
pub fn passes(culling: &Culling) -> Passes {
    let has = |pass: Pass| culling.passes.contains(&pass);
    Passes {
        half: has(Pass::ReprojectHalf).then_some(true).or(has(Pass::Reproject).then_some(false)),
        median: if has(Pass::Median) { MEDIAN } else { 0 },
        voxels: has(Pass::Voxels).then_some(LOD),
        dilation: if has(Pass::Dilation) { DILATION } else { 0 },
        ..Passes::NONE
    }
}

/// The passes of a scene with the usual margin.
pub fn usual(culling: &Culling) -> Trial {
    Trial::usual(passes(culling))
}

/// Every way to make the buffer: the passes of the method, the conservative mode, those of the scene
/// if they are none of these, and chosen parameters.
fn sources(culling: &Culling, chosen: &Trial) -> Vec<Way> {
    let sources = [
        ("depth", Passes::POINTS),
        ("depth of twice the resolution", Passes { half: Some(true), ..Passes::NONE }),
        ("voxels", Passes { voxels: Some(LOD), ..Passes::NONE }),
        ("depth and voxels", Passes { voxels: Some(LOD), ..Passes::POINTS }),
    ];
    let fills = [
        ("", 0, 0),
        (", median", MEDIAN, 0),
        (", dilation", 0, DILATION),
        (", median, dilation", MEDIAN, DILATION),
    ];
    let mut all: Vec<Way> = Vec::new();
    for (source, passes) in sources {
        all.extend(fills.map(|(fill, median, dilation)| Way {
            name: format!("{source}{fill}"),
            trial: Trial::usual(Passes { median, dilation, ..passes }),
        }));
    }
    let mut add = |name: &str, trial: Trial| all.push(Way { name: name.into(), trial });
    add(SAFE, Trial::usual(Passes::CONSERVATIVE));
    add(CHOSEN, *chosen);
    let own = usual(culling);
    if all.iter().all(|way| way.trial != own) {
        all.push(Way { name: OWN.into(), trial: own });
    }
    all
}

/// Name of the rows of the conservative mode.
pub const SAFE: &str = "conservative";
/// Of the chosen parameters.
pub const CHOSEN: &str = "chosen parameters";
/// Of the scene's passes.
const OWN: &str = "the scene's passes";

/// A way to make the buffer.
pub struct Way {
    /// In words.
    pub name: String,
    /// Its passes and the margin.
    pub trial: Trial,
}

/// Ways that are measured with a grid.
pub struct WithGrid {
    /// Its voxels.
    pub voxels: [u32; 3],
    /// The ways.
    pub ways: Vec<Way>,
}

/// A buffer's size with all that is measured of it.
pub struct Ways {
    /// Of the buffer.
    pub buffer: [usize; 2],
    /// With each grid.
    pub grids: Vec<WithGrid>,
}

/// Every way to make the buffer of a scene: at its size, half and one and a half times that, with
/// its grid, and voxels with grids of half and a quarter of the voxels along each axis. The scene's
/// own come first.
pub fn ways(culling: &Culling, chosen: &Trial) -> Vec<Ways> {
    let sized = |times: f64| culling.buffer.map(|n| ((f64::from(n) * times) as usize).max(16));
    let grid = |(i, voxels): (usize, [u32; 3])| {
        let own =
            sources(culling, chosen).into_iter().filter(|way| i == 0 || way.trial.passes.voxels.is_some());
        WithGrid { voxels, ways: own.collect() }
    };
    let grids = without_repeats([1, 2, 4].map(|part| culling.grid.map(|n| (n / part).max(2))));
    let ways = |buffer| Ways { buffer, grids: grids.iter().copied().enumerate().map(grid).collect() };
    without_repeats([1.0, 0.5, 1.5].map(sized)).into_iter().map(ways).collect()
}

/// The sizes without those that are there before: the smallest are bounded.
fn without_repeats<T: PartialEq>(sizes: [T; 3]) -> Vec<T> {
    sizes.into_iter().fold(Vec::new(), |mut all, size| {
        if !all.contains(&size) {
            all.push(size);
        }
        all
    })
}

/// What a scene asks for, and what is looked at.
#[derive(Clone, Copy)]
pub(crate) struct Set<'a> {
    pub culling: &'a Culling,
    pub site: &'a Site,
    size: [usize; 2],
}

impl<'a> Set<'a> {
    pub fn new(culling: &'a Culling, site: &'a Site) -> Set<'a> {
        Set { culling, site, size: culling.buffer.map(|n| n as usize) }
    }

    pub fn shot(&self, path: CameraPath, start: usize, speed: f64) -> (Shot, usize) {
        (Shot { path, start, speed }, FRAMES)
    }

    pub fn film(&self, shot: (Shot, usize), fineness: &[usize]) -> Film<'a> {
        let latency = self.culling.latency as usize;
        let late: Vec<usize> = MEASURED.iter().map(|frame| frame - latency).collect();
        Film::new(self.site, shot, self.size, fineness, &late)
    }

    pub fn span(&self, latency: usize) -> Span<'static> {
        Span { latency, frames: &MEASURED, voxels: self.culling.grid }
    }

    fn rows(&self, chosen: &Trial) -> Vec<Row> {
        let latency = self.culling.latency as usize;
        let of_buffer = |Ways { buffer, grids }: Ways| {
            let set = Set { size: buffer, ..*self };
            let film = set.film(set.shot(self.culling.path, 4, 1.0), &[2, 4]);
            let of_grid = |WithGrid { voxels, ways }: WithGrid| {
                let passes: Vec<Passes> = ways.iter().map(|way| way.trial.passes).collect();
                let found = measured(&film, &Span { voxels, ..set.span(latency) }, &passes);
                let row = move |(Way { name, trial }, found): (Way, Measured)| Row {
                    voxels: trial.passes.voxels.map(|_| voxels),
                    name,
                    buffer,
                    tally: found.at(trial.bias),
                    trial,
                };
                ways.into_iter().zip(found).map(row).collect::<Vec<_>>()
            };
            grids.into_iter().flat_map(of_grid).collect::<Vec<_>>()
        };
        ways(self.culling, chosen).into_iter().flat_map(of_buffer).collect()
    }

    fn causes(&self, path: CameraPath) -> Causes {
        let film = self.film(self.shot(path, 4, 1.0), &[]);
        // No pass of voxels reads it.
        let none = Grid::new([2; 3], &self.site.bounds);
        let mut sum = Holes::default();
        for &frame in &MEASURED {
            let late = frame - self.culling.latency as usize;
            let (now, old) =
                ((&film.depth[frame], &film.cameras[frame]), (&film.depth[late], &film.cameras[late]));
            let given = Late { camera: old.1, depth: old.0, grid: &none };
            let holes = Holes::of(&Passes::POINTS.run(given, now.1, self.size).0, now, old);
            sum.texels += holes.texels;
            sum.out_of_frame += holes.out_of_frame;
            sum.stretched += holes.stretched;
            sum.disoccluded += holes.disoccluded;
        }
        Causes { path, holes: sum }
    }

    /// Latencies at the usual speed, and speeds at the scene's latency.
    fn sweep(&self, chosen: &Trial) -> Vec<Point> {
        let latency = self.culling.latency as usize;
        let speeds = [0.25, 0.5, 2.0, 4.0].map(|speed| (speed, vec![latency]));
        let cases = [(1.0, LATENCIES.to_vec())].into_iter().chain(speeds);
        let cases: Vec<_> = cases
            .flat_map(|case| [CameraPath::Turn, CameraPath::Strafe].map(|path| (path, case.clone())))
            .collect();
        let trials = [Passes::POINTS, passes(self.culling), Passes::CONSERVATIVE].map(Trial::usual);
        let trials = [trials[0], trials[1], trials[2], *chosen];
        let one = |(path, (speed, latencies)): &(CameraPath, (f64, Vec<usize>))| {
            let film = self.film(self.shot(*path, 4, *speed), &[]);
            let at = |latency: &usize| {
                let found = measured(&film, &self.span(*latency), &trials.map(|trial| trial.passes));
                let of = |i: usize| found[i].at(trials[i].bias);
                let [points, all, conservative, chosen] = [0, 1, 2, 3].map(of);
                Point { path: *path, latency: *latency, speed: *speed, points, all, conservative, chosen }
            };
            latencies.par_iter().map(at).collect::<Vec<_>>()
        };
        cases.par_iter().flat_map_iter(one).collect()
    }

    fn pictures(&self, chosen: &Trial) -> Pictures {
        let (film, latency) =
            (self.film(self.shot(self.culling.path, 4, 1.0), &[]), self.culling.latency as usize);
        // What is 10 m ahead has moved farthest since the depth that has arrived.
        let ahead = |frame: usize| {
            let Camera { eye, axes, .. } = film.cameras[frame];
            [0, 1, 2].map(|k| eye[k] + 10.0 * axes[2][k])
        };
        let moved = |frame: usize| {
            let [from, to] = [ahead(frame - latency), ahead(frame)];
            (0..3).map(|k| (to[k] - from[k]) * (to[k] - from[k])).sum::<f32>()
        };
        let fastest = MEASURED.into_iter().max_by(|a, b| moved(*a).total_cmp(&moved(*b)));
        let frame = fastest.unwrap_or(MEASURED[0]);
        let mut grid = Grid::new(self.culling.grid, &self.site.bounds);
        film.accumulated(&mut grid, 0..frame - latency + 1);
        let sheet = |median: usize| {
            let passes = Passes { median, dilation: 0, ..ALL };
            [Passes { voxels: None, ..passes }, Passes { half: None, ..passes }, passes]
        };
        let all = [&sheet(0)[..], &sheet(MEDIAN), &[ALL, Passes::CONSERVATIVE, chosen.passes]].concat();
        let names = [
            "depth",
            "voxels",
            "both",
            "depth, median",
            "voxels, median",
            "both, median",
            "both, median, dilation",
            SAFE,
            CHOSEN,
        ];
        let made = |passes: &Passes| {
            let depth = film.fine(passes.fineness(), frame - latency);
            let late = Late { camera: &film.cameras[frame - latency], depth: &depth, grid: &grid };
            passes.run(late, &film.cameras[frame], self.size).0
        };
        Pictures {
            truth: film.depth[frame].clone(),
            old: film.depth[frame - latency].clone(),
            buffers: names.into_iter().zip(all.iter().map(made)).collect(),
        }
    }
}

/// Measures the culling of a scene, whose parameters are chosen: the same results on every run, for any
/// number of threads.
pub fn results(culling: &Culling, site: &Site, choices: Choices) -> Results {
    let (set, chosen) = (Set::new(culling, site), choices.best.trial);
    Results {
        culling: culling.clone(),
        rows: set.rows(&chosen),
        causes: PATHS.map(|path| set.causes(path)).to_vec(),
        sweep: set.sweep(&chosen),
        pictures: set.pictures(&chosen),
        choices,
    }
}

/// Whether any box is in any frame of the scene's path that is measured: without one there is no rate.
pub fn has_boxes(culling: &Culling, site: &Site) -> bool {
    let set = Set::new(culling, site);
    let (shot, _) = set.shot(culling.path, 4, 1.0);
    let in_frame = |frame: &usize| {
        let camera = shot.camera(*frame, site, set.size);
        site.objects.iter().any(|cuboid| Footprint::of(&camera, cuboid, set.size).is_ok())
    };
    MEASURED.iter().any(in_frame)
}
