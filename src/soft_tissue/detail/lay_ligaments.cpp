// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Carry each attachment's middle line onto its bone; every strand takes its share of it.
// 2. Draw each strand through its places, bulged to the ligament's side of the bones.
// 3. Let the strands of a ligament settle: straight as they can, out of bone, side by side.
#include "soft_tissue/detail/lay_ligaments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/parallel.hpp"
#include "soft_tissue/detail/lay_disc.hpp"

namespace carpus::soft_tissue::detail {
namespace {

constexpr double kStepMm = 1.0;    ///< between points of a strand
constexpr double kBulge = 0.3;     ///< of a piece's length
constexpr double kGapMm = 0.05;    ///< between a band and bone
constexpr double kTaperMm = 2.5;   ///< over which a band thins towards its ends
constexpr double kThinEnd = 0.55;  ///< of the thickness at the ends
constexpr double kThinnestHalfMm = 0.3;
constexpr int kPasses = 200;
constexpr double kAcross = 0.15;
/// A bone of another shape than the generic one's cannot tell where things attach [mm rms].
constexpr double kWorstMisfitMm = 1.5;

/// One strand's place at one attachment.
struct Place {
  Anchor anchor;
  Vec3 lifted;
};

Vec3 outward_side(Aspect aspect, const CarriedModel& model) {
  switch (aspect) {
    case Aspect::Dorsal:
      return model.way_of_wrist({0, 0, -1});
    case Aspect::Volar:
      return model.way_of_wrist({0, 0, 1});
    case Aspect::Proximal:
      return model.way_of_wrist({1, 0, 0});
  }
  return {};
}

double taper(double from_end_mm, double length_mm) {
  const double over = std::min(kTaperMm, 0.3 * length_mm);
  const double t = std::clamp(from_end_mm / over, 0.0, 1.0);
  return kThinEnd + (1 - kThinEnd) * t;
}

/// A ligament upon which another lies.
class Under {
 public:
  Under(const Sheet& sheet, const Surroundings& bones) : sheet_(sheet), middle_(sheet.middle) {
    double outwards = 0;
    for (std::uint32_t f = 0; f < middle_.facets.size(); ++f) {
      const Vec3& at = middle_.vertices[middle_.facets[f][0]];
      outwards += dot(facet_normal(middle_, f), bones.near(at).outwards);
    }
    away_from_bone_ = outwards < 0 ? -1 : 1;
  }

  /// The point moved away from bone until the ligament leaves it so much room; beside the
  /// ligament's edge, which is round, by less.
  [[nodiscard]] Vec3 over(const Vec3& point, double room_mm) const {
    const auto near = sheet_.nearest(point, room_mm);
    if (!near) return point;
    const double apart = near->half_mm + room_mm;
    const Vec3 way = point - near->point;
    const Vec3 normal = facet_normal(middle_, near->facet) * away_from_bone_;
    const double above = dot(way, normal);
    const double beside = std::max(0.0, squared_length(way) - above * above);
    if (beside >= apart * apart) return point;
    return point + normal * std::max(0.0, std::sqrt(apart * apart - beside) - above);
  }

 private:
  SheetDistance sheet_;
  TriangleMesh middle_;
  double away_from_bone_ = 1;  ///< sign of the facets' normals
};

class Laying {
 public:
  Laying(const TabledLigament& tabled,
         const CarriedModel& model,
         const Surroundings& bones,
         const std::vector<LaidLigament>& before)
      : tabled_(tabled), model_(model), bones_(bones), before_(before) {}

  /// Empty where it cannot be attached, with the reason.
  std::optional<LaidLigament> lay(std::string& reason) {
    if (!find_middles(reason)) return std::nullopt;
    size_ = model_.size();
    half_mm_ = 0.5 * tabled_.thickness.mm * size_;
    const std::size_t strands = tabled_.strands;
    places_.resize(strands);
    for (std::size_t k = 0; k < strands; ++k) {
      const double u = 2.0 * static_cast<double>(k) / static_cast<double>(strands - 1) - 1;
      for (std::size_t a = 0; a < tabled_.attachments.size(); ++a) {
        places_[k].push_back(place_of(a, u));
      }
    }
    draw();
    settle_over(under_ligaments());
    return result();
  }

