//! Materials and illuminants that users bring: every form of the file, in every place where one is named.

use crate::bench::{Bench, text};
use cutlab::advanced::limits::Limits;
use cutlab::advanced::materials::{MATERIAL_FILES, Material};
use cutlab::advanced::optics::dispersion::{VISIBLE_NM, lines};
use cutlab::advanced::optics::fresnel::unpolarised;
use cutlab::advanced::parse::data_file::DataFileError;
use cutlab::advanced::scene::{SceneFile, SceneOverrides};
use cutlab::{Stone, StoneOptions};
use std::fs;
use std::path::{Path, PathBuf};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/materials").join(name)
}

/// A material of one index law, with what its file has beside it.
fn parse(rest: &str) -> Result<Material, DataFileError> {
    Material::parse("my.toml", &format!("name = \"my stone\"\n{rest}\n"), &|_| Err("there is none".into()))
}

fn of_table(absorption: &str, table: &str) -> Result<Material, DataFileError> {
    let text =
        format!("name = \"my stone\"\n[index]\nn-d = 1.77\n[absorption]\ntable = \"t.csv\"\n{absorption}\n");
    Material::parse("my.toml", &text, &|name| {
        if name == "t.csv" { Ok(table.into()) } else { Err("none".into()) }
    })
}

/// [D] Every law by its formula, at the D line; λ² = 0.347267 µm².
#[test]
fn every_law_gives_its_index() {
    let l2 = (lines::D / 1000.0).powi(2);
    for (index, n) in [
        ("n-d = 1.746", 1.746),
        ("n-d = 1.746\nb-g = 0.022", 1.746),
        (
            "sellmeier = [[1.2, 0.1], [0.3, 9]]",
            (1.0 + 1.2 * l2 / (l2 - 0.01) + 0.3 * l2 / (l2 - 81.0)).sqrt(),
        ),
        ("constant = 0.5\nsellmeier = [[1.2, 0.1]]", (1.5 + 1.2 * l2 / (l2 - 0.01)).sqrt()),
        ("sellmeier-squared = [[1.2, 0.01]]", (1.0 + 1.2 * l2 / (l2 - 0.01)).sqrt()),
        ("cauchy = [1.6]", 1.6),
        ("cauchy = [1.6, 0.005]", 1.6 + 0.005 / l2),
        ("cauchy = [1.6, 0.005, 1e-4]", 1.6 + 0.005 / l2 + 1e-4 / (l2 * l2)),
        ("resonance = [2.5, 0.02, 0.01, -0.01]", (2.5 + 0.02 / (l2 - 0.01) - 0.01 * l2).sqrt()),
        ("steps = [[500, 1.7], [inf, 1.6]]", 1.6),
        ("table = [[400, 1.7], [589.294, 1.65], [700, 1.64]]", 1.65),
        ("wavelength = \"um\"\ntable = [[0.4, 1.7], [0.589294, 1.65], [0.7, 1.64]]", 1.65),
        ("wavelength = \"per-cm\"\ntable = [[25000, 1.7], [14000, 1.7]]", 1.7),
    ] {
        let material = parse(&format!("[index]\n{index}")).unwrap_or_else(|e| panic!("{index}: {e}"));
        assert!((material.index_d() - n).abs() < 1e-12, "{index}: {}", material.index_d());
        assert!(material.is_clear() && material.specific_gravity.is_none() && material.crystal.is_none());
    }
    let dispersive = parse("[index]\nn-d = 1.746\nb-g = 0.022").expect("a law");
    assert!((dispersive.index(lines::G) - dispersive.index(lines::B) - 0.022).abs() < 1e-12);
    assert_eq!(dispersive.valid_nm, (lines::G, lines::B));
    let table = parse("[index]\ntable = [[400, 1.7], [700, 1.6]]").expect("a table");
    assert_eq!(table.valid_nm, (400.0, 700.0));
    let note = table.extrapolated(380.0, 730.0);
    assert_eq!(note.as_deref(), Some("index of my stone extrapolated below 400 nm and above 700 nm"));
}

