//! The connected components of a domain. The energy of a component does not depend on the others, so each is solved by
//! itself and none slows the others down.

use super::input::Input;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::heights::occlusions::Occlusions;
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::Lattice;
use crate::math::union_find::UnionFind;

/// One connected component of a domain: the box that its vertices are in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part {
    /// Lattice row and column of the box's first vertex; the row is even, so that odd rows of the box are the shifted
    /// ones of the lattice.
    pub corner: (usize, usize),
    rows: usize,
    cols: usize,
}

/// All connected components of a domain: vertices are connected if a stencil has both.
#[derive(Debug, Clone)]
pub(crate) struct Components {
    /// Number of the component that each vertex belongs to, or [`NO_COMPONENT`]; empty if there is only one component.
    labels: Vec<u32>,
    /// Boxes of the components, the largest component first and the others about in reading order.
    pub list: Vec<Part>,
}

/// Label of a vertex that belongs to no component.
const NO_COMPONENT: u32 = u32::MAX;

impl Components {
    /// Finds the connected components of a domain, in time linear in the number of its vertices.
    pub(crate) fn new(domain: &Domain) -> Result<Self> {
        let mut sets = UnionFind::new("components", domain.cells())?;
        let stride = domain.stride();
        for row in 1..=domain.rows() {
            let [west, east, above, above_east, below, below_east] = domain.neighbour_offsets(row);
            for run in domain.interior().row(row) {
                // All that the stencils of a run touch: a piece of its row, and of those beside it.
                for (first, last) in [(west, east), (above, above_east), (below, below_east)] {
                    let end = run.end.wrapping_add_signed(last);
                    sets.union_range(run.start, run.start.wrapping_add_signed(first)..end);
                }
            }
        }
        // A part's root becomes its number.
        let mut numbers = try_filled("components", domain.cells(), NO_COMPONENT)?;
        let mut boxes: Vec<[usize; 4]> = Vec::new();
        let mut interior: Vec<usize> = Vec::new();
        for run in domain.active().all() {
            let row = run.start / stride;
            for cell in run.start..run.end {
                let root = sets.find(cell as u32) as usize;
                if numbers[root] == NO_COMPONENT {
                    numbers[root] = boxes.len() as u32;
                    boxes.push([row, row, usize::MAX, 0]);
                    interior.push(0);
                }
                let [_, bottom, left, right] = &mut boxes[numbers[root] as usize];
                let col = cell - row * stride;
                (*bottom, *left, *right) = (row, (*left).min(col), (*right).max(col));
            }
        }
        for cell in domain.interior().cells() {
            interior[numbers[sets.find(cell as u32) as usize] as usize] += 1;
        }
        let (top, first) = domain.corner();
        let part = |number: usize| {
            let [low, high, left, right] = boxes[number];
            // Row 1 of the padded box is the domain's corner, an even row of the lattice.
            let row = (low - 1) / 2 * 2;
            Part {
                corner: (top + row, first + left - 1),
                rows: high - row,
                cols: right - left + 1,
            }
        };
        let mut order: Vec<usize> = (0..boxes.len()).collect();
        let largest = (0..boxes.len())
            .rev()
            .max_by_key(|number| interior[*number]);
        order.swap(0, largest.unwrap_or(0));
        let list: Vec<Part> = order.iter().map(|number| part(*number)).collect();
        if list.len() == 1 {
            return Ok(Components {
                labels: Vec::new(),
                list,
            });
        }
        let mut place = vec![0; order.len()];
        for (i, number) in order.iter().enumerate() {
            place[*number] = i as u32;
        }
        let mut labels = try_filled("components", domain.cells(), NO_COMPONENT)?;
        for cell in domain.active().cells() {
            labels[cell] = place[numbers[sets.find(cell as u32) as usize] as usize];
        }
        Ok(Components { labels, list })
    }

    /// Returns the number of the component that an active vertex belongs to; the vertex is given by its cell of the
    /// whole domain.
    pub(crate) fn component(&self, cell: usize) -> usize {
        self.labels.get(cell).map_or(0, |label| *label as usize)
    }