 private:
  struct Middle {
    Vec3 point;
    Vec3 outwards;
    Vec3 width;              ///< unit, from the first strand to the last
    std::vector<Vec3> line;  ///< carried across_mm, first strand first
  };

  bool find_middles(std::string& reason) {
    for (const TabledAttachment& a : tabled_.attachments) {
      Middle m;
      if (a.bone) {
        if (!model_.has(*a.bone)) {
          reason = "the " + std::string(carpus::name_of(*a.bone)) + " is missing or fused";
          return false;
        }
        if (model_.misfit_mm(*a.bone) > kWorstMisfitMm) {
          reason = "the " + std::string(carpus::name_of(*a.bone)) + " has another shape than known";
          return false;
        }
        for (const Vec3& p : a.across) m.line.push_back(model_.point(*a.bone, p));
        const auto on = bones_.on_bone(*a.bone, along_line(m.line, 0.5));
        m.point = on->point;
        m.outwards = on->outwards;
      } else {
        const auto on = std::find_if(before_.begin(), before_.end(), [&](const LaidLigament& l) {
          return l.ligament.id == a.ligament;
        });
        if (on == before_.end()) {
          reason = a.ligament + " is missing, on which it begins";
          return false;
        }
        const std::vector<Vec3>& course =
            on->ligament.strands[on->ligament.strands.size() / 2].course;
        m.point = along_line(course, a.fraction);
        m.width = normalized_or(along_line(course, std::min(1.0, a.fraction + 0.1)) -
                                    along_line(course, std::max(0.0, a.fraction - 0.1)),
                                {1, 0, 0});
        m.outwards = outward_side(tabled_.aspect, model_);
      }
      middles_.push_back(std::move(m));
    }
    for (std::size_t a = 0; a < middles_.size(); ++a) find_width(a);
    return true;
  }

  void find_width(std::size_t a) {
    Middle& m = middles_[a];
    const TabledAttachment& tabled = tabled_.attachments[a];
    const Vec3 path =
        middles_[std::min(a + 1, middles_.size() - 1)].point - middles_[a > 0 ? a - 1 : 0].point;
    const Vec3 sideways =
        normalized_or(cross(path, m.outwards) * model_.mirror(), any_perpendicular(m.outwards));
    if (m.line.size() > 1) {
      if (dot(m.line.back() - m.line.front(), sideways) < 0) {
        std::reverse(m.line.begin(), m.line.end());
      }
      m.width = normalized_or(m.line.back() - m.line.front(), sideways);
      return;
    }
    if (tabled.bone) m.width = tabled.along ? model_.way(*tabled.bone, *tabled.along) : sideways;
    if (dot(m.width, sideways) < 0) m.width = -m.width;
  }

  [[nodiscard]] std::vector<Under> under_ligaments() const {
    std::vector<Under> unders;
    for (const LaidLigament& l : before_) {
      if (std::find(tabled_.over.begin(), tabled_.over.end(), l.ligament.id) != tabled_.over.end())
        unders.emplace_back(l.sheet, bones_);
    }
    return unders;
  }

  void settle_over(const std::vector<Under>& unders) {
    const auto with_room = [&](const Vec3& p, double room_mm) {
      Vec3 lifted = bones_.with_room(p, room_mm);
      for (const Under& under : unders) lifted = under.over(lifted, room_mm);
      return lifted;
    };
    settle(rows_, rooms_, is_fixed_, with_room, kPasses, kAcross);
  }

  [[nodiscard]] double half_at_end() const {
    return std::max(kThinnestHalfMm, half_mm_ * kThinEnd);
  }

