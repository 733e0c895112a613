use super::features::Run;
use crate::args::{CheckArgs, Form};
use crate::failure::{Failure, Status};
use crate::input::Input;
use crate::output::Output;
use crate::timings::timed;
use crate::verdicts::{Document, Judged};
use medial_io::{Error, axis_document};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// `medial check`.
pub fn run(args: &'static CheckArgs) -> Result<Status, Failure> {
    if args.domain.as_os_str() == "-" && args.axis.as_os_str() == "-" {
        let why = "polygons and axes cannot both come from standard input; name a file";
        return Err(Failure::Usage(why.to_owned()));
    }
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.flattening.tolerance;
    let axes = timed(&mut run.stages.read, || Input::read(&args.axis))?;
    let documents = Arc::new(timed(&mut run.stages.read, || read_documents(&axes))?);
    let of_features = Arc::clone(&documents);
    let input = run.open(&args.domain)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let mut output = Output::create(args.output.as_deref())?;
    let (at_once, _) = run.threads(&layer);
    let told = move |judged: &Judged| match args.to {
        Form::Text => judged.text(),
        Form::Json => judged.json(),
    };
    let mut n_defects = 0;
    let mut seen = BTreeSet::new();
    let status = run.each(
        &input.name,
        layer,
        at_once,
        move |feature, domain, stages, bytes| {
            let of_feature = of_features.get(&feature.index).map_or(&[][..], Vec::as_slice);
            let judged = timed(&mut stages.operations, || Judged::all(feature, domain, of_feature));
            timed(&mut stages.write, || {
                judged.iter().for_each(|one| bytes.extend(told(one).into_bytes()));
            });
            Ok((feature.index, judged.iter().map(|one| one.defects.len()).sum::<usize>()))
        },
        |(feature, defects)| {
            n_defects += defects;
            seen.insert(feature);
        },
        |bytes| output.write(bytes),
    )?;
    for &feature in documents.keys().filter(|feature| !seen.contains(*feature)) {
        let judged = Judged::without_domain(feature);
        n_defects += judged.defects.len();
        output.write(told(&judged).as_bytes())?;
    }
    if status != Status::NoResult || n_defects > 0 {
        output.finish()?;
    }
    run.finish()?;
    Ok(if n_defects > 0 { Status::Defects } else { status })
}

/// The documents of each feature, or what makes no sense in one.
fn read_documents(input: &Input) -> Result<BTreeMap<usize, Vec<Document>>, Failure> {
    let mut documents: BTreeMap<usize, Vec<Document>> = BTreeMap::new();
    for document in axis_document::read(input.text()?) {
        let (feature, document) = match document {
            Ok(document) => (document.feature, Ok(document)),
            Err(Error::Document { feature, place, why }) => {
                (feature, Err(format!("{place}: {why}")))
            }
            Err(error) => return Err(input.wrong(error)),
        };
        documents.entry(feature).or_default().push(document);
    }
    Ok(documents)
}
