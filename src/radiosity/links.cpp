#include "radiosity/links.h"

#include <algorithm>
#include <cmath>

#include "radiosity/clipped_form_factor.h"

namespace radvor {

namespace {

constexpr std::size_t k_batch = 64;  // rays that wait for each other: four packets

// Points of a cell in equal strata of a fan about its centroid. `part` of `count`.
Vec3 point_of_cell(std::span<const Vec3> polygon, const Vec3& centroid, std::uint32_t part, std::uint32_t count) {
  if (count == 1) {
    return centroid;
  }
  // Round the fan by triangles, rings outwards by the golden ratio: every prefix is spread over cell and radius.
  const double turn = (part + 0.5) / count * static_cast<double>(polygon.size());
  const auto corner = std::min(static_cast<std::size_t>(turn), polygon.size() - 1);
  const double along = turn - static_cast<double>(corner);
  const double ring = std::fmod(0.5 + part * 0.6180339887498949, 1.0);
  const Vec3 rim = glm::mix(polygon[corner], polygon[(corner + 1) % polygon.size()], along);
  return glm::mix(centroid, rim, std::sqrt(ring));
}

}  // namespace

LinkMaker::LinkMaker(const ShootingTree& tree, const OccluderTree* occluders, const LinkAccuracy& accuracy,
                     std::pmr::memory_resource* memory)
    : tree_(tree),
      occluders_(occluders),
      accuracy_(accuracy),
      pending_(memory),
      candidates_(memory),
      targets_(memory),
      weights_(memory),
      blocked_(memory) {}

void LinkMaker::make(const Receiver& receiver, std::span<const std::uint32_t> roots, Tracer& tracer,
                     std::pmr::vector<Link>& links) {
  links_ = &links;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (roots[i] == k_none) {
      continue;
    }
    pending_.push_back({roots[i], false});
    open_pending(receiver, tracer);
    if (targets_.size() >= k_batch) {
      settle_all(receiver, tracer);
    }
  }
  settle_all(receiver, tracer);
}

void LinkMaker::open_pending(const Receiver& receiver, Tracer& tracer) {
  while (!pending_.empty()) {
    const Pending pending = pending_.back();
    pending_.pop_back();
    open(pending, receiver, tracer);
  }
}

// Until no node waits for rays; those that are opened because theirs disagree make more.
void LinkMaker::settle_all(const Receiver& receiver, Tracer& tracer) {
  while (!candidates_.empty()) {
    settle(receiver, tracer);
    open_pending(receiver, tracer);
  }
}

// Decides how a node is seen: not at all, as a whole, as its polygon, or by its children.
void LinkMaker::open(Pending pending, const Receiver& receiver, Tracer& tracer) {
  const auto [index, clear] = pending;
  const TreeNode& node = tree_.nodes()[index];
  const Vec3& x = receiver.point;
  const Vec3& n = receiver.normal;
  const Vec3 w = node.piece.centroid - x;
  const double above = glm::dot(n, w);
  // A plane that the receiver lies in, or is nearer to than positions can tell, gives it nothing.
  const bool faces = above > -node.radius && !(node.flat && -glm::dot(node.piece.normal, w) <= tracer.lift());
  if (!faces && tracer.skips.facing) {
    ++tracer.counters.skipped_facing;
    return;
  }
  const double distance = glm::length(w);
  const bool leaf = node.child_count == 0;
  const bool whole = above >= node.radius;  // all of it above the horizon
  double form_factor;
  if (!leaf) {
    if (!whole || distance < accuracy_.separation * node.radius) {
      open_children(node, clear || (faces && is_clear(node, receiver, tracer)));
      return;
    }
    ++tracer.counters.form_factors;
    if (node.flat) {
      form_factor = kernel_form_factor(x, n, node.piece);
    } else {
      const double projected = std::max(0.0, -glm::dot(node.area_vector, w));
      const double square = distance * distance;
      form_factor = above * projected / (3.14159265358979323846 * square * square);
    }
  } else {
    ++tracer.counters.form_factors;
    form_factor =
        whole && distance >= accuracy_.separation * node.radius
            ? kernel_form_factor(x, n, node.piece)
            : polygon_form_factor(x, n, tree_.polygon(tree_.elements()[node.first_element]), node.piece.normal);
  }
  if (form_factor <= 0 || !faces) {
    return;
  }
  if (clear) {
    ++tracer.counters.skipped_clear;
    link(index, form_factor, receiver);
    return;
  }
  if (form_factor > accuracy_.clip_above) {
    if (const auto visible = clip(node, form_factor, receiver, tracer)) {
      link(index, *visible, receiver);
      return;
    }
  }
  const double wanted = std::ceil(form_factor * accuracy_.rays_per_hemisphere);
  const auto rays = static_cast<std::uint32_t>(
      std::clamp(wanted, static_cast<double>(accuracy_.least_rays), static_cast<double>(accuracy_.most_rays)));
  propose(index, form_factor, rays, receiver, tracer);
}

void LinkMaker::open_children(const TreeNode& node, bool clear) {
  for (std::uint32_t child = node.first_child; child < node.first_child + node.child_count; ++child) {
    pending_.push_back({child, clear});
  }
}

// One look at the whole of a flat node saves one at each of those under it.
bool LinkMaker::is_clear(const TreeNode& node, const Receiver& receiver, Tracer& tracer) const {
  return occluders_ != nullptr && node.flat &&
         visible_share(receiver, bounding_rectangle(node), node.piece.normal, 0, tracer, *occluders_).has_value();
}

