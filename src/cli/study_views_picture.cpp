// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One line a set of views: a mark for each place where screws are out, at the share revealed.
#include <array>
#include <string_view>

#include "cli/study_views_report.hpp"
#include "core/text_format.hpp"
#include "drawing/svg.hpp"

namespace carpus::cli {
namespace {

using view_trainer::Reading;
using view_trainer::Region;

constexpr double kWidth = 1100;
constexpr double kLeft = 330;
constexpr double kRight = 930;
constexpr double kTop = 120;
constexpr double kLine = 42;
constexpr std::string_view kInk = "#1a1f26";
constexpr std::string_view kFaint = "#6b7380";
constexpr std::string_view kRule = "#d5dade";

struct Series {
  Region region;
  std::string_view name;
  std::string_view colour;
  double above;  ///< so that marks of one share are seen side by side
};
constexpr std::array kSeries{Series{Region::Distal, "distal", "#0b6fb8", -8},
                             Series{Region::Proximal, "proximal", "#b5471b", 0},
                             Series{Region::Side, "side", "#4b7a2a", 8}};

double x_of(double share) { return kLeft + share * (kRight - kLeft); }

std::string label_of(const std::vector<std::size_t>& views) {
  const auto standard = view_trainer::standard_views();
  if (views.size() == standard.size()) return "all six";
  if (views.size() == 1) return std::string(standard[views.front()].name);
  std::string label;
  for (const std::size_t view : views) {
    label += (label.empty() ? "" : " + ") + std::string(standard[view].label);
  }
  return label;
}

std::string draw_axis(double bottom) {
  std::string svg;
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double x = x_of(tenth / 10.0);
    svg += drawing::line_from(x, kTop - 14, x, bottom, kRule);
    svg += drawing::text_at(x, bottom + 24, format("%d %%", tenth * 10),
                            {.anchor = drawing::Anchor::Middle, .colour = kFaint, .size = 15});
  }
  return svg;
}

std::string draw_key() {
  std::string svg;
  double x = kLeft;
  for (const Series& series : kSeries) {
    svg += drawing::disc_at({x, 78}, 7, series.colour);
    svg += drawing::text_at(x + 14, 83, series.name, {.colour = kInk, .size = 16});
    x += 110;
  }
  svg += drawing::disc_at({x, 78}, 7, kInk) + drawing::disc_at({x, 78}, 5, "#ffffff");
  return svg +
         drawing::text_at(x + 14, 83, "published, distal [S40]", {.colour = kInk, .size = 16});
}

}  // namespace

std::string views_study_picture(const ViewsStudy& study) {
  const auto screws = study.screws();
  const auto sets = view_trainer::view_sets();
  const double bottom = kTop + kLine * static_cast<double>(sets.size());
  std::string svg = drawing::text_at(
      30, 40,
      format("Screws revealed of those that are out, in silico: %zu screws, %zu cases",
             screws.size(), study.cases.size()),
      {.colour = kInk, .size = 22, .is_bold = true});
  svg += draw_key() + draw_axis(bottom);
  svg += drawing::text_at(kRight + 40, kTop - 24, "specificity", {.colour = kFaint, .size = 15});
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const double y = kTop + kLine * static_cast<double>(i) + 12;
    svg += drawing::text_at(30, y + 6, label_of(sets[i]), {.colour = kInk, .size = 17});
    svg += drawing::line_from(kLeft, y, kRight, y, kRule);
    for (const Series& series : kSeries) {
      const auto row = row_of(screws, sets[i], Reading::OnThePicture, series.region);
      if (!row.sensitivity) continue;
      svg += drawing::disc_at({x_of(*row.sensitivity), y + series.above}, 6, series.colour);
    }
    const bool is_published =
        sets[i] == std::vector<std::size_t>{view_trainer::view_index("pa"),
                                            view_trainer::view_index("lateral")};
    if (is_published) {
      svg += drawing::disc_at({x_of(0.5), y}, 8, kInk) +
             drawing::disc_at({x_of(0.5), y}, 6, "#ffffff");
    }
    const auto all = row_of(screws, sets[i], Reading::OnThePicture);
    if (all.specificity) {
      svg += drawing::text_at(kRight + 60, y + 6, format("%.2f", *all.specificity),
                              {.colour = kInk, .size = 17});
    }
  }
  return drawing::page(kWidth, bottom + 50, svg);
}

}  // namespace carpus::cli
