//! What the tests of emitted files share: one bake of the built-in scene in little, points of its
//! domain, and the tables that it emits reading functions for.
#![allow(dead_code, reason = "each test binary uses its part")]

pub mod accuracy;
pub mod compilers;
pub mod example;
pub mod languages;
pub mod programs;
pub mod solid;
pub mod subvoxels;

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::OnceLock;

use crate::baked_support::shared;
use lobefit::approximate::{Fit, Memo, Region, certification};
use lobefit::bake::{Baked, Silent, bake};
use lobefit::data::{AlphaMap, Arguments, Decode, Layout, Serves, Smith, Table, TexelFormat, Values};
use lobefit::effects::Albedo;
use lobefit::effects::demand::Job;
use lobefit::effects::reflection::{GGX, build};
use lobefit::effects::table::{self, Lookup, Spec, Truth, measure};
use lobefit::emit::lookup::{Readable, TableNames};
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit_truth::points;
use lobefit_truth::quantity::TRUTH_ERROR;

/// The built-in scene with every approximation: no pages, and small tables of three axes, whose
/// functions are those of the large.
fn in_little() -> Scene {
    let file = include_bytes!("../../src/scene/default.json");
    let mut scene: serde_json::Value = serde_json::from_slice(file).expect("JSON");
    scene["pick"] = "all".into();
    scene["reports"] = false.into();
    let materials = scene["materials"].as_array_mut().expect("materials[]").iter_mut();
    let tables = materials.flat_map(|m| m["wants"]["tables"].as_array_mut().expect("tables[]"));
    for table in tables.filter(|table| table["size"][2].is_number()) {
        table["size"] = serde_json::json!([16, 16, 8]);
        table.as_object_mut().expect("a table").remove("max_error");
    }
    Scene::from_json(scene.to_string().as_bytes(), "the built-in scene in little").expect("a scene")
}

/// Its bake, once per test binary, with the fit that it called for.
pub fn baked() -> &'static (Baked, Job) {
    static BAKED: OnceLock<(Baked, Job)> = OnceLock::new();
    BAKED.get_or_init(|| {
        let scene = in_little();
        let plan = plan(&scene);
        let fit = plan.jobs("reflection").last().cloned().expect("the built-in scene calls for fits");
        let baked = bake(&scene, &plan, &[], shared(), &Silent);
        (baked.expect("the built-in scene bakes"), fit)
    })
}

/// A file of the bake as text.
pub fn text(path: &str) -> String {
    let bytes = baked().0.files.get(path).unwrap_or_else(|| panic!("no {path} in the bake"));
    String::from_utf8(bytes.clone()).expect("UTF-8")
}

/// The manifest of the bake.
pub fn manifest() -> serde_json::Value {
    serde_json::from_str(&text("manifest.json")).expect("JSON")
}

/// Fits that the manifest lists, in its order, with their function and its arguments; those of
/// lookups, whose inputs are others, have tests of their own.
pub fn emitted() -> Vec<(&'static Fit, String, Vec<String>)> {
    let manifest = manifest();
    let entries = manifest["fits"].as_array().expect("fits[]");
    let string = |v: &serde_json::Value| v.as_str().expect("a string").to_string();
    let of = |entry: &serde_json::Value| {
        let name = string(&entry["name"]);
        let fit = baked().0.fits.iter().find(|f| f.approximation.name == name);
        let inputs = entry["inputs"].as_array().expect("inputs").iter().map(string).collect();
        (fit.unwrap_or_else(|| panic!("no fit {name}")), string(&entry["function"]), inputs)
    };
    entries.iter().filter(|entry| entry["use"] != "parallax").map(of).collect()
}

/// At least 65,536 points, the edges and corners of a region among them: its certification points.
const LOG2_POINTS: u32 = 15;

/// Inputs of the emitted functions at every point: roughness, alpha, mu and f0.
#[derive(Clone)]
pub struct Points {
    pub set: points::Points,
    columns: [Vec<f32>; 4],
}

impl Points {
    pub fn of(region: &Region) -> Points {
        let set = certification(region, LOG2_POINTS);
        assert!(set.len() >= 65_536, "{} points", set.len());
        // 0, 1 and 15 values between, changing from point to point
        let f0 = (0..set.len()).map(|i| (i * 5 % 17) as f32 / 16.0).collect();
        let column = |name: &str| set.column_f32(name).expect("a column");
        let columns = [column("roughness"), column("alpha"), column("mu"), f0];
        Points { set, columns }
    }

    /// The same points at one f0.
    #[allow(dead_code, reason = "not every test binary asks for it")]
    pub fn at_f0(&self, f0: f32) -> Points {
        let mut points = self.clone();
        points.columns[3].fill(f0);
        points
    }

    /// The region that the fits hold in.
    pub fn of_fits() -> Points {
        let job = &baked().1;
        Points::of(&job.region(AlphaMap::default()).expect("a region"))
    }

    pub fn len(&self) -> usize {
        self.set.len()
    }

    /// A column of inputs by name.
    pub fn column(&self, name: &str) -> &[f32] {
        let place = ["roughness", "alpha", "mu", "f0"].iter().position(|input| *input == name);
        &self.columns[place.unwrap_or_else(|| panic!("no input {name}"))]
    }

    /// roughness, alpha, mu, f0 of every point, one after another.
    pub fn bytes(&self) -> Vec<u8> {
        let point = |i: usize| self.columns.each_ref().map(|column| column[i]);
        (0..self.len()).flat_map(point).flat_map(f32::to_le_bytes).collect()
    }

