// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Along the axis the field is a cubic within each cell, and the radius is linear: the gap's minimum
// and its crossings of zero are those of a cubic, exactly. Cells are skipped only where the gap
// cannot reach what matters (a lower minimum, the edge of a stretch): the field changes by no more
// than steepest() times the way by axes. So the minimum is the field's own, however the axis is
// walked.
#include "contact/instrument_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carpus::contact {
namespace {

/// Least advance [mm]: gets the walk over a cell's border when rounding leaves it on the near side.
/// The gap that it may miss is below 2e-7 mm.
constexpr double kLeastStepMm = 1e-7;

/// Slower than this along an axis of the grid [cells/mm], the shaft stays in its layer of cells.
constexpr double kLeastCellsPerMm = 1e-9;

/// Where two fields cross, the smaller one may be taken for so long [mm]; the gap is off by as much
/// at most, for they differ by less than 2 per mm.
constexpr double kLeastSplitMm = 1e-4;

/// Stops that crossings of two fields may take in a cell of the finer one; a dozen halvings each.
constexpr int kStopsPerCutCell = 8;

/// What lies so far beneath a surface found in a cut bone is tried as a proof of bone [mm].
constexpr double kProofStepMm = 0.1;
constexpr int kProofSteps = 6;

constexpr double kPi = 3.14159265358979323846;
constexpr int kBisections = 24;  ///< a cell's 0.7 mm to less than 1e-7 mm

/// The gap along the axis within one cell, from the cell's entry [mm].
struct GapCubic {
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;

  [[nodiscard]] double at(double s) const noexcept { return c0 + s * (c1 + s * (c2 + s * c3)); }

  /// Where in [0, end] it is least.
  [[nodiscard]] double minimum(double end, double at_end) const noexcept {
    // The slope is a quadratic between its Bernstein coefficients: most cells are monotone.
    const double slope = c1 + c2 * end;
    const double slope_at_end = slope + c2 * end + 3 * c3 * end * end;
    if (c1 >= 0 && slope >= 0 && slope_at_end >= 0) return 0;
    if (c1 <= 0 && slope <= 0 && slope_at_end <= 0) return end;
    double best = at_end < c0 ? end : 0.0;
    double least = std::min(c0, at_end);
    const auto consider = [&](double s) {
      if (!(s > 0 && s < end)) return;  // false for NaN
      if (const double value = at(s); value < least) {
        least = value;
        best = s;
      }
    };
    // Both roots of c1 + 2 c2 s + 3 c3 s^2 without cancellation.
    const double discriminant = c2 * c2 - 3 * c3 * c1;
    if (discriminant >= 0) {
      const double root = std::sqrt(discriminant);
      const double q = -(c2 + (c2 < 0 ? -root : root));
      consider(q / (3 * c3));
      consider(c1 / q);
    }
    return best;
  }

  /// Between a place where it is at most `level` and one where it is above it.
  [[nodiscard]] double crossing(double below, double above, double level) const noexcept {
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (below + above);
      (at(middle) <= level ? below : above) = middle;
    }
    return below;
  }
};

/// The part of a cell where the gap is at most some level; empty if from > to.
struct Span {
  double from = 1;
  double to = 0;
  [[nodiscard]] double length() const noexcept { return to > from ? to - from : 0.0; }
};

Span span_below(const GapCubic& gap, double end, double at_end, double lowest, double level) {
  if (!(gap.at(lowest) <= level)) return {};
  return {gap.c0 <= level ? 0.0 : gap.crossing(lowest, 0, level),
          at_end <= level ? end : gap.crossing(lowest, end, level)};
}

/// Balls of the axis between two knots.
struct Piece {
  double from = 0;
  double to = 0;
  double radius = 0;  ///< at `from`
  double slope = 0;
};

/// A ball of the shape.
struct AxisPlace {
  double gap = 0;
  double z = 0;
};

/// A bone as scanned.
struct WholeBone {
  static constexpr bool kIsCut = false;
  const fields::ContactField& bone;
  [[nodiscard]] double steepest() const noexcept { return bone.steepest(); }
};

/// A bone with cuts: the larger of two fields, whose cells nest.
struct BoneWithCuts {
  static constexpr bool kIsCut = true;
  const fields::ContactField& bone;
  const fields::CutField& cut;
  [[nodiscard]] double steepest() const noexcept {
    return std::max(bone.steepest(), cut.steepest());
  }
};

