// Times Boost.Polygon's Voronoi diagram of segments: its construction, then the walk that drops
// what lies outside. Coordinates are rounded to whole numbers. Found: Voronoi edges inside.

#include <cmath>

#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>

#include "rivals.hpp"

using Point = boost::polygon::point_data<int32_t>;
using Segment = boost::polygon::segment_data<int32_t>;
using Diagram = boost::polygon::voronoi_diagram<double>;

static std::vector<Segment> segments(const rivals::Rings& rings) {
  std::vector<Segment> segments;
  const auto whole = [](std::pair<double, double> p) {
    return Point(int32_t(std::lround(p.first)), int32_t(std::lround(p.second)));
  };
  for (const auto& ring : rings)
    for (size_t k = 0; k < ring.size(); ++k)
      segments.emplace_back(whole(ring[k]), whole(ring[(k + 1) % ring.size()]));
  return segments;
}

static std::unique_ptr<Diagram> construct(const std::vector<Segment>& segments) {
  auto diagram = std::make_unique<Diagram>();
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), diagram.get());
  return diagram;
}

// As in Boost's own example: what primary edges connect with infinity lies outside.
static size_t interior_edges(const std::unique_ptr<Diagram>& diagram) {
  const size_t outside = 1;
  std::vector<const Diagram::edge_type*> stack;
  auto reach = [&](const Diagram::edge_type* edge) {
    if (edge->color() == outside) return;
    edge->color(outside);
    edge->twin()->color(outside);
    stack.push_back(edge);
  };
  for (const auto& edge : diagram->edges())
    if (!edge.is_finite()) reach(&edge);
  while (!stack.empty()) {
    const auto* edge = stack.back();
    stack.pop_back();
    if (!edge->is_primary()) continue;
    for (const auto* vertex : {edge->vertex0(), edge->vertex1()}) {
      if (!vertex || vertex->color() == outside) continue;
      vertex->color(outside);
      const auto* around = vertex->incident_edge();
      do {
        reach(around);
        around = around->rot_next();
      } while (around != vertex->incident_edge());
    }
  }
  size_t count = 0;
  for (const auto& edge : diagram->edges()) count += edge.is_primary() && edge.color() != outside;
  return count / 2;
}

int main() { rivals::report(segments, construct, interior_edges); }
