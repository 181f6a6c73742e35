//! The figures of a furnace, as text, and their page.

use std::array::from_fn;

use lobefit::cli::columns::{Side, lines};
use lobefit::report::numbers::{brief, significant};
use lobefit::report::{
    Block, Curves, Origin, Page, ReportError, Section, Series, Spread, Style, document, figures, html, words,
};
use serde::Serialize;

use super::measure::{Cell, Energy, Furnace, VIEWS};
use super::words::{BAR, Judgement, energy};

/// What a furnace found, for machines.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FurnaceFindings {
    /// What made it.
    pub origin: Origin,
    /// The file, by its name.
    pub file: String,
    /// The function with the types of its arguments.
    pub function: String,
    /// What is allowed above 1, and of reciprocity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    /// Whether it is within what is allowed; absent where no limit is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passed: Option<bool>,
    /// The verdict.
    pub judgement: Judgement,
    /// The figures.
    pub furnace: Furnace,
}

impl FurnaceFindings {
    /// The verdict, its points, and the energies of the channel that has the largest.
    pub fn text(&self) -> String {
        let mut text = format!("{}\n", self.judgement.line);
        for point in &self.judgement.points {
            text.push_str(&format!("- {point}\n"));
        }
        let rows = self.rows();
        // Errors begin in one place of a column, however many digits they have.
        let error = |cell: &str| cell.split_once(BAR).map_or(0, |(_, error)| error.chars().count());
        let longest = |k: usize| rows.iter().map(|row| error(&row[k])).max().unwrap_or(0);
        let blanks = |k: usize, cell: &str| " ".repeat(longest(k) - error(cell));
        let aligned = |row: &Row| from_fn(|k| row[k].clone() + &blanks(k, &row[k]));
        let aligned: Vec<Row> = rows.iter().map(aligned).collect();
        let heads = heads();
        let lines = lines(heads.each_ref().map(|head| (head.as_str(), Side::Right)), &aligned);
        format!("{text}\n{}\n", lines.join("\n"))
    }

    fn rows(&self) -> Vec<Row> {
        let channel = self.furnace.most.1;
        let row = |cells: &[Cell]| -> Row {
            let first = cells[0].at.get("roughness").map_or("\u{2013}".into(), |r| brief(*r, 4));
            from_fn(|k| k.checked_sub(1).map_or(first.clone(), |view| energy(cells[view].energy[channel])))
        };
        self.furnace.cells.chunks(VIEWS.len()).map(row).collect()
    }
}

/// Roughness, then energies by view.
type Row = [String; 1 + VIEWS.len()];

fn heads() -> Row {
    from_fn(|k| k.checked_sub(1).map_or("roughness".into(), |view| format!("mu {}", VIEWS[view])))
}

/// The page as HTML, and the figures as JSON.
///
/// # Errors
/// Data that is not finite, by section and field.
pub fn furnace_page(found: &FurnaceFindings) -> Result<(String, Vec<u8>), ReportError> {
    let page = Page {
        title: format!("lobefit furnace: {} of {}", found.function, found.file),
        origin: found.origin.clone().with_figures(&format!("{}.furnace.json", found.file)),
        lead: found.judgement.line.clone(),
        sections: vec![energies(found)?, points(found)],
    };
    Ok((html(&page), document("furnace.json", found)?))
}

fn energies(found: &FurnaceFindings) -> Result<Section, ReportError> {
    let chart = |channel: usize| {
        let line = |(k, cells): (usize, &[Cell])| Series {
            name: cells[0]
                .at
                .get("roughness")
                .map_or("energy".into(), |r| format!("roughness {}", significant(*r, 2))),
            points: cells.iter().map(|cell| (cell.at["mu"], cell.energy[channel].value)).collect(),
            style: Style::Line(k),
            end: None,
        };
        let bars = |cells: &[Cell]| Series {
            name: String::new(),
            points: cells.iter().flat_map(|cell| ends(cell, channel)).collect(),
            style: Style::Bars,
            end: None,
        };
        let white = Series {
            name: "white".into(),
            points: vec![(0.0, 1.0), (1.0, 1.0)],
            style: Style::Truth,
            end: None,
        };
        let rows = found.furnace.cells.chunks(VIEWS.len());
        let (lines, bars) = (rows.clone().enumerate().map(line), rows.map(bars));
        Curves {
            title: format!("Energy of {}", found.furnace.channels[channel]),
            x: ("cosine of the view".into(), Spread::Linear),
            y: ("energy".into(), Spread::Linear),
            series: lines.chain([white]).chain(bars).collect(),
            annotations: Vec::new(),
            guides: Vec::new(),
            y_limits: None,
            size: (460.0, 260.0),
        }
    };
    let charts: Vec<Curves> = (0..found.furnace.channels.len()).map(chart).collect();
    let columns = heads().join(">|") + ">";
    let rows = found.rows().into_iter().map(Vec::from);
    let caption = "Energy by quadrature, with the difference from the coarser rule, of the channel that has the largest.";
    let blocks = vec![
        figures(&charts, "Energy that comes back in a white furnace; bars are its errors.")?,
        Block::Table(words::table(&columns, rows.collect(), caption)),
    ];
    Ok(Section::new("energy", "Energy", "", blocks))
}

/// The ends of the error bar of a cell.
fn ends(cell: &Cell, channel: usize) -> [(f64, f64); 2] {
    let Energy { value, error } = cell.energy[channel];
    [value - error, value + error].map(|y| (cell.at["mu"], y))
}

fn points(found: &FurnaceFindings) -> Section {
    let rows = found.judgement.points.iter().filter_map(|point| point.split_once(": "));
    let rows = rows.map(|(name, text)| (name.to_string(), text.to_string())).collect();
    Section::new("verdict", "What was found", "", vec![Block::Facts { rows }])
}
