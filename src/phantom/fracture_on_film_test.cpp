// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a fresh fracture shows on the pictures of the C-arm: along the line the picture must be
// brighter than beside it, by several times what the same measure gives where nothing is broken
// (other bones' edges, trabeculae, quantum noise).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "core/rng.hpp"
#include "fluoroscopy/render.hpp"
#include "phantom/phantom.hpp"

namespace carpus::phantom {
namespace {

/// The line is looked at over this length [mm]; the waist is 9 to 11 mm wide.
constexpr double kHalfLengthMm = 4.0;
/// Brightness on the line is the mean within this of it, beside it the mean within the others.
constexpr double kOnLineMm = 0.25;
constexpr double kBesideFromMm = 0.7;
constexpr double kBesideToMm = 1.3;
constexpr double kStepMm = 0.1;
/// Lines at other places of the intact bone say what chance gives [mm].
constexpr double kElsewhereMm = 3.0;
/// A line is seen where it stands out by this many deviations and grey values.
constexpr double kSeenRatio = 3.0;
constexpr double kSeenGrey = 15.0;

/// The fracture's mean plane in the patient.
struct MeanPlane {
  Vec3 point;
  Vec3 normal;
};

MeanPlane plane_of(const Phantom& phantom) {
  const auto patient_from_wrist = phantom.wrist_from_patient.inverse();
  const Vec3 point = phantom.fracture->point * phantom.options.scale;
  return {(patient_from_wrist * Point<frame::Wrist>{point}).v,
          patient_from_wrist.rotation * phantom.fracture->normal};
}

/// One picture and how the fracture would lie in it.
class Film {
 public:
  Film(const fluoroscopy::FluoroscopyRenderer& renderer,
       const Phantom& phantom,
       const MeanPlane& plane,
       const fluoroscopy::NamedView& view)
      : pose_(fluoroscopy::make_c_arm_pose(
            view.angles,
            {plane.point},
            phantom.wrist_from_patient,
            {{0, phantom.options.side == Side::Left ? 1.0 : -1.0, 0}})),
        image_(renderer.render(pose_, {}, {})),
        plane_(plane) {
    const Vec3 beam = normalized_or(plane.point - pose_.source_in_patient().v, {0, 0, 1});
    along_ = normalized_or(cross(plane.normal, beam), {1, 0, 0});
    across_ = cross(beam, along_);
  }

  /// How much brighter the picture is on a line than beside it, in grey values; the line lies
  /// `off_mm` beside the fracture's mean plane.
  [[nodiscard]] double contrast(double off_mm) const {
    return mean_between(off_mm, 0, kOnLineMm) - mean_between(off_mm, kBesideFromMm, kBesideToMm);
  }

 private:
  [[nodiscard]] double mean_between(double off_mm, double from_mm, double to_mm) const {
    double sum = 0;
    double count = 0;
    for (double s = -to_mm; s <= to_mm + 1e-9; s += kStepMm) {
      if (std::abs(s) < from_mm - 1e-9) continue;
      for (double t = -kHalfLengthMm; t <= kHalfLengthMm; t += kStepMm) {
        sum += grey_at(plane_.point + across_ * (off_mm + s) + along_ * t);
        ++count;
      }
    }
    return sum / count;
  }
  [[nodiscard]] double grey_at(const Vec3& p) const {
    const auto pixel = fluoroscopy::project_point(pose_, {p}).value();
    const auto x = static_cast<std::size_t>(std::lround(pixel.x));
    const auto y = static_cast<std::size_t>(std::lround(pixel.y));
    return image_.grey[y * static_cast<std::size_t>(image_.width) + x];
  }

  fluoroscopy::CArmPose pose_;
  fluoroscopy::Image image_;
  MeanPlane plane_;
  Vec3 along_;
  Vec3 across_;
};

/// What the fracture adds to the contrast along its line, over the deviation of the same measure in
/// the intact bone.
struct Visibility {
  std::string view;
  double contrast = 0;  ///< grey values of 255
  double noise = 0;
  [[nodiscard]] double ratio() const { return contrast / noise; }
};

std::vector<Visibility> visibility(const PhantomOptions& options) {
  const Phantom broken = make_phantom(options);
  PhantomOptions whole = options;
  whole.fracture = FractureKind::None;
  const Phantom intact = make_phantom(whole);
  const fluoroscopy::FluoroscopyRenderer with(broken.ct.view());
  const fluoroscopy::FluoroscopyRenderer without(intact.ct.view());
  const MeanPlane plane = plane_of(broken);
  std::vector<Visibility> result;
  for (const fluoroscopy::NamedView& view : fluoroscopy::kNamedViews) {
    const Film film(with, broken, plane, view);
    const Film other(without, broken, plane, view);
    double squares = 0;
    double count = 0;
    for (double off = -kElsewhereMm; off <= kElsewhereMm + 1e-9; off += kStepMm) {
      squares += other.contrast(off) * other.contrast(off);
      ++count;
    }
    result.push_back(
        {std::string(view.id), film.contrast(0) - other.contrast(0), std::sqrt(squares / count)});
  }
  return result;
}

bool is_seen(const Visibility& v) { return v.ratio() >= kSeenRatio && v.contrast >= kSeenGrey; }

std::string table(const std::vector<Visibility>& all) {
  std::string text;
  for (const Visibility& v : all) {
    text += v.view + " contrast " + std::to_string(v.contrast) + " noise " +
            std::to_string(v.noise) + " ratio " + std::to_string(v.ratio()) + "\n";
  }
  return text;
}

TEST(FractureOnFilm, AWaistFractureInPlaceShowsOnTwoStandardViews) {
  PhantomOptions options;
  options.spacing = {0.4, 0.4, 0.5};
  const std::vector<Visibility> all = visibility(options);
  std::printf("%s", table(all).c_str());
  EXPECT_GE(std::count_if(all.begin(), all.end(), is_seen), 2) << table(all);
  EXPECT_TRUE(is_seen(all.front())) << "PA: " << table(all);
}

}  // namespace
}  // namespace carpus::phantom
