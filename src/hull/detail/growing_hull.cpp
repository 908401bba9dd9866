// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One step: 1. of the oldest facet that has points outside, the farthest; 2. the facets that it
// sees are removed, their points gathered in one batch; 3. each edge of the horizon is joined to
// it;
// 4. every point of the batch is tested against every fresh facet in loops without branches, and
// goes to one that it sees, or inside; what rounding leaves open is decided exactly; 5. the points
// of each facet are written one behind the other, so that step 1 and 2 read consecutive memory.
#include "hull/detail/growing_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.hpp"
#include "hull/detail/inner_ellipsoid.hpp"

namespace carpus::hull {
namespace {

/// Facets set aside; what is not used is never touched. Twice as many as there can be at once, up
/// to 32 MiB: glibc keeps freed memory for the next hull as long as it is no more than twice its
/// largest block. Without that each hull pays for its pages anew, a third of its time.
std::size_t reserved_facets(std::size_t points) {
  constexpr std::size_t kMost = 1 << 24;
  constexpr std::size_t kLargestKeptBlock = std::size_t{32} << 20U;
  const std::size_t enough = 2 * points + 16;
  const bool is_kept = 2 * enough * sizeof(GrowingFacet) < kLargestKeptBlock;
  return std::min(is_kept ? 2 * enough : enough, kMost);
}

/// From so many waiting points on, which with their facets fill the nearer caches, the growing goes
/// on by cells of about kPointsInCell: their facets and points take a third of a megabyte.
constexpr std::size_t kManyWaiting = 30'000;
constexpr std::size_t kPointsInCell = 1000;
/// A surface crosses about this many of k^3 cells, divided by k^2.
constexpr double kCellsCrossed = 3;

}  // namespace

GrowingHull::GrowingHull(std::span<const Vec3> points,
                         const StartSimplex& start,
                         HullStatistics& statistics)
    : points_(points),
      low_(start.low),
      extent_(start.extent),
      statistics_(statistics),
      arena_capacity_(3 * points.size()),
      arena_(unwritten_conflicts(arena_capacity_ + 1)),
      batch_(unwritten_conflicts(points.size() + 1)) {
  hull_.facets.reserve(reserved_facets(points.size()));
  const std::size_t vertices = std::min<std::size_t>(points.size() + 8, 1 << 23);
  hull_.vertices.reserve(vertices);
  hull_.input_indices.reserve(vertices);
  start_from(start.corners);
}

std::uint32_t GrowingHull::add_vertex(const Vec3& p, std::uint32_t input_index) {
  hull_.vertices.push_back(p);
  hull_.input_indices.push_back(input_index);
  return static_cast<std::uint32_t>(hull_.vertices.size() - 1);
}

[[gnu::always_inline]] inline std::uint32_t GrowingHull::make_facet(std::uint32_t a,
                                                                    std::uint32_t b,
                                                                    std::uint32_t c) {
  std::uint32_t f = 0;
  if (free_.empty()) {
    f = static_cast<std::uint32_t>(hull_.facets.size());
    hull_.facets.emplace_back();
  } else {
    f = free_.back();
    free_.pop_back();
  }
  GrowingFacet& facet = hull_.facets[f];
  facet.plane = OrientedPlane(hull_.vertices[a], hull_.vertices[b], hull_.vertices[c], extent_);
  facet.corners = {a, b, c};
  facet.conflicts = 0;
  facet.round = 0;
  ++statistics_.facets_created;
  return f;
}

void GrowingHull::start_from(const std::array<std::uint32_t, 4>& corners) {
  for (const std::uint32_t i : corners) add_vertex(points_[i], i);
  // The last is below the first three.
  for (const auto& [a, b, c] : {Triangle{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}})
    make_facet(a, b, c);
  hull_.facets[0].across = {side(1, 2), side(2, 2), side(3, 2)};
  hull_.facets[1].across = {side(3, 1), side(2, 0), side(0, 0)};
  hull_.facets[2].across = {side(1, 1), side(3, 0), side(0, 1)};
  hull_.facets[3].across = {side(2, 1), side(1, 0), side(0, 2)};
}

void GrowingHull::target_every_facet() {
  targets_.clear();
  for (std::uint32_t f = 0; f < hull_.facets.size(); ++f) {
    if (hull_.facets[f].round != kNone) targets_.push_back({f, 0});
  }
}

void GrowingHull::add(std::span<const std::uint32_t> indices) {
  target_every_facet();
  batch_count_ = 0;
  std::vector<std::uint32_t> wanted(indices.begin(), indices.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const std::uint32_t i : wanted) batch_[batch_count_++] = conflict_at(i);
  classify_batch(0);
  place_batch();
  grow();
}

void GrowingHull::add_all() {
  target_every_facet();
  const InnerEllipsoid inner(hull_, extent_);
  // Its vertices lie in their facets' planes and would all be decided exactly, to no avail.
  std::vector<std::uint32_t> known = hull_.input_indices;
  std::sort(known.begin(), known.end());
  known.push_back(kNone);
  auto next_known = known.begin();
  std::uint64_t inner_count = 0;
  batch_count_ = 0;
  for (std::size_t begin = 0; begin < points_.size(); begin += PointBlock::kMost) {
    const std::size_t first = batch_count_;
    const std::size_t end = std::min(begin + PointBlock::kMost, points_.size());
    for (std::size_t i = begin; i < end; ++i) {
      batch_[batch_count_] = conflict_at(static_cast<std::uint32_t>(i));
      const bool is_known = i == *next_known;
      next_known += is_known ? 1 : 0;
      const bool is_inner = inner.certainly_contains(points_[i]);
      inner_count += is_inner ? 1 : 0;
      batch_count_ += is_known || is_inner ? 0 : 1;
    }
    classify_batch(first);
    // Only those outside stay.
    std::size_t kept = first;
    for (std::size_t i = first; i < batch_count_; ++i) {
      batch_[kept] = batch_[i];
      kept += batch_[i].slot < targets_.size() ? 1 : 0;
    }
    batch_count_ = kept;
  }
  statistics_.points_discarded += inner_count;
  place_batch();
  grow();
}

/// Finds a target for each point of the block.
void GrowingHull::find_slots() {
  const auto nowhere = static_cast<std::uint32_t>(targets_.size());
  statistics_.orientation_tests += block_.count() * nowhere;
  block_.unmark(nowhere);
  bool has_doubt = false;
  for (std::uint32_t t = 0; t < nowhere; ++t)
    has_doubt |= block_.mark_above(hull_.facets[targets_[t].facet].plane, t);
  if (!has_doubt) return;
  for (std::size_t i = 0; i < block_.count(); ++i) {
    if (block_.slot(i) == nowhere) block_.set_slot(i, exact_slot(block_.source(i).point()));
  }
}

/// For a point that is certainly above no target: one that it is above nevertheless.
std::uint32_t GrowingHull::exact_slot(const Vec3& p) {
  std::uint32_t t = 0;
  for (; t < targets_.size(); ++t) {
    const GrowingFacet& facet = hull_.facets[targets_[t].facet];
    if (std::abs(facet.plane.height(p)) > doubt_of(facet.plane)) continue;
    ++statistics_.exact_fallbacks;
    if (orient3d_exact(corner(facet, 0), corner(facet, 1), corner(facet, 2), p) > 0) break;
  }
  return t;
}

/// Notes the slots of the batch from `begin` on.
void GrowingHull::classify_batch(std::size_t begin) {
  while (begin < batch_count_) {
    const std::size_t end = std::min(begin + PointBlock::kMost, batch_count_);
    block_.clear();
    for (std::size_t i = begin; i < end; ++i) block_.push(batch_[i]);
    find_slots();
    for (std::size_t i = begin; i < end; ++i) batch_[i].slot = block_.slot(i - begin);
    begin = end;
  }
}

/// Gives each target as much of the arena as it counts points, and the points inside one place
/// behind, where they overwrite each other. From then on `count` is where the next point goes.
void GrowingHull::reserve_ranges() {
  auto at = static_cast<std::uint32_t>(arena_end_);
  for (std::size_t t = 0; t + 1 < targets_.size(); ++t) {
    Target& target = targets_[t];
    if (target.count == 0) continue;
    GrowingFacet& facet = hull_.facets[target.facet];
    facet.first_conflict = at;
    facet.conflicts = target.count;
    queue_.push({target.facet, at}, place_of(facet));
    at += target.count;
    target.count = facet.first_conflict;
  }
  targets_.back().count = at;
  waiting_ += at - arena_end_;
  arena_end_ = at;
}

[[gnu::always_inline]] inline void GrowingHull::place(const Conflict& conflict,
                                                      std::uint32_t slot) {
  std::uint32_t& to = targets_[slot].count;
  arena_[to] = conflict;
  to += slot + 1 < targets_.size() ? 1 : 0;
}

/// Writes the batch behind the arena, each target's points together.
void GrowingHull::place_batch() {
  targets_.push_back({kNone, 0});
  for (std::size_t i = 0; i < batch_count_; ++i) ++targets_[batch_[i].slot].count;
  reserve_ranges();
  for (std::size_t i = 0; i < batch_count_; ++i) place(batch_[i], batch_[i].slot);
}

/// Moves what waits at a facet, if it still does, to the end of the arena.
bool GrowingHull::keep(FacetQueue::Entry& entry, const Conflict* from) {
  GrowingFacet& facet = hull_.facets[entry.facet];
  if (!is_waiting(entry)) return false;
  std::copy_n(from + facet.first_conflict, facet.conflicts, &arena_[arena_end_]);
  entry.first_conflict = facet.first_conflict = static_cast<std::uint32_t>(arena_end_);
  arena_end_ += facet.conflicts;
  return true;
}

/// Leaves only what waits in the arena, other cells' points first; once in points_.size()
/// placements at most.
void GrowingHull::close_gaps() {
  ConflictArray old;
  const Conflict* from = arena_.get();
  if (queue_.is_divided()) {  // not in the order of the arena
    old = unwritten_conflicts(arena_capacity_ + 1);
    old.swap(arena_);
    from = old.get();
  }
  const auto keeps = [&](FacetQueue::Entry& entry) { return keep(entry, from); };
  arena_end_ = 0;
  queue_.filter_other_cells(keeps);
  cell_begin_ = arena_end_;
  queue_.filter_current(keeps);
}

/// Many points, but few for a facet: time to go on by cells.
bool GrowingHull::is_to_be_divided() const {
  return !queue_.is_divided() && waiting_ > kManyWaiting &&
         waiting_ < kPointsInCell / 4 * queue_.count();
}

void GrowingHull::divide() {
  const double cells = static_cast<double>(waiting_) / kPointsInCell;
  queue_.divide(low_, extent_, static_cast<std::uint32_t>(std::sqrt(cells / kCellsCrossed)));
  for (const FacetQueue::Entry& entry : queue_.coming()) {
    if (is_waiting(entry)) queue_.push(entry, place_of(hull_.facets[entry.facet]));
  }
  queue_.next_cell();
  close_gaps();
}

/// What the cell at work leaves to others moves to where its own points were.
bool GrowingHull::next_cell() {
  arena_end_ = cell_begin_;
  for (FacetQueue::Deferred& d : queue_.deferred()) keep(d.entry, arena_.get());
  cell_begin_ = arena_end_;
  return queue_.next_cell();
}

void GrowingHull::grow() {
  do {
    while (!queue_.is_empty()) {
      if (arena_end_ + waiting_ > arena_capacity_) close_gaps();
      const FacetQueue::Entry entry = queue_.pop();
      if (is_waiting(entry)) add_point(entry.facet);
      if (is_to_be_divided()) divide();
    }
  } while (next_cell());
  queue_.clear();
  arena_end_ = cell_begin_ = 0;
}

std::size_t GrowingHull::farthest_conflict(const GrowingFacet& facet) const {
  std::size_t farthest = facet.first_conflict;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = facet.first_conflict; i < facet.first_conflict + facet.conflicts; ++i) {
    const double height = facet.plane.height(arena_[i].point());
    if (height > best) {
      best = height;
      farthest = i;
    }
  }
  return farthest;
}