// Queues rays to points spread over the node: one in each of equal runs of its elements, or several in its one cell.
void LinkMaker::propose(std::uint32_t index, double form_factor, std::uint32_t ray_count, const Receiver& receiver,
                        Tracer& tracer) {
  const TreeNode& node = tree_.nodes()[index];
  const auto first = static_cast<std::uint32_t>(targets_.size());
  const auto add = [&](const Vec3& point, const Vec3& normal) {
    const double weight = kernel(receiver.point, receiver.normal, point, normal);
    if (weight <= 0 && tracer.skips.facing) {
      ++tracer.counters.skipped_facing;
      return;
    }
    targets_.push_back(point + normal * tracer.lift());
    weights_.push_back(weight);
  };
  if (node.element_count == 1) {
    const auto polygon = tree_.polygon(tree_.elements()[node.first_element]);
    for (std::uint32_t i = 0; i < ray_count; ++i) {
      add(point_of_cell(polygon, node.piece.centroid, i, ray_count), node.piece.normal);
    }
  } else {
    const std::uint32_t count = std::min(std::max(ray_count, accuracy_.least_of_many), node.element_count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t pick = (2 * i + 1) * node.element_count / (2 * count);
      const TreeNode& leaf = tree_.nodes()[tree_.elements()[node.first_element + pick].node];
      add(leaf.piece.centroid, leaf.piece.normal);
    }
  }
  candidates_.push_back({index, first, static_cast<std::uint32_t>(targets_.size()) - first, form_factor});
}

// Casts the queued rays. Nodes whose rays agree become links; inner nodes that matter and are partly hidden are opened;
// so are those of which no point was above the horizon.
void LinkMaker::settle(const Receiver& receiver, Tracer& tracer) {
  blocked_.resize(targets_.size());
  tracer.blocked_from(receiver.lifted, targets_, blocked_.data());
  for (const Candidate& candidate : candidates_) {
    double all = 0, seen = 0;
    bool some_open = false, some_hidden = false;
    for (std::uint32_t ray = candidate.first_ray; ray < candidate.first_ray + candidate.ray_count; ++ray) {
      if (weights_[ray] <= 0) {  // points under a horizon are not blocked: they are not there
        ++tracer.counters.idle_rays;
        continue;
      }
      all += weights_[ray];
      seen += blocked_[ray] ? 0 : weights_[ray];
      some_open = some_open || blocked_[ray] == 0;
      some_hidden = some_hidden || blocked_[ray] != 0;
    }
    const TreeNode& node = tree_.nodes()[candidate.node];
    const bool mixed = some_open == some_hidden;  // or no point was above the horizon
    if (mixed && node.child_count > 0) {
      if (candidate.form_factor > accuracy_.splittable || !tracer.skips.negligible) {
        open_children(node, false);
        continue;
      }
      ++tracer.counters.skipped_negligible;
    }
    const double visible = all > 0 ? candidate.form_factor * seen / all : 0;
    link(candidate.node, visible, receiver);
  }
  candidates_.clear();
  targets_.clear();
  weights_.clear();
}

// The visible form factor of a flat node by clipping, where that is cheap. A leaf's is exact; an inner node's is its
// form factor times the visible part of the rectangle about it.
std::optional<double> LinkMaker::clip(const TreeNode& node, double form_factor, const Receiver& receiver,
                                      Tracer& tracer) const {
  if (occluders_ == nullptr || !node.flat) {
    return std::nullopt;
  }
  if (node.child_count == 0) {
    const Element& element = tree_.elements()[node.first_element];
    if (!element.convex || element.corner_count > k_max_clip_corners) {
      return std::nullopt;
    }
    return clipped_form_factor(receiver, tree_.polygon(element), node.piece.normal, form_factor, accuracy_.most_clipped,
                               tracer, *occluders_);
  }
  const auto rectangle = bounding_rectangle(node);
  const auto share = visible_share(receiver, rectangle, node.piece.normal, accuracy_.most_clipped, tracer, *occluders_);
  return share ? std::optional(form_factor * *share) : std::nullopt;
}

void LinkMaker::link(std::uint32_t index, double visible, const Receiver& receiver) {
  if (visible <= 0) {
    return;
  }
  const TreeNode& node = tree_.nodes()[index];
  Link link{index, static_cast<float>(visible), 0, 0};
  if (node.flat && node.child_count > 0) {
    // The kernel is H (n . w) / (pi |w|^4), H the same all over the node's plane.
    const Vec3 w = node.piece.centroid - receiver.point;
    const Vec3 slope = receiver.normal / glm::dot(receiver.normal, w) - 4.0 * w / glm::dot(w, w);
    const auto pack = [&](const Vec3& axis) {
      const double value = std::clamp(glm::dot(slope, axis) * node.radius, -1.99, 1.99);
      return static_cast<std::int16_t>(std::lround(value * Link::k_slope_unit));
    };
    link.slope_u = pack(node.piece.u);
    link.slope_v = pack(node.piece.v);
  }
  links_->push_back(link);
}

Color sent_along(const Link& link, std::span<const NodeLight> light) {
  const NodeLight& node = light[link.node];
  return static_cast<double>(link.factor) * (node.radiosity + (link.slope_u / Link::k_slope_unit) * node.moment_u +
                                             (link.slope_v / Link::k_slope_unit) * node.moment_v);
}

}  // namespace radvor
