//! A picture in linear light.

use lobefit_math::srgb;

/// Pixels of linear RGB with the primaries of sRGB (IEC 61966-2-1), row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `pixels[y * width + x]`, radiance, 0 or above.
    pub pixels: Vec<[f64; 3]>,
}

impl Image {
    /// The picture of a function of (column, row).
    pub fn of(width: usize, height: usize, f: impl Fn(usize, usize) -> [f64; 3]) -> Image {
        let pixels = (0..width * height).map(|i| f(i % width, i / width)).collect();
        Image { width, height, pixels }
    }
}

/// The curve of sRGB (IEC 61966-2-1) of linear light, cut to [0, 1].
pub fn encoded(x: f64) -> f64 {
    srgb::encoded(x.clamp(0.0, 1.0))
}

/// Luminance as displayed: the curve of sRGB of the luminance of linear RGB in [0, 1].
pub fn displayed(rgb: [f64; 3]) -> f64 {
    encoded(luminance(rgb))
}

/// Relative luminance Y of linear RGB (the middle row of the matrix of IEC 61966-2-1).
pub fn luminance(rgb: [f64; 3]) -> f64 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}
