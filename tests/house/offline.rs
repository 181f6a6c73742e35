//! What `docs/cost.md` says of accuracy offline is what the record holds.

use lobefit::report::OfflineStudy;
use lobefit::timing::offline;
use lobefit_math::numbers::significant;
use lobefit_truth::accuracy::{Curve, Walk};

use crate::texts::read;

/// Orders and seconds to an error of 1e-4 of every way to compute E, at the easy and at the hard point, and
/// random walks beside samples.
#[test]
fn the_offline_costs_are_the_records() {
    let record = offline::read(read("reports/offline/xeon.json").as_bytes()).expect("a record");
    let [easy, hard] = record.studies.first_chunk().expect("both points");
    let cells = |study: &OfflineStudy, i: usize| {
        let curve = &study.curves[i];
        let order = curve.order(2.0 * study.bound).map_or("–".into(), |p| significant(p, 2));
        let seconds = curve.seconds_to(1e-4).map_or("–".into(), |(seconds, beyond)| {
            format!("{}{}", if beyond { "~" } else { "" }, significant(seconds, 2))
        });
        format!("{order} | {seconds}")
    };
    let shown = |curve: &Curve| curve.sequence.as_deref() != Some("stratified") && curve.way != "cosine";
    let row = |(i, curve): (usize, &Curve)| {
        let points = curve.sequence.clone().unwrap_or_default();
        format!("| {} | {points} | {} | {} |", curve.way, cells(easy, i), cells(hard, i))
    };
    let rows: Vec<String> =
        easy.curves.iter().enumerate().filter(|(_, curve)| shown(curve)).map(row).collect();
    let page = read("docs/cost.md");
    let section = page.split("\n## Offline").nth(1).and_then(|rest| rest.split("\n## ").next()).expect("it");
    let found: Vec<&str> = section.lines().filter(|line| line.starts_with("| ")).skip(1).collect();
    assert_eq!(found, rows, "the rows should be:\n{}\n", rows.join("\n"));
    let walks = record.studies.iter().filter_map(|study| Some((study, study.walk?)));
    let walk = |(study, walk): (&OfflineStudy, Walk)| {
        let [path, sample] = walk.nanoseconds;
        let [walked, drawn, _] = walk.seconds;
        let [one, all] = [path / sample, walked / drawn].map(|ratio| significant(ratio, 2));
        format!("{} of `{}` {one} and {all}", study.output, study.quantity)
    };
    let walks: Vec<String> = walks.step_by(2).map(walk).collect();
    let told = format!("{}.", walks.join(", "));
    assert!(section.replace('\n', " ").contains(&told), "{told}");
}
