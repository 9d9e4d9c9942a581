//! Photon-map files: kept for other views of the same scene, refused for any other.
//!
//! Layout, little-endian: the magic `CUTLABPM`, u32 version, u32 length of the header, the header
//! as JSON ([`MapProvenance`]), then the photons of both classes (30 bytes each: three f32 of place, f32
//! power, eight bytes of tint, u16 surface, a byte that is 0 on its back, three i8 of
//! the normal there in 127ths), last a CRC-32 of everything before it.

use super::{PhotonSet, PhotonSets, PhotonSettings, StoredPhoton};
use crate::color::cie::BANDS;
use crate::limits::{self, Limits};
use crate::scene::{PlacedStone, Scene};
use crate::storage::atomic_write::{self, WriteError};
use crate::storage::bounded_read;
use crate::storage::text::display_name;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 8] = b"CUTLABPM";
/// Version of the layout and of what its checksums cover; a file of another is refused.
pub const VERSION: u32 = 4;
/// Bytes of one stored photon.
const PHOTON: usize = 30;
/// Most bytes of a header; one has a few hundred.
const HEADER_LIMIT: usize = 1 << 16;

/// A stored map that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum MapFileError {
    /// The file cannot be read.
    #[error("cannot read the photon map {}: {cause}", display_name(.path))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        cause: std::io::Error,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Not a photon map, damaged, or of another version.
    #[error("{} is not a photon map that can be used: {problem}; delete it to have it made anew", display_name(.path))]
    Unusable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A map of something else.
    #[error(
        "the photon map {} was made for {what} {made_for}, not {wanted}; name another file or delete it",
        display_name(.path)
    )]
    DifferentScene {
        /// The file.
        path: PathBuf,
        /// What differs: the scene, the stone …
        what: &'static str,
        /// Value in the file.
        made_for: String,
        /// Value asked for.
        wanted: String,
    },
}

/// What a map was made from. Everything but the view and the estimate's settings counts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct MapProvenance {
    scene: String,
    stone: String,
    material: String,
    polarised: String,
    surroundings: String,
    photons: usize,
    seed: u64,
    caustic_stored: usize,
    caustic_emitted: u64,
    indirect_stored: usize,
    indirect_emitted: u64,
}

impl MapProvenance {
    fn new(scene: &Scene, settings: &PhotonSettings, shots: &PhotonSets) -> MapProvenance {
        MapProvenance {
            scene: scene.name.clone(),
            stone: listed(scene, |p| {
                format!("of {} facets ({:08x})", p.stone.facet_count(), stone_checksum(p))
            }),
            material: listed(scene, substance),
            polarised: listed(scene, |p| (if p.polarised { "on" } else { "off" }).into()),
            surroundings: format!("{:08x}", surroundings_checksum(scene)),
            photons: settings.photons,
            seed: settings.seed,
            caustic_stored: shots.caustic.photons.len(),
            caustic_emitted: shots.caustic.emitted,
            indirect_stored: shots.indirect.photons.len(),
            indirect_emitted: shots.indirect.emitted,
        }
    }

    /// The first thing in which a stored map differs from the wanted one.
    fn difference(&self, wanted: &MapProvenance) -> Option<(&'static str, String, String)> {
        let pairs = [
            ("the scene", &self.scene, &wanted.scene),
            ("the stone", &self.stone, &wanted.stone),
            ("the material", &self.material, &wanted.material),
            ("--polarisation", &self.polarised, &wanted.polarised),
            ("the surroundings", &self.surroundings, &wanted.surroundings),
            ("--photons", &self.photons.to_string(), &wanted.photons.to_string()),
            ("--seed", &self.seed.to_string(), &wanted.seed.to_string()),
        ];
        pairs.into_iter().find(|(_, a, b)| a != b).map(|(what, a, b)| (what, a.clone(), b.clone()))
    }
}

/// Descriptions of all stones, joined.
fn listed(scene: &Scene, say: impl Fn(&PlacedStone) -> String) -> String {
    scene.stones.iter().map(say).collect::<Vec<_>>().join(" and ")
}

