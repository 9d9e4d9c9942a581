//! Films: frames as H.264 in an MP4 file, which browsers play.
//!
//! 4:2:0 of eight bits by BT.709 in limited range, at a fixed quantiser, on one thread: the same frames
//! are the same bytes. The index (`moov`) comes before the pictures, so that a film starts to play before
//! all of it has arrived. Encoded frames wait in a temporary file: memory holds one of them.
//!
//! Source: ITU-R BT.709-6, §3; ISO/IEC 14496-12 and 14496-15. Checked in `tests/program/mp4.rs`.

use super::animation::FrameTiming;
use super::image_io::{EncodeError, PROGRAM, Provenance};
use mp4_atom::{
    Atom, Avc1, Avcc, Co64, Codec, Colr, Compressor, Desc, Dinf, Dref, Encode, FixedPoint, Ftyp, Hdlr,
    Header, Ilst, Mdat, Mdhd, Mdia, Meta, Minf, Moov, Mvhd, Stbl, Stco, Stsc, StscEntry, Stsd, Stss, Stsz,
    StszSamples, Stts, SttsEntry, Tkhd, Tool, Trak, Udta, Url, Visual, Vmhd,
};
use openh264::OpenH264API;
use openh264::encoder::{
    BitRate, Complexity, Encoder, EncoderConfig, FrameRate, IntraFramePeriod, Profile, QpRange,
    RateControlMode, VuiConfig,
};
use openh264::formats::YUVSource;
use std::io::{Read, Seek, Write};

/// Sides of a film, in pixels: what the encoder takes. They are even, for four pixels share a colour.
pub const SIDES: std::ops::RangeInclusive<u32> = 16..=3840;
/// Most pixels of the shorter side.
pub const SHORTER_SIDE: u32 = 2160;

/// Quantiser: steps of luma so fine that facets keep their edges.
const QUANTISER: u8 = 18;
/// Most frames in a second that the encoder is told of; players go by the file's.
const FASTEST: f32 = 60.0;
/// Frames from one that stands alone to the next.
const KEY_FRAMES: u32 = 48;

/// Types of parts of the stream: parameters of the sequence, parameters of pictures.
const SPS: u8 = 7;
const PPS: u8 = 8;
/// A picture that stands alone.
const IDR: u8 = 5;

/// Writes a film of the frames.
///
/// - `frames`: 8-bit sRGB bytes, row after row
pub fn mp4(
    frames: &mut dyn Iterator<Item = Result<Vec<u8>, EncodeError>>,
    (width, height): (u32, u32),
    pace: FrameTiming,
    made: Provenance,
    out: &mut dyn Write,
) -> Result<(), EncodeError> {
    // by buffer, whose state nobody reports: the quantiser is the one of its range, no frame is left out
    let config = EncoderConfig::new()
        .rate_control_mode(RateControlMode::Bufferbased)
        .bitrate(BitRate::from_bps(bits_per_second(width, height, pace)))
        .qp(QpRange::new(QUANTISER, QUANTISER))
        .skip_frames(false)
        .scene_change_detect(false)
        .adaptive_quantization(false)
        .background_detection(false)
        .complexity(Complexity::High)
        .profile(Profile::Main)
        .max_frame_rate(FrameRate::from_hz(pace.per_second().clamp(1.0, FASTEST)))
        .intra_frame_period(IntraFramePeriod::from_num_frames(KEY_FRAMES))
        .num_threads(1)
        .vui(VuiConfig::bt709());
    let mut encoder = Encoder::with_api_config(OpenH264API::from_source(), config)?;
    let mut film = Mp4Samples { sizes: Vec::new(), keys: Vec::new(), sps: Vec::new(), pps: Vec::new() };
    let mut kept = tempfile::tempfile()?;
    for rgb in frames {
        let stream = encoder.encode(&YuvPlanes::from_rgb(&rgb?, width as usize, height as usize))?;
        let layers = (0..stream.num_layers()).filter_map(|i| stream.layer(i));
        let units = layers.flat_map(|layer| {
            (0..layer.nal_count()).filter_map(|i| layer.nal_unit(i).map(<[u8]>::to_vec)).collect::<Vec<_>>()
        });
        film.add(units, &mut kept)?;
    }
    kept.rewind()?;
    film.write(width, height, pace, made, &mut kept, out)
}

