// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_picture.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/text_format.hpp"
#include "drawing/facets.hpp"
#include "drawing/svg.hpp"

namespace carpus::cli {
namespace {

using convex::Verdict;
using survey::MotionOutcome;

using drawing::Colour;
using drawing::kInFront;
using drawing::Solid;
using drawing::View;

constexpr double kWidth = 1320;
constexpr double kHeight = 900;
constexpr drawing::PageArea kScene{50, 50, 850, 770};
constexpr double kColumn = 950;  ///< left edge of the figures
constexpr double kText = 20;
constexpr double kLine = 30;  ///< from line to line
constexpr std::string_view kPaper = "#ffffff";
constexpr std::string_view kInk = "#1a1f26";
constexpr std::string_view kFaint = "#6b7380";
constexpr std::string_view kMark = "#cc1a26";
constexpr Colour kFirst{0.87, 0.80, 0.66};
constexpr Colour kFirstEdge{0.45, 0.38, 0.25};
constexpr Colour kSecond{0.35, 0.60, 1.00};
constexpr Colour kSecondEdge{0.08, 0.20, 0.50};
constexpr Colour kGhost{0.10, 0.50, 0.35};
constexpr double kSecondOpacity = 0.30;

std::vector<Vec3> placed_vertices(const CollideBody& body) {
  std::vector<Vec3> placed;
  placed.reserve(body.hull.vertices().size());
  for (const Vec3& v : body.hull.vertices()) placed.push_back(body.placement(v));
  return placed;
}

/// The line to be seen: between the nearest points, along the depth, or of the sweep.
Vec3 seen_line(const CollideReport& report) {
  if (report.closest) return report.closest->normal;
  if (report.penetration) return report.penetration->direction;
  return report.velocity_mm_per_s.value_or(Vec3{});
}

/// As near to the usual place of the viewer as shows `line` at its full length.
Vec3 viewer_beside(const Vec3& line) {
  const Vec3 along = normalized_or(line, {0, 0, 1});
  const Vec3 beside = kInFront - along * dot(kInFront, along);
  if (length(beside) > 0.2) return beside;
  return any_perpendicular(along);
}

Solid solid_of(const CollideBody& body, const std::vector<Vec3>& corners) {
  Solid solid{corners, {}};
  const auto faces = body.hull.faces();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    solid.faces.push_back({faces[i].corners, faces[i].neighbours,
                           body.placement.rotation * body.hull.face_plane(i).normal});
  }
  return solid;
}

/// A dot with a rim of paper.
std::string mark_point(const Vec2& at, std::string_view colour) {
  return drawing::disc_at(at, 7.5, kPaper) + drawing::disc_at(at, 5.5, colour);
}

std::string mark_path(const std::string& path, std::string_view colour) {
  return drawing::strokes(path, {kPaper, 6}) + drawing::strokes(path, {colour, 3});
}

std::string mark_arrow(const Vec2& from, const Vec2& to, std::string_view colour) {
  std::string path = drawing::line_path(from, to);
  const double size = std::hypot(to.x - from.x, to.y - from.y);
  if (size >= 1) {
    const double barb = std::min(14.0, 0.6 * size) / size;
    const Vec2 back{(from.x - to.x) * barb, (from.y - to.y) * barb};
    for (const double side : {0.5, -0.5}) {
      path +=
          drawing::line_path(to, {to.x + back.x - side * back.y, to.y + back.y + side * back.x});
    }
  }
  return mark_path(path, colour);
}

/// A label beside a mark, with a rim so that it can be read over edges.
std::string label(const Vec2& at, const std::string& text, std::string_view colour) {
  const double x = std::clamp(at.x + 18, 8.0, kScene.left + kScene.width - 60);
  const double y = std::clamp(at.y - 14, 30.0, kHeight - 90.0);
  return drawing::text_at(x, y, text, {.colour = colour, .size = kText, .has_rim = true});
}

std::string number(double value, const char* unit) {
  const double magnitude = std::abs(value);
  const bool is_plain = magnitude == 0 || (magnitude >= 1e-3 && magnitude < 1e6);
  return format(is_plain ? "%.3f" : "%.3e", value) + unit;
}

std::string triple(const Vec3& v) {
  return number(v.x, ", ") + number(v.y, ", ") + number(v.z, "");
}

std::string draw_marks(const View& view, const CollideReport& report) {
  std::string svg;
  if (report.closest) {
    const Vec2 a = view(report.closest->on_first);
    const Vec2 b = view(report.closest->on_second);
    svg += mark_path(drawing::line_path(a, b), kMark) + mark_point(a, kMark) + mark_point(b, kMark);
    svg += label(a.x > b.x ? a : b, number(report.closest->distance_mm, " mm"), kMark);
  }
  if (report.penetration) {
    const Vec2 from = view(report.penetration->on_second);
    const Vec2 to = view(report.penetration->on_first);
    svg += mark_point(from, kMark) + mark_arrow(from, to, kMark);
    svg += label(from.x > to.x ? from : to, number(report.penetration->depth_mm, " mm"), kMark);
  }
  return svg;
}

/// The second hull's outline at first contact, the way there and the point of contact.
std::string draw_sweep(const View& view,
                       const CollideBody& second,
                       const std::vector<Vec3>& corners,
                       const CollideReport& report) {
  const Vec3 way = report.velocity_mm_per_s.value_or(Vec3{}) * report.sweep.t_min_s;
  std::vector<Vec3> moved = corners;
  for (Vec3& v : moved) v += way;
  const Vec3 start = second.placement(second.hull.interior_point());
  const bool is_ahead = report.sweep.t_min_s > 0;
  const std::string ink = drawing::hex(kGhost);
  return draw_edges(view, solid_of(second, moved), kGhost, 0.12) +
         mark_arrow(view(is_ahead ? start : start + way), view(is_ahead ? start + way : start),
                    ink) +
         mark_point(view(report.sweep.first.point), ink);
}

bool has_times(const CollideReport& report) {
  const MotionOutcome outcome = report.sweep.outcome;
  return report.velocity_mm_per_s && std::isfinite(report.sweep.t_min_s) &&
         (outcome == MotionOutcome::WillMeet || outcome == MotionOutcome::Touching ||
          outcome == MotionOutcome::HasPassed);
}

/// A bar of 1, 2 or 5 times a power of ten mm, at most a fifth of the scene.
std::string draw_scale(const View& view) {
  const double wished = kScene.width / 5 / view.units_per_mm();
  const double power = std::pow(10, std::floor(std::log10(wished)));
  const double mm = wished / power >= 5 ? 5 * power : (wished / power >= 2 ? 2 * power : power);
  const double y = kHeight - 34;
  const double end = kScene.left + mm * view.units_per_mm();
  std::string svg = drawing::line_from(kScene.left, y, end, y, kInk, 3);
  for (const double x : {kScene.left, end}) svg += drawing::line_from(x, y - 6, x, y + 6, kInk, 3);
  return svg +
         drawing::text_at(end + 18, y + 7, format("%g mm", mm), {.colour = kInk, .size = kText});
}

/// Lines of the column of figures, from the top.
class Column {
 public:
  void big(const std::string& text, std::string_view colour) {
    y_ += 12;
    svg_ += drawing::text_at(kColumn, y_, text, {.colour = colour, .size = 34});
    y_ += 1.5 * kLine;
  }
  void line(const std::string& text, std::string_view colour = kInk) { write(0, text, colour); }
  void figure(const std::string& name, const std::string& value) {
    y_ += 8;
    line(name, kFaint);
    line(value);
  }
  void key(const std::string& name, std::string_view colour, const Colour& edge) {
    const Vec2 at{kColumn + 8, y_ - 7};
    svg_ += drawing::disc_at(at, 9, drawing::hex(edge)) + drawing::disc_at(at, 7, colour);
    write(30, name, kInk);
  }
  [[nodiscard]] const std::string& svg() const { return svg_; }