[[gnu::always_inline]] inline bool GrowingHull::sees(const GrowingFacet& facet, const Vec3& p) {
  ++statistics_.orientation_tests;
  const double height = facet.plane.height(p);
  if (height > facet.plane.bound) return true;
  if (std::abs(height) > doubt_of(facet.plane)) return false;
  ++statistics_.exact_fallbacks;
  return orient3d_exact(corner(facet, 0), corner(facet, 1), corner(facet, 2), p) > 0;
}

/// Removes what `p` sees, counter-clockwise from `start`; the horizon's sides come in order.
void GrowingHull::find_horizon(std::uint32_t start, const Vec3& p) {
  horizon_.clear();
  seen_.clear();
  remove(start);
  walk_.assign({side(start, 2), side(start, 1), side(start, 0)});
  while (!walk_.empty()) {
    const std::uint32_t inner = walk_.back();
    walk_.pop_back();
    const std::uint32_t outer = hull_.facets[facet_of(inner)].across[edge_of(inner)];
    const std::uint32_t g = facet_of(outer);
    GrowingFacet& facet = hull_.facets[g];
    if (facet.round == kNone) continue;
    if (facet.round != round_ && sees(facet, p)) {
      remove(g);
      const std::uint32_t second = kNextEdge[edge_of(outer)];
      walk_.push_back(side(g, kNextEdge[second]));
      walk_.push_back(side(g, second));
    } else {
      facet.round = round_;  // known not to be seen
      horizon_.push_back({inner, outer});
    }
  }
}