/// The rate that the encoder sets the stream's level by: two bits a pixel is what frames of facets take at
/// this quantiser. The rate is not kept to.
fn bits_per_second(width: u32, height: u32, pace: FrameTiming) -> u32 {
    const BITS_PER_PIXEL: f32 = 2.0;
    /// Of level 5.2.
    const MOST: f32 = 240e6;
    (BITS_PER_PIXEL * (width * height) as f32 * pace.per_second()).clamp(1e5, MOST) as u32
}

/// What is known of the encoded frames.
struct Mp4Samples {
    sizes: Vec<u32>,
    /// Numbers, from 1, of those that stand alone.
    keys: Vec<u32>,
    sps: Vec<u8>,
    pps: Vec<u8>,
}

impl Mp4Samples {
    /// Adds a frame: each of its parts behind its length.
    ///
    /// - `units`: each behind a start code, as Annex B of the standard has it
    fn add(&mut self, units: impl Iterator<Item = Vec<u8>>, kept: &mut dyn Write) -> Result<(), EncodeError> {
        let mut sample = Vec::new();
        let mut stands_alone = false;
        for unit in units {
            let code = unit.iter().take_while(|b| **b == 0).count() + 1;
            let Some(body @ [first, ..]) = unit.get(code..) else { continue };
            match first & 0x1f {
                SPS => self.sps = body.to_vec(),
                PPS => self.pps = body.to_vec(),
                kind => {
                    stands_alone |= kind == IDR;
                    sample.extend((body.len() as u32).to_be_bytes());
                    sample.extend(body);
                }
            }
        }
        kept.write_all(&sample)?;
        self.sizes.push(sample.len() as u32);
        if stands_alone {
            self.keys.push(self.sizes.len() as u32);
        }
        Ok(())
    }

    fn write(
        &self,
        width: u32,
        height: u32,
        pace: FrameTiming,
        made: Provenance,
        kept: &mut dyn Read,
        out: &mut dyn Write,
    ) -> Result<(), EncodeError> {
        let brand = |name: &[u8; 4]| name.into();
        let begin = Ftyp {
            major_brand: brand(b"isom"),
            minor_version: 0x200,
            compatible_brands: [b"isom", b"iso2", b"avc1", b"mp41"].map(brand).to_vec(),
        };
        let total: u64 = self.sizes.iter().map(|n| u64::from(*n)).sum();
        let mut data = Vec::new();
        Header { kind: Mdat::KIND, size: Some(total as usize) }.encode(&mut data)?;
        let mut head = Vec::new();
        begin.encode(&mut head)?;
        // the index is as long wherever it says that the pictures are
        let far = total > u64::from(u32::MAX / 2);
        let mut index = Vec::new();
        self.index(width, height, pace, made, 0, far)?.encode(&mut index)?;
        let at = (head.len() + index.len() + data.len()) as u64;
        self.index(width, height, pace, made, at, far)?.encode(&mut head)?;
        out.write_all(&head)?;
        out.write_all(&data)?;
        std::io::copy(kept, out)?;
        Ok(())
    }

