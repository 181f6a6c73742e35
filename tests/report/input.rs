//! What the report refuses, and what it does with names that would break a page.

use crate::report_support;

use lobefit::report::{self, Findings, ReportError};
use report_support::{findings, timings};

/// Something done to findings.
type Spoil = Box<dyn FnOnce(&mut Findings)>;

/// The message for findings spoilt in one place.
fn refused(spoil: impl FnOnce(&mut Findings)) -> String {
    let mut spoilt = findings();
    spoil(&mut spoilt);
    match report::page("reflection", &spoilt) {
        Ok(_) => "accepted".into(),
        Err(e) => e.to_string(),
    }
}

/// The first furnace of the findings.
fn furnace(f: &mut Findings) -> &mut report::Furnace {
    f.furnace.get_or_insert_with(|| unreachable!("the synthetic findings have a furnace"))
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    let cases: Vec<(Spoil, &str)> = vec![
        (
            Box::new(|f| f.effects[0].measured_error = Some(f64::NAN)),
            "effects[0].measured_error is not finite",
        ),
        (
            Box::new(|f| f.approximations[3].certificate.rms = f64::INFINITY),
            "approximations[3].certificate.rms is not",
        ),
        (Box::new(|f| f.truths[0].values[7] = f32::NAN), "truth: E: values[7] is not finite"),
        (
            Box::new(|f| f.fits[2].curves[1].fit[5] = f64::NEG_INFINITY),
            "fit n_sqrt: curve at roughness 0.3: fit[5] is not finite",
        ),
        (
            Box::new(|f| furnace(f).rows[1].factors[2][3] = f64::NAN),
            "row ggx-dfg 32x32 f16, column 2[3] is not finite",
        ),
        (
            Box::new(|f| f.tables[0].channels[1].texels[9] = f64::NAN),
            "table ggx-dfg-correlated-32-f16: channel B: texels[9] is not finite",
        ),
    ];
    for (spoil, expected) in cases {
        let message = refused(spoil);
        assert!(message.contains(expected), "{message} lacks {expected}");
    }
}

#[test]
fn empty_and_mismatched_lists_are_named() {
    let cases: Vec<(Spoil, &str)> = vec![
        (Box::new(|f| f.fits[0].curves.clear()), "fit n_linear_max: curves is empty"),
        (
            Box::new(|f| {
                f.fits[0].curves[0].truth.pop();
            }),
            "roughness 0.1: truth has 99 entries, expected 100",
        ),
        (Box::new(|f| f.fits[0].name = "nobody".into()), "fit nobody: name is not among the approximations"),
        (
            Box::new(|f| {
                f.truths[1].values.pop();
            }),
            "truth: 1/E: values has 9215 entries, expected 9216",
        ),
        (
            Box::new(|f| f.approximations[5].name = "n_sqrt".into()),
            "approximations: name n_sqrt is used twice",
        ),
        (Box::new(|f| f.truths[1].x.values[1] = 0.0), "truth: 1/E: roughness[1] does not increase"),
        (Box::new(|f| f.tables[1].channels.clear()), "table ggx-dfg-correlated-64-f16: channels is empty"),
        (
            Box::new(|f| {
                f.tables[1].channels[0].texels.pop();
            }),
            "channel E: texels has 4095 entries, expected 4096",
        ),
        (
            Box::new(|f| f.averages.iter_mut().for_each(|a| a.fits[0].values.truncate(3))),
            "average E_avg: fit eavg_5 has 3 entries, expected 33",
        ),
        (
            Box::new(|f| f.averages.iter_mut().for_each(|a| a.fits[0].name = "nobody".into())),
            "average E_avg: fit nobody is not among the approximations",
        ),
        (Box::new(|f| furnace(f).rows.clear()), "furnace: rows is empty"),
        (
            Box::new(|f| {
                furnace(f).rows[1].factors.pop();
            }),
            "row ggx-dfg 32x32 f16 has 6 entries, expected 7",
        ),
        (Box::new(|f| furnace(f).amplification = 0.0), "furnace: amplification must be positive"),
    ];
    for (spoil, expected) in cases {
        let message = refused(spoil);
        assert!(message.contains(expected), "{message} lacks {expected}");
    }
    let mut spoilt = timings();
    spoilt.evaluations[0].nanoseconds = -1.0;
    assert!(matches!(report::timings_page(&spoilt), Err(ReportError::Domain { .. })));
}

/// Markup, quotes, the end of a comment, right-to-left override, a line break and a letter the font
/// lacks.
const HOSTILE: &str = "<script>alert(\"1\")</script>'&amp;-->\u{202e}\n漢]]>";

#[test]
fn names_from_a_scene_cannot_leave_their_place() -> Result<(), Box<dyn std::error::Error>> {
    let mut spoilt = findings();
    spoilt.origin.scene = HOSTILE.into();
    spoilt.origin.command = HOSTILE.into();
    spoilt.origin.recipe = HOSTILE.into();
    spoilt.origin.tool = HOSTILE.into();
    spoilt.effects[0].because = vec![HOSTILE.into()];
    spoilt.left_out[0].reason = HOSTILE.into();
    spoilt.tables[0].name = HOSTILE.into();
    spoilt.tables[0].channels[0].name = HOSTILE.into();
    spoilt.truths[0].name = HOSTILE.into();
    spoilt.truths[0].unit = HOSTILE.into();
    spoilt.truths[0].x.name = HOSTILE.into();
    for (a, f) in [(0, 0), (1, 1)] {
        spoilt.approximations[a].name = format!("{a}{HOSTILE}");
        spoilt.fits[f].name = format!("{a}{HOSTILE}");
        spoilt.fits[f].formula = HOSTILE.into();
    }
    spoilt.approximations[15].source = HOSTILE.into();
    furnace(&mut spoilt).rows[2].name = HOSTILE.into();
    let files = report::page("reflection", &spoilt)?.files("");
    let html = std::str::from_utf8(&files[0].bytes)?;
    assert_eq!(html.matches("<script").count(), 1, "no markup from names");
    assert_eq!(html.matches("-->").count(), 1, "the header's comment ends once");
    assert!(html.contains("&lt;script&gt;"), "the name is shown");
    let value: serde_json::Value = serde_json::from_slice(&files[1].bytes)?;
    assert_eq!(value["origin"]["scene"], HOSTILE);
    Ok(())
}

#[test]
fn odd_but_legal_data_is_shown() -> Result<(), ReportError> {
    let mut odd = findings();
    odd.truths[0].values.fill(1.0);
    for value in &mut odd.fits[0].error.values {
        *value = 0.0;
    }
    odd.approximations[0].certificate.max_abs = 0.0;
    odd.furnace.iter_mut().for_each(|f| {
        f.mu = vec![1.0];
        f.rows.iter_mut().for_each(|r| r.factors.iter_mut().for_each(|c| c.truncate(1)));
    });
    let single = report::Field::sample(
        "one texel",
        true,
        report::Ruler::even("mu", 0.5, 0.5, 1),
        report::Ruler { name: "roughness".into(), values: vec![1e-4, 1e-2, 1.0] },
        |_, _| 1e-30,
    );
    odd.tables[0].lookup_error.push(single);
    let files = report::page("reflection", &odd)?.files("");
    let html = String::from_utf8_lossy(&files[0].bytes).into_owned();
    assert!(html.contains("Exact, so not on a logarithmic axis: n_linear_max."));
    Ok(())
}
