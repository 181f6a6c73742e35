//! Meshes of glTF files: where their triangles come to lie, the rasteriser's depth of them, and files
//! that are refused.

use std::path::Path;

use lobefit_import::{Mesh, mesh};
use lobefit_occlusion::camera::Camera;
use lobefit_occlusion::raster::{Solids, rendered};
use lobefit_occlusion::site::Site;

/// The example's world.
pub fn courtyard() -> Site {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/courtyard.glb");
    Site::of_mesh(&mesh(&std::fs::read(file).expect("the example"), "courtyard.glb").expect("a mesh"))
}

/// A binary file of a document and a buffer.
fn glb(json: &str, buffer: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut out = b"glTF".to_vec();
    let mut word = |n: usize| out.extend((n as u32).to_le_bytes());
    word(2);
    word(28 + json.len() + buffer.len());
    word(json.len());
    out.extend(b"JSON");
    out.extend(json);
    out.extend((buffer.len() as u32).to_le_bytes());
    out.extend(b"BIN\0");
    out.extend(buffer);
    out
}

/// Four corners of a square in the plane y = 1, then six indices of 16 bits.
fn square() -> Vec<u8> {
    let corners: [f32; 12] = [0.0, 1.0, 0.0, 2.0, 1.0, 0.0, 2.0, 1.0, 2.0, 0.0, 1.0, 2.0];
    let indices: [u16; 6] = [0, 1, 2, 0, 2, 3];
    corners.iter().flat_map(|x| x.to_le_bytes()).chain(indices.iter().flat_map(|i| i.to_le_bytes())).collect()
}

const NODES: &str = r#""nodes":[{"mesh":0}]"#;
const ACCESSORS: &str = r#""accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}]"#;
const VIEWS: &str =
    r#""bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}]"#;
const MESHES: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]"#;

/// A file of the square with some part exchanged.
fn with(from: &str, to: &str) -> Vec<u8> {
    let parts = [r#"{"asset":{"version":"2.0"}"#, NODES, ACCESSORS, VIEWS, MESHES, r#""buffers":[{}]}"#];
    let json = parts.join(",");
    assert!(json.contains(from), "{from}");
    glb(&json.replacen(from, to, 1), &square())
}

fn read(bytes: &[u8]) -> Mesh {
    mesh(bytes, "m.glb").unwrap_or_else(|e| panic!("{e}"))
}

/// The surface of a box, seen from outside.
fn solid(low: [f32; 3], high: [f32; 3]) -> Vec<[[f32; 3]; 3]> {
    let side = |axis: usize, top: bool| {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let corner = |a: bool, b: bool| {
            let mut place = [if top { high[axis] } else { low[axis] }; 3];
            place[u] = if a { high[u] } else { low[u] };
            place[v] = if b { high[v] } else { low[v] };
            place
        };
        let [a, b, c, d] =
            [(false, false), (true, false), (true, true), (false, true)].map(|(a, b)| corner(a, b));
        if top { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] }
    };
    (0..3).flat_map(|axis| [side(axis, false), side(axis, true)].concat()).collect()
}

/// A person stands on the ground and on roofs, neither within the ground nor in a house without a door.
#[test]
fn eyes_stand_on_what_looks_up() {
    let mut triangles = solid([0.0, -5.0, 0.0], [30.0, 0.0, 30.0]);
    triangles.extend(solid([12.0, 0.0, 12.0], [18.0, 8.0, 18.0]));
    let parts = vec![0..12, 12..24];
    let site = Site::of_mesh(&Mesh { triangles, parts });
    let heights = site.starts.map(|start| start.eye[2]);
    assert!(heights.iter().all(|z| (z - 1.7).abs() < 1e-4 || (z - 9.7).abs() < 1e-4), "{heights:?}");
    assert!(heights.iter().filter(|z| **z < 2.0).count() >= 8, "{heights:?}");
}

