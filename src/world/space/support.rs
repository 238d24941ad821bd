//! Where an arm stands in a scene and what is under it, as every kind of scene file says it.
//!
//! A scene without this table is one for points. Lengths in files are millimetres, those in memory metres. The world's z points up.

use crate::geometry::{Frame, GeometryError, HalfSpace, OrientedBox, Solid, Vec3};
use crate::kinematics::FARTHEST_MM;
use base::units::{seems_in_metres, seems_in_radians, unbent};
use schemars::JsonSchema;
use serde::Deserialize;

/// The message where a scene of an arm has no such table.
const MISSING: &str = "a scene of an arm says where its base stands and what is under it: a table `[support]` with \
                       `under = \"floor\"`, `\"pedestal\"` or `\"nothing\"` is accepted";

/// The table `[support]` of a scene file.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "under", rename_all = "snake_case", deny_unknown_fields)]
pub enum SupportEntry {
    /// The base stands on the floor, which is at its height.
    Floor {
        /// x, y and z of the base.
        #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
        base_mm: [f64; 3],
        /// How far the base is turned about the vertical.
        yaw_deg: f64,
    },
    /// The base stands on a block, and that on the floor.
    Pedestal {
        /// x, y and z of the base, the middle of the block's top.
        #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
        base_mm: [f64; 3],
        /// How far base and block are turned about the vertical.
        yaw_deg: f64,
        /// How high the floor is.
        #[schemars(range(min = -FARTHEST_MM, max = FARTHEST_MM))]
        floor_mm: f64,
        /// The block's sides along the base's x and y.
        #[schemars(inner(range(max = FARTHEST_MM)))]
        sides_mm: [f64; 2],
    },
    /// Nothing that a rod could meet: the base hangs, or is held from behind.
    Nothing {
        /// x, y and z of the base.
        #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
        base_mm: [f64; 3],
        /// How far the base is turned about the vertical.
        yaw_deg: f64,
        /// How high the floor is; there is none if absent.
        #[schemars(range(min = -FARTHEST_MM, max = FARTHEST_MM))]
        floor_mm: Option<f64>,
        /// Why there is nothing: what the arm hangs from, or whose problem it is that has no floor.
        why: String,
    },
}

/// A base that is not at the origin is farther from it.
const NEAR_MM: f64 = 2.0;

/// Where an arm stands and what is under it.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    base: Frame,
    floor_m: Option<f64>,
    pedestal: Option<OrientedBox>,
}

impl SupportEntry {
    /// The entry, checked.
    ///
    /// # Errors
    /// A sentence for a turn in radians, a pedestal without height or sides, and where nothing is under the arm for no reason; with the key that it is
    /// about.
    pub fn support(&self) -> Result<Support, (&'static str, String)> {
        let (Self::Floor { yaw_deg, .. } | Self::Pedestal { yaw_deg, .. } | Self::Nothing { yaw_deg, .. }) =
            self;
        if let Some((_, message)) = seems_in_radians("yaw_deg", &[*yaw_deg]) {
            return Err(("yaw_deg", message));
        }
        let (Self::Floor { base_mm, .. } | Self::Pedestal { base_mm, .. } | Self::Nothing { base_mm, .. }) =
            self;
        let farthest = base_mm.iter().fold(0.0_f64, |farthest, at| farthest.max(at.abs()));
        if farthest > 0.0 && farthest < NEAR_MM {
            let message = format!(
                "base_mm reaches {farthest} mm from the origin; is it in metres? millimetres are accepted ({farthest} m is {} mm)",
                unbent(farthest * 1e3)
            );
            return Err(("base_mm", message));
        }
        match self {
            Self::Floor { base_mm, yaw_deg } => {
                let base = frame(*base_mm, *yaw_deg);
                Ok(Support { base, floor_m: Some(base.origin.z), pedestal: None })
            }
            Self::Pedestal { base_mm, yaw_deg, floor_mm, sides_mm } => {
                let base = frame(*base_mm, *yaw_deg);
                let height_mm = base_mm[2] - floor_mm;
                if height_mm <= 0.0 {
                    let message = "floor_mm is at the base or above it; a floor below it is accepted, or \
                                   `under = \"floor\"`";
                    return Err(("floor_mm", message.to_owned()));
                }
                let longest = sides_mm[0].max(sides_mm[1]);
                for (key, what, length_mm) in [
                    ("floor_mm", "the way from floor_mm up to the base", height_mm),
                    ("sides_mm", "the longer of sides_mm", longest),
                ] {
                    if let Some(message) = seems_in_metres(what, length_mm) {
                        return Err((key, message));
                    }
                }
                let size = Vec3::new(sides_mm[0], sides_mm[1], height_mm) * 1e-3;
                let middle = base * Frame::at(Vec3::z() * (-0.5 * size.z));
                let block = OrientedBox::new(middle, size)
                    .map_err(|e| ("sides_mm", format!("sides_mm: {e} (lengths in metres)")))?;
                Ok(Support { base, floor_m: Some(floor_mm * 1e-3), pedestal: Some(block) })
            }
            Self::Nothing { why, .. } if why.trim().is_empty() => {
                let message = "why is empty; the reason for which nothing is under the arm is accepted";
                Err(("why", message.to_owned()))
            }
            Self::Nothing { base_mm, yaw_deg, floor_mm, .. } => Ok(Support {
                base: frame(*base_mm, *yaw_deg),
                floor_m: floor_mm.map(|height| height * 1e-3),
                pedestal: None,
            }),
        }
    }
}

