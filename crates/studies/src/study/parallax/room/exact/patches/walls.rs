//! Edges between the patches of walls.

use super::super::super::Plane;
use super::super::super::light::{Room, Wall};
use super::flux::{Block, Edge};
use lobefit_math::vector::{Vec3, cross, dot, minus, plus, scaled};

/// How far beside an edge its light is looked at, in metres.
const BESIDE: f64 = 1e-6;

/// Lines nearer to one another are one, pieces and polygons smaller than this are none.
const SAME: f64 = 1e-9;

/// A place on a wall, in its coordinates.
type At = [f64; 2];

/// A half-plane of a wall: normal . at <= offset.
struct Half {
    normal: At,
    offset: f64,
    /// The wall beyond; none where the room is cut off.
    beyond: Option<usize>,
}

/// A side of a polygon: where it begins, and what is beyond.
type Corner = (At, Option<usize>);

/// The edges of all walls, of what is above a plane where one is given.
pub(super) fn blocks(room: &Room, above: Option<Plane>) -> Vec<Block> {
    let mut edges = Vec::new();
    let down = above.map_or([0.0; 3], |plane| scaled(plane.normal, -1.0));
    for (i, wall) in room.walls.iter().enumerate() {
        let others = room.walls.iter().enumerate().filter(|(j, _)| *j != i);
        let mut halves: Vec<Half> =
            others.filter_map(|(j, other)| half(wall, &other.plane, Some(j))).collect();
        if let Some(Plane { offset, .. }) = above {
            let below = Plane { normal: down, offset: -offset };
            // a wall along the plane is above it or not
            match half(wall, &below, None) {
                Some(half) => halves.push(half),
                None if below.depth(origin(wall)) > SAME => {}
                None => continue,
            }
        }
        of_wall((room, i), &halves, down, &mut edges);
    }
    edges.chunks(super::flux::LANES).map(Block::new).collect()
}

/// The place of coordinates 0.
fn origin(wall: &Wall) -> Vec3 {
    scaled(wall.plane.normal, wall.plane.offset)
}

fn coordinates(wall: &Wall, place: Vec3) -> At {
    wall.axes.map(|axis| dot(axis, place))
}

fn placed(wall: &Wall, [x, y]: At) -> Vec3 {
    plus(origin(wall), plus(scaled(wall.axes[0], x), scaled(wall.axes[1], y)))
}

/// What of a wall is inside a plane; `None` of one along it.
fn half(wall: &Wall, plane: &Plane, beyond: Option<usize>) -> Option<Half> {
    let normal = wall.axes.map(|axis| dot(plane.normal, axis));
    let length = (normal[0] * normal[0] + normal[1] * normal[1]).sqrt();
    let offset = plane.depth(origin(wall));
    (length > SAME).then(|| Half { normal: normal.map(|n| n / length), offset: offset / length, beyond })
}

/// The polygon of half-planes, counter-clockwise.
fn polygon(halves: &[Half]) -> Vec<Corner> {
    /// Metres: larger than any wall.
    const LARGE: f64 = 1e4;
    let square = [[-LARGE, -LARGE], [LARGE, -LARGE], [LARGE, LARGE], [-LARGE, LARGE]];
    let mut corners: Vec<Corner> = square.map(|at| (at, None)).to_vec();
    for Half { normal, offset, beyond } in halves {
        let depth = |at: At| offset - normal[0] * at[0] - normal[1] * at[1];
        let mut kept = Vec::new();
        for (i, &(from, side)) in corners.iter().enumerate() {
            let (to, _) = corners[(i + 1) % corners.len()];
            let (a, b) = (depth(from), depth(to));
            let between = || [0, 1].map(|k| from[k] + (to[k] - from[k]) * a / (a - b));
            match (a > SAME, b > SAME) {
                (true, true) => kept.push((from, side)),
                // the side after the place where the boundary leaves is the half-plane's own
                (true, false) => kept.extend([(from, side), (between(), *beyond)]),
                (false, true) => kept.push((between(), side)),
                (false, false) => {}
            }
        }
        corners = kept;
    }
    corners
}

