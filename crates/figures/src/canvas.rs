//! A sheet of SVG to draw on, in pixels of the page; plotters draws, this wrapper scales and names.
//!
//! plotters' coordinates are integers, so the sheet is drawn at [`SCALE`] units per pixel and shown
//! through its view box: coordinates have one fixed decimal, and the same data gives the same bytes
//! everywhere.

use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, Drawable, PathElement, PointCollection, Polygon, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, RGBColor, ShapeStyle, TextStyle};

use super::font;
use crate::ReportError;

/// Units of the drawing layer per pixel.
const SCALE: f64 = 10.0;

/// plotters prints a font size divided by this.
const FONT_RATIO: f64 = 1.24;

/// Ink of axes and text; the page's style sheet turns exactly this colour light on a dark page.
pub(crate) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);

/// Ink of text that always stands on a light label, whatever the page.
pub(crate) const LABEL_INK: RGBColor = RGBColor(0x10, 0x10, 0x10);

/// Grid lines; darkened by the style sheet on a dark page.
pub(crate) const GRID: RGBColor = RGBColor(0xDD, 0xDD, 0xDD);

/// What is there for comparison: published formulas.
pub(crate) const GREY: RGBColor = RGBColor(0x8A, 0x8A, 0x8A);

/// White of labels.
pub(crate) const PAPER: RGBColor = RGBColor(0xFF, 0xFF, 0xFF);

/// Size of small text (ticks, legends) in pixels.
pub(crate) const SMALL: f64 = 11.0;

/// Size of axis labels in pixels.
pub(crate) const TEXT: f64 = 13.0;

/// Horizontal anchor of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Align {
    /// The text starts at its place.
    Left,
    /// The text is centred on its place.
    Centre,
    /// The text ends at its place.
    Right,
}

/// A rectangle in pixels: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Frame {
    /// Width in pixels.
    pub(crate) fn width(self) -> f64 {
        self.right - self.left
    }

    /// Height in pixels.
    pub(crate) fn height(self) -> f64 {
        self.bottom - self.top
    }

    /// Whether two rectangles share area.
    pub(crate) fn overlaps(self, other: Frame) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    /// Whether `other` lies inside.
    pub(crate) fn contains(self, other: Frame) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }
}

/// The sheet handed to a drawing closure.
pub(crate) struct Canvas<'a> {
    area: DrawingArea<SVGBackend<'a>, Shift>,
    figure: &'a str,
}

/// Draws a sheet of `width` by `height` pixels; `under` is SVG markup laid under the drawing
/// (pictures).
pub(crate) fn sheet(
    figure: &str,
    (width, height): (f64, f64),
    under: &str,
    draw: impl FnOnce(&Canvas) -> Result<(), ReportError>,
) -> Result<String, ReportError> {
    font::font()?;
    let mut text = String::new();
    {
        let size = (unit(width) as u32, unit(height) as u32);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        let canvas = Canvas { area, figure };
        draw(&canvas)?;
        canvas.area.present().map_err(|e| refused(figure, &e))?;
    }
    // The first line is plotters' own <svg ...>; ours has the page's size and a name for screen
    // readers.
    let body = text.split_once('\n').map_or("", |(_, rest)| rest);
    Ok(format!(
        "<svg class=\"plot\" role=\"img\" aria-label=\"{}\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\">\n{under}{}</svg>",
        escape(figure),
        unit(width),
        unit(height),
        tidy(body.trim_end().trim_end_matches("</svg>")),
    ))
}

/// A PNG as SVG markup that fills `frame`, its pixels sharp-edged if `crisp`.
pub(crate) fn picture(png_base64: &str, frame: Frame, crisp: bool) -> String {
    let class = if crisp { " class=\"crisp\"" } else { "" };
    format!(
        "<image{class} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
         href=\"data:image/png;base64,{png_base64}\"/>\n",
        unit(frame.left),
        unit(frame.top),
        unit(frame.width()),
        unit(frame.height()),
    )
}

impl<'a> Canvas<'a> {
    /// A line through points, `width` pixels wide.
    pub(crate) fn line(
        &self,
        points: &[(f64, f64)],
        colour: RGBColor,
        width: f64,
    ) -> Result<(), ReportError> {
        self.draw(&PathElement::new(units(points), stroke(colour, width)))
    }

    /// A filled rectangle with opacity in [0, 1].
    pub(crate) fn fill(&self, frame: Frame, colour: RGBColor, opacity: f64) -> Result<(), ReportError> {
        let corners = [place((frame.left, frame.top)), place((frame.right, frame.bottom))];
        self.draw(&Rectangle::new(corners, ShapeStyle::from(&colour.mix(opacity)).filled()))
    }