void GrowingHull::remove(std::uint32_t facet) {
  hull_.facets[facet].round = kNone;
  seen_.push_back(facet);
}

/// Puts a facet between each edge of the horizon and the apex.
void GrowingHull::join_horizon(std::uint32_t apex) {
  targets_.clear();
  for (const auto& [inner, outer] : horizon_) {
    const GrowingFacet& seen = hull_.facets[facet_of(inner)];
    const std::uint32_t e = edge_of(inner);
    const std::uint32_t f = make_facet(seen.corners[e], seen.corners[kNextEdge[e]], apex);
    hull_.facets[f].across[0] = outer;
    hull_.facets[facet_of(outer)].across[edge_of(outer)] = side(f, 0);
    targets_.push_back({f, 0});
  }
  std::uint32_t previous = targets_.back().facet;
  for (const auto& [f, count] : targets_) {
    CARPUS_CHECK(hull_.facets[previous].corners[1] == hull_.facets[f].corners[0]);  // one chain
    hull_.facets[previous].across[1] = side(f, 2);
    hull_.facets[f].across[2] = side(previous, 1);
    previous = f;
  }
  free_.insert(free_.end(), seen_.begin(), seen_.end());
}

/// Gives the points of the removed facets, but the apex, to the fresh ones.
void GrowingHull::redistribute(std::size_t apex) {
  std::size_t count = 0;
  for (const std::uint32_t f : seen_) count += hull_.facets[f].conflicts;
  waiting_ -= count;
  if (count > PointBlock::kMost) {
    redistribute_many(apex);
    return;
  }
  block_.clear();
  for (const std::uint32_t f : seen_) {
    GrowingFacet& facet = hull_.facets[f];
    const std::size_t end = facet.first_conflict + facet.conflicts;
    for (std::size_t i = facet.first_conflict; i < end; ++i) block_.push(arena_[i], i != apex);
    facet.conflicts = 0;
  }
  if (block_.count() == 0) return;
  find_slots();
  targets_.push_back({kNone, 0});
  for (std::size_t i = 0; i < block_.count(); ++i) ++targets_[block_.slot(i)].count;
  reserve_ranges();
  for (std::size_t i = 0; i < block_.count(); ++i) place(block_.source(i), block_.slot(i));
}

void GrowingHull::redistribute_many(std::size_t apex) {
  batch_count_ = 0;
  for (const std::uint32_t f : seen_) {
    GrowingFacet& facet = hull_.facets[f];
    const std::size_t end = facet.first_conflict + facet.conflicts;
    for (std::size_t i = facet.first_conflict; i < end; ++i) {
      batch_[batch_count_] = arena_[i];
      batch_count_ += i == apex ? 0 : 1;
    }
    facet.conflicts = 0;
  }
  classify_batch(0);
  place_batch();
}

void GrowingHull::add_point(std::uint32_t start) {
  const std::size_t apex_conflict = farthest_conflict(hull_.facets[start]);
  const Vec3 p = arena_[apex_conflict].point();
  const std::uint32_t apex = add_vertex(p, arena_[apex_conflict].index);
  ++round_;
  find_horizon(start, p);
  join_horizon(apex);
  redistribute(apex_conflict);
}

}  // namespace carpus::hull
