//! Wanted tables of three axes: of an anisotropic lobe, and of rough glass.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::limits::{VOLUME_CELLS, VOLUME_LINES};
use super::material::Lobe;
use super::number::{ErrorLimit, In, Numbers, VolumeAxisSize, Whole};
use super::value::{Maybe, Word, about, from_file};
use crate::data::TexelFormat;
pub use crate::data::VolumeLayout;

/// The limit on the lookup error where neither size nor limit is given. What a 64x64x32 (anisotropic) and a 128x128x32
/// (glass) table in the optimised layout are to reach for alpha >= 0.02, and a 64x16x16 one with the azimuth.
fn default_limit(layout: VolumeLayout) -> Option<f64> {
    match layout {
        VolumeLayout::Optimised => Some(2e-3),
        VolumeLayout::Azimuth => Some(1e-2),
        VolumeLayout::PathTracer => None,
    }
}

/// Columns, rows and slices where the scene gives none. The path tracer's are fixed.
fn default_size(lobe: Lobe, layout: VolumeLayout) -> [usize; 3] {
    match (lobe, layout) {
        (Lobe::Glass, _) => [128, 128, 32],
        (_, VolumeLayout::Azimuth) => [64, 16, 16],
        _ => [64, 64, 32],
    }
}

/// A wanted table of three axes; of glass two tables, one for rays from outside and one for rays from inside.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VolumeWant {
    /// Coordinates.
    pub layout: VolumeLayout,
    /// Columns, rows and slices.
    pub size: [usize; 3],
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Largest error of the trilinear lookup that the bake may deliver; never given in the path tracer's layout.
    pub max_error: Option<f64>,
}

/// A wanted table of three axes whose size the lobe decides where it is open.
pub(super) struct OpenVolume {
    layout: VolumeLayout,
    size: Option<[usize; 3]>,
    format: TexelFormat,
    max_error: Option<f64>,
}

/// A table of three axes: of the azimuth mean of an anisotropic lobe's albedo over mu, roughness and anisotropy, of
/// that albedo with the azimuth, or of rough glass over mu, roughness and index of refraction, for rays from outside
/// and from inside. The error of a table is that of its trilinear lookup after rounding to the texel format.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Volume")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes a table of three axes")]
struct VolumeFile {
    /// Coordinates of the texels; default `optimised`. `path-tracer` takes separable Smith and alpha = roughness whatever
    /// the scene says, has its own size and takes no `max_error`; `azimuth` is for anisotropic materials.
    layout: Maybe<Word<VolumeLayout>>,
    /// Columns, rows and slices, at most 4194304 texels, and in the optimised layout 16384 columns times slices. Default: 64x64x32, with the azimuth 64x16x16, of glass 128x128x32.
    size: Maybe<Numbers<Whole<VolumeAxisSize>, 3, false>>,
    /// Texel format; default `f16`.
    format: Maybe<Word<TexelFormat>>,
    /// Limit on the lookup error; the bake fails where it is exceeded. Default without `size`: 0.002, with the azimuth
    /// 0.01; with `size`: no limit.
    max_error: Maybe<In<ErrorLimit>>,
}

impl TryFrom<VolumeFile> for OpenVolume {
    type Error = String;

    fn try_from(file: VolumeFile) -> Result<Self, String> {
        let layout = file.layout.0.map_or_else(VolumeLayout::default, |w| w.0);
        let size = file.size.0.map(|Numbers(size)| size.map(|n| n.0 as usize));
        let limit = file.max_error.0.map(|e| e.0);
        if layout == VolumeLayout::PathTracer {
            if size.is_some() {
                return Err(about("size", "the path-tracer layout has its own; leave it out"));
            }
            if limit.is_some() {
                let message = "the error of the path-tracer layout is reported, not chosen; leave it out";
                return Err(about("max_error", message));
            }
        }
        if let Some([columns, rows, slices]) =
            size.filter(|size| size.iter().product::<usize>() > VOLUME_CELLS)
        {
            let message = format!("{columns}x{rows}x{slices} is more than {VOLUME_CELLS} texels");
            return Err(about("size", message));
        }
        if let Some([columns, _, slices]) = size.filter(|[columns, _, slices]| {
            layout == VolumeLayout::Optimised && columns * slices > VOLUME_LINES
        }) {
            let message = format!(
                "{columns} columns x {slices} slices of the optimised layout are more than {VOLUME_LINES}; rows cost less"
            );
            return Err(about("size", message));
        }
        let max_error = limit.or_else(|| if size.is_none() { default_limit(layout) } else { None });
        Ok(OpenVolume { layout, size, format: file.format.0.map_or(TexelFormat::F16, |w| w.0), max_error })
    }
}

from_file!(OpenVolume, VolumeFile);

impl OpenVolume {
    /// With the default of every field.
    pub(super) fn default() -> Result<Self, String> {
        OpenVolume::try_from(VolumeFile::default())
    }

    /// The table as a material with this lobe wants it.
    pub(super) fn of(self, lobe: Lobe) -> Result<VolumeWant, String> {
        let OpenVolume { layout, size, format, max_error } = self;
        if lobe == Lobe::Glass && layout == VolumeLayout::Azimuth {
            return Err(about("layout", "`azimuth` is for anisotropic materials; glass has none"));
        }
        Ok(VolumeWant { layout, size: size.unwrap_or_else(|| default_size(lobe, layout)), format, max_error })
    }
}