/// Checksum of the stone's shape, size and place.
fn stone_checksum(placed: &PlacedStone) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    for v in &placed.stone.solid.vertices {
        let world = placed.point_to_world(placed.stone.point_from_design(*v).as_vec3());
        world.to_array().iter().for_each(|x| crc.update(&x.to_le_bytes()));
    }
    crc.finalize()
}

/// The material with a checksum of the laws by which it refracts and absorbs, and with the size of
/// the stone if its colour depends on it.
fn substance(placed: &PlacedStone) -> String {
    let material = &placed.material;
    let laws = crc32fast::hash(format!("{:?} {:?}", material.dispersion, material.absorption).as_bytes());
    let radius = format!(", {:.6} mm in radius", placed.stone.unit);
    format!("{} ({laws:08x}{})", material.name, if material.is_clear() { "" } else { &radius })
}

/// Checksum of everything that a picture of the scene shows: stones, surroundings, camera.
pub fn checksum(scene: &Scene) -> u32 {
    let stones = listed(scene, |p| format!("{:08x} {} {}", stone_checksum(p), substance(p), p.polarised));
    crc32fast::hash(format!("{stones} {:08x} {:?}", surroundings_checksum(scene), scene.camera).as_bytes())
}

/// Checksum of surfaces and lights.
fn surroundings_checksum(scene: &Scene) -> u32 {
    crc32fast::hash(format!("{:?} {:?} {:?}", scene.surfaces, scene.lights, scene.depth).as_bytes())
}

/// The photons of a scene: read from `path` if it exists and fits, else emitted and written there.
///
/// Returns the photons and whether they were read. Checked in this file's tests and in `tests/library/render.rs`.
pub fn load_or_emit(
    path: &Path,
    scene: &Scene,
    settings: &PhotonSettings,
    limits: Limits,
) -> Result<(PhotonSets, bool), MapFileError> {
    let unusable = |problem| MapFileError::Unusable { path: path.into(), problem };
    match bounded_read::read_regular(path, limits, &limits::PHOTON_MAP) {
        Ok(bytes) => {
            let bytes = bytes.map_err(|e| unusable(e.to_string()))?;
            let (origin, shots) = decode(&bytes).map_err(unusable)?;
            let wanted = MapProvenance::new(scene, settings, &shots);
            if let Some((what, made_for, wanted)) = origin.difference(&wanted) {
                return Err(MapFileError::DifferentScene { path: path.into(), what, made_for, wanted });
            }
            Ok((shots, true))
        }
        Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => {
            let shots = PhotonSets::emit(scene, settings);
            atomic_write::write(path, &encode(&MapProvenance::new(scene, settings, &shots), &shots))?;
            Ok((shots, false))
        }
        Err(cause) => Err(MapFileError::Read { path: path.into(), cause }),
    }
}

