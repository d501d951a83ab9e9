// What stops radvor-bake: words for the user and the exit code that scripts read.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace bake {

/// Documented in docs/radvor-bake.md and by --help. A run stopped by a signal exits with 128 + its number, after
/// writing what there is; one stopped by --max-seconds did as it was told and exits with 0.
enum class ExitCode : int {
  done = 0,
  usage = 2,   ///< the command line makes no sense
  input = 3,   ///< an input file is missing or wrong
  bake = 4,    ///< radvor refused or failed
  output = 5,  ///< a result cannot be written
};

class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& words) : std::runtime_error(words), code_(code) {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// "file:line: words", as compilers say it, so that editors jump there.
inline std::string at_line(const std::string& file, std::size_t line, const std::string& words) {
  return file + ":" + std::to_string(line) + ": " + words;
}

}  // namespace bake
