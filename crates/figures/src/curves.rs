//! Lines over linear or logarithmic axes: fits beside their truth, error against work.

use plotters::style::RGBColor;

use super::canvas::{Align, Canvas, Frame, GREY, INK, SMALL, TEXT, sheet};
use super::hover::{self, Hover};
use super::legend::{Key, Legend};
use super::{Figure, LINES, Scale, Spread, axes, font, labels};
use crate::{ReportError, check};
use lobefit_math::ops;

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// A heavy black line: the truth.
    Truth,
    /// A line in one of the colours, counted from 0 and repeating.
    Line(usize),
    /// A line with a mark at every point.
    Marked(usize),
    /// Black marks without a line: what was measured.
    Measured,
    /// Error bars: points in pairs, the lower and the upper end of each bar.
    Bars,
}

/// A named line.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; empty for none. Equal names share an entry.
    pub name: String,
    /// Points in the order of drawing.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub style: Style,
    /// Text beside its last point.
    pub end: Option<String>,
}

/// A single marked point with text.
#[derive(Clone, Debug, PartialEq)]
pub struct Annotation {
    /// Place.
    pub x: f64,
    /// Place.
    pub y: f64,
    /// What is to be said.
    pub text: String,
}

/// A chart of lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// Line above the chart; shortened to fit.
    pub title: String,
    /// Label and spread of the horizontal axis.
    pub x: (String, Spread),
    /// Label and spread of the vertical axis. On a logarithmic axis values that are not positive
    /// sit on its foot.
    pub y: (String, Spread),
    /// The lines, drawn in order.
    pub series: Vec<Series>,
    /// Marked points.
    pub annotations: Vec<Annotation>,
    /// Guides of constant slope through the top left corner of a log-log chart: slope and text.
    pub guides: Vec<(f64, String)>,
    /// Limits of the vertical axis, where charts share them.
    pub y_limits: Option<(f64, f64)>,
    /// Size of the plotted area in pixels.
    pub size: (f64, f64),
}

impl Series {
    /// A line without text at its end.
    pub fn line(name: impl Into<String>, points: Vec<(f64, f64)>, style: Style) -> Series {
        Series { name: name.into(), points, style, end: None }
    }

    fn colour(&self) -> RGBColor {
        match self.style {
            Style::Truth | Style::Measured | Style::Bars => INK,
            Style::Line(i) | Style::Marked(i) => LINES[i % LINES.len()],
        }
    }

    fn key(&self) -> Key {
        match self.style {
            Style::Truth => Key::Line(3.0),
            Style::Line(i) => Key::Line(width(i)),
            Style::Marked(i) => Key::Marked(width(i)),
            Style::Measured | Style::Bars => Key::Disc,
        }
    }
}

/// A chart of lines beside others of the same lines, of which one has the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The chart.
    pub chart: Curves,
    /// Whether it has the legend.
    pub legend: bool,
}

impl Figure for Panel {
    fn svg(&self) -> Result<String, ReportError> {
        self.chart.drawn(if self.legend { self.chart.legend()? } else { Legend::flow(Vec::new(), 0.0)? })
    }
}

impl Curves {
    /// A chart of lines over axes with these labels and spreads, and of nothing else.
    pub fn new(
        title: impl Into<String>,
        [x, y]: [(&str, Spread); 2],
        series: Vec<Series>,
        size: (f64, f64),
    ) -> Curves {
        let [x, y] = [x, y].map(|(label, spread)| (label.into(), spread));
        let (annotations, guides) = (Vec::new(), Vec::new());
        Curves { title: title.into(), x, y, series, annotations, guides, y_limits: None, size }
    }

    /// A chart over linear axes with these labels.
    pub fn linear(
        title: impl Into<String>,
        labels: [&str; 2],
        series: Vec<Series>,
        size: (f64, f64),
    ) -> Curves {
        Curves::new(title, labels.map(|label| (label, Spread::Linear)), series, size)
    }
}

impl Figure for Curves {
    fn svg(&self) -> Result<String, ReportError> {
        self.drawn(self.legend()?)
    }
}