    /// - `at`: byte of the file where the first frame is; `far`: whether it may lie beyond 32 bits
    fn index(
        &self,
        width: u32,
        height: u32,
        pace: FrameTiming,
        made: Provenance,
        at: u64,
        far: bool,
    ) -> Result<Moov, EncodeError> {
        let count = self.sizes.len() as u32;
        let duration = u64::from(count) * u64::from(pace.ticks);
        let timescale = pace.ticks_per_second;
        let text = |text: &str| text.to_owned();
        let visual = Visual {
            data_reference_index: 1,
            width: width.next_multiple_of(2) as u16,
            height: height.next_multiple_of(2) as u16,
            horizresolution: FixedPoint::from(72),
            vertresolution: FixedPoint::from(72),
            frame_count: 1,
            compressor: Compressor::from("H.264"),
            depth: 24,
        };
        let colr = Colr::Nclx {
            colour_primaries: 1,
            transfer_characteristics: 1,
            matrix_coefficients: 1,
            full_range_flag: false,
        };
        let (width, height) = (visual.width, visual.height);
        let avcc = Avcc::new(&self.sps, &self.pps)?;
        let codec = Codec::Avc1(Avc1 { visual, avcc, colr: Some(colr), ..Avc1::default() });
        let stbl = Stbl {
            stsd: Stsd { codecs: vec![codec] },
            stts: Stts { entries: vec![SttsEntry { sample_count: count, sample_delta: pace.ticks }] },
            stss: Some(Stss { entries: self.keys.clone() }),
            stsc: Stsc {
                entries: vec![StscEntry {
                    first_chunk: 1,
                    samples_per_chunk: count,
                    sample_description_index: 1,
                }],
            },
            stsz: Stsz { samples: StszSamples::Different { sizes: self.sizes.clone() } },
            stco: (!far).then(|| Stco { entries: vec![at as u32] }),
            co64: far.then(|| Co64 { entries: vec![at] }),
            ..Stbl::default()
        };
        let track = Trak {
            tkhd: Tkhd {
                track_id: 1,
                duration,
                enabled: true,
                in_movie: true,
                width: FixedPoint::from(width),
                height: FixedPoint::from(height),
                ..Tkhd::default()
            },
            mdia: Mdia {
                mdhd: Mdhd { timescale, duration, language: text("und"), ..Mdhd::default() },
                hdlr: Hdlr { handler: b"vide".into(), name: text("film") },
                minf: Minf {
                    vmhd: Some(Vmhd::default()),
                    dinf: Dinf { dref: Dref { entries: vec![Url::default().into()] } },
                    stbl,
                    ..Minf::default()
                },
            },
            ..Trak::default()
        };
        let words = Ilst {
            ctoo: Some(Tool { country_indicator: 0, language_indicator: 0, text: text(PROGRAM) }),
            desc: Some(Desc { country_indicator: 0, language_indicator: 0, text: text(made.command) }),
            ..Ilst::default()
        };
        let mut meta =
            Meta { hdlr: Hdlr { handler: b"mdir".into(), name: String::new() }, items: Vec::new() };
        meta.push(words);
        Ok(Moov {
            mvhd: Mvhd {
                timescale,
                duration,
                next_track_id: 2,
                rate: FixedPoint::from(1),
                ..Mvhd::default()
            },
            trak: vec![track],
            udta: Some(Udta { meta: Some(meta), ..Udta::default() }),
            ..Moov::default()
        })
    }
}

/// A frame as luma and two chromas of half the size.
struct YuvPlanes {
    size: (usize, usize),
    luma: Vec<u8>,
    blue: Vec<u8>,
    red: Vec<u8>,
}

impl YuvPlanes {
    /// Of 8-bit RGB bytes. A last column or row is doubled where their number is odd.
    fn from_rgb(rgb: &[u8], width: usize, height: usize) -> YuvPlanes {
        let (w, h) = (width.next_multiple_of(2), height.next_multiple_of(2));
        let pixel = |x: usize, y: usize| -> [f32; 3] {
            let at = 3 * (y.min(height - 1) * width + x.min(width - 1));
            [0, 1, 2].map(|c| f32::from(rgb.get(at + c).copied().unwrap_or_default()) / 255.0)
        };
        let luma_of = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let mut planes = YuvPlanes {
            size: (w, h),
            luma: Vec::with_capacity(w * h),
            blue: Vec::with_capacity(w * h / 4),
            red: Vec::with_capacity(w * h / 4),
        };
        for (x, y) in (0..h).flat_map(|y| (0..w).map(move |x| (x, y))) {
            planes.luma.push((16.0 + 219.0 * luma_of(pixel(x, y))).round() as u8);
        }
        for (x, y) in (0..h).step_by(2).flat_map(|y| (0..w).step_by(2).map(move |x| (x, y))) {
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| pixel(x + i, y + j));
            let mean = [0, 1, 2].map(|c| four.iter().map(|p| p[c]).sum::<f32>() / 4.0);
            let luma = luma_of(mean);
            planes.blue.push((128.0 + 224.0 * (mean[2] - luma) / 1.8556).round() as u8);
            planes.red.push((128.0 + 224.0 * (mean[0] - luma) / 1.5748).round() as u8);
        }
        planes
    }
}

impl YUVSource for YuvPlanes {
    fn dimensions(&self) -> (usize, usize) {
        self.size
    }

    fn strides(&self) -> (usize, usize, usize) {
        (self.size.0, self.size.0 / 2, self.size.0 / 2)
    }

    fn y(&self) -> &[u8] {
        &self.luma
    }

    fn u(&self) -> &[u8] {
        &self.blue
    }

    fn v(&self) -> &[u8] {
        &self.red
    }
}
