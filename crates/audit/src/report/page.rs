//! The page of an audit: verdict, conventions tried, errors of every channel.

use super::{AuditAxis, AuditChannel, AuditConvention, AuditCost, AuditCurve, AuditFindings};
use crate::audit::{LookupErrors, TexelErrors, place};
use lobefit::report::numbers::{brief, significant};
use lobefit::report::{
    Block, Curves, HeatMap, Page, ReportError, Section, Series, Spread, Style, figures, signed, words,
};

pub(super) fn page(audit: &AuditFindings) -> Result<Page, ReportError> {
    let mut sections = vec![verdict(audit)?];
    sections.extend(audit.cost.as_ref().map(AuditCost::section));
    for (k, channel) in audit.channels.iter().enumerate() {
        sections.push(channel_section(audit, channel, worst_channel(audit) == Some(k))?);
    }
    sections.push(conventions(audit));
    Ok(Page {
        title: format!("lobefit audit: {} as {}", audit.file, audit.quantity),
        origin: audit.origin.clone().with_figures(&format!("{}.audit.json", audit.file)),
        lead: format!("{} {}.\n{LEAD}", audit.verdict.grade.word(), audit.verdict.headline),
        sections,
    })
}

const LEAD: &str = "A table or function that somebody ships beside the truth: how it is best read, how far off it is, and what is wrong \
     with it. Figures in full digits: the JSON file beside this page.";

/// The channel with the largest error.
fn worst_channel(audit: &AuditFindings) -> Option<usize> {
    let max = |k: &usize| audit.channels[*k].texels.max;
    (0..audit.channels.len()).max_by(|a, b| max(a).total_cmp(&max(b)).then(b.cmp(a)))
}

/// Whether the axes are arguments, which lie nowhere.
fn is_function(audit: &AuditFindings) -> bool {
    audit.conventions.iter().flat_map(|c| &c.axes).all(|a| a.registration.is_empty())
}

/// The picture of the worst channel, and the verdict's points.
fn verdict(audit: &AuditFindings) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    if let Some(k) = worst_channel(audit) {
        blocks.extend(maps(audit, &audit.channels[k])?);
    }
    let owned = |(name, text): (&str, String)| (name.to_string(), text);
    let mut facts: Vec<(String, String)> = audit.verdict.points().into_iter().map(owned).collect();
    facts.push(("File".into(), format!("{}: {}", audit.file, audit.holds)));
    facts.push(("Error of the truth".into(), words::max(audit.truth_error)));
    blocks.push(Block::Facts { rows: facts });
    if let Some(otherwise) = &audit.otherwise {
        let without = format!(
            "Without {}: {} {}.",
            otherwise.without,
            otherwise.verdict.grade.word(),
            otherwise.verdict.headline
        );
        blocks.push(Block::Text { text: without });
        blocks.push(Block::Facts { rows: otherwise.verdict.points().into_iter().map(owned).collect() });
    }
    Ok(Section::new("verdict", "Verdict", "", blocks))
}

fn conventions(audit: &AuditFindings) -> Section {
    let best = audit.conventions.first();
    let axes = best.into_iter().flat_map(|best| &best.axes).map(|a| a.axis.as_str());
    let columns = axes.chain(["lobe|holds|max>|RMS>|times worse>"]).collect::<Vec<_>>().join("|");
    let rows = audit.conventions.iter().map(|c| row(c, best.map_or(c.rank, |best| best.rank))).collect();
    let table = words::table(&columns, rows, if audit.stated { "" } else { BEST_FIRST });
    let (title, lead) = if audit.stated {
        ("As the file says", "The file's own statement, held against the truth; nothing else was tried.")
    } else {
        (
            "Conventions tried",
            "Every combination of input, coordinate, direction, registration, lobe and meaning is tried; these fit best.",
        )
    };
    Section::new("conventions", title, lead, vec![Block::Table(table)])
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

/// Errors of a channel; its maps are here unless they are `above`, beside the verdict.
fn channel_section(
    audit: &AuditFindings,
    channel: &AuditChannel,
    above: bool,
) -> Result<Section, ReportError> {
    let mut blocks = vec![Block::Table(errors(channel, audit.stated))];
    for defect in &channel.defects {
        blocks.push(Block::Text { text: defect.text.clone() });
    }
    if !above {
        blocks.extend(maps(audit, channel)?);
    }
    if !channel.curves.is_empty() {
        let charts: Vec<Curves> = channel.curves.iter().map(chart).collect();
        blocks.push(figures(&charts, "What is held beside the truth (black).")?);
    }
    let read = if audit.stated { "of looking it up as the file says" } else { "under the best convention" };
    let title = format!("Channel {}: {}", channel.name, channel.holds);
    let lead = format!("Errors {read}, and where they are.");
    Ok(Section::new(format!("channel-{}", anchor(&channel.name)), title, lead, blocks))
}

/// Maps of a channel's errors; none of a table of one axis.
fn maps(audit: &AuditFindings, channel: &AuditChannel) -> Result<Option<Block>, ReportError> {
    if channel.maps.is_empty() {
        return Ok(None);
    }
    let function = is_function(audit);
    let peak = channel.maps.iter().map(lobefit::report::Field::peak).fold(0.0, f64::max);
    let mut maps: Vec<HeatMap> = channel.maps.iter().map(|f| HeatMap::of(&f.name, f)).collect();
    for (map, field) in maps.iter_mut().zip(&channel.maps) {
        map.top_down = !function;
        map.shade = signed(peak);
        map.worst = map.worst.take().filter(|_| field.peak() == peak);
    }
    let place = if audit.stated {
        "of lookups over the inputs"
    } else if function {
        "over its arguments"
    } else {
        "of every texel in its place in the file, first row at the top"
    };
    let caption = format!(
        "Signed error of {} {place}: blue too low, red too high, white exact. Colours follow the square root of the magnitude; the ring \
         marks the worst place.",
        channel.holds
    );
    Ok(Some(figures(&maps, &caption)?))
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
        "error of|max>|RMS>|mean>|where",
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

fn chart(curve: &AuditCurve) -> Curves {
    let line = |name: &str, values: &[f64], style| Series {
        name: name.into(),
        points: curve.at.iter().copied().zip(values.iter().copied()).collect(),
        style,
        end: None,
    };
    // More marks than this hide the truth below them.
    let style = if curve.at.len() <= 24 { Style::Marked(0) } else { Style::Line(0) };
    Curves {
        title: curve.title.clone(),
        x: (curve.x.clone(), Spread::Linear),
        y: (String::new(), Spread::Linear),
        series: vec![line("truth", &curve.truth, Style::Truth), line("held", &curve.held, style)],
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size: (270.0, 200.0),
    }
}
