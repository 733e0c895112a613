use medial::domain::{Corner, Domain, DomainError, FillRule, Options};
use medial::geom::Point;

pub type Rings = Vec<Vec<Point>>;

/// Rings as text: coordinates after one another, rings divided by `/`.
pub fn rings(text: &str) -> Rings {
    let ring = |part: &str| {
        let numbers: Vec<f64> =
            part.split_whitespace().map(|w| w.parse().expect("a number")).collect();
        numbers.chunks_exact(2).map(|c| Point::new(c[0], c[1])).collect()
    };
    text.split('/').map(ring).collect()
}

pub const STRICT: Options = Options { strict: true, ..PLAIN };
pub const REGROUP: Options = Options { regroup: true, ..PLAIN };

const PLAIN: Options = Options {
    strict: false,
    regroup: false,
    repair: false,
    fill: FillRule::EvenOdd,
    dissolve: false,
    deadline: None,
};

pub fn domain(text: &str) -> Domain {
    Domain::from_polygons(&[rings(text)], &Options::default()).expect("a valid polygon")
}

pub fn error(text: &str) -> DomainError {
    Domain::from_polygons(&[rings(text)], &Options::default()).expect_err("an invalid polygon")
}

pub fn strict_error(text: &str) -> DomainError {
    Domain::from_polygons(&[rings(text)], &STRICT).expect_err("not simple")
}

/// Walks as text: `x y` of each start, then `)` convex, `(` reflex or `|` straight.
pub fn walks(domain: &Domain) -> Vec<String> {
    let show = |w: &medial::domain::Walk| {
        let edges = &domain.edges()[w.first as usize..(w.first + w.len) as usize];
        let corner = |c| match c {
            Corner::Convex => ')',
            Corner::Reflex => '(',
            Corner::Straight => '|',
        };
        let list: Vec<String> = edges
            .iter()
            .map(|e| format!("{} {}{}", e.start.x, e.start.y, corner(e.corner)))
            .collect();
        format!("{}{}", if w.hole { "hole " } else { "" }, list.join(" "))
    };
    domain.walks().iter().map(show).collect()
}

/// What was changed, as `name ring:index,index`.
pub fn repairs(domain: &Domain) -> Vec<String> {
    let show = |e: &medial::domain::Entry| {
        let indices: Vec<String> = e.indices.iter().map(u32::to_string).collect();
        format!("{} {}:{}", e.repair, e.ring, indices.join(","))
    };
    domain.report().entries().iter().map(show).collect()
}

/// Origins of all edges as `ring.index.part`.
pub fn origins(domain: &Domain) -> Vec<String> {
    let show = |k| {
        let o = domain.origin(k);
        format!("{}.{}.{}", o.ring, o.index, o.part)
    };
    (0..domain.edges().len() as u32).map(show).collect()
}

/// Names of all corners as `ring.index.part`.
pub fn corners(domain: &Domain) -> Vec<String> {
    let show = |k| {
        let o = domain.origin(k).corner;
        format!("{}.{}.{}", o.ring, o.index, o.part)
    };
    (0..domain.edges().len() as u32).map(show).collect()
}
