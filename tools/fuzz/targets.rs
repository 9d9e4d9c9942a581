//! What is asked of every input: no panic, no hang, an error of one line or a correct stone.
//!
//! Each target takes the fuzzer's bytes. They are run by libFuzzer (`fuzz_targets/`) and, bounded, by
//! proptest on every change (`tests/program/hostile.rs`).

#![allow(dead_code)] // every binary uses one of them

use cutlab::advanced::batch::sidecar::TableMeta;
use cutlab::advanced::batch::table::{NumericColumns, RowReader, TableFormat};
use cutlab::advanced::color::Illuminant;
use cutlab::advanced::design::Design;
use cutlab::advanced::design::families::{self, FAMILIES};
use cutlab::advanced::formats::{self, FORMATS, FormatError, Input, ParsedShape, triangle_mesh};
use cutlab::advanced::geometry::{Plane, Polyhedron};
use cutlab::advanced::limits::Limits;
use cutlab::advanced::materials::Material;
use cutlab::advanced::photons::map_file;
use cutlab::advanced::scene::panorama::Panorama;
use cutlab::advanced::scene::shapes::{SceneMesh, SurfaceGeometry};
use cutlab::advanced::scene::surface::SurfaceHit;
use cutlab::advanced::scene::{SceneFile, SceneOverrides};
use glam::{DMat3, DVec3, Vec3};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// Bytes as numbers, zeros when they are used up.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn byte(&mut self) -> u8 {
        let (first, rest) = self.0.split_first().map_or((0, self.0), |(b, rest)| (*b, rest));
        self.0 = rest;
        first
    }

    fn float(&mut self) -> f64 {
        f32::from_le_bytes(std::array::from_fn(|_| self.byte())).into()
    }

    /// A whole number from −128 to 127: corners of many planes come from few numbers.
    fn small(&mut self) -> f64 {
        f64::from(self.byte() as i8)
    }

    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

fn is_one_line(error: &impl std::fmt::Display) {
    let text = error.to_string();
    assert!(!text.is_empty() && !text.trim_end().contains('\n'), "not one line: {text:?}");
}

/// What holds for every solid.
fn is_correct(solid: &Polyhedron) {
    assert_eq!(solid.euler(), 2, "V − E + F");
    let size = solid.bounding_sphere().1;
    let volume = solid.volume();
    assert!(volume > 0.0 && volume.is_finite(), "volume {volume}");
    assert!(volume < 4.2 * size.powi(3) * (1.0 + 1e-9), "volume {volume} in a sphere of {size}");
    let open: DVec3 = (0..solid.faces.len()).map(|f| solid.area_vector(f)).sum();
    assert!(open.length() <= 1e-9 * size * size, "open by {open} for size {size}");
    assert!(solid.faces.iter().all(|f| f.corners.len() >= 3));
}

/// In the first byte of [`readers`]: the format is found by the content.
pub const FOUND: u8 = 0x0f;

/// In the first byte of [`readers`]: what was read is only built, not also written in every format.
pub const READ_ONLY: u8 = 0x10;

/// A file: the first byte says which format it is read as, and whether what was read is also written in
/// every format, which takes a hundred times as long; the rest is the file.
pub fn readers(data: &[u8]) {
    let Some((how, bytes)) = data.split_first() else { return };
    let read: Result<Option<Design>, FormatError> = match FORMATS.get(usize::from(how & FOUND)) {
        Some(format) => {
            let source = Input { name: "fuzzed", bytes, folder: None, limits: Limits::default() };
            (format.read)(&source).map(|parsed| match parsed.shape {
                ParsedShape::Design(design) => Some(design),
                ParsedShape::Mesh { .. } => None,
            })
        }
        None => formats::read_bytes("fuzzed", bytes, None).map(|imported| Some(imported.design)),
    };
    match read {
        Ok(Some(design)) => stands_or_says_why(&design, how & !FOUND == 0),
        Ok(None) => (),
        Err(error) => is_one_line(&error),
    }
}

/// A design that was read is a stone, and if asked can be written in every format and read again; or
/// there is an error.
fn stands_or_says_why(design: &Design, written: bool) {
    if design.facets().count() > 200 {
        return; // the time goes into small ones
    }
    match design.solid() {
        Ok(solid) => is_correct(&solid),
        Err(error) => return is_one_line(&error),
    }
    for format in FORMATS.iter().filter(|f| written && f.write.is_some()) {
        match formats::encode(design, format.name) {
            Ok(bytes) => {
                if let Err(error) = formats::read_bytes("written", &bytes, None) {
                    is_one_line(&error);
                }
            }
            Err(error) => is_one_line(&error),
        }
    }
}