template <typename Source>
class AxisWalk {
 public:
  AxisWalk(const Source& source,
           const InstrumentShape& shape,
           const Pose<frame::Bone, frame::Tool>& bone_from_tool,
           double cap)
      : source_(source), field_(source.bone), shape_(shape), pose_(bone_from_tool) {
    const fields::ContactField& field = field_;
    const Vec3 axis = pose_.rotation.column(2);
    front_ = field.cells_from_point(pose_.translation);
    along_ = axis * field.per_spacing();
    steepest_ = source.steepest() * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    for (std::size_t a = 0; a < 3; ++a) {
      // An axis along which nothing moves is never left: its border lies far ahead.
      const bool moves = std::abs(along_[a]) >= kLeastCellsPerMm;
      per_along_[a] = moves ? 1 / along_[a] : 1 / kLeastCellsPerMm;
      ahead_[a] = moves && along_[a] < 0 ? 0.0 : (moves ? 1.0 : 2.0);
    }
    products_ = {along_.y * along_.z, along_.x * along_.z, along_.x * along_.y};
    const auto& cells = field.cell_count();
    steps_left_ = 64 + 4 * (cells[0] + cells[1] + cells[2]);
    if (Source::kIsCut) steps_left_ *= kStopsPerCutCell * fields::kCutCellsPerCell;
    const auto& thread = shape.thread();
    core_level_ = thread ? -thread->depth_mm : -std::numeric_limits<double>::infinity();
    best_.gap = cap;
  }

  /// False if the walk exceeded its bound.
  bool run() noexcept {
    const auto knots = shape_.knots();
    if (knots.size() == 1) walk({knots[0].z_mm, knots[0].z_mm, knots[0].radius_mm, 0});
    for (std::size_t i = 1; i < knots.size(); ++i) {
      const double length = knots[i].z_mm - knots[i - 1].z_mm;
      const double rise = knots[i].radius_mm - knots[i - 1].radius_mm;
      walk({knots[i - 1].z_mm, knots[i].z_mm, knots[i - 1].radius_mm,
            length > 0 ? rise / length : 0.0});
    }
    if (is_open_) close();
    return steps_left_ > 0;
  }

  [[nodiscard]] const AxisPlace& best() const noexcept { return best_; }
  [[nodiscard]] bool found() const noexcept { return found_; }
  [[nodiscard]] const ContactPatch& patch() const noexcept { return patch_; }

  /// The field's gradient at a ball's centre [mm/mm].
  [[nodiscard]] Vec3 gradient_at(const AxisPlace& place) const noexcept {
    const Stop stop = stop_at(place.z, {place.z, place.z, 0, 0});
    return stop.polynomial.slope(stop.place) * stop.per_spacing;
  }
  [[nodiscard]] Point<frame::Bone> surface_at(const AxisPlace& place,
                                              const Vec3& normal) const noexcept {
    const double distance = place.gap + shape_.radius_at(place.z);
    return {pose_.translation + pose_.rotation.column(2) * place.z - normal * distance};
  }

  /// Sums become figures.
  void finish() noexcept {
    patch_.centre_z_mm = weight_ > 0 ? weighted_z_ / weight_ : best_.z;
    if (shape_.kind() == ShapeKind::Sphere && best_.gap < 0) {
      const double depth = std::min(-best_.gap, shape_.greatest_radius_mm());
      patch_.area_mm2 = kPi * depth * (2 * shape_.greatest_radius_mm() - depth);
    }
    const auto& thread = shape_.thread();
    if (thread) patch_.thread_turns = patch_.length_mm / thread->pitch_mm;
  }

 private:
  /// What one stop of the walk knows.
  struct Stop {
    double z = 0;
    double step = 0;    ///< to the cell's far border
    double radius = 0;  ///< of the ball at z
    double slope = 0;   ///< of the radius
    Vec3 place;         ///< in the cell, 0 to 1
    fields::CellPolynomial polynomial;
    GapCubic gap;
    double per_spacing = 0;  ///< of the polynomial's grid
  };

  bool clip(Piece& piece) const noexcept {
    const double start = piece.from;
    for (std::size_t a = 0; a < 3; ++a) {
      const double last = field_.cell_count()[a];
      if (std::abs(along_[a]) < kLeastCellsPerMm) {
        if (!(front_[a] >= 0 && front_[a] <= last)) return false;
        continue;
      }
      const double at_low = -front_[a] / along_[a];
      const double at_high = (last - front_[a]) / along_[a];
      piece.from = std::max(piece.from, std::min(at_low, at_high));
      piece.to = std::min(piece.to, std::max(at_low, at_high));
    }
    piece.radius += piece.slope * (piece.from - start);
    return piece.from <= piece.to;
  }

