//! The tables' files in the hands of others: every container holds every texel, at its place, with
//! the meaning beside it. OpenEXR reads the EXR, numpy the NPY and the raw file, ddsfile and ktx2
//! (Bevy's readers) the DDS and the KTX 2 file.

use crate::emit_support;

use std::fs;
use std::path::{Path, PathBuf};

use ddsfile::{D3D10ResourceDimension, Dds, DxgiFormat};
use emit_support::programs::{READ_EXR, python};
use emit_support::say;
use emit_support::solid::{certificate, of_all_shapes, texel};
use half::f16;
use ktx2::dfd::{Basic, Block};
use ktx2::{Format, Reader, TransferFunction};
use lobefit::data::{Channel, Container, Decode, Table, TexelFormat};
use lobefit::emit::container::{ContainerError, Described, encode};
use lobefit::emit::{exr, header};
use serde_json::Value;

/// The files of a table, written to a folder; the path of the table itself.
fn write(container: Container, table: &Table, folder: &Path) -> PathBuf {
    let lines = header::table_lines(table, Decode::Loss, &certificate());
    let certificate = certificate();
    let described = Described { table, decode: Decode::Loss, certificate: &certificate, header: &lines };
    for file in encode(container, &described).expect("encodes") {
        fs::write(folder.join(format!("{}.{}", table.name, file.extension)), file.bytes).unwrap();
    }
    folder.join(format!("{}.{}", table.name, container.name()))
}

/// What a table holds at a place, independently of how it keeps its texels.
fn expected(table: &Table, channel: usize, place: [usize; 3]) -> f64 {
    let exact = texel(channel, place);
    match table.format {
        TexelFormat::Unorm8 => (exact * 255.0).round() / 255.0,
        TexelFormat::Unorm16 => (exact * 65535.0).round() / 65535.0,
        TexelFormat::F16 => f16::from_f64(exact).to_f64(),
        TexelFormat::F32 => f64::from(exact as f32),
    }
}

/// Compares every channel at every place with what a reader found there.
fn compare(what: &str, table: &Table, found: impl Fn(usize, [usize; 3]) -> f64) {
    let [columns, rows, slices] = table.size();
    for z in 0..slices {
        for y in 0..rows {
            for x in 0..columns {
                for c in 0..table.channels.len() {
                    let (mut expected, found) = (expected(table, c, [x, y, z]), found(c, [x, y, z]));
                    if ["exr", "raw"].contains(&what) {
                        expected = f64::from(expected as f32);
                    }
                    assert!(expected == found, "{what} {}, channel {c} at {x} {y} {z}: {found}", table.name);
                }
            }
        }
    }
}

#[test]
fn openexr_finds_the_slices_one_below_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let tables = of_all_shapes();
    for table in &tables {
        let path = write(Container::Exr, table, folder.path());
        let Some(read) = python(READ_EXR, &path) else { return };
        let [columns, rows, slices] = table.size();
        let kind = if table.format == TexelFormat::F16 { "float16" } else { "float32" };
        let channels: Vec<Vec<Vec<f64>>> = table
            .channels
            .iter()
            .map(|channel| {
                let found = &read["channels"][&channel.name];
                assert_eq!(found["type"], kind);
                let image: Vec<Vec<f64>> = serde_json::from_value(found["rows"].clone()).unwrap();
                assert_eq!((image.len(), image[0].len()), (rows * slices, columns), "{}", table.name);
                image
            })
            .collect();
        assert_eq!(read["channels"].as_object().unwrap().len(), table.channels.len());
        compare("exr", table, |c, [x, y, z]| channels[c][z * rows + y][x]);
        let said = read["lobefit"].as_str().unwrap();
        let stacked = "an EXR holds the slices one below the other: slice z is rows 4 z to 4 z + 3 of 12";
        assert_eq!(said.contains(stacked), slices > 1, "{said}");
        assert_eq!(
            said.contains("slices (z): ior in [1, 2], 3 texels, centre registration"),
            slices > 1,
            "{said}"
        );
    }
    say(&format!("openexr: {} tables, every texel at its place", tables.len()));
}