    /// Returns row and column of the vertex of the whole lattice that is vertex `(0, 0)` of a component's lattice;
    /// where there is only one component, its lattice is the whole one.
    pub(crate) fn corner(&self, number: usize) -> (usize, usize) {
        match self.list.len() {
            1 => (0, 0),
            _ => self.list[number].corner,
        }
    }

    /// Cuts the input of one of several components out of the whole input, onto a lattice of its own.
    pub(crate) fn crop(&self, input: &Input, domain: &Domain, number: usize) -> Result<Input> {
        let part = &self.list[number];
        let whole = domain.lattice();
        let (top, left) = part.corner;
        let lattice = Lattice::new(part.rows, part.cols, whole.spacing())?
            .with_origin(whole.position(top, left))?;
        let vertices =
            || (0..part.rows).flat_map(|r| (0..part.cols).map(move |c| (top + r, left + c)));
        let belongs = |(row, col): (usize, usize)| {
            let cell = domain.cell((row as isize, col as isize));
            cell.is_some_and(|cell| self.labels[cell] == number as u32)
        };
        let indices: Vec<usize> = vertices().map(|(r, c)| whole.index(r, c)).collect();
        let heights = vertices().zip(&indices).map(|(vertex, i)| {
            if belongs(vertex) {
                input.field.heights()[*i]
            } else {
                f64::NAN
            }
        });
        let mut part = Input::new(Heightfield::new(lattice, heights.collect())?);
        if !input.confidence.is_empty() {
            part.confidence = indices.iter().map(|i| input.confidence[*i]).collect();
        }
        if !input.constrained.is_empty() {
            part.constrained = indices.iter().map(|i| input.constrained[*i]).collect();
        }
        if let Some(occlusions) = &input.occlusions {
            let mask: Vec<u8> = indices.iter().map(|i| occlusions.vertices()[*i]).collect();
            part.occlusions = Some(Occlusions::from_vertices(&lattice, &mask)?);
        }
        Ok(part)
    }
}

/// Checks that the given heights hold every component in place, so that it cannot tilt or move: an affine function that
/// vanishes at all of them must vanish everywhere. Every set of interior vertices that are connected by edges of the
/// lattice is checked (a component may consist of several, with hinges between them).
///
/// # Errors
/// [`Error::Underdetermined`] for the first component that is not held.
pub(crate) fn check_held(input: &Input, domain: &Domain) -> Result<()> {
    let given = |cell: usize| input.is_given(domain.lattice_index(cell));
    if input.confidence.is_empty() || domain.active().cells().all(given) {
        return Ok(());
    }
    let interior = |cell: usize| domain.roles()[cell] == crate::Role::Interior;
    let mut seen = try_filled("components", domain.cells(), false)?;
    for start in domain.interior().cells() {
        if seen[start] {
            continue;
        }
        let mut hold = Hold::default();
        let mut stack = vec![start];
        let mut vertices = 0;
        seen[start] = true;
        while let Some(cell) = stack.pop() {
            vertices += 1;
            let ring = domain.neighbour_offsets(cell / domain.stride());
            let ring = ring.map(|offset| cell.wrapping_add_signed(offset));
            for touched in ring.into_iter().chain([cell]).filter(|cell| given(*cell)) {
                let (row, col) = domain.lattice_vertex(touched);
                hold.add([row as i64, 2 * col as i64 - (row % 2) as i64]);
            }
            for next in ring {
                if interior(next) && !seen[next] {
                    seen[next] = true;
                    stack.push(next);
                }
            }
        }
        if !hold.firm {
            let (row, col) = domain.lattice_vertex(start);
            return Err(Error::Underdetermined { row, col, vertices });
        }
    }
    Ok(())
}

/// Positions of given heights, and whether three of them are not on one line, so that these heights hold a surface in
/// place: without three such heights it could tilt.
#[derive(Default)]
struct Hold {
    points: Vec<[i64; 2]>,
    firm: bool,
}

