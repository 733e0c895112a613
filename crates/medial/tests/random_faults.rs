//! Whatever is changed in a right axis, the judge finds it, and nothing makes it panic.

mod support;

use medial::axis::{KeypointKind, Path, SiteKind};
use medial::check;
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::geom::Point;
use support::parts::{Keypoint, Parts};
use support::random::{self, Family, Ground, Random};
use support::{compare, shapes};

/// One random change; says what it did, or `None` if it found nothing to change.
fn fault(random: &mut Random, parts: &mut Parts) -> Option<&'static str> {
    let mut pick = |n: usize| (n > 0).then(|| random.below(n as u64) as usize);
    let k = pick(parts.keypoints.len())?;
    let p = pick(parts.paths.len());
    let s = pick(parts.sites.len())? as u32;
    let place = pick(parts.keypoints[k].governors.len())?;
    let other = pick(parts.keypoints.len())? as u32;
    let far = [8.0, 1e3, 1e12][pick(3)?];
    let governors = &mut parts.keypoints[k].governors;
    Some(match pick(22)? {
        0 => {
            parts.paths.remove(p?);
            "drop a path"
        }
        1 => {
            let path = parts.paths[p?];
            parts.paths.push(path);
            "double a path"
        }
        2 => {
            let path = &mut parts.paths[p?];
            std::mem::swap(&mut path.left, &mut path.right);
            "swap the sides of a path"
        }
        3 => {
            parts.paths[p?].left = s;
            "another left governor"
        }
        4 => {
            parts.paths[p?].right = s;
            "another right governor"
        }
        5 => {
            parts.paths[p?].to = other;
            "another end"
        }
        6 => {
            let path = &mut parts.paths[p?];
            std::mem::swap(&mut path.from, &mut path.to);
            "swap the ends of a path"
        }
        7 => {
            governors.remove(place);
            "leave out a governor"
        }
        8 => {
            governors.insert(place, s);
            "one more governor"
        }
        9 => {
            governors[place] = s;
            "another governor"
        }
        10 => {
            let next = (place + 1) % governors.len();
            governors.swap(place, next);
            "swap two governors"
        }
        11 => {
            governors.reverse();
            "reverse a list"
        }
        12 => {
            let keypoint = &mut parts.keypoints[k];
            let scale = keypoint.position.x.abs().max(keypoint.position.y.abs());
            let scale = scale.max(keypoint.radius);
            keypoint.position.x += far * (scale.next_up() - scale);
            "move a keypoint"
        }
        13 => {
            let keypoint = &mut parts.keypoints[k];
            let scale = keypoint.position.x.abs().max(keypoint.position.y.abs());
            let scale = scale.max(keypoint.radius);
            keypoint.radius += far * (scale.next_up() - scale);
            "change a radius"
        }
        14 => {
            let keypoint = &mut parts.keypoints[k];
            keypoint.kind = match keypoint.kind {
                KeypointKind::End => KeypointKind::Transition,
                KeypointKind::Transition => KeypointKind::Junction,
                _ => KeypointKind::End,
            };
            "change a kind"
        }
        15 => {
            let site = &mut parts.sites[s as usize];
            std::mem::swap(&mut site.a, &mut site.b);
            "reverse a site"
        }
        16 => {
            parts.sites[s as usize].index += 1;
            "rename a site"
        }
        17 => {
            parts.sites[s as usize].kind = SiteKind::Vertex;
            "make a site a corner"
        }
        18 => {
            let copy = parts.keypoints[k].clone();
            parts.keypoints.push(copy);
            "double a keypoint"
        }
        19 => {
            // Both ends of a path become one keypoint.
            let path = parts.paths.swap_remove(p?);
            for other in &mut parts.paths {
                for end in [&mut other.from, &mut other.to] {
                    if *end == path.to {
                        *end = path.from;
                    }
                }
            }
            "contract a path"
        }
        20 => {
            let path = parts.paths[p?];
            let [a, b] = [path.from, path.to].map(|k| parts.keypoints[k as usize].clone());
            let middle = parts.keypoints.len() as u32;
            parts.keypoints.push(Keypoint {
                position: (a.position + b.position) * 0.5,
                radius: 0.5 * (a.radius + b.radius),
                kind: KeypointKind::Transition,
                governors: vec![path.left, path.right],
            });
            parts.paths[p?].to = middle;
            parts.paths.push(Path { from: middle, ..path });
            "split a path"
        }
        _ => {
            // The ends of two paths change places.
            let q = random.below(parts.paths.len() as u64) as usize;
            let (a, b) = (parts.paths[p?].to, parts.paths[q].to);
            parts.paths[p?].to = b;
            parts.paths[q].to = a;
            "swap the ends of two paths"
        }
    })
}

