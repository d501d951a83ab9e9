#include "canvas.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "preview.h"

namespace paper {
namespace {

constexpr double k_margin = 0.03;     // of the picture
constexpr double k_dash = 6;          // pixels
constexpr std::size_t k_between = 8;  // pixels between canvases

double srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

struct PixelBox {
  std::size_t x0, x1, y0, y1;
};

PixelBox box_around(const glm::dvec2& low, const glm::dvec2& high, std::size_t pixels) {
  const auto bounded = [pixels](double value) {
    return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(pixels)));
  };
  return {bounded(std::floor(low.x)), bounded(std::ceil(high.x) + 1), bounded(std::floor(low.y)),
          bounded(std::ceil(high.y) + 1)};
}

glm::dvec2 centre_of_pixel(std::size_t x, std::size_t y) {
  return {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
}

}  // namespace

Canvas::Canvas(std::size_t pixels)
    : pixels_(pixels), margin_(k_margin * static_cast<double>(pixels)), grey_(pixels * pixels, 1.0) {}

glm::dvec2 Canvas::in_pixels(const glm::dvec2& at) const {
  const double scale = static_cast<double>(pixels_) - 2 * margin_;
  return {margin_ + at.x * scale, static_cast<double>(pixels_) - margin_ - at.y * scale};
}

void Canvas::cover(std::size_t x, std::size_t y, double share, double grey) {
  double& pixel = grey_[y * pixels_ + x];
  pixel += std::clamp(share, 0.0, 1.0) * (grey - pixel);
}

void Canvas::line(const glm::dvec2& from, const glm::dvec2& to, double width, double grey, bool dashed) {
  const glm::dvec2 a = in_pixels(from);
  const glm::dvec2 b = in_pixels(to);
  const double length = glm::distance(a, b);
  if (!(length > 0)) {
    return;
  }
  const PixelBox box = box_around(glm::min(a, b) - width, glm::max(a, b) + width, pixels_);
  for (std::size_t y = box.y0; y < box.y1; ++y) {
    for (std::size_t x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 at = centre_of_pixel(x, y);
      const double along = std::clamp(glm::dot(at - a, b - a) / length, 0.0, length);
      // Dashes are laid out from the middle, so that an edge drawn from either end looks the same.
      if (dashed && std::fmod(std::abs(along - length / 2) + k_dash / 2, 2 * k_dash) > k_dash) {
        continue;
      }
      const double distance = glm::distance(at, a + along / length * (b - a));
      cover(x, y, width / 2 + 0.5 - distance, grey);
    }
  }
}

void Canvas::outline(const std::vector<glm::dvec2>& polygon, double width, double grey, bool dashed) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    line(polygon[i], polygon[(i + 1) % polygon.size()], width, grey, dashed);
  }
}

void Canvas::dot(const glm::dvec2& at, double radius, double grey) {
  const glm::dvec2 centre = in_pixels(at);
  const PixelBox box = box_around(centre - radius - 1.0, centre + radius + 1.0, pixels_);
  for (std::size_t y = box.y0; y < box.y1; ++y) {
    for (std::size_t x = box.x0; x < box.x1; ++x) {
      cover(x, y, radius + 0.5 - glm::distance(centre_of_pixel(x, y), centre), grey);
    }
  }
}

void Canvas::triangle(const std::array<glm::dvec2, 3>& corners, const std::array<double, 3>& light) {
  const glm::dvec2 a = in_pixels(corners[0]), b = in_pixels(corners[1]), c = in_pixels(corners[2]);
  const auto doubled_area = [](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  const double area = doubled_area(a, b, c);
  if (area == 0) {
    return;
  }
  const PixelBox box = box_around(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), pixels_);
  for (std::size_t y = box.y0; y < box.y1; ++y) {
    for (std::size_t x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 at = centre_of_pixel(x, y);
      const double wa = doubled_area(at, b, c) / area;
      const double wb = doubled_area(a, at, c) / area;
      const double wc = 1 - wa - wb;
      constexpr double k_rounding = -1e-9;  // no pixel between two triangles is left out
      if (wa >= k_rounding && wb >= k_rounding && wc >= k_rounding) {
        cover(x, y, 1, srgb(std::clamp(wa * light[0] + wb * light[1] + wc * light[2], 0.0, 1.0)));
      }
    }
  }
}

void Canvas::save(const std::string& file, const std::vector<const Canvas*>& beside) {
  const std::size_t side = beside.front()->pixels_;
  bake::Picture picture;
  picture.height = side;
  picture.width = beside.size() * side + (beside.size() - 1) * k_between;
  picture.rgb.assign(3 * picture.width * picture.height, 255);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t x = 0; x < side; ++x) {
        const double grey = std::clamp(beside[i]->grey_[y * side + x], 0.0, 1.0);
        const std::size_t at = y * picture.width + i * (side + k_between) + x;
        std::fill_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * at), 3,
                    static_cast<std::uint8_t>(std::lround(255 * grey)));
      }
    }
  }
  bake::save_png(file, picture);
}

}  // namespace paper
