// What the engine lends is used, and nothing else: its memory, its threads, its log.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <radvor.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <thread>

#include "api/engine.h"
#include "api/light_of.h"
#include "api/room.h"

namespace {

// Allocations through the C++ runtime by code of libradvor itself, while watched. Embree's and TBB's come from their
// own libraries and do not count.
std::atomic<bool> watching{false};
std::atomic<int> from_radvor{0};

void* allocate(std::size_t bytes, std::size_t alignment, const void* caller) {
  if (watching) {
    Dl_info library{};
    if (dladdr(caller, &library) != 0 && library.dli_fname && std::strstr(library.dli_fname, "libradvor.so")) {
      ++from_radvor;
    }
  }
  const std::size_t whole = (std::max<std::size_t>(bytes, 1) + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, whole);
}

void* allocate_or_throw(std::size_t bytes, std::size_t alignment, const void* caller) {
  if (void* memory = allocate(bytes, alignment, caller)) {
    return memory;
  }
  throw std::bad_alloc();
}

// Kept whole: inlined into some delete, gcc 12 takes it for the wrong partner of new.
[[gnu::noinline]] void give_back(void* memory) {
  std::free(memory);
}

constexpr std::size_t k_plain = alignof(std::max_align_t);

}  // namespace

// The whole program's, libradvor's included: the dynamic linker takes the executable's.
#define RADVOR_CALLER __builtin_return_address(0)
void* operator new(std::size_t bytes) {
  return allocate_or_throw(bytes, k_plain, RADVOR_CALLER);
}
void* operator new[](std::size_t bytes) {
  return allocate_or_throw(bytes, k_plain, RADVOR_CALLER);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate_or_throw(bytes, static_cast<std::size_t>(alignment), RADVOR_CALLER);
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate_or_throw(bytes, static_cast<std::size_t>(alignment), RADVOR_CALLER);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocate(bytes, k_plain, RADVOR_CALLER);
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocate(bytes, static_cast<std::size_t>(alignment), RADVOR_CALLER);
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete[](void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  give_back(memory);
}

namespace radvor::test {
namespace {

// Everything once, from a scene to all that can be read, by an engine that lends what `lends` says. `during` is called
// from the bake's progress callback.
void bake_and_read(const Lends& lends, const std::function<void(const Engine&)>& during,
                   std::uint64_t* loops = nullptr) {
  struct Watch {
    const Engine* engine;
    const std::function<void(const Engine&)>* during;
  };
  const Engine engine(lends);
  const SceneOf scene(engine);
  const FloorAndLamp room;
  scene.add(room.desc());
  radvor_light_desc sky{};
  sky.struct_size = sizeof sky;
  sky.type = RADVOR_LIGHT_SKY;
  sky.color[2] = 0.5f;
  std::uint32_t id = RADVOR_NONE;
  EXPECT_EQ(radvor_scene_add_light(scene, &sky, &id), RADVOR_OK) << engine.error();
  Watch watch{&engine, &during};
  radvor_bake_options options = coarse();
  options.progress_user = &watch;
  options.progress = [](void* user, const radvor_progress*) {
    const Watch& seen = *static_cast<Watch*>(user);
    (*seen.during)(*seen.engine);
    return 0;
  };
  radvor_solution* solution = nullptr;
  ASSERT_EQ(radvor_bake(scene, &options, &solution), RADVOR_OK) << engine.error();
  read_light(solution, 8);
  radvor_solution_destroy(solution);
  if (loops) {
    *loops = engine.loops;
  }
}

TEST(Lent, AllOfRadvorsMemoryIsTheEngines) {
  std::size_t most = 0;
  from_radvor = 0;
  watching = true;
  bake_and_read({}, [&](const Engine& engine) { most = std::max(most, engine.live_blocks()); });
  watching = false;
  EXPECT_EQ(from_radvor, 0) << "allocations past the engine's acquire";
  EXPECT_GT(most, 10u);
}

TEST(Lent, TheWatchOnMemorySees) {
  from_radvor = 0;
  watching = true;
  bake_and_read({.memory = false, .threads = plain_threads_wanted(), .thread_count = 2}, [](const Engine&) {});
  watching = false;
  EXPECT_GT(from_radvor, 10) << "without acquire the C++ runtime's memory is used";
}

std::size_t threads_of_process() {
  std::size_t threads = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    ++threads;
  }
  return threads;
}

TEST(Lent, NoThreadIsMadeBehindAnEnginesBack) {
  // In a process of its own: threads that TBB made for an earlier test would still be there.
  const auto check = [] {
    std::size_t most = 0;
    const auto look = [&] { most = std::max(most, threads_of_process()); };
    const std::size_t before = threads_of_process();
    radvor_context_desc desc{};
    desc.struct_size = sizeof desc;
    desc.thread_count = 3;
    desc.user = &most;
    desc.parallel_for = [](void* user, std::uint32_t count, radvor_task task, void* data) {
      for (std::uint32_t i = count; i-- > 0;) {  // backwards: any order will do
        task(data, i);
      }
      auto& seen = *static_cast<std::size_t*>(user);
      seen = std::max(seen, threads_of_process());
    };
#ifdef RADVOR_STAND_IN_EMBREE
    desc.embree_path = plain_threads_wanted() ? RADVOR_STAND_IN_EMBREE : nullptr;
#endif
    radvor_context* context = nullptr;
    radvor_scene* scene = nullptr;
    radvor_solution* solution = nullptr;
    const FloorAndLamp room;
    const radvor_mesh_desc mesh = room.desc();
    const radvor_material_desc materials[] = {gray(0.5f), gray(0.5f, 4)};
    const radvor_bake_options options = coarse();
    std::uint32_t id = RADVOR_NONE;
    const bool baked =
        radvor_context_create(&desc, &context) == RADVOR_OK && radvor_scene_create(context, &scene) == RADVOR_OK &&
        radvor_scene_add_material(scene, &materials[0], &id) == RADVOR_OK &&
        radvor_scene_add_material(scene, &materials[1], &id) == RADVOR_OK &&
        radvor_scene_add_mesh(scene, &mesh, &id) == RADVOR_OK && radvor_bake(scene, &options, &solution) == RADVOR_OK;
    look();
    std::fprintf(stderr, "baked %d, threads %zu before, %zu at most, loops seen %d;", baked, before, most, most > 0);
    std::exit(baked && most == before ? 0 : 1);
  };
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "baked 1");
}

TEST(Lent, ParallelForIsUsed) {
  std::uint64_t loops = 0;
  bake_and_read(
      {.memory = true, .threads = true, .thread_count = 2}, [](const Engine&) {}, &loops);
  EXPECT_GT(loops, 0u);
}

TEST(Lent, ConstCallsMayOverlap) {
  const Engine engine;
  const SceneOf scene(engine);
  const FloorAndLamp room;
  scene.add(room.desc());
  const radvor_bake_options options = coarse();
  radvor_solution* solution = nullptr;
  ASSERT_EQ(radvor_bake(scene, &options, &solution), RADVOR_OK) << engine.error();
  const auto read = [&] {
    std::vector<float> rgb(24);
    const double position[] = {0.5, 0, 0.5};
    const float normal[] = {0, 1, 0};
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(radvor_solution_vertices(solution, 0, RADVOR_IRRADIANCE, 0, rgb.data(), 0, 8), RADVOR_OK);
      EXPECT_EQ(radvor_solution_points(solution, RADVOR_IRRADIANCE, 1, position, normal, 0.1, rgb.data(), nullptr),
                RADVOR_OK);
      EXPECT_GT(rgb[0], 0);
      EXPECT_EQ(radvor_solution_vertices(solution, 1, RADVOR_IRRADIANCE, 0, rgb.data(), 0, 8),
                RADVOR_ERROR_INVALID_ARGUMENT);
    }
  };
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back(read);
  }
  for (std::thread& reader : readers) {
    reader.join();
  }
  radvor_solution_destroy(solution);
}

}  // namespace
}  // namespace radvor::test
