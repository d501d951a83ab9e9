// The surface: every facet's Delaunay triangulation of sites, the Voronoi cells that give each site its area, and the
// samples and patches that light is solved on. It knows no light.
//
//   facet --has--> triangulation of sites --corner of a triangle--> share --part of--> sample
//
// A *sample* is what receives (one per sector of a site, per side, shared over smooth edges); a *share* is the part
// of a sample that lies in one facet: its clipped Voronoi cell there, with the facet's albedo. Shares are what shoots:
// the elements. A *patch* is a group of shares that shoot together.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/host.h"
#include "base/steps.h"
#include "base/vector.h"
#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

enum class Lattice : std::uint32_t { hexagonal = 0, quadrilateral = 1 };

/// All resolved: no zero means "default" any more (spacing.h does that).
struct SurfaceOptions {
  Lattice lattice = Lattice::hexagonal;
  double patch_spacing = 1;          ///< between level-0 sites, scene units
  std::uint32_t element_levels = 2;  ///< the first elements' lattice has patch_spacing / 2^element_levels
  double min_spacing = 0;            ///< refinement stops here
  std::uint32_t border_levels = 0;   ///< that sites on sharp edges are raised by before there is light
  double contact_spacing = 0;        ///< gaps narrower than this are resolved to this alone before there is light
  bool raises_first = false;         ///< whether borders and contacts are raised so, before there are shares
  std::uint32_t max_sites = 0;       ///< at which that ends (first_levels.h); 0: no limit
};

/// About what a share or sample takes in a pass over all of them that can't be left off, for Pace::time_for.
inline constexpr double k_seconds_of_pass = 3e-7;

struct Site {
  Vec3 position;                  ///< the same bits for all facets that share it
  std::uint32_t vertex = k_none;  ///< welded vertex, or k_none
  std::uint32_t edge = k_none;    ///< welded edge that it lies inside, or k_none
  /// Sites whose midpoint it is, where a refinement made it and both were there after it; else k_none.
  std::array<std::uint32_t, 2> parents = {k_none, k_none};
  std::uint8_t level = 0;  ///< how often the first lattice was refined to make it
};

struct Sample {
  Vec3 point;         ///< receiver point: on `facet`, nudged from the site into its cell; not lifted. In slots
                      ///< light is taken elsewhere, and what is all around farther inside
  Vec3 normal;        ///< unit shading normal on this side
  Vec3 facet_normal;  ///< unit normal of `facet` on this side: the direction to lift along
  double area = 0;    ///< sum over its shares
  std::uint32_t site;
  std::uint32_t facet;                 ///< of its largest share
  std::uint32_t first_share = k_none;  ///< list through Share::next_in_sample
};

struct Share {
  Vec3 centroid;    ///< of its cell, world space
  Color albedo;     ///< material times vertex colour at the site, at most 0.99
  double area = 0;  ///< of its cell
  std::uint32_t sample;
  std::uint32_t facet;
  std::uint32_t patch;   ///< once they are grouped
  std::uint32_t vertex;  ///< in the facet's triangulation
  std::uint32_t next_in_sample = k_none;
  std::uint32_t other_side = k_none;  ///< the same cell seen from the other side of a two-sided facet
  bool back = false;
};

/// Where the light that a sample had before a refinement comes from: samples of the surface as it was then.
struct SampleOrigin {
  std::array<std::uint32_t, 3> samples;
  std::array<float, 3> weights;  ///< >= 0, sum 1
  bool kept;                     ///< the sample was there: it is samples[0], with weight 1
};

/// A point inside of a facet where a site is wanted: on a shadow's edge.
struct WantedSite {
  std::uint32_t facet;
  Vec3 position;  ///< projected into the facet's plane
};

/// A facet's triangles. Corners name the front's share (its site, sample and albedo follow; the back's is other_side).
using ShareTriangle = std::array<std::uint32_t, 3>;

/// Polygons of four sites or more on one empty circle, or nearly so.
struct Ties {
  std::uint32_t count = 0;
  std::uint32_t realigned = 0;  ///< their diagonals are not what they were without values
};

/// Where a point of a facet lies among its triangles.
struct FacetPoint {
  ShareTriangle shares;
  std::array<double, 3> weights;  ///< barycentric, clamped to the triangle, sum 1
};

/// A point of a facet's plane.
struct PlanePoint {
  std::uint32_t facet;
  Vec2 at;
};

class Surface {
 public:
  /// Facets of meshes that do not receive have no sites. Borders are sampled from each edge's midpoint outward,
  /// identically from all sides; facets smaller than the spacing keep their corners (and a single triangle then needs
  /// no triangulation of its own). What rises before there is light does so before there are shares. Keeps references
  /// to all arguments but options.
  Surface(const Scene& scene, const WeldedScene& welded, const Facets& facets, const SurfaceOptions& options,
          Host& host);
  ~Surface();

