#include "point_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "failure.h"
#include "output_file.h"
#include "text_lines.h"

namespace bake {
namespace {

constexpr std::array<std::string_view, 6> k_columns{"x", "y", "z", "nx", "ny", "nz"};

std::string_view without_blanks(std::string_view field) {
  const std::vector<std::string_view> fields = split_fields(field);
  return fields.empty() ? std::string_view() : fields.front();
}

std::vector<std::string_view> split_at_commas(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t at = 0;
  for (std::size_t comma = 0; comma != std::string_view::npos; at = comma + 1) {
    comma = line.find(',', at);
    fields.push_back(without_blanks(line.substr(at, comma == std::string_view::npos ? comma : comma - at)));
  }
  return fields;
}

std::array<std::size_t, 6> find_columns(const std::string& file, std::size_t number, std::string_view header) {
  const std::vector<std::string_view> names = split_at_commas(header);
  std::array<std::size_t, 6> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), k_columns[i]);
    if (found == names.end()) {
      throw Failure(ExitCode::input,
                    at_line(file, number,
                            "the header names no column " + std::string(k_columns[i]) + " (wanted: x,y,z,nx,ny,nz)"));
    }
    columns[i] = static_cast<std::size_t>(found - names.begin());
  }
  return columns;
}

}  // namespace

Points load_points(const std::string& file) {
  TextLines lines(read_text(file));
  std::string_view line;
  std::array<std::size_t, 6> columns{};
  bool headed = false;
  Points points;
  while (lines.next(line)) {
    if (line.empty()) {
      continue;
    }
    if (!headed) {
      columns = find_columns(file, lines.number(), line);
      headed = true;
      continue;
    }
    const std::vector<std::string_view> fields = split_at_commas(line);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto value = columns[i] < fields.size() ? parse_number(fields[columns[i]]) : std::nullopt;
      if (!value || std::abs(*value) > std::numeric_limits<float>::max()) {
        throw Failure(ExitCode::input,
                      at_line(file, lines.number(), std::string(k_columns[i]) + " is not a finite number"));
      }
      if (i < 3) {
        points.positions.push_back(*value);
      } else {
        points.normals.push_back(static_cast<float>(*value));
      }
    }
  }
  if (!headed) {
    throw Failure(ExitCode::input, file + ": no header line (wanted: x,y,z,nx,ny,nz)");
  }
  return points;
}

void save_values(const std::string& file, const std::vector<float>& rgb, const std::vector<std::uint8_t>& found) {
  OutputFile out(file);
  out.text("r,g,b,found\n");
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      out.number(rgb[3 * i + c]);
      out.text(",");
    }
    out.text(found[i] != 0 ? "1\n" : "0\n");
  }
  out.close();
}

}  // namespace bake
