//! The figure that a verdict is on: the first line, `--json` and the exit code read it here.

use serde::Serialize;

use super::defect::{LINES, extent};
use super::headline::{briefly, of_another};
use super::words::{excluded, long, names, number, place};
use crate::audit::errors::TexelErrors;
use crate::audit::table::Source;
use crate::audit::{Audit, ChannelAudit, Defect, Fit, LookupErrors, Other, Plain, Published, inputs_at};
use lobefit::data::Place;

/// What a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The error of a texel, as the table is best read.
    Texel,
    /// The error at a point of a function's arguments.
    Point,
    /// The error of a lookup between texels.
    Lookup,
    /// The error of a texel or point by the plain reading, or of the values as they are stored.
    Plain,
    /// The furnace error |E N - 1| of a normalisation.
    Furnace,
    /// What comes back of the light beyond what came in.
    Gain,
    /// The error of a part that is to be mended.
    Damage,
    /// The error that the file claims of itself.
    Claim,
}

/// The figure, of what it is and where.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// How much; infinite, and left out of JSON, where the plain reading has no truth at any texel.
    #[serde(rename = "max_error", skip_serializing_if = "is_infinite")]
    pub value: f64,
    /// What it is.
    #[serde(rename = "figure")]
    pub kind: Kind,
    /// Of which column, or of `f0 A + B`.
    pub of: String,
    /// The inputs there; nothing of a claim.
    pub at: Place,
}

fn is_infinite(figure: &f64) -> bool {
    figure.is_infinite()
}

/// A figure in words: what was found, and what the first line has besides where there is room.
pub(super) struct Told {
    pub figure: Figure,
    pub found: String,
    pub more: Vec<String>,
}

impl Told {
    fn new(kind: Kind, of: &str, (value, at): (f64, &Place), found: String) -> Told {
        Told { figure: Figure { kind, of: of.into(), value, at: at.clone() }, found, more: Vec::new() }
    }
}

/// The figure of a verdict with a limit, or without one; none where nothing is judged.
pub(super) fn figure(audit: &Audit, limit: Option<f64>) -> Option<Told> {
    // A limit is on all that the file holds.
    let (column, worst) = worst(audit, limit.is_some())?;
    let own = (worst.max, &worst.at);
    let (max, at) = (number(worst.max) + &of(audit, &column), place(&worst.at));
    let kind = if audit.source == Source::Table { Kind::Texel } else { Kind::Point };
    if audit.fit == Fit::None && audit.two_lobes.is_none() {
        let nearest = match audit.misfit() {
            Some(known) => format!(" {} {max} at {at}", held(audit, known)),
            None => format!(" {}; the nearest leaves {max} at {at}", nothing(audit)),
        };
        return Some(Told::new(kind, &column, own, nearest));
    }
    if let Some(plain) = audit.misread(limit) {
        return Some(plainly(plain, column));
    }
    let another = of_another(audit, worst.max);
    let points = vec![format!(" ({} points sampled)", worst.judged)];
    if let (Some(error), Some(furnace)) = (audit.furnace_error(), &audit.furnace) {
        let found = format!(" leaves |E N - 1| of at most {} at {}", number(error), place(&furnace.at));
        let told = Told::new(Kind::Furnace, furnace.column.name(), (error, &furnace.at), found);
        return Some(Told { more: points, ..told });
    }
    if audit.source == Source::Function {
        let told = Told::new(kind, &column, own, format!(" is off by at most {max} at {at}{another}"));
        return Some(Told { more: points, ..told });
    }
    if let Some(told) = damage(audit).filter(|_| limit.is_none() || audit.fit != Fit::Whole) {
        return Some(told);
    }
    let lookup = largest_lookup(audit).filter(|(_, lookup)| lookup.inner > worst.max);
    Some(lookup.map_or_else(
        || Told::new(kind, &column, own, format!(" is off by at most {max} at {at}{another}")),
        |lookup| match limit {
            // A limit is on the texels: the figure that is judged stands first.
            Some(_) => {
                let texels = format!(" is off by at most {max} at texels ({at}){another}");
                let (lookup, there) = of_lookup(audit, lookup);
                Told { more: vec![format!(", {lookup}{there}")], ..Told::new(kind, &column, own, texels) }
            }
            None => between(audit, lookup, &max),
        },
    ))
}

