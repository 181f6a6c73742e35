//! The colour bar beside a picture.

use super::axes::widest;
use super::canvas::{Align, Canvas, Frame, INK, SMALL, picture};
use super::colour::{LEVELS, Shade};
use super::{font, raster};
use crate::ReportError;

/// Width of the bar and its distance from the picture in pixels.
const BAR: f64 = 14.0;

/// Space that the bar with its labels takes at the right of `frame`.
pub(crate) fn space(frame: Frame, shade: Shade, unit: &str) -> Result<f64, ReportError> {
    let labels = labels(frame, shade);
    let text = widest(labels.iter().map(|(_, label)| label.as_str()))? + 7.0;
    Ok(2.0 * BAR + text.max(font::width(unit, SMALL)? - BAR) + 4.0)
}

/// The bar's colours, as markup to lie under the drawing.
pub(crate) fn under(figure: &str, frame: Frame, shade: Shade) -> Result<String, ReportError> {
    let descending: Vec<u8> = (0..LEVELS as u8).rev().collect();
    let png = raster::png(figure, (1, LEVELS), &descending, shade)?;
    Ok(picture(&png, place(frame), false))
}

/// Outline, ticks, labels and, above the bar, the unit.
pub(crate) fn draw(canvas: &Canvas, frame: Frame, shade: Shade, unit: &str) -> Result<(), ReportError> {
    let bar = place(frame);
    canvas.outline(bar, INK, 1.0)?;
    for (at, label) in labels(frame, shade) {
        canvas.line(&[(bar.right, at), (bar.right + 4.0, at)], INK, 1.0)?;
        canvas.text(&label, (bar.right + 7.0, at), SMALL, Align::Left, INK)?;
    }
    canvas.text(unit, (bar.left, frame.top - 13.0), SMALL, Align::Left, INK)
}

/// Labels with their height on the page; the less wanted of two that would touch is left out.
fn labels(frame: Frame, shade: Shade) -> Vec<(f64, String)> {
    let mut taken: Vec<(f64, String)> = Vec::new();
    for tick in shade.ticks() {
        let Some(label) = tick.label else { continue };
        let at = frame.bottom - shade.position(tick.value) * frame.height();
        if taken.iter().all(|(t, _)| (t - at).abs() >= 14.0) {
            taken.push((at, label));
        }
    }
    taken
}

fn place(frame: Frame) -> Frame {
    Frame { left: frame.right + BAR, right: frame.right + 2.0 * BAR, ..frame }
}