/// [D] One spectrum, written as every kind of spectrometer writes it, is one absorption.
#[test]
fn every_form_of_a_spectrum_gives_the_same_absorption() {
    const PATH_MM: f64 = 2.5;
    let per_mm = |nm: f64| 0.4 * (-((nm - 550.0) / 60.0).powi(2)).exp() + 0.01;
    let grid = || (38..=75).map(|i| 10.0 * f64::from(i));
    let r = unpolarised(1.0, 1.77).0;
    let crossing = |nm: f64| (-per_mm(nm) * PATH_MM).exp();
    let measured = |nm: f64| (1.0 - r).powi(2) * crossing(nm) / (1.0 - (r * crossing(nm)).powi(2));
    let rows = |value: &dyn Fn(f64) -> f64, line: &dyn Fn(f64, f64) -> String| {
        grid().map(|nm| line(nm, value(nm)) + "\n").collect::<String>()
    };
    let comma = |x: f64| x.to_string().replace('.', ",");
    let path = "path-mm = 2.5";
    let surface = "path-mm = 2.5\nincludes-surface-losses = true";
    let forms: [(&str, &str, String); 9] = [
        ("per-mm", "", rows(&per_mm, &|nm, a| format!("{nm},{a}"))),
        ("per-cm", "", rows(&|nm| 10.0 * per_mm(nm), &|nm, a| format!("{nm}\t{a}"))),
        (
            "absorbance",
            path,
            rows(&|nm| -crossing(nm).log10(), &|nm, a| format!("{};{}", comma(nm), comma(a))),
        ),
        ("transmittance", path, rows(&crossing, &|nm, t| format!("  {nm}   {t}"))),
        ("percent-transmittance", path, rows(&|nm| 100.0 * crossing(nm), &|nm, t| format!("{nm};{t}"))),
        ("transmittance", surface, rows(&measured, &|nm, t| format!("{nm},{t}"))),
        (
            "absorbance",
            surface,
            rows(&|nm| -measured(nm).log10(), &|nm, a| format!("{} {}", comma(nm), comma(a))),
        ),
        (
            "per-mm",
            "wavelength = \"um\"",
            format!("# by hand\nmicrometres, a\n{}", rows(&per_mm, &|nm, a| format!("{},{a}", nm / 1000.0))),
        ),
        (
            "per-mm",
            "wavelength = \"per-cm\"\ncolumns = [1, 3]",
            rows(&per_mm, &|nm, a| format!("{},7,{a}", 1e7 / nm)),
        ),
    ];
    for (quantity, rest, table) in forms {
        let settings = format!("quantity = \"{quantity}\"\n{rest}");
        let material = of_table(&settings, &table).unwrap_or_else(|e| panic!("{quantity}: {e}"));
        // beyond the visible the last row holds
        for nm in grid().filter(|nm| *nm <= VISIBLE_NM.1) {
            let a = material.absorption_per_mm(nm);
            assert!((a - per_mm(nm)).abs() < 1e-9, "{quantity} {rest} at {nm}: {a}");
        }
        // between the rows the curve follows the spectrum
        let between = (385..=725).step_by(10).map(f64::from);
        let worst = between.map(|nm| (material.absorption_per_mm(nm) - per_mm(nm)).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-3, "{quantity}: {worst}");
    }
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    const INDEX: &str = "[index]\nn-d = 1.6";
    for (rest, said) in [
        ("", "my.toml, line 1: the key 'index' is missing"),
        ("[index]\nn_d = 1.6", "line 3: the key 'n_d' is not known here"),
        (
            "[index]\nn-d = 0.9",
            "line 3: n-d: expected an index from 1 to 10 at 380 to 730 nm, found 0.9 at 380 nm",
        ),
        ("[index]\nn-d = 1.6\ncauchy = [1.6]", "line 4: cauchy: expected one of"),
        ("[index]", "line 2: index: expected one of"),
        ("[index]\nb-g = 0.02\ncauchy = [1.6]", "line 3: b-g: expected n-d beside it"),
        ("[index]\nn-d = 1.6\nb-g = -0.02", "line 4: b-g: expected a difference of indices from 0 to 1"),
        ("[index]\nsellmeier = [[1.2, 0.5]]", "line 3: sellmeier: expected an index from 1 to 10"),
        ("[index]\nsellmeier = []", "line 3: sellmeier: expected 1 to 20 entries"),
        ("[index]\ntable = [[400, 1.6], [390, 1.5], [500, 1.4]]", "found 390 nm in row 2"),
        (
            "[index]\ntable = \"nowhere.csv\"",
            "line 3: table: expected a table beside the file, found 'nowhere.csv': there is none",
        ),
        (
            "[index]\ntable = 7",
            "line 3: a list of pairs [wavelength, value], or a file's name in quotes is needed",
        ),
        ("[index]\nsteps = [[600, 1.6], [500, 1.7]]", "line 3: steps: expected rising wavelengths"),
        (
            &format!("specific-gravity = -3\n{INDEX}"),
            "line 2: specific-gravity: expected g/cm³ from 0.01 to 30, found -3",
        ),
        (
            &format!("specific-gravity = 3,5\n{INDEX}"),
            "line 2: write decimals with a point and no separators, as 3.5",
        ),
        (&format!("specifc-gravity = 3\n{INDEX}"), "did you mean 'specific-gravity'?"),
        (&format!("valid-nm = [700, 400]\n{INDEX}"), "line 2: valid-nm: expected [from, to] in nm, rising"),
        (&format!("about = \"a\\nb\"\n{INDEX}"), "line 2: about: expected one line of text"),
        (&format!("{INDEX}\n[absorption]"), "line 4: absorption: expected bands or a table, found neither"),
        (
            &format!(
                "{INDEX}\n[[absorption.band]]\ncentre-nm = 500\nhalf-widths-per-cm = [900, 900]\npeak-per-mm = -1"
            ),
            "line 7: peak-per-mm: expected an absorption coefficient above 0 in band ''",
        ),
        (
            &format!("{INDEX}\n[absorption]\ntable = [[390, 1], [710, -1]]\nquantity = \"per-mm\""),
            "line 5: table: expected an absorption coefficient of 0 or more, found -1 in row 2",
        ),
        (
            &format!("{INDEX}\n[absorption]\ntable = [[390, 1], [710, 1]]"),
            "quantity: expected per-mm, per-cm, absorbance",
        ),
        (
            &format!("{INDEX}\n[absorption]\ntable = [[390, 1], [710, 1]]\nquantity = \"per-inch\""),
            "line 6: the word 'per-inch' is not known here",
        ),
        (
            &format!("{INDEX}\n[absorption]\ntable = [[390, 1], [710, 1]]\nquantity = \"absorbance\""),
            "path-mm: expected the length of the path in mm, found none",
        ),
        (
            &format!(
                "{INDEX}\n[absorption]\ntable = [[390, 1], [710, 1]]\nquantity = \"per-mm\"\npath-mm = 2"
            ),
            "line 7: path-mm: expected absorbance or transmittance",
        ),
        (
            &format!(
                "{INDEX}\n[absorption]\ntable = [[390, 1.5], [710, 1]]\nquantity = \"transmittance\"\npath-mm = 2"
            ),
            "line 5: table: expected a transmittance from 0 to 1.000, that of a clear plate, found 1.5 in row 1",
        ),
        (
            &format!("{INDEX}\n[absorption]\ntable = [[0.39, 1], [0.71, 1]]\nquantity = \"per-mm\""),
            "expected a table from 400 to 700 nm or more, found 0.39 to 0.71 nm",
        ),
    ] {
        let error = parse(rest).expect_err(rest).to_string();
        assert!(error.contains(said) && error.lines().count() == 1, "{rest}:\n{error}\n{said}");
    }
    let name = Material::parse("my.toml", "name = \"a/b\"\n[index]\nn-d = 1.6", &|_| Err(String::new()));
    assert!(
        name.is_err_and(|e| e.to_string().starts_with("my.toml, line 1: name: expected up to 100 letters"))
    );
    let error =
        of_table("quantity = \"per-mm\"", "nm,a\n390,0\n400,x\n710,0\n").expect_err("a word").to_string();
    assert!(error.starts_with("my.toml, line 5: table: expected a wavelength and a value"), "{error}");
    assert!(error.ends_with("found '400 x' in line 3 of t.csv"), "{error}");
}

