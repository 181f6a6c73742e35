//! How long passes take on a machine: a record beside the page, which differs from run to run as no
//! page may.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::film::{Film, Shot};
use crate::grid::Grid;
use crate::measure::Trial;
use crate::passes::{Late, Work};
use crate::site::Site;
use crate::study::{FRAMES, MEASURED, Row, Way, Ways, WithGrid, ways};
use lobefit::scene::Culling;

/// Runs of each pass, of which the fastest counts.
const REPEATS: usize = 5;

/// Version of the way of measuring: to be raised where times before and after cannot be compared.
const METHOD: u32 = 1;

/// The record of a machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Version of the way of measuring.
    pub method: u32,
    /// What measured it.
    pub command: String,
    /// The processor as the system names it, and the threads in use.
    pub device: String,
    /// Every row of the results.
    pub rows: Vec<Timed>,
}

/// One row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timed {
    /// Its name, size of the buffer and voxels of the grid: [`Row`].
    pub name: String,
    /// The same.
    pub buffer: [usize; 2],
    /// The same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub voxels: Option<[u32; 3]>,
    /// Texels and voxels that were touched in all frames: of other code or another scene it is
    /// another number.
    pub work: u64,
    /// Milliseconds of each pass for a frame, of the fastest of five runs, their mean over frames.
    pub milliseconds: Work<f64>,
}

/// Why the page has no times.
pub const NONE: &str = "no times are recorded beside this page";
/// The same of a record that is not of the page's results.
pub const OTHER: &str = "the times recorded beside this page are of other passes or of another scene";

impl Times {
    /// Measures the passes of a scene on this machine, on one thread, with the parameters that were
    /// chosen for it; by a command, on a device.
    pub fn measured(
        (culling, site): (&Culling, &Site),
        chosen: &Trial,
        [command, device]: [String; 2],
    ) -> Times {
        let latency = culling.latency as usize;
        let late: Vec<usize> = MEASURED.iter().map(|frame| frame - latency).collect();
        let mut rows = Vec::new();
        for Ways { buffer, grids } in ways(culling, chosen) {
            let shot = Shot { path: culling.path, start: 4, speed: 1.0 };
            let film = Film::new(site, (shot, FRAMES), buffer, &[2, 4], &late);
            for grid in grids {
                rows.extend(of_grid(&film, latency, &grid));
            }
        }
        Times { method: METHOD, command, device, rows }
    }

    /// The times of each row of results; why there are none.
    ///
    /// # Errors
    /// A record of other rows, or of rows that did other work.
    pub fn of<'t>(times: Option<&'t Times>, rows: &[Row]) -> Result<Vec<&'t Timed>, &'static str> {
        let record = times.ok_or(NONE)?;
        let is_of = |(timed, row): (&'t Timed, &Row)| {
            let known = (timed.name == row.name) && timed.buffer == row.buffer && timed.voxels == row.voxels;
            (known && timed.work == row.tally.work.total()).then_some(timed)
        };
        let found: Option<Vec<&Timed>> = record.rows.iter().zip(rows).map(is_of).collect();
        found.filter(|found| found.len() == rows.len() && record.method == METHOD).ok_or(OTHER)
    }
}

/// Times with a grid: of each way.
fn of_grid(film: &Film, latency: usize, WithGrid { voxels, ways }: &WithGrid) -> Vec<Timed> {
    let mut rows: Vec<Timed> = ways
        .iter()
        .map(|way| Timed {
            name: way.name.clone(),
            buffer: film.size,
            voxels: way.trial.passes.voxels.map(|_| *voxels),
            work: 0,
            milliseconds: Work::default(),
        })
        .collect();
    let mut grid = Grid::new(*voxels, &film.site.bounds);
    let mut next = 0;
    for &frame in &MEASURED {
        let late = frame - latency;
        film.accumulated(&mut grid, next..late);
        next = late + 1;
        let (mut arrived, mut fastest) = (0, f64::INFINITY);
        let before = grid.clone();
        for _ in 0..REPEATS {
            grid = before.clone();
            let start = Instant::now();
            arrived = film.accumulated(&mut grid, late..late + 1);
            fastest = fastest.min(start.elapsed().as_secs_f64());
        }
        for (row, Way { trial: Trial { passes, .. }, .. }) in rows.iter_mut().zip(ways) {
            let depth = film.fine(passes.fineness(), late);
            let late = Late { camera: &film.cameras[late], depth: &depth, grid: &grid };
            let run = || passes.run(late, &film.cameras[frame], film.size);
            let (_, mut work, mut seconds) = run();
            for _ in 1..REPEATS {
                seconds = seconds.zip(run().2, f64::min);
            }
            if passes.voxels.is_some() {
                (work.accumulate, seconds.accumulate) = (arrived, fastest);
            }
            row.work += work.total();
            let each = 1e3 / MEASURED.len() as f64;
            row.milliseconds = row.milliseconds.zip(seconds, |sum, s| sum + each * s);
        }
    }
    rows
}
