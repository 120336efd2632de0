//! G = L D Lᵀ of a symmetric semidefinite matrix, within its envelope, leaving out rows that follow from earlier ones.
//!
//! Row i is stored from its first nonzero on. Elimination fills nothing to the left of it (George and Liu 1981, chapter 4), so a chain of n
//! joints costs O(n). Rows are scaled to a unit diagonal first, so that a pivot says which part of a row is new: one that is lost
//! in rounding marks a row that depends on those before it.

/// Below this part of its diagonal a pivot is rounding: thousands of units in the last place, and far less than any mass ratio makes [1].
const REDUNDANT_BELOW: f64 = 1e-12;

/// The factors, row after row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Skyline {
    /// Column of the first stored entry of each row.
    first: Vec<u32>,
    /// Where each row begins in `entries`.
    starts: Vec<usize>,
    /// Strictly lower triangle of G, then of L.
    entries: Vec<f64>,
    /// Diagonal of G, then 1 / D; 0 for a row that is left out.
    inverse_pivots: Vec<f64>,
    /// 1 / √G_ii.
    scales: Vec<f64>,
}

impl Skyline {
    /// Forgets everything.
    pub fn clear(&mut self) {
        self.first.clear();
        self.starts.clear();
        self.entries.clear();
        self.inverse_pivots.clear();
        self.scales.clear();
    }

    /// Appends a row of G with its diagonal entry, zero to the left of `first`; [`Self::set`] fills the others.
    pub fn push_row(&mut self, first: usize, diagonal: f64) {
        let row = self.first.len();
        self.first.push(first as u32);
        self.starts.push(self.entries.len());
        self.entries.resize(self.entries.len() + row - first, 0.0);
        self.scales.push(if diagonal > 0.0 { 1.0 / diagonal.sqrt() } else { 0.0 });
        self.inverse_pivots.push(if diagonal > 0.0 { 1.0 } else { 0.0 });
    }

    /// Sets the entry of the last row in an earlier column.
    pub fn set(&mut self, column: usize, value: f64) {
        let row = self.first.len() - 1;
        self.entries[self.starts[row] + column - self.first[row] as usize] =
            value * self.scales[row] * self.scales[column];
    }

    /// Factors the rows that were pushed; returns how many are left out.
    pub fn factor(&mut self) -> usize {
        let mut left_out = 0;
        for i in 0..self.first.len() {
            let first = self.first[i] as usize;
            let start = self.starts[i];
            let (earlier, own) = self.entries.split_at_mut(start);
            let own = &mut own[..i - first];
            // U = L D first, so that the sums need no division.
            for j in first..i {
                let other_first = self.first[j] as usize;
                let from = first.max(other_first);
                let other = &earlier[self.starts[j]..self.starts[j] + j - other_first];
                let products =
                    own[from - first..j - first].iter().zip(&other[from - other_first..]).map(|(u, l)| u * l);
                own[j - first] -= products.sum::<f64>();
            }
            let mut pivot = self.inverse_pivots[i];
            for (u, inverse) in own.iter_mut().zip(&self.inverse_pivots[first..i]) {
                let l = *u * inverse;
                pivot -= *u * l;
                *u = l;
            }
            self.inverse_pivots[i] = if pivot > REDUNDANT_BELOW { 1.0 / pivot } else { 0.0 };
            left_out += usize::from(self.inverse_pivots[i] == 0.0);
        }
        left_out
    }

    /// Whether a row is left out because it follows from earlier ones.
    pub fn is_left_out(&self, row: usize) -> bool {
        self.inverse_pivots[row] == 0.0
    }

    /// Replaces the right side of rows `from..from + x.len()`, which nothing couples to others, by the solution; 0 in rows left out.
    pub fn solve(&self, from: usize, x: &mut [f64]) {
        for i in 0..x.len() {
            let row = from + i;
            if self.is_left_out(row) {
                x[i] = 0.0;
                continue;
            }
            let (l, first) = self.row(row);
            let known: f64 = l.iter().zip(&x[first - from..i]).map(|(l, x)| l * x).sum();
            x[i] = x[i] * self.scales[row] - known;
        }
        for (i, value) in x.iter_mut().enumerate() {
            *value *= self.inverse_pivots[from + i];
        }
        for i in (0..x.len()).rev() {
            let row = from + i;
            if self.is_left_out(row) {
                continue;
            }
            let (l, first) = self.row(row);
            let value = x[i];
            x[first - from..i].iter_mut().zip(l).for_each(|(x, l)| *x -= l * value);
        }
        for (i, value) in x.iter_mut().enumerate() {
            *value = if self.is_left_out(from + i) { 0.0 } else { *value * self.scales[from + i] };
        }
    }

    /// The entries of L left of the diagonal, and the column of the first.
    fn row(&self, row: usize) -> (&[f64], usize) {
        let first = self.first[row] as usize;
        (&self.entries[self.starts[row]..self.starts[row] + row - first], first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(g: &[[f64; 4]; 4]) -> Skyline {
        let mut skyline = Skyline::default();
        for (i, row) in g.iter().enumerate() {
            let first = row[..i].iter().position(|entry| *entry != 0.0).unwrap_or(i);
            skyline.push_row(first, row[i]);
            (first..i).for_each(|j| skyline.set(j, row[j]));
        }
        skyline
    }

    #[test]
    fn solves_a_chain() {
        let g = [[4.0, 1.0, 0.0, 0.0], [1.0, 5.0, 2.0, 0.0], [0.0, 2.0, 6.0, 1.0], [0.0, 0.0, 1.0, 3.0]];
        let mut skyline = of(&g);
        assert_eq!(skyline.factor(), 0);
        let expected = [1.0, -2.0, 3.0, 0.5];
        let mut x: Vec<f64> = g.iter().map(|row| row.iter().zip(expected).map(|(g, x)| g * x).sum()).collect();
        skyline.solve(0, &mut x);
        // Well conditioned, four rows: a few roundings.
        assert!(x.iter().zip(expected).all(|(x, e)| (x - e).abs() < 1e-14), "{x:?}");
    }

    #[test]
    fn a_row_that_is_the_sum_of_two_others_is_left_out() {
        // Gram matrix of e₁, e₂, e₁ + e₂, e₃.
        let g = [[1.0, 0.0, 1.0, 0.0], [0.0, 1.0, 1.0, 0.0], [1.0, 1.0, 2.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        let mut skyline = of(&g);
        assert_eq!(skyline.factor(), 1);
        assert!(skyline.is_left_out(2));
        let mut x = vec![2.0, 3.0, 5.0, 7.0];
        skyline.solve(0, &mut x);
        assert_eq!(x, [2.0, 3.0, 0.0, 7.0]);
    }
}
