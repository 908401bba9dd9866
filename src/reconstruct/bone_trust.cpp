// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/bone_trust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "anatomy/model_shapes.hpp"
#include "core/parallel.hpp"
#include "core/text_format.hpp"
#include "geometry/trilinear.hpp"
#include "hull/fast_hull.hpp"
#include "hull/polytope_measures.hpp"
#include "imaging/binary_mask.hpp"
#include "mesh/normals.hpp"
#include "reconstruct/named_segmentation.hpp"

namespace carpus::reconstruct {
namespace {

using Labels = GridView<const std::uint8_t>;

/// Denser than cortical bone, which reaches some 2000 HU, and less than metal where scanners cut it
/// off at 3071 HU, smoothed as here: 3041 in a simulated wire, 2815 in dense bone by a sharp kernel
/// [E].
constexpr float kMetalHu = 2900;
/// Streaks reach farther, but what matters most to a bone lies at it [E].
constexpr double kMetalBesideMm = 4;

/// No bone but a fatty marrow is so thin.
constexpr float kDarkHu = 80;

struct Tally {
  std::size_t voxels = 0;
  std::size_t dark = 0;
  bool touches_border = false;
  VoxelIndex low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
                 std::numeric_limits<int>::max()};
  VoxelIndex high{-1, -1, -1};
};

std::vector<Tally> tally_of(const Labels& labels, const GridView<const float>& hu) {
  const std::array<int, 3>& size = labels.geometry().size;
  std::vector<Tally> tallies(256);
  std::size_t i = 0;
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x, ++i) {
        if (labels[i] == 0) continue;
        Tally& tally = tallies[labels[i]];
        ++tally.voxels;
        if (hu[i] < kDarkHu) ++tally.dark;
        tally.low = {std::min(tally.low.x, x), std::min(tally.low.y, y), std::min(tally.low.z, z)};
        tally.high = {std::max(tally.high.x, x), std::max(tally.high.y, y),
                      std::max(tally.high.z, z)};
      }
    }
  }
  for (Tally& t : tallies) {
    t.touches_border =
        t.voxels > 0 && (t.low.x == 0 || t.low.y == 0 || t.low.z == 0 || t.high.x == size[0] - 1 ||
                         t.high.y == size[1] - 1 || t.high.z == size[2] - 1);
  }
  return tallies;
}

double hull_volume(const TriangleMesh& surface) {
  const hull::HullResult made = hull::build_fast_hull(surface.vertices);
  return made.status == hull::HullStatus::Ok ? hull::measures_of(made.polytope).volume_mm3 : 0.0;
}

/// Part of a label's voxels that lies outside its largest connected component.
double detached_part(const Labels& labels, std::uint8_t label, const Tally& tally) {
  const Grid<std::uint8_t> part = imaging::crop(labels, imaging::VoxelBox{tally.low, tally.high});
  Grid<std::uint8_t> mask(part.geometry());
  for (std::size_t i = 0; i < mask.values().size(); ++i) mask[i] = part[i] == label ? 1 : 0;
  const imaging::Components components = imaging::connected_components(mask.view());
  const std::size_t largest = components.voxels[components.largest()];
  return 1.0 - static_cast<double>(largest) / static_cast<double>(tally.voxels);
}

/// Voxels of metal in the bone's extent and beside it, whatever label they have.
std::size_t metal_around(const GridView<const float>& hu, const Tally& tally) {
  const GridGeometry& g = hu.geometry();
  const auto reach = [](double spacing) {
    return static_cast<int>(std::ceil(kMetalBesideMm / spacing));
  };
  const VoxelIndex by{reach(g.spacing.x), reach(g.spacing.y), reach(g.spacing.z)};
  const VoxelIndex low{std::max(0, tally.low.x - by.x), std::max(0, tally.low.y - by.y),
                       std::max(0, tally.low.z - by.z)};
  const VoxelIndex high{std::min(g.size[0] - 1, tally.high.x + by.x),
                        std::min(g.size[1] - 1, tally.high.y + by.y),
                        std::min(g.size[2] - 1, tally.high.z + by.z)};
  std::size_t count = 0;
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) count += hu[VoxelIndex{x, y, z}] > kMetalHu ? 1 : 0;
    }
  }
  return count;
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

/// The CT along the normal of a surface, from 1.5 mm within to 1.5 mm beyond it.
class Profile {
 public:
  static constexpr double kStepMm = 0.25;
  static constexpr int kHalf = 6;

