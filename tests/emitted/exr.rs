//! EXR files, written and read back by the product.

use lobefit::data::{AlphaMap, Axis, Channel, Registration, Smith, Table, TexelFormat, Warp};
use lobefit::emit::exr::{decode, encode};

fn table(format: TexelFormat) -> Table {
    let axis = |name: &str, size| Axis {
        name: name.into(),
        size,
        registration: Registration::Endpoint,
        warp: Warp::Linear,
        min: 0.0,
        max: 1.0,
    };
    let channel = |name: &str, f: fn(f64) -> f64| Channel {
        name: name.into(),
        texels: (0..12).map(|i| f(f64::from(i))).collect(),
    };
    Table {
        name: "test".into(),
        quantity: "ggx-reflection".into(),
        smith: Some(Smith::Correlated),
        alpha_map: AlphaMap::RoughnessSquared,
        axes: vec![axis("mu", 4), axis("roughness", 3)],
        channels: vec![channel("loss", |i| i / 7.0), channel("bias", |i| -i / 3.0)],
        format,
    }
}

#[test]
fn what_is_written_reads_back_to_the_bit() {
    for format in [TexelFormat::F16, TexelFormat::F32] {
        let table = table(format);
        let header = [("lobefitHeader".to_string(), "a line\nand another".to_string())];
        let bytes = encode(&table, &header).expect("encodes");
        assert_eq!(bytes, encode(&table, &header).expect("encodes"), "same bytes");
        let decoded = decode(&bytes).expect("decodes");
        assert_eq!((decoded.width, decoded.height), (4, 3));
        for channel in table.quantised().channels {
            let back = decoded.channels.iter().find(|c| c.name == channel.name).expect("the channel");
            assert_eq!(back.texels, channel.texels);
        }
        assert!(bytes.windows(13).any(|w| w == b"lobefitHeader"));
    }
}

#[test]
fn damaged_bytes_are_an_error() {
    let bytes = encode(&table(TexelFormat::F16), &[]).expect("encodes");
    assert!(decode(&bytes[..bytes.len() / 2]).is_err());
    assert!(decode(b"not an image").is_err());
}
