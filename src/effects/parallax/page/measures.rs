//! What a fetch is off by in other measures than the total variation.

use crate::effects::parallax::results::{ParallaxLobe, VariationFinding, VariationRow};
use crate::report::numbers::round_up;
use crate::report::sections::{figures, words};
use crate::report::{Block, HeatMap, ReportError, Shade, Spread, TextTable, check};

/// Name, and what it is of, in the order of [`ParallaxLobe::least`].
const MEASURES: [(&str, &str); 4] = [
    ("total variation", "half of the integral of the absolute difference"),
    ("L2", "root mean square difference over that of what is asked for"),
    ("largest", "largest difference over the largest of what is asked for"),
    (
        "within a radius",
        "root of the integral over ln R of the squared difference of the energies within the radius R, which the best width makes least",
    ),
];

/// Mean and largest in the order of [`MEASURES`].
fn pairs(row: &VariationRow) -> [[f64; 2]; 4] {
    [[row.mean, row.max], row.l2, row.largest, row.encircled]
}

/// The planes of what the best width leaves, and a table of all formulas.
pub(super) fn blocks(lobe: &ParallaxLobe) -> Result<Vec<Block>, ReportError> {
    check::size("measures", "planes", lobe.least.len(), MEASURES.len())?;
    Ok(vec![planes(lobe)?, Block::Table(table(lobe))])
}

/// The largest that the best width leaves where it is not saturated, by measure.
fn served(lobe: &ParallaxLobe) -> Option<[f64; 4]> {
    let best = lobe.variations.last()?;
    let rows = [&best.nearer, &best.farther].into_iter().flatten().map(pairs);
    rows.map(|row| row.map(|[_, max]| max)).reduce(|a, b| [0, 1, 2, 3].map(|i| a[i].max(b[i])))
}

/// All of the total variation, then every measure up to the largest that one fetch can serve.
fn planes(lobe: &ParallaxLobe) -> Result<Block, ReportError> {
    let fields: Vec<_> = lobe.least.iter().map(words::labelled).collect();
    let map = |title: &str, i: usize| HeatMap { size: (250.0, 200.0), ..HeatMap::of(title, &fields[i]) };
    let mut maps = vec![HeatMap { marks: lobe.saturated.clone(), ..map("total variation, all of it", 0) }];
    for (i, max) in served(lobe).into_iter().flatten().enumerate().filter(|(_, max)| *max > 0.0) {
        let shade = Shade::Magnitude { min: 0.0, max: round_up(max, 1), spread: Spread::Linear };
        maps.push(HeatMap { shade, ..map(MEASURES[i].0, i) });
    }
    let told = MEASURES.map(|(name, what)| format!("{name}, {what}")).join("; ");
    let caption = format!(
        "What the best single fetch leaves, a number without unit in each measure: {told}. The colours of all maps but the first end at the largest value that \
         is not saturated. Rings in the first: saturated, α′ = 1, where a wider lobe is called for than there is, and no choice of α′ helps."
    );
    figures(&maps, &caption)
}

fn table(lobe: &ParallaxLobe) -> TextTable {
    let columns = "name\
        |ρ < 1: L2 mean>|L2 max>|largest mean>|largest max>|within a radius: mean>|max>\
        |ρ > 1: L2 mean>|L2 max>|largest mean>|largest max>|within a radius: mean>|max>";
    let cells = |row: &Option<VariationRow>| -> Vec<String> {
        let figures = |row: &VariationRow| {
            let [_, others @ ..] = pairs(row);
            others.iter().flat_map(|[mean, max]| [words::mean(*mean), words::max(*max)]).collect()
        };
        row.as_ref().map_or_else(|| vec!["–".into(); 6], figures)
    };
    let row = |v: &VariationFinding| {
        std::iter::once(v.name.clone()).chain(cells(&v.nearer)).chain(cells(&v.farther)).collect()
    };
    let mut table = words::table(
        columns,
        lobe.variations.iter().map(row).collect(),
        "Mean and maximum of the other measures over the same cells; maxima are rounded up.",
    );
    table.muted = lobe.variations.iter().map(|v| v.published).collect();
    table
}
