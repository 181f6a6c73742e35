//! Where tables are judged: points with their truths, and more of them where a lookup errs most.

use super::{
    BuildError, Family, Judged, Lookup, LookupPoints, Made, Point, Region, SliceAxis, Truth, error_map,
};
use crate::approximate::{Counter, lerp};
use crate::data::{Decode, Smith, Table};
use crate::effects::{Albedo, BakeError};
use lobefit_math::sobol::Sobol;

/// Places about which the largest error is searched: in the first round, and in the others.
const PLACES: [usize; 2] = [128, 64];

/// Points about each place in a round.
const NEAR: u32 = 64;

/// Rounds, each over half the width of the one before: the last spans a sixteenth of a texel's cell.
const ROUNDS: usize = 5;

/// Points with their truths, shared by the tables that are measured there.
#[derive(Clone, Debug)]
pub struct Judge {
    /// The points.
    pub points: LookupPoints,
    /// E, and B where a table needs it, of each side.
    pub truths: Vec<Albedo>,
    /// What they took.
    pub made: Made,
    smith: Smith,
    region: Region,
    /// Whether the truth tells more than E in the mean over the azimuth.
    finer: bool,
}

impl Judge {
    /// The points of a region with the truth of each side.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn new(
        family: &dyn Family,
        smith: Smith,
        region: Region,
        finer: bool,
        counter: &Counter,
    ) -> Result<Judge, BuildError> {
        let points = family.points(&region, finer)?;
        let (truths, made) = family.truths(smith, &points, finer, counter)?;
        Ok(Judge { points, truths, made, smith, region, finer })
    }

    /// The truth of side `i`.
    pub fn truth(&self, i: usize) -> Truth<'_> {
        let Albedo { e, b } = &self.truths[i];
        Truth { e, b: (!b.is_empty()).then_some(b) }
    }

    /// The judge of one table: about the places where its lookup of side `i` errs most, points are
    /// added until they close in on the largest errors. Points drawn over the whole region miss the
    /// peak of a cell: by 6 % of the largest error of a 32x32x4 table of glass.
    ///
    /// # Errors
    /// A truth that cannot be integrated; a table that cannot be looked up.
    pub fn closer(
        &self,
        family: &dyn Family,
        (table, decode): (&Table, Decode),
        i: usize,
        counter: &Counter,
    ) -> Result<Judge, BakeError> {
        let (mut closer, table) = (self.clone(), table.quantised());
        let lookup = Lookup::new(&table, decode)?;
        let judged = if decode.has_bias() { Judged::Either } else { Judged::E };
        let sizes: Vec<usize> = table.axes.iter().map(|axis| axis.size).collect();
        let errors = error_map(&lookup, judged, &self.points, self.truth(i))?;
        let mut worst = apart(&self.region, &sizes, &self.points.all, &errors);
        let mut width = 1.0;
        for _ in 0..ROUNDS {
            let near: Vec<Vec<Point>> =
                worst.iter().map(|(point, _)| about(&self.region, &sizes, point, width)).collect();
            width *= 0.5;
            let points = self.points.more(near.concat());
            let (truths, _) = family.truths(self.smith, &points, self.finer, counter)?;
            let Albedo { e, b } = &truths[i];
            let truth = Truth { e, b: (!b.is_empty()).then_some(b) };
            let errors = error_map(&lookup, judged, &points, truth)?;
            let found = points.all.iter().zip(errors);
            for (best, found) in worst.iter_mut().zip(found.collect::<Vec<_>>().chunks(NEAR as usize)) {
                for (point, error) in found {
                    if error.abs() > best.1 {
                        *best = (**point, error.abs());
                    }
                }
            }
            closer.add(points, truths);
            worst.sort_by(|a, b| b.1.total_cmp(&a.1));
            worst.truncate(PLACES[1]);
        }
        Ok(closer)
    }

    fn add(&mut self, points: LookupPoints, truths: Vec<Albedo>) {
        self.points.all.extend(points.all);
        self.points.uniform.extend(points.uniform);
        for (side, more) in self.truths.iter_mut().zip(truths) {
            side.e.extend(more.e);
            side.b.extend(more.b);
        }
    }
}

/// The worst points of which no two lie in one cell of the table, with their errors.
fn apart(region: &Region, sizes: &[usize], points: &[Point], errors: &[f64]) -> Vec<(Point, f64)> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| errors[*b].abs().total_cmp(&errors[*a].abs()).then(a.cmp(b)));
    let cell = |point: &Point| {
        let place = place(region, point);
        [0, 1, 2].map(|k| (place[k] * cells(sizes, k)).floor() as i64)
    };
    let (mut worst, mut known) = (Vec::new(), Vec::new());
    for i in order {
        let at = cell(&points[i]);
        if !known.contains(&at) {
            known.push(at);
            worst.push((points[i], errors[i].abs()));
        }
        if worst.len() == PLACES[0] {
            break;
        }
    }
    worst
}

/// Steps from texel to texel along mu, roughness and the slices.
fn cells(sizes: &[usize], axis: usize) -> f64 {
    sizes.get(axis).map_or(1.0, |size| size.saturating_sub(1).max(1) as f64)
}

/// sqrt(mu), roughness and the slice of a point in [0, 1], each over its range. The root is about what
/// the coordinates of tables make of mu.
fn place(region: &Region, point: &Point) -> [f64; 3] {
    let within = |[low, high]: [f64; 2], x: f64| if high > low { (x - low) / (high - low) } else { 0.0 };
    let slice = region.slices.map_or(0.0, |s| within(s.range, f64::from(s.axis.of(point))));
    let mu = within(region.mu.map(f64::sqrt), f64::from(point.mu).max(0.0).sqrt());
    [mu, within(region.roughness, f64::from(point.roughness)), slice]
}

/// Points in a box about a point, so many cells of the table wide.
fn about(region: &Region, sizes: &[usize], point: &Point, width: f64) -> Vec<Point> {
    let sobol = Sobol::new([0x85eb_ca6b, 0xc2b2_ae35, 0x27d4_eb2f]);
    let azimuths = Sobol::new([0x1656_67b1, 1, 2]).padded(0x9e37_79b9);
    let centre = place(region, point);
    let near = |k: u32| {
        let at: [f64; 3] = std::array::from_fn(|axis| {
            let step = width * (sobol.coordinate(k, axis) - 0.5) / cells(sizes, axis);
            (centre[axis] + step).clamp(0.0, 1.0)
        });
        let mu = lerp(region.mu.map(f64::sqrt), at[0]);
        let roughness = lerp(region.roughness, at[1]) as f32;
        let turn = width * 0.2 * (azimuths.coordinate(k, 0) - 0.5);
        let mut near = Point {
            roughness,
            alpha: region.alpha_map.alpha_f32(roughness),
            mu: (mu * mu).clamp(region.mu[0], region.mu[1]) as f32,
            cos2_phi: (f64::from(point.cos2_phi) + turn).clamp(0.0, 1.0) as f32,
            ..*point
        };
        match region.slices.map(|slices| (slices.axis, lerp(slices.range, at[2]) as f32)) {
            Some((SliceAxis::Anisotropy, slice)) => near.anisotropy = slice,
            Some((SliceAxis::Ior, slice)) => near.ior = slice,
            None => {}
        }
        near
    };
    (0..NEAR).map(near).collect()
}
