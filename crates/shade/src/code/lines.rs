//! Statements that are too long for a line.

/// Longest line before a statement is broken up.
const WIDTH: usize = 100;

/// Part of a line that is filled before a place is good to break at, where there is one.
const FILLED: f64 = 0.4;

/// A place before a sign, or after a comma, and how many brackets are open there.
struct Place {
    at: usize,
    open: usize,
}

/// A statement, indented by `depth` steps. Too long for a line, it is broken before the signs of
/// its sums, outer sums before inner ones, or after commas; a line is indented by one step more for
/// each bracket that is open where it begins.
pub fn lines(statement: &str, depth: usize) -> String {
    let mut rest = statement;
    let mut open = 0;
    let mut indent = 4 * depth;
    let mut out = String::new();
    while indent + rest.len() > WIDTH {
        let Some(place) = best(rest, open, WIDTH.saturating_sub(indent)) else { break };
        let (line, next) = rest.split_at(place.at);
        out.push_str(&format!("{:indent$}{line}\n", ""));
        (rest, open) = (next.trim_start(), place.open);
        indent = 4 * (depth + 1 + open);
    }
    out + &format!("{:indent$}{rest}\n", "")
}

/// The outermost place that fits and fills the line somewhat, else the outermost that fits, else
/// the first; of several the last.
fn best(text: &str, open: usize, width: usize) -> Option<Place> {
    let places = places(text, open);
    let fits = places.iter().filter(|p| p.at <= width);
    let filled = fits.clone().filter(|p| p.at as f64 >= FILLED * width as f64);
    let outermost = |found: &mut dyn Iterator<Item = &Place>| {
        found.min_by_key(|p| (p.open, std::cmp::Reverse(p.at))).map(|p| Place { ..*p })
    };
    outermost(&mut filled.into_iter())
        .or_else(|| outermost(&mut fits.into_iter()))
        .or_else(|| places.into_iter().next())
}

fn places(text: &str, mut open: usize) -> Vec<Place> {
    let mut places = Vec::new();
    for (at, letter) in text.char_indices() {
        match letter {
            '(' | '[' | '{' => open += 1,
            ')' | ']' | '}' => open = open.saturating_sub(1),
            ' ' if at > 0 && (text[at..].starts_with(" + ") || text[at..].starts_with(" - ")) => {
                places.push(Place { at, open });
            }
            ',' if text[at..].starts_with(", ") => places.push(Place { at: at + 1, open }),
            _ => {}
        }
    }
    places
}
