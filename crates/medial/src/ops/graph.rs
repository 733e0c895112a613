//! An axis as a graph of the crate `petgraph`.

use petgraph::graph::UnGraph;

use crate::axis::{Keypoint, MedialAxis, Path};

/// An edge of the graph of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The path; its ends are the nodes of the edge.
    pub path: Path,
    /// Its length, in units of the input.
    pub length: f64,
    /// The least radius along it.
    pub radius_min: f64,
    /// The greatest radius along it.
    pub radius_max: f64,
}

impl MedialAxis {
    /// The graph of keypoints and paths; nodes and edges have their numbers. The feature `petgraph` has it.
    ///
    /// ```
    /// use medial::domain::{Domain, Options};
    /// use medial::engine::path_tracing;
    /// use medial::geom::Point;
    /// use petgraph::algo::{connected_components, dijkstra};
    ///
    /// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
    /// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
    /// let graph = path_tracing(&domain)?.to_petgraph();
    /// assert_eq!((graph.node_count(), graph.edge_count(), connected_components(&graph)), (6, 5, 1));
    /// let corner = graph.node_indices().find(|&k| graph[k].radius == 0.0).unwrap();
    /// let ways = dijkstra(&graph, corner, None, |edge| edge.weight().length);
    /// let longest = ways.into_values().fold(0.0, f64::max);
    /// assert!((longest - (4.0 + 2.0 * 2.0_f64.sqrt())).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn to_petgraph(&self) -> UnGraph<Keypoint, Link> {
        let mut graph = UnGraph::with_capacity(self.keypoints().len(), self.paths().len());
        let nodes: Vec<_> =
            self.keypoints().iter().map(|keypoint| graph.add_node(keypoint)).collect();
        for path in self.paths() {
            let curve = self.curve(&path);
            let link = Link {
                path,
                length: curve.length(),
                radius_min: curve.radius_min(),
                radius_max: curve.radius_max(),
            };
            graph.add_edge(nodes[path.from as usize], nodes[path.to as usize], link);
        }
        graph
    }
}
