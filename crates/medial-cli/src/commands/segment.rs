use super::records::{POLYGONS, Plan};
use crate::args::{SegmentArgs, SegmentMethod};
use crate::failure::{Failure, Status};
use crate::guard::guarded;
use crate::input::Input;
use crate::output::Output;
use crate::timings::{self, Stages, timed};
use medial_image::{
    Analysis, Field, FieldError, Filter, Labels, feature_space, luv, mean_shift, near_colours,
    srgb, thresholds,
};
use medial_io::record::{self, Record, Shape, Value};
use medial_io::{Content, Feature, Format, image};
use std::io::IsTerminal as _;
use std::num::NonZeroUsize;
use std::time::Instant;

const COLUMNS: &[&str] =
    &["region", "pixels", "area", "n_polygons", "n_holes", "mean_1", "mean_2", "mean_3", "color"];

/// How far from its colour a pixel may be where nothing is said.
const TOLERANCE: f64 = 20.0;

/// `medial segment`.
pub fn run(args: &'static SegmentArgs) -> Result<Status, Failure> {
    check(args)?;
    let (start, mut stages) = (Instant::now(), Stages::default());
    let told = args.timings.as_deref().map(|path| Output::create(Some(path))).transpose()?;
    let plan = Plan {
        target: &args.target,
        thing: "regions",
        formats: POLYGONS,
        columns: COLUMNS,
        engine: None,
    };
    let is_picture = plan.asked()? == Format::Png;
    let format = if is_picture { Format::Png } else { plan.format()? };
    let file = args.target.output.as_deref().filter(|path| path.as_os_str() != "-");
    if is_picture && file.is_none() && std::io::stdout().is_terminal() {
        return Err(Failure::Usage("a terminal shows no png; name a file with -o".to_owned()));
    }
    let numbers = args.labels.as_deref().map(|path| Output::create(Some(path))).transpose()?;
    let input = timed(&mut stages.read, || Input::read(&args.input))?;
    let colours = timed(&mut stages.read, || colours(args, &input))?;
    let (grid, crs) = (colours.grid, colours.crs.clone());
    let wrong = |error: FieldError| input.wrong(error);
    let are_bands = colours.are_bands;
    let field = timed(&mut stages.engine, || match are_bands {
        true => Field::of_bands(grid, colours.values),
        false => Field::of_colours(grid, colours.values),
    });
    let field = field.map_err(wrong)?;
    let labels = timed(&mut stages.engine, || labels(args, &field));
    if labels.is_empty() {
        return Err(input.wrong("has no pixel with data; there is nothing to part"));
    }
    let regions = timed(&mut stages.engine, || labels.regions(&field));
    if let Some(output) = numbers {
        let numbers: Vec<u32> = labels.labels().iter().map(|label| label.wrapping_add(1)).collect();
        let bytes = image::write_labels(grid.columns, grid.rows, &numbers);
        timed(&mut stages.write, || output.whole(&bytes))?;
    }
    // Bands have no colours: theirs are grey.
    let shown = |mean: [f32; 3]| if are_bands { [mean[0] / 100.0; 3] } else { srgb(mean) };
    if is_picture {
        let of =
            |&label: &u32| regions.get(label as usize).map_or([f32::NAN; 3], |r| shown(r.mean));
        let pixels: Vec<[f32; 3]> = labels.labels().iter().map(of).collect();
        let bytes = image::write_colours(grid.columns, grid.rows, &pixels);
        timed(&mut stages.write, || Output::create(file)?.whole(&bytes))?;
    } else {
        let mut sink = plan.sink(format, crs, None, args.quiet)?;
        let area = (grid.cell[0] * grid.cell[1]).abs();
        let source = Feature::default();
        for (number, (region, polygons)) in regions.iter().zip(labels.all_polygons()).enumerate() {
            let n_rings: usize = polygons.iter().map(Vec::len).sum();
            let [red, green, blue] =
                shown(region.mean).map(|v| (255.0 * v.clamp(0.0, 1.0)).round() as u8);
            let mut values: Vec<Value> = vec![
                number.into(),
                (region.cells as usize).into(),
                (region.cells as f64 * area).into(),
                polygons.len().into(),
                (n_rings - polygons.len()).into(),
            ];
            values.extend(region.mean.map(|mean| Value::from(f64::from(mean))));
            values.push(Value::Text(format!("#{red:02x}{green:02x}{blue:02x}")));
            let record = Record { values, shape: Shape::Polygons(polygons) };
            timed(&mut stages.write, || {
                let mut bytes = Vec::new();
                record::write(&mut bytes, format, &source, None, COLUMNS, &[record]);
                sink.write(&bytes)
            })?;
        }
        timed(&mut stages.write, || sink.finish(&[]))?;
    }
    if let Some(output) = told {
        output.whole(timings::text(&stages, start).as_bytes())?;
    }
    Ok(Status::Done)
}

