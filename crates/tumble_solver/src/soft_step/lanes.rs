//! Eight numbers at once, or one of them: the kernels are written over [`Lanes`] and do the same to each number either way.
//!
//! Only + − × and comparisons with a choice are used, none of them fused, so that every instruction set gives the same bits.

use std::ops::{Add, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, mask32x8};

use super::dim::Cell;

/// How many pairs go through a kernel together.
pub const WIDTH: usize = 8;

/// A number of each lane, as it lies in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub struct Wide(pub [f32; WIDTH]);

/// Four numbers of one body: one aligned load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(16))]
pub struct Block(pub [f32; 4]);

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

    /// Reads the blocks of one body per lane: the k-th number of each block.
    fn gather(self, blocks: &[Block], at: &[u32; WIDTH], stride: usize, offset: usize) -> [Self::Number; 4];

    /// Writes them back.
    fn scatter(self, numbers: [Self::Number; 4], blocks: &mut [Block], at: &[u32; WIDTH], stride: usize, offset: usize);
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
    fn gather(self, blocks: &[Block], at: &[u32; WIDTH], stride: usize, offset: usize) -> [f32x8<S>; 4] {
        let row = |lane: usize| f32x4::load_array_ref(self.0, &blocks[at[lane] as usize * stride + offset].0);
        let [a, b, c, d] = transposed([row(0), row(1), row(2), row(3)]);
        let [e, f, g, h] = transposed([row(4), row(5), row(6), row(7)]);
        [a.combine(e), b.combine(f), c.combine(g), d.combine(h)]
    }

    #[inline(always)]
    fn scatter(self, numbers: [f32x8<S>; 4], blocks: &mut [Block], at: &[u32; WIDTH], stride: usize, offset: usize) {
        let [(a, e), (b, f), (c, g), (d, h)] =
            [numbers[0].split(), numbers[1].split(), numbers[2].split(), numbers[3].split()];
        let (low, high) = (transposed([a, b, c, d]), transposed([e, f, g, h]));
        for lane in 0..4 {
            low[lane].store_array(&mut blocks[at[lane] as usize * stride + offset].0);
            high[lane].store_array(&mut blocks[at[lane + 4] as usize * stride + offset].0);
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
    fn gather(self, blocks: &[Block], at: &[u32; WIDTH], stride: usize, offset: usize) -> [f32; 4] {
        blocks[at[self.0] as usize * stride + offset].0
    }

    #[inline(always)]
    fn scatter(self, numbers: [f32; 4], blocks: &mut [Block], at: &[u32; WIDTH], stride: usize, offset: usize) {
        blocks[at[self.0] as usize * stride + offset].0 = numbers;
    }
}
