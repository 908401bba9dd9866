// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/bone_trust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "anatomy/model_shapes.hpp"
#include "core/text_format.hpp"
#include "hull/fast_hull.hpp"
#include "hull/polytope_measures.hpp"
#include "imaging/binary_mask.hpp"

namespace carpus::reconstruct {
namespace {

using Labels = GridView<const std::uint16_t>;

/// A face whose two voxels differ by less than this part of the local cortex is no edge.
constexpr float kLeastStep = 0.12F;
/// The edge is put at half of the cortex; this much lower and higher it should lie nearly there.
constexpr float kShift = 0.1F;
/// No bone but a fatty marrow is so thin.
constexpr float kDarkHu = 80;
/// Points of the border that a hull is made of.
constexpr std::size_t kHullPoints = 4000;

struct Tally {
  std::size_t voxels = 0;
  double faces_mm2 = 0;
  double leak_mm2 = 0;
  double weak_mm2 = 0;
  double bright_mm2 = 0;
  double step_mm2 = 0;  ///< sum of steps times area
  double outer_mm2 = 0;
  std::size_t dark = 0;
  std::size_t unsteady = 0;
  bool touches_border = false;
  std::vector<Vec3> rim;
  VoxelIndex low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
                 std::numeric_limits<int>::max()};
  VoxelIndex high{-1, -1, -1};
};

/// One face between voxel `i` of a bone and its neighbour `j`.
void count_face(const Labels& labels,
                const GridView<const float>& excess,
                std::size_t i,
                std::size_t j,
                double face_mm2,
                Tally& tally) {
  if (labels[i] == labels[j]) return;
  tally.faces_mm2 += face_mm2;
  if (labels[j] != 0) {
    tally.leak_mm2 += face_mm2;
  } else {
    const float step = excess[i] - excess[j];
    tally.outer_mm2 += face_mm2;
    tally.step_mm2 += static_cast<double>(std::clamp(step, 0.0F, 1.0F)) * face_mm2;
    if (step < kLeastStep) tally.weak_mm2 += face_mm2;
    if (excess[j] > 0) tally.bright_mm2 += face_mm2;
  }
  // An edge between 0.4 and 0.6 of the cortex moves when the threshold does.
  if (excess[i] < kShift) ++tally.unsteady;
  if (excess[j] > -kShift) ++tally.unsteady;
}

std::vector<Tally> tally_of(const Labels& labels,
                            const GridView<const float>& excess,
                            const GridView<const float>& hu) {
  const GridGeometry& g = labels.geometry();
  std::vector<Tally> tallies(256);
  const std::array<VoxelIndex, 6> steps{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  const std::array<double, 3> face_mm2{g.spacing.y * g.spacing.z, g.spacing.x * g.spacing.z,
                                       g.spacing.x * g.spacing.y};
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    if (labels[i] == 0 || labels[i] > 255) continue;
    Tally& tally = tallies[labels[i]];
    ++tally.voxels;
    if (hu[i] < kDarkHu) ++tally.dark;
    const VoxelIndex v = g.index_of(i);
    tally.low = {std::min(tally.low.x, v.x), std::min(tally.low.y, v.y),
                 std::min(tally.low.z, v.z)};
    tally.high = {std::max(tally.high.x, v.x), std::max(tally.high.y, v.y),
                  std::max(tally.high.z, v.z)};
    bool on_rim = false;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const VoxelIndex n{v.x + steps[s].x, v.y + steps[s].y, v.z + steps[s].z};
      if (!g.contains(n)) {
        tally.touches_border = true;
        continue;
      }
      const std::size_t j = g.offset_of(n);
      on_rim = on_rim || labels[j] != labels[i];
      count_face(labels, excess, i, j, face_mm2[s / 2], tally);
    }
    if (on_rim) {
      tally.rim.push_back(g.patient_from_voxel(
          {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}));
    }
  }
  return tallies;
}

double hull_volume(std::vector<Vec3> points) {
  if (points.size() > kHullPoints) {
    for (std::size_t k = 0; k < kHullPoints; ++k) {
      points[k] = points[k * points.size() / kHullPoints];
    }
    points.resize(kHullPoints);
  }
  const hull::HullResult made = hull::build_fast_hull(points);
  return made.status == hull::HullStatus::Ok ? hull::measures_of(made.polytope).volume_mm3 : 0.0;
}

/// Part of a label's voxels that lies outside its largest connected component.
double detached_part(const Labels& labels, std::uint16_t label, const Tally& tally) {
  const Grid<std::uint16_t> part = imaging::crop(labels, imaging::VoxelBox{tally.low, tally.high});
  Grid<std::uint8_t> mask(part.geometry());
  for (std::size_t i = 0; i < mask.values().size(); ++i) mask[i] = part[i] == label ? 1 : 0;
  const imaging::Components components = imaging::connected_components(mask.view());
  const std::size_t largest = components.voxels[components.largest()];
  return 1.0 - static_cast<double>(largest) / static_cast<double>(tally.voxels);
}

