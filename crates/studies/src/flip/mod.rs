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

/// Pictures that cannot be compared: what is wrong with them.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("FLIP: {0}")]
pub struct FlipError(pub String);

/// LDR-FLIP of two pictures in linear light, every channel in [0, 1] (decode an sRGB picture
/// first).
///
/// # Errors
/// Pictures of different sizes, a channel outside [0, 1], a resolution that is none.
pub fn ldr(reference: &Image, test: &Image, pixels_per_degree: f64) -> Result<ErrorMap, FlipError> {
    resolution(pixels_per_degree)?;
    of_one_size((reference.width, reference.height), test)?;
    light("reference", reference, (1.0, "a number from 0 to 1"))?;
    light("test", test, (1.0, "a number from 0 to 1"))?;
    let filters = filter::Filters::new(pixels_per_degree);
    Ok(difference::map(reference, test, &filters))
}

/// A number of pixels per degree that the filters can be made for.
fn resolution(value: f64) -> Result<(), FlipError> {
    if (1.0..=1000.0).contains(&value) {
        return Ok(());
    }
    let wanted = "a finite number of at least 1 and at most 1000 is called for";
    Err(FlipError(format!("{value} pixels per degree; {wanted}")))
}

/// A picture of the size of the reference.
fn of_one_size(reference: (usize, usize), test: &Image) -> Result<(), FlipError> {
    let size = (test.width, test.height);
    if reference == size {
        return Ok(());
    }
    Err(FlipError(format!(
        "the reference is {reference:?} pixels, the test {size:?}; give pictures of one size"
    )))
}

/// As many pixels as the size says, with light up to a limit in every channel.
fn light(which: &'static str, image: &Image, (limit, limits): (f64, &'static str)) -> Result<(), FlipError> {
    let (width, height, found) = (image.width, image.height, image.pixels.len());
    if found == 0 || found != width * height {
        return Err(FlipError(format!(
            "the {which} picture has {found} pixels, {width} x {height} are called for"
        )));
    }
    for (i, pixel) in image.pixels.iter().enumerate() {
        if let Some(&value) = pixel.iter().find(|x| !(**x >= 0.0 && **x <= limit)) {
            let (column, row) = (i % width, i / width);
            return Err(FlipError(format!(
                "the {which} picture at column {column}, row {row} is {value}; {limits} is called for"
            )));
        }
    }
    Ok(())
}
