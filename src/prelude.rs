//! What most programs need: `use cutlab::prelude::*;`.
//!
//! ```no_run
//! use cutlab::prelude::*;
//! # fn main() -> Result<(), Error> {
//! let stone = Stone::parse("round-brilliant:crown-angle=35")?.with_material(Material::named("diamond")?);
//! let scores = ScoreRequest::new(["wlr", "fire_streak"]).error(1e-3).run(&stone)?;
//! println!("{}", scores["wlr"]);                      // 0.2838 ± 0.0010
//! # #[cfg(feature = "render")]
//! RenderRequest::scene("table")?.stone(&stone).run()?.save("brilliant.png")?;
//! # Ok(())
//! # }
//! ```
//!
//! The programs in `tools/examples/` show more, and the tests run them.

#[cfg(feature = "files")]
pub use crate::batch::stone_files::expand_stones;
pub use crate::design::{Design, LengthUnit};
pub use crate::error::{Error, ErrorKind};
pub use crate::geometry::{Plane, Polyhedron};
pub use crate::limits::Limits;
pub use crate::materials::Material;
pub use crate::metrics::Metric;
pub use crate::progress::Progress;
#[cfg(feature = "render")]
pub use crate::render::{AnimationRequest, Background, Exposure, Picture, RenderRequest, StopRequest};
pub use crate::sampling::stats::Estimate;
pub use crate::scoring::{ScoreRequest, Scores, Target, Tilt};
pub use crate::stone::{Orientation, Stone, StoneOptions, StoneSpec, UpAxis};