/// Deviation of what is soft tissue [HU]: noise, streaks and shading together.
double noise_of(const Labels& labels, const GridView<const float>& hu) {
  double sum = 0;
  double squares = 0;
  double count = 0;
  for (std::size_t i = 0; i + 1 < hu.values().size(); i += 3) {
    const double a = hu[i];
    const double b = hu[i + 1];
    if (labels[i] != 0 || std::abs(a) > 200 || std::abs(b) > 200) continue;
    sum += a - b;
    squares += (a - b) * (a - b);
    count += 1;
  }
  return count > 0 ? std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)) / 2)
                   : 0.0;
}

struct LabelName {
  double misfit = 0;
  BoneId bone = BoneId::Radius;
  bool is_part = false;
  bool is_known = false;
};

LabelName name_of_label(std::uint16_t label, const anatomy::BoneNaming& naming) {
  LabelName found;
  for (const auto& region : naming.regions) {
    if (!region) continue;
    const std::uint16_t own = region->part == BonePart::Distal
                                  ? std::uint16_t{kScaphoidDistalLabel}
                                  : static_cast<std::uint16_t>(region->bone);
    if (own != label) continue;
    found = {region->cost, region->bone, region->part != BonePart::Whole, true};
  }
  return found;
}

/// A wrist may be large or small as a whole; one bone of it may not.
void compare_volumes(std::vector<BoneEvidence>& bones) {
  std::vector<double> ratios;
  for (const BoneEvidence& bone : bones) {
    if (bone.volume_ratio != 1) ratios.push_back(bone.volume_ratio);
  }
  if (ratios.size() < 3) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  for (BoneEvidence& bone : bones) {
    if (bone.volume_ratio != 1) bone.relative_volume = bone.volume_ratio / *middle;
  }
}

double excess_over(double value, double limit) { return std::max(0.0, value - limit); }

}  // namespace

std::vector<BoneEvidence> measure_evidence(const Labels& labels,
                                           const GridView<const float>& edge_excess,
                                           const GridView<const float>& smoothed_hu,
                                           const anatomy::BoneNaming& naming) {
  const std::vector<Tally> tallies = tally_of(labels, edge_excess, smoothed_hu);
  const double voxel_mm3 = labels.geometry().voxel_volume_mm3();
  const double noise_hu = noise_of(labels, smoothed_hu);
  const anatomy::ModelShapes& model = anatomy::generic_model_shapes(naming.side);
  std::vector<BoneEvidence> result;
  for (std::size_t label = 1; label < tallies.size(); ++label) {
    const Tally& t = tallies[label];
    if (t.voxels == 0) continue;
    const auto number = static_cast<std::uint16_t>(label);
    const LabelName name = name_of_label(number, naming);
    BoneEvidence e;
    e.label = static_cast<std::uint8_t>(label);
    e.volume_mm3 = static_cast<double>(t.voxels) * voxel_mm3;
    e.misfit = name.misfit;
    const anatomy::BodyShape& bone = model[static_cast<std::size_t>(name.bone) - 1];
    const bool is_carpal = name.is_known && !bone.is_cut;
    if (is_carpal && !name.is_part && !t.touches_border) {
      e.volume_ratio = e.volume_mm3 / (bone.volume_mm3 * std::pow(naming.scale, 3));
    }
    const double hull_mm3 = hull_volume(t.rim);
    e.solidity = hull_mm3 > 0 ? e.volume_mm3 / hull_mm3 : 0.0;
    e.leak = t.faces_mm2 > 0 ? t.leak_mm2 / t.faces_mm2 : 0.0;
    e.weak_rim = t.faces_mm2 > 0 ? t.weak_mm2 / t.faces_mm2 : 1.0;
    e.unsteady = static_cast<double>(t.unsteady) / static_cast<double>(t.voxels);
    e.detached = detached_part(labels, number, t);
    e.roughness =
        t.faces_mm2 / (std::cbrt(36 * std::numbers::pi) * std::pow(e.volume_mm3, 2.0 / 3));
    e.noise_hu = noise_hu;
    e.sharpness = t.outer_mm2 > 0 ? t.step_mm2 / t.outer_mm2 : 0.0;
    e.bright_rim = t.faces_mm2 > 0 ? t.bright_mm2 / t.faces_mm2 : 1.0;
    e.rim_part = static_cast<double>(t.rim.size()) / static_cast<double>(t.voxels);
    e.dark = static_cast<double>(t.dark) / static_cast<double>(t.voxels);
    e.wrist_misfit = naming.cost;
    result.push_back(e);
  }
  compare_volumes(result);
  return result;
}

