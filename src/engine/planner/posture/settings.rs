//! The choices that the paper leaves open about posture adjustment, as settings.

use base::settings::{Faults, Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;

/// Settings of the stage.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Posture {
    /// Whether postures are adjusted at all; without, the arm follows the path with its first posture.
    pub(super) adjust: bool,
    /// Whether the tip turns against the gradient or along it.
    pub(super) sign: Sign,
    /// What is put into the potential at contact.
    pub(super) clamp: Clamp,
    /// How distances are measured.
    pub(super) distance: Distance,
    /// How the joints follow a change of posture.
    pub(super) pose: Pose,
    /// Damping of the Jacobian's inverse, in metres and radians; 0 for none.
    pub(super) damping: f64,
    /// Adjustment starts below this clearance.
    pub(super) act_cm: f64,
    /// The potential's range.
    pub(super) d0_cm: f64,
    /// The longest turn of one step.
    pub(super) step_rad: f64,
    /// Most steps at one node.
    #[schemars(range(max = 1_000_000))]
    pub(super) iterations: u32,
    /// The most that the posture may turn about x, y and z.
    pub(super) bounds_rad: [f64; 3],
    /// From where the bounds count.
    pub(super) bounds: Bounds,
    /// By how much the posture returns towards the first one at each node.
    pub(super) recovery_rad: f64,
    /// Rods nearer than this are taken to touch.
    #[serde(default = "millimetre")]
    pub(super) margin_cm: f64,
    /// How often a step that does not help is halved.
    #[serde(default = "five")]
    #[schemars(range(max = 60))]
    pub(super) halvings: u32,
    /// Which solutions of the inverse kinematics are tried at the start.
    pub(super) branches: Branches,
    /// Whether a failed node is searched for postures that would have done.
    pub(super) diagnose: bool,
}

fn millimetre() -> f64 {
    0.1
}

fn five() -> u32 {
    5
}

/// Which way the tip turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Sign {
    /// Against the gradient of U.
    Down,
    /// Along it, as eq. 24 and the text after eq. 26 say.
    AsPrinted,
}

/// What stands for the distance at contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Clamp {
    /// A millimetre.
    Floor,
    /// 0, as eq. 6 says.
    Literal,
}

/// How distances are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Distance {
    /// Exactly.
    Exact,
    /// By edges and diagonals, as eqs. 7 to 18 do.
    Printed,
}

/// How the joints follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Pose {
    /// By the closed-form inverse.
    Inverse,
    /// By eq. 30, δQ = J⁻¹ δX.
    Jacobian,
}

/// From where bounds count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Bounds {
    /// From the posture with which the node was entered.
    PerNode,
    /// From the first posture.
    FromStart,
}

/// Which solutions are tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Branches {
    /// All, the one with the most clearance at the start first.
    All,
    /// That one only.
    Clearest,
}

impl Posture {
    /// The settings, checked.
    pub(super) fn read(settings: &Settings) -> Result<Self, SettingsError> {
        let read: Self = settings.read()?;
        let mut faults = Faults::default();
        for (name, value, above) in [
            ("act_cm", read.act_cm, 0.0),
            ("d0_cm", read.d0_cm, 0.0),
            ("margin_cm", read.margin_cm, 0.0),
            ("step_rad", read.step_rad, 0.0),
            ("damping", read.damping, -f64::MIN_POSITIVE),
            ("recovery_rad", read.recovery_rad, -f64::MIN_POSITIVE),
            ("bounds_rad", read.bounds_rad.into_iter().fold(f64::INFINITY, f64::min), 0.0),
        ] {
            if value.is_nan() || value <= above || (value.is_infinite() && name != "bounds_rad") {
                let least = if above < 0.0 { "0 or more" } else { "more than 0" };
                faults.add(settings.error_at(name, format!("{name} is {value}; {least} is accepted")));
            }
        }
        faults.done()?;
        Ok(read)
    }

    /// Whether distances are the paper's.
    pub(super) fn uses_printed_distance(&self) -> bool {
        self.distance == Distance::Printed
    }
}
