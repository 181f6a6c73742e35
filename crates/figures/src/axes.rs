//! The frame of a plot: border, ticks, labels.

use super::canvas::{Align, Canvas, Frame, GRID, INK, SMALL, TEXT};
use super::scale::Tick;
use super::{Scale, font};
use crate::ReportError;

/// A tick at a pixel.
pub(crate) struct Mark {
    pub(crate) at: f64,
    pub(crate) label: Option<String>,
}

/// Ticks of a vertical axis of this height in pixels.
fn rungs(y: Scale, height: f64) -> Vec<Tick> {
    y.ticks((height / 40.0).max(2.0) as usize)
}

/// Space that a vertical scale takes at the left of its frame.
pub(crate) fn left_space(y: Scale, height: f64) -> Result<f64, ReportError> {
    label_space(rungs(y, height).iter().filter_map(|t| t.label.as_deref()))
}

/// Space for tick labels and an upright axis label.
pub(crate) fn label_space<'a>(labels: impl Iterator<Item = &'a str>) -> Result<f64, ReportError> {
    Ok(widest(labels)? + 32.0)
}

/// Width of the widest label in pixels.
pub(crate) fn widest<'a>(labels: impl Iterator<Item = &'a str>) -> Result<f64, ReportError> {
    labels.map(|l| font::width(l, SMALL)).try_fold(0.0, |m: f64, w| Ok(m.max(w?)))
}

/// Grid lines, ticks and labels of both axes of a plot of physical values.
pub(crate) fn grid(
    canvas: &Canvas,
    frame: Frame,
    (x, x_label): (Scale, &str),
    (y, y_label): (Scale, &str),
) -> Result<(), ReportError> {
    let across = x.ticks((frame.width() / 70.0).max(2.0) as usize).into_iter();
    let x_marks: Vec<Mark> =
        across.map(|t| mark(t, |v| frame.left + x.position(v) * frame.width())).collect();
    let up = rungs(y, frame.height()).into_iter();
    let y_marks: Vec<Mark> = up.map(|t| mark(t, |v| frame.bottom - y.position(v) * frame.height())).collect();
    for m in x_marks.iter().filter(|m| m.label.is_some()) {
        canvas.line(&[(m.at, frame.top), (m.at, frame.bottom)], GRID, 0.8)?;
    }
    for m in y_marks.iter().filter(|m| m.label.is_some()) {
        canvas.line(&[(frame.left, m.at), (frame.right, m.at)], GRID, 0.8)?;
    }
    border(canvas, frame, (&x_marks, x_label), (&y_marks, y_label))
}

/// Border, ticks and labels at given pixels; tick labels that would touch are left out.
pub(crate) fn border(
    canvas: &Canvas,
    frame: Frame,
    (x_marks, x_label): (&[Mark], &str),
    (y_marks, y_label): (&[Mark], &str),
) -> Result<(), ReportError> {
    canvas.outline(frame, INK, 1.0)?;
    foot(canvas, frame, x_marks)?;
    let widest = side(canvas, frame, y_marks)?;
    let middle = (frame.left + frame.width() / 2.0, frame.top + frame.height() / 2.0);
    // A label may overhang its side a little, into the corners.
    let below = fitting(x_label, frame.width() + 40.0)?;
    canvas.text(&below, (middle.0, frame.bottom + 32.0), TEXT, Align::Centre, INK)?;
    let beside = fitting(y_label, frame.height() + 20.0)?;
    canvas.upright(&beside, (frame.left - widest - 20.0, middle.1), TEXT)
}

/// Ticks and labels below the frame.
fn foot(canvas: &Canvas, frame: Frame, marks: &[Mark]) -> Result<(), ReportError> {
    let mut end = f64::NEG_INFINITY;
    for m in marks {
        let length = if m.label.is_some() { 5.0 } else { 3.0 };
        canvas.line(&[(m.at, frame.bottom), (m.at, frame.bottom + length)], INK, 1.0)?;
        let Some(label) = &m.label else { continue };
        let half = font::width(label, SMALL)? / 2.0;
        if m.at - half > end + 5.0 {
            canvas.text(label, (m.at, frame.bottom + 14.0), SMALL, Align::Centre, INK)?;
            end = m.at + half;
        }
    }
    Ok(())
}

/// Ticks and labels left of the frame; width of the widest label.
fn side(canvas: &Canvas, frame: Frame, marks: &[Mark]) -> Result<f64, ReportError> {
    let (mut last, mut widest) = (f64::INFINITY, 0.0_f64);
    for m in marks {
        let length = if m.label.is_some() { 5.0 } else { 3.0 };
        canvas.line(&[(frame.left - length, m.at), (frame.left, m.at)], INK, 1.0)?;
        let Some(label) = &m.label else { continue };
        if (m.at - last).abs() > 13.0 {
            canvas.text(label, (frame.left - 8.0, m.at), SMALL, Align::Right, INK)?;
            widest = widest.max(font::width(label, SMALL)?);
            last = m.at;
        }
    }
    Ok(widest)
}

/// An axis label that fits: without its explanation in brackets, or shortened, if need be.
fn fitting(label: &str, limit: f64) -> Result<String, ReportError> {
    if font::width(label, TEXT)? <= limit {
        return Ok(label.into());
    }
    font::shorten(label.split(" (").next().unwrap_or(label), TEXT, limit)
}

fn mark(tick: Tick, at: impl Fn(f64) -> f64) -> Mark {
    Mark { at: at(tick.value), label: tick.label }
}
