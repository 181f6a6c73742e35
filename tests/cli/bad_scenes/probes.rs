//! Probes that cannot be looked up.

use super::{Case, case, refused, top};

/// A scene, and a probe that is none.
fn not_a_probe() -> Vec<Case> {
    vec![
        case(top("\"probes\":[{\"name\":\"p\",\"kind\":\"box\"}]"), "probes[0].kind: unknown field `kind`"),
        case(top("\"probes\":[{}]"), "probes[0]: missing field `name`"),
        case(
            top("\"probes\":[{\"name\":\"p\"},{\"name\":\"p\"}]"),
            "probes[1].name: `p` is already the name of probes[0]",
        ),
        case(
            top("\"culling\":{},\"probes\":[{\"name\":\"p\"},{\"name\":\"culling\"}]"),
            "probes[1].name: `culling` is already the name of the scene's `culling`",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"kernel\":\"ggx\"}]"),
            "probes[0].kernel: `ggx` is none of ndf, half and half-cosine",
        ),
        case(top("\"probes\":[{\"name\":\"p\",\"rho\":0}]"), "probes[0].rho: 0 is outside [0.000001, 1000]"),
        case(
            top("\"probes\":[{\"name\":\"p\",\"rho\":[2,1]}]"),
            "probes[0].rho: the range [2, 1] is upside down",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"roughness\":1,\"rho\":[2,4]}]"),
            "probes[0].rho: every fetch is saturated there",
        ),
        // Its level function used to be emitted with an error of 0, measured at 0 points.
        case(
            top("\"probes\":[{\"name\":\"p\",\"roughness\":[0.2,0.3],\"mips\":{\"levels\":[0.5,1]}}]"),
            "probes[0].mips: the chain holds roughness 0.5 to 1, and the probe is looked up with 0.2 to 0.3",
        ),
        case(top("\"probes\":[{\"name\":\"p\",\"norms\":[]}]"), "probes[0].norms: the list is empty"),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[]}]"),
            "probes[0].lookups: the list is empty; leave the field out for no lookup",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{},{\"taps\":1}]}]"),
            "probes[0].lookups[1]: a box with smooth edges, 1 fetch is in the list already",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{\"hit\":true,\"taps\":1}]}]"),
            "probes[0].lookups[0].hit: what the engine hits has no proxy, and one fetch of the mirror lobe",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{\"taps\":4}]}]"),
            "probes[0].lookups[0].taps: 4 is outside [1, 3]",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"kernel\":\"ndf\",\"lookups\":[{},{\"lobe\":\"fitted\"}]}]"),
            "probes[0].lookups[1].lobe: the lobe is fitted for half-cosine chains, and this probe's is of the kernel `ndf`; give `mirror`",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{\"lobe\":\"ggx\"}]}]"),
            "probes[0].lookups[0].lobe: unknown variant `ggx`, expected `mirror` or `fitted`",
        ),
        case(
            top(
                "\"probes\":[{\"name\":\"p\",\"lookups\":[{\"lobe\":\"fitted\"},{\"taps\":1,\"lobe\":\"fitted\"}]}]",
            ),
            "probes[0].lookups[1]: a box with smooth edges, 1 fetch of the fitted lobe is in the list already",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{\"planes\":3}]}]"),
            "probes[0].lookups[0].planes: 3 is outside [4, 64]",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"map\":\"linear\"}}]"),
            "probes[0].mips: give `map` with `count`, or `levels` alone",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"map\":\"log\",\"count\":2}}]"),
            "probes[0].mips.count: a logarithmic chain",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"map\":\"linear\",\"count\":17}}]"),
            "probes[0].mips.count: 17 is outside [2, 16]",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"levels\":[0,0.5,0.5]}}]"),
            "probes[0].mips.levels[2]: 0.5 does not follow 0.5 by 0.0001 or more",
        ),
        case(top("\"probes\":{}"), "probes: invalid type: map"),
    ]
}

#[test]
fn what_is_not_a_probe_is_refused() {
    refused(not_a_probe());
}
