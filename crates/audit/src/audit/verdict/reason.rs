//! Why a verdict is no PASS.

use super::figure::damage;
use super::words::number;
use crate::audit::{Audit, Fit, Source};

/// Which of the figures is over the limit, or what else is wrong.
pub(crate) fn reason(done: &Audit, limit: Option<f64>) -> String {
    let function = done.source == Source::Function;
    if let (Fit::Whole, None) = (done.fit, limit) {
        return match done.misread(None) {
            Some(plain) => {
                format!("no reader assumes {} unless the file says so", plain.untold.join(", or "))
            }
            None => damage(done).map_or_else(
                || "something about it is to be mended".into(),
                |told| format!("it{}", told.found),
            ),
        };
    }
    let Some(limit) = limit.filter(|_| done.fit == Fit::Whole) else {
        let given = if done.fixed { " that the options leave open" } else { "" };
        let limit = limit.map_or(String::new(), |limit| format!(", the limit is {}", number(limit)));
        let off = format!("; by the nearest it is off by {}{limit}", number(done.worst()));
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
    let limit_text = number(limit);
    if worst > limit {
        let domain = if function { "; --domain judges it where it is meant to hold" } else { "" };
        return format!("the largest {what} {places} is {}, the limit {limit_text}{domain}", number(worst));
    }
    match done.misread(Some(limit)) {
        Some(plain) => format!(
            "read plainly the largest error {places} is {}, the limit {limit_text}; it is {} only with {}, which no reader assumes unless the file \
             says so: make it again, or if it is meant so give {}",
            number(plain.max),
            number(done.worst()),
            plain.untold.join(", and "),
            plain.options
        ),
        None => done.unjudged().unwrap_or_default(),
    }
}
