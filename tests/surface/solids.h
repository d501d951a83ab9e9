// Scenes to make surfaces of: rooms, prisms, cylinders, polygons with holes. Triangles wind counter-clockwise about
// their fronts, which face out of solids and into rooms.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace radvor::test {

class SceneBuilder {
 public:
  explicit SceneBuilder(std::pmr::memory_resource* memory) : scene_(memory), memory_(memory) {
    add_material({Color(0.5), Color(0.0), false});
  }

  std::uint32_t add_material(const Material& material) {
    scene_.materials.push_back(material);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }

  /// What follows goes into a new mesh.
  Mesh& begin_mesh() { return scene_.meshes.emplace_back(memory_); }
  Mesh& mesh() { return scene_.meshes.empty() ? begin_mesh() : scene_.meshes.back(); }

  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t material = 0) {
    Mesh& to = mesh();
    for (const Vec3& p : {a, b, c}) {
      to.indices.push_back(static_cast<std::uint32_t>(to.positions.size()));
      to.positions.emplace_back(p);
    }
    to.triangle_materials.push_back(material);
  }
  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::uint32_t material = 0) {
    triangle(a, b, c, material);
    triangle(a, c, d, material);
  }

  /// inward: a room, else a solid.
  void box(const Vec3& low, const Vec3& high, bool inward, std::uint32_t material = 0) {
    const auto corner = [&](int x, int y, int z) {
      return Vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
    };
    const auto face = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
      inward ? quad(d, c, b, a, material) : quad(a, b, c, d, material);
    };
    face(corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0));
    face(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
    face(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
    face(corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0));
    face(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
    face(corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1));
  }

  /// A prism over rings of points at the same angles round the origin: `outer` counter-clockwise, with a hole where
  /// `inner` is not empty; both star-shaped. From z = 0 to height. caps and walls are solid's outsides.
  void prism(const std::vector<Vec2>& outer, const std::vector<Vec2>& inner, double height) {
    const std::size_t n = outer.size();
    const auto at = [](const Vec2& p, double z) { return Vec3(p.x, p.y, z); };
    const auto cap = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
      triangle(at(a, height), at(b, height), at(c, height));
      triangle(at(a, 0), at(c, 0), at(b, 0));
    };
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t m = (k + 1) % n;
      quad(at(outer[k], 0), at(outer[m], 0), at(outer[m], height), at(outer[k], height));
      if (inner.empty()) {
        cap(Vec2(0), outer[k], outer[m]);
        continue;
      }
      quad(at(inner[m], 0), at(inner[k], 0), at(inner[k], height), at(inner[m], height));
      const auto turns_left = [](const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a) > 0; };
      if (turns_left(outer[k], outer[m], inner[m]) && turns_left(outer[k], inner[m], inner[k])) {
        cap(outer[k], outer[m], inner[m]);
        cap(outer[k], inner[m], inner[k]);
      } else {
        cap(outer[k], outer[m], inner[k]);
        cap(outer[m], inner[m], inner[k]);
      }
    }
  }

  Scene take() { return std::move(scene_); }

 private:
  Scene scene_;
  std::pmr::memory_resource* memory_;
};

/// Random radii about 1, the inner ones a part of them.
inline void random_rings(std::mt19937& random, std::size_t count, std::vector<Vec2>& outer, std::vector<Vec2>& inner) {
  std::uniform_real_distribution<double> radius(0.4, 1.0);
  std::uniform_real_distribution<double> part(0.2, 0.9);
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    const Vec2 direction(std::cos(angle), std::sin(angle));
    const double r = radius(random);
    // As the mesh will have them: both ends of a shared edge are floats.
    outer.emplace_back(glm::vec2(r * direction));
    inner.emplace_back(glm::vec2(part(random) * r * direction));
  }
}

/// A closed cylinder of `sides` sides; the side has smooth normals of its own where wanted.
inline void cylinder(SceneBuilder& builder, std::uint32_t sides, double radius, double height, bool normals) {
  Mesh& mesh = builder.begin_mesh();
  const auto add = [&](const Vec3& p, const Vec3& n) {
    mesh.positions.emplace_back(p);
    if (normals) {
      mesh.normals.emplace_back(n);
    }
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
    mesh.triangle_materials.push_back(0);
  };
  std::vector<std::uint32_t> low, high, cap_low, cap_high;
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    low.push_back(add(radius * out, out));
    high.push_back(add(radius * out + Vec3(0, 0, height), out));
    cap_low.push_back(add(radius * out, {0, 0, -1}));
    cap_high.push_back(add(radius * out + Vec3(0, 0, height), {0, 0, 1}));
  }
  const std::uint32_t bottom = add({0, 0, 0}, {0, 0, -1});
  const std::uint32_t top = add({0, 0, height}, {0, 0, 1});
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t m = (k + 1) % sides;
    face(low[k], low[m], high[m]);
    face(low[k], high[m], high[k]);
    face(bottom, cap_low[m], cap_low[k]);
    face(top, cap_high[k], cap_high[m]);
  }
}

/// A room of side 4 with a box that stands on the floor and one that floats; each is closed.
inline void room_with_boxes(SceneBuilder& builder) {
  builder.box({0, 0, 0}, {4, 4, 3}, true);
  builder.begin_mesh();
  builder.box({2.2, 1.1, 1.3}, {3.1, 2.5, 2.2}, false);
  builder.begin_mesh();
  builder.box({0.5, 0.7, 0}, {1.4, 1.9, 1.2}, false);
}

/// That room as a scene.
inline Scene room() {
  SceneBuilder builder(std::pmr::get_default_resource());
  room_with_boxes(builder);
  return builder.take();
}

/// The unit square, one facet.
inline Scene unit_floor() {
  SceneBuilder builder(std::pmr::get_default_resource());
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  return builder.take();
}

/// A floor of six squares, one facet, with a wall without thickness on an edge between them: a slit.
inline void floor_with_wall(SceneBuilder& builder) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) {
      builder.quad(Vec3(i, j, 0), Vec3(i + 1, j, 0), Vec3(i + 1, j + 1, 0), Vec3(i, j + 1, 0));
    }
  }
  builder.begin_mesh();
  builder.quad({1, 1, 0}, {2, 1, 0}, {2, 1, 1}, {1, 1, 1});
}

/// An L-shaped room, one closed surface.
inline void l_shaped_room(SceneBuilder& builder) {
  const Vec2 floor[] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
  const double h = 1.5;
  const auto at = [](const Vec2& p, double z) { return Vec3(p.x, p.y, z); };
  for (std::size_t k = 0; k < 6; ++k) {
    const Vec2& a = floor[k];
    const Vec2& b = floor[(k + 1) % 6];
    builder.quad(at(b, 0), at(a, 0), at(a, h), at(b, h));
  }
  const std::size_t triangles[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& t : triangles) {
    builder.triangle(at(floor[t[0]], 0), at(floor[t[1]], 0), at(floor[t[2]], 0));
    builder.triangle(at(floor[t[0]], h), at(floor[t[2]], h), at(floor[t[1]], h));
  }
}

}  // namespace radvor::test
