// Runs a command of the shell and keeps what it prints.
#pragma once

#include <cstdio>
#include <string>

namespace radvor::test {

struct CommandResult {
  int status;  ///< 0: success
  std::string output;
};

inline CommandResult run_command(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) {
    return {-1, "cannot start: " + command};
  }
  std::string output;
  char buffer[4096];
  for (std::size_t got; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
    output.append(buffer, got);
  }
  return {pclose(pipe), output};
}

}  // namespace radvor::test
