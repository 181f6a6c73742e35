//! The limits on a scene: at the limit, one beyond, and absurd.

use lobefit::data::AlphaMap;
use lobefit::scene::{Scene, limits, smallest_rough};

fn read(text: &str) -> Result<Scene, String> {
    Scene::from_json(text.as_bytes(), "s").map_err(|e| e.to_string())
}

fn materials(wants: impl Iterator<Item = String>) -> String {
    let list: Vec<String> = wants
        .enumerate()
        .map(|(i, wants)| format!(r#"{{"name":"m{i}","kind":"metal","f0":1,"roughness":1{wants}}}"#))
        .collect();
    format!(r#"{{"schema_version":1,"materials":[{}]}}"#, list.join(","))
}

#[test]
fn materials_hold_at_the_limit_only() {
    let scene = |n| materials((0..n).map(|_| String::new()));
    assert_eq!(read(&scene(limits::MATERIALS)).unwrap().materials.len(), limits::MATERIALS);
    for n in [limits::MATERIALS + 1, 150_000] {
        let error = read(&scene(n)).unwrap_err();
        assert!(error.contains("materials") && error.contains("more than 65536 entries"), "{error}");
    }
}

#[test]
fn a_million_elements_are_refused_early() {
    let error =
        read(&format!(r#"{{"schema_version":1,"materials":[{}0]}}"#, "0,".repeat(1_000_000))).unwrap_err();
    assert!(error.starts_with("s:1:34: materials[0]: "), "{error}");
}

#[test]
fn axes_hold_at_the_limit_only() {
    let size = |n: &str| materials(std::iter::once(format!(r#","wants":{{"tables":[{{"size":[{n},2]}}]}}"#)));
    for n in ["2", "1024"] {
        read(&size(n)).unwrap();
    }
    for n in ["0", "1", "1025", "2147483648", "9223372036854775808", "-1"] {
        let error = read(&size(n)).unwrap_err();
        let range = "[2, 1024] ([4, 256] with a third axis)";
        let expected = format!("materials[0].wants.tables[0].size[0]: {n} is outside {range}");
        assert!(error.ends_with(&expected), "{error}");
    }
}

#[test]
fn texels_hold_at_the_limit_only() {
    let shapes = ["f16", "f32"].into_iter().flat_map(|format| {
        ["homogeneous", "plain", "plain-squared"].into_iter().flat_map(move |layout| {
            ["albedo", "split-sum"]
                .into_iter()
                .map(move |serves| format!(r#""format":"{format}","layout":"{layout}","serves":"{serves}""#))
        })
    });
    let table = |size: &str, shape: &str| format!(r#","wants":{{"tables":[{{"size":{size},{shape}}}]}}"#);
    let full: Vec<String> = shapes.map(|shape| table("[1024,1024]", &shape)).collect();
    let half: Vec<String> = full.iter().map(|w| w.replace("[1024,1024]", "[1024,512]")).collect();
    // 12 tables of 2^20 texels and 8 of 2^19 are 2^24.
    let at: Vec<String> = full.iter().chain(&half[..8]).cloned().collect();
    read(&materials(at.iter().cloned())).unwrap();
    // The same tables again are the same tables.
    read(&materials(at.iter().chain(&at).cloned())).unwrap();
    let one_more = at.into_iter().chain([table("[2,2]", r#""format":"f16""#)]);
    let error = read(&materials(one_more)).unwrap_err();
    assert_eq!(
        error,
        "s:1:3079: materials[20].wants.tables[0].size: the scene's tables together exceed 16777216 texels or 536870912 bytes"
    );
}

#[test]
fn integers_hold_texels_in_the_unit_interval_alone() {
    let scene = |more: &str, table: &str| {
        format!(
            r#"{{"schema_version":1,"materials":[{{"name":"m","kind":"metal","f0":1,"roughness":[0.5,1]{more},"wants":{{"tables":[{{{table}}}]}}}}]}}"#
        )
    };
    let signed = [
        ("", r#""size":[8,8],"serves":"split-sum""#, "homogeneous layout for `split-sum`"),
        ("", r#""size":[8,8],"layout":"area-lights""#, "area-lights layout"),
        (r#","anisotropy":0.5"#, r#""size":[8,8,8],"layout":"azimuth""#, "azimuth layout"),
    ];
    for format in ["unorm8", "unorm16"] {
        for (more, table, what) in signed {
            let error = read(&scene(more, &format!(r#"{table},"format":"{format}""#))).unwrap_err();
            let expected = format!(
                "materials[0].wants.tables[0].format: `{format}` holds [0, 1], and texels of the {what} are signed; give `f16`"
            );
            assert!(error.ends_with(&expected), "{error}");
        }
        for table in ["", r#","layout":"plain","serves":"split-sum""#] {
            read(&scene("", &format!(r#""size":[8,8],"format":"{format}"{table}"#))).unwrap();
        }
    }
}

/// A scene of glasses, each with these tables.
fn glasses(tables: impl Iterator<Item = String>) -> String {
    let list: Vec<String> = tables
        .enumerate()
        .map(|(i, tables)| {
            format!(
                r#"{{"name":"g{i}","kind":"glass","ior":1.5,"roughness":1,"wants":{{"tables":[{tables}]}}}}"#
            )
        })
        .collect();
    format!(r#"{{"schema_version":1,"materials":[{}]}}"#, list.join(","))
}

#[test]
fn axes_of_tables_with_slices_hold_at_the_limit_only() {
    let size = |n: &str| glasses(std::iter::once(format!(r#"{{"size":[4,{n},4]}}"#)));
    for n in ["4", "256"] {
        read(&size(n)).unwrap();
    }
    let long = "[2, 1024] ([4, 256] with a third axis)";
    for (n, range) in [("0", long), ("3", "[4, 256]"), ("257", "[4, 256]"), ("9223372036854775808", long)] {
        let error = read(&size(n)).unwrap_err();
        let expected = format!("materials[0].wants.tables[0].size[1]: {n} is outside {range}");
        assert!(error.ends_with(&expected), "{error}");
    }
}

#[test]
fn texels_of_tables_with_slices_hold_at_the_limit_only() {
    let sliced = |size: &str, more: &str| format!(r#"{{"size":{size}{more}}}"#);
    read(&glasses(std::iter::once(sliced("[256,256,64]", "")))).unwrap();
    for size in ["[256,256,65]", "[256,256,256]"] {
        let error = read(&glasses(std::iter::once(sliced(size, "")))).unwrap_err();
        assert!(error.contains("materials[0].wants.tables[0].size: 256x256x"), "{error}");
        assert!(error.ends_with(" is more than 4194304 texels"), "{error}");
    }
    let error = read(&glasses(std::iter::once(sliced("[256,4,65]", "")))).unwrap_err();
    let expected = "materials[0].wants.tables[0].size: 256 columns x 65 slices of the optimised layout are more than 16384; rows cost less";
    assert!(error.contains(expected), "{error}");
    // Twice 2^22 for the two sides, once as f16 and once as f32, are 2^24.
    let (half, single) = (sliced("[256,256,64]", ""), sliced("[256,256,64]", r#","format":"f32""#));
    let full = [half.clone(), single];
    read(&glasses(full.iter().cloned())).unwrap();
    // The same tables again are the same tables.
    read(&glasses(full.iter().chain(&full).cloned())).unwrap();
    let error = read(&glasses(full.into_iter().chain([sliced("[4,4,4]", "")]))).unwrap_err();
    assert_eq!(
        error,
        "s:1:320: materials[2].wants.tables[0].size: the scene's tables together exceed 16777216 texels or 536870912 bytes"
    );
    let five = [4, 5, 6, 7, 8].map(|n| sliced(&format!("[4,4,{n}]"), "")).join(",");
    let error = read(&glasses(std::iter::once(five))).unwrap_err();
    assert!(error.ends_with("materials[0].wants.tables: more than 4 entries"), "{error}");
}

#[test]
fn hypotheses_hold_at_the_limit_only() {
    let fit = |from: usize, n: usize| {
        let list: Vec<String> = (from..from + n).map(|i| format!(r#""h{i}.wgsl""#)).collect();
        format!(r#","wants":{{"fit":{{"hypotheses":[{}]}}}}"#, list.join(","))
    };
    let scene = |counts: &[usize]| materials(counts.iter().enumerate().map(|(i, &n)| fit(1000 * i, n)));
    assert_eq!(read(&scene(&[200, 56])).unwrap().hypotheses().len(), limits::HYPOTHESES);
    let error = read(&scene(&[200, 57])).unwrap_err();
    assert_eq!(
        error,
        "s:1:3225: materials[1].wants.fit.hypotheses[56]: more than 256 hypotheses in the scene"
    );
    assert!(read(&scene(&[257])).unwrap_err().contains("more than 256 entries"));
}

#[test]
fn sixteen_mebibytes_of_digits_are_a_number_or_an_error_but_no_hang() {
    let digits = "1".repeat((limits::FILE_BYTES as usize) - 200);
    let text = format!(
        r#"{{"schema_version":1,"materials":[{{"name":"m","kind":"metal","f0":0.{digits},"roughness":1}}]}}"#
    );
    assert_eq!(read(&text).unwrap().materials[0].f0, Some([1.0 / 9.0; 3]));
    let text = text.replace("0.1", "1");
    assert!(read(&text).unwrap_err().contains("materials[0].f0: number out of range"));
}

#[test]
fn texel_products_hold_at_the_limit_and_are_refused_beyond_it() {
    assert_eq!(limits::texels(4096, 4096, 8), Some((limits::CELLS, 128 << 20)));
    assert_eq!(limits::texels(4096, 4097, 8), None);
    assert_eq!(limits::texels(4096, 4096, 32), Some((limits::CELLS, limits::TEXEL_BYTES)));
    assert_eq!(limits::texels(4096, 4096, 33), None);
    assert_eq!(limits::texels(usize::MAX, usize::MAX, 8), None);
    assert_eq!(limits::texels(1, 1, u64::MAX), None);
}

#[test]
fn texel_sums_hold_at_the_limit_and_are_refused_beyond_it() {
    assert_eq!(limits::add_texels((limits::CELLS - 1, 0), (1, 0)), Some((limits::CELLS, 0)));
    assert_eq!(limits::add_texels((limits::CELLS, 0), (1, 0)), None);
    assert_eq!(limits::add_texels((0, u64::MAX), (0, u64::MAX)), None);
}

#[test]
fn the_smooth_end_is_rough_in_f64() {
    for map in AlphaMap::ALL {
        let alpha = map.alpha(smallest_rough(map));
        assert!(
            (limits::SMOOTH_ALPHA..limits::SMOOTH_ALPHA * (1.0 + 1e-12)).contains(&alpha),
            "{map:?}: {alpha}"
        );
    }
}
