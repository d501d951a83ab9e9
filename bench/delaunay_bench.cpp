// The kernel against CGAL in one run: the same points, both with the flags of the release build, ours through the C
// ABI. Rounds alternate between the two; a figure is the median of its rounds. Prints ns a point (or query) and the
// ratios, and writes them as JSON.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_hierarchy_2.h>
#include <CGAL/natural_neighbor_coordinates_2.h>
#include <CGAL/spatial_sort.h>
#include <radvor.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/measure.h"
#include "delaunay/points.h"

using namespace radvor::bench;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Plain = CGAL::Delaunay_triangulation_2<Kernel>;
using HierarchyVertex = CGAL::Triangulation_hierarchy_vertex_base_2<CGAL::Triangulation_vertex_base_2<Kernel>>;
using Hierarchy = CGAL::Triangulation_hierarchy_2<CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<HierarchyVertex, CGAL::Triangulation_face_base_2<Kernel>>>>;
using ConstrainedData = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                                             CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Constrained =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, ConstrainedData, CGAL::No_constraint_intersection_tag>;

// ---- Our side

struct Memory {
  std::size_t live = 0, peak = 0;
  static void* acquire(void* user, std::size_t bytes, std::size_t alignment) {
    auto& memory = *static_cast<Memory*>(user);
    memory.live += bytes;
    memory.peak = std::max(memory.peak, memory.live);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  static void release(void* user, void* pointer, std::size_t bytes, std::size_t) {
    static_cast<Memory*>(user)->live -= bytes;
    std::free(pointer);
  }
};

radvor_context* g_context = nullptr;

void must(radvor_result result) {
  if (result < 0) {
    std::fprintf(stderr, "%s: %s\n", radvor_result_string(result), radvor_context_error(g_context));
    std::exit(1);
  }
}

class Ours {
 public:
  Ours() { must(radvor_delaunay_create(g_context, &handle_)); }
  ~Ours() { radvor_delaunay_destroy(handle_); }
  Ours(const Ours&) = delete;
  Ours& operator=(const Ours&) = delete;
  operator radvor_delaunay*() const { return handle_; }

 private:
  radvor_delaunay* handle_ = nullptr;
};

std::vector<Point> as_cgal(const Points& xy) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    points.emplace_back(xy[i], xy[i + 1]);
  }
  return points;
}

Points as_ours(const std::vector<Point>& points) {
  Points xy;
  for (const Point& p : points) {
    xy.push_back(p.x());
    xy.push_back(p.y());
  }
  return xy;
}

void bulk(const char* name, double target, const Points& xy) {
  if (!wanted(name)) {
    return;
  }
  const std::vector<Point> points = as_cgal(xy);
  compare(
      name, target, points.size(),
      [&] {
        Ours d;
        return seconds_of(
            [&] { must(radvor_delaunay_insert_many(d, xy.data(), static_cast<uint32_t>(xy.size() / 2), nullptr)); });
      },
      [&] {
        Plain d;
        return seconds_of([&] { d.insert(points.begin(), points.end()); });
      });
}

void online_coherent(const char* name, double target, std::size_t count) {
  if (!wanted(name)) {
    return;
  }
  std::vector<Point> points = as_cgal(uniform(count, 11));
  CGAL::spatial_sort(points.begin(), points.end());
  const Points xy = as_ours(points);
  compare(
      name, target, count,
      [&] {
        Ours d;
        return seconds_of([&] {
          uint32_t hint = RADVOR_NONE;
          for (std::size_t i = 0; i < count; ++i) {
            must(radvor_delaunay_insert_near(d, xy[2 * i], xy[2 * i + 1], &hint));
          }
        });
      },
      [&] {
        Plain d;
        return seconds_of([&] {
          Plain::Face_handle hint;
          for (const Point& p : points) {
            hint = d.insert(p, hint)->face();
          }
        });
      });
}

void online_random(const char* name, double target, std::size_t count) {
  if (!wanted(name)) {
    return;
  }
  const Points xy = uniform(count, 12);
  const std::vector<Point> points = as_cgal(xy);
  compare(
      name, target, count,
      [&] {
        Ours d;
        return seconds_of([&] {
          for (std::size_t i = 0; i < count; ++i) {
            uint32_t v;
            must(radvor_delaunay_insert(d, xy[2 * i], xy[2 * i + 1], &v));
          }
        });
      },
      [&] {
        Hierarchy d;
        return seconds_of([&] {
          for (const Point& p : points) {
            d.insert(p);
          }
        });
      });
}

