//! What stands at the top of a source: functions, declarations, and what each of them names.

use std::collections::BTreeSet;

use super::ShaderLanguage;
use crate::foreign::text::{Lexer, Token};

/// A name in an item.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Word {
    /// Its first byte.
    pub at: usize,
    pub text: String,
    /// How many arguments follow in a bracket, if a bracket follows.
    pub called: Option<usize>,
}

/// A function, or a declaration outside of functions.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Item {
    /// First byte, and the one after the last.
    pub range: [usize; 2],
    /// The function, or what is declared.
    pub names: Vec<String>,
    /// Whether it is a function, with its body or without.
    pub function: bool,
    /// Whether it has a body.
    pub body: bool,
    /// Words of its arguments, of a function.
    pub parameters: Vec<Vec<String>>,
    /// Whether it writes to an argument that its caller reads.
    pub outs: bool,
    /// Whether it declares a variable that functions may write to.
    pub variable: bool,
    /// Names that it holds and does not declare itself, in order; no members of structures.
    pub words: Vec<Word>,
}

/// Words before a name that do not declare it.
const PLAIN: [&str; 27] = [
    "return",
    "else",
    "case",
    "do",
    "const",
    "static",
    "in",
    "out",
    "inout",
    "highp",
    "mediump",
    "lowp",
    "precise",
    "uniform",
    "struct",
    "inline",
    "flat",
    "smooth",
    "varying",
    "attribute",
    "invariant",
    "centroid",
    "shared",
    "groupshared",
    "noperspective",
    "extern",
    "fn",
];

impl Item {
    /// The item in a text that holds its own from a byte on.
    pub fn moved(mut self, by: usize) -> Item {
        self.range = self.range.map(|at| at + by);
        self.words.iter_mut().for_each(|word| word.at += by);
        self
    }

    /// The name of a function.
    pub fn name(&self) -> &str {
        self.names.first().map_or("", String::as_str)
    }

    /// Whether it declares a uniform.
    pub fn is_uniform(&self) -> bool {
        !self.function && self.words.iter().any(|word| word.text == "uniform")
    }

    /// Whether it reads a texture, or declares one.
    pub fn reads_texture(&self) -> bool {
        self.words.iter().any(|word| {
            let bare = word.text.trim_start_matches(['i', 'u']);
            let kinds = ["sampler", "image", "texture", "mage", "Texture", "RWTexture"];
            let kind = kinds.iter().find_map(|k| bare.strip_prefix(k));
            let of_kind = ["1D", "2D", "3D", "Cube", "Buffer"];
            kind.is_some_and(|rest| of_kind.iter().any(|k| rest.starts_with(k)))
                || matches!(word.text.as_str(), "SamplerState" | "SamplerComparisonState")
                || word.called.is_some()
                    && ["texture", "texel", "imageLoad", "tex2D", "tex3D", "texCUBE"]
                        .iter()
                        .any(|k| word.text.starts_with(k))
        })
    }

    /// The name and the types of the arguments, as an overload is named.
    pub fn signature(&self) -> String {
        format!("{}({})", self.name(), self.types().join(", "))
    }

    /// Types of the arguments.
    pub fn types(&self) -> Vec<&str> {
        let own = |words: &Vec<String>| words.iter().position(|w| !PLAIN.contains(&w.as_str())).unwrap_or(0);
        self.parameters.iter().map(|words| words.get(own(words)).map_or("", String::as_str)).collect()
    }
}

/// The items of a source, in order, each once; those that brackets do not close are left out.
pub(super) fn items(text: &str, language: ShaderLanguage) -> Vec<Item> {
    // A file that is included twice says the same twice.
    let mut seen = BTreeSet::new();
    let new = |item: &Item| {
        let [start, end] = item.range;
        seen.insert(text[start..end].split_whitespace().collect::<String>())
    };
    let parts = split(text, language);
    parts.iter().map(|tokens| Part { tokens, language }.item()).filter(new).collect()
}

type Tokens<'a> = Vec<(usize, Token<'a>)>;

