//! A robot among obstacles as the judge is told of it: the numbers of the files, and nothing worked out from them.

use engine::geometry::{Capsule, Frame, Solid, Vec3};
use schemars::JsonSchema;
use serde::Deserialize;

/// One row of Denavit–Hartenberg parameters with its joint's limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Twist.
    pub alpha_rad: f64,
    /// Length.
    pub a_m: f64,
    /// Offset.
    pub d_m: f64,
    /// Added to the joint angle.
    pub offset_rad: f64,
    /// The least and the greatest angle.
    pub limits_rad: [f64; 2],
}

/// One capsule of the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// The link it is fixed to; 0 is the base.
    pub link: usize,
    /// Where it is in the frame of its link.
    pub capsule: Capsule,
    /// Whether the scene can touch it.
    pub exposed: bool,
}

/// Something that stands still.
#[derive(Debug, Clone, PartialEq)]
pub struct Still {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub solid: Solid,
}

/// A robot among obstacles.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Its name.
    pub name: String,
    /// The robot's base in the world.
    pub base: Frame,
    /// The joints and links, base first.
    pub rows: Vec<Row>,
    /// How far the tool reaches from the last link's frame, along its z.
    pub tool_m: f64,
    /// The robot's capsules.
    pub parts: Vec<Part>,
    /// Which parts may hit each other, by index.
    pub self_pairs: Vec<[usize; 2]>,
    /// What stands around it.
    pub stills: Vec<Still>,
}

/// Two things that may touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pair {
    /// A part of the robot and something that stands still, by index.
    Still(usize, usize),
    /// Two parts of the robot.
    Parts(usize, usize),
}

impl Pair {
    /// What the pair belongs to: the still thing, or the robot itself.
    pub fn still(self) -> Option<usize> {
        match self {
            Self::Still(_, still) => Some(still),
            Self::Parts(..) => None,
        }
    }
}

impl Model {
    /// Everything that may touch: exposed parts with each still thing, then the robot with itself.
    pub fn pairs(&self) -> Vec<Pair> {
        let exposed = (0..self.parts.len()).filter(|part| self.parts[*part].exposed);
        let outer =
            exposed.flat_map(|part| (0..self.stills.len()).map(move |still| Pair::Still(part, still)));
        outer.chain(self.self_pairs.iter().map(|[a, b]| Pair::Parts(*a, *b))).collect()
    }

    /// A pair in words, as the judge answers for it; parts stand in alphabetical order.
    pub fn pair_name(&self, pair: Pair) -> String {
        match pair {
            Pair::Still(part, still) => format!("{}|{}", self.parts[part].name, self.stills[still].name),
            Pair::Parts(a, b) => {
                let (a, b) = (&self.parts[a].name, &self.parts[b].name);
                format!("{}|{}", a.min(b), a.max(b))
            }
        }
    }

    /// The names of the frames that are compared: each link's and the tool's.
    pub fn frame_names(&self) -> Vec<String> {
        let links = (1..=self.rows.len()).map(|link| format!("link_{link}"));
        links.chain(["tool".to_owned()]).collect()
    }

    /// The same with the longest link longer by `by_m`, and that link's number.
    pub fn stretched(&self, by_m: f64) -> (Self, usize) {
        let longest = (0..self.rows.len()).max_by(|a, b| self.rows[*a].a_m.total_cmp(&self.rows[*b].a_m));
        let longest = longest.expect("a robot has a link");
        let mut stretched = self.clone();
        stretched.rows[longest].a_m += by_m;
        (stretched, longest + 1)
    }

    /// The same with one still thing elsewhere.
    pub fn shifted(&self, still: usize, by_m: &Vec3) -> Self {
        let mut shifted = self.clone();
        shifted.stills[still].solid = moved(&self.stills[still].solid, by_m);
        shifted
    }
}

/// `solid` moved by `by_m`.
fn moved(solid: &Solid, by_m: &Vec3) -> Solid {
    use engine::geometry::{Convex, HalfSpace, OrientedBox, Sphere};
    const STAYS: &str = "a shape stays the same where it is moved to";
    match solid {
        Solid::Sphere(s) => Solid::Sphere(Sphere { center: s.center + by_m, radius: s.radius }),
        Solid::Capsule(c) => {
            Solid::Capsule(Capsule::new(c.segment.a + by_m, c.segment.b + by_m, c.radius).expect(STAYS))
        }
        Solid::Box(b) => {
            let frame = Frame { origin: b.frame().origin + by_m, rotation: b.frame().rotation };
            Solid::Box(OrientedBox::new(frame, b.half() * 2.0).expect(STAYS))
        }
        Solid::Convex(c) => {
            let vertices = c.vertices().iter().map(|vertex| vertex + by_m).collect();
            Solid::Convex(Convex::from_vertices(vertices).expect(STAYS))
        }
        Solid::HalfSpace(h) => {
            let point = h.normal() * -h.height(&Vec3::zeros()) + by_m;
            Solid::HalfSpace(HalfSpace::behind(&point, h.normal()).expect(STAYS))
        }
    }
}

/// What a path is said to be free of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Freedom {
    /// Nothing is promised.
    Nothing,
    /// What stands around the robot; it may hit itself.
    Scene,
    /// All contact.
    Contact,
}

impl Freedom {
    /// In the report's words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Scene => "obstacles",
            Self::Contact => "all contact",
        }
    }

    /// Whether a path with contact of `pair` is not as promised.
    pub fn is_broken_by(self, pair: Pair) -> bool {
        match self {
            Self::Nothing => false,
            Self::Scene => pair.still().is_some(),
            Self::Contact => true,
        }
    }
}
