//! The repulsive potential of the rods and the way the tip must turn to lower it.
//!
//! # Source
//! Tang, Zhou & Xu (2023), eqs. 21 to 26. Only the direction of the gradient is used, so the gain kr is left out.

use super::settings::{Clamp, Posture, Sign};
use nalgebra::{Matrix6, RowVector6};
use world::geometry::{Capsule, Frame, Vec3};
use world::kinematics::AXES;
use world::space::PolyhedraWorld;
use world::space::polyhedra::{Apart, CarriedArm, Contact};

/// The least distance that is put into the potential, unless it is taken literally.
const FLOOR_CM: f64 = 0.1;

/// What the potential is made of at one configuration.
pub(super) struct Field {
    /// U of eq. 22.
    pub(super) potential: f64,
    /// The least clearance.
    pub(super) clearance: f64,
    pub(super) contacts: Vec<Contact>,
}

/// The field of rods that are in place.
pub(super) fn field(
    settings: &Posture,
    world: &PolyhedraWorld,
    arm: &CarriedArm,
    rods: &[Capsule],
    apart: &Apart,
) -> Field {
    let reach = settings.d0_cm.max(settings.act_cm);
    let contacts = arm.contacts_of(rods, world.bodies(), reach, settings.uses_printed_distance(), apart);
    let clearance = contacts.iter().map(|contact| contact.clearance).fold(reach, f64::min);
    let potential = contacts.iter().map(|contact| {
        let gap = gap(settings, contact.clearance);
        0.5 * (1.0 / gap - 1.0 / settings.d0_cm).max(0.0).powi(2)
    });
    Field { potential: potential.sum(), clearance, contacts }
}

/// The distance of eq. 6, floored or clamped at 0 as printed.
fn gap(settings: &Posture, clearance: f64) -> f64 {
    match settings.clamp {
        Clamp::Floor => clearance.max(FLOOR_CM),
        Clamp::Literal => clearance.max(0.0),
    }
}

/// The unit rotation vector along which the tip is turned: against the gradient of U, or along it as eqs. 23 and 24
/// print it. `None` where there is no gradient: at contact taken literally, in a singular pose without damping.
pub(super) fn direction(
    settings: &Posture,
    arm: &CarriedArm,
    frames: &[Frame; AXES + 1],
    field: &Field,
) -> Option<Vec3> {
    let mut gradient = RowVector6::zeros();
    for contact in &field.contacts {
        let gap = gap(settings, contact.clearance);
        if gap >= settings.d0_cm {
            continue;
        }
        let slope = (1.0 / settings.d0_cm - 1.0 / gap) / (gap * gap);
        let Some(away) = (contact.on_rod - contact.on_obstacle).try_normalize(1e-9) else { continue };
        let moves = arm.rod_jacobian(frames, contact.rod, &contact.on_rod);
        gradient += away.transpose() * moves.fixed_rows::<3>(0) * slope;
    }
    let turning = gradient * inverse(&arm.tip_jacobian(frames), settings.damping)?;
    let turning = Vec3::new(turning[3], turning[4], turning[5]);
    let unit = turning.try_normalize(1e-300).filter(|unit| unit.iter().all(|c| c.is_finite()))?;
    Some(match settings.sign {
        Sign::Down => -unit,
        Sign::AsPrinted => unit,
    })
}

/// The inverse of the tip's Jacobian in metres and radians, damped as least squares are.
pub(super) fn inverse(jacobian: &Matrix6<f64>, damping: f64) -> Option<Matrix6<f64>> {
    let mut jacobian = *jacobian;
    jacobian.fixed_view_mut::<3, 6>(0, 0).scale_mut(1e-2);
    if damping == 0.0 {
        return jacobian.lu().try_inverse();
    }
    let square = jacobian.transpose() * jacobian + Matrix6::identity() * (damping * damping);
    Some(square.lu().try_inverse()? * jacobian.transpose())
}
