//! The page of an audit: verdict, conventions tried, errors of every channel.

use super::{AuditAxis, AuditChannel, AuditConvention, AuditCost, AuditCurve, AuditFindings};
use crate::audit::{LookupErrors, TexelErrors, place};
use lobefit::report::numbers::{brief, significant};
use lobefit::report::{
    Block, Curves, HeatMap, Page, ReportError, Section, Series, Spread, Style, check, figures, signed, words,
};

pub(super) fn page(audit: &AuditFindings) -> Result<Page, ReportError> {
    let mut sections = vec![verdict(audit)];
    sections.extend(audit.cost.as_ref().map(AuditCost::section));
    sections.push(conventions(audit));
    for channel in &audit.channels {
        sections.push(channel_section(channel, is_function(audit), audit.stated)?);
    }
    Ok(Page {
        title: format!("lobefit audit: {} as {}", audit.file, audit.quantity),
        origin: audit.origin.clone(),
        lead: format!("{}\n{LEAD}", conclusion(audit)),
        sections,
    })
}

const LEAD: &str = "A table or function that somebody ships beside the truth: how it is best read, how far off it is, and what is wrong \
     with it. Figures in full digits: the JSON file beside this page.";

/// What came of it, in one sentence.
fn conclusion(audit: &AuditFindings) -> String {
    let file = &audit.file;
    let held = audit.channels.iter().map(|channel| channel.holds.as_str()).collect::<Vec<_>>();
    let quantity = format!("{}, {}", audit.quantity, held.join(" and "));
    let told = match (audit.stated, audit.fits.as_str()) {
        (true, "whole") => format!("{file} is what it says: {quantity}"),
        (true, _) => format!("{file} says that it is {quantity}, and is not"),
        (false, "whole") => format!("{file} is {quantity}"),
        (false, "part") => format!("{file} is in part {quantity}"),
        (false, _) => format!("{file} fits no convention, the nearest is {quantity}"),
    };
    let limit = audit.limit.map_or(String::new(), |limit| {
        let kept = if audit.passed { "kept" } else { "not kept" };
        format!("; the limit {} is {kept}", brief(limit, 3))
    });
    format!("{told}; the largest error is {}{limit}.", words::max(audit.max_error))
}

/// Whether the axes are arguments, which lie nowhere.
fn is_function(audit: &AuditFindings) -> bool {
    audit.conventions.iter().flat_map(|c| &c.axes).all(|a| a.registration.is_empty())
}

fn verdict(audit: &AuditFindings) -> Section {
    let fits = match audit.fits.as_str() {
        "whole" => "the convention below, as a whole",
        "part" => "the convention below in part",
        _ => "no convention",
    };
    let mut facts = vec![
        ("File".to_string(), audit.file.clone()),
        ("Holds".into(), audit.holds.clone()),
        ("Fits".into(), fits.into()),
        ("Largest error".into(), words::max(audit.max_error)),
    ];
    if let Some(max) = audit.plain.as_ref().and_then(|p| p.max) {
        facts.push(("Largest error, read plainly".into(), words::max(max)));
    }
    if let Some(limit) = audit.limit {
        let kept = if audit.passed { "kept" } else { "not kept" };
        facts.push(("Limit".into(), format!("{}, {kept}", brief(limit, 3))));
    }
    if let Some(furnace) = &audit.furnace {
        let range = format!("{} to {}", significant(furnace.least, 3), significant(furnace.most, 3));
        facts.push(("Furnace E/E' \u{2212} 1".into(), format!("{range}, worst at {}", place(&furnace.at))));
    }
    facts.push(("Error of the truth".into(), words::max(audit.truth_error)));
    Section {
        id: "verdict".into(),
        title: "Verdict".into(),
        lead: String::new(),
        blocks: vec![Block::Facts { rows: facts }, Block::Text { text: audit.verdict.clone() }],
    }
}

fn conventions(audit: &AuditFindings) -> Section {
    let Some(best) = audit.conventions.first() else {
        return Section {
            id: "conventions".into(),
            title: "Conventions".into(),
            lead: String::new(),
            blocks: Vec::new(),
        };
    };
    let mut columns: Vec<(String, bool)> = best.axes.iter().map(|a| (a.axis.clone(), false)).collect();
    columns.extend(
        [("lobe", false), ("holds", false), ("max", true), ("RMS", true), ("times worse", true)]
            .map(|(n, f)| (n.into(), f)),
    );
    let rows = audit.conventions.iter().map(|c| row(c, best.rank)).collect();
    let named: Vec<(&str, bool)> = columns.iter().map(|(n, f)| (n.as_str(), *f)).collect();
    let table = words::table(&named, rows, if audit.stated { "" } else { BEST_FIRST });
    let (title, lead) = if audit.stated {
        ("As the file says", "The file's own statement, held against the truth; nothing else was tried.")
    } else {
        (
            "Conventions tried",
            "Every combination of input, coordinate, direction, registration, lobe and meaning is tried; these fit best.",
        )
    };
    Section {
        id: "conventions".into(),
        title: title.into(),
        lead: lead.into(),
        blocks: vec![Block::Table(table)],
    }
}
/// What the table of conventions shows.
const BEST_FIRST: &str = "The best first. Conventions are ranked by the geometric mean of the root mean square of all errors and of that of \
     the best four fifths, which a stale part does not touch; max and RMS are of all texels, the worst channel's.";

