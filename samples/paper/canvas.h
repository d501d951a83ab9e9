// A small picture of the plane: filled triangles, lines with soft edges, dots.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace paper {

class Canvas {
 public:
  /// Shows the unit square, y up, with a margin; pixels along a side.
  explicit Canvas(std::size_t pixels);

  void line(const glm::dvec2& a, const glm::dvec2& b, double width_in_pixels, double grey, bool dashed = false);
  void outline(const std::vector<glm::dvec2>& polygon, double width_in_pixels, double grey, bool dashed = false);
  void dot(const glm::dvec2& at, double radius_in_pixels, double grey);
  /// Linear light 0..1 at the corners, linear in between: what graphics hardware draws.
  void triangle(const std::array<glm::dvec2, 3>& corners, const std::array<double, 3>& light);

  /// Several canvases of one size beside each other. Throws bake::Failure.
  static void save(const std::string& file, const std::vector<const Canvas*>& beside);

 private:
  glm::dvec2 in_pixels(const glm::dvec2& at) const;
  void cover(std::size_t x, std::size_t y, double share, double grey);

  std::size_t pixels_;
  double margin_;
  std::vector<double> grey_;  ///< as it is seen (sRGB), 0 black to 1 white
};

}  // namespace paper