/// Corners of nodes in nodes: turned by a quarter about y, which takes x to -z, then scaled, then
/// moved; a matrix does the same.
#[test]
fn nodes_put_triangles_where_they_belong() {
    let plain = read(&with(NODES, NODES));
    assert_eq!(plain.triangles[1], [[0.0, 1.0, 0.0], [2.0, 1.0, 2.0], [0.0, 1.0, 2.0]]);
    assert_eq!((plain.parts.len(), plain.parts[0].clone()), (1, 0..2));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let nested = format!(
        r#""scene":0,"scenes":[{{"nodes":[1]}}],"nodes":[{{"mesh":0,"rotation":[0,{half},0,{half}],"scale":[3,1,1]}},
        {{"children":[0],"translation":[10,0,-5]}},{{"mesh":0}}]"#
    );
    let matrix = r#""nodes":[{"children":[1],"translation":[10,0,0]},{"mesh":0,"matrix":[0,0,-3,0, 0,1,0,0, 1,0,0,0, 0,0,-5,1]}]"#;
    for nodes in [nested.as_str(), matrix] {
        let found = read(&with(NODES, nodes));
        let expected = [[10.0, 1.0, -5.0], [12.0, 1.0, -11.0], [12.0, 1.0, -5.0]];
        let off = found.triangles[1].iter().flatten().zip(expected.iter().flatten());
        assert!(off.into_iter().all(|(a, b): (&f32, &f32)| (a - b).abs() < 1e-5), "{:?}", found.triangles[1]);
        assert_eq!(found.triangles.len(), 2);
    }
}

#[test]
fn strips_fans_bytes_and_text_are_read() {
    let corners = |bytes: &[u8]| read(bytes).triangles;
    let all = corners(&with(NODES, NODES));
    let fan = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}]"#;
    assert_eq!(corners(&with(MESHES, fan)), all);
    let strip = corners(&with(MESHES, &fan.replace("6}", "5}")));
    assert_eq!([strip.len(), corners(&with(MESHES, &fan.replace(":6", ":5,\"indices\":1"))).len()], [2, 4]);
    // Bytes of small numbers of 16 bits are every other one.
    let bytes = r#"{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}"#;
    let short = r#"{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}"#;
    assert_eq!(corners(&with(short, bytes)), [[all[0][0], all[0][0], all[0][1]]]);
    let uri = r#""buffers":[{"uri":"data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAQAAAgD8AAAAAAAAAQAAAgD8AAABA"}]"#;
    let json = [r#"{"asset":{"version":"2.0"}"#, NODES, uri].join(",")
        + r#","accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]}"#;
    assert_eq!(corners(json.as_bytes()), [all[0]]);
}

