//! The stones of a picture.

use super::options::RenderArgs;
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::design::USUAL_WIDTH_MM;
use crate::progress::SaidOnce;
use crate::stone::Stone;
use std::ffi::OsString;

/// The stones, opened, with what is to be said of them.
pub fn open(args: &RenderArgs, console: &Console) -> Result<Vec<Stone>, CliError> {
    let said = SaidOnce::default();
    let open = |spec: &OsString| {
        let stone = Stone::open(spec, &args.stone_args.options(args.size))?;
        stone.warnings().iter().for_each(|w| console.note(&format!("note: {w}")));
        if stone.given_material().is_none() && stone.material().bare_index().is_some() {
            let why = stone.material().no_dispersion();
            said.note_of_one(
                console,
                &format!("{}: a picture without fire and colour, for {why}", stone.name()),
                &why,
            );
        }
        if !stone.lacks_size() {
            return Ok(stone);
        }
        console.note(&format!(
            "note: {} has no size, which its colour depends on: taken as {USUAL_WIDTH_MM} mm wide; --size MM sets it",
            stone.convex_design()?.name
        ));
        Ok(stone.with_usual_width()?)
    };
    args.stones.iter().map(open).collect()
}