#[test]
fn our_own_reader_finds_the_same_image() {
    for table in of_all_shapes() {
        let decoded = exr::decode(&exr::encode(&table, &[]).expect("encodes")).expect("decodes");
        let [columns, rows, slices] = table.size();
        assert_eq!((decoded.width, decoded.height), (columns, rows * slices));
        for channel in table.quantised().channels {
            let found = decoded.channels.iter().find(|c| c.name == channel.name).expect("the channel");
            let stored = channel.texels.iter().map(|x| f64::from(*x as f32)).collect::<Vec<_>>();
            assert_eq!(found.texels, stored);
        }
    }
}

/// Prints type, shape and values of an NPY file, flattened with the last index fastest.
const READ_NPY: &str = r#"
a = numpy.load(sys.argv[1], allow_pickle=False)
assert a.flags["C_CONTIGUOUS"]
print(json.dumps({"type": a.dtype.str, "shape": a.shape, "values": [float(x) for x in a.ravel()]}))
"#;

#[test]
fn numpy_finds_slices_rows_columns_and_channels() {
    let folder = tempfile::tempdir().unwrap();
    let tables = of_all_shapes();
    for table in &tables {
        let path = write(Container::Npy, table, folder.path());
        let Some(read) = python(READ_NPY, &path) else { return };
        let [columns, rows, slices] = table.size();
        let channels = table.channels.len();
        let mut shape = if table.axes.len() == 3 { vec![slices, rows, columns] } else { vec![rows, columns] };
        if channels > 1 {
            shape.push(channels);
        }
        let (kind, steps) = match table.format {
            TexelFormat::Unorm8 => ("|u1", 255.0),
            TexelFormat::Unorm16 => ("<u2", 65535.0),
            TexelFormat::F16 => ("<f2", 1.0),
            TexelFormat::F32 => ("<f4", 1.0),
        };
        assert_eq!(read["type"], kind);
        assert_eq!(read["shape"], serde_json::json!(shape), "{}", table.name);
        let values: Vec<f64> = serde_json::from_value(read["values"].clone()).unwrap();
        compare("npy", table, |c, [x, y, z]| values[((z * rows + y) * columns + x) * channels + c] / steps);
        sidecar(table, &path, table.format.name(), 128, 0);
    }
    say(&format!("numpy: {} arrays, every texel at its place", tables.len()));
}

/// Reads a raw file by its sidecar alone; prints the values as nested lists by slice, row, column
/// and channel, and the sidecar.
const READ_RAW: &str = r#"
meta = json.load(open(sys.argv[1] + ".json"))
assert meta["byte_order"] == "little-endian" and meta["stored"] == "f32", meta
columns, rows, slices = meta["size"]
a = numpy.fromfile(sys.argv[1], dtype="<f4", offset=meta["offset"])
a = a.reshape(slices, rows, columns, len(meta["channels"]))
print(json.dumps([[[[float(x) for x in texel] for texel in row] for row in plane] for plane in a]))
"#;

#[test]
fn numpy_reads_the_raw_file_by_its_sidecar() {
    let folder = tempfile::tempdir().unwrap();
    let tables = of_all_shapes();
    for table in &tables {
        let path = write(Container::Raw, table, folder.path());
        let texels = table.size().iter().product::<usize>() * table.channels.len();
        assert_eq!(fs::metadata(&path).unwrap().len(), 4 * texels as u64, "no header");
        let Some(read) = python(READ_RAW, &path) else { return };
        let values: Vec<Vec<Vec<Vec<f64>>>> = serde_json::from_value(read).unwrap();
        compare("raw", table, |c, [x, y, z]| values[z][y][x][c]);
        sidecar(table, &path, "f32", 0, 0);
    }
    say(&format!("numpy: {} raw files, every texel at its place", tables.len()));
}

