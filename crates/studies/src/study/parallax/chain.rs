//! What a real chain of levels adds to the error of lookups.

use rayon::prelude::*;
use serde::Serialize;

use super::measures::{gain, relative};
use super::rooms::methods::{FROSTBITE, methods};
use super::rooms::points::{self, points};
use crate::study::parallax::findings::{ChainFindings, ChainGain};
use crate::study::parallax::room::cubemap::{Bake, Chain};
use crate::study::parallax::room::{Fetch, Fineness, Lookup, Patches, Room, Seen, octagon, room_a, room_b};
use crate::study::{Size, StudyError};
use lobefit::bake::Progress;
use lobefit::data::{MipChain, MipMap};
use lobefit::effects::parallax::Shading;
use lobefit_truth::optics::kernel::Kernel;

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    rooms: Vec<Room>,
    points: points::Parameters,
    roughness: Vec<f64>,
    bake: Bake,
}

impl Parameters {
    /// Those of a size; the chain is laid out as Unity's, of the kernel that all engines bake.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        let of = |many: u32, few: u32| if full { many } else { few };
        Parameters {
            rooms: if full { vec![room_a(), room_b(), octagon()] } else { vec![room_a()] },
            points: points::Parameters::of(size),
            roughness: if full { vec![0.15, 0.25, 0.35, 0.5, 0.7, 0.9] } else { vec![0.35, 0.7] },
            bake: Bake {
                kernel: Kernel::HalfCosine,
                map: MipChain::Mapped { map: MipMap::Steeper, count: of(7, 5) },
                size: if full { 128 } else { 16 },
                samples: if full { 8 } else { 2 },
                rays: of(256, 32),
                seed: 11,
            },
        }
    }
}

/// Runs it.
pub(super) fn findings(
    parameters: &Parameters,
    progress: &dyn Progress,
) -> Result<ChainFindings, StudyError> {
    let Parameters { rooms, points, roughness, bake } = parameters;
    let (mut noise, mut gains) = (Vec::new(), Vec::new());
    for room in rooms {
        progress.stage(&format!("chains: room {}", room.name));
        let case = Case::new(room, points, roughness);
        noise.push((room.name.clone(), case.rows.iter().map(|row| row.noise).collect()));
        gains.extend(case.gains(&bake.chain(room)?)?);
    }
    let (roughness, levels) = (roughness.clone(), bake.map.text());
    Ok(ChainFindings { roughness, levels, size: bake.size, noise, gains })
}

/// The points of a room under a roughness.
struct Row {
    seen: Vec<Seen>,
    /// The lobe traced from each.
    light: Vec<[f64; 3]>,
    /// What that is off by: its relative difference from a finer one.
    noise: f64,
}

/// A room with its points at random, row by row of roughness.
struct Case<'a> {
    room: &'a Room,
    /// Lobes integrated.
    exact: Patches<'a>,
    rows: Vec<Row>,
}

impl<'a> Case<'a> {
    /// With references.
    fn new(room: &'a Room, points_of: &points::Parameters, roughness: &[f64]) -> Case<'a> {
        let exact = Patches::new(room);
        let fine = exact.clone().with(Fineness::Fine);
        let points = points(room, points_of);
        let row = |roughness: &f64| {
            let alpha = roughness * roughness;
            let seen = points.iter().map(|point| Seen {
                place: point.place,
                normal: point.mirror,
                view: point.mirror,
                alpha,
            });
            let seen: Vec<Seen> = seen.collect();
            let lobes = |from: &Patches| -> Vec<[f64; 3]> {
                seen.par_iter().map(|s| from.lobe(s.place, s.view, alpha)).collect()
            };
            let light = lobes(&fine);
            let noise = relative(&lobes(&exact), &light);
            Row { seen, light, noise }
        };
        let rows = roughness.iter().map(row).collect();
        Case { room, exact, rows }
    }

    /// What every lookup of a round lobe about the mirror ray is off by, with fetches integrated
    /// exactly and from a chain.
    fn gains(&self, chain: &Chain) -> Result<Vec<ChainGain>, StudyError> {
        let methods = methods();
        let both = |lookup: &dyn Lookup| [self.errors(lookup, &self.exact), self.errors(lookup, chain)];
        let rival = both(methods[FROSTBITE].lookup(self.room)?.as_ref());
        let round = methods.iter().filter(|method| method.shading == Shading::Mirror);
        round
            .map(|method| {
                let [exact, chain] = both(method.lookup(self.room)?.as_ref());
                Ok(ChainGain {
                    room: self.room.name.clone(),
                    method: method.name.clone(),
                    gain_exact: gain(&rival[0], &exact),
                    gain_chain: gain(&rival[1], &chain),
                    exact,
                    chain,
                })
            })
            .collect()
    }

    /// Relative errors of a lookup with fetches of a kind, by roughness.
    fn errors(&self, lookup: &dyn Lookup, fetch: &dyn Fetch) -> Vec<f64> {
        let shaded = |row: &Row| -> Vec<[f64; 3]> {
            row.seen.par_iter().map(|seen| fetch.sum(&lookup.taps(seen))).collect()
        };
        self.rows.iter().map(|row| relative(&shaded(row), &row.light)).collect()
    }
}
