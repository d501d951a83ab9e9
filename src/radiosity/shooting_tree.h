// What shoots by itself, as trees: the leaves are elements (shares: a cell with its radiosity), inner nodes stand for
// all the elements under them, one root for each patch. After Tampieri and Lischinski, The Constant Radiosity
// Assumption Syndrome (1991), the paper's [17].
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "base/vector.h"
#include "radiosity/form_factor.h"
#include "surface/surface.h"

namespace radvor {

struct TreeNode {
  PlanePiece piece;  ///< of all elements; where they are not in one plane: mean centroid and normal, no moments
  Vec3 area_vector;  ///< sum of area * normal over the elements
  double radius;     ///< of the sphere about piece.centroid that holds all cells
  bool flat;         ///< all elements lie in one plane, with one basis
  Vec2 low, high;    ///< where flat: bounds of all cells about the centroid, along piece.u, v
  std::uint32_t first_child, child_count;      ///< children are neighbours among the nodes; none: a leaf
  std::uint32_t first_element, element_count;  ///< a range of elements
};

/// What a node shoots.
struct NodeLight {
  Color radiosity{0.0};                ///< area-weighted mean, W m^-2
  Color moment_u{0.0}, moment_v{0.0};  ///< mean of radiosity times distance from the centroid along piece.u and
                                       ///< piece.v, over the radius; 0 for leaves and where not flat
};

/// One share that shoots.
struct Element {
  std::uint32_t share;
  std::uint32_t node;                        ///< its leaf
  std::uint32_t first_corner, corner_count;  ///< its cell, into ShootingTree::corners
  bool convex;                               ///< the cell is
};

/// The rectangle about a flat node, counter-clockwise about its normal.
std::array<Vec3, 4> bounding_rectangle(const TreeNode& node);

class ShootingTree {
 public:
  /// Of the given patches. Measures their shares' cells. Nodes come parents first.
  ShootingTree(const Surface& surface, std::span<const std::uint32_t> patches, Host& host);

  std::span<const TreeNode> nodes() const { return nodes_; }
  std::span<const Element> elements() const { return elements_; }
  std::span<const Vec3> polygon(const Element& element) const {
    return std::span(corners_).subspan(element.first_corner, element.corner_count);
  }
  /// The root of each of the patches; those without area have none (k_none).
  std::span<const std::uint32_t> roots() const { return roots_; }

  /// Radiosity of each leaf in, of every node out; one entry a node.
  void pull(std::span<NodeLight> light, Host& host) const;

 private:
  struct Bounds {
    Vec2 low, high;  // of a cell about its centroid
  };

  // Members: shares of all patches; [begin, end): of this one. Pieces, radii and bounds are the members'.
  void add_patch(const Surface& surface, std::span<const std::uint32_t> members, std::uint32_t begin, std::uint32_t end,
                 std::span<const PlanePiece> pieces, std::span<const double> radii, std::span<const Bounds> bounds,
                 std::pmr::memory_resource* memory);

  std::pmr::vector<TreeNode> nodes_;
  std::pmr::vector<Element> elements_;
  std::pmr::vector<Vec3> corners_;
  std::pmr::vector<std::uint32_t> roots_;
};

}  // namespace radvor
