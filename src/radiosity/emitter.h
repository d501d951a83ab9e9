// Surfaces that emit, as light sources: the exact form factor of what the receiver sees of each triangle, or of two
// that are a convex quadrilateral. Few occluders are clipped away exactly; where there are many the triangle is split
// where rays disagree.
#pragma once

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "radiosity/occluder_tree.h"
#include "radiosity/receiver.h"
#include "radiosity/sight.h"
#include "radiosity/tracer.h"

namespace radvor {

struct Emitter {
  std::array<Vec3, 3> corners;  ///< counter-clockwise about the side that emits
  Vec3 normal;                  ///< unit
  Color radiosity;              ///< pi * emitted radiance, W m^-2
  double area;
};

struct EmitterAccuracy {
  double mean_irradiance = 1;  ///< what the scene's receivers get on the average, luminance, W m^-2: sets what matters
  double tolerance = 0.02;
};

/// Irradiance from one emitter. With `occluders`, those between it and the receiver are clipped away, which is exact to
/// rounding, while they are few; a crowd, where the receiver has little leeway. Else rays: a part of it whose rays
/// disagree is quartered until what is at stake is under three times the tolerance's share of the mean irradiance (the
/// whole: one), times the receiver's leeway; the last parts take the share of their points that is seen, weighted by
/// the kernel. Points under the receiver's horizon are not there, rather than blocked.
Color irradiance_of_emitter(const Emitter& emitter, const Receiver& receiver, Tracer& tracer,
                            const EmitterAccuracy& accuracy, const OccluderTree* occluders, Sight& sight);

/// The same of two emitters of one plane and radiosity that make up a convex polygon, counter-clockwise, together: what
/// stands between is looked for once. Where that is too much rays tell, of each half.
Color irradiance_of_panel(std::span<const Emitter, 2> halves, std::span<const Vec3> polygon, const Receiver& receiver,
                          Tracer& tracer, const EmitterAccuracy& accuracy, const OccluderTree* occluders, Sight& sight);

}  // namespace radvor
