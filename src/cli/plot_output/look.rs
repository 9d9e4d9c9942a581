//! Options about how plots look.

use crate::cli::args::values;
use crate::cli::error::CliError;
use crate::metrics::Metric;
use crate::parse;
use crate::parse::NumberError;
use crate::report::plot::{ColourScale, PIXELS, Style, TILT};
use crate::report::raster::MOST_PIXELS;

#[derive(Debug, Clone, Default, clap::Args)]
pub struct Look {
    /// Title of the plots [the score and the stone]
    #[arg(long, value_name = "TEXT", help_heading = HEADING)]
    title: Option<String>,
    /// Ends of an axis of the plots, or of a map's scale of colours: KEY is a varied parameter, tilt or a
    /// metric; may be given several times
    #[arg(long, value_name = "KEY=FROM:TO", value_parser = range, help_heading = HEADING)]
    range: Vec<(String, (f64, f64))>,
    /// Width of plots that are .png, in pixels [1600]
    #[arg(long, value_name = "N", help_heading = HEADING,
        value_parser = values::whole_number(1..=MOST_PIXELS, "a width is a whole number of pixels"))]
    pixels: Option<u32>,
    /// Colours of maps [viridis]
    #[arg(long, value_name = "viridis|magma|cividis|greys", value_parser = colours, help_heading = HEADING)]
    colours: Option<ColourScale>,
}

const HEADING: &str = "Plots";

impl Look {
    /// The style of plots of these metrics along these axes.
    pub fn style(&self, metrics: &[&'static Metric], axes: &[String]) -> Result<Style, CliError> {
        for (i, (key, _)) in self.range.iter().enumerate() {
            let column = column(key);
            if self.range[..i].iter().any(|(other, _)| column == self::column(other)) {
                return Err(CliError::input(format!("--range {key} is given twice")));
            }
            if !axes.iter().any(|axis| axis == column) && !metrics.iter().any(|m| m.name == column) {
                let mut known: Vec<&str> = axes.iter().map(|axis| said(axis)).collect();
                known.extend(metrics.iter().map(|m| m.name));
                return Err(CliError::input(format!(
                    "--range {key}: the plots show no such thing, but {}",
                    known.join(", ")
                )));
            }
        }
        Ok(Style {
            title: self.title.clone(),
            ranges: self.range.iter().map(|(key, ends)| (column(key).to_owned(), *ends)).collect(),
            colours: self.colours.unwrap_or_default(),
        })
    }

    /// Pixels across a plot that becomes a picture.
    pub fn width(&self) -> u32 {
        self.pixels.unwrap_or(PIXELS)
    }

    /// The first option that was given, if any was.
    pub fn given(&self) -> Option<&'static str> {
        let options = [
            ("--title", self.title.is_some()),
            ("--range", !self.range.is_empty()),
            ("--pixels", self.pixels.is_some()),
            ("--colours", self.colours.is_some()),
        ];
        options.iter().find(|(_, is_given)| *is_given).map(|(name, _)| *name)
    }
}

/// The column that `--range` names.
fn column(key: &str) -> &str {
    if key == said(TILT) { TILT } else { key }
}

/// What the option calls the column of an axis.
fn said(axis: &str) -> &str {
    if axis == TILT { "tilt" } else { axis }
}

/// Value parser of `--range`.
fn range(text: &str) -> Result<(String, (f64, f64)), String> {
    let expected = || format!("'{text}' is no range of an axis (expected KEY=FROM:TO, as wlr=0.2:0.3)");
    let (key, ends) = text.split_once('=').ok_or_else(expected)?;
    let (from, to) = ends.split_once(':').ok_or_else(expected)?;
    let number = |text: &str| match parse::parse_number(text, unit_of(text)) {
        Err(NumberError::NotANumber | NumberError::Infinite) => Err(expected()),
        other => other.map_err(|e| e.to_string()),
    };
    let (from, to) = (number(from)?, number(to)?);
    match key.trim() {
        "" => Err(expected()),
        _ if from >= to => Err(format!("'{text}': FROM must be less than TO")),
        key => Ok((key.to_lowercase(), (from, to))),
    }
}

/// The unit that is typed after a number, whatever axis it is of.
fn unit_of(text: &str) -> parse::NumberUnit {
    parse::NumberUnit::from_sign(text.trim().trim_start_matches(|c: char| !"°%mc".contains(c)))
}

/// Value parser of `--colours`.
fn colours(name: &str) -> Result<ColourScale, String> {
    let found = ColourScale::ALL.iter().find(|(known, _)| parse::is_name(known, name));
    let names = || ColourScale::ALL.map(|(known, _)| known).join(", ");
    found.map(|(_, colours)| *colours).ok_or_else(|| format!("colours are {}", names()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_or_explained() {
        assert_eq!(range("wlr=0.2:0.3"), Ok(("wlr".into(), (0.2, 0.3))));
        assert_eq!(range("Crown-Angle=34°:36°"), Ok(("crown-angle".into(), (34.0, 36.0))));
        assert_eq!(range("tilt=-10:10"), Ok(("tilt".into(), (-10.0, 10.0))));
        assert_eq!(range("table=50%:60 %"), Ok(("table".into(), (50.0, 60.0))));
        for (wrong, why) in [
            ("wlr", "KEY=FROM:TO"),
            ("wlr=1", "KEY=FROM:TO"),
            ("=1:2", "KEY=FROM:TO"),
            ("wlr=2:1", "less than"),
            ("wlr=1:1", "less than"),
            ("wlr=0,2:1", "0.2"),
            ("wlr=nan:1", "KEY=FROM:TO"),
        ] {
            assert!(range(wrong).is_err_and(|e| e.contains(why)), "{wrong}");
        }
    }
}
