//! What became of the objects of an image in another one.

use super::features::Run;
use super::image::{FORMATS, several};
use super::means::Means;
use super::painting::{Drawn, Painting, lines};
use super::place::{box_ring, is_georeferenced};
use super::records::{Found, Plan};
use super::regions::{self, Parted};
use super::sink::title;
use crate::args::{ImageArgs, ImageLayer};
use crate::failure::{Failure, Status};
use crate::timings::timed;
use medial_image::{Change, Changes, Objects, Part};
use medial_io::record::{self, Record, Shape, Value};
use medial_io::svg::Overlay;
use medial_io::{Feature, Format, Layer};
use std::path::Path;

const COLUMNS: &[&str] = &[
    "layer",
    "change",
    "region",
    "region_after",
    "pixels",
    "pixels_after",
    "area",
    "area_after",
    "area_kept",
    "area_gained",
    "area_lost",
    "area_changed",
    "overlap",
    "color",
    "color_after",
    "color_distance",
];

/// The objects of `before`, an image in regions, and of another one, and what became of the first ones.
pub fn run(
    args: &'static ImageArgs,
    mut run: Run,
    format: Format,
    before: &Parted,
    objects: &Objects,
    other: &Path,
) -> Result<Status, Failure> {
    let mask = args.compare_mask.as_deref();
    let after = regions::parted(&args.segmentation, other, mask, &mut run, false, Some(before))?;
    check_alike(before, &after)?;
    let objects_after = timed(&mut run.stages.operations, || {
        after.chosen(&args.choice, args.compare_clicks.as_deref())
    })?;
    if objects.all().is_empty() && objects_after.all().is_empty() {
        return Err(before.unchosen(Some(&after)));
    }
    let changes = timed(&mut run.stages.operations, || {
        Changes::new(objects, &objects_after, args.min_overlap)
    });
    let wrong = |error| before.input.wrong(format_args!("beside {}: {error}", after.input.name));
    let changes = changes.map_err(wrong)?;
    let layers = args.layers();
    let described = Described {
        objects: [objects, &objects_after],
        means: [before.means.clone(), after.means.clone()],
    };
    let parts = [
        (ImageLayer::Gained, Part::Gained),
        (ImageLayer::Lost, Part::Lost),
        (ImageLayer::Change, Part::All),
    ];
    let mut records: Vec<Vec<(ImageLayer, Record)>> = vec![Vec::new(); changes.list().len()];
    timed(&mut run.stages.operations, || {
        for (layer, part) in parts.into_iter().filter(|(layer, _)| layers.contains(layer)) {
            let shapes = changes.polygons(part);
            for ((change, polygons), records) in changes.list().iter().zip(shapes).zip(&mut records)
            {
                if !polygons.is_empty() {
                    let mut values = vec![layer.name().into()];
                    values.extend(described.values(change));
                    let shape = Shape::Polygons(polygons);
                    records.push((layer, Record { values, shape }));
                }
            }
        }
    });
    let plan = Plan {
        target: &args.target,
        thing: "changes",
        formats: FORMATS,
        columns: COLUMNS,
        engine: None,
        layers: several(&layers),
    };
    let is_picture = matches!(format, Format::Svg | Format::Png);
    let (grid, colours, crs) = (*objects.grid(), before.colours.clone(), before.crs.clone());
    let is_georeferenced = is_georeferenced(&grid, crs.as_ref());
    let overlay = Overlay { grid, colours, layers: Vec::new(), is_georeferenced, crs };
    // A feature each, of which nothing is computed any more.
    let feature = |index: usize| {
        let ring = box_ring(&grid, [0, 0], [grid.columns, grid.rows]);
        Feature { index, polygons: vec![vec![ring]], polygonal: true, ..Feature::default() }
    };
    let features: Vec<Feature> = (0..records.len()).map(feature).collect();
    let mut layer = Layer::of_features(before.crs.clone(), features.into_iter());
    layer.warnings.extend(uncompared(&changes, described.objects, &after));
    let title = title("Changes", &args.input);
    let painting = Painting { args, format, title, overlay, layers };
    painting.run(&plan, run, &before.input.name, layer, move |feature, _, stages, _| {
        let records = &records[feature.index];
        Ok(if is_picture {
            let drawn =
                |(layer, record): &(ImageLayer, Record)| (*layer, lines(record.shape.clone()));
            Found::Part(records.iter().map(drawn).collect::<Vec<Drawn>>())
        } else {
            let records: Vec<Record> = records.iter().map(|(_, record)| record.clone()).collect();
            timed(&mut stages.write, || {
                let mut bytes = Vec::new();
                record::write(&mut bytes, format, feature, None, COLUMNS, &records);
                Found::Bytes(bytes)
            })
        })
    })
}