impl Curves {
    fn drawn(&self, legend: Legend) -> Result<String, ReportError> {
        self.check()?;
        let top = 28.0 + legend.height();
        let (x, y) = (self.scale_x(), self.scale_y());
        let left = axes::left_space(y, self.size.1)?;
        let frame = Frame { left, top, right: left + self.size.0, bottom: top + self.size.1 };
        let ends = axes::widest(self.series.iter().filter_map(|s| s.end.as_deref()))?;
        let plan = Plan { frame, x, y };
        let svg = sheet(&self.title, (frame.right + ends + 18.0, frame.bottom + 44.0), "", |c| {
            self.draw(c, &plan, &legend)
        })?;
        hover::with(
            &svg,
            &Hover::Lines {
                frame: hover::corners(frame),
                x: hover::axis(&self.x.0, x),
                y: hover::axis(&self.y.0, y),
                lines: self.lines(),
            },
        )
    }
}

/// Where values go.
struct Plan {
    frame: Frame,
    x: Scale,
    y: Scale,
}

impl Plan {
    fn pixel(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let f = self.frame;
        (f.left + self.x.position(x) * f.width(), f.bottom - self.y.position(y) * f.height())
    }
}

impl Curves {
    fn check(&self) -> Result<(), ReportError> {
        check::filled(&self.title, "series", self.series.len())?;
        for s in &self.series {
            check::filled(&self.title, &format!("series {}", s.name), s.points.len())?;
            for (i, &(x, y)) in s.points.iter().enumerate() {
                self.check_point(&format!("series {}[{i}]", s.name), x, y)?;
            }
        }
        self.annotations
            .iter()
            .try_for_each(|a| self.check_point(&format!("annotation {}", a.text), a.x, a.y))
    }

    fn check_point(&self, field: &str, x: f64, y: f64) -> Result<(), ReportError> {
        check::finite(&self.title, &format!("{field}.x"), x)?;
        check::finite(&self.title, &format!("{field}.y"), y)?;
        if self.x.1 == Spread::Log && x <= 0.0 {
            return Err(check::domain(
                &self.title,
                &format!("{field}.x"),
                "must be positive on a logarithmic axis",
            ));
        }
        Ok(())
    }

    /// The names of what is drawn as a line, in order: of a line without a name that of the first
    /// of its style, and what stands at its end.
    fn lines(&self) -> Vec<String> {
        let drawn = self.series.iter().filter(|s| !matches!(s.style, Style::Measured | Style::Bars));
        let named = |s: &Series| {
            let alike = self.series.iter().find(|other| other.style == s.style && !other.name.is_empty());
            let name = if s.name.is_empty() { alike.map_or("", |other| &other.name) } else { &s.name };
            [name, s.end.as_deref().unwrap_or_default()].join(" ").trim().to_string()
        };
        drawn.map(named).collect()
    }

    fn legend(&self) -> Result<Legend, ReportError> {
        let mut entries: Vec<super::legend::Entry> = Vec::new();
        for s in self.series.iter().filter(|s| !s.name.is_empty()) {
            if !entries.iter().any(|e| e.0 == s.name) {
                entries.push((s.name.clone(), s.colour(), s.key()));
            }
        }
        Legend::flow(entries, self.size.0)
    }

