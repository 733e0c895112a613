use super::*;

fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// The parabola with focus (0, d) over y = 0, from x1 to x2.
fn over_axis(d: f64, x1: f64, x2: f64) -> Curve {
    let edge = Site::edge(p(-1e3, 0.0), p(1e3, 0.0));
    let at = |x: f64| {
        let r = (x * x + d * d) / (2.0 * d);
        (p(x, r), r)
    };
    Curve::new(&Site::vertex(p(0.0, d)), &edge, at(x1), at(x2))
}

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} is not {b}");
}

#[test]
fn two_edges_govern_a_line_with_linear_radius() {
    let (bottom, left) =
        (Site::edge(p(0.0, 0.0), p(4.0, 0.0)), Site::edge(p(0.0, 2.0), p(0.0, 0.0)));
    let curve = Curve::new(&left, &bottom, (p(0.0, 0.0), 0.0), (p(1.0, 1.0), 1.0));
    assert_eq!(curve.kind(), CurveKind::Line);
    assert_eq!(curve.control(), None);
    assert_eq!(curve.point_at(0.25), p(0.25, 0.25));
    assert_eq!(curve.radius_at(0.25), 0.25);
    assert_eq!(curve.parameters_at_radius(0.5), [Some(0.5), None]);
    close(curve.length(), 2.0_f64.sqrt(), 1e-15);
    assert_eq!(curve.polyline(1e-9).len(), 2);
}

#[test]
fn a_plateau_passes_through_no_radius() {
    let (bottom, top) =
        (Site::edge(p(0.0, 0.0), p(4.0, 0.0)), Site::edge(p(4.0, 2.0), p(0.0, 2.0)));
    let curve = Curve::new(&top, &bottom, (p(1.0, 1.0), 1.0), (p(3.0, 1.0), 1.0));
    assert_eq!(curve.parameters_at_radius(1.0), [None, None]);
    assert_eq!(curve.neck(), None);
    assert_eq!(curve.length(), 2.0);
}

#[test]
fn two_corners_have_a_neck_at_their_midpoint() {
    // Corners (2, 1) and (2, 3): r = √(1 + s²), neck (2, 2) in the middle from x = 2-√3 on.
    let s = 3.0_f64.sqrt();
    let (low, high) = (Site::vertex(p(2.0, 1.0)), Site::vertex(p(2.0, 3.0)));
    let curve = Curve::new(&high, &low, (p(2.0 - s, 2.0), 2.0), (p(2.0 + s, 2.0), 2.0));
    assert_eq!(curve.kind(), CurveKind::Line);
    close(curve.neck().unwrap(), 0.5, 1e-15);
    assert_eq!(curve.radius_min(), 1.0);
    assert_eq!(curve.radius_max(), 2.0);
    close(curve.radius_at(0.5), 1.0, 1e-15);
    // r = √2 at s = ±1.
    let [first, second] = curve.parameters_at_radius(2.0_f64.sqrt());
    close(first.unwrap(), 0.5 - 0.5 / s, 1e-14);
    close(second.unwrap(), 0.5 + 0.5 / s, 1e-14);
    assert_eq!(curve.parameters_at_radius(0.5), [None, None]);
}

#[test]
fn a_height_between_two_corners_is_drawn_with_inner_points() {
    let s = 3.0_f64.sqrt();
    let (low, high) = (Site::vertex(p(2.0, 1.0)), Site::vertex(p(2.0, 3.0)));
    let curve = Curve::new(&high, &low, (p(2.0 - s, 2.0), 2.0), (p(2.0 + s, 2.0), 2.0));
    assert_eq!(curve.polyline(1e-3).len(), 2);
    let drawn = curve.polyline_in_space(1e-3);
    assert!(drawn.len() > 2);
    for pair in drawn.windows(2) {
        let middle = pair[0].0 * 0.5 + pair[1].0 * 0.5;
        let height = 0.5 * (pair[0].1 + pair[1].1);
        let true_height = (middle - p(2.0, 1.0)).norm();
        assert!((height - true_height).abs() <= 1e-3);
    }
}

#[test]
fn a_parabola_points_lie_as_far_from_focus_as_from_directrix() {
    let curve = over_axis(2.0, -1.0, 5.0);
    for k in 0..=16 {
        let u = f64::from(k) / 16.0;
        let (point, radius) = (curve.point_at(u), curve.radius_at(u));
        close(point.y, radius, 1e-14);
        close((point - p(0.0, 2.0)).norm(), radius, 1e-14);
    }
}

