//! Values that were encoded, for display or to hold more than the format can: a table that fits only
//! once that is undone.

use super::apart;
use super::best::{Case, best, promising};
use super::defects::stored;
use super::plain::Plain;
use super::table::{AuditedTable, Source};
use super::{Audit, AuditError, FITS, Fit};
use crate::foreign::{Channel, Step};
use std::f64::consts::PI;

use lobefit_math::{ops, srgb};
use lobefit_truth::quantity::Quantity;

/// Most axes of a table of which this is tried: of three every try takes seconds, and pictures have
/// two.
const AXES: usize = 2;

/// An encoding: a line of [`ENCODINGS`].
#[derive(Debug)]
pub struct Encoding {
    /// The word of `--encoding`.
    pub word: &'static str,
    /// Its name.
    pub name: &'static str,
    /// What to do about it.
    pub remedy: &'static str,
    /// The value of a colour, 0 to 1, at a texel whose alpha is given.
    decode: fn(f64, f64) -> f64,
    /// The step of a decoded value, of values with this step.
    step: fn(Step) -> Step,
    /// Whether values are colours, 0 to 1, which a linear picture does not hold.
    of_colours: bool,
    /// Whether it takes the alpha beside three colours of 8 bits, which is no channel then.
    takes_alpha: bool,
}

/// Every encoding that is tried.
pub static ENCODINGS: [Encoding; 8] = [
    Encoding {
        word: "srgb",
        name: "sRGB",
        remedy: "its values were encoded for display: store them as they are, or sample it as an sRGB texture",
        decode: |x, _| srgb::decoded(x),
        step: |stored| match stored {
            Step::Unorm8 => Step::Srgb(255),
            Step::Unorm10 => Step::Srgb(1023),
            Step::Unorm16 => Step::Srgb(65535),
            _ => Step::None,
        },
        of_colours: true,
        takes_alpha: false,
    },
    Encoding {
        word: "rgbe",
        name: "RGBE",
        remedy: "decode it before it is filtered: the mean of two exponents is no exponent of the mean",
        decode: |x, alpha| x * 255.0 / 256.0 * ops::pow(2.0, 255.0 * alpha - 128.0),
        step: |_| Step::Rgbe,
        of_colours: true,
        takes_alpha: true,
    },
    Encoding {
        word: "rgbd-2.2",
        name: "RGBD of gamma 2.2",
        remedy: "decode it before it is filtered: the mean of two divisors is no divisor of the mean",
        decode: |x, alpha| ops::pow(x, 2.2) / alpha,
        step: |_| Step::Rgbd(22),
        of_colours: true,
        takes_alpha: true,
    },
    Encoding {
        word: "rgbd",
        name: "RGBD",
        remedy: "decode it before it is filtered: the mean of two divisors is no divisor of the mean",
        decode: |x, alpha| x / alpha,
        step: |_| Step::Rgbd(10),
        of_colours: true,
        takes_alpha: true,
    },
    times("over-pi", "over pi", "multiply its values by pi: they are over pi", |x, _| x * PI),
    times("times-pi", "times pi", "divide its values by pi: they are pi times as large", |x, _| x / PI),
    times("halves", "times 1/2", "multiply its values by 2: they are halves", |x, _| x * 2.0),
    times("twice", "times 2", "divide its values by 2: they are twice as large", |x, _| x / 2.0),
];

/// A constant factor, of a normalisation that is left out or counted twice.
const fn times(
    word: &'static str,
    name: &'static str,
    remedy: &'static str,
    decode: fn(f64, f64) -> f64,
) -> Encoding {
    Encoding { word, name, remedy, decode, step: |_| Step::None, of_colours: false, takes_alpha: false }
}

impl PartialEq for Encoding {
    fn eq(&self, other: &Encoding) -> bool {
        self.word == other.word
    }
}

