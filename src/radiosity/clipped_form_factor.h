// The form factor of what a receiver sees of a convex polygon: exact, by clipping away what stands between, where that
// is little.
#pragma once

#include <optional>
#include <span>

#include "radiosity/occluder_tree.h"
#include "radiosity/receiver.h"
#include "radiosity/tracer.h"

namespace radvor {

inline constexpr std::size_t k_max_clip_corners = 11;  ///< of the polygon; the horizon's cut may add one

/// The corners of a convex polygon above the receiver's horizon, cut there; written to `part`, which has room for one
/// more than the polygon has. The number of corners: 0, or 3 and more.
std::size_t cut_at_horizon(const Receiver& receiver, std::span<const Vec3> polygon, std::span<Vec3> part);

/// The form factor of the visible part of a planar convex polygon with at most k_max_clip_corners corners and unit
/// normal `normal`; whole: its form factor if nothing hides it. None where more than most_occluders triangles reach
/// into the shaft, or more pieces remain than VisiblePolygon holds: then rays must tell.
std::optional<double> clipped_form_factor(const Receiver& receiver, std::span<const Vec3> polygon, const Vec3& normal,
                                          double whole, std::size_t most_occluders, Tracer& tracer,
                                          const OccluderTree& occluders);

/// The visible part of a planar convex polygon as a share of its whole form factor; none as above.
std::optional<double> visible_share(const Receiver& receiver, std::span<const Vec3> polygon, const Vec3& normal,
                                    std::size_t most_occluders, Tracer& tracer, const OccluderTree& occluders);

}  // namespace radvor
