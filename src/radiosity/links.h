// Links: what one receiver gets from each node that it opened, as form factor times visibility. Made for what shoots by
// itself.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "radiosity/occluder_tree.h"
#include "radiosity/receiver.h"
#include "radiosity/shooting_tree.h"
#include "radiosity/tracer.h"

namespace radvor {

/// What an inner node sends is its mean radiosity times the factor, and its first moment times the kernel's slope:
/// without that, a node whose radiosity and kernel both rise towards one side loses 1 to 2 % of its light.
struct Link {
  std::uint32_t node;
  float factor;  ///< form factor times visible share
  std::int16_t slope_u,
      slope_v;  ///< d ln(kernel) over the node's radius, along piece.u and piece.v, times k_slope_unit
  static constexpr double k_slope_unit = 1 << 14;
};

/// What the node sends along the link, W m^-2.
Color sent_along(const Link& link, std::span<const NodeLight> light);

/// How much a link may cost and how wrong it may be: as exact as one patch's light need be. Nodes stand for their
/// elements from near on; how much of one is seen a few rays tell, or the one look that finds nothing in the way.
struct LinkAccuracy {
  double rays_per_hemisphere = 64;  ///< a node gets this times its form factor, within the bounds below
  std::uint32_t least_rays = 1;     ///< for a leaf
  std::uint32_t least_of_many = 4;  ///< for an inner node: one ray cannot say that it is seen in part
  std::uint32_t most_rays = 16;
  double separation = 3;          ///< a node stands for its elements, a leaf for its polygon, from this many radii on
  std::size_t most_clipped = 24;  ///< a node is clipped by up to so many triangles
  double clip_above = 0.02;       ///< a node of less than this form factor is left to rays
  double splittable = 1e-3;       ///< an inner node of more than this form factor is opened where its rays disagree
};

/// The links of one receiver into the trees under `roots`, appended to `links`.
class LinkMaker {
 public:
  LinkMaker(const ShootingTree& tree, const OccluderTree* occluders, const LinkAccuracy& accuracy,
            std::pmr::memory_resource* memory);

  void make(const Receiver& receiver, std::span<const std::uint32_t> roots, Tracer& tracer,
            std::pmr::vector<Link>& links);

 private:
  struct Pending {
    std::uint32_t node;
    bool clear;  ///< nothing is in the way to any of it
  };
  struct Candidate {
    std::uint32_t node;
    std::uint32_t first_ray, ray_count;
    double form_factor;
  };

  void open(Pending pending, const Receiver& receiver, Tracer& tracer);
  void open_children(const TreeNode& node, bool clear);
  bool is_clear(const TreeNode& node, const Receiver& receiver, Tracer& tracer) const;
  void link(std::uint32_t node, double visible, const Receiver& receiver);
  void propose(std::uint32_t node, double form_factor, std::uint32_t ray_count, const Receiver& receiver,
               Tracer& tracer);
  void open_pending(const Receiver& receiver, Tracer& tracer);
  void settle_all(const Receiver& receiver, Tracer& tracer);
  void settle(const Receiver& receiver, Tracer& tracer);
  std::optional<double> clip(const TreeNode& node, double form_factor, const Receiver& receiver, Tracer& tracer) const;

  const ShootingTree& tree_;
  const OccluderTree* occluders_;  ///< none: rays alone
  LinkAccuracy accuracy_;
  std::pmr::vector<Link>* links_ = nullptr;  ///< of the receiver under way
  std::pmr::vector<Pending> pending_;        ///< nodes to look at
  std::pmr::vector<Candidate> candidates_;   ///< nodes that wait for their rays
  std::pmr::vector<Vec3> targets_;
  std::pmr::vector<double> weights_;
  std::pmr::vector<std::uint8_t> blocked_;
};

}  // namespace radvor
