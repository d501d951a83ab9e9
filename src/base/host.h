// What the engine lends: memory, threads and a log. One per context; every part of the core gets a reference.
#pragma once

#include "base/jobs.h"
#include "base/log.h"
#include "base/memory.h"

namespace radvor {

struct Host {
  HostMemory memory;
  Log log;
  Jobs jobs;
};

}  // namespace radvor
