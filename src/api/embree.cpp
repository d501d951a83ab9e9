#include "api/embree.h"

namespace radvor::api {

const EmbreeLibrary& embree_of(const radvor_context& context) {
  const std::lock_guard<std::mutex> lock(context.embree_mutex);
  if (!context.embree) {
    context.embree.emplace(context.embree_path);
  }
  return *context.embree;
}

}  // namespace radvor::api
