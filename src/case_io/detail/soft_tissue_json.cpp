// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/soft_tissue_json.hpp"

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/json_nesting.hpp"

namespace carpus::case_io {
namespace {

using Json = nlohmann::ordered_json;
using namespace carpus::soft_tissue;

constexpr int kDeepest = 12;
constexpr double kFarthestMm = 1e5;
constexpr double kMost = 1e9;
constexpr std::size_t kLongestName = 128;
constexpr std::size_t kMostBodies = 128;
constexpr std::size_t kMostStrands = 64;
constexpr std::size_t kMostPoints = 1024;

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
TriangleMesh mesh_from(const ReadMesh& read, const Json& json) {
  const std::string name = name_from(json);
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '_' || c == '.';
    if (!is_plain) throw IoError("'" + name + "' is no name of a surface's file");
  }
  return read(name);
}

/// A whole number: half a place is none, and one of 1e300 fits nowhere.
std::size_t whole_from(const Json& json, std::size_t low, std::size_t high) {
  if (!json.is_number_unsigned()) throw IoError("a number is not whole");
  const auto value = json.get<std::uint64_t>();
  if (value < low || value > high) throw IoError("a number is impossible");
  return static_cast<std::size_t>(value);
}

std::uint8_t label_from(const Json& json) {
  return static_cast<std::uint8_t>(whole_from(json, 1, kScaphoidDistalLabel));
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
    anchor.point = whole_from(a.at("point"), 0, kMostPoints);
    if (anchor.point >= s.course.size()) throw IoError("a strand is held beyond its course");
    return anchor;
  });
  if (s.anchors.size() < 2) throw IoError("a strand is held at both ends");
  return s;
}

Ligament ligament_from(const ReadMesh& read, const Json& json) {
  Ligament l;
  l.id = name_from(json.at("id"));
  l.name = name_from(json.at("name"));
  l.group = name_from(json.at("group"));
  l.body = mesh_from(read, json.at("file"));
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

Cartilage cartilage_from(const ReadMesh& read, const Json& json) {
  Cartilage c;
  c.label = label_from(json.at("label"));
  c.body = mesh_from(read, json.at("file"));
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

Space space_from(const ReadMesh& read, const Json& json) {
  Space s;
  s.id = name_from(json.at("id"));
  s.name = name_from(json.at("name"));
  s.surface = mesh_from(read, json.at("file"));
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

SoftTissue tissue_from(const ReadMesh& read, const Json& json) {
  SoftTissue tissue;
  tissue.size = number_within(json.at("size"), 0.1, 10);
  tissue.worst_misfit_mm = length_from(json.at("worst_misfit_mm"));
  tissue.deepest_in_bone_mm = length_from(json.at("deepest_in_bone_mm"));
  if (json.contains("overlaps")) {  // older ones do not tell
    tissue.deepest_in_other_mm = length_from(json.at("deepest_in_other_mm"));
    tissue.overlaps = list_from<Overlap>(json.at("overlaps"), 4096, [](const Json& entry) {
      const auto between = entry.at("between").get<std::array<std::string, 2>>();
      return Overlap{between[0], between[1], length_from(entry.at("depth_mm"))};
    });
  }
  tissue.problems = list_from<std::string>(
      json.at("problems"), 1024, [](const Json& text) { return text.get<std::string>(); });
  tissue.ligaments = list_from<Ligament>(json.at("ligaments"), kMostBodies, [&](const Json& entry) {
    return ligament_from(read, entry);
  });
  tissue.cartilage =
      list_from<Cartilage>(json.at("cartilage"), kMostBodies,
                           [&](const Json& entry) { return cartilage_from(read, entry); });
  if (json.contains("disc")) {
    const Json& disc = json.at("disc");
    tissue.disc.middle = mesh_from(read, disc.at("middle_file"));
    tissue.disc.body = mesh_from(read, disc.at("file"));
    tissue.disc.measured_thickness_mm = length_from(disc.at("measured_thickness_mm"));
    tissue.disc.thickness_range_mm = range_from(disc.at("thickness_range_mm"));
  }
  tissue.spaces = list_from<Space>(json.at("spaces"), kMostBodies,
                                   [&](const Json& entry) { return space_from(read, entry); });
  return tissue;
}

}  // namespace

SoftTissue parse_soft_tissue(const std::string& text,
                             const std::string& file,
                             const ReadMesh& read) {
  try {
    if (nests_deeper_than(text, kDeepest)) throw IoError("nests too deeply");
    const Json json = Json::parse(text);
    if (json.value("format", "") != "carpus soft tissue") throw IoError("is no soft tissue");
    if (json.at("schema_version") != kSoftTissueSchemaVersion) {
      throw SchemaError(file +
                        ": was written by a newer program; update carpus, or make it again with "
                        "'carpus soft-tissue'");
    }
    return tissue_from(read, json);
  } catch (const Json::exception& error) {
    throw IoError(file + ": is damaged (" + error.what() +
                  "); make it again with 'carpus soft-tissue'");
  } catch (const IoError& error) {
    throw IoError(file + ": " + error.what() + "; make it again with 'carpus soft-tissue'");
  }
}

}  // namespace carpus::case_io