#[test]
fn the_control_point_is_where_the_tangents_meet() {
    // x from -2 to 4 over d = 2: P1 = (1, (-8 + 4)/4) = (1, -1).
    assert_eq!(over_axis(2.0, -2.0, 4.0).control(), Some(p(1.0, -1.0)));
}

#[test]
fn the_bezier_form_agrees_with_the_curve() {
    let curve = over_axis(0.5, 1.0, 3.0);
    let control = curve.control().unwrap();
    for k in 0..=8 {
        let u = f64::from(k) / 8.0;
        let bezier = curve.from() * ((1.0 - u) * (1.0 - u))
            + control * (2.0 * u * (1.0 - u))
            + curve.to() * (u * u);
        assert!((bezier - curve.point_at(u)).norm() < 1e-14);
    }
}

#[test]
fn the_apex_is_half_way_to_the_directrix() {
    let curve = over_axis(2.0, -1.0, 3.0);
    assert_eq!(curve.neck(), Some(0.25));
    assert_eq!(curve.radius_min(), 1.0);
    assert_eq!(curve.radius_at(0.25), 1.0);
    // (x² + 4)/4 = 1.25 at x = ±1; x = -1 is the start itself.
    assert_eq!(curve.parameters_at_radius(1.25), [Some(0.5), None]);
    let monotone = over_axis(2.0, 1.0, 3.0);
    assert_eq!(monotone.neck(), None);
    assert_eq!(monotone.radius_min(), 1.25);
}

#[test]
fn the_length_agrees_with_numerical_integration() {
    for (d, x1, x2) in [(2.0, -1.0, 3.0), (0.1, 2.0, 5.0), (30.0, -0.5, 0.25), (1.0, 4.0, -4.0)] {
        // Simpson's rule on √(1 + (x/d)²) with 2000 intervals.
        let n = 2000;
        let h = (x2 - x1) / f64::from(n);
        let speed = |k: i32| ((x1 + h * f64::from(k)) / d).hypot(1.0);
        let inner: f64 =
            (1..n).map(|k| if k % 2 == 1 { 4.0 * speed(k) } else { 2.0 * speed(k) }).sum();
        let simpson = (h / 3.0 * (speed(0) + inner + speed(n))).abs();
        close(over_axis(d, x1, x2).length(), simpson, 1e-11);
    }
}

#[test]
fn the_mean_radius_agrees_with_numerical_integration() {
    let corners = |d: f64, x1: f64, x2: f64| {
        let sites = [Site::vertex(Point::new(0.0, d)), Site::vertex(Point::new(0.0, -d))];
        let end = |x: f64| (Point::new(x, 0.0), x.hypot(d));
        Curve::new(&sites[0], &sites[1], end(x1), end(x2))
    };
    for (d, x1, x2) in [
        (2.0, -1.0, 3.0),
        (0.1, 2.0, 5.0),
        (30.0, -0.5, 0.25),
        (1.0, 4.0, -4.0),
        (1.0, 3.0, 3.0 + 1e-9),
    ] {
        for curve in [over_axis(d, x1, x2), corners(d, x1, x2)] {
            let n = 2000;
            let piece = |k: i32| {
                let at = |k: i32| f64::from(k) / f64::from(n);
                let piece = curve.piece(at(k), at(k + 1));
                let (start, middle, end) =
                    (piece.radius_from(), piece.radius_at(0.5), piece.radius_to());
                (piece.length(), piece.length() * (start + 4.0 * middle + end) / 6.0)
            };
            let (length, sum) = (0..n).map(piece).fold((0.0, 0.0), |a, p| (a.0 + p.0, a.1 + p.1));
            close(curve.radius_mean(), sum / length, 1e-6);
        }
    }
}

#[test]
fn the_length_of_a_short_path_far_from_the_apex_keeps_its_digits() {
    // Over one thousandth part the curve is straight to 1e-12: length = D·√(1 + 9).
    let span = 2.0_f64.powi(-40);
    let curve = over_axis(1.0, 3.0, 3.0 + span);
    close(curve.length(), span * 10.0_f64.sqrt(), 1e-11);
}

