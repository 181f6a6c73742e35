//! Fits beside their truth: a selection on one scale, then each with its formula.

use super::{averages, figures, selection, words};
use crate::report::{
    ApproximationFinding, AverageFinding, Block, Curves, Dot, Field, FitCurve, FitFinding, HeatMap,
    ReportError, Section, Series, Shade, Spread, Style, Worst, check, numbers,
};
use lobefit_figures::{Scale, frontier};

/// Fits that may share one chart of curves before colours repeat.
const TOGETHER: usize = 6;

/// Plotted size of a chart of which two stand side by side, and of one beside a map.
const TWO: (f64, f64) = (480.0, 220.0);
const BESIDE_MAP: (f64, f64) = (600.0, 220.0);

pub(crate) fn section(
    fits: &[FitFinding],
    averages: Option<&AverageFinding>,
    approximations: &[ApproximationFinding],
) -> Result<Option<Section>, ReportError> {
    if fits.is_empty() && averages.is_none() {
        return Ok(None);
    }
    let shown: Vec<Shown> = fits.iter().map(|f| Shown::of(f, approximations)).collect::<Result<_, _>>()?;
    let mut blocks = selection::shown(fits, averages, approximations);
    if !shown.is_empty() {
        blocks.push(overview(&shown)?);
        blocks.extend(together(&shown)?);
    }
    for s in &shown {
        blocks.extend(card(s)?);
    }
    blocks.extend(averages::blocks(averages, approximations)?);
    Ok(Some(Section::new(
        "fits",
        "Fits beside the truth",
        "A selection of the fits with their constants, certified after those were rounded to f32.",
        blocks,
    )))
}

/// A fit with the approximation that it names.
struct Shown<'a> {
    fit: &'a FitFinding,
    approximation: &'a ApproximationFinding,
    error: Field,
}

impl<'a> Shown<'a> {
    fn of(fit: &'a FitFinding, all: &'a [ApproximationFinding]) -> Result<Shown<'a>, ReportError> {
        let section = format!("fit {}", fit.name);
        let Some(approximation) = all.iter().find(|a| a.name == fit.name) else {
            return Err(check::domain(&section, "name", "is not among the approximations"));
        };
        fit.error.check(&section)?;
        check::filled(&section, "curves", fit.curves.len())?;
        for c in &fit.curves {
            let field = format!("curve at roughness {}", c.roughness);
            check::finite(&section, "curves: roughness", c.roughness)?;
            check::increasing(&section, &format!("{field}: mu"), &c.mu)?;
            check::size(&section, &format!("{field}: truth"), c.truth.len(), c.mu.len())?;
            check::size(&section, &format!("{field}: fit"), c.fit.len(), c.mu.len())?;
            check::values(&section, &format!("{field}: truth"), &c.truth)?;
            check::values(&section, &format!("{field}: fit"), &c.fit)?;
        }
        Ok(Shown { fit, approximation, error: words::labelled(&fit.error) })
    }

    /// The certificate's worst place where it names both inputs of the map, signed as the map's
    /// nearest node; else the map's own.
    fn worst(&self) -> Option<Worst> {
        let certificate = &self.approximation.certificate;
        let at = |name: &str| certificate.at.get(name).copied();
        match (at(&self.fit.error.x.name), at(&self.fit.error.y.name)) {
            (Some(x), Some(y)) => {
                let signed = certificate.max_abs.copysign(self.error.nearest(x, y));
                Some(Worst { x, y, text: numbers::brief_bound(signed, 3) })
            }
            _ => self.error.worst().map(|(x, y, v)| Worst { x, y, text: numbers::brief_bound(v, 3) }),
        }
    }

    fn map(&self, title: String, shade: Shade) -> HeatMap<'_> {
        HeatMap { title, shade, worst: self.worst(), ..HeatMap::of("", &self.error) }
    }
}

/// How many times the error of the most accurate fit the common scale reaches: farther, and good
/// fits are all white.
const REACH: f64 = 10.0;

/// Limit of the common scale: the largest error, or a round figure below it.
fn common_limit(shown: &[Shown]) -> (f64, bool) {
    let peaks = || shown.iter().map(|s| s.error.peak());
    let largest = numbers::round_up(peaks().fold(0.0, f64::max).max(1e-12), 2);
    let reach = numbers::rounded(REACH * peaks().filter(|&p| p > 0.0).fold(f64::INFINITY, f64::min), 1);
    if reach < largest { (reach, true) } else { (largest, false) }
}

/// Signed error of every shown fit on one scale.
fn overview(shown: &[Shown]) -> Result<Block, ReportError> {
    let (limit, clipped) = common_limit(shown);
    let shade = lobefit_figures::signed(limit);
    let maps: Vec<HeatMap> =
        shown.iter().map(|s| HeatMap { size: (152.0, 145.0), ..s.map(s.fit.name.clone(), shade) }).collect();
    let limit = numbers::tick(limit);
    let caption = format!(
        "Signed error over roughness and mu, every map on the same scale (±{limit}), which follows the square root of the \
         magnitude: blue too low, red too high, white exact.{} The ring marks the worst place of the certificate, the figure \
         its signed error, rounded away from zero.",
        if clipped {
            format!(
                " The scale ends at about {REACH} times the largest error of the most accurate fit, so that good fits can be \
                 told apart: the deepest colours mean ±{limit} or beyond."
            )
        } else {
            String::new()
        },
    );
    figures(&maps, &caption)
}

