//! A device that runs compute shaders, and what they are timed by.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::GpuError;
use super::texture::Texels;
use lobefit::data::TexelFormat;
use lobefit::report::{GpuClock, GpuDevice};

/// Invocations of a workgroup along either side.
pub(super) const WORKGROUP: u32 = 8;

/// Bytes of the block of uniforms: see [`super::shader`].
pub(super) const UNIFORM_BYTES: usize = 64;

/// Bytes of a stamp.
const STAMP_BYTES: u64 = 8;

/// An open device.
pub(super) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// Its name and driver.
    pub info: GpuDevice,
    /// Where times come from.
    pub clock: GpuClock,
    stamps: Option<Stamps>,
    /// The first thing that the driver complained of since the last look.
    complaint: Arc<Mutex<Option<String>>>,
}

/// Two time stamps and the buffers they are read through.
struct Stamps {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
    /// Nanoseconds of a step of the clock.
    period: f64,
}

/// A shader ready to run.
pub(super) struct Pass {
    /// What it is called in messages.
    pub name: String,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    uniform: wgpu::Buffer,
    sums: wgpu::Buffer,
}

/// Resources of a shader beside its sums and uniforms.
#[derive(Clone, Copy, Default)]
pub(super) struct Resources<'a> {
    /// A texture, which comes with a sampler.
    pub texture: Option<&'a wgpu::TextureView>,
    /// The planes of a proxy.
    pub planes: Option<&'a wgpu::Buffer>,
}

/// Adapters in the order in which they are taken.
fn rank(kind: wgpu::DeviceType) -> u32 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

fn kind(kind: wgpu::DeviceType) -> &'static str {
    match kind {
        wgpu::DeviceType::DiscreteGpu => "discrete",
        wgpu::DeviceType::IntegratedGpu => "integrated",
        wgpu::DeviceType::VirtualGpu => "virtual",
        wgpu::DeviceType::Other => "other",
        wgpu::DeviceType::Cpu => "software",
    }
}

fn adapter(wanted: Option<&str>) -> Result<wgpu::Adapter, GpuError> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    // A stable sort: of equals the one that the loader names first.
    adapters.sort_by_key(|adapter| rank(adapter.get_info().device_type));
    let names: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let fits = |name: &str| wanted.is_none_or(|part| name.to_lowercase().contains(&part.to_lowercase()));
    let chosen = names.iter().position(|name| fits(name));
    let none = || GpuError::NoAdapter { wanted: wanted.map(String::from), found: names.clone() };
    chosen.map(|i| adapters.swap_remove(i)).ok_or_else(none)
}

