//! The first line: what it is, the figure that the verdict is on, and where.

use super::figure::{Told, figure};
use super::first_line;
use super::words::{listed, number};
use crate::audit::plain::CLAMPED;
use crate::audit::{Audit, AxisReading, Fit, Form, Plain, Scale, Source};
use lobefit::data::Smith;

/// The end of a headline.
pub(in crate::audit) fn said_limit(limit: Option<f64>) -> String {
    limit.map_or_else(String::new, |limit| format!("; the limit is {}", number(limit)))
}

/// What it is, how far off it is by what the verdict is on, and the limit.
pub(super) fn headline(audit: &Audit, limit: Option<f64>) -> String {
    headline_of(&audit.what, audit, limit)
}

/// The same of what is called so.
pub(super) fn headline_of(called: &str, audit: &Audit, limit: Option<f64>) -> String {
    let held = audit.channels.iter().filter_map(|c| Some(c.column?.name())).collect::<Vec<_>>();
    let what = format!("{} {}{}: ", audit.quantity, listed(&held), aside(audit));
    let (found, more) = match figure(audit, limit) {
        Some(Told { found, more, .. }) => (found, more),
        None => (" is not judged".into(), Vec::new()),
    };
    first_line([&what, called, &found], &more, &said_limit(limit))
}

/// Where alpha runs along an axis of a table, or an argument is called what the other is: alpha a roughness,
/// as most shaders pass, or a roughness alpha. And where Smith's shadowing is the separable one.
fn aside(audit: &Audit) -> String {
    let is = |axis: &AxisReading, scale| axis.scale == scale && !axis.reversed;
    let said = audit.axes.iter().zip(&audit.best().axes).filter_map(|(name, axis)| {
        let called = name.to_lowercase();
        match audit.source {
            Source::Table => is(axis, Scale::Alpha).then(|| format!("alpha along {name}")),
            Source::Function if is(axis, Scale::Alpha) && called.contains("rough") => {
                Some(format!("{name} is alpha"))
            }
            Source::Function if is(axis, Scale::Roughness) && called.contains("alpha") => {
                Some(format!("{name} is a roughness, whose square alpha is"))
            }
            Source::Function => None,
        }
    });
    let form = audit.best().lobe.form;
    let is_other = is_separable(form) && audit.form.is_none() && audit.two_lobes.is_none();
    let said: Vec<String> = said.chain(is_other.then(|| form.words.into())).collect();
    if said.is_empty() || audit.fit == Fit::None { String::new() } else { format!(" ({})", said.join(", ")) }
}

/// Whether it is the other one of Smith's, which stands beside the quantity.
fn is_separable(form: &Form) -> bool {
    form.smith == Some(Smith::Separable)
}

/// Words without an explanation in brackets behind them: `theta along x`, `k = (r + 1)^2/8`.
pub(super) fn briefly(words: &str) -> String {
    let explanation = words.match_indices(" (").find_map(|(start, _)| {
        let mut depth = 0_usize;
        let end = words[start + 1..].char_indices().find_map(|(k, c)| {
            match c {
                '(' => depth += 1,
                ')' => depth -= 1,
                _ => {}
            }
            (depth == 0).then_some(start + 2 + k)
        })?;
        matches!(words[end..].chars().next(), None | Some(' ' | ',')).then_some([start, end])
    });
    explanation.map_or_else(|| words.into(), |[start, end]| format!("{}{}", &words[..start], &words[end..]))
}

/// How far off it is under the quantity's own shadowing, where it is of another, and without the clamps of
/// its inputs, where that is more than what is `said`.
pub(super) fn of_another(audit: &Audit, said: f64) -> String {
    let counts = |plain: &&Plain| plain.convention.lobe != audit.best().lobe || plain.max > said;
    let plain = audit.plain.as_ref().filter(|plain| plain.is_of_another_use(audit.best())).filter(counts);
    plain.map_or_else(String::new, |plain| {
        let [own, other] = [audit.best().lobe.words(), plain.convention.lobe.words()];
        let (mut as_it_is, mut plainly) = (String::new(), format!(", and by {}", number(plain.max)));
        if own != other {
            let is_said = is_separable(audit.best().lobe.form);
            as_it_is = if is_said { String::new() } else { format!(" as {}", briefly(&own)) };
            plainly += &format!(" as {}", briefly(&other));
        }
        let clamps: Vec<&str> =
            plain.untold.iter().map(String::as_str).filter(|w| w.contains(CLAMPED)).collect();
        if !clamps.is_empty() {
            as_it_is += &format!(" with {}", clamps.join(", "));
            plainly += " without";
        }
        as_it_is + &plainly
    })
}
