#include "output_file.h"

#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "failure.h"

namespace bake {

namespace {

std::string unfinished_name(const std::string& file) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  const bool straight = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  return straight ? file : file + ".part";
}

}  // namespace

OutputFile::OutputFile(std::string file)
    : file_(std::move(file)), unfinished_(unfinished_name(file_)), stream_(unfinished_, std::ios::binary) {
  if (!stream_) {
    closed_ = true;
    refuse();
  }
}

OutputFile::~OutputFile() {
  if (!closed_ && unfinished_ != file_) {
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(unfinished_, ignored);
  }
}

void OutputFile::bytes(const void* data, std::size_t size) {
  stream_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  if (!stream_) {
    refuse();
  }
}

void OutputFile::number(float value) {
  std::array<char, 32> digits{};
  const std::to_chars_result result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  bytes(digits.data(), static_cast<std::size_t>(result.ptr - digits.data()));
}

void OutputFile::close() {
  stream_.close();
  std::error_code error;
  if (stream_ && unfinished_ != file_) {
    std::filesystem::rename(unfinished_, file_, error);
  }
  if (!stream_ || error) {
    refuse();
  }
  closed_ = true;
}

void OutputFile::refuse() const {
  throw Failure(ExitCode::output, file_ + ": cannot be written");
}

void check_writable(const std::string& file) {
  OutputFile probe(file);
}

}  // namespace bake
