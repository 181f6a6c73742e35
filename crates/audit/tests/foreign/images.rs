//! Tables in image, texture and array files: those that other tools write, built here byte by byte,
//! and our own.

use crate::foreign_support;
#[allow(dead_code, reason = "the tables are used, the lookups are not")]
#[path = "../../../../tests/emit_support/solid.rs"]
mod solid;

use foreign_support::{dds, dds_extended, exr_of_parts, hdr, ktx2, png, value};
use lobefit::data::{Channel, Container, Table, TexelFormat};
use lobefit::emit;
use lobefit_audit::foreign::{ForeignTable, Hints, RawFormat, Step, read_table};
use lobefit_math::srgb;
use solid::of_all_shapes;

fn one(bytes: &[u8], file: &str, hints: &Hints) -> ForeignTable {
    let mut found = read_table(bytes, file, hints).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(found.len(), 1, "{file}");
    found.remove(0)
}

fn refused(bytes: &[u8], file: &str) -> String {
    let message = read_table(bytes, file, &Hints::default()).expect_err(file).to_string();
    assert!(message.starts_with(file), "{message}");
    message
}

/// Little-endian numbers of a table of `count` texels.
fn texels(format: RawFormat, count: usize, channels: usize) -> Vec<u8> {
    let numbers = (0..count).flat_map(|t| (0..channels).map(move |c| value(t, c)));
    numbers
        .flat_map(|x| match format {
            RawFormat::F16 => half::f16::from_f64(x).to_le_bytes().to_vec(),
            RawFormat::F32 => (x as f32).to_le_bytes().to_vec(),
            RawFormat::F64 => x.to_le_bytes().to_vec(),
            RawFormat::Unorm8 => vec![(x * 255.0).round() as u8],
            RawFormat::Unorm16 => ((x * 65535.0).round() as u16).to_le_bytes().to_vec(),
        })
        .collect()
}

/// Every texel is where it belongs, to the format's rounding.
fn assert_texels(table: &ForeignTable, size: &[usize], order: &str) {
    assert_eq!(table.size, size, "{}", table.what);
    let names: String = table.channels.iter().map(|c| c.name.as_str()).collect();
    let mut sorted: Vec<char> = order.chars().collect();
    sorted.sort_by_key(|c| "RGBA".find(*c));
    assert_eq!(names, sorted.iter().collect::<String>(), "{}", table.what);
    for channel in &table.channels {
        let c = order.find(channel.name.as_str()).unwrap();
        assert_eq!(channel.values.len(), table.texels());
        for (t, found) in channel.values.iter().enumerate() {
            let expected = value(t, c);
            let bound = table.step.rounding(expected) * 1.0001 + 1e-7;
            assert!((found - expected).abs() <= bound, "{} texel {t}: {found}, {expected}", table.what);
        }
    }
}

#[test]
fn our_own_files_read_back_to_the_bit() {
    for table in of_all_shapes() {
        let size = if table.axes.len() == 3 { table.size().to_vec() } else { table.size()[..2].to_vec() };
        let hints = Hints { size: Some(size.clone()), ..Hints::default() };
        let exr = one(&emit::exr::encode(&table, &[]).unwrap(), "t.exr", &hints);
        assert_same(&exr, &table, &size);
        for container in Container::ALL {
            let Some(packed) = emit::container::packed(container, &table).unwrap() else { continue };
            // A raw file alone says nothing of its shape.
            let format = match table.format {
                TexelFormat::Unorm8 => Some(RawFormat::Unorm8),
                TexelFormat::Unorm16 => Some(RawFormat::Unorm16),
                TexelFormat::F16 | TexelFormat::F32 => None,
            };
            let hints = match container {
                Container::Raw => hints.clone(),
                // Integers of an array may be bits, too.
                Container::Npy => Hints { format, ..Hints::default() },
                _ => Hints::default(),
            };
            let found = one(&packed.file(&table), &format!("t.{}", container.name()), &hints);
            assert_eq!(found.size, size);
            for (channel, ours) in found.channels.iter().zip(&table.quantised().channels) {
                let as_f32 = container == Container::Raw;
                assert_eq!(*channel.values, stored(ours, as_f32), "{}", found.what);
            }
        }
    }
}