#[test]
fn a_polyline_stays_within_its_tolerance_and_uses_it() {
    let curve = over_axis(1.0, -3.0, 5.0);
    for tolerance in [1e-1, 1e-3, 1e-5] {
        let drawn = curve.polyline(tolerance);
        assert_eq!((drawn[0].0, drawn[drawn.len() - 1].0), (curve.from(), curve.to()));
        // ceil(8 / √(8·tolerance)) pieces.
        assert_eq!(drawn.len() - 1, (8.0 / (8.0 * tolerance).sqrt()).ceil() as usize);
        let worst = drawn
            .windows(2)
            .map(|w| {
                let x = 0.5 * (w[0].0.x + w[1].0.x);
                0.5 * (w[0].0.y + w[1].0.y) - 0.5 * (x * x + 1.0)
            })
            .fold(0.0, f64::max);
        assert!(worst <= tolerance && worst > 0.5 * tolerance, "{worst} for {tolerance}");
    }
}

#[test]
fn pieces_join_and_add_up() {
    let curve = over_axis(1.0, -3.0, 5.0);
    let (first, second) = (curve.piece(0.0, 0.3), curve.piece(0.3, 1.0));
    assert_eq!(first.to(), second.from());
    assert_eq!((first.from(), second.to()), (curve.from(), curve.to()));
    close(first.length() + second.length(), curve.length(), 1e-14);
    close(first.radius_at(0.5), curve.radius_at(0.15), 1e-14);
}

#[test]
fn the_side_and_the_direction_of_the_edge_do_not_matter_for_the_shape() {
    // The same parabola turned by half a turn: the edge runs from right to left, focus below.
    let edge = Site::edge(p(5.0, 4.0), p(-5.0, 4.0));
    let (from, to) = ((p(2.0, 2.0), 2.0), (p(-2.0, 2.0), 2.0));
    let curve = Curve::new(&edge, &Site::vertex(p(0.0, 2.0)), from, to);
    assert_eq!(curve.point_at(0.5), p(0.0, 3.0));
    assert_eq!(curve.control(), Some(p(0.0, 4.0)));
}

#[test]
fn a_focus_very_near_its_directrix_keeps_its_distance() {
    // (1e7 + 3, 1e7 + 3 + 2^-29) over the diagonal: the distance is 2^-29/√2.
    let tiny = 2.0_f64.powi(-29);
    let far = 1e7;
    let d = accurate_cross(p(0.0, 0.0), p(far, far), p(far + 3.0, far + 3.0 + tiny));
    assert_eq!(d, far * tiny);
}

#[test]
fn a_corner_on_its_own_line_gives_a_straight_line() {
    let edge = Site::edge(p(0.0, 0.0), p(4.0, 0.0));
    let curve =
        Curve::new(&Site::vertex(p(0.0, 0.0)), &edge, (p(0.0, 0.0), 0.0), (p(0.0, 1.0), 1.0));
    assert_eq!(curve.kind(), CurveKind::Line);
    assert_eq!(curve.length(), 1.0);
}

#[test]
fn a_mistyped_tolerance_does_not_fill_the_memory() {
    let curve = over_axis(1.0, -3.0, 5.0);
    for tolerance in [1e-300, 0.0, f64::NAN] {
        assert!(curve.polyline(tolerance).len() <= 65_537);
        assert!(curve.polyline_in_space(tolerance).len() <= 65_537);
    }
}

#[test]
fn distances_from_a_parabola_are_those_of_its_nearest_point() {
    // y = (x² + 1)/2 from x = -3 to 5; the point over the apex has the foot of the normal at x.
    let curve = over_axis(1.0, -3.0, 5.0);
    let on = |x: f64| p(x, 0.5 * (x * x + 1.0));
    for x in [-2.5, -1.0, -1e-9, 0.0, 0.75, 2.0, 4.9] {
        // Along the normal (-x, 1), inwards as far as the centre of curvature and outwards.
        let normal = p(-x, 1.0) * (1.0 / 1.0_f64.hypot(x));
        for far in [-7.0, -0.5, 0.5] {
            close(curve.distance(on(x) + normal * far), far.abs(), 1e-13);
        }
        assert!(curve.distance(on(x)) < 1e-14);
    }
    // From far above the apex two feet are nearest: (0, y) to (x, (x² + 1)/2) with x² = 2y - 3.
    close(curve.distance(p(0.0, 3.5)), 2.0_f64.hypot(1.0), 1e-14);
    // Beyond its ends the ends are nearest.
    close(curve.distance(on(7.0)), (on(7.0) - on(5.0)).norm(), 1e-14);
    assert_eq!(curve.distance(curve.from()), 0.0);
}

#[test]
fn distances_from_a_line_without_length_are_those_of_its_point() {
    let edge = Site::edge(p(0.0, 0.0), p(4.0, 0.0));
    let end = (p(1.0, 1.0), 1.0);
    assert_eq!(Curve::new(&edge, &edge, end, end).distance(p(4.0, 5.0)), 5.0);
}
