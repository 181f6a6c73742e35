//! A legend above a plot: entries flow into rows, so that it never covers data.

use plotters::style::RGBColor;

use super::canvas::{Align, Canvas, INK, SMALL};
use super::font;
use crate::ReportError;

/// Height of a row in pixels.
const ROW: f64 = 17.0;

/// Widest row in pixels: beside the space for tick labels it is seen whole on a narrow screen, where a wide
/// plot scrolls.
const WIDEST: f64 = 300.0;

/// How an entry is drawn in the plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Key {
    /// A line of this width.
    Line(f64),
    /// A line of this width with a disc.
    Marked(f64),
    /// A disc.
    Disc,
    /// A ring.
    Ring,
    /// A square.
    Square,
}

/// Name, colour and key of an entry.
pub(crate) type Entry = (String, RGBColor, Key);

/// Entries at their places within a width.
pub(crate) struct Legend {
    placed: Vec<(f64, f64, Entry)>,
    rows: usize,
}

impl Legend {
    /// Flows entries into rows of at most `width` pixels; a longer name is shortened.
    pub(crate) fn flow(entries: Vec<Entry>, width: f64) -> Result<Legend, ReportError> {
        let (mut x, mut rows) = (0.0, usize::from(!entries.is_empty()));
        let mut placed = Vec::with_capacity(entries.len());
        for (name, colour, key) in entries {
            let name = font::shorten(&name, SMALL, width - 28.0)?;
            let entry = 24.0 + font::width(&name, SMALL)? + 16.0;
            if x > 0.0 && x + entry - 16.0 > width.min(WIDEST) {
                (x, rows) = (0.0, rows + 1);
            }
            placed.push((x, (rows - 1) as f64 * ROW, (name, colour, key)));
            x += entry;
        }
        Ok(Legend { placed, rows })
    }

    /// Height in pixels.
    pub(crate) fn height(&self) -> f64 {
        self.rows as f64 * ROW
    }

    /// Draws the entries with their upper left corner at `at`.
    pub(crate) fn draw(&self, canvas: &Canvas, at: (f64, f64)) -> Result<(), ReportError> {
        for (dx, dy, (name, colour, key)) in &self.placed {
            let (x, y) = (at.0 + dx, at.1 + dy + ROW / 2.0);
            let rule = |width| canvas.line(&[(x, y), (x + 18.0, y)], *colour, width);
            match key {
                Key::Line(width) => rule(*width)?,
                Key::Marked(width) => {
                    rule(*width)?;
                    canvas.circle((x + 9.0, y), 3.0, *colour, None)?;
                }
                Key::Disc => canvas.circle((x + 9.0, y), 4.0, *colour, None)?,
                Key::Ring => canvas.circle((x + 9.0, y), 3.4, *colour, Some(1.2))?,
                Key::Square => canvas.square((x + 9.0, y), 4.0, *colour)?,
            }
            canvas.text(name, (x + 24.0, y), SMALL, Align::Left, INK)?;
        }
        Ok(())
    }
}