 private:
  void write(double indent, const std::string& text, std::string_view colour) {
    const double size = drawing::fitting_size(text, kText, kWidth - kColumn - indent - 20);
    svg_ += drawing::text_at(kColumn + indent, y_, text, {.colour = colour, .size = size});
    y_ += kLine;
  }

  std::string svg_;
  double y_ = 66;
};

std::string words(MotionOutcome outcome) {
  switch (outcome) {
    case MotionOutcome::WillMeet:
      return "will meet";
    case MotionOutcome::Touching:
      return "touch now";
    case MotionOutcome::HasPassed:
      return "have passed";
    case MotionOutcome::NeverMeet:
      return "never meet on this course";
    default:
      return "not known";
  }
}

void write_figures(Column& column,
                   const CollideBody& first,
                   const CollideBody& second,
                   const CollideReport& report) {
  const bool apart = report.verdict == Verdict::Apart;
  column.big(apart ? "apart" : (report.verdict == Verdict::Meet ? "meet" : "not known"),
             apart ? kInk : kMark);
  column.key(first.name, drawing::hex(kFirst), kFirstEdge);
  column.key(second.name, drawing::hex(kSecond), kSecondEdge);
  if (has_times(report)) column.key(second.name + " at first contact", kPaper, kGhost);
  if (report.closest) {
    column.figure("distance", number(report.closest->distance_mm, " mm"));
    column.figure("nearest points (mm)", triple(report.closest->on_first));
    column.line(triple(report.closest->on_second));
    column.figure("normal", triple(report.closest->normal));
  }
  if (report.penetration) {
    column.figure("depth", number(report.penetration->depth_mm, " mm"));
    column.figure("parts along", triple(report.penetration->direction));
    column.figure("deepest points (mm)", triple(report.penetration->on_first));
    column.line(triple(report.penetration->on_second));
  }
  if (report.velocity_mm_per_s) {
    column.figure("moving at (mm/s)", triple(*report.velocity_mm_per_s));
    column.line(words(report.sweep.outcome), drawing::hex(kGhost));
  }
  if (has_times(report)) {
    column.figure("first and last contact (s)",
                  number(report.sweep.t_min_s, ", ") + number(report.sweep.t_max_s, ""));
  }
  column.figure("method", std::string(report.method->name));
  column.line(number(report.query_us, " us, cold"), kFaint);
}

}  // namespace