fn assert_same(found: &ForeignTable, table: &Table, size: &[usize]) {
    assert_eq!(found.size, size);
    let step = if table.format == TexelFormat::F16 { Step::Half } else { Step::None };
    assert_eq!(found.step, step);
    for channel in &table.quantised().channels {
        let same = found.channels.iter().find(|c| c.name == channel.name).expect("the channel");
        assert_eq!(*same.values, stored(channel, true));
    }
}

/// The values of a channel, in a file of singles those nearest to them.
fn stored(channel: &Channel, as_f32: bool) -> Vec<f64> {
    channel.texels.iter().map(|x| if as_f32 { f64::from(*x as f32) } else { *x }).collect()
}

#[test]
fn dds_formats_old_and_new() {
    use RawFormat::{F16, F32, Unorm8, Unorm16};
    let extended = [
        (2, F32, "RGBA"),
        (6, F32, "RGB"),
        (10, F16, "RGBA"),
        (11, Unorm16, "RGBA"),
        (16, F32, "RG"),
        (28, Unorm8, "RGBA"),
        (34, F16, "RG"),
        (35, Unorm16, "RG"),
        (41, F32, "R"),
        (49, Unorm8, "RG"),
        (54, F16, "R"),
        (56, Unorm16, "R"),
        (61, Unorm8, "R"),
        (87, Unorm8, "BGRA"),
    ];
    for (format, kind, order) in extended {
        let bytes = dds_extended(format, [8, 4, 1], 1, &texels(kind, 32, order.len()));
        let table = one(&bytes, "t.dds", &Hints::default());
        assert_texels(&table, &[8, 4], order);
        assert!(!table.what.contains("sRGB"), "{}", table.what);
        let solid = dds_extended(format, [4, 4, 4], 1, &texels(kind, 64, order.len()));
        assert_texels(&one(&solid, "t.dds", &Hints::default()), &[4, 4, 4], order);
        let array = dds_extended(format, [4, 4, 1], 3, &texels(kind, 48, order.len()));
        assert_texels(&one(&array, "t.dds", &Hints::default()), &[4, 4, 3], order);
    }
    let codes = [
        (36u32, Unorm16, "RGBA"),
        (111, F16, "R"),
        (112, F16, "RG"),
        (113, F16, "RGBA"),
        (114, F32, "R"),
        (115, F32, "RG"),
        (116, F32, "RGBA"),
    ];
    for (code, kind, order) in codes {
        let bytes = dds(code.to_le_bytes(), [8, 4, 1], &texels(kind, 32, order.len()));
        assert_texels(&one(&bytes, "t.dds", &Hints::default()), &[8, 4], order);
    }
    assert!(refused(&dds(*b"DXT5", [8, 4, 1], &[0; 32]), "t.dds").contains("format DXT5 is not read"));
    assert!(refused(&dds_extended(98, [8, 4, 1], 1, &[0; 32]), "t.dds").contains("block-compressed"));
    let cut = dds_extended(41, [8, 4, 1], 1, &[0; 100]);
    assert!(refused(&cut, "t.dds").contains("byte 148"), "{}", refused(&cut, "t.dds"));
    assert!(refused(&dds_extended(41, [8, 4, 1], 1, &[0; 132]), "t.dds").contains("4 bytes follow"));
    let four_gigabytes = dds_extended(2, [16384, 16384, 1], 1, &[0; 64]);
    let said = refused(&four_gigabytes, "t.dds");
    assert!(
        said.contains("the limit is 50331648; of so many channels ") && said.contains(" texels are the most"),
        "{said}"
    );
}

