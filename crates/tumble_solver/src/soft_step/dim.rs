//! Vector algebra over lanes, in the plane and in space.

use glam::{DVec2, DVec3};
use tumble_math::{Dim, Planar, Spatial, SymmetricTensor};

use super::lanes::{Block, Lanes, Number, WIDTH, Wide};

/// A dimension that soft contacts are written for.
pub trait SoftDim: LaneAlgebra {}

impl SoftDim for Planar {}
impl SoftDim for Spatial {}

/// What can be a component: a number, or several side by side.
pub trait Cell: Copy + Send + Sync {}

impl<T: Copy + Send + Sync> Cell for T {}

/// So many components, each of any kind of number.
pub trait Components {
    /// The components.
    type Of<T: Cell>: Cell;

    /// All alike.
    fn splat<T: Cell>(value: T) -> Self::Of<T>;

    /// Reads the components of lanes.
    fn load<L: Lanes>(lanes: L, from: &Self::Of<Wide>) -> Self::Of<L::Number>;

    /// Writes the components of lanes.
    fn store<L: Lanes>(lanes: L, numbers: Self::Of<L::Number>, to: &mut Self::Of<Wide>);

    /// Writes one lane.
    fn put(values: Self::Of<f32>, lane: usize, to: &mut Self::Of<Wide>);

    /// Reads one lane.
    fn take(from: &Self::Of<Wide>, lane: usize) -> Self::Of<f32>;

    /// a + b.
    fn plus<N: Number>(a: Self::Of<N>, b: Self::Of<N>) -> Self::Of<N>;

    /// a − b.
    fn minus<N: Number>(a: Self::Of<N>, b: Self::Of<N>) -> Self::Of<N>;

    /// a s.
    fn times<N: Number>(a: Self::Of<N>, s: N) -> Self::Of<N>;

    /// a_i b_i.
    fn each<N: Number>(a: Self::Of<N>, b: Self::Of<N>) -> Self::Of<N>;

    /// Σ a_i b_i, of one component at least.
    fn dot<N: Number>(a: Self::Of<N>, b: Self::Of<N>) -> N;

    /// Each component brought into −bound … bound.
    fn within<N: Number>(a: Self::Of<N>, bound: Self::Of<N>) -> Self::Of<N>;

    /// 1 over each component; 0 where that is not positive.
    fn inverse<L: Lanes>(lanes: L, a: Self::Of<L::Number>) -> Self::Of<L::Number>;
}

/// 1 over a number; 0 where that is not positive.
#[inline(always)]
pub fn inverse<L: Lanes>(lanes: L, number: L::Number) -> L::Number {
    let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
    let safe = Number::if_greater(number, zero, number, one);
    Number::if_greater(number, zero, one.over(safe), zero)
}

/// `K` components.
#[derive(Clone, Copy, Debug)]
pub struct Count<const K: usize>;

// Loops rather than closures: what is not inlined into a kernel would not use its instructions.
impl<const K: usize> Components for Count<K> {
    type Of<T: Cell> = [T; K];

    #[inline(always)]
    fn splat<T: Cell>(value: T) -> [T; K] {
        [value; K]
    }

    #[inline(always)]
    fn load<L: Lanes>(lanes: L, from: &[Wide; K]) -> [L::Number; K] {
        let mut numbers = [lanes.splat(0.0); K];
        for k in 0..K {
            numbers[k] = lanes.load(&from[k]);
        }
        numbers
    }

    #[inline(always)]
    fn store<L: Lanes>(lanes: L, numbers: [L::Number; K], to: &mut [Wide; K]) {
        for k in 0..K {
            lanes.store(numbers[k], &mut to[k]);
        }
    }

    #[inline(always)]
    fn put(values: [f32; K], lane: usize, to: &mut [Wide; K]) {
        for k in 0..K {
            to[k].0[lane] = values[k];
        }
    }

    #[inline(always)]
    fn take(from: &[Wide; K], lane: usize) -> [f32; K] {
        let mut values = [0.0; K];
        for k in 0..K {
            values[k] = from[k].0[lane];
        }
        values
    }

    #[inline(always)]
    fn plus<N: Number>(mut a: [N; K], b: [N; K]) -> [N; K] {
        for k in 0..K {
            a[k] = a[k] + b[k];
        }
        a
    }

