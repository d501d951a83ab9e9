// radvor_delaunay_*: the edits.
#include "api/delaunay.h"

#include "api/checks.h"

using namespace radvor;
using namespace radvor::api;
using delaunay::Crossing;
using delaunay::VertexId;

radvor_delaunay::radvor_delaunay(radvor_context* from) : context(from), triangulation(&from->host.memory) {}

radvor_result radvor_delaunay_create(radvor_context* context, radvor_delaunay** result) {
  return enter_create(context, __func__, result, [&] { return make_handle<radvor_delaunay>(context, context); });
}

void radvor_delaunay_destroy(radvor_delaunay* delaunay) {
  destroy_handle(delaunay);
}

radvor_result radvor_delaunay_insert(radvor_delaunay* delaunay, double x, double y, uint32_t* vertex) {
  return enter(context_of(delaunay), __func__, [&] {
    const VertexId v = delaunay->triangulation.insert({x, y});
    if (vertex) {
      *vertex = v;
    }
  });
}

radvor_result radvor_delaunay_insert_near(radvor_delaunay* delaunay, double x, double y, uint32_t* hint) {
  return enter(context_of(delaunay), __func__, [&] {
    require(hint, "hint");
    *hint = delaunay->triangulation.insert({x, y}, *hint);
  });
}

radvor_result radvor_delaunay_insert_many(radvor_delaunay* delaunay, const double* xy, uint32_t count,
                                          uint32_t* vertices) {
  return enter(context_of(delaunay), __func__, [&] {
    if (count > 0) {
      require(xy, "xy");
    }
    static_assert(sizeof(Vec2) == 2 * sizeof(double));
    delaunay->triangulation.insert_many({reinterpret_cast<const Vec2*>(xy), count}, vertices);
  });
}

radvor_result radvor_delaunay_remove(radvor_delaunay* delaunay, uint32_t vertex) {
  return enter(context_of(delaunay), __func__, [&] { delaunay->triangulation.remove(vertex); });
}

radvor_result radvor_delaunay_constrain(radvor_delaunay* delaunay, uint32_t a, uint32_t b) {
  return enter(context_of(delaunay), __func__,
               [&] { delaunay->triangulation.constrain(a, b, RADVOR_CONSTRAINT_DISCONTINUOUS); });
}

radvor_result radvor_delaunay_constrain_as(radvor_delaunay* delaunay, uint32_t a, uint32_t b, uint32_t flags,
                                           uint32_t crossing) {
  namespace constraint = delaunay::constraint;
  static_assert(RADVOR_CONSTRAINT_BORDER == constraint::k_border &&
                RADVOR_CONSTRAINT_DISCONTINUOUS == constraint::k_discontinuous &&
                RADVOR_CONSTRAINT_CONTINUOUS == constraint::k_continuous);
  return enter(context_of(delaunay), __func__, [&] {
    check_flags("flags", flags, 0xf7);
    if ((flags & 7u) == 0) {
      throw Error(ErrorCode::invalid_argument, "flags is 0x%x, without RADVOR_CONSTRAINT_*", flags);
    }
    if (crossing > RADVOR_CROSSING_SPLIT) {
      throw Error(ErrorCode::invalid_argument, "crossing is %u", crossing);
    }
    delaunay->triangulation.constrain(a, b, static_cast<std::uint8_t>(flags),
                                      crossing == RADVOR_CROSSING_SPLIT ? Crossing::split : Crossing::refuse);
  });
}

radvor_result radvor_delaunay_unconstrain(radvor_delaunay* delaunay, uint32_t a, uint32_t b) {
  return enter(context_of(delaunay), __func__, [&] { delaunay->triangulation.unconstrain(a, b); });
}

radvor_result radvor_delaunay_split(radvor_delaunay* delaunay, uint32_t a, uint32_t b, double x, double y,
                                    uint32_t* vertex) {
  return enter(context_of(delaunay), __func__, [&] {
    const VertexId v = delaunay->triangulation.split(a, b, {x, y});
    if (vertex) {
      *vertex = v;
    }
  });
}

radvor_result radvor_delaunay_mark_domain(radvor_delaunay* delaunay) {
  return enter(context_of(delaunay), __func__, [&] { delaunay->triangulation.mark_domain(); });
}

radvor_result radvor_delaunay_unmark_domain(radvor_delaunay* delaunay) {
  return enter(context_of(delaunay), __func__, [&] { delaunay->triangulation.unmark_domain(); });
}

radvor_result radvor_delaunay_set_values(radvor_delaunay* delaunay, const double* values, uint32_t first,
                                         uint32_t count) {
  return enter(context_of(delaunay), __func__, [&] {
    if (count > 0) {
      require(values, "values");
      delaunay->triangulation.set_values({values, count}, first);
    }
  });
}

radvor_result radvor_delaunay_realign(radvor_delaunay* delaunay) {
  return enter(context_of(delaunay), __func__, [&] { delaunay->triangulation.realign(); });
}

radvor_result radvor_delaunay_realign_near(radvor_delaunay* delaunay, const uint32_t* vertices, uint32_t count) {
  return enter(context_of(delaunay), __func__, [&] {
    if (count > 0) {
      require(vertices, "vertices");
    }
    delaunay->triangulation.realign({vertices, count});
  });
}
