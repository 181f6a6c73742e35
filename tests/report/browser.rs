//! Every page in a browser: the committed ones and those of a small bake, wide and narrow. A copy
//! of each page reports its errors; the page that holds the copies tries what a reader would, and
//! leaves what it found in an attribute.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lobefit_truth::optics::Smith;
use lobefit_truth::quantity::GGX_REFLECTION;
use serde::Deserialize;

/// Collects the errors of a page, from its first element on.
const REPORTER: &str = "<script>window.__errors = []; addEventListener('error', (e) => __errors.push(e.message || \
     `cannot load ${e.target.src || e.target.href}`), true); addEventListener('unhandledrejection', (e) => \
     __errors.push(String(e.reason))); for (const k of ['error', 'warn']) { const said = console[k]; console[k] = \
     (...a) => { __errors.push(a.join(' ')); said(...a); }; }</script>";

const WIDTHS: [u32; 3] = [1400, 1280, 390];

/// Most pixels of a page, on a desk and on a phone, before a reader opens anything.
const TALL: u32 = 6000;

/// What was found of a page at a width.
#[derive(Debug, Deserialize)]
struct Seen {
    page: String,
    width: u32,
    /// Pixels of the page before a reader opens anything.
    tall: u32,
    /// Code of cards that is not seen whole.
    cut: Vec<String>,
    errors: Vec<String>,
    font: String,
    overflow: i64,
    sorted: Vec<String>,
    copied: bool,
    tips: Vec<String>,
    links: Vec<String>,
    ids: BTreeSet<String>,
    /// Names of places that are there twice.
    twice: Vec<String>,
    /// Tables that are filtered by whose their rows are.
    filters: usize,
    /// What a filter shows wrongly.
    filtered: Vec<String>,
    #[serde(default)]
    live: Option<Live>,
}

/// What the live page draws.
#[derive(Debug, Deserialize)]
struct Live {
    /// Largest difference between a sphere with the truth and the furnace around it, of 255.
    white: u32,
    /// The same of the sphere without an approximation.
    grey: u32,
    shown: Vec<Shown>,
    /// What stands below the spheres with the pointer on the middle one.
    pointed: String,
    /// Roughness, 0.5 before, and the address of the page after an arrow key.
    roughness: f64,
    address: String,
}

/// What the live page finds of an approximation.
#[derive(Debug, Deserialize)]
struct Shown {
    lobe: String,
    drawn: String,
    name: String,
    standing: String,
    /// Largest error over roughness and mu.
    anywhere: f64,
    /// The error of the truth's texels.
    truth: f64,
    /// That of the certificate; 0 without one.
    certified: f64,
    /// Roughness to alpha.
    alpha: String,
    /// Roughness, mu and truth at five places.
    truths: Vec<[f64; 3]>,
}

fn root(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}

/// The pages in a folder, relative to it.
fn pages(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() {
            found.extend(pages(&path).into_iter().map(|page| format!("{name}/{page}")));
        } else if name.ends_with(".html") {
            found.push(name);
        }
    }
    found.sort();
    found
}

/// Copies of the pages with the reporter, and the originals by the name of the copy.
fn copied(to: &Path, from: &[(&str, PathBuf)]) -> BTreeMap<String, PathBuf> {
    let mut originals = BTreeMap::new();
    for (name, folder) in from {
        for page in pages(folder) {
            let text = fs::read_to_string(folder.join(&page)).expect("a page");
            let copy = to.join(name).join(&page);
            fs::create_dir_all(copy.parent().expect("a folder")).expect("a folder");
            fs::write(&copy, text.replacen("<head>", &format!("<head>{REPORTER}"), 1)).expect("written");
            originals.insert(format!("{name}/{page}"), folder.join(&page));
        }
    }
    originals
}

/// The browser's path; none where there is none.
fn browser() -> Option<&'static str> {
    let known = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    known
        .into_iter()
        .find(|name| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success()))
}

fn look(browser: &str, folder: &Path, originals: &BTreeMap<String, PathBuf>) -> Vec<Seen> {
    let names: Vec<&String> = originals.keys().collect();
    let harness = include_str!("browser.html")
        .replace("PAGES", &serde_json::to_string(&names).expect("names"))
        .replace("WIDTHS", &format!("{WIDTHS:?}"));
    fs::write(folder.join("harness.html"), harness).expect("written");
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--allow-file-access-from-files"])
        .args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1500,1000"])
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .args(["--virtual-time-budget=200000", "--dump-dom"])
        .arg(format!("file://{}", folder.join("harness.html").display()))
        .output()
        .expect("the browser runs");
    let page = String::from_utf8_lossy(&output.stdout);
    let found = page.split_once("data-result=\"").and_then(|(_, rest)| rest.split_once('"'));
    let (found, _) =
        found.unwrap_or_else(|| panic!("no result: {}", String::from_utf8_lossy(&output.stderr)));
    serde_json::from_slice(&STANDARD.decode(found).expect("base64")).expect("what was seen")
}