    #[inline(always)]
    fn minus<N: Number>(mut a: [N; K], b: [N; K]) -> [N; K] {
        for k in 0..K {
            a[k] = a[k] - b[k];
        }
        a
    }

    #[inline(always)]
    fn times<N: Number>(mut a: [N; K], s: N) -> [N; K] {
        for number in &mut a {
            *number = *number * s;
        }
        a
    }

    #[inline(always)]
    fn each<N: Number>(mut a: [N; K], b: [N; K]) -> [N; K] {
        for k in 0..K {
            a[k] = a[k] * b[k];
        }
        a
    }

    #[inline(always)]
    fn dot<N: Number>(a: [N; K], b: [N; K]) -> N {
        let mut sum = a[0] * b[0];
        for k in 1..K {
            sum = sum + a[k] * b[k];
        }
        sum
    }

    #[inline(always)]
    fn within<N: Number>(mut a: [N; K], bound: [N; K]) -> [N; K] {
        for k in 0..K {
            a[k] = a[k].larger(-bound[k]).smaller(bound[k]);
        }
        a
    }

    #[inline(always)]
    fn inverse<L: Lanes>(lanes: L, mut a: [L::Number; K]) -> [L::Number; K] {
        for number in &mut a {
            *number = inverse(lanes, *number);
        }
        a
    }
}

/// Components along the axes.
pub type Axes<D, T> = <<D as LaneAlgebra>::Axes as Components>::Of<T>;
/// Components of a rate of turn.
pub type Turns<D, T> = <<D as LaneAlgebra>::Turns as Components>::Of<T>;
/// Entries of a symmetric tensor over rates of turn: the diagonal, then (2,3), (1,3), (1,2).
pub type Tensor<D, T> = <<D as LaneAlgebra>::Tensor as Components>::Of<T>;
/// Components along the tangents.
pub type Tangents<D, T> = <<D as LaneAlgebra>::Tangents as Components>::Of<T>;
/// Components of a turn about the normal: one in space, none in the plane.
pub type Twist<D, T> = <<D as LaneAlgebra>::Twist as Components>::Of<T>;
/// What is stored of a contact frame besides the normal: in space the first tangent.
pub type Frame<D, T> = <<D as LaneAlgebra>::Frame as Components>::Of<T>;

/// Inverse mass per axis and inverse inertia of a body.
pub type Masses<D, T> = (Axes<D, T>, Tensor<D, T>);

/// Velocity and rate of turn, or displacement and turn.
pub type Motions<D, T> = (Axes<D, T>, Turns<D, T>);

/// The vectors of a dimension, over lanes.
pub trait LaneAlgebra: Dim {
    /// Blocks of four numbers that hold a velocity and a rate of turn. A record of a body has twice as many: displacement and turn as well.
    const BLOCKS: usize;
    /// Blocks that hold inverse mass and inverse inertia.
    const MASS_BLOCKS: usize;
    /// See [`Axes`].
    type Axes: Components;
    /// See [`Turns`].
    type Turns: Components;
    /// See [`Tensor`].
    type Tensor: Components;
    /// See [`Tangents`].
    type Tangents: Components;
    /// See [`Twist`].
    type Twist: Components;
    /// See [`Frame`].
    type Frame: Components;

    /// A vector, rounded.
    fn axes(vector: Self::Vector) -> Axes<Self, f32>;
    /// A vector, widened.
    fn vector(axes: Axes<Self, f32>) -> Self::Vector;
    /// A rate of turn, rounded.
    fn turns(angular: Self::Angular) -> Turns<Self, f32>;
    /// A rate of turn, widened.
    fn angular(turns: Turns<Self, f32>) -> Self::Angular;
    /// An inverse inertia, rounded.
    fn tensor(inertia: Self::Inertia) -> Tensor<Self, f32>;
    /// The contact frame of a normal, without it, rounded.
    fn frame(normal: Self::Vector) -> Frame<Self, f32>;
    /// The tangential part of a vector of the contact frame, rounded.
    fn tangents(in_frame: Self::Vector) -> Tangents<Self, f32>;
    /// A vector of the contact frame, widened.
    fn in_frame(normal: f32, tangents: Tangents<Self, f32>) -> Self::Vector;
    /// A twist as a number; 0 where there is none.
    fn twist(twist: Twist<Self, f32>) -> f32;
    /// Impulse at a point, `arm` from where the points of its pair have their mean, when all of them share a `twist` about the normal:
    /// without their common factor, one over the sum of their arms squared.
    fn twisted(normal: Self::Vector, twist: Twist<Self, f32>, arm: Self::Vector) -> Self::Vector;