  void walk(Piece piece) noexcept {
    if (!clip(piece)) return;
    const double steepest = steepest_ + std::abs(piece.slope);
    const double per_steepest = 1 / steepest;
    double z = piece.from;
    while (steps_left_ > 0) {
      --steps_left_;
      Stop stop = stop_at(z, piece);
      const double stride = free_way(stop.gap.c0) * per_steepest;
      if (stride > stop.step) {
        stop.step = std::min(stride, piece.to - z);
        pass_over(stop);
      } else {
        stop.step = std::min(stop.step, piece.to - z);
        search(stop, steepest);
      }
      z += stop.step;
      if (!(z < piece.to)) return;
    }
  }

  /// Along one axis: the cell at a coordinate in cells, the one ahead on a border.
  struct AxisCell {
    int cell;
    double place;   ///< in the cell, 0 to 1
    double border;  ///< way to where it is left [mm]
  };
  static AxisCell axis_cell(double x, int last, double ahead, double per_along) noexcept {
    int cell = std::clamp(static_cast<int>(x), 0, last);
    if (ahead == 0 && x <= cell && cell > 0) --cell;
    const double place = x - cell;
    return {cell, place, (ahead - place) * per_along};
  }

  [[nodiscard]] Stop stop_at(double z, const Piece& piece) const noexcept {
    Stop stop = stop_in<1>(z, piece, [&](const VoxelIndex& cell, fields::CellPolynomial& p) {
      (void)field_.load(cell, p);
    });
    if constexpr (Source::kIsCut) {
      bool is_near = false;
      const Stop cut = stop_in<fields::kCutCellsPerCell>(
          z, piece, [&](const VoxelIndex& cell, fields::CellPolynomial& p) {
            is_near = source_.cut.load(cell, p);
          });
      // A brick of cuts holds whole cells of the bone's field.
      const double step = is_near ? std::min(stop.step, cut.step) : stop.step;
      stop = larger(stop, cut, step);
    }
    return stop;
  }

  /// In a grid that is Finer times as fine as the bone's.
  template <int Finer, typename Load>
  [[nodiscard]] Stop stop_in(double z, const Piece& piece, const Load& load) const noexcept {
    const auto& cells = field_.cell_count();
    const Vec3 along = along_ * Finer;
    const Vec3 at = (front_ + along_ * z) * Finer;
    constexpr double kPerFiner = 1.0 / Finer;
    const AxisCell x = axis_cell(at.x, cells[0] * Finer - 1, ahead_.x, per_along_.x * kPerFiner);
    const AxisCell y = axis_cell(at.y, cells[1] * Finer - 1, ahead_.y, per_along_.y * kPerFiner);
    const AxisCell w = axis_cell(at.z, cells[2] * Finer - 1, ahead_.z, per_along_.z * kPerFiner);
    const double border = std::min(std::min(x.border, y.border), w.border);
    const Vec3 place{x.place, y.place, w.place};
    fields::CellPolynomial p;
    load({x.cell, y.cell, w.cell}, p);
    const double radius = piece.radius + piece.slope * (z - piece.from);
    const Vec3 products = products_ * (Finer * Finer);
    const GapCubic gap{
        p.value(place) - radius, dot(p.slope(place), along) - piece.slope,
        p.yz * products.x + p.xz * products.y + p.xy * products.z + p.xyz * dot(place, products),
        p.xyz * products.x * along.x};
    return {z,   std::max(border, kLeastStepMm), radius, piece.slope, place, p,
            gap, field_.per_spacing() * Finer};
  }

  /// The larger of two gaps up to where the other may be; at most `step` far.
  static Stop larger(const Stop& a, const Stop& b, double step) noexcept {
    const GapCubic e{a.gap.c0 - b.gap.c0, a.gap.c1 - b.gap.c1, a.gap.c2 - b.gap.c2,
                     a.gap.c3 - b.gap.c3};
    bool is_a = true;
    while (true) {
      // Their difference lies between its Bernstein coefficients.
      const double second = e.c0 + step * e.c1 / 3;
      const double third = e.c0 + step * (2 * e.c1 + step * e.c2) / 3;
      const double last = e.at(step);
      is_a = e.c0 >= 0 && second >= 0 && third >= 0 && last >= 0;
      if (is_a || (e.c0 <= 0 && second <= 0 && third <= 0 && last <= 0)) break;
      if (!(step > kLeastSplitMm)) {
        is_a = e.at(0.5 * step) >= 0;
        break;
      }
      step *= 0.5;
    }
    Stop result = is_a ? a : b;
    result.step = step;
    return result;
  }

