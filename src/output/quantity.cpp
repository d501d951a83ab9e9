#include "output/quantity.h"

#include <numbers>

namespace radvor {

namespace {

Color value_of(const LitSurface& lit, Quantity quantity, const Share& share, const Color& direct,
               const Color& indirect) {
  switch (quantity) {
    case Quantity::irradiance:
      return direct + indirect;
    case Quantity::direct:
      return direct;
    case Quantity::indirect:
      return indirect;
    case Quantity::radiance:
      break;
  }
  const Facet& facet = lit.surface.facets().facets[share.facet];
  const Color emission = lit.surface.scene().materials[facet.material].emission;
  return emission + share.albedo * (direct + indirect) * std::numbers::inv_pi;
}

}  // namespace

Color value_at(const LitSurface& lit, Quantity quantity, std::uint32_t share_index) {
  const Share& share = lit.surface.shares()[share_index];
  return value_of(lit, quantity, share, lit.direct[share.sample], lit.indirect[share.sample]);
}

Color corner_value(const LitSurface& lit, Quantity quantity, std::uint32_t share_index) {
  const Share& share = lit.surface.shares()[share_index];
  const Color fit = lit.fit.empty() ? Color(0.0) : lit.fit[share.sample];
  return value_of(lit, quantity, share, lit.direct[share.sample] + fit, lit.indirect[share.sample]);
}

Color value_at(const LitSurface& lit, Quantity quantity, const FacetPoint& point, bool back) {
  Color value{0.0};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const std::uint32_t front = point.shares[corner];
    const std::uint32_t share = back ? lit.surface.shares()[front].other_side : front;
    value += point.weights[corner] * corner_value(lit, quantity, share);
  }
  return value;
}

bool two_sided(const Surface& surface, std::uint32_t facet) {
  return surface.scene().materials[surface.facets().facets[facet].material].two_sided;
}

}  // namespace radvor
