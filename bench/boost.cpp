// Times Boost.Polygon's Voronoi diagram of segments on rings of whole numbers, read from standard
// input: one `x y` a line, an empty line after each ring. Prints the number of segments and of
// primary edges that no infinite edge reaches, and the median time, in nanoseconds of the thread's
// processor time, of construction and of finding those edges.

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>

using Point = boost::polygon::point_data<int32_t>;
using Segment = boost::polygon::segment_data<int32_t>;
using Diagram = boost::polygon::voronoi_diagram<double>;

// Segments that one call goes through, if need be several times.
const size_t work = 200000;

static int64_t now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return int64_t(t.tv_sec) * 1000000000 + t.tv_nsec;
}

static std::vector<Segment> read_segments() {
  std::vector<Segment> segments;
  std::vector<Point> ring;
  auto close = [&] {
    for (size_t k = 0; k < ring.size(); ++k)
      segments.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
    ring.clear();
  };
  std::string line;
  while (std::getline(std::cin, line)) {
    if (line.empty()) {
      close();
      continue;
    }
    const size_t gap = line.find(' ');
    ring.emplace_back(std::stoi(line.substr(0, gap)), std::stoi(line.substr(gap + 1)));
  }
  close();
  return segments;
}

// As in Boost's own example: what primary edges connect with infinity lies outside.
static size_t interior_edges(const Diagram& diagram) {
  const size_t outside = 1;
  std::vector<const Diagram::edge_type*> stack;
  auto reach = [&](const Diagram::edge_type* edge) {
    if (edge->color() == outside) return;
    edge->color(outside);
    edge->twin()->color(outside);
    stack.push_back(edge);
  };
  for (const auto& edge : diagram.edges())
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
  for (const auto& edge : diagram.edges()) count += edge.is_primary() && edge.color() != outside;
  return count / 2;
}

static int64_t median(std::vector<int64_t>& times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

int main() {
  const std::vector<Segment> segments = read_segments();
  const size_t rounds = std::clamp<size_t>(work / std::max<size_t>(segments.size(), 1), 1, 101);
  std::vector<int64_t> construction, walk;
  size_t edges = 0;
  for (size_t k = 0; k < rounds; ++k) {
    Diagram diagram;
    const int64_t start = now();
    boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
    const int64_t built = now();
    edges = interior_edges(diagram);
    construction.push_back(built - start);
    walk.push_back(now() - built);
  }
  std::cout << segments.size() << ' ' << edges << ' ' << median(construction) << ' '
            << median(walk) << '\n';
}
