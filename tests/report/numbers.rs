//! Numbers as pages print them.

use lobefit::report::numbers::{bound, brief, brief_bound, grouped, place, shortened, significant, tick};

#[test]
fn a_bound_is_never_printed_below_itself() {
    assert_eq!(bound(0.10401, 3), "0.105");
    assert_eq!(bound(0.0999, 2), "0.10");
    assert_eq!(bound(9.99e-6, 2), "1.0e\u{2212}5");
    assert_eq!(bound(-0.1231, 3), "\u{2212}0.124");
    assert_eq!(bound(0.125, 3), "0.125");
    assert_eq!(significant(0.10449, 3), "0.104");
}

#[test]
fn numbers_are_plain_where_short() {
    assert_eq!(significant(0.0, 3), "0");
    assert_eq!(significant(12345.6, 3), "12300");
    assert_eq!(significant(1.0, 3), "1.00");
    assert_eq!(brief(1.0, 3), "1");
    assert_eq!(brief(1200.0, 2), "1200");
    assert_eq!(brief_bound(9.999e-6, 2), "1e\u{2212}5");
    assert_eq!(tick(0.30000000000000004), "0.3");
    assert_eq!(tick(-1e-4), "\u{2212}10⁻⁴");
    assert_eq!(tick(2.5e-9), "2.5×10⁻⁹");
    assert_eq!(place(0.30000000000000004), "0.3");
    assert_eq!(place(0.4000000000001), "0.4");
    assert_eq!(grouped(10_000_000), "10\u{a0}000\u{a0}000");
}

#[test]
fn numbers_in_a_text_are_shortened_and_names_are_not() {
    let text = "plaster (roughness 0.30000000000000004 to 0.7), lamp_1.23456789, 1.2345678e-9, 12345678, at 1.23456789.";
    let short = "plaster (roughness 0.3 to 0.7), lamp_1.23456789, 1.2345678e-9, 12345678, at 1.23456789.";
    assert_eq!(shortened(text), short);
    assert_eq!(shortened("u = (roughness - 0.123456789) / 2"), "u = (roughness - 0.123457) / 2");
    assert_eq!(shortened(""), "");
}
