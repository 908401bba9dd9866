// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/corrected_case.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "case_io/case_cover.hpp"
#include "case_io/ply.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/trust_file.hpp"
#include "core/error.hpp"
#include "core/json_fields.hpp"
#include "core/text_format.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestCaseFile = std::uintmax_t{16} << 20U;
constexpr std::size_t kLongestId = 64;

/// As a station calls its cases. Anything else, which may hold a person's name, is not kept.
std::string plain_id_of(const fs::path& folder) {
  const std::string name = fs::absolute(folder).lexically_normal().filename().string();
  const std::string id =
      name.empty() ? fs::absolute(folder).parent_path().filename().string() : name;
  const bool is_plain = std::all_of(id.begin(), id.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  return is_plain && id.size() <= kLongestId ? id : std::string();
}

std::optional<reconstruct::BoneTrust> trust_of(const std::optional<case_io::Trust>& trust,
                                               const std::string& bone) {
  if (!trust) return std::nullopt;
  for (const case_io::TrustLine& line : trust->bones) {
    if (line.name == bone) return reconstruct::BoneTrust{line.confidence, line.flagged, line.why};
  }
  return std::nullopt;
}

}  // namespace

std::string name_of_label(std::size_t label, bool is_scaphoid_broken) {
  if (label == kScaphoidDistalLabel) {
    return std::string(name_of(BoneId::Scaphoid, BonePart::Distal));
  }
  const auto bone = static_cast<BoneId>(label);
  const bool is_part = bone == BoneId::Scaphoid && is_scaphoid_broken;
  return std::string(name_of(bone, is_part ? BonePart::Proximal : BonePart::Whole));
}

bool is_case_folder(const fs::path& folder) {
  return fs::is_directory(folder) && fs::is_regular_file(folder / "case.json") &&
         fs::is_regular_file(folder / "ct.nii.gz");
}

EarlierCase read_earlier_case(const fs::path& folder) {
  const fs::path file = folder / "case.json";
  if (fs::file_size(file) > kLargestCaseFile) {
    throw InvalidInput(file.string() + ": is larger than any such file");
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const nlohmann::json json = parse_json_text(text, file.string());
  EarlierCase earlier;
  earlier.id = plain_id_of(folder);
  try {
    const nlohmann::json& from = json.at("provenance");
    earlier.provenance.simulated = from.at("simulated");
    earlier.provenance.source = from.at("source");
    earlier.provenance.conventions = from.value("conventions", std::vector<std::string>{});
  } catch (const nlohmann::json::exception&) {
    throw InvalidInput(file.string() + ": does not say where the case came from; reconstruct it");
  }
  earlier.pseudonym = case_io::read_pseudonym(folder).value_or("wrist");
  earlier.version.labels = case_io::read_labels(folder / "labels.nii.gz");
  const auto labels = earlier.version.labels.values();
  const bool is_broken =
      std::find(labels.begin(), labels.end(), kScaphoidDistalLabel) != labels.end();
  const auto trusted = case_io::read_trust(folder);
  for (std::size_t label = 1; label <= kScaphoidDistalLabel; ++label) {
    // A bone of which there is none is none to be kept.
    const fs::path surface = folder / "bones" / (name_of_label(label, is_broken) + ".ply");
    if (!fs::is_regular_file(surface)) continue;
    earlier.version.bones.push_back({static_cast<std::uint8_t>(label), case_io::read_ply(surface),
                                     trust_of(trusted, name_of_label(label, is_broken))});
  }
  return earlier;
}

std::vector<std::string> changes_between(const Grid<std::uint8_t>& before,
                                         const Grid<std::uint8_t>& after) {
  CARPUS_CHECK(before.values().size() == after.values().size());
  std::array<std::size_t, 256> added{};
  std::array<std::size_t, 256> taken{};
  bool is_broken = false;
  for (std::size_t i = 0; i < before.values().size(); ++i) {
    is_broken = is_broken || after[i] == kScaphoidDistalLabel;
    if (before[i] == after[i]) continue;
    ++taken[before[i]];
    ++added[after[i]];
  }
  const double voxel_mm3 = before.geometry().voxel_volume_mm3();
  std::vector<std::string> changes;
  for (std::size_t label = 1; label <= kScaphoidDistalLabel; ++label) {
    if (added[label] + taken[label] == 0) continue;
    changes.push_back(format("%s: %.1f mm3 added, %.1f mm3 taken away",
                             name_of_label(label, is_broken).c_str(),
                             static_cast<double>(added[label]) * voxel_mm3,
                             static_cast<double>(taken[label]) * voxel_mm3));
  }
  return changes;
}

}  // namespace carpus::cli