    /// The outline of a rectangle.
    pub(crate) fn outline(&self, frame: Frame, colour: RGBColor, width: f64) -> Result<(), ReportError> {
        let Frame { left, top, right, bottom } = frame;
        // The last stroke runs over the first corner, which closes the join.
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top), (right, top)];
        self.line(&corners, colour, width)
    }

    /// A disc, or with `Some(width)` a ring.
    pub(crate) fn circle(
        &self,
        centre: (f64, f64),
        radius: f64,
        colour: RGBColor,
        ring: Option<f64>,
    ) -> Result<(), ReportError> {
        let style = ring.map_or(ShapeStyle::from(&colour).filled(), |w| stroke(colour, w));
        self.draw(&Circle::new(place(centre), unit(radius), style))
    }

    /// A filled square of half side `half`.
    pub(crate) fn square(&self, (x, y): (f64, f64), half: f64, colour: RGBColor) -> Result<(), ReportError> {
        let frame = Frame { left: x - half, top: y - half, right: x + half, bottom: y + half };
        self.fill(frame, colour, 1.0)
    }

    /// A filled polygon.
    pub(crate) fn polygon(&self, points: &[(f64, f64)], colour: RGBColor) -> Result<(), ReportError> {
        self.draw(&Polygon::new(units(points), ShapeStyle::from(&colour).filled()))
    }

    /// A line of text, vertically centred on its place.
    pub(crate) fn text(
        &self,
        text: &str,
        at: (f64, f64),
        size: f64,
        align: Align,
        colour: RGBColor,
    ) -> Result<(), ReportError> {
        self.draw(&Text::new(text.to_string(), place(at), style(size, align, colour)))
    }

    /// A line of text that reads upwards, centred on its place.
    pub(crate) fn upright(&self, text: &str, at: (f64, f64), size: f64) -> Result<(), ReportError> {
        let style = style(size, Align::Centre, INK).transform(FontTransform::Rotate270);
        self.draw(&Text::new(text.to_string(), place(at), style))
    }

    /// Text on a light label, kept inside `frame` and beside `at`.
    pub(crate) fn note(&self, text: &str, at: (f64, f64), frame: Frame) -> Result<(), ReportError> {
        let width = font::width(text, SMALL)? + 6.0;
        let left = if at.0 + 8.0 + width <= frame.right { at.0 + 8.0 } else { at.0 - 8.0 - width };
        let left = left.max(frame.left).min((frame.right - width).max(frame.left));
        let middle = at.1.max(frame.top + 9.0).min(frame.bottom - 9.0);
        let label = Frame { left, top: middle - 8.0, right: left + width, bottom: middle + 8.0 };
        self.fill(label, PAPER, 0.85)?;
        self.text(text, (left + 3.0, middle), SMALL, Align::Left, LABEL_INK)
    }

    fn draw<'b, E>(&self, element: &'b E) -> Result<(), ReportError>
    where
        &'b E: PointCollection<'b, (i32, i32)>,
        E: Drawable<SVGBackend<'a>>,
    {
        self.area.draw(element).map_err(|e| refused(self.figure, &e))
    }
}

/// Text with the characters that mean something in markup replaced.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}

/// Drops what plotters writes for every element and the style sheet or the SVG default says
/// already, and draws lines of one kind that follow one another, as those of a grid, as one path.
fn tidy(body: &str) -> String {
    let short = body
        .replace(" opacity=\"1\"", "")
        .replace(" stroke=\"none\"", "")
        .replace(" font-family=\"lobefit\"", "")
        .replace(" text-anchor=\"start\"", "")
        .replace(" stroke-width=\"1\"/>", "/>")
        .replace(">\n<", "><");
    let mut out = String::with_capacity(short.len());
    // What a path is open for: the attributes of its lines.
    let mut open: Option<&str> = None;
    let mut rest = short.as_str();
    while !rest.is_empty() {
        let end = rest[1..].find('<').map_or(rest.len(), |at| at + 1);
        let (element, after) = rest.split_at(end);
        match straight(element) {
            Some((kind, from, to)) => {
                if open != Some(kind) {
                    out += &format!("{}<path{kind} d=\"", if open.is_some() { "\"/>" } else { "" });
                    open = Some(kind);
                }
                out += &format!("M{from}L{to}");
            }
            None => {
                if open.take().is_some() {
                    out += "\"/>";
                }
                out += element;
            }
        }
        rest = after;
    }
    if open.is_some() {
        out += "\"/>";
    }
    out
}

/// Attributes and ends of a thin straight line: of a grid, a tick, a leader.
fn straight(element: &str) -> Option<(&str, &str, &str)> {
    let (kind, points) = element.strip_prefix("<polyline")?.split_once(" points=\"")?;
    let points = points.trim_end().strip_suffix("\"/>")?.trim_end();
    let (from, to) = points.split_once(' ')?;
    let thin = kind.ends_with("stroke-width=\"8\"") || kind.ends_with("stroke-width=\"10\"");
    (thin && !to.contains(' ')).then_some((kind, from, to))
}

fn refused(figure: &str, error: &impl std::fmt::Display) -> ReportError {
    ReportError::Drawing { section: figure.into(), reason: error.to_string() }
}

pub(crate) fn unit(x: f64) -> i32 {
    (x * SCALE).round() as i32
}

fn place((x, y): (f64, f64)) -> (i32, i32) {
    (unit(x), unit(y))
}

fn units(points: &[(f64, f64)]) -> Vec<(i32, i32)> {
    points.iter().map(|&p| place(p)).collect()
}

fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    ShapeStyle::from(&colour).stroke_width(unit(width) as u32)
}

fn style(size: f64, align: Align, colour: RGBColor) -> TextStyle<'static> {
    let horizontal = match align {
        Align::Left => HPos::Left,
        Align::Centre => HPos::Center,
        Align::Right => HPos::Right,
    };
    TextStyle {
        color: colour.to_backend_color(),
        pos: Pos::new(horizontal, VPos::Center),
        ..TextStyle::from((font::FAMILY, size * SCALE * FONT_RATIO))
    }
}