/// What a sidecar must say of a table.
fn sidecar(table: &Table, path: &Path, stored: &str, offset: usize, padding: usize) -> Value {
    let extension = path.extension().unwrap().to_str().unwrap();
    let text = fs::read(path.with_extension(format!("{extension}.json"))).unwrap();
    let read: Value = serde_json::from_slice(&text).unwrap();
    assert_eq!((&read["name"], &read["quantity"]), (&Value::from(table.name.as_str()), &"ggx-glass".into()));
    assert_eq!((&read["smith"], &read["alpha_map"]), (&"separable".into(), &"roughness^2".into()));
    assert_eq!((&read["container"], &read["stored"]), (&extension.into(), &stored.into()));
    assert_eq!((&read["offset"], &read["padding_channels"]), (&offset.into(), &padding.into()));
    assert_eq!(read["format"], table.format.name());
    assert_eq!(read["size"], serde_json::json!(table.size()));
    assert_eq!(read["decode"]["E"], "1 - loss");
    let names: Vec<&str> = table.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(read["channels"], serde_json::json!(names));
    let axes = [
        ("mu", 5, "endpoint", "u = sqrt(mu)", 0.0, 1.0),
        ("roughness", 4, "endpoint", "u = (roughness - 0.02) / (1 - 0.02)", 0.02, 1.0),
        ("ior", 3, "centre", "u = (ior - 1) / (2 - 1)", 1.0, 2.0),
    ];
    let axes = axes.map(|(name, size, registration, warp, min, max)| {
        serde_json::json!({ "name": name, "size": size, "registration": registration, "warp": warp, "min": min, "max": max })
    });
    assert_eq!(read["axes"].as_array().unwrap().as_slice(), &axes[..table.axes.len()]);
    assert_eq!(read["certificate"], serde_json::to_value(certificate()).unwrap());
    assert!(read["header"][0].as_str().unwrap().contains(&table.name));
    read
}

#[test]
fn a_dds_reader_finds_a_texture_with_every_texel() {
    let folder = tempfile::tempdir().unwrap();
    let tables = of_all_shapes();
    for table in &tables {
        let path = write(Container::Dds, table, folder.path());
        let dds = Dds::read(fs::File::open(&path).unwrap()).expect("a DDS file");
        let [columns, rows, slices] = table.size();
        let solid = table.axes.len() == 3;
        let extension = dds.header10.as_ref().expect("the header of Direct3D 10");
        let dimension = &extension.resource_dimension;
        assert!(match dimension {
            D3D10ResourceDimension::Texture3D => solid,
            D3D10ResourceDimension::Texture2D => !solid,
            other => panic!("{other:?}"),
        });
        assert_eq!((extension.array_size, dds.get_num_mipmap_levels()), (1, 1));
        assert_eq!((dds.get_width(), dds.get_height()), (columns as u32, rows as u32));
        assert_eq!((dds.header.depth, dds.get_depth()), (solid.then_some(3), slices as u32));
        let (format, stored) = match (table.format, table.channels.len()) {
            (TexelFormat::Unorm8, 1) => (DxgiFormat::R8_UNorm, 1),
            (TexelFormat::Unorm8, 2) => (DxgiFormat::R8G8_UNorm, 2),
            (TexelFormat::Unorm8, _) => (DxgiFormat::R8G8B8A8_UNorm, 4),
            (TexelFormat::Unorm16, 1) => (DxgiFormat::R16_UNorm, 1),
            (TexelFormat::Unorm16, 2) => (DxgiFormat::R16G16_UNorm, 2),
            (TexelFormat::Unorm16, _) => (DxgiFormat::R16G16B16A16_UNorm, 4),
            (TexelFormat::F16, 1) => (DxgiFormat::R16_Float, 1),
            (TexelFormat::F16, 2) => (DxgiFormat::R16G16_Float, 2),
            (TexelFormat::F16, _) => (DxgiFormat::R16G16B16A16_Float, 4),
            (TexelFormat::F32, 1) => (DxgiFormat::R32_Float, 1),
            (TexelFormat::F32, 2) => (DxgiFormat::R32G32_Float, 2),
            (TexelFormat::F32, _) => (DxgiFormat::R32G32B32A32_Float, 4),
        };
        assert_eq!(dds.get_dxgi_format(), Some(format));
        let bytes = table.format.bytes() as usize;
        assert_eq!(dds.get_pitch(), Some((columns * stored * bytes) as u32));
        assert_eq!(dds.get_data(0).expect("one layer").len(), columns * rows * slices * stored * bytes);
        let found = numbers(table, &dds.data);
        compare("dds", table, |c, [x, y, z]| found[((z * rows + y) * columns + x) * stored + c]);
        let padding = stored - table.channels.len();
        assert!(found.chunks(stored).all(|texel| texel[stored - padding..].iter().all(|x| *x == 0.0)));
        let said = sidecar(table, &path, table.format.name(), 148, padding);
        assert_eq!(
            said["dxgi_format"].as_str().unwrap().to_lowercase(),
            format!("{format:?}").to_lowercase()
        );
        // R16G16_Float is rg16float.
        let digits = 8 * bytes;
        let short = format!("{format:?}").replace(&digits.to_string(), "").to_lowercase();
        let (letters, kind) = short.split_once('_').expect("channels and a type");
        assert_eq!(said["webgpu_format"], format!("{letters}{digits}{kind}"));
    }
    say(&format!("ddsfile: {} textures, every texel at its place", tables.len()));
}

