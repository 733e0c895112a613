//! What commands whose results are records do alike.

use super::axis::{format_of, needs_file};
use super::features::Run;
use super::sink::{Sink, head};
use crate::args::{Target, engine_for};
use crate::failure::{Failure, Status};
use crate::input::Polygons;
use crate::report::Entry;
use crate::timings::{Stages, timed};
use medial::axis::Engine;
use medial::domain::Domain;
use medial::engine;
use medial_io::record::{self, Record};
use medial_io::{Crs, Feature, Format, Layer};
use std::io::IsTerminal as _;
use std::path::Path;
use std::time::Duration;

/// How records are made and written.
pub struct Plan {
    pub target: &'static Target,
    /// What the records are called, for messages.
    pub thing: &'static str,
    /// Formats of the output.
    pub formats: &'static [Format],
    pub columns: &'static [&'static str],
    pub engine: Option<Engine>,
    /// The names of layers, which records have in the column `layer`, if there are several.
    pub layers: Vec<&'static str>,
}

/// Formats of lines.
pub const LINES: &[Format] =
    &[Format::GeoJson, Format::GeoJsonLines, Format::Csv, Format::Wkt, Format::Wkb, Format::Dxf];

/// Formats of lines, and the picture.
pub const DRAWN_LINES: &[Format] = &[
    Format::GeoJson,
    Format::GeoJsonLines,
    Format::Csv,
    Format::Wkt,
    Format::Wkb,
    Format::Dxf,
    Format::Svg,
];

/// Formats of polygons.
pub const POLYGONS: &[Format] = &record::FORMATS;

impl Plan {
    /// The file of the output, if it is not standard output.
    fn file(&self) -> Option<&Path> {
        self.target.output.as_deref().filter(|path| path.as_os_str() != "-")
    }

    /// The format that is asked for.
    pub fn asked(&self) -> Result<Format, Failure> {
        format_of(self.target.to, self.file())
    }

    /// The format of the output, if the records have it.
    pub fn format(&self) -> Result<Format, Failure> {
        let format = self.asked()?;
        if !self.formats.contains(&format.encoding()) {
            let tables = [Format::Gpkg, Format::Shp, Format::Fgb, Format::Parquet];
            let names = self.formats.iter().chain(&tables);
            let names = names.map(|format| format.name()).collect::<Vec<_>>();
            let (thing, names) = (self.thing, names.join(", "));
            return Err(Failure::Usage(format!("{thing} are written as {names}, not as {format}")));
        }
        let is_binary = matches!(format, Format::Wkb | Format::Png);
        if is_binary && self.file().is_none() && std::io::stdout().is_terminal() {
            return Err(Failure::Usage(format!(
                "a terminal shows no {format}; name a file with -o"
            )));
        }
        needs_file(format, self.file())?;
        Ok(format)
    }

    /// A place for the records.
    pub fn sink(
        &self,
        format: Format,
        crs: Option<Crs>,
        units: Option<&str>,
        quiet: bool,
    ) -> Result<Sink, Failure> {
        let head = head(format, record::header(self.columns), units);
        Sink::of_layers(self.target.output.as_deref(), format, head, crs, &self.layers, quiet)
    }

    /// Calls `work` for each valid feature of an input and writes the records that it gives.
    pub fn run(
        &self,
        run: Run,
        input: &'static Polygons,
        work: impl Fn(
            &Feature,
            &Domain,
            &mut Stages,
            &engine::Options<'_>,
        ) -> Result<Vec<Record>, Entry>
        + Send
        + Sync
        + 'static,
    ) -> Result<Status, Failure> {
        let work = move |feature: &Feature,
                         domain: &Domain,
                         stages: &mut Stages,
                         options: &engine::Options<'_>| {
            work(feature, domain, stages, options).map(Found::<()>::Records)
        };
        self.run_and_draw(run, input, work, |_, _| Ok(Vec::new()))
    }

    /// The same where something is made of all features at once, a picture or records: `draw` makes it.
    pub fn run_and_draw<P: Send + 'static>(
        &self,
        mut run: Run,
        input: &'static Polygons,
        work: impl Fn(&Feature, &Domain, &mut Stages, &engine::Options<'_>) -> Result<Found<P>, Entry>
        + Send
        + Sync
        + 'static,
        draw: impl FnOnce(Vec<P>, &mut Stages) -> Result<Vec<u8>, Failure>,
    ) -> Result<Status, Failure> {
        self.format()?;
        let layer = timed(&mut run.stages.read, || input.layer())?;
        self.run_on(run, &input.name, layer, work, draw)
    }

    /// The same for the features of a layer that comes from an input with this name.
    pub fn run_on<P: Send + 'static>(
        &self,
        mut run: Run,
        input: &str,
        layer: Layer<'static>,
        work: impl Fn(&Feature, &Domain, &mut Stages, &engine::Options<'_>) -> Result<Found<P>, Entry>
        + Send
        + Sync
        + 'static,
        draw: impl FnOnce(Vec<P>, &mut Stages) -> Result<Vec<u8>, Failure>,
    ) -> Result<Status, Failure> {
        let format = self.format()?;
        let mut sink = self.sink(format, layer.crs.clone(), layer.units, run.common.run.quiet)?;
        let mut parts = Vec::new();
        let mut write = Duration::ZERO;
        let (at_once, threads) = run.threads(&layer);
        let (engine, columns) = (self.engine, self.columns);
        let status = run.each(
            input,
            layer,
            at_once,
            move |feature, domain, stages, bytes| {
                let options = stages.options(threads);
                let records = match work(feature, domain, stages, &options)? {
                    Found::Records(records) => records,
                    Found::Text(text) => {
                        bytes.extend_from_slice(text.as_bytes());
                        return Ok(None);
                    }
                    Found::Bytes(found) => {
                        bytes.extend_from_slice(&found);
                        return Ok(None);
                    }
                    Found::Part(part) => return Ok(Some(part)),
                };
                timed(&mut stages.write, || {
                    let engine = Some(engine_for(feature, engine));
                    record::write(bytes, format, feature, engine, columns, &records);
                });
                Ok(None)
            },
            |part| parts.extend(part),
            |bytes| timed(&mut write, || sink.write(bytes)),
        )?;
        if status != Status::NoResult {
            // A picture is one without features as well.
            let is_whole = matches!(format, Format::Svg | Format::Png | Format::GCode);
            let drawn = if is_whole || !parts.is_empty() {
                draw(parts, &mut run.stages)?
            } else {
                Vec::new()
            };
            timed(&mut write, || {
                if is_whole {
                    return sink.finish(&drawn);
                }
                // What is no whole of its own goes where records go.
                sink.write(&drawn)?;
                sink.finish(&[])
            })?;
        }
        run.stages.write += write;
        run.finish()?;
        Ok(status)
    }
}

/// What was found of a feature, as its format has it.
pub enum Found<P> {
    /// Records.
    Records(Vec<Record>),
    /// Text of the format itself.
    Text(String),
    /// Bytes of the format itself.
    Bytes(Vec<u8>),
    /// What becomes a part of one whole.
    Part(P),
}
