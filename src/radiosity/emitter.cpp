#include "radiosity/emitter.h"

#include <cstddef>
#include <optional>

#include "radiosity/clipped_form_factor.h"
#include "radiosity/form_factor.h"

namespace radvor {

namespace {

struct Part {
  std::array<Vec3, 3> corners;
  double form_factor;
  int depth;
};

// The four children of a triangle, cut at the midpoints of its sides; the last is the middle one.
std::array<std::array<Vec3, 3>, 4> quarter(const std::array<Vec3, 3>& t) {
  const Vec3 ab = 0.5 * (t[0] + t[1]), bc = 0.5 * (t[1] + t[2]), ca = 0.5 * (t[2] + t[0]);
  return {{{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {bc, ca, ab}}};
}

Vec3 centre(const std::array<Vec3, 3>& t) {
  return (t[0] + t[1] + t[2]) / 3.0;
}

constexpr std::size_t k_max_clipped = 64;  // occluders; rays where there are more
constexpr std::size_t k_few_clipped = 12;  // exact without any ray; behind a crowd sixteen blocked rays mean dark
constexpr double k_exact_leeway = 1.5;     // with more of it a crowd's rays are cheaper, and good enough
constexpr int k_max_depth = 7;
// Where rays disagree, of the tolerance: a part of a part worth less stays whole. A penumbra has some 2^depth such
// parts with independent errors, of which a fraction is in doubt. (By 1, staircase takes twice the rays for the same
// error: tests/scenes.py staircase --direct.)
constexpr double k_may_stay = 3;
// Of the tolerance: what is worth less is not clipped, but asked by rays.
constexpr double k_clipped = 0.25;
constexpr std::size_t k_stack = 3 * k_max_depth + 5;

// Up to four parts of one emitter or panel, seen together: 4 rays each make one packet of 16.
struct Verdict {
  double kernel_seen = 0, kernel_all = 0;
};

Sight look(const Emitter& emitter, const Receiver& receiver, Tracer& tracer, std::span<const Part> parts,
           std::array<Verdict, 4>& verdicts) {
  std::array<Vec3, 16> targets;
  std::array<double, 16> weights;
  std::array<std::size_t, 16> owner;
  std::array<std::uint8_t, 16> blocked;
  std::size_t count = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const auto& child : quarter(parts[p].corners)) {
      const Vec3 point = centre(child);
      const double weight = kernel(receiver.point, receiver.normal, point, emitter.normal);
      if (weight <= 0 && tracer.skips.facing) {
        ++tracer.counters.skipped_facing;
        continue;
      }
      targets[count] = point + emitter.normal * tracer.lift();
      weights[count] = weight;
      owner[count++] = p;
    }
  }
  tracer.blocked_from(receiver.lifted, std::span(targets.data(), count), blocked.data());
  Sight sight;
  for (std::size_t k = 0; k < count; ++k) {
    if (weights[k] <= 0) {  // points under the horizon are not blocked: they are not there
      ++tracer.counters.idle_rays;
      continue;
    }
    Verdict& verdict = verdicts[owner[k]];
    verdict.kernel_all += weights[k];
    verdict.kernel_seen += blocked[k] ? 0 : weights[k];
    sight.add({blocked[k] == 0, blocked[k] != 0});
  }
  return sight;
}

// Whether rays to sixteen points of the emitter's polygon, which has three corners or four, are all blocked; points
// under the horizon do not count.
bool looks_dark(const Emitter& emitter, std::span<const Vec3> polygon, const Receiver& receiver, Tracer& tracer) {
  std::array<Part, 4> parts;
  if (polygon.size() == 3) {
    std::size_t count = 0;
    for (const auto& corners : quarter({polygon[0], polygon[1], polygon[2]})) {
      parts[count++] = {corners, 0, 1};
    }
  } else {
    const Vec3 middle = 0.25 * (polygon[0] + polygon[1] + polygon[2] + polygon[3]);
    for (std::size_t k = 0; k < 4; ++k) {
      parts[k] = {{middle, polygon[k], polygon[(k + 1) % 4]}, 0, 1};
    }
  }
  std::array<Verdict, 4> verdicts;
  const Sight sight = look(emitter, receiver, tracer, parts, verdicts);
  return sight.hidden && !sight.open;
}

// A form factor that is worth the tolerance.
double tolerable_part(const Emitter& emitter, const EmitterAccuracy& accuracy, const Receiver& receiver) {
  return receiver.leeway * accuracy.tolerance * accuracy.mean_irradiance / luminance(emitter.radiosity);
}

// What is seen of the emitter's polygon past few occluders, or the dark behind a crowd. whole: its form factor.
std::optional<double> seen_exactly(const Emitter& emitter, std::span<const Vec3> polygon, double whole,
                                   const Receiver& receiver, Tracer& tracer, const OccluderTree& occluders) {
  const auto clip = [&](std::size_t most) {
    return clipped_form_factor(receiver, polygon, emitter.normal, whole, most, tracer, occluders);
  };
  if (const auto seen = clip(k_few_clipped)) {
    return seen;
  }
  if (looks_dark(emitter, polygon, receiver, tracer)) {
    return 0;
  }
  return receiver.leeway > k_exact_leeway ? std::nullopt : clip(k_max_clipped);
}

// By rays alone. whole: the emitter's form factor, more than 0.
double seen_by_rays(const Emitter& emitter, const Receiver& receiver, Tracer& tracer, double tolerable, Sight& sight) {
  const double may_stay = k_may_stay * tolerable;
  double visible = 0;
  std::array<Part, k_stack> stack;  // parts to be quartered
  std::size_t size = 0;

  // Where all rays of a group agree, so do its parts. Otherwise every part that matters is quartered, those whose own
  // four rays agree too: a straight edge may cut off a corner between them, the same in all parts along it.
  const auto settle = [&](std::span<const Part> parts) {
    std::array<Verdict, 4> verdicts;
    const Sight of_all = look(emitter, receiver, tracer, parts, verdicts);
    sight.add(of_all);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const Verdict& verdict = verdicts[p];
      if (of_all.open && !of_all.hidden) {
        visible += parts[p].form_factor;
      } else if (of_all.hidden && !of_all.open) {
        continue;
      } else if (parts[p].depth < k_max_depth && (parts[p].form_factor > may_stay || !tracer.skips.negligible)) {
        stack[size++] = parts[p];
      } else {
        tracer.counters.skipped_negligible += parts[p].depth < k_max_depth ? 1 : 0;
        visible += verdict.kernel_all > 0 ? parts[p].form_factor * verdict.kernel_seen / verdict.kernel_all : 0;
      }
    }
  };

