//! Everything about one stone: the files of `cutlab report`.

use super::attribution::attributed;
use super::page::{Page, Section};
use super::pdf::PdfError;
use super::raster::RasterError;
use super::references::References;
use super::request::ReportInput;
use super::viewer_images::ViewerImageError;
use super::{chart, diagram, sections, tilt_curves, viewer_images};
use crate::batch::table;
use crate::batch::table::TableError;
use crate::design::proportions::{self, Proportions};
use crate::design::{CutError, families};
use crate::formats::{self, FormatError};
use crate::geometry::SolidError;
use crate::integrators::{self, PhotonMaps, Tone, image_io};
use crate::materials::weight::Weight;
use crate::photons::{self, PhotonSets};
use crate::scene::{SceneError, SceneOverrides, preset};
use crate::scoring::score::{ScoreInput, ScoreRequest, score};
use crate::stone::StoneError;
use crate::storage::atomic_write::{self, WriteError};
use std::path::Path;

/// Camera rays a pixel of the picture on the table.
const RAYS: u32 = 16;

/// Photons of each map, and how many an estimate gathers: the original project's numbers.
const PHOTONS: (usize, usize) = (100_000, 500);

/// A report that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The planes bound no stone.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A shape that is no convex stone, or a width that is none.
    #[error(transparent)]
    Stone(#[from] StoneError),
    /// The work was ended early by [`crate::Progress::is_cancelled`].
    #[error("cancelled")]
    Cancelled,
    /// The planes bound no stone.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// The stone could not be put into a file format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The pictures through scopes could not be made.
    #[error(transparent)]
    Viewer(#[from] ViewerImageError),
    /// A picture could not be encoded.
    #[error(transparent)]
    Picture(#[from] image_io::EncodeError),
    /// The scene cannot be set up.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The table could not be made.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The stone cannot be lit.
    #[error("{0}")]
    Scores(String),
    /// A drawing that could not become a PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// A drawing that could not become a picture.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// A file that could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A file whose extension is of another format than the one asked for.
    #[error("{file} is {own} by its ending, not {asked}: leave out --to {to}, or name another file")]
    OtherEnding {
        /// The file.
        file: String,
        /// The format of its extension.
        own: String,
        /// The format asked for.
        asked: String,
        /// As it was asked for.
        to: String,
    },
    /// A plot whose extension is of no drawing.
    #[error("{0}: plots are .svg, .pdf or .png")]
    NoPlot(String),
    /// A stream for several plots.
    #[error("{path} takes one plot, and there are {scores} scores: name a file")]
    OnePlot {
        /// The stream.
        path: String,
        /// How many metrics the table has.
        scores: usize,
    },
}

/// A finished report, in memory.
#[derive(Debug)]
pub struct StoneReport {
    /// File names with their bytes; the page last.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// The scores under their heads.
    pub sections: Vec<Section>,
    /// Proportions of the stone.
    pub proportions: Proportions,
}

/// Steps that [`make`] reports.
pub const STEPS: usize = 7;

/// Makes the report.
///
/// - `step`: called with what comes next, [`STEPS`] times
///
/// The same request gives the same bytes on any number of threads. Checked in `tests/program/report.rs`
/// and `tests/program/cli.rs`.
pub fn make(request: &ReportInput, step: &dyn Fn(&'static str)) -> Result<StoneReport, ReportError> {
    let design = &request.design;
    let solid = design.solid()?;
    let proportions = proportions::measure(&solid);
    let (made_up_of, _) = families::facet_summary(design)?;

    step("scoring");
    let plan = ScoreRequest {
        seed: request.seed,
        polarised: request.polarised,
        target: request.target,
        ..ScoreRequest::default()
    };
    let subject = ScoreInput {
        stone: request.stone.clone(),
        material: request.material.clone(),
        shape: Ok(solid.clone().into()),
        tilt: None,
    };
    let row = score(&subject, &plan);
    if let Some(why) = &row.error {
        return Err(ReportError::Scores(why.clone()));
    }
    step("reference stones");
    let references = References::within(&request.material, solid.width(), &plan)?;
    let sections = sections::sections(&plan.metrics, &row, &references);

    step("tiers");
    let attribution = attributed(request, &solid);

    step("scopes");
    let pictures = viewer_images::pictures(&subject, &plan, height(request.width))?;

    let tilts = tilt_curves::plots(&[(request, "", &solid)], &plan, &|| step("tilts"));

    let picture = table_picture(request, step)?;
    let diagram = diagram::draw(design, design.refractive_index)?;
    let map = chart::draw(&proportions, &request.material)?;

    let mut files = vec![
        ("stone.obj", formats::encode(design, "obj")?),
        ("stone.toml", formats::encode(design, "toml")?),
        ("table.png", picture.clone()),
        ("diagram.svg", diagram.clone().into_bytes()),
        ("scores.csv", table::csv(&plan.metrics, std::slice::from_ref(&row))?),
    ];
    files.extend(pictures.iter().map(|p| (p.scope.file, p.png.clone())));
    let names: Vec<String> = files.iter().map(|(name, _)| name.to_string()).collect();
    let material = &request.material;
    let weighed = Weight::new(material);
    let weight = match (weighed.carats(proportions.volume), weighed.name()) {
        (Some(ct), Some(name)) if name != material.name => format!("{ct:.3} ct in {name}"),
        (Some(ct), _) => format!("{ct:.3} ct"),
        _ => "weight not known".into(),
    };
    let page = Page {
        name: if design.name.is_empty() { &request.stone } else { &design.name },
        made_up_of: &made_up_of,
        source: &design.source,
        material: format!("{}, n {:.4} (D line)", material.name, material.index_d()),
        weight: format!("{:.2} mm · {weight}", proportions.width),
        weight_note: weighed.note(),
        proportions: &proportions,
        picture: Some((
            &picture,
            format!(
                "Lying on a grey table: {},000 photons in each of two maps, the {} nearest gathered, {} rays a pixel",
                PHOTONS.0 / 1000,
                PHOTONS.1,
                RAYS
            ),
        )),
        scopes: &pictures,
        diagram: &diagram,
        sections: &sections,
        tilts: &tilts,
        attribution: &attribution,
        map,
        references: &references.material,
        traced: format!(
            "Light traced by photons, seed {}{}.",
            request.seed,
            if request.polarised { "" } else { ", unpolarised at every facet" }
        ),
        command: request.command.clone(),
        files: &names,
    }
    .html();
    files.push(("index.html", page.into_bytes()));
    Ok(StoneReport { files, sections, proportions })
}

/// Pixels down a picture of so many across.
fn height(width: u32) -> u32 {
    width * 3 / 4
}

/// The photon-mapped picture of the stone on the grey table, as PNG.
pub(super) fn table_picture(
    request: &ReportInput,
    step: &dyn Fn(&'static str),
) -> Result<Vec<u8>, ReportError> {
    let (width, height) = (request.width, height(request.width));
    let (photons, nearest) = PHOTONS;
    let Some(table) = preset("table") else {
        return Err(ReportError::Scores("the scene 'table' is not in the catalogue".into()));
    };
    step("photon maps");
    let cast = SceneOverrides {
        designs: vec![request.design.clone()],
        material: Some(request.material.clone()),
        polarisation: Some(request.polarised),
        ..SceneOverrides::default()
    };
    let scene = table?.build(&cast, width as f32 / height as f32)?;
    let seed = request.seed;
    let shots = PhotonSets::emit(&scene, &photons::PhotonSettings { photons, nearest, seed });
    let maps = PhotonMaps::new(&scene, shots, nearest);
    step("picture");
    let tone = Tone { stops: scene.camera.stops, ..Tone::default() };
    let settings =
        integrators::RenderSettings { width, height, samples_per_pixel: RAYS, round: 0, tone, seed };
    let film = integrators::render(&scene, &scene.camera, &maps, &settings, &|| ());
    Ok(image_io::png(&image_io::display_rgb(&film, None, &tone), width, height, image_io::Bits::Eight, None)?)
}

/// The names of all files of a report, the page last.
pub fn files() -> Vec<&'static str> {
    let fixed = ["stone.obj", "stone.toml", "table.png", "diagram.svg", "scores.csv"];
    fixed
        .into_iter()
        .chain(viewer_images::VIEWER_IMAGES.iter().map(|scope| scope.file))
        .chain(["index.html"])
        .collect()
}

impl StoneReport {
    /// Writes every file into `folder`, which is made; the page last, so that it never shows what
    /// is not there.
    pub fn write(&self, folder: &Path) -> Result<(), WriteError> {
        self.files.iter().try_for_each(|(name, bytes)| atomic_write::write(&folder.join(name), bytes))
    }
}
