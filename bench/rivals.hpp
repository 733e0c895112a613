// What the C++ programs of the comparison share: reading shapes, and how time is taken. See
// `src/text.rs` for the text and `src/measure.rs` for the one line printed.

#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rivals {

using Ring = std::vector<std::pair<double, double>>;
using Rings = std::vector<Ring>;

// How long, in nanoseconds, and how often at most one call repeats its work; how often at least,
// and the nanoseconds after which nothing is repeated; and edges that are worked on between two
// looks at the clock.
const int64_t enough = 500000000;
const size_t repetitions = 101;
const size_t least = 3;
const int64_t too_long = 6000000000;
const size_t chunk = 10000;

// The rings of each feature on standard input.
inline std::vector<Rings> read() {
  std::vector<Rings> features;
  std::string line;
  while (std::getline(std::cin, line)) {
    if (line == "feature") {
      features.emplace_back();
    } else if (line == "ring") {
      features.back().emplace_back();
    } else if (line != "polygon") {
      char* rest;
      const double x = std::strtod(line.c_str(), &rest);
      features.back().back().emplace_back(x, std::strtod(rest, nullptr));
    }
  }
  return features;
}

inline size_t edges(const Rings& rings) {
  size_t sum = 0;
  for (const Ring& ring : rings) sum += ring.size();
  return sum;
}

// Nanoseconds of the processor time of this thread.
inline int64_t now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return int64_t(t.tv_sec) * 1000000000 + t.tv_nsec;
}

// The peak of the resident memory in bytes.
inline int64_t peak() {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
    if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::atoll(line.c_str() + 6);
  return 0;
}

inline int64_t reset_peak() {
  std::ofstream("/proc/self/clear_refs") << "5" << std::flush;
  return peak();
}

inline int64_t median(std::vector<int64_t>& times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

// Works on all features in two stages, `second(first(prepare(rings)))`, of which the last gives
// the number found; repeats that for a while and prints the line.
template <class Prepare, class First, class Second>
void report(Prepare prepare, First first, Second second) {
  const std::vector<Rings> features = read();
  std::vector<int64_t> firsts, seconds;
  size_t found = 0, sum = 0;
  int64_t growth = 0, spent = 0, cold = 0;
  for (const Rings& rings : features) sum += edges(rings);
  while (firsts.empty() || (spent < enough && firsts.size() < repetitions) ||
         (spent < too_long && firsts.size() < least)) {
    int64_t one = 0, two = 0;
    found = 0;
    for (size_t k = 0; k < features.size();) {
      std::vector<decltype(prepare(features[0]))> inputs;
      for (size_t size = 0; k < features.size() && size < chunk; ++k) {
        size += edges(features[k]);
        inputs.push_back(prepare(features[k]));
      }
      using Result = decltype(first(inputs[0]));
      std::vector<Result> results;
      const int64_t before = firsts.empty() ? reset_peak() : 0;
      const int64_t start = now();
      for (auto& input : inputs) results.push_back(first(input));
      const int64_t between = now();
      for (auto& result : results) found += second(result);
      two += now() - between;
      one += between - start;
      if (firsts.empty()) growth = std::max(growth, peak() - before);
    }
    if (firsts.empty()) cold = one + two;
    spent += one + two;
    firsts.push_back(one);
    seconds.push_back(two);
  }
  std::cout << sum << ' ' << found << ' ' << median(firsts) << ' ' << median(seconds) << ' '
            << growth << ' ' << cold << '\n';
}

}  // namespace rivals
