//! The frame of a plot: border, ticks, labels; and the colour bar.

use super::canvas::{Align, Canvas, Frame, GRID, INK, SMALL, TEXT, picture};
use super::colour::{LEVELS, Shade};
use super::scale::Tick;
use super::{Scale, font, raster};
use crate::report::ReportError;

/// Width of a colour bar in pixels.
const BAR: f64 = 14.0;

/// Space that a colour bar with its labels takes beside a plot.
pub(crate) const BAR_SPACE: f64 = 78.0;

/// A tick at a pixel.
pub(crate) struct Mark {
    pub(crate) at: f64,
    pub(crate) label: Option<String>,
}

/// Grid lines, ticks and labels of both axes of a plot of physical values.
pub(crate) fn grid(
    canvas: &Canvas,
    frame: Frame,
    (x, x_label): (Scale, &str),
    (y, y_label): (Scale, &str),
) -> Result<(), ReportError> {
    let across = (frame.width() / 70.0).max(2.0) as usize;
    let up = (frame.height() / 40.0).max(2.0) as usize;
    let x_marks: Vec<Mark> = x
        .ticks(across)
        .into_iter()
        .map(|t| mark(t, |v| frame.left + x.position(v) * frame.width()))
        .collect();
    let y_marks: Vec<Mark> =
        y.ticks(up).into_iter().map(|t| mark(t, |v| frame.bottom - y.position(v) * frame.height())).collect();
    for m in x_marks.iter().filter(|m| m.label.is_some()) {
        canvas.line(&[(m.at, frame.top), (m.at, frame.bottom)], GRID, 0.8)?;
    }
    for m in y_marks.iter().filter(|m| m.label.is_some()) {
        canvas.line(&[(frame.left, m.at), (frame.right, m.at)], GRID, 0.8)?;
    }
    border(canvas, frame, (&x_marks, x_label), (&y_marks, y_label))
}

/// Border, ticks and labels at given pixels; labels that would touch are left out.
pub(crate) fn border(
    canvas: &Canvas,
    frame: Frame,
    (x_marks, x_label): (&[Mark], &str),
    (y_marks, y_label): (&[Mark], &str),
) -> Result<(), ReportError> {
    canvas.outline(frame, INK, 1.0)?;
    let mut end = f64::NEG_INFINITY;
    for m in x_marks {
        let length = if m.label.is_some() { 5.0 } else { 3.0 };
        canvas.line(&[(m.at, frame.bottom), (m.at, frame.bottom + length)], INK, 1.0)?;
        let Some(label) = &m.label else { continue };
        let half = font::width(label, SMALL)? / 2.0;
        if m.at - half > end + 5.0 {
            canvas.text(label, (m.at, frame.bottom + 14.0), SMALL, Align::Centre, INK)?;
            end = m.at + half;
        }
    }
    let mut top = f64::INFINITY;
    let mut widest: f64 = 0.0;
    for m in y_marks {
        let length = if m.label.is_some() { 5.0 } else { 3.0 };
        canvas.line(&[(frame.left - length, m.at), (frame.left, m.at)], INK, 1.0)?;
        let Some(label) = &m.label else { continue };
        if (m.at - top).abs() > 13.0 || !top.is_finite() {
            canvas.text(label, (frame.left - 8.0, m.at), SMALL, Align::Right, INK)?;
            widest = widest.max(font::width(label, SMALL)?);
            top = m.at;
        }
    }
    canvas.text(
        x_label,
        (frame.left + frame.width() / 2.0, frame.bottom + 32.0),
        TEXT,
        Align::Centre,
        INK,
    )?;
    canvas.upright(y_label, (frame.left - widest - 20.0, frame.top + frame.height() / 2.0), TEXT)
}

/// The picture under a vertical colour bar at the right of `frame`.
pub(crate) fn bar_picture(figure: &str, frame: Frame, shade: Shade) -> Result<String, ReportError> {
    let descending: Vec<u8> = (0..LEVELS as u8).rev().collect();
    let png = raster::png(figure, (1, LEVELS), &descending, shade)?;
    Ok(picture(&png, bar_frame(frame), false))
}

/// Ticks, labels and unit of the colour bar at the right of `frame`.
pub(crate) fn bar(canvas: &Canvas, frame: Frame, shade: Shade, unit: &str) -> Result<(), ReportError> {
    let bar = bar_frame(frame);
    canvas.outline(bar, INK, 1.0)?;
    let mut taken: Vec<f64> = Vec::new();
    for tick in shade.ticks() {
        let Some(label) = &tick.label else { continue };
        let at = bar.bottom - shade.position(tick.value) * bar.height();
        if taken.iter().any(|t| (t - at).abs() < 14.0) {
            continue;
        }
        taken.push(at);
        canvas.line(&[(bar.right, at), (bar.right + 4.0, at)], INK, 1.0)?;
        canvas.text(label, (bar.right + 7.0, at), SMALL, Align::Left, INK)?;
    }
    canvas.text(unit, (bar.right + 50.0, frame.top - 12.0), SMALL, Align::Right, INK)
}

fn bar_frame(frame: Frame) -> Frame {
    Frame { left: frame.right + 12.0, right: frame.right + 12.0 + BAR, ..frame }
}

fn mark(tick: Tick, at: impl Fn(f64) -> f64) -> Mark {
    Mark { at: at(tick.value), label: tick.label }
}
