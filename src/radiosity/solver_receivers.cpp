// Where samples look from: near their sites for sources, farther in for what is all around; but where something covers
// a cell more closely than the cell is deep, where the light of the cell is met.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "radiosity/method.h"
#include "radiosity/solver.h"
#include "surface/receiver_point.h"

namespace radvor {

namespace {

// Of the way to the middle of its cell: a receiver that has moved so far is another one.
constexpr double k_moved = 0.25;

// Of that way, where borders look around from: light from all around may fall off within a part of the cell, and what
// is wanted is the corner of the plane that fits the cell best. Chosen by scenes (docs/transport.md, "Lookouts").
constexpr double k_lookout = 0.4;

// Receivers' leeway is at most so much, or one in so much: a vertex of a small triangle is looked at, too.
constexpr double k_most_leeway = 8;

// In a slot whose walls are `gap` apart, under uniform light from outside: how far from its mouth it is as bright as a
// cell that reaches `depth` into it is in the mean. At a distance x the form factor of the mouth, a strip seen from its
// foot, is (1 - x / hypot(x, gap)) / 2; x / hypot(x, gap) is (hypot(depth, gap) - gap) / depth in the mean. Less than
// half of the depth.
double mean_distance(double gap, double depth) {
  return depth * std::sqrt(gap / (2 * (std::hypot(depth, gap) + gap)));
}

}  // namespace

// Of a sample on a border: from its site to the middle of its cell there, which is half as deep as the cell; in the
// facet's plane, which a border's site may be off by rounding or welding. Zero for others.
Vec3 Solver::way_inside(std::uint32_t sample) const {
  const Sample& of = surface->samples()[sample];
  const Vec3 way = (of.point - surface->sites()[of.site].position) / k_nudge;
  return way - glm::dot(way, of.facet_normal) * of.facet_normal;
}

// Every sample may add as much to the area-weighted squared error.
double Solver::leeway_of(double area) const {
  return std::clamp(std::sqrt(mean_area_ / area), 1 / k_most_leeway, k_most_leeway);
}

Receiver Solver::receiver_at(std::uint32_t sample, const Vec3& point) const {
  const Sample& of = surface->samples()[sample];
  return {point, point + of.facet_normal * visibility_->lift(), of.normal, leeway_of(of.area)};
}

void Solver::place_receivers(std::span<const std::uint32_t> list) {
  receivers_.resize(surface->samples().size());
  in_slot_.resize(surface->samples().size());
  mean_area_ = receiving_area() / static_cast<double>(surface->samples().size());
  std::atomic<std::uint64_t> rays{0};
  host.jobs.for_ranges(list.size(), k_samples_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      receivers_[list[k]] = receiver_at(list[k], surface->samples()[list[k]].point);
      in_slot_[list[k]] = 0;
    }
    rays += move_into_slots(list.subspan(begin, end - begin));
  });
  stats_.rays += rays;
}

// A site at the mouth of a slot looks out of it, and its light is not that of its cell, which is dark but for a strip
// as wide as the gap; beside a contact with a gap it is half in the dark, and the cell is not. Returns rays cast.
std::uint64_t Solver::move_into_slots(std::span<const std::uint32_t> list) {
  const auto& contacts = facets->contacts.edges;
  const std::uint32_t first_contact = contacts.empty() ? k_none : contacts.front().edge;
  const double lift = visibility_->lift();
  std::pmr::vector<std::uint32_t> asked(&host.memory);
  std::pmr::vector<Sightline> above(&host.memory);
  const auto inside = [&](std::uint32_t sample, double gap) {
    const Vec3 way = way_inside(sample);
    const double length = glm::length(way);
    const double part = mean_distance(gap, 2 * length) / length;
    return receiver_at(sample, surface->samples()[sample].point + std::max(part - k_nudge, 0.0) * way);
  };
  for (const std::uint32_t sample : list) {
    const double depth = 2 * glm::length(way_inside(sample));
    if (!(depth > 16 * lift)) {
      continue;  // inside its facet, or too small for rays to tell
    }
    const std::uint32_t edge = surface->sites()[surface->samples()[sample].site].edge;
    const bool one_sided = !scene.materials[facets->facets[surface->samples()[sample].facet].material].two_sided;
    const double gap = edge != k_none && edge >= first_contact ? contacts[edge - first_contact].gap : 0;
    if (gap > 0 && gap < depth && one_sided) {  // else the gap may be on the other side
      receivers_[sample] = inside(sample, gap);
      in_slot_[sample] = 1;
    } else {
      const Vec3& from = receivers_[sample].lifted;
      asked.push_back(sample);
      above.push_back({from, from + depth * surface->samples()[sample].facet_normal});
    }
  }
  std::pmr::vector<std::uint8_t> covered(asked.size(), &host.memory);
  visibility_->blocked(above, covered.data());
  std::uint64_t rays = asked.size();
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (covered[k] != 0) {
      const Vec3& up = surface->samples()[asked[k]].facet_normal;
      const double gap = visibility_->first_hit(receivers_[asked[k]].lifted, up).distance + lift;
      const Receiver moved = inside(asked[k], gap);
      const Sightline over{moved.lifted, moved.lifted + 2 * gap * up};
      std::uint8_t still = 0;
      visibility_->blocked({&over, 1}, &still);
      if (still != 0) {
        receivers_[asked[k]] = moved;
        in_slot_[asked[k]] = 1;
      }
      rays += 2;
    }
  }
  return rays;
}

