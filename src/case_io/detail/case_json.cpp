// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Geometry of the grids is kept here in full precision, because NIfTI rounds it to float32 and a
// case that was saved must be the case that is loaded.
#include "case_io/detail/case_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "case_io/detail/damaged_file.hpp"
#include "case_io/detail/structures_json.hpp"
#include "core/error.hpp"
#include "core/json_nesting.hpp"
#include "core/person_name.hpp"

namespace carpus::case_io {
namespace {

using Json = nlohmann::ordered_json;

/// Half of it would do.
constexpr int kDeepest = 16;

/// Rotations in a case are orthonormal to rounding; anything else is damage.
constexpr double kRotationTolerance = 1e-6;
/// No wrist lies further from its scanner's origin than this, by far [mm].
constexpr double kFarthestMm = 1e5;
/// No scaphoid is thicker [mm], and no wrist turns further than half round.
constexpr double kThickestScaphoidMm = 50;
/// As the page takes it (protocol/protocol.json, case_description) [bytes].
constexpr std::size_t kLongestPseudonym = 128;

Json json_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(const Mat3& m) {
  return Json::array({json_of(m.rows[0]), json_of(m.rows[1]), json_of(m.rows[2])});
}
template <typename In, typename Of>
Json json_of(const Pose<In, Of>& p) {
  return {{"rotation", json_of(p.rotation)}, {"translation_mm", json_of(p.translation)}};
}
Json json_of(const GridGeometry& g) {
  return {{"size", Json::array({g.size[0], g.size[1], g.size[2]})},
          {"spacing_mm", json_of(g.spacing)},
          {"origin_mm", json_of(g.origin)},
          {"direction", json_of(g.direction)}};
}
Json json_of(const cases::AxisSegment& s) {
  return {{"proximal_mm", json_of(s.proximal)}, {"distal_mm", json_of(s.distal)}};
}

Vec3 vec3_of(const Json& json) {
  const auto v = json.get<std::array<double, 3>>();
  const Vec3 p{v[0], v[1], v[2]};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::abs(p[i]) <= kFarthestMm)) throw IoError("a coordinate is beyond 100 m");
  }
  return p;
}
int integer_of(const Json& json, const char* what) {
  // As another type first: a conversion of 1e99 to an integer is undefined.
  if (json.is_number_integer()) {
    const auto value = json.get<std::int64_t>();
    if (value >= 0 && value <= std::numeric_limits<int>::max()) return static_cast<int>(value);
  }
  throw IoError(std::string(what) + " is no whole number from 0 to 2147483647");
}
double number_within(const Json& json, double low, double high, const char* what) {
  const auto value = json.get<double>();
  if (value >= low && value <= high) return value;
  throw IoError(std::string(what) + " is impossible");
}
Mat3 rotation_of(const Json& json, bool may_reflect) {
  const auto rows = json.get<std::array<Json, 3>>();
  const Mat3 m{{vec3_of(rows[0]), vec3_of(rows[1]), vec3_of(rows[2])}};
  const Mat3 product = m * m.transposed();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (!(std::abs(product.rows[i][j] - (i == j ? 1 : 0)) < kRotationTolerance)) {
        throw IoError("a rotation is not orthonormal");
      }
    }
  }
  if (!may_reflect && m.determinant() < 0) throw IoError("a rotation is a reflection");
  return m;
}
template <typename In, typename Of>
void take(const Json& json, Pose<In, Of>& pose) {
  pose.rotation = rotation_of(json.at("rotation"), false);
  pose.translation = vec3_of(json.at("translation_mm"));
}
GridGeometry grid_of(const Json& json) {
  GridGeometry g;
  const auto size = json.at("size").get<std::array<Json, 3>>();
  for (std::size_t i = 0; i < 3; ++i) g.size[i] = integer_of(size[i], "a grid's size");
  g.spacing = vec3_of(json.at("spacing_mm"));
  g.origin = vec3_of(json.at("origin_mm"));
  g.direction = rotation_of(json.at("direction"), true);
  for (std::size_t i = 0; i < 3; ++i) {
    if (g.size[i] < 1 || !(g.spacing[i] > 0)) throw IoError("a grid has no extent");
  }
  return g;
}
cases::AxisSegment segment_of(const Json& json) {
  return {vec3_of(json.at("proximal_mm")), vec3_of(json.at("distal_mm"))};
}

Json bones_json(const cases::CaseData& data) {
  Json bones = Json::array();
  for (const cases::Bone& bone : data.bones) {
    const std::string name(name_of(bone.bone, bone.part));
    bones.push_back({{"name", name},
                     {"label", bone.label},
                     {"surface", "bones/" + name + ".ply"},
                     {"hull", "hulls/" + name + ".ply"},
                     {"field", field_file(bone)},
                     {"patient_from_bone", json_of(bone.patient_from_bone)}});
  }
  return bones;
}

cases::Bone bone_from(const Json& json) {
  const auto name = json.at("name").get<std::string>();
  const auto named = bone_of(name);
  if (!named) throw IoError("there is no bone '" + name + "'");
  cases::Bone bone;
  bone.bone = named->bone;
  bone.part = named->part;
  const int label =
      bone.part == BonePart::Distal ? kScaphoidDistalLabel : static_cast<int>(bone.bone);
  if (integer_of(json.at("label"), "a label") != label) {
    throw IoError("the label of " + name + " is not " + std::to_string(label));
  }
  bone.label = static_cast<std::uint8_t>(label);
  take(json.at("patient_from_bone"), bone.patient_from_bone);
  return bone;
}