/// Floats of 11, 11 and 10 bits of a word, whose lowest bits are red, exactly.
#[test]
fn words_of_three_small_floats() {
    // Halves without the last bits of their mantissa, and so the least number, infinity's neighbour and 1.
    let held = |t: usize, c: usize| {
        let bits = match t {
            0 => [1 << 4, 1 << 4, 1 << 5][c],
            1 => [0x7bf0, 0x7bf0, 0x7be0][c],
            2 => 0x3c00,
            _ => half::f16::from_f64(value(t, c)).to_bits() >> [4, 4, 5][c] << [4, 4, 5][c],
        };
        half::f16::from_bits(bits)
    };
    let word = |t: usize| {
        let [red, green, blue] = [0, 1, 2].map(|c| u32::from(held(t, c).to_bits()));
        (red >> 4) | (green >> 4) << 11 | (blue >> 5) << 22
    };
    let data: Vec<u8> = (0..32).flat_map(|t| word(t).to_le_bytes()).collect();
    for (bytes, file) in [
        (dds_extended(26, [8, 4, 1], 1, &data), "t.dds"),
        (ktx2(122, [8, 4, 0], 0, &data, false), "t.ktx2"),
        (ktx2(122, [8, 4, 0], 0, &data, true), "t.ktx2"),
    ] {
        let table = one(&bytes, file, &Hints::default());
        assert!(table.what.contains("R11G11B10 float, 8 x 4, channels R G B"), "{}", table.what);
        for (c, channel) in table.channels.iter().enumerate() {
            let expected: Vec<f64> = (0..32).map(|t| held(t, c).to_f64()).collect();
            assert_eq!(*channel.values, expected, "{file} {c}");
        }
        let near = [(1.0, 1.0 / 128.0), (0.75, 1.0 / 256.0), (1e-6, 1.0 / 2_097_152.0)];
        near.iter().for_each(|(x, step)| assert_eq!(table.step.rounding(*x), *step, "{x}"));
        let cut = &bytes[..bytes.len() - 9];
        assert!(refused(cut, file).contains("cut short") || refused(cut, file).contains("damaged"));
    }
    let mut endless = data;
    endless[..4].copy_from_slice(&(0x7c00_u32 >> 4).to_le_bytes());
    let said = refused(&dds_extended(26, [8, 4, 1], 1, &endless), "t.dds");
    assert!(said.contains("channel R, texel [0, 0]: inf"), "{said}");
}

/// A copy of a table holds the same values, not others like them.
#[test]
fn copies_of_a_table_share_its_values() {
    let read = one(&png(4, 4, 3, false, &[51; 48], false), "t.png", &Hints::default());
    assert_eq!(*read.channels[2].values, [0.2; 16]);
    assert!(std::ptr::eq(&*read.clone().channels[2].values, &*read.channels[2].values));
}

#[test]
fn ktx2_textures_plain_and_compressed_with_zstandard() {
    use RawFormat::{F16, F32, F64, Unorm8, Unorm16};
    let formats = [
        (9, Unorm8, "R"),
        (37, Unorm8, "RGBA"),
        (44, Unorm8, "BGRA"),
        (70, Unorm16, "R"),
        (76, F16, "R"),
        (83, F16, "RG"),
        (97, F16, "RGBA"),
        (100, F32, "R"),
        (103, F32, "RG"),
        (112, F64, "R"),
    ];
    for (format, kind, order) in formats {
        for packed in [false, true] {
            for (sides, layers) in [([8, 4, 0], 0), ([4, 4, 3], 0), ([4, 4, 0], 3)] {
                let size: Vec<usize> = [sides[0], sides[1], sides[2].max(layers)]
                    .into_iter()
                    .filter(|n| *n > 0)
                    .map(|n| n as usize)
                    .collect();
                let data = texels(kind, size.iter().product(), order.len());
                let table = one(&ktx2(format, sides, layers, &data, packed), "t.ktx2", &Hints::default());
                assert_texels(&table, &size, order);
                assert_eq!(table.what.contains("Zstandard"), packed, "{}", table.what);
            }
        }
    }
    let good = ktx2(83, [8, 8, 0], 0, &texels(F16, 64, 2), true);
    let mut scheme = good.clone();
    scheme[44] = 1;
    assert!(refused(&scheme, "t.ktx2").contains("BasisLZ"));
    let mut bc7 = good.clone();
    bc7[12..16].copy_from_slice(&145u32.to_le_bytes());
    assert!(refused(&bc7, "t.ktx2").contains("block-compressed"));
    let mut huge = good.clone();
    huge[20..28].copy_from_slice(&[0xff; 8]);
    assert!(refused(&huge, "t.ktx2").contains("the limit is"));
    let mut wide = good.clone();
    wide[20..24].copy_from_slice(&2000u32.to_le_bytes());
    assert!(
        refused(&wide, "t.ktx2").contains("have 64000") || refused(&wide, "t.ktx2").contains("cannot hold")
    );
    assert!(refused(&good[..good.len() - 9], "t.ktx2").contains("cut short"));
}

