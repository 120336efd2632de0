//! W = J P Jᵀ of contacts: how fast each opens and slips per impulse at another, joints held.
//!
//! P is M⁻¹ without joints. With them it is M⁻¹ − M⁻¹ J_jᵀ (J_j M⁻¹ J_jᵀ)⁻¹ J_j M⁻¹, the response of bodies whose joints hold
//! ([`JointBlock::response`](crate::joint::JointBlock::response)). Two contacts are coupled only if an impulse at one reaches a body of
//! the other, so W is kept in blocks, one per coupled pair.

use tumble_lcp::Matrix as Dense;
use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::island::can_move;
use crate::joint::Joints;
use crate::{ContactRow, SolverBody};

/// W in blocks, in the contact frames [1/kg].
#[derive(Clone, Debug, Default)]
pub(crate) struct Coupling<D: Dim> {
    /// Where each contact's blocks begin; one more at the end.
    starts: Vec<u32>,
    /// The contact that feels.
    others: Vec<u32>,
    blocks: Vec<D::Matrix>,
    /// W_ii.
    own: Vec<D::Matrix>,
    /// W_ii⁻¹; zero where it is singular.
    own_inverse: Vec<D::Matrix>,
    /// Contacts at each body, as `starts` and `others`.
    body_starts: Vec<u32>,
    at_body: Vec<u32>,
    at_rest: Vec<SolverBody<D>>,
    seen: Vec<u32>,
}

impl<D: Dim> Coupling<D> {
    /// Builds W of these contacts.
    pub fn build(&mut self, bodies: &[SolverBody<D>], rows: &[ContactRow<D>], joints: &mut Option<Joints<'_, D>>) {
        self.sort_by_body(bodies, rows);
        self.at_rest.clear();
        let still =
            |body: &SolverBody<D>| SolverBody { velocity: Linear::ZERO, angular_velocity: Linear::ZERO, ..*body };
        self.at_rest.extend(bodies.iter().map(still));
        self.seen.clear();
        self.seen.resize(rows.len(), u32::MAX);
        self.starts.clear();
        self.others.clear();
        self.blocks.clear();
        self.own.clear();
        self.own_inverse.clear();
        for (source, row) in rows.iter().enumerate() {
            self.starts.push(self.others.len() as u32);
            match joints {
                Some(joints) if !joints.block.is_empty() => {
                    let reached: Vec<u32> = joints.block.reached_by([row.a, row.b]).collect();
                    self.list_reached(source as u32, &reached);
                    self.fill(rows, |_, axis, read| {
                        read(joints.block.response(joints.rows, row, D::Vector::unit(axis)))
                    });
                }
                _ => {
                    self.list_reached(source as u32, &[row.a, row.b]);
                    self.fill(rows, |at_rest, axis, read| {
                        row.apply(at_rest, D::Vector::unit(axis));
                        read(at_rest);
                        for body in [row.a, row.b] {
                            let body = &mut at_rest[body as usize];
                            (body.velocity, body.angular_velocity) = (Linear::ZERO, Linear::ZERO);
                        }
                    });
                }
            }
        }
        self.starts.push(self.others.len() as u32);
        for source in 0..rows.len() {
            let own = self.felt_by(source).find(|(other, _)| *other as usize == source);
            let own = own.map_or(D::Matrix::from_columns(|_| D::Vector::ZERO), |(_, block)| *block);
            self.own.push(own);
            self.own_inverse.push(own.try_inverse().unwrap_or(D::Matrix::from_columns(|_| D::Vector::ZERO)));
        }
    }

    /// W_ii of a contact.
    #[inline]
    pub fn own(&self, contact: usize) -> &D::Matrix {
        &self.own[contact]
    }

    /// The impulse that stops a contact moving at this velocity, if it alone acted; zero where nothing yields [N·s].
    #[inline]
    pub fn stopping(&self, contact: usize, velocity: D::Vector) -> D::Vector {
        -self.own_inverse[contact].apply(velocity)
    }