/// Whether two axes say the same: one may rotate lists, and tell paths from the other end.
fn same(a: &Parts, b: &Parts) -> bool {
    let bits = |p: Point| (p.x.to_bits(), p.y.to_bits());
    let sites = a.sites == b.sites
        && a.sites
            .iter()
            .zip(&b.sites)
            .all(|(a, b)| (bits(a.a), bits(a.b)) == (bits(b.a), bits(b.b)));
    let keypoints = a.keypoints.len() == b.keypoints.len()
        && a.keypoints.iter().zip(&b.keypoints).all(|(a, b)| {
            (bits(a.position), a.radius.to_bits(), a.kind)
                == (bits(b.position), b.radius.to_bits(), b.kind)
        });
    sites && keypoints && compare::differences(&a.axis(), &b.axis()).is_empty()
}

/// Some random valid shape with its axis.
fn subject(random: &mut Random) -> Option<(Domain, Parts)> {
    let (family, ground) = [
        (Family::Tangle, Ground::Square),
        (Family::Tangle, Ground::Grid(8)),
        (Family::Holes, Ground::Grid(12)),
        (Family::Triangles, Ground::Grid(3)),
        (Family::Squares, Ground::Grid(4)),
    ][random.below(5) as usize];
    let polygons = random::shape(random, family, ground);
    let options = Options { regroup: true, ..Options::default() };
    let domain = Domain::from_polygons(&polygons, &options).ok()?;
    let axis = path_tracing(&domain).ok()?;
    Some((domain, Parts::of(&axis)))
}

#[test]
fn every_single_fault_is_found() {
    let mut random = Random(11);
    let mut tried = 0;
    while tried < 4000 {
        let Some((domain, right)) = subject(&mut random) else { continue };
        for _ in 0..20 {
            let mut wrong = right.clone();
            let Some(what) = fault(&mut random, &mut wrong) else { continue };
            if same(&right, &wrong) {
                continue;
            }
            tried += 1;
            let verdict = check::defects(&domain, &wrong.axis());
            assert!(
                !verdict.defects.is_empty(),
                "{what} went unseen\n{right:#?}\nbecame\n{wrong:#?}"
            );
        }
    }
}

#[test]
fn every_number_of_faults_is_judged_without_panic() {
    let mut random = Random(12);
    let mut tried = 0;
    while tried < 4000 {
        let Some((domain, mut parts)) = subject(&mut random) else { continue };
        for _ in 0..1 + random.below(30) {
            fault(&mut random, &mut parts);
            tried += 1;
            parts.complete = random.below(3) > 0;
            let verdict = check::defects(&domain, &parts.axis());
            for defect in &verdict.defects {
                assert!(!defect.to_string().is_empty());
            }
        }
    }
}

#[test]
fn the_axis_of_another_shape_is_never_right() {
    let mut random = Random(13);
    let mut last: Option<(Domain, Parts)> = None;
    let mut tried = 0;
    while tried < 500 {
        let Some((domain, parts)) = subject(&mut random) else { continue };
        if let Some((_, other)) = &last
            && other.sites != parts.sites
        {
            tried += 1;
            assert!(!check::defects(&domain, &other.axis()).defects.is_empty());
        }
        last = Some((domain, parts));
    }
}

#[test]
fn an_axis_of_nothing_is_wrong() {
    let domain = shapes::domain("triangle_3_4_5");
    let mut parts = Parts::of(&path_tracing(&domain).expect("a triangle has an axis"));
    parts.sites.clear();
    parts.keypoints.clear();
    parts.paths.clear();
    assert!(!check::defects(&domain, &parts.axis()).defects.is_empty());
}
