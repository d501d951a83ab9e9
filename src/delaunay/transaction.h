// Edits of many steps, done all or not at all.
#pragma once

#include "delaunay/triangulation.h"

namespace radvor::delaunay {

/// Runs edit(); what it throws leaves the triangulation as it was, the report of the edit before included.
template <class Edit>
void Triangulation::transact(Edit&& edit) {
  const std::size_t bound = positions_.size();
  const std::uint32_t count = vertex_count_;
  const VertexId last = last_;
  const bool flat = flat_;
  const bool marked = marked_;
  changed_before_.swap(changed_);
  changed_.clear();
  reused_.clear();
  mesh_.begin();
  try {
    edit();
    make_report_unique();
    if (steered_) {
      refresh_ties();
    }
  } catch (...) {
    mesh_.rollback();
    positions_.resize(bound);
    if (!values_.empty()) {
      values_.resize(bound);
    }
    for (; !reused_.empty(); reused_.pop_back()) {
      free_again(reused_.back());
    }
    vertex_count_ = count;
    if (count == 1) {
      mesh_.set_out(only_vertex(), k_none);  // had no triangle to find it in
    }
    last_ = last;
    flat_ = flat;
    marked_ = marked;
    changed_.swap(changed_before_);
    throw;
  }
  mesh_.commit();
}

}  // namespace radvor::delaunay