/// A texture unit decodes what the format calls sRGB.
#[test]
fn colours_of_formats_of_srgb_are_decoded() {
    for (linear, marked, order) in [(28, 29, "RGBA"), (87, 91, "BGRA")] {
        let data = texels(RawFormat::Unorm8, 32, 4);
        let read = |format| one(&dds_extended(format, [8, 4, 1], 1, &data), "t.dds", &Hints::default());
        let (linear, marked) = (read(linear), read(marked));
        assert!(marked.what.contains("decoded from sRGB"), "{order}: {}", marked.what);
        assert_eq!((linear.step, marked.step), (Step::Unorm(8), Step::Srgb(255)));
        for (stored, own) in linear.channels.iter().zip(&marked.channels) {
            let of = |x: &f64| if stored.name == "A" { *x } else { srgb::decoded(*x) };
            assert_eq!(own.values.to_vec(), stored.values.iter().map(of).collect::<Vec<f64>>());
        }
    }
}

#[test]
fn png_values_are_those_stored() {
    for (sixteen, kind) in [(false, RawFormat::Unorm8), (true, RawFormat::Unorm16)] {
        for order in ["R", "RA", "RGB", "RGBA"] {
            let mut data = texels(kind, 32, order.len());
            if sixteen {
                data.chunks_mut(2).for_each(|pair| pair.reverse());
            }
            let table = one(&png(8, 4, order.len(), sixteen, &data, false), "t.png", &Hints::default());
            assert_texels(&table, &[8, 4], order);
            let marked = one(&png(8, 4, order.len(), sixteen, &data, true), "t.png", &Hints::default());
            assert!(marked.what.contains("sRGB (values as stored)"), "{}", marked.what);
            assert_eq!(marked.channels, table.channels);
        }
    }
    let good = png(8, 4, 1, false, &texels(RawFormat::Unorm8, 32, 1), false);
    // The last chunk has 12 bytes, and the one before begins at byte 33 with a head of 8.
    let cut = refused(&good[..good.len() - 20], "t.png");
    assert!(cut.contains("cut short") && cut.contains("byte 41: chunk IDAT"), "{cut}");
    assert!(cut.contains(&format!(", {} are left", good.len() - 61)), "{cut}");
    assert!(refused(b"GIF89a\0\0\0\0", "t.png").contains("damaged or misnamed"));
}

#[test]
fn exr_layers_and_channels_of_any_name() {
    let bytes = exr_of_parts(&[("dfg", &["A", "B"]), ("cloth", &["E.x", "E.y", "N.x"])]);
    let tables = read_table(&bytes, "t.exr", &Hints::default()).unwrap();
    let names: Vec<&str> = tables.iter().map(|t| t.name.as_str()).collect();
    assert_eq!(names, ["dfg", "cloth"]);
    assert!(tables[0].what.contains("EXR, single, 6 x 4, channels A B"), "{}", tables[0].what);
    let layer = |name: &str| Hints { layer: Some(name.into()), ..Hints::default() };
    assert_eq!(one(&bytes, "t.exr", &layer("dfg")), tables[0]);
    let inside = one(&bytes, "t.exr", &layer("E"));
    assert_eq!((inside.name.as_str(), inside.channels[1].name.as_str()), ("E", "y"));
    assert_eq!(inside.channels[1].values, tables[1].channels[1].values);
    let message = read_table(&bytes, "t.exr", &layer("sheen")).unwrap_err().to_string();
    assert!(message.contains("layer sheen is not there; the file has dfg, cloth, E, N"), "{message}");
}

