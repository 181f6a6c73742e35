//! Where the names of points go: beside their point, on nothing else.

use super::canvas::{Frame, SMALL};
use super::font;
use crate::ReportError;

/// Half the height of a label in pixels.
const HALF: f64 = 7.0;

/// Distances from the point that are tried, in pixels.
const REACH: [f64; 9] = [7.0, 12.0, 20.0, 32.0, 46.0, 62.0, 80.0, 110.0, 150.0];

/// Directions that are tried (x right, y down), the preferred first.
const DIRECTIONS: [(f64, f64); 12] = [
    (1.0, 0.0),
    (0.8, -0.7),
    (0.8, 0.7),
    (-1.0, 0.0),
    (-0.8, -0.7),
    (-0.8, 0.7),
    (0.0, -1.0),
    (0.0, 1.0),
    (0.4, -1.0),
    (0.4, 1.0),
    (-0.4, -1.0),
    (-0.4, 1.0),
];

/// A label's rectangle and whether it is far enough from its point to need a leader.
pub(crate) struct Label {
    pub(crate) frame: Frame,
    pub(crate) leader: bool,
}

/// Places every label, from right to left, at the first spot that is free of obstacles, points and
/// placed labels. A point without a name only keeps others off.
///
/// Greedy: the first spot whose leader, if it needs one, crosses nothing; else the first that is
/// free; a label with no free spot within the reach keeps the nearest one that is free of other
/// labels, and failing that the first; that takes more than some hundred crowded points.
pub(crate) fn place(
    points: &[(f64, f64)],
    names: &[String],
    inside: Frame,
    obstacles: &[Frame],
) -> Result<Vec<Label>, ReportError> {
    let dots: Vec<Frame> = points.iter().map(|&p| around(p, 5.0, 5.0)).collect();
    // From the right edge, where there is least room, to the left.
    let mut order: Vec<usize> = (0..points.len().min(names.len())).collect();
    order.sort_by(|&a, &b| points[b].0.total_cmp(&points[a].0));
    let named: Vec<(f64, f64)> = order.iter().map(|&i| points[i]).collect();
    let mut placed: Vec<Label> = Vec::with_capacity(points.len());
    for (&point, &index) in named.iter().zip(&order) {
        let name = &names[index];
        if name.is_empty() {
            placed.push(Label { frame: around(point, 0.0, 0.0), leader: false });
            continue;
        }
        let half = font::width(name, SMALL)? / 2.0 + 2.0;
        let spots =
            || REACH.iter().flat_map(move |&r| DIRECTIONS.iter().map(move |&d| spot(point, half, d, r)));
        let apart = |f: &Frame| inside.contains(*f) && !placed.iter().any(|l| l.frame.overlaps(*f));
        let free = |f: &Frame| apart(f) && !dots.iter().chain(obstacles).any(|o| o.overlaps(*f));
        let clear = |f: &Frame| free(f) && is_clear(point, *f, &named[..placed.len()], &placed, &dots);
        let frame = spots()
            .find(clear)
            .or_else(|| spots().find(free))
            .or_else(|| spots().find(apart))
            .unwrap_or_else(|| spot(point, half, DIRECTIONS[0], REACH[0]));
        let leader = needs_leader(point, frame);
        placed.push(Label { frame, leader });
    }
    let mut labels: Vec<(usize, Label)> = order.into_iter().zip(placed).collect();
    labels.sort_by_key(|(index, _)| *index);
    Ok(labels.into_iter().map(|(_, label)| label).collect())
}

/// Whether a label is far enough from its point to be joined to it by a line.
fn needs_leader(point: (f64, f64), frame: Frame) -> bool {
    !frame.overlaps(around(point, 12.0, 12.0))
}

/// Where the line from a point to its label ends: the label's nearest edge.
pub(crate) fn leader_end(point: (f64, f64), frame: Frame) -> (f64, f64) {
    let near = point.0.clamp(frame.left, frame.right);
    if near == point.0 {
        (near, point.1.clamp(frame.top, frame.bottom))
    } else {
        (near, (frame.top + frame.bottom) / 2.0)
    }
}

/// Whether a label's leader crosses no label, no other point and no other leader, and no other
/// leader crosses the label.
fn is_clear(point: (f64, f64), frame: Frame, named: &[(f64, f64)], placed: &[Label], dots: &[Frame]) -> bool {
    let others = || named.iter().zip(placed).filter(|(_, label)| label.leader);
    if others()
        .any(|(from, label)| beads(*from, leader_end(*from, label.frame)).any(|bead| bead.overlaps(frame)))
    {
        return false;
    }
    if !needs_leader(point, frame) {
        return true;
    }
    let end = leader_end(point, frame);
    let own = around(point, 5.0, 5.0);
    let blocked = |bead: Frame| {
        placed.iter().any(|label| label.frame.overlaps(bead))
            || dots.iter().any(|dot| *dot != own && !dot.overlaps(own) && dot.overlaps(bead))
    };
    !beads(point, end).any(blocked)
        && !others().any(|(from, label)| crosses((point, end), (*from, leader_end(*from, label.frame))))
}

/// Small squares every three pixels or so along a line.
fn beads(a: (f64, f64), b: (f64, f64)) -> impl Iterator<Item = Frame> {
    let steps = ((b.0 - a.0).abs().max((b.1 - a.1).abs()) / 3.0).ceil().max(1.0) as usize;
    (0..=steps).map(move |i| {
        let t = i as f64 / steps as f64;
        around((a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t), 1.0, 1.0)
    })
}

/// Whether two segments cross.
fn crosses((a, b): ((f64, f64), (f64, f64)), (c, d): ((f64, f64), (f64, f64))) -> bool {
    let side =
        |p: (f64, f64), q: (f64, f64), r: (f64, f64)| (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// The label whose nearest edge lies `reach` pixels from the point in a direction.
fn spot(point: (f64, f64), half: f64, (dx, dy): (f64, f64), reach: f64) -> Frame {
    let side = if dx == 0.0 { 0.0 } else { dx.signum() * half };
    let lift = if dx.abs() == 1.0 { 0.0 } else { dy.signum() * HALF / 2.0 };
    around((point.0 + dx * reach + side, point.1 + dy * reach + lift), half, HALF)
}

fn around((x, y): (f64, f64), half_width: f64, half_height: f64) -> Frame {
    Frame { left: x - half_width, top: y - half_height, right: x + half_width, bottom: y + half_height }
}
