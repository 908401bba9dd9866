// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "cli/segmentation_study.hpp"
#include "core/text_format.hpp"
#include "drawing/svg.hpp"

namespace carpus::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of_label(std::uint8_t label) {
  return label == kScaphoidDistalLabel
             ? std::string(name_of(BoneId::Scaphoid, BonePart::Distal))
             : std::string(name_of(static_cast<BoneId>(label), BonePart::Whole));
}

std::vector<double> voxels_of(const SegmentationStudy& study) {
  std::set<double> sizes;
  for (const StudiedScan& scan : study.scans) sizes.insert(scan.voxel_mm);
  return {sizes.begin(), sizes.end()};
}

std::string line_of(const std::string& name, const FlagFigures& f) {
  const std::string auc = f.auc ? format("%.3f", *f.auc) : std::string("-");
  return format("%-14s %6zu %8.4f %8.4f %7zu %6.1f %% %7zu %7.1f %% %12.1f %% %7s\n", name.c_str(),
                f.bones, f.mean_dice, f.worst_dice, f.wrong, 100 * f.detection(), f.wrong_found,
                100 * f.flag_detection(), 100 * f.false_alarm_rate(), auc.c_str());
}

Json json_of(const FlagFigures& f) {
  Json json{{"bones", f.bones},
            {"dice_mean", f.mean_dice},
            {"dice_min", f.worst_dice},
            {"below_0_95", f.wrong},
            {"told", f.told},
            {"detection", f.detection()},
            {"below_0_95_found", f.wrong_found},
            {"flagged", f.flagged},
            {"false_alarm_rate", f.false_alarm_rate()}};
  json["auc"] = f.auc ? Json(*f.auc) : Json(nullptr);
  return json;
}

Json json_of(const StudiedScan& scan) {
  Json bones = Json::array();
  for (const StudiedBone& bone : scan.bones) {
    bones.push_back({{"name", name_of_label(bone.label)},
                     {"dice", bone.dice},
                     {"found", bone.is_found},
                     {"confidence", bone.trust.confidence},
                     {"flagged", bone.is_told()},
                     {"why", bone.trust.why},
                     {"concerns", reconstruct::concerns_of(bone.evidence)}});
  }
  return {{"seed", scan.seed},
          {"voxel_mm", scan.voxel_mm},
          {"difficulty", scan.difficulty},
          {"conditions", scan.conditions},
          {"refused", scan.refused},
          {"side_right", scan.is_side_right},
          {"misfit", scan.naming_cost},
          {"bones", bones}};
}

}  // namespace

std::string segmentation_study_text(const SegmentationStudy& study) {
  std::string text = format(
      "%zu simulated scans. \"Told\": flagged, said to be missing, or the scan refused; "
      "\"flagged\": "
      "of what was found.\n\n",
      study.scans.size());
  text += format("%-14s %6s %8s %8s %7s %8s %7s %9s %14s %7s\n", "", "bones", "Dice", "worst",
                 "< 0.95", "told", "found", "flagged", "false alarms", "AUC");
  for (int d = 0; d < kDifficulties; ++d) {
    text += line_of(format("difficulty %d", d),
                    figures_of(study.scans, [&](const auto& s) { return s.difficulty == d; }));
  }
  for (const double mm : voxels_of(study)) {
    text += line_of(format("%.1f mm", mm),
                    figures_of(study.scans, [&](const auto& s) { return s.voxel_mm == mm; }));
  }
  text += line_of("all", figures_of(study.scans, [](const auto&) { return true; }));
  std::size_t refused = 0;
  std::size_t other_side = 0;
  for (const StudiedScan& scan : study.scans) {
    refused += scan.refused.empty() ? 0U : 1U;
    other_side += scan.refused.empty() && !scan.is_side_right ? 1U : 0U;
  }
  text += format("\nrefused: %zu; wrong side: %zu\n", refused, other_side);
  for (const StudiedScan& scan : study.scans) {
    for (const StudiedBone& bone : scan.bones) {
      if (!bone.is_wrong() || bone.is_told()) continue;
      text += format("silent: seed %llu %s Dice %.3f, confidence %.2f\n",
                     static_cast<unsigned long long>(scan.seed), name_of_label(bone.label).c_str(),
                     bone.dice, bone.trust.confidence);
    }
  }
  return text;
}