/// Half-spaces: correct, and the same however they are shuffled and turned; or an error.
pub fn solids(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (whole, scale) = (bytes.byte().is_multiple_of(2), 10f64.powi(i32::from(bytes.byte() % 13) - 6));
    let mut planes = Vec::new();
    while !bytes.is_empty() && planes.len() < 100 {
        let mut number = || if whole { bytes.small() } else { bytes.float() };
        let normal = DVec3::new(number(), number(), number());
        let distance = number() * scale;
        planes.push(Plane { normal: normal.normalize_or_zero(), distance });
    }
    let turn = DMat3::from_euler(glam::EulerRot::XYZ, 0.7, -0.4, 2.1);
    let half = planes.len() / 2;
    let shuffled: Vec<Plane> =
        planes[half..].iter().chain(planes[..half].iter().rev()).map(|p| p.turned(turn)).collect();
    match (Polyhedron::from_planes(&planes), Polyhedron::from_planes(&shuffled)) {
        (Ok(a), Ok(b)) => {
            is_correct(&a);
            is_correct(&b);
            let size = a.bounding_sphere().1;
            let apart = (a.volume() - b.volume()).abs();
            assert!(apart <= 1e-9 * size.powi(3), "{} and {} for size {size}", a.volume(), b.volume());
        }
        (a, b) => [a.err(), b.err()].iter().flatten().for_each(is_one_line),
    }
}

/// Tiers with meets, as a design file.
pub fn meets(data: &[u8]) {
    let mut bytes = Bytes(data);
    let mut text = format!("name = \"f\"\ngear = {{ teeth = {} }}\n", bytes.byte() % 100);
    for tier in 0..12 {
        if bytes.is_empty() {
            break;
        }
        let indices: Vec<_> = (0..1 + bytes.byte() % 3).map(|_| bytes.byte().to_string()).collect();
        let _ = writeln!(text, "[[tier]]\nname = \"t{tier}\"\nindices = [{}]", indices.join(", "));
        let mut entries = BTreeMap::new();
        for _ in 0..1 + bytes.byte() % 4 {
            let (key, value) = entry(&mut bytes);
            entries.insert(key, value);
        }
        entries.iter().for_each(|(key, value)| text += &format!("{key} = {value}\n"));
    }
    match formats::read_bytes("fuzzed.toml", text.as_bytes(), None) {
        Ok(read) => stands_or_says_why(&read.design, false),
        Err(error) => is_one_line(&error),
    }
}

/// A key of a tier and its value.
fn entry(bytes: &mut Bytes) -> (&'static str, String) {
    let facet = |bytes: &mut Bytes| match bytes.byte() {
        b if b % 3 == 0 => format!("t{}", b % 12),
        b if b % 3 == 1 => format!("t{} {}", b % 12, 1 + b / 12),
        b => format!("t{}@{}", b % 12, bytes.byte()),
    };
    let corner = |bytes: &mut Bytes| [facet(bytes), facet(bytes), facet(bytes)].join(" & ");
    match bytes.byte() % 10 {
        0 => ("angle", bytes.small().to_string()),
        1 => ("angle", (bytes.small() / 1.4).to_string()),
        2 => ("distance", (bytes.small() / 64.0).to_string()),
        3 => ("meets", format!("\"{}\"", corner(bytes))),
        4 => ("meets", format!("[\"{}\", \"{}\"]", corner(bytes), corner(bytes))),
        5 => ("girdle", (bytes.small() / 1000.0).to_string()),
        6 => ("width", (bytes.small() / 32.0).to_string()),
        7 => ("table", (bytes.small() / 100.0).to_string()),
        8 => ("repeat", bytes.byte().to_string()),
        _ => ("mirror", bytes.byte().is_multiple_of(2).to_string()),
    }
}

/// Parameters of a family, any numbers.
pub fn cuts(data: &[u8]) {
    let mut bytes = Bytes(data);
    let family = FAMILIES[bytes.byte() as usize % FAMILIES.len()];
    let mut values = BTreeMap::new();
    while !bytes.is_empty() && values.len() < 8 {
        let parameter = &family.parameters[bytes.byte() as usize % family.parameters.len().max(1)];
        let value = match bytes.byte() % 3 {
            0 => bytes.float(),
            1 => f64::from(bytes.byte()) / 2.0,
            _ => bytes.small(),
        };
        values.insert(parameter.key.to_string(), value);
    }
    match families::build(family.name, &values) {
        Ok(design) => match design.solid() {
            Ok(solid) => is_correct(&solid),
            Err(error) => is_one_line(&error),
        },
        Err(error) => is_one_line(&error),
    }
}

