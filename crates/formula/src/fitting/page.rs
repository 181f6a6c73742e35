//! The page of a formula that the user fits.

use super::document::{code_file, of_target, origin, recipe};
use super::pictures::{FitSlice, slices};
use super::{Certified, Demand, Fitting, FittingError, Job, Proof, catalogue, printed};
use lobefit::data::{Certificate, Use};
use lobefit::report::numbers::{brief, brief_bound, grouped, place, significant};
use lobefit::report::{
    Block, Curves, Field, Figure, HeatMap, Page, ReportError, Scale, Section, Series, Spread, Style,
    TextTable, Worst, check, signed, words,
};

/// The page: what was asked, then each fit.
///
/// # Errors
/// Data that is not finite, empty where it must not be, or of mismatched size, by section and
/// field; a formula that a language cannot print.
pub(super) fn page(job: &Job, fitting: &Fitting) -> Result<Page, FittingError> {
    let name = job.hypothesis.name();
    let used_as = fitting.target.used_as;
    let mut sections = vec![asked(job, fitting)];
    for fit in &fitting.fits {
        sections.push(errors(used_as, fit)?);
        sections.push(pictures(used_as, fit, &slices(fit, &fitting.target)?)?);
        sections.push(solver(job, fitting, fit));
        sections.push(code(job, fitting, fit)?);
    }
    Ok(Page::new(
        format!("lobefit fit: {name}"),
        origin(name, &job.command, recipe(job).hash),
        format!(
            "{}\nA formula fitted to a quantity: its constants, its measured error and its cost, the fit beside the truth, and where \
             it errs. Figures in full digits: {name}.json, beside this page.",
            conclusion(fitting)
        ),
        sections,
    ))
}

/// What each fit takes and keeps.
fn conclusion(fitting: &Fitting) -> String {
    let metric = fitting.target.used_as.metric;
    let of = |fit: &Certified| {
        let a = &fit.approximation;
        let (ops, max) = (words::operations(a.cost.ops), words::max(a.certificate.max_abs));
        format!("{}: {ops}, {metric} at most {max}.", a.name)
    };
    fitting.fits.iter().map(of).collect::<Vec<_>>().join(" ")
}

/// Anchor of a section of a fit: names are identifiers, anchors have hyphens.
fn anchor(fit: &Certified, what: &str) -> String {
    format!("{}-{what}", fit.approximation.name.to_lowercase().replace('_', "-"))
}

fn asked(job: &Job, fitting: &Fitting) -> Section {
    let mut rows = of_target(&fitting.target);
    let goals: Vec<String> = job.goals.iter().map(|goal| super::words::minimised(*goal)).collect();
    rows.push(("Minimised".into(), goals.join("; ")));
    rows.extend(job.weight.iter().map(|weight| ("Weight".to_string(), weight.clone())));
    let demands: Vec<String> = job.demands.iter().map(Demand::words).collect();
    if !demands.is_empty() {
        rows.push(("Constraints".into(), demands.join("; ")));
    }
    Section::new(
        "asked",
        "What was asked",
        "The quantity, how the formula is used, and where it has to hold.",
        vec![
            Block::Facts { rows },
            Block::Heading { text: "The hypothesis".into() },
            Block::Code { text: job.hypothesis.source().trim_end().into() },
        ],
    )
}

fn errors(used_as: Use, fit: &Certified) -> Result<Section, ReportError> {
    let name = &fit.approximation.name;
    let certificates: Vec<&Certificate> =
        fit.certificates.iter().filter_map(|(_, found)| found.as_ref().ok()).collect();
    check::filled(&format!("fit {name}"), "certificates", certificates.len())?;
    let constants = fit.hypothesis.parameters().iter().zip(&fit.coefficients);
    let constants = constants.map(|(p, value)| vec![p.name.clone(), value.to_string(), p.start.to_string()]);
    let mut blocks = vec![
        Block::Table(measured(used_as, &certificates)),
        Block::Facts { rows: vec![("Cost".into(), words::operations(fit.approximation.cost.ops))] },
    ];
    if !fit.coefficients.is_empty() {
        let columns = "constant|fitted>|started at>";
        let caption = "Constants in the shortest digits that read back to the same f32. The certificate holds for them as they \
                       stand here.";
        blocks.push(Block::Table(words::table(columns, constants.collect(), caption)));
    }
    Ok(Section::new(
        anchor(fit, "error"),
        format!("{name}: error and constants"),
        "Measured after the constants were rounded to f32, at points that the formula was not fitted on.",
        blocks,
    ))
}

fn measured(used_as: Use, certificates: &[&Certificate]) -> TextTable {
    let columns = "arithmetic|max>|where|max relative>|RMS>|mean>|points>";
    let row = |c: &&Certificate| {
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
        used_as.metric
    );
    words::table(columns, certificates.iter().map(row).collect(), &caption)
}

fn pictures(used_as: Use, fit: &Certified, slices: &[FitSlice]) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    let name = &fit.approximation.name;
    for slice in slices {
        checked(name, slice)?;
        if !slice.at.is_empty() {
            blocks.push(Block::Heading { text: slice.at.clone() });
        }
        blocks.push(of_slice(used_as, name, slice)?);
        blocks.extend(worst_places(slice).map(Block::Table));
    }
    Ok(Section::new(
        anchor(fit, "pictures"),
        format!("{name} beside the truth"),
        "The curves show the formula itself; the error is that of its use.",
        blocks,
    ))
}

