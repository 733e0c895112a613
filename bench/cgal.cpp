// Times CGAL's segment Delaunay graph: the insertion of the segments, then the walk that drops
// what lies outside. Found: Voronoi edges inside.
//
// CGAL's package is under the GPL. This program is built for the benchmark only, from CGAL's
// headers as installed; nothing of medial is linked with it, and no build of medial contains it.

#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Simple_cartesian.h>

#include "rivals.hpp"

// Exact predicates, filtered by intervals; positions in doubles; segments meet at ends only.
using Kernel = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<
    Kernel, CGAL::Field_with_sqrt_tag>;
using Graph = CGAL::Segment_Delaunay_graph_2<Traits>;

struct Input {
  std::vector<Kernel::Point_2> points;
  std::vector<std::pair<size_t, size_t>> segments;
};

static Input segments(const rivals::Rings& rings) {
  Input input;
  for (const auto& ring : rings) {
    const size_t first = input.points.size();
    for (size_t k = 0; k < ring.size(); ++k) {
      input.points.emplace_back(ring[k].first, ring[k].second);
      input.segments.emplace_back(first + k, first + (k + 1) % ring.size());
    }
  }
  return input;
}

// Sorts the points along a curve in space before it inserts, as CGAL advises.
static std::unique_ptr<Graph> construct(const Input& input) {
  auto graph = std::make_unique<Graph>();
  graph->insert_segments(input.points, input.segments.begin(), input.segments.end());
  return graph;
}

// Whether a Voronoi edge separates a segment and its own end, and so ends at the boundary.
static bool secondary(const Graph::Edge& edge) {
  auto p = edge.first->vertex(Graph::ccw(edge.second))->site();
  auto q = edge.first->vertex(Graph::cw(edge.second))->site();
  if (p.is_segment()) std::swap(p, q);
  if (p.is_segment() || q.is_point()) return false;
  return p.point() == q.source() || p.point() == q.target();
}

// What primary edges connect with infinity lies outside; faces of the graph are Voronoi vertices.
static size_t interior_edges(const std::unique_ptr<Graph>& graph) {
  CGAL::Unique_hash_map<Graph::Face_handle, char> outside(0);
  std::vector<Graph::Face_handle> stack;
  auto reach = [&](Graph::Face_handle face) {
    if (outside[face]) return;
    outside[face] = 1;
    stack.push_back(face);
  };
  auto circulator = graph->incident_faces(graph->infinite_vertex());
  const auto start = circulator;
  do reach(circulator);
  while (++circulator != start);
  while (!stack.empty()) {
    const auto face = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Graph::Edge edge(face, k);
      if (graph->is_infinite(edge) || !secondary(edge)) reach(face->neighbor(k));
    }
  }
  size_t count = 0;
  for (auto edge = graph->finite_edges_begin(); edge != graph->finite_edges_end(); ++edge) {
    const auto face = edge->first;
    if (!outside[face] && !outside[face->neighbor(edge->second)]) count += !secondary(*edge);
  }
  return count;
}

int main() { rivals::report(segments, construct, interior_edges); }