void check_version(const Json& json, const std::filesystem::path& file) {
  const int version = integer_of(json.at("schema_version"), "schema_version");
  if (version <= cases::kCaseSchemaVersion && version >= 1) return;
  throw SchemaError(file.string() + ": is a case of schema version " + std::to_string(version) +
                    ", and this program reads versions up to " +
                    std::to_string(cases::kCaseSchemaVersion) +
                    "; update carpus, or make the case again from its CT with this version");
}

std::string pseudonym_from(const Json& json) {
  auto pseudonym = json.at("pseudonym").get<std::string>();
  if (pseudonym.size() > kLongestPseudonym || problem_of_name(pseudonym)) {
    throw IoError(
        "the pseudonym is longer than 128 bytes or holds control characters or turned writing");
  }
  return pseudonym;
}

CaseHeader header_from(const Json& json) {
  CaseHeader header;
  cases::CaseData& data = header.data;
  data.pseudonym = pseudonym_from(json);
  const auto side = side_of(json.at("side").get<std::string>());
  if (!side) throw IoError("the side is neither left nor right");
  data.side = *side;
  const Json& provenance = json.at("provenance");
  data.provenance = {provenance.at("simulated").get<bool>(),
                     provenance.at("source").get<std::string>(),
                     provenance.at("made_by").get<std::string>(),
                     provenance.at("made_at").get<std::string>(),
                     provenance.value("conventions", std::vector<std::string>{}),
                     provenance.value("version_of", std::string())};
  take(json.at("wrist_from_patient"), data.wrist_from_patient);
  const Json& scaphoid = json.at("scaphoid");
  data.scaphoid = {
      segment_of(scaphoid.at("central_axis")),
      number_within(scaphoid.at("central_radius_mm"), 0, kThickestScaphoidMm, "central_radius_mm"),
      segment_of(scaphoid.at("longest_line")), vec3_of(scaphoid.at("waist_mm"))};
  for (const Json& json_bone : json.at("bones")) {
    cases::Bone bone = bone_from(json_bone);
    for (const cases::Bone& other : data.bones) {
      if (other.label == bone.label) throw IoError("a bone is there twice");
    }
    data.bones.push_back(std::move(bone));
  }
  for (const auto& [file, grid] : json.at("grids").items()) header.grids[file] = grid_of(grid);
  header.has_structures = json.contains("structures");
  return header;
}

}  // namespace

std::string field_file(const cases::Bone& bone) {
  return "fields/" + std::string(name_of(bone.bone, bone.part)) + ".nrrd";
}

std::string case_json_text(const cases::CaseData& data) {
  Json json;
  json["format"] = "carpus case";
  json["schema_version"] = cases::kCaseSchemaVersion;
  json["pseudonym"] = data.pseudonym;
  json["side"] = name_of(data.side);
  json["provenance"] = {{"simulated", data.provenance.simulated},
                        {"source", data.provenance.source},
                        {"made_by", data.provenance.made_by},
                        {"made_at", data.provenance.made_at},
                        {"conventions", data.provenance.conventions}};
  if (!data.provenance.version_of.empty()) {
    json["provenance"]["version_of"] = data.provenance.version_of;
  }
  json["wrist_from_patient"] = json_of(data.wrist_from_patient);
  json["scaphoid"] = {{"central_axis", json_of(data.scaphoid.central_axis)},
                      {"central_radius_mm", data.scaphoid.central_radius_mm},
                      {"longest_line", json_of(data.scaphoid.longest_line)},
                      {"waist_mm", json_of(data.scaphoid.waist)}};
  json["bones"] = bones_json(data);
  if (!data.structures.empty()) {
    json["structures"] = {{"file", kStructuresFile}, {"generated", true}};
  }
  Json grids;
  grids["ct.nii.gz"] = json_of(data.ct.geometry());
  grids["labels.nii.gz"] = json_of(data.labels.geometry());
  for (const cases::Bone& bone : data.bones) {
    grids[field_file(bone)] = json_of(bone.distance_field.geometry());
  }
  json["grids"] = grids;
  return json.dump(1) + "\n";
}

CaseHeader parse_case_json(const std::string& text, const std::filesystem::path& file) {
  try {
    if (nests_deeper_than(text, kDeepest)) throw IoError("nests too deeply");
    const Json json = Json::parse(text);
    if (json.value("format", "") != "carpus case") throw IoError("is not a case of carpus");
    check_version(json, file);
    return header_from(json);
  } catch (const Json::exception& error) {
    throw damaged_file(file, error);
  } catch (const IoError& error) {
    throw damaged_file(file, error);
  }
}

std::string parse_pseudonym(const std::string& text, const std::filesystem::path& file) {
  try {
    if (nests_deeper_than(text, kDeepest)) throw IoError("nests too deeply");
    return pseudonym_from(Json::parse(text));
  } catch (const Json::exception& error) {
    throw damaged_file(file, error);
  } catch (const IoError& error) {
    throw damaged_file(file, error);
  }
}

}  // namespace carpus::case_io
