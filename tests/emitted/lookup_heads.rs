//! What the heads of lookups say: which chain they belong to, what they cost and what they are off
//! by.

use crate::lookup_support::{EMITTED, text};
use lobefit_shade::code::Language;

/// Every lookup names the lobe, the map and the chain that it is paired with, what it costs and
/// what it is off by.
#[test]
fn lookups_say_what_they_hold_of() {
    let texts = Language::ALL.map(text);
    for emitted in EMITTED.iter() {
        let entry = &emitted.entry;
        let word = |key: &str| entry[key].as_str().expect("a word");
        assert_eq!((word("effect"), word("alpha_map")), ("parallax", "roughness^2"));
        let named =
            ["ndf", "half"].into_iter().find(|k| word("function").starts_with(&format!("parallax_{k}_")));
        let kernel = named.unwrap_or("half-cosine");
        assert_eq!(word("kernel"), kernel);
        assert_eq!(entry["gives"] == "mip", entry.get("chain").is_some());
        assert_eq!(entry.get("rounding").is_some(), emitted.lookup.smooth);
        assert!(entry["cost"]["ops"].as_u64().is_some_and(|ops| (60..6000).contains(&ops)), "{entry}");
        for text in &texts {
            let start = text.find(&format!("{}(", emitted.name())).expect("the function");
            let head = &text[text[..start].rfind("\n\n").expect("a header")..start];
            let ops = match emitted.lookup.taps {
                1 => format!("{} operations and 1 fetch; width by {}", entry["cost"]["ops"], word("width")),
                n => {
                    format!("{} operations and {n} fetches; width by {}", entry["cost"]["ops"], word("width"))
                }
            };
            let pairing = format!("Pairing: for chains prefiltered with the {kernel} lobe");
            let several = emitted.lookup.taps > 1;
            let body = if emitted.lookup.planes.is_some() {
                "place, planes, probe"
            } else {
                "place, low, high, probe"
            };
            let sum = match (several, entry["gives"] == "mip") {
                (false, false) => "color = sample_level(env, fetch.xyz, mip_of(fetch.w))",
                (false, true) => "color = sample_level(env, fetch.xyz, fetch.w)",
                (true, false) => "color = sum weight_i * sample_level(env, fetch_i.xyz, mip_of(fetch_i.w))",
                (true, true) => "color = sum weight_i * sample_level(env, fetch_i.xyz, fetch_i.w)",
            };
            let lobe: &[&str] = match (emitted.lookup.is_fitted(), emitted.lookup.taps) {
                (false, _) => &["ray (the reflected ray, of unit length)", "does not lean"],
                (true, 1) => &[
                    "view (towards the viewer, of unit length)",
                    "0.7323 alpha^1.7068 mu^-0.2953",
                    "0.205; for the round lobe",
                    "0.225.",
                ],
                (true, 2) => {
                    &["view (towards", "1.1401 alpha^1.63 mu^-0.1866", "0.143; for the round", "0.197."]
                }
                (true, _) => &[
                    "mu^(0.8534 - 1.2592 alpha)",
                    "mu^(0.377 - 0.6347 alpha) (1 + 0.6971 alpha)",
                    "0.122; for the",
                ],
            };
            for told in lobe {
                assert!(head.contains(told), "{told} in {head}");
            }
            let closed = head.contains("The planes enclose the probe");
            assert_eq!(closed, emitted.lookup.planes.is_some(), "{head}");
            for told in [
                ops.as_str(),
                pairing.as_str(),
                body,
                sum,
                "alpha = roughness^2",
                "total variation, rho < 1: mean",
                "certified over roughness [0.1, 1] and rho [0.0625, 8]",
                "strictly inside",
            ] {
                assert!(head.contains(told), "{told} in {head}");
            }
            assert!(head.lines().all(|line| line.chars().count() <= 120), "{head}");
        }
    }
}
