//! Instructions of hot kernels, counted by valgrind and held to a record. It stands in this package,
//! the lowest with all kernels below it: nothing of the product is compiled for it.

mod kernel;

use std::collections::BTreeMap;
use std::fs;
use std::hint::black_box;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use kernel::KERNELS;
use serde::{Deserialize, Serialize};

/// How far a count may be from the record's.
const TOLERANCE: f64 = 0.03;

/// How the record is made again.
const RECORD: &str = "CARGO_INCREMENTAL=0 CARGO_PROFILE_RELEASE_LTO=off cargo test --release --workspace --test kernels -- --ignored record";

/// What to install.
const INSTALL: &str = "valgrind (Debian: valgrind)";

/// What all kernels took, and by what they were compiled and counted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Counts {
    /// Compiler and its settings, processor, counter: with another of these counts are other ones.
    toolchain: String,
    /// Instructions by kernel.
    instructions: BTreeMap<String, u64>,
}

impl Counts {
    /// Kernels whose counts are not the record's, in sentences; none where they are not comparable.
    fn against(&self, record: &Counts) -> Option<Vec<String>> {
        (self.toolchain == record.toolchain).then(|| {
            let names = self.instructions.keys().chain(record.instructions.keys());
            let names: std::collections::BTreeSet<&String> = names.collect();
            names.into_iter().filter_map(|name| self.moved(record, name)).collect()
        })
    }

    fn moved(&self, record: &Counts, name: &String) -> Option<String> {
        let [is, was] = [self, record].map(|counts| counts.instructions.get(name).copied());
        match (is, was) {
            (Some(is), Some(was)) => {
                let ratio = is as f64 / was as f64;
                let kept = (ratio - 1.0).abs() <= TOLERANCE;
                let change = 100.0 * (ratio - 1.0);
                (!kept).then(|| format!("{name}: {is} instructions, recorded {was}: {change:+.1} %"))
            }
            _ => Some(format!("{name}: {is:?} instructions, recorded {was:?}")),
        }
    }
}

fn record_file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/kernels/counts.json")
}

fn first_line(program: &str) -> Option<String> {
    let output = Command::new(program).arg("--version").output().ok()?;
    Some(String::from_utf8_lossy(&output.stdout).lines().next().unwrap_or_default().to_owned())
}

/// Compiler and settings that bear on the code, and the counter; none without valgrind.
fn toolchain() -> Option<String> {
    let set = |name: &str, value: Option<&str>| format!("{name}={}", value.unwrap_or("default"));
    let kind = if cfg!(debug_assertions) { "debug" } else { "release" };
    let lto = set("lto", option_env!("CARGO_PROFILE_RELEASE_LTO"));
    let incremental = set("incremental", option_env!("CARGO_INCREMENTAL"));
    let [rustc, valgrind] = ["rustc", "valgrind"].map(first_line);
    let rustc = rustc.expect("the compiler that has compiled this");
    Some([rustc, kind.into(), lto, incremental, processor(), valgrind?].join("; "))
}

