//! Eight numbers at once, or one of them: the kernels are written over [`Lanes`] and do the same to each number either way.
//!
//! Only + − × and comparisons with a choice are used, none of them fused, so that every instruction set gives the same bits.

use std::ops::{Add, Mul, Neg, Sub};
use std::sync::atomic::{AtomicU64, Ordering};

use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, f64x2, mask32x8};

use super::dim::Cell;

/// How many pairs go through a kernel together.
pub const WIDTH: usize = 8;

/// A number of each lane, as it lies in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub struct Wide(pub [f32; WIDTH]);

/// Four numbers of one body, side by side.
///
/// The threads of a team share all blocks. Pairs of one colour have no moving body in common, so each block is written by one thread at a
/// time; a barrier stands between colours. Bodies that cannot move are never changed, though several may write them at once.
#[derive(Debug, Default)]
#[repr(align(16))]
pub struct Block([AtomicU64; 2]);

impl Block {
    /// The numbers.
    #[inline(always)]
    pub fn get(&self) -> [f32; 4] {
        let [low, high] = self.halves();
        let number = |half: u64, shift: u32| f32::from_bits((half >> shift) as u32);
        [number(low, 0), number(low, 32), number(high, 0), number(high, 32)]
    }

    /// Sets them.
    #[inline(always)]
    pub fn set(&self, [a, b, c, d]: [f32; 4]) {
        let half = |low: f32, high: f32| u64::from(low.to_bits()) | u64::from(high.to_bits()) << 32;
        self.0[0].store(half(a, b), Ordering::Relaxed);
        self.0[1].store(half(c, d), Ordering::Relaxed);
    }

    #[inline(always)]
    fn halves(&self) -> [u64; 2] {
        [self.0[0].load(Ordering::Relaxed), self.0[1].load(Ordering::Relaxed)]
    }

    /// The numbers in a register.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> f32x4<S> {
        let [low, high] = self.halves();
        f64x2::simd_from(simd, [f64::from_bits(low), f64::from_bits(high)]).bitcast()
    }

    /// Sets them from a register.
    #[inline(always)]
    pub fn store<S: Simd>(&self, numbers: f32x4<S>) {
        let halves: f64x2<S> = numbers.bitcast();
        self.0[0].store(halves[0].to_bits(), Ordering::Relaxed);
        self.0[1].store(halves[1].to_bits(), Ordering::Relaxed);
    }
}

/// A number of each lane, in a register.
pub trait Number: Cell + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// a > b ? yes : no.
    fn if_greater(a: Self, b: Self, yes: Self, no: Self) -> Self;

    /// √.
    fn sqrt(self) -> Self;

    /// a / b.
    fn over(self, divisor: Self) -> Self;

    /// The larger.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::if_greater(self, other, self, other)
    }

    /// The smaller.
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Self::if_greater(self, other, other, self)
    }
}

/// Which lanes a kernel works on.
pub trait Lanes: Copy {
    /// Their numbers.
    type Number: Number;

    /// The same number in each.
    fn splat(self, value: f32) -> Self::Number;

    /// Reads.
    fn load(self, from: &Wide) -> Self::Number;

    /// Writes.
    fn store(self, number: Self::Number, to: &mut Wide);

    /// Reads the first `K` blocks of one record per lane: the k-th number of each block.
    fn gather<const R: usize, const K: usize>(
        self,
        records: &[[Block; R]],
        at: &[u32; WIDTH],
    ) -> [[Self::Number; 4]; K];

    /// Writes the first `K` blocks back.
    fn scatter<const R: usize, const K: usize>(
        self,
        numbers: [[Self::Number; 4]; K],
        records: &[[Block; R]],
        at: &[u32; WIDTH],
    );
}

/// All eight, in registers of the widest kind that the machine has.
#[derive(Clone, Copy)]
pub struct All<S>(pub S);

impl<S: Simd> Number for f32x8<S> {
    #[inline(always)]
    fn if_greater(a: Self, b: Self, yes: Self, no: Self) -> Self {
        let mask: mask32x8<S> = a.simd_gt(b);
        mask.select(yes, no)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }

    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        self / divisor
    }
}

