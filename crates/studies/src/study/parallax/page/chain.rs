//! Real chains of levels, and viewpoints of their texels.

use crate::study::page;
use crate::study::parallax::findings::{
    BakePolicy, ChainFindings, ChainParts, SeamPicture, SeamRow, SlideLaw,
};
use lobefit::report::numbers::{place, significant};
use lobefit::report::{Block, Cells, Curves, Gallery, ReportError, Section, Spread, Style, TextTable, check};
use lobefit::report::{figures, words};

pub(super) fn sections(chain: &ChainFindings) -> Result<Vec<Section>, ReportError> {
    Ok(vec![texels(chain)?, viewpoints(chain)?])
}

/// Errors by roughness after some words.
fn table(
    names: &[&str],
    roughness: &[f64],
    ends: &[&str],
    rows: Vec<Vec<String>>,
    caption: &str,
) -> TextTable {
    let mut columns: Vec<(String, bool)> = names.iter().map(|name| (name.to_string(), false)).collect();
    columns.extend(roughness.iter().map(|&r| (format!("r {}", place(r)), true)));
    columns.extend(ends.iter().map(|end| (end.to_string(), true)));
    page::table(columns, rows, caption)
}

fn cells(names: &[&str], values: &[f64]) -> Vec<String> {
    let names = names.iter().map(|name| name.to_string());
    names.chain(values.iter().map(|&x| significant(x, 2))).collect()
}

fn texels(chain: &ChainFindings) -> Result<Section, ReportError> {
    check::filled("chain", "parts", chain.parts.len())?;
    let parts = chain.parts.iter().flat_map(of_parts).collect();
    let sizes = chain.sizes.iter().map(|row| {
        let [size, bytes] = [row.size, row.bytes / 1024].map(|n| n.to_string());
        cells(&[&row.room, &row.like, &row.chain, &size, &bytes], &row.total)
    });
    let gains = chain.gains.iter().map(|row| {
        let mut cells = vec![row.room.clone(), row.method.clone()];
        let both = |(a, b): (&f64, &f64)| format!("{} / {}", significant(*a, 2), significant(*b, 2));
        cells.extend(row.exact.iter().zip(&row.chain).map(both));
        cells.extend([row.gain_exact, row.gain_chain].map(|gain| significant(gain, 3)));
        cells
    });
    let r = &chain.roughness;
    let noise = chain.noise.iter().map(|(room, noise)| cells(&[room], noise)).collect();
    let blocks = vec![
        Block::Heading { text: "What a chain adds, part by part".into() },
        Block::Table(table(
            &["room", "part"],
            r,
            &[],
            parts,
            "For the fetches of our formula (rational, areas) at points at random: root of the sum of squares of the differences over that of the \
             same fetches integrated exactly. Levels: the lobes of the two nearest levels, integrated, mixed for the one between them. Texels: the \
             chain in 32 bits from that. Rays: two chains of different rays apart, which a part below it drowns in.",
        )),
        Block::Heading { text: "Maps and sizes".into() },
        Block::Table(table(
            &["room", "like", "levels", "texels", "KiB"],
            r,
            &[],
            sizes.collect(),
            "The whole error of other chains, likewise; KiB of 16 bits and four channels.",
        )),
        Block::Heading { text: "End to end".into() },
        Block::Table(table(
            &["room", "lookup"],
            r,
            &["gain", "from the chain"],
            gains.collect(),
            "Error against the lobe traced from the point, with fetches integrated and, after the stroke, from the chain. Gain: geometric mean over \
             roughness of Frostbite’s error over this one’s, both with fetches of the same kind.",
        )),
        Block::Table(table(
            &["room"],
            r,
            &[],
            noise,
            "What the reference itself is off by, likewise: the same lobes, integrated with edges divided half as finely, from it.",
        )),
    ];
    Ok(Section {
        id: "chain".into(),
        title: "Real chains of levels".into(),
        lead: "What an engine fetches is no integral: texels of faces that shrink from level to level, 16 bits each, mixed between two levels whose \
               lobes are wider and narrower than the one wanted. All levels are prefiltered with the cosine-weighted lobe, alpha = r²."
            .into(),
        blocks,
    })
}

fn of_parts(parts: &ChainParts) -> Vec<Vec<String>> {
    let rows: [(&str, &[f64]); 7] = [
        ("whole", &parts.total),
        ("levels", &parts.levels),
        ("texels", &parts.texels),
        ("16 bits", &parts.half),
        ("whole, faces clamped at their edges", &parts.clamped),
        ("whole, prefiltered from the capture", &parts.captured),
        ("rays", &parts.noise),
    ];
    rows.into_iter().map(|(name, values)| cells(&[&parts.room, name], values)).collect()
}

fn viewpoints(chain: &ChainFindings) -> Result<Section, ReportError> {
    check::filled("chain", "policies", chain.policies.len())?;
    let mut blocks = vec![slide(&chain.slide)?, Block::Table(whole(chain)), Block::Table(near(chain))];
    let mut rooms: Vec<&str> = chain.seams.iter().map(|row| row.room.as_str()).collect();
    rooms.dedup();
    for room in rooms {
        let rows: Vec<&SeamRow> = chain.seams.iter().filter(|row| row.room == room).collect();
        blocks.push(Block::Heading { text: format!("Floor of room {room}") });
        blocks.push(floor(&rows)?);
        blocks.push(Block::Table(creases(&rows)));
    }
    Ok(Section {
        id: "viewpoints".into(),
        title: "Texels that see the room from above its walls".into(),
        lead: "An ordinary texel integrates its lobe from the probe, slanted as the probe happens to see the wall. A perpendicular one sees the same \
               place from above, as far from the wall as the probe is; at the edges of the proxy the viewpoints of the two walls disagree. A sliding \
               one is e/(e + w α d) of the way from the probe to above the wall, e being the distance of the place from the nearest edge and α d the \
               radius of the probe’s lobe on the wall. Either lobe’s footprint is as large as the probe’s, so that the lookup is the ordinary one. Ratio of areas: ρ = (d_s/d_p) √(cos ψ_p/cos ψ_s); fading: the power of the cosines sinks to 0 at an edge."
            .into(),
        blocks,
    })
}

