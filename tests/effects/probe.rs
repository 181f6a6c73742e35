//! The source of lookups of probes.

use lobefit::data::{AlphaMap, MipChain, ProbeLookup, SurfaceLobe};
use lobefit::effects::parallax::TapRule;
use lobefit::effects::parallax::probe::{Level, Wanted, arguments, print};
use lobefit_shade::code::Language;

/// Every combination is a source of the dialect, and its names are words of no language.
#[test]
fn lookups_are_printed_in_every_language() {
    let level = |name: &str, input: &str| Level {
        name: name.into(),
        text: format!("fn {name}({input}: f32) -> f32 {{ return {input}; }}\n"),
        chain: MipChain::Given(vec![0.0, 1.0]),
    };
    for i in 0..24 {
        let planes = (i % 2 == 1).then_some(9);
        let lobe = if i / 4 % 2 == 0 { SurfaceLobe::Mirror } else { SurfaceLobe::Fitted };
        let lookup = ProbeLookup { hit: false, planes, smooth: i / 2 % 2 == 0, taps: 1 + i / 8, lobe };
        let wanted = Wanted {
            name: "lookup".into(),
            fetch: "one_fetch".into(),
            lookup,
            rule: [TapRule::one(), TapRule::two(), TapRule::three()][lookup.taps as usize - 1],
            header: Vec::new(),
            flow: 1.05,
            rho: [0.0625, 8.0],
            level: (i % 3 == 0).then(|| level("g", "roughness")),
            alpha_map: AlphaMap::RoughnessSquared,
        };
        assert!(wanted.operations().expect("a source") > 20, "{lookup:?}");
        let inputs = wanted.inputs().expect("arguments");
        assert!(inputs.iter().all(|input| arguments::meaning(input).is_some()), "{inputs:?}");
        for language in Language::ALL {
            let text = print(language, std::slice::from_ref(&wanted)).expect("a text");
            let renamed = text.split(|c: char| !c.is_alphanumeric() && c != '_').find(|w| w.ends_with('_'));
            assert_eq!(renamed, None, "{}", language.title());
        }
    }
}
