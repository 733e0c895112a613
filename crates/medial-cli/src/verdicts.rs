use medial::axis::Side;
use medial::check::{Counts, Identity, Relation, defects};
use medial::domain::Domain;
use medial::geom::Point;
use medial_io::axis_document::AxisDocument;
use medial_io::{Feature, Json};
use serde::Serialize;
use std::fmt::Write as _;

/// The document of one axis, or what makes no sense in it.
pub type Document = Result<AxisDocument, String>;

/// What was found about the axis of one feature.
#[derive(Serialize)]
pub struct Judged {
    /// Number of the feature in the input.
    pub feature: usize,
    id: Option<Json>,
    /// The side of the axis, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    /// Everything that is wrong.
    pub defects: Vec<Fault>,
    #[serde(skip_serializing_if = "Option::is_none")]
    counts: Option<Counted>,
    identities: Vec<Balance>,
    /// Checks that do not apply to the axis.
    left_out: Vec<String>,
}

/// One thing that is wrong, and where to look.
#[derive(Serialize)]
pub struct Fault {
    defect: String,
    at: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct Counted {
    edges: usize,
    convex: usize,
    reflex: usize,
    straight: usize,
    walks: usize,
    components: usize,
    sites: usize,
    ends: usize,
    transitions: usize,
    junctions: usize,
    tips: usize,
    clipped: usize,
    paths: usize,
    leaves: usize,
    axis_components: usize,
    cycles: usize,
}

/// A number the domain fixes or bounds, and the one the axis has.
#[derive(Serialize)]
struct Balance {
    name: &'static str,
    relation: &'static str,
    expected: f64,
    found: f64,
    holds: bool,
}

impl Judged {
    /// The verdicts on the axes of a feature, which must have exactly one document, or one for each
    /// side.
    pub fn all(feature: &Feature, domain: &Domain, documents: &[Document]) -> Vec<Self> {
        let judged = || Self::empty(feature.index, feature.id.clone());
        if documents.is_empty() {
            return vec![judged().fault("the document has no axis of this feature")];
        }
        let axes = || documents.iter().flatten().map(|document| document.axis.side);
        if Side::ALL.iter().any(|&side| axes().filter(|&s| s == side).count() > 1) {
            return vec![
                judged().fault("the document has several axes of one side of this feature"),
            ];
        }
        let verdict = |document: &Document| match document {
            Ok(document) => judged().verdict(domain, document),
            Err(why) => judged().fault(why),
        };
        documents.iter().map(verdict).collect()
    }

    /// An axis of a feature that is no valid domain, or of none.
    pub fn without_domain(feature: usize) -> Self {
        Self::empty(feature, None).fault("there is an axis, but no valid domain of this number")
    }

    fn empty(feature: usize, id: Option<Json>) -> Self {
        Self {
            feature,
            id,
            side: None,
            defects: Vec::new(),
            counts: None,
            identities: Vec::new(),
            left_out: Vec::new(),
        }
    }

    fn fault(mut self, defect: &str) -> Self {
        self.defects.push(Fault { defect: defect.to_owned(), at: None });
        self
    }

    fn verdict(mut self, domain: &Domain, document: &AxisDocument) -> Self {
        let verdict = defects(domain, &document.axis);
        self.side = Some(document.axis.side.name());
        self.defects.extend(verdict.defects.iter().map(|defect| Fault {
            defect: defect.to_string(),
            at: defect.at().map(|Point { x, y }| [x, y]),
        }));
        self.counts = Some(counted(verdict.counts));
        self.identities = verdict.identities.iter().map(balance).collect();
        self.left_out = verdict.left_out.iter().map(ToString::to_string).collect();
        self
    }

    /// One line of JSON.
    pub fn json(&self) -> String {
        let mut line = serde_json::to_string(self).unwrap_or_default();
        line.push('\n');
        line
    }

    /// A few lines for people: defects first, then counts and identities.
    pub fn text(&self) -> String {
        let mut out = format!("feature {}", self.feature);
        if let Some(id) = &self.id {
            let _ = write!(out, " (id {id})");
        }
        // Of an axis inside nothing need be said.
        if let Some(side) = self.side.filter(|side| *side != Side::Interior.name()) {
            let _ = write!(out, ", {side}");
        }
        let _ = match self.defects.len() {
            0 => writeln!(out, ": no defect"),
            1 => writeln!(out, ": 1 defect"),
            n => writeln!(out, ": {n} defects"),
        };
        for fault in &self.defects {
            let _ = writeln!(out, "  defect: {}", fault.defect);
        }
        if let Some(c) = &self.counts {
            let _ = writeln!(
                out,
                "  domain: {} edges, {} convex and {} reflex corners, {} walks, {} components",
                c.edges, c.convex, c.reflex, c.walks, c.components,
            );
            let _ = writeln!(
                out,
                "  axis: {} sites, {} ends, {} transitions, {} junctions, {} paths, {} cycles",
                c.sites, c.ends, c.transitions, c.junctions, c.paths, c.cycles,
            );
            if c.tips > 0 {
                let _ = writeln!(out, "  tips where it was cut or pruned: {}", c.tips);
            }
            if c.clipped > 0 {
                let _ = writeln!(out, "  paths to infinity: {}", c.clipped);
            }
        }
        for Balance { name, relation, expected, found, holds } in &self.identities {
            let sign = if *holds { "holds" } else { "broken" };
            let _ = writeln!(out, "  {sign}: {name}: {found}, {relation} {expected}");
        }
        for check in &self.left_out {
            let _ = writeln!(out, "  left out: {check}");
        }
        out
    }
}

fn counted(counts: Counts) -> Counted {
    let Counts {
        edges,
        convex,
        reflex,
        straight,
        walks,
        components,
        sites,
        ends,
        transitions,
        junctions,
        tips,
        clipped,
        paths,
        leaves,
        axis_components,
        cycles,
        ..
    } = counts;
    Counted {
        edges,
        convex,
        reflex,
        straight,
        walks,
        components,
        sites,
        ends,
        transitions,
        junctions,
        tips,
        clipped,
        paths,
        leaves,
        axis_components,
        cycles,
    }
}

fn balance(identity: &Identity) -> Balance {
    let relation = match identity.relation {
        Relation::Equal => "expected",
        Relation::AtMost => "at most",
        Relation::Within(_) => "up to rounding",
    };
    let Identity { name, expected, found, .. } = *identity;
    Balance { name, relation, expected, found, holds: identity.holds() }
}