fn row(c: &AuditConvention, best: f64) -> Vec<String> {
    let mut cells: Vec<String> = c.axes.iter().map(axis).collect();
    let held: Vec<&str> = c.channels.iter().map(|h| h.holds.as_str()).collect();
    let worst = |f: &dyn Fn(&super::AuditHeld) -> f64| c.channels.iter().map(f).fold(0.0, f64::max);
    cells.push(if c.lobe.is_empty() { "\u{2013}".into() } else { c.lobe.clone() });
    cells.push(held.join(", "));
    cells.push(words::max(worst(&|h| h.max)));
    cells.push(words::mean(worst(&|h| h.rms)));
    cells.push(brief(c.rank / best, 3));
    cells
}

fn axis(a: &AuditAxis) -> String {
    let coordinate = if a.reversed { format!("1 \u{2212} {}", a.coordinate) } else { a.coordinate.clone() };
    let clamp = a.clamp.map_or(String::new(), |c| format!(", \u{2265} {}", brief(c, 2)));
    let registration =
        if a.registration.is_empty() { String::new() } else { format!(", {}", a.registration) };
    format!("{coordinate}{registration}{clamp}")
}

fn channel_section(channel: &AuditChannel, function: bool, stated: bool) -> Result<Section, ReportError> {
    let section = format!("channel {}", channel.name);
    let mut blocks = vec![Block::Table(errors(channel, stated))];
    for defect in &channel.defects {
        blocks.push(Block::Text { text: defect.text.clone() });
    }
    if !channel.maps.is_empty() {
        let peak = channel.maps.iter().map(lobefit::report::Field::peak).fold(0.0, f64::max);
        let worst = |f: &lobefit::report::Field| f.peak() == peak;
        let maps: Vec<HeatMap> = channel
            .maps
            .iter()
            .map(|f| {
                let map = HeatMap::of(&f.name, f);
                HeatMap {
                    top_down: !function,
                    shade: signed(peak),
                    worst: map.worst.clone().filter(|_| worst(f)),
                    ..map
                }
            })
            .collect();
        let place = if stated {
            "of lookups over the inputs"
        } else if function {
            "over its arguments"
        } else {
            "of every texel in its place in the file, first row at the top"
        };
        let caption = format!(
            "Signed error {place}: blue too low, red too high, white exact. Colours follow the square root of the magnitude; the ring \
             marks the worst place."
        );
        blocks.push(figures(&maps, &caption)?);
    }
    if !channel.curves.is_empty() {
        let charts: Vec<Curves> =
            channel.curves.iter().map(|c| chart(&section, c)).collect::<Result<_, _>>()?;
        blocks.push(figures(&charts, "What is held beside the truth (black).")?);
    }
    Ok(Section {
        id: format!("channel-{}", anchor(&channel.name)),
        title: format!("Channel {}: {}", channel.name, channel.holds),
        lead: if stated {
            "Errors of looking it up as the file says, and where they are."
        } else {
            "Errors under the best convention, and where they are."
        }
        .into(),
        blocks,
    })
}

/// Lower-case letters and hyphens of a name.
fn anchor(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    name.chars().map(plain).collect()
}

fn errors(channel: &AuditChannel, stated: bool) -> lobefit::report::TextTable {
    let TexelErrors { max, rms, mean, at, judged, all, .. } = &channel.texels;
    let cells = |what: String, max: f64, rms: f64, mean: f64, at: String| {
        vec![what, words::max(max), words::mean(rms), significant(mean, 2), at]
    };
    let noun = if channel.lookup.is_some() { "texels" } else { "points" };
    let what = if judged == all { noun.into() } else { format!("{noun} ({judged} of {all})") };
    let mut rows = vec![cells(what, *max, *rms, *mean, place(at))];
    let mut lookup = |name: &str, l: &Option<LookupErrors>| {
        if let Some(l) = l {
            rows.push(cells(name.into(), l.max, l.rms, l.mean, place(&l.at)));
        }
    };
    lookup("lookup, texels where they are", &channel.lookup);
    if channel.plain_lookup != channel.lookup {
        lookup("lookup, texels taken for centres", &channel.plain_lookup);
    }
    words::table(
        &[("error of", false), ("max", true), ("RMS", true), ("mean", true), ("where", false)],
        rows,
        if channel.lookup.is_some() {
            "Lookups interpolate linearly over even coordinates of the whole domain; beyond the outermost texels they hold their value."
        } else if stated {
            "Over points of the whole domain that the file claims, more of them at small alpha and mu."
        } else {
            "Over evenly spaced points of the arguments."
        },
    )
}

fn chart(section: &str, curve: &AuditCurve) -> Result<Curves, ReportError> {
    check::size(section, "truth", curve.truth.len(), curve.at.len())?;
    check::size(section, "held", curve.held.len(), curve.at.len())?;
    let line = |name: &str, values: &[f64], style| Series {
        name: name.into(),
        points: curve.at.iter().copied().zip(values.iter().copied()).collect(),
        style,
        end: None,
    };
    // More marks than this hide the truth below them.
    let style = if curve.at.len() <= 24 { Style::Marked(0) } else { Style::Line(0) };
    Ok(Curves {
        title: curve.title.clone(),
        x: (curve.x.clone(), Spread::Linear),
        y: (String::new(), Spread::Linear),
        series: vec![line("truth", &curve.truth, Style::Truth), line("held", &curve.held, style)],
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size: (270.0, 200.0),
    })
}
