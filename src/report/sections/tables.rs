//! The truths and the tables that sample them.

use super::{figures, words};
use crate::data::Axis;
use crate::report::numbers::{brief, grouped, shortened};
use crate::report::{
    Block, ChannelFinding, ErrorFigure, Field, Findings, HeatMap, ReportError, Ruler, Section, TableFinding,
    check,
};

const COLUMNS: [(&str, bool); 4] = [("error of", false), ("max", true), ("RMS", true), ("where", false)];

/// The truths over their inputs; the caption says what to see in them.
pub(crate) fn truths(truths: &[Field], caption: &str) -> Result<Option<Section>, ReportError> {
    if truths.is_empty() {
        return Ok(None);
    }
    for f in truths {
        f.check("truth")?;
    }
    let fields: Vec<Field> = truths.iter().map(words::labelled).collect();
    let maps: Vec<HeatMap> =
        fields.iter().map(|f| HeatMap { size: (250.0, 220.0), ..HeatMap::of(&f.name, f) }).collect();
    Ok(Some(Section {
        id: "truth".into(),
        title: "The truth".into(),
        lead: "What is approximated, by quadrature: the values that every table and fit is measured against."
            .into(),
        blocks: vec![figures(&maps, caption)?],
    }))
}

/// The tables: texels, errors, lookup error over the domain.
pub(crate) fn section(findings: &Findings) -> Result<Option<Section>, ReportError> {
    if findings.tables.is_empty() {
        return Ok(None);
    }
    let mut blocks = Vec::new();
    for table in &findings.tables {
        blocks.extend(shown(table)?);
    }
    Ok(Some(Section {
        id: "tables".into(),
        title: "Tables".into(),
        lead: "A table is judged as a shader sees it: by the bilinear lookup of its quantised texels, at places off the \
               grid. The error is split into what integration, texel format and lookup contribute."
            .into(),
        blocks,
    }))
}

fn shown(table: &TableFinding) -> Result<Vec<Block>, ReportError> {
    let section = format!("table {}", table.name);
    check::filled(&section, "channels", table.channels.len())?;
    for c in &table.channels {
        let field = format!("channel {}: texels", c.name);
        check::size(&section, &field, c.texels.len(), table.axes[0].size * table.axes[1].size)?;
        check::values(&section, &field, &c.texels)?;
    }
    for f in &table.lookup_error {
        f.check(&section)?;
    }
    let texels: Vec<Field> = table.channels.iter().map(|c| texels(table, c)).collect();
    let pictures: Vec<HeatMap> =
        texels.iter().map(|f| HeatMap { top_down: true, ..HeatMap::of(&f.name, f) }).collect();
    let errors: Vec<Field> = table.lookup_error.iter().map(words::labelled).collect();
    let maps: Vec<HeatMap> = errors.iter().map(|f| HeatMap::of(&f.name, f)).collect();
    let mut blocks = vec![
        Block::Heading { text: table.name.clone() },
        Block::Facts { rows: facts(table) },
        figures(
            &pictures,
            "The texels as stored, one square per texel, first row at the top as in the file.",
        )?,
        Block::Table(errors_of(&table.errors)),
    ];
    if !maps.is_empty() {
        let caption = "Signed error of the lookup over the domain, blue too low, red too high, white exact. The colour \
                       scale follows the square root of the magnitude, so that small errors stay visible; the ring marks \
                       the worst place of this grid.";
        blocks.push(figures(&maps, caption)?);
    }
    Ok(blocks)
}

/// A channel as a field over texel numbers.
fn texels(table: &TableFinding, channel: &ChannelFinding) -> Field {
    let ruler = |a: &Axis, what: &str| Ruler {
        name: format!("{what} ({})", words::symbol(&a.name)),
        values: (0..a.size).map(|i| i as f64).collect(),
    };
    Field {
        name: channel.name.clone(),
        unit: String::new(),
        signed: false,
        x: ruler(&table.axes[0], "column"),
        y: ruler(&table.axes[1], "row"),
        values: channel.texels.iter().map(|&t| t as f32).collect(),
    }
}

/// An axis in words.
pub(crate) fn axis(a: &Axis) -> String {
    let name = words::symbol(&a.name);
    let ends = [a.min, a.max].map(|x| brief(x, 3));
    let registration = a.registration.name();
    format!(
        "{name} from {} to {}, {} texels, {registration} registration, {}",
        ends[0],
        ends[1],
        a.size,
        shortened(&a.formula())
    )
}

fn facts(table: &TableFinding) -> Vec<(String, String)> {
    vec![
        ("File".into(), table.file.clone()),
        (
            "Quantity".into(),
            format!("{}, {} Smith, alpha = {}", table.quantity, table.smith.name(), table.alpha_map.name()),
        ),
        ("Columns".into(), axis(&table.axes[0])),
        ("Rows".into(), axis(&table.axes[1])),
        ("Texels".into(), format!("{}, {} bytes", table.format.name(), grouped(table.bytes))),
    ]
}

/// Errors of a table, told apart.
pub(crate) fn errors_of(errors: &[(String, ErrorFigure)]) -> crate::report::TextTable {
    let row = |(what, figure): &(String, ErrorFigure)| {
        vec![
            what.clone(),
            words::max(figure.max),
            figure.rms.map_or_else(|| "–".into(), words::mean),
            words::place(&figure.at),
        ]
    };
    let rows = errors.iter().map(row).collect();
    words::table(
        &COLUMNS,
        rows,
        "Lookup is the whole error: integration, quantisation and interpolation together.",
    )
}
