// Points, spots and suns: lights that are seen under a small angle, or none.
#pragma once

#include "radiosity/receiver.h"
#include "radiosity/sight.h"
#include "radiosity/tracer.h"
#include "scene/scene.h"

namespace radvor {

/// Irradiance from a point, spot or directional light. Points and spots: intensity * cos / d^2, times the visible share
/// of the luminous sphere where its radius is not 0; spots fall off between the two angles as in KHR_lights_punctual
/// (clamp(cos * scale + offset)^2). Directional: color * cos, times the visible share of the sun's disk.
/// far: a length that leads out of the scene from anywhere in it.
Color irradiance_of_punctual_light(const Light& light, const Receiver& receiver, Tracer& tracer, double far,
                                   Sight& sight);

/// The same if nothing stands between, from its middle alone; at: what is seen from the receiver then.
Color unhindered_irradiance(const Light& light, const Receiver& receiver, double far, Vec3& at);

}  // namespace radvor