  Place place_of(std::size_t a, double u) const {
    const Middle& m = middles_[a];
    const TabledAttachment& tabled = tabled_.attachments[a];
    const Vec3 meant = m.line.size() > 1 ? along_line(m.line, 0.5 * (u + 1))
                                         : m.point + m.width * (u * tabled.half_width_mm * size_);
    Place place;
    if (!tabled.bone) {
      place.anchor = {0, tabled.ligament, tabled.fraction, meant, 0};
      place.lifted = meant;
      return place;
    }
    const auto on = bones_.on_bone(*tabled.bone, meant);
    place.anchor.at = on->point;
    place.anchor.label = bones_.data().bones[on->bone].label;
    const double lift =
        (tabled.is_via ? std::max(kThinnestHalfMm, half_mm_) : half_at_end()) + kGapMm;
    place.lifted = bones_.with_room(on->point + on->outwards * lift, lift);
    return place;
  }

  void draw() {
    const Vec3 side = outward_side(tabled_.aspect, model_);
    const std::size_t pieces = tabled_.attachments.size() - 1;
    std::vector<std::size_t> steps(pieces);
    for (std::size_t s = 0; s < pieces; ++s) {
      double longest = 0;
      for (const auto& strand : places_) {
        longest = std::max(longest, distance(strand[s].lifted, strand[s + 1].lifted));
      }
      steps[s] = std::max<std::size_t>(4, static_cast<std::size_t>(std::lround(longest / kStepMm)));
    }
    for (auto& strand : places_) {
      std::vector<Vec3> row;
      std::vector<bool> fixed;
      for (std::size_t s = 0; s < pieces; ++s) {
        const Vec3& a = strand[s].lifted;
        const Vec3& b = strand[s + 1].lifted;
        strand[s].anchor.point = row.size();
        for (std::size_t i = 0; i < steps[s]; ++i) {
          const double t = static_cast<double>(i) / static_cast<double>(steps[s]);
          const double bulge = kBulge * distance(a, b) * std::sin(std::numbers::pi * t);
          row.push_back(a + (b - a) * t + side * bulge);
          fixed.push_back(i == 0);
        }
      }
      strand.back().anchor.point = row.size();
      row.push_back(strand.back().lifted);
      fixed.push_back(true);
      rows_.push_back(std::move(row));
      is_fixed_.push_back(std::move(fixed));
    }
    for (const auto& row : rows_) {
      double whole = 0;
      for (std::size_t i = 1; i < row.size(); ++i) whole += distance(row[i - 1], row[i]);
      std::vector<double> half;
      std::vector<double> room;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double at = whole * static_cast<double>(i) / static_cast<double>(row.size() - 1);
        half.push_back(
            std::max(kThinnestHalfMm, half_mm_ * taper(std::min(at, whole - at), whole)));
        room.push_back(half.back() + kGapMm);
      }
      halves_.push_back(std::move(half));
      rooms_.push_back(std::move(room));
    }
  }

  LaidLigament result() const {
    LaidLigament laid;
    Ligament& l = laid.ligament;
    l.id = tabled_.id;
    l.name = tabled_.name;
    l.group = tabled_.group;
    l.thickness_mm = 2 * half_mm_;
    l.length_range_mm = {tabled_.length_mm.low * size_, tabled_.length_mm.high * size_};
    l.thickness_range_mm = {tabled_.thickness.range.low * size_,
                            tabled_.thickness.range.high * size_};
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Strand s;
      s.course = rows_[k];
      for (const Place& p : places_[k]) s.anchors.push_back(p.anchor);
      s.rest_length_mm = length_of(s);
      s.stiffness_n_per_mm = tabled_.stiffness_n_per_mm / static_cast<double>(rows_.size());
      l.strands.push_back(std::move(s));
    }
    const std::size_t last = l.strands.size() - 1;
    for (const std::size_t k : {last / 2, last - last / 2}) {
      const Strand& s = l.strands[k];
      const double straight = distance(s.anchors.front().at, s.anchors.back().at);
      l.straight_mm += 0.5 * straight;
      // The course lies half a thickness over the bone, so that a short one may pass as shorter.
      l.length_mm += 0.5 * std::max(s.rest_length_mm, straight);
    }
    for (std::size_t i = 0; i < rows_.front().size(); ++i) {
      for (std::size_t k = 1; k < rows_.size(); ++k) {
        l.width_mm += distance(rows_[k - 1][i], rows_[k][i]) / static_cast<double>(rows_[0].size());
      }
    }
    laid.sheet = sheet_of(rows_, halves_);
    return laid;
  }

