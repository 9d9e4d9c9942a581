//! Waves in a biaxial crystal, or any with a real symmetric dielectric tensor.
//!
//! With K = q + ξ N the condition det(K Kᵀ − K² + ε) = 0 is a quartic in ξ. Its roots are where the search for a wave begins: a
//! wave that travels is found by its own condition, K² λ(K/|K|) = 1 with λ an eigenvalue of ε⁻¹ across K, whose root is a simple
//! one even where both waves have nearly the same index; and its field is an eigenvector, across that of the other.
//! Source: Born & Wolf, *Principles of Optics*, §15.2. Checked below and in `tests/library/crystal.rs`.

use super::field::{C, Field};
use super::quartic;
use super::wave::{Side, Wave};
use glam::{DMat3, DVec3};

/// A crystal with three principal refractive indices, at one wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Biaxial {
    /// The dielectric tensor.
    epsilon: DMat3,
    /// The middle principal value of its inverse, and what the others make of it: small where the crystal is nearly isotropic,
    /// and then its axes are as exact as ever.
    inverse_middle: f64,
    inverse_rest: DMat3,
    /// tr(A) − A with A the adjugate of ε.
    middle: DMat3,
    determinant: f64,
}

/// Steps of Newton's method at most.
const STEPS: usize = 12;

/// A step of ξ below which it is found: what follows it is as small as its square.
const FOUND: f64 = 1e-9;

/// Imaginary parts of a double real root that rounding makes.
const NEARLY_REAL: f64 = 1e-6;

/// How far a root may be from the wave that it stands for.
const FAR_FROM_ROOT: f64 = 1e-3;

/// Two roots of one mode nearer than this are one.
const ONE_ROOT: f64 = 1e-12;

impl Biaxial {
    /// A crystal by its principal indices and their axes.
    ///
    /// - `axes`: unit, across each other; columns in the order of the indices
    pub fn new(indices: [f64; 3], axes: DMat3) -> Biaxial {
        let squares = DVec3::from(indices.map(|n| n * n));
        let turned = |diagonal: DVec3| axes * DMat3::from_diagonal(diagonal) * axes.transpose();
        let determinant = squares.x * squares.y * squares.z;
        let adjugate = determinant / squares;
        Biaxial {
            epsilon: turned(squares),
            inverse_middle: squares.y.recip(),
            inverse_rest: turned(
                DVec3::from(indices.map(|n| (indices[1] - n) * (indices[1] + n))) / (squares * squares.y),
            ),
            middle: turned(DVec3::splat(adjugate.element_sum()) - adjugate),
            determinant,
        }
    }

    /// The waves that go to one side of a facet: first the one with the smaller index, the fast one.
    ///
    /// - `along`: the part of their wave vectors along the facet, in units of ω/c
    /// - `normal`: unit, out of the crystal
    pub fn waves(&self, along: DVec3, normal: DVec3, side: Side) -> [Wave; 2] {
        if let Some(waves) = self.travelling(along, normal, side) {
            return waves;
        }
        self.by_quartic(along, normal, side)
    }

    /// The indices of waves along a unit vector, the smaller first.
    pub fn index_along(&self, direction: DVec3) -> [f64; 2] {
        let [large, small] = self.across(direction).values;
        [large.sqrt().recip(), small.sqrt().recip()]
    }

    /// Both waves where both travel; none near grazing, where Newton's method may go astray.
    fn travelling(&self, along: DVec3, normal: DVec3, side: Side) -> Option<[Wave; 2]> {
        let mean2 = (self.epsilon.x_axis.x + self.epsilon.y_axis.y + self.epsilon.z_axis.z) / 3.0;
        let begin = mean2 - along.length_squared();
        if begin < 0.05 * mean2 {
            return None;
        }
        let begin = side.sign() * begin.sqrt();
        let wave = |mode| {
            let found = self.newton(along, normal, mode, begin, 0.5 * begin.abs());
            found.filter(|found| found.goes(normal, side))
        };
        Some([wave(0)?.scaled(normal), wave(1)?.scaled(normal)])
    }

