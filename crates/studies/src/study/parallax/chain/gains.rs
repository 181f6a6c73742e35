//! Lookups end to end, with fetches integrated exactly and from a chain.

use super::super::measures::{gain, relative};
use super::super::rooms::methods::{FROSTBITE, methods};
use super::measure::{Case, shaded};
use crate::study::StudyError;
use crate::study::parallax::findings::ChainGain;
use crate::study::parallax::room::cubemap::Chain;
use crate::study::parallax::room::{Fetch, Lookup};
use lobefit::effects::parallax::Shading;

/// What every lookup of a round lobe about the mirror ray is off by in a room.
pub(super) fn gains(case: &Case, exact: &dyn Fetch, chain: &Chain) -> Result<Vec<ChainGain>, StudyError> {
    let methods = methods();
    let errors = |lookup: &dyn Lookup, fetch: &dyn Fetch| -> Vec<f64> {
        case.rows.iter().map(|row| relative(&shaded(row, lookup, fetch), &row.light)).collect()
    };
    let both = |lookup: &dyn Lookup| [errors(lookup, exact), errors(lookup, chain)];
    let rival = both(methods[FROSTBITE].lookup(case.room)?.as_ref());
    let round = methods.iter().filter(|method| method.shading == Shading::Mirror);
    round
        .map(|method| {
            let [exact, chain] = both(method.lookup(case.room)?.as_ref());
            Ok(ChainGain {
                room: case.room.name.clone(),
                method: method.name.clone(),
                gain_exact: gain(&rival[0], &exact),
                gain_chain: gain(&rival[1], &chain),
                exact,
                chain,
            })
        })
        .collect()
}
