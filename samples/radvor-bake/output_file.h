// A file being written that is either complete under its name or not there at all.
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>

namespace bake {

/// Writes beside the file and renames at close, so that who watches the file never reads half of it; what exists and
/// is no regular file (/dev/stdout) is written straight. Every function throws Failure (output) when the disk refuses.
class OutputFile {
 public:
  explicit OutputFile(std::string file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void text(std::string_view text) { bytes(text.data(), text.size()); }
  void bytes(const void* data, std::size_t size);
  void number(float value);                            ///< the shortest digits that read back as the same number
  std::ostream& stream() noexcept { return stream_; }  ///< for libraries that write to one; close sees what failed
  void close();

 private:
  [[noreturn]] void refuse() const;

  std::string file_;
  std::string unfinished_;
  std::ofstream stream_;
  bool closed_ = false;
};

/// Throws Failure (output) where a file of that name can't be made: known before hours of baking, not after.
void check_writable(const std::string& file);

}  // namespace bake