std::string draw_collision(const CollideBody& first,
                           const CollideBody& second,
                           const CollideReport& report) {
  const std::vector<Vec3> of_first = placed_vertices(first);
  const std::vector<Vec3> of_second = placed_vertices(second);
  const bool shows_sweep = has_times(report);
  std::vector<Vec3> seen = of_first;
  seen.insert(seen.end(), of_second.begin(), of_second.end());
  if (shows_sweep) {
    const Vec3 way = report.velocity_mm_per_s.value_or(Vec3{}) * report.sweep.t_min_s;
    for (const Vec3& v : of_second) seen.push_back(v + way);
  }
  const View view(seen, kScene, viewer_beside(seen_line(report)));
  const Solid first_solid = solid_of(first, of_first);
  const Solid second_solid = solid_of(second, of_second);
  std::string svg = draw_faces(view, first_solid, kFirst) +
                    draw_edges(view, first_solid, kFirstEdge, 0.2) +
                    draw_faces(view, second_solid, kSecond, kSecondOpacity) +
                    draw_edges(view, second_solid, kSecondEdge, 0.2);
  if (shows_sweep) svg += draw_sweep(view, second, of_second, report);
  svg += draw_marks(view, report) + draw_scale(view);
  Column column;
  write_figures(column, first, second, report);
  return drawing::page(kWidth, kHeight, svg + column.svg());
}

}  // namespace carpus::cli