/// The fits on the frontier of operations and error, one chart per roughness that all of them
/// share.
fn together(shown: &[Shown]) -> Result<Option<Block>, ReportError> {
    let dots: Vec<Dot> = shown
        .iter()
        .map(|s| Dot {
            name: String::new(),
            x: f64::from(s.approximation.cost.ops),
            y: s.approximation.certificate.max_abs,
            published: s.approximation.published,
            table: false,
        })
        .collect();
    let mut best = frontier(&dots);
    // Where the frontier is long, its accurate end is the one that is hard to tell apart by figures
    // alone.
    let all = best.len();
    best.drain(..all.saturating_sub(TOGETHER));
    let first = best.first().map_or(&[][..], |&i| &shown[i].fit.curves);
    let charts: Vec<Curves> = first.iter().filter_map(|c| overlay(shown, &best, c)).collect();
    if best.len() < 2 || charts.is_empty() {
        return Ok(None);
    }
    let of_the = if best.len() < all {
        format!("the {} most accurate of the {all} fits of the frontier", best.len())
    } else {
        format!("the {all} fits of the frontier")
    };
    let caption = format!(
        "Truth (the heavy line) and {of_the}, those of ours that no other beats in both operations and largest error; \
         one chart per roughness, each with its own vertical scale. A colour that stays on the heavy line is a fit that \
         follows the truth.",
    );
    figures(&charts, &caption).map(Some)
}

/// One roughness; nothing unless every fit has a curve there.
fn overlay(shown: &[Shown], best: &[usize], curve: &FitCurve) -> Option<Curves> {
    let mut series = vec![line("truth", curve, &curve.truth, Style::Truth, None)];
    for (colour, &i) in best.iter().enumerate() {
        let fit = shown[i].fit;
        let same = fit.curves.iter().find(|c| c.roughness == curve.roughness)?;
        series.push(line(&fit.name, same, &same.fit, Style::Line(colour), None));
    }
    let title = format!("roughness {}", numbers::place(curve.roughness));
    Some(Curves::linear(title, [&words::axis("mu"), &shown[best[0]].fit.value], series, TWO))
}

/// One fit: figures, formula, curves, error map on its own scale.
fn card(s: &Shown) -> Result<Vec<Block>, ReportError> {
    let shade = lobefit_figures::signed(s.error.peak());
    let map = s.map(format!("{} error, own scale", s.fit.error.name), shade);
    let svg = [crate::report::Figure::svg(&curves(s.fit))?, crate::report::Figure::svg(&map)?];
    let caption = "Left: truth (heavy) under the fit (colour), each line labelled with its roughness r; a fit \
         beyond the scale of the truth runs along the frame. Right: where it errs.";
    Ok(vec![
        Block::Approximation { name: s.fit.name.clone() },
        Block::Facts { rows: facts(s) },
        Block::Code { text: s.fit.formula.clone() },
        Block::Figures { svg: svg.to_vec(), caption: caption.into() },
    ])
}

/// All roughnesses of a fit in one chart; limits from the truth, so that the truth stays readable
/// beside a wild fit.
fn curves(fit: &FitFinding) -> Curves {
    let mut series = Vec::new();
    for (i, c) in fit.curves.iter().enumerate() {
        let end = Some(format!("r {}", numbers::place(c.roughness)));
        series.push(line(if i == 0 { "truth" } else { "" }, c, &c.truth, Style::Truth, end));
    }
    for (i, c) in fit.curves.iter().enumerate() {
        series.push(line(if i == 0 { &fit.name } else { "" }, c, &c.fit, Style::Line(0), None));
    }
    let truths = fit.curves.iter().flat_map(|c| c.truth.iter().copied());
    let limits = Scale::around(Spread::Linear, truths);
    let title = format!("{}: {}", fit.name, fit.value);
    let chart = Curves::linear(title, [&words::axis("mu"), &fit.value], series, BESIDE_MAP);
    Curves { y_limits: Some((limits.min, limits.max)), ..chart }
}

fn line(name: &str, curve: &FitCurve, values: &[f64], style: Style, end: Option<String>) -> Series {
    let points = curve.mu.iter().copied().zip(values.iter().copied()).collect();
    Series { end, ..Series::line(name, points, style) }
}

fn facts(s: &Shown) -> Vec<(String, String)> {
    let a = s.approximation;
    let c = &a.certificate;
    vec![
        (
            "Error".into(),
            format!(
                "max {} at {}; RMS {}; mean {} ({})",
                words::max(c.max_abs),
                words::place(&c.at),
                words::mean(c.rms),
                words::mean(c.mean),
                a.used_as.metric,
            ),
        ),
        (
            "Measured".into(),
            format!(
                "{} points, {}, in {}",
                numbers::grouped(c.points),
                words::ranges(&c.domain),
                c.precision,
            ),
        ),
        ("Cost".into(), words::operations(a.cost.ops)),
        ("Norm".into(), a.norm.clone()),
        ("Source".into(), a.source.clone()),
        ("Selected".into(), s.fit.shown_as.clone()),
    ]
}
