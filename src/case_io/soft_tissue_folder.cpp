// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/soft_tissue_folder.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "case_io/atomic_folder.hpp"
#include "case_io/detail/disk_space.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/soft_tissue_json.hpp"
#include "case_io/ply.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using namespace carpus::soft_tissue;

constexpr const char* kFile = "soft_tissue.json";
constexpr const char* kNote =
    "Generated from the generic wrist and this case's bones; not seen in the CT.";
constexpr std::uint64_t kLargest = std::uint64_t{64} << 20U;

/// To thousandths: what a person reads; nothing is computed from it.
double figure(double value) { return std::round(value * 1e3) / 1e3; }

Json json_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(const Range& r) { return Json::array({figure(r.low), figure(r.high)}); }

Json json_of(const Strand& s) {
  Json course = Json::array();
  for (const Vec3& p : s.course) course.push_back(json_of(p));
  Json anchors = Json::array();
  for (const Anchor& a : s.anchors) {
    Json anchor;
    if (a.label > 0) {
      anchor["label"] = a.label;
    } else {
      anchor["ligament"] = a.ligament;
      anchor["fraction"] = a.fraction;
    }
    anchor["at_mm"] = json_of(a.at);
    anchor["point"] = a.point;
    anchors.push_back(std::move(anchor));
  }
  return {{"rest_length_mm", s.rest_length_mm},
          {"stiffness_n_per_mm", s.stiffness_n_per_mm},
          {"anchors", anchors},
          {"course_mm", course}};
}

Json json_of(const Ligament& l, const std::string& file) {
  Json strands = Json::array();
  for (const Strand& s : l.strands) strands.push_back(json_of(s));
  return {{"id", l.id},
          {"name", l.name},
          {"group", l.group},
          {"material", "ligament"},
          {"file", file},
          {"length_mm", figure(l.length_mm)},
          {"straight_mm", figure(l.straight_mm)},
          {"length_range_mm", json_of(l.length_range_mm)},
          {"width_mm", figure(l.width_mm)},
          {"thickness_mm", figure(l.thickness_mm)},
          {"measured_thickness_mm", figure(l.measured_thickness_mm)},
          {"thickness_range_mm", json_of(l.thickness_range_mm)},
          {"strands", strands}};
}

Json json_of(const Cartilage& c, const std::string& bone, const std::string& file) {
  Json thickness = Json::array();
  for (const float mm : c.vertex_thickness_mm) thickness.push_back(figure(mm));
  return {{"bone", bone},
          {"label", c.label},
          {"material", "cartilage"},
          {"file", file},
          {"area_mm2", figure(c.area_mm2)},
          {"mean_thickness_mm", figure(c.mean_thickness_mm)},
          {"greatest_thickness_mm", figure(c.greatest_thickness_mm)},
          {"pressed_area_mm2", figure(c.pressed_area_mm2)},
          {"pressed_thickness_mm", figure(c.pressed_thickness_mm)},
          {"thickness_range_mm", json_of(c.thickness_range_mm)},
          {"vertex_thickness_mm", thickness}};
}

std::string name_of_label(const cases::CaseData& data, std::uint8_t label) {
  for (const cases::Bone& bone : data.bones) {
    if (bone.label == label) return std::string(name_of(bone.bone, bone.part));
  }
  return "label_" + std::to_string(label);
}

Json header_of(const SoftTissue& tissue) {
  Json json;
  json["format"] = "carpus soft tissue";
  json["schema_version"] = kSoftTissueSchemaVersion;
  json["generated"] = true;
  json["note"] = kNote;
  json["size"] = tissue.size;
  json["worst_misfit_mm"] = figure(tissue.worst_misfit_mm);
  json["deepest_in_bone_mm"] = figure(tissue.deepest_in_bone_mm);
  json["deepest_in_other_mm"] = figure(tissue.deepest_in_other_mm);
  json["overlaps"] = Json::array();
  for (const Overlap& o : tissue.overlaps) {
    json["overlaps"].push_back({{"between", {o.first, o.second}}, {"depth_mm", figure(o.mm)}});
  }
  json["problems"] = tissue.problems;
  json["materials"] = Json::array();
  for (const Material& m : TissueTable::generic().materials) {
    json["materials"].push_back({{"id", m.id}, {"name", m.name}, {"colour", m.colour}});
  }
  return json;
}

}  // namespace

void write_soft_tissue(const SoftTissue& tissue,
                       const cases::CaseData& data,
                       const fs::path& case_folder) {
  if (!fs::exists(case_folder / "case.json")) {
    throw IoError(case_folder.string() + ": is no case folder");
  }
  AtomicFolder out(case_folder / kSoftTissueFolder, Overwrite::Replace);
  const auto save = [&](const std::string& name, const TriangleMesh& mesh) {
    write_ply(out.staging() / name, mesh, {}, kNote);
    return name;
  };
  Json json = header_of(tissue);
  json["ligaments"] = Json::array();
  for (const Ligament& l : tissue.ligaments) {
    json["ligaments"].push_back(json_of(l, save("ligament_" + l.id + ".ply", l.body)));
  }
  json["cartilage"] = Json::array();
  for (const Cartilage& c : tissue.cartilage) {
    const std::string bone = name_of_label(data, c.label);
    json["cartilage"].push_back(json_of(c, bone, save("cartilage_" + bone + ".ply", c.body)));
  }
  if (!tissue.disc.body.facets.empty()) {
    json["disc"] = {{"material", "disc"},
                    {"file", save("disc.ply", tissue.disc.body)},
                    {"middle_file", save("disc_middle.ply", tissue.disc.middle)},
                    {"measured_thickness_mm", figure(tissue.disc.measured_thickness_mm)},
                    {"thickness_range_mm", json_of(tissue.disc.thickness_range_mm)}};
  }
  json["spaces"] = Json::array();
  for (const Space& s : tissue.spaces) {
    if (s.surface.facets.empty()) continue;
    std::string lining;
    for (const Lining l : s.lining) lining += static_cast<char>('0' + static_cast<int>(l));
    json["spaces"].push_back({{"id", s.id},
                              {"name", s.name},
                              {"material", "synovium"},
                              {"file", save("space_" + s.id + ".ply", s.surface)},
                              {"volume_mm3", figure(s.volume_mm3)},
                              {"lining", lining}});
  }
  std::ofstream file(out.staging() / kFile, std::ios::binary);
  file << json.dump() << "\n";
  file.close();
  if (!file) throw_cannot_write(out.staging() / kFile);
  out.commit();
}

std::optional<SoftTissue> read_soft_tissue(const fs::path& case_folder) {
  const fs::path folder = case_folder / kSoftTissueFolder;
  const fs::path file = folder / kFile;
  if (!fs::exists(file)) return std::nullopt;
  return parse_soft_tissue(read_whole_file(file, kLargest), file.string(),
                           [&](const std::string& name) { return read_ply(folder / name); });
}

}  // namespace carpus::case_io
