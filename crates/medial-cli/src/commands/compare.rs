use super::features::Run;
use crate::args::{CompareArgs, Rows};
use crate::comparison::{Comparison, Totals, csv_header};
use crate::failure::{Failure, Status};
use crate::output::Output;
use crate::timings::timed;
use std::num::NonZeroUsize;

/// `medial compare`.
pub fn run(args: &'static CompareArgs) -> Result<Status, Failure> {
    args.region.check()?;
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.flattening.tolerance;
    let rows = rows(args);
    let input = run.open(&args.input)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let mut output = Output::create(args.output.as_deref())?;
    let threads = args.common.run.threads.unwrap_or(NonZeroUsize::MIN);
    let mut totals = Totals::default();
    let mut begun = false;
    let status = run.each(
        &input.name,
        layer,
        // Two at once would share the memory and the processor whose use is measured.
        NonZeroUsize::MIN,
        move |feature, domain, stages, bytes| {
            let options = stages.options(threads);
            // All that is asked of a feature, or nothing.
            let mut of_sides = Vec::new();
            for &side in args.region.side.all() {
                of_sides.push(Comparison::new(feature, domain, side, args, &options, stages)?);
            }
            timed(&mut stages.write, || {
                for compared in &of_sides {
                    bytes.extend(match rows {
                        Rows::Json => compared.json().into_bytes(),
                        Rows::Csv => compared.csv(),
                        Rows::Text => compared.text().into_bytes(),
                    });
                }
            });
            Ok(of_sides)
        },
        |of_sides| totals.add(&of_sides),
        |bytes| {
            if rows == Rows::Csv && !std::mem::replace(&mut begun, true) {
                output.write(&csv_header())?;
            }
            output.write(bytes)
        },
    )?;
    if status != Status::NoResult {
        if rows == Rows::Text {
            output.write(totals.text().as_bytes())?;
        }
        output.finish()?;
    }
    run.finish()?;
    Ok(status)
}

/// The form of the rows: as asked for, by the extension, else JSON.
fn rows(args: &CompareArgs) -> Rows {
    let extension = args.output.as_ref().and_then(|path| path.extension()?.to_str());
    let of_extension = match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("csv") => Rows::Csv,
        Some("txt") => Rows::Text,
        _ => Rows::Json,
    };
    args.to.unwrap_or(of_extension)
}
