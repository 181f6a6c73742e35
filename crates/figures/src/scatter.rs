//! Named points, cost against error, with the frontier of ours.

use plotters::style::RGBColor;

use super::canvas::{Align, Canvas, Frame, GREY, INK, SMALL, TEXT, sheet};
use super::legend::{Entry, Key, Legend};
use super::{Figure, LINES, Scale, Spread, axes, font, hover, labels};
use lobefit_math::numbers;

use crate::{ReportError, check};

/// What a grey dot is, on every chart.
const BEATEN: &str = "ours, beaten in both";

/// So many points have room for the names of published ones.
const FEW: usize = 8;

/// One named point.
#[derive(Clone, Debug, PartialEq)]
pub struct Dot {
    /// Name, which a point of the frontier has beside it, and every point under the pointer.
    pub name: String,
    /// Cost.
    pub x: f64,
    /// Error; must be positive on a logarithmic axis.
    pub y: f64,
    /// Somebody else's: a grey ring, and not part of the frontier.
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

/// Such points of several quantities, each of ours in its colour with a frontier of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Frontiers {
    /// Line above the chart.
    pub title: String,
    /// Label and spread of the horizontal axis.
    pub x: (String, Spread),
    /// Label and spread of the vertical axis.
    pub y: (String, Spread),
    /// Name and points of each; neighbours of one name share a colour.
    pub groups: Vec<(String, Vec<Dot>)>,
    /// Names of the points that have them beside them.
    pub named: Vec<String>,
    /// Size of the plotted area in pixels.
    pub size: (f64, f64),
}

/// Indices of the formulas of ours that no other formula of ours beats in both, by rising x.
pub fn frontier(dots: &[Dot]) -> Vec<usize> {
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
        let has = |published, table| self.dots.iter().any(|d| d.published == published && d.table == table);
        let mut entries = Vec::new();
        let mut add = |there: bool, name: &str, colour, key| {
            if there {
                entries.push((name.to_string(), colour, key));
            }
        };
        add(has(false, false), "ours: formula", LINES[1], Key::Disc);
        add(has(false, true), "ours: table", LINES[1], Key::Square);
        add(has(true, false), "published: formula", GREY, Key::Ring);
        add(has(true, true), "published: table", GREY, Key::Square);
        add(has(false, false), "frontier of our formulas", LINES[0], Key::Line(1.6));
        let best = frontier(&self.dots);
        let ours = self.dots.iter().filter(|dot| !dot.published && !dot.table).count();
        add(best.len() < ours, BEATEN, GREY, Key::Disc);
        let all = self.dots.iter().enumerate();
        let few = self.dots.len() <= FEW;
        let named =
            all.filter(|(i, dot)| best.contains(i) || dot.table && !dot.published || dot.published && few);
        let named: Vec<String> = named.map(|(_, dot)| dot.name.clone()).collect();
        let group = Group { dots: &self.dots, named: &named, colour: LINES[1], line: LINES[0] };
        chart(&self.title, (&self.x, &self.y), self.size, (entries, &[group]))
    }
}

impl Figure for Frontiers {
    fn svg(&self) -> Result<String, ReportError> {
        let mut entries: Vec<Entry> = Vec::new();
        let mut colours = Vec::new();
        for (name, _) in &self.groups {
            if entries.last().is_none_or(|(last, ..)| last != name) {
                entries.push((name.clone(), LINES[entries.len() % LINES.len()], Key::Disc));
            }
            colours.extend(entries.last().map(|(_, colour, _)| *colour));
        }
        let beaten = |dots: &[Dot]| {
            frontier(dots).len() < dots.iter().filter(|dot| !dot.published && !dot.table).count()
        };
        if self.groups.iter().any(|(_, dots)| beaten(dots)) {
            entries.push((BEATEN.into(), GREY, Key::Disc));
        }
        let mut dots = self.groups.iter().flat_map(|(_, dots)| dots);
        if dots.clone().any(|dot| dot.table) {
            entries.push(("table".into(), INK, Key::Square));
        }
        if dots.any(|dot| dot.published) {
            entries.push(("published".into(), GREY, Key::Ring));
        }
        let groups = self.groups.iter().map(|(_, dots)| dots).zip(colours);
        let groups: Vec<Group> =
            groups.map(|(dots, colour)| Group { dots, named: &self.named, colour, line: colour }).collect();
        chart(&self.title, (&self.x, &self.y), self.size, (entries, &groups))
    }
}

/// Points that share a frontier.
struct Group<'a> {
    dots: &'a [Dot],
    named: &'a [String],
    colour: RGBColor,
    line: RGBColor,
}