/// A lookup and its place in words.
fn of_lookup(audit: &Audit, (column, lookup): (&str, &LookupErrors)) -> (String, String) {
    let looked = format!("{}{} in lookups", number(lookup.inner), of(audit, column));
    (looked, format!(" ({})", place(&lookup.inner_at)))
}

/// The figure of lookups, beside the largest error at texels.
fn between(audit: &Audit, lookup: (&str, &LookupErrors), texels: &str) -> Told {
    let another = of_another(audit, lookup.1.inner);
    let (looked, there) = of_lookup(audit, lookup);
    let more = if another.is_empty() { vec![format!(", {texels} at texels")] } else { Vec::new() };
    let (column, lookup) = lookup;
    let found = format!(" is off by at most {looked}{there}{another}");
    Told { more, ..Told::new(Kind::Lookup, column, (lookup.inner, &lookup.inner_at), found) }
}

/// The figure of the plain reading; `column` has the largest error by the best one.
fn plainly(plain: &Plain, column: String) -> Told {
    let at = plain.at.as_ref();
    let (column, at) = at.map_or((column, Place::new()), |(c, at)| (c.name().into(), at.clone()));
    let there = if at.is_empty() { String::new() } else { format!(", at {}", place(&at)) };
    let found = format!(" is off by at most {} read plainly{there}", number(plain.max));
    let [judged, all] = plain.texels;
    let few = if judged < all { format!(" ({judged} of {all} texels judged)") } else { String::new() };
    Told {
        more: vec![format!(": it has {}", untold(plain)), few],
        ..Told::new(Kind::Plain, &column, (plain.max, &at), found)
    }
}

/// What no reader assumes, in a few words.
fn untold(plain: &Plain) -> String {
    let words: Vec<String> = plain.untold.iter().map(|words| briefly(words)).collect();
    match &words[..] {
        [first, _, _, ..] => format!("{first} and {} more", words.len() - 1),
        _ => words.join(", "),
    }
}

/// What it is that fits nothing.
fn nothing(audit: &Audit) -> String {
    if let Some(said) = excluded(audit) {
        return format!("is not what {said}");
    }
    match audit.source {
        Source::Table => "fits no convention".into(),
        Source::Function => "is no approximation of it".into(),
    }
}

/// Which published formula it is, of what lobe, and what that is held against.
fn held(audit: &Audit, known: &Published) -> String {
    let lobe = audit.best().lobe;
    let made_for =
        audit.made_for().map_or_else(String::new, |form| format!(", made for {}", briefly(form.words)));
    let against = match lobe.words() {
        words if words.is_empty() => String::new(),
        words => format!("against {} ", briefly(&words)),
    };
    format!("is `{}`{made_for}: {against}off by at most", known.name)
}

/// ` of A`, of several columns.
fn of(audit: &Audit, column: &str) -> String {
    let judged = |c: &&ChannelAudit| c.column.is_some() || matches!(c.other, Some(Other::Quantity(_)));
    let several = audit.channels.iter().filter(judged).count() > 1;
    if several { format!(" of {column}") } else { String::new() }
}

/// The column with the largest error at its texels or points; with `all`, those of other quantities too.
pub(in crate::audit) fn worst(audit: &Audit, all: bool) -> Option<(String, &TexelErrors)> {
    let one = audit.channels.iter().filter_map(|c| match &c.other {
        Some(Other::Quantity(other)) if all => {
            let (column, errors) = worst(other, all)?;
            Some((format!("{} {column}", other.quantity), errors))
        }
        _ => Some((c.column?.name().to_string(), c.errors.as_ref()?)),
    });
    one.reduce(|a, b| if b.1.max > a.1.max { b } else { a })
}

/// What about a table is to be mended: of several the worst.
pub(super) fn damage(audit: &Audit) -> Option<Told> {
    if let Some(parts) = &audit.two_lobes {
        let (column, worst) = worst(audit, true)?;
        let (range, lobe) = (extent(&audit.axes, &parts.extent), parts.lobe.words());
        let at = if range.is_empty() { String::new() } else { format!(" at {range}") };
        let (texels, max) = (parts.texels[1], number(worst.max));
        let found = format!(
            " is of two lobes: {texels} of its texels{at} are of {lobe}, off by {max} as the others are"
        );
        return Some(Told::new(Kind::Damage, &column, (worst.max, &worst.at), found));
    }
    let channels = audit.channels.iter().filter_map(|c| Some((c.column?.name(), &c.defects)));
    let all = channels.flat_map(|(column, defects)| defects.iter().map(move |d| (column, d)));
    let said = all.filter_map(|(column, defect)| damaged(audit, column, defect));
    // Lines that were never filled go before all else.
    let rank = |told: &Told| match told.figure.kind {
        Kind::Texel => f64::INFINITY,
        _ => told.figure.value,
    };
    said.reduce(|a, b| if rank(&b) > rank(&a) { b } else { a })
}

