// A triangulation of the C ABI in the words of C++, for tests.
#pragma once

#include <gtest/gtest.h>
#include <radvor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "api/engine.h"

namespace radvor::test {

using Ids = std::vector<std::uint32_t>;

class Delaunay {
 public:
  explicit Delaunay(const Engine& engine) { EXPECT_EQ(radvor_delaunay_create(engine.context(), &handle_), RADVOR_OK); }
  ~Delaunay() { radvor_delaunay_destroy(handle_); }
  Delaunay(const Delaunay&) = delete;
  Delaunay& operator=(const Delaunay&) = delete;
  operator radvor_delaunay*() const { return handle_; }

  std::uint32_t insert(double x, double y) const {
    std::uint32_t vertex = RADVOR_NONE;
    EXPECT_EQ(radvor_delaunay_insert(handle_, x, y, &vertex), RADVOR_OK);
    return vertex;
  }
  void constrain(std::uint32_t a, std::uint32_t b, std::uint32_t flags) const {
    EXPECT_EQ(radvor_delaunay_constrain_as(handle_, a, b, flags, RADVOR_CROSSING_REFUSE), RADVOR_OK);
  }
  std::array<double, 2> position(std::uint32_t vertex) const {
    std::array<double, 2> xy{};
    EXPECT_EQ(radvor_delaunay_position(handle_, vertex, xy.data()), RADVOR_OK);
    return xy;
  }

  /// width elements each.
  using List = radvor_result (*)(const radvor_delaunay*, std::uint32_t*, std::uint32_t*);
  Ids list(List function, std::uint32_t width) const {
    std::uint32_t count = 0;
    EXPECT_EQ(function(handle_, nullptr, &count), RADVOR_OK);
    Ids ids(std::size_t{width} * count + 1);
    EXPECT_EQ(function(handle_, ids.data(), &count), RADVOR_OK);
    ids.pop_back();
    return ids;
  }
  Ids hull() const { return list(radvor_delaunay_hull, 1); }
  Ids changes() const { return list(radvor_delaunay_changes, 1); }
  std::set<std::array<std::uint32_t, 2>> pairs(List function) const {
    std::set<std::array<std::uint32_t, 2>> pairs;
    const Ids ids = list(function, 2);
    for (std::size_t i = 0; i < ids.size(); i += 2) {
      EXPECT_LT(ids[i], ids[i + 1]);
      pairs.insert({ids[i], ids[i + 1]});
    }
    EXPECT_EQ(2 * pairs.size(), ids.size()) << "an edge came twice";
    return pairs;
  }
  Ids neighbours(std::uint32_t vertex) const {
    std::uint32_t count = 0;
    EXPECT_EQ(radvor_delaunay_neighbours(handle_, vertex, nullptr, &count), RADVOR_OK);
    Ids ids(count + 1);
    EXPECT_EQ(radvor_delaunay_neighbours(handle_, vertex, ids.data(), &count), RADVOR_OK);
    ids.pop_back();
    return ids;
  }
  std::vector<std::array<std::uint32_t, 3>> triangles() const {
    const std::uint32_t count = radvor_delaunay_triangle_count(handle_);
    Ids indices(3 * std::size_t{count} + 1);
    EXPECT_EQ(radvor_delaunay_triangles(handle_, indices.data(), count), RADVOR_OK);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    return triangles;
  }

  /// Vertices, triangles from their least corner on, constraints with flags, values: all that an edit may change.
  std::vector<double> state() const {
    std::vector<double> state;
    for (std::uint32_t v = 0; v < radvor_delaunay_vertex_bound(handle_); ++v) {
      double xy[2] = {-1e300, 0}, value = -1e300;
      if (radvor_delaunay_position(handle_, v, xy) == RADVOR_OK) {
        EXPECT_EQ(radvor_delaunay_value(handle_, v, &value), RADVOR_OK);
      }
      state.insert(state.end(), {xy[0], xy[1], std::isnan(value) ? 1e300 : value});
    }
    auto all = triangles();
    for (auto& triangle : all) {
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    std::sort(all.begin(), all.end());
    for (const auto& triangle : all) {
      state.insert(state.end(), triangle.begin(), triangle.end());
    }
    for (const auto& [a, b] : pairs(radvor_delaunay_constraints)) {
      std::uint32_t flags = 0;
      EXPECT_EQ(radvor_delaunay_constraint(handle_, a, b, &flags), RADVOR_OK);
      state.insert(state.end(), {double(a), double(b), double(flags)});
    }
    return state;
  }

 private:
  radvor_delaunay* handle_ = nullptr;
};

inline std::uint32_t pick(std::mt19937& random, std::uint32_t count) {
  return static_cast<std::uint32_t>(random() % count);
}

inline double turn(std::array<double, 2> a, std::array<double, 2> b, std::array<double, 2> c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

inline std::vector<double> random_points(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> xy(2 * count);
  for (double& coordinate : xy) {
    coordinate = unit(random);
  }
  return xy;
}

}  // namespace radvor::test
