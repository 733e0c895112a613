//! Regions of colour images, as all commands on them find and choose them.

use super::features::Run;
use super::means::{Means, Numbers, colour_of};
use super::pixels::Pixels;
use crate::args::{Choice, SegmentMethod, Segmentation};
use crate::failure::Failure;
use crate::guard::guarded;
use crate::input::Input;
use crate::progress::{Progress, Steps};
use crate::timings::timed;
use medial_image::{
    Action, Analysis, Click, Field, Filter, Labels, Objects, Region, Selection, feature_space, luv,
    mean_shift_with, near_colours, thresholds, thresholds_of,
};
use medial_io::clicks::{self, ClickRow};
use medial_io::{Crs, image};
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// An image in regions.
pub struct Parted {
    pub input: Input,
    pub crs: Option<Crs>,
    /// What the means of its regions are.
    pub means: Means,
    /// The values of bands that became 0 and 100.
    extents: [[f32; 2]; 3],
    pub labels: Labels,
    pub regions: Vec<Region>,
    /// Its pixels in colours, if they were asked for; bands are grey.
    pub colours: Vec<[f32; 3]>,
}

/// How far from its colour a pixel, or the mean of a region, may be where nothing is said.
const TOLERANCE: f64 = 20.0;

/// Reads an image and parts it into regions; bands go from 0 to 100 as in another one beside which it is looked at.
pub fn parted(
    args: &'static Segmentation,
    path: &Path,
    mask: Option<&Path>,
    run: &mut Run,
    keeps_colours: bool,
    beside: Option<&Parted>,
) -> Result<Parted, Failure> {
    let common = run.common;
    let input = timed(&mut run.stages.read, || Input::read(path))?;
    let Pixels { colours, numbers } =
        timed(&mut run.stages.read, || Pixels::read(args, common.from, path, &input, mask))?;
    let image::Colours { grid, crs, values, are_bands, n_bands, warnings } = colours;
    for warning in warnings.iter().filter(|_| !common.run.quiet) {
        crate::progress::line(&format!("warning: {}: {warning}", input.name));
    }
    let kept = if keeps_colours && !are_bands { values.clone() } else { Vec::new() };
    // Limits are in units of the first band.
    let is_cut = are_bands && args.method == SegmentMethod::Threshold;
    let band: Option<Vec<f32>> = is_cut.then(|| values.iter().map(|value| value[0]).collect());
    let (field, own) = timed(&mut run.stages.engine, || {
        let field = match are_bands {
            true => Field::new(grid, values),
            false => Field::of_colours(grid, values),
        };
        field.map(|field| {
            let extents = field.extents();
            (field, extents)
        })
    })
    .map_err(|error| input.wrong(error))?;
    let extents = beside.map_or(own, |other| other.extents);
    let field = if are_bands && numbers.is_none() { field.stretched(extents) } else { field };
    let colours = match &numbers {
        _ if !keeps_colours => Vec::new(),
        Some((numbers, are_colours)) => {
            numbers.iter().map(|&number| colour_of(number, *are_colours)).collect()
        }
        None if are_bands => {
            let bands = Means::Bands(n_bands);
            field.values().iter().map(|&value| bands.shown(0, value)).collect()
        }
        None => kept,
    };
    let threads = run.all_threads();
    let what = "parting the image";
    let counted = (args.method == SegmentMethod::MeanShift).then_some(grid.rows);
    let progress = Progress::working(common.run.progress, common.run.quiet, what, counted);
    if let Some(told) = one_sided(&args.limits, own[0]) {
        progress.warning(&format!("{}: {told}", input.name));
    }
    let steps = progress.steps();
    let found = timed(&mut run.stages.engine, || {
        within(common.run.limit(), move || {
            let (labels, means) = match numbers {
                Some((numbers, are_colours)) => {
                    let (labels, of) = Labels::given(*field.grid(), &numbers);
                    (labels, Means::Labels(Arc::new(Numbers { of, are_colours })))
                }
                None => {
                    let means = if are_bands { Means::Bands(n_bands) } else { Means::Colours };
                    (labels(args, &field, band.as_deref(), threads, &steps), means)
                }
            };
            let regions = labels.regions(&field);
            (labels, means, regions)
        })
    });
    progress.finish();
    let (labels, means, regions) = match found.map_err(|panic| input.wrong(panic))? {
        Some(found) => found,
        None => {
            let why = "takes longer to be parted into regions than --max-seconds allows; give it more, or a smaller image";
            return Err(input.wrong(why));
        }
    };
    if labels.is_empty() {
        return Err(input.wrong("has no pixel with data; there is nothing to part"));
    }
    Ok(Parted { input, crs, means, extents, labels, regions, colours })
}

