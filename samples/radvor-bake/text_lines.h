// A text file line by line, knowing which line it is at: any line ends, a byte order mark, continued lines.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace bake {

/// The whole file. Throws Failure (input) where it cannot be read.
std::string read_text(const std::string& file);

/// The fields of a line, split at blanks.
std::vector<std::string_view> split_fields(std::string_view line);

/// A finite number that fills the field, else nothing.
std::optional<double> parse_number(std::string_view field);

/// The same for each of the fields.
std::optional<std::vector<double>> parse_numbers(const std::vector<std::string_view>& fields);

/// Hands a text out by lines: without the line end (LF, CR LF or CR), without blanks at either end, with lines
/// that end in a backslash joined to the next.
class TextLines {
 public:
  explicit TextLines(std::string text);

  /// False at the end of the text. line stays valid until the next call.
  bool next(std::string_view& line);

  /// Of the line handed out last, from 1; of its first part where lines were joined.
  std::size_t number() const noexcept { return number_; }

 private:
  std::string_view next_physical();

  std::string text_;
  std::size_t at_ = 0;
  std::size_t physical_ = 0;
  std::size_t number_ = 0;
  std::string joined_;
};

/// TextLines as a stream, for parsers that want one: they see clean lines and never read past the line they are at,
/// so their callbacks can ask for its number. on_line sees every line first and returns what the parser gets of it.
class LineStream : public std::streambuf {
 public:
  using OnLine = std::function<std::string_view(std::string_view line, std::size_t number)>;

  LineStream(std::string text, OnLine on_line);

  std::size_t number() const noexcept { return lines_.number(); }

 protected:
  int_type underflow() override;

 private:
  TextLines lines_;
  OnLine on_line_;
  std::string current_;
};

}  // namespace bake
