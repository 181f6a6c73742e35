//! The name of a result in a cache: a hash of all that determines it.

/// Hash of the source files but for formulas, which are hashed where they are used (`build/main.rs`).
const CODE: &str = env!("LOBEFIT_CODE");

/// What determines a result, in order: the code of this build first.
#[derive(Clone, Debug)]
pub struct Key {
    kind: &'static str,
    hasher: blake3::Hasher,
}

impl Key {
    /// Of one kind of result.
    pub fn of(kind: &'static str) -> Key {
        Key { kind, hasher: blake3::Hasher::new() }.with(CODE)
    }

    /// With a text.
    pub fn with(self, text: &str) -> Key {
        self.bytes(text.as_bytes())
    }

    /// With numbers, by their bits.
    pub fn numbers(self, numbers: &[f64]) -> Key {
        self.bytes(&numbers.iter().flat_map(|x| x.to_bits().to_le_bytes()).collect::<Vec<u8>>())
    }

    /// With bytes: their count keeps neighbours apart.
    fn bytes(mut self, bytes: &[u8]) -> Key {
        self.hasher.update(&(bytes.len() as u64).to_le_bytes());
        self.hasher.update(bytes);
        self
    }

    /// The name: the kind, and the hash.
    pub fn end(self) -> String {
        format!("{}-{}", self.kind, self.hasher.finalize().to_hex())
    }
}