    /// A fit's value at every point, in f32.
    pub fn values(&self, fit: &Fit, inputs: &[String]) -> Vec<f32> {
        let columns: Vec<Vec<f32>> = inputs.iter().map(|name| self.column(name).to_vec()).collect();
        fit.hypothesis.tape().evaluate(&columns, &fit.coefficients()).expect("as many inputs as the tape has")
    }
}

/// A quantised table with what its emitted functions need, and its certified error.
pub struct Looked {
    pub table: Table,
    pub names: TableNames,
    pub decode: Decode,
    pub region: Region,
    /// Largest error with f32 weights and with 8-bit weights.
    pub certified: [f64; 2],
}

impl Looked {
    pub fn readable(&self) -> Readable<'_> {
        let arguments = Arguments::default();
        Readable { table: &self.table, decode: self.decode, names: &self.names, arguments, header: &[] }
    }

    /// Whether it returns E, A and B, not E alone.
    pub fn split(&self) -> bool {
        self.decode.has_bias()
    }

    pub fn lookup(&self) -> Lookup<'_> {
        Lookup::new(&self.table, self.decode).expect("axes and channels of its decoding")
    }

    /// Whether E, A and B are, to the bit, what the emitted code returns where a lookup gives E and
    /// B: A is E - B where the texel holds E, else E is the sum A + B of what it holds.
    pub fn agrees(&self, [e, a, b]: [f32; 3], expected: Values) -> bool {
        let third = match self.decode {
            Decode::LossBias => a.to_bits() == (e - b).to_bits(),
            _ => (a + b).to_bits() == e.to_bits(),
        };
        third && e.to_bits() == expected.e.to_bits() && Some(b.to_bits()) == expected.b.map(f32::to_bits)
    }
}

/// The tables of the bake over mu and roughness alone; `sliced.rs` has the others.
pub fn baked_tables() -> Vec<Looked> {
    let all = baked().0.tables.iter().map(|b| (b, b.table().expect("a table")));
    let tables = all.filter(|(_, table)| table.axes.len() == 2).map(|(b, table)| Looked {
        table: table.clone(),
        names: b.names.clone(),
        decode: b.decode,
        region: b.region.flat(),
        certified: [b.errors.lookup.max, b.errors.lookup_8_bit.max],
    });
    tables.collect()
}

/// Small tables of the layouts and uses that the built-in scene does not call for, which have
/// emitted functions of their own.
pub fn other_tables() -> Vec<Looked> {
    let mut tables = Vec::new();
    for layout in [Layout::Plain, Layout::PlainSquared] {
        for serves in [Serves::Albedo, Serves::SplitSum] {
            tables.push(other(layout, serves, [12, 7]));
        }
    }
    tables
}

fn other(layout: Layout, serves: Serves, size: [usize; 2]) -> Looked {
    let alpha_map = AlphaMap::RoughnessSquared;
    let region = Region { roughness: [0.02, 1.0], mu: [0.001, 1.0], alpha_map };
    let spec = Spec {
        names: vec![format!("other-{}-{}", layout.name(), serves.name())],
        smith: Smith::Correlated,
        size: size.to_vec(),
        format: TexelFormat::F16,
        layout,
        serves,
        region: region.into(),
    };
    let table = build(&GGX, &spec, &Memo::default()).expect("a table").remove(0).quantised();
    let points = certification(&region, LOG2_POINTS);
    let truth = Albedo::new(spec.smith, &points, true, &Memo::default()).expect("a truth");
    let (decode, points) = (Decode::of(layout, serves), table::LookupPoints::isotropic(&points));
    let truth = Truth { e: &truth.e, b: Some(&truth.b) };
    let errors = measure(&table, decode, &points, truth, TRUTH_ERROR).expect("a table of its decoding");
    Looked {
        names: solid::names_of(&table),
        table,
        decode,
        region,
        certified: [errors.lookup.max, errors.lookup_8_bit.max],
    }
}

/// The largest error of the truth that tables are judged by.
pub const TRUTH: f64 = TRUTH_ERROR;

/// Says on standard error, past the test harness's capture, what was measured.
pub fn say(line: &str) {
    // Nothing depends on the message.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// A tool or device is not there: the test is skipped and says so, or fails where
/// LOBEFIT_REQUIRE_TOOLS=1 asks for it.
pub fn missing(what: &str, install: &str) {
    let required = std::env::var("LOBEFIT_REQUIRE_TOOLS").is_ok_and(|v| v == "1");
    assert!(!required, "{what}; LOBEFIT_REQUIRE_TOOLS=1 asks for it: install {install}");
    say(&format!("skipped: {what}; to run it, install {install}"));
}

/// The functions of a WGSL file by name, each with its whole text.
pub fn functions(source: &str) -> BTreeMap<&str, &str> {
    let mut functions = BTreeMap::new();
    for (start, _) in source.match_indices("fn ").filter(|(i, _)| *i == 0 || source[..*i].ends_with('\n')) {
        let text = &source[start..];
        let end = text.find("\n}\n").unwrap_or_else(|| panic!("an end of\n{text}")) + "\n}\n".len();
        let name = text["fn ".len()..].split('(').next().expect("a name");
        assert!(functions.insert(name, &text[..end]).is_none(), "{name} is there twice");
    }
    functions
}

/// A function as a module of its own: the functions of the file that it calls, and theirs, before
/// it.
pub fn module(name: &str, functions: &BTreeMap<&str, &str>) -> String {
    let text = functions.get(name).unwrap_or_else(|| panic!("no {name}"));
    let called = functions.keys().filter(|other| **other != name && text.contains(&format!("{other}(")));
    // A name may end in another: only a call begins where no name goes on.
    let begins = |at: usize| !text[..at].ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_');
    let called = called.filter(|other| text.match_indices(&format!("{other}(")).any(|(at, _)| begins(at)));
    called.map(|other| module(other, functions)).collect::<String>() + text
}
