//! The page of a formula that the user fits.

use super::{FitCard, FitPage, FitSlice};
use lobefit::data::Certificate;
use lobefit::report::numbers::{brief, brief_bound, grouped, place, significant};
use lobefit::report::{
    Block, Curves, Field, Figure, HeatMap, Page, ReportError, Scale, Section, Series, Spread, Style,
    TextTable, Worst, check, signed, words,
};

/// The page: what was asked, then each fit.
pub(super) fn page(findings: &FitPage) -> Result<Page, ReportError> {
    let mut sections = vec![asked(findings)];
    for fit in &findings.fits {
        sections.push(errors(findings, fit)?);
        sections.push(pictures(findings, fit)?);
        sections.push(solver(fit));
        sections.push(code(fit));
    }
    Ok(Page {
        title: format!("lobefit fit: {}", findings.name),
        origin: findings.origin.clone(),
        lead: format!(
            "A formula fitted to a quantity: its constants, its measured error and its cost, the fit beside the truth, and where \
             it errs. Figures in full digits: {}.json, beside this page.",
            findings.name
        ),
        sections,
    })
}

/// Anchor of a section of a fit: names are identifiers, anchors have hyphens.
fn anchor(fit: &FitCard, what: &str) -> String {
    format!("{}-{what}", fit.name.to_lowercase().replace('_', "-"))
}

fn asked(findings: &FitPage) -> Section {
    Section {
        id: "asked".into(),
        title: "What was asked".into(),
        lead: "The quantity, how the formula is used, and where it has to hold.".into(),
        blocks: vec![
            Block::Facts { rows: findings.asked.clone() },
            Block::Heading { text: "The hypothesis".into() },
            Block::Code { text: findings.hypothesis.trim_end().into() },
        ],
    }
}

fn errors(findings: &FitPage, fit: &FitCard) -> Result<Section, ReportError> {
    let section = format!("fit {}", fit.name);
    check::filled(&section, "certificates", fit.certificates.len())?;
    let constants = fit
        .coefficients
        .iter()
        .map(|(name, start, value)| vec![name.clone(), value.to_string(), start.to_string()]);
    let mut blocks = vec![
        Block::Table(certificates(findings, fit)),
        Block::Facts { rows: vec![("Cost".into(), words::operations(fit.ops))] },
    ];
    if !fit.coefficients.is_empty() {
        let columns = [("constant", false), ("fitted", true), ("started at", true)];
        let caption = "Constants in the shortest digits that read back to the same f32. The certificate holds for them as they \
                       stand here.";
        blocks.push(Block::Table(words::table(&columns, constants.collect(), caption)));
    }
    Ok(Section {
        id: anchor(fit, "error"),
        title: format!("{}: error and constants", fit.name),
        lead:
            "Measured after the constants were rounded to f32, at points that the formula was not fitted on."
                .into(),
        blocks,
    })
}

fn certificates(findings: &FitPage, fit: &FitCard) -> TextTable {
    let columns = [
        ("arithmetic", false),
        ("max", true),
        ("where", false),
        ("max relative", true),
        ("RMS", true),
        ("mean", true),
        ("points", true),
    ];
    let row = |c: &Certificate| {
        vec![
            c.precision.clone(),
            words::max(c.max_abs),
            words::place(&c.at),
            words::max(c.max_rel),
            words::mean(c.rms),
            words::mean(c.mean),
            grouped(c.points),
        ]
    };
    let caption = format!(
        "Judged by the {}. Maxima are rounded up; RMS and mean are over points uniform in the inputs. Inputs are rounded to \
         the arithmetic that is measured.",
        findings.used_as.metric
    );
    words::table(&columns, fit.certificates.iter().map(row).collect(), &caption)
}

fn pictures(findings: &FitPage, fit: &FitCard) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    for slice in &fit.slices {
        checked(fit, slice)?;
        if !slice.at.is_empty() {
            blocks.push(Block::Heading { text: slice.at.clone() });
        }
        blocks.push(of_slice(findings, fit, slice)?);
        blocks.extend(worst_places(slice).map(Block::Table));
    }
    Ok(Section {
        id: anchor(fit, "pictures"),
        title: format!("{} beside the truth", fit.name),
        lead: "The curves show the formula itself; the error is that of its use.".into(),
        blocks,
    })
}

fn checked(fit: &FitCard, slice: &FitSlice) -> Result<(), ReportError> {
    let section = format!("fit {}, slice {}", fit.name, slice.at);
    check::increasing(&section, &slice.along.name, &slice.along.values)?;
    check::filled(&section, "curves", slice.curves.len())?;
    for curve in &slice.curves {
        check::finite(&section, &slice.family, curve.of)?;
        for (field, values) in [("truth", &curve.truth), ("fit", &curve.fit), ("error", &curve.error)] {
            check::size(&section, field, values.len(), slice.along.values.len())?;
            check::values(&section, field, values)?;
        }
    }
    slice.error.as_ref().map_or(Ok(()), |field| field.check(&section))
}