  Profile(const GridView<const float>& excess, const Vec3& at, const Vec3& outwards) {
    for (int k = -kHalf; k <= kHalf; ++k) {
      const double value = sample_at(excess, at + outwards * (k * kStepMm),
                                     std::numeric_limits<double>::quiet_NaN());
      is_whole_ = is_whole_ && !std::isnan(value);
      values_[static_cast<std::size_t>(k + kHalf)] = value;
    }
  }
  /// All of it lies in the scan.
  [[nodiscard]] bool is_whole() const { return is_whole_; }
  /// @param k  steps beyond the surface
  [[nodiscard]] double operator[](int k) const {
    return values_[static_cast<std::size_t>(k + kHalf)];
  }
  /// Where the CT falls to half of the cortex, next to the surface [mm]; none within 1.25 mm.
  [[nodiscard]] std::optional<double> edge() const {
    constexpr double kReachMm = 1.25;
    std::optional<double> nearest;
    for (int k = -kHalf; k < kHalf; ++k) {
      const double a = (*this)[k];
      const double b = (*this)[k + 1];
      if (!(a > 0 && b <= 0)) continue;
      const double mm = kStepMm * (k + a / (a - b));
      if (std::abs(mm) < kReachMm && (!nearest || std::abs(mm) < std::abs(*nearest))) nearest = mm;
    }
    return nearest;
  }
  /// How far the CT falls across a place on the profile [of the cortex].
  /// @param k  steps beyond the surface, of which kAround lie on either side
  [[nodiscard]] double fall_at(int k) const { return (*this)[k - kAround] - (*this)[k + kAround]; }
  static constexpr int kAround = 2;

 private:
  std::array<double, 2 * kHalf + 1> values_{};
  bool is_whole_ = true;
};

/// What the surface meets in the CT. Where it was closed flat at the end of the scan, nothing.
void measure_edge(const TriangleMesh& surface,
                  std::uint8_t label,
                  const Labels& labels,
                  const GridView<const float>& excess,
                  BoneEvidence& e) {
  constexpr int kOneMm = 4;  // steps
  constexpr double kNextMm = 0.75;
  constexpr double kFaintStep = 0.25;  // of the cortex, over 1 mm
  constexpr double kWidthOf = 0.4;     // the width is that of so much of the cortex
  constexpr double kLeastStep = 0.05;
  constexpr double kUnknownMm = 1.25;
  const double area = area_of(surface);
  const double volume = std::abs(volume_of(surface));
  e.roughness = area / (std::cbrt(36 * std::numbers::pi) * std::pow(volume, 2.0 / 3));
  const double hull_mm3 = hull_volume(surface);
  // Of the voxels: a surface knows nothing of hollows within.
  e.solidity = hull_mm3 > 0 ? e.volume_mm3 / hull_mm3 : 0.0;
  const std::vector<Vec3> normals = mesh::vertex_normals(surface);
  const GridGeometry& g = labels.geometry();
  double count = 0, edges = 0, off_mm = 0, width_mm = 0, voxel_mm = 0;
  double contact = 0, dense = 0, none = 0, faint = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3& at = surface.vertices[i];
    const Vec3& n = normals[i];
    const Profile profile(excess, at, n);
    if (!profile.is_whole()) continue;
    const double step = profile.fall_at(0);
    const std::optional<double> edge = profile.edge();
    const auto next = voxel_at(labels, at + n * kNextMm, std::uint8_t{0});
    const Vec3 along = g.direction.transposed() * n;
    count += 1;
    off_mm += edge ? std::abs(*edge) : kUnknownMm;
    none += edge ? 0 : 1;
    if (edge) {
      // Across the CT's own edge: beside it, as after something was erased, no CT looks sharp.
      const auto at_edge = static_cast<int>(std::lround(*edge / Profile::kStepMm));
      const int most = Profile::kHalf - Profile::kAround;
      const double fall = profile.fall_at(std::clamp(at_edge, -most, most));
      width_mm += kWidthOf / std::max(fall, kLeastStep);
      edges += 1;
    }
    faint += step < kFaintStep ? 1 : 0;
    dense += profile[kOneMm] > 0 ? 1 : 0;
    contact += next != 0 && next != label ? 1 : 0;
    voxel_mm += std::abs(along.x) * g.spacing.x + std::abs(along.y) * g.spacing.y +
                std::abs(along.z) * g.spacing.z;
  }
  if (!(count > 0) || !(volume > 0)) {
    e.no_edge = e.faint = 1;
    return;
  }
  const double share = area / volume / count;
  e.contact = contact / count;
  e.dense_beyond = dense / count;
  e.no_edge = none / count;
  e.faint = faint / count;
  e.off_edge = off_mm * share;
  e.edge_mm = edges > 0 ? width_mm / edges : 0.0;
  e.blur = e.edge_mm * area / volume;
  e.coarseness = voxel_mm * share;
}

