#include "visibility/embree_library.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "base/error.h"

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace radvor {
namespace {

#if defined(_WIN32)
constexpr const char* k_system_names[] = {"embree4.dll", "embree3.dll"};

void* open_library(const char* path) {
  return LoadLibraryA(path);
}
void close_library(void* library) {
  FreeLibrary(static_cast<HMODULE>(library));
}
void* find_function(void* library, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}
void describe_open_failure(const char* path, char* text, std::size_t size) {
  std::snprintf(text, size, "%s: LoadLibrary failed with error %lu", path, GetLastError());
}
#else
#if defined(__APPLE__)
constexpr const char* k_system_names[] = {"libembree4.4.dylib", "libembree3.3.dylib"};
#else
constexpr const char* k_system_names[] = {"libembree4.so.4", "libembree3.so.3"};
#endif

// Closing gives the reference back, but the code stays (RTLD_NODELETE): Embree leaves behind state of each thread that
// cast rays, and threads outlive contexts.
void* open_library(const char* path) {
  return dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}
void close_library(void* library) {
  dlclose(library);
}
void* find_function(void* library, const char* name) {
  return dlsym(library, name);
}
void describe_open_failure(const char* path, char* text, std::size_t size) {
  const char* reason = dlerror();  // names the file
  std::snprintf(text, size, "%s", reason ? reason : path);
}
#endif

constexpr std::uint32_t k_oldest_3 = 31300;
constexpr std::uint32_t k_first_4 = 40000;
constexpr std::uint32_t k_first_unknown = 50000;

bool supported(std::uint32_t version) {
  return (version >= k_oldest_3 && version < k_first_4) || (version >= k_first_4 && version < k_first_unknown);
}

}  // namespace

// One try to fill an EmbreeLibrary from a file; what went wrong stays as a sentence.
class EmbreeLibrary::Attempt {
 public:
  Attempt(EmbreeLibrary& library, const char* path) : library_(library), path_(path) {}

  bool succeeds() {
    library_.handle_ = open_library(path_);
    if (!library_.handle_) {
      describe_open_failure(path_, reason_, sizeof reason_);
      return false;
    }
    if (find_all() && ask_version()) {
      return true;
    }
    close_library(library_.handle_);
    library_.handle_ = nullptr;
    return false;
  }

  const char* reason() const { return reason_; }

 private:
  // RTLD_LOCAL hides nothing from dlsym: a library that lacks a function may still find it in one it depends on.
  // That is as good.
  template <class Function>
  bool find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(find_function(library_.handle_, name));
    return function || fails("%s has no %s: not an Embree 3.13 or 4", path_, name);
  }

  bool find_all() {
    EmbreeLibrary& l = library_;
    return find(l.new_device, "rtcNewDevice") && find(l.release_device, "rtcReleaseDevice") &&
           find(l.get_device_property, "rtcGetDeviceProperty") && find(l.get_device_error, "rtcGetDeviceError") &&
           find(l.set_device_error_function, "rtcSetDeviceErrorFunction") &&
           find(l.set_device_memory_monitor_function, "rtcSetDeviceMemoryMonitorFunction") &&
           find(l.new_scene, "rtcNewScene") && find(l.release_scene, "rtcReleaseScene") &&
           find(l.set_scene_flags, "rtcSetSceneFlags") && find(l.set_scene_build_quality, "rtcSetSceneBuildQuality") &&
           find(l.attach_geometry, "rtcAttachGeometry") && find(l.commit_scene, "rtcCommitScene") &&
           find(l.join_commit_scene, "rtcJoinCommitScene") && find(l.new_geometry, "rtcNewGeometry") &&
           find(l.release_geometry, "rtcReleaseGeometry") &&
           find(l.set_shared_geometry_buffer, "rtcSetSharedGeometryBuffer") &&
           find(l.commit_geometry, "rtcCommitGeometry") && find(l.intersect1_, "rtcIntersect1") &&
           find(l.intersect4_, "rtcIntersect4") && find(l.intersect8_, "rtcIntersect8") &&
           find(l.intersect16_, "rtcIntersect16") && find(l.occluded1_, "rtcOccluded1") &&
           find(l.occluded4_, "rtcOccluded4") && find(l.occluded8_, "rtcOccluded8") &&
           find(l.occluded16_, "rtcOccluded16");
  }

  bool ask_version() {
    embree::Device* device = library_.new_device(nullptr);
    if (!device) {
      return fails("%s makes no device: its error %d", path_, library_.get_device_error(nullptr));
    }
    library_.version_ = static_cast<std::uint32_t>(library_.get_device_property(device, embree::k_property_version));
    const bool triangles = library_.get_device_property(device, embree::k_property_triangles) != 0;
    const bool culls = library_.get_device_property(device, embree::k_property_backface_culling) != 0;
    library_.release_device(device);
    const std::uint32_t version = library_.version_;
    if (!supported(version)) {
      return fails("%s is Embree %u.%u.%u; 3.13 and 4 are supported", path_, version / 10000, version / 100 % 100,
                   version % 100);
    }
    return (triangles || fails("%s was built without triangles", path_)) &&
           (!culls || fails("%s was built with back-face culling; surfaces block from both sides", path_));
  }

  [[gnu::format(printf, 2, 3)]] bool fails(const char* format, ...) {
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(reason_, sizeof reason_, format, arguments);
    va_end(arguments);
    return false;
  }

  EmbreeLibrary& library_;
  const char* path_;
  char reason_[240] = "";
};

EmbreeLibrary::EmbreeLibrary(std::string_view path) {
  if (path.empty()) {
    Attempt newest(*this, k_system_names[0]);
    if (newest.succeeds()) {
      return;
    }
    Attempt older(*this, k_system_names[1]);
    if (older.succeeds()) {
      return;
    }
    throw Error(ErrorCode::unsupported, "no usable Embree on this system (embree_path names one): %s; %s",
                newest.reason(), older.reason());
  }
  char terminated[4096];
  if (path.size() >= sizeof terminated) {
    throw Error(ErrorCode::unsupported, "embree_path is longer than %zu bytes", sizeof terminated - 1);
  }
  std::copy(path.begin(), path.end(), terminated)[0] = '\0';
  Attempt attempt(*this, terminated);
  if (!attempt.succeeds()) {
    throw Error(ErrorCode::unsupported, "embree_path: %s", attempt.reason());
  }
}

EmbreeLibrary::~EmbreeLibrary() {
  close_library(handle_);
}

}  // namespace radvor