impl Gpu {
    /// The first device whose name holds a text, discrete ones before integrated and those before
    /// software.
    pub fn open(wanted: Option<&str>) -> Result<Gpu, GpuError> {
        let adapter = adapter(wanted)?;
        let info = adapter.get_info();
        use wgpu::Features as Of;
        let useful = Of::TIMESTAMP_QUERY | Of::FLOAT32_FILTERABLE | Of::TEXTURE_FORMAT_16BIT_NORM;
        let features = adapter.features() & useful;
        let stamped = features.contains(wgpu::Features::TIMESTAMP_QUERY);
        let descriptor = wgpu::DeviceDescriptor {
            required_features: features,
            required_limits: wgpu::Limits::downlevel_defaults(),
            ..Default::default()
        };
        let refused = |e: wgpu::RequestDeviceError| {
            GpuError::Device(format!("{}: {e}; take another with --adapter", info.name))
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).map_err(refused)?;
        let complaint = Arc::new(Mutex::new(None));
        let first = Arc::clone(&complaint);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            first.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error.to_string());
        }));
        let stamps = stamped.then(|| Stamps::new(&device, f64::from(queue.get_timestamp_period())));
        let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ").trim().to_owned();
        let info = GpuDevice {
            adapter: info.name,
            kind: kind(info.device_type).into(),
            driver,
            backend: info.backend.to_string(),
        };
        let clock = if stamped { GpuClock::Timestamps } else { GpuClock::Wall };
        Ok(Gpu { device, queue, info, clock, stamps, complaint })
    }

    /// An error where the driver has complained.
    fn well(&self, doing: &str) -> Result<(), GpuError> {
        match self.complaint.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(reason) => Err(self.failed(doing, reason)),
            None => Ok(()),
        }
    }

    fn failed(&self, doing: &str, reason: String) -> GpuError {
        let advice = "take another with --adapter, or less work with --reduced";
        GpuError::Device(format!("{}, {doing}: {reason}; {advice}", self.info.adapter))
    }

    /// The formats of which it filters no textures.
    pub fn unfiltered(&self) -> Vec<TexelFormat> {
        let needed = [
            (TexelFormat::F32, wgpu::Features::FLOAT32_FILTERABLE),
            (TexelFormat::Unorm16, wgpu::Features::TEXTURE_FORMAT_16BIT_NORM),
        ];
        let has = self.device.features();
        needed.into_iter().filter(|(_, feature)| !has.contains(*feature)).map(|(format, _)| format).collect()
    }

    /// An empty buffer.
    pub fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        buffer(&self.device, size, usage)
    }

    /// A uniform buffer of these floats.
    pub fn floats(&self, values: &[f32]) -> wgpu::Buffer {
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = self.buffer(bytes.len() as u64, usage);
        self.queue.write_buffer(&buffer, 0, &bytes);
        buffer
    }

    /// A texture, filled.
    pub fn texture(&self, texels: &Texels) -> Result<wgpu::TextureView, GpuError> {
        let view = texels.upload(&self.device, &self.queue);
        self.well(&texels.to_string()).map(|()| view)
    }

    /// Compiles a shader of [`super::shader`], which adds into `sums`.
    pub fn pass(
        &self,
        name: &str,
        source: &str,
        sums: &wgpu::Buffer,
        resources: Resources,
    ) -> Result<Pass, GpuError> {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        let module =
            self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(name), source });
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: None,
            module: &module,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        self.well(name)?;
        let uniform = self.floats(&[0.0; UNIFORM_BYTES / 4]);
        let sampler = self.linear();
        let mut bound = vec![(0, sums.as_entire_binding()), (1, uniform.as_entire_binding())];
        if let Some(view) = resources.texture {
            bound.push((2, wgpu::BindingResource::TextureView(view)));
            bound.push((3, wgpu::BindingResource::Sampler(&sampler)));
        }
        bound.extend(resources.planes.map(|planes| (4, planes.as_entire_binding())));
        let entry = |(binding, resource)| wgpu::BindGroupEntry { binding, resource };
        let entries: Vec<wgpu::BindGroupEntry> = bound.into_iter().map(entry).collect();
        let layout = pipeline.get_bind_group_layout(0);
        let descriptor = wgpu::BindGroupDescriptor { label: Some(name), layout: &layout, entries: &entries };
        let group = self.device.create_bind_group(&descriptor);
        self.well(name)?;
        Ok(Pass { name: name.into(), pipeline, group, uniform, sums: sums.clone() })
    }

    /// A sampler that filters within and between levels and clamps to the edge.
    fn linear(&self) -> wgpu::Sampler {
        self.device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        })
    }

    /// Writes a pass's uniforms.
    pub fn set(&self, pass: &Pass, uniforms: &[u8; UNIFORM_BYTES]) {
        self.queue.write_buffer(&pass.uniform, 0, uniforms);
    }

    /// Nanoseconds of one dispatch over a square of pixels.
    pub fn time(&self, pass: &Pass, side: u32) -> Result<f64, GpuError> {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let stamps = self.stamps.as_ref();
        let mut work = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: None,
            timestamp_writes: stamps.map(|stamps| wgpu::ComputePassTimestampWrites {
                query_set: &stamps.set,
                beginning_of_pass_write_index: Some(0),
                end_of_pass_write_index: Some(1),
            }),
        });
        work.set_pipeline(&pass.pipeline);
        work.set_bind_group(0, &pass.group, &[]);
        work.dispatch_workgroups(side / WORKGROUP, side / WORKGROUP, 1);
        drop(work);
        if let Some(stamps) = stamps {
            stamps.copy(&mut encoder);
        }
        let commands = encoder.finish();
        let start = Instant::now();
        self.queue.submit([commands]);
        self.wait(&pass.name)?;
        let wall = start.elapsed().as_secs_f64() * 1e9;
        let time = match stamps {
            Some(stamps) => stamps.between(&self.read(&stamps.read, &pass.name)?),
            None => wall,
        };
        if time > 0.0 {
            return Ok(time);
        }
        Err(GpuError::Device(format!("{}, {}: the clock did not advance", self.info.adapter, pass.name)))
    }

    /// An error where one of the sums of a pass that has run is not finite.
    pub fn check(&self, pass: &Pass) -> Result<(), GpuError> {
        let size = pass.sums.size();
        let read = self.buffer(size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&pass.sums, 0, &read, 0, size);
        self.queue.submit([encoder.finish()]);
        let bytes = self.read(&read, &pass.name)?;
        let finite = |b: &[u8]| <[u8; 4]>::try_from(b).is_ok_and(|b| f32::from_le_bytes(b).is_finite());
        if bytes.chunks_exact(4).all(finite) {
            return Ok(());
        }
        Err(GpuError::NotFinite { adapter: self.info.adapter.clone(), function: pass.name.clone() })
    }

    fn wait(&self, doing: &str) -> Result<(), GpuError> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        polled.map_err(|e| self.failed(doing, e.to_string()))?;
        self.well(doing)
    }

    /// The bytes of a buffer that can be mapped.
    fn read(&self, buffer: &wgpu::Buffer, doing: &str) -> Result<Vec<u8>, GpuError> {
        let (send, receive) = std::sync::mpsc::channel();
        // The receiver outlives the call.
        buffer.map_async(wgpu::MapMode::Read, .., move |result| drop(send.send(result)));
        self.wait(doing)?;
        let mapped = receive.recv().map_err(|e| self.failed(doing, e.to_string()))?;
        mapped.map_err(|e| self.failed(doing, e.to_string()))?;
        let range = buffer.get_mapped_range(..).map_err(|e| self.failed(doing, e.to_string()))?;
        let bytes = range.to_vec();
        drop(range);
        buffer.unmap();
        Ok(bytes)
    }
}

fn buffer(device: &wgpu::Device, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
}

impl Stamps {
    fn new(device: &wgpu::Device, period: f64) -> Stamps {
        let set = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: None,
            ty: wgpu::QueryType::Timestamp,
            count: 2,
        });
        let size = 2 * STAMP_BYTES;
        let resolved = buffer(device, size, wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
        let read = buffer(device, size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        Stamps { set, resolved, read, period }
    }

    fn copy(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.set, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read, 0, 2 * STAMP_BYTES);
    }

    /// Nanoseconds from the first stamp to the second; 0 where there is none.
    fn between(&self, bytes: &[u8]) -> f64 {
        let stamp = |k: usize| {
            let of = bytes.get(8 * k..8 * k + 8).and_then(|b| <[u8; 8]>::try_from(b).ok());
            of.map_or(0, u64::from_le_bytes)
        };
        stamp(1).saturating_sub(stamp(0)) as f64 * self.period
    }
}
