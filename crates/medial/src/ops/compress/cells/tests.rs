use super::balls::half_widths;
use super::*;
use crate::raster::topology;

/// Pseudo-random numbers (xorshift), so that every run sees the same masks.
fn dice(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33
    }
}

/// Noise, or rectangles on top of one another.
fn random(seed: u64) -> Mask {
    let mut dice = dice(seed);
    let (columns, rows) = (dice() as u32 % 40, dice() as u32 % 40);
    let mut grid = Grid::of_image(columns, rows);
    if seed.is_multiple_of(5) {
        grid.cell = [0.5, 2.0];
    }
    if seed.is_multiple_of(2) || columns == 0 || rows == 0 {
        let fill = dice() % 101;
        return Mask::new(grid, |_, _| dice() % 100 < fill).unwrap();
    }
    let mut mask = Mask::empty(grid).unwrap();
    for _ in 0..dice() % 8 {
        let (x, y) = (dice() as u32 % columns, dice() as u32 % rows);
        let (right, below) = (x + dice() as u32 % 20, y + dice() as u32 % 20);
        (y..below.min(rows)).for_each(|row| mask.fill(row, x, right.min(columns).max(x)));
    }
    mask
}

fn options(method: MaskMethod) -> MaskOptions {
    MaskOptions { method, residual: None, ..MaskOptions::default() }
}

/// How far a part of a mask is from it, from the definition.
fn error(mask: &Mask, part: &Mask) -> f64 {
    let Grid { columns, rows, .. } = *mask.grid();
    let cells = |of: &dyn Fn(i32, i32) -> bool| -> Vec<[f64; 2]> {
        let all = (-1..=rows as i32).flat_map(|y| (-1..=columns as i32).map(move |x| (x, y)));
        let [width, height] = mask.grid().cell;
        all.filter(|&(x, y)| of(x, y))
            .map(|(x, y)| [f64::from(x) * width, f64::from(y) * height])
            .collect()
    };
    let is_in = |mask: &Mask, x: i32, y: i32| x >= 0 && y >= 0 && mask.get(x as u32, y as u32);
    let away = |from: &[[f64; 2]], to: &[[f64; 2]]| {
        let nearest = |a: &[f64; 2]| {
            to.iter().map(|b| (a[0] - b[0]).hypot(a[1] - b[1])).fold(f64::INFINITY, f64::min)
        };
        from.iter().map(nearest).fold(0.0, f64::max)
    };
    let both =
        [mask, part].map(|m| (cells(&|x, y| is_in(m, x, y)), cells(&|x, y| !is_in(m, x, y))));
    let [(a, not_a), (b, not_b)] = &both;
    [away(a, b), away(b, a), away(not_a, not_b), away(not_b, not_a)].into_iter().fold(0.0, f64::max)
}

#[test]
fn every_method_gives_any_mask_again() {
    for seed in 1..600 {
        let mask = random(seed);
        for &method in MaskMethod::ALL {
            let code = compress_mask(&mask, &options(method)).unwrap();
            assert_eq!((code.error, code.missing), (0.0, 0), "{seed} {method}");
            assert_eq!(code.mask().unwrap(), mask, "{seed} {method}");
            assert!(code.balls().is_sorted(), "{seed} {method}");
        }
    }
}

#[test]
fn what_is_rebuilt_lies_within_the_mask_as_near_as_told() {
    for seed in 1..150 {
        let mask = random(seed);
        let ways = [
            MaskOptions::default(),
            MaskOptions { radius_steps: 1, ..MaskOptions::default() },
            MaskOptions { radius_steps: 2, residual: Some(0.5), ..MaskOptions::default() },
            MaskOptions { coverage: 0.9, ..options(MaskMethod::Cover) },
            MaskOptions { coverage: 0.5, ..options(MaskMethod::Squares) },
        ];
        for options in ways {
            let code = compress_mask(&mask, &options).unwrap();
            let part = code.mask().unwrap();
            let rows = 0..mask.grid().rows;
            let added = rows.clone().flat_map(|y| part.cells(y).map(move |x| (x, y)));
            assert!(added.into_iter().all(|(x, y)| mask.get(x, y)), "{seed} {options:?}");
            assert_eq!(code.missing, mask.count() - part.count(), "{seed} {options:?}");
            assert!(
                (code.error - error(&mask, &part)).abs() < 1e-9
                    || code.error == error(&mask, &part),
                "{seed} {options:?}: {} {}",
                code.error,
                error(&mask, &part)
            );
            if options.method != MaskMethod::Chain {
                assert!(part.count() as f64 >= options.coverage * mask.count() as f64);
            }
        }
    }
}

