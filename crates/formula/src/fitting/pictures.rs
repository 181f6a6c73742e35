//! Samples for the page's pictures: truth, fit and error over two inputs, the others fixed.

use super::{Certified, FittingError};
use lobefit::approximate::target::{Sampled, Span, Target};
use lobefit::data::Use;
use lobefit::report::{Field, Ruler};

/// Side of a map, and of one where a truth is dear.
const SIDE: usize = 64;
const DEAR_SIDE: usize = 20;

/// Roughness of the curves.
const CURVES: [f64; 5] = [0.1, 0.3, 0.5, 0.75, 1.0];

/// Fewest of them that a range must hold; a narrower range is divided evenly instead.
const FEWEST: usize = 3;

/// Places marked on a map, the worst included.
const MARKS: usize = 6;

/// Truth and fit where all inputs but two are fixed.
pub(super) struct FitSlice {
    /// The inputs that are fixed: `f0 = 0.5`; empty where there is none.
    pub at: String,
    /// What truth and fit are: `N = 1/E`, `E`.
    pub value: String,
    /// The input along the curves.
    pub along: Ruler,
    /// Input that tells the curves apart; empty for one curve.
    pub family: String,
    /// The curves.
    pub curves: Vec<SliceCurve>,
    /// Signed error of the use over both inputs; none where there is one.
    pub error: Option<Field>,
    /// The largest errors of the map: x, y, signed value; the first is marked with its value.
    pub worst: Vec<(f64, f64, f64)>,
}

/// Truth and fit along one input.
pub(super) struct SliceCurve {
    /// Value of the input that tells the curves apart.
    pub of: f64,
    /// Truth.
    pub truth: Vec<f64>,
    /// Fit.
    pub fit: Vec<f64>,
    /// Signed error of the use.
    pub error: Vec<f64>,
}

/// Which axes of the target a picture shows.
struct View {
    along: usize,
    family: Option<usize>,
    /// Axes that are fixed, one value each for every picture.
    fixed: Vec<Vec<f64>>,
    /// f0 of every picture, where it is an input.
    f0: Vec<f64>,
}

/// The pictures of a fit; none where no axis has a range.
pub(super) fn slices(fit: &Certified, target: &Target) -> Result<Vec<FitSlice>, FittingError> {
    let Some(view) = View::of(target) else { return Ok(Vec::new()) };
    let mut slices = Vec::new();
    for base in &view.fixed {
        for f0 in &view.f0 {
            slices.push(view.slice(fit, target, base, *f0)?);
        }
    }
    Ok(slices)
}

impl View {
    fn of(target: &Target) -> Option<View> {
        let spanned: Vec<usize> = (0..target.axes.len()).filter(|k| target.axes[*k].is_spanned()).collect();
        let named = |name: &str| spanned.iter().copied().find(|k| target.axes[*k].name == name);
        let along = named("mu").or(spanned.first().copied())?;
        let others = || spanned.iter().copied().filter(|k| *k != along);
        let family = named("roughness").filter(|k| *k != along).or(others().next());
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        let mut fixed = vec![target.axes.iter().map(|axis| middle(axis.range)).collect::<Vec<f64>>()];
        // A third input at its ends and in its middle; further ones in their middle.
        if let Some(third) = others().find(|k| Some(*k) != family) {
            let [low, high] = target.axes[third].range;
            let at = |x: f64| {
                let mut base = fixed[0].clone();
                base[third] = x;
                base
            };
            fixed = [low, middle([low, high]), high].map(at).to_vec();
        }
        let f0 = match &target.f0 {
            None => vec![1.0],
            Some(span) if !span.is_spanned() => vec![span.range[0]],
            Some(span) if target.affine => span.range.to_vec(),
            Some(span) => vec![span.range[0], middle(span.range), span.range[1]],
        };
        Some(View { along, family, fixed, f0 })
    }

    fn slice(
        &self,
        fit: &Certified,
        target: &Target,
        base: &[f64],
        f0: f64,
    ) -> Result<FitSlice, FittingError> {
        let side = if target.is_dear() { DEAR_SIDE } else { SIDE };
        let along = ruler(&target.axes[self.along], side);
        let of: Vec<f64> = self.family.map_or(vec![0.0], |k| chosen(&target.axes[k]));
        let mut curves = Vec::new();
        for x in of {
            let places = self.places(base, &[x], &along.values);
            let (sampled, values, error) = evaluated(fit, target, &places, f0)?;
            curves.push(SliceCurve { of: x, truth: sampled.ideal(), fit: values, error });
        }
        let family = self.family.map(|k| &target.axes[k]);
        let at = self.fixed_inputs(target, base, f0);
        let mut slice = FitSlice {
            at: at.iter().map(|(name, x)| format!("{name} = {x}")).collect::<Vec<_>>().join(", "),
            value: value(target),
            along: along.clone(),
            family: family.map_or(String::new(), |axis| axis.name.clone()),
            curves,
            error: None,
            worst: Vec::new(),
        };
        let Some(family) = family else { return Ok(slice) };
        let x = Ruler::even(&family.name, family.range[0], family.range[1], side);
        let (_, _, error) = evaluated(fit, target, &self.places(base, &x.values, &along.values), f0)?;
        let values = error.into_iter().map(|v| v as f32).collect();
        let name = error_name(target.used_as);
        let field = Field { name, unit: String::new(), signed: true, x, y: along, values };
        slice.worst = worst(&field, fit, &at);
        slice.error = Some(field);
        Ok(slice)
    }

