use super::features::Run;
use super::means::Means;
use super::place::{
    TIFF, box_ring, check_beside, check_file, check_inputs, is_georeferenced, tell_place,
    write_labels,
};
use super::records::{Found, POLYGONS, Plan};
use super::regions::{self, Parted};
use crate::args::{SegmentArgs, SegmentMethod};
use crate::failure::{Failure, Status};
use crate::output::Output;
use crate::parallel::kept;
use crate::timings::timed;
use medial_image::{Class, Object, Objects, Selection};
use medial_io::image::{self, PaletteColour};
use medial_io::record::{self, Record, Shape, Value};
use medial_io::{Feature, Format, Layer};
use std::io::IsTerminal as _;
use std::path::PathBuf;
use std::sync::Arc;

const COLUMNS: &[&str] = &[
    "region",
    "pixels",
    "area",
    "n_polygons",
    "n_holes",
    "mean_1",
    "mean_2",
    "mean_3",
    "color",
    "class",
];

/// `medial segment`.
pub fn run(args: &'static SegmentArgs) -> Result<Status, Failure> {
    regions::check(&args.segmentation)?;
    let mut run = Run::new(kept(args.run.common()))?;
    run.knows_metric = false;
    let plan = Plan {
        target: &args.target,
        thing: "regions",
        formats: POLYGONS,
        columns: COLUMNS,
        engine: None,
        layers: Vec::new(),
    };
    let is_picture = plan.asked()? == Format::Png;
    let format = if is_picture { Format::Png } else { plan.format()? };
    let file = args.target.output.as_deref().filter(|path| path.as_os_str() != "-");
    let others = [
        ("--labels", args.labels.as_deref()),
        ("--palette", args.palette.as_deref()),
        ("--report", args.run.run.report.as_deref()),
        ("--timings", args.run.run.timings.as_deref()),
    ];
    check_beside(file, format, &others)?;
    check_file("--labels", args.labels.as_deref(), TIFF)?;
    check_file("--palette", args.palette.as_deref(), &["csv", "gpl"])?;
    check_inputs(&[Some(&args.input), args.segmentation.mask.as_deref()])?;
    if is_picture && file.is_none() && std::io::stdout().is_terminal() {
        return Err(Failure::Usage("a terminal shows no png; name a file with -o".to_owned()));
    }
    let numbers = args.labels.as_deref().map(Output::beside).transpose()?;
    let palette = args.palette.as_deref().map(Output::beside).transpose()?;
    let segmentation = &args.segmentation;
    let has_classes =
        !matches!(segmentation.method, SegmentMethod::MeanShift | SegmentMethod::Labels);
    if palette.is_some() && !has_classes {
        let why = "--palette is for methods with classes: feature_space, threshold, colours";
        return Err(Failure::Usage(why.to_owned()));
    }
    let mask = segmentation.mask.as_deref();
    let parted = regions::parted(segmentation, &args.input, mask, &mut run, false, None)?;
    let Parted { input, crs, means, labels, regions, .. } = parted;
    let grid = *labels.grid();
    let (is_placed, quiet) = (is_georeferenced(&grid, crs.as_ref()), args.run.run.quiet);
    if let Some(output) = numbers {
        let numbers: Vec<u32> = labels.labels().iter().map(|label| label.wrapping_add(1)).collect();
        let bytes = image::write_labels(&grid, crs.as_ref(), &numbers, 0, input.bytes());
        timed(&mut run.stages.write, || write_labels(output, &bytes, is_placed, quiet))?;
    }
    if let Some(output) = palette {
        let text = palette_text(args, &labels.classes(&regions), &means);
        timed(&mut run.stages.write, || output.whole(text.as_bytes()))?;
    }
    if is_picture {
        let of = |&label: &u32| {
            let region = regions.get(label as usize);
            region.map_or([f32::NAN; 3], |region| means.shown(label, region.mean))
        };
        let pixels: Vec<[f32; 3]> = labels.labels().iter().map(of).collect();
        let bytes = image::write_colours(grid.columns, grid.rows, &pixels);
        timed(&mut run.stages.write, || {
            Output::create(file)?.whole(&bytes)?;
            tell_place(file, is_placed.then_some((&grid, crs.as_ref())), quiet)
        })?;
        return run.done(&input.name, regions.len());
    }
    let objects = timed(&mut run.stages.engine, || {
        Arc::new(Objects::new(&labels, &regions, &Selection::of(0..labels.len())))
    });
    let class_of: Vec<u32> = (0..labels.len()).map(|region| labels.class_of(region)).collect();
    drop((labels, regions));
    let layer = layer(&objects, crs);
    plan.run_on(
        run,
        &input.name,
        layer,
        move |feature, _, stages, _| {
            let number = feature.index as u32;
            let object = &objects.all()[number as usize];
            let polygons = timed(&mut stages.operations, || objects.polygons(number));
            let n_rings: usize = polygons.iter().map(Vec::len).sum();
            let area = (grid.cell[0] * grid.cell[1]).abs();
            let mut values: Vec<Value> = vec![
                number.into(),
                (object.whole.cells as usize).into(),
                (object.whole.cells as f64 * area).into(),
                polygons.len().into(),
                (n_rings - polygons.len()).into(),
            ];
            values.extend(means.told(number, object.whole.mean));
            values.push(means.color(number, object.whole.mean));
            values.push(if has_classes { class_of[number as usize].into() } else { Value::None });
            let record = Record { values, shape: Shape::Polygons(polygons) };
            Ok(timed(&mut stages.write, || {
                let mut bytes = Vec::new();
                record::write(&mut bytes, format, feature, None, COLUMNS, &[record]);
                Found::<()>::Bytes(bytes)
            }))
        },
        |_, _| Ok(Vec::new()),
    )
}

/// The palette as its file is to have it.
fn palette_text(args: &SegmentArgs, classes: &[Class], means: &Means) -> String {
    let colour = |class: &Class| PaletteColour {
        class: class.number,
        colour: means.bytes(0, class.whole.mean),
        means: class.whole.mean,
        n_means: means.len(),
        pixels: class.whole.cells,
        regions: class.regions,
    };
    let colours: Vec<PaletteColour> = classes.iter().map(colour).collect();
    let is_gpl = |path: &PathBuf| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gpl"));
    if args.palette.as_ref().is_some_and(is_gpl) {
        let name = args.input.file_stem().unwrap_or_default().to_string_lossy();
        image::palette_gpl(&name, &colours)
    } else {
        image::palette_table(&colours)
    }
}

/// A feature for each object; the box of its pixels stands for its polygons.
fn layer(objects: &Arc<Objects>, crs: Option<medial_io::Crs>) -> Layer<'static> {
    let n = objects.all().len();
    let objects = Arc::clone(objects);
    let feature = move |index: usize| {
        let Object { whole, .. } = &objects.all()[index];
        let ring = box_ring(objects.grid(), whole.first, whole.last.map(|k| k + 1));
        Feature {
            index,
            polygons: vec![vec![ring]],
            geometry: "a region".to_owned(),
            polygonal: true,
            ..Feature::default()
        }
    };
    Layer::of_features(crs, (0..n).map(feature))
}
