//! Where tables are judged: points with their truths, and more of them where a lookup errs most.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::lookup::Variable;
use super::{
    BuildError, Family, Further, Judged, Lookup, LookupPoints, Made, Point, Region, Truth, Truths, error_map,
};
use crate::approximate::Memo;
use crate::data::{AXES, Axis, Decode, Smith, Surface, Table};
use crate::effects::{Albedo, BakeError};
use crate::store::Key;
use lobefit_math::sobol::Sobol;

/// Points even in the coordinates of a table.
const EVEN: u32 = 1 << 13;

/// Rounds: places about which the largest error is searched, points about each, and the width of the
/// box that these are in, in cells of the table.
const ROUNDS: [(usize, u32, f64); 7] = [
    (64, 64, 4.0),
    (64, 64, 2.0),
    (64, 64, 1.0),
    (64, 64, 0.5),
    (64, 64, 0.25),
    (32, 128, 0.125),
    (16, 128, 0.06),
];

/// Points with their truths, shared by the tables that are measured there.
#[derive(Clone, Debug)]
pub struct Judge {
    /// The points.
    pub points: LookupPoints,
    /// E, and B where a table needs it, of each side; of a judge of one table, of its side alone.
    pub truths: Vec<Albedo>,
    /// What they took.
    pub made: Made,
    /// The truth elsewhere, once any of it is computed.
    further: OnceLock<Further>,
    smith: Smith,
    region: Region,
    finer: bool,
}

impl Judge {
    /// The points of a region with the truth of each side, which tells more than E in the mean over
    /// the azimuth where it is `finer`.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn new(
        family: &dyn Family,
        smith: Smith,
        region: Region,
        finer: bool,
        memo: &Memo,
    ) -> Result<Judge, BuildError> {
        let points = family.points(&region, finer)?;
        let (truths, made, further) = (Vec::new(), Made::default(), OnceLock::new());
        let empty = Judge { points, truths, made, further, smith, region, finer };
        let (truths, made) = memo.kept(empty.key(family, "judge"), || {
            let Truths { sides, made, further } = family.truths(smith, &empty.points, finer, memo)?;
            // It is the first.
            let _ = empty.further.set(further);
            Ok::<_, BuildError>((sides, made))
        })?;
        Ok(Judge { truths, made, ..empty })
    }

    /// What determines its truths.
    fn key(&self, family: &dyn Family, kind: &'static str) -> Key {
        let of = (self.smith, self.region, self.finer);
        Key::of(kind).with(&family.identity()).with(&format!("{of:?}"))
    }

    /// The truth of side `i` at further points.
    fn further(
        &self,
        (family, i): (&dyn Family, usize),
        points: &LookupPoints,
        memo: &Memo,
    ) -> Result<Albedo, BakeError> {
        let numbers = |p: &Point| [p.alpha, p.mu, p.anisotropy, p.ior, p.cos2_phi].map(f64::from);
        let at: Vec<f64> = points.all.iter().flat_map(numbers).collect();
        memo.kept(self.key(family, "judged").with(&i.to_string()).numbers(&at), || {
            let further = match self.further.get() {
                Some(further) => further,
                None => {
                    let made = family.truths(self.smith, &self.points, self.finer, memo)?.further;
                    self.further.get_or_init(|| made)
                }
            };
            Ok(further.at(i, points, memo)?)
        })
    }

    /// The truth of side `i`.
    pub fn truth(&self, i: usize) -> Truth<'_> {
        Truth::of(&self.truths[i])
    }

    /// Whether the lookup of a table of side `i` errs by more than a limit at the points of the region
    /// alone, before any more of them are added.
    ///
    /// # Errors
    /// A table that cannot be looked up.
    pub fn exceeds(
        &self,
        (table, decode): (&Table, Decode),
        i: usize,
        limit: f64,
    ) -> Result<bool, BakeError> {
        let table = table.quantised();
        let lookup = Lookup::new(&table, decode)?;
        let errors = error_map(&lookup, judged(decode), &self.points, self.truth(i))?;
        Ok(errors.iter().any(|error| error.abs() > limit))
    }

    /// The judge of one table, of side `i`: about the places where its lookup errs most, points are
    /// added until they close in on the largest errors. Points drawn over the whole region miss the
    /// peak of a cell: by 6 % of the largest error of a 32x32x4 table of glass.
    ///
    /// # Errors
    /// A truth that cannot be integrated; a table that cannot be looked up.
    pub fn closer(
        &self,
        (table, decode): (&Table, Decode),
        side: (&dyn Family, usize),
        memo: &Memo,
    ) -> Result<Judge, BakeError> {
        let table = table.quantised();
        let lookup = Lookup::new(&table, decode)?;
        let over = (&table.axes[..], &self.region);
        let truths = vec![self.truths[side.1].clone()];
        let mut closer = Judge { truths, ..self.clone() };
        if let Some(n) = side.0.judged_at(table.size().iter().product()) {
            self.add(&mut closer, (side, (&lookup, decode)), even(over, n), memo)?;
            return Ok(closer);
        }
        let errors = error_map(&lookup, judged(decode), &closer.points, closer.truth(0))?;
        let mut cells = Cells::default();
        cells.add(&lookup, &closer.points.all, &errors);
        let mut near = even(over, EVEN);
        for (places, n, width) in ROUNDS {
            let errors = self.add(&mut closer, (side, (&lookup, decode)), near, memo)?;
            let points = &closer.points.all;
            cells.add(&lookup, &points[points.len() - errors.len()..], &errors);
            let about = |i: usize| about(over, &lookup, &points[i], (n, width));
            near = cells.worst(places).into_iter().flat_map(about).collect();
        }
        self.add(&mut closer, (side, (&lookup, decode)), near, memo)?;
        Ok(closer)
    }

    /// Adds points with their truth to a judge of one table; returns the errors of a lookup there.
    fn add(
        &self,
        closer: &mut Judge,
        (side, (lookup, decode)): ((&dyn Family, usize), (&Lookup, Decode)),
        points: Vec<Point>,
        memo: &Memo,
    ) -> Result<Vec<f64>, BakeError> {
        let points = self.points.more(points);
        let truth = self.further(side, &points, memo)?;
        let errors = error_map(lookup, judged(decode), &points, Truth::of(&truth))?;
        closer.points.all.extend(points.all);
        closer.points.uniform.extend(points.uniform);
        closer.truths[0].e.extend(truth.e);
        closer.truths[0].b.extend(truth.b);
        Ok(errors)
    }
}

