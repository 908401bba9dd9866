// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/score_json.hpp"

#include <nlohmann/json.hpp>

#include "procedure/screw_catalogue.hpp"

namespace carpus::procedure {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json point_json(const Vec3& point) { return Json::array({point.x, point.y, point.z}); }

Json line_json(const PlacedLine& line, const char* from, const char* to) {
  return {{from, point_json(line.from)}, {to, point_json(line.to)}};
}

Json placement_json(const PlacementPicture& picture) {
  Json json;
  json["central_axis"] = line_json(picture.central_axis, "proximal_mm", "distal_mm");
  json["waist_mm"] = point_json(picture.waist);
  json["wire"] = picture.wire ? line_json(*picture.wire, "entry_mm", "tip_mm") : Json(nullptr);
  json["screw"] = nullptr;
  if (picture.screw) {
    json["screw"] = line_json(*picture.screw, "tail_mm", "tip_mm");
    json["screw"]["tip_diameter_mm"] = picture.screw_tip_diameter_mm;
    json["screw"]["tail_diameter_mm"] = picture.screw_tail_diameter_mm;
  }
  return json;
}

Json item_json(const ScoreItem& item) {
  return {{"id", item.id},
          {"label", item.label},
          {"value", number_or_null(item.value)},
          {"unit", item.unit},
          {"target", item.target},
          {"grade", name_of(item.grade)},
          {"points", item.points},
          {"points_possible", item.points_possible},
          {"reason", item.reason}};
}

}  // namespace

std::string score_json(const ScoreReport& report, int indent) {
  Json json;
  json["score_version"] = 1;
  json["overall"] = report.overall;
  json["fixation_acceptable"] = report.is_fixation_acceptable;
  json["must_haves"] = Json::array();
  for (const MustHave& must : report.must_haves) {
    json["must_haves"].push_back(
        {{"id", must.id}, {"label", must.label}, {"fulfilled", must.fulfilled}});
  }
  json["items"] = Json::array();
  for (const ScoreItem& item : report.items) json["items"].push_back(item_json(item));
  json["central_axis_length_mm"] = report.central_axis_length_mm;
  json["central_cylinder_radius_mm"] = report.central_cylinder_radius_mm;
  json["longest_line_mm"] = report.longest_line_mm;
  json["angle_to_longest_line_deg"] = number_or_null(report.angle_to_longest_line_deg);
  json["true_length_mm"] = number_or_null(report.true_length_mm);
  json["gauge_reading_mm"] = number_or_null(report.gauge_reading_mm);
  json["ideal_screw_index"] = report.ideal_screw_index;
  json["ideal_screw"] = report.ideal_screw;
  json["chosen_screw_index"] = report.chosen_screw_index;
  json["chosen_screw"] = report.chosen_screw;
  json["penetration_at"] = report.penetration_at;
  json["placement"] = placement_json(report.placement);
  return json.dump(indent);
}

std::string screw_catalogue_json(int indent) {
  Json json = Json::array();
  int index = 0;
  for (const Screw& screw : screw_catalogue()) {
    json.push_back({{"index", index++},
                    {"name", screw.name},
                    {"family", screw.family},
                    {"length_mm", screw.length_mm},
                    {"tip_diameter_mm", screw.tip_diameter_mm},
                    {"tail_diameter_mm", screw.tail_diameter_mm},
                    {"wire_diameter_mm", kWireDiameterMm},
                    {"confirmed", screw.confirmed}});
  }
  return json.dump(indent);
}

}  // namespace carpus::procedure