/// Rows become columns.
#[inline(always)]
fn transposed<S: Simd>(rows: [f32x4<S>; 4]) -> [f32x4<S>; 4] {
    let [a, b, c, d] = rows;
    let (low, high) = ((a.zip_low(c), b.zip_low(d)), (a.zip_high(c), b.zip_high(d)));
    [low.0.zip_low(low.1), low.0.zip_high(low.1), high.0.zip_low(high.1), high.0.zip_high(high.1)]
}

impl<S: Simd> Lanes for All<S> {
    type Number = f32x8<S>;

    #[inline(always)]
    fn splat(self, value: f32) -> f32x8<S> {
        f32x8::splat(self.0, value)
    }

    #[inline(always)]
    fn load(self, from: &Wide) -> f32x8<S> {
        f32x8::load_array_ref(self.0, &from.0)
    }

    #[inline(always)]
    fn store(self, number: f32x8<S>, to: &mut Wide) {
        number.store_array(&mut to.0);
    }

    #[inline(always)]
    fn gather<const R: usize, const K: usize>(self, records: &[[Block; R]], at: &[u32; WIDTH]) -> [[f32x8<S>; 4]; K] {
        let zero = self.splat(0.0);
        let mut numbers = [[zero; 4]; K];
        // One look at each index, however many blocks are read there.
        let of = |lane: usize| &records[at[lane] as usize];
        let rows = [of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)];
        for k in 0..K {
            let row = |lane: usize| rows[lane][k].load(self.0);
            let [a, b, c, d] = transposed([row(0), row(1), row(2), row(3)]);
            let [e, f, g, h] = transposed([row(4), row(5), row(6), row(7)]);
            numbers[k] = [a.combine(e), b.combine(f), c.combine(g), d.combine(h)];
        }
        numbers
    }

    #[inline(always)]
    fn scatter<const R: usize, const K: usize>(
        self,
        numbers: [[f32x8<S>; 4]; K],
        records: &[[Block; R]],
        at: &[u32; WIDTH],
    ) {
        let of = |lane: usize| &records[at[lane] as usize];
        let rows = [of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)];
        for k in 0..K {
            let [x, y, z, w] = numbers[k];
            let [(a, e), (b, f), (c, g), (d, h)] = [x.split(), y.split(), z.split(), w.split()];
            let (low, high) = (transposed([a, b, c, d]), transposed([e, f, g, h]));
            for lane in 0..4 {
                rows[lane][k].store(low[lane]);
                rows[lane + 4][k].store(high[lane]);
            }
        }
    }
}

/// One lane by itself: the oracle of the others.
#[derive(Clone, Copy)]
pub struct One(pub usize);

impl Number for f32 {
    #[inline(always)]
    fn if_greater(a: Self, b: Self, yes: Self, no: Self) -> Self {
        if a > b { yes } else { no }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        self / divisor
    }
}

impl Lanes for One {
    type Number = f32;

    #[inline(always)]
    fn splat(self, value: f32) -> f32 {
        value
    }

    #[inline(always)]
    fn load(self, from: &Wide) -> f32 {
        from.0[self.0]
    }

    #[inline(always)]
    fn store(self, number: f32, to: &mut Wide) {
        to.0[self.0] = number;
    }

    #[inline(always)]
    fn gather<const R: usize, const K: usize>(self, records: &[[Block; R]], at: &[u32; WIDTH]) -> [[f32; 4]; K] {
        let record = &records[at[self.0] as usize];
        let mut numbers = [[0.0; 4]; K];
        for k in 0..K {
            numbers[k] = record[k].get();
        }
        numbers
    }

    #[inline(always)]
    fn scatter<const R: usize, const K: usize>(
        self,
        numbers: [[f32; 4]; K],
        records: &[[Block; R]],
        at: &[u32; WIDTH],
    ) {
        let record = &records[at[self.0] as usize];
        for k in 0..K {
            record[k].set(numbers[k]);
        }
    }
}