#[test]
fn every_page_works_in_a_browser() {
    let Some(browser) = browser() else {
        let required = std::env::var("LOBEFIT_REQUIRE_TOOLS").is_ok_and(|v| v == "1");
        assert!(!required, "no chromium; LOBEFIT_REQUIRE_TOOLS=1 asks for it");
        eprintln!("skipped: no chromium; to run it, install chromium");
        return;
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser");
    // The folder of an older run; there need not be one.
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let fresh = folder.join("bake");
    let bake = Command::new(env!("CARGO_BIN_EXE_lobefit"))
        .args(["bake", "tests/report/browser.json", "--no-cache", "--quiet", "--out"])
        .arg(&fresh)
        .current_dir(root(""))
        .output()
        .expect("the binary runs");
    assert!(bake.status.success(), "{}", String::from_utf8_lossy(&bake.stderr));
    let originals = copied(&folder, &[("committed", root("reports")), ("fresh", fresh.join("reports"))]);
    let seen = look(browser, &folder, &originals);
    assert_eq!(seen.len(), originals.len() * WIDTHS.len());
    let ids = seen.iter().map(|s| (s.page.as_str(), &s.ids)).collect();
    for one in &seen {
        let (page, width) = (&one.page, one.width);
        assert!(one.errors.is_empty(), "{page} at {width}: {:?}", one.errors);
        assert_eq!(one.font, "loaded", "{page} at {width}: the font");
        assert!(one.overflow <= 0, "{page} at {width} is {} pixels wider than its window", one.overflow);
        assert!(one.sorted.is_empty(), "{page} at {width}: tables that do not sort: {:?}", one.sorted);
        assert!(one.tall <= TALL, "{page} at {width} is {} pixels tall", one.tall);
        assert!(one.cut.is_empty(), "{page} at {width}: cards cut {:?}", one.cut);
        assert!(one.twice.is_empty(), "{page} at {width}: places of one name: {:?}", one.twice);
        assert!(one.filtered.is_empty(), "{page} at {width}: filters: {:?}", one.filtered);
        assert!(one.copied, "{page} at {width}: code without a button to copy it");
        assert!(one.tips.is_empty(), "{page} at {width}: nothing under the pointer on {:?}", one.tips);
        resolved(one, &originals, &ids);
    }
    assert!(seen.iter().any(|one| one.filters > 0), "no table of ours and published formulas");
    let led = seen.iter().filter(|one| one.page.ends_with("index.html"));
    let led = led.flat_map(|one| &one.links).filter(|link| link.contains(".html#")).count();
    assert!(led > 20, "{led} links from the overview to approximations");
    let live: Vec<&Live> = seen.iter().filter_map(|one| one.live.as_ref()).collect();
    assert!(!live.is_empty(), "no live page");
    live.into_iter().for_each(agrees);
}

/// Every link leads to a file, and to a place that is there.
fn resolved(one: &Seen, originals: &BTreeMap<String, PathBuf>, ids: &BTreeMap<&str, &BTreeSet<String>>) {
    let original = &originals[&one.page];
    for link in &one.links {
        let (file, place) = link.split_once('#').unwrap_or((link, ""));
        let what = format!("{}: link to {link}", one.page);
        assert!(!link.contains("://"), "{what} leads out");
        let beside = Path::new(&one.page).parent().expect("a folder").join(file);
        let to =
            if file.is_empty() { original.clone() } else { original.parent().expect("a folder").join(file) };
        assert!(to.is_file(), "{what}: no {}", to.display());
        // the state of the live page is an address too
        if place.is_empty() || place.contains('=') {
            continue;
        }
        let name = if file.is_empty() { one.page.clone() } else { beside.to_string_lossy().into_owned() };
        assert!(ids.get(name.as_str()).is_some_and(|ids| ids.contains(place)), "{what}: no such place");
    }
}

/// As the page writes it.
const COMPENSATION: &str = "\"compensation\"";

/// 1/E by the integral.
fn is_the_truth([roughness, mu, found]: [f64; 3], one: &Shown) {
    assert_eq!(one.alpha, "roughness * roughness");
    let variant = Smith::Correlated.into();
    let e = GGX_REFLECTION.at(&variant, &[roughness * roughness, mu], 1e-7).expect("inside the domain")[0];
    let off = found * e - 1.0;
    assert!(off.abs() < 3.0 * one.truth + 2e-6, "{}: 1/E at {roughness}, {mu} is off by {off}", one.lobe);
}

/// What the live page draws is what was certified.
fn agrees(live: &Live) {
    assert!(live.white <= 1, "a sphere with the truth is off by {} of 255", live.white);
    assert!(live.grey > 20, "a sphere without compensation is off by {} of 255 only", live.grey);
    assert!(live.pointed.starts_with("mu 1, roughness 0.5: truth "), "{}", live.pointed);
    assert!((live.roughness - 0.51).abs() < 1e-9, "an arrow key: roughness {}", live.roughness);
    assert!(
        live.address.contains("lobe=metal") && live.address.contains("roughness=0.51"),
        "{}",
        live.address
    );
    assert!(live.shown.len() > 5, "{} approximations", live.shown.len());
    for one in &live.shown {
        let what = format!("{}, {}: {} drawn, {} certified", one.lobe, one.name, one.anywhere, one.certified);
        assert!(one.anywhere.is_finite() && one.truth < 1e-4, "{what}; truth {}", one.truth);
        if one.drawn == COMPENSATION {
            one.truths.iter().for_each(|place| is_the_truth(*place, one));
        }
        if one.certified > 0.0 {
            // The certificate of a table is of E, which is above 0.3; fetches have 8 bits between
            // texels, and f16 rounds.
            let of_e = one.standing == "table" && one.drawn == COMPENSATION;
            let most = if of_e { 3.3 * one.certified } else { one.certified };
            let slack = if one.standing == "table" { 1e-3 } else { 3.0 * one.truth * (1.0 + one.certified) };
            assert!(one.anywhere <= most + slack, "{what}");
            assert!(one.anywhere >= 0.4 * one.certified, "{what}");
        }
    }
}
