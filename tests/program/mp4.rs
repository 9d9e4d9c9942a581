//! Films: the boxes of an MP4 file are where players look for them, its frames decode to those that went
//! in, the same frames are the same bytes, and memory does not grow with their number.

use crate::bench::Bench;
use cutlab::advanced::integrators::animation::{self, FrameTiming};
use cutlab::advanced::integrators::image_io::Provenance;
use cutlab::advanced::integrators::mp4;
use mp4_atom::{Any, Atom, Codec, Colr, Decode, DecodeAtom, Header, Ilst, Mdat, Moov, StszSamples};
use openh264::decoder::Decoder;
use openh264::formats::YUVSource;

const SIZE: (u32, u32) = (64, 48);
const MADE: Provenance =
    Provenance { command: "cutlab render 'a b.asc'", request: None, identity: None, rounds: None };

/// A frame of soft colours that wander.
fn frame(number: u32) -> Vec<u8> {
    let wave = |x: f32| (127.5 + 110.0 * (x + 0.3 * number as f32).sin()) as u8;
    let pixel = |x: u32, y: u32| [wave(x as f32 / 9.0), wave(y as f32 / 11.0), wave((x + y) as f32 / 13.0)];
    (0..SIZE.1).flat_map(|y| (0..SIZE.0).flat_map(move |x| pixel(x, y))).collect()
}

fn film(frames: u32, pace: FrameTiming) -> Vec<u8> {
    let mut out = Vec::new();
    mp4::mp4(&mut (0..frames).map(|n| Ok(frame(n))), SIZE, pace, MADE, &mut out).expect("encodes");
    out
}

/// Boxes of a file: kind, where the content begins, the content.
fn boxes(file: &[u8]) -> Vec<(Header, usize, &[u8])> {
    let mut found = Vec::new();
    let mut rest = file;
    while !rest.is_empty() {
        let header = Header::decode(&mut rest).expect("is a box");
        let at = file.len() - rest.len();
        let (content, after) = rest.split_at(header.size.expect("has a size"));
        found.push((header, at, content));
        rest = after;
    }
    found
}

fn index(file: &[u8]) -> Moov {
    let (header, _, mut content) = boxes(file)[1];
    Moov::decode_atom(&header, &mut content).expect("is an index")
}

#[test]
fn the_index_stands_before_the_frames_and_leads_to_them() {
    let file = film(60, FrameTiming::of_rate(24));
    let kinds: Vec<_> = boxes(&file).iter().map(|(header, ..)| header.kind).collect();
    assert_eq!(kinds, [mp4_atom::Ftyp::KIND, Moov::KIND, Mdat::KIND]);
    let moov = index(&file);
    let track = &moov.trak[0];
    let stbl = &track.mdia.minf.stbl;
    let (_, data_at, data) = boxes(&file)[2];
    assert_eq!(stbl.stco.as_ref().expect("is near").entries, [data_at as u32]);
    let StszSamples::Different { sizes } = &stbl.stsz.samples else { unreachable!("they differ") };
    assert_eq!((sizes.len(), sizes.iter().sum::<u32>() as usize), (60, data.len()));
    let keys = &stbl.stss.as_ref().expect("some stand alone").entries;
    assert!(keys[0] == 1 && keys.len() == 2, "{keys:?}");
    // 60 frames at 24 a second
    assert_eq!((track.mdia.mdhd.timescale, track.mdia.mdhd.duration), (24, 60));
    assert_eq!((stbl.stts.entries[0].sample_count, stbl.stts.entries[0].sample_delta), (60, 1));
    let Codec::Avc1(codec) = &stbl.stsd.codecs[0] else { unreachable!("is H.264") };
    assert_eq!((u32::from(codec.visual.width), u32::from(codec.visual.height)), SIZE);
    assert_eq!(codec.avcc.avc_profile_indication, 77, "Main, which every browser plays");
    let bt709 = Colr::Nclx {
        colour_primaries: 1,
        transfer_characteristics: 1,
        matrix_coefficients: 1,
        full_range_flag: false,
    };
    assert_eq!(codec.colr, Some(bt709));
    let meta = moov.udta.and_then(|u| u.meta).expect("has words");
    let words = meta.items.iter().find_map(|i| if let Any::Ilst(words) = i { Some(words) } else { None });
    let words: &Ilst = words.expect("has words");
    assert_eq!(words.desc.as_ref().expect("has a command").text, MADE.command);
}