impl Hold {
    fn add(&mut self, point: [i64; 2]) {
        match self.points[..] {
            _ if self.firm => (),
            [a, b] => {
                let cross = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
                self.firm = cross != 0;
            }
            _ if self.points.contains(&point) => (),
            _ => self.points.push(point),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Role;

    /// Two bodies in columns 0..8 and 9..20, rows 3.. only, with attributes of every kind.
    fn input() -> Input {
        let lattice = Lattice::new(12, 20, 0.5)
            .unwrap()
            .with_origin([3.0, -1.0])
            .unwrap();
        let heights = (0..lattice.len()).map(|i| match (i / 20, i % 20) {
            (0..3, _) | (_, 8) => f64::NAN,
            _ => i as f64,
        });
        let value = |i: usize| {
            if i.is_multiple_of(7) {
                1e3 + i as f64
            } else {
                f64::NAN
            }
        };
        let torn: Vec<u8> = (0..lattice.len()).map(|i| u8::from(i == 126)).collect();
        Input::new(Heightfield::new(lattice, heights.collect()).unwrap())
            .with_confidence((0..lattice.len()).map(|i| i as f64).collect())
            .and_then(|input| input.with_constraints((0..lattice.len()).map(value).collect()))
            .and_then(|input| input.with_occlusions(Occlusions::from_vertices(&lattice, &torn)?))
            .unwrap()
    }

    #[test]
    fn crops_keep_positions_and_all_that_is_known() {
        let input = input();
        let whole = *input.field.lattice();
        let domain = Domain::with_occlusions(&input.field, |v| input.is_occluded(v)).unwrap();
        let parts = Components::new(&domain).unwrap();
        assert_eq!(parts.list.len(), 2);
        let mut seen = 0;
        for number in 0..2 {
            let part = parts.crop(&input, &domain, number).unwrap();
            let lattice = *part.field.lattice();
            let (top, left) = parts.list[number].corner;
            assert_eq!(top % 2, 0);
            for i in 0..lattice.len() {
                let (row, col) = (i / lattice.cols(), i % lattice.cols());
                let from = whole.index(top + row, left + col);
                let ([x, y], [u, v]) = (
                    lattice.position(row, col),
                    whole.position(top + row, left + col),
                );
                assert!((x - u).abs() < 1e-12 && (y - v).abs() < 1e-12);
                if part.field.heights()[i].is_nan() {
                    continue;
                }
                seen += 1;
                assert_eq!(part.field.heights()[i], input.field.heights()[from]);
                assert_eq!(part.weight(i), input.weight(from));
                assert_eq!(part.is_constrained(i), input.is_constrained(from));
                assert_eq!(part.is_occluded(i), input.is_occluded(from));
            }
            // The same stencils as in the whole.
            let own = Domain::with_occlusions(&part.field, |v| part.is_occluded(v)).unwrap();
            let interior = domain.interior().cells();
            let expected = interior
                .filter(|cell| parts.component(*cell) == number)
                .count();
            assert_eq!(own.interior_len(), expected);
        }
        let active = domain.active().cells().count();
        assert_eq!(seen, active);
        let roles = (0..whole.len()).map(|i| domain.role(i / 20, i % 20));
        assert_eq!(roles.filter(|role| *role >= Role::Boundary).count(), active);
    }

    #[test]
    fn the_largest_comes_first_and_bridges_do_not_connect() {
        let lattice = Lattice::new(9, 30, 1.0).unwrap();
        // Columns 0..4, 5..15 and 16..30; the last two are joined in one row.
        let valid = |row: usize, col: usize| col != 4 && (col != 15 || row == 4);
        let heights = (0..lattice.len()).map(|i| match valid(i / 30, i % 30) {
            true => 0.0,
            false => f64::NAN,
        });
        let field = Heightfield::new(lattice, heights.collect()).unwrap();
        let domain = Domain::new(&field).unwrap();
        let parts = Components::new(&domain).unwrap();
        // A bridge without a stencil of its own joins nothing; it belongs to whom it touches.
        assert_eq!(parts.list.len(), 3);
        let corners: Vec<_> = parts.list.iter().map(|part| part.corner).collect();
        assert_eq!(corners, [(0, 15), (0, 5), (0, 0)]);
        let of = |row: isize, col: isize| parts.component(domain.cell((row, col)).unwrap());
        assert_eq!([of(4, 20), of(4, 8), of(4, 2)], [0, 1, 2]);
    }
}
