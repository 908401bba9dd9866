// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fibres that lie on the wall, in their order -> as many rows and columns as the spacing asks for
// -> each place to the nearest of the wall, and half the thickness under it.
#include "arthroscopy/detail/lay_band.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fields/distance_field.hpp"
#include "yielding/net.hpp"

namespace carpus::arthroscopy::detail {
namespace {

using soft_tissue::Strand;
using Row = std::vector<Vec3>;

constexpr std::size_t kFewest = 3;  // rows, columns
constexpr int kSmoothings = 2;

/// As many places, equally far apart along the course.
Row resampled(const Row& course, std::size_t count) {
  std::vector<double> so_far{0.0};
  for (std::size_t i = 0; i + 1 < course.size(); ++i) {
    so_far.push_back(so_far.back() + distance(course[i], course[i + 1]));
  }
  Row made;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = so_far.back() * static_cast<double>(k) / static_cast<double>(count - 1);
    std::size_t i = 0;
    while (i + 2 < course.size() && so_far[i + 1] < at) ++i;
    const double part = so_far[i + 1] - so_far[i];
    const double share = part > 0 ? std::clamp((at - so_far[i]) / part, 0.0, 1.0) : 0.0;
    made.push_back(course[i] + (course[i + 1] - course[i]) * share);
  }
  return made;
}

std::size_t count_for(double length_mm, double spacing_mm) {
  return std::max(kFewest, static_cast<std::size_t>(std::lround(length_mm / spacing_mm)) + 1);
}

class BandLayer {
 public:
  BandLayer(const cases::CaseData& data,
            const SpaceWalls& walls,
            const Grid<float>& wall,
            const BandTable& table)
      : data_(data), walls_(walls), wall_(wall), table_(table) {}

  std::optional<cases::LigamentBand> lay(const soft_tissue::SoftTissue& tissue,
                                         const TabledBand& band) {
    spacing_mm_ = band.spacing_mm;
    collect(tissue, band);
    if (strands_.size() < kFewest) return std::nullopt;
    const Strand& middle = *strands_[strands_.size() / 2];
    const auto first = body_of(middle.anchors.front().label);
    const auto second = body_of(middle.anchors.back().label);
    if (!first || !second || *first == *second) return std::nullopt;
    made_.id = band.id;
    made_.first = *first;
    made_.second = *second;
    make_grid();
    for (int i = 0; i < kSmoothings; ++i) smooth();
    for (Vec3& at : made_.at) {
      const fields::DistanceSample s = fields::sample_distance(wall_, at);
      const Vec3 outwards = normalized_or(s.gradient, {});
      made_.inwards.push_back(-outwards);
      at += outwards * (made_.thickness_mm / 2);
    }
    return std::move(made_);
  }

 private:
  [[nodiscard]] std::optional<std::uint8_t> body_of(std::uint8_t label) const {
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      if (data_.bones[b].label == label) return static_cast<std::uint8_t>(b);
    }
    return std::nullopt;
  }

  /// The stretch of neighbouring fibres about the middle one that lie on the wall.
  void collect(const soft_tissue::SoftTissue& tissue, const TabledBand& band) {
    for (const std::string& id : band.ligaments) {
      for (const soft_tissue::Ligament& ligament : tissue.ligaments) {
        if (ligament.id != id) continue;
        for (const Strand& strand : ligament.strands) {
          const bool is_seen =
              strand.course.size() >= 2 && strand.anchors.size() >= 2 &&
              walls_.tree.nearest(strand.course[strand.course.size() / 2], table_.on_wall_mm);
          if (!is_seen) continue;
          strands_.push_back(&strand);
          made_.along_n_per_mm += strand.stiffness_n_per_mm;
          // Of the membrane: where it is thicker it lies deeper, too.
          made_.thickness_mm = made_.thickness_mm > 0
                                   ? std::min(made_.thickness_mm, ligament.thickness_mm)
                                   : ligament.thickness_mm;
        }
      }
    }
  }

  [[nodiscard]] Vec3 on_wall(const Vec3& at) const {
    const auto near = walls_.tree.nearest(at);
    return near ? near->point : at;
  }

  void make_grid() {
    double long_mm = 0;
    double wide_mm = 0;
    Row middles;
    for (const Strand* strand : strands_) {
      long_mm += soft_tissue::length_of(*strand) / static_cast<double>(strands_.size());
      middles.push_back(strand->course[strand->course.size() / 2]);
    }
    for (std::size_t i = 0; i + 1 < middles.size(); ++i) {
      wide_mm += distance(middles[i], middles[i + 1]);
    }
    made_.columns = std::min<std::size_t>(count_for(long_mm, spacing_mm_), 10);
    made_.rows = std::min(count_for(wide_mm, spacing_mm_), yielding::kMaxParticles / made_.columns);
    std::vector<Row> columns(made_.columns);
    for (const Strand* strand : strands_) {
      const Row places = resampled(strand->course, made_.columns);
      for (std::size_t c = 0; c < places.size(); ++c) columns[c].push_back(places[c]);
    }
    for (Row& column : columns) column = resampled(column, made_.rows);
    for (std::size_t r = 0; r < made_.rows; ++r) {
      for (std::size_t c = 0; c < made_.columns; ++c) made_.at.push_back(on_wall(columns[c][r]));
    }
  }

  /// The wall's own roughness crowds places: within the rim each goes half way to the middle of its
  /// four neighbours, and back to the wall.
  void smooth() {
    const std::vector<Vec3> before = made_.at;
    const std::size_t n = made_.columns;
    for (std::size_t r = 1; r + 1 < made_.rows; ++r) {
      for (std::size_t c = 1; c + 1 < n; ++c) {
        const std::size_t i = r * n + c;
        const Vec3 middle = (before[i - 1] + before[i + 1] + before[i - n] + before[i + n]) * 0.25;
        made_.at[i] = on_wall(before[i] + (middle - before[i]) * 0.5);
      }
    }
  }

  const cases::CaseData& data_;
  const SpaceWalls& walls_;
  const Grid<float>& wall_;
  const BandTable& table_;
  std::vector<const Strand*> strands_;
  double spacing_mm_ = 1;
  cases::LigamentBand made_;
};

}  // namespace

std::optional<cases::LigamentBand> lay_band(const cases::CaseData& data,
                                            const soft_tissue::SoftTissue& tissue,
                                            const SpaceWalls& walls,
                                            const Grid<float>& wall,
                                            const TabledBand& band,
                                            const BandTable& table) {
  return BandLayer(data, walls, wall, table).lay(tissue, band);
}

}  // namespace carpus::arthroscopy::detail