  /// By how much the gap may change before it concerns the answer.
  [[nodiscard]] double free_way(double gap) const noexcept {
    if (gap > 0) return gap - std::max(best_.gap, 0.0);
    const double to_edges = std::min(-gap, std::abs(gap - core_level_));
    return is_open_ ? std::min(to_edges, gap - deepest_.gap) : 0.0;
  }

  /// The rest of the stride is like its start: clear, or in contact at a depth of no interest.
  void pass_over(const Stop& stop) noexcept {
    if (stop.gap.c0 > 0) {
      if (is_open_) close();
      return;
    }
    touch(stop, {0, stop.step}, stop.gap.c0);
    if (stop.gap.c0 <= core_level_) patch_.core_length_mm += stop.step;
  }

  void search(const Stop& stop, double steepest) noexcept {
    const double at_end = stop.gap.at(stop.step);
    const double lowest = 0.5 * (stop.gap.c0 + at_end - steepest * stop.step);
    if (!is_open_ && lowest > std::max(best_.gap, 0.0)) return;
    const double s = stop.gap.minimum(stop.step, at_end);
    const double least = stop.gap.at(s);
    if (!(least <= 0)) {
      if (is_open_) close();
      consider({least, stop.z + s});
      return;
    }
    const Span span = span_below(stop.gap, stop.step, at_end, s, 0);
    if (!is_open_) open(stop.z + span.from);
    if (least < deepest_.gap) deepest_ = {least, stop.z + s};
    touch(stop, span, stop.gap.at(0.5 * (span.from + span.to)));
    if (least <= core_level_) {
      patch_.core_length_mm += span_below(stop.gap, stop.step, at_end, s, core_level_).length();
    }
    if (span.to < stop.step) close();
  }

  void consider(const AxisPlace& place) noexcept {
    if (!(place.gap < best_.gap)) return;
    best_ = place;
    found_ = true;
  }

  void touch(const Stop& stop, const Span& span, double gap_at_middle) noexcept {
    const double length = span.length();
    const double depth = std::max(-gap_at_middle, 0.0);
    const double middle = 0.5 * (span.from + span.to);
    const double radius = stop.radius + stop.slope * middle;
    const double chord = depth < radius ? 2 * std::sqrt(depth * (2 * radius - depth)) : 2 * radius;
    patch_.length_mm += length;
    patch_.area_mm2 += length * chord;
    weight_ += length * depth;
    weighted_z_ += length * depth * (stop.z + middle);
    to_ = stop.z + span.to;
  }

  void open(double z) noexcept {
    is_open_ = true;
    from_ = z;
    deepest_ = {std::numeric_limits<double>::infinity(), z};
  }

  void close() noexcept {
    is_open_ = false;
    consider(deepest_);
    ++patch_.stretches_found;
    auto& kept = patch_.stretches;
    std::size_t count = patch_.stretch_count;
    if (count == kept.size()) {  // the shallowest goes, if it is not the new one
      const auto shallowest =
          std::min_element(kept.begin(), kept.end(),
                           [](const auto& a, const auto& b) { return a.depth_mm < b.depth_mm; });
      if (!(shallowest->depth_mm < -deepest_.gap)) return;
      std::move(shallowest + 1, kept.end(), shallowest);
      --count;
    }
    const Vec3 normal = normalized_or(gradient_at(deepest_), {0, 0, 0});
    kept[count] = {from_, to_, deepest_.z, -deepest_.gap, surface_at(deepest_, normal), {normal}};
    patch_.stretch_count = static_cast<std::uint8_t>(count + 1);
  }

  const Source source_;
  const fields::ContactField& field_;
  const InstrumentShape& shape_;
  const Pose<frame::Bone, frame::Tool>& pose_;
  Vec3 front_;      ///< the tool's origin in cells
  Vec3 along_;      ///< its +z, cells per mm
  Vec3 per_along_;  ///< 1 / along_
  Vec3 ahead_;      ///< where a cell is left, from its low corner
  Vec3 products_;   ///< of along_: yz, xz, xy
  double steepest_ = 0;
  double core_level_ = 0;
  int steps_left_ = 0;

