//! What a quantity is taken for beside its inputs: the form of the shadowing, the side, the lobe.

use super::Specular;
use crate::integrate::IntegrateError;
use crate::integrate::glass::Side;
use crate::optics::Smith;
use crate::optics::kernel::Kernel;

/// One thing that a [`Variant`] says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Choice {
    /// The form of the masking and shadowing: `smith`.
    Smith,
    /// Where the ray comes from: `side`.
    Side,
    /// What multiplies the specular lobe: `specular`.
    Specular,
    /// The lobe that a chain is prefiltered with: `kernel`. Without it, the half-angle lobe
    /// weighted by the cosine.
    Kernel,
}

impl Choice {
    /// Its name, in files of points the name of its column.
    pub fn name(self) -> &'static str {
        match self {
            Choice::Smith => "smith",
            Choice::Side => "side",
            Choice::Specular => "specular",
            Choice::Kernel => "kernel",
        }
    }

    /// The words to choose from; a kernel may be a table too, which has no word of its own.
    pub fn words(self) -> Vec<&'static str> {
        match self {
            Choice::Smith => Smith::ALL.map(Smith::name).to_vec(),
            Choice::Side => Side::ALL.map(Side::name).to_vec(),
            Choice::Specular => Specular::ALL.map(Specular::name).to_vec(),
            Choice::Kernel => Kernel::WORDS.to_vec(),
        }
    }

    /// Whether a variant may leave it open.
    pub fn is_optional(self) -> bool {
        self == Choice::Kernel
    }
}

/// A variant of a quantity. What the quantity does not have is `None`, and is not looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variant {
    /// The form of the masking and shadowing.
    pub smith: Option<Smith>,
    /// Where the ray comes from.
    pub side: Option<Side>,
    /// What multiplies the specular lobe.
    pub specular: Option<Specular>,
    /// The lobe that a chain is prefiltered with.
    pub kernel: Option<Kernel>,
}

impl From<Smith> for Variant {
    fn from(smith: Smith) -> Variant {
        Variant { smith: Some(smith), ..Variant::default() }
    }
}

impl Variant {
    /// Makes a choice by its word; false where it has no such word.
    #[must_use]
    pub fn choose(&mut self, choice: Choice, word: &str) -> bool {
        fn pick<T: Copy>(all: &[T], name: fn(T) -> &'static str, word: &str) -> Option<T> {
            all.iter().copied().find(|one| name(*one) == word)
        }
        match choice {
            Choice::Smith => pick(&Smith::ALL, Smith::name, word).map(|s| self.smith = Some(s)),
            Choice::Side => pick(&Side::ALL, Side::name, word).map(|s| self.side = Some(s)),
            Choice::Specular => pick(&Specular::ALL, Specular::name, word).map(|s| self.specular = Some(s)),
            Choice::Kernel => Kernel::of(word).map(|k| self.kernel = Some(k)),
        }
        .is_some()
    }

    /// The variant with nothing but these choices.
    #[must_use]
    pub fn of(&self, choices: &[Choice]) -> Variant {
        let has = |choice: Choice| choices.contains(&choice);
        Variant {
            smith: self.smith.filter(|_| has(Choice::Smith)),
            side: self.side.filter(|_| has(Choice::Side)),
            specular: self.specular.filter(|_| has(Choice::Specular)),
            kernel: self.kernel.clone().filter(|_| has(Choice::Kernel)),
        }
    }

    /// The word of a choice, where it is made.
    pub fn word(&self, choice: Choice) -> Option<&str> {
        match choice {
            Choice::Smith => self.smith.map(Smith::name),
            Choice::Side => self.side.map(Side::name),
            Choice::Specular => self.specular.map(Specular::name),
            Choice::Kernel => self.kernel.as_ref().map(Kernel::word),
        }
    }

    /// The lobe of a chain: the usual one where the choice is left open.
    pub fn kernel(&self) -> &Kernel {
        self.kernel.as_ref().unwrap_or(&Kernel::HalfCosine)
    }

    /// The form of the shadowing of a quantity that has one.
    pub(super) fn smith(&self, quantity: &'static str) -> Result<Smith, IntegrateError> {
        self.smith.ok_or(IntegrateError::Variant { quantity, choice: Choice::Smith.name() })
    }

    /// The side of a quantity that has one.
    pub(super) fn side(&self, quantity: &'static str) -> Result<Side, IntegrateError> {
        self.side.ok_or(IntegrateError::Variant { quantity, choice: Choice::Side.name() })
    }

    /// What multiplies the specular lobe of a quantity that has it.
    pub(super) fn specular(&self, quantity: &'static str) -> Result<Specular, IntegrateError> {
        self.specular.ok_or(IntegrateError::Variant { quantity, choice: Choice::Specular.name() })
    }
}
