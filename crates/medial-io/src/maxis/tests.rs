use super::*;
use crate::{Error, Format, wkt};
use medial::axis::{Accuracy, Engine};
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::ops::{Corners, DiskGraph, GridDisk, Run, compress};

fn corners(text: &str) -> Compressed {
    let feature = wkt::read(text).next().unwrap().unwrap();
    let polygons = feature.polygons;
    Compressed::Corners(Corners {
        engine: Engine::DivideAndConquer,
        regroup: true,
        error: 0.0,
        polygons,
    })
}

fn simplified(text: &str, error: f64) -> Compressed {
    let Compressed::Corners(corners) = corners(text) else { panic!("these are corners") };
    Compressed::Corners(corners.simplified(error).unwrap())
}

fn disks(text: &str, error: f64) -> Compressed {
    let feature = wkt::read(text).next().unwrap().unwrap();
    let domain = Domain::from_polygons(&feature.polygons, &Options::default()).unwrap();
    let axis = path_tracing(&domain).unwrap();
    Compressed::Disks(compress(&domain, &axis, error).unwrap())
}

const L: &str = "POLYGON ((0 0, 3 0, 3 1, 1 1, 1 3, 0 3, 0 0))";
const RING: &str = "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3)), \
                    ((20 0.5, 21 0.1, 21 3)))";

const TWICE: &str = "((0.12345678901234567 0.98765432109876543, 1.1234567890123457e-3 -0.55555555555555558, \
                     7.7777777777777777 0.33333333333333331, 0.12345678901234567 0.98765432109876543))";

fn records() -> Vec<Record> {
    let shapes = [
        corners(L),
        corners(RING),
        corners("POLYGON ((0.1 0.2, 3.33 0, 1 1))"),
        corners("POLYGON ((0.3333333333333333 1e-7, 3.75 -0, 1 1e100))"),
        simplified(RING, 0.25),
        // Each point of a strip is there twice, as it is in its neighbour.
        corners(&format!("MULTIPOLYGON ({TWICE}, {TWICE}, {TWICE})")),
        corners("POLYGON EMPTY"),
        corners("MULTIPOLYGON EMPTY"),
        disks(L, 0.1),
        disks(RING, 0.01),
        disks(RING, 2.0),
        disks(L, 0.1),
    ];
    (0..)
        .zip(shapes)
        .map(|(k, shape)| {
            let id = (k % 3 == 1).then(|| json(&format!("{{\"a\": {k}}}")));
            Record { feature: k * k, id, shape }
        })
        .collect()
}

fn json(text: &str) -> crate::Json {
    serde_json::value::RawValue::from_string(text.to_owned()).unwrap()
}

fn same(a: &Record, b: &Record) -> bool {
    let id = |record: &Record| record.id.as_ref().map(|id| id.get().to_owned());
    // Debug tells zeros apart, as their bits do.
    (a.feature, id(a), format!("{:?}", a.shape)) == (b.feature, id(b), format!("{:?}", b.shape))
}

#[test]
fn what_is_written_is_read_back() {
    let crs = json("{\"type\": \"name\"}");
    let records = records();
    let bytes = write(Some(&crs), &records);
    let read = super::records(&bytes).unwrap();
    assert_eq!(read.crs.as_ref().unwrap().get(), crs.get());
    let read: Vec<Record> = read.map(Result::unwrap).collect();
    assert_eq!(read.len(), records.len());
    assert!(read.iter().zip(&records).all(|(a, b)| same(a, b)), "{read:#?}");
    assert_eq!(write(Some(&crs), &read), bytes);
}

#[test]
fn axes_come_with_their_accuracy() {
    let records = vec![
        Record { feature: 2, id: None, shape: corners(RING) },
        Record { feature: 5, id: None, shape: disks(RING, 0.25) },
    ];
    let axes: Vec<_> = read(&write(None, &records)).unwrap().map(Result::unwrap).collect();
    assert_eq!((axes[0].feature, axes[0].axis.accuracy), (2, Accuracy::Exact));
    assert!(axes[0].axis.complete && axes[0].axis.engine == Engine::DivideAndConquer);
    let Accuracy::Sampled(error) = axes[1].axis.accuracy else { panic!("disks are no exact axis") };
    assert!(axes[1].feature == 5 && error > 0.0 && error <= 0.25);
}

#[test]
fn an_empty_layer_has_no_features() {
    let bytes = write(None, &[]);
    let mut records = super::records(&bytes).unwrap();
    assert!(records.crs.is_none() && records.next().is_none());
    assert_eq!(Format::of_content(&bytes).unwrap(), crate::Content::CompressedAxes);
}

