//! How the axes of a crystal lie in a stone.

use glam::{DMat3, DQuat};
use std::fmt;

/// How the principal axes of a crystal lie in a stone whose table looks along +z: α, β and γ of a biaxial one; of a
/// uniaxial one the optic axis is the third.
///
/// The third axis has the polar angle θ from the normal of the table and the azimuth φ from +x; ψ turns the first about it.
/// The axes are the columns of R_z(φ) R_y(θ) R_z(ψ).
///
/// ```
/// use cutlab::advanced::materials::CrystalOrientation;
///
/// let across = CrystalOrientation::from_degrees(90.0, 0.0, 0.0)?;
/// assert_eq!(across, CrystalOrientation::ACROSS);
/// assert!((across.axes().z_axis.x - 1.0).abs() < 1e-15);
/// # Ok::<(), cutlab::advanced::materials::CrystalOrientationError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrystalOrientation {
    theta_deg: f64,
    phi_deg: f64,
    psi_deg: f64,
}

/// An angle that no orientation has.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{angle} of the c-axis from {least} to {most} degrees is needed, found {found}")]
pub struct CrystalOrientationError {
    /// The angle's name.
    pub angle: &'static str,
    /// The least that it can be, degrees.
    pub least: f64,
    /// The most.
    pub most: f64,
    /// What was given.
    pub found: f64,
}

impl CrystalOrientation {
    /// γ, or the optic axis, through the table; α along +x.
    pub const UP: CrystalOrientation = CrystalOrientation { theta_deg: 0.0, phi_deg: 0.0, psi_deg: 0.0 };

    /// γ, or the optic axis, along +x in the plane of the girdle; α through the table.
    pub const ACROSS: CrystalOrientation = CrystalOrientation { theta_deg: 90.0, phi_deg: 0.0, psi_deg: 0.0 };

    /// The orientation called `up` or `across`.
    pub fn by_name(name: &str) -> Option<CrystalOrientation> {
        match name {
            "up" => Some(Self::UP),
            "across" => Some(Self::ACROSS),
            _ => None,
        }
    }

    /// An orientation by its angles in degrees.
    ///
    /// - `theta`: of γ or the optic axis from the normal of the table, 0 to 180; `phi`: its azimuth from +x, −360 to 360
    /// - `psi`: the turn of α about γ, −360 to 360; of no effect in a uniaxial crystal
    pub fn from_degrees(
        theta: f64,
        phi: f64,
        psi: f64,
    ) -> Result<CrystalOrientation, CrystalOrientationError> {
        for (angle, found, least, most) in
            [("theta", theta, 0.0, 180.0), ("phi", phi, -360.0, 360.0), ("psi", psi, -360.0, 360.0)]
        {
            if !(least..=most).contains(&found) {
                return Err(CrystalOrientationError { angle, least, most, found });
            }
        }
        Ok(CrystalOrientation { theta_deg: theta, phi_deg: phi, psi_deg: psi })
    }

    /// θ, φ and ψ, degrees.
    pub fn degrees(&self) -> [f64; 3] {
        [self.theta_deg, self.phi_deg, self.psi_deg]
    }

    /// The principal axes in the frame of the stone: unit vectors, the columns.
    pub fn axes(&self) -> DMat3 {
        let turn = |about: fn(f64) -> DQuat, degrees: f64| about(degrees.to_radians());
        DMat3::from_quat(
            turn(DQuat::from_rotation_z, self.phi_deg)
                * turn(DQuat::from_rotation_y, self.theta_deg)
                * turn(DQuat::from_rotation_z, self.psi_deg),
        )
    }
}

impl Default for CrystalOrientation {
    /// [`CrystalOrientation::UP`].
    fn default() -> CrystalOrientation {
        Self::UP
    }
}

/// As material files have it: `up`, `across`, `[theta, phi]` or `[theta, phi, psi]`.
impl fmt::Display for CrystalOrientation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match *self {
            Self::UP => f.write_str("up"),
            Self::ACROSS => f.write_str("across"),
            CrystalOrientation { theta_deg, phi_deg, psi_deg: 0.0 } => write!(f, "[{theta_deg}, {phi_deg}]"),
            CrystalOrientation { theta_deg, phi_deg, psi_deg } => {
                write!(f, "[{theta_deg}, {phi_deg}, {psi_deg}]")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn names_and_angles_turn_the_axes_where_they_say() {
        let near = |a: DVec3, b: DVec3| (a - b).length() < 1e-15;
        assert_eq!(CrystalOrientation::UP.axes(), DMat3::IDENTITY);
        let across = CrystalOrientation::ACROSS.axes();
        assert!(near(across.z_axis, DVec3::X) && near(across.x_axis, DVec3::NEG_Z), "{across}");
        let turned = CrystalOrientation::from_degrees(90.0, 90.0, 90.0).expect("angles").axes();
        // γ along +y; α, turned by a right angle about it, in the girdle; β through the table
        assert!(near(turned.z_axis, DVec3::Y) && turned.x_axis.z.abs() < 1e-15, "{turned}");
        assert!((turned.y_axis.z.abs() - 1.0).abs() < 1e-15);
        let odd = CrystalOrientation::from_degrees(30.0, 40.0, 50.0).expect("angles");
        let axes = odd.axes();
        assert!((axes.transpose() * axes - DMat3::IDENTITY).to_cols_array().iter().all(|x| x.abs() < 1e-15));
        assert!((axes.z_axis.z - 30f64.to_radians().cos()).abs() < 1e-15);
        assert!((axes.z_axis.y.atan2(axes.z_axis.x).to_degrees() - 40.0).abs() < 1e-12);
    }

    #[test]
    fn angles_that_cannot_be_are_named() {
        for (theta, phi, psi, angle) in [
            (-1.0, 0.0, 0.0, "theta"),
            (f64::NAN, 0.0, 0.0, "theta"),
            (0.0, 400.0, 0.0, "phi"),
            (0.0, 0.0, f64::INFINITY, "psi"),
        ] {
            assert_eq!(CrystalOrientation::from_degrees(theta, phi, psi).map_err(|e| e.angle), Err(angle));
        }
        let said = |theta, phi, psi| CrystalOrientation::from_degrees(theta, phi, psi).map(|o| o.to_string());
        assert_eq!(said(0.0, 0.0, 0.0).as_deref(), Ok("up"));
        assert_eq!(said(90.0, 0.0, 90.0).as_deref(), Ok("[90, 0, 90]"));
        assert_eq!(said(45.0, 10.5, 0.0).as_deref(), Ok("[45, 10.5]"));
        assert_eq!(CrystalOrientation::by_name("across"), Some(CrystalOrientation::ACROSS));
        assert_eq!(CrystalOrientation::by_name("along"), None);
    }
}