/// Fails if something is said to a method that another one would listen to.
fn check(args: &SegmentArgs) -> Result<(), Failure> {
    use SegmentMethod::{Colours, FeatureSpace, MeanShift, Threshold};
    let said: [(&str, bool, SegmentMethod, &str); 7] = [
        ("--resolution", args.resolution.is_some(), FeatureSpace, "feature_space"),
        ("--seed", args.seed.is_some(), FeatureSpace, "feature_space"),
        ("--spatial", args.spatial.is_some(), MeanShift, "mean_shift"),
        ("--range", args.range.is_some(), MeanShift, "mean_shift"),
        ("--limits", !args.limits.is_empty(), Threshold, "threshold"),
        ("--color", !args.color.is_empty(), Colours, "colours"),
        ("--tolerance", args.tolerance.is_some(), Colours, "colours"),
    ];
    let usage = |why: String| Err(Failure::Usage(why));
    if let Some((option, _, _, method)) = said.iter().find(|said| said.1 && said.2 != args.method) {
        return usage(format!("{option} is for --method {method}"));
    }
    if args.method == Threshold && args.limits.is_empty() {
        return usage("--method threshold needs --limits T,T".to_owned());
    }
    if !args.limits.is_sorted_by(|a, b| a < b) || args.limits.iter().any(|t| !t.is_finite()) {
        return usage("--limits are numbers in increasing order".to_owned());
    }
    if args.method == Colours && args.color.is_empty() {
        return usage("--method colours needs --color RRGGBB,…".to_owned());
    }
    if args.method == Colours && !args.bands.is_empty() {
        return usage("--color is for colours, not for --bands".to_owned());
    }
    Ok(())
}

/// The colours or bands of the image.
fn colours(args: &SegmentArgs, input: &Input) -> Result<image::Colours, Failure> {
    let bands: Vec<usize> = args.bands.iter().map(|band| band.get()).collect();
    let named = args.from.or_else(|| Format::from_path(&args.input).ok());
    let format = match named {
        Some(format) => format,
        None => match Format::of_content(input.bytes()) {
            Ok(Content::Polygons(format)) => format,
            _ => return Err(input.wrong("is no image; png, jpeg and tiff are read")),
        },
    };
    if !matches!(format, Format::Png | Format::Jpeg | Format::Tiff) {
        let why = format!("is {format}, no image; png, jpeg and tiff are read");
        return Err(input.wrong(why));
    }
    // Decoders may panic, as parsers of fonts may.
    let read = guarded(|| image::read_colours(format, input.bytes(), &bands));
    let colours = read.map_err(|panic| input.wrong(panic))?.map_err(|error| input.wrong(error))?;
    if args.method == SegmentMethod::Colours && colours.are_bands {
        return Err(input.wrong("has bands that are no colours; name a threshold instead"));
    }
    Ok(colours)
}

/// The regions by the method that is asked for.
fn labels(args: &SegmentArgs, field: &Field) -> Labels {
    let min_region = args.min_region.unwrap_or(1);
    match args.method {
        SegmentMethod::FeatureSpace => {
            let analysis = Analysis {
                resolution: args.resolution.map(Into::into).unwrap_or_default(),
                seed: args.seed.unwrap_or(0),
                min_region: args.min_region,
            };
            feature_space(field, &analysis)
        }
        SegmentMethod::MeanShift => {
            let usual = Filter::default();
            let threads = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
            let filter = Filter {
                spatial: args.spatial.map_or(usual.spatial, |radius| radius as f32),
                range: args.range.map_or(usual.range, |radius| radius as f32),
                min_region: args.min_region.unwrap_or(usual.min_region),
                threads: args.threads.unwrap_or(threads),
            };
            mean_shift(field, &filter)
        }
        SegmentMethod::Threshold => thresholds(field, &args.limits, min_region),
        SegmentMethod::Colours => {
            let of = |colour: &[u8; 3]| luv(colour.map(|value| f32::from(value) / 255.0));
            let colours: Vec<[f32; 3]> = args.color.iter().map(of).collect();
            let distance = args.tolerance.unwrap_or(TOLERANCE) as f32;
            near_colours(field, &colours, distance, min_region)
        }
    }
}
