//! Places inside a scene, such as `bodies[3].parts[0].density`.

use std::fmt;

/// A place inside a scene. It can be looked up in the text the scene came from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ScenePath(Vec<Segment>);

/// One step down into a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Segment {
    /// A field of a struct.
    Field(String),
    /// An element of a list or tuple, counted from 0.
    Index(usize),
    /// The value of a key of a map.
    Key(String),
}

impl ScenePath {
    /// The scene itself.
    pub fn root() -> Self {
        Self::default()
    }

    /// A field of this place.
    pub fn field(&self, name: &str) -> Self {
        self.down(Segment::Field(name.to_owned()))
    }

    /// An element of this list, counted from 0.
    pub fn index(&self, index: usize) -> Self {
        self.down(Segment::Index(index))
    }

    /// The value of a key of this map.
    pub fn key(&self, key: &str) -> Self {
        self.down(Segment::Key(key.to_owned()))
    }

    /// The same place in another element of the list at the top.
    pub(crate) fn with_element(&self, index: usize) -> Self {
        let mut segments = self.0.clone();
        if let Some(element) = segments.get_mut(1) {
            *element = Segment::Index(index);
        }
        Self(segments)
    }

    pub(crate) fn segments(&self) -> &[Segment] {
        &self.0
    }

    fn down(&self, segment: Segment) -> Self {
        let mut segments = self.0.clone();
        segments.push(segment);
        Self(segments)
    }
}

impl fmt::Display for ScenePath {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        for (position, segment) in self.0.iter().enumerate() {
            match segment {
                Segment::Field(name) if position == 0 => write!(formatter, "{name}")?,
                Segment::Field(name) => write!(formatter, ".{name}")?,
                Segment::Index(index) => write!(formatter, "[{index}]")?,
                Segment::Key(key) => write!(formatter, "[{key:?}]")?,
            }
        }
        Ok(())
    }
}
