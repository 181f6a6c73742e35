//! The published comparison as printed: errors of published fits on the grid.

/// One formula: its name, the catalogue's blend and normalisation (empty: it has none), how it is
/// fed, and the printed columns A, B, E, max of 1/E, furnace (max/rms/p99 each), and the worst
/// roughness and mu of the furnace error.
pub struct Row {
    pub id: &'static str,
    pub blend: &'static str,
    pub norm: &'static str,
    pub fed: Fed,
    pub a: &'static str,
    pub b: &'static str,
    pub e: &'static str,
    pub inverse: &'static str,
    pub furnace: &'static str,
    pub worst: &'static str,
}

/// What is given for a formula's roughness or alpha.
#[derive(Clone, Copy, Debug)]
pub enum Fed {
    /// What it asks for.
    Right,
    /// r where the square root of the roughness is meant.
    SquareRoot,
    /// (1 - r)^4 for the gloss 1 - sqrt(r).
    FourthPower,
    /// r for alpha.
    Roughness,
    /// alpha^2 for alpha.
    Squared,
    /// r for alpha, and its square root for the roughness.
    Both,
}

const fn row(id: &'static str, formula: [&'static str; 2], fed: Fed, columns: [&'static str; 6]) -> Row {
    let [a, b, e, inverse, furnace, worst] = columns;
    Row { id, blend: formula[0], norm: formula[1], fed, a, b, e, inverse, furnace, worst }
}

use Fed::{Both, FourthPower, Right, Roughness, SquareRoot, Squared};

/// Against height-correlated Smith.
pub const ROWS: [Row; 24] = [
    row("N1", ["", "pesce_n1"], Right, ["-", "-", ".132/.065/.130", ".26", ".144/.077/.142", ".67,.32"]),
    row("N2", ["", "pesce_n2"], Right, ["-", "-", ".454/.087/.259", "1.26", ".908/.129/.443", "1,.01"]),
    row(
        "K",
        ["karis", "karis"],
        Right,
        [".459/.128/.320", ".085/.020/.072", ".504/.134/.366", "1.17", "1.120/.215/.709", "1,.01"],
    ),
    row(
        "L1",
        ["lazarov", "lazarov"],
        Right,
        [".482/.140/.410", ".477/.049/.258", ".443/.126/.388", "1.93", ".591/.161/.511", "1,1"],
    ),
    row(
        "L2",
        ["narkowicz_l2", "narkowicz_l2"],
        Right,
        [".436/.070/.278", ".103/.022/.074", ".478/.081/.323", "1.16", "1.006/.139/.590", "1,.01"],
    ),
    row(
        "L2'",
        ["narkowicz_l2", "narkowicz_l2"],
        SquareRoot,
        [".436/.110/.289", ".393/.077/.331", ".478/.114/.261", "1.16", "1.006/.151/.459", "1,.01"],
    ),
    row(
        "P1",
        ["narkowicz_p1", "narkowicz_p1"],
        Right,
        [".312/.040/.168", ".107/.021/.075", ".355/.048/.209", ".62", ".592/.075/.324", "1,.01"],
    ),
    row(
        "P1'",
        ["narkowicz_p1", "narkowicz_p1"],
        SquareRoot,
        [".432/.114/.336", ".443/.082/.353", ".355/.102/.240", ".62", ".592/.123/.276", "1,.01"],
    ),
    row(
        "P1\"",
        ["narkowicz_p1", "narkowicz_p1"],
        FourthPower,
        [".479/.221/.458", ".359/.066/.283", ".479/.236/.458", "1.90", "1.380/.528/1.272", ".65,1"],
    ),
    row(
        "M1",
        ["materialx_m1", "materialx_m1"],
        Right,
        [".112/.013/.056", ".047/.003/.015", ".096/.012/.055", ".11", ".097/.013/.059", ".09,.01"],
    ),
    row(
        "M1'",
        ["materialx_m1", "materialx_m1"],
        Roughness,
        [".443/.118/.321", ".412/.072/.336", ".234/.109/.224", ".56", ".394/.166/.370", ".64,1"],
    ),
    row(
        "G",
        ["ray_tracing_gems", "ray_tracing_gems"],
        Right,
        [".332/.046/.191", ".045/.008/.032", ".359/.051/.212", ".63", ".605/.078/.330", "1,.01"],
    ),
    row(
        "I",
        ["pesce_iwanicki", "pesce_iwanicki"],
        Right,
        [".279/.060/.206", ".142/.026/.114", ".262/.049/.172", ".95", ".379/.074/.254", "1,.01"],
    ),
    row(
        "I'",
        ["pesce_iwanicki", "pesce_iwanicki"],
        SquareRoot,
        [".414/.108/.292", ".341/.063/.260", ".262/.099/.205", ".96", ".379/.127/.304", "1,.01"],
    ),
    row(
        "S",
        ["ross", ""],
        Right,
        [".693/.230/.611", ".220/.034/.135", ".693/.247/.629", "2.26", ".693/.247/.629", "1,1"],
    ),
    row(
        "U",
        ["ue5", "ue5"],
        Right,
        [".056/.013/.048", ".082/.005/.021", ".065/.013/.047", ".10", ".068/.015/.050", ".13,.02"],
    ),
    row("D1", ["", "dassault"], Right, ["-", "-", ".117/.045/.114", ".14", ".119/.049/.116", ".42,.19"]),
    row("D1'", ["", "dassault"], Squared, ["-", "-", ".242/.122/.240", ".57", ".286/.138/.281", ".80,.98"]),
    row("D1\"", ["", "dassault"], Roughness, ["-", "-", ".234/.088/.216", ".55", ".393/.137/.356", ".64,1"]),
    row(
        "Q",
        ["tauray", "tauray"],
        Right,
        [".089/.012/.048", ".087/.009/.045", ".092/.011/.046", ".14", ".104/.013/.052", ".36,.01"],
    ),
    row(
        "Q'",
        ["tauray", "tauray"],
        Both,
        [".435/.118/.317", ".452/.075/.357", ".233/.110/.221", ".65", ".414/.168/.377", ".68,1"],
    ),
    row("F", ["", "turquin_label"], Right, ["-", "-", ".676/.142/.479", "2.24", ".688/.171/.563", "1,1"]),
    row(
        "Y",
        ["urp", "urp"],
        Right,
        [".411/.094/.294", ".285/.054/.228", ".454/.087/.259", "1.26", ".908/.129/.443", "1,.01"],
    ),
    row(
        "H",
        ["schlick_roughness", ""],
        Right,
        [".693/.245/.630", ".297/.051/.232", ".693/.247/.629", "2.26", ".693/.247/.629", "1,1"],
    ),
];

/// Against separable and correlated Smith: max/rms of E, rms of B; a maximum alone for those fitted
/// to the correlated lobe.
pub const SEPARABLE: [(&str, &str, &str); 8] = [
    ("P1", ".062/.011", ".0179"),
    ("G", ".078/.017", ".0060"),
    ("I", ".128/.045", ".0281"),
    ("L2", ".169/.052", ".0184"),
    ("K", ".199/.108", ".0180"),
    ("M1", ".312", "-"),
    ("U", ".315", "-"),
    ("Q", ".322", "-"),
];

/// The root mean square of B against correlated Smith, with one digit more than in [`ROWS`].
pub const CORRELATED_B: [(&str, &str); 5] =
    [("P1", ".0215"), ("G", ".0083"), ("I", ".0260"), ("L2", ".0219"), ("K", ".0204")];
