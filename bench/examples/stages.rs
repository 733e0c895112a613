use std::time::Instant;
use medial::axis::Engine;
use medial::domain::{Domain, Options};
use medial::engine::interior;
use medial::ops::*;
use medial_bench::text;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rounds: usize = std::env::args().nth(1).map_or(9, |a| a.parse().unwrap());
    let features = text::read()?;
    let polygons = &features[0];
    let edges = text::edges(polygons) as f64;
    let mut t: Vec<(&str, Vec<f64>)> = Vec::new();
    for _ in 0..rounds {
        let mut k = 0;
        let mut add = |name: &'static str, s: Instant| {
            let v = s.elapsed().as_nanos() as f64 / edges;
            if t.len() <= k { t.push((name, vec![])); }
            t[k].1.push(v); k += 1;
        };
        let domain = Domain::from_polygons(polygons, &Options::default())?;
        let s = Instant::now(); let axis = interior(&domain, Engine::PathTracing, &Default::default())?; add("engine", s);
        let bounds = axis.bounds().map_or(0.0, |(low, high)| (high - low).norm());
        let s = Instant::now(); let h = Hierarchy::new(&domain, &axis)?; add("hierarchy", s);
        let s = Instant::now(); let p = h.pruned(Measure::Excess, 1e-3 * bounds); add("pruned", s);
        let s = Instant::now(); let p2 = h.pruned(Measure::Prominence, 0.1); add("pruned prominence", s);
        let s = Instant::now(); let o2 = Outline::new(&p2.axis)?; add("its outline", s);
        let s = Instant::now(); let c = h.centerlines(&CenterlineOptions::default())?; add("centerlines", s);
        let s = Instant::now(); let b = branches(&axis); add("branches", s);
        let s = Instant::now(); let o = Outline::new(&axis)?; add("outline", s);
        let s = Instant::now(); let r = polygons_of(&axis)?; add("reconstruct", s);
        let s = Instant::now(); drop((p, p2, o2, c, b, o, r)); drop(h); add("drop", s);
    }
    let mut sum = 0.0;
    for (k, (name, v)) in t.iter_mut().enumerate() { v.sort_by(f64::total_cmp); let m = v[v.len()/2]; if k > 0 { sum += m; } println!("{name:18} {m:7.1}  min {:7.1}", v[0]); }
    println!("sum {sum:.1}");
    Ok(())
}