fn whole(chain: &ChainFindings) -> TextTable {
    let row = |policy: &BakePolicy| {
        let mut cells = cells(&[&policy.room, &policy.policy], &policy.whole);
        cells.extend([policy.gain, policy.gain_chain].map(|gain| significant(gain, 3)));
        cells
    };
    table(
        &["room", "bake and ratio"],
        &chain.roughness,
        &["gain", "from its chain"],
        chain.policies.iter().map(row).collect(),
        "Fetches, integrated, against the lobe traced from the point; one through the walls themselves where nothing else is said, several and smooth \
         ones with the ratio of areas. Gain: geometric mean over roughness of Frostbite’s error, from the ordinary \
         bake, over this one’s; of both with fetches from real chains.",
    )
}

/// Errors far from edges and near them, at every other roughness.
fn near(chain: &ChainFindings) -> TextTable {
    let places: Vec<usize> = (0..chain.roughness.len()).step_by(2).collect();
    let roughness: Vec<f64> = places.iter().map(|&i| chain.roughness[i]).collect();
    let row = |policy: &BakePolicy| {
        let both =
            |&i: &usize| format!("{} / {}", significant(policy.far[i], 2), significant(policy.near[i], 2));
        [policy.room.clone(), policy.policy.clone()].into_iter().chain(places.iter().map(both)).collect()
    };
    table(
        &["room", "bake and ratio"],
        &roughness,
        &[],
        chain.policies.iter().map(row).collect(),
        &format!(
            "The same far from the edges of the proxy and, after the stroke, near them: where the mirror ray ends within {} radii α d of the lobe on \
             the wall from one. All roughness: results.json.",
            place(chain.near)
        ),
    )
}

fn slide(law: &SlideLaw) -> Result<Block, ReportError> {
    let points = law.widths.iter().copied().zip(law.loss.iter().copied()).collect();
    let line = page::line(format!("room {}", law.room), points, Style::Marked(0));
    let labels = ["w", "relative L2, geometric mean over r"];
    let curves = Curves {
        x: ("w".into(), Spread::Log),
        ..page::chart("Error of a bake whose viewpoint slides", labels, vec![line], (520.0, 240.0))
    };
    let caption = format!(
        "The viewpoint is half way between the probe and the place above the wall where an edge is w radii α d of the lobe on the wall away. Fitted \
         in a practice room that is none of those below, where the best w is {}.",
        significant(law.best, 2)
    );
    figures(&[curves], &caption)
}

/// The floors of a room, a column for each roughness.
fn floor(rows: &[&SeamRow]) -> Result<Block, ReportError> {
    let first = rows.first().map_or(&[][..], |row| &row.pictures);
    let pictures =
        |i: usize| rows.iter().filter_map(|row| row.pictures.get(i)).map(|p| p.picture.clone()).collect();
    let gallery = Gallery {
        title: "floor".into(),
        column_name: "r".into(),
        columns: rows.iter().map(|row| place(row.roughness)).collect(),
        rows: first.iter().map(|p| p.policy.clone()).collect(),
        side: first.first().map_or(0, |p| p.picture.width),
        cell: CELL,
        cells: Cells::Colours((0..first.len()).map(pictures).collect()),
    };
    figures(
        &[gallery],
        "The floor as a mirror of its roughness, through the tone mapper; black is not the floor.",
    )
}

/// Side of a picture of a floor on the page.
const CELL: f64 = 180.0;

fn creases(rows: &[&SeamRow]) -> TextTable {
    let of = |row: &&SeamRow| {
        let roughness = place(row.roughness);
        let one = move |p: &SeamPicture| {
            let ratio = if p.elsewhere > 0.0 { significant(p.edge / p.elsewhere, 2) } else { "–".into() };
            let values = [p.edge, p.elsewhere].map(|x| significant(100.0 * x, 3));
            vec![roughness.clone(), p.policy.clone(), values[0].clone(), values[1].clone(), ratio]
        };
        let noise = row.noise.map(|x| significant(100.0 * x, 2));
        let noise = vec![
            place(row.roughness),
            "noise of the reference".into(),
            noise[0].clone(),
            noise[1].clone(),
            "–".into(),
        ];
        row.pictures.iter().map(one).chain([noise]).collect::<Vec<_>>()
    };
    let columns = [
        ("r", true),
        ("bake and ratio", false),
        ("at edges, × 100", true),
        ("elsewhere, × 100", true),
        ("ratio", true),
    ];
    words::table(
        &columns,
        rows.iter().flat_map(of).collect(),
        "Creases as above: mean magnitude of the second difference of the error of displayed luminance over three pixels, where their mirror rays \
         meet two walls and farther than a pixel from there; of the reference that of its own luminance. Its noise: what integrating it with edges \
         divided half as finely changes.",
    )
}