    /// Velocity and rate of turn out of the records of bodies.
    fn unpack<L: Lanes>(lanes: L, records: &[Block], at: &[u32; WIDTH]) -> Motions<Self, L::Number>;
    /// The same, and displacement and turn, which follow in each record.
    fn unpack_both<L: Lanes>(lanes: L, records: &[Block], at: &[u32; WIDTH]) -> [Motions<Self, L::Number>; 2];
    /// Velocity and rate of turn back.
    fn pack<L: Lanes>(lanes: L, motions: Motions<Self, L::Number>, records: &[Block], at: &[u32; WIDTH]);
    /// Change of velocity and rate of turn into the blocks of a body.
    fn put_gain(change: (Self::Vector, Self::Angular), blocks: &[Block], body: usize);
    /// Inverse mass and inverse inertia into the blocks of a body.
    fn pack_masses(mass: Self::Vector, inertia: Self::Inertia, blocks: &mut [Block], body: usize);
    /// The same for the body of each lane.
    fn unpack_masses<L: Lanes>(lanes: L, blocks: &[Block], at: &[u32; WIDTH]) -> Masses<Self, L::Number>;

    /// r × f.
    fn lever<N: Number>(arm: Axes<Self, N>, force: Axes<Self, N>) -> Turns<Self, N>;
    /// ω × r.
    fn swing<N: Number>(turn: Turns<Self, N>, arm: Axes<Self, N>) -> Axes<Self, N>;
    /// I⁻¹ L.
    fn yields<N: Number>(tensor: Tensor<Self, N>, momentum: Turns<Self, N>) -> Turns<Self, N>;
    /// Components of a vector along the tangents.
    fn along_tangents<N: Number>(
        normal: Axes<Self, N>,
        frame: Frame<Self, N>,
        vector: Axes<Self, N>,
    ) -> Tangents<Self, N>;
    /// The vector with these components along the tangents.
    fn of_tangents<N: Number>(
        normal: Axes<Self, N>,
        frame: Frame<Self, N>,
        tangents: Tangents<Self, N>,
    ) -> Axes<Self, N>;
    /// Rate of turn about the normal.
    fn about_normal<N: Number>(normal: Axes<Self, N>, turn: Turns<Self, N>) -> Twist<Self, N>;
    /// The turn about the normal with this component.
    fn of_twist<L: Lanes>(
        lanes: L,
        normal: Axes<Self, L::Number>,
        twist: Twist<Self, L::Number>,
    ) -> Turns<Self, L::Number>;
    /// The largest compliance of a point along the tangents, arms from the two centres of mass [1/kg]: one for all directions, so that friction
    /// opposes slip exactly.
    fn tangent_compliance<L: Lanes>(
        normal: Axes<Self, L::Number>,
        frame: Frame<Self, L::Number>,
        bodies: [(Axes<Self, L::Number>, Masses<Self, L::Number>); 2],
        lanes: L,
    ) -> L::Number;
    /// The nearest tangential impulse no longer than `bound`, and how long it was squared, less the bound squared.
    fn within_bound<L: Lanes>(
        lanes: L,
        tangents: Tangents<Self, L::Number>,
        bound: L::Number,
    ) -> (Tangents<Self, L::Number>, L::Number);
}

impl LaneAlgebra for Planar {
    const BLOCKS: usize = 1;
    const MASS_BLOCKS: usize = 1;
    type Axes = Count<2>;
    type Turns = Count<1>;
    type Tensor = Count<1>;
    type Tangents = Count<1>;
    type Twist = Count<0>;
    type Frame = Count<0>;

    fn axes(vector: DVec2) -> [f32; 2] {
        [vector.x as f32, vector.y as f32]
    }