/// The tokens of every item.
fn split(text: &str, language: ShaderLanguage) -> Vec<Tokens<'_>> {
    let mut lexer = Lexer::new(text, "");
    let (mut found, mut open): (Vec<Tokens>, Tokens) = (Vec::new(), Vec::new());
    let mut depth = 0_usize;
    while let Some((at, token)) = lexer.next() {
        if open.is_empty() && matches!(token, Token::Mark(b';') | Token::Close(_)) {
            continue;
        }
        if token == Token::Open(b'{')
            && depth == 0
            && matches!(open.first(), Some((_, Token::Word("namespace"))))
        {
            // What is inside stands at the top, and its closing brace closes nothing.
            open.clear();
            continue;
        }
        open.push((at, token));
        match token {
            Token::Open(_) => depth += 1,
            Token::Close(_) => depth = depth.saturating_sub(1),
            _ => {}
        }
        let ends = |open| match token {
            Token::Mark(b';') => true,
            Token::Close(b'}') => Part { tokens: open, language }.ends_with_brace(),
            _ => false,
        };
        if depth == 0 && ends(&open) {
            found.push(std::mem::take(&mut open));
        }
    }
    found
}

/// The tokens of one item.
struct Part<'a> {
    tokens: &'a [(usize, Token<'a>)],
    language: ShaderLanguage,
}

/// What a declaration of WGSL begins with.
const DECLARES: [&str; 7] = ["fn", "struct", "const", "override", "let", "var", "alias"];

/// What stands before a bracket and is no function.
const NO_FUNCTION: [&str; 7] = ["layout", "if", "while", "for", "register", "packoffset", "switch"];