/// What to say of a limit that has all values on one side.
fn one_sided(limits: &[f32], [low, high]: [f32; 2]) -> Option<String> {
    let beyond = limits.iter().find(|&&limit| low <= high && (limit <= low || limit > high))?;
    Some(format!(
        "the limit {beyond} has all values, which go from {low} to {high}, on one side, and parts nothing"
    ))
}

/// What work gives, unless it takes longer; then it is left to itself.
fn within<T: Send + 'static>(
    limit: Option<Duration>,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<Option<T>, String> {
    let Some(limit) = limit else { return guarded(work).map(Some) };
    let (sender, receiver) = mpsc::channel();
    // Nobody listens after the time is over.
    thread::spawn(move || drop(sender.send(guarded(work))));
    match receiver.recv_timeout(limit) {
        Ok(found) => found.map(Some),
        Err(RecvTimeoutError::Timeout) => Ok(None),
        Err(RecvTimeoutError::Disconnected) => Err("the work broke off".to_owned()),
    }
}

impl Parted {
    /// The regions that are chosen, as objects; there may be none. A file of clicks may take the place of all others.
    pub fn chosen(&self, choice: &Choice, instead: Option<&Path>) -> Result<Objects, Failure> {
        let Choice { min_pixels, max_pixels, select_color, select_tolerance, .. } = choice;
        let has_filter = min_pixels.is_some() || max_pixels.is_some() || !select_color.is_empty();
        if self.means.are_bands() && !select_color.is_empty() {
            let why = "has bands that are no colours; choose regions by their size or by points";
            return Err(self.input.wrong(why));
        }
        let colours: Vec<[f32; 3]> = select_color.iter().map(|&colour| of_bytes(colour)).collect();
        let near = select_tolerance.unwrap_or(TOLERANCE) as f32;
        let pixels = min_pixels.unwrap_or(0)..=max_pixels.unwrap_or(u64::MAX);
        let is_asked = |number: u32, region: &Region| {
            // The number 0 of labels is the ground.
            let is_ground = match &self.means {
                Means::Labels(numbers) => {
                    !numbers.are_colours && numbers.of[number as usize] == 0.0
                }
                _ => false,
            };
            !is_ground
                && pixels.contains(&region.cells)
                && (colours.is_empty() || colours.iter().any(|&c| region.distance(c) <= near))
        };
        let clicks = match instead {
            Some(path) => clicks_of(path)?,
            None => clicks(choice)?,
        };
        let begins_empty =
            !has_filter && clicks.first().is_some_and(|(_, click)| click.action != Action::Remove);
        let numbered = (0..).zip(&self.regions);
        let all = numbered.filter(|&(number, region)| !begins_empty && is_asked(number, region));
        let mut chosen = Selection::of(all.map(|(number, _)| number));
        for (place, click) in clicks {
            chosen
                .click(&self.labels, click)
                .map_err(|error| self.input.wrong(format_args!("{place}: {error}")))?;
        }
        Ok(Objects::new(&self.labels, &self.regions, &chosen))
    }

