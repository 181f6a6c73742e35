//! The page of an effect whose tables have slices.

use super::results::{FurnaceFinding, PathTracerFinding, SlicedFindings, WaysFinding};
use crate::data::Smith;
use crate::report::numbers::grouped;
use crate::report::sections::tables::{SIGNED, maps};
use crate::report::sections::{called_for, furnace, tables, words};
use crate::report::{Block, Names, Page, ReportError, Section, TableFinding, TextTable, figures_of};

const LIST: &str = "name|smith|size|bytes>|ops>|lookup error, max>|RMS>|where";

/// The page of an effect whose tables have slices.
pub(super) fn page(findings: &SlicedFindings) -> Result<Page, ReportError> {
    let effect = &findings.effect.effect;
    Ok(Page::new(
        findings.origin.title("lobefit report", effect),
        findings.origin.clone(),
        format!(
            "What the scene called for, the tables made for it with their measured errors, and what a shader gets from each \
             layout. Figures in full digits: {effect}.json, in this folder."
        ),
        sections(findings)?,
    ))
}

fn sections(findings: &SlicedFindings) -> Result<Vec<Section>, ReportError> {
    let mut sections = vec![called_for::of(std::slice::from_ref(&findings.effect), &[])];
    sections.push(list(findings));
    if let Some(theirs) = &findings.path_tracer {
        sections.push(offline(theirs));
    }
    if !findings.furnaces.is_empty() {
        sections.push(lookups(&findings.furnaces)?);
    }
    if !findings.ways.is_empty() {
        sections.push(azimuth(&findings.ways)?);
    }
    sections.extend(tables::truths(&findings.truths, "E over roughness and the cosine of the view.")?);
    sections.extend(tables::section(&findings.tables)?);
    Ok(sections)
}

fn list(findings: &SlicedFindings) -> Section {
    let row = |t: &TableFinding| {
        let size: Vec<String> = t.axes.iter().map(|a| a.size.to_string()).collect();
        let lookup = t.errors.iter().find(|(what, _)| what.starts_with("lookup"));
        vec![
            t.name.clone(),
            t.smith.map_or("–", Smith::name).into(),
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
    let table = words::table(LIST, findings.tables.iter().map(row).collect(), caption);
    let link = |t: &TableFinding| Some(format!("#{}", figures_of(&t.name)));
    let names = Names {
        column: 0,
        places: vec![true; findings.tables.len()],
        links: findings.tables.iter().map(link).collect(),
    };
    Section::new(
        "approximations",
        "What accuracy costs at run time",
        "Every table made for this effect.",
        vec![Block::Table(TextTable { names: Some(names), ..table })],
    )
}

fn offline(theirs: &PathTracerFinding) -> Section {
    let columns = "method|evaluations>|error at the texels>";
    let rows = vec![
        vec![
            "lobefit".into(),
            grouped(theirs.evaluations),
            format!("{} (worst of the texels checked)", words::max(theirs.worst)),
        ],
        vec![
            "the path tracer: 10 million random samples a texel".into(),
            grouped(theirs.samples as u64),
            format!("{} (one standard deviation)", words::mean(theirs.noise)),
        ],
    ];
    let ratio = theirs.samples / theirs.evaluations as f64;
    let caption = format!(
        "{} texels, before they are rounded to the texel format. The path tracer evaluates the lobe {} times as often; its noise is \
         measured with fewer samples at texels spread over the table and scaled. Its running sum in f32 adds a bias, which the \
         page of the effect reflection shows. Seconds are in timings.html, which lobefit cost writes.",
        grouped(theirs.texels),
        grouped(ratio as u64),
    );
    Section::new(
        "accuracy",
        "What accuracy costs offline",
        "The tables in the path tracer's layout, beside its own method.",
        vec![Block::Table(words::table(columns, rows, &caption))],
    )
}

fn lookups(furnaces: &[FurnaceFinding]) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    for finding in furnaces {
        blocks.push(Block::Heading { text: finding.title.clone() });
        blocks.extend(furnace::panel(&finding.title, &finding.furnace)?);
    }
    Ok(Section::new(
        "furnace",
        "What the lookup does",
        "A white sphere under equal light from everywhere, its lobe divided by the E that a shader looks up: the factor \
               E / lookup is 1 where the table and the way it is read are right. Each row is a layout and a way of reading it; \
               a layout is measured against the truth that it tabulates, with its own Smith form.",
        blocks,
    ))
}

fn azimuth(findings: &[WaysFinding]) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    for finding in findings {
        if findings.len() > 1 {
            blocks.push(Block::Heading { text: finding.domain.clone() });
        }
        blocks.extend(ways(finding)?);
    }
    Ok(Section::new(
        "azimuth",
        "What ignoring the azimuth costs",
        "An anisotropic lobe loses more energy seen along its rough axis than across it. A table of the mean over the \
               azimuth cannot know; one that holds the azimuth can.",
        blocks,
    ))
}

fn ways(finding: &WaysFinding) -> Result<[Block; 2], ReportError> {
    for field in &finding.fields {
        field.check("azimuth")?;
    }
    let columns = "way|max>|RMS>|where|bytes>|ops>";
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
        Block::Table(words::table(columns, rows.collect(), &caption)),
        maps(&finding.fields, &format!("Error at {}. {SIGNED}", finding.at), true)?,
    ])
}
