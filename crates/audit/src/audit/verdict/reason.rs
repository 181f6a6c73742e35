//! Why a verdict is no PASS.

use crate::audit::{Audit, Declared, Fit, Source};

/// Which of the figures is over the limit, or what else is wrong.
pub(crate) fn reason(done: &Audit, limit: Option<f64>) -> String {
    let function = done.source == Source::Function;
    if let (Fit::Whole, None) = (done.fit, limit) {
        return match &done.plain {
            Some(plain) => {
                format!("no reader assumes {} unless the file says so", plain.untold.join(", or "))
            }
            None => "something about it is to be mended".into(),
        };
    }
    let Some(limit) = limit.filter(|_| done.fit == Fit::Whole) else {
        let given = if done.fixed { " that the options leave open" } else { "" };
        let limit = limit.map_or(String::new(), |limit| format!(", the limit is {limit:e}"));
        let off = format!("; by the nearest it is off by {:.3e}{limit}", done.worst());
        return match (function, &done.two_lobes) {
            (_, Some(_)) => format!("a part of the table is of another shadowing form{off}"),
            (true, None) => format!("it follows no reading of its arguments{given}{off}"),
            (false, None) => format!("it fits no convention{given}{off}"),
        };
    };
    let places = if function { "at the points judged" } else { "at a texel" };
    let (what, worst) = match done.furnace_error() {
        Some(error) => ("furnace error |E N - 1|", error),
        None => ("error", done.worst()),
    };
    if worst > limit {
        let domain = if function { "; --domain judges it where it is meant to hold" } else { "" };
        return format!("the largest {what} {places} is {worst:.3e}, the limit {limit:e}{domain}");
    }
    match &done.plain {
        Some(plain) if only_plain_exceeds(done, limit) => format!(
            "read plainly the largest error {places} is {:.3e}, the limit {limit:e}; it is {:.3e} only with {}, which no reader assumes unless \
             the file says so: make it again, or if it is meant so give {}",
            plain.max,
            done.worst(),
            plain.untold.join(", and "),
            plain.options
        ),
        _ => done.unjudged().unwrap_or_default(),
    }
}

/// Whether a limit is kept by a table or function as it is best read, and not by it read plainly.
pub(super) fn only_plain_exceeds(done: &Audit, limit: f64) -> bool {
    done.fit == Fit::Whole && done.worst() <= limit && done.plain.as_ref().is_some_and(|p| p.max > limit)
}

/// The same of a file that says what it is.
pub(crate) fn of_stated(said: &Declared, limit: Option<f64>) -> String {
    let worst = said.worst();
    match limit.filter(|_| said.holds()) {
        Some(limit) if worst <= limit => format!(
            "the file itself claims an error of {:e} at most, the limit is {limit:e}; here it is {worst:.3e}",
            said.claimed
        ),
        Some(limit) => format!(
            "looked up as the file says, at texels and between them, the largest error is {worst:.3e}, the limit {limit:e}"
        ),
        None if said.keeps() => {
            format!("the file is not what it says: its error is {worst:.3e}, however much it claims")
        }
        None => format!(
            "the file is not what it says: it claims an error of {:e} at most, it is {worst:.3e}",
            said.claimed
        ),
    }
}