/// The value that a table is judged by.
fn judged(decode: Decode) -> Judged {
    if decode.has_bias() { Judged::Either } else { Judged::E }
}

/// The worst point of each cell of a table that has any: its error, and which of all points it is.
#[derive(Default)]
struct Cells {
    worst: HashMap<[u64; AXES], (f64, usize)>,
    points: usize,
}

impl Cells {
    /// More points and their errors.
    fn add(&mut self, lookup: &Lookup, points: &[Point], errors: &[f64]) {
        for (point, error) in points.iter().zip(errors) {
            let found = (error.abs(), self.points);
            let cell = self.worst.entry(lookup.position(point).map(|x| x as u64)).or_insert(found);
            if found.0.total_cmp(&cell.0).is_gt() {
                *cell = found;
            }
            self.points += 1;
        }
    }

    /// Which points are the worst of their cells, the worst first, the first of equal ones.
    fn worst(&self, places: usize) -> Vec<usize> {
        let mut worst: Vec<_> = self.worst.values().copied().collect();
        worst.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        worst.into_iter().map(|(_, point)| point).take(places).collect()
    }
}

/// Points even in the coordinates of a table. Those of a region are even in its inputs: none of
/// them met the cells of glass next to ior = 1, where its largest error is.
pub(in crate::effects) fn even((axes, region): (&[Axis], &Region), n: u32) -> Vec<Point> {
    let (sobol, azimuths) = (Sobol::new([0xc2b2_ae35, 0x27d4_eb2f, 0x85eb_ca6b]), azimuths());
    let beyond = Sobol::new([0x9e37_79b1, 0x2545_f491, 3]).padded(0x51ed_270b);
    let point = |k: u32| {
        let size = |axis: usize| axes.get(axis).map_or(1.0, |axis: &Axis| axis.size as f64);
        let at =
            |axis: usize| if axis < 3 { sobol.coordinate(k, axis) } else { beyond.coordinate(k, axis - 3) };
        let position = std::array::from_fn(|axis| at(axis) * (size(axis) - 1.0));
        let cos2_phi = azimuths.coordinate(k, 0) as f32;
        within(axes, region, position, Point { cos2_phi, ..region.in_common() })
    };
    (0..n).map(point).collect()
}

/// `n` points in a box about a point, so many cells of the table wide.
fn about(
    (axes, region): (&[Axis], &Region),
    lookup: &Lookup,
    point: &Point,
    (n, width): (u32, f64),
) -> Vec<Point> {
    let (sobol, azimuths) = (Sobol::new([0x85eb_ca6b, 0xc2b2_ae35, 0x27d4_eb2f]), azimuths());
    let centre = lookup.position(point);
    let near = |k: u32| {
        let position =
            std::array::from_fn(|axis| centre[axis] + width * (sobol.coordinate(k, axis.min(2)) - 0.5));
        let turn = width * 0.2 * (azimuths.coordinate(k, 0) - 0.5);
        let cos2_phi = (f64::from(point.cos2_phi) + turn).clamp(0.0, 1.0) as f32;
        within(axes, region, position, Point { cos2_phi, ..*point })
    };
    (0..n).map(near).collect()
}

fn azimuths() -> Sobol {
    Sobol::new([0x1656_67b1, 1, 2]).padded(0x9e37_79b9)
}

/// The point of a region at a position, in texels from the centre of the first one along each axis;
/// what no axis has is that of `like`.
fn within(axes: &[Axis], region: &Region, position: [f64; AXES], like: Point) -> Point {
    let mut point = like;
    let clamped = |x: f64, [low, high]: [f64; 2]| x.clamp(low, high) as f32;
    // The warp of the slices uses alpha, that of mu both.
    for k in (1..axes.len()).chain([0]) {
        let axis = &axes[k];
        let Point { alpha, ior, anisotropy, cos2_phi, .. } = point;
        let [alpha, ior, anisotropy, cos2_phi] = [alpha, ior, anisotropy, cos2_phi].map(f64::from);
        let surface = Surface { alpha, ior, anisotropy, cos2_phi };
        let x = axis.at(position[k], surface);
        match (Variable::of(axis), region.slices) {
            (Some(Variable::Roughness), _) => point.roughness = clamped(x, region.roughness),
            (Some(Variable::Alpha), _) => {
                point.roughness = clamped(region.alpha_map.roughness(x), region.roughness);
            }
            (Some(Variable::Mu), _) => point.mu = clamped(x, region.mu),
            (Some(Variable::Ior), Some(slices)) => point.ior = clamped(x, slices.range),
            (Some(Variable::Anisotropy), Some(slices)) => {
                point.anisotropy = clamped(x, region.anisotropy.unwrap_or(slices.range));
            }
            (Some(Variable::Cos2Phi), _) => point.cos2_phi = clamped(x, [0.0, 1.0]),
            _ => {}
        }
        point.alpha = region.alpha_map.alpha_f32(point.roughness);
    }
    point
}