/// A spectrometer's noise in the ultraviolet and infrared refuses no spectrum; in the visible it does.
#[test]
fn rows_far_from_the_visible_do_not_count() {
    let far =
        of_table("quantity = \"per-mm\"", "200,-5\n370,0.1\n550,0.2\n740,0.1\n900,-3\n").expect("sound");
    assert!((far.absorption_per_mm(550.0) - 0.2).abs() < 1e-12 && far.absorption_per_mm(380.0) >= 0.1);
    assert!(of_table("quantity = \"per-mm\"", "370,0.1\n550,-0.2\n740,0.1\n").is_err());
}

/// [D] The sample's plate is computed from the catalogue's ruby, so that it gives its absorption back. Of a peak
/// between two rows 2 nm apart the curve leaves out up to h² f″/8 = 7e-4.
#[test]
fn a_plate_in_a_file_gives_the_absorption_that_it_was_computed_from() {
    let ruby = Material::by_name("ruby").expect("in the catalogue");
    let path = data("plate.toml");
    let mine = Material::read(&path, "plate.toml", true, Limits::default()).expect("is sound");
    assert_eq!((mine.name.as_ref(), mine.file.as_deref()), ("my ruby", Some("plate.toml")));
    assert_eq!(mine.principal_axes().map(|(law, _)| law), ruby.principal_axes().map(|(law, _)| law));
    for nm in (380..=730).map(f64::from) {
        let (a, b) = (mine.absorption_per_mm(nm), ruby.absorption_per_mm(nm));
        assert!((a - b).abs() < 1e-3, "{nm}: {a} {b}");
    }
    Material::read(&data("bands.toml"), "bands.toml", true, Limits::default()).expect("is sound");
}

