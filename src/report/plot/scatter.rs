//! Named points, cost against error, with the frontier of ours.

use plotters::style::RGBColor;

use super::canvas::{Align, Canvas, Frame, GREY, INK, SMALL, TEXT, sheet};
use super::legend::{Key, Legend};
use super::{Figure, LINES, Scale, Spread, axes, font, labels};
use crate::report::{ReportError, check};

/// One named point.
#[derive(Clone, Debug, PartialEq)]
pub struct Dot {
    /// Name beside the point; empty for none.
    pub name: String,
    /// Cost.
    pub x: f64,
    /// Error; must be positive on a logarithmic axis.
    pub y: f64,
    /// Somebody else's: grey, and not part of the frontier.
    pub published: bool,
    /// A table: a square instead of a disc.
    pub table: bool,
}

/// Points over two axes. The frontier joins the formulas of ours that no other formula of ours
/// beats in both; tables stand apart, since a fetch is no operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// Line above the chart.
    pub title: String,
    /// Label and spread of the horizontal axis.
    pub x: (String, Spread),
    /// Label and spread of the vertical axis.
    pub y: (String, Spread),
    /// The points.
    pub dots: Vec<Dot>,
    /// Size of the plotted area in pixels.
    pub size: (f64, f64),
}

/// Indices of the formulas of ours that no other formula of ours beats in both, by rising x.
pub(crate) fn frontier(dots: &[Dot]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..dots.len()).filter(|&i| !dots[i].published && !dots[i].table).collect();
    order.sort_by(|&a, &b| dots[a].x.total_cmp(&dots[b].x).then(dots[a].y.total_cmp(&dots[b].y)));
    let mut best = f64::INFINITY;
    order.retain(|&i| {
        dots[i].y < best && {
            best = dots[i].y;
            true
        }
    });
    order
}

impl Figure for Scatter {
    fn svg(&self) -> Result<String, ReportError> {
        self.check()?;
        let legend = Legend::flow(self.entries(), self.size.0)?;
        let top = 28.0 + legend.height();
        let x = Scale::around(self.x.1, self.dots.iter().map(|d| d.x));
        let y = Scale::around(self.y.1, self.dots.iter().map(|d| d.y)).roomy(self.dots.iter().map(|d| d.y));
        let left = axes::left_space(y, self.size.1)?;
        let frame = Frame { left, top, right: left + self.size.0, bottom: top + self.size.1 };
        let pixels: Vec<(f64, f64)> = self
            .dots
            .iter()
            .map(|d| {
                (
                    frame.left + x.position(d.x) * frame.width(),
                    frame.bottom - y.position(d.y) * frame.height(),
                )
            })
            .collect();
        sheet(&self.title, (frame.right + 18.0, frame.bottom + 44.0), "", |canvas| {
            let title = font::shorten(&self.title, TEXT, frame.width())?;
            canvas.text(&title, (frame.left, 12.0), TEXT, Align::Left, INK)?;
            legend.draw(canvas, (frame.left, 22.0))?;
            axes::grid(canvas, frame, (x, &self.x.0), (y, &self.y.0))?;
            self.draw(canvas, frame, &pixels)
        })
    }
}

impl Scatter {
    fn check(&self) -> Result<(), ReportError> {
        check::filled(&self.title, "dots", self.dots.len())?;
        for d in &self.dots {
            for (field, value, spread) in [("x", d.x, self.x.1), ("y", d.y, self.y.1)] {
                let field = format!("dot {}.{field}", d.name);
                check::finite(&self.title, &field, value)?;
                if spread == Spread::Log && value <= 0.0 {
                    return Err(check::domain(&self.title, &field, "must be positive on a logarithmic axis"));
                }
            }
        }
        Ok(())
    }

    fn entries(&self) -> Vec<super::legend::Entry> {
        let has = |published, table| self.dots.iter().any(|d| d.published == published && d.table == table);
        let mut entries = Vec::new();
        let mut add = |there: bool, name: &str, colour, key| {
            if there {
                entries.push((name.to_string(), colour, key));
            }
        };
        add(has(false, false), "ours: formula", LINES[1], Key::Disc);
        add(has(false, true), "ours: table", LINES[1], Key::Square);
        add(has(true, false), "published: formula", GREY, Key::Disc);
        add(has(true, true), "published: table", GREY, Key::Square);
        add(has(false, false), "frontier of our formulas", LINES[0], Key::Line(1.6));
        entries
    }

    fn draw(&self, canvas: &Canvas, frame: Frame, pixels: &[(f64, f64)]) -> Result<(), ReportError> {
        let steps = stairs(&frontier(&self.dots).iter().map(|&i| pixels[i]).collect::<Vec<_>>(), frame);
        if !steps.is_empty() {
            canvas.line(&steps, LINES[0], 1.6)?;
        }
        let lines: Vec<Frame> = steps.windows(2).map(|w| thin(w[0], w[1])).collect();
        let names: Vec<String> = self.dots.iter().map(|d| d.name.clone()).collect();
        let labels = labels::place(pixels, &names, frame, &lines)?;
        for ((dot, &at), label) in self.dots.iter().zip(pixels).zip(&labels) {
            let colour = colour(dot);
            let middle = (label.frame.left + label.frame.right) / 2.0;
            let height = (label.frame.top + label.frame.bottom) / 2.0;
            if label.leader {
                canvas.line(&[at, labels::leader_end(at, label.frame)], GREY, 0.6)?;
            }
            if dot.table {
                canvas.square(at, 4.0, colour)?;
            } else {
                canvas.circle(at, 4.0, colour, None)?;
            }
            let ink = if dot.published { GREY } else { INK };
            canvas.text(&dot.name, (middle, height), SMALL, Align::Centre, ink)?;
        }
        Ok(())
    }
}

/// The frontier as stairs: down at each point, level to the next, level to the right edge.
fn stairs(points: &[(f64, f64)], frame: Frame) -> Vec<(f64, f64)> {
    let mut out = Vec::new();
    for (i, &(x, y)) in points.iter().enumerate() {
        out.push((x, y));
        out.push((points.get(i + 1).map_or(frame.right, |p| p.0), y));
    }
    out
}

fn thin(a: (f64, f64), b: (f64, f64)) -> Frame {
    Frame {
        left: a.0.min(b.0) - 1.0,
        top: a.1.min(b.1) - 1.0,
        right: a.0.max(b.0) + 1.0,
        bottom: a.1.max(b.1) + 1.0,
    }
}

fn colour(dot: &Dot) -> RGBColor {
    if dot.published { GREY } else { LINES[1] }
}
