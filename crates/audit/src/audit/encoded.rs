//! Values that were encoded, for display or to hold more than the format can: a table that fits only
//! once that is undone.

use super::best::off;
use super::sample::Sample;
use super::screen::screen;
use super::table::{AuditedTable, Source};
use super::truth::Truth;
use super::verdict::{long, opening};
use super::{Audit, AuditError, Case, FITS, Fit, Fixed, SIEVE, candidates, finish};
use crate::foreign::{Channel, Step};
use lobefit_math::ops;

/// Most axes of a table of which this is tried: of three every try takes seconds, and pictures have
/// two.
const AXES: usize = 2;

/// An encoding: a line of [`ENCODINGS`].
struct Encoding {
    /// Its name.
    name: &'static str,
    /// What to do about it.
    remedy: &'static str,
    /// The value of a colour, 0 to 1, at a texel whose alpha is given.
    decode: fn(f64, f64) -> f64,
    /// Whether it takes the alpha beside three colours of 8 bits, which is no channel then.
    takes_alpha: bool,
}

/// Every encoding that is tried.
static ENCODINGS: [Encoding; 4] = [
    Encoding {
        name: "sRGB",
        remedy: "Its values were encoded for display: store them as they are, or sample it as an sRGB texture.",
        decode: |x, _| srgb(x),
        takes_alpha: false,
    },
    Encoding {
        name: "RGBE",
        remedy: "Decode it before it is filtered: the mean of two exponents is no exponent of the mean.",
        decode: |x, alpha| x * 255.0 / 256.0 * ops::pow(2.0, 255.0 * alpha - 128.0),
        takes_alpha: true,
    },
    Encoding {
        name: "RGBD of gamma 2.2",
        remedy: "Decode it before it is filtered: the mean of two divisors is no divisor of the mean.",
        decode: |x, alpha| ops::pow(x, 2.2) / alpha,
        takes_alpha: true,
    },
    Encoding {
        name: "RGBD",
        remedy: "Decode it before it is filtered: the mean of two divisors is no divisor of the mean.",
        decode: |x, alpha| x / alpha,
        takes_alpha: true,
    },
];

impl Encoding {
    /// A table without the encoding; none of one that cannot have it.
    fn undone(&self, table: &AuditedTable) -> Option<AuditedTable> {
        let alpha = table.channels.iter().find(|c| c.name == "A");
        let colours = table.channels.iter().filter(|c| c.name != "A");
        let alphas = match (alpha, self.takes_alpha) {
            (Some(alpha), true) if table.channels.len() == 4 && table.step == Step::Unorm8 => &alpha.values,
            (_, true) => return None,
            (_, false) => &table.channels[0].values,
        };
        let decoded = |c: &Channel| Channel {
            name: c.name.clone(),
            values: c.values.iter().zip(alphas).map(|(x, alpha)| (self.decode)(*x, *alpha)).collect(),
        };
        let channels: Vec<Channel> = colours.map(decoded).collect();
        let finite = channels.iter().flat_map(|c| &c.values).all(|v| v.is_finite());
        (finite && !channels.is_empty()).then(|| AuditedTable { channels, step: Step::None, ..table.clone() })
    }
}

/// What is said of a table that fits nothing, but does when its values are decoded; none if it does
/// not.
pub(super) fn told(
    truth: &Truth,
    table: &AuditedTable,
    live: &[usize],
    fixed: &Fixed,
    done: &Audit,
) -> Result<Option<String>, AuditError> {
    let values = || live.iter().flat_map(|k| &table.channels[*k].values);
    let picture = table.source == Source::Table && table.size.len() <= AXES;
    let said = fixed.meanings.as_ref().map(Vec::len);
    if done.fit != Fit::None || !picture || !values().all(|v| (0.0..=1.0).contains(v)) {
        return Ok(None);
    }
    for encoding in &ENCODINGS {
        let Some(linear) = encoding.undone(table) else { continue };
        let Ok(live) = linear.live(said) else { continue };
        if said.is_some_and(|said| said != live.len()) {
            continue;
        }
        let case = Case { table: &linear, live: &live, fixed, progress: &|_| () };
        let mut found = followed(truth, &case)?;
        if found.is_none() && said.is_none() && live.len() > 2 {
            // A channel of another quantity does not condemn the others.
            let mut own = Vec::new();
            for k in &live {
                own.extend(followed(truth, &Case { live: &[*k], ..case })?.map(|_| *k));
            }
            if own.len() > 1 {
                found = followed(truth, &Case { live: &own, ..case })?;
            }
        }
        if let Some(linear) = found {
            let (name, remedy) = (encoding.name, encoding.remedy);
            let (reading, worst) = (opening(&linear), long(linear.worst()));
            return Ok(Some(format!(
                "But with its values decoded from {name} it is {reading} {remedy} So read it is off by at most {worst}."
            )));
        }
    }
    Ok(None)
}

/// The audit of a table that follows a convention; none of any other.
fn followed(truth: &Truth, case: &Case) -> Result<Option<Audit>, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let few = Sample::new(table, live, SIEVE[0], true);
    let found = candidates(truth, case, screen(truth, &few, fixed, &fixed.lobes(truth))?)?;
    if off(truth, case, &found[0])? > FITS {
        return Ok(None);
    }
    let audit = finish(truth, table, live, fixed, &found, None)?;
    Ok((audit.fit == Fit::Whole).then_some(audit))
}

/// The linear value of an sRGB one in [0, 1] (IEC 61966-2-1).
fn srgb(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { ops::pow((x + 0.055) / 1.055, 2.4) }
}
