//! The sections of whole materials.

use lobefit::report::{Block, Origin, Page, Section, TextTable, html};
use lobefit_studies::study::coupling::page::surfaces as surface_sections;
use lobefit_studies::study::coupling::surface::table::Grid;
use lobefit_studies::study::coupling::surface::{Coupling, SurfaceRows, Wanted};
use lobefit_truth::integrate::walk::Walks;

fn rows() -> SurfaceRows {
    let wanted = Wanted {
        couplings: vec![
            Coupling::OneMinusF0,
            Coupling::Pesce,
            Coupling::OneMinusOwnSpecular,
            Coupling::Kelemen,
        ],
        grid: Grid { roughness: vec![0.3, 0.9], mu: vec![0.2, 0.9], f0: vec![0.04, 1.0] },
        walks: Walks { paths: 1 << 12, seed: 2 },
        ..Wanted::reduced().unwrap()
    };
    SurfaceRows::measure(&wanted).unwrap()
}

fn tables(section: &Section) -> Vec<&TextTable> {
    let table = |block: &'_ Block| matches!(block, Block::Table(_));
    section
        .blocks
        .iter()
        .filter(|b| table(b))
        .map(|b| if let Block::Table(t) = b { t } else { unreachable!() })
        .collect()
}

#[test]
fn every_row_is_told() {
    let rows = rows();
    let sections = surface_sections(&rows).unwrap();
    let ids: Vec<&str> = sections.iter().map(|s| s.id.as_str()).collect();
    assert_eq!(ids, ["reciprocity", "colour", "walk"]);
    let all: usize = tables(&sections[0]).iter().map(|t| t.rows.len()).sum();
    assert_eq!(all, rows.reciprocity.len());
    for table in sections.iter().flat_map(tables) {
        assert!(table.rows.iter().all(|row| row.len() == table.columns.len()), "{table:?}");
        assert_eq!(table.muted.len(), table.rows.len());
    }
    // the pick of a path tracer is one that is reciprocal and closes the furnace
    let text = sections[0].blocks.iter().find_map(|b| match b {
        Block::Text { text } => Some(text.clone()),
        _ => None,
    });
    let text = text.unwrap();
    assert!(text.contains("Kelemen") && text.contains("furnace 0 up to f0 0.2, reciprocity "), "{text}");
    let reciprocity = text.rsplit(' ').next().unwrap().trim_end_matches('.');
    let measured: f64 = reciprocity.replace('−', "-").parse().unwrap();
    assert!(measured < 1e-14, "what was measured, not what was declared: {text}");
    let origin = Origin {
        scene: "s".into(),
        recipe: "r".into(),
        tool: "t".into(),
        command: "c".into(),
        pages: Vec::new(),
    };
    let page = html(&Page::new("t", origin, "l", sections));
    assert!(page.contains("Kelemen-Szirmay-Kalos") && page.contains("random walk, exact Fresnel"));
}

#[test]
fn what_is_not_a_number_is_refused_by_its_row() {
    let good = rows();
    let mut bad = good.clone();
    bad.reciprocity[3].reciprocity = f64::NAN;
    assert!(surface_sections(&bad).unwrap_err().to_string().contains("reciprocity"));
    let mut bad = good.clone();
    bad.reciprocity[1].furnace[0].worst = f64::INFINITY;
    assert!(surface_sections(&bad).unwrap_err().to_string().contains("furnace"));
    let mut bad = good.clone();
    bad.colour[2].albedo[1] = f64::NAN;
    assert!(surface_sections(&bad).unwrap_err().to_string().contains("gold"));
    let mut bad = good;
    bad.bounces[0].kulla_conty.pop();
    assert!(surface_sections(&bad).unwrap_err().to_string().contains("walk"));
}
