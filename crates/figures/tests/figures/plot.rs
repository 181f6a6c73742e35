//! Scales, colours and texts of figures, as their SVG has them.

use ab_glyph::{Font, FontRef};
use lobefit_figures::{
    Cells, Curves, Dot, Figure, Gallery, Image, Scale, Scatter, Series, Shade, Spread, Style, Tile,
};

type Failed = Box<dyn std::error::Error>;
type Outcome = Result<(), Failed>;

/// Place and words.
type Text = (f64, f64, String);

/// The number of an attribute, and of a coordinate in pixels: ten units each.
fn number(element: &str, name: &str) -> Result<f64, Failed> {
    let rest = element.split_once(&format!(" {name}=\"")).ok_or(format!("no {name} in {element}"))?.1;
    Ok(rest.split_once('"').ok_or("no end")?.0.parse()?)
}

/// Places and words of the texts of a figure.
fn texts(svg: &str) -> Result<Vec<Text>, Failed> {
    let elements = svg.split("<text").skip(1).map(|rest| {
        let (tag, rest) = rest.split_once('>').ok_or("no tag")?;
        let words = rest.split_once("</text>").ok_or("no text")?.0.trim().to_string();
        Ok((number(tag, "x")? / 10.0, number(tag, "y")? / 10.0, words))
    });
    elements.collect()
}

/// A chart of lines that have no other points than these, one pixel high each.
fn chart(title: &str, ends: &[f64]) -> Curves {
    let series = |(i, y): (usize, &f64)| Series {
        name: String::new(),
        points: vec![(1.0, *y)],
        style: Style::Line(0),
        end: Some(format!("end {i}")),
    };
    Curves {
        title: title.into(),
        x: ("x".into(), Spread::Linear),
        y: ("y".into(), Spread::Linear),
        series: ends.iter().enumerate().map(series).collect(),
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: Some((0.0, 250.0)),
        size: (400.0, 250.0),
    }
}

/// Lines of one colour differ in their width, which the style of a page makes dashes and dots of.
#[test]
fn lines_of_one_colour_have_widths_of_their_own_also_in_the_legend() -> Outcome {
    let series = |i: usize| {
        Series::line(format!("line {i}"), vec![(1.0, 9.0 + i as f64), (2.0, 8.0)], Style::Marked(i))
    };
    let svg = Curves { series: [2, 9, 16].map(series).into(), ..chart("three", &[]) }.svg()?;
    for width in ["16", "17", "15"] {
        // The line, and its key.
        assert_eq!(svg.matches(&format!("stroke-width=\"{width}\"")).count(), 2, "{width}: {svg}");
    }
    Ok(())
}

#[test]
fn a_sheet_escapes_its_name_and_its_texts() -> Outcome {
    let svg = chart("<a href=\"x\" b='&'>", &[1.0]).svg()?;
    assert!(svg.contains("aria-label=\"&lt;a href=&quot;x&quot; b=&#39;&amp;&#39;&gt;\""), "{svg}");
    assert!(!svg.contains("<a "), "{svg}");
    assert!(svg.matches("</svg>").count() == 1, "{svg}");
    Ok(())
}

#[test]
fn texts_at_ends_that_meet_stay_apart_and_beside_the_frame() -> Outcome {
    // Heights above the foot of the frame, from the bottom up.
    let of = |wanted: &[f64]| -> Result<Vec<f64>, Failed> {
        let svg = chart("t", wanted).svg()?;
        let foot = number(&svg, "height")? - 44.0;
        let mut heights: Vec<f64> = texts(&svg)?
            .into_iter()
            .filter(|(.., words)| words.starts_with("end "))
            .map(|(_, y, _)| foot - y)
            .collect();
        heights.sort_by(f64::total_cmp);
        Ok(heights)
    };
    for wanted in [
        vec![250.0; 5],
        vec![0.0; 5],
        vec![100.0, 101.0, 240.0, 248.0, 249.0],
        vec![0.0, 10.0, 150.0, 151.0, 245.0],
    ] {
        let heights = of(&wanted)?;
        assert_eq!(heights.len(), 5);
        // Units of SVG are a tenth of a pixel.
        assert!(heights.windows(2).all(|w| w[1] - w[0] >= 12.0 - 0.11), "{wanted:?}: {heights:?}");
        assert!(heights.iter().all(|y| (-0.1..=250.1).contains(y)), "{wanted:?}: {heights:?}");
    }
    for (found, wanted) in of(&[100.0, 200.0])?.into_iter().zip([100.0, 200.0]) {
        assert!((found - wanted).abs() < 0.11, "{found} {wanted}");
    }
    Ok(())
}

