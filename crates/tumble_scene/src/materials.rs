//! Friction and restitution of a pair of materials.
//!
//! Tables are stacked: the lecture's at the bottom, then the files of `materials_from` in their order, then what the scene itself says.
//! For a pair (a, b) the topmost table that speaks of it decides, and inside a table a pair is stronger than two materials:
//!
//! ```text
//! listed pair     friction in the scene's surface state, one figure out of a range (`take`)
//! unlisted pair   μ = √(μ_a μ_b), each from the material itself or else from its pair with itself
//! restitution     of the pair, else max(ε_a, ε_b), else 0
//! ```
//!
//! The geometric mean and the maximum are the rules of Box2D and Jolt: a material against itself keeps its own figures, a frictionless
//! partner makes the pair frictionless, and a rubber ball bounces on whatever it meets.

mod origin;

use std::collections::BTreeMap;
use std::fmt;

use crate::format::{
    Coefficient, Dialect, FrictionEntry, MaterialEntry, MaterialTable, PairEntry, Scene, Surface, Take,
};

pub use origin::{Origin, PairOrigins, Remark, Source};

/// The lecture's table of friction coefficients, as the file that is shipped.
pub const LECTURE_TABLE: &str = include_str!("../../../assets/materials/lecture.ron");

/// The material of bodies that name none; frictionless and without bounce unless a table defines it.
pub const DEFAULT_MATERIAL: &str = "default";

/// What contact between two materials feels like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairProperties {
    /// Coefficient of static friction μ_s [1].
    pub static_friction: f64,
    /// Coefficient of kinetic friction μ_k [1].
    pub kinetic_friction: f64,
    /// Coefficient of restitution ε, from 0 to 1 [1].
    pub restitution: f64,
}

/// Something worth knowing about the figures of a pair.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialNotice {
    /// Only one coefficient is known and stands for both.
    OneForBoth {
        /// The coefficient that is absent: "static" or "kinetic".
        absent: &'static str,
        /// The figure that stands for it [1].
        value: f64,
    },
    /// Kinetic friction is above static friction.
    KineticAboveStatic {
        /// Coefficient of static friction [1].
        static_friction: f64,
        /// Coefficient of kinetic friction [1].
        kinetic_friction: f64,
    },
    /// The pair has figures for the other surface state only.
    OtherSurface {
        /// The state whose figures are used.
        used: Surface,
    },
    /// A material occurs in pairs only, none of which says how it rubs against others: no friction.
    NoFriction {
        /// The material.
        material: String,
    },
}

impl fmt::Display for MaterialNotice {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::OneForBoth { absent, value } => {
                write!(formatter, "no {absent} friction is known, so it is taken as {value}, like the other one")
            }
            Self::KineticAboveStatic { static_friction, kinetic_friction } => {
                write!(formatter, "kinetic friction {kinetic_friction} is above static friction {static_friction}")
            }
            Self::OtherSurface { used } => {
                let state = if *used == Surface::Dry { "dry" } else { "lubricated" };
                write!(formatter, "friction is known only for {state} surfaces, whose figures are used")
            }
            Self::NoFriction { material } => {
                write!(formatter, "no table tells the friction of \"{material}\" against it, so there is none")
            }
        }
    }
}

/// Properties of a pair and what is worth knowing about them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResolvedPair {
    /// The figures.
    pub properties: PairProperties,
    /// Where each of them came from.
    pub origins: PairOrigins,
    /// Notices about the figures.
    pub notices: Vec<MaterialNotice>,
}

/// A stack of material tables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialLibrary {
    surface: Surface,
    take: Take,
    /// Number of tables in the stack.
    tables: usize,
    materials: BTreeMap<String, Material>,
    pairs: BTreeMap<(String, String), Pair>,
}

/// A figure and the table it came from, counted from the bottom.
type FromTable<T> = Option<(usize, T)>;

#[derive(Clone, Debug, Default, PartialEq)]
struct Material {
    /// Whether a table has an entry for it; others occur in pairs only.
    is_declared: bool,
    friction: FromTable<FrictionEntry>,
    restitution: FromTable<f64>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Pair {
    dry: FromTable<FrictionEntry>,
    lubricated: FromTable<FrictionEntry>,
    restitution: FromTable<f64>,
}

impl MaterialLibrary {
    /// The lecture's table and what a scene says itself, without the files it names.
    pub fn of_scene<D: Dialect>(scene: &Scene<D>) -> Self {
        Self::with_tables(scene, &[])
    }

    /// The lecture's table, further tables, and what a scene says itself.
    pub fn with_tables<D: Dialect>(scene: &Scene<D>, tables: &[MaterialTable]) -> Self {
        let mut library = Self { surface: scene.surface, take: scene.take, ..Self::default() };
        library.add_table(&lecture_table());
        for table in tables {
            library.add_table(table);
        }
        library.add(&scene.materials, &scene.pairs);
        library
    }

