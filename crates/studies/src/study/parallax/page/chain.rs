//! Lookups from a real chain of levels.

use crate::study::page;
use crate::study::parallax::findings::ChainFindings;
use lobefit::report::numbers::{place, significant};
use lobefit::report::{Block, ReportError, Section, check, words};

pub(super) fn section(chain: &ChainFindings) -> Result<Section, ReportError> {
    check::filled("chain", "gains", chain.gains.len())?;
    let columns =
        |names| words::figures_after(names, chain.roughness.iter().map(|&r| format!("r {}", place(r))));
    let gains = chain.gains.iter().map(|row| {
        let both = |(a, b): (&f64, &f64)| format!("{} / {}", significant(*a, 2), significant(*b, 2));
        let errors = row.exact.iter().zip(&row.chain).map(both);
        let gains = [row.gain_exact, row.gain_chain].map(|gain| significant(gain, 3));
        [row.room.clone(), row.method.clone()].into_iter().chain(errors).chain(gains).collect()
    });
    let noise = chain.noise.iter();
    let noise = noise.map(|(room, noise)| page::row(room, noise.iter().map(|&x| significant(x, 2))));
    let blocks = vec![
        Block::Table(words::table(
            &(columns("room|lookup") + "|gain>|from the chain>"),
            gains.collect(),
            "Error against the lobe traced from the point, with fetches integrated and, after the stroke, from the chain. Gain: geometric mean over \
             roughness of Frostbite’s error over this one’s, both with fetches of the same kind.",
        )),
        Block::Table(words::table(
            &columns("room"),
            noise.collect(),
            "What the reference itself is off by, likewise: the same lobes, integrated with edges divided half as finely, from it.",
        )),
    ];
    Ok(Section::new(
        "chain",
        "A real chain of levels",
        format!(
            "What an engine fetches is no integral: texels of faces that shrink from level to level, 16 bits each, mixed between two levels whose \
             lobes are wider and narrower than the one wanted. All levels are prefiltered with the cosine-weighted lobe, alpha = r². Here as \
             Unity has them: {}, the first with {} texels along a side of a face.",
            chain.levels, chain.size
        ),
        blocks,
    ))
}
