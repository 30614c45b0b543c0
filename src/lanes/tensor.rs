//! Small tensors whose components are lanes.

use super::Lanes;

/// A 3 × 3 matrix, `m[row][column]`.
pub type Matrix3<V> = [[V; 3]; 3];

/// A symmetric second-order tensor.
#[derive(Debug, Clone, Copy)]
pub struct Sym3<V> {
    /// xx
    pub xx: V,
    /// yy
    pub yy: V,
    /// zz
    pub zz: V,
    /// xy
    pub xy: V,
    /// yz
    pub yz: V,
    /// zx
    pub zx: V,
}

impl<V: Lanes> Sym3<V> {
    /// From six consecutive rows xx, yy, zz, xy, yz, zx.
    #[inline(always)]
    pub fn load(rows: &[V::Row], part: usize) -> Self {
        let c: [V; 6] = array![i in 6 => V::load(&rows[i], part)];
        Sym3 { xx: c[0], yy: c[1], zz: c[2], xy: c[3], yz: c[4], zx: c[5] }
    }

    /// Components xx, yy, zz, xy, yz, zx.
    #[inline(always)]
    pub fn to_array(self) -> [V; 6] {
        [self.xx, self.yy, self.zz, self.xy, self.yz, self.zx]
    }

    /// The symmetric part of a matrix.
    #[inline(always)]
    pub fn of(m: &Matrix3<V>) -> Self {
        let half = V::splat(0.5);
        Sym3 {
            xx: m[0][0],
            yy: m[1][1],
            zz: m[2][2],
            xy: (m[0][1] + m[1][0]) * half,
            yz: (m[1][2] + m[2][1]) * half,
            zx: (m[2][0] + m[0][2]) * half,
        }
    }

    /// As a full matrix.
    #[inline(always)]
    pub fn matrix(self) -> Matrix3<V> {
        [[self.xx, self.xy, self.zx], [self.xy, self.yy, self.yz], [self.zx, self.yz, self.zz]]
    }

    /// Component by component, `f(self, other)`.
    #[inline(always)]
    pub fn zip(self, other: Self, f: impl Fn(V, V) -> V) -> Self {
        Sym3 {
            xx: f(self.xx, other.xx),
            yy: f(self.yy, other.yy),
            zz: f(self.zz, other.zz),
            xy: f(self.xy, other.xy),
            yz: f(self.yz, other.yz),
            zx: f(self.zx, other.zx),
        }
    }

    /// `value` added to the diagonal.
    #[inline(always)]
    pub fn add_diagonal(self, value: V) -> Self {
        Sym3 { xx: self.xx + value, yy: self.yy + value, zz: self.zz + value, ..self }
    }

    /// xx + yy + zz
    #[inline(always)]
    pub fn trace(self) -> V {
        self.xx + self.yy + self.zz
    }

    /// Deviatoric part.
    #[inline(always)]
    pub fn deviator(self) -> Self {
        self.add_diagonal(-(self.trace() * V::splat(1.0 / 3.0)))
    }

    /// Double contraction a : b.
    #[inline(always)]
    pub fn contract(self, b: Self) -> V {
        let shear = self.xy * b.xy + self.yz * b.yz + self.zx * b.zx;
        self.xx * b.xx + self.yy * b.yy + self.zz * b.zz + (shear + shear)
    }

    /// det(I + a) − 1, the sum of the three invariants of a: with all digits of a small a.
    #[inline(always)]
    pub fn volume_change(self) -> V {
        let Sym3 { xx, yy, zz, xy, yz, zx } = self;
        let minors = (xx * yy - xy * xy) + (yy * zz - yz * yz) + (zz * xx - zx * zx);
        let determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
        self.trace() + (minors + determinant)
    }

    /// R a Rᵀ, the tensor carried from the rotated frame into the fixed one.
    #[inline(always)]
    pub fn rotate(self, r: &Matrix3<V>) -> Self {
        let ra = multiply(r, &self.matrix());
        Sym3 {
            xx: dot(&ra[0], &r[0]),
            yy: dot(&ra[1], &r[1]),
            zz: dot(&ra[2], &r[2]),
            xy: dot(&ra[0], &r[1]),
            yz: dot(&ra[1], &r[2]),
            zx: dot(&ra[2], &r[0]),
        }
    }
}

/// Sum of three products. A function, as all that kernels call is: closures are not always inlined, and where one stays a call, even
/// on a path that is hardly ever taken, what it looks at has to be in memory on all of them.
#[inline(always)]
fn dot<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a · b
#[inline(always)]
pub fn multiply<V: Lanes>(a: &Matrix3<V>, b: &Matrix3<V>) -> Matrix3<V> {
    array![i in 3 => array![j in 3 => dot(&a[i], &[b[0][j], b[1][j], b[2][j]])]]
}

/// aᵀ · b
#[inline(always)]
pub fn multiply_transposed<V: Lanes>(a: &Matrix3<V>, b: &Matrix3<V>) -> Matrix3<V> {
    array![i in 3 => array![j in 3 => dot(&[a[0][i], a[1][i], a[2][i]], &[b[0][j], b[1][j], b[2][j]])]]
}