#[test]
fn an_error_that_is_asked_for_is_kept() {
    for seed in 1..60 {
        let mask = random(seed);
        for &method in MaskMethod::ALL {
            for max_error in [0.0, 1.0, 2.5, 100.0] {
                let options = MaskOptions { max_error: Some(max_error), ..options(method) };
                let code = compress_mask(&mask, &options).unwrap();
                assert!(code.error <= max_error, "{seed} {options:?}: {}", code.error);
            }
        }
    }
}

#[test]
fn a_chain_has_the_topology_of_the_mask() {
    for seed in 1..300 {
        let mask = random(seed);
        for residual in [None, Some(2.0)] {
            let code =
                compress_mask(&mask, &MaskOptions { residual, ..MaskOptions::default() }).unwrap();
            let mut cells = Mask::empty(*mask.grid()).unwrap();
            code.balls().iter().for_each(|ball| cells.put(ball.x, ball.y, true));
            assert_eq!(topology(&cells), topology(&mask), "{seed} {residual:?}");
        }
    }
}

#[test]
fn distances_of_a_chain_are_exact() {
    let mask = Mask::new(Grid::of_image(9, 5), |_, _| true).unwrap();
    let code = compress_mask(&mask, &options(MaskMethod::Chain)).unwrap();
    for ball in code.balls() {
        let nearest = [ball.x + 1, 9 - ball.x, ball.y + 1, 5 - ball.y].into_iter().min().unwrap();
        assert_eq!(ball.size, nearest * nearest);
    }
}

#[test]
fn one_square_covers_a_square_and_two_a_bar() {
    let of = |columns, rows| {
        let mask = Mask::new(Grid::of_image(columns, rows), |_, _| true).unwrap();
        compress_mask(&mask, &options(MaskMethod::Squares)).unwrap().balls().to_vec()
    };
    assert_eq!(of(5, 5), [Ball { y: 2, x: 2, size: 3 }]);
    assert_eq!(of(6, 3).len(), 2);
}

#[test]
fn a_disk_covers_itself() {
    let mask = Mask::new(Grid::of_image(21, 21), |x, y| {
        (x as i32 - 10).pow(2) + (y as i32 - 10).pow(2) < 82
    });
    let code = compress_mask(&mask.unwrap(), &options(MaskMethod::Cover)).unwrap();
    assert_eq!(code.balls(), [Ball { y: 10, x: 10, size: 82 }]);
}

#[test]
fn half_widths_are_those_of_the_open_disk() {
    for size in 1..500 {
        for (row, half) in (0..).zip(half_widths(BallShape::Disk, size)) {
            assert!(half * half + row * row < size && (half + 1).pow(2) + row * row >= size);
        }
    }
    assert_eq!(half_widths(BallShape::Disk, 1), [0]);
    assert_eq!(half_widths(BallShape::Square, 2), [1, 1]);
}

#[test]
fn disks_beyond_the_cells_are_refused() {
    let grid = Grid::of_image(3, 3);
    let code =
        |ball| CompressedMask { grid, code: CellCode::Cover(vec![ball]), error: 0.0, missing: 0 };
    assert_eq!(code(Ball { y: 1, x: 1, size: 4 }).mask().unwrap().count(), 9);
    for ball in
        [Ball { y: 1, x: 1, size: 5 }, Ball { y: 0, x: 3, size: 1 }, Ball { y: 1, x: 1, size: 0 }]
    {
        assert_eq!(code(ball).mask(), Err(CellError::Outside { at: [ball.x, ball.y] }));
    }
    let huge = CompressedMask {
        grid: Grid::of_image(60_000, 60_000),
        ..code(Ball { y: 0, x: 0, size: 1 })
    };
    assert!(matches!(huge.mask(), Err(CellError::TooLarge { .. })));
}

#[test]
fn the_axis_of_a_chain_is_that_of_its_cells() {
    let mask =
        Mask::new(Grid::of_image(40, 12), |x, y| x > 0 && x < 39 && y > 0 && y < 11).unwrap();
    let code = compress_mask(&mask, &MaskOptions::default()).unwrap();
    let axis = code.axis().unwrap();
    assert!(!axis.complete && axis.keypoints().len() > 10);
    let most = axis.keypoints().iter().map(|k| k.radius).fold(0.0, f64::max);
    assert_eq!(most, 4.5);
}
