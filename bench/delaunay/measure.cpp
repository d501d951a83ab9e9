#include "delaunay/measure.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

namespace radvor::bench {

Choice g_choice;

namespace {

// Of this thread on a processor: both sides run on one, and other programs of the machine do not count.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

struct Row {
  std::string name;
  double ours, cgal;  // ns
  double target;
};
std::vector<Row> g_rows;

}  // namespace

double seconds_of(const std::function<void()>& run) {
  const double start = processor_seconds();
  run();
  return processor_seconds() - start;
}

bool wanted(const char* name) {
  return g_choice.filter.empty() || std::strstr(name, g_choice.filter.c_str()) != nullptr;
}

void compare(const char* name, double target, std::size_t count, const std::function<double()>& ours,
             const std::function<double()>& cgal) {
  std::vector<double> a, b;
  for (int round = 0; round < g_choice.rounds; ++round) {
    a.push_back(ours());
    b.push_back(cgal());
  }
  const double scale = 1e9 / static_cast<double>(count);
  const Row row{name, median(a) * scale, median(b) * scale, target};
  g_rows.push_back(row);
  std::printf("%-44s %9.0f %9.0f   %5.2f  (at most %.2f)%s\n", name, row.ours, row.cgal, row.ours / row.cgal, target,
              row.ours / row.cgal > target ? "  <-- missed" : "");
  std::fflush(stdout);
}

void write_json(const char* path, double bytes_a_point) {
  std::FILE* file = std::fopen(path, "w");
  if (!file) {
    std::perror(path);
    std::exit(1);
  }
  std::fprintf(file, "{\n  \"bytes_a_point\": %.1f,\n  \"rounds\": %d,\n  \"rows\": [\n", bytes_a_point,
               g_choice.rounds);
  for (std::size_t i = 0; i < g_rows.size(); ++i) {
    const Row& row = g_rows[i];
    std::fprintf(
        file, "    {\"name\": \"%s\", \"ours_ns\": %.1f, \"cgal_ns\": %.1f, \"ratio\": %.4f, \"target\": %.2f}%s\n",
        row.name.c_str(), row.ours, row.cgal, row.ours / row.cgal, row.target, i + 1 < g_rows.size() ? "," : "");
  }
  std::fprintf(file, "  ]\n}\n");
  std::fclose(file);
}

}  // namespace radvor::bench
