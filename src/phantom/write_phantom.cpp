// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/write_phantom.hpp"

#include <array>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "case_io/write_volume.hpp"
#include "core/error.hpp"

namespace carpus::phantom {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(const Mat3& m) {
  return Json::array({json_of(m.rows[0]), json_of(m.rows[1]), json_of(m.rows[2])});
}

/// Name to number, for the labels that occur.
Json label_numbers(const Phantom& phantom) {
  const std::set<std::uint8_t> present(phantom.labels.values().begin(),
                                       phantom.labels.values().end());
  const bool is_broken = phantom.fracture && phantom.fracture->is_apart;
  Json labels;
  labels["background"] = kBackgroundLabel;
  for (const BoneId bone : kAllBones) {
    const auto label = static_cast<std::uint8_t>(bone);
    if (!present.contains(label)) continue;
    const bool is_part = bone == BoneId::Scaphoid && is_broken;
    labels[std::string(name_of(bone, is_part ? BonePart::Proximal : BonePart::Whole))] = label;
  }
  if (is_broken) {
    labels[std::string(name_of(BoneId::Scaphoid, BonePart::Distal))] = kScaphoidDistalLabel;
    labels["fracture_gap"] = kFractureGapLabel;
  }
  return labels;
}

Json volumes_mm3(const Phantom& phantom) {
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t label : phantom.labels.values()) ++counts[label];
  const Json numbers = label_numbers(phantom);
  Json volumes;
  for (const auto& [name, number] : numbers.items()) {
    if (number != kBackgroundLabel) {
      volumes[name] = static_cast<double>(counts[number.get<std::size_t>()]) *
                      phantom.labels.geometry().voxel_volume_mm3();
    }
  }
  return volumes;
}

/// The scanner, the positioning and the patient, by the names of ScanOptions.
Json json_of_scan(const ScanOptions& scan) {
  return {
      {"point_spread_fwhm_mm", scan.point_spread_fwhm_mm},
      {"edge_enhancement", scan.edge_enhancement},
      {"noise_hu", scan.noise_hu},
      {"slice_mm", scan.slice_mm},
      {"beam_hardening_hu", scan.beam_hardening_hu},
      {"metal_radius_mm", scan.metal_radius_mm},
      {"is_screw", scan.is_screw},
      {"metal_streaks_hu", scan.metal_streaks_hu},
      {"motion_step_mm", scan.motion_step_mm},
      {"has_table", scan.has_table},
      {"cast_mm", scan.cast_mm},
      {"cast_hu", scan.cast_hu},
      {"tilt_degrees", scan.tilt_degrees},
      {"proximal_reach_mm", scan.proximal_reach_mm},
      {"distal_reach_mm", scan.distal_reach_mm},
      {"width_mm", scan.width_mm},
      {"cut_off_mm", scan.cut_off_mm},
      {"bone_density", scan.bone_density},
      {"cortex_thickness", scan.cortex_thickness},
      {"warp_mm", scan.warp_mm},
      {"size_variation", scan.size_variation},
      {"scapholunate_gap_mm", scan.scapholunate_gap_mm},
      {"is_fused", scan.is_fused},
      {"bipartite_mm", scan.bipartite_mm},
      {"hamate_facet_mm", scan.hamate_facet_mm},
      {"has_fingers", scan.has_fingers},
  };
}

Json truth_of(const Phantom& phantom) {
  const PhantomOptions& o = phantom.options;
  const LongAxis& axis = phantom.scaphoid_axis;
  const auto pole = [&](double t) {
    return json_of((axis.centroid + axis.direction * t) * o.scale);
  };
  Json truth;
  truth["simulated"] = true;
  truth["seed"] = o.seed;
  truth["side"] = name_of(o.side);
  truth["scale"] = o.scale;
  truth["fracture"] = name_of(o.fracture);
  truth["scan"] = json_of_scan(o.scan);
  truth["spacing_mm"] = json_of(phantom.ct.geometry().spacing);
  truth["wrist_from_patient"] = {
      {"rotation", json_of(phantom.wrist_from_patient.rotation)},
      {"translation_mm", json_of(phantom.wrist_from_patient.translation)}};
  truth["scaphoid_long_axis_in_wrist"] = {{"proximal_mm", pole(axis.least)},
                                          {"distal_mm", pole(axis.greatest)},
                                          {"waist_mm", pole(axis.waist)}};
  if (phantom.fracture) {
    const Fracture& n = *phantom.fracture;
    truth["fracture_in_wrist"] = {{"point_mm", json_of(n.point * o.scale)},
                                  {"normal", json_of(n.normal)},
                                  {"gap_mm", n.gap_mm * o.scale},
                                  {"lost_mm", n.lost_mm * o.scale},
                                  {"distal_fragment_rotation", json_of(n.rotation)},
                                  {"pivot_mm", json_of(n.pivot * o.scale)},
                                  {"shift_mm", json_of(n.shift * o.scale)}};
  }
  truth["volumes_mm3"] = volumes_mm3(phantom);
  return truth;
}

void write_json(const std::filesystem::path& file, const Json& json) {
  std::ofstream out(file);
  out << json.dump(1) << '\n';
  out.close();
  if (!out) throw IoError(file.string() + ": could not be written; make room on the disk");
}

}  // namespace

void write_phantom(const Phantom& phantom,
                   const std::filesystem::path& folder,
                   CtFormat format,
                   case_io::Overwrite overwrite,
                   const Progress& progress) {
  case_io::AtomicFolder out(folder, overwrite);
  const std::string description = "simulated wrist, seed " + std::to_string(phantom.options.seed);
  if (format == CtFormat::Dicom) {
    case_io::DicomDescription text;
    text.series_description = description;
    text.side = phantom.options.side;
    text.seed = phantom.options.seed;
    case_io::write_dicom_series(out.staging() / "dicom", phantom.ct.view(), text, progress);
  } else {
    case_io::write_volume<std::int16_t>(out.staging() / "ct.nii.gz", phantom.ct.view(),
                                        description);
  }
  case_io::write_volume<std::uint8_t>(out.staging() / "labels.nii.gz", phantom.labels.view());
  write_json(out.staging() / "labels.json", label_numbers(phantom));
  write_json(out.staging() / "truth.json", truth_of(phantom));
  out.commit();
}

}  // namespace carpus::phantom
