//! The truths and the tables that sample them.

use super::{figures, words};
use crate::data::Axis;
use crate::report::numbers::{brief, brief_bound, grouped, shortened};
use crate::report::{
    Block, ChannelFinding, ErrorFigure, Field, HeatMap, ReportError, Ruler, Section, TableFinding, Worst,
    check,
};

const COLUMNS: &str = "error of|max>|RMS>|where";

/// The truths over their inputs; the caption says what to see in them.
pub(crate) fn truths(truths: &[Field], caption: &str) -> Result<Option<Section>, ReportError> {
    if truths.is_empty() {
        return Ok(None);
    }
    for f in truths {
        f.check("truth")?;
    }
    Ok(Some(Section::new(
        "truth",
        "The truth",
        "What is approximated, by quadrature: the values that every table and fit is measured against.",
        vec![maps(truths, caption, true)?],
    )))
}

/// The tables: texels, errors, lookup error over the domain.
pub(crate) fn section(tables: &[TableFinding]) -> Result<Option<Section>, ReportError> {
    if tables.is_empty() {
        return Ok(None);
    }
    let mut blocks = Vec::new();
    for table in tables {
        blocks.extend(shown(table)?);
    }
    Ok(Some(Section::new(
        "tables",
        "Tables",
        "A table is judged as a shader sees it: by the linear lookup of its quantised texels, at places off the \
               grid. The error is split into what integration, texel format and lookup contribute.",
        blocks,
    )))
}

fn shown(table: &TableFinding) -> Result<Vec<Block>, ReportError> {
    let section = format!("table {}", table.name);
    check::filled(&section, "channels", table.channels.len())?;
    let expected = table.axes.iter().map(|axis| axis.size).product();
    for c in &table.channels {
        let field = format!("channel {}: texels", c.name);
        check::size(&section, &field, c.texels.len(), expected)?;
        check::values(&section, &field, &c.texels)?;
    }
    for f in &table.lookup_error {
        f.check(&section)?;
    }
    let mut blocks =
        vec![Block::Approximation { name: table.name.clone() }, Block::Facts { rows: facts(table) }];
    let flat = table.axes.len() == 2;
    if flat {
        let texels: Vec<Field> = table.channels.iter().map(|c| texels(table, c)).collect();
        let pictures: Vec<HeatMap> =
            texels.iter().map(|f| HeatMap { top_down: true, ..HeatMap::of(&f.name, f) }).collect();
        let caption = "The texels as stored, one square per texel, first row at the top as in the file.";
        blocks.push(figures(&pictures, caption)?);
    }
    blocks.push(Block::Table(errors_of(&table.errors)));
    if !table.lookup_error.is_empty() {
        blocks.push(errors_over(table, !flat)?);
    }
    Ok(blocks)
}

/// How maps of signed errors are read.
pub(crate) const SIGNED: &str = "Signed error of the lookup, blue too low, red too high, white exact. The colour scale follows \
                      the square root of the magnitude, so that small errors stay visible; the ring marks the worst place.";

/// Maps of the errors of a table's lookup; the ring is where the table of its errors has the largest, or
/// where that says no place on the map, the largest of the map.
fn errors_over(table: &TableFinding, small: bool) -> Result<Block, ReportError> {
    let fields: Vec<Field> = table.lookup_error.iter().map(words::labelled).collect();
    let maps = table.lookup_error.iter().zip(&fields).map(|(plain, field)| {
        let stated = table.errors.iter().find(|(what, _)| *what == plain.name.replace(" error", ""));
        let place = stated.and_then(|(_, e)| Some((*e.at.get(&plain.x.name)?, *e.at.get(&plain.y.name)?, e)));
        let map = sized(HeatMap::of(&field.name, field), small);
        let Some((x, y, figure)) = place else { return map };
        let text = brief_bound(figure.max.copysign(field.nearest(x, y)), 3);
        HeatMap { worst: Some(Worst { x, y, text }), ..map }
    });
    figures(&maps.collect::<Vec<HeatMap>>(), SIGNED)
}

fn sized(map: HeatMap<'_>, small: bool) -> HeatMap<'_> {
    if small { HeatMap { size: (250.0, 220.0), ..map } } else { map }
}

/// Maps side by side.
pub(crate) fn maps(fields: &[Field], caption: &str, small: bool) -> Result<Block, ReportError> {
    let fields: Vec<Field> = fields.iter().map(words::labelled).collect();
    let maps = fields.iter().map(|f: &Field| sized(HeatMap::of(&f.name, f), small));
    figures(&maps.collect::<Vec<HeatMap>>(), caption)
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
fn axis(a: &Axis) -> String {
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
    let smith = table.smith.map_or_else(String::new, |smith| format!("{} Smith, ", smith.name()));
    let mut rows = vec![
        ("Files".into(), table.files.join(", ")),
        ("Quantity".into(), format!("{}, {smith}alpha = {}", table.quantity, table.alpha_map.name())),
    ];
    for (what, of) in ["Columns", "Rows", "Slices"].iter().zip(&table.axes) {
        rows.push((what.to_string(), axis(of)));
    }
    if !table.note.is_empty() {
        rows.push(("Nodes".into(), table.note.clone()));
    }
    let channels: Vec<&str> = table.channels.iter().map(|c| c.name.as_str()).collect();
    rows.push(("Channels".into(), format!("{}; {}", channels.join(", "), table.decode)));
    rows.push(("Texels".into(), format!("{}, {} bytes", table.format.name(), grouped(table.bytes))));
    if table.evaluations > 0 {
        rows.push(("Integrand evaluations".into(), grouped(table.evaluations)));
    }
    rows
}

/// Errors of a table by their causes.
fn errors_of(errors: &[(String, ErrorFigure)]) -> crate::report::TextTable {
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
        COLUMNS,
        rows,
        "Lookup is the whole error: integration, quantisation and interpolation together.",
    )
}
