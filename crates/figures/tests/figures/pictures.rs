//! The pictures themselves, read back by an independent decoder.

use base64::Engine;
use lobefit_figures::{
    Cells, Curves, Field, Figure, Gallery, HeatMap, Image, ReportError, Ruler, Series, Shade, SphereRow,
    Spheres, Spread, Style, Tile,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

type Picture = (usize, Vec<[u8; 3]>);

/// Width, and the colours row by row, of the first PNG in a piece of SVG.
fn first_picture(svg: &str) -> Result<Picture, Box<dyn std::error::Error>> {
    let start = svg.split_once("base64,").ok_or("no picture")?.1;
    let text = start.split_once('"').ok_or("no end of picture")?.0;
    let bytes = base64::engine::general_purpose::STANDARD.decode(text)?;
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("size")?];
    let info = reader.next_frame(&mut pixels)?;
    let colours = pixels[..info.buffer_size()].chunks(3).map(|c| [c[0], c[1], c[2]]).collect();
    Ok((info.width as usize, colours))
}

/// 3 columns, 2 rows: -1 at the lower left, 0 beside it, +1 at the upper right.
fn corners() -> Field {
    let (x, y) = (Ruler::even("roughness", 0.0, 1.0, 3), Ruler::even("mu", 0.0, 1.0, 2));
    Field { values: vec![-1.0, 0.0, 0.5, 0.25, 0.0, 1.0], ..Field::sample("error", true, x, y, |_, _| 0.0) }
}

const WHITE: [u8; 3] = [255, 255, 255];

#[test]
fn a_heat_map_has_its_origin_at_the_lower_left_and_white_at_zero() -> Outcome {
    let field = corners();
    let (width, pixels) = first_picture(&HeatMap::of("error", &field).svg()?)?;
    assert_eq!((width, pixels.len()), (3, 6));
    let [r, _, b] = pixels[3];
    assert!(b > r, "lower left is below zero, so blue: {:?}", pixels[3]);
    let [r, _, b] = pixels[2];
    assert!(r > b, "upper right is above zero, so red: {:?}", pixels[2]);
    assert_eq!((pixels[1], pixels[4]), (WHITE, WHITE));
    let texture = HeatMap { top_down: true, ..HeatMap::of("error", &field) };
    let (_, flipped) = first_picture(&texture.svg()?)?;
    assert_eq!((flipped[0], flipped[5]), (pixels[3], pixels[2]), "a texture has its first row at the top");
    Ok(())
}

#[test]
fn a_heat_map_marks_its_worst_place_with_a_bound() -> Outcome {
    let mut field = corners();
    field.values[5] = 1.2341;
    assert!(HeatMap::of("error", &field).svg()?.contains("1.3\n"), "rounded up");
    Ok(())
}

/// One sphere in one colour of light.
fn sphere(factor: &[Vec<f64>], shade: Shade) -> Result<String, ReportError> {
    let rows = vec![SphereRow { name: "row".into(), factors: factor }];
    let (title, unit) = ("sphere".into(), String::new());
    let column_name = "roughness".into();
    Spheres { title, column_name, columns: &[0.5], mu: &[0.0, 1.0], rows, shade, unit, cell: 78 }.svg()
}

#[test]
fn a_perfect_sphere_vanishes_and_a_lossy_one_does_not() -> Outcome {
    for shade in [Shade::Departure { limit: 0.1 }, Shade::Radiance { white: 1.25 }] {
        let (_, perfect) = first_picture(&sphere(&[vec![1.0, 1.0]], shade)?)?;
        assert!(perfect.iter().all(|&p| p == perfect[0]), "{shade:?}: no trace of a perfect sphere");
        let (width, lossy) = first_picture(&sphere(&[vec![0.95, 0.95]], shade)?)?;
        assert_eq!(lossy[0], perfect[0], "{shade:?}: the environment stays as it is");
        assert_ne!(lossy[(width / 2) * width + width / 2], perfect[0], "{shade:?}: half a scale is seen");
    }
    Ok(())
}