    /// The library of a scene that differs from its own in numbers alone.
    pub(crate) fn of_variant<D: Dialect>(&self, scene: &Scene<D>) -> Self {
        let mut library = Self { surface: scene.surface, take: scene.take, ..self.clone() };
        library.add(&scene.materials, &scene.pairs);
        library
    }

    /// Puts a table on top of the stack.
    pub fn add_table(&mut self, table: &MaterialTable) {
        self.add(&table.materials, &table.pairs);
    }

    fn add(&mut self, materials: &BTreeMap<String, MaterialEntry>, pairs: &[PairEntry]) {
        let table = self.tables;
        self.tables += 1;
        for (name, entry) in materials {
            let material = self.materials.entry(name.clone()).or_default();
            material.is_declared = true;
            let friction = FrictionEntry {
                static_friction: entry.static_friction,
                kinetic_friction: entry.kinetic_friction,
                note: String::new(),
            };
            replace(&mut material.friction, table, friction.is_given().then_some(friction));
            replace(&mut material.restitution, table, entry.restitution);
        }
        for entry in pairs {
            let (a, b) = &entry.between;
            for name in [a, b] {
                self.materials.entry(name.clone()).or_default();
            }
            let pair = self.pairs.entry(sorted(a, b)).or_default();
            replace(&mut pair.dry, table, entry.dry.is_given().then(|| entry.dry.clone()));
            replace(&mut pair.lubricated, table, entry.lubricated.is_given().then(|| entry.lubricated.clone()));
            replace(&mut pair.restitution, table, entry.restitution);
        }
    }

    /// Names of all materials in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.materials.keys().map(String::as_str)
    }

    /// Whether bodies may be made of it.
    pub fn knows(&self, material: &str) -> bool {
        material == DEFAULT_MATERIAL || self.materials.contains_key(material)
    }

    /// Figures of a pair, in either order of the names.
    pub fn pair(&self, a: &str, b: &str) -> ResolvedPair {
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        let mut notices = Vec::new();
        let Friction { at_rest, in_motion } = self.friction(a, b, &mut notices);
        let (static_friction, kinetic_friction) = (at_rest.value, in_motion.value);
        if kinetic_friction > static_friction {
            notices.push(MaterialNotice::KineticAboveStatic { static_friction, kinetic_friction });
        }
        let restitution = self.restitution(a, b);
        ResolvedPair {
            properties: PairProperties { static_friction, kinetic_friction, restitution: restitution.value },
            origins: PairOrigins {
                static_friction: at_rest.origin,
                kinetic_friction: in_motion.origin,
                restitution: restitution.origin,
            },
            notices,
        }
    }

    fn friction(&self, a: &str, b: &str, notices: &mut Vec<MaterialNotice>) -> Friction {
        let of_pair = self.friction_of_pair(a, b);
        let of_materials =
            [a, b].into_iter().filter_map(|name| Some(self.materials.get(name)?.friction.as_ref()?.0)).max();
        if let Some((table, friction, used)) = of_pair
            && of_materials.is_none_or(|material_table| table >= material_table)
        {
            if used != self.surface {
                notices.push(MaterialNotice::OtherSurface { used });
            }
            return self.both(friction, &Source::Pair, notices).known_for(used, self.surface);
        }
        let of_a = self.friction_of_material(a, notices);
        if a == b {
            return of_a;
        }
        let of_b = self.friction_of_material(b, notices);
        Friction {
            at_rest: Figure::combined(of_a.at_rest, of_b.at_rest),
            in_motion: Figure::combined(of_a.in_motion, of_b.in_motion),
        }
    }

    /// The listed friction of a pair, the table it is from and the surface state it is for.
    fn friction_of_pair(&self, a: &str, b: &str) -> Option<(usize, &FrictionEntry, Surface)> {
        let pair = self.pairs.get(&sorted(a, b))?;
        let dry = pair.dry.as_ref().map(|(table, friction)| (*table, friction, Surface::Dry));
        let lubricated = pair.lubricated.as_ref().map(|(table, friction)| (*table, friction, Surface::Lubricated));
        match self.surface {
            Surface::Dry => dry.or(lubricated),
            Surface::Lubricated => lubricated.or(dry),
        }
    }

    /// What a material brings into unlisted pairs.
    fn friction_of_material(&self, name: &str, notices: &mut Vec<MaterialNotice>) -> Friction {
        let own = self.materials.get(name).and_then(|material| material.friction.as_ref());
        let with_itself = self.friction_of_pair(name, name);
        match (own, with_itself) {
            (Some((table, friction)), pair) if pair.is_none_or(|(pair_table, ..)| *table > pair_table) => {
                // One coefficient of a material is documented to stand for both, so nothing is noticed.
                self.both(friction, &Source::Material(name.to_owned()), &mut Vec::new())
            }
            (_, Some((_, friction, used))) => self.both(friction, &Source::Pair, notices).known_for(used, self.surface),
            (_, None) => {
                let is_declared = self.materials.get(name).is_none_or(|material| material.is_declared);
                if !is_declared {
                    notices.push(MaterialNotice::NoFriction { material: name.to_owned() });
                }
                Friction::default()
            }
        }
    }