/// Adds the edges of a wall; the room is cut off towards `below`.
fn of_wall((room, index): (&Room, usize), halves: &[Half], below: Vec3, edges: &mut Vec<Edge>) {
    let wall = &room.walls[index];
    let corners = polygon(halves);
    if corners.len() < 3 {
        return;
    }
    // axes whose product points inside run the other way about
    let sign = if dot(cross(wall.axes[0], wall.axes[1]), wall.plane.normal) < 0.0 { -1.0 } else { 1.0 };
    let mut add = |from: At, to: At, [r, g, b]: [f64; 3], covered: f64| {
        if [r, g, b, covered] != [0.0; 4] {
            let jump = [r, g, b, covered].map(|x| sign * x);
            edges.push(Edge { from: placed(wall, from), to: placed(wall, to), jump });
        }
    };
    let places: Vec<At> = corners.iter().map(|(at, _)| *at).collect();
    let lines = [0, 1].map(|axis| lines(wall, axis, &places));
    for axis in 0..2 {
        for &at in &lines[axis] {
            let Some([low, high]) = span(axis, at, halves) else { continue };
            let place = |along: f64, across: f64| {
                if axis == 0 { [at + across, along] } else { [along, at + across] }
            };
            for [from, to] in pieces(low, high, &lines[1 - axis]) {
                let [before, after] =
                    [-BESIDE, BESIDE].map(|beside| wall.at(place(0.5 * (from + to), beside)));
                // upward, a line of the first axis has on its left what is before it, one of the
                // second what is after
                let jump = if axis == 0 { minus(before, after) } else { minus(after, before) };
                add(place(from, 0.0), place(to, 0.0), jump, 0.0);
            }
        }
    }
    for (i, &(from, beyond)) in corners.iter().enumerate() {
        let (to, _) = corners[(i + 1) % corners.len()];
        let along = |t: f64| [0, 1].map(|k| from[k] + t * (to[k] - from[k]));
        // each of two walls has the edge between them
        let beyond = match beyond {
            Some(other) if other < index => continue,
            other => other.map(|other| &room.walls[other]),
        };
        let mut cuts = crossings(wall, [from, to]);
        cuts.extend(
            beyond.iter().flat_map(|other| {
                crossings(other, [from, to].map(|at| coordinates(other, placed(wall, at))))
            }),
        );
        cuts.sort_by(f64::total_cmp);
        let outward = beyond.map_or(below, |other| other.plane.normal);
        for [start, end] in pieces(0.0, 1.0, &cuts) {
            let middle = placed(wall, along(0.5 * (start + end)));
            // a little way into either wall is away from the other
            let of = |wall: &Wall, outward: Vec3| {
                wall.at(coordinates(wall, minus(middle, scaled(outward, BESIDE))))
            };
            let inside = of(wall, outward);
            let jump = beyond.map_or(inside, |other| minus(inside, of(other, wall.plane.normal)));
            add(along(start), along(end), jump, f64::from(u8::from(beyond.is_none())));
        }
    }
}

/// Where the light of a wall may change on the way between two places on it, in parts of it.
fn crossings(wall: &Wall, [from, to]: [At; 2]) -> Vec<f64> {
    let on = |axis: usize| {
        let (from, way) = (from[axis], to[axis] - from[axis]);
        lines(wall, axis, &[[from; 2], [from + way; 2]]).into_iter().map(move |line| (line - from) / way)
    };
    (0..2).flat_map(on).collect()
}

/// Coordinates along one axis at which the light of a wall may change between places, ascending.
fn lines(wall: &Wall, axis: usize, places: &[At]) -> Vec<f64> {
    let ends = places.iter().map(|at| at[axis]);
    let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let side = wall.checker.side;
    let squares = ((low / side).ceil() as i64..=(high / side).floor() as i64).map(|k| side * k as f64);
    let panels = wall.panels.iter().flat_map(|panel| {
        let (centre, half) = (panel.centre[axis], panel.half[axis]);
        [centre - half, centre + half]
    });
    let mut lines: Vec<f64> = squares.chain(panels).filter(|x| *x > low + SAME && *x < high - SAME).collect();
    lines.sort_by(f64::total_cmp);
    lines.dedup_by(|a, b| (*a - *b).abs() < SAME);
    lines
}

/// The part of the line at[axis] = x inside the half-planes.
fn span(axis: usize, x: f64, halves: &[Half]) -> Option<[f64; 2]> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for Half { normal, offset, .. } in halves {
        let (across, along) = (normal[axis], normal[1 - axis]);
        let rest = offset - across * x;
        if along.abs() < SAME {
            if rest < 0.0 {
                return None;
            }
        } else if along > 0.0 {
            high = high.min(rest / along);
        } else {
            low = low.max(rest / along);
        }
    }
    (high - low > SAME && high.is_finite() && low.is_finite()).then_some([low, high])
}

/// An interval between cuts, which ascend.
fn pieces(low: f64, high: f64, cuts: &[f64]) -> Vec<[f64; 2]> {
    let inside = cuts.iter().copied().filter(|x| *x > low + SAME && *x < high - SAME);
    let ends: Vec<f64> = std::iter::once(low).chain(inside).chain([high]).collect();
    ends.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[a, b]| b - a > SAME).collect()
}