/// The lines that the name of a column 170 pixels wide is broken into.
fn broken(name: &str) -> Result<Vec<String>, Failed> {
    let image = Image { width: 1, height: 1, pixels: vec![[1.0, 0.0, 0.0]] };
    let gallery = Gallery {
        title: "t".into(),
        column_name: String::new(),
        columns: vec![name.into()],
        rows: vec!["row".into()],
        side: 1,
        cell: 174.0,
        cells: Cells::Tiles {
            tiles: vec![vec![Tile::Colours(image)]],
            shade: Shade::Departure { limit: 1.0 },
            unit: "unit".into(),
        },
    };
    let texts = texts(&gallery.svg()?)?;
    let begins = |words: &str| !words.is_empty() && name.starts_with(words.trim_end_matches('\u{2026}'));
    let (x, ..) = *texts.iter().find(|(.., words)| begins(words)).ok_or("no name")?;
    let mut lines: Vec<_> = texts.into_iter().filter(|text| text.0 == x).collect();
    lines.sort_by(|a, b| a.1.total_cmp(&b.1));
    Ok(lines.into_iter().map(|(.., words)| words).collect())
}

#[test]
fn a_long_name_is_wrapped_and_keeps_its_end() -> Outcome {
    let name = "ggx-dfg-correlated-64x64-split-sum";
    let lines = broken(name)?;
    assert!(lines.len() == 2 && lines.concat() == name, "{lines:?}");
    assert_eq!(broken("short")?, ["short"]);
    let endless = broken(&"word-".repeat(100))?;
    assert!(endless.len() == 3 && endless[2].ends_with('\u{2026}'), "{endless:?}");
    assert_eq!(broken(&"x".repeat(100))?.len(), 1, "nowhere to break");
    Ok(())
}

/// A rectangle: left, top, right, bottom.
type Frame = [f64; 4];

fn overlap(a: Frame, b: Frame) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// A line from a point to its label.
type Leader = [(f64, f64); 2];

/// The frame of a label, and its leader where it has one.
type Label = (Frame, Option<Leader>);

/// The frame of a chart of tables at such points, and their labels with their leaders. A label is as
/// wide as its text in the page's font, with 2 pixels beside it, and 14 pixels high.
fn labelled(points: &[(f64, f64)], name: &str, size: (f64, f64)) -> Result<(Frame, Vec<Label>), Failed> {
    let dot = |x, y, name: String, published| Dot { name, x, y, published, table: true };
    let names = (0..points.len()).map(|i| format!("{name}{i}"));
    let mut dots: Vec<Dot> = points.iter().zip(names.clone()).map(|(p, n)| dot(p.0, p.1, n, false)).collect();
    // The corners of the chart; of more than eight points the published ones have no names.
    dots.extend(
        (0..4).map(|i| dot(size.0 * f64::from(i % 2), size.1 * f64::from(i / 2), "corner".into(), true)),
    );
    let axis = |name: &str| (name.to_string(), Spread::Linear);
    let svg = Scatter { title: "t".into(), x: axis("x"), y: axis("y"), dots, size }.svg()?;
    let [right, bottom] = [number(&svg, "width")? - 18.0, number(&svg, "height")? - 44.0];
    let font = FontRef::try_from_slice(include_bytes!("../../assets/DejaVuSans-subset.ttf"))?;
    let em = f64::from(font.units_per_em().ok_or("no size")?);
    let advance =
        |text: &str| text.chars().map(|c| f64::from(font.h_advance_unscaled(font.glyph_id(c)))).sum::<f64>();
    let texts = texts(&svg)?;
    let lines = svg
        .split("<polyline")
        .skip(1)
        .filter(|line| line.split('>').next().is_some_and(|tag| tag.contains("stroke-width=\"6\"")));
    let mut leaders: Vec<Leader> = Vec::new();
    for line in lines {
        let points = line.split_once("points=\"").ok_or("no points")?.1.split_once('"').ok_or("no end")?.0;
        let numbers: Vec<f64> =
            points.split([' ', ',']).filter(|n| !n.is_empty()).map(str::parse).collect::<Result<_, _>>()?;
        let [a, b, c, d] = numbers[..] else { return Err(format!("{points}: no line").into()) };
        leaders.push([(a / 10.0, b / 10.0), (c / 10.0, d / 10.0)]);
    }
    let mut labels = Vec::new();
    for name in names {
        let (x, y, _) = texts.iter().find(|(.., words)| *words == name).ok_or(format!("no {name}"))?;
        let half = advance(&name) / em * 11.0 / 2.0 + 2.0;
        let frame = [x - half, y - 7.0, x + half, y + 7.0];
        let ends_here = |[_, (x, y)]: &&Leader| {
            *x > frame[0] - 0.2 && *x < frame[2] + 0.2 && *y > frame[1] - 0.2 && *y < frame[3] + 0.2
        };
        labels.push((frame, leaders.iter().find(ends_here).copied()));
    }
    let used = labels.iter().filter(|(_, leader)| leader.is_some()).count();
    assert_eq!(used, leaders.len(), "a leader to each label that has one");
    Ok(([right - size.0, bottom - size.1, right, bottom], labels))
}

