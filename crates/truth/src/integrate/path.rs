//! Which compiled form of a kernel's loops to run: all do the same operations in the same order,
//! nothing contracted, so all give the same bits.

/// Instructions to use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Path {
    /// The best that the processor has: AVX-512, AVX2, or what every processor of its kind has.
    #[default]
    Best,
    /// AVX2 at most.
    Avx2,
    /// What every processor of its kind has (SSE2 on x86-64).
    Baseline,
}

impl Path {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Path::Best => "best",
            Path::Avx2 => "at most AVX2",
            Path::Baseline => "baseline",
        }
    }
}
