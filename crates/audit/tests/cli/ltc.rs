//! `lobefit audit --as ltc`: tables of linearly transformed cosines that the test makes.

use crate::common;

use common::{lobefit, stderr};
use lobefit_audit::foreign::{Channel, ForeignTable, Step};
use lobefit_audit::ltc::pair;
use lobefit_ltc::{Lobe, Pair};
use lobefit_truth::optics::Smith;
use serde_json::Value;

const SIDE: usize = 8;

/// The texels as raw f32.
fn raw(texels: &[[f64; 4]]) -> Vec<u8> {
    texels.iter().flatten().flat_map(|x| (*x as f32).to_le_bytes()).collect()
}

#[test]
fn a_pair_is_measured_and_one_that_is_off_fails() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    let pair = Pair::fitted(Lobe::Ggx(Smith::Correlated), SIDE, |roughness| roughness * roughness).unwrap();
    write("matrices.raw", &raw(&pair.matrices));
    write("scales.raw", &raw(&pair.amplitudes));
    // The two rows of a matrix exchanged, as by who reads it transposed.
    let turned: Vec<[f64; 4]> = pair.matrices.iter().map(|[a, b, c, d]| [*a, *c, *b, *d]).collect();
    write("turned.raw", &raw(&turned));
    let run = |file: &str, more: &[&str]| {
        let all = ["audit", file, "--as", "ltc", "--size", "8x8", "--channels", "4", "--raw-format", "f32"];
        let domain = ["--domain", "roughness=0.4..1,mu=0.2..1"];
        lobefit(folder.path(), &[&all[..], &domain, more].concat(), b"")
    };
    let passed = run("matrices.raw", &["--scales", "scales.raw", "--limit", "0.15"]);
    assert_eq!(passed.status.code(), Some(0), "{}", stderr(&passed));
    let text = String::from_utf8(passed.stdout).unwrap();
    assert!(text.starts_with("PASS with --limit 0.15: matrices.raw:"), "{text}");
    assert!(text.contains("GGX, correlated Smith") && text.contains("worst at roughness"), "{text}");
    assert!(text.contains("  E: 0.0"), "{text}");
    // Both in one file, the eight of a texel together, as Babylon.js reads them.
    let both = pair.matrices.iter().zip(&pair.amplitudes).flat_map(|(matrix, light)| [*matrix, *light]);
    write("both.raw", &raw(&both.collect::<Vec<_>>()));
    let words = ["audit", "both.raw", "--as=ltc", "--size", "8x8", "--channels", "8", "--raw-format", "f32"];
    let domain = ["--domain", "roughness=0.4..1,mu=0.2..1", "--limit", "0.15"];
    let of_both = lobefit(folder.path(), &[&words[..], &domain].concat(), b"");
    assert_eq!(of_both.status.code(), Some(0), "{}", stderr(&of_both));
    assert_eq!(String::from_utf8(of_both.stdout).unwrap(), text.replace("matrices.raw", "both.raw"));
    let twice = lobefit(folder.path(), &[&words[..], &["--scales", "scales.raw"]].concat(), b"");
    assert_eq!(twice.status.code(), Some(2), "{}", stderr(&twice));
    assert!(stderr(&twice).contains("leave --scales out"), "{}", stderr(&twice));
    let alone = run("matrices.raw", &["--limit", "0.15"]);
    assert_eq!(alone.status.code(), Some(1), "{}", stderr(&alone));
    let text = String::from_utf8(alone.stdout).unwrap();
    assert!(
        text.starts_with("UNKNOWN with --limit 0.15: ") && text.contains("E and B: not judged"),
        "{text}"
    );
    let failed = run("turned.raw", &["--limit", "0.15", "--json"]);
    assert_eq!(failed.status.code(), Some(1), "{}", stderr(&failed));
    let found: Value = serde_json::from_slice(&failed.stdout).unwrap();
    assert_eq!((&found["grade"], found["errors"].as_array().unwrap().len()), (&"FAIL".into(), 2));
    assert!(found["errors"][0]["max"].as_f64().unwrap() > 0.3, "{found}");
    let mut broken = pair.matrices.clone();
    broken[11][2] = f64::NAN;
    write("broken.raw", &raw(&broken));
    write("three.raw", &[raw(&pair.matrices), raw(&pair.amplitudes), raw(&turned)].concat());
    for (file, size, channels, said) in [
        ("matrices.raw", "8x8", "3", "3 channels"),
        ("matrices.raw", "4x4", "16", "16 channels"),
        ("three.raw", "8x8x3", "4", "3 layers and tables, where a pair has two"),
        ("broken.raw", "8x8", "4", "channel 2, texel [3, 1]: NaN"),
    ] {
        let words = ["audit", file, "--as=ltc:sheen", "--size", size, "--channels", channels];
        let refused = lobefit(folder.path(), &[&words[..], &["--raw-format", "f32"]].concat(), b"");
        assert_eq!(refused.status.code(), Some(2), "{file} {channels}: {}", stderr(&refused));
        assert!(stderr(&refused).contains(said), "{}", stderr(&refused));
    }
    let unknown = run("matrices.raw", &["--as", "ltc:beckmann"]);
    assert_eq!(unknown.status.code(), Some(2), "{}", stderr(&unknown));
}

/// Channels by their names, as OpenEXR sorts them, are those of a pair in its own order.
#[test]
fn channels_of_our_names_are_read_by_name() {
    let table = |names: [&str; 4], values: [f64; 4]| {
        let channel =
            |(name, value): (&str, f64)| Channel { name: name.into(), values: vec![value; 4].into() };
        ForeignTable {
            file: "a.exr".into(),
            name: String::new(),
            what: String::new(),
            size: vec![2, 2],
            channels: names.into_iter().zip(values).map(channel).collect(),
            step: Step::None,
            note: String::new(),
        }
    };
    let texels = |[matrices, light]: [ForeignTable; 2]| {
        let (pair, has_scales) = pair(&[matrices, light]).unwrap();
        assert!(has_scales);
        [pair.matrices[3], pair.amplitudes[3]]
    };
    let sorted = [["m11", "m13", "m31", "m33"], ["B", "E", "sphere", "zero"]];
    let [matrices, light] = sorted.map(|names| table(names, [1.0, 2.0, 3.0, 4.0]));
    assert_eq!(texels([matrices, light]), [[1.0, 3.0, 2.0, 4.0], [2.0, 1.0, 4.0, 3.0]]);
    let unnamed = || table(["0", "1", "2", "3"], [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(texels([unnamed(), unnamed()]), [[1.0, 2.0, 3.0, 4.0]; 2]);
}
