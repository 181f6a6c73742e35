//! The page of an effect whose tables have three axes.

use crate::effects::table::results::{
    AzimuthFinding, FurnaceFinding, SourcesFinding, VolumeFindings, VolumeTable,
};
use crate::report::numbers::grouped;
use crate::report::sections::{called_for, figures, furnace, tables, words};
use crate::report::{Block, Field, HeatMap, Page, ReportError, Section};

const LIST: [(&str, bool); 8] = [
    ("name", false),
    ("smith", false),
    ("size", false),
    ("bytes", true),
    ("ops", true),
    ("lookup error, max", true),
    ("RMS", true),
    ("where", false),
];

/// How maps of signed errors are read.
const SIGNED: &str = "Signed error, blue too low, red too high, white exact. The colour scale follows the square root of the \
                      magnitude, so that small errors stay visible; the ring marks the worst place of each map.";

/// The page of an effect whose tables have three axes.
pub(super) fn page(findings: &VolumeFindings) -> Result<Page, ReportError> {
    let effect = &findings.effect.effect;
    Ok(Page {
        title: format!("lobefit report: {}: {effect}", findings.origin.scene),
        origin: findings.origin.clone(),
        lead: format!(
            "What the scene called for, the tables made for it with their measured errors, and what a shader gets from each \
             layout. Figures in full digits: {effect}.json, in this folder."
        ),
        sections: sections(findings)?,
    })
}

fn sections(findings: &VolumeFindings) -> Result<Vec<Section>, ReportError> {
    let mut sections = vec![called_for::of(std::slice::from_ref(&findings.effect), &[])];
    sections.push(list(findings));
    if let Some(sources) = &findings.sources {
        sections.push(offline(sources));
    }
    if !findings.furnaces.is_empty() {
        sections.push(lookups(&findings.furnaces)?);
    }
    if !findings.azimuth.is_empty() {
        sections.push(azimuth(&findings.azimuth)?);
    }
    if !findings.truths.is_empty() {
        sections.push(truths(&findings.truths)?);
    }
    sections.push(details(&findings.tables)?);
    Ok(sections)
}

fn list(findings: &VolumeFindings) -> Section {
    let row = |t: &VolumeTable| {
        let size: Vec<String> = t.axes.iter().map(|a| a.size.to_string()).collect();
        let lookup = t.errors.iter().find(|(what, _)| what.starts_with("lookup"));
        vec![
            t.name.clone(),
            t.smith.name().into(),
            size.join(" × "),
            grouped(t.bytes),
            t.ops.to_string(),
            lookup.map_or_else(|| "–".into(), |(_, e)| words::max(e.max)),
            lookup.and_then(|(_, e)| e.rms).map_or_else(|| "–".into(), words::mean),
            lookup.map_or_else(|| "–".into(), |(_, e)| words::place(&e.at)),
        ]
    };
    let caption = "The lookup error is that of the trilinear fetch of the quantised texels with the emitted code, against the \
                   truth at places off the grid. Maxima are rounded up.";
    Section {
        id: "approximations".into(),
        title: "What accuracy costs at run time".into(),
        lead: "Every table made for this effect.".into(),
        blocks: vec![Block::Table(words::table(&LIST, findings.tables.iter().map(row).collect(), caption))],
    }
}

fn offline(sources: &SourcesFinding) -> Section {
    let columns = [("method", false), ("evaluations", true), ("error at the texels", true)];
    let rows = vec![
        vec![
            "lobefit".into(),
            grouped(sources.evaluations),
            format!("{} (worst of the texels checked)", words::max(sources.worst)),
        ],
        vec![
            "the sources: 10 million random samples a texel".into(),
            grouped(sources.samples as u64),
            format!("{} (one standard deviation)", words::mean(sources.noise)),
        ],
    ];
    let ratio = sources.samples / sources.evaluations as f64;
    let caption = format!(
        "{} texels, before they are rounded to the texel format. The sources evaluate the lobe {} times as often; their noise is \
         measured with fewer samples at texels spread over the table and scaled. Their running sum in f32 adds a bias, which the \
         page of the effect reflection shows. Seconds are in timings.html, which lobefit cost writes.",
        grouped(sources.texels),
        grouped(ratio as u64),
    );
    Section {
        id: "accuracy".into(),
        title: "What accuracy costs offline".into(),
        lead: "The tables in the sources' own layout, beside the method of the sources.".into(),
        blocks: vec![Block::Table(words::table(&columns, rows, &caption))],
    }
}

