//! Numbers as people read them: few digits, and never a maximum that is printed smaller than it is.

/// `x` with `digits` significant digits, rounded to nearest; plain between 1e-3 and 1e5, else
/// `1.2e-5`.
pub fn significant(x: f64, digits: usize) -> String {
    layout(&format!("{x:.*e}", digits.max(1) - 1))
}

/// As [`significant`], rounded away from zero, so that a bound stays a bound.
pub fn bound(x: f64, digits: usize) -> String {
    let nearest = format!("{x:.*e}", digits.max(1) - 1);
    match nearest.parse::<f64>() {
        Ok(value) if value.abs() < x.abs() => layout(&next_up(&nearest)),
        _ => layout(&nearest),
    }
}

/// As [`significant`], without trailing zeros: for places and settings, which are exact.
pub fn brief(x: f64, digits: usize) -> String {
    trimmed(&significant(x, digits))
}

/// As [`bound`], without trailing zeros.
pub fn brief_bound(x: f64, digits: usize) -> String {
    trimmed(&bound(x, digits))
}

/// Drops the trailing zeros of a decimal fraction, before the exponent if there is one.
fn trimmed(text: &str) -> String {
    let (mantissa, exponent) = text.split_at(text.find('e').unwrap_or(text.len()));
    let short =
        if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    format!("{short}{exponent}")
}

/// `x` rounded away from zero to `digits` significant digits.
pub fn round_up(x: f64, digits: usize) -> f64 {
    let nearest = format!("{x:.*e}", digits.max(1) - 1);
    let up = |text: &str| text.parse().unwrap_or(x);
    let value: f64 = up(&nearest);
    if value.abs() < x.abs() { up(&next_up(&nearest)) } else { value }
}

/// `x` rounded to nearest with `digits` significant digits.
pub fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits.max(1) - 1).parse().unwrap_or(x)
}

/// An integer with thin groups of thousands: `10 000 000`.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push('\u{a0}');
        }
        out.push(c);
    }
    out
}

/// A signed number for a colour bar or tick: minus sign U+2212, no trailing zeros.
pub fn tick(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    // Ticks are multiples of a decimal step; 12 digits drop the binary residue of the
    // multiplication.
    let short: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    let size = short.abs();
    let text = if (1e-3..1e5).contains(&size) { format!("{size}") } else { power_of_ten(size) };
    if short < 0.0 { format!("\u{2212}{text}") } else { text }
}

/// As [`tick`], with at most 6 significant digits: for places that a scene gives.
pub fn place(x: f64) -> String {
    tick(rounded(x, 6))
}

/// A text, each decimal fraction in it with at most 6 significant digits; numbers inside names
/// stay.
pub fn shortened(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let end =
            rest[start..].find(|c: char| !c.is_ascii_digit() && c != '.').map_or(rest.len(), |n| start + n);
        let (before, number) = (&rest[..start], &rest[start..end]);
        out.push_str(before);
        let inside = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
        let named = inside(out.chars().next_back()) || inside(rest[end..].chars().next());
        let long = number.bytes().filter(u8::is_ascii_digit).count() > 6;
        match number.parse::<f64>() {
            Ok(x) if long && !named && number.contains('.') => out.push_str(&brief(x, 6)),
            _ => out.push_str(number),
        }
        rest = &rest[end..];
    }
    out + rest
}

/// `2×10⁻⁴`, `10⁻⁴`, for axis labels.
pub fn power_of_ten(size: f64) -> String {
    let text = format!("{size:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let raised = superscript(exponent);
    if mantissa == "1" { format!("10{raised}") } else { format!("{mantissa}×10{raised}") }
}

/// Digits and sign as superscripts.
fn superscript(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '4'..='9' => char::from_u32(0x2070 + u32::from(c) - u32::from('0')).unwrap_or(c),
            _ => '⁰',
        })
        .collect()
}

/// Scientific text `d.dde-x` with its last digit raised by one, carrying.
fn next_up(scientific: &str) -> String {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    let mut exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if mantissa.starts_with('-') { "-" } else { "" };
    let mut digits: Vec<u8> = mantissa.bytes().filter(u8::is_ascii_digit).collect();
    let carried = digits.iter().rposition(|&d| d != b'9');
    match carried {
        Some(i) => {
            digits[i] += 1;
            digits[i + 1..].fill(b'0');
        }
        None => {
            digits.fill(b'0');
            digits[0] = b'1';
            exponent += 1;
        }
    }
    let text: String = digits.iter().map(|&d| char::from(d)).collect();
    let (first, rest) = text.split_at(1);
    let point = if rest.is_empty() { "" } else { "." };
    format!("{sign}{first}{point}{rest}e{exponent}")
}

/// Scientific text as plain decimal where that is short.
fn layout(scientific: &str) -> String {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if mantissa.bytes().all(|b| !(b'1'..=b'9').contains(&b)) {
        return "0".into();
    }
    if !(-3..5).contains(&exponent) {
        return scientific.replace('-', "\u{2212}");
    }
    let sign = if mantissa.starts_with('-') { "\u{2212}" } else { "" };
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let text = if exponent < 0 {
        format!("0.{}{digits}", "0".repeat((-exponent - 1) as usize))
    } else {
        let whole = exponent as usize + 1;
        let padded = format!("{digits:0<whole$}");
        let (int, frac) = padded.split_at(whole);
        if frac.is_empty() { int.to_string() } else { format!("{int}.{frac}") }
    };
    format!("{sign}{text}")
}
