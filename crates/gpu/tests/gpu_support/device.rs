//! A Vulkan device that runs compute shaders.

use lobefit::data::{Table, TexelFormat};

/// What to install where there is none.
pub const INSTALL: &str =
    "a Vulkan driver and loader (Debian: apt-get install mesa-vulkan-drivers libvulkan1)";

/// An open device.
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// Name, driver and kind.
    pub name: String,
}

/// Invocations of a workgroup.
pub const WORKGROUP: usize = 64;

impl Gpu {
    /// The Vulkan adapter that the loader offers first, or why there is none.
    pub fn open() -> Result<Gpu, String> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::VULKAN;
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions::default();
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(|e| e.to_string())?;
        let info = adapter.get_info();
        let wanted = wgpu::DeviceDescriptor {
            required_limits: wgpu::Limits::downlevel_defaults(),
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&wanted)).map_err(|e| e.to_string())?;
        let name = format!("{} ({} {}, {:?})", info.name, info.driver, info.driver_info, info.device_type);
        Ok(Gpu { device, queue, name })
    }

    /// A shader module. The device panics with the compiler's words if it is not valid.
    pub fn module(&self, source: &str) -> wgpu::ShaderModule {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
    }

    /// A shader module in SPIR-V.
    pub fn spirv(&self, bytes: &[u8]) -> wgpu::ShaderModule {
        let words = bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        let source = wgpu::ShaderSource::SpirV(words);
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
    }

    /// A storage buffer that holds `bytes`.
    pub fn buffer(&self, bytes: &[u8]) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let buffer = self.empty(bytes.len(), usage);
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    fn empty(&self, size: usize, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let descriptor =
            wgpu::BufferDescriptor { label: None, size: size as u64, usage, mapped_at_creation: false };
        self.device.create_buffer(&descriptor)
    }

    /// A quantised f16 table as a 2-D or 3-D texture of one, two or four halves.
    pub fn texture(&self, table: &Table) -> wgpu::TextureView {
        let [columns, rows, slices] = table.size().map(|n| n as u32);
        let channels = table.channels.len();
        let format = match channels {
            1 => wgpu::TextureFormat::R16Float,
            2 => wgpu::TextureFormat::Rg16Float,
            4 => wgpu::TextureFormat::Rgba16Float,
            n => panic!("no texture of {n} halves"),
        };
        let solid = table.axes.len() == 3;
        let size = wgpu::Extent3d { width: columns, height: rows, depth_or_array_layers: slices };
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: if solid { wgpu::TextureDimension::D3 } else { wgpu::TextureDimension::D2 },
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let texels: usize = table.size().iter().product();
        let mut bytes = Vec::new();
        let numbers = (0..texels).flat_map(|i| table.channels.iter().map(move |c| c.texels[i]));
        numbers.for_each(|x| TexelFormat::F16.write(x, &mut bytes));
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(columns * 2 * channels as u32),
            rows_per_image: Some(rows),
        };
        self.queue.write_texture(texture.as_image_copy(), &bytes, layout, size);
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// A sampler that filters linearly and clamps to the edge.
    pub fn linear_clamp(&self) -> wgpu::Sampler {
        self.device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        })
    }

    /// Runs an entry point once per point; `resources` are the bindings 0.. of group 0, and the
    /// binding after them is a buffer of `count` f32, which is returned.
    pub fn run(
        &self,
        module: &wgpu::ShaderModule,
        entry: &str,
        resources: &[wgpu::BindingResource],
        points: usize,
        count: usize,
    ) -> Vec<f32> {
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let size = count * size_of::<f32>();
        let out = self.empty(size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let read = self.empty(size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let all = resources.iter().cloned().chain([out.as_entire_binding()]);
        let entries: Vec<wgpu::BindGroupEntry> =
            all.zip(0..).map(|(resource, binding)| wgpu::BindGroupEntry { binding, resource }).collect();
        let layout = pipeline.get_bind_group_layout(0);
        let descriptor = wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries };
        let group = self.device.create_bind_group(&descriptor);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(points.div_ceil(WORKGROUP) as u32, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&out, 0, &read, 0, size as u64);
        self.queue.submit([encoder.finish()]);
        self.mapped(&read)
    }

    fn mapped(&self, buffer: &wgpu::Buffer) -> Vec<f32> {
        let (send, receive) = std::sync::mpsc::channel();
        // The receiver outlives the call.
        buffer.map_async(wgpu::MapMode::Read, .., move |result| drop(send.send(result)));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        receive.recv().expect("mapped").expect("mapped");
        let bytes = buffer.get_mapped_range(..).expect("mapped");
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
    }
}