    /// The contacts that feel an impulse at this one, with their velocity per impulse; W is symmetric, so the transposed block is this
    /// one's velocity per impulse there.
    #[inline]
    pub fn felt_by(&self, contact: usize) -> impl Iterator<Item = (u32, &D::Matrix)> {
        let range = self.starts[contact] as usize..self.starts[contact + 1] as usize;
        self.others[range.clone()].iter().copied().zip(&self.blocks[range])
    }

    /// (W λ)_i [m/s].
    #[inline]
    pub fn velocity(&self, contact: usize, impulses: &[D::Vector]) -> D::Vector {
        let mut velocity = D::Vector::ZERO;
        for (other, block) in self.felt_by(contact) {
            velocity += block.apply_transposed(impulses[other as usize]);
        }
        velocity
    }

    /// W of some contacts that no others are coupled to, written out: rows contact by contact, normal first.
    pub fn dense(&self, contacts: &[u32]) -> Dense {
        let axes = D::Vector::AXES;
        let mut local = vec![u32::MAX; self.own.len()];
        for (k, contact) in contacts.iter().enumerate() {
            local[*contact as usize] = k as u32;
        }
        let mut w = Dense::zeros(axes * contacts.len(), axes * contacts.len());
        for (source, contact) in contacts.iter().enumerate() {
            for (other, block) in self.felt_by(*contact as usize) {
                let feels = local[other as usize] as usize;
                for column in 0..axes {
                    let velocity = block.column(column);
                    for row in 0..axes {
                        // Both halves of W are computed; their mean is symmetric to the last bit.
                        w[(axes * feels + row, axes * source + column)] += 0.5 * velocity[row];
                        w[(axes * source + column, axes * feels + row)] += 0.5 * velocity[row];
                    }
                }
            }
        }
        w
    }

    /// Appends the contacts at the reached bodies, each once, in rising order.
    fn list_reached(&mut self, source: u32, reached: &[u32]) {
        let first = self.others.len();
        for &body in reached {
            for at in self.body_starts[body as usize]..self.body_starts[body as usize + 1] {
                let contact = self.at_body[at as usize];
                if std::mem::replace(&mut self.seen[contact as usize], source) != source {
                    self.others.push(contact);
                }
            }
        }
        self.others[first..].sort_unstable();
    }

    /// Appends the blocks of the contacts that were listed last; `respond` shows the bodies after a unit impulse along an axis.
    fn fill(
        &mut self,
        rows: &[ContactRow<D>],
        mut respond: impl FnMut(&mut [SolverBody<D>], usize, &mut dyn FnMut(&[SolverBody<D>])),
    ) {
        let first = self.blocks.len();
        let others = &self.others[first..];
        // Columns side by side; space has one more than the plane.
        let mut columns = vec![[D::Vector::ZERO; 3]; others.len()];
        for axis in 0..D::Vector::AXES {
            respond(&mut self.at_rest, axis, &mut |moved| {
                for (columns, other) in columns.iter_mut().zip(others) {
                    columns[axis] = rows[*other as usize].relative_velocity(moved);
                }
            });
        }
        self.blocks.extend(columns.iter().map(|columns| D::Matrix::from_columns(|axis| columns[axis])));
    }

    /// Sorts contacts by their bodies that can move.
    fn sort_by_body(&mut self, bodies: &[SolverBody<D>], rows: &[ContactRow<D>]) {
        self.body_starts.clear();
        self.body_starts.resize(bodies.len() + 1, 0);
        let ends = || {
            let of_row = |(i, row): (usize, &ContactRow<D>)| [(i, row.a as usize), (i, row.b as usize)];
            rows.iter().enumerate().flat_map(of_row).filter(|(_, body)| can_move(&bodies[*body]))
        };
        ends().for_each(|(_, body)| self.body_starts[body + 1] += 1);
        for i in 0..bodies.len() {
            self.body_starts[i + 1] += self.body_starts[i];
        }
        let mut next = self.body_starts.clone();
        self.at_body.clear();
        self.at_body.resize(self.body_starts[bodies.len()] as usize, 0);
        for (i, body) in ends() {
            self.at_body[next[body] as usize] = i as u32;
            next[body] += 1;
        }
    }
}
