//! What the page's script needs to say the values under the pointer: scales and names, as data
//! beside the drawing. Values of pictures are read back from their pixels, by the colour bar.

use serde::Serialize;

use super::canvas::{Frame, escape, unit};
use super::scale::{Scale, Spread};
use super::{Shade, words_of};
use crate::ReportError;
use lobefit_math::numbers::rounded;

/// Digits of a place: more than a pixel tells.
const DIGITS: usize = 5;

/// Name, spread and ends of an axis.
pub(crate) type Axis = (String, &'static str, f64, f64);

/// What a drawing says under the pointer.
#[derive(Serialize)]
#[serde(rename_all = "lowercase", tag = "kind")]
pub(crate) enum Hover {
    /// Lines over two axes, their names in the order of drawing.
    Lines { frame: [f64; 4], x: Axis, y: Axis, lines: Vec<String> },
    /// A cell for each pair of values.
    Map { frame: [f64; 4], x: (String, Vec<f64>), y: (String, Vec<f64>), down: bool, shade: Colours },
    /// Pictures in rows and columns.
    Cells(Cells),
}

/// Pictures in rows and columns.
#[derive(Serialize)]
pub(crate) struct Cells {
    pub frame: [f64; 4],
    pub rows: Vec<String>,
    pub columns: Vec<String>,
    /// What the columns are.
    pub name: String,
    /// What the values are.
    pub unit: String,
    /// Radius of a sphere over the side of its cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// `v` for a picture of values, of each row and column; all of them where there is nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinds: Option<Vec<String>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shade: Option<Colours>,
}

/// How a place on the colour bar becomes a value.
#[derive(Serialize)]
pub(crate) struct Colours {
    /// Whether the bar's middle is 0 and the scale that of magnitudes.
    signed: bool,
    scale: (&'static str, f64, f64),
}

impl From<Shade> for Colours {
    fn from(shade: Shade) -> Colours {
        let linear = Spread::Linear;
        let (signed, spread, min, max) = match shade {
            Shade::Magnitude { min, max, spread } => (false, spread, min, max),
            Shade::Signed { limit, spread } => (true, spread, 0.0, limit),
            Shade::Departure { limit } => (true, linear, 0.0, limit),
            Shade::Radiance { white } => (false, linear, 0.0, white),
        };
        Colours { signed, scale: (words_of(spread), min, max) }
    }
}

/// An axis with its scale.
pub(crate) fn axis(name: &str, scale: Scale) -> Axis {
    (short(name), words_of(scale.spread), scale.min, scale.max)
}

/// A name without what explains it in brackets.
pub(crate) fn short(name: &str) -> String {
    name.split(" (").next().unwrap_or(name).into()
}

/// Values in the digits of a place.
pub(crate) fn places(values: &[f64]) -> Vec<f64> {
    values.iter().map(|&x| rounded(x, DIGITS)).collect()
}

/// A frame in pixels: left, top, right, bottom.
pub(crate) fn corners(frame: Frame) -> [f64; 4] {
    [frame.left, frame.top, frame.right, frame.bottom].map(|x| (x * 10.0).round() / 10.0)
}

/// The drawing with what it says.
///
/// # Errors
/// None that a figure's own checks let through.
pub(crate) fn with(svg: &str, hover: &Hover) -> Result<String, ReportError> {
    let refused =
        |e: serde_json::Error| ReportError::Drawing { section: "hover".into(), reason: e.to_string() };
    let data = escape(&serde_json::to_string(hover).map_err(refused)?);
    Ok(svg.replacen("<svg ", &format!("<svg data-hover=\"{data}\" "), 1))
}

/// The drawing with places that say a text each.
pub(crate) fn spots(svg: &str, spots: &[((f64, f64), String)]) -> String {
    let spot = |((x, y), text): &((f64, f64), String)| {
        let (x, y, text) = (unit(*x), unit(*y), escape(text));
        format!("<circle class=\"spot\" cx=\"{x}\" cy=\"{y}\" r=\"70\"><title>{text}</title></circle>")
    };
    let all: String = spots.iter().map(spot).collect();
    format!("{}{all}</svg>", svg.trim_end_matches("</svg>"))
}
