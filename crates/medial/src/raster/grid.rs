use crate::geom::Point;

/// Where the cells of an array lie in the plane.
///
/// ```
/// use medial::geom::Point;
/// use medial::raster::Grid;
///
/// // Rows from the top downwards, as in a map; cells half as high as wide.
/// let grid = Grid { origin: Point::new(100.0, 50.0), cell: [2.0, -1.0], columns: 30, rows: 20 };
/// assert_eq!(grid.centre(0, 0), Point::new(101.0, 49.5));
/// assert_eq!(grid.corner(30, 20), Point::new(160.0, 30.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The outer corner of cell (0, 0).
    pub origin: Point,
    /// From one column, and from one row, to the next, in units of the plane: negative where they run
    /// against the axis. Neither is 0.
    pub cell: [f64; 2],
    /// Number of columns.
    pub columns: u32,
    /// Number of rows.
    pub rows: u32,
}

impl Grid {
    /// The grid of an image without a place of its own: cells of size 1 from the upper left corner, x to the
    /// right and y upwards, so that y is the negative of rows.
    #[must_use]
    pub const fn of_image(columns: u32, rows: u32) -> Self {
        Self { origin: Point::new(0.0, 0.0), cell: [1.0, -1.0], columns, rows }
    }

    /// The corner between four cells, counted from the origin.
    #[must_use]
    pub fn corner(&self, column: u32, row: u32) -> Point {
        self.place(f64::from(column), f64::from(row))
    }

    /// The centre of a cell.
    #[must_use]
    pub fn centre(&self, column: u32, row: u32) -> Point {
        self.place(f64::from(column) + 0.5, f64::from(row) + 0.5)
    }

    /// The point so many columns and rows from the origin.
    #[must_use]
    pub fn place(&self, columns: f64, rows: f64) -> Point {
        let [width, height] = self.cell;
        Point::new(self.origin.x + columns * width, self.origin.y + rows * height)
    }

    /// How many columns and rows a point lies from the origin.
    #[must_use]
    pub fn locate(&self, point: Point) -> [f64; 2] {
        let [width, height] = self.cell;
        [(point.x - self.origin.x) / width, (point.y - self.origin.y) / height]
    }

    /// Number of cells.
    #[must_use]
    pub fn n_cells(&self) -> u64 {
        u64::from(self.columns) * u64::from(self.rows)
    }

    /// The longer side of a cell.
    #[must_use]
    pub fn cell_size(&self) -> f64 {
        self.cell[0].abs().max(self.cell[1].abs())
    }

    /// The shorter side of a cell.
    #[must_use]
    pub fn shorter_side(&self) -> f64 {
        self.cell[0].abs().min(self.cell[1].abs())
    }

    /// Whether a turn from columns to rows is one to the right in the plane.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        (self.cell[0] < 0.0) != (self.cell[1] < 0.0)
    }

    /// Whether cells are squares, up to a hundredth of a cell over all of the grid: georeferences are rounded.
    pub(crate) fn is_square(&self) -> bool {
        let [width, height] = self.cell.map(f64::abs);
        let n = f64::from(self.columns.max(self.rows));
        (width - height).abs() * n <= 0.01 * width
    }

    /// The square of the height of a cell in widths.
    pub(crate) fn aspect(&self) -> f64 {
        if self.is_square() {
            return 1.0;
        }
        let ratio = self.cell[1] / self.cell[0];
        ratio * ratio
    }
}
