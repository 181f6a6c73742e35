//! Proxies with soft edges.

use crate::study::parallax::findings::{ProxiesFindings, ProxyCrossing, ProxyFamily, ProxyGain};
use lobefit::report::numbers::significant;
use lobefit::report::{Block, Curves, ReportError, Section, Series, Spread, Style, check};
use lobefit::report::{figures, words};

pub(super) fn sections(proxies: &ProxiesFindings) -> Result<Vec<Section>, ReportError> {
    check::filled("proxies", "families", proxies.families.len())?;
    check::filled("proxies", "gains", proxies.gains.len())?;
    Ok(vec![laws(proxies)?, gains(proxies)?, edges(proxies)])
}

/// The parameters over roughness.
fn laws(proxies: &ProxiesFindings) -> Result<Section, ReportError> {
    let charts: Vec<Curves> = proxies.families.iter().map(|family| parameter(proxies, family)).collect();
    let columns =
        [("proxy", false), ("parameter", false), ("law", false), ("most that any value gains", true)];
    let row = |family: &ProxyFamily| {
        let mut cells = [&family.name, &family.parameter, &family.law].map(String::clone).to_vec();
        cells.push(percent(most(family)));
        cells
    };
    let table = words::table(
        &columns,
        proxies.families.iter().map(row).collect(),
        "Laws fitted for the smallest mean logarithm of the error over all roughnesses; a factor of 0 is the planes themselves: nothing gains. The \
         law of tied powers by creases is sharper than the error alone asks for where lobes are wide: it was chosen by the creases of pictures of the practice \
         room, and the powers near 1 that the error likes there do not carry over to other rooms (below). The most that any value gains: on the planes’ \
         error, at the roughness where that is most.",
    );
    let caption = "The parameter of the smallest relative L2 error of one fetch (rational width, ratio of areas) against the same lobe traced from \
                   the shading point, and that by the law. Where the error hardly depends on the parameter the best one is of little meaning. \
                   Nearest: the probe's distance to its nearest plane. Share of the way: from the shading point to the probe. Tied: the power is that \
                   over α, divided by the spread s of the vectors n/(n·R) of the planes ahead, within 2 and 256.";
    Ok(Section {
        id: "proxies".into(),
        title: "Proxies with soft edges".into(),
        lead: format!(
            "Each family's parameter fitted at {} points of a practice room that is none of those that the page judges in, directions evenly over the sphere.",
            proxies.points[0]
        ),
        blocks: std::iter::once(figures(&charts, caption)?)
            .chain(proxies.families.iter().filter(|family| beside(family)).map(misfit))
            .chain([Block::Table(table)])
            .collect(),
    })
}

fn percent(x: f64) -> String {
    format!("{} %", significant(100.0 * x, 2))
}

/// The most that one of the values tried takes from the planes' error, at any roughness.
fn most(family: &ProxyFamily) -> f64 {
    family.landscape.iter().flatten().map(|ratio| 1.0 - ratio).fold(0.0, f64::max)
}

/// Whether the law lies beside the best parameters: by more than half of the larger of both in the
/// mean over roughness.
fn beside(family: &ProxyFamily) -> bool {
    let pairs = family.by_law.iter().zip(&family.best);
    let off = pairs.map(|(law, best)| (law - best).abs() / law.max(*best).max(f64::MIN_POSITIVE));
    off.sum::<f64>() > 0.5 * family.best.len() as f64
}

/// A gain of nothing: a tenth of a percent.
const NOTHING: f64 = 1e-3;

fn misfit(family: &ProxyFamily) -> Block {
    let (name, most) = (&family.name, most(family));
    let why = if most < NOTHING {
        format!(
            "None of the values tried gains more than {}: the marks are where the cubic through them dips between two, and mean nothing.",
            percent(most)
        )
    } else {
        format!("The best values tried gain up to {}, which the law misses.", percent(most))
    };
    Block::Text {
        text: format!("The law of “{name}” is no fit of its marks and lies beside them. {why}")
    }
}

fn parameter(proxies: &ProxiesFindings, family: &ProxyFamily) -> Curves {
    let power = ["smooth", "tied"].contains(&family.name.as_str());
    let line = |name: &str, values: &[f64], style: Style| Series {
        name: name.into(),
        points: proxies.roughness.iter().zip(values).map(|(r, v)| (*r, v.min(MOST_SHOWN))).collect(),
        style,
        end: None,
    };
    let series = vec![line("best", &family.best, Style::Measured), line("law", &family.by_law, Style::Truth)];
    Curves {
        title: format!("{}: {}", family.name, family.law),
        x: ("roughness".into(), Spread::Linear),
        y: (family.parameter.clone(), if power { Spread::Log } else { Spread::Linear }),
        series,
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size: (340.0, 240.0),
    }
}

