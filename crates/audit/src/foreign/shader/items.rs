//! What stands at the top of a GLSL source: functions, declarations, and what each of them names.

use crate::foreign::text::{Lexer, Token};

/// A function, or a declaration outside of functions.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Item {
    /// First byte, and the one after the last.
    pub range: [usize; 2],
    /// The function, or the variable declared last; empty for what names nothing.
    pub name: String,
    /// Whether it is a function, with its body or without.
    pub function: bool,
    /// Whether it writes to an argument that its caller reads.
    pub outs: bool,
    /// Whether it declares a variable that functions may write to.
    pub variable: bool,
    /// Names that it holds, in order, with the byte where each begins, and whether a bracket of
    /// arguments follows.
    pub words: Vec<(usize, String, bool)>,
}

impl Item {
    /// Whether it names something.
    pub fn names(&self, word: &str) -> bool {
        self.words.iter().any(|(_, w, _)| w == word)
    }

    /// Whether it reads a texture, or declares one.
    pub fn reads_texture(&self) -> bool {
        self.words.iter().any(|(_, word, called)| {
            let bare = word.trim_start_matches(['i', 'u']);
            let kind = ["sampler", "image", "texture", "mage"].iter().find_map(|k| bare.strip_prefix(k));
            let of_kind = ["1D", "2D", "3D", "Cube", "Buffer"];
            kind.is_some_and(|rest| of_kind.iter().any(|k| rest.starts_with(k)))
                || *called
                    && (word.starts_with("texture")
                        || word.starts_with("texel")
                        || word.starts_with("imageLoad"))
        })
    }
}

/// The items of a source, in order; those that brackets do not close are left out.
pub(super) fn items(text: &str) -> Vec<Item> {
    let mut lexer = Lexer::new(text, "");
    let (mut found, mut item, mut begun) = (Vec::new(), Item::default(), false);
    let (mut depth, mut before, mut body) = (0_usize, Token::Mark(b';'), false);
    while let Some((at, token)) = lexer.next() {
        if !begun {
            (item, begun, body) = (Item { range: [at, at], ..Item::default() }, true, false);
        }
        note(&mut item, at, token, before, depth);
        let mut ends = false;
        match token {
            Token::Open(b'{') if depth == 0 => {
                body = before == Token::Close(b')') && item.function;
                depth = 1;
            }
            Token::Open(_) => depth += 1,
            Token::Close(kind) => {
                depth = depth.saturating_sub(1);
                ends = depth == 0 && kind == b'}' && body;
            }
            Token::Mark(b';') => ends = depth == 0,
            _ => {}
        }
        before = token;
        if ends {
            item.range[1] = at + 1;
            let fixed = ["const", "uniform", "in", "struct", "precision", "varying", "attribute"];
            item.variable = !item.function && !fixed.iter().any(|w| item.names(w));
            found.push(std::mem::take(&mut item));
            begun = false;
        }
    }
    found
}

/// Takes note of a token; `before` stands before it, inside `depth` brackets.
fn note(item: &mut Item, at: usize, token: Token, before: Token, depth: usize) {
    match (token, before) {
        (Token::Open(b'('), Token::Word(name)) => {
            if let Some(last) = item.words.last_mut() {
                last.2 = true;
            }
            if depth == 0
                && !item.function
                && item.name.is_empty()
                && !["layout", "if", "while", "for"].contains(&name)
            {
                (item.function, item.name) = (true, name.to_string());
            }
        }
        // Initial values of a variable are calls, not functions.
        (Token::Mark(b'='), _) if depth == 0 && item.name.is_empty() => {
            item.name = item.words.last().map_or(String::new(), |w| w.1.clone());
        }
        (Token::Mark(b';'), Token::Word(name)) if depth == 0 && item.name.is_empty() => {
            item.name = name.to_string();
        }
        _ => {}
    }
    if let Token::Word(word) = token {
        item.outs |= item.function && depth == 1 && matches!(word, "out" | "inout");
        item.words.push((at, word.to_string(), false));
    }
}

/// The text with blanks for the `const` of `const in` arguments, which the front end does not know,
/// and which says nothing of values.
pub(super) fn plain_arguments(text: &str) -> String {
    let mut lexer = Lexer::new(text, "");
    let (mut before, mut out, mut from) = (None, String::with_capacity(text.len()), 0);
    while let Some((at, token)) = lexer.next() {
        if let (Some(start), Token::Word("in")) = (before, token) {
            out.push_str(&text[from..start]);
            out.push_str("     ");
            from = start + "const".len();
        }
        before = (token == Token::Word("const")).then_some(at);
    }
    out + &text[from..]
}