#[test]
fn a_sphere_shows_grazing_views_at_its_rim_and_a_smooth_edge() -> Outcome {
    // factor = mu: 1 at the centre, as the environment; 0 at the rim.
    let (width, pixels) = first_picture(&sphere(&[vec![0.0, 1.0]], Shade::Radiance { white: 1.0 })?)?;
    let row = &pixels[(width / 2) * width..][..width];
    assert_eq!(row[width / 2], row[0], "centre");
    let darkest = row.iter().map(|p| p[0]).min().unwrap_or(255);
    assert!(darkest < 130, "rim at {darkest}");
    let tones: std::collections::BTreeSet<u8> = row.iter().map(|p| p[0]).collect();
    assert!(tones.len() > 25, "{} tones from rim to centre", tones.len());
    Ok(())
}

#[test]
fn curves_refuse_what_a_logarithmic_axis_cannot_show() {
    let chart = |x: f64| Curves {
        title: "study".into(),
        x: ("evaluations".into(), Spread::Log),
        y: ("error".into(), Spread::Log),
        series: vec![Series::line("rule", vec![(x, 0.1)], Style::Marked(0))],
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size: (300.0, 200.0),
    };
    assert!(chart(8.0).svg().is_ok());
    assert!(matches!(chart(0.0).svg(), Err(ReportError::Domain { .. })));
    assert!(matches!(chart(f64::NAN).svg(), Err(ReportError::NotFinite { .. })));
    assert!(matches!(Curves { series: Vec::new(), ..chart(8.0) }.svg(), Err(ReportError::Empty { .. })));
}

/// A picture, a map and nothing, each of one pixel.
fn tiles(names: [&str; 3], values: Vec<f64>) -> Gallery {
    let image = Image { width: 1, height: 1, pixels: vec![[1.0, 0.0, 0.0]] };
    let shade = Shade::Magnitude { min: 0.0, max: 2.0, spread: Spread::Linear };
    let tiles = vec![vec![Tile::Colours(image), Tile::Values(values), Tile::Nothing]];
    Gallery {
        title: "tiles".into(),
        column_name: String::new(),
        columns: names.map(String::from).into(),
        rows: vec!["row".into()],
        side: 1,
        cell: 80.0,
        cells: Cells::Tiles { tiles, shade, unit: "unit".into() },
    }
}

#[test]
fn colours_values_and_nothing_stand_side_by_side() -> Outcome {
    let (width, pixels) = first_picture(&tiles(["a", "b", "c"], vec![5.0]).svg()?)?;
    assert_eq!((width, &pixels[..]), (3, &[[255, 0, 0], [0xFD, 0xE7, 0x25], [0xD8; 3]][..]));
    let (_, pixels) = first_picture(&tiles(["a", "b", "c"], vec![0.0]).svg()?)?;
    assert_eq!(pixels[1], [0x44, 0x01, 0x54], "the darkest");
    for values in [vec![], vec![1.0, 1.0], vec![f64::NAN]] {
        let refused = tiles(["a", "b", "c"], values).svg().expect_err("refused").to_string();
        assert!(refused.contains("row row, column b"), "{refused}");
    }
    Ok(())
}

#[test]
fn long_names_of_columns_are_broken_into_lines() -> Outcome {
    let height = |svg: &str| -> Result<f64, Box<dyn std::error::Error>> {
        let height = svg.split_once(" height=\"").ok_or("no height")?.1;
        Ok(height.split_once('"').ok_or("no end")?.0.parse()?)
    };
    let short = tiles(["a", "b", "c"], vec![1.0]).svg()?;
    let long = tiles(["a", "3 fetches, fitted lobe", "c"], vec![1.0]).svg()?;
    assert_eq!(height(&long)? - height(&short)?, 14.0, "one line more");
    let drawn = long.split_once("viewBox").ok_or("no drawing")?.1;
    assert!(!drawn.contains("3 fetches, fitted lobe") && drawn.contains("3 fetches,"), "{drawn}");
    Ok(())
}
