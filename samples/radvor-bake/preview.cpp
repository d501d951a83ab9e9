#include "preview.h"

#include <stb/stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "failure.h"
#include "output_file.h"

namespace bake {
namespace {

constexpr std::size_t k_supersampling = 2;  // along each side of a pixel
const glm::vec3 k_background(0.012f);       // linear, after exposure
const glm::vec3 k_line(0.0f, 0.02f, 0.09f);
constexpr float k_line_strength = 0.7f;

float luminance(const glm::vec3& color) {
  return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Every sample of the picture: linear light, and how much of it a line of the mesh covers.
struct Samples {
  std::vector<glm::vec3> radiance;
  std::vector<float> line;
  std::vector<std::uint8_t> seen;
};

Samples draw_samples(const std::vector<DrawnMesh>& meshes, const Camera& camera, std::size_t width,
                     std::size_t height) {
  Samples samples{std::vector<glm::vec3>(width * height), std::vector<float>(width * height),
                  std::vector<std::uint8_t>(width * height)};
  Rasteriser rasteriser(camera, width, height);
  for (const DrawnMesh& mesh : meshes) {
    rasteriser.draw(mesh, [&](const Fragment& fragment) {
      glm::vec3 radiance(0);
      for (std::size_t i = 0; i < 3; ++i) {
        const float* at = mesh.radiance + 3 * std::size_t{fragment.vertices[i]};
        radiance += static_cast<float>(fragment.weights[static_cast<int>(i)]) * glm::vec3(at[0], at[1], at[2]);
      }
      samples.radiance[fragment.sample] = glm::max(radiance, 0.0f);
      samples.seen[fragment.sample] = 1;
      // A line is a pixel wide; where triangles are smaller than that lines fade, or they would be all one sees.
      const double half_width = 0.5 * static_cast<double>(k_supersampling);
      const double cover = std::clamp(half_width + 0.5 - fragment.edge_distance, 0.0, 1.0);
      const double pixels = fragment.thickness / static_cast<double>(k_supersampling);
      samples.line[fragment.sample] = static_cast<float>(cover * std::clamp((pixels - 1) / 5, 0.0, 1.0));
    });
  }
  return samples;
}

/// So that what is seen has the grey value 0.18 on (geometric) average, but 95 % of it stays under white: the key of
/// Reinhard et al., "Photographic tone reproduction for digital images" (2002), with a hold on the highlights.
float exposure(const Samples& samples) {
  std::vector<float> lit;
  for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
    const float value = luminance(samples.radiance[i]);
    if (samples.seen[i] != 0 && value > 0) {
      lit.push_back(value);
    }
  }
  if (lit.empty()) {
    return 1;
  }
  std::sort(lit.begin(), lit.end());
  const float bright = lit[lit.size() * 95 / 100];
  double logarithms = 0;
  for (const float value : lit) {
    logarithms += std::log(std::max(value, bright * 1e-3f));  // a few black corners do not set the exposure
  }
  const auto average = static_cast<float>(std::exp(logarithms / static_cast<double>(lit.size())));
  return std::min(0.18f / average, 1.6f / bright);
}

/// Filmic curve: Narkowicz, "ACES filmic tone mapping curve" (2016).
glm::vec3 filmic(const glm::vec3& x) {
  return glm::clamp((x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

/// IEC 61966-2-1.
std::uint8_t srgb(float linear) {
  const float value = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

Picture draw_preview(const std::vector<DrawnMesh>& meshes, const Camera& camera, std::size_t width, std::size_t height,
                     bool wireframe) {
  const std::size_t columns = width * k_supersampling;
  const Samples samples = draw_samples(meshes, camera, columns, height * k_supersampling);
  const float exposed = exposure(samples);
  Picture picture{width, height, std::vector<std::uint8_t>(width * height * 3)};
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      glm::vec3 sum(0);
      for (std::size_t s = 0; s < k_supersampling * k_supersampling; ++s) {
        const std::size_t i =
            (y * k_supersampling + s / k_supersampling) * columns + x * k_supersampling + s % k_supersampling;
        const glm::vec3 light = samples.seen[i] != 0 ? filmic(samples.radiance[i] * exposed) : k_background;
        sum += wireframe ? glm::mix(light, k_line, k_line_strength * samples.line[i]) : light;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        picture.rgb[3 * (y * width + x) + c] =
            srgb(sum[static_cast<int>(c)] / static_cast<float>(k_supersampling * k_supersampling));
      }
    }
  }
  return picture;
}

void save_png(const std::string& file, const Picture& picture) {
  std::vector<std::uint8_t> png;
  stbi_write_png_compression_level = 12;
  const int written = stbi_write_png_to_func(
      [](void* context, void* data, int size) {
        const auto* bytes = static_cast<const std::uint8_t*>(data);
        auto* all = static_cast<std::vector<std::uint8_t>*>(context);
        all->insert(all->end(), bytes, bytes + size);
      },
      &png, static_cast<int>(picture.width), static_cast<int>(picture.height), 3, picture.rgb.data(),
      static_cast<int>(3 * picture.width));
  if (written == 0) {
    throw Failure(ExitCode::output, file + ": the picture cannot be encoded");
  }
  OutputFile out(file);
  out.bytes(png.data(), png.size());
  out.close();
}

}  // namespace bake
