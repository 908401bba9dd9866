// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/lay_disc.hpp"

#include "soft_tissue/detail/lay_ligaments.hpp"

namespace carpus::soft_tissue::detail {
namespace {

constexpr std::size_t kRows = 11;     ///< dorsal to volar
constexpr std::size_t kColumns = 15;  ///< radius to ulna
constexpr double kGapMm = 0.05;
constexpr double kThinEdge = 0.7;  ///< of the thickness where it holds
constexpr int kPasses = 120;
constexpr double kAcross = 0.4;

}  // namespace

Vec3 along_line(const std::vector<Vec3>& line, double share) {
  double whole = 0;
  for (std::size_t i = 1; i < line.size(); ++i) whole += distance(line[i - 1], line[i]);
  double left = share * whole;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double piece = distance(line[i - 1], line[i]);
    if (left <= piece || i + 1 == line.size()) {
      return line[i - 1] + (line[i] - line[i - 1]) * (piece > 0 ? left / piece : 0);
    }
    left -= piece;
  }
  return line.back();
}

std::optional<Sheet> lay_disc(const TabledDisc& tabled,
                              const CarriedModel& model,
                              const Surroundings& bones,
                              std::vector<std::string>& problems) {
  for (const BoneId bone : {BoneId::Radius, BoneId::Ulna}) {
    if (model.has(bone)) continue;
    problems.push_back("the disc cannot be attached: the " + std::string(carpus::name_of(bone)) +
                       " is missing or fused");
    return std::nullopt;
  }
  const double half = 0.5 * tabled.thickness.mm * model.size();
  const auto lifted = [&](BoneId bone, const std::vector<Vec3>& left) {
    std::vector<Vec3> line;
    for (const Vec3& p : left) {
      const auto on = bones.on_bone(bone, model.point(bone, p));
      line.push_back(on->point + on->outwards * (half * kThinEdge + kGapMm));
    }
    return line;
  };
  const std::vector<Vec3> rim = lifted(BoneId::Radius, tabled.rim);
  const std::vector<Vec3> edge = lifted(BoneId::Ulna, tabled.ulnar_edge);
  std::vector<std::vector<Vec3>> rows(kRows);
  std::vector<std::vector<double>> halves(kRows);
  std::vector<std::vector<double>> rooms(kRows);
  std::vector<std::vector<bool>> fixed(kRows);
  for (std::size_t r = 0; r < kRows; ++r) {
    const double u = static_cast<double>(r) / (kRows - 1);
    const Vec3 a = along_line(rim, u);
    const Vec3 b = along_line(edge, u);
    for (std::size_t c = 0; c < kColumns; ++c) {
      const double t = static_cast<double>(c) / (kColumns - 1);
      const bool is_end = c == 0 || c + 1 == kColumns;
      const bool is_next = c == 1 || c + 2 == kColumns;
      rows[r].push_back(a + (b - a) * t);
      halves[r].push_back(half * (is_end ? kThinEdge : is_next ? 0.5 * (1 + kThinEdge) : 1));
      rooms[r].push_back(halves[r].back() + kGapMm);
      fixed[r].push_back(is_end);
    }
  }
  settle(
      rows, rooms, fixed,
      [&](const Vec3& p, double room_mm) { return bones.with_room(p, room_mm); }, kPasses, kAcross);
  return sheet_of(rows, halves);
}

}  // namespace carpus::soft_tissue::detail