/// Curves beside the map; beside the curves of the error where there is no map.
fn of_slice(findings: &FitPage, fit: &FitCard, slice: &FitSlice) -> Result<Block, ReportError> {
    let curves = Figure::svg(&curves(fit, slice))?;
    let metric = findings.used_as.metric;
    match &slice.error {
        Some(field) => {
            let map = Figure::svg(&map(&words::labelled(field), slice))?;
            let caption = format!(
                "Left: truth (heavy) under the fit (colour), one line for each {} that stands at its end. Right: the signed {metric}; blue is \
                 too low, red too high, white exact; colours follow the square root of the magnitude. The large ring marks the worst \
                 place with its error, the small ones the next.",
                words::symbol(&slice.family),
            );
            Ok(Block::Figures { svg: vec![curves, map], caption })
        }
        None => {
            let errors = Figure::svg(&error_curves(slice))?;
            let caption = format!("Left: truth (heavy) under the fit (colour). Right: the signed {metric}.");
            Ok(Block::Figures { svg: vec![curves, errors], caption })
        }
    }
}

fn curves(fit: &FitCard, slice: &FitSlice) -> Curves {
    let end = |of: f64| {
        (!slice.family.is_empty()).then(|| format!("{} {}", short_symbol(&slice.family), place(of)))
    };
    let mut series = Vec::new();
    for (i, c) in slice.curves.iter().enumerate() {
        series.push(line(if i == 0 { "truth" } else { "" }, slice, &c.truth, Style::Truth, end(c.of)));
    }
    for (i, c) in slice.curves.iter().enumerate() {
        series.push(line(if i == 0 { &fit.name } else { "" }, slice, &c.fit, Style::Line(0), None));
    }
    let (truth, fit) = (slice.curves.iter().map(|c| &c.truth), slice.curves.iter().map(|c| &c.fit));
    chart(slice, slice.value.clone(), series, Some(limits(truth.flatten(), fit.flatten())))
}

/// The frame of the truth, widened to just beyond the fit where that leaves it.
fn limits<'a>(
    truth: impl Iterator<Item = &'a f64> + Clone,
    fit: impl Iterator<Item = &'a f64>,
) -> (f64, f64) {
    let Scale { min, max, .. } = Scale::around(Spread::Linear, truth.copied());
    let (low, high) = fit.fold((min, max), |(low, high), v| (low.min(*v), high.max(*v)));
    let room = 0.02 * (high - low);
    (if low < min { low - room } else { min }, if high > max { high + room } else { max })
}

fn error_curves(slice: &FitSlice) -> Curves {
    let series = slice.curves.iter().map(|c| line("", slice, &c.error, Style::Line(0), None)).collect();
    chart(slice, "signed error".into(), series, None)
}

/// Roughness in short: the end of a line has little room.
fn short_symbol(name: &str) -> &str {
    if name == "roughness" { "r" } else { words::symbol(name) }
}

fn line(name: &str, slice: &FitSlice, values: &[f64], style: Style, end: Option<String>) -> Series {
    let points = slice.along.values.iter().copied().zip(values.iter().copied()).collect();
    Series { name: name.into(), points, style, end }
}

fn chart(slice: &FitSlice, value: String, series: Vec<Series>, y_limits: Option<(f64, f64)>) -> Curves {
    Curves {
        title: value.clone(),
        x: (words::axis(&slice.along.name), Spread::Linear),
        y: (value, Spread::Linear),
        series,
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits,
        size: (400.0, 250.0),
    }
}

fn map<'a>(field: &'a Field, slice: &FitSlice) -> HeatMap<'a> {
    let mut places = slice.worst.iter();
    let worst = places.next().map(|&(x, y, value)| Worst { x, y, text: brief_bound(value, 3) });
    HeatMap {
        title: format!("signed {}", field.name),
        shade: signed(field.peak().max(slice.worst.first().map_or(0.0, |w| w.2.abs()))),
        worst,
        marks: places.map(|&(x, y, _)| (x, y)).collect(),
        size: (270.0, 250.0),
        ..HeatMap::of("", field)
    }
}

fn worst_places(slice: &FitSlice) -> Option<TextTable> {
    let field = slice.error.as_ref()?;
    let columns =
        [(words::symbol(&field.x.name), true), (words::symbol(&field.y.name), true), ("signed error", true)];
    let row = |&(x, y, value): &(f64, f64, f64)| vec![brief(x, 3), brief(y, 3), significant(value, 3)];
    let rows = slice.worst.iter().map(row).collect();
    Some(words::table(
        &columns,
        rows,
        "The worst places of the map, those that are marked: each the largest of its surroundings.",
    ))
}

fn solver(fit: &FitCard) -> Section {
    let columns = [("stage", false), ("ended as", false), ("max", true), ("RMS", true)];
    let rows = fit.stages.iter().map(|stage| stage.to_vec()).collect();
    let caption = "The stages of the search that led to these constants, with the residuals over the samples (which are weighted, \
                   where a weight was given).";
    let mut blocks = vec![Block::Facts { rows: fit.facts.clone() }];
    if !fit.stages.is_empty() {
        blocks.push(Block::Table(words::table(&columns, rows, caption)));
    }
    Section {
        id: anchor(fit, "search"),
        title: format!("{}: what the solver did", fit.name),
        lead:
            "How the search ended, how far from the best possible the constants can be, and what is proven."
                .into(),
        blocks,
    }
}

fn code(fit: &FitCard) -> Section {
    let blocks = fit.code.iter().flat_map(|(language, text)| {
        [Block::Heading { text: language.clone() }, Block::Code { text: text.trim_end().into() }]
    });
    Section {
        id: anchor(fit, "code"),
        title: format!("{}: the code", fit.name),
        lead: "As written to the files beside this page.".into(),
        blocks: blocks.collect(),
    }
}