struct LabelName {
  double misfit = 0;
  BoneId bone = BoneId::Radius;
  bool is_part = false;
  bool is_known = false;
};

LabelName name_of_label(std::uint8_t label, const anatomy::BoneNaming& naming) {
  LabelName found;
  for (const auto& region : naming.regions) {
    if (!region) continue;
    const std::uint8_t own = region->part == BonePart::Distal
                                 ? std::uint8_t{kScaphoidDistalLabel}
                                 : static_cast<std::uint8_t>(region->bone);
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

/// A shaft that was cut off its own base or head by mistake is a body without a name that goes on
/// where the bone ends.
void measure_severed(const imaging::RegionTable& table,
                     double voxel_mm3,
                     const anatomy::BoneNaming& naming,
                     std::vector<BoneEvidence>& bones) {
  constexpr double kGrownOnMm2 = 8;
  const auto is_named = [&](std::size_t region) {
    return region <= naming.regions.size() && naming.regions[region - 1].has_value();
  };
  for (const auto& [pair, contact] : table.contacts) {
    const auto [a, b] = pair;
    if (is_named(a) == is_named(b) || contact.area_mm2 < kGrownOnMm2) continue;
    const std::size_t named = is_named(a) ? a : b;
    const std::size_t nameless = is_named(a) ? b : a;
    const std::uint8_t label = label_for(*naming.regions[named - 1]);
    for (BoneEvidence& bone : bones) {
      if (bone.label != label || !(bone.volume_mm3 > 0)) continue;
      bone.severed += static_cast<double>(table.voxels[nameless]) * voxel_mm3 / bone.volume_mm3;
    }
  }
}

double excess_over(double value, double limit) { return std::max(0.0, value - limit); }

}  // namespace

std::vector<BoneEvidence> measure_evidence(const Labels& labels,
                                           const imaging::RegionTable& regions,
                                           const GridView<const float>& edge_excess,
                                           const GridView<const float>& smoothed_hu,
                                           std::span<const LabelSurface> surfaces,
                                           const anatomy::BoneNaming& naming) {
  const std::vector<Tally> tallies = tally_of(labels, smoothed_hu);
  const double voxel_mm3 = labels.geometry().voxel_volume_mm3();
  const double noise_hu = noise_of(labels, smoothed_hu);
  const anatomy::ModelShapes& model = anatomy::generic_model_shapes(naming.side);
  std::vector<BoneEvidence> result;
  for (std::size_t label = 1; label < tallies.size(); ++label) {
    if (tallies[label].voxels == 0) continue;
    result.emplace_back().label = static_cast<std::uint8_t>(label);
  }
  const auto measure = [&](BoneEvidence& e) {
    const std::uint8_t number = e.label;
    const Tally& t = tallies[number];
    const LabelName name = name_of_label(number, naming);
    e.volume_mm3 = static_cast<double>(t.voxels) * voxel_mm3;
    e.misfit = name.misfit;
    const anatomy::BodyShape& bone = model[static_cast<std::size_t>(name.bone) - 1];
    const bool is_carpal = name.is_known && !bone.is_cut;
    if (is_carpal && !name.is_part && !t.touches_border) {
      e.volume_ratio = e.volume_mm3 / (bone.volume_mm3 * std::pow(naming.scale, 3));
    }
    e.solidity = 0;
    e.detached = detached_part(labels, number, t);
    e.noise_hu = noise_hu;
    e.metal_mm3 = static_cast<double>(metal_around(smoothed_hu, t)) * voxel_mm3;
    e.dark = static_cast<double>(t.dark) / static_cast<double>(t.voxels);
    e.wrist_misfit = naming.cost;
    const auto surface =
        std::find_if(surfaces.begin(), surfaces.end(),
                     [&](const LabelSurface& each) { return each.label == number; });
    if (surface != surfaces.end() && !surface->surface->facets.empty()) {
      measure_edge(*surface->surface, number, labels, edge_excess, e);
    } else {
      e.no_edge = e.faint = 1;
    }
  };
  parallel_for(result.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) measure(result[i]);
  });
  compare_volumes(result);
  measure_severed(regions, voxel_mm3, naming, result);
  return result;
}