/// Luma of BT.709 within its limits, of every pixel of every frame, and the means of its chromas.
#[test]
fn frames_come_out_as_they_went_in() {
    let file = film(30, FrameTiming::of_turn(30));
    let moov = index(&file);
    let stbl = &moov.trak[0].mdia.minf.stbl;
    let Codec::Avc1(codec) = &stbl.stsd.codecs[0] else { unreachable!("is H.264") };
    let StszSamples::Different { sizes } = &stbl.stsz.samples else { unreachable!("they differ") };
    let (_, _, mut data) = boxes(&file)[2];
    let behind_code = |unit: &[u8]| [&[0, 0, 0, 1], unit].concat();
    let mut decoder = Decoder::new().expect("starts");
    let mut shown = 0;
    for (number, size) in sizes.iter().enumerate() {
        let (mut sample, rest) = data.split_at(*size as usize);
        data = rest;
        let mut stream = Vec::new();
        if number == 0 {
            stream.extend(behind_code(&codec.avcc.sequence_parameter_sets[0]));
            stream.extend(behind_code(&codec.avcc.picture_parameter_sets[0]));
        }
        while let Some((length, unit)) = sample.split_first_chunk::<4>() {
            let (unit, rest) = unit.split_at(u32::from_be_bytes(*length) as usize);
            stream.extend(behind_code(unit));
            sample = rest;
        }
        let Some(yuv) = decoder.decode(&stream).expect("decodes") else { continue };
        let rgb = frame(shown);
        let mut off = 0.0;
        for (i, p) in rgb.chunks_exact(3).enumerate() {
            let [r, g, b] = [0, 1, 2].map(|c| f64::from(p[c]) / 255.0);
            let luma = 16.0 + 219.0 * (0.2126 * r + 0.7152 * g + 0.0722 * b);
            let (x, y) = (i % SIZE.0 as usize, i / SIZE.0 as usize);
            off += (f64::from(yuv.y()[y * yuv.strides().0 + x]) - luma).powi(2);
        }
        let rms = (off / f64::from(SIZE.0 * SIZE.1)).sqrt();
        assert!(rms < 2.5, "frame {shown}: {rms}");
        shown += 1;
    }
    assert!(shown >= 29, "{shown} of 30 come out before the end");
}

#[test]
fn the_same_frames_are_the_same_bytes() {
    assert_eq!(film(12, FrameTiming::of_rate(30)), film(12, FrameTiming::of_rate(30)));
}

#[test]
fn memory_of_an_animation_is_that_of_a_frame() {
    let most = |frames: u32, write: &dyn Fn(&mut animation::Frames, u32)| {
        write(&mut (0..2).map(|n| Ok(frame(n))), 2); // what is made once
        allocation_counter::measure(|| write(&mut (0..frames).map(|n| Ok(frame(n))), frames)).bytes_max
    };
    let pace = FrameTiming::of_rate(25);
    let gif = |frames: &mut animation::Frames, _| {
        animation::gif(frames, SIZE, pace, &mut std::io::sink()).expect("encodes")
    };
    let apng = |frames: &mut animation::Frames, n| {
        animation::apng(frames, n, SIZE, false, pace, MADE, &mut std::io::sink()).expect("encodes")
    };
    let mp4 = |frames: &mut animation::Frames, _| {
        mp4::mp4(frames, SIZE, pace, MADE, &mut std::io::sink()).expect("encodes")
    };
    let one = u64::from(3 * SIZE.0 * SIZE.1);
    for (name, write) in
        [("gif", &gif as &dyn Fn(&mut animation::Frames, u32)), ("apng", &apng), ("mp4", &mp4)]
    {
        let (few, many) = (most(4, write), most(200, write));
        assert!(many < few + one, "{name}: {few} bytes for 4 frames, {many} for 200");
    }
}

#[test]
fn a_film_of_the_command_line_is_made_once_and_again() {
    let bench = Bench::new();
    let arguments = [
        "render",
        "-q",
        "cube",
        "--width",
        "33",
        "--height",
        "24",
        "--spp",
        "1",
        "--photons",
        "100",
        "--frames",
        "5",
        "--fps",
        "10",
        "-o",
        "a.mp4",
    ];
    let (_, problem) = bench.ends(2, &arguments);
    assert!(problem.contains("--width 34"), "{problem}");
    let even = arguments.map(|word| if word == "33" { "34" } else { word });
    assert_eq!(bench.good(&even), "", "the encoder says nothing");
    let first = std::fs::read(bench.path("a.mp4")).expect("was written");
    assert_eq!(bench.names(), ["a.mp4"]);
    bench.good(&even);
    assert_eq!(std::fs::read(bench.path("a.mp4")).expect("was written"), first);
    let moov = index(&first);
    assert_eq!((moov.mvhd.timescale, moov.mvhd.duration), (10, 5));
    // the smallest and the fastest, and one that takes half a minute
    for (side, frames, fps) in [("16", "3", "120"), ("18", "30", "1")] {
        let name = format!("{side}.mp4");
        let size = ["--width", side, "--height", side, "--frames", frames, "--fps", fps, "-o", name.as_str()];
        let arguments = [&["render", "-q", "cube", "--spp", "1", "--photons", "100"][..], &size].concat();
        assert_eq!(bench.good(&arguments), "");
        let moov = index(&std::fs::read(bench.path(&name)).expect("was written"));
        assert_eq!(moov.mvhd.duration.to_string(), frames);
    }
}

#[test]
fn a_turn_takes_three_to_six_seconds() {
    for (frames, seconds) in [(1, 3.0), (6, 3.0), (36, 3.0), (72, 6.0), (300, 6.0)] {
        let pace = FrameTiming::of_turn(frames);
        let lasts = f64::from(frames * pace.ticks) / f64::from(pace.ticks_per_second);
        assert!((lasts - seconds).abs() < 0.05, "{frames} frames: {lasts} s");
    }
}
