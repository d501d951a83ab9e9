#include "surface/surface.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/floating_point.h"
#include "surface/facet_location.h"
#include "surface/first_levels.h"
#include "surface/locate_together.h"
#include "surface/make_surface.h"
#include "surface/refinement.h"
#include "surface/surface_parts.h"
#include "surface/triangle_cells.h"

namespace radvor {

struct Surface::State : SurfaceParts {
  using SurfaceParts::SurfaceParts;

  std::optional<Refinement> refinement;  // what it needs to know is found out when it is first used

  // What refinement raised and is wanted becomes triangles, shares and samples.
  Steps remake(std::uint32_t max_sites, std::span<const WantedSite> wanted, Remaking& remaking, Pace& pace) {
    first_of_patch.clear();
    patch_members.clear();
    refinement->insert(wanted, max_sites);
    const ChangedFacets changed = refinement->take_changes();
    co_await remake_surface(*this, changed, remaking, pace);
  }

  // Facet by facet: wherever it pauses, each is as it was or aligned.
  Steps align_ties(std::span<const double> value_of, double tolerance, Ties& ties, Pace& pace);
};

// Outside of the class: clang 14 with sanitizers has no section for what is inlined of a coroutine within another.
Steps Surface::State::align_ties(std::span<const double> value_of, double tolerance, Ties& ties, Pace& pace) {
  constexpr double k_hexagonal_rounding = 0x1p-10;
  const double least = options.lattice == Lattice::hexagonal ? k_hexagonal_rounding : 0;
  std::pmr::vector<double> values(memory);
  values.reserve(shares.size());
  for (const Share& share : shares) {
    values.push_back(value_of[share.sample]);
  }
  std::pmr::vector<Ties> of_mesh(meshes.size(), memory);
  constexpr double k_task = 512;
  const auto weight = [&](std::uint32_t k) {
    return 1.0 + static_cast<double>(meshes[k] ? meshes[k]->triangles().size() : 0);
  };
  const EvenRanges ranges(of_mesh.size(), k_task, weight, memory);
  const auto align = [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t k = begin; k < end; ++k) {
      if (meshes[k] && !meshes[k]->degenerate()) {
        of_mesh[k] = meshes[k]->align_ties(values, std::max(tolerance, least), memory);
      }
    }
  };
  co_await ranges.for_each(host.jobs, align, pace);
  for (const Ties& of : of_mesh) {
    ties.count += of.count;
    ties.realigned += of.realigned;
  }
}

namespace {

// The environment is set for as long as the steps run, and is the caller's where they pause.
bool go_on(Steps& steps) {
  const FloatingPointGuard guard(Denormals::keep);
  return steps.go_on();
}

}  // namespace

Surface::Surface(const Scene& scene, const WeldedScene& welded, const Facets& facets, const SurfaceOptions& options,
                 Host& host)
    : memory_(&host.memory) {
  const FloatingPointGuard guard(Denormals::keep);
  std::pmr::polymorphic_allocator<> allocator(memory_);
  state_ = allocator.new_object<State>(scene, welded, facets, options, host);
  try {
    draft_surface(*state_);
    if (options.raises_first) {
      raise_first_levels(*this, options, memory_);
    }
    finish_surface(*state_, state_->refinement ? state_->refinement->take_changes() : ChangedFacets(memory_));
  } catch (...) {
    allocator.delete_object(state_);
    throw;
  }
}

Surface::~Surface() {
  std::pmr::polymorphic_allocator<>(memory_).delete_object(state_);
}

std::pmr::vector<SampleOrigin> Surface::refine(std::span<const std::uint32_t> sites, std::uint32_t max_sites,
                                               std::span<const WantedSite> wanted) {
  Pace pace(memory_);
  std::pmr::vector<SampleOrigin> origins(memory_);
  refine(sites, max_sites, wanted, origins, pace).finish();
  return origins;
}

Steps Surface::refine(std::span<const std::uint32_t> sites, std::uint32_t max_sites, std::span<const WantedSite> wanted,
                      std::pmr::vector<SampleOrigin>& origins, Pace& pace) {
  for (const WantedSite& wish : wanted) {
    if (wish.facet >= state_->records.size()) {
      throw Error(ErrorCode::invalid_argument, "there is no facet %u", wish.facet);
    }
  }
  co_await raise(sites, max_sites, pace);
  Remaking remaking(memory_);
  Steps steps = state_->remake(max_sites, wanted, remaking, pace);
  while (go_on(steps)) {
    if (remaking.before) {
      remaking.before->trade_places(*state_);
    }
    co_await pace;
    if (remaking.before) {
      remaking.before->trade_places(*state_);
    }
  }
  origins = std::move(remaking.origins);
}

void Surface::raise(std::span<const std::uint32_t> sites, std::uint32_t max_sites) {
  Pace pace(memory_);
  raise(sites, max_sites, pace).finish();
}

