//! A field in colour: a PNG of one pixel per cell inside drawn axes, with a colour bar and the
//! worst place marked.

use super::canvas::{Align, Canvas, Frame, INK, LABEL_INK, PAPER, TEXT, picture, sheet};
use super::hover::{self, Hover};
use super::{Figure, Scale, Shade, Spread, axes, colour_bar, font, raster};
use crate::Ruler;
use lobefit_math::numbers;

use crate::{Field, ReportError, check};

/// Labelled ticks along each axis, about.
const TICKS: usize = 6;

/// A place to mark, with the text to put beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// Physical x, clamped to the grid.
    pub x: f64,
    /// Physical y, clamped to the grid.
    pub y: f64,
    /// Text: the value there.
    pub text: String,
}

/// A field as a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap<'a> {
    /// Line above the picture; shortened to fit.
    pub title: String,
    /// What is shown.
    pub field: &'a Field,
    /// What the colours mean.
    pub shade: Shade,
    /// First row at the top, as a texture is stored; otherwise y increases upwards.
    pub top_down: bool,
    /// A place to mark.
    pub worst: Option<Worst>,
    /// Further places to mark, without text.
    pub marks: Vec<(f64, f64)>,
    /// Size of the plotted area in pixels.
    pub size: (f64, f64),
}

impl<'a> HeatMap<'a> {
    /// The field with its own scale and its worst place marked: signed by square root, magnitudes
    /// linear.
    pub fn of(title: &str, field: &'a Field) -> HeatMap<'a> {
        let worst = field.worst().filter(|_| field.signed).map(|(x, y, value)| Worst {
            x,
            y,
            text: numbers::brief_bound(value, 2),
        });
        let shade = if field.signed { signed(field.peak()) } else { magnitude(field) };
        HeatMap {
            title: title.into(),
            field,
            shade,
            top_down: false,
            worst,
            marks: Vec::new(),
            size: (220.0, 190.0),
        }
    }

    fn cells(&self) -> Vec<u8> {
        let columns = self.field.x.values.len();
        let rows = self.field.y.values.len();
        let row = |k: usize| if self.top_down { k } else { rows - 1 - k };
        (0..rows)
            .flat_map(|k| &self.field.values[row(k) * columns..][..columns])
            .map(|&v| self.shade.level(f64::from(v)))
            .collect()
    }

    fn frame(&self) -> Result<Frame, ReportError> {
        let y = &self.field.y;
        let labels = ruler_scale(y).ticks(TICKS);
        let left = axes::label_space(labels.iter().filter_map(|t| t.label.as_deref()))?;
        Ok(Frame { left, top: 30.0, right: left + self.size.0, bottom: 30.0 + self.size.1 })
    }

    /// Pixel of a physical place: centres of the first and last cells lie half a cell inside the
    /// frame.
    fn pixel(&self, frame: Frame, x: f64, y: f64) -> (f64, f64) {
        let across = (self.field.x.position(x) + 0.5) / self.field.x.values.len() as f64;
        let up = (self.field.y.position(y) + 0.5) / self.field.y.values.len() as f64;
        let down = if self.top_down { up } else { 1.0 - up };
        (frame.left + across * frame.width(), frame.top + down * frame.height())
    }

    fn draw(&self, canvas: &Canvas, frame: Frame) -> Result<(), ReportError> {
        let (x, y) = (&self.field.x, &self.field.y);
        let x_marks = marks(x, |v| self.pixel(frame, v, y.values[0]).0);
        let y_marks = marks(y, |v| self.pixel(frame, x.values[0], v).1);
        axes::border(canvas, frame, (&x_marks, &x.name), (&y_marks, &y.name))?;
        colour_bar::draw(canvas, frame, self.shade, &self.field.unit)?;
        // The unit stands above the bar, so the title must end before it.
        let title = font::shorten(&self.title, TEXT, frame.width() + 10.0)?;
        canvas.text(&title, (frame.left, 14.0), TEXT, Align::Left, INK)?;
        for &(x, y) in &self.marks {
            let at = self.pixel(frame, x, y);
            canvas.circle(at, 3.0, PAPER, Some(2.4))?;
            canvas.circle(at, 3.0, LABEL_INK, Some(1.0))?;
        }
        let Some(worst) = &self.worst else { return Ok(()) };
        let at = self.pixel(frame, worst.x, worst.y);
        canvas.circle(at, 5.0, PAPER, Some(3.0))?;
        canvas.circle(at, 5.0, LABEL_INK, Some(1.4))?;
        canvas.note(&worst.text, at, frame)
    }
}

impl Figure for HeatMap<'_> {
    fn svg(&self) -> Result<String, ReportError> {
        self.field.check(&self.title)?;
        if let Some(worst) = &self.worst {
            check::finite(&self.title, "worst.x", worst.x)?;
            check::finite(&self.title, "worst.y", worst.y)?;
        }
        for (x, y) in &self.marks {
            check::finite(&self.title, "marks: x", *x)?;
            check::finite(&self.title, "marks: y", *y)?;
        }
        let frame = self.frame()?;
        let size = (self.field.x.values.len(), self.field.y.values.len());
        let png = raster::png(&self.title, size, &self.cells(), self.shade)?;
        let under = picture(&png, frame, true) + &colour_bar::under(&self.title, frame, self.shade)?;
        let width = frame.right + colour_bar::space(frame, self.shade, &self.field.unit)?;
        let svg = sheet(&self.title, (width, frame.bottom + 44.0), &under, |c| self.draw(c, frame))?;
        let ruler = |r: &Ruler| (hover::short(&r.name), hover::places(&r.values));
        hover::with(
            &svg,
            &Hover::Map {
                frame: hover::corners(frame),
                x: ruler(&self.field.x),
                y: ruler(&self.field.y),
                down: self.top_down,
                shade: self.shade.into(),
            },
        )
    }
}