    /// That no region is chosen, here or in another image.
    pub fn unchosen(&self, other: Option<&Self>) -> Failure {
        let n = self.regions.len();
        let beside = other.map_or_else(String::new, |other| {
            format!(", nor of the {} of {}", other.regions.len(), other.input.name)
        });
        self.input.wrong(format_args!(
            "none of its {n} regions is chosen{beside}; see them with `medial segment`, and choose others"
        ))
    }
}

/// All clicks, each with the place where it is said.
fn clicks(choice: &Choice) -> Result<Vec<(String, Click)>, Failure> {
    let mut clicks = Vec::new();
    for (number, &at) in choice.at.iter().enumerate() {
        let action = if choice.combine && number > 0 { Action::Combine } else { Action::Add };
        clicks.push(("--at".to_owned(), Click { action, at }));
    }
    let removed = choice.remove.iter();
    let removed = removed.map(|&at| Click { action: Action::Remove, at });
    clicks.extend(removed.map(|click| ("--remove".to_owned(), click)));
    if let Some(path) = &choice.clicks {
        clicks.extend(clicks_of(path)?);
    }
    Ok(clicks)
}

/// Those of a file.
fn clicks_of(path: &Path) -> Result<Vec<(String, Click)>, Failure> {
    let file = Input::read(path)?;
    let rows = clicks::read(file.bytes()).map_err(|error| file.wrong(error))?;
    let click = |row: ClickRow| {
        let place = format!("{}: line {}", file.name, row.line);
        let action = row.action.parse::<Action>();
        let action = action.map_err(|error| Failure::file(&place, error))?;
        Ok((place, Click { action, at: row.at }))
    };
    rows.into_iter().map(click).collect()
}

fn of_bytes(colour: [u8; 3]) -> [f32; 3] {
    luv(colour.map(|value| f32::from(value) / 255.0))
}

/// Fails if something is said to a method that another one would listen to.
pub fn check(args: &Segmentation) -> Result<(), Failure> {
    use SegmentMethod::{Colours, FeatureSpace, Labels, MeanShift, Threshold};
    let said: [(&str, bool, SegmentMethod, &str); 7] = [
        ("--resolution", args.resolution.is_some(), FeatureSpace, "feature_space"),
        ("--seed", args.seed.is_some(), FeatureSpace, "feature_space"),
        ("--spatial", args.spatial.is_some(), MeanShift, "mean_shift"),
        ("--range", args.range.is_some(), MeanShift, "mean_shift"),
        ("--limits", !args.limits.is_empty(), Threshold, "threshold"),
        ("--color", !args.color.is_empty(), Colours, "colours"),
        ("--color-tolerance", args.color_tolerance.is_some(), Colours, "colours"),
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
    let of_values =
        [("--bands", !args.bands.is_empty()), ("--min-region", args.min_region.is_some())];
    if let Some((option, _)) = of_values.iter().find(|said| said.1 && args.method == Labels) {
        return usage(format!("{option} is not for --method labels, whose regions are given"));
    }
    Ok(())
}

/// The regions by the method that is asked for.
fn labels(
    args: &Segmentation,
    field: &Field,
    band: Option<&[f32]>,
    threads: NonZeroUsize,
    steps: &Steps,
) -> Labels {
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
            let filter = Filter {
                spatial: args.spatial.map_or(usual.spatial, |radius| radius as f32),
                range: args.range.map_or(usual.range, |radius| radius as f32),
                min_region: args.min_region.unwrap_or(usual.min_region),
                threads,
            };
            mean_shift_with(field, &filter, &|| steps.step())
        }
        SegmentMethod::Threshold => match band {
            Some(band) => thresholds_of(field, band, &args.limits, min_region),
            None => thresholds(field, &args.limits, min_region),
        },
        SegmentMethod::Colours => {
            let colours: Vec<[f32; 3]> =
                args.color.iter().map(|&colour| of_bytes(colour)).collect();
            let distance = args.color_tolerance.unwrap_or(TOLERANCE) as f32;
            near_colours(field, &colours, distance, min_region)
        }
        // Its regions are given.
        SegmentMethod::Labels => thresholds(field, &[], 1),
    }
}