    /// Static and kinetic coefficient, one standing for the other where it is absent.
    fn both(&self, friction: &FrictionEntry, source: &Source, notices: &mut Vec<MaterialNotice>) -> Friction {
        let take = |coefficient: Option<Coefficient>| {
            let coefficient = coefficient?;
            let is_range = coefficient.low != coefficient.high;
            let remarks = is_range.then_some(Remark::OutOf(coefficient, self.take)).into_iter().collect();
            Some(Figure { value: coefficient.take(self.take), origin: Origin { source: source.clone(), remarks } })
        };
        match (take(friction.static_friction), take(friction.kinetic_friction)) {
            (Some(at_rest), Some(in_motion)) => Friction { at_rest, in_motion },
            (Some(at_rest), None) => {
                notices.push(MaterialNotice::OneForBoth { absent: "kinetic", value: at_rest.value });
                Friction { in_motion: at_rest.clone().remarked(Remark::Like("μ_s")), at_rest }
            }
            (None, Some(in_motion)) => {
                notices.push(MaterialNotice::OneForBoth { absent: "static", value: in_motion.value });
                Friction { at_rest: in_motion.clone().remarked(Remark::Like("μ_k")), in_motion }
            }
            (None, None) => Friction::default(),
        }
    }

    fn restitution(&self, a: &str, b: &str) -> Figure {
        let of_pair = self.pairs.get(&sorted(a, b)).and_then(|pair| pair.restitution);
        let of_material = |name| self.materials.get(name).and_then(|material: &Material| material.restitution);
        let (of_a, of_b) = (of_material(a), of_material(b));
        let table = |figure: FromTable<f64>| figure.map(|(table, _)| table);
        let figure = |value, source| Figure { value, origin: Origin { source, remarks: Vec::new() } };
        match (of_pair, of_a, of_b) {
            (Some((pair_table, restitution)), ..) if Some(pair_table) >= table(of_a).max(table(of_b)) => {
                figure(restitution, Source::Pair)
            }
            (_, Some((_, of_a)), of_b) if of_b.is_none_or(|(_, of_b)| of_a >= of_b) => {
                figure(of_a, Source::Bouncier(a.to_owned()))
            }
            (_, _, Some((_, of_b))) => figure(of_b, Source::Bouncier(b.to_owned())),
            (_, _, None) => Figure::default(),
        }
    }
}

/// A number and where it came from.
#[derive(Clone, Debug, Default)]
struct Figure {
    value: f64,
    origin: Origin,
}

/// Both coefficients of friction.
#[derive(Clone, Debug, Default)]
struct Friction {
    at_rest: Figure,
    in_motion: Figure,
}

impl Friction {
    /// Remarks that the figures are for another state of the surfaces than the one that is wanted.
    fn known_for(self, used: Surface, wanted: Surface) -> Self {
        if used == wanted {
            return self;
        }
        let remark = Remark::Surface(used);
        Self { at_rest: self.at_rest.remarked(remark), in_motion: self.in_motion.remarked(remark) }
    }
}

impl Figure {
    fn remarked(mut self, remark: Remark) -> Self {
        self.origin.remarks.push(remark);
        self
    }

    /// √(a b), exactly a where both are equal; multiplication commutes, so the order of the two changes no bit.
    fn combined(a: Self, b: Self) -> Self {
        let value = if a.value == b.value { a.value } else { (a.value * b.value).sqrt() };
        if [&a, &b].iter().any(|factor| factor.origin.source == Source::Unset) {
            return Self { value, origin: Origin::default() };
        }
        let mut remarks = a.origin.remarks;
        let of_b = b.origin.remarks.into_iter().filter(|remark| !remarks.contains(remark)).collect::<Vec<_>>();
        remarks.extend(of_b);
        Self { value, origin: Origin { source: Source::Combined(a.value, b.value), remarks } }
    }
}

impl FrictionEntry {
    /// Whether any figure is there.
    fn is_given(&self) -> bool {
        self.static_friction.is_some() || self.kinetic_friction.is_some()
    }
}

/// The lecture's table.
pub fn lecture_table() -> MaterialTable {
    crate::text::read(LECTURE_TABLE).expect("the shipped table of materials is well formed")
}

fn replace<T>(place: &mut FromTable<T>, table: usize, value: Option<T>) {
    if let Some(value) = value {
        *place = Some((table, value));
    }
}

fn sorted(a: &str, b: &str) -> (String, String) {
    if a <= b { (a.to_owned(), b.to_owned()) } else { (b.to_owned(), a.to_owned()) }
}
