//! What the names of lookups mean.

use lobefit::report::Block;
use lobefit::report::Section;
use lobefit::report::words;

/// Parts of a lookup's name, what each does, and whose it is.
const PARTS: [(&str, &str, &str); 12] = [
    ("no parallax", "the mirror direction, the width α", "-"),
    (
        "parallax only",
        "where the mirror ray meets the walls, seen from the probe; the width α",
        "Lagarde and Zanuttini 2012",
    ),
    (
        "Frostbite",
        "the same; r = √α goes to lerp(clamp(ρ r, 0, r), r, r), ρ the ratio of distances",
        "Lagarde and de Rousiers 2014, listing 25",
    ),
    ("min(1, ρ α)", "the same; α′ = min(1, ρ α), ρ the ratio of distances", "-"),
    ("rational", "α′ = ρ α / max(1 + k (α − ρ α), ρ α)", "emitted lookups: parallax_1"),
    (
        "distances, areas",
        "ρ = d_s/d_p, the ratio of distances to the wall from shading point and probe; or that times √(cos ψ_p/cos ψ_s), the root of the ratio of solid angles",
        "areas: emitted lookups",
    ),
    ("√(n·v)", "ρ times √(n·v)", "-"),
    (
        "dominant direction",
        "the ray mixed with the normal by 1 − (1 − α)(√(1 − α) + α)",
        "Lagarde and de Rousiers 2014, with α for their roughness",
    ),
    (
        "smooth",
        "edges of the walls rounded by how far the lobe reaches over them",
        "emitted lookups with smooth edges",
    ),
    (
        "2 fetches, 3 fetches",
        "fetches along the long axis of the footprint by one rule (above); rational, areas",
        "emitted lookups of two and three fetches",
    ),
    (
        "fitted lobe",
        "axis, size and squash of a GGX lobe by the constants below; rational, areas",
        "ours: emitted lookups of the fitted lobe",
    ),
    ("exact round lobe", "the lobe of width α traced from the shading point itself", "-"),
];

pub(super) fn section() -> Section {
    let columns = "in a name|what is fetched|whose";
    let row = |(name, what, whose): &(&str, &str, &str)| [name, what, whose].map(|x| x.to_string()).to_vec();
    let caption = "Without another word a lookup is of one fetch along the mirror ray, through the walls themselves, with sharp edges.";
    Section::new(
        "compared",
        "What is compared",
        "Lookups take a shading point, a view and a width α = r² and give directions from the probe with widths α′ of lobes. \
               Rooms are convex, of checker walls with a bright panel on each: A is a box about its probe, B a long low box with the probe off its centre, \
               the octagon a hall with a sloping roof. Points are even inside, directions even over the sphere; lengths are metres.",
        vec![Block::Table(words::table(columns, PARTS.iter().map(row).collect(), caption))],
    )
}
