// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "cli/canvas.hpp"
#include "cli/stroke_text.hpp"

namespace carpus::cli {
namespace {

using convex::Verdict;
using survey::MotionOutcome;

constexpr std::uint32_t kWidth = 1320;
constexpr std::uint32_t kHeight = 900;
constexpr PixelArea kScene{50, 50, 850, 770};
constexpr double kColumn = 950;  ///< left edge of the figures
constexpr double kText = 15;     ///< height of capitals
constexpr double kLine = 30;     ///< from line to line
constexpr Colour kInk{0.10, 0.12, 0.15};
constexpr Colour kFaint{0.42, 0.45, 0.50};
constexpr Colour kFirst{0.87, 0.80, 0.66};
constexpr Colour kFirstEdge{0.45, 0.38, 0.25};
constexpr Colour kSecond{0.35, 0.60, 1.00};
constexpr Colour kSecondEdge{0.08, 0.20, 0.50};
constexpr Colour kMark{0.80, 0.10, 0.15};
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

void draw_edges(Canvas& canvas,
                const View& view,
                const CollideBody& body,
                const std::vector<Vec3>& corners,
                const Colour& colour,
                double opacity) {
  const auto faces = body.hull.faces();
  const auto is_seen = [&](std::uint32_t face) {
    return view.faces_viewer(body.placement.rotation * body.hull.face_plane(face).normal);
  };
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const auto& face = faces[i];
    for (std::size_t e = 0; e < face.corners.size(); ++e) {
      if (!is_seen(i) || (face.neighbours[e] < i && is_seen(face.neighbours[e]))) continue;
      const std::uint32_t next = face.corners[(e + 1) % face.corners.size()];
      const double width = is_seen(face.neighbours[e]) ? 1.0 : 2.0;  // the outline is bolder
      canvas.stroke(view(corners[face.corners[e]]), view(corners[next]), width, colour,
                    is_seen(face.neighbours[e]) ? opacity : 1);
    }
  }
}

template <typename Pixel>
void draw_faces(const View& view,
                const CollideBody& body,
                const std::vector<Vec3>& corners,
                const Colour& colour,
                Pixel pixel) {
  const ConvexPolytope& hull = body.hull.polytope();
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const Vec3 normal = body.placement.rotation * hull.planes[f].normal;
    if (!view.faces_viewer(normal)) continue;
    const Triangle& t = hull.facets[f];
    pixel(view(corners[t[0]]), view(corners[t[1]]), view(corners[t[2]]),
          shaded(colour, view.brightness(normal)));
  }
}

void mark_point(Canvas& canvas, const Vec3& at, const Colour& colour) {
  canvas.disc(at, 7.5, kPaper);
  canvas.disc(at, 5.5, colour);
}

void mark_line(Canvas& canvas, const Vec3& from, const Vec3& to, const Colour& colour) {
  canvas.stroke(from, to, 6, kPaper);
  canvas.stroke(from, to, 3, colour);
}

void mark_arrow(Canvas& canvas, const Vec3& from, const Vec3& to, const Colour& colour) {
  mark_line(canvas, from, to, colour);
  const double size = std::hypot(to.x - from.x, to.y - from.y);
  if (size < 1) return;
  const Vec3 along{(to.x - from.x) / size, (to.y - from.y) / size, 0};
  const Vec3 across{-along.y, along.x, 0};
  const double barb = std::min(14.0, 0.6 * size);
  canvas.stroke(to, to - along * barb + across * (barb / 2), 3, colour);
  canvas.stroke(to, to - along * barb - across * (barb / 2), 3, colour);
}

/// A label beside a mark, on a strip of paper so that it can be read over edges.
void label(Canvas& canvas, const Vec3& at, const std::string& text, const Colour& colour) {
  const double width = text_width(kText, text);
  const double x = std::clamp(at.x + 18, 8.0, kColumn - 40 - width);
  const double y = std::clamp(at.y - 14, 30.0, kHeight - 90.0);
  canvas.stroke({x, y - kText / 2, 0}, {x + width - kText / 3, y - kText / 2, 0}, kText + 12,
                kPaper, 0.85);
  draw_text(canvas, x, y, kText, colour, text);
}

std::string number(double value, const char* unit) {
  std::array<char, 64> text{};
  const double magnitude = std::abs(value);
  const char* format = magnitude != 0 && (magnitude < 1e-3 || magnitude >= 1e6) ? "%.3e" : "%.3f";
  std::snprintf(text.data(), text.size(), format, value);
  return std::string(text.data()) + unit;
}

std::string triple(const Vec3& v) {
  return number(v.x, ", ") + number(v.y, ", ") + number(v.z, "");
}

void draw_marks(Canvas& canvas, const View& view, const CollideReport& report) {
  if (report.closest) {
    const Vec3 a = view(report.closest->on_first);
    const Vec3 b = view(report.closest->on_second);
    mark_line(canvas, a, b, kMark);
    mark_point(canvas, a, kMark);
    mark_point(canvas, b, kMark);
    label(canvas, a.x > b.x ? a : b, number(report.closest->distance_mm, " mm"), kMark);
  }
  if (report.penetration) {
    const Vec3 from = view(report.penetration->on_second);
    const Vec3 to = view(report.penetration->on_first);
    mark_point(canvas, from, kMark);
    mark_arrow(canvas, from, to, kMark);
    label(canvas, from.x > to.x ? from : to, number(report.penetration->depth_mm, " mm"), kMark);
  }
}

