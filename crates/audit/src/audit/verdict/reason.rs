//! Why a verdict is no PASS, where its first line does not say so.

use super::figure::damage;
use super::points::{has_unknown, is_ambiguous, is_loose};
use super::words::{excluded, number};
use crate::audit::{Audit, FUNCTION_FITS, Fit, Source};

/// Which of the figures is over the limit, or what else is wrong.
pub(crate) fn reason(done: &Audit, limit: Option<f64>) -> Option<String> {
    let function = done.source == Source::Function;
    let is_loose = limit.is_none() && is_loose(done);
    if done.misread(limit).is_some() && !is_loose {
        return None;
    }
    if limit.is_none() && is_ambiguous(done) {
        let (next, options) = match done.source {
            Source::Function => ("reading", "--axes and --smith say"),
            Source::Table => ("convention", "--axes, --registration and --smith say"),
        };
        return Some(format!(
            "another {next} fits nearly as well, and its own not closely: {options} what is meant"
        ));
    }
    if is_loose {
        let (why, options) = match done.source {
            Source::Function => (
                "its errors are larger than those of approximations are, so that it may be of something else",
                "",
            ),
            Source::Table => (
                "its errors are larger than those of tables that follow it, and neither noise nor rounding explains them",
                ", --samples of how many samples it is, --axes, --registration and --smith what is meant",
            ),
        };
        return Some(format!("{why}: --limit says what is allowed{options}"));
    }
    if limit.is_none() && has_unknown(done) {
        return done.unjudged();
    }
    if let (Fit::Whole, None) = (done.fit, limit) {
        // The first line of a table has its damage, that of a function its error.
        return damage(done).filter(|_| function).map(|told| format!("it{}", told.found));
    }
    if done.misfit().is_some() {
        let left = number(done.channels.iter().map(|c| c.left).fold(0.0, f64::max));
        return Some(format!(
            "its root mean square error is {left} of what the truth spans, where approximations leave {FUNCTION_FITS} at most"
        ));
    }
    let Some(limit) = limit.filter(|_| done.fit == Fit::Whole) else {
        let given = if done.fixed { " that the options leave open" } else { "" };
        let limit = limit.map_or(String::new(), |limit| format!(", the limit is {}", number(limit)));
        let off = format!("; by the nearest it is off by {}{limit}", number(done.worst()));
        if let Some(said) = excluded(done) {
            return Some(format!("it follows a convention, but not what {said}{off}"));
        }
        return Some(match (function, &done.two_lobes, done.fit) {
            (_, Some(_), _) => format!("a part of the table is of another shadowing form{off}"),
            (true, None, _) => format!("it follows no reading of its arguments{given}{off}"),
            (false, None, Fit::Part) => format!("a part of it fits no convention{given}{off}"),
            (false, None, _) => format!("it fits no convention{given}{off}"),
        });
    };
    let places = if function { "at the points judged" } else { "at a texel" };
    let (what, worst) = match done.furnace_error() {
        Some(error) => ("furnace error |E N - 1|", error),
        None => ("error", done.worst()),
    };
    let limit_text = number(limit);
    if worst > limit {
        let domain = if function { "; --domain judges it where it is meant to hold" } else { "" };
        return Some(format!(
            "the largest {what} {places} is {}, the limit {limit_text}{domain}",
            number(worst)
        ));
    }
    done.unjudged()
}
