//! Colours and strokes: one look for all figures.

/// Boundaries and words.
pub const INK: &str = "#263238";
/// Quiet words.
pub const MUTED: &str = "#607d8b";
/// Edges that govern.
pub const BLUE: &str = "#1976d2";
/// Corners that govern.
pub const ORANGE: &str = "#d84315";
/// Maximal disks.
pub const TEAL: &str = "#00897b";
/// The axis.
pub const PURPLE: &str = "#8e24aa";
/// What does not hold.
pub const RED: &str = "#c62828";

/// A rim around words, so that lines do not run through them.
pub const HALO: &str =
    "stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";

pub const DOMAIN: &str = "fill=\"#eef2f5\" fill-rule=\"evenodd\" stroke=\"#263238\" \
                          stroke-width=\"1.6\" stroke-linejoin=\"round\"";
pub const AXIS: &str =
    "fill=\"none\" stroke=\"#8e24aa\" stroke-width=\"2.4\" stroke-linecap=\"round\"";
/// A path that a figure is about.
pub const PATH: &str =
    "fill=\"none\" stroke=\"#8e24aa\" stroke-width=\"4\" stroke-linecap=\"round\"";
/// A path not traced yet, or a bisector beyond its path.
pub const FAINT: &str = "fill=\"none\" stroke=\"#8e24aa\" stroke-opacity=\"0.35\" \
                         stroke-width=\"1.6\" stroke-dasharray=\"5 4\" stroke-linecap=\"round\"";
pub const DISK: &str = "fill=\"#26a69a\" fill-opacity=\"0.10\" stroke=\"#00897b\" \
                        stroke-width=\"1.5\"";
/// A candidate that does not hold.
pub const REJECTED: &str = "fill=\"#e53935\" fill-opacity=\"0.05\" stroke=\"#c62828\" \
                            stroke-width=\"1.5\" stroke-dasharray=\"6 4\"";
pub const SPOKE: &str = "fill=\"none\" stroke=\"#00897b\" stroke-width=\"1\"";
/// The front half-line of a site.
pub const FRONT: &str = "fill=\"none\" stroke=\"#ef6c00\" stroke-width=\"1.6\" \
                         stroke-dasharray=\"7 4\"";
/// The back half-line of a site.
pub const BACK: &str = "fill=\"none\" stroke=\"#3949ab\" stroke-width=\"1.6\" \
                        stroke-dasharray=\"2 3\"";
/// A normal at a reflex corner.
pub const NORMAL: &str = "fill=\"none\" stroke=\"#455a64\" stroke-width=\"1.4\" \
                          stroke-dasharray=\"6 4\" stroke-linecap=\"round\"";
/// A supporting line.
pub const SUPPORT: &str = "fill=\"none\" stroke=\"#90a4ae\" stroke-width=\"1.2\" \
                           stroke-dasharray=\"4 4\"";
pub const EDGE_REGION: &str = "fill=\"#1976d2\" fill-opacity=\"0.10\"";
pub const EDGE_CELL: &str = "fill=\"#1976d2\" fill-opacity=\"0.25\"";
pub const CORNER_REGION: &str = "fill=\"#d84315\" fill-opacity=\"0.10\"";
pub const CORNER_CELL: &str = "fill=\"#d84315\" fill-opacity=\"0.25\"";
/// The colour of front half-lines.
pub const FRONT_INK: &str = "#ef6c00";
/// The colour of back half-lines.
pub const BACK_INK: &str = "#3949ab";
/// A disk farther on than the path goes.
pub const GHOST: &str = "fill=\"none\" stroke=\"#00897b\" stroke-opacity=\"0.5\" \
                         stroke-width=\"1.2\" stroke-dasharray=\"3 4\"";
/// Water.
pub const SHORE: &str = "fill=\"#dbeaf4\" fill-rule=\"evenodd\" stroke=\"#5d7f92\" \
                         stroke-width=\"0.9\" stroke-linejoin=\"round\"";
/// An axis with very many paths.
pub const FINE: &str =
    "fill=\"none\" stroke=\"#8e24aa\" stroke-width=\"1.3\" stroke-linecap=\"round\"";
/// Boundary that takes no part.
pub const REST: &str =
    "fill=\"#f4f6f8\" stroke=\"#b0bec5\" stroke-width=\"1.3\" stroke-linejoin=\"round\"";
/// Boundary of a list of elements.
pub const LIST: &str =
    "fill=\"none\" stroke=\"#263238\" stroke-width=\"2.6\" stroke-linecap=\"round\"";
pub const FIRST_LIST: &str =
    "fill=\"none\" stroke=\"#1565c0\" stroke-width=\"2.6\" stroke-linecap=\"round\"";
pub const SECOND_LIST: &str =
    "fill=\"none\" stroke=\"#d84315\" stroke-width=\"2.6\" stroke-linecap=\"round\"";
/// The diagram of the first of two lists, and what is discarded of it.
pub const FIRST: &str = "fill=\"none\" stroke=\"#1565c0\" stroke-width=\"2.2\" \
                         stroke-dasharray=\"0.1 4.6\" stroke-linecap=\"round\"";
pub const FIRST_LOST: &str = "fill=\"none\" stroke=\"#1565c0\" stroke-opacity=\"0.38\" \
                              stroke-width=\"1.7\" stroke-dasharray=\"0.1 4.6\" \
                              stroke-linecap=\"round\"";
/// The diagram of the second of two lists, and what is discarded of it.
pub const SECOND: &str = "fill=\"none\" stroke=\"#d84315\" stroke-width=\"1.7\" \
                          stroke-dasharray=\"7 4\"";
pub const SECOND_LOST: &str = "fill=\"none\" stroke=\"#d84315\" stroke-opacity=\"0.38\" \
                               stroke-width=\"1.3\" stroke-dasharray=\"7 4\"";
/// What lies on the other side of a list.
pub const BEHIND: &str = "fill=\"none\" stroke=\"#607d8b\" stroke-width=\"1\"";
/// Pixels of a shape.
pub const CELL: &str = "fill=\"#cfd8dc\"";
/// Medial ones.
pub const MEDIAL: &str = "fill=\"#8e24aa\"";
/// Those that are lost.
pub const LOST: &str = "fill=\"#ef6c00\"";