  // What is above the horizon: one triangle or two.
  std::array<Vec3, 4> corners;
  const std::size_t corner_count = cut_at_horizon(receiver, emitter.corners, corners);
  for (std::size_t i = 2; i < corner_count; ++i) {
    const std::array<Vec3, 3> triangle = {corners[0], corners[i - 1], corners[i]};
    const Part root{triangle, polygon_form_factor(receiver.point, receiver.normal, triangle, emitter.normal), 0};
    if (root.form_factor > tolerable || (root.form_factor > 0 && !tracer.skips.negligible)) {
      stack[size++] = root;  // what matters gets 16 rays at least, in 4 parts
    } else if (root.form_factor > 0) {
      ++tracer.counters.skipped_negligible;
      settle(std::span(&root, 1));
    }
  }
  while (size > 0) {
    const Part part = stack[--size];
    std::array<Part, 4> children;
    std::size_t count = 0;
    for (const auto& quarter_corners : quarter(part.corners)) {
      const double form_factor = polygon_form_factor(receiver.point, receiver.normal, quarter_corners, emitter.normal);
      ++tracer.counters.form_factors;
      if (form_factor > 0) {
        children[count++] = {quarter_corners, form_factor, part.depth + 1};
      }
    }
    settle(std::span(children.data(), count));
  }
  return visible;
}

// Rays to an emitter that turns its back, or lies under the horizon, where that is no reason to cast none.
void look_in_vain(const Emitter& emitter, const Receiver& receiver, Tracer& tracer) {
  if (tracer.skips.facing) {
    ++tracer.counters.skipped_facing;
    return;
  }
  const Part turned_away{emitter.corners, 0, 0};
  std::array<Verdict, 4> verdicts;
  look(emitter, receiver, tracer, std::span(&turned_away, 1), verdicts);
}

}  // namespace

Color irradiance_of_emitter(const Emitter& emitter, const Receiver& receiver, Tracer& tracer,
                            const EmitterAccuracy& accuracy, const OccluderTree* occluders, Sight& sight) {
  const double whole = polygon_form_factor(receiver.point, receiver.normal, emitter.corners, emitter.normal);
  ++tracer.counters.form_factors;
  if (whole <= 0) {
    look_in_vain(emitter, receiver, tracer);
    return Color(0.0);
  }
  const double tolerable = tolerable_part(emitter, accuracy, receiver);
  if (occluders != nullptr && whole > k_clipped * tolerable) {  // exact, and cheaper than the rays of a penumbra
    if (const auto seen = seen_exactly(emitter, emitter.corners, whole, receiver, tracer, *occluders)) {
      sight = {*seen > 0, *seen < whole};
      return emitter.radiosity * *seen;
    }
  }
  return emitter.radiosity * seen_by_rays(emitter, receiver, tracer, tolerable, sight);
}

Color irradiance_of_panel(std::span<const Emitter, 2> halves, std::span<const Vec3> polygon, const Receiver& receiver,
                          Tracer& tracer, const EmitterAccuracy& accuracy, const OccluderTree* occluders,
                          Sight& sight) {
  const double whole = polygon_form_factor(receiver.point, receiver.normal, polygon, halves[0].normal);
  ++tracer.counters.form_factors;
  if (whole <= 0) {
    look_in_vain(halves[0], receiver, tracer);
    look_in_vain(halves[1], receiver, tracer);
    return Color(0.0);
  }
  if (occluders != nullptr && whole > k_clipped * tolerable_part(halves[0], accuracy, receiver)) {
    if (const auto seen = seen_exactly(halves[0], polygon, whole, receiver, tracer, *occluders)) {
      sight = {*seen > 0, *seen < whole};
      return halves[0].radiosity * *seen;
    }
  }
  Color sum(0.0);
  for (const Emitter& half : halves) {
    Sight of_half;
    sum += irradiance_of_emitter(half, receiver, tracer, accuracy, nullptr, of_half);
    sight.add(of_half);
  }
  return sum;
}

}  // namespace radvor