    fn scale_x(&self) -> Scale {
        let points = self.series.iter().flat_map(|s| &s.points).map(|p| p.0);
        let values = points.chain(self.annotations.iter().map(|a| a.x));
        match self.x.1 {
            Spread::Linear => {
                let (min, max) =
                    (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
                Scale { spread: Spread::Linear, min, max: if max > min { max } else { min + 1.0 } }
            }
            spread => Scale::around(spread, values),
        }
    }

    fn scale_y(&self) -> Scale {
        if let Some((min, max)) = self.y_limits {
            return Scale { spread: self.y.1, min, max };
        }
        let points = self.series.iter().flat_map(|s| &s.points).map(|p| p.1);
        let values = points.chain(self.annotations.iter().map(|a| a.y));
        if self.y.1 != Spread::Log {
            return Scale::around(self.y.1, values);
        }
        let mut positive = values.filter(|&v| v > 0.0).peekable();
        if positive.peek().is_none() {
            // Nothing but exact zeros: one decade to sit at the foot of.
            return Scale { spread: Spread::Log, min: 1e-17, max: 1e-16 };
        }
        Scale::around(Spread::Log, positive.collect::<Vec<_>>().into_iter())
    }

    fn draw(&self, canvas: &Canvas, plan: &Plan, legend: &Legend) -> Result<(), ReportError> {
        let frame = plan.frame;
        let title = font::shorten(&self.title, TEXT, frame.width() + 20.0)?;
        canvas.text(&title, (frame.left, 12.0), TEXT, Align::Left, INK)?;
        legend.draw(canvas, (frame.left, 22.0))?;
        axes::grid(canvas, frame, (plan.x, &self.x.0), (plan.y, &self.y.0))?;
        let guides = self.guides.iter().map(|g| guide(plan, g.0)).collect::<Vec<_>>();
        for (from, to) in &guides {
            canvas.line(&[*from, *to], GREY, 0.8)?;
        }
        for s in &self.series {
            draw_series(canvas, plan, s)?;
        }
        self.draw_ends(canvas, plan)?;
        self.draw_notes(canvas, plan, &guides)
    }

    /// Rings, and the texts of rings and guides, kept off the lines.
    fn draw_notes(&self, canvas: &Canvas, plan: &Plan, guides: &[Segment]) -> Result<(), ReportError> {
        let drawn = self.series.iter().filter(|s| !matches!(s.style, Style::Measured | Style::Bars));
        let lines = drawn.flat_map(|s| s.points.windows(2));
        let lines = lines.map(|w| (plan.pixel(w[0]), plan.pixel(w[1]))).chain(guides.iter().copied());
        let obstacles: Vec<Frame> = lines.flat_map(beads).collect();
        let rings: Vec<(f64, f64)> = self.annotations.iter().map(|a| plan.pixel((a.x, a.y))).collect();
        let on_guides = guides.iter().map(|&segment| along(segment, 0.7));
        let points: Vec<(f64, f64)> = rings.iter().copied().chain(on_guides).collect();
        let texts = self.annotations.iter().map(|a| &a.text).chain(self.guides.iter().map(|g| &g.1));
        let texts: Vec<String> = texts.cloned().collect();
        let labels = labels::place(&points, &texts, plan.frame, &obstacles)?;
        for (i, (text, label)) in texts.iter().zip(&labels).enumerate() {
            let Frame { left, top, right, bottom } = label.frame;
            let (middle, ring) = (((left + right) / 2.0, (top + bottom) / 2.0), rings.get(i));
            if let Some(&at) = ring {
                if label.leader {
                    canvas.line(&[at, (at.0.clamp(left, right), at.1.clamp(top, bottom))], INK, 0.6)?;
                }
                canvas.circle(at, 6.0, INK, Some(1.8))?;
            }
            canvas.text(text, middle, SMALL, Align::Centre, if ring.is_some() { INK } else { GREY })?;
        }
        Ok(())
    }

    /// Texts beside the last points, pushed apart where lines end together, and then in the order
    /// in which the lines run on the whole.
    fn draw_ends(&self, canvas: &Canvas, plan: &Plan) -> Result<(), ReportError> {
        let mut ends: Vec<(f64, &str, f64)> = Vec::new();
        for s in &self.series {
            if let (Some(text), Some(&last)) = (&s.end, s.points.last()) {
                let sum: f64 = s.points.iter().map(|p| plan.pixel(*p).1).sum();
                ends.push((plan.pixel(last).1, text, sum / s.points.len() as f64));
            }
        }
        let lowest = ends.iter().map(|e| e.0).fold(f64::NEG_INFINITY, f64::max);
        let meet = ends.iter().all(|e| lowest - e.0 < LINE);
        let height = |end: &(f64, &str, f64)| if meet { end.2 } else { end.0 };
        ends.sort_by(|a, b| height(b).total_cmp(&height(a)));
        let heights = apart(&ends.iter().map(|e| e.0).collect::<Vec<_>>(), plan.frame);
        for ((_, text, _), at) in ends.iter().zip(heights) {
            canvas.text(text, (plan.frame.right + 6.0, at), SMALL, Align::Left, INK)?;
        }
        Ok(())
    }
}

/// Width of a coloured line. Where colours repeat the style sheet dashes the line, and where they repeat once
/// more it dots it: it tells lines apart by their width.
fn width(i: usize) -> f64 {
    match i / LINES.len() {
        0 => 1.6,
        1 => 1.7,
        _ => 1.5,
    }
}

fn draw_series(canvas: &Canvas, plan: &Plan, s: &Series) -> Result<(), ReportError> {
    let pixels: Vec<(f64, f64)> = s.points.iter().map(|&p| plan.pixel(p)).collect();
    match s.style {
        Style::Truth => canvas.line(&pixels, s.colour(), 3.0)?,
        Style::Line(i) | Style::Marked(i) => canvas.line(&pixels, s.colour(), width(i))?,
        Style::Measured => {}
        Style::Bars => return bars(canvas, &pixels, s.colour()),
    }
    if !matches!(s.style, Style::Marked(_) | Style::Measured) {
        return Ok(());
    }
    for (&pixel, &(_, y)) in pixels.iter().zip(&s.points) {
        if plan.y.spread == Spread::Log && y <= 0.0 {
            let (x, foot) = pixel;
            canvas.polygon(&[(x - 4.0, foot - 7.0), (x + 4.0, foot - 7.0), (x, foot)], s.colour())?;
        } else {
            canvas.circle(pixel, 2.8, s.colour(), None)?;
        }
    }
    Ok(())
}

/// Vertical bars with caps.
fn bars(canvas: &Canvas, ends: &[(f64, f64)], colour: RGBColor) -> Result<(), ReportError> {
    for (from, to) in ends.as_chunks::<2>().0.iter().map(|[from, to]| (*from, *to)) {
        canvas.line(&[from, to], colour, 1.0)?;
        for (x, y) in [from, to] {
            canvas.line(&[(x - 4.0, y), (x + 4.0, y)], colour, 1.0)?;
        }
    }
    Ok(())
}

/// Height of a line of text.
const LINE: f64 = 12.0;

/// Heights of texts, from the bottom up, at least a line apart and within the frame as long as
/// there is room, each as near as that allows to the height it is wanted at.
fn apart(wanted: &[f64], frame: Frame) -> Vec<f64> {
    let mut heights: Vec<f64> = Vec::with_capacity(wanted.len());
    for &y in wanted {
        let below = heights.last().map_or(f64::INFINITY, |last| last - LINE);
        heights.push(y.min(below).min(frame.bottom));
    }
    // What has been pushed out at the top pushes back.
    let mut above = frame.top - LINE;
    for height in heights.iter_mut().rev() {
        *height = height.max(above + LINE);
        above = *height;
    }
    heights
}

/// From one pixel to another.
type Segment = ((f64, f64), (f64, f64));

/// A guide of constant slope from the top left corner down to the frame.
fn guide(plan: &Plan, slope: f64) -> Segment {
    let decades = |s: Scale| ops::log(s.max / s.min);
    // Fraction of the height that the guide falls over the whole width.
    let fall = -slope * decades(plan.x) / decades(plan.y);
    let (across, down) = if fall > 1.0 { (1.0 / fall, 1.0) } else { (1.0, fall) };
    let f = plan.frame;
    ((f.left, f.top), (f.left + across * f.width(), f.top + down * f.height()))
}

/// The point at a fraction of a segment.
fn along((a, b): Segment, t: f64) -> (f64, f64) {
    (a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t)
}

/// Small squares every four pixels or so along a segment, for labels to keep off.
fn beads(segment: Segment) -> impl Iterator<Item = Frame> {
    let (a, b) = segment;
    let steps = ((b.0 - a.0).abs().max((b.1 - a.1).abs()) / 4.0).ceil().max(1.0) as usize;
    (0..=steps).map(move |i| {
        let (x, y) = along(segment, i as f64 / steps as f64);
        Frame { left: x - 2.0, top: y - 2.0, right: x + 2.0, bottom: y + 2.0 }
    })
}
