// The sets that the kernel and CGAL are compared on; the same in every run.
#pragma once

#include <cstddef>
#include <vector>

namespace radvor::bench {

using Points = std::vector<double>;  // x, y, x, y ...

Points uniform(std::size_t count, unsigned seed);
/// side x side integer points, each moved by up to jitter_least ... jitter_most, shuffled.
Points grid(std::size_t side, double jitter_least, double jitter_most);
Points circle(std::size_t count);
/// A thousand points each, of sizes from 1e-8 to 1e-2.
Points clusters(std::size_t count);
Points line(std::size_t count, bool exact);

// The first 2 k points are the ends of k segments that do not cross.
Points with_short_segments(std::size_t count, std::size_t side);
Points with_long_segments(std::size_t count, std::size_t segments);

}  // namespace radvor::bench
