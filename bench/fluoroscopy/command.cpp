// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers first: composed pictures against the plain CT, against a CT resampled for the pose and
// against small steps through the same composition. Only then times.
#include "bench/fluoroscopy/command.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "bench/fluoroscopy/accuracy.hpp"
#include "bench/fluoroscopy/report.hpp"
#include "bench/fluoroscopy/resampled_ct.hpp"
#include "bench/fluoroscopy/scene.hpp"
#include "bench/fluoroscopy/speed.hpp"
#include "bench/output_file.hpp"
#include "case_io/case_folder.hpp"
#include "cases/make_hand_motion.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "fluoroscopy/composed_renderer.hpp"

namespace carpus::bench {
namespace {

using fluoroscopy::AttenuationMap;
using fluoroscopy::CArmPose;
using fluoroscopy::ComposedRenderer;
using fluoroscopy::Exposure;
using fluoroscopy::FluoroscopyRenderer;

constexpr int kFull = 512;
constexpr int kLive = 256;
constexpr double kStepMm = 0.05;
constexpr std::size_t kStride = 15;       ///< of the pixels that are also summed in small steps
constexpr double kMostMeanPercent = 0.5;  ///< against small steps: beyond this nothing is timed

/// PA, lateral and the 45 degree pronated oblique.
constexpr std::span<const fluoroscopy::NamedView> kViews{fluoroscopy::kNamedViews.data(), 3};

struct Measured {
  const cases::CaseData& data;
  ComposedRenderer& composed;
  const FluoroscopyRenderer& plain;
  const RigidBones& bones;
  double flexion_deg;
  std::filesystem::path pictures;
};

/// Takes pixels out of the comparison whose rays meet bones in one place; returns their share.
double leave_out(AttenuationMap& oracle, const CArmPose& pose, const FluoroscopyRenderer& both) {
  const AttenuationMap overlap = both.project(pose, {});
  double seen = 0;
  double out = 0;
  for (std::size_t i = 0; i < oracle.values.size(); ++i) {
    if (std::isnan(oracle.values[i])) continue;
    seen += 1;
    if (!(overlap.values[i] > 0)) continue;
    out += 1;
    oracle.values[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return seen > 0 ? 100 * out / seen : 0;
}

void save(const Measured& m,
          const std::string& name,
          const CArmPose& pose,
          const AttenuationMap& map) {
  if (m.pictures.empty()) return;
  const Exposure exposure;
  const fluoroscopy::Image image =
      display(detect(map, pose.geometry, exposure), map, pose.geometry, exposure);
  std::string text =
      "P5 " + std::to_string(image.width) + " " + std::to_string(image.height) + " 255\n";
  text.append(image.grey.begin(), image.grey.end());
  write_text(m.pictures / (name + ".pgm"), text);
}

void compare_as_scanned(const Measured& m, std::vector<Difference>& rows) {
  const BodyPoses still(m.data.bones.size());
  for (const fluoroscopy::NamedView& view : kViews) {
    const CArmPose pose = c_arm(m.data, view.angles, kFull);
    const AttenuationMap map = m.composed.projector().project(pose, still);
    const auto add = [&](const char* oracle, const AttenuationMap& other) {
      Difference d = difference_of(map, other);
      d.view = view.id;
      d.oracle = oracle;
      rows.push_back(d);
    };
    add("plain CT", m.plain.project(pose, {}));
    add("0.05 mm steps", stepped_map(m.composed.projector(), pose, still, kStepMm, kStride));
  }
}

void compare_flexed(const Measured& m, double flexion_deg, std::vector<Difference>& rows) {
  const BodyPoses poses = flexed(m.data, flexion_deg);
  const Grid<std::int16_t> ct = m.bones.resampled_ct(m.composed.projector().bending(), poses);
  const FluoroscopyRenderer resampled(ct.view());
  const Grid<std::int16_t> both = m.bones.bones_in_one_place(poses);
  const FluoroscopyRenderer overlap(both.view());
  for (const fluoroscopy::NamedView& view : kViews) {
    const CArmPose pose = c_arm(m.data, view.angles, kFull);
    const AttenuationMap map = m.composed.projector().project(pose, poses);
    const auto add = [&](const char* oracle, const AttenuationMap& other, double left_out) {
      Difference d = difference_of(map, other);
      d.view = view.id;
      d.oracle = oracle;
      d.flexion_deg = flexion_deg;
      d.left_out_percent = left_out;
      rows.push_back(d);
    };
    AttenuationMap oracle = resampled.project(pose, {});
    const std::string name =
        std::string(view.id) + "_" + std::to_string(static_cast<int>(flexion_deg)) + "_deg_";
    save(m, name + "composed", pose, map);
    save(m, name + "resampled", pose, oracle);
    const double left_out = leave_out(oracle, pose, overlap);
    add("resampled CT", oracle, left_out);
    add("0.05 mm steps", stepped_map(m.composed.projector(), pose, poses, kStepMm, kStride), 0);
  }
}

std::vector<Difference> measure_accuracy(const Measured& m) {
  std::vector<Difference> rows;
  compare_as_scanned(m, rows);
  compare_flexed(m, m.flexion_deg, rows);
  compare_flexed(m, -m.flexion_deg / 2, rows);
  for (const Difference& d : rows) {
    if (d.oracle != "resampled CT" && !(d.mean_percent <= kMostMeanPercent)) {
      throw InvalidInput("bench fluoroscopy: " + d.view + " differs by " +
                         std::to_string(d.mean_percent) + " % of its range from " + d.oracle +
                         "; nothing is timed");
    }
  }
  return rows;
}

/// A 1 mm hole that grows along the scaphoid, told to the renderer box by box.
class GrowingHole {
 public:
  explicit GrowingHole(const cases::CaseData& data) : axis_(data.scaphoid.central_axis) {
    for (std::size_t b = 0; b < data.bones.size(); ++b) {
      if (data.bones[b].bone == BoneId::Scaphoid) body_ = b;
    }
    GridGeometry g;
    g.spacing = {0.25, 0.25, 0.25};
    g.size = {160, 160, 160};
    g.origin = (axis_.proximal + axis_.distal) * 0.5 - Vec3{20, 20, 20};
    share_ = Grid<std::uint8_t>(g);
  }

  void grow(ComposedRenderer& renderer, int picture) {
    const Vec3 tip = axis_.proximal + (axis_.distal - axis_.proximal) * (picture % 50 / 50.0);
    const GridGeometry& g = share_.geometry();
    const Vec3 v = g.voxel_from_patient(tip);
    fluoroscopy::IndexBox box;
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = std::clamp(static_cast<int>(v[a]) - 3, 0, g.size[a]);
      box.high[a] = std::clamp(static_cast<int>(v[a]) + 4, 0, g.size[a]);
    }
    for (int z = box.low[2]; z < box.high[2]; ++z) {
      for (int y = box.low[1]; y < box.high[1]; ++y) {
        for (int x = box.low[0]; x < box.high[0]; ++x) {
          if (distance(v, {double(x), double(y), double(z)}) < 2) share_[VoxelIndex{x, y, z}] = 255;
        }
      }
    }
    renderer.set_removed(body_, {g, std::as_const(share_).values()}, box);
  }

 private:
  cases::AxisSegment axis_;
  std::size_t body_ = 0;
  Grid<std::uint8_t> share_;
};

std::vector<PictureTimes> measure_speed(const Measured& m) {
  constexpr double kBudgetSeconds = 1.5;
  std::vector<PictureTimes> rows;
  const Exposure exposure;
  const BodyPoses still(m.data.bones.size());
  const BodyPoses bent = flexed(m.data, m.flexion_deg);
  for (const int pixels : {kLive, kFull}) {
    const CArmPose pa = c_arm(m.data, {}, pixels);
    const auto measure = [&](const char* what, const auto& take) {
      rows.push_back(time_pictures(what, pixels, kBudgetSeconds, take));
    };
    measure("plain CT", [&](int) { (void)m.plain.render(pa, {}, exposure); });
    measure("composed, all anew", [&](int i) {
      const CArmPose pose = c_arm(m.data, {i % 2 == 0 ? 0.0 : 0.01, 0}, pixels);
      (void)m.composed.render({pose, still, {}}, exposure);
    });
    measure("bones move", [&](int i) {
      const double deg = m.flexion_deg * (i % 10 + 1) / 10;
      (void)m.composed.render({pa, flexed(m.data, deg), {}}, exposure);
    });
    measure("C-arm moves, hand flexed", [&](int i) {
      const CArmPose pose = c_arm(m.data, {i % 20 * 5.0, 0}, pixels);
      (void)m.composed.render({pose, bent, {}}, exposure);
    });
    measure("all rests, a wire moves", [&](int i) {
      const auto& axis = m.data.scaphoid.central_axis;
      const Vec3 back = (axis.proximal - axis.distal) * (1 + 0.01 * (i % 50));
      const auto wire = fluoroscopy::make_wire(axis.distal, axis.distal + back, 1.14);
      (void)m.composed.render({pa, still, {&wire, 1}}, exposure);
    });
    GrowingHole hole(m.data);
    measure("all rests, a bone is drilled", [&](int i) {
      hole.grow(m.composed, i);
      (void)m.composed.render({pa, still, {}}, exposure);
    });
    for (std::size_t b = 0; b < m.data.bones.size(); ++b) m.composed.restore(b);
  }
  return rows;
}

void run(const FluoroscopyArguments& a) {
  if (!a.json.empty()) check_writable(a.json);
  install_parallel_executor([](std::size_t count, std::size_t grain, const auto& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const auto& range) { body(range.begin(), range.end()); });
  });
  cases::CaseData data = case_io::read_case(a.case_folder);
  cases::ensure_hand_motion(data);
  const FluoroscopyRenderer plain(data.ct.view());
  ComposedRenderer composed(data.ct.view(), data.labels.view(), bodies_of(data));
  FluoroscopyReport report{
      data.pseudonym, data.provenance.simulated, data.ct.geometry().size, {}, {}};
  const RigidBones bones(data);
  const Measured measured{data, composed, plain, bones, a.flexion_deg, a.pictures};
  report.differences = measure_accuracy(measured);
  report.times = measure_speed(measured);
  std::fputs(text_of(report).c_str(), stdout);
  if (!a.json.empty()) write_text(a.json, json_of(report));
}

}  // namespace

void add_fluoroscopy(CLI::App& app, FluoroscopyArguments& a) {
  CLI::App* verb =
      app.add_subcommand("fluoroscopy", "Pictures of moving bones: how exact, how many a second");
  verb->add_option("--case", a.case_folder, "Case folder")->capture_default_str();
  verb->add_option("--json", a.json, "Also write the rows here");
  verb->add_option("--pictures", a.pictures, "Folder for the compared pictures, as PGM");
  verb->add_option("--flexion-deg", a.flexion_deg, "How far the hand is flexed from the scan")
      ->check(CLI::Range(1.0, 80.0))
      ->capture_default_str();
  verb->callback([&a] { run(a); });
}

}  // namespace carpus::bench