void removal(const char* name, double target, std::size_t count) {
  if (!wanted(name)) {
    return;
  }
  const Points xy = uniform(count, 13);
  const std::vector<Point> points = as_cgal(xy);
  std::vector<uint32_t> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    order[i] = static_cast<uint32_t>(i);
  }
  std::shuffle(order.begin(), order.end(), std::mt19937(14));
  order.resize(count / 2);
  compare(
      name, target, order.size(),
      [&] {
        Ours d;
        must(radvor_delaunay_insert_many(d, xy.data(), static_cast<uint32_t>(count), nullptr));
        return seconds_of([&] {
          for (const uint32_t v : order) {
            must(radvor_delaunay_remove(d, v));
          }
        });
      },
      [&] {
        Plain d;
        std::vector<std::pair<Point, std::size_t>> sorted;
        std::vector<Plain::Vertex_handle> handles(count);
        std::vector<std::size_t> indices(count);
        for (std::size_t i = 0; i < count; ++i) {
          indices[i] = i;
        }
        std::sort(indices.begin(), indices.end(), [&](std::size_t i, std::size_t j) {
          return std::pair(std::floor(points[i].x() * 300), points[i].y()) <
                 std::pair(std::floor(points[j].x() * 300), points[j].y());
        });
        Plain::Face_handle hint;
        for (const std::size_t i : indices) {
          handles[i] = d.insert(points[i], hint);
          hint = handles[i]->face();
        }
        return seconds_of([&] {
          for (const uint32_t v : order) {
            d.remove(handles[v]);
          }
        });
      });
}

void natural_neighbours(const char* name, double target, std::size_t count) {
  if (!wanted(name)) {
    return;
  }
  const Points xy = uniform(count, 15);
  const std::vector<Point> points = as_cgal(xy);
  std::vector<Point> queries;
  for (const Point& p : as_cgal(uniform(count, 16))) {
    queries.emplace_back(0.05 + 0.9 * p.x(), 0.05 + 0.9 * p.y());
  }
  CGAL::spatial_sort(queries.begin(), queries.end());
  Ours d;
  must(radvor_delaunay_insert_many(d, xy.data(), static_cast<uint32_t>(count), nullptr));
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(3 * xy[2 * i] - xy[2 * i + 1]);
  }
  must(radvor_delaunay_set_values(d, values.data(), 0, static_cast<uint32_t>(count)));
  Plain cgal(points.begin(), points.end());
  double ours_sum = 0, cgal_sum = 0;
  compare(
      name, target, queries.size(),
      [&] {
        ours_sum = 0;
        return seconds_of([&] {
          uint32_t hint = RADVOR_NONE;
          for (const Point& q : queries) {
            double value;
            must(radvor_delaunay_interpolate(d, RADVOR_NATURAL_NEIGHBOUR, q.x(), q.y(), &hint, &value));
            ours_sum += value;
          }
        });
      },
      [&] {
        cgal_sum = 0;
        return seconds_of([&] {
          std::vector<std::pair<Point, double>> coordinates;
          Plain::Face_handle hint;
          for (const Point& q : queries) {
            coordinates.clear();
            hint = cgal.locate(q, hint);
            const auto result = CGAL::natural_neighbor_coordinates_2(cgal, q, std::back_inserter(coordinates), hint);
            double sum = 0;
            for (const auto& [p, weight] : coordinates) {
              sum += weight * (3 * p.x() - p.y());
            }
            cgal_sum += sum / result.second;
          }
        });
      });
  if (std::fabs(ours_sum - cgal_sum) > 1e-6 * std::fabs(cgal_sum)) {
    std::printf("natural neighbours disagree: %.17g and %.17g\n", ours_sum, cgal_sum);
    std::exit(1);
  }
}

void location(const char* name, double target, std::size_t count) {
  if (!wanted(name)) {
    return;
  }
  const Points xy = uniform(count, 17);
  const Points queries = uniform(200000, 18);
  const std::vector<Point> points = as_cgal(xy), cgal_queries = as_cgal(queries);
  Ours d;
  must(radvor_delaunay_insert_many(d, xy.data(), static_cast<uint32_t>(count), nullptr));
  Hierarchy cgal(points.begin(), points.end());
  compare(
      name, target, cgal_queries.size(),
      [&] {
        return seconds_of([&] {
          for (std::size_t i = 0; i < queries.size(); i += 2) {
            uint32_t where, vertices[3];
            must(radvor_delaunay_locate(d, queries[i], queries[i + 1], nullptr, &where, vertices));
          }
        });
      },
      [&] {
        return seconds_of([&] {
          for (const Point& q : cgal_queries) {
            volatile bool infinite = cgal.is_infinite(cgal.locate(q));
            (void)infinite;
          }
        });
      });
}

