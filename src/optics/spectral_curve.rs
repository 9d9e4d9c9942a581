//! A curve through the points of a table: a quantity against wavelength.

use std::sync::Arc;

/// A curve through points (wavelength in nm, value): between two neighbours it only rises or only falls, so
/// that it has no extremes that the table has not. Beyond the first and the last point it has their values.
///
/// Cubic in each interval, with the slopes of F. N. Fritsch and J. Butland, *SIAM J. Sci. Stat. Comput.* 5
/// (1984) 300; at the ends three-point slopes, cut where the curve would turn.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralCurve {
    points: Arc<[(f64, f64)]>,
    slopes: Arc<[f64]>,
}

impl SpectralCurve {
    /// The curve through two or more points of rising wavelength; none if they are not that.
    pub fn new(points: Vec<(f64, f64)>) -> Option<SpectralCurve> {
        let finite = points.iter().all(|(nm, value)| nm.is_finite() && value.is_finite());
        let rising = points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        if points.len() < 2 || !finite || !rising {
            return None;
        }
        let steps: Vec<f64> = points.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
        let secants: Vec<f64> =
            points.windows(2).zip(&steps).map(|(pair, h)| (pair[1].1 - pair[0].1) / h).collect();
        let last = secants.len() - 1;
        let mut slopes = vec![secants[0]; points.len()];
        slopes[last + 1] = secants[last];
        for i in 1..=last {
            slopes[i] = inner_slope([steps[i - 1], steps[i]], [secants[i - 1], secants[i]]);
        }
        if last > 0 {
            slopes[0] = end_slope([steps[0], steps[1]], [secants[0], secants[1]]);
            slopes[last + 1] = end_slope([steps[last], steps[last - 1]], [secants[last], secants[last - 1]]);
        }
        Some(SpectralCurve { points: points.into(), slopes: slopes.into() })
    }

    /// The value at the wavelength `nm`.
    pub fn at(&self, nm: f64) -> f64 {
        let i = self.points.partition_point(|(x, _)| *x <= nm).clamp(1, self.points.len() - 1) - 1;
        let ((x0, y0), (x1, y1)) = (self.points[i], self.points[i + 1]);
        let h = x1 - x0;
        let t = ((nm - x0) / h).clamp(0.0, 1.0);
        let (t2, t3) = (t * t, t * t * t);
        (2.0 * t3 - 3.0 * t2 + 1.0) * y0
            + (3.0 * t2 - 2.0 * t3) * y1
            + h * ((t3 - 2.0 * t2 + t) * self.slopes[i] + (t3 - t2) * self.slopes[i + 1])
    }

    /// First and last wavelength of the table, nm.
    pub fn range_nm(&self) -> (f64, f64) {
        (self.points[0].0, self.points[self.points.len() - 1].0)
    }
}

/// The slope at a point between two intervals: the harmonic mean of the secants, weighted by the lengths of
/// the intervals; 0 at an extreme.
fn inner_slope([h0, h1]: [f64; 2], [d0, d1]: [f64; 2]) -> f64 {
    if d0 * d1 <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
    (w0 + w1) / (w0 / d0 + w1 / d1)
}

/// The slope at an end, of the parabola through three points, cut to what keeps the curve monotone.
fn end_slope([h0, h1]: [f64; 2], [d0, d1]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    match slope {
        s if s * d0 <= 0.0 => 0.0,
        s if d0 * d1 <= 0.0 && s.abs() > 3.0 * d0.abs() => 3.0 * d0,
        s => s,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_goes_through_its_points_and_never_beyond_two_neighbours() {
        let points = vec![(400.0, 1.0), (410.0, 1.0), (430.0, 3.0), (431.0, 0.0), (500.0, 0.2), (510.0, 0.9)];
        let curve = SpectralCurve::new(points.clone()).expect("a table");
        for pair in points.windows(2) {
            let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
            assert!((curve.at(x0) - y0).abs() < 1e-12 && (curve.at(x1) - y1).abs() < 1e-12);
            let inside: Vec<f64> =
                (0..=100).map(|i| curve.at(x0 + (x1 - x0) * f64::from(i) / 100.0)).collect();
            assert!(inside.windows(2).all(|w| (w[1] - w[0]) * (y1 - y0) >= -1e-12), "{x0} {x1}");
            assert!(inside.iter().all(|y| (y0.min(y1) - 1e-12..=y0.max(y1) + 1e-12).contains(y)));
        }
        assert_eq!((curve.at(300.0), curve.at(900.0)), (1.0, 0.9));
        assert_eq!(curve.range_nm(), (400.0, 510.0));
    }

    /// [D] A straight line comes out as one; a smooth law within h³ of its third derivative.
    #[test]
    fn the_curve_follows_smooth_laws() {
        let of = |law: &dyn Fn(f64) -> f64, step: usize| {
            let points = (380..=780).step_by(step).map(|nm| (nm as f64, law(nm as f64))).collect();
            SpectralCurve::new(points).expect("a table")
        };
        let line = of(&|nm| 3.0 - nm / 1000.0, 40);
        assert!(
            (0..400)
                .all(|i| (line.at(380.5 + f64::from(i)) - (2.6195 - f64::from(i) / 1000.0)).abs() < 1e-12)
        );
        let cauchy = |nm: f64| 1.6 + 5000.0 / (nm * nm);
        let curve = of(&cauchy, 20);
        let worst = (0..400).map(|i| 380.0 + f64::from(i)).map(|nm| (curve.at(nm) - cauchy(nm)).abs());
        assert!(worst.fold(0.0, f64::max) < 1e-5);
        assert!(SpectralCurve::new(vec![(400.0, 1.0)]).is_none());
        assert!(SpectralCurve::new(vec![(400.0, 1.0), (400.0, 1.0)]).is_none());
    }
}