fn write(bench: &Bench, name: &str, text: impl AsRef<[u8]>) {
    let path = bench.path(name);
    fs::create_dir_all(path.parent().expect("in a folder")).expect("makes a folder");
    fs::write(path, text).expect("writes");
}

/// A file of more bytes than are read of one is read within raised limits, by whichever way it is named.
#[test]
fn raised_limits_reach_the_materials_of_stones() {
    let bench = Bench::new();
    let comments = "# no two labs agree\n".repeat(1 << 18);
    write(&bench, "long.toml", format!("{comments}name = \"long\"\n[index]\nn-d = 1.7\n"));
    let file = bench.path("long.toml").display().to_string();
    let stone = format!("cube:material={file}");
    let open = |stone: &str, options: StoneOptions| Stone::open(stone, &options);
    let error = open(&stone, StoneOptions::default()).expect_err("too long").to_string();
    assert!(error.contains("CUTLAB_LIMIT"), "{error}");
    let raised = || StoneOptions::default().limits(Limits::raised(2).expect("a factor"));
    for opened in [open(&stone, raised()), open("cube", raised().material(file))] {
        assert_eq!(opened.expect("is read").material().name, "long");
    }
}

fn source(name: &str) -> &'static str {
    MATERIAL_FILES.iter().find(|(n, _)| *n == name).expect("in the catalogue").1
}

/// A material of the catalogue scores the same bytes by its name and as a file, wherever it is named.
#[test]
fn a_file_scores_as_the_catalogue_does() {
    let bench = Bench::new();
    write(&bench, "r.toml", source("ruby"));
    write(&bench, "deep/gem", source("ruby"));
    let scores = ["--metrics", "wlr,iso", "--error", "0.05", "--size", "5"];
    let table = |stone: &str, material: &[&str]| {
        bench.ends(0, &[&["score", stone], &scores[..], material].concat()).0
    };
    let wanted = table("cube", &["--material", "ruby"]);
    assert!(wanted.contains("\ncube,ruby,"), "{wanted}");
    for file in ["r.toml", "./r.toml", "deep/gem"] {
        assert_eq!(table("cube", &["--material", file]), wanted, "{file}");
    }
    let own = table("cube:material=r.toml", &[]);
    assert_eq!(own.replace("cube:material=r.toml", "cube"), wanted);
    // every other command
    let (shown, _) = bench.ends(0, &["show", "cube", "--size", "5", "--material", "r.toml"]);
    assert_eq!(shown, bench.ends(0, &["show", "cube", "--size", "5", "--material", "ruby"]).0);
    bench.ends(0, &["generate", "cube", "--size", "5", "--material", "r.toml", "-q", "-o", "a.glb"]);
    bench.ends(0, &["generate", "cube", "--size", "5", "--material", "ruby", "-q", "-o", "b.glb"]);
    assert_eq!(bench.read("a.glb"), bench.read("b.glb"));
    let small = ["--width", "8", "--height", "6", "--spp", "1", "--photons", "50", "-q"];
    bench.ends(0, &[&["render", "cube", "--material", "r.toml", "-o", "c.png"], &small[..]].concat());
    assert!(bench.exists("c.png"));
}

#[test]
fn a_name_of_the_catalogue_wins_over_a_file_of_that_name() {
    let bench = Bench::new();
    write(&bench, "diamond", source("quartz"));
    write(&bench, "mine", source("topaz"));
    let weighed = |material: &str| bench.ends(0, &["show", "cube", "--material", material]).0;
    assert!(weighed("diamond").contains("2.4173"));
    assert!(weighed("./diamond").contains("1.5442"));
    assert!(weighed("mine").contains("1.6120"));
    let refused = |material: &str| bench.ends(2, &["show", "cube", "--material", material]).1;
    assert!(refused("nowhere.toml").contains("nowhere.toml: cannot be read"));
    assert!(refused("diamnd").contains("did you mean 'diamond'?"));
    write(&bench, "bad.toml", "name = \"bad\"\n[index]\nn-d = 0.5\n");
    let said = refused("bad.toml");
    assert!(said.contains("bad.toml, line 3: n-d: expected an index") && said.lines().count() == 1, "{said}");
    let (_, said) = bench.ends(2, &["show", "cube:material=bad.toml"]);
    assert!(said.contains("line 3: n-d"), "{said}");
    write(&bench, "in/out.toml", "name = \"x\"\n[index]\ntable = \"../t.csv\"\n");
    write(&bench, "t.csv", "380,1.6\n730,1.5\n");
    assert!(refused("in/out.toml").contains("'../t.csv': it is outside the file's folder"));
}

