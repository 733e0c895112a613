//! Reduces a find: `reduce TARGET FILE` prints a smaller shape that still fails, as WKT.

use std::{env, fs};

use medial::domain::{Domain, Options};
use medial::geom::Point;
use medial_fuzz::{Polygons, Shape, any_polygons, check_axis, check_domain, shape, to_wkt};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = env::args().skip(1).collect();
    let [target, file] = args.as_slice() else { return Err("reduce TARGET FILE".into()) };
    let data = fs::read(file)?;
    let domain_only = target == "domain";
    let (polygons, options) = if domain_only {
        (any_polygons(&data), Options::default())
    } else {
        let shape = shape(&data).ok_or("the input has no domain")?;
        (shape.polygons, shape.options)
    };
    let fault = |polygons: &Polygons| -> Option<String> {
        if domain_only {
            return check_domain(polygons).err();
        }
        let domain = Domain::from_polygons(polygons, &options).ok()?;
        check_axis(&Shape { polygons: polygons.clone(), options, domain }).err()
    };
    let smaller = reduce(polygons, &|p| fault(p).is_some());
    println!("{}", fault(&smaller).ok_or("the input has no fault")?);
    println!("{options:?}");
    Ok(())
}

/// Drops polygons, rings and points, then shortens coordinates, as long as anything goes.
fn reduce(mut shape: Polygons, fails: &dyn Fn(&Polygons) -> bool) -> Polygons {
    loop {
        let before = to_wkt(&shape);
        let mut attempt = |edit: &dyn Fn(&mut Polygons)| {
            let mut next = shape.clone();
            edit(&mut next);
            let good = fails(&next);
            if good {
                shape = next;
            }
            good
        };
        for i in (0..200).rev() {
            attempt(&|p| drop((i < p.len()).then(|| p.remove(i))));
            for j in (0..200).rev() {
                attempt(&|p| {
                    if let Some(polygon) = p.get_mut(i).filter(|polygon| j < polygon.len()) {
                        polygon.remove(j);
                    }
                });
            }
        }
        each_point(&mut shape, fails);
        if to_wkt(&shape) == before {
            return shape;
        }
    }
}

fn each_point(shape: &mut Polygons, fails: &dyn Fn(&Polygons) -> bool) {
    for i in 0..shape.len() {
        for j in 0..shape[i].len() {
            let mut k = 0;
            while k < shape[i][j].len() {
                let mut next = shape.clone();
                next[i][j].remove(k);
                if fails(&next) {
                    *shape = next;
                } else {
                    k += 1;
                }
            }
            for k in 0..shape[i][j].len() {
                for digits in [1e0, 1e1, 1e2, 1e3, 1e4, 1e6, 1e8, 1e10] {
                    let round = |x: f64| (x * digits).round() / digits;
                    let old = shape[i][j][k];
                    let new = Point::new(round(old.x), round(old.y));
                    let mut next = shape.clone();
                    next[i][j][k] = new;
                    if new != old && fails(&next) {
                        *shape = next;
                        break;
                    }
                }
            }
        }
    }
}
