//! Rectangles of a lattice around its patches.

use crate::lattice::hexagonal::Lattice;

/// A rectangle of lattice rows and columns. Its first row is even, so that its odd rows are shifted by half a
/// spacing as in the whole lattice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    pub top: usize,
    pub left: usize,
    pub bottom: usize,
    pub right: usize,
}

impl Window {
    /// Creates the window that covers the whole lattice.
    pub(super) fn whole(lattice: &Lattice) -> Window {
        Window {
            top: 0,
            left: 0,
            bottom: lattice.rows() - 1,
            right: lattice.cols() - 1,
        }
    }

    /// The window that encloses no vertex of the lattice.
    const EMPTY: Window = Window {
        top: usize::MAX,
        left: usize::MAX,
        bottom: 0,
        right: 0,
    };

    pub(super) fn is_empty(&self) -> bool {
        self.top > self.bottom
    }

    pub(super) fn with(&self, other: &Window) -> Window {
        Window {
            top: self.top.min(other.top),
            left: self.left.min(other.left),
            bottom: self.bottom.max(other.bottom),
            right: self.right.max(other.right),
        }
    }

    /// Iterates over the indices, in the whole lattice, of the vertices in the window.
    pub(super) fn vertices(self, lattice: &Lattice) -> impl Iterator<Item = usize> {
        let cols = lattice.cols();
        let rows = if self.is_empty() {
            0..0
        } else {
            self.top..self.bottom + 1
        };
        rows.flat_map(move |row| (self.left..=self.right).map(move |col| row * cols + col))
    }

    /// Computes for each of `count` patches the window that encloses its vertices, enlarged by one cell on each side.
    pub(super) fn around(self, lattice: &Lattice, labels: &[u32], count: usize) -> Vec<Window> {
        let mut windows = vec![Window::EMPTY; count];
        for i in self.vertices(lattice) {
            if let Some(window) = windows.get_mut(labels[i] as usize) {
                let (row, col) = (i / lattice.cols(), i % lattice.cols());
                *window = window.with(&Window {
                    top: row.saturating_sub(1) & !1,
                    left: col.saturating_sub(1),
                    bottom: (row + 1).min(lattice.rows() - 1),
                    right: (col + 1).min(lattice.cols() - 1),
                });
            }
        }
        windows
    }
}
