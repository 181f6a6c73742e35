//! Names in ASCII that no other name takes.

/// `name`, or with an underscore and, if need be, a number after it, so that it is not taken.
pub(super) fn free(name: &str, taken: impl Fn(&str) -> bool) -> String {
    let stem = name.trim_end_matches('_');
    let numbered = (2..).map(|number| format!("{stem}_{number}"));
    let mut candidates = [name.to_string(), format!("{stem}_")].into_iter().chain(numbered);
    // Only finitely many names are taken.
    candidates.find(|candidate| !taken(candidate)).unwrap_or_default()
}

/// Names of the Greek letters from alpha and Alpha on; U+03C2 is the other form of sigma.
const GREEK: &str =
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma sigma
    tau upsilon phi chi psi omega";

/// A name in ASCII, as rustc warns of letters that look like others: Greek letters by their names,
/// other letters by their code points.
pub(super) fn ascii(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match greek(c) {
            Some(letter) => text.push_str(&letter),
            None if c.is_ascii() => text.push(c),
            None => text.push_str(&format!("u{:x}", u32::from(c))),
        }
    }
    text
}

/// A name in ASCII without what C's family keeps for itself: two underscores in a row, one before a
/// capital, and GLSL's `gl_`.
pub(super) fn plain(name: &str) -> String {
    let mut text = ascii(name);
    while text.contains("__") {
        text = text.replace("__", "_");
    }
    let capital = |c: char| c.is_ascii_uppercase();
    let kept = text.strip_prefix('_').is_some_and(|rest| rest.starts_with(capital));
    if kept || text.starts_with("gl_") { format!("v_{}", text.trim_start_matches('_')) } else { text }
}

fn greek(c: char) -> Option<String> {
    let named = |first: char| {
        let index = u32::from(c).checked_sub(u32::from(first))?;
        GREEK.split_whitespace().nth(index as usize)
    };
    if let Some(letter) = named('α') {
        return Some(letter.to_string());
    }
    let letter = named('Α')?;
    Some(format!("{}{}", letter[..1].to_ascii_uppercase(), &letter[1..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_plain_and_free() {
        for (name, expected) in [
            ("alpha", "alpha"),
            ("α2", "alpha2"),
            ("Ω", "Omega"),
            ("ς", "sigma"),
            ("größe", "gruf6udfe"),
            ("a__b___c", "a_b_c"),
            ("_Big", "v_Big"),
            ("_small", "_small"),
            ("gl_x", "v_gl_x"),
        ] {
            assert_eq!(plain(name), expected);
        }
        assert_eq!(free("box", |n| n == "box"), "box_");
        assert_eq!(free("mut_", |n| n == "mut_"), "mut_2");
        assert_eq!(free("x", |n| ["x", "x_", "x_2"].contains(&n)), "x_3");
    }
}
