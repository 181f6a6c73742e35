//! Lookups of sub-voxels as emitted: over all masks of a byte and many of 64 bits the exact values,
//! in every language that is run here.

use crate::emit_support::compilers::{Contraction, includes_in_cpp, loops, run};
use crate::emit_support::languages::{FAMILY, compile, file};
use crate::emit_support::programs::{self, compile_library};
use crate::emit_support::subvoxels::{PAIRS, expected, points};
use lobefit_math::subvoxel::{NO_CENTROID, centroid, from_morton, morton, supervoxel_mask};
use lobefit_shade::code::{Language, MASK_FUNCTIONS, subvoxels};

/// The values by their definition: positions of bits, summed.
#[test]
fn centroids_are_means_of_positions_and_masks_are_of_their_bytes() {
    for mask in 0..=u8::MAX {
        let set: Vec<[f64; 3]> = (0..8)
            .filter(|b| mask >> b & 1 == 1)
            .map(|b| [b & 1, b >> 1 & 1, b >> 2 & 1].map(|x| if x == 1 { 0.75 } else { 0.25 }))
            .collect();
        let mean = [0, 1, 2].map(|k| (set.iter().map(|p| p[k]).sum::<f64>() / set.len() as f64) as f32);
        assert_eq!(centroid(mask), (mask != 0).then_some(mean), "mask {mask}");
    }
    for b in 0..8 {
        for bit in 0..8 {
            assert_eq!(supervoxel_mask(1 << (8 * b + bit)), 1 << b, "byte {b}, bit {bit}");
        }
    }
    for place in [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1023, 512, 3], [255, 255, 127]] {
        assert_eq!(from_morton(morton(place)), place);
    }
    assert_eq!([[1, 0, 0], [0, 1, 0], [0, 0, 1], [2, 0, 0]].map(morton), [1, 2, 4, 8]);
}

/// Reads a mask and the halves of a super-voxel, bits behind numbers.
fn body(language: Language) -> String {
    let given = "        unsigned mask, low, high;\n        memcpy(&mask, p, 4); memcpy(&low, p + 1, 4); memcpy(&high, p + 2, 4);\n";
    let calls = match language {
        Language::C => {
            "        float a[3]; int k;
        subvoxel_centroid((unsigned char)mask, a);
        for (k = 0; k < 3; ++k) put(a[k]);
        subvoxel_centroid_lookup((unsigned char)mask, a);
        for (k = 0; k < 3; ++k) put(a[k]);
        put((float)supervoxel_mask((unsigned long long)high << 32 | low));\n"
        }
        _ => {
            "        const auto a = subvoxel_centroid(mask), b = subvoxel_centroid_lookup(mask);
        put(a.x); put(a.y); put(a.z); put(b.x); put(b.y); put(b.z);
        put((float)supervoxel_mask(low, high));\n"
        }
    };
    format!("{given}{calls}")
}

#[test]
fn every_language_returns_the_exact_values() {
    let (points, expected) = (points(), expected());
    assert_eq!(expected.len(), 7 * PAIRS);
    for language in FAMILY {
        let mut code = file(language, &subvoxels(language));
        if language == Language::Glsl {
            // C++ has another word for a list.
            code = code.replace("vec3[256](", "{").replace("\n);", "\n};");
        }
        let main = format!("#include <string.h>\n{}", loops(3, &[body(language)]));
        let Some(found) = run(language, &code, &main, &points, Contraction::Off) else { continue };
        assert!(found == expected, "{}", language.name());
    }
    let body = "    for p in &points {
        let [mask, low, high] = p.map(f32::to_bits);
        out.extend(lobefit::subvoxel_centroid(mask as u8));
        out.extend(lobefit::subvoxel_centroid_lookup(mask as u8));
        out.push(f32::from(lobefit::supervoxel_mask(u64::from(high) << 32 | u64::from(low))));
    }\n";
    let code = file(Language::Rust, &subvoxels(Language::Rust));
    assert!(programs::run(&code, 3, body, &points) == expected, "rust");
}

/// The costs of the manifest, against the operations of the text counted by hand.
#[test]
fn costs_are_those_of_the_text() {
    let by_hand = [
        // 4 and, 4 counts, 3 multiply-adds, a product; 4 conversions; rcp and 3 mul; compare, 3 select
        (4 + 4 + 3 + 1 + 4 + (4 + 3) + (1 + 3), 0, 0),
        // and
        (1, 1, 256 * 3 * 4),
        // of both words 3 shifts, 3 or, and, mul, shift; 2 and, shift, or
        (2 * (3 + 3 + 1 + 1 + 1) + 2 + 1 + 1, 0, 0),
    ];
    for (function, expected) in MASK_FUNCTIONS.iter().zip(by_hand) {
        let cost = function.cost().expect("a cost");
        assert_eq!((cost.ops, cost.fetches, cost.bytes), expected, "{}", function.name);
    }
}

#[test]
fn compilers_take_the_files() {
    compile_library(&file(Language::Rust, &subvoxels(Language::Rust)));
    includes_in_cpp(&file(Language::C, &subvoxels(Language::C)));
    for language in [Language::Hlsl, Language::Glsl] {
        let count = compile(language, &file(language, &subvoxels(language)));
        assert!(count.is_none_or(|count| count == MASK_FUNCTIONS.len()));
    }
    let source = file(Language::Wgsl, &subvoxels(Language::Wgsl));
    let module = naga::front::wgsl::parse_str(&source).expect("WGSL");
    let (flags, capabilities) = (naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    naga::valid::Validator::new(flags, capabilities).validate(&module).expect("valid");
    let table = source
        .split_once("array<vec3<f32>, 256>(")
        .expect("a table")
        .1
        .split_once("\n);")
        .expect("its end")
        .0;
    let read: Vec<f32> =
        table.split(&['(', ')', ',', ' ', '\n'][..]).filter_map(|word| word.parse().ok()).collect();
    let expected = (0..=u8::MAX).flat_map(|mask| centroid(mask).unwrap_or(NO_CENTROID));
    assert!(read.into_iter().eq(expected), "the table of WGSL");
    assert!(centroid(0).is_none() && NO_CENTROID.iter().all(|x| *x < 0.0));
}