    /// The wave of one mode, 0 fast and 1 slow, from a guess of ξ; none where a step is longer than `most`.
    fn newton(&self, along: DVec3, normal: DVec3, mode: usize, guess: f64, most: f64) -> Option<Found> {
        let mut xi = guess;
        for _ in 0..STEPS {
            let found = self.of_mode(along + xi * normal, mode);
            let step = found.excess / found.gradient.dot(normal);
            if step.is_nan() || step.abs() > most {
                return None;
            }
            xi -= step;
            if step.abs() <= FOUND {
                return Some(self.of_mode(along + xi * normal, mode));
            }
        }
        None
    }

    /// The wave of one mode whose wave vector points along `k`, and how far the size of `k` is from its index.
    fn of_mode(&self, k: DVec3, mode: usize) -> Found {
        let size2 = k.length_squared();
        let across = self.across(k / size2.sqrt());
        let d = across.axes[mode];
        let e = self.inverse_middle * d + self.inverse_rest * d;
        // f = K² λ; its gradient is along the ray: 2 (K × h) … = 2 |K| h × E with h = K × d / |K|
        let h = (k / size2.sqrt()).cross(d);
        Found { k, e, excess: size2 * across.values[mode] - 1.0, gradient: 2.0 * size2.sqrt() * e.cross(h) }
    }

    /// The eigenvalues of ε⁻¹ across a unit vector, the larger first, and their axes: directions of D, across each other.
    fn across(&self, direction: DVec3) -> Across {
        let u = direction.any_orthonormal_vector();
        let v = direction.cross(u);
        let (turned_u, turned_v) = (self.inverse_rest * u, self.inverse_rest * v);
        let (a, b, c) = (u.dot(turned_u), u.dot(turned_v), v.dot(turned_v));
        let (mean, half) = (self.inverse_middle + 0.5 * (a + c), 0.5 * (a - c));
        let radius = half.hypot(b);
        // the axis of the larger eigenvalue, at an angle φ from u: cos 2φ = half/radius; any where all are one
        let (cos, sin) = if radius > 0.0 {
            let cos2 = (half / radius).clamp(-1.0, 1.0);
            // of the two half-angle formulas the one without cancellation
            if cos2 >= 0.0 {
                let cos = (0.5 * (1.0 + cos2)).sqrt();
                (cos, 0.5 * b / (radius * cos))
            } else {
                let sin = (0.5 * (1.0 - cos2)).sqrt().copysign(b);
                (0.5 * b / (radius * sin), sin)
            }
        } else {
            (1.0, 0.0)
        };
        let first = cos * u + sin * v;
        Across { values: [mean + radius, mean - radius], axes: [first, direction.cross(first)] }
    }

    /// Both waves by the roots of the quartic, as they come near grazing: either may die away.
    fn by_quartic(&self, along: DVec3, normal: DVec3, side: Side) -> [Wave; 2] {
        let roots = quartic::roots(self.quartic(along, normal));
        let mut waves = BestTwo::default();
        for root in roots {
            if root.im.abs() > NEARLY_REAL {
                let decay = side.sign() * root.im;
                waves.add(decay, root, || self.dying(along, normal, root));
                continue;
            }
            for mode in [0, 1] {
                let near = self.newton(along, normal, mode, root.re, FAR_FROM_ROOT);
                if let Some(found) = near.filter(|found| found.goes(normal, side)) {
                    let xi = C::new(found.k.dot(normal), 0.0);
                    waves.add(1.0 + f64::from(2 - mode as u8), xi, || found.scaled(normal));
                }
            }
        }
        let waves = waves.found.map(|found| match found {
            Some((.., wave)) => wave,
            // two roots that rounding has made one: a wave along the facet, which carries nothing
            None => Wave::new(along.into(), normal.into(), normal).dying(),
        });
        if speed(&waves[0]) <= speed(&waves[1]) { waves } else { [waves[1], waves[0]] }
    }