/// Bytes as the numbers of a table's format.
fn numbers(table: &Table, bytes: &[u8]) -> Vec<f64> {
    let integer = |b: &[u8; 2]| f64::from(u16::from_le_bytes(*b)) / 65535.0;
    match table.format {
        TexelFormat::Unorm8 => bytes.iter().map(|b| f64::from(*b) / 255.0).collect(),
        TexelFormat::Unorm16 => bytes.as_chunks().0.iter().map(integer).collect(),
        TexelFormat::F16 => bytes.as_chunks().0.iter().map(|b| f16::from_le_bytes(*b).to_f64()).collect(),
        TexelFormat::F32 => bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b).into()).collect(),
    }
}

#[test]
fn a_ktx2_reader_finds_a_texture_with_every_texel() {
    let folder = tempfile::tempdir().unwrap();
    let tables = of_all_shapes();
    for table in &tables {
        let path = write(Container::Ktx2, table, folder.path());
        let bytes = fs::read(&path).unwrap();
        let file = Reader::new(bytes.as_slice()).expect("a KTX 2 file");
        let [columns, rows, slices] = table.size();
        let solid = table.axes.len() == 3;
        let (format, stored) = match (table.format, table.channels.len()) {
            (TexelFormat::Unorm8, 1) => (Format::R8_UNORM, 1),
            (TexelFormat::Unorm8, 2) => (Format::R8G8_UNORM, 2),
            (TexelFormat::Unorm8, _) => (Format::R8G8B8A8_UNORM, 4),
            (TexelFormat::Unorm16, 1) => (Format::R16_UNORM, 1),
            (TexelFormat::Unorm16, 2) => (Format::R16G16_UNORM, 2),
            (TexelFormat::Unorm16, _) => (Format::R16G16B16A16_UNORM, 4),
            (TexelFormat::F16, 1) => (Format::R16_SFLOAT, 1),
            (TexelFormat::F16, 2) => (Format::R16G16_SFLOAT, 2),
            (TexelFormat::F16, _) => (Format::R16G16B16A16_SFLOAT, 4),
            (TexelFormat::F32, 1) => (Format::R32_SFLOAT, 1),
            (TexelFormat::F32, 2) => (Format::R32G32_SFLOAT, 2),
            (TexelFormat::F32, _) => (Format::R32G32B32A32_SFLOAT, 4),
        };
        let (header, size) = (file.header(), table.format.bytes() as usize);
        assert_eq!((header.format, header.type_size as usize), (Some(format), size));
        let extent = [header.pixel_width, header.pixel_height, header.pixel_depth].map(|n| n as usize);
        assert_eq!(extent, [columns, rows, if solid { slices } else { 0 }]);
        assert_eq!((header.layer_count, header.face_count, header.level_count), (0, 1, 1));
        assert_eq!(header.supercompression_scheme, None);
        // As the crate makes it, whose descriptors Khronos' validator passes; texels are no
        // colours.
        let (made, _) = Basic::from_format(format).expect("a format of numbers");
        assert_eq!(made.transfer_function, Some(TransferFunction::Linear));
        assert_eq!(file.dfd_blocks(), [Block::Basic(Basic { color_primaries: None, ..made })]);
        let pairs: Vec<(&str, &[u8])> = file.key_value_data().collect();
        let orientation: &[u8] = if solid { b"rdi\0" } else { b"rd\0" };
        assert_eq!(pairs[0], ("KTXorientation", orientation));
        assert!(pairs[1].0 == "KTXwriter" && pairs[1].1.starts_with(b"lobefit "), "{pairs:?}");
        let levels: Vec<_> = file.levels().collect();
        let length = columns * rows * slices * stored * size;
        assert_eq!((levels.len(), levels[0].data.len()), (1, length));
        assert_eq!(levels[0].uncompressed_byte_length as usize, length);
        let offset = bytes.len() - length;
        assert!(offset.is_multiple_of((stored * size).max(4)), "the level begins at byte {offset}");
        let found = numbers(table, levels[0].data);
        compare("ktx2", table, |c, [x, y, z]| found[((z * rows + y) * columns + x) * stored + c]);
        let padding = stored - table.channels.len();
        assert!(found.chunks(stored).all(|texel| texel[stored - padding..].iter().all(|x| *x == 0.0)));
        let said = sidecar(table, &path, table.format.name(), offset, padding);
        assert_eq!(said["vk_format"], format!("{format:?}").replace("Format::", ""));
    }
    say(&format!("ktx2: {} textures, every texel at its place", tables.len()));
}

