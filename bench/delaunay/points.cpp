#include "delaunay/points.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace radvor::bench {

namespace {

void shuffle_points(Points& xy, unsigned seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = xy.size() / 2; i > 1; --i) {
    const std::size_t j = random() % i;
    std::swap(xy[2 * i - 2], xy[2 * j]);
    std::swap(xy[2 * i - 1], xy[2 * j + 1]);
  }
}

}  // namespace

Points uniform(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Points xy(2 * count);
  for (double& c : xy) {
    c = unit(random);
  }
  return xy;
}

Points grid(std::size_t side, double jitter_least, double jitter_most) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  Points xy;
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const double size =
          jitter_most > 0 ? jitter_least * std::pow(jitter_most / jitter_least, std::fabs(unit(random))) : 0;
      xy.push_back(static_cast<double>(i) + size * unit(random));
      xy.push_back(static_cast<double>(j) + size * unit(random));
    }
  }
  shuffle_points(xy, 4);
  return xy;
}

Points circle(std::size_t count) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(0, 2 * M_PI);
  Points xy;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = angle(random);
    xy.push_back(std::cos(a));
    xy.push_back(std::sin(a));
  }
  return xy;
}

Points clusters(std::size_t count) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  Points xy;
  while (xy.size() < 2 * count) {
    const double x = unit(random), y = unit(random), size = std::pow(10, -8 + 6 * unit(random));
    for (int i = 0; i < 1000; ++i) {
      xy.push_back(x + size * normal(random));
      xy.push_back(y + size * normal(random));
    }
  }
  shuffle_points(xy, 7);
  return xy;
}

Points line(std::size_t count, bool exact) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  Points xy;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = exact ? static_cast<double>(random() % (1u << 30)) : unit(random);
    xy.push_back(t);
    xy.push_back(exact ? 3 * t + 7 : t / 3);
  }
  return xy;
}

Points with_short_segments(std::size_t count, std::size_t side) {
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> unit(0, 1);
  Points xy;
  for (std::size_t i = 0; i < side * side; ++i) {
    const std::size_t row = i / side;
    for (int end = 0; end < 2; ++end) {
      xy.push_back((static_cast<double>(i % side) + 0.1 + 0.8 * unit(random)) / static_cast<double>(side));
      xy.push_back((static_cast<double>(row) + 0.1 + 0.8 * unit(random)) / static_cast<double>(side));
    }
  }
  const Points more = uniform(count - 2 * side * side, 20);
  xy.insert(xy.end(), more.begin(), more.end());
  return xy;
}

Points with_long_segments(std::size_t count, std::size_t segments) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> unit(0, 1);
  Points xy;
  for (std::size_t i = 0; i < segments; ++i) {
    for (const double x : {0.01, 0.99}) {
      xy.push_back(x);
      xy.push_back((static_cast<double>(i) + 0.2 + 0.6 * unit(random)) / static_cast<double>(segments));
    }
  }
  const Points more = uniform(count - 2 * segments, 22);
  xy.insert(xy.end(), more.begin(), more.end());
  return xy;
}

}  // namespace radvor::bench