#[test]
fn hostile_files_are_refused_by_name() {
    let position = r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#;
    let indices = r#"{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}"#;
    let refused = |bytes: &[u8], message: &str| {
        let error = mesh(bytes, "m.glb").expect_err(message).to_string();
        assert!(error.starts_with("m.glb") && error.contains(message), "{error}\nand not {message}");
    };
    let cases = [
        (
            position,
            position.replace("\"count\":4", "\"count\":2147483648"),
            "accessors[0].count: 2147483648 elements of 12 bytes",
        ),
        (position, position.replace("\"count\":4", "\"count\":18446744073709551615"), "accessors[0].count: "),
        (position, position.replace("\"count\":4", "\"count\":0"), "accessors[0].count: 0 elements"),
        (
            position,
            position.replace("\"count\":4", "\"count\":5"),
            "accessors[0].count: 5 elements of 12 bytes, and its view has 48",
        ),
        (position, position.replace("\"count\":4", "\"byteOffset\":4,\"count\":4"), "accessors[0].count: "),
        (position, position.replace("\"count\":4", "\"count\":-1"), "accessors[0].count: "),
        (
            position,
            position.replace("\"count\":4", "\"count\":3"),
            "accessors[1]: element 5 is 3, and there are 3 positions",
        ),
        (position, position.replace("5126", "5123"), "accessors[0].componentType: 5123 where 5126"),
        (position, position.replace("VEC3", "VEC4"), "accessors[0].type: `VEC4` where VEC3"),
        (position, position.replace("\"bufferView\":0,", ""), "accessors[0]: it has no `bufferView`"),
        (
            position,
            position.replace("\"bufferView\":0,", "\"bufferView\":7,"),
            "accessors[0].bufferView: view 7 is none",
        ),
        (position, position.replace("\"type\"", "\"sparse\":{},\"type\""), "accessors[0].sparse: "),
        (
            indices,
            indices.replace("\"count\":6", "\"count\":5"),
            "5 corners make no whole number of triangles",
        ),
        (indices, indices.replace("5123", "5125"), "accessors[1].count: 6 elements of 4 bytes"),
        (
            "\"byteLength\":48}",
            "\"byteLength\":48,\"byteStride\":8}".into(),
            "bufferViews[0].byteStride: 8 is outside [12, 252]",
        ),
        (
            "\"byteLength\":48}",
            "\"byteLength\":4294967296}".into(),
            "bufferViews[0]: it reaches beyond its buffer",
        ),
        (
            "\"buffers\":[{}]",
            "\"buffers\":[{\"uri\":\"b.bin\"}]".into(),
            "bufferViews[0].buffer: its buffer is a file of its own",
        ),
        (
            "\"buffers\":[{}]",
            "\"buffers\":[{\"uri\":\"data:;base64,!\"}]".into(),
            "buffers[0].uri: its base64 is broken",
        ),
        (
            "\"POSITION\":0",
            "\"POSITION\":9".into(),
            "meshes[0].primitives[0].attributes.POSITION: accessor 9 is none",
        ),
        ("\"POSITION\":0", String::new(), "meshes[0].primitives[0].attributes: it has no POSITION"),
        ("\"indices\":1", "\"indices\":1,\"mode\":7".into(), "meshes[0].primitives[0].mode: 7 is none"),
        (NODES, r#""nodes":[{"mesh":3}]"#.into(), "nodes[0].mesh: mesh 3 is none of the file's 1"),
        (
            NODES,
            r#""nodes":[{"children":[1]},{"children":[0],"mesh":0}]"#.into(),
            "nodes[0]: it is among its own ancestors",
        ),
        (NODES, r#""nodes":[{"children":[0],"mesh":0}]"#.into(), "nodes[0]: it is among its own ancestors"),
        (
            NODES,
            r#""nodes":[{"children":[2]},{"children":[2]},{"mesh":0}]"#.into(),
            "nodes[1].children[0]: node 2 is a child of node 0 too",
        ),
        (NODES, r#""nodes":[{"children":[8]}]"#.into(), "nodes[0].children[0]: node 8 is none"),
        (NODES, r#""nodes":[{"mesh":0}],"scene":2"#.into(), "scene: scene 2 is none of the file's 0"),
        (
            NODES,
            r#""nodes":[{"mesh":0}],"scenes":[{"nodes":[4]}]"#.into(),
            "scenes[0].nodes[0]: node 4 is none",
        ),
        (NODES, r#""nodes":[{"mesh":0}],"scenes":[{}]"#.into(), "no node of its scene has a triangle"),
        (
            NODES,
            r#""nodes":[{"mesh":0,"scale":[1e300,1e300,1]},{}]"#.into(),
            "accessors[0]: element 0 lies at ",
        ),
        (NODES, r#""nodes":[{"mesh":0,"scale":[1e999,1,1]}]"#.into(), "nodes[0].scale"),
        (
            NODES,
            r#""nodes":[{"mesh":0,"rotation":[0,0,0,0]}]"#.into(),
            "nodes[0].rotation: it is no quaternion",
        ),
        (
            NODES,
            r#""nodes":[{"mesh":0,"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}]"#.into(),
            "nodes[0].matrix: its last row",
        ),
        (NODES, r#""nodes":[{"mesh":0,"matrix":[1,0,0]}]"#.into(), "nodes[0].matrix: "),
        (
            NODES,
            r#""extensionsRequired":["KHR_draco_mesh_compression"]"#.into(),
            "extensionsRequired: `KHR_draco_mesh_compression`",
        ),
        ("\"2.0\"", "\"1.0\"".into(), "asset.version: `1.0` is not a version of glTF 2"),
    ];
    for (from, to, message) in cases {
        refused(&with(from, &to), message);
    }
    for (x, is) in [(f32::NAN, "is ["), (f32::INFINITY, "is ["), (3e6, "lies at ")] {
        let mut bytes = with(NODES, NODES);
        let corner = bytes.len() - 60 + 12;
        bytes[corner..corner + 4].copy_from_slice(&x.to_le_bytes());
        refused(&bytes, &format!("accessors[0]: element 1 {is}"));
    }
    let whole = with(NODES, NODES);
    refused(&whole[..whole.len() - 4], "bufferViews[1]: the file ends before the end of its buffer");
    refused(&whole[..100], "and the file ends before");
    // A square in each of many nodes: more triangles than are read, of a small file.
    let many = vec![r#"{"mesh":0}"#; 60_000].join(",");
    let twenty = vec![r#"{"attributes":{"POSITION":0},"indices":1}"#; 20].join(",");
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{many}],"meshes":[{{"primitives":[{twenty}]}}],{ACCESSORS},{VIEWS},"buffers":[{{}}]}}"#
    );
    refused(&glb(&json, &square()), "nodes[3276].mesh: more than 65536 primitives are drawn");
}

/// Depth is where the ray through a pixel centre meets the first triangle (Moeller and Trumbore
/// 1997), in f64; triangles without area are not drawn.
#[test]
fn depth_of_triangles_is_that_of_rays() {
    const SIZE: [usize; 2] = [32, 20];
    let site = courtyard();
    let mut solids = Solids { boxes: Vec::new(), triangles: site.solids.triangles.clone() };
    solids.triangles.extend([[[1.0; 3]; 3], [[0.0; 3], [9.0; 3], [4.5; 3]]]);
    let mut off = 0;
    for (i, start) in site.starts.iter().enumerate() {
        let camera = Camera::new(start.eye, [1.3 * i as f64, 0.05], SIZE);
        let depth = rendered(&camera, &solids, SIZE);
        let [corner, across, down] = camera.rays(SIZE).map(|ray| ray.map(f64::from));
        for (k, found) in depth.texels.iter().enumerate() {
            let (x, y) = ((k % SIZE[0]) as f64 + 0.5, (k / SIZE[0]) as f64 + 0.5);
            let ray = [0, 1, 2].map(|k| corner[k] + x * across[k] + y * down[k]);
            let first = site.solids.triangles.iter().filter_map(|corners| meets(start.eye, ray, corners));
            let truth = first.fold(f64::INFINITY, f64::min);
            let near = |z: f32| f64::from(z) == truth || (f64::from(z) - truth).abs() < 1e-3 * truth;
            let beside = [k.wrapping_sub(1), k + 1, k.wrapping_sub(SIZE[0]), k + SIZE[0]];
            let edge = beside.iter().any(|k| depth.texels.get(*k).is_some_and(|z| near(*z)));
            assert!(near(*found) || edge, "start {i}, texel {k}: {found}, {truth}");
            off += usize::from(!near(*found));
        }
    }
    assert!(off < 9, "{off} texels are of a neighbour");
}

/// The depth at which a ray meets a triangle, at or beyond the near plane.
fn meets(eye: [f32; 3], ray: [f64; 3], corners: &[[f32; 3]; 3]) -> Option<f64> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let [a, b, c] = corners.map(|corner| [0, 1, 2].map(|k| f64::from(corner[k]) - f64::from(eye[k])));
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let p = cross(ray, v);
    let q = cross(a.map(|x| -x), u);
    let scale = dot(u, p);
    let (s, t) = (dot(a.map(|x| -x), p) / scale, dot(ray, q) / scale);
    let z = dot(v, q) / scale;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && z >= 0.1).then_some(z)
}
