// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/soft_tissue_folder.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "case_io/atomic_folder.hpp"
#include "case_io/detail/disk_space.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/ply.hpp"
#include "core/error.hpp"
#include "core/json_nesting.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using namespace carpus::soft_tissue;

constexpr const char* kFile = "soft_tissue.json";
constexpr int kVersion = 1;
constexpr int kDeepest = 12;
constexpr std::uint64_t kLargest = std::uint64_t{64} << 20U;
constexpr double kFarthestMm = 1e5;
constexpr double kMost = 1e9;
constexpr std::size_t kLongestName = 128;
constexpr std::size_t kMostBodies = 128;
constexpr std::size_t kMostStrands = 64;
constexpr std::size_t kMostPoints = 1024;

// --- writing

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
  json["schema_version"] = kVersion;
  json["generated"] = true;
  json["note"] = "Generated from the generic wrist and this case's bones; not seen in the CT.";
  json["size"] = tissue.size;
  json["worst_misfit_mm"] = figure(tissue.worst_misfit_mm);
  json["deepest_in_bone_mm"] = figure(tissue.deepest_in_bone_mm);
  json["problems"] = tissue.problems;
  json["materials"] = Json::array();
  for (const Material& m : TissueTable::generic().materials) {
    json["materials"].push_back({{"id", m.id}, {"name", m.name}, {"colour", m.colour}});
  }
  return json;
}

// --- reading

double number_within(const Json& json, double low, double high) {
  const double value = json.get<double>();
  if (!(value >= low && value <= high)) throw IoError("a number is impossible");
  return value;
}
double length_from(const Json& json) { return number_within(json, 0, kFarthestMm); }

Vec3 point_from(const Json& json) {
  const auto v = json.get<std::array<Json, 3>>();
  return {number_within(v[0], -kFarthestMm, kFarthestMm),
          number_within(v[1], -kFarthestMm, kFarthestMm),
          number_within(v[2], -kFarthestMm, kFarthestMm)};
}

Range range_from(const Json& json) {
  const auto v = json.get<std::array<Json, 2>>();
  return {length_from(v[0]), length_from(v[1])};
}

std::string name_from(const Json& json) {
  auto name = json.get<std::string>();
  bool is_plain = !name.empty() && name.size() <= kLongestName;
  for (const char c : name) is_plain = is_plain && static_cast<unsigned char>(c) >= 0x20;
  if (!is_plain) throw IoError("a name is empty, too long, or holds control characters");
  return name;
}

/// A file beside the list; never elsewhere.
TriangleMesh mesh_from(const fs::path& folder, const Json& json) {
  const std::string name = name_from(json);
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '_' || c == '.';
    if (!is_plain) throw IoError("'" + name + "' is no name of a surface's file");
  }
  return read_ply(folder / name);
}

std::uint8_t label_from(const Json& json) {
  return static_cast<std::uint8_t>(number_within(json, 0, kScaphoidDistalLabel));
}

template <typename T, typename Read>
std::vector<T> list_from(const Json& json, std::size_t most, const Read& read) {
  if (!json.is_array() || json.size() > most) throw IoError("a list is too long, or none");
  std::vector<T> list;
  for (const Json& entry : json) list.push_back(read(entry));
  return list;
}

Strand strand_from(const Json& json) {
  Strand s;
  s.rest_length_mm = length_from(json.at("rest_length_mm"));
  s.stiffness_n_per_mm = number_within(json.at("stiffness_n_per_mm"), 0, kMost);
  s.course = list_from<Vec3>(json.at("course_mm"), kMostPoints, point_from);
  if (s.course.size() < 2) throw IoError("a strand has too few points");
  s.anchors = list_from<Anchor>(json.at("anchors"), kMostPoints, [&](const Json& a) {
    Anchor anchor;
    if (a.contains("label")) {
      anchor.label = label_from(a.at("label"));
    } else {
      anchor.ligament = name_from(a.at("ligament"));
      anchor.fraction = number_within(a.at("fraction"), 0, 1);
    }
    anchor.at = point_from(a.at("at_mm"));
    anchor.point = a.at("point").get<std::size_t>();
    if (anchor.point >= s.course.size()) throw IoError("a strand is held beyond its course");
    return anchor;
  });
  if (s.anchors.size() < 2) throw IoError("a strand is held at both ends");
  return s;
}