std::span<const EvidenceField> evidence_fields() {
  using E = BoneEvidence;
  static constexpr std::array<EvidenceField, 16> kFields{{{"volume_mm3", &E::volume_mm3},
                                                          {"misfit", &E::misfit},
                                                          {"volume_ratio", &E::volume_ratio},
                                                          {"solidity", &E::solidity},
                                                          {"leak", &E::leak},
                                                          {"weak_rim", &E::weak_rim},
                                                          {"unsteady", &E::unsteady},
                                                          {"detached", &E::detached},
                                                          {"roughness", &E::roughness},
                                                          {"noise_hu", &E::noise_hu},
                                                          {"relative_volume", &E::relative_volume},
                                                          {"sharpness", &E::sharpness},
                                                          {"bright_rim", &E::bright_rim},
                                                          {"rim_part", &E::rim_part},
                                                          {"dark", &E::dark},
                                                          {"wrist_misfit", &E::wrist_misfit}}};
  return kFields;
}

const std::vector<std::string>& concern_names() {
  static const std::vector<std::string> kNames{"misfit",   "volume",   "hollow", "leak", "weak rim",
                                               "unsteady", "detached", "rough",  "noise"};
  return kNames;
}

std::vector<double> concerns_of(const BoneEvidence& e) {
  return {std::log1p(e.misfit),
          std::abs(std::log(std::max(e.volume_ratio, 1e-3))),
          excess_over(0.95, e.solidity),
          std::sqrt(e.leak),
          e.weak_rim,
          e.unsteady,
          std::sqrt(std::max(0.0, e.detached)),
          excess_over(e.roughness, 1.5),
          e.noise_hu / 100};
}

namespace {

/// Set by hand: docs/decisions/0061-trust.md. In the order of concerns_of.
constexpr std::array<double, 9> kWeights{0.9, 3.0, 8.0, 6.0, 8.0, 2.0, 6.0, 1.5, 1.0};
constexpr double kOffset = 5.5;
/// Beyond these a reason is said; also where the confidence is low and nothing else is known.
constexpr double kSaidMisfit = anatomy::kSuspiciousBoneCost;
constexpr double kSaidVolume = 0.45;
constexpr double kSaidSolidity = 0.7;
constexpr double kSaidLeak = 0.06;
constexpr double kSaidWeakRim = 0.12;
constexpr double kSaidDetached = 0.01;
constexpr double kSaidNoise = 45;

std::string reasons_of(const BoneEvidence& e) {
  std::string text;
  const auto say = [&](const std::string& words) { text += (text.empty() ? "" : "; ") + words; };
  if (e.misfit > kSaidMisfit) {
    say(format("it lies or is shaped unlike this bone (misfit %.0f): check its name and outline",
               e.misfit));
  }
  if (std::abs(std::log(std::max(e.volume_ratio, 1e-3))) > kSaidVolume) {
    say(format("its volume is %.0f %% of what a wrist of this size has: look whether it %s",
               100 * e.volume_ratio,
               e.volume_ratio < 1 ? "lost a part" : "swallowed a neighbour or soft tissue"));
  }
  if (e.solidity < kSaidSolidity) say("it is hollow or ragged: fill it where marrow was left out");
  if (e.leak > kSaidLeak) {
    say(format("%.0f %% of its surface touches another bone: part them along the joint",
               100 * e.leak));
  }
  if (e.weak_rim > kSaidWeakRim) {
    say(format("%.0f %% of its border has no edge in the CT: draw it there", 100 * e.weak_rim));
  }
  if (e.detached > kSaidDetached) {
    say(format("%.0f %% of it lies apart from the rest: join it or give it another name",
               100 * e.detached));
  }
  if (e.noise_hu > kSaidNoise) {
    say("the scan is noisy or streaked: use a scan of a higher dose or a softer kernel");
  }
  return text;
}

}  // namespace

BoneTrust judge(const BoneEvidence& e) {
  const std::vector<double> concerns = concerns_of(e);
  double sum = kOffset;
  for (std::size_t k = 0; k < kWeights.size(); ++k) sum -= kWeights[k] * concerns[k];
  BoneTrust trust;
  trust.confidence = 1 / (1 + std::exp(-sum));
  // What no fit may talk away.
  const bool is_impossible = e.misfit > 12 || e.detached > 0.05 || e.volume_ratio < 0.4;
  if (is_impossible) trust.confidence = std::min(trust.confidence, 0.3);
  trust.flagged = trust.confidence < kTrustedConfidence;
  if (!trust.flagged) return trust;
  trust.why = reasons_of(e);
  if (trust.why.empty()) {
    trust.why = "several measures are each a little worse than on scans that were segmented well";
  }
  trust.why += ". Compare its outline with the CT before use.";
  return trust;
}

}  // namespace carpus::reconstruct