// Samples that are to look around move on, inside their cells, unless they are in slots or something stands in the way.
// Sources' light has been taken: that is exact where it is taken, and the fit makes the best of it, but what comes from
// all around is not asked for again.
void Solver::move_to_lookouts(std::span<const std::uint32_t> list) {
  std::atomic<std::uint64_t> rays{0};
  host.jobs.for_ranges(list.size(), k_samples_a_task, [&](std::size_t begin, std::size_t end) {
    std::pmr::vector<std::uint32_t> moving(&host.memory);
    std::pmr::vector<Sightline> ways(&host.memory);
    for (std::size_t k = begin; k < end; ++k) {
      const Vec3 way = way_inside(list[k]);
      if (in_slot_[list[k]] == 0 && glm::length(way) > 8 * visibility_->lift()) {
        const Vec3& from = receivers_[list[k]].lifted;
        moving.push_back(list[k]);
        ways.push_back({from, from + (k_lookout - k_nudge) * way});
      }
    }
    std::pmr::vector<std::uint8_t> blocked(moving.size(), &host.memory);
    visibility_->blocked(ways, blocked.data());
    rays += moving.size();
    for (std::size_t k = 0; k < moving.size(); ++k) {
      Receiver& receiver = receivers_[moving[k]];
      if (blocked[k] == 0) {
        receiver = receiver_at(moving[k], receiver.point + (ways[k].to - ways[k].from));
      }
    }
  });
  stats_.rays += rays;
}

// After a refinement. Each looks from where its light was taken last. Until there are hemispheres, the light of a
// sample that is to look from elsewhere now, because its cell is no longer as deep, is due again.
void Solver::follow_receivers(std::span<const SampleOrigin> origins) {
  due_again_.clear();
  renumber(receivers_, origins, Receiver{});
  renumber(in_slot_, origins, std::uint8_t{0});
  if (looking_) {
    place_receivers(pending_);
    return;
  }
  // The others lie where they did, and in no slot.
  std::pmr::vector<std::uint8_t> to_place(origins.size(), 0, &host.memory);
  host.jobs.for_ranges(origins.size(), k_samples_a_task, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      const Receiver here = receiver_at(i, surface->samples()[i].point);
      const Receiver& now = receivers_[i];
      to_place[i] =
          !origins[i].kept || in_slot_[i] != 0 || here.point != now.point || here.lifted != now.lifted ? 1 : 0;
    }
  });
  std::pmr::vector<std::uint32_t> placed(&host.memory);
  struct Before {
    Receiver receiver;
    std::uint8_t in_slot;
  };
  std::pmr::vector<Before> before(&host.memory);  // of each that is placed
  for (std::uint32_t i = 0; i < origins.size(); ++i) {
    if (to_place[i] != 0) {
      placed.push_back(i);
      before.push_back({receivers_[i], in_slot_[i]});
    }
  }
  place_receivers(placed);
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const std::uint32_t i = placed[k];
    if (!origins[i].kept) {
      continue;
    }
    if (glm::distance(before[k].receiver.point, receivers_[i].point) > k_moved * glm::length(way_inside(i))) {
      due_again_.push_back({i, direct[i]});
      direct[i] = Color(0.0);
      sights_[i] = 0;
      pending_.push_back(i);
    } else {
      receivers_[i] = before[k].receiver;
      in_slot_[i] = before[k].in_slot;
    }
  }
}

}  // namespace radvor