Ligament ligament_from(const fs::path& folder, const Json& json) {
  Ligament l;
  l.id = name_from(json.at("id"));
  l.name = name_from(json.at("name"));
  l.group = name_from(json.at("group"));
  l.body = mesh_from(folder, json.at("file"));
  l.length_mm = length_from(json.at("length_mm"));
  l.straight_mm = length_from(json.at("straight_mm"));
  l.length_range_mm = range_from(json.at("length_range_mm"));
  l.width_mm = length_from(json.at("width_mm"));
  l.thickness_mm = length_from(json.at("thickness_mm"));
  l.measured_thickness_mm = length_from(json.at("measured_thickness_mm"));
  l.thickness_range_mm = range_from(json.at("thickness_range_mm"));
  l.strands = list_from<Strand>(json.at("strands"), kMostStrands, strand_from);
  return l;
}

Cartilage cartilage_from(const fs::path& folder, const Json& json) {
  Cartilage c;
  c.label = label_from(json.at("label"));
  c.body = mesh_from(folder, json.at("file"));
  c.area_mm2 = number_within(json.at("area_mm2"), 0, kMost);
  c.mean_thickness_mm = length_from(json.at("mean_thickness_mm"));
  c.greatest_thickness_mm = length_from(json.at("greatest_thickness_mm"));
  if (json.contains("pressed_area_mm2")) {  // older ones do not tell
    c.pressed_area_mm2 = number_within(json.at("pressed_area_mm2"), 0, kMost);
    c.pressed_thickness_mm = length_from(json.at("pressed_thickness_mm"));
  }
  c.thickness_range_mm = range_from(json.at("thickness_range_mm"));
  c.vertex_thickness_mm =
      list_from<float>(json.at("vertex_thickness_mm"), std::size_t{1} << 22U,
                       [](const Json& v) { return static_cast<float>(length_from(v)); });
  return c;
}

Space space_from(const fs::path& folder, const Json& json) {
  Space s;
  s.id = name_from(json.at("id"));
  s.name = name_from(json.at("name"));
  s.surface = mesh_from(folder, json.at("file"));
  s.volume_mm3 = number_within(json.at("volume_mm3"), 0, kMost);
  for (const char digit : json.at("lining").get<std::string>()) {
    if (digit < '0' || digit > '0' + static_cast<char>(Lining::Ligament)) {
      throw IoError("a lining is unknown");
    }
    s.lining.push_back(static_cast<Lining>(digit - '0'));
  }
  if (s.lining.size() != s.surface.vertices.size()) {
    throw IoError("the lining is not of its surface");
  }
  return s;
}

SoftTissue tissue_from(const fs::path& folder, const Json& json) {
  SoftTissue tissue;
  tissue.size = number_within(json.at("size"), 0.1, 10);
  tissue.worst_misfit_mm = length_from(json.at("worst_misfit_mm"));
  tissue.deepest_in_bone_mm = length_from(json.at("deepest_in_bone_mm"));
  tissue.problems = list_from<std::string>(
      json.at("problems"), 1024, [](const Json& text) { return text.get<std::string>(); });
  tissue.ligaments = list_from<Ligament>(json.at("ligaments"), kMostBodies, [&](const Json& entry) {
    return ligament_from(folder, entry);
  });
  tissue.cartilage =
      list_from<Cartilage>(json.at("cartilage"), kMostBodies,
                           [&](const Json& entry) { return cartilage_from(folder, entry); });
  if (json.contains("disc")) {
    const Json& disc = json.at("disc");
    tissue.disc.middle = mesh_from(folder, disc.at("middle_file"));
    tissue.disc.body = mesh_from(folder, disc.at("file"));
    tissue.disc.measured_thickness_mm = length_from(disc.at("measured_thickness_mm"));
    tissue.disc.thickness_range_mm = range_from(disc.at("thickness_range_mm"));
  }
  tissue.spaces = list_from<Space>(json.at("spaces"), kMostBodies,
                                   [&](const Json& entry) { return space_from(folder, entry); });
  return tissue;
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
    write_ply(out.staging() / name, mesh);
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
  const std::string text = read_whole_file(file, kLargest);
  try {
    if (nests_deeper_than(text, kDeepest)) throw IoError("nests too deeply");
    const Json json = Json::parse(text);
    if (json.value("format", "") != "carpus soft tissue") throw IoError("is no soft tissue");
    if (json.at("schema_version") != kVersion) {
      throw SchemaError(file.string() +
                        ": was written by a newer program; update carpus, or make it again with "
                        "'carpus soft-tissue'");
    }
    return tissue_from(folder, json);
  } catch (const Json::exception& error) {
    throw IoError(file.string() + ": is damaged (" + error.what() +
                  "); make it again with 'carpus soft-tissue'");
  } catch (const IoError& error) {
    throw IoError(file.string() + ": " + error.what() +
                  "; make it again with 'carpus soft-tissue'");
  }
}

}  // namespace carpus::case_io
