//! Names in the emitted files: a hypothesis of the user's must not take one that is emitted anyway,
//! nor a word of a language. Refused before anything is integrated.

use super::{BakeError, UserHypothesis};
use crate::approximate::FitStageError;
use crate::emit::compensation;
use crate::plan::Plan;
use crate::report::explore;
use lobefit_shade::Hypothesis;
use lobefit_shade::code;
use lobefit_shade::code::Language;

/// What a formula is emitted as: itself, its least squares fit, and their forms for three channels.
const SUFFIXES: [&str; 4] = ["", "_rms", "_rgb", "_rms_rgb"];

/// Parses the user's hypotheses and refuses a name that is taken.
pub fn check(plan: &Plan, hypotheses: &[UserHypothesis]) -> Result<(), BakeError> {
    let formulas = plan.catalogue.iter().flat_map(|effect| effect.formulas());
    let mut taken: Vec<String> = formulas.flat_map(|entry| forms(entry.name())).collect();
    let prefixes = plan.catalogue.iter().flat_map(|effect| effect.profile().prefixes).copied();
    let prefixes: Vec<&str> = prefixes.chain([code::C_PREFIX, explore::PREFIX]).collect();
    taken.extend(code::RUST_HELPERS.map(String::from));
    taken.extend(compensation::NAMES.map(String::from));
    taken.extend(plan.catalogue.iter().flat_map(|effect| effect.functions()));
    for user in hypotheses {
        let parsed = Hypothesis::parse(&user.file, &user.source).map_err(FitStageError::from)?;
        let names = forms(parsed.name());
        let clash = names
            .iter()
            .find(|name| taken.contains(name) || prefixes.iter().any(|prefix| name.starts_with(prefix)));
        if clash.is_some() {
            return Err(BakeError::Name { file: user.file.clone(), function: parsed.name().to_string() });
        }
        printable(user, &parsed)?;
        taken.extend(names);
    }
    Ok(())
}

fn forms(name: &str) -> Vec<String> {
    SUFFIXES.iter().map(|suffix| format!("{name}{suffix}")).collect()
}

/// Prints the formula once with its starting values: what the printers refuse is refused here, with
/// the file.
fn printable(user: &UserHypothesis, parsed: &Hypothesis) -> Result<(), BakeError> {
    let starts: Vec<f32> = parsed.parameters().iter().map(|p| p.start).collect();
    let printed =
        Language::ALL.iter().try_for_each(|language| code::print(*language, parsed, &starts, &[]).map(drop));
    match printed {
        Err(error @ (code::CodeError::Name { .. } | code::CodeError::Letters { .. })) => {
            Err(BakeError::Word { file: user.file.clone(), reason: error.to_string() })
        }
        // Coefficients are not known yet: what is said of the starting values may not hold of them.
        _ => Ok(()),
    }
}
