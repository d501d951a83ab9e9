// A bake for tests of internals: on TBB and Embree, or with plain threads and brute force (support/plain_threads.h).
#pragma once

#include <memory>
#include <new>

#include "radiosity/bake.h"
#include "support/plain_threads.h"
#include "visibility/brute_force_visibility.h"
#include "visibility/embree_library.h"
#include "visibility/embree_visibility.h"

namespace radvor {

class TestHost {
 public:
  explicit TestHost(std::uint32_t threads)
      : host{HostMemory(nullptr, nullptr, nullptr), Log(nullptr, nullptr),
             Jobs(threads, lent(threads), nullptr, std::addressof(host.memory))} {}

  Host host;

 private:
  static Jobs::HostParallelFor lent(std::uint32_t threads) {
    if (!test::plain_threads_wanted()) {
      return nullptr;
    }
    return threads == 1   ? test::plain_parallel_for<1>
           : threads == 2 ? test::plain_parallel_for<2>
                          : test::plain_parallel_for<3>;
  }
};

/// Owns a bake and what it stands on.
class TestBake {
 public:
  TestBake(Scene scene, const BakeOptions& options, std::uint32_t threads = 2)
      : host_(threads), bake_(std::move(scene), options, maker(), host_.host) {}

  BakeStatus run(double slice = 0) {
    BakeStatus status;
    do {
      status = bake_.advance(slice, {});
    } while (status == BakeStatus::time_spent && slice > 0);
    return status;
  }

  const Bake& operator*() const { return bake_; }
  Bake* operator->() { return &bake_; }

  /// All light at a sample.
  Color irradiance(std::size_t sample) const { return bake_.direct()[sample] + bake_.indirect()[sample]; }

 private:
  static VisibilityMaker maker() {
    return {[](void*, const Occluders& occluders, Host& host) -> Visibility* {
              if (test::plain_threads_wanted()) {
                return new BruteForceVisibility(occluders, &host.memory);
              }
              static const EmbreeLibrary library("");
              return new EmbreeVisibility(library, occluders, host);
            },
            [](void*, Visibility* visibility, Host&) { delete visibility; }, nullptr};
  }

  TestHost host_;
  Bake bake_;
};

}  // namespace radvor
