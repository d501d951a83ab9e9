// A scene taken through welding and facets as a bake does, with all that these refer to.
#pragma once

#include <cstdint>
#include <numbers>
#include <utility>

#include "scene/facets.h"
#include "scene/find_contacts.h"
#include "scene/scene.h"
#include "scene/welded.h"
#include "support/test_host.h"

namespace radvor::test {

inline constexpr double k_crease_angle = std::numbers::pi / 6;

/// Its parts refer to each other, so it stays where it was made.
struct MadeFacets {
  explicit MadeFacets(Scene given, std::uint32_t threads = 2, const Log& log = Log(nullptr, nullptr))
      : host(threads, log),
        scene(std::move(given)),
        welded(weld(scene, 0, host)),
        facets(find_facets(scene, welded, k_crease_angle, host)) {}
  MadeFacets(const MadeFacets&) = delete;
  MadeFacets& operator=(const MadeFacets&) = delete;

  void add_contacts(const ContactLimits& limits) { find_contacts(scene, welded, facets, limits, host); }

  TestHost host;
  Scene scene;
  WeldedScene welded;
  Facets facets;
};

}  // namespace radvor::test