/// The processor, by what kernels choose their code by.
fn processor() -> String {
    #[cfg(target_arch = "x86_64")]
    let features = [
        ("avx2", std::arch::is_x86_feature_detected!("avx2")),
        ("fma", std::arch::is_x86_feature_detected!("fma")),
        ("f16c", std::arch::is_x86_feature_detected!("f16c")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let features: [(&str, bool); 0] = [];
    let features = features.into_iter().filter(|(_, has)| *has).map(|(name, _)| format!(" {name}"));
    format!("{}{}", std::env::consts::ARCH, features.collect::<String>())
}

/// Counts on this machine; none without valgrind.
fn counted() -> Option<Counts> {
    let toolchain = toolchain()?;
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("callgrind.out");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--error-exitcode=1"])
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(std::env::current_exe().expect("this program"))
        .args(["--exact", "all_kernels", "--ignored", "--test-threads=1"])
        .output()
        .expect("valgrind runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let profile = fs::read_to_string(out).expect("a profile");
    let instructions = KERNELS.map(|(name, _)| (name.to_owned(), inclusive(&profile, name)));
    Some(Counts { toolchain, instructions: instructions.into() })
}

/// Instructions of all calls of a kernel's function, callees included: in a profile of callgrind
/// `cfn=(number) name` names what is called, its name given once, and below `calls=` its cost.
fn inclusive(profile: &str, kernel: &str) -> u64 {
    let symbol = format!("kernels::kernel::{kernel}");
    let (mut number, mut called, mut total) = (None, false, 0);
    let mut lines = profile.lines();
    while let Some(line) = lines.next() {
        if let Some((id, name)) = line.split_once('(').and_then(|(_, rest)| rest.split_once(')')) {
            if name.trim().split("::h").next() == Some(symbol.as_str()) {
                number = Some(id);
            }
            called = line.starts_with("cfn=") && number == Some(id);
        } else if line.starts_with("calls=") {
            let cost = lines.next().and_then(|line| line.split(' ').nth(1)?.parse::<u64>().ok());
            total += if called { cost.expect("a cost below a call") } else { 0 };
        }
    }
    assert!(total > 0, "no call of {symbol} in the profile");
    total
}

/// What is counted: every kernel once, on one thread.
#[test]
#[ignore = "run under valgrind by the other tests"]
fn all_kernels() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    pool.build_global().expect("the only pool");
    for (name, kernel) in KERNELS {
        let sum = black_box(kernel)();
        assert!(sum.is_finite(), "{name}: {sum}");
    }
}

#[test]
#[ignore = "writes the record"]
fn record() {
    let counts = counted().unwrap_or_else(|| panic!("install {INSTALL}"));
    let text = serde_json::to_string_pretty(&counts).expect("JSON");
    fs::write(record_file(), text + "\n").expect("written");
}

#[test]
fn kernels_take_the_instructions_of_the_record() {
    let text = fs::read_to_string(record_file()).expect("committed");
    let recorded: Counts = serde_json::from_str(&text).expect("a record");
    let names: Vec<&str> = recorded.instructions.keys().map(String::as_str).collect();
    let mut kernels = KERNELS.map(|(name, _)| name);
    kernels.sort_unstable();
    assert_eq!(names, kernels, "to record again: {RECORD}");
    let own = toolchain();
    if own.as_ref().is_none_or(|own| *own != recorded.toolchain) {
        let required = std::env::var("LOBEFIT_REQUIRE_TOOLS").is_ok_and(|v| v == "1");
        assert!(own.is_some() || !required, "LOBEFIT_REQUIRE_TOOLS=1 asks for {INSTALL}");
        let own = own.unwrap_or_else(|| format!("no {INSTALL}"));
        // Past what catches the output of tests that pass.
        writeln!(io::stderr(), "not compared: recorded by {}; this is {own}", recorded.toolchain)
            .expect("said");
        return;
    }
    let counts = counted().expect("valgrind was there");
    let moved = counts.against(&recorded).expect("the same toolchain");
    assert!(moved.is_empty(), "{}\nwhere that is meant: {RECORD}", moved.join("\n"));
}

#[test]
fn a_kernel_that_is_slower_by_a_tenth_is_named() {
    let of = |toolchain: &str, parse: u64| Counts {
        toolchain: toolchain.into(),
        instructions: BTreeMap::from([("fit".into(), 5_000), ("parse".into(), parse)]),
    };
    let record = of("a", 1_000_000);
    let moved = of("a", 1_100_000).against(&record);
    assert_eq!(moved, Some(vec!["parse: 1100000 instructions, recorded 1000000: +10.0 %".into()]));
    assert_eq!(of("a", 1_029_000).against(&record), Some(Vec::new()));
    assert_eq!(of("a", 969_000).against(&record).map(|moved| moved.len()), Some(1), "a gain is recorded");
    assert_eq!(of("b", 1_100_000).against(&record), None, "another compiler is not compared");
    let mut other = record.clone();
    other.instructions.remove("fit");
    assert_eq!(other.against(&record), Some(vec!["fit: None instructions, recorded Some(5000)".into()]));
}

#[test]
fn a_profile_is_read_by_calls() {
    let profile = "fn=(1) kernels::all_kernels\n12 5\ncfn=(2) kernels::kernel::parse::h0123456789abcdef\ncalls=1 0\n13 700\n\
                   cfn=(3) kernels::kernel::parse_more\ncalls=2 0\n14 9\ncfn=(2)\ncalls=1 0\n15 70\n\nfn=(2)\n1 600\n";
    assert_eq!(inclusive(profile, "parse"), 770);
}
