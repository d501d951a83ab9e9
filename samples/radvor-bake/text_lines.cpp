#include "text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "failure.h"

namespace bake {
namespace {

constexpr std::string_view k_blanks = " \t";

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(k_blanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return line.substr(first, line.find_last_not_of(k_blanks) - first + 1);
}

}  // namespace

std::string read_text(const std::string& file) {
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(file, ignored);  // which opens, and fails when read
  std::ifstream stream(file, std::ios::binary);
  if (folder || !stream) {
    throw Failure(ExitCode::input, file + ": cannot be read");
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string_view> split_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(k_blanks, at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(k_blanks, at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

std::optional<double> parse_number(std::string_view field) {
  if (field.starts_with('+')) {
    field.remove_prefix(1);  // from_chars knows no plus sign
  }
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::vector<double>> parse_numbers(const std::vector<std::string_view>& fields) {
  std::vector<double> numbers;
  numbers.reserve(fields.size());
  for (const std::string_view field : fields) {
    const std::optional<double> number = parse_number(field);
    if (!number) {
      return std::nullopt;
    }
    numbers.push_back(*number);
  }
  return numbers;
}

TextLines::TextLines(std::string text) : text_(std::move(text)) {
  if (text_.starts_with("\xEF\xBB\xBF")) {
    at_ = 3;
  }
}

std::string_view TextLines::next_physical() {
  const std::size_t begin = at_;
  const std::size_t end = std::min(text_.find_first_of("\r\n", begin), text_.size());
  at_ = end;
  if (at_ < text_.size()) {
    at_ += text_.compare(at_, 2, "\r\n") == 0 ? 2 : 1;
  }
  ++physical_;
  return trimmed(std::string_view(text_).substr(begin, end - begin));
}

bool TextLines::next(std::string_view& line) {
  if (at_ >= text_.size()) {
    return false;
  }
  line = next_physical();
  number_ = physical_;
  if (!line.ends_with('\\') || line.starts_with('#')) {
    return true;
  }
  joined_.clear();
  while (line.ends_with('\\') && at_ < text_.size()) {
    line.remove_suffix(1);
    joined_.append(line).push_back(' ');
    line = next_physical();
  }
  joined_.append(line);
  line = joined_;
  return true;
}

LineStream::LineStream(std::string text, OnLine on_line) : lines_(std::move(text)), on_line_(std::move(on_line)) {}

LineStream::int_type LineStream::underflow() {
  std::string_view line;
  if (!lines_.next(line)) {
    return traits_type::eof();
  }
  current_.assign(on_line_(line, lines_.number())).push_back('\n');
  setg(current_.data(), current_.data(), current_.data() + current_.size());
  return traits_type::to_int_type(current_.front());
}

}  // namespace bake
