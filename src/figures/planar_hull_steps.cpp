// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/planar_hull_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/text_format.hpp"
#include "drawing/svg.hpp"
#include "hull/planar_hull.hpp"

namespace carpus::figures {
namespace {

constexpr double kPanel = 420;
constexpr std::string_view kPoint = "#555555";
constexpr std::string_view kDone = "#1f4fa8";
constexpr std::string_view kTried = "#c9b27c";
constexpr std::string_view kChosen = "#c4161c";

/// Points of the plane (y up) to a panel of a page (y down).
class Panel {
 public:
  Panel(std::span<const Vec2> points, std::size_t column, std::size_t row)
      : left_(static_cast<double>(column) * kPanel), top_(static_cast<double>(row) * kPanel) {
    Vec2 low = points[0];
    Vec2 high = low;
    for (const Vec2& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    scale_ = (kPanel - 2 * kRim) / std::max(high.x - low.x, high.y - low.y);
    middle_ = {(low.x + high.x) / 2, (low.y + high.y) / 2};
  }
  [[nodiscard]] Vec2 operator()(const Vec2& p) const {
    return {left_ + kPanel / 2 + (p.x - middle_.x) * scale_,
            top_ + kPanel / 2 + 12 - (p.y - middle_.y) * scale_};
  }
  [[nodiscard]] std::string title(const std::string& text) const {
    return drawing::text_at(left_ + 16, top_ + 24, text, {.size = 15});
  }
  [[nodiscard]] std::string dots(std::span<const Vec2> points, std::string_view colour) const {
    std::string svg;
    for (const Vec2& p : points) svg += drawing::disc_at((*this)(p), 2.6, colour);
    return svg;
  }

 private:
  static constexpr double kRim = 42;
  double left_;
  double top_;
  double scale_ = 1;
  Vec2 middle_;
};

template <typename Index>
std::string outline(const Panel& panel,
                    std::span<const Vec2> points,
                    const std::vector<Index>& corners,
                    const drawing::Pen& pen) {
  std::vector<Vec2> on_page;
  for (const Index c : corners) on_page.push_back(panel(points[c]));
  return drawing::strokes(drawing::polygon_path(on_page), pen);
}

std::vector<std::uint32_t> hull_of(std::span<const Vec2> points) {
  auto hull = hull::build_planar_hull(points, hull::PlanarAlgorithm::GiftWrapping);
  if (hull.status != hull::HullStatus::Ok) {
    throw InvalidInput("these points have no convex hull in the plane: too few, or on one line");
  }
  return std::move(hull.corners);
}

/// Twice the area of a, b, c; positive where c lies to the left of the way from a to b.
double left_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

std::string draw_gift_wrapping(std::span<const Vec2> points) {
  const auto corners = hull_of(points);
  const std::size_t h = corners.size();
  std::string svg;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t done = std::min(h - 1, k * h / 4);  // edges found before this step
    const Panel panel(points, k % 2, k / 2);
    const Vec2& from = points[corners[done]];
    const Vec2& to = points[corners[(done + 1) % h]];
    std::string tried;
    for (const Vec2& p : points) {
      if (p != from && p != to) tried += drawing::line_path(panel(from), panel(p));
    }
    std::string found;
    for (std::size_t i = 0; i < done; ++i) {
      found += drawing::line_path(panel(points[corners[i]]), panel(points[corners[i + 1]]));
    }
    svg += panel.title(format("edge %zu of %zu", done + 1, h)) +
           drawing::strokes(tried, {kTried, 0.6}) + panel.dots(points, kPoint) +
           drawing::strokes(found, {kDone, 2.5}) +
           drawing::strokes(drawing::line_path(panel(from), panel(to)), {kChosen, 3}) +
           drawing::disc_at(panel(from), 5, kChosen);
  }
  return drawing::page(2 * kPanel, 2 * kPanel, svg);
}

std::vector<std::vector<std::size_t>> quickhull_rounds(std::span<const Vec2> points) {
  (void)hull_of(points);
  const auto before = [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  };
  std::size_t low = 0;
  std::size_t high = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (before(i, low)) low = i;
    if (before(high, i)) high = i;
  }
  std::vector<std::vector<std::size_t>> rounds{{low, high}};
  for (;;) {
    const auto& polygon = rounds.back();
    std::vector<std::size_t> next;
    for (std::size_t e = 0; e < polygon.size(); ++e) {
      const Vec2& a = points[polygon[e]];
      const Vec2& b = points[polygon[(e + 1) % polygon.size()]];
      next.push_back(polygon[e]);
      std::size_t farthest = points.size();
      double most = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double beyond = -left_of(a, b, points[i]);
        if (beyond > most && orient2d_exact(a, b, points[i]) < 0) {
          most = beyond;
          farthest = i;
        }
      }
      if (farthest < points.size()) next.push_back(farthest);
    }
    if (next.size() == polygon.size()) return rounds;
    rounds.push_back(std::move(next));
  }
}

std::string draw_quickhull(std::span<const Vec2> points) {
  const auto rounds = quickhull_rounds(points);
  std::string svg;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t round = k < 3 ? std::min(k, rounds.size() - 1) : rounds.size() - 1;
    const Panel panel(points, k % 2, k / 2);
    std::vector<Vec2> outside;
    const auto& polygon = rounds[round];
    for (const Vec2& p : points) {
      bool is_outside = false;
      for (std::size_t e = 0; e < polygon.size() && !is_outside; ++e) {
        is_outside =
            orient2d_exact(points[polygon[e]], points[polygon[(e + 1) % polygon.size()]], p) < 0;
      }
      if (is_outside) outside.push_back(p);
    }
    svg += panel.title(format("round %zu: %zu corners, %zu points still outside", round,
                              polygon.size(), outside.size())) +
           panel.dots(points, "#bbbbbb") + panel.dots(outside, kChosen) +
           outline(panel, points, polygon, {kDone, 2.5});
  }
  return drawing::page(2 * kPanel, 2 * kPanel, svg);
}

std::string draw_chan(std::span<const Vec2> points, std::size_t group) {
  constexpr std::array<std::string_view, 6> kHues{"#2f7d32", "#8a5a00", "#7b1fa2",
                                                  "#00727a", "#b0413e", "#4a5a96"};
  const auto corners = hull_of(points);
  std::string svg;
  for (std::size_t k = 0; k < 2; ++k) {
    const Panel panel(points, k, 0);
    svg += panel.title(k == 0 ? format("groups of %zu points in their hulls", group)
                              : std::string("wrapped about them"));
    for (std::size_t first = 0, g = 0; first < points.size(); first += group, ++g) {
      const auto members = points.subspan(first, std::min(group, points.size() - first));
      const std::string_view hue = kHues[g % kHues.size()];
      const auto own = hull::build_planar_hull(members, hull::PlanarAlgorithm::GrahamScan);
      svg += panel.dots(members, hue) + outline(panel, members, own.corners, {hue, 1.2, 0.8});
    }
    if (k == 1) svg += outline(panel, points, corners, {kChosen, 3});
  }
  return drawing::page(2 * kPanel, kPanel, svg);
}

}  // namespace carpus::figures