std::span<const EvidenceField> evidence_fields() {
  using E = BoneEvidence;
  static constexpr std::array<EvidenceField, 18> kFields{{{"volume_mm3", &E::volume_mm3},
                                                          {"misfit", &E::misfit},
                                                          {"volume_ratio", &E::volume_ratio},
                                                          {"relative_volume", &E::relative_volume},
                                                          {"solidity", &E::solidity},
                                                          {"detached", &E::detached},
                                                          {"roughness", &E::roughness},
                                                          {"contact", &E::contact},
                                                          {"dense_beyond", &E::dense_beyond},
                                                          {"no_edge", &E::no_edge},
                                                          {"faint", &E::faint},
                                                          {"off_edge", &E::off_edge},
                                                          {"blur", &E::blur},
                                                          {"coarseness", &E::coarseness},
                                                          {"dark", &E::dark},
                                                          {"severed", &E::severed},
                                                          {"noise_hu", &E::noise_hu},
                                                          {"wrist_misfit", &E::wrist_misfit}}};
  return kFields;
}

const std::vector<std::string>& concern_names() {
  static const std::vector<std::string> kNames{"misfit",   "volume",       "detached",
                                               "rough",    "dense beyond", "no edge",
                                               "off edge", "coarse",       "dark"};
  return kNames;
}

std::vector<double> concerns_of(const BoneEvidence& e) {
  return {std::log1p(e.misfit),
          std::abs(std::log(std::max(e.relative_volume, 1e-3))),
          std::sqrt(std::max(0.0, e.detached)),
          excess_over(e.roughness, 1.1),
          std::sqrt(e.dense_beyond),
          std::sqrt(e.no_edge),
          e.off_edge,
          e.coarseness,
          std::sqrt(e.dark)};
}

namespace {

/// Fitted: docs/decisions/0061-trust.md. In the order of concerns_of.
constexpr std::array<double, 9> kWeights{3.40, 0.60, 4.94, 6.53, 6.29, 6.19, 21.25, 0.20, 2.69};
constexpr double kOffset = 6.81;
/// Beyond these a reason is said; also where the confidence is low and nothing else is known.
constexpr double kSaidMisfit = anatomy::kSuspiciousBoneCost;
constexpr double kSaidVolume = 0.45;
constexpr double kSaidSolidity = 0.7;
constexpr double kSaidContact = 0.15;
constexpr double kSaidNoEdge = 0.08;
/// A third wider than the voxels, of which a sharp edge takes one [E]; on simulated scans 1.1 with
/// a usual kernel, 1.3 to 1.9 with a smooth one.
constexpr double kSaidBlurOfVoxel = 1.3;
constexpr double kSaidEdgeMm = 0.6;  // what is narrower hides nothing [E]
constexpr double kSaidCoarseness = 0.75;
constexpr double kSaidDetached = 0.01;
constexpr double kSaidNoise = 45;
constexpr double kSaidSevered = 0.1;
constexpr double kSaidMetal = 2;  // a wire of 1 mm, 2.5 mm long

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
  if (e.contact > kSaidContact) {
    say(format("%.0f %% of its surface touches another bone: part them along the joint",
               100 * e.contact));
  }
  if (e.no_edge > kSaidNoEdge) {
    say(format("%.0f %% of its surface has no edge in the CT: draw it there", 100 * e.no_edge));
  }
  if (e.detached > kSaidDetached) {
    say(format("%.0f %% of it lies apart from the rest: join it or give it another name",
               100 * e.detached));
  }
  if (e.severed > kSaidSevered) {
    say("a body without a name grows on it: join the two if they are one bone");
  }
  // Streaks and what they tear out of a bone make it ragged, blurred and noisy; and a ragged bone
  // has much surface for its volume, whatever its voxels and its edge are like.
  if (e.metal_mm3 > kSaidMetal) {
    say("metal in it or beside it hides its edge: outline it by hand where streaks cross it, or "
        "use a scan that was corrected for metal");
    return text;
  }
  const bool is_ragged = e.solidity < kSaidSolidity;
  if (!is_ragged && e.coarseness > kSaidCoarseness) {
    say("the voxels are coarse for a bone so small: use a scan with thinner slices");
  } else if (e.edge_mm > kSaidEdgeMm && e.blur > kSaidBlurOfVoxel * e.coarseness) {
    say("its edge is blurred: use a sharper kernel, or a scan in which the arm lay still");
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
  const bool is_impossible =
      e.misfit > 12 || e.detached > 0.05 || e.volume_ratio < 0.4 || e.severed > kSaidSevered;
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