impl<'a> Part<'a> {
    fn token(&self, k: usize) -> Option<Token<'a>> {
        self.tokens.get(k).map(|t| t.1)
    }

    fn before(&self, k: usize) -> Option<Token<'a>> {
        k.checked_sub(1).and_then(|k| self.token(k))
    }

    fn word(&self, k: usize) -> Option<&'a str> {
        if let Some(Token::Word(word)) = self.token(k) { Some(word) } else { None }
    }

    /// Tokens outside of brackets, the brackets themselves among them.
    fn outside(&self) -> impl Iterator<Item = usize> {
        let mut depth = 0_usize;
        let mut outer = Vec::new();
        for (k, (_, token)) in self.tokens.iter().enumerate() {
            if let Token::Close(_) = token {
                depth = depth.saturating_sub(1);
            }
            if depth == 0 {
                outer.push(k);
            }
            if let Token::Open(_) = token {
                depth += 1;
            }
        }
        outer.into_iter()
    }

    /// Where a declaration of WGSL has its keyword.
    fn keyword(&self) -> Option<usize> {
        self.outside().find(|k| self.word(*k).is_some_and(|w| DECLARES.contains(&w)))
    }

    /// Where the name of a function stands, if it is one.
    fn function(&self) -> Option<usize> {
        if self.language == ShaderLanguage::Wgsl {
            return self.keyword().filter(|k| self.word(*k) == Some("fn")).map(|k| k + 1);
        }
        let before_value = self.outside().take_while(|k| self.token(*k) != Some(Token::Mark(b'=')));
        let called = |k: &usize| {
            let word = self.word(*k).is_some_and(|w| !NO_FUNCTION.contains(&w));
            word && self.token(k + 1) == Some(Token::Open(b'('))
        };
        before_value.filter(called).find(|k| *k > 0)
    }

    /// Whether the brace that closes ends the item.
    fn ends_with_brace(&self) -> bool {
        let valued = || self.outside().any(|k| self.token(k) == Some(Token::Mark(b'=')));
        match self.language {
            ShaderLanguage::Glsl => self.function().is_some(),
            ShaderLanguage::Wgsl => {
                let word = self.keyword().and_then(|k| self.word(k));
                matches!(word, Some("fn" | "struct"))
            }
            ShaderLanguage::Hlsl => !valued(),
        }
    }

    fn item(&self) -> Item {
        let function = self.function();
        let last = self.tokens.last().map_or(0, |t| t.0 + 1);
        let parameters = function.map_or(Vec::new(), |k| self.parameters(k + 1));
        let locals = self.locals();
        let mut words = self.words();
        words.retain(|w| w.called.is_some() || !locals.contains(w.text.as_str()));
        let names = match function {
            Some(k) => self.word(k).map(String::from).into_iter().collect(),
            None => self.declared(),
        };
        // A function does not call itself: its own name is none that it needs.
        let own = function.map_or(usize::MAX, |k| self.tokens[k].0);
        words.retain(|w| w.at != own);
        let holds = |word: &str| words.iter().any(|w| w.text == word);
        let fixed = ["const", "uniform", "in", "struct", "precision", "varying", "attribute", "cbuffer"];
        let outs = parameters.iter().flatten().any(|w| w == "out" || w == "inout");
        Item {
            range: [self.tokens.first().map_or(0, |t| t.0), last],
            function: function.is_some(),
            body: function.is_some() && self.outside().any(|k| self.token(k) == Some(Token::Open(b'{'))),
            variable: function.is_none() && !fixed.iter().any(|w| holds(w)),
            names,
            parameters,
            outs,
            words,
        }
    }

    /// Words of every argument between the bracket at a token and its end; of WGSL those of its
    /// type.
    fn parameters(&self, open: usize) -> Vec<Vec<String>> {
        let mut list: Vec<Vec<String>> = vec![Vec::new()];
        let mut depth = 0_usize;
        for (_, token) in &self.tokens[open.min(self.tokens.len())..] {
            match token {
                Token::Open(_) => depth += 1,
                Token::Close(_) if depth == 1 => break,
                Token::Close(_) => depth -= 1,
                Token::Mark(b',') if depth == 1 => list.push(Vec::new()),
                Token::Mark(b':') if self.language == ShaderLanguage::Wgsl => {
                    list.pop();
                    list.push(Vec::new());
                }
                Token::Word(word) => list.last_mut().into_iter().for_each(|l| l.push(word.to_string())),
                _ => {}
            }
        }
        list.retain(|words| !words.is_empty() && words != &["void"]);
        list
    }

    /// Names that are declared inside: after a type, or, in WGSL, after `let` and before `:`.
    fn locals(&self) -> BTreeSet<&'a str> {
        let outer: BTreeSet<usize> = self.outside().collect();
        let wgsl = self.language == ShaderLanguage::Wgsl;
        let declared = |k: &usize| match self.before(*k) {
            Some(Token::Word(before)) if wgsl => matches!(before, "let" | "var" | "const"),
            Some(Token::Word(before)) => !PLAIN.contains(&before),
            _ => wgsl && self.token(k + 1) == Some(Token::Mark(b':')),
        };
        let inner = (0..self.tokens.len()).filter(|k| !outer.contains(k));
        inner.filter(declared).filter_map(|k| self.word(k)).collect()
    }

    /// Names that a declaration outside of functions declares.
    fn declared(&self) -> Vec<String> {
        if self.language == ShaderLanguage::Wgsl {
            let Some(k) = self.keyword() else { return Vec::new() };
            // `var<private> x`.
            let words = self.outside().filter(|i| *i > k && self.word(*i).is_some());
            let mut named = words.filter(|i| self.before(*i) != Some(Token::Mark(b'<')));
            return named.next().and_then(|i| self.word(i)).map(String::from).into_iter().collect();
        }
        let (mut names, mut valued) = (Vec::new(), false);
        let precision = self.word(0) == Some("precision");
        for k in self.outside().filter(|_| !precision) {
            let token = self.token(k);
            let after = matches!(
                self.before(k),
                Some(Token::Word(_) | Token::Mark(b',' | b'>') | Token::Close(b'}' | b']'))
            );
            let ends = matches!(
                self.token(k + 1),
                Some(Token::Mark(b'=' | b',' | b';' | b':') | Token::Open(b'[' | b'{'))
            );
            match token {
                Some(Token::Mark(b'=')) => valued = true,
                Some(Token::Mark(b',')) => valued = false,
                Some(Token::Word(word)) if after && ends && !valued => names.push(word.to_string()),
                _ => {}
            }
        }
        names
    }

    /// All names but members, with the number of arguments of those that are called.
    fn words(&self) -> Vec<Word> {
        struct Bracket {
            word: Option<usize>,
            commas: usize,
            filled: bool,
        }
        let (mut words, mut brackets): (Vec<Word>, Vec<Bracket>) = (Vec::new(), Vec::new());
        for (k, (at, token)) in self.tokens.iter().enumerate() {
            match token {
                Token::Close(_) => {
                    if let Some(Bracket { word: Some(word), commas, filled }) = brackets.pop() {
                        words[word].called = Some(if filled { commas + 1 } else { 0 });
                    }
                    continue;
                }
                Token::Mark(b',') => brackets.last_mut().map_or((), |b| b.commas += 1),
                _ => brackets.last_mut().map_or((), |b| b.filled = true),
            }
            match token {
                Token::Word(word) if self.before(k) != Some(Token::Mark(b'.')) => {
                    words.push(Word { at: *at, text: word.to_string(), called: None });
                }
                Token::Open(kind) => {
                    let own = |word: &usize| k > 0 && words[*word].at == self.tokens[k - 1].0;
                    let word = words.len().checked_sub(1).filter(|_| *kind == b'(').filter(own);
                    brackets.push(Bracket { word, commas: 0, filled: false });
                }
                _ => {}
            }
        }
        words
    }
}
