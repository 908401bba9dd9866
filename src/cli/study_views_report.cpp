// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_views_report.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "core/text_format.hpp"

namespace carpus::cli {
namespace {

using view_trainer::Reading;
using view_trainer::Region;
using view_trainer::StudiedScrew;
using view_trainer::StudyRow;
using Json = nlohmann::ordered_json;

constexpr std::array kRegions{Region::Distal, Region::Proximal, Region::Side};

const char* name_of(Region region) {
  switch (region) {
    case Region::Distal:
      return "distal";
    case Region::Proximal:
      return "proximal";
    case Region::Side:
      break;
  }
  return "side";
}

/// "PA + LAT + 45P"; "all six".
std::string label_of(const std::vector<std::size_t>& views) {
  const auto standard = view_trainer::standard_views();
  if (views.size() == standard.size()) return "all";
  if (views.size() == 1) return std::string(standard[views.front()].name);
  std::string label;
  for (const std::size_t view : views) {
    label += (label.empty() ? "" : " + ") + std::string(standard[view].label);
  }
  return label;
}

/// Followed by spaces up to so many letters, of which UTF-8 takes several bytes each.
std::string padded(std::string text, std::size_t letters) {
  const auto count = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
  if (count < letters) text.append(letters - count, ' ');
  return text;
}

std::string share_text(const std::optional<double>& share) {
  return share ? format("%9.2f", *share) : "        -";
}

std::string rows_text(const std::vector<StudiedScrew>& screws, Reading reading) {
  std::string text = format("%-26s %9s %9s %9s %9s %12s\n", "view, or any of several", "all",
                            "distal", "proximal", "side", "specificity");
  for (const auto& views : view_trainer::view_sets()) {
    const StudyRow all = row_of(screws, views, reading);
    text += padded(label_of(views), 27) + share_text(all.sensitivity);
    for (const Region region : kRegions) {
      text += " " + share_text(row_of(screws, views, reading, region).sensitivity);
    }
    text += "    " + share_text(all.specificity) + "\n";
  }
  return text;
}

std::string mm_text(const view_trainer::MeanFirstRevealed& mean, std::size_t of) {
  if (!mean.depth_mm) return format("%16s", "never");
  return format("%6.1f mm (%zu/%zu)", *mean.depth_mm, mean.cases, of);
}

std::string first_revealed_text(const ViewsStudy& study) {
  std::string text =
      "\nHow far a screw on the longest line is out when it is first revealed (mean of cases):\n";
  text += format("%-34s %16s %16s\n", "", "distal", "proximal");
  const auto standard = view_trainer::standard_views();
  for (std::size_t i = 0; i <= standard.size(); ++i) {
    const auto& view = i < standard.size() ? standard[i] : view_trainer::pa_extended_view();
    text += padded(std::string(view.name), 34);
    for (const Region pole : {Region::Distal, Region::Proximal}) {
      text += " " + mm_text(mean_first_revealed(study.cases, pole, i), study.cases.size());
    }
    text += "\n";
  }
  return text;
}

std::string reading_text(const ViewsStudy& study) {
  std::string text = "\nThe outline as read, against the true one (mean of cases, mm):\n";
  const auto standard = view_trainer::standard_views();
  for (std::size_t i = 0; i < standard.size(); ++i) {
    double mean = 0;
    double deviation = 0;
    for (const auto& each : study.cases) {
      mean += each.reading_errors[i].mean_mm / static_cast<double>(study.cases.size());
      deviation += each.reading_errors[i].deviation_mm / static_cast<double>(study.cases.size());
    }
    text += "  " + padded(std::string(standard[i].name), 25) +
            format("%+5.2f +- %4.2f\n", mean, deviation);
  }
  return text;
}

/// Of those out there, in percent; "-" where there are none.
std::string missed(const std::vector<StudiedScrew>& screws,
                   const std::vector<std::size_t>& views,
                   Region region) {
  const auto found = row_of(screws, views, Reading::OnThePicture, region).sensitivity;
  return found ? format("%.0f %%", 100 * (1 - *found)) : "-";
}

std::string published_text(const ViewsStudy& study, const std::vector<StudiedScrew>& screws) {
  using view_trainer::view_index;
  const std::size_t pa = view_index("pa");
  const std::size_t lateral = view_index("lateral");
  const std::size_t oblique = view_index("oblique_45_pronated");
  const auto first = [&](std::size_t view) {
    return mm_text(mean_first_revealed(study.cases, Region::Proximal, view), study.cases.size());
  };
  std::string text = "\nPublished, on cadavers, beside ours:\n";
  text += "  distal penetrations that PA and lateral miss: about 50 % [S40]; ours " +
          missed(screws, {pa, lateral}, Region::Distal) + "\n";
  if (const auto limit =
          limit_that_misses_half(screws, {pa, lateral}, Reading::OnThePicture, Region::Distal)) {
    text +=
        format("    (they would miss half if only metal %.1f mm beyond the outline were called)\n",
               *limit);
  }
  text += "  the most sensitive single view for those: 45 degrees pronated [S40]; ours misses " +
          missed(screws, {oblique}, Region::Distal) + " by it, " +
          missed(screws, {lateral}, Region::Distal) + " by lateral, " +
          missed(screws, {pa}, Region::Distal) + " by PA\n";
  text +=
      "  proximal pole, first seen: skyline 0.8 mm, PA in ulnar deviation and extension 1.3 mm "
      "[S39]; ours" +
      first(view_index("skyline")) + " and" + first(view_trainer::standard_views().size()) + "\n";
  text +=
      "Why they differ: our screws are 3.3 to 3.8 mm wide, on many lines, and count what their "
      "rim\n"
      "does, theirs were 2.2 mm wide on one line and out by at most 2 mm [S40]. Our reader calls\n"
      "0.5 mm and never doubts which line is the scaphoid's: it looks within 2 mm of it, a person\n"
      "loses it under the trapezium. The cortex of simulated cases is even and easy to follow. "
      "The\n"
      "wrist's position in skyline and extension is an engineering value. Ours is an upper "
      "limit.\n";
  return text;
}

Json row_json(const StudyRow& row) {
  Json views = Json::array();
  for (const std::size_t view : row.views) {
    views.push_back(view_trainer::standard_views()[view].id);
  }
  const auto share = [](const std::optional<double>& s) { return s ? Json(*s) : Json(nullptr); };
  return {{"views", std::move(views)},
          {"screws", row.screws},
          {"sensitivity", share(row.sensitivity)},
          {"specificity", share(row.specificity)}};
}

Json rows_json(const std::vector<StudiedScrew>& screws,
               Reading reading,
               std::optional<Region> region = std::nullopt) {
  Json rows = Json::array();
  for (const auto& views : view_trainer::view_sets()) {
    rows.push_back(row_json(row_of(screws, views, reading, region)));
  }
  return rows;
}

Json cases_json(const ViewsStudy& study) {
  Json cases = Json::array();
  const auto standard = view_trainer::standard_views();
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const view_trainer::StudiedCase& each = study.cases[i];
    Json errors = Json::array();
    for (std::size_t view = 0; view < standard.size(); ++view) {
      errors.push_back({{"view", standard[view].id},
                        {"mean_mm", each.reading_errors[view].mean_mm},
                        {"deviation_mm", each.reading_errors[view].deviation_mm}});
    }
    const auto out = static_cast<std::size_t>(
        std::count_if(each.screws.begin(), each.screws.end(),
                      [](const StudiedScrew& screw) { return screw.is_out(); }));
    cases.push_back({{"case", each.pseudonym},
                     {"case_simulated", bool(study.simulated[i])},
                     {"screws_out", out},
                     {"screws_in", each.screws.size() - out},
                     {"outline_reading", std::move(errors)}});
  }
  return cases;
}

Json first_json(const ViewsStudy& study) {
  Json first = Json::array();
  const auto standard = view_trainer::standard_views();
  for (const Region pole : {Region::Distal, Region::Proximal}) {
    for (std::size_t i = 0; i <= standard.size(); ++i) {
      const auto& view = i < standard.size() ? standard[i] : view_trainer::pa_extended_view();
      const auto mean = mean_first_revealed(study.cases, pole, i);
      first.push_back({{"region", name_of(pole)},
                       {"view", view.id},
                       {"mean_mm", mean.depth_mm ? Json(*mean.depth_mm) : Json(nullptr)},
                       {"cases", mean.cases}});
    }
  }
  return first;
}

}  // namespace

