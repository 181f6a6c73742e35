//! The page: a table of all cases, and for each the two forms, a chart and why.

use super::case::{CASES, Case};
use super::measure::{Approach, LOST, Measured};
use crate::study::{REDUCED, Size, page as build};
use lobefit::report::numbers::{bound, brief};
use lobefit::report::{
    Block, Curves, Origin, Page, ReportError, Section, Series, Spread, Style, figures, words,
};

const LEAD: &str = "Formulas that are equal on paper part where two nearly equal numbers are subtracted: what is left are the digits that both had lost. For ten hard \
     cases this page shows the form that textbooks and tutorials have beside the one that lobefit computes with, and the error of both along \
     the approach to the limit.\nErrors are relative to truths that no code of lobefit made (tests/oracle/stability.py: 60 digits, of the loss 30, of the sum f64, of half precision 5), at the very numbers that each form is \
     given. More digits help a naive form only for a while: f64 moves the cliff, and leaves it as steep. All figures: results.json.";

/// Anchors and titles of the sections, and how many cases each has.
const GROUPS: [(&str, &str, usize); 3] = [
    ("smooth", "Smooth surfaces", 3),
    ("edges", "Grazing views and interfaces", 4),
    ("ranges", "Anisotropy, long sums, half precision", 3),
];

/// Relative error from which a form is of no use: it is seen.
const SEEN: f64 = 0.01;

/// What the page shows, in a sentence.
fn conclusion(cases: &[Measured]) -> String {
    let fails = |found: &&Measured, double: bool| {
        let mut forms = found.naive.iter().filter(|form| (form.form == "naive, f64") == double);
        forms.any(|form| form.not_finite > 0 || form.worst >= SEEN)
    };
    let [single, double] = [false, true].map(|double| cases.iter().filter(|c| fails(c, double)).count());
    let kept = cases.iter().filter(|found| found.ours.not_finite == 0 && found.ours.worst <= found.promise);
    format!(
        "In {single} of {} hard cases the textbook’s form is off by 1 % and more, or not finite, in the precision of a shader, and in {double} in f64; ours \
         keeps what it promises in {}.\n",
        cases.len(),
        kept.count()
    )
}

/// The page of the cases.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub fn page(cases: &[Measured], size: Size, origin: Origin) -> Result<Page, ReportError> {
    let pairs: Vec<(&Case, &Measured)> = CASES.iter().zip(cases).collect();
    let mut rest = &pairs[..];
    let sections = GROUPS.map(|(id, title, count)| {
        let (own, others) = rest.split_at(count.min(rest.len()));
        rest = others;
        section((id, title), own)
    });
    let all: Vec<Section> = std::iter::once(Ok(overview(cases))).chain(sections).collect::<Result<_, _>>()?;
    let reduced = if size == Size::Reduced { REDUCED } else { "" };
    Ok(Page::new("lobefit study: stability", origin, format!("{reduced}{}{LEAD}", conclusion(cases)), all))
}

/// The worst errors of all cases.
fn overview(cases: &[Measured]) -> Section {
    let worst = |of: Option<&Approach>| match of {
        Some(found) if found.not_finite > 0 => "not finite".into(),
        Some(found) => bound(found.worst, 2),
        None => "–".into(),
    };
    let row = |(case, found): (&Case, &Measured)| {
        let of = |form: &str| worst(found.naive.iter().find(|naive| naive.form == form));
        let shader = if case.name == "half" { of("naive, f16") } else { of("naive, f32") };
        let row = [shader, of("naive, f64"), worst(Some(&found.ours)), brief(found.promise, 3)];
        build::row(case.title, row)
    };
    let columns = "case|naive, in a shader>|naive, f64>|ours>|ours, promised>";
    let caption = "Largest relative error over the approach to the limit. In a shader: f32, of the last row f16; ours is f64, and f16 in the last row. Charts end at an error of 10, and a result that is not finite is drawn at 1. Of the sum two things differ, order and precision; the charts of the guard and of the critical angle show forms that are wrong in any precision.";
    let table = words::table(columns, CASES.iter().zip(cases).map(row).collect(), caption);
    Section::new("cases", "All cases", "", vec![Block::Table(table)])
}

/// Charts of three cases, then the reason and the forms of each.
fn section((id, title): (&str, &str), cases: &[(&Case, &Measured)]) -> Result<Section, ReportError> {
    let charts: Vec<Curves> = cases.iter().map(|(case, found)| chart(case, found)).collect();
    let mut blocks = vec![figures(&charts, "")?];
    for (case, _) in cases {
        let naive: Vec<&str> = case.naive.lines().filter(|line| !line.starts_with("override")).collect();
        let naive = naive.join("\n");
        let text = format!("// naive: {}\n{naive}\n// ours: {}\n{}", case.met, case.called, case.ours);
        blocks.push(Block::Heading { text: case.title.into() });
        blocks.push(Block::Text { text: case.why.into() });
        blocks.push(Block::Code { text });
    }
    Ok(Section::new(id, title, "", blocks))
}

fn chart(case: &Case, found: &Measured) -> Curves {
    let ours = [(&found.ours, Style::Line(2))];
    // The worst precision of the naive form first: red.
    let naive = found.naive.iter().zip([Style::Line(1), Style::Line(0)]);
    let lines = naive.chain(ours).map(|(form, style)| Series::line(form.form, seen(form, found), style));
    let ends = found.ours.points.iter().chain(found.naive.iter().flat_map(|form| &form.points)).map(|p| p.0);
    let (low, high) = ends.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let unit = vec![(low, found.rounding), (high, found.rounding)];
    let series = lines.chain([Series::line("unit of rounding", unit, Style::Truth)]).collect();
    let axes = [case.distance, "relative error"].map(|label| (label, Spread::Log));
    Curves::new(case.title, axes, series, (270.0, 170.0))
}

/// Points as they are drawn: an error of nothing at a quarter of the unit of rounding, which is as low
/// as a single result says anything, and none above ten times all.
fn seen(form: &Approach, found: &Measured) -> Vec<(f64, f64)> {
    let floor = found.rounding / 4.0;
    form.points.iter().map(|&(x, error)| (x, error.clamp(floor, 10.0 * LOST))).collect()
}