#[test]
fn damage_is_told() {
    let bytes = write(None, &records());
    let told = |bytes: &[u8]| {
        super::records(bytes).err().map(|error| error.to_string()).unwrap_or_default()
    };
    assert!(told(b"POLYGON EMPTY").contains("no compressed axis"));
    assert!(told(&bytes[..5]).contains("no compressed axis"));
    assert!(told(b"\x8dMAXIS\r\n\x01").contains("line ends"));
    assert!(told(&bytes[..7]).contains("ends too early"));
    assert!(told(&bytes[..10]).contains("ends too early"));
    assert!(told(&bytes[..bytes.len() - 1]).contains("checksum"));
    let mut other = bytes.clone();
    other[7] = 2;
    assert!(told(&other).contains("version 2 is not 1"));
    for at in 8..bytes.len() {
        let mut other = bytes.clone();
        other[at] ^= 0x10;
        assert!(told(&other).contains("checksum"), "{at}");
    }
}

/// A file with this body, whose checksum is right.
fn sealed(body: &[u8]) -> Vec<u8> {
    let stored = [&[PLAIN][..], body].concat();
    [&MAGIC[..], &crc32fast::hash(&stored).to_le_bytes(), &stored].concat()
}

#[test]
fn what_is_malformed_under_a_good_checksum_is_told() {
    let why = |body: &[u8]| match super::records(&sealed(body)) {
        Err(error) => error.to_string(),
        Ok(mut records) => records.find_map(Result::err).map(|e| e.to_string()).unwrap_or_default(),
    };
    assert_eq!(why(&[2, 0, 0, 0, 0, 0]), "");
    assert!(why(&[3, 0, 0, 0, 0, 0]).contains("columns do not fit"));
    assert!(why(&[2, 0, 0, 0, 0, 200]).contains("too early"));
    // One feature, number 0, no id, of an unknown kind, engine 0, grid 0.
    assert!(why(&[7, 0, 0, 0, 0, 1, 0, 0, 9, 0, 0]).contains("9 is no kind"));
    assert!(why(&[7, 0, 0, 0, 0, 1, 0, 0, 0, 7, 0]).contains("7 is no engine"));
    // One run, of one disk that begins at one that is not there.
    let run = |from| [12, 1, 1, 1, 0, 1, 0, 0, 0, 0, 0, 16, 0, 1, 2, from, 0, 0, 0];
    assert_eq!(why(&run(0)), "");
    assert!(why(&run(5)).contains("a disk is named that is not there"));
    // The last byte belongs to no feature.
    let more = [12, 1, 1, 2, 0, 1, 0, 0, 0, 0, 0, 16, 0, 1, 2, 0, 0, 0, 0, 0];
    assert!(why(&more).contains("1 bytes follow"), "{}", why(&more));
}

#[test]
fn a_small_file_cannot_fill_the_memory() {
    let stored =
        [&[DEFLATED][..], &miniz_oxide::deflate::compress_to_vec(&[0; 1 << 20], 9)].concat();
    let file = [&MAGIC[..], &crc32fast::hash(&stored).to_le_bytes(), &stored].concat();
    assert!(matches!(super::records(&file), Err(Error::Value { .. })));
    // What repeats itself that often is written as it is.
    let record = |feature| Record { feature, id: None, shape: corners(L) };
    let bytes = write(None, &(0..5000).map(record).collect::<Vec<_>>());
    assert_eq!(super::records(&bytes).unwrap().filter(Result::is_ok).count(), 5000);
}

#[test]
fn runs_that_close_are_read_back() {
    let disk = |x, y, radius| GridDisk { x, y, radius };
    let all =
        vec![disk(i64::from(u32::MAX), -5, 7), disk(0, 0, 0), disk(3, 4, 1 << 52), disk(1, 1, 1)];
    let runs = vec![
        Run { from: None, len: 3, to: Some(0) },
        Run { from: Some(1), len: 1, to: Some(1) },
        Run { from: Some(3), len: 0, to: Some(2) },
    ];
    let graph = DiskGraph::from_parts(Engine::PathTracing, -7, 9, all, runs).unwrap();
    let record = Record { feature: 0, id: None, shape: Compressed::Disks(graph) };
    let bytes = write(None, std::slice::from_ref(&record));
    assert!(same(&super::records(&bytes).unwrap().next().unwrap().unwrap(), &record));
}