// The first 2 k points are the ends of k constraints.
void constrained(const char* name, double target, const Points& xy, std::size_t constraints) {
  if (!wanted(name)) {
    return;
  }
  const std::vector<Point> points = as_cgal(xy);
  compare(
      name, target, points.size(),
      [&] {
        Ours d;
        return seconds_of([&] {
          must(radvor_delaunay_insert_many(d, xy.data(), static_cast<uint32_t>(points.size()), nullptr));
          for (uint32_t i = 0; i < constraints; ++i) {
            must(radvor_delaunay_constrain(d, 2 * i, 2 * i + 1));
          }
        });
      },
      [&] {
        Constrained d;
        return seconds_of([&] {
          d.insert(points.begin(), points.end());
          std::vector<Constrained::Vertex_handle> ends;
          Constrained::Face_handle hint;
          for (std::size_t i = 0; i < 2 * constraints; ++i) {
            ends.push_back(d.insert(points[i], hint));
            hint = ends.back()->face();
          }
          for (std::size_t i = 0; i < constraints; ++i) {
            d.insert_constraint(ends[2 * i], ends[2 * i + 1]);
          }
        });
      });
}

}  // namespace

int main(int count, char** arguments) {
  const char* out = nullptr;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument.starts_with("--benchmark_out=")) {
      out = arguments[i] + std::strlen("--benchmark_out=");
    } else if (argument.starts_with("--rounds=")) {
      g_choice.rounds = std::atoi(arguments[i] + std::strlen("--rounds="));
    } else if (argument.starts_with("--filter=")) {
      g_choice.filter = argument.substr(std::strlen("--filter="));
    }
  }
  radvor_context_desc desc{};  // the library's own memory, as whoever sets nothing has it
  desc.struct_size = sizeof desc;
  desc.thread_count = 1;
  must(radvor_context_create(&desc, &g_context));

  std::printf("%-44s %9s %9s   %5s\n", "", "ours/ns", "CGAL/ns", "ratio");
  const Points million = uniform(1000000, 1);
  bulk("bulk, 10^6 uniform", 0.70, million);
  bulk("bulk, 1000 x 1000 grid, shuffled", 0.75, grid(1000, 0, 0));
  bulk("bulk, 10^4 on a circle, rounded", 1.0, circle(10000));
  bulk("bulk, 2*10^5 grid, jitter 1e-15..1e-12", 0.75, grid(447, 1e-15, 1e-12));
  bulk("bulk, 2*10^5 in clusters 1e-8..1e-2", 0.75, clusters(200000));
  bulk("bulk, 2*10^4 nearly collinear", 1.0, line(20000, false));
  bulk("bulk, 2*10^4 exactly collinear", 1.0, line(20000, true));
  online_coherent("online, 10^5 coherent, hint", 0.90, 100000);
  online_random("online, 10^5 random, hierarchy", 0.50, 100000);
  online_random("online, 10^6 random, hierarchy", 0.50, 1000000);
  removal("removal, half of 10^5", 0.90, 100000);
  natural_neighbours("natural neighbours, 10^5, coherent", 0.80, 100000);
  location("location, 10^6, random, hierarchy", 0.50, 1000000);
  constrained("10^5 with 10^4 short constraints", 0.85, with_short_segments(100000, 100), 10000);
  constrained("10^5 with 300 long constraints", 1.0, with_long_segments(100000, 300), 300);

  double bytes = 0;
  if (wanted("memory, 10^6 uniform")) {
    Memory memory;
    desc.user = &memory;
    desc.acquire = Memory::acquire;
    desc.release = Memory::release;
    radvor_context_destroy(g_context);
    must(radvor_context_create(&desc, &g_context));
    const std::size_t before = memory.peak = memory.live;
    {
      const Ours d;
      must(radvor_delaunay_insert_many(d, million.data(), 1000000, nullptr));
    }
    bytes = static_cast<double>(memory.peak - before) / 1e6;
    std::printf("%-44s %9.1f bytes a point at peak (at most 110)\n", "memory, 10^6 uniform", bytes);
    radvor_context_destroy(g_context);
    g_context = nullptr;
  }
  if (out) {
    write_json(out, bytes);
  }
  if (g_context != nullptr) {
    radvor_context_destroy(g_context);
  }
  return 0;
}
