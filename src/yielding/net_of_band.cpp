// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Neighbours of the grid are joined, along fibres, beside them, and by one diagonal of each cell,
// the other one in every second. What goes with which body falls from 0 to 1 along a whole fibre
// and at the tear of a torn one.
#include "yielding/net_of_band.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/check.hpp"

namespace carpus::yielding {
namespace {

class BandNet {
 public:
  BandNet(const Band& band, const BandMaterial& material, const std::optional<BandTear>& tear)
      : band_(band), material_(material), tear_(tear) {
    CARPUS_CHECK(band.rows >= 3 && band.columns >= 3);
    CARPUS_CHECK(band.at.size() == band.rows * band.columns);
    CARPUS_CHECK(band.normals.size() == band.at.size());
    for (std::size_t r = 0; r < band.rows; ++r) torn_at_.push_back(torn_at(r));
    for (std::size_t r = 0; r + 1 < band.rows; ++r) width_mm_ += distance(middle(r), middle(r + 1));
    for (std::size_t r = 0; r < band.rows; ++r) long_mm_ += distance(at(r, 0), at(r, last()));
    long_mm_ /= static_cast<double>(band.rows);
  }

  Net make() const {
    const auto count = static_cast<double>(band_.at.size());
    const double each_mm2 = width_mm_ * long_mm_ / count;
    Net net(width_mm_ / static_cast<double>(band_.rows - 1), material_.mass_g_per_mm2 * each_mm2,
            material_.damping_per_s);
    for (std::size_t r = 0; r < band_.rows; ++r) {
      for (std::size_t c = 0; c < band_.columns; ++c) net.add(particle(r, c, each_mm2));
    }
    for (std::size_t r = 0; r < band_.rows; ++r) {
      for (std::size_t c = 0; c < band_.columns; ++c) join_from(net, r, c);
    }
    return net;
  }

 private:
  [[nodiscard]] std::size_t last() const { return band_.columns - 1; }
  [[nodiscard]] const Vec3& at(std::size_t r, std::size_t c) const {
    return band_.at[r * band_.columns + c];
  }
  [[nodiscard]] const Vec3& middle(std::size_t r) const { return at(r, band_.columns / 2); }

  /// The first column beyond the tear; 0: this fibre is whole.
  [[nodiscard]] std::size_t torn_at(std::size_t r) const {
    if (!tear_) return 0;
    const Vec3 along = tear_->to - tear_->from;
    const double whole = squared_length(along);
    if (!(whole > 0)) return 0;
    const double share = dot(middle(r) - tear_->from, along) / whole;
    if (share < 0 || share > 1) return 0;
    const Vec3 on_line = tear_->from + along * share;
    const Vec3 fibre = at(r, last()) - at(r, 0);
    std::size_t c = 1;
    while (c < last() && dot(at(r, c) - on_line, fibre) < 0) ++c;
    return c;
  }

  [[nodiscard]] Net::Particle particle(std::size_t r, std::size_t c, double each_mm2) const {
    Net::Particle made;
    made.scanned = at(r, c);
    made.normal = band_.normals[r * band_.columns + c];
    made.is_held = c == 0 || c == last() || r == 0 || r + 1 == band_.rows;
    const double share = static_cast<double>(c) / static_cast<double>(last());
    made.second_share = torn_at_[r] == 0 ? share : (c < torn_at_[r] ? 0.0 : 1.0);
    const double down = static_cast<double>(r) / static_cast<double>(band_.rows - 1);
    // Highest in the middle, nothing at what holds it.
    const double high = 4 * share * (1 - share) * std::min(1.0, 8 * down * (1 - down));
    made.rest = made.scanned + made.normal * (material_.bulges_mm * high);
    const double left = torn_at_[r] == 0 ? 1.0 : tear_->left_share;
    const double foundation = material_.foundation_n_per_mm2 * each_mm2 * left;
    made.foundation_mm_per_n = foundation > 0 ? 1 / foundation : 0;
    return made;
  }

  /// Not over a tear; beside one nothing is drawn.
  void join(Net& net,
            std::array<std::size_t, 2> a,
            std::array<std::size_t, 2> b,
            bool is_along) const {
    const auto side = [this](const std::array<std::size_t, 2>& of) {
      return torn_at_[of[0]] == 0 ? 0 : (of[1] < torn_at_[of[0]] ? -1 : 1);
    };
    if (side(a) * side(b) < 0) return;
    const auto rows = static_cast<double>(band_.rows);
    const auto cells = static_cast<double>(last());
    const double along = material_.along_n_per_mm / rows * cells;
    const bool is_slack = side(a) != 0 || side(b) != 0;
    // Of the width that a fibre stands for; beside it, of the length.
    const double wide = is_along ? width_mm_ / (rows - 1) : long_mm_ / cells;
    net.join(a[0] * band_.columns + a[1], b[0] * band_.columns + b[1],
             is_along ? along : along * material_.aside_share,
             is_slack ? 0.0 : material_.tension_n_per_mm * wide);
  }

  void join_from(Net& net, std::size_t r, std::size_t c) const {
    if (c < last()) join(net, {r, c}, {r, c + 1}, true);
    if (r + 1 == band_.rows) return;
    join(net, {r, c}, {r + 1, c}, false);
    if (c == last()) return;
    if ((r + c) % 2 == 0) {
      join(net, {r, c}, {r + 1, c + 1}, false);
    } else {
      join(net, {r, c + 1}, {r + 1, c}, false);
    }
  }

  const Band& band_;
  const BandMaterial& material_;
  const std::optional<BandTear>& tear_;
  std::vector<std::size_t> torn_at_;
  double width_mm_ = 0;
  double long_mm_ = 0;
};

}  // namespace

Net net_of_band(const Band& band,
                const BandMaterial& material,
                const std::optional<BandTear>& tear) {
  return BandNet(band, material, tear).make();
}

double along_n_per_mm(const Net& net, const Band& band) {
  // Twice the energy of a mm. Rows that are held on both sides bear as the rest do.
  double sum = 0;
  for (const Net::Spring& spring : net.springs()) {
    const std::size_t row = spring.a / band.columns;
    const Vec3 fibre =
        normalized_or(band.at[(row + 1) * band.columns - 1] - band.at[row * band.columns], {});
    const Vec3 way = normalized_or(net.rest()[spring.b] - net.rest()[spring.a], {});
    const double more = (net.second_share(spring.b) - net.second_share(spring.a)) * dot(way, fibre);
    sum += more * more / spring.compliance_mm_per_n;
  }
  const auto rows = static_cast<double>(band.rows);
  return sum * rows / (rows - 2);
}

}  // namespace carpus::yielding