/// A material or an illuminant: its TOML, and after a NUL the table that it names.
pub fn materials(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let (document, table) = text.split_once('\0').unwrap_or((&text, ""));
    let tables = |_: &str| Ok(table.to_owned());
    match Material::parse("fuzzed.toml", document, &tables) {
        Ok(material) => {
            for nm in (380..=730).map(f64::from) {
                let (n, a) = (material.index(nm), material.absorption_per_mm(nm));
                assert!((1.0..=10.0).contains(&n) && a >= 0.0, "n {n}, absorption {a} at {nm} nm");
            }
        }
        Err(error) => is_one_line(&error),
    }
    match Illuminant::parse("fuzzed.toml", document, &tables) {
        Ok(light) => assert!(light.luminance() > 0.0 && light.luminance().is_finite(), "{light:?}"),
        Err(error) => is_one_line(&error),
    }
}

/// A scene file, set up or refused. It lies in no folder: what it names beside itself is not there.
pub fn scenes(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let nowhere = Path::new("/nowhere");
    let scene = SceneFile::parse("fuzzed", "fuzzed.toml", &text, nowhere)
        .and_then(|f| f.build(&SceneOverrides::default(), 1.5));
    match scene {
        Ok(scene) => assert!(!scene.stones.is_empty()),
        Err(error) => is_one_line(&error),
    }
}

/// A mesh that stands around stones, of any shape: rays meet it in front of them on the side they see.
pub fn sceneries(data: &[u8]) {
    let source = Input { name: "fuzzed", bytes: data, folder: None, limits: Limits::default() };
    let mesh = match triangle_mesh::triangles_from(&source) {
        Ok(mesh) => mesh,
        Err(error) => return is_one_line(&error),
    };
    // the numbers of scenes, which are refused beyond that
    if mesh.vertices.iter().any(|v| v.length() > 1e9) {
        return;
    }
    let mesh = match SceneMesh::new(&mesh, DMat3::IDENTITY, 1.0, DVec3::ZERO, Limits::default()) {
        Ok(mesh) => mesh,
        Err(error) => return is_one_line(&error),
    };
    for d in [Vec3::X, Vec3::NEG_Z, Vec3::new(0.6, -0.48, 0.64)] {
        if let Some(SurfaceHit { distance, normal, .. }) = mesh.intersect(-3.0 * d, d, 0.0) {
            assert!(distance > 0.0 && normal.dot(d) <= 1e-6, "{distance} {normal} against {d}");
        }
    }
}

/// A panorama: light from it is finite, or there is an error.
pub fn panoramas(data: &[u8]) {
    match Panorama::from_bytes(data, Limits::default()) {
        Ok(sky) => {
            assert!(sky.mean().is_finite() && sky.mean() >= 0.0, "mean {}", sky.mean());
            for u in [[0.0, 0.0], [0.3, 0.7], [0.999_999, 0.5]] {
                let (direction, _) = sky.sample(u);
                let colour = sky.colour(direction);
                assert!(direction.is_finite() && colour.is_finite(), "{sky:?}, {u:?}: {direction} {colour}");
            }
        }
        Err(problem) => is_one_line(&problem),
    }
}

/// A photon map. Unless the first byte is 0, what follows is put behind the right beginning and before
/// the right checksum, as the header, which ends at the first `}`, and the photons.
pub fn maps(data: &[u8]) {
    let Some((how, rest)) = data.split_first() else { return };
    let decoded = if *how == 0 { map_file::decode(rest) } else { map_file::decode(&photon_map(rest)) };
    match decoded {
        Ok((_, shots)) => {
            let all = shots.caustic.photons.iter().chain(&shots.indirect.photons);
            assert!(all.into_iter().all(|p| p.point.is_finite() && p.power.is_finite()));
        }
        Err(problem) => is_one_line(&problem),
    }
}

fn photon_map(rest: &[u8]) -> Vec<u8> {
    let header = rest.iter().position(|b| *b == b'}').map_or(0, |at| at + 1);
    let mut bytes = b"CUTLABPM".to_vec();
    bytes.extend(map_file::VERSION.to_le_bytes());
    bytes.extend((header as u32).to_le_bytes());
    bytes.extend(rest);
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    bytes
}

/// What tables of scores and their sidecars are read back from.
pub fn tables(data: &[u8]) {
    let Some((how, bytes)) = data.split_first() else { return };
    if how % 4 == 3 {
        if let Err(error) = serde_json::from_slice::<TableMeta>(bytes) {
            is_one_line(&error);
        }
        return;
    }
    let form = [TableFormat::Csv, TableFormat::JsonLines, TableFormat::Json][usize::from(how % 4)];
    if let Err(error) = NumericColumns::read(bytes, form, Limits::default()) {
        is_one_line(&error);
    }
    let Ok(mut rows) = RowReader::new(form, bytes, Limits::default()) else { return };
    while let Ok(Some(row)) = rows.row() {
        assert!(row.len() <= 4 * bytes.len() + 2, "a row longer than what it is from");
    }
}