std::string segmentation_study_json(const SegmentationStudy& study) {
  Json json;
  json["concerns"] = reconstruct::concern_names();
  json["all"] = json_of(figures_of(study.scans, [](const auto&) { return true; }));
  json["difficulties"] = Json::array();
  for (int d = 0; d < kDifficulties; ++d) {
    json["difficulties"].push_back(
        json_of(figures_of(study.scans, [&](const auto& s) { return s.difficulty == d; })));
  }
  json["voxels"] = Json::array();
  for (const double mm : voxels_of(study)) {
    Json figures =
        json_of(figures_of(study.scans, [&](const auto& s) { return s.voxel_mm == mm; }));
    figures["voxel_mm"] = mm;
    json["voxels"].push_back(figures);
  }
  json["scans"] = Json::array();
  for (const StudiedScan& scan : study.scans) json["scans"].push_back(json_of(scan));
  return json.dump(1) + "\n";
}

std::string segmentation_study_picture(const SegmentationStudy& study) {
  constexpr double kLeft = 90;
  constexpr double kTop = 90;
  constexpr double kWidth = 820;
  constexpr double kHeight = 480;
  constexpr double kLeastDice = 0.5;
  constexpr std::string_view kInk = "#1a1f26";
  constexpr std::string_view kRule = "#d5dade";
  constexpr std::array<std::string_view, kDifficulties> kColours{"#4b7a2a", "#0b6fb8", "#c28a00",
                                                                 "#b5471b", "#6b3fa0"};
  const auto x_of = [&](double dice) {
    return kLeft + kWidth * (std::max(dice, kLeastDice) - kLeastDice) / (1 - kLeastDice);
  };
  const auto y_of = [&](double confidence) { return kTop + kHeight * (1 - confidence); };
  std::string svg = drawing::text_at(
      kLeft, 40, format("Confidence over Dice, %zu simulated scans", study.scans.size()),
      {.colour = kInk, .size = 22, .is_bold = true});
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double y = y_of(tenth / 10.0);
    svg += drawing::line_from(kLeft, y, kLeft + kWidth, y, kRule);
    svg += drawing::text_at(kLeft - 10, y + 5, format("%.1f", tenth / 10.0),
                            {.anchor = drawing::Anchor::End, .colour = kInk, .size = 15});
    const double dice = kLeastDice + 0.05 * tenth;
    svg += drawing::text_at(x_of(dice), kTop + kHeight + 24,
                            (tenth == 0 ? "<= " : "") + format("%.1f", dice),
                            {.anchor = drawing::Anchor::Middle, .colour = kInk, .size = 15});
  }
  svg += drawing::line_from(x_of(kGoodDice), kTop, x_of(kGoodDice), kTop + kHeight, kInk);
  svg += drawing::line_from(kLeft, y_of(reconstruct::kTrustedConfidence), kLeft + kWidth,
                            y_of(reconstruct::kTrustedConfidence), kInk);
  for (const StudiedScan& scan : study.scans) {
    for (const StudiedBone& bone : scan.bones) {
      svg += drawing::disc_at({x_of(bone.dice), y_of(bone.trust.confidence)}, 3,
                              kColours[static_cast<std::size_t>(scan.difficulty)]);
    }
  }
  for (std::size_t d = 0; d < kColours.size(); ++d) {
    const double x = kLeft + 150 * static_cast<double>(d);
    svg += drawing::disc_at({x + 6, 66}, 6, kColours[d]);
    svg += drawing::text_at(x + 18, 71, format("difficulty %zu", d), {.colour = kInk, .size = 15});
  }
  return drawing::page(kLeft + kWidth + 40, kTop + kHeight + 50, svg);
}

}  // namespace carpus::cli