fn lookups(furnaces: &[FurnaceFinding]) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    for finding in furnaces {
        blocks.push(Block::Heading { text: finding.title.clone() });
        blocks.extend(furnace::panel(&finding.title, &finding.furnace)?);
    }
    Ok(Section {
        id: "furnace".into(),
        title: "What the lookup does".into(),
        lead: "A white sphere under equal light from everywhere, its lobe divided by the E that a shader looks up: the factor \
               E / lookup is 1 where the table and the way it is read are right. Each row is a layout and a way of reading it; \
               a layout is measured against the truth that it tabulates, with its own Smith form."
            .into(),
        blocks,
    })
}

fn azimuth(findings: &[AzimuthFinding]) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    for finding in findings {
        if findings.len() > 1 {
            blocks.push(Block::Heading { text: finding.domain.clone() });
        }
        blocks.extend(ways(finding)?);
    }
    Ok(Section {
        id: "azimuth".into(),
        title: "What ignoring the azimuth costs".into(),
        lead: "An anisotropic lobe loses more energy seen along its rough axis than across it. A table of the mean over the \
               azimuth cannot know; one that holds the azimuth can."
            .into(),
        blocks,
    })
}

fn ways(finding: &AzimuthFinding) -> Result<[Block; 2], ReportError> {
    for field in &finding.fields {
        field.check("azimuth")?;
    }
    let columns =
        [("way", false), ("max", true), ("RMS", true), ("where", false), ("bytes", true), ("ops", true)];
    let rows = finding.ways.iter().map(|w| {
        vec![
            w.name.clone(),
            words::max(w.error.max),
            w.error.rms.map_or_else(|| "–".into(), words::mean),
            words::place(&w.error.at),
            grouped(w.bytes),
            w.ops.to_string(),
        ]
    });
    let caption = format!("Error of E at a fixed azimuth, over {}. Maxima are rounded up.", finding.domain);
    Ok([
        Block::Table(words::table(&columns, rows.collect(), &caption)),
        maps(&finding.fields, &format!("Error at {}. {SIGNED}", finding.at))?,
    ])
}

fn truths(fields: &[Field]) -> Result<Section, ReportError> {
    for field in fields {
        field.check("truth")?;
    }
    Ok(Section {
        id: "truth".into(),
        title: "The truth".into(),
        lead: "E by quadrature, at some slices.".into(),
        blocks: vec![maps(fields, "E over roughness and the cosine of the view.")?],
    })
}

/// Small maps side by side.
fn maps(fields: &[Field], caption: &str) -> Result<Block, ReportError> {
    let fields: Vec<Field> = fields.iter().map(words::labelled).collect();
    let maps: Vec<HeatMap> =
        fields.iter().map(|f| HeatMap { size: (250.0, 220.0), ..HeatMap::of(&f.name, f) }).collect();
    figures(&maps, caption)
}

fn details(all: &[VolumeTable]) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    for table in all {
        blocks.push(Block::Heading { text: table.name.clone() });
        blocks.push(Block::Facts { rows: facts(table) });
        blocks.push(Block::Table(tables::errors_of(&table.errors)));
        for field in &table.lookup_error {
            field.check(&format!("table {}", table.name))?;
        }
        if !table.lookup_error.is_empty() {
            blocks.push(maps(&table.lookup_error, SIGNED)?);
        }
    }
    Ok(Section {
        id: "tables".into(),
        title: "Tables".into(),
        lead: "A table is judged as a shader sees it: by the trilinear lookup of its quantised texels, at places off the grid. \
               The error is split into what integration, texel format and lookup contribute."
            .into(),
        blocks,
    })
}

fn facts(table: &VolumeTable) -> Vec<(String, String)> {
    let mut rows = vec![
        ("Files".into(), table.files.join(", ")),
        (
            "Quantity".into(),
            format!("{}, {} Smith, alpha = {}", table.quantity, table.smith.name(), table.alpha_map.name()),
        ),
    ];
    for (what, axis) in ["Columns", "Rows", "Slices"].iter().zip(&table.axes) {
        rows.push((what.to_string(), tables::axis(axis)));
    }
    if !table.note.is_empty() {
        rows.push(("Nodes".into(), table.note.clone()));
    }
    rows.push(("Channels".into(), format!("{}; {}", table.channels.join(", "), table.decode)));
    rows.push(("Texels".into(), format!("{}, {} bytes", table.format.name(), grouped(table.bytes))));
    rows.push(("Integrand evaluations".into(), grouped(table.evaluations)));
    rows
}