  std::span<const Site> sites() const;
  std::span<const Sample> samples() const;
  std::span<const Share> shares() const;
  /// Groups the shares into patches, anew after each refinement: most refinements are not followed by a shot. Before
  /// that there are none, and Share::patch says nothing.
  /// Parts of a facet that see no site of level 0 are told apart by the triangles as they are, aligned ties too.
  void group_patches();
  std::uint32_t patch_count() const;
  /// Shares of one patch, ascending.
  std::span<const std::uint32_t> patch(std::uint32_t patch) const;
  /// Counter-clockwise about the facet's front; empty where the mesh does not receive.
  std::span<const ShareTriangle> triangles(std::uint32_t facet) const;
  std::uint32_t triangle_count() const;
  std::uint32_t constraint_count() const;

  /// Raises the level around sites by one, in the order given: each inserts its missing neighbours of the next level,
  /// on its facets' lattices (refinement.h) and on its borders. Sites near by that would lag by two levels are raised
  /// first, across borders too. Sites keep their numbers and new ones are appended; shares, samples and
  /// triangles are numbered anew. Which sites there are depends on the levels that sites were raised to, never on
  /// the order or the rounds.
  ///
  /// Sites at max_level() stay. max_sites (0: no limit): the first site whose raising would lead beyond it, and those
  /// that follow, are left as they are. Takes time for the facets that change, and a pass over all samples.
  /// Returns an origin for each sample. Throws Error (invalid_argument) for a site that there is not; whatever else it
  /// throws leaves a surface that can only be destroyed.
  /// wanted: sites to insert off the lattice then, on facets that are triangulated; one that is nearer than a quarter
  /// of the smallest spacing to a border or to another site is left out. They keep their place, are of the level of
  /// what is around them, and shoot for the patch that they lie in. The lattice keeps half its spacing from them from
  /// then on.
  std::pmr::vector<SampleOrigin> refine(std::span<const std::uint32_t> sites, std::uint32_t max_sites = 0,
                                        std::span<const WantedSite> wanted = {});

  /// The same in steps, whose arguments must be there until they are done. Between them the surface may be read but not
  /// changed: sites() and level_of() tell of what is raised already, all else is as it was before, without patches.
  Steps refine(std::span<const std::uint32_t> sites, std::uint32_t max_sites, std::span<const WantedSite> wanted,
               std::pmr::vector<SampleOrigin>& origins, Pace& pace);

  /// The first part of refine(): what it does to sites shows at once, in sites() and level_of(); all else is as it was
  /// until the next refine(), be it one of no sites. For those who know what to raise without light, or to rise twice.
  void raise(std::span<const std::uint32_t> sites, std::uint32_t max_sites = 0);
  Steps raise(std::span<const std::uint32_t> sites, std::uint32_t max_sites, Pace& pace);

  /// How often the surroundings of a site were refined: at least its own level, at most max_level(). Levels of sites
  /// that are joined by an edge differ by at most one.
  std::uint32_t level_of(std::uint32_t site) const;
  /// From min_spacing; the spacing there is the first elements' halved so many times.
  std::uint32_t max_level() const;

  /// Ties follow the light, for output: the diagonals of every polygon whose sites lie on one circle join those of most
  /// similar value. What is nearly a tie counts: where an in-circle determinant is at most `tolerance` of the sum of
  /// its terms' magnitudes, 0 to 1, or of what its triangle's area makes of that where it is thin; on the hexagonal
  /// lattice at most 2^-10 always, as its steps are rounded to 12 bits. value_of: per sample, finite or NaN (its
  /// polygons stay as they are); fronts count. triangles() changes and nothing else; refine() undoes it on the facets
  /// that it changes.
  Ties align_ties(std::span<const double> value_of, double tolerance);
  /// The same in steps, between which a facet's are aligned or not. ties: added to.
  Steps align_ties(std::span<const double> value_of, double tolerance, Ties& ties, Pace& pace);

  /// The share's cell, counter-clockwise about its own side's normal, star-shaped about its site; replaces polygon.
  /// Areas of a facet's cells sum to its area to 1e-12; each point belongs to the nearest site that it sees.
  void cell(std::uint32_t share, std::pmr::vector<Vec3>& polygon) const;

  /// The triangle of a facet at a point of its plane (the nearest where rounding puts the point outside).
  FacetPoint locate(std::uint32_t facet, const Vec2& point) const;
  /// The same of many, for less than one after the other: found[i] of points[i]; off by a float's rounding at the
  /// facet's size.
  void locate(std::span<const PlanePoint> points, FacetPoint* found) const;
  /// The same; nothing where the point is beside the facet, or it takes long to say.
  std::optional<FacetPoint> find(std::uint32_t facet, const Vec2& point) const;

  const Scene& scene() const;
  const WeldedScene& welded() const;
  const Facets& facets() const;

 private:
  struct State;
  State* state_;
  std::pmr::memory_resource* memory_;
};

}  // namespace radvor
