//! Roots of a quartic with real coefficients.

use super::field::C;

/// The four roots of c₀ + c₁x + c₂x² + c₃x³ + c₄x⁴, real ones with an imaginary part of exactly 0, others in pairs.
///
/// By Ferrari's resolvent: a product of two real quadratics. `c₄` is not 0.
pub fn roots(c: [f64; 5]) -> [C; 4] {
    // x⁴ + bx³ + …; depressed by x = y − b/4
    let [e, d, cc, b] = [c[0] / c[4], c[1] / c[4], c[2] / c[4], c[3] / c[4]];
    let shift = 0.25 * b;
    let s2 = shift * shift;
    let p = cc - 6.0 * s2;
    let q = d - 2.0 * shift * cc + 8.0 * shift * s2;
    let r = e - shift * d + s2 * cc - 3.0 * s2 * s2;
    // (y² + uy + v)(y² − uy + w): u² is a root z ≥ 0 of z³ + 2pz² + (p² − 4r)z − q² = 0
    let z = greatest_root(2.0 * p, p * p - 4.0 * r, -q * q).max(0.0);
    let u = z.sqrt();
    let (v, w) = if u > 1e-8 {
        (0.5 * (p + z - q / u), 0.5 * (p + z + q / u))
    } else {
        // biquadratic: v + w = p, v w = r, unless that is complex
        let disc = (0.25 * p * p - r).max(0.0).sqrt();
        (0.5 * p + disc, 0.5 * p - disc)
    };
    let [a, b2] = quadratic(u, v);
    let [c2, d2] = quadratic(-u, w);
    [a, b2, c2, d2].map(|y| C::new(y.re - shift, y.im))
}

/// The roots of y² + by + c.
fn quadratic(b: f64, c: f64) -> [C; 2] {
    let disc = 0.25 * b * b - c;
    if disc < 0.0 {
        let im = (-disc).sqrt();
        return [C::new(-0.5 * b, im), C::new(-0.5 * b, -im)];
    }
    let far = -0.5 * b - disc.sqrt().copysign(b);
    let near = if far == 0.0 { 0.0 } else { c / far };
    [C::new(far, 0.0), C::new(near, 0.0)]
}

/// The greatest real root of z³ + az² + bz + c.
fn greatest_root(a: f64, b: f64, c: f64) -> f64 {
    let third = a / 3.0;
    let q = third * third - b / 3.0;
    let r = third * (third * third - 0.5 * b) + 0.5 * c;
    let root = if r * r < q * q * q {
        let angle = (r / (q * q * q).sqrt()).clamp(-1.0, 1.0).acos();
        -2.0 * q.sqrt() * ((angle + std::f64::consts::TAU) / 3.0).cos() - third
    } else {
        let s = -(r.abs() + (r * r - q * q * q).max(0.0).sqrt()).cbrt().copysign(r);
        let t = if s == 0.0 { 0.0 } else { q / s };
        s + t - third
    };
    // two steps of Newton's method
    let mut z = root;
    for _ in 0..2 {
        let slope = (3.0 * z + 2.0 * a) * z + b;
        let step = (((z + a) * z + b) * z + c) / slope;
        if step.is_finite() && step.abs() < 0.1 * (1.0 + z.abs()) {
            z -= step;
        }
    }
    z
}