Steps Surface::raise(std::span<const std::uint32_t> sites, std::uint32_t max_sites, Pace& pace) {
  for (const std::uint32_t site : sites) {
    if (site >= state_->sites.size()) {
      throw Error(ErrorCode::invalid_argument, "there is no site %u", site);
    }
  }
  if (!state_->refinement) {
    const FloatingPointGuard guard(Denormals::keep);
    state_->refinement.emplace(*state_);
  }
  Steps steps = state_->refinement->raise(sites, max_sites, pace);
  while (go_on(steps)) {
    co_await pace;
  }
}

Ties Surface::align_ties(std::span<const double> value_of, double tolerance) {
  Pace pace(memory_);
  Ties ties;
  align_ties(value_of, tolerance, ties, pace).finish();
  return ties;
}

Steps Surface::align_ties(std::span<const double> value_of, double tolerance, Ties& ties, Pace& pace) {
  if (value_of.size() != state_->samples.size()) {
    throw Error(ErrorCode::invalid_argument, "%zu values for %zu samples", value_of.size(), state_->samples.size());
  }
  Steps steps = state_->align_ties(value_of, tolerance, ties, pace);
  while (go_on(steps)) {
    co_await pace;
  }
}

std::uint32_t Surface::level_of(std::uint32_t site) const {
  return state_->levels[site];
}

std::uint32_t Surface::max_level() const {
  return refinements(state_->options);
}

std::span<const Site> Surface::sites() const {
  return state_->sites;
}

std::span<const Sample> Surface::samples() const {
  return state_->samples;
}

std::span<const Share> Surface::shares() const {
  return state_->shares;
}

void Surface::group_patches() {
  const FloatingPointGuard guard(Denormals::keep);
  make_patches(*state_);
}

std::uint32_t Surface::patch_count() const {
  return state_->first_of_patch.empty() ? 0 : static_cast<std::uint32_t>(state_->first_of_patch.size() - 1);
}

std::span<const std::uint32_t> Surface::patch(std::uint32_t patch) const {
  const std::uint32_t first = state_->first_of_patch[patch];
  return std::span(state_->patch_members).subspan(first, state_->first_of_patch[patch + 1] - first);
}

std::span<const ShareTriangle> Surface::triangles(std::uint32_t facet) const {
  return state_->triangles_of(facet);
}

std::uint32_t Surface::triangle_count() const {
  std::size_t count = 0;
  for (std::uint32_t facet = 0; facet < state_->records.size(); ++facet) {
    count += state_->triangles_of(facet).size();
  }
  return static_cast<std::uint32_t>(count);
}

std::uint32_t Surface::constraint_count() const {
  std::uint32_t count = 0;
  for (std::uint32_t facet = 0; facet < state_->records.size(); ++facet) {
    const FacetMesh* mesh = state_->triangulated(facet);
    count += mesh ? mesh->triangulation().constraint_count() : 0;
  }
  return count;
}

void Surface::cell(std::uint32_t index, std::pmr::vector<Vec3>& polygon) const {
  const Share& share = state_->shares[index];
  const Frame& frame = state_->facets.facets[share.facet].frame;
  const FacetRecord& record = state_->records[share.facet];
  const std::uint32_t front = share.back ? share.other_side : index;
  polygon.clear();
  const auto append = [&](const Vec2& point) { polygon.push_back(frame.to_world(point)); };
  const FacetMesh* mesh = state_->triangulated(share.facet);
  if (!mesh) {
    const std::uint32_t number = front - record.first_share;
    const LocatedFacet facet = state_->located(share.facet);
    const auto cells = triangle_cells(facet.corners(facet.triangles[number / 3]));
    const CornerCell& cell = cells[number % 3];
    std::for_each(cell.points.begin(), cell.points.begin() + cell.count, append);
  } else {
    alignas(std::max_align_t) std::byte room[4096];
    std::pmr::monotonic_buffer_resource scratch(room, sizeof room, memory_);
    delaunay::CellBuffer buffer(&scratch);
    const auto points = mesh->cell(share.vertex, front, buffer);
    std::for_each(points.begin(), points.end(), append);
  }
  if (share.back) {
    std::reverse(polygon.begin(), polygon.end());
  }
}

FacetPoint Surface::locate(std::uint32_t facet, const Vec2& point) const {
  return state_->located(facet).locate(point);
}

void Surface::locate(std::span<const PlanePoint> points, FacetPoint* found) const {
  locate_together(*state_, points, found);
}

std::optional<FacetPoint> Surface::find(std::uint32_t facet, const Vec2& point) const {
  return state_->located(facet).find(point);
}

const Scene& Surface::scene() const {
  return state_->scene;
}

const WeldedScene& Surface::welded() const {
  return state_->welded;
}

const Facets& Surface::facets() const {
  return state_->facets;
}

}  // namespace radvor
