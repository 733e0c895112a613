//! Readers on damaged input: an answer, never a panic.

use medial::axis::Engine;
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::ops::{Compressed, Corners, compress};
use medial_io::maxis::{self, Record};
use medial_io::{Format, axis_document, read};

const SEEDS: [(Format, &[u8]); 5] = [
    (
        Format::GeoJson,
        br#"{"type":"FeatureCollection","crs":{"a":1},"features":[{"type":"Feature","id":1,
            "properties":{"k":[1,"x"]},"geometry":{"type":"GeometryCollection","geometries":[
            {"type":"Polygon","coordinates":[[[0,0],[4.5,-1e3],[4,2],[0,0]],[[1,1],[2,1,7],[2,2]]]},
            {"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1]]]]}]}},{"type":"Feature"}]}"#,
    ),
    (
        Format::GeoJsonLines,
        b"{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1,0],[1,1]]]}\n\x1e{\"type\":\"Point\",\"coordinates\":[3,4]}\n",
    ),
    (
        Format::Wkt,
        b"SRID=4326;POLYGON Z ((0 0 1, 4e2 -0.5 1, 4 2 1), (1 1 1, 2 1 1, 2 2 1))\n\
          GEOMETRYCOLLECTION (POINT (0 0), MULTIPOLYGON (((0 0, 1 0, 1 1)), EMPTY))\n\
          LINESTRING (0 0, 1 0, 1 1, 0 0)",
    ),
    (
        Format::Wkb,
        b"\x01\x03\0\0\0\x01\0\0\0\x03\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x10@\
          \0\0\0\0\0\0\0\0\0\0\0\0\0\0\x10@\0\0\0\0\0\0\0@",
    ),
    (Format::Rings, b"[[[0,0],[4,0],[4,2]],[[1,1],[2,1],[2,2]]]\n[[[[0,0],[1,0],[1,1]]]]"),
];

const DOCUMENT: &[u8] = include_bytes!("../../../fixtures/l_with_unit_arms.axis.json");

/// A small generator of numbers, the same on every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n as u64) as usize
    }
}

/// The input with one to three of: a byte changed, a run cut out, a run repeated, the end lost.
fn damaged(seed: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=dice.below(3) {
        if bytes.is_empty() {
            break;
        }
        let at = dice.below(bytes.len());
        let end = (at + 1 + dice.below(12)).min(bytes.len());
        match dice.below(4) {
            0 => bytes[at] = b"[]{}(),:\"-e0 \nZ\xff\0\x01"[dice.below(18)],
            1 => drop(bytes.drain(at..end)),
            2 => bytes.splice(at..at, bytes[at..end].to_vec()).for_each(drop),
            _ => bytes.truncate(at),
        }
    }
    bytes
}

#[test]
fn damaged_polygons_are_read_or_refused() {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    let (mut good, mut bad) = (0, 0);
    for (format, seed) in SEEDS {
        assert!(read(format, seed).unwrap().next().unwrap().is_ok(), "{format}");
        for _ in 0..4000 {
            let bytes = damaged(seed, &mut dice);
            let _ = Format::of_content(&bytes);
            let Ok(layer) = read(format, &bytes) else {
                bad += 1;
                continue;
            };
            for (k, feature) in layer.enumerate() {
                match feature {
                    Ok(feature) => {
                        assert_eq!(feature.index, k);
                        assert!(feature.polygonal || feature.polygons.is_empty());
                        good += 1;
                    }
                    Err(error) => {
                        // Points are passed over where others of them are malformed.
                        assert!(error.feature >= k);
                        assert!(!error.to_string().contains('\n'));
                        bad += 1;
                    }
                }
            }
        }
    }
    assert!(good > 5000 && bad > 5000, "{good} good, {bad} bad");
}

#[test]
fn damaged_axis_documents_are_read_or_refused() {
    let mut dice = Dice(0x2545_f491_4f6c_dd1d);
    let (mut good, mut bad) = (0, 0);
    for _ in 0..4000 {
        let bytes = damaged(DOCUMENT, &mut dice);
        let Ok(text) = medial_io::text(&bytes) else { continue };
        for document in axis_document::read(text) {
            match document {
                // What is read can be drawn, whatever its numbers say.
                Ok(document) => {
                    for path in document.axis.paths() {
                        let curve = document.axis.curve(&path);
                        let _ =
                            (curve.length(), curve.polyline(1e-2), curve.polyline_in_space(1e-2));
                    }
                    good += 1;
                }
                Err(_) => bad += 1,
            }
        }
    }
    assert!(good > 20 && bad > 1000, "{good} good, {bad} bad");
}

/// The bytes of a compressed axis of all seeds that hold domains, as disks and as corners.
fn compressed() -> Vec<u8> {
    let polygons = SEEDS.iter().flat_map(|(format, seed)| read(*format, seed).unwrap());
    let mut records = Vec::new();
    for feature in polygons {
        let polygons = feature.unwrap().polygons;
        if let Ok(domain) = Domain::from_polygons(&polygons, &Options::default()) {
            let axis = path_tracing(&domain).unwrap();
            let graph = compress(&domain, &axis, 0.02).unwrap();
            let shape = Compressed::Disks(graph);
            records.push(Record { feature: records.len(), id: None, shape });
        }
        let corners = Corners { engine: Engine::PathTracing, regroup: false, error: 0.0, polygons };
        let shape = Compressed::Corners(corners);
        records.push(Record { feature: records.len(), id: None, shape });
    }
    maxis::write(None, &records)
}

/// A compressed axis with this body, plain and with the right checksum.
fn sealed(body: &[u8]) -> Vec<u8> {
    let stored = [&[0][..], body].concat();
    [&maxis::MAGIC[..], &crc32fast::hash(&stored).to_le_bytes(), &stored].concat()
}

#[test]
fn damaged_compressed_axes_are_refused() {
    let mut dice = Dice(0x1234_5678_9abc_def1);
    let file = compressed();
    assert!(maxis::read(&file).unwrap().filter(Result::is_ok).count() > 4);
    for _ in 0..4000 {
        let bytes = damaged(&file, &mut dice);
        let _ = Format::of_content(&bytes);
        // The checksum finds whatever was changed.
        assert!(bytes == file || maxis::records(&bytes).is_err());
    }
}

#[test]
fn malformed_compressed_axes_are_read_or_refused() {
    let mut dice = Dice(0x0f1e_2d3c_4b5a_6978);
    let file = compressed();
    let body = miniz_oxide::inflate::decompress_to_vec(&file[13..]).unwrap();
    let (mut good, mut bad) = (0, 0);
    for _ in 0..4000 {
        let bytes = sealed(&damaged(&body, &mut dice));
        let Ok(records) = maxis::records(&bytes) else {
            bad += 1;
            continue;
        };
        for record in records {
            match record {
                // What is read can be an axis, whatever its numbers say.
                Ok(record) => {
                    if let Compressed::Disks(graph) = &record.shape {
                        assert!(graph.axis().is_some());
                    }
                    good += 1;
                }
                Err(error) => {
                    assert!(!error.to_string().contains('\n'));
                    bad += 1;
                }
            }
        }
    }
    assert!(good > 1000 && bad > 1000, "{good} good, {bad} bad");
}
