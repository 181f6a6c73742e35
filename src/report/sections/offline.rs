//! What accuracy costs offline: error against evaluations and against seconds, of every way.

use super::{figures, words};
use crate::report::numbers::{grouped, significant};
use crate::report::{
    Annotation, Block, Curves, OfflineRecord, OfflineStudy, ReportError, Section, Series, Spread, Style,
    TextTable, folded,
};
use lobefit_truth::accuracy::{Curve, Tables, WALKED_TO, Walk};

/// The error at which seconds of ways are compared.
const COMPARED_AT: f64 = 1e-4;

/// What a chart is drawn against: a name, the axis, and the work of a curve.
type Work = (&'static str, &'static str, fn(&Curve) -> Vec<f64>);

const WORKS: [Work; 2] = [
    ("evaluations", "evaluations of the integrand", |c| c.evaluations.iter().map(|n| *n as f64).collect()),
    ("seconds", "seconds on one thread", |c| c.seconds.clone()),
];

/// Colours of what is drawn, each with the sequences that its chart shows: the table has all.
const DRAWN: [(&str, &[&str]); 5] = [
    ("uniform", &["random"]),
    ("cosine", &["random"]),
    ("ndf", &["random", "sobol"]),
    ("visible", &["random", "stratified", "sobol"]),
    ("own", &["random", "stratified", "sobol"]),
];

/// Colours, after which lines are dashed, and after as many more dotted.
const COLOURS: usize = 7;

/// Colours of quadratures.
const RULES: [usize; 3] = [4, 6, 4 + COLOURS];

pub(super) fn section(record: &OfflineRecord) -> Result<Option<Section>, ReportError> {
    let quantities: Vec<&[OfflineStudy]> = record.studies.chunk_by(|a, b| a.quantity == b.quantity).collect();
    let Some((first, others)) = quantities.split_first() else { return Ok(None) };
    let mut blocks = of(first)?;
    blocks.extend(walks(&record.studies));
    let tables =
        quantities.iter().filter_map(|studies| Some(lookups(&studies[0], studies[0].tables.as_ref()?)));
    blocks.push(folded("Tables", tables.map(Block::Table).collect()));
    for studies in others {
        blocks.push(folded(&studies[0].quantity, of(studies)?));
    }
    Ok(Some(Section::new(
        "offline",
        "What accuracy costs offline",
        format!(
            "Every way to compute a quantity, at an easy and at a hard point: its error against its evaluations of the integrand and \
             against seconds on {}. A dashed line is of scrambled Sobol points and a dotted one of \
             stratified ones, in the colour that the same draw has by random points; or a dashed one of the truth at falling tolerances.",
            record.device
        ),
        blocks,
    )))
}

/// Charts and table of a quantity.
fn of(studies: &[OfflineStudy]) -> Result<Vec<Block>, ReportError> {
    let caption = "Error of samples: root mean square over 16 seeds of the difference to the truth; of a quadrature the difference. \
                   Neither is drawn below the truth's own bound. The grey guides fall as random points (−1/2) and as −1. Rings: \
                   the path tracer's 10 million samples, their noise and what an f32 running sum adds to it.";
    let mut parts = Vec::new();
    for work in WORKS {
        let charts: Vec<Curves> = studies.iter().enumerate().filter_map(|(i, s)| chart(i, s, work)).collect();
        if !charts.is_empty() {
            parts.push((work.0.to_string(), vec![figures(&charts, caption)?]));
        }
    }
    let name = format!("offline-{}", studies[0].quantity);
    Ok(vec![Block::Switch { name, of: parts }, Block::Table(orders(studies))])
}

/// A line's name and style; none where the chart leaves it to the table.
fn style(curve: &Curve, rules: &mut impl Iterator<Item = usize>) -> Option<(String, Style)> {
    let Some(sequence) = &curve.sequence else {
        return Some((curve.way.clone(), Style::Marked(rules.next()?)));
    };
    let colour = DRAWN.iter().position(|(way, _)| *way == curve.way)?;
    let dash = DRAWN[colour].1.contains(&sequence.as_str()).then_some(sequence.as_str())?;
    let line = match dash {
        "random" => colour % 4,
        "sobol" => colour % 4 + COLOURS,
        _ => colour % 4 + 2 * COLOURS,
    };
    Some((format!("{}, {sequence}", curve.way), Style::Marked(line)))
}

