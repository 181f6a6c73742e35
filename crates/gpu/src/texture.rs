//! Textures to fetch from: their size and format are what a time depends on, not their texels.

use std::fmt;

use lobefit::data::TexelFormat;

/// A texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Texels {
    /// Axes and channels.
    pub shape: Shape,
    /// Type of a channel.
    pub format: TexelFormat,
}

/// Axes and channels of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// Of two axes: columns, rows; channels.
    Flat([u32; 2], u32),
    /// Of three axes: columns, rows, slices; channels.
    Solid([u32; 3], u32),
    /// A cubemap of four channels: texels along an edge, levels.
    Cube(u32, u32),
}

impl Texels {
    /// The type in WGSL.
    pub fn wgsl(self) -> &'static str {
        match self.shape {
            Shape::Flat(..) => "texture_2d<f32>",
            Shape::Solid(..) => "texture_3d<f32>",
            Shape::Cube(..) => "texture_cube<f32>",
        }
    }

    /// Channels that there is a format of.
    fn channels(self) -> u32 {
        match self.shape {
            Shape::Flat(_, channels) | Shape::Solid(_, channels) => match channels {
                1 | 2 => channels,
                _ => 4,
            },
            Shape::Cube(..) => 4,
        }
    }

    fn format(self) -> wgpu::TextureFormat {
        use wgpu::TextureFormat as Of;
        let formats = match self.format {
            TexelFormat::Unorm8 => [Of::R8Unorm, Of::Rg8Unorm, Of::Rgba8Unorm],
            TexelFormat::Unorm16 => [Of::R16Unorm, Of::Rg16Unorm, Of::Rgba16Unorm],
            TexelFormat::F16 => [Of::R16Float, Of::Rg16Float, Of::Rgba16Float],
            TexelFormat::F32 => [Of::R32Float, Of::Rg32Float, Of::Rgba32Float],
        };
        formats[(self.channels() / 2) as usize]
    }

    fn size(self) -> wgpu::Extent3d {
        let [width, height, depth_or_array_layers] = match self.shape {
            Shape::Flat([columns, rows], _) => [columns, rows, 1],
            Shape::Solid(size, _) => size,
            Shape::Cube(edge, _) => [edge, edge, 6],
        };
        wgpu::Extent3d { width, height, depth_or_array_layers }
    }

    fn levels(self) -> u32 {
        if let Shape::Cube(_, levels) = self.shape { levels } else { 1 }
    }

    /// The texture, filled.
    pub fn upload(self, device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
        let solid = matches!(self.shape, Shape::Solid(..));
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: self.size(),
            mip_level_count: self.levels(),
            sample_count: 1,
            dimension: if solid { wgpu::TextureDimension::D3 } else { wgpu::TextureDimension::D2 },
            format: self.format(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for level in 0..self.levels() {
            self.fill(&texture, level, queue);
        }
        let cube = matches!(self.shape, Shape::Cube(..)).then_some(wgpu::TextureViewDimension::Cube);
        texture.create_view(&wgpu::TextureViewDescriptor { dimension: cube, ..Default::default() })
    }

    fn fill(self, texture: &wgpu::Texture, level: u32, queue: &wgpu::Queue) {
        let mut size = self.size();
        size.width = (size.width >> level).max(1);
        size.height = (size.height >> level).max(1);
        let values = size.width * size.height * size.depth_or_array_layers * self.channels();
        let mut bytes = Vec::new();
        (0..values).for_each(|i| self.format.write(texel(i).into(), &mut bytes));
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.width * self.format.bytes() as u32 * self.channels()),
            rows_per_image: Some(size.height),
        };
        let mut place = texture.as_image_copy();
        place.mip_level = level;
        queue.write_texture(place, &bytes, layout, size);
    }
}

/// Values in [0.1, 0.9), no two neighbours alike, so that no driver stores them as one: steps of
/// the golden section.
fn texel(i: u32) -> f32 {
    let turn = i.wrapping_mul(0x9e37_79b9) >> 8;
    0.1 + 0.8 * turn as f32 / 16_777_216.0
}

impl fmt::Display for Texels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (channels, format) = (self.channels(), self.format.name());
        match self.shape {
            Shape::Flat([columns, rows], _) => {
                write!(f, "texture {columns}x{rows}, {channels} x {format}")
            }
            Shape::Solid([columns, rows, slices], _) => {
                write!(f, "texture {columns}x{rows}x{slices}, {channels} x {format}")
            }
            Shape::Cube(edge, levels) => {
                write!(f, "cubemap {edge}x{edge}, {levels} levels, {channels} x {format}")
            }
        }
    }
}
