//! Words that languages have taken, as far as a WGSL identifier can be one.

/// The words of a language.
pub(super) struct Words {
    /// Keywords, reserved words, types, macros, and the functions that printed code calls: nothing
    /// may be named so.
    pub reserved: &'static str,
    /// Functions of the language: a variable may be named so, a function may not.
    pub functions: &'static str,
    /// Stems of the vector and matrix types: with a digit or two they are types.
    pub stems: &'static str,
    /// Whether words are taken in capitals too.
    pub any_case: bool,
    /// A name as the language can have it.
    pub spelled: fn(&str) -> String,
}

impl Words {
    /// Whether no variable may be named so.
    pub fn takes(&self, name: &str) -> bool {
        let lower = if self.any_case { name.to_ascii_lowercase() } else { name.to_string() };
        let same = |word: &str| if self.any_case { word.eq_ignore_ascii_case(name) } else { word == name };
        self.reserved.split_whitespace().any(same) || self.is_type(&lower)
    }

    /// Whether no function may be named so.
    pub fn takes_function(&self, name: &str) -> bool {
        self.takes(name) || self.functions.split_whitespace().any(|word| word == name)
    }

    /// float3, mat2x4: a stem, and one digit or two about an x.
    fn is_type(&self, name: &str) -> bool {
        let size = |s: &str| s.len() == 1 && ("1"..="4").contains(&s);
        let sized = |rest: &str| size(rest) || rest.split_once('x').is_some_and(|(a, b)| size(a) && size(b));
        self.stems.split_whitespace().any(|stem| name.strip_prefix(stem).is_some_and(sized))
    }
}
