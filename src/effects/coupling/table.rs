//! The factor by a table of (A, B) as engines hold it, beside the formulas.

use std::collections::BTreeMap;

use super::bake::Lobe;
use crate::approximate::{self, FitStageError, Region, certification};
use crate::data::{
    Approximation, Certificate, Cost, Decode, Form, Layout, Serves, Source, Table, TexelFormat, lookup_ops,
};
use crate::effects::Albedo;
use crate::effects::BakeError;
use crate::effects::Deviation;
use crate::effects::context::Context;
use crate::effects::coupling::CouplingSpec;
use crate::effects::coupling::emitted::exact_ops;
use crate::effects::coupling::results::AnyF0Finding;
use crate::effects::reflection::{GGX, sampled};
use crate::effects::table::{Lookup, LookupError, LookupPoints, Spec};
use crate::report::ApproximationFinding;
use lobefit_shade::round_up;
use lobefit_truth::integrate::Estimate;
use lobefit_truth::points;
use lobefit_truth::quantity::COUPLING;
use lobefit_truth::quantity::coupling::{Split, factor};

/// Texels along mu and along roughness, and what two channels of f16 take.
const SIDE: usize = 64;
const BYTES: u64 = 4 * (SIDE * SIDE) as u64;

/// Binary logarithm of the points that it is measured at: a table's error is smooth, and this is a
/// comparison.
const LOG2: u32 = 14;

/// Values of f0 of the error over all; the error is a parabola in it.
const ANY: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The exact factor from a lookup of E and B, measured over the lobe's domain and over all f0.
pub fn of_published(
    lobe: &Lobe,
    context: &Context,
) -> Result<(ApproximationFinding, AnyF0Finding), BakeError> {
    let CouplingSpec { specular, smith, region, f0, .. } = &lobe.spec;
    let spec = Spec {
        names: vec![format!("coupling_table_{SIDE}x{SIDE}")],
        smith: *smith,
        size: vec![SIDE; 2],
        format: TexelFormat::F16,
        layout: Layout::Plain,
        serves: Serves::SplitSum,
        region: (*region).into(),
    };
    let [table] = <[Table; 1]>::try_from(sampled(&GGX, &spec, &context.memo)?)
        .map_err(|tables| BakeError::Internal(format!("{} tables of one name", tables.len())))?;
    let quantised = table.quantised();
    let measured = Measured::new(lobe, &quantised, context)?;
    let here = measured.over(&[f0[0], f0[1]]);
    let any = measured.over(&ANY);
    let ops = lookup_ops(&table.axes, Decode::of(spec.layout, spec.serves))
        .and_then(|ops| Ok(ops + exact_ops(*specular)?))
        .map_err(FitStageError::from)?;
    let approximation = Approximation {
        name: table.name.clone(),
        quantity: "diffuse-coupling".into(),
        column: "factor".into(),
        used_as: COUPLING,
        smith: Some(*smith),
        side: None,
        source: Source::Published(
            "1 - E from table: the exact factor of (A, B) at texel centres, f16".into(),
        ),
        certificate: Certificate {
            max_abs: round_up(here.max, 4),
            max_rel: round_up(here.max_rel, 4),
            rms: here.rms,
            mean: here.mean,
            at: here.at,
            domain: domain(region, *f0),
            precision: "f16 texels, f32 lookup".into(),
            points: 2 * measured.points.len() as u64,
        },
        cost: Cost { ops, fetches: 1, bytes: BYTES },
        form: Form::Table(table),
    };
    let finding = AnyF0Finding {
        name: approximation.name.clone(),
        max: round_up(any.max, 4),
        at: any.at,
        places: measured.points.len() as u64,
        looked_at: format!("{} values of f0", ANY.len()),
    };
    Ok((ApproximationFinding::from(&approximation), finding))
}

fn domain(region: &Region, f0: [f64; 2]) -> BTreeMap<String, [f64; 2]> {
    let ranges = [("alpha", region.alpha()), ("f0", f0), ("mu", region.mu), ("roughness", region.roughness)];
    ranges.into_iter().map(|(name, range)| (name.to_string(), range)).collect()
}

/// E and B of a table and the truth at points.
struct Measured<'a> {
    lobe: &'a Lobe,
    points: points::Points,
    truth: Albedo,
    found: Vec<(f64, f64)>,
}

impl Measured<'_> {
    fn new<'a>(lobe: &'a Lobe, table: &Table, context: &Context) -> Result<Measured<'a>, BakeError> {
        let points = certification(&lobe.spec.region, LOG2);
        let truth = Albedo::new(lobe.spec.smith, &points, true, &context.memo)?;
        let lookup = Lookup::new(table, Decode::SplitSum)?;
        let no_bias = || LookupError::NoBias { table: table.name.clone() };
        let at = |point: &_| {
            let values = lookup.at(point);
            Ok((f64::from(values.e), f64::from(values.b.ok_or_else(no_bias)?)))
        };
        let found =
            LookupPoints::isotropic(&points).all.iter().map(at).collect::<Result<_, LookupError>>()?;
        Ok(Measured { lobe, points, truth, found })
    }

    /// The factor's errors at all points for each f0 in turn.
    fn over(&self, f0: &[f64]) -> Deviation {
        let specular = self.lobe.spec.specular;
        let of = |e: f64, b: f64, f0: f64| {
            let with = |value| Estimate { value, error: 0.0 };
            factor(&Split { e: with(e), a: with(e - b), loss: with(1.0 - e) }, f0, specular).value
        };
        let (mut errors, mut truths) = (Vec::new(), Vec::new());
        for f0 in f0 {
            let pairs = self.found.iter().zip(self.truth.e.iter().zip(&self.truth.b));
            for ((e, b), (true_e, true_b)) in pairs {
                let truth = of(*true_e, *true_b, *f0);
                errors.push(of(*e, *b, *f0) - truth);
                truths.push(truth);
            }
        }
        let n = self.points.len();
        let place = |i: usize| {
            let mut place = approximate::place(&self.points, i % n);
            place.insert("f0".into(), f0[i / n]);
            place
        };
        Deviation::of(&errors, &truths, |i| i % n < self.points.uniform, place)
    }
}
