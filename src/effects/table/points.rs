//! Points at which lookups of tables are measured: none that the texels were made from, but for the
//! corners.
//!
//! Those of a table with three axes come in groups of [`GROUP`] that share roughness and mu and
//! differ in the axis of the slices, so that a truth can share its work.

use super::{Point, Region, SliceAxis, Slices};
use crate::approximate::{self, layer_mu, lerp};
use crate::data::{Place, shortest};
use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_truth::points;

/// Points that share roughness and mu.
pub const GROUP: usize = 8;

/// Inputs as a shader has them, in f32.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LookupPoints {
    /// The points, group by group.
    pub all: Vec<Point>,
    /// Which are uniform in roughness, mu and the axis of the slices: RMS and mean are taken over
    /// them. The others crowd into the layer mu ~ alpha, onto the edges and about the critical
    /// angle, where the largest errors hide.
    pub uniform: Vec<bool>,
    /// The slice input, where there is one.
    slice: Option<SliceAxis>,
    /// Whether the azimuth is an input.
    pub azimuth: bool,
}

/// Groups walked along each edge of roughness and mu.
const EDGE: usize = 1 << 8;

impl LookupPoints {
    /// 2^log2 points uniform in the region, or with slices groups of them; half as many in the
    /// layer, as many about the critical angle of glass, and the edges.
    pub fn certification(region: &Region, log2: u32) -> LookupPoints {
        match region.slices {
            None => LookupPoints::isotropic(&approximate::certification(&region.flat(), log2)),
            Some(slices) => LookupPoints::grouped(region, slices, log2),
        }
    }

    fn grouped(region: &Region, slices: Slices, log2: u32) -> LookupPoints {
        let mut points = LookupPoints { slice: Some(slices.axis), ..LookupPoints::default() };
        let base = Sobol::new([0x9e37_79b9, 0x7f4a_7c15, 0x1656_67b1]);
        // a group's values lie one in each 1/GROUP of the span, in an order of their own
        let slice = Sobol::new([0x27d4_eb2f, 0x85eb_ca6b, 7]).padded(0x68e3_1da4);
        let spread = |group: u32| -> [f64; GROUP] {
            std::array::from_fn(|k| lerp(slices.range, slice.coordinate(group * GROUP as u32 + k as u32, 0)))
        };
        for i in 0..1_u32 << log2 {
            let (roughness, mu) =
                (lerp(region.roughness, base.coordinate(i, 0)), lerp(region.mu, base.coordinate(i, 1)));
            points.push(region, roughness, mu, spread(i));
        }
        let uniform = points.all.len();
        let layer = Sobol::new([0x2545_f491, 0x4f6c_dd1d, 0x94d0_49bb]);
        for i in 0..1_u32 << (log2 - 1) {
            let roughness = lerp(region.roughness, layer.coordinate(i, 0));
            let mu = layer_mu(region.mu, region.alpha_map.alpha(roughness), layer.coordinate(i, 1));
            points.push(region, roughness, mu, spread(i + (1 << log2)));
            if slices.axis == SliceAxis::Ior {
                let (roughness, ior) = (
                    lerp(region.roughness, layer.coordinate(i, 1)),
                    lerp(slices.range, layer.coordinate(i, 2)),
                );
                points.push_critical(region, slices.range, [roughness, ior], layer.coordinate(i, 0));
            }
        }
        for i in 0..=EDGE {
            let t = i as f64 / EDGE as f64;
            let mut ends = spread(i as u32);
            (ends[0], ends[GROUP - 1]) = (slices.range[0], slices.range[1]);
            for end in [0.0, 1.0] {
                let roughness = lerp(region.roughness, end);
                points.push(region, roughness, lerp(region.mu, t), ends);
                points.push(
                    region,
                    roughness,
                    layer_mu(region.mu, region.alpha_map.alpha(roughness), t),
                    ends,
                );
                points.push(region, lerp(region.roughness, t), lerp(region.mu, end), ends);
            }
        }
        points.uniform = (0..points.all.len()).map(|i| i < uniform).collect();
        points
    }

