//! The order of names that people read: digits by their number, so that `a_2` stands before `a_10`.

use std::cmp::Ordering;

/// How two names are ordered.
///
/// ```
/// let mut names = ["a_10", "a_2", "a", "a_1_log"];
/// names.sort_by(|a, b| lobefit::data::natural(a, b));
/// assert_eq!(names, ["a", "a_1_log", "a_2", "a_10"]);
/// ```
pub fn natural(a: &str, b: &str) -> Ordering {
    let (mut one, mut other) = (a, b);
    while let (Some(x), Some(y)) = (one.chars().next(), other.chars().next()) {
        let (number, beside) = (digits(one), digits(other));
        let order = if number.is_empty() || beside.is_empty() {
            (one, other) = (&one[x.len_utf8()..], &other[y.len_utf8()..]);
            x.cmp(&y)
        } else {
            (one, other) = (&one[number.len()..], &other[beside.len()..]);
            let (number, beside) = (number.trim_start_matches('0'), beside.trim_start_matches('0'));
            number.len().cmp(&beside.len()).then_with(|| number.cmp(beside))
        };
        if order.is_ne() {
            return order;
        }
    }
    one.len().cmp(&other.len()).then_with(|| a.cmp(b))
}

/// The digits that a text begins with.
fn digits(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    &text[..end]
}
