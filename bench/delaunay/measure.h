// Rounds that alternate between two sides, their medians, and what is written of them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace radvor::bench {

struct Choice {
  int rounds = 5;
  std::string filter;  // a part of the names of what is wanted
};
extern Choice g_choice;

bool wanted(const char* name);

/// Processor time of this thread.
double seconds_of(const std::function<void()>& run);

/// Each side gives the seconds of the part that counts. Prints ns a point (or query) and the ratio.
void compare(const char* name, double target, std::size_t count, const std::function<double()>& ours,
             const std::function<double()>& cgal);

/// All that was compared, as JSON.
void write_json(const char* path, double bytes_a_point);

}  // namespace radvor::bench