fn checked(fit: &str, slice: &FitSlice) -> Result<(), ReportError> {
    let section = format!("fit {fit}, slice {}", slice.at);
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
fn of_slice(used_as: Use, fit: &str, slice: &FitSlice) -> Result<Block, ReportError> {
    let curves = Figure::svg(&curves(fit, slice))?;
    let metric = used_as.metric;
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

fn curves(fit: &str, slice: &FitSlice) -> Curves {
    let end = |of: f64| {
        (!slice.family.is_empty()).then(|| format!("{} {}", short_symbol(&slice.family), place(of)))
    };
    let mut series = Vec::new();
    for (i, c) in slice.curves.iter().enumerate() {
        series.push(line(if i == 0 { "truth" } else { "" }, slice, &c.truth, Style::Truth, end(c.of)));
    }
    for (i, c) in slice.curves.iter().enumerate() {
        series.push(line(if i == 0 { fit } else { "" }, slice, &c.fit, Style::Line(0), None));
    }
    let (truth, fit) = (slice.curves.iter().map(|c| &c.truth), slice.curves.iter().map(|c| &c.fit));
    chart(slice, &slice.value, series, Some(limits(truth.flatten(), fit.flatten())))
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
    chart(slice, "signed error", series, None)
}

/// Roughness in short: the end of a line has little room.
fn short_symbol(name: &str) -> &str {
    if name == "roughness" { "r" } else { words::symbol(name) }
}

fn line(name: &str, slice: &FitSlice, values: &[f64], style: Style, end: Option<String>) -> Series {
    let points = slice.along.values.iter().copied().zip(values.iter().copied()).collect();
    Series { end, ..Series::line(name, points, style) }
}

fn chart(slice: &FitSlice, value: &str, series: Vec<Series>, y_limits: Option<(f64, f64)>) -> Curves {
    let labels = [&words::axis(&slice.along.name), value];
    Curves { y_limits, ..Curves::linear(value, labels, series, (400.0, 250.0)) }
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
    let [x, y] = [&field.x.name, &field.y.name].map(|name| words::symbol(name));
    let columns = format!("{x}>|{y}>|signed error>");
    let row = |&(x, y, value): &(f64, f64, f64)| vec![brief(x, 3), brief(y, 3), significant(value, 3)];
    let rows = slice.worst.iter().map(row).collect();
    Some(words::table(
        &columns,
        rows,
        "The worst places of the map, those that are marked: each the largest of its surroundings.",
    ))
}

fn solver(job: &Job, fitting: &Fitting, fit: &Certified) -> Section {
    let columns = "stage|ended as|max>|RMS>";
    let constrained = !fit.fitted.constraints.is_empty();
    let rows = fit.fitted.stages.iter().map(|stage| super::words::stage(stage, constrained).to_vec());
    let caption = "The stages of the search that led to these constants, with the residuals over the samples (which are weighted, \
                   where a weight was given).";
    let mut blocks = vec![Block::Facts { rows: facts(job, fitting, fit) }];
    if !fit.fitted.stages.is_empty() {
        blocks.push(Block::Table(words::table(columns, rows.collect(), caption)));
    }
    Section::new(
        anchor(fit, "search"),
        format!("{}: what the solver did", fit.approximation.name),
        "How the search ended, how far from the best possible the constants can be, and what is proven.",
        blocks,
    )
}

fn facts(job: &Job, fitting: &Fitting, fit: &Certified) -> Vec<(String, String)> {
    let (fitted, weight) = (&fit.fitted, job.weight.as_deref());
    let minimised = super::words::minimised(fit.goal) + &super::words::weighted(weight, fit.goal);
    let mut rows = vec![("Minimised".to_string(), minimised)];
    let error = weight.zip(fit.weighted.as_ref());
    rows.extend(
        error.map(|(weight, error)| ("Weighted error".into(), super::words::weighted_error(weight, error))),
    );
    rows.push(("Ended as".into(), super::words::end(fitted)));
    rows.push(("Optimality".into(), super::words::optimality(fitted, weight.is_some())));
    let parameters = fitted.undetermined.iter().chain(&fit.notes);
    rows.extend(parameters.map(|text| ("Parameters".to_string(), text.clone())));
    rows.push(match &fit.proof {
        Proof::Regular => (
            "Regular".into(),
            "proven by interval arithmetic over the whole domain: every divisor keeps its sign, no root of a negative number, no \
             overflow"
                .into(),
        ),
        Proof::NotProven(error) => ("Regular".into(), format!("not proven: {error}")),
    });
    rows.extend(fit.kept.iter().map(|kept| ("Constraint".to_string(), super::words::constraint(kept))));
    let a = &fit.approximation;
    let beside = catalogue::beside(&fitting.catalogue, a.cost.ops, a.certificate.max_abs);
    rows.extend(beside.map(|text| ("Catalogue".into(), text)));
    let files: Vec<String> =
        job.languages.iter().map(|language| code_file(job.hypothesis.name(), *language)).collect();
    let emitted = if files.is_empty() { String::new() } else { format!("{}; ", files.join(", ")) };
    rows.push(("Emitted".into(), emitted + catalogue::by_scene(&fitting.target)));
    rows
}

fn code(job: &Job, fitting: &Fitting, fit: &Certified) -> Result<Section, FittingError> {
    let mut blocks = Vec::new();
    for language in &job.languages {
        blocks.push(Block::Heading { text: language.title().into() });
        let text = printed::function(*language, job, fitting, fit)?;
        blocks.push(Block::Code { text: text.trim_end().into() });
    }
    Ok(Section::new(
        anchor(fit, "code"),
        format!("{}: the code", fit.approximation.name),
        "As written to the files beside this page.",
        blocks,
    ))
}