#[test]
fn what_a_container_cannot_hold_is_refused() {
    let tables = of_all_shapes();
    let certificate = certificate();
    let refused = |container, table: &Table| {
        let described = Described { table, decode: Decode::Loss, certificate: &certificate, header: &[] };
        encode(container, &described).expect_err("refused")
    };
    let (mut five, first) = (tables[0].clone(), &tables[0].channels[0]);
    five.channels.extend((0..4).map(|i| Channel { name: format!("more {i}"), ..first.clone() }));
    for container in [Container::Dds, Container::Ktx2] {
        let error = refused(container, &five);
        assert!(matches!(error, ContainerError::Texture(_)), "{error}");
        let words = format!("solid-unorm8-2-1: 5 channels; a texel of {} has one to four", container.name());
        assert!(error.to_string().contains(&words), "{error}");
    }
    let half = tables.iter().find(|table| table.format == TexelFormat::F16).expect("a table of f16");
    let mut large = half.clone();
    large.channels[0].texels[7] = 1e6; // beyond the largest half, 65504
    let mut short = tables[0].clone();
    short.channels[0].texels.pop();
    for container in Container::ALL {
        for table in [&large, &short] {
            let error = refused(container, table);
            assert!(matches!(error, ContainerError::Table(_)), "{error}");
        }
    }
}

#[test]
fn the_same_table_gives_the_same_bytes() {
    let certificate = certificate();
    for table in &of_all_shapes() {
        let described = Described { table, decode: Decode::Loss, certificate: &certificate, header: &[] };
        for container in Container::ALL {
            let twice = [0, 1].map(|_| encode(container, &described).expect("encodes"));
            assert_eq!(twice[0], twice[1]);
        }
    }
}