/// The second hull's outline at first contact, the way there and the point of contact.
void draw_sweep(Canvas& canvas,
                const View& view,
                const CollideBody& second,
                const std::vector<Vec3>& corners,
                const CollideReport& report) {
  const Vec3 way = report.velocity_mm_per_s.value_or(Vec3{}) * report.sweep.t_min_s;
  std::vector<Vec3> moved = corners;
  for (Vec3& v : moved) v += way;
  draw_edges(canvas, view, second, moved, kGhost, 0.12);
  const Vec3 start = second.placement(second.hull.interior_point());
  const bool is_ahead = report.sweep.t_min_s > 0;
  mark_arrow(canvas, view(is_ahead ? start : start + way), view(is_ahead ? start + way : start),
             kGhost);
  mark_point(canvas, view(report.sweep.first.point), kGhost);
}

bool has_times(const CollideReport& report) {
  const MotionOutcome outcome = report.sweep.outcome;
  return report.velocity_mm_per_s && std::isfinite(report.sweep.t_min_s) &&
         (outcome == MotionOutcome::WillMeet || outcome == MotionOutcome::Touching ||
          outcome == MotionOutcome::HasPassed);
}

/// A bar of 1, 2 or 5 times a power of ten mm, at most a fifth of the scene.
void draw_scale(Canvas& canvas, const View& view) {
  const double wished = kScene.width / 5 / view.pixels_per_mm();
  const double power = std::pow(10, std::floor(std::log10(wished)));
  const double mm = wished / power >= 5 ? 5 * power : (wished / power >= 2 ? 2 * power : power);
  const double y = kHeight - 34;
  const double end = kScene.left + mm * view.pixels_per_mm();
  canvas.stroke({kScene.left, y, 0}, {end, y, 0}, 3, kInk);
  for (const double x : {kScene.left, end}) canvas.stroke({x, y - 6, 0}, {x, y + 6, 0}, 3, kInk);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g mm", mm);
  draw_text(canvas, end + 18, y + kText / 2, kText, kInk, text.data());
}

/// Lines of the column of figures, from the top.
class Column {
 public:
  explicit Column(Canvas& canvas) : canvas_(canvas) {}
  void big(const std::string& text, const Colour& colour) {
    y_ += 12;
    draw_text(canvas_, kColumn, y_, 26, colour, text);
    y_ += 1.5 * kLine;
  }
  void line(const std::string& text, const Colour& colour = kInk) {
    const double width = text_width(kText, text);
    const double height = std::min(kText, kText * (kWidth - kColumn - 20) / std::max(width, 1.0));
    draw_text(canvas_, kColumn, y_, height, colour, text);
    y_ += kLine;
  }
  void figure(const std::string& name, const std::string& value) {
    y_ += 8;
    line(name, kFaint);
    line(value);
  }
  void key(const std::string& name, const Colour& colour, const Colour& edge) {
    canvas_.disc({kColumn + 8, y_ - kText / 2, 0}, 9, edge);
    canvas_.disc({kColumn + 8, y_ - kText / 2, 0}, 7, colour);
    const double width = text_width(kText, name);
    const double height = std::min(kText, kText * (kWidth - kColumn - 50) / std::max(width, 1.0));
    draw_text(canvas_, kColumn + 30, y_, height, kInk, name);
    y_ += kLine;
  }

 private:
  Canvas& canvas_;
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
  column.key(first.name, kFirst, kFirstEdge);
  column.key(second.name, kSecond, kSecondEdge);
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
    column.line(words(report.sweep.outcome), kGhost);
  }
  if (has_times(report)) {
    column.figure("first and last contact (s)",
                  number(report.sweep.t_min_s, ", ") + number(report.sweep.t_max_s, ""));
  }
  column.figure("method", std::string(report.method->name));
  column.line(number(report.query_us, " us, cold"), kFaint);
}

}  // namespace

Picture draw_collision(const CollideBody& first,
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
  Canvas canvas(kWidth, kHeight);
  draw_faces(view, first, of_first, kFirst,
             [&](const Vec3& a, const Vec3& b, const Vec3& c, const Colour& colour) {
               canvas.fill(a, b, c, [&](int x, int y, double z) { canvas.plot(x, y, z, colour); });
             });
  draw_edges(canvas, view, first, of_first, kFirstEdge, 0.2);
  draw_faces(view, second, of_second, kSecond,
             [&](const Vec3& a, const Vec3& b, const Vec3& c, const Colour& colour) {
               canvas.fill(a, b, c, [&](int x, int y, double) {
                 canvas.blend(x, y, colour, kSecondOpacity);
               });
             });
  draw_edges(canvas, view, second, of_second, kSecondEdge, 0.2);
  if (shows_sweep) draw_sweep(canvas, view, second, of_second, report);
  draw_marks(canvas, view, report);
  draw_scale(canvas, view);
  Column column(canvas);
  write_figures(column, first, second, report);
  return canvas.picture();
}

}  // namespace carpus::cli