/// Label and spread of an axis.
type Labelled = (String, Spread);

fn chart(
    title: &str,
    (x, y): (&Labelled, &Labelled),
    size: (f64, f64),
    (entries, groups): (Vec<Entry>, &[Group]),
) -> Result<String, ReportError> {
    let dots: Vec<&Dot> = groups.iter().flat_map(|group| group.dots).collect();
    checked(title, &dots, [x.1, y.1])?;
    let legend = Legend::flow(entries, size.0)?;
    let top = 28.0 + legend.height();
    let across = Scale::around(x.1, dots.iter().map(|d| d.x)).roomy(dots.iter().map(|d| d.x));
    let up = Scale::around(y.1, dots.iter().map(|d| d.y)).roomy(dots.iter().map(|d| d.y));
    let left = axes::left_space(up, size.1)?;
    let frame = Frame { left, top, right: left + size.0, bottom: top + size.1 };
    let pixel = |d: &Dot| {
        (frame.left + across.position(d.x) * frame.width(), frame.bottom - up.position(d.y) * frame.height())
    };
    let svg = sheet(title, (frame.right + 18.0, frame.bottom + 44.0), "", |canvas| {
        let shown = font::shorten(title, TEXT, frame.width())?;
        canvas.text(&shown, (frame.left, 12.0), TEXT, Align::Left, INK)?;
        legend.draw(canvas, (frame.left, 22.0))?;
        axes::grid(canvas, frame, (across, &x.0), (up, &y.0))?;
        draw(canvas, frame, groups, &pixel)
    })?;
    let tip = |d: &&Dot| {
        let [x, y] = [(&x.0, d.x), (&y.0, d.y)].map(|(label, v)| (hover::short(label), numbers::brief(v, 3)));
        (pixel(d), format!("{}: {} {}, {} {}", d.name, x.0, x.1, y.0, y.1))
    };
    Ok(hover::spots(&svg, &dots.iter().map(tip).collect::<Vec<_>>()))
}

fn checked(title: &str, dots: &[&Dot], [x, y]: [Spread; 2]) -> Result<(), ReportError> {
    check::filled(title, "dots", dots.len())?;
    for d in dots {
        for (field, value, spread) in [("x", d.x, x), ("y", d.y, y)] {
            let field = format!("dot {}.{field}", d.name);
            check::finite(title, &field, value)?;
            if spread == Spread::Log && value <= 0.0 {
                return Err(check::domain(title, &field, "must be positive on a logarithmic axis"));
            }
        }
    }
    Ok(())
}

/// Stairs, marks and names.
fn draw(
    canvas: &Canvas,
    frame: Frame,
    groups: &[Group],
    pixel: &dyn Fn(&Dot) -> (f64, f64),
) -> Result<(), ReportError> {
    let (mut pixels, mut names, mut lines, mut beaten) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for group in groups {
        let best = frontier(group.dots);
        let steps = stairs(&best.iter().map(|&i| pixel(&group.dots[i])).collect::<Vec<_>>(), frame);
        if !steps.is_empty() {
            canvas.line(&steps, group.line, 1.6)?;
        }
        lines.extend(steps.windows(2).map(|w| thin(w[0], w[1])));
        for (i, dot) in group.dots.iter().enumerate() {
            beaten.push(!dot.table && !dot.published && !best.contains(&i));
            pixels.push(pixel(dot));
            names.push(if group.named.contains(&dot.name) { dot.name.clone() } else { String::new() });
        }
    }
    let labels = labels::place(&pixels, &names, frame, &lines)?;
    let of_groups = groups.iter().flat_map(|group| group.dots.iter().map(move |dot| (dot, group)));
    let placed = labels.iter().zip(&names).zip(beaten);
    for (((dot, group), &at), ((label, name), beaten)) in of_groups.zip(&pixels).zip(placed) {
        let colour = if dot.published || beaten { GREY } else { group.colour };
        let middle = (label.frame.left + label.frame.right) / 2.0;
        let height = (label.frame.top + label.frame.bottom) / 2.0;
        if label.leader {
            canvas.line(&[at, labels::leader_end(at, label.frame)], GREY, 0.6)?;
        }
        if dot.table {
            canvas.square(at, 4.0, colour)?;
        } else {
            let (radius, ring) = if dot.published { (3.4, Some(1.2)) } else { (4.0, None) };
            canvas.circle(at, radius, colour, ring)?;
        }
        if !name.is_empty() {
            canvas.text(name, (middle, height), SMALL, Align::Centre, INK)?;
        }
    }
    Ok(())
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
