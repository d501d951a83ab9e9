// Edits of many steps, done all or not at all.
#pragma once

#include "delaunay/triangulation.h"

namespace radvor::delaunay {

/// Runs edit(); what it throws leaves the triangulation as it was. Within, new vertices get new ids.
template <class Edit>
void Triangulation::transact(Edit&& edit) {
  const std::size_t bound = positions_.size();
  const std::uint32_t count = vertex_count_;
  const VertexId last = last_;
  const bool flat = flat_;
  const bool marked = marked_;
  changed_.clear();
  mesh_.begin();
  try {
    edit();
    make_report_unique();
  } catch (...) {
    mesh_.rollback();
    positions_.resize(bound);
    if (!values_.empty()) {
      values_.resize(bound);
    }
    vertex_count_ = count;
    last_ = last;
    flat_ = flat;
    marked_ = marked;
    changed_.clear();
    throw;
  }
  mesh_.commit();
}

}  // namespace radvor::delaunay
