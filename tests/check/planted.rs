//! `lobefit check`: a change planted into any kind of output is found, and named with its place.

use std::collections::BTreeMap;
use std::path::Path;

use lobefit::bake::{Baked, Silent, compare};
use lobefit::emit::exr;
use lobefit::store::Files;
use serde_json::Value;

use crate::common::{lobefit, stderr};
use crate::sliced_support::baked;

/// Tables of two axes and of three, of one, two and four channels, in f16 and f32, in every container; a fit
/// in every language; every kind of page.
const SCENE: &str = r#"{"schema_version":1,"formats":["exr","dds","ktx2","npy","raw"],"materials":[
 {"name":"clay","kind":"dielectric","f0":1,"roughness":0,"base":{"roughness":[0.2,0.3],"max_ops":5}},
 {"name":"plain","kind":"dielectric","f0":1,"roughness":[0.9,1],
  "wants":{"tables":[{"size":[16,8],"serves":"split-sum"}]}},
 {"name":"brushed","kind":"metal","f0":1,"anisotropy":[0.4,0.6],"roughness":[0.5,0.6],"wants":{"tables":[
  {"size":[8,6,4],"format":"f32"},{"layout":"azimuth","size":[8,6,4]}]}}]}"#;

/// How a file is changed.
enum Edit {
    /// The lowest bit of a texel, at column, row and slice, and of one of its channels.
    Texel([usize; 3], usize),
    /// A texel of a compressed image, by a quarter.
    Quarter([usize; 3], usize),
    /// The lowest bit of a byte, counted from the end where it is negative.
    Bit(isize),
    /// After a text the first of another one is replaced.
    Word(&'static str, &'static str, &'static str),
    /// The file ends after so many bytes, counted from the end where it is negative.
    Cut(isize),
    /// More bytes at the end.
    More(&'static str),
    /// Line ends of another system.
    LineEnds,
}
use Edit::{Bit, Cut, LineEnds, More, Quarter, Texel, Word};

/// What `check --values 10` makes of a change.
#[derive(PartialEq)]
enum Values {
    Refuse,
    Accept,
}
use Values::{Accept, Refuse};

const AZIMUTH: [usize; 3] = [7, 0, 3];
const MEAN: [usize; 3] = [5, 4, 2];
const PLAIN: [usize; 3] = [11, 5, 0];

/// File, change, what the report says of it, and whether a tolerance covers it.
#[rustfmt::skip]
const PLANTED: [(&str, Edit, &[&str], Values); 58] = [
    // Images of two axes, and compressed ones of three.
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Bit(-2), &["channel loss, column 15, row 7: ", "; 1 texel differs, max abs ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Bit(-1), &["channel loss, column 15, row 7: ", "; promise broken: lookup error "], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Word("software", "0.1.0", "0.1.1"), &["header: attribute `software`; texels are equal"], Accept),
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Word("error (", "max 0.", "max 1."), &["header: attribute `lobefit`; texels are equal"], Accept),
    // A length stands before the text: 0e00... is 0 in as many bytes.
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Word("error (", "rms 0.", "rms 0e"), &["header: attribute `lobefit`: ", "; a smaller error than is true, by "], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Word("domain: ", "mu [0.001", "mu [0.000"), &["header: attribute `lobefit`: 0 where the recipe gives 0.001; an end of a range, 1e-3 off"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Word("", "bias\0", "bios\0"), &["16 x 8 texels of bios, loss where the recipe gives 16 x 8 texels of bias, loss"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.exr", Bit(1), &["byte 1: not a readable EXR file"], Refuse),
    ("tables/ggx-aniso-correlated-8x6x4-f32.exr", Quarter(MEAN, 0), &["channel loss, column 5, row 4, slice 2: ", "; promise broken: lookup error "], Refuse),
    ("tables/ggx-aniso-azimuth-correlated-8x6x4.exr", Quarter(AZIMUTH, 1), &["channel c1, column 7, row 0, slice 3: ", "; promise broken: lookup error "], Refuse),
    ("tables/ggx-aniso-azimuth-correlated-8x6x4.exr", Cut(-9), &["not a readable EXR file"], Refuse),
    // Containers that keep texels one after another.
    ("tables/ggx-dfg-correlated-16x8-split-sum.dds", Texel(PLAIN, 1), &["channel bias, column 11, row 5: ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-aniso-azimuth-correlated-8x6x4.dds", Texel(AZIMUTH, 2), &["channel c2, column 7, row 0, slice 3: ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-dfg-correlated-16x8-split-sum.dds", Bit(16), &["header: dwWidth is 17 where the recipe gives 16; texels are equal"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.dds", Bit(128), &["header: dxgiFormat is 35 where the recipe gives 34; texels are equal"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.dds", Bit(0), &["byte 0 is not that of such a file; texels are equal"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2", Texel(PLAIN, 1), &["channel bias, column 11, row 5: ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-aniso-correlated-8x6x4-f32.ktx2", Texel(MEAN, 0), &["channel loss, column 5, row 4, slice 2: ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2", Bit(12), &["header: vkFormat is 82 where the recipe gives 83; texels are equal"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2", Bit(28), &["header: pixelDepth is 1 where the recipe gives 0; texels are equal"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2", Bit(80), &["header: byteOffset is "], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2", Bit(116), &["header: dfd.colorModel is 65536 where the recipe gives 65537"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2", Word("KTXwriter", "lobefit 0", "lobefit 1"), &["header: key/value data, byte ", "; texels are equal"], Accept),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2", Cut(60), &["60 bytes where the recipe gives 728"], Refuse),
    ("tables/ggx-aniso-correlated-8x6x4-f32.npy", Texel(MEAN, 0), &["channel loss, column 5, row 4, slice 2: ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-dfg-correlated-16x8-split-sum.npy", Bit(23), &["header `{'descr': '<f3', ", " where the recipe gives `{'descr': '<f2', "], Refuse),
    ("tables/ggx-aniso-correlated-8x6x4-f32.raw", Texel(MEAN, 0), &["channel loss, column 5, row 4, slice 2: ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-aniso-azimuth-correlated-8x6x4.raw", Texel(AZIMUTH, 2), &["channel c2, column 7, row 0, slice 3: ", ", max ulp 1; promise "], Accept),
    ("tables/ggx-aniso-azimuth-correlated-8x6x4.raw", More("x"), &["3073 bytes where the recipe gives 3072"], Refuse),
    // What describes them.
    ("tables/ggx-aniso-azimuth-correlated-8x6x4.raw.json", Word("\"size\"", "8", "9"), &["line 13: 9 where the recipe gives 8; a constant, 1e0 off"], Refuse),
    ("tables/ggx-aniso-azimuth-correlated-8x6x4.npy.json", Word("", "(columns) fastest", "(columns) slowest"), &["line 10: `", "slowest"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.dds.json", Cut(-3), &["line ", "(end of file)"], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.dds.json", Word("\"certificate\"", "\"max_abs\": 0.", "\"max_abs\": 0.0"), &["line ", "; a smaller error than is true, by "], Refuse),
    ("tables/ggx-dfg-correlated-16x8-split-sum.ktx2.json", Word("\"domain\"", "0.001", "0.0001"), &["line ", ": 0.0001 where the recipe gives 0.001; an end of a range, "], Refuse),
    // Languages: constants, figures, names, lines.
    ("fits/lobefit.wgsl", Word("fn eon_albedo", "0.392", "0.393"), &["line ", ": 0.393", " where the recipe gives 0.392", "; a constant, "], Refuse),
    ("fits/lobefit.glsl", Word("float eon_albedo", "-0.1006", "-0.1007"), &["line ", "; a constant, "], Refuse),
    ("fits/lobefit.hlsl", Word("float eon_albedo", "1.0f - lost", "1.0f + lost"), &["line ", "1.0f + lost", " where the recipe gives ", "1.0f - lost"], Refuse),
    ("fits/lobefit.metal", Word("float eon_albedo", "(", "_(" ), &["line ", "eon_albedo_("], Refuse),
    ("fits/lobefit.rs", Word("fn eon_albedo", "roughness", "n_dot_v"), &["line ", "`pub fn eon_albedo(n_dot_v"], Refuse),
    ("fits/lobefit.h", Word("eon_e_5:", "max 0.00201", "max 0.00101"), &["line ", "; a smaller error than is true, by "], Refuse),
    ("fits/lobefit.h", Word("eon_e_5:", "max 0.00201", "max 0.00301"), &["line ", ": 0.003015 where the recipe gives 0.002015; max abs difference 1e-3"], Accept),
    ("fits/lobefit.h", LineEnds, &["line 1: only line ends differ: CR LF where the recipe gives LF"], Refuse),
    ("fits/lobefit.rs", Cut(-1), &["only line ends differ: no final newline where the recipe gives LF"], Refuse),
    // The manifest: an error, a coefficient, a name, its own hash.
    ("manifest.json", Word("\"certificate\"", "\"max_abs\": 0.002", "\"max_abs\": 0.001"), &["line ", "; a smaller error than is true, by "], Refuse),
    ("manifest.json", Word("\"axes\"", "\"min\": 0.9", "\"min\": 0.8"), &["line ", ": 0.8 where the recipe gives 0.9; an end of a range, "], Refuse),
    ("manifest.json", Word("\"coefficients\"", ": 0.", ": 1."), &["line ", "; a constant, 1e0 off"], Refuse),
    ("manifest.json", Word("", "\"recommended\": true", "\"recommended\": false"), &["line ", "`      \"recommended\": false,`"], Refuse),
    ("manifest.json", Word("\"recipe\": \"", "", "x"), &["line ", "`  \"recipe\": \"x"], Accept),
    ("manifest.json", Cut(-3), &["line ", "(end of file)"], Refuse),
    // Pages, their data and pictures, and the hundredth column of a line.
    ("reports/index.html", Word("<title>", "lobefit", "lobefot"), &["line 10: `<title>lobefot report"], Accept),
    ("reports/index.html", Word("base64,", "PCGNtYXAA", "PCGNtYXAB"), &["line 12, column ", "PCGNtYXAB"], Accept),
    ("reports/explore.html", Cut(-4), &["line "], Accept),
    ("reports/reflection.html", Word("<table", "0.00", "0.01"), &["line ", " where the recipe gives "], Accept),
    ("reports/index.json", Word("\"error\":", "[0.001", "[0.002"), &["line 14: 0.002399 where the recipe gives 0.001399; max abs difference 1e-3"], Accept),
    ("reports/eon.json", Word("", "\"recipe\":\"", "\"recipe\":\"f"), &["line 3: `"], Refuse),
    ("reports/anisotropy.json", Cut(-2), &["line ", "(end of file)"], Refuse),
    ("reports/furnace.svg", Word("", "x=\"40\"", "x=\"41\""), &["line 4: 41 where the recipe gives 40; max abs difference 1e0"], Accept),
    ("reports/furnace.svg", Word("</text>", "\n", "\u{feff}\n"), &["line "], Refuse),
];

/// What is there of a place counted from the beginning, or from the end where it is negative.
fn place(bytes: &[u8], at: isize) -> usize {
    if at < 0 { bytes.len() - at.unsigned_abs() } else { at.unsigned_abs() }
}

/// The byte of a texel, by the sidecar.
fn byte(files: &Files, file: &str, [x, y, z]: [usize; 3], channel: usize) -> usize {
    let said: Value = serde_json::from_slice(&files[&format!("{file}.json")]).expect("a sidecar");
    let number = |value: &Value| value.as_u64().expect("a number") as usize;
    let channels = said["channels"].as_array().expect("channels").len() + number(&said["padding_channels"]);
    let bytes = if said["stored"] == "f16" { 2 } else { 4 };
    let [columns, rows] = [0, 1].map(|k| number(&said["size"][k]));
    number(&said["offset"]) + (((z * rows + y) * columns + x) * channels + channel) * bytes
}

/// An image with one texel changed.
fn quarter(baked: &Baked, file: &str, [x, y, z]: [usize; 3], channel: usize) -> Vec<u8> {
    let name = |table: &str| file == format!("tables/{table}.exr");
    let found = baked.tables.iter().find(|table| name(&table.approximation.name)).expect("the table");
    let mut table = found.table().expect("texels").clone();
    let [columns, rows, _] = table.size();
    table.channels[channel].texels[(z * rows + y) * columns + x] += 0.25;
    exr::encode(&table, &[]).expect("an image")
}

impl Edit {
    fn of(&self, baked: &Baked, file: &str) -> Vec<u8> {
        let mut bytes = baked.files[file].clone();
        let text = || std::str::from_utf8(&baked.files[file]).expect("text").to_owned();
        match *self {
            Texel(at, channel) => bytes[byte(&baked.files, file, at, channel)] ^= 1,
            Quarter(at, channel) => bytes = quarter(baked, file, at, channel),
            Bit(at) => {
                let at = place(&bytes, at);
                bytes[at] ^= 1;
            }
            Word(after, old, new) => {
                let find = |word: &str, from: usize| {
                    let found =
                        bytes[from..].windows(word.len().max(1)).position(|w| w.starts_with(word.as_bytes()));
                    from + found.unwrap_or_else(|| panic!("{file}: {word:?} after {after:?}"))
                };
                let at = find(old, find(after, 0) + after.len());
                bytes.splice(at..at + old.len(), new.bytes());
            }
            Cut(at) => bytes.truncate(place(&bytes, at)),
            More(text) => bytes.extend(text.bytes()),
            LineEnds => bytes = text().replace('\n', "\r\n").into_bytes(),
        }
        assert!(bytes != baked.files[file], "{file}: nothing changed");
        bytes
    }
}

#[test]
fn a_change_of_any_kind_of_output_is_named_with_its_place() {
    let baked = baked(SCENE);
    let mut wrong = Vec::new();
    for (file, edit, words, values) in &PLANTED {
        let mut found = baked.files.clone();
        found.insert((*file).into(), edit.of(&baked, file));
        let said: Vec<String> =
            compare(&baked, &found, &[], None, &Silent).iter().map(ToString::to_string).collect();
        let is_named = said.len() == 1 && said[0].starts_with(&format!("{file}: "));
        if !is_named || words.iter().any(|words| !said[0].contains(words)) {
            wrong.push(format!("{file}: {words:?} in {said:?}"));
        }
        // Each texel is measured in a quarter of a second: tests/check/values.rs has their tolerances.
        if matches!(edit, Texel(..) | Quarter(..)) {
            continue;
        }
        if compare(&baked, &found, &[], Some(10.0), &Silent).is_empty() != (*values == Accept) {
            wrong.push(format!("{file}: {words:?} with --values 10"));
        }
    }
    let kinds = |end: &str| PLANTED.iter().filter(|planted| planted.0.ends_with(end)).count();
    for kind in [
        ".exr",
        ".dds",
        ".ktx2",
        ".npy",
        ".raw",
        ".raw.json",
        ".wgsl",
        ".glsl",
        ".hlsl",
        ".metal",
        ".rs",
        ".h",
        "manifest.json",
        ".html",
        ".svg",
    ] {
        assert!(kinds(kind) > 0, "{kind}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    the_program_says_it(&baked);
}

/// Writes a record of a graphics processor beside the bake, with its page.
fn record(folder: &Path, name: &str, edit: impl Fn(&str, String) -> String) {
    let at = folder.join("reports/gpu");
    std::fs::create_dir_all(&at).expect("a folder");
    for end in ["json", "html"] {
        let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/gpu/nvidia-h200").with_extension(end);
        let text = std::fs::read_to_string(own).expect("a record");
        std::fs::write(at.join(format!("{name}.{end}")), edit(end, text)).expect("written");
    }
}

/// The last change of every file at once, and changes of records, in a folder that the program looks at.
fn the_program_says_it(baked: &Baked) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut files = baked.files.clone();
    let mut expected: BTreeMap<&str, &[&str]> = BTreeMap::new();
    for (file, edit, words, _) in &PLANTED {
        expected.insert(file, words);
        files.insert((*file).into(), edit.of(baked, file));
    }
    files.insert("tables/stale.exr".into(), b"old".to_vec());
    files.remove("reports/eon.html");
    expected.insert("tables/stale.exr", &["extra: the recipe does not make it"]);
    expected.insert("reports/eon.html", &["missing: the recipe makes it"]);
    for (file, bytes) in &files {
        let path = folder.path().join(file);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, bytes).expect("written");
    }
    record(folder.path(), "whole", |_, text| text);
    record(
        folder.path(),
        "page",
        |end, text| {
            if end == "html" { text.replacen("<h1", "<h2", 1) } else { text }
        },
    );
    record(folder.path(), "figure", |end, text| {
        if end == "json" { text.replacen("\"median\":2.1", "\"median\":2.2", 1) } else { text }
    });
    record(folder.path(), "cut", |end, mut text| {
        text.truncate(if end == "json" { text.len() / 2 } else { text.len() });
        text
    });
    expected.insert(
        "reports/gpu/page.html",
        &["not the page of reports/gpu/page.json: reports/gpu/page.html, line ", "<h2"],
    );
    expected.insert(
        "reports/gpu/figure.html",
        &["not the page of reports/gpu/figure.json: reports/gpu/figure.html, line "],
    );
    expected.insert("reports/gpu/cut.json", &["no record of lobefit cost --gpu --record", "line "]);
    let output = lobefit(folder.path(), &["check", "-", "--json"], SCENE.as_bytes());
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(1), ""));
    let verdict: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let differences = verdict["differences"].as_array().expect("a list");
    let of = |file: &str| differences.iter().find(|difference| difference["file"] == file);
    for (file, words) in &expected {
        let detail = of(file).and_then(|found| found["detail"].as_str()).unwrap_or_default();
        assert!(words.iter().all(|words| detail.contains(words)), "{file}: {words:?} in {detail:?}");
    }
    assert_eq!(differences.len(), expected.len(), "{differences:?}");
    let texel = of("tables/ggx-aniso-correlated-8x6x4-f32.raw").expect("a texel");
    assert_eq!(texel["at"], "channel loss, column 5, row 4, slice 2");
    assert_eq!((&texel["max_ulp"], texel["kind"].as_str()), (&1.into(), Some("different")));
    let broken = of("tables/ggx-aniso-correlated-8x6x4-f32.exr").expect("a texel");
    assert_eq!(broken["promise_kept"], false);
}
