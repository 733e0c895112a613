//! Compares axes as graphs, without coordinates.

use std::collections::BTreeMap;

use medial::axis::{MedialAxis, SiteKind};

/// Place of a site in the input.
type Name = (SiteKind, u32, u32, u32, u32);

/// A cyclic list of governors, rotated to its smallest name.
type List = Vec<Name>;

/// A path by the lists at its ends and its governors, `left` the smaller name.
type Line = (List, List, Name, Name);

/// What makes two axes the same: how often each governor list and each path occurs.
#[derive(Debug, PartialEq, Eq)]
struct Graph {
    keypoints: BTreeMap<List, usize>,
    paths: BTreeMap<Line, usize>,
}

/// Where two axes differ, in words; empty if their graphs are the same.
pub fn differences(first: &MedialAxis, second: &MedialAxis) -> Vec<String> {
    let (a, b) = (Graph::of(first), Graph::of(second));
    let mut found = Vec::new();
    let mut note = |kind: &str, what: String, in_a: usize, in_b: usize| {
        if in_a != in_b {
            found.push(format!("{kind} {what}: {in_a} against {in_b}"));
        }
    };
    let keys: std::collections::BTreeSet<_> =
        a.keypoints.keys().chain(b.keypoints.keys()).collect();
    for key in keys {
        let count = |g: &Graph| g.keypoints.get(key).copied().unwrap_or(0);
        note("keypoint", words(key), count(&a), count(&b));
    }
    let keys: std::collections::BTreeSet<_> = a.paths.keys().chain(b.paths.keys()).collect();
    for key in keys {
        let count = |g: &Graph| g.paths.get(key).copied().unwrap_or(0);
        let what = format!(
            "from {} to {} between {} and {}",
            words(&key.0),
            words(&key.1),
            word(&key.2),
            word(&key.3)
        );
        note("path", what, count(&a), count(&b));
    }
    found
}

impl Graph {
    fn of(axis: &MedialAxis) -> Self {
        let name = |number: u32| {
            let site = axis.sites().at(number);
            (site.kind, site.polygon, site.ring, site.index, site.part)
        };
        let list = |keypoint: u32| {
            let mut list: List = axis.governors(keypoint).iter().map(|&g| name(g)).collect();
            let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
            list.rotate_left(least);
            list
        };
        let mut graph = Self { keypoints: BTreeMap::new(), paths: BTreeMap::new() };
        for k in 0..axis.keypoints().len() as u32 {
            *graph.keypoints.entry(list(k)).or_default() += 1;
        }
        for path in axis.paths() {
            let (from, to) = (list(path.from), list(path.to));
            let (left, right) = (name(path.left), name(path.right));
            let line =
                if left <= right { (from, to, left, right) } else { (to, from, right, left) };
            *graph.paths.entry(line).or_default() += 1;
        }
        graph
    }
}

fn word(name: &Name) -> String {
    let (kind, polygon, ring, index, part) = name;
    let kind = match kind {
        SiteKind::Edge => 'e',
        SiteKind::Vertex => 'v',
    };
    format!("{kind}{polygon}.{ring}.{index}.{part}")
}

fn words(list: &List) -> String {
    let words: Vec<String> = list.iter().map(word).collect();
    format!("[{}]", words.join(" "))
}
