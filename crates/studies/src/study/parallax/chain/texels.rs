//! What a chain adds to the error of a lookup, part by part.

use super::super::measures::{off, relative};
use super::measure::{Case, KERNEL, Row, shaded};
use super::{Engine, Parameters};
use crate::study::StudyError;
use crate::study::parallax::findings::{ChainParts, ChainSize};
use crate::study::parallax::room::cubemap::{Bake, Chain, Edges, Format, Source, Viewpoint};
use crate::study::parallax::room::{Fetch, Patches, Room, Slant, Tap};
use lobefit::data::MipChain;
use lobefit::effects::parallax::Width;
use lobefit_math::vector::{plus, scaled};

/// The bake of an engine's chain.
pub(super) fn bake(engine: &Engine, parameters: &Parameters) -> Bake {
    Bake {
        kernel: KERNEL,
        map: engine.map.clone(),
        size: engine.size,
        format: Format::Half,
        edges: Edges::Seamless,
        source: Source::Room,
        viewpoint: Viewpoint::Probe,
        samples: parameters.samples,
        rays: parameters.texel_rays,
        seed: parameters.seed,
    }
}

/// Lobes of the two levels next to a width, mixed as the chain mixes them, but integrated.
struct Levels<'a> {
    room: &'a Room,
    exact: &'a Patches<'a>,
    map: &'a MipChain,
}

impl Fetch for Levels<'_> {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        let level = self.map.level(tap.alpha.sqrt());
        let part = level - level.floor();
        let of = |level: f64| {
            let roughness = self.map.roughness(level);
            let alpha = roughness * roughness;
            if alpha == 0.0 {
                return self.room.seen(self.room.probe, tap.towards);
            }
            self.exact.fetch(&Tap { alpha, ..*tap })
        };
        if part == 0.0 {
            return of(level);
        }
        plus(scaled(of(level.floor()), 1.0 - part), scaled(of(level.floor() + 1.0), part))
    }
}

/// The parts of the first engine's chain in a room, for the fetches of our lookup; and the chain.
pub(super) fn parts(case: &Case, parameters: &Parameters) -> Result<(ChainParts, Chain), StudyError> {
    let engine = parameters.first();
    let whole = Bake { format: Format::Single, ..bake(engine, parameters) };
    let single = whole.chain(case.room)?;
    let chain = single.rounded(Format::Half)?;
    let captured =
        Bake { source: Source::Capture, rays: parameters.engine_rays, ..whole.clone() }.chain(case.room)?;
    let again = Bake { seed: parameters.seed + 1, ..whole }.chain(case.room)?;
    let clamped = chain.with_edges(Edges::Clamped);
    let exact = &case.exact;
    let levels = Levels { room: case.room, exact, map: &engine.map };
    let lookup = case.lookup(Slant::Whole, Width::EMITTED);
    let mut found = ChainParts { room: case.room.name.clone(), ..ChainParts::default() };
    for row in &case.rows {
        let by = |fetch: &dyn Fetch| shaded(row, &lookup, fetch);
        let (truth, mixed, stored) = (by(exact), by(&levels), by(&chain));
        let off = |a: &[[f64; 3]], b: &[[f64; 3]]| off(a, b, &truth);
        let plain = by(&single);
        found.total.push(off(&stored, &truth));
        found.levels.push(off(&mixed, &truth));
        found.texels.push(off(&plain, &mixed));
        found.half.push(off(&stored, &plain));
        found.clamped.push(off(&by(&clamped), &truth));
        found.captured.push(off(&by(&captured), &truth));
        found.noise.push(off(&by(&again), &plain));
    }
    Ok((found, chain))
}

/// A row of the table of chains.
pub(super) fn size(case: &Case, engine: &Engine, chain: &Chain, total: Vec<f64>) -> ChainSize {
    ChainSize {
        room: case.room.name.clone(),
        chain: engine.map.text(),
        like: engine.like.clone(),
        size: engine.size,
        bytes: chain.bytes(),
        total,
    }
}

/// The error of the other engines' chains.
pub(super) fn sizes(case: &Case, parameters: &Parameters) -> Result<Vec<ChainSize>, StudyError> {
    let lookup = case.lookup(Slant::Whole, Width::EMITTED);
    let truth: Vec<Vec<[f64; 3]>> = case.rows.iter().map(|row| shaded(row, &lookup, &case.exact)).collect();
    let one = |engine: &Engine| {
        let chain: Chain = bake(engine, parameters).chain(case.room)?;
        let error = |(row, truth): (&Row, &Vec<[f64; 3]>)| relative(&shaded(row, &lookup, &chain), truth);
        Ok(size(case, engine, &chain, case.rows.iter().zip(&truth).map(error).collect()))
    };
    parameters.engines.iter().skip(1).map(one).collect()
}
