use super::{CurveKind, Engine, KeypointKind, Side, SiteKind};

/// A word that names none of the values it should.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{word}` is no {thing}; known are {known}")]
pub struct UnknownName {
    /// What was asked for, such as `engine`.
    pub thing: &'static str,
    /// The word that was given.
    pub word: String,
    /// The names that exist, separated by commas.
    pub known: String,
}

/// Gives a type its names in files and commands: `Display` and `FromStr` from one table.
macro_rules! names {
    ($type:ident, $thing:literal, $($variant:ident => $name:literal),+ $(,)?) => {
        impl $type {
            /// All values, in the order of their declaration.
            pub const ALL: &[Self] = &[$(Self::$variant),+];

            /// Its name in files and commands.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),+
                }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::axis::UnknownName;

            /// Reads the name; hyphens may stand for underscores.
            fn from_str(word: &str) -> Result<Self, Self::Err> {
                let found = word.replace('-', "_");
                Self::ALL.iter().copied().find(|v| v.name() == found).ok_or_else(|| Self::Err {
                    thing: $thing,
                    word: word.to_owned(),
                    known: Self::ALL.iter().map(|v| v.name()).collect::<Vec<_>>().join(", "),
                })
            }
        }
    };
}
pub(crate) use names;

names!(
    Engine, "engine",
    PathTracing => "path_tracing", DivideAndConquer => "divide_and_conquer",
    RasterTransform => "raster_transform", RidgeFollowing => "ridge_following",
    Brushfire => "brushfire", DelaunayDual => "delaunay_dual",
);
names!(Side, "side", Interior => "interior", Exterior => "exterior");
names!(CurveKind, "curve", Line => "line", Parabola => "parabola", Polyline => "polyline");
names!(SiteKind, "kind of site", Edge => "edge", Vertex => "vertex");
names!(
    KeypointKind, "kind of keypoint",
    End => "end", Transition => "transition", Junction => "junction", Tip => "tip", Clipped => "clipped",
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for &kind in KeypointKind::ALL {
            assert_eq!(kind.to_string().parse(), Ok(kind));
        }
        assert_eq!(Engine::PathTracing.to_string(), "path_tracing");
    }

    #[test]
    fn hyphens_stand_for_underscores() {
        assert_eq!("path-tracing".parse(), Ok(Engine::PathTracing));
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let error = "edges".parse::<SiteKind>().unwrap_err();
        assert_eq!(error.to_string(), "`edges` is no kind of site; known are edge, vertex");
    }
}