    /// The points of a list of roughness, mu and slices, every combination: roughness fastest, then
    /// mu.
    pub fn grid(region: &Region, roughness: &[f64], mu: &[f64], slice: f64) -> LookupPoints {
        let mut points =
            LookupPoints { slice: region.slices.map(|slices| slices.axis), ..LookupPoints::default() };
        for m in mu {
            for r in roughness {
                points.all.push(point(region, *r, *m, slice));
            }
        }
        points.uniform = vec![true; points.all.len()];
        points
    }

    /// Points as they are given, with what tells which are uniform.
    pub(in crate::effects) fn of(
        all: Vec<Point>,
        uniform: Vec<bool>,
        slice: SliceAxis,
        azimuth: bool,
    ) -> LookupPoints {
        LookupPoints { all, uniform, slice: Some(slice), azimuth }
    }

    /// The points of an isotropic lobe that only reflects.
    pub fn isotropic(set: &points::Points) -> LookupPoints {
        let [roughness, alpha, mu] = ["roughness", "alpha", "mu"]
            .map(|name| set.column_f32(name).unwrap_or_else(|| vec![f32::NAN; set.len()]));
        let point = |i: usize| Point {
            roughness: roughness[i],
            alpha: alpha[i],
            mu: mu[i],
            cos2_phi: 1.0,
            ior: 1.0,
            anisotropy: 0.0,
        };
        let uniform = (0..set.len()).map(|i| i < set.uniform).collect();
        LookupPoints { all: (0..set.len()).map(point).collect(), uniform, slice: None, azimuth: false }
    }

    /// Other points of the same inputs; none counts for RMS and mean.
    pub(super) fn more(&self, all: Vec<Point>) -> LookupPoints {
        LookupPoints { uniform: vec![false; all.len()], all, ..*self }
    }

    /// The columns alpha and mu.
    pub fn inputs(&self) -> points::Points {
        let column = |of: fn(&Point) -> f32| self.all.iter().map(|p| f64::from(of(p))).collect::<Vec<f64>>();
        points::Points::new([("alpha", column(|p| p.alpha)), ("mu", column(|p| p.mu))])
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Point `i` by input name, each in the shortest decimal that reads back to its f32.
    pub fn place(&self, i: usize) -> Place {
        let p = &self.all[i];
        let slice = self.slice.map(|slice| (slice.name(), slice.of(p)));
        let inputs = [("alpha", p.alpha), ("mu", p.mu), ("roughness", p.roughness)].into_iter().chain(slice);
        let mut place: Place = inputs.map(|(name, x)| (name.to_string(), shortest(x))).collect();
        if self.azimuth {
            if self.slice == Some(SliceAxis::Ior) {
                place.insert(SliceAxis::Anisotropy.name().into(), shortest(p.anisotropy));
            }
            let phi = ops::atan2f((1.0 - p.cos2_phi).sqrt(), p.cos2_phi.sqrt());
            place.insert("phi".into(), shortest(phi));
        }
        place
    }

    fn push(&mut self, region: &Region, roughness: f64, mu: f64, slice: [f64; GROUP]) {
        self.all.extend(slice.map(|x| point(region, roughness, mu, x)));
    }

    /// A group about the critical angle of an index of refraction: mu a few alpha beside its
    /// cosine, and indices beside it.
    fn push_critical(&mut self, region: &Region, iors: [f64; 2], [roughness, ior]: [f64; 2], t: f64) {
        let alpha = region.alpha_map.alpha(roughness);
        let cosine = |n: f64| ((1.0 - 1.0 / n) * (1.0 + 1.0 / n)).max(0.0).sqrt();
        let mu = (cosine(ior) + alpha * (8.0 * t - 4.0)).clamp(region.mu[0], region.mu[1]);
        let beside = |k: usize| {
            let c = (cosine(ior) + alpha * (k as f64 - 3.0)).clamp(0.0, 0.999);
            (1.0 / ((1.0 - c) * (1.0 + c)).sqrt()).clamp(iors[0], iors[1])
        };
        self.push(region, roughness, mu, std::array::from_fn(beside));
    }
}

fn point(region: &Region, roughness: f64, mu: f64, slice: f64) -> Point {
    let roughness = roughness as f32;
    let mut point =
        Point { roughness, alpha: region.alpha_map.alpha_f32(roughness), mu: mu as f32, ..Point::default() };
    if let Some(slices) = region.slices {
        *slices.axis.of_mut(&mut point) = slice as f32;
    }
    point
}