fn frame(base_mm: [f64; 3], yaw_deg: f64) -> Frame {
    Frame::at(Vec3::from(base_mm) * 1e-3) * Frame::turned(&Vec3::z(), yaw_deg.to_radians())
}

impl Support {
    /// The message about a scene that an arm is put into and that has no support.
    ///
    /// # Errors
    /// A sentence, if there is none.
    pub fn declared(support: Option<&Self>) -> Result<&Self, String> {
        support.ok_or_else(|| MISSING.to_owned())
    }

    /// On the floor at the height of `base`.
    pub fn on_floor(base: Frame) -> Self {
        Self { base, floor_m: Some(base.origin.z), pedestal: None }
    }

    /// The base in the world.
    pub fn base(&self) -> &Frame {
        &self.base
    }

    /// How high the floor is, if there is one.
    pub fn floor_m(&self) -> Option<f64> {
        self.floor_m
    }

    /// The block that the base stands on, if there is one.
    pub fn pedestal(&self) -> Option<&OrientedBox> {
        self.pedestal.as_ref()
    }

    /// Floor and pedestal, by name.
    ///
    /// # Errors
    /// [`GeometryError`] if the floor's height is not finite.
    pub fn solids(&self) -> Result<Vec<(&'static str, Solid)>, GeometryError> {
        let floor =
            self.floor_m.map(|height| HalfSpace::below(height).map(|half| ("floor", Solid::HalfSpace(half))));
        let block = self.pedestal.map(|block| Ok(("pedestal", Solid::Box(block))));
        floor.into_iter().chain(block).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Support, String> {
        toml::from_str::<SupportEntry>(text)
            .map_err(|e| e.to_string())?
            .support()
            .map_err(|(_, message)| message)
    }

    #[test]
    fn what_is_under_a_base_is_where_the_base_ends() {
        let floor = read("under = 'floor'\nbase_mm = [100, 0, -50]\nyaw_deg = 90\n").unwrap();
        assert_eq!(floor.floor_m(), Some(-0.05));
        assert!((floor.base().axis(0) - Vec3::y()).norm() < 1e-12, "{floor:?}");
        let block = "under = 'pedestal'\nbase_mm = [0, 0, 300]\nyaw_deg = 0\nfloor_mm = -100\nsides_mm = [200, 400]\n";
        let raised = read(block).unwrap();
        let bounds = raised.pedestal().unwrap().aabb();
        assert!((bounds.min - Vec3::new(-0.1, -0.2, -0.1)).norm() < 1e-12, "{bounds:?}");
        assert!((bounds.max - Vec3::new(0.1, 0.2, 0.3)).norm() < 1e-12, "{bounds:?}");
        let names: Vec<&str> = raised.solids().unwrap().iter().map(|(name, _)| *name).collect();
        assert_eq!((names, raised.floor_m()), (vec!["floor", "pedestal"], Some(-0.1)));
        let hung = read("under = 'nothing'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nwhy = 'hung'\n").unwrap();
        assert!(hung.solids().unwrap().is_empty());
        let above =
            read("under = 'nothing'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nwhy = 'hung'\nfloor_mm = -2000\n")
                .unwrap();
        assert_eq!(above.floor_m(), Some(-2.0));
    }

    #[test]
    fn a_support_that_is_none_is_refused() {
        let block =
            "under = 'pedestal'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nfloor_mm = 0\nsides_mm = [200, 400]\n";
        assert!(read(block).unwrap_err().contains("a floor below it is accepted"));
        let flat = block.replace("floor_mm = 0", "floor_mm = -9").replace("[200", "[0");
        assert!(read(&flat).unwrap_err().contains("sides_mm"));
        let empty = "under = 'nothing'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nwhy = ' '\n";
        assert!(read(empty).unwrap_err().contains("why is empty"));
        for (of, to, question) in [
            (
                "floor_mm = 0",
                "floor_mm = -0.8",
                "the way from floor_mm up to the base is 0.8; is it in metres?",
            ),
            (
                "[200, 400]",
                "[0.2, 0.4]",
                "the longer of sides_mm is 0.4; is it in metres? millimetres are accepted (0.4 m is 400 mm)",
            ),
        ] {
            let message = read(&block.replace(of, to).replace("floor_mm = 0", "floor_mm = -9")).unwrap_err();
            assert!(message.contains(question), "{message}");
        }
        assert!(Support::declared(None).unwrap_err().contains("[support]"));
    }
}
