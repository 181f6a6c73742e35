//! Repeated measurements of jobs that take turns.

use std::collections::BTreeMap;

use super::device::{Gpu, Pass, Resources};
use super::jobs::Job;
use super::shader::{planes, uniforms};
use super::texture::Texels;
use super::{GpuError, Work};
use lobefit::bake::Progress;
use lobefit::report::{GpuAgainst, GpuRow, GpuSpread};

/// Evaluations of a thread to begin with, and at most. With fewer the loop's own beginning and end
/// would weigh.
const FEWEST: u32 = 32;
const MOST: u32 = 1 << 14;

/// Nanoseconds that a device works before the first measurement, so that its clock has risen.
const WARM_UP: f64 = 3e8;

/// A job ready to run.
struct Pair {
    with: Pass,
    without: Pass,
    evaluations: u32,
}

/// Nanoseconds per evaluation of each repeat, with the function and without.
#[derive(Clone, Default)]
struct Times {
    with: Vec<f64>,
    without: Vec<f64>,
}

/// What was measured, in the order of the jobs.
pub(super) struct Measured {
    evaluations: Vec<u32>,
    times: Vec<Times>,
    threads: f64,
}

/// Textures that jobs share.
type Views = BTreeMap<String, wgpu::TextureView>;

impl Measured {
    /// Measures jobs on a device.
    pub fn of(gpu: &Gpu, jobs: &[Job], work: Work, progress: &dyn Progress) -> Result<Measured, GpuError> {
        progress.stage("shaders");
        let threads = u64::from(work.side) * u64::from(work.side);
        let sums = gpu.buffer(4 * threads, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let mut views = Views::new();
        let mut pairs = Vec::new();
        for job in jobs {
            pairs.push(Pair::new(gpu, job, &sums, &mut views)?);
        }
        progress.stage("lengths of loops");
        for pair in &mut pairs {
            pair.lengthen(gpu, work)?;
        }
        warm(gpu, &pairs, work)?;
        let mut times = vec![Times::default(); pairs.len()];
        for repeat in 0..work.repeats {
            progress.stage(&format!("repeat {} of {}", repeat + 1, work.repeats));
            for (pair, times) in pairs.iter().zip(&mut times) {
                times.take(pair.times(gpu, work, repeat % 2 == 1)?);
            }
        }
        let evaluations = pairs.iter().map(|pair| pair.evaluations).collect();
        Ok(Measured { evaluations, times, threads: threads as f64 })
    }

    /// The rows of a record.
    pub fn rows(&self, jobs: &[Job]) -> Vec<GpuRow> {
        let row = |(i, job): (usize, &Job)| {
            let added = self.added(i);
            let nanoseconds = GpuSpread::of(&added)?;
            let times = &self.times[i];
            let ratios: Vec<f64> = times.with.iter().zip(&times.without).map(|(a, b)| a / b).collect();
            let rate = (nanoseconds.low > 0.0).then(|| 1e9 / nanoseconds.median);
            Some(GpuRow {
                name: job.name.clone(),
                kind: job.kind,
                function: job.function.as_ref().map(|(name, _)| name.clone()),
                code: job.function.as_ref().map(|(_, code)| code.clone()),
                ops: job.ops,
                fetches: job.fetches,
                error: job.error.clone(),
                evaluations: self.evaluations[i],
                loop_nanoseconds: self.per_evaluation(i, GpuSpread::of(&times.without)?.median),
                nanoseconds,
                ratio: GpuSpread::of(&ratios)?,
                evaluations_per_second: rate,
                against: job.against.and_then(|k| self.against(&added, &jobs[k].name, k)),
            })
        };
        jobs.iter().enumerate().filter_map(row).collect()
    }

    fn per_evaluation(&self, job: usize, nanoseconds: f64) -> f64 {
        nanoseconds / (self.threads * f64::from(self.evaluations[job]))
    }

    /// What an evaluation of a job adds to its loop, repeat by repeat.
    fn added(&self, job: usize) -> Vec<f64> {
        let times = &self.times[job];
        let pairs = times.with.iter().zip(&times.without);
        pairs.map(|(with, without)| self.per_evaluation(job, with - without)).collect()
    }

    /// Over what a plain fetch adds; none where that is not told from 0.
    fn against(&self, added: &[f64], name: &str, fetch: usize) -> Option<GpuAgainst> {
        let fetched = self.added(fetch);
        if GpuSpread::of(&fetched)?.low <= 0.0 || fetched.contains(&0.0) {
            return None;
        }
        let ratios: Vec<f64> = added.iter().zip(&fetched).map(|(a, b)| a / b).collect();
        Some(GpuAgainst { fetch: name.into(), ratio: GpuSpread::of(&ratios)? })
    }
}

impl Times {
    fn take(&mut self, [with, without]: [f64; 2]) {
        self.with.push(with);
        self.without.push(without);
    }
}

impl Pair {
    fn new(gpu: &Gpu, job: &Job, sums: &wgpu::Buffer, views: &mut Views) -> Result<Pair, GpuError> {
        let texture = job.texture.map(|texels| view(gpu, texels, views)).transpose()?;
        let planes = job.shader.planes.map(|count| gpu.floats(&planes(count)));
        let resources = Resources { texture: texture.as_ref(), planes: planes.as_ref() };
        Ok(Pair {
            with: gpu.pass(&job.name, &job.shader.with, sums, resources)?,
            without: gpu.pass(
                &format!("loop of {}", job.name),
                &job.shader.without,
                sums,
                Resources::default(),
            )?,
            evaluations: FEWEST,
        })
    }

    /// Sets the number of evaluations so that a dispatch takes long enough, and looks whether its
    /// results are numbers.
    fn lengthen(&mut self, gpu: &Gpu, work: Work) -> Result<(), GpuError> {
        loop {
            let uniforms = uniforms(self.evaluations, work.side);
            gpu.set(&self.with, &uniforms);
            gpu.set(&self.without, &uniforms);
            // The first run of a shader may compile it.
            gpu.time(&self.with, work.side)?;
            let time = gpu.time(&self.with, work.side)?;
            if time >= work.shortest || self.evaluations >= MOST {
                gpu.check(&self.with)?;
                gpu.time(&self.without, work.side)?;
                return gpu.check(&self.without);
            }
            self.evaluations *= 2;
        }
    }

    /// Nanoseconds with the function and without, in this order or the other.
    fn times(&self, gpu: &Gpu, work: Work, turned: bool) -> Result<[f64; 2], GpuError> {
        if turned {
            let without = gpu.time(&self.without, work.side)?;
            return Ok([gpu.time(&self.with, work.side)?, without]);
        }
        Ok([gpu.time(&self.with, work.side)?, gpu.time(&self.without, work.side)?])
    }
}

/// Runs everything for a while; not where the work is reduced.
fn warm(gpu: &Gpu, pairs: &[Pair], work: Work) -> Result<(), GpuError> {
    let mut spent = if work.reduced { WARM_UP } else { 0.0 };
    while spent < WARM_UP {
        for pair in pairs {
            spent += pair.times(gpu, work, false)?.iter().sum::<f64>();
        }
    }
    Ok(())
}

fn view(gpu: &Gpu, texels: Texels, views: &mut Views) -> Result<wgpu::TextureView, GpuError> {
    let name = texels.to_string();
    if let Some(view) = views.get(&name) {
        return Ok(view.clone());
    }
    let view = gpu.texture(&texels)?;
    views.insert(name, view.clone());
    Ok(view)
}