fn chart(i: usize, study: &OfflineStudy, (name, axis, work): Work) -> Option<Curves> {
    let mut rules = RULES.into_iter();
    let series = study.curves.iter().filter_map(|curve| {
        let (name, style) = style(curve, &mut rules)?;
        let points: Vec<(f64, f64)> = work(curve).into_iter().zip(curve.error.iter().copied()).collect();
        (!points.is_empty()).then_some(Series::line(name, points, style))
    });
    let series: Vec<Series> = series.collect();
    let marks = study.path_tracer.iter().flat_map(|of| {
        let x = if name == "seconds" { of.seconds } else { of.samples as f64 };
        [(of.noise, "path tracer"), (of.bias, "its f32 sum")].map(|(y, text)| Annotation {
            x,
            y,
            text: text.into(),
        })
    });
    let title = format!("{}: {} at {}", ["easy", "hard"][i % 2], study.output, study.at);
    let axes = [(axis, Spread::Log), ("absolute error", Spread::Log)];
    (!series.is_empty()).then(|| Curves {
        annotations: marks.filter(|mark| mark.y > 0.0).collect(),
        guides: guides(),
        ..Curves::new(title, axes, series, (440.0, 300.0))
    })
}

/// The two rates that ways are compared with.
pub(super) fn guides() -> Vec<(f64, String)> {
    vec![(-0.5, "slope −1/2".into()), (-1.0, "slope −1".into())]
}

/// Order, and seconds to an error, of every way at each point.
fn orders(studies: &[OfflineStudy]) -> TextTable {
    let cells = |study: &OfflineStudy, i: usize| {
        let curve = &study.curves[i];
        let order = curve.order(2.0 * study.bound).map_or_else(|| "–".into(), |p| significant(p, 2));
        [order, seconds(curve)]
    };
    let row = |(i, curve): (usize, &Curve)| {
        let mut row = vec![curve.way.clone(), curve.sequence.clone().unwrap_or_default()];
        let same = |study: &&OfflineStudy| study.curves.get(i).is_some_and(|c| c.way == curve.way);
        row.extend(studies.iter().filter(same).flat_map(|study| cells(study, i)));
        row.resize(6, "–".into());
        row
    };
    let columns = "way|points|easy: order>|seconds to 1e-4>|hard: order>|seconds to 1e-4>";
    let caption = "Order p, fitted by least squares: the error falls like 1/nᵖ in n evaluations. ~: beyond what was measured, by the order. \
                   A dash: at the truth's own bound from the first or second setting on, or not counted; of seconds, beyond a thousand times \
                   the longest run.";
    words::table(columns, studies[0].curves.iter().enumerate().map(row).collect(), caption)
}

/// Seconds of a curve to [`COMPARED_AT`].
fn seconds(curve: &Curve) -> String {
    match curve.seconds_to(COMPARED_AT) {
        Some((seconds, false)) => significant(seconds, 2),
        Some((seconds, true)) => format!("~{}", significant(seconds, 2)),
        None => "–".into(),
    }
}

/// Random walks beside samples and quadrature.
fn walks(studies: &[OfflineStudy]) -> Option<Block> {
    let row = |(study, walk): (&OfflineStudy, Walk)| {
        let [path, sample] = walk.nanoseconds;
        let [walked, drawn, quadrature] = walk.seconds;
        let of = format!("{} of {}, {}", study.output, study.quantity, study.at);
        let times = [path, sample, path / sample, walked, drawn, walked / drawn, quadrature];
        [of].into_iter().chain(times.map(|x| significant(x, 2))).collect()
    };
    let rows: Vec<_> = studies.iter().filter_map(|s| Some(row((s, s.walk?)))).collect();
    let columns = "what|ns a path>|ns a sample>|ratio>|walk, s>|samples, s>|ratio>|quadrature, s>";
    let caption = format!(
        "A random walk over facets beside visible normals by Sobol points, as second opinions are drawn, and beside the truth by quadrature: time of one, and seconds to a \
         standard error of {WALKED_TO}. Published renderings have the walk 7 to 15 times slower (Turquin 2019)."
    );
    (!rows.is_empty()).then(|| Block::Table(words::table(columns, rows, &caption)))
}

fn lookups(study: &OfflineStudy, tables: &Tables) -> TextTable {
    let row = |i: usize| {
        let side = tables.sides[i];
        let numbers = [tables.error[i], tables.direct[i], tables.shared[i]].map(|x| significant(x, 2));
        [format!("{side} × {side}"), grouped(4 * (side * side) as u64)].into_iter().chain(numbers).collect()
    };
    let columns =
        "texels|bytes>|largest error of the bilinear lookup>|seconds, each by itself>|seconds, together>";
    let caption = format!(
        "{} of {} over {}, plain f32 texels even in roughness and in the cosine; other inputs as at the easy point.",
        study.output,
        study.quantity,
        tables.axes.join(" and ")
    );
    words::table(columns, (0..tables.sides.len()).map(row).collect(), &caption)
}