std::vector<StudiedScrew> ViewsStudy::screws() const {
  std::vector<StudiedScrew> all;
  for (const auto& each : cases) all.insert(all.end(), each.screws.begin(), each.screws.end());
  return all;
}

std::string views_study_text(const ViewsStudy& study) {
  const std::vector<StudiedScrew> screws = study.screws();
  const auto out = std::count_if(screws.begin(), screws.end(),
                                 [](const StudiedScrew& screw) { return screw.is_out(); });
  std::string text = format(
      "in silico: %zu generated screws in %zu cases, %lld out by more than %.1f mm, the others in\n"
      "revealed: metal at least %.1f mm beyond the scaphoid's outline, as a model reader reads "
      "it\n\n",
      screws.size(), study.cases.size(), static_cast<long long>(out), view_trainer::kOutMm,
      view_trainer::kRevealedMm);
  text += "Sensitivity by where the screw is out, and specificity:\n";
  text += rows_text(screws, Reading::OnThePicture);
  text +=
      "\nThe same against the true outline, which nobody sees (specificity is 1 by geometry):\n";
  text += rows_text(screws, Reading::OfTheTruth);
  text += first_revealed_text(study) + reading_text(study) + published_text(study, screws);
  return text;
}

std::string views_study_json(const ViewsStudy& study) {
  const std::vector<StudiedScrew> screws = study.screws();
  Json by_region = Json::array();
  for (const Region region : kRegions) {
    by_region.push_back({{"region", name_of(region)},
                         {"rows", rows_json(screws, Reading::OnThePicture, region)},
                         {"rows_true_outline", rows_json(screws, Reading::OfTheTruth, region)}});
  }
  const Json figures{{"in_silico", true},
                     {"cases", cases_json(study)},
                     {"first_seed", study.first_seed},
                     {"screws_a_case", study.seeds},
                     {"screws", screws.size()},
                     {"revealed_mm", view_trainer::kRevealedMm},
                     {"out_mm", view_trainer::kOutMm},
                     {"rows", rows_json(screws, Reading::OnThePicture)},
                     {"rows_true_outline", rows_json(screws, Reading::OfTheTruth)},
                     {"by_region", std::move(by_region)},
                     {"first_revealed", first_json(study)}};
  return figures.dump(2) + "\n";
}

}  // namespace carpus::cli
