#include "surface/fill_shares.h"

#include <atomic>

#include "surface/receiver_point.h"
#include "surface/shading.h"
#include "surface/triangle_cells.h"

namespace radvor {

namespace {

class ShareFiller {
 public:
  explicit ShareFiller(SurfaceParts& parts) : parts_(parts) {}

  // How many albedos were clamped.
  std::uint32_t fill(std::uint32_t facet) {
    return parts_.records[facet].mesh == k_none ? fill_small(facet) : fill_meshed(facet);
  }

 private:
  std::uint32_t fill_small(std::uint32_t facet) {
    const FacetInput input = parts_.input(facet);
    const FacetShading shading(input);
    const std::uint32_t triangle = parts_.facets.triangles_of(facet).front();
    const auto& vertices = parts_.welded.triangles[triangle].vertices;
    const Frame& frame = input.facet().frame;
    std::array<Vec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = frame.to_plane(parts_.welded.positions[vertices[k]]);
    }
    const auto cells = triangle_cells(corners);
    std::uint32_t clamped = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      FacetShare share;
      share.vertex = k;
      share.site = parts_.borders.at_vertex(vertices[k]);
      share.centroid = cells[k].centroid;
      share.receiver = corners[k] + k_nudge * (cells[k].centroid - corners[k]);
      share.area = cells[k].area;
      clamped += fill(facet, k, share, shading.at_corner(triangle, k));
    }
    return clamped;
  }

  std::uint32_t fill_meshed(std::uint32_t facet) {
    const FacetInput input = parts_.input(facet);
    FacetShading shading(input);
    FacetDraft& draft = parts_.drafts[parts_.records[facet].mesh];
    std::uint32_t clamped = 0;
    for (std::uint32_t k = 0; k < draft.shares.size(); ++k) {
      const FacetShare& share = draft.shares[k];
      clamped +=
          fill(facet, k, share,
               share.source.triangle == k_none ? shading.inside(share.position)
                                               : shading.on_side(share.source, parts_.sites[share.site].position));
    }
    draft.let_go();
    parts_.meshes[parts_.records[facet].mesh]->prepare_location();
    return clamped;
  }

  // Both sides of a share; 1 where its albedo was clamped.
  std::uint32_t fill(std::uint32_t facet, std::uint32_t number, const FacetShare& drafted, const Shading& shading) {
    const FacetRecord& record = parts_.records[facet];
    const Frame& frame = parts_.facets.facets[facet].frame;
    const std::uint32_t front = record.first_share + number;
    const std::uint32_t back = front + record.share_count;
    Share share{};
    share.centroid = frame.to_world(drafted.centroid);
    share.albedo = shading.albedo;
    share.area = drafted.area;
    share.sample = k_none;
    share.facet = facet;
    share.patch = k_none;
    share.vertex = drafted.vertex;
    share.other_side = record.two_sided ? back : k_none;
    put(front, share, drafted, shading.normal, frame);
    if (record.two_sided) {
      share.other_side = front;
      share.back = true;
      put(back, share, drafted, -shading.normal, frame);
    }
    return shading.clamped ? 1 : 0;
  }

  void put(std::uint32_t index, const Share& share, const FacetShare& drafted, const Vec3& normal, const Frame& frame) {
    parts_.shares[index] = share;
    parts_.details.site[index] = drafted.site;
    parts_.details.normal[index] = normal;
    parts_.details.receiver[index] = frame.to_world(drafted.receiver);
  }

  SurfaceParts& parts_;
};

}  // namespace

Steps fill_shares(SurfaceParts& parts, std::span<const std::uint32_t> facets, Pace& pace) {
  constexpr double k_task = 2000;
  const EvenRanges ranges(
      facets.size(), k_task, [&](std::uint32_t k) { return static_cast<double>(parts.records[facets[k]].share_count); },
      parts.memory);
  std::atomic<std::uint32_t> clamped{0};
  const auto fill = [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
    ShareFiller filler(parts);
    std::uint32_t clamped_here = 0;
    for (std::uint32_t k = begin; k < end; ++k) {
      clamped_here += filler.fill(facets[k]);
    }
    clamped += clamped_here;
  };
  co_await ranges.for_each(parts.host.jobs, fill, pace);
  if (clamped > 0) {
    parts.host.log(LogLevel::warning, "albedo above %g is taken as that, at %u elements", k_most_albedo,
                   clamped.load());
  }
}

}  // namespace radvor