/// Fails unless two images are of one kind and, as far as that is known, in one reference system.
fn check_alike(before: &Parted, after: &Parted) -> Result<(), Failure> {
    let name = &after.input.name;
    let wrong = |why: std::fmt::Arguments<'_>| Err(before.input.wrong(why));
    if let (Some(crs), Some(other)) = (&before.crs, &after.crs)
        && crs.differs_from(other)
    {
        return wrong(format_args!(
            "the reference system is {crs}, that of {name} {other}; project one image into the system of the other"
        ));
    }
    let [kind, other] = [before, after].map(|parted| parted.means.kind());
    if kind != other {
        return wrong(format_args!(
            "the image has {kind}, {name} {other}; compare two of a kind, or name bands of both with --bands"
        ));
    }
    Ok(())
}

/// What of the objects of two images is not compared, if there is such.
fn uncompared(changes: &Changes, objects: [&Objects; 2], after: &Parted) -> Vec<String> {
    let whose = ["its objects".to_owned(), format!("the objects of {}", after.input.name)];
    let told = changes.uncompared().into_iter().zip(objects).zip(whose);
    told.filter(|((left_out, _), _)| left_out.cells > 0)
        .map(|((left_out, objects), whose)| {
            let all: u64 = objects.all().iter().map(|object| object.whole.cells).sum();
            let (cells, n) = (left_out.cells, left_out.objects);
            format!(
                "{cells} of the {all} pixels of {whose} lie where only one image has data, {n} objects as a whole; \
                 they are not compared"
            )
        })
        .collect()
}

/// The objects of both images.
struct Described<'a> {
    objects: [&'a Objects; 2],
    means: [Means; 2],
}

impl Described<'_> {
    /// What is told of a change, behind its layer.
    fn values(&self, change: &Change) -> Vec<Value> {
        let [kept, gained, lost] = change.cells;
        let cell = self.objects[0].grid().cell;
        let area = |cells: u64| Value::from(cells as f64 * (cell[0] * cell[1]).abs());
        let known = [change.before, change.after];
        let [before, after] =
            [0, 1].map(|side| known[side].map(|number| &self.objects[side].all()[number as usize]));
        let name = match (before, after) {
            (Some(_), None) => "vanished",
            (None, _) => "appeared",
            (Some(_), Some(_)) if gained + lost == 0 => "same",
            _ => "changed",
        };
        let region = |object: Option<&medial_image::Object>| {
            object.map_or(Value::None, |object| object.regions[0].into())
        };
        let colour = |side: usize| {
            let object = [before, after][side];
            object.map_or(Value::None, |object| {
                self.means[side].color(object.regions[0], object.whole.mean)
            })
        };
        let pixels = |cells: u64| Value::from(cells as usize);
        let both = before.zip(after).filter(|_| !matches!(self.means[0], Means::Labels(_)));
        let distance = both.map(|(a, b)| a.whole.distance(b.whole.mean));
        vec![
            name.into(),
            region(before),
            region(after),
            pixels(kept + lost),
            pixels(kept + gained),
            area(kept + lost),
            area(kept + gained),
            area(kept),
            area(gained),
            area(lost),
            area(gained + lost),
            change.overlap().into(),
            colour(0),
            colour(1),
            distance.map_or(Value::None, |distance| f64::from(distance).into()),
        ]
    }
}
