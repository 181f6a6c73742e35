//! Text made of parts of files, of which every byte knows where it comes from: macros are expanded
//! and HLSL is rewritten, and messages name places of the files as they were given.

use crate::foreign::Spot;

/// A file that was read: the one that is audited, one that it includes, or our own text.
#[derive(Clone, Debug)]
pub(super) struct File {
    /// As messages name it.
    pub name: String,
    pub text: String,
}

/// A byte of a file, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Origin {
    pub file: usize,
    pub at: usize,
}

/// A part of a text whose bytes follow one another in a file, or all stand for one place of it.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// First byte in the text.
    start: usize,
    from: Origin,
    /// Whether its bytes are those of the file.
    copied: bool,
}

/// A text and where it comes from.
#[derive(Clone, Debug, Default)]
pub(super) struct Text {
    text: String,
    pieces: Vec<Piece>,
}

impl Text {
    pub fn as_str(&self) -> &str {
        &self.text
    }

    pub fn len(&self) -> usize {
        self.text.len()
    }

    /// Adds what a file holds from a byte on.
    pub fn copy(&mut self, part: &str, from: Origin) {
        let follows = self.pieces.last().is_some_and(|piece| {
            piece.copied
                && piece.from.file == from.file
                && piece.from.at + (self.text.len() - piece.start) == from.at
        });
        if !follows {
            self.pieces.push(Piece { start: self.text.len(), from, copied: true });
        }
        self.text.push_str(part);
    }

    /// Adds text that stands for a place of a file.
    pub fn put(&mut self, part: &str, from: Origin) {
        if !self.pieces.last().is_some_and(|piece| !piece.copied && piece.from == from) {
            self.pieces.push(Piece { start: self.text.len(), from, copied: false });
        }
        self.text.push_str(part);
    }

    /// Adds a part of another text with its origins.
    pub fn take(&mut self, other: &Text, range: [usize; 2]) {
        let [mut at, end] = range;
        let first = other.pieces.partition_point(|piece| piece.start <= at).max(1) - 1;
        for (k, piece) in other.pieces.iter().enumerate().skip(first) {
            let next = other.pieces.get(k + 1).map_or(other.len(), |next| next.start).min(end);
            if at >= next {
                continue;
            }
            let part = &other.text[at..next];
            if piece.copied {
                self.copy(part, Origin { file: piece.from.file, at: piece.from.at + (at - piece.start) });
            } else {
                self.put(part, piece.from);
            }
            at = next;
            if at == end {
                return;
            }
        }
    }

    /// Where a byte comes from; the first byte of the first file of an empty text.
    pub fn origin(&self, at: usize) -> Origin {
        let k = self.pieces.partition_point(|piece| piece.start <= at);
        match k.checked_sub(1).map(|k| self.pieces[k]) {
            Some(piece) if piece.copied => {
                Origin { file: piece.from.file, at: piece.from.at + (at - piece.start) }
            }
            Some(piece) => piece.from,
            None => Origin { file: 0, at: 0 },
        }
    }
}

/// The file's name and the place in it.
pub(super) fn place(files: &[File], origin: Origin) -> (&str, Spot) {
    let file = &files[origin.file.min(files.len() - 1)];
    (&file.name, Spot::of(&file.text, origin.at))
}
