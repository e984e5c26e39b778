//! Grid of a sheet in space: positions at the nodes of a rectangular grid over the flat page.

use nalgebra::Vector3;

use super::camera::SheetCamera;

/// A sheet in the camera's axes (x to the right, y down, z ahead), with the camera that sees it. Lengths are in widths
/// of the page.
#[derive(Debug, Clone)]
pub(super) struct SheetGrid {
    pub cols: usize,
    pub rows: usize,
    /// Logarithm of the flat page's ratio of height to width.
    pub log_ratio: f64,
    pub camera: SheetCamera,
    /// Positions of the grid's nodes in space, row by row from the page's upper left corner.
    pub nodes: Vec<Vector3<f64>>,
}

/// Bilinear interpolation at a place on a grid: the four nodes of its cell and their weights.
#[derive(Debug, Clone, Copy)]
pub(super) struct GridPlace {
    pub nodes: [usize; 4],
    pub weights: [f64; 4],
    /// Derivatives of the weights by the place's share of the page's height.
    pub derivative_down: [f64; 4],
}

impl GridPlace {
    /// The place of one node.
    pub fn node(node: usize) -> Self {
        GridPlace {
            nodes: [node; 4],
            weights: [1.0, 0.0, 0.0, 0.0],
            derivative_down: [0.0; 4],
        }
    }
}

/// Number of the cell of a row of `nodes` nodes that a share of its length lies in, and the share of the cell before it.
#[inline]
pub(in crate::page) fn cell_at(share: f64, nodes: usize) -> (usize, f64) {
    let at = share * (nodes - 1) as f64;
    let cell = (at.max(0.0) as usize).min(nodes - 2);
    (cell, at - cell as f64)
}

/// Places of the nodes of a grid of `cols` by `rows` nodes, row by row, in shares of its width and height.
pub(in crate::page) fn node_shares([cols, rows]: [usize; 2]) -> impl Iterator<Item = [f64; 2]> {
    (0..cols * rows).map(move |i| {
        [
            (i % cols) as f64 / (cols - 1) as f64,
            (i / cols) as f64 / (rows - 1) as f64,
        ]
    })
}

impl SheetGrid {
    /// Ratio of the flat page's height to its width.
    pub fn ratio(&self) -> f64 {
        self.log_ratio.exp()
    }

    /// Distances between neighbouring nodes on the flat page, across and down, in widths of the page.
    pub fn steps(&self) -> [f64; 2] {
        [
            1.0 / (self.cols - 1) as f64,
            self.ratio() / (self.rows - 1) as f64,
        ]
    }

    /// Computes the bilinear interpolation weights of a place, given in shares of the page's width and height.
    pub fn place(&self, share: [f64; 2]) -> GridPlace {
        let ((i, s), (j, t)) = (cell_at(share[0], self.cols), cell_at(share[1], self.rows));
        let first = j * self.cols + i;
        let down = (self.rows - 1) as f64;
        GridPlace {
            nodes: [first, first + 1, first + self.cols, first + self.cols + 1],
            weights: [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t],
            derivative_down: [-(1.0 - s), -s, 1.0 - s, s].map(|d| d * down),
        }
    }

    /// Projects a place to normalised image coordinates; None if it is not in front of the camera.
    pub fn seen(&self, place: &GridPlace) -> Option<[f64; 2]> {
        (self.camera).project(self.sum(&place.nodes, &place.weights))
    }

    /// Weighted sum of the positions in space of four nodes of the sheet's grid.
    pub fn sum(&self, nodes: &[usize; 4], weights: &[f64; 4]) -> Vector3<f64> {
        (nodes.iter().zip(weights))
            .map(|(node, weight)| self.nodes[*node] * *weight)
            .sum()
    }

    /// Interpolates the sheet's position in space by a Catmull-Rom surface through the nodes, at shares of the page's
    /// width and height. Beyond the border the nodes are continued by reflection.
    pub fn smooth_at(&self, share: [f64; 2]) -> Vector3<f64> {
        let ((i, s), (j, t)) = (cell_at(share[0], self.cols), cell_at(share[1], self.rows));
        let (i, j) = (i as isize, j as isize);
        let row = |j: isize| -> Vector3<f64> {
            let node = |i: isize| self.nodes[j as usize * self.cols + i as usize];
            let taken = |i: isize| extended(i, self.cols, node);
            cubic([-1, 0, 1, 2].map(|d| taken(i + d)), s)
        };
        cubic([-1, 0, 1, 2].map(|d| extended(j + d, self.rows, row)), t)
    }

    /// Resamples the sheet to a grid of other numbers of columns and rows.
    pub fn resampled(&self, [cols, rows]: [usize; 2]) -> Self {
        let nodes = node_shares([cols, rows])
            .map(|share| self.smooth_at(share))
            .collect();
        SheetGrid {
            cols,
            rows,
            nodes,
            ..*self
        }
    }
}

/// Value at index `i` of a row of `count` values; one index beyond either end it is extrapolated linearly.
fn extended(i: isize, count: usize, value: impl Fn(isize) -> Vector3<f64>) -> Vector3<f64> {
    let last = count as isize - 1;
    if i < 0 {
        2.0 * value(0) - value(1)
    } else if i > last {
        2.0 * value(last) - value(last - 1)
    } else {
        value(i)
    }
}

/// Catmull-Rom interpolation between the middle two of four equidistant points, at the share `t` of the way.
fn cubic([a, b, c, d]: [Vector3<f64>; 4], t: f64) -> Vector3<f64> {
    let (p, q) = (c - a, 2.0 * a - 5.0 * b + 4.0 * c - d);
    b + 0.5 * t * (p + t * (q + t * (3.0 * (b - c) + d - a)))
}
