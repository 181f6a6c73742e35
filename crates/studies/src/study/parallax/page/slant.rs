//! Lobes on slanted walls, and several fetches for each.

use crate::study::parallax::findings::{
    PlacedTaps, RuleExpectation, RuleRefit, RuleSpread, SlantFindings, SlantLobe, SlantRow,
};
use lobefit::report::numbers::{place, significant};
use lobefit::report::{Block, Curves, ReportError, Section, Series, Style, check};
use lobefit::report::{figures, words};

pub(super) fn sections(slant: &SlantFindings) -> Result<Vec<Section>, ReportError> {
    check::filled("slant", "lobes", slant.lobes.len())?;
    Ok(vec![variation(slant)?, rules(slant)])
}

fn variation(slant: &SlantFindings) -> Result<Section, ReportError> {
    let charts: Vec<Curves> = slant.lobes.iter().map(chart).collect();
    let caption = "Total variation between the lobe’s footprint and the fetches’ over the slant; the probe stands in front of the wall, both in the same \
                   distance. Lines: fetches placed for this very wall. Marks: the shared rules of two and three.";
    let mut blocks = vec![figures(&charts, caption)?];
    for lobe in &slant.lobes {
        blocks.push(Block::Heading { text: format!("α {}", place(lobe.alpha)) });
        blocks.push(Block::Table(table(lobe)));
    }
    Ok(Section::new(
        "slant",
        "Several fetches on a slanted wall",
        "Energy per wall area, the integrals over the wall 1. Positions along the tilt, widths and weights of the fetches minimise the H⁻¹ norm of the \
               difference, the expected squared error over images whose spectrum falls as 1/f²; stated is the total variation. What leaves a \
               lobe past the horizon of the wall is left out of both sides.",
        blocks,
    ))
}

fn points(lobe: &SlantLobe, of: impl Fn(&SlantRow) -> Option<f64>) -> Vec<(f64, f64)> {
    lobe.rows.iter().filter_map(|row| Some((row.slant, of(row)?))).collect()
}

fn chart(lobe: &SlantLobe) -> Curves {
    let mut all = vec![
        Series::line("one, of α itself", points(lobe, |row| Some(row.same)), Style::Truth),
        Series::line("one, best width", points(lobe, |row| Some(row.best)), Style::Line(0)),
    ];
    let counts = lobe.rows.first().map_or(0, |row| row.placed.len());
    for i in 0..counts {
        let count = lobe.rows[0].placed[i].taps.len();
        let line = points(lobe, |row| row.placed.get(i).map(|placed| placed.tv));
        all.push(Series::line(format!("{count} fetches"), line, Style::Line(i + 1)));
    }
    for (i, name) in ["rule of two", "rule of three"].into_iter().enumerate() {
        all.push(Series::line(name, points(lobe, |row| Some(row.ruled[i])), Style::Marked(i + 1)));
    }
    let (title, labels) = (format!("α {}", place(lobe.alpha)), ["slant in degrees", "total variation"]);
    Curves { y_limits: Some((0.0, 0.65)), ..Curves::linear(title, labels, all, (330.0, 300.0)) }
}

fn table(lobe: &SlantLobe) -> lobefit::report::TextTable {
    let placed = lobe.rows.first().map_or(&[][..], |row| &row.placed);
    let counts = placed.iter().map(|p| p.taps.len().to_string());
    let columns = words::figures_after("slant>|α itself>|best α′>|α′/α>", counts) + "|rule of 2>|rule of 3>";
    let row = |row: &SlantRow| {
        let mut cells =
            vec![format!("{}°", place(row.slant)), tv(row.same), tv(row.best), significant(row.factor, 3)];
        let placed =
            |placed: &PlacedTaps| format!("{}{}", tv(placed.tv), if placed.settled { "" } else { "*" });
        cells.extend(row.placed.iter().map(placed));
        cells.extend(row.ruled.map(tv));
        cells
    };
    words::table(
        &columns,
        lobe.rows.iter().map(row).collect(),
        "Total variation. Columns 2, 3, 4, 8: so many fetches placed for this wall; * where that search was stopped after its last iteration, not at rest.",
    )
}

fn tv(x: f64) -> String {
    format!("{x:.3}")
}

fn rules(slant: &SlantFindings) -> Section {
    let columns = "α>|walls>|one: mean>|95 %>|two: mean>|95 %>|worse than one>|three: mean>|95 %>|worse than one>|expected within>";
    let row = |s: &RuleSpread| {
        let mut cells = vec![place(s.alpha), s.walls.to_string()];
        for i in 0..3 {
            cells.extend([tv(s.mean[i]), tv(s.high[i])]);
            cells.extend((i > 0).then(|| s.worse[i - 1].to_string()));
        }
        cells.push(s.expected.map(|x| format!("{x:.2}")).join(" / "));
        cells
    };
    let table = words::table(
        columns,
        slant.spread.iter().map(row).collect(),
        "Total variation over walls at slants to shading point and probe, at any azimuth between both, the cosines of the slants even above 0.15, the ratio of \
         the distances 0.15 to 2; none of these walls is one that the constants were fitted on. Expected within: root mean square error of the \
         total variation that the choice of the fewest fetches expects of one, two and three.",
    );
    let mut blocks = vec![Block::Table(table)];
    blocks.extend(slant.refits.iter().map(|refit| Block::Text { text: refitted(refit) }));
    blocks.extend(slant.expectations.iter().map(|of| Block::Text { text: expectation(of) }));
    Section::new(
        "rules",
        "One rule for every wall",
        "The fetches lie along the long axis of the footprint. Where they go depends on the length over the width of the footprint as the probe sees \
               it, on how fast it grows along its axis, and on α: formulas of 13 and 23 constants in sums, quotients and square roots. Where the footprint \
               is round and grows nowhere the outer fetches move to the middle or lose their weight, and what is left is the one fetch of the lobe; where it \
               grows, κ of 1 leaves several. On few walls a rule is worse than one fetch: “worse than one” counts them.",
        blocks,
    )
}

fn refitted(refit: &RuleRefit) -> String {
    format!(
        "Rule of {}: {} constants, fitted over {} walls. A fit from them on changes what it minimises by {} % {}.",
        refit.count,
        refit.constants.len(),
        refit.walls,
        significant(100.0 * (1.0 - refit.sums[1] / refit.sums[0]), 2),
        if refit.settled { "and comes to rest" } else { "until its iterations end" }
    )
}

fn expectation(of: &RuleExpectation) -> String {
    let list = |constants: &[f64; 4]| constants.map(|c| significant(c, 3)).join(", ");
    format!(
        "Expected total variation with {}: p, s, q, r = {}, off by {} root mean square over the {} walls of the fit; least squares from there gives {} and {}.",
        if of.count == 1 { "one fetch".into() } else { format!("{} fetches", of.count) },
        list(&of.constants),
        significant(of.off[0], 3),
        of.walls,
        list(&of.refitted),
        significant(of.off[1], 3)
    )
}