#[test]
fn an_atlas_is_cut_into_slices_where_the_caller_names_three_axes() {
    let bytes = exr_of_parts(&[("a", &["R"])]);
    let whole = one(&bytes, "t.exr", &Hints::default());
    let of = |size: &[usize]| {
        read_table(&bytes, "t.exr", &Hints { size: Some(size.to_vec()), ..Hints::default() })
    };
    let tiles = of(&[3, 2, 4]).unwrap().remove(0);
    let at = |x: usize, y: usize| whole.channels[0].values[y * 6 + x];
    for (z, (left, top)) in [(0, 0), (3, 0), (0, 2), (3, 2)].into_iter().enumerate() {
        for (y, x) in (0..2).flat_map(|y| (0..3).map(move |x| (y, x))) {
            assert_eq!(tiles.channels[0].values[z * 6 + y * 3 + x], at(left + x, top + y));
        }
    }
    assert_eq!(
        of(&[6, 2, 2]).unwrap()[0].channels[0].values,
        whole.channels[0].values,
        "slices below one another"
    );
    assert!(of(&[4, 3, 2]).unwrap_err().to_string().contains("no tiles of 4 x 3 x 2"));
    assert!(of(&[6, 5]).unwrap_err().to_string().contains("24 values, which are 6 x 4 texels, not 6 x 5"));
    assert!(of(&[]).unwrap_err().to_string().contains("a size has one to three axes"));
}

#[test]
fn texels_that_are_no_numbers_are_named() {
    let mut data = texels(RawFormat::F32, 32, 2);
    data[8 * 13 + 4..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    data[8 * 20..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    data[8 * 21..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let error = read_table(&dds_extended(16, [8, 4, 1], 1, &data), "t.dds", &Hints::default()).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("channel R, texel [4, 2]: inf") && message.contains("nor are 2 others of 64"),
        "{message}"
    );
}

#[test]
fn arrays_of_numpy_state_what_is_not_read() {
    let npy = |dictionary: &str, data: &[u8]| {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((dictionary.len() as u16).to_le_bytes());
        [&bytes, dictionary.as_bytes(), data].concat()
    };
    let dictionary = |kind: &str, order: &str, shape: &str| {
        format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape}, }}\n")
    };
    let data = texels(RawFormat::F64, 32, 1);
    let table = one(&npy(&dictionary("<f8", "False", "(4, 8)"), &data), "t.npy", &Hints::default());
    assert_eq!((table.size.as_slice(), table.channels[0].values[9]), (&[8, 4][..], value(9, 0)));
    // In Fortran's order the first index runs fastest: texel 9 is at row 1 and column 1.
    let table = one(&npy(&dictionary("<f8", "True", "(4, 8)"), &data), "t.npy", &Hints::default());
    assert_eq!((table.size.as_slice(), table.channels[0].values[9]), (&[8, 4][..], value(5, 0)));
    // A short index is that of the channel, the last or the first.
    let planar = npy(&dictionary("<f8", "False", "(2, 6, 5)"), &texels(RawFormat::F64, 60, 1));
    let table = one(&planar, "t.npy", &Hints::default());
    assert_eq!((table.size.as_slice(), table.channels.len()), (&[5, 6][..], 2));
    assert_eq!([0, 1].map(|c: usize| table.channels[c].values[7]), [value(7, 0), value(37, 0)]);
    let slice = Hints { layer: Some("1".into()), ..Hints::default() };
    let table = one(&planar, "t.npy", &slice);
    assert_eq!((table.size.as_slice(), table.channels[0].values[7]), (&[5, 6][..], value(37, 0)));
    let stated = Hints { channels: Some(2), format: Some(RawFormat::F64), ..Hints::default() };
    assert_eq!(one(&planar, "t.npy", &stated).channels.len(), 2);
    let small = npy(&dictionary("<f8", "False", "(4, 4, 2)"), &data);
    let table = one(&small, "t.npy", &Hints::default());
    assert_eq!((table.size.as_slice(), table.channels[1].values[1]), (&[4, 4][..], value(3, 0)));
    let cases = [
        (dictionary(">f8", "False", "(4, 8)"), "little-endian"),
        (dictionary("<f8", "False", "(4, 9)"), "256 bytes follow, and an array of 4 x 9 <f8 has 288"),
        (
            dictionary("<f8", "False", "(4294967296, 4294967296, 4294967296)"),
            "256 bytes follow, and an array of ",
        ),
        (dictionary("<f8", "False", "(4, -8)"), "shape"),
        (dictionary("|u1", "False", "(256,)"), "unorm8"),
        ("{}".to_string(), "no descr"),
    ];
    for (text, part) in cases {
        let message = refused(&npy(&text, &data), "t.npy");
        assert!(message.contains(part), "{message}");
    }
    // A size that contradicts the array's own is refused; its own, slices one below the other and a
    // flat list are not.
    let sized = |shape: &str, size: &[usize]| {
        let hints = Hints { size: Some(size.to_vec()), ..Hints::default() };
        read_table(&npy(&dictionary("<f8", "False", shape), &data), "t.npy", &hints)
    };
    for (shape, size) in
        [("(4, 8)", &[8, 4][..]), ("(4, 8)", &[8, 2, 2]), ("(32,)", &[4, 8]), ("(8, 4)", &[4, 8])]
    {
        let table = sized(shape, size).unwrap().remove(0);
        assert_eq!((table.size.as_slice(), table.channels[0].values[9]), (size, value(9, 0)));
    }
    for (shape, size) in [("(4, 8)", &[4, 8][..]), ("(4, 8)", &[16, 2]), ("(4, 8)", &[4, 4, 2])] {
        let message = sized(shape, size).unwrap_err().to_string();
        assert!(
            message.starts_with("t.npy: 32 values, which the array's own shape (4, 8) lays out"),
            "{message}"
        );
        assert!(message.contains("8 x 4 texels (x first): --size"), "{message}");
    }
}