/// Places are rounded to a tenth of a pixel.
fn within([left, top, right, bottom]: Frame) -> Frame {
    [left + 0.1, top + 0.1, right - 0.1, bottom - 0.1]
}

#[test]
fn thirty_labels_in_a_crowd_do_not_touch() -> Outcome {
    let points: Vec<(f64, f64)> =
        (0..30).map(|i| (200.0 + f64::from(i % 6) * 21.0, 150.0 + f64::from(i / 6) * 17.0)).collect();
    let (inside, labels) = labelled(&points, "rational-fit-", (700.0, 400.0))?;
    for (i, (a, _)) in labels.iter().enumerate() {
        let a = within(*a);
        assert!(
            a[0] >= inside[0] && a[1] >= inside[1] && a[2] <= inside[2] && a[3] <= inside[3],
            "label {i}"
        );
        assert!(!labels[i + 1..].iter().any(|(b, _)| overlap(a, within(*b))), "label {i}");
    }
    Ok(())
}

/// Whether two segments cross.
fn cross([a, b]: Leader, [c, d]: Leader) -> bool {
    let side =
        |p: (f64, f64), q: (f64, f64), r: (f64, f64)| (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// A column of points at the right edge, as costs that many formulas share: no leader crosses another
/// or a name.
#[test]
fn leaders_of_a_column_at_an_edge_do_not_cross() -> Outcome {
    let points: Vec<(f64, f64)> = (0..6).map(|i| (500.0, 100.0 + f64::from(i) * 13.0)).collect();
    let (_, labels) = labelled(&points, "charlie_e_gauss_rms_", (540.0, 400.0))?;
    assert!(labels.iter().any(|(_, leader)| leader.is_some()), "{labels:?}");
    for (i, (_, leader)) in labels.iter().enumerate() {
        let Some(leader) = leader else { continue };
        let [from, to] = *leader;
        for (j, (frame, other)) in labels.iter().enumerate().filter(|(j, _)| *j != i) {
            assert!(!other.is_some_and(|other| cross(*leader, other)), "{i} {j}");
            // Small squares every pixel or so along the line.
            let beads = (0..=400).map(|k| f64::from(k) / 400.0).map(|t| {
                let (x, y) = (from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t);
                [x - 0.9, y - 0.9, x + 0.9, y + 0.9]
            });
            assert!(!beads.into_iter().any(|bead| overlap(bead, within(*frame))), "{i} {j}");
        }
    }
    Ok(())
}

#[test]
fn ticks_are_round_numbers() {
    let labels = |s: Scale, n| -> Vec<String> { s.ticks(n).into_iter().filter_map(|t| t.label).collect() };
    let linear = Scale { spread: Spread::Linear, min: 0.02, max: 1.0 };
    assert_eq!(labels(linear, 5), ["0.2", "0.4", "0.6", "0.8", "1"]);
    let log = Scale { spread: Spread::Log, min: 1e-3, max: 0.2 };
    assert_eq!(labels(log, 5), ["0.001", "0.002", "0.005", "0.01", "0.02", "0.05", "0.1", "0.2"]);
}

#[test]
fn an_axis_has_two_ticks_at_least() {
    for (spread, min, max, wanted) in [
        (Spread::Linear, 0.02, 0.33, &["0.1", "0.2", "0.3"][..]),
        (Spread::Linear, 0.1, 0.26, &["0.1", "0.2"]),
        (Spread::Log, 0.15, 0.45, &["0.2", "0.3", "0.4"]),
        (Spread::Log, 0.21, 0.29, &["0.22", "0.24", "0.26", "0.28"]),
    ] {
        let ticks = Scale { spread, min, max }.ticks(2).into_iter();
        let labels: Vec<String> = ticks.filter_map(|tick| tick.label).collect();
        assert_eq!(labels, wanted, "{spread:?} {min} {max}");
    }
}

#[test]
fn a_root_axis_has_ticks_at_any_size() {
    for max in [0.7, 3.0, 56.0, 1584.0] {
        let scale = Scale::around(Spread::Root, [max].into_iter());
        let labels: Vec<String> = scale.ticks(10).into_iter().filter_map(|t| t.label).collect();
        assert!((5..=11).contains(&labels.len()), "{max}: {labels:?}");
    }
    let scale = Scale { spread: Spread::Root, min: 0.0, max: 56.0 };
    let labels: Vec<String> = scale.ticks(10).into_iter().filter_map(|t| t.label).collect();
    assert_eq!(labels, ["0", "1", "5", "10", "20", "30", "40", "50"]);
    let fine: Vec<String> = scale.ticks(15).into_iter().filter_map(|t| t.label).collect();
    assert_eq!(fine[..3], ["0", "1", "2"], "whole operations alone");
}

#[test]
fn an_axis_by_root_begins_near_its_first_value() {
    let late = [3.0, 4.0, 5.0, 12.0];
    let scale = Scale::around(Spread::Root, late.into_iter()).roomy(late.into_iter());
    assert!((0.03..0.1).contains(&scale.position(3.0)), "{scale:?}");
    let labels: Vec<String> = scale.ticks(10).into_iter().filter_map(|t| t.label).collect();
    assert_eq!((labels[0].as_str(), labels.last().map(String::as_str)), ("3", Some("10")));
    let early = [1.0, 60.0];
    assert_eq!(Scale::around(Spread::Root, early.into_iter()).min, 0.0);
    let one_tick = [41.0, 43.0, 48.0];
    let scale = Scale::around(Spread::Root, one_tick.into_iter());
    assert!(scale.ticks(10).len() > 1, "{:?}", scale.ticks(10));
}

#[test]
fn a_value_on_the_frame_gets_room() {
    for spread in [Spread::Linear, Spread::Log, Spread::Root] {
        let values = [0.01, 0.4, 1.0];
        let scale = Scale { spread, min: 0.01, max: 2.0 };
        let roomy = scale.roomy(values.iter().copied());
        assert!(roomy.position(0.01) > 0.03, "{roomy:?}");
        assert_eq!(roomy.max, 2.0, "nothing sits at the upper end");
    }
}

#[test]
fn a_scale_holds_its_values() {
    let values = [3.2, 3.2];
    for spread in [Spread::Linear, Spread::Log, Spread::Root] {
        let scale = Scale::around(spread, values.iter().copied());
        assert!(scale.min <= 3.2 && scale.max >= 3.2 && scale.min < scale.max, "{scale:?}");
    }
}

#[test]
fn zero_is_white_and_the_ends_are_deep() {
    let shade = Shade::Signed { limit: 0.1, spread: Spread::Root };
    let palette = shade.palette();
    let colour = |v: f64| &palette[3 * usize::from(shade.level(v))..][..3];
    assert_eq!(colour(0.0), [255, 255, 255]);
    assert_eq!(colour(0.2), [0x67, 0x00, 0x1F]);
    assert_eq!(colour(-0.1), [0x05, 0x30, 0x61]);
    assert_ne!(colour(1e-4), [255, 255, 255], "a thousandth of the limit is visible");
}
