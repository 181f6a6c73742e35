//! How different two pictures look to somebody who flips between them, pixel by pixel: FLIP.
//!
//! [`ldr`]: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A
//! Difference Evaluator for Alternating Images" (Proc. ACM Comput. Graph. Interact. Tech. 3(2)).
//! [`Reference`]: Andersson, Nilsson, Shirley and Akenine-Moller 2021, "Visualizing Errors in Rendered
//! High Dynamic Range Images" (Eurographics short papers). 0 is no difference, 1 the largest that
//! there is (green against blue). Written from the formulas of the papers;
//! `crates/studies/tests/studies/flip.rs` compares with the authors' program, which computes in
//! f32.

mod colour;
mod difference;
mod exposure;
mod filter;

pub use exposure::{Exposures, Reference, shown};

use lobefit::report::Image;

/// Pixels per degree of visual angle where none are given: a display of 3840 pixels and 0.7 m in a
/// distance of 0.7 m, as in the paper.
pub const PIXELS_PER_DEGREE: f64 = 0.7 * 3840.0 / 0.7 * std::f64::consts::PI / 180.0;

/// The difference at each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `values[y * width + x]` in [0, 1].
    pub values: Vec<f64>,
}

/// Pictures that cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlipError {
    /// A picture without pixels, or with another number of them than its size says.
    #[error("FLIP: the {which} picture has {found} pixels, {width} x {height} are called for")]
    Shape {
        /// `reference` or `test`.
        which: &'static str,
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Pixels that it has.
        found: usize,
    },
    /// Two pictures of different sizes.
    #[error("FLIP: the reference is {reference:?} pixels, the test {test:?}; give pictures of one size")]
    Sizes {
        /// Width and height of the reference.
        reference: (usize, usize),
        /// Width and height of the other.
        test: (usize, usize),
    },
    /// A pixel that is no light.
    #[error("FLIP: the {which} picture at column {column}, row {row} is {value}; {limits} is called for")]
    Pixel {
        /// `reference` or `test`.
        which: &'static str,
        /// Where.
        column: usize,
        /// Where.
        row: usize,
        /// The channel's value.
        value: f64,
        /// The values there may be.
        limits: &'static str,
    },
    /// Pixels per degree that are no resolution.
    #[error("FLIP: {value} pixels per degree; a finite number of at least 1 and at most 1000 is called for")]
    Resolution {
        /// The number.
        value: f64,
    },
    /// A reference that has no light: no exposure shows it.
    #[error("FLIP: the reference is black everywhere, so no exposure can be chosen")]
    Black,
}

/// LDR-FLIP of two pictures in linear light, every channel in [0, 1] (decode an sRGB picture
/// first).
///
/// # Errors
/// Pictures of different sizes, a channel outside [0, 1], a resolution that is none.
pub fn ldr(reference: &Image, test: &Image, pixels_per_degree: f64) -> Result<ErrorMap, FlipError> {
    resolution(pixels_per_degree)?;
    let sizes = [reference, test].map(|i| (i.width, i.height));
    if sizes[0] != sizes[1] {
        return Err(FlipError::Sizes { reference: sizes[0], test: sizes[1] });
    }
    light("reference", reference, (1.0, "a number from 0 to 1"))?;
    light("test", test, (1.0, "a number from 0 to 1"))?;
    let filters = filter::Filters::new(pixels_per_degree);
    Ok(difference::map(reference, test, &filters))
}

/// A number of pixels per degree that the filters can be made for.
fn resolution(value: f64) -> Result<(), FlipError> {
    if (1.0..=1000.0).contains(&value) { Ok(()) } else { Err(FlipError::Resolution { value }) }
}

/// As many pixels as the size says, with light up to a limit in every channel.
fn light(which: &'static str, image: &Image, (limit, limits): (f64, &'static str)) -> Result<(), FlipError> {
    let (width, height, found) = (image.width, image.height, image.pixels.len());
    if found == 0 || found != width * height {
        return Err(FlipError::Shape { which, width, height, found });
    }
    for (i, pixel) in image.pixels.iter().enumerate() {
        if let Some(&value) = pixel.iter().find(|x| !(**x >= 0.0 && **x <= limit)) {
            let (column, row) = (i % width, i / width);
            return Err(FlipError::Pixel { which, column, row, value, limits });
        }
    }
    Ok(())
}