/// The byte of something on the right of `&&` or `||` that changes what others read, within a
/// range, with its name: GLSL makes it only where the left side asks for it, the front end always.
pub(super) fn eager(text: &str, range: [usize; 2], writes: &dyn Fn(&str) -> bool) -> Option<(usize, String)> {
    let text = &text[range[0]..range[1]];
    let bytes = text.as_bytes();
    let pair = |at: usize, c: u8| bytes.get(at) == Some(&c) && bytes.get(at + 1) == Some(&c);
    let mut lexer = Lexer::new(text, "");
    // Depth of brackets at each operator on whose right side the token at hand stands.
    let (mut depth, mut right): (usize, Vec<usize>) = (0, Vec::new());
    let mut last: Option<(usize, &str)> = None;
    while let Some((at, token)) = lexer.next() {
        let inside = !right.is_empty();
        match token {
            Token::Mark(c @ (b'&' | b'|')) if pair(at, c) => right.push(depth),
            Token::Mark(b';') => right.clear(),
            Token::Mark(b',' | b'?' | b':') => right.retain(|d| *d < depth),
            Token::Mark(c @ (b'+' | b'-')) if inside && pair(at, c) => {
                return Some((range[0] + at, "an assignment".into()));
            }
            Token::Mark(b'=') if inside && !compares(bytes, at) => {
                return Some((range[0] + at, "an assignment".into()));
            }
            Token::Open(kind) => {
                if let (b'(', true, Some((at, name))) = (kind, inside, last)
                    && writes(name)
                {
                    return Some((
                        range[0] + at,
                        format!("a call of {name}, which writes variables of others,"),
                    ));
                }
                depth += 1;
            }
            Token::Close(_) => {
                depth = depth.saturating_sub(1);
                right.retain(|d| *d <= depth);
            }
            _ => {}
        }
        last = if let Token::Word(name) = token { Some((at, name)) } else { None };
    }
    None
}

/// Whether `=` at a byte is of `==`, `!=`, `<=` or `>=`, and not of an assignment, as it is in
/// `<<=`.
fn compares(bytes: &[u8], at: usize) -> bool {
    let before = |k: usize| at.checked_sub(k).map(|i| bytes[i]);
    match before(1) {
        Some(b'=' | b'!') => true,
        Some(c @ (b'<' | b'>')) => before(2) != Some(c),
        _ => bytes.get(at + 1) == Some(&b'='),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_and_variables_are_told_apart() {
        let text = "#define A(x) { (x\nprecision highp float; uniform sampler2D lut;\nfloat g = max(1.0, 2.0), h;\nconst vec2 c[2] = vec2[2](vec2(0.), vec2(1.));\n\
             struct S { float x; };\nfloat f(float x, out float y);\nfloat f(float x, out float y) { if (x > 0.) { y = 1.; } return texture(lut, vec2(x)).x; }\nvoid main() {}";
        let found = items(text);
        let names: Vec<(&str, bool)> = found.iter().map(|i| (i.name.as_str(), i.function)).collect();
        let wanted = [
            ("float", false),
            ("lut", false),
            ("g", false),
            ("c", false),
            ("", false),
            ("f", true),
            ("f", true),
            ("main", true),
        ];
        assert_eq!(names, wanted);
        assert!(found[6].outs && found[6].reads_texture() && !found[7].reads_texture());
        assert!(found[1].reads_texture() && found[2].variable && !found[3].variable);
        assert!(text[found[6].range[0]..found[6].range[1]].ends_with("x; }"));
    }

    #[test]
    fn what_a_right_side_changes_is_found() {
        let found = |text: &str| eager(text, [0, text.len()], &|name| name == "set").map(|f| f.0);
        assert_eq!(found("b = a && set(x); c = set(y);"), Some(9));
        assert_eq!(found("b = set(x) && a; set(y);"), None);
        assert_eq!(found("b = (a || c) ? set(x) : d;"), None);
        assert_eq!(found("f(a && c, set(x)); if (a || c) { x = 1.0; }"), None);
        assert_eq!(found("b = a || (c && x++ > 1);"), Some(16));
        assert_eq!(found("b = a && (x = 2.0) > c;"), Some(12));
        assert_eq!(found("b = a && c <= d && c == e && c != e && c >= e;"), None);
        assert_eq!(found("b = a && (k <<= 1) > 2;"), Some(14));
        assert_eq!(found("b = a && (k >>= 1) > 2;"), Some(14));
        assert_eq!(found("b = a && (k |= 1) > 2;"), Some(13));
    }
}