    /// The wave of a complex root, after a step of Rayleigh's quotient: E·(K Kᵀ − K² + ε)E is 0 to the square of what is wrong with
    /// E and K.
    fn dying(&self, along: DVec3, normal: DVec3, root: C) -> Wave {
        let vector = |xi: C| Field { re: along + xi.re * normal, im: xi.im * normal };
        let k = vector(root);
        let e = self.null_field(k);
        let (ke, e2) = (k.dot(e), e.dot(e));
        let turned = Field { re: self.epsilon * e.re, im: self.epsilon * e.im };
        let value = ke * ke - k.dot(k) * e2 + e.dot(turned);
        let slope = 2.0 * (ke * e.along(normal) - k.along(normal) * e2);
        let step = value / slope;
        let k = if step.norm() < NEARLY_REAL { vector(root - step) } else { k };
        Wave::new(k, self.null_field(k), normal)
    }

    /// The coefficients of the quartic, the constant first.
    fn quartic(&self, q: DVec3, n: DVec3) -> [f64; 5] {
        let (eq, en) = (self.epsilon * q, self.epsilon * n);
        let (alpha, beta, gamma) = (q.dot(eq), q.dot(en), n.dot(en));
        let (mq, mn) = (self.middle * q, self.middle * n);
        let (m0, m1, m2) = (q.dot(mq), q.dot(mn), n.dot(mn));
        let q2 = q.length_squared();
        [
            alpha * q2 - m0 + self.determinant,
            2.0 * (beta * q2 - m1),
            alpha + gamma * q2 - m2,
            2.0 * beta,
            gamma,
        ]
    }

    /// The field of a complex wave vector that solves the quartic: across the rows of K Kᵀ − K² + ε.
    fn null_field(&self, k: Field) -> Field {
        let size2 = k.dot(k);
        let row = |axis: DVec3| {
            let size = size2 * Field::from(axis);
            k.along(axis) * k - size + Field::from(self.epsilon * axis)
        };
        let rows = [row(DVec3::X), row(DVec3::Y), row(DVec3::Z)];
        let crosses = [rows[0].cross(rows[1]), rows[1].cross(rows[2]), rows[2].cross(rows[0])];
        crosses.into_iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared())).unwrap_or(k)
    }
}

/// The eigenvalues of ε⁻¹ across a direction, and their axes.
struct Across {
    values: [f64; 2],
    axes: [DVec3; 2],
}

/// A wave whose wave vector is nearly or quite of its mode.
struct Found {
    k: DVec3,
    e: DVec3,
    /// K² λ − 1.
    excess: f64,
    /// Of K² λ by K: along the ray.
    gradient: DVec3,
}

impl Found {
    fn goes(&self, normal: DVec3, side: Side) -> bool {
        self.gradient.dot(normal) * side.sign() > 0.0
    }

    fn scaled(&self, normal: DVec3) -> Wave {
        Wave::new(self.k.into(), self.e.into(), normal)
    }
}

/// The two waves that go most to one side: first those that travel, then those that die away.
#[derive(Default)]
struct BestTwo {
    found: [Option<(f64, C, Wave)>; 2],
}

impl BestTwo {
    fn add(&mut self, rank: f64, root: C, wave: impl FnOnce() -> Wave) {
        let is_known = |found: &Option<(f64, C, Wave)>| {
            found.as_ref().is_some_and(|(known, at, _)| *known == rank && (at - root).norm() < ONE_ROOT)
        };
        if self.found.iter().any(is_known) {
            return;
        }
        let below = |found: &Option<(f64, C, Wave)>| found.as_ref().is_none_or(|(known, ..)| *known < rank);
        if below(&self.found[0]) {
            self.found[1] = self.found[0].replace((rank, root, wave()));
        } else if below(&self.found[1]) {
            self.found[1] = Some((rank, root, wave()));
        }
    }
}

/// What waves are ordered by: the square of the index of one that travels.
fn speed(wave: &Wave) -> f64 {
    wave.k.re.length_squared() - wave.k.im.length_squared()
}