fn encode(origin: &MapProvenance, shots: &PhotonSets) -> Vec<u8> {
    // plain strings and numbers cannot fail to serialise
    let header = serde_json::to_vec(origin).unwrap_or_default();
    let mut bytes = Vec::from(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend((header.len() as u32).to_le_bytes());
    bytes.extend(header);
    for p in shots.caustic.photons.iter().chain(&shots.indirect.photons) {
        p.point.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend(p.power.to_le_bytes());
        bytes.extend(p.tint);
        bytes.extend(p.surface.to_le_bytes());
        bytes.push(p.front.into());
        bytes.extend(p.normal.map(|x| x.to_le_bytes()[0]));
    }
    let crc = crc32fast::hash(&bytes);
    bytes.extend(crc.to_le_bytes());
    bytes
}

/// Reads a stored map; the error says what is wrong with it.
pub fn decode(bytes: &[u8]) -> Result<(MapProvenance, PhotonSets), String> {
    if !bytes.starts_with(MAGIC) {
        return Err("it does not begin as one".into());
    }
    let word = |at: usize| bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let cut_short = || "it is cut short".to_string();
    let version = word(8).ok_or_else(cut_short)?;
    if version != VERSION {
        return Err(format!("its version is {version}, this program reads {VERSION}"));
    }
    let end = bytes.len() - 4;
    if word(end) != Some(crc32fast::hash(&bytes[..end])) {
        return Err("its checksum does not match, it is damaged or cut short".into());
    }
    let header_len = word(12).ok_or_else(cut_short)? as usize;
    let header = bytes.get(16..16 + header_len.min(HEADER_LIMIT)).ok_or_else(cut_short)?;
    let origin: MapProvenance =
        serde_json::from_slice(header).map_err(|e| format!("its header is unreadable ({e})"))?;
    let body = bytes.get(16 + header.len()..end).ok_or_else(cut_short)?;
    let photons: Vec<StoredPhoton> = body.chunks_exact(PHOTON).filter_map(photon).collect();
    let stored = origin.caustic_stored.checked_add(origin.indirect_stored);
    if stored != Some(photons.len()) || body.len() != photons.len() * PHOTON {
        return Err(format!("it holds {} photons where its header says {stored:?}", photons.len()));
    }
    let (caustic, indirect) = photons.split_at(origin.caustic_stored);
    let shots = PhotonSets {
        caustic: PhotonSet { photons: caustic.to_vec(), emitted: origin.caustic_emitted },
        indirect: PhotonSet { photons: indirect.to_vec(), emitted: origin.indirect_emitted },
    };
    Ok((origin, shots))
}

/// One photon; none if a number in it is impossible.
fn photon(b: &[u8]) -> Option<StoredPhoton> {
    let float = |at: usize| b.get(at..at + 4)?.try_into().ok().map(f32::from_le_bytes);
    let point = Vec3::new(float(0)?, float(4)?, float(8)?);
    let power = float(12)?;
    let tint: [u8; BANDS] = b.get(16..24)?.try_into().ok()?;
    let surface = u16::from_le_bytes(b.get(24..26)?.try_into().ok()?);
    let front = *b.get(26)? != 0;
    let normal: [u8; 3] = b.get(27..30)?.try_into().ok()?;
    let normal = normal.map(|x| i8::from_le_bytes([x]));
    let possible = point.is_finite() && power.is_finite();
    possible.then_some(StoredPhoton { point, power, tint, surface, front, normal })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> (MapProvenance, PhotonSets) {
        let photon = |i: usize| StoredPhoton {
            point: Vec3::new(i as f32, 0.5, -1.0),
            power: 0.25 * i as f32,
            surface: i as u16,
            tint: [i as u8; BANDS],
            front: i.is_multiple_of(2),
            normal: [0, -127, i as i8],
        };
        let shots = PhotonSets {
            caustic: PhotonSet { photons: (0..5).map(photon).collect(), emitted: 77 },
            indirect: PhotonSet { photons: (5..8).map(photon).collect(), emitted: 88 },
        };
        let origin = MapProvenance {
            scene: "table".into(),
            stone: "s".into(),
            material: "m".into(),
            polarised: "on".into(),
            surroundings: "r".into(),
            photons: 5,
            seed: 1,
            caustic_stored: 5,
            caustic_emitted: 77,
            indirect_stored: 3,
            indirect_emitted: 88,
        };
        (origin, shots)
    }

    #[test]
    fn a_map_comes_back_as_it_was() {
        let (origin, shots) = sample();
        assert_eq!(decode(&encode(&origin, &shots)), Ok((origin, shots)));
    }

    #[test]
    fn every_truncation_and_every_flipped_byte_is_found() {
        let (origin, shots) = sample();
        let bytes = encode(&origin, &shots);
        for len in 0..bytes.len() {
            assert!(decode(&bytes[..len]).is_err(), "cut at {len}");
            let mut flipped = bytes.clone();
            flipped[len] ^= 0x10;
            assert!(decode(&flipped).is_err(), "flipped {len}");
        }
    }
}