    /// Places row by row: the family's values along columns.
    fn places(&self, base: &[f64], family: &[f64], along: &[f64]) -> Vec<Vec<f64>> {
        let place = |y: f64, x: f64| {
            let mut place = base.to_vec();
            place[self.along] = y;
            self.family.into_iter().for_each(|k| place[k] = x);
            place
        };
        along.iter().flat_map(|y| family.iter().map(move |x| (*y, *x))).map(|(y, x)| place(y, x)).collect()
    }

    /// The inputs that a picture fixes and that have a range.
    fn fixed_inputs(&self, target: &Target, base: &[f64], f0: f64) -> Vec<(String, f64)> {
        let shown = |k: usize| k == self.along || Some(k) == self.family;
        let axes = target.axes.iter().enumerate().filter(|(k, axis)| !shown(*k) && axis.is_spanned());
        let axes = axes.map(|(k, axis)| (axis.name.clone(), base[k]));
        axes.chain(target.f0.iter().map(|span| (span.name.clone(), f0))).collect()
    }
}

/// Truth, the formula's values in f32, and the signed errors of the use.
fn evaluated(
    fit: &Certified,
    target: &Target,
    places: &[Vec<f64>],
    f0: f64,
) -> Result<(Sampled, Vec<f64>, Vec<f64>), FittingError> {
    let sampled = target.at(places, &[f0])?;
    let inputs = sampled.inputs(fit.hypothesis.name(), fit.hypothesis.inputs())?;
    let values = fit.hypothesis.tape().evaluate(&inputs, &fit.coefficients)?;
    let values: Vec<f64> = values.into_iter().map(f64::from).collect();
    let residual = |i: usize| sampled.scale[i] * values[i] - sampled.target[i];
    let error = (0..values.len()).map(residual).collect();
    Ok((sampled, values, error))
}

/// Even steps; of mu, quadratically denser towards grazing.
fn ruler(axis: &Span, n: usize) -> Ruler {
    let [low, high] = axis.range;
    if axis.name != "mu" {
        return Ruler::even(&axis.name, low, high, n);
    }
    let at = |i: usize| {
        let t = i as f64 / (n - 1) as f64;
        low + (high - low) * t * t
    };
    Ruler { name: axis.name.clone(), values: (0..n).map(at).collect() }
}

/// The wanted values that lie in the range, or an even division of a range that holds too few.
fn chosen(axis: &Span) -> Vec<f64> {
    let [low, high] = axis.range;
    let inside: Vec<f64> = CURVES.into_iter().filter(|r| (low..=high).contains(r)).collect();
    if inside.len() < FEWEST { Ruler::even(&axis.name, low, high, CURVES.len()).values } else { inside }
}

/// What the curves show.
fn value(target: &Target) -> String {
    match target.used_as {
        Use::NORMALISATION => format!("N = 1/{}", target.column),
        Use::F0_BLEND => "f0 A + B".into(),
        _ => target.column.into(),
    }
}

fn error_name(used_as: Use) -> String {
    if used_as == Use::NORMALISATION { "furnace error E N - 1".into() } else { "error".into() }
}

/// The places where the error is larger than all around, the worst first. The certificate's worst
/// place takes the first rank where it lies in this picture.
fn worst(field: &Field, fit: &Certified, at: &[(String, f64)]) -> Vec<(f64, f64, f64)> {
    let (columns, rows) = (field.x.values.len(), field.y.values.len());
    let value = |i: usize, j: usize| f64::from(field.values[j * columns + i]);
    let mut peaks: Vec<(usize, usize)> = (0..rows)
        .flat_map(|j| (0..columns).map(move |i| (i, j)))
        .filter(|&(i, j)| {
            let around = |range: usize, k: usize| k.saturating_sub(1)..(k + 2).min(range);
            let mut cells = around(rows, j).flat_map(|q| around(columns, i).map(move |p| (p, q)));
            value(i, j) != 0.0 && cells.all(|(p, q)| value(p, q).abs() <= value(i, j).abs())
        })
        .collect();
    peaks.sort_by(|a, b| value(b.0, b.1).abs().total_cmp(&value(a.0, a.1).abs()));
    let mut worst: Vec<(f64, f64, f64)> =
        peaks.into_iter().map(|(i, j)| (field.x.values[i], field.y.values[j], value(i, j))).collect();
    let certificate = &fit.approximation.certificate;
    let place = |name: &str| certificate.at.get(name).copied();
    let here = at.iter().all(|(name, x)| place(name).is_some_and(|p| (p - x).abs() < 1e-6));
    if let (true, Some(x), Some(y)) = (here, place(&field.x.name), place(&field.y.name)) {
        let [left, right] = [field.x.values[0], field.x.values[columns - 1]];
        let near = |p: &(f64, f64, f64)| (p.0 - x).abs() < 0.05 * (right - left) && (p.1 - y).abs() < 0.05;
        let sign = worst.iter().find(|p| near(p)).or(worst.first()).map_or(1.0, |p| p.2);
        worst.retain(|p| !near(p));
        worst.insert(0, (x, y, certificate.max_abs.copysign(sign)));
    }
    worst.truncate(MARKS);
    worst
}