/// What the laws gain on other points, over roughness.
fn gains(proxies: &ProxiesFindings) -> Result<Section, ReportError> {
    let names: Vec<String> =
        proxies.gains.iter().take(1).flat_map(|g| &g.proxies).map(|(name, _)| name.clone()).collect();
    let mut rooms: Vec<&str> = proxies.gains.iter().map(|g| g.room.as_str()).collect();
    rooms.dedup();
    let charts: Vec<Curves> = rooms.iter().map(|room| ratios(proxies, room, &names)).collect();
    let fixed = [("room", false), ("roughness", true), ("over an edge", true), ("planes", true)];
    let columns: Vec<(&str, bool)> = fixed
        .into_iter()
        .chain(names.iter().filter(|name| tabulated(name)).map(|name| (name.as_str(), true)))
        .collect();
    let pair = |[all, edges]: [f64; 2]| format!("{} / {}", significant(all, 3), significant(edges, 3));
    let row = |gain: &ProxyGain| {
        let share = format!("{} of {}", gain.points[1], gain.points[0]);
        let mut cells = vec![gain.room.clone(), significant(gain.roughness, 2), share, pair(gain.planes)];
        cells.extend(gain.proxies.iter().filter(|(name, _)| tabulated(name)).map(|(_, off)| pair(*off)));
        cells
    };
    let caption = "Relative L2 error of one fetch against the same lobe traced from the shading point: of all points, and of those whose lobe \
                   reaches over an edge (a second plane is nearer to where the axis ends than the lobe is wide there).";
    let figure = "Error over that of the planes themselves, in rooms that the laws were not fitted in: below 1 is a gain.";
    let table = words::table(&columns, proxies.gains.iter().map(row).collect(), caption);
    Ok(Section {
        id: "proxy-gains".into(),
        title: "What soft edges gain".into(),
        lead: format!("By the laws above, at {} points of every other room.", proxies.points[1]),
        blocks: vec![figures(&charts, figure)?, Block::Text { text: OUTSIDE.into() }, Block::Table(table)],
    })
}

const OUTSIDE: &str = "A place in a rounded-off corner is outside the rounded body: rays towards the corner meet it at once and fetch next to a mirror, \
     which few such points with a bright panel nearby make the error of. The smooth body is about the shading point and has no outside. \
     Between many planes a small power shrinks it most, so that it may pass the probe.";

/// Proxies that gain nothing have lines above and no column.
fn tabulated(name: &str) -> bool {
    ["smooth", "tied", "eased", "rounded"].iter().any(|kept| name.starts_with(kept))
}

fn ratios(proxies: &ProxiesFindings, room: &str, names: &[String]) -> Curves {
    let of = |(i, name): (usize, &String)| Series {
        name: name.clone(),
        points: proxies
            .gains
            .iter()
            .filter(|gain| gain.room == room)
            .filter_map(|gain| {
                let (_, off) = gain.proxies.iter().find(|(known, _)| known == name)?;
                Some((gain.roughness, off[0] / gain.planes[0]))
            })
            .collect(),
        style: Style::Marked(i),
        end: None,
    };
    Curves {
        title: format!("room {room}"),
        x: ("roughness".into(), Spread::Linear),
        y: ("error over that of the planes".into(), Spread::Linear),
        series: names.iter().enumerate().map(of).collect(),
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size: (340.0, 240.0),
    }
}

/// What is left of the jumps at edges.
fn edges(proxies: &ProxiesFindings) -> Section {
    let columns = [
        ("proxy", false),
        ("α", true),
        ("edges", true),
        ("direction's derivative", true),
        ("ln ρ", true),
        ("derivative of ln ρ", true),
        ("ln ρ over α/5", true),
    ];
    let row = |one: &ProxyCrossing| {
        let mut cells = vec![one.proxy.clone(), significant(one.alpha, 3), one.edges.to_string()];
        cells.extend([one.direction, one.ratio, one.slope, one.lobe].map(|x| significant(x, 3)));
        cells
    };
    let caption = "Rays from a place of room A turn over its edges; means over the edges. Jumps are differences of one-sided values within \
                   1e-7 radians of the edge, of derivatives by differences over 1e-4 radians: a smooth function leaves some 1e-4 of its second \
                   derivative. The last column is the change over a fifth of the lobe's width, which is what is seen of a smooth one. \
                   ρ is the ratio of areas; pushed planes and fades keep the planes' normal, which jumps.";
    Section {
        id: "proxy-edges".into(),
        title: "Jumps at edges".into(),
        lead: "The looked-up direction of the planes has a kink at edges, and the ratio of areas jumps: a seam. Of the smooth body neither does, but at small α \
               it turns so fast that the differences taken here still see a jump.".into(),
        blocks: vec![Block::Table(words::table(&columns, proxies.crossings.iter().map(row).collect(), caption))],
    }
}

/// Powers above this are drawn as this: the body is the planes.
const MOST_SHOWN: f64 = 256.0;