/// A table belongs to what its material's file holds, and to what that file includes.
#[test]
fn a_table_of_another_material_is_not_continued() {
    let bench = Bench::new();
    let toml = |sg: &str| format!("name = \"m\"\nspecific-gravity = {sg}\n[index]\ntable = \"n.csv\"\n");
    write(&bench, "m.toml", toml("3"));
    write(&bench, "n.csv", "380,1.61\n730,1.6\n");
    for stones in [
        &["cube", "octahedron", "--material", "m.toml"][..],
        &["cube:material=m.toml", "octahedron:material=m.toml"],
    ] {
        let shard = |shard: &str, file: &str| {
            let tail = ["--metrics", "spread", "--shard", shard, "-o", file, "--force"];
            bench.ends(0, &[&["score"], stones, &tail[..]].concat());
        };
        let merged = |code: i32| bench.ends(code, &["merge", "1.csv", "2.csv", "-o", "all.csv", "--force"]).1;
        shard("1/2", "1.csv");
        shard("2/2", "2.csv");
        merged(0);
        write(&bench, "m.toml", toml("4"));
        shard("2/2", "2.csv");
        assert!(merged(2).contains("different tables"));
        shard("1/2", "1.csv");
        merged(0);
        write(&bench, "n.csv", "380,1.71\n730,1.7\n");
        shard("2/2", "2.csv");
        assert!(merged(2).contains("different tables"));
        write(&bench, "m.toml", toml("3"));
        write(&bench, "n.csv", "380,1.61\n730,1.6\n");
    }
}

/// A scene's material, white and spectra are files beside it; outside its folder they are refused.
#[test]
fn scenes_name_files_beside_them() {
    let bench = Bench::new();
    write(&bench, "scene/gems/plate.toml", text(&fs::read(data("plate.toml")).expect("is there")));
    write(&bench, "scene/gems/plate.csv", fs::read(data("plate.csv")).expect("is there"));
    write(&bench, "scene/lamp.toml", fs::read(data("lamp.toml")).expect("is there"));
    write(&bench, "lamp.toml", fs::read(data("lamp.toml")).expect("is there"));
    let scene = |material: &str, white: &str, spectrum: &str| {
        let text = format!(
            "about = \"a test\"\nunit = \"mm\"\n[camera]\nat = [0, -30, 20]\nfield = 30\nwhite = \"{white}\"\n\
             [[stone]]\ncut = \"cube\"\nsize = 5\nmaterial = \"{material}\"\n\
             [[light]]\nkind = \"sphere\"\nat = [0, 0, 30]\nradius = 2\nradiance = 9\nspectrum = \"{spectrum}\"\n"
        );
        let file = SceneFile::parse("s", "s.toml", &text, &bench.path("scene")).map_err(|e| e.to_string())?;
        assert!(file.files().contains(&bench.path("scene").join(material)));
        file.build(&SceneOverrides::default(), 1.5).map_err(|e| e.to_string())
    };
    let built = scene("gems/plate.toml", "lamp.toml", "./lamp.toml").expect("is sound");
    assert_eq!(built.stones[0].material.name, "my ruby");
    assert_eq!(
        (built.camera.white.name.as_ref(), built.lights[0].spectrum.name.as_ref()),
        ("my lamp", "my lamp")
    );
    assert!((built.lights[0].spectrum.power(450.0) - 1.0).abs() < 1e-6);
    for (files, said) in [
        (
            ("../plate.toml", "D65", "D65"),
            "line 10: material = \"../plate.toml\" is outside the scene's folder",
        ),
        (("nowhere.toml", "D65", "D65"), "line 10: nowhere.toml: cannot be read"),
        (("ruby", "../lamp.toml", "D65"), "line 6: white = \"../lamp.toml\" is outside"),
        (("ruby", "D65", "gems/plate.toml"), "line 16: gems/plate.toml, line "),
        (("rubby", "D65", "D65"), "line 10: material 'rubby' is not one of diamond"),
        (("ruby", "D65", "D66"), "line 16: spectrum 'D66' is not one of D65, A, D50, E"),
    ] {
        let error = scene(files.0, files.1, files.2).expect_err(said);
        assert!(error.contains(said), "{error}");
    }
}
