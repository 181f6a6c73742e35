//! Which lobe a table is of: the list of shadowing forms.

use lobefit::data::Smith;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::EstevezKulla;
use lobefit_truth::quantity::{Choice, Quantity, SCHLICK_SMITH, Variant};

/// A shadowing form: a line of [`FORMS`].
#[derive(Debug)]
pub struct Form {
    /// The quantity whose lobe it shadows; `None` for all whose variants name a Smith form.
    of: Option<&'static str>,
    /// The word of `--smith`.
    pub word: &'static str,
    /// For readers.
    pub words: &'static str,
    /// The variant's Smith form.
    pub smith: Option<Smith>,
    /// What integrates it, where that is not the quantity itself,
    pub integrand: Option<&'static dyn Quantity>,
    /// and its Smith form.
    of_integrand: Option<Smith>,
}

/// A form of a quantity's own variants.
const fn own(smith: Smith, word: &'static str, words: &'static str) -> Form {
    Form { of: None, word, words, smith: Some(smith), integrand: None, of_integrand: None }
}

/// A form of GGX by lines that Schlick put in place of roots.
const fn of_lines([word, words]: [&'static str; 2], by: &'static dyn Quantity, smith: Smith) -> Form {
    let of = Some("ggx-reflection");
    Form { of, word, words, smith: None, integrand: Some(by), of_integrand: Some(smith) }
}

/// A form of the sheen, with what integrates it.
const fn of_sheen([word, words]: [&'static str; 2], integrand: Option<&'static dyn Quantity>) -> Form {
    Form { of: Some("sheen-charlie"), word, words, smith: None, integrand, of_integrand: None }
}

/// Every form; of those of a quantity its own first, the one that is meant where nothing is said.
pub static FORMS: [Form; 8] = [
    own(Smith::Correlated, "correlated", "height-correlated Smith"),
    own(Smith::Separable, "separable", "separable Smith"),
    of_lines(
        ["schlick", "Schlick-Smith with k = alpha/2 (Karis 2013, for light from images)"],
        SCHLICK_SMITH[0],
        Smith::Separable,
    ),
    of_lines(
        ["schlick-lights", "Schlick-Smith with k = (roughness + 1)^2/8 (Karis 2013, for analytic lights)"],
        SCHLICK_SMITH[1],
        Smith::Separable,
    ),
    of_lines(["schlick-alpha", "Schlick-Smith with k = alpha"], SCHLICK_SMITH[2], Smith::Separable),
    // V = 1/2 over a mix by alpha of 2 (n.l) (n.v) and n.l + n.v: the root of Lambda is a line.
    of_lines(
        ["joint-approx", "height-correlated Smith without roots (Hammon 2017; Unreal's joint approximation)"],
        SCHLICK_SMITH[0],
        Smith::Correlated,
    ),
    of_sheen(["neubelt", "the visibility of Neubelt and Pettineo (2013)"], None),
    of_sheen(["estevez-kulla", "the shadowing of Estevez and Kulla (2017)"], Some(&EstevezKulla)),
];

/// The form of a quantity that has one only.
static ONLY: Form = Form { of: None, word: "", words: "", smith: None, integrand: None, of_integrand: None };

impl PartialEq for Form {
    fn eq(&self, other: &Form) -> bool {
        self.word == other.word
    }
}

impl Form {
    /// The form of a word.
    pub fn find(word: &str) -> Option<&'static Form> {
        FORMS.iter().find(|form| form.word == word)
    }

    /// The forms of a quantity's lobe, its own first.
    pub fn of(quantity: &dyn Quantity) -> Vec<&'static Form> {
        let fits = |form: &&Form| match form.of {
            Some(name) => name == quantity.name(),
            None => quantity.has(Choice::Smith),
        };
        let forms: Vec<&Form> = FORMS.iter().filter(fits).collect();
        if forms.is_empty() { vec![&ONLY] } else { forms }
    }
}

/// Which lobe a truth is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Shadowing form.
    pub form: &'static Form,
    /// Where the ray comes from; `None` where there is one side only, or an axis runs over both.
    pub side: Option<Side>,
    /// Whether an axis runs over both sides.
    pub both: bool,
}

impl Lobe {
    /// The lobes of a quantity of these forms and sides, and where these are both, of a table of both.
    pub(super) fn of(quantity: &dyn Quantity, forms: &[&'static Form], sides: &[Side]) -> Vec<Lobe> {
        let mut kinds: Vec<(Option<Side>, bool)> = match quantity.has(Choice::Side) {
            true => sides.iter().map(|side| (Some(*side), false)).collect(),
            false => vec![(None, false)],
        };
        kinds.extend((kinds.len() > 1).then_some((None, true)));
        let with = |form: &&'static Form| {
            let form = *form;
            kinds.iter().map(move |(side, both)| Lobe { form, side: *side, both: *both }).collect::<Vec<_>>()
        };
        forms.iter().flat_map(with).collect()
    }

    /// The variant of what integrates it.
    pub(super) fn variant(&self) -> Variant {
        let smith = self.form.smith.or(self.form.of_integrand);
        Variant { smith, side: self.side, ..Variant::default() }
    }

    /// `height-correlated Smith, rays from inside`.
    pub fn words(&self) -> String {
        let side = self.side.map(|s| match s {
            Side::Outside => "rays from outside",
            Side::Inside => "rays from inside",
        });
        let form = Some(self.form.words).filter(|words| !words.is_empty());
        [form, side].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}
