//! Brackets while a text is scanned, and the literals that they become.

use crate::foreign::limits;

/// An array literal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Literal {
    /// Byte where the statement around it begins.
    pub statement: usize,
    /// Byte of its outermost bracket.
    pub open: usize,
    /// Byte after its last bracket.
    pub end: usize,
    /// Its numbers.
    pub values: Vec<f64>,
    /// Entries of each bracket, outermost first.
    pub shape: Vec<usize>,
    /// The innermost brackets are those of vectors: `float3(...)`.
    pub vectors: bool,
    /// Most digits printed after a decimal point; none if all are integers.
    pub decimals: Option<u32>,
    /// All are hexadecimal.
    pub hex: bool,
    /// Where the first bracket ends that holds other entries than those before it, and how they
    /// differ.
    pub mixed: Option<(usize, String)>,
}

/// An open bracket.
pub(super) struct Frame {
    /// The literal that it is, so far as it is known: without its end and its numbers. The shape is
    /// empty while there is no entry.
    pub list: Literal,
    /// The bracket, or 0 for the text itself.
    pub bracket: u8,
    /// Byte where the statement at hand begins, inside it.
    pub statement: usize,
    /// Its entries are the components of a vector.
    pub vector: bool,
    /// It is the size of a type, not a list.
    pub of_type: bool,
    /// It holds nothing but numbers so far.
    pub pure: bool,
    /// An entry may stand here: at the start, after a comma, and anywhere once it is not pure.
    pub free: bool,
    /// An odd number of minus signs stands before here.
    pub negative: bool,
    /// Index of its first number.
    pub first: usize,
    /// Complete lists inside it, which are literals if it is none: with the range of their numbers.
    pub inside: Vec<(Literal, usize, usize)>,
}

impl Frame {
    /// A bracket that opens at byte `open` in a statement that begins at `lead`.
    pub fn new(open: usize, lead: usize, bracket: u8) -> Frame {
        let list = Literal {
            statement: lead,
            open,
            end: 0,
            values: Vec::new(),
            shape: Vec::new(),
            vectors: false,
            decimals: None,
            hex: true,
            mixed: None,
        };
        Frame {
            list,
            bracket,
            statement: open + usize::from(bracket != b'0'),
            vector: false,
            of_type: false,
            pure: true,
            free: true,
            negative: false,
            first: 0,
            inside: Vec::new(),
        }
    }

    /// Whether a closing bracket closes it.
    pub fn closes_with(&self, close: u8) -> bool {
        matches!((self.bracket, close), (b'(', b')') | (b'[', b']') | (b'{', b'}'))
    }

    /// Counts an entry of the given shape that ends at a byte.
    pub fn entry(&mut self, at: usize, shape: &[usize], vectors: bool) {
        let list = &mut self.list;
        match &mut list.shape[..] {
            [] => {
                list.shape = [&[1], shape].concat();
                list.vectors = if shape.is_empty() { self.vector } else { vectors };
            }
            [count, inner @ ..] => {
                *count += 1;
                if inner != shape && list.mixed.is_none() {
                    let words = |shape: &[usize]| match shape {
                        [] => "a number".to_string(),
                        shape => format!("a bracket of {}", crate::foreign::shape::words(shape)),
                    };
                    let message = format!(
                        "entry {} is {}, the entries before it are each {}",
                        *count - 1,
                        words(shape),
                        words(inner)
                    );
                    list.mixed = Some((at, message));
                }
            }
        }
    }

    /// Takes a complete bracket, closed at byte `at`, as an entry; its numbers end at index `end`.
    pub fn take(&mut self, frame: &Frame, end: usize, at: usize) {
        self.free = false;
        self.list.decimals = self.list.decimals.max(frame.list.decimals);
        self.list.hex &= frame.list.hex;
        self.entry(at, &frame.list.shape, frame.list.vectors);
        if self.list.mixed.is_none() {
            self.list.mixed = frame.list.mixed.clone();
        }
        if end - frame.first >= limits::ARRAY_MIN && self.inside.len() <= INSIDE {
            self.inside.push((frame.literal(at + 1), frame.first, end));
        }
    }

    /// The literal that it is, without its numbers.
    pub fn literal(&self, end: usize) -> Literal {
        Literal { end, ..self.list.clone() }
    }
}

/// Most lists of a bracket that are remembered in case it turns out to be no list itself.
const INSIDE: usize = 4096;
