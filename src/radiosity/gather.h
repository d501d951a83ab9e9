// What receivers see of the scene: rays over each one's hemisphere, whose hits are kept. Every bounce reads them again,
// so that only the first one casts rays; the sky is in the same rays.
//
// A link is a ray's share of the triangle that it hit: one of its three corners, drawn by the hit's barycentric
// weights. So a link is one number of 4 bytes and its factor 1 / rays, and radiosity is interpolated linearly on the
// average.
//
// Where the mesh is refined later, what a link stands for is refined with it: the ray is known by its number, its facet
// by the link, so where the two meet needs no tracing. That is put off until links are asked: refinements that follow
// one another come to one change a share, which is far less than one a link.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "radiosity/hemisphere.h"
#include "radiosity/receiver.h"
#include "radiosity/share_changes.h"
#include "radiosity/tracer.h"
#include "scene/scene.h"
#include "surface/surface.h"

namespace radvor {

/// What one receiver sees, as shares of its cosine-weighted hemisphere; the rest are hits that shoot.
struct Outlook {
  double open = 0;              ///< leads out of the scene
  double backs = 0;             ///< backs of one-sided surfaces, and meshes that do not receive
  double inverse_distance = 0;  ///< mean of 1 / distance over all rays; 0 where they miss
  double weight = 0;            ///< of one ray
};

class Gather {
 public:
  /// occluders: the welded triangle of each triangle given to the visibility. Keeps references to all
  /// arguments.
  Gather(const Scene& scene, const Facets& facets, std::span<const std::uint32_t> occluders, Host& host);

  /// A record for each of a number of receivers to come, before the surface is refined again; the first one's number.
  std::uint32_t add(std::uint32_t count);
  std::uint32_t size() const { return static_cast<std::uint32_t>(records_.size()); }

  /// Casts ray_count (a power of two) rays. Different records may be traced side by side.
  void trace(std::uint32_t record, const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed,
             const Surface& surface, Tracer& tracer);

  /// The same, of a receiver that is not kept: what it gathers of what shares shoot.
  Outlook glance(const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed, const Surface& surface,
                 std::span<const glm::vec3> radiosity, Tracer& tracer, Color& gathered) const;

  const Outlook& outlook(std::uint32_t record) const { return records_[record].outlook; }

  /// After the surface was refined. The links that there are must not be asked until they are caught up with it.
  void follow(const ShareChanges& changes);
  /// Links to shares that were divided are drawn anew: some records at a time, of about so many links. True when none
  /// is left; until then nothing may be followed. Before ties are aligned.
  bool catch_up(const Surface& surface, std::uint64_t links);

  std::uint32_t link_count(std::uint32_t record) const {
    return static_cast<std::uint32_t>(records_[record].links.size());
  }

  /// Irradiance from all that the record's links shoot, as the first link_count (a power of two) of them tell: the
  /// beginning of a net is one. radiosity: one a share, W m^-2.
  Color gather(std::uint32_t record, std::span<const glm::vec3> radiosity, std::uint32_t link_count) const;
  Color gather(std::uint32_t record, std::span<const glm::vec3> radiosity) const {
    return gather(record, radiosity, link_count(record));
  }

  /// How much what the record's rays bring differs from ray to ray: the standard deviation over the mean, all channels
  /// as one; 0 where they bring nothing.
  double spread(std::uint32_t record, std::span<const glm::vec3> radiosity) const;

 private:
  struct Record;

  void catch_up(Record& record, const Surface& surface, const ShareMoves& moves) const;
  template <class OnLink>
  Outlook look(const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed, const Surface& surface,
               Tracer& tracer, OnLink&& on_link) const;

  struct Record {
    explicit Record(std::pmr::memory_resource* memory) : links(memory) {}
    Vec3 from{0.0}, normal{0.0};  // of the hemisphere: its rays must be known again
    std::uint64_t seed = 0;
    Outlook outlook;
    std::pmr::vector<std::uint32_t> links;  // of each ray, k_none: meets nothing that shoots
  };

  const Scene& scene_;
  const Facets& facets_;
  std::span<const std::uint32_t> occluders_;
  Host& host_;
  NetOrder order_;
  std::pmr::vector<Record> records_;
  struct Behind {
    std::uint32_t end;  // of records; they begin where those before end
    ShareMoves moves;
  };
  std::pmr::vector<Behind> behind_;  // records of before the latest refinement, by how many they have seen
  std::uint32_t caught_up_ = 0;      // the first so many of them
};

}  // namespace radvor