#[test]
fn an_image_that_is_cut_short_tells_where_and_what_was_read() {
    let bytes = exr_of_parts(&[("a", &["R"])]);
    let length = bytes.len();
    for (kept, told) in
        [(length - 5, "its 6 x 4 texels of 1 channels"), (60, "the header and the list"), (5, "the header")]
    {
        let message = refused(&bytes[..kept], "t.exr");
        assert!(message.contains(&format!("the file ends after {kept} bytes")), "{message}");
        assert!(message.contains(told) && message.contains(&format!("byte {kept}: ")), "{message}");
    }
}

#[test]
fn radiance_files_are_mantissas_times_a_power_of_two() {
    let size = [12, 5];
    let texels: Vec<[u8; 3]> = (0..60_u8).map(|t| [2 + t, 3 * t, 250 - t]).collect();
    for runs in [true, false] {
        let found = one(&hdr(size, &texels, runs), "t.hdr", &Hints::default());
        assert_eq!((found.size.clone(), found.step), (size.to_vec(), Step::Rgbe));
        for (c, channel) in found.channels.iter().enumerate() {
            assert_eq!(channel.name, ["R", "G", "B"][c]);
            let wanted: Vec<f64> = texels.iter().map(|t| f64::from(t[c]) / 256.0 / 2.0).collect();
            assert_eq!(*channel.values, wanted, "runs: {runs}");
        }
    }
    let whole = hdr(size, &texels, true);
    let cut = refused(&whole[..whole.len() - 3], "t.hdr");
    assert!(cut.contains("cut short"), "{cut}");
    let turned = String::from_utf8_lossy(&whole).replace("-Y 5", "+Y 5").into_bytes();
    assert!(refused(&turned, "t.hdr").contains("-Y +X"));
}

#[test]
fn channels_of_an_exr_file_are_in_the_order_of_their_names() {
    let names = |channels: &[&str]| -> Vec<String> {
        let found = one(&exr_of_parts(&[("a", channels)]), "t.exr", &Hints::default());
        found.channels.into_iter().map(|c| c.name).collect()
    };
    assert_eq!(names(&["A", "B", "G", "R"]), ["R", "G", "B", "A"]);
    assert_eq!(names(&["A", "B"]), ["A", "B"], "scale and bias");
    let layers = ["dfg.A", "dfg.B", "env.B", "env.G", "env.R"];
    assert_eq!(names(&layers), ["dfg.A", "dfg.B", "env.R", "env.G", "env.B"], "each layer by itself");
    assert_eq!(names(&["B", "G", "x.E"]), ["B", "G", "x.E"], "other names stay as they lie");
}