    fn vector([x, y]: [f32; 2]) -> DVec2 {
        DVec2::new(f64::from(x), f64::from(y))
    }

    fn turns(angular: f64) -> [f32; 1] {
        [angular as f32]
    }

    fn angular([w]: [f32; 1]) -> f64 {
        f64::from(w)
    }

    fn tensor(inertia: f64) -> [f32; 1] {
        [inertia as f32]
    }

    fn frame(_: DVec2) -> [f32; 0] {
        []
    }

    fn tangents(in_frame: DVec2) -> [f32; 1] {
        [in_frame.y as f32]
    }

    fn in_frame(normal: f32, [tangent]: [f32; 1]) -> DVec2 {
        DVec2::new(f64::from(normal), f64::from(tangent))
    }

    fn twist(_: [f32; 0]) -> f32 {
        0.0
    }

    fn twisted(_: DVec2, _: [f32; 0], _: DVec2) -> DVec2 {
        DVec2::ZERO
    }

    #[inline(always)]
    fn unpack<L: Lanes>(lanes: L, records: &[Block], at: &[u32; WIDTH]) -> ([L::Number; 2], [L::Number; 1]) {
        let [[x, y, w, _]] = lanes.gather(records.as_chunks::<2>().0, at);
        ([x, y], [w])
    }

    #[inline(always)]
    fn unpack_both<L: Lanes>(lanes: L, records: &[Block], at: &[u32; WIDTH]) -> [([L::Number; 2], [L::Number; 1]); 2] {
        lanes.gather::<2, 2>(records.as_chunks().0, at).map(
            #[inline(always)]
            |[x, y, w, _]| ([x, y], [w]),
        )
    }

    #[inline(always)]
    fn pack<L: Lanes>(lanes: L, ([x, y], [w]): ([L::Number; 2], [L::Number; 1]), records: &[Block], at: &[u32; WIDTH]) {
        lanes.scatter([[x, y, w, lanes.splat(0.0)]], records.as_chunks::<2>().0, at);
    }

    fn put_gain((linear, angular): (DVec2, f64), blocks: &[Block], body: usize) {
        blocks[body].set([linear.x as f32, linear.y as f32, angular as f32, 0.0]);
    }

    fn pack_masses(mass: DVec2, inertia: f64, blocks: &mut [Block], body: usize) {
        blocks[body].set([mass.x as f32, mass.y as f32, inertia as f32, 0.0]);
    }

    #[inline(always)]
    fn unpack_masses<L: Lanes>(lanes: L, blocks: &[Block], at: &[u32; WIDTH]) -> ([L::Number; 2], [L::Number; 1]) {
        let [[x, y, inertia, _]] = lanes.gather(blocks.as_chunks::<1>().0, at);
        ([x, y], [inertia])
    }

    #[inline(always)]
    fn lever<N: Number>(arm: [N; 2], force: [N; 2]) -> [N; 1] {
        [arm[0] * force[1] - arm[1] * force[0]]
    }

    #[inline(always)]
    fn swing<N: Number>(turn: [N; 1], arm: [N; 2]) -> [N; 2] {
        [-(turn[0] * arm[1]), turn[0] * arm[0]]
    }

    #[inline(always)]
    fn yields<N: Number>(tensor: [N; 1], momentum: [N; 1]) -> [N; 1] {
        [tensor[0] * momentum[0]]
    }

    #[inline(always)]
    fn along_tangents<N: Number>(normal: [N; 2], _: [N; 0], vector: [N; 2]) -> [N; 1] {
        [normal[1] * vector[0] - normal[0] * vector[1]]
    }

    #[inline(always)]
    fn of_tangents<N: Number>(normal: [N; 2], _: [N; 0], tangents: [N; 1]) -> [N; 2] {
        [normal[1] * tangents[0], -(normal[0] * tangents[0])]
    }

    #[inline(always)]
    fn about_normal<N: Number>(_: [N; 2], _: [N; 1]) -> [N; 0] {
        []
    }

    #[inline(always)]
    fn of_twist<L: Lanes>(lanes: L, _: [L::Number; 2], _: [L::Number; 0]) -> [L::Number; 1] {
        [lanes.splat(0.0)]
    }

