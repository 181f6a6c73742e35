//! Array literals of program texts, and raw numbers, as tables.

use lobefit_audit::foreign::{ForeignTable, Hints, RawFormat, Step, read_table};

/// x + 100 y (+ 10000 c), so that every texel tells where it belongs.
fn number(x: usize, y: usize, c: usize) -> f64 {
    (x + 100 * y + 10_000 * c) as f64 / 100_000.0
}

fn tables(text: &str, file: &str, hints: &Hints) -> Vec<ForeignTable> {
    read_table(text.as_bytes(), file, hints).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn one(text: &str, file: &str) -> ForeignTable {
    let mut found = tables(text, file, &Hints::default());
    assert_eq!(found.len(), 1, "{text}");
    found.remove(0)
}

fn refused(text: &str, hints: &Hints) -> String {
    read_table(text.as_bytes(), "t.h", hints).expect_err(text).to_string()
}

/// Rows of `columns` texels printed with `texel`.
fn rows(
    columns: usize,
    rows: usize,
    open: &str,
    close: &str,
    texel: impl Fn(usize, usize) -> String,
) -> String {
    let row = |y| (0..columns).map(|x| texel(x, y)).collect::<Vec<_>>().join(", ");
    (0..rows).map(|y| format!("{open}{}{close}", row(y))).collect::<Vec<_>>().join(",\n")
}

fn assert_grid(table: &ForeignTable, columns: usize, rows: usize, channels: usize) {
    assert_eq!(table.size, [columns, rows], "{}", table.what);
    assert_eq!(table.channels.len(), channels, "{}", table.what);
    for (c, channel) in table.channels.iter().enumerate() {
        for (i, value) in channel.values.iter().enumerate() {
            assert_eq!(*value, number(i % columns, i / columns, c), "{}", table.what);
        }
    }
}

#[test]
fn nested_brackets_of_every_language_are_rows_and_channels() {
    let scalar = |suffix: &'static str| move |x, y| format!("{}{suffix}", number(x, y, 0));
    let pair = |name: &'static str| move |x, y| format!("{name}({}, {})", number(x, y, 0), number(x, y, 1));
    let braces = rows(10, 9, "{", "}", scalar("f"));
    let brackets = rows(10, 9, "[", "]", scalar("_f32"));
    let cases = [
        (format!("// a table\nstatic const float e[9][10] = {{\n{braces}\n}};"), "t.h", 1),
        (format!("pub static E: [[f32; 10]; 9] = [\n{brackets},\n];"), "t.rs", 1),
        (format!("export const E = [\n{}\n];", rows(10, 9, "[", "]", scalar(""))), "t.ts", 1),
        (format!("E = np.array([\n{}])", rows(10, 9, "[", "]", scalar(""))), "t.py", 1),
        (format!("{{ \"E\": [{}] }}", rows(10, 9, "[", "]", scalar(""))), "t.json", 1),
        (format!("[{}]", rows(10, 9, "[", "]", scalar(""))), "t.json", 1),
        (
            format!("static const float2 e[9][10] = {{ {} }};", rows(10, 9, "{", "}", pair("float2"))),
            "t.hlsl",
            2,
        ),
        (
            format!(
                "const e = array<array<vec2<f32>, 10>, 9>({});",
                rows(10, 9, "array<vec2<f32>, 10>(", ")", pair("vec2<f32>"))
            ),
            "t.wgsl",
            2,
        ),
        (
            format!("const vec2 e[9][10] = vec2[9][10]({});", rows(10, 9, "vec2[10](", ")", pair("vec2"))),
            "t.glsl",
            2,
        ),
        (format!("const E: [[Vec2; 10]; 9] = [{}];", rows(10, 9, "[", "]", pair("Vec2::new"))), "t.rs", 2),
        (
            format!("const float e[9][10][2] = {{ {} }};", rows(10, 9, "{", "}", pair("")))
                .replace('(', "{")
                .replace(')', "}"),
            "t.c",
            2,
        ),
    ];
    for (text, file, channels) in cases {
        assert_grid(&one(&text, file), 10, 9, channels);
    }
}

#[test]
fn declared_sizes_hold_for_flat_lists() {
    let flat = |c: &'static str| rows(10, 9, "", "", move |x, y| format!("{}{c}", number(x, y, 0)));
    assert_grid(&one(&format!("float e[9][10] = {{ {} }};", flat("f")), "t.c"), 10, 9, 1);
    let table = one(&format!("float e[9][10] = {{ {} }};", flat("f")), "t.c");
    assert_eq!((table.name.as_str(), table.step), ("e", Step::Decimals(5)));
    assert!(table.what.contains("10 x 9"), "{}", table.what);
    let message = refused(&format!("float e[9][11] = {{ {} }};", flat("f")), &Hints::default());
    assert!(message.contains("declared as 9 x 11 and holds 90"), "{message}");
}

#[test]
fn a_flat_list_is_a_square_where_nothing_else_fits() {
    let list = |n: usize| (0..n).map(|i| format!("{}", i as f64 / 1e4)).collect::<Vec<_>>().join(", ");
    assert_eq!(one(&format!("static const float t[1024] = {{{}}};", list(1024)), "t.h").size, [32, 32]);
    assert_eq!(one(&format!("float avg[32] = {{{}}};", list(32)), "t.h").size, [32]);
    assert_eq!(one(&list(289), "t.inc").size, [17, 17], "a list without a declaration");
    let message = refused(&list(4096), &Hints::default());
    assert!(message.contains("64 x 64 or 16 x 16 x 16"), "{message}");
    let cube = Hints { size: Some(vec![16, 16, 16]), ..Hints::default() };
    assert_eq!(tables(&list(4096), "t.h", &cube)[0].size, [16, 16, 16]);
    // Four channels that lie together make a jagged square.
    let texel = |i: usize| format!("{}, {}, 0, 1", i as f64 / 1e4, 0.5 - i as f64 / 1e4);
    let four = (0..256).map(texel).collect::<Vec<_>>().join(", ");
    let message = refused(&four, &Hints::default());
    assert!(message.contains("32 x 32 or 16 x 16 of 4 channels"), "{message}");
    let four = tables(&four, "t.h", &Hints { channels: Some(4), ..Hints::default() }).remove(0);
    assert_eq!((four.size.as_slice(), four.channels[1].values[3]), (&[16, 16][..], 0.4997));
    let wrong = Hints { size: Some(vec![16, 15]), ..Hints::default() };
    let message = refused(&list(4096), &wrong);
    assert!(message.contains("4096 values") && message.contains("16 x 15"), "{message}");
    assert!(refused(&list(331), &Hints::default()).contains("state the size"));
}

#[test]
fn hexadecimal_halves_are_recognised_and_rows_of_the_text_tell_the_size() {
    let half = |x: f64| format!("0x{:04x}", half::f16::from_f64(x).to_bits());
    let texel = |x: usize, y: usize| format!("{}, {}", half(x as f64 / 16.0), half(y as f64 / 32.0));
    let text = format!("const DATA = new Uint16Array( [\n{}\n] );", rows(16, 16, "", "", texel));
    let table = one(&text, "t.js");
    assert_eq!((table.size.as_slice(), table.channels.len(), table.step), (&[16, 16][..], 2, Step::Half));
    assert_eq!(table.channels[0].values[17], 1.0 / 16.0);
    assert_eq!(table.channels[1].values[17], 1.0 / 32.0);
    assert_eq!(table.name, "DATA");
    let message = refused(&text.replace('\n', " "), &Hints::default());
    assert!(message.contains("16 x 16 of 2 channels or 8 x 8 x 8"), "{message}");
    let pairs = Hints { channels: Some(2), ..Hints::default() };
    assert_eq!(tables(&text.replace('\n', " "), "t.js", &pairs)[0], table);
}

#[test]
fn integers_need_a_format() {
    let text = (0..64).map(|i| (i * 1000).to_string()).collect::<Vec<_>>().join(", ");
    let size = Some(vec![8, 8]);
    let message = refused(&text, &Hints { size: size.clone(), ..Hints::default() });
    assert!(message.contains("1:1") && message.contains("unorm16"), "{message}");
    let unorm = Hints { size: size.clone(), format: Some(RawFormat::Unorm16), ..Hints::default() };
    let table = &tables(&text, "t.h", &unorm)[0];
    assert_eq!((table.channels[0].values[2], table.step), (2000.0 / 65535.0, Step::Unorm(16)));
    let bytes = Hints { size, format: Some(RawFormat::Unorm8), ..Hints::default() };
    assert!(refused(&text, &bytes).contains("63000 are no unorm8"));
}

#[test]
fn the_caller_picks_among_several_by_name() {
    let list = |n: usize, x: f64| vec![x.to_string(); n].join(",");
    let text = format!(
        "float a[16] = {{{}}}, b[400] = {{{}}};\nvoid f(float x) {{ float c[] = {{{}}}; return g(x, vec2(1.0, 2.0)); }}",
        list(16, 0.25),
        list(400, 0.5).as_str(),
        list(32, 0.75)
    );
    let found = tables(&text, "t.c", &Hints::default());
    let names: Vec<&str> = found.iter().map(|t| t.name.as_str()).collect();
    assert_eq!(names, ["a", "b", "c"]);
    let named = |name: &str| Hints { symbol: Some(name.into()), ..Hints::default() };
    assert_eq!(tables(&text, "t.c", &named("b")), [found[1].clone()]);
    let message = refused(&text, &named("d"));
    assert!(message.contains("array d is not there; the file has a, b, c"), "{message}");
}

#[test]
fn bad_lists_are_named_with_their_place() {
    let cases = [
        ("", "empty"),
        ("float t[] = {};", "no array"),
        ("int n = 3;", "no array"),
        ("float t[3][4] = {{1.5,2,3,4},\n{1,2,3},{1,2,3,4}};", "t.h:"),
        ("float t[9] = {0.5,1,2,3,4,5,6,7", "1:14"),
        (
            "float t[9] = {0.5,1,2,NaN,4,5,6,7,-INFINITY};",
            "NaN is not a finite number, nor is 1 other of 9 values",
        ),
        (
            "float t[9] = {0.5,1,2,1e999,4,5,6,7,8};",
            "texel [3]: inf is not a finite number, the only one of 9 values",
        ),
    ];
    for (text, part) in cases {
        let message = refused(text, &Hints::default());
        assert!(message.starts_with("t.h") && message.contains(part), "{text}: {message}");
    }
    let two_lobes = refused("float t[3][4] = {{1.5,2,3,4},\n{1,2,3},{1,2,3,4}};", &Hints::default());
    assert!(
        two_lobes.contains("2:7") && two_lobes.contains("bracket of 3") && two_lobes.contains("bracket of 4"),
        "{two_lobes}"
    );
    let deep = "{".repeat(100_000);
    assert!(refused(&deep, &Hints::default()).contains("the limit is 64"));
}

#[test]
fn raw_numbers_take_their_size_from_the_length_or_the_caller() {
    let bytes: Vec<u8> = (0..1024u32).flat_map(|i| (i as f32 / 1024.0).to_le_bytes()).collect();
    let read = |bytes: &[u8], hints: &Hints| read_table(bytes, "lut.bin", hints);
    let table = &read(&bytes, &Hints::default()).unwrap()[0];
    assert_eq!((table.size.as_slice(), table.step), (&[32, 32][..], Step::None));
    assert_eq!(table.channels[0].values[33], 33.0 / 1024.0);
    let pairs = Hints { size: Some(vec![32, 16]), ..Hints::default() };
    let table = &read(&bytes, &pairs).unwrap()[0];
    assert_eq!((table.size.as_slice(), table.channels.len()), (&[32, 16][..], 2));
    assert_eq!(table.channels[1].values[1], 3.0 / 1024.0);
    let cut = read(&bytes[..4095], &Hints::default()).unwrap_err();
    assert!(cut.to_string().contains("byte 4092"), "{cut}");
    let huge = Hints { size: Some(vec![1 << 40, 1 << 40, 1 << 40]), ..Hints::default() };
    assert!(read(&bytes, &huge).unwrap_err().to_string().contains("the limit is"));
    // Pairs of halves are singles as well; whoever says which, or names the file so, has them read.
    let halves: Vec<u8> =
        (0..1024u32).flat_map(|i| half::f16::from_f64(f64::from(i) / 1024.0).to_le_bytes()).collect();
    let asked = read(&halves, &Hints::default()).unwrap_err().to_string();
    assert!(asked.contains("halves of 0 to 2 as well as singles") && asked.contains("f16 or f32"), "{asked}");
    for (name, format) in [("lut.bin", Some(RawFormat::F16)), ("lut.f16", None)] {
        let table = &read_table(&halves, name, &Hints { format, ..Hints::default() }).unwrap()[0];
        assert_eq!((table.step, table.channels[0].values[33]), (Step::Half, 33.0 / 1024.0));
    }
    let mut bad = bytes.clone();
    bad[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(read(&bad, &Hints::default()).unwrap_err().to_string().contains("the only one of"));
}

#[test]
fn declared_sizes_that_are_not_those_of_the_rows_are_refused() {
    let nested = |rows_of: usize| rows(rows_of, 16, "{", "}", |x, y| format!("{}f", number(x, y, 0)));
    let message = refused(&format!("float E[16][16] = {{ {} }};", nested(12)), &Hints::default());
    assert!(message.contains("declared as 16 x 16 and holds 192"), "{message}");
    assert_grid(&one(&format!("float E[16][12] = {{ {} }};", nested(12)), "t.c"), 12, 16, 1);
}

#[test]
fn numbers_of_every_language_and_no_others() {
    use RawFormat::{F16, F32, Unorm16};
    let of = |n: f64| n / 65535.0;
    for (number, format, value, step) in [
        ("0.5f", None, 0.5, Step::Decimals(1)),
        ("1.", None, 1.0, Step::Decimals(0)),
        (".25F", None, 0.25, Step::Decimals(2)),
        ("1e-3", None, 0.001, Step::Decimals(3)),
        ("2.5e2h", None, 250.0, Step::Decimals(0)),
        ("0.125_f32", None, 0.125, Step::Decimals(3)),
        ("4lf", None, 4.0, Step::Decimals(0)),
        ("1.5f16", None, 1.5, Step::Decimals(1)),
        ("1_0.0", None, 10.0, Step::Decimals(1)),
        ("3", Some(Unorm16), of(3.0), Step::Unorm(16)),
        ("1_000", Some(Unorm16), of(1000.0), Step::Unorm(16)),
        ("7u", Some(Unorm16), of(7.0), Step::Unorm(16)),
        ("9n", Some(Unorm16), of(9.0), Step::Unorm(16)),
        ("0x3c00", Some(Unorm16), of(15360.0), Step::Unorm(16)),
        ("0x3c00", None, 1.0, Step::Half),
        ("15360", Some(F16), 1.0, Step::Half),
        ("0x3f80_0000u32", Some(F32), 1.0, Step::None),
    ] {
        let text = format!("const T = [{}];", [number; 9].join(", "));
        let table = &tables(&text, "t.c", &Hints { size: Some(vec![9]), format, ..Hints::default() })[0];
        assert_eq!((table.channels[0].values.as_slice(), table.step), (&[value; 9][..], step), "{number}");
    }
    let list = "const T = [0.5, 1, 2, /* 1 */ 3, 4, 5, // 3\n6, 7, 8];";
    let expected = [0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    let text = format!("#define N \\\n 32\n{list}\n'6'; \"4 \\\" 5\"; #include <7>");
    let hints = Hints { size: Some(vec![9]), ..Hints::default() };
    assert_eq!(*tables(&text, "t.c", &hints)[0].channels[0].values, expected);
    for none in ["1abc", "0xzz", "1\u{e9}"] {
        assert!(refused(&list.replace("0.5", none), &hints).contains("no array"), "{none}");
    }
    // Whatever a text breaks off in, it ends there: after a list, and within one.
    for cut in ["\"", "'", "/*", "//", "#", "0x", "1e", "1e+", ".", "`", "\\", "#[", "\u{e9}", "1\u{e9}"] {
        for file in ["t.rs", "t.c"] {
            assert_eq!(
                *tables(&format!("{list} {cut}"), file, &hints)[0].channels[0].values,
                expected,
                "{cut}"
            );
            for open in [cut.to_string(), list.replace("];", cut)] {
                let error = read_table(open.as_bytes(), file, &hints).expect_err(&open).to_string();
                assert!(error.starts_with(file), "{open}: {error}");
            }
        }
    }
}

#[test]
fn names_and_sizes_of_declarations_of_every_language() {
    for (text, name, declared) in [
        ("static const float table_E[9] = ", "table_E", "9"),
        ("constexpr float t[3][3]", "t", "3 x 3"),
        ("const half rows[N] = ", "rows", ""),
        ("std::array<std::array<float, 9>, 1> t = ", "t", ""),
        ("export const DATA: number[] = ", "DATA", ""),
        ("const DATA = new Float32Array(", "DATA", ""),
        ("pub static LUT: [f32; 9] = ", "LUT", ""),
        ("const lut: array<f32, 9> = array<f32, 9>", "lut", ""),
        ("const float[9] lut = float[9]", "lut", ""),
        ("E: ", "E", ""),
        ("lut = np.array(", "lut", ""),
        ("module.exports.dfg = ", "dfg", ""),
        ("__device__ __constant__ float e[9]", "e", "9"),
        ("alignas(16) static const float q[9] = ", "q", "9"),
        ("", "", ""),
    ] {
        let open = if text.ends_with('(') { ")" } else { "" };
        let of = |more: &str| format!("{text}[0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5{more}]{open};");
        let hints = |n| Hints { size: Some(vec![n]), ..Hints::default() };
        assert_eq!(tables(&of(""), "t.cpp", &hints(9))[0].name, name, "{text}");
        // A number more than the declaration has; where it states no size that is read, any number will do.
        match read_table(of(", 9.5").as_bytes(), "t.cpp", &hints(10)) {
            Ok(found) => assert!(declared.is_empty() && found[0].size == [10], "{text}"),
            Err(e) => assert!(
                e.to_string().contains(&format!("{name} is declared as {declared} and holds 10 numbers")),
                "{text}: {e}"
            ),
        }
    }
}

#[test]
fn raw_numbers_are_little_endian() {
    for (format, bytes, value) in [
        (RawFormat::F16, &[0x00, 0x38][..], 0.5),
        (RawFormat::F32, &[0, 0, 0x80, 0x3f], 1.0),
        (RawFormat::F64, &[0, 0, 0, 0, 0, 0, 0xf4, 0x3f], 1.25),
        (RawFormat::Unorm8, &[51], 0.2),
        (RawFormat::Unorm16, &[0xff, 0], 255.0 / 65535.0),
    ] {
        let hints = Hints { size: Some(vec![9]), format: Some(format), ..Hints::default() };
        let read = |bytes: &[u8]| read_table(bytes, "lut.bin", &hints);
        assert_eq!(*read(&bytes.repeat(9)).unwrap()[0].channels[0].values, [value; 9], "{format:?}");
        // A byte after the last number.
        let more = read(&[bytes.repeat(9), vec![9]].concat()).unwrap_err().to_string();
        assert!(more.starts_with("lut.bin"), "{more}");
        assert!(bytes.len() == 1 || more.contains(&format!("byte {}", 9 * bytes.len())), "{more}");
    }
}

#[test]
fn steps_are_half_the_distance_of_neighbours() {
    assert_eq!(Step::Half.rounding(1.0), 0.5 / 1024.0);
    assert_eq!(Step::Half.rounding(-0.75), 0.5 / 2048.0);
    assert_eq!(Step::Half.rounding(0.0), 0.5 / 16_777_216.0);
    assert_eq!(Step::Half.rounding(65504.0), 16.0, "the largest half");
    assert!((Step::Decimals(3).rounding(7.0) - 5e-4).abs() < 1e-18);
    assert_eq!(Step::Unorm(8).rounding(0.3), 0.5 / 255.0);
}
