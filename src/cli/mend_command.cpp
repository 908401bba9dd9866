// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/mend_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "case_io/atomic_folder.hpp"
#include "case_io/bone_normals.hpp"
#include "case_io/glb.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/write_volume.hpp"
#include "cli/corrected_case.hpp"
#include "cli/progress_line.hpp"
#include "core/error.hpp"
#include "reconstruct/ground_truth.hpp"
#include "reconstruct/mend_bones.hpp"
#include "reconstruct/stage_clock.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Arguments {
  fs::path case_folder;
  fs::path labels;
  fs::path before;
  fs::path out;
  bool grows = false;
  bool force = false;
};

bool holds(const Grid<std::uint8_t>& labels, std::uint8_t label) {
  return std::find(labels.values().begin(), labels.values().end(), label) != labels.values().end();
}

void write(const Arguments& a,
           const reconstruct::Mended& mended,
           const GridView<const std::int16_t>& ct) {
  case_io::AtomicFolder folder(a.out,
                               a.force ? case_io::Overwrite::Replace : case_io::Overwrite::Refuse);
  const bool is_broken = holds(mended.labels, kScaphoidDistalLabel);
  std::vector<case_io::NamedMesh> meshes;
  Json bones = Json::array();
  for (const reconstruct::MendedBone& bone : mended.bones) {
    const std::string name = name_of_label(bone.label, is_broken);
    bones.push_back({{"name", name}, {"label", bone.label}, {"volume_mm3", bone.volume_mm3}});
    if (bone.surface.facets.empty()) continue;
    meshes.push_back({name, &bone.surface, {}});
    meshes.back().normals = case_io::bone_normals(bone.surface, {}, ct);
  }
  if (!meshes.empty()) {
    records::write_file_atomically(folder.staging() / "bones.glb", case_io::make_glb(meshes));
  }
  if (a.grows) {
    case_io::write_volume(folder.staging() / "labels.nii.gz", mended.labels.view());
  }
  const Json json{{"format", "carpus mended bones"}, {"schema_version", 1}, {"bones", bones}};
  records::write_file_atomically(folder.staging() / "mended.json", json.dump(1) + "\n");
  folder.commit();
}

void run(const Arguments& a) {
  if (!is_case_folder(a.case_folder)) {
    throw InvalidInput(a.case_folder.string() + ": is no case; give the folder of one");
  }
  reconstruct::StageClock clock;
  const auto stage = [&](const char* name, double fraction) {
    clock.begin(name);
    show_progress(name, fraction);
  };
  stage("read", 0);
  const Grid<std::int16_t> ct = case_io::read_ct(a.case_folder / "ct.nii.gz", {});
  const fs::path before = a.before.empty() ? a.case_folder / "labels.nii.gz" : a.before;
  reconstruct::MendOptions options;
  options.grows = a.grows;
  const Grid<std::uint8_t> painted = case_io::read_labels(a.labels);
  const Grid<std::uint8_t> earlier = case_io::read_labels(before);
  stage(a.grows ? "watershed" : "surfaces", 0.3);
  const reconstruct::Mended mended = reconstruct::mend_bones(ct.view(), earlier, painted, options);
  stage("write", 0.9);
  write(a, mended, ct.view());
  clock.end();
  show_progress("done", 1);
  const bool is_broken = holds(mended.labels, kScaphoidDistalLabel);
  for (const reconstruct::MendedBone& bone : mended.bones) {
    std::printf("%-18s %8.1f mm3 %6zu facets\n", name_of_label(bone.label, is_broken).c_str(),
                bone.volume_mm3, bone.surface.facets.size());
  }
  for (const reconstruct::StageTime& each : clock.stages()) {
    std::fprintf(stderr, "%-10s %.2f s\n", each.name.c_str(), each.seconds);
  }
}

}  // namespace

void add_mend_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "mend", "Bones whose labels were painted, made anew alone, before the case is");
  command->add_option("case", a->case_folder, "Case folder")->required();
  command->add_option("--labels", a->labels, "The case's labels as a person changed them")
      ->required();
  command->add_option("--before", a->before,
                      "Labels before the last strokes; the case's own where not given");
  command->add_option("--out", a->out, "Folder for the bones that were touched")->required();
  command->add_flag("--grow", a->grows,
                    "What was painted is a marker: let the water find the bone's border in the CT");
  command->add_flag("--force", a->force, "Replace an existing folder");
  command->callback([a] { run(*a); });
}

}  // namespace carpus::cli
