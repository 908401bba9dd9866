// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fluoroscopy_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "case_io/case_folder.hpp"
#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "fluoroscopy/composed_renderer.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct FluoroscopyArguments {
  std::string case_folder = kDefaultCase;
  std::string out;
  std::string view = "pa";
  double rotation_deg = 0.0;
  double tilt_deg = 0.0;
  int pixels = 512;
  std::uint64_t seed = 1;
  bool inverted = false;
  bool has_angles = false;
};

fluoroscopy::ViewAngles angles_of(const FluoroscopyArguments& a) {
  if (a.has_angles) return {a.rotation_deg, a.tilt_deg};
  const auto view = fluoroscopy::find_view(a.view);
  if (view) return view->angles;
  std::string known;
  for (const fluoroscopy::NamedView& named : fluoroscopy::kNamedViews) {
    known += " " + std::string(named.id);
  }
  throw UsageError("fluoroscopy: no view is called '" + a.view + "'; there are" + known);
}

void run(const FluoroscopyArguments& a) {
  const fluoroscopy::ViewAngles angles = angles_of(a);
  const cases::CaseData data = case_io::read_case(a.case_folder);
  std::vector<fluoroscopy::BodyLabel> bodies;
  std::vector<Pose<frame::Patient, frame::Bone>> poses;
  for (const cases::Bone& bone : data.bones) {
    bodies.push_back({bone.label, belongs_to_forearm(bone.bone) ? 1 : 0});
    poses.push_back(bone.patient_from_bone);
  }
  fluoroscopy::ComposedRenderer renderer(data.ct.view(), data.labels.view(), bodies);
  fluoroscopy::CArmGeometry geometry;
  geometry.pixels = a.pixels;
  const cases::AxisSegment& axis = data.scaphoid.central_axis;
  const fluoroscopy::CArmPose pose = fluoroscopy::make_c_arm_pose(
      angles, {(axis.proximal + axis.distal) * 0.5}, data.wrist_from_patient,
      {{0, data.side == Side::Left ? 1.0 : -1.0, 0}}, geometry);
  fluoroscopy::Exposure exposure;
  exposure.seed = a.seed;
  exposure.inverted = a.inverted;
  const fluoroscopy::Image image = renderer.render({pose, poses, {}}, exposure);
  std::string file = "P5\n" + std::to_string(image.width) + " " + std::to_string(image.height) +
                     "\n255\n";  // portable grey map: no library, and every viewer reads it
  file.append(image.grey.begin(), image.grey.end());
  records::write_file_atomically(a.out, file);
  std::printf("%s: %s, rotation %.1f deg, tilt %.1f deg, %d x %d, %.2f cGy cm2\n", a.out.c_str(),
              in_words(data).c_str(), angles.rotation_deg, angles.tilt_deg, image.width,
              image.height, image.dose_cgy_cm2);
}

}  // namespace

void add_fluoroscopy_command(CLI::App& app) {
  auto a = std::make_shared<FluoroscopyArguments>();
  CLI::App* command = app.add_subcommand("fluoroscopy", "Take a fluoroscopy picture of a case");
  command->add_option("case", a->case_folder, "Case folder")->capture_default_str();
  command->add_option("--out", a->out, "Picture to write, as PGM")
      ->check(output_file())
      ->required();
  command->add_option("--view", a->view, "Named view, such as pa, lateral, oblique_45_pronated")
      ->capture_default_str();
  auto* rotation = command->add_option("--rotation-deg", a->rotation_deg,
                                       "About the forearm: 0 PA, 90 lateral; instead of --view");
  auto* tilt =
      command->add_option("--tilt-deg", a->tilt_deg, "Source towards proximal; instead of --view");
  command->add_option("--pixels", a->pixels, "Side of the picture")
      ->check(CLI::Range(16, 2048))
      ->capture_default_str();
  command->add_option("--seed", a->seed, "Of the quantum noise")->capture_default_str();
  command->add_flag("--inverted", a->inverted, "Bone bright, as radiographs are printed");
  command->callback([a, rotation, tilt] {
    a->has_angles = rotation->count() + tilt->count() > 0;
    run(*a);
  });
}

}  // namespace carpus::cli