  AxisPlace best_;
  bool found_ = false;
  bool is_open_ = false;  ///< a stretch is being walked
  double from_ = 0;       ///< of that stretch
  double to_ = 0;
  AxisPlace deepest_;  ///< of that stretch
  double weight_ = 0;
  double weighted_z_ = 0;
  ContactPatch patch_;
};

}  // namespace

double lowest_gap_mm(const fields::ContactField& field,
                     const InstrumentShape& shape,
                     double field_gap_mm) noexcept {
  const double radius = shape.least_radius_mm();
  return field.lowest_distance(field_gap_mm + radius) - radius;
}

namespace {

/// All but highest_gap_mm and Buried.
template <typename Source>
SurfaceContact contact_with(const Source& source,
                            const InstrumentShape& shape,
                            const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                            double within_mm) noexcept {
  SurfaceContact result;
  const fields::ContactField& field = source.bone;
  const double greatest = greatest_gap_mm(field, shape);
  const bool is_pose_finite =
      is_finite(bone_from_tool.translation) && is_finite(bone_from_tool.rotation.column(2));
  if (!(greatest > 0 && is_pose_finite)) return result;
  const double cap = within_mm > 0 ? std::min(within_mm, greatest) : 0.0;
  AxisWalk<Source> walk(source, shape, bone_from_tool, cap);
  if (!walk.run()) return result;

  const AxisPlace& best = walk.best();
  result.gap_mm = best.gap;
  result.lowest_gap_mm = lowest_gap_mm(field, shape, best.gap);
  result.highest_gap_mm = std::numeric_limits<double>::infinity();
  if (!walk.found()) {
    result.outcome = ContactOutcome::Far;
    result.gap_mm = result.lowest_gap_mm;
    return result;
  }
  walk.finish();
  result.z_mm = best.z;
  const Vec3 gradient = walk.gradient_at(best);
  result.normal = {normalized_or(gradient, {0, 0, 0})};
  result.point = walk.surface_at(best, result.normal.v);
  result.steepness = length(gradient);
  result.patch = walk.patch();
  result.outcome = best.gap > 0 ? ContactOutcome::Near : ContactOutcome::Touching;
  return result;
}

/// Where the clamped distance may be the deepest there is, the true one may be any depth.
void name_buried(SurfaceContact& contact,
                 const InstrumentShape& shape,
                 double error_mm,
                 double deepest_mm) noexcept {
  if (contact.gap_mm + shape.least_radius_mm() - error_mm > -deepest_mm) return;
  contact.outcome = ContactOutcome::Buried;
  contact.lowest_gap_mm = -std::numeric_limits<double>::infinity();
}

}  // namespace

SurfaceContact find_contact(const fields::ContactField& field,
                            const InstrumentShape& shape,
                            const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                            double within_mm) noexcept {
  SurfaceContact result = contact_with(WholeBone{field}, shape, bone_from_tool, within_mm);
  if (result.outcome != ContactOutcome::Near && result.outcome != ContactOutcome::Touching) {
    return result;
  }
  const double radius = shape.radius_at(result.z_mm);
  result.highest_gap_mm = field.highest_distance(result.gap_mm + radius) - radius;
  name_buried(result, shape, field.error_mm(), field.band_mm());
  return result;
}

SurfaceContact find_contact(const fields::CutBone& left,
                            const InstrumentShape& shape,
                            const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                            double within_mm) noexcept {
  if (!left.cut.is_cut()) return find_contact(left.bone, shape, bone_from_tool, within_mm);
  SurfaceContact result =
      contact_with(BoneWithCuts{left.bone, left.cut}, shape, bone_from_tool, within_mm);
  if (result.outcome != ContactOutcome::Near && result.outcome != ContactOutcome::Touching) {
    return result;
  }
  // A place that is proven to be bone, no deeper than it must be. The distance changes by no more
  // than the way to it.
  const double radius = shape.radius_at(result.z_mm);
  const Vec3 centre = (bone_from_tool * Point<frame::Tool>{{0, 0, result.z_mm}}).v;
  const double to_surface = std::max(result.gap_mm + radius, 0.0);
  for (int i = 0; i <= kProofSteps; ++i) {
    const double way = i == 0 ? 0.0 : to_surface + kProofStepMm * i;
    const double highest = left.highest_if_bone(centre - result.normal.v * way);
    if (highest < 0)
      result.highest_gap_mm = std::min(result.highest_gap_mm, highest + way - radius);
  }
  name_buried(result, shape, left.error_mm(), std::min(left.bone.band_mm(), fields::kCutDepthMm));
  return result;
}

}  // namespace carpus::contact