/// By how much a defect is wrong; none of one that is in the nature of the format.
fn damaged(audit: &Audit, column: &str, defect: &Defect) -> Option<Told> {
    let of = of(audit, column);
    let (kind, value, texel, found) = match defect {
        Defect::Part { texels, most, texel, rest, extent: part, .. } => {
            let at = match extent(&audit.axes, part) {
                at if at.is_empty() => format!("{} texels", texels[0]),
                at => at,
            };
            let (max, rest) = (number(*most), number(*rest));
            let found = format!(" is off by at most {max}{of} at {at}, elsewhere by RMS {rest}");
            (Kind::Damage, *most, texel, found)
        }
        Defect::Gain { column, albedo, texel } => {
            let comes = long(*albedo);
            let found = format!(" gains energy: {comes} of the light comes back at texel {texel:?}");
            let at = inputs_at(audit.best(), &audit.size, texel);
            return Some(Told::new(Kind::Gain, column.name(), (albedo - 1.0, &at), found));
        }
        Defect::Dead { line: [axis, index], value } => {
            let (column, rest) = worst(audit, false)?;
            let (line, name, held) = (LINES[*axis], &audit.axes[*axis], number(*value));
            let (max, at) = (number(rest.max), place(&rest.at));
            let found = format!(
                " was never filled at {line} {name} = {index}: it holds {held}; the rest is off by at most {max} at {at}"
            );
            return Some(Told::new(Kind::Texel, &column, (rest.max, &rest.at), found));
        }
        Defect::Enlarged(from) => {
            let (column, worst) = worst(audit, false)?;
            let (max, at) = (number(worst.max) + &self::of(audit, &column), place(&worst.at));
            let found = format!(" is of {from}: off by at most {max} at {at}");
            return Some(Told::new(Kind::Damage, &column, (worst.max, &worst.at), found));
        }
        Defect::Clamped { value, truth, texel, .. } => {
            let (held, there) = (number(*value), number(*truth));
            let found = format!(" stands at {held}{of} where the truth goes on to {there}");
            (Kind::Damage, (truth - value).abs(), texel, found)
        }
        Defect::Factor { factor, column: own, most, texel } => {
            let (times, max) = (long(*factor), number(*most));
            (
                Kind::Damage,
                *most,
                texel,
                format!(" has {times} times {}: off by at most {max}{of}", own.name()),
            )
        }
        Defect::Flipped { axes, column: own, most, texel } => {
            let (along, max) = (names(&audit.axes, axes), number(*most));
            let found = format!(" has {} flipped along {along}: off by at most {max}{of}", own.name());
            (Kind::Damage, *most, texel, found)
        }
        Defect::ChannelLobe { lobe, column: own, most, texel } => {
            let (lobe, max) = (lobe.words(), number(*most));
            let found =
                format!(" has {} of {lobe} beside others that are not: off by at most {max}{of}", own.name());
            (Kind::Damage, *most, texel, found)
        }
        Defect::MissingLoss { column, worst: [held, truth], texel, .. } => {
            let (stored, loss) = (number(*held), number(*truth));
            let found = format!(" holds {stored} of a loss of {loss} at texel {texel:?}");
            let at = inputs_at(audit.best(), &audit.size, texel);
            return Some(Told::new(Kind::Damage, column.name(), (truth - held, &at), found));
        }
        _ => return None,
    };
    Some(Told::new(kind, column, (value, &inputs_at(audit.best(), &audit.size, texel)), found))
}

/// The worst lookup and of what it is: of A alone no pixel is made where a shader blends f0 A + B.
pub(super) fn largest_lookup(audit: &Audit) -> Option<(&'static str, &LookupErrors)> {
    let channels = audit.channels.iter().filter_map(|c| Some((c.column?.name(), c.lookup.as_ref()?)));
    let worst = channels.reduce(|a, b| if b.1.inner > a.1.inner { b } else { a });
    audit.blend.as_ref().map(|blend| ("f0 A + B", blend)).or(worst)
}
