//! What drivers of other vendors say of a shader, as they said it of 1/(x y + 2.5): Mesa 22.3.6 for a
//! Skylake, an Adreno 660 and a Mali-G52. And the committed records of all of them.

use std::collections::BTreeMap;
use std::path::Path;

use lobefit::emit::include::Include;
use lobefit::timing::isa::{Counts, IsaRecord, Precision};
use lobefit_gpu::counted;

use crate::common::names;
use crate::emit_support::say;

const INTEL: &str = include_str!("../machine/skl.txt");
const ADRENO: &str = include_str!("../machine/a660.txt");
const MALI: &str = include_str!("../machine/g52.txt");

fn statistics(all: &[(&str, i64)]) -> BTreeMap<String, i64> {
    all.iter().map(|(name, count)| ((*name).to_owned(), *count)).collect()
}

/// Statistics of the Adreno, which stand in its listing too.
fn adreno() -> BTreeMap<String, i64> {
    statistics(&[
        ("cat1 instructions", 3),
        ("cat2 instructions", 6),
        ("cat3 instructions", 1),
        ("cat4 instructions", 1),
        ("cat5 instructions", 2),
        ("cat6 instructions", 3),
        ("Instruction Count", 46),
        ("Registers used", 3),
        ("Max Waves Per Core", 16),
        ("STP Count", 0),
        ("LDP Count", 0),
    ])
}

#[test]
fn instructions_are_of_their_kinds() {
    let intel = statistics(&[("Spill Count", 0), ("Cycle Count", 700)]);
    let found = counted("intel", &intel, INTEL).expect("known");
    // All but the multiply-add are of the addresses; the lanes' numbers and the literal are moved.
    let wanted = Counts {
        vector: 12,
        transcendental: 1,
        memory: 6,
        moves: 2,
        spills: Some(0),
        latency: Some(700),
        ..Counts::default()
    };
    assert_eq!(found, wanted);
    let wanted = Counts {
        vector: 7,
        transcendental: 1,
        memory: 5,
        moves: 3,
        slots: Some(46),
        vgprs: Some(3),
        waves: Some(16),
        spills: Some(0),
        ..Counts::default()
    };
    assert_eq!(counted("adreno", &adreno(), ADRENO).expect("known"), wanted);
    let wanted = Counts {
        vector: 21,
        transcendental: 1,
        memory: 8,
        moves: 0,
        slots: Some(20),
        waves: Some(2),
        spills: Some(0),
        bytes: Some(496),
        ..Counts::default()
    };
    assert_eq!(counted("mali", &BTreeMap::new(), MALI).expect("known"), wanted);
    // What it prints before is its intermediate form.
    let printed = format!("block b0 {{\n\t+    r0 = NO_SUCH.i32 t1\n}}\n{MALI}");
    assert_eq!(counted("mali", &BTreeMap::new(), &printed).expect("known"), wanted);
}

#[test]
fn what_is_not_known_is_named() {
    let intel = statistics(&[("Spill Count", 0), ("Cycle Count", 700)]);
    let strange = INTEL.replace("math inv(16)", "frob(16)");
    let mut less = adreno();
    less.remove("cat4 instructions");
    let unstated = MALI.replace("SHADER-DB: ", "");
    for (found, said) in [
        (counted("intel", &intel, &strange), "no instruction that this version of lobefit knows: `frob(16)"),
        (counted("intel", &BTreeMap::new(), INTEL), "the driver states no `Spill Count`"),
        (counted("adreno", &less, ADRENO), "the driver states no `cat4 instructions`"),
        (counted("mali", &BTreeMap::new(), &MALI.replace("*FMA", "*0FMA")), "knows: `0FMA.f32"),
        (counted("mali", &BTreeMap::new(), &unstated), "the driver states no `SHADER-DB: `"),
        (counted("nvidia-nvrtc", &BTreeMap::new(), ""), "compiles by no driver nvidia-nvrtc"),
    ] {
        let error = found.expect_err(said).to_string();
        assert!(error.contains(said), "{error}");
    }
}

/// What a driver does not state is absent; what is of other code is said.
#[test]
fn committed_records_are_of_the_emitted_code() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = std::fs::read_to_string(root.join("fits/lobefit.wgsl")).expect("committed");
    let include = Include::new(text);
    let folder = root.join("reports/isa");
    let mut drivers = Vec::new();
    for name in names(&folder) {
        let bytes = std::fs::read(folder.join(&name)).expect("a file");
        let record = IsaRecord::read(&bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        // What is packed comes last, and is not packed by one program alone.
        let plain = |bytes: Vec<u8>| {
            let text = String::from_utf8(bytes).expect("text");
            text.split("\"packed\": ").next().map(String::from)
        };
        assert_eq!(plain(record.bytes().expect("JSON")), plain(bytes), "{name}");
        assert!(name.starts_with(&record.compiler()), "{name}");
        assert!(record.rows.iter().all(|row| record.functions.contains_key(&row.function)), "{name}");
        assert!(record.rows.iter().any(|row| row.precision == Precision::F32), "{name}");
        let stated =
            |count: fn(&Counts) -> Option<i64>| record.rows.iter().all(|row| count(&row.counts).is_some());
        let none =
            |count: fn(&Counts) -> Option<i64>| record.rows.iter().all(|row| count(&row.counts).is_none());
        match record.driver.as_str() {
            "radv" => assert!(stated(|c| c.scalar) && stated(|c| c.latency) && none(|c| c.slots), "{name}"),
            "intel" => assert!(stated(|c| c.latency) && none(|c| c.vgprs) && none(|c| c.scalar), "{name}"),
            "adreno" | "mali" => assert!(stated(|c| c.slots) && none(|c| c.latency), "{name}"),
            "nvidia-nvrtc" => assert!(stated(|c| c.scalar) && none(|c| c.spills), "{name}"),
            other => panic!("{name}: of {other}"),
        }
        if record.scene == "default" {
            // The texels of a table are not in the include file.
            let fetches =
                |function: &&str| include.code(function).is_some_and(|code| code.contains("texture_"));
            let stale = record.stale(&include);
            let stale: Vec<&str> = stale.into_iter().filter(|function| !fetches(function)).collect();
            if !stale.is_empty() {
                say(&format!("{name}: {} are of other code than in the record", stale.join(", ")));
            }
            drivers.push(record.driver);
        }
    }
    drivers.sort();
    assert_eq!(drivers, ["adreno", "intel", "mali", "nvidia-nvrtc", "radv"]);
}