    #[inline(always)]
    fn tangent_compliance<L: Lanes>(
        normal: [L::Number; 2],
        _: [L::Number; 0],
        [a, b]: [([L::Number; 2], ([L::Number; 2], [L::Number; 1])); 2],
        _: L,
    ) -> L::Number {
        let tangent = [normal[1], -normal[0]];
        compliance::<Self, _>(a, tangent, tangent) + compliance::<Self, _>(b, tangent, tangent)
    }

    #[inline(always)]
    fn within_bound<L: Lanes>(_: L, tangents: [L::Number; 1], bound: L::Number) -> ([L::Number; 1], L::Number) {
        let beyond = tangents[0] * tangents[0] - bound * bound;
        ([tangents[0].larger(-bound).smaller(bound)], beyond)
    }
}

impl LaneAlgebra for Spatial {
    const BLOCKS: usize = 2;
    const MASS_BLOCKS: usize = 3;
    type Axes = Count<3>;
    type Turns = Count<3>;
    type Tensor = Count<6>;
    type Tangents = Count<2>;
    type Twist = Count<1>;
    type Frame = Count<3>;

    fn axes(vector: DVec3) -> [f32; 3] {
        vector.as_vec3().to_array()
    }

    fn vector(axes: [f32; 3]) -> DVec3 {
        DVec3::from_array(axes.map(f64::from))
    }

    fn turns(angular: DVec3) -> [f32; 3] {
        angular.as_vec3().to_array()
    }

    fn angular(turns: [f32; 3]) -> DVec3 {
        Self::vector(turns)
    }

    fn tensor(inertia: SymmetricTensor) -> [f32; 6] {
        let (d, o) = (inertia.diagonal.as_vec3(), inertia.off_diagonal.as_vec3());
        [d.x, d.y, d.z, o.x, o.y, o.z]
    }

    fn frame(normal: DVec3) -> [f32; 3] {
        Self::contact_frame(normal).y_axis.as_vec3().to_array()
    }

    fn tangents(in_frame: DVec3) -> [f32; 2] {
        [in_frame.y as f32, in_frame.z as f32]
    }

    fn in_frame(normal: f32, [first, second]: [f32; 2]) -> DVec3 {
        DVec3::new(f64::from(normal), f64::from(first), f64::from(second))
    }

    fn twist([twist]: [f32; 1]) -> f32 {
        twist
    }

    fn twisted(normal: DVec3, [twist]: [f32; 1], arm: DVec3) -> DVec3 {
        normal.cross(arm) * f64::from(twist)
    }

    #[inline(always)]
    fn unpack<L: Lanes>(lanes: L, records: &[Block], at: &[u32; WIDTH]) -> ([L::Number; 3], [L::Number; 3]) {
        let [[x, y, z, _], [a, b, c, _]] = lanes.gather(records.as_chunks::<4>().0, at);
        ([x, y, z], [a, b, c])
    }

    #[inline(always)]
    fn unpack_both<L: Lanes>(lanes: L, records: &[Block], at: &[u32; WIDTH]) -> [([L::Number; 3], [L::Number; 3]); 2] {
        let [[x, y, z, _], [a, b, c, _], [dx, dy, dz, _], [da, db, dc, _]] =
            lanes.gather(records.as_chunks::<4>().0, at);
        [([x, y, z], [a, b, c]), ([dx, dy, dz], [da, db, dc])]
    }

    #[inline(always)]
    fn pack<L: Lanes>(
        lanes: L,
        ([x, y, z], [a, b, c]): ([L::Number; 3], [L::Number; 3]),
        records: &[Block],
        at: &[u32; WIDTH],
    ) {
        let zero = lanes.splat(0.0);
        lanes.scatter([[x, y, z, zero], [a, b, c, zero]], records.as_chunks::<4>().0, at);
    }

    fn put_gain((linear, angular): (DVec3, DVec3), blocks: &[Block], body: usize) {
        for (block, vector) in blocks[2 * body..].iter().zip([linear, angular]) {
            block.set([vector.x as f32, vector.y as f32, vector.z as f32, 0.0]);
        }
    }

