//! What an audit may cost, in work done and not in seconds: integrals, and values held against columns.

use lobefit_audit::audit::{AuditedTable, Channel, Fit, Fixed, Scale, Source, audit, work};
use lobefit_audit::foreign::Step;
use lobefit_truth::quantity;

/// A table of four channels that are of nothing.
fn odd(size: &[usize], step: Step) -> AuditedTable {
    let texels: usize = size.iter().product();
    let value = |i: usize, c: usize| {
        let x = (i * (c + 3)) as f64 * 0.618_033_988_749;
        (x.fract() * 255.0).round().max(1.0) / 255.0
    };
    let channel = |(c, name): (usize, &str)| Channel {
        name: name.into(),
        values: (0..texels).map(|i| value(i, c)).collect::<Vec<_>>().into(),
    };
    AuditedTable {
        what: "odd".into(),
        size: size.to_vec(),
        axes: AuditedTable::axes_of(size.len()),
        source: Source::Table,
        channels: ["R", "G", "B", "A"].into_iter().enumerate().map(channel).collect(),
        step,
        scale: 1.0,
        dead: Vec::new(),
    }
}

/// A file that follows nothing is the dearest, for everything is tried on it: six encodings,
/// other quantities, each channel. One truth serves all of these, and what loses is judged at few texels.
#[test]
fn a_file_of_nothing_stays_within_a_budget() {
    let spent = |table: &AuditedTable, quantity: &str, fixed: &Fixed| {
        let before = work();
        let found = audit(table, quantity::find(quantity).unwrap(), fixed, &|_| ()).unwrap();
        assert_eq!(found.fit, Fit::None);
        let after = work();
        [after[0] - before[0], after[1] - before[1]]
    };
    let picture = spent(&odd(&[48, 48], Step::Unorm(8)), "ggx-reflection", &Fixed::default());
    let axes = Some(vec![(Scale::Mu, false), (Scale::Roughness, false), (Scale::IorUnit, false)]);
    let solid = spent(&odd(&[24, 24, 24], Step::None), "ggx-glass", &Fixed { axes, ..Fixed::default() });
    println!("{picture:?} {solid:?}");
    assert!(picture[0] < 12_000 && picture[1] < 240_000_000, "{picture:?}");
    assert!(solid[0] < 150_000 && solid[1] < 20_000_000, "{solid:?}");
}
