// Whether a bake tore its scene: torn_edges SCENE.obj BAKED.ply. The surfaces that come out have a border where those
// that went in have one, once welded, and nowhere else: with a T-vertex the one side of an edge would be met by one
// triangle, and its two halves by one from the other side. By position alone, as an engine would see it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory_resource>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/host.h"
#include "mesh_checks.h"
#include "obj_file.h"
#include "scene/box_tree.h"
#include "scene/welded.h"

namespace {

using radvor::Box;
using radvor::Vec3;

// As save_ply writes it: 12 floats a vertex, 3 corners and 2 numbers a triangle.
mesh_checks::Triangles read_ply(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    std::sscanf(line.c_str(), "element vertex %zu", &vertices);
    std::sscanf(line.c_str(), "element face %zu", &faces);
  }
  mesh_checks::Triangles mesh;
  for (std::size_t v = 0; v < vertices; ++v) {
    std::array<float, 12> row;
    in.read(reinterpret_cast<char*>(row.data()), sizeof row);
    mesh.positions.emplace_back(row[0], row[1], row[2]);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    in.get();
    std::array<std::uint32_t, 5> row;
    in.read(reinterpret_cast<char*>(row.data()), sizeof row);
    mesh.indices.insert(mesh.indices.end(), row.begin(), row.begin() + 3);
  }
  if (!in || faces == 0) {
    throw std::runtime_error(file + ": not what radvor-bake writes");
  }
  return mesh;
}

radvor::Scene scene_of(const bake::SceneData& data, std::pmr::memory_resource* memory) {
  radvor::Scene scene(memory);
  for (const bake::MeshData& given : data.meshes) {
    radvor::Mesh& mesh = scene.meshes.emplace_back(memory);
    mesh.positions.assign(given.positions.begin(), given.positions.end());
    mesh.indices.assign(given.indices.begin(), given.indices.end());
    mesh.triangle_materials.assign(given.triangle_materials.begin(), given.triangle_materials.end());
  }
  return scene;
}

struct Segment {
  Vec3 a, b;
};

// Edges that an odd number of triangles meets.
std::vector<Segment> border_of(const radvor::WeldedScene& welded) {
  std::vector<Segment> border;
  for (std::uint32_t e = 0; e < welded.edges.size(); ++e) {
    if (welded.uses_at_edge(e).size() % 2 == 1) {
      border.push_back({welded.positions[welded.edges[e].a], welded.positions[welded.edges[e].b]});
    }
  }
  return border;
}

std::vector<Segment> border_of(const mesh_checks::Triangles& mesh) {
  std::vector<Segment> border;
  for (const auto& [edge, runs] : mesh_checks::edges_of(mesh)) {
    if ((runs.up + runs.down) % 2 == 1 && edge.first != edge.second) {
      border.push_back({mesh_checks::wide(edge.first), mesh_checks::wide(edge.second)});
    }
  }
  return border;
}

double distance_to(const Segment& segment, const Vec3& p) {
  const Vec3 along = segment.b - segment.a;
  const double square = dot(along, along);
  const double part = square > 0 ? std::clamp(dot(p - segment.a, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, segment.a + part * along);
}

int check(const std::string& scene_file, const std::string& baked_file) {
  radvor::Host host{radvor::HostMemory(nullptr, nullptr, nullptr), radvor::Log(nullptr, nullptr),
                    radvor::Jobs(2, nullptr, nullptr, std::pmr::new_delete_resource())};
  bake::Warnings warnings;
  const radvor::Scene scene = scene_of(bake::load_obj(scene_file, warnings), std::pmr::new_delete_resource());
  const radvor::WeldedScene welded = radvor::weld(scene, 0, host);
  const std::vector<Segment> given = border_of(welded);
  const std::vector<Segment> found = border_of(read_ply(baked_file));
  const double slack = 2e-6 * length(welded.high - welded.low);  // single precision
  std::pmr::vector<Box> boxes;
  double given_length = 0;
  for (const Segment& segment : given) {
    Box& box = boxes.emplace_back();
    box.add(glm::min(segment.a, segment.b) - slack);
    box.add(glm::max(segment.a, segment.b) + slack);
    given_length += glm::distance(segment.a, segment.b);
  }
  const radvor::BoxTree tree(boxes, std::pmr::new_delete_resource());
  std::size_t torn = 0;
  double found_length = 0;
  for (const Segment& segment : found) {
    found_length += glm::distance(segment.a, segment.b);
    Box box;
    box.add(segment.a);
    box.add(segment.b);
    bool lies = false;
    tree.walk([&](const Box& node) { return node.overlaps(box); },
              [&](std::uint32_t i) {
                lies = lies || (distance_to(given[i], segment.a) <= slack && distance_to(given[i], segment.b) <= slack);
              });
    if (!lies && ++torn <= 10) {
      std::printf("torn from %.9g %.9g %.9g to %.9g %.9g %.9g\n", segment.a.x, segment.a.y, segment.a.z, segment.b.x,
                  segment.b.y, segment.b.z);
    }
  }
  std::printf("%zu edges torn; borders in %zu (%.9g), out %zu (%.9g)\n", torn, given.size(), given_length, found.size(),
              found_length);
  return torn > 0 || std::abs(found_length - given_length) > 1e-5 * given_length ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: torn_edges SCENE.obj BAKED.ply\n");
    return 2;
  }
  try {
    return check(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
