// A line that says how far the bake is, and the signals that stop it.
#pragma once

#include <radvor.h>

#include <string>

namespace bake {

/// Sets the handlers of SIGINT and SIGTERM for its lifetime: the first signal asks the bake to stop, a second one
/// ends the program as if it had no handler.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static int caught() noexcept;  ///< the signal's number, or 0
};

/// Passed to radvor as the progress callback. On a terminal one line is redrawn; elsewhere (logs) a line is written
/// for every tenth of the way.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);

  static std::int32_t call(void* self, const radvor_progress* progress);

  /// Leaves the terminal's line empty for what follows.
  void clear();

 private:
  void show(const radvor_progress& progress);

  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  double shown_seconds_ = -1;
  int shown_tenth_ = 0;
};

/// "[#####.....]  52.1 %  1.2M rays  14.0k sites  8 s, 7 s left"
std::string progress_text(const radvor_progress& progress, bool bar);

}  // namespace bake