    fn pack_masses(mass: DVec3, inertia: SymmetricTensor, blocks: &mut [Block], body: usize) {
        for (block, vector) in blocks[3 * body..].iter().zip([mass, inertia.diagonal, inertia.off_diagonal]) {
            block.set([vector.x as f32, vector.y as f32, vector.z as f32, 0.0]);
        }
    }

    #[inline(always)]
    fn unpack_masses<L: Lanes>(lanes: L, blocks: &[Block], at: &[u32; WIDTH]) -> ([L::Number; 3], [L::Number; 6]) {
        let [[x, y, z, _], [xx, yy, zz, _], [yz, xz, xy, _]] = lanes.gather(blocks.as_chunks::<3>().0, at);
        ([x, y, z], [xx, yy, zz, yz, xz, xy])
    }

    #[inline(always)]
    fn lever<N: Number>(arm: [N; 3], force: [N; 3]) -> [N; 3] {
        cross(arm, force)
    }

    #[inline(always)]
    fn swing<N: Number>(turn: [N; 3], arm: [N; 3]) -> [N; 3] {
        cross(turn, arm)
    }

    #[inline(always)]
    fn yields<N: Number>([xx, yy, zz, yz, xz, xy]: [N; 6], [x, y, z]: [N; 3]) -> [N; 3] {
        [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
    }

    #[inline(always)]
    fn along_tangents<N: Number>(normal: [N; 3], frame: [N; 3], vector: [N; 3]) -> [N; 2] {
        [Count::dot(frame, vector), Count::dot(cross(normal, frame), vector)]
    }

    #[inline(always)]
    fn of_tangents<N: Number>(normal: [N; 3], frame: [N; 3], tangents: [N; 2]) -> [N; 3] {
        let second = Count::times(cross(normal, frame), tangents[1]);
        Count::plus(Count::times(frame, tangents[0]), second)
    }

    #[inline(always)]
    fn about_normal<N: Number>(normal: [N; 3], turn: [N; 3]) -> [N; 1] {
        [Count::dot(normal, turn)]
    }

    #[inline(always)]
    fn of_twist<L: Lanes>(_: L, normal: [L::Number; 3], twist: [L::Number; 1]) -> [L::Number; 3] {
        Count::times(normal, twist[0])
    }

    #[inline(always)]
    fn tangent_compliance<L: Lanes>(
        normal: [L::Number; 3],
        frame: [L::Number; 3],
        [a, b]: [([L::Number; 3], ([L::Number; 3], [L::Number; 6])); 2],
        lanes: L,
    ) -> L::Number {
        let second = cross(normal, frame);
        let both =
            |i: [L::Number; 3], j: [L::Number; 3]| compliance::<Self, _>(a, i, j) + compliance::<Self, _>(b, i, j);
        let (one, other, skew) = (both(frame, frame), both(second, second), both(frame, second));
        // The larger eigenvalue of two by two.
        let (zero, half) = (lanes.splat(0.0), lanes.splat(0.5));
        let apart = half * (one - other);
        let squared = apart * apart + skew * skew;
        half * (one + other) + Number::if_greater(squared, zero, squared, zero).sqrt()
    }

    #[inline(always)]
    fn within_bound<L: Lanes>(lanes: L, tangents: [L::Number; 2], bound: L::Number) -> ([L::Number; 2], L::Number) {
        let squared = Count::dot(tangents, tangents);
        let beyond = squared - bound * bound;
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        let length = Number::if_greater(squared, zero, squared, one).sqrt();
        let shorter = Number::if_greater(beyond, zero, bound.over(length), one);
        (Count::times(tangents, shorter), beyond)
    }
}

#[inline(always)]
fn cross<N: Number>(a: [N; 3], b: [N; 3]) -> [N; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Velocity along i per impulse along j, of a body's point `arm` from its centre of mass.
#[inline(always)]
fn compliance<D: LaneAlgebra, N: Number>(
    (arm, (mass, inertia)): (Axes<D, N>, Masses<D, N>),
    i: Axes<D, N>,
    j: Axes<D, N>,
) -> N {
    let turned = D::yields(inertia, D::lever(arm, j));
    D::Axes::dot(i, D::Axes::each(j, mass)) + D::Turns::dot(D::lever(arm, i), turned)
}