/// Symmetric limits that hold `peak`, small errors spread apart; a field of zeros gets limits of
/// 1e-12.
pub fn signed(peak: f64) -> Shade {
    Shade::Signed { limit: numbers::round_up(peak.max(1e-12), 2), spread: Spread::Root }
}

fn magnitude(field: &Field) -> Shade {
    let values = field.values.iter().map(|&v| f64::from(v));
    let scale = Scale::around(Spread::Linear, values.clone());
    // A texel a little below 0 is one that interpolates better so: no reason for a scale below 0.
    let lowest = values.fold(f64::INFINITY, f64::min);
    let min = if lowest > -0.01 * scale.max { scale.min.max(0.0) } else { scale.min };
    Shade::Magnitude { min, max: scale.max, spread: Spread::Linear }
}

/// Round physical values along a ruler; an uneven ruler is walked by decades.
fn ruler_scale(ruler: &Ruler) -> Scale {
    let (min, max) = (ruler.values[0], ruler.values[ruler.values.len() - 1]);
    let spread = if min > 0.0 && !even(&ruler.values) { Spread::Log } else { Spread::Linear };
    Scale { spread, min, max }
}

fn marks(ruler: &Ruler, pixel: impl Fn(f64) -> f64) -> Vec<axes::Mark> {
    let mut ticks = ruler_scale(ruler).ticks(TICKS);
    // Between texel numbers there is nothing to point at.
    let whole = |v: f64| v.fract() == 0.0;
    if ruler.values.len() > 2 && ruler.values.iter().all(|&v| whole(v)) {
        ticks.retain(|t| whole(t.value));
    }
    ticks.into_iter().map(|t| axes::Mark { at: pixel(t.value), label: t.label }).collect()
}

/// Whether the steps of a list agree within a thousandth.
fn even(values: &[f64]) -> bool {
    let steps = || values.windows(2).map(|w| w[1] - w[0]);
    let widest = steps().fold(0.0, f64::max);
    steps().all(|s| s > 0.999 * widest)
}