  const TabledLigament& tabled_;
  const CarriedModel& model_;
  const Surroundings& bones_;
  const std::vector<LaidLigament>& before_;
  double size_ = 1;
  double half_mm_ = 0;
  std::vector<Middle> middles_;
  std::vector<std::vector<Place>> places_;
  std::vector<std::vector<Vec3>> rows_;
  std::vector<std::vector<bool>> is_fixed_;
  std::vector<std::vector<double>> halves_;
  std::vector<std::vector<double>> rooms_;
};

/// How many ligaments, one on the other, come before each.
std::vector<std::size_t> ranks_of(const std::vector<TabledLigament>& ligaments) {
  std::vector<std::size_t> ranks(ligaments.size());
  for (std::size_t i = 0; i < ligaments.size(); ++i) {
    const TabledLigament& l = ligaments[i];
    for (std::size_t k = 0; k < i; ++k) {
      const std::string& id = ligaments[k].id;
      const bool is_on = std::any_of(l.attachments.begin(), l.attachments.end(),
                                     [&](const auto& a) { return a.ligament == id; });
      if (is_on || std::find(l.over.begin(), l.over.end(), id) != l.over.end()) {
        ranks[i] = std::max(ranks[i], ranks[k] + 1);
      }
    }
  }
  return ranks;
}

}  // namespace

void settle(std::vector<std::vector<Vec3>>& rows,
            const std::vector<std::vector<double>>& room_mm,
            const std::vector<std::vector<bool>>& is_fixed,
            const WithRoom& with_room,
            int passes,
            double across) {
  for (int pass = 0; pass < passes; ++pass) {
    const auto before = rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::size_t i = 0; i < rows[r].size(); ++i) {
        if (is_fixed[r][i] || i == 0 || i + 1 == rows[r].size()) continue;
        Vec3 p = before[r][i];
        Vec3 drawn = ((before[r][i - 1] + before[r][i + 1]) * 0.5 - p) * 0.5;
        if (r > 0 && r + 1 < rows.size()) {
          drawn += ((before[r - 1][i] + before[r + 1][i]) * 0.5 - p) * across;
        }
        rows[r][i] = with_room(p + drawn, room_mm[r][i]);
      }
    }
  }
}

std::vector<LaidLigament> lay_ligaments(const TissueTable& table,
                                        const CarriedModel& model,
                                        const Surroundings& bones,
                                        std::vector<std::string>& problems) {
  const std::size_t count = table.ligaments.size();
  std::vector<std::optional<LaidLigament>> laid(count);
  std::vector<std::string> reasons(count);
  const std::vector<std::size_t> ranks = ranks_of(table.ligaments);
  const std::size_t highest = ranks.empty() ? 0 : *std::max_element(ranks.begin(), ranks.end());
  for (std::size_t rank = 0; rank <= highest; ++rank) {
    std::vector<LaidLigament> done;
    for (const auto& l : laid) {
      if (l) done.push_back(*l);
    }
    parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (ranks[i] != rank) continue;
        laid[i] = Laying(table.ligaments[i], model, bones, done).lay(reasons[i]);
      }
    });
  }
  std::vector<LaidLigament> all;
  for (std::size_t i = 0; i < count; ++i) {
    if (laid[i]) {
      all.push_back(std::move(*laid[i]));
    } else {
      problems.push_back(table.ligaments[i].name + " (" + table.ligaments[i].id +
                         ") cannot be attached: " + reasons[i]);
    }
  }
  return all;
}

}  // namespace carpus::soft_tissue::detail
