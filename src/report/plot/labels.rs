//! Where the names of points go: beside their point, on nothing else.

use super::canvas::{Frame, SMALL};
use super::font;
use crate::report::ReportError;

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

/// Places every label, in the order given, at the first spot that is free of obstacles, points and placed labels. A point
/// without a name only keeps others off.
///
/// Greedy: a label with no free spot within the reach keeps the nearest one that is free of other labels, and
/// failing that the first; that takes more than some hundred crowded points.
pub(crate) fn place(
    points: &[(f64, f64)],
    names: &[String],
    inside: Frame,
    obstacles: &[Frame],
) -> Result<Vec<Label>, ReportError> {
    let dots: Vec<Frame> = points.iter().map(|&p| around(p, 5.0, 5.0)).collect();
    let mut placed: Vec<Label> = Vec::with_capacity(points.len());
    for (&point, name) in points.iter().zip(names) {
        if name.is_empty() {
            placed.push(Label { frame: around(point, 0.0, 0.0), leader: false });
            continue;
        }
        let half = font::width(name, SMALL)? / 2.0 + 2.0;
        let spots =
            || REACH.iter().flat_map(move |&r| DIRECTIONS.iter().map(move |&d| spot(point, half, d, r)));
        let apart = |f: &Frame| inside.contains(*f) && !placed.iter().any(|l| l.frame.overlaps(*f));
        let free = |f: &Frame| apart(f) && !dots.iter().chain(obstacles).any(|o| o.overlaps(*f));
        let frame = spots()
            .find(free)
            .or_else(|| spots().find(apart))
            .unwrap_or_else(|| spot(point, half, DIRECTIONS[0], REACH[0]));
        let leader = !frame.overlaps(around(point, 12.0, 12.0));
        placed.push(Label { frame, leader });
    }
    Ok(placed)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_labels_in_a_crowd_do_not_touch() -> Result<(), ReportError> {
        let points: Vec<(f64, f64)> =
            (0..30).map(|i| (200.0 + f64::from(i % 6) * 21.0, 150.0 + f64::from(i / 6) * 17.0)).collect();
        let names: Vec<String> = (0..30).map(|i| format!("rational-fit-{i}")).collect();
        let inside = Frame { left: 0.0, top: 0.0, right: 700.0, bottom: 420.0 };
        let labels = place(&points, &names, inside, &[])?;
        for (i, a) in labels.iter().enumerate() {
            assert!(inside.contains(a.frame));
            assert!(!labels[i + 1..].iter().any(|b| a.frame.overlaps(b.frame)), "label {i}");
        }
        Ok(())
    }
}