impl Encoding {
    /// A table without the encoding; none of one that cannot have it.
    fn undone(&self, table: &AuditedTable) -> Option<AuditedTable> {
        let alpha = table.channels.iter().find(|c| c.name == "A");
        // Beside three colours alpha is none of them.
        let colours = table.channels.iter().filter(|c| !self.of_colours || c.name != "A");
        let alphas = match (alpha, self.takes_alpha) {
            (Some(alpha), true) if table.channels.len() == 4 && table.step == Step::Unorm8 => &alpha.values,
            (_, true) => return None,
            (_, false) => &table.channels[0].values,
        };
        let decoded = |c: &Channel| {
            let values = c.values.iter().zip(&**alphas).map(|(x, alpha)| (self.decode)(*x, *alpha));
            Channel { name: c.name.clone(), values: values.collect::<Vec<_>>().into() }
        };
        let channels: Vec<Channel> = colours.map(decoded).collect();
        let finite = channels.iter().flat_map(|c| c.values.iter()).all(|v| v.is_finite());
        let colours = table.channels.iter().flat_map(|c| c.values.iter()).all(|v| (0.0..=1.0).contains(v));
        let step = (self.step)(stored(table.step, &table.channels[0].values));
        let decoded = AuditedTable { channels, step, ..table.clone() };
        // A Radiance picture is linear.
        let held = !self.of_colours || colours && table.step != Step::Rgbe;
        (finite && held && !decoded.channels.is_empty() && table.source == Source::Table).then_some(decoded)
    }

    /// Its name, of an encoding for display behind some words.
    pub(super) fn said(&self, encoded: &str) -> String {
        if self.of_colours { format!("{encoded}{}", self.name) } else { self.name.into() }
    }

    /// The table that the user says is encoded so.
    pub(super) fn decoded(&self, table: &AuditedTable) -> Result<AuditedTable, AuditError> {
        let alpha = if self.takes_alpha { " beside an alpha of 8 bits above 0" } else { "" };
        self.undone(table).ok_or_else(|| AuditError::Option {
            option: "--encoding",
            value: self.word.into(),
            reason: format!("{} is not encoded so: colours from 0 to 1{alpha} are called for", table.what),
        })
    }

    /// An audit of the decoded table, which nobody said to be encoded, with what it is as it is `stored`.
    pub(super) fn beside(&'static self, read: Audit, stored: &Audit) -> Audit {
        let told = read.plain.clone();
        let all = read.size.iter().product();
        let convention = told.as_ref().map_or(read.best(), |plain| &plain.convention).clone();
        let (mut untold, mut options) =
            told.map_or((Vec::new(), String::new()), |plain| (plain.untold, plain.options + " "));
        untold.push(format!("values {}", self.said("encoded as ")));
        options += &format!("--encoding {}", self.word);
        let held = stored.channels.iter().filter_map(|c| c.column.zip(c.errors.as_ref()));
        let worst = held.reduce(|a, b| if b.1.max > a.1.max { b } else { a });
        let (max, at) = worst.map_or((f64::INFINITY, None), |(c, e)| (e.max, Some((c, e.at.clone()))));
        let plain = Plain { convention, untold, options, texels: [all; 2], max, at, encoding: Some(self) };
        Audit { plain: Some(plain), fixed: stored.fixed, ..read }
    }
}

/// The encoding of a table that fits nothing as it is stored, but does when its values are decoded; none
/// if it does not.
pub(super) fn found(
    case: &Case,
    quantity: &dyn Quantity,
    done: &Audit,
) -> Result<Option<&'static Encoding>, AuditError> {
    let fixed = case.fixed;
    let said = fixed.meanings.as_ref().map(Vec::len);
    if done.fit != Fit::None || case.table.size.len() > AXES || fixed.encoding.is_some() {
        return Ok(None);
    }
    for encoding in &ENCODINGS {
        let Some(linear) = encoding.undone(case.table) else { continue };
        let Ok(live) = linear.live(said) else { continue };
        if said.is_some_and(|said| said != live.len()) {
            continue;
        }
        let case = Case { table: &linear, live: &live, fixed, progress: &|_| () };
        let likely: Vec<usize> = promising(&case, quantity)?.into_iter().map(|place| live[place]).collect();
        // A channel of another quantity does not condemn the others.
        let some = said.is_none() && likely.len() > 1;
        let all = likely.len() == live.len() || some;
        if all && follows(&Case { live: &likely, ..case }, quantity)?
            || some && apart::following(&Case { live: &likely, ..case }, quantity)?.len() > 1
        {
            return Ok(Some(encoding));
        }
    }
    Ok(None)
}

/// Whether a table follows a convention, as far as some of its texels tell.
pub(super) fn follows(case: &Case, quantity: &dyn Quantity) -> Result<bool, AuditError> {
    Ok(best(case, quantity)?.is_some_and(|best| best.off <= FITS))
}
