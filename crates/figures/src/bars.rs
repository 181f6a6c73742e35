//! Named magnitudes as horizontal bars from zero.

use super::canvas::{Align, Canvas, Frame, GREY, INK, SMALL, TEXT, sheet};
use super::{Figure, LINES, Scale, Spread, font};
use lobefit_math::numbers;

use crate::{ReportError, check};

/// Height of a bar with its gap in pixels.
const ROW: f64 = 20.0;

/// One bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Name at its left.
    pub name: String,
    /// Length; not negative.
    pub value: f64,
    /// Somebody else's: grey.
    pub published: bool,
}

/// A list of bars, in the order given, each with its value at its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// Line above the chart.
    pub title: String,
    /// Unit of the values.
    pub unit: String,
    /// The bars.
    pub bars: Vec<Bar>,
}

impl Figure for Bars {
    fn svg(&self) -> Result<String, ReportError> {
        check::filled(&self.title, "bars", self.bars.len())?;
        let mut names: f64 = 0.0;
        for bar in &self.bars {
            check::finite(&self.title, &format!("bar {}", bar.name), bar.value)?;
            if bar.value < 0.0 {
                return Err(check::domain(&self.title, &format!("bar {}", bar.name), "must not be negative"));
            }
            names = names.max(font::width(&bar.name, SMALL)?);
        }
        let left = names.min(230.0) + 14.0;
        let frame =
            Frame { left, top: 30.0, right: left + 380.0, bottom: 30.0 + ROW * self.bars.len() as f64 };
        let longest = self.bars.iter().map(|b| b.value).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let scale = Scale { spread: Spread::Linear, min: 0.0, max: longest };
        sheet(&self.title, (frame.right + 90.0, frame.bottom + 10.0), "", |canvas| {
            let title = font::shorten(&self.title, TEXT, frame.right)?;
            canvas.text(&title, (4.0, 12.0), TEXT, Align::Left, INK)?;
            self.draw(canvas, frame, scale)
        })
    }
}

impl Bars {
    fn draw(&self, canvas: &Canvas, frame: Frame, scale: Scale) -> Result<(), ReportError> {
        for (i, bar) in self.bars.iter().enumerate() {
            let middle = frame.top + (i as f64 + 0.5) * ROW;
            let end = frame.left + scale.position(bar.value) * frame.width();
            let colour = if bar.published { GREY } else { LINES[1] };
            canvas.fill(
                Frame { top: middle - 7.0, bottom: middle + 7.0, right: end, ..frame },
                colour,
                1.0,
            )?;
            let name = font::shorten(&bar.name, SMALL, 230.0)?;
            canvas.text(&name, (frame.left - 6.0, middle), SMALL, Align::Right, INK)?;
            let value = format!("{} {}", numbers::brief(bar.value, 3), self.unit);
            canvas.text(&value, (end + 6.0, middle), SMALL, Align::Left, INK)?;
        }
        canvas.line(&[(frame.left, frame.top), (frame.left, frame.bottom)], INK, 1.0)
    }
}
